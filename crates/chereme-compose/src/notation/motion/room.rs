//! Moves circles that would lead into the trunk out of it, as a whole.

use super::super::tuned::tuned;
use super::*;

/// The number of points of a circle that are tried.
const POINTS: usize = 16;
/// Step by which a circle is moved, in metres.
const STEP: f64 = 0.01;
/// The largest number of such steps.
const STEPS: usize = 30;

impl Planner<'_> {
    /// Moves the circle that acting hands have just been given forward or to their own side, until it is clear of the
    /// trunk. A circle on the skin stays there.
    pub(super) fn make_room(&mut self, path: &Path, who: Who, [from, to]: [f64; 2]) {
        for (n, frame) in acting(who) {
            let Some(hand) = self.signer.stage.hand(self.signer.sides[n]) else {
                continue;
            };
            if self.skin(n, frame).is_some() {
                continue;
            }
            let stage = self.signer.stage;
            let sign = if frame.behind { -1.0 } else { 1.0 };
            let own = path.map(|v| stage.direction(v * frame.axes * sign));
            let state = &self.state[n];
            let start = state.wrist() - own.end();
            let outline = &self.plan.shapes[n][state.shape].outline.points;
            let deep = |by: DVec3| {
                let points = (0..=POINTS).map(|at| {
                    let wrist = start + own.at(at as f64 / POINTS as f64) + by;
                    let parts = outline.iter().map(|part| wrist + state.rotation * *part);
                    let parts = parts.chain([wrist]);
                    let out = parts
                        .map(|part| stage.torso.offset_out(part, tuned().solve.margin).length());
                    out.fold(0.0, f64::max)
                });
                points.fold(0.0, f64::max)
            };
            if deep(DVec3::ZERO) < tuned().motion.shallow {
                continue;
            }
            let outside = stage.left * hand.side.sign();
            let directions = [stage.forward, (stage.forward + outside).normalize()];
            let steps = (1..=STEPS)
                .flat_map(|step| directions.map(|direction| direction * (STEP * step as f64)));
            let Some(by) = steps
                .into_iter()
                .find(|by| deep(*by) < tuned().motion.shallow)
            else {
                continue;
            };
            self.remark(&format!(
                "the {} hand's circle is moved {:.0} cm, so that it stays out of the trunk",
                hand.side.name(),
                by.length() * 100.0
            ));
            self.state[n].point += by;
            self.plan.events[n].push(Event {
                from,
                to: from + tuned().motion.soon * (to - from),
                pace: Pace::Linear,
                act: Act::Move(Path::Line(by)),
            });
        }
    }
}
