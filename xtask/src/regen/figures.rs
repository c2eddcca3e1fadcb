//! The figures of `docs/algorithm.md`, and the pair of meshes in `docs/compact.md`.
//!
//! Two kinds: fixtures as the facade meshes them (paper, Fig. 3, 4, 5 and 7),
//! and the templates of relocation, each on the smallest grid that has it
//! (Fig. 8 and 9). Those grids are made by hand, so every figure's mesh is
//! certified before it is drawn.

use super::{Files, gallery};
use crate::prove;
use hexdel::geom::Pslg;
use hexdel::geom::{CertifyOptions, certify};
use hexdel::io::{MarkedEdge, MeshFormat, MeshView, read_points, write_mesh_to};
use hexdel::plot::{Overlay, Picture};
use hexdel::pslg::{Extent, Options, SegmentMethod, validate};
use hexdel::{AngleBounds, DVec2, Mesher, Method, TriMesh, Unwatched};
use hexdel_classify::hexagons::hexagons;
use hexdel_classify::{Domain, Occupant, Relocation, extract};
use hexdel_grid::{Address, Direction, Grid, Hex, Lattice};
use hexdel_refine::{Refiner, RuleSet};
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::path::Path;

/// The longer side of a template, pixels.
const SMALL_PX: f64 = 360.0;

/// The longer side of a meshed fixture, pixels.
const LARGE_PX: f64 = 640.0;

/// Where the figures lie, below the documents.
pub(super) const FOLDER: &str = "figures/algorithm";

/// Every figure by its path below the documents.
pub(super) fn all(root: &Path) -> Result<Files, Box<dyn Error>> {
    let mut figures = of_fixture(root, "five")?;
    figures.extend(of_grid()?);
    figures.extend(of_templates()?);
    figures.extend(of_points()?);
    figures.extend(of_methods(root, "plane100")?);
    figures.extend(super::paper::all());
    figures.extend(prove::paper_figures()?);
    figures.extend(of_segments(root)?);
    Ok(figures.into_iter().map(|(name, svg)| (format!("{FOLDER}/{name}"), svg)).collect())
}

type Figures = Result<Vec<(String, Vec<u8>)>, Box<dyn Error>>;

/// A fixture: its grid, the dual over it, and the mesh by angles; refined
/// simply and fully.
fn of_fixture(root: &Path, name: &str) -> Result<BTreeMap<String, Vec<u8>>, Box<dyn Error>> {
    let points = read_points(root.join(format!("fixtures/points/{name}.node")))?.points;
    let mut figures = BTreeMap::new();
    for (method, suffix) in [(Method::Simple, "simple"), (Method::Templates, "templates")] {
        let made = Mesher::new().method(method).triangulate(&points)?;
        let drawing = Drawing {
            mesh: &made.mesh,
            inputs: made.input_of_vertex(),
            overlay: made.overlay(),
            bounds: method.bounds(),
            size_px: LARGE_PX,
        };
        figures.insert(format!("{name}-{suffix}-hexagons.svg"), drawing.svg(Show::Hexagons)?);
        figures.insert(format!("{name}-{suffix}-dual.svg"), drawing.svg(Show::Dual)?);
        figures.insert(format!("{name}-{suffix}-mesh.svg"), drawing.svg(Show::Mesh)?);
    }
    Ok(figures)
}

/// The same points by templates and made compact.
fn of_methods(root: &Path, name: &str) -> Figures {
    let points = read_points(root.join(format!("fixtures/points/{name}.node")))?.points;
    let methods = [(Method::Templates, "templates"), (Method::Compact, "compact")];
    let draw = |(method, suffix): (Method, &str)| {
        let made = Mesher::new().method(method).triangulate(&points)?;
        let drawing = Drawing {
            mesh: &made.mesh,
            inputs: made.input_of_vertex(),
            overlay: Overlay::default(),
            bounds: method.bounds(),
            size_px: LARGE_PX,
        };
        Ok((format!("{name}-{suffix}.svg"), drawing.svg(Show::Mesh)?))
    };
    methods.into_iter().map(draw).collect()
}

