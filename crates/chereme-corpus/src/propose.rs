//! Codings that are proposed from movement, for components that nobody has coded yet.

mod token_codes;

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{ComponentField, HandRef, SignComponent, TierRole};
use serde::Serialize;

use crate::Corpus;
use crate::address::{CorpusAddress, RowName};
use crate::annotate::{
    AnnotateOptions, AnnotateReport, AnnotationAction, AnnotationChange, AnnotationName, NewTier, TierRequestName,
    write_tiers,
};
use crate::contents::ProposalAcceptor;
use crate::db::signs;
use crate::db::stored_columns::AnnotationOrigin;
use crate::db::stored_recordings;
use crate::db::stored_tiers::{
    self, AnnotationRow, PROPOSAL_TIER_SUFFIX, REJECTED_TIER_SUFFIX, TierRow, is_detector_tier, proposed_for,
};
use crate::detect::{recordings_of_scope, span_overlaps_times};
use crate::error::{CorpusError, CorpusResult};
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::search::{SearchHit, SearchOptions};
use crate::words::effect::OperationEffect;

/// The name of the detector that reads components from movement.
const COMPONENT_DETECTOR: &str = "components";

/// The most signs that a finding names.
const MOST_UNREAD_NAMES: usize = 20;

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
    /// Those of several recordings.
    Recordings(Vec<RowName>),
    /// Those of a recording that overlap a span.
    Span(RowName, TimeSpan),
    /// A single one.
    Token(i64),
}

/// The result of a proposal.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
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
    /// The values that were read, each with its time, its confidence and the nearest other reading.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub codings: Vec<ProposedCoding>,
    /// The number of annotations by confidence: each tenth by its lower end, such as `0.9`, and `unknown`.
    pub by_confidence: BTreeMap<String, u64>,
    /// The recordings that move, but have no signs yet for which something could be proposed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub uncut: Vec<String>,
    /// Notes on what is not proposed.
    pub findings: Vec<String>,
}

/// The proposals that are accepted; an empty or missing field does not narrow them.
#[derive(Debug, Clone, PartialEq)]
pub struct ProposalChoice {
    /// The tokens or the recording that they lie in.
    pub scope: ProposeScope,
    /// The names of their tiers, with or without `(proposed)`.
    pub tiers: Vec<String>,
    /// Their components.
    pub components: Vec<SignComponent>,
    /// The least confidence.
    pub least_confidence: Option<f64>,
}

/// The result of accepting proposals.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AcceptanceResult {
    /// The annotations that were written.
    #[serde(flatten)]
    pub report: AnnotateReport,
    /// The number of chosen proposals that are left, because something else lies in their place.
    pub left: u64,
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

/// Returns the tier on which an annotator accepts proposals, of all tiers of their recording: that of the same subject and
/// hand of the signer, by preference the annotator's own, then the one with their name; `None` if it must be added.
pub fn accepting_tier<'a>(
    proposals: &stored_tiers::TierRow,
    all: impl Iterator<Item = &'a stored_tiers::TierRow> + Clone,
    acceptor: &ProposalAcceptor,
) -> Option<&'a stored_tiers::TierRow> {
    let name = proposed_for(&proposals.name);
    let side = |hand: Option<AnnotatedHands>| match hand {
        Some(AnnotatedHands::One(hand)) => Some(AnnotatedHands::One(hand.resolve_hand_ref(acceptor.handedness).into())),
        other => other,
    };
    let rank = |tier: &&stored_tiers::TierRow| {
        let is_of_others = tier.annotator.as_deref().is_some_and(|other| other != acceptor.author);
        let is_own = tier.annotator.as_deref() == Some(acceptor.author.as_str());
        (is_of_others, !is_own, Some(tier.name.as_str()) != name)
    };
    all.filter(|tier| {
        let alike = (&tier.role, side(tier.hand)) == (&proposals.role, side(proposals.hand));
        // Annotations of symbolic tiers have no times, which a proposal has.
        let timed = tier.stereotype.is_none_or(|stereotype| stereotype.is_alignable());
        let same_person =
            tier.participant.is_none() || proposals.participant.is_none() || tier.participant == proposals.participant;
        alike && timed && same_person && !is_detector_tier(&tier.name)
    })
    .filter(|tier| !rank(tier).0)
    .min_by_key(rank)
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

