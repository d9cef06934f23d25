//! A feed that holds the mean force: slower where the tool meets much material, faster where it meets
//! little, within limits.
//!
//! The mean force is linear in the feed per tooth c: F = F_c c + F_e (eq. 4.7), so that it has the
//! size F at the root of |F_c|^2 c^2 + 2 F_c . F_e c + |F_e|^2 - F^2 = 0. The feed is constant along a
//! piece of the path, the lowest that any place in it asks for. Between two stations F_c and F_e are
//! linear, and a length is convex along a line: at the same feed the force is largest at one of the
//! two. So no place in a piece has more than the force to hold, unless the lower limit of the feed
//! gives it more.

use crate::cutting::{LinearForce, Loading};
use crate::motion::course;
use crate::path::{Move, MovePace, Path, Piece};
use crate::stock::Contacts;

/// The feed changes from piece to piece by more than this share.
const STEP: f64 = 0.05;
/// Least length of a piece [m], unless its move is shorter. Next to shorter ones [`course::corners`]
/// judges a corner by its points, and controllers plan only a few points ahead.
const LEAST: f64 = course::LONGEST / 4.0;

/// The rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstantForceFeed {
    /// The mean force to hold [N].
    pub force: f64,
    /// Lowest feed, as a share of the programmed one.
    pub least: f64,
    /// Highest feed, as a share of the programmed one.
    pub most: f64,
}

/// The cut along a path in a stock.
#[derive(Debug, Clone, Copy)]
pub struct CutAlong<'a> {
    /// The path.
    pub path: &'a Path,
    /// What the tool meets along it.
    pub contacts: &'a Contacts,
    /// Mean force in {T} at each station.
    pub forces: &'a [LinearForce],
    /// What sets the feed per tooth.
    pub loading: &'a Loading,
}

/// A part of a move between two stations, and the highest feed there [m/s].
struct FeedCell {
    index: usize,
    from: f64,
    to: f64,
    feed: f64,
}

impl LinearForce {
    /// The largest feed per tooth [m] at which the force is no more than `force` [N]: infinite where
    /// none is larger, zero where it is larger even without a chip.
    pub fn chip_at(&self, force: f64) -> f64 {
        let square = self.cutting.norm_squared();
        let half = self.cutting.dot(&self.edge);
        let rest = self.edge.norm_squared() - force * force;
        if square == 0.0 {
            return if rest > 0.0 { 0.0 } else { f64::INFINITY };
        }
        let root = (half * half - square * rest).max(0.0).sqrt();
        // Of the two forms of the root, the one that does not cancel.
        let chip = if half > 0.0 { -rest / (root + half) } else { (root - half) / square };
        chip.max(0.0)
    }
}

impl CutAlong<'_> {
    /// The median of the mean force [N] at the programmed feed over the length on which the tool meets
    /// material; `None` if it meets none.
    pub fn median_force(&self) -> Option<f64> {
        let mut weighed = Vec::new();
        for ((index, station), contact) in self.contacts.each() {
            let step = &self.path.moves()[index];
            let Some(feed) = self.loading.programmed(step).filter(|_| !contact.is_air()) else { continue };
            let force = self.forces[station].at(self.loading.chip.at(feed, step.spindle)).norm();
            weighed.push((force, self.contacts.share(index, station)));
        }
        weighed.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let half = weighed.iter().map(|(_, length)| length).sum::<f64>() / 2.0;
        let mut length = 0.0;
        let reaches = |(_, share): &&(f64, f64)| {
            length += share;
            length >= half
        };
        weighed.iter().find(reaches).map(|(force, _)| *force)
    }
}

impl ConstantForceFeed {
    /// The pieces in which a path is cut at a feed that holds the force; rapid moves stay as they are.
    /// `None` if the feed per tooth is stated and does not follow from the feed.
    pub fn pieces(&self, along: &CutAlong) -> Option<Vec<Piece>> {
        let moves = along.path.moves();
        let (mut pieces, mut run) = (Vec::with_capacity(moves.len()), FeedRun::default());
        for (index, step) in moves.iter().enumerate() {
            let Some(programmed) = along.loading.programmed(step) else {
                pieces.extend(std::mem::take(&mut run).pieces(along));
                pieces.push(Piece { index, from: 0.0, to: step.segment.length(), pace: step.pace });
                continue;
            };
            for cell in self.cells(along, index, programmed)? {
                if !run.goes_on(&cell, moves) {
                    pieces.extend(std::mem::take(&mut run).pieces(along));
                }
                run.push(cell);
            }
        }
        pieces.extend(run.pieces(along));
        Some(pieces)
    }

