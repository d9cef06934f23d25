//! The Content-Security-Policy of every HTML page: its text, and its enforcement by the browser.

use std::fs;
use std::path::{Path, PathBuf};

use crate::browser::{DESKTOP, Page, Result, THESIS, visit};
use crate::standalone;

/// Every HTML file of the site.
fn pages() -> Result<Vec<PathBuf>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/site");
    let mut pages: Vec<PathBuf> =
        fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Result<_>>()?;
    pages.retain(|path| path.extension().is_some_and(|extension| extension == "html"));
    Ok(pages)
}

/// The values of an attribute, anywhere in the text.
fn values<'a>(html: &'a str, attribute: &str) -> Vec<&'a str> {
    let start = format!(" {attribute}=\"");
    html.split(start.as_str()).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn every_page_says_what_may_run() -> Result {
    let pages = pages()?;
    assert!(pages.len() >= 3, "{pages:?}");
    for page in pages {
        let html = fs::read_to_string(&page)?;
        let name = page.display();
        let (head, rest) =
            html.split_once("<meta http-equiv=\"Content-Security-Policy\" content=\"").unwrap();
        assert!(!head.contains("<script") && !head.contains("<link") && !head.contains("<style"), "{name}");
        let (policy, body) = rest.split_once("\">").unwrap();
        let mut directives: Vec<&str> = Vec::new();
        for directive in policy.split("; ") {
            let (key, sources) = directive.split_once(' ').unwrap();
            directives.push(key);
            for source in sources.split(' ') {
                let legal = match key {
                    "default-src" | "base-uri" | "form-action" => source == "'none'",
                    "script-src" => {
                        ["'self'", "'wasm-unsafe-eval'"].contains(&source) || source.starts_with("'sha256-")
                    }
                    "style-src" => source == "'self'" || source.starts_with("'sha256-"),
                    "worker-src" => ["'self'", "blob:"].contains(&source),
                    "connect-src" => source == "'self'",
                    "img-src" => ["'self'", "data:", "blob:"].contains(&source),
                    _ => false,
                };
                assert!(legal, "{name}: {key} {source}");
            }
        }
        for needed in ["default-src", "script-src", "style-src", "base-uri", "form-action"] {
            assert!(directives.contains(&needed), "{name} has no {needed}");
        }
        // Outside of scripts and styles, which the policy governs: nothing inline, nothing from
        // elsewhere.
        let mut markup = String::new();
        for (k, part) in body.split("<script").enumerate() {
            markup.push_str(if k == 0 { part } else { part.split_once("</script>").unwrap().1 });
        }
        for attribute in ["style", "onclick", "onload", "onerror", "oninput", "onchange", "onsubmit"] {
            assert_eq!(values(&markup, attribute), Vec::<&str>::new(), "{name}: {attribute}");
        }
        for address in values(&html, "src").iter().chain(&values(&markup, "href")) {
            let foreign = address.contains("//") || address.starts_with("javascript:");
            assert!(!foreign || address.starts_with("data:image/"), "{name}: {address}");
        }
    }
    Ok(())
}

/// Actions that a page's policy blocks, tried from inside: each of these would work without one.
const ATTEMPTS: [(&str, &str); 6] = [
    (
        "script-src-elem",
        "const s = document.createElement('script'); s.textContent = 'window.intruder = true'; document.head.append(s)",
    ),
    (
        "script-src-attr",
        "document.body.setAttribute('onclick', 'window.intruder = true'); document.body.click()",
    ),
    // A driver's own script may evaluate; a timer's script belongs to the page.
    ("script-src", "setTimeout(() => (0, eval)('window.intruder = true'))"),
    (
        "style-src-elem",
        "const s = document.createElement('style'); s.textContent = 'body { display: none }'; document.head.append(s)",
    ),
    ("connect-src", "fetch('https://armill.invalid/').catch(() => {})"),
    ("img-src", "new Image().src = 'https://armill.invalid/x.png'"),
];

async fn holds(page: &Page) -> Result {
    page.expect_error("Content Security Policy");
    // The log lists the request although it is blocked before it leaves.
    page.expect_error("https://armill.invalid/x.png");
    page.wait_for("document.readyState === 'complete'", 20.0).await?;
    page.js("window.refused = []; document.addEventListener('securitypolicyviolation', \
         event => window.refused.push(event.effectiveDirective))")
        .await?;
    for (directive, attempt) in ATTEMPTS {
        page.js(attempt).await?;
        page.wait_for(&format!("window.refused.includes('{directive}')"), 5.0).await?;
    }
    assert_eq!(page.js("return window.intruder === undefined").await?, true);
    assert_eq!(page.js("return getComputedStyle(document.body).display === 'none'").await?, false);
    Ok(())
}

#[test]
fn the_policies_hold() -> Result {
    visit(THESIS, DESKTOP, holds)?;
    visit("/embed.html", DESKTOP, holds)?;
    visit(&standalone::address(), DESKTOP, holds)
}
