//! Texts and trees as people write them.

use proptest::array::uniform3;
use proptest::collection::vec;
use proptest::option::of;
use proptest::prelude::*;

use crate::error::RecipeError;
use crate::recipe::*;
use crate::units::{BodyDirection, HandChoice, RecipeDegrees, RecipeFactor, RecipeLength, RecipeSeconds};

#[test]
fn recipes_as_people_write_them_are_parsed_and_printed() {
    for (text, printed) in [
        ("ESCARGOT | configure right U", ""),
        ("ESCARGOT|configure U", "ESCARGOT | configure dominant U"),
        ("BOL | place both by left 25cm", ""),
        ("BOL | place by left 250 mm", "BOL | place both by left 25cm"),
        ("BOL | place both at high-left", ""),
        ("BOL | place left near CHIEN by up 5cm with index using fabrik", ""),
        ("BOL | place right at 30cm,140cm,50cm", ""),
        ("BOL | place right at \"neutral space\"", ""),
        ("BOL | place right at best(placement=chin)", ""),
        ("CLAIR | reverse", ""),
        ("WEEK-END | swap", ""),
        ("WEEK-END | mirror", ""),
        ("WEEK-END | mirror left", ""),
        ("PUNIR | repeat 2", ""),
        (
            "PUNIR | repeat 3 scale 0.8 tempo 120% gap 0.1s via cosine 50ms",
            "PUNIR | repeat 3 scale 0.8 tempo 1.2 gap 0.1s via cosine 0.05s",
        ),
        ("AIMER | reverse | repeat 2", ""),
        (
            "spell LSF | travel right down 20cm then up 20cm",
            "spell LSF dominant | travel right down 20cm then up 20cm",
        ),
        (
            "spell LSF | travel right 20cm",
            "spell LSF dominant | travel dominant right 20cm",
        ),
        (
            "spell LSF | travel left right down 20cm in 0.4s then BOL",
            "spell LSF dominant | travel left right down 20cm in 0.4s then BOL",
        ),
        (
            "spell \"a b\" left with lsf hold 0.3s via slerp on signer:2",
            "spell \"a b\" left with lsf hold 0.3s via slerp on signer:2",
        ),
        ("point right at 30cm,140cm,50cm", ""),
        ("point right at left up with best(configuration=[index]) hold 0.2s", ""),
        ("BOL then ESCARGOT", ""),
        ("BOL then via sigmoid 0.2s ESCARGOT then CHAT", ""),
        ("(BOL then ESCARGOT) | reverse", ""),
        ("BOL then (ESCARGOT | reverse)", "BOL then ESCARGOT | reverse"),
        ("BOL then (A then B)", ""),
        ("(BOL then A) then B", "BOL then A then B"),
        ("CHAT | configure both from LION", ""),
        ("CHAT | place both from LION", "CHAT | place both near LION"),
        ("CHAT | configure right U, _, from LION via 0.1s", ""),
        (
            "CHAT | configure right best(configuration=U (gloss=\"A)\" or signer=same))",
            "",
        ),
        ("DONNER | from me to left", ""),
        ("DONNER | to 10cm,120cm,40cm with right", ""),
        ("A | orient right palm up fingers left forward by 30deg about up", ""),
        ("A | amplify both 1.5 | retime 1.5, to 2s | nonmanual from token:41", ""),
        ("recording:\"NGT Thanks\" | reverse", ""),
        ("A | nonmanual from B by phases", ""),
        ("A | nonmanual wh from B over 0.4s..1.9s by phases | swap", ""),
        ("A | nonmanual from B over ..1.9s", ""),
        ("A | face brows=raised eyes=squint mouth=o over 0.2s..0.9s", ""),
        (
            "A | face head=SH*50% lids=SB | mouth \"bOl\" over ..0.9s",
            "A | face eyes=SB head=SH*50% | face mouthing=bOl over ..0.9s",
        ),
        (
            "A | face mouthing=\"b O l*0.5\" | face from B brows=neutral then B",
            "A | face mouthing=\"b O l*0.5\" | face from B brows=neutral then B",
        ),
        (
            "A | place right at mouth | face gaze=left | mouth bOl then mouth",
            "A | place right at mouth | face gaze=left | face mouthing=bOl then mouth",
        ),
        ("A | on signer:2 | on \"built-in body\" | on built-in", ""),
        (
            "A | nonmanual from B over -500ms,0s,0.4s,1s,1.5s by phases",
            "A | nonmanual from B over -0.5s, 0s, 0.4s, 1s, 1.5s by phases",
        ),
        ("INDEX:1 then \"then\" then \"spell\" then \"a\\\"b\"", ""),
        (
            "ÉCOLE | place both by out 10% in 5cm",
            "ÉCOLE | place both by forward 10% back 5cm",
        ),
    ] {
        let recipe: Recipe = text.parse().unwrap_or_else(|e| panic!("{text}: {e}"));
        let want = if printed.is_empty() { text } else { printed };
        assert_eq!(recipe.to_string(), want);
        let json = serde_json::to_string(&recipe).expect("json");
        assert_eq!(serde_json::from_str::<Recipe>(&json).expect(&json), recipe);
    }
}

