// Which part of the plane is shown: metres of the map's frame to pixels of the stage.
class Camera {
  constructor() { this.scale = 1; this.x = 0; this.y = 0; this.width = 1; this.height = 1; }
  // Show a box of the plane whole.
  show([left, right, bottom, top]) {
    const margin = 18;
    this.scale = Math.min((this.width - 2 * margin) / Math.max(right - left, 2), (this.height - 2 * margin) / Math.max(top - bottom, 2));
    this.x = (left + right) / 2;
    this.y = (bottom + top) / 2;
  }
  px(x) { return (x - this.x) * this.scale + this.width / 2; }
  py(y) { return this.height / 2 - (y - this.y) * this.scale; }
  mx(px) { return (px - this.width / 2) / this.scale + this.x; }
  my(py) { return (this.height / 2 - py) / this.scale + this.y; }
  // Zoom by a factor; what is at a pixel stays there.
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [x, y] = [this.mx(px), this.my(py)];
    this.scale = Math.min(Math.max(this.scale * factor, 0.2), 2000);
    this.x = x - (px - this.width / 2) / this.scale;
    this.y = y + (py - this.height / 2) / this.scale;
  }
  // Move what is shown by so many pixels.
  move(dx, dy) { this.x -= dx / this.scale; this.y += dy / this.scale; }
  // Let a context draw in metres, y upwards.
  metres(context) { context.translate(this.px(0), this.py(0)); context.scale(this.scale, -this.scale); }
}
