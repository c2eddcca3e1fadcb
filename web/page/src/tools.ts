// What clicks, drags and keys do to the input.

import * as d from "./document.js";
import type { Document, Place } from "./document.js";
import type { View } from "./view.js";

export type Tool = "points" | "segments" | "holes" | "erase" | "pan";

export const TOOLS: readonly Tool[] = ["points", "segments", "holes", "erase", "pan"];

/** How close a click must be to something to mean it, in pixels. */
const REACH = 10;

/** What a click is close to. */
export type Hit =
  | { readonly kind: "point"; readonly index: number }
  | { readonly kind: "hole"; readonly index: number }
  | { readonly kind: "segment"; readonly index: number };

/** What is at some pixels: points first, then holes, then segments. */
export function hitAt(doc: Document, view: View, at: Place, reach = REACH): Hit | undefined {
  const point = nearest(doc.points, view, at, reach);
  if (point !== undefined) {
    return { kind: "point", index: point };
  }
  const hole = nearest(doc.holes, view, at, reach);
  if (hole !== undefined) {
    return { kind: "hole", index: hole };
  }
  const segment = nearestSegment(doc, view, at, reach * 0.7);
  return segment === undefined ? undefined : { kind: "segment", index: segment };
}

function nearest(flat: Float64Array, view: View, at: Place, reach: number): number | undefined {
  let [best, least] = [undefined as number | undefined, reach * reach];
  for (let i = 0; i < flat.length / 2; i++) {
    const [x, y] = view.toPixels(d.place(flat, i));
    const distance = (x - at[0]) ** 2 + (y - at[1]) ** 2;
    if (distance <= least) {
      [best, least] = [i, distance];
    }
  }
  return best;
}

function nearestSegment(doc: Document, view: View, at: Place, reach: number): number | undefined {
  let [best, least] = [undefined as number | undefined, reach];
  for (let s = 0; s < doc.segments.length / 2; s++) {
    const [a, b] = [doc.segments[2 * s] ?? 0, doc.segments[2 * s + 1] ?? 0];
    const distance = toSegment(at, view.toPixels(d.place(doc.points, a)), view.toPixels(d.place(doc.points, b)));
    if (distance <= least) {
      [best, least] = [s, distance];
    }
  }
  return best;
}

function toSegment(p: Place, a: Place, b: Place): number {
  const [ux, uy] = [b[0] - a[0], b[1] - a[1]];
  const along = ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / (ux * ux + uy * uy || 1);
  const t = Math.min(1, Math.max(0, along));
  return Math.hypot(p[0] - a[0] - t * ux, p[1] - a[1] - t * uy);
}

/** Drawing a line of segments, click by click. */
export class Chain {
  /** The first and the last point. */
  private first: number | undefined;
  last: number | undefined;

  end(): void {
    this.first = this.last = undefined;
  }

  /** Goes on to a place, or to a point that is there. The first point closes a polygon. */
  click(doc: Document, view: View, at: Place): Document {
    const hit = hitAt(doc, view, at);
    let next = doc;
    let index: number;
    if (hit?.kind === "point") {
      index = hit.index;
    } else {
      next = d.withPoint(doc, view.toPlane(at));
      index = next.points.length / 2 - 1;
    }
    if (this.last === undefined) {
      this.first = this.last = index;
      return next;
    }
    if (index === this.last) {
      this.end();
      return next;
    }
    next = d.withSegment(next, this.last, index);
    if (index === this.first) {
      this.end();
    } else {
      this.last = index;
    }
    return next;
  }
}

/** Erases what is at a place. */
export function erased(doc: Document, view: View, at: Place): Document {
  const hit = hitAt(doc, view, at);
  switch (hit?.kind) {
    case "point":
      return d.withoutPoint(doc, hit.index);
    case "hole":
      return d.withoutHole(doc, hit.index);
    case "segment":
      return d.withoutSegment(doc, hit.index);
    default:
      return doc;
  }
}

/** Moves what is held to a place. */
export function dragged(doc: Document, held: Hit, to: Place): Document {
  switch (held.kind) {
    case "point":
      return d.withPointMoved(doc, held.index, to);
    case "hole":
      return d.withHoleMoved(doc, held.index, to);
    case "segment":
      return doc;
  }
}
