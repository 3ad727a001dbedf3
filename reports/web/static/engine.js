// The page of an engine: a mapping of the file's values is all its state, the rest follows from it.
import {after, alerts, ask, choice, download, given, html, insist, list, memo, options, picker, printed, row, send, set, state, symbol, table, wait} from "./common.js";
import {dark, figure, follow as cursor} from "./drawn.js";
import {put, section} from "./fields.js";
import {engines, keep, last, remove, seen, storedJobs, storeJobs, text} from "./own.js";
import {clip, parts, picture, pose} from "./scene.js";

const NUMBERS = ["power", "speed", "bore", "stroke", "rod", "lambda", "compression", "efficiency"];
const KEY_NUMBERS = [/^N_e_calc$/, /^M_mean$/, /^M_max$/, /^Rpin\d*_max$/];
const printing = matchMedia("print");

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
  shape.groups.sort((a, b) => a.key.startsWith("report") - b.key.startsWith("report")); // the mechanism first
  if (stands) state.kept = text({...state, ...shape});
  const titles = Object.fromEntries(shape.groups.flatMap(({key, title, entries}) =>
    [[key, title], ...entries.flat().map(f => [f.key, f.title])]));
  await solve({...shape, titles, typed: {}, touched: null, errors: []});
}

function store() { // what has changed, in its place among the own engines
  const now = text(state);
  if (now === state.kept) return;
  const {news, ...own} = keep(state.own, JSON.parse(now));
  Object.assign(state, {own, kept: now, news, linked: false, engines: engines()});
  if (location.hash) history.replaceState(null, "", location.pathname); // its numbers are no more those
}

