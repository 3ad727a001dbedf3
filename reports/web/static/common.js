// What all pages share: their state, elements, questions to the server, numbers as Russian print has them.
import {h, render} from "./vendor/preact.mjs";
import htm from "./vendor/htm.mjs";

export const html = htm.bind(h);
export const state = {errors: []};
let page = null;

export function set(changes, template = page) {
  Object.assign(state, changes);
  render((page = template)(), document.body);
}

export const ask = (path, data) => fetch(path, data && {
  method: "POST", body: data instanceof Blob ? data : JSON.stringify(data),
  headers: {"X-Kshm": "1", "Content-Type": "application/octet-stream"},
}).then(answer => answer.json()).catch(() => ({errors: [{what: "нет связи с сервером", hint: "повторите"}]}));

export async function send(path, data) { // an answer, or nothing and its errors on the page
  const {errors, ...answer} = await ask(path, data);
  set({errors: errors || []});
  return errors ? null : answer;
}

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
  <div class="overflow:auto" tabindex="0" role="region" aria-label=${caption}>
    <table class="width:100%"><caption>${caption}</caption>${head}<tbody>${rows}</tbody></table>
  </div>`;
export const list = (problems, name, more) => html`
  <ul class=${`${name} color`} ...${more}>${problems.map(p => html`<li>${line(p)}</li>`)}</ul>`;
export const alerts = problems => list(problems, "bad", {id: "errors", role: "alert"});

// A file chosen at a button goes to `taken`; the same file may be chosen again.
export const picker = (title, accept, taken, id) => html`<label class="<button>">${title}
  <input id=${id} type="file" class="vh" accept=${accept} onClick=${e => { e.target.value = ""; }}
    onChange=${e => taken(e.target.files[0])} /></label>`;

export const words = problem => [problem.what, problem.hint].filter(Boolean).join("; ");
const line = problem => problem.what ? [problem.where, words(problem)].filter(Boolean).join(": ") : problem;

const raised = power => [...power].map(c => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("");

export function printed(value, digits = 4) {
  if (typeof value !== "number") return value ?? "";
  const notation = value && (Math.abs(value) < 1e-5 || Math.abs(value) >= 1e9) ? "scientific" : "standard";
  const how = {notation, maximumSignificantDigits: digits, useGrouping: false};
  return (value || 0).toLocaleString("ru", how).replace(/E(.+)/, (_, power) => `·10${raised(power)}`).replace("-", "−");
}

export const moment = seconds => seconds ? new Date(1000 * seconds).toLocaleString("ru") : "";

// «p_z»: what follows the underscore, to a space that breaks, is a subscript.
export const symbol = text => text.split(/_(\(\d+\)|[^ _,;=(/]+)/).map((part, i) => i % 2 ? html`<sub>${part}</sub>` : part);
