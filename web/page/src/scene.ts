// What is drawn: the mesh, overlays, the input, marks, the keyboard's cursor.

import type { Dual } from "../../package/dist/index.js";
import { type Theme, classesOf } from "./colours.js";
import { type Document, type Place, place } from "./document.js";
import type { Grid } from "./grid.js";
import { Raster } from "./raster.js";
import type { View } from "./view.js";

/** Edges shorter than so many pixels are not drawn: they would hide the colours. */
const LEAST_EDGE = 3.5;

/** Radii of points in pixels: a part of the length of short edges, so that the mesh is seen. */
const POINT_PER_EDGE = 0.25;
const LEAST_POINT = 1.2;
const MOST_POINT = 4;

/** Hexagons with sides of fewer pixels have no code in them. */
const LEAST_CODED = 15;

/** Points of this radius have a ring around them. */
const RINGED = 2.4;

export interface DrawnMesh {
  readonly vertices: Float64Array;
  readonly triangles: Uint32Array;
  readonly angles: Float32Array;
  readonly edges: Uint32Array;
  /** The angle that the colours begin at. */
  readonly least: number;
}

/** A mark at a place. */
export interface Mark {
  readonly at: Place;
  readonly kind: "fault" | "note";
  readonly label: string;
}

export interface Scene {
  readonly doc: Document;
  readonly mesh: DrawnMesh | undefined;
  readonly dual: Dual | undefined;
  readonly grid: Grid | undefined;
  readonly marks: readonly Mark[];
  /** Points to be told from others: at fault, or held. */
  readonly held: number | undefined;
  /** The end of the segment being drawn. */
  readonly chain: Place | undefined;
  readonly pointer: Place | undefined;
  /** Where the keyboard points, in pixels. */
  readonly cursor: Place | undefined;
}

export class Painter {
  private readonly raster = new Raster();
  private drawn: DrawnMesh | undefined;
  private classes: Uint8Array = new Uint8Array();
  private lines: Uint32Array = new Uint32Array();
  private shortEdge = 0;

  /** Draws all of it, at so many pixels of the canvas for each of CSS. */
  draw(context: CanvasRenderingContext2D, ratio: number, view: View, theme: Theme, scene: Scene): void {
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, context.canvas.width, context.canvas.height);
    if (scene.mesh) {
      this.adopt(scene.mesh);
    }
    if (scene.grid) {
      const { hexagons, triangles, kindOfTriangle, words } = scene.grid;
      this.raster.draw(context, ratio, view, { vertices: hexagons.corners, triangles }, kindOfTriangle, words);
    } else if (scene.mesh) {
      this.raster.draw(context, ratio, view, scene.mesh, this.classes, theme.triangles);
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.lineJoin = "round";
    context.lineCap = "round";
    if (scene.mesh) {
      stroke(context, view, scene.mesh.vertices, this.lines, theme.edge, 0.7, LEAST_EDGE);
    }
    if (scene.grid) {
      outlines(context, view, scene.grid.hexagons.offsets, scene.grid.hexagons.corners, theme.hexagon, 1.1);
      drawCodes(context, view, scene.grid);
    }
    if (scene.dual) {
      outlines(context, view, scene.dual.cellOffsets, scene.dual.cellCorners, theme.cell, 0.9);
    }
    const radius = scene.mesh ? this.shortEdge * view.scale * POINT_PER_EDGE : MOST_POINT;
    drawInput(context, view, theme, scene, Math.min(Math.max(radius, LEAST_POINT), MOST_POINT));
    scene.marks.forEach((mark) => drawMark(context, view, theme, mark));
    if (scene.cursor) {
      drawCursor(context, theme, scene.cursor);
    }
  }

  /** Works out what a new mesh needs: classes and every edge once. */
  private adopt(mesh: DrawnMesh): void {
    if (this.drawn === mesh) {
      return;
    }
    this.drawn = mesh;
    this.classes = classesOf(mesh.angles, mesh.least);
    this.lines = linesOf(mesh.triangles);
    this.shortEdge = shortLength(mesh.vertices, this.lines);
  }
}

