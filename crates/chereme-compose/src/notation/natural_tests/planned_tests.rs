//! Tests that plans follow the notation: paths, times, contacts, skin, and the acts of head, trunk and face.

use super::super::notation_plan;
use super::*;

/// Returns the plan of a sign of a right hand without strain before the chest, given by the names of its movements' symbols.
fn planned(body: &StandingBody, place: &str, movements: &str) -> notation_plan::SignPlan {
    let names = format!("hamflathand hamextfingeruo hampalmdl {place} {movements}");
    let symbol_text = chereme_sign::hamnosys::from_names(names.split_whitespace());
    let text = symbol_text.unwrap_or_else(|error| panic!("{movements}: {error}"));
    let read = chereme_sign::hamnosys::parse_hamnosys(&text);
    let sign = NotatedSign {
        gloss: "SIGN".into(),
        sign: read.unwrap_or_else(|error| panic!("{movements}: {error}")).sign,
        ..NotatedSign::default()
    };
    let paces = pace::PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
    let language = BodyLanguage::default_body_language();
    SignPlanner::new(body, language, &paces, SignerHandedness::Right, 60.0).plan_signs(&[&sign])
}

/// Returns the strokes of the right hand.
fn right_hand_strokes(plan: &notation_plan::SignPlan) -> Vec<&HandPhase> {
    let plan_phases = plan.phases.iter();
    plan_phases
        .filter(|phase| phase.hand == 0 && phase.kind == PhaseKind::Stroke)
        .collect()
}

/// Returns the displacement of the right hand within a stroke after a share of its length.
fn displaced(plan: &notation_plan::SignPlan, stroke: &HandPhase, share: f64) -> DVec3 {
    let events = plan.events[0].iter();
    let within = events
        .filter(|event| event.from >= stroke.from - 1e-9 && event.to <= stroke.to + 1e-9)
        .filter_map(|event| match &event.act {
            notation_plan::HandAct::Move(path) => Some(path.path_point_at(share)),
            _ => None,
        });
    within.sum()
}

#[test]
fn strokes_have_the_written_direction_size_and_shape() {
    let material = stage(Axes::Odd);
    let body = StandingBody::body_from_material(&material).expect("a body");
    let l = BodyLanguage::default_body_language();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let (left, up, out) = (DVec3::X, DVec3::Y, DVec3::Z);
    let straight = |to: DVec3, size: f64| [to * size / 4.0, to * size / 2.0, to * size];
    let bowed = |to: DVec3, size: f64, bow: DVec3, deep: f64| {
        // A circle through both ends and the middle of the arc.
        let half_chord = 0.5 * size;
        let deep = deep * size;
        let radius = (half_chord * half_chord + deep * deep) / (2.0 * deep);
        let angle = (half_chord / radius).asin() / 2.0;
        let quarter = to * (half_chord - radius * angle.sin()) + bow * (radius * angle.cos() - (radius - deep));
        [quarter, to * half_chord + bow * deep, to * size]
    };
    // A circle begins above and goes round by the right-hand rule about its written axis.
    let round = |quarter: DVec3, size: f64| [(quarter - up) * size, up * (-2.0 * size), DVec3::ZERO];
    let cases = [
        ("hammovel", straight(left, l.move_normal)),
        ("hammoveu hamlargemod", straight(up, l.move_big)),
        ("hammoveo hamsmallmod", straight(out, l.move_small)),
        ("hammovedr", straight((-left - up) * half, l.move_normal)),
        ("hammovel hamarcu", bowed(left, l.move_normal, up, l.arc_normal)),
        (
            "hammovel hamarcu hamlargemod",
            bowed(left, l.move_normal, up, l.arc_big),
        ),
        (
            "hammoveo hamsmallmod hamarcl",
            bowed(out, l.move_small, left, l.arc_normal),
        ),
        ("hamcircleo", round(-left, l.circle_normal)),
        ("hamcircleo hamlargemod", round(-left, l.circle_big)),
        (
            "hamcircleo hamellipsev",
            round(-left * l.ellipse_normal, l.circle_normal),
        ),
    ];
    for (movement, expected) in cases {
        let plan = planned(&body, "hamchest", movement);
        let strokes = right_hand_strokes(&plan);
        assert_eq!(strokes.len(), 1, "{movement}");
        for (share, expected) in [0.25, 0.5, 1.0].into_iter().zip(expected) {
            let is = displaced(&plan, strokes[0], share) / body.arm;
            assert!(
                is.distance(expected) < 1e-6,
                "{movement} at {share}: {is}, not {expected}"
            );
        }
    }
}

