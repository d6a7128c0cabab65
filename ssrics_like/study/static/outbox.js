// Responses on their way: kept in this browser until the server has said that they are saved.

const tab = crypto.getRandomValues(new Uint32Array(2)).reduce((text, n) => text + n.toString(36), "");
let made = 0;
let sending = null;
let stopped = false;

/** Return a name that no other response has. */
export const newKey = () => `r-${tab}-${(made++).toString(36)}-${Date.now().toString(36)}`;

const wait = ms => new Promise(resolve => setTimeout(resolve, ms));

export class Outbox {
  constructor(participant, onState) {
    this.place = `ssrics:${participant}`;
    this.onState = onState;
    this.memory = [];  // where the browser keeps nothing
    this.refused = "";  // "over": the step is; "refused": an answer was not taken
    window.addEventListener("online", () => this.flush());
    document.addEventListener("visibilitychange", () => this.flush());
  }

  // Read anew each time: another tab may have written.
  waiting() {
    try { return JSON.parse(localStorage.getItem(this.place) ?? "[]"); } catch { return this.memory; }
  }

  keep(items) {
    this.memory = items;
    try {
      if (items.length) localStorage.setItem(this.place, JSON.stringify(items));
      else localStorage.removeItem(this.place);
    } catch { /* storage is full or forbidden: memory has to do */ }
  }

  add(response) {
    this.keep([...this.waiting(), response]);
    return this.flush();
  }

  /** Send all that waits, in its order; resolves when nothing is left. */
  flush() {
    sending ??= this.sendAll().finally(() => { sending = null; });
    return sending.then(() => (this.waiting().length && !stopped ? this.flush() : undefined));
  }

  async sendAll() {
    for (let pause = 500; this.waiting().length && !stopped;) {
      const first = this.waiting()[0];
      this.onState("saving");
      const status = await post("/api/responses", first);
      if (status === 0 || status === 429 || status >= 500) {
        if (status !== 429) this.onState("waiting");
        await wait(pause);
        pause = Math.min(pause * 2, 8000);
        continue;
      }
      pause = 500;
      if (status === 401) { stopped = true; this.onState("gone"); return; }
      // Saved, or never to be taken; then it is not called saved.
      if (status === 409) this.refused ||= "over";
      else if (status >= 400) this.refused = "refused";
      this.keep(this.waiting().filter(each => each.key !== first.key));
    }
    if (!stopped) this.onState(this.refused || "saved");
  }
}

/** Post JSON; returns the status of the answer, 0 where there was none. */
export async function post(address, data) {
  try {
    const answer = await fetch(address, {
      method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(data), keepalive: true,
    });
    await answer.arrayBuffer();
    return answer.status;
  } catch {
    return 0;
  }
}
