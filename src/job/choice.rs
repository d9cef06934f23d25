//! A number, or one word that stands for a rule that gives it.

use serde::{Deserialize, Serialize};

/// A number, or one word that stands for a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Choice<W> {
    /// The word.
    Word,
    /// The number.
    Value(f64, std::marker::PhantomData<W>),
}

/// The word of a [`Choice`].
pub trait Word {
    /// As written in the JSON.
    const WORD: &'static str;
}

/// `"settle"`: until the shaped command has settled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settle;
impl Word for Settle {
    const WORD: &'static str = "settle";
}
/// `"from_feed"`: feed divided by the teeth that pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FromFeed;
impl Word for FromFeed {
    const WORD: &'static str = "from_feed";
}

/// Time at rest in a corner [s], or `"settle"`.
pub type Dwell = Choice<Settle>;
/// Feed per tooth [mm], or `"from_feed"`.
pub type FeedPerTooth = Choice<FromFeed>;

impl<W> Choice<W> {
    /// A number.
    pub fn value(value: f64) -> Self {
        Self::Value(value, std::marker::PhantomData)
    }
}

impl<W: Word> Serialize for Choice<W> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Choice::Word => serializer.serialize_str(W::WORD),
            Choice::Value(value, _) => serializer.serialize_f64(*value),
        }
    }
}

impl<'de, W: Word> Deserialize<'de> for Choice<W> {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor<W>(std::marker::PhantomData<W>);
        impl<W: Word> serde::de::Visitor<'_> for Visitor<W> {
            type Value = Choice<W>;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, "a number or \"{}\"", W::WORD)
            }
            fn visit_f64<E>(self, value: f64) -> Result<Self::Value, E> {
                Ok(Choice::value(value))
            }
            fn visit_u64<E>(self, value: u64) -> Result<Self::Value, E> {
                Ok(Choice::value(value as f64))
            }
            fn visit_i64<E>(self, value: i64) -> Result<Self::Value, E> {
                Ok(Choice::value(value as f64))
            }
            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Self::Value, E> {
                if text == W::WORD {
                    Ok(Choice::Word)
                } else {
                    Err(E::invalid_value(serde::de::Unexpected::Str(text), &self))
                }
            }
        }
        deserializer.deserialize_any(Visitor(std::marker::PhantomData))
    }
}

/// Declares an enumeration of the job whose values are written in lower case.
macro_rules! choice {
    ($(#[$doc:meta])* $name:ident { $($(#[$item_doc:meta])* $item:ident),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
        #[serde(rename_all = "lowercase")]
        pub enum $name { $($(#[$item_doc])* $item),+ }
    };
}
pub(super) use choice;
