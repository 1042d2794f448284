//! The tier rules case by case, and their laws.

mod laws;

use super::*;
use chereme_motion::RecordingInstant;
use std::fmt::Write as _;

fn at(millis: i64) -> RecordingInstant {
    RecordingInstant::from_millis(millis)
}

fn span(start: i64, end: i64) -> TimeSpan {
    TimeSpan::span_between(at(start), at(end))
}

fn tier(id: u64, parent: Option<(u64, TierStereotype)>) -> Tier {
    let parent = parent.map(|(parent, stereotype)| (TierId(parent), stereotype));
    Tier {
        parent,
        ..Tier::root_tier(TierId(id), format!("tier {id}"))
    }
}

fn note(id: u64, tier: u64, parent: u64, order: u32, (start, end): (i64, i64)) -> TierAnnotation {
    TierAnnotation {
        id: AnnotationId(id),
        tier: TierId(tier),
        parent: (parent > 0).then_some(AnnotationId(parent)),
        order,
        span: span(start, end),
        value: ComponentReading::Value(format!("v{id}")),
    }
}

const GLOSS: u64 = 1;
const TIME: u64 = 2;
const INCLUDED: u64 = 3;
const LIST: u64 = 4;
const ASSOCIATED: u64 = 5;
const BELOW_INCLUDED: u64 = 6;
const BELOW_TIME: u64 = 7;
const BELOW_LIST: u64 = 8;

fn tiers() -> Vec<Tier> {
    use TierStereotype::*;
    vec![
        tier(GLOSS, None),
        tier(TIME, Some((GLOSS, TimeSubdivision))),
        tier(INCLUDED, Some((GLOSS, IncludedIn))),
        tier(LIST, Some((GLOSS, SymbolicSubdivision))),
        tier(ASSOCIATED, Some((GLOSS, SymbolicAssociation))),
        tier(BELOW_INCLUDED, Some((INCLUDED, TimeSubdivision))),
        tier(BELOW_TIME, Some((TIME, SymbolicAssociation))),
        tier(BELOW_LIST, Some((LIST, SymbolicSubdivision))),
    ]
}

/// Two glosses, the first with children on every tier.
fn example() -> TierSet {
    let notes = [
        note(10, GLOSS, 0, 0, (0, 10)),
        note(11, GLOSS, 0, 0, (10, 30)),
        note(12, GLOSS, 0, 0, (40, 50)),
        note(20, TIME, 10, 0, (0, 4)),
        note(21, TIME, 10, 0, (4, 10)),
        note(30, INCLUDED, 10, 0, (2, 6)),
        note(31, INCLUDED, 10, 0, (7, 9)),
        note(32, INCLUDED, 11, 0, (12, 20)),
        note(40, LIST, 10, 0, (0, 5)),
        note(41, LIST, 10, 1, (5, 10)),
        note(50, ASSOCIATED, 10, 0, (0, 10)),
        note(51, ASSOCIATED, 11, 0, (10, 30)),
        note(60, BELOW_INCLUDED, 30, 0, (2, 5)),
        note(61, BELOW_INCLUDED, 30, 0, (5, 6)),
        note(70, BELOW_TIME, 21, 0, (4, 10)),
        note(80, BELOW_LIST, 41, 0, (5, 10)),
    ];
    let set = TierSet::new(tiers(), notes);
    assert_eq!(check_tier_set(&set), []);
    set
}

fn show(set: &TierSet, edits: &[TierEdit]) -> String {
    let mut text = String::new();
    for edit in edits {
        match edit {
            TierEdit::Put(note) => {
                let (id, start, end) = (note.id.0, note.span.span_start_instant(), note.span.span_end_instant());
                let millis = |at: RecordingInstant| at.instant_micros() as f64 / 1000.0;
                let _ = write!(text, "{id}[{},{})", millis(start), millis(end));
                if let Some(old) = set.annotation_by_id(note.id) {
                    if old.parent != note.parent {
                        let _ = write!(text, "^{}", note.parent.map_or(0, |parent| parent.0));
                    }
                    if old.order != note.order {
                        let _ = write!(text, "#{}", note.order);
                    }
                    if old.value != note.value {
                        let _ = write!(text, "={}", note.value);
                    }
                } else {
                    let parent = note.parent.map_or(0, |parent| parent.0);
                    let _ = write!(text, "^{parent}#{}={}", note.order, note.value);
                }
            }
            TierEdit::Remove(id) => {
                let _ = write!(text, "-{}", id.0);
            }
        }
        text.push(' ');
    }
    text.trim_end().to_owned()
}

