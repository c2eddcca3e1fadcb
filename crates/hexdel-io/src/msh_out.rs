//! Gmsh's `.msh` in text: writing versions 4.1 and 2.2.
//!
//! Regions of triangles and markers of edges become physical groups, of the
//! dimensions 2 and 1, named `region N` and `marker N`; 0 is in no group. Triangles
//! are numbered after the marked edges in the order of the mesh, and listed by region.
//! Regions that are no integers are in no group; then all regions stand in the element
//! data `region` as well. Node data are `marker` and `input_index` (-1 for Steiner
//! points), so that all of it is read back.
//!
//! What a mesh was made to keep is the name of a group of points without elements, and
//! element data `exempt` of the triangles that are.
//!
//! Negative markers and regions are written as they are; Gmsh takes the sign of a
//! group for an orientation.

use std::collections::BTreeSet;
use std::io::{self, Write};

use hexdel_geom::{DVec2, VertexId};

use crate::text::TextWriter;
use crate::view::MeshView;

/// Gmsh's numbers of element types.
pub(crate) const LINE: u64 = 1;
pub(crate) const TRIANGLE: u64 = 2;
pub(crate) const POINT: u64 = 15;

/// The version written.
#[derive(Clone, Copy, PartialEq)]
enum Version {
    V22,
    V41,
}

