import { post } from "/static/outbox.js";

document.getElementById("next")?.addEventListener("click", async () => {
  if (await post("/api/leave", {}) === 200) location.assign("/");
});
