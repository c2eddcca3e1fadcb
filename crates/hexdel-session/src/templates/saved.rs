//! Sessions of templates as text (RON), to be continued.

use super::cells::Serials;
use super::grown::{Grown, certified};
use super::laid::Since;
use super::orders::Orders;
use super::{PointId, TemplateSession, check_size};
use crate::SessionError;
use crate::domain::is_inside;
use crate::saved::SavedOptions;
use hexdel_classify::Domain;
use hexdel_geom::DVec2;
use hexdel_grid::{Address, Hex, Lattice};
use hexdel_mesher::Method;
use hexdel_mesher::for_sessions::Workers;
use hexdel_mesher::for_sessions::worst_edge;
use hexdel_mesher::for_sessions::{FINEST, MAX_COORDINATE, finest_spacing};
use hexdel_mesher::{Size, SizeError};
use hexdel_optimize::{Effort, SIZE_TOLERANCE};
use hexdel_refine::{Refiner, RuleSet};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::sync::Arc;

/// The version of the format.
const VERSION: u32 = 1;

/// How the text begins.
const BEGINNING: &str = "(templates:";

#[derive(Serialize, Deserialize)]
struct Document {
    /// The version; its name tells the text from that of other sessions.
    templates: u32,
    centre: DVec2,
    /// Spacing of level 0, and steps of it to the corners.
    spacing: f64,
    steps: u32,
    /// Points that ever were, and those that are with their levels.
    named: u64,
    points: Vec<(u64, DVec2, u8)>,
    /// Level, first hexagon and subdivided hexagons of each tile that has any.
    tiles: Vec<(u8, i64, i64, u64)>,
    /// Vertices that do not lie where the templates put them.
    moved: Vec<(u8, i64, i64, DVec2)>,
    /// Serial numbers in the order of the mesh, as firsts and counts of runs.
    vertices: Vec<(u64, u64)>,
    triangles: Vec<(u64, u64)>,
    /// The last ones given out.
    last: (u64, u64),
    /// Points that have gone since all were put in.
    #[serde(default)]
    missed: u32,
    /// Points that have come or gone since the closest pair was asked for, and since the
    /// lattice was laid.
    #[serde(default)]
    seen: u32,
    #[serde(default)]
    laid: u32,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    size: Option<Size>,
    #[serde(default)]
    grows: bool,
    #[serde(default)]
    options: SavedOptions,
    /// The hexagons that are subdivided for the size, as in `tiles`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    wanted: Vec<(u8, i64, i64, u64)>,
}

impl TemplateSession {
    /// Whether a text looks like a saved session of templates.
    pub fn is_saved_in(text: &str) -> bool {
        text.trim_start().starts_with(BEGINNING)
    }

    /// The session as text. What is read back from it goes on as this one would,
    /// except that the calls so far cannot be undone.
    ///
    /// # Errors
    ///
    /// [`SessionError::CannotSave`] if the size is given by a function.
    pub fn to_ron(&self) -> Result<String, SessionError> {
        if !self.size().is_none_or(Size::can_be_saved) {
            return Err(SessionError::CannotSave);
        }
        let Grown { refiner, dual, cells, .. } = &self.grown;
        let (grid, lattice) = (refiner.grid(), self.grown.lattice());
        let mut tiles = Vec::new();
        for level in 0..grid.tiles().levels() as u8 {
            let busy = grid.tiles().placed(level).filter(|(_, t)| t.subdivided != 0);
            tiles.extend(busy.map(|(first, t)| (level, first.q, first.r, t.subdivided)));
        }
        tiles.sort_unstable();
        let mut moved: Vec<(u8, i64, i64, DVec2)> = Vec::new();
        for (&name, &to) in &cells.moved {
            let at = dual.address(grid, name);
            moved.push((at.level, at.hex.q, at.hex.r, to));
        }
        moved.sort_unstable_by_key(|m| (m.0, m.1, m.2));
        let wanted = refiner.wanted().map(|(level, first, bits)| (level, first.q, first.r, bits));
        let mut wanted: Vec<(u8, i64, i64, u64)> = wanted.collect();
        wanted.sort_unstable();
        let pages = self.grown.pages();
        let of = |page: &u32| &cells.by_page[*page as usize];
        let point = |(id, at): (PointId, DVec2)| {
            let level = self.order(id).map_or(0, |order| refiner.occupant(order as usize).level);
            (id.0, at, level)
        };
        let document = Document {
            templates: VERSION,
            centre: lattice.origin(),
            spacing: lattice.spacing(0),
            steps: self.grown.steps(),
            named: self.points.named(),
            points: self.points().map(point).collect(),
            tiles,
            moved,
            vertices: runs(pages.iter().flat_map(|p| of(p).serials.iter().copied())),
            triangles: runs(pages.iter().flat_map(|p| of(p).triangles.iter().map(|t| t.serial))),
            last: (cells.serials.vertex, cells.serials.triangle),
            missed: self.since.gone as u32,
            seen: self.since.seen as u32,
            laid: self.since.laid as u32,
            size: self.size().cloned(),
            grows: self.grows,
            options: SavedOptions::of(&self.options),
            wanted,
        };
        ron::to_string(&document).map_err(|e| SessionError::Unreadable { message: e.to_string() })
    }

