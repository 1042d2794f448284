//! Evaluates a resolved recipe: generates its movement.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::answers::{NodeAnswers, RecipePath};
use crate::contact::{self, MovementContacts};
use crate::cue;
use crate::draft_stages::{DraftPart, KeptStages};
use crate::error::{MakeError, StepError};
use crate::ops::notated_operator::{self, NotationSpelling};
use crate::ops::{StepOutcome, point, spell, then};
use crate::outcome::{ChannelReport, GeneratedMovement, GenerationReport, StepReport};
use crate::recipe::*;
use crate::recipe_inputs::RecipeInput;
use crate::resolve::{JOIN_COURSE_SLOT, ResolvedRecipe, SIGN_MATERIAL_SLOT};
use crate::simplify::{self, PlannedStep};
use crate::sources::MovementMaterial;
use crate::speed::{self, StepSpeeds};
use crate::work::{JointGroup, WorkingClip};

/// The version of the evaluator. It rises whenever the same resolved recipe gives different movement, so that a
/// stored sign can be distinguished from one that would be generated today.
pub const ENGINE_VERSION: u32 = 26;

/// Generates the movement of a recipe.
///
/// The same resolved recipe gives the same movement, bit by bit, on the same machine.
///
/// # Errors
/// [`MakeError`] with the step that cannot be done, the reason, and a remedy.
pub fn evaluate_recipe(resolved: &ResolvedRecipe) -> Result<GeneratedMovement, MakeError> {
    evaluate_with_kept(resolved, None, &|| true)
}

/// Does the same as [`evaluate_recipe`], but reuses stored movement of parts from `kept`, and adds to it; stops between two
/// steps if `goes_on` returns false.
pub(crate) fn evaluate_with_kept(
    resolved: &ResolvedRecipe,
    kept: Option<&mut KeptStages>,
    goes_on: &dyn Fn() -> bool,
) -> Result<GeneratedMovement, MakeError> {
    let mut evaluator = RecipeEvaluator {
        resolved,
        kept,
        goes_on,
        inputs: &resolved.inputs.0,
        materials: &resolved.materials,
        report: GenerationReport::default(),
    };
    let work = evaluator.evaluate_node(&resolved.recipe.root, &RecipePath::default())?;
    let fault = |cause| MakeError {
        path: String::new(),
        step: resolved.recipe.to_string(),
        cause,
    };
    let mut report = evaluator.report;
    report.channels = JointGroup::ALL_JOINT_GROUPS
        .into_iter()
        .map(|group| ChannelReport {
            channel: group.joint_group_name(),
            from: work.from.get(&group).cloned().unwrap_or_default(),
        })
        .collect();
    let (anatomy, handedness) = (Arc::clone(&work.anatomy), work.handedness);
    let (signer, mut notes) = (work.signer.clone(), work.notes.clone());
    let curves = work.curves.clone();
    notes.sort_by_key(|note| (note.span.span_start_instant(), note.span.span_end_instant()));
    Ok(GeneratedMovement {
        clip: work.into_clip().map_err(|error| fault(error.into()))?,
        anatomy,
        handedness,
        signer,
        curves,
        notes,
        report,
    })
}

struct RecipeEvaluator<'a> {
    resolved: &'a ResolvedRecipe,
    kept: Option<&'a mut KeptStages>,
    goes_on: &'a dyn Fn() -> bool,
    inputs: &'a BTreeMap<String, RecipeInput>,
    materials: &'a BTreeMap<String, Arc<MovementMaterial>>,
    report: GenerationReport,
}

/// The lengths of the report's lists at some moment.
#[derive(Clone, Copy)]
struct ReportLengths {
    steps: usize,
    joins: usize,
    contacts: usize,
    warnings: usize,
}

impl<'a> RecipeEvaluator<'a> {
    fn evaluate_node(&mut self, node: &RecipeNode, path: &RecipePath) -> Result<WorkingClip, MakeError> {
        match node {
            RecipeNode::Pipe(pipe) => self.evaluate_pipe(pipe, path),
            RecipeNode::Then(then) => self.evaluate_chain(then, path),
            leaf => self.evaluate_source(leaf, path),
        }
    }

    fn evaluate_source(&mut self, leaf: &RecipeNode, path: &RecipePath) -> Result<WorkingClip, MakeError> {
        let part = DraftPart {
            of: leaf.clone(),
            steps: Vec::new(),
        };
        if let Some(work) = self.reuse_kept_work(path, &part) {
            return Ok(work);
        }
        let text = leaf.to_string();
        let mark = self.mark_report_lengths();
        match self
            .check_still_wanted()
            .and_then(|()| self.evaluate_leaf(leaf, path, &text))
        {
            Ok((work, done)) => {
                self.report_done_step(path, text, done);
                self.keep_evaluated_work(path, part, &work, mark);
                Ok(work)
            }
            Err(cause) => Err(MakeError {
                path: path.to_string(),
                step: text,
                cause,
            }),
        }
    }

