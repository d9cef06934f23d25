//! The words and names of a Siemens line, one by one.

use super::expression::ExpressionReader;
use super::variables::{Variable, Variables};
use super::word::{Word, WordFault, WordMode};

/// Names without effect on the path of a milling program.
const HARMLESS: [&str; 37] = [
    "WORKPIECE",
    "MSG",
    "CYCLE832",
    "GROUP_BEGIN",
    "GROUP_END",
    "STOPRE",
    "TRAFOOF",
    "SOFT",
    "BRISK",
    "DRIVE",
    "FFWON",
    "FFWOF",
    "COMPOF",
    "COMPON",
    "COMPCAD",
    "COMPCURV",
    "CFC",
    "CFTCP",
    "CFIN",
    "DIAMOF",
    "CUT2D",
    "UPATH",
    "SPATH",
    "FGROUP",
    "FIFOCTRL",
    "KONT",
    "NORM",
    "CDOF",
    "DYNROUGH",
    "DYNFINISH",
    "DYNSEMIFIN",
    "DYNNORM",
    "DYNPOS",
    "FNORM",
    "WALIMOF",
    "SPOS",
    "FGREF",
];
/// Names that would change the path, and what to do.
const REFUSED: [(&str, &str); 18] = [
    ("TRAORI", FIVE_AXES),
    ("TRACYL", "a wrapped path is not read: post it in X, Y and Z"),
    ("ROT", FRAME),
    ("AROT", FRAME),
    ("RPL", FRAME),
    ("SCALE", FRAME),
    ("ASCALE", FRAME),
    ("MIRROR", FRAME),
    ("AMIRROR", FRAME),
    ("GOTOF", CONTROL),
    ("GOTOB", CONTROL),
    ("GOTO", CONTROL),
    ("WHILE", CONTROL),
    ("FOR", CONTROL),
    ("REPEAT", CONTROL),
    ("IF", CONTROL),
    ("CALL", CONTROL),
    ("BSPLINE", "splines are not read: post lines and arcs"),
];
const FIVE_AXES: &str =
    "Siemens TRAORI turns the tool: post for three axes, or use APT or CSV with tool axes";
const FRAME: &str = "rotated, scaled and mirrored frames are not read: post the coordinates as they are cut";
const CONTROL: &str = "jumps and loops of Siemens programs are not followed: post plain moves";
const CORNER: &str = "chamfers, roundings, angles and polar words are not read: post lines and arcs";

/// A word of one letter and a number or expression.
pub(super) fn plain(
    line: &str,
    start: usize,
    words: &mut Vec<Word>,
    variables: &Variables,
) -> Result<usize, WordFault> {
    let mut reader = ExpressionReader::new(line, start + 1, variables);
    let value = reader.value()?;
    let letter = char::from(line.as_bytes()[start].to_ascii_uppercase());
    words.push(Word { letter, value, start, end: reader.at, mode: WordMode::Modal });
    Ok(reader.at)
}

