//! Chooses the degrees of freedom of an arm over time: its plane, its shoulder, and the limit at which an over-rotated
//! forearm stops.
//!
//! Each choice has a cost: its effect on the wrist, the hand's orientation and the trunk, and its distance from the
//! choice before. Dynamic programming finds the cheapest course. The collar bone shifts the shoulder along the upper
//! arm only around moments at which the hand could not keep its orientation otherwise.

use std::sync::LazyLock;

use chereme_motion::WristAngles;
use chereme_motion::glam::{DQuat, DVec3};

use super::arm::{Bearing, Posed};
use super::solve::{Arm, Want};
use super::stage::HandOutline;
use super::tuned::tuned;

/// Candidate planes relative to the rule's: the first, the last and the step, in degrees.
const PLANES: (f64, f64, f64) = (-50.0, 120.0, 10.0);
/// Candidate shrugs if the hand's orientation would suffer, as shares of the largest.
const SHRUGS: [f64; 4] = [-1.0, -0.5, 0.5, 1.0];

/// A candidate posture of the arm at one moment.
#[derive(Clone, Copy)]
pub(crate) struct Choice {
    pub(crate) bearing: Bearing,
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
pub(crate) struct Leeway {
    /// Whether the hand is between two notated orientations.
    pub(crate) free: bool,
    /// Whether the hand is on its way from rest or back.
    pub(crate) away: bool,
}

impl Arm<'_> {
    /// Returns the cheapest posture for a hand that stays in place.
    pub(crate) fn bearing(&self, wrist: DVec3, turned: DQuat) -> Bearing {
        let want = Want {
            point: wrist,
            offset: DVec3::ZERO,
            turned,
            outlines: [HandOutline::NONE; 2],
            touch: 0.0,
        };
        let mut choices = self.choices(&want, Leeway::default());
        if choices[best(&choices)].amiss > tuned().freedom.shrugs_above {
            self.shrug(&mut choices, &want, Leeway::default());
        }
        refined(&choices, best(&choices))
    }

    /// Returns the cost of the best posture for a position of the wrist and a rotation of the hand; costs of
    /// at least `most` need not be exact.
    pub(crate) fn strain(&self, wrist: DVec3, turned: DQuat, most: f64) -> f64 {
        let line = self.rig().line(wrist, self.limits);
        // The postures in the planes tried so far, without a shrug.
        let mut known: Vec<Posed> = Vec::with_capacity(EASIEST.len());
        // Start with the rule's plane: planes whose deviation alone costs more than the best need no
        // evaluation.
        let mut least = |shrug: f64, most: f64| {
            let shrugged = tuned().freedom.shrugged * shrug * shrug;
            let mut least = most;
            for (n, &(plane, off)) in EASIEST.iter().enumerate() {
                if 0.3 * off + shrugged >= least {
                    break;
                }
                if n == known.len() {
                    known.push(line.bent(plane));
                }
                let bearing = Bearing { plane, shrug };
                let posed = self.rig().shrug(known[n], wrist, bearing, self.limits);
                let strained = self.strained((wrist, turned), &posed, off, least - shrugged);
                least = least.min(strained + shrugged);
            }
            least
        };
        let still = least(0.0, most.max(tuned().freedom.shrugs_above));
        if still < tuned().freedom.shrugs_above {
            return still;
        }
        SHRUGS
            .into_iter()
            .fold(still.min(most), |known, shrug| least(shrug, known))
    }

    /// Returns the same as `strain`, for one posture whose plane costs `plane`; infinite if the cost surely exceeds
    /// `most`.
    fn strained(
        &self,
        (wrist, turned): (DVec3, DQuat),
        posed: &Posed,
        plane: f64,
        most: f64,
    ) -> f64 {
        let rig = self.rig();
        let missed = posed.wrist.distance(wrist) / rig.length();
        let held = 0.3 * plane
            + tuned().freedom.raised * self.height(posed).max(0.0).powi(2)
            + self.flared(posed)
            + self.behind(posed)
            + tuned().freedom.missed * missed * missed;
        if held > most {
            return f64::INFINITY;
        }
        let held = held + self.within(posed);
        if held > most {
            return f64::INFINITY;
        }
        let asked = rig.wrist(posed, turned, &self.held);
        let low = asked.allowed(&self.limits.wrist, false);
        let held = held + self.bent(&low);
        if held > most {
            return f64::INFINITY;
        }
        let off = |angles: WristAngles| {
            if angles == asked {
                return 0.0;
            }
            rig.hung(posed, &angles, &self.held).angle_between(turned)
        };
        let over = asked.turned(&self.limits.wrist) > 1.0;
        let apart = if over {
            off(low).min(off(asked.allowed(&self.limits.wrist, true)))
        } else {
            off(low)
        };
        held + self.off(apart)
    }