    fn evaluate_pipe(&mut self, pipe: &OperatorPipe, path: &RecipePath) -> Result<WorkingClip, MakeError> {
        let mark = self.mark_report_lengths();
        let plan = simplify::plan_effective_steps(&pipe.steps);
        let part = |count: usize| DraftPart {
            of: (*pipe.of).clone(),
            steps: plan[..count].to_vec(),
        };
        let prefix_lengths = (1..=plan.len()).rev();
        let plan_prefixes = prefix_lengths.map(|count| (part(count), count));
        let mut kept_prefix = None;
        if self.kept.is_some() {
            for (part, count) in plan_prefixes {
                kept_prefix = self.reuse_kept_work(path, &part).map(|work| (work, count));
                if kept_prefix.is_some() {
                    break;
                }
            }
        }
        let (mut work, taken) = match kept_prefix {
            Some(found) => found,
            None => (self.evaluate_node(&pipe.of, &path.operand_path())?, 0),
        };
        for (count, PlannedStep { index, step }) in plan.iter().enumerate().skip(taken) {
            let step_path = path.operator_step_path(*index);
            let text = step.to_string();
            let wanted = self.check_still_wanted();
            match wanted.and_then(|()| self.evaluate_step(&mut work, step, &step_path, &text)) {
                Ok(done) => {
                    self.report_done_step(&step_path, text, done);
                    self.keep_evaluated_work(path, part(count + 1), &work, mark);
                }
                Err(cause) => {
                    return Err(MakeError {
                        path: step_path.to_string(),
                        step: text,
                        cause,
                    });
                }
            }
        }
        if plan.len() < pipe.steps.len() {
            let less = pipe.steps.len() - plan.len();
            let did = format!("operators left out, as they cancel out or become one: {less}");
            self.report.warnings.push(did);
        }
        Ok(work)
    }

    fn evaluate_chain(&mut self, then: &RecipeChain, path: &RecipePath) -> Result<WorkingClip, MakeError> {
        let mark = self.mark_report_lengths();
        let mut kept_prefix = None;
        if self.kept.is_some() {
            for count in (1..=then.next.len()).rev() {
                let work = self.reuse_kept_work(path, &DraftPart::utterance_pieces_part(then, count));
                kept_prefix = work.map(|work| (work, count));
                if kept_prefix.is_some() {
                    break;
                }
            }
        }
        let (mut work, taken) = match kept_prefix {
            Some(found) => found,
            None => (self.evaluate_node(&then.first, &path.first_piece_path())?, 0),
        };
        for (n, joined) in then.next.iter().enumerate().skip(taken) {
            let joined_path = path.later_piece_path(n);
            let next = self.evaluate_node(&joined.node, &joined_path.inner_piece_path())?;
            let text = format!("then{} {}", joined.via, joined.node);
            let then_joined = self.check_still_wanted();
            match then_joined.and_then(|()| self.join_next_work(&mut work, next, joined, &joined_path, &text)) {
                Ok(done) => {
                    self.report_done_step(&joined_path, text, done);
                    self.keep_evaluated_work(path, DraftPart::utterance_pieces_part(then, n + 1), &work, mark);
                }
                Err(cause) => {
                    return Err(MakeError {
                        path: joined_path.to_string(),
                        step: text,
                        cause,
                    });
                }
            }
        }
        Ok(work)
    }

    fn check_still_wanted(&self) -> Result<(), StepError> {
        (self.goes_on)().then_some(()).ok_or(StepError::Stopped)
    }

    fn mark_report_lengths(&self) -> ReportLengths {
        ReportLengths {
            steps: self.report.steps.len(),
            joins: self.report.joins.len(),
            contacts: self.report.contacts.len(),
            warnings: self.report.warnings.len(),
        }
    }

    /// Returns the stored movement after a part, if any, and adds its report again.
    fn reuse_kept_work(&mut self, path: &RecipePath, part: &DraftPart) -> Option<WorkingClip> {
        let path = path.as_str();
        let stage = self.kept.as_mut()?.find_kept_stage(self.resolved, path, part)?;
        let report = stage.report_at(path);
        self.report.steps.extend(report.steps);
        self.report.joins.extend(report.joins);
        self.report.contacts.extend(report.contacts);
        self.report.warnings.extend(report.warnings);
        Some(stage.work.clone())
    }

    fn keep_evaluated_work(&mut self, path: &RecipePath, part: DraftPart, work: &WorkingClip, mark: ReportLengths) {
        let Some(kept) = &mut self.kept else { return };
        let report = GenerationReport {
            steps: self.report.steps[mark.steps..].to_vec(),
            channels: Vec::new(),
            joins: self.report.joins[mark.joins..].to_vec(),
            contacts: self.report.contacts[mark.contacts..].to_vec(),
            warnings: self.report.warnings[mark.warnings..].to_vec(),
        };
        kept.keep_draft_stage(self.resolved, path.as_str(), part, work, report);
    }

