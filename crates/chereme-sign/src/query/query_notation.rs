//! Conditions on the notation of a sign: `notation~"hamfinger2 … hamcirclei"`.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

use super::QueryError;
use super::query_lex::{QueryCursor, WordContext};
use super::query_tree::{QueryPlace, TestSubject};
use crate::hamnosys::{HamnosysSymbol, SymbolClass, spelled_symbols};
use crate::text::nearest_candidate;

/// The name of the field.
pub(super) const NOTATION_FIELD: &str = "notation";
const NOTATION_REMEDY: &str = r#"write symbols as names or characters, … for a gap, ? for any symbol, [movement] for any of a class and hamcircle* for names that begin so: notation~"hamfinger2 … hamcircle*""#;
/// The most symbols and gaps of a pattern.
const MOST_PATTERN_WORDS: usize = 200;

/// A sequence of symbols of HamNoSys with gaps, which a notation has or has not.
///
/// Spaces between symbols do not count. Around the sign between what the two hands do, `hamplus`, either order counts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotationPattern {
    /// The runs of symbols without a gap, in order; empty ones at an end stand for a gap there.
    runs: Vec<Vec<SymbolTest>>,
}

/// A condition on one symbol.
#[derive(Debug, Clone, PartialEq, Eq)]
enum SymbolTest {
    One(HamnosysSymbol),
    Class(SymbolClass),
    /// One whose name begins so.
    Prefix(String),
    Any,
}

impl SymbolTest {
    fn accepts_symbol(&self, symbol: HamnosysSymbol) -> bool {
        match self {
            Self::One(own) => *own == symbol,
            Self::Class(class) => *class == symbol.symbol_class(),
            Self::Prefix(start) => symbol.symbol_name().starts_with(start),
            Self::Any => true,
        }
    }

    fn is_of_class(&self, class: SymbolClass) -> bool {
        matches!(self, Self::One(symbol) if symbol.symbol_class() == class)
    }
}

impl NotationPattern {
    /// Returns whether a notation, as HamNoSys in any spelling, has the sequence.
    #[must_use]
    pub fn accepts_notation(&self, text: &str) -> bool {
        let mut symbols = spelled_symbols(text).0;
        symbols.retain(|symbol| symbol.symbol_name() != "hamspace");
        let exchanged: Vec<_> = self.runs.iter().map(|run| exchange_hands(run)).collect();
        accepts_runs(&self.runs, &symbols) || (exchanged != self.runs && accepts_runs(&exchanged, &symbols))
    }
}

/// Returns a run with what stands on both sides of each `hamplus`, up to the brackets, exchanged.
fn exchange_hands(run: &[SymbolTest]) -> Vec<SymbolTest> {
    let is_plus = |test: &SymbolTest| matches!(test, SymbolTest::One(symbol) if symbol.symbol_name() == "hamplus");
    let is_bracket = |test: &SymbolTest| test.is_of_class(SymbolClass::Bracket);
    let Some(plus) = run.iter().position(is_plus) else {
        return run.to_vec();
    };
    let start = run[..plus].iter().rposition(is_bracket).map_or(0, |at| at + 1);
    let rest = &run[plus + 1..];
    let end = plus + 1 + rest.iter().position(is_bracket).unwrap_or(rest.len());
    let parts = [
        &run[..start],
        &run[plus + 1..end],
        &run[plus..=plus],
        &run[start..plus],
        &run[end..],
    ];
    parts.concat()
}

/// Returns whether the runs follow each other in some symbols, the first at their beginning and the last at their end.
fn accepts_runs(runs: &[Vec<SymbolTest>], symbols: &[HamnosysSymbol]) -> bool {
    let fits = |run: &[SymbolTest], at: usize| {
        let own = symbols.get(at..at + run.len());
        own.is_some_and(|own| run.iter().zip(own).all(|(test, symbol)| test.accepts_symbol(*symbol)))
    };
    let [first, others @ ..] = runs else {
        return true;
    };
    let Some((last, between)) = others.split_last() else {
        return first.len() == symbols.len() && fits(first, 0);
    };
    if !fits(first, 0) {
        return false;
    }
    let mut from = first.len();
    for run in between {
        // The earliest place leaves the most room for the others.
        let Some(at) = (from..=symbols.len()).find(|at| fits(run, *at)) else {
            return false;
        };
        from = at + run.len();
    }
    symbols
        .len()
        .checked_sub(last.len())
        .is_some_and(|at| at >= from && fits(last, at))
}

/// Returns the name of a class of symbols in patterns.
fn symbol_class_name(class: SymbolClass) -> String {
    let mut name = String::new();
    for letter in format!("{class:?}").chars() {
        if letter.is_uppercase() && !name.is_empty() {
            name.push('-');
        }
        name.push(letter.to_ascii_lowercase());
    }
    name
}

