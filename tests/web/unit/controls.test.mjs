import assert from "node:assert/strict";
import { test } from "node:test";

import { page } from "./page.mjs";

const { SliderScale } = await page("ui/slider_scale.js");
const { formatClock, formatCount, formatNumber, formatQuantity, formatUnit } = await page("ui/format.js");
const { pickParticle } = await page("view/picking.js");
const { calcNormals } = await page("view/normals.js");
const { edgesOf } = await page("model/topology.js");
const { troublePoints } = await page("model/trouble.js");
const { GrabStream } = await page("live/grab_stream.js");

test("sliders of positive numbers without an end are logarithmic around the scene's value", () => {
  const scale = new SliderScale(0, Infinity, 1e6);
  assert.equal(scale.logarithmic, true);
  assert.equal(scale.place(1e6), 500);
  assert.equal(scale.value(500), 1e6);
  assert.deepEqual([scale.value(0), scale.value(1000)], [1e4, 1e8]);
});

test("sliders of narrow ranges are linear and reach both ends", () => {
  const scale = new SliderScale(0, 0.5, 0.4);
  assert.equal(scale.logarithmic, false);
  assert.deepEqual([scale.value(0), scale.value(500), scale.value(1000)], [0, 0.25, 0.5]);
  assert.equal(new SliderScale(-Infinity, Infinity, -9.81).logarithmic, false);
});

test("a slider's place gives back its number, and numbers beyond it are at its ends", () => {
  for (const scale of [new SliderScale(0, Infinity, 0.1), new SliderScale(-1, 1, 0), new SliderScale(1, 1e6, 10)]) {
    for (const place of [0, 1, 137, 500, 999, 1000]) {
      assert.ok(Math.abs(scale.place(scale.value(place)) - place) <= 1, `${place} of ${scale.low}..${scale.high}`);
    }
    assert.equal(scale.place(1e99), 1000);
    assert.equal(scale.place(-1e99), 0);
  }
});

test("a parameter that is zero has a slider, too", () => {
  const scale = new SliderScale(0, Infinity, 0);
  assert.ok(scale.high > scale.low && Number.isFinite(scale.high));
  assert.equal(scale.place(0), 0);
});

test("numbers are written as one types them", () => {
  assert.deepEqual([1e6, 0.1, 1e-6, 0, NaN, Infinity, -2.5].map((value) => formatNumber(value)), ["1e6", "0.1", "1e-6", "0", "–", "∞", "-2.5"]);
  assert.equal(formatQuantity(12345, "Pa"), "12.3 kPa");
  assert.equal(formatQuantity(0.25, "m/s"), "250 mm/s");
  assert.equal(formatCount(1234567n), "1\u2009234\u2009567");
  assert.equal(formatClock(62.51), "1:02.5");
  assert.deepEqual(["m/s^2", "N.s", "kg/m^3"].map(formatUnit), ["m/s²", "N·s", "kg/m³"]);
});

const TETRAHEDRON = {
  rest_positions: Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]),
  tetrahedra: Uint32Array.from([0, 1, 2, 3]),
  springs: Uint32Array.from([]),
  triangles: Uint32Array.from([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]),
};

test("a ray takes the nearest corner of the first triangle it meets, else a particle within reach", () => {
  const { rest_positions, triangles } = TETRAHEDRON;
  assert.equal(pickParticle([0.1, 0.1, 5], [0, 0, -1], rest_positions, triangles, 0.01), 3);
  assert.equal(pickParticle([0.7, 0.1, -5], [0, 0, 1], rest_positions, triangles, 0.01), 1);
  assert.equal(pickParticle([1.02, 0, 5], [0, 0, -1], rest_positions, [], 0.01), 1);
  assert.equal(pickParticle([2, 2, 5], [0, 0, -1], rest_positions, triangles, 0.01), -1);
});

test("normals point outward", () => {
  const { rest_positions, triangles } = TETRAHEDRON;
  const normals = new Float32Array(12);
  calcNormals(rest_positions, triangles, normals);
  for (let p = 0; p < 4; ++p) {
    const outward = [0, 1, 2].reduce((sum, axis) => sum + normals[3 * p + axis] * (rest_positions[3 * p + axis] - 0.25), 0);
    assert.ok(outward > 0);
  }
});

test("every edge of tetrahedra and every spring is drawn once", () => {
  assert.equal(edgesOf(TETRAHEDRON).length, 12);
  assert.equal(edgesOf({ ...TETRAHEDRON, tetrahedra: [], springs: [0, 1, 1, 0, 1, 2] }).length, 4);
});

test("the element of a failure is found among the world's, the place where there is none", () => {
  const topology = { ...TETRAHEDRON, tetrahedra: Uint32Array.from([9, 9, 9, 9, 0, 1, 2, 3]), bodies: [
    { name: "a", first_particle: 0, particles: 0, tetrahedra: 1, springs: 0, first_tetrahedron: 0, first_spring: 0 },
    { name: "b", first_particle: 0, particles: 4, tetrahedra: 1, springs: 0, first_tetrahedron: 1, first_spring: 0 },
  ] };
  const trouble = { body: "b", element: 0, particle: -1, position: [7, 8, 9] };
  const points = (change) => troublePoints({ state: 3, trouble: { ...trouble, ...change } }, topology, TETRAHEDRON.rest_positions);
  assert.deepEqual(points({}), [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]);
  assert.deepEqual(points({ element: -1, particle: 2 }), [[0, 1, 0]]);
  assert.deepEqual(points({ element: -1 }), [[7, 8, 9]]);
  assert.deepEqual(troublePoints({ state: 0, trouble }, topology, TETRAHEDRON.rest_positions), []);
});

test("a grab has one request on its way, the newest target goes next, and the release comes last", async () => {
  const sent = [];
  const waiting = [];
  const stream = new GrabStream((verb, request) => {
    sent.push(request.target ? request.target[0] : verb);
    return new Promise((resolve) => waiting.push(resolve));
  }, assert.fail);
  for (const x of [1, 2, 3]) stream.move(5, [x, 0, 0]);
  assert.deepEqual(sent, [1]);
  waiting.shift()({ outcome: "applied" });
  await new Promise(setImmediate);
  assert.deepEqual(sent, [1, 3]);
  stream.move(5, [4, 0, 0]);
  stream.release();
  waiting.shift()({ outcome: "applied" });
  await new Promise(setImmediate);
  assert.deepEqual(sent, [1, 3, "release"]);
});
