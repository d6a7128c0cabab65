// The map in four layers; each is drawn anew only when what it shows has changed.
class MapView {
  constructor(stage, moved) {
    this.stage = stage;
    this.layers = ["ground", "past", "marks", "now"].map(name => element(`map-${name}`));
    [this.ground, this.past, this.marks, this.now] = this.layers;
    this.camera = new Camera();
    this.moved = moved; // called where the view has changed without time going on
    this.pictures = {};
    this.touched = false; // whether the user has chosen what is shown
    this.forget();
  }

  // Load the pictures that came with the page.
  load() {
    const wanted = [["map", data.map], ["walls", data.walls]].filter(([, source]) => source);
    return Promise.all(wanted.map(([name, source]) => {
      const image = new Image();
      image.src = `data:image/png;base64,${source.png}`;
      return image.decode().then(() => { this.pictures[name] = image; });
    })).then(() => this.paint());
  }

  // Give the pictures the page's colours.
  paint() {
    const level = { 0: [...partsOf(colours.free), 255], 100: [...partsOf(colours.wall), 255] };
    const seen = partsOf(colours.seen);
    this.plan = this.pictures.map && coloured(this.pictures.map, grey => level[grey] || [0, 0, 0, 0]);
    this.walls = this.pictures.walls && coloured(this.pictures.walls, grey => [...seen, grey]);
    this.forget();
  }

  // Have every layer drawn anew.
  forget() {
    this.isFresh = false;
    this.until = -1; // index of the last pose on the layer of the path
    this.shown = ""; // what the layer of landmarks shows
  }

  // What the whole map is: the known cells of a plan, else walls and path.
  bounds() {
    let box = [Infinity, -Infinity, Infinity, -Infinity];
    const add = (x, y) => { box = [Math.min(box[0], x), Math.max(box[1], x), Math.min(box[2], y), Math.max(box[3], y)]; };
    for (let i = 0; i < path.x.length; i++) add(path.x[i], path.y[i]);
    for (const mark of landmarks) add(mark.x, mark.y);
    if (data.walls) { add(data.walls.left, data.walls.bottom); add(data.walls.right, data.walls.top); }
    if (data.map) {
      const { rows, columns, cell_m: cell, origin: [x, y, theta] } = data.map;
      const [cos, sin] = [Math.cos(theta), Math.sin(theta)];
      for (const [u, v] of [[0, 0], [columns * cell, 0], [0, rows * cell], [columns * cell, rows * cell]]) add(x + cos * u - sin * v, y + sin * u + cos * v);
    }
    return box;
  }

  whole() {
    this.touched = false;
    this.camera.show(this.bounds());
    this.forget();
  }

  // Take the size of the stage; a canvas that changes its size is empty.
  resize() {
    const box = this.stage.getBoundingClientRect();
    let changed = false;
    for (const canvas of this.layers) changed = fit(canvas) || changed;
    if (!changed) return;
    this.camera.width = box.width;
    this.camera.height = box.height;
    if (this.touched) this.forget(); else this.whole();
  }

  draw(index, t, options) {
    if (options.follow) this.keepInside(index);
    if (!this.isFresh) this.drawGround();
    this.drawPast(index);
    this.drawMarks(t, options);
    this.drawNow(index, t, options);
  }

  keepInside(index) {
    const { camera } = this;
    const [x, y] = [camera.px(path.x[index]), camera.py(path.y[index])];
    const [sideX, sideY] = [camera.width * 0.22, camera.height * 0.22];
    if (x > sideX && x < camera.width - sideX && y > sideY && y < camera.height - sideY) return;
    camera.x = path.x[index];
    camera.y = path.y[index];
    this.touched = true;
    this.forget();
  }

  drawGround() {
    const context = cleared(this.ground);
    const { camera } = this;
    context.imageSmoothingEnabled = camera.scale < 30;
    if (this.plan) {
      const { rows, columns, cell_m: cell, origin: [x, y, theta] } = data.map;
      context.save();
      camera.metres(context);
      context.translate(x, y);
      context.rotate(theta);
      context.scale(1, -1);
      context.drawImage(this.plan, 0, -rows * cell, columns * cell, rows * cell);
      context.restore();
    }
    if (this.walls) {
      const { left, right, bottom, top } = data.walls;
      context.drawImage(this.walls, camera.px(left), camera.py(top), (right - left) * camera.scale, (top - bottom) * camera.scale);
    }
    context.strokeStyle = colours.ahead;
    context.lineWidth = 1.2;
    this.trace(context, 0, path.x.length - 1);
    this.drawScale(context);
    this.isFresh = true;
  }

