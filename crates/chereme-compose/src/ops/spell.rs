//! `spell`: generates a word in a manual alphabet, on a body at rest.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Side, Span};
use chereme_sign::{Component, Reading};

use crate::answers::{Ask, Given, Setting, Slot};
use crate::arm;
use crate::body::Frame;
use crate::course::{Course, Courses};
use crate::error::Cause;
use crate::ops::Done;
use crate::ops::{join, place};
use crate::outcome::{About, Note};
use crate::poses;
use crate::recipe::Profile;
use crate::recipe::Spell;
use crate::resolve::LetterInput;
use crate::resolve::MaterialInput;
use crate::sources::LearnedProfile;
use crate::sources::{MedianTime, SpellingTimes};
use crate::units::Seconds;
use crate::work::{Group, Work};

/// The body that spells.
pub(crate) const BODY: Slot<MaterialInput> = Slot::new("spell");
/// The letters with their postures.
const LETTERS: Slot<Vec<LetterInput>> = Slot::new("spell/word");
/// The times for which the corpus's hands hold letters and change between them.
const TIMES: Slot<SpellingTimes> = Slot::new("spell/hold");
/// The learned courses from letter to letter.
const VIA: Slot<LearnedProfile> = Slot::new("spell/via");

/// Asks for the body, the letters and the times of a word.
pub(crate) fn resolve(settings: &Spell, ask: &mut Ask<'_>) -> Result<Setting, Cause> {
    let setting = ask.body(&BODY, settings.on.as_deref())?;
    let side = settings.hand.sides(setting.handedness)[0];
    let letters = ask
        .sources
        .letters(settings.alphabet.as_deref(), &settings.word)?;
    let mut found = Vec::with_capacity(letters.len());
    for letter in letters {
        let pose = poses::of_value(ask.sources, &letter.value, side, &setting)?;
        found.push(LetterInput { letter, pose });
    }
    if found.is_empty() {
        return Err(Cause::Empty(settings.word.clone()));
    }
    ask.put(&LETTERS, found);
    if settings.hold.is_none() || settings.via.time.is_none() {
        let times = ask.sources.spelling_times()?;
        ask.put(&TIMES, times);
    }
    ask.course(&VIA, &settings.via)?;
    Ok(setting)
}

/// Generates the movement of a word.
pub(crate) fn generate(settings: &Spell, given: &mut Given<'_>) -> Result<(Work, Done), Cause> {
    let mut work = Work::of(given.material(&BODY)?);
    let letters = given.need(&LETTERS)?;
    let course = given.course(&VIA, &settings.via, Profile::Sigmoid)?;
    let times = Times::of(settings, given.get(&TIMES));
    let done = spell(&mut work, settings, letters, &times, &course)?;
    Ok((work, done.into()))
}

/// The usual time of a held letter, in seconds.
const HOLD: f64 = 0.2;
/// The usual time of the change from letter to letter, in seconds.
const CHANGE: f64 = 0.25;
/// The longest plausible time of either from a corpus, in seconds.
const LONGEST: f64 = 60.0;
/// The time of one stroke of a letter that moves, in seconds.
const STROKE: f64 = 0.3;
/// The distance by which the hand slides outwards for the second of two equal letters, in shoulder widths.
const SLIDE: f64 = 0.12;
/// The position of the spelling wrist: to the hand's own side, up and forward of the middle between the shoulders, in
/// shoulder widths; in front of the shoulder, with the hand at the height of the chin.
const SEAT: [f64; 3] = [0.6, -0.25, 0.85];

/// A span of time in which the hand shows one letter.
struct Show {
    frames: std::ops::Range<usize>,
    fingers: Vec<(usize, DQuat)>,
    /// The wrist's position and the hand's rotation at the start of the span and after each stroke.
    keys: Vec<(DVec3, DQuat)>,
}

/// The times of a held letter and of the change to the next, in seconds.
pub(crate) struct Times {
    hold: f64,
    change: f64,
    report: Vec<String>,
}

impl Times {
    /// Takes each time from the recipe, else from the corpus, else the default one.
    pub(crate) fn of(settings: &Spell, corpus: Option<&SpellingTimes>) -> Self {
        let mut report = Vec::new();
        let mut time = |what, asked: Option<Seconds>, found: Option<MedianTime>, usual: f64| {
            if let Some(asked) = asked {
                return asked.0;
            }
            let found = found.filter(|found| (0.0..=LONGEST).contains(&found.seconds));
            let time = found.map_or(usual, |found| found.seconds);
            report.push(match found {
                Some(found) => {
                    format!(
                        "{what} {time:.2} s, the median of {} in the corpus",
                        found.count
                    )
                }
                None => format!("{what} {time:.2} s: the corpus shows too few to learn from"),
            });
            time
        };
        let corpus = corpus.copied().unwrap_or_default();
        let asked = settings.via.time;
        Self {
            hold: time("letters are held for", settings.hold, corpus.hold, HOLD),
            change: time(
                "from letter to letter it takes",
                asked,
                corpus.change,
                CHANGE,
            ),
            report,
        }
    }
}

