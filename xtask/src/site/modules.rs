//! Joins ES modules into one script: a browser fetches few files instead of many, and the one-file
//! page cannot load others.
//!
//! Each module becomes a block (not a function, because it may await at its top level), after the
//! modules that it needs:
//!
//! ```js
//! import { byId } from "./dom.js";            const module_form = {};
//! export class Form { … }                     {
//!                                             const { byId } = module_dom;
//!                                             class Form { … }
//!                                             Object.assign(module_form, { Form });
//!                                             }
//! ```
//!
//! A script may share modules with an earlier one: it imports `module_form` from there, so that
//! both have the same instance.
//!
//! Doc comments are left out: they are types, for those who change a module.
//!
//! # The dialect
//!
//! It accepts these statements of the module syntax, each starting in the first column of a line:
//!
//! ```js
//! import { a, b as c } from "./one.js";           // over several lines too, up to the semicolon
//! import * as two from "../pkg/two.js";
//! import three, { d } from "./three.js";          // what three.js exports as `default`
//! export const e = 1;                             // one name a declaration
//! export function f() {}
//! export async function g() {}
//! export class H {}
//! export { local, other as i, main as default };  // over several lines too
//! ```
//!
//! Addresses are in double quotes, start with `./` or `../` and stay in the site. These are
//! rejected, as errors of the build: `export default …`, `export let` and `var` (importers get a
//! copy, which would not follow), patterns and generators (`export const { a } = …`, `export
//! function*`), exports from another module (`export … from`), an import for its side effects alone
//! (`import "./a.js"`), single quotes, and circular imports.
//!
//! These are not detected, so avoid them: only the first name of `export const a = 1, b = 2` is
//! exported; an import or export that is indented, or follows another statement on its line, stays
//! as it is and fails in the browser; a line that starts with `import ` or `export ` counts as a
//! statement even in a comment or a template, one that starts with `/**` as a comment even in a
//! template; `import()` and `import.meta.url` start from the joined script.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};

/// Modules in one script, in execution order.
pub(super) struct Script {
    /// The last of them, which also determines the script's address.
    entry: PathBuf,
    modules: Vec<PathBuf>,
    /// A block for each.
    pub(super) text: String,
}

impl Script {
    /// The module at `entry` and all its direct and indirect imports, except those that `earlier`
    /// has. `read` returns the text of a module.
    ///
    /// # Errors
    /// If a module cannot be read, uses unsupported syntax, or imports itself in a circle.
    pub(super) fn new(
        entry: &Path,
        earlier: Option<&Script>,
        read: &dyn Fn(&Path) -> Result<String>,
    ) -> Result<Script> {
        let shared = earlier.map_or(Vec::new(), |script| script.modules.clone());
        let mut text = String::from("\"use strict\";\n");
        if let Some(script) = earlier {
            // Scripts that share modules are in the same folder.
            let file = script.entry.file_name().unwrap_or_default().to_string_lossy();
            text.push_str(&format!("import {{ {} }} from \"./{file}\";\n", names(&shared)));
        }
        let mut done = shared.clone();
        add(entry, read, &mut Vec::new(), &mut done, &mut text)?;
        Ok(Script { entry: entry.to_path_buf(), modules: done.split_off(shared.len()), text })
    }

    /// The script as a module, whose modules others can import.
    pub(super) fn shared(&self) -> String {
        format!("{}export {{ {} }};\n", self.text, names(&self.modules))
    }
}

fn names(modules: &[PathBuf]) -> String {
    modules.iter().map(|path| variable(path)).collect::<Vec<_>>().join(", ")
}

/// Appends a module after its imports. `open` are the modules waiting for this one, `done` those
/// already appended.
fn add(
    path: &Path,
    read: &dyn Fn(&Path) -> Result<String>,
    open: &mut Vec<PathBuf>,
    done: &mut Vec<PathBuf>,
    script: &mut String,
) -> Result<()> {
    if done.iter().any(|each| each == path) {
        return Ok(());
    }
    ensure!(
        !open.iter().any(|each| each == path),
        "modules import each other in a circle: {open:?}, then {path:?} again"
    );
    open.push(path.to_path_buf());
    let module =
        Module::parse(path, &read(path)?).with_context(|| format!("cannot bundle {}", path.display()))?;
    for import in &module.imports {
        add(import, read, open, done, script)?;
    }
    open.pop();
    done.push(path.to_path_buf());
    let Module { body, exports, .. } = module;
    let name = variable(path);
    let exports = exports.join(", ");
    script
        .push_str(&format!("const {name} = {{}};\n{{\n{body}Object.assign({name}, {{ {exports} }});\n}}\n"));
    Ok(())
}

