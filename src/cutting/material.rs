//! Materials: the force that a chip of a given size takes.
//!
//! dF_t = (k_tc h + k_te) dz, likewise radial and axial (eq. 4.1 with the edge terms of Y.
//! Altintas, Manufacturing Automation, 2nd ed. 2012, section 2.8). Kienzle's and orthogonal-cutting
//! materials are converted to such coefficients for one chip thickness.

use crate::cutting::kienzle::Kienzle;
use crate::cutting::oblique::Orthogonal;
use crate::units::{N_PER_MM, N_PER_MM2};
use std::sync::OnceLock;

/// Coefficients of the linear edge-force model.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coefficients {
    /// Tangential cutting coefficient k_tc [N/m^2].
    pub ktc: f64,
    /// Radial cutting coefficient k_rc [N/m^2].
    pub krc: f64,
    /// Axial cutting coefficient k_ac [N/m^2].
    pub kac: f64,
    /// Tangential edge coefficient k_te [N/m].
    pub kte: f64,
    /// Radial edge coefficient k_re [N/m].
    pub kre: f64,
    /// Axial edge coefficient k_ae [N/m].
    pub kae: f64,
}

impl Coefficients {
    /// From ktc, krc, kac [N/mm^2], kte, kre, kae [N/mm], the units of tables.
    pub fn of_table([ktc, krc, kac, kte, kre, kae]: [f64; 6]) -> Self {
        Self {
            ktc: ktc * N_PER_MM2,
            krc: krc * N_PER_MM2,
            kac: kac * N_PER_MM2,
            kte: kte * N_PER_MM,
            kre: kre * N_PER_MM,
            kae: kae * N_PER_MM,
        }
    }
}

/// Force model of a material's numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Model {
    /// Coefficients identified with a tool like the one in use.
    Linear(Coefficients),
    /// Specific cutting force over chip thickness.
    Kienzle(Kienzle),
    /// Shear stress, friction and shear angle, for any helix and rake.
    Orthogonal(Orthogonal),
}

impl Model {
    /// Heading of materials of this kind in lists.
    pub fn heading(&self) -> &'static str {
        match self {
            Model::Linear(_) => "Identified in milling",
            Model::Kienzle(_) => "Catalogue, k_c1.1 and m_c",
            Model::Orthogonal(_) => "Orthogonal cutting data",
        }
    }

    /// Whether the coefficients depend on the chip thickness.
    pub fn needs_chip(&self) -> bool {
        !matches!(self, Model::Linear(_))
    }
}

/// A material of the library.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Key used in jobs.
    pub id: &'static str,
    /// Display name.
    pub name: &'static str,
    /// Its numbers.
    pub model: Model,
    /// Possible error of a force, either way [%].
    pub spread: f64,
    /// How far to trust the record: high, medium or low.
    pub confidence: &'static str,
    /// Where the numbers come from.
    pub source: &'static str,
    /// Further remarks.
    pub remark: &'static str,
}

impl Material {
    /// Source, spread and confidence in a few sentences.
    pub fn note(&self) -> String {
        let Self { source, remark, spread, confidence, .. } = self;
        let gap = if remark.is_empty() { "" } else { " " };
        format!("{source}. {remark}{gap}Take it as ±{spread} %; confidence: {confidence}.")
    }
}

/// All materials, in the order of the data file.
pub fn library() -> &'static [Material] {
    static LIBRARY: OnceLock<Vec<Material>> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        let mut sources = Vec::new();
        let mut materials = Vec::new();
        for line in include_str!("materials.txt").lines() {
            if let Some(source) = line.strip_prefix('@') {
                sources.extend(source.split_once("; "));
            } else {
                materials.extend(material(line, &sources));
            }
        }
        materials
    })
}

/// Parses one line of the data file; `None` for a comment.
fn material(line: &'static str, sources: &[(&'static str, &'static str)]) -> Option<Material> {
    let mut parts = line.split(';').map(str::trim);
    let (id, name, model) = (parts.next()?, parts.next()?, parts.next()?);
    let numbers: Vec<f64> = parts.next()?.split(' ').map_while(|number| number.parse().ok()).collect();
    let model = match model {
        "linear" => Model::Linear(Coefficients::of_table(numbers.try_into().ok()?)),
        "kienzle" => Model::Kienzle(Kienzle::of_table(*numbers.first()?, *numbers.get(1)?)),
        _ => Model::Orthogonal(Orthogonal { numbers: numbers.try_into().ok()? }),
    };
    let spread = parts.next()?.parse().ok()?;
    let confidence = parts.next()?;
    let key = parts.next()?;
    let (_, source) = *sources.iter().find(|(name, _)| *name == key)?;
    Some(Material { id, name, model, spread, confidence, source, remark: parts.next()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_data_file_is_a_material_or_says_what_it_is() {
        let lines = include_str!("materials.txt").lines();
        let materials = lines.filter(|line| !line.starts_with(['#', '@'])).count();
        let library = library();
        assert_eq!(library.len(), materials);
        assert!(materials >= 25);
        for (k, material) in library.iter().enumerate() {
            assert!(["high", "medium", "low"].contains(&material.confidence), "{}", material.id);
            assert!((30.0..=100.0).contains(&material.spread), "{}", material.id);
            assert!(library[..k].iter().all(|other| other.id != material.id), "{} twice", material.id);
        }
    }
}
