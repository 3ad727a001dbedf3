// The mechanism of a cylinder at φ, drawn through the solver's joints, and the star of cranks.
import {COLOURS, between} from "./charts.js";
import {html} from "./common.js";

const rad = degrees => degrees * Math.PI / 180;
const ARROWS = [["Ps_MPa", "PΣ", 0], ["N_MPa", "N", 4], ["T_MPa", "T", 1], ["K_MPa", "K", 2]];
const line = ([x1, y1], [x2, y2], name, stroke) => html`<line ...${{x1, y1, x2, y2, stroke}} class=${name} />`;
const circle = ([cx, cy], r, name, fill) => html`<circle ...${{cx, cy, r, fill}} class=${name} />`;

export function mechanism(moves, phi) {
  const {radius: r, bore, wall, axis, joints, turn} = moves, half = bore / 2;
  const own = (phi - moves.shift) % moves.phi.at(-1), inside = ((own % 360) + 360) % 360;
  const points = [[0, 0], ...joints.map(([x, y]) => [between(turn, x, inside), -between(turn, y, inside)])];
  const piston = points.at(-1), top = Math.max(...joints.at(-1)[1]) + bore;
  const side = x => line([wall + x, -r * 1.2], [wall + x, -top], "axis");
  // As large as all that moves, turned to where the cylinder stands.
  const wide = half + r / 3, low = 1.4 * r, [cos, sin] = [Math.cos(rad(axis)), Math.sin(rad(axis))];
  const corners = [[-wide, -top], [wide, -top], [-low, low], [low, low], [-low, -r], [low, -r]]
    .map(([x, y]) => [x * cos - y * sin, x * sin + y * cos]);
  const [[left, right], [up, down]] = [0, 1].map(k => corners.map(c => c[k]).sort((a, b) => a - b))
    .map(sorted => [sorted[0], sorted.at(-1)]);
  return html`
    <svg id="mechanism" role="img" aria-label="Механизм цилиндра и силы"
      viewBox=${[left, up, right - left, down - up].join(" ")}>
      <g transform=${`rotate(${axis})`}>
        ${circle([0, 0], r, "axis")}${side(-half)}${side(half)}
        <rect class="body" x=${wall - half} y=${piston[1] - half * .8} width=${bore} height=${half * 1.3} />
        ${points.slice(1).map((point, i) => line(points[i], point, "rod"))}
        ${points.map(point => circle(point, r / 9, "body"))}
        ${arrows(moves, phi, points[1], piston, rad(inside))}
      </g>
    </svg>`;
}

function arrows({forces, phi: over, axis, bore}, phi, pin, piston, turn) {
  const most = Math.max(...Object.values(forces).flatMap(f => f.values.map(Math.abs)), 1e-9);
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const ways = [[piston, 0, 1], [piston, -1, 0], [pin, cos, sin], [pin, -sin, cos]];
  return ARROWS.map(([key, name, colour], i) => {
    const [[x, y], dx, dy] = ways[i], k = bore * between(over, forces[key].values, phi) / most;
    const place = far => [x + dx * far, y + dy * far], ink = COLOURS[colour];
    return Math.abs(k) > bore / 40 && html`
      ${line([x, y], place(k), "force", ink)}${circle(place(k), bore / 28, "", ink)}
      <text transform=${`translate(${place(k + Math.sign(k) * bore / 6)}) rotate(${-axis})`}
        font-size=${bore / 5}>${name}</text>`;
  });
}

export function star(moves, phi) {
  const groups = {};
  moves.throws.forEach((angle, i) => (groups[Math.round(angle * 100) / 100 % 360] ??= []).push(i + 1));
  return html`
    <svg id="star" role="img" aria-label="Звезда кривошипов" viewBox="-130 -130 260 260">
      ${circle([0, 0], 85, "axis")}
      ${Object.entries(groups).map(([angle, numbers]) => {
        const turn = rad(Number(angle) + phi), [x, y] = [Math.sin(turn), -Math.cos(turn)];
        return html`${line([0, 0], [85 * x, 85 * y], "rod")}${circle([85 * x, 85 * y], 6, "body")}
          <text x=${108 * x} y=${108 * y} font-size="14">${numbers.join(", ")}</text>`;
      })}
    </svg>`;
}
