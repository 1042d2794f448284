//! Reads the paths of wrists from `.pose` and BVH files.

use std::path::Path;

use chereme_formats::tracks::CapturedTrackContent;
use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodySide, MarkerTrack};

use crate::Result;

/// The width of shoulders (m), the scale of pictures of signers.
const SHOULDERS: f64 = 0.36;
/// Samples per second of a path.
pub(crate) const RATE: f64 = 100.0;
/// Standard deviation (s) of the Gaussian that smooths paths: points estimated from film tremble.
const SMOOTH: f64 = 0.03;
/// The shortest take, in seconds.
const SHORTEST: f64 = 0.5;

/// The path of one wrist.
pub(crate) struct Take {
    /// The name of its file.
    pub(crate) file: String,
    /// Positions relative to the middle of the shoulders (m), [`RATE`] per second.
    pub(crate) path: Vec<DVec3>,
    /// Speeds in metres per second.
    pub(crate) speeds: Vec<f64>,
    /// Heights of elbow and wrist above their own shoulder in each frame that shows all three, in metres.
    pub(crate) heights: Vec<[f64; 2]>,
}

/// A wrist as a file has it: its path, and the heights of elbow and wrist above their shoulder.
struct Wrist {
    path: Vec<DVec3>,
    heights: Vec<[f64; 2]>,
}

/// Reads the wrists of a file.
pub(crate) fn read(path: &Path) -> Result<Vec<Take>> {
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let is_pose = path.extension().is_some_and(|ending| ending == "pose");
    let (rate, wrists) = if is_pose { film(path)? } else { skeleton(path)? };
    let takes = wrists.into_iter().filter_map(|wrist| {
        let path = smoothed(&resampled(&wrist.path, rate));
        let last = path.len().checked_sub(1)?;
        let speeds = (0..path.len()).map(|n| {
            let (a, b) = (n.saturating_sub(1), (n + 1).min(last));
            path[a].distance(path[b]) * RATE / (b - a).max(1) as f64
        });
        let speeds = speeds.collect();
        let file = file.clone().into_owned();
        (path.len() as f64 > SHORTEST * RATE).then_some(Take {
            file,
            path,
            speeds,
            heights: wrist.heights,
        })
    });
    Ok(takes.collect())
}

/// Returns the frames a second of a film, and the positions of its wrists.
fn film(path: &Path) -> Result<(f64, Vec<Wrist>)> {
    let (tracks, _) = chereme_formats::pose::read_pose_file(&std::fs::read(path)?)?;
    let track = tracks.tracks.first().ok_or("no track")?;
    let CapturedTrackContent::Markers(markers) = &track.content else {
        return Err("no points".into());
    };
    let rate =
        (markers.marker_frame_count().saturating_sub(1)) as f64 / markers.marker_track_span().span_seconds().max(1e-6);
    let rate = if markers.marker_frame_count() < 2 { 25.0 } else { rate };
    let shoulders = ["LEFT_SHOULDER", "RIGHT_SHOULDER"]
        .map(|name| places(markers, name))
        .into_iter()
        .collect::<Option<Vec<_>>>()
        .ok_or("no shoulders")?;
    let pairs = shoulders[0].iter().zip(&shoulders[1]);
    let pairs: Vec<[DVec3; 2]> = pairs.filter_map(|(a, b)| Some([(*a)?, (*b)?])).collect();
    let mut wide: Vec<f64> = pairs.iter().map(|[a, b]| a.distance(*b)).collect();
    wide.sort_by(f64::total_cmp);
    let wide = *wide.get(wide.len() / 2).ok_or("no shoulders are seen")?;
    if wide < 1e-6 {
        return Err("shoulders without width".into());
    }
    let middle = pairs.iter().map(|[a, b]| (*a + *b) / 2.0).sum::<DVec3>() / pairs.len() as f64;
    let wrists = ["LEFT", "RIGHT"].into_iter().filter_map(|side| {
        let of = |joint: &str| places(markers, &format!("{side}_{joint}"));
        let all = of("WRIST")?;
        let level = |at: DVec3| {
            let at = (at - middle) * (SHOULDERS / wide);
            DVec3::new(at.x, at.y, 0.0)
        };
        let heights = match (of("SHOULDER"), of("ELBOW")) {
            (Some(shoulders), Some(elbows)) => {
                let each = shoulders.iter().zip(&elbows).zip(&all);
                each.filter_map(|((shoulder, elbow), wrist)| {
                    let above = |at: &Option<DVec3>| Some(at.as_ref()?.y - shoulder.as_ref()?.y);
                    Some([above(elbow)?, above(wrist)?].map(|it| it * SHOULDERS / wide))
                })
                .collect()
            }
            _ => Vec::new(),
        };
        Some(Wrist {
            path: filled(&all)?.into_iter().map(level).collect(),
            heights,
        })
    });
    Ok((rate, wrists.collect()))
}

