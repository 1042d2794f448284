//! The body for players elsewhere moves as the body itself does.

use std::collections::BTreeSet;

use chereme_figure::SignerBody;
use chereme_motion::glam::Vec3;
use chereme_motion::{BodyAnatomy, FacePosture};

#[path = "../examples/common/signer.rs"]
mod signer;

#[test]
fn a_portable_body_moves_as_the_body_does() {
    let clip = signer::handshapes().expect("the example's clip");
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    let body = SignerBody::new(clip.clip_skeleton(), &anatomy);
    let portable = body.to_portable_body(clip.clip_skeleton()).expect("two arms");
    assert!(portable.triangles.len() > 10_000 && portable.bones.len() < 256);
    for frame in (0..clip.clip_frame_count()).step_by(7) {
        let pose = clip.model_pose(frame);
        let mesh = body.posed_mesh(&pose);
        let keyed = body.bone_motions(&portable, &pose);
        // Every vertex of the portable body is one of the body's, at the same place.
        let mut known: Vec<Vec3> = mesh.vertices.iter().map(|it| it.position).collect();
        known.sort_by(|a, b| a.x.total_cmp(&b.x));
        for at in portable.posed_vertices(&keyed) {
            let from = known.partition_point(|it| it.x < at.x - 2e-4);
            let near = known[from..].iter().take_while(|it| it.x <= at.x + 2e-4);
            let nearest = near.map(|it| it.distance(at)).fold(f32::INFINITY, f32::min);
            assert!(nearest < 2e-4, "frame {frame}: {nearest} m");
        }
    }
}

#[test]
fn the_changes_of_a_portable_face_add_up_to_expressions() {
    let clip = signer::handshapes().expect("the example's clip");
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    let body = SignerBody::new(clip.clip_skeleton(), &anatomy);
    let portable = body.to_portable_body(clip.clip_skeleton()).expect("two arms");
    let morphs = body.face_morphs(&portable);
    let numbers: BTreeSet<usize> = morphs.iter().map(|morph| morph.number).collect();
    assert_eq!(numbers.len(), FacePosture::FACE_NUMBER_COUNT, "{numbers:?}");
    let pose = clip.model_pose(0);
    let keyed = body.bone_motions(&portable, &pose);
    let rest = body.posed_mesh(&pose);
    let moving: BTreeSet<usize> = morphs.iter().flat_map(|morph| morph.vertices.iter().copied()).collect();
    let at_rest = portable.posed_vertices(&keyed);
    // The vertex of the body's own mesh for each one of the portable face.
    let own = |vertex: usize| {
        let distance = |index: &usize| rest.vertices[*index].position.distance(at_rest[vertex]);
        (0..rest.vertices.len())
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .expect("a mesh")
    };
    // Lips lie upon each other at rest, so that the nearest vertex may be another one; but both faces have one order.
    let mut lags: Vec<usize> = moving.iter().map(|vertex| own(*vertex).wrapping_sub(*vertex)).collect();
    lags.sort_unstable();
    let lag = lags[lags.len() / 2];
    let own: Vec<(usize, usize)> = moving
        .iter()
        .map(|vertex| (*vertex, vertex.wrapping_add(lag)))
        .collect();
    let distances = |face: &FacePosture| {
        let mut shaped = portable.clone();
        for morph in &morphs {
            let share = morph.morph_share(face) as f32;
            for (vertex, offset) in morph.vertices.iter().zip(&morph.offsets) {
                shaped.vertices[*vertex].place += *offset * share;
            }
        }
        let mut mesh = body.posed_mesh(&pose);
        body.apply_face_expression(&pose, face, &mut mesh);
        let shaped = shaped.posed_vertices(&keyed);
        let distance = |(vertex, own): &(usize, usize)| shaped[*vertex].distance(mesh.vertices[*own].position);
        let mut all: Vec<f32> = own.iter().map(distance).collect();
        all.sort_by(f32::total_cmp);
        all
    };
    for morph in &morphs {
        let mut numbers = [0.0; FacePosture::FACE_NUMBER_COUNT];
        if FacePosture::FACE_NUMBER_NAMES[morph.number] == "tongue_left" {
            numbers[FacePosture::face_number_position("tongue_out").expect("a number")] = 1.0;
        }
        numbers[morph.number] = if morph.is_negative { -1.0 } else { 1.0 };
        let all = distances(&FacePosture::from_numbers(numbers));
        let most = all[all.len() - 1];
        assert!(
            most < 3e-4,
            "{}: {most} m",
            FacePosture::FACE_NUMBER_NAMES[morph.number]
        );
    }
    let question = FacePosture {
        brows: [0.8, 0.8],
        lids: [-0.4, -0.4],
        jaw: 0.3,
        parted: 0.4,
        wide: -0.5,
        ..FacePosture::default()
    };
    let all = distances(&question);
    let (middle, most) = (all[all.len() / 2], all[all.len() - 1]);
    println!("middle {middle} m, most {most} m");
    assert!(middle < 1e-3 && most < 6e-3, "{middle} m, {most} m");
}

#[test]
fn a_skinned_figure_moves_as_the_body_does() {
    let clip = signer::handshapes().expect("the example's clip");
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    let body = SignerBody::new(clip.clip_skeleton(), &anatomy);
    let figure = body
        .to_skinned_figure(clip.clip_skeleton(), &anatomy)
        .expect("two arms");
    assert_eq!(
        figure.vertices.len(),
        body.posed_mesh(&clip.model_pose(0)).vertices.len()
    );
    for frame in (0..clip.clip_frame_count()).step_by(7) {
        let pose = clip.model_pose(frame);
        let mesh = body.posed_mesh(&pose);
        let placed = body.bone_placements(&figure, &pose);
        let mut most: f32 = 0.0;
        let mut sum: f32 = 0.0;
        for (vertex, known) in mesh.vertices.iter().enumerate() {
            let shares = figure.bones_of_vertices[vertex].iter().zip(figure.weights[vertex]);
            let moved = shares.map(|(bone, weight)| {
                let (bone, placement) = (&figure.bones[usize::from(*bone)], &placed[usize::from(*bone)]);
                (placement.turn * (figure.vertices[vertex].position - bone.bind) + placement.place) * weight
            });
            let off = moved.sum::<Vec3>().distance(known.position);
            most = most.max(off);
            sum += off;
        }
        // Only the thickness of bent knuckles and elbows differs, which no bone can have.
        let mean = sum / mesh.vertices.len() as f32;
        assert!(most < 0.02 && mean < 5e-4, "frame {frame}: {most} m, mean {mean} m");
    }
    let names: BTreeSet<String> = figure.morphs.iter().map(|morph| morph.morph_name()).collect();
    assert_eq!(names.len(), figure.morphs.len());
}
