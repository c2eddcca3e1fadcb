//! Pictures of triangle meshes, in SVG and PNG.
//!
//! A [`Plot`] is a mesh with what is known about it. Its [`Picture`] says how it looks: what colours
//! mean ([`ColourBy`]), what is drawn over the mesh ([`Overlay`]), which part is shown. It is drawn
//! by [`Plot::write_svg`] and, with the feature `png`, by `Plot::write_png`.
//!
//! Colours come from the angles of triangles by default, from a bound to 60 degrees; the legend has
//! the scale, counts, and a histogram if wanted. The same plot gives the same bytes on every platform.
//!
//! Not here: files, which `hexdel-io` writes whole or not at all, and how meshes are made.

/// The example of the README, so that it stays true.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod canvas;
mod colour;
mod error;
mod frame;
#[cfg(feature = "png")]
mod glyphs;
mod histogram;
mod legend;
mod picture;
mod plot;
#[cfg(feature = "png")]
mod png;
mod scene;
mod survey;
mod svg;
mod text;

pub use colour::Rgb;
pub use error::PlotError;
pub use picture::{ColourBy, Groups, Overlay, OverlayClass, Picture, Polygon};
pub use plot::Plot;
