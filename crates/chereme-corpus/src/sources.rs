//! Answers to the questions that recipes ask about the corpus, read from the rows.

use std::cell::RefCell;
use std::sync::Arc;

use chereme_compose::{
    BodyInput, CuePhases, Example, ExpressionSource, HeldValue, Language, LearnedProfile, Letter,
    Material, SourceError, Sources, SpellingTimes, Value,
};
use chereme_motion::{Instant, Side, Span};
use chereme_sign::Inventory;
use chereme_sign::hamnosys::Notated;
use chereme_sign::milestones::Function;
use chereme_sign::text::nearest;
use chereme_sign::tier::Hands;
use chereme_sign::{Component, Handedness, Reading};
use rusqlite::Connection;
use sha2::{Digest, Sha256};

use crate::Store;
use crate::address::{self, Address, Name, Stretch};
use crate::curves;
use crate::db::columns::Origin;
use crate::db::history;
use crate::db::motion;
use crate::db::recordings::{self, RecordingRow};
use crate::db::signs;
use crate::db::tiers;
use crate::error::{Error, Result};
use crate::face;
use crate::inventories::StoredInventory;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::search::index::SearchIndex;
use learned::language::Samples;

pub(crate) mod floor;
mod language;
mod learned;
pub(crate) mod notation;

/// What recipes want by a name, in messages.
const WANTED_BODY: &str = "a body is written signer:NAME or recording:NAME";
const WANTED_MOVEMENT: &str = "the movement of a sign or a recording is wanted";
const WANTED_NOTATION: &str = "notation is wanted";
const WANTED_SKELETON: &str = "the movement of a skeleton is wanted";

/// The longest stretch that a recipe accepts as a source, in microseconds.
const LONGEST: i64 = 600_000_000;

/// The corpus from the point of view of recipes.
pub(crate) struct CorpusSources<'a> {
    pub(crate) connection: &'a Connection,
    pub(crate) index: &'a SearchIndex,
    pub(crate) inventories: &'a [StoredInventory],
    pub(crate) learned: &'a RefCell<Learned>,
}

/// Cache of the numbers learned from a corpus, valid until something in it changes.
#[derive(Default)]
pub(crate) struct Learned {
    /// The newest operation when the profile was learned, and the profile.
    profile: Option<(Option<i64>, Option<LearnedProfile>)>,
    /// The newest operation when body language was measured, and the samples.
    samples: Option<(Option<i64>, Samples)>,
}

impl<'a> CorpusSources<'a> {
    /// Opens a corpus for recipes, with its search index brought up to date.
    pub(crate) fn open(
        store: &'a mut Store,
        inventories: &'a [StoredInventory],
        learned: &'a RefCell<Learned>,
    ) -> Result<Self> {
        let (connection, index) = store.searchable()?;
        Ok(Self {
            connection,
            index,
            inventories,
            learned,
        })
    }

    fn stretch(&self, text: &str) -> Result<Stretch> {
        address::stretch(self.connection, &text.parse()?)
    }

    fn load(&self, stretch: &Stretch) -> Result<Material> {
        if stretch.span.micros() > LONGEST {
            let seconds = stretch.span.seconds();
            return Err(Error::wrong(format!(
                "{:?} is {:.0} min long, and a recipe takes {} min at most; annotate the part on a gloss tier and name \
                 its token",
                stretch.recording.name,
                seconds / 60.0,
                LONGEST / 60_000_000
            ))
            .advise("annotate the part on a gloss tier and name its token"));
        }
        if recordings::body_track(self.connection, stretch.recording.id)?.is_none()
            && let Some(mut material) = face::stage::material(self.connection, stretch)?
        {
            material.held = self.held(stretch, material.handedness)?;
            return Ok(material);
        }
        let track = MotionTrack::of(self.connection, stretch.recording.id)?;
        let mut material = movement(self.connection, &track, stretch)?;
        material.held = self.held(stretch, material.handedness)?;
        material.curves = curves::of_track(self.connection, &track, track.frames_in(stretch.span))?;
        Ok(material)
    }

