//! Visual order of lines with right-to-left text.
//!
//! egui shapes each word in its own script, and places one word after the other from the left. So it is given the text
//! in visual order, each right-to-left word as a separate section.

use std::ops::Range;
use std::sync::Arc;

use chereme_figure::letters::{hangs_on, mirror_bracket, reads_from_right, visual_text_runs};
use eframe::egui::text::{ByteIndex, LayoutJob, LayoutSection, TextWrapping};
use eframe::egui::{Context, Galley};

/// A part of a line, in visual order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct VisualPiece {
    /// Its bytes in the text.
    pub(super) range: Range<usize>,
    pub(super) text: String,
    pub(super) from_right: bool,
}

/// Returns the layout of the same text in visual order, with the same line breaks.
pub(super) fn text_in_visual_order(ctx: &Context, galley: &Galley) -> Arc<Galley> {
    in_order_by_line(ctx, galley).0
}

/// Returns the same, and the byte range of each line in the text.
pub(super) fn in_order_by_line(ctx: &Context, galley: &Galley) -> (Arc<Galley>, Vec<Range<usize>>) {
    let words = in_words(&galley.job);
    ctx.fonts_mut(|fonts| {
        let lines = galley_text_lines(&fonts.layout_job(words));
        let turned = fonts.layout_job(turned_layout_job(&galley.job, &lines));
        (turned, lines.into_iter().map(|(range, _)| range).collect())
    })
}

/// Returns the job with a section for each right-to-left word, so that lines are broken between them.
fn in_words(job: &LayoutJob) -> LayoutJob {
    let mut cut = job.clone();
    cut.sections.clear();
    for section in &job.sections {
        let range = section.byte_range.start.0..section.byte_range.end.0;
        let pieces = split_script_words(&job.text[range.clone()]);
        for (nth, (piece, _)) in pieces.into_iter().enumerate() {
            let leading_space = if nth == 0 { section.leading_space } else { 0.0 };
            let (start, end) = (range.start + piece.start, range.start + piece.end);
            cut.sections.push(LayoutSection {
                leading_space,
                byte_range: ByteIndex(start)..ByteIndex(end),
                format: section.format.clone(),
            });
        }
    }
    cut
}

/// Cuts a text into right-to-left words and the parts between them; the flag marks the words.
fn split_script_words(text: &str) -> Vec<(Range<usize>, bool)> {
    let mut words: Vec<(Range<usize>, bool)> = Vec::new();
    for (at, letter) in text.char_indices() {
        let end = at + letter.len_utf8();
        let before = words.last().is_some_and(|(_, from_right)| *from_right);
        let from_right = reads_from_right(letter) || (before && hangs_on(letter));
        match words.last_mut() {
            Some((range, same)) if *same == from_right => range.end = end,
            _ => words.push((at..end, from_right)),
        }
    }
    words
}

/// A line: its byte range in the text, and whether its end is elided.
type TextLineRange = (Range<usize>, bool);

/// Returns the lines of a text that was laid out word by word.
///
/// The layout of a right-to-left word does not have a glyph for each character, but every blank has one.
fn galley_text_lines(galley: &Galley) -> Vec<TextLineRange> {
    let text = galley.job.text.as_str();
    let mut lines = Vec::new();
    let mut start = 0;
    for (nth, row) in galley.rows.iter().enumerate() {
        let last = nth + 1 == galley.rows.len();
        let cut = last && galley.elided;
        let rest = &text[start..];
        let glyphs = &row.row.glyphs;
        let end = if row.ends_with_newline || (last && !cut) {
            rest.find('\n').filter(|_| galley.job.break_on_newline)
        } else {
            let blanks = glyphs.iter().filter(|glyph| glyph.chr.is_whitespace()).count();
            let after = match glyphs.iter().rposition(|glyph| glyph.chr.is_whitespace()) {
                Some(at) => &glyphs[at + 1..],
                None => &glyphs[..],
            };
            let seen = after.iter().filter(|glyph| glyph.advance_width > 0.0).count();
            Some(count_beginning_bytes(rest, blanks, seen - usize::from(cut && seen > 0)))
        };
        let end = start + end.unwrap_or(rest.len());
        lines.push((start..end, cut));
        start = end;
        if row.ends_with_newline && text[start..].starts_with('\n') {
            start += 1;
        }
    }
    lines
}

/// Returns the number of bytes up to the given number of blanks, plus that number of letters after the last of them.
fn count_beginning_bytes(text: &str, blanks: usize, letters: usize) -> usize {
    let mut all = text.char_indices().filter(|(_, letter)| letter.is_whitespace());
    let after = match blanks.checked_sub(1).map(|nth| all.nth(nth)) {
        Some(Some((at, blank))) => at + blank.len_utf8(),
        Some(None) => return text.len(),
        None => 0,
    };
    let rest = text[after..].char_indices();
    let mut seen = rest.filter(|(_, letter)| !hangs_on(*letter)).skip(letters);
    seen.next().map_or(text.len(), |(at, _)| after + at)
}

