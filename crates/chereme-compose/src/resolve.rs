//! Finds and records everything a recipe needs from the outside, so that it gives the same movement again.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_motion::Side;
use chereme_sign::Handedness;
use chereme_sign::hamnosys::Notated;
use chereme_sign::milestones::{Function, Milestones};
use serde::{Deserialize, Serialize};

use crate::answers::{Answers, Ask, Path, Setting, Slot};
use crate::cue::{self, CuePhases};
use crate::draft::Former;
use crate::error::{Cause, MakeError};
use crate::language::Language;
use crate::ops::notated::Written;
use crate::ops::{point, spell};
use crate::poses::HandPose;
use crate::recipe::*;
use crate::sources::{
    HeldValue, LearnedProfile, Letter, Material, Sources, Spatial, SpellingTimes,
};

/// The movement of a sign.
pub(crate) const SIGN: Slot<MaterialInput> = Slot::new("sign");
/// The learned courses of the transition from one piece to the next.
pub(crate) const JOIN: Slot<LearnedProfile> = Slot::new("via");

/// A recipe with all its inputs.
#[derive(Debug, Clone)]
pub struct Resolved {
    pub(crate) recipe: Recipe,
    pub(crate) inputs: Inputs,
    pub(crate) materials: BTreeMap<String, Arc<Material>>,
}

impl Resolved {
    /// Returns the recipe.
    #[must_use]
    pub fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    /// Returns the chosen inputs, to be stored with the recipe; see [`restore`].
    #[must_use]
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Returns the chosen inputs below a path of the recipe.
    pub(crate) fn below(&self, base: &str) -> impl Iterator<Item = (&String, &Input)> {
        let from = self.inputs.0.range(base.to_owned()..);
        let base = base.to_owned();
        let rest = move |path: &str| {
            path.strip_prefix(base.as_str())
                .map(|it| it.starts_with('/'))
        };
        let held = rest.clone();
        from.take_while(move |(path, _)| held(path).is_some())
            .filter(move |(path, _)| rest(path) == Some(true))
    }
}

/// The chosen inputs of a recipe, by their paths in the recipe's JSON.
///
/// Spans, poses and places are stored here, so that better annotation, a better detector or new recordings never change
/// a sign that was generated before.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Inputs(pub BTreeMap<String, Input>);

/// The choice for one path in a recipe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Input {
    /// A source of movement.
    Material(MaterialInput),
    /// Postures of the hand.
    Poses(Vec<HandPose>),
    /// A place on or about the body.
    Place(PlaceInput),
    /// The letters of a word.
    Letters(Vec<LetterInput>),
    /// Signs as notation.
    Notation(Vec<Notated>),
    /// Body language that differs from the default one.
    Language(Language),
    /// Learned courses of transitions: the progress of arms and fingers over time.
    Courses(LearnedProfile),
    /// The times of held letters, and of the change from one to the next.
    Times(SpellingTimes),
    /// Measured phases of cued speech.
    Phases(CuePhases),
    /// An expression of the face.
    Expression(ExpressionInput),
}

impl Input {
    /// Returns the addresses of the signs that gave postures or a place, but no movement.
    #[must_use]
    pub fn givers(&self) -> Vec<&str> {
        match self {
            Self::Poses(poses) => poses.iter().filter_map(HandPose::giver).collect(),
            Self::Letters(letters) => {
                let poses = letters.iter().map(|letter| &letter.pose);
                poses.filter_map(HandPose::giver).collect()
            }
            Self::Place(place) => {
                let is_sign = ["token:", "recording:"];
                let sign = is_sign.iter().any(|it| place.from.starts_with(it));
                sign.then_some(place.from.as_str()).into_iter().collect()
            }
            _ => Vec::new(),
        }
    }
}

/// The expression of the face that was found for a recipe.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpressionInput {
    /// Its function in the signs that it spans.
    pub function: Function,
    /// Its milestones, from the first frame of its movement on.
    pub milestones: Milestones,
}

/// The source of movement that was found for a recipe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialInput {
    /// Its unambiguous address.
    pub address: String,
    /// The hash of its movement.
    pub hash: String,
    /// Its gloss.
    pub gloss: String,
    /// The hand with which its signer signs.
    pub handedness: Handedness,
    /// Its component values.
    pub held: Vec<HeldValue>,
    /// The body that performs it, if it is a notation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<BodyInput>,
}

