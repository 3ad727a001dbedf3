// The class's page: an engine that calculates here; the server has files, other structures, what `check` says.
import {alerts, ask, choice, download, given, html, insist, list, memo, picker, printed, send, set, state, wait} from "./common.js";
import {put, section} from "./fields.js";
import {differences, engines, keep, last, remove, seen, storedJobs, storeJobs, text} from "./own.js";
import {clip} from "./scene.js";
import {begin, charts, engineOf, five, makeCard, moveFirst, moves, numbers, paper, read, rest, retype, scene, tables, take, turn, type} from "./view.js";
import {toml} from "./takeaway.js";

const NUMBERS = ["power", "speed", "bore", "stroke", "rod", "lambda", "compression", "efficiency"];

// --- what is asked of the server ---
const scripts = new Map(); // functions by their texts: engines of one shape share them
function loaded(script) {
  if (!scripts.has(script)) scripts.set(script, import(URL.createObjectURL(new Blob([script], {type: "text/javascript"}))));
  return scripts.get(script);
}
const built = async ({engine, scripts: texts}) =>
  engine && engineOf(engine, (await Promise.all(texts.map(loaded))).map(each => each.functions));

// An input that comes from somewhere takes the page; its fields and its engine are asked for.
// What comes anew has no `own` place among the engines yet; `stands` tells that it is kept there.
async function fresh(coming, isNew = true, own = isNew ? {} : state.own, stands = false) {
  const {lost = [], ...came} = await coming, shape = came.raw ? await ask("api/start", came) : came;
  if (!shape.groups) { // what is wrong is said where it is seen
    set({errors: shape.errors ?? []});
    return document.querySelector("#errors")?.scrollIntoView({block: "center"});
  }
  if (isNew && state.raw) Object.assign(state, {past: remembered(), isNew: false});
  if (own !== state.own) Object.assign(state, {own: seen(own), kept: null});
  if (own.raw) Object.assign(state, {other: own.other, second: null, past: [], news: "", isNew: false}); // not what was beside it
  if (stands) state.kept = text({...state, raw: shape.raw});
  await adopt({...shape, remarks: [...lost, ...shape.remarks ?? []]}, {typed: {}, touched: null, errors: []}); // of a workbook what it lost
  if (state.other && !state.second) set({second: await built(await ask("api/start", {raw: state.other}))});
}

// What the server makes of an input: an engine, or what is wrong; then the last good one stays.
async function adopt({errors, raw, groups, absent, warnings = [], remarks = [], ...shape}, changes) {
  const engine = await built(shape), {cylinder} = state.engine ?? {};
  groups.sort((a, b) => a.key.startsWith("report") - b.key.startsWith("report")); // the mechanism first
  const fields = groups.flatMap(({entries}) => entries.flat());
  document.title = `${raw.engine?.name || "Двигатель"} — КШМ`;
  Object.assign(state, {...changes, raw, groups: rest(groups), absent, wrong: [...errors, ...changes.wrong ?? []], isOther: false,
    titles: Object.fromEntries([...groups.map(({key, title}) => [key, title]), ...fields.map(f => [f.key, f.title])]),
    about: Object.fromEntries(fields.map(f => [f.key, [f.title, f.unit].filter(Boolean).join(", ")]))});
  if (engine) {
    Object.assign(state, {engine, isChanged: false, remarks});
    state.groups = rest(groups);
    engine.cylinder = cylinder < engine.scene.each.length ? cylinder : 0;
    if (!engine.sheets.some(({title}) => title === state.sheet)) state.sheet = "";
    state.last = {moves: moves(), warnings};
    state.phi = Math.min(state.phi, state.last.moves.phi.at(-1)); // of a cycle that may be shorter
  }
  store();
  set({});
}

function store() { // what has changed, in its place among the own engines
  const now = text(state);
  if (!state.raw || now === state.kept) return;
  const {news, ...own} = keep(state.own, JSON.parse(now));
  Object.assign(state, {own, kept: now, news, linked: false, engines: engines()});
  if (location.hash) history.replaceState(null, "", location.pathname); // its numbers are no more those
}

