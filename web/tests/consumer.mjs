// What a user of the package does, in a folder where it is installed. Tests of
// package.test.mjs, which puts this file there.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { HexdelError, Session, formats, generate, init, input, mesh, meshPslg, read } from "hexdel";
import { ROOT, native } from "./native.mjs";

const fixture = (name) => readFileSync(join(ROOT, "fixtures", name));

/** Formats that the program and the package must write alike, byte for byte. */
const FORMATS = ["node", "ele", "vtu", "msh", "obj", "json", "ron", "svg", "14"];

function assertNative(made, name, ...options) {
  for (const [format, bytes] of native(name, FORMATS, ...options)) {
    assert.ok(bytes.equals(made.write(format)), `${name} as .${format}`);
  }
}

test("files are those of the program, byte for byte", () => {
  for (const name of ["points/five.node", "points/capitals.node", "tables/id_east_north.csv", "formats/survey.xyz"]) {
    assertNative(mesh(read(fixture(name), name)), name);
  }
  for (const name of ["graphs/letters.poly", "graphs/regions.poly", "polygons/lake_river.geojson"]) {
    assertNative(meshPslg(read(fixture(name), name)), name);
  }
});

test("options are those of the program", () => {
  const points = read(fixture("points/five.node"), "five.node");
  assertNative(mesh(points, { minAngle: 30, effort: "best" }), "points/five.node", "--min-angle=30", "--effort=best");
  assertNative(mesh(points, { method: "templates" }), "points/five.node", "--method=templates");
  const graph = read(fixture("graphs/regions.poly"), "regions.poly");
  assertNative(meshPslg(graph, { size: 0.5, domain: "box" }), "graphs/regions.poly", "--size=0.5", "--domain=box");
});

test("points come as typed arrays, numbers or pairs", () => {
  const pairs = [[0, 0], [1, 0.2], [0.3, 0.7]];
  const made = mesh(pairs);
  assert.ok(made.holds);
  assert.deepEqual(made.certificate.inputs_kept, 3);
  assert.ok(made.certificate.max_angle_deg <= 90 + 1e-9);
  const vertices = made.vertices;
  made.vertexOfInput.forEach((v, i) => assert.deepEqual([vertices[2 * v], vertices[2 * v + 1]], pairs[i]));
  for (const same of [Float64Array.from(pairs.flat()), pairs.flat(), input(pairs)]) {
    assert.deepEqual(mesh(same).vertices, vertices);
  }
});

test("a PSLG has holes, regions and markers", () => {
  const square = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [2, 1], [2, 2], [1, 2]];
  const segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
  const made = meshPslg({
    points: square,
    segments,
    holes: [[1.5, 1.5]],
    regions: [{ point: [3, 3], attribute: 7, maxArea: 0.2 }],
    segmentMarkers: [1, 2, 3, 4, 5, 5, 5, 5],
  });
  assert.ok(made.holds);
  assert.ok(made.regions.every((attribute) => attribute === 7));
  assert.ok(made.segmentEdgeMarkers.includes(5));
  const { areas } = made.dual();
  assert.ok(Math.abs(areas.reduce((a, b) => a + b) - 15) < 1e-9);
  assert.deepEqual(made.notes.failed, []);
});

test("errors are typed and name the place", () => {
  const failing = (call, expected) =>
    assert.throws(call, (error) => {
      assert.ok(error instanceof HexdelError, String(error));
      const { kind, item, index, location } = error;
      assert.deepEqual({ kind, item, index, location }, { item: undefined, index: [], location: undefined, ...expected });
      return true;
    });
  failing(() => mesh([]), { kind: "empty" });
  const nan = { kind: "not_finite", item: "point", index: [1] };
  assert.throws(() => mesh([[0, 0], [NaN, 1]]), (error) => error.kind === nan.kind && error.index[0] === 1);
  failing(() => mesh([[0, 0], [1e-300, 0]]), { kind: "too_close", item: "point", index: [0, 1], location: [0, 0] });
  failing(() => mesh([0, 1, 2]), { kind: "length" });
  failing(() => mesh([[0, 0]], { effrt: "fast" }), { kind: "option" });
  failing(() => mesh([[0, 0]], { minAngle: Infinity }), { kind: "option" });
  failing(() => mesh([[0, 0], [1, 1]], { minAngle: 59, maxAngle: 61 }), { kind: "no_grading" });
  failing(() => mesh([[0, 0], [1, 1]], { minDualEdge: 0.4 }), { kind: "dual_edge" });
  assert.ok(mesh([[0, 0], [1, 0], [0.3, 0.6]], { minDualEdge: 0.1 }).certificate.max_angle_deg < 84.3);
  const crossing = { points: [[0, 0], [1, 1], [0, 1], [1, 0]], segments: [[0, 1], [2, 3]] };
  failing(() => meshPslg(crossing), { kind: "crossing", item: "segment", index: [0, 1], location: [0.5, 0.5] });
  assert.ok(meshPslg(crossing, { repair: true, domain: "hull" }).holds);
  failing(() => meshPslg({ points: [[0, 0]], segments: [[0, -1]] }), { kind: "segment_end", item: "segment", index: [0] });
  failing(() => read("2 2 0 0\n0 0 zero\n", "a.node"), { kind: "file" });
  failing(() => read("", "a.docx"), { kind: "file" });
  failing(() => mesh([[0, 0]]).write("docx"), { kind: "file" });
  // The module is none the worse for them.
  assert.ok(mesh([[0, 0], [1, 0]]).holds);
});

