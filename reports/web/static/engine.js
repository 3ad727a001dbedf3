// The page of an engine: a mapping of the file's values is all its state, the rest follows from it.
import {render} from "./vendor/preact.mjs";
import {between, figure} from "./charts.js";
import {alerts, ask, html, list, options, picker, printed, row, symbol, table} from "./common.js";
import {add, put, section} from "./fields.js";
import {mechanism, star} from "./moving.js";

const state = {
  raw: null, other: null, past: [], groups: [], sheets: [], absent: {}, sheet: "П4.1", cylinder: 0, phi: 0,
  typed: {}, problems: {}, errors: [], late: false, warnings: [], checks: [], jobs: [],
  find: "", open: new Set(), theme: 0,
  isNew: true, running: false, playing: false, last: null, second: null, linked: false,
};
const copy = structuredClone;
const draw = () => render(page(), document.body);
const set = changes => { Object.assign(state, changes); draw(); };
const entries = Object.entries;

// --- what is asked of the server ---
async function open(raw, keep = true) {
  const {errors, ...shape} = await ask("api/start", {raw});
  if (!shape.groups) { set({errors}); return false; }
  if (keep && state.raw) remember();
  if (!shape.sheets.length) delete shape.sheets;
  else if (!shape.sheets.some(([id]) => id === state.sheet)) state.sheet = shape.sheets[0][0];
  set({...shape, typed: {}});
  touched = null;
  document.title = `${state.raw.engine?.name || "Двигатель"} — КШМ`;
  await solve();
  return true;
}

let again = false, later = 0;
async function solve() {
  const {raw, other} = state;
  try { localStorage.setItem("kshm", JSON.stringify({raw, other})); } catch { /* private window */ }
  again = true;
  if (state.running) return draw(); // at most one question on its way
  state.running = true;
  while (again) {
    again = false;
    draw();
    const {sheet, cylinder} = state, put = raw => raw && ask("api/solve", {raw, sheet, cylinder});
    const [last, second] = await Promise.all([put(state.raw), put(state.other)]);
    sort(last.errors, last.warnings || []);
    state.late = last.errors.length > 0;
    if (state.late) continue;
    Object.assign(state, {last, second});
    if (!again) state.cylinder = last.moves.cylinder;
  }
  set({running: false});
  clearTimeout(later);
  later = setTimeout(check, 400);
}

async function check() {
  const {checks, remarks, errors} = await ask("api/checks", {raw: state.raw});
  if (!errors) set({checks, warnings: [...state.last.warnings, ...remarks]});
}

// Each problem stands at its field, else at its list, else above all.
function sort(errors, warnings) {
  const places = new Map(state.groups.flatMap(g => [[g.key, g.key], ...g.entries.flat().map(f => [f.key, g.key])]));
  Object.assign(state, {problems: {}, errors: errors.filter(p => !places.has(p.where))});
  for (const p of [...errors.map(p => ({...p, kind: "error"})), ...warnings.map(p => ({...p, kind: "odd"}))]) {
    if (!places.has(p.where)) continue;
    (state.problems[p.where] ??= []).push(p);
    if (p.kind === "error") state.open.add(places.get(p.where));
  }
}

async function order(kind, title) {
  const {id, errors = []} = await ask("api/files", {raw: state.raw, other: state.other, kind});
  set({errors});
  if (!id || state.jobs.some(job => job.id === id && !job.lines)) return;
  const job = {id, title};
  state.jobs.unshift(job);
  while (!job.lines && !job.errors) {
    Object.assign(job, await ask(`api/files/${id}`));
    draw();
    if (!job.lines) await new Promise(done => setTimeout(done, 700));
  }
}

// --- what a person does ---
function remember() {
  const text = JSON.stringify(state.raw);
  if (state.past.at(-1) !== text) state.past.push(text);
  state.past = state.past.slice(-200);
}

let touched = null;
function change(f, value, shape = false) {
  if (touched !== f.key || shape) remember(); // one step of undo for one field
  touched = f.key;
  const plain = value.trim().replace(",", ".").replace("−", "-");
  put(state.raw, f.path, f.number && /^-?\d+(\.\d+)?$/.test(plain) ? Number(plain) : value.trim());
  state.typed[f.key] = value;
  if (shape) open(state.raw, false);
  else solve();
}

async function edited(what, key) { // a change that alters the shape
  const raw = copy(state.raw), before = new Set(state.groups.map(g => g.key));
  what(raw);
  await open(raw);
  for (const {key} of state.groups) if (!before.has(key)) state.open.add(key);
  draw();
  if (document.activeElement === document.body) document.querySelector(`[data-key="${key}"] summary`)?.focus();
}

async function fresh(answering) {
  const {raw, errors = []} = await answering;
  set({errors, isNew: state.isNew && !raw});
  if (raw) await open(raw);
}

function turn(phi) { set({phi: Number(phi)}); }

