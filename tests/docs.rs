//! README and docs hold what is true: their commands run, their jobs compute, their links lead
//! somewhere, and the tutorial's answers are the answers.

use armill::Progress;
use armill::verification::Programs;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

/// Path and text of the pages that people read.
fn pages() -> Vec<(PathBuf, String)> {
    let mut paths = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "xtask/npm/README.md"]
        .map(|name| root().join(name))
        .to_vec();
    let docs = fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().path());
    paths.extend(docs.filter(|path| path.extension().is_some_and(|ending| ending == "md")));
    let pages: Vec<_> =
        paths.into_iter().map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect();
    assert!(pages.len() > 10);
    pages
}

fn page(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap()
}

/// The code blocks of a page in one language.
fn blocks(text: &str, language: &str) -> Vec<String> {
    let mut blocks = Vec::new();
    let mut open: Option<(bool, String)> = None;
    for line in text.lines() {
        match (&mut open, line.trim_start().strip_prefix("```")) {
            (None, Some(named)) => open = Some((named == language, String::new())),
            (None, None) => (),
            (Some((_, block)), None) => {
                block.push_str(line);
                block.push('\n');
            }
            (Some(_), Some(_)) => {
                blocks.extend(open.take().filter(|(wanted, _)| *wanted).map(|(_, block)| block))
            }
        }
    }
    assert!(open.is_none(), "a block is not closed");
    blocks
}

/// The shell commands in a page's blocks and the `cargo ...` in its running text.
fn commands(text: &str) -> Vec<String> {
    let of_block = |block: &String| block.lines().map(str::to_owned).collect::<Vec<_>>();
    let shell = blocks(text, "sh").iter().flat_map(of_block).collect::<Vec<_>>();
    let spans =
        text.split('`').skip(1).step_by(2).filter(|span| span.contains("cargo ") && !span.contains('\n'));
    shell
        .into_iter()
        .chain(spans.map(str::to_owned))
        .map(|line| line.split(" #").next().unwrap().trim().to_owned())
        .filter(|line| !line.is_empty())
        .collect()
}

#[test]
fn every_example_command_runs() {
    let mut run = 0;
    fs::create_dir_all(root().join("target")).unwrap();
    for (path, text) in pages() {
        for command in commands(&text) {
            let Some(arguments) = command.strip_prefix("cargo run --release --example ") else { continue };
            let mut cargo = Command::new(env!("CARGO"));
            cargo.args(["run", "--quiet", "--locked", "--example"]).args(arguments.split_whitespace());
            let output = cargo.current_dir(root()).output().unwrap();
            let place = format!("{}: {command}", path.display());
            assert!(output.status.success(), "{place}: {}", String::from_utf8_lossy(&output.stderr));
            assert!(serde_json::from_slice::<Value>(&output.stdout).unwrap().is_object(), "{place}");
            run += 1;
        }
    }
    assert!(run >= 8, "{run}");
}

#[test]
fn every_cargo_command_names_what_is_there() {
    let tasks = page("xtask/src/main.rs");
    let mut known = 0;
    for (path, text) in pages() {
        for command in commands(&text) {
            let words: Vec<&str> = command.split_whitespace().skip_while(|word| *word != "cargo").collect();
            let place = format!("{}: {command}", path.display());
            if let ["cargo", "xtask", task, ..] = words.as_slice() {
                assert!(tasks.contains(&format!("[\"{task}\"")), "{place}");
                known += 1;
            }
            for pair in words.windows(2) {
                let files = match pair {
                    ["--test", name] => [format!("tests/{name}.rs"), String::from("-")],
                    ["--example", name] => [format!("examples/{name}.rs"), String::from("-")],
                    _ => continue,
                };
                assert!(files.iter().any(|file| root().join(file).is_file()), "{place}");
                known += 1;
            }
        }
    }
    assert!(known > 30, "{known}");
}

