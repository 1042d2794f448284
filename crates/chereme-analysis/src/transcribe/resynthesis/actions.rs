//! Similar readings of the actions of a sign: each differs from another one in one property that is often misread.

use chereme_sign::hamnosys::{
    Aim, Circular, Compass, Curve, Directed, Direction, Each, Ellipse, Manner, Motion, MotionKind,
    Place, Posture, Repeat, Repetition, Size, WristMotion,
};

use super::reshaped::reshaped;

const SIZES: [Option<Size>; 3] = [None, Some(Size::Small), Some(Size::Big)];

const ELLIPSES: [Ellipse; 4] = [
    Ellipse::Horizontal,
    Ellipse::UpRight,
    Ellipse::Vertical,
    Ellipse::UpLeft,
];

const WRIST_MOTIONS: [WristMotion; 5] = [
    WristMotion::Nodding,
    WristMotion::Swinging,
    WristMotion::Twisting,
    WristMotion::StirCw,
    WristMotion::StirCcw,
];

const REPEATS: [Repeat; 5] = [
    Repeat::FromStart,
    Repeat::FromStartSeveral,
    Repeat::Continue,
    Repeat::ContinueSeveral,
    Repeat::Reverse,
];

/// The cosine of 55 degrees, the greatest angle between similar directions.
const NEAR: f64 = 0.57;

/// Returns lists of actions that differ from `actions` in one property of one action.
pub(super) fn similar(actions: &[Motion]) -> Vec<Vec<Motion>> {
    let mut all = others(actions, |action| {
        let mut all = motions(action);
        if !matches!(action.kind, MotionKind::Repeated { .. }) {
            all.extend(REPEATS.map(|repeat| repeated(action, repeat)));
        }
        all
    });
    let mut unlike: Vec<Vec<Motion>> = Vec::new();
    all.retain(|other| {
        let is_new = other != actions && !unlike.contains(other);
        if is_new {
            unlike.push(other.clone());
        }
        is_new
    });
    all
}

/// Returns an action that ends at `place`; `None` if it has no path.
pub(super) fn targeting(action: &Motion, place: &Place) -> Option<Motion> {
    let at = |posture: Posture| {
        Box::new(Posture {
            place: Some(place.clone()),
            ..posture
        })
    };
    Some(match &action.kind {
        MotionKind::Directed(_) | MotionKind::Circular(_) | MotionKind::Parallel(_) => {
            Motion::new(MotionKind::Target {
                motion: Some(Box::new(action.clone())),
                posture: at(Posture::default()),
            })
        }
        MotionKind::Target { motion, posture } => changed(action, |other| {
            other.kind = MotionKind::Target {
                motion: motion.clone(),
                posture: at(Posture::clone(posture)),
            };
        }),
        MotionKind::Repeated { motion, repetition } => {
            let motion = Box::new(targeting(motion, place)?);
            changed(action, |other| {
                other.kind = MotionKind::Repeated {
                    motion,
                    repetition: *repetition,
                };
            })
        }
        _ => return None,
    })
}

/// Returns a motion without the place at its end.
pub(super) fn untargeted(motion: &Motion) -> Motion {
    changed(motion, |other| match &mut other.kind {
        MotionKind::Target { motion, posture } => {
            posture.place = None;
            match motion {
                Some(motion) if posture.is_empty() => *other = untargeted(motion),
                Some(motion) => **motion = untargeted(motion),
                None => {}
            }
        }
        MotionKind::Repeated { motion, .. } => **motion = untargeted(motion),
        MotionKind::Split(a, b) => {
            for motion in [a, b].into_iter().flatten() {
                **motion = untargeted(motion);
            }
        }
        MotionKind::Sequence { motions, .. } | MotionKind::Parallel(motions) => {
            for motion in motions {
                *motion = untargeted(motion);
            }
        }
        _ => {}
    })
}

/// Returns a motion without the rests before it and within it.
pub(super) fn unrested(motion: &Motion) -> Motion {
    changed(motion, |other| {
        other.manner.rest = false;
        match &mut other.kind {
            MotionKind::Target {
                motion: Some(motion),
                ..
            }
            | MotionKind::Repeated { motion, .. } => **motion = unrested(motion),
            MotionKind::Split(a, b) => {
                for motion in [a, b].into_iter().flatten() {
                    **motion = unrested(motion);
                }
            }
            MotionKind::Sequence { motions, .. } | MotionKind::Parallel(motions) => {
                for motion in motions {
                    *motion = unrested(motion);
                }
            }
            _ => {}
        }
    })
}

