// The worker: holds the mesh and, of up to some thousand points, a session of it.

import { HexdelError, Input, Mesh, formats, generate, init, input, mesh, read } from "../../package/dist/index.js";
import type { Options, Progress } from "../../package/dist/index.js";
import { EMPTY, type Document } from "./document.js";
import type { Fault, Facts, FromWorker, MeshAnswer, MeshRequest, Overlaid, Overlays, ReadAnswer, Request, ToWorker } from "./protocol.js";
import { Steps } from "./steps.js";

/** From so many points on, a change stays in the session; fewer are meshed anew when a drag ends. */
const LEAST_FOR_STEPS = 400;

/** More points have no session. */
const MOST_FOR_STEPS = 5000;

/** Up to so many points are meshed anew at each step of a drag that no session follows fast. */
const MOST_LIVE = 2000;

/** A drag that a session has followed so slowly, milliseconds, so often is not followed by it any more: of few points. */
const SLOW = 40;
const MOST_SLOW = 2;

/** Of more points a draft of the whole is slower than a slow session. */
const FEW = 500;

/** Drafts that are made in advance, once for points and once for graphs. */
const WARM_UPS = 4;

/** A draft of the whole mesh has bounds that growth keeps by itself, as meshes have along segments, degrees. */
const DRAFT_BOUNDS = [30, 90] as const;

/** While a drag goes on, the certificate is a part of so much of the time. */
const SHARE_OF_FACTS = 0.2;

/** Milliseconds between two reports of progress. */
const TELL_EVERY = 60;

/** Bins of the histogram: a degree each. */
const BINS = 180;

let ready: Promise<void>;
let made: Mesh | undefined;
let steps: Steps | undefined;
/** When a mesh that is being dragged may have its certificate next. */
let factsFrom = 0;
/** How often a session has followed the drag that goes on slowly. */
let slow = 0;
/** Whether the code that drafts points, and graphs, is compiled well by now. */
const warm = { points: false, graphs: false };

self.onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  if ("module" in data) {
    ready = init(data.module);
    return;
  }
  const { id, request } = data;
  try {
    await ready;
    const [answer, transfer] = answered(request, reporting(id));
    post({ id, answer }, transfer);
    if (request.kind === "mesh" && !request.live) {
      setTimeout(() => warmUp(request));
    }
  } catch (error) {
    post({ id, fault: faultOf(error) });
  }
};

function post(message: FromWorker, transfer: Transferable[] = []): void {
  self.postMessage(message, { transfer });
}

/** Tells of progress now and then. */
function reporting(id: number): Progress {
  let last = performance.now();
  return (phase, done, total) => {
    const now = performance.now();
    if (now - last > TELL_EVERY) {
      last = now;
      post({ id, phase, done, total });
    }
  };
}

function answered(request: Request, progress: Progress): [unknown, Transferable[]] {
  switch (request.kind) {
    case "mesh": {
      const answer = request.live ? drafted(request, progress) : meshed(request, progress);
      const arrays = answer ? [answer.vertices, answer.triangles, answer.angles, answer.edges] : [];
      return [answer, arrays.map((array) => array.buffer as ArrayBuffer)];
    }
    case "read":
      return [opened(request.bytes, request.name), []];
    case "generate":
      return [{ ...EMPTY, points: generate(request.of, request.count) } satisfies Document, []];
    case "write":
      return [present().write(request.format), []];
    case "formats":
      return [formats(), []];
    case "heights": {
      const graph = input(request.doc);
      const { heights } = graph;
      graph.free();
      return [heights, []];
    }
    case "overlays":
      return [overlaid(present(), request.overlays), []];
  }
}

function present(): Mesh {
  if (!made) {
    throw new HexdelError({ kind: "empty", message: "there is no mesh yet" });
  }
  return made;
}

