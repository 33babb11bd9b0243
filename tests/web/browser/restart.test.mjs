// Servers and bridges that go and come back.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { keepPicture, openPage, startBrowser } from "../support/browser.mjs";
import { assertMoves, waitForFrames, waitForState } from "../support/page_test.mjs";
import { Programs, shippedScene } from "../support/programs.mjs";

const programs = new Programs();
const scene = shippedScene("cloth");
let browser, page, errors, server, web;

before(async () => {
  web = await programs.web();
  browser = await startBrowser();
  ({ page, errors } = await openPage(browser, web.address));
});

after(async () => {
  await browser?.close();
  await programs.end();
});

test("without a world the page says so, and goes on by itself once there is one", async () => {
  await page.waitForFunction(() => document.body.innerText.includes("No world yet"));
  await keepPicture(page, "no-world");
  server = await programs.server(scene);
  await waitForFrames(page, 2);
  await waitForState(page, "running");
});

test("a server that was killed is said to be silent, and goes on when it is started again", async () => {
  await server.stop("SIGKILL");
  await waitForState(page, "world is silent");
  await keepPicture(page, "silent");
  const run = await page.evaluate(() => String(window.flexcast.world.particles.run_id));
  server = await programs.server(scene);
  await page.waitForFunction((before) => String(window.flexcast.world.particles.run_id) !== before, run);
  await waitForState(page, "running");
  await assertMoves(page);
});

test("a bridge that was killed is said to be lost, and found again at the same port", async () => {
  assert.deepEqual(errors, []);
  await web.stop("SIGKILL");
  await waitForState(page, "connection lost");
  await keepPicture(page, "lost");
  web = await programs.web(new URL(web.address).port);
  await waitForState(page, "running");
  await waitForFrames(page, 2);
});

test("a second world can be chosen, and is in the address", async () => {
  await programs.server(shippedScene("rope"), "--world", "second");
  await page.waitForSelector("#health select:not([hidden])");
  await page.selectOption("#health select", "second");
  await page.waitForFunction(() => window.flexcast.world.scene?.name === "rope");
  await waitForFrames(page, 2);
  assert.equal(new URL(page.url()).searchParams.get("world"), "second");
  await keepPicture(page, "second-world");
});
