//! A plan that is being written or changed, without widgets.

use chereme_corpus::study::study_plan::{
    ConditionOrder, ExclusionRule, ExpectedResult, HypothesisComparison, StudyHypothesis, StudyPlan, StudyQuestion,
    StudyTrial, TrialDesign, TrialSelection,
};
use chereme_corpus::study::{StudyOverview, StudyRequest, split_quoted_words as split};
use chereme_corpus::{Corpus, CorpusError};

/// A plan in the form.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StudyDraft {
    pub(super) name: String,
    pub(super) title: String,
    pub(super) items: String,
    /// The names and recipes of conditions; `{}` in a recipe stands for the item.
    pub(super) conditions: Vec<[String; 2]>,
    /// The table of trials, and the name of its file.
    pub(super) table: String,
    pub(super) file: String,
    pub(super) questions: Vec<String>,
    pub(super) scale: i64,
    pub(super) order: ConditionOrder,
    pub(super) between: bool,
    pub(super) blocks: u32,
    pub(super) seed: u64,
    /// The condition from which distances are measured.
    pub(super) distance_from: Option<String>,
    pub(super) hypotheses: Vec<StudyHypothesis>,
    pub(super) exclusions: Vec<ExclusionRule>,
    /// The plan before: it has all that the lines of the form do not state, such as the texts of questions.
    pub(super) before: Option<StudyPlan>,
    /// Trials that neither signs and conditions nor a table can state.
    pub(super) others: Vec<StudyTrial>,
    /// The stored study that is changed.
    pub(super) changes: Option<StudyBeforeChange>,
}

/// A stored study that is being changed, as it was when its form was opened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct StudyBeforeChange {
    pub(super) name: String,
    pub(super) people: u64,
    pub(super) answers: u64,
}

/// The plan of a form, and its faults.
#[derive(Default)]
pub(super) struct DraftedPlan {
    of: Option<StudyDraft>,
    pub(super) plan: Option<StudyPlan>,
    pub(super) faults: Vec<CorpusError>,
}

impl Default for StudyDraft {
    fn default() -> Self {
        Self {
            name: String::new(),
            title: String::new(),
            items: String::new(),
            conditions: vec![["captured".to_owned(), "{}".to_owned()]],
            table: String::new(),
            file: String::new(),
            questions: vec!["realism".to_owned()],
            scale: 5,
            order: ConditionOrder::default(),
            between: false,
            blocks: 1,
            seed: 1,
            distance_from: None,
            hypotheses: Vec::new(),
            exclusions: Vec::new(),
            before: None,
            others: Vec::new(),
            changes: None,
        }
    }
}

impl StudyDraft {
    /// Returns the form of a stored study. The plan of one that was answered becomes another study, which has the next free
    /// name.
    pub(super) fn draft_from_study(it: &StudyOverview, taken: &[&str]) -> Self {
        let mut draft = Self::of_plan(&it.plan);
        if it.participants > 0 {
            draft.name = numbered_study_name(&it.plan.name, taken);
        }
        draft.changes = Some(StudyBeforeChange {
            name: it.plan.name.clone(),
            people: it.participants,
            answers: it.answers,
        });
        draft
    }

    /// Returns the form of a plan.
    pub(super) fn of_plan(plan: &StudyPlan) -> Self {
        let (request, distance_from) = StudyRequest::from_stored_plan(plan);
        let mut draft = Self {
            name: request.name,
            title: request.title.unwrap_or_default(),
            questions: request.questions,
            scale: request.scale,
            order: request.design.order,
            between: request.design.between,
            blocks: request.design.blocks,
            seed: request.design.seed,
            distance_from,
            hypotheses: request.hypotheses,
            exclusions: request.exclusions,
            before: request.before,
            others: request.others,
            ..Self::default()
        };
        for item in &request.items {
            draft.add_item(item);
        }
        if !request.conditions.is_empty() {
            let pair = |(name, recipe)| [name, recipe];
            draft.conditions = request.conditions.into_iter().map(pair).collect();
        }
        (draft.table, draft.file) = request.trials.unwrap_or_default();
        draft
    }

