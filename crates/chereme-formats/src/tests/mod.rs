//! Golden tables: every field of documents that readers return, and what writers make of them.

mod annotations;
mod captures;
mod codings;

use chereme_motion::{Clip, CurveTrack, MarkerTrack};

use crate::ImportFinding;
use crate::golden::put;
use crate::tracks::{CapturedTrackContent, CapturedTracks};
use crate::transcript::AnnotationTranscript;

/// Writes down findings, one on each line.
pub(crate) fn findings(out: &mut String, all: &[ImportFinding]) {
    for it in all {
        let line = it.line.map_or("-".to_owned(), |line| line.to_string());
        put(
            out,
            format!("{:?} {line}: {} {:?} {:?}", it.severity, it.message, it.remedy, it.mend),
        );
    }
}

/// Writes down the tiers and annotations of a document, one on each line.
pub(crate) fn transcript(out: &mut String, it: &AnnotationTranscript) {
    put(
        out,
        format!(
            "by {:?} at {:?} media {:?} linked {:?} properties {:?}",
            it.author, it.date, it.media, it.linked_files, it.properties
        ),
    );
    for tier in &it.tiers {
        let mut head = tier.clone();
        head.annotations.clear();
        put(out, format!("{head:?}"));
        for annotation in &tier.annotations {
            put(out, format!("  {annotation:?}"));
        }
    }
    for vocabulary in &it.vocabularies {
        put(out, format!("{vocabulary:?}"));
    }
}

fn markers(out: &mut String, it: &MarkerTrack) {
    put(
        out,
        format!(
            "{:?} {:?} {:?} {:?} {} frames limbs {:?}",
            it.marker_space(),
            it.marker_capture(),
            it.marker_quality(),
            it.marker_times(),
            it.marker_frame_count(),
            it.marker_limbs()
        ),
    );
    for point in it.marker_points() {
        put(out, format!("  {point:?}"));
    }
}

pub(crate) fn curves(out: &mut String, it: &CurveTrack) {
    put(out, format!("{:?} {} frames", it.curve_times(), it.curve_frame_count()));
    for curve in it.track_curves() {
        put(out, format!("  {curve:?}"));
    }
}

/// Writes down tracks with all their numbers, and their events.
pub(crate) fn tracks(out: &mut String, it: &CapturedTracks) {
    for track in &it.tracks {
        put(
            out,
            format!("{:?} offset {:?} clock {:?}", track.name, track.offset, track.clock),
        );
        match &track.content {
            CapturedTrackContent::Markers(it) => markers(out, it),
            CapturedTrackContent::Curves(it) => curves(out, it),
        }
    }
    if let Some(events) = &it.events {
        transcript(out, events);
    }
}

/// Writes down a clip: its joints, and some frames of each channel.
pub(crate) fn clip(out: &mut String, it: &Clip) {
    put(
        out,
        format!("{} frames at {:?}", it.clip_frame_count(), it.clip_frame_rate()),
    );
    let step = (it.clip_frame_count() / 3).max(1);
    for (n, joint) in it.clip_skeleton().skeleton_joints().iter().enumerate() {
        put(out, format!("{n} {joint:?}"));
        let channel = it.joint_channel(n);
        for frame in (0..it.clip_frame_count()).step_by(step) {
            let at = channel.translations.as_ref().map(|all| all[frame]);
            put(out, format!("  {frame}: {:?} {at:?}", channel.rotations[frame]));
        }
    }
}

/// Writes down bytes, 32 on each line; lines of zeros are left out.
pub(crate) fn bytes(out: &mut String, bytes: &[u8]) {
    put(out, format!("{} bytes", bytes.len()));
    for (n, row) in bytes.chunks(32).enumerate() {
        if row.iter().any(|byte| *byte != 0) {
            let digits: Vec<String> = row.iter().map(|byte| format!("{byte:02x}")).collect();
            put(out, format!("{:05} {}", 32 * n, digits.join(" ")));
        }
    }
}

/// Writes down the document inside a binary glTF, and its numbers.
pub(crate) fn scene_file(out: &mut String, file: &[u8]) {
    let length = u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
    let document: serde_json::Value = serde_json::from_slice(&file[20..20 + length]).expect("JSON");
    for (key, value) in document.as_object().expect("an object") {
        match value.as_array() {
            Some(all) => all.iter().for_each(|it| put(out, format!("{key}: {it}"))),
            None => {
                let value = value.to_string().replace(env!("CARGO_PKG_VERSION"), "VERSION");
                put(out, format!("{key}: {value}"));
            }
        }
    }
    let numbers = file[28 + length..].chunks_exact(4).map(|four| {
        let number = f32::from_le_bytes([four[0], four[1], four[2], four[3]]);
        // Indices are pairs of small integers, which would be tiny numbers.
        match number == 0.0 || number.is_normal() {
            true => format!("{number:?}"),
            false => format!("{four:?}"),
        }
    });
    let numbers: Vec<String> = numbers.collect();
    numbers.chunks(16).for_each(|row| put(out, row.join(" ")));
}

/// Returns a line for each tier of a transcript: its name, type and relation, and its annotations, each after the letter
/// of the one above it.
pub(crate) fn tiers_as_lines(transcript: &crate::transcript::AnnotationTranscript) -> Vec<String> {
    let line = |tier: &crate::transcript::TranscriptTier| {
        let mut line = format!("{} [{}]", tier.name, tier.kind);
        if let (Some(stereotype), Some(above)) = (tier.stereotype, tier.parent) {
            line += &format!(" {stereotype} of {}", transcript.tiers[above].name);
        }
        let annotations: Vec<String> = tier
            .annotations
            .iter()
            .map(|it| {
                let above = it
                    .parent
                    .map_or(String::new(), |it| format!("{} ", char::from(b'a' + it.index as u8)));
                let (start, end) = it.span.span_bounds_micros();
                format!(" {above}{start}-{end} {:?}", it.value)
            })
            .collect();
        format!("{line}:{}", annotations.join(","))
    };
    transcript.tiers.iter().map(line).collect()
}
