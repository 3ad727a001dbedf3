// An engine that calculates itself, and what is seen of it: one for the file and for the class's page.
import {after, html, list, memo, options, printed, row, set, state, symbol, table} from "./common.js";
import {between, dark, figure, follow as cursor} from "./drawn.js";
import {put, section, text} from "./fields.js";
import {parts, pose} from "./scene.js";
import {calculator} from "./calculator.js";
import {cell} from "./numbers.js";
import {card} from "./takeaway.js";

const CHARTS_MS = 80; // between drawings of charts while a slider moves: mechanism and numbers follow each frame
const BASE = 180; // degrees a second at a pace of one
const STROKES = {4: ["впуск", "сжатие", "рабочий ход", "выпуск"], 2: ["рабочий ход", "сжатие"]};
const FIRST = "", MOST_CHECKS = 12; // of a page of print
const printing = matchMedia("print");

// --- numbers ---
export function engineOf(data, functions) {
  const [main, fine] = ["program", "fine"].map((key, i) => calculator({functions: functions[i], ...data[key]})); // of the book, of curves
  const fields = data.fields.flatMap(({entries}) => entries.flat());
  return {...data, data, functions, main, fine, fields, strokes: STROKES[data.strokes], charts: new Map(), stands: JSON.stringify(data.raw),
    byKey: Object.fromEntries(fields.flatMap(f => [[f.key, f], [f.cell, f]])),
    scalars: [...data.numbers.flatMap(({key, of, alike}) => of ? [of, ...alike.map(each => each.key)] : key), ...data.checks.map(each => each.value)]};
}

export const read = (raw, path) => path.reduce((part, key) => part?.[key], raw);
export const cellsOf = ({fields}, raw) => Object.fromEntries(fields.filter(f => !f.fixed).map(f =>
  [f.cell, f.choices ? f.choices[read(raw, f.path)] : read(raw, f.path)]));

export function take(engine, raw) { // its numbers are those of these values; whether there are any
  const cells = Object.entries(cellsOf(engine, raw));
  for (const model of [engine.main, engine.fine]) model.set(Object.fromEntries(cells.filter(([key]) => model.isInput(key))));
  for (const each of engine.charts.values()) each.isStale = true;
  return engine.scalars.every(key => Number.isFinite(engine.main.get(key)));
}

function fault(f, value) { // in the words of `check`
  const {limit, number, whole} = state.engine.sentences, hint = `допустимо от ${printed(f.min, 9)} до ${printed(f.max, 9)} ${f.unit}`.trim();
  const say = (what, text, more = hint) => ({where: f.key, what: what.replace("{}", text), hint: more, isTyped: true});
  if (f.fixed) return say("это строение двигателя", "", "нужен build");
  if (f.choices) return value in f.choices ? null : say(limit, value, "");
  if (typeof value !== "number") return say(number, value);
  if (f.whole && !Number.isInteger(value)) return say(whole, printed(value, 9));
  return value < f.min || value > f.max ? say(limit, printed(value, 9)) : null;
}

// Values by keys of fields; what does not go is said, and leaves the engine as it was.
export function calculate(changes) {
  const {engine, raw} = state, began = performance.now(), faults = [], before = [];
  for (const [key, value] of Object.entries(changes)) {
    const f = engine.byKey[key], wrong = fault(f, value);
    if (wrong) faults.push(wrong);
    else {
      before.push([f, read(raw, f.path)]);
      put(raw, f.path, value);
    }
  }
  if (!take(engine, raw)) {
    for (const [f, value] of before) put(raw, f.path, value);
    take(engine, raw);
    faults.push({where: before[0][0].key, what: "с этим значением расчёт не даёт чисел", hint: "верните прежнее", isTyped: true});
  }
  Object.assign(state, {last: {...state.last, moves: moves()}, spent: performance.now() - began, isChanged: JSON.stringify(raw) !== engine.stands});
  return faults;
}

