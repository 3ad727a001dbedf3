// What all pages share: their state, elements, questions to the server, numbers as Russian print has them.
import {h, render} from "./vendor/preact.mjs";
import htm from "./vendor/htm.mjs";

export const html = htm.bind(h);
export const state = {errors: [], titles: {}};
export const after = []; // what is done after each drawing of the page
let page = null;

export function set(changes, template = page) {
  Object.assign(state, changes);
  render((page = template)(), document.body);
  for (const each of after) each();
}

// The element of before where nothing that it is made of has changed: it is not compared again.
const Kept = ({element}) => element;
const kept = new Map();
export function memo(key, parts, make) {
  const before = kept.get(key);
  if (before && parts.every((part, i) => Object.is(part, before.parts[i]))) return before.element;
  const element = h(Kept, {key, element: make()});
  kept.set(key, {parts, element});
  return element;
}

export const wait = ms => new Promise(done => setTimeout(done, ms));
const LOST = {what: "нет связи с сервером", hint: "страница продолжит сама, как только связь будет"};

export async function ask(path, data) {
  try {
    const answer = await fetch(path, data && {
      method: "POST", body: data instanceof Blob ? data : JSON.stringify(data),
      headers: {"X-Kshm": "1", "Content-Type": "application/octet-stream", ...data instanceof File && {"X-Name": encodeURIComponent(data.name)}},
    });
    return {...await answer.json(), ...answer.status === 503 && {busy: Number(answer.headers.get("retry-after")) || 2}};
  } catch {
    mend();
    return {errors: [LOST], isLost: true};
  }
}

async function mend() { // asks until there is an answer, then goes on where the page was left
  if (state.isLost) return;
  state.isLost = true;
  if (page) set({});
  while (state.isLost) {
    await wait(1000);
    const found = await fetch(new URL("style.css", import.meta.url), {method: "HEAD", cache: "no-store"}).catch(() => null);
    state.isLost = !found?.ok;
  }
  set({errors: state.errors.filter(each => each !== LOST)});
  state.again?.();
}

export async function insist(path) { // what there is no page without
  for (;;) {
    const {isLost, busy, ...answer} = await ask(path);
    if (!isLost && !busy) return answer;
    await wait(1000);
  }
}

export async function send(path, data) { // an answer, or nothing and its errors on the page
  const {errors, ...answer} = await ask(path, data);
  set({errors: errors || []});
  return errors ? null : answer;
}

// What a person has said wrongly is forgotten when he goes on.
addEventListener("input", () => state.errors.some(each => each !== LOST) && set({errors: state.errors.filter(each => each === LOST)}));
addEventListener("submit", event => event.preventDefault()); // each form has its own question
export const given = event => Object.fromEntries(new FormData(event.target));

export const options = (list, chosen) => list.map(([value, label, title]) =>
  html`<option key=${value} value=${value} title=${title} selected=${value === chosen}>${label}</option>`);
export const choice = (title, name, list, chosen, taken) => html`
  <label>${title} <select id=${name} name=${name} onChange=${e => taken?.(e.target.value)}>
    ${options(list, chosen)}</select></label>`;
export const row = (cells, more) => html`
  <tr ...${more}>${cells.map(([text, name]) => html`<td class=${name}>${text}</td>`)}</tr>`;
export const table = (caption, rows, head) => html`
  <div class="scroll" tabindex="0" role="region" aria-label=${caption}>
    <table><caption>${caption}</caption>${head}<tbody>${rows}</tbody></table>
  </div>`;
export const list = (problems, name, more) => html`
  <ul class=${name} ...${more}>${problems.map(p => html`<li>${line(p)}</li>`)}</ul>`;
export const alerts = problems => html`<div id="errors" role="alert">${list(problems, "bad")}</div>`;

// A file chosen at a button goes to `taken`; the same file may be chosen again.
export const picker = (title, accept, taken, id) => html`<label class="button">${title}
  <input id=${id} type="file" class="hidden" accept=${accept} onClick=${e => { e.target.value = ""; }}
    onChange=${e => taken(e.target.files[0])} /></label>`;

export function download(blob, name) {
  Object.assign(document.createElement("a"), {href: URL.createObjectURL(blob), download: name}).click();
}

// A person knows a field by its words, not by the key of the file.
const KEY = /\b[a-z_]+(?:(?:\.[a-z_0-9]+)|(?:\[\d+\]))+/g;
const title = key => state.titles[key];
const plain = text => text?.replace(KEY, key => title(key) ? `«${title(key)}»` : key);
export const words = problem => [problem.what, problem.hint].filter(Boolean).map(plain).join("; ");
const line = problem => problem.what
  ? [title(problem.where) ?? plain(problem.where), words(problem)].filter(Boolean).join(": ") : plain(problem);

const raised = power => [...power].map(c => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("");
const FORMATS = {}; // to make one costs more than to print a number

export function printed(value, digits = 4) {
  if (typeof value !== "number") return value ?? "";
  const notation = value && (Math.abs(value) < 1e-5 || Math.abs(value) >= 1e9) ? "scientific" : "standard";
  const how = FORMATS[notation + digits] ??=
    new Intl.NumberFormat("ru", {notation, maximumSignificantDigits: digits, useGrouping: false});
  return how.format(value || 0).replace(/E(.+)/, (_, power) => `·10${raised(power)}`).replace("-", "−");
}

export const moment = seconds => seconds ? new Date(1000 * seconds).toLocaleString("ru") : "";

// «p_z»: what follows the underscore, to a space that breaks, is a subscript.
export const symbol = text => text.split(/_(\(\d+\)|[^ _,;=(/]+)/).map((part, i) => i % 2 ? html`<sub>${part}</sub>` : part);