    /// Returns the cost of a bent wrist: more if it is folded towards the palm or the back of the hand.
    fn bent(&self, angles: &WristAngles) -> f64 {
        let limits = &self.limits.wrist;
        let folded = angles.flexion.abs() / limits.flexion[usize::from(angles.flexion > 0.0)];
        let over = |share: f64, (free, cost): (f64, f64)| cost * (share - free).max(0.0).powi(2);
        over(angles.bend(limits), tuned().freedom.bent) + over(folded, tuned().freedom.folded)
    }

    /// Returns the cost of a deviation from the notated orientation (rad).
    fn off(&self, apart: f64) -> f64 {
        let apart = apart / self.limits.tolerance;
        let over = (apart - 1.0).max(0.0);
        tuned().freedom.turned * apart.min(1.0).powi(3) + 36.0 * over + 75.0 * over * over
    }

    /// Returns the usual height of the elbow above its shoulder (arm lengths) for a position of the wrist with the arm
    /// in the rule's plane.
    fn usual(&self, wrist: DVec3, posed: &Posed) -> f64 {
        let length = self.rig().length();
        let [elbow, hand] = [posed.elbow, wrist].map(|at| (at.y - posed.shoulder.y) / length);
        let usual = -self.limits.below(hand);
        usual + (elbow - usual).max(0.0) * (hand / tuned().freedom.above).clamp(0.0, 1.0)
    }

    /// Returns the height of an elbow above its shoulder, in arm lengths.
    fn height(&self, posed: &Posed) -> f64 {
        (posed.elbow.y - posed.shoulder.y) / self.rig().length()
    }

    /// Returns the cost of an elbow that is higher than usual, or even above its shoulder.
    fn raised(&self, posed: &Posed, usual: f64) -> f64 {
        let height = self.height(posed);
        let over = [height - usual.max(0.0), height - usual].map(|over| over.max(0.0).powi(2));
        tuned().freedom.raised * over[0] + tuned().freedom.lifted * over[1]
    }

    /// Returns the cost of an elbow that stands out beside a low hand.
    fn flared(&self, posed: &Posed) -> f64 {
        let low = (posed.shoulder.y - posed.wrist.y) / self.rig().length() - tuned().freedom.low;
        if low <= 0.0 {
            return 0.0;
        }
        let upper = posed.elbow - posed.shoulder;
        let outside = self.stage.left * self.rig().side.sign();
        let out = upper.dot(outside).atan2(-upper.y) - tuned().freedom.flared.0;
        if out <= 0.0 {
            return 0.0;
        }
        tuned().freedom.flared.1 * out * out * (low / tuned().freedom.low).min(1.0)
    }

    /// Returns the cost of an elbow before the middle of the trunk.
    fn crossed(&self, posed: &Posed) -> f64 {
        let outside = self.stage.left * self.rig().side.sign();
        let inwards = -(posed.elbow - posed.shoulder).dot(outside) / self.rig().length();
        let over = (inwards - tuned().freedom.crossed.0).max(0.0);
        tuned().freedom.crossed.1 * over * over
    }

    /// Returns the cost of an elbow behind its shoulder.
    fn behind(&self, posed: &Posed) -> f64 {
        let back = -(posed.elbow - posed.shoulder).dot(self.stage.forward) / self.rig().length();
        let over = (back - tuned().freedom.behind.0).max(0.0);
        tuned().freedom.behind.1 * over * over
    }

    /// Returns the cost of an upper arm inside the trunk.
    fn within(&self, posed: &Posed) -> f64 {
        let cost = |share: f64| {
            let at = posed.shoulder.lerp(posed.elbow, share);
            let deep = self.stage.torso.offset_out(at, 0.035).length() / self.rig().length();
            tuned().freedom.within * deep * deep
        };
        cost(0.6) + cost(1.0)
    }

