//! Chooses the degrees of freedom of an arm over time: its plane, its shoulder, and the limit at which an over-rotated
//! forearm stops.
//!
//! Each choice has a cost: its effect on the wrist, the hand's orientation and the trunk, and its distance from the
//! choice before. Dynamic programming finds the cheapest course. The collar bone shifts the shoulder along the upper
//! arm only around moments at which the hand could not keep its orientation otherwise.

use std::sync::LazyLock;

use chereme_motion::WristAngles;
use chereme_motion::glam::{DQuat, DVec3};

use super::notation_arm::{ArmBearing, ArmPosture};
use super::notation_solve::{ArmSolver, WantedHand};
use super::notation_stage::HandOutline;
use super::notation_tuned::tuned;

/// Candidate planes relative to the rule's: the first, the last and the step, in degrees.
const ARM_PLANES_DEGREES: (f64, f64, f64) = (-50.0, 120.0, 10.0);
/// Candidate shrugs if the hand's orientation would suffer, as shares of the largest.
const SHRUG_SHARES: [f64; 4] = [-1.0, -0.5, 0.5, 1.0];

/// A posture of the arm to be tried: its bearing, its joints, and its cost whatever the hand's orientation, with the part of
/// it that stems from an upper arm in the trunk.
#[derive(Clone, Copy)]
struct TriedPosture {
    bearing: ArmBearing,
    posed: ArmPosture,
    held: (f64, f64),
}

/// A candidate posture of the arm at one moment.
#[derive(Clone, Copy)]
pub(crate) struct ArmPostureChoice {
    pub(crate) bearing: ArmBearing,
    angles: WristAngles,
    pub(crate) high: bool,
    /// Whether the forearm stops at a limit, so that `high` makes a difference.
    over: bool,
    /// Positions of the elbow and the wrist, in arm lengths.
    elbow: DVec3,
    wrist: DVec3,
    cost: f64,
    /// The part of the cost that stems from deviations of the hand's orientation and place, and from an arm inside the
    /// trunk.
    amiss: f64,
    /// Whether the hand is on its way from rest or back.
    away: bool,
}

/// The leeway of a hand at one moment.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct HandLeeway {
    /// Whether the hand is between two notated orientations.
    pub(crate) free: bool,
    /// Whether the hand is on its way from rest or back.
    pub(crate) away: bool,
}

