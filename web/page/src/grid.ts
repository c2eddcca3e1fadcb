// The hexagon grid behind a mesh, coloured by level or by class, as in the paper's figures. Each
// kind has a code beside its colour, so that no one depends on colours.

import type { ClassName, Hexagons } from "../../package/dist/index.js";
import { type Rgb, scaleColour, word } from "./colours.js";

export type GridBy = "levels" | "classes";

/** What some of the hexagons are. */
export interface Kind {
  readonly name: string;
  /** One or two letters in the hexagons themselves. */
  readonly code: string;
  readonly fill: string;
  /** The colour of letters on it. */
  readonly ink: string;
  readonly count: number;
}

/** Hexagons ready to be filled. */
export interface Grid {
  readonly hexagons: Hexagons;
  /** Of each hexagon, as an index into `kinds`. */
  readonly kindOf: Uint8Array;
  readonly kinds: readonly Kind[];
  /** The colour of each kind, as a word of an image. */
  readonly words: Uint32Array;
  /** The hexagons cut into triangles: corners, three by three, and the kind of each. */
  readonly triangles: Uint32Array;
  readonly kindOfTriangle: Uint8Array;
}

/**
 * Codes and colours of the classes, on light paper and on dark. Those on light paper are the
 * program's; colours of classes that are next to each other differ in lightness.
 */
const CLASSES: Record<ClassName, { code: string; light: Rgb; dark: Rgb }> = {
  "semi-hexagon": { code: "½", light: [222, 222, 222], dark: [58, 64, 72] },
  "fixed centre": { code: "F", light: [247, 247, 247], dark: [34, 39, 46] },
  "full hexagon": { code: "F", light: [247, 247, 247], dark: [34, 39, 46] },
  "fixed centre in ring": { code: "FR", light: [253, 224, 178], dark: [92, 70, 33] },
  "moved centre in ring": { code: "MR", light: [253, 184, 99], dark: [158, 105, 31] },
  "occupied 1": { code: "O1", light: [230, 97, 1], dark: [242, 138, 51] },
  "occupied": { code: "O", light: [230, 97, 1], dark: [242, 138, 51] },
  "occupied 2": { code: "O2", light: [178, 24, 43], dark: [255, 186, 173] },
  "moved centre 1": { code: "1", light: [209, 229, 240], dark: [33, 61, 82] },
  "moved centre 2": { code: "2", light: [146, 197, 222], dark: [44, 98, 138] },
  "moved centre 3": { code: "3", light: [67, 147, 195], dark: [101, 171, 219] },
  "moved centre 4": { code: "4", light: [118, 42, 131], dark: [205, 160, 217] },
  "subdivide": { code: "S", light: [0, 0, 0], dark: [255, 255, 255] },
};

/** Levels have as many colours, and begin anew after them. */
const MOST_LEVELS = 200;

export function gridOf(hexagons: Hexagons, by: GridBy, dark: boolean): Grid {
  const { kindOf, kinds } = by === "classes" ? byClass(hexagons, dark) : byLevel(hexagons, dark);
  const counts = new Uint32Array(kinds.length);
  kindOf.forEach((kind) => (counts[kind] = (counts[kind] ?? 0) + 1));
  const named = kinds.map(({ name, code, colour }, i) => {
    return { name, code, fill: `rgb(${colour.join(" ")})`, ink: inkOn(colour), count: counts[i] ?? 0 };
  });
  return { hexagons, kindOf, kinds: named, words: Uint32Array.from(kinds, ({ colour }) => word(colour)), ...cut(hexagons, kindOf) };
}

interface Coloured {
  readonly kindOf: Uint8Array;
  readonly kinds: readonly { name: string; code: string; colour: Rgb }[];
}

function byClass({ classes, classNames }: Hexagons, dark: boolean): Coloured {
  const kinds = classNames.map((name) => {
    const { code, light, dark: onDark } = CLASSES[name];
    return { name, code, colour: dark ? onDark : light };
  });
  return { kindOf: classes, kinds };
}

function byLevel({ levels }: Hexagons, dark: boolean): Coloured {
  const count = Math.min(levels.reduce((a, b) => Math.max(a, b), 0) + 1, MOST_LEVELS);
  const kinds = Array.from({ length: count }, (_, level) => {
    return { name: `level ${level}`, code: String(level), colour: scaleColour(level / Math.max(1, count - 1), dark) };
  });
  return { kindOf: Uint8Array.from(levels, (level) => level % count), kinds };
}

/** Black or white, whichever is read better. */
function inkOn([r, g, b]: Rgb): string {
  const linear = (channel: number) => (channel / 255) ** 2.2;
  return 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b) > 0.18 ? "#000000" : "#ffffff";
}

/** Fans of triangles. */
function cut({ offsets }: Hexagons, kindOf: Uint8Array): Pick<Grid, "triangles" | "kindOfTriangle"> {
  const most = (offsets.at(-1) ?? 0) - 2 * kindOf.length;
  const triangles = new Uint32Array(3 * Math.max(0, most));
  const kindOfTriangle = new Uint8Array(Math.max(0, most));
  let t = 0;
  for (let h = 0; h < kindOf.length; h++) {
    const [from, to] = [offsets[h] as number, offsets[h + 1] as number];
    for (let i = from + 1; i + 1 < to; i++, t++) {
      triangles.set([from, i, i + 1], 3 * t);
      kindOfTriangle[t] = kindOf[h] as number;
    }
  }
  return { triangles, kindOfTriangle };
}
