//! The sections of an `.LS` file: attributes, numbered lines, positions.

use crate::controllers::Text;
use crate::controllers::scan::Scan;
use std::collections::BTreeMap;

/// The attributes in their order, and how their lines end.
const ATTRIBUTES: [(&str, char); 17] = [
    ("OWNER", ';'),
    ("COMMENT", ';'),
    ("PROG_SIZE", ';'),
    ("CREATE", ';'),
    ("MODIFIED", ';'),
    ("FILE_NAME", ';'),
    ("VERSION", ';'),
    ("LINE_COUNT", ';'),
    ("MEMORY_SIZE", ';'),
    ("PROTECT", ';'),
    ("TCD:  STACK_SIZE", ','),
    ("TASK_PRIORITY", ','),
    ("TIME_SLICE", ','),
    ("BUSY_LAMP_OFF", ','),
    ("ABORT_REQUEST", ','),
    ("PAUSE_REQUEST", ';'),
    ("DEFAULT_GROUP", ';'),
];

/// A program: its statements and its positions.
pub(super) struct Listing<'a> {
    /// Statements without number and semicolon.
    pub(super) lines: Vec<Scan<'a>>,
    pub(super) positions: BTreeMap<i64, Position>,
}

/// A position, and the frames it was recorded in.
#[derive(Clone)]
pub(super) struct Position {
    pub(super) user: i64,
    pub(super) tool: i64,
    pub(super) values: Values,
}

#[derive(Clone)]
pub(super) enum Values {
    /// J1 to J6 [deg].
    Joints([f64; 6]),
    /// X, Y, Z [mm], W, P, R [deg], and CONFIG.
    Pose { frame: [f64; 6], config: String },
}

/// A name as the controller takes it.
pub(super) fn program_name(name: &str) -> Result<(), String> {
    let is_upper = name.chars().all(|letter| !letter.is_ascii_lowercase() && letter != '$');
    if is_upper && name.len() <= 36 && name.starts_with(|first: char| first.is_ascii_uppercase()) {
        Ok(())
    } else {
        Err("a program is called by at most 36 capitals, digits and _".to_owned())
    }
}

pub(super) fn listing<'a>(text: &Text<'a>) -> Result<Listing<'a>, String> {
    let mut lines = text.text.lines().enumerate().map(|(at, line)| Scan::of(text.path, at + 1, line));
    let fail = |what: &str| Err(format!("{}:{}: {what}", text.path, text.text.lines().count()));
    let Some(mut first) = lines.next() else { return fail("an empty file") };
    first.need("/PROG")?;
    let from = first.clone();
    let name = first.word()?;
    program_name(name).or_else(|what| from.fail(what))?;
    first.end()?;
    if name != text.stem {
        return from.fail(format!("the file is called {}", text.stem));
    }
    let attributes: Vec<Scan> = lines.by_ref().take_while(|line| line.rest().trim_end() != "/MN").collect();
    let count = attribute_list(&attributes, &first)?;
    let mut listing = Listing { lines: Vec::new(), positions: BTreeMap::new() };
    let mut numbered = 0;
    let mut open: Option<(usize, &str)> = None;
    for line in lines.by_ref() {
        let whole = line.rest();
        if whole.trim_end() == "/POS" {
            break;
        }
        let Some((number, code)) = whole.split_once(':') else { return line.fail("a line without a number") };
        let is_continued = number == "    ";
        if !is_continued {
            numbered += 1;
        }
        if (!is_continued && number != format!("{numbered:4}")) || is_continued != open.is_some() {
            return line.fail(format!("line {numbered} is expected"));
        }
        let is_motion = ["J ", "L ", "C "].iter().any(|letter| code.starts_with(letter)) || is_continued;
        if !is_motion && !code.starts_with("  ") {
            return line.fail("a motion follows the colon, others stand two blanks after it");
        }
        let ended = code.trim_end().strip_suffix(';');
        if ended.is_some_and(|code| !code.ends_with(' ') && !code.trim_start().starts_with('!')) {
            return line.fail("a blank stands before the semicolon");
        }
        // The two lines of an arc are one statement, from the first's code to the second's semicolon.
        let start = code.as_ptr() as usize - text.text.as_ptr() as usize;
        match (ended, open.take()) {
            (None, None) if code.starts_with("C ") => open = Some((start, whole)),
            (None, _) => return line.fail("the semicolon is missing"),
            (Some(code), None) => {
                if code.trim_start().strip_prefix('!').is_some_and(|remark| remark.trim_end().len() > 32) {
                    return line.fail("a remark of more than 32 characters");
                }
                if code.trim_end().contains(';') {
                    return line.fail("two semicolons");
                }
                listing.lines.push(Scan::of(text.path, line.line(), code));
            }
            (Some(code), Some((begin, _))) => {
                let joined = &text.text[begin..start + code.len()];
                listing.lines.push(Scan::of(text.path, line.line() - 1, joined));
            }
        }
    }
    if count != numbered {
        return first.fail(format!("LINE_COUNT is {count}, there are {numbered} lines"));
    }
    let Some((_, rest)) = text.text.split_once("/POS") else { return fail("/POS is missing") };
    let line = 1 + text.text[..text.text.len() - rest.len()].matches('\n').count();
    let mut scan = Scan::of(text.path, line, rest);
    while !scan.take("/END") {
        position(&mut scan, &mut listing.positions)?;
    }
    scan.end()?;
    Ok(listing)
}

