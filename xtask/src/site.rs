//! The static site: the core as WebAssembly, and the files of `web/` around it.

use std::ffi::OsStr;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::SystemTime;

use anyhow::{Context, Result, ensure};

use crate::page;
use crate::standalone::{self, compressed};
use crate::workspace::{self, WASM};

/// Folder of the site that the compiled cores live in.
const CORES: &str = "pkg";

/// The whole site in one file.
const STANDALONE: &str = "standalone.html";

/// One build of the core.
struct Core {
    /// Folder in [`CORES`].
    name: &'static str,
    /// Cargo's package, whose library it is.
    package: &'static str,
    /// Cargo's profile; each has a folder of its own in `target`.
    profile: &'static str,
    /// Cargo's options besides.
    options: &'static [&'static str],
    /// Most bytes that it may have, as it is and compressed by gzip.
    limits: [usize; 2],
}

/// The small one gives the first result; the full one follows, for charts and for whatever is not as in the default job. Its limits only
/// keep it from growing unnoticed.
const BUILDS: [Core; 2] = [
    Core {
        name: "small",
        package: "armill",
        profile: "small",
        options: &["--no-default-features"],
        limits: [500_000, 200_000],
    },
    Core { name: "full", package: "armill", profile: "release", options: &[], limits: [1_200_000, 490_000] },
];

/// The full core again, with the benchmark's own functions: nobody loads it but `cargo xtask bench`.
const BENCH: Core = Core {
    name: "bench",
    package: "armill-bench",
    profile: "release",
    options: &[],
    limits: [usize::MAX, usize::MAX],
};

/// Makes the site in `target/site` and returns that folder. What is up to date stays untouched.
///
/// # Errors
/// If the core does not compile, a tool is missing, or a file cannot be read or written.
pub(crate) fn build() -> Result<PathBuf> {
    let root = workspace::root()?;
    let site = root.join("target/site");
    workspace::add_wasm_target()?;
    for core in &BUILDS {
        let wasm = compile(&root, core)?;
        let folder = site.join(CORES).join(core.name);
        bind(&wasm, &folder).context("wasm-bindgen failed")?;
        weigh(core.name, &folder.join("armill_bg.wasm"), core.limits)?;
    }
    update(&form()?, &site.join(standalone::FORM))?;
    let (web, joined) = (root.join("web"), root.join("target/page"));
    page::join(&web, &site.join(CORES), &joined)?;
    mirror(&joined, &site, &[CORES, STANDALONE])?;
    update(standalone::page(&web, &site)?.as_bytes(), &site.join(STANDALONE))?;
    println!("The site is in target/site");
    Ok(site)
}

/// Makes the cores of the site from the sources in `root`, in `folder`, and tells the files' names and contents.
///
/// # Errors
/// If one does not compile.
pub(crate) fn cores(root: &Path, folder: &Path) -> Result<Vec<(&'static str, Vec<u8>)>> {
    let made = BUILDS.iter().map(|core| {
        let folder = folder.join(core.name);
        bind(&compile(root, core)?, &folder).context("wasm-bindgen failed")?;
        let file = folder.join("armill_bg.wasm");
        Ok((core.name, fs::read(&file).with_context(|| format!("cannot read {}", file.display()))?))
    });
    made.collect()
}

/// Makes the benchmark's core in `folder`.
///
/// # Errors
/// If it does not compile.
pub(crate) fn bench_core(folder: &Path) -> Result<()> {
    bind(&compile(&workspace::root()?, &BENCH)?, folder).context("wasm-bindgen failed")
}

/// Compiles a core and returns the raw module.
fn compile(root: &Path, core: &Core) -> Result<PathBuf> {
    let arguments = ["rustc", "--locked", "--target", WASM, "--package", core.package, "--lib"];
    let mut command = workspace::cargo(&arguments)?;
    command.current_dir(root).args(["--profile", core.profile]).args(core.options);
    // An explicit folder, because the site has to be found in `target` whatever the environment says.
    command.args(["--target-dir", "target"]);
    if let Some(home) = workspace::cargo_home() {
        // Panic messages name source files: without the home folder of whoever builds it, the site is the same everywhere.
        let flag = format!("--remap-path-prefix={}=cargo", home.display());
        command.args(["--config", &format!("target.{WASM}.rustflags=['{flag}']")]);
    }
    // Calls that are not inlined cost little where numbers are computed, and save a tenth of the bytes.
    command.args(["--", "-C", "llvm-args=-inline-threshold=75"]);
    workspace::run(&mut command)?;
    Ok(root.join("target").join(WASM).join(core.profile).join(core.package.replace('-', "_") + ".wasm"))
}

