//! Re-synthesis by simple animators: one displaces every hand from its place by a known offset, another has sizes of its
//! own.

use chereme_sign::hamnosys::sites::{DigitFace, NotatedHandPoint};
use chereme_sign::hamnosys::{BodyLocation, BodyPlace, DirectionAim, HandConstellation, HandDigit, PlaceContact};
use chereme_sign::hamnosys::{HandClass, HandPlace, LocationSide, MotionKind, MotionSize, SidedLocation, orientation};
use chereme_sign::hamnosys::{from_names, parse_hamnosys};
use glam::DQuat;

use super::*;
use crate::transcribe::aim;
use crate::transcribe::tests::{Held, before_chest, clip, ease};
use crate::transcribe::transcribe_place::{HandsTogether, hand_point_site};
use crate::transcribe::transcribe_scene::SignerScene;
use crate::transcribe::{FeatureKind, TranscribeOptions, transcribe_clip, transcribe_proven};

type Hands = [Option<Held>; 2];

/// Hands, with the places and constellations in their reach.
struct Near {
    hands: Hands,
    /// The offset (m) from each hand to each place.
    offsets: [Vec<(BodyPlace, DVec3)>; 2],
    pairs: Vec<HandsTogether>,
    /// The goal (m) that each place gives to the middle of two parts.
    goals: Vec<(BodyPlace, DVec3)>,
}

impl Near {
    fn of(hands: Hands) -> Self {
        let both = hands[1].is_some();
        let (offsets, pairs, goals) = seen(&hands, |body| {
            let offsets = [0, 1].map(|n| {
                let all = body.rank_hand_places(n, both, usize::MAX).into_iter();
                all.map(|placed| (placed.place, -placed.aside)).collect()
            });
            let pairs = body.likeliest_pairs(usize::MAX);
            let goals = pairs.first().map_or_else(Vec::new, |first| {
                let all = body.likeliest_shared(first, usize::MAX).into_iter();
                all.map(|placed| (placed.place, middle(first) - placed.aside)).collect()
            });
            (offsets, pairs, goals)
        });
        Self {
            hands,
            offsets,
            pairs,
            goals,
        }
    }

    /// Returns the hands exactly at a place; `None` if it is out of reach.
    fn at(&self, place: &HandPlace) -> Option<Hands> {
        let offset = match place {
            HandPlace::Body(own) => {
                let both = self.offsets.each_ref().map(|offsets| find(offsets, own));
                [both[0]?, both[1].unwrap_or_default()]
            }
            HandPlace::Hands(constellation) => self.together(constellation)?,
            _ => return None,
        };
        Some(moved(&self.hands, offset))
    }

    fn together(&self, wanted: &HandConstellation) -> Option<[DVec3; 2]> {
        let mut pairs = self.pairs.iter();
        let together = pairs.find(|together| {
            let parts = together.parts.map(|part| together.named.then(|| hand_point_site(part)));
            parts == [wanted.dominant.clone(), wanted.other.clone()] && wanted.contact == Some(together.contact)
        })?;
        let goal = find(&self.goals, wanted.at.as_ref()?)?;
        let offset = goal - middle(together);
        let apart = together.aside / 2.0;
        Some([offset - apart, offset + apart])
    }
}

fn find(all: &[(BodyPlace, DVec3)], place: &BodyPlace) -> Option<DVec3> {
    let mut all = all.iter();
    all.find(|(it, _)| it == place).map(|it| it.1)
}

fn middle(together: &HandsTogether) -> DVec3 {
    together.at[0].midpoint(together.at[1])
}

fn moved(hands: &Hands, by: [DVec3; 2]) -> Hands {
    [0, 1].map(|n| hands[n].as_ref().map(|held| held.moved(by[n])))
}

