//! JSON values that know where they stand, so that every mistake is told with its field, line and column.
//!
//! serde_json checks the text and reads the single values; which keys there are, and what becomes of them, says [`Read`].

use crate::error::{Error, Short};
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;
use std::fmt;

/// What can be read from JSON, in place: what the text does not say stays as it is.
pub(super) trait Read {
    /// Reads `node`.
    fn read(&mut self, node: &Node) -> Result<(), Error>;
}

/// A value in the text.
pub(super) struct Node<'a> {
    /// The whole text.
    text: &'a str,
    /// The part of it that is this value.
    raw: &'a str,
    /// What this value is a part of, and which; nothing for the whole.
    parent: Option<(&'a Node<'a>, PathStep<'a>)>,
    /// The members of the whole, which is asked twice: a text of megabytes is scanned for them once.
    members: Option<Members<'a>>,
}

#[derive(Clone, Copy)]
enum PathStep<'a> {
    Key(&'a str),
    Index(usize),
}

/// What an object is called in an error.
const OBJECT: &str = "an object with named keys";

/// The members of a list or an object, unread.
#[derive(Clone)]
enum Members<'a> {
    List(Vec<&'a RawValue>),
    Object(Vec<(String, &'a RawValue)>),
}

impl<'a> Node<'a> {
    /// The whole of a text, which is an object.
    pub(super) fn of(text: &'a str) -> Result<Self, Error> {
        let whole = Node { text, raw: text, parent: None, members: None };
        let members = Some(whole.members(OBJECT)?);
        Ok(Node { raw: text.trim_matches([' ', '\t', '\r', '\n']), members, ..whole })
    }

    /// The member of an object with this key, if it has one.
    pub(super) fn get<'s>(&'s self, key: &'s str) -> Result<Option<Node<'s>>, Error> {
        let Members::Object(members) = self.members(OBJECT)? else { return Ok(None) };
        let member = members.into_iter().find(|(name, _)| name == key);
        Ok(member.map(|(_, raw)| self.member(PathStep::Key(key), raw)))
    }

    /// This value as one of serde's own types.
    pub(super) fn value<T: Deserialize<'a>>(&self) -> Result<T, Error> {
        serde_json::from_str(self.raw).map_err(|error| self.refused(&error))
    }

    /// Whether this is a quoted text.
    pub(super) fn is_text(&self) -> bool {
        self.raw.starts_with('"')
    }

    /// Whether this is an object.
    pub(super) fn is_object(&self) -> bool {
        self.raw.starts_with('{')
    }

    /// Which of a few words this is.
    pub(super) fn one_of(&self, words: &[&str]) -> Result<usize, Error> {
        let given: String = self.value()?;
        words.iter().position(|word| *word == given).ok_or_else(|| {
            let words: Vec<_> = words.iter().map(|word| format!("`{word}`")).collect();
            let expected = match words.as_slice() {
                [one, other] => format!("{one} or {other}"),
                all => format!("one of {}", all.join(", ")),
            };
            self.error(&format!("unknown variant `{given}`, expected {expected}"))
        })
    }

    /// Reads an object: each of its keys at most once, `required` ones at least once, no others.
    pub(super) fn object(&self, keys: &mut [(&str, &mut dyn Read)], required: &[&str]) -> Result<(), Error> {
        let Members::Object(members) = self.members(OBJECT)? else {
            return Err(self.error("a list stands where an object with named keys belongs"));
        };
        for (k, (key, raw)) in members.iter().enumerate() {
            let node = self.member(PathStep::Key(key), raw);
            let Some(at) = keys.iter().position(|(name, _)| name == key) else {
                return Err(node.unknown_key(key, keys));
            };
            if members[..k].iter().any(|(earlier, _)| earlier == key) {
                return Err(self.error_at(node.start(), &format!("duplicate field `{key}`")));
            }
            keys[at].1.read(&node)?;
        }
        match required.iter().find(|name| members.iter().all(|(key, _)| key != *name)) {
            Some(name) => Err(self.error(&format!("missing field `{name}`"))),
            None => Ok(()),
        }
    }

    /// Reads a list of a fixed length, which `expected` names.
    fn tuple(&self, items: &mut [&mut dyn Read], expected: &str) -> Result<(), Error> {
        let members = self.list(expected)?;
        members.iter().zip(&mut *items).try_for_each(|(member, item)| item.read(member))?;
        if members.len() == items.len() {
            return Ok(());
        }
        Err(self.error(&format!("invalid length {}, expected {expected}", members.len())))
    }

    /// The members of a list, which `expected` names.
    fn list(&self, expected: &str) -> Result<Vec<Node<'_>>, Error> {
        let Members::List(members) = self.members(expected)? else {
            return Err(self.error(&format!("invalid type: map, expected {expected}")));
        };
        Ok(members.into_iter().enumerate().map(|(k, raw)| self.member(PathStep::Index(k), raw)).collect())
    }

    fn member<'s>(&'s self, step: PathStep<'s>, raw: &'s RawValue) -> Node<'s> {
        Node { text: self.text, raw: raw.get(), parent: Some((self, step)), members: None }
    }

    /// The members of a list or an object, which `expected` names.
    fn members(&self, expected: &str) -> Result<Members<'a>, Error> {
        if let Some(members) = &self.members {
            return Ok(members.clone());
        }
        let mut deserializer = serde_json::Deserializer::from_str(self.raw);
        let members = deserializer.deserialize_any(Expected(expected));
        members.and_then(|members| deserializer.end().map(|()| members)).map_err(|error| self.refused(&error))
    }

    /// JSON path of this value; empty for the whole.
    pub(super) fn path(&self) -> String {
        match self.parent {
            None => String::new(),
            Some((parent, PathStep::Index(index))) => format!("{}[{index}]", parent.path()),
            Some((parent, PathStep::Key(key))) => join(&parent.path(), key),
        }
    }

    /// An error about this value, placed at its end.
    pub(super) fn error(&self, message: &str) -> Error {
        self.error_at(self.start() + self.raw.len(), message)
    }

    fn error_at(&self, offset: usize, message: &str) -> Error {
        let (line, column) = self.place(offset);
        let path = self.path();
        let place = if path.is_empty() { String::new() } else { format!("{path}: ") };
        let message = format!("{place}{} (line {line}, column {column})", Short(message));
        Error::Json { field: (!path.is_empty()).then_some(path), message, line, column }
    }

    /// serde_json's refusal of this value: it counts lines and columns from where the value begins.
    fn refused(&self, error: &serde_json::Error) -> Error {
        let lines_before = error.line().saturating_sub(1);
        let bytes_before: usize = self.raw.split_inclusive('\n').take(lines_before).map(str::len).sum();
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or(&message);
        self.error_at(self.start() + bytes_before + error.column(), message)
    }

    /// This value's key is none of the known ones; the place is where the key begins.
    fn unknown_key(&self, key: &str, known: &[(&str, &mut dyn Read)]) -> Error {
        let parent = self.parent.map_or_else(String::new, |(parent, _)| parent.path());
        // Comparing takes time and memory of the key's length; no known one is so long.
        let nearest = known
            .iter()
            .filter(|_| key.len() <= 60)
            .map(|(known, _)| (similarity(key, known), known))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(similarity, _)| *similarity > 0.4)
            .map(|(_, known)| join(&parent, known));
        // The key stands before the colon, in quotes; one within it has a backslash before it.
        let before =
            self.text.get(..self.start()).unwrap_or_default().trim_end_matches([' ', '\t', '\r', '\n', ':']);
        let inside = &before[..before.len().saturating_sub(1)];
        let escaped = |at: usize| {
            let backslashes = inside[..at].bytes().rev().take_while(|byte| *byte == b'\\').count();
            backslashes % 2 == 1
        };
        let quoted = inside.rmatch_indices('"').map(|(at, _)| at).find(|at| !escaped(*at)).unwrap_or(0);
        let (line, column) = self.place(quoted + 1);
        Error::UnknownKey { field: join(&parent, key), nearest, line, column }
    }

    /// Where this value, which is a part of the text, begins in it.
    fn start(&self) -> usize {
        self.raw.as_ptr().addr() - self.text.as_ptr().addr()
    }

    /// Line and column (in characters), both from 1, of the last of the first `offset` bytes.
    fn place(&self, offset: usize) -> (usize, usize) {
        let before = self.text.as_bytes().get(..offset).unwrap_or(self.text.as_bytes());
        let mut lines = before.rsplit(|byte| *byte == b'\n');
        // Every character begins with one byte that continues none.
        let begins = |line: &[u8]| line.iter().filter(|byte| **byte & 0xc0 != 0x80).count();
        let column = lines.next().map_or(0, begins).max(1);
        (1 + lines.count(), column)
    }
}

