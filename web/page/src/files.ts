// Examples, and files that are saved.

/** The examples: a file beside the page, or test points of a kind. Letters are those of the paper's six inputs. */
export const EXAMPLES = [
  { name: "Capital cities (points)", file: "capitals.node" },
  { name: "Nested clusters (points)", file: "nested_clusters.node" },
  { name: "Five points", file: "five.node" },
  { name: "Two close points (paper, a)", file: "two_close.node" },
  { name: "100 points on a line (paper, b)", file: "line100.node" },
  { name: "100 points in the plane (paper, c)", file: "plane100.node" },
  { name: "Letters (paper, d)", file: "letters.poly" },
  { name: "1,000 uniform points (paper, e)", kind: "uniform", count: 1000 },
  { name: "2,000 uniform points (paper, f)", kind: "uniform", count: 2000 },
  { name: "Airfoil (outline)", file: "airfoil.poly" },
  { name: "Square with a hole", file: "square_with_hole.poly" },
  { name: "Regions", file: "regions.poly" },
  { name: "Lake and river (GeoJSON)", file: "lake_river.geojson" },
  { name: "A coast with islands (GeoJSON)", file: "coast.geojson" },
  { name: "Crossing segments (an error)", file: "crossing.poly" },
] as const;

/** Hands a file to the user. */
export function download(name: string, content: BlobPart, type = "application/octet-stream"): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** The name of a file without its folder and extension. */
export function stem(name: string): string {
  return name.replace(/^.*[/\\]/, "").replace(/\.[^.]*$/, "") || "mesh";
}
