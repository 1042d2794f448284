//! Tokens of a recording, derived from its tiers after every change to them.

mod counted_reading;

use std::collections::BTreeMap;

use chereme_motion::TimeSpan;
use chereme_sign::text::fold_text;
use chereme_sign::tier::AnnotatedHands;
use chereme_sign::token::{ComponentSpan, owning_token_index};
use chereme_sign::{ComponentField, ComponentReading, HandRef, SignComponent, SignPhase, SignerHandedness};
use rusqlite::Connection;

use crate::Corpus;
use crate::db::lexicons;
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::stored_columns::OpinionStanding;
use crate::db::stored_merge;
use crate::db::stored_recordings::{self, RecordingRow, SignerRow};
use crate::db::stored_search::search_answers;
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::{self, StoredInventory};
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::words::effect::OperationEffect;
use counted_reading::AnnotatedGloss;

/// The key of the corpus's note that names the annotator whose readings count before those of others.
pub(crate) const PREFERRED_ANNOTATOR_NOTE: &str = "preferred-annotator";

impl Corpus {
    /// Names the annotator whose readings count before those of others where several have annotated the same, or nobody. An
    /// adjudication counts before this annotator.
    ///
    /// # Errors
    /// Fails if no tier has that annotator, or the corpus cannot be written.
    pub fn prefer_annotator(&mut self, name: Option<&str>) -> CorpusResult<()> {
        let name = name.unwrap_or_default();
        self.store.run_store_operation(|connection| {
            let names = search_answers::annotator_names(connection)?;
            let folded = fold_text(name.trim());
            let known = names.iter().find(|known| fold_text(known) == folded);
            let name = known.map_or(name, String::as_str);
            if !name.is_empty() && known.is_none() {
                let there_are = match names.as_slice() {
                    [] => "no tier of this corpus names an annotator".to_owned(),
                    names => format!("there are: {}", names.join(", ")),
                };
                return Err(
                    CorpusError::from_wrong_message(format!("no annotator is called {name:?}"))
                        .with_error_place(name)
                        .with_advice(there_are),
                );
            }
            stored_merge::set_note(connection, PREFERRED_ANNOTATOR_NOTE, name)?;
            let inventories = inventories::load_all_inventories(connection)?;
            // The preferred annotator decides which readings count in every recording.
            for recording in stored_recordings::load_recording_rows(connection)? {
                update_recording_tokens(connection, recording.id, None, &inventories)?;
            }
            let annotator = if name.is_empty() { "-" } else { name }.to_owned();
            Ok(((), OperationEffect::PreferAnnotator { annotator }))
        })
    }
}

/// Updates the tokens of a recording from its tiers; tokens that remain keep their rows.
///
/// Each annotation with a value on a gloss tier is a token, unless it is a proposal. Its values are those of the component tiers during it, as far as
/// they [count](counted_reading), except the phases of movement: preparation, stroke and retraction divide time. With `window` only the tokens near
/// that time are derived, which suffices after a change within it. Values are converted to the ids of the tiers'
/// inventories.
pub(crate) fn update_recording_tokens(
    connection: &Connection,
    recording: i64,
    window: Option<TimeSpan>,
    inventories: &[StoredInventory],
) -> CorpusResult<()> {
    let progress = &mut ProgressReceiver::silent_progress();
    derive_with_progress(connection, recording, window, inventories, progress)
}

