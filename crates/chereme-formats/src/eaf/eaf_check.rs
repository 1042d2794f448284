//! Resolves the references of a raw document: ids to indices, once, with a finding for each that points
//! nowhere.

use super::eaf_raw::{AnnotationAnchor, EafDocument};
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use chereme_sign::TierStereotype;
use chereme_sign::tier::MAX_TIER_DEPTH;
use std::collections::{HashMap, HashSet};

/// The index of an annotation in the document, counted over all tiers.
pub(super) type AnnotationHandle = u32;

/// The resolved anchor of an annotation; its parts are empty if the reference points nowhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum AnnotationLink {
    /// Indices into the time order; `None` for a slot that does not exist.
    Slots(Option<u32>, Option<u32>),
    /// The annotations above and before it; `None` for one that does not exist.
    Parent(Option<AnnotationHandle>, Option<AnnotationHandle>),
}

/// The references of a document as indices.
#[derive(Debug, Default)]
pub(super) struct ResolvedReferences {
    /// Parents of the tiers; cycles are cut.
    pub(super) parents: Vec<Option<usize>>,
    /// Linguistic types of the tiers.
    pub(super) types: Vec<Option<usize>>,
    /// Stereotypes of the tiers; a child tier whose type states none is Included_In.
    pub(super) stereotypes: Vec<Option<TierStereotype>>,
    /// Tiers, parents before children.
    pub(super) order: Vec<usize>,
    /// The first annotation of each tier, and the number of all.
    pub(super) first: Vec<AnnotationHandle>,
    /// The anchor of each annotation.
    pub(super) links: Vec<AnnotationLink>,
    /// Annotations whose id is empty or already used.
    pub(super) doubles: HashSet<AnnotationHandle>,
}

/// Maps texts such as `ts12` to numbers; fast if they are a common prefix and a count.
#[derive(Default)]
struct EafIdTable<'d> {
    prefix: Option<&'d str>,
    dense: Vec<u32>,
    other: HashMap<&'d str, u32>,
    limit: usize,
}

impl<'d> EafIdTable<'d> {
    fn new(count: usize) -> Self {
        Self {
            limit: count.saturating_mul(4).saturating_add(1024),
            ..Self::default()
        }
    }

    /// Stores `number` under `id` unless it is taken.
    fn insert_eaf_id(&mut self, id: &'d str, number: u32) -> bool {
        if let Some((prefix, at)) = split_counted_id(id).filter(|(_, at)| *at < self.limit)
            && *self.prefix.get_or_insert(prefix) == prefix
        {
            if at >= self.dense.len() {
                self.dense.resize((at + 1).next_power_of_two().max(256), u32::MAX);
            }
            let free = self.dense[at] == u32::MAX;
            if free {
                self.dense[at] = number;
            }
            return free;
        }
        let mut free = false;
        self.other.entry(id).or_insert_with(|| {
            free = true;
            number
        });
        free
    }

    fn find_eaf_id(&self, id: &str) -> Option<u32> {
        match split_counted_id(id) {
            Some((prefix, at)) if at < self.limit && self.prefix == Some(prefix) => {
                self.dense.get(at).copied().filter(|number| *number != u32::MAX)
            }
            _ => self.other.get(id).copied(),
        }
    }
}

/// Splits `ts12` into `ts` and 12; `None` for leading zeros and long numbers.
fn split_counted_id(id: &str) -> Option<(&str, usize)> {
    let digits = id.bytes().rev().take(10).take_while(u8::is_ascii_digit).count();
    let (prefix, number) = id.split_at(id.len() - digits);
    let plain = (1..=9).contains(&digits) && (digits == 1 || !number.starts_with('0'));
    plain.then(|| Some((prefix, number.parse().ok()?))).flatten()
}

