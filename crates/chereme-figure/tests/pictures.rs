//! Pictures of whole clips: sizes, labels, files, determinism, the mirror law, odd skeletons.

use std::ops::ControlFlow;

use chereme_figure::mesh::TriangleMesh;
use chereme_figure::raster::{FigureRaster, FigureStyle};
use chereme_figure::{
    AnimationOptions, ClipAnimation, ClipFraming, FigureError, FigurePalette, FigureView, PaperTheme, RasterImage,
    SheetFrames, SheetOptions, SignerBody, clip_thumbnail, contact_sheet, write_gif, write_png,
};
use chereme_motion::glam::{DQuat, DVec3, Vec3};
use chereme_motion::{
    BodyAnatomy, BodyPart, BodySide, Clip, FacePosture, FrameRate, LocalPose, ModelPose, Skeleton, SkeletonJoint,
};

#[path = "../examples/common/signer.rs"]
mod signer;

fn go(_: usize, _: usize) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn clip() -> (Clip, BodyAnatomy) {
    let clip = signer::handshapes().expect("the example's clip");
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    (clip, anatomy)
}

fn small() -> SheetOptions {
    SheetOptions {
        title: "ÉCOLE".into(),
        frames: SheetFrames::Spaced(3),
        cell_height: 90,
        ..SheetOptions::default()
    }
}

fn inked(image: &RasterImage, theme: PaperTheme) -> usize {
    let paper = [theme.theme_paper_colour(), theme.rule_colour()];
    image
        .image_pixels()
        .iter()
        .filter(|pixel| !paper.contains(pixel))
        .count()
}

#[test]
fn a_sheet_has_a_cell_a_view_and_frame_and_the_same_bytes_twice() {
    let (clip, anatomy) = clip();
    let mut reported = Vec::new();
    let mut progress = |done, total| {
        reported.push((done, total));
        ControlFlow::Continue(())
    };
    let first = contact_sheet(&clip, &anatomy, &small(), &mut progress).expect("a sheet");
    assert_eq!(reported, (0..6).map(|done| (done, 6)).collect::<Vec<_>>());
    let files = [
        first.clone(),
        contact_sheet(&clip, &anatomy, &small(), &mut go).expect("again"),
    ]
    .map(|sheet| {
        let mut file = Vec::new();
        write_png(&sheet, &mut file).expect("a file");
        file
    });
    assert_eq!(files[0], files[1]);
    let mut decoder = png::Decoder::new(std::io::Cursor::new(&files[0]))
        .read_info()
        .expect("png");
    let mut bytes = vec![0; decoder.output_buffer_size().expect("a size")];
    decoder.next_frame(&mut bytes).expect("pixels");
    assert_eq!(bytes, first.to_rgb());
    assert_eq!(
        decoder.info().size(),
        (first.image_width() as u32, first.image_height() as u32)
    );
    let more = SheetOptions {
        frames: SheetFrames::At(vec![0, 5, 5, 63]),
        ..small().with_hands()
    };
    let more = contact_sheet(&clip, &anatomy, &more, &mut go).expect("a sheet");
    assert!(more.image_width() > first.image_width() && more.image_height() > first.image_height());
    assert!(inked(&more, PaperTheme::Light) > inked(&first, PaperTheme::Light));
}

