//! `docs/gallery.md` and its pictures: the six kinds of input of the paper's
//! Fig. 15 and Table 1, meshed by the templates and by the compact method.
//!
//! Meshes of few triangles are drawn in SVG, others in PNG, which does not grow
//! with their number.

use super::Files;
use hexdel::generate::{Kind, generate};
use hexdel::geom::Pslg;
use hexdel::io::{MarkedEdge, MeshFormat, MeshView, read_points, write_mesh_to};
use hexdel::plot::Picture;
use hexdel::{Certificate, DVec2, Mesher, Method};
use rayon::prelude::*;
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

/// Where the pictures lie, beside the document.
pub(super) const FOLDER: &str = "figures/gallery";

/// Meshes with more triangles than this are drawn in PNG.
const MOST_IN_SVG: usize = 3000;

/// The longer side of the drawings, pixels.
const SIZE_PX: f64 = 600.0;

type Fault = Box<dyn Error + Send + Sync>;

/// The bowl of the letter R, in the coordinates of the letters.
const LETTER_R: [DVec2; 2] = [DVec2::new(3.6, 0.9), DVec2::new(4.7, 1.8)];

/// A kind of input.
struct Input {
    /// The first part of its pictures' names.
    name: &'static str,
    title: &'static str,
    text: &'static str,
    from: From,
    /// Circumradius of the domain, if it is not the smallest.
    radius: Option<f64>,
    /// A box to be shown by itself.
    close_up: Option<[DVec2; 2]>,
}

/// Where an input comes from.
enum From {
    Fixture(&'static str),
    Uniform(usize),
}

const INPUTS: [Input; 6] = [
    Input {
        name: "two-close",
        title: "Two close points",
        text: "Two points, 0.02 apart, in a hexagon of radius 1.",
        from: From::Fixture("points/two_close.node"),
        radius: Some(1.0),
        close_up: None,
    },
    Input {
        name: "line",
        title: "100 points on a line",
        text: "Random points on a straight line, some of them very close together.",
        from: From::Fixture("points/line100.node"),
        radius: None,
        close_up: None,
    },
    Input {
        name: "plane",
        title: "100 points in the plane",
        text: "Uniform random points in a square.",
        from: From::Fixture("points/plane100.node"),
        radius: None,
        close_up: None,
    },
    Input {
        name: "letters",
        title: "Letters",
        text: "The outlines of I, M and R as segments, with more detail from I to R. All angles are between\n\
               30 and 90 degrees. Heavier lines are segments.",
        from: From::Fixture("graphs/letters.poly"),
        radius: None,
        close_up: Some(LETTER_R),
    },
    Input {
        name: "uniform-1000",
        title: "1,000 points in the plane",
        text: "Uniform random points in a square, `hexdel generate uniform 1000 --seed 1`.",
        from: From::Uniform(1000),
        radius: None,
        close_up: None,
    },
    Input {
        name: "uniform-2000",
        title: "2,000 points in the plane",
        text: "Uniform random points in a square, `hexdel generate uniform 2000 --seed 1`.",
        from: From::Uniform(2000),
        radius: None,
        close_up: None,
    },
];

/// A picture of a mesh.
struct Shown {
    /// What stands above it.
    label: &'static str,
    /// File name and content.
    file: (String, Vec<u8>),
    /// What stands below it.
    figures: String,
}

/// The document and its pictures, by their paths below `docs`.
pub(super) fn all(root: &Path) -> Result<Files, Fault> {
    let cases = INPUTS.iter().flat_map(|input| input.methods().iter().map(move |method| (input, *method)));
    let cases: Vec<_> = cases.collect();
    let made: Vec<Vec<Shown>> =
        cases.par_iter().map(|(input, method)| make(root, input, *method)).collect::<Result<_, _>>()?;
    let mut document = OPENING.to_owned();
    let mut files = Files::new();
    let mut made = made.into_iter();
    for input in &INPUTS {
        let shown: Vec<Shown> = made.by_ref().take(input.methods().len()).flatten().collect();
        section(&mut document, input, &shown)?;
        files.extend(shown.into_iter().map(|s| (format!("{FOLDER}/{}", s.file.0), s.file.1)));
    }
    files.insert("gallery.md".to_owned(), document.into_bytes());
    Ok(files)
}

impl Input {
    /// How it is meshed; there is but one method for segments.
    fn methods(&self) -> &'static [Method] {
        if self.close_up.is_some() { &[Method::Templates] } else { &[Method::Templates, Method::Compact] }
    }
}

