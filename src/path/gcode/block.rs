//! One line of a program: its codes by modal group, and its other words, each used once.

use super::code::{self, GROUPS, Group, Meaning};
use super::interpreter::AXES;
use super::siemens::{Siemens, SiemensCycle};
use super::variables::Variables;
use super::word::{self, Word, WordFault};

/// A G or M code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Code {
    /// Code number in tenths: `G43.1` is 431.
    pub(super) tenths: u32,
    /// The word as written, with its place.
    pub(super) word: Word,
}

/// One line, ready for the interpreter: each handler consumes the words it understands, and
/// leftover words are an error.
#[derive(Debug, Default)]
pub(super) struct Block<'t> {
    /// The line.
    pub(super) text: &'t str,
    codes: [Option<Code>; GROUPS],
    /// Whether there are any; lines of a few words need not look at each group.
    coded: bool,
    /// The letters of the words, a bit each.
    letters: u32,
    /// What a Siemens cycle of the line asks for besides its words.
    pub(super) cycle: Option<SiemensCycle>,
    /// Whether an axis word stands in the line.
    has_axis: bool,
    /// Words other than G, M and N, in order.
    words: Vec<Word>,
    /// Codes without effect, in order, each with the letters that it takes along.
    pub(super) harmless: Vec<(Word, &'static [char])>,
}

/// The bit of a capital letter, `@` or `^`: their codes follow one another.
fn bit(letter: char) -> u32 {
    1 << (u32::from(letter) - u32::from('@'))
}

impl<'t> Block<'t> {
    /// Reads a line from the byte `from` on; reuses the block's storage.
    pub(super) fn read(
        &mut self,
        text: &'t str,
        from: usize,
        variables: &mut Variables,
        siemens: Option<&mut Siemens>,
    ) -> Result<(), WordFault> {
        self.text = text;
        if std::mem::take(&mut self.coded) {
            self.codes = [None; GROUPS];
        }
        self.words.clear();
        self.harmless.clear();
        self.cycle = None;
        match siemens {
            Some(siemens) => {
                siemens.words(text, from, &mut self.words, variables)?;
                self.cycle = siemens.cycle;
            }
            None => word::words(text, from, &mut self.words, variables)?,
        }
        self.sort()
    }

    /// Sorts the codes into their groups and drops the line number.
    fn sort(&mut self) -> Result<(), WordFault> {
        let text = self.text;
        let mut words = std::mem::take(&mut self.words);
        self.has_axis = words.iter().any(|word| AXES.contains(&word.letter));
        let mut seen = 0_u32;
        let mut first = true;
        let mut kept = 0;
        for index in 0..words.len() {
            let word = words[index];
            match word.letter {
                'G' | 'M' => self.add_code(word)?,
                'N' if first => _ = word.whole(text, 0, 999_999_999)?,
                'N' => return Err(word.fault(text, "the line number N comes first in its line")),
                letter => {
                    let bit = bit(letter);
                    if seen & bit != 0 {
                        return Err(
                            word.fault(text, format!("a line holds one {letter} word, this is the second"))
                        );
                    }
                    seen |= bit;
                    words[kept] = word;
                    kept += 1;
                }
            }
            first = false;
        }
        words.truncate(kept);
        self.words = words;
        self.letters = seen;
        Ok(())
    }

    fn add_code(&mut self, word: Word) -> Result<(), WordFault> {
        let exact = word.value * 10.0;
        let tenths = exact.round();
        let known = (exact - tenths).abs() < 1e-6 && (0.0..10_000.0).contains(&tenths);
        // No code has the number 1000, so it is refused as unknown.
        let tenths = if known { tenths as u32 } else { 10_000 };
        let meaning = match word.letter {
            // G5 P switches look-ahead; a spline has X and Y.
            'G' if tenths == 50 && !self.has_axis => Meaning::Harmless(&['P']),
            'G' => code::g(tenths),
            _ => code::m(tenths),
        };
        match meaning {
            Meaning::Refused(instead) => Err(word.fault(self.text, instead)),
            Meaning::Harmless(letters) => {
                self.harmless.push((word, letters));
                Ok(())
            }
            Meaning::Acts(group) => match self.codes[group as usize] {
                // Written twice, it is one code.
                Some(other) if other.tenths == tenths => Ok(()),
                Some(other) => {
                    let other = other.word.text(self.text);
                    Err(word.fault(
                        self.text,
                        format!("a line holds one code of each modal group, and {other} is already there"),
                    ))
                }
                None => {
                    self.codes[group as usize] = Some(Code { tenths, word });
                    self.coded = true;
                    Ok(())
                }
            },
        }
    }

    /// Whether the line has no word except a line number.
    pub(super) fn is_empty(&self) -> bool {
        self.words.is_empty() && self.harmless.is_empty() && !self.coded
    }

    /// The code of a group.
    pub(super) fn code(&self, group: Group) -> Option<Code> {
        self.codes[group as usize]
    }

    /// Whether the group holds this code.
    pub(super) fn has(&self, group: Group, tenths: u32) -> bool {
        self.code(group).is_some_and(|code| code.tenths == tenths)
    }

    /// The word with this letter, not consumed.
    pub(super) fn peek(&self, letter: char) -> Option<Word> {
        if self.letters & bit(letter) == 0 {
            return None;
        }
        self.words.iter().find(|word| word.letter == letter).copied()
    }

    /// The first word with one of these letters, not consumed.
    pub(super) fn first_of(&self, letters: &[char]) -> Option<Word> {
        self.words.iter().find(|word| letters.contains(&word.letter)).copied()
    }

    /// Consumes the word with this letter.
    pub(super) fn take(&mut self, letter: char) -> Option<Word> {
        if self.letters & bit(letter) == 0 {
            return None;
        }
        let index = self.words.iter().position(|word| word.letter == letter)?;
        Some(self.words.remove(index))
    }

    /// The words that are left.
    pub(super) fn words(&self) -> &[Word] {
        &self.words
    }

    /// Adds a word.
    pub(super) fn put(&mut self, word: Word) {
        self.letters |= bit(word.letter);
        self.words.push(word);
    }

    /// Byte of the block's first word, for errors about the whole block.
    pub(super) fn start(&self) -> usize {
        self.text.len() - self.text.trim_start().len()
    }

    /// Fails on the first leftover word.
    pub(super) fn finish(&self) -> Result<(), WordFault> {
        let Some(word) = self.words.first() else { return Ok(()) };
        let expected = match word.letter {
            'A' | 'B' | 'C' => {
                "rotary axes are not supported in G-code: post for three axes, or use APT or CSV with tool axes"
            }
            'U' | 'V' | 'W' => "secondary axes are not supported: post X, Y and Z",
            'I' | 'J' | 'K' => "I, J and K give the centre of an arc and need G2 or G3 in force",
            'R' => "R is the radius of an arc (G2, G3) or the clearance plane of a canned cycle",
            'P' => "P belongs to G4 (seconds), G2 and G3 (turns), G64, G82 or G89, once a line",
            'Q' => "Q belongs to G73 and G83 (depth of a peck)",
            'L' => "L repeats a canned cycle and needs one in force",
            'H' => "H names a tool length offset and needs G43 in its line",
            'D' => {
                "D names a cutter radius offset, which is not modelled: post the path of the tool's centre"
            }
            'E' => "E is not a milling word; an exponent needs a sign: X1e-05",
            _ => "no word starts with this letter; known are F G H I J K L M N O P Q R S T X Y Z",
        };
        Err(word.fault(self.text, expected))
    }
}