/// 1 for the same word, 0 for one that has nothing of the other.
fn similarity(a: &str, b: &str) -> f64 {
    1.0 - strsim::osa_distance(a, b) as f64 / a.chars().count().max(b.chars().count()).max(1) as f64
}

fn join(parent: &str, key: &str) -> String {
    if parent.is_empty() { key.to_owned() } else { format!("{parent}.{key}") }
}

/// Collects the members of what the text in it names.
struct Expected<'e>(&'e str);

impl<'de> Visitor<'de> for Expected<'_> {
    type Value = Members<'de>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Members<'de>, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = access.next_element()? {
            list.push(item);
        }
        Ok(Members::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Members<'de>, A::Error> {
        let mut object = Vec::new();
        while let Some(member) = access.next_entry()? {
            object.push(member);
        }
        Ok(Members::Object(object))
    }
}

/// Makes a struct readable from an object with its fields as keys; the list has to name them all. Of a `new` one, keys that are
/// not given are as in its own default, whatever was there before.
macro_rules! keys {
    (new $type:ident { $($key:ident),+ } $(required $($required:ident),+)?) => {
        impl $crate::job::json::Read for $type {
            fn read(&mut self, node: &$crate::job::json::Node) -> Result<(), $crate::error::Error> {
                *self = Self::default();
                let Self { $($key),+ } = self;
                node.object(&mut [$((stringify!($key), $key)),+], &[$($(stringify!($required)),+)?])
            }
        }
    };
    ($type:ident { $($key:ident),+ }) => {
        impl $crate::job::json::Read for $type {
            fn read(&mut self, node: &$crate::job::json::Node) -> Result<(), $crate::error::Error> {
                let Self { $($key),+ } = self;
                node.object(&mut [$((stringify!($key), $key)),+], &[])
            }
        }
    };
}
pub(super) use keys;

