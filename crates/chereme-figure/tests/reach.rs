//! One camera for several clips.

use chereme_figure::{AnimationOptions, ClipAnimation, FigureView, RasterImage, SigningReach};
use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, Clip};

#[path = "../examples/common/signer.rs"]
mod signer;

#[test]
fn clips_with_one_reach_are_drawn_equally_large_at_the_same_place() {
    let clip = signer::handshapes().expect("the example's clip");
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    let short = clip.slice_clip_frames(0..20);
    let (skeleton, rate) = (clip.clip_skeleton().clone(), clip.clip_frame_rate());
    let offset = skeleton.joint_at(0).offset;
    let mut channels = clip.clone().into_channels();
    let places = channels[0]
        .translations
        .get_or_insert_with(|| vec![offset; clip.clip_frame_count()]);
    places.iter_mut().for_each(|place| *place += DVec3::new(2.0, 0.5, -3.0));
    let elsewhere = Clip::new(skeleton, rate, channels).expect("a clip");
    let all = [&clip, &short, &elsewhere];
    let reach = all
        .iter()
        .map(|clip| SigningReach::reach_from_clip(clip, &anatomy).expect("frames"))
        .reduce(SigningReach::join_signing_reach)
        .expect("clips");
    let drawn = all.map(|clip| {
        let options = AnimationOptions {
            views: vec![FigureView::Addressee],
            height: 120,
            framing: reach.framing_for_clip(clip, &anatomy),
            bar: false,
            ..AnimationOptions::default()
        };
        ClipAnimation::new(clip, &anatomy, options)
            .expect("an animation")
            .draw_animation_frame(0)
    });
    let size = |image: &RasterImage| (image.image_width(), image.image_height());
    assert_eq!(size(&drawn[0]), size(&drawn[1]));
    let differing = |other: &RasterImage| {
        let pairs = drawn[0].image_pixels().iter().zip(other.image_pixels());
        pairs.filter(|(a, b)| a != b).count() as f64 / drawn[0].image_pixels().len() as f64
    };
    // The hips sway within the clip, so that a part of it may lie a pixel beside the whole.
    assert!(differing(&drawn[2]) < 0.01, "{}", differing(&drawn[2]));
    assert!(differing(&drawn[1]) < 0.10, "{}", differing(&drawn[1]));
}