function play() {
  let before = performance.now();
  const step = now => {
    if (!state.playing) return;
    turn((state.phi + Math.round((now - before) * .12)) % state.last.moves.phi.at(-1));
    before = now;
    requestAnimationFrame(step);
  };
  set({playing: !state.playing});
  requestAnimationFrame(step);
}

async function save() {
  const {text, errors = []} = await ask("api/toml", {raw: state.raw});
  set({errors});
  if (!text) return;
  const href = URL.createObjectURL(new Blob([text], {type: "application/toml"}));
  Object.assign(document.createElement("a"), {href, download: "engine.toml"}).click();
  setTimeout(() => URL.revokeObjectURL(href), 1000);
}

async function link() {
  location.hash = LZString.compressToEncodedURIComponent(JSON.stringify(state.raw));
  try { await navigator.clipboard.writeText(location.href); } catch { /* the address shows it */ }
  set({linked: true});
}

const asked = changes => { Object.assign(state, changes); solve(); };
const compare = other => asked({other});
const upload = async file => fresh(/\.xlsx$/i.test(file.name)
  ? ask("api/book", file) : ask("api/read", {text: await file.text()}));
const step = () => open(JSON.parse(state.past.pop()), false);

function submitted(event, keys) { // the form's values, numbers as numbers
  event.preventDefault();
  const given = [...new FormData(event.target)].filter(([key, text]) => text.trim() && keys.includes(key));
  return Object.fromEntries(given.map(([key, text]) =>
    [key, ["cylinders", "power", "speed"].includes(key) ? Number(text.replace(",", ".")) : text]));
}

// --- the page ---
const pick = (title, name, pairs, chosen) => html`
  <label>${title} <select id=${name} name=${name}>${pairs.map(([value, label]) => html`
    <option value=${value} selected=${value === chosen}>${label}</option>`)}</select></label>`;

const ownForm = choices => html`
  <form onSubmit=${e => fresh(ask("api/new", submitted(e, ["sample"])))}>
    ${pick("Образец", "sample", choices.samples.map(name => [name, name]), "gots-diesel")}
    <button>Открыть</button></form>
  <form onSubmit=${e => {
    const alike = e.submitter.name === "alike", keys = ["cylinders", "layout"];
    const wanted = submitted(e, alike ? keys : [...keys, "strokes", "kind", "power", "speed"]);
    fresh(ask("api/new", alike ? {...wanted, raw: state.raw} : wanted));
  }}>
    <label>Цилиндров <input id="cylinders" name="cylinders" type="number" min="1" max="12" value="4" required /></label>
    ${pick("Расположение", "layout", entries(choices.layouts))}
    ${pick("Тактность", "strokes", entries(choices.strokes), "4")}
    ${pick("Вид", "kind", entries(choices.kinds))}
    <label>Мощность, кВт <input name="power" inputmode="decimal" /></label>
    <label>Частота, мин⁻¹ <input name="speed" inputmode="decimal" /></label>
    <button>Составить</button>
    <button name="alike">Вариант этого двигателя</button>
  </form>
  <p>${picker("Открыть .toml или книгу .xlsx", ".toml,.xlsx", upload, "upload")}</p>`;

const data = () => html`
  <section id="data" aria-label="Исходные данные">
    <details id="new" open=${state.isNew} onToggle=${e => { state.isNew = e.target.open; }}>
      <summary>Новый двигатель</summary>${ownForm(state.choices)}</details>
    <p class="tools">
      <button id="undo" disabled=${!state.past.length} onClick=${step}>Отменить</button>
      <button id="save" onClick=${save}>Скачать .toml</button>
      <button id="link" onClick=${link}>${state.linked ? "Ссылка в адресе" : "Ссылка"}</button>
      <button id="keep" onClick=${() => compare(copy(state.raw))}>Сравнить с этим</button>
      <button id="drop" hidden=${!state.other} onClick=${() => compare(null)}>Убрать второй</button></p>
    ${alerts(state.errors)}
    <p><label>Найти поле <input id="find" type="search" autocomplete="off" value=${state.find}
      onInput=${e => set({find: e.target.value})} /></label></p>
    <div id="fields">${state.groups.map(group => section(group, {state, edited, change}))}</div>
    <p class="tools">Добавить раздел: ${entries(state.absent).map(([id, title]) =>
      html`<button onClick=${() => edited(raw => add(raw, id), id)}>${title}</button>`)}</p>
  </section>`;

