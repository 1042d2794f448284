//! Transcription of stored movement to notation.

mod transcribe_again;

use chereme_analysis::transcribe::{
    FeatureKind, HeldReading, NotationFeature, TranscribeOptions, TranscriptionStage, transcribe_clip,
    transcribe_holds, transcribe_proven,
};
use chereme_motion::{BodySide, HandCorrection, TimeSpan};
use chereme_sign::hamnosys::{HamnosysSign, NonmanualActs, NotatedSign, print_hamnosys, to_names};
use serde::Serialize;

use crate::Corpus;
use crate::address::{CorpusAddress, RecordingStretch};
use crate::db::notations::{self, NotationRow};
use crate::db::stored_columns::RecordOrigin;
use crate::db::stored_recordings;
use crate::error::{CorpusError, CorpusResult};
use crate::movement::{ChannelGroup, MotionTrack};
use crate::notation;
use crate::progress::ProgressReceiver;
use crate::words::effect::OperationEffect;
use transcribe_again::ResynthesisBody;

/// The longest stretch that is transcribed as one sign, in seconds.
const MAX_TRANSCRIBED_SECONDS: f64 = 60.0;
/// The time before and after a sign that shows how fast its hands come and go, in microseconds.
const HOLD_SURROUNDINGS_US: i64 = 400_000;
/// The correction of finger angles above which a finding reports it, in radians.
const REPORTED_CORRECTION_RADIANS: f64 = 0.15;

/// The HamNoSys transcription of a piece of movement, with the residual of each feature.
#[derive(Debug, Clone, Serialize)]
pub struct SignTranscription {
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
    pub sign: HamnosysSign,
    /// The acts of trunk, head and shoulders, if the program read them by animating the notation.
    #[serde(skip_serializing_if = "NonmanualActs::is_empty")]
    pub nonmanual: NonmanualActs,
    /// The posture at the beginning and the actions after it, each with its time.
    pub stages: Vec<TranscribedStage>,
    /// The features found, in the order of the notation.
    pub features: Vec<TranscribedFeature>,
    /// The hands whose handshape was not captured, as their fingers rest throughout the recording: the notation has one
    /// because it needs one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<BodySide>,
    /// Findings: features without a reading, and those that HamNoSys has no symbols for.
    pub findings: Vec<String>,
}

