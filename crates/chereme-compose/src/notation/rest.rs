//! Hands at rest.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodySide, FingerAngles, HandAngles, ThumbAngles};
use chereme_sign::hamnosys::Handshape;

use super::notation_plan::HandState;
use super::notation_stage::{FingerShape, StandingBody};

/// Returns a hand that hangs next to the body, as in the stage's posture if it hangs there.
pub(crate) fn resting_hand_state(stage: &StandingBody, side: BodySide) -> (HandState, FingerShape) {
    let angles = relaxed();
    let shape = stage.finger_shape(side, &angles);
    let mut state = HandState {
        point: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        leaned: DQuat::IDENTITY,
        offset: DVec3::ZERO,
        shape: 0,
        handshape: Handshape::default(),
        direction: DVec3::Z,
        palm: 0.0,
        axes: [DVec3::ONE; 2],
        follows: false,
        heading: None,
        used: false,
    };
    let Some(hand) = stage.hand_of_side(side) else {
        return (state, shape);
    };
    let wrist = stage.model.model_joint_position(hand.hand_joint_index());
    let down = (hand.rig.shoulder - wrist).dot(DVec3::Y);
    if down > 0.75 * hand.rig.rig_arm_length() {
        state.point = wrist;
        state.rotation = stage.model.model_joint_rotation(hand.hand_joint_index());
        return (state, stage.shape_of(side, angles, &stage.base));
    }
    let outside = stage.left * side.side_sign();
    let hanging = DVec3::NEG_Y + outside * 0.16 + stage.forward * 0.10;
    state.point = hand.rig.shoulder + hanging.normalize() * (0.965 * hand.rig.rig_arm_length());
    let direction = (DVec3::NEG_Y + stage.forward * 0.18 - outside * 0.02).normalize();
    let palm = -outside - stage.forward * 0.35;
    if let Some(turned) = stage.hand_joint_rotation(side, direction, palm) {
        state.rotation = turned;
    }
    (state, shape)
}

/// Returns the finger angles of a relaxed hand.
fn relaxed() -> HandAngles {
    let degrees = |flexion: [f64; 3], spread: f64| FingerAngles { spread, flexion };
    HandAngles {
        thumb: ThumbAngles {
            radial: 28.0,
            palmar: 30.0,
            opposition: 15.0,
            flexion: [12.0, 15.0],
        },
        fingers: [
            degrees([18.0, 25.0, 12.0], 2.0),
            degrees([24.0, 30.0, 14.0], 0.0),
            degrees([28.0, 33.0, 16.0], -2.0),
            degrees([30.0, 34.0, 18.0], -5.0),
        ],
    }
    .map_hand_angles(f64::to_radians)
}
