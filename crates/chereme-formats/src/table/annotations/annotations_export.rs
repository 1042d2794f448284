//! Reads tables of annotations as tiers, and writes them as the tab-delimited text that ELAN exports.

use std::borrow::Cow;

use chereme_motion::TimeSpan;

use super::super::table_cells::{TableCells, TableError};
use super::super::table_rows::write_tab_rows;
use super::annotations_columns::ChangeTableColumns;
use super::{ChangeRow, TableMoment, read_change_table};
use crate::finding::ImportFinding;
use crate::roles::normalize_tier_name;
use crate::tally::FindingTally;
use crate::transcript::{AnnotationTiming, AnnotationTranscript, TranscriptAnnotation, TranscriptTier};

/// The name of the tier type of all tiers; ELAN exports no types.
const EXPORTED_TIER_TYPE: &str = "annotation";

/// Reports whether a text begins as a table of the annotations of one recording: as ELAN's tab-delimited export without
/// titles, each row a tier and its times; or with titles for begin and end, or begin and duration. Tables that name
/// recordings, ids or actions are changes of recordings that exist.
#[must_use]
pub fn is_export(head: &[u8]) -> bool {
    let head = blank_comments(head).0;
    let Ok(table) = TableCells::read_part(whole_lines(&head), true, &mut FindingTally::default()) else {
        return false;
    };
    let is_begin = |title: &String| normalize_tier_name(title).starts_with("begin time");
    let columns = ChangeTableColumns::of_titles(&table.header, &mut FindingTally::default());
    ChangeTableColumns::of_export(&table).is_some()
        || columns.at[0].is_none() && (table.header.iter().any(is_begin) || columns.holds_annotations())
}

/// Reports whether a text begins as a table of changes of annotations, whose titles name tiers with their recordings,
/// actions or ids.
#[must_use]
pub fn is_change_table(head: &[u8]) -> bool {
    let text = blank_comments(head).0;
    let table = TableCells::read_part(whole_lines(&text), true, &mut FindingTally::default());
    let holds_changes =
        |table: TableCells| ChangeTableColumns::of_titles(&table.header, &mut FindingTally::default()).holds_changes();
    table.is_ok_and(holds_changes) && !is_export(head)
}

/// Reads tiers with their annotations; of annotations that overlap on a tier the first ends earlier.
///
/// # Errors
/// [`TableError`] if the bytes are no such table, or no row of it has a tier and a time: times in frames need the rate of a
/// recording.
pub fn read_elan_table(bytes: &[u8]) -> Result<(AnnotationTranscript, Vec<ImportFinding>), TableError> {
    let (blank, comments) = blank_comments(bytes);
    let (table, read) = read_change_table(&blank, None)?;
    let mut findings = FindingTally::default();
    for fault in &table.faults {
        findings.add_limited_finding("rows without an annotation", || {
            let why = &fault.message;
            ImportFinding::new_warning_finding(fault.line, format!("a row was left out: {why}"))
        });
    }
    let frames = |row: &&ChangeRow| matches!(row.start, Some(TableMoment::Frame(_)));
    if let Some(row) = table.rows.iter().find(frames) {
        return Err(TableError::Frames { line: row.line });
    }
    if table.rows.is_empty()
        && let Some(fault) = table.faults.first()
    {
        return Err(TableError::NoRow(fault.to_string()));
    }
    let mut transcript = AnnotationTranscript::default();
    for row in table.rows {
        let (Some(name), Some(TableMoment::Time(start)), Some(TableMoment::Time(end))) = (row.tier, row.start, row.end)
        else {
            findings.add_limited_warning(
                "rows without a time",
                row.line,
                || "a row was left out: it has no tier, or no time",
            );
            continue;
        };
        let present_tier = transcript.tiers.iter().position(|tier| tier.name == name);
        let tier = present_tier.unwrap_or_else(|| {
            transcript.tiers.push(TranscriptTier {
                name,
                kind: EXPORTED_TIER_TYPE.to_owned(),
                participant: row.participant.clone(),
                ..TranscriptTier::default()
            });
            transcript.tiers.len() - 1
        });
        let tier_participant = &transcript.tiers[tier].participant;
        if let Some(other) = row
            .participant
            .filter(|participant| tier_participant.as_ref() != Some(participant))
        {
            findings.add_limited_finding("rows of another participant", || {
                let first = tier_participant.as_deref().unwrap_or_default();
                ImportFinding::new_warning_finding(
                    row.line,
                    format!("a row has the participant {other:?}, its tier {first:?}, which was kept"),
                )
            });
        }
        transcript.tiers[tier].annotations.push(TranscriptAnnotation {
            id: format!("a{}", row.line.saturating_sub(comments)),
            span: TimeSpan::span_between(start, end),
            timing: AnnotationTiming::Own,
            parent: None,
            order: 0,
            value: row.value.unwrap_or_default(),
            entry: None,
            language: None,
            external_ref: None,
            millis: None,
        });
    }
    for (at, tier) in transcript.tiers.iter_mut().enumerate() {
        separate_annotations(tier, &mut findings);
        for annotation in &mut tier.annotations {
            // A row holds an annotation of each tier if tiers are columns.
            annotation.id = format!("{}t{at}", annotation.id);
        }
    }
    let mut all = read;
    all.extend(findings.finish_finding_tally());
    Ok((transcript, all))
}

