// What goes in and out, beside meshes and sessions.

/** x and y by turns, or pairs. */
export type Points = Float64Array | readonly number[] | readonly (readonly [number, number])[];

/** Pairs of indices of points, from 0, flat or as pairs. */
export type Segments = Uint32Array | readonly number[] | readonly (readonly [number, number])[];

/** A part of the plane bounded by segments. */
export interface Region {
  /** A point inside. */
  readonly point: readonly [number, number];
  /** What its triangles are labelled with. */
  readonly attribute?: number;
  /** The largest area of its triangles. */
  readonly maxArea?: number;
}

/** A planar straight-line graph. */
export interface Pslg {
  readonly points: Points;
  readonly segments: Segments;
  /** A point in each part of the plane that is to be left empty. */
  readonly holes?: Points;
  readonly regions?: readonly Region[];
  readonly pointMarkers?: ArrayLike<number>;
  /** Of each point; those that are `NaN` are taken to be between the others. */
  readonly heights?: ArrayLike<number>;
  readonly segmentMarkers?: ArrayLike<number>;
}

/** How long edges may be in a polygon, or near points (`[x, y, length]`). */
export type SizePart =
  | number
  | { readonly polygon: readonly (readonly [number, number])[]; readonly length: number }
  | { readonly points: readonly (readonly [number, number, number])[] };

/** The part of the work that is being done. */
export type Phase = "refine" | "extract" | "optimize" | "certify";

/** Options, as the program has them. */
export interface Options {
  /** `compact` (the default) has the fewest triangles; `templates` is fast. */
  readonly method?: "compact" | "templates" | "simple";
  /**
   * How hard the compact method optimises; by default `standard`. `draft` keeps the bounds and
   * does no more: many triangles, soon.
   */
  readonly effort?: "draft" | "fast" | "standard" | "best" | "fewest";
  /** The smallest angle allowed, degrees. */
  readonly minAngle?: number | undefined;
  /** The largest angle allowed, degrees. */
  readonly maxAngle?: number | undefined;
  /** The shortest edge of the Voronoi dual over the edge that it crosses, up to 0.3249. */
  readonly minDualEdge?: number | undefined;
  /** The largest area of a triangle. */
  readonly maxArea?: number | undefined;
  /** How long edges may be: everywhere, or by place. */
  readonly size?: number | readonly SizePart[] | undefined;
  /** How fast sizes may change with the distance. */
  readonly gradation?: number | undefined;
  /** What the mesh covers; by default a hexagon around points, and what segments enclose. */
  readonly domain?: "hexagon" | "hull" | "box" | "inside" | undefined;
  /** Circumradius of the hexagon around points. */
  readonly domainRadius?: number | undefined;
  /** Whether to merge close points and divide crossing segments, or within which distance. */
  readonly repair?: boolean | number | undefined;
  readonly segmentMethod?: "conform" | "paper" | undefined;
  /** What overlapping polygons are: the later one counts, or an error. */
  readonly overlaps?: "later" | "refuse" | undefined;
  /** Whether hexagons are merged again where the rules allow it; on by default. */
  readonly coarsening?: boolean | undefined;
  /** Seconds after which optimisation ends. The mesh depends on the machine then. */
  readonly budget?: number | undefined;
}

/** Told of progress. If it returns `false`, the work ends with the error `cancelled`. */
export type Progress = (phase: Phase, done: number, total: number) => boolean | void;

/** What a mesh was found to keep, from scratch. The program's reports have the same members. */
export interface Certificate {
  readonly vertices: number;
  readonly triangles: number;
  readonly edges: number;
  /** Smallest and largest angle allowed, degrees. */
  readonly bounds: { readonly min_deg: number; readonly max_deg: number };
  readonly min_angle_deg: number;
  readonly max_angle_deg: number;
  readonly max_aspect_ratio: number;
  readonly shortest_edge: number;
  readonly out_of_bounds: number;
  readonly rounding_limited: number;
  readonly delaunay: boolean;
  readonly disk: boolean;
  readonly inputs: number;
  readonly inputs_kept: number;
  readonly [more: string]: unknown;
}

/** A remark and its place. */
export interface Note {
  readonly text: string;
  readonly x: number;
  readonly y: number;
}

/** What is to be said of the mesh of a graph. */
export interface Notes {
  /** Triangles that do not keep what was asked for. */
  readonly failed: readonly Note[];
  /** Triangles that a narrow corner of the graph excuses. */
  readonly exempt: readonly Note[];
  /** What repair has done. */
  readonly repairs: readonly Note[];
  readonly warnings: readonly Note[];
}

/** The Voronoi dual. */
export interface Dual {
  /** By triangle, x and y by turns. */
  readonly circumcentres: Float64Array;
  /** The area of each vertex's cell. */
  readonly areas: Float64Array;
  /** Where each vertex's cell begins in `cellCorners`, counted in corners, and the end. */
  readonly cellOffsets: Uint32Array;
  /** x and y by turns. */
  readonly cellCorners: Float64Array;
}

/** The hexagons behind a mesh. */
export interface Hexagons {
  /** Where each one begins in `corners`, counted in corners, and the end. */
  readonly offsets: Uint32Array;
  /** x and y by turns. */
  readonly corners: Float64Array;
  /** 0 is the coarsest. */
  readonly levels: Uint32Array;
  /** What each one is (paper, section 5.1), as an index into `classNames`. */
  readonly classes: Uint8Array;
  readonly classNames: readonly ClassName[];
}

/**
 * The classes of hexagons. Of `templates` all but `full hexagon` and `occupied`; of `simple`
 * these two and `semi-hexagon`.
 */
export type ClassName =
  | "semi-hexagon" | "fixed centre" | "fixed centre in ring" | "moved centre in ring" | "occupied 1" | "occupied 2"
  | "moved centre 1" | "moved centre 2" | "moved centre 3" | "moved centre 4" | "subdivide"
  | "full hexagon" | "occupied";

/** The formats that meshes are written in, by extension; `formats()` lists them all. */
export type Format =
  | "node" | "ele" | "edge" | "neigh" | "poly" | "vtu" | "msh" | "msh2" | "obj" | "off" | "mesh"
  | "json" | "ron" | "svg" | (string & {});

/** What a step of a session did. Numbers of vertices and triangles are never used twice. */
export interface Delta {
  /** The numbers of the points put in. */
  readonly points: Float64Array;
  /** Whether the whole was meshed anew. */
  readonly remeshed: boolean;
  readonly verticesRemoved: Float64Array;
  readonly verticesAdded: { readonly ids: Float64Array; readonly places: Float64Array };
  readonly verticesMoved: { readonly ids: Float64Array; readonly places: Float64Array };
  readonly trianglesRemoved: Float64Array;
  readonly trianglesAdded: { readonly ids: Float64Array; readonly corners: Float64Array };
}

/** The kinds of test points, as `hexdel generate` has them. */
export type Kind =
  | "uniform" | "line" | "clusters" | "grid" | "jittered" | "circle" | "spiral" | "pairs" | "contrast";
