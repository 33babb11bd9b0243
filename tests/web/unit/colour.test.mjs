import assert from "node:assert/strict";
import { test } from "node:test";

import { page } from "./page.mjs";

const { DIVERGING, SEQUENTIAL } = await page("view/colour_map.js");
const { ColourRange, niceAbove } = await page("view/colour_range.js");
const { COLOURINGS, SpringStretch, Velocity } = await page("view/colouring.js");

function oklab([r, g, b]) {
  const [x, y, z] = [r, g, b].map((value) => (value / 255 <= 0.04045 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4));
  const l = Math.cbrt(0.4122214708 * x + 0.5363325363 * y + 0.0514459929 * z);
  const m = Math.cbrt(0.2119034982 * x + 0.6806995451 * y + 0.1073969566 * z);
  const s = Math.cbrt(0.0883024619 * x + 0.2817188376 * y + 0.6299787005 * z);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

const colours = (map) => Array.from({ length: map.length / 4 }, (_, i) => oklab(map.slice(4 * i, 4 * i + 3)));
const distance = (a, b) => Math.hypot(...a.map((value, i) => value - b[i]));

test("equal differences of a value look alike, all along both maps", () => {
  for (const map of [SEQUENTIAL, DIVERGING]) {
    const all = colours(map);
    const steps = Array.from({ length: 15 }, (_, i) => distance(all[17 * i], all[17 * (i + 1)]));
    const mean = steps.reduce((sum, step) => sum + step) / steps.length;
    for (const step of steps) assert.ok(Math.abs(step / mean - 1) < 0.35, `${step} of ${mean}`);
  }
});

test("the sequential map grows lighter, the diverging one is lightest in the middle", () => {
  const sequential = colours(SEQUENTIAL);
  for (let i = 8; i < sequential.length; ++i) assert.ok(sequential[i][0] > sequential[i - 8][0]);
  const diverging = colours(DIVERGING);
  const lightest = diverging.reduce((best, colour, i) => (colour[0] > diverging[best][0] ? i : best), 0);
  assert.ok(Math.abs(lightest - 127.5) < 12, String(lightest));
});

test("the end of a scale is 1, 2 or 5 times a power of ten, never below the value", () => {
  assert.deepEqual([0.011, 1, 1.01, 2.5, 5, 7, 900].map(niceAbove), [0.02, 1, 2, 5, 5, 10, 1000]);
});

test("a scale grows at once, and shrinks only after a quiet while", () => {
  const range = new ColourRange(3);
  range.update(1.5, 0);
  assert.equal(range.most, 2);
  for (let i = 0; i < 20; ++i) range.update(0.1, 0.1);
  assert.equal(range.most, 2);
  for (let i = 0; i < 20; ++i) range.update(0.1, 0.1);
  assert.equal(range.most, 0.1);
  range.update(30, 0.1);
  assert.equal(range.most, 50);
  range.update(NaN, 0.1);
  assert.equal(range.most, 50);
});

const particlesAt = (positions, time, run_id = 1n) => ({ positions: Float32Array.from(positions), velocities: null, time, run_id });

test("speeds come from the stream, else from the differences of frames of one run", () => {
  const velocity = new Velocity();
  const speeds = (particles) => {
    const values = new Float32Array(1);
    COLOURINGS.speed.calc({ particles, velocity }, values);
    return values[0];
  };
  assert.equal(speeds(particlesAt([0, 0, 0], 0)), 0);
  assert.equal(speeds(particlesAt([3, 4, 0], 0.5)), 10);
  assert.equal(speeds(particlesAt([0, 0, 0], 0, 2n)), 0);
  assert.equal(speeds({ ...particlesAt([0, 0, 0], 1, 2n), velocities: Float32Array.from([1, 2, 2]) }), 3);
});

test("the stretch of springs is their length over their rest length minus 1, the mean of a particle's", () => {
  const topology = { springs: Uint32Array.from([0, 1, 1, 2]), tetrahedra: [], rest_positions: [0, 0, 0, 1, 0, 0, 3, 0, 0] };
  const stretch = new SpringStretch(topology).of({ positions: Float32Array.from([0, 0, 0, 2, 0, 0, 3, 0, 0]) });
  assert.deepEqual(Array.from(stretch), [1, 0.25, -0.5]);
});

test("what cannot be shown says which fields to add", () => {
  const elements = { particles: {}, topology: { springs: [], tetrahedra: [0, 1, 2, 3] } };
  assert.match(COLOURINGS.stretch.available(elements), /"stretch" to \[stream\] fields/);
  assert.match(COLOURINGS.stress.available(elements), /"stress" to \[stream\] fields/);
  assert.equal(COLOURINGS.stress.available({ particles: { stress: [1] } }), "");
});
