// Sliders below fields and choices: they set these, and follow them.

import { type Document, extent } from "./document.js";
import { element } from "./panel.js";

/** A way between what a field holds and a place on its slider. */
interface Slider {
  id: string;
  field(place: number): string;
  place(value: string): number;
}

const EFFORTS = ["fast", "standard", "best"];

/** Places on the slider of lengths over which a length falls to its half. */
const PER_HALF = 10;

function angle(id: string, usual: number): Slider {
  return { id, field: String, place: (value) => (value === "" ? usual : Number(value)) };
}

/** Lengths from that of the drawing down, in even ratios; none at the left end. */
function length(span: () => number): Slider {
  return {
    id: "size",
    field: (place) => (place === 0 ? "" : String(Number((span() * 2 ** (-place / PER_HALF)).toPrecision(3)))),
    place: (value) => (value === "" ? 0 : PER_HALF * Math.log2(span() / Number(value))),
  };
}

let sliders: Slider[] = [];

/** Makes the sliders work for a drawing. */
export function startSliders(drawing: () => Document): void {
  const span = () => {
    const [low, high] = extent(drawing().points) ?? [[0, 0], [1, 1]];
    return Math.max(high[0] - low[0], high[1] - low[1]) || 1;
  };
  const effort = { id: "effort", field: (place: number) => EFFORTS[place] ?? "standard", place: (v: string) => EFFORTS.indexOf(v) };
  sliders = [angle("min-angle", 43.9), angle("max-angle", 90), length(span), effort];
  for (const slider of sliders) {
    const [range, field] = [rangeOf(slider), fieldOf(slider)];
    range.addEventListener("input", () => {
      field.value = slider.field(range.valueAsNumber);
      say(range, field);
    });
    range.addEventListener("change", () => field.dispatchEvent(new Event("change")));
    field.addEventListener("change", showSliders);
  }
  showSliders();
}

/** Moves all sliders to where their fields are. */
export function showSliders(): void {
  for (const slider of sliders) {
    const [range, field] = [rangeOf(slider), fieldOf(slider)];
    range.value = String(slider.place(field.value));
    say(range, field);
  }
}

function say(range: HTMLInputElement, field: HTMLInputElement): void {
  range.setAttribute("aria-valuetext", field.value === "" ? field.placeholder : field.value);
}

function rangeOf(slider: Slider): HTMLInputElement {
  return element<HTMLInputElement>(`${slider.id}-slider`);
}

function fieldOf(slider: Slider): HTMLInputElement {
  return element<HTMLInputElement>(slider.id);
}
