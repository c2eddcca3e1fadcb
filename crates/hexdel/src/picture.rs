//! Pictures of the hexagon grid behind a mesh (paper, Fig. 3, 5 and 7).

use crate::triangulation::Triangulation;
use hexdel_classify::Class;
use hexdel_classify::hexagons::{Hexagon, hexagons};
use hexdel_io::{Overlay, OverlayClass, Polygon, Rgb};

/// The classes as they are named and coloured in pictures.
const CLASSES: [(Option<Class>, &str, Rgb); 11] = [
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

impl Triangulation {
    /// The hexagons whose dual the mesh is, with their classes.
    ///
    /// ```
    /// # use hexdel::DVec2;
    /// let made = hexdel::triangulate(&[DVec2::ZERO, DVec2::X])?;
    /// assert!(made.hexagons().iter().any(|h| h.class.is_some()));
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn hexagons(&self) -> Vec<Hexagon> {
        hexagons(self.refiner.grid(), self.patch.domain, &self.refiner.occupants())
    }

    /// The hexagon grid as a layer of a picture, coloured by class and level.
    ///
    /// ```
    /// # use hexdel::DVec2;
    /// let made = hexdel::triangulate(&[DVec2::ZERO, DVec2::X])?;
    /// assert_eq!(made.overlay().polygons.len(), made.hexagons().len());
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn overlay(&self) -> Overlay {
        overlay(self.hexagons())
    }
}

/// Hexagons as a layer of a picture, coloured by class and level.
///
/// ```
/// use hexdel::classify::hexagons::hexagons;
/// use hexdel::classify::Domain;
/// use hexdel::grid::{Address, Grid, Hex, Lattice};
/// # use hexdel::DVec2;
///
/// let mut grid = Grid::new(Lattice::new(DVec2::ZERO, 1.0));
/// grid.subdivide(Address::new(0, Hex::ORIGIN));
/// let domain = Domain { base_level: 0, radius: 2 };
/// let layer = hexdel::picture::overlay(hexagons(&grid, domain, &[]));
/// // 18 whole hexagons, the scaled centre and six fins.
/// assert_eq!(layer.polygons.len(), 25);
/// ```
pub fn overlay(hexagons: impl IntoIterator<Item = Hexagon>) -> Overlay {
    let polygon = |hexagon: Hexagon| Polygon {
        class: CLASSES.iter().position(|(c, _, _)| *c == hexagon.class).unwrap_or(0),
        level: u32::from(hexagon.address.level),
        corners: hexagon.corners,
    };
    Overlay {
        title: "hexagons by class".to_owned(),
        classes: CLASSES.map(|(_, label, colour)| OverlayClass { label: label.to_owned(), colour }).into(),
        polygons: hexagons.into_iter().map(polygon).collect(),
    }
}
