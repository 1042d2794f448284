//! From a resolved recipe to movement.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_sign::Handedness;

use crate::contact::{self, Carry, Contacts, Keep};
use crate::course::{self, Courses};
use crate::cue;
use crate::draft::{Kept, Part};
use crate::error::{Cause, MakeError};
use crate::language::Language;
use crate::made::{ChannelReport, HandReport, Made, Report, StepReport};
use crate::notation;
use crate::ops::{self, join};
use crate::poses::HandPose;
use crate::recipe::*;
use crate::resolve::{Input, PlaceInput, Resolved};
use crate::simplify::{self, Planned};
use crate::sources::Material;
use crate::work::{Group, Work};

/// The version of the evaluator. It rises whenever the same resolved recipe gives different movement, so that a
/// stored sign can be distinguished from one that would be generated today.
pub const ENGINE: u32 = 11;

/// Makes the movement of a recipe.
///
/// The same resolved recipe gives the same movement, bit by bit, on the same machine.
///
/// # Errors
/// [`MakeError`] naming the step that cannot be done, why, and what would work.
pub fn evaluate(resolved: &Resolved) -> Result<Made, MakeError> {
    with(resolved, None, &|| true)
}

/// Does the same as [`evaluate`], but takes the movement after parts of the recipe from `kept`, and adds to it;
/// stops between two steps if `goes_on` says so.
pub(crate) fn with(
    resolved: &Resolved,
    kept: Option<&mut Kept>,
    goes_on: &dyn Fn() -> bool,
) -> Result<Made, MakeError> {
    let mut evaluator = Evaluator {
        resolved,
        kept,
        goes_on,
        inputs: &resolved.inputs.0,
        materials: &resolved.materials,
        report: Report::default(),
        aside: Vec::new(),
    };
    let work = evaluator.node(&resolved.recipe.root, String::new())?;
    let fault = |cause| MakeError {
        path: String::new(),
        step: resolved.recipe.to_string(),
        cause,
    };
    let mut report = evaluator.report;
    report.channels = Group::ALL
        .into_iter()
        .map(|group| ChannelReport {
            channel: group.name(),
            from: work.from.get(&group).cloned().unwrap_or_default(),
        })
        .collect();
    let (anatomy, handedness) = (Arc::clone(&work.anatomy), work.handedness);
    let (signer, mut notes) = (work.signer.clone(), work.notes.clone());
    let curves = work.curves.clone();
    notes.sort_by_key(|note| (note.span.start(), note.span.end()));
    Ok(Made {
        clip: work.into_clip().map_err(|error| fault(error.into()))?,
        anatomy,
        handedness,
        signer,
        curves,
        notes,
        report,
    })
}

struct Evaluator<'a> {
    resolved: &'a Resolved,
    kept: Option<&'a mut Kept>,
    goes_on: &'a dyn Fn() -> bool,
    inputs: &'a BTreeMap<String, Input>,
    materials: &'a BTreeMap<String, Arc<Material>>,
    report: Report,
    /// Further notes of the current step.
    aside: Vec<String>,
}

/// Returns how a step carries contacts; nothing where it cannot undo any, or sees to them itself.
fn carry(step: &Step, handedness: Handedness) -> Option<Carry> {
    match step {
        Step::Configure(_)
        | Step::Place(_)
        | Step::Orient(_)
        | Step::Amplify(_)
        | Step::Travel(_)
        | Step::Nonmanual(_)
        | Step::Indicate(_) => Some(Carry::Same),
        Step::Swap => Some(Carry::Swapped),
        Step::Mirror(mirror) => Some(Carry::Copied(mirror.from.sides(handedness)[0])),
        Step::Retime(_) => Some(Carry::Anytime),
        Step::Reverse | Step::Repeat(_) | Step::Span(_) | Step::Trim => None,
    }
}

/// The effect of a step, for the report.
#[derive(Default)]
struct Done {
    did: Vec<String>,
    residual: Option<f64>,
    moved: Option<[f64; 3]>,
    language: Option<Language>,
    hands: Vec<HandReport>,
}