/// Makes types that serde_json reads by itself readable.
macro_rules! values {
    ($($type:ty),+) => {
        $(impl Read for $type {
            fn read(&mut self, node: &Node) -> Result<(), Error> {
                *self = node.value()?;
                Ok(())
            }
        })+
    };
}
values!(f64, u32, bool, String);

impl<T: Read + Default> Read for Option<T> {
    fn read(&mut self, node: &Node) -> Result<(), Error> {
        if node.raw == "null" {
            *self = None;
            return Ok(());
        }
        self.insert(T::default()).read(node)
    }
}

impl<T: Read, const N: usize> Read for [T; N] {
    fn read(&mut self, node: &Node) -> Result<(), Error> {
        node.tuple(&mut self.each_mut().map(|item| item as &mut dyn Read), &format!("an array of length {N}"))
    }
}

impl<A: Read, B: Read> Read for (A, B) {
    fn read(&mut self, node: &Node) -> Result<(), Error> {
        node.tuple(&mut [&mut self.0, &mut self.1], "a tuple of size 2")
    }
}

impl<T: Read + Default> Read for Vec<T> {
    fn read(&mut self, node: &Node) -> Result<(), Error> {
        self.clear();
        for member in node.list("a sequence")? {
            let mut item = T::default();
            item.read(&member)?;
            self.push(item);
        }
        Ok(())
    }
}
