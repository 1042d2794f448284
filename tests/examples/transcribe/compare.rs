//! Compares two notations of one sign feature by feature.

use chereme_analysis::transcribe::{TranscribeOptions, off_place};
use chereme_motion::BodySide;
use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::{
    BodyLanguage, BodyPlace, DirectionAim, EachHand, HandPlace, HandsUsed, Handshape, ManualPart, MotionKind,
    MotionManner, MotionSize, NotatedMotion, NotatedPosture, RepeatKind, SpatialDirection, WristMotion, orientation,
};

use crate::notation::Again;

/// The result for one feature.
#[derive(Debug, Clone)]
pub(crate) struct Verdict {
    pub(crate) feature: &'static str,
    pub(crate) agrees: bool,
    pub(crate) written: String,
    pub(crate) found: String,
}

/// Compares a part as written with the part that was found.
pub(crate) fn compare(written: &ManualPart, again: &Again) -> Vec<Verdict> {
    let found = &again.found.sign.parts.first().cloned().unwrap_or_default();
    let mut all = Vec::new();
    let mut say = |feature, agrees, written: String, found: String| {
        all.push(Verdict {
            feature,
            agrees,
            written,
            found,
        });
    };
    let (a, b) = (hands(written), hands(found));
    // Two motions, one for each hand, may express the same as one motion with a symmetry.
    let split = written.actions.iter().any(names_other);
    let agrees = a == b || (split && a != "one" && b != "one");
    say("hands", agrees, a, b);
    for n in 0..2 {
        posture(n, &written.posture, &found.posture, &mut say);
    }
    held(&written.posture, &found.posture, again, &mut say);
    let moves = !written.actions.is_empty();
    if let (Some(begins), Some(feature), true) = (again.begins, again.found.features.first(), moves) {
        let off = feature.frame as i64 - begins as i64;
        let (a, b) = (begins.to_string(), format!("{off:+}"));
        say("first frame", off.abs() <= 1, a, b);
    }
    let symmetric = matches!(written.hands, HandsUsed::Both(_));
    let off = |a: &BodyPlace, b: Option<&BodyPlace>| -> Option<(f64, f64)> {
        let feature = again.found.features.first()?;
        let options = TranscribeOptions::synthesised_options();
        off_place(&again.clip, &again.anatomy, &options, feature.frame, a, b, symmetric).ok()?
    };
    place(&written.posture, &found.posture, &off, &mut say);
    movement(written, found, &mut say);
    all
}

fn hands(part: &ManualPart) -> String {
    let posture = &part.posture;
    match part.hands {
        HandsUsed::Both(symmetry) => {
            let marks = [
                (symmetry.left_right, "lr"),
                (symmetry.up_down, "ud"),
                (symmetry.out_in, "oi"),
                (symmetry.out_of_phase, "alternating"),
            ];
            let words: Vec<&str> = marks.iter().filter_map(|(is, word)| is.then_some(*word)).collect();
            format!("both {}", words.join(" "))
        }
        _ => {
            let two = posture.shape.other_value().is_some()
                || posture.extended.other_value().is_some()
                || posture.palm.other_value().is_some()
                || matches!(posture.place, Some(HandPlace::Hands(_) | HandPlace::Split(_, Some(_))));
            let two = two || part.actions.iter().any(names_other);
            if two { "two" } else { "one" }.to_owned()
        }
    }
}

fn names_other(motion: &NotatedMotion) -> bool {
    match &motion.kind {
        MotionKind::Split(_, other) => other.is_some(),
        MotionKind::Sequence { motions, .. } | MotionKind::Parallel(motions) => motions.iter().any(names_other),
        MotionKind::Target { motion, posture } => {
            motion.as_deref().is_some_and(names_other)
                || matches!(posture.place, Some(HandPlace::Hands(_) | HandPlace::Split(_, Some(_))))
                || posture.shape.other_value().is_some()
        }
        MotionKind::Repeated { motion, .. } => names_other(motion),
        _ => false,
    }
}

