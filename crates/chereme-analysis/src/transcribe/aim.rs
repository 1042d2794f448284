//! Directions of the hand's axis, and of the palm about that axis.

mod aim_wrist;

use std::f64::consts::FRAC_PI_8;
use std::sync::OnceLock;

use chereme_sign::hamnosys::{CompassDirection, DirectionAim, DirectionFrame, SpatialDirection, orientation};
use glam::{DQuat, DVec3};

use super::BestReading;
use crate::transcribe::transcribe_tuned::tuned;

pub(super) use aim_wrist::ForearmWristLimits;

/// Returns the unit vector of an aim: left, up, forward.
pub(super) fn notated_aim_vector(aim: &DirectionAim<SpatialDirection>) -> DVec3 {
    let of = |direction: SpatialDirection| DVec3::from(direction.spatial_direction_vector());
    match aim.second {
        None => of(aim.first),
        Some(second) => (of(aim.first) + of(second)).normalize_or(of(aim.first)),
    }
}

/// Returns an angle from -π to π.
pub(super) fn wrap_signed_angle(angle: f64) -> f64 {
    (angle + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
}

/// A direction that notation can write.
struct WritableDirection {
    aim: DirectionAim<SpatialDirection>,
    at: DVec3,
    /// Its penalty in nepers.
    cost: f64,
}

/// Returns the 26 directions, and the directions half-way between two that have symbols, if not among the
/// 26.
fn pointings() -> &'static [WritableDirection] {
    static ALL_WRITABLE_DIRECTIONS: OnceLock<Vec<WritableDirection>> = OnceLock::new();
    ALL_WRITABLE_DIRECTIONS.get_or_init(|| {
        let mut all: Vec<WritableDirection> = SpatialDirection::all_spatial_directions()
            .map(|direction| WritableDirection {
                aim: DirectionAim::aim_at(direction),
                at: direction.spatial_direction_vector().into(),
                cost: if direction.has_symbol() {
                    0.0
                } else {
                    tuned().aim.corner
                },
            })
            .collect();
        let plain: Vec<SpatialDirection> = SpatialDirection::all_spatial_directions()
            .filter(|direction| direction.has_symbol())
            .collect();
        let mut pairs = Vec::new();
        for (n, &first) in plain.iter().enumerate() {
            for &second in &plain[n + 1..] {
                let apart = DVec3::from(first.spatial_direction_vector())
                    .angle_between(second.spatial_direction_vector().into());
                let aim = DirectionAim {
                    first,
                    second: Some(second),
                    approx: false,
                    frame: DirectionFrame::Plain,
                };
                pairs.extend((apart < tuned().aim.apart).then_some((apart, aim)));
            }
        }
        // If several pairs give the same direction, the pair nearest to each other is written.
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (apart, aim) in pairs {
            let aim_vector = notated_aim_vector(&aim);
            let wide = usize::from(apart > 0.9) + usize::from(apart > 1.3);
            if all.iter().all(|other| other.at.distance(aim_vector) > 1e-6) {
                let cost = tuned().aim.half[wide];
                all.push(WritableDirection {
                    aim,
                    at: aim_vector,
                    cost,
                });
            }
        }
        all
    })
}

/// Returns the candidate directions, with or without those half-way between two.
fn candidate_directions(between: bool) -> impl Iterator<Item = &'static WritableDirection> {
    let all = pointings().iter();
    all.filter(move |pointing| between || pointing.aim.second.is_none())
}

/// Returns the candidate palms, with their angles (rad) and penalties (nepers).
fn palms(between: bool) -> Vec<(DirectionAim<CompassDirection>, f64, f64)> {
    let cardinal_palms =
        CompassDirection::ALL_COMPASS_DIRECTIONS.map(|palm| (DirectionAim::aim_at(palm), palm.compass_angle(), 0.0));
    let half = (0..8).map(|n| {
        let (palm, next) = (
            CompassDirection::ALL_COMPASS_DIRECTIONS[n],
            CompassDirection::ALL_COMPASS_DIRECTIONS[(n + 1) % 8],
        );
        let main = matches!(
            palm,
            CompassDirection::D | CompassDirection::R | CompassDirection::U | CompassDirection::L
        );
        let (first, second) = if main { (palm, next) } else { (next, palm) };
        let aim = DirectionAim {
            second: Some(second),
            ..DirectionAim::aim_at(first)
        };
        (aim, palm.compass_angle() + FRAC_PI_8, tuned().aim.half_palm)
    });
    let half = half.filter(|_| between);
    cardinal_palms.into_iter().chain(half).collect()
}

