// Charts of the numbers that the server sends (ChartSpec), by Chart.js, with a cursor at φ.
import {Component, createRef} from "./vendor/preact.mjs";
import {html, printed, symbol} from "./common.js";

const DASHES = [[], [8, 3], [3, 3], [10, 3, 3, 3], [1, 3], [14, 4]];
const css = name => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

export function between(xs, ys, x) {
  const i = Math.max(1, xs.findIndex(v => v >= x)), share = (x - xs[i - 1]) / (xs[i] - xs[i - 1] || 1);
  return ys[i - 1] + share * (ys[i] - ys[i - 1]);
}

function nearest(values, wanted) {
  let best = 0;
  values.forEach((v, i) => { if (Math.abs(v - wanted) < Math.abs(values[best] - wanted)) best = i; });
  return best;
}

// Curves of a chart, then those of the other engine; each with its place at φ.
const curvesOf = ({own, other, phi}) => [own, other].filter(Boolean).flatMap((chart, second) =>
  chart.curves.map(({name, x, y}, i) => ({
    name, x, y, second, colour: `c${i % 6}`, dash: second ? [2, 4] : DASHES[i % 6],
    at: chart.x_is_angle && phi >= x[0] && phi <= x.at(-1) ? nearest(x, phi) : null,
  })));

class Plot extends Component {
  canvas = createRef();

  componentDidMount() {
    const {own} = this.props, angle = own.kind === "line", shown = angle || own.kind === "polar";
    const axis = (text, reverse, stepSize) => ({
      type: "linear", reverse, display: shown, grid: {color: css("faint")},
      title: {display: Boolean(text), text, color: css("fg")},
      ticks: {color: css("fg"), stepSize, maxTicksLimit: 8, includeBounds: false, callback: v => printed(v)},
    });
    this.chart = new Chart(this.canvas.current, {
      type: "scatter", data: {datasets: []}, plugins: [{id: "cursor", afterDraw: chart => this.cursor(chart)}],
      options: {
        animation: false, locale: "ru", aspectRatio: angle ? 1.6 : 1,
        interaction: {mode: "nearest", axis: own.x_is_angle ? "x" : "xy", intersect: false},
        elements: {point: {radius: 0, hitRadius: 8}, line: {borderWidth: 2}},
        plugins: {legend: {display: false}},
        scales: {
          x: axis(own.x_title, own.x_reversed, own.x_is_angle ? 60 : undefined),
          y: axis(own.y_title, own.y_reversed),
        },
      },
    });
    this.show();
  }

  componentDidUpdate({own, other}) {
    if (own !== this.props.own || other !== this.props.other) this.show();
    else this.chart.draw();
  }

  componentWillUnmount() { this.chart.destroy(); }

  show() {
    const {own} = this.props, curves = curvesOf(this.props), {x, y} = this.chart.options.scales;
    this.chart.data.datasets = curves.map(c => ({
      label: c.name + (c.second ? " (второй)" : ""), showLine: true, borderColor: css(c.colour), borderDash: c.dash,
      data: c.x.map((v, i) => ({x: v, y: c.y[i]})),
    }));
    const ends = key => {
      const all = curves.flatMap(c => c[key]).filter(v => v !== null);
      return [Math.min(...all), Math.max(...all)];
    };
    const [left, right] = ends("x"), [low, high] = ends("y");
    const half = Math.max(right - left, high - low, 1e-9) * .53;
    if (own.x_is_angle) Object.assign(x, {min: left, max: right});
    else if (own.kind !== "line") { // one scale for both axes
      Object.assign(x, {min: (left + right) / 2 - half, max: (left + right) / 2 + half});
      Object.assign(y, {min: (low + high) / 2 - half, max: (low + high) / 2 + half});
    }
    this.chart.update("none");
  }

  cursor({ctx, scales: {x, y}}) { // a line at φ and a point of each curve, or of the path
    const {own: {path}, phi} = this.props;
    const dot = (px, py, colour) => {
      ctx.fillStyle = css(colour);
      ctx.beginPath();
      ctx.arc(x.getPixelForValue(px), y.getPixelForValue(py), 4, 0, 7);
      ctx.fill();
    };
    const last = path?.phi.at(-1), i = path && nearest(path.phi, phi > last ? phi % last : phi);
    if (path) dot(path.x[i], path.y[i], "c0");
    const here = curvesOf(this.props).filter(c => c.at !== null);
    if (here.length) {
      ctx.fillStyle = css("fg");
      ctx.fillRect(x.getPixelForValue(phi), y.top, 1, y.height);
    }
    for (const c of here) if (c.y[c.at] !== null) dot(c.x[c.at], c.y[c.at], c.colour);
  }

  render({own}) { return html`<canvas ref=${this.canvas} role="img" aria-label=${own.title} />`; }
}

// A chart with its legend, which says the values at φ.
export const figure = props => html`
  <figure key=${`${props.own.id} ${props.theme}`} id=${`chart-${props.own.id}`} class=${props.own.kind}>
    <figcaption>${props.own.title}</figcaption>
    <div class="plot"><${Plot} ...${props} /></div>
    <ul class="legend">${curvesOf(props).map(({name, second, colour, at, y}, i) => html`<li>
      <i style=${`color: var(--${colour})`} class=${second ? "other" : i ? "dashed" : ""} />
      ${symbol(name)}${second ? " (второй) " : " "}<output>${at === null ? "" : printed(y[at], 5)}</output>
    </li>`)}</ul>
  </figure>`;
