//! Suggestions of new signs: partners that differ in one component, and values that no sign has.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{ComponentField, HandRef, SignComponent, SignPhase, SignerHandedness};
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, CorpusAddress};
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::stored_columns::{RecordOrigin, ValueState};
use crate::db::stored_recordings;
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::{self, StandingWords};
use crate::tokens::join_phase_values;

/// Suggestions from a sign.
#[derive(Debug, Clone, Serialize)]
pub struct SignSuggestions {
    /// The row of the token.
    pub token: i64,
    /// Its gloss.
    pub gloss: String,
    /// Its coding, by field.
    pub coding: BTreeMap<String, String>,
    /// Minimal pairs: signs coded for the same fields, and alike in all but one of them.
    pub partners: Vec<MinimalPairPartner>,
    /// Signs that agree in all but one of the fields that both are coded for, if one of the two is coded for further
    /// fields: whether they differ in these is unknown.
    pub possible: Vec<MinimalPairPartner>,
    /// Values that no sign of the corpus combines with the rest of this coding, by field.
    pub unused: BTreeMap<String, Vec<String>>,
}

/// A sign that differs from another in one component.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MinimalPairPartner {
    /// The row of its token.
    pub token: i64,
    /// Its gloss.
    pub gloss: String,
    /// Its origin.
    pub origin: RecordOrigin,
    /// The field in which they differ.
    pub field: String,
    /// The value of the first sign.
    pub from: String,
    /// The value of this sign.
    pub to: String,
    /// How many fields are equal.
    pub equal: usize,
    /// The number of fields that only one of the two is coded for.
    pub one_sided: usize,
    /// A recipe that would give its coding, if there is one that changes that field.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recipe: Option<String>,
}

/// The fewest equal fields that make a comparison meaningful.
const LEAST_EQUAL: usize = 2;

/// The values of a token by field, hands by their part in signing: `beak > 5` for successive values, `down + in` for
/// simultaneous ones.
pub(crate) type TokenCoding = BTreeMap<String, String>;

impl Corpus {
    /// Returns suggestions for new signs from a token: signs of the corpus whose codings differ in one component, with
    /// a recipe if there is one, and values that no sign combines with the rest.
    ///
    /// Only citation forms are compared, of the token's lexicon and of signs that belong to none; with `across` those of
    /// all lexicons. A field that only one of the two is coded for matches nothing: such a sign is
    /// a possible partner.
    ///
    /// # Errors
    /// Fails if nothing has that address, or if the token has no coding.
    pub fn suggest_new_signs(&self, address: &CorpusAddress, across: bool) -> CorpusResult<SignSuggestions> {
        let connection = self.store.read_connection();
        let token = address::find_addressed_token(connection, address)?;
        let own_words = CodingReader::in_own_words(self)?;
        let compared_words = CodingReader::in_standing_words(self)?;
        let token_coding = own_words.coding_of(&token)?;
        let compared_coding = compared_words.coding_of(&token)?;
        if token_coding.len() < LEAST_EQUAL {
            return Err(CorpusError::from_wrong_message(format!(
                "{} is coded for too few components to compare it with other signs: {}, and {LEAST_EQUAL} are needed",
                token.gloss,
                token_coding.len()
            ))
            .with_error_place(address.to_string())
            .with_command_advice(
                "code its handshape, placement and movement, or have them proposed with `chereme propose`",
            ));
        }
        let (mut partners, mut possible) = (Vec::new(), Vec::new());
        let mut used: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        let of_signs = signs::lexicons_of_signs(connection)?;
        let lexicon = of_signs.get(&token.sign_id);
        for other in signs::load_coded_citation_tokens(connection)? {
            let is_elsewhere = |other_lexicon| lexicon.is_some_and(|lexicon| lexicon != other_lexicon);
            // A sign is no partner of itself.
            if other.sign_id == token.sign_id || !across && of_signs.get(&other.sign_id).is_some_and(is_elsewhere) {
                continue;
            }
            let theirs = compared_words.citation_coding(&other)?;
            let (equal, different) = compare_codings(&compared_coding, &theirs);
            if equal < LEAST_EQUAL || different.len() != 1 {
                continue;
            }
            let field = different[0].clone();
            // A value that a partner has is in use with the rest of this coding.
            used.entry(field.clone()).or_default().insert(theirs[&field].clone());
            let mut their_words = own_words.citation_coding(&other)?;
            let (from, to) = (
                token_coding[&field].clone(),
                their_words.remove(&field).unwrap_or_default(),
            );
            let one_sided = token_coding.len() + theirs.len() - 2 * (equal + 1);
            let list = match one_sided {
                0 => &mut partners,
                _ => &mut possible,
            };
            list.push(MinimalPairPartner {
                one_sided,
                token: other.id,
                recipe: field_change_recipe(&token, &field, &to),
                gloss: other.gloss,
                origin: other.origin,
                field,
                from,
                to,
                equal,
            });
        }
        partners.sort_by(|a, b| (b.equal, &a.field, &a.gloss).cmp(&(a.equal, &b.field, &b.gloss)));
        let rank = |partner: &MinimalPairPartner| (partner.one_sided, usize::MAX - partner.equal);
        possible.sort_by(|a, b| (rank(a), &a.field, &a.gloss).cmp(&(rank(b), &b.field, &b.gloss)));
        let unused = self.unused_field_values(&token_coding, &used, &compared_words.standing_words)?;
        Ok(SignSuggestions {
            token: token.id,
            gloss: token.gloss,
            coding: token_coding,
            partners,
            possible,
            unused,
        })
    }

