//! Progress of a running computation.

/// A progress report.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stage {
    /// Share of the work done, from 0 to 1, assuming that every pass is needed.
    pub fraction: f64,
    /// Name of the current part.
    pub name: &'static str,
}

/// Samples between two reports of a loop over samples.
const STRIDE: usize = 1 << 15;

/// Reports the progress of one part of the work to an optional listener.
pub struct Progress<'a> {
    listener: Option<&'a mut (dyn FnMut(Stage) + 'a)>,
    name: &'static str,
    /// Where this part begins and ends, as shares of the whole work.
    from: f64,
    to: f64,
}

impl<'a> Progress<'a> {
    /// Progress without a listener.
    pub fn none() -> Self {
        Self { listener: None, name: "", from: 0.0, to: 1.0 }
    }

    /// Progress of the whole work.
    pub fn new(listener: &'a mut (dyn FnMut(Stage) + 'a)) -> Self {
        Self { listener: Some(listener), ..Self::none() }
    }

    /// The part of this work from the share `from` to the share `to`, with its own name; an empty
    /// name keeps the current one.
    pub fn part(&mut self, name: &'static str, from: f64, to: f64) -> Progress<'_> {
        let place = |share: f64| self.from + (self.to - self.from) * share;
        let (from, to) = (place(from), place(to));
        let name = if name.is_empty() { self.name } else { name };
        match &mut self.listener {
            Some(listener) => Progress { listener: Some(&mut **listener), name, from, to },
            None => Progress { listener: None, name, from, to },
        }
    }

    /// Reports that the share `share` of this part is done.
    pub fn at(&mut self, share: f64) {
        if let Some(listener) = &mut self.listener {
            listener(Stage { fraction: self.from + (self.to - self.from) * share, name: self.name });
        }
    }

    /// Notes that sample `k` of `count` is done; reports only every `STRIDE` samples.
    pub fn sample(&mut self, k: usize, count: usize) {
        if (k + 1).is_multiple_of(STRIDE) {
            self.at((k + 1) as f64 / count as f64);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Progress, STRIDE};

    #[test]
    fn parts_of_parts_report_their_share_of_the_whole() {
        let mut heard = Vec::new();
        let mut listener = |stage: super::Stage| heard.push((stage.name, stage.fraction));
        let mut whole = Progress::new(&mut listener);
        let mut second = whole.part("second", 0.5, 1.0);
        second.at(0.0);
        second.part("", 0.5, 1.0).at(0.5);
        second.part("third", 0.0, 0.5).sample(STRIDE - 1, 2 * STRIDE);
        second.sample(0, 1);
        assert_eq!(heard, [("second", 0.5), ("second", 0.875), ("third", 0.625)]);
    }
}
