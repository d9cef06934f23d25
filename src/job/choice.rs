//! A number, or a keyword for a rule that yields one.

use crate::error::Error;
use crate::job::json::{Node, Read};
use serde::Serialize;

/// A number, or a keyword for a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Choice<W> {
    /// The keyword.
    Word,
    /// The number.
    Value(f64, std::marker::PhantomData<W>),
}

/// The keyword of a [`Choice`].
pub trait Keyword {
    /// As written in the JSON.
    const WORD: &'static str;
}

/// `"settle"`: until the shaped command has settled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settle;
impl Keyword for Settle {
    const WORD: &'static str = "settle";
}
/// `"from_feed"`: feed divided by the tooth passing frequency.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FromFeed;
impl Keyword for FromFeed {
    const WORD: &'static str = "from_feed";
}

/// `"ball"`: half the tool's diameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ball;
impl Keyword for Ball {
    const WORD: &'static str = "ball";
}
/// `"mean"`: the mean chip thickness of the cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mean;
impl Keyword for Mean {
    const WORD: &'static str = "mean";
}

/// `"median"`: the median along the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Median;
impl Keyword for Median {
    const WORD: &'static str = "median";
}

/// `"unknown"`: not known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unknown;
impl Keyword for Unknown {
    const WORD: &'static str = "unknown";
}

/// `"library"`: what the library says of the robot or material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Library;
impl Keyword for Library {
    const WORD: &'static str = "library";
}

/// `"tolerance"`: as large as the tolerance allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ByTolerance;
impl Keyword for ByTolerance {
    const WORD: &'static str = "tolerance";
}

/// `"chosen"`: the gain for which no error grows by more than 1.7 times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ChosenGain;
impl Keyword for ChosenGain {
    const WORD: &'static str = "chosen";
}

/// `"unlimited"`: without a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unlimited;
impl Keyword for Unlimited {
    const WORD: &'static str = "unlimited";
}

/// Time at rest in a corner [s], or `"settle"`.
pub type CornerDwell = Choice<Settle>;
/// Feed per tooth [mm], or `"from_feed"`.
pub type FeedPerTooth = Choice<FromFeed>;

/// Mean force to hold [N], or `"median"`.
pub type HeldForce = Choice<Median>;
/// Corner radius of a tool [mm], or `"ball"`.
pub type CornerRadius = Choice<Ball>;
/// Spindle power [kW], or `"unknown"`.
pub type SpindlePower = Choice<Unknown>;
/// Spindle torque [N m], or `"unknown"`.
pub type SpindleTorque = Choice<Unknown>;
/// Least or largest chip thickness of a tool [mm], or `"unknown"`.
pub type ChipLimit = Choice<Unknown>;
/// Diameter of a tool holder [mm], or `"unknown"`.
pub type HolderDiameter = Choice<Unknown>;
/// Mass of a load [kg], or `"unknown"`.
pub type LoadMass = Choice<Unknown>;
/// Blending distance [mm], or `"tolerance"`.
pub type BlendingDistance = Choice<ByTolerance>;
/// 95 % range to each side [%], or `"library"`.
pub type SpreadPercent = Choice<Library>;
/// Integral gain of a loop, or `"chosen"`.
pub type LoopGain = Choice<ChosenGain>;
/// Largest correction of a loop [mm], or `"unlimited"`.
pub type LargestCorrection = Choice<Unlimited>;
/// Chip thickness [mm], or `"mean"`.
pub type ChipThickness = Choice<Mean>;

impl<W> Default for Choice<W> {
    fn default() -> Self {
        Self::value(0.0)
    }
}

impl<W> Choice<W> {
    /// A number.
    pub fn value(value: f64) -> Self {
        Self::Value(value, std::marker::PhantomData)
    }

    /// Its number; `None` of the keyword.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Value(value, _) => Some(*value),
            Self::Word => None,
        }
    }
}

impl<W: Keyword> Serialize for Choice<W> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Choice::Word => serializer.serialize_str(W::WORD),
            Choice::Value(value, _) => serializer.serialize_f64(*value),
        }
    }
}

impl<W: Keyword> Read for Choice<W> {
    fn read(&mut self, node: &Node) -> Result<(), Error> {
        let unexpected = || node.error(&format!("expected a number or \"{}\"", W::WORD));
        *self = match node.is_text() {
            false => Self::value(node.value().map_err(|_| unexpected())?),
            true if node.value::<String>()? == W::WORD => Self::Word,
            true => return Err(unexpected()),
        };
        Ok(())
    }
}

/// Declares an enumeration in the job, with the JSON word of each value.
macro_rules! choice {
    ($(#[$doc:meta])* $name:ident { $($(#[$item_doc:meta])* $item:ident = $word:literal),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
        pub enum $name { $($(#[$item_doc])* $item),+ }

        impl $name {
            /// The word in the JSON.
            pub fn word(self) -> &'static str {
                match self { $($name::$item => $word),+ }
            }
        }

        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.word())
            }
        }

        impl $crate::job::json::Read for $name {
            fn read(&mut self, node: &$crate::job::json::Node) -> Result<(), $crate::error::Error> {
                let all = [$($name::$item),+];
                *self = all[node.one_of(&all.map($name::word))?];
                Ok(())
            }
        }
    };
}
pub(super) use choice;