/// Spells on the body of `work`, whose first frame is its posture.
pub(crate) fn spell(
    work: &mut Work,
    settings: &Spell,
    letters: &[LetterInput],
    times: &Times,
    courses: &Courses,
) -> Result<(Vec<String>, f64), Cause> {
    let sides = settings.hand.sides(work.handedness);
    let frame = place::frame(work, sides)?;
    let shown: Vec<Vec<Show>> = sides
        .iter()
        .map(|&side| shows(work, &frame, side, times, letters))
        .collect::<Result<_, _>>()?;
    let frames = shown[0].last().map_or(1, |show| show.frames.end);
    join::check_length(work, frames)?;
    work.sample(&vec![0.0; frames]);
    work.notes.clear();
    let mut residual: f64 = 0.0;
    for (&side, shows) in sides.iter().zip(&shown) {
        fingers(work, side, shows, &courses.fingers);
        let path: Vec<(DVec3, DQuat)> = (0..frames)
            .map(|f| wrist(shows, f, &courses.arms))
            .collect();
        let (targets, hands): (Vec<DVec3>, Vec<DQuat>) = path.into_iter().unzip();
        let reach = arm::raise_arm(work, side, &targets, &hands, frame.left * side.sign());
        residual = residual.max(reach.ok_or(Cause::NoArm(side))?.residual);
        note(work, side, shows, letters);
    }
    work.notes.push(Note {
        hand: None,
        about: About::Gloss,
        value: Reading::Value(settings.word.clone()),
        span: work.span(),
        origin: settings.to_string(),
    });
    let groups = sides
        .iter()
        .flat_map(|&s| [Group::Arm(s), Group::Fingers(s)]);
    work.changed(groups.collect::<Vec<_>>(), &settings.to_string());
    let from = letters
        .iter()
        .map(|l| format!("{} from {}", l.letter.letter, l.pose.origin));
    let report = from.chain(times.report.iter().cloned());
    Ok((report.collect(), residual))
}

fn shows(
    work: &Work,
    frame: &Frame,
    side: Side,
    times: &Times,
    letters: &[LetterInput],
) -> Result<Vec<Show>, Cause> {
    let frames = |seconds: f64| ((seconds / work.rate.frame_time()).round() as usize).max(1);
    let (hold, change) = (frames(times.hold), frames(times.change));
    let own = |v: [f64; 3]| {
        // Letters are described for a right hand; a left one mirrors them.
        let x = if side == Side::Left { -v[0] } else { v[0] };
        frame.direction(DVec3::new(x, v[1], v[2]))
    };
    let outside = frame.left * side.sign();
    let seat = frame.origin
        + (outside * SEAT[0] + DVec3::Y * SEAT[1] + frame.forward * SEAT[2]) * frame.shoulders;
    let mut shows: Vec<Show> = Vec::with_capacity(letters.len());
    let (mut start, mut slid) = (0, DVec3::ZERO);
    for (n, input) in letters.iter().enumerate() {
        let letter = &input.letter;
        let joints = poses::rotations(&work.skeleton, &work.anatomy, side, &input.pose);
        let joints = joints.ok_or(Cause::NoFingers(side))?;
        if n > 0 && letters[n - 1].letter.letter == letter.letter {
            slid += outside * (SLIDE * frame.shoulders);
        }
        let direction = own(letter.fingers.unwrap_or([0.0, 1.0, 0.0]));
        let palm = own(letter.palm.unwrap_or([0.0, 0.0, 1.0]));
        let rotation = work.anatomy.hand_rotation(side, direction, palm);
        let mut key = (seat + slid, rotation.ok_or(Cause::NoFingers(side))?);
        let mut keys = vec![key];
        for stroke in &letter.strokes {
            let about = direction.normalize_or(DVec3::Y) * -side.sign();
            key.0 += own(stroke.displacement) * frame.shoulders;
            key.1 = DQuat::from_axis_angle(about, stroke.turn) * key.1;
            keys.push(key);
        }
        let drawn = frames(STROKE) * letter.strokes.len();
        let end = start + hold.max(drawn);
        shows.push(Show {
            frames: start..end,
            fingers: joints,
            keys,
        });
        start = end + change;
    }
    Ok(shows)
}

fn fingers(work: &mut Work, side: Side, shows: &[Show], course: &Course) {
    for joint in work.anatomy.fingers(side) {
        let value = |show: &Show| show.fingers.iter().find(|(j, _)| *j == joint).map(|f| f.1);
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
                column[frame] = course.rotation(here, there, (n + 1) as f64 / steps);
            }
        }
    }
}

/// Returns the wrist's position and the hand's rotation at a frame.
fn wrist(shows: &[Show], frame: usize, course: &Course) -> (DVec3, DQuat) {
    let n = shows
        .partition_point(|show| show.frames.start <= frame)
        .saturating_sub(1);
    let show = &shows[n];
    let last = show.keys.len() - 1;
    if frame < show.frames.end {
        if last == 0 {
            return show.keys[0];
        }
        let at = (frame - show.frames.start) as f64 / show.frames.len() as f64 * last as f64;
        let key = (at.floor() as usize).min(last - 1);
        return blend(show.keys[key], show.keys[key + 1], at - key as f64, course);
    }
    let Some(next) = shows.get(n + 1) else {
        return show.keys[last];
    };
    let steps = (next.frames.start - show.frames.end + 1) as f64;
    let w = (frame - show.frames.end + 1) as f64 / steps;
    blend(show.keys[last], next.keys[0], w, course)
}

fn blend(a: (DVec3, DQuat), b: (DVec3, DQuat), w: f64, course: &Course) -> (DVec3, DQuat) {
    (a.0.lerp(b.0, course.share(w)), course.rotation(a.1, b.1, w))
}

fn note(work: &mut Work, side: Side, shows: &[Show], letters: &[LetterInput]) {
    for (show, input) in shows.iter().zip(letters) {
        let span: Span = work.rate.span(show.frames.clone());
        work.notes.push(Note {
            hand: Some(side),
            about: About::Component(Component::Configuration, None),
            value: Reading::Value(input.letter.value.id.clone()),
            span,
            origin: input.pose.origin.to_string(),
        });
    }
}
