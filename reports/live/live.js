// The live page: the model calculates itself here, fields change it, what is seen follows.
import {after, download, html, list, memo, options, printed, row, set, state, symbol, table} from "./common.js";
import {between, dark, figure, follow as cursor, inks} from "./drawn.js";
import {put, section} from "./fields.js";
import {parts, pose} from "./scene.js";
import {calculator} from "./calculator.js";
import {functions} from "./program.js";
import {functions as fineFunctions} from "./fine.js";
import {cell} from "./numbers.js";
import {card, toml, workbook} from "./takeaway.js";

const data = JSON.parse(document.getElementById("live-data").textContent);
const main = calculator({functions, ...data.program}); // the book's own step
const fine = calculator({functions: fineFunctions, ...data.fine}); // the step of curves
const fields = data.fields.flatMap(({entries}) => entries.flat());
const byKey = Object.fromEntries(fields.flatMap(f => [[f.key, f], [f.cell, f]]));
const others = data.fields.map(({entries, ...group}) => ({...group, entries: entries.map(entry => entry.filter(f => !data.main.includes(f.key)))}))
  .filter(({entries}) => entries.some(entry => entry.length));
const start = structuredClone(data.raw), BASE = 180; // degrees a second
const STROKES = {4: ["впуск", "сжатие", "рабочий ход", "выпуск"], 2: ["рабочий ход", "сжатие"]}[data.strokes];
const FIRST = "", MOST_CHECKS = 12; // of a page of print
const printing = matchMedia("print");

// --- numbers ---
const scalars = [...data.numbers.map(each => each.key), ...data.checks.map(each => each.value)];
const isWhole = () => scalars.every(key => Number.isFinite(main.get(key)));
const known = (model, changes) => Object.fromEntries(Object.entries(changes).filter(([key]) => model.isInput(key)));
const putAll = changes => [main, fine].forEach(model => model.set(known(model, changes)));
const valueOf = f => f.path.reduce((part, key) => part?.[key], state.raw);
const said = (f, value) => f.choices ? f.choices[value] : value; // what a formula compares

function fault(f, value) { // in the words of `check`
  const {limit, number, whole} = data.sentences, hint = `допустимо от ${printed(f.min, 9)} до ${printed(f.max, 9)} ${f.unit}`.trim();
  if (f.choices) return value in f.choices ? null : {where: f.key, what: limit.replace("{}", value), hint: ""};
  if (typeof value !== "number") return {where: f.key, what: number.replace("{}", value), hint};
  if (f.whole && !Number.isInteger(value)) return {where: f.key, what: whole.replace("{}", printed(value, 9)), hint};
  return value < f.min || value > f.max ? {where: f.key, what: limit.replace("{}", printed(value, 9)), hint} : null;
}

// Values by keys of fields; what does not go is said, and leaves the engine as it was.
function calculate(changes) {
  const began = performance.now(), taken = {}, before = {}, faults = [];
  for (const [key, value] of Object.entries(changes)) {
    const f = byKey[key], wrong = f.fixed ? {where: f.key, what: "это строение двигателя", hint: "нужен build"} : fault(f, value);
    if (wrong) faults.push(wrong);
    else [taken[f.cell], before[f.cell]] = [said(f, value), said(f, valueOf(f))];
  }
  putAll(taken);
  if (!isWhole()) {
    putAll(before);
    const [where] = Object.keys(changes);
    return [...faults, {where: byKey[where].key, what: "с этим значением расчёт не даёт чисел", hint: "верните прежнее"}];
  }
  for (const [key, value] of Object.entries(changes)) if (!faults.some(each => each.where === byKey[key].key)) put(state.raw, byKey[key].path, value);
  for (const each of state.charts.values()) each.isStale = true;
  Object.assign(state, {last: shown(), spent: performance.now() - began, isChanged: JSON.stringify(state.raw) !== JSON.stringify(start)});
  return faults;
}

