//! Tokens of a recording, derived from its tiers after every change to them.

use std::collections::BTreeMap;

use chereme_motion::{Instant, Span};
use chereme_sign::tier::Hands;
use chereme_sign::token::{ComponentSpan, owner, readings};
use chereme_sign::{Component, Field, HandRef, Handedness, Reading, TierRole};
use rusqlite::Connection;

use crate::db::recordings::{self, RecordingRow, SignerRow};
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::Result;
use crate::inventories::StoredInventory;
use crate::progress::{Progress, Step, Unit, unheard};

/// Updates the tokens of a recording from its tiers; tokens that remain keep their rows.
///
/// Each annotation with a value on a gloss tier is a token. Its values are those of the component tiers during it,
/// except the phases of movement: preparation, stroke and retraction divide time. With `window` only the tokens near
/// that time are derived, which suffices after a change within it. Values are converted to the ids of the tiers'
/// inventories.
pub(crate) fn derive(
    connection: &Connection,
    recording: i64,
    window: Option<Span>,
    inventories: &[StoredInventory],
) -> Result<()> {
    let mut hear = unheard;
    let progress = &mut Progress::new(&mut hear);
    derive_with_progress(connection, recording, window, inventories, progress)
}

/// Derives tokens as [`derive()`] does, and can be stopped.
pub(crate) fn derive_with_progress(
    connection: &Connection,
    recording: i64,
    window: Option<Span>,
    inventories: &[StoredInventory],
    progress: &mut Progress<'_>,
) -> Result<()> {
    let recording = recordings::recording(connection, recording)?;
    let by_time = AnnotationsByTime::read(connection, &recording, window, inventories, progress)?;
    let tokens = match by_time.within {
        Some(within) => {
            let (start, end) = (within.start().micros(), within.end().micros());
            signs::tokens_near(connection, recording.id, start, end)?
        }
        None => signs::tokens_of_recording(connection, recording.id)?,
    };
    let mut standing: BTreeMap<i64, TokenRow> = tokens
        .into_iter()
        .filter_map(|token| Some((token.annotation_id?, token)))
        .collect();
    let glosses = by_time
        .glosses
        .iter()
        .filter(|gloss| by_time.is_within(gloss));
    for (done, gloss) in glosses.enumerate() {
        step(progress, done)?;
        let old = standing.remove(&gloss.row.id);
        let token = write_token(connection, &recording, gloss, old)?;
        signs::set_values(connection, token, &by_time.values(gloss))?;
    }
    for token in standing.into_values() {
        signs::delete_token(connection, token.id)?;
        signs::delete_empty_sign(connection, token.sign_id)?;
    }
    Ok(())
}

/// Reports every 256th step.
fn step(progress: &mut Progress<'_>, done: usize) -> Result<()> {
    if done % 256 != 255 {
        return Ok(());
    }
    progress.report(Step {
        task: "tokens",
        done: done as u64,
        total: None,
        unit: Unit::Items,
    })
}

