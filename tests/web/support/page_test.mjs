// What the tests of the page say and wait for.
import assert from "node:assert/strict";

import { countChanged, lookAt } from "./browser.mjs";

/** Waits until the page has drawn so many frames more. */
export async function waitForFrames(page, count) {
  const before = await page.evaluate(() => window.flexcast.timings.drawn);
  await page.waitForFunction((wanted) => window.flexcast.timings.drawn >= wanted, before + count);
}

/** Waits until the page has drawn anything. */
export const waitForPicture = (page) => page.waitForFunction(() => window.flexcast.timings.drawn > 0);

export const waitForState = (page, state) =>
  page.waitForFunction((wanted) => document.getElementById("state").textContent === wanted, state);

export const waitForText = (page, text) => page.waitForFunction((wanted) => document.body.innerText.includes(wanted), text);

/** The step of the frame that is shown. */
export const stepOf = (page) => page.evaluate(() => Number(window.flexcast.world.particles.step));

/** The bodies are seen: many pixels are not the background's. */
export async function assertLit(page) {
  const picture = await lookAt(page);
  const lit = countChanged(picture, new Array(picture.length).fill(0));
  assert.ok(lit > 1000, `${lit} pixels are lit`);
}

/** Things move: many pixels have changed after some frames. */
export async function assertMoves(page) {
  const before = await lookAt(page);
  let changed = 0;
  for (let i = 0; i < 40 && changed < 60; ++i) {
    await waitForFrames(page, 3);
    changed = countChanged(before, await lookAt(page));
  }
  assert.ok(changed >= 60, `${changed} pixels have changed`);
}

/** The field of a parameter. */
export const field = (page, name) => page.locator(`[data-name="${name}"] input[type=text]`).first();
export const note = (page, name) => page.locator(`[data-name="${name}"] .note`);
