//! Golden tables: every number that the modules of a crate compute from generated input, in text that people can read.
//!
//! Crates take this file as a module of their tests and keep their tables in `tests/goldens/`. If a finding is meant to
//! change, `UPDATE_GOLDENS=1 cargo test --workspace --lib -- golden` writes the tables again; their difference then
//! shows all that has changed.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs};

/// Below this, a number counts as zero: angles between equal directions have errors of this kind.
const NOTHING: f64 = 1e-4;

/// The same for movement in millimetres and degrees that is found step by step.
pub(crate) const LITTLE: f64 = 1e-3;

/// Adds a line to a text.
pub(crate) fn put(out: &mut String, line: impl AsRef<str>) {
    writeln!(out, "{}", line.as_ref()).expect("a text grows");
}

/// Compares lines with a golden table, or writes the table. Floating-point numbers may differ by one in the last of
/// their four digits.
pub(crate) fn compare(name: &str, text: &str) {
    compare_to(name, text, NOTHING);
}

/// Compares lines with a golden table like [`compare`]; numbers may also differ by `least`.
pub(crate) fn compare_to(name: &str, text: &str, least: f64) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/goldens/{name}.txt"));
    let now: Vec<String> = text.lines().map(|line| rounded(line, least)).collect();
    if env::var_os("UPDATE_GOLDENS").is_some() {
        fs::write(&path, now.join("\n") + "\n").expect("the table is written");
        return;
    }
    let table = fs::read_to_string(&path).expect("the table");
    let known: Vec<&str> = table.lines().collect();
    let differ = |n: &usize| match (known.get(*n), now.get(*n)) {
        (Some(was), Some(is)) => !alike(was, is, least),
        _ => true,
    };
    let lines: Vec<usize> = (0..known.len().max(now.len())).filter(differ).collect();
    let Some(&first) = lines.first() else {
        return;
    };
    let heading = now.iter().take(first + 1).rfind(|it| it.starts_with("## "));
    panic!(
        "{name}: {} lines differ, the first one is line {} in {}\n was: {}\n  is: {}\n\
         if that is meant, UPDATE_GOLDENS=1 writes the table again",
        lines.len(),
        first + 1,
        heading.map_or("", |it| it.as_str()),
        known.get(first).unwrap_or(&"(no line)"),
        now.get(first).map_or("(no line)", |it| it.as_str()),
    );
}

/// A stretch of a line.
#[derive(Debug, PartialEq)]
enum Piece<'a> {
    Words(&'a str),
    Float(f64),
}

/// Cuts a line into its floating-point numbers and the text between them; whole numbers count as text.
fn pieces(line: &str) -> Vec<Piece<'_>> {
    let bytes = line.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let is = |at: usize, byte: u8| bytes.get(at) == Some(&byte);
    let digits = |mut at: usize| {
        while digit(at) {
            at += 1;
        }
        at
    };
    let (mut found, mut from, mut at) = (Vec::new(), 0, 0);
    while at < bytes.len() {
        let after = at > 0 && (bytes[at - 1].is_ascii_alphanumeric() || bytes[at - 1] == b'_');
        let begin = at + usize::from(is(at, b'-'));
        if after || !digit(begin) {
            at += 1;
            continue;
        }
        let mut end = digits(begin);
        let whole = end;
        if is(end, b'.') && digit(end + 1) {
            end = digits(end + 1);
        }
        if is(end, b'e') && digit(end + 1 + usize::from(is(end + 1, b'-'))) {
            end = digits(end + 1 + usize::from(is(end + 1, b'-')));
        }
        if end > whole {
            found.push(Piece::Words(&line[from..at]));
            found.push(Piece::Float(line[at..end].parse().expect("a number")));
            from = end;
        }
        at = end;
    }
    found.push(Piece::Words(&line[from..]));
    found
}

/// Rounds each floating-point number of a line to four digits; those below `least` are zero.
fn rounded(line: &str, least: f64) -> String {
    let written = |piece: Piece<'_>| match piece {
        Piece::Words(words) => words.to_owned(),
        Piece::Float(number) if number.abs() < least => "0.0".to_owned(),
        Piece::Float(number) => {
            let number: f64 = format!("{number:.3e}").parse().expect("a number");
            format!("{number:?}")
        }
    };
    let line: String = pieces(line).into_iter().map(written).collect();
    line.trim_end().to_owned()
}

/// Returns whether two lines are equal but for the last of four digits, or for `least`.
fn alike(was: &str, is: &str, least: f64) -> bool {
    let near = |a: f64, b: f64| {
        let off = (a - b).abs();
        if off < 1.1 * least {
            return true;
        }
        let last = 10f64.powf(a.abs().max(b.abs()).log10().floor() - 3.0);
        off < 1.5 * last
    };
    let (was, is) = (pieces(was), pieces(is));
    was.len() == is.len()
        && was.iter().zip(&is).all(|pair| match pair {
            (Piece::Float(a), Piece::Float(b)) => near(*a, *b),
            (a, b) => a == b,
        })
}

#[test]
fn golden_numbers_may_differ_in_their_last_digit_alone() {
    let (rounded, alike) = (
        |line: &str| rounded(line, NOTHING),
        |was: &str, is: &str| alike(was, is, NOTHING),
    );
    assert_eq!(
        rounded("Index2 0..12 -0.000001 12345.6 [1.23456, -2e-3] 7"),
        "Index2 0..12 0.0 12350.0 [1.235, -0.002] 7"
    );
    assert!(alike("a 1.234 frames 0..12", "a 1.235 frames 0..12"));
    assert!(alike("0.0001", "0.0"));
    assert!(!alike("a 1.234", "a 1.236"));
    assert!(!alike("a 1.234", "b 1.234"));
    assert!(!alike("frame 11", "frame 12"));
    assert!(!alike("0.5", "-0.5"));
    assert!(self::alike("0.0121", "0.0129", LITTLE) && !alike("0.0121", "0.0129"));
}
