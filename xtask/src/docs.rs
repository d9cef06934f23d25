//! The documentation with the calculator in it: the crate's own pages and the book, side by side
//! with the site.

use std::path::PathBuf;

use anyhow::Result;

use crate::site::{self, folder::mirror};
use crate::workspace::{self, cargo, run};

/// Makes `target/docs` with `calculator/` (the site), `rustdoc/` and `book/`, and returns that
/// folder. Their pages link to each other by relative addresses, so the folder may be served from
/// anywhere.
///
/// # Errors
/// If something does not compile, or a file cannot be read or written.
pub(crate) fn build() -> Result<PathBuf> {
    let docs = workspace::root()?.join("target/docs");
    mirror(&site::build()?, &docs.join("calculator"), &[])?;
    let flags = ["doc", "--locked", "--no-deps", "--package", "armill", "--lib", "--target-dir", "target"];
    run(&mut cargo(&flags)?)?;
    mirror(&workspace::root()?.join("target/doc"), &docs.join("rustdoc"), &[])?;
    run(cargo(&["run", "--locked", "--quiet", "--package", "armill-docs", "--"])?.arg(docs.join("book")))?;
    println!("The documentation is in target/docs");
    Ok(docs)
}
