// Charts of the numbers that the server sends (ChartSpec), by Chart.js; a cursor over each follows φ.
import {html, memo, printed, state, symbol} from "./common.js";
import {render} from "./vendor/preact.mjs";

const DASHES = [[], [8, 3], [3, 3], [10, 3, 3, 3], [1, 3], [14, 4]];
export const dark = matchMedia("(prefers-color-scheme: dark)");

// The colours of the workbook's charts; on black they are nearer to white.
export const inks = () => state.choices.palette.map(colour => dark.matches ? `color-mix(in oklab, #${colour} 75%, white)` : `#${colour}`);

export function between(xs, ys, x) { // nothing where there is no curve
  let low = 0, high = xs.length - 1;
  if (!(x >= xs[low] && x <= xs[high])) return null;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (xs[middle] < x) low = middle; else high = middle;
  }
  return ys[high] === null ? null : ys[low] + (x - xs[low]) / (xs[high] - xs[low] || 1) * (ys[high] - ys[low]);
}

// Curves of a chart, then those of the other engine.
const curvesOf = (own, other, colours) => [own, other].filter(Boolean).flatMap((chart, second) =>
  chart.curves.map((curve, i) => ({
    ...curve, data: curve.data ??= curve.x.map((x, k) => ({x, y: curve.y[k]})),
    label: second ? `${curve.name} (второй)` : curve.name, borderColor: colours[i % colours.length],
    borderDash: second ? [2, 4] : DASHES[i % 6], showLine: second || i || !chart.strokes,
  })));

const hidden = new Set(); // curves that a person has switched off, by chart and name
const key = (own, curve) => `${own.id} ${curve.label}`;

function tip(box, {tooltip: {opacity, caretX, dataPoints = []}}) { // as elements: canvas knows no subscripts
  box.hidden = !opacity;
  box.style.transform = `translateX(${caretX}px)`;
  box.classList.toggle("left", caretX > box.parentElement.clientWidth / 2);
  render(dataPoints.slice(0, 6).map(({dataset, parsed}) => html`
    <div><b>${symbol(dataset.label)}</b> ${printed(parsed.x, 5)}; ${printed(parsed.y, 5)}</div>`), box);
}

function roundAngles(axis) { // round angles, however near one looks
  const span = axis.max - axis.min, step = [5, 10, 15, 30, 60, 90, 120, 180].find(each => span / each <= 7) ?? 360;
  axis.ticks = Array.from({length: Math.floor(span / step) + 2}, (_, i) => ({value: (Math.ceil(axis.min / step) + i) * step}))
    .filter(({value}) => value <= axis.max);
}

// It comes when the mechanism is there already; what feels two fingers, only where there are fingers.
let isThere = false;
async function library() {
  if (!globalThis.Chart) { // else the page carries it
    await import("./vendor/chart.umd.min.js");
    if (navigator.maxTouchPoints) await import("./vendor/hammer.min.js");
    await import("./vendor/chartjs-plugin-zoom.min.js");
  }
  if (!isThere) Chart.register({id: "words", afterDatasetsDraw: words});
  isThere = true;
}

