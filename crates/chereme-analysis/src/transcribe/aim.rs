//! Directions of the hand's axis, and of the palm about that axis.

mod wrist;

use std::f64::consts::FRAC_PI_8;
use std::sync::OnceLock;

use chereme_sign::hamnosys::{Aim, Compass, Direction, Frame, orientation};
use glam::{DQuat, DVec3};

use super::Found;
use crate::transcribe::tuned::tuned;

pub(super) use wrist::Wrist;

/// Returns the unit vector of an aim: left, up, forward.
pub(super) fn vector(aim: &Aim<Direction>) -> DVec3 {
    let of = |direction: Direction| DVec3::from(direction.vector());
    match aim.second {
        None => of(aim.first),
        Some(second) => (of(aim.first) + of(second)).normalize_or(of(aim.first)),
    }
}

/// Returns an angle from -π to π.
pub(super) fn wrapped(angle: f64) -> f64 {
    (angle + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
}

/// A direction that notation can write.
struct Pointing {
    aim: Aim<Direction>,
    at: DVec3,
    /// Its penalty in nepers.
    cost: f64,
}

/// Returns the 26 directions, and the directions half-way between two that have symbols, if not among the
/// 26.
fn pointings() -> &'static [Pointing] {
    static ALL: OnceLock<Vec<Pointing>> = OnceLock::new();
    ALL.get_or_init(|| {
        let mut all: Vec<Pointing> = Direction::all()
            .map(|direction| Pointing {
                aim: Aim::at(direction),
                at: direction.vector().into(),
                cost: if direction.has_symbol() {
                    0.0
                } else {
                    tuned().aim.corner
                },
            })
            .collect();
        let plain: Vec<Direction> = Direction::all().filter(|it| it.has_symbol()).collect();
        let mut pairs = Vec::new();
        for (n, &first) in plain.iter().enumerate() {
            for &second in &plain[n + 1..] {
                let apart = DVec3::from(first.vector()).angle_between(second.vector().into());
                let aim = Aim {
                    first,
                    second: Some(second),
                    approx: false,
                    frame: Frame::Plain,
                };
                pairs.extend((apart < tuned().aim.apart).then_some((apart, aim)));
            }
        }
        // If several pairs give the same direction, the pair nearest to each other is written.
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (apart, aim) in pairs {
            let at = vector(&aim);
            let wide = usize::from(apart > 0.9) + usize::from(apart > 1.3);
            if all.iter().all(|other| other.at.distance(at) > 1e-6) {
                let cost = tuned().aim.half[wide];
                all.push(Pointing { aim, at, cost });
            }
        }
        all
    })
}

/// Returns the candidate directions, with or without those half-way between two.
fn candidates(between: bool) -> impl Iterator<Item = &'static Pointing> {
    let all = pointings().iter();
    all.filter(move |it| between || it.aim.second.is_none())
}

/// Returns the candidate palms, with their angles (rad) and penalties (nepers).
fn palms(between: bool) -> Vec<(Aim<Compass>, f64, f64)> {
    let whole = Compass::ALL.map(|palm| (Aim::at(palm), palm.angle(), 0.0));
    let half = (0..8).map(|n| {
        let (palm, next) = (Compass::ALL[n], Compass::ALL[(n + 1) % 8]);
        let main = matches!(palm, Compass::D | Compass::R | Compass::U | Compass::L);
        let (first, second) = if main { (palm, next) } else { (next, palm) };
        let aim = Aim {
            second: Some(second),
            ..Aim::at(first)
        };
        (aim, palm.angle() + FRAC_PI_8, tuned().aim.half_palm)
    });
    let half = half.filter(|_| between);
    whole.into_iter().chain(half).collect()
}

/// Orders the two directions of a half-way direction: the nearer one first.
fn nearer_first(aim: &Aim<Direction>, to: DVec3) -> Aim<Direction> {
    let off = |direction: Direction| DVec3::from(direction.vector()).angle_between(to);
    match aim.second {
        Some(second) if off(second) < off(aim.first) => Aim {
            first: second,
            second: Some(aim.first),
            ..*aim
        },
        _ => *aim,
    }
}

/// Returns the direction nearest to a unit vector (left, up, forward): one of the 26, or half-way
/// between two that have symbols and are neighbours. Residuals are in degrees.
pub(super) fn nearest(direction: DVec3, between: bool) -> Found<Aim<Direction>> {
    let found = candidates(between).map(|it| {
        let off = it.at.angle_between(direction);
        let cost = it.aim.second.map_or(0.0, |_| it.cost);
        let aim = nearer_first(&it.aim, direction);
        (aim, off, off + tuned().aim.plain * cost)
    });
    Found::of(found.collect()).degrees()
}