/// Returns lists in which one motion is replaced by each of its `readings`.
fn others(all: &[Motion], readings: impl Fn(&Motion) -> Vec<Motion>) -> Vec<Vec<Motion>> {
    let mut found = Vec::new();
    for (k, motion) in all.iter().enumerate() {
        for reading in readings(motion) {
            let mut other = all.to_vec();
            other[k] = reading;
            found.push(other);
        }
    }
    found
}

/// Returns a copy after a change.
fn changed<T: Clone>(of: &T, change: impl FnOnce(&mut T)) -> T {
    let mut other = of.clone();
    change(&mut other);
    other
}

/// Returns a repeated motion.
pub(super) fn repeated(action: &Motion, repeat: Repeat) -> Motion {
    Motion::new(MotionKind::Repeated {
        motion: Box::new(action.clone()),
        repetition: Repetition::plain(repeat),
    })
}

/// Returns the directions at most 55 degrees from a direction, itself included.
fn near(direction: Direction) -> impl Iterator<Item = Direction> {
    Direction::all().filter(move |other| {
        let parts = direction.vector().into_iter().zip(other.vector());
        parts.map(|(a, b)| a * b).sum::<f64>() > NEAR
    })
}

fn motions(of: &Motion) -> Vec<Motion> {
    let kinds = kinds(&of.kind).into_iter();
    let mut all: Vec<Motion> = kinds.map(|kind| Motion { kind, ..of.clone() }).collect();
    let manners = manners(&of.manner).into_iter();
    all.extend(manners.map(|manner| Motion {
        manner,
        ..of.clone()
    }));
    if let MotionKind::Repeated { motion, .. }
    | MotionKind::Target {
        motion: Some(motion),
        ..
    } = &of.kind
    {
        all.push(Motion::clone(motion));
    }
    if let MotionKind::Parallel(both) = &of.kind {
        all.extend(both.iter().cloned());
    }
    all.extend(reshaped(of));
    all
}

fn manners(of: &Manner) -> [Manner; 6] {
    let usual = Manner {
        fast: false,
        slow: false,
        tense: false,
        halt: false,
        ..*of
    };
    [
        usual,
        changed(&usual, |other| other.fast = true),
        changed(&usual, |other| other.slow = true),
        changed(&usual, |other| other.tense = true),
        changed(&usual, |other| other.halt = true),
        changed(of, |other| other.rest = !of.rest),
    ]
}

fn kinds(of: &MotionKind) -> Vec<MotionKind> {
    match of {
        MotionKind::Directed(path) => paths(path).into_iter().map(MotionKind::Directed).collect(),
        MotionKind::Circular(circle) => circles(circle)
            .into_iter()
            .map(MotionKind::Circular)
            .collect(),
        MotionKind::Wrist { motion, size } => {
            let sizes = SIZES.map(|size| MotionKind::Wrist {
                motion: *motion,
                size,
            });
            let motions = WRIST_MOTIONS.map(|motion| MotionKind::Wrist {
                motion,
                size: *size,
            });
            sizes.into_iter().chain(motions).collect()
        }
        MotionKind::Split(a, b) => {
            let (a, b) = (a.as_deref(), b.as_deref());
            let split = |a: Option<&Motion>, b: Option<&Motion>| {
                let boxed = |motion: &Motion| Box::new(motion.clone());
                MotionKind::Split(a.map(boxed), b.map(boxed))
            };
            let own = a.into_iter().flat_map(motions);
            let other = b.into_iter().flat_map(motions);
            own.map(|a| split(Some(&a), b))
                .chain(other.map(|b| split(a, Some(&b))))
                .collect()
        }
        MotionKind::Sequence { motions, fused } => {
            let sequence = |motions| MotionKind::Sequence {
                motions,
                fused: *fused,
            };
            similar(motions).into_iter().map(sequence).collect()
        }
        MotionKind::Parallel(all) => {
            let found = others(all, motions).into_iter();
            found.map(MotionKind::Parallel).collect()
        }
        MotionKind::Target { motion, posture } => {
            let targets = |motion: Option<&Motion>, posture: &Posture| MotionKind::Target {
                motion: motion.cloned().map(Box::new),
                posture: Box::new(posture.clone()),
            };
            let motion = motion.as_deref();
            let moved = motion.into_iter().flat_map(motions);
            moved
                .map(|other| targets(Some(&other), posture))
                .chain(ends(posture).iter().map(|end| targets(motion, end)))
                .collect()
        }
        MotionKind::Repeated { motion, repetition } => {
            let motions = motions(motion).into_iter();
            let others = motions.map(|motion| (motion, repetition.repeat));
            let repeats = REPEATS.map(|repeat| (Motion::clone(motion), repeat));
            let all = others.chain(repeats);
            let all = all.map(|(motion, repeat)| MotionKind::Repeated {
                motion: Box::new(motion),
                repetition: Repetition {
                    repeat,
                    ..*repetition
                },
            });
            // As many times once more.
            let second = match repetition.second {
                Some(_) => None,
                None => Some(repetition.repeat),
            };
            all.chain([MotionKind::Repeated {
                motion: motion.clone(),
                repetition: Repetition {
                    second,
                    ..*repetition
                },
            }])
            .collect()
        }
        MotionKind::Cross { .. }
        | MotionKind::FingerPlay(_)
        | MotionKind::Still
        | MotionKind::Body(_) => Vec::new(),
    }
}

