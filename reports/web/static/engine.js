"use strict";
// The page of an engine: a mapping of the file's values is all its state.
const state = {raw: null, sheet: "П4.1", past: [], other: null, last: null, figures: []};
window.kshm = state; // for a person's console and for the tests
const copy = structuredClone;

// What `start` says of a mapping: its fields, its sheets; then its numbers.
async function open(raw, keep = true) {
  const answer = await ask("api/start", {raw});
  if (!answer.groups) { told(answer); return false; }
  if (keep && state.raw) remember();
  state.raw = answer.raw;
  touched = null;
  fill(answer);
  await solve();
  return true;
}

function remember() {
  const text = JSON.stringify(state.raw);
  if (state.past.at(-1) !== text) state.past.push(text);
  state.past = state.past.slice(-200);
  $("undo").disabled = false;
}

function undo() {
  const text = state.past.pop();
  $("undo").disabled = !state.past.length;
  if (text) open(JSON.parse(text), false);
}

// --- fields ---
function put(raw, path, value) {
  let part = raw;
  for (const key of path.slice(0, -1)) part = part[key] ??= {};
  const last = path.at(-1);
  if (value !== "" && value !== null) part[last] = value;
  else if (Array.isArray(part)) part[last] = "";
  else delete part[last];
}

function remove(raw, path) {
  const part = path.slice(0, -1).reduce((inner, key) => inner[key], raw), last = path.at(-1);
  if (Array.isArray(part)) part.splice(last, 1); else delete part[last];
}

function add(raw, id) { // a section, or a regime that begins as the main one
  if (id !== "regimes") raw[id] = {};
  else (raw.regimes ??= []).push({...raw.regime, name: `Режим ${raw.regimes.length + 2}`, gas: copy(raw.gas)});
}

async function edited(change, key) { // a change that alters the shape, and back to where it was made
  const raw = copy(state.raw), groups = () => [...document.querySelectorAll("#fields details")];
  const before = new Set(groups().map(group => group.dataset.key));
  change(raw);
  await open(raw);
  for (const group of groups()) group.open ||= !before.has(group.dataset.key);
  [...document.querySelectorAll(`[data-key="${key}"] summary, [data-key="${key}"] legend button`)].at(-1)?.focus();
}

function fill({groups, sheets, absent, raw}) {
  const name = raw.engine?.name || "Двигатель";
  $("name").textContent = name;
  document.title = `${name} — КШМ`;
  const opened = new Set([...document.querySelectorAll("#fields details[open]")].map(d => d.dataset.key));
  if (!opened.size && innerWidth > 900) ["engine", "geometry", "regime"].forEach(key => opened.add(key));
  const focus = document.activeElement?.id, top = $("data").scrollTop;
  $("fields").replaceChildren(...groups.map(group => section(group, opened.has(group.key))));
  $("data").scrollTop = top;
  if (focus) $(focus)?.focus();
  if (sheets.length && !sheets.some(s => s.id === state.sheet)) state.sheet = sheets[0].id;
  if (sheets.length) $("sheet").replaceChildren(...options(sheets.map(s => [s.id, s.title, s.hint]), state.sheet));
  $("absent").replaceChildren(absent.length ? "Добавить раздел: " : "", ...absent.map(({id, title}) =>
    make("button", {onclick: () => edited(raw => add(raw, id), id)}, title)));
  find();
}

function section({title, key, path, fields, entries, blank, drawing, whole}, open) {
  const node = make("details", {"data-key": key, open}, make("summary", {}, title), make("span", {class: "said"}));
  if (drawing) node.append(make("img", {src: `images/${drawing}.svg`, alt: `${title}: что есть что`, loading: "lazy"}));
  const button = (label, change) => make("button", {class: "small", onclick: () => edited(change, key)}, label);
  if (!entries) node.append(...fields.map(field));
  else {
    entries.forEach((entry, i) => node.append(make("fieldset", {}, make("legend", {}, `№ ${i + 1} `,
      button(`Убрать ${i + 1}`, raw => remove(raw, [...path, i]))), ...entry.map(field))));
    node.append(make("p", {}, button("Добавить", raw => {
      const part = path.slice(0, -1).reduce((inner, each) => inner[each] ??= {}, raw), list = part[path.at(-1)] ??= [];
      list.push(copy(list.at(-1) ?? blank));
    })));
  }
  if (whole) node.append(make("p", {}, button("Убрать раздел", raw => remove(raw, whole))));
  return node;
}

