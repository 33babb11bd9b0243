// A world that fails says why, where, and what to do.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { keepPicture, openPage, startBrowser } from "../support/browser.mjs";
import { assertLit, waitForPicture, waitForState } from "../support/page_test.mjs";
import { Programs } from "../support/programs.mjs";

// A beam that is far beyond its stable step.
const SCENE = `
name = "unstable"
gravity = [0, 0, -9.81]
[time]
step = 0.02
integrator = "symplectic_euler"
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [8, 2, 2], size = [1.0, 0.25, 0.25] }
material = { law = "corotational", young = 1e6, poisson = 0.3, density = 1000.0 }
pin = [ { select = { box = [[-1e-9, -1, -1], [1e-9, 1, 1]] } } ]
`;

const programs = new Programs();
let browser, page, errors;

before(async () => {
  await programs.server(programs.write("unstable.toml", SCENE));
  const web = await programs.web();
  browser = await startBrowser();
  ({ page, errors } = await openPage(browser, web.address));
  await waitForPicture(page);
});

after(async () => {
  await browser?.close();
  await programs.end();
});

test("cause, place and suggestion are shown, and the element is marked", async () => {
  await waitForState(page, "failed");
  const { cause, suggestion, element } = await page.evaluate(() => window.flexcast.world.status.trouble);
  const notice = await page.locator(".notice.failure").innerText();
  assert.ok(notice.includes(cause), notice);
  assert.ok(notice.includes(suggestion.slice(1)), notice);
  assert.ok(notice.includes(`Body beam, ${element >= 0 ? `element ${element}` : "particle"}`), notice);
  assert.ok(await page.evaluate(() => window.flexcast.troubled));
  await assertLit(page); // although its bodies flew apart
  await keepPicture(page, "failed");
});

test("a smaller step and a reset bring it back", async () => {
  const field = page.locator('[data-name="time.step"] input[type=text]');
  await field.fill("0.0005");
  await field.press("Enter");
  await page.waitForFunction(() => / since step /.test(document.querySelector('[data-name="time.step"] .note').textContent));
  await page.evaluate(() => window.flexcast.live.command("reset", { keep_parameters: true }));
  await waitForState(page, "paused");
  await page.click("#play");
  await waitForState(page, "running");
  assert.equal(await page.locator(".notice.failure").count(), 0);
  assert.deepEqual(errors, []);
});
