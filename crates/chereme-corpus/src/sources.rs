//! Answers to the questions that recipes ask about the corpus, read from the rows.

use std::cell::RefCell;
use std::sync::Arc;

use chereme_compose::recipe::BUILT_IN_BODY;
use chereme_compose::{
    AlphabetLetter, BodyInput, BodyLanguageChanges, ComponentValue, CuePhases, DonorCoding, ExpressionSource,
    HeldValue, LearnedProfile, MovementMaterial, RecipeSources, SourceError, SpellingTimes, TokenExample,
};
use chereme_motion::{BodySide, TimeSpan};
use chereme_sign::ComponentInventory;
use chereme_sign::hamnosys::NotatedSign;
use chereme_sign::milestones::ExpressionFunction;
use chereme_sign::text::nearest_candidate;
use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{ComponentReading, SignComponent, SignerHandedness};
use rusqlite::Connection;
use sha2::{Digest, Sha256};

pub(crate) use sources_language::DEFAULT_LANGUAGE_NAME;

use crate::IndexedStore;
use crate::address::{self, CorpusAddress, RecordingStretch, RowName};
use crate::curves;
use crate::curves::face_stage;
use crate::db::signs;
use crate::db::stored_columns::{AnnotationOrigin, RecordOrigin};
use crate::db::stored_history;
use crate::db::stored_motion;
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_tiers;
use crate::error::{CorpusError, CorpusResult};
use crate::face;
use crate::inventories::StoredInventory;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::search::index::SearchIndex;
use crate::starter;
use learned::learned_language::MovementSamples;

pub(crate) mod floor;
mod learned;
pub(crate) mod sources_cue_phases;
mod sources_language;
pub(crate) mod sources_notation;

/// What recipes want by a name, in messages.
const WANTED_BODY: &str = "a body is written signer:NAME, recording:NAME or built-in";
const WANTED_MOVEMENT: &str = "the movement of a sign or a recording is wanted";
const WANTED_NOTATION: &str = "notation is wanted";
const WANTED_SKELETON: &str = "the movement of a skeleton is wanted";

/// The longest stretch that a recipe accepts as a source, in microseconds.
const MAX_SOURCE_STRETCH_US: i64 = 600_000_000;

/// The corpus from the point of view of recipes.
pub(crate) struct CorpusSources<'a> {
    pub(crate) connection: &'a Connection,
    pub(crate) index: &'a SearchIndex,
    pub(crate) inventories: &'a [StoredInventory],
    pub(crate) learned: &'a RefCell<LearnedCache>,
}

/// Cache of the numbers learned from a corpus, valid until something in it changes.
#[derive(Default)]
pub(crate) struct LearnedCache {
    /// The newest operation when the profile was learned, and the profile.
    profile: Option<(Option<i64>, Option<LearnedProfile>)>,
    /// The newest operation when body language was measured, and the samples.
    samples: Option<(Option<i64>, MovementSamples)>,
}

impl<'a> CorpusSources<'a> {
    /// Opens a corpus for recipes, with its search index brought up to date.
    pub(crate) fn open_corpus_sources(
        store: &'a mut IndexedStore,
        inventories: &'a [StoredInventory],
        learned: &'a RefCell<LearnedCache>,
    ) -> CorpusResult<Self> {
        let (connection, index) = store.searchable_connection()?;
        Ok(Self {
            connection,
            index,
            inventories,
            learned,
        })
    }

    fn parse_source_stretch(&self, text: &str) -> CorpusResult<RecordingStretch> {
        address::find_addressed_stretch(self.connection, &text.parse()?)
    }

    fn load_stretch_material(&self, stretch: &RecordingStretch) -> CorpusResult<MovementMaterial> {
        if stretch.span.span_micros() > MAX_SOURCE_STRETCH_US {
            let seconds = stretch.span.span_seconds();
            return Err(CorpusError::from_wrong_message(format!(
                "{:?} is {:.0} min long, and a recipe takes {} min at most; annotate the part on a gloss tier and name \
                 its token",
                stretch.recording.name,
                seconds / 60.0,
                MAX_SOURCE_STRETCH_US / 60_000_000
            ))
            .with_advice("annotate the part on a gloss tier and name its token"));
        }
        if stored_recordings::body_track(self.connection, stretch.recording.id)?.is_none()
            && let Some(mut material) = face_stage::load_face_material(self.connection, stretch)?
        {
            material.held = self.held_component_values(stretch, material.handedness)?;
            return Ok(material);
        }
        let track = MotionTrack::open_motion_track(self.connection, stretch.recording.id)?;
        let mut material = stretch_movement_material(self.connection, &track, stretch)?;
        material.held = self.held_component_values(stretch, material.handedness)?;
        material.curves = curves::of_track(self.connection, &track, track.frames_in(stretch.span))?;
        Ok(material)
    }

