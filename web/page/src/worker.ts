// The worker: holds the mesh and, of some thousand points, its session.

import { HexdelError, Input, Mesh, Session, formats, generate, init, input, mesh, read } from "../../package/dist/index.js";
import type { Options, Progress } from "../../package/dist/index.js";
import { EMPTY, type Document } from "./document.js";
import type { Fault, Facts, FromWorker, MeshAnswer, ReadAnswer, Request, ToWorker } from "./protocol.js";

/** From so many points on, a change is made in a session; fewer are meshed anew as fast. */
const LEAST_FOR_SESSIONS = 400;
const MOST_FOR_SESSIONS = 5000;

/** So many points may change in a session at once. */
const STEPS = 8;

/** Milliseconds between two reports of progress. */
const TELL_EVERY = 60;

/** Bins of the histogram: a degree each. */
const BINS = 180;

let ready: Promise<void>;
let made: Mesh | undefined;
let session: { session: Session; options: string; ids: Map<string, number> } | undefined;

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
      const answer = meshed(request, progress);
      return [answer, [answer.vertices.buffer, answer.triangles.buffer, answer.angles.buffer] as Transferable[]];
    }
    case "read":
      return [opened(request.bytes, request.name), []];
    case "generate":
      return [{ ...EMPTY, points: generate(request.of, request.count) } satisfies Document, []];
    case "write":
      return [present().write(request.format), []];
    case "formats":
      return [formats(), []];
    case "dual":
      return [present().dual(), []];
    case "hexagons":
      return [present().hexagons(), []];
  }
}

function present(): Mesh {
  if (!made) {
    throw new HexdelError({ kind: "empty", message: "there is no mesh yet" });
  }
  return made;
}

function meshed(request: Request & { kind: "mesh" }, progress: Progress): MeshAnswer {
  const { doc, options, live, anew } = request;
  const begun = performance.now();
  const stepwise = !anew && follows(doc, options, live);
  if (stepwise && live && session) {
    const arrays = session.session.arrays();
    const angles = smallestAngles(arrays.vertices, arrays.triangles);
    const seconds = (performance.now() - begun) / 1000;
    return { ...arrays, angles, edges: new Uint32Array(), facts: undefined, stepwise, hasSession: true, seconds };
  }
  const quick: Options = live ? { ...options, effort: "fast" } : options;
  const next = stepwise && session ? session.session.mesh() : whole(doc, quick, progress);
  made?.free();
  made = next;
  if (!stepwise) {
    session?.session.free();
    session = undefined;
    if (!live) {
      begin(doc, options);
    }
  }
  return {
    vertices: made.vertices,
    triangles: made.triangles,
    angles: made.smallestAngles(),
    edges: made.segmentEdges,
    facts: factsOf(made),
    stepwise,
    hasSession: session !== undefined,
    seconds: (performance.now() - begun) / 1000,
  };
}

function whole(doc: Document, options: Options, progress: Progress): Mesh {
  const graph = input(doc);
  try {
    return mesh(graph, options, progress);
  } finally {
    graph.free();
  }
}

/** Begins a session of the mesh that was made, if its points are as many as that is for. */
function begin(doc: Document, options: Options): void {
  const count = doc.points.length / 2;
  const fits = count >= LEAST_FOR_SESSIONS && count <= MOST_FOR_SESSIONS && doc.segments.length === 0;
  const compact = (options.method ?? "compact") === "compact" && options.effort !== "fast";
  const plain = options.domain === undefined || options.domain === "hexagon";
  if (!made || !fits || !compact || !plain) {
    return;
  }
  try {
    const begun = made.session();
    const [ids, points] = [begun.ids, begun.points];
    const byPlace = new Map<string, number>();
    ids.forEach((id, i) => byPlace.set(key(points, i), id));
    session = { session: begun, options: JSON.stringify(options), ids: byPlace };
  } catch {
    // Duplicates have no session; they are meshed anew.
  }
}

/** Whether the session follows. What it refuses is tried anew when nothing is being dragged. */
function follows(doc: Document, options: Options, live: boolean): boolean {
  try {
    return stepped(doc, options);
  } catch (error) {
    if (live) {
      throw error;
    }
    return false;
  }
}

/** Brings the session to the document, if few points differ. */
function stepped(doc: Document, options: Options): boolean {
  if (!session || session.options !== JSON.stringify(options) || doc.segments.length > 0) {
    return false;
  }
  const wanted = new Set<string>();
  const inserted: [number, number][] = [];
  for (let i = 0; i < doc.points.length / 2; i++) {
    const name = key(doc.points, i);
    wanted.add(name);
    if (!session.ids.has(name)) {
      inserted.push([doc.points[2 * i] ?? NaN, doc.points[2 * i + 1] ?? NaN]);
    }
  }
  const removed = [...session.ids].filter(([name]) => !wanted.has(name));
  if (inserted.length > STEPS || removed.length > STEPS) {
    return false;
  }
  if (inserted.length + removed.length === 0) {
    return true;
  }
  const ids = removed.map(([, id]) => id);
  const deltas = ids.length > 0 ? session.session.replace(ids, inserted) : session.session.insert(inserted);
  removed.forEach(([name]) => session?.ids.delete(name));
  const numbers = deltas.at(-1)?.points ?? new Float64Array();
  inserted.forEach(([x, y], i) => session?.ids.set(`${x},${y}`, numbers[i] ?? 0));
  return true;
}

function key(points: Float64Array, i: number): string {
  return `${points[2 * i]},${points[2 * i + 1]}`;
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
  const { points, segments, holes, regions, pointMarkers, segmentMarkers, warnings } = graph;
  const columns = graph.columns === undefined ? [] : [`columns: ${graph.columns}`];
  const doc = { points, segments, holes, regions, pointMarkers, segmentMarkers };
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