    /// Reads what [`to_ron`](Self::to_ron) wrote. The grid is held against its
    /// rules, and the mesh is certified anew, but for its shortest edge.
    ///
    /// # Errors
    ///
    /// [`SessionError`] for what is no such text, or of a mesh that does not
    /// hold.
    pub fn from_ron(text: &str) -> Result<Self, SessionError> {
        let document: Document = ron::from_str(text).map_err(|e| unreadable(&e.to_string()))?;
        let orders = document.check()?;
        let options = document.options.restored(Effort::Standard)?.method(Method::Templates);
        let workers = Workers::new(options.asked().threads)?;
        let lattice = Lattice::new(document.centre, document.spacing);
        let tiles = document.tiles.iter().map(|&(level, q, r, bits)| (level, Hex::new(q, r), bits));
        let sites: Vec<_> = document.points.iter().map(|p| (p.1, Some(p.2))).collect();
        let mut refiner = Refiner::restored(lattice, RuleSet::extended(), tiles, &sites)
            .map_err(|e| unreadable(&e.to_string()))?;
        let wanted = document.wanted.iter().map(|&(level, q, r, bits)| (level, Hex::new(q, r), bits));
        refiner.restore_wanted(wanted).map_err(|e| unreadable(&e.to_string()))?;
        if Domain::around(refiner.grid(), 0).is_none_or(|around| around.radius > document.steps) {
            return Err(unreadable("hexagons beyond the rim"));
        }
        let ids: Vec<PointId> = document.points.iter().map(|p| PointId(p.0)).collect();
        let mut grown = Grown::of(refiner, document.steps, &ids, Serials::default());
        document.restore_cells(&mut grown)?;
        grown.size = document.size.clone().map(Size::checked).transpose()?.map(Arc::new);
        let points: Vec<DVec2> = document.points.iter().map(|p| p.1).collect();
        let certificate = certified(&grown.mesh().0, &points, None);
        if !certificate.holds() {
            return Err(SessionError::NotCertified { certificate: Box::new(certificate) });
        }
        if let Some(size) = &grown.size {
            check_size(size, document.centre, document.spacing * f64::from(document.steps))?;
            let (ratio, at, length) = worst_edge(&grown.mesh().0, size.as_ref());
            if ratio > 1.0 + SIZE_TOLERANCE {
                return Err(SizeError::Unreached { at, length }.into());
            }
        }
        Ok(Self {
            grown,
            points: orders,
            since: document.since(),
            grows: document.grows,
            options,
            workers,
            history: VecDeque::new(),
        })
    }
}

