//! Full details of one token, sign, signer or recording, read at one moment.

use chereme_motion::anatomy::BodyMeasures;
use chereme_sign::SignComponent;
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::consent::{self, PersonConsent};
use crate::db::lexicons;
use crate::db::people::{self, PersonContents};
use crate::db::sign_relations::{self, SignRelation};
use crate::db::signs::{self, TokenRow};
use crate::db::stored_columns::{OpinionStanding, ValueState, phase_name};
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_search::begin_reading;
use crate::db::stored_search::search_answers::{self, AnnotationOpinion};
use crate::db::stored_tracks::{self, TrackRow};
use crate::db::{edits, notations, recipes};
use crate::error::CorpusResult;
use crate::hands;
use crate::inventories::ValueName;
use crate::media::MediaPlace;
use crate::movement::MotionTrack;
use crate::notation;

/// Full details of one object.
#[derive(Debug, Clone, PartialEq)]
pub enum ObjectDetails {
    /// Details of a token.
    Token(Box<TokenDetails>),
    /// Details of a sign.
    Sign(SignDetails),
    /// Details of a signer.
    Signer(SignerDetails),
    /// Details of a recording.
    Recording(RecordingDetails),
    /// Details of a value of an inventory.
    Value(ValueDetails),
}

/// Full details of a value of an inventory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ValueDetails {
    /// The row of the inventory.
    pub inventory: i64,
    /// The value's id.
    pub value: String,
    /// The number of tokens that have it.
    pub uses: u64,
    /// The values of other inventories that may be the same, with the reasons.
    pub proposals: Vec<(ValueName, Vec<&'static str>)>,
}

/// Full details of a token.
#[derive(Debug, Clone, PartialEq)]
pub struct TokenDetails {
    /// The token.
    pub row: TokenRow,
    /// Its values.
    pub values: Vec<TokenValue>,
    /// The values that do not count, apart from those that agree with one that does.
    pub opinions: Vec<ValueOpinion>,
    /// The other takes from which the range of the fingers was measured, if a detector proposes handshapes.
    pub range_takes: Vec<String>,
    /// Its HamNoSys, if it is notated.
    pub notation: Option<String>,
    /// The recipe of its recording, if that was generated.
    pub recipe: Option<String>,
    /// The addresses of its sources, if it was generated.
    pub made_from: Vec<String>,
    /// The recordings that were generated from it, by row and name.
    pub made_into: Vec<(i64, String)>,
}

/// A value of a token.
#[derive(Debug, Clone, PartialEq)]
pub struct TokenValue {
    /// The field, such as `initial.right.placement`.
    pub field: String,
    /// The component.
    pub component: SignComponent,
    /// Whether it has a value.
    pub state: ValueState,
    /// The value.
    pub value: Option<String>,
    /// The inventory that it comes from.
    pub inventory: Option<i64>,
    /// The annotation that gives the value.
    pub annotation: Option<i64>,
    /// The annotator whose annotation counts, or `adjudication`, then the annotators who say the same.
    pub by: Vec<String>,
    /// The confidence of the detector that found it.
    pub confidence: Option<f64>,
    /// The detector that found it, with its version, if a person accepted or corrected a proposal.
    pub detector: Option<String>,
    /// The value that the detector proposed, if a person corrected it.
    pub proposed: Option<String>,
}

/// A value of a token that does not count, such as a proposal.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ValueOpinion {
    /// The field, such as `right.configuration`.
    pub field: String,
    /// The value.
    pub value: String,
    /// Why it does not count.
    pub standing: OpinionStanding,
    /// The annotator, or `detector`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by: Option<String>,
    /// The confidence of the detector.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub confidence: Option<f64>,
    /// The detector that found it, with its version.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub detector: Option<String>,
}

impl ValueOpinion {
    /// Returns the opinion about a field that an annotation is.
    pub(crate) fn from_annotation(field: String, standing: OpinionStanding, said: AnnotationOpinion) -> Self {
        Self {
            field,
            value: said.state.missing_text().map_or(said.value, str::to_owned),
            standing,
            by: said.by,
            confidence: said.confidence,
            detector: said.detector,
        }
    }
}

/// Full details of a sign.
#[derive(Debug, Clone, PartialEq)]
pub struct SignDetails {
    /// The row.
    pub id: i64,
    /// The gloss; that of a further entry of one gloss has its number behind it: `BANK#2`.
    pub gloss: String,
    /// The lexicon to which it belongs, if it belongs to one.
    pub lexicon: Option<String>,
    /// Remarks.
    pub notes: Option<String>,
    /// Translations, as language and text.
    pub texts: Vec<(String, String)>,
    /// Its relations to other signs.
    pub relations: Vec<SignRelation>,
    /// Its tokens; [`TokenRow::citation`] marks the citation form.
    pub tokens: Vec<TokenRow>,
}

