// The interface: meshes, graphs, sessions.

import { RawGraph, RawMesh, RawSession, generate as rawGenerate, mesh as rawMesh, mesh_formats } from "../wasm/hexdel_web.js";
import { HexdelError, guarded } from "./errors.js";
import type {
  Certificate, Delta, Dual, Format, Hexagons, Kind, Notes, Options, Points, Progress, Pslg, Region, Segments,
} from "./types.js";

export { HexdelError } from "./errors.js";
export type * from "./types.js";

/** Points or a PSLG as read from a file, with all that the format tells. */
export class Input {
  /** @internal */
  constructor(/** @internal */ readonly raw: RawGraph) {}

  /** x and y by turns. */
  get points(): Float64Array {
    return this.raw.points;
  }

  /** Indices of points, two by two. */
  get segments(): Uint32Array {
    return this.raw.segments;
  }

  /** x and y by turns. */
  get holes(): Float64Array {
    return this.raw.holes;
  }

  get regions(): Region[] {
    const flat = this.raw.regions;
    const regions: Region[] = [];
    for (let i = 0; i < flat.length; i += 4) {
      const [x, y, attribute, maxArea] = flat.subarray(i, i + 4) as unknown as [number, number, number, number];
      regions.push(maxArea > 0 ? { point: [x, y], attribute, maxArea } : { point: [x, y], attribute });
    }
    return regions;
  }

  get pointMarkers(): Int32Array {
    return this.raw.point_markers;
  }

  /** The height of each point; empty if they have none. */
  get heights(): Float64Array {
    return this.raw.point_heights;
  }

  get segmentMarkers(): Int32Array {
    return this.raw.segment_markers;
  }

  /** What was mended, or could have been meant otherwise. */
  get warnings(): string[] {
    return JSON.parse(guarded(() => this.raw.warnings)) as string[];
  }

  /** Which columns of a table were taken. */
  get columns(): string | undefined {
    return this.raw.columns;
  }

  /** Whether there are polygons, whose borders are among the segments. */
  get hasPolygons(): boolean {
    return this.raw.has_polygons;
  }

  /** The same with holes and regions in place of polygons. */
  prepared(options: Options = {}): Input {
    return new Input(guarded(() => this.raw.prepared(json(options))));
  }

  /** The points or the PSLG as a file: `node`, `poly`, `csv`, `json` … */
  write(format: string): Uint8Array {
    return guarded(() => this.raw.write(format));
  }

  /** Gives its memory back at once. */
  free(): void {
    this.raw.free();
  }
}

/** A certified mesh. Arrays are copies: each access makes one. */
export class Mesh {
  /** @internal */
  constructor(private readonly raw: RawMesh) {}

  /** x and y of the vertices by turns. */
  get vertices(): Float64Array {
    return this.raw.vertices;
  }

  /** Corners of the triangles, three by three, counter-clockwise. */
  get triangles(): Uint32Array {
    return this.raw.triangles;
  }

  /** For each vertex the first input point that it is, or -1. */
  get inputOfVertex(): Int32Array {
    return this.raw.input_of_vertex;
  }

  /** The vertex of each input point, or -1. */
  get vertexOfInput(): Int32Array {
    return this.raw.vertex_of_input;
  }

  /** Of a PSLG: a marker of each vertex. */
  get vertexMarkers(): Int32Array {
    return this.raw.vertex_markers;
  }

  /** Of a PSLG: the edges on segments and the boundary, as pairs of vertices. */
  get segmentEdges(): Uint32Array {
    return this.raw.segment_edges;
  }

  get segmentEdgeMarkers(): Int32Array {
    return this.raw.segment_edge_markers;
  }

  /** The attribute of each triangle's region; empty if there are no regions. */
  get regions(): Float64Array {
    return this.raw.regions;
  }

  /** The height of each vertex, linear between points; empty if the points have none. */
  get heights(): Float64Array {
    return this.raw.vertex_heights;
  }

  /** Whether everything that was promised is so. */
  get holds(): boolean {
    return this.raw.holds;
  }

  /** Whether optimisation ended because its budget was spent. */
  get budgetSpent(): boolean {
    return this.raw.budget_spent;
  }

  get certificate(): Certificate {
    return JSON.parse(guarded(() => this.raw.certificate)) as Certificate;
  }

  /** The figures that the program's `--report` has. */
  report(): Record<string, unknown> {
    return JSON.parse(guarded(() => this.raw.report())) as Record<string, unknown>;
  }

