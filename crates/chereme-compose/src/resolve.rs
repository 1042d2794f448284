//! Finds and records everything a recipe needs from the outside, so that it gives the same movement again.

mod former_part;

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_motion::BodySide;

use crate::answers::{AnswerSlot, CorpusAsker, RecipeAnswers, RecipePath};
use crate::cue::{self};
use crate::error::{MakeError, StepError};
use crate::ops::notated_operator::NotationSpelling;
use crate::ops::on_body::ON_BODY_SLOT;
use crate::ops::{point, spell};
use crate::recipe::*;
use crate::recipe_inputs::{MaterialInput, RecipeInput, RecipeInputs};
use crate::sources::{LearnedProfile, MaterialSigner, MovementMaterial, RecipeSources};

use former_part::FormerPart;

/// The movement of a sign.
pub(crate) const SIGN_MATERIAL_SLOT: AnswerSlot<MaterialInput> = AnswerSlot::new("sign");
/// The learned courses of the transition from one piece to the next.
pub(crate) const JOIN_COURSE_SLOT: AnswerSlot<LearnedProfile> = AnswerSlot::new("via");

/// A recipe with all its inputs.
#[derive(Debug, Clone)]
pub struct ResolvedRecipe {
    pub(crate) recipe: Recipe,
    pub(crate) inputs: RecipeInputs,
    pub(crate) materials: BTreeMap<String, Arc<MovementMaterial>>,
}

impl ResolvedRecipe {
    /// Returns the chosen inputs, to be stored with the recipe.
    #[must_use]
    pub fn resolved_inputs(&self) -> &RecipeInputs {
        &self.inputs
    }

    /// Returns the chosen inputs below a path of the recipe.
    pub(crate) fn inputs_below_path(&self, base: &str) -> impl Iterator<Item = (&String, &RecipeInput)> {
        let from = self.inputs.0.range(base.to_owned()..);
        let base = base.to_owned();
        let rest = move |path: &str| path.strip_prefix(base.as_str()).map(|tail| tail.starts_with('/'));
        let rest_copy = rest.clone();
        from.take_while(move |(path, _)| rest_copy(path).is_some())
            .filter(move |(path, _)| rest(path) == Some(true))
    }
}

/// Finds everything that `recipe` needs: sources, values, answers to queries, spans.
///
/// # Errors
/// [`MakeError`] with the step for which nothing was found, and a remedy.
pub fn resolve_recipe(recipe: &Recipe, sources: &dyn RecipeSources) -> Result<ResolvedRecipe, MakeError> {
    resolve_after_change(recipe, sources, None)
}

/// Does the same as [`resolve_recipe`], but reuses the answers in `before` for unchanged parts of the recipe.
pub(crate) fn resolve_after_change(
    recipe: &Recipe,
    sources: &dyn RecipeSources,
    before: Option<&ResolvedRecipe>,
) -> Result<ResolvedRecipe, MakeError> {
    let mut resolver = RecipeResolver {
        sources,
        before,
        answers: RecipeAnswers::default(),
        takes_faces: false,
    };
    let former = before.map(|before| FormerPart::from_former_recipe(&before.recipe));
    resolver.resolve_node(&recipe.root, &RecipePath::default(), former)?;
    let RecipeAnswers { inputs, materials } = resolver.answers;
    Ok(ResolvedRecipe {
        recipe: recipe.clone(),
        inputs,
        materials,
    })
}

struct RecipeResolver<'a> {
    sources: &'a dyn RecipeSources,
    before: Option<&'a ResolvedRecipe>,
    answers: RecipeAnswers,
    /// Whether the next sign gets expressions only.
    takes_faces: bool,
}

/// The least rotation of a joint that counts as movement, in radians.
const LEAST_TURN: f64 = 0.01;
/// The least shift of a joint against the one above it that counts as movement, in metres.
const LEAST_SHIFT: f64 = 1e-3;

/// What a recording of a face lacks for most operators.
const FACE_ONLY: &str = "it shows a face only";

