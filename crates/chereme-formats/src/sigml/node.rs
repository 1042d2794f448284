//! Reads attributes as values, with a finding for each oddity.

use super::sigml_raw::{SigmlElement, shorten_sigml_text};
use super::sigml_words::SigmlWord;
use crate::finding::{ImportFinding, ReaderCorrection};
use crate::tally::FindingTally;
use chereme_sign::hamnosys::{CompassDirection, DigitList, FingerBend, HandDigit, SpatialDirection, orientation};

/// An element whose attributes are read one by one.
pub(super) struct AttributeReader<'e, 'f> {
    pub(super) element: &'e SigmlElement<'e>,
    pub(super) findings: &'f mut FindingTally,
    taken: u64,
}

impl<'e, 'f> AttributeReader<'e, 'f> {
    pub(super) fn new(element: &'e SigmlElement<'e>, findings: &'f mut FindingTally) -> Self {
        Self {
            element,
            findings,
            taken: 0,
        }
    }

    /// Adds a note about the element.
    pub(super) fn add_element_note(&mut self, kind: &'static str, message: impl FnOnce(&str) -> String) {
        let element = self.element;
        self.findings
            .add_limited_note(kind, element.line.0, || message(&shorten_sigml_text(&element.name)));
    }

    /// Adds a warning about the element.
    pub(super) fn add_element_warning(&mut self, kind: &'static str, message: impl FnOnce(&str) -> String) {
        let element = self.element;
        self.findings
            .add_limited_warning(kind, element.line.0, || message(&shorten_sigml_text(&element.name)));
    }

    /// Reports an oddity of the element that the caller can mend.
    pub(super) fn warn_of(&mut self, kind: &'static str, mend: ReaderCorrection, message: impl FnOnce(&str) -> String) {
        let element = self.element;
        self.findings.add_limited_finding(kind, || ImportFinding {
            mend: Some(mend),
            ..ImportFinding::new_warning_finding(element.line.0, message(&shorten_sigml_text(&element.name)))
        });
    }

