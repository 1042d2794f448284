//! The gate for every way out of a corpus: what may be passed on to whom, and under which terms.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::text::fold_text;
use chereme_sign::{ErrorRemedy, RemedyChoice};
use rusqlite::Connection;
use serde::Serialize;

use super::kept_movement::{self, MovementPiece};
use super::{ConsentAudience, ConsentKind, PersonConsent, consent_row, unnamed};
use crate::RecordOrigin;
use crate::db::stored_recordings::RecordingRow;
use crate::db::{consents, lexicons, stored_recordings};
use crate::error::{CorpusError, CorpusResult};
use crate::merge;
use crate::progress::ProgressReceiver;
use crate::starter::OWN_BODY;

/// A reason why something may not be published.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WithheldReason {
    /// Nobody recorded what the signer agreed to.
    ConsentUnknown,
    /// The signer did not agree that these people see it.
    NotPublic,
    /// No terms of use are stated.
    NoTerms,
    /// The terms forbid that something is made from it.
    NoDerivatives,
    /// Two copies of the corpus disagree about it, and nobody has decided.
    Undecided,
    /// A recording that it was made from is not known, or no longer there.
    InputGone,
}

impl WithheldReason {
    /// Returns the reason as part of a sentence.
    #[must_use]
    pub fn reason_words(self) -> &'static str {
        match self {
            Self::ConsentUnknown => "it is not stated what the signers agreed to",
            Self::NotPublic => "the signers did not agree to it",
            Self::NoTerms => "no terms of use are stated",
            Self::NoDerivatives => "the terms of a source forbid changes",
            Self::Undecided => "two copies of the corpus disagree",
            Self::InputGone => "a source is not known, or no longer there",
        }
    }
}

/// What is stated about one kind of use of a recording, by all whom it shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct StatedAudience {
    /// The narrowest of all that was stated.
    pub(super) least: Option<ConsentAudience>,
    /// What the recording itself states.
    own: Option<ConsentAudience>,
    /// Whether somebody whom it shows stated nothing.
    pub(super) is_incomplete: bool,
    /// Whether another copy of the corpus allows less, and nobody has decided.
    is_doubted: bool,
    /// The recording whose movement it shows, if that allows less.
    narrowed_by: Option<i64>,
    /// The person because of whom the audience may not see it.
    refused_by: Option<i64>,
}

/// A contributor because of whom something is withheld, and the reason.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct WithheldSource {
    pub(super) recording: i64,
    pub(super) reason: WithheldReason,
    /// The person whom the recording shows and who did not agree, if it is a person.
    pub(super) person: Option<i64>,
}

/// The permissions of a corpus, read at one moment.
pub(crate) struct PublishPermissions {
    recordings: BTreeMap<i64, RecordingRow>,
    /// The names of people.
    people: BTreeMap<i64, String>,
    /// What is stated about each recording, by kind.
    stated: BTreeMap<i64, [StatedAudience; 3]>,
    /// The recordings that a generated one takes movement from; `None` if one of them is gone or not known.
    inputs: BTreeMap<i64, Option<BTreeSet<i64>>>,
    /// The sources whose movement a generated recording shows unchanged, where movement and derived signs may be seen
    /// by different people.
    kept_sources: BTreeMap<i64, BTreeSet<i64>>,
    /// The signs made here that a recording shows, which came back from a file and knows no recipe.
    shown_signs: BTreeMap<i64, BTreeSet<i64>>,
    /// Recordings in which a person moves or a signer is named.
    personal: BTreeSet<i64>,
    /// Terms of what has none of its own and shows nobody.
    terms: Option<String>,
    /// The terms of lexicons, by name.
    lexicon_terms: BTreeMap<String, String>,
    /// Who is to see what is passed on.
    audience: ConsentAudience,
}

/// What stands for the terms where none are stated.
pub(crate) const TERMS_NOT_STATED: &str = "not stated: ask the owner before use";

