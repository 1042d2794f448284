//! The answers of one participant of a study.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::study_plan::TrialRole;

/// The `format` of every file of answers.
pub const ANSWERS_FORMAT: &str = "chereme-answers";

/// The version of files of answers that this program writes and reads.
pub const ANSWERS_VERSION: u32 = 1;

/// A participant with all answers; its JSON is the file that the questionnaire saves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StudyParticipant {
    /// [`ANSWERS_FORMAT`].
    pub format: String,
    /// [`ANSWERS_VERSION`].
    pub version: u32,
    /// The name of the study.
    pub study: String,
    /// The SHA-256 of the plan that was answered.
    pub plan_sha256: String,
    /// The code that the participant chose, by which the answers can be found again and deleted.
    #[serde(rename = "participant")]
    pub code: String,
    /// The number that decided the order of trials.
    #[serde(default)]
    pub seed: u32,
    /// The day on which the questionnaire was begun, as `2026-11-27`; empty if unknown.
    #[serde(default)]
    pub started_day: String,
    /// The language of the texts, `en` or `fr`.
    #[serde(default)]
    pub language: String,
    /// The window.
    #[serde(default)]
    pub device: ParticipantDevice,
    /// The uses that the participant agreed to, by name: `analysis`, `publication`.
    #[serde(default)]
    pub consent: BTreeMap<String, bool>,
    /// The answers about the participant, an option by the name of the question; skipped ones are missing.
    #[serde(default)]
    pub profile: BTreeMap<String, String>,
    /// Whether the questionnaire was answered to its end.
    #[serde(default)]
    pub finished: bool,
    /// The trials, by their places in the participant's order, whose films the browser could not show. Import reports them;
    /// they are not stored.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub skipped: Vec<u32>,
    /// The answers, in the order in which they were given.
    #[serde(default)]
    pub answers: Vec<StudyAnswer>,
}

/// The window in which a questionnaire was answered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ParticipantDevice {
    /// Its width in pixels of the page.
    pub w: u32,
    /// Its height in pixels of the page.
    pub h: u32,
    /// Pixels of the screen per pixel of the page.
    pub dpr: f64,
}

/// One answer to one question about one film.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StudyAnswer {
    /// The place of the trial in the participant's order, from 1.
    pub n: u32,
    /// The block, from 1; 0 for training.
    #[serde(default)]
    pub block: u32,
    /// The part of the study.
    #[serde(default)]
    pub part: String,
    /// The sign or sentence that was shown.
    pub item: String,
    /// How it was made.
    pub condition: String,
    /// The use of the answer.
    #[serde(default)]
    pub role: TrialRole,
    /// The name of the question.
    pub question: String,
    /// The ends of the scale, of a question with a scale.
    #[serde(default)]
    pub scale: Option<[i64; 2]>,
    /// The number on the scale; none of a choice, or if the participant cannot say.
    #[serde(default)]
    pub value: Option<i64>,
    /// The name of the chosen option; none of a scale, or if the participant cannot say.
    #[serde(default)]
    pub choice: Option<String>,
    /// Whether the chosen option is the right one; none if the plan names no right one. Import computes it from the plan.
    #[serde(default)]
    pub right: Option<bool>,
    /// How often the film was played before the answer.
    #[serde(default)]
    pub plays: u32,
    /// Milliseconds from the end of the first viewing to the answer.
    #[serde(default)]
    pub ms: u32,
    /// How often the page was hidden during the trial.
    #[serde(default)]
    pub hidden: u32,
    /// How often the film was played at half speed before the answer.
    #[serde(default)]
    pub slow: u32,
}