// «p_z» on a canvas: the index lower and smaller; a halo keeps it off the curves, the plot's edge holds it.
function write(ink, text, x, y, colour, {left, right} = {left: 0, right: Infinity}) {
  const [name, index = "", rest = ""] = text.split(/_(\(\d+\)|[^ _,;=(/]+)/);
  const wide = [[name, 13], [index, 10], [rest, 13]].reduce((sum, [part, size]) => {
    ink.font = `600 ${size}px 'Inter Variable', sans-serif`;
    return sum + ink.measureText(part).width;
  }, 0);
  x = Math.max(Math.min(x, right - wide - 2), left + 2);
  Object.assign(ink, {fillStyle: colour, strokeStyle: ink.canvas.under, lineWidth: 3, lineJoin: "round", textBaseline: "middle", textAlign: "left"});
  for (const [part, size, drop] of [[name, 13, 0], [index, 10, 4], [rest, 13, 0]]) {
    ink.font = `600 ${size}px 'Inter Variable', sans-serif`;
    ink.strokeText(part, x, y + drop);
    ink.fillText(part, x, y + drop);
    x += ink.measureText(part).width;
  }
}

// Each curve is called by its name where it stands farthest from the others; a journal's load has its
// greatest vector, its mean as a circle and its strokes by colours.
function words(chart) {
  const {ctx: ink, chartArea: area, scales: {x, y}, canvas: {own}} = chart, taken = [];
  if (!own) return;
  const isFree = (px, py) => taken.every(([tx, ty]) => Math.abs(tx - px) > 48 || Math.abs(ty - py) > 16);
  const sets = chart.data.datasets.map((set, i) => [set, chart.isDatasetVisible(i)]).filter(([, isVisible]) => isVisible);
  ink.save();
  if (sets.length > 1) for (const [set] of sets) {
    const every = Math.ceil(set.data.length / 90); // a word needs no finer place
    const points = set.data.filter((p, i) => i % every === 0 && p.y !== null && p.x >= x.min && p.x <= x.max);
    const far = own.kind === "line" ? p => Math.abs(p.y - (y.min + y.max) / 2) : p => Math.hypot(p.x, p.y);
    const spots = points.toSorted((a, b) => far(b) - far(a)).map(p => [x.getPixelForValue(p.x), y.getPixelForValue(p.y)]);
    const [px, py] = spots.find(spot => isFree(...spot)) ?? [];
    if (px === undefined) continue;
    taken.push([px, py]);
    write(ink, set.label, px + 6, Math.min(Math.max(py + (py < (area.top + area.bottom) / 2 ? 8 : -8), area.top + 8), area.bottom - 8), set.borderColor, area);
  }
  ink.beginPath();
  ink.rect(area.left, area.top, area.width, area.height);
  ink.clip();
  if (own.strokes) own.strokes.forEach((_, i) => stroke(ink, own, chart, i));
  if (own.marks) vector(ink, own, chart);
  if (own.strokes) own.strokes.forEach((name, i) => write(ink, name, area.left + 8, area.bottom - 12 - 16 * (own.strokes.length - 1 - i), inks()[i]));
  ink.restore();
}

function stroke(ink, {path}, {scales: {x, y}}, number) { // a part of a path in the colour of its stroke
  Object.assign(ink, {strokeStyle: inks()[number], lineWidth: 2, lineJoin: "round"});
  ink.beginPath();
  path.phi.forEach((phi, i) => {
    if (phi >= 180 * number && phi <= 180 * (number + 1)) ink.lineTo(x.getPixelForValue(path.x[i]), y.getPixelForValue(path.y[i]));
  });
  ink.stroke();
}

function vector(ink, {marks}, {chartArea: area, scales: {x, y}}) {
  const {color} = ink.canvas, at = (px, py) => [x.getPixelForValue(px), y.getPixelForValue(py)];
  const [from, to] = [at(0, 0), at(marks.x, marks.y)], along = Math.atan2(to[1] - from[1], to[0] - from[0]);
  Object.assign(ink, {strokeStyle: color, fillStyle: color, lineWidth: 1.5});
  ink.beginPath();
  ink.moveTo(...from);
  ink.lineTo(...to);
  ink.stroke();
  ink.beginPath();
  for (const turn of [0, 2.75, -2.75]) ink.lineTo(to[0] + (turn && 10 * Math.cos(along + turn)), to[1] + (turn && 10 * Math.sin(along + turn)));
  ink.fill();
  ink.setLineDash([2, 3]);
  ink.lineWidth = 1;
  ink.beginPath();
  ink.arc(...from, Math.abs(x.getPixelForValue(marks.mean) - from[0]), 0, 2 * Math.PI);
  ink.stroke();
  ink.setLineDash([]);
  const out = Math.abs(x.getPixelForValue(marks.mean) - from[0]) * Math.SQRT1_2;
  write(ink, marks.name, to[0] + 10, to[1] + (to[1] < from[1] ? 10 : -10), color, area);
  write(ink, marks.meanName, from[0] + out + 4, from[1] + out + 6, color, area);
}

async function drawLater(canvas, ...given) {
  await library();
  if (canvas.isConnected) draw(canvas, ...given);
  state.follow();
}

function draw(canvas, own, datasets, color) {
  if (canvas.datasets === datasets) return;
  Object.assign(canvas, {own, color, under: canvas.color === color ? canvas.under : getComputedStyle(canvas.closest("figure")).backgroundColor});
  const chart = Chart.getChart(canvas), isLine = own.kind === "line"; // else both axes have one scale
  canvas.datasets = datasets;
  const ends = key => {
    let [low, high] = [Infinity, -Infinity];
    for (const set of datasets) for (const v of set[key]) if (v !== null) [low, high] = [v < low ? v : low, v > high ? v : high];
    return [low, high];
  };
  const half = .53 * Math.max(...["x", "y"].map(ends).map(([low, high]) => high - low), 1e-9);
  const axis = (key, bounds, stepSize, [low, high] = ends(key)) => ({
    type: "linear", bounds, display: isLine || own.kind === "polar", grid: {color: "#8883"}, border: {color: "#8886"},
    reverse: own[`${key}_reversed`],
    ...isLine || {min: (low + high) / 2 - half, max: (low + high) / 2 + half},
    title: {display: own[`${key}_title`] !== "", text: own[`${key}_title`], color},
    ticks: {color, stepSize, maxTicksLimit: 8, includeBounds: false, callback: v => printed(v)},
  });
  const onZoomComplete = () => { canvas.closest("figure").classList.add("zoomed"); state.follow(); };
  const options = {
    // Data that are not parsed are taken for sorted by x, which the volume is not.
    animation: false, parsing: isLine && !own.x_is_angle, locale: "ru", maintainAspectRatio: false, onResize: () => requestAnimationFrame(() => state.follow()),
    events: ["mousemove", "mouseout"],
    interaction: {mode: "nearest", axis: own.x_is_angle ? "x" : "xy", intersect: false},
    elements: {point: {radius: 0, hitRadius: 8}, line: {borderWidth: 2}},
    datasets: {scatter: {showLine: true}},
    plugins: {
      legend: {display: false}, tooltip: {enabled: false, external: context => tip(canvas.parentElement.querySelector(".tip"), context)},
      zoom: {limits: {x: {min: "original", max: "original"}, y: {min: "original", max: "original"}},
        zoom: {mode: isLine ? "x" : "xy", wheel: {enabled: true, modifierKey: "ctrl"}, pinch: {enabled: true}, onZoomComplete}},
    },
    scales: {x: own.x_is_angle ? {...axis("x", "data", 60), afterBuildTicks: roundAngles} : axis("x"), y: axis("y")},
  };
  Chart.defaults.font.family = "Inter Variable, sans-serif";
  const isAlike = chart?.data.datasets.length === datasets.length && chart.canvas.kind === own.id
    && datasets.every((set, i) => ["label", "borderColor"].every(each => set[each] === chart.data.datasets[i][each]));
  canvas.kind = own.id;
  if (!chart) new Chart(canvas, {type: "scatter", data: {datasets}, options});
  else if (isAlike) { // new numbers alone: the rest of a chart takes longer than they
    chart.data.datasets.forEach((set, i) => Object.assign(set, datasets[i]));
    if (!isLine) for (const key of ["x", "y"]) for (const end of ["min", "max"]) chart.options.scales[key][end] = options.scales[key][end];
    chart.update("none");
  } else Object.assign(chart, {data: {datasets}, options});
  if (!isAlike) show(canvas, own);
  for (const old of Object.values(Chart.instances)) if (!old.canvas.isConnected) old.destroy();
}

function show(canvas, own) {
  const chart = Chart.getChart(canvas);
  chart.data.datasets.forEach((curve, i) => chart.setDatasetVisibility(i, !hidden.has(key(own, curve))));
  chart.update("none");
}

function whole(figure) {
  Chart.getChart(figure.querySelector("canvas")).resetZoom("none");
  figure.classList.remove("zoomed");
  state.follow();
}

// A finger or a pointer that is drawn over a chart turns the engine.
function drag(event, own) {
  if (event.type === "pointerdown") event.currentTarget.setPointerCapture(event.pointerId);
  else if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
  if (!event.isPrimary || event.button > 0 || !isThere) return;
  const canvas = event.currentTarget.querySelector("canvas"), {scales} = Chart.getChart(canvas), box = canvas.getBoundingClientRect();
  const [x, y] = [scales.x.getValueForPixel(event.clientX - box.left), scales.y.getValueForPixel(event.clientY - box.top)];
  if (own.x_is_angle) return state.turn(Math.min(Math.max(x, 0), state.last.moves.phi.at(-1)));
  if (!own.path) return;
  const far = own.path.x.map((px, i) => Math.hypot(px - x, own.path.y[i] - y));
  state.turn(own.path.phi[far.indexOf(Math.min(...far))]);
}

// A title with the symbols of its curves as symbols.
const titled = ({title, curves}) => symbol(curves.reduce((text, {name}) => text.replace(name.replace("_", ""), name), title));

// A chart whose curves are called by their names; below it their values at φ, by which they are switched.
export const figure = (own, other, isPrinted) => memo(`chart ${own.id}`, [own, other, dark.matches, isPrinted, state.switched], () => {
  const colours = inks(), curves = curvesOf(own, other, colours), {color} = getComputedStyle(document.body);
  const shown = curve => !hidden.has(key(own, curve)), onPointer = event => drag(event, own);
  const toggle = curve => event => {
    hidden[shown(curve) ? "add" : "delete"](key(own, curve));
    show(event.currentTarget.closest("figure").querySelector("canvas"), own);
    state.redraw();
  };
  return html`
    <figure key=${own.id} id=${`chart-${own.id}`}>
      <figcaption><span>${titled(own)}</span>
        <span class="tools"><button class="whole" onClick=${e => whole(e.currentTarget.closest("figure"))}>Весь график</button>
        <button aria-label=${`${own.title}: на весь экран`} title="на весь экран"
          onClick=${e => document.fullscreenElement ? document.exitFullscreen() : e.currentTarget.closest("figure").requestFullscreen()}>
          <svg viewBox="0 0 16 16" aria-hidden="true"><path d="M1 6V1h5M10 1h5v5M15 10v5h-5M6 15H1v-5" /></svg></button></span></figcaption>
      <div class="plot" style=${`aspect-ratio: ${own.kind === "line" ? 1.6 : 1}`} title="потяните: угол φ; Ctrl и колесо, два пальца: масштаб"
        onPointerDown=${onPointer} onPointerMove=${onPointer}>
        <canvas ref=${canvas => canvas && (isThere ? draw : drawLater)(canvas, own, curves, color)} role="img" aria-label=${own.title} />
        <i class="cursor" /><span>${curves.map(({borderColor}) => html`<i class="dot" style=${`--ink: ${borderColor}`} />`)}</span>
        <div class="tip" hidden /></div>
      <ul class="legend" hidden=${curves.length < 2 && !own.x_is_angle}>${curves.map(curve => html`
        <li><button aria-pressed=${String(shown(curve))} style=${`--ink: ${curve.borderColor}`}
          onClick=${toggle(curve)}><span>${symbol(curve.label)}</span> <output aria-live="off" /></button></li>`)}</ul>
    </figure>`;
});

const put = (node, x, y) => { node.style.transform = `translate(${x}px, ${y}px)`; };

// The cursor of a chart: a line at φ with a point on each curve, or a point of the path.
export function follow(node, own, phi, isTold) {
  const canvas = node.querySelector("canvas"), chart = canvas && isThere && Chart.getChart(canvas);
  if (!chart) return;
  const {chartArea: area, scales: {x, y}} = chart, line = node.querySelector(".cursor");
  const dots = node.querySelectorAll(".dot"), values = node.querySelectorAll("output");
  const left = x.getPixelForValue(phi), isIn = px => px >= area.left - 1 && px <= area.right + 1;
  line.hidden = !own.x_is_angle || !isIn(left);
  line.style.height = `${area.height}px`;
  put(line, left, area.top);
  chart.data.datasets.forEach((curve, i) => {
    const value = own.x_is_angle ? between(curve.x, curve.y, phi) : null;
    if (isTold) values[i].textContent = printed(value, 5);
    dots[i].hidden = value === null || !isIn(left) || !chart.isDatasetVisible(i);
    if (!dots[i].hidden) put(dots[i], left, y.getPixelForValue(value));
  });
  if (!own.path || !dots.length) return;
  const at = phi % own.path.phi.at(-1) || phi, place = key => between(own.path.phi, own.path[key], at);
  dots[0].hidden = place("x") === null;
  put(dots[0], x.getPixelForValue(place("x") ?? 0), y.getPixelForValue(place("y") ?? 0));
}