#[test]
fn links_and_named_files_exist() {
    let mut links = 0;
    for (path, text) in pages() {
        for target in text.split("](").skip(1).map(|rest| rest.split(')').next().unwrap()) {
            if !target.contains("://") {
                let file = path.parent().unwrap().join(target.split('#').next().unwrap());
                assert!(file.exists(), "{}: {target}", path.display());
                links += 1;
            }
        }
        let is_path = |span: &&str| {
            ["src/", "web/", "tests/", "docs/", "xtask/src/", "examples/"]
                .iter()
                .any(|folder| span.starts_with(folder))
                && span.chars().all(|c| c.is_ascii_alphanumeric() || "/._-".contains(c))
        };
        for span in text.split('`').skip(1).step_by(2).filter(is_path) {
            assert!(root().join(span).exists(), "{}: {span}", path.display());
        }
    }
    assert!(links > 20, "{links}");
}

#[test]
fn every_job_in_the_docs_computes() {
    let jobs = |(path, text): (PathBuf, String)| {
        blocks(&text, "json").into_iter().map(move |job| (path.clone(), job)).collect::<Vec<_>>()
    };
    let files = fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let files = files
        .filter(|path| path.extension().is_some_and(|ending| ending == "json"))
        .map(|path| (path.clone(), fs::read_to_string(path).unwrap()));
    let all: Vec<_> = pages().into_iter().flat_map(jobs).chain(files).collect();
    assert!(all.len() >= 3);
    for (path, job) in all {
        let report = armill::run_json(&job, &mut Progress::none());
        assert!(report.is_ok(), "{}: {:?}", path.display(), report.err());
    }
}

/// The tutorial's job with some keys changed, and what is answered to it.
fn answers(changes: &[(&str, Value)]) -> (Value, Value) {
    let mut job: Value = serde_json::from_str(&page("docs/bracket.json")).unwrap();
    for (key, value) in changes {
        job[*key] = value.clone();
    }
    let report = armill::run_json(&job.to_string(), &mut Progress::none()).unwrap();
    let package = Programs::default().package(&report, None).unwrap();
    (json!(report.summary()), json!(package))
}

#[test]
fn the_tutorial_says_what_is_answered() {
    let bracket: Value = serde_json::from_str(&page("docs/bracket.json")).unwrap();
    assert_eq!(bracket["path"]["text"], page("web/examples/contour.nc"));
    let (upright, _) = answers(&[("spin", json!({"angle_deg": 0}))]);
    let (turned, _) = answers(&[]);
    let (measured, package) = answers(&[("uncertainty", json!({"stiffness_percent": 10}))]);
    let remedy = &upright["warnings"][0]["remedy"]["patch"];
    assert_eq!(remedy["spin"]["angle_deg"].as_f64(), bracket["spin"]["angle_deg"].as_f64());
    let guessed =
        turned["warnings"].as_array().unwrap().iter().find(|each| each["code"] == "stiffness-assumed");
    let expected = [
        &turned["cut"]["stock"],
        &guessed.unwrap()["message"],
        &upright["verdict"],
        &turned["verdict"],
        &turned["budget"]["sentence"],
        &turned["surface"]["worst"][0]["sentence"],
        &turned["how_sure"]["measure_first"]["sentence"],
        &measured["verdict"],
        &package["sentence"],
        package["remarks"].as_array().unwrap().last().unwrap(),
    ];
    let text = page("docs/tutorial.md");
    let quoted: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("> ")).collect();
    assert_eq!(quoted, expected.map(|value| value.as_str().unwrap()));
    let before = turned["before_mm"]["both"]["max"].as_f64().unwrap();
    assert!(text.contains(&format!("the largest error would be {before:.2} mm")), "{before}");
    for file in package["files"].as_array().unwrap() {
        assert!(text.contains(file["path"].as_str().unwrap()), "{file}");
    }
}

#[test]
fn the_tutorial_s_words_are_the_page_s() {
    fn texts(folder: &Path) -> String {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        entries
            .map(|path| if path.is_dir() { texts(&path) } else { fs::read_to_string(path).unwrap() })
            .collect()
    }
    let shown = texts(&root().join("web/js")) + &page("web/index.html") + &page("src/job/fields.txt");
    let text = page("docs/tutorial.md");
    let words: Vec<&str> = text.split("**").skip(1).step_by(2).collect();
    assert!(words.len() > 20);
    for word in words {
        assert!(shown.contains(word), "{word}");
    }
}
