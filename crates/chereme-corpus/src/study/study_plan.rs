//! The plan of a perceptual study: its trials, questions, order and hypotheses.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// A text by language, `en` and `fr`.
pub type LocalizedTexts = BTreeMap<String, String>;

/// The `format` of every plan.
pub const PLAN_FORMAT: &str = "chereme-study";

/// The version of plans that this program writes and reads.
pub const PLAN_VERSION: u32 = 1;

/// The plan of a study; its JSON is what `study show --json` prints and `study new --plan` reads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyPlan {
    /// [`PLAN_FORMAT`].
    pub format: String,
    /// [`PLAN_VERSION`].
    pub version: u32,
    /// The name of the study in its corpus.
    pub name: String,
    /// Its title.
    #[serde(default)]
    pub title: LocalizedTexts,
    /// The text that participants read before they agree.
    #[serde(default)]
    pub consent: ConsentText,
    /// The trials, in the order of the plan; participants see the main ones in an order of their own.
    pub trials: Vec<StudyTrial>,
    /// The questions of each trial, in their order.
    pub questions: Vec<StudyQuestion>,
    /// The questions about the participant.
    #[serde(default)]
    pub profile: Vec<ProfileQuestion>,
    /// The order of trials.
    #[serde(default)]
    pub design: TrialDesign,
    /// The participants whose answers are analysed; all without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub analysed: Option<ParticipantFilter>,
    /// The hypotheses, written before the first answer.
    #[serde(default)]
    pub hypotheses: Vec<StudyHypothesis>,
    /// The rules by which participants are left out, written before the first answer.
    #[serde(default)]
    pub exclusions: Vec<ExclusionRule>,
}

/// The text that participants read before they agree.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ConsentText {
    /// Who asks, and to what end.
    pub purpose: LocalizedTexts,
    /// How to reach them, by text and in sign language.
    pub contact: LocalizedTexts,
    /// How long answers are kept.
    pub kept: LocalizedTexts,
}

/// One film with its questions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyTrial {
    /// The sign or sentence that is shown, such as a gloss; the same in all conditions.
    pub item: String,
    /// How it was made, such as `captured`.
    pub condition: String,
    /// The address or recipe of the movement, as text.
    pub clip: String,
    /// The use of its answers.
    #[serde(default, skip_serializing_if = "is_main")]
    pub role: TrialRole,
    /// The part of the study that the trial belongs to; parts follow each other in the order of the plan.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub part: String,
    /// The right option of a question, by the question's name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub right: BTreeMap<String, String>,
    /// Numbers of the film, such as its distance from a reference, for hypotheses about a correlation; a stored plan has
    /// twelve digits of them.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub measures: BTreeMap<String, f64>,
}

/// The use of the answers of a trial.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TrialRole {
    /// The trial explains the task; its answers are never analysed.
    Training,
    /// The trial is analysed.
    #[default]
    Main,
    /// The trial shows whether the participant attends; only its right and wrong answers count.
    Check,
}

impl TrialRole {
    /// Every role with its name.
    const TRIAL_ROLE_NAMES: [(Self, &str); 3] = [
        (Self::Training, "training"),
        (Self::Main, "main"),
        (Self::Check, "check"),
    ];

    /// Returns its name in files.
    #[must_use]
    pub fn trial_role_name(self) -> &'static str {
        let named_role = Self::TRIAL_ROLE_NAMES.iter().find(|pair| pair.0 == self);
        named_role.map_or("main", |pair| pair.1)
    }

    /// Returns the role of that name.
    #[must_use]
    pub fn trial_role_named(name: &str) -> Option<Self> {
        let named_role = Self::TRIAL_ROLE_NAMES.iter().find(|pair| pair.1 == name);
        named_role.map(|pair| pair.0)
    }
}

fn is_main(role: &TrialRole) -> bool {
    *role == TrialRole::Main
}

