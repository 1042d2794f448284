//! Reads a BVH file again that is in the corpus already, in the manner that the options say.

use super::*;
use crate::db::motion;
use crate::import::again::{apply, groups_json, options_again, own_track};

/// Reads the movement of a recording again. The stored numbers stay those of the file, and so do the recording, its
/// annotations and its other tracks.
pub(super) fn read(
    job: &mut Job<'_>,
    recording: i64,
    mut report: FileReport,
    progress: &mut Progress<'_>,
) -> Result<FileReport> {
    let Some(standing) = own_track(job, recording, true, &mut report)? else {
        return Ok(report);
    };
    let was = &standing.track;
    let Opened {
        mut reader,
        size,
        mut block,
        mut more,
        hierarchy,
        rate,
        ..
    } = open(job)?;
    let first = first_frame(&hierarchy, &block, rate, None)?;
    let roles = was.roles().unwrap_or_default();
    let anatomy = Anatomy::with_roles(first.skeleton(), &roles)
        .map_err(|error| Error::wrong(error.to_string()))?;
    let guess = convention(&anatomy, first.skeleton(), &first, &hierarchy, &block, rate)?;
    let options = options_again(job.options, was, guess.convention);
    let mut fresh = FileReport::new(job.path, FileStatus::Updated);
    let found = understand(&options, &hierarchy, &block, rate, &mut fresh)?;
    let mut row = MotionTrackRow {
        metres_per_unit: found.convention.metres_per_unit,
        axes: found.convention.axes.to_string(),
        roles: options
            .roles
            .as_ref()
            .and_then(|roles| serde_json::to_string(roles).ok()),
        channel_groups: groups_json(&found.groups),
        ..was.row.clone()
    };
    let regrouped = row.channel_groups != was.row.channel_groups;
    if regrouped {
        motion::remove_blocks(job.connection, row.id)?;
    }
    if regrouped || job.options.mend_root {
        let groups = found.column_groups(&hierarchy);
        while more {
            if regrouped {
                let first = usize::try_from(block.first_frame).unwrap_or(usize::MAX);
                let (frames, columns) = (block.frames, &block.columns);
                movement::store_block(job.connection, row.id, &groups, first, frames, columns)?;
            }
            progress.report(Step {
                task: &job.file_name,
                done: reader.bytes_read(),
                total: Some(size),
                unit: Unit::Bytes,
            })?;
            more = reader.next_block(&mut block).map_err(wrong)?;
        }
    }
    if job.options.mend_root {
        let fix = reader.finish().root_fix;
        let first = first_frame(&was.hierarchy, &found.first, rate, fix)?;
        let scale = root_scale(&first, &found.anatomy, found.convention.axes.up().vector());
        row.root_order = root_order(fix).map(str::to_owned);
        row.root_scale = scale;
        fresh.understood.root = Some(root_read(fix, scale));
    }
    apply(job, &standing, &row, &found.anatomy, &mut report)?;
    report.understood = fresh.understood;
    if report.status == FileStatus::Updated {
        report.findings.extend(fresh.findings);
        report_odd_frames(job, recording, &mut report, progress)?;
    }
    Ok(report)
}
