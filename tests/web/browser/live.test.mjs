// The page on a running world, in Chromium.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { keepPicture, lookAt, countChanged, openPage, startBrowser } from "../support/browser.mjs";
import { assertLit, assertMoves, field, note, stepOf, waitForFrames, waitForPicture, waitForState } from "../support/page_test.mjs";
import { Programs, shippedScene } from "../support/programs.mjs";

const programs = new Programs();
let browser, address, page, errors;

before(async () => {
  await programs.server(shippedScene("cloth"));
  address = (await programs.web()).address;
  browser = await startBrowser();
  ({ page, errors } = await openPage(browser, address));
  await waitForPicture(page);
});

after(async () => {
  await browser?.close();
  await programs.end();
});

test("shows a body that moves", async () => {
  await waitForState(page, "running");
  await assertLit(page);
  await assertMoves(page);
  await keepPicture(page, "live-light");
});

test("pause stops it, a step is one step, and resume goes on", async () => {
  await page.click("#play");
  await waitForState(page, "paused");
  await page.waitForTimeout(300); // what was on its way has come
  const [step, picture] = [await stepOf(page), await lookAt(page)];
  await page.waitForTimeout(500);
  assert.equal(await stepOf(page), step);
  assert.equal(countChanged(picture, await lookAt(page)), 0);
  await page.click("#step");
  await page.waitForFunction((wanted) => Number(window.flexcast.world.particles.step) === wanted, step + 1);
  await page.click("#play");
  await waitForState(page, "running");
  await assertMoves(page);
});

test("space pauses and resumes, s steps", async () => {
  await page.focus("#view");
  await page.keyboard.press("Space");
  await waitForState(page, "paused");
  await page.waitForTimeout(300);
  const step = await stepOf(page);
  await page.keyboard.press("s");
  await page.waitForFunction((wanted) => Number(window.flexcast.world.particles.step) === wanted, step + 1);
  await page.keyboard.press("Space");
  await waitForState(page, "running");
});

test("a slider changes a parameter, and the value in force is shown with its step", async () => {
  const slider = page.locator('[data-name="cloth.stiffness"] input[type=range]');
  const before = Number(await field(page, "cloth.stiffness").inputValue());
  await slider.focus();
  await slider.press("ArrowRight");
  await page.waitForFunction(() => / since step \d/.test(document.querySelector('[data-name="cloth.stiffness"] .note').textContent));
  const shown = Number(await field(page, "cloth.stiffness").inputValue());
  assert.ok(shown > before, `${shown} after ${before}`);
  const value = await page.evaluate(() => window.flexcast.world.parameters.values.find(({ name }) => name === "cloth.stiffness").numbers[0]);
  assert.equal(value, shown);
  assert.ok((await note(page, "cloth.stiffness").textContent()).startsWith(String(shown)));
  await keepPicture(page, "parameter-changed");
});

test("a refused value is shown with the server's reason, and the value in force is back", async () => {
  const before = await field(page, "cloth.stiffness").inputValue();
  await field(page, "cloth.stiffness").fill("-5");
  await field(page, "cloth.stiffness").press("Enter");
  await page.waitForSelector('[data-name="cloth.stiffness"].refused');
  assert.match(await note(page, "cloth.stiffness").textContent(), /cloth\.stiffness.*-5/);
  assert.equal(await field(page, "cloth.stiffness").inputValue(), before);
  await keepPicture(page, "parameter-refused");
});

test("a changed parameter goes back to the scene's value by its button", async () => {
  await page.click('[data-name="cloth.stiffness"] button');
  await page.waitForSelector('[data-name="cloth.stiffness"]:not(.changed)');
});