const shown = value => typeof value === "number" ? String(value).replace(".", ",") : value ?? "";
function field(f) {
  const id = `f-${f.key}`, help = [], title = [f.title, f.symbol ? ", " : "", ...symbol(f.symbol)];
  if (f.number && f.min !== null) help.push(`от ${printed(f.min, 9)} до ${printed(f.max, 9)} ${f.unit}`);
  if (f.optional) help.push("можно не задавать");
  const told = {id, "aria-describedby": `h-${f.key} e-${f.key}`};
  let drag = null;
  const input = f.choices
    ? make("select", {...told, onchange: () => { remember(); change(f, input.value, true); }},
      ...options([...(f.optional || f.value === null ? [["", "—"]] : []), ...Object.entries(f.choices)], f.value ?? ""))
    : make("input", {...told, value: shown(f.value), inputmode: f.number ? "decimal" : false, autocomplete: "off",
      maxlength: 300,
      oninput: () => { change(f, input.value.trim()); if (drag) drag.value = input.value.replace(",", "."); }});
  const row = make("div", {class: f.number || f.choices ? "field" : "field wide", "data-key": f.key,
    "data-text": `${f.title} ${f.key} ${f.symbol}`.toLowerCase()}, make("label", {for: id}, ...title), input,
  make("span", {}, f.unit));
  if (f.number && typeof f.value === "number" && f.value && !f.key.includes("[")) {
    const span = Math.abs(f.value) * .4, step = 10 ** Math.floor(Math.log10(span / 50)), tidy = v => Math.round(v / step) * step;
    drag = make("input", {type: "range", "aria-label": `${f.title}: подвинуть`, step,
      min: tidy(Math.max(f.min ?? -Infinity, f.value - span)), max: tidy(Math.min(f.max ?? Infinity, f.value + span)),
      oninput: () => { input.value = shown(+Number(drag.value).toPrecision(8)); change(f, input.value); }});
    drag.value = f.value;
    row.append(drag);
  }
  row.append(make("small", {id: `h-${f.key}`}, [...help, f.key].join(" · ")), make("span", {id: `e-${f.key}`, class: "said"}));
  return row;
}

let touched = null;
function change(f, value, shape = false) {
  if (touched !== f.key && !shape) remember(); // one step of undo for one field
  touched = f.key;
  const plain = value.replace(",", ".").replace("−", "-");
  put(state.raw, f.path, f.number && /^-?\d+(\.\d+)?$/.test(plain) ? Number(plain) : value);
  if (shape) open(state.raw, false); else solve();
}

// Each problem stands at its field, else at its list, else above all.
function problems(errors = [], warnings = []) {
  for (const place of document.querySelectorAll("#fields .said")) place.replaceChildren();
  for (const input of document.querySelectorAll("[aria-invalid]")) input.removeAttribute("aria-invalid");
  const rest = [];
  for (const [list, kind] of [[errors, "error"], [warnings, "odd"]])
    for (const problem of list) {
      const place = document.querySelector(`#fields [data-key="${CSS.escape(problem.where)}"]`);
      if (!place || !problem.where) { if (kind === "error") rest.push(problem); continue; }
      place.querySelector(".said").append(make("span", {class: kind}, words(problem)));
      if (kind === "odd") continue;
      place.closest("details").open = true;
      if (place.matches(".field")) place.querySelector("input, select").setAttribute("aria-invalid", "true");
    }
  say($("errors"), rest);
}

function find() {
  const wanted = $("find").value.trim().toLowerCase();
  for (const group of document.querySelectorAll("#fields details")) {
    const rows = [...group.querySelectorAll(".field")];
    for (const row of rows) row.hidden = wanted && !row.dataset.text.includes(wanted);
    group.hidden = Boolean(wanted) && rows.every(row => row.hidden);
    if (wanted && !group.hidden) group.open = true;
  }
}

