// Where the picture is: from the plane to pixels and back.

import type { Place } from "./document.js";

/** The most a pixel may be magnified: coordinates end there. */
const FINEST = 1e-13;

export class View {
  /** The place in the middle of the canvas. */
  centre: Place = [0.5, 0.5];
  /** Pixels of the canvas per unit. */
  scale = 300;
  /** Size of the canvas, in CSS pixels. */
  width = 1;
  height = 1;

  toPixels([x, y]: Place): Place {
    return [
      (x - this.centre[0]) * this.scale + this.width / 2,
      (this.centre[1] - y) * this.scale + this.height / 2,
    ];
  }

  toPlane([px, py]: Place): Place {
    return [
      (px - this.width / 2) / this.scale + this.centre[0],
      this.centre[1] - (py - this.height / 2) / this.scale,
    ];
  }

  /** Shows a box with a margin around it. */
  fit([low, high]: readonly [Place, Place], margin = 0.06): void {
    this.centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    const [w, h] = [high[0] - low[0], high[1] - low[1]];
    const usable = 1 - 2 * margin;
    const scale = Math.min((this.width * usable) / w, (this.height * usable) / h);
    this.scale = Number.isFinite(scale) && scale > 0 ? scale : 300;
  }

  pan(dx: number, dy: number): void {
    this.centre = [this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale];
  }

  /** Magnifies; the place under a pixel stays there. */
  zoom(factor: number, at: Place): void {
    const fixed = this.toPlane(at);
    const reach = Math.max(Math.abs(this.centre[0]), Math.abs(this.centre[1]), 1e-300);
    const most = 1 / (FINEST * reach);
    this.scale = Math.min(Math.max(this.scale * factor, 1e-290), most);
    const moved = this.toPixels(fixed);
    this.pan(at[0] - moved[0], at[1] - moved[1]);
  }
}
