// A student's page: the own book taken and handed in, and its page once it is open.
import {render} from "./vendor/preact.mjs";
import {alerts, ask, html, picker, printed} from "./common.js";

const door = `../../api/student/${location.pathname.split("/").filter(Boolean).at(-1)}`;

async function look(errors = []) {
  const own = await ask(door), points = own.points ?? null;
  const words = [own.handed ? "работа сдана" : "работа ещё не сдана", own.status,
    points === null ? "" : `баллы: ${printed(points)}`];
  const hand = async file => look((await ask(`${door}/work`, file)).errors);
  render(html`
    <header><h1>${own.errors ? "Моя работа" : `${own.student} — ${own.title}`}</h1></header>
    <main class="single"><section>
      ${alerts([...errors, ...own.errors || []])}
      ${!own.errors && html`<p id="state" aria-live="polite">${words.filter(Boolean).join("; ")}</p>
        <p class="tools">
          <a id="book" class="button" href=${`${door}/book`} download=${own.file}>Скачать рабочую книгу</a>
          ${picker("Сдать книгу .xlsx", ".xlsx", hand, "work")}
          <a id="page" class="button" href=${`${door}/page`} hidden=${!own.open}>Страница проверки</a></p>`}
    </section></main>`, document.body);
}
look();