// --- numbers ---
let running = false, again = false, later = 0;
async function solve() {
  try { localStorage.setItem("kshm", JSON.stringify({raw: state.raw, other: state.other})); } catch { /* private window */ }
  again = true;
  if (running) return; // at most one question on its way
  running = true;
  while (again) {
    again = false;
    const asked = {sheet: state.sheet, cylinder: Number($("cylinder").value) || 0};
    const [own, other] = await Promise.all([ask("api/solve", {raw: copy(state.raw), ...asked}),
      state.other && ask("api/solve", {raw: state.other, ...asked})]);
    problems(own.errors, own.warnings);
    $("results").classList.toggle("late", own.errors.length > 0);
    if (!own.errors.length) show(own, other);
  }
  running = false;
  clearTimeout(later);
  later = setTimeout(check, 400);
}

async function check() {
  const answer = await ask("api/checks", {raw: state.raw});
  if (answer.errors) return;
  const verdict = c => c.ok ? ["выполнена", "good"] : c.reason ? [`принято: ${c.reason}`, "odd"] : ["не выполнена", "bad"];
  $("checks").replaceChildren(table("Проверки расчёта",
    answer.checks.map(c => row([[c.title], [printed(c.value), "n"], verdict(c)]))));
  say($("warnings"), [...state.last.warnings, ...answer.remarks]);
}

function show(own, other) {
  Object.assign(state, {last: own, second: other});
  const ids = own.charts.map(spec => spec.id).join();
  if (ids !== state.figures.map(f => f.id).join()) {
    state.figures.forEach(f => f.drop());
    state.figures = own.charts.map(figure);
    $("charts").replaceChildren(...state.figures.map(f => f.node));
  }
  own.charts.forEach((spec, i) => state.figures[i].show(spec, other?.charts?.find(c => c.id === spec.id)));
  $("scene").hidden = false;
  $("phi").max = own.moves.phi.at(-1);
  const numbers = Array.from({length: own.moves.cylinders}, (_, i) => [i, i + 1]);
  if ($("cylinder").length !== numbers.length) // else a person's choice on its way would be lost
    $("cylinder").replaceChildren(...options(numbers, own.moves.cylinder));
  const second = new Map((other?.results || []).flatMap(t => t.rows.map(r => [r.key, r.text])));
  const closed = new Set([...document.querySelectorAll("#summary details:not([open])")].map(d => d.dataset.id));
  const begin = !$("summary").children.length;
  $("summary").replaceChildren(...own.results.map(({id, title, rows}) => make("details",
    {"data-id": id, open: begin ? /^(summary_torque|geometry)/.test(id) : !closed.has(id)}, make("summary", {}, title),
    table(title, rows.map(r => dressed(row([[r.title], [symbol(r.symbol), "s"], [r.text, "n"],
      [second.get(r.key) ?? "", "n"], [r.unit, "s"]]), {"data-key": r.key}, []))))));
  turn();
}

function turn() {
  const {moves} = state.last, phi = Number($("phi").value);
  $("phiText").textContent = `${printed(phi)}°`;
  $("phi").setAttribute("aria-valuetext", `${printed(phi)} градусов`);
  mechanism($("mechanism"), moves, phi);
  star($("star"), moves, phi);
  for (const each of state.figures) each.at(phi);
  $("values").replaceChildren(...Object.values(moves.forces).map(f =>
    row([[symbol(f.symbol)], [printed(between(moves.phi, f.values, phi), 4), "n"], [f.unit, "s"]])));
}

function play() {
  const on = $("play").getAttribute("aria-pressed") !== "true";
  $("play").setAttribute("aria-pressed", on);
  $("play").textContent = on ? "Стоп" : "Пуск";
  let before = null;
  const step = now => {
    if ($("play").getAttribute("aria-pressed") !== "true") return;
    if (before !== null) $("phi").value = (Number($("phi").value) + Math.round((now - before) * .12)) % Number($("phi").max);
    before = now;
    turn();
    requestAnimationFrame(step);
  };
  if (on) requestAnimationFrame(step);
}

// --- files ---
const jobs = new Map();
async function order(kind, title) {
  const {id, errors} = await ask("api/files", {raw: state.raw, other: state.other, kind});
  if (!told({errors}) || jobs.has(id)) return;
  const item = make("li", {});
  jobs.set(id, item);
  $("jobs").prepend(item);
  for (;;) {
    const job = await ask(`api/files/${id}`);
    if (job.state === "waiting") item.textContent = `${title}: в очереди, перед вами ${job.place}`;
    else if (job.state === "running") item.textContent = `${title}: делается, ${job.seconds} с`;
    else {
      const files = (job.files || []).flatMap(({name, size}) => [make("a", {href: `api/files/${id}/${encodeURIComponent(name)}`,
        download: name}, name), ` (${printed(size / 1e6, 2)} МБ) `]);
      const kind = job.state === "done" ? "odd" : "bad";
      item.replaceChildren(`${title}: `, ...files,
        ...(job.lines || job.errors.map(line)).map(text => make("div", {class: kind}, text)));
      break;
    }
    await new Promise(done => setTimeout(done, 700));
  }
  jobs.delete(id);
}

