// Draws what a robot sees: walls, floor and ceiling in perspective; and its laser's outline.

const EYE_M = 1.15, CEILING_M = 2.5, TABLE_M = 0.75, SKIRTING_M = 0.1;
const WALLS = [[222, 214, 202], [188, 183, 176]];  // the two sides of cells are lit differently
const HAZE = [96, 104, 112];
const FAN_M = 8;

const mix = (a, b, share) => a.map((part, i) => Math.round(part + (b[i] - part) * share));
const css = colour => `rgb(${colour.join(" ")})`;
const haze = far => 1 - Math.exp(-far / 16);

/** Make a canvas as fine as the screen; returns its context, width and height in CSS pixels. */
export function prepared(canvas) {
  const box = canvas.getBoundingClientRect();
  const fine = Math.min(window.devicePixelRatio || 1, 2);
  const [width, height] = [Math.round(box.width * fine), Math.round(box.height * fine)];
  if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
  const paint = canvas.getContext("2d");
  paint.setTransform(fine, 0, 0, fine, 0, 0);
  return { paint, width: box.width, height: box.height };
}

/** Split columns into runs along which a surface goes on: [first, last]. */
function runs(fars, sides) {
  const found = [];
  let first = null;
  for (let i = 0; i <= fars.length; i++) {
    const here = i < fars.length && Number.isFinite(fars[i]);
    const goesOn = here && first !== null && sides[i] === sides[i - 1]
      && Math.abs(fars[i] - fars[i - 1]) < 0.12 + 0.08 * Math.min(fars[i], fars[i - 1]);
    if (first !== null && !goesOn) { found.push([first, i - 1]); first = null; }
    if (here && first === null) first = i;
  }
  return found;
}

