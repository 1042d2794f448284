//! Readings of the hands, frame by frame, each computed once.

use std::rc::Rc;

use super::*;
use crate::transcribe::tuned::tuned;

/// Handshapes by hand and frame.
type Shapes = BTreeMap<(Side, usize), Option<Found<Handshape>>>;

/// A scene with the cache of its readings.
pub(in crate::transcribe) struct Sight<'a> {
    pub(in crate::transcribe) scene: &'a Scene<'a>,
    /// The index of the hand that signs if only one does.
    pub(in crate::transcribe) lead: usize,
    pub(in crate::transcribe) options: &'a Options,
    forms: std::sync::Arc<Forms>,
    shapes: RefCell<Shapes>,
    bodies: RefCell<BTreeMap<usize, Option<Rc<Body<'a>>>>>,
}

impl<'a> Sight<'a> {
    pub(in crate::transcribe) fn new(scene: &'a Scene<'a>, options: &'a Options) -> Self {
        Self {
            scene,
            lead: lead(scene),
            options,
            forms: Forms::of(&options.language),
            shapes: RefCell::default(),
            bodies: RefCell::default(),
        }
    }

    /// Returns the acts of a hand, and the frame in which it leaves its first posture.
    pub(in crate::transcribe) fn acts(
        &self,
        hand: usize,
        track: &HandTrajectory,
        frames: &RangeInclusive<usize>,
    ) -> (Vec<Act>, Option<usize>) {
        let ends = [*frames.start(), *frames.end()];
        let parts = |meant: usize, frame: usize| {
            let (Some(body), Some(at)) = (self.body(meant), self.body(frame)) else {
                return Vec::new();
            };
            at.where_are(hand, &body.meant_parts(hand))
        };
        let others = |meant: usize, frame: usize| {
            let (Some(body), Some(at)) = (self.body(meant), self.body(frame)) else {
                return Vec::new();
            };
            let (parts, less): (Vec<_>, Vec<_>) = body.other_parts(hand).into_iter().unzip();
            at.where_are(hand, &parts).into_iter().zip(less).collect()
        };
        let mut pivots = Vec::new();
        for frame in ends {
            let tips = self.body(frame).map(|body| body.tips(hand));
            pivots.extend(tips.into_iter().flatten().map(|at| (at, frame)));
        }
        let seen = Seeing {
            parts: &parts,
            others: &others,
            lets_go: self.scene.frames(tuned().acts.lets_go),
            loose: self.scene.loose,
        };
        let mover = Mover::new(track, ends, seen, &pivots);
        acts(self.scene, &mover, frames)
    }

    /// Returns the body in a frame.
    pub(in crate::transcribe) fn body(&self, frame: usize) -> Option<Rc<Body<'a>>> {
        if let Some(known) = self.bodies.borrow().get(&frame) {
            return known.clone();
        }
        let body = self.look(frame).map(Rc::new);
        self.bodies.borrow_mut().insert(frame, body.clone());
        body
    }

    /// Like [`body`](Self::body), but uncached, so that its hands can be shifted.
    pub(in crate::transcribe) fn look(&self, frame: usize) -> Option<Body<'a>> {
        let shapes = [0, 1].map(|n| {
            let track = self.scene.hands[n].as_ref()?;
            Some(self.shape(track, frame)?.best)
        });
        Body::of(self.scene, frame, shapes.each_ref().map(Option::as_ref))
    }

    /// Returns the handshape in a frame; computed once.
    fn shape(&self, track: &HandTrajectory, frame: usize) -> Option<Found<Handshape>> {
        let key = (track.side, frame);
        if let Some(known) = self.shapes.borrow().get(&key) {
            return known.clone();
        }
        let found = self
            .forms
            .nearest(&track.angles[frame], &track.known, self.scene.loose);
        self.shapes.borrow_mut().insert(key, found.clone());
        found
    }

    /// Reads shape, direction and palm of a hand in a frame.
    pub(in crate::transcribe) fn see(&self, track: &HandTrajectory, frame: usize) -> HandReading {
        let between = self.options.between;
        let along = track.along[frame];
        let shape = self.shape(track, frame);
        if !track.faces {
            return HandReading {
                shape,
                extended: aim::nearest(along, between),
                palm: None,
                beyond: 0.0,
            };
        }
        let turned = self.turned(track, frame, 1).swap_remove(0);
        HandReading {
            shape,
            extended: turned.extended,
            palm: Some(turned.palm),
            beyond: turned.beyond,
        }
    }

    /// Returns the likeliest orientations of a hand in a frame, at most `most` of them, the likeliest
    /// first.
    pub(in crate::transcribe) fn turned(
        &self,
        track: &HandTrajectory,
        frame: usize,
        most: usize,
    ) -> Vec<aim::Turned> {
        // The scene treats the dominant hand as a right one.
        let left = track.side != self.scene.dominant;
        let [shoulder, elbow] = track.arm[frame];
        let arm = [shoulder, elbow, track.wrist[frame]];
        let wrist = aim::Wrist::of(arm, left, self.scene.language);
        let how = aim::How {
            between: self.options.between,
            loose: self.scene.loose,
        };
        let (along, normal) = (track.along[frame], track.normal[frame]);
        aim::turned(along, normal, wrist.as_ref(), how, most)
    }
}
