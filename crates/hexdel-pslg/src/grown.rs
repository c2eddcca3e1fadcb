//! The first mesh without a grid: it grows out of the constrained Delaunay triangulation of sites and pieces.

use crate::error::PslgError;
use crate::fans::Scene;
use crate::geometry::fraction;
use crate::net::{Kind, Net};
use crate::options::Extent;
use hexdel_geom::{DVec2, Monitor, Pslg};
use hexdel_grow::{GrowError, Input, Kind as GrownKind, Options, Role, Size, grow};

/// A mesh that has grown.
pub(crate) struct Grown {
    pub(crate) net: Net,
    /// Triangles out of the bounds near points and segments.
    pub(crate) left: Vec<u32>,
}

/// Grows a mesh with all sites and pieces in it, carved; none where growth is not for the input. Triangles may be
/// left out of the bounds.
pub(crate) fn grown(
    scene: &Scene,
    pslg: &Pslg,
    extent: Extent,
    corners: [DVec2; 6],
    options: &Options,
    size: Option<&dyn Size>,
    monitor: &dyn Monitor,
) -> Result<Option<Grown>, PslgError> {
    of_input(scene, pslg, extent, corners, |input| grow(&Input { size, ..*input }, options, monitor))
}

/// Searches for such a mesh with as few other vertices as possible.
pub(crate) fn fewest(
    scene: &Scene,
    pslg: &Pslg,
    extent: Extent,
    corners: [DVec2; 6],
    options: &Options,
    monitor: &dyn Monitor,
) -> Result<Option<Grown>, PslgError> {
    of_input(scene, pslg, extent, corners, |input| hexdel_grow::fewest(input, options, monitor))
}

fn of_input(
    scene: &Scene,
    pslg: &Pslg,
    extent: Extent,
    corners: [DVec2; 6],
    make: impl FnOnce(&Input<'_>) -> Result<hexdel_grow::Grown, GrowError>,
) -> Result<Option<Grown>, PslgError> {
    let sites = scene.sites.len() as u32;
    let mut points = scene.sites.clone();
    let mut segments: Vec<[u32; 2]> = scene.pieces.iter().map(|piece| piece.ends).collect();
    let mut roles: Vec<Role> = (0..scene.pieces.len()).map(|i| role(scene, i)).collect();
    if extent == Extent::Hexagon {
        points.extend(corners);
        segments.extend((0..6).map(|i| [sites + i, sites + (i + 1) % 6]));
        roles.extend([Role::Border; 6]);
    }
    let input = Input {
        points: &points,
        segments: &segments,
        roles: &roles,
        holes: &pslg.holes,
        inside: extent != Extent::Hexagon,
        size: None,
    };
    match make(&input) {
        Ok(made) => Ok(Some(Grown { net: net_of(&made, scene), left: made.left })),
        Err(GrowError::Cancelled(c)) => Err(c.into()),
        Err(_) => Ok(None),
    }
}

fn role(scene: &Scene, piece: usize) -> Role {
    match scene.whole[piece] {
        _ if piece >= scene.soft as usize => Role::Inner,
        true => Role::Whole,
        false => Role::Border,
    }
}

/// The net of a grown mesh.
fn net_of(made: &hexdel_grow::Grown, scene: &Scene) -> Net {
    let mut net = Net::of(&made.mesh);
    net.soft = Some(scene.soft);
    net.lines = scene.pieces.iter().map(|p| p.ends.map(|s| scene.sites[s as usize])).collect();
    for (v, (point, kind)) in made.point_of_vertex.iter().zip(&made.kinds).enumerate() {
        let kind = match *point {
            Some(site) if (site as usize) < scene.sites.len() => Kind::Site(site),
            None if *kind == GrownKind::Free => Kind::Free,
            // Corners and sides of the hexagon; those on pieces are told by their edges.
            _ => Kind::Rim,
        };
        net.move_to(v as u32, made.mesh.vertices[v], kind);
    }
    for &(edge, piece) in made.edges.iter().filter(|(_, piece)| (*piece as usize) < scene.pieces.len()) {
        let [a, b] = edge.map(|v| v.index() as u32);
        net.constrain(a, b, piece);
        for v in [a, b] {
            if net.vertex(v).kind == Kind::Rim {
                let at = net.at(v);
                net.move_to(v, at, Kind::Along { piece, t: fraction(net.lines[piece as usize], at) });
            }
        }
    }
    net
}
