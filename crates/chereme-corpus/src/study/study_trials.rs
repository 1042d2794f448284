//! Trials as a table: item, condition, clip, role, part, right answers, and measures.

use std::collections::{BTreeMap, BTreeSet};

use super::study_plan::{QuestionKind, StudyQuestion, StudyTrial, TrialRole};
use super::study_rows::{TextTable, read_text_table};
use crate::error::{CorpusError, CorpusResult};

/// The columns that are no measures; `answer QUESTION` is none either.
const NON_MEASURE_COLUMNS: [&str; 6] = ["item", "condition", "clip", "role", "part", "answer"];
/// The beginning of a column with the right answers to one question.
const ANSWER_COLUMN_PREFIX: &str = "answer ";
/// The largest number of wrong rows that are reported.
const MAX_WRONG_TRIAL_ROWS: usize = 100;

/// A trial with what its row of the table says about right answers.
pub(super) struct ListedTrial {
    pub(super) trial: StudyTrial,
    /// The right answer to whichever question has it as an option.
    answer: Option<String>,
    /// Where it stands.
    place: String,
}

impl ListedTrial {
    pub(super) fn from_plain_trial(trial: StudyTrial) -> Self {
        Self {
            trial,
            answer: None,
            place: String::new(),
        }
    }
}

/// Returns a trial without right answers and measures.
pub(super) fn new_study_trial(item: &str, condition: &str, clip: String) -> StudyTrial {
    StudyTrial {
        item: item.to_owned(),
        condition: condition.to_owned(),
        clip,
        role: TrialRole::Main,
        part: String::new(),
        right: BTreeMap::new(),
        measures: BTreeMap::new(),
    }
}

/// Fills in the right answers of a trial: those of its row, or else its item if that is an option.
pub(super) fn fill_right_answers(listed: &mut ListedTrial, questions: &[StudyQuestion]) -> CorpusResult<()> {
    let part = &listed.trial.part;
    let mut used = false;
    for question in questions {
        let QuestionKind::Choice { options } = &question.kind else {
            continue;
        };
        if !question.parts.is_empty() && !question.parts.contains(part) {
            continue;
        }
        let right = listed.answer.as_ref().unwrap_or(&listed.trial.item);
        if options.iter().any(|option| option.name == *right) {
            used = true;
            let right = right.clone();
            listed.trial.right.entry(question.name.clone()).or_insert(right);
        }
    }
    match &listed.answer {
        Some(answer) if !used => Err(CorpusError::from_wrong_message(format!(
            "no question has the option {answer:?}, which is to be right"
        ))
        .with_error_place(listed.place.clone())
        .with_advice("name the option in the question, or leave the cell empty")),
        _ => Ok(()),
    }
}

/// Reads a table of trials: `item`, `condition`, `clip`, and if wished `role`, `part`, `answer`; `answer QUESTION` for
/// one of several questions; every other column is a measure. All wrong rows are reported at once.
pub(super) fn read_trial_table(text: &str, file: &str) -> CorpusResult<Vec<ListedTrial>> {
    let TextTable { titles, rows } = read_text_table(text, file)?;
    for needed in &NON_MEASURE_COLUMNS[..3] {
        if !titles.iter().any(|title| title == needed) {
            let error =
                CorpusError::from_wrong_message(format!("the table has no column {needed:?}")).with_error_place(file);
            return Err(error.with_advice(
                "the columns are item, condition, clip, and if wished role, part, answer, and measures in numbers",
            ));
        }
    }
    let mut trials = Vec::with_capacity(rows.len());
    let mut wrong = Vec::new();
    for (line, cells) in rows {
        match read_trial_row(&titles, &cells, format!("{file}, line {line}")) {
            Ok(it) => trials.push(it),
            Err(error) if wrong.len() < MAX_WRONG_TRIAL_ROWS => wrong.push(error),
            Err(_) => break,
        }
    }
    fail_with_errors(wrong).map(|()| trials)
}

/// Fails with all these errors, if there are any.
pub(super) fn fail_with_errors(mut errors: Vec<CorpusError>) -> CorpusResult<()> {
    match errors.len() {
        0 => Ok(()),
        1 => Err(errors.remove(0)),
        _ => Err(CorpusError::from_error_list(errors)),
    }
}

