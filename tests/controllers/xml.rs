//! Well-formed XML, as much of it as controllers' files use: elements, attributes, text, CDATA and comments. No
//! entities but the five of the language, no processing instructions after the first line.

/// An element.
#[derive(Debug, Clone)]
pub(super) struct Element {
    pub(super) line: usize,
    pub(super) name: String,
    pub(super) attributes: Vec<(String, String)>,
    pub(super) children: Vec<Element>,
    /// All text within it, not that of its children.
    pub(super) text: String,
}

impl Element {
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(other, _)| other == name).map(|(_, value)| value.as_str())
    }
}

struct Reader<'a> {
    file: &'a str,
    text: &'a str,
    at: usize,
}

/// The root of a document.
pub(super) fn document(file: &str, text: &str) -> Result<Element, String> {
    let mut reader = Reader { file, text, at: 0 };
    if reader.take("<?xml ") {
        let first = reader.until("?>")?;
        if !first.starts_with("version=\"1.0\" encoding=\"") {
            return reader.fail("not the declaration of XML 1.0");
        }
    }
    reader.space()?;
    let root = reader.element()?;
    reader.space()?;
    if reader.rest().is_empty() { Ok(root) } else { reader.fail("something after the root") }
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn line(&self) -> usize {
        1 + self.text[..self.at].matches('\n').count()
    }

    fn fail<T>(&self, what: &str) -> Result<T, String> {
        Err(format!("{}:{}: XML: {what}", self.file, self.line()))
    }

    fn take(&mut self, token: &str) -> bool {
        let found = self.rest().starts_with(token);
        self.at += if found { token.len() } else { 0 };
        found
    }

    fn until(&mut self, mark: &str) -> Result<&'a str, String> {
        match self.rest().split_once(mark) {
            Some((inner, _)) => {
                self.at += inner.len() + mark.len();
                Ok(inner)
            }
            None => self.fail(&format!("no {mark} follows")),
        }
    }

    /// Passes over blanks and comments.
    fn space(&mut self) -> Result<(), String> {
        loop {
            self.at += self.rest().len() - self.rest().trim_start().len();
            if !self.take("<!--") {
                return Ok(());
            }
            self.until("-->")?;
        }
    }

    fn name(&mut self) -> Result<String, String> {
        let rest = self.rest();
        let is_part = |letter: char| letter.is_ascii_alphanumeric() || "_:-.".contains(letter);
        let length = rest.find(|letter| !is_part(letter)).unwrap_or(rest.len());
        if !rest.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_') {
            return self.fail("a name is missing");
        }
        self.at += length;
        Ok(rest[..length].to_owned())
    }

    /// Text with its entities replaced.
    fn plain(&self, text: &str) -> Result<String, String> {
        let mut plain = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('&') {
            let Some((entity, tail)) = after.split_once(';') else { return self.fail("& without ;") };
            let letter = match entity {
                "amp" => '&',
                "lt" => '<',
                "gt" => '>',
                "quot" => '"',
                "apos" => '\'',
                _ => return self.fail("an entity that is not known"),
            };
            plain.push_str(before);
            plain.push(letter);
            rest = tail;
        }
        Ok(plain + rest)
    }

    fn element(&mut self) -> Result<Element, String> {
        let line = self.line();
        if !self.take("<") {
            return self.fail("an element is missing");
        }
        let name = self.name()?;
        let mut element =
            Element { line, name, attributes: Vec::new(), children: Vec::new(), text: String::new() };
        loop {
            let before = self.at;
            self.at += self.rest().len() - self.rest().trim_start().len();
            if self.take("/>") {
                return Ok(element);
            }
            if self.take(">") {
                break;
            }
            if self.at == before {
                return self.fail("no blank before an attribute");
            }
            let attribute = self.name()?;
            if !self.take("=\"") || element.attribute(&attribute).is_some() {
                return self.fail("an attribute has no value, or stands twice");
            }
            let value = self.until("\"")?;
            if value.contains('<') {
                return self.fail("< within an attribute");
            }
            let value = self.plain(value)?;
            element.attributes.push((attribute, value));
        }
        loop {
            if self.take("</") {
                let name = self.name()?;
                return match self.take(">") && name == element.name {
                    true => Ok(element),
                    false => self.fail(&format!("</{}> is missing", element.name)),
                };
            }
            if self.take("<![CDATA[") {
                element.text.push_str(self.until("]]>")?);
            } else if self.take("<!--") {
                self.until("-->")?;
            } else if self.rest().starts_with('<') {
                element.children.push(self.element()?);
            } else {
                let length = self.rest().find('<').unwrap_or(self.rest().len());
                if length == 0 {
                    return self.fail(&format!("</{}> is missing", element.name));
                }
                let text = self.plain(&self.rest()[..length])?;
                self.at += length;
                element.text.push_str(&text);
            }
        }
    }
}
