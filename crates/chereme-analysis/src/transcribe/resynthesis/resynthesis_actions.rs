//! Similar readings of the actions of a sign: each differs from another one in one property that is often misread.

use chereme_sign::hamnosys::{
    CircularPath, CompassDirection, DirectedPath, DirectionAim, EachHand, EllipseAxis, HandPlace, MotionKind,
    MotionManner, MotionRepetition, MotionSize, NotatedMotion, NotatedPosture, PathCurve, RepeatKind, SpatialDirection,
    WristMotion,
};

use super::reshaped::reshape_motion;

const TRIED_PATH_SIZES: [Option<MotionSize>; 3] = [None, Some(MotionSize::Small), Some(MotionSize::Big)];

const TRIED_ELLIPSES: [EllipseAxis; 4] = [
    EllipseAxis::Horizontal,
    EllipseAxis::UpRight,
    EllipseAxis::Vertical,
    EllipseAxis::UpLeft,
];

const WRIST_MOTIONS: [WristMotion; 5] = [
    WristMotion::Nodding,
    WristMotion::Swinging,
    WristMotion::Twisting,
    WristMotion::StirCw,
    WristMotion::StirCcw,
];

const TRIED_MOTION_REPEATS: [RepeatKind; 5] = [
    RepeatKind::FromStart,
    RepeatKind::FromStartSeveral,
    RepeatKind::Continue,
    RepeatKind::ContinueSeveral,
    RepeatKind::Reverse,
];

/// The cosine of 55 degrees, the greatest angle between similar directions.
const SIMILAR_DIRECTION_COSINE: f64 = 0.57;

