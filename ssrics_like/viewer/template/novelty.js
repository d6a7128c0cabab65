// Novelty over time, its threshold, and below it a tick for each reflex in the row of its decision.
const DECISIONS = ["declared", "recognised", "unsure", "dismissed", "overwritten"];

class NoveltyPlot extends Plot {
  constructor(box) {
    const kinds = new Set(decisions.map(row => row.decision));
    const lanes = [...DECISIONS.filter(kind => kinds.has(kind)), ...[...kinds].filter(kind => !DECISIONS.includes(kind))];
    super(box, "novelty");
    this.lanes = lanes;
    this.laneHeight = 12;
    const source = data.novelty;
    [this.t, this.mean, this.least, this.largest] = [source.t, source.mean, source.least, source.largest].map(numbersOf);
    if (!this.t.length && !decisions.length) this.instead("The run ended before the first interval was complete.");
    this.low = 0;
    this.high = 1;
    box.style.minHeight = `${110 + lanes.length * this.laneHeight}px`;
  }

  resize() {
    super.resize();
    this.base = this.height - this.bottom - this.lanes.length * this.laneHeight - 5;
    this.lower = this.height - this.bottom;
  }

  paint(context) {
    this.axes(context, [0, 0.25, 0.5, 0.75, 1], value => String(value).replace("0.", "."));
    const count = this.t.length;
    if (count) {
      context.beginPath();
      for (let i = 0; i < count; i++) context.lineTo(this.px(this.t[i]), this.py(this.largest[i]));
      for (let i = count - 1; i >= 0; i--) context.lineTo(this.px(this.t[i]), this.py(this.least[i]));
      context.fillStyle = colours.band;
      context.fill();
      context.beginPath();
      for (let i = 0; i < count; i++) context.lineTo(this.px(this.t[i]), this.py(this.mean[i]));
      context.strokeStyle = colours.curve;
      context.lineWidth = 1.2;
      context.stroke();
    }
    const threshold = data.novelty.threshold;
    const name = `novel ≥ ${String(Number(threshold.toFixed(4))).replace("0.", ".")}`;
    const x = this.isNarrow ? this.left + 4 : this.left + this.inner + 4;
    this.limit(context, threshold, name, x, "left", this.isNarrow);
    this.lanes.forEach((kind, lane) => {
      const y = this.base + 5 + (lane + 0.5) * this.laneHeight;
      const rows = decisions.filter(row => row.decision === kind);
      const isMark = DECISIONS.indexOf(kind) < 2;
      context.font = `11px ${FONT}`;
      context.textAlign = "right";
      context.textBaseline = "middle";
      context.fillStyle = colours.muted;
      context.fillText(kind, this.left - 5, y);
      context.textAlign = "left";
      context.fillText(String(rows.length), this.left + this.inner + 4, y);
      context.strokeStyle = isMark ? colours.ink : colours.muted;
      context.lineWidth = isMark ? 1.6 : 1;
      context.beginPath();
      for (const row of rows) { const x = this.px(row.t); context.moveTo(x, y - 4); context.lineTo(x, y + 4); }
      context.stroke();
    });
  }

  // What novelty is at a moment, in words.
  said(t) {
    const at = lastUpTo(this.t.length, i => this.t[i], t);
    if (at < 0) return this.t.length ? "no interval yet" : "";
    const value = this.mean[at];
    return `${numberText(value, 2)}${value >= data.novelty.threshold ? ", novel" : ", not novel"}`;
  }
}
