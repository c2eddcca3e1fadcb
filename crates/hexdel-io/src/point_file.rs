//! Reading points and PSLGs: which reader for which format, and what is told of the
//! file beside what it holds.

use std::io::BufRead;
use std::path::Path;

use hexdel_geom::Pslg;

use crate::columns::{Columns, TakenColumns};
use crate::data::MeshData;
use crate::error::ReadError;
use crate::format::PointFormat;
use crate::json::{Source, slurp};
use crate::lines::{Comments, Lines};
use crate::mend::{Mends, ReadWarning};
use crate::read::{beside, open};
use crate::shapes::Features;
use crate::{fort14, geojson, graph_json, graph_ron, table, triangle, twodm, wkt};

/// Points, and segments, holes and regions if there are any, with what was found out
/// about their file.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct PointFile {
    /// What the file holds.
    pub pslg: Pslg,
    /// What was wrong with it and read all the same.
    pub warnings: Vec<ReadWarning>,
    /// Of a table, the columns that were taken.
    pub columns: Option<TakenColumns>,
    /// Which of the attributes of points is their height, upwards, if the file says so: a column of
    /// that name, third coordinates, or nodes with heights.
    pub height_attribute: Option<usize>,
    /// Whether coordinates seem to be longitudes and latitudes, which are taken as they are: by the names of
    /// columns, or in `GeoJSON` without `crs` that lies within 180 and 90 degrees.
    pub degrees: bool,
    /// The number of the first point: 0, or 1 in a file of Triangle's that counts from 1.
    pub first_number: u32,
    /// Of a `.poly` file, the line of each hole.
    pub hole_lines: Vec<u64>,
    /// Of a `.poly` file, the line of each region.
    pub region_lines: Vec<u64>,
}

impl PointFile {
    /// Points with heights, if these are known.
    fn with_heights(points: Pslg, heights: Option<Vec<f64>>) -> Self {
        match heights {
            None => Self { pslg: points, ..Self::default() },
            Some(heights) => Self {
                pslg: Pslg { point_attributes: heights, attributes_per_point: 1, ..points },
                height_attribute: Some(0),
                ..Self::default()
            },
        }
    }

    /// The vertices of a mesh.
    fn of_nodes(data: MeshData) -> Self {
        Self::with_heights(Pslg::from_points(data.mesh.vertices), data.heights)
    }
}

/// Reads points and PSLGs, told which columns to take.
///
/// Unlike [`read_points`], it reads files that depart from their format in a way that
/// leaves no doubt, and tells of it: fields of Triangle's files that are separated by
/// commas, that are missing where they have a default (markers, attributes), that are more
/// than the header says, or that are integers written as `1.0`.
///
/// ```
/// use hexdel_io::{PointFormat, PointReader};
///
/// let table = "id,east,north\n7,1,2\n8,3,4\n";
/// let read = PointReader::new().read_from(table.as_bytes(), PointFormat::Csv, "wells")?;
/// assert_eq!(read.columns.unwrap().to_string(), "x = east (column 2), y = north (column 3)");
///
/// let sloppy = "2, 2, 0, 0\n1, 0, 0\n2, 1, 0\n";
/// let read = PointReader::new().read_from(sloppy.as_bytes(), PointFormat::Node, "a.node")?;
/// assert_eq!((read.pslg.points.len(), read.first_number, read.warnings.len()), (2, 1, 1));
/// # Ok::<(), hexdel_io::ReadError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct PointReader {
    columns: Option<Columns>,
    strict: bool,
}

impl PointReader {
    /// A reader that finds the columns of tables out.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes these columns of a table, if any are given.
    #[must_use]
    pub fn columns(mut self, columns: Option<Columns>) -> Self {
        self.columns = columns;
        self
    }

