//! The pipeline as a rule: a stage uses nothing to its right, and only `lib.rs` knows `wasm`. Files have a length to
//! be read in, those of the page as well.

use std::path::Path;

/// The modules from left to right. The job is read first, but its fields and its setup name things
/// that the stages offer (robots, materials, shapes), so these stand to its left. `column` is the
/// currency of report, charts and files.
const ORDER: [&str; 31] = [
    "math",
    "units",
    "spread",
    "model",
    "error",
    "column",
    "progress",
    "at_once",
    "robot",
    "path",
    "motion",
    "stock",
    "cutting",
    "job",
    "setup",
    "plan",
    "deviation",
    "compensation",
    "uncertainty",
    "surface",
    "online",
    "report",
    "placement",
    "simulation",
    "study",
    "identify",
    "learn",
    "evidence",
    "chart",
    "export",
    "verification",
];

fn files(folder: &Path, found: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs" || ending == "js") {
            found.push(path);
        }
    }
}

#[test]
fn no_stage_uses_one_to_its_right() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    files(&source, &mut found);
    assert!(found.len() > 30, "the walk finds the sources");
    let mut uses = 0;
    for file in found {
        let inside = file.strip_prefix(&source).unwrap();
        let module = inside.iter().next().unwrap().to_str().unwrap().trim_end_matches(".rs");
        if ["lib", "wasm"].contains(&module) {
            continue;
        }
        let own = ORDER.iter().position(|name| *name == module);
        let own = own.unwrap_or_else(|| panic!("{module} has no place in the pipeline"));
        let text = std::fs::read_to_string(&file).unwrap();
        for (number, line) in text.lines().enumerate() {
            let code = line.split("//").next().unwrap();
            for used in code.split("crate::").skip(1) {
                let used: String = used.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                let place = ORDER.iter().position(|name| *name == used);
                let allowed = place.is_some_and(|place| place <= own);
                assert!(allowed, "{}:{}: {module} uses {used}", inside.display(), number + 1);
                uses += 1;
            }
        }
    }
    assert!(uses > 50, "the walk finds the uses");
}

#[test]
fn files_stay_readable_in_one_sitting() {
    for (folder, least, most) in [("src", 150, 450), ("web/js", 100, 400)] {
        let mut found = Vec::new();
        files(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder), &mut found);
        assert!(found.len() > least, "the walk finds the files of {folder}");
        for file in found {
            let lines = std::fs::read_to_string(&file).unwrap().lines().count();
            assert!(lines <= most, "{} has {lines} lines, {most} at most", file.display());
        }
    }
}

/// A file of tests that no program names would never run.
#[test]
fn every_file_of_tests_is_run() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let manifest = include_str!("../Cargo.toml");
    let program = include_str!("native.rs");
    let mut seen = 0;
    for entry in std::fs::read_dir(&tests).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        let of_tests = path.extension().is_some_and(|ending| ending == "rs") || path.join("mod.rs").is_file();
        if of_tests {
            let named = program.contains(&format!("\nmod {name};\n"))
                || manifest.contains(&format!("[[test]]\nname = \"{name}\"\n"));
            assert!(named, "tests/native.rs does not name {name}");
            seen += 1;
        }
    }
    assert!(seen > 50, "{seen}");
}

/// Types that mirror a section of the job's JSON keep its name and are read as `job::Tool`; so are
/// the options of the three readers.
const READ_WITH_THEIR_MODULE: [&str; 12] = [
    "Branch",
    "Compensation",
    "Frame",
    "Material",
    "Motion",
    "Opw",
    "Options",
    "Path",
    "Robot",
    "Shaper",
    "Tool",
    "Identified",
];

/// Names of the types that a file defines, except associated types.
fn types(text: &str) -> impl Iterator<Item = String> {
    text.lines().filter_map(|line| {
        let code = line.trim_start_matches("pub(crate) ").trim_start_matches("pub(super) ");
        let code = code.trim_start_matches("pub ");
        let rest = ["struct ", "enum ", "trait ", "type "].iter().find_map(|word| code.strip_prefix(word))?;
        let end = rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len());
        Some(rest[..end].to_owned())
    })
}

#[test]
fn a_type_name_has_one_meaning() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    files(&source, &mut found);
    let mut owners = std::collections::BTreeMap::<String, Vec<String>>::new();
    for file in found {
        for name in types(&std::fs::read_to_string(&file).unwrap()) {
            owners.entry(name).or_default().push(file.display().to_string());
        }
    }
    assert!(owners.len() > 150, "the walk finds the types");
    for (name, files) in owners.iter().filter(|(name, _)| !READ_WITH_THEIR_MODULE.contains(&name.as_str())) {
        assert!(files.len() == 1, "{name} stands in {files:?}");
    }
}