#[test]
fn strokes_last_as_long_as_their_length_tempo_and_repetition_require() {
    let material = stage(Axes::Plain);
    let body = StandingBody::body_from_material(&material).expect("a body");
    let l = BodyLanguage::default_body_language();
    let least = |length: f64| 2.6 * length / l.speed_most;
    let line = l.time_straight.max(least(l.move_normal));
    let cases = [
        ("hammovel", vec![line]),
        (
            "hammovel hamfast",
            vec![(l.time_straight * l.manner_fast).max(least(l.move_normal))],
        ),
        (
            "hammovel hamslow",
            vec![(l.time_straight * l.manner_slow).max(least(l.move_normal))],
        ),
        ("hammovel hammoveu", vec![line, line]),
        ("hamnomotion", vec![]),
        ("hamnodding", vec![l.time_wrist * l.wrist_cycles]),
        ("hamfingerplay", vec![l.time_play * l.play_cycles]),
    ];
    for (movement, lengths) in cases {
        let plan = planned(&body, "hamchest", movement);
        let strokes = right_hand_strokes(&plan);
        assert_eq!(strokes.len(), lengths.len(), "{movement}");
        let mut now = plan.signs[0].from;
        for (stroke, length) in strokes.iter().zip(lengths) {
            assert!((stroke.from - now).abs() < 1e-9, "{movement}: no gap");
            now = stroke.to;
            let is = stroke.to - stroke.from;
            assert!((is - length).abs() < 1e-9, "{movement}: {is} s, not {length}");
        }
    }
}

#[test]
fn a_place_that_is_brushed_is_touched_in_the_middle_of_the_path() {
    let material = stage(Axes::Plain);
    let body = StandingBody::body_from_material(&material).expect("a body");
    let place = "hamchest hamtouch";
    let brush = "hamseqbegin hambrushing hamchest hamseqend";
    let plan = planned(&body, place, &format!("hammovel {brush}"));
    let strokes = right_hand_strokes(&plan);
    let stroke = strokes.last().expect("a stroke");
    let touched = plan.contacts[0].last().expect("a contact").0;
    let middle = (stroke.from + stroke.to) / 2.0;
    assert!((touched - middle).abs() < 1e-9, "{touched}, not {middle}");
    assert!(plan.arrivals[0].contains(&(stroke.from, touched)));
}

#[test]
fn the_skin_limits_hands_in_front_of_it_and_not_hands_behind_the_body() {
    let material = stage(Axes::Plain);
    let body = StandingBody::body_from_material(&material).expect("a body");
    let paces = pace::PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
    let language = BodyLanguage::default_body_language();
    let mut planner = SignPlanner::new(&body, language, &paces, SignerHandedness::Right, 60.0);
    let who = planner.signer.own_frame();
    let touch = at(BodyLocation::Chest, Some(PlaceContact::Touch));
    planner.assume_posture(&flat_hand_posture(Some(touch)), [Some(who), None], false);
    let place = planner.at_body[0].clone().expect("a place at the body");
    let mut skin = |contact, behind| {
        planner.at_body[0] = Some(chereme_sign::hamnosys::BodyPlace {
            contact,
            behind,
            ..place.clone()
        });
        planner.skin_normal_at_hand(0, who)
    };
    let before = skin(Some(PlaceContact::Touch), false).expect("skin before the chest");
    assert!(before.z > 0.8, "{before}");
    assert_eq!(skin(Some(PlaceContact::Touch), true), None);
    assert_eq!(skin(Some(PlaceContact::Close), false), None);
    assert_eq!(skin(None, false), None);
}