// What is typed waits for the next frame; what is read aloud and charts out of sight wait for a pause.
let asked = 0, drawnAt = 0;
export function type(changes, done) {
  Object.assign(state.waiting, changes);
  asked ||= requestAnimationFrame(now => {
    asked = 0;
    state.isHurried = now - drawnAt < CHARTS_MS;
    if (!state.isHurried) drawnAt = now;
    clearTimeout(state.rest);
    state.rest = state.isHurried && setTimeout(set, CHARTS_MS, {isHurried: false});
    const all = state.waiting, keys = Object.keys(all);
    state.waiting = {};
    set({wrong: [...state.wrong.filter(each => !keys.includes(each.where)), ...calculate(all)], errors: []});
    done?.();
    clearTimeout(state.pause);
    state.pause = setTimeout(() => {
      Object.assign(state, {isAll: true, isHurried: false});
      set({told: `Пересчитано: ${keyNumbers(state.engine).map(each => `${each.title} ${number(each)} ${each.unit}`).join(", ")}`});
      state.isAll = false;
    }, 400);
  });
}

export function retype(changes) { // values that no person has typed
  for (const [key, value] of Object.entries(changes)) state.typed[state.engine.byKey[key].key] = text(value);
}

export const moves = () => {
  const {fine, scene: {tables, joints, each, forces, throws}, cylinder = 0} = state.engine, column = (i, key) => fine.get(`${tables[i]}.${key}`);
  const phi = Array.from(fine.get("P4_1.phi_deg")), gas = fine.get("P4_1.Pg_MPa"), most = Math.max(...gas, 1e-9);
  return {
    phi, turn: fine.get("P3_1.phi_deg"), throws, cylinder,
    joints: joints.map(kind => kind.map(joint => joint.map(key => Array.from(fine.get(key))))),
    each: each.map((one, i) => ({...one, shift: i ? phi[0] - column(i, "phase_deg")[0] : 0})),
    gas: Array.from(gas, value => Math.min(Math.max(value / most, 0), 1)),
    forces: Object.fromEntries(Object.entries(forces).map(([key, about]) => [key, {...about, values: Array.from(column(cylinder, key))}])),
    radius: fine.get("live_radius_mm"), wall: fine.get("live_wall_mm"), bore: fine.get("live_bore_mm"),
    speed: fine.get("regime_speed_rpm"),
  };
};

// --- charts ---
function chartOf(engine, spec) { // anew only where something has changed
  const before = engine.charts.get(spec.id), {main, fine} = engine;
  if (before && !(before.isStale && !state.isHurried && (state.isAll || before.isSeen !== false))) return before;
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
  if (spec.loads && made.path) Object.assign(made, {strokes: engine.strokes, marks: loads(made.path)});
  engine.charts.set(spec.id, made);
  return made;
}

function loads({phi, x, y}) { // of a journal: the greatest with its angle, the mean
  const far = x.map((px, i) => Math.hypot(px, y[i])), i = far.indexOf(Math.max(...far));
  const mean = far.slice(0, -1).reduce((sum, each) => sum + each, 0) / (far.length - 1);
  return {x: x[i], y: y[i], name: `R′_max = ${printed(far[i], 3)} при ${phi[i]}°`, mean, meanName: `R′_ср = ${printed(mean, 3)}`};
}

const isAmongFirst = ({first, pin, of}) => first && (!of || pin === Math.round(state.engine.main.get(of))); // of several pins the most loaded one's
const drawnCharts = ({charts: all} = state.engine.data) => state.sheet === FIRST ? all.filter(isAmongFirst).sort((a, b) => a.first - b.first)
  : all.filter(each => each.sheet === state.sheet);

function sheetChoice() { // by chapters, in words
  const {sheets, data} = state.engine, chapters = Object.groupBy(sheets.filter(({title}) => data.charts.some(each => each.sheet === title)), each => each.chapter);
  return html`<label>Диаграммы <select id="sheet" onChange=${e => set({sheet: e.target.value})}>
    <option value=${FIRST} selected=${state.sheet === FIRST}>Главные</option>${Object.entries(chapters).map(([chapter, all]) => html`
      <optgroup key=${chapter} label=${chapter}>${options(all.map(each => [each.title, each.heading]), state.sheet)}</optgroup>`)}</select></label>`;
}

