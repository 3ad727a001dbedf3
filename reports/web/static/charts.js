"use strict";
// Charts of the numbers that the server sends, by the one description of charts (ChartSpec).
const WIDTH = 480, HEIGHT = 300, DASHES = ["", "8 3", "3 3", "10 3 3 3", "1 3", "14 4"];

function limits(columns, zero) {
  const all = columns.flat().filter(v => v !== null);
  let low = Math.min(...all, zero ? 0 : Infinity), high = Math.max(...all, zero ? 0 : -Infinity);
  if (!Number.isFinite(low)) [low, high] = [0, 1];
  if (high - low < 1e-12 * Math.max(1, Math.abs(high))) { low -= .5; high += .5; }
  return [low, high];
}

function ticks(low, high, count, angle) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = angle && high > 90 ? [30, 60, 90, 120, 180].find(s => s >= rough) || 360
    : power * [1, 2, 5, 10].find(s => s * power >= rough);
  const out = [];
  for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + step * 1e-9; v += step) out.push(+v.toPrecision(12));
  return out;
}

// The second engine's curves are dashed; `at` moves the cursor.
function chart(spec, other) {
  const square = spec.kind !== "line", high = square ? WIDTH : HEIGHT;
  const curves = [...spec.curves.map(c => ({...c, own: true})), ...(other ? other.curves : [])];
  let xs = limits(curves.map(c => c.x), square && spec.kind !== "scheme"), ys = limits(curves.map(c => c.y), true);
  const box = {left: 62, right: WIDTH - 10, top: 22, bottom: high - 34};
  if (square) {
    const half = Math.max(xs[1] - xs[0], ys[1] - ys[0]) / 2 * 1.03;
    [xs, ys] = [xs, ys].map(([a, b]) => [(a + b) / 2 - half, (a + b) / 2 + half]);
    box.bottom = box.top + (box.right - box.left); box.high = box.bottom + 34;
  }
  const X = v => box.left + (spec.x_reversed ? xs[1] - v : v - xs[0]) / (xs[1] - xs[0]) * (box.right - box.left);
  const Y = v => box.bottom - (spec.y_reversed ? ys[1] - v : v - ys[0]) / (ys[1] - ys[0]) * (box.bottom - box.top);
  const svg = draw("svg", {viewBox: `0 0 ${WIDTH} ${box.high || high}`, role: "img", "aria-label": spec.title});
  if (spec.kind === "line" || spec.kind === "polar") {
    for (const v of ticks(...xs, 7, spec.angle)) {
      svg.append(draw("line", {x1: X(v), x2: X(v), y1: box.top, y2: box.bottom, class: "grid"}),
        draw("text", {x: X(v), y: box.bottom + 14, "text-anchor": "middle"}, printed(v)));
    }
    for (const v of ticks(...ys, 6)) {
      svg.append(draw("line", {x1: box.left, x2: box.right, y1: Y(v), y2: Y(v), class: "grid"}),
        draw("text", {x: box.left - 5, y: Y(v) + 4, "text-anchor": "end"}, printed(v)));
    }
    if (ys[0] <= 0 && ys[1] >= 0) svg.append(draw("line", {x1: box.left, x2: box.right, y1: Y(0), y2: Y(0), class: "axis"}));
    svg.append(draw("text", {x: box.right, y: box.bottom + 30, "text-anchor": "end"}, spec.x_title),
      draw("text", {x: 4, y: 12}, spec.y_title));
  }
  const legend = make("ul", {class: "legend"}), marks = [];
  curves.forEach((curve, index) => {
    const number = curve.own ? index : index - spec.curves.length;
    let path = "", pen = "M";
    curve.x.forEach((x, i) => {
      if (x === null || curve.y[i] === null) { pen = "M"; return; }
      path += `${pen}${X(x).toFixed(2)} ${Y(curve.y[i]).toFixed(2)}`; pen = "L";
    });
    const colour = `var(--c${number % 6})`;
    svg.append(draw("path", {d: path, fill: "none", stroke: colour, "stroke-width": curve.own ? 2 : 1.5,
      "stroke-dasharray": curve.own ? DASHES[number % 6] : "2 4"}));
    const value = make("output");
    const item = make("li", {}, make("i", {style: `border-color:${colour};border-top-style:${curve.own ? "solid" : "dotted"}`}),
      ...symbol(curve.name || ""), curve.own ? "" : " (второй)", " ", value);
    if (spec.curves.length > 1 || other || spec.angle) legend.append(item);
    const dot = draw("circle", {r: 4, fill: colour, visibility: "hidden"});
    svg.append(dot);
    marks.push({curve, dot, value});
  });
  const cursor = draw("line", {y1: box.top, y2: box.bottom, class: "cursor", visibility: "hidden"});
  if (spec.angle) svg.append(cursor);
  const figure = make("figure", {id: `chart-${spec.id}`}, make("figcaption", {}, spec.title), svg, legend);
  const at = (phi, phis) => {
    if (spec.angle && phi >= xs[0] && phi <= xs[1]) {
      cursor.setAttribute("x1", X(phi)); cursor.setAttribute("x2", X(phi)); cursor.setAttribute("visibility", "visible");
    }
    for (const {curve, dot, value} of marks) {
      const i = spec.angle ? nearest(curve.x, phi) : spec.kind === "polar" && curve.x.length === phis.length ? nearest(phis, phi) : -1;
      if (i < 0 || curve.y[i] === null) continue;
      dot.setAttribute("cx", X(curve.x[i])); dot.setAttribute("cy", Y(curve.y[i])); dot.setAttribute("visibility", "visible");
      if (spec.angle) value.textContent = printed(curve.y[i], 5);
    }
  };
  return {figure, at};
}

