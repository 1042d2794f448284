//! Records features: readings in words and in symbols.

use chereme_sign::hamnosys::{MotionKind, Repeat};

use super::super::Stage;
use super::super::words::{self, WordsAndSymbols};
use super::*;

impl Writer<'_> {
    pub(super) fn record<T>(
        &mut self,
        kind: FeatureKind,
        track: Option<&HandTrajectory>,
        frame: usize,
        found: &Found<T>,
        describe: impl Fn(&T) -> WordsAndSymbols,
    ) {
        let unit = match kind {
            FeatureKind::Location | FeatureKind::Contact | FeatureKind::Movement => {
                Unit::Centimetres
            }
            FeatureKind::Hands
            | FeatureKind::Size
            | FeatureKind::Manner
            | FeatureKind::Repetition => Unit::Share,
            _ => Unit::Degrees,
        };
        let scale = if unit == Unit::Centimetres {
            100.0
        } else {
            1.0
        };
        let WordsAndSymbols { words, text } = describe(&found.best);
        self.features.push(Feature {
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
    pub(super) fn begins(&mut self, action: Option<usize>, frames: (usize, usize)) {
        self.action = action;
        self.frames = frames;
    }

    /// Records the HamNoSys of the current posture or action.
    pub(super) fn ends(&mut self, hand: Option<chereme_motion::Side>, text: String) {
        self.stages.push(Stage {
            action: self.action,
            hand,
            frames: self.frames,
            text,
        });
    }

    pub(super) fn record_hands(&mut self, relation: &Relation, frame: usize) {
        let found = Found {
            best: relation.kind,
            residual: relation.residual,
            runner_up: relation.runner_up,
        };
        let used = |kind: &RelationKind| words::hands(self.used(kind));
        let texts = [
            Some(&found.best),
            found.runner_up.as_ref().map(|(kind, _)| kind),
        ];
        let texts = texts.map(|kind| kind.map(|kind| (*kind, used(kind))));
        self.record(FeatureKind::Hands, None, frame, &found, |kind| {
            let known = texts.iter().flatten().find(|(of, _)| of == kind);
            let text = known.map_or_else(String::new, |(_, text)| text.clone());
            WordsAndSymbols::new(kind.words(), text)
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
                track.side.name(),
                seen.beyond
            ));
        }
        if let Some(shape) = seen.shape.as_ref().filter(|_| which[0]) {
            self.record(FeatureKind::Handshape, hand, frame, shape, words::shape);
        }
        if which[1] {
            let found = &seen.extended;
            self.record(FeatureKind::Direction, hand, frame, found, words::direction);
        }
        if let Some(palm) = seen.palm.as_ref().filter(|_| which[2]) {
            self.record(FeatureKind::Palm, hand, frame, palm, words::palm);
        }
    }

    pub(super) fn record_place(
        &mut self,
        track: Option<&HandTrajectory>,
        frame: usize,
        placed: &Placed,
    ) {
        self.record(
            FeatureKind::Location,
            track,
            frame,
            &placed.found(),
            words::place,
        );
        let contact = Found {
            best: &placed.place,
            residual: placed.distance,
            runner_up: None,
        };
        self.record(FeatureKind::Contact, track, frame, &contact, |place| {
            words::nearness(place)
        });
    }

    /// Records the contact of the two hands as a feature.
    pub(super) fn record_contact_of_hands(
        &mut self,
        frame: usize,
        hands: &Constellation,
        distance: f64,
    ) {
        let contact = Found {
            best: hands,
            residual: distance,
            runner_up: None,
        };
        self.record(FeatureKind::Contact, None, frame, &contact, |hands| {
            words::together(hands)
        });
    }

    pub(super) fn record_repetition(&mut self, track: &HandTrajectory, act: &Act, repeat: Repeat) {
        let times = Found {
            best: act.times,
            residual: 0.0,
            runner_up: None,
        };
        let first = *act.frames.start();
        self.record(FeatureKind::Repetition, Some(track), first, &times, |n| {
            words::repetition(*n, repeat)
        });
    }

    pub(super) fn record_size(
        &mut self,
        track: &HandTrajectory,
        frame: usize,
        found: &Found<Option<Size>>,
    ) {
        self.record(FeatureKind::Size, Some(track), frame, found, |size| {
            words::size(*size)
        });
    }

    /// Records the kind of a movement; `written` returns the notation of a value.
    pub(super) fn record_movement<T>(
        &mut self,
        track: &HandTrajectory,
        frame: usize,
        found: &Found<T>,
        name: impl Fn(&T) -> &'static str,
        written: impl Fn(&T) -> Option<MotionKind>,
    ) {
        self.record(FeatureKind::Movement, Some(track), frame, found, |value| {
            let text = written(value).map(|kind| words::motion(&Motion::new(kind)));
            WordsAndSymbols::new(name(value), text.unwrap_or_default())
        });
    }
}
