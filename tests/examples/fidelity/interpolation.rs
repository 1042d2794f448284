//! Table that compares the courses of generated transitions with captured ones.

use chereme_analysis::strokes::MovingPart;
use chereme_compose::recipe::TransitionProfile;
use chereme_compose::{CapturedStretch, bridge_captured_stretch, learn_course};
use chereme_motion::Clip;
use chereme_motion::glam::DVec3;

use crate::Result;
use crate::capture::Capture;
use crate::strokes::{self, Transition};
use crate::table::markdown;

const COURSES: [&str; 6] = [
    "slerp",
    "cosine",
    "sigmoid",
    "minimum jerk",
    "learned, all others",
    "learned, other files",
];
const SIGMOID: usize = 2;

/// The error of a synthesised transition against the captured one.
#[derive(Clone, Copy, Default)]
struct Error {
    /// Sums of squares over frames and points, in metres and metres per second.
    position: f64,
    speed: f64,
    count: f64,
}

impl Error {
    fn add(&mut self, other: Self) {
        self.position += other.position;
        self.speed += other.speed;
        self.count += other.count;
    }

    /// The roots of the mean squares in millimetres and millimetres per second.
    fn rms(self) -> [f64; 2] {
        [self.position, self.speed].map(|sum| (sum / self.count).sqrt() * 1000.0)
    }
}

pub(crate) fn tables(captures: &[Capture]) -> Result<String> {
    let mut text = String::new();
    for (kind, name) in [
        (MovingPart::Wrist, "Strokes of a wrist between two minima of its speed"),
        (
            MovingPart::Fingers,
            "Changes of handshape between two minima of the fingers' speed",
        ),
    ] {
        let found: Vec<Transition> = captures
            .iter()
            .enumerate()
            .flat_map(|(n, capture)| strokes::find(n, capture, kind))
            .collect();
        text.push_str(&format!(
            "### {name}\n\n{} transitions; RMS error of position in mm · of speed in mm/s.\n\n",
            found.len()
        ));
        text.push_str(&table(captures, &found));
        text.push('\n');
    }
    Ok(text)
}

fn table(captures: &[Capture], found: &[Transition]) -> String {
    let errors: Vec<[Option<Error>; COURSES.len()]> = (0..found.len()).map(|n| tried(found, n)).collect();
    let head: Vec<&str> = ["capture", "transitions"].into_iter().chain(COURSES).collect();
    let row = |name: String, numbers: &[usize]| {
        let cells = (0..COURSES.len()).map(|course| {
            let mut sum = Error::default();
            for &n in numbers {
                sum.add(errors[n][course].unwrap_or_default());
            }
            let [position, speed] = sum.rms();
            if sum.count == 0.0 {
                "–".into()
            } else {
                format!("{position:.1} · {speed:.0}")
            }
        });
        [name, numbers.len().to_string()]
            .into_iter()
            .chain(cells)
            .collect::<Vec<String>>()
    };
    let mut rows = Vec::new();
    for (at, capture) in captures.iter().enumerate() {
        let own: Vec<usize> = (0..found.len()).filter(|&n| found[n].capture == at).collect();
        if !own.is_empty() {
            rows.push(row(capture.name.clone(), &own));
        }
    }
    let all: Vec<usize> = (0..found.len()).collect();
    let direct: Vec<usize> = (0..found.len()).filter(|&n| found[n].is_direct()).collect();
    for (name, numbers) in [("all", &all), ("direct ones", &direct)] {
        rows.push(row(format!("**{name}**"), numbers));
        rows.push(wins(&errors, numbers));
    }
    markdown(&head, rows)
}

/// Returns for each course the share of transitions in which its error is smaller than the sigmoid's.
fn wins(errors: &[[Option<Error>; COURSES.len()]], numbers: &[usize]) -> Vec<String> {
    let cells = (0..COURSES.len()).map(|course| {
        if course == SIGMOID {
            return "–".to_owned();
        }
        let pairs: Vec<(Error, Error)> = numbers
            .iter()
            .filter_map(|&n| errors[n][course].zip(errors[n][SIGMOID]))
            .collect();
        let share = |better: fn(&Error, &Error) -> bool| {
            let count = pairs.iter().filter(|(a, b)| better(a, b)).count();
            100.0 * count as f64 / pairs.len().max(1) as f64
        };
        let position = share(|a, b| a.position < b.position);
        format!("{position:.0} % · {:.0} %", share(|a, b| a.speed < b.speed))
    });
    ["better than the sigmoid in".to_owned(), String::new()]
        .into_iter()
        .chain(cells)
        .collect()
}

/// Tries every course on one transition; learned ones are fitted to the others.
fn tried(found: &[Transition], n: usize) -> [Option<Error>; COURSES.len()] {
    let one = &found[n];
    let learn = |use_it: &dyn Fn(usize) -> bool| {
        let others = (0..found.len()).filter(|&other| use_it(other));
        learn_course(others.map(|other| stretch(&found[other])))
    };
    let all_others = learn(&|other| other != n);
    let other_files = learn(&|other| found[other].capture != one.capture);
    let error = |profile, learned: Option<&Vec<f64>>| {
        let made = bridge_captured_stretch(&stretch(one), profile, learned.map(Vec::as_slice))?;
        Some(compare(one, &made))
    };
    [
        error(TransitionProfile::Slerp, None),
        error(TransitionProfile::Cosine, None),
        error(TransitionProfile::Sigmoid, None),
        error(TransitionProfile::MinimumJerk, None),
        error(TransitionProfile::Learned, all_others.as_ref()),
        error(TransitionProfile::Learned, other_files.as_ref()),
    ]
}

fn stretch(one: &Transition) -> CapturedStretch<'_> {
    CapturedStretch {
        clip: &one.clip,
        joints: &one.joints,
        frames: 0..one.clip.clip_frame_count(),
    }
}

fn compare(one: &Transition, made: &Clip) -> Error {
    let mut error = Error::default();
    let per_second = made.clip_frame_rate().per_second();
    for &joint in &one.points {
        let [was, is] = [&one.clip, made].map(|clip| {
            (0..clip.clip_frame_count())
                .map(|frame| strokes::point(clip, joint, one.base, frame))
                .collect::<Vec<DVec3>>()
        });
        let speeds = [&was, &is].map(|path| strokes::speeds(path, per_second, |a: &DVec3, b| a.distance(*b)));
        for frame in 0..was.len() {
            error.add(Error {
                position: was[frame].distance_squared(is[frame]),
                speed: (speeds[0][frame] - speeds[1][frame]).powi(2),
                count: 1.0,
            });
        }
    }
    error
}
