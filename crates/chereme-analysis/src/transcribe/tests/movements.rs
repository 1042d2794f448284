//! Generated movements for golden cases.

use chereme_sign::hamnosys::FingerBend;

use super::*;

/// A movement with the settings with which it is read.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) clip: Clip,
    pub(crate) anatomy: BodyAnatomy,
    pub(crate) options: TranscribeOptions,
}

type Hands = [Option<Held>; 2];

fn case(name: &'static str, seconds: f64, at: impl Fn(f64) -> Hands) -> Case {
    // Every path is a little bent, so that no direction of a bend depends on rounding.
    let bent = |time: f64| DVec3::new(0.003, 0.0045, -0.0035) * (time * (1.0 - time));
    let (clip, anatomy) = clip(seconds, |time| {
        let [right, left] = at(time);
        [
            right.map(|own| own.moved(bent(time))),
            left.map(|own| own.moved(bent(time) * 0.7)),
        ]
    });
    Case {
        name,
        clip,
        anatomy,
        options: TranscribeOptions::synthesised_options(),
    }
}

/// Returns a hand, a little beside the directions and places that have symbols, so that no two readings are equally
/// good.
fn held(at: [f64; 3], along: &str, palm: &str, class: HandClass) -> Held {
    Held::new(at, along, palm, class)
        .turned(DQuat::from_scaled_axis(DVec3::new(0.031, -0.047, 0.023)))
        .moved(DVec3::new(0.0031, -0.0047, 0.0022))
}

fn usual(class: HandClass) -> Held {
    held([-0.15, -0.12, 0.30], "u", "l", class)
}

/// Returns the movement of the right hand alone, whose path is given in lengths of the arm.
fn moved(name: &'static str, seconds: f64, own: &Held, by: impl Fn(f64) -> DVec3) -> Case {
    case(name, seconds, |time| [Some(own.moved(by(time) * ARM)), None])
}

fn turned(name: &'static str, seconds: f64, own: &Held, by: impl Fn(f64) -> DVec3) -> Case {
    case(name, seconds, |time| {
        [Some(own.turned(DQuat::from_scaled_axis(by(time)))), None]
    })
}

/// Returns the share of the path of strokes there and back, each with its stop.
fn strokes(count: usize, time: f64) -> f64 {
    let at = (time * count as f64).min(count as f64 - 1e-3);
    let share = ease(at.fract());
    if at as usize % 2 == 1 { 1.0 - share } else { share }
}

/// Returns an offset along a circle that starts at `spoke`.
fn round(axis: DVec3, spoke: DVec3, turns: f64, time: f64) -> DVec3 {
    DQuat::from_axis_angle(axis.normalize(), TAU * turns * ease(time)) * spoke - spoke
}

/// Returns an offset along an arc of a chord.
fn arc(chord: DVec3, bow: DVec3, time: f64) -> DVec3 {
    let share = ease(time);
    chord * share + bow * (4.0 * share * (1.0 - share))
}