/// Returns the job that draws `lines` in visual order.
fn turned_layout_job(job: &LayoutJob, lines: &[TextLineRange]) -> LayoutJob {
    let mut turned = LayoutJob {
        text: String::with_capacity(job.text.len()),
        sections: Vec::new(),
        wrap: TextWrapping::no_max_width(),
        justify: false,
        ..job.clone()
    };
    let mut add = |text: &str, at: usize, first: bool| {
        let Some(section) = section_at(job, at) else {
            return;
        };
        let start = turned.text.len();
        turned.text.push_str(text);
        // A piece in the middle of a section has no space before it.
        let begins = first && section.byte_range.start.0 == at;
        turned.sections.push(LayoutSection {
            leading_space: if begins { section.leading_space } else { 0.0 },
            byte_range: ByteIndex(start)..ByteIndex(turned.text.len()),
            format: section.format.clone(),
        });
    };
    for (nth, (range, cut)) in lines.iter().enumerate() {
        if nth > 0 {
            add("\n", range.start.saturating_sub(1), false);
        }
        let pieces = visual_line_pieces(&job.text[range.clone()], &|at| {
            format_section_end(job, range.start + at).saturating_sub(range.start)
        });
        for (nth, piece) in pieces.iter().enumerate() {
            add(&piece.text, range.start + piece.range.start, nth == 0);
        }
        // The job draws lines as they are, so that the sign of a cut is added here.
        if let (true, Some(sign)) = (*cut, job.wrap.overflow_character) {
            add(&sign.to_string(), range.end.saturating_sub(1), false);
        }
    }
    turned
}

/// Returns the section that contains a byte, or the last one before it.
fn section_at(job: &LayoutJob, at: usize) -> Option<&LayoutSection> {
    let after = job.sections.partition_point(|section| section.byte_range.start.0 <= at);
    job.sections.get(after.saturating_sub(1))
}

/// Returns the end of the section that contains a byte.
fn format_section_end(job: &LayoutJob, at: usize) -> usize {
    section_at(job, at).map_or(usize::MAX, |section| section.byte_range.end.0)
}

/// Returns the pieces of a line in visual order, from left to right; `end` returns where the format at a byte ends. The
/// byte is counted from the beginning of the line.
pub(super) fn visual_line_pieces(line: &str, end: &dyn Fn(usize) -> usize) -> Vec<VisualPiece> {
    let mut pieces = Vec::new();
    for run in visual_text_runs(line) {
        let text = &line[run.range.clone()];
        let mut of_run: Vec<VisualPiece> = Vec::new();
        let cut = if run.from_right {
            split_script_words(text)
        } else {
            vec![(0..text.len(), false)]
        };
        for (range, word) in cut {
            let range = run.range.start + range.start..run.range.start + range.end;
            for range in split_at_format_changes(line, range, end) {
                let part = &line[range.clone()];
                let text = match run.from_right && !word {
                    true => part.chars().rev().map(mirror_bracket).collect(),
                    false => part.to_owned(),
                };
                of_run.push(VisualPiece {
                    range,
                    text,
                    from_right: run.from_right,
                });
            }
        }
        if run.from_right {
            of_run.reverse();
        }
        pieces.append(&mut of_run);
    }
    pieces
}