    /// Returns the values on the component tiers over a stretch that count, with times counted from its first frame.
    fn held_component_values(
        &self,
        stretch: &RecordingStretch,
        handedness: SignerHandedness,
    ) -> CorpusResult<Vec<HeldValue>> {
        let mut held_values = Vec::new();
        let (start, end) = stretch.span.span_bounds_micros();
        for tier in stored_tiers::load_tier_rows(self.connection, stretch.recording.id)? {
            let Some((component, feature)) = tier.role.role_component() else {
                continue;
            };
            let inventory = self
                .inventories
                .iter()
                .find(|stored| Some(stored.id) == tier.inventory_id);
            for row in stored_tiers::annotations_near(self.connection, tier.id, start, end)? {
                let row_span = row.annotation_row_span();
                let Some(span) = row_span.span_intersection(stretch.span) else {
                    continue;
                };
                let counts = row.origin != AnnotationOrigin::Detector && !signs::is_opinion(self.connection, row.id)?;
                if !row.is_filled() || !counts {
                    continue;
                }
                let known_value = inventory.and_then(|stored| stored.inventory.find_inventory_value(row.value.trim()));
                let value = known_value.map_or(row.value.trim(), |value| value.id.as_str());
                for hand in resolve_hand_sides(tier.hand, handedness) {
                    held_values.push(HeldValue {
                        hand,
                        component,
                        feature: feature.map(str::to_owned),
                        value: ComponentReading::from(value),
                        span: span.shifted_span(-start),
                    });
                }
            }
        }
        Ok(held_values)
    }

    /// Returns the error for a name that belongs to something else than a recipe wants; `None` if nothing has it.
    fn other_kind(&self, address: &str, wanted: &'static str) -> Option<SourceError> {
        let text = |name: &RowName| match name {
            // A name of digits alone would be read as a number.
            RowName::Text(text) if text.parse::<i64>().is_err() => text.clone(),
            RowName::Text(text) => format!("{text:?}"),
            RowName::Number(number) => number.to_string(),
        };
        let signer = |name: &RowName| {
            address::find_signer_by_name(self.connection, name).ok()?;
            Some(("a signer", format!("signer:{}", text(name))))
        };
        let recording = |name: &RowName| {
            address::find_recording_by_name(self.connection, name).ok()?;
            Some(("a recording", format!("recording:{}", text(name))))
        };
        let (kind, named) = match address.parse().ok()? {
            CorpusAddress::Signer(name) => signer(&name)?,
            CorpusAddress::Recording(name) => recording(&name)?,
            CorpusAddress::Gloss(name) => {
                let name = RowName::Text(name);
                signer(&name).or_else(|| recording(&name)).or_else(|| {
                    let sign = self.has_notated_name(address).then(|| address.to_owned());
                    sign.map(|sign| ("a sign", sign))
                })?
            }
            sign => ("a sign", self.has_notated_name(address).then(|| sign.to_string())?),
        };
        Some(SourceError::OtherKind {
            address: address.into(),
            kind,
            wanted,
            // Only the movement of a signer or a recording can give a body.
            right: Some(named.into()).filter(|_| wanted == WANTED_BODY && kind != "a sign"),
        })
    }

    /// Returns the error for the body of something that is neither a signer nor a recording with movement.
    fn no_signer(&self, address: Option<&str>) -> SourceError {
        if let Some(error) = address.and_then(|address| self.other_kind(address, WANTED_BODY)) {
            return error;
        }
        let signers = stored_recordings::load_signer_rows(self.connection).unwrap_or_default();
        let signer_addresses = signers
            .into_iter()
            .map(|signer| CorpusAddress::Signer(RowName::Text(signer.name)).to_string());
        let (address, known) = (address.unwrap_or_default(), signer_addresses.collect::<Vec<_>>());
        SourceError::Missing {
            address: address.to_owned(),
            nearest: nearest_candidate(address, known.iter().map(String::as_str)).map(str::to_owned),
        }
    }