    fn token_handedness(&self, token: &TokenRow) -> CorpusResult<SignerHandedness> {
        let connection = self.store.read_connection();
        let Some(recording) = token.recording_id else {
            // Lexicons code the dominant hand as the right one.
            return Ok(SignerHandedness::Right);
        };
        let signer_id = stored_recordings::load_recording_row(connection, recording)?.signer_id;
        let signer = signer_id
            .map(|id| stored_recordings::find_signer_row(connection, id))
            .transpose()?
            .flatten();
        let left = signer.and_then(|signer| signer.handedness).as_deref() == Some("left");
        Ok(if left {
            SignerHandedness::Left
        } else {
            SignerHandedness::Right
        })
    }

    fn unused_field_values(
        &self,
        own: &TokenCoding,
        used: &BTreeMap<String, BTreeSet<String>>,
        standing_words: &StandingWords,
    ) -> CorpusResult<BTreeMap<String, Vec<String>>> {
        let all = inventories::load_all_inventories(self.store.read_connection())?;
        let mut unused = BTreeMap::new();
        for (name, component) in [
            ("dominant.configuration", SignComponent::Configuration),
            ("placement", SignComponent::Placement),
        ] {
            let Some(value) = own.get(name) else { continue };
            let inventory = all.iter().map(|stored| &stored.inventory).find(|inventory| {
                inventory.component == component
                    && inventory.feature.is_none()
                    && inventory.find_inventory_value(value).is_some()
            });
            let Some(inventory) = inventory else { continue };
            let part = (component, None);
            let is_taken = |id: &str| {
                let word = standing_words.standing_word(&part, id);
                word == standing_words.standing_word(&part, value)
                    || used.get(name).is_some_and(|taken| taken.contains(word))
            };
            let free = inventory
                .values
                .iter()
                .map(|value| &value.id)
                .filter(|id| !is_taken(id));
            unused.insert(name.to_owned(), free.cloned().collect());
        }
        Ok(unused)
    }
}

/// Returns the name of a field in the coding of a token.
pub(crate) fn coding_name(field: &ComponentField) -> String {
    let feature = field.feature.as_ref();
    let part = feature.map_or(String::new(), |part| format!(".{part}"));
    let hand = match field.hand {
        Some(HandRef::Weak | HandRef::Left) => "weak.",
        _ if field.component == SignComponent::Configuration => "dominant.",
        _ => "",
    };
    format!("{hand}{}{part}", field.component)
}

/// Reads the values of tokens by field, with the hands as the token's signer uses them.
pub(crate) struct CodingReader<'c> {
    corpus: &'c Corpus,
    standing_words: StandingWords,
    /// The citation forms of signs that have several.
    several_citations: BTreeMap<i64, Vec<TokenRow>>,
}

impl<'c> CodingReader<'c> {
    /// Reads values as they are coded.
    fn in_own_words(corpus: &'c Corpus) -> CorpusResult<Self> {
        Self::in_words(corpus, StandingWords::default())
    }

    /// Reads values in words that can be compared: of values that a person made one, that of the value that stands for them.
    pub(crate) fn in_standing_words(corpus: &'c Corpus) -> CorpusResult<Self> {
        let standing_words = StandingWords::load_standing_words(corpus.store.read_connection())?;
        Self::in_words(corpus, standing_words)
    }

    fn in_words(corpus: &'c Corpus, standing_words: StandingWords) -> CorpusResult<Self> {
        Ok(Self {
            corpus,
            standing_words,
            several_citations: signs::load_several_citations(corpus.store.read_connection())?,
        })
    }

    /// Returns the values of a citation form by field; fields that it is not coded for have those of the sign's other citation forms.
    pub(crate) fn citation_coding(&self, token: &TokenRow) -> CorpusResult<TokenCoding> {
        let mut coding = self.coding_of(token)?;
        for other in self.several_citations.get(&token.sign_id).into_iter().flatten() {
            if other.id != token.id {
                for (field, value) in self.coding_of(other)? {
                    coding.entry(field).or_insert(value);
                }
            }
        }
        Ok(coding)
    }

