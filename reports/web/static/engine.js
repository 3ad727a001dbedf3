// The page of an engine: a mapping of the file's values is all its state, the rest follows from it.
import {alerts, ask, choice, given, html, list, picker, printed, row, send, set, state, symbol, table} from "./common.js";
import {between, figure, mechanism, star} from "./drawn.js";
import {put, section} from "./fields.js";
import {engines, keep, last, remove, seen, text} from "./own.js";

// --- what is asked of the server ---
// An input that comes from somewhere takes the page; its fields and charts are asked for.
// What comes anew has no `own` place among the engines yet; `stands` tells that it is kept there.
async function fresh(coming, isNew = true, own = isNew ? {} : state.own, stands = false) {
  const came = await coming, {errors, ...shape} = came.raw ? await ask("api/start", came) : came;
  if (!shape.groups) { // what is wrong is said below the form, on a phone below its window
    set({errors: errors ?? []});
    return document.querySelector("#errors")?.scrollIntoView({block: "center"});
  }
  if (isNew && state.raw) Object.assign(state, {past: remembered(), isNew: false});
  if (shape.sheets?.every(([id]) => id !== state.sheet)) [[shape.sheet]] = shape.sheets;
  document.title = `${shape.raw.engine?.name || "Двигатель"} — КШМ`;
  if (own !== state.own) Object.assign(state, {own: seen(own), kept: null});
  if (own.raw) Object.assign(state, {other: own.other, past: [], news: "", isNew: false}); // not what was beside it
  if (stands) state.kept = text({...state, ...shape});
  await solve({...shape, typed: {}, touched: null, errors: []});
}

function store() { // what has changed, in its place among the own engines
  const now = text(state);
  if (now === state.kept) return;
  const {news, ...own} = keep(state.own, JSON.parse(now));
  Object.assign(state, {own, kept: now, news, linked: false, engines: engines()});
  if (location.hash) history.replaceState(null, "", location.pathname); // its numbers are no more those
}

async function solve(changes) {
  if (state.running) return set({...changes, again: true}); // at most one question on its way
  clearTimeout(state.later);
  set({...changes, running: true, again: false});
  const {raw, other, sheet, cylinder} = state, answer = raw => raw && ask("api/solve", {raw, sheet, cylinder});
  store();
  const [last, second] = await Promise.all([answer(raw), answer(other)]);
  const phi = last.errors ? 0 : Math.min(state.phi, last.moves.phi.at(-1)); // of a cycle that may be shorter
  set({running: false, ...last.errors ? {wrong: last.errors} : {wrong: [], last, second, phi}});
  if (state.again) return solve();
  // The checks take longer: they wait until nothing has changed for a while.
  if (!last.errors) state.later = setTimeout(async () => set(await send("api/solve", {raw})), 400);
}

async function order(kind, title) {
  const {raw, other} = state, job = {title, ...await send("api/files", {raw, other, kind})};
  if (job.id) state.jobs = [job, ...state.jobs.filter(({id}) => id !== job.id)];
  for (; job.id && !job.lines && !job.errors; await new Promise(done => setTimeout(done, 700))) {
    Object.assign(job, await ask(`api/files/${job.id}`));
    set({});
  }
}

// --- what a person does ---
const remembered = () => [...state.past, JSON.stringify([state.raw, state.own])].slice(-200);
function back() {
  const [raw, own] = JSON.parse(state.past.pop());
  fresh({raw}, false, own.id === state.own.id ? state.own : own);
}

// An own engine from the list, or what is there when there is none.
const open = engine => engine ? fresh({raw: engine.raw}, false, engine, true)
  : fresh(ask("api/new", {sample: "gots-diesel"}), false, {}, true);

async function away() {
  if (!confirm(`Убрать «${named(state)}» из этого браузера? Вернуть его будет нельзя.`)) return;
  remove(state.own.id);
  set({engines: engines()});
  await open(last());
}

const named = ({raw}) => raw.engine?.name || "Двигатель";
const listed = () => state.engines.map(each =>
  [each.id, `${named(each)}, ${new Date(each.date).toLocaleString("ru", {dateStyle: "short", timeStyle: "short"})}`]);

async function read(hash) { // once: the address is free again, and the engine stands beside the own ones
  history.replaceState(null, "", location.pathname);
  let raw = null;
  try { raw = JSON.parse(LZString.decompressFromEncodedURIComponent(hash)); } catch { /* told below */ }
  if (!raw) return set({news: "ссылка повреждена: попросите её ещё раз"});
  const known = engines().find(each => JSON.stringify(each.raw) === JSON.stringify(raw));
  await (known ? open(known) : fresh({raw}, false, {link: true, raw}));
}