    fn all_source_inventories(&self) -> impl Iterator<Item = &ComponentInventory> {
        self.inventories.iter().map(|stored| &stored.inventory)
    }

    fn token_example(
        &self,
        token: i64,
        hand: Option<BodySide>,
        span: Option<TimeSpan>,
    ) -> CorpusResult<Option<TokenExample>> {
        let token = signs::load_token_row(self.connection, token)?;
        let (Some(recording), Some(start)) = (token.recording_id, token.start_us) else {
            return Ok(None);
        };
        if stored_recordings::body_track(self.connection, recording)?.is_none() {
            return Ok(None);
        }
        let signer = stored_recordings::load_recording_row(self.connection, recording)?.signer;
        Ok(Some(TokenExample {
            address: format!("token:{}", token.id),
            signer: signer.map(|name| CorpusAddress::Signer(RowName::Text(name)).to_string()),
            hand,
            span: span.map(|span| span.shifted_span(-start)),
            coding: DonorCoding::default(),
        }))
    }
}

/// Returns the body of a recording in its first frame.
pub(crate) fn standing_body_material(
    connection: &Connection,
    recording: RecordingRow,
) -> CorpusResult<MovementMaterial> {
    let track = MotionTrack::open_motion_track(connection, recording.id)?;
    let stretch = RecordingStretch {
        span: track.rate.frame_range_span(0..1),
        recording,
        token: None,
    };
    stretch_movement_material(connection, &track, &stretch)
}

/// Returns the movement of a stretch, without its annotations.
fn stretch_movement_material(
    connection: &Connection,
    track: &MotionTrack,
    stretch: &RecordingStretch,
) -> CorpusResult<MovementMaterial> {
    let frames = track.frames_in(stretch.span);
    let clip = track.read_motion_clip(connection, frames.clone(), &ChannelGroup::ALL_CHANNEL_GROUPS)?;
    // Whatever the movement depends on is in its hash, and nothing else, so that equal movement has an equal
    // one.
    let name = format!(
        "{} {:?} {:?}",
        stored_motion::content_hash(connection, track.row.id)?,
        frames,
        track.row
    );
    let signer = match stretch.recording.signer_id {
        Some(id) => stored_recordings::find_signer_row(connection, id)?,
        None => None,
    };
    let left = signer
        .as_ref()
        .is_some_and(|row| row.handedness.as_deref() == Some("left"));
    let handedness = if left {
        SignerHandedness::Left
    } else {
        SignerHandedness::Right
    };
    let (address, gloss) = match &stretch.token {
        Some(token) => (format!("token:{}", token.id), token.gloss.clone()),
        None => (
            format!("recording:{}", stretch.recording.id),
            stretch.recording.name.clone(),
        ),
    };
    Ok(MovementMaterial {
        address,
        hash: stored_motion::to_hex_text(&Sha256::digest(name.as_bytes())),
        gloss,
        signer: signer.map(|row| CorpusAddress::Signer(RowName::Text(row.name)).to_string()),
        handedness,
        clip,
        anatomy: Arc::new(track.track_anatomy(connection)?),
        held: Vec::new(),
        curves: Vec::new(),
    })
}

