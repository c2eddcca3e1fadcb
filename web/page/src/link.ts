// The input and the options in a link: JSON, deflated, in the fragment, which browsers do not
// send to anyone.

import type { Options, Region } from "../../package/dist/index.js";
import { type Document, EMPTY } from "./document.js";

/** Longer links are refused by browsers and by what passes links on. */
export const LONGEST = 60_000;

/** What a link holds. Numbers in JSON read back to the same bits. */
interface Held {
  readonly v: 1;
  readonly p: readonly number[];
  readonly s?: readonly number[];
  readonly h?: readonly number[];
  readonly r?: readonly Region[];
  readonly pm?: readonly number[];
  readonly sm?: readonly number[];
  /** Heights; null are those that are not known. */
  readonly z?: readonly (number | null)[];
  readonly o?: Options;
}

export async function toFragment(doc: Document, options: Options): Promise<string> {
  const held: Held = {
    v: 1,
    p: [...doc.points],
    ...(doc.segments.length > 0 ? { s: [...doc.segments] } : {}),
    ...(doc.holes.length > 0 ? { h: [...doc.holes] } : {}),
    ...(doc.regions.length > 0 ? { r: doc.regions } : {}),
    ...(doc.pointMarkers.length > 0 ? { pm: [...doc.pointMarkers] } : {}),
    ...(doc.segmentMarkers.length > 0 ? { sm: [...doc.segmentMarkers] } : {}),
    // JSON has null for what is no number.
    ...(doc.heights.length > 0 ? { z: [...doc.heights] } : {}),
    ...(Object.keys(options).length > 0 ? { o: options } : {}),
  };
  const packed = await through(new TextEncoder().encode(JSON.stringify(held)), new CompressionStream("deflate-raw"));
  let binary = "";
  packed.forEach((byte) => (binary += String.fromCharCode(byte)));
  return `#in=${btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
}

/** What a fragment holds; nothing if it holds nothing. Fails if it is damaged. */
export async function fromFragment(fragment: string): Promise<{ doc: Document; options: Options } | undefined> {
  if (!fragment.startsWith("#in=")) {
    return undefined;
  }
  const binary = atob(fragment.slice(4).replaceAll("-", "+").replaceAll("_", "/"));
  const packed = Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
  const text = new TextDecoder().decode(await through(packed, new DecompressionStream("deflate-raw")));
  const held = JSON.parse(text) as Held;
  if (held.v !== 1 || !Array.isArray(held.p)) {
    throw new Error("the link is of another version");
  }
  const doc: Document = {
    ...EMPTY,
    points: Float64Array.from(held.p),
    segments: Uint32Array.from(held.s ?? []),
    holes: Float64Array.from(held.h ?? []),
    regions: held.r ?? [],
    pointMarkers: Int32Array.from(held.pm ?? []),
    segmentMarkers: Int32Array.from(held.sm ?? []),
    heights: Float64Array.from(held.z ?? [], (z) => z ?? NaN),
  };
  return { doc, options: held.o ?? {} };
}

async function through(bytes: Uint8Array<ArrayBuffer>, stream: GenericTransformStream): Promise<Uint8Array> {
  const piped = new Blob([bytes]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array, BufferSource>);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}
