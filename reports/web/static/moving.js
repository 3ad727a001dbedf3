// The mechanism of a cylinder at φ, drawn through the solver's joints, and the star of cranks.
import {COLOURS, between} from "./charts.js";
import {html} from "./common.js";

const upright = ([x, y], turned, size, text) => html`
  <text transform=${`translate(${x} ${y}) rotate(${-turned})`} font-size=${size}>${text}</text>`;

export function mechanism(moves, phi) {
  const {radius, bore, wall, axis, joints, turn, shift} = moves, half = bore / 2, left = wall - half;
  const inside = ((phi - shift) % 360 + 360) % 360;
  const points = [[0, 0], ...joints.map(([x, y]) => [between(turn, x, inside), -between(turn, y, inside)])];
  const top = Math.max(...joints.at(-1)[1]) + bore, size = top + 1.4 * radius; // of all that moves
  return html`
    <svg id="mechanism" role="img" aria-label="Механизм цилиндра и силы"
      viewBox=${[-size / 2, -top, size, size].join(" ")}>
      <g transform=${`rotate(${axis} 0 ${size / 2 - top})`}>
        <circle class="axis" r=${radius} />
        <path class="axis" d=${`M${left} ${-1.2 * radius}V${-top}m${bore} 0V${-1.2 * radius}`} />
        <rect class="body" x=${left} y=${points.at(-1)[1] - half * .8} width=${bore} height=${half * 1.3} />
        <polyline class="rod" points=${points.join(" ")} />
        ${points.map(([x, y]) => html`<circle class="body" cx=${x} cy=${y} r=${radius / 9} />`)}
        ${arrows(moves, phi, points[1], points.at(-1), inside * Math.PI / 180)}
      </g>
    </svg>`;
}

function arrows({forces, phi: over, axis, bore}, phi, pin, piston, turn) {
  const most = Math.max(...Object.values(forces).flatMap(f => f.values.map(Math.abs)), 1e-9);
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const drawn = [["Ps_MPa", "PΣ", 0, piston, 0, 1], ["N_MPa", "N", 4, piston, -1, 0],
    ["T_MPa", "T", 1, pin, cos, sin], ["K_MPa", "K", 2, pin, -sin, cos]];
  return drawn.map(([key, name, colour, [x, y], dx, dy]) => {
    const far = bore * between(over, forces[key].values, phi) / most, ink = COLOURS[colour];
    const beyond = far + Math.sign(far) * bore / 6;
    return Math.abs(far) > bore / 40 && html`
      <path class="force" d=${`M${x} ${y}l${dx * far} ${dy * far}`} stroke=${ink} />
      <circle cx=${x + dx * far} cy=${y + dy * far} r=${bore / 28} fill=${ink} />
      ${upright([x + dx * beyond, y + dy * beyond], axis, bore / 5, name)}`;
  });
}

export function star({throws}, phi) {
  const groups = {};
  throws.forEach((angle, i) => (groups[Math.round(angle * 100) / 100 % 360] ??= []).push(i + 1));
  return html`
    <svg id="star" role="img" aria-label="Звезда кривошипов" viewBox="-130 -130 260 260">
      <circle class="axis" r="85" />
      ${Object.entries(groups).map(([angle, numbers]) => html`<g transform=${`rotate(${Number(angle) + phi})`}>
        <path class="rod" d="M0 0V-85" /><circle class="body" cy="-85" r="6" />
        ${upright([0, -108], Number(angle) + phi, 14, numbers.join(", "))}</g>`)}
    </svg>`;
}
