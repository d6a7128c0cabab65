import { Step } from "/static/step.js";

const step = await Step.begin();
const keys = document.getElementById("keys");
let over = false;

function press(key) {
  if (over) return;
  over = true;
  step.send("press", { pressed: key });
  step.end();
}

// For those without a keyboard: the right key among three others, in alphabetical order.
const letters = "abcdefghjkmnpqrstuvwxyz23456789";
const at = letters.indexOf(step.state.key);
const shown = new Set([step.state.key]);
for (let i = 1; shown.size < 4; i++) shown.add(letters[(at + 7 * i + letters.length) % letters.length]);
for (const key of [...shown].sort()) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = key;
  button.addEventListener("click", () => press(key));
  keys.append(button);
}
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.altKey || event.metaKey || event.repeat) return;
  if (/^[a-z0-9]$/i.test(event.key)) press(event.key.toLowerCase());
});