    /// Returns the cheapest course of postures over time; shrugs are tried only around moments at which
    /// the hand suffers without them.
    pub(crate) fn choose<'w>(
        &self,
        wants: impl Iterator<Item = (Want<'w>, Leeway)>,
        dt: f64,
    ) -> Vec<Choice> {
        let mut lists: Vec<((Want<'w>, Leeway), Vec<Choice>)> = Vec::new();
        let mut of: Vec<usize> = Vec::new();
        for want in wants {
            if lists.last().is_none_or(|(known, _)| *known != want) {
                lists.push((want, self.choices(&want.0, want.1)));
            }
            of.push(lists.len() - 1);
        }
        let chosen = cheapest(&lists, &of, dt);
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
        for (((want, leeway), list), _) in
            lists.iter_mut().zip(shrugs).filter(|(_, shrugs)| *shrugs)
        {
            self.shrug(list, want, *leeway);
        }
        cheapest(&lists, &of, dt)
    }

    /// Returns the candidate planes with their costs, for either limit of the forearm.
    fn choices(&self, want: &Want<'_>, leeway: Leeway) -> Vec<Choice> {
        let mut choices: Vec<Choice> = Vec::with_capacity(2 * planes().count());
        let wrist = want.wrist();
        let line = self.rig().line(wrist, self.limits);
        let rule = line.bent(0.0);
        let usual = self.usual(wrist, &rule);
        let bearing = Bearing::default();
        let held = self.held(&rule, bearing, usual);
        let rule = self.choice(want, (bearing, rule, held), (false, leeway), usual);
        let tried = planes().map(|plane| {
            let bearing = Bearing { plane, shrug: 0.0 };
            let posed = line.bent(plane);
            (bearing, posed, self.held(&posed, bearing, usual))
        });
        let tried: Vec<_> = tried.collect();
        for high in [false, true] {
            for (n, &(bearing, posed, held)) in tried.iter().enumerate() {
                if high && !choices[n].over {
                    continue;
                }
                if bearing.plane == 0.0 && !high {
                    choices.push(rule);
                    continue;
                }
                choices.push(match held.0 > rule.cost + tuned().freedom.untried {
                    true => Choice {
                        bearing,
                        high,
                        over: false,
                        elbow: posed.elbow / self.rig().length(),
                        wrist: posed.wrist / self.rig().length(),
                        cost: held.0,
                        ..rule
                    },
                    false => self.choice(want, (bearing, posed, held), (high, leeway), usual),
                });
            }
        }
        choices
    }

    /// Returns the cost of a posture whatever the orientation of its hand, and the part of it that stems from an upper
    /// arm inside the trunk.
    fn held(&self, posed: &Posed, bearing: Bearing, usual: f64) -> (f64, f64) {
        let within = self.within(posed);
        let shrugged = tuned().freedom.shrugged * bearing.shrug * bearing.shrug;
        let cost = off_rule(bearing.plane.to_degrees())
            + self.raised(posed, usual)
            + self.flared(posed)
            + self.crossed(posed)
            + self.behind(posed)
            + shrugged
            + within;
        (cost, within)
    }

    /// Adds shrugged postures for the planes in which the hand suffers.
    fn shrug(&self, choices: &mut Vec<Choice>, want: &Want<'_>, leeway: Leeway) {
        let still = choices.clone();
        let wrist = want.wrist();
        let line = self.rig().line(wrist, self.limits);
        let usual = self.usual(wrist, &line.bent(0.0));
        let least = choices[best(choices)].cost;
        // A shrug turns a forearm by about 20°, which cannot save a far worse candidate.
        let hopeful = |choice: &&Choice| {
            choice.amiss > 0.2 * tuned().freedom.shrugs_above
                && choice.cost < tuned().freedom.hopeless.0 * least + tuned().freedom.hopeless.1
        };
        let hopeful = still.iter().filter(hopeful);
        let hopeful: Vec<(&Choice, Posed)> = hopeful
            .map(|choice| (choice, line.bent(choice.bearing.plane)))
            .collect();
        for shrug in SHRUGS {
            for &(choice, posed) in &hopeful {
                let plane = choice.bearing.plane;
                let bearing = Bearing { plane, shrug };
                let posed = self.rig().shrug(posed, wrist, bearing, self.limits);
                let held = self.held(&posed, bearing, usual);
                let tried = (bearing, posed, held);
                choices.push(self.choice(want, tried, (choice.high, leeway), usual));
            }
        }
    }

    /// Returns a candidate posture with its cost: deviation from the rule's plane, closeness of wrist and
    /// forearm to their limits, deviation of the hand's orientation, height of the elbow above its `usual` one, depth of
    /// the upper arm in the trunk, and distance from the goal. Between two notated orientations the
    /// hand's orientation hardly counts.
    fn choice(
        &self,
        want: &Want<'_>,
        (bearing, posed, held): (Bearing, Posed, (f64, f64)),
        (high, leeway): (bool, Leeway),
        usual: f64,
    ) -> Choice {
        let given = match leeway {
            Leeway { free: true, .. } => 0.02,
            Leeway { away: true, .. } => tuned().freedom.away,
            _ => 1.0,
        };
        // The whole outline of the hand counts only if it touches something.
        let (tries, outlines) = if want.touch > 0.0 {
            (4, want.outlines)
        } else {
            (2, [HandOutline::NONE; 2])
        };
        let coarse = Want { outlines, ..*want };
        let hung = self.hang_from(posed, &coarse, (bearing, high), tries);
        let twist = (hung.angles.turned(&self.limits.wrist) - tuned().freedom.twisted.0).max(0.0);
        let apart = hung.rotation.angle_between(want.turned);
        let missed = hung.residual / self.rig().length();
        let off = given * self.off(apart) + tuned().freedom.missed * missed * missed;
        let (held, within) = match hung.posed.elbow == posed.elbow {
            true => held,
            false => self.held(&hung.posed, bearing, usual),
        };
        let cost = held + self.bent(&hung.angles) + tuned().freedom.twisted.1 * twist * twist + off;
        let amiss = off + within;
        Choice {
            bearing,
            angles: hung.angles,
            high,
            over: hung.angles.turned(&self.limits.wrist) >= 0.999,
            elbow: hung.posed.elbow / self.rig().length(),
            wrist: hung.posed.wrist / self.rig().length(),
            cost,
            amiss,
            away: leeway.away,
        }
    }
}

/// Candidate planes (rad, relative to the rule's) with their costs, the cheapest first.
static EASIEST: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    let mut all: Vec<(f64, f64)> = planes()
        .map(|plane| (plane, off_rule(plane.to_degrees())))
        .collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all
});