/// Resolves every reference of `doc`.
pub(super) fn resolve_eaf_references(doc: &EafDocument<'_>) -> (ResolvedReferences, Vec<ImportFinding>) {
    let mut findings = FindingTally::default();
    let mut resolved = resolve_tier_references(doc, &mut findings);
    let slots = collect_slot_ids(doc, &mut findings);
    let ids = collect_annotation_ids(doc, &mut resolved, &mut findings);
    resolved.links.reserve(*resolved.first.last().unwrap_or(&0) as usize);
    for (at, tier) in doc.tiers.iter().enumerate() {
        let symbolic = resolved.stereotypes[at].is_some_and(|stereotype| !stereotype.is_alignable());
        for annotation in &tier.annotations {
            let id = &*annotation.id;
            let line = || doc.line_of_element(annotation.at);
            let link = match &annotation.anchor {
                AnnotationAnchor::Slots { start, end } => {
                    let mut find = |name: &str| {
                        let slot = slots.find_eaf_id(name);
                        if slot.is_none() {
                            findings.add_limited_finding("annotations on time slots that are not there", || {
                                missing_reference_finding(line(), id, "the time slot", name)
                            });
                        }
                        slot
                    };
                    AnnotationLink::Slots(find(start), find(end))
                }
                AnnotationAnchor::Parent { parent, previous } => {
                    let above = ids.find_eaf_id(parent);
                    if above.is_none() {
                        findings.add_limited_finding("annotations below annotations that are not there", || {
                            missing_reference_finding(line(), id, "the annotation above,", parent)
                        });
                    }
                    let before = previous.as_deref().and_then(|previous| {
                        let before = ids.find_eaf_id(previous);
                        if before.is_none() {
                            findings.add_limited_finding("annotations after annotations that are not there", || {
                                missing_reference_finding(line(), id, "the annotation before,", previous)
                            });
                        }
                        before
                    });
                    AnnotationLink::Parent(above, before)
                }
            };
            if symbolic != matches!(link, AnnotationLink::Parent(..)) {
                findings.add_limited_finding("annotations of another kind than their tier's type", || {
                    let kind = if symbolic {
                        "time slots, and its tier's type is symbolic"
                    } else {
                        "a parent annotation, and its tier's type is alignable"
                    };
                    ImportFinding::new_warning_finding(line(), format!("annotation {id:?} has {kind}"))
                });
            }
            resolved.links.push(link);
        }
    }
    (resolved, findings.finish_finding_tally())
}

fn missing_reference_finding(line: Option<u64>, id: &str, what: &str, name: &str) -> ImportFinding {
    ImportFinding::new_warning_finding(
        line,
        format!("annotation {id:?} refers to {what} {name:?}, which is not in the file"),
    )
}

fn collect_slot_ids<'d>(doc: &'d EafDocument<'_>, findings: &mut FindingTally) -> EafIdTable<'d> {
    let mut ids = EafIdTable::new(doc.time_order.len());
    for (number, slot) in (0u32..).zip(&doc.time_order) {
        if !ids.insert_eaf_id(&slot.id, number) {
            findings.add_limited_warning("time slot ids given twice", doc.line_of_element(slot.at), || {
                format!("the time slot id {:?} is given twice; the first counts", slot.id)
            });
        }
        if slot.value.is_some_and(|value| value < 0) {
            findings.add_limited_note("times before the start", doc.line_of_element(slot.at), || {
                format!("the time slot {:?} lies before the start", slot.id)
            });
        }
    }
    ids
}

fn collect_annotation_ids<'d>(
    doc: &'d EafDocument<'_>,
    resolved: &mut ResolvedReferences,
    findings: &mut FindingTally,
) -> EafIdTable<'d> {
    let count = doc.tiers.iter().map(|tier| tier.annotations.len()).sum();
    let mut ids = EafIdTable::new(count);
    let mut handle: AnnotationHandle = 0;
    for tier in &doc.tiers {
        resolved.first.push(handle);
        for annotation in &tier.annotations {
            if annotation.id.is_empty() || !ids.insert_eaf_id(&annotation.id, handle) {
                resolved.doubles.insert(handle);
                findings.add_limited_finding("annotation ids given twice", || {
                    let id = &annotation.id;
                    ImportFinding::new_warning_finding(
                        doc.line_of_element(annotation.at),
                        format!("the annotation id {id:?} is empty or given twice; this annotation gets a new one"),
                    )
                });
            }
            handle += 1;
        }
    }
    resolved.first.push(handle);
    ids
}

fn resolve_tier_references(doc: &EafDocument<'_>, findings: &mut FindingTally) -> ResolvedReferences {
    let mut names = HashMap::new();
    for (at, tier) in doc.tiers.iter().enumerate() {
        // Of two tiers of one name the first is the parent that others name.
        if *names.entry(&*tier.id).or_insert(at) != at {
            findings.add_limited_warning("tier names given twice", doc.line_of_element(tier.at), || {
                format!("the tier {:?} is there twice; this one gets a number", tier.id)
            });
        }
    }
    let mut kinds = HashMap::new();
    for (at, kind) in doc.linguistic_types.iter().enumerate() {
        if *kinds.entry(&*kind.id).or_insert(at) != at {
            findings.add_limited_warning("tier types given twice", doc.line_of_element(kind.at), || {
                format!("the tier type {:?} is there twice; the first counts", kind.id)
            });
        }
    }
    let mut resolved = ResolvedReferences::default();
    for tier in &doc.tiers {
        let kind = kinds.get(&*tier.linguistic_type).copied();
        if kind.is_none() {
            findings.add_limited_finding("tier types that are not there", || {
                let (id, kind) = (&tier.id, &tier.linguistic_type);
                ImportFinding::new_warning_finding(
                    doc.line_of_element(tier.at),
                    format!("the tier {id:?} has the type {kind:?}, which is not in the file"),
                )
            });
        }
        let parent = tier.parent.as_deref().and_then(|parent| {
            let above = names.get(parent).copied();
            if above.is_none() {
                findings.add_limited_finding("parent tiers that are not there", || {
                    let id = &tier.id;
                    ImportFinding::new_warning_finding(
                        doc.line_of_element(tier.at),
                        format!(
                            "the tier {id:?} hangs below {parent:?}, which is not in the file; it becomes a root tier"
                        ),
                    )
                });
            }
            above
        });
        resolved.types.push(kind);
        resolved.parents.push(parent);
    }
    order_resolved_tiers(doc, &mut resolved, findings);
    stereotypes(doc, &mut resolved, findings);
    resolved
}

