//! Reads a BVH file again that is in the corpus already, in the manner that the options say.

use super::*;
use crate::db::stored_motion;
use crate::import::import_again::{apply_skeleton_reading, groups_json, options_again, own_track};

/// Reads the movement of a recording again. The stored numbers stay those of the file, and so do the recording, its
/// annotations and its other tracks.
pub(super) fn read_movement_again(
    job: &mut ImportJob<'_>,
    recording: i64,
    mut report: FileReport,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<FileReport> {
    let Some(standing) = own_track(job, recording, true, &mut report)? else {
        return Ok(report);
    };
    let was = &standing.track;
    let OpenedBvh {
        mut reader,
        size,
        mut block,
        mut more,
        hierarchy,
        rate,
        ..
    } = open_bvh_file(job)?;
    let first = first_frame(&hierarchy, &block, rate, None)?;
    // The guess is repeated as it was made then, so that what the user stated is distinguished from it.
    let roles = was.manual_joint_roles().unwrap_or_default();
    let anatomy = BodyAnatomy::with_roles(first.clip_skeleton(), &roles)
        .map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let guess = guess_bvh_convention(&anatomy, first.clip_skeleton(), &first, &hierarchy, &block, rate)?;
    let options = options_again(job.options, was, guess.convention);
    let mut fresh = FileReport::new(job.path, FileStatus::Updated);
    let understanding = understand(&options, &hierarchy, &block, rate, &mut fresh)?;
    let mut row = MotionTrackRow {
        metres_per_unit: understanding.convention.metres_per_unit,
        axes: understanding.convention.axes.to_string(),
        roles: options
            .roles
            .as_ref()
            .and_then(|roles| serde_json::to_string(roles).ok()),
        channel_groups: groups_json(&understanding.groups),
        ..was.row.clone()
    };
    let regrouped = row.channel_groups != was.row.channel_groups;
    // Blocks hold the joints of a group together, so that other groups need other blocks.
    if regrouped {
        stored_motion::remove_blocks(job.connection, row.id)?;
    }
    // The order of the root's columns is known only after all frames were read.
    if regrouped || job.options.mend_root {
        let groups = understanding.column_groups(&hierarchy);
        while more {
            if regrouped {
                let first = usize::try_from(block.first_frame).unwrap_or(usize::MAX);
                let (frames, columns) = (block.frames, &block.columns);
                movement::store_block_groups(job.connection, row.id, &groups, first, frames, columns)?;
            }
            progress.report_amount(ProgressUnit::Bytes, &job.file_name, reader.bytes_read(), Some(size))?;
            more = reader.next_block(&mut block).map_err(bvh_import_error)?;
        }
    }
    if job.options.mend_root {
        let fix = reader.finish_bvh_reading().root_fix;
        let first = first_frame(&was.hierarchy, &understanding.first, rate, fix)?;
        let scale = root_scale(
            &first,
            &understanding.anatomy,
            understanding.convention.axes.up_direction().axis_direction_vector(),
        );
        row.root_order = root_order(fix).map(str::to_owned);
        row.root_scale = scale;
        fresh.understood.root = Some(root_read(fix, scale));
    }
    apply_skeleton_reading(job, &standing, &row, &understanding.anatomy, &mut report)?;
    report.understood = fresh.understood;
    if report.status == FileStatus::Updated {
        report.findings.extend(fresh.findings);
        report_odd_frames(job, recording, &mut report, progress)?;
    }
    Ok(report)
}