#[test]
fn clips_that_cannot_be_drawn_are_refused_with_a_reason() {
    let (clip, anatomy) = clip();
    let refused = |clip: &Clip, options: SheetOptions| {
        let sheet = contact_sheet(clip, &anatomy, &options, &mut go);
        sheet.expect_err("refused").to_string()
    };
    let with = |frames| SheetOptions { frames, ..small() };
    assert!(refused(&clip.slice_clip_frames(0..0), small()).contains("clip is empty"));
    assert!(refused(&clip, with(SheetFrames::At(vec![64]))).contains("no frame 64"));
    assert!(refused(&clip, with(SheetFrames::At(vec![]))).contains("at least one frame"));
    assert!(refused(&clip, with(SheetFrames::Spaced(0))).contains("at least one frame"));
    assert!(
        refused(
            &clip,
            SheetOptions {
                views: vec![],
                ..small()
            }
        )
        .contains("one view")
    );
    for cell_height in [0, 3, 100_000, usize::MAX] {
        let options = SheetOptions { cell_height, ..small() };
        assert!(refused(&clip, options).contains("cannot be made"), "{cell_height}");
        let options = AnimationOptions {
            height: cell_height,
            ..AnimationOptions::default()
        };
        assert!(ClipAnimation::new(&clip, &anatomy, options).is_err(), "{cell_height}");
    }
    let mut stop = |done, _| match done {
        4 => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let stopped = contact_sheet(&clip, &anatomy, &small(), &mut stop);
    assert!(matches!(stopped, Err(FigureError::Stopped { done: 4, total: 6 })));
}

#[test]
fn a_gif_decodes_to_its_source_pictures() {
    let (clip, anatomy) = clip();
    let clip = clip.slice_clip_frames(20..30);
    let options = AnimationOptions {
        height: 100,
        ..AnimationOptions::default()
    };
    let make = || {
        let mut animation = ClipAnimation::new(&clip, &anatomy, options.clone()).expect("animation");
        let mut file = Vec::new();
        write_gif(&mut animation, &mut file, &mut go).expect("a file");
        (file, animation)
    };
    let (file, mut animation) = make();
    assert_eq!(file, make().0);
    assert_eq!(animation.animation_frame_count(), 10);
    let [width, height] = animation.animation_size();
    let mut decoder = gif::DecodeOptions::new().read_info(file.as_slice()).expect("a gif");
    assert_eq!([decoder.width(), decoder.height()].map(usize::from), [width, height]);
    let palette = decoder.global_palette().expect("shared colours").to_vec();
    let mut canvas = vec![0u8; width * height];
    let mut count = 0;
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        assert_eq!(frame.delay, 4);
        for (i, &index) in frame.buffer.iter().enumerate() {
            let wide = usize::from(frame.width);
            let (x, y) = (usize::from(frame.left) + i % wide, usize::from(frame.top) + i / wide);
            if Some(index) != frame.transparent {
                canvas[y * width + x] = index;
            }
        }
        let wanted = animation.draw_animation_frame(count);
        let error: i64 = wanted
            .image_pixels()
            .iter()
            .zip(&canvas)
            .flat_map(|(pixel, &index)| {
                let at = usize::from(index) * 3;
                (0..3).map(move |i| (pixel.0[i], at + i))
            })
            .map(|(part, at)| (i64::from(part) - i64::from(palette[at])).abs())
            .sum();
        let mean = error as f64 / (width * height * 3) as f64;
        assert!(mean < 1.0, "picture {count} is off by {mean} on average");
        count += 1;
    }
    assert_eq!(count, animation.animation_frame_count());
    assert!(ClipAnimation::new(&clip.slice_clip_frames(0..0), &anatomy, options).is_err());
}