/// Full details of a signer.
#[derive(Debug, Clone, PartialEq)]
pub struct SignerDetails {
    /// Names, attributes and what the person does in the corpus.
    pub person: PersonContents,
    /// The consent of the person.
    pub consent: PersonConsent,
    /// The recordings.
    pub recordings: Vec<RecordingRow>,
    /// The body's measures in metres, from the first recording with a body that can be measured.
    pub measures: Option<BodyMeasures>,
}

/// Details of a recording beyond its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordingDetails {
    /// The row.
    pub id: i64,
    /// The consent for this recording alone.
    pub consent: PersonConsent,
    /// How many joints its skeleton has.
    pub joints: usize,
    /// The body part of each identified joint: part, joint.
    pub roles: Vec<(String, String)>,
    /// Body parts without a joint.
    pub missing: Vec<String>,
    /// The length of one unit of its file in metres.
    pub metres_per_unit: Option<f64>,
    /// The axes of its file.
    pub axes: Option<String>,
    /// The lexicon in which the glosses of its tiers are looked up, if it is linked to one.
    pub lexicon: Option<String>,
    /// The files that it came from: kind, name.
    pub files: Vec<(String, String)>,
    /// The other takes of the signer from which the range of the fingers is measured.
    pub range_takes: Vec<String>,
    /// Its tracks of every kind, oldest first.
    pub tracks: Vec<TrackRow>,
    /// The media files beside it.
    pub media: Vec<MediaPlace>,
    /// The engine that generated it, if it was generated.
    pub engine: Option<String>,
}

/// Returns the HamNoSys of a token, as written or converted from its SiGML; `None` if it is not notated.
fn token_hamnosys_text(connection: &Connection, token: i64) -> CorpusResult<Option<String>> {
    if notations::find_token_notation(connection, token)?.is_none() {
        return Ok(None);
    }
    // The check of the corpus reports an unreadable notation; the other details can be shown without it.
    let Ok(notation) = notation::find_address_notation(connection, &CorpusAddress::Token(token)) else {
        return Ok(None);
    };
    let text = match notation.text {
        Some(text) => text,
        None => notation.document.hamnosys_text().text,
    };
    // A notation without an equivalent in HamNoSys gives an empty text.
    Ok(Some(text).filter(|text| !text.is_empty()))
}

/// Returns the field of a value, such as `initial.right.placement`.
fn value_field_name(row: &signs::TokenValueRow) -> String {
    let hand = row.hand.map(|hand| format!("{hand}."));
    let phase = row.phase.map(|phase| format!("{}.", phase_name(phase)));
    let feature = row.feature.as_deref().map(|feature| format!(".{feature}"));
    let [hand, phase, feature] = [hand, phase, feature].map(Option::unwrap_or_default);
    format!("{phase}{hand}{}{feature}", row.component)
}

