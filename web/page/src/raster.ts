// Triangles into pixels. A path of a canvas takes seconds for what this does in a few
// milliseconds: fill a hundred thousand triangles, each with its colour.

import type { View } from "./view.js";

/** Fills triangles by rows of pixels whose centres are inside: no gaps, no overlaps. */
export class Raster {
  private image: ImageData | undefined;
  private pixels = new Uint32Array();
  /** Vertices in pixels. */
  private xy = new Float64Array();

  /**
   * An image of the canvas's size with all triangles, colours being those of a table that
   * `classes` chooses from.
   */
  draw(
    context: CanvasRenderingContext2D,
    ratio: number,
    view: View,
    mesh: { vertices: Float64Array; triangles: Uint32Array },
    classes: Uint8Array,
    colours: Uint32Array,
  ): void {
    const { width, height } = context.canvas;
    if (!this.image || this.image.width !== width || this.image.height !== height) {
      this.image = context.createImageData(width, height);
      this.pixels = new Uint32Array(this.image.data.buffer);
    } else {
      this.pixels.fill(0);
    }
    this.project(mesh.vertices, ratio, view);
    const { triangles } = mesh;
    for (let t = 0; t < classes.length; t++) {
      this.fill(
        triangles[3 * t] as number,
        triangles[3 * t + 1] as number,
        triangles[3 * t + 2] as number,
        colours[classes[t] as number] as number,
        width,
        height,
      );
    }
    context.putImageData(this.image, 0, 0);
  }

  private project(vertices: Float64Array, ratio: number, view: View): void {
    if (this.xy.length < vertices.length) {
      this.xy = new Float64Array(vertices.length);
    }
    const scale = view.scale * ratio;
    const [x0, y0] = view.toPlane([0, 0]);
    for (let i = 0; i < vertices.length; i += 2) {
      this.xy[i] = ((vertices[i] as number) - x0) * scale;
      this.xy[i + 1] = (y0 - (vertices[i + 1] as number)) * scale;
    }
  }

  private fill(a: number, b: number, c: number, colour: number, width: number, height: number): void {
    const { xy, pixels } = this;
    let [x1, y1] = [xy[2 * a] as number, xy[2 * a + 1] as number];
    let [x2, y2] = [xy[2 * b] as number, xy[2 * b + 1] as number];
    let [x3, y3] = [xy[2 * c] as number, xy[2 * c + 1] as number];
    if (y1 > y2) [x1, y1, x2, y2] = [x2, y2, x1, y1];
    if (y2 > y3) [x2, y2, x3, y3] = [x3, y3, x2, y2];
    if (y1 > y2) [x1, y1, x2, y2] = [x2, y2, x1, y1];
    const first = Math.max(0, Math.ceil(y1 - 0.5));
    const last = Math.min(height - 1, Math.ceil(y3 - 0.5) - 1);
    const long = (x3 - x1) / (y3 - y1);
    const upper = (x2 - x1) / (y2 - y1);
    const lower = (x3 - x2) / (y3 - y2);
    for (let row = first; row <= last; row++) {
      const y = row + 0.5;
      const p = x1 + (y - y1) * long;
      const q = y < y2 ? x1 + (y - y1) * upper : x2 + (y - y2) * lower;
      const from = Math.max(0, Math.ceil(Math.min(p, q) - 0.5));
      const to = Math.min(width, Math.ceil(Math.max(p, q) - 0.5));
      const start = row * width;
      for (let i = start + from; i < start + to; i++) {
        pixels[i] = colour;
      }
    }
  }
}
