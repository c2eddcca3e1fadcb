// A session that follows the document: what differs in it is put in and taken out, for the time
// being while something is dragged, and for good when that ends.

import type { Session } from "../../package/dist/index.js";
import type { Document } from "./document.js";

/** So many points may change at once. */
const MOST = 8;

/** A row of points that stand in the place of others. */
interface Difference {
  /** The first point that differs. */
  readonly from: number;
  readonly removed: number;
  readonly inserted: number;
}

export class Steps {
  private readonly ids: number[];
  /** What is shown for the time being: the points taken out, and whether others are in their place. */
  private draft: { from: number; removed: number; calls: number; inserted: boolean } | undefined;

  /** Begins with the session of the points of a document. */
  constructor(
    readonly session: Session,
    private points: Float64Array,
    readonly options: string,
  ) {
    this.ids = [...session.ids];
  }

  /** Whether a document with such options can be followed. */
  fits(doc: Document, options: string): boolean {
    if (options !== this.options || doc.segments.length > 0) {
      return false;
    }
    const { removed, inserted } = difference(this.points, doc.points);
    return Math.max(removed, inserted) <= MOST;
  }

  /**
   * Follows a drag. The points that move are taken out once; each place of them takes back the
   * one before. Fails where a draft has no room, as before the call but for the points dragged.
   */
  drag(doc: Document): void {
    const { from, removed, inserted } = difference(this.points, doc.points);
    if (this.draft?.from !== from || this.draft.removed !== removed) {
      this.endDrag();
      this.session.draft(true);
      this.draft = { from, removed, calls: 0, inserted: false };
      if (removed > 0) {
        this.session.remove(this.ids.slice(from, from + removed));
        this.draft.calls = 1;
      }
    }
    if (this.draft.inserted) {
      this.session.undo();
      this.draft.inserted = false;
    }
    if (inserted > 0) {
      this.session.insert(doc.points.slice(2 * from, 2 * (from + inserted)), doc.heights.slice(from, from + inserted));
      this.draft.inserted = true;
    }
  }

  /** Takes back what was for the time being. */
  endDrag(): void {
    if (this.draft) {
      const { calls, inserted } = this.draft;
      this.draft = undefined;
      for (let i = 0; i < calls + (inserted ? 1 : 0); i++) {
        this.session.undo();
      }
    }
    this.session.draft(false);
  }

  /** Brings the session to the document. */
  follow(doc: Document): void {
    this.endDrag();
    const { from, removed, inserted } = difference(this.points, doc.points);
    const gone = this.ids.slice(from, from + removed);
    const points = doc.points.slice(2 * from, 2 * (from + inserted));
    const heights = doc.heights.slice(from, from + inserted);
    let numbers: number[] = [];
    if (gone.length > 0) {
      numbers = [...(this.session.replace(gone, points, heights).at(-1)?.points ?? [])];
    } else if (points.length > 0) {
      numbers = [...(this.session.insert(points, heights).at(-1)?.points ?? [])];
    }
    this.ids.splice(from, removed, ...numbers);
    this.points = doc.points;
  }

  free(): void {
    this.session.free();
  }
}

/** What lies between the points that two lists begin and end with. */
function difference(before: Float64Array, after: Float64Array): Difference {
  const [n, m] = [before.length / 2, after.length / 2];
  const shorter = Math.min(n, m);
  const same = (i: number, j: number) => before[2 * i] === after[2 * j] && before[2 * i + 1] === after[2 * j + 1];
  let from = 0;
  while (from < shorter && same(from, from)) {
    from += 1;
  }
  let rest = 0;
  while (rest < shorter - from && same(n - 1 - rest, m - 1 - rest)) {
    rest += 1;
  }
  return { from, removed: n - from - rest, inserted: m - from - rest };
}
