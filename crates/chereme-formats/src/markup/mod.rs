//! The parts that readers of annotation files in XML share: ANVIL's, EXMARaLDA's and SignStream's.

mod error;
mod markup_lanes;
mod markup_names;
mod markup_times;
mod markup_tree;

use std::collections::BTreeMap;

use crate::tally::FindingTally;
use crate::transcript::{AnnotationTiming, TranscriptAnnotation, TranscriptMedia};
use chereme_motion::{RecordingInstant, TimeSpan};

pub use error::MarkupError;
pub(crate) use markup_lanes::{MAX_TIER_LANES, TimedAnnotation, arrange_tier_lanes, report_split_lanes};
pub(crate) use markup_names::UniqueNames;
pub(crate) use markup_times::{parse_decimal_millis, parse_decimal_seconds};
pub(crate) use markup_tree::{MarkupContents, MarkupElement};

/// The program that writes a kind of file, and the root element of its files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct MarkupTool {
    pub(crate) name: &'static str,
    pub(crate) root: &'static str,
}

/// Elements that a reader passed over, by name, with their number.
#[derive(Debug, Default)]
pub(crate) struct UnreadElements(BTreeMap<String, u64>);

impl UnreadElements {
    /// Counts an element.
    pub(crate) fn count_unread_element(&mut self, name: &str) {
        let name: String = name.chars().take(40).collect();
        let full = self.0.len() >= 20 && !self.0.contains_key(&name);
        *self.0.entry(if full { "…".to_owned() } else { name }).or_default() += 1;
    }

    /// Reports the elements.
    pub(crate) fn report_unread_elements(self, findings: &mut FindingTally) {
        for (name, many) in self.0 {
            findings.push_warning_finding(
                None,
                format!("elements <{name}> are not read and were left out: {many}"),
            );
        }
    }
}

/// Returns a medium at this address; its type follows from the ending.
pub(crate) fn media_from_url(url: &str) -> TranscriptMedia {
    let ending = url.rsplit('.').next().unwrap_or_default();
    let mime = match &*ending.to_ascii_lowercase() {
        "mp4" | "m4v" => "video/mp4",
        "mov" => "video/quicktime",
        "mpg" | "mpeg" => "video/mpeg",
        "webm" => "video/webm",
        "avi" => "video/x-msvideo",
        "mkv" => "video/x-matroska",
        "wav" => "audio/x-wav",
        "mp3" => "audio/mpeg",
        _ => "",
    };
    TranscriptMedia {
        url: url.to_owned(),
        mime_type: mime.to_owned(),
        ..TranscriptMedia::default()
    }
}

/// Returns the id of an annotation. It depends on the name of its tier and its start alone, so that it stays the same if
/// the file gets other annotations.
pub(crate) fn stable_annotation_id(tier: &str, start: RecordingInstant) -> String {
    // FNV-1a, cut to 32 bits: ids that are the same get numbers.
    let hash = tier.bytes().fold(0x811c_9dc5_u32, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
    });
    format!("i{hash:08x}.{}", start.instant_micros())
}

/// Returns an annotation with a time of its own.
pub(crate) fn new_timed_annotation(id: String, span: TimeSpan, value: &str) -> TranscriptAnnotation {
    TranscriptAnnotation {
        id,
        span,
        timing: AnnotationTiming::Own,
        parent: None,
        order: 0,
        value: value.to_owned(),
        entry: None,
        language: None,
        external_ref: None,
        millis: None,
    }
}