#[test]
fn the_mirrored_posture_gives_the_mirrored_picture() {
    let (clip, anatomy) = clip();
    let skeleton = clip.clip_skeleton();
    let counterpart = anatomy.mirror_map(skeleton);
    let palette = FigurePalette {
        left: FigurePalette::default().right,
        ..FigurePalette::default()
    };
    let body = SignerBody::with_palette(skeleton, &anatomy, &palette);
    let style = FigureStyle::default();
    let mirrored = |v: chereme_motion::glam::Vec3| v * chereme_motion::glam::Vec3::new(-1.0, 1.0, 1.0);
    let other = FigureStyle {
        key_light: mirrored(style.key_light),
        fill_light: mirrored(style.fill_light),
        ..style
    };
    let mut raster = FigureRaster::default();
    for frame in [0, 20, 40] {
        let pose = clip.clip_pose_at(frame);
        let mut turned = skeleton.rest_pose();
        for (joint, from) in counterpart.iter().enumerate() {
            let q = pose.rotations[from.unwrap_or(joint)];
            turned.rotations[joint] = DQuat::from_xyzw(q.x, -q.y, -q.z, q.w);
        }
        let poses = [
            ModelPose::from_local_pose(skeleton, &pose),
            ModelPose::from_local_pose(skeleton, &turned),
        ];
        let framing = ClipFraming::framing_from_poses(&poses, &anatomy);
        let [one, two] = [(0, &style), (1, &other)].map(|(i, style)| {
            let camera = framing.framing_camera(FigureView::Addressee, 1.0, &poses[i], &anatomy);
            raster.draw_mesh_picture(&body.posed_mesh(&poses[i]), &camera, [160, 160], style)
        });
        let two = two.mirror_image();
        let far = |a: [u8; 3], b: [u8; 3]| a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > 24);
        let pairs = one.image_pixels().iter().zip(two.image_pixels());
        let differ = pairs.filter(|(a, b)| far(a.0, b.0)).count();
        assert!(differ < 160 * 160 / 100, "{differ} pixels at frame {frame}");
    }
}

#[test]
fn every_view_shows_the_signer_and_the_figure_does_not_jump() {
    let (clip, anatomy) = clip();
    let framing = ClipFraming::framing_from_clip(&clip, &anatomy).expect("frames");
    let body = SignerBody::new(clip.clip_skeleton(), &anatomy);
    let mut raster = FigureRaster::default();
    for view in FigureView::ALL_FIGURE_VIEWS {
        let pose = clip.model_pose(3);
        let camera = framing.framing_camera(view, 1.0, &pose, &anatomy);
        let image = raster.draw_mesh_picture(&body.posed_mesh(&pose), &camera, [80, 80], &FigureStyle::default());
        let share = inked(&image, PaperTheme::Light) as f64 / 6400.0;
        assert!(
            (0.12..1.01).contains(&share),
            "{} shows {share}",
            view.figure_view_name()
        );
        if !matches!(view, FigureView::Hand(_) | FigureView::Palm(_) | FigureView::Face) {
            let later = framing.framing_camera(view, 1.0, &clip.model_pose(60), &anatomy);
            assert_eq!(camera, later);
        }
    }
}

#[test]
fn legs_are_never_drawn_however_narrow_the_picture() {
    let (clip, anatomy) = clip();
    let framing = ClipFraming::framing_from_clip(&clip, &anatomy).expect("frames");
    let knees: Vec<usize> = BodySide::BOTH_SIDES
        .into_iter()
        .flat_map(|side| [BodyPart::Shin(side), BodyPart::Foot(side)])
        .filter_map(|part| anatomy.part_joint(part))
        .collect();
    let head = anatomy.part_joint(BodyPart::Head).expect("a head");
    assert!(!knees.is_empty());
    for aspect in [0.2, 0.5, 1.0, 1.6, 3.0] {
        for view in [FigureView::Addressee, FigureView::Left, FigureView::Right] {
            let pose = clip.model_pose(30);
            let size = [(400.0 * aspect) as usize, 400];
            let camera = framing.framing_camera(view, aspect, &pose, &anatomy);
            let projection = camera.camera_projection(size[0], size[1]);
            let row = |joint: usize| projection.project_point(pose.model_joint_position(joint).as_vec3()).y;
            for &knee in &knees {
                assert!(row(knee) > 400.0, "{aspect} {}: {}", view.figure_view_name(), row(knee));
            }
            assert!((0.0..400.0).contains(&row(head)));
        }
    }
}

#[test]
fn a_hand_casts_a_shadow_on_the_chest_only_if_it_is_near() {
    let (clip, anatomy) = clip();
    let skeleton = clip.clip_skeleton();
    let body = SignerBody::new(skeleton, &anatomy);
    let dark = |pose: &ModelPose| {
        let plain = body.posed_mesh(&skeleton.rest_model_pose());
        let mesh = body.posed_mesh(pose);
        let pairs = mesh.vertices.iter().zip(&plain.vertices);
        pairs.filter(|(a, b)| a.colour.0[1] < b.colour.0[1]).count()
    };
    let frames = 0..clip.clip_frame_count();
    let shadows: Vec<usize> = frames.map(|frame| dark(&clip.model_pose(frame))).collect();
    let (least, most) = (shadows.iter().min(), shadows.iter().max());
    assert_eq!(least, Some(&0), "{shadows:?}");
    assert!(most > Some(&20), "{shadows:?}");
}