const OPENING: &str = "\
# Gallery

This page shows the six kinds of input of the paper (Fig. 15 and Table 1), each meshed by the templates, which is the
paper's method, and by the compact method. Segments have a method of their own. Colours show the smallest angle of each
triangle; the histograms count all angles. The paper's random points and letters are not published; these are similar.

`cargo xtask regen` makes this page and its pictures. To make a single picture, run

```sh
hexdel mesh fixtures/points/plane100.node -o out/plane.png --histogram --pixels 600 --method templates
hexdel mesh fixtures/points/plane100.node -o out/plane.svg --histogram --pixels 600 --method compact
```

Other pictures show the largest angle, region, level or class of each triangle, the hexagons behind a mesh, or a detail:
see `hexdel plot --help`.
";

/// What a mesh of so many triangles is drawn in, and what its file's name ends in.
pub(super) fn format_of(triangles: usize) -> (MeshFormat, &'static str) {
    if triangles <= MOST_IN_SVG { (MeshFormat::Svg, "svg") } else { (MeshFormat::Png, "png") }
}

/// Pictures side by side, with their figures.
fn section(document: &mut String, input: &Input, shown: &[Shown]) -> std::fmt::Result {
    let Input { title, text, .. } = input;
    write!(document, "\n## {title}\n\n{text}\n\n|")?;
    for Shown { label, .. } in shown {
        write!(document, " {label} |")?;
    }
    write!(document, "\n|{}\n|", "---|".repeat(shown.len()))?;
    for Shown { label, file: (name, _), .. } in shown {
        write!(document, " ![{title}, {label}]({FOLDER}/{name}) |")?;
    }
    document.push_str("\n|");
    for Shown { figures, .. } in shown {
        write!(document, " {figures} |")?;
    }
    document.push('\n');
    Ok(())
}

fn make(root: &Path, input: &Input, method: Method) -> Result<Vec<Shown>, Fault> {
    let graph = match input.from {
        From::Fixture(path) => read_points(root.join("fixtures").join(path))?,
        From::Uniform(n) => Pslg::from_points(generate(Kind::Uniform, n, 1)),
    };
    if !graph.segments.is_empty() {
        let made = Mesher::new().triangulate_pslg(&graph)?;
        if !made.holds() {
            return Err(format!("{}: the mesh does not hold", input.name).into());
        }
        let edges: Vec<_> =
            made.edges.iter().map(|e| MarkedEdge { ends: e.ends, marker: e.marker }).collect();
        let view = MeshView::new(&made.mesh).with_marked_edges(&edges);
        return [("all", None), ("a part", input.close_up)]
            .into_iter()
            .map(|(label, zoom)| shown(input, label, &view, &made.certificate, zoom))
            .collect();
    }
    let mut mesher = Mesher::new().method(method);
    if let Some(radius) = input.radius {
        mesher = mesher.domain_radius(radius);
    }
    let made = mesher.triangulate(&graph.points)?;
    let inputs = made.input_of_vertex();
    let view = MeshView::new(&made.mesh).with_input_indices(&inputs);
    let label = if method == Method::Compact { "compact" } else { "templates" };
    Ok(vec![shown(input, label, &view, &made.certificate, None)?])
}

fn shown(
    input: &Input,
    label: &'static str,
    view: &MeshView<'_>,
    certificate: &Certificate,
    zoom: Option<[DVec2; 2]>,
) -> Result<Shown, Fault> {
    let (format, extension) = format_of(view.mesh.triangles.len());
    let mut picture = Picture::default();
    picture.size_px = SIZE_PX;
    picture.bounds_deg = [certificate.bounds.min_deg(), certificate.bounds.max_deg()];
    picture.histogram = true;
    picture.zoom = zoom;
    let mut bytes = Vec::new();
    write_mesh_to(&mut bytes, format, &view.with_picture(picture), input.name)?;
    let name = format!("{}-{}.{extension}", input.name, label.replace(' ', "-"));
    let (min, max) = (certificate.min_angle_deg, certificate.max_angle_deg);
    let figures = match zoom {
        None => format!("{} triangles, {min:.2}° to {max:.2}°", certificate.triangles),
        Some(_) => String::new(),
    };
    Ok(Shown { label, file: (name, bytes), figures })
}