    /// Returns an attribute as written.
    pub(super) fn attribute_text(&mut self, name: &str) -> Option<&'e str> {
        let all = &self.element.attributes;
        let attribute_index = all.iter().position(|(known, _)| known == name)?;
        self.taken |= 1 << attribute_index;
        Some(&all[attribute_index].1)
    }

    /// Returns the attribute parsed by `read`; if that fails, leaves it out with a warning that gives the
    /// `right` form.
    pub(super) fn parse_attribute<T>(
        &mut self,
        name: &str,
        right: &str,
        read: impl FnOnce(&str) -> Option<T>,
    ) -> Option<T> {
        let text = self.attribute_text(name)?;
        let value = read(text.trim());
        if value.is_none() {
            let element = self.element;
            self.findings.add_limited_finding("values that mean nothing", || {
                let (tag, text) = (shorten_sigml_text(&element.name), shorten_sigml_text(text));
                let message = format!("<{tag} {name}={text:?}>: the value means nothing; it was left out");
                ImportFinding::new_warning_finding(element.line.0, message).with_remedy(format!("write {right}"))
            });
        }
        value
    }

    /// Returns a value that is spelled with one word.
    pub(super) fn read_word_attribute<T: SigmlWord>(&mut self, name: &str) -> Option<T> {
        let right = || {
            let words: Vec<_> = T::WORD_VALUES.iter().map(|(word, _)| *word).collect();
            words.join(", ")
        };
        let text = self.attribute_text(name)?;
        if let Some(value) = T::from_sigml_word(text.trim()) {
            return Some(value);
        }
        let value = self.parse_attribute(name, &format!("one of {}", right()), parse_loose_word::<T>)?;
        self.add_element_note("words spelled oddly", |tag| {
            let (text, word) = (shorten_sigml_text(text), value.sigml_word());
            format!("<{tag} {name}={text:?}> was read as {word:?}")
        });
        Some(value)
    }

    /// Returns whether a flag is set.
    pub(super) fn read_flag_attribute(&mut self, name: &str) -> bool {
        if self.element.attributes.is_empty() {
            return false;
        }
        let read = |text: &str| match &*text.to_ascii_lowercase() {
            "true" | "1" | "yes" => Some(true),
            "false" | "0" | "no" => Some(false),
            _ => None,
        };
        self.parse_attribute(name, "true or false", read).unwrap_or(false)
    }

    /// Returns a positive number.
    pub(super) fn read_positive_number(&mut self, name: &str) -> Option<f64> {
        self.parse_attribute(name, "a number above 0, with a point", |text| {
            let number: f64 = text.parse().ok()?;
            (number.is_finite() && number > 0.0).then_some(number)
        })
    }

    /// Returns a number from 1 to 5.
    pub(super) fn name_number(&mut self, name: &str) -> Option<u8> {
        self.parse_attribute(name, "a number from 1 to 5", |text| {
            text.parse().ok().filter(|number| (1..=5).contains(number))
        })
    }

    /// Returns one of the 26 directions; repeated letters are ignored.
    pub(super) fn read_direction_attribute(&mut self, name: &str) -> Option<SpatialDirection> {
        const DIRECTION_ATTRIBUTE_FORM: &str = "one to three of u or d, o or i, l or r, such as u, ol or dir";
        let text = self.attribute_text(name)?;
        let lower = text.trim().to_ascii_lowercase();
        let once: String = lower
            .char_indices()
            .filter(|(at, letter)| !lower[..*at].contains(*letter))
            .map(|(_, letter)| letter)
            .collect();
        let direction = self.parse_attribute(name, DIRECTION_ATTRIBUTE_FORM, |_| {
            once.parse::<SpatialDirection>().ok()
        })?;
        let canonical = direction.to_string();
        if canonical != text {
            self.findings.add_limited_finding("directions spelled oddly", || {
                let (line, text) = (self.element.line.0, shorten_sigml_text(text));
                let message = format!("{name}={text:?} was read as {canonical:?}");
                ImportFinding::new_note_finding(line, message).with_remedy(format!("write {canonical:?}"))
            });
        }
        Some(direction)
    }

    /// Returns one of the eight directions about an axis; letters for out and in have no meaning there and
    /// are ignored.
    pub(super) fn read_compass_attribute(&mut self, name: &str) -> Option<CompassDirection> {
        const COMPASS_ATTRIBUTE_FORM: &str = "one of u, ur, r, dr, d, dl, l, ul";
        let text = self.attribute_text(name)?;
        let kept = text.trim().to_ascii_lowercase().replace(['o', 'i'], "");
        let of_parts = |text: &str| {
            let canonical = text.parse::<SpatialDirection>().ok()?.to_string();
            canonical.parse::<CompassDirection>().ok()
        };
        let compass = self.parse_attribute(name, COMPASS_ATTRIBUTE_FORM, |_| of_parts(&kept))?;
        if compass.compass_letters() != text {
            self.findings
                .add_limited_finding("palms and curves with letters out of place", || {
                    let (line, text) = (self.element.line.0, shorten_sigml_text(text));
                    let message =
                        format!("{name}={text:?} is not one of the eight directions; it was read as \"{compass}\"");
                    ImportFinding::new_warning_finding(line, message)
                        .with_remedy(format!("write {COMPASS_ATTRIBUTE_FORM}"))
                });
        }
        Some(compass)
    }

    /// Like [`compass`](Self::compass), for the palm of a hand that points in a direction: a palm that only faces
    /// out or in, towards or away from the signer, is the nearest of the eight about that direction.
    pub(super) fn read_palm_attribute(
        &mut self,
        name: &str,
        pointing: Option<SpatialDirection>,
    ) -> Option<CompassDirection> {
        let text = self.attribute_text(name)?;
        let faces = match text.trim().to_ascii_lowercase().as_str() {
            "o" => [0.0, 0.0, 1.0],
            "i" => [0.0, 0.0, -1.0],
            _ => return self.read_compass_attribute(name),
        };
        let near = |compass: &CompassDirection, along: [f64; 3]| {
            let palm = orientation::palm_direction_vector(along, compass.compass_angle());
            palm.iter().zip(faces).map(|(a, b)| a * b).sum::<f64>()
        };
        let along = pointing.map(SpatialDirection::spatial_direction_vector);
        let nearest = along.and_then(|along| {
            let all = CompassDirection::ALL_COMPASS_DIRECTIONS
                .into_iter()
                .map(|compass| (compass, near(&compass, along)));
            let best = all.max_by(|a, b| a.1.total_cmp(&b.1));
            best.filter(|(_, share)| *share > 0.3)
        });
        let Some((compass, _)) = nearest else {
            return self.read_compass_attribute(name);
        };
        self.findings.add_limited_finding("palms that face out or in", || {
            let (line, text) = (self.element.line.0, shorten_sigml_text(text));
            let message = format!(
                "{name}={text:?} is none of the eight directions; on a hand that points so it was read as \"{compass}\""
            );
            ImportFinding::new_note_finding(line, message).with_remedy(format!("write {name}=\"{compass}\""))
        });
        Some(compass)
    }

    /// Reports fingers that change one after the other, which the tree of a sign does not hold.
    pub(super) fn report_successive_fingers(&mut self, name: &str) {
        let Some(text) = self.attribute_text(name) else {
            return;
        };
        self.findings
            .add_limited_finding("fingers that change one after the other", || {
                let (line, text) = (self.element.line.0, shorten_sigml_text(text));
                let message = format!("{name}={text:?}: the fingers change all at once");
                ImportFinding::new_note_finding(line, message)
                    .with_remedy("write one <changeposture> for each finger, if their order matters")
            });
    }

    /// Returns a bend: a word, or three numbers from 0 to 4.
    pub(super) fn read_bend_attribute(&mut self, name: &str) -> Option<FingerBend> {
        const BEND_ATTRIBUTE_FORM: &str =
            "bent, round, hooked, dblbent, dblhooked, halfbent or three digits from 0 to 4";
        let text = self.attribute_text(name)?;
        let bend = self.parse_attribute(name, BEND_ATTRIBUTE_FORM, |text| bend_of(text).map(|(bend, _)| bend))?;
        if let Some((_, BendSpelling::Odd)) = bend_of(text.trim()) {
            self.findings.add_limited_finding("bends as decimals", || {
                let (line, text) = (self.element.line.0, shorten_sigml_text(text));
                let read = bend_text(bend);
                let message =
                    format!("{name}={text:?} was read as the bends {read} of three joints, 4 being as far as goes");
                ImportFinding::new_note_finding(line, message).with_remedy(format!("write {BEND_ATTRIBUTE_FORM}"))
            });
        } else if matches!(bend, FingerBend::Joints(_)) {
            self.add_element_note("bends as numbers", |tag| {
                format!(
                    "<{tag} {name}={:?}>: the bend is given joint by joint",
                    shorten_sigml_text(text)
                )
            });
        }
        Some(bend)
    }

    /// Returns digits, each once.
    pub(super) fn read_digits_attribute(&mut self, name: &str) -> DigitList {
        let Some(text) = self.attribute_text(name) else {
            return DigitList::default();
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
            self.add_element_warning("digits spelled oddly", |tag| {
                let text = shorten_sigml_text(text);
                format!("<{tag} {name}={text:?}> was read as {read:?}; write digits from 1 (thumb) to 5, each once")
            });
        }
        DigitList(digits)
    }

    /// Returns two different digits.
    pub(super) fn read_digit_pair(&mut self, name: &str) -> Option<(HandDigit, HandDigit)> {
        self.parse_attribute(name, "two digits from 1 (thumb) to 5", |text| {
            let mut letters = text.chars();
            let pair = (digit_of(letters.next()?)?, digit_of(letters.next()?)?);
            letters.next().is_none().then_some(pair)
        })
    }

    /// Returns one digit.
    pub(super) fn read_digit_attribute(&mut self, name: &str) -> Option<HandDigit> {
        self.parse_attribute(name, "a digit from 1 (thumb) to 5", |text| {
            let mut letters = text.chars();
            let digit = digit_of(letters.next()?)?;
            letters.next().is_none().then_some(digit)
        })
    }

    /// Reports every attribute that was not read.
    pub(super) fn report_unread_attributes(self) {
        let element = self.element;
        for (at, (name, value)) in element.attributes.iter().enumerate() {
            if self.taken & (1 << at) == 0 {
                self.findings.add_limited_finding("attributes that are not known", || {
                    let (tag, name, value) = (
                        shorten_sigml_text(&element.name),
                        shorten_sigml_text(name),
                        shorten_sigml_text(value),
                    );
                    let message = format!("<{tag}> has no attribute {name}={value:?}; it was left out");
                    ImportFinding::new_warning_finding(element.line.0, message)
                });
            }
        }
    }
}

