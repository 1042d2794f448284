//! Movement of the displayed recording, loaded in pieces around the playhead.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use chereme_corpus::{DisplayedMovement, RecordingGlance};
use chereme_motion::{FacePosture, FrameRate, LocalPose, RecordingInstant, TimeSpan};

/// Frames per piece.
const REEL_PIECE_FRAMES: usize = 1200;
/// How many pieces are kept.
const MAX_KEPT_PIECES: usize = 12;

/// The movement of one recording, as far as it is loaded.
#[derive(Debug, Default)]
pub(crate) struct MovementReel {
    /// The recording's row id, number of frames and of its track's rows, frame rate, offset on the clock, and recipe.
    source: Option<ReelSource>,
    /// The piece that was loaded first; all pieces have the same skeleton and anatomy.
    first: Option<Arc<DisplayedMovement>>,
    pieces: BTreeMap<usize, Arc<DisplayedMovement>>,
    asked: BTreeSet<usize>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct ReelSource {
    recording: i64,
    frames: usize,
    rows: usize,
    rate: FrameRate,
    offset: i64,
    recipe: Option<String>,
}

impl MovementReel {
    /// Switches to a recording; loaded pieces stay if the movement is the same.
    pub(crate) fn load_recording_reel(&mut self, recording: Option<&RecordingGlance>) {
        let source = recording.and_then(|glance| {
            let shown = glance.shown_frames()?;
            Some(ReelSource {
                recording: glance.row.id,
                frames: usize::try_from(shown.frames).ok()?,
                rows: usize::try_from(shown.rows).ok()?,
                rate: shown.rate,
                offset: shown.offset_us,
                recipe: glance.recipe.clone(),
            })
        });
        // Another recipe or offset is another movement under the same id.
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
    pub(crate) fn reel_frame_count(&self) -> usize {
        self.source.as_ref().map_or(0, |source| source.frames)
    }

    /// Returns the number of the track's frame at a moment, counted from 1, and the number of all its frames.
    pub(crate) fn frame_number(&self, at: RecordingInstant) -> (usize, usize) {
        let Some(source) = &self.source else {
            return (0, 0);
        };
        let ReelSource { frames, rows, .. } = *source;
        (source.source_frame_at(at) * rows / frames.max(1) + 1, rows)
    }

    /// Returns the frame rate.
    pub(crate) fn reel_frame_rate(&self) -> Option<FrameRate> {
        self.source.as_ref().map(|source| source.rate)
    }

    /// Returns a loaded piece for its skeleton and anatomy.
    pub(crate) fn sample_piece(&self) -> Option<&Arc<DisplayedMovement>> {
        self.first.as_ref()
    }

    /// Returns the posture at a moment of the recording, if its piece is loaded.
    pub(crate) fn reel_pose_at(&self, at: RecordingInstant) -> Option<LocalPose> {
        let (moving, inside) = self.piece_at_instant(at)?;
        Some(moving.clip.sample_pose(inside))
    }

    /// Returns the face at that moment, if it is known.
    pub(crate) fn reel_face_at(&self, at: RecordingInstant) -> Option<FacePosture> {
        let (moving, inside) = self.piece_at_instant(at)?;
        FacePosture::face_at_moment(&moving.faces, moving.clip.clip_frame_rate(), inside)
    }

    /// Returns the loaded piece at a moment, and the moment relative to the piece's start.
    fn piece_at_instant(&self, at: RecordingInstant) -> Option<(&DisplayedMovement, RecordingInstant)> {
        let source = self.source.as_ref()?;
        let frame = source.source_frame_at(at);
        let moving = self.pieces.get(&(frame / REEL_PIECE_FRAMES))?;
        let start = source
            .rate
            .frame_start_instant(frame / REEL_PIECE_FRAMES * REEL_PIECE_FRAMES)
            .instant_micros();
        let inside = at.instant_micros() - source.offset - start;
        // A moment before the movement shows its first frame.
        Some((moving, RecordingInstant::from_micros(inside.max(0))))
    }

    /// Returns the next piece to load (recording, piece number, span) for a playhead at `at` that moves in `direction`,
    /// and marks the piece as requested.
    pub(crate) fn next_wanted_piece(&mut self, at: RecordingInstant, direction: f64) -> Option<(i64, usize, TimeSpan)> {
        let source = self.source.as_ref()?;
        let here = source.source_frame_at(at) / REEL_PIECE_FRAMES;
        let last = (source.frames - 1) / REEL_PIECE_FRAMES;
        let next = if direction < 0.0 {
            here.checked_sub(1)
        } else {
            Some(here + 1)
        };
        // The piece at the playhead first, then the one that it moves to.
        let piece = [Some(here), next]
            .into_iter()
            .flatten()
            .filter(|piece| *piece <= last)
            .find(|piece| !self.pieces.contains_key(piece) && !self.asked.contains(piece))?;
        self.asked.insert(piece);
        let frames = piece * REEL_PIECE_FRAMES..((piece + 1) * REEL_PIECE_FRAMES).min(source.frames);
        Some((
            source.recording,
            piece,
            source.rate.frame_range_span(frames).shifted_span(source.offset),
        ))
    }

    /// Stores a loaded piece; if there are too many, removes those farthest from it.
    pub(crate) fn put_loaded_piece(&mut self, recording: i64, piece: usize, moving: Arc<DisplayedMovement>) {
        // Another recording was opened while the piece was loaded.
        if self.source.as_ref().is_none_or(|source| source.recording != recording) {
            return;
        }
        self.asked.remove(&piece);
        self.first.get_or_insert_with(|| moving.clone());
        self.pieces.insert(piece, moving);
        while self.pieces.len() > MAX_KEPT_PIECES {
            // Farthest from the newest piece, which is where the playhead is.
            let far = self.pieces.keys().copied().max_by_key(|other| other.abs_diff(piece));
            self.pieces.remove(&far.unwrap_or(piece));
        }
    }
}

impl ReelSource {
    fn source_frame_at(&self, at: RecordingInstant) -> usize {
        let clip_time = RecordingInstant::from_micros((at.instant_micros() - self.offset).max(0));
        self.rate.nearest_frame_at(clip_time).min(self.frames - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::{RecordingRow, RecordingStretch};
    use chereme_motion::{BodyAnatomy, Clip, Skeleton, SkeletonJoint, glam::DVec3};

    fn glance(frames: u64) -> RecordingGlance {
        let row = RecordingRow {
            id: 7,
            name: "r".into(),
            signer_id: None,
            signer: None,
            origin: chereme_corpus::RecordOrigin::Captured,
            duration_us: 1,
            licence: None,
            notes: None,
        };
        let rate = FrameRate::new(100, 1).ok();
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

    fn piece(reel: &mut MovementReel, at: i64) -> Option<(usize, TimeSpan)> {
        reel.next_wanted_piece(RecordingInstant::from_micros(at), 1.0)
            .map(|(_, piece, span)| (piece, span))
    }

    #[test]
    fn pieces_around_the_playhead_are_asked_for_once_and_cover_every_frame() {
        let mut reel = MovementReel::default();
        reel.load_recording_reel(Some(&glance(3000)));
        let span = |start, end| TimeSpan::from_span_micros(start, end);
        assert_eq!(piece(&mut reel, 0), Some((0, span(500_000, 12_500_000))));
        assert_eq!(piece(&mut reel, 0), Some((1, span(12_500_000, 24_500_000))));
        assert_eq!(piece(&mut reel, 0), None);
        assert_eq!(piece(&mut reel, 99_000_000), Some((2, span(24_500_000, 30_500_000))));
        assert_eq!(piece(&mut reel, 99_000_000), None);
        reel.load_recording_reel(Some(&glance(0)));
        assert!(!reel.has_movement());
        let face = chereme_corpus::ShownFrames {
            frames: 60,
            rows: 31,
            rate: FrameRate::new(30, 1).expect("a rate"),
            offset_us: 1_000_000,
        };
        reel.load_recording_reel(Some(&RecordingGlance {
            face_alone: Some(face),
            ..glance(0)
        }));
        assert!(reel.has_movement(), "a face alone is shown, too");
        let number = |at| reel.frame_number(RecordingInstant::from_micros(at));
        assert_eq!([0, 2_000_000, 9_000_000].map(number), [(1, 31), (16, 31), (31, 31)]);
        assert_eq!(piece(&mut reel, 0), Some((0, span(1_000_000, 3_000_000))));
    }

    #[test]
    fn the_posture_matches_the_moment() {
        let joint = SkeletonJoint::new("root", None, DVec3::ZERO);
        let skeleton: Arc<Skeleton> = Skeleton::new(vec![joint]).expect("a skeleton").into();
        let rate = FrameRate::new(100, 1).expect("a rate");
        let poses: Vec<LocalPose> = (0..600)
            .map(|frame| {
                let mut pose = Clip::from_rest_pose(skeleton.clone(), rate, 1).clip_pose_at(0);
                pose.translations[0].x = f64::from(1200 + frame);
                pose
            })
            .collect();
        let clip = Clip::from_poses(skeleton.clone(), rate, &poses).expect("a clip");
        let stretch = RecordingStretch {
            recording: glance(1).row,
            span: TimeSpan::default(),
            token: None,
        };
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        let mut reel = MovementReel::default();
        reel.load_recording_reel(Some(&glance(1800)));
        reel.put_loaded_piece(
            7,
            1,
            Arc::new(DisplayedMovement {
                stretch,
                clip,
                anatomy,
                faces: Vec::new(),
            }),
        );
        let x = |reel: &MovementReel, at| {
            reel.reel_pose_at(RecordingInstant::from_micros(at))
                .map(|it| it.translations[0].x)
        };
        assert_eq!(x(&reel, 12_500_000), Some(1200.0));
        assert_eq!(x(&reel, 15_500_000), Some(1500.0));
        assert_eq!(x(&reel, 1_000_000), None);
        reel.put_loaded_piece(8, 0, reel.sample_piece().expect("one").clone());
        assert_eq!(reel.pieces.len(), 1);
    }
}