/// Cuts a range where the format changes.
fn split_at_format_changes(line: &str, range: Range<usize>, end: &dyn Fn(usize) -> usize) -> Vec<Range<usize>> {
    let mut parts: Vec<Range<usize>> = Vec::new();
    let mut limit = 0;
    for (at, letter) in line[range.clone()].char_indices() {
        let letter_start = range.start + at;
        let next = letter_start + letter.len_utf8();
        match parts.last_mut() {
            Some(part) if letter_start < limit => part.end = next,
            _ => {
                limit = end(letter_start);
                parts.push(letter_start..next);
            }
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{Color32, FontId, RawInput, TextFormat};
    use proptest::prelude::*;

    fn shown(line: &str) -> String {
        let pieces = visual_line_pieces(line, &|_| usize::MAX);
        let part = |piece: &VisualPiece| match split_script_words(&piece.text).iter().any(|(_, it)| *it) {
            true => format!("<{}>", piece.text),
            false => piece.text.clone(),
        };
        pieces.iter().map(part).collect()
    }

    #[test]
    fn words_are_placed_in_reading_order() {
        for (line, wanted) in [
            ("AIMER", "AIMER"),
            ("كتاب is notated.", "<كتاب> is notated."),
            ("كتاب كبير", "<كبير> <كتاب>"),
            ("(كتاب)", "(<كتاب>)"),
            // A number after Arabic letters belongs to them.
            ("see كتاب كبير (2)", "see (2) <كبير> <كتاب>"),
            ("שלום, עולם!", "!<עולם> ,<שלום>"),
        ] {
            assert_eq!(shown(line), wanted, "{line}");
        }
    }

    fn context() -> Context {
        let ctx = Context::default();
        crate::theme::install_studio_theme(&ctx);
        crate::script::install_script_support(&ctx);
        for _ in 0..2 {
            let mut output = ctx.run_ui(RawInput::default(), |_| {});
            output.textures_delta.clear();
        }
        ctx
    }

    fn laid_out(ctx: &Context, job: LayoutJob) -> Arc<Galley> {
        ctx.fonts_mut(|fonts| fonts.layout_job(job))
    }

    fn job(text: &str, width: f32) -> LayoutJob {
        let font = FontId::proportional(14.0);
        LayoutJob::simple(text.to_owned(), font, Color32::WHITE, width)
    }

    #[test]
    fn a_sentence_that_begins_with_an_arabic_gloss_is_drawn_forwards_and_as_wide() {
        let ctx = context();
        let before = laid_out(&ctx, job("كتاب is notated, not stored.", f32::INFINITY));
        let after = text_in_visual_order(&ctx, &before);
        assert_eq!(after.job.text, "كتاب is notated, not stored.");
        let drawn: String = after.rows[0].row.glyphs.iter().map(|glyph| glyph.chr).collect();
        assert!(drawn.ends_with(" is notated, not stored."), "{drawn}");
        let x = |letter| {
            let glyphs = &after.rows[0].row.glyphs;
            let found = glyphs.iter().find(|glyph| glyph.chr == letter);
            found.map(|glyph| glyph.pos.x).expect("a letter")
        };
        assert!(x('ب') < x('ك'), "the first letter stands at the right");
        assert!(x('ك') < x('n'));
    }

    #[test]
    fn line_breaks_are_kept_and_each_line_is_ordered() {
        let ctx = context();
        let text = "كتاب كبير is a sign that was notated كتاب كبير and is not stored yet";
        for width in [60.0, 120.0, 180.0, 400.0] {
            let before = laid_out(&ctx, job(text, width));
            let after = text_in_visual_order(&ctx, &before);
            let mut letters: Vec<char> = after.job.text.chars().filter(|c| *c != '\n').collect();
            let mut wanted: Vec<char> = text.chars().collect();
            letters.sort_unstable();
            wanted.sort_unstable();
            assert_eq!(letters, wanted, "{width}");
            assert!(after.rect.width() <= width + 1.0, "{width}: {}", after.rect.width());
        }
    }

    /// Lays out `parts`, each in its colour, and returns the pieces in visual order with their colours.
    fn colours(parts: &[(&str, Color32)]) -> Vec<(String, Color32)> {
        let ctx = context();
        let mut job = LayoutJob::default();
        for (text, colour) in parts {
            let format = TextFormat::simple(FontId::proportional(14.0), *colour);
            job.append(text, 0.0, format);
        }
        let turned = text_in_visual_order(&ctx, &laid_out(&ctx, job));
        let text = |it: &LayoutSection| turned.job.text[it.byte_range.start.0..it.byte_range.end.0].to_owned();
        let sections = turned.job.sections.iter();
        sections.map(|it| (text(it), it.format.color)).collect()
    }

    #[test]
    fn colours_stay_with_their_letters() {
        let (red, green) = (Color32::RED, Color32::GREEN);
        let wanted = [("كبير", green), (" ", red), ("كتاب", red)];
        let wanted: Vec<_> = wanted.map(|(text, it)| (text.to_owned(), it)).into();
        assert_eq!(colours(&[("كتاب ", red), ("كبير", green)]), wanted);
        // On a second line, too.
        let below = colours(&[("a\nab", red), ("cd", green)]);
        let shown: Vec<(&str, Color32)> = below.iter().map(|it| (it.0.as_str(), it.1)).collect();
        assert_eq!(shown, [("a", red), ("\n", red), ("ab", red), ("cd", green)]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]

        #[test]
        fn no_text_is_lost_or_panics(text in "[a-c \u{5d0}-\u{5d4}\u{627}-\u{62b}\u{64b}\u{202b}\u{202c}\u{200d}(1\n\t漢]{0,24}", width in 5.0f32..200.0, rows in 0usize..3) {
            let ctx = context();
            let mut job = job(&text, width);
            if rows > 0 {
                job.wrap.max_rows = rows;
                job.wrap.break_anywhere = true;
            }
            let before = laid_out(&ctx, job);
            let after = text_in_visual_order(&ctx, &before);
            prop_assert!(rows > 0 || after.job.text.chars().filter(|c| *c != '\n').count() == text.chars().filter(|c| *c != '\n').count());
        }
    }
}
