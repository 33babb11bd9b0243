import { VALUE_KINDS } from "../decode/idl.js";

/** A flexcast::ParameterValue as the services write it: number, array of three, string or boolean. */
export function plainValue({ kind, numbers, text }) {
  switch (VALUE_KINDS[kind]) {
    case "vector":
      return Array.from(numbers);
    case "choice":
      return text;
    case "boolean":
      return numbers[0] !== 0;
    default:
      return numbers[0];
  }
}

export function sameValue(a, b) {
  return Array.isArray(a) && Array.isArray(b) ? a.every((value, i) => value === b[i]) : a === b;
}

/** "> 0", "0 to 0.5", "any number": what a descriptor allows. */
export function rangeText({ minimum, maximum, minimum_open, maximum_open, unit }, format) {
  const from = Number.isFinite(minimum);
  const to = Number.isFinite(maximum);
  const of = unit ? ` ${unit}` : "";
  if (from && to) {
    return `${minimum_open ? "above " : ""}${format(minimum)} to ${maximum_open ? "below " : ""}${format(maximum)}${of}`;
  }
  if (from) return `${minimum_open ? ">" : "≥"} ${format(minimum)}${of}`;
  if (to) return `${maximum_open ? "<" : "≤"} ${format(maximum)}${of}`;
  return `any number${unit ? `, ${unit}` : ""}`;
}
