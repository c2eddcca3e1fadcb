//! Small inputs of meshing out of any bytes, and what every mesh must keep.
//!
//! Coordinates lie on a coarse grid, now and then a little off it, so that points
//! coincide, come close and lie in line more often than by chance, and meshes stay
//! small.

use hexdel::geom::{CertifyOptions, Region, certify};
use hexdel::{AngleBounds, DVec2, Domain, Mesher, Pslg, PslgTriangulation, Session};

/// Steps of the grid in each direction.
const SIDE: u8 = 8;

/// Bytes that are taken one after the other; zeros after the last.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    /// The next byte.
    pub fn next(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    /// A number below `n`.
    pub fn below(&mut self, n: u8) -> u8 {
        self.next() % n
    }

    /// Whether there are none left.
    pub fn is_over(&self) -> bool {
        self.0.is_empty()
    }

    /// A place on the grid, in one of eight cases off it by some sixteenths.
    pub fn place(&mut self) -> DVec2 {
        let [x, y] = [self.below(SIDE), self.below(SIDE)].map(f64::from);
        let off = self.next();
        if off % 8 > 0 {
            return DVec2::new(x, y);
        }
        let part = |nibble: u8| (f64::from(nibble) - 8.0) / 16.0;
        DVec2::new(x + part(off >> 4), y + part(off & 15))
    }

    /// Points, up to `most`.
    pub fn points(&mut self, most: u8) -> Vec<DVec2> {
        let count = 1 + self.below(most);
        (0..count).map(|_| self.place()).collect()
    }

    /// A PSLG with holes and regions; nothing says that it is planar.
    pub fn graph(&mut self) -> Pslg {
        let mut graph = Pslg::from_points(self.points(9));
        let n = graph.points.len() as u8;
        let segments = self.below(12);
        graph.segments = (0..segments).map(|_| [0, 1].map(|_| u32::from(self.below(n)))).collect();
        let holes = self.below(8).saturating_sub(5);
        graph.holes = (0..holes).map(|_| self.place() + DVec2::new(0.3, 0.1)).collect();
        let regions = self.below(8).saturating_sub(5);
        for i in 0..regions {
            let max_area = (self.below(4) == 0).then_some(1.5);
            let point = self.place() + DVec2::new(0.1, 0.3);
            graph.regions.push(Region { point, attribute: f64::from(i), max_area });
        }
        graph
    }

    /// A mesher of PSLGs.
    pub fn mesher(&mut self) -> Mesher {
        let mut mesher = Mesher::new().threads(1);
        let domains = [Domain::Inside, Domain::Hull, Domain::Box, Domain::Hexagon];
        if let Some(&domain) = domains.get(usize::from(self.below(5))) {
            mesher = mesher.domain(domain);
        }
        let bounds = [[0.0, 90.0], [20.0, 90.0], [20.0, 120.0], [35.0, 90.0]];
        if let Some(&[min, max]) = bounds.get(usize::from(self.below(8))) {
            mesher = mesher.near_bounds(AngleBounds::new(min, max).expect("these are bounds"));
        }
        if self.below(3) > 0 { mesher.repair() } else { mesher }
    }
}

/// What the mesh of a PSLG keeps whatever the PSLG is like.
///
/// # Panics
///
/// If it does not.
pub fn check_graph(made: &PslgTriangulation) {
    let options = CertifyOptions { bounds: made.certificate.bounds, ..CertifyOptions::default() };
    let c = certify(&made.mesh, &options);
    let broken = c.not_counter_clockwise + c.malformed + c.not_finite + c.repeated_edges + c.unused_vertices;
    assert_eq!(broken, 0, "{:?}", c.violations);
    assert!(made.segments.missing.is_empty(), "{:?}", made.segments.missing);
    assert_eq!(made.certificate.inputs_kept, made.certificate.inputs);
    // All that is out of bounds is listed, with a reason.
    assert!(c.out_of_bounds <= made.exempt.len() + made.failed.len());
    assert!(made.places.broken.len() <= made.failed.len());
    assert!(made.holds() || !made.failed.is_empty() || !c.delaunay);
}

/// What every state of a session keeps.
///
/// # Panics
///
/// If it does not.
pub fn check_session(session: &Session) {
    let check = session.check();
    assert!(check.holds(), "{:?} {:?} {:?}", check.segments.missing, check.out_of_bounds, check.certificate);
}
