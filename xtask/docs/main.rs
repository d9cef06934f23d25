//! Builds the book in `xtask/docs/book` into the given folder, like `mdbook build --dest-dir`.

use std::path::Path;

use anyhow::{Context, Result};
use mdbook_driver::MDBook;

fn main() -> Result<()> {
    let folder = std::env::args_os().nth(1).context("which folder shall the book be built into?")?;
    let mut book = MDBook::load(Path::new(env!("CARGO_MANIFEST_DIR")).join("book"))?;
    book.config.build.build_dir = folder.into();
    book.build()
}
