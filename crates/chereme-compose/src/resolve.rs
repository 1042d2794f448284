//! Fixing everything a recipe asks of the world, so that it can be made again and again alike.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_motion::Side;
use chereme_sign::hamnosys::{self, Notated};
use chereme_sign::milestones::{Function, Milestones};
use chereme_sign::{Component, Handedness};
use serde::{Deserialize, Serialize};

use crate::body;
use crate::cue::{CuePhases, PhaseRule};
use crate::draft::Former;
use crate::error::{Cause, MakeError};
use crate::language::Language;
use crate::poses::{self, HandPose};
use crate::recipe::*;
use crate::sources::{
    Held, LearnedProfile, Letter, Material, Meaning, Sources, Spatial, SpellingTimes,
};

/// A recipe with everything it needs.
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

    /// Returns what was chosen, to be stored beside the recipe; see [`restore`].
    #[must_use]
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Returns what was chosen below a path of the recipe.
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

/// The choices for each place in a recipe, by its path in the recipe's JSON.
///
/// Spans, poses and places are held here as they were, so that better annotation, a better
/// detector or new recordings never change a sign that was made before.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Inputs(pub BTreeMap<String, Input>);

/// The choice for one place in a recipe.
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
    /// Body language that differs from the usual one.
    Language(Language),
    /// Learned courses.
    Courses(LearnedProfile),
    /// How long letters are held, and how long the hand takes from one to the next.
    Times(SpellingTimes),
    /// Measured phases of cued speech.
    Phases(CuePhases),
    /// An expression of the face.
    Expression(ExpressionInput),
}

/// An expression of the face as it was found.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpressionInput {
    /// Its function in the signs that it spans.
    pub function: Function,
    /// Its milestones, from the first frame of its movement on.
    pub milestones: Milestones,
}

/// A source of movement as it was found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialInput {
    /// Its address without doubt.
    pub address: String,
    /// The hash of its movement.
    pub hash: String,
    /// What it was called.
    pub gloss: String,
    /// Which hand its signer signs with.
    pub handedness: Handedness,
    /// The values it held.
    pub held: Vec<Held>,
}

/// A place as it was found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaceInput {
    /// The value, if it belongs to an inventory.
    pub value: Option<String>,
    /// The inventory or sign it comes from.
    pub from: String,
    /// Where it is.
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
/// [`MakeError`] naming the step for which there is nothing, with what would work.
pub fn resolve(recipe: &Recipe, sources: &dyn Sources) -> Result<Resolved, MakeError> {
    after(recipe, sources, None)
}

/// As [`resolve`], but takes what `before` has for parts of the recipe that stayed as they were.
pub(crate) fn after(
    recipe: &Recipe,
    sources: &dyn Sources,
    before: Option<&Resolved>,
) -> Result<Resolved, MakeError> {
    let mut resolver = Resolver {
        sources,
        before,
        inputs: Inputs::default(),
        materials: BTreeMap::new(),
    };
    let former = before.map(|before| Former::of(&before.recipe));
    resolver.node(&recipe.root, String::new(), former)?;
    Ok(Resolved {
        recipe: recipe.clone(),
        inputs: resolver.inputs,
        materials: resolver.materials,
    })
}

/// Finds again what was chosen before: loads the movement that `inputs` name and nothing else.
///
/// # Errors
/// [`MakeError`] where a source is gone or its movement is no longer what it was.
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
    inputs: Inputs,
    materials: BTreeMap<String, Arc<Material>>,
}

/// Whose movement a step works on.
#[derive(Clone)]
pub(crate) struct Setting {
    pub(crate) signer: Option<String>,
    pub(crate) handedness: Handedness,
}

impl Setting {
    fn of(material: &Material) -> Self {
        Self {
            signer: material.signer.clone(),
            handedness: material.handedness,
        }
    }
}

/// The ends of the paths at which sources keep their movement.
const MATERIALS: [&str; 6] = ["sign", "spell", "point", "cue", "hamnosys", "sigml"];