fn planned(set: &TierSet, change: &AskedTierChange) -> Result<Vec<TierEdit>, EditError> {
    let mut next = 100;
    plan_tier_change(set, change, &mut || {
        next += 1;
        AnnotationId(next)
    })
}

fn add(tier: u64, start: i64, end: i64) -> AskedTierChange {
    AskedTierChange::Add {
        tier: TierId(tier),
        span: span(start, end),
        value: "new".into(),
    }
}

fn add_below(tier: u64, parent: u64, order: Option<u32>) -> AskedTierChange {
    let (tier, parent) = (TierId(tier), AnnotationId(parent));
    AskedTierChange::AddBelow {
        tier,
        parent,
        order,
        value: "new".into(),
    }
}

fn shift(id: u64, start: i64, end: i64) -> AskedTierChange {
    AskedTierChange::Move {
        annotation: AnnotationId(id),
        span: span(start, end),
    }
}

fn split(id: u64, cut: i64) -> AskedTierChange {
    AskedTierChange::Split {
        annotation: AnnotationId(id),
        at: at(cut),
    }
}

fn merge(first: u64, second: u64, value: Option<&str>) -> AskedTierChange {
    let (first, second) = (AnnotationId(first), AnnotationId(second));
    AskedTierChange::Merge {
        first,
        second,
        value: value.map(ComponentReading::from),
        seam: MergeSeam::Keep,
    }
}

fn remove(id: u64) -> AskedTierChange {
    AskedTierChange::Remove {
        annotation: AnnotationId(id),
    }
}

#[test]
fn changes_bring_their_consequences() {
    let reorder = AskedTierChange::Reorder {
        annotation: AnnotationId(41),
        order: 0,
    };
    let same = AskedTierChange::SetValue {
        annotation: AnnotationId(10),
        value: "v10".into(),
    };
    for (change, edits) in [
        (add(GLOSS, 30, 40), "101[30,40)^0#0=new"),
        (add(INCLUDED, 20, 25), "101[20,25)^11#0=new"),
        (add(TIME, 10, 30), "101[10,30)^11#0=new"),
        (add(TIME, 4, 6), "21[6,10) 70[6,10) 101[4,6)^10#0=new"),
        (add(TIME, 2, 4), "20[0,2) 101[2,4)^10#0=new"),
        (
            add_below(LIST, 10, Some(1)),
            "40[0,3.333) 101[3.333,6.666)^10#1=new 41[6.666,10)#2 80[6.666,10)",
        ),
        (add_below(LIST, 11, None), "101[10,30)^11#0=new"),
        (add_below(ASSOCIATED, 12, None), "101[40,50)^12#0=new"),
        (
            shift(10, -10, 0),
            "10[-10,0) 20[-10,-6) 21[-6,0) 70[-6,0) 30[-8,-4) 60[-8,-5) 61[-5,-4) 31[-3,-1) \
             40[-10,-5) 41[-5,0) 80[-5,0) 50[-10,0)",
        ),
        (
            shift(10, 0, 5),
            "10[0,5) 21[4,5) 70[4,5) 30[2,5) 40[0,2.5) 41[2.5,5) 80[2.5,5) 50[0,5) -31 -61",
        ),
        (shift(31, 24, 28), "31[24,28)^11"),
        (shift(20, 0, 7), "20[0,7) 21[7,10) 70[7,10)"),
        (shift(60, 2, 3), "60[2,3) 61[3,6)"),
        (reorder, "41[0,5)#0 80[0,5) 40[5,10)#1"),
        (
            split(10, 4),
            "10[0,4) 101[4,10)^0#0=v10 21[4,10)^101 30[2,4) 102[4,6)^101#0=v30 60[2,4) \
             103[4,5)^102#0=v60 61[5,6)^102 31[7,9)^101 40[0,2) 41[2,4) 80[2,4) 50[0,4)",
        ),
        (split(20, 3), "20[0,3) 101[3,4)^10#0=v20"),
        (merge(11, 12, Some("x")), "11[10,50)=x 51[10,50) -12"),
        (merge(20, 21, Some("x")), "20[0,10)=x 70[0,10)^20 -21"),
        (merge(40, 41, Some("x")), "40[0,10)=x 80[0,10)^40 -41"),
        (remove(11), "-51 -32 -11"),
        (remove(20), "21[0,10) 70[0,10) -20"),
        (remove(21), "20[0,10) -70 -21"),
        (remove(40), "41[0,10)#0 80[0,10) -40"),
        (remove(50), "-50"),
        (same, ""),
    ] {
        let set = example();
        let planned = planned(&set, &change).unwrap_or_else(|e| panic!("{change:?}: {e}"));
        assert_eq!(show(&set, &planned), edits, "{change:?}");
        let mut after = set;
        after.apply_edits(planned);
        assert_eq!(check_tier_set(&after), [], "{change:?}");
    }
}

