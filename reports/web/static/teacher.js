// The instructor's page: a class issued, handed in, graded, decided, taken to Moodle.
import {alerts, ask, choice, given, html, list, moment, options, picker, printed, row, send, set, state, table} from "./common.js";

const door = path => `api/teacher/${state.chosen}/${path}`;
const isBusy = () => ["waiting", "running"].includes(state.own.state);

async function look(changes) { // at the chosen class, again and again while something is done
  clearTimeout(state.later);
  set({news: "", ...changes});
  const {classes = [], errors, isLost} = await ask("api/teacher");
  if (isLost) return;
  set({inside: !errors, classes, chosen: state.chosen || classes[0]?.name});
  if (state.chosen && state.inside) set({own: await send(`api/teacher/${state.chosen}`)});
  if (state.own && isBusy()) state.later = setTimeout(look, 1000);
}

const act = async (path, data, news) => await send(path, data) && look({news});

// Files go as one character a byte: the server reads them as the command does.
const bytes = async file => Array.from(new Uint8Array(await file.arrayBuffer()), code => String.fromCharCode(code)).join("");

async function issue(event) {
  const data = given(event);
  for (const key of ["base.toml", "rubric.toml", "roster"]) data[key] = await bytes(data[key]);
  const made = await send("api/teacher", data);
  if (!made) return;
  event.target.reset();
  await look({chosen: made.name, own: null});
}

async function forget() {
  const {title, students} = state.own, count = students.filter(came).length;
  if (!confirm(`Удалить группу «${title}» со всеми работами (сдали: ${count})? Вернуть её будет нельзя.`)) return;
  if (await send(door("delete"), {})) await look({chosen: "", own: null});
}

async function leave() {
  await send("api/logout", {});
  await look({chosen: "", own: null});
}

const status = ({state: now, students, rows, graded}) => // how many wait for a person, its lines say
  isBusy() ? (students.length ? `Проверка идёт… готово файлов: ${graded}` : "Выдача идёт…")
    : now === "done" && (rows.length ? "Проверено." : "Варианты выданы.");

const loaded = name => file => act(door(`file/${name}`), file, `${file.name}: загружено`);
const link = (path, title, more) => html`<a href=${door(`file/${path}`)} ...${more}>${title}</a>`;

const heads = (...titles) => html`<thead><tr>${titles.map(title => html`<th scope="col">${title}</th>`)}</tr></thead>`;

// Points and a remark of a student or of a group, for the whole work unless `chosen` says for what.
const judge = (who, name, hint, chosen, isForMany) => html`
  <form onSubmit=${e => {
    const preview = e.submitter?.name === "preview", said = {who: String(who), what: "всё", ...given(e)};
    if (preview) return act(door("grade"), {...said, preview}, "Кому сколько баллов даст решение:");
    act(door("grade"), said, "Решение принято.");
    e.target.reset();
  }}>
    ${chosen}
    <input name="points" aria-label=${`Баллы: ${name}`} size="12" placeholder=${hint} required />
    <input name="remark" aria-label=${`Примечание: ${name}`} placeholder="примечание" maxlength="300" />
    <button>Решить</button>${isForMany && html` <button name="preview">Показать</button>`}</form>`;

const gradebook = rows => table("Ведомость", rows.map(each => {
  const {number, student, page} = each, points = each.points ?? each.provisional;
  const shown = each.points === null && points !== null ? `(${printed(points)})` : printed(points);
  const who = number ? `${number}. ${student}` : student; // there are namesakes
  return row([[page ? link(page, who, {target: "_blank"}) : who], [each.status],
    [shown, "n"], [[each.remark, each.similar].filter(Boolean).join("; ")], [number && page && decision(each)]], {key: who, class: each.manual ? "odd warn" : ""});
}), heads("Студент", "Состояние", "Баллы", "Примечание", "Решение"));

// What waits for a person stands open; the rest is a click away.
const decision = ({number, student, manual, unknown}) => html`
  <details open=${manual}><summary aria-label=${`Решить: ${student}`}>Решить</summary>
    ${judge(number, student, "баллы, + или -", html`<select name="what" aria-label=${`Что решить: ${student}`}>
      ${options([["всё", "вся работа"], ...unknown.map(item => [item, item])])}</select>`)}</details>`;

// One decision for all works that wait for the same reason.
const many = groups => table("Решить сразу для многих", groups.map(({name, what, why, formula, students, points}) =>
  row([[name], [`${what}: ${why}`], [formula], [students.map((each, i) => `${each} (${printed(points[i] ?? "—")})`).join(", ")],
    [judge(name, name, "75, ×0,75, +5 или +", "", true)]], {key: name})),
heads("Группа", "Что и почему", "Формула", "Студенты (баллы сейчас)", "Решение"));

// What was decided for many can be taken back.
const settled = groups => table("Решено для многих", groups.map(({name, what, points, remark, students}) =>
  row([[name], [what], [points, "n"], [remark], [students.join(", ")], [judge(name, name, "- отменить", "", true)]], {key: name})),
heads("Группа", "Что", "Решение", "Примечание", "Студенты", "Отменить"));

