//! The body for players elsewhere moves as the body itself does.

use chereme_figure::SignerBody;
use chereme_motion::BodyAnatomy;
use chereme_motion::glam::Vec3;

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
