// What stands in every buffer, and what the module behind it does.
const BUFFERS = ["g", "orienting", "retrieval", "imaginal", "landmark", "way"];
const ROLES = { g: "goal", orienting: "reflex", retrieval: "recalled", imaginal: "being built", landmark: "new landmark", way: "errand" };

class BufferPanel {
  constructor(list) {
    const there = data.story ? data.story.buffers : {};
    const names = [...BUFFERS.filter(name => name in there), ...Object.keys(there).filter(name => !BUFFERS.includes(name))];
    this.rows = names.map(name => {
      const head = made("dt", name);
      if (ROLES[name]) head.append(made("small", ROLES[name]));
      const body = made("dd");
      list.append(head, body);
      return { history: there[name], body, at: -2 };
    });
    if (!data.story) list.append(made("dd", "The scenario keeps no trace.", "empty"));
  }

  draw(t) {
    for (const row of this.rows) {
      const at = lastUpTo(row.history.length, i => row.history[i][0], t);
      if (at === row.at) continue;
      row.at = at;
      const [, chunk, state] = at < 0 ? [0, -1, "free"] : row.history[at];
      row.body.replaceChildren(...this.said(chunk, state));
    }
  }

  said(number, state) {
    const doing = { busy: "busy", error: "failure" }[state];
    if (number < 0) return [made("span", doing ? `empty; ${doing}` : "empty", "empty")];
    const [type, slots] = data.story.chunks[number];
    const line = made("span");
    line.append(made("b", type));
    for (const [slot, word] of slots) {
      const pair = made("span");
      pair.append(made("i", slot), ` ${word}`);
      line.append(" ", pair);
    }
    return [line];
  }
}
