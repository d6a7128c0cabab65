// A walk trial: a robot's way is replayed; a key or a tap marks a landmark.
import { Frames, ReplayClock } from "/static/frames.js";
import { post } from "/static/outbox.js";
import { drawFan, drawView } from "/static/scene.js";
import { Step } from "/static/step.js";

const TELL_MS = 2000;  // so often the server is told how far the replay has got
const SETTLED_MS = 1500;  // so long after its end nobody presses for a landmark any more
const LOST_MS = 2500;  // a longer gap between two pictures is a closed lid, or the like
const step = await Step.begin();
const get = id => document.getElementById(id);
const state = step.state;
const place = `ssrics:${state.participant}:${state.step}:replay`;

let from = state.replay_ms;
try { from = Math.max(from, Number(localStorage.getItem(place)) || 0); } catch { /* the server's will do */ }
const clock = new ReplayClock(Math.min(from, state.length_ms), state.length_ms);
let presses = Math.max(state.presses, 0);
let shown = null, told = 0, painted = 0, frames = null;

async function load() {
  for (let pause = 500; ; pause = Math.min(2 * pause, 8000)) {
    try {
      const answer = await fetch(`/api/walk/${state.step}`, { cache: "no-store" });
      if (answer.ok) return new Frames(await answer.arrayBuffer(), state);
    } catch { /* no connection */ }
    step.show("waiting");
    await new Promise(resolve => setTimeout(resolve, pause));
  }
}

function keep(ms) {
  try { localStorage.setItem(place, String(ms)); } catch { /* the server is told as well */ }
}

function tell(ms) {
  told = ms;
  post("/api/progress", { step: state.step, replay_ms: ms });
}

function paint(ms) {
  const frame = frames.at(ms);
  drawView(get("view"), frame);
  drawFan(get("fan"), frame, state.bearings_rad);
  get("time").value = ms / state.length_ms;
}

function curtain(text, button) {
  get("curtain").hidden = text === null;
  get("curtain-text").textContent = text ?? "";
  get("start").hidden = !button;
  get("start").textContent = button ?? "";
  // Not at once: a press that was meant for what was there before would begin the walk unread.
  if (button) setTimeout(() => get("start").focus({ preventScroll: true }), SETTLED_MS);
}

function tick(now) {
  if (!clock.running) return;
  if (now - painted > LOST_MS) { pause("lost", painted); return; }
  painted = now;
  const ms = clock.at(now);
  const index = Math.floor(ms / 1000 * state.rate_hz);
  if (index !== shown) { shown = index; paint(ms); keep(ms); }
  if (ms - told > TELL_MS) tell(ms);
  if (ms >= state.length_ms) { finish(now); return; }
  requestAnimationFrame(tick);
}

function play() {
  if (clock.running || clock.at(0) >= state.length_ms) return;
  const now = performance.now();
  step.send("resume", { replay_ms: clock.base });
  clock.start(now);
  painted = now;
  curtain(null);
  get("mark").disabled = false;
  if (get("pause")) get("pause").disabled = false;
  document.activeElement?.blur();
  requestAnimationFrame(tick);
}

function pause(why, now = performance.now()) {
  if (!clock.running) return;
  clock.stop(now);
  keep(clock.base);
  step.send("pause", { replay_ms: clock.base, label: why });
  get("mark").disabled = true;
  if (get("pause")) get("pause").disabled = true;
  curtain(why === "asked" ? "Paused." : "The walk was interrupted. It goes on from the same place.", "Go on");
}

function finish(now) {
  clock.stop(now);
  keep(clock.base);
  over();
}

function over() {
  get("mark").disabled = true;
  if (get("pause")) get("pause").hidden = true;
  curtain("That was the walk.", null);
  get("time").value = 1;
  get("done").hidden = false;
  // Not at once: a press that was meant for a landmark would leave the step.
  setTimeout(() => get("done").focus({ preventScroll: true }), SETTLED_MS);
}

function mark(stamp) {
  if (!clock.running) return;
  // A stamp from before the picture was last painted belongs to what was seen then.
  const ms = clock.at(Math.min(Math.max(stamp, clock.since), performance.now()));
  step.send("press", { replay_ms: ms });
  presses += 1;
  get("count").textContent = presses;
  get("said").textContent = `Landmark ${presses}`;
  const flash = get("flash");
  flash.classList.remove("lit");
  void flash.offsetWidth;  // so that the flash begins anew
  flash.classList.add("lit");
  navigator.vibrate?.(30);
}

let byKey = false;
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  if (event.key === "p" && state.pausing) { if (clock.running) pause("asked"); else play(); return; }
  if ((event.key !== " " && event.key !== "Enter") || !clock.running) return;
  if (event.target.closest("#pause")) return;
  event.preventDefault();
  byKey = true;
  if (!event.repeat) mark(event.timeStamp);
});
document.addEventListener("keyup", event => {
  if (byKey && (event.key === " " || event.key === "Enter")) event.preventDefault();
  byKey = false;
});
for (const id of ["mark", "view"]) {
  get(id).addEventListener("pointerdown", event => {
    if (event.button === 0) mark(event.timeStamp);
  });
}
get("mark").addEventListener("click", event => {
  if (event.detail === 0) mark(event.timeStamp);  // from a screen reader: there was no pointer
});
get("start").addEventListener("click", play);
get("pause")?.addEventListener("click", () => pause("asked"));
get("done").addEventListener("click", async () => {
  get("done").disabled = true;
  try { localStorage.removeItem(place); } catch { /* nothing was kept */ }
  await step.end({ replay_ms: state.length_ms });
});
document.addEventListener("visibilitychange", () => { if (document.hidden) pause("hidden"); });
window.addEventListener("pagehide", () => {
  if (clock.running) { const ms = clock.at(performance.now()); keep(ms); tell(ms); }
});

get("count").textContent = presses;
frames = await load();
if (step.outbox.waiting().length === 0 && get("saved").dataset.state === "waiting") step.show("saved");
new ResizeObserver(() => paint(clock.at(performance.now()))).observe(get("view"));
if (clock.base >= state.length_ms) over();
else curtain(clock.base > 0 ? "The walk goes on from where you were." : "Ready?", clock.base > 0 ? "Go on" : "Start");