#[test]
fn errors_point_at_the_character_and_suggest_a_correction() {
    for (text, at, want) in [
        ("", 0, "the text ends where a sign"),
        ("BOL | palce both by left 25cm", 6, "did you mean \"place\"?"),
        ("ÉÉÉ | revers", 6, "did you mean \"reverse\"?"),
        ("BOL | place both by lefft 25cm", 20, "did you mean \"left\"?"),
        ("BOL | place both by left 25", 25, "no unit"),
        ("BOL | place both by left 25furlongs", 25, "unknown unit \"furlongs\""),
        ("BOL | place both left 25cm", 17, "\"by\", \"at\" or \"near\""),
        ("BOL | place right at 1cm,2cm", 28, "a point has three lengths"),
        ("BOL | repeat twice", 13, "how often"),
        ("BOL reverse", 4, "\"|\", \"then\" or the end"),
        ("BOL then", 8, "a sign"),
        ("reverse", 0, "\"reverse\" stands where a sign"),
        ("(BOL | reverse", 14, "\")\""),
        ("BOL | configure right best(a", 26, "never closed"),
        ("BOL | configure right \"U", 22, "never closed"),
        ("BOL then via sigmod ESCARGOT", 13, "did you mean \"sigmoid\"?"),
        (
            "BOL | place both by left 25cm using fabric",
            36,
            "did you mean \"fabrik\"?",
        ),
        ("BOL | | reverse", 6, "an operator"),
    ] {
        match text.parse::<Recipe>() {
            Err(RecipeError::Text(error)) => {
                assert_eq!(error.at, at, "{text}: {error}");
                assert!(error.to_string().contains(want), "{text}: {error}");
            }
            other => panic!("{text}: {other:?}"),
        }
    }
    for (text, want) in [
        ("BOL | repeat 1000000000", "between 1 and 1000"),
        ("BOL | place both by left 180m", "between -10 and 10"),
        ("BOL | place both by left right 5cm", "cancel out"),
        ("BOL | mirror both", "one arm"),
    ] {
        let error = text.parse::<Recipe>().expect_err(text).to_string();
        assert!(error.contains(want), "{text}: {error}");
    }
    let deep = format!("{}A{}", "(".repeat(5000), ")".repeat(5000));
    assert!(deep.parse::<Recipe>().is_err());
    let long = format!("A{}", " | reverse".repeat(1100));
    assert!(matches!(long.parse::<Recipe>(), Err(RecipeError::Size { .. })));
}

