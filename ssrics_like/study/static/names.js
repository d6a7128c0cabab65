// Where the names of marks stand on the plan: beside their marks, and none over another.

const NARROW_PX = 600;
const LETTERS = { narrow: 14, wide: 28 };  // of a name that are shown on the plan; the list has all
const RING_PX = 13;
const GAP_PX = 20;  // from the middle of a mark to its name
const HALF_PX = 8;  // of a name's height

/** Return a name that is short enough for a plan of so many pixels across. */
export function shortened(name, width) {
  const letters = [...name];
  const most = width < NARROW_PX ? LETTERS.narrow : LETTERS.wide;
  return letters.length > most ? `${letters.slice(0, most - 1).join("").trimEnd()}…` : name;
}

const overlap = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

/** Return where the middle of each name is, from its mark; null where there is no room, for the later ones. */
export function placed(marks, { width, height }) {
  const taken = marks.map(({ x, y }) => [x - RING_PX, y - RING_PX, x + RING_PX, y + RING_PX]);
  return marks.map(({ x, y, length }) => {
    const far = GAP_PX + length / 2, high = RING_PX + 2 + HALF_PX;
    for (const [dx, dy] of [[far, 0], [-far, 0], [0, high], [0, -high]]) {
      const box = [x + dx - length / 2, y + dy - HALF_PX, x + dx + length / 2, y + dy + HALF_PX];
      const outside = box[0] < 0 || box[1] < 0 || box[2] > width || box[3] > height;
      if (outside || taken.some(other => overlap(box, other))) continue;
      taken.push(box);
      return [dx, dy];
    }
    return null;
  });
}