function later(changes) { // once a person pauses
  state.isAsked = true;
  clearTimeout(state.later);
  state.later = setTimeout(settle, 400);
  if (changes) set(changes);
}

// What `check` says of all values together and what only a build finds; of another structure, all of it.
async function settle() {
  clearTimeout(state.later);
  state.later = 0;
  store();
  if (state.running) return; // at most one question on its way: asked again at its end
  const {raw, isOther} = state, sent = JSON.stringify(raw);
  set({running: true, isAsked: false});
  const {isLost, busy, errors, built: values, ...now} = await ask(isOther ? "api/start" : "api/settle", {raw});
  set({running: false});
  if (isLost) return set({isAsked: true}); // the numbers stand here already; the rest when there is a connection
  if (busy) return later();
  if (JSON.stringify(state.raw) !== sent || state.isOther !== isOther) return settle();
  const wrong = state.wrong.filter(each => each.isTyped); // what has not come so far
  if (isOther) return adopt({errors, ...now}, {wrong});
  if (errors) { // together they make no engine: the last good one
    take(state.engine, JSON.parse(state.engine.stands));
    return set({wrong: [...wrong, ...errors], last: {...state.last, moves: moves()}});
  }
  state.engine.main.know(values);
  state.engine.stands = sent;
  set({wrong, isChanged: false, remarks: now.remarks, last: {...state.last, warnings: now.warnings}});
}

async function order(kind, title) {
  const {raw, other} = state, job = {title, name: engineName(), ...await send("api/files", {raw, other, kind})};
  if (!job.id) return;
  set({jobs: [job, ...state.jobs.filter(({id}) => id !== job.id)]});
  await watch(job);
}

async function watch(job) {
  if (job.isWatched) return;
  job.isWatched = true;
  storeJobs(state.jobs);
  while (state.jobs.includes(job) && !job.lines && !job.errors) {
    const {isLost, busy, ...now} = await ask(`api/files/${job.id}`);
    if (isLost) break; // goes on with the page
    if (!busy) set(Object.assign(job, now) && {});
    await wait(700);
  }
  job.isWatched = false;
}

async function cancel(id) {
  if (!await send(`api/files/${id}/cancel`, {})) return;
  set({jobs: state.jobs.filter(job => job.id !== id)});
  storeJobs(state.jobs);
}

// --- what a person does ---
const remembered = () => [...state.past, JSON.stringify([state.raw, state.own])].slice(-200);
const free = () => state.engine?.fields.filter(f => !f.fixed) ?? [];
const shapeOf = raw => { // all but what is calculated here
  const rest = structuredClone(raw);
  for (const {path} of free()) put(rest, path, null);
  return JSON.stringify(rest);
};

function back() {
  const [raw, own] = JSON.parse(state.past.pop());
  if (shapeOf(raw) !== shapeOf(state.raw)) return fresh({raw}, false, own.id === state.own.id ? state.own : own);
  const changes = Object.fromEntries(free().map(f => [f.key, read(raw, f.path)]));
  retype(changes);
  state.touched = null;
  type(changes, later);
}

function compare() { // a second engine: this one as it stands
  const {engine, raw} = state, second = engineOf(engine.data, engine.functions);
  take(second, raw);
  second.main.know(Object.fromEntries(engine.main.keys().filter(engine.main.isFixed).map(key => [key, engine.main.get(key)])));
  Object.assign(state, {other: structuredClone(raw), second, errors: []});
  store();
  set({});
}

function drop() {
  Object.assign(state, {other: null, second: null});
  store();
  set({});
}

// An own engine from the list, or what is there when there is none.
const open = engine => engine ? fresh({raw: engine.raw}, false, engine, true)
  : fresh(ask("api/new", {sample: "gots-diesel"}), false, {}, true);

async function away() {
  if (!confirm(`Убрать «${engineName()}» из этого браузера? Вернуть его будет нельзя.`)) return;
  remove(state.own.id);
  set({engines: engines()});
  await open(last());
}

