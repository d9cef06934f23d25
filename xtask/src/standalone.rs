//! The page as one file, `standalone.html`: a double click opens it from disk, where a browser loads nothing from beside it.
//! Styles and scripts stand in it, allowed by their hashes alone; the core is in it as compressed text, the Worker starts from a Blob.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use sha2::{Digest, Sha256};

use crate::modules::Script;
use crate::page::text_of;

/// What the one-file page has in place of `web/js/files.js`.
const FILES: &str = include_str!("files.js");

/// What it has in place of `web/js/worker.js`.
const WORKER: &str = include_str!("worker.js");

/// Lines of the page about files beside it: what is needed early, and the first script, whose modules are in the other.
const BESIDE: [&str; 2] = ["<link rel=\"preload\"", "<script type=\"module\" src=\"js/start.js\""];

/// What the page's form is built from.
pub(crate) const FORM: &str = "pkg/form.json";

/// Folder of files that the page reads as text.
const EXAMPLES: &str = "examples";

/// Makes `standalone.html` of the page in `web` and what is made for it in `site`, and returns its text.
///
/// # Errors
/// If a file cannot be read, or the page uses something that one file cannot hold.
pub(crate) fn page(web: &Path, site: &Path) -> Result<String> {
    let read = |path: &Path| text_of(web, &site.join("pkg"), path);
    let module = |path: &Path| match path.to_str() {
        Some("js/files.js") => Ok(FILES.to_owned()),
        Some("js/worker.js") => Ok(WORKER.to_owned()),
        _ => read(path),
    };
    let icon = format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(read(Path::new("icon.svg"))?));
    let mut policy = Policy::default();

    // What stands in the page does not need to be waited for.
    let html: String = read(Path::new("index.html"))?
        .split_inclusive('\n')
        .filter(|line| !BESIDE.iter().any(|start| line.trim_start().starts_with(start)))
        .collect();
    let html = html.replace("\"icon.svg\"", &format!("\"{icon}\""));
    let html = replaced(&html, "<link rel=\"stylesheet\" href=\"", ">", |rest| {
        let (file, media) = rest.split_once('"').context("a stylesheet without an address")?;
        Ok(format!("<style{media}>{}</style>", policy.style(read(Path::new(file))?)?))
    })?;
    let html = replaced(&html, "<script type=\"module\" src=\"", "\"></script>", |file| {
        Ok(format!(
            "<script type=\"module\">{}</script>",
            policy.script(Script::new(Path::new(file), None, &module)?.text)?
        ))
    })?;
    // A browser starts no module from a Blob of a page on disk, and a classic script knows no `import.meta`. The glue
    // only asks for it when it is to load the core itself.
    let worker = Script::new(Path::new("js/worker.js"), None, &module)?
        .text
        .replace("import.meta.url", "location.href");
    ensure!(!worker.contains("</script"), "the Worker's script would end early in HTML");
    let core = fs::read(site.join("pkg/full/armill_bg.wasm")).context("cannot read the core")?;
    let data =
        [("core", BASE64_STANDARD.encode(compressed(&core)?)), ("worker", worker), ("files", files(site)?)];
    let blocks = data.map(|(id, text)| format!("<script type=\"text/plain\" id=\"{id}\">{text}</script>\n"));
    let html = html.replace("</body>", &format!("{}</body>", blocks.concat()));
    let start = "<meta http-equiv=\"Content-Security-Policy\" content=\"";
    let html = replaced(&html, start, ">", |_| Ok(format!("{start}{}\">", policy.text())))?;
    ensure!(
        !html.contains("<link rel=\"stylesheet\"") && !html.contains("<script src"),
        "something of the page is still beside it"
    );
    Ok(html)
}

/// What may run and style in the page: only what stands in it.
#[derive(Default)]
struct Policy {
    scripts: String,
    styles: String,
}

impl Policy {
    fn script(&mut self, text: String) -> Result<String> {
        allow(&mut self.scripts, text, "</script")
    }

    fn style(&mut self, text: String) -> Result<String> {
        allow(&mut self.styles, text, "</style")
    }

    fn text(&self) -> String {
        format!(
            "default-src 'none'; script-src{} 'wasm-unsafe-eval'; worker-src blob:; style-src{}; \
             img-src data: blob:; base-uri 'none'; form-action 'none'",
            self.scripts, self.styles
        )
    }
}

fn allow(hashes: &mut String, text: String, end: &str) -> Result<String> {
    ensure!(!text.contains(end) && !text.contains("<!--"), "a script or style would end early in HTML");
    hashes.push_str(&format!(" 'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(&text))));
    Ok(text)
}

/// The text with each stretch from `start` to the next `end` replaced by what `make` makes of what is between them.
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

/// The bytes compressed by gzip, as well as it can.
pub(crate) fn compressed(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    Ok(encoder.finish()?)
}

/// The examples as a JSON object, text by path; without the one character that could end it in HTML.
fn files(site: &Path) -> Result<String> {
    let mut paths: Vec<PathBuf> = fs::read_dir(site.join(EXAMPLES))
        .context("cannot list the examples")?
        .map(|entry| Ok(entry?.path()))
        .collect::<Result<_>>()?;
    paths.sort();
    paths.push(site.join(FORM));
    let mut texts = serde_json::Map::new();
    for path in paths {
        let name = path.strip_prefix(site).unwrap_or(&path).to_string_lossy().replace('\\', "/");
        texts.insert(name, fs::read_to_string(&path)?.into());
    }
    Ok(serde_json::to_string(&texts)?.replace('<', "\\u003c"))
}
