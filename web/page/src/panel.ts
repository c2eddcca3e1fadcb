// The panel: options in, certificate and histogram out.

import type { Notes, Options } from "../../package/dist/index.js";
import { STEPS, scaleColour } from "./colours.js";
import { type Document, count } from "./document.js";
import type { Grid } from "./grid.js";
import type { Facts, MeshAnswer } from "./protocol.js";

/** Remarks that are listed; the rest is counted. */
const LISTED = 50;

export function element<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) {
    throw new Error(`the page has no element ${id}`);
  }
  return found as T;
}

/** The options that the controls say; nothing if one of them is no number. */
export function optionsOf(): Options | undefined {
  const fields = ["min-angle", "max-angle", "size", "max-area"].map((id) => element<HTMLInputElement>(id));
  if (fields.some((field) => field.validity.badInput)) {
    return undefined;
  }
  const [minAngle, maxAngle, size, maxArea] = fields.map((f) => (f.value === "" ? undefined : Number(f.value)));
  const chosen = (id: string) => element<HTMLSelectElement>(id).value;
  const domain = chosen("domain") as NonNullable<Options["domain"]> | "";
  return {
    ...(minAngle === undefined ? {} : { minAngle }),
    ...(maxAngle === undefined ? {} : { maxAngle }),
    ...(size === undefined ? {} : { size }),
    ...(maxArea === undefined ? {} : { maxArea }),
    ...(chosen("effort") === "standard" ? {} : { effort: chosen("effort") as NonNullable<Options["effort"]> }),
    ...(chosen("method") === "compact" ? {} : { method: chosen("method") as NonNullable<Options["method"]> }),
    ...(domain === "" ? {} : { domain }),
    ...(element<HTMLInputElement>("repair").checked ? { repair: true } : {}),
  };
}

/** Sets the controls. */
export function showOptions(options: Options): void {
  const numbers = { "min-angle": options.minAngle, "max-angle": options.maxAngle, size: options.size, "max-area": options.maxArea };
  for (const [id, value] of Object.entries(numbers)) {
    element<HTMLInputElement>(id).value = typeof value === "number" ? String(value) : "";
  }
  element<HTMLSelectElement>("effort").value = options.effort ?? "standard";
  element<HTMLSelectElement>("method").value = options.method ?? "compact";
  element<HTMLSelectElement>("domain").value = options.domain ?? "";
  element<HTMLInputElement>("repair").checked = options.repair === true;
}

export function showCounts(doc: Document): void {
  const n = count(doc);
  const parts = [plural(n.points, "point"), plural(n.segments, "segment"), plural(n.holes, "hole")];
  const regions = doc.regions.length > 0 ? `, ${plural(doc.regions.length, "region")}` : "";
  element("counts").textContent = `${parts.join(", ")}${regions}`;
}

export function plural(n: number, word: string): string {
  return `${n.toLocaleString("en")} ${word}${n === 1 ? "" : "s"}`;
}

/** A mesh in a sentence. */
export function sentence(mesh: MeshAnswer, facts: Facts): string {
  const [low, high] = facts.angles;
  const how = mesh.stepwise ? ", changed step by step" : "";
  return (
    `${plural(facts.triangles, "triangle")}, angles ${low.toFixed(2)} to ${high.toFixed(2)} degrees, ` +
    `${facts.holds ? "certified" : "not as promised"}, ${mesh.seconds.toFixed(2)} s${how}.`
  );
}

/** A bound without zeros at its end. */
function shortly(angle: number): string {
  return String(Number(angle.toFixed(3)));
}

/** The certificate; `live` is whether it is of a draft, while something is dragged. */
export function showFacts(facts: Facts | undefined, live: boolean): void {
  const verdict = element("verdict");
  const list = element("certificate");
  list.replaceChildren();
  element("notes").replaceChildren();
  if (!facts) {
    verdict.textContent = "No mesh yet.";
    verdict.className = "verdict";
    return;
  }
  const holds = facts.holds ? "Holds: checked from scratch." : "Does not hold.";
  verdict.textContent = live ? `A draft while dragging. ${holds}` : holds;
  verdict.className = facts.holds ? "verdict good" : "verdict bad";
  const excused = facts.notes.exempt.length;
  const rows: [string, string][] = [
    ["Triangles", facts.triangles.toLocaleString("en")],
    ["Vertices", facts.vertices.toLocaleString("en")],
    ["Angles", `${facts.angles[0].toFixed(3)}° to ${facts.angles[1].toFixed(3)}°`],
    ["Bounds", `${shortly(facts.bounds[0])}° to ${shortly(facts.bounds[1])}°`],
    ["Out of bounds", excused > 0 ? `${facts.outOfBounds} (${excused} exempt)` : String(facts.outOfBounds)],
    ["Delaunay", facts.delaunay ? "yes, exactly" : "no"],
    ["One disk", facts.disk ? "yes" : "no"],
    ["Points kept", `${facts.kept} of ${facts.inputs}`],
    ["Aspect ratio", facts.aspect.toFixed(4)],
    ["Shortest edge", facts.shortest.toPrecision(4)],
  ];
  for (const [name, value] of rows) {
    const [dt, dd] = [document.createElement("dt"), document.createElement("dd")];
    dt.textContent = name;
    dd.textContent = value;
    list.append(dt, dd);
  }
  listNotes(element("notes"), remarksOf(facts.notes));
}