/// A value that is proposed for a token.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProposedCoding {
    /// The row of the token.
    pub token: i64,
    /// Its gloss.
    pub gloss: String,
    /// The component, with its hand, such as `dominant.configuration`.
    pub field: String,
    /// The value with its time.
    #[serde(flatten)]
    pub proposed: ProposedValue,
}

/// A value of a component, with its time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProposedValue {
    /// The value.
    pub value: String,
    /// The start of the hold or act, in microseconds from the start of the recording.
    pub start_us: i64,
    /// Its end.
    pub end_us: i64,
    /// The confidence, from 0 to 1.
    pub confidence: f64,
    /// Whether the hand does not hold it, but passes through it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_moving: bool,
    /// The nearest other reading, in words of notation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub runner_up: Option<String>,
}

impl ProposedCoding {
    fn of_token(hit: &SearchHit, (component, feature, hand): &ProposalSubject, value: &ProposedValue) -> Self {
        let mut field = ComponentField::new(*component).with_field_hand(*hand);
        field.feature.clone_from(feature);
        Self {
            token: hit.token,
            gloss: hit.gloss.clone(),
            field: field.to_string(),
            proposed: value.clone(),
        }
    }
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

    /// Returns the scope that a text names: all of the corpus if it is empty, else that of an address, or the recordings of the
    /// tokens that a query finds.
    ///
    /// # Errors
    /// Fails if the address names nothing in the corpus, or the query is wrong.
    pub fn propose_scope_of_text(&mut self, text: &str) -> CorpusResult<ProposeScope> {
        if text.trim().is_empty() {
            return Ok(ProposeScope::All);
        }
        let unaddressed = match text.parse::<CorpusAddress>() {
            Ok(address) => match self.propose_scope(&address) {
                Ok(scope) => return Ok(scope),
                Err(error) => Some(error),
            },
            Err(_) => None,
        };
        let options = SearchOptions {
            limit: None,
            facets: false,
            ..SearchOptions::default()
        };
        // A bare word is both an address and a query; without an operator the failure as an address says
        // more.
        let is_query = text.contains(['=', '~', '<', '>']);
        if let (Some(error), false) = (unaddressed, is_query) {
            return Err(error);
        }
        let hits = self.search_tokens(text, &options)?.hits;
        let names: BTreeSet<String> = hits.into_iter().filter_map(|hit| hit.recording).collect();
        if names.is_empty() {
            let wrong = format!("{text} finds no token with a recording");
            return Err(CorpusError::from_wrong_message(wrong).with_advice("name a recording, such as recording:3"));
        }
        Ok(ProposeScope::Recordings(names.into_iter().map(RowName::Text).collect()))
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
        let mut unread: BTreeMap<String, Vec<&str>> = BTreeMap::new();
        let total = Some(wanted.len() as u64);
        for (done, (hit, components)) in wanted.values().enumerate() {
            progress.report_amount(ProgressUnit::Items, &hit.gloss, done as u64, total)?;
            if let Some(recording) = self.still_take(hit)? {
                still.insert(recording);
                report.unread += 1;
                continue;
            }
            match self.read_token_codes(components, hit, progress) {
                Ok(read) => {
                    let recording = hit.recording.clone().unwrap_or_default();
                    if read.lacks_fingers {
                        unseen.insert(recording.clone());
                    }
                    if read.values.is_empty() {
                        report.unread += 1;
                        continue;
                    }
                    report.tokens += 1;
                    for (subject, value) in read.values {
                        report.codings.push(ProposedCoding::of_token(hit, &subject, &value));
                        let key = (recording.clone(), subject);
                        values.entry(key).or_default().push(value);
                    }
                }
                Err(CorpusError::Stopped) => return Err(CorpusError::Stopped),
                // One token that cannot be read must not stop the proposals for all others.
                Err(error) => {
                    report.unread += 1;
                    unread.entry(error.to_string()).or_default().push(&hit.gloss);
                }
            }
        }
        report.findings.extend(self.finger_range_finding(&values)?);
        for (why, glosses) in &unread {
            let shown: Vec<&str> = glosses.iter().copied().take(MOST_UNREAD_NAMES).collect();
            let more = if shown.len() < glosses.len() { ", …" } else { "" };
            report
                .findings
                .push(format!("signs that cannot be read ({why}): {}{more}", shown.join(", ")));
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
        report.uncut = self.uncut_takes(&options.scope)?;
        if !report.uncut.is_empty() {
            let names = report.uncut.join(", ");
            let text = format!("no signs are marked yet, so nothing is proposed for them: {names}");
            report.findings.push(text);
        }
        let (new, changes) = self.proposal_changes(values)?;
        report.annotations = changes.len() as u64;
        for change in &changes {
            if let AnnotationAction::Add { confidence, .. } = &change.action {
                // A confidence of 1 belongs to the highest tenth.
                let tenth = confidence.map(|sure| format!("{:.1}", (sure * 10.0).floor().min(9.0) / 10.0));
                *report
                    .by_confidence
                    .entry(tenth.unwrap_or_else(|| "unknown".to_owned()))
                    .or_default() += 1;
            }
        }
        if !changes.is_empty() {
            let options = AnnotateOptions {
                origin: AnnotationOrigin::Detector,
                detector: Some(COMPONENT_DETECTOR),
                ..AnnotateOptions::default()
            };
            report.recordings = self
                .annotate_with(OperationEffect::Propose, &new, &changes, &options, progress)?
                .recordings;
        }
        Ok(report)
    }

    /// Returns the tokens of a scope that have no value for a component, neither one that counts nor an opinion.
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
        let (recordings, span) = recordings_of_scope(self.store.read_connection(), scope)?;
        let names: BTreeSet<String> = recordings.into_iter().map(|row| row.name).collect();
        let is_of_names = |hit: &SearchHit| hit.recording.as_ref().is_some_and(|name| names.contains(name));
        let options = SearchOptions {
            limit: None,
            facets: false,
            ..SearchOptions::default()
        };
        let query = format!("not {}=*", component.component_name());
        let answer = self.search_until(&query, &options, progress)?;
        // A rejected or disputed proposal would only come back.
        let opinions = signs::tokens_with_opinion(self.store.read_connection(), component.component_name())?;
        let is_in = |hit: &SearchHit| match scope {
            _ if opinions.contains(&hit.token) => false,
            ProposeScope::All => true,
            ProposeScope::Token(token) => hit.token == *token,
            ProposeScope::Recording(_) | ProposeScope::Recordings(_) => is_of_names(hit),
            ProposeScope::Span(..) => {
                let times = span.zip(hit.start_us.zip(hit.end_us));
                let shares = times.is_some_and(|(span, (start, end))| span_overlaps_times(span, start, end));
                is_of_names(hit) && shares
            }
        };
        Ok(answer.hits.into_iter().filter(is_in).collect())
    }