impl PublishPermissions {
    /// Reads the permissions of a corpus for everybody; `terms` hold for what has none of its own and shows nobody.
    pub(crate) fn read_publish_permissions(connection: &Connection, terms: Option<&str>) -> CorpusResult<Self> {
        Self::read_permissions_for(connection, terms, ConsentAudience::Public)
    }

    /// Reads the permissions of a corpus for an audience; `terms` hold for what has none of its own and shows nobody.
    pub(crate) fn read_permissions_for(
        connection: &Connection,
        terms: Option<&str>,
        audience: ConsentAudience,
    ) -> CorpusResult<Self> {
        let mut signers: BTreeMap<i64, (String, PersonConsent)> = BTreeMap::new();
        for row in consents::of_signers(connection)? {
            let row = consent_row("signer", row)?;
            signers.insert(row.id, (row.name, row.consent));
        }
        let mut own_consents: BTreeMap<i64, PersonConsent> = BTreeMap::new();
        for row in consents::of_recordings(connection)? {
            let row = consent_row("recording", row)?;
            own_consents.insert(row.id, row.consent);
        }
        let mut named: BTreeMap<i64, BTreeSet<String>> = BTreeMap::new();
        for (recording, name) in consents::list_tier_participants(connection)? {
            named.entry(recording).or_default().insert(name);
        }
        let mut inputs: BTreeMap<i64, Option<BTreeSet<i64>>> = BTreeMap::new();
        for (made, input, token) in consents::list_recipe_movement_inputs(connection, OWN_BODY)? {
            let all = inputs.entry(made).or_insert_with(|| Some(BTreeSet::new()));
            match input {
                Some(input) => drop(all.as_mut().map(|set| set.insert(input))),
                // A lexicon entry has no movement of a person.
                None if token => {}
                // A source that was deleted may have belonged to anybody.
                None => *all = None,
            }
        }
        let rows = stored_recordings::load_recording_rows(connection)?;
        unnamed::complete_unnamed_inputs(connection, &rows, &mut inputs)?;
        let doubts = doubts(connection)?;
        // A participant written in other letters is the same person.
        let mut by_name: BTreeMap<String, Vec<i64>> = BTreeMap::new();
        for (id, (name, _)) in &signers {
            by_name.entry(fold_text(name.trim())).or_default().push(*id);
        }
        let mut permissions = Self {
            recordings: BTreeMap::new(),
            people: signers.iter().map(|(id, (name, _))| (*id, name.clone())).collect(),
            stated: BTreeMap::new(),
            inputs,
            kept_sources: BTreeMap::new(),
            shown_signs: BTreeMap::new(),
            personal: BTreeSet::new(),
            lexicon_terms: lexicons::load_lexicon_rows(connection)?
                .into_iter()
                .filter_map(|row| Some((row.name, row.terms?)))
                .collect(),
            terms: terms.map(str::to_owned),
            audience,
        };
        for row in rows {
            let mut people: Vec<Option<i64>> = row.signer_id.map(Some).into_iter().collect();
            for name in named.get(&row.id).into_iter().flatten() {
                match by_name.get(&fold_text(name)) {
                    Some(same) => people.extend(same.iter().copied().map(Some)),
                    // Somebody without a row as signer has agreed to nothing.
                    None => people.push(None),
                }
            }
            // A captured recording shows somebody even if nobody is named.
            let shows = row.origin == RecordOrigin::Captured || !people.is_empty();
            if shows {
                permissions.personal.insert(row.id);
            }
            if row.origin == RecordOrigin::Made {
                // Without a recipe nobody knows whose movement it is.
                permissions.inputs.entry(row.id).or_insert(None);
            }
            let own_consent = own_consents.get(&row.id);
            let each: Vec<Option<&PersonConsent>> = people
                .iter()
                .map(|entry| entry.and_then(|id| signers.get(&id)).map(|(_, consent)| consent))
                .collect();
            let stated = ConsentKind::ALL_CONSENT_KINDS.map(|kind| {
                let is_doubted = doubts.contains(&("recording", row.id, kind));
                let mut named = people.iter().flatten();
                let allows = |person: &i64| signers.get(person)?.1.audience_of_kind(kind);
                let refuses = |person: &&i64| allows(person).is_some_and(|allowed| allowed < audience);
                let says_nothing = |person: &&i64| allows(person).is_none();
                let mut refused_by = people.iter().flatten().find(refuses);
                // A refusal is stronger than a missing statement.
                refused_by = refused_by.or_else(|| people.iter().flatten().find(says_nothing));
                StatedAudience {
                    refused_by: refused_by.copied(),
                    is_doubted: is_doubted || named.any(|person| doubts.contains(&("signer", *person, kind))),
                    ..state_audience(own_consent, &each, shows, kind)
                }
            });
            permissions.stated.insert(row.id, stated);
            permissions.recordings.insert(row.id, row);
        }
        permissions.join_equal_movement(connection)?;
        permissions.join_pieces_of_takes(connection)?;
        permissions.find_kept_movement(connection)?;
        permissions.find_shown_signs(connection)?;
        Ok(permissions)
    }