#[test]
fn each_phase_names_the_sign_to_which_it_leads_or_belongs() {
    let glossed_signs = ["FIRST", "SECOND"].map(|gloss| NotatedSign {
        gloss: gloss.into(),
        ..notated(
            HandsUsed::Dominant,
            flat_hand_posture(Some(at(BodyLocation::Chest, None))),
            vec![directed("l")],
        )
    });
    let signs: Vec<&NotatedSign> = glossed_signs.iter().collect();
    let made = animate_signs(&signs, &stage(Axes::Plain), &AnimatorSettings::default()).expect("made");
    let named = |about: &NoteSubject| {
        let notes = made.notes.iter();
        let hand_notes = notes.filter(move |note| note.about == *about && note.hand == Some(BodySide::Right));
        hand_notes
            .map(|note| note.origin.split([' ', ':']).nth(2).unwrap_or(""))
            .collect::<Vec<_>>()
    };
    assert_eq!(named(&NoteSubject::Transition)[..2], ["FIRST", "SECOND"]);
    let phase = NoteSubject::Component(chereme_sign::SignComponent::Movement, Some("phase".into()));
    assert_eq!(named(&phase), ["FIRST", "FIRST", "SECOND", "SECOND"]);
}

#[test]
fn non_manuals_rise_and_fall_with_the_times_of_their_tier() {
    use chereme_sign::hamnosys::{TierEnd, TierStart};
    let l = BodyLanguage::default_body_language();
    let span = notation_plan::SignSpan {
        gloss: "SIGN".into(),
        from: 1.0,
        to: 3.0,
    };
    let part = NonmanualPart::Brows;
    let sign = |acts: Vec<Vec<NonmanualAct>>| {
        let mut sign = notated(HandsUsed::Dominant, flat_hand_posture(None), vec![]);
        for group in acts {
            sign.nonmanual.push_act_group(part.sigml_tier(), group);
        }
        sign
    };
    let value = |sign: &NotatedSign, tag: &str, time: f64| {
        let spans = std::slice::from_ref(&span);
        let curves = notation_nonmanual::nonmanual_curves(&[sign], spans, l, 1000.0, 6000);
        let curve = curves.iter().find(|curve| curve.name == format!("brows.{tag}"));
        curve.expect("a curve").values[(time * 1000.0).round() as usize]
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-3;
    let (attack, release) = (l.time_attack, l.time_release);
    let mut raised = sign(vec![vec![NonmanualAct::new(part, "RB")]]);
    for (start, end, from, to) in [
        (None, None, 1.0, 3.0),
        (Some(TierStart::SlightDelay), None, 1.12, 3.0),
        (Some(TierStart::StartSlightlyAhead), None, 0.88, 3.0),
        (None, Some(TierEnd::LastsLonger), 1.0, 3.12),
        (None, Some(TierEnd::EndsBefore), 1.0, 2.88),
    ] {
        let tier = raised.nonmanual.tiers.get_mut(&part.sigml_tier()).expect("a tier");
        (tier.start, tier.end) = (start, end);
        for (time, much) in [
            (from - attack, 0.0),
            (from - 0.75 * attack, 0.15625),
            (from - 0.5 * attack, 0.5),
            (from, 1.0),
            (2.0, 1.0),
            (to, 1.0),
            (to + 0.5 * release, 0.5),
            (to + release, 0.0),
        ] {
            let is = value(&raised, "RB", time);
            assert!((is - much).abs() < 0.01, "{start:?} {end:?} at {time}: {is}");
        }
    }
    // Acts that follow one another share the time; simultaneous ones have all of it.
    let acts = vec![
        vec![NonmanualAct::new(part, "RB"), NonmanualAct::new(part, "RR")],
        vec![NonmanualAct::new(part, "FU")],
    ];
    let two = sign(acts);
    for (tag, middle, off) in [("RB", 1.5, 2.0), ("RR", 1.5, 2.0), ("FU", 2.5, 2.0)] {
        assert!(near(value(&two, tag, middle), 1.0), "{tag}");
        assert!(near(value(&two, tag, off), 1.0), "{tag}");
        let beyond = if tag == "FU" { off - attack } else { off + release };
        assert!(near(value(&two, tag, beyond), 0.0), "{tag}");
    }
    let mut weak = NonmanualAct::new(part, "RB");
    (weak.amount, weak.speed) = (Some(0.4), Some(2.0));
    let weak = sign(vec![vec![weak]]);
    assert!(near(value(&weak, "RB", 2.0), 0.4));
    assert!((value(&weak, "RB", 1.0 - 0.25 * attack) - 0.2).abs() < 0.01);
}

#[test]
fn acts_of_head_and_trunk_turn_to_the_side_that_they_name() {
    let l = BodyLanguage::default_body_language();
    let span = notation_plan::SignSpan {
        gloss: "SIGN".into(),
        from: 1.0,
        to: 3.0,
    };
    let (left, up, out) = (DVec3::X, DVec3::Y, DVec3::Z);
    let bent = |part: NonmanualPart, tag: &str, time: f64| {
        let mut sign = notated(HandsUsed::Dominant, flat_hand_posture(None), vec![]);
        sign.nonmanual
            .push_act_group(part.sigml_tier(), vec![NonmanualAct::new(part, tag)]);
        let spans = std::slice::from_ref(&span);
        let (bents, busy) = notation_nonmanual::written_body_bends(&[&sign], spans, l, 100.0, 500);
        let n = (time * 100.0).round() as usize;
        (bents[n], busy[n])
    };
    // Where the face, or the top of the trunk, goes.
    for (part, tag, of, to) in [
        (NonmanualPart::Head, "SR", out, -left),
        (NonmanualPart::Head, "SL", out, left),
        (NonmanualPart::Head, "TR", up, -left),
        (NonmanualPart::Head, "TL", up, left),
        (NonmanualPart::Head, "NF", up, out),
        (NonmanualPart::Head, "NB", up, -out),
        (NonmanualPart::Body, "RL", out, left),
        (NonmanualPart::Body, "RR", out, -left),
        (NonmanualPart::Body, "TL", up, left),
        (NonmanualPart::Body, "TR", up, -left),
        (NonmanualPart::Body, "TF", up, out),
        (NonmanualPart::Body, "TB", up, -out),
    ] {
        let (bent, busy) = bent(part, tag, 2.0);
        let (turned, other) = match part {
            NonmanualPart::Head => (bent.head, bent.trunk),
            _ => (bent.trunk, bent.head),
        };
        let moved = DQuat::from_scaled_axis(turned) * of - of;
        assert!(moved.dot(to) > 0.1, "{part:?} {tag}: {moved}");
        assert!(turned.length() < 0.6 && other == DVec3::ZERO, "{part:?} {tag}");
        let wanted = [part == NonmanualPart::Head, part == NonmanualPart::Body];
        assert_eq!([busy.head, busy.trunk], wanted.map(f64::from), "{tag}");
    }
    // A head that is pushed forward keeps looking ahead.
    for (tag, to) in [("PF", out), ("PB", -out)] {
        let (bent, _) = bent(NonmanualPart::Head, tag, 2.0);
        let moved = DQuat::from_scaled_axis(bent.neck) * up - up;
        assert!(moved.dot(to) > 0.1 && bent.head == -bent.neck, "{tag}");
    }
    // Two nods or shakes a second: the first swing goes down, or to the left, the second one back.
    for (tag, of, to) in [("NO", out, -up), ("SH", out, left)] {
        for (time, sign) in [(1.125, 1.0), (1.375, -1.0), (1.625, 1.0), (2.875, -1.0)] {
            let (bent, _) = bent(NonmanualPart::Head, tag, time);
            let moved = DQuat::from_scaled_axis(bent.head) * of - of;
            assert!(moved.dot(to) * sign > 0.1, "{tag} at {time}: {moved}");
        }
        let (bent, _) = bent(NonmanualPart::Head, tag, 2.0);
        assert!(bent.head.length() < 1e-9, "{tag}");
    }
    // A single nod goes one way and comes back, and then the head rests.
    for (tag, to) in [("ND", -up), ("NU", up)] {
        for (time, moves) in [(1.15, true), (1.31, true), (1.5, true), (2.0, false)] {
            let (bent, _) = bent(NonmanualPart::Head, tag, time);
            let moved = DQuat::from_scaled_axis(bent.head) * out - out;
            assert_eq!(moved.dot(to) > 0.1, moves, "{tag} at {time}: {moved}");
            assert!(moved.dot(to) > -1e-9, "{tag} at {time}: {moved}");
        }
    }
}
