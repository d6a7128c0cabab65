// A plan trial: marks on a floor plan.
import { placed, shortened } from "/static/names.js";
import { follow } from "/static/pointers.js";
import { Step } from "/static/step.js";
import { View } from "/static/view.js";

const SHORT_M = 0.1, LONG_M = 1;
const SETTLE_MS = 500;  // after the last stroke of a key, a move or a name is saved
const LABEL_MAX = 200;
const FORMULA = /^[\s=+\-@\uff1d\uff0b\uff0d\uff20]+/u;  // no name begins so: the server says why
const SVG = "http://www.w3.org/2000/svg";
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const BARS_M = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50];

const step = await Step.begin();
const { width_m: width, height_m: height } = step.state;
const get = id => document.getElementById(id);
const plan = get("plan"), layer = get("marks"), list = get("list"), cross = get("cross");
const view = new View(width, height);
const marks = new Map();  // key -> { key, label, right, down, shape, row }
let chosen = null;
let cursor = [width / 2, height / 2];
let grip = [0, 0];  // from the pointer to the mark that it drags
const settling = new Map();  // what is saved soon: name -> { timer, save }

function say(text) { get("said").textContent = text; }

function soon(name, save) {
  clearTimeout(settling.get(name)?.timer);
  const now = () => { settling.delete(name); save(); };
  settling.set(name, { timer: setTimeout(now, SETTLE_MS), save: now });
}

function settle() {
  for (const { timer, save } of [...settling.values()]) { clearTimeout(timer); save(); }
}

function element(name, parent, attributes = {}) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  parent.append(made);
  return made;
}

function draw() {
  get("world").setAttribute("transform", `matrix(${view.scale} 0 0 ${view.scale} ${view.x} ${view.y})`);
  // The chosen mark's name is shown first of all.
  const drawn = [...marks.values()].sort((a, b) => (b.key === chosen) - (a.key === chosen));
  const places = drawn.map(mark => {
    const [x, y] = view.toScreen(mark.right, mark.down);
    const name = mark.shape.querySelector(".name");
    name.textContent = shortened(mark.label, view.size.width);
    return { x, y, length: name.getComputedTextLength() };
  });
  placed(places, view.size).forEach((place, i) => {
    const name = drawn[i].shape.querySelector(".name");
    drawn[i].shape.setAttribute("transform", `translate(${places[i].x} ${places[i].y})`);
    name.classList.toggle("covered", !place);
    if (place) { name.setAttribute("x", place[0]); name.setAttribute("y", place[1]); }
  });
  const [x, y] = view.toScreen(...cursor);
  cross.setAttribute("transform", `translate(${x} ${y})`);
  const bar = BARS_M.filter(metres => metres * view.scale <= 110).at(-1) ?? BARS_M[0];
  const scale = get("scale").firstElementChild;
  scale.textContent = `${bar} m`;
  scale.style.width = `${bar * view.scale}px`;
}

function number() {
  let n = 0;
  for (const mark of marks.values()) {
    n += 1;
    mark.number = n;
    mark.shape.querySelector(".digit").textContent = n;
    mark.shape.querySelector("title").textContent = mark.label;
    mark.shape.setAttribute("aria-label", `Mark ${n}${mark.label ? `, ${mark.label}` : ""}`);
    mark.row.querySelector("b").textContent = n;
    mark.row.querySelector("input").setAttribute("aria-label", `Name of mark ${n}`);
    mark.row.querySelector("button").setAttribute("aria-label", `Delete mark ${n}`);
  }
  get("count").textContent = n;
  get("none").hidden = n > 0;
}

function choose(key) {
  chosen = key;
  for (const mark of marks.values()) {
    mark.shape.classList.toggle("chosen", mark.key === key);
    mark.row.classList.toggle("chosen", mark.key === key);
  }
  draw();
  if (key) {
    const row = marks.get(key).row;  // shown by scrolling the list, never the page
    const over = row.offsetTop + row.offsetHeight - list.clientHeight - list.offsetTop;
    list.scrollTop = Math.min(row.offsetTop - list.offsetTop, Math.max(list.scrollTop, over));
  }
}

function put(key, right, down, label) {
  const shape = element("g", layer, { class: "mark", tabindex: 0, role: "button" });
  shape.dataset.key = key;
  element("title", shape);
  element("circle", shape, { class: "reach", r: 22 });
  element("circle", shape, { class: "halo", r: 15 });
  element("circle", shape, { class: "ring", r: 11 });
  element("text", shape, { class: "digit" });
  element("text", shape, { class: "name" });
  shape.addEventListener("focus", () => choose(key));
  const row = document.createElement("li");
  const digit = document.createElement("b");
  const name = document.createElement("input");
  name.maxLength = LABEL_MAX;
  name.placeholder = "Name, if you like";
  name.value = label;
  const remove = document.createElement("button");
  remove.type = "button";
  remove.textContent = "✕";
  remove.title = "Delete";
  row.append(digit, name, remove);
  list.append(row);
  marks.set(key, { key, label, right, down, shape, row });
  name.addEventListener("focus", () => choose(key));
  const rename = () => {
    const mark = marks.get(key);
    const said = name.value.replace(/\p{Cc}/gu, " ").replace(FORMULA, "").trim();
    if (!mark || said === mark.label) return;
    mark.label = said;
    step.send("name", { mark: key, label: said });
    number();
    draw();
  };
  name.addEventListener("input", () => soon(`name ${key}`, rename));
  name.addEventListener("change", () => { rename(); name.value = marks.get(key)?.label ?? ""; });
  name.addEventListener("keydown", event => { if (event.key === "Enter") name.blur(); });
  remove.addEventListener("click", () => drop(key));
  number();
  draw();
}

