//! Plans the edits that carry out a change with all its consequences.

use super::check::{Named, Violation, check_tiers, check_value, overlap};
use super::error::EditError;
use super::{Annotation, AnnotationId, Change, Edit, Stereotype, Tier, TierId, TierSet, share};
use crate::component::Reading;
use chereme_motion::{Instant, Span};

impl Change {
    /// Returns the annotations that the change names.
    #[must_use]
    pub fn annotations(&self) -> Vec<AnnotationId> {
        match self {
            Self::Add { .. } | Self::SetVocabulary { .. } => Vec::new(),
            Self::AddBelow { parent, .. } => vec![*parent],
            Self::Merge { first, second, .. } => vec![*first, *second],
            Self::Move { annotation, .. }
            | Self::Reorder { annotation, .. }
            | Self::Split { annotation, .. }
            | Self::Remove { annotation }
            | Self::SetValue { annotation, .. } => vec![*annotation],
        }
    }

    /// Returns the time around which [`plan`] examines annotations; `None` if it needs none.
    ///
    /// `named` are the annotations that the change [names](Self::annotations) and, of those on
    /// symbolic tiers, their parents. The tier set given to [`plan`] must hold every tier; on the
    /// changed tier and the tier above it the annotations that share an instant with this time or
    /// touch it; all annotations below those of the changed tier; and the named ones with their
    /// parents. For a change of vocabulary it must hold one annotation of the tier for each
    /// different value.
    #[must_use]
    pub fn window(&self, named: &[&Annotation]) -> Option<Span> {
        let own = match self {
            Self::Add { span, .. } | Self::Move { span, .. } => Some(*span),
            _ => None,
        };
        named
            .iter()
            .map(|annotation| annotation.span)
            .chain(own)
            .reduce(hull)
    }
}

pub(super) fn hull(a: Span, b: Span) -> Span {
    Span::between(a.start().min(b.start()), a.end().max(b.end()))
}

/// Returns the edits that carry out `change` with all its consequences.
///
/// `fresh` gives the handle of each new annotation. Nothing changes in `set`, which may be a whole recording or
/// only the neighbourhood that [`Change::window`] describes. The order of the edits never leaves an annotation
/// without its parent: first the written ones, parents first, then the removed ones, children first. A change
/// without effect gives no edits.
///
/// # Errors
/// [`EditError`] if the change would break a rule of [the tiers](super), or names something that does not exist. No
/// change is possible in a set whose [tiers alone](check_tiers) break a rule.
pub fn plan(
    set: &TierSet,
    change: &Change,
    fresh: &mut dyn FnMut() -> AnnotationId,
) -> Result<Vec<Edit>, EditError> {
    if let Some(violation) = check_tiers(set).into_iter().next() {
        return Err(violation.into());
    }
    let mut plan = EditPlan {
        set,
        fresh,
        puts: Vec::new(),
        removed: Vec::new(),
        vocabulary: None,
    };
    match change {
        Change::Add { tier, span, value } => plan.add(*tier, *span, value)?,
        Change::AddBelow {
            tier,
            parent,
            order,
            value,
        } => {
            plan.add_below(*tier, *parent, *order, value)?;
        }
        Change::Move { annotation, span } => plan.shift(*annotation, *span)?,
        Change::Reorder { annotation, order } => plan.reorder(*annotation, *order)?,
        Change::Split { annotation, at } => plan.split(*annotation, *at)?,
        Change::Merge {
            first,
            second,
            value,
            seam,
        } => {
            plan.merge(*first, *second, value.as_ref(), *seam)?;
        }
        Change::Remove { annotation } => plan.remove(*annotation)?,
        Change::SetValue { annotation, value } => plan.set_value(*annotation, value)?,
        Change::SetVocabulary { tier, vocabulary } => plan.set_vocabulary(*tier, vocabulary)?,
    }
    Ok(plan.edits())
}

pub(super) struct EditPlan<'a> {
    pub(super) set: &'a TierSet,
    pub(super) fresh: &'a mut dyn FnMut() -> AnnotationId,
    pub(super) puts: Vec<Annotation>,
    pub(super) removed: Vec<AnnotationId>,
    vocabulary: Option<Edit>,
}

pub(super) type Done = Result<(), EditError>;

impl<'a> EditPlan<'a> {
    fn edits(self) -> Vec<Edit> {
        let unchanged = |new: &Annotation| self.set.annotation(new.id) == Some(new);
        let puts = self
            .puts
            .into_iter()
            .filter(|new| !unchanged(new))
            .map(Edit::Put);
        let removed = self.removed.into_iter().rev().map(Edit::Remove);
        puts.chain(removed).chain(self.vocabulary).collect()
    }