  // Draw the path between two of its poses; not across where the robot was carried.
  trace(context, from, to) {
    const { camera } = this;
    context.lineJoin = "round";
    context.beginPath();
    let [lastX, lastY] = [camera.px(path.x[from]), camera.py(path.y[from])];
    context.moveTo(lastX, lastY);
    for (let i = from + 1; i <= to; i++) {
      const x = camera.px(path.x[i]), y = camera.py(path.y[i]);
      if (path.landings.has(i)) { context.moveTo(x, y); [lastX, lastY] = [x, y]; continue; }
      if (i < to && Math.abs(x - lastX) + Math.abs(y - lastY) < 0.8) continue; // below a pixel
      context.lineTo(x, y);
      [lastX, lastY] = [x, y];
    }
    context.stroke();
  }

  drawScale(context) {
    const { camera } = this;
    const most = Math.min(camera.width * 0.2, 120) / camera.scale;
    const power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].map(n => n * power).find(n => n <= most);
    const [x, y, wide] = [16, camera.height - 14, length * camera.scale];
    context.fillStyle = colours.surface;
    context.globalAlpha = 0.92;
    context.beginPath();
    context.roundRect(x - 8, y - 19, wide + 16, 26, 5);
    context.fill();
    context.globalAlpha = 1;
    context.strokeStyle = colours.ink;
    context.lineWidth = 1.4;
    context.beginPath();
    for (const [px, py] of [[x, y - 4], [x, y], [x + wide, y], [x + wide, y - 4]]) context.lineTo(px, py);
    context.stroke();
    this.write(context, `${length} m`, x + wide / 2, y - 9, "center", "500 11px");
  }

  // Write with a rim, to be read on lines and walls.
  write(context, text, x, y, align = "left", size = "600 12px") {
    context.font = `${size} ${FONT}`;
    context.textAlign = align;
    context.textBaseline = "middle";
    context.lineJoin = "round";
    context.lineWidth = 3;
    context.strokeStyle = colours.halo;
    context.strokeText(text, x, y);
    context.fillStyle = colours.ink;
    context.fillText(text, x, y);
  }

  drawPast(index) {
    if (index === this.until) return;
    const isOn = this.until >= 0 && index > this.until;
    const context = isOn ? this.past.getContext("2d") : cleared(this.past);
    context.strokeStyle = colours.past;
    context.lineWidth = 2;
    if (index > 0) this.trace(context, isOn ? this.until : 0, index);
    this.until = index;
  }

  drawMarks(t, { graph }) {
    const there = landmarks.filter(mark => mark.t <= t);
    const arcs = graph ? data.arcs.filter(([, , came]) => came <= t) : [];
    const shown = `${there.length} ${arcs.length} ${graph}`;
    if (shown === this.shown) return;
    this.shown = shown;
    const context = cleared(this.marks);
    const { camera } = this;
    for (const [from, to, , isKnown] of arcs) this.drawArc(context, landmarkOf.get(from), landmarkOf.get(to), isKnown);
    const spots = there.map(mark => ({ ...mark, x: camera.px(mark.x), y: camera.py(mark.y) }));
    for (const { x, y, sector } of spots) {
      context.beginPath();
      context.arc(x, y, 5.5, 0, 2 * Math.PI);
      context.fillStyle = sectorColour(sector);
      context.fill();
      context.lineWidth = 1.5;
      context.strokeStyle = colours.halo;
      context.stroke();
    }
    context.font = `600 12px ${FONT}`;
    const names = placed(spots, name => context.measureText(name).width, camera);
    for (const { name, x, y } of names) this.write(context, name, x, y);
  }

  // An arc from landmark to landmark, bent a little, so that the way back is beside it.
  drawArc(context, from, to, isKnown) {
    if (!from || !to) return;
    const { camera } = this;
    const [x0, y0, x1, y1] = [camera.px(from.x), camera.py(from.y), camera.px(to.x), camera.py(to.y)];
    const length = Math.hypot(x1 - x0, y1 - y0);
    if (length < 14) return;
    const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
    const bend = Math.min(length * 0.12, 26);
    const [cx, cy] = [(x0 + x1) / 2 - uy * bend, (y0 + y1) / 2 + ux * bend];
    const turn = Math.atan2(y1 - cy, x1 - cx);
    const [tipX, tipY] = [x1 - 8 * Math.cos(turn), y1 - 8 * Math.sin(turn)];
    context.strokeStyle = colours.arc;
    context.fillStyle = colours.arc;
    context.lineWidth = 1.3;
    context.setLineDash(isKnown ? [] : [4, 4]);
    context.beginPath();
    context.moveTo(x0, y0);
    context.quadraticCurveTo(cx, cy, tipX, tipY);
    context.stroke();
    context.setLineDash([]);
    context.beginPath();
    context.moveTo(tipX, tipY);
    for (const side of [-0.4, 0.4]) context.lineTo(tipX - 7 * Math.cos(turn + side), tipY - 7 * Math.sin(turn + side));
    context.fill();
  }

  drawNow(index, t, { scan, lit }) {
    const context = cleared(this.now);
    const { camera } = this;
    if (scan && scans) this.drawScan(context, index);
    const mark = lit && landmarkOf.get(lit);
    if (mark) {
      context.beginPath();
      context.arc(camera.px(mark.x), camera.py(mark.y), 10, 0, 2 * Math.PI);
      context.strokeStyle = colours.robot;
      context.lineWidth = 2;
      context.stroke();
    }
    this.drawRobot(context, index);
  }

  drawScan(context, index) {
    const at = lastUpTo(scans.poses.length, i => scans.poses[i], index);
    if (at < 0) return;
    const { camera } = this;
    const pose = scans.poses[at];
    const [x, y, theta] = [camera.px(path.x[pose]), camera.py(path.y[pose]), path.theta[pose]];
    const unit = camera.scale / 100; // ranges are centimetres
    const from = at * scans.beams;
    const ends = [];
    for (let i = 0; i < scans.beams; i++) {
      const range = scans.ranges[from + i];
      if (range === NOTHING) { ends.push(null); continue; }
      const bearing = theta + scans.first + i * scans.step;
      ends.push([x + Math.cos(bearing) * range * unit, y - Math.sin(bearing) * range * unit]);
    }
    context.fillStyle = colours.beam;
    context.beginPath();
    context.moveTo(x, y);
    for (const end of ends) if (end) context.lineTo(end[0], end[1]); else context.lineTo(x, y);
    context.fill();
    context.fillStyle = colours.hit;
    for (const end of ends) if (end) context.fillRect(end[0] - 1.25, end[1] - 1.25, 2.5, 2.5);
  }

  drawRobot(context, index) {
    const { camera } = this;
    const theta = path.theta[index];
    const ahead = data.robot.laser_m;
    const x = camera.px(path.x[index] - ahead * Math.cos(theta)), y = camera.py(path.y[index] - ahead * Math.sin(theta));
    const size = Math.max((data.robot.radius_m || 0.25) * camera.scale, 8);
    context.save();
    context.translate(x, y);
    context.rotate(-theta);
    context.beginPath();
    if (data.robot.radius_m) context.arc(0, 0, size, 0, 2 * Math.PI);
    context.fillStyle = colours.halo;
    context.globalAlpha = 0.75;
    context.fill();
    context.globalAlpha = 1;
    context.strokeStyle = colours.robot;
    context.lineWidth = 1.8;
    context.stroke();
    context.beginPath();
    for (const [u, v] of [[0.9, 0], [-0.6, 0.6], [-0.3, 0], [-0.6, -0.6]]) context.lineTo(u * size, v * size);
    context.closePath();
    context.fillStyle = colours.robot;
    context.fill();
    context.restore();
  }

  // The pose of the path nearest to a pixel, within reach; among equals the nearest in time.
  poseAt(px, py, index) {
    const { camera } = this;
    let least = 16;
    const far = new Float32Array(path.x.length);
    for (let i = 0; i < far.length; i++) {
      far[i] = Math.hypot(camera.px(path.x[i]) - px, camera.py(path.y[i]) - py);
      if (far[i] < least) least = far[i];
    }
    let best = -1;
    for (let i = 0; i < far.length; i++) {
      if (far[i] <= least + 2 && far[i] <= 16 && (best < 0 || Math.abs(i - index) < Math.abs(best - index))) best = i;
    }
    return best;
  }
}
