//! Checks that the same sources give the same core, in any folder and on any machine.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use sha2::{Digest, Sha256};

use crate::site::{core, folder::update};
use crate::workspace::{self, root};

/// Builds the core from copies of the sources in two folders with names of different length, each
/// with its own target folder. Compares the two with each other, and searches them for paths of
/// this machine. Prints the hash.
///
/// # Errors
/// If a byte differs, or a path of this machine is found.
pub(crate) fn reproduce() -> Result<()> {
    let place = root()?.join("target/reproduce");
    let folders = ["a", "another/folder"].map(|name| place.join(name));
    // Both copies first: the sources may change meanwhile.
    folders.iter().try_for_each(|folder| copy_sources(folder))?;
    let [one, other] = folders.each_ref().map(|folder| built(folder));
    let (one, other) = (one?, other?);
    ensure!(one == other, "the core depends on the folder it is built in");
    for path in [Some(root()?), workspace::cargo_home(), std::env::home_dir()].into_iter().flatten() {
        ensure!(!names(&one, &path), "the core names {}", path.display());
    }
    let hash: String = Sha256::digest(&one).iter().map(|byte| format!("{byte:02x}")).collect();
    println!("The core has the same {} bytes from both folders, SHA-256 {hash}", one.len());
    println!(
        "With {}",
        workspace::output("rustc", &["--version"]).context("rustc does not report its version")?
    );
    Ok(())
}

/// The core, built from the sources in a folder.
fn built(folder: &Path) -> Result<Vec<u8>> {
    let made = folder.join("target/core");
    core::make(folder, core::PACKAGE, &made)?;
    fs::read(made.join(core::MODULE)).with_context(|| format!("cannot read {}", made.display()))
}

/// Copies the sources as they are now, committed or not.
fn copy_sources(folder: &Path) -> Result<()> {
    let listed = workspace::output("git", &["ls-files", "--cached", "--others", "--exclude-standard"]);
    for file in listed.context("git does not list the sources")?.lines() {
        let (from, to) = (root()?.join(file), folder.join(file));
        if from.is_file() {
            fs::create_dir_all(to.parent().unwrap_or(folder))?;
            update(&fs::read(&from)?, &to).with_context(|| format!("cannot copy {file}"))?;
        }
    }
    Ok(())
}

/// Whether a path occurs anywhere in a module.
fn names(module: &[u8], path: &Path) -> bool {
    let path = path.as_os_str().as_encoded_bytes();
    // The root of a file system, which is some users' home, occurs in any text.
    path.len() > 1 && module.windows(path.len()).any(|part| part == path)
}

#[cfg(test)]
mod tests {
    use super::names;
    use std::path::Path;

    #[test]
    fn a_path_is_found_wherever_it_stands() {
        assert!(names(b"\0asm..../some/folder/src/lib.rs", Path::new("/some/folder")));
        assert!(!names(b"\0asm....src/lib.rs", Path::new("/some/folder")));
        assert!(!names(b"\0asm..../x", Path::new("/")));
    }
}
