//! Local coarsening makes 7 hexagons of 37, and 60 triangles of 96 (paper, section 5.3).

use hexdel_classify::hexagons::hexagons;
use hexdel_classify::{Class, Domain, Relocation, extract};
use hexdel_geom::{DVec2, Unwatched};
use hexdel_grid::{Address, Direction, Grid, Hex, HexKind, Lattice};

/// The leaves that a blossom is about: of level 0 after, of level 1 before.
fn leaves(grid: &Grid) -> [usize; 2] {
    let of = |level: u8, radius: u32| {
        let all = Hex::ORIGIN.disc(radius).map(|hex| Address::new(level, hex));
        all.filter(|&at| grid.kind(at) == HexKind::Leaf).count()
    };
    [of(0, 1), of(1, 3)]
}

/// Triangles within the hexagon whose corners are two steps from the middle.
fn triangles(grid: &mut Grid, domain: Domain) -> usize {
    let dual = extract(grid, &[], domain, Relocation::Full, &Unwatched).expect("the mesh is small");
    let inside = |p: DVec2| {
        Direction::ALL.iter().all(|d| {
            // Half-way between two directions lies the middle of a side.
            let side = DVec2::from_angle((60.0 * d.index() as f64 + 30.0).to_radians());
            side.dot(p) < 3_f64.sqrt()
        })
    };
    let middles = dual.mesh.triangles.iter().map(|t| {
        let [a, b, c] = t.map(|v| dual.mesh.vertices[v.index()]);
        (a + b + c) / 3.0
    });
    middles.filter(|&middle| inside(middle)).count()
}

#[test]
fn a_blossom_replaces_37_hexagons_by_7_and_96_triangles_by_60() {
    let mut grid = Grid::new(Lattice::new(DVec2::ZERO, 1.0));
    for hex in Hex::ORIGIN.disc(2) {
        grid.subdivide(Address::new(0, hex));
    }
    let domain = Domain::around(&grid, 0).expect("nothing lies above level 0");
    assert_eq!(leaves(&grid), [0, 37]);
    assert_eq!(triangles(&mut grid, domain), 96);

    for hex in Hex::ORIGIN.disc(1) {
        grid.merge(Address::new(0, hex)).expect("nothing finer needs it");
    }
    assert_eq!(leaves(&grid), [7, 0]);
    assert_eq!(triangles(&mut grid, domain), 60);

    let all = hexagons(&grid, domain, &[]);
    let middle = |h: &&hexdel_classify::hexagons::Hexagon| h.address.level == 0 && h.address.hex.norm() <= 1;
    let count = |class| all.iter().filter(middle).filter(|h| h.class == Some(class)).count();
    assert_eq!([Class::MovedCenter3, Class::MovedCenter4].map(count), [6, 1]);
}