export const charts = () => html`<section id="results" aria-label="Диаграммы и результаты" tabindex="-1">
  <p>${sheetChoice()}</p>
  <div id="charts" class="cards">${drawnCharts().map(spec => figure(chartOf(state.engine, spec), chartOfSecond(spec), printing.matches))}</div></section>`;

const chartOfSecond = ({id}) => {
  const spec = state.second?.data.charts.find(each => each.id === id);
  return spec && chartOf(state.second, spec);
};

// --- motion ---
const watcher = new IntersectionObserver(all => {
  for (const {target, isIntersecting} of all) {
    const own = state.engine.charts.get(target.id.replace("chart-", ""));
    if (own) own.isSeen = isIntersecting;
  }
  if (!state.isPlaying) set({});
});

let frame = 0;
export function follow() {
  const {last, phi, isPlaying} = state, root = document.getElementById("scene");
  if (!root) return;
  const isTold = !isPlaying || frame++ % 4 === 0; // nobody reads sixty numbers a second
  pose(root, last.moves, phi, isTold);
  if (isTold) {
    document.getElementById("angle").textContent = `${Math.round(phi)}°`;
    document.getElementById("phi").value = phi;
  }
  for (const node of document.querySelectorAll("#charts > figure")) {
    watcher.observe(node);
    const own = state.engine.charts.get(node.id.replace("chart-", ""));
    if (own && (!isPlaying || own.isSeen)) cursor(node, own, phi, isTold);
  }
}

export function turn(phi) {
  state.phi = Math.min(Number(phi), state.last.moves.phi.at(-1));
  follow();
}

