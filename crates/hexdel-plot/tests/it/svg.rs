//! Pictures as SVG: triangles, dots, labels and legends, and meshes that cannot be drawn.

use crate::support::squares;
use hexdel_geom::{DVec2, MarkedEdge, TriMesh, VertexId};
use hexdel_plot::{Overlay, OverlayClass, Picture, Plot, PlotError, Polygon, Rgb};

fn svg_of(plot: &Plot<'_>) -> String {
    let mut out = Vec::new();
    plot.write_svg(&mut out).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn svg_draws_every_triangle_point_and_label() {
    let mesh = squares(8);
    let indices: Vec<_> = (0..81).map(|i| (i < 9).then_some(i)).collect();
    let svg = svg_of(&Plot::new(&mesh).with_input_indices(&indices));
    let triangles = svg.split("id=\"triangles\"").nth(1).unwrap().split("</g>").next().unwrap();
    assert_eq!(triangles.matches('M').count(), 128);
    // Nine points and one in the legend.
    assert_eq!(svg.matches("<circle").count(), 10);
    for label in ["128 triangles", "angles 45.00° to 90.00°", "9 input points", ">30°<"] {
        assert!(svg.contains(label), "{label}");
    }
    assert!(!svg.contains("below"));
    assert_eq!(svg, svg_of(&Plot::new(&mesh).with_input_indices(&indices)));
}

#[test]
fn svg_marks_triangles_below_the_scale() {
    let mesh = squares(1);
    let mut picture = Picture::default();
    picture.bounds_deg = [50.0, 90.0];
    let svg = svg_of(&Plot::new(&mesh).with_picture(picture));
    assert!(svg.contains("below 50°: 2"));
}

#[test]
fn svg_overlay_has_a_legend() {
    let mesh = squares(1);
    let square = |x: f64, level| Polygon {
        corners: vec![
            DVec2::new(x, 0.0),
            DVec2::new(x + 1.0, 0.0),
            DVec2::new(x + 1.0, 1.0),
            DVec2::new(x, 1.0),
        ],
        class: 0,
        level,
    };
    let overlay = Overlay {
        title: "classes".to_owned(),
        classes: vec![OverlayClass { label: "a < b & c".to_owned(), colour: Rgb([200, 0, 0]) }],
        polygons: vec![square(0.0, 2), square(1.0, 5)],
    };
    let mut picture = Picture::default();
    picture.fill_triangles = false;
    picture.size_px = 200.0;
    picture.overlay = Some(&overlay);
    let svg = svg_of(&Plot::new(&mesh).with_picture(picture));
    for part in ["classes", "a &lt; b &amp; c", "level 2 light to 5 dark", "#c80000"] {
        assert!(svg.contains(part), "{part}");
    }
    // The second polygon reaches beyond the mesh, the drawing fits both.
    assert!(svg.contains("M112 112l100 0 0-100-100 0z"), "{svg}");

    let mut wrong = overlay.clone();
    wrong.polygons[1].class = 1;
    picture.overlay = Some(&wrong);
    let error = Plot::new(&mesh).with_picture(picture).write_svg(&mut Vec::new()).unwrap_err();
    assert_eq!(error.to_string(), "polygon 1 refers to number 1 of 1");
}

#[test]
fn pictures_of_extreme_meshes() {
    let triangle = |scale: f64| TriMesh {
        vertices: vec![-DVec2::X * scale, DVec2::X * scale, DVec2::Y * scale],
        triangles: vec![[0, 1, 2].map(VertexId::new)],
    };
    for scale in [f64::MAX, 1e-300, f64::from_bits(1), 0.0] {
        let svg = svg_of(&Plot::new(&triangle(scale)));
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{scale} {svg}");
        if scale > 1e-301 {
            assert!(svg.contains("M12 512l1000 0-500-500z"), "{scale} {svg}");
        }
    }
    let empty = svg_of(&Plot::new(&TriMesh::default()));
    assert!(!empty.contains("NaN") && empty.ends_with("</svg>\n"), "{empty}");
}

#[test]
fn what_does_not_fit_the_mesh_is_refused() {
    let mesh = squares(1);
    let refused = |plot: Plot<'_>| {
        let mut out = Vec::new();
        let error = plot.write_svg(&mut out).unwrap_err();
        assert!(out.is_empty());
        error.to_string()
    };
    let plot = Plot::new(&mesh);
    assert_eq!(refused(plot.with_input_indices(&[None; 3])), "3 input indices instead of 4");
    assert_eq!(refused(plot.with_regions(&[0.0])), "1 regions instead of 2");
    let edges = [MarkedEdge { ends: [0, 4].map(VertexId::new), marker: 0 }];
    assert_eq!(refused(plot.with_marked_edges(&edges)), "edge 0 refers to number 4 of 4");
    let mut wrong = mesh.clone();
    wrong.triangles[1][2] = VertexId::new(9);
    assert_eq!(refused(Plot::new(&wrong)), "triangle 1 refers to number 9 of 4");
    let mut wrong = mesh.clone();
    wrong.vertices[2].x = f64::INFINITY;
    assert_eq!(refused(Plot::new(&wrong)), "vertex 2 at (inf, 1) is not finite");
}

#[test]
fn a_stream_that_refuses_is_an_error() {
    let mut none: &mut [u8] = &mut [];
    let error = Plot::new(&squares(1)).write_svg(&mut none).unwrap_err();
    assert!(matches!(error, PlotError::Io(_)), "{error:?}");
}
