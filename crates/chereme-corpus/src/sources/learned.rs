//! The numbers that recipes learn from the whole corpus: the usual course of its transitions, and the usual times
//! of its handshapes.

pub(crate) mod language;

use chereme_analysis::strokes::{Mover, strokes};
use chereme_compose::{
    CourseLearner, LearnedCourse, LearnedProfile, MedianTime, SpellingTimes, Stretch,
};
use chereme_motion::Side;
use chereme_sign::TierRole;
use rusqlite::Connection;

use crate::db::columns::Origin;
use crate::db::{recordings, tiers};
use crate::error::Result;
use crate::inventories::StoredInventory;
use crate::movement::{BLOCK_FRAMES, ChannelGroup, Track};

/// The frames that are read in one piece, and the most pieces of a corpus: about half a minute of movement each;
/// hundred thousand frames take a second.
const PIECE: usize = 4 * BLOCK_FRAMES;
const MOST_PIECES: usize = 32;
/// With fewer transitions than these there is no usual course, with fewer times no usual time.
const FEWEST_TRANSITIONS: usize = 8;
const FEWEST_TIMES: usize = 5;
/// The most annotations of handshapes that are looked at.
const MOST_SPANS: usize = 50_000;
/// Handshapes farther apart than this do not follow one another, in microseconds.
const APART: i64 = 1_000_000;

/// Returns the usual courses of the wrists' and the fingers' transitions: in captured recordings with
/// glosses, which are of signing; else in other captured ones, else in generated movement; never in what
/// recipes made. Each course names its recordings.
///
/// Of a large corpus pieces are taken that lie evenly over it, so that the time is bounded.
pub(super) fn profile(connection: &Connection) -> Result<Option<LearnedProfile>> {
    let mut learners = [
        (Mover::Wrist, CourseLearner::default(), Vec::new()),
        (Mover::Fingers, CourseLearner::default(), Vec::new()),
    ];
    for (recording, first) in pieces(connection)? {
        let track = Track::of(connection, recording)?;
        let limbs = [
            ChannelGroup::RightHand,
            ChannelGroup::LeftHand,
            ChannelGroup::RightArm,
            ChannelGroup::LeftArm,
        ];
        let clip = track.clip(connection, first..first + PIECE, &limbs)?;
        let anatomy = track.anatomy(connection)?;
        let name = recordings::recording(connection, recording)?.name;
        for side in Side::BOTH {
            for (mover, learner, names) in &mut learners {
                let joints = mover.joints(&anatomy, side);
                for frames in strokes(&clip, &anatomy, side, *mover) {
                    let told = learner.add(&Stretch {
                        clip: &clip,
                        joints: &joints,
                        frames,
                    });
                    if told && !names.contains(&name) {
                        names.push(name.clone());
                    }
                }
            }
        }
    }
    let [arms, fingers] = learners.map(|(_, learner, recordings)| {
        let transitions = learner.transitions();
        let shares = learner
            .course()
            .filter(|_| transitions >= FEWEST_TRANSITIONS)?;
        Some(LearnedCourse {
            shares,
            transitions,
            recordings,
        })
    });
    let known = arms.is_some() || fingers.is_some();
    Ok(known.then_some(LearnedProfile { arms, fingers }))
}

/// Returns the recordings and first frames of the pieces that are looked at.
fn pieces(connection: &Connection) -> Result<Vec<(i64, usize)>> {
    let all = recordings::recordings(connection)?;
    for (origin, signing) in [
        (Origin::Captured, true),
        (Origin::Captured, false),
        (Origin::Generated, false),
    ] {
        let mut pieces = Vec::new();
        for recording in all.iter().filter(|it| it.origin == origin) {
            if signing && !has_glosses(connection, recording.id)? {
                continue;
            }
            let Some(track) = recordings::body_track(connection, recording.id)? else {
                continue;
            };
            let frames = usize::try_from(track.frames).unwrap_or_default();
            pieces.extend((0..frames).step_by(PIECE).map(|at| (recording.id, at)));
        }
        if !pieces.is_empty() {
            let count = pieces.len().min(MOST_PIECES);
            let spread = (0..count).map(|n| pieces[n * pieces.len() / count]);
            return Ok(spread.collect());
        }
    }
    Ok(Vec::new())
}

/// Returns whether a recording has a tier of glosses, as recordings of signing have.
fn has_glosses(connection: &Connection, recording: i64) -> Result<bool> {
    let tiers = tiers::tiers(connection, recording)?;
    Ok(tiers.iter().any(|tier| tier.role == TierRole::Gloss))
}

