//! A drawn plant for a full rerun.

use armill::cutting::{Coefficients, Cut};
use armill::uncertainty::Draw;

/// A cut whose coefficients have the factors of a draw.
pub(crate) fn drawn_cut(cut: &Cut, draw: &Draw) -> Cut {
    let k = cut.coefficients;
    let [t, r, a] = draw.force;
    let coefficients = Coefficients {
        ktc: k.ktc * t,
        kte: k.kte * t,
        krc: k.krc * r,
        kre: k.kre * r,
        kac: k.kac * a,
        kae: k.kae * a,
    };
    Cut { coefficients, ..*cut }
}
