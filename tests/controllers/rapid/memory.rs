//! Which modules are in memory.

use super::Controller;
use crate::controllers::scan::Scan;

/// The file's name in a path.
pub(super) fn last(path: &str) -> &str {
    path.rsplit(['/', ':']).next().unwrap_or(path)
}

impl Controller<'_> {
    /// No name stands in two modules at once (LOCAL is not counted as an excuse).
    pub(super) fn ambiguous(&self) -> Result<(), String> {
        let mut names: Vec<&String> = Vec::new();
        for &at in self.loaded.keys() {
            let module = &self.modules[at];
            let own = module.data.keys().chain(module.procedures.keys()).chain([&module.name]);
            for name in own {
                if names.contains(&name) {
                    return Err(format!("{}:0: {name} is ambiguous among the loaded modules", module.path));
                }
                names.push(name);
            }
        }
        Ok(())
    }

    /// Load and UnLoad.
    pub(super) fn memory(&mut self, scan: &mut Scan, is_load: bool) -> Result<(), String> {
        let from = scan.clone();
        if is_load {
            scan.need_all(&["\\", "Dynamic", ","])?;
        }
        let path = scan.quoted('"')?.to_owned();
        let found =
            self.modules.iter().position(|module| last(module.path).eq_ignore_ascii_case(last(&path)));
        let Some(found) = found else { return from.fail("no such module in the package") };
        if self.program.is_blending() {
            return from.fail("within a corner zone");
        }
        if !path.starts_with("HOME:/") || path.contains('\\') {
            return from.fail("a path begins with HOME:/");
        }
        match (is_load, self.loaded.get(&found)) {
            (true, None) => {
                self.loaded.insert(found, Some(path));
                self.used.push(found);
                self.ambiguous()
            }
            (false, Some(Some(before))) if *before == path => {
                self.loaded.remove(&found);
                Ok(())
            }
            _ => from.fail("loaded already, or not loaded by this path"),
        }
    }
}
