//! Speed, zone, tool and work object of a motion.

use super::Controller;
use super::module::{Value, frame, numbers};
use crate::controllers::scan::Scan;
use crate::controllers::{Blend, Frame, identity, within};

const SPEEDS: [u32; 25] = [
    5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1500, 2000, 2500, 3000,
    4000, 5000, 6000, 7000,
];

/// Name and corner zone of the tool point [mm] of the zones that the controller has.
const ZONES: [(&str, f64); 14] = [
    ("z0", 0.3),
    ("z1", 1.0),
    ("z5", 5.0),
    ("z10", 10.0),
    ("z15", 15.0),
    ("z20", 20.0),
    ("z30", 30.0),
    ("z40", 40.0),
    ("z50", 50.0),
    ("z60", 60.0),
    ("z80", 80.0),
    ("z100", 100.0),
    ("z150", 150.0),
    ("z200", 200.0),
];

impl Controller<'_> {
    /// The speed of the tool point [mm/s].
    pub(super) fn speed(&self, scan: &mut Scan) -> Result<f64, String> {
        let mut known = scan.clone();
        if let Ok(word) = known.word()
            && let Some(number) =
                word.to_ascii_lowercase().strip_prefix('v').and_then(|rest| rest.parse().ok())
            && SPEEDS.contains(&number)
        {
            *scan = known;
            return Ok(f64::from(number));
        }
        match numbers::<4>(&self.value_of(scan, "speeddata")?) {
            Some(speed) if speed.iter().all(|part| *part > 0.0) => Ok(speed[0]),
            _ => scan.fail("a speed that is not above zero"),
        }
    }

    pub(super) fn zone(&self, scan: &mut Scan) -> Result<Blend, String> {
        if scan.take("fine") {
            return Ok(Blend::Stop);
        }
        if let Some((_, size)) = ZONES.iter().find(|(name, _)| scan.take(name)) {
            return Ok(Blend::Distance(*size));
        }
        let Value::List(parts) = self.value_of(scan, "zonedata")? else { return scan.fail("no zone") };
        match (&parts[0], &parts[1]) {
            (Value::Flag(true), _) => Ok(Blend::Stop),
            (_, Value::Number(size)) if *size >= 0.0 => Ok(Blend::Distance(*size)),
            _ => scan.fail("a zone below zero"),
        }
    }

    /// The tool and its mass [kg]; tool0 has none.
    pub(super) fn tool(&self, scan: &mut Scan) -> Result<(Frame, Option<f64>), String> {
        if scan.take("tool0") {
            return Ok((identity(), None));
        }
        let from = scan.clone();
        let value = self.value_of(scan, "tooldata")?;
        let Value::List(parts) = &value else { return from.fail("no tool") };
        let (Some(tool), Value::List(load)) = (frame(&parts[1]), &parts[2]) else {
            return from.fail("no tool");
        };
        match (&parts[0], &load[0], numbers::<3>(&load[1])) {
            (Value::Flag(true), Value::Number(mass), Some(centre)) if *mass > 0.0 && centre != [0.0; 3] => {
                Ok((tool, Some(*mass)))
            }
            _ => from.fail("the robot does not hold this tool, or its load is zero"),
        }
    }

    pub(super) fn base(&self, scan: &mut Scan) -> Result<Frame, String> {
        if scan.take("wobj0") {
            return Ok(identity());
        }
        let from = scan.clone();
        let Value::List(parts) = self.value_of(scan, "wobjdata")? else { return from.fail("no work object") };
        let is_fixed = parts[..3] == [Value::Flag(false), Value::Flag(true), Value::Text(String::new())];
        match (frame(&parts[3]), frame(&parts[4])) {
            (Some(user), Some(object)) if is_fixed => Ok(within(user, object)),
            _ => from.fail("the work object is not fixed"),
        }
    }
}
