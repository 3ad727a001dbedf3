"use strict";
// What all pages share: elements, questions to the server, numbers as Russian print has them.
const $ = id => document.getElementById(id);

function dressed(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes))
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (value !== false && value !== null && value !== undefined)
      element.setAttribute(key, value === true ? "" : value);
  element.append(...children);
  return element;
}
const make = (tag, attributes = {}, ...children) => dressed(document.createElement(tag), attributes, children);
const draw = (tag, attributes = {}, ...children) =>
  dressed(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
const options = (list, chosen) => list.map(([value, label, title]) =>
  make("option", {value, title, selected: String(chosen) === String(value)}, label));
const row = cells => make("tr", {}, ...cells.map(([text, name]) => make("td", {class: name}, ...[text].flat())));
const table = (caption, rows, head) => make("div", {class: "box", tabindex: 0, role: "region", "aria-label": caption},
  make("table", {}, make("caption", {}, caption), head || "", make("tbody", {}, ...rows)));

async function ask(path, data) {
  const file = data instanceof Blob, fault = (what, hint) => ({errors: [{where: "", what, hint}]});
  let answer;
  try {
    answer = await fetch(path, data === undefined ? {} : {
      method: "POST", body: file ? data : JSON.stringify(data),
      headers: {"X-Kshm": "1", "Content-Type": file ? "application/octet-stream" : "application/json"},
    });
  } catch { return fault("нет связи с сервером", "повторите"); }
  try { return await answer.json(); } catch { return fault(`сервер ответил ${answer.status}`, "повторите"); }
}

const words = problem => [problem.what, problem.hint].filter(Boolean).join("; ");
const line = problem => [problem.where, words(problem)].filter(Boolean).join(": ");
const say = (list, problems) => list.replaceChildren(
  ...(problems || []).map(p => make("li", {}, typeof p === "string" ? p : line(p))));
const told = answer => { say($("errors"), answer.errors); return !answer.errors?.length; };

function printed(value, digits = 4) {
  if (typeof value !== "number") return value ?? "";
  if (value && (Math.abs(value) < 1e-5 || Math.abs(value) >= 1e9)) {
    const [mantissa, power] = value.toExponential(digits - 1).split("e");
    const raised = [...power.replace("+", "")].map(c => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("");
    return `${printed(Number(mantissa), digits)}·10${raised}`;
  }
  const text = (value || 0).toLocaleString("ru", {maximumSignificantDigits: digits, useGrouping: false});
  return text.replace("-", "−").replace(/^−0$/, "0");
}

// «p_z», «$\gamma_{1}$»: what follows the underscore is a subscript.
const GREEK = {alpha: "α", beta: "β", gamma: "γ", delta: "δ", varphi: "φ", phi: "φ", omega: "ω", lambda: "λ", bar: "",
  varepsilon: "ε", epsilon: "ε", rho: "ρ", tau: "τ", theta: "θ", Delta: "Δ", Sigma: "Σ", psi: "ψ"};
function symbol(text) {
  const plain = text.replace(/\$|\\mathrm|\\text|\\,/g, "").replace(/\\(\w+)/g, (_, word) => GREEK[word] || word);
  return plain.split(/(_\{[^}]*\}|_[^\s_,;=(]+)/).filter(Boolean).map(part =>
    part.startsWith("_") ? make("sub", {}, part.replace(/[_{}]/g, "")) : part.replace(/[{}]/g, ""));
}
