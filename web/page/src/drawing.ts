// The canvas: what is shown in it, and pointers and keys on it.

import { type Theme, themeOf } from "./colours.js";
import { type Document, type Place, extent, withHole, withPoint } from "./document.js";
import { type Grid, type GridBy, gridOf } from "./grid.js";
import type { Overlaid } from "./protocol.js";
import { type DrawnMesh, type Mark, Painter } from "./scene.js";
import { Chain, type Hit, TOOLS, type Tool, dragged, erased, hitAt } from "./tools.js";
import { View } from "./view.js";

/** A pointer that moves less than this many pixels clicks. */
const SLACK = 4;

/** Pixels that an arrow key moves the cursor, and the picture. */
const STRIDE = 10;
const PAN_STRIDE = 60;

/** What the drawing asks of the page. */
export interface Host {
  doc(): Document;
  /** A new input: whether a drag goes on, and whether it continues the last edit. */
  edit(doc: Document, live: boolean, continues: boolean): void;
  undo(): void;
  redo(): void;
  escape(): void;
  toolChanged(tool: Tool): void;
  say(text: string): void;
}

/** What a pointer does. */
interface Gesture {
  readonly start: Place;
  readonly held: Hit | undefined;
  readonly pans: boolean;
  last: Place;
  moved: boolean;
}

export class Drawing {
  readonly view = new View();
  overlays: Overlaid = { dual: undefined, hexagons: undefined };
  gridBy: GridBy = "levels";
  /** Whether changes of points are steps of a session. */
  hasSession = false;
  /** Milliseconds that the last frame took. */
  frame = 0;

