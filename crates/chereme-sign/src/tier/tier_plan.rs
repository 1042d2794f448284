//! Plans the edits that carry out a change with all its consequences.

use super::error::EditError;
use super::tier_check::{NamedAnnotation, TierViolation, check_tiers, check_value, overlap_violation};
use super::{
    AnnotationId, AskedTierChange, Tier, TierAnnotation, TierEdit, TierId, TierSet, TierStereotype, subdivision_share,
};
use crate::component::ComponentReading;
use chereme_motion::{RecordingInstant, TimeSpan};

impl AskedTierChange {
    /// Returns the annotations that the change names.
    #[must_use]
    pub fn changed_annotations(&self) -> Vec<AnnotationId> {
        match self {
            Self::Add { .. } => Vec::new(),
            Self::AddBelow { parent, .. } => vec![*parent],
            Self::Merge { first, second, .. } => vec![*first, *second],
            Self::Move { annotation, .. }
            | Self::Reorder { annotation, .. }
            | Self::Split { annotation, .. }
            | Self::Remove { annotation }
            | Self::SetValue { annotation, .. } => vec![*annotation],
        }
    }

    /// Returns the time around which [`plan_tier_change`] examines annotations; `None` if it needs none.
    ///
    /// `named` are the annotations that the change [names](Self::changed_annotations) and, of those on
    /// symbolic tiers, their parents. The tier set given to [`plan_tier_change`] must hold every tier; on the
    /// changed tier and the tier above it the annotations that share an instant with this time or
    /// touch it; all annotations below those of the changed tier; and the named ones with their
    /// parents.
    #[must_use]
    pub fn change_window(&self, named: &[&TierAnnotation]) -> Option<TimeSpan> {
        let changed_span = match self {
            Self::Add { span, .. } | Self::Move { span, .. } => Some(*span),
            _ => None,
        };
        named
            .iter()
            .map(|annotation| annotation.span)
            .chain(changed_span)
            .reduce(TimeSpan::enclosing_span)
    }
}

/// Returns the edits that carry out `change` with all its consequences.
///
/// `fresh` gives the handle of each new annotation. Nothing changes in `set`, which may be a whole recording or
/// only the neighbourhood that [`AskedTierChange::change_window`] describes. The order of the edits never leaves an annotation
/// without its parent: first the written ones, parents first, then the removed ones, children first. A change
/// without effect gives no edits.
///
/// # Errors
/// [`EditError`] if the change would break a rule of [the tiers](super), or names something that does not exist. No
/// change is possible in a set whose [tiers alone](check_tiers) break a rule.
pub fn plan_tier_change(
    set: &TierSet,
    change: &AskedTierChange,
    fresh: &mut dyn FnMut() -> AnnotationId,
) -> Result<Vec<TierEdit>, EditError> {
    // Edits of tiers in a circle would not end.
    if let Some(violation) = check_tiers(set).into_iter().next() {
        return Err(violation.into());
    }
    let mut plan = EditPlan {
        set,
        fresh,
        puts: Vec::new(),
        removed: Vec::new(),
    };
    match change {
        AskedTierChange::Add { tier, span, value } => plan.plan_added_annotation(*tier, *span, value)?,
        AskedTierChange::AddBelow {
            tier,
            parent,
            order,
            value,
        } => {
            plan.add_below(*tier, *parent, *order, value)?;
        }
        AskedTierChange::Move { annotation, span } => plan.shift_annotation(*annotation, *span)?,
        AskedTierChange::Reorder { annotation, order } => plan.reorder(*annotation, *order)?,
        AskedTierChange::Split { annotation, at } => plan.split_annotation(*annotation, *at)?,
        AskedTierChange::Merge {
            first,
            second,
            value,
            seam,
        } => {
            plan.merge_annotations(*first, *second, value.as_ref(), *seam)?;
        }
        AskedTierChange::Remove { annotation } => plan.plan_annotation_removal(*annotation)?,
        AskedTierChange::SetValue { annotation, value } => plan.set_value(*annotation, value)?,
    }
    Ok(plan.planned_edits())
}

pub(super) struct EditPlan<'a> {
    pub(super) set: &'a TierSet,
    pub(super) fresh: &'a mut dyn FnMut() -> AnnotationId,
    pub(super) puts: Vec<TierAnnotation>,
    pub(super) removed: Vec<AnnotationId>,
}

