// The page in a real browser. Times are printed and assert nothing.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { click, counts, drop, dropFixture, facts, file, onCanvas, open, pointOnPage, settled, start } from "./browser.mjs";
import { native } from "./native.mjs";

const SHOTS = join(import.meta.dirname, "../screenshots");
const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

let place;
let main;

before(async () => {
  mkdirSync(SHOTS, { recursive: true });
  place = await start();
  main = await open(place);
});

after(() => place?.stop());

const shot = (page, name, options = {}) => page.screenshot({ path: join(SHOTS, `${name}.png`), ...options });

test("it begins with an example, and asks nobody else for anything", async () => {
  assert.deepEqual(await counts(main.page), [243, 0, 0]);
  assert.ok((await facts(main.page)).holds);
  assert.match(await main.page.textContent("#status"), /triangles, angles 43\.\d+ to (89|90)\.\d+ degrees, certified/);
  assert.match(await main.page.textContent("#verdict"), /^Holds/);
  assert.ok(main.requests.every((url) => url.startsWith(place.url)), main.requests.join("\n"));
  await shot(main.page, "light");
});

test("points are put by clicks, dragged, erased; undo and redo", async () => {
  const { page } = main;
  await page.click("#clear");
  for (const [x, y] of [[0.3, 0.3], [0.7, 0.35], [0.5, 0.7]]) {
    await click(page, x, y);
    await settled(page);
  }
  assert.deepEqual(await counts(page), [3, 0, 0]);
  assert.equal((await facts(page)).kept, 3);
  const [x, y] = await pointOnPage(page, 1);
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let i = 1; i <= 10; i++) {
    await page.mouse.move(x + 4 * i, y + 3 * i);
  }
  await page.mouse.up();
  await settled(page);
  const moved = await pointOnPage(page, 1);
  assert.ok(Math.hypot(moved[0] - x - 40, moved[1] - y - 30) < 1, String(moved));
  assert.ok((await facts(page)).holds);
  await page.click("#undo");
  await settled(page);
  const back = await pointOnPage(page, 1);
  assert.ok(Math.hypot(back[0] - x, back[1] - y) < 1, "a drag is one step");
  await page.click("#redo");
  await settled(page);
  await page.click("[data-tool=erase]");
  await page.mouse.click(...(await pointOnPage(page, 0)));
  await settled(page);
  assert.deepEqual(await counts(page), [2, 0, 0]);
});

test("a polygon with a hole is drawn", async () => {
  const { page } = main;
  await page.click("#clear");
  await page.click("[data-tool=segments]");
  const corners = [[0.2, 0.2], [0.8, 0.2], [0.8, 0.8], [0.2, 0.8]];
  for (const ring of [corners, corners.map(([x, y]) => [0.35 + x * 0.3, 0.35 + y * 0.3])]) {
    for (const [x, y] of [...ring, ring[0]]) {
      await click(page, x, y);
    }
  }
  await page.click("[data-tool=holes]");
  await click(page, 0.5, 0.5);
  await settled(page);
  assert.deepEqual(await counts(page), [8, 8, 1]);
  assert.ok((await facts(page)).holds);
  assert.ok((await facts(page)).angles[0] >= 30 - 1e-9);
  await page.check("#voronoi");
  await settled(page);
  await shot(page, "polygon");
  await page.uncheck("#voronoi");
});

test("the keyboard alone draws, moves and erases", async () => {
  const { page } = main;
  await page.click("#clear");
  await page.focus("#canvas");
  const press = async (...keys) => {
    for (const key of keys) await page.keyboard.press(key);
  };
  await press("1", "Enter", ...Array(8).fill("ArrowRight"), "Enter", ...Array(8).fill("ArrowDown"), "Enter");
  await settled(page);
  assert.deepEqual(await counts(page), [3, 0, 0]);
  const before = await pointOnPage(page, 2);
  await press("Space", "ArrowLeft", "ArrowLeft", "Space");
  await settled(page);
  const after = await pointOnPage(page, 2);
  assert.ok(Math.abs(before[0] - after[0] - 20) < 0.5, `${before} ${after}`);
  await press("Delete");
  await settled(page);
  assert.deepEqual(await counts(page), [2, 0, 0]);
  await press("Control+z");
  await settled(page);
  assert.deepEqual(await counts(page), [3, 0, 0]);
});