/// Segments by the paper's own section 7: two that meet at a point (Fig. 14), and the letters,
/// all of them and a close-up (Fig. 15).
fn of_segments(root: &Path) -> Figures {
    let corner = [(0.0, 0.0), (3.0, 0.4), (2.6, 1.5)].map(|(x, y)| DVec2::new(x, y));
    let mut two = Pslg::from_points(corner.to_vec());
    two.segments = vec![[0, 1], [0, 2]];
    let letters = read_points(root.join("fixtures/graphs/letters.poly"))?;
    let close_up = [DVec2::new(3.6, 0.9), DVec2::new(4.7, 1.8)];
    let drawn = [
        ("fig-14-two-segments", &two, Extent::Hexagon, Some([DVec2::new(-0.5, -0.4), DVec2::new(1.9, 1.3)])),
        ("fig-15-letters-paper", &letters, Extent::Inside, None),
        ("fig-15-letters-paper-close-up", &letters, Extent::Inside, Some(close_up)),
    ];
    let draw = |(name, graph, extent, zoom): (&str, &Pslg, Extent, Option<[DVec2; 2]>)| {
        let options = Options::new().method(SegmentMethod::Paper).extent(extent);
        let made = hexdel::pslg::mesh(&validate(graph)?, &options, &Unwatched)?;
        let edges: Vec<_> =
            made.edges.iter().map(|e| MarkedEdge { ends: e.ends, marker: e.marker }).collect();
        let mut picture = Picture::default();
        picture.size_px = LARGE_PX;
        picture.bounds_deg = [AngleBounds::EXTENDED.min_deg(), AngleBounds::EXTENDED.max_deg()];
        picture.zoom = zoom;
        let view = MeshView::new(&made.mesh).with_marked_edges(&edges).with_picture(picture);
        let (format, extension) = gallery::format_of(made.mesh.triangles.len());
        let mut bytes = Vec::new();
        write_mesh_to(&mut bytes, format, &view, name)?;
        Ok((format!("{name}.{extension}"), bytes))
    };
    drawn.into_iter().map(draw).collect()
}

/// Subdivision and balance (paper, Fig. 1 and 2), with the plain dual.
fn of_grid() -> Figures {
    let plain = |addresses: &[Address]| {
        let mut grid = Grid::new(Lattice::new(DVec2::ZERO, 1.0));
        for &at in addresses {
            grid.subdivide(at);
        }
        template(grid, &[], AngleBounds::SIMPLE)
    };
    let hexes = |hexes: &[Hex]| hexes.iter().map(|&h| Address::new(0, h)).collect::<Vec<_>>();
    let east = Direction::new(0).step();
    let three = [Hex::ORIGIN, east, Direction::new(1).step()];
    Ok(vec![
        ("grid-one.svg".to_owned(), plain(&hexes(&three[..1]))?),
        ("grid-two-joined.svg".to_owned(), plain(&hexes(&three[..2]))?),
        ("grid-three-joined.svg".to_owned(), plain(&hexes(&three))?),
        ("grid-balance.svg".to_owned(), plain(&[Address::new(2, Hex::ORIGIN)])?),
    ])
}

/// The templates of moved centres, by what is subdivided around the origin.
fn of_templates() -> Figures {
    let step = |i: usize| Direction::new(i).step();
    let beyond = |i: usize| [5, 0, 1].map(|turn| step(i) + step(i + turn));
    let run = |n: usize| (0..n).flat_map(beyond).collect::<BTreeSet<_>>();
    let few = |hexes: &[Hex]| hexes.iter().copied().collect::<BTreeSet<_>>();
    let grids = [
        ("moved-center-1", few(&[Hex::ORIGIN])),
        ("moved-center-2", few(&[Hex::ORIGIN, step(0)])),
        ("moved-center-3-single", few(&[step(0), step(1), step(2)])),
        ("moved-center-3-run-2", run(2)),
        ("moved-center-3-run-3", run(3)),
        ("moved-center-3-run-4", run(4)),
        ("blossom", run(6)),
    ];
    let mut figures = Vec::new();
    for (name, subdivided) in grids {
        let mut grid = Grid::new(Lattice::new(DVec2::ZERO, 1.0));
        for hex in subdivided {
            grid.subdivide(Address::new(0, hex));
        }
        let svg = template(grid, &[], AngleBounds::EXTENDED).map_err(|e| format!("{name}: {e}"))?;
        figures.push((format!("{name}.svg"), svg));
    }
    Ok(figures)
}