/// Derives tokens as [`update_recording_tokens()`] does, and can be stopped.
pub(crate) fn derive_with_progress(
    connection: &Connection,
    recording: i64,
    window: Option<TimeSpan>,
    inventories: &[StoredInventory],
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let recording = stored_recordings::load_recording_row(connection, recording)?;
    let by_time = AnnotationsByTime::read_recording_annotations(connection, &recording, window, inventories, progress)?;
    let tokens = match by_time.within {
        Some(within) => {
            let (start, end) = within.span_bounds_micros();
            signs::tokens_near(connection, recording.id, start, end)?
        }
        None => signs::tokens_of_recording(connection, recording.id)?,
    };
    // Tokens that remain keep their rows, to which other rows refer.
    let mut standing: BTreeMap<i64, TokenRow> = tokens
        .into_iter()
        .filter_map(|token| Some((token.annotation_id?, token)))
        .collect();
    let lexicon = lexicons::lexicon_of_recording(connection, recording.id)?;
    let glosses = by_time.glosses.iter().filter(|gloss| by_time.is_gloss_within(gloss));
    for (done, gloss) in glosses.enumerate() {
        report_token_step(progress, done)?;
        let old = standing.remove(&gloss.row.id);
        let token = write_token(connection, &recording, lexicon, gloss, old)?;
        signs::set_values(connection, token, &by_time.gloss_token_values(gloss))?;
    }
    // Their annotations are gone, or no longer filled.
    for token in standing.into_values() {
        signs::delete_token(connection, token.id)?;
        signs::delete_empty_sign(connection, token.sign_id)?;
    }
    Ok(())
}

/// Reports every 256th step.
fn report_token_step(progress: &mut ProgressReceiver<'_>, done: usize) -> CorpusResult<()> {
    if done % 256 != 255 {
        return Ok(());
    }
    progress.report_amount(ProgressUnit::Items, "tokens", done as u64, None)
}

fn write_token(
    connection: &Connection,
    recording: &RecordingRow,
    lexicon: Option<i64>,
    gloss: &GlossAnnotation,
    old: Option<TokenRow>,
) -> CorpusResult<i64> {
    let sign_id = signs::sign_of_annotation(connection, lexicon, gloss.row.value.trim())?;
    let mut token = old.clone().unwrap_or_else(|| TokenRow {
        recording_id: Some(recording.id),
        annotation_id: Some(gloss.row.id),
        origin: recording.origin,
        ..TokenRow::default()
    });
    token.sign_id = sign_id;
    token.start_us = Some(gloss.row.start_us);
    token.end_us = Some(gloss.row.end_us);
    token.hand = gloss.hand;
    match old {
        Some(old) => {
            if old != token {
                signs::update_token(connection, &token)?;
            }
            // The former sign may have lost its last token.
            if old.sign_id != sign_id {
                signs::delete_empty_sign(connection, old.sign_id)?;
            }
            Ok(token.id)
        }
        None => {
            token.citation = !signs::is_cited(connection, sign_id)?;
            signs::insert_token(connection, &token)
        }
    }
}

struct GlossAnnotation {
    row: AnnotationRow,
    hand: Option<AnnotatedHands>,
    participant: Option<String>,
}

/// The annotations on the tiers of a recording, by time.
struct AnnotationsByTime {
    handedness: SignerHandedness,
    /// The handedness of participants of tiers who are signers.
    of_participants: BTreeMap<String, SignerHandedness>,
    glosses: Vec<GlossAnnotation>,
    components: Vec<CodedAnnotation>,
    /// The components of each gloss, by the row of its annotation.
    owned: BTreeMap<i64, Vec<usize>>,
    /// If given, only the glosses that touch this span are derived; the others only take part in the assignment of
    /// components.
    within: Option<TimeSpan>,
    /// The annotator whose readings count before those of others.
    preferred: Option<String>,
}

struct CodedAnnotation {
    span: ComponentSpan,
    annotation: i64,
    tier: i64,
    annotator: Option<String>,
    /// The standing of a detector's proposal that nobody has accepted.
    proposal: Option<OpinionStanding>,
    inventory: Option<i64>,
    participant: Option<String>,
}