test("files are dropped, and what is saved is what the program writes", async () => {
  const { page } = main;
  for (const name of ["points/five.node", "points/capitals.node", "graphs/letters.poly"]) {
    await dropFixture(page, name);
    assert.ok((await facts(page)).holds, name);
    for (const [format, bytes] of native(name, ["node", "ele", "vtu", "msh", "svg"])) {
      assert.ok(bytes.equals(await file(page, format)), `${name} as .${format}`);
    }
  }
  await shot(page, "letters");
  await page.selectOption("#format", "vtu");
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
  assert.equal(download.suggestedFilename(), "letters.vtu");
  const [vtu] = native("graphs/letters.poly", ["vtu"]).values();
  assert.ok(vtu.equals(readFileSync(await download.path())));
  await page.selectOption("#format", "png");
  const [picture] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
  assert.equal(readFileSync(await picture.path()).subarray(1, 4).toString(), "PNG");
  const [input] = await Promise.all([page.waitForEvent("download"), page.click("#save-input")]);
  const saved = readFileSync(await input.path());
  const before = await page.evaluate(() => [...globalThis.hexdelPage.document().points]);
  await drop(page, "again.poly", saved);
  assert.deepEqual(await page.evaluate(() => [...globalThis.hexdelPage.document().points]), before);
});

test("options change the mesh", async () => {
  const { page } = main;
  await dropFixture(page, "points/five.node");
  await page.fill("#min-angle", "30");
  await page.press("#min-angle", "Enter");
  await settled(page);
  assert.deepEqual((await facts(page)).bounds, [30, 90]);
  const [ele] = native("points/five.node", ["ele"], "--min-angle=30").values();
  assert.ok(ele.equals(await file(page, "ele")));
  await page.fill("#min-angle", "");
  await page.selectOption("#method", "templates");
  await settled(page);
  await page.selectOption("#method", "compact");
  await page.fill("#min-angle", "59.5");
  await page.press("#min-angle", "Enter");
  await settled(page);
  assert.match(await page.textContent("#fault-text"), /no graded mesh has all angles between 59.5 and 90/);
  await page.fill("#min-angle", "");
  await page.press("#min-angle", "Enter");
  await settled(page);
  assert.ok(await page.isHidden("#fault"));
});

/** The fragment of the link that is copied. */
async function copiedLink(page) {
  const before = new URL(page.url()).hash;
  await page.click("#link");
  await page.waitForFunction((before) => location.hash !== before && location.hash.startsWith("#in="), before);
  return new URL(page.url()).hash;
}

/** The hexagons that are shown: how many there are, and how many the legend has of each kind. */
const hexagons = (page) =>
  page.evaluate(() => {
    const { levels, classes, classNames } = globalThis.hexdelPage.drawing.overlays.hexagons;
    const legend = [...document.querySelectorAll("#grid-legend li")].map((item) => item.textContent);
    return { count: levels.length, classes: [...new Set(classes)].map((c) => classNames[c]).sort(), legend };
  });