/// Settings for reading directions.
#[derive(Debug, Clone, Copy)]
pub(super) struct How {
    /// Whether directions half-way between two are candidates.
    pub(super) between: bool,
    /// How loosely hands keep their orientation: 1 for synthesised movement.
    pub(super) loose: f64,
}

/// A reading of a hand's orientation.
#[derive(Debug, Clone)]
pub(super) struct Turned {
    pub(super) extended: Found<Aim<Direction>>,
    pub(super) palm: Found<Aim<Compass>>,
    /// Degrees by which the reading lies beyond the limit of wrist or forearm at which the hand stopped.
    pub(super) beyond: f64,
    /// Penalty against the likeliest reading, in nepers.
    pub(super) less: f64,
}

impl Turned {
    /// Returns the same reading of a hand that is observed along an axis and with a palm (unit vectors): its residuals are
    /// those to them.
    pub(super) fn seen_from(mut self, [along, normal]: [DVec3; 2]) -> Self {
        let at = vector(&self.extended.best);
        let facing = normal.reject_from_normalized(along);
        let onto = DQuat::from_rotation_arc(along, at);
        let shown = orientation::palm_angle(at.to_array(), (onto * facing).to_array());
        self.extended.residual = at.angle_between(along).to_degrees();
        self.palm.residual = wrapped(shown - self.palm.best.angle()).abs().to_degrees();
        self
    }
}

/// A candidate direction and palm.
#[derive(Clone, Copy)]
struct Meant {
    pointing: &'static Pointing,
    palm: (Aim<Compass>, f64),
    beyond: f64,
    score: f64,
}

/// Returns the likeliest pairs of direction and palm for a hand, at most `most` of them, the likeliest
/// first. The palm is the angle about the hand's axis, as
/// [`orientation`](chereme_sign::hamnosys::orientation) counts it. Residuals are the hand's distance from
/// them, in degrees.
///
/// A hand that stops at the limit of its wrist or forearm may be meant to be turned farther: such a
/// candidate is compared with the orientation at which it would stop.
pub(super) fn turned(
    along: DVec3,
    normal: DVec3,
    wrist: Option<&Wrist>,
    how: How,
    most: usize,
) -> Vec<Turned> {
    let facing = normal.reject_from_normalized(along);
    let own = [along, facing.normalize_or(along.any_orthonormal_vector())];
    let palms = palms(how.between);
    let mut all: Vec<Meant> = Vec::new();
    let far = |it: &&Pointing| it.at.angle_between(along) > tuned().aim.looked_at;
    for pointing in candidates(how.between).filter(|it| !far(it)) {
        all.extend(palms.iter().map(|&(palm, angle, cost)| {
            let facing = orientation::palm(pointing.at.to_array(), angle);
            let (likely, beyond) = likely(own, [pointing.at, facing.into()], wrist, how.loose);
            Meant {
                pointing,
                palm: (palm, angle),
                beyond,
                score: how.loose.sqrt() * (pointing.cost + cost) - likely,
            }
        }));
    }
    all.sort_by(|a, b| a.score.total_cmp(&b.score));
    let as_turned = |best: &Meant| {
        let is_best = |it: &&Meant| std::ptr::eq(it.pointing, best.pointing);
        let is_same = |it: &&Meant| std::ptr::eq(*it, best);
        let to = |it: &Meant| {
            let off = it.pointing.at.angle_between(along).to_degrees();
            (nearer_first(&it.pointing.aim, along), off)
        };
        let onto = DQuat::from_rotation_arc(along, best.pointing.at);
        let shown =
            orientation::palm_angle(best.pointing.at.to_array(), (onto * own[1]).to_array());
        let about = |it: &Meant| (it.palm.0, wrapped(shown - it.palm.1).abs().to_degrees());
        let (extended, palm) = (to(best), about(best));
        Turned {
            extended: Found {
                best: extended.0,
                residual: extended.1,
                runner_up: all.iter().find(|it| !is_best(it)).map(to),
            },
            palm: Found {
                best: palm.0,
                residual: palm.1,
                runner_up: all.iter().find(|it| is_best(it) && !is_same(it)).map(about),
            },
            beyond: best.beyond,
            less: best.score - all[0].score,
        }
    };
    all.iter().take(most).map(as_turned).collect()
}