impl Document {
    /// Checks what stands alone. Returns the place of each point in the list.
    fn check(&self) -> Result<Orders, SessionError> {
        if self.templates != VERSION {
            return Err(unreadable(&format!("version {}, not {VERSION}", self.templates)));
        }
        let (centre, radius) = (self.centre, self.spacing * f64::from(self.steps));
        let reach = centre.abs().max_element() + radius;
        let fits = radius > FINEST * finest_spacing(DVec2::splat(reach)) && reach < MAX_COORDINATE;
        if !(centre.is_finite() && fits && (1..=Domain::MAX_RADIUS).contains(&self.steps)) {
            return Err(SessionError::InvalidDomain { centre, radius });
        }
        if self.named > u64::from(u32::MAX) || self.named < self.points.len() as u64 {
            return Err(unreadable("more points than there may be"));
        }
        let mut orders = Orders::new(self.named);
        for (order, &(id, at, _)) in (0..).zip(&self.points) {
            if !at.is_finite() {
                return Err(SessionError::NotFinite { at });
            }
            if !is_inside(at - centre, radius) {
                return Err(SessionError::Outside { at, radius });
            }
            let id = PointId(id);
            if id.0 >= self.named || orders.get(id).is_some() {
                return Err(SessionError::Points { id });
            }
            orders.set(id, Some(order));
        }
        super::check_distinct(&self.points.iter().map(|p| p.1).collect::<Vec<_>>(), 0)?;
        Ok(orders)
    }

    fn since(&self) -> Since {
        Since { gone: self.missed as usize, seen: self.seen as usize, laid: self.laid as usize }
    }

    /// Gives vertices and triangles their serial numbers, and moves what was
    /// moved.
    fn restore_cells(&self, grown: &mut Grown) -> Result<(), SessionError> {
        let [vertices, triangles] = grown.cells.counts;
        let mut serials = [
            listed(&self.vertices, vertices, self.last.0)?.into_iter(),
            listed(&self.triangles, triangles, self.last.1)?.into_iter(),
        ];
        for page in grown.pages() {
            let cell = &mut grown.cells.by_page[page as usize];
            for (serial, new) in cell.serials.iter_mut().zip(&mut serials[0]) {
                *serial = new;
            }
            for (t, new) in cell.triangles.iter_mut().zip(&mut serials[1]) {
                t.serial = new;
            }
        }
        grown.cells.serials = Serials { vertex: self.last.0, triangle: self.last.1 };
        for &(level, q, r, to) in &self.moved {
            let in_range = level < hexdel_grid::Grid::MAX_LEVELS && q.abs().max(r.abs()) < 1 << 52;
            let name = in_range
                .then(|| grown.dual.name_of(grown.refiner.grid(), Address::new(level, Hex::new(q, r))))
                .flatten()
                .filter(|&name| to.is_finite() && grown.cells.vertex(name).is_some());
            let name = name.ok_or_else(|| unreadable("a vertex moved that is not there"))?;
            grown.cells.moved.insert(name, to);
        }
        Ok(())
    }
}

/// Numbers as firsts and lengths of runs of consecutive ones.
fn runs(numbers: impl Iterator<Item = u64>) -> Vec<(u64, u64)> {
    let mut runs: Vec<(u64, u64)> = Vec::new();
    for n in numbers {
        match runs.last_mut() {
            Some((first, count)) if *first + *count == n => *count += 1,
            _ => runs.push((n, 1)),
        }
    }
    runs
}

/// The numbers of runs: so many different ones, from 1 to `last`.
fn listed(runs: &[(u64, u64)], count: usize, last: u64) -> Result<Vec<u64>, SessionError> {
    let total = runs.iter().try_fold(0_u64, |sum, run| sum.checked_add(run.1));
    let ends = |&(first, count): &(u64, u64)| {
        first >= 1 && first.checked_add(count).is_some_and(|end| end <= last + 1)
    };
    if last == u64::MAX || total != Some(count as u64) || !runs.iter().all(ends) {
        return Err(unreadable("serial numbers that do not fit the mesh"));
    }
    let all: Vec<u64> = runs.iter().flat_map(|&(first, count)| first..first + count).collect();
    let mut sorted = all.clone();
    sorted.sort_unstable();
    match sorted.windows(2).find(|w| w[0] == w[1]) {
        Some(w) => Err(unreadable(&format!("serial number {} twice", w[0]))),
        None => Ok(all),
    }
}

fn unreadable(message: &str) -> SessionError {
    SessionError::Unreadable { message: message.to_owned() }
}
