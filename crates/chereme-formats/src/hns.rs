//! HamNoSys as lines of text (`.hns`, `.txt`): one sign per line, after or before its gloss.
//!
//! A line holds a gloss, a tab and HamNoSys, as characters, as names of symbols or as numbers of
//! characters (`U+E001`). The text before the first symbol of a line is its gloss, whatever separates the
//! two, or else the text after the last symbol; a line may have none. Of several columns beside the symbols, the one that
//! names the signs is the gloss.

use crate::finding::ImportFinding;
use crate::table::{TableError, decode_table_bytes};
use crate::tally::FindingTally;
use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::hamnosys::{
    NotatedSign, in_plain_symbols, parse_lenient, repair_garbled_symbols, symbol::HamnosysSymbol,
};
use chereme_sign::text::nearest_candidate;

/// The number of leading bytes that decide whether a file holds HamNoSys.
const HNS_DETECTION_BYTES: usize = 1 << 16;
/// The most columns before the symbols among which glosses are looked for. The columns after the symbols are counted
/// from this number.
const MAX_LEADING_COLUMNS: usize = 16;

/// A notated sign and its line.
#[derive(Debug, Clone, PartialEq)]
pub struct HnsSign {
    /// The sign; its gloss is empty if the line has none.
    pub sign: NotatedSign,
    /// The line of the file, counted from 1.
    pub line: u64,
}

/// Why bytes could not be read as lines of HamNoSys.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HnsError {
    /// The file is not text.
    #[error("line {line}: this is not text; save it as lines of text in UTF-8")]
    NotText {
        /// The line, counted from 1.
        line: u64,
    },
    /// No line has a symbol.
    #[error(
        "no line holds HamNoSys; a line is a gloss, a tab and symbols, as characters or by name: \
         hamflathand hamextfingeru hampalml"
    )]
    Nothing,
}

/// Reads lines of HamNoSys, and reports oddities.
///
/// An odd line gives the part of the sign that was understood. Blank lines are ignored; other lines
/// without a symbol are reported.
///
/// # Errors
/// [`HnsError`] if the bytes are not text, or no line has a symbol.
pub fn read_hns(bytes: &[u8]) -> Result<(Vec<HnsSign>, Vec<ImportFinding>), HnsError> {
    let mut findings = FindingTally::default();
    let text = decode_table_bytes(bytes, &mut findings).map_err(|error| match error {
        TableError::NotText { line } => HnsError::NotText { line },
        _ => HnsError::Nothing,
    })?;
    let mut entries = Vec::new();
    // Which column holds glosses shows only over all lines.
    let glosses = gloss_column(&text);
    for (line, text) in (1..).zip(text.lines()) {
        if repair_garbled_symbols(text).is_some() {
            findings.add_limited_finding("symbols in a wrong encoding", || mended_finding(line));
        }
        let text = &*in_plain_symbols(text);
        match HnsLineParts::split_hns_line(text) {
            Some(parts) => {
                let gloss = choose_line_gloss(line, &parts, glosses, &mut findings);
                entries.push(read_hns_entry(line, gloss, parts.symbols, &mut findings));
            }
            None if text.trim().is_empty() => {}
            None => findings.add_limited_finding("lines without HamNoSys", || {
                ImportFinding::new_warning_finding(line, "the line holds no HamNoSys; it was left out")
                    .with_remedy("write the gloss, a tab, and HamNoSys")
            }),
        }
    }
    if entries.is_empty() {
        return Err(HnsError::Nothing);
    }
    Ok((entries, findings.finish_finding_tally()))
}

/// Returns whether a file that begins with these bytes holds HamNoSys; of a long file the first whole
/// lines decide.
#[must_use]
pub fn holds_some(bytes: &[u8]) -> bool {
    let mut seen = &bytes[..bytes.len().min(HNS_DETECTION_BYTES)];
    if seen.len() == HNS_DETECTION_BYTES {
        // A character cut in two would make the rest look like Latin-1.
        seen = &seen[..memchr::memrchr(b'\n', seen).unwrap_or(0)];
    }
    let text = decode_table_bytes(seen, &mut FindingTally::default());
    text.is_ok_and(|text| text.lines().any(holds_symbols))
}

/// Returns the finding which reports that symbols were mended.
pub(crate) fn mended_finding(line: u64) -> ImportFinding {
    ImportFinding::new_note_finding(
        line,
        "HamNoSys had been saved as UTF-8 and read as Latin-1 or Windows-1252; its symbols were mended",
    )
    .with_remedy("nothing needs to be done; a new export of the source as UTF-8 would be clean")
}

