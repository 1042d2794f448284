//! Directions relative to the movement: the hand turns with its path.

use chereme_motion::glam::DQuat;

use super::super::notation_tuned::tuned;
use super::*;

impl SignPlanner<'_> {
    /// Turns a hand with relative direction or palm along with its path.
    pub(super) fn follow_path_direction(
        &mut self,
        n: usize,
        path: &HandPath,
        [from, to]: [f64; 2],
        pace: MovementPace,
    ) {
        if !self.state[n].follows || matches!(path, HandPath::Wave { .. } | HandPath::Spring(_)) {
            return;
        }
        let (Some(first), Some(last)) = (path.path_heading(0.0), path.path_heading(1.0)) else {
            return;
        };
        let before = self.state[n].heading.replace(last);
        let corner = before.filter(|before| before.angle_between(first) < tuned().motion.leads_back);
        let corner = corner.map_or(DQuat::IDENTITY, |before| DQuat::from_rotation_arc(before, first));
        let turned = (path.path_rotation_at(1.0) * corner * self.state[n].rotation).normalize();
        if turned.angle_between(self.state[n].rotation) < 1e-6 && path.path_rotation_at(0.5).w.abs() > 0.9999 {
            return;
        }
        self.state[n].rotation = turned;
        self.plan.events[n].push(HandEvent {
            from,
            to,
            pace,
            act: HandAct::Follow {
                path: path.clone(),
                corner,
                to: turned,
            },
        });
    }
}
