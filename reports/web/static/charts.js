// Charts of the numbers that the server sends (ChartSpec), by Chart.js, with a cursor at φ.
import {html, printed, symbol} from "./common.js";

const DASHES = [[], [8, 3], [3, 3], [10, 3, 3, 3], [1, 3], [14, 4]];
// Seen on white and on black alike.
export const COLOURS = ["#2f7ed8", "#d94a3d", "#2b9348", "#a05fd0", "#b0771b", "#16899a"];

export function between(xs, ys, x) {
  const i = Math.max(1, xs.findIndex(v => v >= x)), share = (x - xs[i - 1]) / (xs[i] - xs[i - 1] || 1);
  return ys[i] === null ? null : ys[i - 1] + share * (ys[i] - ys[i - 1]);
}

// Curves of a chart, then those of the other engine; each with its value at φ.
const curvesOf = ({own, other, phi}) => [own, other].filter(Boolean).flatMap((chart, second) =>
  chart.curves.map((curve, i) => ({
    ...curve, data: curve.data ??= curve.x.map((x, k) => ({x, y: curve.y[k]})),
    label: second ? `${curve.name} (второй)` : curve.name, colour: COLOURS[i % 6],
    dash: second ? [2, 4] : DASHES[i % 6], line: second ? "dotted" : i ? "dashed" : "solid",
    at: chart.x_is_angle && phi >= curve.x[0] && phi <= curve.x.at(-1) ? between(curve.x, curve.y, phi) : null,
  })));

const around = (low, high, half) => ({min: (low + high) / 2 - half, max: (low + high) / 2 + half});

function limits({kind, x_is_angle}, curves) { // of the axes: all of φ, or one scale for both
  const [left, right, low, high] = ["x", "y"].flatMap(key => {
    const all = curves.flatMap(c => c[key]).filter(v => v !== null);
    return [Math.min(...all), Math.max(...all)];
  });
  if (x_is_angle) return [{min: left, max: right}, {}];
  const half = Math.max(right - left, high - low, 1e-9) * .53;
  return kind === "line" ? [{}, {}] : [around(left, right, half), around(low, high, half)];
}

function cursor({canvas, ctx, scales: {x, y}}) { // a line at φ and a point of each curve, or of the path
  const {own: {path}, phi} = canvas.props, here = curvesOf(canvas.props).filter(c => c.at !== null);
  const dots = here.map(c => [phi, c.at, c.colour]);
  ctx.fillStyle = "#888";
  if (here.length) ctx.fillRect(x.getPixelForValue(phi), y.top, 1, y.height);
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
  const before = canvas.props, chart = Chart.getChart(canvas);
  canvas.props = props;
  if (before && ["own", "other", "theme"].every(key => before[key] === props[key])) return chart.draw();
  const {own} = props, curves = curvesOf(props), {color} = getComputedStyle(document.body);
  const [x, y] = limits(own, curves), plain = own.kind === "line";
  const axis = (text, reverse, stepSize, ends) => ({
    type: "linear", reverse, display: plain || own.kind === "polar", grid: {color: "#8884"}, ...ends,
    title: {display: Boolean(text), text, color},
    ticks: {color, stepSize, maxTicksLimit: 8, includeBounds: false, callback: v => printed(v)},
  });
  const options = {
    animation: false, locale: "ru", maintainAspectRatio: false,
    interaction: {mode: "nearest", axis: own.x_is_angle ? "x" : "xy", intersect: false},
    elements: {point: {radius: 0, hitRadius: 8}, line: {borderWidth: 2}},
    plugins: {legend: {display: false}},
    scales: {
      x: axis(own.x_title, own.x_reversed, own.x_is_angle ? 60 : undefined, x),
      y: axis(own.y_title, own.y_reversed, undefined, y),
    },
  };
  const data = {datasets: curves.map(({label, data, colour, dash}) =>
    ({label, data, showLine: true, borderColor: colour, borderDash: dash}))};
  if (!chart) new Chart(canvas, {type: "scatter", data, options, plugins: [{id: "cursor", afterDraw: cursor}]});
  else Object.assign(chart, {data, options}).update("none");
  for (const old of Object.values(Chart.instances)) if (!old.canvas.isConnected) old.destroy();
}

// A chart with its legend, which says the values at φ.
export const figure = props => html`
  <figure key=${props.own.id} id=${`chart-${props.own.id}`}>
    <figcaption>${props.own.title}</figcaption>
    <div class="plot" style=${`aspect-ratio: ${props.own.kind === "line" ? 1.6 : 1}`}>
      <canvas ref=${canvas => canvas && draw(canvas, props)} role="img" aria-label=${props.own.title} /></div>
    <ul class="legend">${curvesOf(props).map(({label, colour, line, at}) => html`
      <li style=${`--ink: ${line} ${colour}`}>${symbol(label)} <output>${printed(at, 5)}</output></li>`)}</ul>
  </figure>`;