/** All remarks in words. */
export function remarksOf(notes: Notes): string[] {
  const named = (name: string, list: Notes["failed"]) => list.map(({ text }) => `${name}: ${text}`);
  return [
    ...named("failed", notes.failed),
    ...named("exempt", notes.exempt),
    ...named("repaired", notes.repairs),
    ...named("warning", notes.warnings),
  ];
}

export function listNotes(list: HTMLElement, texts: readonly string[]): void {
  const shown = texts.slice(0, LISTED);
  if (texts.length > LISTED) {
    shown.push(`and ${texts.length - LISTED} more`);
  }
  list.replaceChildren(
    ...shown.map((text) => {
      const item = document.createElement("li");
      item.textContent = text;
      return item;
    }),
  );
}

const SVG = "http://www.w3.org/2000/svg";

function svg(name: string, attributes: Record<string, string | number>): SVGElement {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, String(value));
  }
  return made;
}

/** The angles of a mesh, a degree a bar, with the bounds. */
export function showHistogram(facts: Facts | undefined): void {
  const box = element("histogram");
  box.replaceChildren();
  if (!facts) {
    box.setAttribute("aria-label", "No histogram yet");
    return;
  }
  const { histogram, bounds } = facts;
  const degrees = 180 / histogram.length;
  const last = Math.max(histogram.findLastIndex((n) => n > 0) + 1, Math.ceil(94 / degrees));
  const [width, height, base] = [300, 110, 92];
  const most = histogram.reduce((a, b) => Math.max(a, b), 1);
  const x = (angle: number) => (angle / (last * degrees)) * width;
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" });
  for (let i = 0; i < last; i++) {
    const tall = ((histogram[i] ?? 0) / most) * (base - 4);
    const from = x(i * degrees);
    picture.append(svg("rect", { x: from + 0.2, y: base - tall, width: x(degrees) - 0.4, height: tall }));
  }
  picture.append(svg("line", { x1: 0, x2: width, y1: base, y2: base }));
  for (const bound of bounds) {
    picture.append(svg("line", { class: "bound", x1: x(bound), x2: x(bound), y1: 0, y2: base }));
  }
  for (let angle = 0; angle < last * degrees; angle += 30) {
    const label = svg("text", { x: x(angle), y: base + 13, "text-anchor": angle === 0 ? "start" : "middle" });
    label.textContent = `${angle}°`;
    picture.append(label);
  }
  box.append(picture);
  const total = histogram.reduce((a, b) => a + b, 0);
  const share = (from: number, to: number) => {
    const inside = histogram.filter((_, i) => i * degrees >= from && i * degrees < to).reduce((a, b) => a + b, 0);
    return `${Math.round((100 * inside) / total)} % from ${from} to ${to} degrees`;
  };
  const text = [share(0, 44), share(44, 50), share(50, 70), share(70, 90)].join(", ");
  box.setAttribute("aria-label", `Histogram of ${total} angles: ${text}`);
}

/** The scale of colours. */
export function showLegend(least: number, dark: boolean): void {
  const canvas = element<HTMLCanvasElement>("legend");
  const context = canvas.getContext("2d");
  for (let i = 0; i < STEPS && context; i++) {
    context.fillStyle = `rgb(${scaleColour((i + 0.5) / STEPS, dark).join(" ")})`;
    context.fillRect((i * canvas.width) / STEPS, 0, canvas.width / STEPS + 1, canvas.height);
  }
  element("legend-low").textContent = least.toFixed(1);
}

/** What the hexagons over the mesh are; none if there are none. */
export function showGrid(grid: Grid | undefined): void {
  const list = element("grid-legend");
  list.hidden = grid === undefined;
  const items = grid?.kinds.filter(({ count }) => count > 0) ?? [];
  list.replaceChildren(
    ...items.map(({ code, name, fill, ink, count }) => {
      const [item, swatch, words] = [document.createElement("li"), document.createElement("span"), document.createElement("span")];
      swatch.className = "swatch";
      swatch.textContent = code;
      swatch.style.backgroundColor = fill;
      swatch.style.color = ink;
      swatch.setAttribute("aria-hidden", "true");
      words.textContent = `${name}: ${count.toLocaleString("en")}`;
      item.append(swatch, words);
      return item;
    }),
  );
}
