"use strict";
// The page of an engine: a mapping of the file's values is all its state.
const state = {raw: null, sheet: "П4.1", past: [], other: null, last: null, shown: []};
window.kshm = state; // for a person's console and for the tests

async function open(raw, keep = true) {
  const answer = await ask("api/start", {raw});
  if (answer.groups?.length) {
    if (keep && state.raw) remember();
    Object.assign(state, {raw: answer.raw});
    fill(answer);
    await solve();
  } else {
    // Wrong values stay to be mended where their fields are shown.
    if (state.raw) { if (keep) remember(); state.raw = raw; }
    problems(answer.errors, []);
  }
  return answer;
}

function remember() {
  const text = JSON.stringify(state.raw);
  if (state.past.at(-1) !== text) state.past.push(text);
  if (state.past.length > 200) state.past.shift();
  $("undo").disabled = false;
}

function store() {
  try { localStorage.setItem("kshm", JSON.stringify({raw: state.raw, other: state.other})); } catch { /* private window */ }
}

// --- fields ---
const at = (raw, path) => path.reduce((part, key) => part?.[key], raw);
function put(raw, path, value) {
  let part = raw;
  for (const key of path.slice(0, -1)) part = part[key] ??= {};
  if (value === "" || value === null) delete part[path.at(-1)]; else part[path.at(-1)] = value;
}

function fill({groups, sheets, absent, raw}) {
  $("name").textContent = raw.engine.name || "Двигатель";
  document.title = `${raw.engine.name || "Двигатель"} — КШМ`;
  const opened = new Set([...document.querySelectorAll("#fields details[open]")].map(d => d.dataset.title));
  if (!opened.size) ["Двигатель", "Геометрия", "Режим"].forEach(t => opened.add(t));
  $("fields").replaceChildren(...groups.map(group =>
    make("details", {"data-title": group.title, open: opened.has(group.title)},
      make("summary", {}, group.title),
      ...(group.drawing ? [make("img", {src: `static/${group.drawing}.svg`, alt: `${group.title}: что есть что`, loading: "lazy"})] : []), ...group.fields.map(field))));
  if (!sheets.some(s => s.id === state.sheet)) state.sheet = sheets[0]?.id;
  $("sheet").replaceChildren(...sheets.map(s => make("option", {value: s.id, selected: s.id === state.sheet, title: s.hint}, s.title)));
  $("absent").replaceChildren(...(absent.length ? [make("p", {class: "tools"}, "Добавить раздел: ",
    ...absent.map(s => make("button", {onclick: () => { const next = structuredClone(state.raw); next[s.id] = {}; open(next); }}, s.title)))] : []));
  find();
}

function field(f) {
  const id = `f-${f.key}`, help = [];
  if (f.min !== null && f.number) help.push(`от ${printed(f.min, 9)} до ${printed(f.max, 9)} ${f.unit}`);
  if (f.optional) help.push("можно не задавать");
  help.push(f.key);
  let input;
  if (f.choices) {
    input = make("select", {id}, ...(f.optional && f.value === null ? [make("option", {value: ""}, "—")] : []),
      ...Object.entries(f.choices).map(([key, label]) => make("option", {value: key, selected: String(f.value) === key}, label)));
    const whole = typeof f.value === "number";
    input.addEventListener("change", () => change(f, whole ? Number(input.value) : input.value, true));
  } else {
    input = make("input", {id, value: f.value === null ? "" : f.number ? String(f.value).replace(".", ",") : f.value,
      inputmode: f.number ? "decimal" : false, autocomplete: "off", maxlength: 300});
    input.addEventListener("input", () => change(f, input.value.trim()));
  }
  input.setAttribute("aria-describedby", `h-${f.key} e-${f.key}`);
  const row = make("div", {class: f.number || f.choices ? "field" : "field wide", "data-key": f.key, "data-text": `${f.title} ${f.key} ${f.symbol}`.toLowerCase()},
    make("label", {for: id}, f.title, f.symbol ? ", " : "", ...symbol(f.symbol)), input, make("span", {}, f.unit));
  if (f.number && typeof f.value === "number" && f.value !== 0 && !f.key.includes("[")) {
    const span = Math.abs(f.value) * .4, step = 10 ** Math.floor(Math.log10(span / 50));
    const tidy = v => Math.round(v / step) * step;
    const drag = make("input", {type: "range", "aria-label": `${f.title}: подвинуть`, step,
      min: tidy(Math.max(f.min ?? -Infinity, f.value - span)), max: tidy(Math.min(f.max ?? Infinity, f.value + span)), value: f.value});
    drag.addEventListener("input", () => { input.value = String(+Number(drag.value).toPrecision(8)).replace(".", ","); change(f, input.value); });
    row.append(drag);
  }
  row.append(make("small", {id: `h-${f.key}`}, help.join(" · ")), make("span", {id: `e-${f.key}`}));
  return row;
}

let touched = null;
function change(f, value, anew = false) {
  if (touched !== f.key) { remember(); touched = f.key; } // one step of undo for one field
  put(state.raw, f.path, f.number && /^[-−]?\d+([.,]\d+)?$/.test(value) ? Number(value.replace(",", ".").replace("−", "-")) : value);
  if (anew) { open(state.raw, false); touched = null; } else solve();
}