#[test]
fn a_palm_fills_its_picture_however_the_hand_is_turned() {
    let (clip, anatomy) = clip();
    let framing = ClipFraming::framing_from_clip(&clip, &anatomy).expect("frames");
    let body = SignerBody::new(clip.clip_skeleton(), &anatomy);
    let mut raster = FigureRaster::default();
    for frame in [0, clip.clip_frame_count() / 2] {
        let pose = clip.model_pose(frame);
        for side in BodySide::BOTH_SIDES {
            let camera = framing.framing_camera(FigureView::Palm(side), 1.0, &pose, &anatomy);
            let palm = anatomy.palm_normal(side, &pose).expect("a palm").as_vec3();
            let towards = (camera.eye - camera.target).normalize();
            assert!(towards.dot(palm) > 0.8, "{frame}");
            let image = raster.draw_mesh_picture(&body.posed_mesh(&pose), &camera, [96, 96], &FigureStyle::default());
            let share = inked(&image, PaperTheme::Light) as f64 / (96.0 * 96.0);
            assert!(share > 0.1, "{frame}: {share}");
        }
    }
}

#[test]
fn a_mesh_is_closed_and_follows_its_joints_rigidly() {
    let (clip, anatomy) = clip();
    let body = SignerBody::new(clip.clip_skeleton(), &anatomy);
    let pose = clip.clip_pose_at(8);
    let mesh = body.posed_mesh(&ModelPose::from_local_pose(clip.clip_skeleton(), &pose));
    let mut edges = std::collections::BTreeMap::new();
    for [a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((from, to)).or_insert(0) += 1;
        }
    }
    for (&(from, to), &count) in &edges {
        assert_eq!((count, edges.get(&(to, from))), (1, Some(&1)), "edge {from} to {to}");
    }
    let turn = DQuat::from_rotation_y(0.8);
    let mut moved = pose.clone();
    moved.rotations[0] = turn * moved.rotations[0];
    moved.translations[0] += DVec3::new(0.3, 0.1, -0.2);
    let mut other = mesh.clone();
    body.shape_body_mesh(&ModelPose::from_local_pose(clip.clip_skeleton(), &moved), &mut other);
    let hips = pose.translations[0];
    for (a, b) in mesh.vertices.iter().zip(&other.vertices) {
        let at = turn * (a.position.as_dvec3() - hips) + moved.translations[0];
        let off = at.distance(b.position.as_dvec3());
        assert!(off < 1e-5, "a vertex of part {} is {off} m off", a.group);
        assert!((b.normal.length() - 1.0).abs() < 1e-4);
    }
}