export function drawView(canvas, { walls, furniture }) {
  const { paint, width, height } = prepared(canvas);
  const focal = width / 2;  // 90 degrees across
  const horizon = height * 0.47;
  const step = width / walls.length;
  const fars = walls.map(wall => wall.far);
  const sides = walls.map(wall => wall.side);

  const ceiling = paint.createLinearGradient(0, 0, 0, horizon);
  ceiling.addColorStop(0, "#eef0f1");
  ceiling.addColorStop(1, "#8b939a");
  paint.fillStyle = ceiling;
  paint.fillRect(0, 0, width, horizon);
  const floor = paint.createLinearGradient(0, horizon, 0, height);
  floor.addColorStop(0, "#5d5f60");
  floor.addColorStop(1, "#a08f79");
  paint.fillStyle = floor;
  paint.fillRect(0, horizon, width, height - horizon);

  const y = (metres, far) => horizon + focal * (EYE_M - metres) / far;
  // Along a flat surface the inverse of the distance changes evenly: ends are carried on half a column.
  const ends = ([first, last], of) => {
    const inverse = i => 1 / of[i];
    const slope = last > first ? (inverse(last) - inverse(first)) / (last - first) : 0;
    const held = value => 1 / Math.max(value, 1 / 40);
    return [held(inverse(first) - slope / 2), held(inverse(last) + slope / 2)];
  };
  const outline = (run, of, low, high) => {
    const [first, last] = run;
    const [from, to] = ends(run, of);
    const points = [[first * step, from]];
    for (let i = first; i <= last; i++) points.push([(i + 0.5) * step, of[i]]);
    points.push([(last + 1) * step + 0.6, to]);
    paint.beginPath();
    points.forEach(([x, far], i) => (i ? paint.lineTo(x, y(high, far)) : paint.moveTo(x, y(high, far))));
    for (const [x, far] of points.reverse()) paint.lineTo(x, y(low, far));
    paint.closePath();
  };
  const shaded = ([first, last], of, colour) => {
    const shade = paint.createLinearGradient(first * step, 0, Math.max((last + 1) * step, first * step + 0.1), 0);
    const stops = Math.min(8, last - first + 1);
    for (let i = 0; i <= stops; i++) {
      const column = Math.min(last, first + Math.round((last - first + 1) * i / stops));
      shade.addColorStop(i / stops, css(mix(colour, HAZE, haze(of[column]))));
    }
    return shade;
  };

  const found = runs(fars, sides);
  for (const run of found) {
    outline(run, fars, 0, CEILING_M);
    paint.fillStyle = shaded(run, fars, WALLS[sides[run[0]]]);
    paint.fill();
    outline(run, fars, 0, SKIRTING_M);
    paint.fillStyle = shaded(run, fars, [104, 92, 78]);
    paint.fill();
  }

  // Panels: a joint where the place on the panel begins anew.
  for (let i = 1; i < walls.length; i++) {
    const [a, b] = [walls[i - 1], walls[i]];
    if (a.side !== b.side || Math.abs(a.far - b.far) > 0.12 + 0.08 * Math.min(a.far, b.far)) continue;
    if (Math.abs(a.panel - b.panel) < 0.5) continue;
    const far = Math.min(a.far, b.far);
    paint.fillStyle = `rgb(60 54 46 / ${Math.max(0, 0.34 - far * 0.028)})`;
    paint.fillRect(i * step - 0.7, y(CEILING_M, far), 1.4, y(SKIRTING_M, far) - y(CEILING_M, far));
  }

  // Edges: where one thing ends before another, as at a doorway, and where walls meet.
  for (let k = 1; k < found.length; k++) {
    const i = found[k][0];
    const [before, after] = [fars[i - 1], fars[i]];
    const far = Math.min(before, after);
    const jump = Math.abs(before - after);
    const strength = jump > 0.25 + 0.08 * far ? 0.78 : found[k][1] - i > 2 ? 0.28 : 0;
    if (!strength) continue;
    paint.fillStyle = `rgb(28 26 24 / ${strength * (1 - 0.6 * haze(far))})`;
    const thick = Math.min(4, Math.max(1.2, 9 / far));
    paint.fillRect(i * step - thick / 2, y(CEILING_M, far), thick, y(0, far) - y(CEILING_M, far));
  }

  const none = furniture.map(() => 0);
  const pieces = runs(furniture, none).sort((a, b) => furniture[b[0]] - furniture[a[0]]);
  for (const run of pieces) {
    outline(run, furniture, 0, TABLE_M);
    paint.fillStyle = shaded(run, furniture, [150, 116, 74]);
    paint.fill();
    const [first, last] = run;
    const thick = Math.max(1, 12 / furniture[first]);
    paint.fillStyle = shaded(run, furniture, [184, 150, 104]);
    for (let i = first; i <= last; i++) {
      paint.fillRect(i * step, y(TABLE_M, furniture[i]), step + 0.6, Math.min(thick, 6));
    }
  }
}

export function drawFan(canvas, { fan }, bearings) {
  const { paint, width, height } = prepared(canvas);
  const [x0, y0] = [width / 2, height - 10];
  const scale = (height - 16) / FAN_M;
  paint.fillStyle = "#14191e";
  paint.fillRect(0, 0, width, height);
  paint.save();
  paint.beginPath();
  paint.rect(0, 0, width, height);
  paint.clip();
  paint.beginPath();
  paint.moveTo(x0, y0);
  fan.forEach((range, i) => {
    const far = Math.min(range, 40) * scale;
    paint.lineTo(x0 - far * Math.sin(bearings[i]), y0 - far * Math.cos(bearings[i]));
  });
  paint.closePath();
  paint.fillStyle = "rgb(106 183 230 / 20%)";
  paint.fill();
  paint.strokeStyle = "#6ab7e6";
  paint.lineWidth = 1.5;
  paint.lineJoin = "round";
  paint.stroke();
  paint.restore();
  paint.fillStyle = "#e69f00";
  paint.beginPath();
  paint.moveTo(x0, y0 - 7);
  paint.lineTo(x0 + 5, y0 + 4);
  paint.lineTo(x0 - 5, y0 + 4);
  paint.closePath();
  paint.fill();
}