/// Returns whether a line or a cell holds a symbol, in any of its spellings.
pub(crate) fn holds_symbols(text: &str) -> bool {
    find_symbols_start(&in_plain_symbols(text)).is_some()
}

/// Writes signs as lines, and returns for each the parts that HamNoSys cannot express.
#[must_use]
pub fn write_hns<'s>(signs: impl IntoIterator<Item = &'s NotatedSign>) -> (Vec<u8>, Vec<Vec<String>>) {
    let (mut text, mut lost) = (String::new(), Vec::new());
    for sign in signs {
        let printed = sign.hamnosys_text();
        let gloss = sign.gloss.replace(['\t', '\n', '\r'], " ");
        text += &format!("{gloss}\t{}\n", printed.text);
        let mut sign_losses: Vec<String> = printed.losses.into_iter().map(|loss| loss.message).collect();
        if !sign.nonmanual.is_empty() {
            sign_losses.push("what face and body do".to_owned());
        }
        lost.push(sign_losses);
    }
    (text.into_bytes(), lost)
}

/// Returns the byte at which the first symbol of a line starts.
fn find_symbols_start(line: &str) -> Option<usize> {
    let character = |c: char| ('\u{e000}'..='\u{f8ff}').contains(&c) && HamnosysSymbol::from_char(c).is_some();
    let word = |rest: &str| {
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric());
        HamnosysSymbol::from_symbol_name(&rest[..end.unwrap_or(rest.len())]).is_some()
    };
    let lower = line.to_ascii_lowercase();
    let named = (lower.match_indices("ham").map(|(at, _)| at))
        .find(|&at| !line[..at].ends_with(|c: char| c.is_alphanumeric()) && word(&line[at..]));
    [line.find(character), named].into_iter().flatten().min()
}

/// Returns the byte at which the symbols of a line start whose first known one is at `known`: words before it that nearly
/// name a symbol, in the same case, and characters of the font without one belong to them. A word in the first column is
/// a gloss.
fn misspelt_begin(line: &str, known: usize) -> usize {
    let between_columns = |text: &str| text.contains(['\t', ',', ';']);
    let prefix = match line[known..].starts_with("HAM") {
        true => "HAM",
        false => "ham",
    };
    let is_misspelt = |word: &str| {
        let name = word.trim_matches(['<', '/', '>']);
        word.contains(|c| ('\u{e000}'..='\u{f8ff}').contains(&c))
            || name.starts_with(prefix)
                && nearest_candidate(name, HamnosysSymbol::all_symbols().map(HamnosysSymbol::symbol_name)).is_some()
    };
    let mut first = known;
    loop {
        let before = line[..first].trim_end_matches(parting);
        let start = before
            .rfind(parting)
            .map_or(0, |at| at + before[at..].chars().next().map_or(1, char::len_utf8));
        let is_gloss = between_columns(&line[before.len()..first]) && !between_columns(&line[..start]);
        if is_gloss || !is_misspelt(&before[start..]) {
            return first;
        }
        first = start;
    }
}

/// Returns the byte at which the last symbol of a line ends, whether or not it is a known one.
fn find_symbols_end(line: &str) -> usize {
    let is_character = |c: char| ('\u{e000}'..='\u{f8ff}').contains(&c);
    let last_character = line.char_indices().rfind(|(_, c)| is_character(*c));
    let character = last_character.map(|(at, c)| at + c.len_utf8());
    let lower = line.to_ascii_lowercase();
    let names = lower
        .match_indices("ham")
        .filter(|(at, _)| !line[..*at].ends_with(|c: char| c.is_alphanumeric()));
    let named = names.last().map(|(at, _)| {
        let rest = &line[at..];
        at + rest
            .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
            .unwrap_or(rest.len())
    });
    character.max(named).unwrap_or(line.len())
}

/// A line with symbols: the text before them, the symbols, and the text after them if something parts it from them.
struct HnsLineParts<'t> {
    before: &'t str,
    symbols: &'t str,
    after: &'t str,
}

