// Charts of the numbers that the server sends (ChartSpec), by Chart.js, with a cursor at φ.
import {html, printed, symbol} from "./common.js";

const DASHES = [[], [8, 3], [3, 3], [10, 3, 3, 3], [1, 3], [14, 4]];
// Seen on white and on black alike.
export const COLOURS = ["#2f7ed8", "#d94a3d", "#2b9348", "#a05fd0", "#b0771b", "#16899a"];

export function between(xs, ys, x) { // nothing where there is no curve
  const i = Math.max(1, xs.findIndex(v => v >= x)), share = (x - xs[i - 1]) / (xs[i] - xs[i - 1] || 1);
  return share < 0 || share > 1 || ys[i] === null ? null : ys[i - 1] + share * (ys[i] - ys[i - 1]);
}

// Curves of a chart, then those of the other engine; each with its value at φ.
const curvesOf = ({own, other, phi}) => [own, other].filter(Boolean).flatMap((chart, second) =>
  chart.curves.map((curve, i) => ({
    ...curve, data: curve.data ??= curve.x.map((x, k) => ({x, y: curve.y[k]})),
    label: second ? `${curve.name} (второй)` : curve.name, borderColor: COLOURS[i % 6],
    borderDash: second ? [2, 4] : DASHES[i % 6], line: second ? "dotted" : i ? "dashed" : "solid",
    at: chart.x_is_angle ? between(curve.x, curve.y, phi) : null,
  })));

function square(curves) { // limits of both axes, which have one scale
  const ends = ["x", "y"].map(key => curves.flatMap(c => c[key])).map(all => [Math.min(...all), Math.max(...all)]);
  const half = Math.max(...ends.map(([low, high]) => high - low), 1e-9) * .53;
  return ends.map(([low, high]) => ({min: (low + high) / 2 - half, max: (low + high) / 2 + half}));
}

function cursor({canvas, ctx, scales: {x, y}}) { // a line at φ and a point of each curve, or of the path
  const {own: {path}, phi, curves} = canvas.props;
  const dots = curves.filter(c => c.at !== null).map(c => [phi, c.at, c.borderColor]);
  ctx.fillStyle = "#888";
  if (dots.length) ctx.fillRect(x.getPixelForValue(phi), y.top, 1, y.height);
  const place = key => between(path.phi, path[key], phi % path.phi.at(-1) || phi);
  if (path) dots.push([place("x"), place("y"), COLOURS[0]]);
  for (const [px, py, colour] of dots) {
    ctx.fillStyle = colour;
    ctx.beginPath();
    ctx.arc(x.getPixelForValue(px), y.getPixelForValue(py), 4, 0, 7);
    ctx.fill();
  }
}

function draw(canvas, props) {
  const before = canvas.props, chart = Chart.getChart(canvas), {own, curves: datasets, color} = props;
  canvas.props = props;
  if (before && ["own", "other", "color"].every(key => before[key] === props[key])) return chart.draw();
  const plain = own.kind === "line";
  const [x, y] = plain ? [{bounds: own.x_is_angle ? "data" : "ticks"}, {}] : square(datasets);
  const axis = (text, reverse, ends, stepSize) => ({
    type: "linear", reverse, display: plain || own.kind === "polar", grid: {color: "#8884"}, ...ends,
    title: {display: Boolean(text), text, color},
    ticks: {color, stepSize, maxTicksLimit: 8, includeBounds: false, callback: v => printed(v)},
  });
  const options = {
    animation: false, locale: "ru", maintainAspectRatio: false,
    interaction: {mode: "nearest", axis: own.x_is_angle ? "x" : "xy", intersect: false},
    elements: {point: {radius: 0, hitRadius: 8}, line: {borderWidth: 2}},
    datasets: {scatter: {showLine: true}}, plugins: {legend: {display: false}},
    scales: {
      x: axis(own.x_title, own.x_reversed, x, own.x_is_angle ? 60 : undefined),
      y: axis(own.y_title, own.y_reversed, y),
    },
  };
  if (!chart) new Chart(canvas, {type: "scatter", data: {datasets}, options, plugins: [{id: "cursor", afterDraw: cursor}]});
  else Object.assign(chart, {data: {datasets}, options}).update("none");
  for (const old of Object.values(Chart.instances)) if (!old.canvas.isConnected) old.destroy();
}

// A chart with its legend, which says the values at φ.
export function figure(given) {
  const {own} = given, curves = curvesOf(given), {color} = getComputedStyle(document.body);
  return html`
    <figure key=${own.id} id=${`chart-${own.id}`}>
      <figcaption>${own.title}</figcaption>
      <div style=${`position: relative; min-height: 0; aspect-ratio: ${own.kind === "line" ? 1.6 : 1}`}>
        <canvas ref=${canvas => canvas && draw(canvas, {...given, curves, color})} role="img" aria-label=${own.title} /></div>
      <ul class="legend">${curves.map(({label, borderColor, line, at}) => html`
        <li style=${`--ink: ${line} ${borderColor}`}>${symbol(label)} <output>${printed(at, 5)}</output></li>`)}</ul>
    </figure>`;
}