function problems(errors, warnings) {
  for (const row of document.querySelectorAll(".field")) {
    row.querySelector("[id^='e-']").replaceChildren();
    row.querySelector("input, select").removeAttribute("aria-invalid");
  }
  const rest = [];
  for (const [list, kind] of [[errors, "error"], [warnings, "odd"]])
    for (const p of list || []) {
      const row = document.querySelector(`.field[data-key="${CSS.escape(p.where)}"]`) ||
        (p.where && document.querySelector(`.field[data-key^="${CSS.escape(p.where)}["]`));
      if (!row) { if (kind === "error") rest.push(p); continue; }
      row.querySelector("[id^='e-']").append(make("span", {class: kind}, [p.what, p.hint].filter(Boolean).join("; ")));
      if (kind === "error") { row.querySelector("input, select").setAttribute("aria-invalid", "true"); row.closest("details").open = true; }
    }
  say($("errors"), rest);
}

function find() {
  const wanted = $("find").value.trim().toLowerCase();
  for (const group of document.querySelectorAll("#fields details")) {
    let any = false;
    for (const row of group.querySelectorAll(".field")) any |= !(row.hidden = wanted && !row.dataset.text.includes(wanted));
    group.hidden = !any;
    if (wanted && any) group.open = true;
  }
}

// --- numbers ---
let running = false, again = false, later = 0;
async function solve() {
  store();
  if (running) { again = true; return; } // at most one question on its way
  running = true;
  do {
    again = false;
    const raw = JSON.stringify(state.raw);
    const [own, other] = await Promise.all([ask("api/solve", {raw: JSON.parse(raw), sheet: state.sheet}),
      state.other ? ask("api/solve", {raw: state.other, sheet: state.sheet}) : null]);
    problems(own.errors, own.warnings);
    $("results").classList.toggle("late", Boolean(own.errors.length));
    if (!own.errors.length) { state.last = own; state.second = other; show(own, other); }
  } while (again);
  running = false;
  clearTimeout(later);
  later = setTimeout(check, 400);
}

async function check() {
  const answer = await ask("api/checks", {raw: state.raw});
  if (answer.errors) return;
  $("checks").replaceChildren(make("div", {class: "box"}, make("table", {}, make("caption", {}, "Проверки расчёта"), make("tbody", {},
    ...answer.checks.map(c => make("tr", {}, make("td", {}, c.title), make("td", {class: "n"}, printed(c.value)),
      make("td", {class: c.ok ? "good" : c.reason ? "odd" : "bad"}, c.ok ? "выполнена" : c.reason ? `принято: ${c.reason}` : "не выполнена")))))));
  say($("warnings"), [...(state.last?.warnings || []), ...answer.remarks]);
}

function show(own, other) {
  const figures = own.charts.map(spec => chart(spec, other?.charts?.find(c => c.id === spec.id)));
  state.shown = figures;
  $("charts").replaceChildren(...figures.map(f => f.figure));
  $("scene").hidden = false;
  $("phi").max = own.moves.phi.at(-1);
  const second = new Map((other?.results || []).flatMap(t => t.rows.map(r => [r.key, r])));
  $("summary").replaceChildren(...own.results.map(block => make("details", {open: /^(summary_torque|geometry)/.test(block.id)},
    make("summary", {}, block.title), make("div", {class: "box"}, make("table", {}, make("tbody", {}, ...block.rows.map(r =>
      make("tr", {"data-key": r.key}, make("td", {}, r.title), make("td", {}, ...symbol(r.symbol)),
        make("td", {class: "n"}, r.text), make("td", {class: "n"}, second.get(r.key)?.text ?? ""), make("td", {}, r.unit)))))))));
  turn();
}

function turn() {
  const {moves} = state.last, phi = Number($("phi").value);
  $("phiText").textContent = `${printed(phi)}°`;
  $("phi").setAttribute("aria-valuetext", `${printed(phi)} градусов`);
  mechanism($("mechanism"), moves, phi);
  star($("star"), moves, phi);
  for (const figure of state.shown) figure.at(phi, moves.phi);
  $("values").replaceChildren(make("caption", {}, "Значения при φ"), make("tbody", {}, ...Object.values(moves.forces).map(f =>
    make("tr", {}, make("td", {}, ...symbol(f.symbol)), make("td", {class: "n"}, printed(between(moves.phi, f.values, phi), 4)), make("td", {}, f.unit)))));
}