/// Returns how long hands hold a handshape that follows or precedes another within a second on the
/// same tier, and the time between the two; never of what recipes made.
///
/// Handshapes of letters count alone where there are enough: fingerspelling is faster than signing.
pub(super) fn spelling_times(
    connection: &Connection,
    inventories: &[StoredInventory],
) -> Result<SpellingTimes> {
    let spans = tiers::configuration_spans(connection, MOST_SPANS)?;
    let is_letter = |value: &str| {
        inventories.iter().any(|it| {
            let known = it.inventory.find(value.trim());
            known.is_some_and(|value| value.letter.is_some())
        })
    };
    let (mut holds, mut changes) = (Times::default(), Times::default());
    let mut counted = None;
    for (n, two) in spans.windows(2).enumerate() {
        let [a, b] = two else { continue };
        let gap = b.start_us - a.end_us;
        if a.tier_id != b.tier_id || a.value == b.value || !(0..=APART).contains(&gap) {
            continue;
        }
        let letters = [a, b].map(|span| is_letter(&span.value));
        if counted != Some(n) {
            holds.add(a.end_us - a.start_us, letters[0]);
        }
        holds.add(b.end_us - b.start_us, letters[1]);
        counted = Some(n + 1);
        if gap > 0 {
            changes.add(gap, letters[0] && letters[1]);
        }
    }
    Ok(SpellingTimes {
        hold: holds.median(),
        change: changes.median(),
    })
}

/// Times in microseconds: all of them, and those of letters.
#[derive(Default)]
struct Times {
    all: Vec<i64>,
    letters: Vec<i64>,
}

impl Times {
    fn add(&mut self, micros: i64, letter: bool) {
        self.all.push(micros);
        if letter {
            self.letters.push(micros);
        }
    }

    fn median(self) -> Option<MedianTime> {
        let enough = |times: &Vec<i64>| times.len() >= FEWEST_TIMES;
        let mut times = [self.letters, self.all].into_iter().find(enough)?;
        times.sort_unstable();
        let (count, middle) = (times.len(), times.len() / 2);
        let sum = times[middle] + times[(count - 1) / 2];
        Some(MedianTime {
            seconds: sum as f64 * 0.5e-6,
            count,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_alone_count_where_they_are_enough() {
        let mut times = Times::default();
        for micros in [900_000, 800_000, 700_000, 600_000] {
            times.add(micros, false);
        }
        for micros in [200_000, 100_000, 300_000, 400_000] {
            times.add(micros, true);
        }
        let all = times.median().expect("enough");
        assert_eq!((all.seconds, all.count), (0.5, 8));
        let mut times = Times::default();
        times.add(5_000_000, false);
        for micros in [100_000, 200_000, 300_000, 400_000, 500_000] {
            times.add(micros, true);
        }
        let letters = times.median().expect("enough");
        assert_eq!((letters.seconds, letters.count), (0.3, 5));
        assert_eq!(Times::default().median(), None);
    }

    #[test]
    fn the_starter_corpus_teaches_courses_and_times() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = folder.path().join("starter");
        crate::unpack_starter(&files).expect("unpacked");
        let path = folder.path().join("c.chereme");
        let mut corpus = crate::Corpus::create(&path, "A").expect("made");
        let empty = corpus
            .preview("spell OR via learned")
            .expect_err("no movement to learn from");
        let told = "too few transitions";
        assert!(empty.to_string().contains(told), "{empty}");
        let mut hear = crate::unheard;
        corpus
            .import(
                &[files],
                &crate::ImportOptions::default(),
                &mut crate::Progress::new(&mut hear),
            )
            .expect("imported");
        let made = corpus
            .recombine("spell OR via learned", "OR")
            .expect("made");
        let told = made.report.steps[0].did.join("\n");
        for want in [
            "0.25 s, the median of 30",
            "0.27 s, the median of 25",
            "transitions of arms in ",
        ] {
            assert!(told.contains(want), "{told}");
        }
        let again = corpus.preview("spell OR via learned").expect("made");
        assert_eq!(again.clip, made.clip, "what was made does not teach");
        let recording = made.recording.expect("stored");
        let stored = crate::db::recipes::of_recording(corpus.store.read(), recording);
        let document = stored.expect("read").expect("kept").document;
        assert!(document.contains("\"transitions\"") && document.contains("\"seconds\""));
    }
}