    /// Gives recordings with equal movement the narrowest consent of any of them. A sign that was made here has its
    /// consents from its sources, and does not narrow theirs.
    fn join_equal_movement(&mut self, connection: &Connection) -> CorpusResult<()> {
        for group in kept_movement::equal_movement_groups(connection)? {
            let is_source = |id: &&i64| (self.recordings.get(*id)).is_some_and(|row| row.origin != RecordOrigin::Made);
            let sources: Vec<i64> = group.iter().filter(is_source).copied().collect();
            // Annotation is no part of the movement, so equal movement says nothing about it.
            for kind in [ConsentKind::Movement, ConsentKind::Derived] {
                let all: Vec<StatedAudience> = sources.iter().map(|id| self.stated_audience(*id, kind)).collect();
                let least = all.iter().filter_map(|stated| stated.least).min();
                let is_doubted = all.iter().any(|stated| stated.is_doubted);
                for id in &group {
                    if let Some(stated) = self.stated.get_mut(id) {
                        let stated = &mut stated[kind as usize];
                        // Copies show the same person, so the narrowest statement holds for all of them.
                        stated.least = stated.least.into_iter().chain(least).min();
                        stated.is_doubted |= is_doubted;
                    }
                }
            }
        }
        Ok(())
    }

    /// Gives a recording that shows a stretch of another one the narrower consent of the two, where they differ.
    fn join_pieces_of_takes(&mut self, connection: &Connection) -> CorpusResult<()> {
        let kinds = [ConsentKind::Movement, ConsentKind::Derived];
        // Only where this audience may see one and not the other does it matter whose movement it is.
        let [seen, withheld] = [true, false].map(|is_seen| {
            let recordings = self.recordings.values().filter(|row| row.origin != RecordOrigin::Made);
            let ids = recordings.map(|row| row.id);
            ids.filter(|id| kinds.iter().any(|kind| self.may_be_seen(*id, *kind).is_ok() == is_seen))
                .collect::<BTreeSet<i64>>()
        });
        let progress = &mut ProgressReceiver::silent_progress();
        let mut shown = kept_movement::find_movement_pieces(connection, &seen, &withheld, progress)?;
        // A longer recording may hold a whole take of another one.
        shown.extend(kept_movement::find_movement_pieces(
            connection, &withheld, &seen, progress,
        )?);
        for found in shown {
            let [narrowed, by] = match withheld.contains(&found.take) {
                true => [found.piece, found.take],
                false => [found.take, found.piece],
            };
            for kind in kinds {
                let of_other = self.stated_audience(by, kind);
                if let Some(stated) = self.stated.get_mut(&narrowed) {
                    let stated = &mut stated[kind as usize];
                    let before = *stated;
                    stated.least = stated.least.into_iter().chain(of_other.least).min();
                    stated.is_incomplete |= of_other.is_incomplete;
                    stated.is_doubted |= of_other.is_doubted;
                    if *stated != before {
                        stated.narrowed_by = Some(by);
                    }
                }
            }
        }
        Ok(())
    }