test("the hexagon grid is shown by level and by class, and follows a drag", async () => {
  const { page } = main;
  await dropFixture(page, "points/five.node");
  await page.selectOption("#hexagons", "levels");
  await page.fill("#min-angle", "30");
  await page.press("#min-angle", "Enter");
  await settled(page);
  assert.ok(await page.isVisible("#hexagons-note"), "a mesh that has grown has no hexagons");
  assert.ok(await page.isHidden("#grid-legend"));
  await page.fill("#min-angle", "");
  await page.selectOption("#method", "templates");
  await settled(page);
  assert.ok(await page.isHidden("#hexagons-note"));
  const counted = ({ legend }) => legend.reduce((sum, text) => sum + Number(text.split(": ")[1].replaceAll(",", "")), 0);
  const byLevel = await hexagons(page);
  assert.match(byLevel.legend[0], /level 0: \d+$/);
  assert.equal(counted(byLevel), byLevel.count);
  await shot(page, "hexagons");
  await page.selectOption("#hexagons", "classes");
  await settled(page);
  const byClass = await hexagons(page);
  assert.equal(counted(byClass), byClass.count);
  assert.equal(byClass.legend.length, byClass.classes.length);
  for (const name of ["occupied 1", "occupied 2", "moved centre in ring", "moved centre 1", "moved centre 2"]) {
    assert.ok(byClass.classes.includes(name), `${name} is not among ${byClass.classes}`);
  }
  await page.evaluate(() => globalThis.hexdelPage.drawing.zoom(2.5));
  await shot(page, "classes");
  await page.emulateMedia({ colorScheme: "dark" });
  await settled(page);
  await shot(page, "classes-dark");
  await page.emulateMedia({ colorScheme: "light" });
  await page.click("#fit");
  const drawn = () => page.evaluate(() => [...globalThis.hexdelPage.drawing.overlays.hexagons.corners.slice(0, 400)].join());
  const before = await drawn();
  const [x, y] = await pointOnPage(page, 0);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 20, y + 20);
  await page.mouse.move(x + 40, y + 30);
  await page.waitForFunction((before) => [...globalThis.hexdelPage.drawing.overlays.hexagons.corners.slice(0, 400)].join() !== before, before);
  await page.mouse.up();
  await settled(page);
  await page.selectOption("#hexagons", "");
  await page.selectOption("#method", "compact");
  await settled(page);
  assert.ok(await page.isHidden("#grid-legend"));
});

test("heights stay with their points, into files and links", async () => {
  const { page } = main;
  const assertFiles = async (page, name) => {
    for (const [format, bytes] of native(name, ["14", "2dm", "vtu"])) {
      assert.ok(bytes.equals(await file(page, format)), `${name} as .${format}`);
    }
  };
  await dropFixture(page, "polygons/geojson/z.geojson");
  await assertFiles(page, "polygons/geojson/z.geojson");
  assert.ok((await file(page, "14")).includes("100.5"));
  await dropFixture(page, "tables/id_east_north.csv");
  await assertFiles(page, "tables/id_east_north.csv");
  const heights = (page) => page.evaluate(() => [...globalThis.hexdelPage.document().heights]);
  const before = await heights(page);
  assert.equal(before.length, (await counts(page))[0]);
  assert.ok(before.every(Number.isFinite) && new Set(before).size > 1);
  // A point between them gets a height when it is saved, and not before.
  await page.click("[data-tool=points]");
  await click(page, 0.5, 0.52);
  await settled(page);
  assert.deepEqual(await heights(page), [...before, NaN]);
  const [x, y] = await pointOnPage(page, before.length);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 9, y + 9);
  await page.mouse.move(x + 20, y + 12);
  await page.mouse.up();
  await settled(page);
  const [input] = await Promise.all([page.waitForEvent("download"), page.click("#save-input")]);
  assert.equal(input.suggestedFilename(), "id_east_north.csv");
  const table = readFileSync(await input.path());
  const saved = new Map();
  for (const format of ["14", "2dm", "vtu"]) saved.set(format, await file(page, format));
  const other = await open(place, {}, await copiedLink(page));
  assert.deepEqual(await heights(other.page), [...before, NaN]);
  for (const [format, bytes] of saved) assert.ok(bytes.equals(await file(other.page, format)), format);
  await other.page.context().close();
  await drop(page, "id_east_north.csv", table);
  const filled = await heights(page);
  assert.deepEqual(filled.slice(0, before.length), before);
  assert.ok(filled.at(-1) >= Math.min(...before) && filled.at(-1) <= Math.max(...before), String(filled));
  for (const [format, bytes] of saved) assert.ok(bytes.equals(await file(page, format)), format);
  await page.click("#undo");
  await page.click("#undo");
  await settled(page);
  assert.deepEqual(await heights(page), [...before, NaN], "undone: the table, then the drag");
});