impl RecipeSources for CorpusSources<'_> {
    fn find_material(&self, address: &str) -> std::result::Result<MovementMaterial, SourceError> {
        if address == starter::OWN_BODY {
            return starter::own_body().map_err(|error| unreadable(&error));
        }
        match self.parse_source_stretch(address) {
            Ok(stretch) => match self.load_stretch_material(&stretch) {
                Err(error) if error.is_lack() => Err(SourceError::OtherKind {
                    address: address.into(),
                    kind: "in a recording without a skeleton",
                    wanted: WANTED_SKELETON,
                    right: None,
                }),
                loaded => loaded.map_err(|error| unreadable(&error)),
            },
            Err(error) => self
                .animate_notated_sign(address)?
                .ok_or_else(|| missing_source_error(self, address, WANTED_MOVEMENT, &error)),
        }
    }

    fn performer(&self, address: &str) -> std::result::Result<Option<BodyInput>, SourceError> {
        if self.parse_source_stretch(address).is_ok() || self.notation_of(address).is_err() {
            return Ok(None);
        }
        let body = self.stage(None)?;
        Ok(Some(BodyInput {
            address: body.address,
            hash: body.hash,
        }))
    }

    fn find_named_notation(&self, name: &str) -> std::result::Result<Vec<NotatedSign>, SourceError> {
        self.find_notated_signs(name)
    }

    fn stage(&self, signer: Option<&str>) -> std::result::Result<MovementMaterial, SourceError> {
        let wanted = match signer.map(str::parse) {
            _ if signer.is_some_and(|name| [starter::OWN_BODY, BUILT_IN_BODY].contains(&name)) => {
                return starter::own_body().map_err(|error| unreadable(&error));
            }
            Some(Ok(CorpusAddress::Recording(name))) => {
                let recording = address::find_recording_by_name(self.connection, &name)
                    .map_err(|error| missing_source_error(self, signer.unwrap_or_default(), WANTED_BODY, &error))?;
                return standing_body_material(self.connection, recording)
                    .and_then(floor::ground_body)
                    .map_err(|error| unreadable(&error));
            }
            Some(Ok(CorpusAddress::Signer(name))) => {
                let row = address::find_signer_by_name(self.connection, &name);
                Some(row.map_err(|_| self.no_signer(signer))?.id)
            }
            Some(_) => {
                return Err(self.no_signer(signer));
            }
            None => None,
        };
        let find = || -> CorpusResult<Option<MovementMaterial>> {
            let mut recordings = stored_recordings::load_recording_rows(self.connection)?;
            // Generated movement has its body from elsewhere, and may be generated again on another.
            recordings.retain(|row| match wanted {
                Some(signer) => row.signer_id == Some(signer),
                None => row.origin != RecordOrigin::Made,
            });
            // Captured bodies are those of people; those of other programs come next.
            let rank = |origin: RecordOrigin| {
                [RecordOrigin::Captured, RecordOrigin::Generated, RecordOrigin::Made]
                    .iter()
                    .position(|candidate| *candidate == origin)
            };
            recordings.sort_by_key(|row| (rank(row.origin), row.id));
            // Bodies with fingers come before others, and those that stand before those that hang in the air.
            let mut spare: Option<((bool, bool), MovementMaterial)> = None;
            for recording in recordings {
                if stored_recordings::body_track(self.connection, recording.id)?.is_none() {
                    continue;
                }
                let material = standing_body_material(self.connection, recording)?;
                let has_fingers = BodySide::BOTH_SIDES
                    .iter()
                    .all(|&side| material.anatomy.has_fingers(side));
                let fit = (has_fingers, floor::hanging_height(&material).is_none());
                if fit == (true, true) {
                    return Ok(Some(material));
                }
                if spare.as_ref().is_none_or(|(best, _)| fit > *best) {
                    spare = Some((fit, material));
                }
            }
            match spare {
                None if wanted.is_none() => starter::own_body().map(Some),
                spare => spare.map(|(_, body)| floor::ground_body(body)).transpose(),
            }
        };
        find()
            .map_err(|error| unreadable(&error))?
            .ok_or_else(|| SourceError::OtherKind {
                address: signer.unwrap_or_default().into(),
                kind: "a signer without a recording that moves",
                wanted: WANTED_BODY,
                right: None,
            })
    }

    fn find_component_value(
        &self,
        component: SignComponent,
        text: &str,
    ) -> std::result::Result<ComponentValue, SourceError> {
        chereme_compose::value_in(self.all_source_inventories(), component, text)
    }

    fn list_component_values(&self, component: SignComponent) -> Vec<ComponentValue> {
        self.all_source_inventories()
            .filter(|inventory| inventory.component == component && inventory.feature.is_none())
            .flat_map(|inventory| {
                inventory
                    .values
                    .iter()
                    .map(move |value| ComponentValue::value_from_inventory(inventory, value))
            })
            .collect()
    }

    fn holding(&self, component: SignComponent, value: &str) -> std::result::Result<Vec<TokenExample>, SourceError> {
        let find = || -> CorpusResult<Vec<TokenExample>> {
            let mut examples = Vec::new();
            for found in signs::tokens_holding(self.connection, component.component_name(), value)? {
                let span = found.span_us.map(|(start, end)| TimeSpan::from_span_micros(start, end));
                let hand = found.hand.and_then(AnnotatedHands::single_hand);
                let handedness = if found.left_handed {
                    SignerHandedness::Left
                } else {
                    SignerHandedness::Right
                };
                let hand = hand.map(|hand| hand.resolve_hand_ref(handedness));
                let coding = DonorCoding {
                    by: found.by,
                    confidence: found.confidence,
                    angle: None,
                };
                let example = self.token_example(found.token, hand, span)?;
                examples.extend(example.map(|example| TokenExample { coding, ..example }));
            }
            Ok(examples)
        };
        find().map_err(|error| unreadable(&error))
    }

    fn find_best_examples(
        &self,
        query: &str,
        signer: Option<&str>,
    ) -> std::result::Result<Vec<TokenExample>, SourceError> {
        // Without a known signer, `same` means any signer, and not nobody.
        let same = signer.unwrap_or("signer:*");
        let query = query.replace("signer=same", same);
        let fault = |error: &CorpusError| SourceError::Query {
            query: query.clone(),
            message: error.to_string(),
        };
        let search_result = crate::search::find_query_tokens(self.connection, self.index, &query);
        let tokens = search_result.map_err(|error| fault(&error))?;
        let mut examples = Vec::new();
        for token in tokens {
            examples.extend(self.token_example(token, None, None).map_err(|error| fault(&error))?);
        }
        Ok(examples)
    }

    fn find_face_expression(
        &self,
        address: &str,
        function: Option<&str>,
    ) -> std::result::Result<ExpressionSource, SourceError> {
        let function = function.map(ExpressionFunction::from_function_name);
        let fault = |error: &CorpusError| SourceError::Expression {
            address: address.to_owned(),
            why: error.to_string(),
            remedy: error.error_remedy().map(Box::new),
        };
        let named: CorpusAddress = address.parse().map_err(|error| fault(&error))?;
        let expression_result = face::expression_at(self.connection, &named, function.as_ref());
        let expression = expression_result.map_err(|error| fault(&error))?;
        let recording = CorpusAddress::Recording(RowName::Number(expression.recording)).to_string();
        let stretch = self.parse_source_stretch(&recording).map_err(|error| fault(&error))?;
        let material = self.load_stretch_material(&stretch).map_err(|error| fault(&error))?;
        let start_result = face_stage::first_frame(self.connection, expression.recording, stretch.span);
        let start = start_result.map_err(|error| fault(&error))?;
        Ok(ExpressionSource {
            material,
            function: expression.function,
            milestones: expression.milestones.shift_milestones(-start),
        })
    }

    fn find_alphabet_letters(
        &self,
        alphabet: Option<&str>,
        word: &str,
    ) -> std::result::Result<Vec<AlphabetLetter>, SourceError> {
        chereme_compose::letters_in(self.all_source_inventories(), alphabet, word)
    }

    fn learned_profile(&self) -> std::result::Result<Option<LearnedProfile>, SourceError> {
        let newest = stored_history::find_newest_operation(self.connection).map_err(|error| unreadable(&error))?;
        let mut learned = self.learned.borrow_mut();
        if let Some((_, profile)) = learned.profile.as_ref().filter(|(at, _)| *at == newest) {
            return Ok(profile.clone());
        }
        let profile = learned::learn_transition_profile(self.connection).map_err(|error| unreadable(&error))?;
        learned.profile = Some((newest, profile.clone()));
        Ok(profile)
    }

    fn body_language(
        &self,
        named: Option<&str>,
        signer: Option<&str>,
    ) -> std::result::Result<BodyLanguageChanges, SourceError> {
        self.find_body_language(named, signer)
    }

    fn cue_phases(&self) -> std::result::Result<Option<CuePhases>, SourceError> {
        sources_cue_phases::measured_cue_phases(self.connection).map_err(|error| unreadable(&error))
    }

    fn spelling_times(&self) -> std::result::Result<SpellingTimes, SourceError> {
        learned::spelling_times(self.connection, self.inventories).map_err(|error| unreadable(&error))
    }
}