const differing = (raw, other) => { // in words: one or two values
  const all = differences(raw, other).filter(([key]) => state.titles[key]);
  return [...all.slice(0, 2).map(([key, value]) => `${state.titles[key].toLowerCase()} ${printed(value, 9)}`), all.length > 2 && `и ещё ${all.length - 2}`].filter(Boolean).join(", ");
};
const listed = () => state.engines.map((each, i) => {
  const alike = state.engines.findLast((other, k) => k !== i && other.raw.engine?.name === each.raw.engine?.name);
  return [each.id, [each.raw.engine?.name || "Двигатель", alike && differing(each.raw, alike.raw),
    new Date(each.date).toLocaleString("ru", {dateStyle: "short", timeStyle: "short"})].filter(Boolean).join(", ")];
});

async function follow(hash) { // once: the address is free again, and the engine stands beside the own ones
  history.replaceState(null, "", location.pathname);
  let raw = null;
  try { raw = JSON.parse(LZString.decompressFromEncodedURIComponent(hash)); } catch { /* told below */ }
  if (!raw) return set({news: "ссылка повреждена: попросите её ещё раз"});
  const known = engines().find(each => JSON.stringify(each.raw) === JSON.stringify(raw));
  await (known ? open(known) : fresh({raw}, false, {link: true, raw}));
}

// A value at a place: calculated here, or other fields come and go with it.
async function change(key, path, value, reshapes) {
  if (state.touched !== key || reshapes) state.past = remembered(); // one step of undo for one field
  state.touched = key;
  const f = state.engine?.byKey[key];
  if (f && !f.fixed && value !== "" && (!reshapes || f.choices)) return type({[key]: value}, later);
  if (!reshapes) {
    put(state.raw, path, value);
    return later({isOther: true, errors: []});
  }
  const raw = structuredClone(state.raw);
  put(raw, path, value);
  state.open.add(key);
  await fresh({raw}, false);
  if (document.activeElement === document.body) document.querySelector(`[data-key="${key}"] summary`)?.focus();
}

// Another layout or number of cylinders: shaft, phases and masses by the rules of `new`, always from the
// engine with which the play began, so that nothing is lost on the way back.
async function reshape(wanted) {
  const {base} = state.toy?.made === JSON.stringify(state.raw) ? state.toy : {base: structuredClone(state.raw)};
  const {layout, cylinders} = {...state.raw.engine, ...wanted}, own = base.engine;
  const isBase = own.layout === layout && Number(own.cylinders) === Number(cylinders);
  const came = isBase ? {raw: base} : await ask("api/new", {raw: base, layout, cylinders: Number(cylinders)});
  if (came.raw) state.past = remembered();
  await fresh(came, false);
  if (came.raw) state.toy = {base, made: JSON.stringify(state.raw)};
}

const fileName = suffix => `${engineName().replace(/[\\/:*?"<>|\s]+/g, " ").trim().slice(0, 80)}.${suffix}`;
async function share(coming, suffix) { // to friends where there is a way, else as a file
  const blob = await coming, file = new File([blob], fileName(suffix), {type: blob.type});
  if (!navigator.canShare?.({files: [file]})) return download(file, file.name);
  await navigator.share({files: [file], title: engineName()}).catch(() => null); // thought better of it
}

async function film() {
  set({isPlaying: false, isFilmed: true});
  const made = await clip(document.getElementById("mechanism"), turn, state.last.moves.phi.at(-1));
  set({isFilmed: false});
  await share(made, made.type.includes("mp4") ? "mp4" : "webm");
}

const save = () => download(new Blob([toml(state.raw, key => state.about[key], "Исходные данные двигателя для kshm.")]), fileName("toml"));

async function link() {
  location.hash = LZString.compressToEncodedURIComponent(JSON.stringify(state.raw));
  state.linked = location.hash.slice(1);
  try { await navigator.clipboard.writeText(location.href); } catch { /* the address shows it */ }
  set({});
}

const upload = file => fresh(ask(/\.xlsx$/i.test(file.name) ? "api/book" : "api/read", file));

function compose(event) {
  const {cylinders, layout, ...own} = given(event), more = event.submitter.name ? {raw: state.raw} : own;
  fresh(ask("api/new", {cylinders: Number(cylinders), layout, ...more}));
}