/// Calls `look` with the body that holds its hands like this.
fn seen<T>(hands: &Hands, look: impl FnOnce(&PosedBody<'_>) -> T) -> T {
    let (clip, anatomy) = clip(0.0, |_| hands.clone());
    let options = TranscribeOptions::synthesised_options();
    let scene = SignerScene::read_signer_scene(&clip, &anatomy, &options).expect("a scene");
    look(
        &SceneReadings::new(&scene, &options)
            .read_uncached_body(0)
            .expect("a body"),
    )
}

/// An animator that puts each hand `by` metres beside its place, and `later` metres farther if it performs a whole sign.
struct Displaces {
    near: [Near; 2],
    by: [DVec3; 2],
    later: DVec3,
}

impl NotationSynthesiser for Displaces {
    fn synthesise_first_posture(&self, sign: &NotatedSign) -> Option<Clip> {
        self.displaced(&sign.sign, DVec3::ZERO)
    }

    fn synthesise_notated_sign(&self, sign: &NotatedSign) -> Option<Clip> {
        self.displaced(&sign.sign, self.later)
    }
}

impl Displaces {
    fn displaced(&self, sign: &HamnosysSign, farther: DVec3) -> Option<Clip> {
        let place = sign.parts[0].posture.place.as_ref()?;
        let ideal = self.near.iter().find_map(|near| near.at(place))?;
        let hands = moved(&ideal, self.by.map(|by| by + farther));
        Some(clip(0.0, |_| hands.clone()).0)
    }
}

/// Transcribes hands that an animator put `by` metres beside their `place`, which is within reach of the hands `from`.
/// Returns the place as it is read without re-synthesis, and with it.
fn read(from: Hands, place: &HandPlace, by: [DVec3; 2]) -> [Option<HandPlace>; 2] {
    read_later(from, place, by, DVec3::ZERO)
}

/// Like [`read`], if the whole sign displaces the hands `later` metres farther, because the movement is misread.
fn read_later(from: Hands, place: &HandPlace, by: [DVec3; 2], later: DVec3) -> [Option<HandPlace>; 2] {
    let ideal = Near::of(from).at(place).expect("a place within reach");
    let there = moved(&ideal, by);
    let (clip, anatomy) = clip(0.0, |_| there.clone());
    let displaces = Displaces {
        near: [there, ideal].map(Near::of),
        by,
        later,
    };
    let options = TranscribeOptions::synthesised_options();
    let alone = transcribe_clip(&clip, &anatomy, &options).expect("a sign");
    let proven = transcribe_proven(&clip, &anatomy, &options, &displaces).expect("a sign");
    [alone, proven].map(|found| found.sign.parts[0].posture.place.clone())
}

fn site(at: BodyLocation, side: Option<LocationSide>) -> Option<SidedLocation<BodyLocation>> {
    let approx = false;
    Some(SidedLocation { at, side, approx })
}

#[test]
fn a_hand_that_is_displaced_by_centimetres_is_read_at_its_place() {
    use BodyLocation::{Chest, Forehead, Shoulders, Stomach};
    let right = Some(LocationSide::RightAt);
    let cases = [
        (site(Chest, right), None, [0.0, 0.16, 0.0]),
        (site(Shoulders, right), None, [0.09, -0.14, 0.08]),
        (site(Stomach, None), None, [-0.14, 0.12, 0.0]),
        (site(Forehead, right), Some(PlaceContact::Close), [-0.10, -0.12, 0.04]),
    ];
    for (site, contact, by) in cases {
        let place = HandPlace::Body(BodyPlace {
            site,
            contact,
            ..BodyPlace::default()
        });
        let from = [Some(before_chest(HandClass::Flat)), None];
        let [alone, proven] = read(from, &place, [by.into(), DVec3::ZERO]);
        assert_ne!(alone.as_ref(), Some(&place), "it needs no re-synthesis");
        assert_eq!(proven.as_ref(), Some(&place), "displaced by {by:?}");
    }
}

#[test]
fn a_hand_whose_movement_is_misread_is_read_by_its_first_posture() {
    use BodyLocation::{Chest, Shoulders, Stomach};
    let right = Some(LocationSide::RightAt);
    let cases = [
        (site(Chest, right), [0.0, 0.16, 0.0]),
        (site(Shoulders, right), [0.09, -0.14, 0.08]),
        (site(Stomach, None), [-0.14, 0.12, 0.0]),
    ];
    for (site, by) in cases {
        let place = HandPlace::Body(BodyPlace {
            site,
            ..BodyPlace::default()
        });
        for later in [[0.0, 0.0, 0.03], [0.02, -0.02, 0.0]] {
            let from = [Some(before_chest(HandClass::Flat)), None];
            let by = [by.into(), DVec3::ZERO];
            let [alone, proven] = read_later(from, &place, by, later.into());
            assert_ne!(alone.as_ref(), Some(&place), "it needs no re-synthesis");
            assert_eq!(proven.as_ref(), Some(&place), "{by:?}, then {later:?}");
        }
    }
}

/// An animator that moves a hand down in a third of a second, as far as the size says.
struct Moves {
    held: Held,
    /// The length (m) of each size: small, usual and big.
    lengths: [f64; 3],
}

impl Moves {
    fn down(&self, length: f64) -> Clip {
        let down = |time| self.held.moved(DVec3::NEG_Y * length * ease(time));
        clip(0.3, |time| [Some(down(time)), None]).0
    }
}

impl NotationSynthesiser for Moves {
    fn synthesise_first_posture(&self, _: &NotatedSign) -> Option<Clip> {
        Some(clip(0.0, |_| [Some(self.held.clone()), None]).0)
    }

    fn synthesise_notated_sign(&self, sign: &NotatedSign) -> Option<Clip> {
        let [small, usual, big] = self.lengths;
        let action = sign.sign.parts[0].actions.first()?;
        let MotionKind::Directed(path) = &action.kind else {
            return self.synthesise_first_posture(sign);
        };
        Some(self.down(match path.size.first {
            Some(MotionSize::Small) => small,
            None => usual,
            Some(MotionSize::Big) => big,
        }))
    }
}

#[test]
fn a_movement_that_is_misread_is_replaced_with_its_features() {
    let moves = Moves {
        held: before_chest(HandClass::Flat),
        lengths: [0.05, 0.09, 0.13],
    };
    let observed = moves.down(0.13);
    let anatomy = clip(0.0, |_| [Some(moves.held.clone()), None]).1;
    let options = TranscribeOptions::synthesised_options();
    let size = |found: &TokenTranscription| {
        let mut features = found.features.iter();
        let feature = features.find(|it| it.kind == FeatureKind::Size);
        feature.expect("a size").clone()
    };
    let alone = transcribe_clip(&observed, &anatomy, &options).expect("a sign");
    let before = size(&alone);
    assert_ne!(before.value, "big", "it needs no re-synthesis");
    let found = transcribe_proven(&observed, &anatomy, &options, &moves).expect("a sign");
    let after = size(&found);
    assert_eq!(after.value, "big");
    assert!(after.residual < 0.01, "{after:?}");
    let next = after.runner_up.expect("the first reading");
    assert_eq!(next.value, before.value);
    assert!(next.residual > 1.0, "{next:?}");
    let MotionKind::Directed(path) = &found.sign.parts[0].actions[0].kind else {
        panic!("{:?}", found.sign);
    };
    assert_eq!(path.size.first, Some(MotionSize::Big));
    assert!(found.stages[1].text.contains(&after.text), "{:?}", found.stages);
    let mut findings = found.findings.iter();
    assert!(
        findings.any(|it| it.contains("which was read first")),
        "{:?}",
        found.findings
    );
}

#[test]
fn fast_movement_is_not_smoothed_if_it_was_synthesised() {
    let moves = Moves {
        held: before_chest(HandClass::Flat),
        lengths: [0.05, 0.09, 0.13],
    };
    let shaken = |time: f64| {
        let frame = (60.0 * time).round();
        moves.held.turned(DQuat::from_rotation_x(0.02 * (frame % 2.0)))
    };
    let (observed, anatomy) = clip(1.0, |time| [Some(shaken(time)), None]);
    let options = TranscribeOptions::synthesised_options();
    let smoothed = |found: &TokenTranscription| found.findings.iter().any(|it| it.contains("tremble"));
    let captured = transcribe_clip(&observed, &anatomy, &options).expect("a sign");
    assert!(smoothed(&captured), "{:?}", captured.findings);
    let made = transcribe_proven(&observed, &anatomy, &options, &moves).expect("a sign");
    assert!(!smoothed(&made), "{:?}", made.findings);
}

/// An animator that turns every hand farther than it is written, by the same rotation.
struct Turns {
    held: Held,
    by: DQuat,
}

impl NotationSynthesiser for Turns {
    fn synthesise_first_posture(&self, sign: &NotatedSign) -> Option<Clip> {
        let posture = &sign.sign.parts[0].posture;
        let along = aim::notated_aim_vector(posture.extended.dominant_value()?);
        let palm = orientation::palm_direction_vector(along.to_array(), posture.palm.dominant_value()?.aim_angle());
        let written = Held {
            along,
            palm: palm.into(),
            ..self.held.clone()
        };
        Some(clip(0.0, |_| [Some(written.turned(self.by)), None]).0)
    }

    fn synthesise_notated_sign(&self, sign: &NotatedSign) -> Option<Clip> {
        self.synthesise_first_posture(sign)
    }
}

#[test]
fn a_hand_that_is_turned_less_than_written_is_read_as_written() {
    for (along, palm, by) in [
        ("il", "r", [0.0, 0.5, 0.0]),
        ("u", "l", [-0.45, 0.0, 0.0]),
        ("ul", "d", [0.2, 0.3, -0.3]),
        ("o", "dr", [0.0, 0.0, 0.6]),
    ] {
        let held = Held::new([-0.1, 0.0, 0.3], along, palm, HandClass::Flat);
        let turns = Turns {
            held: held.clone(),
            by: DQuat::from_scaled_axis(by.into()),
        };
        let there = held.turned(turns.by);
        let (observed, anatomy) = clip(0.0, |_| [Some(there.clone()), None]);
        let options = TranscribeOptions::synthesised_options();
        let alone = transcribe_clip(&observed, &anatomy, &options).expect("a sign");
        let proven = transcribe_proven(&observed, &anatomy, &options, &turns).expect("a sign");
        let read = |found: &TokenTranscription| {
            let posture = &found.sign.parts[0].posture;
            (posture.extended.clone(), posture.palm.clone())
        };
        let written = (
            EachHand::Shared(DirectionAim::aim_at(along.parse().expect("a direction"))),
            EachHand::Shared(DirectionAim::aim_at(palm.parse().expect("a palm"))),
        );
        assert_ne!(read(&alone), written, "it needs no re-synthesis");
        assert_eq!(read(&proven), written, "{by:?}");
        let residual = |kind: FeatureKind| {
            let mut features = proven.features.iter();
            features.find(|it| it.kind == kind).map(|it| it.residual)
        };
        let apart = aim::notated_aim_vector(&DirectionAim::aim_at(along.parse().expect("a direction")))
            .angle_between(there.along);
        let shown = residual(FeatureKind::Direction).expect("a direction");
        assert!((shown - apart.to_degrees()).abs() < 1.0, "{shown}");
    }
}

#[test]
fn hands_that_are_moved_apart_are_read_by_the_parts_that_were_to_meet() {
    let own = Held::new([-0.03, -0.10, 0.30], "uo", "l", HandClass::Flat);
    let other = Held::new([0.03, -0.12, 0.30], "ur", "d", HandClass::Finger2);
    let from = [Some(own), Some(other)];
    let flesh = [[-0.03, 0.02, 0.03], [0.01, -0.02, 0.02]].map(DVec3::from);
    let base = NotatedHandPoint::Base(HandDigit::Index, DigitFace::Palmar);
    let cases = [
        ([NotatedHandPoint::Palm, base], PlaceContact::Touch),
        ([NotatedHandPoint::Palm, NotatedHandPoint::Back], PlaceContact::Close),
        ([NotatedHandPoint::Ulnar, NotatedHandPoint::Palm], PlaceContact::Close),
    ];
    for (parts, contact) in cases {
        let [dominant, other] = parts.map(|part| Some(hand_point_site(part)));
        let place = HandPlace::Hands(HandConstellation {
            dominant,
            other,
            contact: Some(contact),
            at: Some(BodyPlace {
                site: site(BodyLocation::Chest, None),
                ..BodyPlace::default()
            }),
            ..HandConstellation::default()
        });
        let [alone, proven] = read(from.clone(), &place, flesh);
        assert_ne!(alone.as_ref(), Some(&place), "it needs no re-synthesis");
        assert_eq!(proven.as_ref(), Some(&place), "{parts:?}");
    }
}

#[test]
fn rests_are_removed_at_any_depth() {
    for names in [
        "hammoveu hamrest",
        "hammoveu hamrest hamrepeatfromstart",
        "hamparbegin hammoveu hamrest hamplus hamnomotion hamparend hammover hamrest",
        "hamparbegin hammoveu hamrest hamreplace hamextfingerl hamparend hamrest",
        "hamseqbegin hammoveu hamrest hammoved hamseqend",
    ] {
        let read = |names: &str| -> Vec<NotatedMotion> {
            let posture = "hamsymmlr hamflathand hamextfingero hampalml hamchest";
            let text = from_names(format!("{posture} {names}").split_whitespace());
            let sign = parse_hamnosys(&text.expect("names of symbols")).expect("HamNoSys").sign;
            sign.parts[0].actions.clone()
        };
        let unrested: Vec<NotatedMotion> = read(names)
            .iter()
            .map(super::resynthesis_actions::without_motion_rests)
            .collect();
        assert_eq!(unrested, read(&names.replace("hamrest", "")), "{names}");
    }
}
