//! The tables of `docs/performance.md`.

use super::case::Measured;
use super::inputs::Input;
use crate::Outcome;
use crate::tidy::root;
use std::fmt::Write as _;

/// One input, measured three times.
pub(crate) struct Row {
    pub(crate) input: Input,
    pub(crate) points: usize,
    /// On one thread.
    pub(crate) one: Measured,
    /// On all threads.
    pub(crate) all: Measured,
    pub(crate) spade: Measured,
}

impl Row {
    /// Millions of triangles per second of processor time on one thread.
    fn rate(measured: &Measured) -> f64 {
        measured.triangles / measured.cpu() / 1e6
    }

    pub(crate) fn summary(&self) -> String {
        let (one, spade) = (Self::rate(&self.one), Self::rate(&self.spade));
        let (name, ratio) = (self.input.name(), one / spade);
        format!("{name} {}: {one:.2} Mtri/s, spade {spade:.2}, ratio {ratio:.1}", self.points)
    }
}

/// All tables, as Markdown.
pub(crate) fn tables(rows: &[Row], memory: &[Measured], threads: usize) -> String {
    let mut out = String::new();
    rates(&mut out, rows, threads);
    phases(&mut out, rows);
    exponents(&mut out, rows);
    limits(&mut out, memory);
    out
}

fn rates(out: &mut String, rows: &[Row], threads: usize) {
    *out += "Triangles per second of processor time on one thread, refining and extracting; spade's \
             `refine` at 30 degrees on the same points in the same hexagon, its initial triangulation \
             not counted.\n\n";
    let _ = writeln!(
        out,
        "| input | points | triangles | Mtri/s | spade: triangles | spade: Mtri/s | ratio | µs per point | \
         bytes per triangle | wall, 1 thread | wall, {threads} threads | speed-up |"
    );
    *out += "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    for row in rows {
        let (rate, spade) = (Row::rate(&row.one), Row::rate(&row.spade));
        let _ = writeln!(
            out,
            "| {} | {} | {} | {rate:.2} | {} | {spade:.2} | {:.1} | {:.2} | {:.1} | {:.3} s | {:.3} s | {:.2} |",
            row.input.name(),
            row.points,
            row.one.triangles,
            row.spade.triangles,
            rate / spade,
            row.one.cpu() / row.points as f64 * 1e6,
            row.one.peak / row.one.triangles,
            row.one.wall(),
            row.all.wall(),
            row.one.wall() / row.all.wall(),
        );
    }
}

fn phases(out: &mut String, rows: &[Row]) {
    *out += "\nProcessor seconds per phase on one thread, and the work of the rules engine: a tile is 64 \
             hexagons, whose rules are evaluated (asked) together.\n\n\
             | input | points | refine | extract | peak MB | tiles | asked per tile | ns per tile asked |\n\
             |---|---:|---:|---:|---:|---:|---:|---:|\n";
    for Row { input, points, one, .. } in rows {
        let _ = writeln!(
            out,
            "| {} | {points} | {:.3} | {:.3} | {:.0} | {} | {:.1} | {:.0} |",
            input.name(),
            one.refine[1],
            one.extract[1],
            one.peak / 1e6,
            one.tiles,
            one.asked / one.tiles,
            one.refine[1] / one.asked * 1e9,
        );
    }
}

fn exponents(out: &mut String, rows: &[Row]) {
    *out += "\nExponent of processor time over the number of points, from 10 000 points on.\n\n\
             | input | hexdel | spade |\n|---|---:|---:|\n";
    for input in Input::ALL {
        let large = || rows.iter().filter(|r| r.input == input && r.points >= 10_000);
        if large().count() < 2 {
            continue;
        }
        let of = |pick: fn(&Row) -> &Measured| {
            let rows = large();
            slope(rows.map(|r| ((r.points as f64).ln(), pick(r).cpu().ln())))
        };
        let _ = writeln!(out, "| {} | {:.3} | {:.3} |", input.name(), of(|r| &r.one), of(|r| &r.spade));
    }
}

fn limits(out: &mut String, memory: &[Measured]) {
    *out += "\nWriting fresh memory as large as a mesh, 20 bytes per triangle: no mesher on one thread can \
             be faster.\n\n| triangles | Mtri/s |\n|---:|---:|\n";
    for m in memory {
        let _ = writeln!(out, "| {} | {:.0} |", m.triangles, Row::rate(m));
    }
}

/// Slope of the line of least squares.
fn slope(points: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let n = points.clone().count() as f64;
    let (mx, my) = points.clone().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
    let (sxy, sxx) =
        points.fold((0.0, 0.0), |(a, b), (x, y)| (a + (x - mx) * (y - my), b + (x - mx).powi(2)));
    sxy / sxx
}

const BEGIN: &str = "<!-- begin: cargo xtask bench -->";
const END: &str = "<!-- end -->";

/// Puts the tables into `docs/performance.md`, between their marks.
pub(crate) fn write(tables: &str) -> Outcome {
    let path = root().join("docs/performance.md");
    let text = std::fs::read_to_string(&path)?;
    let (before, rest) = text.split_once(BEGIN).ok_or("docs/performance.md has no place for the tables")?;
    let (_, after) = rest.split_once(END).ok_or("docs/performance.md does not say where the tables end")?;
    std::fs::write(&path, format!("{before}{BEGIN}\n\n{tables}\n{END}{after}"))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_its_exponent_as_slope() {
        let points = [10.0_f64, 100.0, 1000.0].map(|x| (x.ln(), (3.0 * x.powf(1.25)).ln()));
        assert!((slope(points.into_iter()) - 1.25).abs() < 1e-12);
    }
}
