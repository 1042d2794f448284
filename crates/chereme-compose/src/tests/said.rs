//! Golden tables of texts: printed recipes, errors of recipes that cannot be read, and units of numbers.

use chereme_motion::glam::DVec3;
use chereme_sign::SignerHandedness;

use super::goldens::list;
use crate::golden::{compare, put};
use crate::simplify::tests::simplified_recipe;
use crate::units::{BodyDirection, HandChoice, RecipeLength, mean_of_directions};
use crate::{MeasuredSpline, Recipe};

/// Recipes of every kind; some of them are wrong.
const TEXTS: [&str; 78] = [
    "ESCARGOT",
    "token:41 | reverse",
    "sign:LIMACE|configure U",
    "BOL | place by left 250 mm",
    "BOL | place both at high-left",
    "BOL | place left near CHIEN by up 5cm with index using fabrik",
    "BOL | place left from CHIEN",
    "BOL | place right at 30cm,140cm,50cm via sigmoid 0.2s",
    "BOL | place right at best(placement=chin)",
    "PUNIR | repeat 3 scale 0.8 tempo 120% gap 0.1s via cosine 50ms",
    "spell \"a b\" left with lsf hold 0.3s via slerp on signer:2",
    "point right at left up with best(configuration=[index]) hold 0.2s",
    "A | amplify right 150%",
    "A | amplify both 1.5",
    "A | from me to left then B",
    "A | from left 20cm to up",
    "A | retime 1, 50%, to 0.3s",
    "A | retime to 2s",
    "A | span 0.4s..1.9s | trim",
    "A | span ..0.5s",
    "A | span 1s..",
    "A then (B then via sigmoid 0.3s C) then D",
    "(A then B) | reverse",
    "A | orient right palm up fingers forward left",
    "A | orient by -30deg about up",
    "A | orient left by 10deg about left by 5deg about up via learned",
    "A | travel right down 20cm then up 10% then left 2in in 0.4s",
    "A | travel both through 10cm,8cm,0cm then 20cm,0cm,0cm in 1s",
    "A | nonmanual from B",
    "A | nonmanual from B by phases",
    "A | swap | mirror left | swap | swap",
    "A | configure right U, _, V via minimum-jerk 0.3s",
    "A | configure both from LION",
    "A | configure right best(configuration=U signer=same)",
    "cue \"le chat dort\" by attina pace 1.6 on signer:1",
    "cue \"l=87 @=131\" as sampa",
    "hamnosys \"hamflathand hamextfingeru hampalmd\" with default on signer:1",
    "sigml HUIS with quiet",
    "A | reverse | reverse",
    "A | place right by up 5cm | place right by up 7cm",
    "A | place right by up 5cm down 5cm",
    "A | retime 50% | retime 2",
    "A | repeat 1",
    "\"two words\" | reverse",
    // Wrong ones.
    "",
    "|",
    "A |",
    "A | fly",
    "A | place",
    "A | place right",
    "A | place right by",
    "A | place right by up",
    "A | place right by up 5",
    "A | place right by up 5km",
    "A | place right by up 5,5cm",
    "A | place nowhere at chin",
    "A | repeat",
    "A | repeat 0",
    "A | repeat 2.5",
    "A | repeat 3000",
    "A | repeat 2 scale -1",
    "A | repeat 2 gap 1h",
    "A | retime",
    "A | retime 0",
    "A | retime to -2s",
    "A | span 2s..1s",
    "A | configure",
    "A | configure right U via warp",
    "A | configure right U via sigmoid 99s",
    "A | orient",
    "A | orient right palm left right",
    "A | travel right",
    "A | amplify right 1000",
    "A then",
    "A then via B",
    "(A",
    "A)",
    "spell",
];

