// What follows φ: charts of the numbers that the server sends (ChartSpec), by Chart.js, with a cursor;
// the mechanism of a cylinder, drawn through the solver's joints; the star of cranks.
import {html, printed, symbol} from "./common.js";

const DASHES = [[], [8, 3], [3, 3], [10, 3, 3, 3], [1, 3], [14, 4]];
// Seen on white and on black alike.
const COLOURS = ["#2f7ed8", "#d94a3d", "#2b9348", "#a05fd0", "#b0771b", "#16899a"];

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

function cursor({canvas, ctx, scales: {x, y}}) { // a line at φ and a point of each curve, or of the path
  const {own: {path}, phi, curves} = canvas.props;
  const dots = curves.filter(c => c.at !== null).map(c => [phi, c.at, c.borderColor]);
  ctx.fillStyle = "#888";
  if (dots.length) ctx.fillRect(x.getPixelForValue(phi), y.top, 1, y.height);
  const place = key => between(path.phi, path[key], phi % path.phi.at(-1) || phi);
  if (path) dots.push([place("x"), place("y"), COLOURS[0]]);
  for (const [px, py, colour] of dots) {
    ctx.fillStyle = colour;
    Chart.helpers.drawPoint(ctx, {radius: 4}, x.getPixelForValue(px), y.getPixelForValue(py));
  }
}

function draw(canvas, props) {
  const before = canvas.props, chart = Chart.getChart(canvas), {own, curves: datasets, color} = props;
  canvas.props = props;
  if (before && ["own", "other", "color"].every(key => before[key] === props[key])) return chart.draw();
  const isLine = own.kind === "line"; // else both axes have one scale
  const ends = key => [Math.min, Math.max].map(end => end(...datasets.flatMap(c => c[key])));
  const half = .53 * Math.max(...["x", "y"].map(ends).map(([low, high]) => high - low), 1e-9);
  const axis = (key, bounds, stepSize, [low, high] = ends(key)) => ({
    type: "linear", bounds, display: isLine || own.kind === "polar", grid: {color: "#8884"},
    reverse: own[`${key}_reversed`],
    ...isLine || {min: (low + high) / 2 - half, max: (low + high) / 2 + half},
    title: {display: own[`${key}_title`] !== "", text: own[`${key}_title`], color},
    ticks: {color, stepSize, maxTicksLimit: 8, includeBounds: false, callback: v => printed(v)},
  });
  const options = {
    animation: false, locale: "ru", maintainAspectRatio: false,
    interaction: {mode: "nearest", axis: own.x_is_angle ? "x" : "xy", intersect: false},
    elements: {point: {radius: 0, hitRadius: 8}, line: {borderWidth: 2}},
    datasets: {scatter: {showLine: true}}, plugins: {legend: {display: false}},
    scales: {x: own.x_is_angle ? axis("x", "data", 60) : axis("x"), y: axis("y")},
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

const upright = ([x, y], turned, size, text) => html`
  <text transform=${`translate(${x} ${y}) rotate(${-turned})`} font-size=${size}>${text}</text>`;

export function mechanism(moves, phi) {
  const {radius, bore, wall, axis, joints, turn, shift} = moves, half = bore / 2, left = wall - half;
  const inside = ((phi - shift) % 360 + 360) % 360;
  const points = [[0, 0], ...joints.map(([x, y]) => [between(turn, x, inside), -between(turn, y, inside)])];
  // All that moves, with the names of forces above the piston and below the crank.
  const top = Math.max(...joints.at(-1)[1]) + 1.3 * bore;
  const down = Math.max(...moves.forces.K_MPa.values.map(k => -k)) / greatest(moves);
  const size = top + Math.max(1.4 * radius, radius + bore * (down + .3));
  return html`
    <svg id="mechanism" role="img" aria-label="Механизм цилиндра и силы"
      viewBox=${[-size / 2, -top, size, size].join(" ")}>
      <g transform=${`rotate(${axis} 0 ${size / 2 - top})`}>
        <circle class="axis" r=${radius} />
        <path class="axis" d=${`M${left} ${-1.2 * radius}V${-top}m${bore} 0V${-1.2 * radius}`} />
        <rect class="body" x=${left} y=${points.at(-1)[1] - half * .8} width=${bore} height=${half * 1.3} />
        <polyline class="rod" points=${points.join(" ")} />
        ${points.map(([x, y]) => html`<circle class="body" cx=${x} cy=${y} r=${radius / 9} />`)}
        ${arrows(moves, phi, points[1], points.at(-1), inside)}
      </g>
    </svg>`;
}

const greatest = ({forces}) => Math.max(...Object.values(forces).flatMap(f => f.values.map(Math.abs)), 1e-9);

function arrows(moves, phi, pin, piston, turn) {
  const {forces, phi: over, axis, bore} = moves, most = greatest(moves);
  const drawn = [["Ps_MPa", "PΣ", 0, piston, 90], ["N_MPa", "N", 4, piston, 180],
    ["T_MPa", "T", 1, pin, turn], ["K_MPa", "K", 2, pin, turn + 90]];
  return drawn.map(([key, name, colour, place, along]) => {
    const far = bore * between(over, forces[key].values, phi) / most, ink = COLOURS[colour];
    return Math.abs(far) > bore / 40 && html`<g transform=${`translate(${place}) rotate(${along})`}>
      <path d=${`M0 0h${far}`} stroke=${ink} stroke-width="3" />
      <circle cx=${far} r=${bore / 28} fill=${ink} />
      ${upright([far + Math.sign(far) * bore / 6, 0], axis + along, bore / 5, name)}</g>`;
  });
}

export const star = ({throws}, phi) => html`
  <svg id="star" role="img" aria-label="Звезда кривошипов" viewBox="-130 -130 260 260">
    <circle class="axis" r="85" />
    ${throws.map(([angle, numbers]) => html`<g transform=${`rotate(${angle + phi})`}>
      <path class="rod" d="M0 0V-85" /><circle class="body" cy="-85" r="6" />
      ${upright([0, -108], angle + phi, 14, numbers.join(", "))}</g>`)}
  </svg>`;
