//! Transcription of stored movement to notation.

mod again;

use chereme_analysis::transcribe::{
    Feature, FeatureKind, Options, Stage, transcribe, transcribe_proven,
};
use chereme_motion::{HandCorrection, Side, Span};
use chereme_sign::Remedy;
use chereme_sign::hamnosys::{Nonmanual, Notated, Sign, print, to_names};
use serde::Serialize;

use crate::Corpus;
use crate::address::{Address, Stretch};
use crate::db::columns::Origin;
use crate::db::notations::{self, NotationRow};
use crate::db::recordings;
use crate::error::{Error, Result};
use crate::movement::{ChannelGroup, MotionTrack};
use crate::notation;
use crate::progress::Progress;
use crate::words::effect::OperationEffect;
use again::Again;

/// The longest stretch that is transcribed as one sign, in seconds.
const LONGEST: f64 = 60.0;
/// The correction of finger angles above which a finding reports it, in radians.
const MUCH: f64 = 0.15;

/// The HamNoSys transcription of a piece of movement, with the residual of each feature.
#[derive(Debug, Clone, Serialize)]
pub struct Transcribed {
    /// The row of the token, if the address names one.
    pub token: Option<i64>,
    /// Its gloss, otherwise the recording's name.
    pub gloss: String,
    /// The row of the recording.
    pub recording: i64,
    /// The start of the sign itself, without the transitions from and to rest, in microseconds from the start of the
    /// recording.
    pub start_us: i64,
    /// The end of the sign itself, in microseconds from the start of the recording.
    pub end_us: i64,
    /// The HamNoSys text.
    pub hamnosys: String,
    /// The names of its symbols.
    pub symbols: Vec<&'static str>,
    /// The notation's tree.
    pub sign: Sign,
    /// The acts of trunk, head and shoulders, if the program read them by animating the notation.
    #[serde(skip_serializing_if = "Nonmanual::is_empty")]
    pub nonmanual: Nonmanual,
    /// The posture at the beginning and the actions after it, each with its time.
    pub stages: Vec<TranscribedStage>,
    /// The features found, in the order of the notation.
    pub features: Vec<TranscribedFeature>,
    /// The hands whose handshape was not captured, as their fingers rest throughout the recording: the notation has one
    /// because it needs one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<Side>,
    /// Findings: features without a reading, and those that HamNoSys has no symbols for.
    pub findings: Vec<String>,
}

/// The initial posture of a sign, or one of its actions.
#[derive(Debug, Clone, Serialize)]
pub struct TranscribedStage {
    /// The number of the action, from 1; nothing for the initial posture.
    pub action: Option<usize>,
    /// The hand, if each hand does something of its own.
    pub hand: Option<Side>,
    /// The start, in microseconds from the start of the recording.
    pub start_us: i64,
    /// The end, including all repetitions.
    pub end_us: i64,
    /// Its HamNoSys.
    pub hamnosys: String,
    /// The names of its symbols.
    pub symbols: Vec<&'static str>,
}

/// A feature of notation, at a moment of a recording.
#[derive(Debug, Clone, Serialize)]
pub struct TranscribedFeature {
    /// Its kind: `handshape`, `palm`, `location`...
    pub feature: FeatureKind,
    /// The hand, if the feature has one.
    pub hand: Option<Side>,
    /// The number of the action it belongs to, from 1; nothing for the initial posture.
    pub action: Option<usize>,
    /// The moment at which it is observed, in microseconds from the start of the recording.
    pub at_us: i64,
    /// The start of the posture or action that it belongs to.
    pub start_us: i64,
    /// The end of that posture or action.
    pub end_us: i64,
    /// The best reading.
    #[serde(flatten)]
    pub value: TranscribedValue,
    /// `deg`, `cm` or `share`.
    pub unit: chereme_analysis::transcribe::Unit,
    /// The second best reading, with its residual in the same unit.
    pub runner_up: Option<TranscribedValue>,
}

/// A value of a feature, in words and in symbols.
#[derive(Debug, Clone, Serialize)]
pub struct TranscribedValue {
    /// In words.
    pub value: String,
    /// As HamNoSys; empty if the reading has no symbol.
    pub hamnosys: String,
    /// The names of the symbols.
    pub symbols: Vec<&'static str>,
    /// The distance of the movement from this value, in the feature's unit.
    pub residual: f64,
}

