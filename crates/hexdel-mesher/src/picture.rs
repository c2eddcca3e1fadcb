//! Pictures of the hexagon grid behind a mesh (paper, Fig. 3, 5 and 7).

use crate::mesher::Method;
use crate::triangulation::Triangulation;
use hexdel_classify::Class;
use hexdel_classify::hexagons::{Hexagon, holders};
use hexdel_plot::{Groups, Overlay, OverlayClass, Polygon, Rgb};

/// What a hexagon is in pictures.
type Kind = (Option<Class>, &'static str, Rgb);

/// The classes as they are named and coloured in pictures.
const CLASSES: [Kind; 11] = [
    (None, "semi-hexagon", Rgb([222, 222, 222])),
    (Some(Class::FixedCenterRegular), "fixed centre", Rgb([247, 247, 247])),
    (Some(Class::FixedCenterInRing), "fixed centre in ring", Rgb([253, 224, 178])),
    (Some(Class::MovedCenterInRing), "moved centre in ring", Rgb([253, 184, 99])),
    (Some(Class::Occupied1), "occupied 1", Rgb([230, 97, 1])),
    (Some(Class::Occupied2), "occupied 2", Rgb([178, 24, 43])),
    (Some(Class::MovedCenter1), "moved centre 1", Rgb([209, 229, 240])),
    (Some(Class::MovedCenter2), "moved centre 2", Rgb([146, 197, 222])),
    (Some(Class::MovedCenter3), "moved centre 3", Rgb([67, 147, 195])),
    (Some(Class::MovedCenter4), "moved centre 4", Rgb([118, 42, 131])),
    (Some(Class::Subdivide), "subdivide", Rgb([0, 0, 0])),
];

/// The same where nothing but occupied hexagons is told apart.
const PLAIN: [Kind; 3] = [
    (None, "semi-hexagon", Rgb([222, 222, 222])),
    (Some(Class::FixedCenterRegular), "full hexagon", Rgb([247, 247, 247])),
    (Some(Class::Occupied1), "occupied", Rgb([230, 97, 1])),
];

impl Triangulation {
    /// The hexagon grid as a layer of a picture, coloured by class and level; if
    /// the templates did not make the mesh, only occupied hexagons are told apart.
    ///
    /// ```
    /// # use hexdel::DVec2;
    /// let made = hexdel::triangulate(&[DVec2::ZERO, DVec2::X])?;
    /// assert_eq!(made.overlay().polygons.len(), made.hexagons().len());
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn overlay(&self) -> Overlay {
        match self.method {
            Method::Templates => overlay(self.hexagons()),
            Method::Simple | Method::Compact => plain_overlay(self.hexagons()),
        }
    }

    /// Triangles by the finest level of the hexagons at their corners, 0 the
    /// coarsest. None of [`Method::Compact`], whose mesh is no dual of hexagons.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Method};
    /// let made = Mesher::new().method(Method::Templates).triangulate(&[DVec2::ZERO, DVec2::X])?;
    /// let levels = made.levels().ok_or("no dual")?;
    /// assert_eq!(levels.classes.len(), usize::from(made.max_level) + 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn levels(&self) -> Option<Groups> {
        let hexagons = self.hexagons();
        let base = lowest_level(&hexagons);
        let of_triangle =
            self.by_corners(&hexagons, |hexagon| hexagon.map_or(0, |h| h.address.level - base), Ord::max)?;
        let count = of_triangle.iter().max().map_or(1, |&level| u32::from(level) + 1);
        let class = |level: u32| OverlayClass {
            label: format!("level {level}"),
            colour: Rgb::of_scale(f64::from(level) / f64::from((count - 1).max(1))),
        };
        Some(Groups {
            title: "level".to_owned(),
            classes: (0..count).map(class).collect(),
            of_triangle: of_triangle.into_iter().map(u32::from).collect(),
        })
    }

    /// Triangles by the class of the hexagons at their corners: of the three the one
    /// that comes first among occupied ones, moved, and fixed ones. None of
    /// [`Method::Compact`], whose mesh is no dual of hexagons.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Method};
    /// let points = [DVec2::ZERO, DVec2::X];
    /// let made = Mesher::new().method(Method::Templates).triangulate(&points)?;
    /// assert!(made.classes().is_some());
    /// let compact = Mesher::new().method(Method::Compact).triangulate(&points)?;
    /// assert!(compact.classes().is_none());
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn classes(&self) -> Option<Groups> {
        let kinds = if self.method == Method::Simple { &PLAIN[..] } else { &CLASSES[..] };
        // A semi-hexagon says nothing: it has the inserted point of a moved centre.
        let first = |a: Option<Class>, b| a.into_iter().chain(b).min();
        let of_triangle = self.by_corners(&self.hexagons(), |h| h.and_then(|h| h.class), first)?;
        Some(Groups {
            title: "class of a corner".to_owned(),
            classes: kinds.iter().map(class_of).collect(),
            of_triangle: of_triangle.into_iter().map(|class| index_in(kinds, class) as u32).collect(),
        })
    }

    /// For each triangle what `choose` leaves of what the hexagons of its corners
    /// are.
    fn by_corners<T: Copy>(
        &self,
        hexagons: &[Hexagon],
        what: impl Fn(Option<&Hexagon>) -> T,
        choose: impl Fn(T, T) -> T,
    ) -> Option<Vec<T>> {
        if self.method == Method::Compact {
            return None;
        }
        let grid = self.grid.as_ref()?;
        let holders = holders(grid.refiner.grid(), hexagons, &self.mesh.vertices);
        let of_vertex: Vec<T> = holders.into_iter().map(|i| what(i.map(|i| &hexagons[i]))).collect();
        let of_triangle = self.mesh.triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|v| of_vertex[v.index()]);
            choose(choose(a, b), c)
        });
        Some(of_triangle.collect())
    }
}

