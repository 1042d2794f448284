//! Reads attributes as values, with a finding for each oddity.

use super::raw::{Element, shown};
use super::words::Word;
use crate::finding::{Finding, Mend};
use crate::tally::Findings;
use chereme_sign::hamnosys::{Bend, Compass, Digit, Digits, Direction, orientation};

/// An element whose attributes are read one by one.
pub(super) struct Node<'e, 'f> {
    pub(super) element: &'e Element<'e>,
    pub(super) findings: &'f mut Findings,
    taken: u64,
}

impl<'e, 'f> Node<'e, 'f> {
    pub(super) fn new(element: &'e Element<'e>, findings: &'f mut Findings) -> Self {
        Self {
            element,
            findings,
            taken: 0,
        }
    }

    /// Adds a note about the element.
    pub(super) fn note(&mut self, kind: &'static str, message: impl FnOnce(&str) -> String) {
        let element = self.element;
        self.findings.add(kind, || {
            Finding::note(element.line.0, message(&shown(&element.name)))
        });
    }

    /// Adds a warning about the element.
    pub(super) fn warn(&mut self, kind: &'static str, message: impl FnOnce(&str) -> String) {
        let element = self.element;
        self.findings.add(kind, || {
            Finding::warning(element.line.0, message(&shown(&element.name)))
        });
    }

    /// Reports an oddity of the element that the caller can mend.
    pub(super) fn warn_of(
        &mut self,
        kind: &'static str,
        mend: Mend,
        message: impl FnOnce(&str) -> String,
    ) {
        let element = self.element;
        self.findings.add(kind, || Finding {
            mend: Some(mend),
            ..Finding::warning(element.line.0, message(&shown(&element.name)))
        });
    }