async function solve(changes) {
  if (state.running) return set({...changes, isStale: true}); // at most one question on its way
  clearTimeout(state.later);
  set({...changes, running: true, isStale: false});
  const {raw, other, sheet, cylinder} = state, answer = raw => raw && ask("api/solve", {raw, sheet, cylinder});
  store();
  const [last, second] = await Promise.all([answer(raw), answer(other)]);
  if (last.isLost) return set({running: false, errors: last.errors}); // asked again when there is a connection
  const phi = last.errors ? state.phi : Math.min(state.phi, last.moves.phi.at(-1)); // of a cycle that may be shorter
  set({running: false, ...last.errors ? {wrong: last.errors} : {wrong: [], last, second, phi}});
  if (state.isStale) return solve();
  if (last.busy) state.later = setTimeout(solve, 1000 * last.busy);
  // The checks take longer: they wait until nothing has changed for a while.
  else if (!last.errors) state.later = setTimeout(async () => set(await send("api/solve", {raw})), 400);
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
function back() {
  const [raw, own] = JSON.parse(state.past.pop());
  fresh({raw}, false, own.id === state.own.id ? state.own : own);
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

const listed = () => state.engines.map(each => [each.id, [each.raw.engine?.name || "Двигатель",
  new Date(each.date).toLocaleString("ru", {dateStyle: "short", timeStyle: "short"})].join(", ")]);

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

const BASE = 180; // degrees a second at a pace of one
function turn(phi) {
  state.phi = Number(phi);
  follow();
}

let frame = 0;
const inWindow = new Set(); // charts in the window: while the engine runs the others wait
const watcher = new IntersectionObserver(all => all.forEach(each => inWindow[each.isIntersecting ? "add" : "delete"](each.target)));

function follow() {
  const {last, phi, isPlaying} = state, root = document.getElementById("scene");
  if (!root) return;
  const isTold = !isPlaying || frame++ % 4 === 0; // nobody reads sixty numbers a second
  pose(root, last.moves, phi, isTold);
  if (isTold) {
    document.getElementById("angle").textContent = `${Math.round(phi)}°`;
    document.getElementById("phi").value = phi;
  }
  const figures = document.querySelectorAll("#charts > figure");
  last.charts.forEach((own, i) => {
    watcher.observe(figures[i]);
    if (!isPlaying || inWindow.has(figures[i])) cursor(figures[i], own, phi, isTold);
  });
}

function play() {
  let before = performance.now();
  const step = now => {
    if (!state.isPlaying) return;
    const {moves} = state.last, more = Math.min(Math.max(now - before, 0), 250) / 1000 * BASE * state.pace;
    before = now;
    turn((state.phi + more) % moves.phi.at(-1));
    requestAnimationFrame(step);
  };
  set({isPlaying: !state.isPlaying});
  if (state.isPlaying) requestAnimationFrame(step);
}

const fileName = suffix => `${engineName().replace(/[\\/:*?"<>|\s]+/g, " ").trim().slice(0, 80)}.${suffix}`;
const drawing = () => document.getElementById("mechanism");

async function share(coming, suffix) { // to friends where there is a way, else as a file
  const blob = await coming, file = new File([blob], fileName(suffix), {type: blob.type});
  if (!navigator.canShare?.({files: [file]})) return download(file, file.name);
  await navigator.share({files: [file], title: engineName()}).catch(() => null); // thought better of it
}

async function film() {
  set({isPlaying: false, isFilmed: true});
  const made = await clip(drawing(), turn, state.last.moves.phi.at(-1));
  set({isFilmed: false});
  await share(made, made.type.includes("mp4") ? "mp4" : "webm");
}

async function save() {
  const made = await send("api/toml", {raw: state.raw});
  if (made) download(new Blob([made.text]), fileName("toml"));
}

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

const forms = (count, one, few, many) =>
  ({one, few, many, other: many})[new Intl.PluralRules("ru").select(count)];

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
      <button id="keep" onClick=${() => solve({other: structuredClone(state.raw)})}>Сравнить с этим</button>
      <button id="drop" hidden=${!state.other} onClick=${() => solve({other: null})}>Убрать второй</button></p>
    ${alerts([...state.errors, ...state.wrong])}
    <p><label>Найти поле <input id="find" type="search" autocomplete="off" value=${state.find}
      onInput=${e => set({find: e.target.value})} /></label></p>
    <div id="fields">${state.groups.map(group => section(group, change, reshape))}</div>
    <p class="bar">Добавить раздел: ${Object.entries(state.absent).map(([id, title]) =>
      html`<button onClick=${() => change(...begun(id), true)}>${title}</button>`)}</p>
  </section>`;

const slowed = ({speed}) => { // one second of the engine on the page
  const times = Math.round(speed * 6 / BASE / state.pace);
  return times > 1 ? `медленнее в ${printed(times, 2)} ${forms(times, "раз", "раза", "раз")}` : "как в жизни";
};

const scene = ({moves}) => {
  const {front, strip, star, values} = parts(moves, dark.matches, cylinder => solve({cylinder}));
  return html`<section id="scene" aria-label="Механизм">
    <div id="stage"><figure>${front}</figure><div id="strip" role="group" aria-label="Силы цилиндра">${strip}</div>
      <div id="drive">
        <button id="play" class="first" aria-pressed=${String(state.isPlaying)} onClick=${play}>${state.isPlaying ? "Стоп" : "Пуск"}</button>
        <label for="phi">φ <output id="angle" /></label>
        <input id="phi" type="range" min="0" max=${moves.phi.at(-1)} step="1" onInput=${e => turn(e.target.value)} />
        <label class="pace"><span>${slowed(moves)}</span><input id="pace" type="range" min="-1" max="0.7" step="0.1"
          aria-label="Скорость показа" aria-valuetext=${`${printed(state.pace, 2)}×`} value=${Math.log10(state.pace)}
          onInput=${e => set({pace: 10 ** Number(e.target.value)})} /><output>${printed(state.pace, 2)}×</output></label></div></div>
    <figure id="cranks">${star}<figcaption>Звезда кривошипов</figcaption></figure>
    <div id="forces">${values}<p class="bar"><button id="picture" onClick=${() => share(picture(drawing()), "png")}>Картинка</button>
      <button id="clip" disabled=${state.isFilmed} onClick=${film}>${state.isFilmed ? "Снимается…" : "Ролик"}</button></p></div>
  </section>`;
};

const job = ({id, title, name, state: now, place, wait, seconds, files = [], lines, errors}) => html`<li key=${id}><b>${title}</b>${name && `, ${name}`}${": "}
  ${now === "waiting" && `в очереди, перед вами ${place}${wait ? `, около ${wait} с` : ""} `}${now === "running" && `делается, ${seconds} с `}
  ${["waiting", "running"].includes(now) && html`<button onClick=${() => cancel(id)}>Не делать</button>`}
  ${files.map(({file, name, size}) => html`
    <a href=${`api/files/${id}/${encodeURIComponent(file)}`} download=${name}>${name}</a>
    ${` (${printed(size / 1e6, 2)} МБ) `}`)}
  ${list(lines || errors || [], now === "done" ? "warn" : "bad")}</li>`;

const verdict = ({ok, odd, reason}) => ok ? ["выполнена", "ok"] : odd ? ["необычно", "warn"] : reason ? [`принято: ${reason}`, "warn"] : ["не выполнена", "bad"];

const sheets = () => { // by chapters, in words
  const chapters = Object.groupBy(state.sheets, ([, , chapter]) => chapter);
  return html`<label>Диаграммы <select id="sheet" onChange=${e => solve({sheet: e.target.value})}>${Object.entries(chapters).map(([chapter, all]) =>
    html`<optgroup key=${chapter} label=${chapter}>${options(all, state.sheet)}</optgroup>`)}</select></label>`;
};

const results = ({last, second}) => html`
  <section id="results" aria-label="Результаты" tabindex="-1">
    <h2>${engineName()}</h2>
    <dl id="numbers">${KEY_NUMBERS.map(key => last.results.flatMap(({rows}) => rows).find(each => key.test(each.key))).filter(Boolean).map(each => html`
      <div key=${each.key} title=${each.title}><dt>${symbol(each.symbol)}</dt><dd><b>${each.text}</b> ${each.unit}</dd></div>`)}</dl>
    <p id="stale" class="warn" hidden=${!state.wrong.length}>Показан последний верный двигатель: исправьте отмеченное в данных.</p>
    <p>${sheets()}</p>
    <div id="charts" class="cards">${last.charts.map(own =>
      figure(own, second?.charts?.find(c => c.id === own.id), printing.matches))}</div>
    <div id="files"><h3>Файлы</h3><p class="bar">${Object.entries(state.choices.files).map(([kind, title]) =>
      html`<button data-kind=${kind} onClick=${() => order(kind, title)}>${title}</button>`)}</p>
      <ul id="jobs" aria-live="polite">${state.jobs.map(job)}</ul></div>
    ${memo("tables", [last, second, state.checks, state.remarks], () => html`
    <div id="checks">${state.checks.length > 0 && table("Проверки расчёта", state.checks.map(c =>
      row([[c.title], [c.value, "n"], verdict(c)])))}</div>
    ${list([...last.warnings, ...state.remarks], "warn")}
    <div id="summary">${last.results.map(({id, title, rows}) => html`
      <details key=${id} open=${/^(summary_torque|geometry)/.test(id)}><summary>${title}</summary>
        ${table(title, rows.map(r => row([[r.title], [symbol(r.symbol), "s"], [r.text, "n"],
          [second?.results?.find(t => t.id === id)?.rows.find(o => o.key === r.key)?.text, "n"],
          [r.unit, "s"]], {"data-key": r.key})))}</details>`)}</div>`)}
  </section>`;

const page = () => html`
  <a class="skip" href="#results">К результатам</a>
  <header><h1>Кривошипно-шатунный механизм</h1>
    <nav aria-label="Страницы"><a href="teacher">Преподавателю</a></nav></header>
  <main>${state.last && scene(state.last)}${data()}${state.last && results(state)}</main>
  <nav id="places" aria-label="Части страницы">
    <a href="#data">Данные</a> <a href="#results">Диаграммы</a> <a href="#files">Файлы</a></nav>`;

after.push(() => follow());
set({
  past: [], groups: [], sheets: [], absent: {}, sheet: "П4.1", cylinder: 0, phi: 0, pace: 1, isPlaying: false, typed: {}, wrong: [],
  checks: [], remarks: [], jobs: storedJobs(), find: "", isNew: false, own: {}, kept: null, news: "", engines: engines(), choices: await insist("api/choices"),
  open: new Set(innerWidth > 900 ? ["engine", "geometry", "regime"] : []), turn, follow, redraw: () => set({switched: (state.switched ?? 0) + 1}),
  again: () => { state.raw ? solve() : begin(); state.jobs.forEach(watch); },
}, page);
for (const media of [dark, printing]) media.addEventListener("change", () => set({})); // colours are drawn in
Object.assign(window, {kshm: state, ask, fresh, turn}); // for a person's console and for the tests
addEventListener("hashchange", () => { // a link put into the address of this very page
  const hash = location.hash.slice(1);
  if (hash && hash !== state.linked && !document.getElementById(hash)) read(hash);
});
addEventListener("storage", () => set({engines: engines()})); // of another tab
state.jobs.forEach(watch);
async function begin() {
  const hash = location.hash.slice(1);
  if (hash) await read(hash);
  if (!state.raw) await open(last());
  if (!state.raw) await open(); // what was kept is no engine of today
}
await begin();
if (!matchMedia("(prefers-reduced-motion: reduce)").matches && !state.isPlaying) play();
