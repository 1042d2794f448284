//! Records features: readings in words and in symbols.

use chereme_sign::hamnosys::{MotionKind, RepeatKind};

use super::super::TranscriptionStage;
use super::super::transcribe_words::{self, WordsAndSymbols};
use super::*;

impl NotationWriter<'_> {
    pub(super) fn record_feature<T>(
        &mut self,
        kind: FeatureKind,
        track: Option<&HandTrajectory>,
        frame: usize,
        found: &BestReading<T>,
        describe: impl Fn(&T) -> WordsAndSymbols,
    ) {
        let unit = match kind {
            FeatureKind::Location | FeatureKind::Contact | FeatureKind::Movement => ResidualUnit::Centimetres,
            FeatureKind::Hands | FeatureKind::Size | FeatureKind::Manner | FeatureKind::Repetition => {
                ResidualUnit::Share
            }
            _ => ResidualUnit::Degrees,
        };
        let scale = if unit == ResidualUnit::Centimetres { 100.0 } else { 1.0 };
        let WordsAndSymbols { words, text } = describe(&found.best);
        self.features.push(NotationFeature {
            kind,
            hand: track.map(|track| track.side),
            frame,
            frames: self.frames,
            action: self.action,
            value: words,
            text,
            residual: found.residual * scale,
            unit,
            runner_up: found.runner_up.as_ref().map(|(value, residual)| {
                let WordsAndSymbols { words, text } = describe(value);
                RunnerUp {
                    value: words,
                    text,
                    residual: residual * scale,
                }
            }),
        });
    }

    /// Sets the posture or action that the next features belong to.
    pub(super) fn begin_recorded_stage(&mut self, action: Option<usize>, frames: (usize, usize)) {
        self.action = action;
        self.frames = frames;
    }

    /// Records the HamNoSys of the current posture or action.
    pub(super) fn end_recorded_stage(&mut self, hand: Option<chereme_motion::BodySide>, text: String) {
        self.stages.push(TranscriptionStage {
            action: self.action,
            hand,
            frames: self.frames,
            text,
        });
    }

    pub(super) fn record_hands(&mut self, relation: &HandRelation, frame: usize) {
        let relation_finding = BestReading {
            best: relation.kind,
            residual: relation.residual,
            runner_up: relation.runner_up,
        };
        let used = |kind: &RelationKind| transcribe_words::acting_hands_hamnosys(self.choose_hands_used(kind));
        let relation_kinds = [
            Some(&relation_finding.best),
            relation_finding.runner_up.as_ref().map(|(kind, _)| kind),
        ];
        let texts = relation_kinds.map(|kind| kind.map(|kind| (*kind, used(kind))));
        self.record_feature(FeatureKind::Hands, None, frame, &relation_finding, |kind| {
            let matching_text = texts.iter().flatten().find(|(of, _)| of == kind);
            let text = matching_text.map_or_else(String::new, |(_, text)| text.clone());
            WordsAndSymbols::new(kind.describe_relation(), text)
        });
    }

    pub(super) fn record_reading(
        &mut self,
        track: &HandTrajectory,
        frame: usize,
        seen: &HandReading,
        which: [bool; 3],
    ) {
        let hand = Some(track);
        if (which[1] || which[2]) && seen.beyond > 1.0 {
            self.findings.push(format!(
                "the {} wrist or forearm is at its limit in frame {frame}: the reading is {:.0}° beyond it",
                track.side.body_side_name(),
                seen.beyond
            ));
        }
        if let Some(shape) = seen.shape.as_ref().filter(|_| which[0]) {
            self.record_feature(
                FeatureKind::Handshape,
                hand,
                frame,
                shape,
                transcribe_words::describe_handshape,
            );
        }
        if which[1] {
            let extended_finding = &seen.extended;
            self.record_feature(
                FeatureKind::Direction,
                hand,
                frame,
                extended_finding,
                transcribe_words::describe_aim_direction,
            );
        }
        if let Some(palm) = seen.palm.as_ref().filter(|_| which[2]) {
            self.record_feature(FeatureKind::Palm, hand, frame, palm, transcribe_words::describe_palm);
        }
    }

    pub(super) fn record_place(&mut self, track: Option<&HandTrajectory>, frame: usize, placed: &LikelyHandPlace) {
        self.record_feature(
            FeatureKind::Location,
            track,
            frame,
            &placed.to_place_reading(),
            transcribe_words::describe_body_place,
        );
        let contact = BestReading {
            best: &placed.place,
            residual: placed.distance,
            runner_up: None,
        };
        self.record_feature(FeatureKind::Contact, track, frame, &contact, |place| {
            transcribe_words::describe_place_contact(place)
        });
    }

    /// Records the contact of the two hands as a feature.
    pub(super) fn record_contact_of_hands(&mut self, frame: usize, hands: &HandConstellation, distance: f64) {
        let contact = BestReading {
            best: hands,
            residual: distance,
            runner_up: None,
        };
        self.record_feature(FeatureKind::Contact, None, frame, &contact, |hands| {
            transcribe_words::describe_hands_together(hands)
        });
    }

    pub(super) fn record_repetition(&mut self, track: &HandTrajectory, act: &TranscribedAct, repeat: RepeatKind) {
        let times = BestReading {
            best: act.times,
            residual: 0.0,
            runner_up: None,
        };
        let first = *act.frames.start();
        self.record_feature(FeatureKind::Repetition, Some(track), first, &times, |n| {
            transcribe_words::describe_repetition(*n, repeat)
        });
    }

    pub(super) fn record_size(
        &mut self,
        track: &HandTrajectory,
        frame: usize,
        found: &BestReading<Option<MotionSize>>,
    ) {
        self.record_feature(FeatureKind::Size, Some(track), frame, found, |size| {
            transcribe_words::describe_path_size(*size)
        });
    }

    /// Records the kind of a movement; `written` returns the notation of a value.
    pub(super) fn record_movement<T>(
        &mut self,
        track: &HandTrajectory,
        frame: usize,
        found: &BestReading<T>,
        name: impl Fn(&T) -> &'static str,
        written: impl Fn(&T) -> Option<MotionKind>,
    ) {
        self.record_feature(FeatureKind::Movement, Some(track), frame, found, |value| {
            let text = written(value).map(|kind| transcribe_words::motion_hamnosys(&NotatedMotion::new(kind)));
            WordsAndSymbols::new(name(value), text.unwrap_or_default())
        });
    }
}