/// Returns the log-likelihood of an observed orientation given the intended one, and by how many degrees a
/// joint limit stopped the hand before it.
fn likely(own: [DVec3; 2], meant: [DVec3; 2], wrist: Option<&Wrist>, loose: f64) -> (f64, f64) {
    let of = |off: f64| {
        let parts = tuned().aim.spread.iter().zip(tuned().aim.wider);
        let density = |((share, spread), wider): (&(f64, f64), i32)| {
            let spread = spread * loose.powi(wider);
            share * (-0.5 * (off / spread).powi(2)).exp() / spread.powi(3)
        };
        parts.map(density).sum::<f64>().max(f64::MIN_POSITIVE).ln()
    };
    let free = (of(apart(own, meant)), 0.0);
    let stopped = wrist.map_or_else(Vec::new, |wrist| wrist.stopped(meant));
    stopped.into_iter().fold(free, |best, at| {
        let beyond = apart(at, meant);
        let likely = of(apart(own, at)) - beyond / tuned().aim.beyond;
        if likely > best.0 {
            (likely, beyond)
        } else {
            best
        }
    })
}

/// Returns the angle of the rotation between two orientations, each an axis and a palm at a right angle to
/// it, in degrees.
fn apart([a, p]: [DVec3; 2], [b, q]: [DVec3; 2]) -> f64 {
    let trace = a.dot(b) + p.dot(q) + a.cross(p).dot(b.cross(q));
    ((trace - 1.0) / 2.0).clamp(-1.0, 1.0).acos().to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn likeliest(along: DVec3, normal: DVec3, wrist: Option<&Wrist>, how: How) -> Turned {
        turned(along, normal, wrist, how, 1).swap_remove(0)
    }

    const EXACTLY: How = How {
        between: true,
        loose: 1.0,
    };
    const PLAINLY: How = How {
        between: false,
        loose: 1.0,
    };

    #[test]
    fn directions_and_pairs_of_directions_are_recovered_from_their_vectors() {
        let all: Vec<Direction> = Direction::all().collect();
        for &a in &all {
            let found = nearest(a.vector().into(), true);
            assert_eq!(found.best, Aim::at(a));
            assert!(found.residual < 1e-6);
            for &b in all.iter().filter(|b| a.has_symbol() && b.has_symbol()) {
                let aim = Aim {
                    second: Some(b),
                    ..Aim::at(a)
                };
                let apart = DVec3::from(a.vector()).angle_between(b.vector().into());
                if (0.1..1.06).contains(&apart) {
                    let found = nearest(vector(&aim), true).best;
                    let apart = vector(&found).angle_between(vector(&aim));
                    assert!(apart < 1e-6, "{a} {b}: {apart}");
                }
            }
        }
    }

    #[test]
    fn palms_are_recovered_for_every_axis_even_with_a_small_tilt() {
        let tilt = DQuat::from_euler(glam::EulerRot::XYZ, 0.05, -0.06, 0.04);
        for direction in Direction::all() {
            for palm_of in Compass::ALL {
                let along = DVec3::from(direction.vector());
                let normal = orientation::palm(along.to_array(), palm_of.angle());
                let aim = Aim::at(direction);
                let found = likeliest(tilt * along, tilt * DVec3::from(normal), None, PLAINLY);
                if direction.has_symbol() {
                    assert_eq!(found.extended.best, aim, "{direction} {palm_of}");
                    assert_eq!(found.palm.best, Aim::at(palm_of), "{direction} {palm_of}");
                }
                assert!(found.palm.residual < 8.0);
                let exact = likeliest(along, normal.into(), None, EXACTLY);
                assert_eq!(
                    (exact.extended.best, exact.palm.best),
                    (aim, Aim::at(palm_of))
                );
            }
        }
        // The palm of a hand that points up with `d` faces away from the signer.
        let out = likeliest(DVec3::Y, DVec3::Z, None, EXACTLY);
        assert_eq!(out.palm.best, Aim::at(Compass::D));
    }

    #[test]
    fn a_hand_at_the_limit_of_its_wrist_is_transcribed_with_the_intended_direction() {
        let arm = [
            DVec3::new(-0.2, 0.0, 0.0),
            DVec3::new(-0.25, -0.3, 0.05),
            DVec3::new(-0.2, -0.25, 0.3),
        ];
        let wrist = Wrist::of(arm, false, chereme_sign::hamnosys::BodyLanguage::usual());
        let meant = [DVec3::Y, DVec3::X];
        let stopped = wrist.map_or_else(Vec::new, |wrist| wrist.stopped(meant));
        // With the thumb up, it does not bend that far.
        let [along, normal] = stopped[0];
        assert!(along.angle_between(DVec3::Y) > 0.2);
        let found = likeliest(along, normal, wrist.as_ref(), EXACTLY);
        assert_eq!(found.extended.best, Aim::at(Direction::UP));
        assert!(found.beyond > 10.0 && found.extended.residual > 10.0);
        assert!(likeliest(along, normal, None, EXACTLY).extended.best != Aim::at(Direction::UP));
    }
}