/// Writes tiers as ELAN's tab-delimited text: tier, participant, begin, end and duration in two forms each, value.
///
/// ELAN puts blanks for line ends within values; here values read back unchanged, in quotation marks if necessary.
#[must_use]
pub fn write_elan_table(transcript: &AnnotationTranscript) -> String {
    let name = |text: &str| text.replace(['\t', '\r', '\n'], " ").into();
    let mut rows: Vec<[Cow<'_, str>; 9]> = Vec::new();
    for tier in &transcript.tiers {
        for it in &tier.annotations {
            let span = [
                it.span.span_start_instant().instant_millis(),
                it.span.span_end_instant().instant_millis(),
            ];
            let [start, end] = it.millis.unwrap_or(span);
            let times = [start, end, end - start];
            let [start, end, length] =
                times.map(|ms| [format_clock_millis(ms), format_seconds_millis(ms)].map(Cow::Owned));
            let [[start, start_s], [end, end_s], [length, length_s]] = [start, end, length];
            rows.push([
                name(&tier.name),
                name(tier.participant.as_deref().unwrap_or_default()),
                start,
                start_s,
                end,
                end_s,
                length,
                length_s,
                Cow::Borrowed(&it.value),
            ]);
        }
    }
    write_tab_rows(&rows)
}

/// Returns milliseconds as `00:00:01.500`, or `-00:00:01.500` before the start.
fn format_clock_millis(ms: i64) -> String {
    let (seconds, rest) = (ms.unsigned_abs() / 1000, ms.unsigned_abs() % 1000);
    let (minutes, seconds) = (seconds / 60, seconds % 60);
    format!(
        "{}{:02}:{:02}:{seconds:02}.{rest:03}",
        millis_sign(ms),
        minutes / 60,
        minutes % 60
    )
}

/// Returns milliseconds as `1.500`, or `-1.500` before the start.
fn format_seconds_millis(ms: i64) -> String {
    let size = ms.unsigned_abs();
    format!("{}{}.{:03}", millis_sign(ms), size / 1000, size % 1000)
}

fn millis_sign(ms: i64) -> &'static str {
    if ms < 0 { "-" } else { "" }
}

/// Sorts the annotations of a tier, ends each before the next begins, and leaves those out for which no time remains.
fn separate_annotations(tier: &mut TranscriptTier, findings: &mut FindingTally) {
    tier.annotations
        .sort_by_key(|annotation| annotation.span.span_start_instant());
    for at in 1..tier.annotations.len() {
        let start = tier.annotations[at].span.span_start_instant();
        let before = &mut tier.annotations[at - 1];
        if before.span.span_end_instant() > start {
            findings.add_limited_finding("overlapping annotations", || {
                let value = &before.value;
                ImportFinding::new_warning_finding(
                    None,
                    format!("the annotation {value:?} ends after the next begins; it ends at {start} now"),
                )
            });
            before.span = TimeSpan::span_between(before.span.span_start_instant(), start);
        }
    }
    let all = tier.annotations.len();
    tier.annotations.retain(|annotation| !annotation.span.is_empty());
    let left = all - tier.annotations.len();
    if left > 0 {
        findings.push_warning_finding(
            None,
            format!("{left} annotations begin together with the next one and were left out"),
        );
    }
}