    /// Returns the contacts in the movement after the last step; they are computed once.
    fn current_contacts(&mut self, work: &WorkingClip) -> MovementContacts {
        let Some(stage) = self.kept.as_mut().and_then(|kept| kept.last_kept_stage()) else {
            return contact::find_contacts(work);
        };
        let stage_contacts = stage.contacts.get_or_insert_with(|| contact::find_contacts(work));
        stage_contacts.clone()
    }

    fn report_done_step(&mut self, path: &RecipePath, step: String, done: StepOutcome) {
        let lost = done.lost.iter().map(|lost| format!("{step}: {lost}"));
        self.report.contacts.extend(lost);
        self.report.joins.extend(done.joins);
        self.report.warnings.extend(done.warnings);
        if let Some(residual) = done.residual.filter(|residual| *residual > 1e-3) {
            self.report.warnings.push(format!(
                "{step}: a hand stays up to {:.1} cm from its target",
                residual * 100.0
            ));
        }
        self.report.steps.push(StepReport {
            path: path.to_string(),
            step,
            did: done.did,
            residual: done.residual,
            moved: done.moved,
            language: done.language,
            hands: done.hands,
            touches: done.touches,
        });
    }

    fn evaluate_leaf(
        &mut self,
        leaf: &RecipeNode,
        path: &RecipePath,
        text: &str,
    ) -> Result<(WorkingClip, StepOutcome), StepError> {
        let mut given = self.given_answers(path, text);
        let (work, mut done) = match leaf {
            RecipeNode::Sign(_) => {
                let material = given.answered_material(&SIGN_MATERIAL_SLOT)?;
                let clip = &material.clip;
                let did = format!(
                    "{} ({:?}), {} frames at {}",
                    material.address,
                    material.gloss,
                    clip.clip_frame_count(),
                    clip.clip_frame_rate()
                );
                let sign_body = given.required_answer(&SIGN_MATERIAL_SLOT)?.body.as_ref();
                let body = sign_body.map(|body| notated_operator::performed_by(&body.address));
                let did: Vec<String> = std::iter::once(did).chain(body).collect();
                (WorkingClip::working_clip_from(material), did.into())
            }
            RecipeNode::Spell(settings) => spell::generate_spelling(settings, &mut given)?,
            RecipeNode::Point(settings) => point::generate_pointing(settings, &mut given)?,
            RecipeNode::Cue(settings) => cue::leaf::generate_cue_movement(settings, &mut given)?,
            RecipeNode::Hamnosys(_) => NotationSpelling::Hamnosys.generate_from_notation(&mut given)?,
            RecipeNode::Sigml(_) => NotationSpelling::Sigml.generate_from_notation(&mut given)?,
            RecipeNode::Pipe(_) | RecipeNode::Then(_) => return Err(StepError::Input),
        };
        done.did.append(&mut given.aside);
        Ok((work, done))
    }

    fn evaluate_step(
        &mut self,
        work: &mut WorkingClip,
        step: &Step,
        path: &RecipePath,
        text: &str,
    ) -> Result<StepOutcome, StepError> {
        let mut given = self.given_answers(path, text);
        let operator = step.operator();
        let before = StepSpeeds::peak_speeds(work);
        let longer = operator.make_time(work)?;
        let contact_rule = operator.contact_effect_for(work.handedness);
        let mut touched = contact_rule.map(|(carry, keep)| {
            let before = match longer {
                Some(_) => contact::find_contacts(work),
                None => self.current_contacts(work),
            };
            (before, carry, keep)
        });
        let mut done = operator.apply_operator(work, &mut given)?;
        done.did.extend(longer);
        if let Some((before, carry, keep)) = &mut touched {
            let kept = contact::restore_contacts(work, before, *keep, text);
            done.did.extend(kept);
            done.lost.extend(contact::describe_lost_contacts(before, work, *carry));
            done.warnings.extend(contact::long_repairs(before, text));
        }
        let added = speed::check_added(before, StepSpeeds::peak_speeds(work))?;
        let warnings = added.iter().map(|added| format!("{text}: {added}"));
        done.warnings.extend(warnings);
        done.did.append(&mut given.aside);
        Ok(done)
    }

    fn given_answers<'b>(&self, path: &'b RecipePath, text: &'b str) -> NodeAnswers<'b>
    where
        'a: 'b,
    {
        NodeAnswers {
            inputs: self.inputs,
            materials: self.materials,
            path,
            text,
            aside: Vec::new(),
        }
    }

    fn join_next_work(
        &self,
        work: &mut WorkingClip,
        next: WorkingClip,
        joined: &JoinedPiece,
        path: &RecipePath,
        text: &str,
    ) -> Result<StepOutcome, StepError> {
        let mut given = self.given_answers(path, text);
        let course = given.transition_courses(&JOIN_COURSE_SLOT, &joined.via, TransitionProfile::Sigmoid)?;
        let mut done: StepOutcome = then::append_next_work(work, next, joined.via.time, &course, text)?.into();
        done.did.append(&mut given.aside);
        Ok(done)
    }
}