fn paths(of: &Directed) -> Vec<Directed> {
    let mut all = vec![
        changed(of, |other| other.curve = None),
        changed(of, |other| other.zigzag = None),
        changed(of, |other| other.second = None),
    ];
    for size in SIZES {
        all.push(changed(of, |other| other.size.first = size));
        if let Some(curve) = of.curve {
            all.push(changed(of, |other| {
                other.curve = Some(Curve { size, ..curve });
            }));
        }
    }
    all.extend(
        near(of.direction).map(|direction| changed(of, |other| other.direction = direction)),
    );
    let size = of.curve.map_or(Some(Size::Small), |curve| curve.size);
    all.extend(Compass::ALL.map(|to| {
        changed(of, |other| {
            other.curve = Some(Curve { to, size });
        })
    }));
    all
}

fn circles(of: &Circular) -> Vec<Circular> {
    let mut all = vec![
        changed(of, |other| {
            (other.clock.start, other.clock.end) = (None, None)
        }),
        changed(of, |other| other.clock.end = None),
        changed(of, |other| other.ellipse = None),
    ];
    for size in SIZES {
        all.push(changed(of, |other| other.size.first = size));
        if of.ellipse.is_some() {
            all.push(changed(of, |other| other.ellipse_size = size));
        }
    }
    all.extend(near(of.axis).map(|axis| changed(of, |other| other.axis = axis)));
    all.extend(ELLIPSES.map(|ellipse| changed(of, |other| other.ellipse = Some(ellipse))));
    for hour in Compass::ALL {
        all.push(changed(of, |other| other.clock.start = Some(hour)));
        if of.clock.end.is_some() {
            all.push(changed(of, |other| other.clock.end = Some(hour)));
        }
    }
    all
}

/// Returns postures at the end of a motion: each lacks one property of `of`, or has a similar direction or palm.
fn ends(of: &Posture) -> Vec<Posture> {
    let mut all = vec![
        changed(of, |other| other.place = None),
        changed(of, |other| other.shape = Each::Unset),
        changed(of, |other| other.extended = Each::Unset),
        changed(of, |other| other.palm = Each::Unset),
    ];
    if let Each::Shared(aim) = of.extended {
        let pointing = |first| {
            Each::Shared(Aim {
                first,
                second: None,
                ..aim
            })
        };
        let similar = near(aim.first).filter(|direction| direction.has_symbol());
        all.extend(similar.map(|first| changed(of, |other| other.extended = pointing(first))));
    }
    if let Each::Shared(aim) = of.palm {
        let eighth = std::f64::consts::FRAC_PI_4;
        all.extend([-eighth, 0.0, eighth].map(|by| {
            let first = Compass::nearest(aim.first.angle() + by);
            let palm = Aim {
                first,
                second: None,
                ..aim
            };
            changed(of, |other| other.palm = Each::Shared(palm))
        }));
    }
    all.retain(|other| *other != Posture::default());
    all
}