#[test]
fn a_face_value_moves_only_its_own_region_and_returns_to_rest() {
    let (clip, anatomy) = clip();
    let body = SignerBody::new(clip.clip_skeleton(), &anatomy);
    let pose = clip.model_pose(8);
    let rest = body.posed_mesh(&pose);
    let moved = |face: &FacePosture| {
        let mut mesh = rest.clone();
        body.apply_face_expression(&pose, face, &mut mesh);
        mesh
    };
    let apart = |mesh: &TriangleMesh| -> Vec<(f32, f32)> {
        let pairs = rest.vertices.iter().zip(&mesh.vertices);
        pairs
            .map(|(a, b)| (a.position.y, a.position.distance(b.position)))
            .collect()
    };
    assert!(apart(&moved(&FacePosture::default())).iter().all(|it| it.1 < 1e-6));
    let eyes = anatomy
        .landmark_place_position(clip.clip_skeleton(), &pose, "nose")
        .expect("a nose")
        .y as f32;
    let open = FacePosture {
        jaw: 1.0,
        ..FacePosture::default()
    };
    let lids = FacePosture {
        lids: [1.0, 1.0],
        ..FacePosture::default()
    };
    for (face, above) in [(open, false), (lids, true)] {
        let mesh = moved(&face);
        let moving = apart(&mesh).into_iter().filter(|it| it.1 > 1e-4);
        let moving: Vec<(f32, f32)> = moving.collect();
        assert!(!moving.is_empty());
        for (y, off) in moving {
            assert_eq!(y > eyes, above, "what lies at {y} m moved by {off} m");
            assert!(off < 0.05, "{off}");
        }
    }
    let wild = FacePosture {
        jaw: f64::NAN,
        wide: 1e30,
        ..FacePosture::default()
    };
    let finite = |mesh: &TriangleMesh| mesh.vertices.iter().all(|it| it.position.is_finite());
    assert!(finite(&moved(&wild)));
    let mut again = moved(&open);
    body.shape_body_mesh(&pose, &mut again);
    assert_eq!(again, rest, "the next posture has it at rest");
}

/// Tests a skeleton whose root lies in front of the belly, as some rigs have it.
#[test]
fn the_pelvis_is_at_the_thighs_wherever_the_root_lies() {
    let (clip, _) = clip();
    let shifted = |forward: f64| {
        let by = DVec3::Z * forward;
        let joints = clip
            .clip_skeleton()
            .skeleton_joints()
            .iter()
            .map(|joint| SkeletonJoint {
                offset: match joint.parent {
                    None => joint.offset + by,
                    Some(0) => joint.offset - by,
                    Some(_) => joint.offset,
                },
                ..joint.clone()
            });
        let skeleton = Skeleton::new(joints.collect()).expect("a tree");
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        let mesh = SignerBody::new(&skeleton, &anatomy).posed_mesh(&skeleton.rest_model_pose());
        let places: Vec<Vec3> = mesh.vertices.iter().map(|it| it.position).collect();
        places
    };
    let usual = shifted(0.0);
    for forward in [0.12, -0.12] {
        let moved = shifted(forward);
        assert_eq!(usual.len(), moved.len());
        let off = usual.iter().zip(&moved).map(|(a, b)| a.distance(*b));
        let most = off.fold(0.0, f32::max);
        assert!(most < 0.06, "root {forward} m in front: {most} m off");
    }
}

/// Tests skeletons with fewer joints than a signer with full hands.
#[test]
fn odd_skeletons_are_drawn_too() {
    let (clip, _) = clip();
    let without = |gone: fn(&str) -> bool| {
        let kept: Vec<&SkeletonJoint> = clip
            .clip_skeleton()
            .skeleton_joints()
            .iter()
            .filter(|joint| !gone(&joint.name))
            .collect();
        let joints = kept.iter().map(|&joint| {
            let parent = joint.parent.map(|p| clip.clip_skeleton().joint_at(p).name.clone());
            let parent = parent.and_then(|name| kept.iter().position(|k| k.name == name));
            SkeletonJoint {
                parent,
                ..joint.clone()
            }
        });
        Skeleton::new(joints.collect()).expect("a tree")
    };
    let finger = |name: &str| name.contains("Hand") && name.ends_with(['1', '2', '3', '4']);
    let line = |n: usize| {
        let joints = (0..n).map(|i| SkeletonJoint::new(format!("j{i}"), i.checked_sub(1), DVec3::Y));
        Skeleton::new(joints.collect()).expect("a tree")
    };
    let cases = [
        ("no fingers", without(finger)),
        (
            "no legs",
            without(|name| name.contains("Leg") || name.contains("Foot") || name.contains("Toe")),
        ),
        ("no head", without(|name| name.contains("Head"))),
        (
            "three fingers",
            without(|name| name.contains("Pinky") || name.contains("Ring1") || name.contains("Ring")),
        ),
        (
            "only thumbs",
            without(|name| ["Index", "Middle", "Ring", "Pinky"].iter().any(|f| name.contains(f))),
        ),
        ("a chain", line(9)),
        ("two joints", line(2)),
        ("one joint", line(1)),
    ];
    for (name, skeleton) in cases {
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        let rate = FrameRate::new(25, 1).expect("a rate");
        let still = Clip::from_rest_pose(skeleton.into(), rate, 3);
        let image = clip_thumbnail(&still, &anatomy, [80, 80], &FigureStyle::default()).expect(name);
        assert!(
            inked(&image, PaperTheme::Light) > 40,
            "{name}: {}",
            inked(&image, PaperTheme::Light)
        );
        let mesh: TriangleMesh = SignerBody::new(still.clip_skeleton(), &anatomy).posed_mesh(&still.model_pose(0));
        assert!(
            mesh.vertices
                .iter()
                .all(|v| v.position.is_finite() && v.normal.is_finite()),
            "{name}"
        );
    }
}