function nearest(values, wanted) {
  let best = -1;
  values.forEach((v, i) => { if (v !== null && (best < 0 || Math.abs(v - wanted) < Math.abs(values[best] - wanted))) best = i; });
  return best;
}
function between(xs, ys, x) {
  const i = Math.max(1, xs.findIndex(v => v >= x)), share = (x - xs[i - 1]) / (xs[i] - xs[i - 1] || 1);
  return ys[i - 1] + share * (ys[i] - ys[i - 1]);
}

// The piston stands where the solver's s says, the rod leans by its β.
function mechanism(svg, moves, phi) {
  const {radius: r, rod: l} = moves, turn = phi * Math.PI / 180, scale = 210 / (2 * r + l + 1.6 * r);
  const [x0, y0] = [120, 285 - r * scale * 1.15];
  const pin = [x0 + r * scale * Math.sin(turn), y0 - r * scale * Math.cos(turn)];
  const inside = phi % moves.turn.at(-1);
  const beta = between(moves.turn, moves.beta, inside), s = between(moves.turn, moves.s, inside);
  const piston = [pin[0] - l * scale * Math.sin(beta), y0 - (r + l - s) * scale], wide = r * scale * .95;
  svg.setAttribute("viewBox", "0 0 240 300");
  svg.replaceChildren(
    draw("circle", {cx: x0, cy: y0, r: r * scale, class: "axis", "stroke-dasharray": "3 4"}),
    draw("line", {x1: piston[0] - wide, x2: piston[0] - wide, y1: 8, y2: y0 - r * scale * 1.2, class: "axis"}),
    draw("line", {x1: piston[0] + wide, x2: piston[0] + wide, y1: 8, y2: y0 - r * scale * 1.2, class: "axis"}),
    draw("rect", {x: piston[0] - wide, y: piston[1] - wide * .7, width: 2 * wide, height: wide * 1.3, rx: 4, class: "body"}),
    draw("line", {x1: piston[0], y1: piston[1], x2: pin[0], y2: pin[1], class: "rod"}),
    draw("line", {x1: x0, y1: y0, x2: pin[0], y2: pin[1], class: "rod"}),
    ...[[x0, y0], piston, pin].map(([cx, cy]) => draw("circle", {cx, cy, r: 5, class: "body"})),
    ...arrows(moves, phi, piston, pin, turn));
}

function arrows(moves, phi, piston, pin, turn) {
  const all = Object.values(moves.forces).flatMap(f => f.values.map(Math.abs)), most = Math.max(...all, 1e-9);
  const force = name => moves.forces[name] ? between(moves.phi, moves.forces[name].values, phi) : 0;
  const arrow = ([x, y], dx, dy, value, name, colour) => {
    const k = 75 * value / most, [x2, y2] = [x + dx * k, y + dy * k];
    if (Math.abs(k) < 2) return [];
    return [draw("line", {x1: x, y1: y, x2, y2, stroke: colour, "stroke-width": 3}),
      draw("circle", {cx: x2, cy: y2, r: 4, fill: colour}), draw("text", {x: x2 + 6, y: y2 + 4}, name)];
  };
  return [...arrow(piston, 0, 1, force("Ps_MPa"), "PΣ", "var(--c0)"), ...arrow(piston, 1, 0, -force("N_MPa"), "N", "var(--c4)"),
    ...arrow(pin, Math.cos(turn), Math.sin(turn), force("T_MPa"), "T", "var(--c1)"),
    ...arrow(pin, -Math.sin(turn), Math.cos(turn), force("K_MPa"), "K", "var(--c2)")];
}

function star(svg, moves, phi) {
  svg.setAttribute("viewBox", "0 0 240 300");
  svg.replaceChildren(draw("circle", {cx: 120, cy: 150, r: 85, class: "axis"}));
  const groups = new Map();
  moves.throws.forEach((angle, i) => {
    const key = Math.round(((angle % 360) + 360) % 360 * 100) / 100;
    groups.set(key, [...(groups.get(key) || []), i + 1]);
  });
  for (const [angle, numbers] of groups) {
    const turn = (angle + phi) * Math.PI / 180, [dx, dy] = [Math.sin(turn), -Math.cos(turn)];
    svg.append(draw("line", {x1: 120, y1: 150, x2: 120 + 85 * dx, y2: 150 + 85 * dy, class: "rod"}),
      draw("circle", {cx: 120 + 85 * dx, cy: 150 + 85 * dy, r: 6, class: "body"}),
      draw("text", {x: 120 + 105 * dx, y: 154 + 105 * dy, "text-anchor": "middle"}, numbers.join(", ")));
  }
}