#[cfg(test)]
pub(super) mod tests {
    use chereme_sign::hamnosys::{Sign, from_names, parse, text_of, to_names};

    use super::*;

    pub(in super::super) fn sign(movement: &str) -> Sign {
        let names: Vec<String> = movement.split(' ').map(|it| format!("ham{it}")).collect();
        let text = from_names(names.iter().map(String::as_str)).expect("symbols");
        parse(&text).expect("a movement").sign
    }

    /// Returns the symbols of actions, without their first three letters.
    pub(in super::super) fn named(actions: Vec<Motion>) -> String {
        let mut sign = Sign::default();
        sign.parts.resize_with(1, Default::default);
        sign.parts[0].actions = actions;
        let names = to_names(&text_of(&sign)).expect("symbols").join(" ");
        names.replace("ham", "")
    }

    #[test]
    fn similar_readings_differ_in_one_property() {
        let cases: [(&str, &[&str]); 6] = [
            (
                "moveo",
                &[
                    "moveo smallmod",
                    "moveo largemod",
                    "moveol",
                    "moveo arcu smallmod",
                    "moveo slow",
                    "moveo repeatfromstart",
                ],
            ),
            (
                "moveo arcu",
                &[
                    "moveo",
                    "moveo arcu smallmod",
                    "moveo largemod arcu",
                    "moveo arcu arcl",
                ],
            ),
            (
                "circleo smallmod clockul repeatfromstart",
                &[
                    "circleo clockul repeatfromstart",
                    "circleo smallmod repeatfromstart",
                    "circleo smallmod clocku repeatfromstart",
                    "circleol smallmod clockul repeatfromstart",
                    "circleo smallmod clockul repeatfromstartseveral",
                    "circleo smallmod clockul",
                ],
            ),
            (
                "moveo smallmod fast chest touch",
                &[
                    "moveo fast chest touch",
                    "moveo smallmod chest touch",
                    "moveo smallmod fast",
                ],
            ),
            (
                "parbegin moveo replace extfingeru palml parend",
                &[
                    "parbegin moveo replace palml parend",
                    "parbegin moveo replace extfingeru parend",
                    "parbegin moveo replace extfingerul palml parend",
                    "parbegin moveo replace extfingeru palmul parend",
                    "replace extfingeru palml",
                ],
            ),
            (
                "nodding moveo",
                &["swinging moveo", "nodding smallmod moveo", "nodding moveuo"],
            ),
        ];
        for (movement, expected) in cases {
            let of = sign(movement).parts.swap_remove(0).actions;
            let all: Vec<String> = similar(&of).into_iter().map(named).collect();
            for other in expected {
                assert!(
                    all.iter().any(|it| it == other),
                    "{movement}: no {other} in {all:?}"
                );
            }
            assert!(!all.iter().any(|it| it == movement), "{movement}: {all:?}");
            let mut unlike = all.clone();
            unlike.sort();
            unlike.dedup();
            assert_eq!(unlike.len(), all.len(), "{movement}: {all:?}");
        }
        assert_eq!(similar(&sign("nomotion").parts[0].actions).len(), 5 + 5);
    }

    #[test]
    fn a_path_ends_at_another_place() {
        let cases = [
            ("moveo", "moveo chin touch"),
            ("moveo chest touch", "moveo chin touch"),
            (
                "moveo smallmod repeatfromstart",
                "moveo smallmod chin touch repeatfromstart",
            ),
        ];
        let target = sign("moveo chin touch").parts.swap_remove(0).actions;
        let MotionKind::Target { posture, .. } = &target[0].kind else {
            panic!("{target:?}");
        };
        let place = posture.place.as_ref().expect("a place");
        for (movement, expected) in cases {
            let of = sign(movement).parts.swap_remove(0).actions;
            let other = targeting(&of[0], place).expect("a path");
            assert_eq!(named(vec![other]), expected);
        }
        let free = target.iter().map(untargeted).collect();
        assert_eq!(named(free), "moveo");
        assert_eq!(targeting(&sign("nodding").parts[0].actions[0], place), None);
    }
}
