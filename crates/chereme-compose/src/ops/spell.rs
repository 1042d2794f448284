//! `spell`: generates a word in a manual alphabet, on a body at rest.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodySide, TimeSpan};
use chereme_sign::{ComponentReading, SignComponent};

use crate::answers::{AnswerSlot, CorpusAsker, NodeAnswers};
use crate::body::SignerFrame;
use crate::course::{TransitionCourse, TransitionCourses};
use crate::error::StepError;
use crate::ops::{StepOutcome, join, place_operator};
use crate::outcome::{GeneratedNote, NoteSubject};
use crate::recipe_inputs::{LetterInput, MaterialInput};
use crate::recipe_settings::{SpellSettings, TransitionProfile};
use crate::sources::{LearnedProfile, MaterialSigner, MedianTime, SpellingTimes};
use crate::units::RecipeSeconds;
use crate::work::{JointGroup, WorkingClip};
use crate::{arm, poses};

/// The body that spells.
pub(crate) const SPELL_BODY_SLOT: AnswerSlot<MaterialInput> = AnswerSlot::new("spell");
/// The letters with their postures.
const SPELL_LETTERS_SLOT: AnswerSlot<Vec<LetterInput>> = AnswerSlot::new("spell/word");
/// The times for which the corpus's hands hold letters and change between them.
const SPELL_TIMES_SLOT: AnswerSlot<SpellingTimes> = AnswerSlot::new("spell/hold");
/// The learned courses from letter to letter.
const SPELL_COURSE_SLOT: AnswerSlot<LearnedProfile> = AnswerSlot::new("spell/via");

/// Asks for the body, the letters and the times of a word.
pub(crate) fn resolve_spelling_inputs(
    settings: &SpellSettings,
    ask: &mut CorpusAsker<'_>,
) -> Result<MaterialSigner, StepError> {
    let setting = ask.ask_signer_body(&SPELL_BODY_SLOT, settings.on.as_deref())?;
    let side = settings.hand.chosen_sides(setting.handedness)[0];
    let letters = ask
        .sources
        .find_alphabet_letters(settings.alphabet.as_deref(), &settings.word)?;
    let mut letter_inputs = Vec::with_capacity(letters.len());
    for letter in letters {
        let pose = poses::of_value(ask.sources, &letter.value, side, &setting)?;
        letter_inputs.push(LetterInput { letter, pose });
    }
    if letter_inputs.is_empty() {
        return Err(StepError::Empty(settings.word.clone()));
    }
    ask.put_answer(&SPELL_LETTERS_SLOT, letter_inputs);
    if settings.hold.is_none() || settings.via.time.is_none() {
        let times = ask.sources.spelling_times()?;
        ask.put_answer(&SPELL_TIMES_SLOT, times);
    }
    ask.ask_learned_courses(&SPELL_COURSE_SLOT, &settings.via)?;
    Ok(setting)
}

/// Generates the movement of a word.
pub(crate) fn generate_spelling(
    settings: &SpellSettings,
    given: &mut NodeAnswers<'_>,
) -> Result<(WorkingClip, StepOutcome), StepError> {
    let mut work = WorkingClip::working_clip_from(given.answered_material(&SPELL_BODY_SLOT)?);
    let letters = given.required_answer(&SPELL_LETTERS_SLOT)?;
    let course = given.transition_courses(&SPELL_COURSE_SLOT, &settings.via, TransitionProfile::Sigmoid)?;
    let times = LetterTimes::letter_times_from(settings, given.get_answer(&SPELL_TIMES_SLOT));
    let done = spell_letters(&mut work, settings, letters, &times, &course)?;
    Ok((work, done))
}

/// The usual time of a held letter, in seconds.
const LETTER_HOLD_S: f64 = 0.2;
/// The usual time of the change from letter to letter, in seconds.
const LETTER_CHANGE_S: f64 = 0.25;
/// The longest plausible time of either from a corpus, in seconds.
const MAX_LETTER_TIME_S: f64 = 60.0;
/// The time of one stroke of a letter that moves, in seconds.
const LETTER_STROKE_S: f64 = 0.3;
/// The distance by which the hand slides outwards for the second of two equal letters, in shoulder widths.
const DOUBLE_LETTER_SLIDE: f64 = 0.12;
/// The position of the spelling wrist: to the hand's own side, up and forward of the middle between the shoulders, in
/// shoulder widths; in front of the shoulder, with the hand at the height of the chin.
const SPELLING_WRIST_POSITION: [f64; 3] = [0.6, -0.25, 0.85];

