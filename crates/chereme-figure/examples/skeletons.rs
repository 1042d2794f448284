//! Draws one signer on skeletons of many kinds: `cargo run --release --example skeletons -- FILE.png`.
//!
//! Each row is a skeleton: whole, without fingers, with three joints a finger, with arms along the body or a bowed body at
//! rest, a child, and with raised elbows.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::ops::ControlFlow;

use chereme_figure::{FigureView, RasterImage, SheetFrames, SheetOptions, contact_sheet, write_png};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyAnatomy, BodySide, Clip, LocalPose, Skeleton, SkeletonJoint};

#[path = "common/signer.rs"]
mod signer;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("name a file for the picture")?;
    let whole = signer::handshapes()?;
    let kinds: [(&str, Clip); 7] = [
        ("whole", whole.clone()),
        ("no fingers", kept(&whole, |name| !is_finger(name))?),
        (
            "three joints a finger",
            kept(&whole, |name| !(is_finger(name) && name.ends_with('4')))?,
        ),
        ("arms down at rest", rested(&whole, |name| arm(name, 1.4))?),
        ("bowed at rest", rested(&whole, |name| bow(name, 0.35))?),
        ("a child", sized(&whole, child)?),
        ("elbows raised", raised(&whole)?),
    ];
    let mut sheets = Vec::new();
    for (title, clip) in kinds {
        let options = SheetOptions {
            title: title.to_owned(),
            frames: SheetFrames::At(vec![2, 12, 26, 44, 60]),
            views: vec![FigureView::Addressee],
            ..SheetOptions::default()
        };
        let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
        let mut go = |_, _| ControlFlow::Continue(());
        sheets.push(contact_sheet(&clip, &anatomy, &options, &mut go)?);
    }
    let wide = sheets.iter().map(RasterImage::image_width).max().unwrap_or(1);
    let high = sheets.iter().map(RasterImage::image_height).sum();
    let background = SheetOptions::default().style.theme.theme_paper_colour();
    let mut all = RasterImage::new(wide, high, background);
    let mut top = 0;
    for sheet in &sheets {
        all.paste_image(sheet, [0, top]);
        top += sheet.image_height();
    }
    write_png(&all, BufWriter::new(File::create(path)?))?;
    Ok(())
}

fn is_finger(name: &str) -> bool {
    ["Thumb", "Index", "Middle", "Ring", "Pinky"]
        .iter()
        .any(|finger| name.contains(finger))
}

/// Returns the clip without the joints for which `stays` is false; none of them may have a child that stays.
fn kept(clip: &Clip, stays: impl Fn(&str) -> bool) -> Result<Clip, Box<dyn Error>> {
    let skeleton = clip.clip_skeleton();
    let all: Vec<usize> = (0..skeleton.len())
        .filter(|&joint| stays(&skeleton.joint_at(joint).name))
        .collect();
    let place = |joint: usize| all.iter().position(|&it| it == joint);
    let joints = all.iter().map(|&joint| SkeletonJoint {
        parent: skeleton.joint_at(joint).parent.and_then(place),
        ..skeleton.joint_at(joint).clone()
    });
    let fewer = Skeleton::new(joints.collect())?;
    of(fewer, clip, |pose| LocalPose {
        rotations: all.iter().map(|&joint| pose.rotations[joint]).collect(),
        translations: all.iter().map(|&joint| pose.translations[joint]).collect(),
    })
}

/// Returns the same movement on a skeleton whose joints are turned at rest.
fn rested(clip: &Clip, turn: impl Fn(&str) -> DQuat) -> Result<Clip, Box<dyn Error>> {
    let skeleton = clip.clip_skeleton();
    let joints: Vec<SkeletonJoint> = (0..skeleton.len())
        .map(|joint| {
            let joint = skeleton.joint_at(joint);
            SkeletonJoint {
                rest: turn(&joint.name),
                ..joint.clone()
            }
        })
        .collect();
    of(Skeleton::new(joints)?, clip, Clone::clone)
}

fn arm(name: &str, angle: f64) -> DQuat {
    match name {
        "LeftArm" => DQuat::from_rotation_z(-angle),
        "RightArm" => DQuat::from_rotation_z(angle),
        _ => DQuat::IDENTITY,
    }
}

fn bow(name: &str, angle: f64) -> DQuat {
    match name {
        "Spine" | "Neck" => DQuat::from_rotation_x(angle),
        _ => DQuat::IDENTITY,
    }
}

/// Returns the same movement on a skeleton whose bones are longer or shorter.
fn sized(clip: &Clip, size: impl Fn(&str) -> f64) -> Result<Clip, Box<dyn Error>> {
    let skeleton = clip.clip_skeleton();
    let joints: Vec<SkeletonJoint> = (0..skeleton.len())
        .map(|joint| {
            let joint = skeleton.joint_at(joint);
            SkeletonJoint {
                offset: joint.offset * size(&joint.name),
                ..joint.clone()
            }
        })
        .collect();
    let sizes: Vec<f64> = joints.iter().map(|joint| size(&joint.name)).collect();
    of(Skeleton::new(joints)?, clip, |pose| {
        let mut own = pose.clone();
        for (at, size) in own.translations.iter_mut().zip(&sizes) {
            *at *= *size;
        }
        own
    })
}

/// The size of a six-year-old's bones relative to an adult's.
fn child(name: &str) -> f64 {
    match name {
        _ if is_finger(name) => 0.62,
        "HeadTop_End" => 0.86,
        _ if name.ends_with("Leg") || name.ends_with("Foot") || name == "Hips" => 0.6,
        _ => 0.64,
    }
}

fn raised(clip: &Clip) -> Result<Clip, Box<dyn Error>> {
    let skeleton = clip.clip_skeleton();
    of((**skeleton).clone(), clip, |pose| {
        let mut own = pose.clone();
        for side in BodySide::BOTH_SIDES {
            let name = if side == BodySide::Right { "Right" } else { "Left" };
            let out = DVec3::X * side.side_sign();
            let direction = |to: [f64; 3]| {
                let [aside, up, front] = to;
                DVec3::new(aside * side.side_sign(), up, front).normalize()
            };
            let upper = DQuat::from_rotation_arc(out, direction([0.75, 0.5, 0.35]));
            let lower = DQuat::from_rotation_arc(out, direction([-0.75, 0.35, 0.45]));
            let mut set = |part: &str, turn: DQuat| {
                if let Some(joint) = skeleton.find_joint(&format!("{name}{part}")) {
                    own.rotations[joint] = turn;
                }
            };
            set("Arm", upper);
            set("ForeArm", upper.inverse() * lower);
            set("Hand", DQuat::IDENTITY);
        }
        own
    })
}

fn of(skeleton: Skeleton, clip: &Clip, change: impl Fn(&LocalPose) -> LocalPose) -> Result<Clip, Box<dyn Error>> {
    let poses: Vec<LocalPose> = (0..clip.clip_frame_count())
        .map(|frame| change(&clip.clip_pose_at(frame)))
        .collect();
    Ok(Clip::from_poses(skeleton.into(), clip.clip_frame_rate(), &poses)?)
}