    /// Finds the generated recordings that show the movement of a source unchanged, where that makes a difference.
    fn find_kept_movement(&mut self, connection: &Connection) -> CorpusResult<()> {
        let generated: Vec<i64> = self.inputs.keys().copied().collect();
        for recording in generated {
            let mut sources = self.source_recordings(recording);
            // Comparing movement is slow, and needless where both kinds are stated alike.
            sources.retain(|source| {
                self.stated_audience(*source, ConsentKind::Movement)
                    != self.stated_audience(*source, ConsentKind::Derived)
            });
            let kept_sources = kept_movement::sources_kept_by(connection, recording, &sources)?;
            self.kept_sources.insert(recording, kept_sources);
        }
        Ok(())
    }

    /// Finds the recordings that show a sign which was made here and is withheld.
    fn find_shown_signs(&mut self, connection: &Connection) -> CorpusResult<()> {
        let is_withheld = |id: &i64| self.contributed_terms(*id, ConsentKind::Movement).is_err();
        let signs = self.signs_and_recorded().0.into_iter().filter(is_withheld).collect();
        for shown in self.find_recordings_of_signs(connection, &signs, &mut ProgressReceiver::silent_progress())? {
            let kept_by_sign = self.kept_sources.get(&shown.take).cloned().unwrap_or_default();
            self.kept_sources.entry(shown.piece).or_default().extend(kept_by_sign);
            self.shown_signs.entry(shown.piece).or_default().insert(shown.take);
        }
        Ok(())
    }

