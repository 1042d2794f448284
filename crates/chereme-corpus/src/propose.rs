//! Codings that are proposed from movement, for components that nobody has coded yet.

use std::collections::{BTreeMap, BTreeSet};

use chereme_analysis::transcribe::FeatureKind;
use chereme_formats::roles::AnnotatedHands;
use chereme_formats::table::annotations::TableMoment;
use chereme_motion::{BodySide, RecordingInstant, TimeSpan};
use chereme_sign::hamnosys::NotatedSign;
use chereme_sign::hamnosys::components::SignMapper;
use chereme_sign::{ComponentField, HandRef, SignComponent, SignPhase, TierRole};
use serde::Serialize;

use crate::Corpus;
use crate::address::{CorpusAddress, RowName};
use crate::annotate::{
    AnnotateOptions, AnnotateReport, AnnotationAction, AnnotationChange, AnnotationName, NewTier, TierRequestName,
};
use crate::db::stored_columns::AnnotationOrigin;
use crate::db::{stored_recordings, stored_tiers};
use crate::error::{CorpusError, CorpusResult};
use crate::progress::{ProgressReceiver, ProgressStep, ProgressUnit};
use crate::search::{SearchHit, SearchOptions};
use crate::transcribe::TranscribedFeature;
use crate::words::effect::{AnnotationEffect, OperationEffect};

/// Options of proposals: the components, and the tokens.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProposeOptions {
    /// The components, of [`ProposalResult::READABLE_COMPONENTS`].
    pub components: Vec<SignComponent>,
    /// The tokens; a token that already has a value for a component keeps it.
    pub scope: ProposeScope,
}

/// The tokens that get proposals.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ProposeScope {
    /// All of the corpus.
    All,
    /// Those of a recording.
    Recording(RowName),
    /// Those of a recording that overlap a span.
    Span(RowName, TimeSpan),
    /// A single one.
    Token(i64),
}

/// The result of a proposal.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct ProposalResult {
    /// The number of tokens that got values.
    pub tokens: u64,
    /// The number of annotations written.
    pub annotations: u64,
    /// The number of tokens without the component that could not be read: they have no movement, or none that the
    /// transcription understands.
    pub unread: u64,
    /// The recordings, in order.
    pub recordings: Vec<String>,
    /// Notes on what is not proposed.
    pub findings: Vec<String>,
}

impl ProposalResult {
    /// The components that can be read from movement.
    pub const READABLE_COMPONENTS: [SignComponent; 4] = [
        SignComponent::Configuration,
        SignComponent::Placement,
        SignComponent::Movement,
        SignComponent::Orientation,
    ];
}

/// The suffix of the names of tiers with proposals.
const PROPOSAL_TIER_SUFFIX: &str = " (proposed)";

/// Returns the name of the tier that accepted values from a tier with proposals are moved to; `None` for other tiers.
#[must_use]
pub fn proposed_for(tier: &str) -> Option<&str> {
    tier.strip_suffix(PROPOSAL_TIER_SUFFIX)
}

/// Returns the tier on which proposals are accepted, of all tiers of their recording: that of the same subject and hand, by
/// preference the one with their name; `None` if it must be added.
pub fn accepting_tier<'a>(
    proposals: &stored_tiers::TierRow,
    all: impl Iterator<Item = &'a stored_tiers::TierRow> + Clone,
) -> Option<&'a stored_tiers::TierRow> {
    let name = proposed_for(&proposals.name);
    let mut same = all.filter(|tier| {
        let alike = (&tier.role, tier.hand) == (&proposals.role, proposals.hand);
        alike && proposed_for(&tier.name).is_none()
    });
    let named = same.clone().find(|tier| Some(tier.name.as_str()) == name);
    named.or_else(|| same.next())
}

/// Returns the name of the tier for proposals of a field, such as `configuration dominant (proposed)`.
pub(crate) fn proposal_tier(field: &ComponentField) -> String {
    let feature = field.feature.as_deref().map(|name| format!(".{name}"));
    let hand = field.hand.map(|side| format!(" {}", side.hand_ref_name()));
    let (feature, hand) = (feature.unwrap_or_default(), hand.unwrap_or_default());
    format!(
        "{}{feature}{hand}{PROPOSAL_TIER_SUFFIX}",
        field.component.component_name()
    )
}

/// A value of a token to be written.
struct ProposedValue {
    start: i64,
    end: i64,
    value: String,
    confidence: Option<f64>,
}

