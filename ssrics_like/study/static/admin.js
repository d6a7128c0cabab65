if (location.hash) history.replaceState(null, "", "/admin");
document.getElementById("reload").addEventListener("click", () => location.reload());
document.getElementById("logout").addEventListener("click", async () => {
  await fetch("/admin/logout", { method: "POST" });
  location.reload();
});
setInterval(() => { if (!document.hidden) location.reload(); }, 10_000);
