//! Vectors of another program, and properties of cutting.

use std::collections::BTreeMap;

use super::frame_numbers::LinearHead;
use super::*;
use chereme_motion::Skeleton;
use chereme_sign::hamnosys::HandClass;
use glam::DVec3;
use serde_json::Value;

use crate::transcribe::tests::{Held, ease};

/// Returns the vectors of cutting; `None` without the file, which is reported.
fn cutting_vectors() -> Option<Value> {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return None;
    };
    let path = std::path::Path::new(&folder).join("../facts/cutting_vectors.json");
    let Ok(text) = std::fs::read_to_string(&path) else {
        eprintln!("skipped: no {}", path.display());
        return None;
    };
    Some(serde_json::from_str(&text).expect("JSON"))
}

fn number_list(value: &Value) -> Vec<f64> {
    let numbers = value.as_array().expect("a list").iter();
    numbers.map(|number| number.as_f64().expect("a number")).collect()
}

fn frame_list(value: &Value) -> Vec<Range<usize>> {
    let spans = value.as_array().expect("spans").iter();
    let frame = |value: &Value| value.as_u64().expect("a frame") as usize;
    spans.map(|span| frame(&span[0])..frame(&span[1])).collect()
}

#[test]
fn vectors_of_peeling_give_the_same_spans() {
    let Some(vectors) = cutting_vectors() else { return };
    for case in vectors["peel"].as_array().expect("cases") {
        let curve = |side: &str, name: &str| number_list(&case[side][name]);
        let curves = ["right", "left"].map(|side| [curve(side, "y"), curve(side, "sp")]);
        let hands = curves.each_ref().map(|[height, speed]| WristCurve { height, speed });
        let peeled = peel_activities(hands, RestHeights::measure_rest(hands));
        let second = |sample: &usize| *sample as f64 / CURVE_RATE;
        let spans: Vec<Vec<f64>> = peeled
            .iter()
            .map(|sign| vec![second(sign.sign.start()), second(sign.sign.end())])
            .collect();
        let wanted: Vec<Vec<f64>> = case["spans"]
            .as_array()
            .expect("spans")
            .iter()
            .map(number_list)
            .collect();
        assert_eq!(spans, wanted);
    }
}

#[test]
fn vectors_of_decoding_give_the_same_spans() {
    let Some(vectors) = cutting_vectors() else { return };
    for case in vectors["decode"].as_array().expect("cases") {
        let odds = FrameOdds {
            sign: number_list(&case["sign"]),
            begin: number_list(&case["begin"]),
            end: number_list(&case["end"]),
        };
        let cost = case["cost"].as_f64().expect("a cost");
        let spans = odds.decode_signs(0..odds.sign.len(), 1.0, cost);
        assert_eq!(spans, frame_list(&case["spans"]), "{}", case["about"]);
    }
}

#[test]
fn vectors_of_twelve_numbers_give_the_same_odds_and_spans() {
    let Some(vectors) = cutting_vectors() else { return };
    let case = &vectors["twelve"][0];
    let names: Vec<&str> = case["names"]
        .as_array()
        .expect("names")
        .iter()
        .filter_map(Value::as_str)
        .collect();
    let rows: Vec<Vec<f64>> = case["X"].as_array().expect("rows").iter().map(number_list).collect();
    let mut all_odds = Vec::new();
    for (place, head) in vectors["weights12"].as_array().expect("heads").iter().enumerate() {
        let mut weights: BTreeMap<String, f64> = serde_json::from_value(head["w"].clone()).expect("weights");
        weights.insert("bias".to_owned(), head["bias"].as_f64().expect("a bias"));
        let prior = head["prior"].as_f64().filter(|_| place > 0);
        let head = LinearHead::from_weights(&weights, prior);
        let number = |row: &[f64], name: &str| row[names.iter().position(|known| *known == name).expect("a number")];
        let odds: Vec<f64> = rows
            .iter()
            .map(|row| head.frame_log_odds(|_, name| number(row, name)))
            .collect();
        for (frame, wanted) in number_list(&case["heads"][place]).into_iter().enumerate() {
            assert!(
                (odds[frame] - wanted).abs() < 0.02,
                "head {place}, frame {frame}: {} {wanted}",
                odds[frame]
            );
        }
        all_odds.push(odds);
    }
    let [sign, begin, end] = <[Vec<f64>; 3]>::try_from(all_odds).expect("three heads");
    let odds = FrameOdds { sign, begin, end };
    let spans = odds.decode_signs(0..rows.len(), 0.5, 3.0);
    let seconds = |frames: &Range<usize>| vec![frames.start as f64 / FRAME_RATE, frames.end as f64 / FRAME_RATE];
    let spans: Vec<Vec<f64>> = spans.iter().map(seconds).collect();
    let wanted: Vec<Vec<f64>> = case["spans"]
        .as_array()
        .expect("spans")
        .iter()
        .map(number_list)
        .collect();
    assert_eq!(spans, wanted);
}

