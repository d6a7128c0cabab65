// Margins are the same for all plots, so that moments stand above one another.
const NARROW = 520;
const marginsOf = width => (width < NARROW ? { left: 80, right: 32, top: 6, bottom: 34 } : { left: 92, right: 74, top: 6, bottom: 22 });

// A curve over time: drawn once; only the cursor moves. A click goes to that moment.
class Plot {
  constructor(box, label) {
    Object.assign(this, { box, label }, marginsOf(NARROW));
    this.canvas = made("canvas");
    this.veil = made("div", "", "veil"); // over what is still to come
    this.cursor = made("div", "", "cursor");
    box.append(this.canvas, this.veil, this.cursor);
    this.isFresh = false;
  }

  // Say why there is no curve.
  instead(text) {
    this.box.replaceChildren(made("p", text, "nothing"));
    this.isEmpty = true;
  }

  // Take the size of the box.
  resize() {
    if (fit(this.canvas)) this.isFresh = false;
    const { width, height } = this.box.getBoundingClientRect();
    Object.assign(this, { width, height, isNarrow: width < NARROW }, marginsOf(width));
    Object.assign(this, { inner: Math.max(width - this.left - this.right, 1), lower: height - this.bottom });
    for (const bar of [this.veil, this.cursor]) { bar.style.top = `${this.top}px`; bar.style.height = `${this.lower - this.top}px`; }
    this.veil.style.width = `${this.inner}px`;
    this.veil.style.left = `${this.left}px`;
  }

  px(t) { return this.left + (t / end) * this.inner; }
  py(value) { return this.base - ((value - this.low) / (this.high - this.low)) * (this.base - this.top); }

  draw(t) {
    if (this.isEmpty) return;
    if (!this.isFresh) {
      this.paint(cleared(this.canvas));
      this.isFresh = true;
    }
    const x = this.px(t);
    this.cursor.style.transform = `translateX(${x - 0.75}px)`;
    this.veil.style.transform = `scaleX(${Math.max(1 - t / end, 0)})`;
  }

  // The frame: grid and numbers of the values, time below, what they are.
  axes(context, ticks, text) {
    context.font = `11px ${FONT}`;
    context.lineWidth = 1;
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const value of ticks) {
      const y = Math.round(this.py(value)) + 0.5;
      context.strokeStyle = colours.grid;
      context.beginPath();
      context.moveTo(this.left, y);
      context.lineTo(this.left + this.inner, y);
      context.stroke();
      context.fillStyle = colours.muted;
      context.fillText(text(value), this.left - 5, y);
    }
    const unit = unitOf(end);
    context.textAlign = "center";
    context.textBaseline = "top";
    const foot = this.lower;
    for (const tick of ticksOf(0, end / unit.seconds, this.inner / 70)) {
      const x = this.px(tick * unit.seconds);
      context.strokeStyle = colours.rule;
      context.beginPath();
      context.moveTo(x, foot);
      context.lineTo(x, foot + 4);
      context.stroke();
      context.fillText(String(tick), x, foot + 5);
    }
    context.textAlign = this.isNarrow ? "right" : "left";
    context.fillText(`time, ${unit.name}`, this.left + this.inner + (this.isNarrow ? 0 : 16), foot + (this.isNarrow ? 18 : 5));
    context.strokeStyle = colours.rule;
    context.beginPath();
    context.moveTo(this.left + 0.5, this.top);
    context.lineTo(this.left + 0.5, foot + 0.5);
    context.lineTo(this.left + this.inner, foot + 0.5);
    context.stroke();
    context.save();
    context.translate(this.left - 40, (this.top + this.base) / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText(this.label, 0, 0);
    context.restore();
  }

  // A dashed line at a limit; its name is written where `above` says.
  limit(context, value, name, x, align, above) {
    const y = this.py(value);
    context.strokeStyle = colours.limit;
    context.lineWidth = 1.2;
    context.setLineDash([5, 3]);
    context.beginPath();
    context.moveTo(this.left, y);
    context.lineTo(this.left + this.inner, y);
    context.stroke();
    context.setLineDash([]);
    context.fillStyle = colours.limit;
    context.font = `600 11px ${FONT}`;
    context.textAlign = align;
    context.textBaseline = above ? "bottom" : "middle";
    context.strokeStyle = colours.surface; // a rim, to be read on the curve
    context.lineWidth = 3;
    context.strokeText(name, x, above ? y - 2 : y);
    context.fillText(name, x, above ? y - 2 : y);
  }

  listen(chosen) {
    const go = event => {
      const x = event.clientX - this.box.getBoundingClientRect().left;
      chosen(Math.min(Math.max((x - this.left) / this.inner, 0), 1) * end);
    };
    let isHeld = false;
    this.box.addEventListener("pointerdown", event => { isHeld = true; this.box.setPointerCapture(event.pointerId); go(event); });
    this.box.addEventListener("pointermove", event => { if (isHeld) go(event); });
    for (const name of ["pointerup", "pointercancel"]) this.box.addEventListener(name, () => { isHeld = false; });
  }
}
