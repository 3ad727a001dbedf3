// The running mechanism: all cylinders, forces of the chosen one, star of cranks. Each is drawn once for an
// engine; an angle only moves it.
import {html, memo, row, symbol, table, printed} from "./common.js";
import {between, inks} from "./drawn.js";

const range = values => [Math.min(...values), Math.max(...values)];
const LONG = 1.1; // of the bore: the greatest force
const within = (angle, period) => (angle % period + period) % period;
const head = ({joints, bore}, {rod}) => Math.max(...joints[rod].at(-1)[1]) + .5 * bore; // of a cylinder

// The engine stands upright: its banks to both sides of the vertical.
const tilt = ({each}) => -range(each.map(one => (one.axis + 180) % 360 - 180 || one.axis)).reduce((a, b) => a + b) / 2;

function cylinder(moves, i, more) { // in its own frame, its axis upwards
  const {radius, bore, wall, each, joints} = moves, half = bore / 2, top = head(moves, each[i]);
  return html`<g class=${`cylinder ${more ?? ""}`} data-cylinder=${i}>
    <rect class="gas" x=${wall - half} width=${bore} height="1" />
    <path class="axis" d=${`M${wall - half} ${-1.15 * radius}V${-top}h${bore}V${-1.15 * radius}`} />
    <rect class="body piston" x=${wall - half} width=${bore} height=${half * 1.3} rx=${bore / 20} />
    <polyline class="rod" />
    ${[0, ...joints[each[i].rod]].map(() => html`<circle class="body pin" r=${radius / 9} />`)}</g>`;
}

const reach = (moves, keys, sign = Math.abs) => Math.max(...keys.flatMap(key => moves.forces[key].values.map(sign)), 1e-9);
const greatest = moves => reach(moves, FORCES.map(([key]) => key)); // of a cycle: it is LONG
const FORCES = [["Ps_MPa", "PΣ", 0], ["N_MPa", "N", 1], ["T_MPa", "T", 2], ["K_MPa", "K", 3]];

function front(moves) { // from the nose, as the engine stands
  const {radius, bore, each, cylinder: chosen} = moves, most = greatest(moves), upright = tilt(moves);
  const pull = reach(moves, ["K_MPa", "T_MPa"]) / most, lift = LONG * reach(moves, ["Ps_MPa"], force => -force) / most;
  const round = Math.max(1.3 * radius, radius + bore * (LONG * pull + .35));
  const corners = each.flatMap((one, i) => [-1, 1].map(side => {
    const up = head(moves, one) + (i === chosen ? Math.max(lift - .15, .1) : .1) * bore, turn = (one.axis + upright) * Math.PI / 180, out = .6 * bore * side;
    return [up * Math.sin(turn) + out * Math.cos(turn), -up * Math.cos(turn) + out * Math.sin(turn)];
  }));
  const [[left, right], [top, down]] = [0, 1].map(k => range([-round, round, ...corners.map(c => c[k])]));
  return html`
    <svg id="mechanism" role="img" aria-label="Механизм двигателя и силы в цилиндре"
      viewBox=${[left, top, right - left, down - top].join(" ")}>
      <circle class="axis" r=${radius} />
      ${each.map((one, i) => i !== chosen && html`<g transform=${`rotate(${one.axis + upright})`}>${cylinder(moves, i, "faint")}</g>`)}
      <g transform=${`rotate(${each[chosen].axis + upright})`}>${cylinder(moves, chosen)}
        ${FORCES.map(([key, name, colour]) => html`<g class="force" data-force=${key} style=${`--ink: ${inks()[colour]}`}>
          <path /><text font-size=${bore / 6}>${name}</text></g>`)}</g>
    </svg>`;
}

const strip = (moves, choose) => moves.each.map((one, i) => {
  const {bore, wall, radius} = moves, wide = Math.max(1.15 * bore, 2.4 * radius), top = head(moves, one) + .05 * bore;
  return html`<button key=${i} class="one" aria-pressed=${String(i === moves.cylinder)} aria-label=${`Цилиндр ${i + 1}`}
    onClick=${() => choose(i)}><svg aria-hidden="true" viewBox=${[Math.min(wall, 0) - wide / 2, -top, wide + Math.abs(wall), top + 1.2 * radius].join(" ")}>
      ${cylinder(moves, i)}</svg><span>${i + 1}</span></button>`;
});

const star = ({throws}) => html`
  <svg id="star" role="img" aria-label="Звезда кривошипов" viewBox="-130 -130 260 260">
    <circle class="axis" r="85" />
    ${throws.map(([angle, numbers]) => html`<g class="throw" data-angle=${angle}>
      <path class="rod" d="M0 0V-85" /><circle class="body" cy="-85" r="6" />
      <text y="-108" font-size="17">${numbers.join(", ")}</text></g>`)}
  </svg>`;

const values = moves => table(`Удельные силы, цилиндр ${moves.cylinder + 1}`, Object.entries(moves.forces).map(([key, f]) =>
  row([[symbol(f.symbol)], [html`<output data-value=${key} aria-live="off" />`, "n"], [f.unit, "s"]])));

export const parts = (moves, isDark, choose) => Object.fromEntries(Object.entries({front, strip, star, values})
  .map(([name, make]) => [name, memo(name, [moves, isDark], () => make(moves, choose))]));

