//! How long edges may be: `--size`, rasters and tables of sizes, rasters of depths.

use crate::exit::{Failure, unused, warn};
use crate::plane::Plane;
use hexdel::size::{PER_WAVELENGTH, TIDE};
use hexdel::{DVec2, Size, WaveRule};
use hexdel_io::Raster;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Options of sizes.
#[derive(clap::Args)]
pub(crate) struct SizeArgs {
    /// Longest edge allowed
    #[arg(long = "size", alias = "max-edge", value_name = "H", value_parser = positive)]
    #[arg(allow_negative_numbers = true)]
    max_edge: Option<f64>,
    /// Longest edge by place: a raster (.asc) or points with sizes (x y size)
    #[arg(long, value_name = "FILE")]
    size_file: Option<PathBuf>,
    /// Raster (.asc) of depths in metres: edges sqrt(g depth) T / N, up to --size
    #[arg(long, hide = true, value_name = "FILE")]
    size_from_depth: Option<PathBuf>,
    /// The period T of the waves [default: 44714.16, the tide M2]
    #[arg(long, hide = true, value_name = "SECONDS", value_parser = positive, requires = "size_from_depth")]
    #[arg(allow_negative_numbers = true)]
    wave_period: Option<f64>,
    /// Elements N in the length of a wave [default: 30]
    #[arg(long, hide = true, value_name = "N", value_parser = positive, requires = "size_from_depth")]
    #[arg(allow_negative_numbers = true)]
    per_wavelength: Option<f64>,
    /// Shortest edge asked for by depth [default: a cell of the raster]
    #[arg(long, hide = true, value_name = "H", value_parser = positive, requires = "size_from_depth")]
    #[arg(allow_negative_numbers = true)]
    min_size: Option<f64>,
    /// The raster has heights, negative under water, not depths
    #[arg(long, hide = true, requires = "size_from_depth")]
    elevations: bool,
    /// How much longer edges may get per unit of distance [default: 0.5]
    #[arg(long, hide = true, value_name = "G", value_parser = positive, allow_negative_numbers = true)]
    gradation: Option<f64>,
}

pub(crate) fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if f64::is_finite(number) && number > 0.0 => Ok(number),
        _ => Err("must be a positive number".to_owned()),
    }
}

/// What a report says of depths.
#[derive(Serialize)]
pub(crate) struct DepthFigures {
    /// The raster's file.
    file: String,
    /// The rule of lengths.
    rule: WaveRule,
    /// Cells of the raster.
    cells: usize,
    /// Those above the water, and those without a depth.
    dry: usize,
    without: usize,
    /// The least and the largest depth, metres, positive under water.
    depths: [f64; 2],
}

impl DepthFigures {
    /// The line of a summary.
    pub(crate) fn line(&self) -> String {
        let Self { rule, cells, dry, without, depths: [low, high], .. } = self;
        let most = if rule.max.is_finite() { format!(" to {}", rule.max) } else { " and more".to_owned() };
        format!(
            "depths     {low} to {high} m, of {cells} cells {dry} dry, {without} without data\n           \
             edges {}{most} by {} in the length of waves of {} s\n",
            rule.min, rule.per_wavelength, rule.period,
        )
    }
}

/// What sizes are read for: the file of points, where they are, and the plane that they are projected to.
pub(crate) struct Place<'a> {
    pub(crate) file: &'a Path,
    pub(crate) points: &'a [DVec2],
    pub(crate) plane: Option<&'a Plane>,
}

impl SizeArgs {
    /// The size, if anything says so, and what depths were found.
    pub(crate) fn read(&self, place: &Place<'_>) -> Result<(Option<Size>, Option<DepthFigures>), Failure> {
        if self.gradation.is_some() && self.size_file.is_none() && self.size_from_depth.is_none() {
            return unused(
                "--gradation",
                "it is for --size-file and --size-from-depth, and there is neither",
            );
        }
        let of_option = |source| Failure::Size { file: place.file.display().to_string(), source };
        let none = Size::unlimited();
        let mut size = none.clone();
        if let Some(h) = self.max_edge {
            size = size.and_constant(h).map_err(of_option)?;
        }
        if let Some(gradation) = self.gradation {
            size = size.with_gradation(gradation).map_err(of_option)?;
        }
        let graded = size.clone();
        if let Some(path) = &self.size_file {
            size = of_file(size, path, place)?;
        }
        let mut depths = None;
        if let Some(path) = &self.size_from_depth {
            let (with, figures) = self.of_depths(size, path, place)?;
            (size, depths) = (with, Some(figures));
        }
        // A gradation alone limits nothing.
        let limits = self.max_edge.is_some() || size != graded;
        Ok((limits.then_some(size), depths))
    }

