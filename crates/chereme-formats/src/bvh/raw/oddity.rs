//! Oddities of a file whose meaning is clear; each kind is reported once, with its first line and a count.

use std::collections::BTreeMap;

use crate::{FindingSeverity, ImportFinding, ReaderCorrection};

/// The kinds of oddity that the reader knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum BvhOddity {
    ByteOrderMark,
    CrLf,
    CrOnly,
    NoHierarchyLine,
    KeywordCase,
    BraceOnNameLine,
    EmptyName,
    NameNotUtf8,
    DuplicateName,
    OffsetOverLines,
    NoOffset,
    ChannelCount,
    RepeatedChannel,
    ScaleChannel,
    PositionBelowRoot,
    NoChannels,
    NoEndSite,
    EndSiteBesideChildren,
    SeveralEndSites,
    EndSiteName,
    NoMotion,
    NoFrameCount,
    BadFrameCount,
    FrameCountDiffers,
    NoFrames,
    HeaderSpelling,
    NoFrameTime,
    LongFrameTime,
    SeveralFramesOnLine,
    Truncated,
    TextAfterMotion,
    SwappedRoot,
}

#[derive(Clone, Debug)]
struct OddityCount {
    line: u64,
    count: u64,
    detail: String,
}

/// The oddities noticed so far: at most one entry per kind, whatever the file's size.
#[derive(Clone, Debug, Default)]
pub(super) struct BvhOddities(BTreeMap<BvhOddity, OddityCount>);

impl BvhOddities {
    /// Records one occurrence; the line and detail of the first are kept.
    pub(super) fn note_oddity(&mut self, kind: BvhOddity, line: u64, detail: impl Into<String>) {
        let new = || OddityCount {
            line,
            count: 0,
            detail: detail.into(),
        };
        self.0.entry(kind).or_insert_with(new).count += 1;
    }

    /// Returns whether the kind was noticed.
    pub(super) fn has_oddity(&self, kind: BvhOddity) -> bool {
        self.0.contains_key(&kind)
    }

    /// Returns a finding for each kind, in the order of their lines.
    pub(super) fn oddity_findings(&self) -> Vec<ImportFinding> {
        let mut seen: Vec<_> = self.0.iter().collect();
        seen.sort_by_key(|(kind, seen)| (seen.line, **kind));
        seen.into_iter()
            .map(|(kind, seen)| describe_oddity_finding(*kind, seen))
            .collect()
    }
}

fn describe_oddity_finding(kind: BvhOddity, OddityCount { line, count, detail }: &OddityCount) -> ImportFinding {
    let (severity, what, remedy) = oddity_words(kind);
    let mut message = what.replace("{}", detail);
    if *count > 1 {
        message.push_str(&format!(" ({count} times)"));
    }
    let remedy = (!remedy.is_empty()).then(|| remedy.into());
    ImportFinding {
        severity,
        line: Some(*line),
        message,
        remedy,
        mend: (kind == BvhOddity::SwappedRoot).then_some(ReaderCorrection::RootOrder),
    }
}

/// Returns severity, message (with `{}` for the detail of the first occurrence) and remedy of each kind.
fn oddity_words(kind: BvhOddity) -> (FindingSeverity, &'static str, &'static str) {
    use BvhOddity as O;
    use FindingSeverity::{Note, Warning};
    match kind {
        O::ByteOrderMark => (Note, "the file begins with a byte-order mark; skipped", ""),
        O::CrLf => (Note, "lines end with CR LF, as on Windows", ""),
        O::CrOnly => (Note, "lines end with CR alone, as on old Macs", ""),
        O::NoHierarchyLine => (Note, "the line HIERARCHY is missing; the file begins with ROOT", ""),
        O::KeywordCase => (Note, "the keyword {} has an unusual spelling", ""),
        O::BraceOnNameLine => (Note, "the brace of joint {} stands on the line of the name", ""),
        O::EmptyName => (
            Warning,
            "a joint has no name",
            "name it in the capture software; unnamed joints can't be found by name",
        ),
        O::NameNotUtf8 => (
            Warning,
            "the joint name {} is not UTF-8; read as Latin-1",
            "save the file as UTF-8",
        ),
        O::DuplicateName => (
            Warning,
            "two joints are called {}; only their positions distinguish them",
            "rename one of them",
        ),
        O::OffsetOverLines => (Note, "the OFFSET of joint {} goes over several lines", ""),
        O::NoOffset => (Warning, "joint {} has no OFFSET; taken as 0 0 0", "give its OFFSET"),
        O::ChannelCount => (
            Warning,
            "joint {}; the names count",
            "correct the number after CHANNELS",
        ),
        O::RepeatedChannel => (Warning, "joint {} twice", "check the CHANNELS line"),
        O::ScaleChannel => (Warning, "joint {} has scale channels; kept, but no scale is shown", ""),
        O::PositionBelowRoot => (Note, "joint {} below the root has position channels", ""),
        O::NoChannels => (Note, "joint {} has no channels and never moves by itself", ""),
        O::NoEndSite => (Note, "joint {} is a leaf without End Site; its length is unknown", ""),
        O::EndSiteBesideChildren => (Note, "joint {} has an End Site beside children; both kept", ""),
        O::SeveralEndSites => (Note, "joint {} has several End Sites; all kept", ""),
        O::EndSiteName => (Note, "an End Site has the name {}; dropped", ""),
        O::NoMotion => (Warning, "there is no MOTION section: a skeleton without movement", ""),
        O::NoFrameCount => (Note, "the line \"Frames:\" is missing; rows are counted instead", ""),
        O::BadFrameCount => (
            Warning,
            "the frame count {} is no count; rows are counted instead",
            "correct the line \"Frames:\"",
        ),
        O::FrameCountDiffers => (
            Warning,
            "the header says {}; the rows count",
            "check that the recording is whole",
        ),
        O::NoFrames => (Warning, "there are no frames: a skeleton without movement", ""),
        O::HeaderSpelling => (Note, "the header line {} has unusual blanks", ""),
        O::NoFrameTime => (
            Warning,
            "there is no frame time above 0 ({}); with one frame at most, none is needed",
            "",
        ),
        O::LongFrameTime => (
            Warning,
            "a frame lasts {} seconds",
            "if frames per second are meant, write 1 divided by that, such as \"Frame Time: 0.0333333\" for 30",
        ),
        O::SeveralFramesOnLine => (
            Note,
            "several frames stand on one line; split by the number of channels",
            "",
        ),
        O::Truncated => (
            Warning,
            "the last row breaks off: {}; dropped",
            "the file was cut off; export it again",
        ),
        O::TextAfterMotion => (Note, "text follows the motion, beginning with {}; ignored", ""),
        O::SwappedRoot => (
            Warning,
            "the root's columns hold rotation before position, though CHANNELS says the reverse: {}",
            "read the root's rotation before its position (root channel fix \"rotation-before-position\")",
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_oddities_are_one_finding() {
        let mut oddities = BvhOddities::default();
        for line in 5..1005 {
            oddities.note_oddity(BvhOddity::NoEndSite, line, format!("J{line}"));
        }
        oddities.note_oddity(BvhOddity::ByteOrderMark, 1, "");
        let messages: Vec<_> = oddities
            .oddity_findings()
            .into_iter()
            .map(|f| (f.line, f.message))
            .collect();
        assert_eq!(messages[0].0, Some(1));
        assert_eq!(
            messages[1].1,
            "joint J5 is a leaf without End Site; its length is unknown (1000 times)"
        );
    }
}