    /// Returns a finding with the other takes from which the range of the fingers of proposed handshapes is measured.
    fn finger_range_finding(&self, values: &ProposedTierValues) -> CorpusResult<Option<String>> {
        let connection = self.store.read_connection();
        let of_shapes = values
            .keys()
            .filter(|(_, (part, ..))| *part == SignComponent::Configuration);
        let recordings: BTreeSet<&String> = of_shapes.map(|(recording, _)| recording).collect();
        let mut takes = BTreeSet::new();
        for name in recordings {
            let recording = crate::address::find_recording_by_name(connection, &RowName::Text(name.clone()))?;
            takes.extend(crate::hands::hand_range_takes(connection, &self.hands, recording.id)?);
        }
        let mut names: Vec<String> = takes.into_iter().take(MOST_UNREAD_NAMES + 1).collect();
        if let Some(last) = names.get_mut(MOST_UNREAD_NAMES) {
            "…".clone_into(last);
        }
        let text = "the range of the fingers is measured from other takes of the signer, too";
        Ok((!names.is_empty()).then(|| format!("{text}: {}", names.join(", "))))
    }

    /// Returns the takes of a scope that move but have no signs yet.
    fn uncut_takes(&self, scope: &ProposeScope) -> CorpusResult<Vec<String>> {
        let connection = self.store.read_connection();
        let mut uncut_names = Vec::new();
        for recording in recordings_of_scope(connection, scope)?.0 {
            let is_uncut = signs::tokens_of_recording(connection, recording.id)?.is_empty();
            if is_uncut && stored_recordings::body_track(connection, recording.id)?.is_some() {
                uncut_names.push(recording.name);
            }
        }
        Ok(uncut_names)
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

    /// Returns the proposals of a choice, by recording, tier and time.
    ///
    /// # Errors
    /// Fails if nothing has the name in the scope, or the corpus cannot be read.
    pub fn find_proposals(&self, choice: &ProposalChoice) -> CorpusResult<Vec<i64>> {
        let connection = self.store.read_connection();
        let (recordings, span) = recordings_of_scope(connection, &choice.scope)?;
        let mut proposals = Vec::new();
        for recording in recordings {
            for tier in stored_tiers::load_tier_rows(connection, recording.id)? {
                let Some(name) = proposed_for(&tier.name) else {
                    continue;
                };
                let is_named = |wanted: &String| *wanted == tier.name || *wanted == name;
                let is_chosen = choice.tiers.is_empty() || choice.tiers.iter().any(is_named);
                let component = tier.role.role_component().map(|(component, _)| component);
                let is_wanted_part = |wanted: &SignComponent| Some(*wanted) == component;
                if !is_chosen || !(choice.components.is_empty() || choice.components.iter().any(is_wanted_part)) {
                    continue;
                }
                let rows = stored_tiers::load_tier_annotation_rows(connection, tier.id)?.into_iter();
                let is_wanted = |row: &stored_tiers::AnnotationRow| {
                    let shares = |span: TimeSpan| span_overlaps_times(span, row.start_us, row.end_us);
                    let sure = choice
                        .least_confidence
                        .is_none_or(|least| row.confidence >= Some(least));
                    tier.is_proposal(row) && span.is_none_or(shares) && sure
                };
                proposals.extend(rows.filter(is_wanted).map(|row| row.id));
            }
        }
        Ok(proposals)
    }

    /// Accepts the proposals of a choice for whose values there is room on the tiers of the annotator.
    ///
    /// # Errors
    /// Those of [`find_proposals`](Self::find_proposals) and [`accept_proposals`](Self::accept_proposals).
    pub fn accept_chosen_proposals(
        &mut self,
        choice: &ProposalChoice,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AcceptanceResult> {
        let mut proposals = self.find_proposals(choice)?;
        let all = proposals.len();
        let connection = self.store.read_connection();
        let mut taken: BTreeMap<i64, Vec<(i64, i64)>> = BTreeMap::new();
        let mut room = Vec::with_capacity(all);
        for id in proposals.drain(..) {
            let row = stored_tiers::load_annotation_row(connection, id)?;
            let tier = stored_tiers::load_tier_row(connection, row.tier_id)?;
            // A tier that is created for them has room for all.
            let Some(to) = self.find_accepting_tier(&tier)? else {
                room.push(id);
                continue;
            };
            let times = match taken.entry(to.id) {
                std::collections::btree_map::Entry::Occupied(entry) => entry.into_mut(),
                std::collections::btree_map::Entry::Vacant(entry) => {
                    let rows = stored_tiers::load_tier_annotation_rows(connection, to.id)?;
                    entry.insert(rows.iter().map(|row| (row.start_us, row.end_us)).collect())
                }
            };
            if times
                .iter()
                .all(|(start, end)| *end <= row.start_us || *start >= row.end_us)
            {
                // Accepted proposals take up room themselves.
                times.push((row.start_us, row.end_us));
                room.push(id);
            }
        }
        Ok(AcceptanceResult {
            left: (all - room.len()) as u64,
            report: self.accept_proposals(&room, progress)?,
        })
    }

    /// Returns the tier on which the author of the corpus accepts the proposals of a tier, if there is one.
    fn find_accepting_tier(&self, proposals: &stored_tiers::TierRow) -> CorpusResult<Option<stored_tiers::TierRow>> {
        let connection = self.store.read_connection();
        let all = stored_tiers::load_tier_rows(connection, proposals.recording_id)?;
        let acceptor = self.proposal_acceptor(proposals.recording_id)?;
        Ok(accepting_tier(proposals, all.iter(), &acceptor).cloned())
    }

    /// Accepts proposals unchanged: each becomes an annotation by the author of the corpus, with the name and the confidence
    /// of the detector, on the tier that the author has for it, or else on one without `(proposed)` in its name, which is added.
    /// Tiers of proposals that are empty then are removed. All of it is one operation.
    ///
    /// # Errors
    /// Fails if one of them is not a proposal, overlaps an annotation of its tier, or the corpus cannot be written.
    pub fn accept_proposals(
        &mut self,
        annotations: &[i64],
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnnotateReport> {
        let mut settled = SettledProposals::default();
        for &id in annotations {
            let (row, tier, name) = self.load_proposal(id)?;
            let all = stored_tiers::load_tier_rows(self.store.read_connection(), tier.recording_id)?;
            let known_tier = self.find_accepting_tier(&tier)?;
            let to = match &known_tier {
                Some(known) => known.name.clone(),
                // The name belongs to a tier of another subject or annotator.
                None if all.iter().any(|row| row.name == name) => format!("{name} (accepted)"),
                None => name,
            };
            let author = self.proposal_acceptor(tier.recording_id)?.author;
            let annotator = Some(author).filter(|name| !name.is_empty());
            settled.move_proposal(row, &tier, to, known_tier.is_some(), annotator);
        }
        self.write_settled_proposals(settled, AnnotationOrigin::Human, progress)
    }

    /// Rejects proposals: each stays on a tier with `(rejected)` in its name as what a detector said, counts nowhere, and is not
    /// proposed again. Tiers of proposals that are empty then are removed. All of it is one operation.
    ///
    /// # Errors
    /// Fails if one of them is not a proposal, or the corpus cannot be written.
    pub fn reject_proposals(
        &mut self,
        annotations: &[i64],
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnnotateReport> {
        let mut settled = SettledProposals::default();
        for &id in annotations {
            let (row, tier, name) = self.load_proposal(id)?;
            let connection = self.store.read_connection();
            let to = format!("{name}{REJECTED_TIER_SUFFIX}");
            let all = stored_tiers::load_tier_rows(connection, tier.recording_id)?;
            let known_tier = all.iter().find(|row| row.name == to);
            let earlier = match known_tier {
                Some(known) => stored_tiers::annotations_near(connection, known.id, row.start_us, row.end_us)?,
                None => Vec::new(),
            };
            let overlaps = |old: &AnnotationRow| old.start_us < row.end_us && row.start_us < old.end_us;
            if earlier.iter().any(overlaps) {
                // Something was rejected here before, and annotations of a tier do not overlap.
                settled.remove_proposal(id, tier.id);
            } else {
                settled.move_proposal(row, &tier, to, known_tier.is_some(), None);
            }
        }
        self.write_settled_proposals(settled, AnnotationOrigin::Detector, progress)
    }

    /// Returns a proposal with its tier, and the name of the tier that it is proposed for.
    fn load_proposal(&self, id: i64) -> CorpusResult<(AnnotationRow, TierRow, String)> {
        let connection = self.store.read_connection();
        let row = stored_tiers::load_annotation_row(connection, id)?;
        let tier = stored_tiers::load_tier_row(connection, row.tier_id)?;
        match proposed_for(&tier.name).map(str::to_owned) {
            Some(name) => Ok((row, tier, name)),
            None => {
                let text = format!("annotation:{id} on \"{}\" is no proposal", tier.name);
                Err(CorpusError::from_wrong_message(text)
                    .with_advice("proposals lie on tiers whose names end in \"(proposed)\""))
            }
        }
    }

    /// Writes accepted proposals as annotations of a person, and rejected ones as those of their detector.
    fn write_settled_proposals(
        &mut self,
        settled: SettledProposals,
        origin: AnnotationOrigin,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnnotateReport> {
        let options = AnnotateOptions {
            origin,
            ..AnnotateOptions::default()
        };
        self.store.operation_with_progress(progress, |connection, progress| {
            let report = write_tiers(connection, &settled.tiers, &settled.changes, &options, progress)?;
            for (place, source) in settled.sources {
                if let Some(id) = report.annotations.get(place) {
                    let mut row = stored_tiers::load_annotation_row(connection, *id)?;
                    row.source = source;
                    stored_tiers::update_annotation(connection, &row)?;
                }
            }
            for tier in settled.emptied {
                if stored_tiers::load_tier_annotation_rows(connection, tier)?.is_empty() {
                    stored_tiers::delete_tier(connection, tier)?;
                }
            }
            let (count, annotations) = (report.effect.count_removed(), report.effect.clone());
            let effect = match origin {
                AnnotationOrigin::Detector => OperationEffect::Reject { count, annotations },
                _ => OperationEffect::Accept { count, annotations },
            };
            Ok((report, effect))
        })
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
            let stored = self.stored_tier_times(&recording, &name)?;
            let row = crate::address::find_recording_by_name(self.store.read_connection(), &recording)?;
            if stored.is_none() {
                let role = TierRole::Component { component, feature };
                let mut new = NewTier::new(recording, name, role);
                new.hand = Some(AnnotatedHands::One(hand));
                tiers.push(new);
            }
            let mut taken = stored.unwrap_or_default();
            values.sort_by_key(|value| value.start_us);
            for value in values {
                // Signs of two hands may overlap; annotations of one tier may not.
                let before = taken.iter().filter(|(start, _)| *start <= value.start_us);
                let start = before.map(|(_, end)| *end).fold(value.start_us, i64::max);
                let after = taken.iter().map(|(other_start, _)| *other_start);
                let end = after
                    .filter(|other| *other > value.start_us)
                    // The last frame of a hold may end a little after the recording.
                    .fold(value.end_us.min(row.duration_us), i64::min);
                if start >= end {
                    continue;
                }
                taken.push((start, end));
                let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
                changes.push(
                    AnnotationAction::Add {
                        tier: tier.clone(),
                        start: time(start),
                        end: time(end),
                        parent: None,
                        order: None,
                        value: value.value,
                        confidence: Some(value.confidence),
                    }
                    .into(),
                );
            }
        }
        Ok((tiers, changes))
    }

    /// Returns the times of the annotations on a recording's tier, if there is such a tier.
    fn stored_tier_times(&self, recording: &RowName, tier: &str) -> CorpusResult<Option<Vec<(i64, i64)>>> {
        let connection = self.store.read_connection();
        let recording = crate::address::find_recording_by_name(connection, recording)?;
        let all = stored_tiers::load_tier_rows(connection, recording.id)?;
        let Some(tier) = all.into_iter().find(|row| row.name == tier) else {
            return Ok(None);
        };
        let rows = stored_tiers::load_tier_annotation_rows(connection, tier.id)?;
        Ok(Some(rows.iter().map(|row| (row.start_us, row.end_us)).collect()))
    }
}

/// Proposals on which a person decided: the changes that move or remove them.
#[derive(Default)]
struct SettledProposals {
    tiers: Vec<NewTier>,
    changes: Vec<AnnotationChange>,
    /// The properties of added annotations, by the place of their change.
    sources: Vec<(usize, Option<String>)>,
    /// The tiers that lose proposals.
    emptied: BTreeSet<i64>,
}

impl SettledProposals {
    /// Moves a proposal to the tier of a name; a tier that is not `known` yet is added with the properties of the proposal's.
    fn move_proposal(
        &mut self,
        row: AnnotationRow,
        tier: &TierRow,
        to: String,
        is_known: bool,
        annotator: Option<String>,
    ) {
        let recording = RowName::Number(tier.recording_id);
        let is_new = |new: &NewTier| (&new.recording, &new.name) == (&recording, &to);
        if !is_known && !self.tiers.iter().any(is_new) {
            let mut added = NewTier::new(recording.clone(), to.clone(), tier.role.clone());
            added.hand = tier.hand;
            added.annotator = annotator;
            added.participant.clone_from(&tier.participant);
            self.tiers.push(added);
        }
        let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
        self.sources.push((self.changes.len(), row.source));
        let add = AnnotationAction::Add {
            tier: TierRequestName::Of { recording, tier: to },
            start: time(row.start_us),
            end: time(row.end_us),
            parent: None,
            order: None,
            value: row.value,
            confidence: row.confidence,
        };
        self.changes.push(add.into());
        self.remove_proposal(row.id, tier.id);
    }

    fn remove_proposal(&mut self, id: i64, tier: i64) {
        let annotation = AnnotationName::Number(id);
        self.changes.push(AnnotationAction::Remove { annotation }.into());
        self.emptied.insert(tier);
    }
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

    /// Returns a corpus with a table of signs, and a take of a sign that nobody has coded; its annotator has a tier for the
    /// handshape of the right hand.
    fn corpus_with_an_uncoded_take(folder: &std::path::Path) -> Corpus {
        let own = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
        let table = folder.join("signs.csv");
        std::fs::write(
            &table,
            "gloss,handshape,location\nA,B,chin\nB,V,chin\nC,B,chest\nD,V,chest\n",
        )
        .expect("written");
        let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A").expect("made");
        let mut hear = ignore_progress_step;
        let mut progress = ProgressReceiver::new(&mut hear);
        let imported = corpus.import_paths(&[own.join("bol.bvh"), table], &ImportOptions::default(), &mut progress);
        imported.expect("taken in");
        let take = || RowName::Text("bol".into());
        corpus
            .add_tier(&NewTier::new(take(), "gloss", TierRole::Gloss))
            .expect("a tier");
        let role = "configuration".parse().expect("a role");
        let mut hand = NewTier::new(take(), "Configuration RH", role);
        hand.hand = Some(AnnotatedHands::One(HandRef::Right));
        hand.parent = Some(("gloss".into(), chereme_sign::TierStereotype::IncludedIn));
        corpus.add_tier(&hand).expect("a tier");
        let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
        let add = AnnotationAction::Add {
            tier: TierRequestName::Of {
                recording: take(),
                tier: "gloss".into(),
            },
            start: time(0),
            end: time(1_000_000),
            parent: None,
            order: None,
            value: "BOL".into(),
            confidence: None,
        };
        corpus
            .annotate_corpus(&[add.into()], &Default::default(), &mut progress)
            .expect("annotated");
        corpus
    }

    #[test]
    fn proposals_change_no_figure_and_accepted_ones_fill_the_tiers_of_the_annotator() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus_with_an_uncoded_take(folder.path());
        let mut hear = ignore_progress_step;
        let mut progress = ProgressReceiver::new(&mut hear);
        let figures = |corpus: &mut Corpus| {
            let mut hear = ignore_progress_step;
            let stats = corpus.lexicon_statistics(&Default::default(), &mut ProgressReceiver::new(&mut hear));
            let pairs = corpus.minimal_pairs(&Default::default(), &mut crate::ProgressReceiver::silent_progress());
            let answer = corpus
                .search_tokens("configuration=* or placement=*", &SearchOptions::default())
                .expect("found");
            let facets: Vec<_> = answer
                .facets
                .into_iter()
                .filter(|(field, _)| field != "proposed")
                .collect();
            format!("{stats:?} {pairs:?} {} {facets:?}", answer.total)
        };
        let before = figures(&mut corpus);
        let options = ProposeOptions {
            components: ProposalResult::READABLE_COMPONENTS.to_vec(),
            scope: ProposeScope::All,
        };
        let proposed = corpus.propose_components(&options, &mut progress).expect("proposed");
        assert!(proposed.annotations > 3, "{proposed:?}");
        assert_eq!(proposed.by_confidence.values().sum::<u64>(), proposed.annotations);
        assert_eq!(proposed.by_confidence.get("unknown"), None, "each has a confidence");
        let is_timed = |coding: &ProposedCoding| {
            0 <= coding.proposed.start_us && coding.proposed.start_us < coding.proposed.end_us
        };
        assert!(proposed.codings.iter().all(is_timed), "{:?}", proposed.codings);
        let unread = "signs that cannot be read (there is no movement to read): A, B, C, D";
        assert!(
            proposed.findings.iter().any(|finding| finding == unread),
            "{:?}",
            proposed.findings
        );
        assert_eq!(figures(&mut corpus), before);
        let again = corpus.propose_components(&options, &mut progress).expect("proposed");
        assert_eq!(again.annotations, 0, "what is proposed is not proposed again");

        let mut choice = ProposalChoice {
            scope: ProposeScope::All,
            tiers: Vec::new(),
            components: vec![SignComponent::Configuration],
            least_confidence: Some(1.1),
        };
        assert!(
            corpus.find_proposals(&choice).expect("found").is_empty(),
            "none is as sure"
        );
        choice.least_confidence = None;
        let chosen = corpus.find_proposals(&choice).expect("found").len() as u64;
        let accepted = corpus
            .accept_chosen_proposals(&choice, &mut progress)
            .expect("accepted");
        assert_eq!((accepted.report.added, accepted.left), (chosen, 0));
        let connection = corpus.store.read_connection();
        let tiers = stored_tiers::load_tier_rows(connection, 1).expect("tiers");
        let of_shapes: Vec<&str> = tiers
            .iter()
            .map(|tier| tier.name.as_str())
            .filter(|name| name.to_lowercase().starts_with("configuration"))
            .collect();
        assert!(
            of_shapes.iter().all(|name| proposed_for(name).is_none()),
            "{of_shapes:?}"
        );
        assert!(!of_shapes.contains(&"configuration dominant"), "{of_shapes:?}");
        let own = tiers
            .iter()
            .find(|tier| tier.name == "Configuration RH")
            .expect("a tier");
        let rows = stored_tiers::load_tier_annotation_rows(connection, own.id).expect("annotations");
        assert!(!rows.is_empty());
        assert!(
            rows.iter()
                .all(|row| row.origin == AnnotationOrigin::Human && row.confidence.is_some()),
            "{rows:?}"
        );
        let found = corpus.search_tokens("gloss=BOL right.configuration=*", &SearchOptions::default());
        assert_eq!(found.expect("found").total, 1);
    }

    #[test]
    fn a_decided_proposal_keeps_its_detector_and_a_rejected_one_is_not_proposed_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus_with_an_uncoded_take(folder.path());
        let mut hear = ignore_progress_step;
        let mut progress = ProgressReceiver::new(&mut hear);
        let shapes = ProposalChoice {
            scope: ProposeScope::All,
            tiers: Vec::new(),
            components: vec![SignComponent::Configuration],
            least_confidence: None,
        };
        corpus
            .propose_coding(SignComponent::Configuration, &mut progress)
            .expect("proposed");
        let proposals = corpus.find_proposals(&shapes).expect("found");
        let row = |corpus: &Corpus, id: i64| {
            stored_tiers::load_annotation_row(corpus.store.read_connection(), id).expect("an annotation")
        };
        let first = row(&corpus, proposals[0]);
        let property = |row: &AnnotationRow, name: &str| {
            let source: serde_json::Value =
                serde_json::from_str(row.source.as_deref().expect("a source")).expect("JSON");
            source[name].as_str().map(str::to_owned)
        };
        assert_eq!(property(&first, "detector").as_deref(), Some(COMPONENT_DETECTOR));
        // Accepted, it is a person's with the detector beside it.
        let accepted = corpus
            .accept_proposals(&proposals[..1], &mut progress)
            .expect("accepted");
        let own = row(&corpus, accepted.annotations[0]);
        assert_eq!(
            (own.origin, own.confidence),
            (AnnotationOrigin::Human, first.confidence)
        );
        assert_eq!(own.source, first.source);
        corpus.undo_operation().expect("undone");
        // Corrected, it says what was proposed.
        let correction = AnnotationAction::Set {
            annotation: AnnotationName::Number(proposals[0]),
            start: None,
            end: None,
            value: Some("V".into()),
        };
        corpus
            .annotate_corpus(&[correction.into()], &AnnotateOptions::default(), &mut progress)
            .expect("corrected");
        let corrected = row(&corpus, proposals[0]);
        assert_eq!(
            (corrected.origin, corrected.confidence),
            (AnnotationOrigin::Human, None)
        );
        assert_eq!(property(&corrected, "proposed"), Some(first.value.clone()));
        assert_eq!(property(&corrected, "detector").as_deref(), Some(COMPONENT_DETECTOR));
        corpus.undo_operation().expect("undone");
        // Rejected, it stays as what the detector said, and nowhere else.
        let all = proposals.len();
        corpus.reject_proposals(&proposals, &mut progress).expect("rejected");
        assert!(corpus.find_proposals(&shapes).expect("found").is_empty());
        let details = corpus
            .token_details(&"BOL".parse().expect("an address"))
            .expect("details");
        let standings: Vec<_> = details.opinions.iter().map(|one| one.standing).collect();
        assert!(!standings.is_empty() && standings.len() <= all, "{details:?}");
        assert!(
            standings.iter().all(|one| *one == crate::OpinionStanding::Rejected),
            "{standings:?}"
        );
        let found = corpus.search_tokens("proposed:yes", &SearchOptions::default());
        assert_eq!(found.map_or(0, |answer| answer.total), 0);
        let again = corpus.propose_coding(SignComponent::Configuration, &mut progress);
        assert_eq!(again.expect("asked again").annotations, 0);
        corpus.undo_operation().expect("undone");
        assert_eq!(corpus.find_proposals(&shapes).expect("found"), proposals);
    }
}
