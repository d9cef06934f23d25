//! A RAPID module: its data, and its procedures as statements.

use crate::controllers::scan::Scan;
use crate::controllers::{Frame, Text, is_identifier};
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;

/// Data of a type.
pub(super) type Data = (String, Value);

const RESERVED: &str = "alias and backward break case connect const continue default div do else elseif endfor endfunc \
     endif endmodule endproc endrecord endtest endtrap endwhile error exit false for from func goto if inout local mod \
     module nostepin not noview or pers proc raise readonly record retry return step sysmodule task test then to trap \
     true trynext undo var viewonly while with xor";

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Number(f64),
    Flag(bool),
    Text(String),
    /// Data by name.
    Name(String),
    List(Vec<Value>),
}

/// A module: its data and its procedures, by names in lower case.
pub(super) struct Module<'a> {
    pub(super) path: &'a str,
    pub(super) name: String,
    pub(super) data: BTreeMap<String, Data>,
    pub(super) procedures: BTreeMap<String, Vec<Scan<'a>>>,
}

/// A name for data, procedures and modules, in lower case.
pub(super) fn name(scan: &mut Scan) -> Result<String, String> {
    let from = scan.clone();
    let name = scan.word()?.to_ascii_lowercase();
    if !is_identifier(&name, 32) || RESERVED.split_whitespace().any(|word| word == name) {
        return from
            .fail("a name is a letter, then letters, digits and _, at most 32, and no word of the language");
    }
    Ok(name)
}

pub(super) fn module<'a>(text: &Text<'a>) -> Result<Module<'a>, String> {
    let mut scan = Scan::of(text.path, 1, text.text).with_comments('!');
    if scan.take("%%%") {
        scan.need_all(&["VERSION", ":", "1", "LANGUAGE", ":", "ENGLISH", "%%%"])?;
    }
    scan.need("MODULE")?;
    let mut module = Module {
        path: text.path,
        name: name(&mut scan)?,
        data: BTreeMap::new(),
        procedures: BTreeMap::new(),
    };
    if scan.take("(") {
        scan.need_all(&["SYSMODULE", ")"])?;
    }
    while !scan.take("ENDMODULE") {
        let from = scan.clone();
        scan.take("LOCAL");
        let is_new = if scan.take("PROC") {
            let procedure = name(&mut scan)?;
            scan.need_all(&["(", ")"])?;
            let mut statements = Vec::new();
            while !scan.take("ENDPROC") {
                statements.push(statement(&mut scan, text)?);
            }
            module.procedures.insert(procedure.clone(), statements).is_none()
                && !module.data.contains_key(&procedure)
        } else {
            scan.take("TASK");
            if !["VAR", "PERS", "CONST"].iter().any(|kind| scan.take(kind)) {
                return scan.fail("neither a declaration nor a procedure");
            }
            let kind = scan.word()?.to_ascii_lowercase();
            let data = name(&mut scan)?;
            scan.need(":=")?;
            let value = value(&mut scan)?;
            scan.need(";")?;
            if !has_type(&kind, &value) {
                return from.fail(format!("no value of a {kind}"));
            }
            module.data.insert(data.clone(), (kind, value)).is_none()
                && !module.procedures.contains_key(&data)
        };
        if !is_new {
            return from.fail("this name stands twice");
        }
    }
    scan.end()?;
    Ok(module)
}

/// A statement up to its semicolon.
fn statement<'a>(scan: &mut Scan<'a>, text: &Text<'a>) -> Result<Scan<'a>, String> {
    scan.blank();
    let (line, start) = (scan.line(), scan.rest());
    let mut is_text = false;
    for (at, letter) in start.char_indices() {
        match letter {
            '"' => is_text = !is_text,
            '!' if !is_text => return scan.fail("a comment within a statement"),
            ';' if !is_text => {
                scan.need(&start[..=at])?;
                return Ok(Scan::of(text.path, line, &start[..at]));
            }
            _ => {}
        }
    }
    scan.fail("a statement has no end")
}

pub(super) fn value(scan: &mut Scan) -> Result<Value, String> {
    if scan.take("[") {
        let mut list = vec![value(scan)?];
        while scan.take(",") {
            list.push(value(scan)?);
        }
        scan.need("]")?;
        return Ok(Value::List(list));
    }
    if scan.take("TRUE") || scan.clone().take("FALSE") {
        return Ok(Value::Flag(!scan.take("FALSE")));
    }
    if scan.clone().take("\"") {
        let text = scan.quoted('"')?;
        return if text.len() > 80 {
            scan.fail("more than 80 characters")
        } else {
            Ok(Value::Text(text.to_owned()))
        };
    }
    if scan.clone().word().is_ok() { Ok(Value::Name(name(scan)?)) } else { Ok(Value::Number(scan.number()?)) }
}

/// Whether a value has the layout of a type: `n` a number, `q` a quaternion, `b` a flag, `s` a text.
pub(super) fn has_type(kind: &str, value: &Value) -> bool {
    let layout = match kind {
        "num" => "n",
        "bool" => "b",
        "string" => "s",
        "tooldata" => "[b[[nnn]q][n[nnn]qnnn]]",
        "loaddata" => "[n[nnn]qnnn]",
        "wobjdata" => "[bbs[[nnn]q][[nnn]q]]",
        "speeddata" => "[nnnn]",
        "zonedata" => "[bnnnnnn]",
        "robtarget" => "[[nnn]q[nnnn][nnnnnn]]",
        "jointtarget" => "[[nnnnnn][nnnnnn]]",
        "confdata" => "[nnnn]",
        "extjoint" => "[nnnnnn]",
        _ => return false,
    };
    let mut rest = layout.as_bytes();
    has_layout(value, &mut rest) && rest.is_empty()
}

fn has_layout(value: &Value, layout: &mut &[u8]) -> bool {
    let Some((&next, rest)) = layout.split_first() else { return false };
    *layout = rest;
    match (next, value) {
        (b'n', Value::Number(_)) | (b'b', Value::Flag(_)) | (b's', Value::Text(_)) => true,
        (b'q', Value::List(_)) => rotation(value).is_some(),
        (b'[', Value::List(list)) => {
            let is_right = list.iter().all(|item| has_layout(item, layout)) && layout.first() == Some(&b']');
            *layout = layout.get(1..).unwrap_or_default();
            is_right
        }
        _ => false,
    }
}

pub(super) fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let Value::List(list) = value else { return None };
    let numbers: Vec<f64> = list
        .iter()
        .filter_map(|item| if let Value::Number(number) = item { Some(*number) } else { None })
        .collect();
    if list.len() == N { numbers.try_into().ok() } else { None }
}

/// The matrix of a unit quaternion.
fn rotation(value: &Value) -> Option<Matrix3<f64>> {
    let [w, x, y, z] = numbers::<4>(value)?;
    if (w * w + x * x + y * y + z * z - 1.0).abs() > 1e-5 {
        return None;
    }
    let across = Matrix3::new(0.0, -z, y, z, 0.0, -x, -y, x, 0.0);
    Some(Matrix3::identity() + across * (2.0 * w) + across * across * 2.0)
}

pub(super) fn frame(value: &Value) -> Option<Frame> {
    let Value::List(parts) = value else { return None };
    Some((Vector3::from(numbers::<3>(parts.first()?)?), rotation(parts.get(1)?)?))
}