fn resolve_hand_sides(hand: Option<AnnotatedHands>, handedness: SignerHandedness) -> Vec<Option<BodySide>> {
    match hand {
        Some(AnnotatedHands::Both) => vec![Some(BodySide::Right), Some(BodySide::Left)],
        Some(AnnotatedHands::One(hand)) => vec![Some(hand.resolve_hand_ref(handedness))],
        None => vec![None],
    }
}

fn unreadable(error: &CorpusError) -> SourceError {
    SourceError::Unreadable(error.to_string())
}

/// Returns the error for an address without what is wanted, which depends on what the address names instead.
fn missing_source_error(
    sources: &CorpusSources<'_>,
    address: &str,
    wanted: &'static str,
    error: &CorpusError,
) -> SourceError {
    let address_text = address.to_owned();
    let parsed: Option<CorpusAddress> = address.parse().ok();
    let sign = match &parsed {
        Some(CorpusAddress::Gloss(gloss) | CorpusAddress::Sign(RowName::Text(gloss))) => {
            let namesakes = signs::find_signs_of_gloss(sources.connection, gloss).unwrap_or_default();
            if namesakes.len() > 1 {
                return SourceError::Ambiguous {
                    address: address_text,
                    candidates: address::lexicon_addresses(&namesakes, gloss).collect(),
                };
            }
            address::find_sign_by_gloss(sources.connection, gloss).ok()
        }
        _ => None,
    };
    let tokens = sign.and_then(|sign| signs::tokens_of_sign(sources.connection, sign).ok());
    match tokens {
        Some(tokens) if tokens.iter().all(|token| token.recording_id.is_none()) => {
            SourceError::NoMovement { address: address_text }
        }
        Some(tokens) => SourceError::Ambiguous {
            address: address_text,
            candidates: tokens.iter().map(|token| format!("token:{}", token.id)).collect(),
        },
        None if parsed.is_none() => unreadable(error),
        None if error.is_lack() => SourceError::NoMovement { address: address_text },
        None => {
            if let Some(other) = sources.other_kind(address, wanted) {
                return other;
            }
            let glosses = signs::list_all_glosses(sources.connection).unwrap_or_default();
            let recordings = stored_recordings::load_recording_rows(sources.connection).unwrap_or_default();
            let names = recordings.iter().map(|row| row.name.as_str());
            let near = nearest_candidate(address, glosses.iter().map(String::as_str).chain(names));
            SourceError::Missing {
                address: address_text,
                nearest: near.map(str::to_owned),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::consent::tests::corpus;

    #[test]
    fn a_name_of_something_else_is_refused_with_its_kind() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus(folder.path());
        for (recipe, kind, right) in [
            (
                "point right at left on bol",
                "\"bol\" is a recording, and a body is written",
                "write recording:bol instead",
            ),
            (
                "hamnosys \"hamfist\" on Ada",
                "\"Ada\" is a signer, and a body is written",
                "write signer:Ada instead",
            ),
            ("spell OR on token:1", "\"token:1\" is a sign, and a body", ""),
            ("Ada | reverse", "\"Ada\" is a signer, and the movement", ""),
            ("BOL then signer:Ada", "is a signer, and the movement of a sign", ""),
            ("sigml Ada", "\"Ada\" is a signer, and notation is wanted", ""),
            ("point right at left on nobody", "\"nobody\" is not in the corpus", ""),
            ("MOON | reverse", "\"MOON\" is not in the corpus", ""),
        ] {
            let error = corpus.preview_recipe(recipe).expect_err(recipe);
            assert!(error.to_string().contains(kind), "{recipe}: {error}");
            let remedy = error.error_remedy().map(|it| it.remedy_text().to_owned());
            let remedy = remedy.unwrap_or_default();
            assert!(remedy.contains(right), "{recipe}: {remedy}");
            let french = crate::words::localized_message(&error.to_string(), crate::words::InterfaceLanguage::French);
            let french = french.expect(recipe);
            assert!(!french.contains(" is "), "{recipe}: {french}");
        }
    }
}
