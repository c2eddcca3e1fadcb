// What the page and its worker say to each other.

import type { Dual, Hexagons, Kind, Notes, Options, Phase } from "../../package/dist/index.js";
import type { Document } from "./document.js";

/** What is shown over a mesh. */
export interface Overlays {
  readonly dual: boolean;
  readonly hexagons: boolean;
}

export interface MeshRequest {
  readonly kind: "mesh";
  readonly doc: Document;
  readonly options: Options;
  /** Whether something is being dragged: what there is soon is enough. */
  readonly live: boolean;
  /** Whether a session is not to be followed. */
  readonly anew: boolean;
  readonly overlays: Overlays;
}

/** A question of the page. */
export type Request =
  | MeshRequest
  | { readonly kind: "read"; readonly bytes: Uint8Array; readonly name: string }
  | { readonly kind: "generate"; readonly of: Kind; readonly count: number }
  | { readonly kind: "write"; readonly format: string }
  | { readonly kind: "formats" }
  | { readonly kind: "heights"; readonly doc: Document }
  | { readonly kind: "overlays"; readonly overlays: Overlays };

/** What is known of a mesh beside its arrays. */
export interface Facts {
  readonly holds: boolean;
  readonly bounds: readonly [number, number];
  readonly angles: readonly [number, number];
  readonly vertices: number;
  readonly triangles: number;
  readonly aspect: number;
  readonly shortest: number;
  readonly delaunay: boolean;
  readonly disk: boolean;
  readonly outOfBounds: number;
  readonly inputs: number;
  readonly kept: number;
  readonly notes: Notes;
  readonly histogram: Uint32Array;
}

/** What is shown over a mesh, as far as it was asked for and there is any. */
export interface Overlaid {
  readonly dual: Dual | undefined;
  readonly hexagons: Hexagons | undefined;
}

export interface MeshAnswer extends Overlaid {
  readonly vertices: Float64Array;
  readonly triangles: Uint32Array;
  /** The smallest angle of each triangle, degrees. */
  readonly angles: Float32Array;
  /** Pairs of vertices on segments. */
  readonly edges: Uint32Array;
  /** None where a drag goes on and they would take longer than the change. */
  readonly facts: Facts | undefined;
  /** Whether the mesh was changed step by step. */
  readonly stepwise: boolean;
  /** Whether changes of points will be steps of a session. */
  readonly hasSession: boolean;
  /** Seconds that it took. */
  readonly seconds: number;
}

/** What an error is about. */
export interface Fault {
  readonly kind: string;
  readonly message: string;
  readonly item: string | undefined;
  readonly index: readonly number[];
  readonly location: readonly [number, number] | undefined;
  readonly least: number | undefined;
}

export interface ReadAnswer {
  readonly doc: Document;
  readonly warnings: readonly string[];
}

/** The answers, by kind of question. */
export interface Answers {
  /** None if there is no mesh soon for the place that a drag has come to. */
  mesh: MeshAnswer | undefined;
  read: ReadAnswer;
  generate: Document;
  write: Uint8Array;
  formats: readonly string[];
  heights: Float64Array;
  overlays: Overlaid;
}

/** What goes to the worker: the module first, then questions. */
export type ToWorker =
  | { readonly module: WebAssembly.Module }
  | { readonly id: number; readonly request: Request };

/** What comes from it. */
export type FromWorker =
  | { readonly id: number; readonly answer: unknown }
  | { readonly id: number; readonly fault: Fault }
  | { readonly id: number; readonly phase: Phase; readonly done: number; readonly total: number };
