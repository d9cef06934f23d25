//! What a programmer may choose without touching the part: climb or conventional, the direction of travel,
//! the start point of a closed path, the turn of the tool about its axis. Which errs least?

use crate::at_once::at_once;
use crate::job::{Engaged, Job, Path, PathKind, SpinMode};
use crate::math::within_half_turn;
use crate::report::Remedy;
use crate::study::Outcome;
use serde::Serialize;
use serde_json::{Value, json};

/// Step of the turns tried [deg], and their number.
const TURN_DEG: f64 = 30.0;
const TURNS: usize = 12;

/// What one choice comes to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChoiceRow {
    /// What is chosen: `as-is`, `direction`, `milling`, `both` (direction and milling: the same wall the other
    /// way round), `start` or `turn`.
    pub choice: &'static str,
    /// The change in words, and as a merge patch of the job.
    #[serde(flatten)]
    pub change: Remedy,
    /// What the run says.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// A job to be run with every choice that it leaves open; the first is the job as it is.
#[derive(Debug)]
pub struct EveryChoice {
    job: Job,
    choices: Vec<(&'static str, Remedy)>,
}

impl EveryChoice {
    /// Of a job. A program keeps its direction and its start, and an engagement that follows a stock its own:
    /// what remains of it is the turn of the tool.
    pub fn new(job: &Job) -> Self {
        let mut choices = vec![("as-is", change("As it is", json!({})))];
        choices.extend(ways(job));
        choices.extend(starts(&job.path).into_iter().map(|change| ("start", change)));
        choices.extend(turns(job).into_iter().map(|change| ("turn", change)));
        Self { job: job.clone(), choices }
    }

    /// Number of choices.
    pub fn count(&self) -> usize {
        self.choices.len()
    }

    /// What one of them comes to.
    pub fn row(&self, index: usize) -> ChoiceRow {
        let (choice, change) = &self.choices[index];
        let outcome = Outcome::of_varied(change.applied(&self.job));
        ChoiceRow { choice, change: change.clone(), outcome }
    }
}

/// All rows of [`EveryChoice`].
pub fn choices(job: &Job) -> Vec<ChoiceRow> {
    let every = EveryChoice::new(job);
    at_once(every.count(), |index| every.row(index))
}

fn change(label: impl Into<String>, patch: Value) -> Remedy {
    Remedy { label: label.into(), patch }
}

/// The other direction of travel and the other side of the material.
fn ways(job: &Job) -> Vec<(&'static str, Remedy)> {
    let other = match job.cutting.engagement {
        Some(Engaged::Climb) => Some("conventional"),
        Some(Engaged::Conventional) => Some("climb"),
        _ => None,
    };
    let mut ways = Vec::new();
    let reversed = reversed(&job.path);
    let milling = |word: &str| json!({ "engagement": word });
    if let (Some(path), Some(word)) = (&reversed, other) {
        let patch = json!({ "path": path, "cutting": milling(word) });
        ways.push(("both", change(format!("The same wall the other way round: {word}"), patch)));
    }
    if let Some(path) = reversed {
        ways.push(("direction", change("Travel the other way", json!({ "path": path }))));
    }
    if let Some(word) = other {
        let label = format!("The material on the other side: {word}");
        ways.push(("milling", change(label, json!({ "cutting": milling(word) }))));
    }
    ways
}

/// What of a shape's keys changes for the other direction, as a merge patch; `None` for a program, and for
/// rounded rectangles, which have none.
fn reversed(path: &Path) -> Option<Value> {
    match path.kind {
        PathKind::Circle => Some(json!({ "normal": normal(path).map(|part| 0.0 - part) })),
        PathKind::Arc => {
            let (start, sweep) = (path.start_deg?, path.sweep_deg?);
            Some(json!({ "start_deg": within_turn(start + sweep), "sweep_deg": -sweep }))
        }
        PathKind::Line => Some(json!({ "from_mm": path.to_mm, "to_mm": path.from_mm })),
        PathKind::Rectangle | PathKind::Polyline => {
            let mut points = corners(path)?;
            points.reverse();
            Some(polyline(&points))
        }
        PathKind::Csv | PathKind::Gcode | PathKind::Apt => None,
    }
}

/// Other places to start a closed shape at: after a quarter, half and three quarters of it.
fn starts(path: &Path) -> Vec<Remedy> {
    let quarters = [1, 2, 3];
    match path.kind {
        PathKind::Circle => {
            let start = |quarter: usize| {
                let degrees = 90.0 * quarter as f64;
                let patch = json!({ "path": { "kind": "arc", "start_deg": degrees, "sweep_deg": 360 } });
                change(format!("Start at {degrees} deg"), patch)
            };
            quarters.map(start).into()
        }
        PathKind::Rectangle | PathKind::Polyline => {
            let Some(points) = corners(path).filter(|points| points.len() > 3) else { return vec![] };
            let ([first, .., last], sides) = (&points[..], points.len() - 1) else { return vec![] };
            if first != last {
                return vec![];
            }
            let mut at: Vec<usize> = quarters.iter().map(|quarter| quarter * sides / 4).collect();
            at.dedup();
            at.retain(|corner| *corner > 0);
            let start = |corner: usize| {
                let turned: Vec<[f64; 3]> = (0..=sides).map(|k| points[(corner + k) % sides]).collect();
                let [x, y, z] = points[corner];
                change(format!("Start at X {x} Y {y} Z {z}"), json!({ "path": polyline(&turned) }))
            };
            at.into_iter().map(start).collect()
        }
        _ => vec![],
    }
}

/// Other turns of the tool about its axis, for a spin that is fixed.
fn turns(job: &Job) -> Vec<Remedy> {
    if job.spin.mode != SpinMode::Fixed {
        return vec![];
    }
    let turn = |k: usize| {
        let angle = within_half_turn(job.spin.angle_deg + TURN_DEG * k as f64);
        change(format!("Tool turned to {angle} deg"), json!({ "spin": { "angle_deg": angle } }))
    };
    (1..TURNS).map(turn).collect()
}

/// The points of a polyline, or of a rectangle with sharp corners.
fn corners(path: &Path) -> Option<Vec<[f64; 3]>> {
    if path.kind == PathKind::Polyline {
        return path.points_mm.clone();
    }
    if path.corner_radius_mm.unwrap_or(0.0) > 0.0 {
        return None;
    }
    let ([x, y, z], half_x, half_y) =
        (path.center_mm.unwrap_or_default(), path.width_mm? / 2.0, path.height_mm? / 2.0);
    // As the shape runs: from the lower left corner, counter-clockwise.
    let corner = |(right, up): (f64, f64)| [x + right * half_x, y + up * half_y, z];
    Some([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)].map(corner).into())
}

/// A patch that makes any shape a polyline.
fn polyline(points: &[[f64; 3]]) -> Value {
    let gone = Value::Null;
    json!({
        "kind": "polyline", "points_mm": points,
        "center_mm": gone, "width_mm": gone, "height_mm": gone, "corner_radius_mm": gone,
    })
}

fn normal(path: &Path) -> [f64; 3] {
    path.normal.unwrap_or([0.0, 0.0, 1.0])
}

fn within_turn(angle_deg: f64) -> f64 {
    angle_deg % 360.0
}