/// Orders the two directions of a half-way direction: the nearer one first.
fn nearer_first(aim: &DirectionAim<SpatialDirection>, to: DVec3) -> DirectionAim<SpatialDirection> {
    let off = |direction: SpatialDirection| DVec3::from(direction.spatial_direction_vector()).angle_between(to);
    match aim.second {
        Some(second) if off(second) < off(aim.first) => DirectionAim {
            first: second,
            second: Some(aim.first),
            ..*aim
        },
        _ => *aim,
    }
}

/// Returns the direction nearest to a unit vector (left, up, forward): one of the 26, or half-way
/// between two that have symbols and are neighbours. Residuals are in degrees.
pub(super) fn nearest_notated_aim(direction: DVec3, between: bool) -> BestReading<DirectionAim<SpatialDirection>> {
    let ranked_pointings = candidate_directions(between).map(|pointing| {
        let off = pointing.at.angle_between(direction);
        let cost = pointing.aim.second.map_or(0.0, |_| pointing.cost);
        let aim = nearer_first(&pointing.aim, direction);
        (aim, off, off + tuned().aim.plain * cost)
    });
    BestReading::pick_best_reading(ranked_pointings.collect()).residuals_to_degrees()
}

/// Settings for reading directions.
#[derive(Debug, Clone, Copy)]
pub(super) struct AimReadingSettings {
    /// Whether directions half-way between two are candidates.
    pub(super) between: bool,
    /// How loosely hands keep their orientation: 1 for synthesised movement.
    pub(super) loose: f64,
}

/// A reading of a hand's orientation.
#[derive(Debug, Clone)]
pub(super) struct OrientationReading {
    pub(super) extended: BestReading<DirectionAim<SpatialDirection>>,
    pub(super) palm: BestReading<DirectionAim<CompassDirection>>,
    /// Degrees by which the reading lies beyond the limit of wrist or forearm at which the hand stopped.
    pub(super) beyond: f64,
    /// Penalty against the likeliest reading, in nepers.
    pub(super) less: f64,
}

impl OrientationReading {
    /// Returns the same reading of a hand that is observed along an axis and with a palm (unit vectors): its residuals are
    /// those to them.
    pub(super) fn seen_from(mut self, [along, normal]: [DVec3; 2]) -> Self {
        let extended_vector = notated_aim_vector(&self.extended.best);
        let facing = normal.reject_from_normalized(along);
        let onto = DQuat::from_rotation_arc(along, extended_vector);
        let shown = orientation::palm_angle(extended_vector.to_array(), (onto * facing).to_array());
        self.extended.residual = extended_vector.angle_between(along).to_degrees();
        self.palm.residual = wrap_signed_angle(shown - self.palm.best.aim_angle()).abs().to_degrees();
        self
    }
}