impl AnnotationsByTime {
    fn read_recording_annotations(
        connection: &Connection,
        recording: &RecordingRow,
        window: Option<TimeSpan>,
        inventories: &[StoredInventory],
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Self> {
        let all = stored_tiers::load_tier_rows(connection, recording.id)?;
        let is_coding = |tier: &&TierRow| !tier.is_of_phases();
        let of_glosses = || stored_tiers::token_tiers(&all);
        let of_components = || {
            let coded = |tier: &&TierRow| tier.role.role_component().is_some();
            all.iter().filter(coded).filter(is_coding)
        };
        let mut by_time = Self {
            handedness: recording_handedness(connection, recording)?,
            of_participants: of_participants(connection, &all)?,
            glosses: Vec::new(),
            components: Vec::new(),
            owned: BTreeMap::new(),
            within: None,
            preferred: preferred_annotator(connection)?,
        };
        if let Some(window) = window {
            // A component near the change may belong to a gloss that only it reaches.
            let mut within = window;
            for tier in of_components() {
                for row in tier_annotations_within(connection, tier, Some(window))? {
                    within = hull_of_two_spans(within, row.annotation_row_span());
                }
            }
            by_time.within = Some(within);
        }
        by_time.glosses = glosses_touching_span(connection, of_glosses(), by_time.within)?;
        let Some(reach) = by_time
            .glosses
            .iter()
            .map(|gloss| gloss.row.annotation_row_span())
            .reduce(hull_of_two_spans)
        else {
            return Ok(by_time);
        };
        // Components compete for glosses, so glosses beside the window take part in the assignment.
        let mut context = reach;
        let undecided = stored_merge::undecided_adjudications(connection, recording.id)?;
        for tier in of_components() {
            let inventory = inventories.iter().find(|stored| Some(stored.id) == tier.inventory_id);
            let rows = tier_annotations_within(connection, tier, by_time.within.and(Some(reach)))?;
            for (done, row) in rows.into_iter().enumerate() {
                report_token_step(progress, done)?;
                // Until somebody decides, the annotators' own tiers say what is in dispute.
                if undecided.contains(&row.id) {
                    continue;
                }
                context = hull_of_two_spans(context, row.annotation_row_span());
                by_time.add_component(tier, &row, inventory);
            }
        }
        if by_time.within.is_some() {
            by_time.glosses = glosses_touching_span(connection, of_glosses(), Some(context))?;
        }
        by_time
            .components
            .sort_by_key(|coded| (coded.span.span.span_start_instant(), coded.annotation));
        by_time.assign_components(progress)?;
        Ok(by_time)
    }

    fn is_gloss_within(&self, gloss: &GlossAnnotation) -> bool {
        self.within
            .is_none_or(|within| are_spans_touching(gloss.row.annotation_row_span(), within))
    }

    fn add_component(&mut self, tier: &TierRow, row: &AnnotationRow, inventory: Option<&StoredInventory>) {
        let Some((component, feature)) = tier.role.role_component() else {
            return;
        };
        let reading = match row.annotation_reading() {
            ComponentReading::Value(value) => {
                let listed_value = inventory.and_then(|stored| stored.inventory.find_inventory_value(value.trim()));
                ComponentReading::from(listed_value.map_or(value.trim(), |value| value.id.as_str()))
            }
            missing => missing,
        };
        // An annotation without a value says nothing about a sign.
        if reading == ComponentReading::Unset {
            return;
        }
        let standing = match tier.name.ends_with(stored_tiers::REJECTED_TIER_SUFFIX) {
            true => OpinionStanding::Rejected,
            false => OpinionStanding::Proposed,
        };
        let hands: Vec<Option<HandRef>> = match tier.hand {
            // An annotation of both hands codes each of them.
            Some(AnnotatedHands::Both) => vec![Some(HandRef::Right), Some(HandRef::Left)],
            hand => vec![hand.and_then(AnnotatedHands::single_hand)],
        };
        for hand in hands {
            let field = ComponentField {
                hand,
                component,
                feature: feature.map(str::to_owned),
                phase: None,
            };
            self.components.push(CodedAnnotation {
                span: ComponentSpan {
                    // A tier of another participant follows that person's dominant hand.
                    field: resolve_field_hands(field, self.handedness_of(tier.participant.as_deref())),
                    span: row.annotation_row_span(),
                    reading: reading.clone(),
                },
                annotation: row.id,
                tier: tier.id,
                annotator: tier.annotator.clone(),
                proposal: tier.is_proposal(row).then_some(standing),
                inventory: tier.inventory_id,
                participant: tier.participant.clone(),
            });
        }
    }

    fn handedness_of(&self, participant: Option<&str>) -> SignerHandedness {
        let own_handedness = participant.and_then(|name| self.of_participants.get(name));
        own_handedness.copied().unwrap_or(self.handedness)
    }

    fn gloss_token_values(&self, gloss: &GlossAnnotation) -> Vec<TokenValueRow> {
        let hand = gloss.hand.and_then(AnnotatedHands::single_hand);
        let handedness = self.handedness_of(gloss.participant.as_deref());
        let hand = hand.map(|hand| HandRef::from(hand.resolve_hand_ref(handedness)));
        let owned = self.owned.get(&gloss.row.id).into_iter().flatten();
        let annotated = AnnotatedGloss {
            span: gloss.row.annotation_row_span(),
            hand,
            coded: owned.map(|place| &self.components[*place]).collect(),
            preferred: self.preferred.as_deref(),
        };
        annotated.counted_token_values()
    }

    /// Assigns each component to the gloss that it belongs to, among those for each hand of each participant;
    /// components of one participant never belong to a gloss of another.
    fn assign_components(&mut self, progress: &mut ProgressReceiver<'_>) -> CorpusResult<()> {
        type Whose<'g> = (Option<&'g str>, Option<&'static str>);
        let mut hands: BTreeMap<Whose<'_>, Vec<&GlossAnnotation>> = BTreeMap::new();
        for gloss in &self.glosses {
            let whose = (
                gloss.participant.as_deref(),
                gloss.hand.map(AnnotatedHands::annotated_hands_name),
            );
            hands.entry(whose).or_default().push(gloss);
        }
        let mut owned: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
        for ((participant, _), glosses) in &hands {
            let spans: Vec<TimeSpan> = glosses.iter().map(|gloss| gloss.row.annotation_row_span()).collect();
            let longest = spans.iter().map(|span| span.span_micros()).max().unwrap_or(0);
            for (at, coded) in self.components.iter().enumerate() {
                report_token_step(progress, at)?;
                let other = coded.participant.as_deref().zip(*participant);
                if other.is_some_and(|(one, other)| one != other) {
                    continue;
                }
                let own_span = coded.span.span;
                // A gloss that begins earlier than this must have ended before the component.
                let from = own_span.span_start_instant().shifted_instant(-longest);
                let first = spans.partition_point(|span| span.span_start_instant() < from);
                let last = spans.partition_point(|span| span.span_start_instant() < own_span.span_end_instant());
                let near = spans.get(first..last).unwrap_or_default();
                if let Some(place) = owning_token_index(own_span, near) {
                    let gloss = glosses[first + place].row.id;
                    owned.entry(gloss).or_default().push(at);
                }
            }
        }
        self.owned = owned;
        Ok(())
    }
}

/// Makes the preferred annotator have another name, if they have this one.
pub(crate) fn rename_preferred_annotator(connection: &Connection, old: &str, new: &str) -> CorpusResult<()> {
    match preferred_annotator(connection)?.as_deref() == Some(old) {
        true => stored_merge::set_note(connection, PREFERRED_ANNOTATOR_NOTE, new),
        false => Ok(()),
    }
}

/// Returns the annotator whose readings count before those of others, if the corpus names one.
pub(crate) fn preferred_annotator(connection: &Connection) -> CorpusResult<Option<String>> {
    let notes = stored_merge::list_corpus_notes(connection, PREFERRED_ANNOTATOR_NOTE)?;
    Ok(notes.into_iter().map(|(_, name)| name).find(|name| !name.is_empty()))
}

fn resolve_field_hands(field: ComponentField, handedness: SignerHandedness) -> ComponentField {
    if field.component == SignComponent::NonManual {
        field
    } else {
        field.resolve_field_hand(handedness)
    }
}

/// Returns the handedness of a recording's signer.
pub(crate) fn recording_handedness(
    connection: &Connection,
    recording: &RecordingRow,
) -> CorpusResult<SignerHandedness> {
    let signer = match recording.signer_id {
        Some(id) => stored_recordings::find_signer_row(connection, id)?,
        None => None,
    };
    Ok(signer_handedness(signer.as_ref()))
}

fn signer_handedness(signer: Option<&SignerRow>) -> SignerHandedness {
    match signer.and_then(|signer| signer.handedness.as_deref()) {
        Some("left") => SignerHandedness::Left,
        _ => SignerHandedness::Right,
    }
}

/// Returns the handedness of the participants of tiers who are signers of the corpus.
fn of_participants(connection: &Connection, tiers: &[TierRow]) -> CorpusResult<BTreeMap<String, SignerHandedness>> {
    let mut handedness_by_name = BTreeMap::new();
    for name in tiers.iter().filter_map(|tier| tier.participant.as_ref()) {
        if !handedness_by_name.contains_key(name)
            && let Some(signer) = stored_recordings::find_signer(connection, name)?
        {
            handedness_by_name.insert(name.clone(), signer_handedness(Some(&signer)));
        }
    }
    Ok(handedness_by_name)
}

fn tier_annotations_within(
    connection: &Connection,
    tier: &TierRow,
    window: Option<TimeSpan>,
) -> CorpusResult<Vec<AnnotationRow>> {
    match window {
        None => stored_tiers::load_tier_annotation_rows(connection, tier.id),
        Some(window) => {
            let (start, end) = window.span_bounds_micros();
            stored_tiers::annotations_near(connection, tier.id, start, end)
        }
    }
}

/// Returns the glosses that touch `within`, by time.
fn glosses_touching_span<'t>(
    connection: &Connection,
    tiers: impl Iterator<Item = &'t TierRow>,
    within: Option<TimeSpan>,
) -> CorpusResult<Vec<GlossAnnotation>> {
    let mut glosses = Vec::new();
    for tier in tiers {
        for row in tier_annotations_within(connection, tier, within)? {
            if row.is_filled() {
                let hand = tier.hand;
                let participant = tier.participant.clone();
                glosses.push(GlossAnnotation { row, hand, participant });
            }
        }
    }
    glosses.sort_by_key(|gloss| (gloss.row.start_us, gloss.row.id));
    Ok(glosses)
}

