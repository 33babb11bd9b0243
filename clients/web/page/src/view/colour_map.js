// Colour maps of even steps for the eye: straight paths and arcs in OKLab (Björn Ottosson, 2020), sampled by arc length.

const STEPS = 256;

/** For what begins at zero: from deep indigo over teal to light yellow. */
export const SEQUENTIAL = sampled([
  [0.45, 0.15, 285],
  [0.54, 0.14, 262],
  [0.65, 0.12, 222],
  [0.77, 0.14, 165],
  [0.86, 0.16, 125],
  [0.95, 0.15, 105],
]);

/** For what goes both ways from zero: blue, pale grey, red. */
export const DIVERGING = sampled([
  [0.4, 0.15, 262],
  [0.66, 0.11, 250],
  [0.93, 0.01, 250],
  [0.68, 0.13, 35],
  [0.42, 0.16, 25],
]);

/** sRGB [0..1] of OKLab. */
export function srgbOfOklab([L, a, b]) {
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ].map((linear) => {
    const value = Math.min(Math.max(linear, 0), 1);
    return value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
  });
}

// `points`: [lightness, chroma, hue in degrees]. Gives 256 x RGBA bytes.
function sampled(points) {
  const corners = points.map(([L, c, h]) => [L, c * Math.cos((h * Math.PI) / 180), c * Math.sin((h * Math.PI) / 180)]);
  const fine = smooth(corners, 64);
  const lengths = [0];
  for (let i = 1; i < fine.length; ++i) lengths.push(lengths[i - 1] + distance(fine[i - 1], fine[i]));
  const bytes = new Uint8Array(4 * STEPS);
  let at = 0;
  for (let i = 0; i < STEPS; ++i) {
    const wanted = (lengths.at(-1) * i) / (STEPS - 1);
    while (at + 2 < fine.length && lengths[at + 1] < wanted) ++at;
    const part = (wanted - lengths[at]) / (lengths[at + 1] - lengths[at]);
    const rgb = srgbOfOklab(fine[at].map((value, k) => value + part * (fine[at + 1][k] - value)));
    rgb.forEach((value, k) => (bytes[4 * i + k] = Math.round(255 * value)));
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

// A Catmull-Rom curve through the points.
function smooth(points, pieces) {
  const curve = [];
  const get = (i) => points[Math.min(Math.max(i, 0), points.length - 1)];
  for (let i = 0; i + 1 < points.length; ++i) {
    for (let k = 0; k < pieces; ++k) {
      const t = k / pieces;
      curve.push(
        get(i).map((p1, axis) => {
          const [p0, p2, p3] = [get(i - 1)[axis], get(i + 1)[axis], get(i + 2)[axis]];
          return p1 + 0.5 * t * (p2 - p0 + t * (2 * p0 - 5 * p1 + 4 * p2 - p3 + t * (3 * (p1 - p2) + p3 - p0)));
        }),
      );
    }
  }
  curve.push(points.at(-1));
  return curve;
}

function distance(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
