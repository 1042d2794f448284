//! Cuts an annotation in two, and merges two into one.

use super::error::EditError;
use super::tier_plan::{EditPlan, PlanResult};
use super::{AnnotationId, MergeSeam, Tier, TierAnnotation, TierStereotype, subdivision_share};
use crate::component::ComponentReading;
use chereme_motion::{RecordingInstant, TimeSpan};

impl EditPlan<'_> {
    pub(super) fn split_annotation(&mut self, id: AnnotationId, at: RecordingInstant) -> PlanResult {
        let (old, _) = self.require_aligned_annotation(id)?;
        if !(old.span.span_start_instant() < at && at < old.span.span_end_instant()) {
            return Err(EditError::CutOutside {
                annotation: id,
                at,
                span: old.span,
            });
        }
        self.cut_annotation(old, at, old.parent);
        Ok(())
    }

    /// Cuts an annotation in two; `parent` becomes the parent of the second half.
    fn cut_annotation(&mut self, old: &TierAnnotation, at: RecordingInstant, parent: Option<AnnotationId>) {
        let id = (self.fresh)();
        let first = TimeSpan::span_between(old.span.span_start_instant(), at);
        let span = TimeSpan::span_between(at, old.span.span_end_instant());
        self.puts.push(TierAnnotation {
            span: first,
            ..old.clone()
        });
        self.puts.push(TierAnnotation {
            id,
            span,
            parent,
            ..old.clone()
        });
        let set = self.set;
        for tier in set.tiers_below(old.tier) {
            let children = self.annotation_children(old.id, tier.id);
            if !tier.is_alignable() {
                self.put_list(first, children.into_iter().cloned().collect());
                continue;
            }
            for child in children {
                // Children that end before the cut stay with the first half, whose handle does not change.
                if child.span.span_start_instant() >= at {
                    self.puts.push(TierAnnotation {
                        parent: Some(id),
                        ..child.clone()
                    });
                } else if child.span.span_end_instant() > at {
                    self.cut_annotation(child, at, Some(id));
                }
            }
        }
    }

    pub(super) fn merge_annotations(
        &mut self,
        first: AnnotationId,
        second: AnnotationId,
        value: Option<&ComponentReading>,
        seam: MergeSeam,
    ) -> PlanResult {
        let (a, b) = (self.require_annotation(first)?, self.require_annotation(second)?);
        let tier = self.require_tier(a.tier)?;
        let listed = tier.tier_stereotype() == Some(TierStereotype::SymbolicSubdivision);
        if !self.are_neighbours(tier, a, b) {
            return Err(EditError::NotNeighbours { first, second });
        }
        let value = match value {
            Some(value) => value.clone(),
            None => common_value(a, b)?,
        };
        self.check_value(tier, first.into(), &value)?;
        let parent = a.parent.and_then(|parent| self.set.annotation_by_id(parent));
        if let (true, Some(parent)) = (listed, parent) {
            let sibling_list = self
                .annotation_siblings(a)
                .into_iter()
                .filter(|sibling| sibling.id != second);
            let list: Vec<TierAnnotation> = sibling_list.cloned().collect();
            let count = list.len();
            for (place, sibling) in list.into_iter().enumerate() {
                let order = u32::try_from(place).unwrap_or(u32::MAX);
                let span = subdivision_share(parent.span, place, count);
                // The others move up one place, and share the time of their parent without the removed one.
                if sibling.id == first {
                    self.join_annotations(
                        a,
                        b,
                        TierAnnotation {
                            order,
                            span,
                            value: value.clone(),
                            ..sibling
                        },
                        seam,
                    )?;
                } else {
                    self.put_fitting(TierAnnotation { order, span, ..sibling });
                }
            }
            return Ok(());
        }
        self.join_annotations(
            a,
            b,
            TierAnnotation {
                span: a.span.enclosing_span(b.span),
                value,
                ..a.clone()
            },
            seam,
        )
    }

    fn are_neighbours(&self, tier: &Tier, a: &TierAnnotation, b: &TierAnnotation) -> bool {
        if a.id == b.id || a.tier != b.tier || a.parent != b.parent {
            return false;
        }
        if tier.is_alignable() {
            let between = TimeSpan::span_between(a.span.span_end_instant(), b.span.span_start_instant());
            return a.span.span_end_instant() <= b.span.span_start_instant()
                && self.set.overlapping_annotations(tier.id, between).is_empty();
        }
        tier.tier_stereotype() == Some(TierStereotype::SymbolicSubdivision)
            && self.annotation_neighbours(a).1.is_some_and(|after| after.id == b.id)
    }

    /// Puts `joined` in place of `a`, removes `b`, and joins their children.
    fn join_annotations(
        &mut self,
        a: &TierAnnotation,
        b: &TierAnnotation,
        joined: TierAnnotation,
        seam: MergeSeam,
    ) -> PlanResult {
        let (id, span) = (joined.id, joined.span);
        self.puts.push(joined);
        self.removed.push(b.id);
        let set = self.set;
        for tier in set.tiers_below(a.tier) {
            let (left, right) = (
                self.annotation_children(a.id, tier.id),
                self.annotation_children(b.id, tier.id),
            );
            match tier.tier_stereotype() {
                Some(TierStereotype::SymbolicAssociation) => self.join_associated(&left, &right, id, span)?,
                Some(TierStereotype::SymbolicSubdivision) | None => {
                    let both = left.into_iter().chain(right).cloned();
                    let list = both.map(|child| TierAnnotation {
                        parent: Some(id),
                        ..child
                    });
                    self.put_list(span, list.collect());
                }
                Some(stereotype) => {
                    let tiles = stereotype == TierStereotype::TimeSubdivision;
                    self.join_aligned(&left, &right, id, span, tiles, seam)?;
                }
            }
        }
        Ok(())
    }

    fn join_associated(
        &mut self,
        left: &[&TierAnnotation],
        right: &[&TierAnnotation],
        parent: AnnotationId,
        span: TimeSpan,
    ) -> PlanResult {
        match (left.first(), right.first()) {
            (Some(a), Some(b)) => {
                let value = common_value(a, b)?;
                self.join_annotations(
                    a,
                    b,
                    TierAnnotation {
                        span,
                        value,
                        ..(*a).clone()
                    },
                    MergeSeam::Keep,
                )
            }
            (Some(one), None) | (None, Some(one)) => {
                self.put_fitting(TierAnnotation {
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
        left: &[&TierAnnotation],
        right: &[&TierAnnotation],
        parent: AnnotationId,
        span: TimeSpan,
        tiles: bool,
        seam: MergeSeam,
    ) -> PlanResult {
        let meets = |a: &TierAnnotation, b: &TierAnnotation| {
            seam == MergeSeam::Join && a.span.span_end_instant() == b.span.span_start_instant() && a.value == b.value
        };
        let pair = left.last().zip(right.first()).filter(|(a, b)| meets(a, b));
        let all: Vec<&TierAnnotation> = left.iter().chain(right).copied().collect();
        let last = all.len().saturating_sub(1);
        for (place, child) in all.iter().enumerate() {
            let start = if tiles && place == 0 {
                span.span_start_instant()
            } else {
                child.span.span_start_instant()
            };
            // Tiles leave no gap, so that the last one of the left meets the first one of the right.
            let next = all.get(place + 1).filter(|_| tiles && place + 1 == left.len());
            let end = match next {
                Some(next) => next.span.span_start_instant(),
                None if tiles && place == last => span.span_end_instant(),
                None => child.span.span_end_instant(),
            };
            let new = TierAnnotation {
                parent: Some(parent),
                span: TimeSpan::span_between(start, end),
                ..(*child).clone()
            };
            match pair {
                Some((a, b)) if a.id == child.id => {
                    let end = if tiles && place + 1 == last {
                        span.span_end_instant()
                    } else {
                        b.span.span_end_instant()
                    };
                    let span = TimeSpan::span_between(start, end);
                    self.join_annotations(a, b, TierAnnotation { span, ..new }, seam)?;
                }
                // The second of the pair has gone into the first.
                Some((_, b)) if b.id == child.id => {}
                _ => self.put_fitting(new),
            }
        }
        Ok(())
    }
}

/// Returns the value that both have; if one is unset, the other's value.
fn common_value(a: &TierAnnotation, b: &TierAnnotation) -> Result<ComponentReading, EditError> {
    match (&a.value, &b.value) {
        (ComponentReading::Unset, value) | (value, ComponentReading::Unset) => Ok(value.clone()),
        (one, other) if one == other => Ok(one.clone()),
        (one, other) => Err(EditError::ValuesDiffer {
            first: a.id,
            second: b.id,
            values: Box::new((one.clone(), other.clone())),
        }),
    }
}
