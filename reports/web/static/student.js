"use strict";
const door = `../../api/student/${encodeURIComponent(location.pathname.split("/").filter(Boolean).at(-1))}`;
async function look() {
  const own = await ask(door);
  if (own.errors) { say($("errors"), own.errors); return; }
  $("who").textContent = `${own.student} — ${own.title}`;
  const words = [own.handed ? "работа сдана" : "работа ещё не сдана", own.status,
    own.points === null ? "" : `баллы: ${printed(own.points)}`];
  $("state").textContent = words.filter(Boolean).join("; ");
  $("book").href = `${door}/book`;
  $("book").download = own.file;
  $("page").hidden = !own.open;
  $("page").href = `${door}/page`;
}
addEventListener("DOMContentLoaded", () => {
  $("work").addEventListener("change", async event => {
    const file = event.target.files[0];
    if (file) say($("errors"), (await ask(`${door}/work`, file)).errors);
    event.target.value = "";
    look();
  });
  look();
});
