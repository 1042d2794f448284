//! Directions relative to the movement: the hand turns with its path.

use chereme_motion::glam::DQuat;

use super::super::tuned::tuned;
use super::*;

impl Planner<'_> {
    /// Turns a hand with relative direction or palm along with its path.
    pub(super) fn follow(&mut self, n: usize, path: &Path, [from, to]: [f64; 2], pace: Pace) {
        if !self.state[n].follows || matches!(path, Path::Wave { .. } | Path::Spring(_)) {
            return;
        }
        let (Some(first), Some(last)) = (path.heading(0.0), path.heading(1.0)) else {
            return;
        };
        let before = self.state[n].heading.replace(last);
        let corner =
            before.filter(|before| before.angle_between(first) < tuned().motion.leads_back);
        let corner = corner.map_or(DQuat::IDENTITY, |before| {
            DQuat::from_rotation_arc(before, first)
        });
        let turned = (path.turned(1.0) * corner * self.state[n].rotation).normalize();
        if turned.angle_between(self.state[n].rotation) < 1e-6 && path.turned(0.5).w.abs() > 0.9999
        {
            return;
        }
        self.state[n].rotation = turned;
        self.plan.events[n].push(Event {
            from,
            to,
            pace,
            act: Act::Follow {
                path: path.clone(),
                corner,
                to: turned,
            },
        });
    }
}