test("a particle follows the pointer that drags it, and is let go", async () => {
  const start = await page.evaluate(() => {
    const { viewport, world } = window.flexcast;
    const particle = world.particles.total >> 1;
    return { at: viewport.project(Array.from(world.particles.positions.subarray(3 * particle, 3 * particle + 3))) };
  });
  await page.mouse.move(...start.at);
  await page.mouse.down();
  const particle = await page.evaluate(() => window.flexcast.grab.particle);
  assert.ok(particle >= 0, "nothing was grabbed");
  for (let i = 1; i <= 10; ++i) await page.mouse.move(start.at[0] + 6 * i, start.at[1] - 14 * i);
  const place = () => page.evaluate((p) => {
    const { grab, world } = window.flexcast;
    const at = Array.from(world.particles.positions.subarray(3 * p, 3 * p + 3));
    return Math.hypot(...at.map((value, axis) => value - grab.target[axis]));
  }, particle);
  const far = await place();
  let near = far;
  for (let i = 0; i < 200 && near > 0.25 * far + 0.02; ++i) {
    await waitForFrames(page, 2);
    near = await place();
  }
  assert.ok(near <= 0.25 * far + 0.02, `${near} m from the pointer, ${far} m before`);
  await keepPicture(page, "grab");
  await page.mouse.up();
  await page.waitForFunction(() => window.flexcast.world.events.some(({ command_kind, kind }) => kind === 0 && command_kind === 12));
});

test("reset begins anew", async () => {
  const run = await page.evaluate(() => String(window.flexcast.world.particles.run_id));
  await page.click("#reset");
  await page.waitForFunction((before) => String(window.flexcast.world.particles.run_id) !== before, run);
  await waitForFrames(page, 2);
});

test("particles and springs, every colour, plots, probes and events can be seen", async () => {
  await page.click("#mode");
  await waitForFrames(page, 2);
  await assertLit(page);
  await page.selectOption("#colour", "stretch");
  await waitForFrames(page, 2);
  assert.match(await page.locator("#colour-bar").innerText(), /Stretch[\s\S]*%/);
  await keepPicture(page, "particles-stretch");
  await page.selectOption("#colour", "stress");
  await page.waitForFunction(() => document.getElementById("colour-bar").innerText.includes("[stream] fields"));
  await page.selectOption("#colour", "speed");
  await page.click("#mode");
  for (const tab of ["plots", "probes", "events"]) {
    await page.click(`#tab-${tab}`);
    await page.waitForTimeout(400);
    await keepPicture(page, `tab-${tab}`);
  }
  assert.ok((await page.locator(".plot canvas").count()) >= 5);
});

test("pages in the dark and on a phone show the same world", async () => {
  await page.click("#play"); // each of them draws but once
  await waitForState(page, "paused");
  const looks = { "live-dark": { dark: true }, "live-phone": { width: 390, height: 844, phone: true } };
  for (const [name, look] of Object.entries(looks)) {
    const other = await openPage(browser, address, look);
    await waitForPicture(other.page);
    await waitForState(other.page, "paused");
    await assertLit(other.page);
    await keepPicture(other.page, name);
    if (look.phone) {
      await other.page.click("#panel-button");
      await keepPicture(other.page, "live-phone-panel");
    }
    assert.deepEqual(other.errors, []);
    await other.page.context().close();
  }
});

test("a finger that presses long grabs, one that moves at once turns the view", async () => {
  const { page: phone } = await openPage(browser, address, { width: 390, height: 844, phone: true });
  await waitForPicture(phone);
  await waitForState(phone, "paused");
  const touch = await phone.context().newCDPSession(phone);
  const [x, y] = await phone.evaluate(() => {
    const { viewport, world } = window.flexcast;
    const particle = world.particles.total >> 1;
    return viewport.project(Array.from(world.particles.positions.subarray(3 * particle, 3 * particle + 3)));
  });
  const send = (type, ...points) => touch.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([px, py]) => ({ x: px, y: py })) });
  await send("touchStart", [x, y]);
  await phone.waitForFunction(() => window.flexcast.grab.particle >= 0);
  await send("touchEnd");
  await phone.waitForFunction(() => window.flexcast.grab.particle < 0);
  const camera = () => phone.evaluate(() => window.flexcast.viewport.camera.position.toArray().join());
  const before = await camera();
  await send("touchStart", [x, y]);
  for (let i = 1; i < 8; ++i) await send("touchMove", [x + 12 * i, y]);
  await send("touchEnd");
  await phone.waitForFunction((was) => window.flexcast.viewport.camera.position.toArray().join() !== was, before);
  await phone.context().close();
});

test("nothing in the console, and no request to elsewhere", () => assert.deepEqual(errors, []));
