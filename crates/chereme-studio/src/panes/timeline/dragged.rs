//! Changes of annotations in a drag, as the library computes them.

pub(crate) use chereme_corpus::drag_limits::*;
#[cfg(test)]
use chereme_corpus::{Contents, TierContents, TierRow};

#[cfg(test)]
use super::spans;

#[cfg(test)]
pub(super) mod tests {
    use super::spans::{Grip, Mode};
    use super::*;
    use chereme_corpus::{AnnotationColumns, RecordingRow, Stereotype, ValueState};
    use std::collections::BTreeSet;

    /// `(id, start, end, parent)`.
    type Said = (i64, i64, i64, Option<i64>);

    /// A recording of a second with tiers as `(id, parent, stereotype, annotations)`.
    pub(in crate::panes::timeline) fn contents(
        tiers: &[(i64, Option<i64>, &str, &[Said])],
    ) -> Contents {
        let tiers = tiers
            .iter()
            .map(|(id, parent, stereotype, all)| TierContents {
                row: TierRow {
                    id: *id,
                    parent_id: *parent,
                    stereotype: parent.and_then(|_| Stereotype::from_elan_name(stereotype)),
                    name: format!("tier {id}"),
                    ..TierRow::default()
                },
                annotations: AnnotationColumns {
                    ids: all.iter().map(|it| it.0).collect(),
                    starts: all.iter().map(|it| it.1).collect(),
                    ends: all.iter().map(|it| it.2).collect(),
                    states: vec![ValueState::Value; all.len()],
                    values: all.iter().map(|it| format!("v{}", it.0).into()).collect(),
                    parents: all.iter().map(|it| it.3).collect(),
                    confidences: vec![None; all.len()],
                },
            });
        Contents {
            generation: 1,
            recording: RecordingRow {
                id: 1,
                name: "r".into(),
                signer_id: None,
                signer: None,
                origin: chereme_corpus::Origin::Captured,
                duration_us: 1_000_000,
                licence: None,
                notes: None,
            },
            tiers: tiers.collect(),
            tokens: Vec::new(),
            media: Vec::new(),
            tracks: Vec::new(),
        }
    }

    #[test]
    fn children_stay_inside_and_move_with_a_dragged_parent() {
        let all = contents(&[
            (
                1,
                None,
                "",
                &[(1, 0, 400_000, None), (2, 500_000, 900_000, None)],
            ),
            (
                2,
                Some(1),
                "Included_In",
                &[
                    (3, 100_000, 200_000, Some(1)),
                    (4, 600_000, 700_000, Some(2)),
                ],
            ),
        ]);
        let one = held(&all, &BTreeSet::from([3]), true);
        assert_eq!(one.len(), 1);
        assert_eq!((one[0].limits.from, one[0].limits.to), (0, 400_000));
        let moved = one[0].dragged(Grip::Whole, 900_000, Mode::Normal);
        assert_eq!((moved[0].start, moved[0].end), (300_000, 400_000));
        let both = held(&all, &BTreeSet::from([1, 3, 4]), true);
        let tiers: Vec<_> = both.iter().map(|it| (it.tier, it.chosen.clone())).collect();
        assert_eq!(tiers, [(1, BTreeSet::from([1])), (2, BTreeSet::from([4]))]);
    }

    #[test]
    fn neighbours_on_a_tiled_tier_share_their_boundary() {
        let all = contents(&[
            (1, None, "", &[(1, 0, 400_000, None)]),
            (
                2,
                Some(1),
                "Time_Subdivision",
                &[(3, 0, 200_000, Some(1)), (4, 200_000, 400_000, Some(1))],
            ),
        ]);
        let held = held(&all, &BTreeSet::from([3]), true);
        let changed = held[0].dragged(Grip::End, 100_000, Mode::Shift);
        let spans: Vec<_> = changed.iter().map(|it| (it.id, it.start, it.end)).collect();
        assert_eq!(spans, [(3, 0, 300_000), (4, 300_000, 400_000)]);
        assert_eq!(held[0].asked(&changed), [changed[0]]);
        assert!(held[0].dragged(Grip::Start, -9, Mode::Normal).is_empty());
    }

    #[test]
    fn the_free_time_for_a_new_annotation_depends_on_the_tier_kind() {
        let parents: &[_] = &[(1, 0, 400_000, None), (2, 500_000, 900_000, None)];
        let below: &[_] = &[(3, 100_000, 200_000, Some(1))];
        let tiled: &[_] = &[(4, 0, 400_000, Some(1))];
        let all = contents(&[
            (1, None, "", parents),
            (2, Some(1), "Included_In", below),
            (3, Some(1), "Symbolic_Association", &[]),
            (4, Some(1), "Time_Subdivision", tiled),
        ]);
        let cases = [
            (0, (350_000, 600_000), Some((400_000, 500_000))),
            (1, (0, 950_000), Some((500_000, 900_000))),
            (1, (150_000, 450_000), Some((200_000, 400_000))),
            (2, (550_000, 560_000), Some((500_000, 900_000))),
            (2, (410_000, 450_000), None),
            (3, (100_000, 200_000), Some((100_000, 400_000))),
            (3, (600_000, 700_000), Some((500_000, 900_000))),
        ];
        for (tier, wanted, want) in cases {
            assert_eq!(
                room(&all, &all.tiers[tier], wanted),
                want,
                "{tier} {wanted:?}"
            );
        }
    }
}