/// Returns lists of actions that differ from `actions` in one property of one action.
pub(super) fn similar_action_lists(actions: &[NotatedMotion]) -> Vec<Vec<NotatedMotion>> {
    let mut all = replace_each_motion(actions, |action| {
        let mut all = similar_motions(action);
        if !matches!(action.kind, MotionKind::Repeated { .. }) {
            all.extend(TRIED_MOTION_REPEATS.map(|repeat| with_motion_repeat(action, repeat)));
        }
        all
    });
    // Every list costs a synthesis, so that equal ones are tried once.
    let mut unlike: Vec<Vec<NotatedMotion>> = Vec::new();
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
pub(super) fn with_target_place(action: &NotatedMotion, place: &HandPlace) -> Option<NotatedMotion> {
    let placed_posture = |posture: NotatedPosture| {
        Box::new(NotatedPosture {
            place: Some(place.clone()),
            ..posture
        })
    };
    Some(match &action.kind {
        MotionKind::Directed(_) | MotionKind::Circular(_) | MotionKind::Parallel(_) => {
            NotatedMotion::new(MotionKind::Target {
                motion: Some(Box::new(action.clone())),
                posture: placed_posture(NotatedPosture::default()),
            })
        }
        MotionKind::Target { motion, posture } => clone_with_change(action, |other| {
            other.kind = MotionKind::Target {
                motion: motion.clone(),
                posture: placed_posture(NotatedPosture::clone(posture)),
            };
        }),
        MotionKind::Repeated { motion, repetition } => {
            let motion = Box::new(with_target_place(motion, place)?);
            clone_with_change(action, |other| {
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
pub(super) fn without_target_place(motion: &NotatedMotion) -> NotatedMotion {
    clone_with_change(motion, |other| match &mut other.kind {
        MotionKind::Target { motion, posture } => {
            posture.place = None;
            match motion {
                Some(motion) if posture.is_empty() => *other = without_target_place(motion),
                Some(motion) => **motion = without_target_place(motion),
                None => {}
            }
        }
        MotionKind::Repeated { motion, .. } => **motion = without_target_place(motion),
        MotionKind::Split(a, b) => {
            for motion in [a, b].into_iter().flatten() {
                **motion = without_target_place(motion);
            }
        }
        MotionKind::Sequence { motions, .. } | MotionKind::Parallel(motions) => {
            for motion in motions {
                *motion = without_target_place(motion);
            }
        }
        _ => {}
    })
}

/// Returns a motion without the rests before it and within it.
pub(super) fn without_motion_rests(motion: &NotatedMotion) -> NotatedMotion {
    clone_with_change(motion, |other| {
        other.manner.rest = false;
        match &mut other.kind {
            MotionKind::Target {
                motion: Some(motion), ..
            }
            | MotionKind::Repeated { motion, .. } => **motion = without_motion_rests(motion),
            MotionKind::Split(a, b) => {
                for motion in [a, b].into_iter().flatten() {
                    **motion = without_motion_rests(motion);
                }
            }
            MotionKind::Sequence { motions, .. } | MotionKind::Parallel(motions) => {
                for motion in motions {
                    *motion = without_motion_rests(motion);
                }
            }
            _ => {}
        }
    })
}

/// Returns lists in which one motion is replaced by each of its `readings`.
fn replace_each_motion(
    all: &[NotatedMotion],
    readings: impl Fn(&NotatedMotion) -> Vec<NotatedMotion>,
) -> Vec<Vec<NotatedMotion>> {
    let mut variants = Vec::new();
    for (k, motion) in all.iter().enumerate() {
        for reading in readings(motion) {
            let mut other = all.to_vec();
            other[k] = reading;
            variants.push(other);
        }
    }
    variants
}

/// Returns a copy after a change.
fn clone_with_change<T: Clone>(of: &T, change: impl FnOnce(&mut T)) -> T {
    let mut other = of.clone();
    change(&mut other);
    other
}

/// Returns a repeated motion.
pub(super) fn with_motion_repeat(action: &NotatedMotion, repeat: RepeatKind) -> NotatedMotion {
    NotatedMotion::new(MotionKind::Repeated {
        motion: Box::new(action.clone()),
        repetition: MotionRepetition::plain_repetition(repeat),
    })
}

/// Returns the directions at most 55 degrees from a direction, itself included.
fn similar_directions(direction: SpatialDirection) -> impl Iterator<Item = SpatialDirection> {
    SpatialDirection::all_spatial_directions().filter(move |other| {
        let parts = direction
            .spatial_direction_vector()
            .into_iter()
            .zip(other.spatial_direction_vector());
        parts.map(|(a, b)| a * b).sum::<f64>() > SIMILAR_DIRECTION_COSINE
    })
}

fn similar_motions(of: &NotatedMotion) -> Vec<NotatedMotion> {
    let kinds = similar_motion_kinds(&of.kind).into_iter();
    let mut all: Vec<NotatedMotion> = kinds.map(|kind| NotatedMotion { kind, ..of.clone() }).collect();
    let manners = similar_manners(&of.manner).into_iter();
    all.extend(manners.map(|manner| NotatedMotion { manner, ..of.clone() }));
    // The motion alone, without its repetition or the posture at its end.
    if let MotionKind::Repeated { motion, .. }
    | MotionKind::Target {
        motion: Some(motion), ..
    } = &of.kind
    {
        all.push(NotatedMotion::clone(motion));
    }
    if let MotionKind::Parallel(both) = &of.kind {
        all.extend(both.iter().cloned());
    }
    all.extend(reshape_motion(of));
    all
}

fn similar_manners(of: &MotionManner) -> [MotionManner; 6] {
    let usual = MotionManner {
        fast: false,
        slow: false,
        tense: false,
        halt: false,
        ..*of
    };
    [
        usual,
        clone_with_change(&usual, |other| other.fast = true),
        clone_with_change(&usual, |other| other.slow = true),
        clone_with_change(&usual, |other| other.tense = true),
        clone_with_change(&usual, |other| other.halt = true),
        clone_with_change(of, |other| other.rest = !of.rest),
    ]
}

fn similar_motion_kinds(of: &MotionKind) -> Vec<MotionKind> {
    match of {
        MotionKind::Directed(path) => similar_directed_paths(path)
            .into_iter()
            .map(MotionKind::Directed)
            .collect(),
        MotionKind::Circular(circle) => similar_circular_paths(circle)
            .into_iter()
            .map(MotionKind::Circular)
            .collect(),
        MotionKind::Wrist { motion, size } => {
            let sizes = TRIED_PATH_SIZES.map(|size| MotionKind::Wrist { motion: *motion, size });
            let motions = WRIST_MOTIONS.map(|motion| MotionKind::Wrist { motion, size: *size });
            sizes.into_iter().chain(motions).collect()
        }
        MotionKind::Split(a, b) => {
            let (a, b) = (a.as_deref(), b.as_deref());
            let split = |a: Option<&NotatedMotion>, b: Option<&NotatedMotion>| {
                let boxed = |motion: &NotatedMotion| Box::new(motion.clone());
                MotionKind::Split(a.map(boxed), b.map(boxed))
            };
            let own_motions = a.into_iter().flat_map(similar_motions);
            let other = b.into_iter().flat_map(similar_motions);
            own_motions
                .map(|a| split(Some(&a), b))
                .chain(other.map(|b| split(a, Some(&b))))
                .collect()
        }
        MotionKind::Sequence { motions, fused } => {
            let sequence = |motions| MotionKind::Sequence { motions, fused: *fused };
            similar_action_lists(motions).into_iter().map(sequence).collect()
        }
        MotionKind::Parallel(all) => {
            let parallel_variants = replace_each_motion(all, similar_motions).into_iter();
            parallel_variants.map(MotionKind::Parallel).collect()
        }
        MotionKind::Target { motion, posture } => {
            let targets = |motion: Option<&NotatedMotion>, posture: &NotatedPosture| MotionKind::Target {
                motion: motion.cloned().map(Box::new),
                posture: Box::new(posture.clone()),
            };
            let motion = motion.as_deref();
            let moved = motion.into_iter().flat_map(similar_motions);
            moved
                .map(|other| targets(Some(&other), posture))
                .chain(similar_end_postures(posture).iter().map(|end| targets(motion, end)))
                .collect()
        }
        MotionKind::Repeated { motion, repetition } => {
            let motions = similar_motions(motion).into_iter();
            let others = motions.map(|motion| (motion, repetition.repeat));
            let repeats = TRIED_MOTION_REPEATS.map(|repeat| (NotatedMotion::clone(motion), repeat));
            let repeated_variants = others.chain(repeats);
            let all = repeated_variants.map(|(motion, repeat)| MotionKind::Repeated {
                motion: Box::new(motion),
                repetition: MotionRepetition { repeat, ..*repetition },
            });
            // As many times once more.
            let second = match repetition.second {
                Some(_) => None,
                None => Some(repetition.repeat),
            };
            all.chain([MotionKind::Repeated {
                motion: motion.clone(),
                repetition: MotionRepetition { second, ..*repetition },
            }])
            .collect()
        }
        MotionKind::Cross { .. } | MotionKind::FingerPlay(_) | MotionKind::Still | MotionKind::Body(_) => Vec::new(),
    }
}

fn similar_directed_paths(of: &DirectedPath) -> Vec<DirectedPath> {
    let mut all = vec![
        clone_with_change(of, |other| other.curve = None),
        clone_with_change(of, |other| other.zigzag = None),
        clone_with_change(of, |other| other.second = None),
    ];
    for size in TRIED_PATH_SIZES {
        all.push(clone_with_change(of, |other| other.size.first = size));
        if let Some(curve) = of.curve {
            all.push(clone_with_change(of, |other| {
                other.curve = Some(PathCurve { size, ..curve });
            }));
        }
    }
    all.extend(
        similar_directions(of.direction).map(|direction| clone_with_change(of, |other| other.direction = direction)),
    );
    let size = of.curve.map_or(Some(MotionSize::Small), |curve| curve.size);
    all.extend(CompassDirection::ALL_COMPASS_DIRECTIONS.map(|to| {
        clone_with_change(of, |other| {
            other.curve = Some(PathCurve { to, size });
        })
    }));
    all
}

fn similar_circular_paths(of: &CircularPath) -> Vec<CircularPath> {
    let mut all = vec![
        clone_with_change(of, |other| (other.clock.start, other.clock.end) = (None, None)),
        clone_with_change(of, |other| other.clock.end = None),
        clone_with_change(of, |other| other.ellipse = None),
    ];
    for size in TRIED_PATH_SIZES {
        all.push(clone_with_change(of, |other| other.size.first = size));
        if of.ellipse.is_some() {
            all.push(clone_with_change(of, |other| other.ellipse_size = size));
        }
    }
    all.extend(similar_directions(of.axis).map(|axis| clone_with_change(of, |other| other.axis = axis)));
    all.extend(TRIED_ELLIPSES.map(|ellipse| clone_with_change(of, |other| other.ellipse = Some(ellipse))));
    for hour in CompassDirection::ALL_COMPASS_DIRECTIONS {
        all.push(clone_with_change(of, |other| other.clock.start = Some(hour)));
        if of.clock.end.is_some() {
            all.push(clone_with_change(of, |other| other.clock.end = Some(hour)));
        }
    }
    all
}

/// Returns postures at the end of a motion: each lacks one property of `of`, or has a similar direction or palm.
fn similar_end_postures(of: &NotatedPosture) -> Vec<NotatedPosture> {
    let mut all = vec![
        clone_with_change(of, |other| other.place = None),
        clone_with_change(of, |other| other.shape = EachHand::Unset),
        clone_with_change(of, |other| other.extended = EachHand::Unset),
        clone_with_change(of, |other| other.palm = EachHand::Unset),
    ];
    if let EachHand::Shared(aim) = of.extended {
        let pointing = |first| {
            EachHand::Shared(DirectionAim {
                first,
                second: None,
                ..aim
            })
        };
        let similar = similar_directions(aim.first).filter(|direction| direction.has_symbol());
        all.extend(similar.map(|first| clone_with_change(of, |other| other.extended = pointing(first))));
    }
    if let EachHand::Shared(aim) = of.palm {
        let eighth = std::f64::consts::FRAC_PI_4;
        all.extend([-eighth, 0.0, eighth].map(|by| {
            let first = CompassDirection::nearest_compass_direction(aim.first.compass_angle() + by);
            let palm = DirectionAim {
                first,
                second: None,
                ..aim
            };
            clone_with_change(of, |other| other.palm = EachHand::Shared(palm))
        }));
    }
    all.retain(|other| *other != NotatedPosture::default());
    all
}

#[cfg(test)]
pub(super) mod tests;