/// Returns what a piece lacks in which no joint of arms or fingers moves: it can only be a body that stands still.
fn still_hands(material: &MovementMaterial) -> Option<&'static str> {
    let anatomy = &material.anatomy;
    let joint_lists = BodySide::BOTH_SIDES.map(|side| [anatomy.arm_joints(side), anatomy.finger_joints(side)].concat());
    let joints = joint_lists.concat();
    let moves = |joint: &usize| {
        let channel = material.clip.joint_channel(*joint);
        let (turns, places) = (&channel.rotations, channel.translations.iter().flatten());
        let first = channel.translations.as_ref().and_then(|places| places.first());
        let turned = turns.iter().any(|turn| turn.angle_between(turns[0]) > LEAST_TURN);
        turned
            || places
                .zip(first.into_iter().cycle())
                .any(|(at, first)| at.distance(*first) > LEAST_SHIFT)
    };
    if material.clip.clip_frame_count() == 0 || joints.iter().any(moves) {
        return None;
    }
    Some(if joints.is_empty() {
        "its skeleton has no arms"
    } else if !material.curves.is_empty() {
        FACE_ONLY
    } else {
        "all joints of its arms and fingers stand still"
    })
}

/// Returns the slot in which a source stores its initial movement.
fn body_of(leaf: &RecipeNode) -> Option<AnswerSlot<MaterialInput>> {
    Some(match leaf {
        RecipeNode::Sign(_) => SIGN_MATERIAL_SLOT,
        RecipeNode::Spell(_) => spell::SPELL_BODY_SLOT,
        RecipeNode::Point(_) => point::POINT_BODY_SLOT,
        RecipeNode::Cue(_) => cue::leaf::CUE_BODY_SLOT,
        RecipeNode::Hamnosys(_) => NotationSpelling::Hamnosys.notation_body_slot(),
        RecipeNode::Sigml(_) => NotationSpelling::Sigml.notation_body_slot(),
        RecipeNode::Pipe(_) | RecipeNode::Then(_) => return None,
    })
}

