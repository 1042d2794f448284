//! Blind transcription of disturbed movement: noise, wobble, missing end sites, coarse numbers, few frames.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;
use std::sync::Arc;

use chereme_analysis::transcribe::{TranscribeOptions, transcribe_clip};
use chereme_compose::GeneratedMovement;
use chereme_compose::notation::AnimatorSettings;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Clip, FrameRate, JointChannel, Skeleton, SkeletonJoint};

use crate::Result;
use crate::bodies;
use crate::compare::compare;
use crate::notation::{Again, is_short, made, parts_of, read_signs, seen, sign_span};

/// The features that the table shows.
const FEATURES: [&str; 7] = [
    "location",
    "location point",
    "handshape",
    "direction",
    "palm",
    "movement",
    "movements",
];

/// A disturbance of movement that was made from notation.
#[derive(Debug, Clone, Copy)]
enum Disturbance {
    Nothing,
    /// White noise of each joint about each axis, with this standard deviation in degrees.
    Noise(f64),
    /// Each joint swings about each axis at 1 to 3 Hz, by this many degrees.
    Wobble(f64),
    /// The file has no End Sites.
    NoEnds,
    /// Both, as in captures of other people.
    WobbleNoEnds(f64),
    /// Rotations have one decimal.
    OneDecimal,
    /// Resampled to this frame rate.
    Rate(u32),
}

use Disturbance::{NoEnds, Noise, Nothing, OneDecimal, Wobble, WobbleNoEnds};

const ALL: [Disturbance; 11] = [
    Nothing,
    Noise(0.1),
    Noise(0.2),
    Noise(0.5),
    Noise(1.0),
    Wobble(0.5),
    Wobble(1.0),
    NoEnds,
    WobbleNoEnds(1.0),
    OneDecimal,
    Disturbance::Rate(25),
];

impl Disturbance {
    fn name(self) -> String {
        match self {
            Nothing => "none".into(),
            Noise(degrees) => format!("noise of {degrees}°"),
            Wobble(degrees) => format!("wobble of {degrees}°"),
            NoEnds => "no end sites".into(),
            WobbleNoEnds(degrees) => format!("no end sites, wobble of {degrees}°"),
            OneDecimal => "one decimal".into(),
            Self::Rate(rate) => format!("{rate} Hz"),
        }
    }

    /// Returns the number of decimals of angles in the exported file.
    fn decimals(self) -> u8 {
        match self {
            OneDecimal => 1,
            _ => bodies::DECIMALS,
        }
    }

    fn of(self, clip: &Clip, seed: u64) -> Result<Clip> {
        let mut random = Random(seed);
        Ok(match self {
            Nothing | OneDecimal => clip.clone(),
            Noise(degrees) => noisy(clip, degrees.to_radians(), &mut random)?,
            Wobble(degrees) => wobbling(clip, degrees.to_radians(), &mut random)?,
            NoEnds => without_ends(clip)?,
            WobbleNoEnds(degrees) => without_ends(&wobbling(clip, degrees.to_radians(), &mut random)?)?,
            Self::Rate(rate) => clip.resample_clip(FrameRate::new(rate, 1)?),
        })
    }
}

/// Random numbers from a seed (Knuth's MMIX generator).
struct Random(u64);

impl Random {
    /// Returns a number between 0 and 1.
    fn share(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / 2f64.powi(31)
    }

    /// Returns a number with mean 0 and standard deviation 1, nearly normally distributed.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.share()).sum::<f64>() - 6.0
    }
}

/// Returns the clip with each joint's rotations turned further by `by(joint, frame)`, in its own space.
fn turned(clip: &Clip, mut by: impl FnMut(usize, usize) -> DVec3) -> Result<Clip> {
    let mut channels = clip.joint_channels().to_vec();
    for (joint, channel) in channels.iter_mut().enumerate() {
        for (frame, rotation) in channel.rotations.iter_mut().enumerate() {
            *rotation = (*rotation * DQuat::from_scaled_axis(by(joint, frame))).normalize();
        }
    }
    Ok(Clip::new(
        Arc::clone(clip.clip_skeleton()),
        clip.clip_frame_rate(),
        channels,
    )?)
}