#[test]
fn json_of_another_version_or_with_unknown_fields_is_refused_by_name() {
    for (json, want) in [
        (r#"{"version":2,"make":{"hologram":{}}}"#, "version 2"),
        (r#"{"make":{"sign":"A"}}"#, "needs \"version\""),
        (r#"{"version":1}"#, "needs \"make\""),
        (r#"{"version":1,"make":{"sign":"A"},"note":1}"#, "\"note\""),
        (r#"{"version":1,"make":{"sing":"A"}}"#, "sing"),
        (
            r#"{"version":1,"make":{"pipe":{"of":{"sign":"A"},"steps":[{"repeat":{"times":2,"speed":3}}]}}}"#,
            "speed",
        ),
        (
            r#"{"version":1,"make":{"pipe":{"of":{"sign":"A"},"steps":[{"repeat":{"times":0}}]}}}"#,
            "between 1",
        ),
        (
            r#"{"version":1,"make":{"pipe":{"of":{"sign":"A"},"steps":[{"place":{"to":{"by":[{"towards":["left"],"distance":"25"}]}}}]}}}"#,
            "no unit",
        ),
    ] {
        let error = serde_json::from_str::<Recipe>(json).expect_err(json).to_string();
        assert!(error.contains(want), "{json}: {error}");
    }
}

fn name() -> impl Strategy<Value = String> {
    prop_oneof![
        "[A-Z][A-Z-]{0,6}",
        "[a-z\"\\\\ |,()é:]{1,6}".prop_filter("blank", |s| !s.trim().is_empty()),
        Just("then".to_owned()),
        Just("token:41".to_owned()),
    ]
}

fn hands() -> impl Strategy<Value = HandChoice> {
    proptest::sample::select(HandChoice::ALL_HAND_CHOICES.to_vec())
}

fn length() -> impl Strategy<Value = RecipeLength> {
    prop_oneof![
        (-999i32..999).prop_map(|mm| RecipeLength::Metres(f64::from(mm) / 1000.0)),
        (-99i32..99).prop_map(|percent| RecipeLength::Arm(f64::from(percent) / 100.0)),
    ]
}

fn seconds() -> impl Strategy<Value = RecipeSeconds> {
    (0.0f64..5.0).prop_map(RecipeSeconds)
}

fn factor() -> impl Strategy<Value = RecipeFactor> {
    (0.05f64..20.0).prop_map(RecipeFactor)
}

fn directions() -> impl Strategy<Value = Vec<BodyDirection>> {
    vec(
        proptest::sample::select(BodyDirection::ALL_BODY_DIRECTIONS.to_vec()),
        1..3,
    )
    .prop_filter("cancels", |d| crate::units::mean_of_directions(d).is_some())
}

fn legs(timed: bool) -> impl Strategy<Value = Vec<StraightLeg>> {
    let time = of(seconds()).prop_map(move |time| time.filter(|_| timed));
    let leg = (directions(), length(), time);
    vec(
        leg.prop_map(|(towards, distance, time)| StraightLeg {
            towards,
            distance,
            time,
        }),
        1..3,
    )
}

fn via() -> impl Strategy<Value = PostureTransition> {
    (
        of(proptest::sample::select(
            TransitionProfile::ALL_TRANSITION_PROFILES.to_vec(),
        )),
        of(seconds()),
    )
        .prop_map(|(profile, time)| PostureTransition { profile, time })
}

fn choice() -> impl Strategy<Value = ValueChoice> {
    prop_oneof![
        Just(ValueChoice::Keep),
        name().prop_map(ValueChoice::Value),
        name().prop_map(ValueChoice::From),
        Just(ValueChoice::Best("configuration=U signer=same".into())),
    ]
}

fn spot() -> impl Strategy<Value = SigningSpot> {
    prop_oneof![
        Just(SigningSpot::Me),
        Just(SigningSpot::You),
        directions().prop_map(SigningSpot::Towards),
        name().prop_map(SigningSpot::Value),
        [length(), length(), length()].prop_map(SigningSpot::Point),
    ]
}

fn goal() -> impl Strategy<Value = PlacementGoal> {
    prop_oneof![
        legs(false).prop_map(PlacementGoal::By),
        name().prop_map(PlacementGoal::At),
        [length(), length(), length()].prop_map(PlacementGoal::AtPoint),
        (name(), of(legs(false))).prop_map(|(of, by)| PlacementGoal::Near {
            of,
            by: by.unwrap_or_default()
        }),
        Just(PlacementGoal::Best("placement=chin".into())),
    ]
}

fn step() -> impl Strategy<Value = Step> {
    let one = proptest::sample::select(vec![
        HandChoice::Right,
        HandChoice::Left,
        HandChoice::Dominant,
        HandChoice::Weak,
    ]);
    let solver = any::<bool>().prop_map(|f| {
        if f {
            ArmSolverMethod::Fabrik
        } else {
            ArmSolverMethod::Analytic
        }
    });
    let turn = (
        -180.0f64..180.0,
        proptest::sample::select(BodyDirection::ALL_BODY_DIRECTIONS.to_vec()),
    )
        .prop_map(|(angle, about)| AxisTurn {
            angle: RecipeDegrees(angle),
            about,
        });
    let pace = prop_oneof![
        factor().prop_map(RetimePace::Times),
        (0.01f64..5.0).prop_map(|s| RetimePace::To(RecipeSeconds(s)))
    ];
    prop_oneof![
        (hands(), vec(choice(), 1..3), via()).prop_map(|(hand, values, via)| Step::Configure(ConfigureSettings {
            hand,
            values,
            via
        })),
        (
            hands(),
            goal(),
            of(proptest::sample::select(RecipeHandPoint::ALL_HAND_POINTS.to_vec())),
            solver
        )
            .prop_map(|(hand, to, with, solver)| Step::Place(PlaceSettings { hand, to, with, solver })),
        Just(Step::Reverse),
        Just(Step::Swap),
        one.prop_map(|from| Step::Mirror(MirrorSettings { from })),
        (1u32..1000, of(factor()), of(factor()), of(seconds()), via()).prop_map(|(times, scale, tempo, gap, via)| {
            Step::Repeat(RepeatSettings {
                times,
                scale,
                tempo,
                gap,
                via,
            })
        }),
        (hands(), directions(), of(directions()), vec(turn, 0..3)).prop_map(|(hand, palm, fingers, by)| {
            Step::Orient(OrientSettings {
                hand,
                palm,
                fingers: fingers.unwrap_or_default(),
                by,
            })
        }),
        (hands(), factor()).prop_map(|(hand, by)| Step::Amplify(AmplifySettings { hand, by })),
        (hands(), legs(true), via()).prop_map(|(hand, path, via)| Step::Travel(TravelSettings {
            hand,
            path,
            through: Vec::new(),
            time: None,
            via
        })),
        (hands(), vec(uniform3(length()), 1..5), of(seconds()), via()).prop_map(|(hand, through, time, via)| {
            Step::Travel(TravelSettings {
                hand,
                path: Vec::new(),
                through,
                time,
                via,
            })
        }),
        vec(pace, 1..3).prop_map(|paces| Step::Retime(RetimeSettings { paces })),
        (name(), of(name()), over(), any::<bool>()).prop_map(|(from, function, over, by_phases)| {
            Step::Nonmanual(NonmanualSettings {
                from,
                function,
                over,
                by_phases,
            })
        }),
        (of(name()), shown_parts(), over()).prop_map(|(from, show, over)| {
            let over = match over {
                Some(ExpressionTimes::Part(part)) => part,
                _ => SpanSettings::default(),
            };
            Step::Face(FaceSettings { from, show, over })
        }),
        Just(Step::Trim),
        (of(0.0f64..1.0), 1.1f64..5.0).prop_map(|(from, to)| Step::Span(SpanSettings {
            from: from.map(RecipeSeconds),
            to: Some(RecipeSeconds(to)),
        })),
        (hands(), spot(), of(spot())).prop_map(|(hand, from, to)| {
            Step::Indicate(IndicateSettings {
                hand,
                from: Some(from),
                to,
            })
        }),
    ]
}

fn shown_parts() -> impl Strategy<Value = std::collections::BTreeMap<FacePart, String>> {
    let parts = proptest::sample::select(FacePart::ALL_FACE_PARTS.to_vec());
    let shown = (parts, any::<proptest::sample::Index>(), of(0.0f64..1.0)).prop_map(|(part, at, share)| {
        let values = &part.face_part_inventory().values;
        let value = match values.is_empty() {
            true => "b O:l\"",
            false => &values[at.index(values.len())].id,
        };
        (part, share.map_or(value.to_owned(), |share| format!("{value}*{share}")))
    });
    vec(shown, 1..4).prop_map(|all| all.into_iter().collect())
}

fn over() -> impl Strategy<Value = Option<ExpressionTimes>> {
    let part = (of(0.0f64..1.0), 1.1f64..5.0).prop_map(|(from, to)| {
        ExpressionTimes::Part(SpanSettings {
            from: from.map(RecipeSeconds),
            to: Some(RecipeSeconds(to)),
        })
    });
    let at = (-1.0f64..1.0, [0.0f64..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0]).prop_map(|(m1, gaps)| {
        let mut time = m1;
        let later = gaps.map(|gap| {
            time += gap;
            RecipeSeconds(time)
        });
        let [m2, m3, m4, m5] = later;
        ExpressionTimes::At([RecipeSeconds(m1), m2, m3, m4, m5])
    });
    of(prop_oneof![part, at])
}

fn node() -> impl Strategy<Value = RecipeNode> {
    let leaf = prop_oneof![
        name().prop_map(RecipeNode::Sign),
        (name(), hands(), of(name()), of(seconds()), via(), of(name())).prop_map(
            |(word, hand, alphabet, hold, via, on)| {
                RecipeNode::Spell(SpellSettings {
                    word,
                    hand,
                    alphabet,
                    hold,
                    via,
                    on,
                })
            }
        ),
        (hands(), spot(), of(choice()), of(seconds()), via(), of(name())).prop_map(
            |(hand, at, with, hold, via, on)| RecipeNode::Point(PointSettings {
                hand,
                at,
                with,
                hold,
                via,
                on
            })
        ),
    ];
    leaf.prop_recursive(4, 20, 3, |inner| {
        let joined = (via(), inner.clone()).prop_map(|(via, node)| JoinedPiece { via, node });
        prop_oneof![
            (inner.clone(), vec(step(), 0..3)).prop_map(|(of, steps)| RecipeNode::Pipe(OperatorPipe {
                of: Box::new(of),
                steps
            })),
            (inner, vec(joined, 0..3)).prop_map(|(first, next)| RecipeNode::Then(RecipeChain {
                first: Box::new(first),
                next
            })),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn text_and_json_are_the_same_tree(root in node()) {
        let recipe = Recipe::new(root).expect("in range");
        let text = recipe.to_string();
        let back: Recipe = text.parse().map_err(|e| TestCaseError::fail(format!("{text}: {e}")))?;
        prop_assert_eq!(&back, &recipe, "{}", text);
        let json = serde_json::to_string(&recipe).expect("json");
        prop_assert_eq!(&serde_json::from_str::<Recipe>(&json).expect(&json), &recipe);
    }

    #[test]
    fn no_text_makes_the_reader_panic(text in "[ -~|()\"\\\\é]{0,60}", words in vec("(then|\\||via|place|by|left|25cm|\\(|\\)|best\\(|,|at|from|travel|0.2s)", 0..12)) {
        let _ = text.parse::<Recipe>();
        let _ = words.join(" ").parse::<Recipe>();
    }
}
