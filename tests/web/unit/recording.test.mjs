import assert from "node:assert/strict";
import { test } from "node:test";
import { gzipSync } from "node:zlib";

import { recordingOf } from "../support/samples.mjs";
import { page } from "./page.mjs";

const { Recording } = await page("recording/recording.js");
const { Player } = await page("recording/player.js");
const { World } = await page("model/world.js");

const FRAMES = 50;
const PERIOD = 0.1; // s

// Two chunks a frame, the second of each after the first of the next; a parameter that changes half-way.
function messages() {
  const run = { world: "w", run_id: 1n, topology_revision: 1n };
  const all = [
    { topic: "scene", seconds: 0, message: { ...run, particles: 2, bodies: [{ name: "b", particles: 2 }] } },
    { topic: "topology", seconds: 0, message: { ...run, chunks: 1, rest_positions: [0, 0, 0, 1, 0, 0] } },
  ];
  const parameters = (seconds, value) => {
    const values = [{ name: "k", numbers: [value] }];
    all.push({ topic: "parameters", seconds, message: { ...run, values } });
  };
  parameters(0, 1);
  for (let f = 0; f < FRAMES; ++f) {
    const frame = { ...run, frame: BigInt(f), step: BigInt(f), time: f * PERIOD, chunks: 2, total: 2 };
    all.push({ topic: "frames", seconds: f * PERIOD, message: { ...frame, chunk: 0, first: 0, positions: [f, 0, 0] } });
    all.push({ topic: "frames", seconds: f * PERIOD + 0.12, message: { ...frame, chunk: 1, first: 1, positions: [f, 1, 0] } });
    if (f % 5 === 0) all.push({ topic: "status", seconds: f * PERIOD, message: { ...run, state: 0, report: { step: BigInt(f) } } });
    if (f === 25) {
      parameters(f * PERIOD, 2);
      all.push({ topic: "events", seconds: f * PERIOD, message: { ...run, text: "set k = 2" } });
    }
  }
  return all.sort((a, b) => a.seconds - b.seconds);
}

async function open(options) {
  const bytes = await recordingOf(messages(), options);
  const file = new Blob([bytes]);
  file.name = "run.mcap";
  return Recording.open(file);
}

async function playerOf(options) {
  const world = new World();
  return { world, player: new Player(await open(options), world) };
}

const shown = (world) => (world.nextFrame(), Number(world.particles.frame));

test("any moment of a recording has its frame, status, parameters and events", async () => {
  const { world, player } = await playerOf();
  await player.seek(3);
  assert.equal(shown(world), 28);
  assert.deepEqual(Array.from(world.particles.positions), [28, 0, 0, 28, 1, 0]);
  assert.equal(world.status.report.step, 30n);
  assert.deepEqual(Array.from(world.parameters.values[0].numbers), [2]);
  assert.equal(world.events.length, 1);
  await player.seek(1);
  assert.equal(shown(world), 8);
  assert.deepEqual(Array.from(world.parameters.values[0].numbers), [1]);
  assert.equal(world.events.length, 0);
});

test("the start has the first frame, although it is complete only later", async () => {
  const { world, player } = await playerOf();
  await player.seek(0);
  assert.equal(shown(world), 0);
});

test("playing gives every frame in order, at its speed, and stops at the end", async () => {
  const { world, player } = await playerOf();
  await player.start();
  const seen = [shown(world)];
  player.speed = 0.5;
  for (let i = 0; i < 400 && player.playing; ++i) {
    player.advance(0.05);
    await new Promise(setImmediate);
    if (world.nextFrame()) seen.push(Number(world.particles.frame));
  }
  assert.equal(player.playing, false);
  assert.deepEqual(seen, Array.from({ length: FRAMES }, (_, i) => i));
});

test("steps go one frame on and one back", async () => {
  const { world, player } = await playerOf();
  await player.seek(2);
  const at = shown(world);
  await player.step(1);
  assert.equal(shown(world), at + 1);
  await player.step(1);
  assert.equal(shown(world), at + 2);
  await player.step(-1);
  assert.equal(shown(world), at + 1);
});

test("of seeks that overtake each other the last one counts", async () => {
  const { world, player } = await playerOf();
  await Promise.all([player.seek(4), player.seek(2), player.seek(3)]);
  assert.equal(shown(world), 28);
  assert.equal(player.seconds, 3);
});

test("the plots of a recording are there at once", async () => {
  const { world, player } = await playerOf();
  await player.start();
  assert.equal(world.history.seconds.length, FRAMES / 5);
});

test("a file that is no recording, or has no end, is refused with what to do", async () => {
  const refuse = (bytes) => {
    const file = new Blob([bytes]);
    file.name = "run.mcap";
    return Recording.open(file);
  };
  await assert.rejects(refuse(gzipSync("nothing")), /run\.mcap cannot be played/);
  const bytes = await recordingOf(messages());
  await assert.rejects(refuse(bytes.subarray(0, bytes.length / 2)), /flexcast-record --recover/);
});