fn noisy(clip: &Clip, by: f64, random: &mut Random) -> Result<Clip> {
    turned(clip, |_, _| {
        DVec3::new(random.normal(), random.normal(), random.normal()) * by
    })
}

fn wobbling(clip: &Clip, by: f64, random: &mut Random) -> Result<Clip> {
    let mut swings = || [0; 3].map(|_| (1.0 + 2.0 * random.share(), TAU * random.share()));
    let all: Vec<[(f64, f64); 3]> = clip.joint_channels().iter().map(|_| swings()).collect();
    turned(clip, |joint, frame| {
        let seconds = frame as f64 * clip.clip_frame_rate().frame_time();
        let swing = |(hertz, phase): (f64, f64)| (TAU * hertz * seconds + phase).sin();
        DVec3::from_array(all[joint].map(swing)) * by
    })
}

fn without_ends(clip: &Clip) -> Result<Clip> {
    let joints = clip.clip_skeleton().skeleton_joints().iter();
    let joints = joints.map(|joint| SkeletonJoint {
        tip: None,
        ..joint.clone()
    });
    let skeleton = Arc::new(Skeleton::new(joints.collect())?);
    let channels: Vec<JointChannel> = clip.joint_channels().to_vec();
    Ok(Clip::new(skeleton, clip.clip_frame_rate(), channels)?)
}

/// Prints how often each feature is found again in movement disturbed in each manner.
pub(crate) fn table(
    (folder, every): (&Path, usize),
    body: &Path,
    (rate, settings): (Option<u32>, AnimatorSettings),
) -> Result<()> {
    let stage = bodies::stage(body)?;
    let settings = AnimatorSettings {
        rate: match rate {
            Some(rate) => FrameRate::new(rate, 1)?,
            None => stage.clip.clip_frame_rate(),
        },
        ..settings
    };
    let signs = read_signs(folder)?;
    let todo = parts_of(&signs, every, |_| true);
    let verdicts = seen(&todo, |(name, entry, part)| {
        let made = made(part, entry, &stage, &settings)?;
        // Each sign has a seed of its own.
        let seed = name
            .bytes()
            .fold(17_u64, |sum, byte| sum.wrapping_mul(31) + u64::from(byte));
        let all = ALL.iter().map(|disturbance| {
            let again = again(&made, *disturbance, seed)?;
            let verdicts = compare(part, &again);
            let kept = verdicts.into_iter().filter(|it| FEATURES.contains(&it.feature));
            Some(kept.map(|it| (it.feature, it.agrees)).collect::<Vec<_>>())
        });
        Some(all.collect::<Vec<_>>())
    });
    println!("{} parts of signs", todo.len());
    println!("| disturbance | {} |", FEATURES.join(" | "));
    println!("|---|{}", "--:|".repeat(FEATURES.len()));
    for (n, disturbance) in ALL.iter().enumerate() {
        let mut counts: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
        let mut unread = 0;
        for each in verdicts.iter().flatten() {
            let Some(all) = &each[n] else {
                unread += 1;
                continue;
            };
            for (feature, agrees) in all {
                let count = counts.entry(feature).or_default();
                count.0 += usize::from(*agrees);
                count.1 += 1;
            }
        }
        let shares = FEATURES.map(|feature| match counts.get(feature) {
            Some(&(agree, of)) => format!("{:.1} %", 100.0 * agree as f64 / of as f64),
            None => String::new(),
        });
        println!("| {} | {} |", disturbance.name(), shares.join(" | "));
        if unread > 0 {
            println!("{unread} parts could not be read with {}", disturbance.name());
        }
    }
    Ok(())
}

/// Disturbs movement, exports it as BVH, imports it without its notation, and transcribes it like a capture.
fn again(made: &GeneratedMovement, disturbance: Disturbance, seed: u64) -> Option<Again> {
    let disturbed = disturbance.of(&made.clip, seed).ok()?;
    let (clip, anatomy) = bodies::again(&disturbed, disturbance.decimals()).ok()?;
    let found = transcribe_clip(&clip, &anatomy, &TranscribeOptions::default()).ok()?;
    let begins = clip
        .clip_frame_rate()
        .nearest_frame_at(sign_span(made)?.span_start_instant());
    Some(Again {
        found,
        clip,
        anatomy,
        short: is_short(made),
        begins: Some(begins),
        seconds: 0.0,
    })
}