pub(crate) fn one_hand() -> Vec<Case> {
    let v = DVec3::new;
    let (fist, flat) = (usual(HandClass::Fist), usual(HandClass::Flat));
    let index = held([-0.12, -0.05, 0.32], "ol", "dl", HandClass::Finger2);
    let spread = held([-0.2, -0.2, 0.28], "o", "d", HandClass::Finger2345);
    let pinch = held([-0.1, -0.18, 0.33], "uol", "l", HandClass::Pinch12);
    let wavy = |time: f64, periods: f64| {
        // A triangle wave from -1 to 1.
        let at = (periods * time).fract();
        1.0 - 4.0 * (at - 0.5).abs()
    };
    let played = |time: f64| {
        let bend = |n: usize| {
            let angle = 0.4 + 0.35 * (TAU * (3.0 * time + n as f64 / 4.0)).sin();
            Some(FingerBend::Joints([angle, angle * 0.6, angle * 0.4]))
        };
        let mut own = spread.clone();
        own.shape.bends = [None, bend(0), bend(1), bend(2), bend(3)];
        own
    };
    vec![
        moved("small, away, fist", 0.25, &fist, |t| v(0.01, 0.012, 0.13) * ease(t)),
        moved("down, flat", 0.3, &flat, |t| v(0.012, -0.26, 0.01) * ease(t)),
        moved("far, up and left, pinch", 0.5, &pinch, |t| v(0.3, 0.31, 0.02) * ease(t)),
        moved("between two directions", 0.4, &index, |t| v(0.24, 0.02, 0.1) * ease(t)),
        moved("arc to the left, upwards", 0.5, &fist, |t| {
            arc(v(0.3, 0.01, 0.0), v(0.0, 0.07, 0.01), t)
        }),
        moved("deep arc, away and down", 0.55, &flat, |t| {
            arc(v(0.0, -0.15, 0.2), v(0.01, 0.13, 0.1), t)
        }),
        moved("circle about the axis away", 0.7, &index, |t| {
            round(v(0.03, 0.05, 1.0), v(0.01, 0.14, 0.0), 1.03, t)
        }),
        moved("large circle about the axis to the left", 0.9, &fist, |t| {
            round(v(1.0, 0.05, 0.03), v(0.0, 0.22, 0.03), 1.1, t)
        }),
        moved("two level circles", 1.2, &spread, |t| {
            round(v(0.02, 1.0, 0.05), v(0.01, 0.0, -0.1), 2.0, t)
        }),
        moved("ellipse", 0.8, &index, |t| {
            let (sin, cos) = (0.98 * TAU * ease(t)).sin_cos();
            v(0.16 * sin, 0.08 * (cos - 1.0), 0.02 * sin)
        }),
        moved("zigzag", 1.0, &index, |t| {
            v(0.4 * t, 0.07 * wavy(t + 0.1, 2.5), 0.02 * t)
        }),
        moved("wave", 1.0, &flat, |t| {
            v(0.4 * t, 0.05 * (TAU * 2.5 * t).sin(), 0.01 * t)
        }),
        moved("to and fro", 0.6, &fist, |t| v(0.18, 0.02, 0.03) * strokes(2, t)),
        moved("three small strokes", 0.9, &fist, |t| {
            v(0.01, -0.02, 0.13) * strokes(3, t)
        }),
        moved("strokes that grow", 1.5, &flat, |t| {
            let stroke = ((t * 5.0) as usize).min(4);
            v(0.01, -0.02, 0.12) * (strokes(5, t) * 1.35_f64.powi(stroke.div_ceil(2) as i32 - stroke as i32 % 2))
        }),
        moved("down, then to the left", 0.9, &index, |t| {
            v(0.0, -0.22, 0.02) * ease((2.0 * t).min(1.0)) + v(0.25, 0.01, 0.0) * ease((2.0 * t - 1.0).max(0.0))
        }),
        moved("fast", 0.15, &fist, |t| v(0.01, -0.25, 0.02) * ease(t.powf(1.25))),
        moved("slow", 0.8, &fist, |t| v(0.01, -0.25, 0.02) * ease(t.powf(1.25))),
        moved("tense", 0.56, &fist, |t| v(0.01, -0.25, 0.02) * t),
        moved("sudden stop", 0.25, &fist, |t| v(0.01, -0.25, 0.02) * t.powi(3)),
        moved("after a rest", 0.7, &fist, |t| {
            v(0.01, -0.25, 0.02) * ease(((t - 0.5) / 0.5).max(0.0).powf(1.25))
        }),
        turned("nodding", 0.56, &fist, |t| v(0.02, 0.01, 0.5) * (TAU * 2.0 * t).sin()),
        turned("swinging", 0.56, &flat, |t| v(0.4, 0.02, 0.01) * (TAU * 2.0 * t).sin()),
        turned("twisting", 0.7, &index, |t| v(0.4, 0.01, 0.42) * (TAU * 2.5 * t).sin()),
        turned("stirring", 0.8, &fist, |t| {
            let (sin, cos) = (TAU * 2.0 * t).sin_cos();
            v(0.4 * sin, 0.0, 0.4 * cos)
        }),
        turned("turns to another orientation", 0.35, &flat, |t| {
            v(0.1, 1.4, 0.05) * ease(t)
        }),
        case("changes its shape", 0.3, |t| {
            [Some(if t < 0.5 { fist.clone() } else { spread.clone() }), None]
        }),
        case("turns and moves along an arc", 0.5, |t| {
            let by = DQuat::from_scaled_axis(v(-0.8, 0.1, 0.3) * ease(t));
            [
                Some(
                    flat.turned(by)
                        .moved(arc(v(0.2, 0.02, 0.0), v(0.0, 0.06, 0.02), t) * ARM),
                ),
                None,
            ]
        }),
        case("fingers play", 1.0, |t| [Some(played(t)), None]),
        case("fingers play on the way", 1.0, |t| {
            [Some(played(t).moved(v(0.12, 0.01, 0.0) * ease(t))), None]
        }),
    ]
}

