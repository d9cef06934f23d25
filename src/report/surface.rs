//! The surface that is left: figures, places in words, columns, and the part itself.

use crate::deviation::Sources;
use crate::error::Error;
use crate::motion::TimingLaw;
use crate::report::columns::Series;
use crate::report::{Report, millimetres};
use crate::surface::deviation_map::DeviationMap;
use crate::surface::part::{PartCut, PartMap, cell};
use crate::surface::section::PartSection;
use crate::surface::{Excesses, SurfaceKind, SurfacePlace};
use crate::units::MM;
use serde::Serialize;
use std::borrow::Cow;
use std::sync::Arc;

/// The surface that is left, by the static deflection of the arm at the instant the edge passes [mm].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SurfaceFigures {
    /// Largest excess or lack of material with the desired path commanded; absent if no surface is left.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst_before_mm: Option<f64>,
    /// The same with the compensated path commanded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst_after_mm: Option<f64>,
    /// 95 % of the drawn plants leave less than this with the desired path commanded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub before_p95_mm: Option<f64>,
    /// The same with the compensated path commanded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub after_p95_mm: Option<f64>,
    /// The worst places, one for each line of the program.
    pub worst: Vec<SurfaceSpot>,
}

/// A place of the surface [mm].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SurfaceSpot {
    /// `wall`, `floor`, or `corner` for what the tool's corner or ball leaves between them.
    pub kind: &'static str,
    /// The sample at which it is cut.
    pub sample: usize,
    /// The line of the program, if it has lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// Arc length of the tool.
    pub at_arc_length_mm: f64,
    /// The point of the nominal surface in the workpiece frame.
    pub place_mm: [f64; 3],
    /// Its height above the tip.
    pub height_mm: f64,
    /// Material too much, below 0 too little, with the desired path commanded.
    pub before_mm: f64,
    /// The same with the compensated path commanded.
    pub after_mm: f64,
    /// The place in words.
    pub sentence: String,
}

/// Which part to simulate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PartKind {
    /// With the desired path commanded.
    Before,
    /// With the compensated path commanded.
    After,
    /// With the tool where it should be.
    Nominal,
}

impl PartKind {
    /// The part named `before`, `after` or `nominal`.
    ///
    /// # Errors
    /// [`Error::Invalid`] for another name.
    pub fn named(name: &str) -> Result<Self, Error> {
        match name {
            "before" => Ok(Self::Before),
            "after" => Ok(Self::After),
            "nominal" => Ok(Self::Nominal),
            _ => Err(Error::invalid("part", format!("\"{name}\""), "before, after or nominal")),
        }
    }
}

impl Report {
    /// Figures of the surface that is left; `None` without a stock.
    pub(super) fn surface_figures(&self) -> Option<SurfaceFigures> {
        let surface = self.surface.as_ref()?;
        let any = surface.after.is_some();
        Some(SurfaceFigures {
            worst_before_mm: surface.before.map(|place| place.before.abs() / MM),
            worst_after_mm: surface.after.map(|place| place.after.abs() / MM),
            before_p95_mm: any.then_some(surface.band_before.p95 / MM),
            after_p95_mm: any.then_some(surface.band.p95 / MM),
            worst: surface.worst.iter().map(spot).collect(),
        })
    }

    /// The columns of the surface that is left: the largest excess at each sample, 0 where none
    /// is left.
    pub(super) fn surface_series<'a>(&'a self, timing: Arc<Cow<'a, TimingLaw>>) -> Vec<Series<'a>> {
        let (Some(surface), Some(contacts)) = (&self.surface, &self.setup().contacts) else {
            return Vec::new();
        };
        let runs = [
            ("surface_before_mm", "Surface before, too much material", &self.before),
            ("surface_after_mm", "Surface after, too much material", &self.after),
        ];
        let series = runs.map(|(key, label, run)| {
            let timing = timing.clone();
            Series::new(key, label, "mm", self.samples(), move |samples| {
                let excesses = Excesses::new(&self.plan, &surface.left, contacts);
                samples.map(|k| excesses.worst(&timing, k, run).unwrap_or(0.0) / MM).collect()
            })
        });
        series.into()
    }