impl Corpus {
    /// Transcribes a token, or another short piece of movement, to HamNoSys.
    ///
    /// Reads only the frames of the token, so a long recording costs no more than a short one. Movement that this
    /// version of the animator generated from notation alone is verified by re-synthesis.
    ///
    /// # Errors
    /// Fails if the address names no movement, a stretch longer than a minute, or a skeleton without arms, or if
    /// `progress` asks to stop.
    pub fn transcribe(
        &self,
        address: &Address,
        progress: &mut Progress<'_>,
    ) -> Result<Transcribed> {
        let connection = self.store.read();
        let stretch = crate::address::stretch(connection, address)?;
        let seconds = stretch.span.seconds();
        if seconds > LONGEST {
            return Err(Error::wrong(format!(
                "{address} lasts {seconds:.0} s; at most one sign of {LONGEST:.0} s is transcribed at once"
            ))
            .at(address.to_string())
            .advise("name a token in it: token:41"));
        }
        let track = MotionTrack::of(connection, stretch.recording.id)?;
        let anatomy = track.anatomy(connection)?;
        let frames = match again::signed(connection, &track, &stretch)? {
            Some(frames) => frames,
            None => self.signed_frames((&track, &anatomy), &stretch)?,
        };
        let clip = track.clip(connection, frames.clone(), &ChannelGroup::ALL)?;
        let usual = match stretch.recording.origin {
            Origin::Made => Options::made(),
            _ => Options::default(),
        };
        let dominant = self.dominant(&stretch)?;
        let again = Again::of(connection, &stretch)?;
        let hands = crate::hands::corrections(connection, &self.hands, &stretch.recording)?;
        let options = Options {
            dominant,
            hands,
            longest: LONGEST + 1.0,
            language: again.as_ref().map_or(usual.language, Again::language),
            ..usual
        };
        let written = match &again {
            Some(again) => {
                let proving = again.proving(progress);
                let written = transcribe_proven(&clip, &anatomy, &options, &proving);
                if proving.stopped() {
                    return Err(Error::Stopped);
                }
                written
            }
            None => transcribe(&clip, &anatomy, &options),
        };
        let written =
            written.map_err(|error| Error::wrong(error.to_string()).at(address.to_string()))?;
        let printed = print(&written.sign);
        let mut findings = written.findings;
        findings.extend(printed.losses.iter().map(|loss| loss.message.clone()));
        findings.extend(corrected(&hands));
        let assumed = crate::hands::resting(connection, &self.hands, &stretch.recording)?;
        findings.extend(assumed.iter().map(|side| assumption(*side)));
        let is_seen = |feature: &Feature| {
            feature.kind != FeatureKind::Handshape
                || !assumed.contains(&feature.hand.unwrap_or(dominant))
        };
        let at = |frame: usize| clip.rate().instant(frames.start + frame).micros();
        let (first, end) = written.frames;
        Ok(Transcribed {
            token: stretch.token.as_ref().map(|token| token.id),
            gloss: match &stretch.token {
                Some(token) => token.gloss.clone(),
                None => stretch.recording.name.clone(),
            },
            recording: stretch.recording.id,
            start_us: at(first),
            end_us: at(end).min(span_end(stretch.span, at(first))),
            symbols: names(&printed.text)?,
            hamnosys: printed.text,
            stages: written
                .stages
                .into_iter()
                .map(|stage| staged(stage, &at))
                .collect::<Result<_>>()?,
            features: written
                .features
                .into_iter()
                .filter(is_seen)
                .map(|feature| placed(feature, &at))
                .collect::<Result<_>>()?,
            sign: written.sign,
            nonmanual: written.nonmanual,
            assumed,
            findings,
        })
    }

