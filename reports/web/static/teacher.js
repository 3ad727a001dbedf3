"use strict";
let chosen = "", timer = 0;
const door = () => `api/teacher/${chosen}`;
const told = answer => { say($("errors"), answer.errors); return !answer.errors; };

async function enter() {
  const answer = await ask("api/teacher");
  $("login").hidden = !answer.errors;
  $("inside").hidden = Boolean(answer.errors);
  if (answer.errors) return;
  if (!chosen) chosen = answer.classes[0]?.name || "";
  $("newClass").open = !chosen;
  $("classes").replaceChildren(...answer.classes.map(c =>
    make("option", {value: c.name, selected: c.name === chosen}, `${c.title}, ${c.date.slice(0, 10)}`)));
  look();
}

// A list in Windows-1251 is a list as well.
async function text(file) {
  if (!file) return "";
  const bytes = await file.arrayBuffer();
  try { return new TextDecoder("utf-8", {fatal: true}).decode(bytes); } catch { return new TextDecoder("windows-1251").decode(bytes); }
}

const picker = (title, accept, path) => make("label", {class: "button"}, title, make("input", {type: "file", class: "hidden", accept,
  onchange: async event => {
    const file = event.target.files[0];
    if (file && told(await ask(`${door()}/${path}`, file))) look(`${file.name}: загружено`);
  }}));
const link = (href, title, more = {}) => make("a", {href, ...more}, title);

function doing(state) {
  const words = {issue: "Выдача", grade: "Проверка"};
  if (state.doing) return `${words[state.doing[0]] || "Работа"} идёт…`;
  if (state.done === "issue" && state.code === 0) return "Варианты выданы.";
  if (state.done === "grade" && state.code in [0, 1]) return state.code ? "Проверено; есть работы, которые ждут вашего решения." : "Проверено.";
  return "";
}

async function look(news = "") {
  clearTimeout(timer);
  if (!chosen) return;
  const own = await ask(door());
  if (!told(own)) return;
  const busy = Boolean(own.state.doing), open = new Set([...document.querySelectorAll("#class details[open]")].map(d => d.id));
  if (document.activeElement?.closest?.("form.decide") && busy === look.busy && !news) { timer = setTimeout(look, 2000); return; }
  look.busy = busy;
  const failed = !busy && ![0, 1].includes(own.state.code);
  $("class").replaceChildren(
    make("p", {role: "status", class: failed ? "bad" : ""}, [news, doing(own.state), busy && own.graded ? `готово файлов: ${own.graded}` : ""].filter(Boolean).join(" ")),
    make("ul", {class: failed ? "errors" : "warnings"}, ...(own.state.lines || []).map(l => make("li", {}, l))),
    make("p", {class: "tools"}, ...(own.students.length ? [
      link(`${door()}/file/issued.zip`, "Рабочие книги .zip", {class: "button", download: "issued.zip"}),
      picker("Загрузить архив работ .zip", ".zip", "works"), picker("Ведомость Moodle .csv", ".csv", "worksheet"),
      make("button", {disabled: busy, id: "grade", onclick: async () => { if (told(await ask(`${door()}/grade`, {}))) look(); }}, "Проверить"),
      make("label", {}, make("input", {type: "checkbox", id: "open", checked: own.open,
        onchange: async e => told(await ask(`${door()}/open`, {open: e.target.checked}))}), " студенты видят свои страницы")] : [])),
    make("p", {class: "tools", id: "results"}, ...own.files.map(name => link(`${door()}/file/${name}`, name, name.endsWith(".html") ? {target: "_blank"} : {download: name}))),
    ...(own.rows.length ? [table(own)] : []),
    ...(own.students.length ? [make("details", {id: "links", open: open.has("links") || !own.rows.length}, make("summary", {}, "Ссылки студентов"),
      make("ul", {}, ...own.students.map(s => make("li", {}, link(`s/${s.link}/`, s.name), s.group ? `, ${s.group}` : "", s.handed ? " — сдал здесь" : ""))))] : []));
  if (busy) timer = setTimeout(look, 1000);
}

function table(own) {
  return make("div", {class: "box"}, make("table", {}, make("caption", {}, "Ведомость"),
    make("thead", {}, make("tr", {}, ...["Студент", "Состояние", "Баллы", "Примечание", "Решение"].map(t => make("th", {scope: "col"}, t)))),
    make("tbody", {}, ...own.rows.map(row => make("tr", {class: row.manual ? "odd" : ""},
      make("td", {}, row.page && row.number ? link(`${door()}/page/${row.number}`, row.student, {target: "_blank"}) : row.student),
      make("td", {}, row.status), make("td", {class: "n"}, row.points === null ? (row.provisional === null ? "" : `(${printed(row.provisional)})`) : printed(row.points)),
      make("td", {}, row.remark), make("td", {}, row.number && row.page ? decision(row, own.unknown[row.number] || []) : ""))))));
}

function decision(row, items) {
  const what = make("select", {"aria-label": `Что решить: ${row.student}`}, make("option", {value: "всё"}, "вся работа"),
    ...items.map(item => make("option", {value: item}, item)));
  const points = make("input", {"aria-label": `Баллы: ${row.student}`, size: 5, placeholder: "баллы, + или -", required: true});
  const remark = make("input", {"aria-label": `Примечание: ${row.student}`, placeholder: "примечание", maxlength: 300});
  return make("form", {class: "decide", onsubmit: async event => {
    event.preventDefault();
    document.activeElement.blur();
    if (told(await ask(`${door()}/decide`, {who: String(row.number), what: what.value, points: points.value, remark: remark.value}))) look("Решение принято.");
  }}, what, points, remark, make("button", {}, "Решить"));
}

addEventListener("DOMContentLoaded", async () => {
  $("login").addEventListener("submit", async event => {
    event.preventDefault();
    if (told(await ask("api/login", {token: $("token").value}))) enter();
  });
  $("issue").addEventListener("submit", async event => {
    event.preventDefault();
    const answer = await ask("api/teacher", {title: $("title").value, base: await text($("base").files[0]), roster: await text($("roster").files[0]),
      rubric: await text($("rubric").files[0]), seed: Number($("seed").value)});
    if (told(answer)) { chosen = answer.name; event.target.reset(); enter(); }
  });
  $("classes").addEventListener("change", () => { chosen = $("classes").value; look(); });
  if (location.hash.length > 1) { // the printed address: the key goes to no log
    const token = decodeURIComponent(location.hash.slice(1));
    history.replaceState(null, "", location.pathname);
    told(await ask("api/login", {token}));
  }
  enter();
});