    /// Returns an attribute as written.
    pub(super) fn text(&mut self, name: &str) -> Option<&'e str> {
        let all = &self.element.attributes;
        let at = all.iter().position(|(known, _)| known == name)?;
        self.taken |= 1 << at;
        Some(&all[at].1)
    }

    /// Returns the attribute parsed by `read`; if that fails, leaves it out with a warning that gives the
    /// `right` form.
    pub(super) fn parsed<T>(
        &mut self,
        name: &str,
        right: &str,
        read: impl FnOnce(&str) -> Option<T>,
    ) -> Option<T> {
        let text = self.text(name)?;
        let value = read(text.trim());
        if value.is_none() {
            let element = self.element;
            self.findings.add("values that mean nothing", || {
                let (tag, text) = (shown(&element.name), shown(text));
                let message =
                    format!("<{tag} {name}={text:?}>: the value means nothing; it was left out");
                Finding::warning(element.line.0, message).with_remedy(format!("write {right}"))
            });
        }
        value
    }

    /// Returns a value that is spelled with one word.
    pub(super) fn word<T: Word>(&mut self, name: &str) -> Option<T> {
        let right = || {
            let words: Vec<_> = T::WORDS.iter().map(|(word, _)| *word).collect();
            words.join(", ")
        };
        let text = self.text(name)?;
        if let Some(value) = T::of(text.trim()) {
            return Some(value);
        }
        let value = self.parsed(name, &format!("one of {}", right()), loose::<T>)?;
        self.note("words spelled oddly", |tag| {
            let (text, word) = (shown(text), value.word());
            format!("<{tag} {name}={text:?}> was read as {word:?}")
        });
        Some(value)
    }

    /// Returns whether a flag is set.
    pub(super) fn flag(&mut self, name: &str) -> bool {
        if self.element.attributes.is_empty() {
            return false;
        }
        let read = |text: &str| match &*text.to_ascii_lowercase() {
            "true" | "1" | "yes" => Some(true),
            "false" | "0" | "no" => Some(false),
            _ => None,
        };
        self.parsed(name, "true or false", read).unwrap_or(false)
    }

    /// Returns a positive number.
    pub(super) fn number(&mut self, name: &str) -> Option<f64> {
        self.parsed(name, "a number above 0, with a point", |text| {
            let number: f64 = text.parse().ok()?;
            (number.is_finite() && number > 0.0).then_some(number)
        })
    }

    /// Returns a number from 1 to 5.
    pub(super) fn name_number(&mut self, name: &str) -> Option<u8> {
        self.parsed(name, "a number from 1 to 5", |text| {
            text.parse().ok().filter(|number| (1..=5).contains(number))
        })
    }

    /// Returns one of the 26 directions; repeated letters are ignored.
    pub(super) fn direction(&mut self, name: &str) -> Option<Direction> {
        const RIGHT: &str = "one to three of u or d, o or i, l or r, such as u, ol or dir";
        let text = self.text(name)?;
        let lower = text.trim().to_ascii_lowercase();
        let once: String = lower
            .char_indices()
            .filter(|(at, letter)| !lower[..*at].contains(*letter))
            .map(|(_, letter)| letter)
            .collect();
        let direction = self.parsed(name, RIGHT, |_| once.parse::<Direction>().ok())?;
        let canonical = direction.to_string();
        if canonical != text {
            self.findings.add("directions spelled oddly", || {
                let (line, text) = (self.element.line.0, shown(text));
                let message = format!("{name}={text:?} was read as {canonical:?}");
                Finding::note(line, message).with_remedy(format!("write {canonical:?}"))
            });
        }
        Some(direction)
    }

    /// Returns one of the eight directions about an axis; letters for out and in have no meaning there and
    /// are ignored.
    pub(super) fn compass(&mut self, name: &str) -> Option<Compass> {
        const RIGHT: &str = "one of u, ur, r, dr, d, dl, l, ul";
        let text = self.text(name)?;
        let kept = text.trim().to_ascii_lowercase().replace(['o', 'i'], "");
        let of_parts = |text: &str| {
            let canonical = text.parse::<Direction>().ok()?.to_string();
            canonical.parse::<Compass>().ok()
        };
        let compass = self.parsed(name, RIGHT, |_| of_parts(&kept))?;
        if compass.letters() != text {
            self.findings
                .add("palms and curves with letters out of place", || {
                    let (line, text) = (self.element.line.0, shown(text));
                    let message = format!(
                        "{name}={text:?} is not one of the eight directions; it was read as \"{compass}\""
                    );
                    Finding::warning(line, message).with_remedy(format!("write {RIGHT}"))
                });
        }
        Some(compass)
    }

    /// Like [`compass`](Self::compass), for the palm of a hand that points in a direction: a palm that only faces
    /// out or in, towards or away from the signer, is the nearest of the eight about that direction.
    pub(super) fn palm(&mut self, name: &str, pointing: Option<Direction>) -> Option<Compass> {
        let text = self.text(name)?;
        let faces = match text.trim().to_ascii_lowercase().as_str() {
            "o" => [0.0, 0.0, 1.0],
            "i" => [0.0, 0.0, -1.0],
            _ => return self.compass(name),
        };
        let near = |compass: &Compass, along: [f64; 3]| {
            let palm = orientation::palm(along, compass.angle());
            palm.iter().zip(faces).map(|(a, b)| a * b).sum::<f64>()
        };
        let along = pointing.map(Direction::vector);
        let nearest = along.and_then(|along| {
            let all = Compass::ALL.into_iter().map(|it| (it, near(&it, along)));
            let best = all.max_by(|a, b| a.1.total_cmp(&b.1));
            best.filter(|(_, share)| *share > 0.3)
        });
        let Some((compass, _)) = nearest else {
            return self.compass(name);
        };
        self.findings.add("palms that face out or in", || {
            let (line, text) = (self.element.line.0, shown(text));
            let message = format!(
                "{name}={text:?} is none of the eight directions; on a hand that points so it was read as \"{compass}\""
            );
            Finding::note(line, message).with_remedy(format!("write {name}=\"{compass}\""))
        });
        Some(compass)
    }

    /// Reports fingers that change one after the other, which the tree of a sign does not hold.
    pub(super) fn successive(&mut self, name: &str) {
        let Some(text) = self.text(name) else { return };
        self.findings
            .add("fingers that change one after the other", || {
                let (line, text) = (self.element.line.0, shown(text));
                let message = format!("{name}={text:?}: the fingers change all at once");
                Finding::note(line, message).with_remedy(
                    "write one <changeposture> for each finger, if their order matters",
                )
            });
    }

    /// Returns a bend: a word, or three numbers from 0 to 4.
    pub(super) fn bend(&mut self, name: &str) -> Option<Bend> {
        const RIGHT: &str =
            "bent, round, hooked, dblbent, dblhooked, halfbent or three digits from 0 to 4";
        let text = self.text(name)?;
        let bend = self.parsed(name, RIGHT, |text| bend_of(text).map(|(bend, _)| bend))?;
        if let Some((_, Spelling::Odd)) = bend_of(text.trim()) {
            self.findings.add("bends as decimals", || {
                let (line, text) = (self.element.line.0, shown(text));
                let read = bend_text(bend);
                let message = format!(
                    "{name}={text:?} was read as the bends {read} of three joints, 4 being as far as goes"
                );
                Finding::note(line, message).with_remedy(format!("write {RIGHT}"))
            });
        } else if matches!(bend, Bend::Joints(_)) {
            self.note("bends as numbers", |tag| {
                format!(
                    "<{tag} {name}={:?}>: the bend is given joint by joint",
                    shown(text)
                )
            });
        }
        Some(bend)
    }

    /// Returns digits, each once.
    pub(super) fn digits(&mut self, name: &str) -> Digits {
        let Some(text) = self.text(name) else {
            return Digits::default();
        };
        let mut digits = Vec::new();
        let mut odd = false;
        for letter in text.chars() {
            match digit_of(letter) {
                Some(digit) if !digits.contains(&digit) => digits.push(digit),
                _ => odd = true,
            }
        }
        if odd {
            let read = digits_text(&digits);
            self.warn("digits spelled oddly", |tag| {
                let text = shown(text);
                format!("<{tag} {name}={text:?}> was read as {read:?}; write digits from 1 (thumb) to 5, each once")
            });
        }
        Digits(digits)
    }

    /// Returns two different digits.
    pub(super) fn pair(&mut self, name: &str) -> Option<(Digit, Digit)> {
        self.parsed(name, "two digits from 1 (thumb) to 5", |text| {
            let mut letters = text.chars();
            let pair = (digit_of(letters.next()?)?, digit_of(letters.next()?)?);
            letters.next().is_none().then_some(pair)
        })
    }

    /// Returns one digit.
    pub(super) fn digit(&mut self, name: &str) -> Option<Digit> {
        self.parsed(name, "a digit from 1 (thumb) to 5", |text| {
            let mut letters = text.chars();
            let digit = digit_of(letters.next()?)?;
            letters.next().is_none().then_some(digit)
        })
    }

    /// Reports every attribute that was not read.
    pub(super) fn finish(self) {
        let element = self.element;
        for (at, (name, value)) in element.attributes.iter().enumerate() {
            if self.taken & (1 << at) == 0 {
                self.findings.add("attributes that are not known", || {
                    let (tag, name, value) = (shown(&element.name), shown(name), shown(value));
                    let message =
                        format!("<{tag}> has no attribute {name}={value:?}; it was left out");
                    Finding::warning(element.line.0, message)
                });
            }
        }
    }
}