export function play() {
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

const forms = count => ({one: "раз", few: "раза"})[new Intl.PluralRules("ru").select(count)] ?? "раз";
const slowed = speed => { // one second of the engine on the page
  const times = Math.round(speed * 6 / BASE / state.pace);
  return times > 1 ? `медленнее в ${printed(times, 2)} ${forms(times)}` : "как в жизни";
};

export const scene = more => {
  const {moves: now} = state.last, {front, strip, star, values} = parts(now, dark.matches, cylinder => {
    state.engine.cylinder = cylinder;
    set({last: {...state.last, moves: moves()}});
  });
  return html`<section id="scene" aria-label="Механизм">
    <div id="stage"><figure>${front}</figure><div id="strip" role="group" aria-label="Силы цилиндра" style=${`--all: ${now.each.length}; --count: ${Math.ceil(now.each.length / (now.each.length > 6 ? 2 : 1))}`} hidden=${now.each.length < 2}>${strip}</div>
      <div id="drive">
        <button id="play" class="first" aria-pressed=${String(state.isPlaying)} onClick=${play}>${state.isPlaying ? "Стоп" : "Пуск"}</button>
        <label for="phi">φ <output id="angle" aria-live="off" /></label>
        <input id="phi" type="range" min="0" max=${now.phi.at(-1)} step="1" onInput=${e => turn(e.target.value)} />
        <label class="pace"><span>${slowed(now.speed)}</span><input id="pace" type="range" min="-1" max="0.7" step="0.1"
          aria-label="Скорость показа" aria-valuetext=${`${printed(state.pace, 2)}×`} value=${Math.log10(state.pace)}
          onInput=${e => set({pace: 10 ** Number(e.target.value)})} /><output aria-live="off">${printed(state.pace, 2)}×</output></label></div></div>
    <div id="beside"><figure id="cranks">${star}<figcaption>Звезда кривошипов</figcaption></figure>
      <div id="forces">${values}${more}</div></div>
  </section>`;
};

// --- what is read ---
const number = ({key, digits}) => cell(state.engine.main.get(key), digits);
const keyNumbers = ({main, numbers}) => numbers.map(each => each.of ? each.alike[Math.round(main.get(each.of)) - 1] ?? each : each); // of several pins the most loaded one's

export const numbers = () => html`<dl id="numbers">${keyNumbers(state.engine).map(each => html`
  <div key=${each.key} data-key=${each.key} title=${each.title}><dt>${symbol(each.symbol)}</dt>
    <dd><b>${number(each)}</b> ${each.unit}${each.at && html`<small> при ${cell(state.engine.main.get(each.at), ["fixed", 0, ""])}°</small>`}</dd></div>`)}</dl>
  <p id="stale" class="warn" hidden=${!state.wrong.length}>Показан последний верный двигатель: исправьте отмеченное.</p>`;

export const five = (change, more) => html`<section id="five" aria-label="Главные размеры"><h2>Меняйте</h2>
  ${state.engine.data.main.map(key => memo(`five ${key}`, [state.engine, state.typed[key], JSON.stringify(state.wrong), state.raw], () =>
    section({title: "", key: `five ${key}`, path: null, entries: [[state.engine.byKey[key]]], isPlain: true}, change)))}
  ${more}</section>`;

export const rest = groups => groups // but for the five
  .map(({entries, ...group}) => ({...group, entries: group.path ? entries : entries.map(entry => entry.filter(f => !state.engine?.data.main.includes(f.key)))}))
  .filter(({path, entries}) => path || entries.some(entry => entry.length));

const verdict = ({key, good, odd, reason}) => state.engine.main.get(key) === good ? ["выполнена", "ok"]
  : odd ? ["необычно", "warn"] : reason ? [`принято: ${reason}`, "warn"] : ["не выполнена", "bad"];
const checks = (rows, {main} = state.engine) => table("Проверки расчёта", rows.filter(each => !each.odd || main.get(each.key) !== each.good).map(each =>
  row([[each.title], [cell(main.get(each.value), ["fixed", Math.abs(main.get(each.value)) >= 1 ? 2 : 4, ""]), "n"], verdict(each)])));

const still = key => state.isChanged && state.engine.main.isFixed(key) ? " still" : "";
const cellOf = (key, digits) => key ? [cell(state.engine.main.get(key), digits), `n${still(key)}`] : [""];
const second = (key, digits) => state.second ? [[state.second.main.has(key) ? cell(state.second.main.get(key), digits) : "—", "n second"]] : [];
const head = columns => html`<thead><tr>${columns.map(({symbol: name, unit, title}) => html`
  <th class="n" title=${title}>${symbol(name)}${unit && html`<br /><small>${unit}</small>`}</th>`)}</tr></thead>`;
const blocks = {
  list: ({title, rows}) => table(title, rows.map(({key, title, symbol: name, unit, digits}) =>
    row([[title], [symbol(name), "s"], cellOf(key, digits), ...second(key, digits), [unit, "s"]], {"data-key": key}))),
  verdicts: ({rows}) => checks(rows),
  grid: ({title, labels, rows}) => table(title, rows.map(({symbol: name, unit, digits, cells}) =>
    row([[symbol(name)], [unit, "s"], ...cells.map(key => cellOf(key, digits))])), html`<thead><tr><th /><th />${labels.map(each => html`<th class="n">${each}</th>`)}</tr></thead>`),
  table: ({title, columns}) => {
    const all = columns.map(({key}) => state.engine.main.get(key));
    return table(title, Array.from(all[0], (_, i) => row(columns.map(({key, digits}, k) => [cell(all[k][i], digits), `n${still(key)}`]))), head(columns));
  },
};

export const tables = ({fixedTables, sheets, data} = state.engine) => html`<section id="tables" aria-label="Таблицы">
  <div id="checks">${checks(data.checks)}</div>${list([...state.last.warnings, ...state.remarks], "warn")}
  <h2>Таблицы книги</h2>
  ${fixedTables.length > 0 && html`<p><small>Находит только сборка${state.isChanged ? " (бледное её ждёт)" : ""}: ${fixedTables.join("; ")}.</small></p>`}
  ${sheets.filter(each => each.blocks.length).map(({title, heading, blocks: all}) => html`
    <details key=${title} data-sheet=${title} open=${state.open.has(title)} onToggle=${e => { state.open[e.target.open ? "add" : "delete"](title); set({}); }}>
      <summary>${heading}</summary>${state.open.has(title) && all.map(each => html`<div key=${each.id}>${blocks[each.kind](each)}${each.note && html`<p><small>${each.note}</small></p>`}</div>`)}
    </details>`)}</section>`;

export const paper = () => (state.isPrinted || printing.matches) && html`<section id="paper"><h2>Исходные данные и итоги</h2><div class="cards">
  ${table("Исходные данные", state.engine.fields.filter(f => f.number && f.path.length === 2).map(f => row([[f.title], [symbol(f.symbol), "s"], [printed(read(state.raw, f.path), 9), "n"], [f.unit, "s"]])))}
  ${state.engine.sheets.flatMap(each => each.blocks).filter(({id}) => /^summary_(torque|pin|crankpin)$/.test(id)).map(each => blocks.list(each))}
  ${checks(state.engine.data.checks.slice(0, MOST_CHECKS))}</div></section>`;

// --- the card ---
const look = name => { // light-dark() as a canvas takes it
  const probe = Object.assign(document.createElement("i"), {style: `color: var(${name})`});
  document.body.append(probe);
  const [r, g, b] = getComputedStyle(probe).color.match(/[\d.]+/g);
  probe.remove();
  return `rgb(${r},${g},${b})`;
};

export function makeCard() {
  const {raw, phi, last: {moves: {speed, phi: over}}, engine: {main, fine, strokes, palette}} = state;
  const [x, y] = ["phi_deg", "Msum_Nm"].map(key => Array.from((fine.has("P4_2.Msum_Nm") ? fine : main).get(`P4_2.${key}`)));
  return card(document.getElementById("mechanism"), {
    title: raw.engine.name, about: `${printed(speed)} мин⁻¹ · φ = ${Math.round(phi)}°, ${strokes[Math.min(Math.floor(phi / 180), strokes.length - 1)]}`,
    numbers: keyNumbers(state.engine).map(each => [each.symbol, number(each), each.unit]),
    curve: {x, y, at: [phi, between(x, y, Math.min(phi, over.at(-1))) ?? 0], name: "Крутящий момент, Н·м", mean: main.get("M_mean")},
    colours: {page: look("--page"), card: look("--card"), text: look("--text"), soft: look("--soft"), first: `#${palette[0]}`, second: `#${palette[1]}`},
  });
}

// --- for tests and for teachers' own scripts ---
const api = done => ({
  keys: () => state.engine.main.keys(),
  get(name) {
    const value = state.engine.main.get(state.engine.byKey[name]?.cell ?? name);
    if (value === undefined) throw new RangeError(`${name}: такого числа нет; все имена даёт kshm.keys()`);
    return typeof value === "object" ? Array.from(value) : value;
  },
  set(key, value) {
    const f = state.engine.byKey[key];
    if (!f) throw new RangeError(`${key}: такого поля нет; имена полей — как в исходном файле`);
    const [wrong] = calculate({[f.key]: value});
    if (wrong) throw new RangeError(`${key}: ${wrong.what}; ${wrong.hint}`);
    retype({[key]: value});
    set({wrong: state.wrong.filter(each => each.where !== f.key)});
    done?.();
  },
  time: () => state.spent,
});

// What a page begins with; `done` follows a value that a script sets.
export async function begin(changes, page, done) {
  Object.assign(state, {wrong: [], typed: {}, waiting: {}, find: "", phi: 0, pace: 1, isPlaying: false, isChanged: false, spent: 0,
    sheet: FIRST, told: "", remarks: [], open: new Set(), turn, follow, redraw: () => set({switched: (state.switched ?? 0) + 1}), ...changes});
  Object.assign(globalThis, {kshm: api(done), turn, live: {isFixed: key => state.engine.main.isFixed(key), state}});
  after.push(follow);
  document.body.replaceChildren();
  await document.fonts.load("16px 'Inter Variable'", "Rя′φ").catch(() => null); // canvases draw once
  set({}, page);
  for (const media of [dark, printing]) media.addEventListener("change", () => set({}));
  for (const [event, isPrinted] of [["beforeprint", true], ["afterprint", false]]) addEventListener(event, () => set({isPrinted}));
}
export const moveFirst = () => matchMedia("(prefers-reduced-motion: reduce)").matches || state.isPlaying || play();
