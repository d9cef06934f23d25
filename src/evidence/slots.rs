//! Cutting forces that a dynamometer measured in ten slots.
//!
//! No drawing of the dynamometer's axes is published. Of the 48 ways to turn and mirror them, the force on the part with x to
//! the left of the feed, y along it and z down agrees best, to 14 % on average; the next one misses by 40 %. The force on
//! the tool in {T} is then (-y, -x, z).

use crate::cutting::{Coefficients, Cut, Engagement, Hand};
use crate::evidence::{Evidence, EvidenceCurve, EvidenceRow};
use crate::units::{DEG, MM};
use nalgebra::Vector3;

/// A slot as measured: axial depth [mm], means of the dynamometer's x, y and z [N], 99th percentile of the resultant [N].
pub type Slot = [f64; 5];

/// Slots by a bull nose with a corner of 3 mm.
pub const BULL_NOSE: [Slot; 5] = [
    [1.0, -71.7, 26.4, 46.0, 163.0],
    [2.0, -136.5, 61.6, 57.4, 302.0],
    [3.0, -198.2, 95.0, 47.5, 427.0],
    [4.0, -254.9, 104.9, 28.4, 522.0],
    [5.0, -311.8, 120.3, 11.1, 635.0],
];
/// Slots by a ball nose.
pub const BALL: [Slot; 5] = [
    [1.0, -92.8, 25.8, 90.2, 225.0],
    [2.0, -169.6, 55.6, 136.9, 387.0],
    [3.0, -243.7, 96.6, 183.1, 529.0],
    [4.0, -316.1, 143.8, 215.9, 675.0],
    [5.0, -385.6, 195.5, 235.5, 802.0],
];
/// The slots, with the corner radius [mm] of their tool.
pub const SLOTS: [(&str, f64, [Slot; 5]); 2] = [("Bull nose", 3.0, BULL_NOSE), ("Ball nose", 8.0, BALL)];
/// Feed per tooth [m].
pub const FEED: f64 = 1e-4;

/// The cut of a slot, with the coefficients of those who measured.
pub fn cut(corner_mm: f64, depth_mm: f64) -> Cut {
    Cut {
        diameter: 0.016,
        flutes: 2,
        helix: 25.0 * DEG,
        hand: Hand::Right,
        corner_radius: corner_mm * MM,
        runout: 0.0,
        coefficients: Coefficients::of_table([796.1, 168.8, 222.0, 27.7, 30.8, 1.4]),
        axial_depth: depth_mm * MM,
        engagement: Engagement::Slot,
    }
}

/// The mean force of a slot on the tool in {T} [N].
pub fn measured(slot: &Slot) -> Vector3<f64> {
    let [_, x, y, z, _] = *slot;
    Vector3::new(-y, -x, z)
}

/// Compares the mean forces and the peaks of the ten slots with the force model.
pub fn slots() -> Evidence {
    let mut rows = Vec::new();
    let mut curves = Vec::new();
    let mut misses = Vec::new();
    let keys = [["bull", "bull-predicted"], ["ball", "ball-predicted"]];
    let labels =
        [["Bull nose, measured", "Bull nose, predicted"], ["Ball nose, measured", "Ball nose, predicted"]];
    for (tool, (name, corner, slots)) in SLOTS.iter().enumerate() {
        let mut lengths = [vec![], vec![]];
        for slot in slots {
            let cut = cut(*corner, slot[0]);
            let (measured, predicted) = (measured(slot), cut.mean_force().at(FEED));
            let miss = 100.0 * (predicted - measured).norm() / measured.norm();
            let peak = cut.peak_force(FEED);
            rows.push(EvidenceRow {
                name: format!("{name}, {} mm deep", slot[0]),
                values: vec![
                    measured.norm(),
                    predicted.norm(),
                    miss,
                    slot[4],
                    peak,
                    100.0 * (peak / slot[4] - 1.0),
                ],
            });
            misses.push((slot[0], miss, 100.0 * (peak / slot[4] - 1.0).abs()));
            lengths[0].push(measured.norm());
            lengths[1].push(predicted.norm());
        }
        for (own, values) in lengths.into_iter().enumerate() {
            curves.push(EvidenceCurve { key: keys[tool][own], label: labels[tool][own], values });
        }
    }
    let worst = |shallow: bool| {
        let of = misses.iter().filter(|(depth, ..)| (*depth < 2.0) == shallow).map(|(_, miss, _)| *miss);
        of.fold(0.0, f64::max)
    };
    let peak = misses.iter().map(|(.., peak)| *peak).fold(0.0, f64::max);
    let sentence = format!(
        "Ten slots: the mean force, as a vector, is missed by {:.0} % at most at 2 mm depth and more, and by {:.0} % at 1 mm, where \
         perhaps the edge at the tip rubs. The largest force of a revolution is within {peak:.0} % of the measured 99th percentile.",
        worst(false),
        worst(true)
    );
    Evidence {
        key: "evidence-slots",
        title: "Cutting forces in slots by a bull nose and a ball nose",
        sentence,
        rests_on: "Coefficients as the authors of the measurements state them; 16 mm, two flutes, helix 25°, 800 rpm, 0.1 mm per \
                   tooth. For the ball nose these conditions are taken over from the bull nose. The axes of \
                   the dynamometer are not published: they are those that agree best.",
        source: "github.com/leekunhwee/ForceCalculation, figures only; no licence is stated",
        heads: vec![
            "Slot",
            "Mean measured, N",
            "Mean predicted, N",
            "Miss (vector), %",
            "99th percentile measured, N",
            "Largest predicted, N",
            "Off, %",
        ],
        rows,
        drawn: "Length of the mean force on the tool.",
        over: ("Axial depth", "mm"),
        shows: ("Mean force", "N"),
        at: BALL.map(|slot| slot[0]).to_vec(),
        curves,
    }
}
