//! Changes of annotations in a drag, as the library computes them.

pub(crate) use chereme_corpus::drag_limits::*;

#[cfg(test)]
pub(super) mod tests {
    use chereme_corpus::{
        AnnotationColumns, RecordingContents, RecordingRow, TierContents, TierRow, TierStereotype, ValueState,
    };

    /// `(id, start, end, parent)`.
    type Said = (i64, i64, i64, Option<i64>);

    /// A recording of a second with tiers as `(id, parent, stereotype, annotations)`.
    pub(in crate::panes::timeline) fn contents(tiers: &[(i64, Option<i64>, &str, &[Said])]) -> RecordingContents {
        let tiers = tiers.iter().map(|(id, parent, stereotype, all)| TierContents {
            row: TierRow {
                id: *id,
                parent_id: *parent,
                stereotype: parent.and_then(|_| TierStereotype::from_elan_name(stereotype)),
                name: format!("tier {id}"),
                ..TierRow::default()
            },
            annotations: AnnotationColumns {
                ids: all.iter().map(|entry| entry.0).collect(),
                starts: all.iter().map(|entry| entry.1).collect(),
                ends: all.iter().map(|entry| entry.2).collect(),
                states: vec![ValueState::Value; all.len()],
                values: all.iter().map(|entry| format!("v{}", entry.0).into()).collect(),
                parents: all.iter().map(|entry| entry.3).collect(),
                confidences: vec![None; all.len()],
            },
        });
        RecordingContents {
            generation: 1,
            recording: RecordingRow {
                id: 1,
                name: "r".into(),
                signer_id: None,
                signer: None,
                origin: chereme_corpus::RecordOrigin::Captured,
                duration_us: 1_000_000,
                licence: None,
                notes: None,
            },
            tiers: tiers.collect(),
            tokens: Vec::new(),
            media: Vec::new(),
            tracks: Vec::new(),
            acceptor: chereme_corpus::ProposalAcceptor {
                author: "A".into(),
                handedness: chereme_sign::SignerHandedness::Right,
            },
        }
    }
}
