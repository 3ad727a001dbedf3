// Own engines in this browser, each under a key of its own: no tab writes over what another has written.
const KEY = "kshm:", PLACE = "kshm";

function read(id) {
  try {
    const {raw, ...more} = JSON.parse(localStorage[KEY + id]);
    return raw && {...more, id, raw};
  } catch { /* removed, damaged, or a window that stores nothing */ }
}

export const text = ({raw, other}) => JSON.stringify({raw, other: other || undefined});

export function engines() { // the last one first
  try {
    return Object.keys(localStorage).filter(key => key.startsWith(KEY)).map(key => read(key.slice(KEY.length)))
      .filter(Boolean).sort((a, b) => b.date - a.date);
  } catch { return []; }
}

export function last() { // of this tab, else of this browser; what only came by a link comes behind
  try {
    if (sessionStorage[PLACE] && read(sessionStorage[PLACE])) return read(sessionStorage[PLACE]);
  } catch { /* a private window */ }
  const all = engines();
  return all.find(each => !each.link) ?? all[0];
}

const fresh = () => Date.now().toString(36) + Math.random().toString(36).slice(2, 10);

// Keeps an engine in its place, beside it where another tab has changed what stands there.
export function keep({id, stamp, link}, engine) {
  const there = id && read(id), alike = !id && engines().find(each => text(each) === text(engine));
  if (alike) return {...seen(alike), news: ""};
  const moved = Boolean(there && there.stamp !== stamp);
  const own = {id: !id || moved ? fresh() : id, stamp: fresh(), link: Boolean(link && !id)};
  try {
    localStorage[KEY + own.id] = JSON.stringify({...engine, date: Date.now(), stamp: own.stamp, link: own.link});
  } catch {
    return {id, stamp, link, news: "браузер этого двигателя не сохранил: скачайте .toml или уберите лишние"};
  }
  return {...seen(own), news: moved ? "двигатель изменён и в другой вкладке: этот записан рядом" : ""};
}

export function seen({id, stamp, link}) { // the place of this tab, also after it is loaded again
  try { sessionStorage[PLACE] = id ?? ""; } catch { /* a private window */ }
  return {id, stamp, link};
}

export function remove(id) {
  try { delete localStorage[KEY + id]; } catch { /* nothing was there */ }
}

const JOBS = "kshm-jobs", MOST = 20; // ordered files, there after the page is loaded again

export function storedJobs() {
  try { return JSON.parse(localStorage[JOBS]).map(({id, title, name}) => ({id, title, name})); } catch { return []; }
}

export function storeJobs(jobs) {
  try { localStorage[JOBS] = JSON.stringify(jobs.slice(0, MOST).map(({id, title, name}) => ({id, title, name}))); } catch { /* a private window */ }
}

// Engines of one name are told apart by what differs: values of the first one that are others in the second.
const leaves = (value, path = "") => value && typeof value === "object"
  ? Object.entries(value).flatMap(([key, each]) => leaves(each, Array.isArray(value) ? `${path}[${Number(key) + 1}]` : path ? `${path}.${key}` : key)) : [[path, value]];
export function differences(raw, other) {
  const there = new Map(leaves(other));
  return leaves(raw).filter(([key, value]) => value !== null && value !== undefined && there.get(key) !== value);
}