/// Reads the operator and the sequence after the field.
pub(super) fn parse_notation_test(cursor: &mut QueryCursor<'_>) -> Result<TestSubject, QueryError> {
    cursor.skip_blanks();
    let operator = cursor.peek_operator().unwrap_or_default();
    let operator_at = cursor.next(operator.chars().count());
    if !["~", ":", "="].contains(&operator) {
        let message = "a notation is not compared like this";
        let remedy =
            "write notation~ and symbols that it has, or notation= and the whole notation; `not` before it denies it";
        return Err(QueryError::new(operator_at, message, remedy));
    }
    cursor.pos = operator_at.end;
    cursor.skip_blanks();
    let word = cursor.read_query_word(WordContext::Value)?;
    cursor.check_word_boundary()?;
    let text = word.pattern.pattern_segments().join("*");
    let mut runs = parse_symbol_runs(&text, word.at)?;
    if operator != "=" {
        runs.insert(0, Vec::new());
        runs.push(Vec::new());
    }
    Ok(TestSubject::Notation(NotationPattern { runs }))
}

fn parse_symbol_runs(text: &str, at: QueryPlace) -> Result<Vec<Vec<SymbolTest>>, QueryError> {
    let spaced_text = text.replace("...", "…").replace('…', " … ");
    let mut runs = vec![Vec::new()];
    for (number, word) in spaced_text.split_whitespace().enumerate() {
        if number >= MOST_PATTERN_WORDS {
            let message = format!("more than {MOST_PATTERN_WORDS} symbols follow each other here");
            return Err(QueryError::new(at, message, NOTATION_REMEDY));
        }
        if ["…", "*"].contains(&word) {
            runs.push(Vec::new());
        } else if let Some(run) = runs.last_mut() {
            run.extend(parse_symbol_word(word, at)?);
        }
    }
    // A gap alone asks for any notation.
    if text.trim().is_empty() {
        return Err(QueryError::new(
            at,
            "no symbol of notation stands here",
            NOTATION_REMEDY,
        ));
    }
    Ok(runs)
}

fn parse_symbol_word(word: &str, at: QueryPlace) -> Result<Vec<SymbolTest>, QueryError> {
    if word == "?" {
        return Ok(vec![SymbolTest::Any]);
    }
    let names = || HamnosysSymbol::all_symbols().map(HamnosysSymbol::symbol_name);
    let refused = |message: String, near: Option<&str>| {
        Err(QueryError::new(at, message, NOTATION_REMEDY)
            .with_suggestion(near.map(|near| format!("{NOTATION_FIELD}~{near}"))))
    };
    if let Some(class_name) = word.strip_prefix('[').and_then(|word| word.strip_suffix(']')) {
        let classes = HamnosysSymbol::all_symbols().map(HamnosysSymbol::symbol_class);
        let by_name: BTreeMap<String, SymbolClass> = classes.map(|class| (symbol_class_name(class), class)).collect();
        let Some(class) = by_name.get(&class_name.to_lowercase()) else {
            let class_names: Vec<&str> = by_name.keys().map(String::as_str).collect();
            let near = nearest_candidate(class_name, class_names.iter().copied());
            let message = format!(
                "no class of symbols is called {class_name:?}: {}",
                class_names.join(", ")
            );
            return refused(message, near.map(|near| format!("[{near}]")).as_deref());
        };
        return Ok(vec![SymbolTest::Class(*class)]);
    }
    if let Some(start) = word.strip_suffix('*') {
        return match names().any(|name| name.starts_with(start)) {
            true => Ok(vec![SymbolTest::Prefix(start.to_owned())]),
            false => refused(format!("no symbol's name begins with {start:?}"), None),
        };
    }
    let (symbols, odd) = spelled_symbols(word);
    let Some(odd) = odd.first() else {
        return Ok(symbols.into_iter().map(SymbolTest::One).collect());
    };
    match HamnosysSymbol::from_symbol_name(&format!("ham{word}")) {
        Some(symbol) => Ok(vec![SymbolTest::One(symbol)]),
        None => refused(
            format!("{odd:?} is no symbol of HamNoSys"),
            nearest_candidate(word, names()),
        ),
    }
}

impl Display for NotationPattern {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let written = |run: &Vec<SymbolTest>| {
            let words = run.iter().map(|test| match test {
                SymbolTest::One(symbol) => symbol.symbol_name().to_owned(),
                SymbolTest::Class(class) => format!("[{}]", symbol_class_name(*class)),
                SymbolTest::Prefix(start) => format!("{start}*"),
                SymbolTest::Any => "?".to_owned(),
            });
            words.collect::<Vec<_>>().join(" ")
        };
        let inner = match self.runs.as_slice() {
            [first, inner @ .., last] if first.is_empty() && last.is_empty() && !inner.is_empty() => Some(inner),
            _ => None,
        };
        let operator = if inner.is_some() { '~' } else { '=' };
        let texts: Vec<String> = inner.unwrap_or(&self.runs).iter().map(written).collect();
        write!(f, "{NOTATION_FIELD}{operator}\"{}\"", texts.join(" … ").trim())
    }
}