impl ArmSolver<'_> {
    /// Returns the cheapest posture for a hand that stays in place.
    pub(crate) fn cheapest_still_bearing(&self, wrist: DVec3, turned: DQuat) -> ArmBearing {
        let wrist_target = WantedHand {
            point: wrist,
            offset: DVec3::ZERO,
            turned,
            outlines: [HandOutline::EMPTY_HAND_OUTLINE; 2],
            touch: 0.0,
        };
        let mut choices = self.arm_plane_choices(&wrist_target, HandLeeway::default());
        if choices[best_choice_index(&choices)].amiss > tuned().freedom.shrugs_above {
            self.add_shrugged_choices(&mut choices, &wrist_target, HandLeeway::default());
        }
        refined(&choices, best_choice_index(&choices))
    }

    /// Returns the cost of the best posture for a position of the wrist and a rotation of the hand; costs of
    /// at least `most` need not be exact.
    pub(crate) fn best_posture_cost(&self, wrist: DVec3, turned: DQuat, most: f64) -> f64 {
        let line = self.solver_arm_rig().fix_wrist_position(wrist, self.limits);
        // The postures in the planes tried so far, without a shrug.
        let mut posed_arms: Vec<ArmPosture> = Vec::with_capacity(EASIEST_ARM_PLANES.len());
        // Start with the rule's plane: planes whose deviation alone costs more than the best need no
        // evaluation.
        let mut least_strain = |shrug: f64, most: f64| {
            let shrugged = tuned().freedom.shrugged * shrug * shrug;
            let mut least = most;
            for (n, &(plane, off)) in EASIEST_ARM_PLANES.iter().enumerate() {
                if 0.3 * off + shrugged >= least {
                    break;
                }
                if n == posed_arms.len() {
                    posed_arms.push(line.posture_in_plane(plane));
                }
                let bearing = ArmBearing { plane, shrug };
                let posed = self
                    .solver_arm_rig()
                    .shrug_arm_posture(posed_arms[n], wrist, bearing, self.limits);
                let strained = self.hand_rotation_cost(wrist, turned, &posed, off, least - shrugged);
                least = least.min(strained + shrugged);
            }
            least
        };
        let still = least_strain(0.0, most.max(tuned().freedom.shrugs_above));
        if still < tuned().freedom.shrugs_above {
            return still;
        }
        SHRUG_SHARES
            .into_iter()
            .fold(still.min(most), |known, shrug| least_strain(shrug, known))
    }

    /// Returns the same as `best_posture_cost`, for one posture whose plane costs `plane`; infinite if the cost surely exceeds
    /// `most`.
    fn hand_rotation_cost(&self, wrist: DVec3, turned: DQuat, posed: &ArmPosture, plane: f64, most: f64) -> f64 {
        let rig = self.solver_arm_rig();
        let missed = posed.wrist.distance(wrist) / rig.rig_arm_length();
        let held_strain = 0.3 * plane
            + tuned().freedom.raised * self.elbow_height(posed).max(0.0).powi(2)
            + self.flared(posed)
            + self.elbow_behind_cost(posed)
            + tuned().freedom.missed * missed * missed;
        if held_strain > most {
            return f64::INFINITY;
        }
        let trunk_strain = held_strain + self.arm_in_trunk_cost(posed);
        if trunk_strain > most {
            return f64::INFINITY;
        }
        let asked = rig.wrist_angles(posed, turned, &self.held);
        let low = asked.clamp_to_limits(&self.limits.wrist, false);
        let bent_strain = trunk_strain + self.bent_wrist_cost(&low);
        if bent_strain > most {
            return f64::INFINITY;
        }
        let off = |angles: WristAngles| {
            if angles == asked {
                return 0.0;
            }
            rig.hand_rotation_from_angles(posed, &angles, &self.held)
                .angle_between(turned)
        };
        let over = asked.forearm_turn_share(&self.limits.wrist) > 1.0;
        let apart = if over {
            off(low).min(off(asked.clamp_to_limits(&self.limits.wrist, true)))
        } else {
            off(low)
        };
        bent_strain + self.orientation_deviation_cost(apart)
    }

    /// Returns the cost of a bent wrist: more if it is folded towards the palm or the back of the hand.
    fn bent_wrist_cost(&self, angles: &WristAngles) -> f64 {
        let limits = &self.limits.wrist;
        let folded = angles.flexion.abs() / limits.flexion[usize::from(angles.flexion > 0.0)];
        let over = |share: f64, free: f64, cost: f64| cost * (share - free).max(0.0).powi(2);
        let (bent, fold) = (tuned().freedom.bent, tuned().freedom.folded);
        over(angles.wrist_bend_share(limits), bent.0, bent.1) + over(folded, fold.0, fold.1)
    }

    /// Returns the cost of a deviation from the notated orientation (rad).
    fn orientation_deviation_cost(&self, apart: f64) -> f64 {
        let apart = apart / self.limits.tolerance;
        let over = (apart - 1.0).max(0.0);
        tuned().freedom.turned * apart.min(1.0).powi(3) + 36.0 * over + 75.0 * over * over
    }

    /// Returns the usual height of the elbow above its shoulder (arm lengths) for a position of the wrist with the arm
    /// in the rule's plane.
    fn usual_elbow_height(&self, wrist: DVec3, posed: &ArmPosture) -> f64 {
        let length = self.solver_arm_rig().rig_arm_length();
        let [elbow, hand] = [posed.elbow, wrist].map(|at| (at.y - posed.shoulder.y) / length);
        let usual = -self.limits.usual_elbow_depth(hand);
        usual + (elbow - usual).max(0.0) * (hand / tuned().freedom.above).clamp(0.0, 1.0)
    }

    /// Returns the height of an elbow above its shoulder, in arm lengths.
    fn elbow_height(&self, posed: &ArmPosture) -> f64 {
        (posed.elbow.y - posed.shoulder.y) / self.solver_arm_rig().rig_arm_length()
    }

    /// Returns the cost of an elbow that is higher than usual, or even above its shoulder.
    fn raised(&self, posed: &ArmPosture, usual: f64) -> f64 {
        let height = self.elbow_height(posed);
        let over = [height - usual.max(0.0), height - usual].map(|over| over.max(0.0).powi(2));
        tuned().freedom.raised * over[0] + tuned().freedom.lifted * over[1]
    }

    /// Returns the cost of an elbow that stands out beside a low hand.
    fn flared(&self, posed: &ArmPosture) -> f64 {
        let low = (posed.shoulder.y - posed.wrist.y) / self.solver_arm_rig().rig_arm_length() - tuned().freedom.low;
        if low <= 0.0 {
            return 0.0;
        }
        let upper = posed.elbow - posed.shoulder;
        let outside = self.stage.left * self.solver_arm_rig().side.side_sign();
        let out = upper.dot(outside).atan2(-upper.y) - tuned().freedom.flared.0;
        if out <= 0.0 {
            return 0.0;
        }
        tuned().freedom.flared.1 * out * out * (low / tuned().freedom.low).min(1.0)
    }

    /// Returns the cost of an elbow before the middle of the trunk.
    fn crossed_elbow_cost(&self, posed: &ArmPosture) -> f64 {
        let outside = self.stage.left * self.solver_arm_rig().side.side_sign();
        let inwards = -(posed.elbow - posed.shoulder).dot(outside) / self.solver_arm_rig().rig_arm_length();
        let over = (inwards - tuned().freedom.crossed.0).max(0.0);
        tuned().freedom.crossed.1 * over * over
    }

    /// Returns the cost of an elbow behind its shoulder.
    fn elbow_behind_cost(&self, posed: &ArmPosture) -> f64 {
        let back = -(posed.elbow - posed.shoulder).dot(self.stage.forward) / self.solver_arm_rig().rig_arm_length();
        let over = (back - tuned().freedom.behind.0).max(0.0);
        tuned().freedom.behind.1 * over * over
    }

    /// Returns the cost of an upper arm inside the trunk.
    fn arm_in_trunk_cost(&self, posed: &ArmPosture) -> f64 {
        let cost = |share: f64| {
            let arm_point = posed.shoulder.lerp(posed.elbow, share);
            let deep = self.stage.torso.offset_out_of_trunk(arm_point, 0.035).length()
                / self.solver_arm_rig().rig_arm_length();
            tuned().freedom.within * deep * deep
        };
        cost(0.6) + cost(1.0)
    }

    /// Returns the cheapest course of postures over time; shrugs are tried only around moments at which
    /// the hand suffers without them.
    pub(crate) fn choose_arm_postures<'w>(
        &self,
        wants: impl Iterator<Item = (WantedHand<'w>, HandLeeway)>,
        dt: f64,
    ) -> Vec<ArmPostureChoice> {
        let mut lists: Vec<((WantedHand<'w>, HandLeeway), Vec<ArmPostureChoice>)> = Vec::new();
        let mut of: Vec<usize> = Vec::new();
        for want in wants {
            if lists.last().is_none_or(|(known, _)| *known != want) {
                lists.push((want, self.arm_plane_choices(&want.0, want.1)));
            }
            of.push(lists.len() - 1);
        }
        let chosen = cheapest_posture_course(&lists, &of, dt);
        let near = (tuned().freedom.around / dt) as usize;
        let mut shrugs = vec![false; lists.len()];
        for (n, choice) in chosen.iter().enumerate() {
            if choice.amiss > tuned().freedom.shrugs_above {
                let around = n.saturating_sub(near)..(n + near + 1).min(of.len());
                of[around].iter().for_each(|&list| shrugs[list] = true);
            }
        }
        if !shrugs.contains(&true) {
            return chosen;
        }
        for (((want, leeway), list), _) in lists.iter_mut().zip(shrugs).filter(|(_, shrugs)| *shrugs) {
            self.add_shrugged_choices(list, want, *leeway);
        }
        cheapest_posture_course(&lists, &of, dt)
    }

    /// Returns the candidate planes with their costs, for either limit of the forearm.
    fn arm_plane_choices(&self, want: &WantedHand<'_>, leeway: HandLeeway) -> Vec<ArmPostureChoice> {
        let mut choices: Vec<ArmPostureChoice> = Vec::with_capacity(2 * candidate_arm_planes().count());
        let wrist = want.wanted_wrist_position();
        let line = self.solver_arm_rig().fix_wrist_position(wrist, self.limits);
        let rule = line.posture_in_plane(0.0);
        let usual = self.usual_elbow_height(wrist, &rule);
        let bearing = ArmBearing::default();
        let on_rule = TriedPosture {
            bearing,
            posed: rule,
            held: self.held_posture_cost(&rule, bearing, usual),
        };
        let rule = self.arm_posture_choice(want, on_rule, false, leeway, usual);
        let tried = candidate_arm_planes().map(|plane| {
            let bearing = ArmBearing { plane, shrug: 0.0 };
            let posed = line.posture_in_plane(plane);
            TriedPosture {
                bearing,
                posed,
                held: self.held_posture_cost(&posed, bearing, usual),
            }
        });
        let tried: Vec<_> = tried.collect();
        for high in [false, true] {
            for (n, &on_plane) in tried.iter().enumerate() {
                let TriedPosture { bearing, posed, held } = on_plane;
                if high && !choices[n].over {
                    continue;
                }
                if bearing.plane == 0.0 && !high {
                    choices.push(rule);
                    continue;
                }
                choices.push(match held.0 > rule.cost + tuned().freedom.untried {
                    true => ArmPostureChoice {
                        bearing,
                        high,
                        over: false,
                        elbow: posed.elbow / self.solver_arm_rig().rig_arm_length(),
                        wrist: posed.wrist / self.solver_arm_rig().rig_arm_length(),
                        cost: held.0,
                        ..rule
                    },
                    false => self.arm_posture_choice(want, on_plane, high, leeway, usual),
                });
            }
        }
        choices
    }

    /// Returns the cost of a posture whatever the orientation of its hand, and the part of it that stems from an upper
    /// arm inside the trunk.
    fn held_posture_cost(&self, posed: &ArmPosture, bearing: ArmBearing, usual: f64) -> (f64, f64) {
        let within = self.arm_in_trunk_cost(posed);
        let shrugged = tuned().freedom.shrugged * bearing.shrug * bearing.shrug;
        let cost = off_rule(bearing.plane.to_degrees())
            + self.raised(posed, usual)
            + self.flared(posed)
            + self.crossed_elbow_cost(posed)
            + self.elbow_behind_cost(posed)
            + shrugged
            + within;
        (cost, within)
    }

    /// Adds shrugged postures for the planes in which the hand suffers.
    fn add_shrugged_choices(&self, choices: &mut Vec<ArmPostureChoice>, want: &WantedHand<'_>, leeway: HandLeeway) {
        let still = choices.clone();
        let wrist = want.wanted_wrist_position();
        let line = self.solver_arm_rig().fix_wrist_position(wrist, self.limits);
        let usual = self.usual_elbow_height(wrist, &line.posture_in_plane(0.0));
        let least = choices[best_choice_index(choices)].cost;
        // A shrug turns a forearm by about 20°, which cannot save a far worse candidate.
        let is_hopeful = |choice: &&ArmPostureChoice| {
            choice.amiss > 0.2 * tuned().freedom.shrugs_above
                && choice.cost < tuned().freedom.hopeless.0 * least + tuned().freedom.hopeless.1
        };
        let hopeful = still.iter().filter(is_hopeful);
        let hopeful: Vec<(&ArmPostureChoice, ArmPosture)> = hopeful
            .map(|choice| (choice, line.posture_in_plane(choice.bearing.plane)))
            .collect();
        for shrug in SHRUG_SHARES {
            for &(choice, posed) in &hopeful {
                let plane = choice.bearing.plane;
                let bearing = ArmBearing { plane, shrug };
                let posed = self
                    .solver_arm_rig()
                    .shrug_arm_posture(posed, wrist, bearing, self.limits);
                let shrugged = TriedPosture {
                    bearing,
                    posed,
                    held: self.held_posture_cost(&posed, bearing, usual),
                };
                choices.push(self.arm_posture_choice(want, shrugged, choice.high, leeway, usual));
            }
        }
    }

    /// Returns a candidate posture with its cost: deviation from the rule's plane, closeness of wrist and
    /// forearm to their limits, deviation of the hand's orientation, height of the elbow above its `usual` one, depth of
    /// the upper arm in the trunk, and distance from the goal. Between two notated orientations the
    /// hand's orientation hardly counts.
    fn arm_posture_choice(
        &self,
        want: &WantedHand<'_>,
        tried: TriedPosture,
        high: bool,
        leeway: HandLeeway,
        usual: f64,
    ) -> ArmPostureChoice {
        let TriedPosture { bearing, posed, held } = tried;
        let given = match leeway {
            HandLeeway { free: true, .. } => 0.02,
            HandLeeway { away: true, .. } => tuned().freedom.away,
            _ => 1.0,
        };
        // The whole outline of the hand counts only if it touches something.
        let (tries, outlines) = if want.touch > 0.0 {
            (4, want.outlines)
        } else {
            (2, [HandOutline::EMPTY_HAND_OUTLINE; 2])
        };
        let coarse = WantedHand { outlines, ..*want };
        let hung_hand = self.hang_from(posed, &coarse, bearing, high, tries);
        let twist = (hung_hand.angles.forearm_turn_share(&self.limits.wrist) - tuned().freedom.twisted.0).max(0.0);
        let apart = hung_hand.rotation.angle_between(want.turned);
        let missed = hung_hand.residual / self.solver_arm_rig().rig_arm_length();
        let off = given * self.orientation_deviation_cost(apart) + tuned().freedom.missed * missed * missed;
        let (held, within) = match hung_hand.posed.elbow == posed.elbow {
            true => held,
            false => self.held_posture_cost(&hung_hand.posed, bearing, usual),
        };
        let cost = held + self.bent_wrist_cost(&hung_hand.angles) + tuned().freedom.twisted.1 * twist * twist + off;
        let amiss = off + within;
        ArmPostureChoice {
            bearing,
            angles: hung_hand.angles,
            high,
            over: hung_hand.angles.forearm_turn_share(&self.limits.wrist) >= 0.999,
            elbow: hung_hand.posed.elbow / self.solver_arm_rig().rig_arm_length(),
            wrist: hung_hand.posed.wrist / self.solver_arm_rig().rig_arm_length(),
            cost,
            amiss,
            away: leeway.away,
        }
    }
}

/// Candidate planes (rad, relative to the rule's) with their costs, the cheapest first.
static EASIEST_ARM_PLANES: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    let mut all: Vec<(f64, f64)> = candidate_arm_planes()
        .map(|plane| (plane, off_rule(plane.to_degrees())))
        .collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all
});