/// Returns the position of a point in each frame.
fn places(markers: &MarkerTrack, name: &str) -> Option<Vec<Option<DVec3>>> {
    let named = |known: &str| known == name || known.ends_with(&format!("/{name}"));
    let ends = |known: &str| known.ends_with(name);
    let points = markers.marker_points();
    let marker = points
        .iter()
        .find(|it| named(&it.name))
        .or_else(|| points.iter().find(|it| ends(&it.name)))?;
    let at = (0..markers.marker_frame_count()).map(|frame| {
        Some(
            markers
                .marker_space()
                .displayed_position(marker.marker_position(frame)?),
        )
    });
    Some(at.collect())
}

/// Fills gaps by straight lines; `None` if the point is seen in less than half of the frames.
fn filled(all: &[Option<DVec3>]) -> Option<Vec<DVec3>> {
    let known: Vec<(usize, DVec3)> = all.iter().enumerate().filter_map(|(n, at)| Some((n, (*at)?))).collect();
    if known.len() < 2 || 2 * known.len() < all.len() {
        return None;
    }
    let at = |n: usize| {
        let next = known.partition_point(|(other, _)| *other < n);
        let (to, end) = known[next.min(known.len() - 1)];
        let (from, start) = known[next.saturating_sub(1).min(known.len() - 1)];
        let share = (n as f64 - from as f64) / (to as f64 - from as f64).max(1.0);
        start.lerp(end, share.clamp(0.0, 1.0))
    };
    Some((0..all.len()).map(at).collect())
}

/// Returns the frames a second of a captured clip, and its wrists in the space of the trunk.
fn skeleton(path: &Path) -> Result<(f64, Vec<Wrist>)> {
    let whole = crate::take::bodies::movement(path)?;
    let (clip, anatomy): (_, &BodyAnatomy) = (&whole.clip, &whole.anatomy);
    let mut wrists = Vec::new();
    for side in BodySide::BOTH_SIDES {
        let Some(arm) = anatomy.arm_chain(side) else {
            continue;
        };
        let at = (0..clip.clip_frame_count()).map(|frame| {
            let model = clip.model_pose(frame);
            let body = anatomy.body_frame(&model)?;
            let offset = model.model_joint_position(arm.hand) - body.origin;
            let axes = [body.left, body.up, body.forward];
            Some(DVec3::from_array(axes.map(|axis| offset.dot(axis))))
        });
        let heights = (0..clip.clip_frame_count()).map(|frame| {
            let model = clip.model_pose(frame);
            let [shoulder, elbow, wrist] =
                [arm.upper, arm.forearm, arm.hand].map(|joint| model.model_joint_position(joint).y);
            let wide = anatomy.body_frame(&model).map_or(SHOULDERS, |body| body.scale);
            [elbow - shoulder, wrist - shoulder].map(|it| it * SHOULDERS / wide)
        });
        let heights = heights.collect();
        if let Some(path) = at.collect::<Option<Vec<_>>>() {
            wrists.push(Wrist { path, heights });
        }
    }
    Ok((clip.clip_frame_rate().per_second(), wrists))
}

/// Returns a path with [`RATE`] samples per second.
fn resampled(path: &[DVec3], rate: f64) -> Vec<DVec3> {
    let Some(last) = path.len().checked_sub(1) else {
        return Vec::new();
    };
    let steps = (last as f64 / rate * RATE) as usize + 1;
    let at = |step: usize| {
        let at = (step as f64 * rate / RATE).min(last as f64);
        let first = at as usize;
        path[first].lerp(path[(first + 1).min(last)], at - first as f64)
    };
    (0..steps).map(at).collect()
}

/// Smooths a path with a Gaussian.
fn smoothed(path: &[DVec3]) -> Vec<DVec3> {
    let wide = SMOOTH * RATE;
    let reach = (3.0 * wide) as usize;
    let last = path.len().saturating_sub(1);
    let at = |n: usize| {
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for away in -(reach as i64)..=reach as i64 {
            let weight = (-0.5 * (away as f64 / wide).powi(2)).exp();
            let other = (n as i64 + away).clamp(0, last as i64) as usize;
            sum += path[other] * weight;
            weights += weight;
        }
        sum / weights
    };
    (0..path.len()).map(at).collect()
}

#[path = "../notation/bodies.rs"]
#[allow(dead_code, reason = "only its reading of movement is needed")]
mod bodies;