impl From<Vec<String>> for Done {
    fn from(did: Vec<String>) -> Self {
        Self {
            did,
            ..Self::default()
        }
    }
}

impl From<(Vec<String>, f64)> for Done {
    fn from((did, residual): (Vec<String>, f64)) -> Self {
        Self {
            did,
            residual: Some(residual),
            ..Self::default()
        }
    }
}

/// The length of the report at a moment.
#[derive(Clone, Copy)]
struct Mark {
    steps: usize,
    joins: usize,
    contacts: usize,
    warnings: usize,
}

impl Evaluator<'_> {
    fn node(&mut self, node: &Node, path: String) -> Result<Work, MakeError> {
        match node {
            Node::Pipe(pipe) => self.pipe(pipe, &path),
            Node::Then(then) => self.chain(then, &path),
            leaf => self.source(leaf, path),
        }
    }

    fn source(&mut self, leaf: &Node, path: String) -> Result<Work, MakeError> {
        let part = Part {
            of: leaf.clone(),
            steps: Vec::new(),
        };
        if let Some(work) = self.kept(&path, &part) {
            return Ok(work);
        }
        let text = leaf.to_string();
        let mark = self.mark();
        match self.wanted().and_then(|()| self.leaf(leaf, &path)) {
            Ok((work, done)) => {
                self.done(path.clone(), text, done);
                self.keep(&path, part, &work, mark);
                Ok(work)
            }
            Err(cause) => Err(MakeError {
                path,
                step: text,
                cause,
            }),
        }
    }

    fn pipe(&mut self, pipe: &Pipe, path: &str) -> Result<Work, MakeError> {
        let mark = self.mark();
        let plan = simplify::plan(&pipe.steps);
        let part = |count: usize| Part {
            of: (*pipe.of).clone(),
            steps: plan[..count].to_vec(),
        };
        let known = (1..=plan.len()).rev();
        let known = known.map(|count| (part(count), count));
        let mut found = None;
        if self.kept.is_some() {
            for (part, count) in known {
                found = self.kept(path, &part).map(|work| (work, count));
                if found.is_some() {
                    break;
                }
            }
        }
        let (mut work, taken) = match found {
            Some(found) => found,
            None => (self.node(&pipe.of, format!("{path}/pipe/of"))?, 0),
        };
        for (count, Planned { index, step }) in plan.iter().enumerate().skip(taken) {
            let at = format!("{path}/pipe/steps/{index}");
            let text = step.to_string();
            let carry = carry(step, work.handedness);
            let mut touched = carry.map(|carry| (self.touches(&work), carry));
            match self
                .wanted()
                .and_then(|()| self.step(&mut work, step, &at, &text))
            {
                Ok(mut done) => {
                    if let Some((before, carry)) = &mut touched {
                        let handedness = work.handedness;
                        let keep = Keep::of(step, |hands| hands.sides(handedness));
                        let kept = contact::mend(&mut work, before, keep, &text);
                        done.did.extend(kept);
                        self.lost(&text, contact::lost(before, &work, *carry));
                    }
                    self.done(at, text, done);
                    self.keep(path, part(count + 1), &work, mark);
                }
                Err(cause) => {
                    return Err(MakeError {
                        path: at,
                        step: text,
                        cause,
                    });
                }
            }
        }
        if plan.len() < pipe.steps.len() {
            let less = pipe.steps.len() - plan.len();
            let did = format!("{less} operators that cancel out or become one were left out");
            self.report.warnings.push(did);
        }
        Ok(work)
    }

    fn chain(&mut self, then: &Then, path: &str) -> Result<Work, MakeError> {
        let mark = self.mark();
        let mut found = None;
        if self.kept.is_some() {
            for count in (1..=then.next.len()).rev() {
                let work = self.kept(path, &Part::pieces(then, count));
                found = work.map(|work| (work, count));
                if found.is_some() {
                    break;
                }
            }
        }
        let (mut work, taken) = match found {
            Some(found) => found,
            None => (self.node(&then.first, format!("{path}/then/first"))?, 0),
        };
        for (n, joined) in then.next.iter().enumerate().skip(taken) {
            let at = format!("{path}/then/next/{n}");
            let next = self.node(&joined.node, format!("{at}/node"))?;
            let text = format!("then{} {}", joined.via, joined.node);
            let then_joined = self.wanted();
            match then_joined.and_then(|()| self.then(&mut work, next, joined, &at, &text)) {
                Ok(done) => {
                    self.done(at, text, done);
                    self.keep(path, Part::pieces(then, n + 1), &work, mark);
                }
                Err(cause) => {
                    return Err(MakeError {
                        path: at,
                        step: text,
                        cause,
                    });
                }
            }
        }
        Ok(work)
    }

    fn wanted(&self) -> Result<(), Cause> {
        (self.goes_on)().then_some(()).ok_or(Cause::Stopped)
    }

    fn mark(&self) -> Mark {
        Mark {
            steps: self.report.steps.len(),
            joins: self.report.joins.len(),
            contacts: self.report.contacts.len(),
            warnings: self.report.warnings.len(),
        }
    }

    /// Returns the movement after a part if it is kept, and repeats its report.
    fn kept(&mut self, path: &str, part: &Part) -> Option<Work> {
        let stage = self.kept.as_mut()?.find(self.resolved, path, part)?;
        let told = stage.told(path);
        self.report.steps.extend(told.steps);
        self.report.joins.extend(told.joins);
        self.report.contacts.extend(told.contacts);
        self.report.warnings.extend(told.warnings);
        Some(stage.work.clone())
    }

    fn keep(&mut self, path: &str, part: Part, work: &Work, mark: Mark) {
        let Some(kept) = &mut self.kept else { return };
        let report = Report {
            steps: self.report.steps[mark.steps..].to_vec(),
            channels: Vec::new(),
            joins: self.report.joins[mark.joins..].to_vec(),
            contacts: self.report.contacts[mark.contacts..].to_vec(),
            warnings: self.report.warnings[mark.warnings..].to_vec(),
        };
        kept.keep((self.resolved, path), part, work, report);
    }

    /// Returns what touches in the movement after the last step, looked for once.
    fn touches(&mut self, work: &Work) -> Contacts {
        let Some(stage) = self.kept.as_mut().and_then(|kept| kept.last()) else {
            return contact::touches(work);
        };
        let found = stage.contacts.get_or_insert_with(|| contact::touches(work));
        found.clone()
    }

    fn lost(&mut self, step: &str, contacts: Vec<String>) {
        let told = contacts.iter().map(|lost| format!("{step}: {lost}"));
        self.report.contacts.extend(told);
    }

    fn done(&mut self, path: String, step: String, mut done: Done) {
        done.did.append(&mut self.aside);
        if let Some(residual) = done.residual.filter(|residual| *residual > 1e-3) {
            self.report.warnings.push(format!(
                "{step}: a hand stays up to {:.1} cm from where it should be",
                residual * 100.0
            ));
        }
        self.report.steps.push(StepReport {
            path,
            step,
            did: done.did,
            residual: done.residual,
            moved: done.moved,
            language: done.language,
            hands: done.hands,
        });
    }

    fn leaf(&mut self, leaf: &Node, path: &str) -> Result<(Work, Done), Cause> {
        match leaf {
            Node::Sign(_) => {
                let material = self.material(format!("{path}/sign"))?;
                let clip = &material.clip;
                let did = format!(
                    "{} ({:?}), {} frames at {}",
                    material.address,
                    material.gloss,
                    clip.frames(),
                    clip.rate()
                );
                Ok((Work::of(material), vec![did].into()))
            }
            Node::Spell(settings) => {
                let mut work = Work::of(self.material(format!("{path}/spell"))?);
                let Some(Input::Letters(letters)) = self.inputs.get(&format!("{path}/spell/word"))
                else {
                    return Err(Cause::Input);
                };
                let at = format!("{path}/spell/via");
                let course = self.course(&settings.via, Profile::Sigmoid, at)?;
                let times = match self.inputs.get(&format!("{path}/spell/hold")) {
                    Some(Input::Times(times)) => Some(times),
                    _ => None,
                };
                let times = ops::spell::Times::of(settings, times);
                let done = ops::spell::spell(&mut work, settings, letters, &times, &course)?;
                Ok((work, done.into()))
            }
            Node::Point(settings) => {
                let mut work = Work::of(self.material(format!("{path}/point"))?);
                let course =
                    self.course(&settings.via, Profile::Sigmoid, format!("{path}/point/via"))?;
                let shape = match self.inputs.get(&format!("{path}/point/with")) {
                    Some(Input::Poses(poses)) => Some(poses.as_slice()),
                    _ => None,
                };
                let given = ops::point::Given {
                    shape,
                    place: self.place(format!("{path}/point/at")),
                };
                let done = ops::point::point(&mut work, settings, &given, &course)?;
                Ok((work, done.into()))
            }
            Node::Cue(settings) => {
                let mut work = Work::of(self.material(format!("{path}/cue"))?);
                let Some(Input::Poses(poses)) = self.inputs.get(&format!("{path}/cue/shapes"))
                else {
                    return Err(Cause::Input);
                };
                let read = cue::read(settings)?;
                let numbers = std::iter::once(read.code.rest.number)
                    .chain(read.code.shapes.iter().map(|shape| shape.number));
                let shapes: Vec<(u8, HandPose)> = numbers.zip(poses.iter().cloned()).collect();
                let measured = match self.inputs.get(&format!("{path}/cue/by")) {
                    Some(Input::Phases(phases)) => *phases,
                    _ => cue::CuePhases::default(),
                };
                let done = cue::cue(&mut work, settings, &shapes, &measured)?;
                let told = done.warnings.into_iter();
                self.report
                    .warnings
                    .extend(told.map(|it| format!("cue: {it}")));
                Ok((work, (done.did, done.residual).into()))
            }
            Node::Hamnosys(_) => self.notation(&format!("{path}/hamnosys"), leaf),
            Node::Sigml(_) => self.notation(&format!("{path}/sigml"), leaf),
            Node::Pipe(_) | Node::Then(_) => Err(Cause::Input),
        }
    }

    fn notation(&mut self, path: &str, leaf: &Node) -> Result<(Work, Done), Cause> {
        let Some(Input::Notation(signs)) = self.inputs.get(&format!("{path}/of")) else {
            return Err(Cause::Input);
        };
        let stage = self.material(path.to_owned())?;
        let spoken = match self.inputs.get(&format!("{path}/language")) {
            Some(Input::Language(language)) => Some(language.clone()),
            _ => None,
        };
        let mut settings = notation::Settings {
            rate: stage.clip.rate(),
            ..notation::Settings::default()
        };
        if let Some(language) = &spoken {
            let whole = language.whole();
            settings.language = whole.map_err(|error| Cause::Language(error.to_string()))?;
        }
        let signs: Vec<_> = signs.iter().collect();
        let made = notation::animate(&signs, stage, &settings)?;
        let steps = made.report.steps.iter();
        let did = steps.flat_map(|step| step.did.iter().map(|did| format!("{} {did}", step.step)));
        let mut did: Vec<String> = did.collect();
        did.extend(spoken.iter().flat_map(Language::told));
        let residual = made.report.steps.iter().filter_map(|step| step.residual);
        let residual = residual.fold(0.0, f64::max);
        self.report.warnings.extend(made.report.warnings.clone());
        let hands = made.report.steps.first().map(|step| step.hands.clone());
        let done = Done {
            language: spoken,
            hands: hands.unwrap_or_default(),
            ..(did, residual).into()
        };
        Ok((Work::made(made, &leaf.to_string()), done))
    }

    fn step(
        &mut self,
        work: &mut Work,
        step: &Step,
        path: &str,
        text: &str,
    ) -> Result<Done, Cause> {
        Ok(match step {
            Step::Configure(settings) => self.configure(work, settings, path, text)?.into(),
            Step::Place(settings) => {
                let input = self.place(format!("{path}/place/to"));
                let (did, residual, moved) = ops::place::place(work, settings, input, text)?;
                Done {
                    moved: Some(moved.to_array()),
                    ..(did, residual).into()
                }
            }
            Step::Reverse => ops::reverse::reverse(work).into(),
            Step::Span(settings) => ops::cut::span(work, settings, text)?.into(),
            Step::Trim => ops::cut::trim(work, text)?.into(),
            Step::Swap => ops::mirror::swap(work)?.into(),
            Step::Mirror(settings) => {
                let from = settings.from.sides(work.handedness)[0];
                ops::mirror::mirror(work, from)?.into()
            }
            Step::Repeat(settings) => {
                let course =
                    self.course(&settings.via, Profile::Slerp, format!("{path}/repeat/via"))?;
                let done = ops::repeat::repeat(work, settings, &course, text)?;
                self.joined(text, done)
            }
            Step::Orient(settings) => ops::orient::orient(work, settings, text)?.into(),
            Step::Amplify(settings) => ops::shape::amplify(work, settings, text)?.into(),
            Step::Travel(settings) => {
                let course = self.course(
                    &settings.via,
                    Profile::MinimumJerk,
                    format!("{path}/travel/via"),
                )?;
                ops::shape::travel(work, settings, &course.arms, text)?.into()
            }
            Step::Retime(settings) => ops::retime::retime(work, &settings.paces, text)?.into(),
            Step::Nonmanual(settings) => {
                let donor = self.material(format!("{path}/nonmanual/from"))?;
                match self.inputs.get(&format!("{path}/nonmanual/expression")) {
                    Some(Input::Expression(given)) => {
                        ops::expression::expression(work, donor, settings, given, text)?.into()
                    }
                    _ => ops::nonmanual::nonmanual(work, donor, text)?.into(),
                }
            }
            Step::Indicate(settings) => {
                let places = ["from", "to"].map(|end| self.place(format!("{path}/indicate/{end}")));
                ops::shape::indicate(work, settings, places, text)?.into()
            }
        })
    }

    fn configure(
        &mut self,
        work: &mut Work,
        settings: &Configure,
        path: &str,
        text: &str,
    ) -> Result<Vec<String>, Cause> {
        let course = self.course(
            &settings.via,
            Profile::Sigmoid,
            format!("{path}/configure/via"),
        )?;
        let mut did = Vec::new();
        for &side in settings.hand.sides(work.handedness) {
            let mut values: Vec<Option<&[HandPose]>> = Vec::with_capacity(settings.values.len());
            for (n, choice) in settings.values.iter().enumerate() {
                let at = format!("{path}/configure/values/{n}/{}", side.name());
                values.push(match (choice, self.inputs.get(&at)) {
                    (Choice::Keep, _) => None,
                    (_, Some(Input::Poses(poses))) if !poses.is_empty() => Some(poses),
                    _ => return Err(Cause::Input),
                });
            }
            let time = settings.via.time.map(|time| time.0);
            did.extend(ops::configure::configure(
                work,
                side,
                &values,
                &course.fingers,
                time,
                text,
            )?);
        }
        Ok(did)
    }

    fn then(
        &mut self,
        work: &mut Work,
        next: Work,
        joined: &Joined,
        path: &str,
        text: &str,
    ) -> Result<Done, Cause> {
        let course = self.course(&joined.via, Profile::Sigmoid, format!("{path}/via"))?;
        let done = ops::then::then(work, next, joined.via.time, &course, text)?;
        Ok(self.joined(text, done))
    }

    fn joined(&mut self, text: &str, done: join::Done) -> Done {
        self.report.joins.extend(done.joins);
        self.lost(text, done.contacts);
        done.did.into()
    }

    fn material(&self, path: String) -> Result<&Material, Cause> {
        self.materials
            .get(&path)
            .map(AsRef::as_ref)
            .ok_or(Cause::Input)
    }

    fn place(&self, path: String) -> Option<&PlaceInput> {
        match self.inputs.get(&path) {
            Some(Input::Place(place)) => Some(place),
            _ => None,
        }
    }

    fn course(&mut self, via: &Transition, usual: Profile, path: String) -> Result<Courses, Cause> {
        let learned = match self.inputs.get(&path) {
            Some(Input::Courses(profile)) => Some(profile),
            _ => None,
        };
        self.aside.extend(learned.map(course::told));
        Courses::of(via.profile.unwrap_or(usual), learned).ok_or(Cause::NoProfile)
    }
}
