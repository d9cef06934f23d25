//! Values as KRL writes them.

use crate::controllers::scan::Scan;
use crate::controllers::{Frame, about_x, about_y, about_z};
use nalgebra::Vector3;

pub(super) const TYPES: [&str; 9] =
    ["INT", "REAL", "BOOL", "FRAME", "POS", "E6POS", "AXIS", "E6AXIS", "LOAD"];

#[derive(Debug, Clone)]
pub(super) enum Value {
    Number(f64),
    /// A bit pattern, a text or a word, as written.
    Word(String),
    Group(Vec<(String, Value)>),
}

pub(super) fn name(scan: &mut Scan) -> Result<String, String> {
    let from = scan.clone();
    let name = scan.word()?.to_uppercase();
    if name.len() > 24 { from.fail("a name of more than 24 characters") } else { Ok(name) }
}

pub(super) fn value(scan: &mut Scan) -> Result<Value, String> {
    if scan.take("{") {
        let mut typed = scan.clone();
        if typed.word().is_ok_and(|word| TYPES.contains(&word.to_uppercase().as_str())) && typed.take(":") {
            *scan = typed;
        }
        let mut group: Vec<(String, Value)> = Vec::new();
        loop {
            let component = scan.word()?.to_uppercase();
            if group.iter().any(|(other, _)| *other == component) {
                return scan.fail(format!("{component} twice"));
            }
            group.push((component, value(scan)?));
            if scan.take("}") {
                return Ok(Value::Group(group));
            }
            scan.need(",")?;
        }
    }
    if scan.clone().take("'") {
        return Ok(Value::Word(format!("'{}'", scan.quoted('\'')?)));
    }
    if scan.take("#") || scan.clone().word().is_ok() {
        return Ok(Value::Word(scan.word()?.to_uppercase()));
    }
    Ok(Value::Number(scan.number()?))
}

/// The components of these names, all of them, and of no others than these and `others`.
pub(super) fn components<const N: usize>(
    value: &Value,
    names: [&str; N],
    others: &[&str],
) -> Result<[f64; N], String> {
    let Value::Group(group) = value else { return Err("no aggregate".to_owned()) };
    if let Some((odd, _)) =
        group.iter().find(|(name, _)| !names.iter().chain(others).any(|known| name == known))
    {
        return Err(format!("no component {odd} here"));
    }
    let mut numbers = [0.0; N];
    for (number, name) in numbers.iter_mut().zip(names) {
        match group.iter().find(|(component, _)| component == name) {
            Some((_, Value::Number(found))) => *number = *found,
            _ => return Err(format!("{name} is missing, or no number")),
        }
    }
    Ok(numbers)
}

pub(super) const EXTERNAL: [&str; 6] = ["E1", "E2", "E3", "E4", "E5", "E6"];

pub(super) fn frame(value: &Value, others: &[&str]) -> Result<Frame, String> {
    let [x, y, z, a, b, c] = components(value, ["X", "Y", "Z", "A", "B", "C"], others)?;
    if [a, b, c].iter().any(|angle| angle.abs() > 360.0) {
        return Err("an angle beyond 360 deg".to_owned());
    }
    Ok((Vector3::new(x, y, z), about_z(a) * about_y(b) * about_x(c)))
}

/// A pose with S and T as written, if it has them.
pub(super) fn pose(value: &Value) -> Result<(Frame, Option<String>), String> {
    let frame = frame(value, &[&["S", "T"][..], &EXTERNAL].concat())?;
    let Value::Group(group) = value else { return Err("no aggregate".to_owned()) };
    let bits = |name: &str, most: i64| -> Result<Option<String>, String> {
        let Some((_, value)) = group.iter().find(|(component, _)| component == name) else { return Ok(None) };
        let (written, number) = match value {
            Value::Number(number) if number.fract() == 0.0 => (number.to_string(), *number as i64),
            Value::Word(word) if word.starts_with("'B") => {
                (word.clone(), i64::from_str_radix(word[2..].trim_end_matches('\''), 2).unwrap_or(-1))
            }
            _ => return Err(format!("{name} is no bit pattern")),
        };
        if (0..=most).contains(&number) { Ok(Some(written)) } else { Err(format!("{name} is beyond {most}")) }
    };
    match (bits("S", 31)?, bits("T", 63)?) {
        (Some(s), Some(t)) => Ok((frame, Some(format!("S {s},T {t}")))),
        (None, None) => Ok((frame, None)),
        _ => Err("S without T, or T without S".to_owned()),
    }
}

/// A variable: `NAME`, `NAME[2]` or `$NAME.PART`.
pub(super) fn place(line: &mut Scan) -> Result<String, String> {
    let mut place = name(line)?;
    if line.take("[") {
        place = format!("{place}[{}]", line.integer(1, 9999)?);
        line.need("]")?;
    }
    if line.take(".") {
        place = format!("{place}.{}", line.word()?.to_uppercase());
    }
    Ok(place)
}

/// The mass of a load [kg].
pub(super) fn load(value: &Value) -> Result<f64, String> {
    let Value::Group(group) = value else { return Err("no load".to_owned()) };
    let [mass] = components(value, ["M"], &["CM", "J"])?;
    for (name, part) in group {
        match name.as_str() {
            "CM" => drop(frame(part, &[])?),
            "J" => drop(components(part, ["X", "Y", "Z"], &[])?),
            _ => {}
        }
    }
    if group.len() == 3 && mass >= 0.0 { Ok(mass) } else { Err("a load is M, CM and J".to_owned()) }
}