function begun(id) { // a further regime begins as the main one
  const {regime, gas, regimes = []} = state.raw, number = regimes.length + 1;
  if (id !== "regimes") return [id, [id], {}];
  return [`regimes[${number}]`, [id, number - 1], {...regime, gas, name: `Режим ${number + 1}`}];
}

const engineName = () => state.raw?.engine?.name || "Двигатель";
const icon = (layout, cylinders) => { // banks as they stand, a dot for each cylinder of a bank
  const banks = {v: [-35, 35], opposed: [-90, 90]}[layout] ?? [0], most = Math.ceil(cylinders / banks.length);
  return html`<svg class="icon" viewBox="-24 -26 48 40" aria-hidden="true"><circle class="axis" r="6" />${banks.map(turn =>
    html`<g transform=${`rotate(${turn})`}><path class="rod" d="M0 0V-12" />${Array.from({length: most}, (_, i) =>
      html`<rect class="body" x=${-6 + i} y=${-22 - i} width="12" height="9" rx="1.5" />`).reverse()}</g>`)}</svg>`;
};
const sample = ({name, title, layout, cylinders, more}) => html`
  <button key=${name} data-sample=${name} onClick=${() => fresh(ask("api/new", {sample: name}))}>
    ${icon(layout, cylinders)}<b>${title}</b><small>${more}</small></button>`;

const toys = () => memo("toys", [state.raw?.engine?.layout, state.raw?.engine?.cylinders], () => html`
  <div id="toys" role="group" aria-label="Расположение и число цилиндров">${state.choices.shapes.map(([title, layout, cylinders]) => {
    const {engine = {}} = state.raw ?? {}, isThis = engine.layout === layout && Number(engine.cylinders) === cylinders;
    return html`<button data-shape=${title} aria-pressed=${String(isThis)} onClick=${() => reshape({layout, cylinders})}>
      ${icon(layout, cylinders)}${title}</button>`;
  })}</div>`);

const data = ({fields} = state.choices) => html`
  <section id="data" aria-label="Исходные данные">
    ${state.raw && toys()}
    <p class="bar" hidden=${!state.engines.length}>${choice("Мои двигатели", "own",
      [...state.own.id ? [] : [["", "—"]], ...listed()], state.own.id ?? "", id => id && open(engines().find(each => each.id === id)))}
      <button id="away" hidden=${!state.own.id} onClick=${away}>Убрать из списка</button></p>
    <p id="news" role="status">${state.news}</p>
    <details id="new" open=${state.isNew} onToggle=${e => set({isNew: e.target.open})}>
      <summary>Новый двигатель</summary>
      ${memo("samples", [], () => html`<h3>Образцы</h3><div id="samples">${state.choices.samples.map(sample)}</div>`)}
      <h3>По заданию</h3>
      <form id="task" onSubmit=${compose}>
        <label>${fields.cylinders} <input id="cylinders" name="cylinders" type="number" min="1" max="12" defaultValue="4" required /></label>
        ${choice(fields.layout, "layout", Object.entries(state.choices.layouts))}
        ${choice(fields.strokes, "strokes", Object.entries(state.choices.strokes), "4")}
        ${choice(fields.kind, "kind", Object.entries(state.choices.kinds))}
        ${NUMBERS.map(key => html`<label>${fields[key]} <input name=${key} inputmode="decimal" autocomplete="off" maxlength="20" /></label>`)}
        <p class="bar"><button class="first">Составить</button>
        <button name="alike">Вариант этого двигателя</button></p>
      </form>
      <p>${picker("Открыть .toml или книгу .xlsx", ".toml,.xlsx", upload, "upload")}</p></details>
    <p class="bar">
      <button id="undo" disabled=${!state.past.length} onClick=${back}>Отменить</button>
      <button id="save" onClick=${save}>Скачать .toml</button>
      <button id="link" onClick=${link}>${state.linked ? "Ссылка в адресе" : "Ссылка"}</button>
      <button id="keep" disabled=${!state.engine} onClick=${compare}>Сравнить с этим</button>
      <button id="drop" hidden=${!state.other} onClick=${drop}>Убрать второй</button></p>
    ${state.other && html`<p id="other"><small>Второй, точками: ${state.other.engine?.name ?? "двигатель"}${differing(state.other, state.raw) && `: ${differing(state.other, state.raw)}`}</small></p>`}
    <p><label>Найти поле <input id="find" type="search" autocomplete="off" value=${state.find}
      onInput=${e => set({find: e.target.value})} /></label></p>
    <div id="fields">${state.groups.map(group => section(group, change, reshape))}</div>
    <p class="bar">Добавить раздел: ${Object.entries(state.absent).map(([id, title]) =>
      html`<button onClick=${() => change(...begun(id), true)}>${title}</button>`)}</p>
  </section>`;

