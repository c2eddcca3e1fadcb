// Errors of the library as exceptions.

/** What an error is about. */
interface Fault {
  kind: string;
  message: string;
  item: "point" | "segment" | "hole" | "region" | null;
  index: number[];
  location: [number, number] | null;
  least: number | null;
  line: number | null;
}

/**
 * Why something was not meshed, read or written. The message has the library's words.
 */
export class HexdelError extends Error {
  /** What is wrong, in a word: `too_close`, `crossing`, `not_finite`, `bounds`, `file` … */
  readonly kind: string;
  /** What `index` counts, if items are to blame. */
  readonly item: "point" | "segment" | "hole" | "region" | undefined;
  /** Indices of the items to blame, from 0. */
  readonly index: readonly number[];
  /** Where it is. */
  readonly location: readonly [number, number] | undefined;
  /** The distance, length or tolerance that would do. */
  readonly least: number | undefined;
  /** The line of the file. */
  readonly line: number | undefined;

  constructor(fault: Partial<Fault> & { kind: string; message: string }) {
    super(fault.message);
    this.name = "HexdelError";
    this.kind = fault.kind;
    this.item = fault.item ?? undefined;
    this.index = fault.index ?? [];
    this.location = fault.location ?? undefined;
    this.least = fault.least ?? undefined;
    this.line = fault.line ?? undefined;
  }
}

/** What trapped, if the module has: its memory cannot be trusted then. */
let broken: string | undefined;

/** Calls the library, and makes exceptions of what it throws. */
export function guarded<T>(call: () => T): T {
  if (broken !== undefined) {
    throw new HexdelError({ kind: "internal", message: `the module has stopped: ${broken}` });
  }
  try {
    return call();
  } catch (thrown) {
    if (typeof thrown === "string") {
      throw new HexdelError(parsed(thrown));
    }
    if (thrown instanceof WebAssembly.RuntimeError || thrown instanceof RangeError) {
      broken = thrown.message;
      const message = `a defect of hexdel, or too little memory: ${thrown.message}`;
      throw new HexdelError({ kind: "internal", message });
    }
    throw thrown;
  }
}

function parsed(text: string): Fault {
  return JSON.parse(text) as Fault;
}
