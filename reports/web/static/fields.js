// The fields of an input in groups, each with its unit, range, slider and what is wrong with it.
import {html, options, printed, symbol, words} from "./common.js";

export const shown = value => typeof value === "number" ? String(value).replace(".", ",") : value ?? "";
const number = text => Number(text.replace(",", ".").replace("−", "-"));

export function put(raw, path, value) {
  const last = path.at(-1), part = path.slice(0, -1).reduce((inner, key) => inner[key] ??= {}, raw);
  if (value !== "" || Array.isArray(part)) part[last] = value;
  else delete part[last];
}

function remove(raw, path) {
  const last = path.at(-1), part = path.slice(0, -1).reduce((inner, key) => inner[key], raw);
  if (Array.isArray(part)) part.splice(last, 1);
  else delete part[last];
}

function repeat(raw, path, blank) { // a list grows by its last entry
  const part = path.slice(0, -1).reduce((inner, key) => inner[key] ??= {}, raw), list = part[path.at(-1)] ??= [];
  list.push(structuredClone(list.at(-1) ?? blank));
}

export function add(raw, id) { // a section, or a regime that begins as the main one
  if (id !== "regimes") raw[id] = {};
  else {
    const list = raw.regimes ??= [], name = `Режим ${list.length + 2}`;
    list.push(structuredClone({...raw.regime, name, gas: raw.gas}));
  }
}

const said = problems => (problems || []).map(p => html`<span class=${p.kind}>${words(p)}</span>`);

// A group; `edited` changes the shape of the input, `change` a value.
export function section({title, key, path, entries, blank, drawing, whole}, {state, edited, change}) {
  const wanted = state.find.trim().toLowerCase();
  const found = f => `${f.title} ${f.key} ${f.symbol}`.toLowerCase().includes(wanted);
  const button = (label, what) => html`<button class="small" onClick=${() => edited(what, key)}>${label}</button>`;
  const fields = entry => entry.filter(found).map(f => field(f, state, change));
  return html`
    <details key=${key} data-key=${key} open=${Boolean(wanted) || state.open.has(key)}
      hidden=${wanted && !entries.flat().some(found)}
      onToggle=${e => state.open[e.target.open ? "add" : "delete"](key)}>
      <summary>${title}</summary><span class="said">${said(state.problems[key])}</span>
      ${drawing && html`<img src=${`images/${drawing}.svg`} alt=${`${title}: что есть что`} loading="lazy" />`}
      ${entries.map((entry, i) => !path ? fields(entry) : html`<fieldset>
        <legend>${`№ ${i + 1} `}${button(`Убрать ${i + 1}`, raw => remove(raw, [...path, i]))}</legend>
        ${fields(entry)}
      </fieldset>`)}
      <p class="tools">${path && button("Добавить", raw => repeat(raw, path, blank))}
        ${whole && button("Убрать раздел", raw => remove(raw, whole))}</p>
    </details>`;
}

function field(f, state, change) {
  const text = state.typed[f.key] ?? shown(f.value), wrong = state.problems[f.key]?.some(p => p.kind === "error");
  const told = {id: `f-${f.key}`, "aria-describedby": `h-${f.key} e-${f.key}`, "aria-invalid": wrong || undefined};
  const range = f.number && f.min !== null && `от ${printed(f.min, 9)} до ${printed(f.max, 9)} ${f.unit}`;
  const empty = f.optional || f.value === null ? [["", "—"]] : [];
  return html`
    <div key=${f.key} class=${f.number || f.choices ? "field" : "field wide"} data-key=${f.key}>
      <label for=${told.id}>${f.title}${f.symbol && ", "}${symbol(f.symbol)}</label>
      ${f.choices
        ? html`<select ...${told} value=${text} onChange=${e => change(f, e.target.value, true)}>
            ${options([...empty, ...Object.entries(f.choices)])}</select>`
        : html`<input ...${told} value=${text} inputmode=${f.number ? "decimal" : undefined} autocomplete="off"
            maxlength="300" onInput=${e => change(f, e.target.value)} />`}
      <span>${f.unit}</span>${slider(f, text, change)}
      <small id=${`h-${f.key}`}>${[range, f.optional && "можно не задавать", f.key].filter(Boolean).join(" · ")}</small>
      <span id=${`e-${f.key}`} class="said">${said(state.problems[f.key])}</span>
    </div>`;
}

function slider(f, text, change) {
  if (!f.number || typeof f.value !== "number" || !f.value || f.key.includes("[")) return null;
  const span = Math.abs(f.value) * .4, step = 10 ** Math.floor(Math.log10(span / 50));
  const tidy = value => Math.round(value / step) * step;
  return html`<input type="range" aria-label=${`${f.title}: подвинуть`} step=${step}
    min=${tidy(Math.max(f.min ?? -Infinity, f.value - span))} max=${tidy(Math.min(f.max ?? Infinity, f.value + span))}
    value=${number(text)} onInput=${e => change(f, shown(Number(Number(e.target.value).toPrecision(8))))} />`;
}
