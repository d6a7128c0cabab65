// Time, and everything that follows it.
const end = Math.max(data.end_s, 0.001);
readColours();

const slider = element("time");
const state = { t: 0, isPlaying: false, before: 0, isDue: false };

const map = new MapView(element("stage"), () => ask());
const plots = [
  [new NoveltyPlot(element("novelty")), element("novelty-value")],
  [new ActivationPlot(element("activation")), element("activation-value")],
];
const buffers = new BufferPanel(element("buffers"));
const productions = new ProductionPanel();
const table = new DecisionTable(element("decisions"), t => jump(t));

const poseAt = t => Math.max(lastUpTo(path.t.length, i => path.t[i], t + 5e-4), 0);
const MOMENT = 2e-4; // the trace has tenths of a millisecond: what happens at a moment has happened at it

const draw = () => {
  const { t } = state;
  const last = productions.firing(t + MOMENT);
  const decided = lastUpTo(decisions.length, i => decisions[i].decided, t + MOMENT);
  map.draw(poseAt(t), t + MOMENT, {
    scan: element("show-scan").checked,
    graph: element("show-graph").checked,
    follow: element("follow").checked,
    lit: decided < 0 ? "" : decisions[decided].landmark,
  });
  for (const [plot, value] of plots) {
    plot.draw(t);
    const said = plot.said(t);
    if (value.textContent !== said) value.textContent = said;
  }
  buffers.draw(t + MOMENT);
  productions.draw(t + MOMENT);
  table.draw(t + MOMENT);
  slider.value = t;
  element("clock").textContent = timeText(t);
  state.last = last;
};

// Draw before the screen is shown next; many calls are one drawing.
const ask = () => {
  if (state.isDue || state.isPlaying) return;
  state.isDue = true;
  requestAnimationFrame(() => { state.isDue = false; draw(); });
};
const seek = t => {
  state.t = Math.min(Math.max(t, 0), end);
  slider.setAttribute("aria-valuetext", timeText(state.t));
  ask();
};
const frame = now => {
  if (!state.isPlaying) return;
  const passed = Math.min((now - state.before) / 1000, 0.25); // a page that was hidden does not leap
  state.before = now;
  state.t = Math.min(state.t + passed * Number(element("speed").value), end);
  draw();
  if (state.t >= end) play(false);
  else requestAnimationFrame(frame);
};
const play = on => {
  if (on && state.t >= end) state.t = 0;
  if (on === state.isPlaying) return;
  state.isPlaying = on;
  element("play").querySelector("path").setAttribute("d", on ? "M2 3h4v14H2zM8.5 3h4v14h-4z" : "M2 3v14l11-7z");
  element("play").setAttribute("aria-label", on ? "Pause" : "Play");
  if (!on) { ask(); return; }
  state.before = performance.now();
  requestAnimationFrame(frame);
};
// To the production that fires next, or fired before.
const step = by => {
  if (!data.story) return;
  const { firings } = data.story;
  const at = productions.firing(state.t + MOMENT);
  const isThere = at >= 0 && Math.abs(firings[at][0] - state.t) <= 2 * MOMENT;
  const next = by > 0 ? at + 1 : isThere ? at - 1 : at;
  play(false);
  if (next >= 0 && next < firings.length) seek(firings[next][0]);
};
const forget = () => {
  map.forget();
  for (const [plot] of plots) plot.isFresh = false;
};

const jump = t => { play(false); seek(t); };
slider.max = end;
slider.addEventListener("input", () => seek(Number(slider.value)));
element("play").addEventListener("click", () => play(!state.isPlaying));
element("back").addEventListener("click", () => step(-1));
element("on").addEventListener("click", () => step(1));
for (const id of ["show-scan", "show-graph", "follow"]) element(id).addEventListener("change", ask);
element("others").addEventListener("toggle", () => {
  element("mind").classList.toggle("open", element("others").open);
  ask();
});
for (const choice of document.querySelectorAll('input[name="moment"]')) choice.addEventListener("change", ask);
for (const [plot] of plots) if (!plot.isEmpty) plot.listen(seek);
const changed = listenTo(map, pose => jump(path.t[pose]), () => poseAt(state.t));
const zoom = factor => { map.camera.zoom(factor); changed(); };
element("nearer").addEventListener("click", () => zoom(1.4));
element("farther").addEventListener("click", () => zoom(1 / 1.4));
element("whole").addEventListener("click", () => { map.whole(); ask(); });

const KEYS = {
  " ": () => play(!state.isPlaying),
  ArrowLeft: event => seek(state.t - (event.shiftKey ? 10 : 1)),
  ArrowRight: event => seek(state.t + (event.shiftKey ? 10 : 1)),
  Home: () => seek(0),
  End: () => jump(end),
  ",": () => step(-1),
  ".": () => step(1),
  "+": () => zoom(1.4),
  "-": () => zoom(1 / 1.4),
  0: () => { map.whole(); ask(); },
};
document.addEventListener("keydown", event => {
  const act = KEYS[event.key];
  if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
  const here = event.target;
  if (here.tagName === "SELECT" || here.type === "radio") return;
  if (event.key === " " && (here.tagName === "SUMMARY" || here.type === "checkbox" || (here.tagName === "BUTTON" && here.id !== "play"))) return;
  if (["Home", "End"].includes(event.key) && here.id === "decisions") return;
  event.preventDefault();
  act(event);
});
// A button that has the focus would take the space bar twice.
element("play").addEventListener("keyup", event => { if (event.key === " ") event.preventDefault(); });

// Drawn at once, before the screen is shown: a canvas of a new size is empty.
const resize = () => {
  map.resize();
  for (const [plot] of plots) plot.resize();
  draw();
};
new ResizeObserver(resize).observe(element("stage"));
for (const [plot] of plots) new ResizeObserver(resize).observe(plot.box);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { readColours(); map.paint(); forget(); ask(); });

// page.html#t=264 opens at a moment, #t=264&why with the rules explained.
const goTo = () => {
  const wanted = new URLSearchParams(location.hash.slice(1));
  if (Number.isFinite(Number.parseFloat(wanted.get("t")))) jump(Number.parseFloat(wanted.get("t")));
  if (wanted.has("why")) element("others").open = true;
};
window.addEventListener("hashchange", goTo);

const unknown = data.arcs.filter(([, , , isKnown]) => !isKnown).length;
if (unknown) element("arcs-note").textContent = `Dashed arcs (${unknown}): the tables do not tell when they came.`;
element("length").textContent = `of ${timeText(end, 0)}`;
// For tests and measurements.
window.ssricsView = { state, data, path, map, plots, seek, play, draw, forget };
resize();
goTo();
map.load().then(() => { draw(); document.documentElement.dataset.ready = "yes"; });
