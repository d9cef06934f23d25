//! What a page may run, style and load: its Content-Security-Policy.

use anyhow::{Result, ensure};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use sha2::{Digest, Sha256};

/// The policy of the pages in `web`, which state it themselves. The server repeats it, because a
/// Worker only obeys the policy of its own response.
pub(crate) const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; \
    connect-src 'self'; style-src 'self'; img-src 'self' data: blob:; base-uri 'none'; form-action 'none'";

/// How a page states its policy, up to the policy's text.
pub(super) const META: &str = "<meta http-equiv=\"Content-Security-Policy\" content=\"";

/// The scripts and styles allowed in the one-file page: only those inside it, by their hashes.
#[derive(Default)]
pub(super) struct Hashes {
    scripts: String,
    styles: String,
}

impl Hashes {
    /// Allows a script, and returns it.
    ///
    /// # Errors
    /// If HTML would end it early.
    pub(super) fn script(&mut self, text: String) -> Result<String> {
        allow(&mut self.scripts, text, "</script")
    }

    /// Allows a style, and returns it.
    ///
    /// # Errors
    /// If HTML would end it early.
    pub(super) fn style(&mut self, text: String) -> Result<String> {
        allow(&mut self.styles, text, "</style")
    }

    /// [`POLICY`] for a page without other files; its Worker starts from a Blob.
    pub(super) fn policy(&self) -> String {
        POLICY
            .replace("script-src 'self'", &format!("script-src{}", self.scripts))
            .replace("style-src 'self'", &format!("style-src{}", self.styles))
            .replace("worker-src 'self'", "worker-src blob:")
            .replace("connect-src 'self'; ", "")
            .replace("img-src 'self' ", "img-src ")
    }
}

fn allow(hashes: &mut String, text: String, end: &str) -> Result<String> {
    ensure!(!text.contains(end) && !text.contains("<!--"), "a script or style would end early in HTML");
    hashes.push_str(&format!(" 'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(&text))));
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::path::Path;

    #[test]
    fn the_pages_state_the_policy_of_the_server() {
        let web = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("web");
        let pages = fs::read_dir(web).unwrap().map(|entry| entry.unwrap().path());
        let pages: Vec<_> =
            pages.filter(|path| path.extension().is_some_and(|extension| extension == "html")).collect();
        assert!(pages.len() >= 2, "{pages:?}");
        for page in pages {
            let html = fs::read_to_string(&page).unwrap();
            assert!(html.contains(&format!("{META}{POLICY}\">")), "{}", page.display());
        }
    }

    #[test]
    fn one_file_allows_only_what_stands_in_it() {
        let mut hashes = Hashes::default();
        assert_eq!(hashes.script("a();".to_owned()).unwrap(), "a();");
        hashes.style("p {}".to_owned()).unwrap();
        let hash = |text: &str| BASE64_STANDARD.encode(Sha256::digest(text));
        let expected = format!(
            "default-src 'none'; script-src 'sha256-{}' 'wasm-unsafe-eval'; worker-src blob:; style-src 'sha256-{}'; \
             img-src data: blob:; base-uri 'none'; form-action 'none'",
            hash("a();"),
            hash("p {}")
        );
        assert_eq!(hashes.policy(), expected);
        for broken in ["a('</script>');", "<!-- a"] {
            assert!(hashes.script(broken.to_owned()).is_err(), "{broken}");
        }
    }
}
