//! Golden tables of bodies: their parts, measures, landmarks, hands, units and axes.

use glam::{DQuat, DVec3};

use super::{dressed, list, milli, signing, turned};
use crate::anatomy::tests::fixtures::conventions::{conventional_joint_name, naming_conventions};
use crate::anatomy::tests::fixtures::{
    BodyVariation, PLAIN_BODY_VARIATION, any_turn, body_variations, fixture_body, rename_joints,
};
use crate::golden::{compare, put};
use crate::{
    AxisDirection, BodyAnatomy, BodyPart, BodySide, FingerAngles, HandAngles, ModelPose, PartEvidence, SignerAxes,
    Skeleton, SkeletonJoint, SpaceAxis, SpaceConvention, ThumbAngles,
};

/// Returns the joints of all parts that were found, with a letter for the evidence of each.
fn parts(anatomy: &BodyAnatomy) -> String {
    let letter = |evidence| match evidence {
        PartEvidence::Roles => 'r',
        PartEvidence::Name => 'n',
        PartEvidence::Topology => 't',
    };
    let found = anatomy
        .found_parts()
        .map(|(part, joint, how)| format!("{part} {joint}{}", letter(how)));
    found.collect::<Vec<_>>().join(", ")
}

fn described(out: &mut String, skeleton: &Skeleton, anatomy: &BodyAnatomy) {
    put(out, format!("parts: {}", parts(anatomy)));
    put(
        out,
        format!(
            "missing {:?} ambiguous {:?} markers {:?}",
            anatomy.missing_parts(),
            anatomy.ambiguous_parts(),
            anatomy.marker_joints()
        ),
    );
    put(out, format!("mirror {:?}", anatomy.mirror_map(skeleton)));
}

#[test]
fn golden_parts_of_skeletons_under_many_names() {
    let mut out = String::new();
    let plain = fixture_body(PLAIN_BODY_VARIATION);
    for (name, sides, names) in naming_conventions() {
        put(&mut out, format!("## {name}"));
        let named = rename_joints(&plain, |_, part| {
            let part: BodyPart = part.parse().expect("a part");
            conventional_joint_name(part, sides, &names)
        });
        described(&mut out, &named, &BodyAnatomy::detect_anatomy(&named));
    }
    let nameless = |wear: BodyVariation| rename_joints(&fixture_body(wear), |n, _| format!("J{n}"));
    for (name, wear) in body_variations() {
        put(&mut out, format!("## {name}, without names"));
        let skeleton = nameless(wear);
        described(&mut out, &skeleton, &BodyAnatomy::detect_anatomy(&skeleton));
    }
    put(&mut out, "## sides that no name shows");
    let sideless = rename_joints(&plain, |_, part| part.replace("right ", "").replace("left ", ""));
    described(&mut out, &sideless, &BodyAnatomy::detect_anatomy(&sideless));
    put(&mut out, "## names that say two things");
    let twice = rename_joints(&plain, |n, part| match n {
        3 => "Head".to_owned(),
        12 | 13 => "RightHand".to_owned(),
        _ => part.to_owned(),
    });
    described(&mut out, &twice, &BodyAnatomy::detect_anatomy(&twice));
    put(&mut out, "## parts");
    for part in BodyPart::all_body_parts() {
        put(
            &mut out,
            format!(
                "{part}: {:?} {} usual {}",
                part.part_side().map(BodySide::body_side_name),
                part.mirrored_part(),
                part.is_usual()
            ),
        );
    }
    compare("parts", &out);
}

/// Returns postures of hands: a fist, a claw, a spread hand and one with every angle different.
fn hands() -> Vec<HandAngles> {
    let finger = |n: usize, bend: f64, spread: f64| FingerAngles {
        spread: spread * (1.5 - n as f64),
        flexion: [bend, 1.1 * bend + 0.02, 0.6 * bend],
    };
    let hand = |thumb: [f64; 5], bend: f64, more: f64, spread: f64| HandAngles {
        thumb: ThumbAngles {
            radial: thumb[0],
            palmar: thumb[1],
            opposition: thumb[2],
            flexion: [thumb[3], thumb[4]],
        },
        fingers: [0, 1, 2, 3].map(|n| finger(n, bend + more * n as f64, spread)),
    };
    vec![
        HandAngles::default(),
        hand([0.3, 0.5, 0.6, 0.5, 0.7], 1.4, 0.0, 0.0),
        hand([0.8, 0.2, 0.1, 0.1, 0.2], 0.6, 0.05, 0.12),
        hand([1.0, 0.1, 0.0, -0.1, 0.0], -0.05, 0.0, 0.2),
        hand([0.4, 0.9, 1.1, 0.3, 0.4], 0.2, 0.35, 0.1),
    ]
}