/// Returns the value of a word in another case, or of the name of HamNoSys's symbol.
fn parse_loose_word<T: SigmlWord>(text: &str) -> Option<T> {
    let lower = text.to_ascii_lowercase();
    let bare_word = lower.strip_prefix("ham").unwrap_or(&lower);
    let plain = bare_word.strip_suffix("mod").unwrap_or(bare_word);
    T::from_sigml_word(plain).or_else(|| T::from_sigml_word(plain.strip_suffix("hand")?))
}

fn digit_of(letter: char) -> Option<HandDigit> {
    let number = letter.to_digit(10)?.checked_sub(1)?;
    HandDigit::ALL_HAND_DIGITS.get(number as usize).copied()
}

/// Returns digits as SiGML writes them.
pub(super) fn digits_text(digits: &[HandDigit]) -> String {
    digits.iter().map(|digit| digit.digit_number().to_string()).collect()
}

const BEND_WORDS: [(&str, FingerBend); 6] = [
    ("bent", FingerBend::Bent),
    ("round", FingerBend::Round),
    ("hooked", FingerBend::Hooked),
    ("dblbent", FingerBend::DoubleBent),
    ("dblhooked", FingerBend::DoubleHooked),
    ("halfbent", FingerBend::HalfBent),
];

/// The spellings of the numbers of a bend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum BendSpelling {
    /// In words or digits, or with blanks between them.
    Usual,
    /// As decimals without separators.
    Odd,
}

