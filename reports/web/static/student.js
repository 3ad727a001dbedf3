// A student's page: the own book taken and handed in, and its page once it is open.
import {alerts, ask, html, list, moment, picker, printed, send, set, state} from "./common.js";

const door = `../../api/student/${location.pathname.split("/").filter(Boolean).at(-1)}`;
const taken = async told => told && set({remarks: [], ...told, ...await ask(door)});
const hand = async file => taken(await send(`${door}/work`, file));

function own({student, title, handed, when, earlier, status, points, file, open}) {
  const words = [handed ? `работа сдана ${moment(when)}`.trim() : "работа ещё не сдана", status, points !== null && `баллы: ${printed(points)}`];
  return html`
    <h1>${student} — ${title}</h1>
    <p id="state" aria-live="polite">${words.filter(Boolean).join("; ")}</p>
    ${earlier.length > 0 && html`<p id="earlier">Считается последняя; раньше сданы и хранятся: ${earlier.map(moment).join("; ")}</p>`}
    ${list(state.remarks || [], "warn", {id: "remarks", "aria-label": "Что стоит поправить перед сроком"})}
    <p class="tool-bar">
      <a id="book" class="<button>" href=${`${door}/book`} download=${file}>Скачать рабочую книгу</a>
      ${picker("Сдать книгу .xlsx", ".xlsx", hand, "work")}
      <a id="page" class="<button>" href=${`${door}/page`} hidden=${!open}>Страница проверки</a></p>`;
}

set(await ask(door), () => html`
  <main>${alerts(state.errors)}${state.student ? own(state) : html`<h1>Моя работа</h1>`}</main>`);