/// What the page's form is built from, as JSON text.
fn form() -> Result<Vec<u8>> {
    let mut command =
        workspace::cargo(&["run", "--quiet", "--locked", "--package", "armill", "--bin", "armill-form"])?;
    let output = command.stderr(Stdio::inherit()).output().context("cannot start cargo")?;
    ensure!(output.status.success(), "the form's inputs could not be listed ({})", output.status);
    Ok(output.stdout)
}

/// Turns the raw module into one with a JavaScript interface, in `folder`.
fn bind(wasm: &Path, folder: &Path) -> Result<()> {
    let outputs = ["armill.js", "armill_bg.wasm", "armill.d.ts"].map(|name| folder.join(name));
    // This program is an input too: it holds wasm-bindgen and the options below.
    let inputs = [wasm.to_path_buf(), std::env::current_exe()?];
    if is_newer(&outputs, &inputs)? {
        return Ok(());
    }
    let options =
        ["--target", "web", "--out-name", "armill", "--remove-name-section", "--remove-producers-section"];
    let mut words = vec![OsStr::new("wasm-bindgen"), wasm.as_os_str()];
    words.extend(options.map(OsStr::new));
    words.extend([OsStr::new("--out-dir"), folder.as_os_str()]);
    wasm_bindgen_cli::wasm_bindgen::run_cli_with_args(words)
}

/// Prints the size of a file, as it is and compressed, and refuses one that exceeds either limit.
fn weigh(name: &str, file: &Path, [raw_limit, zipped_limit]: [usize; 2]) -> Result<()> {
    let content = fs::read(file).with_context(|| format!("cannot read {}", file.display()))?;
    let (raw, zipped) = (content.len(), compressed(&content)?.len());
    println!("The {name} core has {raw} bytes, {zipped} compressed");
    ensure!(
        raw <= raw_limit && zipped <= zipped_limit,
        "{} has {raw} bytes, {zipped} compressed by gzip; at most {raw_limit} and {zipped_limit} are allowed",
        file.display()
    );
    Ok(())
}

/// Whether every output exists and is at least as new as every input.
fn is_newer(outputs: &[PathBuf], inputs: &[PathBuf]) -> Result<bool> {
    let changed = |path: &PathBuf| -> Result<SystemTime> {
        let metadata = fs::metadata(path).with_context(|| format!("cannot read {}", path.display()))?;
        Ok(metadata.modified()?)
    };
    let newest = inputs.iter().map(changed).collect::<Result<Vec<_>>>()?.into_iter().max();
    Ok(outputs.iter().all(|output| changed(output).ok() >= newest))
}

/// Makes `copy` hold the same files as `original`, but for the entries `besides`, which are left alone.
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

/// What is in a folder.
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
    use std::time::Duration;

    fn write(folder: &Path, file: &str, content: &str) {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }

    fn age(path: &Path, seconds: u64) {
        let file = fs::File::options().write(true).open(path).unwrap();
        file.set_modified(SystemTime::now() - Duration::from_secs(seconds)).unwrap();
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
        age(&file, 1000);
        let before = fs::metadata(&file).unwrap().modified().unwrap();
        update(b"same", &file).unwrap();
        assert_eq!(fs::metadata(&file).unwrap().modified().unwrap(), before);
        update(b"other", &file).unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), "other");
    }

    #[test]
    fn a_file_above_either_limit_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("core.wasm");
        fs::write(&file, [0; 1000]).unwrap();
        assert!(weigh("tiny", &file, [1000, 100]).is_ok());
        let refusal = weigh("tiny", &file, [999, 100]).unwrap_err().to_string();
        assert!(refusal.contains("has 1000 bytes") && refusal.contains("at most 999 and 100"), "{refusal}");
        assert!(weigh("tiny", &file, [1000, 5]).is_err(), "1000 equal bytes compress to some twenty");
        assert!(weigh("missing", &folder.path().join("missing"), [1000, 100]).is_err());
    }

    #[test]
    fn outputs_are_stale_if_one_is_older_or_missing() {
        let folder = tempfile::tempdir().unwrap();
        let [input, old, new, missing] =
            ["input", "old", "new", "missing"].map(|name| folder.path().join(name));
        for (path, seconds) in [(&old, 30), (&input, 20), (&new, 10)] {
            fs::write(path, "").unwrap();
            age(path, seconds);
        }
        let newer = |outputs: &[PathBuf]| is_newer(outputs, std::slice::from_ref(&input)).unwrap();
        assert!(newer(std::slice::from_ref(&new)));
        assert!(!newer(&[new.clone(), old]));
        assert!(!newer(&[new, missing]));
    }
}
