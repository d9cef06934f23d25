//! The page's own files: `web/` has many small ones. The site joins them into few, because each
//! takes a request.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};

use super::folder::{entries, mirror, update};
use super::gallery::with_jobs;
use super::modules::Script;

/// The entry scripts of the pages and the Worker. `main.js` shares the modules of `start.js`, which
/// runs first.
const START: &str = "js/start.js";
const MAIN: &str = "js/main.js";
const OTHERS: [&str; 3] = ["js/embed.js", "js/gallery.js", "js/worker.js"];

/// Files that stay separate: the element that other pages import, and the styles without
/// JavaScript.
const ALONE: [&str; 2] = ["js/armill-calculator.js", "css/noscript.css"];

/// How a page links a stylesheet.
const STYLESHEET: &str = "<link rel=\"stylesheet\" href=\"";

/// Fills an empty `folder` with the page in `web`, its scripts and styles joined. `pkg` has the
/// core's module.
///
/// # Errors
/// If a file cannot be read or written, or a script uses syntax that cannot be joined.
pub(super) fn join(web: &Path, pkg: &Path, folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder).with_context(|| format!("cannot remove {}", folder.display()))?;
    }
    for name in ["js", "css"] {
        fs::create_dir_all(folder.join(name))
            .with_context(|| format!("cannot create {}", folder.display()))?;
    }
    let read = |path: &Path| text_of(web, pkg, path);
    let write = |path: &str, text: String| {
        update(text.as_bytes(), &folder.join(path)).with_context(|| format!("cannot write {path}"))
    };
    for entry in entries(web)? {
        let name = entry.file_name().unwrap_or_default();
        let twin = folder.join(name);
        if entry.extension() == Some(OsStr::new("html")) {
            let styles =
                format!("css/{}.css", entry.with_extension("").file_name().unwrap_or_default().display());
            let (html, css) = with_one_stylesheet(&fs::read_to_string(&entry)?, &styles, &read)?;
            write(&name.to_string_lossy(), with_jobs(&html, web)?)?;
            write(&styles, css)?;
        } else if entry.is_file() {
            fs::copy(&entry, &twin).with_context(|| format!("cannot copy {}", entry.display()))?;
        } else if name != "js" && name != "css" {
            mirror(&entry, &twin, &[])?;
        }
    }
    let start = Script::new(Path::new(START), None, &read)?;
    let main = Script::new(Path::new(MAIN), Some(&start), &read)?;
    write(START, start.shared())?;
    write(MAIN, main.shared())?;
    for path in OTHERS {
        write(path, Script::new(Path::new(path), None, &read)?.text)?;
    }
    for path in ALONE {
        write(path, read(Path::new(path))?)?;
    }
    Ok(())
}

/// The text of a page's file, at its place before the build.
///
/// # Errors
/// If it cannot be read.
pub(super) fn text_of(web: &Path, pkg: &Path, path: &Path) -> Result<String> {
    let file = path.strip_prefix("pkg").map_or_else(|_| web.join(path), |inner| pkg.join(inner));
    fs::read_to_string(&file).with_context(|| format!("cannot read {}", file.display()))
}

/// A page with its stylesheets joined into `name`, and the joined text. The links are one per line,
/// in cascade order.
fn with_one_stylesheet(
    html: &str,
    name: &str,
    read: &dyn Fn(&Path) -> Result<String>,
) -> Result<(String, String)> {
    let mut page = String::new();
    let mut styles = String::new();
    for line in html.lines() {
        let Some(link) = line.trim_start().strip_prefix(STYLESHEET) else {
            page.push_str(line);
            page.push('\n');
            continue;
        };
        if styles.is_empty() {
            page.push_str(&format!("  {STYLESHEET}{name}\">\n"));
        }
        let (file, rest) = link.split_once('"').context("a stylesheet without an address")?;
        let text = read(Path::new(file))?;
        ensure!(!text.contains("url(") && !text.contains("@import"), "{file} names another file");
        match rest {
            ">" => styles.push_str(&text),
            " media=\"print\">" => styles.push_str(&format!("@media print {{\n{text}}}\n")),
            _ => bail!("{file} has attributes that cannot be joined: {rest}"),
        }
    }
    Ok((page, styles))
}