impl<'t> HnsLineParts<'t> {
    /// Returns the parts of a line; `None` if it holds no symbol.
    fn split_hns_line(line: &'t str) -> Option<Self> {
        let first = misspelt_begin(line, find_symbols_start(line)?);
        let before = &line[..first];
        let (symbols, after) = line[first..].split_at(find_symbols_end(&line[first..]));
        let lead = after.find(char::is_alphanumeric).map(|at| &after[..at]);
        let is_parted = lead.is_some_and(|lead| {
            let has_gloss = before.contains(char::is_alphanumeric);
            let is_column = |c: char| c == '\t' || parting(c) && !c.is_whitespace();
            lead.contains(is_column) || lead.contains("  ") || !has_gloss && lead.contains(' ')
        });
        Some(match is_parted {
            true => Self { before, symbols, after },
            false => Self {
                before,
                symbols: &line[first..],
                after: "",
            },
        })
    }

    /// Returns the texts beside the symbols with the numbers of their columns.
    fn numbered_side_columns(&self) -> impl Iterator<Item = (usize, &'t str)> {
        let before = split_side_columns(self.before).into_iter().take(MAX_LEADING_COLUMNS);
        let after_quotes = self.after.trim_start_matches('"');
        let after = after_quotes.strip_prefix('\t').unwrap_or(after_quotes);
        let after = split_side_columns(after).into_iter().take(MAX_LEADING_COLUMNS);
        (0..).zip(before).chain((MAX_LEADING_COLUMNS..).zip(after))
    }
}

/// Returns the texts that tabs part on one side of the symbols of a line.
fn split_side_columns(side: &str) -> Vec<&str> {
    let columns = side.trim_end_matches('\t').split('\t');
    columns.map(|text| text.trim_matches(parting)).collect()
}

/// Returns the column beside the symbols that holds the glosses: the first one with many different texts that are letters
/// for the most part. A number, a code or a language is no gloss.
fn gloss_column(text: &str) -> usize {
    let mut seen: BTreeMap<usize, (BTreeSet<String>, usize, usize)> = BTreeMap::new();
    for line in text.lines() {
        let line = in_plain_symbols(line);
        let Some(parts) = HnsLineParts::split_hns_line(&line) else {
            continue;
        };
        if !line.contains('\t') && parts.after.is_empty() {
            continue;
        }
        for (at, text) in parts.numbered_side_columns() {
            let (texts, letters, all) = seen.entry(at).or_insert((BTreeSet::new(), 0, 1));
            let count = text.chars().filter(|c| c.is_alphabetic()).count();
            *letters += count;
            *all += text.chars().count();
            if count > 0 {
                texts.insert(text.to_owned());
            }
        }
    }
    let largest_count = seen.values().map(|(texts, ..)| texts.len()).max();
    let most = largest_count.unwrap_or_default();
    let named = |(_, (texts, letters, all)): &(&usize, &(BTreeSet<String>, usize, usize))| {
        texts.len() * 2 >= most && letters * 2 >= *all
    };
    let lettered = || seen.iter().find(|(_, (texts, ..))| texts.len() == most);
    let chosen_column = seen.iter().find(named).or_else(lettered);
    chosen_column.map_or(0, |(at, _)| *at)
}

/// Returns the gloss among the columns beside the symbols of a line, and reports the others.
fn choose_line_gloss<'t>(line: u64, parts: &HnsLineParts<'t>, column: usize, findings: &mut FindingTally) -> &'t str {
    let texts: Vec<(usize, &str)> = parts
        .numbered_side_columns()
        .filter(|cell| !cell.1.is_empty())
        .collect();
    match texts.as_slice() {
        [] => return parts.before,
        [(at, _)] if *at < MAX_LEADING_COLUMNS => return parts.before,
        [(_, text)] => return text,
        _ => {}
    }
    // A line with fewer columns than the others has its gloss in the last one of that side.
    let is_after = column >= MAX_LEADING_COLUMNS;
    let same_side = |cell: &&(usize, &str)| (cell.0 >= MAX_LEADING_COLUMNS) == is_after;
    let named_cell = texts.iter().find(|cell| cell.0 == column);
    let gloss_cell = named_cell.or_else(|| texts.iter().rfind(same_side));
    let (at, gloss) = gloss_cell.or(texts.first()).copied().unwrap_or_default();
    let other_cells = texts.iter().filter(|cell| cell.0 != at);
    let left_out: Vec<&str> = other_cells.map(|cell| cell.1).collect();
    findings.add_limited_finding("columns beside the gloss", || {
        let message = match at.checked_sub(MAX_LEADING_COLUMNS) {
            Some(after) => format!(
                "of the columns beside HamNoSys, number {} after it was taken for the gloss: {gloss:?}; the others were \
                 left out",
                after + 1
            ),
            None if texts.iter().filter(|cell| cell.0 < MAX_LEADING_COLUMNS).count() > 1 => format!(
                "of the columns before HamNoSys, number {} was taken for the gloss: {gloss:?}; the others were left out",
                at + 1
            ),
            None => format!("the text after HamNoSys was left out: {:?}", left_out.join(", ")),
        };
        ImportFinding::new_note_finding(line, message).with_remedy(
            "if another one is the gloss, leave out the others, or save the file as a table with titles: .tsv",
        )
    });
    gloss
}