impl Resolver<'_> {
    /// Takes over what was found for a part at `from`, now at `to`.
    fn again(&mut self, from: &str, to: &str) {
        let Some(before) = self.before else { return };
        for (path, input) in before.below(from) {
            let now = format!("{to}{}", &path[from.len()..]);
            if let Some(material) = before.materials.get(path) {
                self.materials.insert(now.clone(), Arc::clone(material));
            }
            self.inputs.0.insert(now, input.clone());
        }
    }

    /// Uses the earlier answer for a source that has not changed.
    fn source_again(
        &mut self,
        leaf: &Node,
        path: &str,
        former: Option<Former<'_>>,
    ) -> Option<Setting> {
        let former = former?.source();
        if !former.is(leaf) {
            return None;
        }
        self.again(&former.path, path);
        let mut ends = MATERIALS.iter().map(|end| format!("{path}/{end}"));
        ends.find_map(|end| self.materials.get(&end))
            .map(|it| Setting::of(it))
    }

    fn node(
        &mut self,
        node: &Node,
        path: String,
        former: Option<Former<'_>>,
    ) -> Result<Setting, MakeError> {
        let leaf = !matches!(node, Node::Pipe(_) | Node::Then(_));
        if leaf && let Some(setting) = self.source_again(node, &path, former.clone()) {
            return Ok(setting);
        }
        let fault = |cause| MakeError {
            path: path.clone(),
            step: node.to_string(),
            cause,
        };
        match node {
            Node::Sign(address) => {
                let material = self
                    .sources
                    .material(address)
                    .map_err(|e| fault(e.into()))?;
                self.keep(format!("{path}/sign"), material).map_err(fault)
            }
            Node::Spell(spell) => {
                let stage = self
                    .sources
                    .stage(spell.on.as_deref())
                    .map_err(|e| fault(e.into()))?;
                let setting = self.keep(format!("{path}/spell"), stage).map_err(fault)?;
                let letters = self.letters(spell, &setting).map_err(fault)?;
                let at = format!("{path}/spell/word");
                self.inputs.0.insert(at, Input::Letters(letters));
                if spell.hold.is_none() || spell.via.time.is_none() {
                    let times = self.sources.spelling_times();
                    let times = Input::Times(times.map_err(|e| fault(e.into()))?);
                    self.inputs.0.insert(format!("{path}/spell/hold"), times);
                }
                self.course(&spell.via, format!("{path}/spell/via"))
                    .map_err(fault)?;
                Ok(setting)
            }
            Node::Point(point) => {
                let stage = self
                    .sources
                    .stage(point.on.as_deref())
                    .map_err(|e| fault(e.into()))?;
                let setting = self.keep(format!("{path}/point"), stage).map_err(fault)?;
                if let Some(with) = &point.with {
                    let side = point.hand.sides(setting.handedness)[0];
                    let poses = poses::choose(self.sources, with, side, &setting).map_err(fault)?;
                    self.inputs
                        .0
                        .insert(format!("{path}/point/with"), Input::Poses(poses));
                }
                self.spot(&point.at, format!("{path}/point/at"))
                    .map_err(fault)?;
                self.course(&point.via, format!("{path}/point/via"))
                    .map_err(fault)?;
                Ok(setting)
            }
            Node::Cue(cue) => {
                let read = crate::cue::read(cue).map_err(fault)?;
                let stage = self
                    .sources
                    .stage(cue.on.as_deref())
                    .map_err(|e| fault(e.into()))?;
                let setting = self.keep(format!("{path}/cue"), stage).map_err(fault)?;
                let side = cue.hand.sides(setting.handedness)[0];
                let own = read.code.shapes.iter().map(|shape| &shape.configuration);
                let mut shapes = Vec::new();
                for name in std::iter::once(&read.code.rest.configuration).chain(own) {
                    let value = self.sources.value(Component::Configuration, name);
                    let value = value.map_err(|e| fault(e.into()))?;
                    shapes.push(self.shape_of_code(&value, side, &setting).map_err(fault)?);
                }
                let at = format!("{path}/cue/shapes");
                self.inputs.0.insert(at, Input::Poses(shapes));
                if cue.phase == PhaseRule::Measured {
                    let phases = self.sources.cue_phases().map_err(|e| fault(e.into()))?;
                    let phases = phases.ok_or_else(|| fault(Cause::NoPhases))?;
                    let at = format!("{path}/cue/by");
                    self.inputs.0.insert(at, Input::Phases(phases));
                }
                Ok(setting)
            }
            Node::Hamnosys(notation) => {
                let read = hamnosys::parse(&notation.of).map_err(|error| fault(error.into()))?;
                let notated = Notated {
                    sign: read.sign,
                    text: Some(notation.of.clone()),
                    ..Notated::default()
                };
                let at = format!("{path}/hamnosys");
                self.notation(at, vec![notated], notation).map_err(fault)
            }
            Node::Sigml(notation) => {
                let found = self.sources.notation(&notation.of);
                let found = found.map_err(|error| fault(error.into()))?;
                let at = format!("{path}/sigml");
                self.notation(at, found, notation).map_err(fault)
            }
            Node::Pipe(pipe) => {
                let of = former.as_ref().map(Former::operated);
                let same = of.as_ref().is_some_and(|of| of.is(&pipe.of));
                let setting = self.node(&pipe.of, format!("{path}/pipe/of"), of)?;
                for (n, step) in pipe.steps.iter().enumerate() {
                    let path = format!("{path}/pipe/steps/{n}");
                    let known = former.as_ref().filter(|_| same);
                    if let Some(known) = known.and_then(|former| former.step(step)) {
                        self.again(&known, &path);
                        continue;
                    }
                    self.step(step, &path, &setting)
                        .map_err(|cause| MakeError {
                            path,
                            step: step.to_string(),
                            cause,
                        })?;
                }
                Ok(setting)
            }
            Node::Then(then) => {
                let first = former.as_ref().map(Former::first);
                let setting = self.node(&then.first, format!("{path}/then/first"), first)?;
                for (n, joined) in then.next.iter().enumerate() {
                    let piece = former.as_ref().and_then(|former| former.piece(joined, n));
                    self.node(&joined.node, format!("{path}/then/next/{n}/node"), piece)?;
                    self.course(&joined.via, format!("{path}/then/next/{n}/via"))
                        .map_err(fault)?;
                }
                Ok(setting)
            }
        }
    }

    fn step(&mut self, step: &Step, path: &str, setting: &Setting) -> Result<(), Cause> {
        match step {
            Step::Configure(configure) => {
                for &side in configure.hand.sides(setting.handedness) {
                    for (n, choice) in configure.values.iter().enumerate() {
                        if *choice == Choice::Keep {
                            continue;
                        }
                        let poses = poses::choose(self.sources, choice, side, setting)?;
                        let at = format!("{path}/configure/values/{n}/{}", side.name());
                        self.inputs.0.insert(at, Input::Poses(poses));
                    }
                }
                self.course(&configure.via, format!("{path}/configure/via"))
            }
            Step::Place(place) => {
                let at = format!("{path}/place/to");
                let found = match &place.to {
                    Goal::By(_) | Goal::AtPoint(_) => return Ok(()),
                    Goal::At(value) => self.place(value)?,
                    Goal::Near { of, .. } => {
                        let material = self.sources.material(of)?;
                        place_of(&material, place, setting)?
                    }
                    Goal::Best(query) => {
                        let signer = setting.signer.as_deref();
                        let found = self.sources.best(query, signer)?;
                        let Some(first) = found.first() else {
                            return Err(Cause::NothingFound(query.clone()));
                        };
                        let material = self.sources.material(&first.address)?;
                        place_of(&material, place, setting)?
                    }
                };
                self.inputs.0.insert(at, Input::Place(found));
                Ok(())
            }
            Step::Repeat(repeat) => self.course(&repeat.via, format!("{path}/repeat/via")),
            Step::Travel(travel) => self.course(&travel.via, format!("{path}/travel/via")),
            Step::Nonmanual(nonmanual) => {
                let material = match nonmanual.is_expression() {
                    true => {
                        let function = nonmanual.function.as_deref();
                        let found = self.sources.expression(&nonmanual.from, function)?;
                        let at = format!("{path}/nonmanual/expression");
                        let input = ExpressionInput {
                            function: found.function,
                            milestones: found.milestones,
                        };
                        self.inputs.0.insert(at, Input::Expression(input));
                        found.material
                    }
                    false => self.sources.material(&nonmanual.from)?,
                };
                self.keep(format!("{path}/nonmanual/from"), material)?;
                Ok(())
            }
            Step::Indicate(indicate) => {
                for (word, spot) in [("from", &indicate.from), ("to", &indicate.to)] {
                    if let Some(spot) = spot {
                        self.spot(spot, format!("{path}/indicate/{word}"))?;
                    }
                }
                Ok(())
            }
            Step::Reverse
            | Step::Swap
            | Step::Mirror(_)
            | Step::Orient(_)
            | Step::Amplify(_)
            | Step::Retime(_)
            | Step::Span(_)
            | Step::Trim => Ok(()),
        }
    }

    fn keep(&mut self, path: String, material: Material) -> Result<Setting, Cause> {
        if material.clip.frames() == 0 {
            return Err(Cause::Empty(material.address));
        }
        let setting = Setting::of(&material);
        let input = MaterialInput {
            address: material.address.clone(),
            hash: material.hash.clone(),
            gloss: material.gloss.clone(),
            handedness: material.handedness,
            held: material.held.clone(),
        };
        self.inputs.0.insert(path.clone(), Input::Material(input));
        self.materials.insert(path, Arc::new(material));
        Ok(setting)
    }

    fn notation(
        &mut self,
        path: String,
        found: Vec<Notated>,
        notation: &Notation,
    ) -> Result<Setting, Cause> {
        if found.is_empty() {
            return Err(Cause::Empty(notation.of.clone()));
        }
        let stage = self.sources.stage(notation.on.as_deref())?;
        let setting = self.keep(path.clone(), stage)?;
        let at = format!("{path}/of");
        self.inputs.0.insert(at, Input::Notation(found));
        let signer = setting.signer.as_deref();
        let named = notation.language.as_deref();
        let language = self.sources.body_language(named, signer)?;
        if !language.is_usual() {
            let at = format!("{path}/language");
            self.inputs.0.insert(at, Input::Language(language));
        }
        Ok(setting)
    }

    /// Returns the posture of a shape of cued speech: the inventory's own, because every cuer learns the same
    /// charts; captured ones if the inventory has none.
    fn shape_of_code(
        &self,
        value: &crate::sources::Value,
        side: Side,
        setting: &Setting,
    ) -> Result<HandPose, Cause> {
        match &value.meaning {
            Some(Meaning::Hand(angles)) => Ok(HandPose {
                value: Some(value.id.clone()),
                origin: poses::PoseOrigin::Inventory(value.inventory.clone()),
                angles: *angles,
                exact: None,
            }),
            _ => poses::of_value(self.sources, value, side, setting),
        }
    }

    fn letters(&self, spell: &Spell, setting: &Setting) -> Result<Vec<LetterInput>, Cause> {
        let side = spell.hand.sides(setting.handedness)[0];
        let letters = self
            .sources
            .letters(spell.alphabet.as_deref(), &spell.word)?;
        let mut found = Vec::with_capacity(letters.len());
        for letter in letters {
            let pose = poses::of_value(self.sources, &letter.value, side, setting)?;
            found.push(LetterInput { letter, pose });
        }
        if found.is_empty() {
            return Err(Cause::Empty(spell.word.clone()));
        }
        Ok(found)
    }

    fn course(&mut self, via: &Transition, path: String) -> Result<(), Cause> {
        if via.profile == Some(Profile::Learned) {
            let profile = self.sources.learned_profile()?.ok_or(Cause::NoProfile)?;
            self.inputs.0.insert(path, Input::Courses(profile));
        }
        Ok(())
    }

    fn spot(&mut self, spot: &Spot, path: String) -> Result<(), Cause> {
        if let Spot::Value(value) = spot {
            let place = self.place(value)?;
            self.inputs.0.insert(path, Input::Place(place));
        }
        Ok(())
    }

    fn place(&self, text: &str) -> Result<PlaceInput, Cause> {
        let value = self.sources.value(Component::Placement, text)?;
        match value.meaning {
            Some(Meaning::Place(at)) => Ok(PlaceInput {
                value: Some(value.id),
                from: value.inventory,
                at,
            }),
            _ => {
                let examples = self.sources.holding(Component::Placement, &value.id)?;
                let Some(example) = examples.first() else {
                    let what = "place on the body";
                    return Err(Cause::NoMeaning {
                        value: value.id,
                        what,
                    });
                };
                let material = self.sources.material(&example.address)?;
                let side = example.hand.unwrap_or(material.handedness.dominant());
                let found = place_of_sides(&material, &[side], None)?;
                Ok(PlaceInput {
                    value: Some(value.id),
                    ..found
                })
            }
        }
    }
}

