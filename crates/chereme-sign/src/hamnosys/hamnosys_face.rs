//! Facial expressions for the non-manuals of SiGML: brows, lids, gaze, nose and mouth.
//!
//! `schema/notation/face.json` defines each code of a tier, and the mouth shapes for the sounds of SAMPA,
//! in which mouth pictures are written.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use chereme_motion::FacePosture;
use chereme_motion::interpolation::smooth_step;
use serde::Deserialize;

/// The facial expression of one non-manual: postures one after another.
#[derive(Debug, Clone, PartialEq)]
pub struct FacialExpression {
    steps: Vec<FacePosture>,
}

impl FacialExpression {
    /// Returns the expression for `code` on a part of the face: `brows`, `lids`, `gaze`, `nose`, `mouth`,
    /// or `mouthing`, whose code is SAMPA. `None` if the part is not on the face, or the code is not
    /// listed.
    ///
    /// ```
    /// use chereme_sign::hamnosys::hamnosys_face::FacialExpression;
    /// let raised = FacialExpression::from_nonmanual_code("brows", "RB").expect("both brows are raised");
    /// assert_eq!(raised.expression_face_at(0.5).brows, [1.0, 1.0]);
    /// ```
    #[must_use]
    pub fn from_nonmanual_code(part: &str, code: &str) -> Option<Self> {
        let table = ExpressionTable::default_expression_table();
        let steps = if part == "mouthing" {
            table.mouths(code)
        } else {
            table.expression_act_faces(table.acts.get(&format!("{part}.{code}"))?)
        };
        (!steps.is_empty()).then_some(Self { steps })
    }

    /// Returns every listed code, such as `brows.RB`, with its meaning.
    pub fn listed_expression_codes() -> impl Iterator<Item = (&'static str, &'static str)> {
        let acts = ExpressionTable::default_expression_table().acts.iter();
        acts.map(|(code, act)| (code.as_str(), act.means.as_str()))
    }

    /// Returns its posture that is farthest from rest.
    #[must_use]
    pub fn fullest_face(&self) -> FacePosture {
        let far = |face: &FacePosture| face.face_numbers().iter().map(|number| number.abs()).sum::<f64>();
        let fullest = self.steps.iter().max_by(|a, b| far(a).total_cmp(&far(b)));
        fullest.copied().unwrap_or_default()
    }

    /// Returns the face at the elapsed `share` of its time, from 0 to 1.
    #[must_use]
    pub fn expression_face_at(&self, share: f64) -> FacePosture {
        let last = self.steps.len() - 1;
        let along = (share * self.steps.len() as f64 - 0.5).clamp(0.0, last as f64);
        let before = (along.floor() as usize).min(last);
        let part = smooth_step(along - before as f64);
        self.steps[before].interpolate_face(&self.steps[(before + 1).min(last)], part)
    }
}

/// The contents of the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ExpressionTable {
    #[serde(rename = "version")]
    _version: u32,
    #[serde(rename = "description")]
    _description: String,
    phones: BTreeMap<String, FacePosture>,
    acts: BTreeMap<String, ExpressionAct>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ExpressionAct {
    means: String,
    #[serde(default)]
    word: String,
    #[serde(default)]
    steps: Vec<FacePosture>,
    #[serde(default = "default_repetition_count")]
    times: usize,
}

fn default_repetition_count() -> usize {
    1
}

impl ExpressionTable {
    fn default_expression_table() -> &'static Self {
        static DEFAULT_EXPRESSION_TABLE: OnceLock<ExpressionTable> = OnceLock::new();
        DEFAULT_EXPRESSION_TABLE.get_or_init(|| {
            let text = chereme_data::schema_text("notation/face.json");
            serde_json::from_str(text).expect("the program's own faces are whole")
        })
    }

    fn expression_act_faces(&self, act: &ExpressionAct) -> Vec<FacePosture> {
        let one = if act.steps.is_empty() {
            self.mouths(&act.word)
        } else {
            act.steps.clone()
        };
        one.repeat(act.times)
    }

    /// Returns the mouth shapes of a text in SAMPA; a length mark holds the previous mouth shape, and
    /// characters that are not sounds are skipped.
    fn mouths(&self, sampa: &str) -> Vec<FacePosture> {
        let mut mouths: Vec<FacePosture> = Vec::new();
        let mut sign = [0; 4];
        for symbol in sampa.chars().take(MAX_SAMPA_CHARS) {
            if symbol == ':' {
                mouths.extend(mouths.last().copied());
            } else if let Some(mouth) = self.phones.get(&*symbol.encode_utf8(&mut sign)) {
                mouths.push(*mouth);
            }
        }
        mouths
    }
}