fn of<T>(each: &EachHand<T>, n: usize) -> Option<&T> {
    match each {
        EachHand::Split(a, b) => [a, b][n].as_ref(),
        shared if n == 0 => shared.dominant_value(),
        _ => None,
    }
}

fn posture(
    n: usize,
    written: &NotatedPosture,
    found: &NotatedPosture,
    say: &mut impl FnMut(&'static str, bool, String, String),
) {
    let names = [
        ["class", "handshape", "direction", "direction near", "palm", "palm near"],
        [
            "other class",
            "other handshape",
            "other direction",
            "other direction near",
            "other palm",
            "other palm near",
        ],
    ][n];
    let language = BodyLanguage::default_body_language();
    if let Some(shape) = of(&written.shape, n) {
        let other = of(&found.shape, n);
        let same = other.is_some_and(|other| {
            other == shape || chereme_analysis::transcribe::looks_the_same(shape, other, language)
        });
        let class = other.is_some_and(|other| {
            let classes = |shape: &Handshape| {
                let second = shape.between.map(|form| form.class);
                let mut all = vec![shape.form.class];
                all.extend(second.filter(|second| *second != shape.form.class));
                all.sort();
                all
            };
            same || classes(shape) == classes(other)
        });
        say(names[0], class, words(Some(shape)), words(other));
        say(names[1], same, words(Some(shape)), words(other));
    }
    if let Some(aim) = of(&written.extended, n) {
        let other = of(&found.extended, n);
        let off = other.map_or(180.0, |other| vector(aim).angle_between(vector(other)).to_degrees());
        let (a, b) = (aimed(Some(aim)), aimed(other));
        say(names[2], off < 1.0, a.clone(), b.clone());
        say(names[3], off < 31.0, a, b);
    }
    if let Some(aim) = of(&written.palm, n) {
        let other = of(&found.palm, n);
        let off = other.map_or(180.0, |other| {
            let apart = (aim.aim_angle() - other.aim_angle()).to_degrees();
            ((apart + 180.0).rem_euclid(360.0) - 180.0).abs()
        });
        let (a, b) = (aimed(Some(aim)), aimed(other));
        say(names[4], off < 1.0, a.clone(), b.clone());
        say(names[5], off < 23.0, a, b);
    }
}

/// A hand holds a direction or palm if it is nearer to it than to the next possible one, in degrees.
const HELD: f64 = 11.25;

/// Writes the direction of the dominant hand and of its palm again, for the parts in which the body follows the
/// notation: losses here are losses of the transcriber.
fn held(
    written: &NotatedPosture,
    found: &NotatedPosture,
    again: &Again,
    say: &mut impl FnMut(&'static str, bool, String, String),
) -> Option<()> {
    let frame = again.found.features.first()?.frame;
    let model = again.clip.model_pose(frame);
    let body = again.anatomy.body_frame(&model)?;
    let forward = DVec3::new(body.forward.x, 0.0, body.forward.z).try_normalize()?;
    let left = DVec3::Y.cross(forward);
    let level = |v: DVec3| DVec3::new(v.dot(left), v.y, v.dot(forward));
    let along = level(again.anatomy.hand_direction(BodySide::Right, &model)?);
    let aim = of(&written.extended, 0)?;
    if along.angle_between(vector(aim)).to_degrees() > HELD {
        return None;
    }
    let inferred = of(&found.extended, 0);
    let agrees = inferred.is_some_and(|inferred| vector(inferred).angle_between(vector(aim)) < 0.02);
    let (a, b) = (aimed(Some(aim)), aimed(inferred));
    say("direction where held", agrees, a, b);
    let palm = of(&written.palm, 0)?;
    let normal = level(again.anatomy.palm_normal(BodySide::Right, &model)?);
    let want = orientation::palm_direction_vector(vector(aim).to_array(), palm.aim_angle());
    if normal.angle_between(want.into()).to_degrees() > HELD {
        return None;
    }
    let inferred = of(&found.palm, 0);
    let agrees = inferred.is_some_and(|inferred| {
        let apart = (palm.aim_angle() - inferred.aim_angle()).to_degrees();
        ((apart + 180.0).rem_euclid(360.0) - 180.0).abs() < 1.0
    });
    let (a, b) = (aimed(Some(palm)), aimed(inferred));
    say("palm where held", agrees, a, b);
    Some(())
}

fn words(shape: Option<&Handshape>) -> String {
    let Some(shape) = shape else {
        return "none".to_owned();
    };
    let form = |form: &chereme_sign::hamnosys::HandshapeForm| {
        let mut words = format!("{:?}", form.class);
        if let Some(thumb) = form.thumb {
            words += &format!(" {thumb:?}");
        }
        if let Some(bend) = form.bend {
            words += &format!(" {bend:?}");
        }
        if let Some(opening) = form.opening {
            words += &format!(" {opening:?}");
        }
        words
    };
    let mut words = form(&shape.form);
    if let Some(second) = &shape.between {
        words += &format!(" | {}", form(second));
    }
    if !shape.special.is_empty() {
        words += &format!(" special {:?}", shape.special.0);
    }
    if !shape.exempt.is_empty() {
        words += &format!(" exempt {:?}", shape.exempt.0);
    }
    if shape.bends.iter().any(Option::is_some) {
        words += &format!(" bends {:?}", shape.bends);
    }
    if !shape.contacts.is_empty() {
        words += &format!(" contacts {}", shape.contacts.len());
    }
    if let Some(thumb) = shape.thumb {
        words += &format!(" {thumb:?}");
    }
    words
}

fn vector(aim: &DirectionAim<SpatialDirection>) -> DVec3 {
    let of = |direction: SpatialDirection| DVec3::from(direction.spatial_direction_vector());
    match aim.second {
        Some(second) => (of(aim.first) + of(second)).normalize_or(of(aim.first)),
        None => of(aim.first),
    }
}

fn aimed<D: std::fmt::Display>(aim: Option<&DirectionAim<D>>) -> String {
    match aim {
        None => "none".to_owned(),
        Some(aim) => match &aim.second {
            Some(second) => format!("{}|{second}", aim.first),
            None => aim.first.to_string(),
        },
    }
}

/// Distance of the hand from a place, and of that place from another one, in metres.
type Off<'a> = dyn Fn(&BodyPlace, Option<&BodyPlace>) -> Option<(f64, f64)> + 'a;

/// Two places whose points are nearer to each other than this (m) count as one.
const ONE_POINT: f64 = 0.01;

fn place(
    written: &NotatedPosture,
    found: &NotatedPosture,
    off: &Off<'_>,
    say: &mut impl FnMut(&'static str, bool, String, String),
) {
    let Some(a) = &written.place else { return };
    let (text, other) = (placed(a), found.place.as_ref().map_or("none".into(), placed));
    let bodies = |place: &HandPlace| match place {
        HandPlace::Body(body) => Some(body.clone()),
        HandPlace::Split(Some(first), _) => match first.as_ref() {
            HandPlace::Body(body) => Some(body.clone()),
            _ => None,
        },
        HandPlace::Hands(hands) => hands.at.clone(),
        _ => None,
    };
    let found_place = &found.place;
    match a {
        HandPlace::Body(_) | HandPlace::Split(..) => {
            let Some(body) = bodies(a) else { return };
            let found = found.place.as_ref().and_then(bodies);
            let same = found.as_ref().is_some_and(|found| one_place(found, &body));
            let level = found.as_ref().is_some_and(|found| {
                sites(found)
                    .iter()
                    .any(|site| sites(&body).iter().any(|other| site.0 == other.0))
            });
            let (at, mut found_at) = (spoken(Some(&body)), spoken(found.as_ref()));
            let measured = off(&body, found.as_ref());
            let distances = measured.filter(|_| !same);
            if measured.is_some_and(|(off, _)| off < ONE_POINT) {
                let (a, b) = (at.clone(), found_at.clone());
                say("location where held", same, a, b);
            }
            if let Some((off, apart)) = distances {
                found_at += &format!("\t[off {:.1} cm, apart {:.1} cm]", 100.0 * off, 100.0 * apart);
            }
            say("location", same, at.clone(), found_at.clone());
            let point = same || distances.is_some_and(|(_, apart)| apart < ONE_POINT);
            say("location point", point, at.clone(), found_at.clone());
            say("location level", level, at, found_at);
            let contact = found.is_some_and(|found| found.contact == body.contact);
            say("contact", contact, text, other);
        }
        HandPlace::Hands(hands) => {
            let found = match &found.place {
                Some(HandPlace::Hands(found)) => Some(found),
                _ => None,
            };
            let contact = found.is_some_and(|found| found.contact == hands.contact);
            say("constellation", contact, text.clone(), other.clone());
            if let Some(at) = &hands.at {
                // A place of the dominant hand alone counts, too.
                let inferred = found_place.as_ref().and_then(bodies);
                let at_found = inferred.as_ref();
                let same = at_found.is_some_and(|found| one_place(found, at));
                let level = at_found.is_some_and(|found| {
                    sites(found)
                        .iter()
                        .any(|site| sites(at).iter().any(|other| site.0 == other.0))
                });
                let (body, mut found_at) = (at, spoken(at_found));
                let at = spoken(Some(body));
                let distances = if same { None } else { off(body, at_found) };
                if let Some((_, apart)) = distances {
                    found_at += &format!("\t[hands, apart {:.1} cm]", 100.0 * apart);
                }
                let point = same || distances.is_some_and(|(_, apart)| apart < ONE_POINT);
                say("location", same, at.clone(), found_at.clone());
                say("location point", point, at.clone(), found_at.clone());
                say("location level", level, at, found_at);
            }
        }
        _ => {}
    }
}

/// Returns a place on the body in words: its sites and how near the hand comes.
fn spoken(place: Option<&BodyPlace>) -> String {
    place.map_or("none".into(), |place| {
        let plain = BodyPlace {
            by: None,
            ..place.clone()
        };
        placed(&HandPlace::Body(plain))
    })
}

/// Returns whether two places are one: half-way from the chest to the right of the shoulders is half-way from the
/// right of the chest to the shoulders.
fn one_place(a: &BodyPlace, b: &BodyPlace) -> bool {
    let split = |place: &BodyPlace| {
        let (mut levels, mut sides): (Vec<_>, Vec<_>) = sites(place).into_iter().unzip();
        if place.second.is_none() || levels.len() == 1 {
            levels.extend(levels.first().cloned());
            sides.extend(sides.first().cloned().filter(|_| sides.len() == 1));
        }
        levels.sort();
        sides.sort();
        (levels, sides)
    };
    split(a) == split(b)
}

fn sites(place: &BodyPlace) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = [place.site, place.second]
        .iter()
        .flatten()
        .map(|site| {
            use chereme_sign::hamnosys::{BodyLocation, LocationSide};
            // A place that exists twice means the own side by default.
            let twice = matches!(site.at, BodyLocation::Cheek | BodyLocation::Ear | BodyLocation::EarLobe);
            let side = site.side.or(twice.then_some(LocationSide::RightAt));
            (format!("{:?}", site.at), format!("{side:?}"))
        })
        .collect();
    all.sort();
    all.dedup();
    all
}

fn placed(place: &HandPlace) -> String {
    match place {
        HandPlace::Body(body) => {
            let names: Vec<String> = [body.site, body.second]
                .iter()
                .flatten()
                .map(|site| format!("{:?} {:?}", site.at, site.side).replace(" None", ""))
                .collect();
            let by = body.by.as_ref().map(|by| format!(" by {:?}{:?}", by.at, by.digits.0));
            format!("{} {:?}{}", names.join("|"), body.contact, by.unwrap_or_default())
        }
        HandPlace::Split(a, b) => {
            let of = |place: &Option<Box<HandPlace>>| place.as_deref().map_or("none".to_owned(), placed);
            format!("{} + {}", of(a), of(b))
        }
        HandPlace::Hands(hands) => {
            let site = |site: &Option<chereme_sign::hamnosys::HandSite>| {
                site.as_ref().map_or("none".to_owned(), |site| {
                    format!("{:?}{:?}{:?}", site.at, site.digits.0, site.side)
                })
            };
            let at = hands.at.as_ref().map(|at| placed(&HandPlace::Body(at.clone())));
            format!(
                "hands {} {} {:?} at {}",
                site(&hands.dominant),
                site(&hands.other),
                hands.contact,
                at.unwrap_or_default()
            )
        }
        HandPlace::Hand(site) => format!("hand {:?}", site.at),
        HandPlace::Named(n) => format!("named {n}"),
    }
}

/// The actions of a hand, one after the other.
#[derive(Debug, Clone, PartialEq, Default)]
struct Done {
    kind: &'static str,
    course: Option<SpatialDirection>,
    size: Option<Option<MotionSize>>,
    repeat: Option<RepeatKind>,
    changes: bool,
    meets: bool,
    manner: MotionManner,
}

fn movement(written: &ManualPart, found: &ManualPart, say: &mut impl FnMut(&'static str, bool, String, String)) {
    let flat = |part: &ManualPart| -> Vec<Done> {
        let mut at = part.posture.place.clone();
        let actions = part.actions.iter();
        actions.flat_map(|action| flat(action, &mut at)).collect()
    };
    let (a, b) = (flat(written), flat(found));
    let text = |all: &[Done]| -> String {
        let one = |done: &Done| {
            let mut words = done.kind.to_owned();
            if let Some(course) = done.course {
                words += &format!(" {course}");
            }
            if let Some(size) = done.size {
                words += &format!(" {size:?}");
            }
            if done.changes {
                words += " +change";
            }
            if done.meets {
                words += " +place";
            }
            if let Some(repeat) = done.repeat {
                words += &format!(" x{repeat:?}");
            }
            words
        };
        all.iter().map(one).collect::<Vec<_>>().join("; ")
    };
    let (ta, tb) = (text(&a), text(&b));
    // There and back again, written out or folded as a repetition, is one thing.
    let kinds = |all: &[Done]| {
        let mut kinds: Vec<&str> = all.iter().map(|done| done.kind).collect();
        kinds.dedup();
        kinds
    };
    let main = |all: &[Done]| all.first().map_or("nothing", |done| done.kind);
    say("movement", main(&a) == main(&b), ta.clone(), tb.clone());
    say("movements", kinds(&a) == kinds(&b), ta.clone(), tb.clone());
    let (Some(x), Some(y)) = (a.first(), b.first()) else {
        return;
    };
    if x.kind == y.kind {
        if x.course.is_some() {
            say("course", x.course == y.course, ta.clone(), tb.clone());
        }
        if x.size.is_some() {
            say("size", x.size == y.size, ta.clone(), tb.clone());
        }
        say("repetition", x.repeat == y.repeat, ta.clone(), tb.clone());
        say("replacement", x.changes == y.changes, ta, tb);
        let tempo = |done: &Done| {
            let speed = done.manner.speed.unwrap_or(1.0);
            let marks = [
                (done.manner.halt, "halt"),
                (done.manner.tense, "tense"),
                (done.manner.fast || speed > 1.25, "fast"),
                (done.manner.slow || speed < 0.8, "slow"),
            ];
            let mark = marks.iter().find(|(is, _)| *is);
            mark.map_or("usual", |(_, word)| word)
        };
        let (a, b) = (tempo(x), tempo(y));
        let words = |tempo: &str, done: &Done| format!("{tempo} {}", done.kind);
        say("manner", a == b, words(a, x), words(b, y));
        if a != "usual" {
            say("manner said", a == b, words(a, x), words(b, y));
        }
        let rests = |done: &Done| if done.manner.rest { "rest" } else { "no rest" };
        say("rest", rests(x) == rests(y), rests(x).into(), rests(y).into());
    }
}

/// Returns the actions of the dominant hand, in order; `at` is its last written place.
fn flat(motion: &NotatedMotion, at: &mut Option<HandPlace>) -> Vec<Done> {
    let mut all = named(motion, at);
    let own = &motion.manner;
    for done in &mut all {
        done.manner.fast |= own.fast;
        done.manner.slow |= own.slow;
        done.manner.tense |= own.tense;
        done.manner.halt |= own.halt;
        let speeds = [done.manner.speed, own.speed];
        done.manner.speed = speeds.into_iter().flatten().reduce(|a, b| a * b);
    }
    if let Some(first) = all.first_mut() {
        first.manner.rest |= own.rest;
    }
    all
}

fn named(motion: &NotatedMotion, at: &mut Option<HandPlace>) -> Vec<Done> {
    let done = |kind: &'static str| Done {
        kind,
        ..Done::default()
    };
    match &motion.kind {
        MotionKind::Directed(directed) => vec![Done {
            kind: match (&directed.curve, &directed.zigzag) {
                (_, Some(_)) => "zigzag",
                (Some(_), None) => "arc",
                (None, None) => "straight",
            },
            course: Some(directed.direction),
            size: Some(directed.size.first),
            ..Done::default()
        }],
        MotionKind::Circular(circular) => vec![Done {
            kind: "circle",
            course: Some(circular.axis),
            size: Some(circular.size.first),
            ..Done::default()
        }],
        MotionKind::Wrist { motion, size } => vec![Done {
            kind: match motion {
                WristMotion::Nodding => "nodding",
                WristMotion::Swinging => "swinging",
                WristMotion::Twisting => "twisting",
                WristMotion::StirCw => "stir cw",
                WristMotion::StirCcw => "stir ccw",
            },
            size: Some(*size),
            ..Done::default()
        }],
        MotionKind::Cross { .. } => vec![done("cross")],
        MotionKind::FingerPlay(_) => vec![done("fingerplay")],
        MotionKind::Still => Vec::new(),
        MotionKind::Body(_) => Vec::new(),
        MotionKind::Split(own, _) => own.as_deref().map(|own| flat(own, at)).unwrap_or_default(),
        MotionKind::Sequence { motions, .. } => motions.iter().flat_map(|motion| flat(motion, at)).collect(),
        MotionKind::Parallel(motions) => {
            let mut all: Vec<Done> = motions.iter().flat_map(|motion| flat(motion, at)).collect();
            let change = all.iter().any(|done| done.changes);
            all.sort_by_key(|done| done.kind == "replacement");
            all.retain({
                let moves = all.iter().any(|done| done.kind != "replacement");
                move |done| !moves || done.kind != "replacement"
            });
            all.truncate(1);
            if let Some(first) = all.first_mut() {
                first.changes |= change;
            }
            all
        }
        MotionKind::Target { motion, posture } => {
            // A change to the place where the hand already is adds no path.
            let place = posture.place.is_some() && posture.place != *at;
            *at = posture.place.clone().or_else(|| at.take());
            let change = !posture.shape.is_unset() || !posture.extended.is_unset() || !posture.palm.is_unset();
            let mut all = motion.as_deref().map(|motion| flat(motion, at)).unwrap_or_default();
            // A hand that waits for the other one does not move.
            let waits = motion.as_deref().is_some_and(|motion| match &motion.kind {
                MotionKind::Split(own, _) => {
                    let own = own.as_deref().map(|own| &own.kind);
                    matches!(own, None | Some(MotionKind::Still))
                }
                _ => false,
            });
            if all.is_empty() && !waits {
                all.push(done(if place { "straight" } else { "replacement" }));
            }
            if let Some(last) = all.last_mut() {
                last.meets |= place;
                last.changes |= change;
            }
            all
        }
        MotionKind::Repeated { motion, repetition } => {
            let mut all = flat(motion, at);
            for done in &mut all {
                done.repeat = Some(repetition.repeat);
            }
            all
        }
    }
}
