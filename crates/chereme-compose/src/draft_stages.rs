//! The stored movement of a draft: what was evaluated up to each source, operator and join.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::answers::RecipePath;
use crate::contact::MovementContacts;
use crate::outcome::GenerationReport;
use crate::recipe::{RecipeChain, RecipeNode};
use crate::recipe_inputs::RecipeInput;
use crate::resolve::ResolvedRecipe;
use crate::simplify::PlannedStep;
use crate::sources::MovementMaterial;
use crate::work::WorkingClip;

/// The most memory for stored results, in numbers of eight bytes.
const MAX_DRAFT_NUMBERS: usize = 12 << 20;

/// The stored results for parts of recipes.
#[derive(Debug, Default)]
pub(crate) struct KeptStages {
    stages: Vec<DraftStage>,
    /// The number of the current evaluation.
    round: u64,
    /// The index of the stage that was stored or found last.
    last: Option<usize>,
}

/// A part of a recipe: a source, pieces joined so far, or movement with operators applied to it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DraftPart {
    pub(crate) of: RecipeNode,
    pub(crate) steps: Vec<PlannedStep>,
}

/// The answers for a part, by paths relative to the part's own.
type PartAnswers = BTreeMap<String, (Option<RecipeInput>, Option<Arc<MovementMaterial>>)>;

/// The movement after a part, with the report so far.
#[derive(Debug)]
pub(crate) struct DraftStage {
    part: DraftPart,
    given: PartAnswers,
    /// The path of the part in the recipe.
    base: String,
    pub(crate) work: WorkingClip,
    pub(crate) contacts: Option<MovementContacts>,
    report: GenerationReport,
    round: u64,
}

impl DraftPart {
    /// Returns whether `path`, relative to the part's own, belongs to the part.
    fn covers_recipe_path(&self, path: &str) -> bool {
        let root_path = RecipePath::default();
        let below = |start: RecipePath| {
            let rest = path.strip_prefix(start.as_str());
            rest.is_some_and(|rest| rest.starts_with('/'))
        };
        match &self.of {
            _ if !self.steps.is_empty() => {
                let mut steps = self.steps.iter();
                below(root_path.operand_path()) || steps.any(|step| below(root_path.operator_step_path(step.index)))
            }
            RecipeNode::Then(then) => {
                let mut next = 0..then.next.len();
                below(root_path.first_piece_path()) || next.any(|n| below(root_path.later_piece_path(n)))
            }
            _ => path.starts_with('/'),
        }
    }

    /// Returns the part of an utterance up to its first piece and `count` more.
    pub(crate) fn utterance_pieces_part(then: &RecipeChain, count: usize) -> Self {
        Self {
            of: RecipeNode::Then(RecipeChain {
                first: then.first.clone(),
                next: then.next[..count].to_vec(),
            }),
            steps: Vec::new(),
        }
    }
}

/// Returns the answers of `resolved` for a part at `base`.
fn part_answers(resolved: &ResolvedRecipe, base: &str, part: &DraftPart) -> PartAnswers {
    let mut given = PartAnswers::new();
    for (path, input) in resolved.inputs_below_path(base) {
        if part.covers_recipe_path(&path[base.len()..]) {
            let material = resolved.materials.get(path).cloned();
            let part_input = (Some(input.clone()), material);
            given.insert(path[base.len()..].to_owned(), part_input);
        }
    }
    given
}

impl DraftStage {
    fn stage_holds_for(&self, resolved: &ResolvedRecipe, base: &str) -> bool {
        let mut now = resolved
            .inputs_below_path(base)
            .filter(|(path, _)| self.part.covers_recipe_path(&path[base.len()..]));
        // Both are sorted by path, so that they are compared in step.
        let same = self.given.iter().all(|(at, (input, material))| {
            now.next().is_some_and(|(path, found)| {
                let loaded = resolved.materials.get(path);
                path[base.len()..] == **at
                    && Some(found) == input.as_ref()
                    && match (loaded, material) {
                        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
                        (None, None) => true,
                        _ => false,
                    }
            })
        });
        same && now.next().is_none()
    }

    /// Returns the report with paths at `base` instead of the former path of the part.
    pub(crate) fn report_at(&self, base: &str) -> GenerationReport {
        let mut report = self.report.clone();
        for step in &mut report.steps {
            step.path = format!("{base}{}", &step.path[self.base.len()..]);
        }
        report
    }

    fn stage_memory_size(&self) -> usize {
        work_memory_size(&self.work)
    }
}

fn work_memory_size(work: &WorkingClip) -> usize {
    let numbers = work.channels.iter().map(|channel| {
        let moved = channel.translations.as_ref().map_or(0, Vec::len);
        channel.rotations.len() * 4 + moved * 3
    });
    numbers.sum()
}

impl KeptStages {
    /// Returns the movement after a part, if it was evaluated before.
    pub(crate) fn find_kept_stage(
        &mut self,
        resolved: &ResolvedRecipe,
        base: &str,
        part: &DraftPart,
    ) -> Option<&DraftStage> {
        let stage_index = self
            .stages
            .iter()
            .position(|stage| stage.part == *part && stage.stage_holds_for(resolved, base))?;
        self.last = Some(stage_index);
        self.stages[stage_index].round = self.round;
        Some(&self.stages[stage_index])
    }

    /// Stores the movement after a part, with the report on that part.
    pub(crate) fn keep_draft_stage(
        &mut self,
        resolved: &ResolvedRecipe,
        base: &str,
        part: DraftPart,
        work: &WorkingClip,
        report: GenerationReport,
    ) {
        self.last = None;
        let kept_size: usize = self.stages.iter().map(DraftStage::stage_memory_size).sum();
        if kept_size + work_memory_size(work) > MAX_DRAFT_NUMBERS {
            // Entries that this evaluation has not used go first.
            let round = self.round;
            self.stages.retain(|stage| stage.round == round);
            if self.stages.iter().map(DraftStage::stage_memory_size).sum::<usize>() + work_memory_size(work)
                > MAX_DRAFT_NUMBERS
            {
                return;
            }
        }
        self.stages.push(DraftStage {
            given: part_answers(resolved, base, &part),
            part,
            base: base.to_owned(),
            work: work.clone(),
            contacts: None,
            report,
            round: self.round,
        });
        self.last = Some(self.stages.len() - 1);
    }

    /// Returns the stage that was stored or found last, if there is one.
    pub(crate) fn last_kept_stage(&mut self) -> Option<&mut DraftStage> {
        self.stages.get_mut(self.last?)
    }

    /// Begins another evaluation.
    pub(crate) fn begin_round(&mut self) {
        self.round += 1;
    }

    /// Discards what the last evaluation did not use.
    pub(crate) fn drop_unused(&mut self) {
        let round = self.round;
        self.stages.retain(|stage| stage.round == round);
        self.last = None;
    }
}