    /// Transcribes a token as [`transcribe`](Self::transcribe) does, and stores the result as its notation. Keeps the
    /// non-manual tiers of its present notation, or of the notation that generated it, unless the transcription has others.
    ///
    /// # Errors
    /// As [`transcribe`](Self::transcribe). Also fails if the address names no token, or if the token has another
    /// notation already and `force` is not set.
    pub fn store_transcription(
        &mut self,
        address: &Address,
        force: bool,
        progress: &mut Progress<'_>,
    ) -> Result<Transcribed> {
        let written = self.transcribe(address, progress)?;
        let Some(token) = written.token else {
            return Err(Error::wrong(format!("{address} is no token"))
                .at(address.to_string())
                .advise("write token:41 or a gloss"));
        };
        let connection = self.store.read();
        let old = notation::of_token(connection, token)?;
        let other = old
            .as_ref()
            .is_some_and(|old| old.text.as_ref() != Some(&written.hamnosys));
        if other && !force {
            return Err(
                Error::wrong(format!("{address} has another notation already"))
                    .at(address.to_string())
                    .advise(Remedy::command(
                        "add --force to replace it; undo brings it back",
                    )),
            );
        }
        let old = match old {
            Some(old) => Some(old),
            None => notation::of_recipes(connection, &[token])?.remove(&token),
        };
        let mut nonmanual = old.map(|old| old.document.nonmanual).unwrap_or_default();
        nonmanual.tiers.extend(written.nonmanual.tiers.clone());
        let document = Notated {
            gloss: written.gloss.clone(),
            text: Some(written.hamnosys.clone()),
            sign: written.sign.clone(),
            nonmanual,
            ..Notated::default()
        };
        let document = serde_json::to_string(&document)
            .map_err(|error| Error::wrong(format!("the notation cannot be kept: {error}")))?;
        self.store.operation(|connection| {
            notations::set(
                connection,
                &NotationRow {
                    token_id: token,
                    system: "hamnosys".to_owned(),
                    text: Some(written.hamnosys.clone()),
                    document,
                    ..NotationRow::default()
                },
            )?;
            let gloss = written.gloss.clone();
            Ok(((), OperationEffect::Transcribe { token, gloss }))
        })?;
        Ok(written)
    }

    /// Returns the signer's dominant hand: the right one if it is unknown.
    pub(crate) fn dominant(&self, stretch: &Stretch) -> Result<Side> {
        let signer = match stretch.recording.signer_id {
            Some(id) => recordings::signer(self.store.read(), id)?,
            None => None,
        };
        let left = signer.is_some_and(|it| it.handedness.as_deref() == Some("left"));
        Ok(if left { Side::Left } else { Side::Right })
    }
}

/// Returns the finding about a hand whose fingers nobody captured.
fn assumption(side: Side) -> String {
    format!(
        "the fingers of the {} hand rest throughout the recording, so its handshape was not captured: the notated one is \
         an assumption",
        side.name()
    )
}

/// Returns a finding about the correction of finger angles, if it is large.
fn corrected(hands: &[HandCorrection; 2]) -> Option<String> {
    let most = hands
        .iter()
        .map(HandCorrection::largest)
        .fold(0.0, f64::max);
    (most > MUCH).then(|| {
        format!(
            "finger angles count from the straightest posture in this signer's takes, which is up to {:.0} degrees bent",
            most.to_degrees()
        )
    })
}

fn span_end(span: Span, least: i64) -> i64 {
    span.end().micros().max(least)
}

fn names(text: &str) -> Result<Vec<&'static str>> {
    to_names(text).map_err(|error| Error::wrong(format!("the notation is odd: {error}")))
}

fn staged(stage: Stage, at: &impl Fn(usize) -> i64) -> Result<TranscribedStage> {
    Ok(TranscribedStage {
        action: stage.action,
        hand: stage.hand,
        start_us: at(stage.frames.0),
        end_us: at(stage.frames.1),
        symbols: names(&stage.text)?,
        hamnosys: stage.text,
    })
}

fn placed(feature: Feature, at: &impl Fn(usize) -> i64) -> Result<TranscribedFeature> {
    let value = |value: String, text: String, residual: f64| -> Result<TranscribedValue> {
        Ok(TranscribedValue {
            value,
            symbols: names(&text)?,
            hamnosys: text,
            residual,
        })
    };
    let runner_up = feature.runner_up;
    Ok(TranscribedFeature {
        feature: feature.kind,
        hand: feature.hand,
        action: feature.action,
        at_us: at(feature.frame),
        start_us: at(feature.frames.0),
        end_us: at(feature.frames.1),
        value: value(feature.value, feature.text, feature.residual)?,
        unit: feature.unit,
        runner_up: runner_up
            .map(|next| value(next.value, next.text, next.residual))
            .transpose()?,
    })
}