test("sliders set the options and follow them", async () => {
  const { page } = main;
  await dropFixture(page, "points/five.node");
  for (const [id, place, value] of [["min-angle", "35", "35"], ["max-angle", "85", "85"], ["effort", "0", "fast"]]) {
    await page.locator(`#${id}-slider`).fill(place);
    await settled(page);
    assert.equal(await page.inputValue(`#${id}`), value);
  }
  assert.deepEqual((await facts(page)).bounds, [35, 85]);
  const { triangles } = await facts(page);
  await page.locator("#size-slider").fill("40");
  await settled(page);
  const size = Number(await page.inputValue("#size"));
  assert.ok(size > 0 && (await facts(page)).triangles > triangles, String(size));
  await page.fill("#min-angle", "30");
  await page.press("#min-angle", "Enter");
  await settled(page);
  assert.equal(await page.inputValue("#min-angle-slider"), "30");
  for (const id of ["min-angle", "max-angle", "size"]) {
    await page.fill(`#${id}`, "");
    await page.press(`#${id}`, "Enter");
  }
  await page.selectOption("#effort", "standard");
  await settled(page);
  assert.equal(await page.inputValue("#size-slider"), "0");
  assert.equal(await page.inputValue("#effort-slider"), "1");
});

test("an error is told in the library's words, at its place, and mended", async () => {
  const { page } = main;
  await dropFixture(page, "graphs/crossing.poly");
  assert.match(await page.textContent("#fault-text"), /segments \d+ and \d+ cross at/);
  await shot(page, "error");
  await page.click("#fault-repair");
  await settled(page);
  assert.ok(await page.isHidden("#fault"));
  assert.ok((await facts(page)).holds);
  await page.uncheck("#repair");
  await settled(page);
  await drop(page, "bad.node", Buffer.from("2 2 0 0\n0 0 0\n1 zero 1\n"));
  assert.match(await page.textContent("#fault-text"), /^bad\.node:3/);
});

test("a link holds the input and the options", async () => {
  const { page } = main;
  await page.selectOption("#effort", "fast");
  await dropFixture(page, "graphs/square_with_hole.poly");
  const before = await counts(page);
  const fragment = await copiedLink(page);
  await page.selectOption("#effort", "standard");
  await settled(page);
  const other = await open(place, {}, fragment);
  assert.deepEqual(await counts(other.page), before);
  assert.equal(await other.page.inputValue("#effort"), "fast");
  assert.ok((await facts(other.page)).holds);
  await other.page.context().close();
  const damaged = await place.browser.newPage();
  await damaged.goto(`${place.url}#in=nonsense`);
  await damaged.waitForFunction(() => !document.querySelector("#fault").hidden);
  assert.equal(await damaged.textContent("#fault-text"), "the link is damaged");
  await damaged.close();
});

test("long work shows progress and is cancelled", async () => {
  const { page } = main;
  const grid = Array.from({ length: 6000 }, (_, i) => `${i % 77},${Math.floor(i / 77) + ((i * 7919) % 101) / 300}`);
  const dropping = drop(page, "grid.csv", Buffer.from(`x,y\n${grid.join("\n")}\n`));
  await page.waitForSelector("#cancel", { state: "visible" });
  await page.waitForFunction(() => document.querySelector("#phase").textContent.includes(": "));
  await page.click("#cancel");
  await dropping;
  assert.equal(await page.textContent("#status"), "Cancelled.");
  await dropFixture(page, "points/five.node");
  assert.ok((await facts(page)).holds);
});

/** Drags a point around for a while, as a mouse that tells its place every 8 ms, and says how often the mesh followed. */
async function followed(page, index, milliseconds = 1500) {
  // A person takes a while to reach for a point.
  await page.waitForTimeout(1500);
  const [x, y] = await pointOnPage(page, index);
  await page.mouse.move(x, y);
  await page.mouse.down();
  const updates = await page.evaluate(
    async ({ x, y, milliseconds }) => {
      const canvas = document.querySelector("#canvas");
      globalThis.pointAt = (clientX, clientY) =>
        canvas.dispatchEvent(new PointerEvent("pointermove", { clientX, clientY, pointerId: 1, pointerType: "mouse", bubbles: true }));
      const before = globalThis.hexdelPage.updates;
      const begun = performance.now();
      const over = () => performance.now() - begun > (globalThis.hexdelPage.updates > before + 1 ? milliseconds : 60_000);
      for (let i = 1; !over(); i++) {
        globalThis.pointAt(x + 6 * Math.sin(i / 9) + 5, y + 6 * Math.cos(i / 7));
        await new Promise((done) => setTimeout(done, 8));
      }
      return (1000 * (globalThis.hexdelPage.updates - before)) / (performance.now() - begun);
    },
    { x, y, milliseconds },
  );
  const live = await facts(page);
  const verdict = await page.textContent("#verdict");
  const frame = await page.evaluate(() => Math.min(...[1, 2, 3].map(() => globalThis.hexdelPage.drawing.drawNow())));
  // Where it was there is a mesh.
  await page.evaluate(({ x, y }) => globalThis.pointAt(x, y), { x, y });
  await page.mouse.up();
  await settled(page);
  return { rate: updates, frame, live, verdict };
}

