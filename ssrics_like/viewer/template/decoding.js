// What Python packed, as typed arrays (ssrics_like/viewer/quantising.py).
const bytesOf = text => Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer;
const NOTHING = 65535;

// Numbers in steps of a fixed size; NaN for none.
const numbersOf = ({ least, step, data }) =>
  Float32Array.from(new Uint16Array(bytesOf(data)), n => (n === NOTHING ? NaN : least + step * n));

const data = JSON.parse(document.getElementById("data").textContent);
const path = {
  t: Float64Array.from(new Uint32Array(bytesOf(data.path.t)), ms => ms / 1000),
  x: numbersOf(data.path.x),
  y: numbersOf(data.path.y),
  theta: Float32Array.from(new Uint16Array(bytesOf(data.path.theta)), n => (n / 65536) * 2 * Math.PI),
  landings: new Set(data.path.landings),
};
const scans = data.scans && {
  poses: new Uint32Array(bytesOf(data.scans.poses)),
  ranges: new Uint16Array(bytesOf(data.scans.ranges)),
  beams: data.scans.beams,
  first: data.scans.first_rad,
  step: data.scans.step_rad,
};
const landmarks = data.landmarks.map(([name, t, x, y, sector, visits]) => ({ name, t, x, y, sector, visits }));
const landmarkOf = new Map(landmarks.map(mark => [mark.name, mark]));
const decisions = data.decisions.map(([event, t, decided, x, y, novelty, sector, structure, decision, landmark, rule]) =>
  ({ event, t, decided, x, y, novelty, sector, structure, decision, landmark, rule }));
const element = id => document.getElementById(id);
// A new element with text in it; text is never read as HTML.
const made = (tag, text = "", name = "") => {
  const it = document.createElement(tag);
  it.textContent = text;
  if (name) it.className = name;
  return it;
};