/// Returns the place of a landmark in the space of the signer.
fn landmark(name: &str) -> DVec3 {
    let (clip, anatomy) = clip(0.1, |_| [None, None]);
    let model = clip.model_pose(0);
    let at = anatomy.landmark_place_position(clip.clip_skeleton(), &model, name);
    at.expect("a landmark") - anatomy.body_frame(&model).expect("a trunk").origin
}

pub(crate) fn places() -> Vec<Case> {
    let v = DVec3::new;
    let mut index = held([0.0; 3], "u", "l", HandClass::Finger2);
    index.shape.form.thumb = Some(ThumbPosition::Across);
    // The tip of a straight index finger.
    let tip = v(0.003, 0.124, -0.026);
    let flat = held([0.0; 3], "ul", "dl", HandClass::Flat);
    let at = |own: &Held, name: &str, off: DVec3| own.moved(landmark(name) + off);
    let still = |name: &'static str, own: Held| case(name, 0.3, move |_| [Some(own.clone()), None]);
    let (chin, chest) = (at(&index, "chin", -tip), at(&flat, "chest", v(-0.02, -0.03, 0.02)));
    let brow = at(&index, "forehead", -tip);
    vec![
        still("a fingertip at the chin", chin.clone()),
        still("a fingertip near the nose", at(&index, "nose", v(0.0, 0.0, 0.04) - tip)),
        still(
            "a fingertip at the forehead, beside",
            at(&index, "forehead", v(-0.05, 0.0, 0.0) - tip),
        ),
        still("a flat hand at the chest", chest.clone()),
        still("a flat hand before the chest", chest.moved(v(0.0, 0.0, 0.09))),
        still("a flat hand at the belly", at(&flat, "belly", v(0.0, -0.04, 0.03))),
        still("a hand above the head", flat.moved(v(-0.1, 0.5, 0.15))),
        still("an arm stretched out", index.moved(v(-0.2, 0.0, 0.55))),
        still("a hand far to the left", flat.moved(v(0.3, -0.1, 0.25))),
        case("brushes the chin in passing", 0.4, |t| {
            let across = 2.0 * ease(t) - 1.0;
            [
                Some(chin.moved(v(
                    -0.14 * across,
                    0.006 * across,
                    0.12 * across * across + 0.003 * across,
                ))),
                None,
            ]
        }),
        case("from the chin away", 0.35, |t| {
            [Some(chin.moved(v(0.01, -0.05, 0.2) * ease(t))), None]
        }),
        case("from before the chest to it, twice", 0.9, |t| {
            [Some(chest.moved(v(0.0, 0.01, 0.12) * (1.0 - strokes(3, t)))), None]
        }),
        case("from the forehead to the chin", 0.5, |t| {
            let by = (chin.at - brow.at) * ease(t) + v(0.0, 0.0, 0.2) * (ease(t) * (1.0 - ease(t)));
            [Some(brow.moved(by)), None]
        }),
    ]
}

