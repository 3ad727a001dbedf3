"use strict";
let chosen = "", timer = 0, wasBusy = false;
const door = () => `api/teacher/${chosen}`;

async function enter() {
  const answer = await ask("api/teacher");
  $("login").hidden = !answer.errors;
  $("inside").hidden = Boolean(answer.errors);
  if (answer.errors) return;
  chosen ||= answer.classes[0]?.name || "";
  $("newClass").open = !chosen;
  $("classes").replaceChildren(...options(answer.classes.map(c => [c.name, `${c.title}, ${c.date.slice(0, 10)}`]), chosen));
  look();
}

// A list in Windows-1251 is a list as well.
async function text(file) {
  if (!file) return "";
  const bytes = await file.arrayBuffer();
  try { return new TextDecoder("utf-8", {fatal: true}).decode(bytes); } catch {
    return new TextDecoder("windows-1251").decode(bytes);
  }
}

async function act(path, data, news) {
  if (told(await ask(`${door()}/${path}`, data))) look(news);
}

function picker(title, accept, path) {
  const taken = ({target: {files: [file]}}) => file && act(path, file, `${file.name}: загружено`);
  return make("label", {class: "button"}, title, make("input", {type: "file", class: "hidden", accept, onchange: taken}));
}
const link = (href, title, more = {}) => make("a", {href: `${door()}/${href}`, ...more}, title);

function doing({doing, done, code}) {
  if (doing) return `${{issue: "Выдача", grade: "Проверка"}[doing[0]] || "Работа"} идёт…`;
  if (code !== 0 && code !== 1) return "";
  if (done === "issue") return code ? "" : "Варианты выданы.";
  return code ? "Проверено; есть работы, которые ждут вашего решения." : "Проверено.";
}

async function look(news = "") {
  clearTimeout(timer);
  if (!chosen) return;
  const own = await ask(door());
  if (!told(own)) return;
  const busy = Boolean(own.state.doing), failed = !busy && ![0, 1].includes(own.state.code);
  if (document.activeElement?.closest?.("form.decide") && busy === wasBusy && !news) { // a person writes
    timer = setTimeout(look, 2000);
    return;
  }
  wasBusy = busy;
  const closed = $("links") && !$("links").open;
  const status = [news, doing(own.state), busy && own.graded ? `готово файлов: ${own.graded}` : ""];
  $("class").replaceChildren(
    make("p", {role: "status", class: failed ? "bad" : ""}, status.filter(Boolean).join(" ")),
    make("ul", {class: failed ? "errors" : "warnings"}, ...(own.state.lines || []).map(l => make("li", {}, l))),
    ...(own.students.length ? [tools(own, busy)] : []),
    make("p", {class: "tools", id: "results"}, ...own.files.map(name =>
      link(`file/${name}`, name, name.endsWith(".html") ? {target: "_blank"} : {download: name}))),
    ...(own.rows.length ? [gradebook(own)] : []),
    ...(own.students.length ? [links(own, !closed)] : []));
  if (busy) timer = setTimeout(look, 1000);
}

const tools = (own, busy) => make("p", {class: "tools"},
  link("file/issued.zip", "Рабочие книги .zip", {class: "button", download: "issued.zip"}),
  picker("Загрузить архив работ .zip", ".zip", "works"), picker("Ведомость Moodle .csv", ".csv", "worksheet"),
  make("button", {disabled: busy, id: "grade", onclick: () => act("grade", {})}, "Проверить"),
  make("label", {}, make("input", {type: "checkbox", id: "open", checked: own.open,
    onchange: e => act("open", {open: e.target.checked})}), " студенты видят свои страницы"));

const links = (own, open) => make("details", {id: "links", open}, make("summary", {}, "Ссылки студентов"),
  make("ul", {}, ...own.students.map(s => make("li", {}, make("a", {href: `s/${s.link}/`}, s.name),
    s.group ? `, ${s.group}` : "", s.handed ? " — сдал здесь" : ""))));

function gradebook(own) {
  const head = ["Студент", "Состояние", "Баллы", "Примечание", "Решение"].map(t => make("th", {scope: "col"}, t));
  return table("Ведомость", own.rows.map(each => {
    const points = each.points ?? each.provisional, judged = each.number && each.page;
    const name = judged ? link(`page/${each.number}`, each.student, {target: "_blank"}) : each.student;
    return dressed(row([[name], [each.status], [each.points === null && points !== null ? `(${printed(points)})` : printed(points), "n"],
      [each.remark], [judged ? decision(each, own.unknown[each.number] || []) : ""]]), {class: each.manual ? "odd" : false}, []);
  }), make("thead", {}, make("tr", {}, ...head)));
}

// What waits for a person stands open; the rest is a click away.
function decision(each, items) {
  const what = make("select", {"aria-label": `Что решить: ${each.student}`},
    ...options([["всё", "вся работа"], ...items.map(item => [item, item])]));
  const points = make("input", {"aria-label": `Баллы: ${each.student}`, size: 12, placeholder: "баллы, + или -", required: true});
  const remark = make("input", {"aria-label": `Примечание: ${each.student}`, placeholder: "примечание", maxlength: 300});
  const decide = event => {
    event.preventDefault();
    document.activeElement.blur();
    act("decide", {who: String(each.number), what: what.value, points: points.value, remark: remark.value}, "Решение принято.");
  };
  return make("details", {open: each.manual}, make("summary", {"aria-label": `Решить: ${each.student}`}, "Решить"),
    make("form", {class: "decide", onsubmit: decide}, what, points, remark, make("button", {}, "Решить")));
}

addEventListener("DOMContentLoaded", async () => {
  $("login").addEventListener("submit", async event => {
    event.preventDefault();
    if (told(await ask("api/login", {token: $("token").value}))) enter();
  });
  $("issue").addEventListener("submit", async event => {
    event.preventDefault();
    const files = {};
    for (const name of ["base", "roster", "rubric"]) files[name] = await text($(name).files[0]);
    const answer = await ask("api/teacher", {title: $("title").value, seed: Number($("seed").value), ...files});
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