// --- files ---
const jobs = new Map();
async function order(kind, title) {
  const answer = await ask("api/files", {raw: state.raw, other: state.other, kind});
  if (answer.errors) { say($("errors"), answer.errors); return; }
  if (jobs.has(answer.id)) return;
  const item = make("li", {}, `${title}: в очереди`);
  jobs.set(answer.id, item);
  $("jobs").prepend(item);
  for (;;) {
    const job = await ask(`api/files/${answer.id}`);
    if (job.state === "done")
      item.replaceChildren(`${title}: `, ...job.files.flatMap(f => [make("a", {href: `api/files/${answer.id}/${encodeURIComponent(f.name)}`, download: f.name}, f.name), ` (${printed(f.size / 1e6, 2)} МБ) `]),
        ...(job.lines || []).map(l => make("div", {class: "odd"}, l)));
    else if (job.state === "failed" || job.errors)
      item.replaceChildren(make("span", {class: "bad"}, `${title}: ${(job.lines || job.errors.map(line)).join("; ")}`));
    else item.textContent = job.state === "running" ? `${title}: делается, ${job.seconds} с` : `${title}: в очереди, перед вами ${job.place}`;
    if (job.state === "done" || job.state === "failed" || job.errors) break;
    await new Promise(done => setTimeout(done, 700));
  }
  jobs.delete(answer.id);
}

// --- what the buttons do ---
const toNumber = text => text.trim() === "" ? null : Number(text.replace(",", "."));
async function fresh(wanted) {
  const answer = await ask("api/new", wanted);
  if (answer.errors) { say($("errors"), answer.errors); return; }
  $("new").open = false;
  await open(answer.raw);
}

function wanted() {
  const out = {cylinders: Number($("cylinders").value), layout: $("layout").value, strokes: $("strokes").value, kind: $("kind").value};
  for (const key of ["power", "speed"]) if (toNumber($(key).value) !== null) out[key] = toNumber($(key).value);
  return out;
}

async function upload(file) {
  const book = /\.xlsx$/i.test(file.name);
  const answer = book ? await ask("api/book", file) : await ask("api/read", {text: await file.text()});
  if (answer.errors) { say($("errors"), answer.errors); return; }
  $("new").open = false;
  await open(answer.raw);
}

async function packed(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  return btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), c => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).text();
}

function play() {
  const on = $("play").getAttribute("aria-pressed") !== "true";
  $("play").setAttribute("aria-pressed", on);
  $("play").textContent = on ? "Стоп" : "Пуск";
  let before = performance.now();
  const step = now => {
    if ($("play").getAttribute("aria-pressed") !== "true") return;
    $("phi").value = (Number($("phi").value) + Math.max(1, (now - before) * .09)) % Number($("phi").max);
    before = now;
    turn();
    requestAnimationFrame(step);
  };
  if (on) requestAnimationFrame(step);
}

addEventListener("DOMContentLoaded", async () => {
  const choices = await ask("api/choices");
  for (const [id, options] of [["sample", Object.fromEntries(choices.samples.map(s => [s, s]))], ["layout", choices.layouts],
    ["strokes", choices.strokes], ["kind", choices.kinds]])
    $(id).replaceChildren(...Object.entries(options).map(([value, label]) => make("option", {value}, label)));
  $("strokes").value = "4"; $("sample").value = "gots-diesel";
  $("kinds").replaceChildren(...Object.entries(choices.files || {}).map(([kind, title]) =>
    make("button", {"data-kind": kind, onclick: () => order(kind, title)}, title)));
  $("sampleForm").addEventListener("submit", e => { e.preventDefault(); fresh({sample: $("sample").value}); });
  $("ownForm").addEventListener("submit", e => { e.preventDefault(); fresh(wanted()); });
  $("alike").addEventListener("click", () => fresh({raw: state.raw, cylinders: Number($("cylinders").value), layout: $("layout").value}));
  $("upload").addEventListener("change", async e => { const file = e.target.files[0]; if (file) await upload(file); e.target.value = ""; });
  $("undo").addEventListener("click", () => {
    const text = state.past.pop();
    $("undo").disabled = !state.past.length;
    touched = null;
    if (text) open(JSON.parse(text), false);
  });
  $("save").addEventListener("click", async () => {
    const answer = await ask("api/toml", {raw: state.raw});
    if (answer.errors) say($("errors"), answer.errors); else download("engine.toml", answer.text);
  });
  $("link").addEventListener("click", async () => {
    location.hash = await packed(JSON.stringify(state.raw));
    try { await navigator.clipboard.writeText(location.href); } catch { /* the address shows it */ }
    $("link").textContent = "Ссылка в адресе";
  });
  $("keep").addEventListener("click", () => { state.other = structuredClone(state.raw); $("drop").hidden = false; solve(); });
  $("drop").addEventListener("click", () => { state.other = null; $("drop").hidden = true; solve(); });
  $("find").addEventListener("input", find);
  $("sheet").addEventListener("change", () => { state.sheet = $("sheet").value; solve(); });
  $("phi").addEventListener("input", turn);
  $("play").addEventListener("click", play);
  let kept = null;
  try {
    if (location.hash.length > 1) kept = {raw: JSON.parse(await unpacked(location.hash.slice(1)))};
    else kept = JSON.parse(localStorage.getItem("kshm"));
  } catch { /* a damaged link or store is none */ }
  if (kept?.raw) {
    state.other = kept.other || null;
    $("drop").hidden = !state.other;
    const answer = await open(kept.raw, false);
    if (answer.groups?.length) { $("new").open = false; return; }
  }
  await fresh({sample: "gots-diesel"});
  $("new").open = true;
});