pub(crate) fn two_hands() -> Vec<Case> {
    let v = DVec3::new;
    let (flat, fist) = (usual(HandClass::Flat), usual(HandClass::Fist));
    let index = held([-0.14, -0.1, 0.3], "uo", "dl", HandClass::Finger2);
    let level = held([-0.06, -0.16, 0.3], "l", "u", HandClass::Flat);
    let base = held([-0.03, -0.2, 0.3], "ol", "u", HandClass::Flat).mirrored();
    let mut left = case("the left-handed signer", 0.3, |t| {
        [None, Some(index.moved(v(0.1, 0.02, 0.03) * ease(t)).mirrored())]
    });
    left.options.dominant = BodySide::Left;
    vec![
        case("mirrored, outwards", 0.3, |t| {
            let now = flat.moved(v(-0.1, 0.08, 0.01) * ease(t));
            [Some(now.clone()), Some(now.mirrored())]
        }),
        case("parallel, to the left", 0.35, |t| {
            let by = v(0.12, 0.01, 0.02) * ease(t);
            [Some(fist.moved(by)), Some(fist.mirrored().moved(by))]
        }),
        case("alternating, up and down", 0.9, |t| {
            let by = v(0.0, 0.12, 0.01) * strokes(3, t);
            [
                Some(flat.moved(by)),
                Some(flat.mirrored().moved(v(0.0, 0.12, 0.01) - by)),
            ]
        }),
        case("alternating circles", 1.2, |t| {
            let (a, b) = (v(0.0, 0.07, 0.01), v(0.0, -0.07, -0.01));
            let axis = v(1.0, 0.02, 0.03);
            [
                Some(index.moved(round(axis, a, 2.0, t))),
                Some(index.mirrored().moved(a - b).moved(round(axis, b, 2.0, t))),
            ]
        }),
        case("away and back against each other", 0.4, |t| {
            let by = v(0.0, 0.01, 0.11) * ease(t);
            [
                Some(fist.moved(by)),
                Some(fist.mirrored().moved(v(0.0, 0.0, 0.11) - by)),
            ]
        }),
        case("one hand on the other", 0.3, |_| {
            [Some(level.clone()), Some(base.clone())]
        }),
        case("one hand strikes the other", 0.6, |t| {
            [
                Some(level.moved(v(0.0, 0.13, 0.01) * (1.0 - strokes(3, t)))),
                Some(base.clone()),
            ]
        }),
        case("fists together, to the left", 0.4, |t| {
            let near = fist.moved(v(0.1, 0.0, 0.0));
            let by = v(0.1, 0.01, 0.0) * ease(t);
            [Some(near.moved(by)), Some(near.mirrored().moved(by))]
        }),
        case("another shape for each hand, the other held", 0.4, |t| {
            [Some(index.moved(v(0.02, -0.1, 0.03) * ease(t))), Some(flat.mirrored())]
        }),
        case("each for itself", 0.5, |t| {
            [
                Some(index.moved(v(0.02, 0.14, 0.01) * ease(t))),
                Some(
                    fist.mirrored()
                        .moved(round(v(0.0, 0.1, 1.0), v(0.0, 0.06, 0.0), 1.0, t)),
                ),
            ]
        }),
        case("the other hand alone", 0.4, |t| {
            [None, Some(index.mirrored().moved(v(0.12, 0.05, 0.0) * ease(t)))]
        }),
        left,
    ]
}