/// A span of time in which the hand shows one letter.
struct LetterShow {
    frames: std::ops::Range<usize>,
    fingers: Vec<(usize, DQuat)>,
    /// The wrist's position and the hand's rotation at the start of the span and after each stroke.
    keys: Vec<(DVec3, DQuat)>,
}

/// The times of a held letter and of the change to the next, in seconds.
pub(crate) struct LetterTimes {
    hold: f64,
    change: f64,
    report: Vec<String>,
}

impl LetterTimes {
    /// Takes each time from the recipe, else from the corpus, else the default one.
    pub(crate) fn letter_times_from(settings: &SpellSettings, corpus: Option<&SpellingTimes>) -> Self {
        let mut report = Vec::new();
        let mut time = |what, asked: Option<RecipeSeconds>, found: Option<MedianTime>, usual: f64| {
            if let Some(asked) = asked {
                return asked.0;
            }
            let corpus_time = found.filter(|found| (0.0..=MAX_LETTER_TIME_S).contains(&found.seconds));
            let time = corpus_time.map_or(usual, |found| found.seconds);
            report.push(match corpus_time {
                Some(found) => {
                    format!("{what} {time:.2} s, the median of {} in the corpus", found.count)
                }
                None => format!("{what} {time:.2} s: the corpus shows too few to learn from"),
            });
            time
        };
        let corpus = corpus.copied().unwrap_or_default();
        let asked = settings.via.time;
        Self {
            hold: time("letters are held for", settings.hold, corpus.hold, LETTER_HOLD_S),
            change: time("from letter to letter it takes", asked, corpus.change, LETTER_CHANGE_S),
            report,
        }
    }
}

/// Spells on the body of `work`, whose first frame is its posture.
pub(crate) fn spell_letters(
    work: &mut WorkingClip,
    settings: &SpellSettings,
    letters: &[LetterInput],
    times: &LetterTimes,
    courses: &TransitionCourses,
) -> Result<StepOutcome, StepError> {
    let sides = settings.hand.chosen_sides(work.handedness);
    let frame = place_operator::signer_body_frame(work, sides)?;
    let shown: Vec<Vec<LetterShow>> = sides
        .iter()
        .map(|&side| plan_letter_shows(work, &frame, side, times, letters))
        .collect::<Result<_, _>>()?;
    let frames = shown[0].last().map_or(1, |show| show.frames.end);
    join::check_length(work, frames)?;
    work.resample_channels(&vec![0.0; frames]);
    // The notes of the body whose posture it is say nothing of the letters.
    work.notes.clear();
    let mut residual: f64 = 0.0;
    for (&side, shows) in sides.iter().zip(&shown) {
        spell_with_fingers(work, side, shows, &courses.fingers);
        let path: Vec<(DVec3, DQuat)> = (0..frames)
            .map(|f| spelling_wrist_pose(shows, f, &courses.arms))
            .collect();
        let (targets, hands): (Vec<DVec3>, Vec<DQuat>) = path.into_iter().unzip();
        let reach = arm::raise_arm(work, side, &targets, &hands, frame.left * side.side_sign());
        residual = residual.max(reach.ok_or(StepError::NoArm(side))?.residual);
        write_letter_notes(work, side, shows, letters);
    }
    work.notes.push(GeneratedNote {
        hand: None,
        about: NoteSubject::Gloss,
        value: ComponentReading::Value(settings.word.clone()),
        span: work.working_clip_span(),
        origin: settings.to_string(),
    });
    let groups = sides.iter().flat_map(|&s| [JointGroup::Arm(s), JointGroup::Fingers(s)]);
    work.note_changed_groups(groups.collect::<Vec<_>>(), &settings.to_string());
    let from = letters
        .iter()
        .map(|l| format!("{} from {}", l.letter.letter, l.pose.origin));
    let report = from.chain(times.report.iter().cloned());
    Ok(StepOutcome::with_residual(report.collect(), residual))
}