impl Corpus {
    /// Returns full details of a token.
    ///
    /// # Errors
    /// Fails if the address names no token, or the database fails.
    pub fn token_details(&self, address: &CorpusAddress) -> CorpusResult<TokenDetails> {
        let reading = begin_reading(self.store.read_connection())?;
        let row = address::find_addressed_token(&reading, address)?;
        let value = |value_row: signs::TokenValueRow| TokenValue {
            field: value_field_name(&value_row),
            component: value_row.component,
            state: value_row.state,
            value: value_row.value,
            inventory: value_row.inventory_id,
            annotation: value_row.annotation_id,
            by: Vec::new(),
            confidence: None,
            detector: None,
            proposed: None,
        };
        let mut opinions = Vec::new();
        for value_row in signs::load_token_opinions(&reading, row.id)? {
            let annotation = value_row.annotation_id.unwrap_or_default();
            let opinion = search_answers::opinion_of_annotation(&reading, annotation)?;
            opinions.extend(opinion.map(|opinion| {
                let standing = value_row.standing.unwrap_or(opinion.usual_standing);
                ValueOpinion::from_annotation(value_field_name(&value_row), standing, opinion)
            }));
        }
        let mut values = Vec::new();
        for value_row in signs::load_token_values(&reading, row.id)? {
            let source = match value_row.annotation_id {
                Some(annotation) => search_answers::opinion_of_annotation(&reading, annotation)?,
                None => None,
            };
            let mut value = value(value_row);
            // Those who agree are named with the one whose annotation counts.
            let is_agreeing =
                |opinion: &&ValueOpinion| (opinion.standing, &opinion.field) == (OpinionStanding::Agreed, &value.field);
            let agreeing = opinions
                .iter()
                .filter(is_agreeing)
                .filter_map(|opinion| opinion.by.clone());
            let own = source.as_ref().and_then(|source| source.by.clone());
            value.by = own.into_iter().chain(agreeing).collect();
            if let Some(source) = source {
                (value.detector, value.proposed) = (source.detector, source.proposed);
                value.confidence = source.confidence;
            }
            values.push(value);
        }
        opinions.retain(|opinion| opinion.standing != OpinionStanding::Agreed);
        let recipe = match row.recording_id {
            Some(recording) => recipes::find_recording_recipe(&reading, recording)?,
            None => None,
        };
        let made_from = match &recipe {
            Some(recipe) => recipes::list_recipe_inputs(&reading, recipe.id)?,
            None => Vec::new(),
        };
        let is_measured = |opinion: &ValueOpinion| {
            opinion.standing == OpinionStanding::Proposed && opinion.field.ends_with("configuration")
        };
        let range_takes = match row.recording_id.filter(|_| opinions.iter().any(is_measured)) {
            Some(id) => hands::hand_range_takes(&reading, &self.hands, id)?,
            None => Vec::new(),
        };
        Ok(TokenDetails {
            range_takes,
            values,
            opinions,
            notation: token_hamnosys_text(&reading, row.id)?,
            recipe: recipe.map(|recipe| recipe.text),
            made_from,
            made_into: recipes::made_from(&reading, row.id)?,
            row,
        })
    }

    /// Returns full details of a sign.
    ///
    /// # Errors
    /// Fails if there is no such sign, or the database fails.
    pub fn sign_details(&self, sign: &RowName) -> CorpusResult<SignDetails> {
        let reading = begin_reading(self.store.read_connection())?;
        let id = address::find_sign_by_name(&reading, sign)?;
        let tokens = signs::tokens_of_sign(&reading, id)?;
        let (_, notes) = edits::sign_gloss_and_notes(&reading, id)?;
        Ok(SignDetails {
            id,
            gloss: signs::sign_label(&reading, id)?,
            lexicon: lexicons::lexicon_name_of_sign(&reading, id)?,
            notes,
            texts: signs::list_sign_translations(&reading, id)?,
            relations: sign_relations::load_sign_relations(&reading, Some(id))?,
            tokens,
        })
    }

    /// Returns full details of a signer.
    ///
    /// # Errors
    /// Fails if there is no such signer, or the database fails.
    pub fn signer_details(&self, signer: &RowName) -> CorpusResult<SignerDetails> {
        let reading = begin_reading(self.store.read_connection())?;
        let signer = address::find_signer_by_name(&reading, signer)?;
        let shown = edits::recordings_of_signer(&reading, signer.id)?;
        let all = stored_recordings::load_recording_rows(&reading)?;
        let signer_recordings: Vec<RecordingRow> = all.into_iter().filter(|row| shown.contains(&row.id)).collect();
        let measures = signer_recordings
            .iter()
            .filter_map(|row| MotionTrack::open_motion_track(&reading, row.id).ok())
            // Opening a track takes time, and a signer may have many recordings.
            .take(5)
            .find_map(|track| track.track_anatomy(&reading).ok()?.anatomy_measures());
        Ok(SignerDetails {
            person: people::load_person(&reading, signer.id)?,
            consent: consent::load_consent(&reading, &CorpusAddress::Signer(RowName::Number(signer.id)))?,
            recordings: signer_recordings,
            measures,
        })
    }

