//! Movement of the displayed recording, loaded in pieces around the playhead.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use chereme_corpus::{Moving, RecordingGlance};
use chereme_motion::{Face, Instant, Pose, Rate, Span};

/// Frames per piece.
const PIECE: usize = 1200;
/// How many pieces are kept.
const KEPT: usize = 12;

/// The movement of one recording, as far as it is loaded.
#[derive(Debug, Default)]
pub(crate) struct Reel {
    /// The recording's row id, number of frames and of its track's rows, frame rate, offset on the clock, and recipe.
    source: Option<Source>,
    /// The piece that was loaded first; all pieces have the same skeleton and anatomy.
    first: Option<Arc<Moving>>,
    pieces: BTreeMap<usize, Arc<Moving>>,
    asked: BTreeSet<usize>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Source {
    recording: i64,
    frames: usize,
    rows: usize,
    rate: Rate,
    offset: i64,
    recipe: Option<String>,
}

impl Reel {
    /// Switches to a recording; loaded pieces stay if the movement is the same.
    pub(crate) fn load(&mut self, recording: Option<&RecordingGlance>) {
        let source = recording.and_then(|it| {
            let shown = it.shown()?;
            Some(Source {
                recording: it.row.id,
                frames: usize::try_from(shown.frames).ok()?,
                rows: usize::try_from(shown.rows).ok()?,
                rate: shown.rate,
                offset: shown.offset_us,
                recipe: it.recipe.clone(),
            })
        });
        if source != self.source {
            *self = Self {
                source,
                ..Self::default()
            };
        }
    }

    /// Returns whether the recording has movement.
    pub(crate) fn has_movement(&self) -> bool {
        self.source.is_some()
    }

    /// Returns the number of frames.
    pub(crate) fn frames(&self) -> usize {
        self.source.as_ref().map_or(0, |source| source.frames)
    }

    /// Returns the number of the track's frame at a moment, counted from 1, and the number of all its frames.
    pub(crate) fn frame_number(&self, at: Instant) -> (usize, usize) {
        let Some(source) = &self.source else {
            return (0, 0);
        };
        let Source { frames, rows, .. } = *source;
        (source.frame(at) * rows / frames.max(1) + 1, rows)
    }

    /// Returns the frame rate.
    pub(crate) fn rate(&self) -> Option<Rate> {
        self.source.as_ref().map(|source| source.rate)
    }

    /// Returns a loaded piece for its skeleton and anatomy.
    pub(crate) fn sample(&self) -> Option<&Arc<Moving>> {
        self.first.as_ref()
    }

    /// Returns the posture at a moment of the recording, if its piece is loaded.
    pub(crate) fn pose(&self, at: Instant) -> Option<Pose> {
        let (moving, inside) = self.piece(at)?;
        Some(moving.clip.sample(inside))
    }

    /// Returns the face at that moment, if it is known.
    pub(crate) fn face(&self, at: Instant) -> Option<Face> {
        let (moving, inside) = self.piece(at)?;
        Face::at(&moving.faces, moving.clip.rate(), inside)
    }

    /// Returns the loaded piece at a moment, and the moment relative to the piece's start.
    fn piece(&self, at: Instant) -> Option<(&Moving, Instant)> {
        let source = self.source.as_ref()?;
        let frame = source.frame(at);
        let moving = self.pieces.get(&(frame / PIECE))?;
        let start = source.rate.instant(frame / PIECE * PIECE).micros();
        let inside = at.micros() - source.offset - start;
        Some((moving, Instant::from_micros(inside.max(0))))
    }

    /// Returns the next piece to load (recording, piece number, span) for a playhead at `at` that moves in `direction`,
    /// and marks the piece as requested.
    pub(crate) fn wanted(&mut self, at: Instant, direction: f64) -> Option<(i64, usize, Span)> {
        let source = self.source.as_ref()?;
        let here = source.frame(at) / PIECE;
        let last = (source.frames - 1) / PIECE;
        let next = if direction < 0.0 {
            here.checked_sub(1)
        } else {
            Some(here + 1)
        };
        let piece = [Some(here), next]
            .into_iter()
            .flatten()
            .filter(|piece| *piece <= last)
            .find(|piece| !self.pieces.contains_key(piece) && !self.asked.contains(piece))?;
        self.asked.insert(piece);
        let frames = piece * PIECE..((piece + 1) * PIECE).min(source.frames);
        Some((
            source.recording,
            piece,
            source.rate.span(frames).shifted(source.offset),
        ))
    }