/// A question about a film.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyQuestion {
    /// Its name in answers and reports, such as `realism`.
    pub name: String,
    /// The text that participants read.
    #[serde(default)]
    pub text: LocalizedTexts,
    /// The possible answers.
    pub kind: QuestionKind,
    /// The viewing after which it is asked.
    #[serde(default, skip_serializing_if = "is_first")]
    pub after: QuestionViewing,
    /// The parts of the study in which it is asked; all if empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<String>,
    /// Whether `I cannot say` is an answer.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub cannot_say: bool,
}

/// The possible answers to a question.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum QuestionKind {
    /// Whole numbers from `low` to `high`.
    Scale {
        /// The lowest answer.
        low: i64,
        /// The highest answer, at most nine above the lowest.
        high: i64,
        /// The words at a number; usually the ends and the middle have some.
        #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
        labels: BTreeMap<i64, LocalizedTexts>,
    },
    /// One of several options.
    Choice {
        /// The options, in the order in which they are shown.
        options: Vec<ChoiceOption>,
    },
}

/// An option of a choice.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChoiceOption {
    /// Its name in answers and reports.
    pub name: String,
    /// The text that participants read; without it, its name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub text: LocalizedTexts,
    /// A picture in the folder `media`, shown above the text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
}

/// The viewing after which a question is asked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum QuestionViewing {
    /// When the film was seen once.
    #[default]
    First,
    /// When it was seen a second time, after the questions of the first.
    Second,
}

fn is_first(after: &QuestionViewing) -> bool {
    *after == QuestionViewing::First
}

/// A question about the participant; each may be left unanswered.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProfileQuestion {
    /// Its name in answers and reports, such as `level`.
    pub name: String,
    /// The text that participants read.
    #[serde(default)]
    pub text: LocalizedTexts,
    /// The options, in their order: of a level, from the lowest.
    pub options: Vec<ChoiceOption>,
}

/// How trials are put in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TrialDesign {
    /// The order of conditions.
    pub order: ConditionOrder,
    /// The seed of every shuffle.
    pub seed: u64,
    /// How often each main trial is shown, each time in another block.
    pub blocks: u32,
    /// Whether each participant sees an item in one condition only.
    pub between: bool,
}

impl Default for TrialDesign {
    fn default() -> Self {
        Self {
            order: ConditionOrder::default(),
            seed: 1,
            blocks: 1,
            between: false,
        }
    }
}

/// The order of conditions.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ConditionOrder {
    /// By the rows of a balanced Latin square (Williams 1949): each condition follows each other one equally often.
    #[default]
    Latin,
    /// Shuffled.
    Random,
}

/// The participants who gave one of several answers about themselves.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ParticipantFilter {
    /// The name of a profile question.
    pub question: String,
    /// The options that are kept.
    pub options: Vec<String>,
}

/// Trials by what they show; an empty list restricts nothing.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TrialSelection {
    /// Parts of the study.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<String>,
    /// Items.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub items: Vec<String>,
    /// Conditions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub conditions: Vec<String>,
}

impl TrialSelection {
    /// Returns whether a trial of that part, item and condition is selected.
    #[must_use]
    pub fn holds_trial(&self, part: &str, item: &str, condition: &str) -> bool {
        let among = |list: &[String], it: &str| list.is_empty() || list.iter().any(|one| one == it);
        among(&self.parts, part) && among(&self.items, item) && among(&self.conditions, condition)
    }
}

/// A statement about answers, made before there are any.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyHypothesis {
    /// Its name, such as `H2`.
    pub name: String,
    /// The statement in words.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub text: LocalizedTexts,
    /// The name of the question that it is about.
    pub question: String,
    /// The groups that it compares.
    pub compares: HypothesisComparison,
    /// The expected result.
    #[serde(default)]
    pub expects: ExpectedResult,
    /// The level of significance.
    #[serde(default = "usual_alpha")]
    pub alpha: f64,
}

fn usual_alpha() -> f64 {
    0.05
}

/// The groups that a hypothesis compares.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HypothesisComparison {
    /// Two or more groups of trials, each with each.
    Between(Vec<TrialSelection>),
    /// Groups whose answers rise in this order.
    Trend(Vec<TrialSelection>),
    /// The answers with a measure of the trials, by its name.
    Measure(String),
}

