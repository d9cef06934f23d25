//! The project and the data of a VAL3 application.

use crate::controllers::xml::{self, Element};
use crate::controllers::{Frame, Text, about_x, about_y, about_z, is_identifier};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// Components of a transformation, in order.
pub(super) const TRSF: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
const JOINTS: [&str; 6] = ["j1", "j2", "j3", "j4", "j5", "j6"];
/// Values of a motion descriptor where it states none.
const MDESC: [(&str, f64); 7] = [
    ("accel", 100.0),
    ("vel", 100.0),
    ("decel", 100.0),
    ("tmax", 99999.0),
    ("rmax", 99999.0),
    ("leave", 50.0),
    ("reach", 50.0),
];
/// The configurations of shoulder, elbow and wrist.
const CONFIG: [(&str, [&str; 4]); 3] = [
    ("shoulder", ["ssame", "sfree", "lefty", "righty"]),
    ("elbow", ["esame", "efree", "epositive", "enegative"]),
    ("wrist", ["wsame", "wfree", "wpositive", "wnegative"]),
];

/// An array of one type.
pub(super) struct Datum {
    pub(super) kind: String,
    pub(super) rows: Vec<Row>,
}

/// One value.
#[derive(Clone, Default)]
pub(super) struct Row {
    pub(super) numbers: BTreeMap<&'static str, f64>,
    pub(super) father: Option<(String, usize)>,
    pub(super) blend: &'static str,
    config: Vec<String>,
}

impl Row {
    /// A component, zero where it is not stated.
    pub(super) fn number(&self, name: &str) -> f64 {
        self.numbers.get(name).copied().unwrap_or(0.0)
    }

    pub(super) fn frame(&self) -> Frame {
        let [x, y, z, rx, ry, rz] = TRSF.map(|name| self.number(name));
        (Vector3::new(x, y, z), about_x(rx) * about_y(ry) * about_z(rz))
    }

    pub(super) fn config(&self) -> Option<String> {
        if self.config.is_empty() { None } else { Some(self.config.join(" ")) }
    }
}

/// What a `.pjx` lists: files and names of libraries.
pub(super) struct Project {
    pub(super) programs: Vec<String>,
    pub(super) data: Vec<String>,
    pub(super) libraries: Vec<String>,
}

pub(super) fn fail<T>(text: &Text, element: &Element, what: &str) -> Result<T, String> {
    Err(format!("{}:{}: <{}>: {what}", text.path, element.line, element.name))
}

/// Whether an element is this one of this name space.
pub(super) fn is(text: &Text, element: &Element, name: &str, space: &str) -> Result<(), String> {
    let is_right = element.name == name && element.attribute("xmlns") == Some(space);
    if is_right { Ok(()) } else { fail(text, element, &format!("<{name} xmlns=\"{space}\"> is expected")) }
}

pub(super) fn blend(word: &str) -> Result<&'static str, String> {
    let known = ["off", "joint", "Cartesian"].into_iter().find(|known| *known == word);
    known.ok_or_else(|| format!("no blending {word}"))
}

pub(super) fn project(text: &Text) -> Result<Project, String> {
    let root = xml::document(text.path, text.text)?;
    is(text, &root, "Project", "http://www.staubli.com/robotics/VAL3/Project/3")?;
    if !is_identifier(text.stem, 15) {
        return fail(text, &root, "an application is called by at most 15 letters, digits and _");
    }
    let mut project = Project { programs: Vec::new(), data: Vec::new(), libraries: Vec::new() };
    let mut has_parameters = false;
    for part in &root.children {
        let (child, attribute, list) = match part.name.as_str() {
            "Parameters" => {
                let version = part.attribute("version").unwrap_or_default();
                let stack = part.attribute("stackSize").and_then(|size| size.parse::<u32>().ok());
                has_parameters = ["s6.", "s7.", "s8."].iter().any(|known| version.starts_with(known))
                    && stack.is_some()
                    && part.attribute("millimeterUnit") == Some("true");
                continue;
            }
            "Programs" => ("Program", "file", &mut project.programs),
            "Database" => ("Data", "file", &mut project.data),
            "Libraries" => ("Library", "alias", &mut project.libraries),
            "Types" if part.children.is_empty() => continue,
            _ => return fail(text, part, "not known here"),
        };
        for element in &part.children {
            match element.attribute(attribute) {
                Some(name) if element.name == child && !list.iter().any(|other| other == name) => {
                    list.push(name.to_owned());
                }
                _ => return fail(text, element, "not known here, or twice"),
            }
        }
    }
    if has_parameters {
        Ok(project)
    } else {
        fail(text, &root, "version, stackSize and millimeterUnit are needed")
    }
}