// A value at a place; other fields may come and go with it.
async function change(key, path, value, reshapes) {
  if (state.touched !== key || reshapes) state.past = remembered(); // one step of undo for one field
  state.touched = key;
  const raw = reshapes ? structuredClone(state.raw) : state.raw;
  put(raw, path, value);
  if (!reshapes) return solve();
  state.open.add(key);
  await fresh({raw}, false);
  if (document.activeElement === document.body) document.querySelector(`[data-key="${key}"] summary`)?.focus();
}

const turn = phi => set({phi: Number(phi)});
const step = () => turn((state.phi + 2) % state.last.moves.phi.at(-1));
const play = () => set({playing: state.playing ? clearInterval(state.playing) : setInterval(step, 17)});

async function save() {
  const made = await send("api/toml", {raw: state.raw});
  const href = made && URL.createObjectURL(new Blob([made.text]));
  if (made) Object.assign(document.createElement("a"), {href, download: "engine.toml"}).click();
}

async function link() {
  location.hash = LZString.compressToEncodedURIComponent(JSON.stringify(state.raw));
  state.linked = location.hash.slice(1);
  try { await navigator.clipboard.writeText(location.href); } catch { /* the address shows it */ }
  set({});
}

const upload = async file => fresh(/\.xlsx$/i.test(file.name)
  ? ask("api/book", file) : ask("api/read", {text: await file.text()}));

function compose(event) {
  const {cylinders, layout, ...own} = given(event), more = event.submitter.name ? {raw: state.raw} : own;
  fresh(ask("api/new", {cylinders: Number(cylinders), layout, ...more}));
}

function begun(id) { // a further regime begins as the main one
  const {regime, gas, regimes = []} = state.raw, number = regimes.length + 1;
  if (id !== "regimes") return [id, [id], {}];
  return [`regimes[${number}]`, [id, number - 1], {...regime, gas, name: `Режим ${number + 1}`}];
}

const data = ({fields} = state.choices) => html`
  <section id="data" aria-label="Исходные данные">
    <p class="tool-bar" hidden=${!state.engines.length}>${choice("Мои двигатели", "own",
      [...state.own.id ? [] : [["", "—"]], ...listed()], state.own.id ?? "", id => id && open(engines().find(each => each.id === id)))}
      <button id="away" hidden=${!state.own.id} onClick=${away}>Убрать из списка</button></p>
    <p id="news" role="status">${state.news}</p>
    <details id="new" open=${state.isNew} onToggle=${e => { state.isNew = e.target.open; }}>
      <summary>Новый двигатель</summary>
      <form onSubmit=${e => fresh(ask("api/new", given(e)))}>
        ${choice(fields.sample, "sample", state.choices.samples.map(name => [name, name]), "gots-diesel")}
        <button>Открыть</button></form>
      <form onSubmit=${compose}>
        <label>${fields.cylinders} <input id="cylinders" name="cylinders" type="number" min="1" max="12" defaultValue="4" required /></label>
        ${choice(fields.layout, "layout", Object.entries(state.choices.layouts))}
        ${choice(fields.strokes, "strokes", Object.entries(state.choices.strokes), "4")}
        ${choice(fields.kind, "kind", Object.entries(state.choices.kinds))}
        <label>${fields.power} <input name="power" inputmode="decimal" /></label>
        <label>${fields.speed} <input name="speed" inputmode="decimal" /></label>
        <button>Составить</button>
        <button name="alike">Вариант этого двигателя</button>
      </form>
      <p>${picker("Открыть .toml или книгу .xlsx", ".toml,.xlsx", upload, "upload")}</p></details>
    <p class="tool-bar">
      <button id="undo" disabled=${!state.past.length} onClick=${back}>Отменить</button>
      <button id="save" onClick=${save}>Скачать .toml</button>
      <button id="link" onClick=${link}>${state.linked ? "Ссылка в адресе" : "Ссылка"}</button>
      <button id="keep" onClick=${() => solve({other: structuredClone(state.raw)})}>Сравнить с этим</button>
      <button id="drop" hidden=${!state.other} onClick=${() => solve({other: null})}>Убрать второй</button></p>
    ${alerts([...state.errors, ...state.wrong])}
    <p><label>Найти поле <input id="find" type="search" autocomplete="off" value=${state.find}
      onInput=${e => set({find: e.target.value})} /></label></p>
    <div id="fields">${state.groups.map(group => section(group, change))}</div>
    <p class="tool-bar">Добавить раздел: ${Object.entries(state.absent).map(([id, title]) =>
      html`<button onClick=${() => change(...begun(id), true)}>${title}</button>`)}</p>
  </section>`;

