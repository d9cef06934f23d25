//! Checks Armill's dependencies: licences, sources and known faults, by the rules in `deny.toml`,
//! which `cargo deny` reads too. cargo-deny as a library would double this tool's compile time.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail, ensure};
use rustsec::report::Settings;
use rustsec::{Database, Lockfile, Report};
use serde_json::Value;
use spdx::{Expression, Licensee, ParseMode};

use crate::workspace::{self, root};

/// Where known faults of Rust crates are published.
const ADVISORIES: &str = "https://github.com/rustsec/advisory-db";

/// Checks every package in `Cargo.lock`, for all targets and features.
///
/// # Errors
/// If a package breaks a rule or has a known fault. A failure to fetch the list of faults is
/// printed, but is not an error.
pub(crate) fn audit() -> Result<()> {
    let rules: toml::Table = toml::from_str(&fs::read_to_string(root()?.join("deny.toml"))?)?;
    let metadata = workspace::output("cargo", &["metadata", "--locked", "--format-version", "1"])
        .context("cargo does not list the packages")?;
    let metadata: Value = serde_json::from_str(&metadata)?;
    let packages = metadata["packages"].as_array().context("no packages")?;
    let faults = broken(packages, &rules)?;
    ensure!(faults.is_empty(), "deny.toml forbids:\n  {}", faults.join("\n  "));
    println!("Licences and sources of {} packages are as deny.toml allows", packages.len());
    match database() {
        Ok(folder) => known_faults(&folder, &rules),
        Err(error) => {
            println!(
                "SKIPPED: known vulnerabilities were not checked, because {ADVISORIES} cannot be fetched: {error:#}"
            );
            Ok(())
        }
    }
}

/// The strings in a list of the rules.
fn strings<'a>(rules: &'a toml::Table, section: &str, key: &str) -> Result<Vec<&'a str>> {
    let list = rules.get(section).and_then(|section| section.get(key)).and_then(toml::Value::as_array);
    let list = list.with_context(|| format!("deny.toml has no list {section}.{key}"))?;
    list.iter()
        .map(|item| item.as_str().with_context(|| format!("{section}.{key} must hold strings")))
        .collect()
}

/// The violations of the rules among these packages, as listed by `cargo metadata`.
fn broken(packages: &[Value], rules: &toml::Table) -> Result<Vec<String>> {
    let licences = strings(rules, "licenses", "allow")?
        .into_iter()
        .map(|name| Licensee::parse(name).map_err(|error| anyhow::anyhow!("deny.toml: {error}")))
        .collect::<Result<Vec<_>>>()?;
    let registries = strings(rules, "sources", "allow-registry")?;
    let mut faults = Vec::new();
    for package in packages {
        let text = |key: &str| package[key].as_str().unwrap_or_default();
        let name = format!("{} {}", text("name"), text("version"));
        let licence = Expression::parse_mode(text("license"), ParseMode::LAX);
        if !licence.is_ok_and(|all| all.evaluate(|one| licences.iter().any(|allowed| allowed.satisfies(one))))
        {
            faults.push(format!("{name}: licence `{}`", text("license")));
        }
        let source = text("source"); // empty for packages in the checkout
        let known = registries.iter().any(|registry| source == format!("registry+{registry}"));
        if !source.is_empty() && !known {
            faults.push(format!("{name}: source `{source}`"));
        }
        let wild = |dependency: &&Value| dependency["req"] == "*" && dependency["path"].is_null();
        for dependency in package["dependencies"].as_array().into_iter().flatten().filter(wild) {
            if source.is_empty() {
                faults.push(format!("{name}: any version of {}", dependency["name"]));
            }
        }
    }
    Ok(faults)
}

/// The published faults, fetched now.
fn database() -> Result<PathBuf> {
    let folder = root()?.join("target/advisory-db");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    let output = Command::new("git")
        .args(["clone", "--quiet", "--depth", "1", ADVISORIES])
        .arg(&folder)
        .env("GIT_TERMINAL_PROMPT", "0")
        .stdin(Stdio::null())
        .output()
        .context("cannot start git")?;
    if !output.status.success() {
        bail!("{}", String::from_utf8_lossy(&output.stderr).trim().lines().last().unwrap_or("git failed"));
    }
    Ok(folder)
}

