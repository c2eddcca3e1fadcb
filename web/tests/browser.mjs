// The page in a browser, for tests.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { serve } from "../serve.mjs";
import { ROOT } from "./native.mjs";

const ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"];

/** Milliseconds that a mesh of a test may take on a busy machine. */
const PATIENCE = 120_000;

/** A browser and a server of the page. */
export async function start() {
  const server = await serve();
  const url = `http://127.0.0.1:${server.address().port}/`;
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ARGUMENTS });
  const stop = async () => {
    await browser.close();
    server.close();
  };
  return { browser, url, stop };
}

/** A page that is ready, with what it asked for and what went wrong. */
export async function open({ browser, url }, options = {}, fragment = "") {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  const requests = [];
  const faults = [];
  page.on("request", (request) => requests.push(request.url()));
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  await page.goto(url + fragment);
  await page.waitForFunction(() => globalThis.hexdelPage?.facts(), null, { timeout: PATIENCE });
  await settled(page);
  return { page, requests, faults };
}

/** Waits until everything is meshed and drawn. */
export async function settled(page) {
  await page.waitForFunction(() => globalThis.hexdelPage.idle(), null, { timeout: PATIENCE });
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** Drops a file onto the drawing. */
export async function drop(page, name, content) {
  await page.evaluate(
    ({ name, bytes }) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([Uint8Array.from(bytes)], name));
      const stage = document.querySelector("#stage");
      for (const type of ["dragover", "drop"]) {
        stage.dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true }));
      }
    },
    { name, bytes: [...content] },
  );
  await settled(page);
}

export const dropFixture = (page, name) => drop(page, name.replace(/^.*\//, ""), readFileSync(join(ROOT, "fixtures", name)));

/** Numbers of points, segments and holes of the input. */
export const counts = (page) =>
  page.evaluate(() => {
    const { points, segments, holes } = globalThis.hexdelPage.document();
    return [points, segments, holes].map((flat) => flat.length / 2);
  });

export const facts = (page) => page.evaluate(() => globalThis.hexdelPage.facts());

/** The mesh as a file, as Save would give it. */
export const file = async (page, format) =>
  Buffer.from(await page.evaluate(async (format) => [...(await globalThis.hexdelPage.file(format))], format));

/** Where a part of the canvas is on the page. */
export async function onCanvas(page, x, y) {
  const box = await page.locator("#canvas").boundingBox();
  return [box.x + x * box.width, box.y + y * box.height];
}

export async function click(page, x, y) {
  await page.mouse.click(...(await onCanvas(page, x, y)));
}

/** Where a point of the input is on the page. */
export async function pointOnPage(page, index) {
  const box = await page.locator("#canvas").boundingBox();
  const [x, y] = await page.evaluate((i) => {
    const { points } = globalThis.hexdelPage.document();
    return globalThis.hexdelPage.drawing.view.toPixels([points[2 * i], points[2 * i + 1]]);
  }, index);
  return [box.x + x, box.y + y];
}