fn bend_of(text: &str) -> Option<(FingerBend, BendSpelling)> {
    if let Some((_, bend)) = BEND_WORDS.iter().find(|(word, _)| *word == text) {
        return Some((*bend, BendSpelling::Usual));
    }
    let (parts, spelling): (Vec<String>, _) = if text.contains(' ') {
        let parts = text.split_ascii_whitespace().map(str::to_owned).collect();
        (parts, BendSpelling::Usual)
    } else {
        (
            split_joined_numbers(text)?,
            if text.contains('.') {
                BendSpelling::Odd
            } else {
                BendSpelling::Usual
            },
        )
    };
    let joint_numbers: Vec<f64> = parts.iter().map(|part| part.parse().ok()).collect::<Option<_>>()?;
    let joints: [f64; 3] = joint_numbers.try_into().ok()?;
    let fits = joints.iter().all(|joint| (0.0..=4.0).contains(joint));
    fits.then_some((FingerBend::Joints(joints), spelling))
}

/// Splits numbers without separators: each is a digit, or a digit, a point and one decimal.
fn split_joined_numbers(text: &str) -> Option<Vec<String>> {
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
pub(super) fn bend_text(bend: FingerBend) -> String {
    if let Some((word, _)) = BEND_WORDS.iter().find(|(_, known)| *known == bend) {
        return (*word).to_owned();
    }
    let FingerBend::Joints(joints) = bend else {
        return String::new();
    };
    let are_whole = joints.iter().all(|joint| joint.fract() == 0.0);
    let parts = joints.map(|joint| (joint + 0.0).to_string());
    parts.join(if are_whole { "" } else { " " })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bends_are_read_from_words_digits_and_decimals() {
        let joints = |a, b, c| Some(FingerBend::Joints([a, b, c]));
        for (text, expected) in [
            ("bent", Some(FingerBend::Bent)),
            ("dblhooked", Some(FingerBend::DoubleHooked)),
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