/// A candidate direction and palm.
#[derive(Clone, Copy)]
struct OrientationCandidate {
    pointing: &'static WritableDirection,
    palm: (DirectionAim<CompassDirection>, f64),
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
pub(super) fn likeliest_orientations(
    along: DVec3,
    normal: DVec3,
    wrist: Option<&ForearmWristLimits>,
    how: AimReadingSettings,
    most: usize,
) -> Vec<OrientationReading> {
    let facing = normal.reject_from_normalized(along);
    let hand_axes = [along, facing.normalize_or(along.any_orthonormal_vector())];
    let palms = palms(how.between);
    let mut all: Vec<OrientationCandidate> = Vec::new();
    let far = |pointing: &&WritableDirection| pointing.at.angle_between(along) > tuned().aim.looked_at;
    for pointing in candidate_directions(how.between).filter(|pointing| !far(pointing)) {
        all.extend(palms.iter().map(|&(palm, angle, cost)| {
            let facing = orientation::palm_direction_vector(pointing.at.to_array(), angle);
            let (likely, beyond) = likely(hand_axes, [pointing.at, facing.into()], wrist, how.loose);
            OrientationCandidate {
                pointing,
                palm: (palm, angle),
                beyond,
                score: how.loose.sqrt() * (pointing.cost + cost) - likely,
            }
        }));
    }
    all.sort_by(|a, b| a.score.total_cmp(&b.score));
    let as_turned = |best: &OrientationCandidate| {
        let is_best = |reading: &&OrientationCandidate| std::ptr::eq(reading.pointing, best.pointing);
        let is_same = |reading: &&OrientationCandidate| std::ptr::eq(*reading, best);
        let to = |reading: &OrientationCandidate| {
            let off = reading.pointing.at.angle_between(along).to_degrees();
            (nearer_first(&reading.pointing.aim, along), off)
        };
        let onto = DQuat::from_rotation_arc(along, best.pointing.at);
        let shown = orientation::palm_angle(best.pointing.at.to_array(), (onto * hand_axes[1]).to_array());
        let about = |reading: &OrientationCandidate| {
            (
                reading.palm.0,
                wrap_signed_angle(shown - reading.palm.1).abs().to_degrees(),
            )
        };
        let (extended, palm) = (to(best), about(best));
        OrientationReading {
            extended: BestReading {
                best: extended.0,
                residual: extended.1,
                runner_up: all.iter().find(|reading| !is_best(reading)).map(to),
            },
            palm: BestReading {
                best: palm.0,
                residual: palm.1,
                runner_up: all
                    .iter()
                    .find(|reading| is_best(reading) && !is_same(reading))
                    .map(about),
            },
            beyond: best.beyond,
            less: best.score - all[0].score,
        }
    };
    all.iter().take(most).map(as_turned).collect()
}

/// Returns the log-likelihood of an observed orientation given the intended one, and by how many degrees a
/// joint limit stopped the hand before it.
fn likely(own: [DVec3; 2], meant: [DVec3; 2], wrist: Option<&ForearmWristLimits>, loose: f64) -> (f64, f64) {
    let of = |off: f64| {
        let parts = tuned().aim.spread.iter().zip(tuned().aim.wider);
        let density = |((share, spread), wider): (&(f64, f64), i32)| {
            let spread = spread * loose.powi(wider);
            // A density over three axes of rotation has the third power of its spread.
            share * (-0.5 * (off / spread).powi(2)).exp() / spread.powi(3)
        };
        // Far from every spread the sum underflows to 0, which has no logarithm.
        parts.map(density).sum::<f64>().max(f64::MIN_POSITIVE).ln()
    };
    let free = (of(orientation_angle_between(own, meant)), 0.0);
    let stopped = wrist.map_or_else(Vec::new, |wrist| wrist.limited_palm_axes(meant));
    stopped.into_iter().fold(free, |best, at| {
        let beyond = orientation_angle_between(at, meant);
        let likely = of(orientation_angle_between(own, at)) - beyond / tuned().aim.beyond;
        if likely > best.0 { (likely, beyond) } else { best }
    })
}

/// Returns the angle of the rotation between two orientations, each an axis and a palm at a right angle to
/// it, in degrees.
fn orientation_angle_between([a, p]: [DVec3; 2], [b, q]: [DVec3; 2]) -> f64 {
    // The trace of a rotation is 1 more than twice the cosine of its angle.
    let trace = a.dot(b) + p.dot(q) + a.cross(p).dot(b.cross(q));
    ((trace - 1.0) / 2.0).clamp(-1.0, 1.0).acos().to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn likeliest(
        along: DVec3,
        normal: DVec3,
        wrist: Option<&ForearmWristLimits>,
        how: AimReadingSettings,
    ) -> OrientationReading {
        likeliest_orientations(along, normal, wrist, how, 1).swap_remove(0)
    }

    const EXACTLY: AimReadingSettings = AimReadingSettings {
        between: true,
        loose: 1.0,
    };
    const PLAINLY: AimReadingSettings = AimReadingSettings {
        between: false,
        loose: 1.0,
    };

    #[test]
    fn directions_and_pairs_of_directions_are_recovered_from_their_vectors() {
        let all: Vec<SpatialDirection> = SpatialDirection::all_spatial_directions().collect();
        for &a in &all {
            let found = nearest_notated_aim(a.spatial_direction_vector().into(), true);
            assert_eq!(found.best, DirectionAim::aim_at(a));
            assert!(found.residual < 1e-6);
            for &b in all.iter().filter(|b| a.has_symbol() && b.has_symbol()) {
                let aim = DirectionAim {
                    second: Some(b),
                    ..DirectionAim::aim_at(a)
                };
                let apart =
                    DVec3::from(a.spatial_direction_vector()).angle_between(b.spatial_direction_vector().into());
                if (0.1..1.06).contains(&apart) {
                    let found = nearest_notated_aim(notated_aim_vector(&aim), true).best;
                    let apart = notated_aim_vector(&found).angle_between(notated_aim_vector(&aim));
                    assert!(apart < 1e-6, "{a} {b}: {apart}");
                }
            }
        }
    }

    #[test]
    fn palms_are_recovered_for_every_axis_even_with_a_small_tilt() {
        let tilt = DQuat::from_euler(glam::EulerRot::XYZ, 0.05, -0.06, 0.04);
        for direction in SpatialDirection::all_spatial_directions() {
            for palm_of in CompassDirection::ALL_COMPASS_DIRECTIONS {
                let along = DVec3::from(direction.spatial_direction_vector());
                let normal = orientation::palm_direction_vector(along.to_array(), palm_of.compass_angle());
                let aim = DirectionAim::aim_at(direction);
                let found = likeliest(tilt * along, tilt * DVec3::from(normal), None, PLAINLY);
                if direction.has_symbol() {
                    assert_eq!(found.extended.best, aim, "{direction} {palm_of}");
                    assert_eq!(found.palm.best, DirectionAim::aim_at(palm_of), "{direction} {palm_of}");
                }
                assert!(found.palm.residual < 8.0);
                let exact = likeliest(along, normal.into(), None, EXACTLY);
                assert_eq!(
                    (exact.extended.best, exact.palm.best),
                    (aim, DirectionAim::aim_at(palm_of))
                );
            }
        }
        // The palm of a hand that points up with `d` faces away from the signer.
        let out = likeliest(DVec3::Y, DVec3::Z, None, EXACTLY);
        assert_eq!(out.palm.best, DirectionAim::aim_at(CompassDirection::D));
    }

    #[test]
    fn a_hand_at_the_limit_of_its_wrist_is_transcribed_with_the_intended_direction() {
        let arm = [
            DVec3::new(-0.2, 0.0, 0.0),
            DVec3::new(-0.25, -0.3, 0.05),
            DVec3::new(-0.2, -0.25, 0.3),
        ];
        let wrist = ForearmWristLimits::from_arm_positions(
            arm,
            false,
            chereme_sign::hamnosys::BodyLanguage::default_body_language(),
        );
        let meant = [DVec3::Y, DVec3::X];
        let stopped = wrist.map_or_else(Vec::new, |wrist| wrist.limited_palm_axes(meant));
        // With the thumb up, it does not bend that far.
        let [along, normal] = stopped[0];
        assert!(along.angle_between(DVec3::Y) > 0.2);
        let found = likeliest(along, normal, wrist.as_ref(), EXACTLY);
        assert_eq!(
            found.extended.best,
            DirectionAim::aim_at(SpatialDirection::UP_DIRECTION)
        );
        assert!(found.beyond > 10.0 && found.extended.residual > 10.0);
        assert!(
            likeliest(along, normal, None, EXACTLY).extended.best
                != DirectionAim::aim_at(SpatialDirection::UP_DIRECTION)
        );
    }
}