/// Writes version 4.1.
pub(crate) fn write_msh41(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut msh = Msh::new(out, view, Version::V41);
    msh.text.text("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    msh.names()?;
    msh.entities()?;
    msh.nodes41()?;
    msh.elements41()?;
    msh.data()
}

/// Writes version 2.2.
pub(crate) fn write_msh22(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut msh = Msh::new(out, view, Version::V22);
    msh.text.text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    msh.names()?;
    msh.nodes22()?;
    msh.elements22()?;
    msh.data()
}

/// A region as the number of a physical group, 0 if it cannot be one.
fn group(region: f64) -> i32 {
    let integer = region as i32;
    if f64::from(integer) == region { integer } else { 0 }
}

struct Msh<'w, 'a> {
    text: TextWriter<'w>,
    view: &'a MeshView<'a>,
    version: Version,
    /// The groups of triangles, in order; at least one.
    regions: Vec<i32>,
    /// The groups of edges, in order.
    markers: Vec<i32>,
}

impl<'w, 'a> Msh<'w, 'a> {
    fn new(out: &'w mut dyn Write, view: &'a MeshView<'a>, version: Version) -> Self {
        let regions: BTreeSet<i32> = view.regions.unwrap_or(&[]).iter().map(|&r| group(r)).collect();
        let markers: BTreeSet<i32> = view.marked_edges.unwrap_or(&[]).iter().map(|e| e.marker).collect();
        let mut regions = Vec::from_iter(regions);
        if regions.is_empty() {
            regions.push(0);
        }
        Self { text: TextWriter::new(out), view, version, regions, markers: Vec::from_iter(markers) }
    }

    fn region(&self, triangle: usize) -> i32 {
        self.view.regions.map_or(0, |regions| group(regions[triangle]))
    }

    fn names(&mut self) -> io::Result<()> {
        let groups = |groups: &[i32]| groups.iter().filter(|&&g| g != 0).count();
        let promised = self.view.promised;
        let count = groups(&self.markers) + groups(&self.regions) + usize::from(promised.is_some());
        if count == 0 {
            return Ok(());
        }
        let text = &mut self.text;
        text.text("$PhysicalNames\n").integer(count).text("\n");
        if let Some(promised) = promised {
            text.text("0 1 \"").text(&promised.head()).text("\"\n");
        }
        for (dimension, name, groups) in [("1 ", "marker", &self.markers), ("2 ", "region", &self.regions)] {
            for &group in groups.iter().filter(|&&g| g != 0) {
                text.text(dimension).integer(group).text(" \"").text(name);
                text.text(" ").integer(group).text("\"\n").breathe()?;
            }
        }
        text.text("$EndPhysicalNames\n");
        Ok(())
    }

    /// A curve for each marker and a surface for each region, numbered from 1.
    fn entities(&mut self) -> io::Result<()> {
        let vertices = &self.view.mesh.vertices;
        let low = vertices.iter().copied().reduce(DVec2::min).unwrap_or_default();
        let high = vertices.iter().copied().reduce(DVec2::max).unwrap_or_default();
        // meshio reads no file in which only some of the entities are in a group.
        let all = [&self.markers, &self.regions].into_iter().flatten().any(|&group| group != 0);
        let text = &mut self.text;
        text.text("$Entities\n0 ").integer(self.markers.len()).text(" ");
        text.integer(self.regions.len()).text(" 0\n");
        for groups in [&self.markers, &self.regions] {
            for (i, &group) in groups.iter().enumerate() {
                text.integer(i + 1);
                for number in [low.x, low.y, 0.0, high.x, high.y, 0.0] {
                    text.text(" ").number(number);
                }
                if all {
                    text.text(" 1 ").integer(group);
                } else {
                    text.text(" 0");
                }
                // No bounding entities are known.
                text.text(" 0\n").breathe()?;
            }
        }
        text.text("$EndEntities\n");
        Ok(())
    }

    fn nodes41(&mut self) -> io::Result<()> {
        let vertices = &self.view.mesh.vertices;
        let (count, text) = (vertices.len(), &mut self.text);
        text.text("$Nodes\n").integer(u32::from(count > 0)).text(" ").integer(count);
        text.text(if count > 0 { " 1 " } else { " 0 " }).integer(count).text("\n");
        if count > 0 {
            text.text("2 1 0 ").integer(count).text("\n");
        }
        for i in 1..=count {
            text.integer(i).text("\n").breathe()?;
        }
        for &p in vertices {
            position(text, p)?;
        }
        text.text("$EndNodes\n");
        Ok(())
    }

    fn nodes22(&mut self) -> io::Result<()> {
        let vertices = &self.view.mesh.vertices;
        self.text.text("$Nodes\n").integer(vertices.len()).text("\n");
        for (i, &p) in vertices.iter().enumerate() {
            self.text.integer(i + 1).text(" ");
            position(&mut self.text, p)?;
        }
        self.text.text("$EndNodes\n");
        Ok(())
    }

    fn elements41(&mut self) -> io::Result<()> {
        let edges = self.view.marked_edges.unwrap_or(&[]);
        let triangles = self.view.mesh.triangles.len();
        let count = edges.len() + triangles;
        let blocks = self.markers.len() + if triangles > 0 { self.regions.len() } else { 0 };
        self.text.text("$Elements\n").integer(blocks).text(" ").integer(count);
        self.text.text(if count > 0 { " 1 " } else { " 0 " }).integer(count).text("\n");
        self.blocks(|msh, dimension, entity, items| {
            let kind = if dimension == 1 { LINE } else { TRIANGLE };
            msh.text.integer(dimension).text(" ").integer(entity).text(" ");
            msh.text.integer(kind).text(" ").integer(items).text("\n");
        })?;
        self.text.text("$EndElements\n");
        Ok(())
    }

    fn elements22(&mut self) -> io::Result<()> {
        let edges = self.view.marked_edges.unwrap_or(&[]).len();
        self.text.text("$Elements\n").integer(edges + self.view.mesh.triangles.len()).text("\n");
        self.blocks(|_, _, _, _| ())?;
        self.text.text("$EndElements\n");
        Ok(())
    }

    /// Writes all elements, group by group; `begin` gets dimension, entity and
    /// number of elements of each group.
    fn blocks(&mut self, begin: impl Fn(&mut Self, u32, usize, usize)) -> io::Result<()> {
        let edges = self.view.marked_edges.unwrap_or(&[]);
        let order = sorted(edges.len(), self.markers.len(), |i| edges[i].marker);
        for (entity, block) in runs(order.as_deref(), edges.len(), |i| edges[i].marker).enumerate() {
            begin(self, 1, entity + 1, block.len());
            for i in block {
                let i = order.as_ref().map_or(i, |order| order[i] as usize);
                self.element(i, LINE, edges[i].marker, entity, &edges[i].ends)?;
            }
        }
        let triangles = &self.view.mesh.triangles;
        let order = sorted(triangles.len(), self.regions.len(), |t| self.region(t));
        let all: Vec<_> = runs(order.as_deref(), triangles.len(), |t| self.region(t)).collect();
        for (entity, block) in all.into_iter().enumerate() {
            begin(self, 2, entity + 1, block.len());
            for i in block {
                let t = order.as_ref().map_or(i, |order| order[i] as usize);
                self.element(edges.len() + t, TRIANGLE, self.region(t), entity, &triangles[t])?;
            }
        }
        Ok(())
    }

    /// Writes element `index` of group `group`, the one numbered `entity`.
    fn element(
        &mut self,
        index: usize,
        kind: u64,
        group: i32,
        entity: usize,
        vertices: &[VertexId],
    ) -> io::Result<()> {
        self.text.integer(index + 1);
        if self.version == Version::V22 {
            self.text.text(" ").integer(kind).text(" 2 ").integer(group);
            self.text.text(" ").integer(entity + 1);
        }
        for vertex in vertices {
            self.text.text(" ").integer(vertex.index() + 1);
        }
        self.text.text("\n").breathe()
    }

    fn data(&mut self) -> io::Result<()> {
        let view = self.view;
        if let Some(markers) = view.vertex_markers {
            self.table("marker", markers.iter().map(|&m| f64::from(m)))?;
        }
        if let Some(inputs) = view.input_indices {
            self.table("input_index", inputs.iter().map(|i| i.map_or(-1.0, f64::from)))?;
        }
        if let Some(promised) = view.promised.filter(|promised| !promised.exempt.is_empty()) {
            let exempt: BTreeSet<u32> = promised.exempt.iter().copied().collect();
            self.of_triangles("exempt", |t| f64::from(u8::from(exempt.contains(&(t as u32)))))?;
        }
        if let Some(regions) = view.regions
            && regions.iter().any(|&r| f64::from(group(r)) != r)
        {
            self.of_triangles("region", |t| regions[t])?;
        }
        self.text.finish()
    }

    /// Data of triangles, a number for each; that of edges is 0.
    fn of_triangles(&mut self, name: &str, value: impl Fn(usize) -> f64) -> io::Result<()> {
        let edges = self.view.marked_edges.map_or(0, <[_]>::len);
        let count = self.view.mesh.triangles.len();
        // Some readers take the rows for the elements in the order of the file.
        let order = sorted(count, self.regions.len(), |t| self.region(t));
        let listed = (0..count).map(|i| order.as_ref().map_or(i, |order| order[i] as usize));
        let of_edges = (1..=edges).map(|tag| (tag, 0.0));
        let of_triangles = listed.map(|t| (edges + t + 1, value(t)));
        self.rows("Element", name, edges + count, of_edges.chain(of_triangles))
    }

    /// Data of vertices, a number for each.
    fn table(&mut self, name: &str, values: impl ExactSizeIterator<Item = f64>) -> io::Result<()> {
        self.rows("Node", name, values.len(), (1..).zip(values))
    }

    /// A section of data: numbers of items and their values.
    fn rows(
        &mut self,
        item: &str,
        name: &str,
        count: usize,
        rows: impl Iterator<Item = (usize, f64)>,
    ) -> io::Result<()> {
        let text = &mut self.text;
        text.text("$").text(item).text("Data\n1\n\"").text(name);
        // One real tag, the time 0; three integer tags: step 0, one component, the
        // number of items.
        text.text("\"\n1\n0.0\n3\n0\n1\n").integer(count).text("\n");
        for (tag, value) in rows {
            text.integer(tag).text(" ").number(value).text("\n").breathe()?;
        }
        text.text("$End").text(item).text("Data\n");
        Ok(())
    }
}

/// The items by their groups, if there is more than one.
fn sorted(count: usize, groups: usize, group: impl Fn(usize) -> i32) -> Option<Vec<u32>> {
    (groups > 1).then(|| {
        let mut order: Vec<u32> = (0..count as u32).collect();
        order.sort_by_key(|&i| group(i as usize));
        order
    })
}

/// The ranges of items of one group each.
fn runs(
    order: Option<&[u32]>,
    count: usize,
    group: impl Fn(usize) -> i32,
) -> impl Iterator<Item = std::ops::Range<usize>> {
    let at = move |i: usize| group(order.map_or(i, |order| order[i] as usize));
    let mut start = 0;
    std::iter::from_fn(move || {
        if start >= count {
            return None;
        }
        let end = (start + 1..count).find(|&i| at(i) != at(start)).unwrap_or(count);
        let run = start..end;
        start = end;
        Some(run)
    })
}

fn position(text: &mut TextWriter<'_>, p: DVec2) -> io::Result<()> {
    text.number(p.x).text(" ").number(p.y).text(" 0\n").breathe()
}
