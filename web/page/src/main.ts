// The page: what is where, and what happens when.

import type { Options } from "../../package/dist/index.js";
import { Client, Refusal } from "./client.js";
import { type Theme, themeOf } from "./colours.js";
import * as d from "./document.js";
import { Drawing } from "./drawing.js";
import { EXAMPLES, download, stem } from "./files.js";
import { gridOf } from "./grid.js";
import { LONGEST, fromFragment, toFragment } from "./link.js";
import { element, listNotes, optionsOf, plural, sentence, showCounts, showFacts, showGrid, showHistogram, showLegend, showOptions } from "./panel.js";
import { showSliders, startSliders } from "./sliders.js";
import type { Facts, Fault, MeshAnswer, Overlaid, Overlays } from "./protocol.js";

/** Progress is shown of work that takes longer, milliseconds. */
const PATIENCE = 250;

const client = new Client(new URL("worker.js", import.meta.url), new URL("hexdel.wasm", import.meta.url));
const dark = matchMedia("(prefers-color-scheme: dark)");

let history = new d.History(d.EMPTY);
let name = "mesh";
let options: Options = {};
let facts: Facts | undefined;
/** What is to be meshed next, and whether something is being meshed. */
let wanted: { live: boolean; anew: boolean } | undefined;
let working: { live: boolean } | undefined;
/** Whether the drag that goes on is not followed. */
let futile = false;
let clock: ReturnType<typeof setTimeout> | undefined;
/** Files that are being opened. */
let opening = 0;

const drawing = new Drawing(element<HTMLCanvasElement>("canvas"), {
  doc: () => history.current,
  edit(doc, live, continues) {
    history.push(doc, continues);
    changed(live);
  },
  undo,
  redo,
  escape: () => client.busy && cancel(),
  toolChanged(tool) {
    for (const button of document.querySelectorAll<HTMLButtonElement>("[data-tool]")) {
      button.setAttribute("aria-pressed", String(button.dataset["tool"] === tool));
    }
  },
  say: (text) => (element("status").textContent = text),
});

/** For tests: what the page knows. */
declare global {
  var hexdelPage: {
    idle(): boolean;
    document(): d.Document;
    facts(): Facts | undefined;
    drawing: Drawing;
    updates: number;
    file(format: string): Promise<Uint8Array>;
  };
}
globalThis.hexdelPage = {
  idle: () => opening === 0 && working === undefined && wanted === undefined && !client.busy,
  document: () => history.current,
  facts: () => facts,
  drawing,
  updates: 0,
  file: (format) => client.ask({ kind: "write", format }),
};

/** Follows a change of the input. */
function changed(live = false): void {
  showCounts(history.current);
  element("hint").hidden = history.current.points.length > 0;
  element<HTMLButtonElement>("undo").disabled = !history.canUndo;
  element<HTMLButtonElement>("redo").disabled = !history.canRedo;
  want(live);
  drawing.refresh();
}

/** Asks for a mesh. Work for an older input that nobody waits for is ended. */
function want(live: boolean, anew = false): void {
  futile &&= live;
  if (futile) {
    return;
  }
  wanted = { live, anew };
  const slow = live || !element("progress").hidden;
  if (working && !working.live && slow && !(live && drawing.hasSession)) {
    client.cancel();
    drawing.hasSession = false;
  }
  void work();
}

/** Meshes until nothing is wanted any more. */
async function work(): Promise<void> {
  if (working || !wanted) {
    return;
  }
  const { live, anew } = wanted;
  const doc = history.current;
  wanted = undefined;
  if (doc.points.length === 0) {
    showMesh(undefined, false);
    return;
  }
  working = { live };
  clock = setTimeout(() => (element("progress").hidden = false), PATIENCE);
  try {
    const answer = await client.ask({ kind: "mesh", doc, options, live, anew, overlays: overlaysOf() });
    showFault(undefined);
    if (answer) {
      globalThis.hexdelPage.updates += 1;
      showMesh(answer, live);
    } else {
      // A session that has no room here may have some at the next place.
      futile = !drawing.hasSession;
    }
  } catch (error) {
    refused(error);
  } finally {
    clearTimeout(clock);
    element("progress").hidden = true;
    working = undefined;
  }
  void work();
}

