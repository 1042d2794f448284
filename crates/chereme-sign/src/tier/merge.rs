//! Cuts an annotation in two, and merges two into one.

use super::error::EditError;
use super::plan::{Done, EditPlan, hull};
use super::{Annotation, AnnotationId, Seam, Stereotype, Tier, share};
use crate::component::Reading;
use chereme_motion::{Instant, Span};

impl EditPlan<'_> {
    pub(super) fn split(&mut self, id: AnnotationId, at: Instant) -> Done {
        let (old, _) = self.aligned(id)?;
        if !(old.span.start() < at && at < old.span.end()) {
            return Err(EditError::CutOutside {
                annotation: id,
                at,
                span: old.span,
            });
        }
        self.cut(old, at, old.parent);
        Ok(())
    }

    /// Cuts an annotation in two; `parent` becomes the parent of the second half.
    fn cut(&mut self, old: &Annotation, at: Instant, parent: Option<AnnotationId>) {
        let id = (self.fresh)();
        let first = Span::between(old.span.start(), at);
        let span = Span::between(at, old.span.end());
        self.puts.push(Annotation {
            span: first,
            ..old.clone()
        });
        self.puts.push(Annotation {
            id,
            span,
            parent,
            ..old.clone()
        });
        let set = self.set;
        for tier in set.tiers_below(old.tier) {
            let children = self.family(old.id, tier.id);
            if !tier.is_alignable() {
                self.put_list(first, children.into_iter().cloned().collect());
                continue;
            }
            for child in children {
                if child.span.start() >= at {
                    self.puts.push(Annotation {
                        parent: Some(id),
                        ..child.clone()
                    });
                } else if child.span.end() > at {
                    self.cut(child, at, Some(id));
                }
            }
        }
    }

    pub(super) fn merge(
        &mut self,
        first: AnnotationId,
        second: AnnotationId,
        value: Option<&Reading>,
        seam: Seam,
    ) -> Done {
        let (a, b) = (self.annotation(first)?, self.annotation(second)?);
        let tier = self.tier(a.tier)?;
        let listed = tier.stereotype() == Some(Stereotype::SymbolicSubdivision);
        if !self.are_neighbours(tier, a, b) {
            return Err(EditError::NotNeighbours { first, second });
        }
        let value = match value {
            Some(value) => value.clone(),
            None => common_value(a, b)?,
        };
        self.check_value(tier, first.into(), &value)?;
        let parent = a.parent.and_then(|parent| self.set.annotation(parent));
        if let (true, Some(parent)) = (listed, parent) {
            let list = self
                .siblings(a)
                .into_iter()
                .filter(|sibling| sibling.id != second);
            let list: Vec<Annotation> = list.cloned().collect();
            let count = list.len();
            for (place, sibling) in list.into_iter().enumerate() {
                let order = u32::try_from(place).unwrap_or(u32::MAX);
                let span = share(parent.span, place, count);
                if sibling.id == first {
                    self.join(
                        a,
                        b,
                        Annotation {
                            order,
                            span,
                            value: value.clone(),
                            ..sibling
                        },
                        seam,
                    )?;
                } else {
                    self.put_fitting(Annotation {
                        order,
                        span,
                        ..sibling
                    });
                }
            }
            return Ok(());
        }
        self.join(
            a,
            b,
            Annotation {
                span: hull(a.span, b.span),
                value,
                ..a.clone()
            },
            seam,
        )
    }

    fn are_neighbours(&self, tier: &Tier, a: &Annotation, b: &Annotation) -> bool {
        if a.id == b.id || a.tier != b.tier || a.parent != b.parent {
            return false;
        }
        if tier.is_alignable() {
            let between = Span::between(a.span.end(), b.span.start());
            return a.span.end() <= b.span.start()
                && self.set.overlapping(tier.id, between).is_empty();
        }
        tier.stereotype() == Some(Stereotype::SymbolicSubdivision)
            && self.neighbours(a).1.is_some_and(|after| after.id == b.id)
    }

    /// Puts `joined` in place of `a`, removes `b`, and joins their children.
    fn join(&mut self, a: &Annotation, b: &Annotation, joined: Annotation, seam: Seam) -> Done {
        let (id, span) = (joined.id, joined.span);
        self.puts.push(joined);
        self.removed.push(b.id);
        let set = self.set;
        for tier in set.tiers_below(a.tier) {
            let (left, right) = (self.family(a.id, tier.id), self.family(b.id, tier.id));
            match tier.stereotype() {
                Some(Stereotype::SymbolicAssociation) => {
                    self.join_associated(&left, &right, id, span)?
                }
                Some(Stereotype::SymbolicSubdivision) | None => {
                    let both = left.into_iter().chain(right).cloned();
                    let list = both.map(|child| Annotation {
                        parent: Some(id),
                        ..child
                    });
                    self.put_list(span, list.collect());
                }
                Some(stereotype) => {
                    let tiles = stereotype == Stereotype::TimeSubdivision;
                    self.join_aligned(&left, &right, (id, span, tiles), seam)?;
                }
            }
        }
        Ok(())
    }

    fn join_associated(
        &mut self,
        left: &[&Annotation],
        right: &[&Annotation],
        parent: AnnotationId,
        span: Span,
    ) -> Done {
        match (left.first(), right.first()) {
            (Some(a), Some(b)) => {
                let value = common_value(a, b)?;
                self.join(
                    a,
                    b,
                    Annotation {
                        span,
                        value,
                        ..(*a).clone()
                    },
                    Seam::Keep,
                )
            }
            (Some(one), None) | (None, Some(one)) => {
                self.put_fitting(Annotation {
                    parent: Some(parent),
                    span,
                    ..(*one).clone()
                });
                Ok(())
            }
            (None, None) => Ok(()),
        }
    }

    fn join_aligned(
        &mut self,
        left: &[&Annotation],
        right: &[&Annotation],
        (parent, span, tiles): (AnnotationId, Span, bool),
        seam: Seam,
    ) -> Done {
        let meets = |a: &Annotation, b: &Annotation| {
            seam == Seam::Join && a.span.end() == b.span.start() && a.value == b.value
        };
        let pair = left.last().zip(right.first()).filter(|(a, b)| meets(a, b));
        let all: Vec<&Annotation> = left.iter().chain(right).copied().collect();
        let last = all.len().saturating_sub(1);
        for (place, child) in all.iter().enumerate() {
            let start = if tiles && place == 0 {
                span.start()
            } else {
                child.span.start()
            };
            let next = all
                .get(place + 1)
                .filter(|_| tiles && place + 1 == left.len());
            let end = match next {
                Some(next) => next.span.start(),
                None if tiles && place == last => span.end(),
                None => child.span.end(),
            };
            let new = Annotation {
                parent: Some(parent),
                span: Span::between(start, end),
                ..(*child).clone()
            };
            match pair {
                Some((a, b)) if a.id == child.id => {
                    let end = if tiles && place + 1 == last {
                        span.end()
                    } else {
                        b.span.end()
                    };
                    let span = Span::between(start, end);
                    self.join(a, b, Annotation { span, ..new }, seam)?;
                }
                Some((_, b)) if b.id == child.id => {}
                _ => self.put_fitting(new),
            }
        }
        Ok(())
    }
}

/// Returns the value that both have; if one is unset, the other's value.
fn common_value(a: &Annotation, b: &Annotation) -> Result<Reading, EditError> {
    match (&a.value, &b.value) {
        (Reading::Unset, value) | (value, Reading::Unset) => Ok(value.clone()),
        (one, other) if one == other => Ok(one.clone()),
        (one, other) => Err(EditError::ValuesDiffer {
            first: a.id,
            second: b.id,
            values: Box::new((one.clone(), other.clone())),
        }),
    }
}