    /// Returns the study in the words of the library.
    pub(super) fn draft_study_request(&self) -> StudyRequest {
        let filled = |text: &String| !text.trim().is_empty();
        let conditions = self.conditions.iter().filter(|condition| condition.iter().all(filled));
        let questions = self.questions.iter().filter(|question| filled(question));
        let file = match self.file.trim() {
            "" => "table",
            name => name,
        };
        StudyRequest {
            name: self.name.trim().to_owned(),
            title: filled(&self.title).then(|| self.title.trim().to_owned()),
            items: split(&self.items),
            conditions: conditions
                .map(|[name, recipe]| (name.trim().to_owned(), recipe.trim().to_owned()))
                .collect(),
            trials: filled(&self.table).then(|| (self.table.clone(), file.to_owned())),
            questions: questions.map(|question| question.trim().to_owned()).collect(),
            scale: self.scale,
            design: TrialDesign {
                order: self.order,
                seed: self.seed,
                blocks: self.blocks,
                between: self.between,
            },
            hypotheses: self.hypotheses.clone(),
            exclusions: self.exclusions.clone(),
            before: self.before.clone(),
            others: self.others.clone(),
        }
    }

    /// Adds an item, unless it is there.
    pub(super) fn add_item(&mut self, item: &str) {
        if split(&self.items).iter().any(|other| other == item) {
            return;
        }
        let quoted = match item.contains(char::is_whitespace) {
            true => format!("\"{item}\""),
            false => item.to_owned(),
        };
        let before = self.items.trim_end();
        self.items = match before.is_empty() {
            true => quoted,
            false => format!("{before} {quoted}"),
        };
    }

    /// Adds a hypothesis about the first question: the first condition differs from the second.
    pub(super) fn add_hypothesis(&mut self, plan: &StudyPlan) {
        let numbered_names = (1..).map(|n| format!("H{n}"));
        let mut name = numbered_names.filter(|candidate| self.hypotheses.iter().all(|own| own.name != *candidate));
        let conditions = plan.main_conditions();
        let group = |at: usize| TrialSelection {
            conditions: conditions
                .get(at)
                .map(|condition| (*condition).to_owned())
                .into_iter()
                .collect(),
            ..TrialSelection::default()
        };
        self.hypotheses.push(StudyHypothesis {
            name: name.next().unwrap_or_default(),
            text: [].into(),
            question: plan
                .questions
                .first()
                .map(|question| question.name.clone())
                .unwrap_or_default(),
            compares: HypothesisComparison::Between(vec![group(0), group(1)]),
            expects: ExpectedResult::Difference,
            alpha: 0.05,
        });
    }

    /// Returns the details of a question, which its line does not state, to be changed.
    pub(super) fn question_details_mut<'a>(
        &'a mut self,
        planned: &StudyPlan,
        name: &str,
    ) -> Option<&'a mut StudyQuestion> {
        let now = planned.find_plan_question(name)?;
        let before = self.before.get_or_insert_with(|| planned.clone());
        match before.questions.iter().position(|question| question.name == name) {
            Some(at) => {
                // The answers are those of the line.
                before.questions[at].clone_from(now);
                before.questions.get_mut(at)
            }
            None => {
                before.questions.push(now.clone());
                before.questions.last_mut()
            }
        }
    }
}

impl DraftedPlan {
    /// Makes the plan of the form again if the form has changed.
    pub(super) fn plan_changed_draft(&mut self, draft: &StudyDraft) {
        if self.of.as_ref() == Some(draft) {
            return;
        }
        (self.plan, self.faults) = match draft.draft_study_request().make_study_plan() {
            Ok(plan) => {
                let mut named = plan.clone();
                if named.name.is_empty() {
                    // The missing name is reported at its field.
                    named.name = "-".to_owned();
                }
                let faults = Corpus::check_plan(&named).err();
                (Some(plan), faults.map(split_study_errors).unwrap_or_default())
            }
            Err(error) => (None, split_study_errors(error)),
        };
        self.of = Some(draft.clone());
    }

    /// Returns the plan if it has no faults.
    pub(super) fn faultless_plan(&self) -> Option<&StudyPlan> {
        self.plan.as_ref().filter(|_| self.faults.is_empty())
    }
}

