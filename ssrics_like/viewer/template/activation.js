// Base levels of landmark chunks over time; the most visited ones in colours, with their names.
const FAR_BELOW = 1.5; // a threshold lower than this many times the span of the levels is only named

class ActivationPlot extends Plot {
  constructor(box) {
    super(box, "base level");
    this.t = numbersOf(data.activation.t);
    this.lines = data.activation.levels.map(([name, colour, levels]) => ({ name, colour, levels: numbersOf(levels) }));
    if (!this.lines.length) this.instead(landmarks.length ? "The rule set keeps no landmark in declarative memory." : "No landmark was declared in this run.");
    let [low, high] = [Infinity, -Infinity];
    for (const { levels } of this.lines) for (const level of levels) if (level === level) { low = Math.min(low, level); high = Math.max(high, level); }
    const { threshold } = data.activation;
    this.hasThreshold = threshold > low - FAR_BELOW * Math.max(high - low, 0.5);
    if (this.hasThreshold) [low, high] = [Math.min(low, threshold), Math.max(high, threshold)];
    const margin = 0.06 * Math.max(high - low, 0.5);
    [this.low, this.high] = [low - margin, high + margin];
  }

  resize() {
    super.resize();
    this.lower = this.base = this.height - this.bottom;
  }

  paint(context) {
    this.axes(context, ticksOf(this.low, this.high, 4), value => numberText(value, Number.isInteger(value) ? 0 : 1));
    for (const { levels, colour } of [...this.lines].reverse()) {
      context.strokeStyle = colour ? lighter(colour) : colours.rule;
      context.lineWidth = colour ? 1.4 : 0.8;
      context.beginPath();
      let isOn = false;
      for (let i = 0; i < levels.length; i++) {
        if (levels[i] !== levels[i]) { isOn = false; continue; }
        const [x, y] = [this.px(this.t[i]), this.py(levels[i])];
        if (isOn) context.lineTo(x, y); else context.moveTo(x, y);
        isOn = true;
      }
      context.stroke();
    }
    if (this.hasThreshold) this.limit(context, data.activation.threshold, "retrieval threshold", this.left + 6, "left", true);
    this.names(context);
  }

  // Names at the ends of the coloured lines, spread so that none lies over another.
  names(context) {
    const ends = this.lines.filter(line => line.colour).map(line => {
      let last = line.levels.length - 1;
      while (last > 0 && line.levels[last] !== line.levels[last]) last--;
      return { ...line, y: this.py(line.levels[last]) };
    }).sort((a, b) => a.y - b.y);
    const gap = 11;
    const room = Math.max(Math.floor((this.base - this.top) / gap), 1);
    const shown = ends.slice(0, room);
    shown.forEach((line, i) => { line.at = Math.max(line.y, i ? shown[i - 1].at + gap : this.top + 5); });
    for (let i = shown.length - 1, most = this.base - 4; i >= 0; i--, most -= gap) {
      if (shown[i].at <= most) break;
      shown[i].at = most;
    }
    context.font = `600 10.5px ${FONT}`;
    context.textAlign = "left";
    context.textBaseline = "middle";
    const x = this.left + this.inner;
    for (const { name, colour, y, at } of shown) {
      context.strokeStyle = context.fillStyle = lighter(colour);
      context.lineWidth = 0.7;
      context.beginPath();
      context.moveTo(x + 1, y);
      context.lineTo(x + 9, at);
      context.stroke();
      context.fillText(name, x + 11, at);
    }
  }

  // How well landmarks are remembered at a moment, in words.
  said(t) {
    const at = lastUpTo(this.t.length, i => this.t[i], t);
    if (this.isEmpty) return "";
    const known = at < 0 ? [] : this.lines.filter(({ levels }) => levels[at] === levels[at]).sort((a, b) => b.levels[at] - a.levels[at]);
    if (!known.length) return "none yet";
    const said = known.slice(0, 3).map(({ name, levels }) => `${name} ${numberText(levels[at], 2)}`).join(" · ");
    const below = this.hasThreshold ? "" : `; threshold ${numberText(data.activation.threshold, 0)} lies far below`;
    return `${said}${known.length > 3 ? " …" : ""}${below}`;
  }
}

// The report's colours are made for white paper; on a dark page they are mixed with white.
const lighter = hex => {
  if (!matchMedia("(prefers-color-scheme: dark)").matches) return hex;
  const mixed = partsOf(hex).map(part => Math.round(part + (255 - part) * 0.45));
  return `rgb(${mixed.join(" ")})`;
};
