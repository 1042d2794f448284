//! Codings that are proposed from movement, for a component that nobody has coded yet.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::roles::Hands;
use chereme_formats::table::annotations::Moment;
use chereme_motion::Instant;
use chereme_sign::hamnosys::Notated;
use chereme_sign::hamnosys::components::Mapper;
use chereme_sign::{Component, HandRef, Phase, TierRole};
use serde::Serialize;

use crate::Corpus;
use crate::address::{Address, Name};
use crate::annotate::{AnnotateOptions, AnnotationAction, AnnotationChange, NewTier, TierName};
use crate::db::columns::AnnotationOrigin;
use crate::db::tiers;
use crate::error::{Error, Result};
use crate::progress::{Progress, Step, Unit};
use crate::search::{Hit, SearchOptions};

/// What was proposed.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Proposed {
    /// How many tokens got values.
    pub tokens: u64,
    /// How many annotations that are.
    pub annotations: u64,
    /// How many tokens without the component could not be read: they have no movement, or none that is understood.
    pub unread: u64,
    /// The recordings, in order.
    pub recordings: Vec<String>,
}

impl Proposed {
    /// The components that are read from movement.
    pub const COMPONENTS: [Component; 3] = [
        Component::Configuration,
        Component::Placement,
        Component::Movement,
    ];
}

/// A value of a token that is to be written.
struct Value {
    start: i64,
    end: i64,
    value: String,
}

/// The values that go onto each tier: by the recording, and the hand.
type Values = BTreeMap<(String, HandRef), Vec<Value>>;

impl Corpus {
    /// Reads a component of every token from its movement that has no value for it, and writes that onto tiers of
    /// their own, called for example `configuration dominant (proposed)`.
    ///
    /// Each value is an annotation of a detector, as those of [`AnnotationOrigin::Detector`], so that a person's
    /// codings stay apart from it and another detector may replace it; all of it is one operation, which one step back
    /// takes away. The values are those of
    /// [`transcribe`](Self::transcribe) in the words of the corpus's inventories.
    ///
    /// # Errors
    /// [`Error::Stopped`] where `progress` says so before anything is written; where movement does not say the
    /// component, or the corpus cannot be written.
    pub fn propose_coding(
        &mut self,
        component: Component,
        progress: &mut Progress<'_>,
    ) -> Result<Proposed> {
        if !Proposed::COMPONENTS.contains(&component) {
            let text = format!("{} is not read from movement yet", component.name());
            let readable = Proposed::COMPONENTS.map(Component::name).join(", ");
            return Err(Error::wrong(text).advise(format!("what can be proposed: {readable}")));
        }
        let options = SearchOptions {
            limit: None,
            facets: false,
            ..SearchOptions::default()
        };
        let query = format!("not {}=*", component.name());
        let found = self.search_until(&query, &options, progress)?;
        let mut report = Proposed::default();
        let mut values = Values::new();
        let total = Some(found.hits.len() as u64);
        for (done, hit) in found.hits.iter().enumerate() {
            progress.tell(Step {
                task: &hit.gloss,
                done: done as u64,
                total,
                unit: Unit::Items,
            })?;
            match self.read(component, hit, progress) {
                Ok(Some(read)) => {
                    report.tokens += 1;
                    let recording = hit.recording.clone().unwrap_or_default();
                    for (hand, value) in read {
                        let key = (recording.clone(), hand);
                        values.entry(key).or_default().push(value);
                    }
                }
                Err(Error::Stopped) => return Err(Error::Stopped),
                Ok(None) | Err(_) => report.unread += 1,
            }
        }
        let (new, changes) = self.changes(component, values)?;
        report.annotations = changes.len() as u64;
        let recordings: BTreeSet<&str> = found
            .hits
            .iter()
            .filter_map(|hit| hit.recording.as_deref())
            .collect();
        if !changes.is_empty() {
            let options = AnnotateOptions {
                origin: AnnotationOrigin::Detector,
                ..AnnotateOptions::default()
            };
            let work = (changes.as_slice(), &options);
            let written = self.annotate_with("propose", &new, work, progress)?;
            let is_written = |name: &&str| written.recordings.iter().any(|it| it == name);
            let written = recordings.into_iter().filter(is_written);
            report.recordings = written.map(str::to_owned).collect();
        }
        Ok(report)
    }