/// Returns the parts of an error.
pub(super) fn split_study_errors(error: CorpusError) -> Vec<CorpusError> {
    match error {
        CorpusError::Several { errors, .. } => errors,
        one => vec![one],
    }
}

/// Returns the name with a number that no study has yet.
fn numbered_study_name(name: &str, taken: &[&str]) -> String {
    let numbered = (2..).map(|n: u32| format!("{name} ({n})"));
    let mut free = numbered.filter(|candidate| !taken.contains(&candidate.as_str()));
    free.next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::super::studies_data::trial_rows_from_plan;
    use super::*;
    use crate::words::InterfaceLanguage;

    fn places() -> StudyDraft {
        let mut draft = StudyDraft {
            name: " places ".to_owned(),
            ..StudyDraft::default()
        };
        for item in ["BOL", "CHAT", "BOL", "WEEK END"] {
            draft.add_item(item);
        }
        draft
            .conditions
            .push(["higher".to_owned(), "{} | place both by up 10cm".to_owned()]);
        draft.questions.push("gloss=items".to_owned());
        draft
    }

    #[test]
    fn a_draft_makes_items_times_conditions() {
        let mut draft = places();
        assert_eq!(draft.items, "BOL CHAT \"WEEK END\"");
        // A condition without a recipe is not finished.
        draft.conditions.push(["lower".to_owned(), String::new()]);
        let plan = draft.draft_study_request().make_study_plan().expect("a plan");
        assert_eq!((plan.name.as_str(), plan.trials.len()), ("places", 6));
        assert_eq!(plan.questions.len(), 2);
        let rows = trial_rows_from_plan(&plan, InterfaceLanguage::English);
        assert_eq!(rows[3].name, "CHAT, higher");
        assert_eq!(rows[3].clip, "CHAT | place both by up 10cm");
        assert_eq!(
            rows[3].about,
            "CHAT | place both by up 10cm · right answer to gloss: CHAT"
        );
        assert_eq!(rows[4].clip, "\"WEEK END\"");
    }

    #[test]
    fn the_form_of_a_stored_plan_states_all_of_it() {
        let mut draft = places();
        draft.seed = 7;
        draft.table = "item,condition,clip,role\nLSF,,spell LSF,training\n".to_owned();
        let plan = draft.draft_study_request().make_study_plan().expect("a plan");
        draft.add_hypothesis(&plan);
        let details = draft.question_details_mut(&plan, "realism").expect("a question");
        details.cannot_say = true;
        let plan = draft.draft_study_request().make_study_plan().expect("a plan");
        assert!(plan.questions[0].cannot_say);
        let groups = HypothesisComparison::Between(
            ["captured", "higher"]
                .map(|it| TrialSelection {
                    conditions: vec![it.to_owned()],
                    ..TrialSelection::default()
                })
                .to_vec(),
        );
        assert_eq!(plan.hypotheses[0].compares, groups);
        let mut overview = StudyOverview {
            plan: plan.clone(),
            participants: 0,
            finished: 0,
            answers: 0,
        };
        let again = StudyDraft::draft_from_study(&overview, &["places"]);
        assert_eq!(again.items, draft.items);
        assert_eq!(again.draft_study_request().make_study_plan().expect("a plan"), plan);
        overview.participants = 3;
        let another = StudyDraft::draft_from_study(&overview, &["places", "places (2)"]);
        assert_eq!(another.name, "places (3)");
    }

    #[test]
    fn faults_are_found_while_the_form_is_filled_in() {
        let mut planned = DraftedPlan::default();
        let mut draft = places();
        planned.plan_changed_draft(&draft);
        assert!(planned.faultless_plan().is_some());
        draft.table = "item,condition,clip\nA,a,\nB,b,\n".to_owned();
        planned.plan_changed_draft(&draft);
        assert_eq!((planned.plan.is_none(), planned.faults.len()), (true, 2));
        draft.table.clear();
        let plan = draft.draft_study_request().make_study_plan().expect("a plan");
        draft.add_hypothesis(&plan);
        draft.hypotheses[0].alpha = 2.0;
        planned.plan_changed_draft(&draft);
        assert_eq!(planned.faults.len(), 1);
        assert!(planned.plan.is_some() && planned.faultless_plan().is_none());
    }
}