    /// The cells of a move.
    fn cells(&self, along: &CutAlong, index: usize, programmed: f64) -> Option<Vec<FeedCell>> {
        let CutAlong { path, contacts, forces, loading } = along;
        let step = &path.moves()[index];
        let length = step.segment.length();
        let (least, most) = (self.least * programmed, self.most * programmed);
        let feed = |station: usize| {
            let feed = loading.chip.feed(forces[station].chip_at(self.force), step.spindle);
            feed.map(|feed| feed.clamp(least, most))
        };
        let mut cells = Vec::new();
        let mut cell = FeedCell { index, from: 0.0, to: length, feed: most };
        let stations = contacts.of_move(index);
        for station in stations.clone() {
            let (within, feed) = (contacts.within(station), feed(station)?);
            cell.feed = cell.feed.min(feed);
            if within - cell.from >= LEAST && length - within >= LEAST {
                cells.push(FeedCell { to: within, ..cell });
                cell = FeedCell { from: within, feed, ..cell };
            }
        }
        cells.push(cell);
        Some(cells)
    }

    /// Shares of the way at feed on which the feed is at its lower and at its upper limit, on a path in
    /// `pieces` of the path `programmed`.
    pub fn shares_at_limits(&self, pieces: &[Piece], programmed: &Path, loading: &Loading) -> [f64; 2] {
        let (mut all, mut at) = (0.0, [0.0; 2]);
        for piece in pieces {
            let step = &programmed.moves()[piece.index];
            let run = Move { pace: piece.pace, ..*step };
            let Some((feed, own)) = loading.programmed(&run).zip(loading.programmed(step)) else { continue };
            let length = piece.to - piece.from;
            all += length;
            at[0] += if feed <= self.least * own { length } else { 0.0 };
            at[1] += if feed >= self.most * own { length } else { 0.0 };
        }
        at.map(|at| if all > 0.0 { at / all } else { 0.0 })
    }
}

/// Cells that are cut at one feed.
#[derive(Default)]
struct FeedRun {
    cells: Vec<FeedCell>,
    /// Lowest and highest feed among them [m/s].
    feeds: Option<(f64, f64)>,
    /// Their length [m].
    length: f64,
}

impl FeedRun {
    /// Whether a cell goes with these: at about the same feed, or they are still short.
    fn goes_on(&self, next: &FeedCell, moves: &[Move]) -> bool {
        let Some((last, (low, high))) = self.cells.last().zip(self.feeds) else { return true };
        let (a, b) = (&moves[last.index], &moves[next.index]);
        let is_alike = high.max(next.feed) <= low.min(next.feed) * (1.0 + STEP);
        (a.pace, a.spindle) == (b.pace, b.spindle) && (is_alike || self.length < LEAST)
    }

    fn push(&mut self, cell: FeedCell) {
        let (low, high) = self.feeds.unwrap_or((cell.feed, cell.feed));
        self.feeds = Some((low.min(cell.feed), high.max(cell.feed)));
        self.length += cell.to - cell.from;
        self.cells.push(cell);
    }

    /// What lies of them in each move, at the lowest feed.
    fn pieces(self, along: &CutAlong) -> Vec<Piece> {
        let feed = self.feeds.map_or(0.0, |(low, _)| low);
        let (moves, loading) = (along.path.moves(), along.loading);
        let pieces = self.cells.chunk_by(|a, b| a.index == b.index).map(|part| {
            let (first, last) = (&part[0], &part[part.len() - 1]);
            let step = &moves[first.index];
            let pace = if loading.programmed(step) == Some(feed) { step.pace } else { MovePace::Feed(feed) };
            Piece { index: first.index, from: first.from, to: last.to, pace }
        });
        pieces.collect()
    }
}
