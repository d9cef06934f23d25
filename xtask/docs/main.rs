//! Builds the book in `docs/` into the given folder, like `mdbook build --dest-dir`.

use std::path::Path;

use anyhow::{Context, Result};
use mdbook_driver::MDBook;

fn main() -> Result<()> {
    let folder = std::env::args_os().nth(1).context("name the folder to build the book in")?;
    let mut book = MDBook::load(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs"))?;
    book.config.build.build_dir = folder.into();
    book.build()
}
