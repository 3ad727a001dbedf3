// The live page: one file, no server; what fields change is calculated here, and taken home.
import {download, html, set, state} from "./common.js";
import {section} from "./fields.js";
import {begin, calculate, cellsOf, charts, engineOf, five, makeCard, moveFirst, moves, numbers, paper, read, rest, retype, scene, tables, type} from "./view.js";
import {functions} from "./program.js";
import {functions as fineFunctions} from "./fine.js";
import {toml, workbook} from "./takeaway.js";

const data = JSON.parse(document.getElementById("live-data").textContent), engine = engineOf(data, [functions, fineFunctions]);
const about = key => [engine.byKey[key]?.title, engine.byKey[key]?.unit].filter(Boolean).join(", ");
const change = (key, path, value) => type({[key]: value});

function back() {
  const changes = Object.fromEntries(engine.fields.filter(f => !f.fixed).map(f => [f.key, read(data.raw, f.path)]));
  state.wrong = [];
  retype(changes);
  set({wrong: calculate(changes)});
}

const tomlText = () => toml(state.raw, about, "Исходные данные двигателя для kshm, с живой страницы.");
const save = async (blob, end) => download(await blob, `${data.file}${end}`);

const dataPart = () => html`<section id="data" aria-label="Исходные данные">
  <h2>Все исходные</h2>
  <p><label>Найти поле <input id="find" type="search" autocomplete="off" value=${state.find} onInput=${e => set({find: e.target.value})} /></label></p>
  <p><small>Затенённое поле — строение двигателя или то, что связано с другими: нужен build.</small></p>
  <div id="fields">${groups.map(group => section(group, change))}</div></section>`;

const page = () => html`
  <a class="skip" href="#five">К данным двигателя</a> <a class="skip" href="#results">К диаграммам</a>
  <header><h1>${state.raw.engine.name}</h1>
    <p class="bar"><button id="save" onClick=${() => save(new Blob([tomlText()]), "-правка.toml")}>Скачать .toml</button>
      <button id="book" onClick=${() => save(workbook(data.book, cellsOf(engine, state.raw)), "-правка.xlsx")}>Книга Excel</button>
      <button id="card" onClick=${() => save(makeCard(), ".png")}>Карточка</button> <button id="print" onClick=${() => print()}>Печать</button></p></header>
  <main><aside id="inputs">${five(change, html`<p class="bar"><button id="back" disabled=${!state.isChanged} onClick=${back}>Как при сборке</button></p>`)}${dataPart()}</aside>
    <div id="view">${scene()}${numbers()}${charts()}${tables()}</div></main>
  ${paper()}
  <p class="hidden" role="status">${state.told}</p>`;

Object.assign(state, {engine, raw: structuredClone(data.raw), remarks: data.remarks, titles: Object.fromEntries(engine.fields.map(f => [f.key, f.title])), choices: data});
const groups = rest(data.fields);
state.last = {moves: moves(), warnings: []};
await begin({remarks: data.remarks}, page);
live.toml = tomlText;
moveFirst();