    pub(super) fn tier(&self, id: TierId) -> Result<&'a Tier, EditError> {
        self.set.tier(id).ok_or(EditError::UnknownTier(id))
    }

    pub(super) fn annotation(&self, id: AnnotationId) -> Result<&'a Annotation, EditError> {
        self.set
            .annotation(id)
            .ok_or(EditError::UnknownAnnotation(id))
    }

    /// Returns the annotation and its tier, which must have times of its own.
    pub(super) fn aligned(
        &self,
        id: AnnotationId,
    ) -> Result<(&'a Annotation, &'a Tier), EditError> {
        let annotation = self.annotation(id)?;
        Ok((annotation, self.aligned_tier(annotation.tier)?))
    }

    fn aligned_tier(&self, id: TierId) -> Result<&'a Tier, EditError> {
        let tier = self.tier(id)?;
        match tier.stereotype() {
            Some(stereotype) if !stereotype.is_alignable() => Err(EditError::NoTime {
                tier: id,
                stereotype,
            }),
            _ => Ok(tier),
        }
    }

    pub(super) fn check_value(&self, tier: &Tier, annotation: Named, value: &Reading) -> Done {
        check_value(self.set, tier, annotation, value).map_or(Ok(()), |v| Err(v.into()))
    }

    /// Returns the siblings of an annotation below the same parent, itself among them, in order.
    pub(super) fn siblings(&self, annotation: &Annotation) -> Vec<&'a Annotation> {
        annotation
            .parent
            .map(|parent| self.family(parent, annotation.tier))
            .unwrap_or_default()
    }

    pub(super) fn family(&self, parent: AnnotationId, tier: TierId) -> Vec<&'a Annotation> {
        let mut family: Vec<&Annotation> = self.set.below_on(parent, tier).collect();
        family.sort_by_key(|child| child.order);
        family
    }

    fn add(&mut self, tier: TierId, span: Span, value: &Reading) -> Done {
        let tier = self.aligned_tier(tier)?;
        check_span(tier.id, Named(None), span)?;
        self.check_value(tier, Named(None), value)?;
        let parent = self.parent_for(tier, Named(None), span)?;
        if let (Some(parent), Some(Stereotype::TimeSubdivision)) = (parent, tier.stereotype()) {
            self.make_room(tier.id, parent, span)?;
        } else {
            self.check_free(tier.id, Named(None), span)?;
        }
        let (id, parent) = ((self.fresh)(), parent.map(|parent| parent.id));
        let value = value.clone();
        self.puts.push(Annotation {
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
        annotation: Named,
        span: Span,
    ) -> Result<Option<&'a Annotation>, EditError> {
        let Some(parent_tier) = tier.parent_id() else {
            return Ok(None);
        };
        let above = self.set.overlapping(parent_tier, span);
        let found = above.iter().find(|parent| parent.span.covers(span));
        let nearest = above.first().map(|parent| (parent.id, parent.span));
        found.copied().map(Some).ok_or(EditError::NoParent {
            annotation,
            span,
            parent_tier,
            nearest,
        })
    }

    fn check_free(&self, tier: TierId, annotation: Named, span: Span) -> Done {
        let mut obstacles = self.set.overlapping(tier, span).into_iter();
        match obstacles.find(|other| Some(other.id) != annotation.0) {
            Some(other) => Err(overlap(tier, annotation, span, other).into()),
            None => Ok(()),
        }
    }

    /// Clips the sibling whose head or tail a new annotation takes.
    fn make_room(&mut self, tier: TierId, parent: &Annotation, span: Span) -> Done {
        let siblings = self.family(parent.id, tier);
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
        let Some(old) = siblings.into_iter().find(|old| old.span.overlaps(span)) else {
            return Ok(());
        };
        let left = match (
            old.span.start() == span.start(),
            old.span.end() == span.end(),
        ) {
            (true, true) => return Err(overlap(tier, Named(None), span, old).into()),
            (true, false) if old.span.covers(span) => Span::between(span.end(), old.span.end()),
            (false, true) if old.span.covers(span) => Span::between(old.span.start(), span.start()),
            _ => {
                return Err(EditError::HeadOrTail {
                    tier,
                    sibling: old.id,
                });
            }
        };
        self.respan(old, left);
        Ok(())
    }

    fn add_below(
        &mut self,
        tier: TierId,
        parent: AnnotationId,
        order: Option<u32>,
        value: &Reading,
    ) -> Done {
        let tier = self.tier(tier)?;
        let Some((parent_tier, stereotype)) = tier.parent.filter(|_| !tier.is_alignable()) else {
            return Err(EditError::NotSymbolic { tier: tier.id });
        };
        let above = self.annotation(parent)?;
        if above.tier != parent_tier {
            return Err(EditError::WrongParent {
                tier: tier.id,
                parent_tier,
                parent,
            });
        }
        self.check_value(tier, Named(None), value)?;
        let siblings = self.family(parent, tier.id);
        if let (Stereotype::SymbolicAssociation, Some(other)) = (stereotype, siblings.first()) {
            let (tier, annotation, other) = (tier.id, Named(None), other.id);
            return Err(Violation::SecondAssociation {
                tier,
                annotation,
                parent,
                other,
            }
            .into());
        }
        let new = Annotation {
            id: (self.fresh)(),
            tier: tier.id,
            parent: Some(parent),
            order: 0,
            span: above.span,
            value: value.clone(),
        };
        let mut list: Vec<Annotation> = siblings.into_iter().cloned().collect();
        list.insert(place(order.unwrap_or(u32::MAX), list.len()), new);
        self.put_list(above.span, list);
        Ok(())
    }

    /// Puts the children of one parent on a Symbolic_Subdivision (or a single associated one) in
    /// this order, each with its share of the parent's time.
    pub(super) fn put_list(&mut self, parent: Span, list: Vec<Annotation>) {
        let count = list.len();
        for (place, mut child) in list.into_iter().enumerate() {
            child.order = u32::try_from(place).unwrap_or(u32::MAX);
            child.span = share(parent, place, count);
            self.put_fitting(child);
        }
    }

    /// Puts `new` and fits the annotations below it into its new time.
    pub(super) fn put_fitting(&mut self, new: Annotation) {
        let old = self.set.annotation(new.id);
        let span = new.span;
        self.puts.push(new);
        if let Some(old) = old.filter(|old| old.span != span) {
            self.fit_children(old, span);
        }
    }

    fn respan(&mut self, old: &Annotation, span: Span) {
        self.put_fitting(Annotation {
            span,
            ..old.clone()
        });
    }

    fn fit_children(&mut self, old: &Annotation, span: Span) {
        let set = self.set;
        for tier in set.tiers_below(old.tier) {
            let children = self.family(old.id, tier.id);
            match tier.stereotype() {
                Some(stereotype) if stereotype.is_alignable() => {
                    self.fit_aligned(old.span, span, stereotype, &children);
                }
                _ => self.put_list(span, children.into_iter().cloned().collect()),
            }
        }
    }

    /// Shifts aligned children with a parent that kept its length or went elsewhere; clips them to the parent otherwise.
    fn fit_aligned(&mut self, old: Span, new: Span, how: Stereotype, children: &[&Annotation]) {
        if old.micros() == new.micros() {
            let by = new.start().micros().saturating_sub(old.start().micros());
            for child in children {
                self.respan(child, child.span.shifted(by));
            }
            return;
        }
        let by = match old.overlaps(new) {
            true => 0,
            false => new.start().micros().saturating_sub(old.start().micros()),
        };
        let (left, gone): (Vec<&Annotation>, Vec<&Annotation>) = children
            .iter()
            .partition(|child| child.span.shifted(by).overlaps(new));
        let last = left.len().saturating_sub(1);
        for (place, child) in left.into_iter().enumerate() {
            let span = child.span.shifted(by);
            let clipped = span.intersection(new).unwrap_or(span);
            let tiles = how == Stereotype::TimeSubdivision;
            let start = if tiles && place == 0 {
                new.start()
            } else {
                clipped.start()
            };
            let end = if tiles && place == last {
                new.end()
            } else {
                clipped.end()
            };
            self.respan(child, Span::between(start, end));
        }
        for child in gone {
            self.remove_all(child);
        }
    }

    fn remove_all(&mut self, annotation: &Annotation) {
        self.removed.push(annotation.id);
        let set = self.set;
        for tier in set.tiers_below(annotation.tier) {
            for child in set.below_on(annotation.id, tier.id) {
                self.remove_all(child);
            }
        }
    }

    fn shift(&mut self, id: AnnotationId, span: Span) -> Done {
        let (old, tier) = self.aligned(id)?;
        check_span(tier.id, id.into(), span)?;
        if tier.stereotype() == Some(Stereotype::TimeSubdivision) {
            return self.shift_boundaries(old, span);
        }
        let parent = self
            .parent_for(tier, id.into(), span)?
            .map(|parent| parent.id);
        self.check_free(tier.id, id.into(), span)?;
        self.put_fitting(Annotation {
            span,
            parent,
            ..old.clone()
        });
        Ok(())
    }

    fn shift_boundaries(&mut self, old: &Annotation, span: Span) -> Done {
        let (before, after) = self.neighbours(old);
        let annotation = old.id;
        if span.start() != old.span.start() {
            let fixed = old.span.start();
            let from = before.map_or(fixed, |other| other.span.start().shifted(1));
            let to = if before.is_some() {
                span.end().shifted(-1)
            } else {
                fixed
            };
            check_boundary(annotation, span.start(), from, to)?;
        }
        if span.end() != old.span.end() {
            let fixed = old.span.end();
            let to = after.map_or(fixed, |other| other.span.end().shifted(-1));
            let from = if after.is_some() {
                span.start().shifted(1)
            } else {
                fixed
            };
            check_boundary(annotation, span.end(), from, to)?;
        }
        if let Some(before) = before {
            self.respan(before, Span::between(before.span.start(), span.start()));
        }
        self.respan(old, span);
        if let Some(after) = after {
            self.respan(after, Span::between(span.end(), after.span.end()));
        }
        Ok(())
    }

    pub(super) fn neighbours(
        &self,
        of: &Annotation,
    ) -> (Option<&'a Annotation>, Option<&'a Annotation>) {
        let siblings = self.siblings(of);
        let place = siblings.iter().position(|sibling| sibling.id == of.id);
        let at = |place: Option<usize>| place.and_then(|place| siblings.get(place).copied());
        (
            at(place.and_then(|place| place.checked_sub(1))),
            at(place.map(|place| place + 1)),
        )
    }

    fn reorder(&mut self, id: AnnotationId, order: u32) -> Done {
        let old = self.annotation(id)?;
        let tier = self.tier(old.tier)?;
        let (Some(Stereotype::SymbolicSubdivision), Some(parent)) = (tier.stereotype(), old.parent)
        else {
            return Err(EditError::NoOrder { tier: tier.id });
        };
        let parent = self.annotation(parent)?;
        let (mut list, moved): (Vec<Annotation>, Vec<Annotation>) = self
            .siblings(old)
            .into_iter()
            .cloned()
            .partition(|sibling| sibling.id != id);
        let at = place(order, list.len());
        list.splice(at..at, moved);
        self.put_list(parent.span, list);
        Ok(())
    }

    fn remove(&mut self, id: AnnotationId) -> Done {
        let old = self.annotation(id)?;
        let tier = self.tier(old.tier)?;
        match tier.stereotype() {
            Some(Stereotype::TimeSubdivision) => match self.neighbours(old) {
                (Some(other), _) | (None, Some(other)) => {
                    self.respan(other, hull(other.span, old.span));
                }
                (None, None) => {}
            },
            Some(Stereotype::SymbolicSubdivision) => {
                let left = self
                    .siblings(old)
                    .into_iter()
                    .filter(|sibling| sibling.id != id);
                let list = left.cloned().collect();
                if let Some(parent) = old.parent.and_then(|parent| self.set.annotation(parent)) {
                    self.put_list(parent.span, list);
                }
            }
            _ => {}
        }
        self.remove_all(old);
        Ok(())
    }

    fn set_value(&mut self, id: AnnotationId, value: &Reading) -> Done {
        let old = self.annotation(id)?;
        self.check_value(self.tier(old.tier)?, id.into(), value)?;
        self.puts.push(Annotation {
            value: value.clone(),
            ..old.clone()
        });
        Ok(())
    }

    fn set_vocabulary(&mut self, id: TierId, vocabulary: &Option<String>) -> Done {
        let tier = self.tier(id)?;
        if tier.vocabulary == *vocabulary {
            return Ok(());
        }
        let tier = Tier {
            vocabulary: vocabulary.clone(),
            ..tier.clone()
        };
        for annotation in self.set.on(id) {
            self.check_value(&tier, annotation.id.into(), &annotation.value)?;
        }
        self.vocabulary = Some(Edit::Vocabulary {
            tier: id,
            vocabulary: vocabulary.clone(),
        });
        Ok(())
    }
}

fn place(order: u32, count: usize) -> usize {
    usize::try_from(order).unwrap_or(usize::MAX).min(count)
}

fn check_span(tier: TierId, annotation: Named, span: Span) -> Done {
    let limit = Instant::from_micros(1 << 62);
    for at in [span.start(), span.end()] {
        if !(Instant::from_micros(-(1 << 62))..=limit).contains(&at) {
            return Err(EditError::TooFar { at });
        }
    }
    if span.is_empty() {
        return Err(Violation::ZeroLength {
            tier,
            annotation,
            at: span.start(),
        }
        .into());
    }
    Ok(())
}

fn check_boundary(annotation: AnnotationId, at: Instant, from: Instant, to: Instant) -> Done {
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