#[test]
fn refusals_name_the_rule_and_the_remedy() {
    let reorder = AskedTierChange::Reorder {
        annotation: AnnotationId(10),
        order: 0,
    };
    for (change, message) in [
        (
            add(GLOSS, 5, 5),
            "the new annotation on tier:1 starts and ends at 0.005s; it must last at least a microsecond",
        ),
        (
            add(GLOSS, 35, 45),
            "the new annotation from 0.035s to 0.045s overlaps annotation:12 on tier:1; end it at 0.040s or before",
        ),
        (
            add(INCLUDED, 5, 12),
            "the new annotation from 0.005s to 0.012s must lie inside one annotation of tier:1; annotation:10 there lasts from 0.000s to 0.010s",
        ),
        (
            add(INCLUDED, 32, 36),
            "the new annotation from 0.032s to 0.036s must lie inside one annotation of tier:1",
        ),
        (
            add(TIME, 10, 20),
            "the first annotation of tier:2 below annotation:11 must last from 0.010s to 0.030s as that does; split it afterwards",
        ),
        (
            add(TIME, 5, 6),
            "on the Time_Subdivision tier:2 a new annotation takes the head or the tail of an existing one; split annotation:21 instead",
        ),
        (
            add(TIME, 0, 4),
            "the new annotation from 0.000s to 0.004s overlaps annotation:20 on tier:2; move one of the two, or shorten the other",
        ),
        (
            add(LIST, 0, 4),
            "tier:4 is a Symbolic_Subdivision: its annotations have no times of their own; change the one above",
        ),
        (add(99, 0, 4), "tier:99 does not exist"),
        (
            add_below(GLOSS, 10, None),
            "tier:1 has times of its own; give the new annotation a time instead of a parent",
        ),
        (
            add_below(LIST, 20, None),
            "annotation:20 is not on tier:1, the tier above tier:4",
        ),
        (
            add_below(ASSOCIATED, 10, None),
            "annotation:10 has annotation:50 on the Symbolic_Association tier:5 already; change that one, or remove the new annotation",
        ),
        (
            shift(11, 5, 30),
            "annotation:11 from 0.005s to 0.030s overlaps annotation:10 on tier:1; start it at 0.010s or after",
        ),
        (
            shift(20, 1, 4),
            "annotation:20 cannot have a boundary at 0.001s; between 0.000s and 0.000s is right",
        ),
        (
            shift(20, 0, 10),
            "annotation:20 cannot have a boundary at 0.010s; between 0.000s and 0.010s is right",
        ),
        (
            shift(50, 0, 4),
            "tier:5 is a Symbolic_Association: its annotations have no times of their own; change the one above",
        ),
        (shift(99, 0, 4), "annotation:99 does not exist"),
        (
            reorder,
            "tier:1 is no Symbolic_Subdivision: its annotations have no order to change",
        ),
        (
            split(10, 10),
            "annotation:10 cannot be cut at 0.010s; it lasts from 0.000s to 0.010s",
        ),
        (
            merge(10, 12, None),
            "annotation:10 and annotation:12 are not neighbours in this order on one tier below one parent; merge only such",
        ),
        (
            merge(11, 10, None),
            "annotation:11 and annotation:10 are not neighbours in this order on one tier below one parent; merge only such",
        ),
        (
            merge(31, 32, None),
            "annotation:31 and annotation:32 are not neighbours in this order on one tier below one parent; merge only such",
        ),
        (
            merge(11, 12, None),
            r#"annotation:11 says "v11" and annotation:12 says "v12"; give the value for the merged annotation"#,
        ),
        (
            merge(10, 11, Some("x")),
            r#"annotation:50 says "v50" and annotation:51 says "v51"; give the value for the merged annotation"#,
        ),
    ] {
        let error = planned(&example(), &change).expect_err(message);
        assert_eq!(error.to_string(), message);
    }
    let far = planned(&example(), &shift(12, i64::MAX - 9, i64::MAX));
    assert!(
        matches!(far, Err(EditError::TooFar { .. }) | Err(EditError::Breaks(_))),
        "{far:?}"
    );
}