  /** What is to be said of the mesh of a PSLG. */
  get notes(): Notes {
    const notes = this.raw.notes() as Notes | undefined;
    return notes ?? { failed: [], exempt: [], repairs: [], warnings: [] };
  }

  /** The smallest angle of each triangle, degrees. */
  smallestAngles(): Float32Array {
    return this.raw.smallest_angles();
  }

  /** How many angles lie in each of `bins` equal parts of 180 degrees. */
  histogram(bins = 180): Uint32Array {
    return this.raw.histogram(bins);
  }

  /** The Voronoi dual. */
  dual(): Dual {
    return guarded(() => this.raw.dual() as Dual);
  }

  /** The hexagons that the mesh began with, if it did: those of `templates` and `simple` do. */
  hexagons(): Hexagons | undefined {
    return this.raw.hexagons() as Hexagons | undefined;
  }

  /** The mesh as a file, byte for byte as the program writes it. */
  write(format: Format): Uint8Array {
    return guarded(() => this.raw.write(format));
  }

  /** The mesh of points as a session. */
  session(): Session {
    return new Session(guarded(() => RawSession.of_mesh(this.raw)));
  }

  /** Gives its memory back at once. */
  free(): void {
    this.raw.free();
  }
}

/** A mesh that points are put into, moved and taken out of. */
export class Session {
  /** @internal */
  constructor(private readonly raw: RawSession) {}

  /** The mesh of points, or of a PSLG, as a session. */
  static of(input: Points | Pslg | Input, options: Options = {}): Session {
    return borrowing(graphOf(input), (raw) => new Session(new RawSession(raw, json(options))));
  }

  /** A hexagonal domain without points. */
  static empty(centre: readonly [number, number], radius: number): Session {
    return new Session(guarded(() => RawSession.empty(centre[0], centre[1], radius)));
  }

  /** A session that was saved. */
  static load(text: string): Session {
    return new Session(guarded(() => RawSession.of_text(text)));
  }

  save(): string {
    return guarded(() => this.raw.text());
  }

  /**
   * Whether calls from now on make drafts: they do what the bounds ask for and no more, in a
   * fraction of the time. Vertices that become superfluous stay; a point outside of the domain
   * or without room is refused. For what follows a pointer: `undo` the drafts, then make the
   * call that counts.
   */
  draft(drafts = true): void {
    guarded(() => this.raw.draft(drafts));
  }

  /**
   * Puts points in, all or none. Their numbers are in the delta. Heights that are left away are
   * between those of other points.
   */
  insert(points: Points, heights: ArrayLike<number> = []): Delta[] {
    return guarded(() => this.raw.insert(flat(points), Float64Array.from(heights)) as Delta[]);
  }

  /** Takes points out by their numbers, all or none. */
  remove(ids: ArrayLike<number>): Delta[] {
    return guarded(() => this.raw.remove(Uint32Array.from(ids)) as Delta[]);
  }

  /**
   * Takes points out and puts others in: all of it or nothing, and one call to undo. As many
   * points without heights keep those of the points before.
   */
  replace(ids: ArrayLike<number>, points: Points, heights: ArrayLike<number> = []): Delta[] {
    const of = Float64Array.from(heights);
    return guarded(() => this.raw.replace(Uint32Array.from(ids), flat(points), of) as Delta[]);
  }

  /** Moves a point. It gets a new number, in the last delta, and keeps its height. */
  move(id: number, to: readonly [number, number]): Delta[] {
    return this.replace([id], [to]);
  }

  /** Takes the last call back that is not taken back yet. */
  undo(): Delta[] {
    return guarded(() => this.raw.undo() as Delta[]);
  }

  /** Meshes all points anew, as if they had come at once. */
  renew(): Delta[] {
    return guarded(() => this.raw.renew() as Delta[]);
  }

  /** Sets how long edges may be, by `size`, `gradation` and `maxArea`. */
  setSize(options: Pick<Options, "size" | "gradation" | "maxArea">): Delta[] {
    return guarded(() => this.raw.set_size(json(options)) as Delta[]);
  }

  /** Numbers of the points that are there. */
  get ids(): Uint32Array {
    return this.raw.ids;
  }

  /** Their places, x and y by turns. */
  get points(): Float64Array {
    return this.raw.points;
  }

  /** Centre and circumradius of the domain. */
  get domain(): { centre: [number, number]; radius: number } {
    const [x, y, radius] = this.raw.domain as unknown as [number, number, number];
    return { centre: [x, y], radius };
  }

  /** The mesh as it stands, certified from scratch. */
  mesh(): Mesh {
    return new Mesh(guarded(() => this.raw.mesh()));
  }

