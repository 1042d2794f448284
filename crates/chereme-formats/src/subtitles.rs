//! Subtitles: SubRip (`.srt`) and WebVTT (`.vtt`).
//!
//! A file of either kind becomes one tier; the voices of WebVTT (`<v Anna>`) become tiers of their own with
//! the voice as participant. Styles, notes and positions are left out and reported.

#[cfg(test)]
mod tests;

use std::fmt::Write as _;

use chereme_motion::{RecordingInstant, TimeSpan};

use crate::finding::ImportFinding;
use crate::table::{TableError, decode_table_bytes};
use crate::tally::FindingTally;
use crate::transcript::{AnnotationTiming, AnnotationTranscript, TranscriptAnnotation, TranscriptTier};

/// The name of the tier of cues without a voice.
pub const VOICELESS_TIER_NAME: &str = "subtitles";

/// The format to write.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SubtitleFormat {
    /// SubRip: numbered cues, commas in times.
    Srt,
    /// WebVTT: voices, points in times.
    Vtt,
}

/// The reason why bytes could not be read as subtitles.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SubtitleError {
    /// The file is not text.
    #[error("line {line}: this is not text; save the subtitles as text in UTF-8")]
    NotText {
        /// The line, counted from 1.
        line: u64,
    },
    /// No line holds the times of a cue.
    #[error("no line holds times such as 00:00:01,000 --> 00:00:02,500")]
    NoCues,
}

/// Reads subtitles of either kind.
///
/// # Errors
/// [`SubtitleError`] if the bytes are not text, or no line holds the times of a cue.
pub fn read_subtitles(bytes: &[u8]) -> Result<(AnnotationTranscript, Vec<ImportFinding>), SubtitleError> {
    let mut findings = FindingTally::default();
    let text = decode_table_bytes(bytes, &mut findings).map_err(|error| match error {
        TableError::NotText { line } => SubtitleError::NotText { line },
        _ => SubtitleError::NoCues,
    })?;
    let is_vtt = text.trim_start_matches('\u{feff}').starts_with("WEBVTT");
    let mut cues: Vec<(TimeSpan, String, u64)> = Vec::new();
    // SubRip states no other place for text after a blank line than the cue before it.
    let mut follows_cue = false;
    let mut lines = (1u64..).zip(text.lines()).peekable();
    while let Some((line, text)) = lines.next() {
        if is_vtt && is_block(text) {
            let mut block = vec![text.trim()];
            while let Some((_, more)) = lines.next_if(|(_, text)| !text.trim().is_empty()) {
                block.push(more.trim());
            }
            // The word that opens every file says nothing; a title behind it or lines below it do.
            if block != ["WEBVTT"] {
                findings.add_limited_note("blocks of notes and styles", line, || {
                    format!("the block {:?} was left out", block.join(" "))
                });
            }
            continue;
        }
        let Some((span, settings)) = parse_cue_times(text) else {
            if text.contains("-->") {
                findings.add_limited_finding("cues without times", || {
                    ImportFinding::new_warning_finding(
                        line,
                        format!("{:?} are no times; the cue was left out", text.trim()),
                    )
                    .with_remedy("write 00:00:01,000 --> 00:00:02,500")
                });
                while lines.next_if(|(_, text)| is_text(text)).is_some() {}
                follows_cue = false;
                continue;
            }
            let mut after = lines.clone().filter(|(_, text)| !text.trim().is_empty());
            let number = text.trim().parse::<u64>().is_ok();
            let names = |(_, text): &(u64, &str)| text.contains("-->");
            let is_name =
                number && after.next().is_some_and(|line| names(&line)) || is_vtt && lines.peek().is_some_and(names);
            if text.trim().is_empty() || is_name {
                continue;
            }
            match cues.last_mut().filter(|_| follows_cue && !is_vtt) {
                Some((_, said, _)) => {
                    findings.add_limited_note("blank lines within cues", line, || {
                        format!(
                            "the text {:?} stands after a blank line; it was added to the cue before it",
                            text.trim()
                        )
                    });
                    if !said.is_empty() {
                        said.push('\n');
                    }
                    said.push_str(text.trim_end());
                }
                None => findings.add_limited_finding("lines outside cues", || {
                    ImportFinding::new_warning_finding(
                        line,
                        format!("the line {:?} belongs to no cue and was left out", text.trim()),
                    )
                    .with_remedy("write it below the times of its cue, with no blank line before it")
                }),
            }
            continue;
        };
        follows_cue = true;
        if settings {
            findings.add_limited_note("positions of cues", line, || "the position of the cue was left out");
        }
        let mut text_lines: Vec<&str> = Vec::new();
        while let Some((_, text)) = lines.next_if(|(_, text)| is_text(text)) {
            text_lines.push(text.trim_end());
        }
        // The number of the next cue stands directly before its times if a blank line is missing.
        if lines.peek().is_some_and(|(_, text)| parse_cue_times(text).is_some())
            && text_lines.last().is_some_and(|text| text.trim().parse::<u64>().is_ok())
        {
            text_lines.pop();
        }
        cues.push((span, text_lines.join("\n"), line));
    }
    if cues.is_empty() {
        return Err(SubtitleError::NoCues);
    }
    Ok((
        cues_to_transcript(cues, is_vtt, &mut findings),
        findings.finish_finding_tally(),
    ))
}