#[test]
fn values_stay_in_the_vocabulary() {
    let glosses = Tier {
        vocabulary: Some("signs".to_owned()),
        ..tier(GLOSS, None)
    };
    let mut set = TierSet::new([glosses], [note(10, GLOSS, 0, 0, (0, 9))])
        .with_vocabulary("signs", ["BOL".to_owned(), "v10".to_owned()]);
    let say = |value: ComponentReading| AskedTierChange::SetValue {
        annotation: AnnotationId(10),
        value,
    };
    let error = planned(&set, &say("BLO".into())).expect_err("no such value");
    assert_eq!(
        error.to_string(),
        r#"annotation:10 on tier:1 says "BLO", which is not in "signs"; did you mean "BOL"?"#
    );
    for value in [
        ComponentReading::Unset,
        ComponentReading::Unclear,
        ComponentReading::NotApplicable,
        "BOL".into(),
    ] {
        set.apply_edits(planned(&set, &say(value)).expect("missing values belong to no vocabulary"));
        assert_eq!(check_tier_set(&set), []);
    }
}

#[test]
fn check_names_every_broken_rule() {
    use TierStereotype::*;
    let mut tiers = tiers();
    tiers.push(tier(9, Some((LIST, IncludedIn))));
    tiers.push(tier(10, Some((11, IncludedIn))));
    tiers.push(tier(11, Some((10, IncludedIn))));
    tiers.push(tier(12, Some((99, SymbolicAssociation))));
    tiers.push(Tier::root_tier(TierId(13), "tier 1"));
    let notes = [
        note(1, 77, 0, 0, (0, 1)),
        note(2, GLOSS, 0, 0, (0, 10)),
        note(3, GLOSS, 2, 0, (9, 20)),
        note(4, GLOSS, 0, 0, (30, 30)),
        note(5, TIME, 2, 0, (1, 4)),
        note(6, TIME, 2, 0, (5, 11)),
        note(7, INCLUDED, 0, 0, (0, 5)),
        note(8, LIST, 2, 3, (0, 10)),
        note(9, ASSOCIATED, 2, 0, (0, 9)),
        note(10, ASSOCIATED, 2, 0, (0, 10)),
    ];
    let found: Vec<String> = check_tier_set(&TierSet::new(tiers, notes))
        .iter()
        .map(|v| format!("{v:?}"))
        .collect();
    let kinds: Vec<&str> = found.iter().map(|v| v.split(' ').next().unwrap_or_default()).collect();
    assert_eq!(
        kinds,
        [
            "AlignableBelowSymbolic",
            "ParentCycle",
            "ParentCycle",
            "MissingParentTier",
            "DuplicateName",
            "MissingTier",
            "Overlap",
            "ParentOfRoot",
            "ZeroLength",
            "OutsideParent",
            "Gap",
            "Gap",
            "MissingParent",
            "Order",
            "DerivedSpan",
            "SecondAssociation",
        ],
        "{found:#?}"
    );
}

#[test]
fn a_long_chain_of_tiers_is_refused() {
    let chain = |id| tier(id, (id > 1).then_some((id - 1, TierStereotype::IncludedIn)));
    let set = TierSet::new((1..=10_000).map(chain), []);
    let first = check_tiers(&set).into_iter().next();
    assert_eq!(
        first,
        Some(TierViolation::TooDeep {
            tier: TierId(MAX_TIER_DEPTH as u64 + 2)
        })
    );
    assert!(matches!(planned(&set, &add(1, 0, 1)), Err(EditError::Breaks(_))));
}

#[test]
fn stereotypes_have_the_names_of_elan() {
    for stereotype in TierStereotype::ALL_TIER_STEREOTYPES {
        assert_eq!(TierStereotype::from_elan_name(stereotype.elan_name()), Some(stereotype));
    }
    assert_eq!(
        TierStereotype::from_elan_name("time subdivision"),
        Some(TierStereotype::TimeSubdivision)
    );
    assert_eq!(TierStereotype::from_elan_name("Sub"), None);
}
