//! Readings of the hands, frame by frame, each computed once.

use std::rc::Rc;

use super::*;
use crate::transcribe::transcribe_tuned::tuned;

/// Handshapes by hand and frame.
type HandshapesByFrame = BTreeMap<(BodySide, usize), Option<BestReading<Handshape>>>;

/// A scene with the cache of its readings.
pub(in crate::transcribe) struct SceneReadings<'a> {
    pub(in crate::transcribe) scene: &'a SignerScene<'a>,
    /// The index of the hand that signs if only one does.
    pub(in crate::transcribe) lead: usize,
    pub(in crate::transcribe) options: &'a TranscribeOptions,
    forms: std::sync::Arc<HandFormTable>,
    shapes: RefCell<HandshapesByFrame>,
    bodies: RefCell<BTreeMap<usize, Option<Rc<PosedBody<'a>>>>>,
}

impl<'a> SceneReadings<'a> {
    pub(in crate::transcribe) fn new(scene: &'a SignerScene<'a>, options: &'a TranscribeOptions) -> Self {
        Self {
            scene,
            lead: leading_hand_index(scene),
            options,
            forms: HandFormTable::form_table_for(&options.language),
            shapes: RefCell::default(),
            bodies: RefCell::default(),
        }
    }

    /// Returns the acts of a hand, and the frame in which it leaves its first posture.
    pub(in crate::transcribe) fn read_hand_acts(
        &self,
        hand: usize,
        track: &HandTrajectory,
        frames: &RangeInclusive<usize>,
    ) -> (Vec<TranscribedAct>, Option<usize>) {
        let ends = [*frames.start(), *frames.end()];
        let parts = |meant: usize, frame: usize| {
            let (Some(body), Some(at)) = (self.cached_body_at(meant), self.cached_body_at(frame)) else {
                return Vec::new();
            };
            at.where_are(hand, &body.meant_parts(hand))
        };
        let others = |meant: usize, frame: usize| {
            let (Some(body), Some(at)) = (self.cached_body_at(meant), self.cached_body_at(frame)) else {
                return Vec::new();
            };
            let (parts, less): (Vec<_>, Vec<_>) = body.other_parts(hand).into_iter().unzip();
            at.where_are(hand, &parts).into_iter().zip(less).collect()
        };
        let mut pivots = Vec::new();
        for frame in ends {
            let tips = self.cached_body_at(frame).map(|body| body.turning_fingertips(hand));
            pivots.extend(tips.into_iter().flatten().map(|at| (at, frame)));
        }
        let seen = HandPartQueries {
            parts: &parts,
            others: &others,
            lets_go: self.scene.seconds_to_frames(tuned().acts.lets_go),
            loose: self.scene.loose,
        };
        let mover = MovingHand::new(track, ends, seen, &pivots);
        find_hand_acts(self.scene, &mover, frames)
    }

    /// Returns the body in a frame.
    pub(in crate::transcribe) fn cached_body_at(&self, frame: usize) -> Option<Rc<PosedBody<'a>>> {
        if let Some(known) = self.bodies.borrow().get(&frame) {
            return known.clone();
        }
        let body = self.read_uncached_body(frame).map(Rc::new);
        self.bodies.borrow_mut().insert(frame, body.clone());
        body
    }

    /// Like [`body`](Self::body), but uncached, so that its hands can be shifted.
    pub(in crate::transcribe) fn read_uncached_body(&self, frame: usize) -> Option<PosedBody<'a>> {
        let shapes = [0, 1].map(|n| {
            let track = self.scene.hands[n].as_ref()?;
            Some(self.read_handshape_at(track, frame)?.best)
        });
        PosedBody::read_posed_body(self.scene, frame, shapes.each_ref().map(Option::as_ref))
    }

    /// Returns the handshape in a frame; computed once.
    fn read_handshape_at(&self, track: &HandTrajectory, frame: usize) -> Option<BestReading<Handshape>> {
        let key = (track.side, frame);
        if let Some(known) = self.shapes.borrow().get(&key) {
            return known.clone();
        }
        let nearest_shape = self
            .forms
            .nearest_handshape(&track.angles[frame], &track.known, self.scene.loose);
        self.shapes.borrow_mut().insert(key, nearest_shape.clone());
        nearest_shape
    }

    /// Reads shape, direction and palm of a hand in a frame.
    pub(in crate::transcribe) fn read_hand_posture(&self, track: &HandTrajectory, frame: usize) -> HandReading {
        let between = self.options.between;
        let along = track.along[frame];
        let shape = self.read_handshape_at(track, frame);
        if !track.faces {
            return HandReading {
                shape,
                extended: aim::nearest_notated_aim(along, between),
                palm: None,
                beyond: 0.0,
            };
        }
        let turned = self.read_hand_orientations(track, frame, 1).swap_remove(0);
        HandReading {
            shape,
            extended: turned.extended,
            palm: Some(turned.palm),
            beyond: turned.beyond,
        }
    }

    /// Returns the likeliest orientations of a hand in a frame, at most `most` of them, the likeliest
    /// first.
    pub(in crate::transcribe) fn read_hand_orientations(
        &self,
        track: &HandTrajectory,
        frame: usize,
        most: usize,
    ) -> Vec<aim::OrientationReading> {
        // The scene treats the dominant hand as a right one.
        let left = track.side != self.scene.dominant;
        let [shoulder, elbow] = track.arm[frame];
        let arm = [shoulder, elbow, track.wrist[frame]];
        let wrist = aim::ForearmWristLimits::from_arm_positions(arm, left, self.scene.language);
        let how = aim::AimReadingSettings {
            between: self.options.between,
            loose: self.scene.loose,
        };
        let (along, normal) = (track.along[frame], track.normal[frame]);
        aim::likeliest_orientations(along, normal, wrist.as_ref(), how, most)
    }
}
