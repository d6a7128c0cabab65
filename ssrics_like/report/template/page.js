"use strict";
// Sort a table by the column whose heading is clicked; once more turns the order round.
for (const table of document.querySelectorAll("table.sortable")) {
  table.querySelectorAll("thead th").forEach((heading, column) => {
    const button = heading.querySelector("button");
    if (!button) return;
    button.addEventListener("click", () => {
      const rising = heading.getAttribute("aria-sort") !== "ascending";
      for (const other of table.querySelectorAll("thead th")) other.setAttribute("aria-sort", "none");
      heading.setAttribute("aria-sort", rising ? "ascending" : "descending");
      const key = row => {
        const text = row.children[column].dataset.key;
        const number = Number(text.replace("inf", "Infinity"));
        return Number.isNaN(number) ? text : number;
      };
      const body = table.tBodies[0];
      const rows = Array.from(body.rows).sort((a, b) => {
        const [x, y] = [key(a), key(b)];
        return (x > y ? 1 : x < y ? -1 : 0) * (rising ? 1 : -1);
      });
      body.append(...rows);
    });
  });
}
// A landmark's row and its marker on the map and in the graph light up together.
const light = (index, on) => {
  for (const figure of ["map", "graph"]) {
    const marker = document.getElementById(`${figure}-lm${index}`);
    if (marker) marker.classList.toggle("lit", on);
  }
  const row = document.querySelector(`tr[data-mark="${index}"]`);
  if (row) row.classList.toggle("lit", on);
};
for (const row of document.querySelectorAll("tr[data-mark]")) {
  const index = row.dataset.mark;
  const places = [row];
  for (const figure of ["map", "graph"]) {
    const marker = document.getElementById(`${figure}-lm${index}`);
    if (marker) places.push(marker);
  }
  for (const place of places) {
    place.addEventListener("mouseenter", () => light(index, true));
    place.addEventListener("mouseleave", () => light(index, false));
  }
}
