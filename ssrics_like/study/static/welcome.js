const form = document.getElementById("join");
const agree = document.getElementById("agree");
const problem = document.getElementById("problem");

form.addEventListener("submit", async event => {
  event.preventDefault();
  problem.textContent = "";
  if (!agree.checked) {
    problem.textContent = "Please tick the box if you want to take part.";
    agree.focus();
    return;
  }
  const said = {};
  const source = form.dataset.participant;
  if (source === "typed") said.participant = document.getElementById("participant").value.trim();
  if (source === "url") said.participant = new URLSearchParams(location.search).get("pid") ?? "";
  if (source !== "generated" && !/^[A-Za-z0-9._][A-Za-z0-9._@-]{0,63}$/.test(said.participant)) {
    problem.textContent = source === "url"
      ? "The address has no participant id that can be used (?pid=...). Please use the link that you were given."
      : "Please type your participant id: letters, digits, dots and dashes, a dash not first.";
    return;
  }
  const button = form.querySelector("button");
  button.disabled = true;
  try {
    const answer = await fetch("/api/join", {
      method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(said),
    });
    const answered = await answer.json();
    if (answer.ok) { location.assign("/"); return; }
    problem.textContent = answered.detail;
  } catch {
    problem.textContent = "The server cannot be reached. Please try again.";
  }
  button.disabled = false;
});
