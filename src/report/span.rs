//! Separate stretches of the motion at which something holds.

/// A stretch of samples: the first and the last.
pub(super) type Span = (usize, usize);

/// Most stretches in a warning, which bounds its size.
pub const MOST_SPANS: usize = 100;

/// The stretches at which something holds: each maximal run of samples, in order.
pub(super) fn spans(count: usize, holds: impl Fn(usize) -> bool) -> Vec<Span> {
    let mut spans: Vec<Span> = Vec::new();
    for k in (0..count).filter(|&k| holds(k)) {
        match spans.last_mut() {
            Some((_, last)) if *last + 1 == k => *last = k,
            _ => spans.push((k, k)),
        }
    }
    spans
}

/// At most `most` stretches: the nearest ones are joined, so that both ends of each still hold.
pub(super) fn joined(spans: &[Span], most: usize) -> Vec<Span> {
    let mut gaps: Vec<usize> = (1..spans.len()).collect();
    // Of equal gaps the earlier is kept.
    gaps.sort_by_key(|&i| (std::cmp::Reverse(spans[i].0 - spans[i - 1].1), i));
    gaps.truncate(most.saturating_sub(1));
    gaps.sort_unstable();
    let firsts = std::iter::once(0).chain(gaps.iter().copied());
    let ends = gaps.iter().copied().chain(std::iter::once(spans.len()));
    firsts
        .zip(ends)
        .filter(|(from, to)| from < to)
        .map(|(from, to)| (spans[from].0, spans[to - 1].1))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stretch_begins_and_ends_where_the_condition_does() {
        let at = |held: &[usize]| spans(10, |k| held.contains(&k));
        assert_eq!(at(&[]), []);
        assert_eq!(at(&[0, 1, 3, 9]), [(0, 1), (3, 3), (9, 9)]);
        assert_eq!(spans(3, |_| true), [(0, 2)]);
    }

    #[test]
    fn the_nearest_are_joined_first() {
        let all = [(0, 1), (3, 4), (10, 11), (13, 14), (30, 30)];
        assert_eq!(joined(&all, 5), all);
        assert_eq!(joined(&all, 3), [(0, 4), (10, 14), (30, 30)]);
        assert_eq!(joined(&all, 1), [(0, 30)]);
        assert_eq!(joined(&[], 100), []);
    }
}
