//! What is meshed of a PSLG, and what is to be said of it: the same for a mesh, a session
//! and a file of another format.

use super::boxed;
use super::repair::Repaired;
use super::warning::{self, Warning};
use super::{Domain, Overlaps};
use crate::error::Error;
use crate::mesher::Mesher;
use hexdel_geom::Pslg;
use hexdel_pslg::{Extent, RepairReport, Seed, Unused, UnusedSeed, Validated, validate};

/// A PSLG as it is meshed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct PreparedPslg {
    /// The PSLG given, or what repair has made of it, with holes and regions in place of polygons.
    pub graph: Pslg,
    /// What repair did, if it did or was asked for: as [`repairs`](crate::PslgTriangulation::repairs).
    pub repairs: Option<RepairReport>,
    /// What is not used of the PSLG, or could have been meant otherwise.
    pub warnings: Vec<Warning>,
}

/// A PSLG on its way to a mesh.
pub(super) struct Prepared {
    pub(super) repaired: Repaired,
    /// With the box, if that is the domain, and without seeds outside of the hull, if that is.
    pub(super) validated: Validated,
    pub(super) domain: Domain,
    pub(super) warnings: Vec<Warning>,
}

impl Mesher {
    /// The PSLG that is meshed: repaired if asked for, borders of polygons divided where
    /// they meet others, and holes and regions in place of polygons; with the warnings that a
    /// mesh of it has.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Pslg, geom::Polygon};
    /// let mut square = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
    /// square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
    /// square.polygons = vec![Polygon { rings: vec![vec![0, 1, 2, 3]], attribute: 5.0, max_area: None }];
    /// square.holes = vec![DVec2::splat(9.0)];
    /// let prepared = Mesher::new().prepared_pslg(&square)?;
    /// assert_eq!(prepared.graph.regions[0].attribute, 5.0);
    /// assert_eq!(prepared.warnings[0].to_string(), "hole 0 at (9, 9) has no effect: it lies outside the domain");
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`triangulate_pslg`](Self::triangulate_pslg).
    pub fn prepared_pslg(&self, pslg: &Pslg) -> Result<PreparedPslg, Error> {
        let Prepared { repaired, warnings, .. } = self.prepare(pslg)?;
        Ok(PreparedPslg { graph: repaired.graph, repairs: repaired.report, warnings })
    }

    pub(super) fn prepare(&self, pslg: &Pslg) -> Result<Prepared, Error> {
        let asked = self.graph.repair;
        let extent = self.graph.domain.map_or(Extent::Inside, Domain::extent);
        let mut repaired = Repaired::new(pslg, asked, extent)?;
        let domain = self.domain_of(&repaired.graph);
        let mut validated = valid(&repaired, domain);
        let mut division = None;
        if validated.is_err() && asked.is_none() && !pslg.polygons.is_empty() {
            repaired = Repaired::divided(pslg)?;
            validated = valid(&repaired, domain);
            division = repaired.report.as_ref().and_then(warning::of_division);
        }
        let (validated, mut warnings) = self.seeded(validated?, domain, &repaired, pslg)?;
        warnings.extend(division);
        repaired.seed(validated.pslg());
        let validated = validated.confined(domain.extent());
        Ok(Prepared { repaired, validated, domain, warnings })
    }

    fn domain_of(&self, graph: &Pslg) -> Domain {
        let usual = if graph.segments.is_empty() { Domain::Hexagon } else { Domain::Inside };
        self.graph.domain.unwrap_or(usual)
    }

    /// A PSLG with holes and regions in place of polygons, and what is to be said of them.
    fn seeded(
        &self,
        validated: Validated,
        domain: Domain,
        repaired: &Repaired,
        given: &Pslg,
    ) -> Result<(Validated, Vec<Warning>), Error> {
        // Around polygons the box is meshed, though segments enclose it.
        let around = if domain == Domain::Box { Extent::Hexagon } else { domain.extent() };
        let (validated, cover) = validated.seeded(around);
        let mut warnings = warning::of_cover(&cover, given);
        if let (Overlaps::Refuse, Some(&Warning::Overlap { polygons, attributes, at, area })) =
            (self.graph.overlaps, warnings.first())
        {
            return Err(Error::Overlap { polygons, attributes, at, area });
        }
        let own = |seed| match seed {
            Seed::Hole(i) => (i as usize) < given.holes.len(),
            Seed::Region(i) => (i as usize) < given.regions.len(),
        };
        let unused = validated.unused_seeds(domain.extent());
        let regions = &validated.pslg().regions;
        let overridden = unused.iter().filter_map(|unused| match (unused.seed, unused.why) {
            (Seed::Region(of_polygon), Unused::SameFace { region })
                if !own(unused.seed) && own(Seed::Region(region)) =>
            {
                Some(warning::of_region(region, &regions[region as usize], &regions[of_polygon as usize]))
            }
            _ => None,
        });
        warnings.extend(overridden);
        let unused = unused.into_iter().filter(|unused| own(unused.seed));
        warnings.extend(unused.map(|unused| Warning::UnusedSeed(as_given(unused, repaired))));
        Ok((validated, warnings))
    }
}

/// The PSLG, in its box if that is the domain, if it is valid.
fn valid(repaired: &Repaired, domain: Domain) -> Result<Validated, Error> {
    let boxed = (domain == Domain::Box).then(|| boxed::with_box(&repaired.graph));
    validate(boxed.as_ref().unwrap_or(&repaired.graph)).map_err(|e| repaired.as_given(e))
}

/// In the numbers of the PSLG given, of which the box is no segment.
fn as_given(unused: UnusedSeed, repaired: &Repaired) -> UnusedSeed {
    let why = match unused.why {
        Unused::OnSegment { segment } if segment as usize >= repaired.graph.segments.len() => Unused::Outside,
        Unused::OnSegment { segment } => {
            Unused::OnSegment { segment: repaired.segment(segment as usize) as u32 }
        }
        why => why,
    };
    UnusedSeed { why, ..unused }
}