#[test]
fn joints_in_one_place_or_very_far_away_do_no_harm() {
    for offset in [DVec3::ZERO, DVec3::splat(1e-300), DVec3::splat(1e200)] {
        let names = ["Hips", "Spine", "Neck", "Head", "RightArm", "RightForeArm", "RightHand"];
        let joints = names.iter().enumerate();
        let joints = joints.map(|(i, name)| SkeletonJoint::new(*name, i.checked_sub(1), offset));
        let skeleton = Skeleton::new(joints.collect()).expect("a tree");
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        let pose: LocalPose = skeleton.rest_pose();
        let rate = FrameRate::new(25, 1).expect("a rate");
        let clip = Clip::from_poses(skeleton.into(), rate, &[pose]).expect("a clip");
        assert!(clip_thumbnail(&clip, &anatomy, [40, 40], &FigureStyle::default()).is_ok());
    }
}

#[test]
fn an_animation_at_no_speed_or_of_endless_length_is_refused() {
    let (clip, anatomy) = clip();
    for speed in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-9, 1e9] {
        let options = AnimationOptions {
            speed,
            ..AnimationOptions::default()
        };
        let refused = ClipAnimation::new(&clip, &anatomy, options).err();
        let message = refused.map(|error| error.to_string()).unwrap_or_default();
        assert!(message.contains("from 0.05 to 20"), "{speed}: {message}");
    }
    let long = clip.retime_clip(clip.clip_frame_rate(), 4_000_000 / 8, |_| {
        chereme_motion::RecordingInstant::RECORDING_START
    });
    let refused = ClipAnimation::new(&long, &anatomy, AnimationOptions::default()).err();
    assert!(matches!(refused, Some(FigureError::Long { .. })), "{refused:?}");
}

#[test]
fn odd_first_frames_are_never_drawn_and_do_not_move_the_camera() {
    let (sound, anatomy) = clip();
    let (skeleton, rate) = (sound.clip_skeleton().clone(), sound.clip_frame_rate());
    let mut channels = sound.clone().into_channels();
    let offset = skeleton.joint_at(0).offset;
    let places = channels[0]
        .translations
        .get_or_insert_with(|| vec![offset; sound.clip_frame_count()]);
    places[0].x += 5.0;
    let leaping = Clip::new(skeleton, rate, channels).expect("a clip");
    let sheet = |clip: &Clip, frames| {
        let options = SheetOptions { frames, ..small() };
        contact_sheet(clip, &anatomy, &options, &mut go).expect("a sheet")
    };
    let spaced = sheet(&leaping, SheetFrames::Spaced(2));
    let last = sound.clip_frame_count() - 1;
    assert_eq!(spaced, sheet(&leaping, SheetFrames::At(vec![1, last])));
    let framing = |clip: &Clip| ClipFraming::framing_from_clip(clip, &anatomy).expect("frames");
    let (odd, whole) = (framing(&leaping), framing(&sound));
    let pose = sound.model_pose(1);
    let [a, b] = [odd, whole].map(|it| it.framing_camera(FigureView::Addressee, 1.0, &pose, &anatomy));
    // A window that shows the odd frame sees the signer in it.
    let there = odd.framing_camera(FigureView::Addressee, 1.0, &leaping.model_pose(0), &anatomy);
    let moved = (there.target - a.target).x;
    assert!((moved - 5.0).abs() < 0.1, "{moved}");
    assert!((a.half_height - b.half_height).abs() < 0.02, "{a:?} {b:?}");
}

