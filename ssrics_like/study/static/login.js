// The token may come after the # of the address, which browsers send to nobody.
const form = document.getElementById("login");
const field = document.getElementById("token");
const problem = document.getElementById("problem");

async function login(token) {
  try {
    const answer = await fetch("/admin/login", {
      method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ token }),
    });
    if (answer.ok) { location.replace("/admin"); return; }
    problem.textContent = (await answer.json()).detail;
  } catch {
    problem.textContent = "The server cannot be reached.";
  }
}

form.addEventListener("submit", event => { event.preventDefault(); login(field.value.trim()); });
const given = new URLSearchParams(location.hash.slice(1)).get("token");
if (given) {
  history.replaceState(null, "", "/admin");
  login(given);
}
