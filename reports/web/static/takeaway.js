// What is taken home: the input as .toml, the workbook with other inputs, the card as a picture.
import {picture} from "./scene.js";

// --- the input ---
const quoted = text => JSON.stringify(text);
const plain = value => typeof value === "string" ? quoted(value) : Array.isArray(value) ? `[${value.map(plain).join(", ")}]`
  : typeof value === "object" ? `{${Object.entries(value).map(([key, each]) => `${key} = ${plain(each)}`).join(", ")}}` : String(value);
const isTable = value => typeof value === "object" && value !== null && !Array.isArray(value);
const isTables = value => Array.isArray(value) && value.length > 0 && value.every(isTable);

// Keys of a table first, then the tables within; `told` says what stands behind a key.
export function toml(raw, told, head) {
  const lines = [`# ${head}`];
  const table = (value, path) => {
    const within = [];
    for (const [key, each] of Object.entries(value)) {
      if (each === null || each === undefined) continue;
      const at = [...path, key], words = told(at.join("."));
      if (isTable(each)) within.push([`[${at.join(".")}]`, each, at]);
      else if (isTables(each)) for (const one of each) within.push([`[[${at.join(".")}]]`, one, at]);
      else lines.push(`${key} = ${plain(each)}${words ? ` # ${words}` : ""}`);
    }
    for (const [title, each, at] of within) {
      lines.push("", title);
      table(each, at);
    }
  };
  table(raw, []);
  return lines.join("\n") + "\n";
}

// --- the workbook: its cells of inputs are written anew in the zip, all other bytes stay ---
const through = (bytes, stream) => new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer()
  .then(buffer => new Uint8Array(buffer));
const unpacked = bytes => through(bytes, new DecompressionStream("deflate-raw"));
const packed = bytes => through(bytes, new CompressionStream("deflate-raw"));

const CRC = Uint32Array.from({length: 256}, (_, n) => {
  for (let k = 0; k < 8; k++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n;
});
const crcOf = bytes => ~bytes.reduce((crc, byte) => CRC[(crc ^ byte) & 255] ^ (crc >>> 8), ~0) >>> 0;

function entries(bytes) { // of the zip's directory
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  let end = bytes.length - 22;
  while (view.getUint32(end, true) !== 0x06054b50) end--;
  const found = [];
  let at = view.getUint32(end + 16, true);
  for (let n = view.getUint16(end + 10, true); n > 0; n--) {
    const [name, more, note] = [28, 30, 32].map(place => view.getUint16(at + place, true));
    const start = view.getUint32(at + 42, true), size = view.getUint32(at + 20, true);
    const body = start + 30 + view.getUint16(start + 26, true) + view.getUint16(start + 28, true);
    found.push({head: bytes.slice(at, at + 46), name: bytes.slice(at + 46, at + 46 + name), method: view.getUint16(at + 10, true),
      crc: view.getUint32(at + 16, true), full: view.getUint32(at + 24, true), data: bytes.subarray(body, body + size)});
    at += 46 + name + more + note;
  }
  return found;
}

function zipped(parts) {
  const chunks = [], directory = [];
  let at = 0;
  for (const {head, name, method, crc, full, data} of parts) {
    const local = new DataView(new ArrayBuffer(30)), from = new DataView(head.buffer);
    local.setUint32(0, 0x04034b50, true);
    for (let k = 4; k < 30; k += 2) local.setUint16(k, from.getUint16(k + 2, true), true);
    for (const [view, shift] of [[local, 0], [from, 2]]) {
      view.setUint16(6 + shift, from.getUint16(8, true) & ~8, true); // the sizes stand before the data
      view.setUint16(8 + shift, method, true);
      view.setUint32(14 + shift, crc, true);
      view.setUint32(18 + shift, data.length, true);
      view.setUint32(22 + shift, full, true);
      view.setUint16(28 + shift, 0, true);
    }
    from.setUint16(32, 0, true);
    from.setUint32(42, at, true);
    directory.push(head, name);
    chunks.push(new Uint8Array(local.buffer), name, data);
    at += 30 + name.length + data.length;
  }
  const end = new DataView(new ArrayBuffer(22)), size = directory.reduce((sum, each) => sum + each.length, 0);
  end.setUint32(0, 0x06054b50, true);
  for (const place of [8, 10]) end.setUint16(place, parts.length, true);
  end.setUint32(12, size, true);
  end.setUint32(16, at, true);
  return new Blob([...chunks, ...directory, end], {type: "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"});
}

const escaped = text => text.replace(/&/g, "&amp;").replace(/</g, "&lt;");
const written = value => typeof value === "number" ? `><v>${value}</v></c>`
  : ` t="inlineStr"><is><t xml:space="preserve">${escaped(value)}</t></is></c>`;

export async function workbook({data, part, cells}, values) { // values by the names of their cells
  const bytes = Uint8Array.from(atob(data), letter => letter.charCodeAt(0)), parts = entries(bytes);
  const sheet = parts.find(each => new TextDecoder().decode(each.name) === part);
  const text = new TextDecoder().decode(sheet.method ? await unpacked(sheet.data) : sheet.data);
  const at = new Map(Object.entries(values).map(([name, value]) => [cells[name], value]));
  const typed = text.replace(/<c r="([A-Z]+\d+)"([^>]*?)(?:\/>|>.*?<\/c>)/gs, (whole, place, looks) =>
    at.has(place) ? `<c r="${place}"${looks.replace(/\s+t="\w+"/, "")}${written(at.get(place))}` : whole);
  const full = new TextEncoder().encode(typed);
  Object.assign(sheet, {method: 8, crc: crcOf(full), full: full.length, data: await packed(full)});
  return zipped(parts);
}

// --- the card ---
const WIDE = 1200, HIGH = 630, EDGE = 40, DRAWN = 460;

function torque(ink, {x, y, at, name, mean, colours}) { // with its mean and the point of now
  const [left, top, wide, high] = [520, 350, WIDE - EDGE - 520, 210];
  const low = Math.min(0, ...y), most = Math.max(0, ...y), last = x.at(-1);
  const place = (phi, value) => [left + phi / last * wide, top + (most - value) / (most - low || 1) * high];
  ink.font = "600 20px 'Inter Variable', sans-serif";
  ink.fillText(name, left, top - 22);
  const line = (points, colour, width, dash = []) => {
    Object.assign(ink, {strokeStyle: colour, lineWidth: width});
    ink.setLineDash(dash);
    ink.beginPath();
    points.forEach(([px, py], i) => i ? ink.lineTo(px, py) : ink.moveTo(px, py));
    ink.stroke();
    ink.setLineDash([]);
  };
  line([place(0, 0), place(last, 0)], colours.soft, 1);
  line([place(0, mean), place(last, mean)], colours.second, 1.5, [8, 6]);
  line(Array.from(x, (phi, i) => place(phi, y[i])), colours.first, 4);
  ink.fillStyle = colours.second;
  ink.beginPath();
  ink.arc(...place(...at), 8, 0, 2 * Math.PI);
  ink.fill();
  Object.assign(ink, {fillStyle: colours.soft, font: "16px 'Inter Variable', sans-serif", textAlign: "center"});
  for (let phi = 0; phi <= last; phi += 180) ink.fillText(`${phi}°`, place(phi, 0)[0], top + high + 24);
  ink.textAlign = "left";
}

export async function card(svg, {title, about, numbers, curve, colours}) {
  const canvas = Object.assign(document.createElement("canvas"), {width: WIDE, height: HIGH}), ink = canvas.getContext("2d");
  const drawing = await createImageBitmap(await picture(svg, DRAWN));
  ink.fillStyle = colours.page;
  ink.fillRect(0, 0, WIDE, HIGH);
  const scale = Math.min(440 / drawing.width, DRAWN / drawing.height), [wide, high] = [drawing.width * scale, drawing.height * scale];
  ink.drawImage(drawing, EDGE + (440 - wide) / 2, 130 + (DRAWN - high) / 2, wide, high);
  const put = (text, x, y, font, colour = colours.text) => {
    Object.assign(ink, {font: `${font} 'Inter Variable', sans-serif`, fillStyle: colour});
    ink.fillText(text, x, y, WIDE - EDGE - x);
  };
  put(title, EDGE, 68, "700 38px");
  put(about, EDGE, 102, "20px", colours.soft);
  numbers.forEach(([name, value, unit], i) => {
    const x = 520 + 165 * i;
    ink.fillStyle = colours.card;
    ink.beginPath();
    ink.roundRect(x, 150, 152, 96, 10);
    ink.fill();
    const [letter, index] = name.split("_");
    put(letter, x + 14, 182, "18px", colours.soft);
    put(index ?? "", x + 14 + ink.measureText(letter).width + 1, 187, "13px", colours.soft);
    Object.assign(ink, {font: "700 25px 'Inter Variable', sans-serif", fillStyle: colours.text});
    ink.fillText(`${value} ${unit}`, x + 14, 222, 128);
  });
  ink.fillStyle = colours.text;
  torque(ink, {...curve, colours});
  put("kshm · живая страница", EDGE, HIGH - 22, "18px", colours.soft);
  return new Promise(done => canvas.toBlob(done));
}