test("progress is told, and stops the work", () => {
  const phases = new Set();
  mesh(generate("uniform", 300), {}, (phase) => void phases.add(phase));
  assert.ok(phases.has("optimize"), [...phases].join());
  const stopped = () => mesh(generate("uniform", 300), {}, () => false);
  assert.throws(stopped, (error) => error.kind === "cancelled");
});

test("a session changes the mesh step by step, and back", () => {
  const session = mesh(generate("uniform", 100)).session();
  const before = session.mesh();
  const [inserted] = session.insert([[0.5, 0.5]]);
  assert.equal(inserted.points.length, 1);
  const id = inserted.points[0];
  const moved = session.move(id, [0.5, 0.52]);
  assert.equal(session.ids.length, 101);
  const now = moved.at(-1).points[0];
  session.remove([now]);
  assert.throws(() => session.remove([now]), (error) => error.kind === "unknown_point");
  // All four calls are taken back; a move is one.
  for (let i = 0; i < 3; i++) session.undo();
  assert.throws(() => session.undo(), (error) => error.kind === "nothing_to_undo");
  assert.ok(session.mesh().holds);
  assert.deepEqual(session.mesh().triangles.length, before.triangles.length);
  const again = Session.load(session.save());
  assert.deepEqual(again.arrays(), session.arrays());
  assert.deepEqual(session.arrays().vertices, session.mesh().vertices);
});

test("a draft keeps the bounds and is taken back", () => {
  const made = mesh(generate("uniform", 100));
  const session = made.session();
  session.draft();
  const [removed] = session.remove([7]);
  assert.equal(removed.remeshed, false);
  for (const x of [0.3, 0.5, 0.7]) {
    session.insert([[x, 0.4]]);
    assert.ok(session.mesh().holds);
    session.undo();
  }
  assert.throws(() => session.insert([[90, 90]]), (error) => error.kind === "outside");
  session.undo();
  session.draft(false);
  assert.deepEqual(session.arrays().triangles, made.session().arrays().triangles);
  const quick = mesh(generate("uniform", 100), { effort: "draft" });
  assert.ok(quick.holds && quick.certificate.min_angle_deg > 43.8977);
  assert.ok(quick.triangles.length > made.triangles.length);
});

test("heights are kept and taken to be between others", () => {
  const points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]];
  // A plane: a point without a height gets that of the plane.
  const plane = ([x, y]) => 1 + 2 * x - y;
  const heights = points.map((p, i) => (i === 4 ? NaN : plane(p)));
  const given = input({ points, segments: [], heights });
  assert.deepEqual([...given.heights], points.map(plane));
  const made = mesh(given);
  assert.equal(made.heights.length, made.vertices.length / 2);
  made.vertexOfInput.forEach((v, i) => assert.equal(made.heights[v], plane(points[i])));
  const session = made.session();
  session.move(4, [3, 1]);
  const [inserted] = session.insert([[2, 2]], [9]);
  const now = session.mesh();
  const at = (x, y) => {
    const found = now.heights.filter((_, v) => now.vertices[2 * v] === x && now.vertices[2 * v + 1] === y);
    assert.equal(found.length, 1);
    return found[0];
  };
  assert.equal(inserted.points.length, 1);
  assert.equal(at(2, 2), 9);
  assert.equal(at(3, 1), plane([1, 2]), "a point that moves keeps its height");
  assert.equal(mesh(points).heights.length, 0);
  assert.throws(() => input({ points, segments: [], heights: [1] }), (error) => error.kind === "length");
});

test("the delta of a session leads from mesh to mesh", () => {
  const session = mesh(generate("uniform", 80)).session();
  const count = () => session.arrays().triangles.length / 3;
  let triangles = count();
  for (let k = 0; k < 12; k++) {
    for (const delta of session.move(session.ids.at(-1), [0.31 + 0.02 * k, 0.4])) {
      triangles += delta.trianglesAdded.ids.length - delta.trianglesRemoved.length;
    }
    assert.equal(count(), triangles);
  }
});

test("hexagons, histogram and angles", async () => {
  await init();
  const points = generate("clusters", 40);
  const made = mesh(points, { method: "templates" });
  const { offsets, corners, levels, classes, classNames } = made.hexagons();
  assert.equal(offsets.length, levels.length + 1);
  assert.equal(2 * offsets.at(-1), corners.length);
  assert.equal(classes.length, levels.length);
  const occupied = classes.filter((c) => classNames[c].startsWith("occupied")).length;
  assert.equal(occupied, 40);
  // Semi-hexagons have four corners, all others six.
  classes.forEach((c, i) => assert.equal(offsets[i + 1] - offsets[i], classNames[c] === "semi-hexagon" ? 4 : 6));
  assert.deepEqual(mesh(points, { method: "simple" }).hexagons().classNames, ["semi-hexagon", "full hexagon", "occupied"]);
  // A mesh that has grown out of the points has none.
  assert.ok(mesh(points, { minAngle: 30 }).hexagons() === undefined);
  const histogram = made.histogram(180);
  assert.equal(histogram.reduce((a, b) => a + b), made.triangles.length);
  assert.ok(histogram.slice(0, 43).every((n) => n === 0) && histogram.slice(91).every((n) => n === 0));
  assert.ok(formats().includes("vtu"));
  assert.ok(made.smallestAngles().every((angle) => angle > 43.8977 && angle <= 60.0001));
});