#[cfg(test)]
mod tests {
    use super::super::TokenQuery;
    use super::*;

    fn pattern_of(text: &str) -> NotationPattern {
        let query: TokenQuery = text.parse().unwrap_or_else(|error| panic!("{text}: {error:?}"));
        match &query.query_tests()[0].what {
            TestSubject::Notation(pattern) => pattern.clone(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn patterns_are_read_in_any_spelling_and_printed_in_one() {
        let fist = HamnosysSymbol::from_symbol_name("hamfist")
            .expect("a symbol")
            .symbol_char();
        for (text, canonical) in [
            ("notation~hamfist", "notation~\"hamfist\""),
            (&format!("notation:{fist}"), "notation~\"hamfist\""),
            ("notation~fist", "notation~\"hamfist\""),
            (
                "notation~\"hamfinger2...hamcirclei\"",
                "notation~\"hamfinger2 … hamcirclei\"",
            ),
            (
                "notation~\"[handshape] ? hamcircle*\"",
                "notation~\"[handshape] ? hamcircle*\"",
            ),
            ("notation=*", "notation=\"…\""),
            ("notation=\"hamfist …\"", "notation=\"hamfist …\""),
            ("not notation~hamfist gloss=A", "not notation~\"hamfist\" gloss=A"),
        ] {
            let query: TokenQuery = text.parse().unwrap_or_else(|error| panic!("{text}: {error:?}"));
            assert_eq!(query.to_string(), canonical, "{text}");
            assert_eq!(canonical.parse::<TokenQuery>(), Ok(query), "{canonical}");
        }
        for (wrong, message) in [
            ("notation~hamfits", "no symbol of HamNoSys"),
            ("notation~\"[moves]\"", "no class of symbols"),
            ("notation~hamxyz*", "no symbol's name begins"),
            ("notation~\"\"", "no symbol of notation"),
            ("notation>hamfist", "not compared like this"),
        ] {
            let error = wrong.parse::<TokenQuery>().expect_err(wrong);
            assert!(error.message.contains(message), "{wrong}: {error:?}");
        }
    }

    #[test]
    fn hands_may_stand_in_either_order() {
        let pattern = pattern_of("notation~\"hamfist hamplus hamflathand\"");
        assert!(pattern.accepts_notation("hamparbegin hamfist hamplus hamflathand hamparend"));
        assert!(pattern.accepts_notation("hamparbegin hamflathand hamplus hamfist hamparend"));
        assert!(!pattern.accepts_notation("hamfist hamflathand hamplus"));
    }

    /// Returns whether the runs fit, by trying every place of every run.
    fn fits_somewhere(runs: &[Vec<SymbolTest>], symbols: &[HamnosysSymbol], from: usize, is_first: bool) -> bool {
        let Some((run, rest)) = runs.split_first() else {
            return false;
        };
        (from..=symbols.len()).any(|at| {
            let end = at + run.len();
            (!is_first || at == 0)
                && end <= symbols.len()
                && run
                    .iter()
                    .zip(&symbols[at..end])
                    .all(|(test, own)| test.accepts_symbol(*own))
                && if rest.is_empty() {
                    end == symbols.len()
                } else {
                    fits_somewhere(rest, symbols, end, false)
                }
        })
    }

    #[test]
    fn matching_is_that_of_a_search_of_every_place() {
        let names = ["hamfist", "hamflathand", "hamcirclei"];
        let symbol = |n: u64| HamnosysSymbol::from_symbol_name(names[n as usize % 3]).expect("a symbol");
        let mut state = 7_u64;
        let mut draw = |most: u64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % most
        };
        let mut found = 0;
        for _ in 0..4000 {
            let symbols: Vec<HamnosysSymbol> = (0..draw(9)).map(|_| symbol(draw(3))).collect();
            let runs: Vec<Vec<SymbolTest>> = (0..=draw(4))
                .map(|_| {
                    let tests = (0..draw(4)).map(|_| match draw(8) {
                        0 => SymbolTest::Any,
                        1 => SymbolTest::Class(SymbolClass::Handshape),
                        2 => SymbolTest::Prefix("hamcirc".to_owned()),
                        n => SymbolTest::One(symbol(n)),
                    });
                    tests.collect()
                })
                .collect();
            let want = fits_somewhere(&runs, &symbols, 0, true);
            found += usize::from(want);
            assert_eq!(accepts_runs(&runs, &symbols), want, "{runs:?} {symbols:?}");
        }
        assert!((200..3800).contains(&found), "{found}");
    }
}
