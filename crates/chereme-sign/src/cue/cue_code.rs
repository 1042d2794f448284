//! Codes of cued speech as data: shapes, placements, alphabets of phones, and variants.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;

/// The code of one language: the handshapes and placements that stand for its sounds.
///
/// Sounds are written in SAMPA; [`PhoneAlphabet`] names the other alphabets that a code translates.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CueCode {
    /// The name in options and files, such as `french`.
    pub id: String,
    /// The language as a BCP 47 tag.
    pub language: String,
    /// The version, raised whenever a key changes.
    pub version: u32,
    /// The names of the code, by language of the reader.
    pub names: BTreeMap<String, String>,
    /// Where the code was published.
    pub source: String,
    /// The handshapes by their numbers.
    pub shapes: Vec<CueShape>,
    /// The hand at rest between utterances.
    pub rest: RestShape,
    /// The placements.
    pub placements: Vec<CuePlacement>,
    /// The shape of a vowel without a consonant.
    pub vowel_alone: u8,
    /// The placement of a consonant without a vowel.
    pub consonant_alone: String,
    /// The placements that a diphthong passes.
    pub glides: BTreeMap<String, Vec<String>>,
    /// The labels that mean silence.
    pub pauses: Vec<String>,
    /// For each alphabet its symbols with their SAMPA; one symbol may be several sounds.
    pub alphabets: BTreeMap<String, BTreeMap<String, String>>,
    /// Vowels that have another placement as the last sound before a pause; filled by variants.
    #[serde(default)]
    pub final_placements: BTreeMap<String, String>,
    /// Habits of some cuers that a caller may switch on.
    pub variants: Vec<CueVariant>,
    /// Pairs of vowels that speakers and dictionaries exchange.
    pub doubtful: Vec<[String; 2]>,
    /// The part of the code that was not compared with its source; a finding warns of it.
    #[serde(default)]
    pub unchecked: Option<String>,
    /// Usual durations in milliseconds, for text without a recording.
    pub durations_ms: BTreeMap<String, f64>,
}

/// A handshape of a code.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CueShape {
    /// The number that lessons and charts give it.
    pub number: u8,
    /// The consonants that it stands for.
    pub consonants: Vec<String>,
    /// The value of the inventory of configurations.
    pub configuration: String,
    /// The finger whose tip is at the placement: `index` or `middle`.
    pub points_with: String,
}

/// The handshape between utterances.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RestShape {
    /// Its number.
    pub number: u8,
    /// The value of the inventory of configurations.
    pub configuration: String,
}

/// A placement of a code.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CuePlacement {
    /// The name, such as `mouth`.
    pub id: String,
    /// The vowels that it stands for.
    pub vowels: Vec<String>,
    /// The value of the inventory of placements.
    pub placement: String,
}

/// A habit of some cuers that changes keys.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CueVariant {
    /// The name in options.
    pub id: String,
    /// A description of the change, by language of the reader.
    pub names: BTreeMap<String, String>,
    /// Vowels that have another placement.
    #[serde(default)]
    pub placements: BTreeMap<String, String>,
    /// Vowels that have another placement as the last sound before a pause.
    #[serde(default)]
    pub final_placements: BTreeMap<String, String>,
    /// Another shape for vowels without a consonant.
    pub vowel_alone: Option<u8>,
}

/// The alphabet in which the labels of phones are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PhoneAlphabet {
    /// SAMPA, with the spellings of SPPAS and MAUS.
    Sampa,
    /// The International Phonetic Alphabet.
    #[default]
    Ipa,
    /// The phone set of the Montreal Forced Aligner.
    Mfa,
}

impl PhoneAlphabet {
    /// Every alphabet.
    pub const ALL_ALPHABETS: [Self; 3] = [Self::Sampa, Self::Ipa, Self::Mfa];

    /// Returns the name in options and data.
    #[must_use]
    pub fn alphabet_name(self) -> &'static str {
        match self {
            Self::Sampa => "sampa",
            Self::Ipa => "ipa",
            Self::Mfa => "mfa",
        }
    }
}

/// A variant that the code does not have.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the code {code:?} has no variant {variant:?}; it has {known}")]
pub struct UnknownVariant {
    /// The code.
    pub code: String,
    /// The name that was asked for.
    pub variant: String,
    /// The names that exist, separated by commas.
    pub known: String,
}

static CUE_CODES: LazyLock<Vec<CueCode>> = LazyLock::new(|| {
    [
        chereme_data::schema_text("cues/french.json"),
        chereme_data::schema_text("cues/english-us.json"),
        chereme_data::schema_text("cues/english-gb.json"),
    ]
    .into_iter()
    .filter_map(|text| serde_json::from_str(text).ok())
    .collect()
});

/// Returns the codes that come with the program.
#[must_use]
pub fn all_cue_codes() -> &'static [CueCode] {
    &CUE_CODES
}