/** The mesh as the options say, or the session brought to the document. */
function meshed(request: MeshRequest, progress: Progress): MeshAnswer {
  const { doc, options, anew, overlays } = request;
  const begun = performance.now();
  slow = 0;
  const stepwise = !anew && stepped(doc, options);
  show(stepwise && steps ? steps.session.mesh() : whole(doc, options, progress));
  if (!stepwise) {
    steps?.free();
    steps = begin(doc, options);
  }
  return { ...answerOf(present(), overlays), facts: factsOf(present()), stepwise, hasSession: steps !== undefined, seconds: since(begun) };
}

/** What there is soon: the session with a draft of what is dragged, or a draft of the whole. */
function drafted(request: MeshRequest, progress: Progress): MeshAnswer | undefined {
  const { doc, options, overlays } = request;
  const begun = performance.now();
  if (follows(doc, options) && steps) {
    const answer = { stepwise: true, hasSession: true };
    if (begun < factsFrom && !overlays.dual) {
      const arrays = steps.session.arrays();
      const angles = smallestAngles(arrays.vertices, arrays.triangles);
      const none = { edges: new Uint32Array(), facts: undefined, dual: undefined, hexagons: undefined };
      return { ...arrays, angles, ...none, ...answer, seconds: since(begun) };
    }
    const changed = performance.now();
    show(steps.session.mesh());
    const facts = factsOf(present());
    const now = performance.now();
    factsFrom = now + (now - changed) / SHARE_OF_FACTS;
    return { ...answerOf(present(), overlays), facts, ...answer, seconds: since(begun) };
  }
  const count = doc.points.length / 2;
  const stays = count > FEW && steps?.fits(doc, JSON.stringify(options)) === true;
  if (count > MOST_LIVE || stays) {
    return undefined;
  }
  show(whole(doc, draftOf(options), progress));
  const answer = { stepwise: false, hasSession: steps !== undefined };
  return { ...answerOf(present(), overlays), facts: factsOf(present()), ...answer, seconds: since(begun) };
}

/** Options of a draft. Those of methods that do not optimise are kept. */
function draftOf(options: Options): Options {
  if ((options.method ?? "compact") !== "compact") {
    return options;
  }
  const [least, most] = DRAFT_BOUNDS;
  const minAngle = Math.min(options.minAngle ?? least, least);
  return { ...options, effort: "draft", minAngle, maxAngle: Math.max(options.maxAngle ?? most, most) };
}

/** Drafts what nobody has asked for, so that browsers have compiled that code well when a drag begins. */
function warmUp(of: Pick<MeshRequest, "doc" | "options">, times = WARM_UPS): void {
  const { doc, options } = of;
  const kind = doc.segments.length > 0 ? "graphs" : "points";
  const count = doc.points.length / 2;
  if (warm[kind] || count > MOST_LIVE || (options.method ?? "compact") !== "compact") {
    return;
  }
  warm[kind] = times <= 1;
  try {
    whole(doc, draftOf(options), () => {}).free();
  } catch {
    // Whoever asks for it is told.
  }
  // What has been asked meanwhile comes first.
  setTimeout(() => warmUp(of, times - 1));
}

function since(begun: number): number {
  return (performance.now() - begun) / 1000;
}

/** What is saved and drawn from now on. */
function show(next: Mesh): void {
  made?.free();
  made = next;
}

function answerOf(of: Mesh, overlays: Overlays) {
  const { vertices, triangles, segmentEdges } = of;
  return { vertices, triangles, angles: of.smallestAngles(), edges: segmentEdges, ...overlaid(of, overlays) };
}

function overlaid(of: Mesh, { dual, hexagons }: Overlays): Overlaid {
  return { dual: dual ? of.dual() : undefined, hexagons: hexagons ? of.hexagons() : undefined };
}

function whole(doc: Document, options: Options, progress: Progress): Mesh {
  const graph = input(doc);
  try {
    return mesh(graph, options, progress);
  } finally {
    graph.free();
  }
}

/** The session of the mesh that was made, if it can be followed. */
function begin(doc: Document, options: Options): Steps | undefined {
  const few = doc.points.length / 2 <= MOST_FOR_STEPS && doc.segments.length === 0;
  const compact = (options.method ?? "compact") === "compact";
  const plain = options.domain === undefined || options.domain === "hexagon";
  if (!few || !compact || !plain || options.minDualEdge !== undefined) {
    return undefined;
  }
  try {
    return new Steps(present().session(), doc.points, JSON.stringify(options));
  } catch {
    // Duplicates have no session; they are meshed anew.
    return undefined;
  }
}

