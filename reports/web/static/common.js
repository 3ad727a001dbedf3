"use strict";
// What all pages share: elements, questions to the server, numbers as Russian print has them.
const $ = id => document.getElementById(id);
const SVG = "http://www.w3.org/2000/svg";

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes))
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (value !== false && value !== null && value !== undefined)
      element.setAttribute(key, value === true ? "" : value);
  element.append(...children);
  return element;
}

function draw(tag, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

async function ask(path, data, signal) {
  const file = data instanceof Blob;
  let answer;
  try {
    answer = await fetch(path, data === undefined ? {signal} : {
      method: "POST", signal, body: file ? data : JSON.stringify(data),
      headers: {"X-Kshm": "1", "Content-Type": file ? "application/octet-stream" : "application/json"},
    });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    return {errors: [{where: "", what: "нет связи с сервером", hint: "повторите"}]};
  }
  try { return await answer.json(); } catch {
    return {errors: [{where: "", what: `сервер ответил ${answer.status}`, hint: "повторите"}]};
  }
}

const line = problem => [problem.where, [problem.what, problem.hint].filter(Boolean).join("; ")].filter(Boolean).join(": ");
const say = (list, problems) => list.replaceChildren(...(problems || []).map(p => make("li", {}, typeof p === "string" ? p : line(p))));

function printed(value, digits = 4) {
  if (typeof value !== "number") return value ?? "";
  return (value || 0).toLocaleString("ru", {maximumSignificantDigits: digits, useGrouping: false}).replace("-", "−").replace(/^−0$/, "0");
}

// «p_z», «$\gamma_{1}$»: what follows the underscore is a subscript.
function symbol(text) {
  const plain = text.replace(/\$|\\mathrm|\\text|\\,/g, "").replace(/\\(\w+)/g, (_, word) => GREEK[word] || word);
  const out = [];
  for (const part of plain.split(/(_\{[^}]*\}|_[^\s_,;=(]+)/))
    if (part.startsWith("_")) out.push(make("sub", {}, part.replace(/[_{}]/g, "")));
    else if (part) out.push(part.replace(/[{}]/g, ""));
  return out;
}
const GREEK = {alpha: "α", beta: "β", gamma: "γ", delta: "δ", varphi: "φ", phi: "φ", omega: "ω", lambda: "λ",
  varepsilon: "ε", epsilon: "ε", rho: "ρ", tau: "τ", theta: "θ", Delta: "Δ", Sigma: "Σ", psi: "ψ", bar: ""};

function download(name, text) {
  const link = make("a", {href: URL.createObjectURL(new Blob([text], {type: "application/toml"})), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
