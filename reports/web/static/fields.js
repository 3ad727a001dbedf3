// The fields of an input in groups, each with its unit, range, slider and what is wrong with it.
import {html, memo, options, printed, state, symbol, words} from "./common.js";

export const text = value => typeof value === "number" ? String(value).replace(".", ",") : value ?? "";
const RESHAPED = {"engine.cylinders": "cylinders", "engine.layout": "layout"}; // make another shaft, as `new` does

export function put(raw, path, value) { // nothing takes the place away
  const last = path.at(-1), isEntry = typeof last === "number";
  const part = path.slice(0, -1).reduce((part, key, i) => part[key] ??= Number.isInteger(path[i + 1]) ? [] : {}, raw);
  if (value === undefined && isEntry) part.splice(last, 1);
  else part[last] = value === "" && !isEntry ? undefined : structuredClone(value);
}

const isWrong = key => state.wrong.some(p => p.where === key);
const said = key => [[state.wrong, "error bad"], [state.last?.warnings ?? [], "warn"]].map(([all, name]) =>
  all.filter(p => p.where === key).map(p => html`<div class=${name}>${words(p)}</div>`));

// What is typed: a number in the Russian or the English way, finished or not, or words.
function meant({number}, typed) {
  const plain = typed.trim().replace(",", ".").replace("−", "-");
  return number && /^-?(\d+\.?\d*|\.\d+)$/.test(plain) ? Number(plain) : typed.trim();
}

// A group is made again only where something of its own has changed.
export function section(group, change, reshape) {
  const {key, path, entries} = group, all = entries.flat(), keys = new Set([key, ...all.map(f => f.key)]);
  const own = problems => JSON.stringify(problems.filter(p => keys.has(p.where)));
  const parts = [group, own(state.wrong), own(state.last?.warnings ?? []), state.find, state.open.has(key),
    JSON.stringify(all.map(f => state.typed[f.key])), path && path.reduce((part, each) => part?.[each], state.raw)?.length];
  return memo(`section ${key}`, parts, () => drawn(group, change, reshape));
}

function drawn({title, key, path, entries, more, drawing, whole, isPlain}, change, reshape) {
  const wanted = state.find.trim().toLowerCase(), all = entries.flat();
  const found = f => `${f.title} ${f.key} ${f.symbol}`.toLowerCase().includes(wanted);
  const list = path?.reduce((part, each) => part?.[each], state.raw) ?? [];
  const button = (label, at, value) => html`<button onClick=${() => change(key, at, value, true)}>${label}</button>`;
  const fields = entry => entry.filter(found).map(f => field(f, change, reshape));
  if (isPlain) return html`<div key=${key}>${entries.map(entry => entry.map(f => field(f, change, reshape)))}</div>`;
  return html`
    <details key=${key} data-key=${key} open=${wanted || [key, ...all.map(f => f.key)].some(isWrong) || state.open.has(key)}
      hidden=${wanted && !all.some(found)}
      onToggle=${e => wanted || state.open[e.target.open ? "add" : "delete"](key)}>
      <summary>${title}</summary>${said(key)}
      ${drawing && html`<img src=${`images/${drawing}.svg`} alt=${`${title}: что есть что`} loading="lazy" />`}
      ${entries.map((entry, i) => !path ? fields(entry) : html`<fieldset>
        <legend>${`№ ${i + 1} `}${button(`Убрать ${i + 1}`, [...path, i])}</legend>
        ${fields(entry)}
      </fieldset>`)}
      <p class="bar">${path && button("Добавить", [...path, list.length], more)}
        ${whole && button("Убрать раздел", whole)}</p>
    </details>`;
}

function field(f, change, reshape) {
  const typed = state.typed[f.key] ?? text(f.value), id = `f-${f.key}`, reshaped = RESHAPED[f.key];
  const type = value => change(f.key, f.path, meant(f, state.typed[f.key] = value), Boolean(f.choices));
  const taken = reshaped ? {onChange: e => reshape({[reshaped]: e.target.value})} : {onInput: e => type(e.target.value)};
  const told = {id, ...taken, title: f.key, "aria-describedby": `h-${f.key} e-${f.key}`, "aria-invalid": String(isWrong(f.key)), disabled: f.fixed};
  const range = f.number && `от ${printed(f.min, 9)} до ${printed(f.max, 9)} ${f.unit}`;
  const empty = f.optional || f.value === null ? [["", "—"]] : [];
  return html`
    <div key=${f.key} class=${`field ${f.number || f.choices ? "" : "wide"} ${f.fixed ? "fixed" : ""}`} data-key=${f.key}>
      <label for=${id}><span>${f.title}${f.symbol && ", "}${symbol(f.symbol)}</span></label>
      ${f.choices ? html`<select ...${told}>${options([...empty, ...Object.entries(f.choices)], typed)}</select>`
        : html`<input ...${told} value=${typed} inputmode=${f.number && "decimal"} autocomplete="off" maxlength="300" />`}
      <span>${f.unit}</span>${!reshaped && !f.fixed && slider(f, typed, type)}
      <small id=${`h-${f.key}`}>${[f.fixed ? "нужен build" : range, f.optional && "можно не задавать"].filter(Boolean).join(" · ")}</small>
      <div id=${`e-${f.key}`}>${said(f.key)}</div>
    </div>`;
}

function slider(f, typed, type) { // two figures of its ends are round enough for its step
  if (!f.number || typeof f.value !== "number" || !f.value || f.key.includes("[")) return null;
  const span = Math.abs(f.value) * .4;
  return html`<input type="range" aria-label=${`${f.title}: подвинуть`} step=${10 ** Math.floor(Math.log10(span / 50))}
    min=${Math.max(f.min, f.value - span).toPrecision(2)} max=${Math.min(f.max, f.value + span)}
    value=${typed.replace(",", ".")} onInput=${e => type(text(Number(e.target.value)))} />`;
}
