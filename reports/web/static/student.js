// A student's page: the own book taken and handed in, and its page once it is open.
import {alerts, ask, given, html, insist, list, moment, picker, printed, row, send, set, state, symbol, table} from "./common.js";

const door = `../../api/student/${location.pathname.split("/").filter(Boolean).at(-1)}`;
const taken = async told => told && set({remarks: [], try: "", ...told, ...await ask(door)});
const look = async event => await send(`${door}/ask`, given(event)) && set({asked: true});
const hand = async file => taken(await send(`${door}/work`, file));

const day = text => new Date(text).toLocaleString("ru", {dateStyle: "long", timeStyle: "short"});
const assignment = ({engine, rows}, deadline) => html`<section id="task"><h2>Задание</h2>
  <p>${engine}. Заполните формулами пустые ячейки рабочей книги и сдайте её${deadline ? html` <b id="deadline">до ${day(deadline)}</b>` : ""}.</p>
  ${rows.length > 0 && table("Данные вашего варианта", rows.map(({title, symbol: name, value, unit}) =>
    row([[title], [symbol(name), "s"], [printed(value, 9), "n"], [unit, "s"]])))}</section>`;

function own({task, tries, student, title, handed, when, late, deadline, closed, earlier, status, points, file, open}) {
  const words = [handed ? `работа сдана ${moment(when)}`.trim() : "работа ещё не сдана", late && "после срока",
    deadline && `срок ${day(deadline)}`,
    tries[1] > 0 && `попыток ${tries[0]} из ${tries[1]}`, status, points !== null && `баллы: ${printed(points)}`];
  return html`
    <h1>${student} — ${title}</h1>
    ${assignment(task, deadline)}
    <p id="state" aria-live="polite">${words.filter(Boolean).join("; ")}</p>
    ${state.try && html`<p id="try" role="status">${state.try}</p>`}
    ${earlier.length > 0 && html`<p id="earlier">Считается последняя; раньше сданы и хранятся: ${earlier.map(each => moment(each.when)).join("; ")}</p>`}
    ${list(state.remarks || [], "warn", {id: "remarks", "aria-label": "Что стоит поправить перед сроком"})}
    ${closed && html`<p id="closed" class="warn">${closed}</p>`}
    <p class="bar">
      <a id="book" class="button" href=${`${door}/book`} download=${file}>Скачать рабочую книгу</a>
      ${!closed && picker("Сдать книгу .xlsx", ".xlsx", hand, "work")}
      <a id="page" class="button" href=${`${door}/page`} hidden=${!open}>Страница проверки</a></p>
    ${open && html`<form id="look" onSubmit=${look}>
      <label>Столбец, как на странице проверки <input name="column" required maxlength="40" placeholder="П3.1 v"/></label>
      <label>В чём вы не согласны <input name="text" required maxlength="300"/></label>
      <button>Попросить посмотреть ещё раз</button>
      ${state.asked && html`<p role="status">Просьба передана; ответ будет на странице проверки.</p>`}</form>`}`;
}

set({...await insist(door), again: async () => set(await ask(door))}, () => html`
  <main>${alerts(state.errors)}${state.student ? own(state) : html`<h1>Моя работа</h1>`}</main>`);