    fn of_depths(&self, size: Size, path: &Path, place: &Place<'_>) -> Result<(Size, DepthFigures), Failure> {
        let at_fault = |source| Failure::Size { file: path.display().to_string(), source };
        let mut raster = hexdel_io::read_raster(path)?;
        if self.elevations {
            raster.values.iter_mut().flatten().for_each(|value| *value = -*value);
        }
        let known: Vec<f64> = raster.values.iter().copied().flatten().collect();
        let dry = known.iter().filter(|&&depth| depth <= 0.0).count();
        if known.iter().filter(|&&depth| depth < 0.0).count() > known.len() / 2 {
            let other = if self.elevations { "leave --elevations out" } else { "give --elevations" };
            warn(&format!(
                "{}: most of the depths are above the water; if heights and depths are confused, {other}",
                path.display()
            ));
        }
        let extremes = [f64::min as fn(f64, f64) -> f64, f64::max];
        let depths = extremes.map(|pick| known.iter().copied().reduce(pick).unwrap_or(f64::NAN));
        let (cells, without) = (raster.values.len(), raster.values.len() - known.len());
        let raster = in_plane(raster, path, place)?;
        let range = [self.min_size.unwrap_or(raster.cell), self.max_edge.unwrap_or(f64::INFINITY)];
        let (period, elements) =
            (self.wave_period.unwrap_or(TIDE), self.per_wavelength.unwrap_or(PER_WAVELENGTH));
        let rule = WaveRule::new(period, elements, range).map_err(at_fault)?;
        let size = size.and_depths(&raster, &rule).map_err(at_fault)?;
        let file = path.display().to_string();
        Ok((size, DepthFigures { file, rule, cells, dry, without, depths }))
    }
}

/// A size with what a file adds: a raster (`.asc`), or a text table of points,
/// `x y size` in each line.
pub(crate) fn size_of_file(size: Size, path: &Path) -> Result<Size, Failure> {
    of_file(size, path, &Place { file: path, points: &[], plane: None })
}

fn of_file(size: Size, path: &Path, place: &Place<'_>) -> Result<Size, Failure> {
    let of_size = |source| Failure::Size { file: path.display().to_string(), source };
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("asc")) {
        let raster = in_plane(hexdel_io::read_raster(path)?, path, place)?;
        return size.and_raster(&raster).map_err(of_size);
    }
    let mut points = hexdel_io::read_sizes(path)?;
    if let Some(plane) = place.plane {
        for (at, _) in &mut points {
            // What is not on the plane is refused with the sizes that are not numbers.
            *at = plane.project(*at).unwrap_or(DVec2::NAN);
        }
    }
    size.and_points(&points).map_err(of_size)
}

/// How far around the points a raster is taken to the plane, over the longer side of the box around them.
const AROUND: f64 = 0.1;

/// A raster by longitude and latitude as one in the plane around the points, with cells as small as they are there.
fn in_plane(raster: Raster, path: &Path, place: &Place<'_>) -> Result<Raster, Failure> {
    let Some(plane) = place.plane else { return Ok(raster) };
    let elsewhere = || Failure::RasterElsewhere { file: path.display().to_string() };
    let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = place.points.iter().fold(start, |(low, high), p| (low.min(*p), high.max(*p)));
    let margin = AROUND * (high - low).max_element();
    let (west, east) = (raster.low.x, raster.low.x + raster.cell * (raster.columns as f64 - 1.0));
    // The same meridian has several longitudes: the one that the raster has is taken.
    let to_raster = |p: DVec2| {
        let mut at = plane.degrees(p);
        while at.x < west - 0.5 * raster.cell {
            at.x += 360.0;
        }
        while at.x > east + 0.5 * raster.cell && at.x - 360.0 >= west - 0.5 * raster.cell {
            at.x -= 360.0;
        }
        at
    };
    let middle = plane.degrees(0.5 * (low + high));
    let side = |step: DVec2| Some(plane.project(middle + step)?.distance(plane.project(middle)?));
    let sides = [DVec2::X, DVec2::Y].map(|step| side(raster.cell * step).unwrap_or(f64::INFINITY));
    let cell = sides[0].min(sides[1]);
    if !(cell > 0.0 && cell.is_finite()) {
        return Err(elsewhere());
    }
    let planar = raster.resampled([low - margin, high + margin], cell, to_raster);
    if planar.values.iter().all(Option::is_none) && raster.values.iter().any(Option::is_some) {
        return Err(elsewhere());
    }
    Ok(planar)
}