    /// Returns the values of a token by field.
    pub(crate) fn coding_of(&self, token: &TokenRow) -> CorpusResult<TokenCoding> {
        let values = signs::load_token_values(self.corpus.store.read_connection(), token.id)?;
        self.coding_from_values(token, &values)
    }

    /// Returns these values by field.
    pub(crate) fn coding_from_values(&self, token: &TokenRow, values: &[TokenValueRow]) -> CorpusResult<TokenCoding> {
        let handedness = self.corpus.token_handedness(token)?;
        Ok(coding_from_rows(values, handedness, &self.standing_words))
    }
}

fn coding_from_rows(rows: &[TokenValueRow], handedness: SignerHandedness, words: &StandingWords) -> TokenCoding {
    let mut values: BTreeMap<String, BTreeMap<Option<SignPhase>, Vec<&str>>> = BTreeMap::new();
    // An initial value that no final one follows is the only one.
    let ends_never = |row: &TokenValueRow| {
        let field = (row.hand, row.component, &row.feature, Some(SignPhase::Final));
        rows.iter().any(|row| {
            row.state == ValueState::NotApplicable && (row.hand, row.component, &row.feature, row.phase) == field
        })
    };
    for row in rows {
        let Some(value) = row.value.as_deref().filter(|_| row.state == ValueState::Value) else {
            continue;
        };
        // Face and phases of movement do not make minimal pairs of hands.
        if row.component == SignComponent::NonManual || row.feature.as_deref() == Some("phase") {
            continue;
        }
        let part = (row.component, row.feature.clone());
        let word = words.standing_word(&part, value);
        let hand = row.hand.and_then(AnnotatedHands::single_hand);
        let weak = hand.is_some_and(|hand| hand.resolve_hand_ref(handedness) != handedness.signer_dominant_side());
        let both = row.hand == Some(AnnotatedHands::Both);
        let is_only = row.phase == Some(SignPhase::Initial) && ends_never(row);
        let phase = row.phase.filter(|_| !is_only);
        let feature = row
            .feature
            .as_ref()
            .map_or(String::new(), |feature| format!(".{feature}"));
        let manner = if row.component == SignComponent::Configuration {
            "dominant."
        } else {
            ""
        };
        let mut add = |prefix: &str| {
            let field = format!("{prefix}{}{feature}", row.component);
            let phases = values.entry(field).or_default();
            phases.entry(phase).or_default().push(word);
        };
        if weak {
            add("weak.");
        } else {
            add(manner);
        }
        if both {
            add("weak.");
        }
    }
    let written = |(field, mut phases): (String, BTreeMap<Option<SignPhase>, Vec<&str>>)| {
        // The order of simultaneous values means nothing, so equal sets must be written alike.
        phases.values_mut().for_each(|texts| texts.sort_unstable());
        // A value of the whole sign may stand beside successive ones.
        let unphased = phases.remove(&None).map(|texts| texts.join(" + "));
        let successive = (!phases.is_empty()).then(|| join_phase_values(&phases));
        let texts: Vec<String> = unphased.into_iter().chain(successive).collect();
        (field, texts.join(" + "))
    };
    values.into_iter().map(written).collect()
}

/// Returns the single values of a field of a coding.
pub(crate) fn single_values(text: &str) -> impl Iterator<Item = &str> {
    let parts = text.split('>').flat_map(|part| part.split(" + "));
    parts.map(str::trim).filter(|part| !part.is_empty())
}

/// Returns the number of equal fields, and the fields that differ, among those that both have.
fn compare_codings(a: &TokenCoding, b: &TokenCoding) -> (usize, Vec<String>) {
    let both = a
        .iter()
        .filter_map(|(field, value)| Some((field, value, b.get(field)?)));
    let (mut equal, mut different) = (0, Vec::new());
    for (field, mine, theirs) in both {
        if mine == theirs {
            equal += 1;
        } else {
            different.push(field.clone());
        }
    }
    (equal, different)
}

/// Returns a recipe that changes one field of a token with movement.
fn field_change_recipe(token: &TokenRow, field: &str, to: &str) -> Option<String> {
    // Without movement there is nothing that a recipe could change.
    token.recording_id?;
    // A recipe sets one value, and not a sequence.
    if single_values(to).ne([to]) {
        return None;
    }
    let source = format!("token:{}", token.id);
    let value = if to.contains(' ') {
        format!("\"{to}\"")
    } else {
        to.to_owned()
    };
    match field {
        "dominant.configuration" => Some(format!("{source} | configure dominant {value}")),
        "weak.configuration" => Some(format!("{source} | configure weak {value}")),
        "placement" => Some(format!("{source} | place both at {value}")),
        _ => None,
    }
}