function download(name, text) {
  const link = make("a", {href: URL.createObjectURL(new Blob([text], {type: "application/toml"})), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// --- what the buttons do ---
async function fresh(answering) {
  const answer = await answering;
  if (!told(answer)) return;
  $("new").open = false;
  await open(answer.raw);
}

function wanted() {
  const out = {cylinders: Number($("cylinders").value)};
  for (const key of ["layout", "strokes", "kind"]) out[key] = $(key).value;
  for (const key of ["power", "speed"]) if ($(key).value.trim()) out[key] = Number($(key).value.replace(",", "."));
  return ask("api/new", out);
}

const read = async file => /\.xlsx$/i.test(file.name) ? ask("api/book", file) : ask("api/read", {text: await file.text()});

async function through(bytes, way) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(way)).arrayBuffer());
}
async function packed(text) {
  const bytes = await through(text, new CompressionStream("deflate-raw"));
  return btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), c => c.charCodeAt(0));
  return new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw")));
}

function compare(other) {
  state.other = other;
  $("drop").hidden = !other;
  solve();
}

const ACTIONS = {
  undo, play,
  alike: () => fresh(ask("api/new", {raw: state.raw, cylinders: Number($("cylinders").value), layout: $("layout").value})),
  keep: () => compare(copy(state.raw)),
  drop: () => compare(null),
  save: async () => {
    const answer = await ask("api/toml", {raw: state.raw});
    if (told(answer)) download("engine.toml", answer.text);
  },
  link: async () => {
    location.hash = await packed(JSON.stringify(state.raw));
    try { await navigator.clipboard.writeText(location.href); } catch { /* the address shows it */ }
    $("link").textContent = "Ссылка в адресе";
  },
};

async function begin() {
  const choices = await ask("api/choices"), pairs = Object.entries;
  $("sample").replaceChildren(...options(choices.samples.map(name => [name, name]), "gots-diesel"));
  for (const [id, list] of pairs({layout: choices.layouts, strokes: choices.strokes, kind: choices.kinds}))
    $(id).replaceChildren(...options(pairs(list), "4"));
  $("kinds").replaceChildren(...pairs(choices.files).map(([kind, title]) =>
    make("button", {"data-kind": kind, onclick: () => order(kind, title)}, title)));
  for (const [id, action] of pairs(ACTIONS)) $(id).addEventListener("click", action);
  $("sampleForm").addEventListener("submit", e => { e.preventDefault(); fresh(ask("api/new", {sample: $("sample").value})); });
  $("ownForm").addEventListener("submit", e => { e.preventDefault(); fresh(wanted()); });
  $("upload").addEventListener("change", async e => { await fresh(read(e.target.files[0])); e.target.value = ""; });
  $("find").addEventListener("input", find);
  $("sheet").addEventListener("change", () => { state.sheet = $("sheet").value; solve(); });
  $("cylinder").addEventListener("change", solve);
  $("phi").addEventListener("input", turn);
  for (const media of ["(prefers-color-scheme: dark)", "print"])
    matchMedia(media).addEventListener("change", () => { // colours are drawn in
      state.figures.splice(0).forEach(f => f.drop());
      show(state.last, state.second);
    });
  let kept = null;
  try {
    const hash = location.hash.slice(1);
    kept = hash ? {raw: JSON.parse(await unpacked(hash))} : JSON.parse(localStorage.getItem("kshm"));
  } catch { /* a damaged link or store is none */ }
  state.other = kept?.other || null;
  $("drop").hidden = !state.other;
  $("new").open = !kept?.raw;
  if (!kept?.raw || !await open(kept.raw, false)) {
    await fresh(ask("api/new", {sample: "gots-diesel"}));
    $("new").open = true;
  }
}
addEventListener("DOMContentLoaded", begin);
