// The instructor's page: a class issued, handed in, graded, decided, taken to Moodle.
import {render} from "./vendor/preact.mjs";
import {alerts, ask, html, list, options, picker, printed, row, table} from "./common.js";

const state = {inside: null, classes: [], chosen: "", own: null, errors: [], news: ""};
const draw = () => render(page(), document.body);
const set = changes => { Object.assign(state, changes); draw(); };
const door = path => `api/teacher/${state.chosen}/${path}`;
const isBusy = () => ["waiting", "running"].includes(state.own.state);

async function enter() {
  const {classes = [], errors} = await ask("api/teacher");
  set({inside: !errors, classes, chosen: state.chosen || classes[0]?.name || ""});
  await look();
}

let timer = 0;
async function look(news = "") {
  clearTimeout(timer);
  if (!state.chosen) return;
  const {errors = [], ...own} = await ask(`api/teacher/${state.chosen}`);
  set({errors, own: own.students ? own : state.own, news});
  if (state.own && isBusy()) timer = setTimeout(look, 1000);
}

function choose({target}) {
  set({chosen: target.value, own: null});
  look();
}

async function act(path, data, news) {
  const {errors} = await ask(door(path), data);
  if (errors) set({errors});
  else await look(news);
}

async function login(token) {
  const {errors = []} = await ask("api/login", {token});
  set({errors});
  if (!errors.length) await enter();
}

// A list in Windows-1251 is a list as well.
async function text(file) {
  const bytes = await file.arrayBuffer();
  try { return new TextDecoder("utf-8", {fatal: true}).decode(bytes); } catch {
    return new TextDecoder("windows-1251").decode(bytes);
  }
}

async function issue(event) {
  event.preventDefault();
  const form = event.target, data = Object.fromEntries(new FormData(form));
  for (const name of ["base", "roster", "rubric"]) data[name] = await text(data[name]);
  const {name, errors = []} = await ask("api/teacher", {...data, seed: Number(data.seed)});
  set({errors});
  if (!name) return;
  form.reset();
  set({chosen: name});
  await enter();
}

function status({state: now, students, rows, graded}) {
  if (isBusy()) return students.length ? `Проверка идёт… готово файлов: ${graded}` : "Выдача идёт…";
  if (now !== "done") return "";
  if (!rows.length) return "Варианты выданы.";
  const waits = rows.some(each => each.manual);
  return `Проверено${waits ? "; есть работы, которые ждут вашего решения." : "."}`;
}

const loaded = name => file => act(`file/${name}`, file, `${file.name}: загружено`);
const link = (href, title, more) => html`<a href=${door(href)} ...${more}>${title}</a>`;

const tools = own => html`
  <p class="tools">
    ${link("file/issued.zip", "Рабочие книги .zip", {class: "button", download: "issued.zip"})}
    ${picker("Загрузить архив работ .zip", ".zip", loaded("moodle.zip"))}
    ${picker("Ведомость Moodle .csv", ".csv", loaded("worksheet.csv"))}
    <button id="grade" disabled=${isBusy()} onClick=${() => act("grade", {})}>Проверить</button>
    <label><input id="open" type="checkbox" checked=${own.open}
      onChange=${e => act("open", {open: e.target.checked})} /> студенты видят свои страницы</label>
  </p>`;

const gradebook = own => table("Ведомость", own.rows.map(each => {
  const points = each.points ?? each.provisional, judged = each.number && each.page;
  const name = judged ? link(`page/${each.number}`, each.student, {target: "_blank"}) : each.student;
  const shown = each.points === null && points !== null ? `(${printed(points)})` : printed(points);
  return row([[name], [each.status], [shown, "n"], [each.remark],
    [judged && decision(each)]], {key: each.number ?? each.student, class: each.manual ? "odd" : ""});
}), html`<thead><tr>${["Студент", "Состояние", "Баллы", "Примечание", "Решение"].map(title =>
  html`<th scope="col">${title}</th>`)}</tr></thead>`);

// What waits for a person stands open; the rest is a click away.
function decision({number, student, manual, unknown}) {
  const decide = event => {
    event.preventDefault();
    const data = Object.fromEntries(new FormData(event.target));
    event.target.reset();
    act("grade", {who: String(number), ...data}, "Решение принято.");
  };
  return html`
    <details open=${manual}><summary aria-label=${`Решить: ${student}`}>Решить</summary>
      <form onSubmit=${decide}>
        <select name="what" aria-label=${`Что решить: ${student}`}>
          ${options([["всё", "вся работа"], ...unknown.map(item => [item, item])])}</select>
        <input name="points" aria-label=${`Баллы: ${student}`} size="12" placeholder="баллы, + или -" required />
        <input name="remark" aria-label=${`Примечание: ${student}`} placeholder="примечание" maxlength="300" />
        <button>Решить</button>
      </form></details>`;
}

const links = ({students}) => html`
  <details id="links" open><summary>Ссылки студентов</summary><ul>${students.map(each => html`
    <li><a href=${`s/${each.link}/`}>${each.name}</a>${each.group && `, ${each.group}`}
      ${each.handed && " — сдал здесь"}</li>`)}</ul></details>`;

const room = own => html`
  <div id="class">
    <p role="status" class=${own.state === "failed" ? "bad" : ""}>${state.news} ${status(own)}</p>
    ${list(own.lines || [], own.state === "failed" ? "errors" : "warnings")}
    ${own.students.length > 0 && tools(own)}
    <p id="results" class="tools">${own.files.map(name => link(`file/${name}`, name,
      name.endsWith(".html") ? {target: "_blank"} : {download: name}))}</p>
    ${own.rows.length > 0 && gradebook(own)}
    ${own.students.length > 0 && links(own)}
  </div>`;

const issuing = () => html`
  <details id="newClass" open=${!state.chosen}><summary>Выдать новой группе</summary>
    <form id="issue" onSubmit=${issue}>
      <label>Название <input id="title" name="title" required maxlength="120" /></label>
      <label>Двигатель с [variants], .toml <input id="base" name="base" type="file" accept=".toml" required /></label>
      <label>Список группы, .csv <input id="roster" name="roster" type="file" accept=".csv,.txt" required /></label>
      <label>Рубрика, .toml (можно без неё) <input id="rubric" name="rubric" type="file" accept=".toml" /></label>
      <label>Зерно <input name="seed" type="number" value="1" required /></label>
      <button>Выдать</button>
    </form></details>`;

const entrance = html`
  <form id="login" onSubmit=${e => { e.preventDefault(); login(new FormData(e.target).get("token")); }}>
    <label>Ключ преподавателя
      <input id="token" name="token" type="password" autocomplete="current-password" required /></label>
    <button>Войти</button></form>`;

const page = () => html`
  <header><h1>Группы</h1><nav aria-label="Страницы"><a href="./">Двигатель</a></nav></header>
  <main class="single"><section>
    ${alerts(state.errors)}
    ${state.inside === false && entrance}
    ${state.inside && html`<div id="inside">${issuing()}
      <p><label>Группа <select id="classes" value=${state.chosen} onChange=${choose}>
        ${options(state.classes.map(c => [c.name, `${c.title}, ${c.date.slice(0, 10)}`]))}</select></label></p>
      ${state.own && room(state.own)}</div>`}
  </section></main>`;

const token = decodeURIComponent(location.hash.slice(1)); // the printed address: the key goes to no log
history.replaceState(null, "", location.pathname);
if (token) await login(token);
await enter();
