// Names beside markers, none over another: the first free place of eight, or no name.
const PLACES = [[1, 0], [-1, 0], [0, -1], [0, 1], [1, -1], [1, 1], [-1, -1], [-1, 1]];
const placed = (spots, measure, { width, height }) => {
  const taken = spots.map(({ x, y }) => [x - 6, x + 6, y - 6, y + 6]);
  const found = [];
  for (const spot of spots) {
    const wide = measure(spot.name), high = 14;
    for (const [right, down] of PLACES) {
      const x = spot.x + right * 11 + (right > 0 ? 0 : right < 0 ? -wide : -wide / 2);
      const y = spot.y + down * (right ? 8 : 15) - high / 2;
      const box = [x - 1, x + wide + 1, y, y + high];
      if (box[0] < 2 || box[1] > width - 2 || box[2] < 2 || box[3] > height - 2) continue;
      if (taken.some(other => box[0] < other[1] && box[1] > other[0] && box[2] < other[3] && box[3] > other[2])) continue;
      taken.push(box);
      found.push({ name: spot.name, x, y: y + high / 2 });
      break;
    }
  }
  return found;
};