  /** Vertices and triangles as they stand, without a certificate. */
  arrays(): { vertices: Float64Array; triangles: Uint32Array } {
    return this.raw.arrays() as { vertices: Float64Array; triangles: Uint32Array };
  }

  /** Gives its memory back at once. */
  free(): void {
    this.raw.free();
  }
}

/**
 * Meshes points: every angle is between 43.89 and 90 degrees, every point is a vertex.
 *
 * @throws HexdelError
 */
export function mesh(points: Points | Input, options: Options = {}, progress?: Progress): Mesh {
  return borrowing(graphOf(points), (raw) => new Mesh(rawMesh(raw, json(options), progress)));
}

/**
 * Meshes a PSLG: angles of 30 to 90 degrees along segments, 43.89 to 90 elsewhere. Without
 * segments it is meshed as points.
 *
 * @throws HexdelError
 */
export function meshPslg(pslg: Pslg | Input, options: Options = {}, progress?: Progress): Mesh {
  return borrowing(graphOf(pslg), (raw) => new Mesh(rawMesh(raw, json(options), progress)));
}

/**
 * Reads points or a PSLG from the contents of a file. The extension of `name` says which
 * format it is: .node, .poly, .csv, .tsv, .xyz, .txt, .geojson, .wkt, .json, .ron.
 *
 * @throws HexdelError
 */
export function read(contents: Uint8Array | string, name: string): Input {
  const bytes = typeof contents === "string" ? new TextEncoder().encode(contents) : contents;
  const extension = /\.([^./\\]+)$/.exec(name)?.[1] ?? "";
  return new Input(guarded(() => RawGraph.read(bytes, extension.toLowerCase(), name)));
}

/** Points or a PSLG that are in arrays, as what files are read to. */
export function input(of: Points | Pslg): Input {
  return new Input(graphOf(of).raw);
}

/** The names of the formats that meshes are written in. */
export function formats(): Format[] {
  return guarded(() => mesh_formats());
}

/** Test points: `uniform`, `clusters` and other kinds, the same on every platform. */
export function generate(kind: Kind, count: number, seed = 1): Float64Array {
  return guarded(() => rawGenerate(kind, count, seed));
}

/** A graph of the library, and whether it is to be given back after use. */
interface Borrowed {
  readonly raw: RawGraph;
  readonly own: boolean;
}

function borrowing<T>({ raw, own }: Borrowed, use: (raw: RawGraph) => T): T {
  try {
    return guarded(() => use(raw));
  } finally {
    if (own) {
      raw.free();
    }
  }
}

function graphOf(of: Points | Pslg | Input): Borrowed {
  if (of instanceof Input) {
    return { raw: of.raw, own: false };
  }
  const graph: Pslg = "points" in of ? of : { points: of, segments: [] };
  const regions = (graph.regions ?? []).flatMap((r) => [...r.point, r.attribute ?? 0, r.maxArea ?? -1]);
  const raw = guarded(
    () =>
      new RawGraph(
        flat(graph.points),
        indices(graph.segments),
        flat(graph.holes ?? []),
        Float64Array.from(regions),
        Int32Array.from(graph.pointMarkers ?? []),
        Int32Array.from(graph.segmentMarkers ?? []),
        Float64Array.from(graph.heights ?? []),
      ),
  );
  return { raw, own: true };
}

function flat(points: Points): Float64Array {
  if (points instanceof Float64Array) {
    return points;
  }
  return Float64Array.from((points as readonly (number | readonly number[])[]).flat() as number[]);
}

function indices(segments: Segments): Uint32Array {
  if (segments instanceof Uint32Array) {
    return segments;
  }
  const all = (segments as readonly (number | readonly number[])[]).flat() as number[];
  const wrong = all.findIndex((i) => !Number.isInteger(i) || i < 0 || i > 0xffffffff);
  if (wrong >= 0) {
    const segment = Math.floor(wrong / 2);
    const message = `segment ${segment} ends at point ${all[wrong]}, which is no index`;
    throw new HexdelError({ kind: "segment_end", message, item: "segment", index: [segment] });
  }
  return Uint32Array.from(all);
}

/** Options as the library takes them. JSON has no numbers that are not finite. */
function json(options: Options): string {
  return JSON.stringify(options, (name, value: unknown) => {
    if (typeof value === "number" && !Number.isFinite(value)) {
      throw new HexdelError({ kind: "option", message: `${name} must be a finite number, got ${value}` });
    }
    return value;
  });
}
