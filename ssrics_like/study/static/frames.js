// The frames of a walk as the server packs them, and the clock that shows them.

const NOTHING = 0xffff;

export class Frames {
  constructor(buffer, { columns, beams, rate_hz: rate }) {
    this.data = new DataView(buffer);
    this.columns = columns;
    this.beams = beams;
    this.rate = rate;
    this.bytes = 2 * (2 * columns + beams) + columns;
    this.count = Math.floor(buffer.byteLength / this.bytes);
  }

  at(ms) {
    const start = this.bytes * Math.min(this.count - 1, Math.max(0, Math.floor(ms / 1000 * this.rate)));
    const { data, columns, beams } = this;
    const word = index => data.getUint16(start + 2 * index, true);
    const walls = [], furniture = [], fan = [];
    for (let i = 0; i < columns; i++) {
      const wall = word(i), near = word(columns + i);
      walls.push({
        far: Math.max((wall >> 1) / 1000, 0.02), side: wall & 1,
        panel: data.getUint8(start + 2 * (2 * columns + beams) + i) / 256,
      });
      furniture.push(near === NOTHING ? Infinity : Math.max(near / 1000, 0.02));
    }
    for (let i = 0; i < beams; i++) {
      const range = word(2 * columns + i);
      fan.push(range === NOTHING ? Infinity : range / 100);
    }
    return { walls, furniture, fan };
  }
}

/** Time of the replay: runs, stands, and never jumps over what nobody has seen. */
export class ReplayClock {
  constructor(ms, length) {
    this.base = ms;
    this.length = length;
    this.since = null;
  }

  get running() { return this.since !== null; }
  at(now) { return Math.min(this.length, this.base + (this.running ? Math.max(0, now - this.since) : 0)); }
  start(now) { this.since ??= now; }
  stop(now) {
    this.base = this.at(now);
    this.since = null;
  }
}