    /// Reads a file in the format that its extension stands for.
    ///
    /// A `.poly` file that announces 0 points has them in the `.node` file beside it.
    ///
    /// # Errors
    ///
    /// Every [`ReadError`]; file, line and item are named.
    ///
    /// # Complexity
    ///
    /// Linear in the size of the file, `n log n` for polygons; memory in proportion to
    /// what was read, never to what a header claims.
    pub fn read(&self, path: impl AsRef<Path>) -> Result<PointFile, ReadError> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let Some(format) = PointFormat::from_path(path) else {
            return Err(ReadError::UnknownExtension { file: name, known: PointFormat::READABLE });
        };
        let reader = open(path)?;
        if format != PointFormat::Poly {
            return self.read_from(reader, format, &name);
        }
        self.poly(reader, &name, |mends| {
            let nodes = beside(path, "node");
            triangle::read_node(open(&nodes)?, &nodes.display().to_string(), mends)
        })
    }

    /// Reads from anything that can be read, `name` being what errors call it.
    ///
    /// # Errors
    ///
    /// As [`read`](Self::read), and [`ReadError::PointsElsewhere`] for a `.poly` text
    /// without points.
    pub fn read_from(
        &self,
        reader: impl BufRead,
        format: PointFormat,
        name: &str,
    ) -> Result<PointFile, ReadError> {
        let pslg = match format {
            PointFormat::Node => {
                let mut mends = Mends::new(self.strict);
                let (pslg, range) = triangle::read_node(reader, name, &mut mends)?;
                let (warnings, first_number) = (mends.into_warnings(), range.first_number());
                return Ok(PointFile { pslg, warnings, first_number, ..PointFile::default() });
            }
            PointFormat::Poly => return self.poly(reader, name, |_| Err(elsewhere(name))),
            PointFormat::Table | PointFormat::Csv | PointFormat::Tsv => {
                let (read, columns) = table::read_table(reader, name, self.columns.as_ref())?;
                let file = self.features(read, name)?;
                let degrees = columns.as_ref().is_some_and(|columns| columns.degrees);
                return Ok(PointFile { columns, degrees, ..file });
            }
            PointFormat::Wkt => return self.features(wkt::read_wkt(reader, name)?, name),
            PointFormat::GeoJson => {
                return self.features(read_all(geojson::read_geojson, reader, name)?, name);
            }
            PointFormat::Json => {
                return self.features(read_all(graph_json::read_any_json, reader, name)?, name);
            }
            #[cfg(feature = "shapefile")]
            PointFormat::Shapefile => {
                return self.features(read_all(crate::shapefile::read_shapefile, reader, name)?, name);
            }
            PointFormat::CgShop => read_all(graph_json::read_cgshop, reader, name)?,
            PointFormat::Ron => read_all(graph_ron::read_graph_ron, reader, name)?,
            PointFormat::TwoDm => return Ok(PointFile::of_nodes(twodm::read_2dm(reader, name)?)),
            PointFormat::Fort14 => return Ok(PointFile::of_nodes(fort14::read_fort14(reader, name)?)),
        };
        Ok(PointFile { pslg, ..PointFile::default() })
    }

    /// Points and polygons, with heights if all points have one.
    fn features(&self, features: Features, name: &str) -> Result<PointFile, ReadError> {
        let mut mends = Mends::new(false);
        let heights = match features.heights(name) {
            Ok(heights) => heights,
            // Who asks for a PSLG alone does not ask for heights.
            Err(_) if self.strict => None,
            Err(fault) => mends.forgive("heights are ignored", || fault).map(|()| None)?,
        };
        let degrees = features.degrees();
        let file = PointFile::with_heights(features.pslg, heights);
        Ok(PointFile { warnings: mends.into_warnings(), degrees, ..file })
    }

    fn poly(
        &self,
        reader: impl BufRead,
        name: &str,
        beside: impl FnOnce(&mut Mends) -> Result<(Pslg, triangle::PointRange), ReadError>,
    ) -> Result<PointFile, ReadError> {
        let mut mends = Mends::new(self.strict);
        let beside = |line: u64, mends: &mut Mends| {
            beside(mends).map_err(|error| match error {
                ReadError::PointsElsewhere { file, .. } => ReadError::PointsElsewhere { file, line },
                other => other,
            })
        };
        let triangle::Poly { pslg, range, hole_lines, region_lines } =
            triangle::read_poly(reader, name, &mut mends, beside)?;
        let (warnings, first_number) = (mends.into_warnings(), range.first_number());
        Ok(PointFile { pslg, warnings, first_number, hole_lines, region_lines, ..PointFile::default() })
    }
}

/// Reads what takes a text as a whole.
fn read_all<T>(
    read: fn(&Source<'_>) -> Result<T, ReadError>,
    reader: impl BufRead,
    name: &str,
) -> Result<T, ReadError> {
    read(&Source { bytes: &slurp(reader, name)?, file: name })
}

/// Whether a `.poly` file has its points in the `.node` beside it; so too if it cannot
/// be read, which is for others to say.
pub fn points_beside(path: impl AsRef<Path>) -> bool {
    let Ok(reader) = open(path.as_ref()) else {
        return true;
    };
    let mut lines = Lines::new(reader, "", Comments::Anywhere);
    let count =
        lines.next_row().ok().flatten().and_then(|row| row.fields_with_commas().text().map(str::to_owned));
    count.is_none_or(|count| count.parse() == Ok(0_u64))
}

fn elsewhere(name: &str) -> ReadError {
    ReadError::PointsElsewhere { file: name.to_owned(), line: 0 }
}

/// Reads points, and segments, holes and regions if the format has them. What a
/// [`PointReader`] warns of is an error here; but heights that only some points have are left.
///
/// # Errors
///
/// As [`PointReader::read`].
///
/// # Complexity
///
/// As [`PointReader::read`].
pub fn read_points(path: impl AsRef<Path>) -> Result<Pslg, ReadError> {
    strict().read(path).map(|file| file.pslg)
}

/// Reads points from anything that can be read, `name` being what errors call it.
///
/// # Errors
///
/// As [`PointReader::read_from`].
///
/// # Examples
///
/// ```
/// use hexdel_io::{PointFormat, read_points_from};
///
/// let pslg = read_points_from("x,y\n0.5,1\n".as_bytes(), PointFormat::Table, "inline")?;
/// assert_eq!(pslg.points[0].x, 0.5);
///
/// let text = "POLYGON ((0 0, 4 0, 0 4, 0 0), (1 1, 2 1, 1 2, 1 1))";
/// let pslg = read_points_from(text.as_bytes(), PointFormat::Wkt, "inline")?;
/// assert_eq!((pslg.segments.len(), pslg.polygons.len()), (6, 1));
///
/// let error = read_points_from("1 2\n0 0.5 NaN\n".as_bytes(), PointFormat::Node, "a.node");
/// assert_eq!(
///     error.unwrap_err().to_string(),
///     "a.node:2: coordinate NaN of point 0 is not finite",
/// );
/// # Ok::<(), hexdel_io::ReadError>(())
/// ```
pub fn read_points_from(reader: impl BufRead, format: PointFormat, name: &str) -> Result<Pslg, ReadError> {
    strict().read_from(reader, format, name).map(|file| file.pslg)
}

fn strict() -> PointReader {
    PointReader { strict: true, ..PointReader::default() }
}