fn handled(out: &mut String, skeleton: &Skeleton, anatomy: &BodyAnatomy) {
    for side in BodySide::BOTH_SIDES {
        let Some(hand) = anatomy.part_joint(BodyPart::Hand(side)) else {
            continue;
        };
        for (n, angles) in hands().iter().enumerate() {
            let mut pose = signing(skeleton, anatomy, 0.7 + n as f64);
            let set = anatomy.set_hand_angles(skeleton, side, angles, &mut pose);
            put(out, format!("{} hand {n}: set {set}", side.body_side_name()));
            let read = anatomy.hand_angles(skeleton, side, &pose);
            let degrees = read.map(|it| list(it.map_hand_angles(f64::to_degrees).to_array()));
            put(out, format!("  read {degrees:?}"));
            let model = ModelPose::from_local_pose(skeleton, &pose);
            let back = model.model_joint_rotation(hand).inverse();
            let tips = ["thumb", "index", "middle", "ring", "little"].map(|digit| {
                let name = format!("{}-{digit}-tip", side.body_side_name());
                let at = anatomy.landmark_place_position(skeleton, &model, &name);
                at.map_or("none".to_owned(), |at| {
                    milli(back * (at - model.model_joint_position(hand)))
                })
            });
            put(out, format!("  tips {}", tips.join(", ")));
        }
    }
}

fn directed(out: &mut String, skeleton: &Skeleton, anatomy: &BodyAnatomy, model: &ModelPose) {
    for side in BodySide::BOTH_SIDES {
        let along = anatomy.hand_direction(side, model);
        let palm = anatomy.palm_normal(side, model);
        put(
            out,
            format!(
                "{}: along {:?} palm {:?} elbow {:?} fingers {:?} {} arm {:?} {:?}",
                side.body_side_name(),
                along.map(milli),
                palm.map(milli),
                anatomy.elbow_direction(side).map(milli),
                anatomy.finger_joints(side),
                anatomy.has_fingers(side),
                anatomy.arm_chain(side),
                anatomy.arm_joints(side)
            ),
        );
        let asked = anatomy.hand_rotation(side, DVec3::new(0.3, 0.8, 0.5), DVec3::X);
        put(out, format!("  asked {:?}", asked.map(turned)));
    }
    put(
        out,
        format!("head {:?}", anatomy.head_axes(model).map(|it| it.map(milli))),
    );
    if let Some(frame) = anatomy.body_frame(model) {
        let at = DVec3::new(0.2, 1.3, 0.4);
        put(
            out,
            format!(
                "trunk at {} left {} up {} forward {} scale {:?}; {} {} {} {} {}",
                milli(frame.origin),
                milli(frame.left),
                milli(frame.up),
                milli(frame.forward),
                frame.scale,
                milli(frame.to_body(at)),
                milli(frame.to_model(at)),
                milli(frame.direction_to_body(at)),
                milli(frame.direction_to_model(at)),
                turned(frame.body_frame_rotation())
            ),
        );
    }
    let tips = (0..skeleton.len()).filter_map(|joint| model.bone_tip_position(skeleton, joint));
    put(out, format!("tips {}", milli(tips.sum::<DVec3>())));
}

#[test]
fn golden_measures_and_hands_of_bodies() {
    let mut out = String::new();
    for (name, wear) in body_variations() {
        let (skeleton, anatomy) = dressed(wear);
        put(&mut out, format!("## {name}"));
        put(
            &mut out,
            format!("{:?} posed {}", anatomy.anatomy_measures(), anatomy.is_posed()),
        );
        directed(&mut out, &skeleton, &anatomy, &skeleton.rest_model_pose());
        let pose = signing(&skeleton, &anatomy, 0.7);
        directed(
            &mut out,
            &skeleton,
            &anatomy,
            &ModelPose::from_local_pose(&skeleton, &pose),
        );
        handled(&mut out, &skeleton, &anatomy);
    }
    compare("measures_hands", &out);
}

