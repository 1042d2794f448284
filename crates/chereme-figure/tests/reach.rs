//! One camera for several clips.

use chereme_figure::{Animation, AnimationOptions, Image, Reach, View};
use chereme_motion::glam::DVec3;
use chereme_motion::{Anatomy, Clip};

#[path = "../examples/common/signer.rs"]
mod signer;

#[test]
fn clips_with_one_reach_are_drawn_equally_large_at_the_same_place() {
    let clip = signer::handshapes().expect("the example's clip");
    let anatomy = Anatomy::detect(clip.skeleton());
    let short = clip.slice(0..20);
    let (skeleton, rate) = (clip.skeleton().clone(), clip.rate());
    let offset = skeleton.joint(0).offset;
    let mut channels = clip.clone().into_channels();
    let places = channels[0]
        .translations
        .get_or_insert_with(|| vec![offset; clip.frames()]);
    places
        .iter_mut()
        .for_each(|place| *place += DVec3::new(2.0, 0.5, -3.0));
    let elsewhere = Clip::new(skeleton, rate, channels).expect("a clip");
    let all = [&clip, &short, &elsewhere];
    let reach = all
        .iter()
        .map(|clip| Reach::of(clip, &anatomy).expect("frames"))
        .reduce(Reach::joined)
        .expect("clips");
    let drawn = all.map(|clip| {
        let options = AnimationOptions {
            views: vec![View::Addressee],
            height: 120,
            framing: reach.framing(clip, &anatomy),
            bar: false,
            ..AnimationOptions::default()
        };
        Animation::new(clip, &anatomy, options)
            .expect("an animation")
            .draw(0)
    });
    let size = |image: &Image| (image.width(), image.height());
    assert_eq!(size(&drawn[0]), size(&drawn[1]));
    let differing = |other: &Image| {
        let pairs = drawn[0].pixels().iter().zip(other.pixels());
        pairs.filter(|(a, b)| a != b).count() as f64 / drawn[0].pixels().len() as f64
    };
    // The hips sway within the clip, so that a part of it may lie a pixel beside the whole.
    assert!(differing(&drawn[2]) < 0.01, "{}", differing(&drawn[2]));
    assert!(differing(&drawn[1]) < 0.10, "{}", differing(&drawn[1]));
}
