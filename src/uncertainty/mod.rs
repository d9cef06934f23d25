//! How sure: the spread of the inputs sent through the model (JCGM 101:2008, propagation of
//! distributions by a Monte Carlo method).
//!
//! The commands found for the nominal model are kept and the plant is drawn: joint stiffness, the
//! cutting coefficients and the frequency of the filter. What stays on the part is then a band, not
//! a number. Left out: friction and lost motion in the gears, the arm's own calibration, heat, wear,
//! the arm's own frequency.

pub mod draw;
pub mod place;
pub mod quantile;
mod band;
mod chosen;
mod column;
mod largest;
mod outcomes;

pub use band::{BreakEven, ErrorBand, Measure, NominalErrors, Share, band};
pub use draw::Draw;
pub use largest::{largest, largest_errors};
pub use quantile::Quantiles;