#[test]
fn golden_places_on_bodies() {
    let mut out = String::new();
    let eyes = {
        let mut joints = fixture_body(PLAIN_BODY_VARIATION).skeleton_joints().to_vec();
        let head = joints.iter().position(|it| it.name == "head");
        for side in BodySide::BOTH_SIDES {
            let at = DVec3::new(side.side_sign() * 0.03, 0.07, 0.08);
            let name = BodyPart::Eye(side).to_string();
            joints.push(SkeletonJoint::new(name, head, at));
        }
        Skeleton::new(joints).expect("a tree")
    };
    let legless = {
        let keep = |name: &str| !["thigh", "shin", "foot", "toes"].iter().any(|it| name.contains(it));
        let joints = fixture_body(PLAIN_BODY_VARIATION).skeleton_joints().to_vec();
        let kept: Vec<usize> = (0..joints.len()).filter(|&n| keep(&joints[n].name)).collect();
        let moved = kept.iter().map(|&n| SkeletonJoint {
            parent: joints[n]
                .parent
                .and_then(|parent| kept.iter().position(|&it| it == parent)),
            ..joints[n].clone()
        });
        Skeleton::new(moved.collect()).expect("a tree")
    };
    let odd = fixture_body(BodyVariation {
        frames: any_turn,
        tips: false,
        bent: 0.2,
        lowered: 0.5,
        ..PLAIN_BODY_VARIATION
    });
    let bodies = [
        ("plain", fixture_body(PLAIN_BODY_VARIATION)),
        ("with eyes", eyes),
        ("without legs", legless),
        ("odd frames", odd),
    ];
    for (name, skeleton) in &bodies {
        put(&mut out, format!("## {name}"));
        let roles = crate::anatomy::tests::fixtures::fixture_joint_roles(skeleton);
        let anatomy = BodyAnatomy::with_roles(skeleton, &roles).expect("a body");
        put(&mut out, format!("{:?}", anatomy.anatomy_measures()));
        let model = ModelPose::from_local_pose(skeleton, &signing(skeleton, &anatomy, 0.7));
        for place in BodyAnatomy::landmark_names() {
            let at = anatomy.landmark_place_position(skeleton, &model, &place).map(milli);
            put(&mut out, format!("{place} {}", at.as_deref().unwrap_or("none")));
        }
    }
    let (skeleton, anatomy) = dressed(PLAIN_BODY_VARIATION);
    let model = skeleton.rest_model_pose();
    put(&mut out, "## other names");
    for name in [
        "Ear left",
        "left_lips",
        "top-of-head",
        "ear",
        "moon",
        "right hips",
        "Trunk",
    ] {
        let at = anatomy.landmark_place_position(&skeleton, &model, name).map(milli);
        put(&mut out, format!("{name}: {at:?}"));
    }
    compare("places", &out);
}

/// Returns a usual body, one whose toes point backwards, one in a row, and one without limbs.
fn odd_bodies() -> Vec<(&'static str, Skeleton)> {
    let usual = fixture_body(PLAIN_BODY_VARIATION);
    let change = |change: &dyn Fn(&mut SkeletonJoint)| {
        let mut joints = usual.skeleton_joints().to_vec();
        joints.iter_mut().for_each(change);
        Skeleton::new(joints).expect("a tree")
    };
    let backwards = change(&|joint| {
        if joint.name.ends_with("toes") {
            joint.offset.z = -joint.offset.z;
        }
    });
    let row = change(&|joint| joint.offset = DVec3::Y * joint.offset.length());
    let limbless = |size: f64| {
        let trunk = usual.skeleton_joints()[..5].iter();
        let trunk = trunk.map(|joint| SkeletonJoint {
            offset: joint.offset * size,
            ..joint.clone()
        });
        Skeleton::new(trunk.collect()).expect("a tree")
    };
    let (short, long) = (limbless(1.0), limbless(50.0));
    vec![
        ("usual", usual),
        ("backwards", backwards),
        ("in a row", row),
        ("without limbs", short),
        ("without limbs, large", long),
    ]
}