/// Reports whether a line below the times of a cue is of its text.
fn is_text(line: &str) -> bool {
    !line.trim().is_empty() && parse_cue_times(line).is_none()
}

fn is_block(line: &str) -> bool {
    ["NOTE", "STYLE", "REGION", "WEBVTT"].iter().any(|word| {
        line.strip_prefix(word)
            .is_some_and(|rest| rest.is_empty() || rest.starts_with([' ', '\t']))
    })
}

/// Reads a line of times; the second value is true if settings follow.
fn parse_cue_times(line: &str) -> Option<(TimeSpan, bool)> {
    let (start, rest) = line.split_once("-->")?;
    let mut words = rest.split_whitespace();
    let start = parse_subtitle_instant(start.trim())?;
    let end = parse_subtitle_instant(words.next()?)?;
    let span = TimeSpan::new(start, end).ok()?;
    Some((span, words.next().is_some()))
}

/// Reads `HH:MM:SS,mmm` or `MM:SS.mmm`; hours may have any number of digits.
fn parse_subtitle_instant(text: &str) -> Option<RecordingInstant> {
    let (whole, fraction) = text.split_once([',', '.']).unwrap_or((text, "0"));
    let number = |text: &str| {
        let digits = !text.is_empty() && text.len() <= 6 && text.bytes().all(|byte| byte.is_ascii_digit());
        if digits { text.parse::<i64>().ok() } else { None }
    };
    let mut seconds = 0;
    let mut parts = 0;
    for part in whole.split(':') {
        seconds = seconds * 60 + number(part)?;
        parts += 1;
    }
    if !(2..=3).contains(&parts) {
        return None;
    }
    number(fraction)?;
    let micros = number(&format!("{fraction:0<6}")[..6])?;
    Some(RecordingInstant::from_micros(seconds * 1_000_000 + micros))
}

/// Puts cues on tiers, one for each voice, and clips cues of one tier that overlap.
fn cues_to_transcript(
    cues: Vec<(TimeSpan, String, u64)>,
    is_vtt: bool,
    findings: &mut FindingTally,
) -> AnnotationTranscript {
    let mut transcript = AnnotationTranscript::default();
    for (at, (span, text, line)) in cues.into_iter().enumerate() {
        let (voice, value) = split_cue_voice(&text, is_vtt);
        if value.is_empty() {
            findings.add_limited_note("empty cues", line, || "an empty cue was left out");
            continue;
        }
        let same = |tier: &TranscriptTier| tier.participant.as_deref() == voice.as_deref();
        let tier = match transcript.tiers.iter().position(same) {
            Some(tier) => tier,
            None => {
                let name = voice.as_deref().unwrap_or(VOICELESS_TIER_NAME).to_owned();
                transcript.tiers.push(TranscriptTier {
                    name,
                    kind: VOICELESS_TIER_NAME.to_owned(),
                    participant: voice,
                    ..TranscriptTier::default()
                });
                transcript.tiers.len() - 1
            }
        };
        let tier = &mut transcript.tiers[tier];
        tier.annotations.push(TranscriptAnnotation {
            id: format!("a{}", at + 1),
            span,
            timing: AnnotationTiming::Own,
            parent: None,
            order: 0,
            value,
            entry: None,
            language: None,
            external_ref: None,
            millis: None,
        });
    }
    for tier in &mut transcript.tiers {
        tier.annotations.sort_by_key(|cue| cue.span.span_start_instant());
        for at in 1..tier.annotations.len() {
            let start = tier.annotations[at].span.span_start_instant();
            let before = &mut tier.annotations[at - 1];
            if before.span.span_end_instant() > start {
                findings.add_limited_warning("overlapping cues", None, || {
                    format!(
                        "the cue {:?} ends after the next begins; it ends at {start} now",
                        before.value
                    )
                });
                // Players show both, but a tier holds one annotation at a time.
                before.span = TimeSpan::span_between(before.span.span_start_instant(), start);
            }
        }
        let empty = tier.annotations.iter().filter(|cue| cue.span.is_empty()).count();
        if empty > 0 {
            findings.push_warning_finding(
                None,
                format!("{empty} cues begin together with the next one and were left out"),
            );
            tier.annotations.retain(|cue| !cue.span.is_empty());
        }
    }
    transcript
}