/// The templates of occupied hexagons (paper, Fig. 8): a point within reach of
/// the centre, and one beyond.
fn of_points() -> Figures {
    let mut figures = Vec::new();
    for (name, point) in [("occupied-1", DVec2::new(0.2, 0.1)), ("occupied-2", DVec2::new(0.42, 0.2))] {
        let mut refiner = Refiner::new(Lattice::new(DVec2::ZERO, 1.0), RuleSet::extended());
        refiner.insert(&[point], &Unwatched)?;
        let occupants = refiner.occupants();
        let svg = template(refiner.grid().clone(), &occupants, AngleBounds::EXTENDED)?;
        figures.push((format!("{name}.svg"), svg));
    }
    Ok(figures)
}

/// A small grid with its dual over it; plain within simple bounds, else
/// relocated.
fn template(mut grid: Grid, occupants: &[Occupant], bounds: AngleBounds) -> Result<Vec<u8>, Box<dyn Error>> {
    let simple = bounds == AngleBounds::SIMPLE;
    let relocation = if simple { Relocation::Occupied } else { Relocation::Full };
    let domain = Domain::around(&grid, 0).ok_or("a point lies on no level")?;
    let dual = extract(&mut grid, occupants, domain, relocation, &Unwatched)?;
    // Four corners on a circle are left as they come: no input is at stake.
    let options = CertifyOptions { bounds, require_delaunay: false, ..CertifyOptions::default() };
    let certificate = certify(&dual.mesh, &options);
    if !certificate.holds() {
        return Err(format!("the mesh is not certified: {:?}", certificate.violations.first()).into());
    }
    let mut inputs = vec![None; dual.mesh.vertices.len()];
    for (i, vertex) in dual.vertex_of_occupant.iter().enumerate() {
        inputs[vertex.index()] = Some(i as u32);
    }
    let hexagons = hexagons(&grid, domain, occupants);
    let overlay =
        if simple { hexdel::picture::plain_overlay(hexagons) } else { hexdel::picture::overlay(hexagons) };
    Drawing { mesh: &dual.mesh, inputs, overlay, bounds, size_px: SMALL_PX }.svg(Show::Dual)
}

/// What a figure shows.
#[derive(Clone, Copy, PartialEq)]
enum Show {
    /// The grid alone.
    Hexagons,
    /// The edges of the mesh over the grid.
    Dual,
    /// The triangles by their smallest angle.
    Mesh,
}

struct Drawing<'a> {
    mesh: &'a TriMesh,
    /// For each vertex its input point.
    inputs: Vec<Option<u32>>,
    overlay: Overlay,
    bounds: AngleBounds,
    size_px: f64,
}

impl Drawing<'_> {
    fn svg(&self, show: Show) -> Result<Vec<u8>, Box<dyn Error>> {
        let mut picture = Picture::default();
        picture.size_px = self.size_px;
        picture.bounds_deg = [self.bounds.min_deg(), self.bounds.max_deg()];
        picture.fill_triangles = show == Show::Mesh;
        picture.edges = show != Show::Hexagons;
        picture.overlay = Some(&self.overlay).filter(|_| show != Show::Mesh);
        let view = MeshView::new(self.mesh).with_input_indices(&self.inputs).with_picture(picture);
        let mut svg = Vec::new();
        write_mesh_to(&mut svg, MeshFormat::Svg, &view, "figure")?;
        Ok(svg)
    }
}