/// Adds noise of a millimetre and half a degree to every joint; a tremble from frame to frame, or slow.
fn noisy(case: Case, name: &'static str, slow: bool) -> Case {
    let mut random = crate::cue::generate::RandomNumbers::new(5);
    let clip = &case.clip;
    let channels = clip.joint_channels().iter().map(|channel| {
        let mut curve = || -> Vec<f64> {
            let (size, phase) = (random.random_normal(), random.random_share());
            let tempo = 1.0 + random.random_share();
            let wave = |n: usize| size * (TAU * (phase + tempo * n as f64 / 60.0)).sin();
            (0..clip.clip_frame_count())
                .map(|n| if slow { wave(n) } else { random.random_normal() })
                .collect()
        };
        let turns = [curve(), curve(), curve()];
        let moves = [curve(), curve(), curve()];
        let of = |curves: &[Vec<f64>; 3], n: usize| DVec3::new(curves[0][n], curves[1][n], curves[2][n]);
        let turned = channel.rotations.iter().enumerate();
        let moved = channel.translations.as_ref();
        JointChannel {
            rotations: turned
                .map(|(n, own)| *own * DQuat::from_scaled_axis(of(&turns, n) * 0.5_f64.to_radians()))
                .map(DQuat::normalize)
                .collect(),
            translations: moved.map(|all| {
                all.iter()
                    .enumerate()
                    .map(|(n, at)| *at + of(&moves, n) * 0.001)
                    .collect()
            }),
        }
    });
    let channels = channels.collect();
    let clip = Clip::new(Arc::clone(clip.clip_skeleton()), clip.clip_frame_rate(), channels).expect("a clip");
    Case {
        name,
        clip,
        options: TranscribeOptions::default(),
        ..case
    }
}

/// Returns a case at another rate.
fn at_rate(case: Case, name: &'static str, rate: u32) -> Case {
    let rate = FrameRate::new(rate, 1).expect("a rate");
    Case {
        name,
        clip: case.clip.resample_clip(rate),
        ..case
    }
}

/// Returns a case of a signer who faces another way.
fn facing(case: Case, name: &'static str, angle: f64) -> Case {
    let turn = DQuat::from_rotation_y(angle);
    let channels = case.clip.joint_channels().iter().enumerate().map(|(joint, channel)| {
        let rotations = channel.rotations.iter();
        let root = joint == 0;
        JointChannel {
            rotations: rotations.map(|own| if root { turn * *own } else { *own }).collect(),
            translations: channel.translations.clone(),
        }
    });
    let channels = channels.collect();
    let clip = Clip::new(
        Arc::clone(case.clip.clip_skeleton()),
        case.clip.clip_frame_rate(),
        channels,
    )
    .expect("a clip");
    Case { name, clip, ..case }
}

pub(crate) fn captured() -> Vec<Case> {
    let pick = |cases: Vec<Case>, name: &str| -> Case {
        let mut found = cases.into_iter().filter(|it| it.name == name);
        found.next().expect("a case")
    };
    vec![
        noisy(pick(one_hand(), "down, flat"), "down, with drift", true),
        noisy(pick(one_hand(), "down, flat"), "down, with tremble", false),
        noisy(pick(one_hand(), "ellipse"), "ellipse, with drift", true),
        noisy(pick(one_hand(), "three small strokes"), "strokes, with drift", true),
        noisy(pick(one_hand(), "twisting"), "twisting, with drift", true),
        noisy(pick(places(), "from the chin away"), "from the chin, with drift", true),
        noisy(pick(two_hands(), "mirrored, outwards"), "mirrored, with drift", true),
        noisy(
            pick(two_hands(), "one hand strikes the other"),
            "one hand strikes the other, with drift",
            true,
        ),
        at_rate(pick(one_hand(), "to and fro"), "to and fro, 30 frames a second", 30),
        at_rate(pick(one_hand(), "zigzag"), "zigzag, 100 frames a second", 100),
        facing(
            pick(places(), "brushes the chin in passing"),
            "brushes the chin, facing aside",
            0.7,
        ),
        facing(
            pick(two_hands(), "alternating circles"),
            "alternating circles, facing aside",
            -2.1,
        ),
    ]
}