/** Every edge once. Inner edges are run through in both directions, those of the boundary in one. */
function linesOf(triangles: Uint32Array): Uint32Array {
  const lines = new Uint32Array(triangles.length * 2);
  const known = new EdgeSet(triangles.length);
  let used = 0;
  for (const upwards of [true, false]) {
    for (let i = 0; i < triangles.length; i++) {
      const a = triangles[i] as number;
      const b = triangles[i % 3 === 2 ? i - 2 : i + 1] as number;
      if (a < b === upwards && known.add(Math.min(a, b), Math.max(a, b))) {
        lines[used++] = a;
        lines[used++] = b;
      }
    }
  }
  return lines.slice(0, used);
}

/** A set of pairs of vertices: a table with open addressing. */
class EdgeSet {
  private readonly lows: Int32Array;
  private readonly highs: Int32Array;
  private readonly mask: number;

  constructor(most: number) {
    const size = 2 ** Math.ceil(Math.log2(Math.max(4, 2 * most)));
    this.mask = size - 1;
    this.lows = new Int32Array(size).fill(-1);
    this.highs = new Int32Array(size);
  }

  /** Whether the pair is new. */
  add(low: number, high: number): boolean {
    let slot = (Math.imul(low, 0x9e3779b1) ^ Math.imul(high, 0x85ebca6b)) & this.mask;
    while (this.lows[slot] !== -1) {
      if (this.lows[slot] === low && this.highs[slot] === high) {
        return false;
      }
      slot = (slot + 1) & this.mask;
    }
    this.lows[slot] = low;
    this.highs[slot] = high;
    return true;
  }
}

/** The length that three in ten of the edges are shorter than, from a sample. */
function shortLength(vertices: Float64Array, lines: Uint32Array): number {
  const step = 2 * Math.max(1, Math.floor(lines.length / 4000));
  const lengths: number[] = [];
  for (let i = 0; i < lines.length; i += step) {
    const [a, b] = [place(vertices, lines[i] as number), place(vertices, lines[i + 1] as number)];
    lengths.push(Math.hypot(a[0] - b[0], a[1] - b[1]));
  }
  lengths.sort((a, b) => a - b);
  return lengths[Math.floor(0.3 * lengths.length)] ?? 0;
}

/** Lines between vertices, short ones and those outside of the canvas left away. */
function stroke(
  context: CanvasRenderingContext2D,
  view: View,
  vertices: Float64Array,
  lines: Uint32Array,
  colour: string,
  width: number,
  least = 0,
): void {
  const [x0, y0] = view.toPlane([0, 0]);
  const { scale, width: right, height: bottom } = view;
  context.beginPath();
  for (let i = 0; i < lines.length; i += 2) {
    const [a, b] = [2 * (lines[i] as number), 2 * (lines[i + 1] as number)];
    const ax = ((vertices[a] as number) - x0) * scale;
    const ay = (y0 - (vertices[a + 1] as number)) * scale;
    const bx = ((vertices[b] as number) - x0) * scale;
    const by = (y0 - (vertices[b + 1] as number)) * scale;
    const outside = (ax < 0 && bx < 0) || (ay < 0 && by < 0) || (ax > right && bx > right) || (ay > bottom && by > bottom);
    const short = (ax - bx) ** 2 + (ay - by) ** 2 < least * least;
    if (!outside && !short) {
      context.moveTo(ax, ay);
      context.lineTo(bx, by);
    }
  }
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
}

function outlines(
  context: CanvasRenderingContext2D,
  view: View,
  offsets: Uint32Array,
  corners: Float64Array,
  colour: string,
  width: number,
): void {
  context.beginPath();
  for (let c = 0; c + 1 < offsets.length; c++) {
    const [from, to] = [offsets[c] as number, offsets[c + 1] as number];
    let inside = false;
    for (let i = from; i < to; i++) {
      const [x, y] = view.toPixels(place(corners, i));
      inside ||= x > -50 && y > -50 && x < view.width + 50 && y < view.height + 50;
    }
    if (!inside) {
      continue;
    }
    for (let i = from; i < to; i++) {
      const [x, y] = view.toPixels(place(corners, i));
      if (i === from) context.moveTo(x, y);
      else context.lineTo(x, y);
    }
    context.closePath();
  }
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
}