/// Returns the example's clip with the root displaced in each frame.
fn elsewhere(displacement: impl Fn(usize) -> DVec3) -> (Clip, BodyAnatomy) {
    let (clip, anatomy) = clip();
    let (skeleton, rate) = (clip.clip_skeleton().clone(), clip.clip_frame_rate());
    let mut channels = clip.clone().into_channels();
    let offset = skeleton.joint_at(0).offset;
    let places = channels[0]
        .translations
        .get_or_insert_with(|| vec![offset; clip.clip_frame_count()]);
    for (frame, place) in places.iter_mut().enumerate() {
        *place += displacement(frame);
    }
    (Clip::new(skeleton, rate, channels).expect("a clip"), anatomy)
}

#[test]
fn a_distant_or_walking_figure_is_framed_like_a_standing_one() {
    let (still, anatomy) = clip();
    let size = |clip: &Clip, frame: usize| {
        let pose = clip.model_pose(frame);
        let framing = ClipFraming::framing_from_clip(clip, &anatomy).expect("frames");
        let camera = framing.framing_camera(FigureView::Addressee, 1.0, &pose, &anatomy);
        let head = anatomy.part_joint(chereme_motion::BodyPart::Head).expect("a head");
        let aside = camera.target.x - pose.model_joint_position(head).as_vec3().x;
        (camera.half_height, aside.abs())
    };
    let (height, _) = size(&still, 0);
    let last = still.clip_frame_count() - 1;
    let (far, _) = elsewhere(|_| DVec3::new(4.0, 0.0, -1.0));
    let (walking, _) = elsewhere(|frame| DVec3::X * (6.0 * frame as f64 / last as f64));
    for (name, clip) in [("far", far), ("walking", walking)] {
        for frame in [0, last / 2, last] {
            let (own, aside) = size(&clip, frame);
            assert!((own / height - 1.0).abs() < 0.15, "{name} {frame}: {own} for {height}");
            assert!(aside < 0.4, "{name} {frame}: {aside} m beside the head");
        }
    }
}

/// The index of torso, shoulders and neck among the groups of a body's surface.
const TORSO: u8 = 1;

#[test]
fn a_body_without_spine_hips_or_neck_keeps_its_trunk() {
    let (clip, whole) = clip();
    let skeleton = clip.clip_skeleton();
    let pose = clip.model_pose(0);
    let trunk = |anatomy: &BodyAnatomy| {
        let mesh = SignerBody::new(skeleton, anatomy).posed_mesh(&pose);
        let of = mesh.vertices.iter().filter(|vertex| vertex.group == TORSO);
        let (mut low, mut high) = (f32::MAX, f32::MIN);
        for vertex in of {
            low = low.min(vertex.position.y);
            high = high.max(vertex.position.y);
        }
        high - low
    };
    let all = trunk(&whole);
    for missing in [
        vec![BodyPart::Hips, BodyPart::Spine],
        vec![BodyPart::Neck, BodyPart::Head],
        vec![
            BodyPart::Hips,
            BodyPart::Spine,
            BodyPart::Chest,
            BodyPart::Thigh(BodySide::Right),
            BodyPart::Thigh(BodySide::Left),
        ],
    ] {
        let roles = missing.iter().map(|&part| (part, String::new())).collect();
        let anatomy = BodyAnatomy::with_roles(skeleton, &chereme_motion::AssignedJointRoles(roles)).expect("roles");
        let height = trunk(&anatomy);
        assert!(
            (0.6..1.4).contains(&(height / all)),
            "{missing:?}: {height} m of {all} m"
        );
    }
}
