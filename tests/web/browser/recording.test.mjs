// A recording of the real recorder that is dropped on the page.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { dropFile, keepPicture, openPage, startBrowser } from "../support/browser.mjs";
import { assertLit, assertMoves, waitForFrames, waitForPicture, waitForState } from "../support/page_test.mjs";
import { Programs, shippedScene } from "../support/programs.mjs";

const programs = new Programs();
let browser, page, errors;

before(async () => {
  await programs.server(shippedScene("drape"));
  const recorders = await Promise.all([
    programs.recorder("lz4.mcap", "--duration", "3"),
    programs.recorder("zstd.mcap", "--duration", "3", "--compression", "zstd"),
  ]);
  await Promise.all(recorders.map(({ ended }) => ended));
  const web = await programs.web();
  browser = await startBrowser();
  ({ page, errors } = await openPage(browser, web.address));
  await waitForPicture(page);
});

after(async () => {
  await browser?.close();
  await programs.end();
});

const seconds = () => page.evaluate(() => window.flexcast.player.seconds);

for (const compression of ["lz4", "zstd"]) {
  test(`a recording packed with ${compression} plays to its end`, async () => {
    await dropFile(page, programs.path(`${compression}.mcap`));
    // Not the one before, which may still be shown.
    await page.waitForFunction((name) => window.flexcast.player?.recording.name === name, `${compression}.mcap`);
    await waitForState(page, "recorded, running");
    await page.selectOption("#speed", "0.1");
    await page.getByLabel("Time line").fill("0");
    if (!(await page.evaluate(() => window.flexcast.player.playing))) await page.click("#play");
    await assertLit(page);
    await assertMoves(page);
    await page.selectOption("#speed", "10");
    await page.waitForFunction(() => !window.flexcast.player.playing);
    await keepPicture(page, `recording-${compression}`);
    assert.ok(Math.abs((await seconds()) - (await page.evaluate(() => window.flexcast.player.recording.duration))) < 1e-6);
  });
}

test("the time line goes to any moment, and arrows go frame by frame", async () => {
  const slider = page.getByLabel("Time line");
  const time = () => page.evaluate(() => window.flexcast.world.particles.time);
  const last = await time();
  await slider.fill("5000");
  await page.waitForFunction((before) => window.flexcast.world.particles.time < before - 0.3, last);
  const [at, middle] = [await time(), await page.evaluate(() => window.flexcast.player.recording.duration / 2)];
  assert.ok(Math.abs((await seconds()) - middle) < 0.01);
  await page.focus("#view");
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction((before) => window.flexcast.world.particles.time > before, at);
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction((before) => window.flexcast.world.particles.time === before, at);
});

test("parameters of a recording are read only, its plots are whole", async () => {
  assert.equal(await page.locator('[data-name="cloth.stiffness"] input[type=text]').isDisabled(), true);
  await page.click("#tab-plots");
  await page.waitForSelector(".plot canvas");
  assert.ok(await page.evaluate(() => window.flexcast.world.history.seconds.length > 8));
  await page.waitForTimeout(400);
  await keepPicture(page, "recording-plots");
});

test("the way back leads to the live world", async () => {
  await page.click("#go-live");
  await page.waitForFunction(() => !document.getElementById("state").textContent.startsWith("recorded"));
  await waitForFrames(page, 1);
  assert.equal(await page.locator('[data-name="cloth.stiffness"] input[type=text]').isDisabled(), false);
  assert.deepEqual(errors, []);
});

test("a file that is no recording is refused with a sentence", async () => {
  await dropFile(page, programs.write("text.mcap", "this is not a recording"));
  await page.waitForFunction(() => document.getElementById("notices").innerText.includes("text.mcap cannot be played"));
});
