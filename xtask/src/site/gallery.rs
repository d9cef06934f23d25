//! The gallery's jobs: `web/gallery.html` names their files, the site has links that open them.

use std::fs;
use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result};
use base64::Engine;
use base64::prelude::{BASE64_STANDARD, BASE64_URL_SAFE_NO_PAD};
use flate2::{Compression, write::ZlibEncoder};

/// How a page names the file of a job in `web/gallery`, up to the file's name.
const FILE: &str = "href=\"gallery/";

/// Where the cards begin in the gallery, how one begins its picture, and before what they stand in the
/// one-file page, with the heading that they have there.
const CARDS: &str = "<div class=\"cards\">";
const PICTURE: &str = "<img src=\"gallery/";
const PLACE: &str = "  <section class=\"prose\" id=\"about\"";
const SECTION: &str = "  <section class=\"prose\" id=\"gallery\" tabindex=\"-1\" aria-labelledby=\"gallery-title\">\n    \
                       <h2 id=\"gallery-title\">Eight questions</h2>\n    \
                       <p class=\"lead\">Each opens as a job above, where every number can be changed.</p>\n    ";

/// The cards' styles, which the one-file page has beside its own.
const STYLES: &str = "  <link rel=\"stylesheet\" href=\"css/cards.css\">\n";

/// The page with links to the jobs in place of their files.
///
/// # Errors
/// If a file cannot be read.
pub(super) fn with_jobs(html: &str, web: &Path) -> Result<String> {
    let mut parts = html.split(FILE);
    let mut page = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once('"').context("an address does not end")?;
        let file = web.join("gallery").join(name);
        let job = fs::read_to_string(&file).with_context(|| format!("cannot read {}", file.display()))?;
        page.push_str(&format!("href=\"index.html#{}\"{rest}", link(&job)?));
    }
    Ok(page)
}

/// The one-file page with the gallery in it: the cards before the section about the page, their pictures
/// inside, their links to the page itself.
///
/// # Errors
/// If a file cannot be read, or the page has no place for the gallery.
pub(super) fn within(page: &str, web: &Path) -> Result<String> {
    let gallery = fs::read_to_string(web.join("gallery.html")).context("cannot read the gallery")?;
    let (_, rest) = gallery.split_once(CARDS).context("the gallery has no cards")?;
    let (cards, _) = rest.split_once("</main>").context("the gallery does not end")?;
    let cards = with_jobs(cards, web)?.replace("href=\"index.html#", "href=\"#");
    let mut parts = cards.split(PICTURE);
    let mut section = format!("{SECTION}{CARDS}{}", parts.next().unwrap_or_default());
    for part in parts {
        let (name, rest) = part.split_once('"').context("an address does not end")?;
        let file = web.join("gallery").join(name);
        let picture = fs::read(&file).with_context(|| format!("cannot read {}", file.display()))?;
        section.push_str(&format!(
            "<img src=\"data:image/webp;base64,{}\"{rest}",
            BASE64_STANDARD.encode(picture)
        ));
    }
    let (before, after) = page.split_once(PLACE).context("the page has no place for the gallery")?;
    let (head, body) = before.split_once("</head>").context("the page has no head")?;
    let body = body.replace("href=\"gallery.html\"", "href=\"#gallery\"");
    Ok(format!("{head}{STYLES}</head>{body}{section}</section>\n\n{PLACE}{after}"))
}

/// The fragment that opens the page with a job, see `web/js/job/link.js`.
///
/// # Errors
/// Never: writing to memory does not fail.
pub(crate) fn link(job: &str) -> Result<String> {
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::best());
    packed.write_all(job.as_bytes())?;
    Ok(format!("job=2.{}", BASE64_URL_SAFE_NO_PAD.encode(packed.finish()?)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::ZlibDecoder;
    use std::io::Read;

    fn unpacked(link: &str) -> String {
        let packed = BASE64_URL_SAFE_NO_PAD.decode(link.strip_prefix("job=2.").unwrap()).unwrap();
        let mut job = String::new();
        ZlibDecoder::new(packed.as_slice()).read_to_string(&mut job).unwrap();
        job
    }

    #[test]
    fn a_link_holds_the_whole_job() {
        assert_eq!(unpacked(&link("{\"version\":1}").unwrap()), "{\"version\":1}");
    }

    #[test]
    fn a_page_links_to_its_jobs() {
        let web = tempfile::tempdir().unwrap();
        fs::create_dir(web.path().join("gallery")).unwrap();
        fs::write(web.path().join("gallery/a.json"), "{}").unwrap();
        let page =
            with_jobs("<a href=\"gallery/a.json\">A</a> <a href=\"b.html\">B</a>", web.path()).unwrap();
        let (link, rest) =
            page.strip_prefix("<a href=\"index.html#").unwrap().split_once("\">A</a>").unwrap();
        assert_eq!(unpacked(link), "{}");
        assert_eq!(rest, " <a href=\"b.html\">B</a>");
        assert!(with_jobs("<a href=\"gallery/none.json\">", web.path()).is_err());
    }
}