const shared = () => html`<p class="bar"><button id="picture" onClick=${() => share(makeCard(), "png")}>Карточка</button>
  <button id="clip" disabled=${state.isFilmed} onClick=${film}>${state.isFilmed ? "Снимается…" : "Ролик"}</button></p>`;

const job = ({id, title, name, state: now, place, wait, seconds, files = [], lines, errors}) => html`<li key=${id}><b>${title}</b>${name && `, ${name}`}${": "}
  ${now === "waiting" && `в очереди, перед вами ${place}${wait ? `, около ${wait} с` : ""} `}${now === "running" && `делается, ${seconds} с `}
  ${["waiting", "running"].includes(now) && html`<button onClick=${() => cancel(id)}>Не делать</button>`}
  ${files.map(({file, name, size}) => html`
    <a href=${`api/files/${id}/${encodeURIComponent(file)}`} download=${name}>${name}</a>
    ${` (${printed(size / 1e6, 2)} МБ) `}`)}
  ${list(lines || errors || [], now === "done" ? "warn" : "bad")}</li>`;

const files = () => html`<section id="files" aria-label="Файлы"><h2>Файлы</h2><p class="bar">${Object.entries(state.choices.files).map(([kind, title]) =>
  html`<button data-kind=${kind} onClick=${() => order(kind, title)}>${title}</button>`)}</p>
  <ul id="jobs" aria-live="polite">${state.jobs.map(job)}</ul></section>`;

const page = () => html`
  <a class="skip" href="#five">К данным двигателя</a> <a class="skip" href="#results">К результатам</a>
  <header><h1>${engineName()}</h1>
    <nav aria-label="Страницы"><a href="teacher">Преподавателю</a></nav></header>
  <main>${alerts([...state.errors, ...state.wrong])}
    <aside id="inputs">${state.engine && five(change)}${data()}</aside>
    ${state.engine && html`<div id="view">${scene(shared())}${numbers()}${charts()}${files()}${tables()}</div>`}</main>
  ${state.engine && paper()}
  <p id="lost" class="warn" role="status">${state.isLost && "Нет связи с сервером: числа считает сама страница; файлы и новое строение — когда связь будет."}</p>
  <p class="hidden" role="status">${state.told}</p>
  <nav id="places" aria-label="Части страницы">
    <a href="#data">Данные</a> <a href="#results">Диаграммы</a> <a href="#files">Файлы</a></nav>`;

await begin({
  past: [], groups: [], absent: {}, jobs: storedJobs(), isNew: false, own: {}, kept: null, news: "", engines: engines(),
  choices: await insist("api/choices"), open: new Set(innerWidth > 900 ? ["geometry"] : []),
  again: () => { state.raw ? state.isAsked && settle() : arrive(); state.jobs.forEach(watch); },
}, page, later);
Object.assign(globalThis, {ask, fresh});
live.isIdle = () => !state.running && !state.later; // for a person's console and for the tests
addEventListener("hashchange", () => { // a link put into the address of this very page
  const hash = location.hash.slice(1);
  if (hash && hash !== state.linked && !document.getElementById(hash)) follow(hash);
});
addEventListener("pagehide", store);
addEventListener("storage", () => set({engines: engines()})); // of another tab
state.jobs.forEach(watch);
async function arrive() {
  const hash = location.hash.slice(1);
  if (hash) await follow(hash);
  if (!state.raw) await open(last());
  if (!state.engine) await open(); // what was kept is no engine of today
}
await arrive();
moveFirst();