    /// Stores a loaded piece; if there are too many, removes those farthest from it.
    pub(crate) fn put(&mut self, recording: i64, piece: usize, moving: Arc<Moving>) {
        if self
            .source
            .as_ref()
            .is_none_or(|source| source.recording != recording)
        {
            return;
        }
        self.asked.remove(&piece);
        self.first.get_or_insert_with(|| moving.clone());
        self.pieces.insert(piece, moving);
        while self.pieces.len() > KEPT {
            let far = self
                .pieces
                .keys()
                .copied()
                .max_by_key(|it| it.abs_diff(piece));
            self.pieces.remove(&far.unwrap_or(piece));
        }
    }
}

impl Source {
    fn frame(&self, at: Instant) -> usize {
        let own = Instant::from_micros((at.micros() - self.offset).max(0));
        self.rate.frame_at(own).min(self.frames - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::{RecordingRow, Stretch};
    use chereme_motion::{Anatomy, Clip, Joint, Skeleton, glam::DVec3};

    fn glance(frames: u64) -> RecordingGlance {
        let row = RecordingRow {
            id: 7,
            name: "r".into(),
            signer_id: None,
            signer: None,
            origin: chereme_corpus::Origin::Captured,
            duration_us: 1,
            licence: None,
            notes: None,
        };
        let rate = Rate::new(100, 1).ok();
        RecordingGlance {
            row,
            frames,
            rate,
            offset_us: 500_000,
            kinds: Vec::new(),
            tiers: 0,
            tokens: 0,
            recipe: None,
            face_alone: None,
        }
    }

    fn piece(reel: &mut Reel, at: i64) -> Option<(usize, Span)> {
        reel.wanted(Instant::from_micros(at), 1.0)
            .map(|(_, piece, span)| (piece, span))
    }

    #[test]
    fn pieces_around_the_playhead_are_asked_for_once_and_cover_every_frame() {
        let mut reel = Reel::default();
        reel.load(Some(&glance(3000)));
        let span =
            |start, end| Span::between(Instant::from_micros(start), Instant::from_micros(end));
        assert_eq!(piece(&mut reel, 0), Some((0, span(500_000, 12_500_000))));
        assert_eq!(piece(&mut reel, 0), Some((1, span(12_500_000, 24_500_000))));
        assert_eq!(piece(&mut reel, 0), None);
        assert_eq!(
            piece(&mut reel, 99_000_000),
            Some((2, span(24_500_000, 30_500_000)))
        );
        assert_eq!(piece(&mut reel, 99_000_000), None);
        reel.load(Some(&glance(0)));
        assert!(!reel.has_movement());
        let face = chereme_corpus::ShownFrames {
            frames: 60,
            rows: 31,
            rate: Rate::new(30, 1).expect("a rate"),
            offset_us: 1_000_000,
        };
        reel.load(Some(&RecordingGlance {
            face_alone: Some(face),
            ..glance(0)
        }));
        assert!(reel.has_movement(), "a face alone is shown, too");
        let number = |at| reel.frame_number(Instant::from_micros(at));
        assert_eq!(
            [0, 2_000_000, 9_000_000].map(number),
            [(1, 31), (16, 31), (31, 31)]
        );
        assert_eq!(piece(&mut reel, 0), Some((0, span(1_000_000, 3_000_000))));
    }

    #[test]
    fn the_posture_matches_the_moment() {
        let joint = Joint::new("root", None, DVec3::ZERO);
        let skeleton: Arc<Skeleton> = Skeleton::new(vec![joint]).expect("a skeleton").into();
        let rate = Rate::new(100, 1).expect("a rate");
        let poses: Vec<Pose> = (0..600)
            .map(|frame| {
                let mut pose = Clip::still(skeleton.clone(), rate, 1).pose(0);
                pose.translations[0].x = f64::from(1200 + frame);
                pose
            })
            .collect();
        let clip = Clip::from_poses(skeleton.clone(), rate, &poses).expect("a clip");
        let stretch = Stretch {
            recording: glance(1).row,
            span: Span::default(),
            token: None,
        };
        let anatomy = Anatomy::detect(&skeleton);
        let mut reel = Reel::default();
        reel.load(Some(&glance(1800)));
        reel.put(
            7,
            1,
            Arc::new(Moving {
                stretch,
                clip,
                anatomy,
                faces: Vec::new(),
            }),
        );
        let x = |reel: &Reel, at| {
            reel.pose(Instant::from_micros(at))
                .map(|it| it.translations[0].x)
        };
        assert_eq!(x(&reel, 12_500_000), Some(1200.0));
        assert_eq!(x(&reel, 15_500_000), Some(1500.0));
        assert_eq!(x(&reel, 1_000_000), None);
        reel.put(8, 0, reel.sample().expect("one").clone());
        assert_eq!(reel.pieces.len(), 1);
    }
}