fn place_of(material: &Material, place: &Place, setting: &Setting) -> Result<PlaceInput, Cause> {
    let sides = place.hand.sides(setting.handedness);
    let has = |side: &&Side| material.anatomy.arm(**side).is_some();
    let shown: Vec<Side> = sides.iter().filter(has).copied().collect();
    place_of_sides(material, &shown, place.with)
}

/// Returns the placement that hands hold all through another sign, if it has exactly one.
fn held_place(material: &Material, sides: &[Side]) -> Option<String> {
    let dominant = material.handedness.dominant();
    let told = material.held.iter().filter(|held| {
        let of = sides.contains(&held.hand.unwrap_or(dominant));
        of && held.component == Component::Placement && held.feature.is_none()
    });
    let mut values = told.filter_map(|held| held.value.value());
    let first = values.next()?;
    values.all(|value| value == first).then(|| first.to_owned())
}

/// Returns where hands are in the middle of another sign, relative to the signer's chest and arms.
fn place_of_sides(
    material: &Material,
    sides: &[Side],
    with: Option<HandPoint>,
) -> Result<PlaceInput, Cause> {
    let work = crate::work::Work::of(material);
    let frame = body::Frame::of(&work);
    let mean = body::mean_point(&work, sides, with.unwrap_or(HandPoint::Palm));
    let (Some(frame), Some(mean)) = (frame, mean) else {
        let address = material.address.clone();
        let what = "hand's place";
        return Err(Cause::NothingToTake { address, what });
    };
    Ok(PlaceInput {
        value: held_place(material, sides),
        from: material.address.clone(),
        at: frame.spatial(mean),
    })
}
