//! Trials as a table: item, condition, clip, role, part, right answers, and measures.

use std::collections::{BTreeMap, BTreeSet};

use super::plan::{Question, QuestionKind, Role, Trial};
use super::rows::{Table, table};
use crate::error::{Error, Result};

/// The columns that are no measures; `answer QUESTION` is none either.
const OWN: [&str; 6] = ["item", "condition", "clip", "role", "part", "answer"];
/// The beginning of a column with the right answers to one question.
const ANSWER: &str = "answer ";
/// The largest number of wrong rows that are reported.
const MOST_WRONG: usize = 100;

/// A trial with what its row of the table says about right answers.
pub(super) struct Listed {
    pub(super) trial: Trial,
    /// The right answer to whichever question has it as an option.
    answer: Option<String>,
    /// Where it stands.
    place: String,
}

impl Listed {
    pub(super) fn of(trial: Trial) -> Self {
        Self {
            trial,
            answer: None,
            place: String::new(),
        }
    }
}

/// Returns a trial without right answers and measures.
pub(super) fn trial(item: &str, condition: &str, clip: String) -> Trial {
    Trial {
        item: item.to_owned(),
        condition: condition.to_owned(),
        clip,
        role: Role::Main,
        part: String::new(),
        right: BTreeMap::new(),
        measures: BTreeMap::new(),
    }
}

/// Fills in the right answers of a trial: those of its row, or else its item if that is an option.
pub(super) fn answer(listed: &mut Listed, questions: &[Question]) -> Result<()> {
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
        if options.iter().any(|it| it.name == *right) {
            used = true;
            let right = right.clone();
            listed
                .trial
                .right
                .entry(question.name.clone())
                .or_insert(right);
        }
    }
    match &listed.answer {
        Some(answer) if !used => Err(Error::wrong(format!(
            "no question has the option {answer:?}, which is to be right"
        ))
        .at(listed.place.clone())
        .advise("name the option in the question, or leave the cell empty")),
        _ => Ok(()),
    }
}

/// Reads a table of trials: `item`, `condition`, `clip`, and if wished `role`, `part`, `answer`; `answer QUESTION` for
/// one of several questions; every other column is a measure. All wrong rows are reported at once.
pub(super) fn listed(text: &str, file: &str) -> Result<Vec<Listed>> {
    let Table { titles, rows } = table(text, file)?;
    for needed in &OWN[..3] {
        if !titles.iter().any(|it| it == needed) {
            let error = Error::wrong(format!("the table has no column {needed:?}")).at(file);
            return Err(error.advise(
                "the columns are item, condition, clip, and if wished role, part, answer, and measures in numbers",
            ));
        }
    }
    let mut trials = Vec::with_capacity(rows.len());
    let mut wrong = Vec::new();
    for (line, cells) in rows {
        match row(&titles, &cells, format!("{file}, line {line}")) {
            Ok(it) => trials.push(it),
            Err(error) if wrong.len() < MOST_WRONG => wrong.push(error),
            Err(_) => break,
        }
    }
    together(wrong).map(|()| trials)
}

/// Fails with all these errors, if there are any.
pub(super) fn together(mut errors: Vec<Error>) -> Result<()> {
    match errors.len() {
        0 => Ok(()),
        1 => Err(errors.remove(0)),
        _ => Err(Error::Several { errors }),
    }
}