function refused(error: unknown): void {
  if (!(error instanceof Refusal)) {
    throw error;
  }
  if (error.fault.kind === "cancelled") {
    if (!wanted) {
      element("status").textContent = "Cancelled.";
    }
    return;
  }
  showFault(error.fault);
}

function cancel(): void {
  wanted = undefined;
  drawing.hasSession = false;
  client.cancel();
}

client.onprogress = (phase, part) => {
  element<HTMLProgressElement>("bar").value = part;
  element("phase").textContent = `Meshing: ${phase}`;
};

function showMesh(answer: MeshAnswer | undefined, live: boolean): void {
  const next = answer?.facts;
  if (!answer) {
    facts = undefined;
    drawing.setMesh(undefined);
    element("status").textContent = "Nothing to mesh yet.";
  } else {
    const least = next?.bounds[0] ?? facts?.bounds[0] ?? 43.9;
    drawing.setMesh({ ...answer, least: Math.min(least, 59) });
    // Where a drag is followed fast, the figures come now and then.
    facts = next ?? facts;
    drawing.hasSession = answer.hasSession;
    showGridLegend(answer);
  }
  if (answer && !next) {
    return;
  }
  showFacts(facts, live);
  showHistogram(facts);
  showLegend(Math.min(facts?.bounds[0] ?? 43.9, 59), dark.matches);
  element("anew").hidden = live || !answer?.stepwise;
  if (answer && next) {
    const notes = [...next.notes.failed, ...next.notes.exempt].slice(0, 200);
    drawing.setNotes(notes.map(({ x, y }) => ({ at: [x, y], kind: "note", label: "" })));
    if (!live) {
      element("status").textContent = sentence(answer, next);
    }
  }
}

/** What the controls want to be shown over the mesh. */
function overlaysOf(): Overlays {
  const grid = element<HTMLSelectElement>("hexagons").value;
  return { dual: element<HTMLInputElement>("voronoi").checked, hexagons: grid !== "" };
}

async function showOverlays(): Promise<void> {
  const grid = element<HTMLSelectElement>("hexagons").value;
  drawing.setGridBy(grid === "classes" ? "classes" : "levels");
  const none: Overlaid = { dual: undefined, hexagons: undefined };
  const shown = facts ? await client.ask({ kind: "overlays", overlays: overlaysOf() }) : none;
  drawing.setOverlays(shown);
  showGridLegend(shown);
}

function showGridLegend({ hexagons }: Overlaid): void {
  element("hexagons-note").hidden = !overlaysOf().hexagons || hexagons !== undefined;
  showGrid(hexagons && gridOf(hexagons, drawing.gridBy, dark.matches));
}

/** Shows an error where it is, in the library's words. */
function showFault(fault: Fault | undefined): void {
  element("fault").hidden = fault === undefined;
  drawing.setFault(fault && { at: placeOf(fault), kind: "fault", label: labelOf(fault) });
  if (fault) {
    element("fault-text").textContent = fault.message;
    const mendable = ["too_close", "crossing", "overlap", "zero_length", "duplicate"].includes(fault.kind);
    element("fault-repair").hidden = !mendable || history.current.segments.length === 0 || options.repair === true;
    element("status").textContent = facts ? "Not meshed. The mesh before is shown." : "Not meshed.";
    if (facts) {
      element("verdict").textContent = `Of the mesh before: ${facts.holds ? "holds" : "does not hold"}.`;
    }
  }
}

function labelOf(fault: Fault): string {
  const { item, index } = fault;
  return item && index.length > 0 ? `${item}${index.length > 1 ? "s" : ""} ${index.join(", ")}` : "";
}