const scene = ({moves}) => html`
  <div id="scene" class="cards">
    <figure>${mechanism(moves, state.phi)}<figcaption>${choice("Механизм, цилиндр", "cylinder",
      Array.from({length: moves.cylinders}, (_, i) => [i, i + 1]), moves.cylinder,
      value => solve({cylinder: Number(value)}))}</figcaption></figure>
    <div>
      <label for="phi">Угол φ: ${printed(state.phi)}°</label>
      <input id="phi" type="range" min="0" max=${moves.phi.at(-1)} step="1" value=${state.phi}
        aria-valuetext=${`${printed(state.phi)} градусов`} onInput=${e => turn(e.target.value)} />
      <button aria-pressed=${String(Boolean(state.playing))} onClick=${play}>${state.playing ? "Стоп" : "Пуск"}</button>
      ${table("Удельные силы при φ", Object.values(moves.forces).map(f =>
        row([[symbol(f.symbol)], [printed(between(moves.phi, f.values, state.phi)), "n"], [f.unit, "s"]])))}
    </div>
    <figure>${star(moves, state.phi)}<figcaption>Звезда кривошипов</figcaption></figure>
  </div>`;

const job = ({id, title, state: now, place, seconds, files = [], lines, errors}) => html`<li>${`${title}: `}
  ${now === "waiting" && `в очереди, перед вами ${place}`}${now === "running" && `делается, ${seconds} с`}
  ${files.map(({name, size}) => html`
    <a href=${`api/files/${id}/${encodeURIComponent(name)}`} download=${name}>${name}</a>
    ${` (${printed(size / 1e6, 2)} МБ) `}`)}
  ${list(lines || errors || [], now === "done" ? "warn" : "bad")}</li>`;

const verdict = ({ok, reason}) =>
  ok ? ["выполнена", "ok color"] : reason ? [`принято: ${reason}`, "warn color"] : ["не выполнена", "bad color"];

const results = ({last, second}) => html`
  <section id="results" aria-label="Результаты" tabindex="-1" class="margin:0"
    style=${state.wrong.length ? "opacity: .55" : ""}>
    <h2>${state.raw.engine?.name || "Двигатель"}</h2>
    ${scene(last)}
    <p>${choice("Диаграммы листа", "sheet", state.sheets.map(([id, title]) => [id, id || "Прочее", title]),
      state.sheet, sheet => solve({sheet}))}</p>
    <div id="charts" class="cards">${last.charts.map(own =>
      figure({own, other: second?.charts?.find(c => c.id === own.id), phi: state.phi}))}</div>
    <div id="files"><h3>Файлы</h3><p class="tool-bar">${Object.entries(state.choices.files).map(([kind, title]) =>
      html`<button data-kind=${kind} onClick=${() => order(kind, title)}>${title}</button>`)}</p>
      <ul id="jobs" aria-live="polite">${state.jobs.map(job)}</ul></div>
    <div id="checks">${state.checks.length > 0 && table("Проверки расчёта", state.checks.map(c =>
      row([[c.title], [c.value, "n"], verdict(c)])))}</div>
    ${list([...last.warnings, ...state.remarks], "warn")}
    <div id="summary">${last.results.map(({id, title, rows}) => html`
      <details key=${id} open=${/^(summary_torque|geometry)/.test(id)}><summary>${title}</summary>
        ${table(title, rows.map(r => row([[r.title], [symbol(r.symbol), "s"], [r.text, "n"],
          [second?.results?.find(t => t.id === id)?.rows.find(o => o.key === r.key)?.text, "n"],
          [r.unit, "s"]], {"data-key": r.key})))}</details>`)}</div>
  </section>`;

const page = () => html`
  <a class="skip" href="#results">К результатам</a>
  <header class="f-row flex-wrap:wrap align-items:baseline margin:0 padding-block:0"><h1>Кривошипно-шатунный механизм</h1>
    <nav aria-label="Страницы"><a href="teacher">Преподавателю</a></nav></header>
  <main>${data()}${state.last && results(state)}</main>
  <nav id="places" class="f-row justify-content:space-around padding" aria-label="Части страницы">
    <a href="#data">Данные</a> <a href="#results">Диаграммы</a> <a href="#files">Файлы</a></nav>`;

set({
  past: [], groups: [], sheets: [], absent: {}, sheet: "П4.1", cylinder: 0, phi: 0, typed: {}, wrong: [],
  checks: [], remarks: [], jobs: [], find: "", isNew: true, own: {}, kept: null, news: "", engines: engines(), choices: await ask("api/choices"),
  open: new Set(innerWidth > 900 ? ["engine", "geometry", "regime"] : []),
}, page);
for (const media of ["(prefers-color-scheme: dark)", "print"]) // colours are drawn in
  matchMedia(media).addEventListener("change", () => set({}));
Object.assign(window, {kshm: state, ask, fresh, turn}); // for a person's console and for the tests
addEventListener("hashchange", () => { // a link put into the address of this very page
  const hash = location.hash.slice(1);
  if (hash && hash !== state.linked) read(hash);
});
addEventListener("storage", () => set({engines: engines()})); // of another tab
const hash = location.hash.slice(1);
if (hash) await read(hash);
if (!state.raw) await open(last());
if (!state.raw) await open(); // what was kept is no engine of today