/** The code of each hexagon, where that is large enough to be read. */
function drawCodes(context: CanvasRenderingContext2D, view: View, { hexagons, kindOf, kinds }: Grid): void {
  const { offsets, corners } = hexagons;
  context.font = "600 11px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (let h = 0; h < kindOf.length; h++) {
    const [from, to] = [offsets[h] as number, offsets[h + 1] as number];
    const [a, b] = [view.toPixels(place(corners, from)), view.toPixels(place(corners, from + 1))];
    // Semi-hexagons have four corners, and their own colour.
    if (to - from < 6 || Math.hypot(a[0] - b[0], a[1] - b[1]) < LEAST_CODED) {
      continue;
    }
    const opposite = view.toPixels(place(corners, from + 3));
    const [x, y] = [(a[0] + opposite[0]) / 2, (a[1] + opposite[1]) / 2];
    const kind = kinds[kindOf[h] as number];
    if (kind && x > 0 && y > 0 && x < view.width && y < view.height) {
      context.fillStyle = kind.ink;
      // Beside the centre, where a point may be.
      context.fillText(kind.code, x, y + LEAST_CODED * 0.6);
    }
  }
  context.textAlign = "start";
  context.textBaseline = "alphabetic";
}

function drawInput(context: CanvasRenderingContext2D, view: View, theme: Theme, scene: Scene, radius: number): void {
  const { doc } = scene;
  stroke(context, view, doc.points, doc.segments, theme.segment, 2);
  if (scene.chain && scene.pointer) {
    context.beginPath();
    context.moveTo(...view.toPixels(scene.chain));
    context.lineTo(...view.toPixels(scene.pointer));
    context.setLineDash([5, 4]);
    context.strokeStyle = theme.cursor;
    context.lineWidth = 1.5;
    context.stroke();
    context.setLineDash([]);
  }
  drawPoints(context, view, theme, scene, radius);
  for (let h = 0; h < doc.holes.length / 2; h++) {
    const [x, y] = view.toPixels(place(doc.holes, h));
    context.beginPath();
    context.moveTo(x - 5, y - 5);
    context.lineTo(x + 5, y + 5);
    context.moveTo(x - 5, y + 5);
    context.lineTo(x + 5, y - 5);
    context.strokeStyle = theme.hole;
    context.lineWidth = 2.5;
    context.stroke();
  }
}

function drawPoints(context: CanvasRenderingContext2D, view: View, theme: Theme, scene: Scene, radius: number): void {
  const count = scene.doc.points.length / 2;
  context.fillStyle = theme.point;
  context.beginPath();
  for (let i = 0; i < count; i++) {
    const [x, y] = view.toPixels(place(scene.doc.points, i));
    if (x < -9 || y < -9 || x > view.width + 9 || y > view.height + 9) {
      continue;
    }
    if (radius >= RINGED) {
      context.moveTo(x + radius, y);
      context.arc(x, y, radius, 0, 2 * Math.PI);
    } else {
      // Much faster, and no different at this size.
      context.fillRect(x - 0.9 * radius, y - 0.9 * radius, 1.8 * radius, 1.8 * radius);
    }
  }
  if (radius >= RINGED) {
    context.fill();
    context.strokeStyle = theme.ring;
    context.lineWidth = 1;
    context.stroke();
  }
  if (scene.held !== undefined && scene.held < count) {
    const [x, y] = view.toPixels(place(scene.doc.points, scene.held));
    ring(context, x, y, 8, theme.cursor);
  }
}

function drawMark(context: CanvasRenderingContext2D, view: View, theme: Theme, mark: Mark): void {
  const [x, y] = view.toPixels(mark.at);
  const colour = mark.kind === "fault" ? theme.fault : theme.note;
  ring(context, x, y, mark.kind === "fault" ? 12 : 7, colour);
  if (mark.label !== "") {
    context.font = "600 13px system-ui, sans-serif";
    context.lineWidth = 4;
    context.strokeStyle = theme.ring;
    context.strokeText(mark.label, x + 16, y + 4);
    context.fillStyle = colour;
    context.fillText(mark.label, x + 16, y + 4);
  }
}

function drawCursor(context: CanvasRenderingContext2D, theme: Theme, [x, y]: Place): void {
  context.beginPath();
  context.moveTo(x - 12, y);
  context.lineTo(x + 12, y);
  context.moveTo(x, y - 12);
  context.lineTo(x, y + 12);
  context.strokeStyle = theme.cursor;
  context.lineWidth = 2;
  context.stroke();
}

function ring(context: CanvasRenderingContext2D, x: number, y: number, radius: number, colour: string): void {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.strokeStyle = colour;
  context.lineWidth = 2.5;
  context.stroke();
}
