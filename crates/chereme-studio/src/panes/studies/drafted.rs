//! A plan that is being written or changed, without widgets.

use chereme_corpus::study::plan::{
    Comparison, Design, Exclusion, Expectation, Hypothesis, Order, Plan, Question, Selection, Trial,
};
use chereme_corpus::study::{StudyOverview, StudyRequest, words as split};
use chereme_corpus::{Corpus, Error};

/// A plan in the form.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Draft {
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
    pub(super) order: Order,
    pub(super) between: bool,
    pub(super) blocks: u32,
    pub(super) seed: u64,
    /// The condition from which distances are measured.
    pub(super) distance_from: Option<String>,
    pub(super) hypotheses: Vec<Hypothesis>,
    pub(super) exclusions: Vec<Exclusion>,
    /// The plan before: it has all that the lines of the form do not state, such as the texts of questions.
    pub(super) before: Option<Plan>,
    /// Trials that neither signs and conditions nor a table can state.
    pub(super) others: Vec<Trial>,
    /// The stored study that is changed.
    pub(super) changes: Option<Changed>,
}

/// A stored study that is being changed, as it was when its form was opened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Changed {
    pub(super) name: String,
    pub(super) people: u64,
    pub(super) answers: u64,
}

/// The plan of a form, and its faults.
#[derive(Default)]
pub(super) struct Planned {
    of: Option<Draft>,
    pub(super) plan: Option<Plan>,
    pub(super) faults: Vec<Error>,
}

impl Default for Draft {
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
            order: Order::default(),
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

impl Draft {
    /// Returns the form of a stored study. The plan of one that was answered becomes another study, which has the next free
    /// name.
    pub(super) fn of(it: &StudyOverview, taken: &[&str]) -> Self {
        let mut draft = Self::of_plan(&it.plan);
        if it.participants > 0 {
            draft.name = free_name(&it.plan.name, taken);
        }
        draft.changes = Some(Changed {
            name: it.plan.name.clone(),
            people: it.participants,
            answers: it.answers,
        });
        draft
    }

    /// Returns the form of a plan.
    pub(super) fn of_plan(plan: &Plan) -> Self {
        let (request, distance_from) = StudyRequest::of(plan);
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
    pub(super) fn request(&self) -> StudyRequest {
        let filled = |text: &String| !text.trim().is_empty();
        let conditions = self.conditions.iter().filter(|it| it.iter().all(filled));
        let questions = self.questions.iter().filter(|it| filled(it));
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
            questions: questions.map(|it| it.trim().to_owned()).collect(),
            scale: self.scale,
            design: Design {
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
        if split(&self.items).iter().any(|it| it == item) {
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
    pub(super) fn add_hypothesis(&mut self, plan: &Plan) {
        let name = (1..).map(|n| format!("H{n}"));
        let mut name = name.filter(|it| self.hypotheses.iter().all(|own| own.name != *it));
        let conditions = plan.conditions();
        let group = |at: usize| Selection {
            conditions: conditions
                .get(at)
                .map(|it| (*it).to_owned())
                .into_iter()
                .collect(),
            ..Selection::default()
        };
        self.hypotheses.push(Hypothesis {
            name: name.next().unwrap_or_default(),
            text: [].into(),
            question: plan
                .questions
                .first()
                .map(|it| it.name.clone())
                .unwrap_or_default(),
            compares: Comparison::Between(vec![group(0), group(1)]),
            expects: Expectation::Difference,
            alpha: 0.05,
        });
    }

    /// Returns the details of a question, which its line does not state, to be changed.
    pub(super) fn details<'a>(
        &'a mut self,
        planned: &Plan,
        name: &str,
    ) -> Option<&'a mut Question> {
        let now = planned.question(name)?;
        let before = self.before.get_or_insert_with(|| planned.clone());
        match before.questions.iter().position(|it| it.name == name) {
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

impl Planned {
    /// Makes the plan of the form again if the form has changed.
    pub(super) fn follow(&mut self, draft: &Draft) {
        if self.of.as_ref() == Some(draft) {
            return;
        }
        (self.plan, self.faults) = match draft.request().plan() {
            Ok(plan) => {
                let mut named = plan.clone();
                if named.name.is_empty() {
                    // The missing name is reported at its field.
                    named.name = "-".to_owned();
                }
                let faults = Corpus::check_plan(&named).err();
                (Some(plan), faults.map(each).unwrap_or_default())
            }
            Err(error) => (None, each(error)),
        };
        self.of = Some(draft.clone());
    }

    /// Returns the plan if it has no faults.
    pub(super) fn sound(&self) -> Option<&Plan> {
        self.plan.as_ref().filter(|_| self.faults.is_empty())
    }
}

/// Returns the parts of an error.
pub(super) fn each(error: Error) -> Vec<Error> {
    match error {
        Error::Several { errors } => errors,
        one => vec![one],
    }
}

/// Returns the name with a number that no study has yet.
fn free_name(name: &str, taken: &[&str]) -> String {
    let numbered = (2..).map(|n: u32| format!("{name} ({n})"));
    let mut free = numbered.filter(|it| !taken.contains(&it.as_str()));
    free.next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::super::data::trials;
    use super::*;
    use crate::words::Language;

    fn places() -> Draft {
        let mut draft = Draft {
            name: " places ".to_owned(),
            ..Draft::default()
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
        let plan = draft.request().plan().expect("a plan");
        assert_eq!((plan.name.as_str(), plan.trials.len()), ("places", 6));
        assert_eq!(plan.questions.len(), 2);
        let rows = trials(&plan, Language::English);
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
        let plan = draft.request().plan().expect("a plan");
        draft.add_hypothesis(&plan);
        let details = draft.details(&plan, "realism").expect("a question");
        details.cannot_say = true;
        let plan = draft.request().plan().expect("a plan");
        assert!(plan.questions[0].cannot_say);
        let groups = Comparison::Between(
            ["captured", "higher"]
                .map(|it| Selection {
                    conditions: vec![it.to_owned()],
                    ..Selection::default()
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
        let again = Draft::of(&overview, &["places"]);
        assert_eq!(again.items, draft.items);
        assert_eq!(again.request().plan().expect("a plan"), plan);
        overview.participants = 3;
        let another = Draft::of(&overview, &["places", "places (2)"]);
        assert_eq!(another.name, "places (3)");
    }

    #[test]
    fn faults_are_found_while_the_form_is_filled_in() {
        let mut planned = Planned::default();
        let mut draft = places();
        planned.follow(&draft);
        assert!(planned.sound().is_some());
        draft.table = "item,condition,clip\nA,a,\nB,b,\n".to_owned();
        planned.follow(&draft);
        assert_eq!((planned.plan.is_none(), planned.faults.len()), (true, 2));
        draft.table.clear();
        let plan = draft.request().plan().expect("a plan");
        draft.add_hypothesis(&plan);
        draft.hypotheses[0].alpha = 2.0;
        planned.follow(&draft);
        assert_eq!(planned.faults.len(), 1);
        assert!(planned.plan.is_some() && planned.sound().is_none());
    }
}
