//! The static site: the core as WebAssembly, and the files of `web/` around it.

pub(crate) mod folder;
mod policy;
pub(crate) mod core;
pub(crate) mod gallery;
mod modules;
mod offline;
mod page;
mod standalone;

use std::path::PathBuf;

use anyhow::Result;

use crate::workspace;
use folder::{mirror, update};

pub(crate) use policy::POLICY;

/// Folder of the site with the core.
pub(crate) const PKG: &str = "pkg";

/// The whole site in one file.
const STANDALONE: &str = "standalone.html";

/// Makes the site in `target/site` and returns that folder. Files that are up to date stay
/// untouched.
///
/// # Errors
/// If the core does not compile, a tool is missing, or a file cannot be read or written.
pub(crate) fn build() -> Result<PathBuf> {
    let root = workspace::root()?;
    let (site, pkg) = (root.join("target/site"), root.join("target/core"));
    core::make(&root, core::PACKAGE, &pkg)?;
    core::weigh(&pkg.join(core::MODULE), core::LIMITS)?;
    let (web, joined) = (root.join("web"), root.join("target/page"));
    page::join(&web, &pkg, &joined)?;
    mirror(&joined, &site, &[PKG, STANDALONE, offline::WORKER])?;
    mirror(&pkg, &site.join(PKG), &[])?;
    update(standalone::page(&web, &pkg)?.as_bytes(), &site.join(STANDALONE))?;
    // Last, because it names the content of all other files.
    update(offline::script(&web, &pkg, &site)?.as_bytes(), &site.join(offline::WORKER))?;
    println!("The site is in target/site");
    Ok(site)
}
