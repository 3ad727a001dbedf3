"use strict";
// Charts of the numbers that the server sends (ChartSpec), by Chart.js; the cursor lies above.
const DASHES = [[], [8, 3], [3, 3], [10, 3, 3, 3], [1, 3], [14, 4]];
const css = name => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

function nearest(values, wanted) {
  let best = -1;
  values.forEach((v, i) => {
    if (v !== null && (best < 0 || Math.abs(v - wanted) < Math.abs(values[best] - wanted))) best = i;
  });
  return best;
}

function between(xs, ys, x) {
  const i = Math.max(1, xs.findIndex(v => v >= x)), share = (x - xs[i - 1]) / (xs[i] - xs[i - 1] || 1);
  return ys[i - 1] + share * (ys[i] - ys[i - 1]);
}

// A figure of one chart: `show` takes new numbers (and another engine's), `at` moves the cursor.
function figure(spec) {
  const canvas = make("canvas", {role: "img", "aria-label": spec.title});
  const marks = make("div", {class: "marks"}), legend = make("ul", {class: "legend"});
  const node = make("figure", {id: `chart-${spec.id}`, class: spec.kind}, make("figcaption", {}, spec.title),
    make("div", {class: "plot"}, canvas, marks), legend);
  const axis = (title, reverse, angle) => ({
    type: "linear", reverse, display: ["line", "polar"].includes(spec.kind), grid: {color: css("faint")},
    title: {display: Boolean(title), text: title, color: css("fg")},
    ticks: {color: css("fg"), stepSize: angle ? 60 : undefined, maxTicksLimit: 8, includeBounds: false,
      callback: value => printed(value)},
  });
  let drawn = null, now = spec, phi = 0;
  drawn = new Chart(canvas, {
    type: "scatter", data: {datasets: []}, plugins: [{id: "cursor", afterDraw: place}], options: {
      animation: false, parsing: false, locale: "ru", aspectRatio: spec.kind === "line" ? 1.6 : 1,
      interaction: {mode: "nearest", axis: spec.angle ? "x" : "xy", intersect: false},
      elements: {point: {radius: 0, hitRadius: 8}, line: {borderWidth: 2}},
      plugins: {legend: {display: false}},
      scales: {x: axis(spec.x_title, spec.x_reversed, spec.angle), y: axis(spec.y_title, spec.y_reversed)},
    },
  });

  function show(own, other) {
    now = own;
    const curves = [...own.curves, ...(other?.curves || [])], count = own.curves.length;
    drawn.data.datasets = curves.map(({name, x, y}, i) => ({
      label: name + (i < count ? "" : " (второй)"), showLine: true, borderColor: css(`c${i % count % 6}`),
      borderDash: i < count ? DASHES[i % 6] : [2, 4], data: x.map((v, k) => ({x: v, y: y[k]})),
    }));
    const ends = key => {
      const all = curves.flatMap(c => c[key]).filter(v => v !== null);
      return [Math.min(...all), Math.max(...all)];
    };
    const [left, right] = ends("x"), [low, high] = ends("y"), {x, y} = drawn.options.scales;
    if (spec.kind !== "line") { // one scale for both axes
      const half = Math.max(right - left, high - low, 1e-9) * .53;
      [x.min, x.max, y.min, y.max] = [(left + right) / 2 - half, (left + right) / 2 + half,
        (low + high) / 2 - half, (low + high) / 2 + half];
    } else if (spec.angle) [x.min, x.max] = [left, right];
    legend.replaceChildren(...curves.map(({name}, i) => make("li", {},
      make("i", {style: `color:${css(`c${i % count % 6}`)}`, class: i >= count ? "other" : i ? "dashed" : ""}),
      ...symbol(name || ""), i < count ? " " : " (второй) ", make("output"))));
    marks.replaceChildren(make("i", {class: "line"}), ...curves.map((_, i) =>
      make("i", {class: "dot", style: `background:${css(`c${i % count % 6}`)}`})));
    drawn.update("none");
  }

  function place() { // the cursor and a point of each curve, over the drawing
    const [bar, ...dots] = marks.children;
    if (!bar) return;
    const {x, y} = drawn.scales;
    const spot = (mark, px, py) => { mark.style.cssText += `;display:block;left:${px}px;top:${py}px`; };
    for (const mark of marks.children) mark.style.display = "none";
    if (now.path) {
      const {phi: over, x: xs, y: ys} = now.path, i = nearest(over, phi > over.at(-1) ? phi % over.at(-1) : phi);
      spot(dots[0], x.getPixelForValue(xs[i]), y.getPixelForValue(ys[i]));
    }
    if (!now.angle || phi < x.min || phi > x.max) return;
    spot(bar, x.getPixelForValue(phi), y.top);
    bar.style.height = `${y.height}px`;
    drawn.data.datasets.forEach(({data}, k) => {
      const i = nearest(data.map(p => p.x), phi);
      legend.children[k].lastChild.textContent = printed(data[i].y, 5);
      if (data[i].y !== null) spot(dots[k], x.getPixelForValue(data[i].x), y.getPixelForValue(data[i].y));
    });
  }

  return {id: spec.id, node, show, drop: () => drawn.destroy(), at: angle => { phi = angle; place(); }};
}