/// Empties the lines at the beginning of a text that name ELAN's media files, and returns their number; a line with tabs is
/// a row.
fn blank_comments(bytes: &[u8]) -> (Cow<'_, [u8]>, u64) {
    let (mut rest, mut count) = (bytes, 0);
    while rest.starts_with(b"#") || rest.starts_with(b"\"#") {
        let line_break = rest.iter().position(|&byte| byte == b'\n');
        let end = line_break.map_or(rest.len(), |end| end + 1);
        if rest[..end].contains(&b'\t') {
            break;
        }
        rest = &rest[end..];
        count += 1;
    }
    match count {
        0 => (Cow::Borrowed(bytes), 0),
        _ => {
            let mut text = vec![b'\n'; count];
            text.extend(rest);
            (Cow::Owned(text), count as u64)
        }
    }
}

/// Returns a text up to the end of its last whole line, or all of it if it is a single line.
fn whole_lines(bytes: &[u8]) -> &[u8] {
    let end = bytes.iter().rposition(|&byte| byte == b'\n');
    end.map_or(bytes, |end| &bytes[..=end])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn described(text: &str) -> Vec<String> {
        let (transcript, _) = read_elan_table(text.as_bytes()).expect("a table");
        let tier = |it: &TranscriptTier| {
            let all = it.annotations.iter().map(|it| {
                let (start, end) = it.span.span_bounds_micros();
                format!("{} {}-{} {}", it.id, start / 1000, end / 1000, it.value)
            });
            format!("{}: {}", it.name, all.collect::<Vec<_>>().join(", "))
        };
        transcript.tiers.iter().map(tier).collect()
    }

    #[test]
    fn rows_with_and_without_titles_become_tiers() {
        let bare = "\"Gloss\"\t\"P1\"\t\"0.5\"\t\"1.0\"\t\"0.5\"\t\"BOL\"\n\
                    \"Mouth\"\t\"P1\"\t\"0.5\"\t\"0.75\"\t\"0.25\"\t\"\"\n";
        assert_eq!(described(bare), ["Gloss: a1t0 500-1000 BOL", "Mouth: a2t1 500-750 "]);
        let titled = "#film.mp4\nTier\tBegin Time - msec\tEnd Time - msec\tAnnotation\nGloss\t500\t1000\tBOL\n";
        assert_eq!(described(titled), ["Gloss: a2t0 500-1000 BOL"]);
        let columns = "Begin Time - msec\tEnd Time - msec\tGloss\tMouth\n500\t1000\tBOL\tpa\n";
        assert_eq!(
            described(columns),
            ["Gloss: a2t0 500-1000 BOL", "Mouth: a2t1 500-1000 pa"]
        );
    }

    #[test]
    fn participants_are_those_of_the_tiers() {
        for text in [
            "Gloss\tAnna\t0.5\t1.0\tBOL\nGloss\tAnna\t2.0\t2.5\tCHAT\nMouth\t\t2.0\t2.5\tpa\n",
            "Tier\tParticipant\tBegin Time - msec\tEnd Time - msec\tAnnotation\nGloss\tAnna\t500\t1000\tBOL\n\
             Mouth\t\t500\t1000\tpa\n",
        ] {
            let (found, findings) = read_elan_table(text.as_bytes()).expect("a table");
            assert!(findings.iter().all(|it| !it.message.contains("participant")));
            let people: Vec<Option<&str>> = found.tiers.iter().map(|it| it.participant.as_deref()).collect();
            assert_eq!(people, [Some("Anna"), None], "{text}");
            let (again, _) = read_elan_table(write_elan_table(&found).as_bytes()).expect("a table");
            assert_eq!(again.tiers[0].participant.as_deref(), Some("Anna"));
        }
        let two = "G\tAnna\t0.5\t1.0\tBOL\nG\tBob\t2.0\t2.5\tCHAT\n";
        let (found, findings) = read_elan_table(two.as_bytes()).expect("a table");
        assert_eq!(found.tiers[0].participant.as_deref(), Some("Anna"));
        assert!(
            findings
                .iter()
                .any(|it| it.line == Some(2) && it.message.contains("\"Bob\""))
        );
    }

    #[test]
    fn findings_name_lines_of_the_file_behind_its_media() {
        let text = "#a.mp4\n#b.mp4\nG\t\t0.5\t1.0\tA\nG\t\tlate\t1.2\tB\n";
        let (_, findings) = read_elan_table(text.as_bytes()).expect("a table");
        let lines: Vec<Option<u64>> = findings.iter().map(|it| it.line).collect();
        assert_eq!(lines, [Some(3), Some(4)], "{findings:?}");
    }

    #[test]
    fn titles_of_other_programs_and_decimal_commas_are_read() {
        let french = "Piste;Début;Fin;Valeur\nGlose;1,25;2,4;MAISON\nGlose;00:00:02,480;00:00:03.000;CHAT\n";
        assert_eq!(described(french), ["Glose: a2t0 1250-2400 MAISON, a3t0 2480-3000 CHAT"]);
        // The program says "acteur" for a tier, as ELAN does in French.
        for titles in ["Acteur;Début;Fin;Glose", "acteur;début;fin;valeur"] {
            let text = format!("{titles}\nX;00:00:01.700;00:00:01.900;ÉTÉ\n");
            assert_eq!(described(&text), ["X: a2t0 1700-1900 ÉTÉ"], "{titles}");
        }
        assert_eq!(
            described("Début;Fin;Valeur;Acteur\n1,5;2;A;X\n"),
            ["X: a2t0 1500-2000 A"]
        );
        let bare = "start_ms,duration_ms,gloss,mouthing\n1200,300,MAISON,ma\n";
        assert_eq!(
            described(bare),
            ["gloss: a2t0 1200-1500 MAISON", "mouthing: a2t1 1200-1500 ma"]
        );
        let label = "Beginn;Ende;Text\n0,5;1,0;HAUS\n";
        assert_eq!(described(label), ["Text: a2t0 500-1000 HAUS"]);
        let fault = |text: &str| read_elan_table(text.as_bytes()).expect_err("no times").to_string();
        let frames = fault("start_frame,end_frame,gloss\n30,60,MAISON\n");
        assert!(frames.contains("line 2") && frames.contains("frames"), "{frames}");
        let code = fault("tier,start,end,value\nG,00:00:01:05,00:00:02:10,MAISON\n");
        assert!(code.contains("line 2") && code.contains("hh:mm:ss:ff"), "{code}");
    }

    #[test]
    fn only_a_table_of_one_recording_is_an_export() {
        for (text, is) in [
            ("Gloss\t\t0.5\t1.0\tBOL\nGloss\t\t2.0\t2.5\tCHAT\nGl", true),
            ("Begin Time - ss.msec\tEnd Time - ss.msec\tGloss\n", true),
            (
                "\"#file:///film.mp4\"\nTier\tBegin Time - msec\tEnd Time - msec\n",
                true,
            ),
            ("recording,tier,start,end,value\nA,Gloss,0.5,1.0,BOL\n", false),
            ("Tier,Begin,End,Value\nGloss,0.5,1.0,BOL\n", true),
            ("Acteur;Début;Fin;Glose\nX;0,5;1,0;BOL\n", true),
            ("Enregistrement;Acteur;Début;Fin;Valeur\nA;X;0,5;1,0;B\n", false),
            ("start_ms,end_ms,gloss\n500,1000,BOL\n", true),
            ("Gebärde;Start;Ende;Hand\nHAUS1;0.5;1.0;r\n", true),
            ("tier,start,end,value,action,id\nG,0.5,1.0,BOL,set,a1\n", false),
            ("gloss,start,handshape\nBOL,chin,B\n", false),
            ("gloss,handshape,frequency\nBOL,B,0.5\n", false),
            ("token,gloss,recording,start_s,end_s\n1,BOL,A,0.5,1.0\n", false),
            ("", false),
        ] {
            assert_eq!(is_export(text.as_bytes()), is, "{text:?}");
        }
    }

    #[test]
    fn overlaps_end_earlier_and_are_named() {
        let text = "G\t\t0.5\t1.0\tA\nG\t\t0.8\t1.2\tB\nG\t\t0.8\t1.3\tC\n";
        let (_, findings) = read_elan_table(text.as_bytes()).expect("a table");
        assert_eq!(described(text), ["G: a1t0 500-800 A, a3t0 800-1300 C"]);
        let says = |what: &str| findings.iter().any(|it| it.message.contains(what));
        assert!(says("ends after the next begins") && says("1 annotations begin together"));
    }
}
