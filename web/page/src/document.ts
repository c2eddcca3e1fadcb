// The input as it is drawn: points, segments, holes. Documents never change; edits make new
// ones, which is what undo goes back through.

import type { Region } from "../../package/dist/index.js";

export type Place = readonly [number, number];

/** What is meshed. */
export interface Document {
  /** x and y by turns. */
  readonly points: Float64Array;
  /** Indices of points, two by two. */
  readonly segments: Uint32Array;
  /** x and y by turns. */
  readonly holes: Float64Array;
  readonly regions: readonly Region[];
  /** As long as the points, or empty. */
  readonly pointMarkers: Int32Array;
  /** As long as the points, or empty. Those that are `NaN` are taken to be between the others. */
  readonly heights: Float64Array;
  /** As long as the segments, or empty. */
  readonly segmentMarkers: Int32Array;
}

export const EMPTY: Document = {
  points: new Float64Array(),
  segments: new Uint32Array(),
  holes: new Float64Array(),
  regions: [],
  pointMarkers: new Int32Array(),
  heights: new Float64Array(),
  segmentMarkers: new Int32Array(),
};

export function count(doc: Document): { points: number; segments: number; holes: number } {
  return { points: doc.points.length / 2, segments: doc.segments.length / 2, holes: doc.holes.length / 2 };
}

export function place(flat: Float64Array, index: number): Place {
  return [flat[2 * index] ?? NaN, flat[2 * index + 1] ?? NaN];
}

export function withPoint(doc: Document, at: Place): Document {
  const heights = doc.heights.length > 0 ? Float64Array.from([...doc.heights, NaN]) : doc.heights;
  return { ...doc, points: appended(doc.points, at), pointMarkers: marked(doc.pointMarkers), heights };
}

export function withSegment(doc: Document, a: number, b: number): Document {
  const { segments } = doc;
  for (let s = 0; s < segments.length; s += 2) {
    const [u, v] = [segments[s], segments[s + 1]];
    if ((u === a && v === b) || (u === b && v === a)) {
      return doc;
    }
  }
  const longer = new Uint32Array(segments.length + 2);
  longer.set(segments);
  longer.set([a, b], segments.length);
  return { ...doc, segments: longer, segmentMarkers: marked(doc.segmentMarkers) };
}

export function withHole(doc: Document, at: Place): Document {
  return { ...doc, holes: appended(doc.holes, at) };
}

export function withPointMoved(doc: Document, index: number, to: Place): Document {
  return { ...doc, points: moved(doc.points, index, to) };
}

export function withHoleMoved(doc: Document, index: number, to: Place): Document {
  return { ...doc, holes: moved(doc.holes, index, to) };
}

/** Without a point and the segments that end there. */
export function withoutPoint(doc: Document, index: number): Document {
  const segments: number[] = [];
  const markers: number[] = [];
  for (let s = 0; s < doc.segments.length; s += 2) {
    const ends = [doc.segments[s] ?? 0, doc.segments[s + 1] ?? 0];
    if (!ends.includes(index)) {
      segments.push(...ends.map((p) => (p > index ? p - 1 : p)));
      markers.push(doc.segmentMarkers[s / 2] ?? 0);
    }
  }
  return {
    ...doc,
    points: without(doc.points, 2 * index, 2),
    pointMarkers: doc.pointMarkers.filter((_, i) => i !== index),
    heights: doc.heights.filter((_, i) => i !== index),
    segments: Uint32Array.from(segments),
    segmentMarkers: doc.segmentMarkers.length > 0 ? Int32Array.from(markers) : doc.segmentMarkers,
  };
}

export function withoutSegment(doc: Document, index: number): Document {
  return {
    ...doc,
    segments: doc.segments.filter((_, i) => i >> 1 !== index),
    segmentMarkers: doc.segmentMarkers.filter((_, i) => i !== index),
  };
}

export function withoutHole(doc: Document, index: number): Document {
  return { ...doc, holes: without(doc.holes, 2 * index, 2) };
}

/** Low and high corner of all points; nothing if there are none. */
export function extent(flat: Float64Array): [Place, Place] | undefined {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < flat.length; i += 2) {
    const [x, y] = [flat[i] ?? NaN, flat[i + 1] ?? NaN];
    if (x < x0) x0 = x;
    if (x > x1) x1 = x;
    if (y < y0) y0 = y;
    if (y > y1) y1 = y;
  }
  return x0 <= x1 && y0 <= y1 ? [[x0, y0], [x1, y1]] : undefined;
}

/** Documents to go back and forth through. */
export class History {
  private readonly past: Document[] = [];
  private future: Document[] = [];

  constructor(private now: Document) {}

  get current(): Document {
    return this.now;
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** Goes on with a document. One that only continues the last edit takes its place. */
  push(doc: Document, continues = false): void {
    if (doc === this.now) {
      return;
    }
    if (!continues) {
      this.past.push(this.now);
      if (this.past.length > 200) {
        this.past.shift();
      }
    }
    this.future = [];
    this.now = doc;
  }

  undo(): void {
    const last = this.past.pop();
    if (last) {
      this.future.push(this.now);
      this.now = last;
    }
  }

  redo(): void {
    const next = this.future.pop();
    if (next) {
      this.past.push(this.now);
      this.now = next;
    }
  }
}

function appended(flat: Float64Array, at: Place): Float64Array {
  const longer = new Float64Array(flat.length + 2);
  longer.set(flat);
  longer.set(at, flat.length);
  return longer;
}

function moved(flat: Float64Array, index: number, to: Place): Float64Array {
  const copy = flat.slice();
  copy.set(to, 2 * index);
  return copy;
}

function without(flat: Float64Array, from: number, length: number): Float64Array {
  const rest = new Float64Array(flat.length - length);
  rest.set(flat.subarray(0, from));
  rest.set(flat.subarray(from + length), from);
  return rest;
}

/** Markers with one for a new item, if there are any. */
function marked(markers: Int32Array): Int32Array {
  return markers.length > 0 ? Int32Array.from([...markers, 0]) : markers;
}