/// A module with its imports and exports translated.
#[derive(Debug, PartialEq)]
struct Module {
    /// The modules it needs.
    imports: Vec<PathBuf>,
    /// Its exports, as the properties of an object: `name` or `name: local`.
    exports: Vec<String>,
    body: String,
}

impl Module {
    fn parse(path: &Path, text: &str) -> Result<Module> {
        let mut module = Module { imports: Vec::new(), exports: Vec::new(), body: String::new() };
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            if is_doc_comment(line) {
                let mut end = line;
                while !end.contains("*/") {
                    end = lines.next().context("a comment does not end")?;
                }
                ensure!(
                    end.trim_end().ends_with("*/"),
                    "something follows a doc comment on its last line: {end}"
                );
                continue;
            }
            if line.starts_with("import ") || line.starts_with("export {") {
                let mut statement = line.to_owned();
                while !statement.contains(';') {
                    statement.push_str(lines.next().context("an import or export does not end")?);
                }
                module.take(path, statement.trim_end().trim_end_matches(';'))?;
            } else if let Some(declaration) = line.strip_prefix("export ") {
                module.exports.push(declared(declaration)?.to_owned());
                module.body.push_str(declaration);
            } else {
                module.body.push_str(line);
            }
            module.body.push('\n');
        }
        Ok(module)
    }

    /// Translates an `import` or `export { … }` statement.
    fn take(&mut self, path: &Path, statement: &str) -> Result<()> {
        if let Some(list) = statement.strip_prefix("export {").and_then(|rest| rest.trim().strip_suffix('}'))
        {
            // `local as name` becomes `name: local`.
            self.exports.extend(items(list).map(|(local, name)| format!("{name}: {local}")));
            return Ok(());
        }
        let unknown = || format!("unsupported syntax: {statement}");
        let (clause, from) = statement
            .strip_prefix("import ")
            .and_then(|rest| rest.split_once(" from "))
            .with_context(unknown)?;
        let from =
            from.trim().strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).with_context(unknown)?;
        let target = beside(path, from)?;
        let module = variable(&target);
        let (first, list) = match clause.split_once('{') {
            Some((first, list)) => (first, list.trim().strip_suffix('}').with_context(unknown)?),
            None => (clause, ""),
        };
        let names: Vec<_> = items(list).map(|(name, local)| format!("{name}: {local}")).collect();
        if !names.is_empty() {
            self.body.push_str(&format!("const {{ {} }} = {module}; ", names.join(", ")));
        }
        for word in first.split(',').map(str::trim).filter(|word| !word.is_empty()) {
            match word.strip_prefix("* as ") {
                Some(namespace) => self.body.push_str(&format!("const {namespace} = {module}; ")),
                None => self.body.push_str(&format!("const {word} = {module}.default; ")),
            }
        }
        self.imports.push(target);
        Ok(())
    }
}

/// Whether a doc comment starts here, and nothing else is on its lines. (A cast is in front of a value.)
fn is_doc_comment(line: &str) -> bool {
    let line = line.trim();
    line.starts_with("/**") && (!line.contains("*/") || line.ends_with("*/"))
}

/// The items of `a, b as c`: each name, and its name on the other side.
fn items(list: &str) -> impl Iterator<Item = (&str, &str)> {
    let words = list.split(',').map(str::trim).filter(|item| !item.is_empty());
    words.map(|item| item.split_once(" as ").unwrap_or((item, item)))
}

/// The name in `function name(…`, `async function name(…`, `class Name …`, `const name = …`.
fn declared(declaration: &str) -> Result<&str> {
    for keyword in ["async function ", "function ", "class ", "const "] {
        if let Some(rest) = declaration.strip_prefix(keyword) {
            let end = rest.find(|c: char| !c.is_alphanumeric() && !"_$".contains(c)).unwrap_or(rest.len());
            ensure!(end > 0, "an export without a name: {declaration}");
            return Ok(&rest[..end]);
        }
    }
    // A copy of a `let` would not follow it.
    bail!("unsupported export: {declaration}")
}

/// The module that `specifier` refers to in `path`.
fn beside(path: &Path, specifier: &str) -> Result<PathBuf> {
    let mut target = path.parent().unwrap_or(Path::new("")).to_path_buf();
    for name in specifier.split('/') {
        match name {
            "." => (),
            ".." => ensure!(target.pop(), "{specifier} leads out of the site"),
            name => target.push(name),
        }
    }
    Ok(target)
}

