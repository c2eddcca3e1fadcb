//! Pictures: what colours say, what a box shows, and that PNG has what SVG has.

use crate::support::squares;
use hexdel_geom::{DVec2, MarkedEdge, TriMesh, VertexId};
use hexdel_plot::{ColourBy, Groups, Overlay, OverlayClass, Picture, Plot, PlotError, Polygon, Rgb};

fn svg(plot: &Plot<'_>) -> String {
    let mut out = Vec::new();
    plot.write_svg(&mut out).unwrap();
    String::from_utf8(out).unwrap()
}

/// A part of an SVG by its name.
fn part<'s>(svg: &'s str, name: &str) -> &'s str {
    let (_, rest) = svg.split_once(&format!("<g id=\"{name}\">")).unwrap();
    rest.split_once("</g>").unwrap().0
}

fn refused(mesh: &TriMesh, change: impl Fn(&mut Picture<'_>)) -> PlotError {
    let mut plot = Plot::new(mesh);
    change(&mut plot.picture);
    plot.write_svg(&mut Vec::new()).unwrap_err()
}

#[test]
fn colours_say_angles() {
    // Half a square, a triangle of 60 degrees, and one of 20, 20 and 140.
    let flat = 1.0_f64.to_radians() * 20.0;
    let mesh = TriMesh {
        vertices: vec![
            DVec2::ZERO,
            DVec2::X,
            DVec2::ONE,
            DVec2::new(0.5, -0.75_f64.sqrt()),
            DVec2::new(0.5, -2.0),
            DVec2::new(2.5, -2.0),
            DVec2::new(1.5, flat.tan() - 2.0),
        ],
        triangles: [[0, 1, 2], [3, 1, 0], [4, 5, 6]].map(|t| t.map(VertexId::new)).into(),
    };
    let red = "fill=\"#e01e37\"";
    let fills = |by, bounds_deg, what: &str| {
        let mut plot = Plot::new(&mesh);
        plot.picture.colour_by = by;
        plot.picture.bounds_deg = bounds_deg;
        let svg = svg(&plot);
        assert!(svg.contains(what), "{what}");
        let triangles = part(&svg, "triangles");
        let fills = triangles.split("fill=\"").skip(1).map(|rest| rest[..7].to_owned());
        let mut fills: Vec<String> = fills.collect();
        fills.sort();
        (fills, svg.contains(red))
    };
    // The ends of the scale, half a shade inside.
    let (first, last) = ("#440456", "#f8e627");
    let (found, has_red) = fills(ColourBy::SmallestAngle, [45.0, 90.0], "below 45°: 1");
    assert_eq!((found, has_red), (vec![first.to_owned(), "#e01e37".to_owned(), last.to_owned()], true));
    let (found, has_red) = fills(ColourBy::LargestAngle, [45.0, 90.0], "above 90°: 1");
    assert_eq!((found, has_red), (vec![first.to_owned(), "#e01e37".to_owned(), last.to_owned()], true));
    let (found, has_red) = fills(ColourBy::LargestAngle, [45.0, 140.0], "angles 20.00° to 140.00°");
    assert!(found.len() == 3 && found[1] == first && found[2] == last && !has_red, "{found:?}");
}

#[test]
fn colours_say_regions_and_groups() {
    let mesh = squares(2);
    let regions = [7.0, 7.0, -1.5, 7.0, 7.0, 7.0, 7.0, 0.0];
    let mut plot = Plot::new(&mesh).with_regions(&regions);
    plot.picture.colour_by = ColourBy::Region;
    let found = svg(&plot);
    for label in ["region", ">-1.5: 1<", ">0: 1<", ">7: 6<"] {
        assert!(found.contains(label), "{label}");
    }
    let count = |colour: &str| {
        let (_, rest) = part(&found, "triangles").split_once(&format!("fill=\"{colour}\"")).unwrap();
        rest.split_once("/>").unwrap().0.matches('M').count()
    };
    assert_eq!(["#8db4dc", "#f6b26b", "#93c988"].map(count), [1, 1, 6]);

    let many: Vec<f64> = (0..8).map(f64::from).collect();
    let mut wide = squares(4);
    wide.triangles.truncate(30);
    let thirty: Vec<f64> = (0..30).map(f64::from).collect();
    let mut plot = Plot::new(&wide).with_regions(&thirty);
    plot.picture.colour_by = ColourBy::Region;
    assert!(svg(&plot).contains("and 14 more"));

    let class = |label: &str, colour| OverlayClass { label: label.to_owned(), colour: Rgb(colour) };
    let groups = Groups {
        title: "kinds".to_owned(),
        classes: vec![class("none", [1, 2, 3]), class("odd", [4, 5, 6]), class("even", [7, 8, 9])],
        of_triangle: many.iter().map(|i| if i % 2.0 == 0.0 { 2 } else { 1 }).collect(),
    };
    let mut plot = Plot::new(&mesh);
    plot.picture.colour_by = ColourBy::Groups(&groups);
    let found = svg(&plot);
    for label in ["kinds", ">odd: 4<", ">even: 4<", "fill=\"#040506\"", "fill=\"#070809\""] {
        assert!(found.contains(label), "{label}");
    }
    assert!(!found.contains("none"));
}

#[test]
fn a_box_shows_what_crosses_it() {
    let mesh = squares(8);
    let indices: Vec<_> = (0..81).map(Some).collect();
    for (min, max, triangles, dots) in [
        ([2.0, 2.0], [3.0, 3.0], 2, 4),
        ([1.5, 1.5], [2.5, 2.5], 6, 1),
        ([-5.0, -5.0], [1.0, 1.0], 2, 4),
        ([-1.0, -1.0], [9.0, 9.0], 128, 81),
        // Inside of a triangle, in the middle of an edge, and far too deep.
        ([2.6, 2.1], [2.7, 2.2], 1, 0),
        ([2.4, 2.4], [2.6, 2.6], 2, 0),
        ([2.6, 2.1], [2.6 + 1e-15, 2.1 + 1e-15], 1, 0),
    ] {
        let mut plot = Plot::new(&mesh).with_input_indices(&indices);
        plot.picture.zoom = Some([DVec2::from(min), DVec2::from(max)]);
        let svg = svg(&plot);
        assert!(svg.contains(&format!("{triangles} of 128 triangles")), "{min:?} {svg}");
        assert_eq!(part(&svg, "triangles").matches('M').count(), triangles);
        let circles = svg.matches("<circle").count();
        assert_eq!(circles, if dots > 0 { dots + 1 } else { 0 }, "{min:?}");
        // Nothing is drawn far from the page, however long edges are.
        let starts = part(&svg, "triangles").split('M').skip(1);
        for start in starts {
            let x: f64 = start[..=start[1..].find([' ', '-']).unwrap()].parse().unwrap();
            assert!((0.0..=1100.0).contains(&x), "{start}");
        }
    }
}

#[test]
fn an_overlay_is_outlined_over_colours() {
    let mesh = squares(1);
    let overlay = Overlay {
        title: "cells".to_owned(),
        classes: vec![OverlayClass { label: "cell".to_owned(), colour: Rgb([9, 9, 9]) }],
        polygons: vec![Polygon { corners: mesh.vertices.clone(), class: 0, level: 0 }],
    };
    let mut plot = Plot::new(&mesh);
    plot.picture.overlay = Some(&overlay);
    let outlined = svg(&plot);
    assert!(part(&outlined, "overlay").contains("fill=\"none\"") && !outlined.contains("cell<"));
    plot.picture.fill_triangles = false;
    let filled = svg(&plot);
    assert!(part(&filled, "overlay").contains("fill=\"#090909\"") && filled.contains("cell<"));
}

#[test]
fn marked_edges_are_drawn_over_the_others() {
    let mesh = squares(2);
    let edge = |a, b| MarkedEdge { ends: [a, b].map(VertexId::new), marker: 3 };
    let edges = [edge(0, 4), edge(4, 8)];
    let mut plot = Plot::new(&mesh).with_marked_edges(&edges);
    plot.picture.size_px = 200.0;
    assert!(part(&svg(&plot), "segments").contains("M12 212l100-100M112 112l100-100\""));
    // Only what a box needs of them.
    plot.picture.zoom = Some([DVec2::splat(0.5), DVec2::splat(0.75)]);
    let zoomed = svg(&plot);
    assert!(part(&zoomed, "segments").contains("M8 216l208-208"), "{zoomed}");
    plot.picture.edges = false;
    assert!(!svg(&plot).contains("segments"));
}

#[test]
fn a_histogram_marks_the_bounds() {
    let mesh = squares(2);
    let mut plot = Plot::new(&mesh);
    plot.picture.bounds_deg = [43.9, 92.0];
    assert!(!svg(&plot).contains("92°"));
    plot.picture.histogram = true;
    let found = svg(&plot);
    for label in [">43.9°<", ">92°<", ">60°<", "angles, square root scale"] {
        assert!(found.contains(label), "{label}");
    }
    // Bars at 45 and 90 degrees, the taller one of the 96 pixels that there are.
    let (_, bars) = found.split_once("fill=\"#6f8faf\" d=\"").unwrap();
    let bars = bars.split_once('"').unwrap().0;
    assert_eq!(bars.matches('M').count(), 2);
    assert!(bars.contains(" 0 0 96") && bars.contains(" 0 0 67.88"), "{bars}");
}

#[test]
fn pictures_that_make_no_sense_are_refused() {
    let mesh = squares(2);
    for bounds_deg in [[-1.0, 90.0], [61.0, 90.0], [30.0, 59.0], [30.0, 181.0], [f64::NAN, 90.0]] {
        let error = refused(&mesh, |picture| picture.bounds_deg = bounds_deg);
        assert!(matches!(error, PlotError::Bounds { .. }), "{error:?}");
    }
    for (min, max, words) in [
        ([0.0, 0.0], [f64::INFINITY, 1.0], "is not finite"),
        ([0.0, f64::NAN], [1.0, 1.0], "is not finite"),
        ([0.0, 0.0], [0.0, 1.0], "is empty"),
        ([1.0, 1.0], [0.0, 0.0], "is empty"),
        ([2.0, 0.0], [3.0, 1.0], "lies beside the mesh"),
        ([0.0, -9.0], [3.0, -1.0], "lies beside the mesh"),
    ] {
        let error = refused(&mesh, |picture| picture.zoom = Some([DVec2::from(min), DVec2::from(max)]));
        assert!(matches!(error, PlotError::Zoom { .. }), "{error:?}");
        assert!(error.to_string().contains(words), "{error}");
    }
    let error = refused(&mesh, |picture| picture.colour_by = ColourBy::Region);
    assert!(matches!(error, PlotError::NoRegions), "{error:?}");
    for (of_triangle, words) in [
        (vec![0; 7], "7 groups of triangles instead of 8"),
        (vec![0, 0, 0, 1, 0, 0, 0, 0], "triangle 3 refers to number 1 of 1"),
    ] {
        let classes = vec![OverlayClass { label: String::new(), colour: Rgb([0; 3]) }];
        let groups = Groups { title: String::new(), classes, of_triangle };
        let mut plot = Plot::new(&mesh);
        plot.picture.colour_by = ColourBy::Groups(&groups);
        let error = plot.write_svg(&mut Vec::new()).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[cfg(feature = "png")]
mod painted {
    use super::*;

    fn bytes(plot: &Plot<'_>) -> Vec<u8> {
        let mut out = Vec::new();
        plot.write_png(&mut out).unwrap();
        out
    }

    /// Width, height, and three bytes to a pixel.
    fn decoded(plot: &Plot<'_>) -> (usize, usize, Vec<[u8; 3]>) {
        let png = bytes(plot);
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
        let pixels = data[..info.buffer_size()].chunks_exact(3).map(|p| p.try_into().unwrap());
        (info.width as usize, info.height as usize, pixels.collect())
    }

    /// The width and height that the SVG of the same picture says, rounded up.
    fn size_of_svg(plot: &Plot<'_>) -> (usize, usize) {
        let svg = svg(plot);
        let number = |name: &str| {
            let (_, rest) = svg.split_once(&format!(" {name}=\"")).unwrap();
            rest.split_once('"').unwrap().0.parse::<f64>().unwrap().ceil() as usize
        };
        (number("width"), number("height"))
    }

    #[test]
    fn pixels_have_the_colours_of_their_triangles() {
        let mesh = squares(2);
        let class = |colour| OverlayClass { label: "x".to_owned(), colour: Rgb(colour) };
        let colours: Vec<[u8; 3]> = (0..8).map(|i| [20 * i, 255 - 30 * i, 99]).collect();
        let groups = Groups {
            title: "eight".to_owned(),
            classes: colours.iter().copied().map(class).collect(),
            of_triangle: (0..8).collect(),
        };
        // Large enough to be painted in several strips.
        for size_px in [100.0, 900.0] {
            let mut plot = Plot::new(&mesh);
            plot.picture.size_px = size_px;
            plot.picture.colour_by = ColourBy::Groups(&groups);
            let (width, height, pixels) = decoded(&plot);
            assert_eq!((width, height), size_of_svg(&plot));
            let at = |x: f64, y: f64| {
                let [x, y] = [12.0 + x / 2.0 * size_px, 12.0 + (2.0 - y) / 2.0 * size_px];
                pixels[y as usize * width + x as usize]
            };
            for (cell, [x, y]) in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].into_iter().enumerate() {
                assert_eq!(at(x + 0.7, y + 0.3), colours[2 * cell], "{size_px}");
                assert_eq!(at(x + 0.3, y + 0.7), colours[2 * cell + 1], "{size_px}");
            }
            assert_eq!(pixels[0], [255; 3]);
            assert!(at(1.0, 0.5)[1] < 230, "an edge is darker");
            // The legend has text.
            let right = |i: usize| i % width > width - 150;
            assert!(pixels.iter().enumerate().any(|(i, p)| right(i) && p[0] < 90 && p[1] < 90));
        }
    }

    #[test]
    fn neighbours_leave_no_seam_and_the_box_is_all_there_is() {
        let mesh = squares(40);
        let mut plot = Plot::new(&mesh);
        plot.picture.size_px = 133.0;
        plot.picture.edges = false;
        plot.picture.bounds_deg = [50.0, 90.0];
        plot.picture.zoom = Some([DVec2::splat(3.3), DVec2::splat(31.7)]);
        let (width, _, pixels) = decoded(&plot);
        let red = [0xe0, 0x1e, 0x37];
        for (i, pixel) in pixels.iter().enumerate() {
            let [x, y] = [i % width, i / width];
            // A pixel more on each side is the frame.
            if (14..143).contains(&x) && (14..143).contains(&y) {
                assert_eq!(*pixel, red, "{x} {y}");
            } else if x < 11 || y < 11 || (y > 146 && x < 150) {
                assert_eq!(*pixel, [255; 3], "{x} {y}");
            }
        }
    }

    #[test]
    fn pictures_of_extreme_meshes() {
        let triangle = |scale: f64| TriMesh {
            vertices: vec![-DVec2::X * scale, DVec2::X * scale, DVec2::Y * scale],
            triangles: vec![[0, 1, 2].map(VertexId::new)],
        };
        for scale in [f64::MAX, 1e-300, f64::from_bits(1), 0.0] {
            let mesh = triangle(scale);
            let mut plot = Plot::new(&mesh).with_input_indices(&[Some(0), None, None]);
            plot.picture.size_px = 50.0;
            plot.picture.histogram = true;
            let (width, height, _) = decoded(&plot);
            assert_eq!((width, height), size_of_svg(&plot), "{scale}");
        }
        let empty = TriMesh::default();
        assert_eq!(decoded(&Plot::new(&empty)).0, 36);
        let mut plot = Plot::new(&empty);
        plot.picture.size_px = f64::NAN;
        decoded(&plot);
    }

    #[test]
    fn the_same_picture_is_the_same_bytes() {
        let mesh = squares(9);
        let mut plot = Plot::new(&mesh);
        plot.picture.histogram = true;
        plot.picture.size_px = 300.0;
        let png = bytes(&plot);
        assert_eq!(png, bytes(&plot));
        assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    }
}
