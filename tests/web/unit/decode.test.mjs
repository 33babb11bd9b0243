import assert from "node:assert/strict";
import { test } from "node:test";

import { atOffset, sample } from "../support/samples.mjs";
import { page } from "./page.mjs";

const { decodeFrame, peekFrame } = await page("decode/particle_frame.js");
const { FrameAssembler } = await page("decode/frame_assembler.js");
const { Particles } = await page("decode/particles.js");
const { makeDecoder } = await page("decode/idl.js");

const HEAD = { run_id: 2n ** 63n + 5n, frame: 7n, step: 70n, time: 0.25, topology_revision: 3n, chunk: 0, chunks: 1, total: 2 };
const X = [0.5, -1.25, 2, 3.5, 4.25, -5];

function frame(fields, world = "w") {
  return sample("ParticleFrame", { ...HEAD, world, bounds: [-1, -2, -5, 4, 5, 2], ...fields });
}

function particlesOf(...samples) {
  const particles = new Particles();
  particles.update(samples);
  return particles;
}

test("the fast path reads what another library wrote, at every alignment and length of the world's name", () => {
  for (const world of ["", "w", "wo", "wor", "world", "a-longer-name"]) {
    for (const offset of [0, 1, 4, 13]) {
      const bytes = atOffset(frame({ positions64: X, velocities: X, stretch: [0.1, 0.2] }, world), offset);
      const decoded = decodeFrame(bytes);
      assert.deepEqual(Array.from(decoded.positions64), X);
      assert.deepEqual(Array.from(decoded.velocities), X);
      assert.deepEqual(Array.from(decoded.stretch), [0.1, 0.2].map(Math.fround));
      assert.equal(decoded.positions, null);
      assert.equal(decoded.run_id, HEAD.run_id);
      assert.equal(decoded.step, 70n);
      assert.equal(decoded.time, 0.25);
      assert.deepEqual(peekFrame(bytes), { run_id: HEAD.run_id, frame: 7n, topology_revision: 3n, chunk: 0, chunks: 1 });
    }
  }
});

test("float32, float64 and quantized16 give the same positions", () => {
  const bounds = [-1, -2, -5, 4, 5, 2];
  const fractions = X.map((value, i) => Math.round((65535 * (value - bounds[i % 3])) / (bounds[(i % 3) + 3] - bounds[i % 3])));
  assert.deepEqual(Array.from(particlesOf(frame({ positions: X })).positions), X);
  assert.deepEqual(Array.from(particlesOf(frame({ positions64: X })).positions), X);
  const quantized = particlesOf(frame({ positions16: fractions })).positions;
  X.forEach((value, i) => assert.ok(Math.abs(quantized[i] - value) < 7 / 65535, `${quantized[i]} for ${value}`));
});

test("a sample that is shorter than it says, or of another encoding, is refused", () => {
  const bytes = frame({ positions: X });
  assert.throws(() => decodeFrame(bytes.subarray(0, 100)), RangeError);
  assert.throws(() => decodeFrame(bytes.subarray(0, bytes.length - 30)), RangeError);
  const big_endian = bytes.slice();
  big_endian[1] = 0;
  assert.throws(() => decodeFrame(big_endian), /XCDR1/);
});

const chunk = (frame_number, number, fields = {}) =>
  frame({ frame: BigInt(frame_number), chunk: number, chunks: 2, first: number, positions: X.slice(3 * number, 3 * number + 3), ...fields });

test("chunks of two frames that arrive mixed become whole frames, and the newest wins", () => {
  const frames = new FrameAssembler();
  assert.equal(frames.add(chunk(1, 0)), false);
  assert.equal(frames.add(chunk(2, 1)), false);
  assert.equal(frames.take(), null);
  assert.equal(frames.add(chunk(1, 1)), true);
  assert.equal(frames.add(chunk(2, 0)), true);
  const particles = particlesOf(...frames.take());
  assert.equal(particles.frame, 2n);
  assert.deepEqual(Array.from(particles.positions), X);
  assert.equal(frames.take(), null);
});

test("a frame that is not newer is ignored, gaps are counted, and a new run begins anew", () => {
  const frames = new FrameAssembler();
  for (const number of [5n, 9n, 9n, 4n]) frames.add(frame({ frame: number, positions: X }));
  assert.deepEqual([frames.received, frames.absent], [2, 3]);
  assert.equal(peekFrame(frames.take()[0]).frame, 9n);
  assert.equal(frames.add(frame({ run_id: 1n, frame: 0n, positions: X })), true);
  assert.deepEqual([frames.received, frames.absent], [1, 0]);
});

test("fields that a later frame does not have are gone", () => {
  const particles = particlesOf(frame({ positions: X, velocities: X, stress: [1, 2] }));
  assert.deepEqual(Array.from(particles.stress), [1, 2]);
  particles.update([frame({ positions: X })]);
  assert.equal(particles.velocities, null);
  assert.equal(particles.stress, null);
});

test("every other type is decoded by the schema that comes with it", async () => {
  const { idl } = await import("../support/samples.mjs");
  const decode = makeDecoder(idl, "flexcast::Status");
  const status = decode(sample("Status", { world: "w", state: 3, trouble: { cause: "blew up", element: -1 }, warnings: ["a", "b"] }));
  assert.equal(status.trouble.cause, "blew up");
  assert.equal(status.trouble.element, -1);
  assert.deepEqual(status.warnings, ["a", "b"]);
  assert.throws(() => makeDecoder(idl, "flexcast::Nothing"));
});
