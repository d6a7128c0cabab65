// What all steps share: the state from the server, the clock, the way on.
import { Outbox, newKey } from "/static/outbox.js";

const SAID = {
  saving: "Saving …", saved: "Saved", gone: "This session is over. Load the page again.",
  over: "This step is over. Load the page again.",
  refused: "An answer could not be saved. Load the page again to see what is.",
  lost: "An answer could not be saved. This page shows those that are.",
  waiting: "No connection. Your answers are kept here and sent later.",
};

const wait = ms => new Promise(resolve => setTimeout(resolve, ms));

export class Step {
  static async begin() {
    const step = new Step();
    step.state = await step.load();
    step.outbox = new Outbox(step.state.participant, state => step.show(state));
    if (step.outbox.waiting().length) {  // from before a reload
      await step.outbox.flush();
      const state = await step.load();
      if (state.step !== step.state.step) { location.reload(); await new Promise(() => {}); }
      step.state = state;
      if (step.outbox.refused) step.show("lost");  // and the page does not show it
      step.outbox.refused = "";
    }
    step.startClock();
    if (!step.state.begun) step.send("begin");
    return step;
  }

  async load() {
    for (let pause = 500; ; pause = Math.min(pause * 2, 8000)) {
      try {
        const answer = await fetch("/api/state", { cache: "no-store" });
        if (answer.ok) return await answer.json();
        if (answer.status === 401) { location.assign("/"); await new Promise(() => {}); }
      } catch { /* no connection */ }
      this.show("waiting");
      await wait(pause);
    }
  }

  show(state) {
    const place = document.getElementById("saved");
    place.textContent = SAID[state];
    place.dataset.state = state;
  }

  // The step's time goes on over a reload, and does not follow changes of the clock within one.
  startClock() {
    const name = `ssrics:${this.state.participant}:${this.state.step}:t0`;
    let began = Date.now();
    try {
      began = Number(localStorage.getItem(name)) || began;
      localStorage.setItem(name, String(began));
    } catch { /* then it begins anew */ }
    this.clockName = name;
    this.before = Math.max(0, Date.now() - began) - performance.now();
  }

  get ms() { return Math.max(0, this.before + performance.now()); }

  /** Send an event; returns its key at once. */
  send(event, more = {}) {
    const key = newKey();
    this.sent = this.outbox.add({ key, step: this.state.step, event, t_ms: this.ms, client_ms: Date.now(), ...more });
    return key;
  }

  /** End the step and show the next one. */
  async end(more = {}) {
    this.send("end", more);
    await this.sent;
    try { localStorage.removeItem(this.clockName); } catch { /* nothing was kept */ }
    location.assign("/");
  }
}