/// Returns the value of a word in another case, or of the name of HamNoSys's symbol.
fn loose<T: Word>(text: &str) -> Option<T> {
    let lower = text.to_ascii_lowercase();
    let plain = lower.strip_prefix("ham").unwrap_or(&lower);
    let plain = plain.strip_suffix("mod").unwrap_or(plain);
    T::of(plain).or_else(|| T::of(plain.strip_suffix("hand")?))
}

fn digit_of(letter: char) -> Option<Digit> {
    let number = letter.to_digit(10)?.checked_sub(1)?;
    Digit::ALL.get(number as usize).copied()
}

/// Returns digits as SiGML writes them.
pub(super) fn digits_text(digits: &[Digit]) -> String {
    digits
        .iter()
        .map(|digit| digit.number().to_string())
        .collect()
}

const BENDS: [(&str, Bend); 6] = [
    ("bent", Bend::Bent),
    ("round", Bend::Round),
    ("hooked", Bend::Hooked),
    ("dblbent", Bend::DoubleBent),
    ("dblhooked", Bend::DoubleHooked),
    ("halfbent", Bend::HalfBent),
];

/// The spellings of the numbers of a bend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Spelling {
    /// In words or digits, or with blanks between them.
    Usual,
    /// As decimals without separators.
    Odd,
}

