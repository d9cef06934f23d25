//! Mirrored folders; a file that is already up to date is not written.

use std::ffi::OsStr;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// Makes `copy` hold the same files as `original`, except the entries `besides`, which are left
/// alone.
///
/// # Errors
/// If a file cannot be read or written.
pub(crate) fn mirror(original: &Path, copy: &Path, besides: &[&str]) -> Result<()> {
    fs::create_dir_all(copy).with_context(|| format!("cannot create {}", copy.display()))?;
    for entry in entries(copy)? {
        let twin = original.join(entry.file_name().unwrap_or_default());
        let stale = twin.is_dir() != entry.is_dir() || !twin.exists();
        if stale && !besides.iter().any(|name| entry.file_name() == Some(OsStr::new(name))) {
            remove(&entry).with_context(|| format!("cannot remove {}", entry.display()))?;
        }
    }
    for entry in entries(original)? {
        let twin = copy.join(entry.file_name().unwrap_or_default());
        if entry.is_dir() {
            mirror(&entry, &twin, &[])?;
        } else {
            let copied = fs::read(&entry).and_then(|content| update(&content, &twin));
            copied.with_context(|| format!("cannot copy {}", entry.display()))?;
        }
    }
    Ok(())
}

/// The entries of a folder.
///
/// # Errors
/// If it cannot be read.
pub(crate) fn entries(folder: &Path) -> Result<Vec<PathBuf>> {
    let list = fs::read_dir(folder).with_context(|| format!("cannot list {}", folder.display()))?;
    list.map(|entry| Ok(entry?.path())).collect()
}

fn remove(path: &Path) -> std::io::Result<()> {
    if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) }
}

/// Writes a file, unless it has this content already.
///
/// # Errors
/// If it cannot be read or written.
pub(crate) fn update(wanted: &[u8], file: &Path) -> std::io::Result<()> {
    match fs::read(file) {
        Ok(present) if present == wanted => Ok(()),
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => fs::write(file, wanted),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, SystemTime};

    fn write(folder: &Path, file: &str, content: &str) {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }

    #[test]
    fn the_mirror_follows_changes_and_keeps_what_it_must() {
        let folder = tempfile::tempdir().unwrap();
        let (web, site) = (folder.path().join("web"), folder.path().join("site"));
        write(&web, "index.html", "one");
        write(&web, "css/page.css", "p {}");
        write(&web, "becomes/folder.txt", "x");
        write(&site, "pkg/armill.js", "made");
        write(&site, "vanished.js", "old");
        write(&site, "gone/away.js", "old");
        write(&site, "css/vanished.css", "old");
        write(&site, "becomes", "a file");
        mirror(&web, &site, &["pkg"]).unwrap();

        let read = |file: &str| fs::read_to_string(site.join(file)).ok();
        assert_eq!(read("index.html").as_deref(), Some("one"));
        assert_eq!(read("css/page.css").as_deref(), Some("p {}"));
        assert_eq!(read("becomes/folder.txt").as_deref(), Some("x"));
        assert_eq!(read("pkg/armill.js").as_deref(), Some("made"), "the core is not the mirror's");
        for stale in ["vanished.js", "gone", "css/vanished.css"] {
            assert!(!site.join(stale).exists(), "{stale} is not in web/ any more");
        }
    }

    #[test]
    fn an_unchanged_file_is_not_written_again() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a");
        fs::write(&file, "same").unwrap();
        let past = SystemTime::now() - Duration::from_secs(1000);
        fs::File::options().write(true).open(&file).unwrap().set_modified(past).unwrap();
        let before = fs::metadata(&file).unwrap().modified().unwrap();
        update(b"same", &file).unwrap();
        assert_eq!(fs::metadata(&file).unwrap().modified().unwrap(), before);
        update(b"other", &file).unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), "other");
    }
}
