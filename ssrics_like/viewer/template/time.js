// Index of the last of rising values that is not above `value`; -1 if all are.
const lastUpTo = (count, at, value) => {
  let low = 0, high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (at(middle) <= value) low = middle + 1; else high = middle;
  }
  return low - 1;
};

const MINUTE = 60, HOUR = 3600;
// A moment for reading: 42.1 s, 12:05.3, 1:02:30.0.
const timeText = (t, decimals = 1) => {
  const scale = 10 ** decimals;
  const tenths = Math.round(t * scale);
  const whole = Math.floor(tenths / scale);
  const rest = decimals ? "." + String(tenths % scale).padStart(decimals, "0") : "";
  if (whole < MINUTE) return `${whole}${rest} s`;
  const two = n => String(n).padStart(2, "0");
  const minutes = Math.floor(whole / MINUTE) % 60;
  if (whole < HOUR) return `${minutes}:${two(whole % 60)}${rest}`;
  return `${Math.floor(whole / HOUR)}:${two(minutes)}:${two(whole % 60)}${rest}`;
};

// The unit that suits an axis of a length.
const unitOf = length =>
  length < 3 * MINUTE ? { name: "s", seconds: 1 } : length < 3 * HOUR ? { name: "min", seconds: MINUTE } : { name: "h", seconds: HOUR };

// Round values along an axis, about `wanted` of them.
const ticksOf = (low, high, wanted) => {
  const rough = (high - low) / Math.max(wanted, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map(n => n * power).find(n => n >= rough);
  const ticks = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + step * 1e-9; n++) ticks.push(Number((n * step).toPrecision(12)));
  return ticks;
};
const numberText = (value, decimals) => value.toFixed(decimals).replace("-", "−");