function placeOf(fault: Fault): d.Place | undefined {
  const { points, segments, holes } = history.current;
  const [index] = fault.index;
  if (fault.location || index === undefined) {
    return fault.location;
  }
  switch (fault.item) {
    case "point":
      return d.place(points, index);
    case "segment":
      return d.place(points, segments[2 * index] ?? 0);
    case "hole":
      return d.place(holes, index);
    default:
      return undefined;
  }
}

function undo(): void {
  history.undo();
  drawing.endChain();
  changed();
}

function redo(): void {
  history.redo();
  changed();
}

/** Begins with another input. */
function open(doc: d.Document, called: string, warnings: readonly string[] = []): void {
  history.push(doc);
  name = called;
  listNotes(element("read-notes"), warnings);
  facts = undefined;
  showFacts(undefined, false);
  showHistogram(undefined);
  drawing.hasSession = false;
  drawing.begin();
  changed();
}

async function openFile(file: File): Promise<void> {
  opening += 1;
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    const { doc, warnings } = await client.ask({ kind: "read", bytes, name: file.name });
    showFault(undefined);
    open(doc, stem(file.name), warnings);
  } catch (error) {
    refused(error);
  } finally {
    opening -= 1;
  }
}

async function openExample(index: number): Promise<void> {
  const example = EXAMPLES[index];
  if (!example) {
    return;
  }
  opening += 1;
  try {
    if ("kind" in example) {
      open(await client.ask({ kind: "generate", of: example.kind, count: example.count }), example.kind);
    } else {
      const response = await fetch(new URL(`examples/${example.file}`, import.meta.url));
      await openFile(new File([await response.arrayBuffer()], example.file));
    }
  } catch (error) {
    refused(error);
  } finally {
    opening -= 1;
  }
}

async function save(): Promise<void> {
  if (!facts) {
    element("status").textContent = "There is no mesh to save.";
    return;
  }
  const format = element<HTMLSelectElement>("format").value;
  try {
    if (format === "png") {
      download(`${name}.png`, await drawing.picture());
      return;
    }
    for (const part of format.split("+")) {
      download(`${name}.${part}`, (await client.ask({ kind: "write", format: part })) as BlobPart);
    }
  } catch (error) {
    refused(error);
  }
}

/** The input as text: Triangle's formats, of points with heights a table. Numbers read back to the same bits. */
async function saveInput(): Promise<void> {
  const doc = history.current;
  const { points, segments, holes, regions } = doc;
  const n = d.count(doc);
  const heights = doc.heights.length > 0 ? await client.ask({ kind: "heights", doc }) : doc.heights;
  if (heights.length > 0 && n.segments === 0) {
    const row = (z: number, i: number) => `${points[2 * i]},${points[2 * i + 1]},${z}\n`;
    download(`${name}.csv`, `x,y,z\n${[...heights].map(row).join("")}`, "text/csv");
    return;
  }
  const rows = (flat: ArrayLike<number>) =>
    Array.from({ length: flat.length / 2 }, (_, i) => `${i} ${flat[2 * i]} ${flat[2 * i + 1]}\n`).join("");
  const point = (i: number) => `${i} ${points[2 * i]} ${points[2 * i + 1]}${heights.length > 0 ? ` ${heights[i]}` : ""}\n`;
  let text = `${n.points} 2 ${heights.length > 0 ? 1 : 0} 0\n${Array.from({ length: n.points }, (_, i) => point(i)).join("")}`;
  if (n.segments > 0) {
    text += `${n.segments} 0\n${rows(segments)}${n.holes}\n${rows(holes)}`;
    const region = (r: (typeof regions)[number], i: number) =>
      `${i} ${r.point[0]} ${r.point[1]} ${r.attribute ?? 0} ${r.maxArea ?? -1}\n`;
    text += regions.length > 0 ? `${regions.length}\n${regions.map(region).join("")}` : "";
  }
  download(`${name}.${n.segments > 0 ? "poly" : "node"}`, text, "text/plain");
}

