//! JSON values that know their place in the text, so every error carries its field, line and
//! column.
//!
//! serde_json checks the syntax and reads single values. [`Read`] defines the keys and what they
//! set.

use crate::error::{Error, Short};
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;
use std::fmt;

/// A value that can be read from JSON in place; whatever the text omits keeps its value.
pub(super) trait Read {
    /// Reads `node`.
    fn read(&mut self, node: &Node) -> Result<(), Error>;
}

/// A value in the text.
pub(super) struct Node<'a> {
    /// The whole text.
    text: &'a str,
    /// The part of the text that is this value.
    raw: &'a str,
    /// The container of this value, and its key or index in it; `None` for the root.
    parent: Option<(&'a Node<'a>, PathStep<'a>)>,
    /// The members of the root. They are used twice, so a text of megabytes is scanned for them
    /// only once.
    members: Option<Members<'a>>,
}

#[derive(Clone, Copy)]
enum PathStep<'a> {
    Key(&'a str),
    Index(usize),
}

/// Name of an object in error messages.
const OBJECT: &str = "an object with named keys";

/// The members of a list or an object, unread.
#[derive(Clone)]
enum Members<'a> {
    List(Vec<&'a RawValue>),
    Object(Vec<(String, &'a RawValue)>),
}

impl<'a> Node<'a> {
    /// The root of a text, which must be an object.
    pub(super) fn of(text: &'a str) -> Result<Self, Error> {
        let whole = Node { text, raw: text, parent: None, members: None };
        let raw: &RawValue = whole.value()?;
        let root = Node { raw: raw.get(), ..whole };
        Ok(Node { members: Some(root.members(OBJECT)?), ..root })
    }

    /// The member of an object with this key, if it has one.
    pub(super) fn get<'s>(&'s self, key: &'s str) -> Result<Option<Node<'s>>, Error> {
        let Members::Object(members) = self.members(OBJECT)? else { return Ok(None) };
        let member = members.into_iter().find(|(name, _)| name == key);
        Ok(member.map(|(_, raw)| self.member(PathStep::Key(key), raw)))
    }

    /// This value, deserialized by serde.
    pub(super) fn value<T: Deserialize<'a>>(&self) -> Result<T, Error> {
        serde_json::from_str(self.raw).map_err(|error| self.refused(&error))
    }

    /// Whether this is a string.
    pub(super) fn is_text(&self) -> bool {
        self.raw.starts_with('"')
    }

    /// Whether this is an object.
    pub(super) fn is_object(&self) -> bool {
        self.raw.starts_with('{')
    }

    /// The index of this value in `words`.
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

    /// Reads an object: each key at most once, all of `required`, and no unknown keys.
    pub(super) fn object(&self, keys: &mut [(&str, &mut dyn Read)], required: &[&str]) -> Result<(), Error> {
        let Members::Object(members) = self.members(OBJECT)? else {
            return Err(self.error("a list instead of an object with named keys"));
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

    /// Reads a list of fixed length; `expected` describes it in errors.
    fn tuple(&self, items: &mut [&mut dyn Read], expected: &str) -> Result<(), Error> {
        let members = self.list(expected)?;
        members.iter().zip(&mut *items).try_for_each(|(member, item)| item.read(member))?;
        if members.len() == items.len() {
            return Ok(());
        }
        Err(self.error(&format!("invalid length {}, expected {expected}", members.len())))
    }

    /// The members of a list; `expected` describes it in errors.
    fn list(&self, expected: &str) -> Result<Vec<Node<'_>>, Error> {
        let Members::List(members) = self.members(expected)? else {
            return Err(self.error(&format!("invalid type: map, expected {expected}")));
        };
        Ok(members.into_iter().enumerate().map(|(k, raw)| self.member(PathStep::Index(k), raw)).collect())
    }

    fn member<'s>(&'s self, step: PathStep<'s>, raw: &'s RawValue) -> Node<'s> {
        Node { text: self.text, raw: raw.get(), parent: Some((self, step)), members: None }
    }

    /// The members of a list or an object; `expected` describes it in errors.
    fn members(&self, expected: &str) -> Result<Members<'a>, Error> {
        if let Some(members) = &self.members {
            return Ok(members.clone());
        }
        let mut deserializer = serde_json::Deserializer::from_str(self.raw);
        let members = deserializer.deserialize_any(Expected(expected));
        members.and_then(|members| deserializer.end().map(|()| members)).map_err(|error| self.refused(&error))
    }

    /// JSON path of this value; empty for the root.
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

    /// The error of serde_json for this value, whose line and column are relative to the value's
    /// start.
    fn refused(&self, error: &serde_json::Error) -> Error {
        let lines_before = error.line().saturating_sub(1);
        let bytes_before: usize = self.raw.split_inclusive('\n').take(lines_before).map(str::len).sum();
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or(&message);
        self.error_at(self.start() + bytes_before + error.column(), message)
    }

    /// An error about an unknown key, placed at the start of the key.
    fn unknown_key(&self, key: &str, known: &[(&str, &mut dyn Read)]) -> Error {
        let parent = self.parent.map_or_else(String::new, |(parent, _)| parent.path());
        // A comparison costs time and memory in proportion to the key's length; known keys are
        // shorter.
        let nearest = known
            .iter()
            .filter(|_| key.len() <= 60)
            .map(|(known, _)| (similarity(key, known), known))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(similarity, _)| *similarity > 0.4)
            .map(|(_, known)| join(&parent, known));
        // The key precedes the colon, in quotes. A quote within it has a backslash before it.
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

    /// Byte offset of this value in the text.
    fn start(&self) -> usize {
        self.raw.as_ptr().addr() - self.text.as_ptr().addr()
    }

    /// Line and column (in characters), both from 1, of the last of the first `offset` bytes.
    fn place(&self, offset: usize) -> (usize, usize) {
        let before = self.text.as_bytes().get(..offset).unwrap_or(self.text.as_bytes());
        let mut lines = before.rsplit(|byte| *byte == b'\n');
        // Every character has exactly one byte that is not a continuation byte.
        let begins = |line: &[u8]| line.iter().filter(|byte| **byte & 0xc0 != 0x80).count();
        let column = lines.next().map_or(0, begins).max(1);
        (1 + lines.count(), column)
    }
}

/// Similarity of two words: 1 for equal ones, 0 for unrelated ones.
fn similarity(a: &str, b: &str) -> f64 {
    1.0 - strsim::osa_distance(a, b) as f64 / a.chars().count().max(b.chars().count()).max(1) as f64
}

fn join(parent: &str, key: &str) -> String {
    if parent.is_empty() { key.to_owned() } else { format!("{parent}.{key}") }
}

/// Collects the members of a list or an object; the text is the expectation in errors.
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

/// Makes a struct readable from an object with its fields as keys; the list must name all fields.
/// With `new`, absent keys take the struct's own default, whatever their value was before.
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

/// Makes types readable that serde_json can deserialize.
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
