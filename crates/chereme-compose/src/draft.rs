//! A recipe in progress: a change evaluates only the parts that it touches.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::answers::Path;
use crate::contact::Contacts;
use crate::error::MakeError;
use crate::evaluate;
use crate::outcome::{Generated, Report};
use crate::recipe::{Joined, Node, Recipe, Step, Then};
use crate::resolve::{self, Input, Resolved};
use crate::simplify::Planned;
use crate::sources::{Material, Sources};
use crate::work::Work;

/// A recipe that is evaluated repeatedly while it changes.
///
/// Movement is stored after every source, operator and join, so that only the parts after a change are evaluated again;
/// the result equals that of [`resolve`](crate::resolve()) and [`evaluate`](crate::evaluate()), bit by bit. The answers
/// for a part of the recipe are reused as long as that part does not change: call [`forget`](Self::forget) if the
/// corpus changed.
#[derive(Debug, Default)]
pub struct Draft {
    resolved: Option<Resolved>,
    kept: Kept,
}

impl Draft {
    /// Generates the movement of a recipe; between two steps `goes_on` is asked whether the result is still wanted.
    ///
    /// # Errors
    /// Those of [`resolve`](crate::resolve()) and [`evaluate`](crate::evaluate()), and
    /// [`Cause::Stopped`](crate::Cause::Stopped) if the result is no longer wanted; the next call reuses the steps
    /// evaluated by then.
    pub fn make(
        &mut self,
        recipe: &Recipe,
        sources: &dyn Sources,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Generated, MakeError> {
        let resolved = resolve::after(recipe, sources, self.resolved.as_ref())?;
        self.kept.round += 1;
        let made = evaluate::with(&resolved, Some(&mut self.kept), goes_on);
        if made.is_ok() {
            self.kept.drop_unused();
        }
        self.resolved = Some(resolved);
        made
    }

    /// Discards all results, so that the next evaluation starts from scratch.
    pub fn forget(&mut self) {
        *self = Self::default();
    }
}

/// The most memory for stored results, in numbers of eight bytes.
const MOST: usize = 12 << 20;

/// The stored results for parts of recipes.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    stages: Vec<Stage>,
    /// The number of the current evaluation.
    round: u64,
    /// The index of the stage that was stored or found last.
    last: Option<usize>,
}

/// A part of a recipe: a source, pieces joined so far, or movement with operators applied to it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DraftPart {
    pub(crate) of: Node,
    pub(crate) steps: Vec<Planned>,
}

/// The answers for a part, by paths relative to the part's own.
type PartAnswers = BTreeMap<String, (Option<Input>, Option<Arc<Material>>)>;

/// The movement after a part, with the report so far.
#[derive(Debug)]
pub(crate) struct Stage {
    part: DraftPart,
    given: PartAnswers,
    /// The path of the part in the recipe.
    base: String,
    pub(crate) work: Work,
    pub(crate) contacts: Option<Contacts>,
    report: Report,
    round: u64,
}

impl DraftPart {
    /// Returns whether `path`, relative to the part's own, belongs to the part.
    fn covers(&self, path: &str) -> bool {
        let own = Path::default();
        let below = |start: Path| {
            let rest = path.strip_prefix(start.as_str());
            rest.is_some_and(|rest| rest.starts_with('/'))
        };
        match &self.of {
            _ if !self.steps.is_empty() => {
                let mut steps = self.steps.iter();
                below(own.operand()) || steps.any(|it| below(own.step(it.index)))
            }
            Node::Then(then) => {
                let mut next = 0..then.next.len();
                below(own.first()) || next.any(|n| below(own.joined(n)))
            }
            _ => path.starts_with('/'),
        }
    }

    /// Returns the part of an utterance up to its first piece and `count` more.
    pub(crate) fn pieces(then: &Then, count: usize) -> Self {
        Self {
            of: Node::Then(Then {
                first: then.first.clone(),
                next: then.next[..count].to_vec(),
            }),
            steps: Vec::new(),
        }
    }
}

/// Returns the answers of `resolved` for a part at `base`.
fn given(resolved: &Resolved, base: &str, part: &DraftPart) -> PartAnswers {
    let mut given = PartAnswers::new();
    for (path, input) in resolved.below(base) {
        if part.covers(&path[base.len()..]) {
            let material = resolved.materials.get(path).cloned();
            let found = (Some(input.clone()), material);
            given.insert(path[base.len()..].to_owned(), found);
        }
    }
    given
}

