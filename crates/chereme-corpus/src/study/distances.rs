//! How far each clip of a study is from the clip of the same item in another condition.

use chereme_analysis::score::{PerformedClip, ScoreOptions, score_as};

use super::StudyClip;
use super::study_plan::StudyPlan;
use crate::Corpus;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;

/// The name of the measure.
pub const DISTANCE_MEASURE_NAME: &str = "distance";

impl Corpus {
    /// Gives each trial the measure [`DISTANCE_MEASURE_NAME`]: the normalised distance of its clip from the clip of the same item in a
    /// condition, as [`score`](Self::score_movements) has it with its usual options; trials of the same part come first. An item
    /// that the condition lacks gets none. A report correlates answers with it.
    ///
    /// # Errors
    /// Fails if no trial has the condition, a trial has a measure of that name, a clip cannot be found or made, or two
    /// clips have nothing in common that can be compared.
    pub fn measure_distances(
        &mut self,
        plan: &mut StudyPlan,
        condition: &str,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<()> {
        let mut references = plan.clone();
        references.trials.retain(|trial| trial.condition == condition);
        if references.trials.is_empty() {
            let error = CorpusError::from_wrong_message(format!("no trial has the condition {condition:?}"));
            let names = plan.main_conditions().join(", ");
            return Err(error
                .with_error_place(condition)
                .with_advice(format!("conditions of the plan: {names}")));
        }
        if plan
            .trials
            .iter()
            .any(|trial| trial.measures.contains_key(DISTANCE_MEASURE_NAME))
        {
            let error =
                CorpusError::from_wrong_message(format!("the trials have a measure {DISTANCE_MEASURE_NAME:?} already"));
            return Err(error
                .with_error_place(DISTANCE_MEASURE_NAME)
                .with_advice("give the column of the table another name"));
        }
        let mut reference_clips: Vec<(Vec<usize>, StudyClip)> = Vec::new();
        self.study_clips(&references, progress, |trials, clip| {
            reference_clips.push((trials.to_vec(), clip));
            Ok(())
        })?;
        let reference = |part: &str, item: &str| {
            let holds = |same_part: bool| {
                reference_clips.iter().find(|(trials, _)| {
                    let mut trials = trials.iter().map(|at| &references.trials[*at]);
                    trials.any(|trial| trial.item == item && (!same_part || trial.part == part))
                })
            };
            // A part may lack the condition, while another part has the same item in it.
            holds(true).or_else(|| holds(false)).map(|entry| &entry.1)
        };
        let trials = plan.trials.clone();
        let measured = &mut plan.trials;
        let full_plan = StudyPlan {
            trials,
            ..references.clone()
        };
        self.study_clips(&full_plan, progress, |trials, clip| {
            for at in trials {
                let trial = &mut measured[*at];
                if let Some(reference) = reference(&trial.part, &trial.item) {
                    let distance = study_clip_distance(reference, &clip).map_err(|error| {
                        let place = format!("trial {} ({}, {})", at + 1, trial.item, trial.condition);
                        error.with_error_place(place)
                    })?;
                    trial.measures.insert(DISTANCE_MEASURE_NAME.to_owned(), distance);
                }
            }
            Ok(())
        })
    }
}

/// Returns the normalised distance of two clips; handshapes count as they are stored.
fn study_clip_distance(reference: &StudyClip, clip: &StudyClip) -> CorpusResult<f64> {
    let [first, second] = [reference, clip].map(|study_clip| PerformedClip {
        clip: &study_clip.clip,
        anatomy: &study_clip.anatomy,
        uncaptured: &[],
    });
    let score = score_as(first, second, &ScoreOptions::default())
        .map_err(|error| CorpusError::from_wrong_message(format!("the two cannot be compared: {error}")))?;
    Ok(score.normalized.unwrap_or(score.distance))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::ignore_progress_step;
    use crate::study::StudyRequest;
    use crate::study::build::tests::corpus;

    #[test]
    fn distances_are_those_of_the_same_item_in_another_condition() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus(folder.path());
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        let up = |by: &str| format!("{{}} | place both by up {by}");
        let request = StudyRequest {
            name: "far".into(),
            items: vec!["BOL".into(), "CHAT".into()],
            conditions: vec![
                ("captured".into(), "{}".into()),
                ("near".into(), up("2cm")),
                ("far".into(), up("15cm")),
            ],
            questions: vec!["realism".into()],
            scale: 5,
            ..StudyRequest::default()
        };
        let mut plan = request.make_study_plan().expect("a plan");
        let unknown = corpus.measure_distances(&mut plan, "capture", progress);
        assert!(unknown.is_err_and(|it| it.error_remedy().is_some()));
        corpus
            .measure_distances(&mut plan, "captured", progress)
            .expect("measured");
        for item in ["BOL", "CHAT"] {
            let own = plan.trials.iter().filter(|it| it.item == item);
            let distances: Vec<f64> = own.map(|it| it.measures[DISTANCE_MEASURE_NAME]).collect();
            let [captured, near, far] = distances[..] else {
                panic!("three conditions")
            };
            assert!(captured < 1e-9 && 0.0 < near && near < far, "{item}: {distances:?}");
        }
        let twice = corpus.measure_distances(&mut plan, "captured", progress);
        assert!(twice.is_err_and(|it| it.to_string().contains("already")));
        corpus
            .plan_study(&plan, progress)
            .expect("a plan with measures is stored");
    }
}