/// The body that was found for a notation.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyInput {
    /// Its unambiguous address.
    pub address: String,
    /// The hash of its posture.
    pub hash: String,
}

/// The place that was found for a recipe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaceInput {
    /// The value, if it belongs to an inventory.
    pub value: Option<String>,
    /// The inventory or sign that gives it.
    pub from: String,
    /// The position.
    pub at: Spatial,
}

/// A letter with the posture chosen for it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LetterInput {
    /// The letter.
    pub letter: Letter,
    /// The hand's posture.
    pub pose: HandPose,
}

/// Finds everything that `recipe` needs: sources, values, answers to queries, spans.
///
/// # Errors
/// [`MakeError`] with the step for which nothing was found, and a remedy.
pub fn resolve(recipe: &Recipe, sources: &dyn Sources) -> Result<Resolved, MakeError> {
    after(recipe, sources, None)
}

/// Does the same as [`resolve`], but reuses the answers in `before` for unchanged parts of the recipe.
pub(crate) fn after(
    recipe: &Recipe,
    sources: &dyn Sources,
    before: Option<&Resolved>,
) -> Result<Resolved, MakeError> {
    let mut resolver = Resolver {
        sources,
        before,
        answers: Answers::default(),
        takes_faces: false,
    };
    let former = before.map(|before| Former::of(&before.recipe));
    resolver.node(&recipe.root, &Path::default(), former)?;
    let Answers { inputs, materials } = resolver.answers;
    Ok(Resolved {
        recipe: recipe.clone(),
        inputs,
        materials,
    })
}

/// Restores earlier choices: loads the movement that `inputs` name and nothing else.
///
/// # Errors
/// [`MakeError`] if a source is gone or its movement has changed.
pub fn restore(
    recipe: &Recipe,
    inputs: Inputs,
    sources: &dyn Sources,
) -> Result<Resolved, MakeError> {
    let mut materials = BTreeMap::new();
    for (path, input) in &inputs.0 {
        let Input::Material(stored) = input else {
            continue;
        };
        let fault = |cause| MakeError {
            path: path.clone(),
            step: stored.address.clone(),
            cause,
        };
        let mut material = sources
            .material(&stored.address)
            .map_err(|error| fault(error.into()))?;
        if material.hash != stored.hash {
            let address = stored.address.clone();
            return Err(fault(Cause::Changed { address }));
        }
        if material.clip.frames() == 0 {
            return Err(fault(Cause::Empty(material.address)));
        }
        material.held.clone_from(&stored.held);
        material.gloss.clone_from(&stored.gloss);
        material.handedness = stored.handedness;
        materials.insert(path.clone(), Arc::new(material));
    }
    Ok(Resolved {
        recipe: recipe.clone(),
        inputs,
        materials,
    })
}

