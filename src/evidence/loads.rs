//! Displacements of an arm that was loaded in many postures.

use crate::error::Error;
use crate::evidence::{Evidence, EvidenceCurve, EvidenceRow};
use crate::identify::stiffness::Residual;
use crate::identify::{Convention, measurement, stiffness};
use crate::job::Job;
use crate::setup;
use crate::units::MM;

/// Compares each measured displacement with what the springs of the joints say that are fitted to all *other* rows.
/// `job` has the robot, `text` the rows as the pendant counts them.
///
/// # Errors
/// Those of [`measurement::read`] and [`stiffness::fit`].
pub fn loads(job: &Job, text: &str) -> Result<Evidence, Error> {
    let robot = setup::robot(job)?;
    let measured = measurement::read(text, Convention::CoupledJ3)?;
    let fit = stiffness::fit(&robot, &measured.rows)?;
    let mut rows: Vec<&Residual> = fit.rows.iter().collect();
    rows.sort_by(|a, b| a.measured.total_cmp(&b.measured));
    let share = |row: &Residual| 100.0 * row.left_out / row.measured;
    let (_, mean) = fit.relative();
    let worst = rows.iter().copied().max_by(|a, b| a.left_out.total_cmp(&b.left_out));
    let within = |percent: f64| rows.iter().filter(|row| share(row) <= percent).count();
    let ends =
        rows.first().zip(rows.last()).map_or([0.0; 2], |(first, last)| [first.measured, last.measured]);
    let worst = worst.map_or(String::new(), |row| {
        format!(" Worst is line {}: {:.2} mm of {:.2} mm.", row.line, row.left_out / MM, row.measured / MM)
    });
    let sentence = format!(
        "{} postures, {:.1} to {:.1} mm, each predicted from the others: the miss is {:.0} % of the displacement on average, 20 % at \
         most in {} of them.{worst}",
        rows.len(),
        ends[0] / MM,
        ends[1] / MM,
        100.0 * mean,
        within(20.0)
    );
    let values = |of: fn(&Residual) -> f64| rows.iter().map(|row| of(row) / MM).collect();
    let table = rows.iter().map(|row| EvidenceRow {
        name: format!("Line {}", row.line),
        values: vec![row.measured / MM, row.predicted / MM, row.left_out / MM, share(row)],
    });
    Ok(Evidence {
        key: "evidence-loads",
        title: "Displacement of a loaded FANUC R-2000iC",
        sentence,
        rests_on: "Springs in the six joints, fitted to all rows but the one that is predicted. A cable pulled at the tip; links, \
                   bearings and gears are all taken for the joints' springs.",
        source: "github.com/longton2001-pixel/breakthrough-surge-suppression-in-high-speed-robotic-drilling, MIT License",
        heads: vec!["Posture", "Measured, mm", "Predicted, mm", "Miss, mm", "Miss, %"],
        rows: table.collect(),
        drawn: "Lengths of the displacements, the smallest first; the miss is the length of the difference.",
        over: ("Posture, by displacement", ""),
        shows: ("Displacement", "mm"),
        at: (1..=rows.len()).map(|row| row as f64).collect(),
        curves: vec![
            EvidenceCurve { key: "measured", label: "Measured", values: values(|row| row.measured) },
            EvidenceCurve { key: "predicted", label: "Predicted", values: values(|row| row.predicted) },
            EvidenceCurve { key: "miss", label: "Miss (as a vector)", values: values(|row| row.left_out) },
        ],
    })
}
