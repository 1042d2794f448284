//! The notation of stored movement.

mod again;

use chereme_analysis::transcribe::{
    Feature, FeatureKind, Options, Stage, transcribe, transcribe_proven,
};
use chereme_motion::{HandCorrection, Side, Span};
use chereme_sign::hamnosys::{Notated, Sign, print, to_names};
use serde::Serialize;

use crate::Corpus;
use crate::address::{Address, Stretch};
use crate::db::columns::Origin;
use crate::db::notations::{self, NotationRow};
use crate::db::recordings;
use crate::error::{Error, Result};
use crate::movement::{ChannelGroup, Track};
use crate::progress::Progress;
use again::Again;

/// The longest stretch in seconds that is taken for one sign.
const LONGEST: f64 = 60.0;
/// A correction of finger angles above this, in radians, is reported.
const MUCH: f64 = 0.15;

/// A piece of movement as HamNoSys, each feature with how far the movement is from it.
#[derive(Debug, Clone, Serialize)]
pub struct Transcribed {
    /// The token, where the address names one.
    pub token: Option<i64>,
    /// Its gloss, else the recording's name.
    pub gloss: String,
    /// The recording.
    pub recording: i64,
    /// Where the sign itself starts and ends, ways from and to rest cut off, in microseconds from the
    /// start of the recording.
    pub start_us: i64,
    /// As above.
    pub end_us: i64,
    /// The HamNoSys text.
    pub hamnosys: String,
    /// The names of its symbols.
    pub symbols: Vec<&'static str>,
    /// The notation's tree.
    pub sign: Sign,
    /// The posture at the beginning and the actions after it, each with its time.
    pub stages: Vec<TranscribedStage>,
    /// The features found, in the order of the notation.
    pub features: Vec<TranscribedFeature>,
    /// Findings: features without a reading, and those that HamNoSys has no symbols for.
    pub findings: Vec<String>,
}

/// The posture that a sign begins with, or something that is done.
#[derive(Debug, Clone, Serialize)]
pub struct TranscribedStage {
    /// The number of the action, from 1; nothing for the posture at the beginning.
    pub action: Option<usize>,
    /// The hand, where each does something for itself.
    pub hand: Option<Side>,
    /// From when, in microseconds from the start of the recording.
    pub start_us: i64,
    /// Until when, with all repetitions.
    pub end_us: i64,
    /// Its HamNoSys.
    pub hamnosys: String,
    /// The names of its symbols.
    pub symbols: Vec<&'static str>,
}

/// A feature of notation, at a moment of a recording.
#[derive(Debug, Clone, Serialize)]
pub struct TranscribedFeature {
    /// What it is about: `handshape`, `palm`, `location`...
    pub feature: FeatureKind,
    /// The hand, if the feature has one.
    pub hand: Option<Side>,
    /// The number of the action it belongs to, from 1; nothing for the posture at the beginning.
    pub action: Option<usize>,
    /// When it is seen, in microseconds from the start of the recording.
    pub at_us: i64,
    /// From when the posture or action lasts that it belongs to.
    pub start_us: i64,
    /// Until when it lasts.
    pub end_us: i64,
    /// What it is.
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
    /// How far the movement is from it, in the feature's unit.
    pub residual: f64,
}

impl Corpus {
    /// Writes a token, or another short piece of movement, in HamNoSys.
    ///
    /// Only the frames of the token are read, so a long recording costs no more than a short one. Movement
    /// generated from notation alone, by this version of the animator, is verified by re-synthesis.
    ///
    /// # Errors
    /// Where the address names no movement, one longer than a minute, or a skeleton without arms; where `progress`
    /// says to stop.
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
                "{address} lasts {seconds:.0} s; one sign of at most {LONGEST:.0} s is written at once"
            ))
            .at(address.to_string())
            .advise("name a token in it: token:41"));
        }
        let track = Track::of(connection, stretch.recording.id)?;
        let frames = again::signed(connection, &track, &stretch)?;
        let frames = frames.unwrap_or_else(|| track.frames_in(stretch.span));
        let clip = track.clip(connection, frames.clone(), &ChannelGroup::ALL)?;
        let anatomy = track.anatomy(connection)?;
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
                .map(|feature| placed(feature, &at))
                .collect::<Result<_>>()?,
            sign: written.sign,
            findings,
        })
    }

    /// Writes a token in HamNoSys as [`transcribe`](Self::transcribe) does, and keeps that as its notation.
    ///
    /// # Errors
    /// As there; where the address names no token; and, unless `force`, where the token has another
    /// notation already.
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
        let old = notations::of_token(self.store.read(), token)?;
        let other = old.is_some_and(|old| old.text.as_ref() != Some(&written.hamnosys));
        if other && !force {
            return Err(
                Error::wrong(format!("{address} has another notation already"))
                    .at(address.to_string())
                    .advise("add --force to write over it; undo brings it back"),
            );
        }
        let document = Notated {
            gloss: written.gloss.clone(),
            text: Some(written.hamnosys.clone()),
            sign: written.sign.clone(),
            ..Notated::default()
        };
        let document = serde_json::to_string(&document)
            .map_err(|error| Error::wrong(format!("the notation cannot be kept: {error}")))?;
        self.store.operation("transcribe", |connection| {
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
            Ok(((), format!("token:{token} {}", written.gloss)))
        })?;
        Ok(written)
    }

    /// Returns the signer's dominant hand: the right one if it is unknown.
    fn dominant(&self, stretch: &Stretch) -> Result<Side> {
        let signer = match stretch.recording.signer_id {
            Some(id) => recordings::signer(self.store.read(), id)?,
            None => None,
        };
        let left = signer.is_some_and(|it| it.handedness.as_deref() == Some("left"));
        Ok(if left { Side::Left } else { Side::Right })
    }
}

/// Says by how much finger angles were corrected, if that is much.
fn corrected(hands: &[HandCorrection; 2]) -> Option<String> {
    let most = hands
        .iter()
        .map(HandCorrection::largest)
        .fold(0.0, f64::max);
    (most > MUCH).then(|| {
        format!(
            "fingers are read against the straightest posture of this signer's own takes, up to {:.0} degrees bent",
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