/// Reads a row, which stands at `place`.
fn read_trial_row(titles: &[String], cells: &[String], place: String) -> CorpusResult<ListedTrial> {
    let mut it = ListedTrial {
        trial: new_study_trial("", "", String::new()),
        answer: None,
        place: place.clone(),
    };
    for (title, cell) in titles.iter().zip(cells) {
        let cell = cell.trim();
        if cell.is_empty() {
            continue;
        }
        match title.as_str() {
            "item" => cell.clone_into(&mut it.trial.item),
            "condition" => cell.clone_into(&mut it.trial.condition),
            "clip" => cell.clone_into(&mut it.trial.clip),
            "part" => cell.clone_into(&mut it.trial.part),
            "role" => {
                it.trial.role = TrialRole::trial_role_named(cell).ok_or_else(|| {
                    CorpusError::from_wrong_message(format!("{cell:?} is no role of a trial"))
                        .with_error_place(&place)
                        .with_advice("the roles are training, main and check")
                })?;
            }
            "answer" => it.answer = Some(cell.to_owned()),
            other => {
                match other.strip_prefix(ANSWER_COLUMN_PREFIX) {
                    Some(question) => {
                        let question = question.trim().to_owned();
                        it.trial.right.insert(question, cell.to_owned());
                    }
                    None => {
                        let parsed_number: Option<f64> = cell.parse().ok().filter(|value: &f64| value.is_finite());
                        let number = parsed_number.ok_or_else(|| {
                        CorpusError::from_wrong_message(format!("{cell:?} in the column {other:?} is no number"))
                            .with_error_place(&place)
                            .with_advice("columns beside item, condition, clip, role, part and answer are measures of the clip")
                    })?;
                        it.trial.measures.insert(other.to_owned(), number);
                    }
                }
            }
        }
    }
    if it.trial.item.is_empty() || it.trial.clip.is_empty() {
        let error = CorpusError::from_wrong_message("a trial needs an item and a clip").with_error_place(place);
        return Err(error.with_advice("fill in both cells, or remove the row"));
    }
    Ok(it)
}

/// Writes trials as a table that [`listed`] reads; columns without a cell are left out.
pub(super) fn write_trial_table(trials: &[StudyTrial]) -> String {
    let right: BTreeSet<&str> = trials.iter().flat_map(|trial| text_keys(&trial.right)).collect();
    let measures: BTreeSet<&str> = trials.iter().flat_map(|trial| text_keys(&trial.measures)).collect();
    let with_role = trials.iter().any(|trial| trial.role != TrialRole::Main);
    let with_part = trials.iter().any(|trial| !trial.part.is_empty());
    let mut titles: Vec<String> = NON_MEASURE_COLUMNS[..3]
        .iter()
        .map(|title| (*title).to_owned())
        .collect();
    titles.extend(with_role.then(|| "role".to_owned()));
    titles.extend(with_part.then(|| "part".to_owned()));
    titles.extend(right.iter().map(|question| format!("{ANSWER_COLUMN_PREFIX}{question}")));
    titles.extend(measures.iter().map(|measure| (*measure).to_owned()));
    let mut out = csv::Writer::from_writer(Vec::new());
    // Writing into memory never fails, and all rows have as many cells as there are titles.
    let _ = out.write_record(&titles);
    for it in trials {
        let mut cells = vec![it.item.clone(), it.condition.clone(), it.clip.clone()];
        cells.extend(with_role.then(|| it.role.trial_role_name().to_owned()));
        cells.extend(with_part.then(|| it.part.clone()));
        let own = right
            .iter()
            .map(|name| it.right.get(*name).cloned().unwrap_or_default());
        cells.extend(own);
        let measure_cells = measures
            .iter()
            .map(|name| it.measures.get(*name).map(f64::to_string).unwrap_or_default());
        cells.extend(measure_cells);
        let _ = out.write_record(&cells);
    }
    let bytes = out.into_inner().unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}

fn text_keys<V>(map: &BTreeMap<String, V>) -> impl Iterator<Item = &str> {
    map.keys().map(String::as_str)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_of_trials_is_read_as_it_was_written() {
        let mut one = new_study_trial("WEEK END", "made, higher", "\"WEEK END\" | swap".to_owned());
        one.part = "places".to_owned();
        one.right.insert("place".into(), "left".into());
        let mut two = new_study_trial("BOL", "captured", "BOL".to_owned());
        two.role = TrialRole::Training;
        two.measures.insert("distance".into(), 0.1 + 0.2);
        let all = [one, two];
        let text = write_trial_table(&all);
        let read: Vec<StudyTrial> = read_trial_table(&text, "t.csv")
            .expect("read")
            .into_iter()
            .map(|it| it.trial)
            .collect();
        assert_eq!(read, all, "{text}");
    }

    #[test]
    fn every_wrong_row_of_a_table_is_named() {
        let text = "item,condition,clip,role,depth\nA,a,A,,\nB,a,,,\nC,a,C,mian,\nD,a,D,,x\n";
        let Err(CorpusError::Several { errors, .. }) = read_trial_table(text, "t.csv") else {
            panic!("three rows are wrong")
        };
        let places: Vec<_> = errors.iter().filter_map(CorpusError::error_place).collect();
        assert_eq!(
            places,
            ["t.csv, line 3", "t.csv, line 4", "t.csv, line 5"],
            "{errors:?}"
        );
        assert!(errors.iter().all(|it| it.error_remedy().is_some()));
    }
}