pub(super) type PlanResult = Result<(), EditError>;

impl<'a> EditPlan<'a> {
    fn planned_edits(self) -> Vec<TierEdit> {
        let unchanged = |new: &TierAnnotation| self.set.annotation_by_id(new.id) == Some(new);
        let puts = self.puts.into_iter().filter(|new| !unchanged(new)).map(TierEdit::Put);
        let removed = self.removed.into_iter().rev().map(TierEdit::Remove);
        puts.chain(removed).collect()
    }

    pub(super) fn require_tier(&self, id: TierId) -> Result<&'a Tier, EditError> {
        self.set.tier_by_id(id).ok_or(EditError::UnknownTier(id))
    }

    pub(super) fn require_annotation(&self, id: AnnotationId) -> Result<&'a TierAnnotation, EditError> {
        self.set.annotation_by_id(id).ok_or(EditError::UnknownAnnotation(id))
    }

    /// Returns the annotation and its tier, which must have times of its own.
    pub(super) fn require_aligned_annotation(
        &self,
        id: AnnotationId,
    ) -> Result<(&'a TierAnnotation, &'a Tier), EditError> {
        let annotation = self.require_annotation(id)?;
        Ok((annotation, self.aligned_tier(annotation.tier)?))
    }

    fn aligned_tier(&self, id: TierId) -> Result<&'a Tier, EditError> {
        let tier = self.require_tier(id)?;
        match tier.tier_stereotype() {
            Some(stereotype) if !stereotype.is_alignable() => Err(EditError::NoTime { tier: id, stereotype }),
            _ => Ok(tier),
        }
    }

    pub(super) fn check_value(&self, tier: &Tier, annotation: NamedAnnotation, value: &ComponentReading) -> PlanResult {
        check_value(self.set, tier, annotation, value).map_or(Ok(()), |v| Err(v.into()))
    }

    /// Returns the siblings of an annotation below the same parent, itself among them, in order.
    pub(super) fn annotation_siblings(&self, annotation: &TierAnnotation) -> Vec<&'a TierAnnotation> {
        annotation
            .parent
            .map(|parent| self.annotation_children(parent, annotation.tier))
            .unwrap_or_default()
    }

    pub(super) fn annotation_children(&self, parent: AnnotationId, tier: TierId) -> Vec<&'a TierAnnotation> {
        let mut family: Vec<&TierAnnotation> = self.set.below_on(parent, tier).collect();
        family.sort_by_key(|child| child.order);
        family
    }

    fn plan_added_annotation(&mut self, tier: TierId, span: TimeSpan, value: &ComponentReading) -> PlanResult {
        let tier = self.aligned_tier(tier)?;
        check_span(tier.id, NamedAnnotation(None), span)?;
        self.check_value(tier, NamedAnnotation(None), value)?;
        let parent = self.parent_for(tier, NamedAnnotation(None), span)?;
        if let (Some(parent), Some(TierStereotype::TimeSubdivision)) = (parent, tier.tier_stereotype()) {
            self.clip_sibling_for_room(tier.id, parent, span)?;
        } else {
            self.check_free(tier.id, NamedAnnotation(None), span)?;
        }
        let (id, parent) = ((self.fresh)(), parent.map(|parent| parent.id));
        let value = value.clone();
        self.puts.push(TierAnnotation {
            id,
            tier: tier.id,
            parent,
            order: 0,
            span,
            value,
        });
        Ok(())
    }

    fn parent_for(
        &self,
        tier: &Tier,
        annotation: NamedAnnotation,
        span: TimeSpan,
    ) -> Result<Option<&'a TierAnnotation>, EditError> {
        let Some(parent_tier) = tier.parent_id() else {
            return Ok(None);
        };
        let above = self.set.overlapping_annotations(parent_tier, span);
        let covering_parent = above.iter().find(|parent| parent.span.has_span_inside(span));
        let nearest = above.first().map(|parent| (parent.id, parent.span));
        covering_parent.copied().map(Some).ok_or(EditError::NoParent {
            annotation,
            span,
            parent_tier,
            nearest,
        })
    }

    fn check_free(&self, tier: TierId, annotation: NamedAnnotation, span: TimeSpan) -> PlanResult {
        let mut obstacles = self.set.overlapping_annotations(tier, span).into_iter();
        match obstacles.find(|other| Some(other.id) != annotation.0) {
            Some(other) => Err(overlap_violation(tier, annotation, span, other).into()),
            None => Ok(()),
        }
    }

    /// Clips the sibling whose head or tail a new annotation takes.
    fn clip_sibling_for_room(&mut self, tier: TierId, parent: &TierAnnotation, span: TimeSpan) -> PlanResult {
        let siblings = self.annotation_children(parent.id, tier);
        // The first child of a subdivision has to fill its parent.
        if siblings.is_empty() {
            if span == parent.span {
                return Ok(());
            }
            let (parent, parent_span) = (parent.id, parent.span);
            return Err(EditError::FillParent {
                tier,
                parent,
                parent_span,
            });
        }
        let Some(old) = siblings.into_iter().find(|old| old.span.is_overlapping_span(span)) else {
            return Ok(());
        };
        let left = match (
            old.span.span_start_instant() == span.span_start_instant(),
            old.span.span_end_instant() == span.span_end_instant(),
        ) {
            (true, true) => {
                return Err(overlap_violation(tier, NamedAnnotation(None), span, old).into());
            }
            (true, false) if old.span.has_span_inside(span) => {
                TimeSpan::span_between(span.span_end_instant(), old.span.span_end_instant())
            }
            (false, true) if old.span.has_span_inside(span) => {
                TimeSpan::span_between(old.span.span_start_instant(), span.span_start_instant())
            }
            _ => {
                return Err(EditError::HeadOrTail { tier, sibling: old.id });
            }
        };
        self.replace_annotation_span(old, left);
        Ok(())
    }

    fn add_below(
        &mut self,
        tier: TierId,
        parent: AnnotationId,
        order: Option<u32>,
        value: &ComponentReading,
    ) -> PlanResult {
        let tier = self.require_tier(tier)?;
        let Some((parent_tier, stereotype)) = tier.parent.filter(|_| !tier.is_alignable()) else {
            return Err(EditError::NotSymbolic { tier: tier.id });
        };
        let above = self.require_annotation(parent)?;
        if above.tier != parent_tier {
            return Err(EditError::WrongParent {
                tier: tier.id,
                parent_tier,
                parent,
            });
        }
        self.check_value(tier, NamedAnnotation(None), value)?;
        let siblings = self.annotation_children(parent, tier.id);
        if let (TierStereotype::SymbolicAssociation, Some(other)) = (stereotype, siblings.first()) {
            let (tier, annotation, other) = (tier.id, NamedAnnotation(None), other.id);
            return Err(TierViolation::SecondAssociation {
                tier,
                annotation,
                parent,
                other,
            }
            .into());
        }
        let new = TierAnnotation {
            id: (self.fresh)(),
            tier: tier.id,
            parent: Some(parent),
            order: 0,
            span: above.span,
            value: value.clone(),
        };
        let mut list: Vec<TierAnnotation> = siblings.into_iter().cloned().collect();
        // Without an order it comes last.
        list.insert(clamp_order(order.unwrap_or(u32::MAX), list.len()), new);
        self.put_list(above.span, list);
        Ok(())
    }

    /// Puts the children of one parent on a Symbolic_Subdivision (or a single associated one) in
    /// this order, each with its share of the parent's time.
    pub(super) fn put_list(&mut self, parent: TimeSpan, list: Vec<TierAnnotation>) {
        let count = list.len();
        for (place, mut child) in list.into_iter().enumerate() {
            child.order = u32::try_from(place).unwrap_or(u32::MAX);
            child.span = subdivision_share(parent, place, count);
            self.put_fitting(child);
        }
    }

    /// Puts `new` and fits the annotations below it into its new time.
    pub(super) fn put_fitting(&mut self, new: TierAnnotation) {
        let old = self.set.annotation_by_id(new.id);
        let span = new.span;
        self.puts.push(new);
        if let Some(old) = old.filter(|old| old.span != span) {
            self.fit_children(old, span);
        }
    }

    fn replace_annotation_span(&mut self, old: &TierAnnotation, span: TimeSpan) {
        self.put_fitting(TierAnnotation { span, ..old.clone() });
    }

    fn fit_children(&mut self, old: &TierAnnotation, span: TimeSpan) {
        let set = self.set;
        for tier in set.tiers_below(old.tier) {
            let children = self.annotation_children(old.id, tier.id);
            match tier.tier_stereotype() {
                Some(stereotype) if stereotype.is_alignable() => {
                    self.fit_aligned(old.span, span, stereotype, &children);
                }
                _ => self.put_list(span, children.into_iter().cloned().collect()),
            }
        }
    }

    /// Shifts aligned children with a parent that kept its length or went elsewhere; clips them to the parent otherwise.
    fn fit_aligned(&mut self, old: TimeSpan, new: TimeSpan, how: TierStereotype, children: &[&TierAnnotation]) {
        if old.span_micros() == new.span_micros() {
            let by = new
                .span_start_instant()
                .instant_micros()
                .saturating_sub(old.span_start_instant().instant_micros());
            for child in children {
                self.replace_annotation_span(child, child.span.shifted_span(by));
            }
            return;
        }
        let by = match old.is_overlapping_span(new) {
            true => 0,
            false => new
                .span_start_instant()
                .instant_micros()
                .saturating_sub(old.span_start_instant().instant_micros()),
        };
        let (left, gone): (Vec<&TierAnnotation>, Vec<&TierAnnotation>) = children
            .iter()
            .partition(|child| child.span.shifted_span(by).is_overlapping_span(new));
        let last = left.len().saturating_sub(1);
        for (place, child) in left.into_iter().enumerate() {
            let span = child.span.shifted_span(by);
            let clipped = span.span_intersection(new).unwrap_or(span);
            let tiles = how == TierStereotype::TimeSubdivision;
            // Subdivisions tile their parent, so that the outermost ones take over its ends.
            let start = if tiles && place == 0 {
                new.span_start_instant()
            } else {
                clipped.span_start_instant()
            };
            let end = if tiles && place == last {
                new.span_end_instant()
            } else {
                clipped.span_end_instant()
            };
            self.replace_annotation_span(child, TimeSpan::span_between(start, end));
        }
        for child in gone {
            self.remove_all(child);
        }
    }

    fn remove_all(&mut self, annotation: &TierAnnotation) {
        self.removed.push(annotation.id);
        let set = self.set;
        for tier in set.tiers_below(annotation.tier) {
            for child in set.below_on(annotation.id, tier.id) {
                self.remove_all(child);
            }
        }
    }

    fn shift_annotation(&mut self, id: AnnotationId, span: TimeSpan) -> PlanResult {
        let (old, tier) = self.require_aligned_annotation(id)?;
        check_span(tier.id, id.into(), span)?;
        if tier.tier_stereotype() == Some(TierStereotype::TimeSubdivision) {
            return self.shift_boundaries(old, span);
        }
        let parent = self.parent_for(tier, id.into(), span)?.map(|parent| parent.id);
        self.check_free(tier.id, id.into(), span)?;
        self.put_fitting(TierAnnotation {
            span,
            parent,
            ..old.clone()
        });
        Ok(())
    }

    fn shift_boundaries(&mut self, old: &TierAnnotation, span: TimeSpan) -> PlanResult {
        let (before, after) = self.annotation_neighbours(old);
        let annotation = old.id;
        if span.span_start_instant() != old.span.span_start_instant() {
            // Without a neighbour the boundary is the parent's own.
            let fixed = old.span.span_start_instant();
            // At least a microsecond is left of the neighbour.
            let from = before.map_or(fixed, |other| other.span.span_start_instant().shifted_instant(1));
            let to = if before.is_some() {
                span.span_end_instant().shifted_instant(-1)
            } else {
                fixed
            };
            check_boundary(annotation, span.span_start_instant(), from, to)?;
        }
        if span.span_end_instant() != old.span.span_end_instant() {
            let fixed = old.span.span_end_instant();
            let to = after.map_or(fixed, |other| other.span.span_end_instant().shifted_instant(-1));
            let from = if after.is_some() {
                span.span_start_instant().shifted_instant(1)
            } else {
                fixed
            };
            check_boundary(annotation, span.span_end_instant(), from, to)?;
        }
        if let Some(before) = before {
            self.replace_annotation_span(
                before,
                TimeSpan::span_between(before.span.span_start_instant(), span.span_start_instant()),
            );
        }
        self.replace_annotation_span(old, span);
        if let Some(after) = after {
            self.replace_annotation_span(
                after,
                TimeSpan::span_between(span.span_end_instant(), after.span.span_end_instant()),
            );
        }
        Ok(())
    }

    pub(super) fn annotation_neighbours(
        &self,
        of: &TierAnnotation,
    ) -> (Option<&'a TierAnnotation>, Option<&'a TierAnnotation>) {
        let siblings = self.annotation_siblings(of);
        let place = siblings.iter().position(|sibling| sibling.id == of.id);
        let sibling_at = |place: Option<usize>| place.and_then(|place| siblings.get(place).copied());
        (
            sibling_at(place.and_then(|place| place.checked_sub(1))),
            sibling_at(place.map(|place| place + 1)),
        )
    }

    fn reorder(&mut self, id: AnnotationId, order: u32) -> PlanResult {
        let old = self.require_annotation(id)?;
        let tier = self.require_tier(old.tier)?;
        let (Some(TierStereotype::SymbolicSubdivision), Some(parent)) = (tier.tier_stereotype(), old.parent) else {
            return Err(EditError::NoOrder { tier: tier.id });
        };
        let parent = self.require_annotation(parent)?;
        let (mut list, moved): (Vec<TierAnnotation>, Vec<TierAnnotation>) = self
            .annotation_siblings(old)
            .into_iter()
            .cloned()
            .partition(|sibling| sibling.id != id);
        let index = clamp_order(order, list.len());
        list.splice(index..index, moved);
        self.put_list(parent.span, list);
        Ok(())
    }

    fn plan_annotation_removal(&mut self, id: AnnotationId) -> PlanResult {
        let old = self.require_annotation(id)?;
        let tier = self.require_tier(old.tier)?;
        match tier.tier_stereotype() {
            // Subdivisions leave no gap: a neighbour takes over the time.
            Some(TierStereotype::TimeSubdivision) => match self.annotation_neighbours(old) {
                (Some(other), _) | (None, Some(other)) => {
                    self.replace_annotation_span(other, other.span.enclosing_span(old.span));
                }
                (None, None) => {}
            },
            Some(TierStereotype::SymbolicSubdivision) => {
                let left = self
                    .annotation_siblings(old)
                    .into_iter()
                    .filter(|sibling| sibling.id != id);
                let list = left.cloned().collect();
                if let Some(parent) = old.parent.and_then(|parent| self.set.annotation_by_id(parent)) {
                    self.put_list(parent.span, list);
                }
            }
            _ => {}
        }
        self.remove_all(old);
        Ok(())
    }

    fn set_value(&mut self, id: AnnotationId, value: &ComponentReading) -> PlanResult {
        let old = self.require_annotation(id)?;
        self.check_value(self.require_tier(old.tier)?, id.into(), value)?;
        self.puts.push(TierAnnotation {
            value: value.clone(),
            ..old.clone()
        });
        Ok(())
    }
}

fn clamp_order(order: u32, count: usize) -> usize {
    usize::try_from(order).unwrap_or(usize::MAX).min(count)
}

fn check_span(tier: TierId, annotation: NamedAnnotation, span: TimeSpan) -> PlanResult {
    // Half of the range, so that no sum of two times overflows.
    let limit = RecordingInstant::from_micros(1 << 62);
    for at in [span.span_start_instant(), span.span_end_instant()] {
        if !(RecordingInstant::from_micros(-(1 << 62))..=limit).contains(&at) {
            return Err(EditError::TooFar { at });
        }
    }
    if span.is_empty() {
        return Err(TierViolation::ZeroLength {
            tier,
            annotation,
            at: span.span_start_instant(),
        }
        .into());
    }
    Ok(())
}

fn check_boundary(
    annotation: AnnotationId,
    at: RecordingInstant,
    from: RecordingInstant,
    to: RecordingInstant,
) -> PlanResult {
    if (from..=to).contains(&at) {
        Ok(())
    } else {
        Err(EditError::Boundary {
            annotation,
            at,
            from,
            to,
        })
    }
}
