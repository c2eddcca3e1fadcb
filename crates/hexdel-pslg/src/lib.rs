//! Triangle meshes of planar straight-line graphs.
mod areas;
mod carve;
mod embed;
mod error;
mod field;
mod fit;
mod geometry;
mod hull;
mod mesher;
mod net;
mod options;
mod output;
mod pairs;

mod repair;
mod result;
mod sectors;
mod sizing;
mod validate;
pub use error::{Feature, PslgError, ValidateError};
pub use mesher::mesh;
pub use options::{Extent, Options};
pub use repair::{Repair, RepairReport, repair};
pub use result::{Exception, PslgMesh, Reason, SegmentEdge};
pub use validate::{Divided, Validated, validate, violations};