    /// Returns what a token's movement says of a component, for each hand in the order of time.
    fn read(
        &self,
        component: Component,
        hit: &Hit,
        progress: &mut Progress<'_>,
    ) -> Result<Option<Vec<(HandRef, Value)>>> {
        let Some((start, end)) = hit.start_us.zip(hit.end_us) else {
            return Ok(None);
        };
        if hit.recording.is_none() {
            return Ok(None);
        }
        let written = self.transcribe(&Address::Token(hit.token), progress)?;
        let inventories = self.inventories_now()?;
        let mapper = Mapper::new(inventories.iter().map(|stored| &stored.inventory));
        let sign = Notated {
            gloss: written.gloss,
            text: Some(written.hamnosys),
            sign: written.sign,
            ..Notated::default()
        };
        let mut hands: BTreeMap<HandRef, Vec<(u32, String)>> = BTreeMap::new();
        for value in mapper.map(&sign).values {
            if value.field.component != component || value.field.feature.is_some() {
                continue;
            }
            let order = match value.field.phase {
                None | Some(Phase::Initial) => 0,
                Some(Phase::Middle(place)) => 1 + u32::from(place),
                Some(Phase::Final) => u32::MAX,
            };
            let hand = value.field.hand.unwrap_or(HandRef::Dominant);
            hands.entry(hand).or_default().push((order, value.value));
        }
        let mut read = Vec::new();
        for (hand, mut values) in hands {
            values.sort_by_key(|(order, _)| *order);
            values.dedup_by(|a, b| a.1 == b.1);
            let count = values.len() as i64;
            let at = |part: i64| start + (end - start) * part / count;
            for (nth, (_, value)) in (0..).zip(values) {
                let (start, end) = (at(nth), at(nth + 1));
                read.push((hand, Value { start, end, value }));
            }
        }
        Ok(Some(read).filter(|read| !read.is_empty()))
    }

    /// Returns the annotations to add, and the tiers for them that a recording lacks.
    fn changes(
        &self,
        component: Component,
        all: Values,
    ) -> Result<(Vec<NewTier>, Vec<AnnotationChange>)> {
        let (mut tiers, mut changes) = (Vec::new(), Vec::new());
        for ((recording, hand), mut values) in all {
            let recording = Name::Text(recording);
            let name = format!("{} {} (proposed)", component.name(), hand.name());
            let tier = TierName::Of {
                recording: recording.clone(),
                tier: name.clone(),
            };
            let mut end = self.tier_end(&recording, &name)?;
            if end.is_none() {
                let role = TierRole::Component {
                    component,
                    feature: None,
                };
                let mut new = NewTier::new(recording, name, role);
                new.hand = Some(Hands::One(hand));
                tiers.push(new);
            }
            values.sort_by_key(|value| value.start);
            for value in values {
                // Signs of two hands may lie over each other; annotations of one tier may not.
                let start = value.start.max(end.unwrap_or(i64::MIN));
                if start >= value.end {
                    continue;
                }
                end = Some(value.end);
                let time = |micros| Some(Moment::Time(Instant::from_micros(micros)));
                changes.push(
                    AnnotationAction::Add {
                        tier: tier.clone(),
                        start: time(start),
                        end: time(value.end),
                        parent: None,
                        order: None,
                        value: value.value,
                        confidence: None,
                    }
                    .into(),
                );
            }
        }
        Ok((tiers, changes))
    }

    /// Returns where the last annotation of a recording's tier ends, 0 where it holds none; nothing where there is no
    /// such tier.
    fn tier_end(&self, recording: &Name, tier: &str) -> Result<Option<i64>> {
        let connection = self.store.read();
        let recording = crate::address::recording(connection, recording)?;
        let all = tiers::tiers(connection, recording.id)?;
        let Some(tier) = all.into_iter().find(|it| it.name == tier) else {
            return Ok(None);
        };
        let rows = tiers::annotations(connection, tier.id)?;
        Ok(Some(rows.iter().map(|row| row.end_us).max().unwrap_or(0)))
    }
}