async function copyLink(): Promise<void> {
  const fragment = await toFragment(history.current, options);
  if (fragment.length > LONGEST) {
    element("status").textContent = `The input is too large for a link: ${plural(fragment.length, "character")}.`;
    return;
  }
  window.history.replaceState(null, "", fragment);
  try {
    await navigator.clipboard.writeText(location.href);
    element("status").textContent = "The link is copied.";
  } catch {
    element("status").textContent = "The link is in the address bar.";
  }
}

/** Opens what the address holds. Whether it holds anything, be it damaged. */
async function openLink(): Promise<boolean> {
  try {
    const held = await fromFragment(location.hash);
    if (!held) {
      return false;
    }
    options = held.options;
    showOptions(options);
    showSliders();
    open(held.doc, "mesh");
    return true;
  } catch {
    showFault({ kind: "link", message: "the link is damaged", item: undefined, index: [], location: undefined, least: undefined });
    return true;
  }
}

/** Takes formats off the list that this version of the library does not write. */
async function offerFormats(): Promise<void> {
  const known = ["png", ...(await client.ask({ kind: "formats" }))];
  for (const option of [...element<HTMLSelectElement>("format").options]) {
    if (!option.value.split("+").every((name) => known.includes(name))) {
      option.remove();
    }
  }
}

function connect(): void {
  const on = (id: string, event: string, act: () => void) => element(id).addEventListener(event, act);
  for (const button of document.querySelectorAll<HTMLButtonElement>("[data-tool]")) {
    button.addEventListener("click", () => drawing.setTool(button.dataset["tool"] ?? "points"));
  }
  on("undo", "click", undo);
  on("redo", "click", redo);
  on("clear", "click", () => open(d.EMPTY, "mesh"));
  on("zoom-in", "click", () => drawing.zoom(1.5));
  on("zoom-out", "click", () => drawing.zoom(1 / 1.5));
  on("fit", "click", () => drawing.fit());
  on("cancel", "click", cancel);
  on("anew", "click", () => want(false, true));
  on("save", "click", () => void save());
  on("save-input", "click", () => void saveInput().catch(refused));
  on("link", "click", () => void copyLink());
  on("fault-repair", "click", () => {
    element<HTMLInputElement>("repair").checked = true;
    optionsChanged();
  });
  for (const id of ["min-angle", "max-angle", "size", "max-area", "effort", "method", "domain", "repair"]) {
    on(id, "change", optionsChanged);
  }
  startSliders(() => history.current);
  for (const id of ["voronoi", "hexagons"]) {
    on(id, "change", () => void showOverlays().catch(refused));
  }
  const example = element<HTMLSelectElement>("example");
  example.append(new Option("choose", ""), ...EXAMPLES.map((e, i) => new Option(e.name, String(i))));
  on("example", "change", () => example.value !== "" && void openExample(Number(example.value)));
  const file = element<HTMLInputElement>("file");
  on("file", "change", () => file.files?.[0] && void openFile(file.files[0]));
  const stage = element("stage");
  stage.addEventListener("dragover", (event) => {
    event.preventDefault();
    stage.classList.add("dropping");
  });
  stage.addEventListener("dragleave", () => stage.classList.remove("dropping"));
  stage.addEventListener("drop", (event) => {
    event.preventDefault();
    stage.classList.remove("dropping");
    const dropped = event.dataTransfer?.files[0];
    if (dropped) {
      void openFile(dropped);
    }
  });
  dark.addEventListener("change", themed);
  addEventListener("hashchange", () => void openLink());
}

function optionsChanged(): void {
  const chosen = optionsOf();
  if (chosen) {
    options = chosen;
    drawing.hasSession = false;
    want(false);
  }
}

function themed(): void {
  const theme: Theme = themeOf(dark.matches);
  drawing.setTheme(theme);
  showLegend(Math.min(facts?.bounds[0] ?? 43.9, 59), dark.matches);
  showGridLegend(drawing.overlays);
}

connect();
themed();
changed();
// A worker that was ended early says nothing; saving would then.
offerFormats().catch(() => {});
void openLink().then((opened) => (opened ? undefined : openExample(0)));
