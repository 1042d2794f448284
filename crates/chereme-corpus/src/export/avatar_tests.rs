//! Tests of VRMA from a corpus: faces by the names of VRM, and as curves again.

use super::tests::{Place, address, export};

#[test]
fn an_avatar_blinks_looks_and_speaks_by_the_names_of_vrm() {
    let mut place = Place::new();
    let face = |tier: &str, act: &str| {
        format!(
            "<sigml><hamgestural_sign gloss=\"X\"><sign_nonmanual><{tier}>{act}</{tier}></sign_nonmanual>\
             <sign_manual><handconfig handshape=\"fist\" extfidir=\"uo\" palmor=\"l\"/>\
             <directedmotion direction=\"o\"/></sign_manual></hamgestural_sign></sigml>"
        )
    };
    for (at, (tier, act, shown, note)) in [
        ("facialexpr_tier", "<eye_lids movement=\"CB\"/>", "blink", ""),
        ("eyegaze_tier", "<eye_gaze direction=\"LE\"/>", "gaze_left_degrees", ""),
        ("mouthing_tier", "<mouth_picture picture=\"a\"/>", "aa", ""),
        (
            "facialexpr_tier",
            "<eye_brows movement=\"RB\"/>",
            "brows.RB",
            "by name: brows.RB",
        ),
    ]
    .into_iter()
    .enumerate()
    {
        let [sigml, to] = ["sigml", "vrma"].map(|it| place.path(&format!("{at}.{it}")));
        std::fs::write(&sigml, face(tier, act)).expect("written");
        let mut corpus = place.corpus(&[]);
        let staging = crate::NotationStaging {
            language: Some("quiet"),
            ..crate::NotationStaging::default()
        };
        let sigml = sigml.display().to_string();
        let made = corpus.animate_notation(&[&sigml], &staging, Some("X"));
        made.expect("a sign");
        let report = export(&corpus, &address("X"), &to).expect("a VRMA");
        assert_eq!(report.notes.is_empty(), note.is_empty(), "{:?}", report.notes);
        assert!(report.notes.concat().ends_with(note), "{:?}", report.notes);
        let bytes = std::fs::read(&to).expect("read");
        let (scene, _) = chereme_formats::gltf::read_gltf(&bytes, &|_| None).expect("a VRMA");
        assert_eq!(scene.take.as_deref(), Some("X"), "the gloss");
        let curves = scene.morphs.expect("a face");
        let curve = curves.track_curves().iter().find(|it| it.name == shown);
        let values = curve.expect("the expression").values.column_values().flatten();
        assert!(values.fold(0.0, f64::max) > 0.2, "{shown}");
        // Curves beside a skeleton come back as a table, even if they are no face that the program knows.
        let again = place.corpus(std::slice::from_ref(&to));
        let table = place.path(&format!("{at}.curves.csv"));
        export(&again, &address("recording:1"), &table).expect("curves");
        let text = std::fs::read_to_string(table).expect("text");
        assert!(text.contains(shown), "{shown}: {text}");
    }
}

#[test]
fn an_animation_has_the_name_of_the_sign_or_of_the_recording() {
    let own = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    let mut place = Place::new();
    let corpus = place.corpus(&[own.join("bol.bvh"), own.join("bol.eaf")]);
    for (what, name) in [("BOL", "BOL"), ("token:1", "BOL"), ("recording:1", "bol")] {
        for ending in ["glb", "vrma"] {
            let to = place.path(&format!("{}.{ending}", what.replace(':', "_")));
            export(&corpus, &address(what), &to).expect("written");
            let bytes = std::fs::read(&to).expect("read");
            let (scene, _) = chereme_formats::gltf::read_gltf(&bytes, &|_| None).expect("a scene");
            assert_eq!(scene.take.as_deref(), Some(name), "{what} {ending}");
        }
    }
}