/// Adds the data of a `.dtx`; fathers must be among them.
pub(super) fn database(text: &Text, data: &mut BTreeMap<String, Datum>) -> Result<(), String> {
    let root = xml::document(text.path, text.text)?;
    is(text, &root, "Database", "http://www.staubli.com/robotics/VAL3/Data/2")?;
    let [list] = &root.children[..] else { return fail(text, &root, "one <Datas> is expected") };
    if list.name != "Datas" {
        return fail(text, list, "<Datas> is expected");
    }
    for element in &list.children {
        let [name, access, array, kind, size] = ["name", "access", "xsi:type", "type", "size"]
            .map(|attribute| element.attribute(attribute).unwrap_or_default());
        let size: usize = size.parse().unwrap_or(0);
        if element.name != "Data" || array != "array" || !["private", "public"].contains(&access) {
            return fail(text, element, "a <Data> with access and an array is expected");
        }
        if !is_identifier(name, 15) || !(1..=9999).contains(&size) || element.attributes.len() != 5 {
            return fail(text, element, "a name of at most 15 characters and a size up to 9999 are expected");
        }
        let mut rows = vec![Row { blend: "joint", ..Row::default() }; size];
        if kind == "mdesc" {
            rows.iter_mut().for_each(|row| row.numbers.extend(MDESC));
        }
        let mut keys = BTreeSet::new();
        for value in &element.children {
            let key = value.attribute("key").and_then(|key| key.parse::<usize>().ok()).unwrap_or(size);
            if value.name != "Value" || key >= size || !keys.insert(key) {
                return fail(text, value, "a <Value> with a key of its own, below the size, is expected");
            }
            for (attribute, written) in value.attributes.iter().filter(|(name, _)| name != "key") {
                entry(kind, attribute, written, &mut rows[key])
                    .or_else(|what| fail(text, value, &format!("{attribute}=\"{written}\": {what}")))?;
            }
        }
        if data.insert(name.to_owned(), Datum { kind: kind.to_owned(), rows }).is_some() {
            return fail(text, element, "declared twice");
        }
    }
    for (name, datum) in &*data {
        for row in &datum.rows {
            let root = if datum.kind == "tool" { "flange" } else { "world" };
            let kinds: &[&str] = if datum.kind == "tool" { &["tool"] } else { &["frame"] };
            let is_known = row.father.as_ref().is_none_or(|(father, index)| {
                let found = data.get(father).filter(|other| kinds.contains(&other.kind.as_str()));
                (father == root && *index == 0) || found.is_some_and(|other| *index < other.rows.len())
            });
            if !is_known || (row.father.is_none() && ["frame", "tool"].contains(&datum.kind.as_str())) {
                return fail(text, &root_of(list, name), "no such father");
            }
        }
    }
    Ok(())
}

/// The element that declares a name, for the line of an error.
fn root_of(list: &Element, name: &str) -> Element {
    list.children.iter().find(|element| element.attribute("name") == Some(name)).unwrap_or(list).clone()
}

/// Takes in one attribute of a value.
fn entry(kind: &str, attribute: &str, written: &str, row: &mut Row) -> Result<(), String> {
    let components: &[&'static str] = match kind {
        "num" => &["value"],
        "trsf" | "frame" | "tool" | "pointRx" => &TRSF,
        "jointRx" => &JOINTS,
        "mdesc" => &["accel", "vel", "decel", "tmax", "rmax", "leave", "reach"],
        "string" | "bool" | "dio" | "aio" | "sio" => &[],
        _ => return Err(format!("no type {kind}")),
    };
    if let Some(component) = components.iter().find(|component| **component == attribute) {
        let number = written.parse::<f64>().ok().filter(|number| number.is_finite());
        let is_plain = written.chars().all(|letter| letter.is_ascii_digit() || "+-.eE".contains(letter));
        row.numbers.insert(component, number.filter(|_| is_plain).ok_or("no number")?);
        return Ok(());
    }
    let place = CONFIG.iter().find(|(name, _)| *name == attribute && kind == "pointRx");
    match (kind, attribute, place) {
        (_, _, Some((_, words))) if words.contains(&written) => row.config.push(written.to_owned()),
        ("frame" | "tool" | "pointRx", "fatherId", _) => {
            let father = written.strip_suffix(']').and_then(|start| start.split_once('['));
            let father = father.and_then(|(name, index)| Some((name.to_owned(), index.parse().ok()?)));
            row.father = Some(father.ok_or("no name[index]")?);
        }
        ("mdesc", "blend", _) => row.blend = blend(written)?,
        ("tool", "ioLink", _) | ("string" | "bool", "value", _) | ("dio" | "aio" | "sio", "link", _) => {}
        _ => return Err(format!("not known in a {kind}")),
    }
    Ok(())
}
