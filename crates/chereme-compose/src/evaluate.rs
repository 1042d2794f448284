//! Evaluates a resolved recipe: generates its movement.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::answers::{Given, Path};
use crate::contact::{self, Contacts};
use crate::cue;
use crate::draft::{DraftPart, Kept};
use crate::error::{Cause, MakeError};
use crate::ops::notated::{self, Written};
use crate::ops::{Done, point, spell, then};
use crate::outcome::{ChannelReport, Generated, Report, StepReport};
use crate::recipe::*;
use crate::resolve::{Input, JOIN, Resolved, SIGN};
use crate::simplify::{self, Planned};
use crate::sources::Material;
use crate::speed::{self, StepSpeeds};
use crate::work::{Group, Work};

/// The version of the evaluator. It rises whenever the same resolved recipe gives different movement, so that a
/// stored sign can be distinguished from one that would be generated today.
pub const ENGINE: u32 = 24;

/// Generates the movement of a recipe.
///
/// The same resolved recipe gives the same movement, bit by bit, on the same machine.
///
/// # Errors
/// [`MakeError`] with the step that cannot be done, the reason, and a remedy.
pub fn evaluate(resolved: &Resolved) -> Result<Generated, MakeError> {
    with(resolved, None, &|| true)
}

/// Does the same as [`evaluate`], but reuses stored movement of parts from `kept`, and adds to it; stops between two
/// steps if `goes_on` returns false.
pub(crate) fn with(
    resolved: &Resolved,
    kept: Option<&mut Kept>,
    goes_on: &dyn Fn() -> bool,
) -> Result<Generated, MakeError> {
    let mut evaluator = Evaluator {
        resolved,
        kept,
        goes_on,
        inputs: &resolved.inputs.0,
        materials: &resolved.materials,
        report: Report::default(),
    };
    let work = evaluator.node(&resolved.recipe.root, &Path::default())?;
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
    Ok(Generated {
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
}

/// The lengths of the report's lists at some moment.
#[derive(Clone, Copy)]
struct ReportLengths {
    steps: usize,
    joins: usize,
    contacts: usize,
    warnings: usize,
}

impl<'a> Evaluator<'a> {
    fn node(&mut self, node: &Node, path: &Path) -> Result<Work, MakeError> {
        match node {
            Node::Pipe(pipe) => self.pipe(pipe, path),
            Node::Then(then) => self.chain(then, path),
            leaf => self.source(leaf, path),
        }
    }

    fn source(&mut self, leaf: &Node, path: &Path) -> Result<Work, MakeError> {
        let part = DraftPart {
            of: leaf.clone(),
            steps: Vec::new(),
        };
        if let Some(work) = self.kept(path, &part) {
            return Ok(work);
        }
        let text = leaf.to_string();
        let mark = self.mark();
        match self.wanted().and_then(|()| self.leaf(leaf, path, &text)) {
            Ok((work, done)) => {
                self.done(path, text, done);
                self.keep(path, part, &work, mark);
                Ok(work)
            }
            Err(cause) => Err(MakeError {
                path: path.to_string(),
                step: text,
                cause,
            }),
        }
    }

    fn pipe(&mut self, pipe: &Pipe, path: &Path) -> Result<Work, MakeError> {
        let mark = self.mark();
        let plan = simplify::plan(&pipe.steps);
        let part = |count: usize| DraftPart {
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
            None => (self.node(&pipe.of, &path.operand())?, 0),
        };
        for (count, Planned { index, step }) in plan.iter().enumerate().skip(taken) {
            let at = path.step(*index);
            let text = step.to_string();
            let wanted = self.wanted();
            match wanted.and_then(|()| self.step(&mut work, step, &at, &text)) {
                Ok(done) => {
                    self.done(&at, text, done);
                    self.keep(path, part(count + 1), &work, mark);
                }
                Err(cause) => {
                    return Err(MakeError {
                        path: at.to_string(),
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

    fn chain(&mut self, then: &Then, path: &Path) -> Result<Work, MakeError> {
        let mark = self.mark();
        let mut found = None;
        if self.kept.is_some() {
            for count in (1..=then.next.len()).rev() {
                let work = self.kept(path, &DraftPart::pieces(then, count));
                found = work.map(|work| (work, count));
                if found.is_some() {
                    break;
                }
            }
        }
        let (mut work, taken) = match found {
            Some(found) => found,
            None => (self.node(&then.first, &path.first())?, 0),
        };
        for (n, joined) in then.next.iter().enumerate().skip(taken) {
            let at = path.joined(n);
            let next = self.node(&joined.node, &at.piece())?;
            let text = format!("then{} {}", joined.via, joined.node);
            let then_joined = self.wanted();
            match then_joined.and_then(|()| self.then(&mut work, next, joined, &at, &text)) {
                Ok(done) => {
                    self.done(&at, text, done);
                    self.keep(path, DraftPart::pieces(then, n + 1), &work, mark);
                }
                Err(cause) => {
                    return Err(MakeError {
                        path: at.to_string(),
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

    fn mark(&self) -> ReportLengths {
        ReportLengths {
            steps: self.report.steps.len(),
            joins: self.report.joins.len(),
            contacts: self.report.contacts.len(),
            warnings: self.report.warnings.len(),
        }
    }

    /// Returns the stored movement after a part, if any, and adds its report again.
    fn kept(&mut self, path: &Path, part: &DraftPart) -> Option<Work> {
        let path = path.as_str();
        let stage = self.kept.as_mut()?.find(self.resolved, path, part)?;
        let report = stage.report_at(path);
        self.report.steps.extend(report.steps);
        self.report.joins.extend(report.joins);
        self.report.contacts.extend(report.contacts);
        self.report.warnings.extend(report.warnings);
        Some(stage.work.clone())
    }

    fn keep(&mut self, path: &Path, part: DraftPart, work: &Work, mark: ReportLengths) {
        let Some(kept) = &mut self.kept else { return };
        let report = Report {
            steps: self.report.steps[mark.steps..].to_vec(),
            channels: Vec::new(),
            joins: self.report.joins[mark.joins..].to_vec(),
            contacts: self.report.contacts[mark.contacts..].to_vec(),
            warnings: self.report.warnings[mark.warnings..].to_vec(),
        };
        kept.keep((self.resolved, path.as_str()), part, work, report);
    }

    /// Returns the contacts in the movement after the last step; they are computed once.
    fn touches(&mut self, work: &Work) -> Contacts {
        let Some(stage) = self.kept.as_mut().and_then(|kept| kept.last()) else {
            return contact::touches(work);
        };
        let found = stage.contacts.get_or_insert_with(|| contact::touches(work));
        found.clone()
    }

    fn done(&mut self, path: &Path, step: String, done: Done) {
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
        });
    }

    fn leaf(&mut self, leaf: &Node, path: &Path, text: &str) -> Result<(Work, Done), Cause> {
        let mut given = self.given(path, text);
        let (work, mut done) = match leaf {
            Node::Sign(_) => {
                let material = given.material(&SIGN)?;
                let clip = &material.clip;
                let did = format!(
                    "{} ({:?}), {} frames at {}",
                    material.address,
                    material.gloss,
                    clip.frames(),
                    clip.rate()
                );
                let body = given.need(&SIGN)?.body.as_ref();
                let body = body.map(|body| notated::performed_by(&body.address));
                let did: Vec<String> = std::iter::once(did).chain(body).collect();
                (Work::of(material), did.into())
            }
            Node::Spell(settings) => spell::generate(settings, &mut given)?,
            Node::Point(settings) => point::generate(settings, &mut given)?,
            Node::Cue(settings) => cue::leaf::generate(settings, &mut given)?,
            Node::Hamnosys(_) => Written::Hamnosys.generate(&mut given)?,
            Node::Sigml(_) => Written::Sigml.generate(&mut given)?,
            Node::Pipe(_) | Node::Then(_) => return Err(Cause::Input),
        };
        done.did.append(&mut given.aside);
        Ok((work, done))
    }

    fn step(
        &mut self,
        work: &mut Work,
        step: &Step,
        path: &Path,
        text: &str,
    ) -> Result<Done, Cause> {
        let mut given = self.given(path, text);
        let operator = step.operator();
        let before = StepSpeeds::peak_speeds(work);
        let longer = operator.make_time(work)?;
        let touched = operator.contacts(work.handedness);
        let mut touched = touched.map(|(carry, keep)| {
            let before = match longer {
                Some(_) => contact::touches(work),
                None => self.touches(work),
            };
            (before, carry, keep)
        });
        let mut done = operator.apply(work, &mut given)?;
        done.did.extend(longer);
        if let Some((before, carry, keep)) = &mut touched {
            let kept = contact::mend(work, before, *keep, text);
            done.did.extend(kept);
            done.lost.extend(contact::lost(before, work, *carry));
            done.warnings.extend(contact::long_repairs(before, text));
        }
        let added = speed::check_added(before, StepSpeeds::peak_speeds(work))?;
        let warnings = added.iter().map(|added| format!("{text}: {added}"));
        done.warnings.extend(warnings);
        done.did.append(&mut given.aside);
        Ok(done)
    }

    fn given<'b>(&self, path: &'b Path, text: &'b str) -> Given<'b>
    where
        'a: 'b,
    {
        Given {
            inputs: self.inputs,
            materials: self.materials,
            path,
            text,
            aside: Vec::new(),
        }
    }

    fn then(
        &self,
        work: &mut Work,
        next: Work,
        joined: &Joined,
        path: &Path,
        text: &str,
    ) -> Result<Done, Cause> {
        let mut given = self.given(path, text);
        let course = given.course(&JOIN, &joined.via, Profile::Sigmoid)?;
        let mut done: Done = then::then(work, next, joined.via.time, &course, text)?.into();
        done.did.append(&mut given.aside);
        Ok(done)
    }
}
