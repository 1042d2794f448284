//! Similar readings of the actions of a sign: each differs from the inferred one in one property that is often misread.

use chereme_sign::hamnosys::{
    Circular, Curve, Directed, Motion, MotionKind, Posture, Repeat, Repetition, Size,
};

const SIZES: [Option<Size>; 3] = [None, Some(Size::Small), Some(Size::Big)];

/// Returns lists of actions that differ from `actions` in one property of one action, or lack one.
pub(super) fn similar(actions: &[Motion]) -> Vec<Vec<Motion>> {
    let mut all = Vec::new();
    for (k, action) in actions.iter().enumerate() {
        for motion in motions(action) {
            let mut other = actions.to_vec();
            other[k] = motion;
            all.push(other);
        }
        if actions.len() > 1 {
            let mut other = actions.to_vec();
            other.remove(k);
            all.push(other);
        }
    }
    let mut unlike: Vec<Vec<Motion>> = Vec::new();
    for other in all {
        if other != actions && !unlike.contains(&other) {
            unlike.push(other);
        }
    }
    unlike
}

/// Returns a copy after a change.
fn changed<T: Clone>(of: &T, change: impl FnOnce(&mut T)) -> T {
    let mut other = of.clone();
    change(&mut other);
    other
}

fn motions(of: &Motion) -> Vec<Motion> {
    let kinds = kinds(&of.kind).into_iter();
    let mut all: Vec<Motion> = kinds.map(|kind| Motion { kind, ..of.clone() }).collect();
    all.push(changed(of, |usual| {
        (usual.manner.fast, usual.manner.slow) = (false, false);
    }));
    if let MotionKind::Repeated { motion, .. }
    | MotionKind::Target {
        motion: Some(motion),
        ..
    } = &of.kind
    {
        all.push(Motion::clone(motion));
    }
    all
}

fn kinds(of: &MotionKind) -> Vec<MotionKind> {
    let mut all = Vec::new();
    match of {
        MotionKind::Directed(path) => {
            let mut add = |change: &dyn Fn(&mut Directed)| {
                all.push(MotionKind::Directed(changed(path, change)));
            };
            for size in SIZES {
                add(&|other| other.size.first = size);
                add(&|other| other.curve = other.curve.map(|curve| Curve { size, ..curve }));
            }
            add(&|other| other.curve = None);
        }
        MotionKind::Circular(circle) => {
            let mut add = |change: &dyn Fn(&mut Circular)| {
                all.push(MotionKind::Circular(changed(circle, change)));
            };
            for size in SIZES {
                add(&|other| other.size.first = size);
            }
            add(&|other| (other.clock.start, other.clock.end) = (None, None));
            add(&|other| other.ellipse = None);
        }
        MotionKind::Wrist { motion, .. } => {
            let motion = *motion;
            all.extend(SIZES.map(|size| MotionKind::Wrist { motion, size }));
        }
        MotionKind::Split(a, b) => {
            for (n, side) in [a, b].into_iter().enumerate() {
                for other in side.iter().flat_map(|side| motions(side)) {
                    let mut both = [a.clone(), b.clone()];
                    both[n] = Some(Box::new(other));
                    let [a, b] = both;
                    all.push(MotionKind::Split(a, b));
                }
            }
        }
        MotionKind::Sequence { motions, fused } => {
            let fused = *fused;
            let others = similar(motions).into_iter();
            all.extend(others.map(|motions| MotionKind::Sequence { motions, fused }));
        }
        MotionKind::Parallel(motions) => {
            all.extend(similar(motions).into_iter().map(MotionKind::Parallel));
        }
        MotionKind::Target { motion, posture } => {
            if let Some(motion) = motion {
                all.extend(
                    motions(motion)
                        .into_iter()
                        .map(|motion| MotionKind::Target {
                            motion: Some(Box::new(motion)),
                            posture: posture.clone(),
                        }),
                );
            }
            if posture.place.is_some() {
                let free = Posture {
                    place: None,
                    ..Posture::clone(posture)
                };
                if free != Posture::default() {
                    all.push(MotionKind::Target {
                        motion: motion.clone(),
                        posture: Box::new(free),
                    });
                }
            }
        }
        MotionKind::Repeated { motion, repetition } => {
            all.extend(
                motions(motion)
                    .into_iter()
                    .map(|motion| MotionKind::Repeated {
                        motion: Box::new(motion),
                        repetition: *repetition,
                    }),
            );
            let repeat = match repetition.repeat {
                Repeat::FromStart => Repeat::FromStartSeveral,
                Repeat::FromStartSeveral => Repeat::FromStart,
                other => other,
            };
            all.push(MotionKind::Repeated {
                motion: motion.clone(),
                repetition: Repetition {
                    repeat,
                    ..*repetition
                },
            });
        }
        MotionKind::Cross { .. }
        | MotionKind::FingerPlay(_)
        | MotionKind::Still
        | MotionKind::Body(_) => {}
    }
    all
}

#[cfg(test)]
mod tests {
    use chereme_sign::hamnosys::{Sign, from_names, parse, text_of, to_names};

    use super::*;

    /// Returns the symbols of all similar readings of a movement, without their first three letters.
    fn readings(movement: &str) -> Vec<String> {
        let names: Vec<String> = movement.split(' ').map(|it| format!("ham{it}")).collect();
        let text = from_names(names.iter().map(String::as_str)).expect("symbols");
        let sign = parse(&text).expect("a movement").sign;
        let written = |actions: Vec<Motion>| {
            let mut other: Sign = sign.clone();
            other.parts[0].actions = actions;
            let names = to_names(&text_of(&other)).expect("symbols").join(" ");
            names.replace("ham", "")
        };
        let all = similar(&sign.parts[0].actions).into_iter();
        all.map(written).collect()
    }

    #[test]
    fn similar_readings_differ_in_size_curve_start_target_or_repetition() {
        assert_eq!(readings("moveo"), ["moveo smallmod", "moveo largemod"]);
        assert_eq!(
            readings("moveo arcu"),
            [
                "moveo smallmod arcu",
                "moveo arcu smallmod",
                "moveo largemod arcu",
                "moveo arcu largemod",
                "moveo",
            ]
        );
        assert_eq!(
            readings("circleo smallmod clockul repeatfromstart"),
            [
                "circleo clockul repeatfromstart",
                "circleo largemod clockul repeatfromstart",
                "circleo smallmod repeatfromstart",
                "circleo smallmod clockul repeatfromstartseveral",
                "circleo smallmod clockul",
            ]
        );
        assert_eq!(
            readings("moveo smallmod fast chest touch"),
            [
                "moveo fast chest touch",
                "moveo largemod fast chest touch",
                "moveo smallmod chest touch",
                "moveo smallmod fast",
            ]
        );
        assert_eq!(readings("nodding moveo").len(), 2 + 1 + 2 + 1);
        assert!(readings("nomotion").is_empty());
    }
}
