//! Finds and mends a root whose columns have another order or unit than the header states.

use super::*;

/// Returns the factor for the root's positions that makes the legs reach the ground, if it is a ratio of common units,
/// such as metres for the root and centimetres for the bones.
pub(super) fn root_scale(first: &Clip, anatomy: &BodyAnatomy, up: DVec3) -> Option<f64> {
    let rest = first.clip_skeleton().rest_model_pose();
    let feet = BodySide::BOTH_SIDES.map(|side| anatomy.part_joint(BodyPart::Foot(side)));
    let [Some(right), Some(left)] = feet else {
        return None;
    };
    // The middle of both feet tolerates a step or a bend of the body.
    let leg = rest.model_joint_position(0).distance(
        rest.model_joint_position(right)
            .midpoint(rest.model_joint_position(left)),
    );
    // A root that never moves, or a file without frames, shows no height.
    first.joint_channel(0).translations.as_ref()?;
    first.clip_frame_count().checked_sub(1)?;
    let height = first.joint_translation(0, 0).dot(up).abs();
    let ratio = leg / height;
    // Only ratios between millimetres, centimetres and metres are mistakes of a unit.
    [0.001, 0.01, 100.0, 1000.0]
        .into_iter()
        .find(|step| (step / 2.0..step * 2.0).contains(&ratio))
}

/// Returns the remedy for root columns in another order or unit than the header states.
pub(super) fn mend_order() -> ErrorRemedy {
    ErrorRemedy::choice_remedy(
        RemedyChoice::RootOrder,
        "import it with --mend-root to read it so; the stored numbers stay the file's",
    )
}

/// Returns the stored name of a mended order of the root's columns.
pub(super) fn root_order(fix: Option<ChannelFix>) -> Option<&'static str> {
    fix.map(|ChannelFix::RotationBeforePosition| "rotation-before-position")
}

pub(super) fn root_read(fix: Option<ChannelFix>, scale: Option<f64>) -> RootRead {
    RootRead {
        root_order: root_order(fix).unwrap_or("as in the header"),
        root_scale: scale.unwrap_or(1.0),
    }
}

pub(super) fn mend_root(
    job: &ImportJob<'_>,
    track: i64,
    fix: Option<ChannelFix>,
    scale: Option<f64>,
    report: &mut FileReport,
) -> CorpusResult<()> {
    if job.options.mend_root {
        if fix.is_some() || scale.is_some() {
            stored_recordings::set_root(job.connection, track, root_order(fix), scale)?;
        }
        report.understood.root = Some(root_read(fix, scale));
        return Ok(());
    }
    if let Some(scale) = scale {
        report.findings.push(ReportFinding::finding_warning(
            format!(
                "the root seems to be in another unit than the bones: its positions times {scale} would \
                 put the feet on the ground"
            ),
            mend_order(),
        ));
    }
    Ok(())
}