/// Returns a take of several signs between two rests by the right hand: it comes up, goes to and fro, stays, and goes on to the
/// next place; `tempo` is the speed.
pub(crate) fn signed_clip(signs: usize, tempo: f64) -> (Clip, BodyAnatomy) {
    let way = signed_way(signs);
    let seconds = whole_frames(way.last().map_or(0.0, |point| point.time) / tempo);
    crate::transcribe::tests::clip(seconds, |share| {
        [
            Some(signed_hand(&way, share)),
            Some(resting_hand(HandClass::Flat).mirrored()),
        ]
    })
}

/// Rounds a time so that the frames of its clip begin and end on samples of the curves.
fn whole_frames(seconds: f64) -> f64 {
    // The clip has 20 frames more, at 60 Hz; six frames are five samples.
    ((seconds * 60.0 + 20.0) / 6.0).round() * 0.1 - 19.0 / 60.0 + 1e-9
}

fn resting_hand(class: HandClass) -> Held {
    Held::new([-0.2, -0.5, 0.05], "d", "l", class)
}

/// A place on the way of a hand, and its shape there.
struct WayPoint {
    time: f64,
    place: DVec3,
    class: HandClass,
}

/// Returns the way of the hand: from rest to each sign, and back.
fn signed_way(signs: usize) -> Vec<WayPoint> {
    let rest = resting_hand(HandClass::Flat).at;
    let mut way: Vec<WayPoint> = Vec::new();
    let mut go = |seconds: f64, place: DVec3, class: HandClass| {
        let time = way.last().map_or(0.0, |before| before.time) + seconds;
        way.push(WayPoint { time, place, class });
    };
    go(0.0, rest, HandClass::Flat);
    go(0.6, rest, HandClass::Flat);
    for sign in 0..signs {
        let (place, class) = [
            (DVec3::new(-0.15, -0.05, 0.25), HandClass::Flat),
            (DVec3::new(-0.05, 0.15, 0.2), HandClass::Fist),
            (DVec3::new(-0.25, -0.15, 0.3), HandClass::Finger2),
        ][sign % 3];
        go(0.4, place, class);
        for aside in [0.09, 0.0, 0.09, 0.0] {
            go(0.14, place + DVec3::X * aside, class);
        }
        go(0.12, place, class);
    }
    go(0.4, rest, HandClass::Flat);
    go(0.6, rest, HandClass::Flat);
    way
}

/// Returns the hand on its way after a share of the whole time.
fn signed_hand(way: &[WayPoint], share: f64) -> Held {
    let time = share * way.last().map_or(0.0, |point| point.time);
    let next = way
        .iter()
        .position(|point| point.time >= time)
        .unwrap_or(way.len() - 1)
        .max(1);
    let [from, to] = [&way[next - 1], &way[next]];
    let part = ease(((time - from.time) / (to.time - from.time)).clamp(0.0, 1.0));
    let hand = resting_hand(if part < 0.5 { from.class } else { to.class });
    hand.moved(from.place.lerp(to.place, part) - hand.at)
}

/// Returns the times of the signs in seconds.
fn sign_seconds(cut: &TakeCut) -> Vec<[f64; 2]> {
    let seconds = |sign: &CutSign| {
        let (start, end) = (sign.span.span_start_instant(), sign.span.span_end_instant());
        [start.instant_seconds(), end.instant_seconds()]
    };
    cut.signs.iter().map(seconds).collect()
}

fn cut(take: &(Clip, BodyAnatomy)) -> TakeCut {
    cut_take(&take.0, &take.1, CutOptions::default()).expect("signs")
}

/// Returns a clip with its frames in another order.
fn reordered(take: &(Clip, BodyAnatomy), frames: impl Fn(usize) -> usize) -> (Clip, BodyAnatomy) {
    let clip = &take.0;
    let poses: Vec<_> = (0..clip.clip_frame_count())
        .map(|frame| clip.clip_pose_at(frames(frame)))
        .collect();
    let clip = Clip::from_poses(clip.clip_skeleton().clone(), clip.clip_frame_rate(), &poses).expect("a clip");
    (clip, take.1.clone())
}