test("the mesh follows a point that is dragged, in every example", { timeout: 600_000 }, async (context) => {
  const { page } = main;
  const labels = await page.$$eval("#example option", (options) => options.map((option) => option.label));
  const examples = labels.filter((label) => label !== "choose" && !label.includes("error"));
  assert.ok(examples.length >= 12, examples.join());
  for (const label of [...examples, "5,000 points"]) {
    if (label === "5,000 points") {
      const row = (i) => `${(i * 0.754877666) % 1},${(i * 0.569840291) % 1}`;
      await drop(page, "many.csv", Buffer.from(`x,y\n${Array.from({ length: 5000 }, (_, i) => row(i)).join("\n")}\n`));
    } else {
      await page.selectOption("#example", { label });
      await settled(page);
    }
    const [points] = await counts(page);
    const { rate, frame, live, verdict } = await followed(page, points > 17 ? 17 : 0);
    assert.ok(rate > 0, `${label} is not followed`);
    assert.ok(live.holds, `${label}: what is shown meanwhile`);
    // On its way the point may come to where there is no mesh, which is said in place of it.
    assert.match(verdict, /^(A draft while dragging\. Holds|Of the mesh before: holds)/, label);
    assert.ok((await facts(page)).holds, label);
    assert.equal(live.kept, (await facts(page)).kept, label);
    assert.match(await page.textContent("#verdict"), /^Holds/, label);
    context.diagnostic(
      `${label}: ${rate.toFixed(1)} updates a second, ${(1000 / rate / frame).toFixed(1)} times the drawing of a frame ` +
        `(${frame.toFixed(1)} ms), bounds ${live.bounds.map((bound) => bound.toFixed(1)).join(" to ")}`,
    );
  }
});

test("a hundred thousand triangles are drawn", async (context) => {
  const { page } = main;
  await page.selectOption("#method", "templates");
  await page.selectOption("#example", { label: "1,000 uniform points (paper, e)" });
  await settled(page);
  const { triangles } = await facts(page);
  assert.ok(triangles > 100_000, String(triangles));
  const time = () => page.evaluate(() => Math.min(...[1, 2, 3].map(() => globalThis.hexdelPage.drawing.drawNow())));
  const whole = await time();
  await shot(page, "hundred-thousand");
  await page.evaluate(() => globalThis.hexdelPage.drawing.zoom(3));
  const edges = await time();
  context.diagnostic(`${triangles} triangles: ${whole.toFixed(1)} ms as a whole, ${edges.toFixed(1)} ms magnified, with edges`);
  await page.click("#fit");
  await page.selectOption("#method", "compact");
});

test("the page is accessible in light, dark and on a phone", async () => {
  const phone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true };
  for (const [name, options] of [["light", {}], ["dark", { colorScheme: "dark" }], ["phone", phone], ["phone-dark", { ...phone, colorScheme: "dark" }]]) {
    const { page, faults } = await open(place, options);
    await page.evaluate(AXE);
    const { violations } = await page.evaluate(() => globalThis.axe.run());
    const texts = violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(" ")}`);
    assert.deepEqual(texts, [], name);
    if (name !== "light") {
      await shot(page, name, { fullPage: name === "phone" });
    }
    if (options.hasTouch) {
      const before = await counts(page);
      await page.touchscreen.tap(...(await onCanvas(page, 0.5, 0.12)));
      await settled(page);
      assert.equal((await counts(page))[0], before[0] + 1);
      const width = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(width <= 390, `${width} pixels wide`);
    }
    assert.deepEqual(faults, []);
    await page.context().close();
  }
});

test("nothing went wrong that nobody saw", () => {
  assert.deepEqual(main.faults, []);
  assert.ok(main.requests.every((url) => url.startsWith(place.url) || url.startsWith("blob:")));
});