// The places of an angle. What is moved is looked up once for an engine.
export function pose(root, moves, phi, isTold) {
  if (root.moves !== moves) Object.assign(root, {moves, moving: collected(root, moves)});
  const {each, turn, joints, gas, bore} = moves, period = moves.phi.at(-1);
  const at = each.map(one => {
    const own = within(phi - one.shift, 360), places = joints[one.rod];
    return {own, share: between(moves.phi, gas, within(phi - one.shift, period)) ?? 0,
      points: [[0, 0], ...places.map(([x, y]) => [between(turn, x, own), -between(turn, y, own)])]};
  });
  const {cylinders, heads, throws, values, upright} = root.moving;
  for (const {number, piston, rod, pins, chamber} of cylinders) {
    const {points, share} = at[number], crown = points.at(-1)[1] - .4 * bore;
    piston.setAttribute("transform", `translate(0 ${crown})`);
    rod.setAttribute("points", points.join(" "));
    pins.forEach((pin, k) => pin.setAttribute("transform", `translate(${points[k]})`));
    chamber.setAttribute("transform", `translate(0 ${-heads[number]}) scale(1 ${Math.max(0, crown + heads[number])})`);
    chamber.style.opacity = .1 + .9 * Math.sqrt(share);
  }
  arrows(root.moving, moves, phi, at[moves.cylinder], isTold);
  for (const {node, name, angle} of throws) {
    node.setAttribute("transform", `rotate(${angle + phi + upright})`);
    name.setAttribute("transform", `rotate(${-angle - phi - upright} 0 -108)`);
  }
  if (isTold) for (const [output, force] of values) output.textContent = printed(between(moves.phi, force.values, phi), 4);
}

const collected = (root, moves) => ({
  most: greatest(moves), upright: tilt(moves), heads: moves.each.map(one => head(moves, one)),
  cylinders: [...root.querySelectorAll("[data-cylinder]")].map(node => ({
    number: Number(node.dataset.cylinder), piston: node.querySelector(".piston"), rod: node.querySelector(".rod"),
    pins: [...node.querySelectorAll(".pin")], chamber: node.querySelector(".gas"),
  })),
  forces: FORCES.map(([key]) => root.querySelector(`[data-force=${key}]`)),
  throws: [...root.querySelectorAll(".throw")].map(node =>
    ({node, name: node.querySelector("text"), angle: Number(node.dataset.angle)})),
  values: [...root.querySelectorAll("[data-value]")].map(node => [node, moves.forces[node.dataset.value]]),
});

function arrows({forces: nodes, most, upright}, {forces, phi: over, each, bore, cylinder: chosen}, phi, {points, own}, isTold) {
  const axis = each[chosen].axis + upright, [pin, piston] = [points[1], points.at(-1)];
  const places = [[piston, 90], [piston, 180], [pin, own], [pin, own + 90]];
  nodes.forEach((node, i) => {
    const [place, along] = places[i], [line, name] = node.children, [key, word] = FORCES[i];
    const force = between(over, forces[key].values, phi), far = LONG * bore * force / most;
    const barb = Math.sign(far) * Math.min(bore / 11, Math.abs(far)), beyond = Math.sign(far) * (Math.max(Math.abs(far), bore / 5) + bore / 5);
    node.style.display = Math.abs(far) > bore / 40 ? "" : "none";
    node.setAttribute("transform", `translate(${place}) rotate(${along})`);
    line.setAttribute("d", `M0 0h${far}m${-barb} ${-barb / 2}l${barb} ${barb / 2}l${-barb} ${barb / 2}`);
    // A word across the rod stands beside it.
    name.setAttribute("transform", `translate(${beyond} 0) rotate(${-axis - along})${i === 0 ? ` translate(${bore * .62} 0)` : ""}`);
    if (isTold) name.textContent = `${word} ${printed(force, 2)}`;
  });
}

// --- a picture and a clip, as one sees it ---
const STYLED = ["fill", "stroke", "stroke-width", "opacity", "display", "vector-effect", "text-anchor", "dominant-baseline", "font-family", "font-weight", "paint-order"];

async function drawn(svg, canvas) {
  const copy = svg.cloneNode(true), [was, now] = [svg, copy].map(each => [...each.querySelectorAll("*")]);
  was.forEach((node, i) => {
    const style = getComputedStyle(node);
    for (const key of STYLED) now[i].style.setProperty(key, style.getPropertyValue(key));
  });
  Object.entries({xmlns: "http://www.w3.org/2000/svg", width: canvas.width, height: canvas.height})
    .forEach(pair => copy.setAttribute(...pair));
  const picture = new Image();
  picture.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
  await picture.decode();
  const ink = canvas.getContext("2d");
  ink.fillStyle = getComputedStyle(document.body).backgroundColor;
  ink.fillRect(0, 0, canvas.width, canvas.height);
  ink.drawImage(picture, 0, 0);
}

function sheet(svg, size = 720) {
  const {width, height} = svg.viewBox.baseVal, scale = size / Math.max(width, height);
  return Object.assign(document.createElement("canvas"), {width: 2 * Math.round(width * scale / 2), height: 2 * Math.round(height * scale / 2)});
}

export async function picture(svg, size = 1200) {
  const canvas = sheet(svg, size);
  await drawn(svg, canvas);
  return new Promise(done => canvas.toBlob(done));
}

export async function clip(svg, turn, period, seconds = 4) { // one cycle
  const canvas = sheet(svg), stream = canvas.captureStream(30), chunks = [];
  await drawn(svg, canvas);
  const recorder = new MediaRecorder(stream), ended = new Promise(done => { recorder.onstop = done; });
  recorder.ondataavailable = ({data}) => chunks.push(data);
  recorder.start();
  const began = performance.now();
  for (let share = 0; share < 1; share = (performance.now() - began) / 1000 / seconds) {
    turn(period * share);
    await drawn(svg, canvas);
    await new Promise(requestAnimationFrame);
  }
  recorder.stop();
  await ended;
  return new Blob(chunks, {type: recorder.mimeType});
}
