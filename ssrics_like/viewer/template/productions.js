// The production that fired last, and for every other rule the first condition that kept it back.
class ProductionPanel {
  constructor() {
    this.story = data.story;
    this.body = element("production");
    this.list = element("verdicts");
    this.fired = -2;
    this.judged = null;
    element("others").hidden = !this.story;
    if (!this.story) this.body.replaceChildren(made("p", "The scenario keeps no trace, so that it is not known which productions fired.", "nothing"));
  }

  // Index of the last firing up to a moment.
  firing(t) { return this.story ? lastUpTo(this.story.firings.length, i => this.story.firings[i][0], t) : -1; }

  draw(t) {
    if (!this.story) return;
    const at = this.firing(t);
    if (at !== this.fired) {
      this.fired = at;
      this.show(at);
    }
    const ago = at < 0 ? "" : `at ${timeText(this.story.firings[at][0], 2)}`;
    if (element("fired-when").textContent !== ago) element("fired-when").textContent = ago;
    if (element("others").open) this.explain(t, at);
  }

  show(at) {
    if (at < 0) {
      this.body.replaceChildren(made("p", "None has fired yet.", "production"));
      return;
    }
    const [name, why] = data.rules[this.story.firings[at][1]] || ["?", "not in the rule set"];
    const line = made("p", "", "production");
    line.append(made("b", name), made("span", why));
    this.body.replaceChildren(line);
  }

  explain(t, at) {
    const isNow = element("others").querySelector('input[value="now"]').checked;
    const { resolutions, firings } = this.story;
    const which = isNow ? lastUpTo(resolutions.length, i => resolutions[i][0], t) : at < 0 ? -1 : firings[at][2];
    const key = `${which} ${isNow}`;
    if (key === this.judged) return;
    this.judged = key;
    if (which < 0) {
      element("judged-when").textContent = "";
      this.list.replaceChildren(made("li", "No conflict was resolved yet."));
      return;
    }
    const [when, selected, judgement] = resolutions[which];
    element("judged-when").textContent = `at ${timeText(when, 2)}`;
    this.list.replaceChildren(...this.story.judged[judgement].map((number, rule) => this.row(rule, this.story.verdicts[number], rule === selected)));
  }

  row(rule, [kind, condition, found], isSelected) {
    const item = made("li", "", isSelected ? "fired" : kind);
    const said = made("span");
    if (isSelected) said.append("selected: every condition holds");
    else if (kind === "holds") said.append(found ? `matched, but ${found}` : "every condition holds");
    else {
      if (kind === "unknown") said.append("cannot be judged: ");
      said.append(made("code", condition), ` – ${found}`);
    }
    item.append(made("b", data.rules[rule][0]), said);
    return item;
  }
}