/// The most characters of SAMPA that are mouthed.
const MAX_SAMPA_CHARS: usize = 400;

#[cfg(test)]
mod tests {
    use super::{ExpressionTable, FacialExpression};
    use crate::hamnosys::NonmanualPart;

    #[test]
    fn every_code_of_the_lists_is_a_face() {
        let two = |letter: char, count: u32| (1..=count).map(move |n| format!("{letter}{n:02}"));
        let mouth: Vec<String> = [('D', 9), ('J', 4), ('L', 35), ('C', 13), ('T', 17)]
            .into_iter()
            .flat_map(|(letter, count)| two(letter, count))
            .collect();
        let words = |text: &str| text.split(' ').map(str::to_owned).collect();
        let lists: [(&str, NonmanualPart, Vec<String>); 5] = [
            ("brows", NonmanualPart::Brows, words("RB RR RL FU")),
            (
                "lids",
                NonmanualPart::Lids,
                words("WB WR WL SB SR SL CB CR CL TB TR TL BB"),
            ),
            (
                "gaze",
                NonmanualPart::Gaze,
                words("AD FR HD HI HC UP DN LE RI NO RO LU LD RU RD"),
            ),
            ("nose", NonmanualPart::Nose, words("WR TW WI")),
            ("mouth", NonmanualPart::MouthGesture, mouth),
        ];
        for (name, part, codes) in lists {
            for code in codes {
                assert!(part.is_listed(&code), "{name}.{code}");
                let face =
                    FacialExpression::from_nonmanual_code(name, &code).unwrap_or_else(|| panic!("{name}.{code}"));
                let moves = (0..=20).any(|n| !face.expression_face_at(f64::from(n) / 20.0).is_at_rest());
                assert_eq!(moves, code != "AD", "{name}.{code}");
            }
        }
        assert!(FacialExpression::from_nonmanual_code("brows", "XX").is_none());
        assert!(FacialExpression::from_nonmanual_code("head", "SH").is_none());
    }

    #[test]
    fn numbers_stay_within_their_ends() {
        let table = ExpressionTable::default_expression_table();
        let acts = table.acts.values().flat_map(|act| &act.steps);
        for face in table.phones.values().chain(acts) {
            let [.., pressed, pout, teeth, tongue, _, _, _] = face.face_numbers();
            assert!(face.face_numbers().iter().all(|n| (-1.0..=1.0).contains(n)));
            let only_up = [face.frown, face.jaw, face.parted, pressed, pout, teeth, tongue];
            assert!(only_up.iter().all(|n| *n >= 0.0), "{face:?}");
        }
        let both = table
            .acts
            .iter()
            .filter(|(_, act)| act.word.is_empty() == act.steps.is_empty());
        assert_eq!(both.count(), 0, "either a word or steps");
    }

    #[test]
    fn a_mouthed_word_opens_and_closes_the_mouth() {
        let word = FacialExpression::from_nonmanual_code("mouthing", "ma:p").expect("a word");
        let open = |share| word.expression_face_at(share).jaw;
        assert_eq!((open(0.0), open(1.0)), (0.0, 0.0), "closed at both ends");
        assert!(open(0.5) > 0.7, "open in the long vowel");
        assert!(word.expression_face_at(1.0).pressed > word.expression_face_at(0.0).pressed);
        assert_eq!(FacialExpression::from_nonmanual_code("mouthing", "?!"), None);
        assert_eq!(FacialExpression::from_nonmanual_code("mouthing", ":"), None);
    }
}
