//! The visible body of a GLB: the person that pictures draw, moved by the joints of a clip.

use chereme_compose::{GeneratedCurve, faces_from_curves};
use chereme_figure::SignerBody;
use chereme_formats::gltf::{GlbFigure, GlbFigureBone, GlbFigureMorph, GlbVertex};
use chereme_motion::{BodyAnatomy, Clip, FacePosture};

/// Returns the person that pictures draw; `None` without a trunk and two arms, or without frames.
pub(super) fn visible_figure(clip: &Clip, anatomy: &BodyAnatomy, curves: &[GeneratedCurve]) -> Option<GlbFigure> {
    let body = SignerBody::new(clip.clip_skeleton(), anatomy);
    let figure = body.to_skinned_figure(clip.clip_skeleton(), anatomy)?;
    let frames = clip.clip_frame_count();
    let mut bones: Vec<GlbFigureBone> = figure
        .bones
        .iter()
        .map(|bone| GlbFigureBone {
            joint: bone.joint,
            bind: bone.bind.to_array(),
            ..GlbFigureBone::default()
        })
        .collect();
    for frame in 0..frames {
        let placements = body.bone_placements(&figure, &clip.model_pose(frame));
        for (bone, placement) in bones.iter_mut().zip(placements) {
            bone.turns.push(placement.turn.as_dquat());
            bone.places.push(placement.place.as_dvec3());
        }
    }
    let (faces, at_rest) = (faces_from_curves(curves), FacePosture::default());
    let face_at = |frame: usize| faces.get(frame).unwrap_or(&at_rest);
    let morphs = figure.morphs.iter().map(|morph| GlbFigureMorph {
        name: morph.morph_name(),
        vertices: morph.vertices.iter().map(|vertex| *vertex as u32).collect(),
        offsets: morph.offsets.iter().map(|offset| offset.to_array()).collect(),
        shares: (0..frames)
            .map(|frame| morph.morph_share(face_at(frame)) as f32)
            .collect(),
    });
    let shown = |morph: &GlbFigureMorph| morph.shares.iter().any(|share| *share > 0.0);
    let bound = figure.bones_of_vertices.iter().zip(&figure.weights);
    let vertices = figure
        .vertices
        .iter()
        .zip(bound)
        .map(|(vertex, (bones, weights))| GlbVertex {
            place: vertex.position.to_array(),
            normal: vertex.normal.to_array(),
            colour: vertex.colour.0,
            bones: *bones,
            weights: *weights,
        });
    (frames > 0).then(|| GlbFigure {
        vertices: vertices.collect(),
        triangles: figure.triangles.clone(),
        bones,
        morphs: morphs.filter(shown).collect(),
    })
}