    /// Returns the values on the component tiers over a stretch, with times counted from its first frame.
    fn held(&self, stretch: &Stretch, handedness: Handedness) -> Result<Vec<HeldValue>> {
        let mut held = Vec::new();
        let (start, end) = (stretch.span.start().micros(), stretch.span.end().micros());
        for tier in tiers::tiers(self.connection, stretch.recording.id)? {
            let Some((component, feature)) = tier.role.component() else {
                continue;
            };
            let inventory = self
                .inventories
                .iter()
                .find(|it| Some(it.id) == tier.inventory_id);
            for row in tiers::annotations_near(self.connection, tier.id, start, end)? {
                let own = Span::between(
                    Instant::from_micros(row.start_us),
                    Instant::from_micros(row.end_us),
                );
                let Some(span) = own.intersection(stretch.span) else {
                    continue;
                };
                if !row.is_filled() {
                    continue;
                }
                let known = inventory.and_then(|it| it.inventory.find(row.value.trim()));
                let value = known.map_or(row.value.trim(), |value| value.id.as_str());
                for hand in sides(tier.hand, handedness) {
                    held.push(HeldValue {
                        hand,
                        component,
                        feature: feature.map(str::to_owned),
                        value: Reading::from(value),
                        span: span.shifted(-start),
                    });
                }
            }
        }
        Ok(held)
    }

    /// Returns the error for a name that belongs to something else than a recipe wants; `None` if nothing has it.
    fn other_kind(&self, address: &str, wanted: &'static str) -> Option<SourceError> {
        let text = |name: &Name| match name {
            Name::Text(text) if text.parse::<i64>().is_err() => text.clone(),
            Name::Text(text) => format!("{text:?}"),
            Name::Number(number) => number.to_string(),
        };
        let signer = |name: &Name| {
            address::signer(self.connection, name).ok()?;
            Some(("a signer", format!("signer:{}", text(name))))
        };
        let recording = |name: &Name| {
            address::recording(self.connection, name).ok()?;
            Some(("a recording", format!("recording:{}", text(name))))
        };
        let (kind, named) = match address.parse().ok()? {
            Address::Signer(name) => signer(&name)?,
            Address::Recording(name) => recording(&name)?,
            Address::Gloss(name) => {
                let name = Name::Text(name);
                signer(&name).or_else(|| recording(&name)).or_else(|| {
                    let sign = self.has(address).then(|| address.to_owned());
                    sign.map(|sign| ("a sign", sign))
                })?
            }
            sign => ("a sign", self.has(address).then(|| sign.to_string())?),
        };
        Some(SourceError::OtherKind {
            address: address.into(),
            kind,
            wanted,
            right: Some(named.into()).filter(|_| wanted == WANTED_BODY && kind != "a sign"),
        })
    }

    /// Returns the error for the body of something that is neither a signer nor a recording with movement.
    fn no_signer(&self, address: Option<&str>) -> SourceError {
        if let Some(error) = address.and_then(|address| self.other_kind(address, WANTED_BODY)) {
            return error;
        }
        let signers = recordings::signers(self.connection).unwrap_or_default();
        let known = signers
            .into_iter()
            .map(|it| Address::Signer(Name::Text(it.name)).to_string());
        let (address, known) = (address.unwrap_or_default(), known.collect::<Vec<_>>());
        SourceError::Missing {
            address: address.to_owned(),
            nearest: nearest(address, known.iter().map(String::as_str)).map(str::to_owned),
        }
    }

    fn all(&self) -> impl Iterator<Item = &Inventory> {
        self.inventories.iter().map(|stored| &stored.inventory)
    }

    fn example(
        &self,
        token: i64,
        hand: Option<Side>,
        span: Option<Span>,
    ) -> Result<Option<Example>> {
        let token = signs::token(self.connection, token)?;
        let (Some(recording), Some(start)) = (token.recording_id, token.start_us) else {
            return Ok(None);
        };
        if recordings::body_track(self.connection, recording)?.is_none() {
            return Ok(None);
        }
        let signer = recordings::recording(self.connection, recording)?.signer;
        Ok(Some(Example {
            address: format!("token:{}", token.id),
            signer: signer.map(|name| Address::Signer(Name::Text(name)).to_string()),
            hand,
            span: span.map(|span| span.shifted(-start)),
        }))
    }
}