/// Hexagons as a layer of a picture, coloured by class and level.
///
/// ```
/// use hexdel::{Address, DVec2, Hex};
/// use hexdel_classify::{Domain, hexagons::hexagons};
/// use hexdel_grid::{Grid, Lattice};
///
/// let mut grid = Grid::new(Lattice::new(DVec2::ZERO, 1.0));
/// grid.subdivide(Address::new(0, Hex::ORIGIN));
/// let domain = Domain { base_level: 0, radius: 2 };
/// let layer = hexdel::picture::overlay(hexagons(&grid, domain, &[]));
/// // 18 whole hexagons, the scaled centre and six fins.
/// assert_eq!(layer.polygons.len(), 25);
/// ```
pub fn overlay(hexagons: Vec<Hexagon>) -> Overlay {
    layer(hexagons, &CLASSES, "hexagons by class")
}

/// Hexagons as a layer of a picture, coloured by level, only occupied ones told
/// apart: where no template moves a centre the other classes are without meaning.
///
/// ```
/// # use hexdel::{DVec2, Mesher, Method};
/// let made = Mesher::new().method(Method::Simple).triangulate(&[DVec2::ZERO, DVec2::X])?;
/// assert_eq!(made.overlay(), hexdel::picture::plain_overlay(made.hexagons()));
/// # Ok::<(), hexdel::Error>(())
/// ```
pub fn plain_overlay(hexagons: Vec<Hexagon>) -> Overlay {
    layer(hexagons, &PLAIN, "hexagons")
}

fn layer(hexagons: Vec<Hexagon>, kinds: &[Kind], title: &str) -> Overlay {
    let base = lowest_level(&hexagons);
    let polygon = |hexagon: Hexagon| Polygon {
        class: index_in(kinds, hexagon.class),
        level: u32::from(hexagon.address.level - base),
        corners: hexagon.corners,
    };
    Overlay {
        title: title.to_owned(),
        classes: kinds.iter().map(class_of).collect(),
        polygons: hexagons.into_iter().map(polygon).collect(),
    }
}

fn lowest_level(hexagons: &[Hexagon]) -> u8 {
    hexagons.iter().map(|h| h.address.level).min().unwrap_or(0)
}

fn class_of((_, label, colour): &Kind) -> OverlayClass {
    OverlayClass { label: (*label).to_owned(), colour: *colour }
}

/// The kind of a class; where classes are not told apart, occupied or fixed.
fn index_in(kinds: &[Kind], class: Option<Class>) -> usize {
    let find = |class| kinds.iter().position(|(c, _, _)| *c == class);
    let plain = match class {
        Some(Class::Occupied1 | Class::Occupied2) => Class::Occupied1,
        _ => Class::FixedCenterRegular,
    };
    find(class).or_else(|| find(Some(plain))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesher;
    use hexdel::generate::{Kind, generate};

    #[test]
    fn triangles_of_a_point_are_those_of_its_hexagon() {
        let points = generate(Kind::Clusters, 60, 3);
        for method in [Method::Templates, Method::Simple] {
            let made = Mesher::new().method(method).triangulate(&points).unwrap();
            let classes = made.classes().unwrap();
            let mut is_input = vec![false; made.mesh.vertices.len()];
            for v in &made.vertex_of_input {
                is_input[v.index()] = true;
            }
            for (corners, &class) in made.mesh.triangles.iter().zip(&classes.of_triangle) {
                let label = &classes.classes[class as usize].label;
                let at_point = corners.iter().any(|v| is_input[v.index()]);
                assert_eq!(label.starts_with("occupied"), at_point, "{method:?} {label}");
            }
        }
    }

    #[test]
    fn finer_levels_have_smaller_triangles() {
        let templates = Mesher::new().method(Method::Templates);
        let made = templates.triangulate(&generate(Kind::Clusters, 60, 3)).unwrap();
        let levels = made.levels().unwrap();
        assert_eq!(levels.classes.len(), usize::from(made.max_level) + 1);
        let grid = made.grid.as_ref().unwrap();
        let base = grid.refiner.grid().lattice().spacing(grid.domain.base_level);
        for (corners, &level) in made.mesh.triangles.iter().zip(&levels.of_triangle) {
            let [a, b, c] = corners.map(|v| made.mesh.vertices[v.index()]);
            let steps = f64::from(1 << level) / base;
            let edges = [a.distance(b), b.distance(c), c.distance(a)].map(|edge| edge * steps);
            // An edge of the finest level among the corners is about a step long.
            assert!(edges.iter().all(|e| (0.3..2.5).contains(e)), "{level} {edges:?}");
        }
    }

    #[test]
    fn the_simple_method_tells_occupied_hexagons_only() {
        let points = generate(Kind::Uniform, 40, 1);
        let made = Mesher::new().method(Method::Simple).triangulate(&points).unwrap();
        let overlay = made.overlay();
        let count = |label: &str| {
            let is = |p: &&Polygon| overlay.classes[p.class].label == label;
            overlay.polygons.iter().filter(is).count()
        };
        assert_eq!(count("occupied"), 40);
        let semi = made.hexagons().iter().filter(|h| h.class.is_none()).count();
        assert_eq!(count("semi-hexagon"), semi);
        assert_eq!(count("full hexagon"), overlay.polygons.len() - 40 - semi);
        let moved = |h: &Hexagon| matches!(h.class, Some(Class::MovedCenter1 | Class::MovedCenter2));
        assert!(made.hexagons().iter().any(moved));
    }
}