/// The name of a module's exports in the script.
fn variable(path: &Path) -> String {
    let name = path.with_extension("").to_string_lossy().replace(|c: char| !c.is_ascii_alphanumeric(), "_");
    format!("module_{name}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn script(entry: &str, earlier: Option<&Script>, files: &[(&str, &str)]) -> Result<Script> {
        Script::new(Path::new(entry), earlier, &|path| {
            let file = files.iter().find(|(name, _)| Path::new(name) == path);
            file.map(|(_, text)| (*text).to_owned()).with_context(|| format!("no {}", path.display()))
        })
    }

    fn bundled(files: &[(&str, &str)]) -> Result<String> {
        script(files[0].0, None, files).map(|script| script.text)
    }

    #[test]
    fn modules_become_functions_in_the_order_of_their_needs() {
        let script = bundled(&[
            (
                "js/main.js",
                "import start, * as core from \"../pkg/core.js\";\n\
                 import {\n  a,\n  b as c,\n} from \"./two.js\";\nstart(core, a, c);\n",
            ),
            ("js/two.js", "import { x } from \"../pkg/core.js\";\nexport const a = x;\nexport async function b() {}\nexport class D {}\n"),
            ("pkg/core.js", "function init() {}\nexport const x = 1;\nexport { init as default };\n"),
        ])
        .unwrap();
        assert_eq!(
            script,
            "\"use strict\";\n\
             const module_pkg_core = {};\n{\nfunction init() {}\nconst x = 1;\n\nObject.assign(module_pkg_core, { x, default: init });\n}\n\
             const module_js_two = {};\n{\nconst { x: x } = module_pkg_core; \nconst a = x;\n\
             async function b() {}\nclass D {}\nObject.assign(module_js_two, { a, b, D });\n}\n\
             const module_js_main = {};\n{\nconst start = module_pkg_core.default; const core = module_pkg_core; \n\
             const { a: a, b: c } = module_js_two; \nstart(core, a, c);\nObject.assign(module_js_main, {  });\n}\n"
        );
    }

    #[test]
    fn a_later_script_shares_the_modules_of_an_earlier_one() {
        let files = [
            ("js/first.js", "import { x } from \"./both.js\";\nx();\n"),
            ("js/both.js", "export function x() {}\n"),
            ("js/own.js", "export const y = 1;\n"),
            ("js/later.js", "import { x } from \"./both.js\";\nimport { y } from \"./own.js\";\nx(y);\n"),
        ];
        let first = script("js/first.js", None, &files).unwrap();
        assert!(
            first.shared().ends_with("export { module_js_both, module_js_first };\n"),
            "{}",
            first.shared()
        );
        let later = script("js/later.js", Some(&first), &files).unwrap();
        let start = "\"use strict\";\nimport { module_js_both, module_js_first } from \"./first.js\";\nconst module_js_own = {};\n";
        assert!(later.text.starts_with(start), "{}", later.text);
        assert!(later.text.contains("const { x: x } = module_js_both;"), "{}", later.text);
        assert!(later.shared().ends_with("export { module_js_own, module_js_later };\n"));
    }

    #[test]
    fn doc_comments_stay_behind_and_casts_do_not() {
        let text = "/** One line. */\nconst a = 1;\n  /**\n   * @type {import(\"./b.js\").B}\n   */\nexport const b = a; // said\n\
                    /** @type {any} */ (b).c = 2;\nf(/** @type {A} */ (a));\n";
        assert_eq!(
            bundled(&[("a.js", text)]).unwrap(),
            "\"use strict\";\nconst module_a = {};\n{\nconst a = 1;\nconst b = a; // said\n\
             /** @type {any} */ (b).c = 2;\nf(/** @type {A} */ (a));\nObject.assign(module_a, { b });\n}\n"
        );
        for text in ["/** never ends\n", "/**\n * code behind it is lost */ f();\n"] {
            assert!(bundled(&[("a.js", text)]).is_err(), "{text}");
        }
    }

    #[test]
    fn what_would_change_its_meaning_is_refused() {
        for text in [
            "export let x = 1;",
            "export default 1;",
            "export * from \"./b.js\";",
            "export { x } from \"./b.js\";",
            "import \"./b.js\";",
            "import { a } from './b.js';",
            "import { a } from \"../../b.js\";",
            "export const { a } = b;",
        ] {
            assert!(bundled(&[("js/a.js", text), ("js/b.js", "")]).is_err(), "{text}");
        }
        let circle = [("a.js", "import { b } from \"./b.js\";"), ("b.js", "import { a } from \"./a.js\";")];
        assert!(bundled(&circle).unwrap_err().to_string().contains("circle"));
    }
}
