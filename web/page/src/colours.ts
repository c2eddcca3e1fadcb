// Colours of triangles, and of all else in light and dark.

/** How many colours there are between the smallest angle allowed and 60 degrees. */
export const STEPS = 64;

/** The class of triangles that are beyond the bounds. */
export const BEYOND = STEPS;

/** Samples of viridis, as in the library's pictures. */
const SCALE = [
  [0x44, 0x01, 0x54],
  [0x3b, 0x52, 0x8b],
  [0x21, 0x91, 0x8c],
  [0x5e, 0xc9, 0x62],
  [0xfd, 0xe7, 0x25],
] as const;

/** Red, green and blue, to 255. */
export type Rgb = readonly [number, number, number];

export interface Theme {
  readonly dark: boolean;
  readonly paper: string;
  readonly edge: string;
  readonly segment: string;
  readonly point: string;
  readonly ring: string;
  readonly cell: string;
  readonly hexagon: string;
  readonly hole: string;
  readonly fault: string;
  readonly note: string;
  readonly cursor: string;
  /** Red, green, blue, alpha of each class of triangles, as a word of an image. */
  readonly triangles: Uint32Array;
}

export function themeOf(dark: boolean): Theme {
  const common = { dark, triangles: tableOf(dark) };
  return dark
    ? {
        ...common,
        paper: "#14181d",
        edge: "rgba(255, 255, 255, 0.3)",
        segment: "#ffffff",
        point: "#ffffff",
        ring: "#14181d",
        cell: "rgba(255, 255, 255, 0.85)",
        hexagon: "#ffb454",
        hole: "#ff9ad5",
        fault: "#ff6b5e",
        note: "#ffc14d",
        cursor: "#7cc7ff",
      }
    : {
        ...common,
        paper: "#ffffff",
        edge: "rgba(20, 30, 45, 0.45)",
        segment: "#101828",
        point: "#101828",
        ring: "#ffffff",
        cell: "rgba(16, 24, 40, 0.8)",
        hexagon: "#b45309",
        hole: "#a3006b",
        fault: "#c81e1e",
        note: "#a15c00",
        cursor: "#0b62c4",
      };
}

/** A colour of the scale, mixed with the paper so that lines stand out. */
export function scaleColour(t: number, dark: boolean): Rgb {
  const position = Math.min(Math.max(t, 0), 1) * (SCALE.length - 1);
  const below = Math.min(Math.floor(position), SCALE.length - 2);
  const [from, to] = [SCALE[below], SCALE[below + 1]] as const;
  const paper = dark ? [0x14, 0x18, 0x1d] : [0xff, 0xff, 0xff];
  const part = dark ? 0.8 : 0.62;
  const channel = (i: 0 | 1 | 2) => {
    const [a, b] = [from?.[i] ?? 0, to?.[i] ?? 0];
    const pure = a + (b - a) * (position - below);
    return Math.round(pure * part + (paper[i] ?? 0) * (1 - part));
  };
  return [channel(0), channel(1), channel(2)];
}

/** Classes of triangles by their smallest angle. */
export function classesOf(angles: Float32Array, least: number): Uint8Array {
  const classes = new Uint8Array(angles.length);
  for (let t = 0; t < angles.length; t++) {
    const angle = angles[t] as number;
    const part = (angle - least) / (60 - least);
    classes[t] = angle < least - 1e-3 ? BEYOND : Math.min(STEPS - 1, Math.max(0, Math.floor(part * STEPS)));
  }
  return classes;
}

function tableOf(dark: boolean): Uint32Array {
  const table = new Uint32Array(STEPS + 1);
  for (let i = 0; i < STEPS; i++) {
    table[i] = word(scaleColour((i + 0.5) / STEPS, dark));
  }
  table[BEYOND] = word(dark ? [0xe0, 0x4f, 0x45] : [0xf0, 0x70, 0x60]);
  return table;
}

/** Images have red first in memory, which is the low byte on every machine of today. */
export function word([r, g, b]: Rgb): number {
  return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
}
