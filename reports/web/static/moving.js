"use strict";
// The mechanism of a cylinder at φ, drawn through the solver's joints, and the star of cranks.
const rad = degrees => degrees * Math.PI / 180;
const ARROWS = [["Ps_MPa", "PΣ", "c0"], ["N_MPa", "N", "c4"], ["T_MPa", "T", "c1"], ["K_MPa", "K", "c2"]];

function mechanism(svg, moves, phi) {
  const {radius: r, bore, wall, axis, joints, turn} = moves;
  const own = (phi - moves.shift) % moves.phi.at(-1), inside = ((own % 360) + 360) % 360;
  const [pin, ...others] = joints.map(([x, y]) => [between(turn, x, inside), -between(turn, y, inside)]);
  const piston = others.at(-1), top = Math.max(...joints.at(-1)[1]) + bore, half = bore / 2;
  const line = ([x1, y1], [x2, y2], name) => draw("line", {x1, y1, x2, y2, class: name});
  const side = x => line([wall + x, -r * 1.2], [wall + x, -top], "axis");
  svg.replaceChildren(draw("g", {transform: `rotate(${axis})`},
    draw("circle", {r, class: "axis"}), side(-half), side(half),
    draw("rect", {x: wall - half, y: piston[1] - half * .8, width: bore, height: half * 1.3, rx: r / 12, class: "body"}),
    ...[[0, 0], pin, ...others].slice(1).map((point, i) => line([[0, 0], pin, ...others][i], point, "rod")),
    ...[[0, 0], pin, ...others].map(([cx, cy]) => draw("circle", {cx, cy, r: r / 9, class: "body"})),
    ...arrows(moves, phi, pin, piston, rad(inside), bore)));
  // As large as all that moves, turned to where the cylinder stands.
  const corners = [[-half - r / 3, -top], [half + r / 3, -top], [-1.4 * r, 1.4 * r], [1.4 * r, 1.4 * r], [-1.4 * r, -r], [1.4 * r, -r]];
  const turned = corners.map(([x, y]) => [x * Math.cos(rad(axis)) - y * Math.sin(rad(axis)),
    x * Math.sin(rad(axis)) + y * Math.cos(rad(axis))]);
  const [xs, ys] = [0, 1].map(k => turned.map(point => point[k]));
  const [left, up] = [Math.min(...xs), Math.min(...ys)];
  svg.setAttribute("viewBox", [left, up, Math.max(...xs) - left, Math.max(...ys) - up].join(" "));
}

function arrows(moves, phi, pin, piston, turn, bore) {
  const most = Math.max(...Object.values(moves.forces).flatMap(f => f.values.map(Math.abs)), 1e-9);
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const ways = [[piston, 0, 1], [piston, -1, 0], [pin, cos, sin], [pin, -sin, cos]];
  return ARROWS.flatMap(([key, name, colour], i) => {
    const [[x, y], dx, dy] = ways[i], k = bore * between(moves.phi, moves.forces[key].values, phi) / most;
    if (Math.abs(k) < bore / 40) return [];
    const [x2, y2] = [x + dx * k, y + dy * k], at = {x: x2 + bore / 16, y: y2};
    return [draw("line", {x1: x, y1: y, x2, y2, class: "force", stroke: `var(--${colour})`}),
      draw("circle", {cx: x2, cy: y2, r: bore / 28, fill: `var(--${colour})`}),
      draw("text", {...at, "font-size": bore / 5, transform: `rotate(${-moves.axis} ${at.x} ${at.y})`}, name)];
  });
}

function star(svg, moves, phi) {
  const groups = new Map();
  moves.throws.forEach((angle, i) => {
    const key = Math.round(((angle % 360) + 360) % 360 * 100) / 100;
    groups.set(key, [...(groups.get(key) || []), i + 1]);
  });
  svg.setAttribute("viewBox", "-130 -130 260 260");
  svg.replaceChildren(draw("circle", {r: 85, class: "axis"}), ...[...groups].flatMap(([angle, numbers]) => {
    const [x, y] = [Math.sin(rad(angle + phi)), -Math.cos(rad(angle + phi))];
    return [draw("line", {x1: 0, y1: 0, x2: 85 * x, y2: 85 * y, class: "rod"}),
      draw("circle", {cx: 85 * x, cy: 85 * y, r: 6, class: "body"}),
      draw("text", {x: 108 * x, y: 108 * y + 5, "font-size": 14, "text-anchor": "middle"}, numbers.join(", "))];
  }));
}
