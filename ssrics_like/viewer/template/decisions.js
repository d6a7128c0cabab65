// A row for each reflex that was decided; a click goes to the decision.
class DecisionTable {
  constructor(box, chosen) {
    this.box = box;
    this.at = -2;
    if (!decisions.length) {
      box.append(made("p", "No reflex was decided in this run.", "nothing"));
      this.rows = [];
      return;
    }
    const table = made("table");
    const head = made("tr");
    for (const name of ["decided", "decision", "landmark", "seen", "rule"]) {
      const cell = made("th", name);
      cell.scope = "col";
      head.append(cell);
    }
    const top = made("thead");
    top.append(head);
    const body = made("tbody");
    this.rows = decisions.map((row, i) => {
      const line = made("tr", "", "later");
      const button = made("button", timeText(row.decided));
      button.type = "button";
      const first = made("td");
      first.append(button);
      const seen = made("td");
      const dot = made("span", "", "dot");
      dot.dataset.sector = row.sector;
      dot.title = row.sector;
      seen.append(dot, row.structure === "unknown" ? "" : row.structure);
      line.append(first, made("td", row.decision), made("td", row.landmark), seen, made("td", row.rule));
      line.addEventListener("click", () => chosen(row.decided));
      line.dataset.index = i;
      return line;
    });
    body.append(...this.rows);
    table.append(top, body);
    box.append(table);
  }

  draw(t) {
    const at = lastUpTo(decisions.length, i => decisions[i].decided, t);
    if (at === this.at) return;
    const [from, to] = [Math.max(Math.min(at, this.at), 0), Math.min(Math.max(at, this.at), this.rows.length - 1)];
    for (let i = from; i <= to; i++) this.rows[i].className = i < at ? "" : i === at ? "lit" : "later";
    this.at = at;
    element("decided-count").textContent = `${at + 1} of ${decisions.length}`;
    const row = this.rows[Math.max(at, 0)];
    if (!row) return;
    const [top, low] = [row.offsetTop - 2 * row.offsetHeight, row.offsetTop + 2 * row.offsetHeight];
    if (top < this.box.scrollTop || low > this.box.scrollTop + this.box.clientHeight) this.box.scrollTop = row.offsetTop - this.box.clientHeight / 2;
  }
}