/// Checks the attributes and gives LINE_COUNT.
fn attribute_list(lines: &[Scan], first: &Scan) -> Result<usize, String> {
    let mut lines = lines.iter().cloned();
    let mut count = None;
    match lines.next() {
        Some(line) if line.rest().trim_end() == "/ATTR" => {}
        _ => return first.fail("/ATTR is missing"),
    }
    for (name, end) in ATTRIBUTES {
        let Some(mut line) = lines.next() else { return first.fail(format!("{name} is missing")) };
        line.need_all(&[name, "="])?;
        let value = line.rest().trim();
        let Some(value) = value.strip_suffix(end) else { return line.fail(format!("`{end}` is missing")) };
        match name {
            "LINE_COUNT" => count = value.parse::<usize>().ok(),
            "COMMENT" => {
                let inner = value.strip_prefix('"').and_then(|value| value.strip_suffix('"'));
                if inner.is_none_or(|inner| inner.len() > 16 || inner.contains('"')) {
                    return line.fail("a comment has at most 16 characters between quotation marks");
                }
            }
            "CREATE" | "MODIFIED" => {
                let parts: Vec<&str> = value.split_whitespace().collect();
                if parts.len() != 4 || parts[0] != "DATE" || parts[2] != "TIME" {
                    return line.fail("a date and a time are expected");
                }
            }
            _ => {}
        }
    }
    let Some(mut last) = lines.next() else { return first.fail("CONTROL_CODE is missing") };
    last.need_all(&["CONTROL_CODE", "=", "00000000", "00000000", ";"])?;
    last.end()?;
    for line in lines {
        let text = line.rest().trim();
        if !(text.starts_with("LOCAL_REGISTERS") || text == "/APPL") {
            return line.fail("no attribute that this controller knows");
        }
    }
    count.map_or_else(|| first.fail("LINE_COUNT is no number"), Ok)
}

/// Reads `P[n]{ ... };`.
fn position(scan: &mut Scan, positions: &mut BTreeMap<i64, Position>) -> Result<(), String> {
    let from = scan.clone();
    scan.need_all(&["P", "["])?;
    let number = scan.integer(1, 32767)?;
    if scan.take(":") {
        scan.quoted('"')?;
    }
    scan.need_all(&["]", "{", "GP1", ":", "UF", ":"])?;
    let user = scan.integer(0, 9)?;
    scan.need_all(&[",", "UT", ":"])?;
    let tool = scan.integer(1, 10)?;
    scan.need(",")?;
    let values = if scan.take("CONFIG") {
        scan.need(":")?;
        let config = scan.quoted('\'')?.to_owned();
        is_config(&config).or_else(|what| scan.fail(what))?;
        scan.need(",")?;
        let frame = numbers(scan, ["X", "Y", "Z", "W", "P", "R"], ["mm", "mm", "mm", "deg", "deg", "deg"])?;
        Values::Pose { frame, config }
    } else {
        Values::Joints(numbers(scan, ["J1", "J2", "J3", "J4", "J5", "J6"], ["deg"; 6])?)
    };
    for external in ["E1", "E2", "E3"] {
        if scan.take(",") {
            scan.need_all(&[external, "="])?;
            scan.number()?;
            if !scan.take("mm") {
                scan.need("deg")?;
            }
        }
    }
    scan.need_all(&["}", ";"])?;
    let position = Position { user, tool, values };
    if positions.insert(number, position).is_some() {
        from.fail("a second position of this number")
    } else {
        Ok(())
    }
}

fn numbers(scan: &mut Scan, names: [&str; 6], units: [&str; 6]) -> Result<[f64; 6], String> {
    let mut numbers = [0.0; 6];
    for (index, number) in numbers.iter_mut().enumerate() {
        if index > 0 {
            scan.need(",")?;
        }
        scan.need_all(&[names[index], "="])?;
        let from = scan.clone();
        *number = scan.number()?;
        if *number == 0.0 && from.clone().prefix("-0") {
            return from.fail("minus zero");
        }
        scan.need(units[index])?;
    }
    Ok(numbers)
}

/// `N U T, 0, 0, 0`: wrist, elbow, arm, then turns of J1, J4 and J6.
fn is_config(config: &str) -> Result<(), String> {
    let parts: Vec<&str> = config.split(", ").collect();
    let letters: Vec<&str> = parts[0].split(' ').collect();
    let is_right = parts.len() == 4
        && matches!(&letters[..], ["F" | "N", "U" | "D", "T" | "B"])
        && parts[1..].iter().all(|turn| turn.parse::<i8>().is_ok_and(|turn| (-8..=7).contains(&turn)));
    if is_right { Ok(()) } else { Err("no CONFIG such as 'N U T, 0, 0, 0'".to_owned()) }
}