struct Resolver<'a> {
    sources: &'a dyn Sources,
    before: Option<&'a Resolved>,
    answers: Answers,
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
fn still_hands(material: &Material) -> Option<&'static str> {
    let anatomy = &material.anatomy;
    let joints = Side::BOTH.map(|side| [anatomy.arm_joints(side), anatomy.fingers(side)].concat());
    let joints = joints.concat();
    let moves = |joint: &usize| {
        let channel = material.clip.channel(*joint);
        let (turns, places) = (&channel.rotations, channel.translations.iter().flatten());
        let first = channel
            .translations
            .as_ref()
            .and_then(|places| places.first());
        let turned = turns
            .iter()
            .any(|turn| turn.angle_between(turns[0]) > LEAST_TURN);
        turned
            || places
                .zip(first.into_iter().cycle())
                .any(|(at, first)| at.distance(*first) > LEAST_SHIFT)
    };
    if material.clip.frames() == 0 || joints.iter().any(moves) {
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
fn body_of(leaf: &Node) -> Option<Slot<MaterialInput>> {
    Some(match leaf {
        Node::Sign(_) => SIGN,
        Node::Spell(_) => spell::BODY,
        Node::Point(_) => point::BODY,
        Node::Cue(_) => cue::leaf::BODY,
        Node::Hamnosys(_) => Written::Hamnosys.body(),
        Node::Sigml(_) => Written::Sigml.body(),
        Node::Pipe(_) | Node::Then(_) => return None,
    })
}

impl Resolver<'_> {
    /// Copies the answers for a part at `from` to `to`.
    fn again(&mut self, from: &Path, to: &Path) {
        let Some(before) = self.before else { return };
        for (path, input) in before.below(from.as_str()) {
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
        leaf: &Node,
        path: &Path,
        former: Option<Former<'_>>,
    ) -> Option<Setting> {
        let former = former?.source();
        if !former.is(leaf) {
            return None;
        }
        self.again(&former.path, path);
        let body = self.answers.materials.get(&body_of(leaf)?.at(path));
        body.map(|it| Setting::of(it))
    }

    fn node(
        &mut self,
        node: &Node,
        path: &Path,
        former: Option<Former<'_>>,
    ) -> Result<Setting, MakeError> {
        match node {
            Node::Pipe(pipe) => self.pipe(pipe, path, former),
            Node::Then(then) => self.chain(then, path, former),
            leaf => {
                if let Some(setting) = self.source_again(leaf, path, former) {
                    return Ok(setting);
                }
                let found = self.source(leaf, path);
                found.map_err(|cause| MakeError {
                    path: path.to_string(),
                    step: leaf.to_string(),
                    cause,
                })
            }
        }
    }

    fn source(&mut self, leaf: &Node, path: &Path) -> Result<Setting, Cause> {
        let takes_faces = self.takes_faces;
        let mut ask = self.ask(path);
        match leaf {
            Node::Sign(address) => {
                let material = ask.sources.material(address)?;
                // A face alone can get the expressions of another one.
                if let Some(what) = still_hands(&material)
                    && !(what == FACE_ONLY && takes_faces)
                {
                    let address = material.address;
                    return Err(Cause::HandsStill { address, what });
                }
                ask.keep(&SIGN, material)
            }
            Node::Spell(settings) => spell::resolve(settings, &mut ask),
            Node::Point(settings) => point::resolve(settings, &mut ask),
            Node::Cue(settings) => cue::leaf::resolve(settings, &mut ask),
            Node::Hamnosys(settings) => Written::Hamnosys.resolve(settings, &mut ask),
            Node::Sigml(settings) => Written::Sigml.resolve(settings, &mut ask),
            Node::Pipe(_) | Node::Then(_) => Err(Cause::Input),
        }
    }

    fn pipe(
        &mut self,
        pipe: &Pipe,
        path: &Path,
        former: Option<Former<'_>>,
    ) -> Result<Setting, MakeError> {
        let of = former.as_ref().map(Former::operated);
        let same = of.as_ref().is_some_and(|of| of.is(&pipe.of));
        let on_faces = |step: &Step| matches!(step, Step::Nonmanual(_));
        let is_sign = matches!(*pipe.of, Node::Sign(_));
        self.takes_faces = is_sign && pipe.steps.iter().all(on_faces);
        let setting = self.node(&pipe.of, &path.operand(), of)?;
        self.takes_faces = false;
        for (n, step) in pipe.steps.iter().enumerate() {
            let path = path.step(n);
            let known = former.as_ref().filter(|_| same);
            if let Some(known) = known.and_then(|former| former.step(step)) {
                self.again(&known, &path);
                continue;
            }
            let found = step.operator().resolve(&mut self.ask(&path), &setting);
            found.map_err(|cause| MakeError {
                path: path.to_string(),
                step: step.to_string(),
                cause,
            })?;
        }
        Ok(setting)
    }

    fn chain(
        &mut self,
        then: &Then,
        path: &Path,
        former: Option<Former<'_>>,
    ) -> Result<Setting, MakeError> {
        let first = former.as_ref().map(Former::first);
        let setting = self.node(&then.first, &path.first(), first)?;
        for (n, joined) in then.next.iter().enumerate() {
            let at = path.joined(n);
            let piece = former.as_ref().and_then(|former| former.piece(joined, n));
            self.node(&joined.node, &at.piece(), piece)?;
            let found = self.ask(&at).course(&JOIN, &joined.via);
            found.map_err(|cause| MakeError {
                path: path.to_string(),
                step: Node::Then(then.clone()).to_string(),
                cause,
            })?;
        }
        Ok(setting)
    }

    fn ask<'a>(&'a mut self, path: &'a Path) -> Ask<'a> {
        Ask {
            sources: self.sources,
            path,
            answers: &mut self.answers,
        }
    }
}