// --- what is drawn ---
function moves() {
  const {tables, joints, each, forces, throws} = data.scene, column = (i, key) => fine.get(`${tables[i]}.${key}`);
  const phi = Array.from(fine.get("P4_1.phi_deg")), gas = fine.get("P4_1.Pg_MPa"), most = Math.max(...gas, 1e-9);
  return {
    phi, turn: fine.get("P3_1.phi_deg"), throws, cylinder: state.cylinder,
    joints: joints.map(kind => kind.map(joint => joint.map(key => Array.from(fine.get(key))))),
    each: each.map((one, i) => ({...one, shift: i ? phi[0] - column(i, "phase_deg")[0] : 0})),
    gas: Array.from(gas, value => Math.min(Math.max(value / most, 0), 1)),
    forces: Object.fromEntries(Object.entries(forces).map(([key, about]) =>
      [key, {...about, values: Array.from(column(state.cylinder, key))}])),
    radius: fine.get("live_radius_mm"), wall: fine.get("live_wall_mm"), bore: fine.get("live_bore_mm"),
    speed: fine.get("regime_speed_rpm"),
  };
}

function chartOf(spec) { // anew only where something has changed
  const before = state.charts.get(spec.id);
  if (before && !(before.isStale && (state.isAll || before.isSeen !== false))) return before;
  const keys = [...spec.lines.flatMap(({x, y}) => [x, y]), ...spec.contact.map(([key]) => key)];
  const model = keys.every(fine.has) ? fine : main, numbers = key => Array.from(model.get(key), value => Number.isFinite(value) ? value : null);
  const curves = spec.lines.map(({name, x, y}) => ({name, x: numbers(x), y: numbers(y)}));
  let way = spec.kind === "polar" ? curves[0] : null;
  if (spec.contact.length) {
    const [x, y] = spec.contact.map(([key, sign]) => Array.from(model.get(key), value => value * sign));
    const far = x.map((px, i) => Math.max(Math.hypot(px, y[i]), 1e-12));
    way = {x: x.map((px, i) => px / far[i]), y: y.map((py, i) => py / far[i])};
  }
  const phi = ["P3_1.phi_deg", "P4_1.phi_deg"].filter(model.has).map(model.get).find(each => each.length === way?.x.length);
  const made = {...spec, curves, path: way && phi ? {phi: Array.from(phi), x: way.x, y: way.y} : null, isSeen: before?.isSeen};
  if (spec.loads && made.path) Object.assign(made, {strokes: STROKES, marks: loads(made.path)});
  state.charts.set(spec.id, made);
  return made;
}

function loads({phi, x, y}) { // of a journal: the greatest with its angle, the mean
  const far = x.map((px, i) => Math.hypot(px, y[i])), i = far.indexOf(Math.max(...far));
  const mean = far.slice(0, -1).reduce((sum, each) => sum + each, 0) / (far.length - 1);
  return {x: x[i], y: y[i], name: `R′_max = ${printed(far[i], 3)} при ${phi[i]}°`, mean, meanName: `R′_ср = ${printed(mean, 3)}`};
}

const drawnCharts = () => state.sheet === FIRST ? data.charts.filter(each => each.first).sort((a, b) => a.first - b.first)
  : data.charts.filter(each => each.sheet === state.sheet);
const shown = () => ({moves: moves(), warnings: []});
const number = ({key, digits}) => cell(main.get(key), digits);

// --- what a person does ---
let asked = 0;
function change(key, path, value) {
  state.waiting[key] = value;
  asked ||= requestAnimationFrame(() => {
    asked = 0;
    const changes = state.waiting, keys = Object.keys(changes);
    state.waiting = {};
    const rest = state.wrong.filter(each => !keys.includes(each.where));
    set({wrong: [...rest, ...calculate(changes)]});
    clearTimeout(state.later);
    state.later = setTimeout(() => { // charts out of sight, and what is read aloud
      state.isAll = true;
      set({told: `Пересчитано: ${data.numbers.map(each => `${each.title} ${number(each)} ${each.unit}`).join(", ")}`});
      state.isAll = false;
    }, 400);
  });
}

function back() {
  const changes = Object.fromEntries(fields.filter(f => !f.fixed).map(f => [f.key, f.path.reduce((part, key) => part?.[key], start)]));
  Object.assign(state, {typed: {}, wrong: []});
  set({wrong: calculate(changes)});
}

function turn(phi) {
  state.phi = Number(phi);
  follow();
}

const watcher = new IntersectionObserver(all => {
  for (const {target, isIntersecting} of all) {
    const own = state.charts.get(target.id.replace("chart-", ""));
    if (own) own.isSeen = isIntersecting;
  }
  if (!state.isPlaying) set({});
});