impl Stage {
    fn holds(&self, resolved: &Resolved, base: &str) -> bool {
        let mut now = resolved
            .below(base)
            .filter(|(path, _)| self.part.covers(&path[base.len()..]));
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
    pub(crate) fn report_at(&self, base: &str) -> Report {
        let mut report = self.report.clone();
        for step in &mut report.steps {
            step.path = format!("{base}{}", &step.path[self.base.len()..]);
        }
        report
    }

    fn size(&self) -> usize {
        size(&self.work)
    }
}

fn size(work: &Work) -> usize {
    let numbers = work.channels.iter().map(|channel| {
        let moved = channel.translations.as_ref().map_or(0, Vec::len);
        channel.rotations.len() * 4 + moved * 3
    });
    numbers.sum()
}

impl Kept {
    /// Returns the movement after a part, if it was evaluated before.
    pub(crate) fn find(
        &mut self,
        resolved: &Resolved,
        base: &str,
        part: &DraftPart,
    ) -> Option<&Stage> {
        let at = self
            .stages
            .iter()
            .position(|stage| stage.part == *part && stage.holds(resolved, base))?;
        self.last = Some(at);
        self.stages[at].round = self.round;
        Some(&self.stages[at])
    }

    /// Stores the movement after a part, with the report on that part.
    pub(crate) fn keep(
        &mut self,
        (resolved, base): (&Resolved, &str),
        part: DraftPart,
        work: &Work,
        report: Report,
    ) {
        self.last = None;
        let held: usize = self.stages.iter().map(Stage::size).sum();
        if held + size(work) > MOST {
            let round = self.round;
            self.stages.retain(|stage| stage.round == round);
            if self.stages.iter().map(Stage::size).sum::<usize>() + size(work) > MOST {
                return;
            }
        }
        self.stages.push(Stage {
            given: given(resolved, base, &part),
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
    pub(crate) fn last(&mut self) -> Option<&mut Stage> {
        self.stages.get_mut(self.last?)
    }

    fn drop_unused(&mut self) {
        let round = self.round;
        self.stages.retain(|stage| stage.round == round);
        self.last = None;
    }
}

/// A part of the previous recipe, with its path there.
#[derive(Debug, Clone)]
pub(crate) struct Former<'a> {
    node: &'a Node,
    pub(crate) path: Path,
}

impl<'a> Former<'a> {
    pub(crate) fn of(recipe: &'a Recipe) -> Self {
        Self {
            node: &recipe.root,
            path: Path::default(),
        }
    }

    pub(crate) fn is(&self, node: &Node) -> bool {
        self.node == node
    }

    /// Returns the operand of the operators, or the whole if there is no operator.
    pub(crate) fn operated(&self) -> Self {
        match self.node {
            Node::Pipe(pipe) => Self {
                node: &pipe.of,
                path: self.path.operand(),
            },
            _ => self.clone(),
        }
    }

    /// Returns the first of several pieces, or the only one, with its operators.
    pub(crate) fn first(&self) -> Self {
        match self.node {
            Node::Then(then) => Self {
                node: &then.first,
                path: self.path.first(),
            },
            _ => self.clone(),
        }
    }

    /// Returns the first source in it.
    pub(crate) fn source(&self) -> Self {
        match self.node {
            Node::Pipe(_) => self.operated().source(),
            Node::Then(_) => self.first().source(),
            _ => self.clone(),
        }
    }

    /// Returns the path of an equal operator.
    pub(crate) fn step(&self, step: &Step) -> Option<Path> {
        let Node::Pipe(pipe) = self.node else {
            return None;
        };
        let at = pipe.steps.iter().position(|old| old == step)?;
        Some(self.path.step(at))
    }

    /// Returns the equal piece, or else the piece at the same position, among those after the first.
    pub(crate) fn piece(&self, joined: &Joined, nth: usize) -> Option<Self> {
        let Node::Then(then) = self.node else {
            return None;
        };
        let same = then.next.iter().position(|old| old.node == joined.node);
        let at = same.unwrap_or(nth);
        Some(Self {
            node: &then.next.get(at)?.node,
            path: self.path.joined(at).piece(),
        })
    }
}
