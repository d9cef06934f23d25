//! Several files as one zip archive.

use crate::error::Error;
use crate::export::post::robot::PackageFile;
use rawzip::ZipArchiveWriter;
use std::io::Write;

/// The files in a folder, stored without compression and without a date, so that the same files give
/// the same bytes.
///
/// # Errors
/// [`Error::Invalid`] if the archive cannot hold them.
pub fn zip(folder: &str, files: &[PackageFile]) -> Result<Vec<u8>, Error> {
    written(folder, files)
        .map_err(|error| Error::invalid("program", error.to_string(), "files that fit into a zip archive"))
}

fn written(folder: &str, files: &[PackageFile]) -> Result<Vec<u8>, rawzip::Error> {
    let mut archive = ZipArchiveWriter::new(Vec::new());
    for file in files {
        let path = format!("{folder}/{}", file.path);
        let (mut entry, config) = archive.new_file(path.as_str()).start()?;
        let mut data = config.wrap(&mut entry);
        data.write_all(file.text.as_bytes())?;
        let (_, descriptor) = data.finish()?;
        entry.finish(descriptor)?;
    }
    archive.finish()
}
