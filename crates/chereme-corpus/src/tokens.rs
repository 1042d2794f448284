//! Tokens of a recording, derived from its tiers after every change of them.

use std::collections::BTreeMap;

use chereme_motion::{Instant, Span};
use chereme_sign::token::{ComponentSpan, readings};
use chereme_sign::{Component, Field, HandRef, Handedness, Phase, Reading};
use rusqlite::Connection;

use crate::db::recordings::{self, RecordingRow};
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::Result;
use crate::inventories::StoredInventory;

/// Brings the tokens of a recording to what its tiers say; those that stay keep their rows.
///
/// Each annotation of a gloss tier with a value is a token. With `window` only the tokens near that
/// time are looked at: enough after a change inside it. Values become the ids that the tiers'
/// inventories have for them.
pub(crate) fn derive(
    connection: &Connection,
    recording: i64,
    window: Option<Span>,
    inventories: &[StoredInventory],
) -> Result<()> {
    let recording = recordings::recording(connection, recording)?;
    let said = Said::read(connection, &recording, window, inventories)?;
    let mut standing: BTreeMap<i64, TokenRow> = BTreeMap::new();
    for token in signs::tokens_of_recording(connection, recording.id)? {
        if let Some(annotation) = token.annotation_id
            && window.is_none_or(|window| touches(span_of(&token), window))
        {
            standing.insert(annotation, token);
        }
    }
    for gloss in &said.glosses {
        let old = standing.remove(&gloss.row.id);
        let token = write_token(connection, &recording, gloss, old)?;
        signs::set_values(connection, token, &said.values(gloss))?;
    }
    for token in standing.into_values() {
        signs::delete_token(connection, token.id)?;
        signs::delete_empty_sign(connection, token.sign_id)?;
    }
    Ok(())
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
        origin: recording.origin.clone(),
        ..TokenRow::default()
    });
    token.sign_id = sign_id;
    token.start_us = Some(gloss.row.start_us);
    token.end_us = Some(gloss.row.end_us);
    token.hand.clone_from(&gloss.hand);
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
            token.citation = !signs::tokens_of_sign(connection, sign_id)?
                .iter()
                .any(|token| token.citation && token.recording_id.is_some());
            signs::insert_token(connection, &token)
        }
    }
}

struct Gloss {
    row: AnnotationRow,
    hand: Option<String>,
}

/// What the tiers of a recording say, by time.
struct Said {
    handedness: Handedness,
    glosses: Vec<Gloss>,
    components: Vec<Coded>,
    longest: i64,
}

struct Coded {
    span: ComponentSpan,
    annotation: i64,
    inventory: Option<i64>,
}

impl Said {
    fn read(
        connection: &Connection,
        recording: &RecordingRow,
        window: Option<Span>,
        inventories: &[StoredInventory],
    ) -> Result<Self> {
        let handedness = handedness(connection, recording)?;
        let tiers = tiers::tiers(connection, recording.id)?;
        let mut said = Self {
            handedness,
            glosses: Vec::new(),
            components: Vec::new(),
            longest: 0,
        };
        for tier in tiers.iter().filter(|tier| tier.role == "gloss") {
            for row in annotations(connection, tier, window)? {
                if row.state == "value" && !row.value.trim().is_empty() {
                    said.glosses.push(Gloss {
                        row,
                        hand: tier.hand.clone(),
                    });
                }
            }
        }
        said.glosses
            .sort_by_key(|gloss| (gloss.row.start_us, gloss.row.id));
        let reach = said
            .glosses
            .iter()
            .map(|gloss| span(&gloss.row))
            .reduce(|a, b| Span::between(a.start().min(b.start()), a.end().max(b.end())));
        for tier in tiers.iter().filter(|tier| tier.role == "component") {
            let inventory = inventories
                .iter()
                .find(|it| Some(it.id) == tier.inventory_id);
            for row in annotations(connection, tier, window.and(reach))? {
                said.add_component(tier, &row, inventory);
            }
        }
        said.components
            .sort_by_key(|coded| (coded.span.span.start(), coded.annotation));
        said.longest = said
            .components
            .iter()
            .map(|coded| coded.span.span.micros())
            .max()
            .unwrap_or(0);
        Ok(said)
    }

