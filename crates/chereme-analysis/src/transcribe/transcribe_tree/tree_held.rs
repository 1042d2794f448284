//! Reads the postures of a sign at its holds, channel by channel.

use chereme_motion::{RecordingInstant, TimeSpan};

use super::*;
use crate::cut::{ChannelPosture, HandChannel, find_channel_postures};

/// A posture of one channel of a hand, read in the middle of its hold.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldReading {
    /// The hand whose channel it is.
    pub hand: BodySide,
    /// The channel.
    pub channel: HandChannel,
    /// Its time in the clip, and how surely it is held.
    pub held: ChannelPosture,
    /// The hands of whom the posture is read: both, if they act alike and have one decision.
    pub hands: HandsUsed,
    /// The posture of all channels at that moment.
    pub posture: NotatedPosture,
    /// The features of that posture, with residuals and runners-up.
    pub features: Vec<NotationFeature>,
    /// The share of the hand's angles that the skeleton shows, from 0 to 1.
    pub shown: f64,
}

/// Returns the postures of a sign at the holds of each hand that acts.
pub(in crate::transcribe) fn read_held_postures<'a>(sight: &'a SceneReadings<'a>, sign: TimeSpan) -> Vec<HeldReading> {
    let scene = sight.scene;
    let Some(channels) = find_channel_postures(scene.clip, scene.anatomy, sign) else {
        return Vec::new();
    };
    let last = scene.clip.clip_frame_count() - 1;
    let rate = scene.clip.clip_frame_rate();
    let frame_at = |at: RecordingInstant| rate.nearest_frame_at(at).min(last);
    let frames = frame_at(sign.span_start_instant())..=frame_at(sign.span_end_instant());
    let relation = find_hand_relation(scene, &frames);
    let acting: &[usize] = match relation.kind {
        RelationKind::Unlike { .. } => &[0, 1],
        // Hands that act alike have one decision, at the holds of the dominant one.
        _ => &[sight.lead],
    };
    let mut readings = Vec::new();
    for track in acting.iter().filter_map(|n| scene.hands[*n].as_ref()) {
        let postures = &channels[usize::from(track.side == BodySide::Left)];
        for (channel, postures) in HandChannel::ALL_CHANNELS.into_iter().zip(postures) {
            for &held in postures {
                let frame = frame_at(held.moment);
                let mut writer = NotationWriter::new(sight, PickedReadings::default());
                let body = sight.cached_body_at(frame);
                let mut posture = writer.write_first_posture(frame, &relation, body.as_deref());
                if let (RelationKind::Alike(_), EachHand::Split(Some(own), _)) = (relation.kind, &posture.shape) {
                    posture.shape = EachHand::Shared(own.clone());
                }
                readings.push(HeldReading {
                    hand: track.side,
                    channel,
                    held,
                    hands: writer.choose_hands_used(&relation.kind),
                    posture,
                    shown: track.known.known_weight_share(),
                    features: writer.features,
                });
            }
        }
    }
    readings
}