let frame = 0;
function follow() {
  const {last, phi, isPlaying} = state, root = document.getElementById("scene");
  if (!root) return;
  const isTold = !isPlaying || frame++ % 4 === 0;
  pose(root, last.moves, phi, isTold);
  if (isTold) {
    document.getElementById("angle").textContent = `${Math.round(phi)}°`;
    document.getElementById("phi").value = phi;
  }
  for (const node of document.querySelectorAll("#charts > figure")) {
    watcher.observe(node);
    const own = state.charts.get(node.id.replace("chart-", ""));
    if (own && (!isPlaying || own.isSeen)) cursor(node, own, phi, isTold);
  }
}

function play() {
  let before = performance.now();
  const step = now => {
    if (!state.isPlaying) return;
    const more = Math.min(Math.max(now - before, 0), 250) / 1000 * BASE * state.pace;
    before = now;
    turn((state.phi + more) % state.last.moves.phi.at(-1));
    requestAnimationFrame(step);
  };
  set({isPlaying: !state.isPlaying});
  if (state.isPlaying) requestAnimationFrame(step);
  else set({told: `φ ${Math.round(state.phi)}°`});
}

const about = key => {
  const f = byKey[key];
  return f ? [f.title, f.unit].filter(Boolean).join(", ") : "";
};
const saveToml = () => download(new Blob([toml(state.raw, about, "Исходные данные двигателя для kshm, с живой страницы.")]), `${data.file}-правка.toml`);

async function saveBook() {
  const values = Object.fromEntries(fields.filter(f => !f.fixed).map(f => [f.cell, said(f, valueOf(f))]));
  download(await workbook(data.book, values), `${data.file}-правка.xlsx`);
}

const look = name => getComputedStyle(document.body).getPropertyValue(name) && `rgb(${rgb(name)})`;
function rgb(name) { // light-dark() as a canvas takes it
  const probe = Object.assign(document.createElement("i"), {style: `color: var(${name})`});
  document.body.append(probe);
  const found = getComputedStyle(probe).color.match(/[\d.]+/g).slice(0, 3).join(",");
  probe.remove();
  return found;
}

async function makeCard() {
  const {raw, phi, last: {moves: {speed, phi: over}}} = state, m = [Array.from(fine.get("P4_2.phi_deg") ?? main.get("P4_2.phi_deg")), Array.from(fine.get("P4_2.Msum_Nm") ?? main.get("P4_2.Msum_Nm"))];
  const stroke = STROKES[Math.min(Math.floor(phi / 180), STROKES.length - 1)];
  return card(document.getElementById("mechanism"), {
    title: raw.engine.name, about: `${printed(speed)} мин⁻¹ · φ = ${Math.round(phi)}°, ${stroke}`,
    numbers: data.numbers.map(each => [each.symbol, number(each), each.unit]),
    curve: {x: m[0], y: m[1], at: [phi, between(m[0], m[1], Math.min(phi, over.at(-1))) ?? 0], name: "Крутящий момент, Н·м", mean: main.get("M_mean")},
    colours: {page: look("--page"), card: look("--card"), text: look("--text"), soft: look("--soft"),
      first: `#${data.palette[0]}`, second: `#${data.palette[1]}`},
  });
}
const saveCard = async () => download(await makeCard(), `${data.file}.png`);

// --- the page ---
const five = () => html`<section id="five" aria-label="Главные размеры"><h2>Меняйте</h2>
  ${data.main.map(key => memo(`five ${key}`, [state.typed[key], JSON.stringify(state.wrong), state.raw], () =>
    section({title: "", key: `five ${key}`, path: null, entries: [[byKey[key]]], isPlain: true}, change)))}
  <p class="bar"><button id="back" disabled=${!state.isChanged} onClick=${back}>Как при сборке</button></p></section>`;

const dataPart = () => html`<section id="data" aria-label="Исходные данные">
  <h2>Все исходные</h2>
  <p><label>Найти поле <input id="find" type="search" autocomplete="off" value=${state.find} onInput=${e => set({find: e.target.value})} /></label></p>
  <p><small>Затенённое поле — строение двигателя или то, что связано с другими: нужен build.</small></p>
  <div id="fields">${others.map(group => section(group, change))}</div></section>`;

const numbers = () => html`<dl id="numbers">${data.numbers.map(each => html`
  <div key=${each.key} data-key=${each.key} title=${each.title}><dt>${symbol(each.symbol)}</dt>
    <dd><b>${number(each)}</b> ${each.unit}${each.at && html`<small> при ${cell(main.get(each.at), ["fixed", 0, ""])}°</small>`}</dd></div>`)}</dl>`;