impl RecipeResolver<'_> {
    /// Copies the answers for a part at `from` to `to`.
    fn copy_part_answers(&mut self, from: &RecipePath, to: &RecipePath) {
        let Some(before) = self.before else { return };
        for (path, input) in before.inputs_below_path(from.as_str()) {
            let now = format!("{to}{}", &path[from.as_str().len()..]);
            if let Some(material) = before.materials.get(path) {
                let material = Arc::clone(material);
                self.answers.materials.insert(now.clone(), material);
            }
            self.answers.inputs.0.insert(now, input.clone());
        }
    }

    /// Reuses the earlier answer for a source that has not changed.
    fn source_again(
        &mut self,
        leaf: &RecipeNode,
        path: &RecipePath,
        former: Option<FormerPart<'_>>,
    ) -> Option<MaterialSigner> {
        let former = former?.first_former_source();
        if !former.is_same_node(leaf) {
            return None;
        }
        self.copy_part_answers(&former.path, path);
        let body = self.answers.materials.get(&body_of(leaf)?.slot_path_at(path));
        body.map(|material| MaterialSigner::signer_from_material(material))
    }

    fn resolve_node(
        &mut self,
        node: &RecipeNode,
        path: &RecipePath,
        former: Option<FormerPart<'_>>,
    ) -> Result<MaterialSigner, MakeError> {
        match node {
            RecipeNode::Pipe(pipe) => self.resolve_pipe(pipe, path, former),
            RecipeNode::Then(then) => self.resolve_chain(then, path, former),
            leaf => {
                if let Some(setting) = self.source_again(leaf, path, former) {
                    return Ok(setting);
                }
                let source_setting = self.resolve_source(leaf, path);
                source_setting.map_err(|cause| MakeError {
                    path: path.to_string(),
                    step: leaf.to_string(),
                    cause,
                })
            }
        }
    }

    fn resolve_source(&mut self, leaf: &RecipeNode, path: &RecipePath) -> Result<MaterialSigner, StepError> {
        let takes_faces = self.takes_faces;
        let mut ask = self.ask_at_path(path);
        match leaf {
            RecipeNode::Sign(address) => {
                let material = ask.sources.find_material(address)?;
                // A face alone can get the expressions of another one.
                if let Some(what) = still_hands(&material)
                    && !(what == FACE_ONLY && takes_faces)
                {
                    let address = material.address;
                    return Err(StepError::HandsStill { address, what });
                }
                ask.keep_movement(&SIGN_MATERIAL_SLOT, material)
            }
            RecipeNode::Spell(settings) => spell::resolve_spelling_inputs(settings, &mut ask),
            RecipeNode::Point(settings) => point::resolve_pointing_inputs(settings, &mut ask),
            RecipeNode::Cue(settings) => cue::leaf::resolve_cue_inputs(settings, &mut ask),
            RecipeNode::Hamnosys(settings) => NotationSpelling::Hamnosys.resolve_notation_inputs(settings, &mut ask),
            RecipeNode::Sigml(settings) => NotationSpelling::Sigml.resolve_notation_inputs(settings, &mut ask),
            RecipeNode::Pipe(_) | RecipeNode::Then(_) => Err(StepError::Input),
        }
    }

    fn resolve_pipe(
        &mut self,
        pipe: &OperatorPipe,
        path: &RecipePath,
        former: Option<FormerPart<'_>>,
    ) -> Result<MaterialSigner, MakeError> {
        let of = former.as_ref().map(FormerPart::former_operand);
        let same = of.as_ref().is_some_and(|of| of.is_same_node(&pipe.of));
        let on_faces = |step: &Step| matches!(step, Step::Nonmanual(_) | Step::Face(_));
        let is_sign = matches!(*pipe.of, RecipeNode::Sign(_));
        // A sign that is only given a face may be one without movement.
        self.takes_faces = is_sign && pipe.steps.iter().all(on_faces);
        let mut setting = self.resolve_node(&pipe.of, &path.operand_path(), of)?;
        self.takes_faces = false;
        for (n, step) in pipe.steps.iter().enumerate() {
            let path = path.operator_step_path(n);
            let same_former = former.as_ref().filter(|_| same);
            // An unchanged step keeps its choices, so that editing one card does not change what others show.
            if let Some(known) = same_former.and_then(|former| former.former_step_path(step)) {
                self.copy_part_answers(&known, &path);
            } else {
                let resolved_step = step
                    .operator()
                    .resolve_operator_inputs(&mut self.ask_at_path(&path), &setting);
                resolved_step.map_err(|cause| MakeError {
                    path: path.to_string(),
                    step: step.to_string(),
                    cause,
                })?;
            }
            // Later steps look for postures of the signer whose body moves then.
            if let Some(body) = self.answers.materials.get(&ON_BODY_SLOT.slot_path_at(&path)) {
                setting.signer.clone_from(&body.signer);
            }
        }
        Ok(setting)
    }

    fn resolve_chain(
        &mut self,
        then: &RecipeChain,
        path: &RecipePath,
        former: Option<FormerPart<'_>>,
    ) -> Result<MaterialSigner, MakeError> {
        let first = former.as_ref().map(FormerPart::first_former_piece);
        let setting = self.resolve_node(&then.first, &path.first_piece_path(), first)?;
        for (n, joined) in then.next.iter().enumerate() {
            let joined_path = path.later_piece_path(n);
            let piece = former.as_ref().and_then(|former| former.find_former_piece(joined, n));
            self.resolve_node(&joined.node, &joined_path.inner_piece_path(), piece)?;
            let course_answer = self
                .ask_at_path(&joined_path)
                .ask_learned_courses(&JOIN_COURSE_SLOT, &joined.via);
            course_answer.map_err(|cause| MakeError {
                path: path.to_string(),
                step: RecipeNode::Then(then.clone()).to_string(),
                cause,
            })?;
        }
        Ok(setting)
    }

    fn ask_at_path<'a>(&'a mut self, path: &'a RecipePath) -> CorpusAsker<'a> {
        CorpusAsker {
            sources: self.sources,
            path,
            answers: &mut self.answers,
        }
    }
}