const rules = changes => act(door("rules"), Object.assign(state.own, changes) && {
  open: state.own.open, late: state.own.late, deadline: state.own.deadline});

// A work has come here, or with an archive of Moodle.
const came = ({number, handed}) => handed || state.own.rows.some(row => row.number === number && row.file);

const student = each => {
  const work = (file, title) => link(`works/${file}`, title, {download: file.split("/").at(-1)});
  const before = each.earlier.map(one => html` ${work(one.file, moment(one.when))}`);
  return row([[each.number, "n"], [html`<a class="own" href=${`s/${each.link}/`}>${each.name}</a>${each.group && `, ${each.group}`}`],
    [each.handed ? html`${work(each.file, `сдал здесь ${moment(each.when)}`)}${each.late && html` <b class="bad">после срока</b>`}
      ${before.length > 0 && html`<br /><small>раньше ещё ${before.length}:${before}</small>`}` : came(each) ? "в архиве" : "—"],
    [html`<details class="qr"><summary aria-label=${`QR-код: ${each.name}`}>QR</summary>
      <img loading="lazy" width="180" height="180" alt=${`QR-код ссылки: ${each.name}`} src=${door(`qr/${each.number}.svg`)} /></details>`]],
    {key: each.number});
};

const issued = ({open, late, deadline, students, rows, groups, decided, files, address}) => html`
  <p class="bar">
    ${link("issued.zip", "Рабочие книги .zip", {class: "button", download: "issued.zip"})}
    ${picker("Загрузить архив работ .zip", ".zip", loaded("moodle.zip"))}
    ${picker("Ведомость Moodle .csv", ".csv", loaded("worksheet.csv"))}
    <button id="grade" class="first" disabled=${isBusy()} onClick=${() => act(door("grade"), {})}>Проверить</button></p>
  <p class="bar"><label>Срок <input id="deadline" type="datetime-local" value=${deadline ?? ""} onChange=${e => rules({deadline: e.target.value})} /></label>
    <label><input id="open" type="checkbox" checked=${open} onChange=${e => rules({open: e.target.checked})} /> студенты видят свои страницы</label>
    <label><input id="late" type="checkbox" checked=${late} onChange=${e => rules({late: e.target.checked})} /> и после этого принимать книги</label></p>
  <p id="results" class="bar">${files.map(([name, title]) => link(name, title,
    name.endsWith(".html") ? {target: "_blank"} : {download: name}))}</p>
  ${groups.length > 0 && many(groups)}
  ${decided.length > 0 && settled(decided)}
  ${rows.length > 0 && gradebook(rows)}
  <details id="links" open><summary>${students.filter(came).length} из ${students.length} сдали</summary>
    <p class="bar"><a class="button" id="list" href=${door("links.csv")} download="Ссылки студентов.csv">Все ссылки .csv</a>
      <small>Ссылки открываются по адресу ${address}</small></p>
    ${table("Ссылки студентов", students.map(student))}</details>
  <p><button id="forget" disabled=${isBusy()} onClick=${forget}>Удалить группу</button></p>`;

const asked = (title, name, more) => html`<label>${title} <input id=${name.split(".")[0]} name=${name} ...${more} /></label>`;

const page = () => html`
  <header><h1>Группы</h1>
    <nav aria-label="Страницы"><a href="./">Двигатель</a></nav>${state.inside && html`<button id="leave" onClick=${leave}>Выйти</button>`}</header>
  <main>
    ${alerts(state.errors)}
    ${state.inside === false && html`<form id="login" onSubmit=${e => act("api/login", given(e))}>
      ${asked("Ключ преподавателя", "token", {type: "password", autocomplete: "current-password", required: true})}
      <button class="first">Войти</button></form>`}
    ${state.inside && html`<div id="inside" class="panel">
      <details id="newClass" open=${!state.chosen}><summary>Выдать новой группе</summary>
        <form id="issue" onSubmit=${issue}>
          ${asked("Название", "title", {required: true, maxlength: 120})}
          ${asked("Двигатель с [variants], .toml", "base.toml", {type: "file", accept: ".toml", required: true})}
          ${asked("Список группы, .xlsx или .csv", "roster", {type: "file", accept: ".xlsx,.csv,.txt", required: true})}
          ${asked("Рубрика, .toml (можно без неё)", "rubric.toml", {type: "file", accept: ".toml"})}
          ${asked("Зерно", "seed", {type: "number", defaultValue: 1, required: true})}
          <button class="first">Выдать</button></form></details>
      <p hidden=${!state.chosen}>${choice("Группа", "classes", state.classes.map(c => [c.name, `${c.title}, ${c.date.slice(0, 10)}`]),
        state.chosen, chosen => look({chosen, own: null}))}</p>
      ${state.own && html`<div id="class" class="panel"><p role="status">${state.news} ${status(state.own)}</p>
        ${list(state.own.lines || [], state.own.state === "failed" ? "bad" : "warn")}
        ${state.own.students.length > 0 && issued(state.own)}</div>`}</div>`}
  </main>`;

set({chosen: "", own: null, again: look}, page);
const token = decodeURIComponent(location.hash.slice(1)); // the printed address: the key goes to no log
history.replaceState(null, "", location.pathname);
if (token) await send("api/login", {token});
await look();
