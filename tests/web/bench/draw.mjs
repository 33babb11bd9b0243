// What a frame costs the page's script, in Chromium: a square cloth of 100 x 100 particles, played from a recording.
//
//   FLEXCAST_SITE=build-tests/clients/web/page/site/dist node tests/web/bench/draw.mjs [particles]
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { dropFile, openPage, startBrowser } from "../support/browser.mjs";
import { recordingOf } from "../support/samples.mjs";
import { serve } from "../support/static_server.mjs";

const FRAMES = 240;
const side = Math.round(Math.sqrt(Number(process.argv[2] ?? 10000)));
const total = side * side;

function clothRecording() {
  const run = { world: "bench", run_id: 1n, topology_revision: 1n };
  const place = (i, j, t) => [i / side, j / side, 0.5 + 0.1 * Math.sin((9 * i) / side + 5 * t) * Math.cos((7 * j) / side)];
  const cloth = (t) => Array.from({ length: total }, (_, p) => place(p % side, Math.floor(p / side), t)).flat();
  const triangles = [];
  for (let j = 0; j + 1 < side; ++j) {
    for (let i = 0; i + 1 < side; ++i) {
      const p = i + side * j;
      triangles.push(p, p + 1, p + side + 1, p, p + side + 1, p + side);
    }
  }
  const messages = [
    { topic: "scene", seconds: 0, message: { ...run, name: "bench", particles: total, bodies: [{ name: "cloth", particles: total }] } },
    { topic: "topology", seconds: 0, message: { ...run, chunks: 1, rest_positions: cloth(0), triangles } },
  ];
  for (let f = 0; f < FRAMES; ++f) {
    const time = f / 60;
    const message = { ...run, frame: BigInt(f), step: BigInt(f), time, chunks: 1, total, positions: cloth(time), bounds: [0, 0, 0, 1, 1, 1] };
    messages.push({ topic: "frames", seconds: time, message });
  }
  return recordingOf(messages, { chunkSize: 1 << 20 });
}

const folder = mkdtempSync(join(tmpdir(), "flexcast-bench-"));
const file = join(folder, "bench.mcap");
writeFileSync(file, await clothRecording());
const server = await serve(process.env.FLEXCAST_SITE ?? "build-tests/clients/web/page/site/dist");
const browser = await startBrowser();
try {
  const { page } = await openPage(browser, server.address, { width: 400, height: 300 });
  await dropFile(page, file);
  await page.waitForFunction(() => window.flexcast.player && !window.flexcast.player.playing && window.flexcast.player.seconds > 1);
  const medians = await page.evaluate(() => window.flexcast.timings.medians());
  console.log(JSON.stringify({ particles: total, ...medians }));
} finally {
  await browser.close();
  server.close();
  rmSync(folder, { recursive: true });
}