/// Looks up every package of `Cargo.lock`. Crates without a maintainer and the like are printed,
/// faults are errors.
fn known_faults(database: &Path, rules: &toml::Table) -> Result<()> {
    let ignore = strings(rules, "advisories", "ignore")?.into_iter().map(str::parse);
    let settings = Settings { ignore: ignore.collect::<std::result::Result<_, _>>()?, ..Settings::default() };
    let lockfile = Lockfile::load(root()?.join("Cargo.lock"))?;
    let database = Database::open(database)?;
    let report = Report::generate(&database, &lockfile, &settings);
    for warning in report.warnings.values().flatten() {
        let title = warning.advisory.as_ref().map_or("", |advisory| advisory.title.as_str());
        println!("{} {}: {}: {title}", warning.package.name, warning.package.version, warning.kind.as_str());
    }
    let found = report.vulnerabilities.list.iter().map(|fault| {
        let (package, advisory) = (&fault.package, &fault.advisory);
        format!("{} {}: {} {}", package.name, package.version, advisory.id, advisory.title)
    });
    let found: Vec<String> = found.collect();
    ensure!(found.is_empty(), "known vulnerabilities:\n  {}", found.join("\n  "));
    println!("None of {} published vulnerabilities affects Cargo.lock", database.iter().count());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn rules() -> toml::Table {
        let text = "[advisories]\nignore = []\n[licenses]\nallow = ['MIT', 'Apache-2.0']\n[sources]\nallow-registry = ['https://crates']";
        toml::from_str(text).unwrap()
    }

    #[test]
    fn what_the_rules_do_not_allow_is_told() {
        let package = |licence: &str, source: Value| {
            json!({
                "name": "a", "version": "1.0.0", "license": licence, "source": source, "dependencies": []
            })
        };
        let own = json!({ "name": "own", "version": "0.1.0", "license": "MIT", "dependencies": [
            { "name": "b", "req": "*" },
            { "name": "c", "req": "*", "path": "/c" },
            { "name": "d", "req": "^1" },
        ] });
        let registry = || json!("registry+https://crates");
        let packages = [
            package("MIT/Apache-2.0", registry()),
            package("GPL-3.0 OR MIT", Value::Null),
            package("GPL-3.0", registry()),
            package("MIT AND GPL-3.0-only", registry()),
            package("", registry()),
            package("MIT", json!("git+https://elsewhere")),
            own,
        ];
        let found = broken(&packages, &rules()).unwrap();
        let wanted = [
            "a 1.0.0: licence `GPL-3.0`",
            "a 1.0.0: licence `MIT AND GPL-3.0-only`",
            "a 1.0.0: licence ``",
            "a 1.0.0: source `git+https://elsewhere`",
            "own 0.1.0: any version of \"b\"",
        ];
        assert_eq!(found, wanted);
    }

    #[test]
    fn a_known_fault_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let crates = folder.path().join("crates/anyhow");
        fs::create_dir_all(&crates).unwrap();
        let advisory = |patched: &str| {
            format!(
                "```toml\n[advisory]\nid = \"RUSTSEC-2020-0001\"\npackage = \"anyhow\"\ndate = \"2020-01-01\"\n\n\
                 [versions]\npatched = [\"{patched}\"]\n```\n\n# A fault\n\nIt is made up.\n"
            )
        };
        let file = crates.join("RUSTSEC-2020-0001.md");
        fs::write(&file, advisory(">= 99.0.0")).unwrap();
        let error = known_faults(folder.path(), &rules()).unwrap_err().to_string();
        assert!(error.contains("anyhow") && error.contains("RUSTSEC-2020-0001 A fault"), "{error}");
        fs::write(&file, advisory(">= 1.0.0")).unwrap();
        known_faults(folder.path(), &rules()).unwrap();
    }
}