    /// The simulated part as a map of heights `cell` [m] apart; if not given, as far apart as the size of
    /// the stock suggests.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the engagement does not follow a stock, or for a cell that is no length.
    pub fn part(&self, kind: PartKind, distance: Option<f64>) -> Result<PartMap, Error> {
        let Some(blank) = &self.setup().blank else {
            return Err(Error::invalid("part", "asked for", "a job whose engagement follows a stock"));
        };
        if let Some(distance) = distance.filter(|distance| !(distance.is_finite() && *distance > 0.0)) {
            return Err(Error::invalid("cell_mm", distance / MM, "more than 0 mm"));
        }
        let cut = match kind {
            PartKind::Before => PartCut::Actual(&self.before),
            PartKind::After => PartCut::Actual(&self.after),
            PartKind::Nominal => PartCut::Nominal,
        };
        Ok(PartMap::of(&self.plan, blank, cut, cell(blank, distance)))
    }

    /// The simulated part as a binary STL file in millimetres, in the workpiece frame; its heights are `cell` [m]
    /// apart.
    ///
    /// # Errors
    /// As for [`Report::part`].
    pub fn simulated_part(&self, kind: PartKind, cell: Option<f64>) -> Result<Vec<u8>, Error> {
        Ok(self.part(kind, cell)?.stl())
    }

    /// The deviation all over the part, on a map of at most about `most` heights.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the engagement does not follow a stock, or for less than four heights.
    pub fn deviation_map(&self, most: usize) -> Result<DeviationMap, Error> {
        let (Some(surface), Some(contacts), Some(blank)) =
            (&self.surface, &self.setup().contacts, &self.setup().blank)
        else {
            return Err(Error::invalid("part", "asked for", "a job whose engagement follows a stock"));
        };
        if most < 4 {
            return Err(Error::invalid("most", most, "at least 4"));
        }
        let timing = self.plan.timing(Sources::ALL);
        let excesses = Excesses::new(&self.plan, &surface.left, contacts);
        let [from, to] = blank.solid.outline.bounds();
        let distance = ((to.x - from.x) * (to.y - from.y) / most as f64).sqrt();
        let cell = cell(blank, Some(distance));
        let runs = [self.before.as_ref(), self.after.as_ref()];
        Ok(DeviationMap::of(&self.plan, blank, (&excesses, &timing), runs, cell))
    }

    /// A section through the part of [`Report::deviation_map`] across the feed at a sample; one past the end stands for
    /// the last.
    pub fn part_section(&self, map: &DeviationMap, sample: usize) -> PartSection {
        let timing = self.plan.timing(Sources::ALL);
        PartSection::of(&self.plan, map, &timing, sample.min(self.samples() - 1))
    }
}

/// A place of the surface with its sentence.
fn spot(place: &SurfacePlace) -> SurfaceSpot {
    let (kind, ..) = words(place.kind);
    SurfaceSpot {
        kind,
        sample: place.sample,
        line: (place.line > 0).then_some(place.line),
        at_arc_length_mm: place.arc_length / MM,
        place_mm: (place.point / MM).into(),
        height_mm: place.height / MM,
        before_mm: place.before / MM,
        after_mm: place.after / MM,
        sentence: sentence(place),
    }
}

/// Slug, name, and what too much and too little of it is.
fn words(kind: SurfaceKind) -> (&'static str, &'static str, [&'static str; 2]) {
    match kind {
        SurfaceKind::Wall => ("wall", "Wall", ["too thick", "too thin"]),
        SurfaceKind::Floor => ("floor", "Floor", ["too high", "too low"]),
        SurfaceKind::Corner => ("corner", "Corner", ["too full", "too hollow"]),
    }
}

/// As in: Wall at line 212: 0.14 mm too thick, 0.02 mm after compensation.
fn sentence(place: &SurfacePlace) -> String {
    let (_, name, sides) = words(place.kind);
    let side = |excess: f64| sides[usize::from(excess < 0.0)];
    let at = match place.line {
        0 => format!("{} mm along the path", millimetres(place.arc_length)),
        line => format!("line {line}"),
    };
    let (before, after) = (millimetres(place.before.abs()), millimetres(place.after.abs()));
    let turned = match place.before * place.after < 0.0 {
        true => format!(" {}", side(place.after)),
        false => String::new(),
    };
    format!("{name} at {at}: {before} mm {}, {after} mm{turned} after compensation", side(place.before))
}
