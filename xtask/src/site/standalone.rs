//! The page as one file, `standalone.html`, opened from disk by a double click, where a browser
//! cannot load other files. Styles and scripts are inline, allowed by their hashes alone; the core
//! is in it as compressed text, the Worker starts from a Blob.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use super::core::{MODULE, compressed};
use super::gallery;
use super::modules::Script;
use super::page::text_of;
use super::policy::{Hashes, META};

/// Replaces `web/js/core/assets.js` in the one-file page.
const FILES: &str = include_str!("assets.js");

/// Lines of the page about other files: preloads, and the first script, whose modules are in the
/// other.
const BESIDE: [&str; 2] = ["<link rel=\"preload\"", "<script type=\"module\" src=\"js/start.js\""];

/// Folder of files that the page reads as text.
const EXAMPLES: &str = "examples";

/// Makes `standalone.html` of the page in `web` and the core in `pkg`, and returns its text.
///
/// # Errors
/// If a file cannot be read, or the page uses something that one file cannot hold.
pub(super) fn page(web: &Path, pkg: &Path) -> Result<String> {
    let read = |path: &Path| text_of(web, pkg, path);
    let module =
        |path: &Path| if path == Path::new("js/core/assets.js") { Ok(FILES.to_owned()) } else { read(path) };
    let icon = format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(read(Path::new("icon.svg"))?));
    let mut hashes = Hashes::default();

    // Inline content needs no preload.
    let html: String = read(Path::new("index.html"))?
        .split_inclusive('\n')
        .filter(|line| !BESIDE.iter().any(|start| line.trim_start().starts_with(start)))
        .collect();
    let html = html.replace("\"icon.svg\"", &format!("\"{icon}\""));
    let html = gallery::within(&html, web)?;
    let html = replaced(&html, "<link rel=\"stylesheet\" href=\"", ">", |rest| {
        let (file, media) = rest.split_once('"').context("a stylesheet without an address")?;
        Ok(format!("<style{media}>{}</style>", hashes.style(read(Path::new(file))?)?))
    })?;
    let html = replaced(&html, "<script type=\"module\" src=\"", "\"></script>", |file| {
        Ok(format!(
            "<script type=\"module\">{}</script>",
            hashes.script(Script::new(Path::new(file), None, &module)?.text)?
        ))
    })?;
    // A browser does not start a module from a Blob of a page on disk, and a classic script has no
    // `import.meta`. The glue only uses it when it is to load the core itself.
    let worker = Script::new(Path::new("js/worker.js"), None, &module)?
        .text
        .replace("import.meta.url", "location.href");
    ensure!(!worker.contains("</script"), "the Worker's script would end early in HTML");
    let core = fs::read(pkg.join(MODULE)).context("cannot read the core")?;
    let data =
        [("core", BASE64_STANDARD.encode(compressed(&core)?)), ("worker", worker), ("files", files(web)?)];
    let blocks = data.map(|(id, text)| format!("<script type=\"text/plain\" id=\"{id}\">{text}</script>\n"));
    let html = html.replace("</body>", &format!("{}</body>", blocks.concat()));
    let html = replaced(&html, META, "\">", |_| Ok(format!("{META}{}\">", hashes.policy())))?;
    ensure!(
        !html.contains("<link rel=\"stylesheet\"") && !html.contains("<script src"),
        "the page still refers to files beside it"
    );
    Ok(html)
}

/// The text with each stretch from `start` to the next `end` replaced by the result of `make` for
/// the text between them.
fn replaced(
    text: &str,
    start: &str,
    end: &str,
    mut make: impl FnMut(&str) -> Result<String>,
) -> Result<String> {
    let mut parts = text.split(start);
    let mut result = parts.next().unwrap_or_default().to_owned();
    let mut count = 0;
    for part in parts {
        let (between, after) = part.split_once(end).with_context(|| format!("{start} does not end"))?;
        result.push_str(&make(between)?);
        result.push_str(after);
        count += 1;
    }
    ensure!(count > 0, "the page has no {start}");
    Ok(result)
}

/// The examples as a JSON object, text by path, without the one character that could end it in
/// HTML.
fn files(web: &Path) -> Result<String> {
    let mut paths: Vec<PathBuf> = fs::read_dir(web.join(EXAMPLES))
        .context("cannot list the examples")?
        .map(|entry| Ok(entry?.path()))
        .collect::<Result<_>>()?;
    paths.sort();
    let mut texts = serde_json::Map::new();
    for path in paths {
        let name = path.strip_prefix(web).unwrap_or(&path).to_string_lossy().replace('\\', "/");
        texts.insert(name, fs::read_to_string(&path)?.into());
    }
    Ok(serde_json::to_string(&texts)?.replace('<', "\\u003c"))
}
