import { Step } from "/static/step.js";

const step = await Step.begin();
const done = document.getElementById("done");
done.disabled = false;
done.addEventListener("click", () => { done.disabled = true; step.end(); });
