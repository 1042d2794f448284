//! Recordings with tiers for tests of this module.

use chereme_sign::TierStereotype;

use crate::contents::{AnnotationColumns, RecordingContents, TierContents};
use crate::db::stored_columns::{RecordOrigin, ValueState};
use crate::db::stored_recordings::RecordingRow;
use crate::db::stored_tiers::TierRow;

/// `(id, start, end, parent)`.
type Said = (i64, i64, i64, Option<i64>);

/// A recording of a second with tiers as `(id, parent, stereotype, annotations)`.
pub(crate) fn contents(tiers: &[(i64, Option<i64>, &str, &[Said])]) -> RecordingContents {
    let tiers = tiers.iter().map(|(id, parent, stereotype, all)| TierContents {
        row: TierRow {
            id: *id,
            parent_id: *parent,
            stereotype: parent.and_then(|_| TierStereotype::from_elan_name(stereotype)),
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
    RecordingContents {
        generation: 1,
        recording: RecordingRow {
            id: 1,
            name: "r".into(),
            signer_id: None,
            signer: None,
            origin: RecordOrigin::Captured,
            duration_us: 1_000_000,
            licence: None,
            notes: None,
        },
        tiers: tiers.collect(),
        tokens: Vec::new(),
        media: Vec::new(),
        tracks: Vec::new(),
        acceptor: crate::ProposalAcceptor {
            author: "A".into(),
            handedness: chereme_sign::SignerHandedness::Right,
        },
    }
}
