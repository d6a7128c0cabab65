// Where on the screen a place of the plan is. Places are metres right of and below its corner.

const MARGIN_PX = 14;
const KEPT_PX = 80;  // of the plan that stay in sight
const CLOSEST = 400;  // pixels a metre

export class View {
  constructor(width, height) {
    this.width = width;  // of the plan, metres
    this.height = height;
    this.scale = 1;  // pixels a metre
    this.x = 0;  // of the plan's corner, pixels
    this.y = 0;
    this.size = { width: 1, height: 1 };  // of the window, pixels
    this.whole = true;
  }

  toScreen(right, down) { return [this.x + right * this.scale, this.y + down * this.scale]; }
  toPlan(x, y) { return [(x - this.x) / this.scale, (y - this.y) / this.scale]; }
  isOn(right, down) { return right >= 0 && down >= 0 && right <= this.width && down <= this.height; }

  get smallest() {
    const { width, height } = this.size;
    return Math.max(1, Math.min((width - 2 * MARGIN_PX) / this.width, (height - 2 * MARGIN_PX) / this.height));
  }

  resize(width, height) {
    const middle = this.toPlan(this.size.width / 2, this.size.height / 2);
    this.size = { width, height };
    if (this.whole) { this.fit(); return; }
    this.x = width / 2 - middle[0] * this.scale;
    this.y = height / 2 - middle[1] * this.scale;
    this.hold();
  }

  fit() {
    this.scale = this.smallest;
    this.x = (this.size.width - this.width * this.scale) / 2;
    this.y = (this.size.height - this.height * this.scale) / 2;
    this.whole = true;
  }

  /** Zoom by a factor; what is at (x, y) on the screen stays there. */
  zoom(factor, x = this.size.width / 2, y = this.size.height / 2) {
    const scale = Math.min(CLOSEST, Math.max(this.smallest, this.scale * factor));
    if (scale === this.smallest) { this.fit(); return; }
    const [right, down] = this.toPlan(x, y);
    this.scale = scale;
    this.x = x - right * scale;
    this.y = y - down * scale;
    this.whole = false;
    this.hold();
  }

  pan(dx, dy) {
    this.x += dx;
    this.y += dy;
    this.whole = false;
    this.hold();
  }

  hold() {
    const within = (at, window, plan) =>
      Math.min(window - Math.min(KEPT_PX, plan), Math.max(Math.min(KEPT_PX, plan) - plan, at));
    this.x = within(this.x, this.size.width, this.width * this.scale);
    this.y = within(this.y, this.size.height, this.height * this.scale);
  }

  /** Shift so that a place is in sight. */
  reveal(right, down) {
    const [x, y] = this.toScreen(right, down);
    const off = (at, size) => Math.max(30 - at, 0) + Math.min(size - 30 - at, 0);
    const [dx, dy] = [off(x, this.size.width), off(y, this.size.height)];
    if (dx || dy) this.pan(dx, dy);
  }
}
