const PREFIXES = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]];

/** A whole number (also BigInt) with thin spaces between thousands. */
export const formatCount = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, "\u2009");

/** A number as one would type it: at most `digits` digits, no needless zeros. */
export function formatNumber(value, digits = 6) {
  if (!Number.isFinite(value)) return value > 0 ? "∞" : value < 0 ? "−∞" : "–";
  if (value === 0) return "0";
  const magnitude = Math.abs(value);
  const text = magnitude >= 1e6 || magnitude < 1e-4 ? value.toExponential(digits - 1) : value.toPrecision(digits);
  return text.replace(/(\.\d*?)0+(?=e|$)/, "$1").replace(/\.(?=e|$)/, "").replace("e+", "e");
}

/** A number with a unit, in thousands: 12.3 kPa. Units that have none (%, s with many digits) stay as they are. */
export function formatQuantity(value, unit, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  if (unit === "" || unit === "%" || value === 0) return `${formatNumber(value, digits)}${unit ? ` ${unit}` : ""}`;
  const magnitude = Math.abs(value);
  const [factor, prefix] = PREFIXES.find(([size]) => magnitude >= size * (1 - 1e-12)) ?? PREFIXES.at(-1);
  return `${formatNumber(value / factor, digits)} ${prefix}${unit}`;
}

/** Seconds with as many digits as a step of them needs: 12.345 s; a minute and more as 1:02.5. */
export function formatTime(seconds, digits = 3) {
  if (!Number.isFinite(seconds)) return "–";
  return `${seconds.toFixed(digits)} s`;
}

/** A place on a time line: 0:07.3. */
export function formatClock(seconds) {
  const tenths = Math.floor(10 * Math.max(seconds, 0) + 1e-6);
  const minutes = Math.floor(tenths / 600);
  const rest = ((tenths % 600) / 10).toFixed(1).padStart(4, "0");
  return `${minutes}:${rest}`;
}

/** A unit as one prints it: m/s², N·s; pure numbers have none. */
export const formatUnit = (unit) => (unit === "1" ? "" : unit).replace("^2", "²").replace("^3", "³").replace(/(?<=[A-Za-z])\.(?=[A-Za-z])/g, "·");