/// The initial posture of a sign, or one of its actions.
#[derive(Debug, Clone, Serialize)]
pub struct TranscribedStage {
    /// The number of the action, from 1; nothing for the initial posture.
    pub action: Option<usize>,
    /// The hand, if each hand does something of its own.
    pub hand: Option<BodySide>,
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
    pub hand: Option<BodySide>,
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
    pub unit: chereme_analysis::transcribe::ResidualUnit,
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
    pub fn transcribe_movement(
        &self,
        address: &CorpusAddress,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<SignTranscription> {
        let connection = self.store.read_connection();
        let stretch = crate::address::find_addressed_stretch(connection, address)?;
        let seconds = stretch.span.span_seconds();
        if seconds > MAX_TRANSCRIBED_SECONDS {
            return Err(CorpusError::from_wrong_message(format!(
                "{address} lasts {seconds:.0} s; at most one sign of {MAX_TRANSCRIBED_SECONDS:.0} s is transcribed at once"
            ))
            .with_error_place(address.to_string())
            .with_advice("name a token in it: token:41"));
        }
        let track = MotionTrack::open_motion_track(connection, stretch.recording.id)?;
        let anatomy = track.track_anatomy(connection)?;
        let frames = match transcribe_again::generated_sign_frames(connection, &track, &stretch)? {
            Some(frames) => frames,
            None => self.signed_frames(&track, &anatomy, &stretch)?,
        };
        let clip = track.read_motion_clip(connection, frames.clone(), &ChannelGroup::ALL_CHANNEL_GROUPS)?;
        let rerun = ResynthesisBody::resynthesis_body_of(connection, &stretch)?;
        let options = self.transcribe_options(&stretch, rerun.as_ref())?;
        let (dominant, hands) = (options.dominant, options.hands);
        let outcome = match &rerun {
            Some(again) => {
                let proving = again.start_resynthesis(progress);
                let written = transcribe_proven(&clip, &anatomy, &options, &proving);
                if proving.is_resynthesis_stopped() {
                    return Err(CorpusError::Stopped);
                }
                written
            }
            None => transcribe_clip(&clip, &anatomy, &options),
        };
        let written = outcome.map_err(|error| {
            CorpusError::from_wrong_message(error.to_string()).with_error_place(address.to_string())
        })?;
        let printed = print_hamnosys(&written.sign);
        let mut findings = written.findings;
        findings.extend(printed.losses.iter().map(|loss| loss.message.clone()));
        findings.extend(correction_finding(&hands));
        let takes = crate::hands::hand_range_takes(connection, &self.hands, stretch.recording.id)?;
        if !takes.is_empty() {
            let names = takes.join(", ");
            findings.push(format!(
                "the range of the fingers is measured from other takes of the signer, too: {names}"
            ));
        }
        let assumed = crate::hands::find_resting_hands(connection, &self.hands, &stretch.recording)?;
        findings.extend(assumed.iter().map(|side| assumption(*side)));
        let is_seen = |feature: &NotationFeature| {
            feature.kind != FeatureKind::Handshape || !assumed.contains(&feature.hand.unwrap_or(dominant))
        };
        let frame_micros = |frame: usize| {
            let instant = track.rate.frame_start_instant(frames.start + frame);
            instant.instant_micros() + track.row.offset_us
        };
        let (first, end) = written.frames;
        Ok(SignTranscription {
            token: stretch.token.as_ref().map(|token| token.id),
            gloss: match &stretch.token {
                Some(token) => token.gloss.clone(),
                None => stretch.recording.name.clone(),
            },
            recording: stretch.recording.id,
            start_us: frame_micros(first),
            end_us: frame_micros(end).min(span_end(stretch.span, frame_micros(first))),
            symbols: notation_symbol_names(&printed.text)?,
            hamnosys: printed.text,
            stages: written
                .stages
                .into_iter()
                .map(|stage| transcribed_stage(stage, &frame_micros))
                .collect::<CorpusResult<_>>()?,
            features: written
                .features
                .into_iter()
                .filter(is_seen)
                .map(|feature| transcribed_feature(feature, &frame_micros))
                .collect::<CorpusResult<_>>()?,
            sign: written.sign,
            nonmanual: written.nonmanual,
            assumed,
            findings,
        })
    }

    /// Returns the settings for a stretch: those of its origin, its signer and, if it was generated, its animator.
    fn transcribe_options(
        &self,
        stretch: &RecordingStretch,
        rerun: Option<&ResynthesisBody>,
    ) -> CorpusResult<TranscribeOptions> {
        let usual = match stretch.recording.origin {
            RecordOrigin::Made => TranscribeOptions::synthesised_options(),
            _ => TranscribeOptions::default(),
        };
        Ok(TranscribeOptions {
            dominant: self.dominant_side(stretch)?,
            hands: crate::hands::load_hand_corrections(self.store.read_connection(), &self.hands, &stretch.recording)?,
            longest: MAX_TRANSCRIBED_SECONDS + 1.0,
            language: rerun.map_or(usual.language, ResynthesisBody::recording_body_language),
            ..usual
        })
    }

    /// Returns the postures of a sign in a stretch at the holds of each hand; their times count from the recording's start.
    pub(crate) fn stretch_holds(&self, stretch: &RecordingStretch, sign: TimeSpan) -> CorpusResult<Vec<HeldReading>> {
        let connection = self.store.read_connection();
        let track = MotionTrack::open_motion_track(connection, stretch.recording.id)?;
        let anatomy = track.track_anatomy(connection)?;
        let take = crate::hands::usable_take(connection, &self.hands, &stretch.recording)?;
        let wide = TimeSpan::span_between(
            sign.span_start_instant().shifted_instant(-HOLD_SURROUNDINGS_US),
            sign.span_end_instant().shifted_instant(HOLD_SURROUNDINGS_US),
        );
        let frames = take.usable_frames_within(track.frames_in(wide));
        let offset = track.rate.frame_start_instant(frames.start).instant_micros() + track.row.offset_us;
        let clip = track.read_motion_clip(connection, frames, &ChannelGroup::ALL_CHANNEL_GROUPS)?;
        let rerun = ResynthesisBody::resynthesis_body_of(connection, stretch)?;
        let options = self.transcribe_options(stretch, rerun.as_ref())?;
        let read = transcribe_holds(&clip, &anatomy, &options, sign.shifted_span(-offset));
        let mut holds = read.map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
        for reading in &mut holds {
            reading.held.span = reading.held.span.shifted_span(offset);
        }
        Ok(holds)
    }

    /// Transcribes a token as [`transcribe`](Self::transcribe_movement) does, and stores the result as its notation. Keeps the
    /// non-manual tiers of its present notation, or of the notation that generated it, unless the transcription has others.
    ///
    /// # Errors
    /// As [`transcribe`](Self::transcribe_movement). Also fails if the address names no token, or if the token has another
    /// notation already and `force` is not set.
    pub fn store_transcription(
        &mut self,
        address: &CorpusAddress,
        force: bool,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<SignTranscription> {
        let written = self.transcribe_movement(address, progress)?;
        let Some(token) = written.token else {
            return Err(CorpusError::from_wrong_message(format!("{address} is no token"))
                .with_error_place(address.to_string())
                .with_advice("write token:41 or a gloss"));
        };
        let connection = self.store.read_connection();
        let old = notation::notation_of_token(connection, token)?;
        let other = old
            .as_ref()
            .is_some_and(|old| old.text.as_ref() != Some(&written.hamnosys));
        if other && !force {
            return Err(
                CorpusError::from_wrong_message(format!("{address} has another notation already"))
                    .with_error_place(address.to_string())
                    .with_command_advice("add --force to replace it; undo brings it back"),
            );
        }
        let old = match old {
            Some(old) => Some(old),
            None => notation::of_recipes(connection, &[token])?.remove(&token),
        };
        let mut nonmanual = old.map(|old| old.document.nonmanual).unwrap_or_default();
        nonmanual.tiers.extend(written.nonmanual.tiers.clone());
        let notated = NotatedSign {
            gloss: written.gloss.clone(),
            text: Some(written.hamnosys.clone()),
            sign: written.sign.clone(),
            nonmanual,
            ..NotatedSign::default()
        };
        let document = serde_json::to_string(&notated)
            .map_err(|error| CorpusError::from_wrong_message(format!("the notation cannot be kept: {error}")))?;
        self.store.run_store_operation(|connection| {
            notations::set_token_notation(
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
    pub(crate) fn dominant_side(&self, stretch: &RecordingStretch) -> CorpusResult<BodySide> {
        let signer = match stretch.recording.signer_id {
            Some(id) => stored_recordings::find_signer_row(self.store.read_connection(), id)?,
            None => None,
        };
        let left = signer.is_some_and(|signer| signer.handedness.as_deref() == Some("left"));
        Ok(if left { BodySide::Left } else { BodySide::Right })
    }
}

/// Returns the finding about a hand whose fingers nobody captured.
fn assumption(side: BodySide) -> String {
    format!(
        "the fingers of the {} hand rest throughout the recording, so its handshape was not captured: the notated one is \
         an assumption",
        side.body_side_name()
    )
}

/// Returns a finding about the correction of finger angles, if it is large.
fn correction_finding(hands: &[HandCorrection; 2]) -> Option<String> {
    let most = hands
        .iter()
        .map(HandCorrection::largest_zero_correction)
        .fold(0.0, f64::max);
    (most > REPORTED_CORRECTION_RADIANS).then(|| {
        format!(
            "finger angles count from the straightest posture in this signer's takes, which is up to {:.0} degrees bent",
            most.to_degrees()
        )
    })
}

fn span_end(span: TimeSpan, least: i64) -> i64 {
    span.span_end_instant().instant_micros().max(least)
}

fn notation_symbol_names(text: &str) -> CorpusResult<Vec<&'static str>> {
    to_names(text).map_err(|error| CorpusError::from_wrong_message(format!("the notation is odd: {error}")))
}

fn transcribed_stage(stage: TranscriptionStage, at: &impl Fn(usize) -> i64) -> CorpusResult<TranscribedStage> {
    Ok(TranscribedStage {
        action: stage.action,
        hand: stage.hand,
        start_us: at(stage.frames.0),
        end_us: at(stage.frames.1),
        symbols: notation_symbol_names(&stage.text)?,
        hamnosys: stage.text,
    })
}

fn transcribed_feature(feature: NotationFeature, at: &impl Fn(usize) -> i64) -> CorpusResult<TranscribedFeature> {
    let value = |value: String, text: String, residual: f64| -> CorpusResult<TranscribedValue> {
        Ok(TranscribedValue {
            value,
            symbols: notation_symbol_names(&text)?,
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