/// Returns the code of that name or language, such as `french`, `fr` or `en-US`.
#[must_use]
pub fn find_cue_code(name: &str) -> Option<&'static CueCode> {
    let same = |word: &str| word.eq_ignore_ascii_case(name);
    let language = |code: &&CueCode| same(&code.language) || code.language.split('-').next().is_some_and(same);
    let by_name = all_cue_codes().iter().find(|code| same(&code.id));
    by_name.or_else(|| all_cue_codes().iter().find(language))
}

impl CueCode {
    /// Returns the code with its variants of these names switched on.
    ///
    /// # Errors
    /// [`UnknownVariant`] if the code has no variant of one of the names.
    pub fn with_variants(&self, names: &[&str]) -> Result<Self, UnknownVariant> {
        let mut code = self.clone();
        for name in names {
            let variant_names = || {
                let ids: Vec<&str> = self.variants.iter().map(|variant| variant.id.as_str()).collect();
                ids.join(", ")
            };
            let variant = self
                .variants
                .iter()
                .find(|variant| variant.id == *name)
                .ok_or_else(|| UnknownVariant {
                    code: self.id.clone(),
                    variant: (*name).to_owned(),
                    known: variant_names(),
                })?;
            for (vowel, placement) in &variant.placements {
                // A vowel has one placement, so the variant takes it away from the usual one.
                for known in &mut code.placements {
                    known.vowels.retain(|other| other != vowel);
                    if known.id == *placement {
                        known.vowels.push(vowel.clone());
                    }
                }
            }
            code.vowel_alone = variant.vowel_alone.unwrap_or(code.vowel_alone);
            let last = variant.final_placements.clone();
            code.final_placements.extend(last);
        }
        Ok(code)
    }

    /// Returns the shape of a consonant in SAMPA.
    #[must_use]
    pub fn shape_of(&self, consonant: &str) -> Option<&CueShape> {
        let has = |shape: &&CueShape| shape.consonants.iter().any(|known| known == consonant);
        self.shapes.iter().find(has)
    }

    /// Returns the shape of that number.
    #[must_use]
    pub fn find_cue_shape(&self, number: u8) -> Option<&CueShape> {
        self.shapes.iter().find(|shape| shape.number == number)
    }

    /// Returns the placement of that name.
    #[must_use]
    pub fn find_cue_placement(&self, id: &str) -> Option<&CuePlacement> {
        self.placements.iter().find(|placement| placement.id == id)
    }

    /// Returns the placements that a vowel in SAMPA passes: one, or two for a diphthong.
    #[must_use]
    pub fn path_of(&self, vowel: &str) -> Option<Vec<String>> {
        if let Some(path) = self.glides.get(vowel) {
            return Some(path.clone());
        }
        let has = |place: &&CuePlacement| place.vowels.iter().any(|known| known == vowel);
        let place = self.placements.iter().find(has)?;
        Some(vec![place.id.clone()])
    }

    /// Returns whether a symbol in SAMPA is a consonant or a vowel of the code.
    #[must_use]
    pub fn knows_sound(&self, symbol: &str) -> bool {
        self.shape_of(symbol).is_some() || self.path_of(symbol).is_some()
    }

    /// Returns whether a label means silence.
    #[must_use]
    pub fn is_pause(&self, label: &str) -> bool {
        label.is_empty() || self.pauses.iter().any(|pause| pause == label)
    }

    /// Returns a label's sounds in SAMPA; `None` if the code does not know the label.
    #[must_use]
    pub fn sampa_symbols(&self, label: &str, alphabet: PhoneAlphabet) -> Option<Vec<String>> {
        let label = label.trim();
        if self.is_pause(label) {
            return Some(vec!["#".to_owned()]);
        }
        let bare: String = label
            .chars()
            .filter(|mark| !matches!(mark, 'ˈ' | 'ˌ' | '.' | '"' | '%'))
            .collect();
        self.translate_phone_label(&bare, alphabet).or_else(|| {
            let short: String = bare.chars().filter(|mark| *mark != 'ː').collect();
            self.translate_phone_label(&short, alphabet)
        })
    }

    fn translate_phone_label(&self, label: &str, alphabet: PhoneAlphabet) -> Option<Vec<String>> {
        let is_known_symbol = |symbol: &str| self.is_pause(symbol) || self.knows_sound(symbol);
        let is_own = alphabet == PhoneAlphabet::Sampa && is_known_symbol(label);
        if is_own {
            return Some(vec![label.to_owned()]);
        }
        let tables: &[&str] = match alphabet {
            PhoneAlphabet::Sampa => &["sampa"],
            PhoneAlphabet::Ipa => &["ipa"],
            PhoneAlphabet::Mfa => &["mfa", "ipa"],
        };
        let sound_names = tables.iter().find_map(|table| self.alphabets.get(*table)?.get(label))?;
        let sounds: Vec<String> = sound_names.split(' ').map(str::to_owned).collect();
        sounds.iter().all(|sound| is_known_symbol(sound)).then_some(sounds)
    }
}
