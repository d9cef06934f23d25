//! The service worker, which keeps the site in the browser: its script carries the hash of every
//! file, and a version that is a hash of all of them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use sha2::{Digest, Sha256};

use super::STANDALONE;
use super::folder::entries;
use super::modules::Script;
use super::page::text_of;

/// The hash of each file, as `fetch` checks it, by the file's path in the site.
type Hashes = BTreeMap<String, String>;

/// The script's name in the site: it serves the folder that it is in.
pub(super) const WORKER: &str = "service-worker.js";

/// The module that [`script`] replaces.
const RELEASE: &str = "js/core/release.js";

/// What is not kept: the script itself, which the browser keeps; the one-file page, which is a copy of
/// the rest to be saved; and what only compilers read. `embed.html` is kept, or it would get the core
/// of another version.
fn is_kept(path: &str) -> bool {
    path != WORKER && path != STANDALONE && !path.ends_with(".d.ts")
}

/// The service worker for the files in `site`.
///
/// # Errors
/// If a file cannot be read, or its name would have to be escaped in an address.
pub(super) fn script(web: &Path, pkg: &Path, site: &Path) -> Result<String> {
    let mut files = Hashes::new();
    add(site, "", &mut files)?;
    let (version, list) = (version(&files), serde_json::to_string_pretty(&files)?);
    let release = format!("export const VERSION = \"{version}\";\nexport const FILES = {list};\n");
    let read = |path: &Path| {
        if path == Path::new(RELEASE) { Ok(release.clone()) } else { text_of(web, pkg, path) }
    };
    Ok(Script::new(Path::new("js/service-worker.js"), None, &read)?.text)
}

/// Adds the hashes of the files in `folder`, whose path in the site is `prefix`.
fn add(folder: &Path, prefix: &str, files: &mut Hashes) -> Result<()> {
    for entry in entries(folder)? {
        let name = entry.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let path = format!("{prefix}{name}");
        if entry.is_dir() {
            add(&entry, &format!("{path}/"), files)?;
        } else if is_kept(&path) {
            let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_.".contains(letter);
            ensure!(name.chars().all(plain), "{path} would have to be escaped in an address");
            let content = fs::read(&entry).with_context(|| format!("cannot read {}", entry.display()))?;
            files.insert(path, format!("sha256-{}", BASE64_STANDARD.encode(Sha256::digest(content))));
        }
    }
    Ok(())
}

/// A hash of the paths and hashes of all files, in hexadecimal.
fn version(files: &Hashes) -> String {
    let lines: String = files.iter().map(|(path, hash)| format!("{path} {hash}\n")).collect();
    let digest = Sha256::digest(lines);
    digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn site() -> tempfile::TempDir {
        let site = tempfile::tempdir().unwrap();
        fs::create_dir(site.path().join("js")).unwrap();
        for (file, text) in [
            ("index.html", "<p>"),
            ("js/main.js", "1"),
            ("js/types.d.ts", "type A"),
            (WORKER, "old"),
            (STANDALONE, "all"),
        ] {
            fs::write(site.path().join(file), text).unwrap();
        }
        site
    }

    fn files_of(site: &Path) -> Hashes {
        let mut files = Hashes::new();
        add(site, "", &mut files).unwrap();
        files
    }

    fn version_of(site: &Path) -> String {
        version(&files_of(site))
    }

    #[test]
    fn the_version_is_that_of_the_kept_files_alone() {
        let (one, two) = (site(), site());
        let (one, two) = (one.path(), two.path());
        assert_eq!(files_of(one).keys().collect::<Vec<_>>(), ["index.html", "js/main.js"]);
        let first = version_of(one);
        assert!(first.len() == 16 && first.chars().all(|digit| digit.is_ascii_hexdigit()), "{first}");
        assert_eq!(version_of(two), first, "equal files");
        for file in [WORKER, STANDALONE, "js/types.d.ts"] {
            fs::write(two.join(file), "changed").unwrap();
            assert_eq!(version_of(two), first, "{file} is not kept");
        }
        let mut seen = vec![first.clone()];
        for file in ["index.html", "js/main.js", "js/added.js"] {
            fs::write(two.join(file), "changed").unwrap();
            let next = version_of(two);
            assert!(!seen.contains(&next), "{file}");
            seen.push(next);
        }
        fs::rename(two.join("js/added.js"), two.join("js/renamed.js")).unwrap();
        assert!(!seen.contains(&version_of(two)), "another name");
        for (file, text) in [("index.html", "<p>"), ("js/main.js", "1")] {
            fs::write(two.join(file), text).unwrap();
        }
        fs::remove_file(two.join("js/renamed.js")).unwrap();
        assert_eq!(version_of(two), first, "as it was");
    }

    #[test]
    fn a_name_that_an_address_escapes_is_refused() {
        let site = site();
        fs::write(site.path().join("js/a b.js"), "").unwrap();
        let error = add(site.path(), "", &mut Hashes::new()).unwrap_err().to_string();
        assert!(error.contains("js/a b.js"), "{error}");
    }

    #[test]
    fn the_hash_is_the_one_that_fetch_checks() {
        let site = tempfile::tempdir().unwrap();
        fs::write(site.path().join("a.txt"), "abc").unwrap();
        // FIPS 180-4's example, in base64.
        let expected = "sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=";
        assert_eq!(files_of(site.path())["a.txt"], expected);
    }

    #[test]
    fn the_script_has_the_list_and_needs_no_other_file() {
        let root: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("");
        let site = site();
        let text = script(&root.join("web"), Path::new("none"), site.path()).unwrap();
        assert!(
            text.contains(&version_of(site.path())) && text.contains("\"js/main.js\": \"sha256-"),
            "{text}"
        );
        for beside in ["\nimport ", "\nexport ", "import("] {
            assert!(!text.contains(beside), "{beside}");
        }
    }
}