const scene = ({moves}) => html`
  <div id="scene" class="cards">
    <figure>${mechanism(moves, state.phi)}<figcaption><label>Механизм, цилиндр
      <select id="cylinder" value=${state.cylinder} onChange=${e => asked({cylinder: Number(e.target.value)})}>
        ${options(Array.from({length: moves.cylinders}, (_, i) => [i, i + 1]))}</select></label></figcaption></figure>
    <figure>${star(moves, state.phi)}<figcaption>Звезда кривошипов</figcaption></figure>
    <div>
      <p><label for="phi">Угол φ:</label> <output>${`${printed(state.phi)}°`}</output>
        <input id="phi" type="range" min="0" max=${moves.phi.at(-1)} step="1" value=${state.phi}
          aria-valuetext=${`${printed(state.phi)} градусов`} onInput=${e => turn(e.target.value)} />
        <button aria-pressed=${String(state.playing)} onClick=${play}>${state.playing ? "Стоп" : "Пуск"}</button></p>
      <table><caption>Удельные силы при φ</caption><tbody>${Object.values(moves.forces).map(f => row(
        [[symbol(f.symbol)], [printed(between(moves.phi, f.values, state.phi)), "n"], [f.unit, "s"]]))}</tbody></table>
    </div>
  </div>`;

const job = ({id, title, state: now, place, seconds, files = [], lines, errors}) => html`<li>${title}:
  ${now === "waiting" && ` в очереди, перед вами ${place}`}${now === "running" && ` делается, ${seconds} с`}
  ${files.map(({name, size}) => html`
    <a href=${`api/files/${id}/${encodeURIComponent(name)}`} download=${name}>${name}</a>
    ${` (${printed(size / 1e6, 2)} МБ) `}`)}
  ${list(lines || errors || [], now === "done" ? "odd" : "bad")}</li>`;

const verdict = ({ok, reason}) =>
  ok ? ["выполнена", "good"] : reason ? [`принято: ${reason}`, "odd"] : ["не выполнена", "bad"];

function results({last, second}) {
  const others = new Map((second?.results || []).flatMap(t => t.rows.map(r => [r.key, r.text])));
  return html`
    <section id="results" aria-label="Результаты" tabindex="-1" class=${state.late ? "late" : ""}>
      <h2>${state.raw.engine?.name || "Двигатель"}</h2>
      ${scene(last)}
      <p class="tools"><label>Диаграммы листа <select id="sheet" value=${state.sheet}
        onChange=${e => asked({sheet: e.target.value})}>
        ${options(state.sheets.map(([id, title]) => [id, id || "Прочее", title]))}</select></label></p>
      <div id="charts" class="cards">${last.charts.map(own => figure(
        {own, other: second?.charts?.find(c => c.id === own.id), phi: state.phi, theme: state.theme}))}</div>
      <div id="files"><h3>Файлы</h3><p class="tools">${entries(state.choices.files).map(([kind, title]) =>
        html`<button data-kind=${kind} onClick=${() => order(kind, title)}>${title}</button>`)}</p>
        <ul id="jobs" aria-live="polite">${state.jobs.map(job)}</ul></div>
      <div id="checks">${state.checks.length > 0 && table("Проверки расчёта", state.checks.map(c =>
        row([[c.title], [printed(c.value), "n"], verdict(c)])))}</div>
      ${list(state.warnings, "warnings")}
      <div id="summary">${last.results.map(({id, title, rows}) => html`
        <details key=${id} open=${/^(summary_torque|geometry)/.test(id)}><summary>${title}</summary>
          ${table(title, rows.map(r => row([[r.title], [symbol(r.symbol), "s"], [r.text, "n"],
            [others.get(r.key) ?? "", "n"], [r.unit, "s"]], {"data-key": r.key})))}</details>`)}</div>
    </section>`;
}

const page = () => html`
  <a class="skip" href="#results">К результатам</a>
  <header><h1>Кривошипно-шатунный механизм</h1>
    <nav aria-label="Страницы"><a href="teacher">Преподавателю</a></nav></header>
  <main>${data()}${state.last && results(state)}</main>
  <nav id="places" aria-label="Части страницы"><a href="#data">Данные</a> <a href="#results">Диаграммы</a>
    <a href="#files">Файлы</a></nav>`;

async function begin() {
  state.choices = await ask("api/choices");
  if (innerWidth > 900) state.open = new Set(["engine", "geometry", "regime"]);
  for (const media of ["(prefers-color-scheme: dark)", "print"]) // colours are drawn in
    matchMedia(media).addEventListener("change", () => set({theme: state.theme + 1}));
  let kept = null;
  try {
    const hash = location.hash.slice(1), text = hash && LZString.decompressFromEncodedURIComponent(hash);
    kept = text ? {raw: JSON.parse(text)} : JSON.parse(localStorage.getItem("kshm"));
  } catch { /* a damaged link or store is none */ }
  Object.assign(state, {other: kept?.other || null, isNew: !kept?.raw});
  if (!kept?.raw || !await open(kept.raw, false)) {
    await fresh(ask("api/new", {sample: "gots-diesel"}));
    set({isNew: true});
  }
}
Object.assign(window, {kshm: state, ask, fresh, turn}); // for a person's console and for the tests
begin();