#[test]
fn one_sign_between_two_rests_is_peeled_with_its_phases() {
    let take = signed_clip(1, 1.0);
    let cut = cut(&take);
    let [sign] = cut.signs.as_slice() else {
        panic!("{cut:?}")
    };
    assert_eq!(
        (sign.rule, sign.dominant, sign.is_two_handed),
        (CutRule::Peeled, BodySide::Right, false)
    );
    // The posture is reached after 1/6 s of the clip's own hold, 0.6 s of rest and 0.4 s of preparation.
    let [[begin, end]] = sign_seconds(&cut)[..] else {
        unreachable!()
    };
    assert!(
        (begin - 1.17).abs() < 0.08 && (end - 1.85).abs() < 0.08,
        "{begin} {end}"
    );
    let kinds: Vec<PhaseKind> = cut.phases[0].iter().map(|phase| phase.kind).collect();
    assert_eq!(kinds.first(), Some(&PhaseKind::Preparation));
    assert_eq!(kinds.last(), Some(&PhaseKind::Retraction));
    assert!(kinds.contains(&PhaseKind::Stroke), "{kinds:?}");
    assert!(cut.phases[1].is_empty(), "the hand at rest has no phases");
}

#[test]
fn a_take_reversed_mirrored_or_slower_has_the_same_signs() {
    for signs in [1, 3] {
        let take = signed_clip(signs, 1.0);
        let usual = cut(&take);
        let last = take.0.clip_frame_count() - 1;
        let length = last as f64 / 60.0;
        let reversed = cut(&reordered(&take, |frame| last - frame));
        if signs == 1 {
            let mut back: Vec<[f64; 2]> = sign_seconds(&reversed)
                .iter()
                .map(|[a, b]| [length - b, length - a])
                .collect();
            back.reverse();
            for (one, other) in sign_seconds(&usual).iter().zip(&back) {
                assert!(
                    (one[0] - other[0]).abs() < 1e-3 && (one[1] - other[1]).abs() < 1e-3,
                    "{one:?} {other:?}"
                );
            }
        }
        let slow = cut(&signed_clip(1, 0.5));
        assert_eq!(slow.signs.len(), 1);
        let way = signed_way(signs);
        let seconds = whole_frames(way.last().map_or(0.0, |point| point.time));
        let mirrored = cut(&crate::transcribe::tests::clip(seconds, |share| {
            [
                Some(resting_hand(HandClass::Flat)),
                Some(signed_hand(&way, share).mirrored()),
            ]
        }));
        assert_eq!(sign_seconds(&mirrored), sign_seconds(&usual));
        assert!(mirrored.signs.iter().all(|sign| sign.dominant == BodySide::Left));
        assert_eq!(mirrored.phases[1], usual.phases[0]);
    }
}

#[test]
fn several_signs_in_one_activity_are_decoded_and_the_cost_changes_their_number() {
    let take = signed_clip(3, 1.0);
    let with_cost = |steps: i32| {
        let cut = cut_take(&take.0, &take.1, CutOptions::with_more_signs(steps)).expect("signs");
        cut.signs.len()
    };
    let counts: Vec<usize> = [-20, -2, 0, 2].map(with_cost).to_vec();
    assert!(counts.is_sorted(), "{counts:?}");
    assert!(counts[0] == 1 && counts[3] > 1, "{counts:?}");
}

#[test]
fn takes_without_signs_say_why() {
    let reason = |take: &(Clip, BodyAnatomy)| cut_take(&take.0, &take.1, CutOptions::default()).expect_err("no sign");
    let take = signed_clip(1, 1.0);
    assert_eq!(reason(&reordered(&take, |_| 0)), UncutReason::NoMovement);
    let one = (take.0.slice_clip_frames(0..1), take.1.clone());
    assert_eq!(reason(&one), UncutReason::NoMovement);
    let none = (take.0.slice_clip_frames(0..0), take.1.clone());
    assert_eq!(reason(&none), UncutReason::NoArms);
    let low = crate::transcribe::tests::clip(2.0, |share| {
        let aside = DVec3::X * (0.2 * (share * 20.0).sin());
        [Some(resting_hand(HandClass::Flat).moved(aside)), None]
    });
    assert_eq!(reason(&low), UncutReason::HandsStayLow);
    let mut joints = take.0.clip_skeleton().skeleton_joints().to_vec();
    joints.iter_mut().for_each(|joint| joint.offset = DVec3::ZERO);
    let skeleton = std::sync::Arc::new(Skeleton::new(joints).expect("a tree"));
    let still = Clip::from_rest_pose(skeleton.clone(), take.0.clip_frame_rate(), 90);
    assert_eq!(
        reason(&(still, BodyAnatomy::detect_anatomy(&skeleton))),
        UncutReason::NoArms
    );
}