/// Returns the candidate planes, in radians relative to the rule's.
fn candidate_arm_planes() -> impl Iterator<Item = f64> {
    let (first, last, step) = ARM_PLANES_DEGREES;
    let count = ((last - first) / step).round() as usize + 1;
    (0..count).map(move |n| (first + step * n as f64).to_radians())
}

/// Returns the cheapest course through the candidates of each moment.
fn cheapest_posture_course<K>(lists: &[(K, Vec<ArmPostureChoice>)], of: &[usize], dt: f64) -> Vec<ArmPostureChoice> {
    let mut sums: Vec<f64> = Vec::new();
    let mut came: Vec<Vec<usize>> = Vec::with_capacity(of.len());
    let mut last: &[ArmPostureChoice] = &[];
    let mut order: Vec<usize> = Vec::new();
    let changes = PostureChangeCosts::change_costs_within(dt);
    for &list in of {
        let choices = lists[list].1.as_slice();
        let mut next = Vec::with_capacity(choices.len());
        let mut from = Vec::with_capacity(choices.len());
        // In order of cost: candidates after one that exceeds the best sum need no evaluation.
        order.clear();
        order.extend(0..sums.len());
        order.sort_unstable_by(|&a, &b| sums[a].total_cmp(&sums[b]).then(a.cmp(&b)));
        for choice in choices {
            let mut least = (0, f64::INFINITY);
            for &n in &order {
                if sums[n] > least.1 {
                    break;
                }
                let Some(change) = changes.posture_change_cost(&last[n], choice, least.1 - sums[n]) else {
                    continue;
                };
                let sum = sums[n] + change;
                if sum < least.1 || (sum == least.1 && n < least.0) {
                    least = (n, sum);
                }
            }
            let (n, sum) = if last.is_empty() { (0, 0.0) } else { least };
            next.push(sum + choice.cost);
            from.push(n);
        }
        sums = next;
        came.push(from);
        last = choices;
    }
    let ends = sums.iter().enumerate();
    let mut n = ends.min_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(n, _)| n);
    let mut chosen: Vec<ArmPostureChoice> = Vec::with_capacity(of.len());
    for (&list, from) in of.iter().zip(&came).rev() {
        let choices = &lists[list].1;
        chosen.push(ArmPostureChoice {
            bearing: refined(choices, n),
            ..choices[n]
        });
        n = from[n];
    }
    chosen.reverse();
    chosen
}