    /// Returns the recordings that show these signs, which were exported and imported again: they know no recipe.
    pub(crate) fn find_recordings_of_signs(
        &self,
        connection: &Connection,
        signs: &BTreeSet<i64>,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<MovementPiece>> {
        let recorded = self.signs_and_recorded().1;
        let mut found = kept_movement::find_movement_pieces(connection, &recorded, signs, progress)?;
        let shows_source = |shown: &MovementPiece| {
            let (piece, sources) = (BTreeSet::from([shown.piece]), self.source_recordings(shown.take));
            // A sign that keeps the movement of a source says nothing of those who show that movement themselves.
            let is_of_source = kept_movement::find_movement_pieces(connection, &piece, &sources, progress)?;
            Ok::<_, CorpusError>(sources.contains(&shown.piece) || !is_of_source.is_empty())
        };
        let of_sources: Vec<bool> = found.iter().map(shows_source).collect::<Result<_, _>>()?;
        let mut of_sources = of_sources.iter();
        found.retain(|_| of_sources.next() == Some(&false));
        Ok(found)
    }

    /// Returns the recordings that were made here, and all others.
    fn signs_and_recorded(&self) -> (BTreeSet<i64>, BTreeSet<i64>) {
        let is_made = |id: &i64| self.recordings[id].origin == RecordOrigin::Made;
        self.recordings.keys().partition(|id| is_made(id))
    }

    /// Returns the recordings that a generated one was made from, over recipes of recipes.
    pub(crate) fn source_recordings(&self, recording: i64) -> BTreeSet<i64> {
        let (mut sources, mut waiting) = (BTreeSet::new(), vec![recording]);
        while let Some(next) = waiting.pop() {
            let inputs = self.inputs.get(&next).into_iter().flatten().flatten();
            for &input in inputs.chain(self.shown_signs.get(&next).into_iter().flatten()) {
                // Recipes may share a source, which is then followed only once.
                if sources.insert(input) {
                    waiting.push(input);
                }
            }
        }
        sources
    }

    fn stated_audience(&self, recording: i64, kind: ConsentKind) -> StatedAudience {
        let stated = self.stated.get(&recording);
        stated.map_or_else(StatedAudience::default, |by_kind| by_kind[kind as usize])
    }

    /// Returns the terms under which an entry of a table may be published: those of its lexicon, else those that hold
    /// for what has none of its own.
    pub(crate) fn entry_publish_terms(
        &self,
        lexicon: Option<&str>,
    ) -> std::result::Result<BTreeSet<String>, WithheldReason> {
        let of_lexicon = lexicon.and_then(|name| self.lexicon_terms.get(name));
        let terms = of_lexicon.or(self.terms.as_ref()).ok_or(WithheldReason::NoTerms)?;
        Ok(BTreeSet::from([terms.clone()]))
    }

    /// Returns the terms under which a recording may be published, those of all its inputs included.
    pub(crate) fn recording_publish_terms(
        &self,
        recording: i64,
        kind: ConsentKind,
    ) -> std::result::Result<BTreeSet<String>, WithheldReason> {
        self.contributed_terms(recording, kind)
            .map_err(|withheld| withheld.reason)
    }

    /// Returns the terms of all who contributed to a recording.
    pub(super) fn contributed_terms(
        &self,
        recording: i64,
        asked: ConsentKind,
    ) -> std::result::Result<BTreeSet<String>, WithheldSource> {
        let mut terms = BTreeSet::new();
        let (mut seen, mut waiting) = (BTreeSet::from([(recording, asked)]), vec![(recording, asked)]);
        let kept_sources = self.kept_sources.get(&recording);
        while let Some((contributor, kind)) = waiting.pop() {
            let withheld = |reason| WithheldSource {
                recording: contributor,
                reason,
                person: None,
            };
            let row = self.recordings.get(&contributor);
            let row = row.ok_or_else(|| withheld(WithheldReason::InputGone))?;
            let inputs = match self.inputs.get(&contributor) {
                Some(None) => return Err(withheld(WithheldReason::InputGone)),
                Some(Some(inputs)) => Some(inputs),
                None => None,
            };
            let licence = stated_licence(row);
            let from_others = inputs.is_some_and(|list| !list.is_empty());
            // The recording's own statement holds even where its sources allow more.
            if (self.stated_audience(contributor, kind).own).is_some_and(|own| own < self.audience) {
                return Err(withheld(WithheldReason::NotPublic));
            }
            // A recording made from others shows a derived sign, and nothing that was recorded.
            let kind = if from_others { ConsentKind::Derived } else { kind };
            self.may_be_seen(contributor, kind).map_err(|reason| {
                let narrowed_by = self.stated_audience(contributor, kind).narrowed_by;
                let recording = narrowed_by.unwrap_or(contributor);
                WithheldSource {
                    recording,
                    reason,
                    person: self.stated_audience(recording, kind).refused_by,
                }
            })?;
            match licence {
                Some(licence) => {
                    terms.insert(licence.to_owned());
                }
                // A sign made from others has their terms.
                None if from_others => {}
                None if !self.personal.contains(&contributor) => {
                    terms.extend(self.entry_publish_terms(None).map_err(withheld)?);
                }
                None => return Err(withheld(WithheldReason::NoTerms)),
            }
            // The recording itself may be passed on unchanged, so its own terms do not forbid that.
            if contributor != recording && licence.is_some_and(forbids_derivatives) {
                return Err(withheld(WithheldReason::NoDerivatives));
            }
            // Whoever annotated a file that shows a sign wrote something of their own.
            let signs = self.shown_signs.get(&contributor).into_iter().flatten();
            let signs = signs.filter(|_| contributor != recording || asked != ConsentKind::Annotation);
            waiting.extend(
                signs
                    .map(|sign| (*sign, ConsentKind::Derived))
                    .filter(|next| seen.insert(*next)),
            );
            for &input in inputs.into_iter().flatten() {
                // What annotators wrote is taken over, and so is movement that stays as it is.
                let is_shown = match asked {
                    ConsentKind::Movement => kept_sources.is_some_and(|sources| sources.contains(&input)),
                    ConsentKind::Annotation => true,
                    ConsentKind::Derived => false,
                };
                let shown = is_shown.then_some((input, asked));
                waiting.extend(
                    [(input, ConsentKind::Derived)]
                        .into_iter()
                        .chain(shown)
                        // Recipes of recipes could otherwise lead in circles.
                        .filter(|next| seen.insert(*next)),
                );
            }
        }
        Ok(terms)
    }

    /// Fails unless all whom a recording shows agreed that the audience sees it.
    fn may_be_seen(&self, recording: i64, kind: ConsentKind) -> std::result::Result<(), WithheldReason> {
        let stated = self.stated_audience(recording, kind);
        match stated.least {
            // A refusal is stronger than a missing statement, and is named first.
            Some(least) if least < self.audience => Err(WithheldReason::NotPublic),
            _ if stated.is_incomplete => Err(WithheldReason::ConsentUnknown),
            _ if stated.is_doubted => Err(WithheldReason::Undecided),
            _ => Ok(()),
        }
    }

    /// Returns the terms of a recording as a reader of an export finds them: those of all who contributed, or that it
    /// may not be shared, or only for research. What nobody stated stays not stated.
    pub(crate) fn recording_terms_text(&self, recording: i64) -> String {
        let sources = self.source_recordings(recording);
        let mut licences = BTreeSet::new();
        let mut widest = ConsentAudience::Public;
        let mut is_stated = true;
        for contributor in sources.iter().copied().chain([recording]) {
            let from_others = self.inputs.get(&contributor);
            let is_unknown = matches!(from_others, Some(None));
            let from_others = from_others.is_some_and(|inputs| inputs.as_ref().is_none_or(|list| !list.is_empty()));
            let licence = self.recordings.get(&contributor).and_then(stated_licence);
            // A recording made from others needs no terms of its own, since it has theirs.
            is_stated &= !is_unknown && (licence.is_some() || from_others);
            licences.extend(licence);
            let is_source = contributor != recording;
            let is_kept = (self.kept_sources.get(&recording)).is_some_and(|kept| kept.contains(&contributor));
            let kinds: &[ConsentKind] = match (is_source, is_kept) {
                (false, _) if from_others => &ConsentKind::ALL_CONSENT_KINDS,
                (false, _) => &[ConsentKind::Movement, ConsentKind::Annotation],
                (true, true) => &ConsentKind::ALL_CONSENT_KINDS,
                (true, false) => &[ConsentKind::Annotation, ConsentKind::Derived],
            };
            for kind in kinds {
                let stated = self.stated_audience(contributor, *kind);
                let applies = !from_others || *kind == ConsentKind::Derived;
                let least = if applies { stated.least } else { stated.own };
                widest = widest.min(least.unwrap_or(ConsentAudience::Public));
            }
            if is_source && licence.is_some_and(forbids_derivatives) {
                // A changed copy of what may not be changed must not be passed on at all.
                widest = ConsentAudience::Nobody;
            }
        }
        let licences = licences.into_iter().collect::<Vec<_>>().join("; ");
        match widest {
            ConsentAudience::Nobody => "may not be shared".to_owned(),
            _ if !is_stated => TERMS_NOT_STATED.to_owned(),
            ConsentAudience::Research => format!("for research only; {licences}"),
            ConsentAudience::Public => licences,
        }
    }

    /// Returns the name of a recording.
    pub(super) fn recording_name(&self, recording: i64) -> String {
        let row = self.recordings.get(&recording);
        row.map(|row| row.name.clone()).unwrap_or_default()
    }

    /// Returns the name of the person because of whom something is withheld; that of the recording if nobody is named.
    pub(super) fn withheld_because_of(&self, withheld: &WithheldSource) -> String {
        let person = withheld.person.and_then(|person| self.people.get(&person));
        let row = self.recordings.get(&withheld.recording);
        let name = person.or_else(|| row.map(|row| row.signer.as_ref().unwrap_or(&row.name)));
        name.cloned().unwrap_or_default()
    }

    /// Returns all recordings.
    pub(crate) fn all_recordings(&self) -> BTreeSet<i64> {
        self.recordings.keys().copied().collect()
    }

    /// Returns the signer of a recording, or the number of the recording if nobody is named.
    pub(crate) fn recording_person_key(&self, recording: i64) -> Option<(bool, i64)> {
        let row = self.recordings.get(&recording)?;
        match row.signer_id {
            Some(signer) => Some((true, signer)),
            None => self.personal.contains(&recording).then_some((false, recording)),
        }
    }
}

/// Returns the terms that a recording states itself.
fn stated_licence(row: &RecordingRow) -> Option<&str> {
    let licence = row.licence.as_deref().map(str::trim);
    licence.filter(|text| !text.is_empty())
}

/// Returns what a recording and its people state. A recording's own statement stands for people who state nothing.
pub(super) fn state_audience(
    own_consent: Option<&PersonConsent>,
    people: &[Option<&PersonConsent>],
    shows: bool,
    kind: ConsentKind,
) -> StatedAudience {
    let own = own_consent.and_then(|consent| consent.audience_of_kind(kind));
    let each = people
        .iter()
        .map(|person| person.and_then(|consent| consent.audience_of_kind(kind)));
    // The recording's own statement covers those who stated nothing themselves.
    let is_incomplete = shows && own.is_none() && (people.is_empty() || each.clone().any(|one| one.is_none()));
    StatedAudience {
        least: each.flatten().chain(own).min(),
        own,
        is_incomplete,
        is_doubted: false,
        narrowed_by: None,
        refused_by: None,
    }
}

/// Returns the consents that may not stand: another copy of the corpus allows less, and nobody has decided.
fn doubts(connection: &Connection) -> CorpusResult<BTreeSet<(&'static str, i64, ConsentKind)>> {
    let mut doubts = BTreeSet::new();
    for dispute in merge::undecided_disputes(connection)? {
        let differs = |column: &str| dispute.mine.get(column) != dispute.theirs.get(column);
        let other_text = dispute.theirs.get("consent").and_then(|value| value.as_str());
        // A consent that cannot be read allows nothing.
        let other = PersonConsent::parse_consent_json(other_text, dispute.table).unwrap_or_default();
        for kind in ConsentKind::ALL_CONSENT_KINDS {
            let is_whole = match dispute.table {
                // The other copy deleted the row, perhaps because it should not be shown at all.
                _ if dispute.theirs.is_empty() => true,
                "signer" => false,
                "tier" => differs("participant"),
                _ => ["signer_id", "origin", "licence"].into_iter().any(differs),
            };
            // Whatever falls short of public is a doubt, since the audience is not known here.
            let less = differs("consent") && other.audience_of_kind(kind) != Some(ConsentAudience::Public);
            match dispute.table {
                "signer" if is_whole || less => drop(doubts.insert(("signer", dispute.id, kind))),
                "recording" if is_whole || less => {
                    doubts.insert(("recording", dispute.id, kind));
                }
                "tier" if is_whole => doubts.extend(dispute.recording.map(|recording| ("recording", recording, kind))),
                _ => {}
            }
        }
    }
    Ok(doubts)
}

/// Reports whether terms of use forbid that something is made from it, as the ND licences of Creative Commons do.
pub(super) fn forbids_derivatives(licence: &str) -> bool {
    let licence = licence.to_lowercase();
    // The letters also occur within words, so they count only as a word of their own.
    let words = licence.split(|letter: char| !letter.is_alphanumeric());
    let nd = words.clone().any(|word| word == "nd");
    nd || licence.contains("noderiv") || licence.contains("no deriv")
}

/// Returns the remedy for something that was withheld.
pub(crate) fn withheld_remedy(reason: WithheldReason) -> ErrorRemedy {
    match reason {
        WithheldReason::ConsentUnknown => ErrorRemedy::choice_remedy(
            RemedyChoice::Consent,
            "state what the signers agreed to: `chereme consent CORPUS signer:NAME --all public`",
        ),
        WithheldReason::NotPublic => "the signers did not agree that everybody sees it".into(),
        WithheldReason::NoTerms => ErrorRemedy::command_remedy(
            "state the terms of recordings with `chereme consent CORPUS signer:NAME --licence TERMS`, those of entries that show nobody with --terms TERMS",
        ),
        WithheldReason::NoDerivatives => "a recording that they were made from may not be changed".into(),
        WithheldReason::Undecided => ErrorRemedy::command_remedy(
            "two copies of the corpus disagree about it: `chereme conflicts CORPUS` lists what is to be decided",
        ),
        WithheldReason::InputGone => "a recording that they were made from is not known, or was deleted".into(),
    }
}
