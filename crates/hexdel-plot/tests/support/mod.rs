//! A mesh that several tests write.

use hexdel_geom::{DVec2, TriMesh, VertexId};

/// `n` by `n` squares, each halved from its lower left to its upper right corner.
pub(crate) fn squares(n: usize) -> TriMesh {
    let vertex = |x: usize, y: usize| VertexId::new(y * (n + 1) + x);
    let places = (0..=n).flat_map(|y| (0..=n).map(move |x| DVec2::new(x as f64, y as f64)));
    let cells = (0..n).flat_map(|y| (0..n).map(move |x| (x, y)));
    let triangles = cells.flat_map(|(x, y)| {
        let [a, b, c, d] = [vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)];
        [[a, b, c], [a, c, d]]
    });
    TriMesh { vertices: places.collect(), triangles: triangles.collect() }
}