/// A word with an equals sign.
pub(super) fn assigned(
    line: &str,
    (start, after): (usize, usize),
    name: &str,
    words: &mut Vec<Word>,
    variables: &mut Variables,
) -> Result<usize, WordFault> {
    let equals = line[after..].find('=').map_or(after, |at| after + at + 1);
    let digits = &line[start + name.len()..after];
    let refuse = |expected: &str| {
        Err(WordFault {
            at: start,
            found: format!("\"{}\"", line[start..].trim_end()),
            expected: expected.into(),
        })
    };
    let text = line[equals..].trim_start();
    if let Some(quoted) = text.strip_prefix('"') {
        // The name of a tool.
        let Some(length) = quoted.find('"') else { return refuse("a name closes with \"") };
        let end = line.len() - text.len() + length + 2;
        let value = quoted[..length].bytes().fold(0.0, |sum, byte| (sum * 31.0 + f64::from(byte)) % 1e8);
        if name == "T" {
            words.push(Word { letter: 'T', value, start, end, mode: WordMode::Modal });
        }
        return Ok(end);
    }
    let mut reader = ExpressionReader::new(line, equals, variables);
    let mode = if reader.take("AC") {
        WordMode::Absolute
    } else if reader.take("IC") {
        WordMode::Incremental
    } else {
        WordMode::Modal
    };
    let value = if mode != WordMode::Modal && reader.take("(") {
        let value = reader.expression()?;
        if !reader.take(")") {
            return refuse("AC and IC close with )");
        }
        value
    } else {
        reader.expression()?
    };
    let end = reader.at;
    let letter = match name {
        "R" if !digits.is_empty() => {
            if let Ok(number) = digits.parse() {
                variables.set(Variable::Arithmetic(number), Some(value));
            }
            return Ok(end);
        }
        "CR" => 'R',
        // Full turns beyond the arc itself.
        "TURN" => {
            words.push(Word { letter: 'P', value: value + 1.0, start, end, mode });
            return Ok(end);
        }
        _ if HARMLESS.contains(&name) || ["ADIS", "ADISPOS", "LIMS"].contains(&name) => return Ok(end),
        "RND" | "RNDM" | "CHF" | "CHR" | "ANG" | "AR" | "AP" | "RP" => return refuse(CORNER),
        // S1=, M1= address the first spindle.
        "S" | "M" if digits == "1" => char::from(name.as_bytes()[0]),
        _ if name.len() == 1 && digits.is_empty() => char::from(name.as_bytes()[0]),
        _ if ["A", "B", "C"].contains(&name) => return refuse(FIVE_AXES),
        _ => return refuse("no word of three-axis milling"),
    };
    words.push(Word { letter, value, start, end, mode });
    Ok(end)
}

/// A name, which has no effect or is refused; returns the byte after its brackets.
pub(super) fn named(line: &str, (start, after): (usize, usize), name: &str) -> Result<usize, WordFault> {
    let refuse = |expected: &str| {
        Err(WordFault { at: start, found: format!("\"{}\"", &line[start..after]), expected: expected.into() })
    };
    if let Some((_, expected)) = REFUSED.iter().find(|(refused, _)| *refused == name) {
        // Without words, a frame is taken back.
        let alone = line[after..].split(';').next().is_none_or(|rest| rest.trim().is_empty());
        return if alone && *expected == FRAME { Ok(after) } else { refuse(expected) };
    }
    let full = line[start..after].to_ascii_uppercase();
    if !HARMLESS.iter().any(|known| *known == name || *known == full) {
        return refuse(
            "no word of three-axis milling that is known; known names are listed in the reader's source",
        );
    }
    Ok(closing(line, after))
}

/// The byte after the brackets that open next, or `from`.
pub(super) fn closing(line: &str, from: usize) -> usize {
    let rest = line[from..].trim_start();
    if !rest.starts_with('(') {
        return from;
    }
    let opened = line.len() - rest.len();
    let (mut depth, mut quoted) = (0, false);
    for (at, sign) in rest.char_indices() {
        match sign {
            '"' => quoted = !quoted,
            '(' if !quoted => depth += 1,
            ')' if !quoted => {
                depth -= 1;
                if depth == 0 {
                    return opened + at + 1;
                }
            }
            _ => {}
        }
    }
    line.len()
}

/// The values in the brackets after a name, where they are given, and the byte after them; a text counts
/// as none.
pub(super) fn arguments(
    line: &str,
    from: usize,
    variables: &Variables,
) -> Result<(Vec<Option<f64>>, usize), WordFault> {
    let mut reader = ExpressionReader::new(line, from, variables);
    let mut values = Vec::new();
    if !reader.take("(") {
        return Ok((values, from));
    }
    loop {
        if reader.take(")") {
            return Ok((values, reader.at));
        }
        if reader.take(",") {
            values.push(None);
            continue;
        }
        if reader.take("\"") {
            let end = line[reader.at..].find('"').map_or(line.len(), |end| reader.at + end + 1);
            reader.at = end;
            values.push(None);
        } else {
            values.push(Some(reader.expression()?));
        }
        if !reader.take(",") && !line[reader.at..].trim_start().starts_with(')') {
            let found = format!("\"{}\"", line[reader.at..].trim_end());
            return Err(WordFault {
                at: reader.at,
                found,
                expected: "values are separated by commas".into(),
            });
        }
    }
}
