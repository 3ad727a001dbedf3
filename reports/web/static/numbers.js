// Numbers as the cells of the workbook show them.
const BIT = 4e-16; // a half that binary digits write a little less is a half
const raised = power => [...power].map(c => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("");
const russian = text => text.replace(".", ",").replace("-", "−");

function fixed(value, decimals) {
  const text = (Math.abs(value) * (1 + BIT)).toFixed(decimals);
  return russian((value < 0 && Number(text) ? "-" : "") + text);
}

export function cell(value, [kind, decimals, hides] = ["fixed", 3, ""]) {
  if (typeof value !== "number") return value ?? "";
  if (!Number.isFinite(value)) return "—";
  if (hides === "zeros" && value === 0) return "";
  if (kind !== "scientific" || !value) return fixed(value, decimals);
  const [digits, power] = value.toExponential(decimals).split("e");
  return Number(power) ? `${russian(digits)}·10${raised(String(Number(power)))}` : russian(digits);
}
