//! What a sweep varies: a number over a range or a list, or a choice over its words.

use crate::error::Error;
use crate::job::fields::fields;
use crate::study::ValueRange;
use crate::study::range::finite;
use serde::Serialize;

/// What of a job takes several values.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Variation {
    /// A number.
    Range(ValueRange),
    /// A number whose values are listed.
    Numbers(ListedNumbers),
    /// A choice.
    Words(ChoiceWords),
}

/// Values of a number, in the order in which they are tried.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ListedNumbers {
    /// Dotted path in the job.
    pub path: String,
    /// The values, in the field's unit.
    pub values: Vec<f64>,
}

/// Words of a choice, in the order in which they are tried.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChoiceWords {
    /// Dotted path in the job.
    pub path: String,
    /// The words.
    pub words: Vec<String>,
}

/// A value that something of a job takes.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Taken {
    /// A number, in the field's unit.
    Number(f64),
    /// A word of a choice.
    Word(String),
}

impl From<f64> for Taken {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<ValueRange> for Variation {
    fn from(range: ValueRange) -> Self {
        Self::Range(range)
    }
}

/// What stands for every word of a choice.
const ALL: &str = "all";

impl Variation {
    /// Reads a range (see [`ValueRange::read`]), `path=number,number`, or `path=word,word` and `path=all` for a choice.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the text and what is wrong with it, or a word that the choice does not have.
    pub fn read(text: &str) -> Result<Self, Error> {
        let choice = text.split_once('=').filter(|(_, values)| !values.contains(':'));
        let words = |(path, values): (&str, &str)| {
            let field = fields().into_iter().find(|field| field.path == path && !field.choices.is_empty())?;
            Some((field, values.to_owned()))
        };
        let numbers = |(path, values): (&str, &str)| {
            let values = values.split(',').map(finite).collect::<Option<Vec<f64>>>()?;
            Some(Self::Numbers(ListedNumbers { path: path.to_owned(), values }))
        };
        match choice.and_then(words) {
            None => choice.and_then(numbers).map_or_else(|| ValueRange::read(text).map(Self::Range), Ok),
            Some((field, values)) => {
                let known: Vec<&str> = field.choices.iter().map(|choice| choice.value).collect();
                let given: Vec<&str> =
                    if values == ALL { known.clone() } else { values.split(',').collect() };
                match given.iter().find(|word| !known.contains(word)) {
                    Some(unknown) => Err(Error::unknown_name(field.path, unknown, "one of", known)),
                    None => Ok(Self::Words(ChoiceWords {
                        path: field.path.to_owned(),
                        words: given.into_iter().map(str::to_owned).collect(),
                    })),
                }
            }
        }
    }

    /// Dotted path in the job.
    pub fn path(&self) -> &str {
        match self {
            Self::Range(range) => &range.path,
            Self::Numbers(listed) => &listed.path,
            Self::Words(choice) => &choice.path,
        }
    }

    /// Number of values.
    pub fn count(&self) -> usize {
        match self {
            Self::Range(range) => range.count,
            Self::Numbers(listed) => listed.values.len(),
            Self::Words(choice) => choice.words.len(),
        }
    }

    /// One of its values.
    pub fn at(&self, index: usize) -> Taken {
        match self {
            Self::Range(range) => Taken::Number(range.at(index)),
            Self::Numbers(listed) => Taken::Number(listed.values[index]),
            Self::Words(choice) => Taken::Word(choice.words[index].clone()),
        }
    }
}