#[test]
fn golden_counterparts_of_joints() {
    let mut out = String::new();
    let mut joints = fixture_body(PLAIN_BODY_VARIATION).skeleton_joints().to_vec();
    let at = |name: &str| fixture_body(PLAIN_BODY_VARIATION).find_joint(name).expect("a joint");
    for (name, on) in [
        ("skirt.L", "hips"),
        ("skirt.R", "hips"),
        ("LSleeve", "left forearm"),
        ("RSleeve", "right forearm"),
        ("r_pocket", "hips"),
        ("l_pocket", "hips"),
        ("Left cuff", "left hand"),
        ("cuff two", "left hand"),
        ("Right cuff", "right hand"),
        ("cuff three", "right hand"),
        ("HAIR LEFT", "head"),
        ("HAIR RIGHT", "head"),
        ("lace", "head"),
        ("race", "head"),
        ("tail", "hips"),
        ("bag.l.2", "left clavicle"),
        ("strap", "right clavicle"),
        ("2L", "neck"),
        ("2R", "neck"),
    ] {
        joints.push(SkeletonJoint::new(name, Some(at(on)), DVec3::new(0.01, 0.02, 0.03)));
        let last = joints.len() - 1;
        joints.push(SkeletonJoint::new(format!("{name} end"), Some(last), DVec3::Y * 0.02));
    }
    let skeleton = Skeleton::new(joints).expect("a tree");
    let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
    for (joint, other) in anatomy.mirror_map(&skeleton).into_iter().enumerate() {
        let name = other.map(|other| &skeleton.joint_at(other).name);
        put(&mut out, format!("{}: {name:?}", skeleton.joint_at(joint).name));
    }
    compare("counterparts", &out);
}

#[test]
fn golden_units_and_axes_of_skeletons() {
    let mut out = String::new();
    let quarter = std::f64::consts::FRAC_PI_2;
    let sizes = [
        ("m", 1.0),
        ("cm", 100.0),
        ("mm", 1000.0),
        ("inch", 39.37),
        ("acclaim", 0.45 * 39.37),
        ("unknown", 7.0),
    ];
    let axes = [
        ("usual", DQuat::IDENTITY),
        ("z up", DQuat::from_rotation_x(quarter)),
        ("facing x", DQuat::from_rotation_y(quarter)),
        ("upside down", DQuat::from_rotation_z(2.0 * quarter)),
        ("leaning", DQuat::from_rotation_x(0.3)),
    ];
    for (unit, size) in sizes {
        for (turn, axes) in axes {
            let skeleton = fixture_body(BodyVariation {
                unit: size,
                axes,
                lowered: 0.4,
                ..PLAIN_BODY_VARIATION
            });
            put(&mut out, format!("## {unit}, {turn}"));
            put(
                &mut out,
                format!(
                    "{:?}",
                    BodyAnatomy::detect_anatomy(&skeleton).guess_convention(&skeleton, None)
                ),
            );
            let mut first = skeleton.rest_pose();
            first.rotations[0] = DQuat::from_rotation_y(quarter);
            let first = ModelPose::from_local_pose(&skeleton, &first);
            put(
                &mut out,
                format!(
                    "turned {:?}",
                    BodyAnatomy::detect_anatomy(&skeleton).guess_convention(&skeleton, Some(&first))
                ),
            );
        }
    }
    put(&mut out, "## first frames that stand or face in another direction");
    for (name, skeleton) in odd_bodies() {
        let found = BodyAnatomy::detect_anatomy(&skeleton).guess_convention(&skeleton, None);
        put(&mut out, format!("{name}: {found:?}"));
        for degrees in [20.0_f64, 50.0, 65.0, 100.0, 170.0] {
            for axis in [SpaceAxis::X, SpaceAxis::Y, SpaceAxis::Z] {
                let mut first = skeleton.rest_pose();
                first.rotations[0] = axis.axis_rotation(degrees.to_radians());
                let first = ModelPose::from_local_pose(&skeleton, &first);
                let found = BodyAnatomy::detect_anatomy(&skeleton).guess_convention(&skeleton, Some(&first));
                put(&mut out, format!("  {degrees} about {axis:?}: {found:?}"));
            }
        }
    }
    put(&mut out, "## axes");
    let directions = ["+X", "-x", "Y", "-Y", "+z", "-Z", "W", ""];
    for up in directions {
        for left in directions {
            let found: Option<(AxisDirection, AxisDirection)> = up.parse().ok().zip(left.parse().ok());
            let Some((up, left)) = found else { continue };
            let Some(axes) = SignerAxes::new(up, left) else {
                continue;
            };
            let convention = SpaceConvention {
                metres_per_unit: 0.01,
                axes,
            };
            put(
                &mut out,
                format!(
                    "{up} {left}: forward {} {} {}",
                    axes.forward_direction(),
                    turned(axes.to_model()),
                    milli(convention.file_point_to_model(DVec3::new(10.0, 20.0, 35.0)))
                ),
            );
        }
    }
    for at in [DVec3::new(1.0, -1.0, 0.5), DVec3::new(0.1, -1.0, 1.0), DVec3::NEG_Z] {
        put(
            &mut out,
            format!("nearest {}", AxisDirection::nearest_axis_direction(at)),
        );
    }
    compare("units_axes", &out);
}