    /// Returns the details of a recording's movement and files.
    ///
    /// # Errors
    /// Fails if there is no such recording, or the database fails.
    pub fn recording_details(&self, recording: &RowName) -> CorpusResult<RecordingDetails> {
        let reading = begin_reading(self.store.read_connection())?;
        let id = address::find_recording_by_name(&reading, recording)?.id;
        let mut details = RecordingDetails {
            id,
            consent: consent::load_consent(&reading, &CorpusAddress::Recording(RowName::Number(id)))?,
            range_takes: hands::hand_range_takes(&reading, &self.hands, id)?,
            lexicon: lexicons::lexicon_name_of_recording(&reading, id)?,
            joints: 0,
            roles: Vec::new(),
            missing: Vec::new(),
            metres_per_unit: None,
            axes: None,
            files: stored_recordings::source_files(&reading, id)?
                .into_iter()
                .map(|file| (file.kind, file.name))
                .collect(),
            tracks: stored_tracks::load_track_rows(&reading, id)?,
            media: self.recording_media(&RowName::Number(id))?,
            engine: recipes::find_recording_recipe(&reading, id)?.map(|recipe| recipe.engine),
        };
        if stored_recordings::body_track(&reading, id)?.is_some() {
            let track = MotionTrack::open_motion_track(&reading, id)?;
            let anatomy = track.track_anatomy(&reading)?;
            let name = |joint: usize| track.hierarchy.joints[joint].name.clone();
            details.joints = track.hierarchy.joints.len();
            details.roles = anatomy
                .found_parts()
                .filter(|(_, joint, _)| *joint < track.hierarchy.joints.len())
                .map(|(part, joint, _)| (part.to_string(), name(joint)))
                .collect();
            details.missing = anatomy.missing_parts().iter().map(ToString::to_string).collect();
            details.metres_per_unit = Some(track.convention.metres_per_unit);
            details.axes = Some(track.convention.axes.to_string());
        }
        Ok(details)
    }

    /// Returns full details of this value of the inventory of that row.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn value_details(&self, inventory: i64, value: &str) -> CorpusResult<ValueDetails> {
        let stored = self.inventories_now()?;
        let of_row = stored.iter().find(|stored| stored.id == inventory);
        let key = of_row.map_or("", |stored| stored.inventory.id.as_str());
        let is_value = |name: &ValueName| name.inventory == key && name.value == value;
        let mut proposals = Vec::new();
        for proposal in self.propose_equal_values()? {
            if is_value(&proposal.value) {
                proposals.push((proposal.other, proposal.reasons));
            } else if is_value(&proposal.other) {
                proposals.push((proposal.value, proposal.reasons));
            }
        }
        Ok(ValueDetails {
            inventory,
            value: value.to_owned(),
            uses: signs::tokens_with(self.store.read_connection(), inventory, value)?,
            proposals,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ImportOptions, ProgressReceiver, ignore_progress_step, unpack_starter};

    #[test]
    fn a_generated_sign_lists_its_sources_and_a_source_its_generated_signs() {
        let folder = tempfile::tempdir().expect("a folder");
        let paths = unpack_starter(&folder.path().join("files")).expect("unpacked");
        let wanted = |path: &std::path::PathBuf| {
            path.file_stem()
                .is_some_and(|stem| stem == "escargot" || stem == "lexicon")
        };
        let paths: Vec<_> = paths.into_iter().filter(wanted).collect();
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let mut hear = ignore_progress_step;
        let mut progress = ProgressReceiver::new(&mut hear);
        corpus
            .import_paths(&paths, &ImportOptions::default(), &mut progress)
            .expect("imported");
        let made = corpus
            .recombine_recipe("ESCARGOT | configure right U", "LIMACE")
            .expect("made");
        let of = |text: &str| corpus.token_details(&text.parse().expect("an address"));
        let source = of("ESCARGOT").expect("details");
        assert!(!source.values.is_empty() && source.recipe.is_none());
        assert_eq!(
            source.made_into,
            [(made.recording.expect("stored"), "LIMACE".to_owned())]
        );
        let token = of(&format!("token:{}", made.token.expect("stored"))).expect("details");
        assert_eq!(token.recipe.as_deref(), Some("ESCARGOT | configure right U"));
        assert!(token.made_from.contains(&format!("token:{}", source.row.id)));
        let sign = corpus.sign_details(&RowName::Text("LIMACE".into())).expect("details");
        assert!(sign.tokens.iter().any(|it| Some(it.id) == made.token));
        let value = source
            .values
            .iter()
            .find(|it| it.component == SignComponent::Configuration && it.inventory.is_some())
            .expect("a handshape");
        let (inventory, id) = (value.inventory.expect("one"), value.value.clone());
        let uses = corpus
            .value_details(inventory, &id.expect("one"))
            .map(|details| details.uses);
        assert!(uses.expect("counted") > 0);
        let recording = RowName::Number(source.row.recording_id.expect("one"));
        let recording = corpus.recording_details(&recording).expect("details");
        assert!(recording.joints > 20 && recording.roles.len() > 20);
        assert!(recording.files.iter().any(|(kind, _)| kind == "bvh"));
        let signer = source.row.recording.map(|_| RowName::Number(1)).expect("one");
        let signer = corpus.signer_details(&signer).expect("details");
        assert!(signer.measures.is_some_and(|it| it.arm > 0.3 && it.arm < 0.9));
        assert!(corpus.sign_details(&RowName::Number(9999)).is_err());
    }
}