function add(right, down) {
  if (!view.isOn(right, down)) return;
  const key = step.send("add", { right_m: right, down_m: down });
  put(key, right, down, "");
  choose(key);
  say(`Mark ${marks.size} set.`);
}

function shift(mark, right, down) {
  mark.right = Math.min(width, Math.max(0, right));
  mark.down = Math.min(height, Math.max(0, down));
  draw();
}

function moved(mark) { step.send("move", { mark: mark.key, right_m: mark.right, down_m: mark.down }); }

function drop(key) {
  const mark = marks.get(key);
  if (!mark) return;
  for (const name of [`name ${key}`, `move ${key}`]) {
    clearTimeout(settling.get(name)?.timer);
    settling.delete(name);
  }
  const gone = mark.number;
  const focused = mark.shape.contains(document.activeElement) || mark.row.contains(document.activeElement);
  mark.shape.remove();
  mark.row.remove();
  marks.delete(key);
  step.send("delete", { mark: key });
  number();
  choose(null);
  if (focused) plan.focus();
  say(`Mark ${gone} deleted.`);
}

follow(plan, {
  onClick: ([x, y]) => { cross.setAttribute("hidden", ""); add(...view.toPlan(x, y)); },
  onGrab: (key, [x, y]) => {
    const mark = marks.get(key);
    const [markX, markY] = view.toScreen(mark.right, mark.down);
    grip = [markX - x, markY - y];
    choose(key);
  },
  onDrag: (key, [x, y]) => shift(marks.get(key), ...view.toPlan(x + grip[0], y + grip[1])),
  onDrop: (key, changed) => {
    marks.get(key).shape.focus({ preventScroll: true });
    if (changed) moved(marks.get(key));
  },
  onPan: (dx, dy) => { view.pan(dx, dy); draw(); },
  onPinch: (factor, x, y) => { view.zoom(factor, x, y); draw(); },
});

plan.addEventListener("keydown", event => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const mark = marks.get(event.target.closest(".mark")?.dataset.key);
  const far = event.shiftKey ? LONG_M : SHORT_M;
  if (event.key in ARROWS) {
    const [dx, dy] = ARROWS[event.key];
    if (mark) {
      shift(mark, mark.right + dx * far, mark.down + dy * far);
      view.reveal(mark.right, mark.down);
      soon(`move ${mark.key}`, () => { if (marks.has(mark.key)) moved(mark); });
    } else {
      const held = (at, most) => Math.min(most, Math.max(0, at));
      cursor = [held(cursor[0] + dx * far, width), held(cursor[1] + dy * far, height)];
      cross.removeAttribute("hidden");
      view.reveal(...cursor);
    }
    draw();
  } else if ((event.key === "Delete" || event.key === "Backspace") && mark) drop(mark.key);
  else if (event.key === "Enter" || event.key === " ") {
    if (mark) mark.row.querySelector("input").focus();
    else { cross.removeAttribute("hidden"); add(...cursor); }
  } else if (event.key === "+" || event.key === "=") { view.zoom(1.3); draw(); }
  else if (event.key === "-") { view.zoom(1 / 1.3); draw(); }
  else if (event.key === "0") { view.fit(); draw(); }
  else return;
  event.preventDefault();
});

// A mark that was set by a click is deleted by the key at once, wherever the focus is by then.
document.addEventListener("keydown", event => {
  const typing = event.target.closest("input, .mark");
  if ((event.key === "Delete" || event.key === "Backspace") && chosen && !typing) drop(chosen);
});

get("in").addEventListener("click", () => { view.zoom(1.5); draw(); });
get("out").addEventListener("click", () => { view.zoom(1 / 1.5); draw(); });
get("fit").addEventListener("click", () => { view.fit(); draw(); });

let ending = false;
async function end() {
  if (ending) return;
  ending = true;
  get("done").disabled = true;
  settle();
  await step.end();
}
get("done").addEventListener("click", () => { if (marks.size) end(); else get("sure").showModal(); });
get("back").addEventListener("click", () => get("sure").close());
get("on").addEventListener("click", () => { get("sure").close(); end(); });
window.addEventListener("pagehide", settle);

const picture = get("picture");
picture.setAttribute("width", width);
picture.setAttribute("height", height);
picture.setAttribute("href", `/api/plan/${step.state.step}`);
for (const mark of step.state.marks) put(mark.key, mark.right_m, mark.down_m, mark.label);
new ResizeObserver(() => {
  const box = plan.getBoundingClientRect();
  view.resize(box.width, box.height);
  draw();
}).observe(plan);
get("done").disabled = false;