  private readonly context: CanvasRenderingContext2D;
  private readonly painter = new Painter();
  private readonly chain = new Chain();
  private theme: Theme = themeOf(false);
  private tool: Tool = "points";
  private mesh: DrawnMesh | undefined;
  private grid: Grid | undefined;
  private notes: readonly Mark[] = [];
  private fault: Mark | undefined;
  private gesture: Gesture | undefined;
  private readonly touches = new Map<number, Place>();
  private pointer: Place | undefined;
  private cursor: Place | undefined;
  /** What the keyboard has taken up. */
  private taken: Hit | undefined;
  private asked = false;
  /** Whether the mesh that comes next is to be shown whole. */
  private fitsNext = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly host: Host,
  ) {
    const context = canvas.getContext("2d");
    if (!context) {
      throw new Error("this browser does not draw");
    }
    this.context = context;
    new ResizeObserver(() => this.resize()).observe(canvas);
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.up(event, true));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("dblclick", () => this.endChain());
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("blur", () => this.showCursor(undefined));
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.setOverlays(this.overlays);
  }

  setTool(tool: string): void {
    this.tool = TOOLS.find((t) => t === tool) ?? "points";
    this.endChain();
    this.canvas.style.cursor = this.tool === "pan" ? "grab" : "crosshair";
    this.host.toolChanged(this.tool);
  }

  /** Shows a mesh with what is to be seen over it. */
  setMesh(mesh: (DrawnMesh & Overlaid) | undefined): void {
    this.mesh = mesh;
    this.notes = [];
    this.setOverlays({ dual: mesh?.dual, hexagons: mesh?.hexagons });
    if (this.fitsNext && mesh) {
      // It covers more than its points.
      this.fitsNext = false;
      this.fit();
    }
    this.refresh();
  }

  setOverlays(overlays: Overlaid): void {
    this.overlays = overlays;
    this.grid = overlays.hexagons && gridOf(overlays.hexagons, this.gridBy, this.theme.dark);
    this.refresh();
  }

  /** Colours hexagons by what they are. */
  setGridBy(by: GridBy): void {
    this.gridBy = by;
    this.setOverlays(this.overlays);
  }

  setNotes(notes: readonly Mark[]): void {
    this.notes = notes;
    this.refresh();
  }

  setFault(fault: { at: Place | undefined; kind: "fault"; label: string } | undefined): void {
    this.fault = fault?.at && { ...fault, at: fault.at };
    this.refresh();
  }

  endChain(): void {
    this.chain.end();
    this.refresh();
  }

  /** Begins with another input, without a mesh. All of it is shown, and its mesh when it comes. */
  begin(): void {
    this.endChain();
    this.setMesh(undefined);
    this.fitsNext = this.host.doc().points.length > 0;
    this.fit();
  }

  /** Shows the whole mesh and the input. */
  fit(): void {
    const { points } = this.host.doc();
    const all = this.mesh ? Float64Array.from([...points, ...boxOf(this.mesh.vertices)]) : points;
    const box = extent(all);
    if (box) {
      this.view.fit(box);
      this.refresh();
    }
  }

  zoom(factor: number, at: Place = [this.view.width / 2, this.view.height / 2]): void {
    this.view.zoom(factor, at);
    this.refresh();
  }

  /** Draws with the next frame. */
  refresh(): void {
    if (!this.asked) {
      this.asked = true;
      requestAnimationFrame(() => {
        this.asked = false;
        this.drawNow();
      });
    }
  }

  /** Draws at once, and says how many milliseconds that took. */
  drawNow(): number {
    const begun = performance.now();
    const ratio = this.canvas.width / Math.max(1, this.view.width);
    const { mesh, grid, chain } = this;
    const held = this.gesture?.held ?? this.taken;
    this.painter.draw(this.context, ratio, this.view, this.theme, {
      doc: this.host.doc(),
      mesh,
      dual: this.overlays.dual,
      grid,
      marks: this.fault ? [...this.notes, this.fault] : this.notes,
      held: held?.kind === "point" ? held.index : undefined,
      chain: chain.last === undefined ? undefined : placeOf(this.host.doc(), chain.last),
      pointer: this.pointer && this.view.toPlane(this.pointer),
      cursor: this.cursor,
    });
    this.frame = performance.now() - begun;
    return this.frame;
  }

  /** The picture as it stands, on paper. */
  async picture(): Promise<Blob> {
    this.drawNow();
    const copy = document.createElement("canvas");
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    const context = copy.getContext("2d");
    if (context) {
      context.fillStyle = this.theme.paper;
      context.fillRect(0, 0, copy.width, copy.height);
      context.drawImage(this.canvas, 0, 0);
    }
    return new Promise((resolve, reject) =>
      copy.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no picture")))),
    );
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const first = this.view.width <= 1;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    this.canvas.width = Math.max(1, Math.round(clientWidth * ratio));
    this.canvas.height = Math.max(1, Math.round(clientHeight * ratio));
    this.view.width = Math.max(1, clientWidth);
    this.view.height = Math.max(1, clientHeight);
    if (first) {
      this.fit();
    }
    this.refresh();
  }

  private at(event: PointerEvent | WheelEvent): Place {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private down(event: PointerEvent): void {
    this.canvas.focus({ preventScroll: true });
    this.showCursor(undefined);
    this.canvas.setPointerCapture(event.pointerId);
    const at = this.at(event);
    if (event.pointerType === "touch") {
      this.touches.set(event.pointerId, at);
      if (this.touches.size > 1) {
        this.abandon();
        return;
      }
    }
    const reach = event.pointerType === "touch" ? 22 : undefined;
    const hit = hitAt(this.host.doc(), this.view, at, reach);
    const pans = this.tool === "pan" || event.button === 1 || event.button === 2;
    const drags = !pans && hit !== undefined && hit.kind !== "segment" && this.tool !== "erase" && this.tool !== "segments";
    this.gesture = { start: at, held: drags ? hit : undefined, pans, last: at, moved: false };
    this.refresh();
  }

  /** A second finger: what the first one did is no click, and no drag any more. */
  private abandon(): void {
    if (this.gesture?.held && this.gesture.moved) {
      this.host.edit(this.host.doc(), false, true);
    }
    this.gesture = undefined;
  }

  private move(event: PointerEvent): void {
    const at = this.at(event);
    if (this.touches.has(event.pointerId) && this.touches.size > 1) {
      this.pinch(event.pointerId, at);
      return;
    }
    this.pointer = at;
    const gesture = this.gesture;
    if (!gesture) {
      if (this.chain.last !== undefined) {
        this.refresh();
      }
      return;
    }
    const far = Math.hypot(at[0] - gesture.start[0], at[1] - gesture.start[1]) > SLACK;
    const first = far && !gesture.moved;
    gesture.moved ||= far;
    if (gesture.moved && gesture.held) {
      this.host.edit(dragged(this.host.doc(), gesture.held, this.view.toPlane(at)), true, !first);
    } else if (gesture.moved && (gesture.pans || this.tool !== "segments")) {
      // Nothing is held: the picture moves.
      this.view.pan(at[0] - gesture.last[0], at[1] - gesture.last[1]);
    }
    gesture.last = at;
    this.refresh();
  }

  private pinch(id: number, at: Place): void {
    const [a, b] = [...this.touches.values()];
    this.touches.set(id, at);
    const [c, e] = [...this.touches.values()];
    if (!a || !b || !c || !e) {
      return;
    }
    const middle = (p: Place, q: Place): Place => [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
    const distance = (p: Place, q: Place) => Math.hypot(p[0] - q[0], p[1] - q[1]);
    const [from, to] = [middle(a, b), middle(c, e)];
    this.view.pan(to[0] - from[0], to[1] - from[1]);
    this.zoom(distance(c, e) / Math.max(1, distance(a, b)), to);
  }

  private up(event: PointerEvent, cancelled = false): void {
    this.touches.delete(event.pointerId);
    const gesture = this.gesture;
    this.gesture = undefined;
    if (!gesture) {
      return;
    }
    if (gesture.held && gesture.moved) {
      // The drag ends where it is: now with all that takes longer.
      this.host.edit(this.host.doc(), false, true);
    } else if (!gesture.moved && !gesture.pans && !cancelled) {
      this.click(this.at(event), gesture.held !== undefined);
    }
    this.refresh();
  }

  /** A click; on something that is there, points and holes do nothing. */
  private click(at: Place, occupied: boolean): void {
    const doc = this.host.doc();
    switch (this.tool) {
      case "points":
        return occupied ? undefined : this.host.edit(withPoint(doc, this.view.toPlane(at)), false, false);
      case "holes":
        return occupied ? undefined : this.host.edit(withHole(doc, this.view.toPlane(at)), false, false);
      case "segments":
        return this.host.edit(this.chain.click(doc, this.view, at), false, false);
      case "erase":
        this.endChain();
        return this.host.edit(erased(doc, this.view, at), false, false);
      case "pan":
    }
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 20 : 1;
    this.zoom(Math.exp(-event.deltaY * lines * 0.0015), this.at(event));
  }

  private key(event: KeyboardEvent): void {
    const handled = this.act(event);
    if (handled) {
      event.preventDefault();
    }
  }

  /** What a key does; whether it does anything. */
  private act(event: KeyboardEvent): boolean {
    const command = event.ctrlKey || event.metaKey;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (command) {
      if (key === "z" && !event.shiftKey) this.host.undo();
      else if (key === "y" || key === "z") this.host.redo();
      else return false;
      return true;
    }
    const arrows: Record<string, Place> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const arrow = arrows[key];
    if (arrow) {
      this.arrow(arrow, event.shiftKey);
      return true;
    }
    const tool = TOOLS[Number(key) - 1];
    if (tool) {
      this.setTool(tool);
      this.host.say(`Tool: ${tool}.`);
      return true;
    }
    switch (key) {
      case "+":
      case "=":
        this.zoom(1.25, this.cursor);
        return true;
      case "-":
        this.zoom(0.8, this.cursor);
        return true;
      case "0":
        this.fit();
        return true;
      case "Enter":
        this.enter();
        return true;
      case " ":
        this.takeOrPut();
        return true;
      case "Delete":
      case "Backspace":
        this.host.edit(erased(this.host.doc(), this.view, this.cursorOrMiddle()), false, false);
        return true;
      case "Escape":
        this.endChain();
        this.taken = undefined;
        this.host.escape();
        return true;
      default:
        return false;
    }
  }

  private cursorOrMiddle(): Place {
    return this.cursor ?? [this.view.width / 2, this.view.height / 2];
  }

  private showCursor(at: Place | undefined): void {
    this.cursor = at;
    if (!at) {
      this.taken = undefined;
    }
    this.refresh();
  }

  private arrow([x, y]: Place, pans: boolean): void {
    if (pans) {
      this.view.pan(-x * PAN_STRIDE, -y * PAN_STRIDE);
      this.refresh();
      return;
    }
    const at = this.cursorOrMiddle();
    const clamp = (value: number, most: number) => Math.min(Math.max(value, 0), most);
    const to: Place = [clamp(at[0] + x * STRIDE, this.view.width), clamp(at[1] + y * STRIDE, this.view.height)];
    this.showCursor(to);
    this.pointer = to;
    if (this.taken) {
      this.host.edit(dragged(this.host.doc(), this.taken, this.view.toPlane(to)), true, true);
    } else {
      const hit = hitAt(this.host.doc(), this.view, to);
      const [px, py] = this.view.toPlane(to);
      const on = hit ? `, on ${hit.kind} ${hit.index}` : "";
      this.host.say(`Cursor at ${px.toPrecision(5)}, ${py.toPrecision(5)}${on}.`);
    }
  }

  private enter(): void {
    const at = this.cursorOrMiddle();
    this.showCursor(at);
    this.click(at, hitAt(this.host.doc(), this.view, at)?.kind === "point");
  }

  private takeOrPut(): void {
    const at = this.cursorOrMiddle();
    if (this.taken) {
      this.taken = undefined;
      this.host.edit(this.host.doc(), false, true);
      this.host.say("Put down.");
      return;
    }
    const hit = hitAt(this.host.doc(), this.view, at, 20);
    if (hit && hit.kind !== "segment") {
      this.showCursor(at);
      this.taken = hit;
      // An edit of its own, which the arrows continue.
      this.host.edit(dragged(this.host.doc(), hit, this.view.toPlane(at)), true, false);
      this.host.say(`Taken up: ${hit.kind} ${hit.index}. Arrow keys move it, Space puts it down.`);
    } else {
      this.host.say("There is nothing to take up here.");
    }
  }
}

function placeOf(doc: Document, index: number): Place {
  return [doc.points[2 * index] ?? NaN, doc.points[2 * index + 1] ?? NaN];
}

/** The corners of the box around points, flat. */
function boxOf(flat: Float64Array): number[] {
  return (extent(flat) ?? []).flat();
}