const forms = count => ({one: "раз", few: "раза"})[new Intl.PluralRules("ru").select(count)] ?? "раз";
const slowed = speed => {
  const times = Math.round(speed * 6 / BASE / state.pace);
  return times > 1 ? `медленнее в ${printed(times, 2)} ${forms(times)}` : "как в жизни";
};

const scene = ({moves}) => {
  const {front, strip, star, values} = parts(moves, dark.matches, cylinder => {
    state.cylinder = cylinder;
    set({last: shown()});
  });
  return html`<section id="scene" aria-label="Механизм">
    <div id="stage"><figure>${front}</figure><div id="strip" role="group" aria-label="Силы цилиндра" hidden=${moves.each.length < 2}>${strip}</div>
      <div id="drive">
        <button id="play" class="first" aria-pressed=${String(state.isPlaying)} onClick=${play}>${state.isPlaying ? "Стоп" : "Пуск"}</button>
        <label for="phi">φ <output id="angle" aria-live="off" /></label>
        <input id="phi" type="range" min="0" max=${moves.phi.at(-1)} step="1" onInput=${e => turn(e.target.value)} />
        <label class="pace"><span>${slowed(moves.speed)}</span><input id="pace" type="range" min="-1" max="0.7" step="0.1"
          aria-label="Скорость показа" aria-valuetext=${`${printed(state.pace, 2)}×`} value=${Math.log10(state.pace)}
          onInput=${e => set({pace: 10 ** Number(e.target.value)})} /><output aria-live="off">${printed(state.pace, 2)}×</output></label></div></div>
    <div id="beside"><figure id="cranks">${star}<figcaption>Звезда кривошипов</figcaption></figure>
      <div id="forces">${values}</div></div>
  </section>`;
};

const sheetChoice = () => {
  const chapters = Object.groupBy(data.sheets.filter(({title}) => data.charts.some(each => each.sheet === title)), each => each.chapter);
  return html`<label>Диаграммы <select id="sheet" onChange=${e => set({sheet: e.target.value})}>
    <option value=${FIRST} selected=${state.sheet === FIRST}>Главные</option>${Object.entries(chapters).map(([chapter, all]) => html`
      <optgroup key=${chapter} label=${chapter}>${options(all.map(each => [each.title, each.heading]), state.sheet)}</optgroup>`)}</select></label>`;
};

const charts = () => html`<section id="results" aria-label="Диаграммы и результаты" tabindex="-1">
  <p>${sheetChoice()}</p>
  <div id="charts" class="cards">${drawnCharts().map(spec => figure(chartOf(spec), null, printing.matches))}</div></section>`;

const verdict = ({key, good, odd, reason}) => main.get(key) === good ? ["выполнена", "ok"]
  : odd ? ["необычно", "warn"] : reason ? [`принято: ${reason}`, "warn"] : ["не выполнена", "bad"];
const checks = rows => table("Проверки расчёта", rows.filter(each => !each.odd || main.get(each.key) !== each.good).map(each =>
  row([[each.title], [cell(main.get(each.value), ["fixed", Math.abs(main.get(each.value)) >= 1 ? 2 : 4, ""]), "n"], verdict(each)])));

const still = key => state.isChanged && main.isFixed(key) ? " still" : "";
const cellOf = (key, digits) => key ? [cell(main.get(key), digits), `n${still(key)}`] : [""];
const head = columns => html`<thead><tr>${columns.map(({symbol: name, unit, title}) => html`
  <th class="n" title=${title}>${symbol(name)}${unit && html`<br /><small>${unit}</small>`}</th>`)}</tr></thead>`;
const blocks = {
  list: ({title, rows}) => table(title, rows.map(({key, title, symbol: name, unit, digits}) =>
    row([[title], [symbol(name), "s"], cellOf(key, digits), [unit, "s"]], {"data-key": key}))),
  verdicts: ({rows}) => checks(rows),
  grid: ({title, labels, rows}) => table(title, rows.map(({symbol: name, unit, digits, cells}) =>
    row([[symbol(name)], [unit, "s"], ...cells.map(key => cellOf(key, digits))])), html`<thead><tr><th /><th />${labels.map(each => html`<th class="n">${each}</th>`)}</tr></thead>`),
  table: ({title, columns}) => {
    const all = columns.map(({key}) => main.get(key));
    return table(title, Array.from(all[0], (_, i) => row(columns.map(({key, digits}, k) => [cell(all[k][i], digits), `n${still(key)}`]))), head(columns));
  },
};

