//! `docs/gallery.md` and its pictures: the six kinds of input of the paper's
//! Fig. 15 and Table 1, meshed by the templates and by the compact method.
//!
//! Meshes of few triangles are drawn in SVG, others in PNG, which does not grow
//! with their number.

use super::Files;
use hexdel::generate::{Kind, generate};
use hexdel::geom::Pslg;
use hexdel::io::{ColourBy, MarkedEdge, MeshFormat, MeshView, Picture, read_points, write_mesh_to};
use hexdel::{AngleBounds, Certificate, DVec2, Mesher, Method};
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
        text: "Random points on a straight line, some of them very close to each other.",
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
        text: "The outlines of I, M and R as segments, their detail growing from I to R. Triangles at segments \
               keep 30 to 90 degrees, all others 43.9 to 90. Segments are drawn heavier.",
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

/// A mesh with its pictures.
struct Made {
    method: &'static str,
    certificate: Certificate,
    /// By name, the whole mesh first, then the close-up.
    pictures: Vec<(String, Vec<u8>)>,
}

/// The document and its pictures, by their paths below `docs`.
pub(super) fn all(root: &Path) -> Result<Files, Fault> {
    let cases = INPUTS.iter().flat_map(|input| [Method::Templates, Method::Compact].map(|m| (input, m)));
    let cases: Vec<_> = cases.collect();
    let made: Vec<Made> =
        cases.par_iter().map(|(input, method)| make(root, input, *method)).collect::<Result<_, _>>()?;
    let mut document = OPENING.to_owned();
    for (input, made) in INPUTS.iter().zip(made.chunks_exact(2)) {
        section(&mut document, input, made)?;
    }
    let pictures = made.into_iter().flat_map(|made| made.pictures);
    let mut files: Files = pictures.map(|(name, bytes)| (format!("{FOLDER}/{name}"), bytes)).collect();
    files.insert("gallery.md".to_owned(), document.into_bytes());
    Ok(files)
}

const OPENING: &str = "\
# Gallery

The six kinds of input that the paper shows (Fig. 15 and Table 1), each meshed by the templates, the paper's
method, and by the compact method. Triangles are coloured by their smallest angle; the histograms count all angles.
What random points and what letters the paper has is not published: these are like them.

`cargo xtask regen` makes this page and its pictures. One by one they come from

```sh
hexdel mesh fixtures/points/plane100.node -o out/plane.png --histogram --size 600
hexdel mesh fixtures/points/plane100.node -o out/plane.svg --histogram --size 600 --method compact
```

More pictures: triangles by their largest angle, region, level or class, the hexagons behind a mesh, any box of it;
see `hexdel plot --help`.
";

/// Two pictures side by side, with their figures.
fn section(document: &mut String, input: &Input, made: &[Made]) -> std::fmt::Result {
    let Input { title, text, .. } = input;
    write!(document, "\n## {title}\n\n{text}\n\n")?;
    for made in made {
        write!(document, "| {} ", made.method)?;
    }
    document.push_str("|\n|---|---|\n");
    for picture in 0..made[0].pictures.len() {
        for made in made {
            let (name, _) = &made.pictures[picture];
            write!(document, "| ![{title}, {}]({FOLDER}/{name}) ", made.method)?;
        }
        document.push_str("|\n");
    }
    for Made { certificate: c, .. } in made {
        let (min, max) = (c.min_angle_deg, c.max_angle_deg);
        write!(document, "| {} triangles, {min:.2}° to {max:.2}° ", c.triangles)?;
    }
    document.push_str("|\n");
    Ok(())
}

fn make(root: &Path, input: &Input, method: Method) -> Result<Made, Fault> {
    let graph = match input.from {
        From::Fixture(path) => read_points(root.join("fixtures").join(path))?,
        From::Uniform(n) => Pslg::from_points(generate(Kind::Uniform, n, 1)),
    };
    let mut mesher = Mesher::new().method(method);
    if let Some(radius) = input.radius {
        mesher = mesher.domain_radius(radius);
    }
    let name = if method == Method::Compact { "compact" } else { "templates" };
    let made = if graph.segments.is_empty() {
        let made = mesher.triangulate(&graph.points)?;
        let inputs = made.input_of_vertex();
        let view = MeshView::new(&made.mesh).with_input_indices(&inputs);
        Made {
            method: name,
            pictures: pictures(input, name, view, AngleBounds::EXTENDED)?,
            certificate: made.certificate,
        }
    } else {
        let made = mesher.triangulate_pslg(&graph)?;
        let edges: Vec<_> =
            made.edges.iter().map(|e| MarkedEdge { ends: e.ends, marker: e.marker }).collect();
        let view = MeshView::new(&made.mesh).with_marked_edges(&edges);
        Made {
            method: name,
            pictures: pictures(input, name, view, made.certificate.bounds)?,
            certificate: made.certificate,
        }
    };
    Ok(made)
}

/// The whole mesh, and the close-up if there is one.
fn pictures(
    input: &Input,
    method: &str,
    view: MeshView<'_>,
    bounds: AngleBounds,
) -> Result<Vec<(String, Vec<u8>)>, Fault> {
    let in_svg = view.mesh.triangles.len() <= MOST_IN_SVG;
    let (format, extension) = if in_svg { (MeshFormat::Svg, "svg") } else { (MeshFormat::Png, "png") };
    let boxes = std::iter::once(("", None)).chain(input.close_up.map(|zoom| ("-close", Some(zoom))));
    let draw = |(part, zoom): (&str, _)| {
        let mut picture = Picture::default();
        picture.size_px = SIZE_PX;
        picture.bounds_deg = [bounds.min_deg(), bounds.max_deg()];
        picture.colour_by = ColourBy::SmallestAngle;
        picture.histogram = true;
        picture.zoom = zoom;
        let mut bytes = Vec::new();
        write_mesh_to(&mut bytes, format, &view.with_picture(picture), input.name)?;
        Ok((format!("{}{part}-{method}.{extension}", input.name), bytes))
    };
    boxes.map(draw).collect()
}