/// Returns the body of a recording in its first frame.
pub(crate) fn standing(connection: &Connection, recording: RecordingRow) -> Result<Material> {
    let track = MotionTrack::of(connection, recording.id)?;
    let stretch = Stretch {
        span: track.rate.span(0..1),
        recording,
        token: None,
    };
    movement(connection, &track, &stretch)
}

/// Returns the movement of a stretch, without its annotations.
fn movement(connection: &Connection, track: &MotionTrack, stretch: &Stretch) -> Result<Material> {
    let frames = track.frames_in(stretch.span);
    let clip = track.clip(connection, frames.clone(), &ChannelGroup::ALL)?;
    let name = format!(
        "{} {:?} {:?}",
        motion::content_hash(connection, track.row.id)?,
        frames,
        track.row
    );
    let signer = match stretch.recording.signer_id {
        Some(id) => recordings::signer(connection, id)?,
        None => None,
    };
    let left = signer
        .as_ref()
        .is_some_and(|it| it.handedness.as_deref() == Some("left"));
    let handedness = if left {
        Handedness::Left
    } else {
        Handedness::Right
    };
    let (address, gloss) = match &stretch.token {
        Some(token) => (format!("token:{}", token.id), token.gloss.clone()),
        None => (
            format!("recording:{}", stretch.recording.id),
            stretch.recording.name.clone(),
        ),
    };
    Ok(Material {
        address,
        hash: motion::hex(&Sha256::digest(name.as_bytes())),
        gloss,
        signer: signer.map(|it| Address::Signer(Name::Text(it.name)).to_string()),
        handedness,
        clip,
        anatomy: Arc::new(track.anatomy(connection)?),
        held: Vec::new(),
        curves: Vec::new(),
    })
}