/// The subject of a tier with proposals: a component, a feature of it, and the hand.
type ProposalSubject = (SignComponent, Option<String>, HandRef);

/// The values for each tier, by recording and subject.
type ProposedTierValues = BTreeMap<(String, ProposalSubject), Vec<ProposedValue>>;

impl Corpus {
    /// Returns the scope that an address names: a recording, a token, or a bare name, which is a sign's citation form or,
    /// if no sign has it, a recording.
    ///
    /// # Errors
    /// Fails if the address names something else, or nothing in the corpus.
    pub fn propose_scope(&self, address: &CorpusAddress) -> CorpusResult<ProposeScope> {
        match address {
            CorpusAddress::Recording(name) => Ok(ProposeScope::Recording(name.clone())),
            CorpusAddress::Token(token) => Ok(ProposeScope::Token(*token)),
            CorpusAddress::Gloss(_) | CorpusAddress::Sign(_) => {
                let stretch = crate::address::find_addressed_stretch(self.store.read_connection(), address)?;
                Ok(match stretch.token {
                    Some(token) => ProposeScope::Token(token.id),
                    None => ProposeScope::Recording(RowName::Number(stretch.recording.id)),
                })
            }
            other => Err(
                CorpusError::from_wrong_message(format!("{other} is no recording and no token"))
                    .with_error_place(other.to_string())
                    .with_advice("name one, such as recording:3 or token:41"),
            ),
        }
    }