/// The result that a hypothesis expects.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExpectedResult {
    /// The groups differ, or the measure correlates.
    #[default]
    Difference,
    /// No group differs from another by more than this, as Cliff's delta.
    SameWithin(f64),
}

/// A rule by which a participant is left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExclusionRule {
    /// The questionnaire was not finished.
    Unfinished,
    /// More than this many answers to check trials are wrong.
    ChecksWrong(u32),
    /// All answers on scales have one value.
    OneValue,
}

impl StudyPlan {
    /// Returns the SHA-256 of the plan's JSON, by which answers name the plan that they belong to: 64 hexadecimal letters.
    #[must_use]
    pub fn plan_sha256(&self) -> String {
        let json = serde_json::to_vec(self).unwrap_or_default();
        let hash = Sha256::digest(json);
        hash.iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// Returns the plan with twelve significant digits of each number. JSON gives such numbers back exactly, so that a
    /// plan that is stored and read again has the same [`plan_sha256`](Self::plan_sha256).
    #[must_use]
    pub fn with_short_numbers(mut self) -> Self {
        let short = |number: &mut f64| {
            if let Ok(rounded) = format!("{number:.11e}").parse() {
                *number = rounded;
            }
        };
        for trial in &mut self.trials {
            trial.measures.values_mut().for_each(short);
        }
        for hypothesis in &mut self.hypotheses {
            short(&mut hypothesis.alpha);
            if let ExpectedResult::SameWithin(bound) = &mut hypothesis.expects {
                short(bound);
            }
        }
        self
    }

    /// Returns the question of that name.
    #[must_use]
    pub fn find_plan_question(&self, name: &str) -> Option<&StudyQuestion> {
        self.questions.iter().find(|question| question.name == name)
    }

    /// Returns the questions that are asked about a trial, in their order: those after the first viewing come first.
    pub fn questions_of_trial<'a>(&'a self, trial: &'a StudyTrial) -> impl Iterator<Item = &'a StudyQuestion> {
        let of = move |viewing| {
            self.questions.iter().filter(move |question| {
                question.after == viewing && (question.parts.is_empty() || question.parts.contains(&trial.part))
            })
        };
        of(QuestionViewing::First).chain(of(QuestionViewing::Second))
    }

    /// Returns the trial with that item, condition, part and role.
    #[must_use]
    pub fn find_plan_trial(&self, part: &str, item: &str, condition: &str, role: TrialRole) -> Option<&StudyTrial> {
        self.trials.iter().find(|trial| {
            trial.part == part && trial.item == item && trial.condition == condition && trial.role == role
        })
    }

    /// Returns the conditions of main trials, in the order of the plan.
    #[must_use]
    pub fn main_conditions(&self) -> Vec<&str> {
        unique_names_in_order(self.main().map(|trial| trial.condition.as_str()))
    }

    /// Returns the items of main trials, in the order of the plan.
    #[must_use]
    pub fn main_items(&self) -> Vec<&str> {
        unique_names_in_order(self.main().map(|trial| trial.item.as_str()))
    }

    /// Returns the parts of the study, in the order of the plan.
    #[must_use]
    pub fn plan_parts(&self) -> Vec<&str> {
        unique_names_in_order(self.trials.iter().map(|trial| trial.part.as_str()))
    }

    /// Returns the trials that are analysed.
    pub fn main(&self) -> impl Iterator<Item = &StudyTrial> {
        self.trials.iter().filter(|trial| trial.role == TrialRole::Main)
    }
}

/// Returns each name once, in the order of first occurrence.
fn unique_names_in_order<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut seen = std::collections::BTreeSet::new();
    names.filter(|name| seen.insert(*name)).collect()
}

/// Returns the text in a language, else in English, else in any.
#[must_use]
pub fn text_in<'a>(texts: &'a LocalizedTexts, language: &str) -> Option<&'a str> {
    let text = texts.get(language).or_else(|| texts.get("en"));
    text.or_else(|| texts.values().next()).map(String::as_str)
}

#[cfg(test)]
pub(super) mod tests;
