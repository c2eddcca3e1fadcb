// What a user's compiler must accept.

import { HexdelError, Session, generate, init, mesh, meshPslg, read, type Certificate, type Mesh, type Options } from "hexdel";

await init();
const options: Options = { minAngle: 30, size: [1, { polygon: [[0, 0], [1, 0], [0, 1]], length: 0.1 }] };
const made: Mesh = mesh([[0, 0], [1, 0]], options, (phase, done, total) => phase !== "certify" || done <= total);
const certificate: Certificate = made.certificate;
const bytes: Uint8Array = made.write("vtu");
const session: Session = made.session();
session.draft();
session.insert(Float64Array.of(0.25, 0.5), [3]);
session.draft(false);
const names: readonly string[] = made.hexagons()?.classNames ?? [];
const graph = read(new Uint8Array(), "a.poly");
meshPslg(graph).dual().cellOffsets.at(-1);
meshPslg({ points: graph.points, segments: graph.segments, regions: graph.regions }).free();
// @ts-expect-error: there is no such option.
mesh([[0, 0]], { minimum: 3 });
// @ts-expect-error: nor such a kind.
generate("random", 3);
if (certificate.delaunay && bytes.length > 0 && names.length > 0 && !(made instanceof HexdelError)) {
  throw new HexdelError({ kind: "option", message: "" });
}