/// Returns the cost of a plane, in degrees relative to the rule's: constant beyond 60°, and higher with
/// the elbow inwards, before the trunk.
fn off_rule(degrees: f64) -> f64 {
    let near = degrees.abs().min(60.0);
    let outwards = 0.7 * (near / 36.0).powi(2) + 0.05 * (degrees.abs() - near);
    if degrees < 0.0 {
        tuned().freedom.inwards * outwards
    } else {
        outwards
    }
}

/// The costs of changes from one candidate to another within a given time.
struct PostureChangeCosts {
    /// Reciprocals of the usual changes in that time: of the plane and the wrist's angles (1/rad), the shrug, the
    /// elbow, and the elbow beyond the wrist (1/arm length).
    plane: f64,
    bend: f64,
    shrug: f64,
    elbow: f64,
    pumping: f64,
    /// The cost of an elbow that moves farther than the wrist: within a sign, and away from it.
    pumped: (f64, f64),
}

impl PostureChangeCosts {
    /// Returns the costs for changes within `dt` seconds.
    fn change_costs_within(dt: f64) -> Self {
        let freedom = &tuned().freedom;
        Self {
            plane: 1.0 / (freedom.swivel * dt),
            bend: 1.0 / (0.6 * tuned().solve.bending * dt),
            shrug: 1.0 / (freedom.shrugging * dt),
            elbow: 1.0 / (freedom.elbow * dt),
            pumping: 1.0 / (freedom.pumping * dt),
            pumped: freedom.pumped,
        }
    }