/// Returns the candidate planes, in radians relative to the rule's.
fn planes() -> impl Iterator<Item = f64> {
    let (first, last, step) = PLANES;
    let count = ((last - first) / step).round() as usize + 1;
    (0..count).map(move |n| (first + step * n as f64).to_radians())
}

/// Returns the cheapest course through the candidates of each moment.
fn cheapest<K>(lists: &[(K, Vec<Choice>)], of: &[usize], dt: f64) -> Vec<Choice> {
    let mut sums: Vec<f64> = Vec::new();
    let mut came: Vec<Vec<usize>> = Vec::with_capacity(of.len());
    let mut last: &[Choice] = &[];
    let mut order: Vec<usize> = Vec::new();
    let changes = Changes::within(dt);
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
                let Some(change) = changes.cost(&last[n], choice, least.1 - sums[n]) else {
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
    let mut chosen: Vec<Choice> = Vec::with_capacity(of.len());
    for (&list, from) in of.iter().zip(&came).rev() {
        let choices = &lists[list].1;
        chosen.push(Choice {
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
struct Changes {
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

impl Changes {
    /// Returns the costs for changes within `dt` seconds.
    fn within(dt: f64) -> Self {
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
    fn cost(&self, from: &Choice, to: &Choice, most: f64) -> Option<f64> {
        let over = |speed: f64| {
            let over = (speed - 1.0).max(0.0);
            over * over
        };
        let most = most * (1.0 + 1e-9) + 1e-9;
        let swivel = (to.bearing.plane - from.bearing.plane).abs() * self.plane;
        let shrug = (to.bearing.shrug - from.bearing.shrug).abs() * self.shrug;
        let own =
            0.6 * (swivel * swivel + shrug * shrug) + 60.0 * over(swivel) + 20.0 * over(shrug);
        if own > most {
            return None;
        }
        let own = own + 6.0 * over(to.angles.apart(&from.angles) * self.bend);
        if own > most {
            return None;
        }
        let far = to.elbow.distance(from.elbow);
        let pumps = (far - to.wrist.distance(from.wrist)).max(0.0) * self.pumping;
        let pumped = match from.away && to.away {
            true => self.pumped.1,
            false => self.pumped.0,
        };
        Some(own + pumped * pumps * pumps + 150.0 * over(far * self.elbow))
    }
}

fn best(choices: &[Choice]) -> usize {
    let least = choices
        .iter()
        .enumerate()
        .min_by(|a, b| a.1.cost.total_cmp(&b.1.cost));
    least.map_or(0, |(n, _)| n)
}

/// Returns a candidate refined to the minimum of parabolas through the costs of its neighbours.
fn refined(choices: &[Choice], n: usize) -> Bearing {
    let here = choices[n];
    let step = PLANES.2.to_radians();
    let neighbour = |plane: f64, shrug: f64| {
        choices.iter().find(|other| {
            (other.high == here.high || !other.over)
                && (other.bearing.plane - here.bearing.plane - plane).abs() < 1e-6
                && (other.bearing.shrug - here.bearing.shrug - shrug).abs() < 1e-6
        })
    };
    let by = |less: Option<&Choice>, more: Option<&Choice>| {
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
    Bearing {
        plane: here.bearing.plane + plane * step,
        shrug: here.bearing.shrug + shrug * 0.5,
    }
}
