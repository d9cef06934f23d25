//! The model's number: figures of the same number can be compared.
//!
//! Summaries, saved jobs and exported programs carry it, so that opening an old one can say
//! that its figures differ from today's.

/// Number of the model that figures are computed with.
///
/// It is raised by one when the physics changes such that jobs in general give other figures; a
/// corrected robot, material or rounding does not raise it. What changed is in CHANGELOG,
/// "Numbers".
///
/// - 1: the thesis's. The axial force has one sign, and the whole force acts at any speed and from
///   the first touch on; a round nose takes its radial depth at the full diameter.
/// - 2: the axial force has the sign of the helix's hand, the chip follows the speed, the force
///   rises along the run-in, and the radial depth counts from the local radius.
pub const MODEL: u32 = 2;

/// The line in the header of an exported program that says what it was computed with.
pub fn stamp(fingerprint: &str) -> String {
    format!("Armill {}, model {MODEL}, run {fingerprint}", env!("CARGO_PKG_VERSION"))
}

/// The model that a line names if it holds a [`stamp`]; before model 2, stamps named none.
pub fn stamped(line: &str) -> Option<u32> {
    let (_, stamp) = line.split_once("Armill ")?;
    let (_version, rest) = stamp.split_once(", ").filter(|(version, _)| !version.contains(' '))?;
    match rest.strip_prefix("model ") {
        Some(rest) => rest.split_once(", run ")?.0.parse().ok(),
        None => rest.starts_with("run ").then_some(1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stamp_names_its_model_in_any_comment() {
        let stamp = stamp("13c61f3ffdf4c0c743065903d8748f3f");
        for comment in [format!("({stamp})"), format!("# {stamp}"), format!("$$ {stamp}"), stamp.clone()] {
            assert_eq!(stamped(&comment), Some(MODEL), "{comment}");
        }
        for (line, model) in [
            ("(Armill 0.1.0, run 13c61f3f)", Some(1)),
            ("N10 (Armill 0.1.0, model 1, run 13c61f3f)", Some(1)),
            ("; Armill 2.3.4-beta, model 12, run 13c61f3f", Some(12)),
            ("(made with Armill 0.1.0)", None),
            ("(Armill 0.1.0, model none, run 13c61f3f)", None),
            ("(Armill is run here, run again)", None),
            ("G1 X600", None),
        ] {
            assert_eq!(stamped(line), model, "{line}");
        }
    }
}
