// Chromium with the page in it.
import { mkdirSync } from "node:fs";
import { join } from "node:path";

import { chromium } from "playwright-core";

const FLAGS = [
  "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
export const PATIENCE = 40000; // ms until a test gives up

/** Starts Chromium; its pages remember what their consoles said. */
export async function startBrowser() {
  const executablePath = process.env.FLEXCAST_CHROMIUM ?? "/usr/bin/chromium";
  return chromium.launch({ executablePath, args: FLAGS, timeout: PATIENCE });
}

/** A page at an address. `errors`: whatever its console complained about, and requests to elsewhere. */
export async function openPage(browser, address, { width = 1000, height = 640, dark = false, phone = false } = {}) {
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: dark ? "dark" : "light",
    hasTouch: phone,
    isMobile: phone,
  });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error.stack ?? error)));
  page.on("request", (request) => {
    const url = new URL(request.url());
    if (url.host !== new URL(address).host && url.protocol !== "blob:") errors.push(`a request to ${url}`);
  });
  await page.goto(address);
  return { page, errors };
}

/** Keeps a picture of the page among the artifacts of the build. */
export async function keepPicture(page, name) {
  const folder = process.env.FLEXCAST_PICTURES ?? "pictures";
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${name}.png`), timeout: PATIENCE });
}

/** Drops a file on the page, as a mouse does. */
export async function dropFile(page, path) {
  const { readFileSync } = await import("node:fs");
  const { basename } = await import("node:path");
  const transfer = await page.evaluateHandle(
    ([text, name]) => {
      const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
      const data = new DataTransfer();
      data.items.add(new File([bytes], name));
      return data;
    },
    [readFileSync(path).toString("base64"), basename(path)],
  );
  for (const type of ["dragenter", "dragover", "drop"]) await page.dispatchEvent("body", type, { dataTransfer: transfer });
}

/** The picture of the bodies as {pixels: [[r, g, b]...]} on a coarse grid, drawn anew. */
export async function lookAt(page) {
  return page.evaluate(() => {
    const { viewport } = window.flexcast;
    const view = document.getElementById("view");
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [320, 200];
    viewport.changed = true;
    viewport.draw();
    const context = copy.getContext("2d", { willReadFrequently: true });
    context.drawImage(view, 0, 0, copy.width, copy.height);
    return Array.from(context.getImageData(0, 0, copy.width, copy.height).data);
  });
}

/** How many pixels of two pictures are not alike. */
export function countChanged(before, after) {
  let changed = 0;
  for (let i = 0; i < before.length; i += 4) {
    const difference = [0, 1, 2, 3].reduce((sum, k) => sum + Math.abs(before[i + k] - after[i + k]), 0);
    if (difference > 24) ++changed;
  }
  return changed;
}