fn bend_of(text: &str) -> Option<(Bend, Spelling)> {
    if let Some((_, bend)) = BENDS.iter().find(|(word, _)| *word == text) {
        return Some((*bend, Spelling::Usual));
    }
    let (parts, spelling): (Vec<String>, _) = if text.contains(' ') {
        let parts = text.split_ascii_whitespace().map(str::to_owned).collect();
        (parts, Spelling::Usual)
    } else {
        (
            joined(text)?,
            if text.contains('.') {
                Spelling::Odd
            } else {
                Spelling::Usual
            },
        )
    };
    let joints: Vec<f64> = parts
        .iter()
        .map(|part| part.parse().ok())
        .collect::<Option<_>>()?;
    let joints: [f64; 3] = joints.try_into().ok()?;
    let fits = joints.iter().all(|joint| (0.0..=4.0).contains(joint));
    fits.then_some((Bend::Joints(joints), spelling))
}

/// Splits numbers without separators: each is a digit, or a digit, a point and one decimal.
fn joined(text: &str) -> Option<Vec<String>> {
    let mut parts: Vec<String> = Vec::new();
    let mut letters = text.chars().take(16).peekable();
    while let Some(letter) = letters.next() {
        if !letter.is_ascii_digit() {
            return None;
        }
        let mut part = letter.to_string();
        if letters.next_if_eq(&'.').is_some() {
            part.push('.');
            part.push(letters.next()?);
        }
        parts.push(part);
    }
    Some(parts)
}

/// Returns a bend as SiGML writes it: a word; else three digits, or three numbers with blanks.
pub(super) fn bend_text(bend: Bend) -> String {
    if let Some((word, _)) = BENDS.iter().find(|(_, known)| *known == bend) {
        return (*word).to_owned();
    }
    let Bend::Joints(joints) = bend else {
        return String::new();
    };
    let whole = joints.iter().all(|joint| joint.fract() == 0.0);
    let parts = joints.map(|joint| (joint + 0.0).to_string());
    parts.join(if whole { "" } else { " " })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bends_are_read_from_words_digits_and_decimals() {
        let joints = |a, b, c| Some(Bend::Joints([a, b, c]));
        for (text, expected) in [
            ("bent", Some(Bend::Bent)),
            ("dblhooked", Some(Bend::DoubleHooked)),
            ("410", joints(4.0, 1.0, 0.0)),
            ("0.50.50.5", joints(0.5, 0.5, 0.5)),
            ("0.25 1 4", joints(0.25, 1.0, 4.0)),
            ("41", None),
            ("4100", None),
            ("510", None),
            ("0.5.5.5", None),
            ("", None),
            ("NaN 1 1", None),
            ("é", None),
        ] {
            assert_eq!(bend_of(text).map(|(bend, _)| bend), expected, "{text}");
            if let Some(bend) = expected {
                let again = bend_of(&bend_text(bend)).map(|(bend, _)| bend);
                assert_eq!(again, Some(bend), "{text}");
            }
        }
    }
}