    /// Returns the cost of a change; `None` if it surely exceeds `most`.
    fn posture_change_cost(&self, from: &ArmPostureChoice, to: &ArmPostureChoice, most: f64) -> Option<f64> {
        let over = |speed: f64| {
            let over = (speed - 1.0).max(0.0);
            over * over
        };
        let most = most * (1.0 + 1e-9) + 1e-9;
        let swivel = (to.bearing.plane - from.bearing.plane).abs() * self.plane;
        let shrug = (to.bearing.shrug - from.bearing.shrug).abs() * self.shrug;
        let swivel_cost = 0.6 * (swivel * swivel + shrug * shrug) + 60.0 * over(swivel) + 20.0 * over(shrug);
        if swivel_cost > most {
            return None;
        }
        let angle_cost = swivel_cost + 6.0 * over(to.angles.largest_angle_difference(&from.angles) * self.bend);
        if angle_cost > most {
            return None;
        }
        let far = to.elbow.distance(from.elbow);
        let pumps = (far - to.wrist.distance(from.wrist)).max(0.0) * self.pumping;
        let pumped = match from.away && to.away {
            true => self.pumped.1,
            false => self.pumped.0,
        };
        Some(angle_cost + pumped * pumps * pumps + 150.0 * over(far * self.elbow))
    }
}

