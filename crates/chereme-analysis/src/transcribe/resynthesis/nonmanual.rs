//! Reads the acts of trunk, head and shoulders by re-synthesis.
//!
//! A body that leans, or whose head is turned, takes the hands and their places with it. The animator puts the hands as
//! observed only if it is given the same acts. So each act that it can animate is synthesised with the first reading of the
//! hands, and the one that turns the joints as observed is kept.

use chereme_motion::{Clip, Part, Side};
use chereme_sign::hamnosys::{Act, Nonmanual, NonmanualPart, TierKind};

use super::*;

/// Angle (rad) between observed and re-synthesised joints above which acts are tried: less than the sway of a trunk.
const OTHERWISE: f64 = 0.0005;

/// An act is kept if it leaves less than this share of the angle that remains without it.
const CONVINCING: f64 = 0.4;

/// Angle (rad) that remains at most if the trunk stands straight: that act only replaces the sway, which is small.
const STRAIGHT: f64 = 1e-4;

/// The most acts that one tier has at the same time.
const TOGETHER: usize = 2;

/// Frames in which joints are compared, at even shares of the sign.
const COMPARED: usize = 24;

/// A tier with its acts that turn joints. Of several acts that are animated alike, it has one.
struct Tier {
    kind: TierKind,
    part: NonmanualPart,
    tags: &'static [&'static str],
    joints: &'static [Part],
}

/// The tiers in the order in which they are read: acts of the trunk also turn the head and the shoulders.
const TIERS: [Tier; 3] = [
    Tier {
        kind: TierKind::Body,
        part: NonmanualPart::Body,
        tags: &["ST", "TF", "TB", "TL", "TR", "RL", "RR", "RD", "SI", "HE"],
        joints: &[Part::Spine, Part::Chest],
    },
    Tier {
        kind: TierKind::Head,
        part: NonmanualPart::Head,
        tags: &["NO", "SH", "SL", "SR", "TL", "TR", "NF", "NB", "PF", "PB"],
        joints: &[Part::Neck, Part::Head],
    },
    Tier {
        kind: TierKind::Shoulder,
        part: NonmanualPart::Shoulders,
        tags: &["UL", "UR", "UB", "HL", "HR", "HB", "SL", "SR", "SB"],
        joints: &[Part::Clavicle(Side::Right), Part::Clavicle(Side::Left)],
    },
];

impl Tier {
    /// Returns acts with one more in this tier, at the same time as its others.
    fn with(&self, acts: &Nonmanual, tag: &str) -> Nonmanual {
        let mut acts = acts.clone();
        let act = Act::new(self.part, tag);
        match acts
            .tiers
            .get_mut(&self.kind)
            .and_then(|tier| tier.groups.last_mut())
        {
            Some(group) => group.push(act),
            None => acts.push(self.kind, vec![act]),
        }
        acts
    }
}

impl Proof<'_, '_> {
    /// Returns the acts of trunk, head and shoulders that turn their joints as observed while the hands perform a trial.
    pub(super) fn acts(&self, at: &Trial) -> Nonmanual {
        let mut found = Nonmanual::default();
        let sign = at.sign(&self.inferred);
        for tier in &TIERS {
            let with = |acts: &Nonmanual| Notated {
                sign: sign.clone(),
                nonmanual: acts.clone(),
                ..Notated::default()
            };
            let off = |clip: Option<Clip>| Some(self.turned_off(&clip?, tier.joints));
            let Some(mut least) = off(self.performs.performs(&with(&found))) else {
                return found;
            };
            for _ in 0..TOGETHER {
                if least < OTHERWISE {
                    break;
                }
                let others: Vec<Nonmanual> =
                    tier.tags.iter().map(|tag| tier.with(&found, tag)).collect();
                let signs: Vec<Notated> = others.iter().map(with).collect();
                let clips = self.performs.perform_all(&signs);
                let turned = tier.tags.iter().zip(others).zip(clips);
                let turned =
                    turned.filter_map(|((tag, acts), clip)| Some((off(clip)?, *tag, acts)));
                let nearest = turned.min_by(|a, b| a.0.total_cmp(&b.0));
                let kept = |(off, tag, _): &(f64, &str, Nonmanual)| {
                    *off < CONVINCING * least && (*tag != "ST" || *off < STRAIGHT)
                };
                let Some((off, _, acts)) = nearest.filter(kept) else {
                    break;
                };
                (least, found) = (off, acts);
            }
        }
        found
    }

    /// Returns the mean angle (rad) between joints in a synthesised clip and as observed, at equal shares of the sign.
    fn turned_off(&self, clip: &Clip, joints: &[Part]) -> f64 {
        let scene = self.sight.scene;
        let from = self.compared_from();
        let [observed, made] = [scene.clip.frames() - from, clip.frames()];
        let mut joints: Vec<usize> = joints
            .iter()
            .filter_map(|part| scene.anatomy.joint(*part))
            .collect();
        joints.dedup();
        let at = |frames: usize, n: usize| (frames - 1) * n / (COMPARED - 1);
        let angles = (0..COMPARED).flat_map(|n| {
            let own = scene.clip.pose(from + at(observed, n));
            let there = clip.pose(at(made, n));
            let each = joints
                .iter()
                .map(move |&joint| own.rotations[joint].angle_between(there.rotations[joint]));
            each.collect::<Vec<_>>()
        });
        angles.sum::<f64>() / (COMPARED * joints.len().max(1)) as f64
    }
}