    fn add_component(
        &mut self,
        tier: &TierRow,
        row: &AnnotationRow,
        inventory: Option<&StoredInventory>,
    ) {
        let Some(component) = tier.component.as_deref().and_then(|name| name.parse().ok()) else {
            return;
        };
        let reading = match row.state.as_str() {
            "value" => {
                let known = inventory.and_then(|it| it.inventory.find(row.value.trim()));
                Reading::from(known.map_or(row.value.trim(), |value| value.id.as_str()))
            }
            "not-applicable" => Reading::NotApplicable,
            "unclear" => Reading::Unclear,
            _ => Reading::Unset,
        };
        if reading == Reading::Unset {
            return;
        }
        let hands: Vec<Option<HandRef>> = match tier.hand.as_deref() {
            Some("both") => vec![Some(HandRef::Right), Some(HandRef::Left)],
            hand => vec![hand.and_then(|hand| hand.parse().ok())],
        };
        for hand in hands {
            let field = Field {
                hand,
                component,
                feature: tier.feature.clone(),
                phase: None,
            };
            self.components.push(Coded {
                span: ComponentSpan {
                    field: resolved(field, self.handedness),
                    span: span(row),
                    reading: reading.clone(),
                },
                annotation: row.id,
                inventory: tier.inventory_id,
            });
        }
    }

    fn values(&self, gloss: &Gloss) -> Vec<TokenValueRow> {
        let own = span(&gloss.row);
        let hand: Option<HandRef> = gloss.hand.as_deref().and_then(|hand| hand.parse().ok());
        let hand = hand.map(|hand| HandRef::from(hand.resolve(self.handedness)));
        let near = self.near(own);
        let around: Vec<ComponentSpan> = near.iter().map(|coded| coded.span.clone()).collect();
        let others = self.others(gloss, &around);
        readings(own, &others, hand, &around)
            .into_iter()
            .map(|(field, reading)| row_of(&field, &reading, near))
            .collect()
    }

    /// The component annotations that may share time with `own`.
    fn near(&self, own: Span) -> &[Coded] {
        let from = own.start().shifted(-self.longest);
        let first = self
            .components
            .partition_point(|coded| coded.span.span.start() < from);
        let last = self
            .components
            .partition_point(|coded| coded.span.span.start() < own.end());
        &self.components[first.min(last)..last]
    }

    /// The spans of the other glosses of the same hand that may share time with those annotations.
    fn others(&self, gloss: &Gloss, around: &[ComponentSpan]) -> Vec<Span> {
        let Some(reach) = around
            .iter()
            .map(|said| said.span)
            .reduce(|a, b| Span::between(a.start().min(b.start()), a.end().max(b.end())))
        else {
            return Vec::new();
        };
        let last = self
            .glosses
            .partition_point(|other| Instant::from_micros(other.row.start_us) < reach.end());
        self.glosses[..last]
            .iter()
            .rev()
            .take(64)
            .filter(|other| other.row.id != gloss.row.id && other.hand == gloss.hand)
            .map(|other| span(&other.row))
            .filter(|other| other.overlaps(reach))
            .collect()
    }
}

fn row_of(field: &Field, reading: &Reading, near: &[Coded]) -> TokenValueRow {
    let source = near.iter().find(|coded| {
        coded.span.reading == *reading
            && coded.span.field.component == field.component
            && coded.span.field.feature == field.feature
            && (coded.span.field.hand == field.hand || coded.span.field.hand.is_none())
    });
    let (phase, position) = match field.phase {
        None => (None, 0),
        Some(Phase::Initial) => (Some("initial"), 0),
        Some(Phase::Middle(place)) => (Some("middle"), i64::from(place)),
        Some(Phase::Final) => (Some("final"), 0),
    };
    TokenValueRow {
        hand: field.hand.map(|hand| hand.name().to_owned()),
        component: field.component.name().to_owned(),
        feature: field.feature.clone(),
        phase: phase.map(str::to_owned),
        position,
        state: state_name(reading).to_owned(),
        value: reading.value().map(str::to_owned),
        inventory_id: source.and_then(|coded| coded.inventory),
        annotation_id: source.map(|coded| coded.annotation),
    }
}

/// Returns the name under which a reading's kind is stored.
pub(crate) fn state_name(reading: &Reading) -> &'static str {
    match reading {
        Reading::Value(_) => "value",
        Reading::Unset => "unset",
        Reading::NotApplicable => "not-applicable",
        Reading::Unclear => "unclear",
    }
}

fn resolved(field: Field, handedness: Handedness) -> Field {
    if field.component == Component::NonManual {
        field
    } else {
        field.resolved(handedness)
    }
}

fn handedness(connection: &Connection, recording: &RecordingRow) -> Result<Handedness> {
    let signer = match recording.signer_id {
        Some(id) => recordings::signer(connection, id)?,
        None => None,
    };
    let left = signer.and_then(|signer| signer.handedness).as_deref() == Some("left");
    Ok(if left {
        Handedness::Left
    } else {
        Handedness::Right
    })
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

fn span_of(token: &TokenRow) -> Span {
    let at = |micros: Option<i64>| Instant::from_micros(micros.unwrap_or_default());
    Span::between(at(token.start_us), at(token.end_us))
}

fn touches(a: Span, b: Span) -> bool {
    a.start() <= b.end() && b.start() <= a.end()
}