fn best_choice_index(choices: &[ArmPostureChoice]) -> usize {
    let least = choices.iter().enumerate().min_by(|a, b| a.1.cost.total_cmp(&b.1.cost));
    least.map_or(0, |(n, _)| n)
}

/// Returns a candidate refined to the minimum of parabolas through the costs of its neighbours.
fn refined(choices: &[ArmPostureChoice], n: usize) -> ArmBearing {
    let here = choices[n];
    let step = ARM_PLANES_DEGREES.2.to_radians();
    let neighbour = |plane: f64, shrug: f64| {
        choices.iter().find(|other| {
            (other.high == here.high || !other.over)
                && (other.bearing.plane - here.bearing.plane - plane).abs() < 1e-6
                && (other.bearing.shrug - here.bearing.shrug - shrug).abs() < 1e-6
        })
    };
    let by = |less: Option<&ArmPostureChoice>, more: Option<&ArmPostureChoice>| {
        let (Some(less), Some(more)) = (less, more) else {
            return 0.0;
        };
        let bent = less.cost - 2.0 * here.cost + more.cost;
        if bent <= 1e-9 {
            return 0.0;
        }
        (0.5 * (less.cost - more.cost) / bent).clamp(-0.5, 0.5)
    };
    let plane = by(neighbour(-step, 0.0), neighbour(step, 0.0));
    let shrug = if here.bearing.shrug == 0.0 {
        0.0
    } else {
        by(neighbour(0.0, -0.5), neighbour(0.0, 0.5))
    };
    ArmBearing {
        plane: here.bearing.plane + plane * step,
        shrug: here.bearing.shrug + shrug * 0.5,
    }
}
