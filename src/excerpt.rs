//! The first lines of a text as a text of its own, so that a build holds no more of a data file than it reads.

/// A text in the program: all of it with the feature `full`, else only its first lines.
macro_rules! excerpt {
    ($path:literal, $lines:literal) => {{
        const ALL: &str = include_str!($path);
        const LENGTH: usize =
            if cfg!(feature = "full") { ALL.len() } else { $crate::excerpt::length(ALL, $lines) };
        const PART: [u8; LENGTH] = $crate::excerpt::copy(ALL);
        match std::str::from_utf8(&PART) {
            Ok(text) => text,
            Err(_) => "",
        }
    }};
}
pub(crate) use excerpt;

/// Bytes of the first `lines` lines.
pub(crate) const fn length(text: &str, lines: usize) -> usize {
    let (mut at, mut seen) = (0, 0);
    while at < text.len() && seen < lines {
        if text.as_bytes()[at] == b'\n' {
            seen += 1;
        }
        at += 1;
    }
    at
}

/// The first bytes of a text.
pub(crate) const fn copy<const N: usize>(text: &str) -> [u8; N] {
    let mut bytes = [0; N];
    let mut at = 0;
    while at < N {
        bytes[at] = text.as_bytes()[at];
        at += 1;
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::{copy, length};

    #[test]
    fn lines_are_counted_with_their_ends() {
        for (lines, bytes) in [(0, 0), (1, 4), (2, 6), (3, 7), (9, 7)] {
            assert_eq!(length("ab\u{fc}\nc\nd", lines) - usize::from(lines > 0), bytes);
        }
        assert_eq!(&copy::<5>("ab\u{fc}\nc\n"), "ab\u{fc}\n".as_bytes());
    }
}