/// Reads a row, which stands at `place`.
fn row(titles: &[String], cells: &[String], place: String) -> Result<Listed> {
    let mut it = Listed {
        trial: trial("", "", String::new()),
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
                it.trial.role = Role::named(cell).ok_or_else(|| {
                    Error::wrong(format!("{cell:?} is no role of a trial"))
                        .at(&place)
                        .advise("the roles are training, main and check")
                })?;
            }
            "answer" => it.answer = Some(cell.to_owned()),
            other => match other.strip_prefix(ANSWER) {
                Some(question) => {
                    let question = question.trim().to_owned();
                    it.trial.right.insert(question, cell.to_owned());
                }
                None => {
                    let number: Option<f64> = cell.parse().ok().filter(|it: &f64| it.is_finite());
                    let number = number.ok_or_else(|| {
                        Error::wrong(format!("{cell:?} in the column {other:?} is no number"))
                            .at(&place)
                            .advise("columns beside item, condition, clip, role, part and answer are measures of the clip")
                    })?;
                    it.trial.measures.insert(other.to_owned(), number);
                }
            },
        }
    }
    if it.trial.item.is_empty() || it.trial.clip.is_empty() {
        let error = Error::wrong("a trial needs an item and a clip").at(place);
        return Err(error.advise("fill in both cells, or remove the row"));
    }
    Ok(it)
}

/// Writes trials as a table that [`listed`] reads; columns without a cell are left out.
pub(super) fn written(trials: &[Trial]) -> String {
    let right: BTreeSet<&str> = trials.iter().flat_map(|it| keys(&it.right)).collect();
    let measures: BTreeSet<&str> = trials.iter().flat_map(|it| keys(&it.measures)).collect();
    let with_role = trials.iter().any(|it| it.role != Role::Main);
    let with_part = trials.iter().any(|it| !it.part.is_empty());
    let mut titles: Vec<String> = OWN[..3].iter().map(|it| (*it).to_owned()).collect();
    titles.extend(with_role.then(|| "role".to_owned()));
    titles.extend(with_part.then(|| "part".to_owned()));
    titles.extend(right.iter().map(|it| format!("{ANSWER}{it}")));
    titles.extend(measures.iter().map(|it| (*it).to_owned()));
    let mut out = csv::Writer::from_writer(Vec::new());
    // Writing into memory never fails, and all rows have as many cells as there are titles.
    let _ = out.write_record(&titles);
    for it in trials {
        let mut cells = vec![it.item.clone(), it.condition.clone(), it.clip.clone()];
        cells.extend(with_role.then(|| it.role.name().to_owned()));
        cells.extend(with_part.then(|| it.part.clone()));
        let own = right
            .iter()
            .map(|name| it.right.get(*name).cloned().unwrap_or_default());
        cells.extend(own);
        let own = measures.iter().map(|name| {
            it.measures
                .get(*name)
                .map(f64::to_string)
                .unwrap_or_default()
        });
        cells.extend(own);
        let _ = out.write_record(&cells);
    }
    let bytes = out.into_inner().unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}

fn keys<V>(map: &BTreeMap<String, V>) -> impl Iterator<Item = &str> {
    map.keys().map(String::as_str)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_of_trials_is_read_as_it_was_written() {
        let mut one = trial("WEEK END", "made, higher", "\"WEEK END\" | swap".to_owned());
        one.part = "places".to_owned();
        one.right.insert("place".into(), "left".into());
        let mut two = trial("BOL", "captured", "BOL".to_owned());
        two.role = Role::Training;
        two.measures.insert("distance".into(), 0.1 + 0.2);
        let all = [one, two];
        let text = written(&all);
        let read: Vec<Trial> = listed(&text, "t.csv")
            .expect("read")
            .into_iter()
            .map(|it| it.trial)
            .collect();
        assert_eq!(read, all, "{text}");
    }

    #[test]
    fn every_wrong_row_of_a_table_is_named() {
        let text = "item,condition,clip,role,depth\nA,a,A,,\nB,a,,,\nC,a,C,mian,\nD,a,D,,x\n";
        let Err(Error::Several { errors }) = listed(text, "t.csv") else {
            panic!("three rows are wrong")
        };
        let places: Vec<_> = errors.iter().filter_map(Error::place).collect();
        assert_eq!(
            places,
            ["t.csv, line 3", "t.csv, line 4", "t.csv, line 5"],
            "{errors:?}"
        );
        assert!(errors.iter().all(|it| it.remedy().is_some()));
    }
}