const tables = () => html`<section id="tables" aria-label="Таблицы">
  ${checks(data.checks)}${list(data.remarks, "warn")}
  <h2>Таблицы книги</h2>
  ${data.fixedTables.length > 0 && html`<p><small>Посчитано при сборке, здесь не меняется${state.isChanged ? " (после правки бледное: нужен build)" : ""}: ${data.fixedTables.join("; ")}.</small></p>`}
  ${data.sheets.filter(each => each.blocks.length).map(({title, heading, blocks: all}) => html`
    <details key=${title} data-sheet=${title} open=${state.open.has(title)} onToggle=${e => { state.open[e.target.open ? "add" : "delete"](title); set({}); }}>
      <summary>${heading}</summary>${state.open.has(title) && all.map(each => html`<div key=${each.id}>${blocks[each.kind](each)}${each.note && html`<p><small>${each.note}</small></p>`}</div>`)}
    </details>`)}</section>`;

const paper = () => html`<section id="paper"><h2>Исходные данные и итоги</h2><div class="cards">
  ${table("Исходные данные", fields.filter(f => f.number && f.path.length === 2).map(f => row([[f.title], [symbol(f.symbol), "s"], [printed(valueOf(f), 9), "n"], [f.unit, "s"]])))}
  ${data.sheets.flatMap(each => each.blocks).filter(({id}) => /^summary_(torque|pin|crankpin)$/.test(id)).map(each => blocks.list(each))}
  ${checks(data.checks.slice(0, MOST_CHECKS))}</div></section>`;

const page = () => html`
  <a class="skip" href="#five">К данным двигателя</a> <a class="skip" href="#results">К диаграммам</a>
  <header><h1>${state.raw.engine.name}</h1>
    <p class="bar"><button id="save" onClick=${saveToml}>Скачать .toml</button> <button id="book" onClick=${saveBook}>Книга Excel</button>
      <button id="card" onClick=${saveCard}>Карточка</button> <button id="print" onClick=${() => print()}>Печать</button></p></header>
  <main><aside id="inputs">${five()}${dataPart()}</aside>
    <div id="view">${scene(state.last)}${numbers()}
      <p id="stale" class="warn" hidden=${!state.wrong.length}>Показан последний верный двигатель: исправьте отмеченное.</p>${charts()}${tables()}</div></main>
  ${(state.isPrinted || printing.matches) && paper()}
  <p class="hidden" role="status">${state.told}</p>`;

// --- for tests and for teachers' own scripts ---
globalThis.kshm = {
  keys: () => [...new Set([...main.keys()])],
  get(name) {
    const value = main.get(byKey[name]?.cell ?? name);
    if (value === undefined) throw new RangeError(`${name}: такого числа нет; все имена даёт kshm.keys()`);
    return typeof value === "object" ? Array.from(value) : value;
  },
  set(key, value) {
    const f = byKey[key];
    if (!f) throw new RangeError(`${key}: такого поля нет; имена полей — как в исходном файле`);
    const [wrong] = calculate({[f.key]: value});
    if (wrong) throw new RangeError(`${key}: ${wrong.what}; ${wrong.hint}`);
    state.typed = {};
    set({wrong: state.wrong.filter(each => each.where !== f.key)});
  },
  time: () => state.spent,
};
Object.assign(globalThis, {turn, live: {isFixed: main.isFixed, has: main.has, toml: () => toml(state.raw, about, "kshm"), book: saveBook, card: makeCard, state}});

after.push(() => follow());
document.body.replaceChildren();
Object.assign(state, {raw: structuredClone(data.raw), titles: Object.fromEntries(fields.map(f => [f.key, f.title])), charts: new Map(), cylinder: 0,
  wrong: [], typed: {}, waiting: {}, find: "", phi: 0, pace: 1, isPlaying: false, isChanged: false, spent: 0, sheet: FIRST, told: "",
  open: new Set(), choices: {palette: data.palette}, turn, follow, redraw: () => set({switched: (state.switched ?? 0) + 1})});
state.last = shown();
await document.fonts.load("16px 'Inter Variable'", "Rя′φ").catch(() => null); // canvases draw once
set({}, page);
for (const media of [dark, printing]) media.addEventListener("change", () => set({}));
for (const [event, isPrinted] of [["beforeprint", true], ["afterprint", false]]) addEventListener(event, () => set({isPrinted}));
if (!matchMedia("(prefers-reduced-motion: reduce)").matches) play();