/// Returns the voice of a cue, and its text without tags.
fn split_cue_voice(text: &str, is_vtt: bool) -> (Option<String>, String) {
    let (mut voice, mut value) = (None, String::new());
    let mut rest = text;
    while let Some(open) = rest.find(['<', '{']) {
        value.push_str(&rest[..open]);
        rest = &rest[open..];
        let close = if rest.starts_with('<') { '>' } else { '}' };
        // Braces are tags only before a backslash, as in {\an8}; people write them in glosses.
        let is_tag = match rest.strip_prefix("{") {
            Some(inner) => inner.starts_with('\\'),
            None => rest[1..].starts_with(|c: char| c.is_ascii_alphanumeric() || c == '/'),
        };
        let Some(end) = rest.find(close).filter(|_| is_tag) else {
            value.push_str(&rest[..1]);
            rest = &rest[1..];
            continue;
        };
        let tag = &rest[1..end];
        if let Some((_, name)) = tag.split_once(char::is_whitespace)
            && (tag.starts_with("v ") || tag.starts_with("v."))
        {
            voice.get_or_insert_with(|| name.trim().to_owned());
        }
        rest = &rest[end + 1..];
    }
    value.push_str(rest);
    if is_vtt {
        for (entity, letter) in [
            ("&lt;", "<"),
            ("&gt;", ">"),
            ("&nbsp;", "\u{a0}"),
            ("&lrm;", ""),
            ("&rlm;", ""),
            // The last, or &amp;lt; would become a sign of a tag.
            ("&amp;", "&"),
        ] {
            value = value.replace(entity, letter);
        }
    }
    (voice, value.trim().to_owned())
}

/// Writes tiers as subtitles, in the order of their times; WebVTT names the tier as voice if there are several.
#[must_use]
pub fn write_subtitles(transcript: &AnnotationTranscript, form: SubtitleFormat) -> String {
    let mut cues: Vec<(&TranscriptTier, &TranscriptAnnotation)> = transcript
        .tiers
        .iter()
        .flat_map(|tier| tier.annotations.iter().map(move |cue| (tier, cue)))
        .filter(|(_, cue)| !cue.value.trim().is_empty())
        .collect();
    cues.sort_by_key(|(_, cue)| (cue.span.span_start_instant(), cue.span.span_end_instant()));
    let several = transcript.tiers.len() > 1;
    let mut out = String::new();
    if form == SubtitleFormat::Vtt {
        out.push_str("WEBVTT\n\n");
    }
    for (at, (tier, cue)) in (1..).zip(cues) {
        // A blank line inside would end the cue.
        let lines: Vec<&str> = cue.value.lines().filter(|line| !line.trim().is_empty()).collect();
        let text = lines.join("\n").replace("-->", "→");
        let (start, end) = (
            stamp(cue.span.span_start_instant(), form),
            stamp(cue.span.span_end_instant(), form),
        );
        let _ = match form {
            SubtitleFormat::Srt => write!(out, "{at}\n{start} --> {end}\n{text}\n\n"),
            SubtitleFormat::Vtt => {
                let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
                let speaker = tier
                    .participant
                    .as_deref()
                    .unwrap_or(&tier.name)
                    .replace(['<', '>'], " ");
                let voice = if several {
                    format!("<v {speaker}>")
                } else {
                    String::new()
                };
                write!(out, "{start} --> {end}\n{voice}{text}\n\n")
            }
        };
    }
    out
}

fn stamp(instant: RecordingInstant, form: SubtitleFormat) -> String {
    let millis = instant.instant_millis().max(0);
    let (seconds, millis) = (millis / 1000, millis % 1000);
    let point = if form == SubtitleFormat::Srt { ',' } else { '.' };
    format!(
        "{:02}:{:02}:{:02}{point}{millis:03}",
        seconds / 3600,
        seconds / 60 % 60,
        seconds % 60
    )
}