/** Whether the session follows a drag. Where it has no room or takes long, another mesh may not. */
function follows(doc: Document, options: Options): boolean {
  const few = doc.points.length / 2 <= FEW;
  if (!steps?.fits(doc, JSON.stringify(options)) || (few && slow >= MOST_SLOW)) {
    return false;
  }
  const begun = performance.now();
  const done = accepted(() => steps?.drag(doc));
  slow += performance.now() - begun > SLOW ? 1 : 0;
  return done;
}

/** Brings the session to the document, if few of many points differ. What it refuses is meshed anew. */
function stepped(doc: Document, options: Options): boolean {
  const many = doc.points.length / 2 >= LEAST_FOR_STEPS && options.effort !== "fast";
  if (!many || !steps?.fits(doc, JSON.stringify(options))) {
    return false;
  }
  return accepted(() => steps?.follow(doc));
}

/** Whether a call of the session was not refused. */
function accepted(call: () => void): boolean {
  try {
    call();
    return true;
  } catch (error) {
    if (error instanceof HexdelError && error.kind !== "internal") {
      return false;
    }
    throw error;
  }
}

function factsOf(made: Mesh): Facts {
  const c = made.certificate;
  return {
    holds: made.holds,
    bounds: [c.bounds.min_deg, c.bounds.max_deg],
    angles: [c.min_angle_deg, c.max_angle_deg],
    vertices: c.vertices,
    triangles: c.triangles,
    aspect: c.max_aspect_ratio,
    shortest: c.shortest_edge,
    delaunay: c.delaunay,
    disk: c.disk,
    outOfBounds: c.out_of_bounds,
    inputs: c.inputs,
    kept: c.inputs_kept,
    notes: made.notes,
    histogram: made.histogram(BINS),
  };
}

function opened(bytes: Uint8Array, name: string): ReadAnswer {
  const file: Input = read(bytes, name);
  const graph = file.hasPolygons ? file.prepared() : file;
  const { points, segments, holes, regions, pointMarkers, heights, segmentMarkers, warnings } = graph;
  const columns = graph.columns === undefined ? [] : [`columns: ${graph.columns}`];
  const doc = { points, segments, holes, regions, pointMarkers, heights, segmentMarkers };
  return { doc, warnings: [...columns, ...warnings] };
}

function smallestAngles(vertices: Float64Array, triangles: Uint32Array): Float32Array {
  const angles = new Float32Array(triangles.length / 3);
  const at = (v: number, c: number) => vertices[2 * v + c] as number;
  for (let t = 0; t < angles.length; t++) {
    const [a, b, c] = [triangles[3 * t] as number, triangles[3 * t + 1] as number, triangles[3 * t + 2] as number];
    const la = (at(b, 0) - at(c, 0)) ** 2 + (at(b, 1) - at(c, 1)) ** 2;
    const lb = (at(c, 0) - at(a, 0)) ** 2 + (at(c, 1) - at(a, 1)) ** 2;
    const lc = (at(a, 0) - at(b, 0)) ** 2 + (at(a, 1) - at(b, 1)) ** 2;
    // The smallest angle is opposite to the shortest side.
    const [least, u, v] = la <= lb && la <= lc ? [la, lb, lc] : lb <= lc ? [lb, la, lc] : [lc, la, lb];
    angles[t] = (Math.acos((u + v - least) / (2 * Math.sqrt(u * v))) * 180) / Math.PI;
  }
  return angles;
}

function faultOf(error: unknown): Fault {
  if (error instanceof HexdelError) {
    const { kind, message, item, index, location, least } = error;
    return { kind, message, item, index, location, least };
  }
  const message = error instanceof Error ? error.message : String(error);
  return { kind: "internal", message, item: undefined, index: [], location: undefined, least: undefined };
}