fn hull_of_two_spans(a: TimeSpan, b: TimeSpan) -> TimeSpan {
    a.enclosing_span(b)
}

fn are_spans_touching(a: TimeSpan, b: TimeSpan) -> bool {
    a.span_start_instant() <= b.span_end_instant() && b.span_start_instant() <= a.span_end_instant()
}

/// Returns simultaneous values separated by `+`, or successive ones by `>`, with an empty part for each phase without a
/// value.
pub(crate) fn join_phase_values(phases: &BTreeMap<Option<SignPhase>, Vec<&str>>) -> String {
    // A value of the whole sign needs no phases.
    if let Some(texts) = phases.get(&None) {
        return texts.join(" + ");
    }
    let middle = |phase: &Option<SignPhase>| match phase {
        Some(SignPhase::Middle(place)) => Some(*place),
        _ => None,
    };
    let last = phases.keys().filter_map(middle).max().unwrap_or(0);
    let middles = (1..=last).map(SignPhase::Middle);
    let order = std::iter::once(SignPhase::Initial)
        .chain(middles)
        .chain([SignPhase::Final]);
    let parts: Vec<String> = order
        .map(|place| {
            phases
                .get(&Some(place))
                .map(|texts| texts.join(" + "))
                .unwrap_or_default()
        })
        .collect();
    parts.join(" > ").trim().to_owned()
}