    /// Proposes one component for every token of the corpus without a value for it, see [`propose_components`](Self::propose_components).
    ///
    /// # Errors
    /// As [`propose_components`](Self::propose_components).
    pub fn propose_coding(
        &mut self,
        component: SignComponent,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<ProposalResult> {
        let options = ProposeOptions {
            components: vec![component],
            scope: ProposeScope::All,
        };
        self.propose_components(&options, progress)
    }

    /// Reads components of tokens from their movement if they have no value for them, and writes the values onto tiers
    /// of their own, named for example `configuration dominant (proposed)`.
    ///
    /// Each value is an annotation by a detector ([`AnnotationOrigin::Detector`]) with its confidence, so that a
    /// person's codings stay separate and another detector may replace it. All of it is one operation, which one undo
    /// reverts. The values are those of [`transcribe`](Self::transcribe_movement), expressed in the corpus's inventories.
    ///
    /// # Errors
    /// [`CorpusError::Stopped`] if `progress` asks to stop before anything is written. Fails if a component cannot be read
    /// from movement, nothing has the name in the scope, or the corpus cannot be written.
    pub fn propose_components(
        &mut self,
        options: &ProposeOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<ProposalResult> {
        let mut wanted: BTreeMap<i64, (SearchHit, BTreeSet<SignComponent>)> = BTreeMap::new();
        for &component in &options.components {
            for hit in self.tokens_without_component(component, &options.scope, progress)? {
                let entry = wanted.entry(hit.token);
                let (_, components) = entry.or_insert_with(|| (hit, BTreeSet::new()));
                components.insert(component);
            }
        }
        let mut report = ProposalResult::default();
        let mut values = ProposedTierValues::new();
        let mut unseen: BTreeSet<String> = BTreeSet::new();
        let mut still: BTreeSet<String> = BTreeSet::new();
        let total = Some(wanted.len() as u64);
        for (done, (hit, components)) in wanted.values().enumerate() {
            progress.report_step(ProgressStep {
                task: &hit.gloss,
                done: done as u64,
                total,
                unit: ProgressUnit::Items,
            })?;
            if let Some(recording) = self.still_take(hit)? {
                still.insert(recording);
                report.unread += 1;
                continue;
            }
            match self.read_token_components(components, hit, &mut unseen, progress) {
                Ok(Some(read)) => {
                    report.tokens += 1;
                    let recording = hit.recording.clone().unwrap_or_default();
                    for (subject, value) in read {
                        let key = (recording.clone(), subject);
                        values.entry(key).or_default().push(value);
                    }
                }
                Err(CorpusError::Stopped) => return Err(CorpusError::Stopped),
                Ok(None) | Err(_) => report.unread += 1,
            }
        }
        for (takes, why) in [
            (
                still,
                "nothing is proposed for takes in which no joint of the body turns",
            ),
            (
                unseen,
                "handshapes are not proposed where fingers rest throughout, as nobody captured them",
            ),
        ] {
            if !takes.is_empty() {
                let names: Vec<String> = takes.into_iter().collect();
                report.findings.push(format!("{why}: {}", names.join(", ")));
            }
        }
        let (new, changes) = self.proposal_changes(values)?;
        report.annotations = changes.len() as u64;
        if !changes.is_empty() {
            let options = AnnotateOptions {
                origin: AnnotationOrigin::Detector,
                ..AnnotateOptions::default()
            };
            report.recordings = self
                .annotate_with(OperationEffect::Propose, &new, &changes, &options, progress)?
                .recordings;
        }
        Ok(report)
    }

    /// Returns the tokens of a scope that have no value for a component.
    fn tokens_without_component(
        &mut self,
        component: SignComponent,
        scope: &ProposeScope,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<SearchHit>> {
        if !ProposalResult::READABLE_COMPONENTS.contains(&component) {
            let text = format!("{} is not read from movement yet", component.component_name());
            let readable = ProposalResult::READABLE_COMPONENTS
                .map(SignComponent::component_name)
                .join(", ");
            return Err(CorpusError::from_wrong_message(text).with_advice(format!("what can be proposed: {readable}")));
        }
        let name = match scope {
            ProposeScope::Recording(name) | ProposeScope::Span(name, _) => {
                Some(crate::address::find_recording_by_name(self.store.read_connection(), name)?.name)
            }
            ProposeScope::All | ProposeScope::Token(_) => None,
        };
        let options = SearchOptions {
            limit: None,
            facets: false,
            ..SearchOptions::default()
        };
        let query = format!("not {}=*", component.component_name());
        let answer = self.search_until(&query, &options, progress)?;
        let is_in = |hit: &SearchHit| match scope {
            ProposeScope::All => true,
            ProposeScope::Token(token) => hit.token == *token,
            ProposeScope::Recording(_) => hit.recording == name,
            ProposeScope::Span(_, span) => {
                let (Some(start), Some(end)) = (hit.start_us, hit.end_us) else {
                    return false;
                };
                let shares = start < span.span_end_instant().instant_micros()
                    && end > span.span_start_instant().instant_micros();
                hit.recording == name && shares
            }
        };
        Ok(answer.hits.into_iter().filter(is_in).collect())
    }

    /// Returns the recording of a token if no joint of its body turns.
    fn still_take(&self, hit: &SearchHit) -> CorpusResult<Option<String>> {
        let connection = self.store.read_connection();
        let Ok(stretch) = crate::address::find_addressed_stretch(connection, &CorpusAddress::Token(hit.token)) else {
            return Ok(None);
        };
        let recording = stretch.recording;
        if stored_recordings::body_track(connection, recording.id)?.is_none() {
            return Ok(None);
        }
        let take = crate::hands::usable_take(connection, &self.hands, &recording)?;
        Ok((!take.bends).then_some(recording.name))
    }

    /// Returns the values of components read from a token's movement, for each hand in order of time. A recording whose
    /// handshapes were not captured is added to `unseen`.
    fn read_token_components(
        &self,
        components: &BTreeSet<SignComponent>,
        hit: &SearchHit,
        unseen: &mut BTreeSet<String>,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Option<Vec<(ProposalSubject, ProposedValue)>>> {
        let Some((start, end)) = hit.start_us.zip(hit.end_us) else {
            return Ok(None);
        };
        let Some(recording) = &hit.recording else {
            return Ok(None);
        };
        let address = CorpusAddress::Token(hit.token);
        let written = self.transcribe_movement(&address, progress)?;
        let features = written.features;
        let inventories = self.inventories_now()?;
        let stretch = crate::address::find_addressed_stretch(self.store.read_connection(), &address)?;
        let dominant = self.dominant_side(&stretch)?;
        let left_handed = dominant == BodySide::Left;
        let mapper = SignMapper::new(inventories.iter().map(|stored| &stored.inventory)).of_left_handed(left_handed);
        let sign = NotatedSign {
            gloss: written.gloss,
            text: Some(written.hamnosys),
            sign: written.sign,
            ..NotatedSign::default()
        };
        let mut subjects: BTreeMap<ProposalSubject, Vec<(u32, String)>> = BTreeMap::new();
        for value in mapper.map_sign_components(&sign).values {
            let field = value.field;
            let is_covered = field.feature.is_none() || field.component == SignComponent::Orientation;
            if !components.contains(&field.component) || !is_covered {
                continue;
            }
            let hand = field.hand.unwrap_or(HandRef::Dominant);
            let side = match hand {
                HandRef::Right => BodySide::Right,
                HandRef::Left => BodySide::Left,
                HandRef::Dominant => dominant,
                HandRef::Weak => dominant.opposite_side(),
            };
            if field.component == SignComponent::Configuration && written.assumed.contains(&side) {
                unseen.insert(recording.clone());
                continue;
            }
            let order = match field.phase {
                None | Some(SignPhase::Initial) => 0,
                Some(SignPhase::Middle(place)) => 1 + u32::from(place),
                Some(SignPhase::Final) => u32::MAX,
            };
            let subject = (field.component, field.feature, hand);
            subjects.entry(subject).or_default().push((order, value.value));
        }
        let mut read = Vec::new();
        for (subject, mut values) in subjects {
            values.sort_by_key(|(order, _)| *order);
            values.dedup_by(|a, b| a.1 == b.1);
            let count = values.len() as i64;
            let part_time = |part: i64| start + (end - start) * part / count;
            for (nth, (_, value)) in (0..).zip(values) {
                let (start, end) = (part_time(nth), part_time(nth + 1));
                let confidence = proposal_confidence(&features, &subject, count > 1, (start, end));
                read.push((
                    subject.clone(),
                    ProposedValue {
                        start,
                        end,
                        value,
                        confidence,
                    },
                ));
            }
        }
        Ok(Some(read).filter(|read| !read.is_empty()))
    }

    /// Accepts proposals unchanged: each becomes an annotation by the author of the corpus, on the tier without
    /// `(proposed)` in its name, which is added if it is missing. All of it is one operation.
    ///
    /// # Errors
    /// Fails if one of them is not a proposal, overlaps an annotation of its tier, or the corpus cannot be written.
    pub fn accept_proposals(
        &mut self,
        annotations: &[i64],
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnnotateReport> {
        let connection = self.store.read_connection();
        let (mut new, mut changes): (Vec<NewTier>, Vec<AnnotationChange>) = Default::default();
        for &id in annotations {
            let row = stored_tiers::load_annotation_row(connection, id)?;
            let tier = stored_tiers::load_tier_row(connection, row.tier_id)?;
            let Some(name) = proposed_for(&tier.name) else {
                let text = format!("annotation:{id} on \"{}\" is no proposal", tier.name);
                return Err(CorpusError::from_wrong_message(text)
                    .with_advice("proposals lie on tiers whose names end in \"(proposed)\""));
            };
            let recording = RowName::Number(tier.recording_id);
            let all = stored_tiers::load_tier_rows(connection, tier.recording_id)?;
            let known_tier = accepting_tier(&tier, all.iter());
            let to = match known_tier {
                Some(known) => known.name.clone(),
                None if all.iter().any(|row| row.name == name) => format!("{name} (accepted)"),
                None => name.to_owned(),
            };
            if known_tier.is_none()
                && new
                    .iter()
                    .all(|new_tier| (&new_tier.recording, &new_tier.name) != (&recording, &to))
            {
                let mut added = NewTier::new(recording.clone(), to.clone(), tier.role.clone());
                added.hand = tier.hand;
                new.push(added);
            }
            let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
            changes.push(
                AnnotationAction::Add {
                    tier: TierRequestName::Of { recording, tier: to },
                    start: time(row.start_us),
                    end: time(row.end_us),
                    parent: None,
                    order: None,
                    value: row.value,
                    confidence: None,
                }
                .into(),
            );
            changes.push(
                AnnotationAction::Remove {
                    annotation: AnnotationName::Number(id),
                }
                .into(),
            );
        }
        let options = AnnotateOptions::default();
        let accepted = |annotations: AnnotationEffect| OperationEffect::Accept {
            count: annotations.count_removed(),
            annotations,
        };
        self.annotate_with(accepted, &new, &changes, &options, progress)
    }

    /// Returns the annotations to add, and the tiers for them that recordings lack.
    fn proposal_changes(&self, all: ProposedTierValues) -> CorpusResult<(Vec<NewTier>, Vec<AnnotationChange>)> {
        let (mut tiers, mut changes) = (Vec::new(), Vec::new());
        for ((recording, (component, feature, hand)), mut values) in all {
            let recording = RowName::Text(recording);
            let mut field = ComponentField::new(component).with_field_hand(hand);
            field.feature.clone_from(&feature);
            let name = proposal_tier(&field);
            let tier = TierRequestName::Of {
                recording: recording.clone(),
                tier: name.clone(),
            };
            let mut end = self.tier_end(&recording, &name)?;
            if end.is_none() {
                let role = TierRole::Component { component, feature };
                let mut new = NewTier::new(recording, name, role);
                new.hand = Some(AnnotatedHands::One(hand));
                tiers.push(new);
            }
            values.sort_by_key(|value| value.start);
            for value in values {
                // Signs of two hands may overlap; annotations of one tier may not.
                let start = value.start.max(end.unwrap_or(i64::MIN));
                if start >= value.end {
                    continue;
                }
                end = Some(value.end);
                let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
                changes.push(
                    AnnotationAction::Add {
                        tier: tier.clone(),
                        start: time(start),
                        end: time(value.end),
                        parent: None,
                        order: None,
                        value: value.value,
                        confidence: value.confidence,
                    }
                    .into(),
                );
            }
        }
        Ok((tiers, changes))
    }

    /// Returns the end of the last annotation on a recording's tier, 0 if it has none; nothing if there is no such
    /// tier.
    fn tier_end(&self, recording: &RowName, tier: &str) -> CorpusResult<Option<i64>> {
        let connection = self.store.read_connection();
        let recording = crate::address::find_recording_by_name(connection, recording)?;
        let all = stored_tiers::load_tier_rows(connection, recording.id)?;
        let Some(tier) = all.into_iter().find(|row| row.name == tier) else {
            return Ok(None);
        };
        let rows = stored_tiers::load_tier_annotation_rows(connection, tier.id)?;
        Ok(Some(rows.iter().map(|row| row.end_us).max().unwrap_or(0)))
    }
}

/// Returns the confidence of a value, from 0.5 to 1: the residual of the second best reading as a share of both. `None`
/// if no feature of notation belongs to the value.
fn proposal_confidence(
    features: &[TranscribedFeature],
    (component, feature, _): &ProposalSubject,
    timed: bool,
    (start, end): (i64, i64),
) -> Option<f64> {
    let kinds: &[FeatureKind] = match (component, feature.as_deref()) {
        (SignComponent::Configuration, _) => &[FeatureKind::Handshape],
        (SignComponent::Placement, _) => &[FeatureKind::Location, FeatureKind::Contact],
        (SignComponent::Movement, _) => &[FeatureKind::Movement, FeatureKind::Course],
        (SignComponent::Orientation, Some("fingers")) => &[FeatureKind::Direction],
        (SignComponent::Orientation, _) => &[FeatureKind::Palm],
        _ => &[],
    };
    let sure = |reading: &TranscribedFeature| {
        let (first, second) = (reading.value.residual, reading.runner_up.as_ref()?.residual);
        let share = second / (first + second);
        share.is_finite().then_some(share.clamp(0.5, 1.0))
    };
    let within = |reading: &&TranscribedFeature| !timed || (reading.at_us >= start && reading.at_us < end);
    let of_kind = features.iter().filter(|reading| kinds.contains(&reading.feature));
    let least = of_kind.filter(within).filter_map(sure).reduce(f64::min);
    least.map(|value| (value * 1000.0).round() / 1000.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ImportOptions, ignore_progress_step};

    #[test]
    fn a_scope_is_named_by_address_or_by_name_alone() {
        let own = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let files = ["bol.bvh", "bol.eaf", "phrase.bvh"].map(|name| own.join(name));
        let mut hear = ignore_progress_step;
        corpus
            .import_paths(&files, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
            .expect("taken in");
        let phrase = corpus.movement_at_address(&"phrase".parse().expect("an address"));
        let phrase = phrase.expect("movement").stretch.recording.id;
        let text = |name: &str| RowName::Text(name.to_owned());
        for (address, want) in [
            ("token:1", Some(ProposeScope::Token(1))),
            ("BOL", Some(ProposeScope::Token(1))),
            ("sign:BOL", Some(ProposeScope::Token(1))),
            ("phrase", Some(ProposeScope::Recording(RowName::Number(phrase)))),
            ("recording:phrase", Some(ProposeScope::Recording(text("phrase")))),
            ("nobody", None),
            ("tier:1", None),
        ] {
            let found = corpus.propose_scope(&address.parse().expect("an address"));
            assert_eq!(found.ok(), want, "{address}");
        }
    }
}
