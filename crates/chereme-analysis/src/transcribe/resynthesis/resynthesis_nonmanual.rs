//! Reads the acts of trunk, head and shoulders by re-synthesis.
//!
//! A body that leans, or whose head is turned, takes the hands and their places with it. The animator puts the hands as
//! observed only if it is given the same acts. So each act that it can animate is synthesised with the first reading of the
//! hands, and the one that turns the joints as observed is kept.

use chereme_motion::{BodyPart, BodySide, Clip};
use chereme_sign::hamnosys::{NonmanualAct, NonmanualActs, NonmanualPart, TierKind};

use super::*;

/// Angle (rad) between observed and re-synthesised joints above which acts are tried: less than the sway of a trunk.
const MIN_ACT_ANGLE_RADIANS: f64 = 0.0005;

/// An act is kept if it leaves less than this share of the angle that remains without it.
const KEPT_ACT_SHARE: f64 = 0.4;

/// Angle (rad) that remains at most if the trunk stands straight: that act only replaces the sway, which is small.
const STRAIGHT_TRUNK_RADIANS: f64 = 1e-4;

/// The most acts that one tier has at the same time.
const MAX_SIMULTANEOUS_ACTS: usize = 2;

/// Frames in which joints are compared, at even shares of the sign.
const COMPARED_SIGN_FRAMES: usize = 24;

/// A tier with its acts that turn joints. Of several acts that are animated alike, it has one.
struct NonmanualActTier {
    kind: TierKind,
    part: NonmanualPart,
    tags: &'static [&'static str],
    joints: &'static [BodyPart],
}

/// The tiers in the order in which they are read: acts of the trunk also turn the head and the shoulders.
const NONMANUAL_ACT_TIERS: [NonmanualActTier; 3] = [
    NonmanualActTier {
        kind: TierKind::Body,
        part: NonmanualPart::Body,
        tags: &["ST", "TF", "TB", "TL", "TR", "RL", "RR", "RD", "SI", "HE"],
        joints: &[BodyPart::Spine, BodyPart::Chest],
    },
    NonmanualActTier {
        kind: TierKind::Head,
        part: NonmanualPart::Head,
        tags: &["NO", "SH", "SL", "SR", "TL", "TR", "NF", "NB", "PF", "PB"],
        joints: &[BodyPart::Neck, BodyPart::Head],
    },
    NonmanualActTier {
        kind: TierKind::Shoulder,
        part: NonmanualPart::Shoulders,
        tags: &["UL", "UR", "UB", "HL", "HR", "HB", "SL", "SR", "SB"],
        joints: &[BodyPart::Clavicle(BodySide::Right), BodyPart::Clavicle(BodySide::Left)],
    },
];

impl NonmanualActTier {
    /// Returns acts with one more in this tier, at the same time as its others.
    fn with_tier_act(&self, acts: &NonmanualActs, tag: &str) -> NonmanualActs {
        let mut acts = acts.clone();
        let act = NonmanualAct::new(self.part, tag);
        match acts.tiers.get_mut(&self.kind).and_then(|tier| tier.groups.last_mut()) {
            Some(group) => group.push(act),
            None => acts.push_act_group(self.kind, vec![act]),
        }
        acts
    }
}

impl TrialResynthesis<'_, '_> {
    /// Returns the acts of trunk, head and shoulders that turn their joints as observed while the hands perform a trial.
    pub(super) fn find_nonmanual_acts(&self, at: &ReadingTrial) -> NonmanualActs {
        let mut found_acts = NonmanualActs::default();
        let sign = at.apply_trial_places(&self.inferred);
        for tier in &NONMANUAL_ACT_TIERS {
            let with = |acts: &NonmanualActs| NotatedSign {
                sign: sign.clone(),
                nonmanual: acts.clone(),
                ..NotatedSign::default()
            };
            let off = |clip: Option<Clip>| Some(self.turned_off(&clip?, tier.joints));
            let Some(mut least) = off(self.performs.synthesise_notated_sign(&with(&found_acts))) else {
                return found_acts;
            };
            for _ in 0..MAX_SIMULTANEOUS_ACTS {
                if least < MIN_ACT_ANGLE_RADIANS {
                    break;
                }
                let others: Vec<NonmanualActs> = tier
                    .tags
                    .iter()
                    .map(|tag| tier.with_tier_act(&found_acts, tag))
                    .collect();
                let signs: Vec<NotatedSign> = others.iter().map(with).collect();
                let clips = self.performs.perform_all(&signs);
                let turned = tier.tags.iter().zip(others).zip(clips);
                let turned = turned.filter_map(|((tag, acts), clip)| Some((off(clip)?, *tag, acts)));
                let nearest = turned.min_by(|a, b| a.0.total_cmp(&b.0));
                let kept = |(off, tag, _): &(f64, &str, NonmanualActs)| {
                    *off < KEPT_ACT_SHARE * least && (*tag != "ST" || *off < STRAIGHT_TRUNK_RADIANS)
                };
                let Some((off, _, acts)) = nearest.filter(kept) else {
                    break;
                };
                (least, found_acts) = (off, acts);
            }
        }
        found_acts
    }

    /// Returns the mean angle (rad) between joints in a synthesised clip and as observed, at equal shares of the sign.
    fn turned_off(&self, clip: &Clip, joints: &[BodyPart]) -> f64 {
        let scene = self.sight.scene;
        let from = self.compared_from();
        let [observed, made] = [scene.clip.clip_frame_count() - from, clip.clip_frame_count()];
        let mut joints: Vec<usize> = joints
            .iter()
            .filter_map(|part| scene.anatomy.part_joint(*part))
            .collect();
        // A body may have one joint for spine and chest.
        joints.dedup();
        let sample_frame = |frames: usize, n: usize| (frames - 1) * n / (COMPARED_SIGN_FRAMES - 1);
        let angles = (0..COMPARED_SIGN_FRAMES).flat_map(|n| {
            let observed_pose = scene.clip.clip_pose_at(from + sample_frame(observed, n));
            let there = clip.clip_pose_at(sample_frame(made, n));
            let each = joints
                .iter()
                .map(move |&joint| observed_pose.rotations[joint].angle_between(there.rotations[joint]));
            each.collect::<Vec<_>>()
        });
        angles.sum::<f64>() / (COMPARED_SIGN_FRAMES * joints.len().max(1)) as f64
    }
}