#[test]
fn golden_texts_of_recipes() {
    let mut out = String::new();
    for text in TEXTS {
        put(&mut out, format!("## {text}"));
        match text.parse::<Recipe>() {
            Ok(recipe) => {
                put(&mut out, format!("prints {recipe}"));
                put(&mut out, format!("simply {}", simplified_recipe(&recipe)));
                let json = serde_json::to_string(&recipe).expect("JSON");
                put(&mut out, format!("json {json}"));
                let back: Recipe = serde_json::from_str(&json).expect("a recipe");
                assert_eq!(back, recipe);
            }
            Err(error) => put(&mut out, format!("refused {error:?}\n  {error}")),
        }
    }
    put(&mut out, "## other JSON");
    for json in [
        "{}",
        "{\"version\": 2, \"recipe\": {}}",
        "{\"version\": 1, \"source\": \"A\"}",
        "{\"version\": 1, \"steps\": []}",
        "[1, 2]",
    ] {
        let read = serde_json::from_str::<Recipe>(json).map_err(|it| it.to_string());
        put(&mut out, format!("{json}: {read:?}"));
    }
    compare("texts", &out);
}

#[test]
fn golden_units_directions_and_curves() {
    let mut out = String::new();
    put(&mut out, "## lengths");
    for text in [
        "25cm", "250mm", "0.25m", "10in", "40%", "-3cm", "0cm", "5", "5 cm", "1e3mm", "cm", "7ft", "nan cm", "99999km",
    ] {
        let length: Result<RecipeLength, _> = text.parse();
        let said = length
            .as_ref()
            .map(|it| (it.to_string(), it.length_in_metres(0.6), it.is_zero()));
        put(&mut out, format!("{text}: {:?}", said.map_err(|it| it.to_string())));
    }
    put(&mut out, "## directions");
    for a in BodyDirection::ALL_BODY_DIRECTIONS {
        for b in BodyDirection::ALL_BODY_DIRECTIONS {
            let middle = mean_of_directions(&[a, b]).map(|it| list(it.to_array()));
            put(
                &mut out,
                format!("{} {}: {middle:?}", a.body_direction_name(), b.body_direction_name()),
            );
        }
        put(
            &mut out,
            format!("{:?}", BodyDirection::from_word(a.body_direction_name())),
        );
    }
    for hands in HandChoice::ALL_HAND_CHOICES {
        let sides = [SignerHandedness::Right, SignerHandedness::Left].map(|it| hands.chosen_sides(it));
        put(
            &mut out,
            format!(
                "{} {sides:?} {:?}",
                hands.hand_choice_name(),
                HandChoice::from_word(hands.hand_choice_name())
            ),
        );
    }
    put(&mut out, "## curves");
    let courses: [&[[f64; 3]]; 5] = [
        &[[0.0, 0.0, 0.0], [0.1, 0.08, 0.0], [0.2, 0.0, 0.0]],
        &[[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.2, 0.001, 0.0]],
        &[[0.0, 0.0, 0.0], [0.1, 0.1, 0.02], [0.2, -0.1, 0.0], [0.3, 0.0, 0.05]],
        &[
            [0.1, 0.0, 0.0],
            [0.0, 0.1, 0.01],
            [-0.1, 0.0, 0.0],
            [0.0, -0.1, 0.0],
            [0.09, 0.0, 0.0],
        ],
        &[[0.0, 0.0, 0.0], [0.0, 0.0, 0.3]],
    ];
    for course in courses {
        let points: Vec<DVec3> = course.iter().copied().map(DVec3::from).collect();
        let spline = MeasuredSpline::new(&points);
        put(
            &mut out,
            format!(
                "{course:?}: length {:?} {}",
                spline.spline_length(),
                spline.spline_shape_name()
            ),
        );
        for share in [-0.1, 0.0, 0.13, 0.5, 0.77, 1.0, 1.2] {
            put(
                &mut out,
                format!(
                    "  {share}: {}",
                    list((spline.spline_point_at(share) * 1000.0).to_array())
                ),
            );
        }
    }
    compare("units_curves", &out);
}