fn plan_letter_shows(
    work: &WorkingClip,
    frame: &SignerFrame,
    side: BodySide,
    times: &LetterTimes,
    letters: &[LetterInput],
) -> Result<Vec<LetterShow>, StepError> {
    let frames = |seconds: f64| ((seconds / work.rate.frame_time()).round() as usize).max(1);
    let (hold, change) = (frames(times.hold), frames(times.change));
    let hand_vector = |v: [f64; 3]| {
        // Letters are described for a right hand; a left one mirrors them.
        let x = if side == BodySide::Left { -v[0] } else { v[0] };
        frame.model_direction_of(DVec3::new(x, v[1], v[2]))
    };
    let outside = frame.left * side.side_sign();
    let seat = frame.origin
        + (outside * SPELLING_WRIST_POSITION[0]
            + DVec3::Y * SPELLING_WRIST_POSITION[1]
            + frame.forward * SPELLING_WRIST_POSITION[2])
            * frame.shoulders;
    let mut shows: Vec<LetterShow> = Vec::with_capacity(letters.len());
    let (mut start, mut slid) = (0, DVec3::ZERO);
    for (n, input) in letters.iter().enumerate() {
        let letter = &input.letter;
        let pose_rotations = poses::hand_pose_rotations(&work.skeleton, &work.anatomy, side, &input.pose);
        let joints = pose_rotations.ok_or(StepError::NoFingers(side))?;
        if n > 0 && letters[n - 1].letter.letter == letter.letter {
            slid += outside * (DOUBLE_LETTER_SLIDE * frame.shoulders);
        }
        let direction = hand_vector(letter.fingers.unwrap_or([0.0, 1.0, 0.0]));
        let palm = hand_vector(letter.palm.unwrap_or([0.0, 0.0, 1.0]));
        let rotation = work.anatomy.hand_rotation(side, direction, palm);
        let mut key = (seat + slid, rotation.ok_or(StepError::NoFingers(side))?);
        let mut keys = vec![key];
        for stroke in &letter.strokes {
            // Turns are described for a right hand; a left one turns the other way.
            let about = direction.normalize_or(DVec3::Y) * -side.side_sign();
            key.0 += hand_vector(stroke.displacement) * frame.shoulders;
            key.1 = DQuat::from_axis_angle(about, stroke.turn) * key.1;
            keys.push(key);
        }
        let drawn = frames(LETTER_STROKE_S) * letter.strokes.len();
        // Drawing a letter may take longer than holding one.
        let end = start + hold.max(drawn);
        shows.push(LetterShow {
            frames: start..end,
            fingers: joints,
            keys,
        });
        start = end + change;
    }
    Ok(shows)
}

fn spell_with_fingers(work: &mut WorkingClip, side: BodySide, shows: &[LetterShow], course: &TransitionCourse) {
    for joint in work.anatomy.finger_joints(side) {
        let value = |show: &LetterShow| show.fingers.iter().find(|(j, _)| *j == joint).map(|f| f.1);
        let column = &mut work.channels[joint].rotations;
        for (n, show) in shows.iter().enumerate() {
            let Some(here) = value(show) else { continue };
            column[show.frames.clone()].fill(here);
            let Some((next, there)) = shows.get(n + 1).and_then(|s| Some((s, value(s)?))) else {
                continue;
            };
            let gap = show.frames.end..next.frames.start;
            let steps = (gap.len() + 1) as f64;
            for (n, frame) in gap.enumerate() {
                column[frame] = course.rotation_along_course(here, there, (n + 1) as f64 / steps);
            }
        }
    }
}

/// Returns the wrist's position and the hand's rotation at a frame.
fn spelling_wrist_pose(shows: &[LetterShow], frame: usize, course: &TransitionCourse) -> (DVec3, DQuat) {
    let n = shows
        .partition_point(|show| show.frames.start <= frame)
        .saturating_sub(1);
    let show = &shows[n];
    let last = show.keys.len() - 1;
    if frame < show.frames.end {
        if last == 0 {
            return show.keys[0];
        }
        let key_position = (frame - show.frames.start) as f64 / show.frames.len() as f64 * last as f64;
        let key = (key_position.floor() as usize).min(last - 1);
        return blend_wrist_poses(show.keys[key], show.keys[key + 1], key_position - key as f64, course);
    }
    let Some(next) = shows.get(n + 1) else {
        return show.keys[last];
    };
    let steps = (next.frames.start - show.frames.end + 1) as f64;
    let w = (frame - show.frames.end + 1) as f64 / steps;
    blend_wrist_poses(show.keys[last], next.keys[0], w, course)
}

fn blend_wrist_poses(a: (DVec3, DQuat), b: (DVec3, DQuat), w: f64, course: &TransitionCourse) -> (DVec3, DQuat) {
    (
        a.0.lerp(b.0, course.covered_path_share(w)),
        course.rotation_along_course(a.1, b.1, w),
    )
}

fn write_letter_notes(work: &mut WorkingClip, side: BodySide, shows: &[LetterShow], letters: &[LetterInput]) {
    for (show, input) in shows.iter().zip(letters) {
        let span: TimeSpan = work.rate.frame_range_span(show.frames.clone());
        work.notes.push(GeneratedNote {
            hand: Some(side),
            about: NoteSubject::Component(SignComponent::Configuration, None),
            value: ComponentReading::Value(input.letter.value.id.clone()),
            span,
            origin: input.pose.origin.to_string(),
        });
    }
}