/// Sorts the tiers parents first; a tier that hangs below itself, or below too many others, becomes a root.
fn order_resolved_tiers(doc: &EafDocument<'_>, resolved: &mut ResolvedReferences, findings: &mut FindingTally) {
    let count = doc.tiers.len();
    let mut placed = vec![false; count];
    let mut visiting = vec![false; count];
    for start in 0..count {
        let mut path = Vec::new();
        let mut current_tier = start;
        // Climbs to the first tier that has its place, or to one met on the way: a circle.
        while !placed[current_tier] && !visiting[current_tier] {
            visiting[current_tier] = true;
            path.push(current_tier);
            match resolved.parents[current_tier] {
                Some(above) if visiting[above] && !placed[above] => {
                    findings.add_limited_finding("tiers below themselves", || {
                        let tier = &doc.tiers[current_tier];
                        ImportFinding::new_warning_finding(
                            doc.line_of_element(tier.at),
                            format!("the tier {:?} hangs below itself; it becomes a root tier", tier.id),
                        )
                    });
                    resolved.parents[current_tier] = None;
                }
                Some(above) => current_tier = above,
                None => {}
            }
        }
        // The path leads upwards, so that its end comes first.
        for tier in path.into_iter().rev() {
            placed[tier] = true;
            resolved.order.push(tier);
        }
    }
    let mut depths = vec![0; count];
    for &at in &resolved.order {
        let depth = resolved.parents[at].map_or(0, |above| depths[above] + 1);
        if depth <= MAX_TIER_DEPTH {
            depths[at] = depth;
            continue;
        }
        resolved.parents[at] = None;
        findings.add_limited_finding("tiers below too many others", || {
            let tier = &doc.tiers[at];
            let what = format!(
                "the tier {:?} hangs below more than {MAX_TIER_DEPTH} others; it becomes a root tier",
                tier.id
            );
            ImportFinding::new_warning_finding(doc.line_of_element(tier.at), what)
        });
    }
}

fn stereotypes(doc: &EafDocument<'_>, resolved: &mut ResolvedReferences, findings: &mut FindingTally) {
    for (at, tier) in doc.tiers.iter().enumerate() {
        let kind = resolved.types[at].map(|kind| &doc.linguistic_types[kind]);
        let named = kind
            .and_then(|kind| kind.constraints.as_deref())
            .filter(|name| !name.is_empty());
        let stereotype = named.and_then(TierStereotype::from_elan_name);
        if let (Some(name), None) = (named, stereotype) {
            findings.add_limited_warning("unknown stereotypes", doc.line_of_element(tier.at), || {
                format!(
                    "the type of tier {:?} has the stereotype {name:?}, which is not one of ELAN's four",
                    tier.id
                )
            });
        }
        let child = resolved.parents[at].is_some();
        if child != stereotype.is_some() {
            findings.add_limited_finding("tiers whose place does not fit their type", || {
                let what = if child {
                    "hangs below another, and its type has no stereotype"
                } else {
                    "has no parent, and its type has a stereotype"
                };
                ImportFinding::new_warning_finding(
                    doc.line_of_element(tier.at),
                    format!("the tier {:?} {what}", tier.id),
                )
            });
        }
        let has_parents = || {
            tier.annotations
                .iter()
                .any(|annotation| matches!(annotation.anchor, AnnotationAnchor::Parent { .. }))
        };
        resolved.stereotypes.push(match stereotype {
            // Without a usable type the annotations show whether they have times; subdivision and Included_In ask
            // least of them.
            None if child && has_parents() => Some(TierStereotype::SymbolicSubdivision),
            None if child => Some(TierStereotype::IncludedIn),
            Some(_) if !child => None,
            known => known,
        });
    }
}