fn write_token(
    connection: &Connection,
    recording: &RecordingRow,
    gloss: &Gloss,
    old: Option<TokenRow>,
) -> Result<i64> {
    let sign_id = signs::sign_glossed(connection, gloss.row.value.trim())?;
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

struct Gloss {
    row: AnnotationRow,
    hand: Option<Hands>,
    participant: Option<String>,
}

/// The annotations on the tiers of a recording, by time.
struct AnnotationsByTime {
    handedness: Handedness,
    /// The handedness of participants of tiers who are signers.
    of_participants: BTreeMap<String, Handedness>,
    glosses: Vec<Gloss>,
    components: Vec<Coded>,
    /// The components of each gloss, by the row of its annotation.
    owned: BTreeMap<i64, Vec<usize>>,
    /// If given, only the glosses that touch this span are derived; the others only take part in the assignment of
    /// components.
    within: Option<Span>,
}

struct Coded {
    span: ComponentSpan,
    annotation: i64,
    inventory: Option<i64>,
    participant: Option<String>,
}

impl AnnotationsByTime {
    fn read(
        connection: &Connection,
        recording: &RecordingRow,
        window: Option<Span>,
        inventories: &[StoredInventory],
        progress: &mut Progress<'_>,
    ) -> Result<Self> {
        let all = tiers::tiers(connection, recording.id)?;
        let is_coding = |tier: &&TierRow| !tier.is_of_phases();
        let of_glosses = || all.iter().filter(|it| it.role == TierRole::Gloss);
        let of_components = || {
            let coded = |it: &&TierRow| it.role.component().is_some();
            all.iter().filter(coded).filter(is_coding)
        };
        let mut by_time = Self {
            handedness: handedness(connection, recording)?,
            of_participants: of_participants(connection, &all)?,
            glosses: Vec::new(),
            components: Vec::new(),
            owned: BTreeMap::new(),
            within: None,
        };
        if let Some(window) = window {
            let mut within = window;
            for tier in of_components() {
                for row in annotations(connection, tier, Some(window))? {
                    within = hull(within, span(&row));
                }
            }
            by_time.within = Some(within);
        }
        by_time.glosses = glosses(connection, of_glosses(), by_time.within)?;
        let Some(reach) = by_time.glosses.iter().map(|it| span(&it.row)).reduce(hull) else {
            return Ok(by_time);
        };
        let mut context = reach;
        for tier in of_components() {
            let inventory = inventories
                .iter()
                .find(|it| Some(it.id) == tier.inventory_id);
            let rows = annotations(connection, tier, by_time.within.and(Some(reach)))?;
            for (done, row) in rows.into_iter().enumerate() {
                step(progress, done)?;
                context = hull(context, span(&row));
                by_time.add_component(tier, &row, inventory);
            }
        }
        if by_time.within.is_some() {
            by_time.glosses = glosses(connection, of_glosses(), Some(context))?;
        }
        by_time
            .components
            .sort_by_key(|coded| (coded.span.span.start(), coded.annotation));
        by_time.give(progress)?;
        Ok(by_time)
    }

    fn is_within(&self, gloss: &Gloss) -> bool {
        self.within
            .is_none_or(|within| touches(span(&gloss.row), within))
    }

    fn add_component(
        &mut self,
        tier: &TierRow,
        row: &AnnotationRow,
        inventory: Option<&StoredInventory>,
    ) {
        let Some((component, feature)) = tier.role.component() else {
            return;
        };
        let reading = match row.reading() {
            Reading::Value(value) => {
                let known = inventory.and_then(|it| it.inventory.find(value.trim()));
                Reading::from(known.map_or(value.trim(), |value| value.id.as_str()))
            }
            missing => missing,
        };
        if reading == Reading::Unset {
            return;
        }
        let hands: Vec<Option<HandRef>> = match tier.hand {
            Some(Hands::Both) => vec![Some(HandRef::Right), Some(HandRef::Left)],
            hand => vec![hand.and_then(Hands::one)],
        };
        for hand in hands {
            let field = Field {
                hand,
                component,
                feature: feature.map(str::to_owned),
                phase: None,
            };
            self.components.push(Coded {
                span: ComponentSpan {
                    field: resolved(field, self.handedness_of(tier.participant.as_deref())),
                    span: span(row),
                    reading: reading.clone(),
                },
                annotation: row.id,
                inventory: tier.inventory_id,
                participant: tier.participant.clone(),
            });
        }
    }

    fn handedness_of(&self, participant: Option<&str>) -> Handedness {
        let own = participant.and_then(|name| self.of_participants.get(name));
        own.copied().unwrap_or(self.handedness)
    }

    fn values(&self, gloss: &Gloss) -> Vec<TokenValueRow> {
        let own = span(&gloss.row);
        let hand = gloss.hand.and_then(Hands::one);
        let handedness = self.handedness_of(gloss.participant.as_deref());
        let hand = hand.map(|hand| HandRef::from(hand.resolve(handedness)));
        let owned: Vec<&Coded> = self
            .owned
            .get(&gloss.row.id)
            .into_iter()
            .flatten()
            .map(|at| &self.components[*at])
            .collect();
        let around: Vec<ComponentSpan> = owned.iter().map(|coded| coded.span.clone()).collect();
        readings(own, &[], hand, &around)
            .into_iter()
            .map(|(field, place)| row_of(&field, owned[place]))
            .collect()
    }

    /// Assigns each component to the gloss that it belongs to, among those for each hand of each participant;
    /// components of one participant never belong to a gloss of another.
    fn give(&mut self, progress: &mut Progress<'_>) -> Result<()> {
        type Whose<'g> = (Option<&'g str>, Option<&'static str>);
        let mut hands: BTreeMap<Whose<'_>, Vec<&Gloss>> = BTreeMap::new();
        for gloss in &self.glosses {
            let whose = (gloss.participant.as_deref(), gloss.hand.map(Hands::name));
            hands.entry(whose).or_default().push(gloss);
        }
        let mut owned: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
        for ((participant, _), glosses) in &hands {
            let spans: Vec<Span> = glosses.iter().map(|gloss| span(&gloss.row)).collect();
            let longest = spans.iter().map(|span| span.micros()).max().unwrap_or(0);
            for (at, coded) in self.components.iter().enumerate() {
                step(progress, at)?;
                let other = coded.participant.as_deref().zip(*participant);
                if other.is_some_and(|(one, other)| one != other) {
                    continue;
                }
                let own_span = coded.span.span;
                let from = own_span.start().shifted(-longest);
                let first = spans.partition_point(|span| span.start() < from);
                let last = spans.partition_point(|span| span.start() < own_span.end());
                let near = spans.get(first..last).unwrap_or_default();
                if let Some(place) = owner(own_span, near) {
                    let gloss = glosses[first + place].row.id;
                    owned.entry(gloss).or_default().push(at);
                }
            }
        }
        self.owned = owned;
        Ok(())
    }
}

fn row_of(field: &Field, source: &Coded) -> TokenValueRow {
    let reading = &source.span.reading;
    TokenValueRow {
        inventory_id: source.inventory,
        annotation_id: Some(source.annotation),
        ..TokenValueRow::of(field, reading)
    }
}

fn resolved(field: Field, handedness: Handedness) -> Field {
    if field.component == Component::NonManual {
        field
    } else {
        field.resolved(handedness)
    }
}

/// Returns the handedness of a recording's signer.
pub(crate) fn handedness(connection: &Connection, recording: &RecordingRow) -> Result<Handedness> {
    let signer = match recording.signer_id {
        Some(id) => recordings::signer(connection, id)?,
        None => None,
    };
    Ok(dominant(signer.as_ref()))
}

fn dominant(signer: Option<&SignerRow>) -> Handedness {
    match signer.and_then(|signer| signer.handedness.as_deref()) {
        Some("left") => Handedness::Left,
        _ => Handedness::Right,
    }
}

/// Returns the handedness of the participants of tiers who are signers of the corpus.
fn of_participants(
    connection: &Connection,
    tiers: &[TierRow],
) -> Result<BTreeMap<String, Handedness>> {
    let mut found = BTreeMap::new();
    for name in tiers.iter().filter_map(|tier| tier.participant.as_ref()) {
        if !found.contains_key(name)
            && let Some(signer) = recordings::find_signer(connection, name)?
        {
            found.insert(name.clone(), dominant(Some(&signer)));
        }
    }
    Ok(found)
}

fn annotations(
    connection: &Connection,
    tier: &TierRow,
    window: Option<Span>,
) -> Result<Vec<AnnotationRow>> {
    match window {
        None => tiers::annotations(connection, tier.id),
        Some(window) => {
            let (start, end) = (window.start().micros(), window.end().micros());
            tiers::annotations_near(connection, tier.id, start, end)
        }
    }
}

fn span(row: &AnnotationRow) -> Span {
    Span::between(
        Instant::from_micros(row.start_us),
        Instant::from_micros(row.end_us),
    )
}

/// Returns the glosses that touch `within`, by time.
fn glosses<'t>(
    connection: &Connection,
    tiers: impl Iterator<Item = &'t TierRow>,
    within: Option<Span>,
) -> Result<Vec<Gloss>> {
    let mut glosses = Vec::new();
    for tier in tiers {
        for row in annotations(connection, tier, within)? {
            if row.is_filled() {
                let hand = tier.hand;
                let participant = tier.participant.clone();
                glosses.push(Gloss {
                    row,
                    hand,
                    participant,
                });
            }
        }
    }
    glosses.sort_by_key(|gloss| (gloss.row.start_us, gloss.row.id));
    Ok(glosses)
}

fn hull(a: Span, b: Span) -> Span {
    Span::between(a.start().min(b.start()), a.end().max(b.end()))
}

fn touches(a: Span, b: Span) -> bool {
    a.start() <= b.end() && b.start() <= a.end()
}