/// Returns whether a character stands between a gloss and its notation.
fn parting(c: char) -> bool {
    c.is_whitespace() || matches!(c, ',' | ';' | ':' | '=' | '|' | '"')
}

fn read_hns_entry(line: u64, gloss: &str, text: &str, findings: &mut FindingTally) -> HnsSign {
    let (gloss, text) = (gloss.trim_matches(parting), text.trim().trim_end_matches('"'));
    let read = parse_lenient(text);
    for found in read.findings {
        findings.add_limited_finding("odd symbols", || {
            let message = format!("symbol {}: {}", found.symbol_number(), found.message);
            let finding = if found.dropped {
                ImportFinding::new_warning_finding(line, message)
            } else {
                ImportFinding::new_note_finding(line, message)
            };
            finding.with_remedy(found.remedy)
        });
    }
    HnsSign {
        sign: NotatedSign {
            gloss: gloss.to_owned(),
            text: Some(text.to_owned()),
            sign: read.sign,
            ..NotatedSign::default()
        },
        line,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::hamnosys::to_names;
    use proptest::prelude::*;

    fn glosses(text: &str) -> Vec<(u64, String, String)> {
        let (entries, _) = read_hns(text.as_bytes()).expect("read");
        let fields = |entry: HnsSign| (entry.line, entry.sign.gloss, entry.sign.text.unwrap_or_default());
        entries.into_iter().map(fields).collect()
    }

    #[test]
    fn text_before_the_first_symbol_is_the_gloss() {
        let flat = "hamflathand hamextfingeru hampalml";
        for (line, gloss) in [
            (format!("MERCI\t{flat}"), "MERCI"),
            (format!("BON JOUR: {flat}"), "BON JOUR"),
            (format!("1 0 117 58 bac {flat} "), "1 0 117 58 bac"),
            (format!("\"hamster\",\"{flat}\""), "hamster"),
            (format!("\u{feff}  {flat}"), ""),
            (format!("HAMBURG\t{flat}"), "HAMBURG"),
        ] {
            assert_eq!(glosses(&line), [(1, gloss.to_owned(), flat.to_owned())], "{line:?}");
        }
        let characters = "\u{e001}\u{e020}\u{e03c}";
        for written in [
            "A\tU+E001 U+E020 U+E03C",
            "A\tE001 E020 E03C",
            "A;HAMFLATHAND HAMEXTFINGERU HAMPALMD",
            "A \\hamflathand\\hamextfingeru\\hampalmd",
        ] {
            let (entries, findings) = read_hns(written.as_bytes()).expect(written);
            assert_eq!((entries.len(), findings), (1, vec![]), "{written}");
            let sign = &entries[0].sign;
            let names = to_names(sign.text.as_deref().unwrap_or_default()).expect(written);
            let names: Vec<_> = names.into_iter().filter(|it| *it != "hamspace").collect();
            let expected = ["hamflathand", "hamextfingeru", "hampalmd"];
            assert_eq!((&*sign.gloss, &names[..]), ("A", &expected[..]), "{written}");
        }
        assert_eq!(
            glosses(&format!("\nÀ\t{characters}\r\n\r\nB {flat}\n")),
            [
                (2, "À".to_owned(), characters.to_owned()),
                (4, "B".to_owned(), flat.to_owned())
            ]
        );
    }

    #[test]
    fn of_several_columns_before_the_symbols_one_is_the_gloss() {
        let flat = "hamflathand hamextfingeru hampalml";
        for (lines, wanted) in [
            (
                &["0\tDERTIEN_13\t", "1\tTWEE_2\t", "2\tTWEE_2\t"][..],
                ["DERTIEN_13", "TWEE_2", "TWEE_2"],
            ),
            (&["A\tNGT\tx", "BON JOUR\tNGT\ty", "C\tNGT\tz"], ["A", "BON JOUR", "C"]),
            (&["S0001\tA-A\tthe first", "S0002\tBOL\t", "\tC\t"], ["A-A", "BOL", "C"]),
            (&["A\t", "B", "4\t"], ["A", "B", "4"]),
        ] {
            let text: Vec<String> = lines.iter().map(|it| format!("{it}\t{flat}")).collect();
            let found: Vec<String> = glosses(&text.join("\n")).into_iter().map(|it| it.1).collect();
            assert_eq!(found, wanted, "{lines:?}");
        }
        let (_, findings) = read_hns(format!("0\tDERTIEN_13\t{flat}").as_bytes()).expect("read");
        let wanted = "of the columns before HamNoSys, number 2 was taken for the gloss: \"DERTIEN_13\"; \
                      the others were left out";
        assert_eq!(findings[0].message, wanted);
    }

    #[test]
    fn a_gloss_may_stand_after_the_symbols() {
        let flat = "hamflathand hamextfingeru hampalml";
        let characters = "\u{e001}\u{e020}\u{e03c}";
        // The lines, the glosses and the beginning of the finding.
        let cases: [(&[&str], &[&str], &str); 10] = [
            (&["*\tMERCI", "*\tBON JOUR"], &["MERCI", "BON JOUR"], ""),
            (&["*,MERCI", "*,BON JOUR"], &["MERCI", "BON JOUR"], ""),
            (&["\"*\",\"MERCI\""], &["MERCI"], ""),
            (&["*;MERCI", "*"], &["MERCI", ""], ""),
            (&["*   MERCI", "* BON"], &["MERCI", "BON"], ""),
            (
                &["12\t*\tMERCI", "13\t*\tBON"],
                &["MERCI", "BON"],
                "of the columns beside HamNoSys, number 1 after",
            ),
            (
                &["*\t12\tMERCI", "*\t13\tBON"],
                &["MERCI", "BON"],
                "of the columns beside HamNoSys, number 2 after",
            ),
            (
                &["*\tMERCI\t", "*\tBON\tx"],
                &["MERCI", "BON"],
                "of the columns beside HamNoSys, number 1 after",
            ),
            (
                &["MERCI\t*\tthanks", "BON\t*"],
                &["MERCI", "BON"],
                "the text after HamNoSys was left out: \"thanks\"",
            ),
            (&["MERCI\t*", "*\tBON"], &["MERCI", "BON"], ""),
        ];
        for notation in [flat, characters] {
            for (lines, wanted, finding) in cases {
                let text = lines.join("\n").replace('*', notation);
                let (entries, findings) = read_hns(text.as_bytes()).expect("read");
                let found: Vec<&str> = entries.iter().map(|it| it.sign.gloss.as_str()).collect();
                assert_eq!(found, wanted, "{text:?}");
                for entry in &entries {
                    assert_eq!(entry.sign.text.as_deref(), Some(notation), "{text:?}");
                }
                let messages: Vec<&str> = findings.iter().map(|it| it.message.as_str()).collect();
                match finding {
                    "" => assert_eq!(messages, Vec::<&str>::new(), "{text:?}"),
                    start => assert!(messages.iter().any(|it| it.starts_with(start)), "{messages:?}"),
                }
            }
        }
        // Odd symbols at the end are no gloss.
        for odd in ["hamnosuch", "\u{e001}hamnosuch", "{", "xyz"] {
            let (entries, findings) = read_hns(format!("A\t{flat} {odd}").as_bytes()).expect("read");
            assert_eq!(entries[0].sign.gloss, "A", "{odd}");
            assert!(findings[0].message.starts_with("symbol "), "{odd}: {findings:?}");
        }
    }

    #[test]
    fn a_misspelt_first_symbol_is_no_gloss_and_is_reported() {
        // The line, its gloss, and the misspelt words.
        let cases = [
            ("A\thamflathnd hamextfingeru hampalmd", "A", 1),
            ("A\thamflathnd\thamextfingeru\thampalmd", "A", 1),
            ("A\thamflathnd,hamextfingeru,hampalmd", "A", 1),
            ("A\thamflathnd hamthumboutmodd hampalmd", "A", 2),
            ("A\tHAMFLATHND HAMEXTFINGERU", "A", 1),
            ("A B hamflathnd hamextfingeru hampalmd", "A B", 1),
            ("12\tA\thamflathnd hamextfingeru", "A", 1),
            ("hamflathnd hamextfingeru hampalmd", "", 1),
            ("hamflathnd hamextfingeru hampalmd\tA", "A", 1),
            ("A\t\u{e0fe}\u{e020}\u{e03c}", "A", 1),
            ("HAMFEET\thamfist hamextfingeru", "HAMFEET", 0),
            ("HAMFEET hamfist hamextfingeru", "HAMFEET", 0),
            ("0\tHAMFEET\thamfist hamextfingeru", "HAMFEET", 0),
            ("hamfeet;hamfist hamextfingeru", "hamfeet", 0),
            ("A HAMSTER\thamfist hamextfingeru", "A HAMSTER", 0),
        ];
        for (line, gloss, odd) in cases {
            let (entries, findings) = read_hns(line.as_bytes()).expect(line);
            assert_eq!(entries[0].sign.gloss, gloss, "{line}");
            let unread = |finding: &&ImportFinding| finding.message.starts_with("symbol ");
            let unread: Vec<_> = findings.iter().filter(unread).collect();
            assert_eq!(unread.len(), odd, "{line}: {findings:?}");
            if odd > 0 {
                assert!(unread[0].message.starts_with("symbol 1: "), "{unread:?}");
            }
        }
        let (_, findings) = read_hns(b"A\thamflathnd hamextfingeru").expect("read");
        assert!(findings[0].message.contains("did you mean \"hamflathand\""));
    }

    #[test]
    fn lines_without_symbols_and_odd_symbols_are_reported() {
        let (entries, findings) =
            read_hns(b"a title\nA\thamfist hamextfingeru hampalml hamparend\nB\t\n").expect("read");
        assert_eq!(entries.len(), 1);
        let reported: Vec<_> = findings.iter().map(|it| (it.line, it.message.as_str())).collect();
        assert_eq!(reported.len(), 3, "{reported:?}");
        assert_eq!(reported[0], (Some(1), "the line holds no HamNoSys; it was left out"));
        assert!(
            reported[1].0 == Some(2) && reported[1].1.starts_with("symbol 4"),
            "{reported:?}"
        );
        assert_eq!(reported[2].0, Some(3));
        assert_eq!(read_hns(b"nothing of the kind\n"), Err(HnsError::Nothing));
        assert_eq!(read_hns(b""), Err(HnsError::Nothing));
        assert_eq!(read_hns(b"A\n\0"), Err(HnsError::NotText { line: 2 }));
        let many = "\u{e000}\u{e020}\u{e03c}é\n".repeat(9_000);
        for skipped in 0..12 {
            assert!(holds_some(&many.as_bytes()[12 * skipped..]), "{skipped}");
            assert!(holds_some(format!("{}{many}", "a".repeat(skipped)).as_bytes()));
        }
        assert!(holds_some(b"x\ny hamfist") && !holds_some(b"a hamster") && !holds_some(b"\0"));
    }

    #[test]
    fn lines_in_a_wrong_encoding_are_mended_and_reported() {
        let text = "MERCI\t\u{e001}\u{e020}\u{e03c}\n";
        let latin: String = text.bytes().map(char::from).collect();
        let (entries, findings) = read_hns(latin.as_bytes()).expect("read");
        assert_eq!(entries[0].sign.text.as_deref(), Some("\u{e001}\u{e020}\u{e03c}"));
        assert!(findings[0].message.contains("mended"), "{findings:?}");
    }

    #[test]
    fn written_lines_read_back_unchanged() {
        let text = "A\thamflathand hamextfingeru hampalml\nB B\thamfist hamextfingero hampalmd hammoveo\n";
        let (first, _) = read_hns(text.as_bytes()).expect("read");
        let (bytes, lost) = write_hns(first.iter().map(|entry| &entry.sign));
        let (second, findings) = read_hns(&bytes).expect("read again");
        assert_eq!((lost, findings), (vec![Vec::<String>::new(); 2], vec![]));
        for (one, other) in first.iter().zip(&second) {
            assert_eq!((&one.sign.gloss, one.line), (&other.sign.gloss, other.line));
            assert_eq!(one.sign.hamnosys_text().text, other.sign.hamnosys_text().text);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn the_reader_accepts_any_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
            let _ = read_hns(&bytes);
        }

        #[test]
        fn the_reader_accepts_any_characters(text in "[\u{e000}-\u{e0f0} a\t\nhm]{0,80}") {
            let _ = read_hns(text.as_bytes());
        }
    }
}