impl Sources for CorpusSources<'_> {
    fn material(&self, address: &str) -> std::result::Result<Material, SourceError> {
        if address == notation::OWN_BODY {
            return notation::own_body().map_err(|error| unreadable(&error));
        }
        match self.stretch(address) {
            Ok(stretch) => match self.load(&stretch) {
                Err(error) if error.is_lack() => Err(SourceError::OtherKind {
                    address: address.into(),
                    kind: "in a recording without a skeleton",
                    wanted: WANTED_SKELETON,
                    right: None,
                }),
                loaded => loaded.map_err(|error| unreadable(&error)),
            },
            Err(error) => self
                .animated(address)?
                .ok_or_else(|| missing(self, address, WANTED_MOVEMENT, &error)),
        }
    }

    fn performer(&self, address: &str) -> std::result::Result<Option<BodyInput>, SourceError> {
        if self.stretch(address).is_ok() || self.notation_of(address).is_err() {
            return Ok(None);
        }
        let body = self.stage(None)?;
        Ok(Some(BodyInput {
            address: body.address,
            hash: body.hash,
        }))
    }

    fn notation(&self, name: &str) -> std::result::Result<Vec<Notated>, SourceError> {
        self.notated(name)
    }

    fn stage(&self, signer: Option<&str>) -> std::result::Result<Material, SourceError> {
        let wanted = match signer.map(str::parse) {
            _ if signer == Some(notation::OWN_BODY) => {
                return notation::own_body().map_err(|error| unreadable(&error));
            }
            Some(Ok(Address::Recording(name))) => {
                let recording = address::recording(self.connection, &name).map_err(|error| {
                    missing(self, signer.unwrap_or_default(), WANTED_BODY, &error)
                })?;
                return standing(self.connection, recording)
                    .and_then(floor::grounded)
                    .map_err(|error| unreadable(&error));
            }
            Some(Ok(Address::Signer(name))) => {
                let row = address::signer(self.connection, &name);
                Some(row.map_err(|_| self.no_signer(signer))?.id)
            }
            Some(_) => {
                return Err(self.no_signer(signer));
            }
            None => None,
        };
        let find = || -> Result<Option<Material>> {
            let mut recordings = recordings::recordings(self.connection)?;
            // Generated movement has its body from elsewhere, and may be generated again on another.
            recordings.retain(|row| match wanted {
                Some(signer) => row.signer_id == Some(signer),
                None => row.origin != Origin::Made,
            });
            let rank = |origin: Origin| {
                [Origin::Captured, Origin::Generated, Origin::Made]
                    .iter()
                    .position(|it| *it == origin)
            };
            recordings.sort_by_key(|row| (rank(row.origin), row.id));
            // Bodies with fingers come before others, and those that stand before those that hang in the air.
            let mut spare: Option<((bool, bool), Material)> = None;
            for recording in recordings {
                if recordings::body_track(self.connection, recording.id)?.is_none() {
                    continue;
                }
                let material = standing(self.connection, recording)?;
                let has_fingers = Side::BOTH
                    .iter()
                    .all(|&side| material.anatomy.has_fingers(side));
                let fit = (has_fingers, floor::hanging(&material).is_none());
                if fit == (true, true) {
                    return Ok(Some(material));
                }
                if spare.as_ref().is_none_or(|(best, _)| fit > *best) {
                    spare = Some((fit, material));
                }
            }
            match spare {
                None if wanted.is_none() => notation::own_body().map(Some),
                spare => spare.map(|(_, body)| floor::grounded(body)).transpose(),
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

    fn value(&self, component: Component, text: &str) -> std::result::Result<Value, SourceError> {
        chereme_compose::value_in(self.all(), component, text)
    }

    fn values(&self, component: Component) -> Vec<Value> {
        self.all()
            .filter(|it| it.component == component && it.feature.is_none())
            .flat_map(|it| it.values.iter().map(move |value| Value::of(it, value)))
            .collect()
    }

    fn holding(
        &self,
        component: Component,
        value: &str,
    ) -> std::result::Result<Vec<Example>, SourceError> {
        let find = || -> Result<Vec<Example>> {
            let mut examples = Vec::new();
            for found in signs::tokens_holding(self.connection, component.name(), value)? {
                let span = found.span_us.map(|(start, end)| {
                    Span::between(Instant::from_micros(start), Instant::from_micros(end))
                });
                let hand = found.hand.and_then(Hands::one);
                let handedness = if found.left_handed {
                    Handedness::Left
                } else {
                    Handedness::Right
                };
                let hand = hand.map(|hand| hand.resolve(handedness));
                examples.extend(self.example(found.token, hand, span)?);
            }
            Ok(examples)
        };
        find().map_err(|error| unreadable(&error))
    }

    fn best(
        &self,
        query: &str,
        signer: Option<&str>,
    ) -> std::result::Result<Vec<Example>, SourceError> {
        let same = signer.unwrap_or("signer:*");
        let query = query.replace("signer=same", same);
        let fault = |error: &Error| SourceError::Query {
            query: query.clone(),
            message: error.to_string(),
        };
        let tokens = crate::search::tokens(self.connection, self.index, &query);
        let tokens = tokens.map_err(|error| fault(&error))?;
        let mut examples = Vec::new();
        for token in tokens {
            examples.extend(
                self.example(token, None, None)
                    .map_err(|error| fault(&error))?,
            );
        }
        Ok(examples)
    }

    fn expression(
        &self,
        address: &str,
        function: Option<&str>,
    ) -> std::result::Result<ExpressionSource, SourceError> {
        let function = function.map(Function::of);
        let fault = |error: &Error| SourceError::Expression {
            address: address.to_owned(),
            why: error.to_string(),
            remedy: error.remedy().map(Box::new),
        };
        let named: Address = address.parse().map_err(|error| fault(&error))?;
        let found = face::expression_at(self.connection, &named, function.as_ref());
        let found = found.map_err(|error| fault(&error))?;
        let recording = Address::Recording(Name::Number(found.recording)).to_string();
        let stretch = self.stretch(&recording).map_err(|error| fault(&error))?;
        let material = self.load(&stretch).map_err(|error| fault(&error))?;
        let start = face::stage::first_frame(self.connection, found.recording, stretch.span);
        let start = start.map_err(|error| fault(&error))?;
        Ok(ExpressionSource {
            material,
            function: found.function,
            milestones: found.milestones.shifted(-start),
        })
    }

    fn letters(
        &self,
        alphabet: Option<&str>,
        word: &str,
    ) -> std::result::Result<Vec<Letter>, SourceError> {
        chereme_compose::letters_in(self.all(), alphabet, word)
    }

    fn learned_profile(&self) -> std::result::Result<Option<LearnedProfile>, SourceError> {
        let newest = history::newest(self.connection).map_err(|error| unreadable(&error))?;
        let mut learned = self.learned.borrow_mut();
        if let Some((_, profile)) = learned.profile.as_ref().filter(|(at, _)| *at == newest) {
            return Ok(profile.clone());
        }
        let profile = learned::profile(self.connection).map_err(|error| unreadable(&error))?;
        learned.profile = Some((newest, profile.clone()));
        Ok(profile)
    }

    fn body_language(
        &self,
        named: Option<&str>,
        signer: Option<&str>,
    ) -> std::result::Result<Language, SourceError> {
        self.spoken(named, signer)
    }

    fn cue_phases(&self) -> std::result::Result<Option<CuePhases>, SourceError> {
        crate::recombine::measured_phases(self.connection).map_err(|error| unreadable(&error))
    }

    fn spelling_times(&self) -> std::result::Result<SpellingTimes, SourceError> {
        learned::spelling_times(self.connection, self.inventories)
            .map_err(|error| unreadable(&error))
    }
}

fn sides(hand: Option<Hands>, handedness: Handedness) -> Vec<Option<Side>> {
    match hand {
        Some(Hands::Both) => vec![Some(Side::Right), Some(Side::Left)],
        Some(Hands::One(hand)) => vec![Some(hand.resolve(handedness))],
        None => vec![None],
    }
}

fn unreadable(error: &Error) -> SourceError {
    SourceError::Unreadable(error.to_string())
}

/// Returns the error for an address without what is wanted, which depends on what the address names instead.
fn missing(
    sources: &CorpusSources<'_>,
    address: &str,
    wanted: &'static str,
    error: &Error,
) -> SourceError {
    let own = address.to_owned();
    let parsed: Option<Address> = address.parse().ok();
    let sign = match &parsed {
        Some(Address::Gloss(gloss) | Address::Sign(Name::Text(gloss))) => {
            address::sign(sources.connection, gloss).ok()
        }
        _ => None,
    };
    let tokens = sign.and_then(|sign| signs::tokens_of_sign(sources.connection, sign).ok());
    match tokens {
        Some(tokens) if tokens.iter().all(|token| token.recording_id.is_none()) => {
            SourceError::NoMovement { address: own }
        }
        Some(tokens) => SourceError::Ambiguous {
            address: own,
            candidates: tokens
                .iter()
                .map(|token| format!("token:{}", token.id))
                .collect(),
        },
        None if parsed.is_none() => unreadable(error),
        None if error.is_lack() => SourceError::NoMovement { address: own },
        None => {
            if let Some(other) = sources.other_kind(address, wanted) {
                return other;
            }
            let glosses = signs::glosses(sources.connection).unwrap_or_default();
            let recordings = recordings::recordings(sources.connection).unwrap_or_default();
            let names = recordings.iter().map(|row| row.name.as_str());
            let near = nearest(address, glosses.iter().map(String::as_str).chain(names));
            SourceError::Missing {
                address: own,
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
            (
                "spell OR on token:1",
                "\"token:1\" is a sign, and a body",
                "",
            ),
            ("Ada | reverse", "\"Ada\" is a signer, and the movement", ""),
            (
                "BOL then signer:Ada",
                "is a signer, and the movement of a sign",
                "",
            ),
            (
                "sigml Ada",
                "\"Ada\" is a signer, and notation is wanted",
                "",
            ),
            (
                "point right at left on nobody",
                "\"nobody\" is not in the corpus",
                "",
            ),
            ("MOON | reverse", "\"MOON\" is not in the corpus", ""),
        ] {
            let error = corpus.preview(recipe).expect_err(recipe);
            assert!(error.to_string().contains(kind), "{recipe}: {error}");
            let remedy = error.remedy().map(|it| it.text().to_owned());
            let remedy = remedy.unwrap_or_default();
            assert!(remedy.contains(right), "{recipe}: {remedy}");
            let french = crate::words::message(&error.to_string(), crate::words::Language::French);
            let french = french.expect(recipe);
            assert!(!french.contains(" is "), "{recipe}: {french}");
        }
    }
}
