//! Programs in other languages, named as what they are.

use crate::error::Error;
use crate::path::lines::TextLines;

/// How a line of another language begins, the language, and what to do.
const LANGUAGES: [(&str, &str, &str); 12] = [
    ("0 BEGIN PGM", "Heidenhain Klartext", HEIDENHAIN),
    ("BEGIN PGM", "Heidenhain Klartext", HEIDENHAIN),
    ("DEF ", "a KUKA KRL program", ROBOT),
    ("&ACCESS", "a KUKA KRL program", ROBOT),
    ("MODULE ", "an ABB RAPID program", ROBOT),
    ("PROC ", "an ABB RAPID program", ROBOT),
    ("/PROG", "a FANUC TP program", ROBOT),
    ("PARTNO", "an APT program", APT),
    ("MULTAX", "an APT program", APT),
    ("GOTO/", "an APT program", APT),
    ("UNITS/", "an APT program", APT),
    ("TOOL PATH/", "an APT program", APT),
];
const HEIDENHAIN: &str = "Klartext is not supported: post the program as ISO (G-code) or as APT";
const ROBOT: &str = "robot programs are not supported: open the milling program it was made from";
const APT: &str = "choose APT as the kind of the program";
/// Lines that are looked at.
const LOOKED_AT: usize = 20;

/// Fails at the first line that belongs to another language.
///
/// # Errors
/// [`Error::Text`] with the name of the language.
pub(super) fn check(text: &str, field: &str) -> Result<(), Error> {
    for (index, line) in TextLines::of(text).take(LOOKED_AT).enumerate() {
        let content = line.trim_start();
        let start = content.to_ascii_uppercase();
        // `PARTNO /` and `PARTNO/` are the same.
        let tight = start.replace(" /", "/");
        let known = LANGUAGES.iter().find(|(sign, ..)| tight.starts_with(sign) && !is_definition(&start));
        if let Some((_, name, expected)) = known {
            return Err(Error::Text {
                field: field.into(),
                line: index + 1,
                column: line[..line.len() - content.len()].chars().count() + 1,
                found: (*name).into(),
                expected: (*expected).into(),
            });
        }
    }
    Ok(())
}

/// Whether a line declares a variable of a Siemens program.
fn is_definition(line: &str) -> bool {
    ["DEF REAL", "DEF INT", "DEF BOOL", "DEF STRING", "DEF CHAR", "DEF AXIS", "DEF FRAME"]
        .iter()
        .any(|start| line.starts_with(start))
}
