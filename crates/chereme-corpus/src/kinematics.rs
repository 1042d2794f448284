//! Kinematic curves of the hands in part of a recording.

use std::ops::Range;

use chereme_analysis::kinematics::{ClipKinematicCurves, compute_kinematic_curves, find_speed_minima};
use chereme_compose::GeneratedCurve;
use chereme_motion::{FrameRate, TimeSpan};

use crate::Corpus;
use crate::curves;
use crate::error::CorpusResult;
use crate::movement::{ChannelGroup, MotionTrack};

/// The time around the requested frames that is read too, in seconds, so that curves of neighbouring parts fit
/// together.
const CURVE_MARGIN_SECONDS: f64 = 0.5;

/// Curves of a part of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct KinematicCurves {
    /// The range of frames, counted from the recording's first.
    pub frames: Range<usize>,
    /// The rate of the frames.
    pub rate: FrameRate,
    /// The time of the recording's first frame on its clock, in microseconds.
    pub offset_us: i64,
    /// A number for every frame, or `None` if the skeleton does not allow it to be computed.
    pub kinematics: ClipKinematicCurves,
    /// The frames at which either wrist is slowest between two strokes, in order.
    pub minima: Vec<usize>,
    /// The scalar curves that are stored beside the movement, such as those of its non-manuals.
    pub stored: Vec<GeneratedCurve>,
}

impl Corpus {
    /// Returns the curves for the frames that start within `span` of the recording of that row.
    ///
    /// # Errors
    /// Fails if there is no such recording, it holds no movement, or the database fails.
    pub fn load_kinematic_curves(&self, recording: i64, span: TimeSpan) -> CorpusResult<KinematicCurves> {
        let connection = self.store.read_connection();
        let track = MotionTrack::open_motion_track(connection, recording)?;
        let wanted = track.frames_in(span);
        let around = (CURVE_MARGIN_SECONDS * track.rate.per_second()).ceil() as usize;
        let end = (wanted.end + around).min(track.motion_frame_count());
        let read = wanted.start.saturating_sub(around)..end;
        let clip = track.read_motion_clip(connection, read.clone(), &ChannelGroup::ALL_CHANNEL_GROUPS)?;
        let all = compute_kinematic_curves(&clip, &track.track_anatomy(connection)?);
        let mut slow: Vec<usize> = all
            .hands
            .iter()
            .flat_map(|hand| find_speed_minima(&hand.speed))
            .map(|frame| frame + read.start)
            .filter(|frame| wanted.contains(frame))
            .collect();
        // Both wrists may be slowest in the same frame.
        slow.sort_unstable();
        slow.dedup();
        let inside = wanted.start - read.start..wanted.end - read.start;
        Ok(KinematicCurves {
            rate: track.rate,
            offset_us: track.row.offset_us,
            kinematics: cut_kinematics(all, &inside),
            minima: slow,
            stored: curves::of_track(connection, &track, wanted.clone())?,
            frames: wanted,
        })
    }
}

fn cut_kinematics(mut all: ClipKinematicCurves, inside: &Range<usize>) -> ClipKinematicCurves {
    fn cut_curve<T: Clone>(curve: &mut Vec<T>, inside: &Range<usize>) {
        *curve = curve.get(inside.clone()).map(<[T]>::to_vec).unwrap_or_default();
    }
    cut_curve(&mut all.distance, inside);
    for hand in &mut all.hands {
        cut_curve(&mut hand.speed, inside);
        cut_curve(&mut hand.aperture, inside);
        cut_curve(&mut hand.palm, inside);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ImportOptions, ProgressReceiver, ignore_progress_step, unpack_starter};
    use chereme_motion::RecordingInstant;

    #[test]
    fn curves_read_in_parts_equal_the_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = unpack_starter(&folder.path().join("files")).expect("unpacked");
        let phrase: Vec<_> = files.into_iter().filter(|it| it.ends_with("phrase.bvh")).collect();
        let mut corpus = Corpus::create_corpus(&folder.path().join("x.chereme"), "A").expect("made");
        let options = ImportOptions::default();
        let mut hear = ignore_progress_step;
        let mut progress = ProgressReceiver::new(&mut hear);
        corpus.import_paths(&phrase, &options, &mut progress).expect("imported");
        let recording = corpus.load_corpus_overview(0).expect("read").recordings[0].clone();
        let at = RecordingInstant::from_micros;
        let end = recording.row.duration_us;
        let of = |from, to| {
            corpus
                .load_kinematic_curves(recording.row.id, TimeSpan::span_between(at(from), at(to)))
                .expect("read")
        };
        let (whole, one, two) = (of(0, end), of(0, end / 2), of(end / 2, end));
        assert_eq!(whole.frames.len() as u64, recording.frames);
        assert_eq!(one.frames.end, two.frames.start);
        let speeds = |it: &KinematicCurves| it.kinematics.hands[0].speed.clone();
        let joined = [speeds(&one), speeds(&two)].concat();
        for (a, b) in joined.iter().zip(speeds(&whole)) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
        assert!(!whole.minima.is_empty());
        assert!(
            whole.kinematics.hands[0]
                .palm
                .iter()
                .all(|palm| (palm.length() - 1.0).abs() < 1e-6)
        );
        assert!(corpus.load_kinematic_curves(99, TimeSpan::default()).is_err());
    }
}
