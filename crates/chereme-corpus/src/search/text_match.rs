//! Comparisons of texts: glosses, translations and remarks.

use chereme_sign::Reading;
use chereme_sign::query::{
    Comparison, Missing, Operator, Pattern, QueryError, Test, TextField, Value, Wanted, What,
};
use chereme_sign::text::fold;

use super::compile::{Ask, Asked};
use super::docs::Docs;
use super::finding::FindingKind;
use super::findings;
use super::known::fitting;
use super::plan::{Plan, WholeText};
use super::probe::{Probe, RowField, Text};
use super::texts::{Glob, words};
use crate::db::search::answers;
use crate::db::search::terms::TokenProperty;

/// The longest word that is compared up to slips: the automaton grows with its length.
const LONGEST_FUZZY: usize = 64;

/// Returns the plan for a comparison of whole texts; if a token has several, one match suffices.
pub(crate) fn plan(ask: &Ask<'_>, field: TextField, comparison: &Comparison) -> Asked<Plan> {
    match field {
        TextField::Gloss => gloss(ask, comparison, true),
        TextField::Translation | TextField::Comment => {
            other(ask, field == TextField::Translation, comparison)
        }
        TextField::Any => Ok(Plan::any(vec![
            gloss(ask, comparison, false)?,
            other(ask, true, comparison)?,
            other(ask, false, comparison)?,
        ])),
    }
}

/// Returns the plan for a comparison of glosses; with `alone` it reports a gloss that no sign has.
fn gloss(ask: &Ask<'_>, comparison: &Comparison, alone: bool) -> Asked<Plan> {
    let values = comparison.values.iter();
    let plans = values.map(|value| match &value.wanted {
        Wanted::Present => Ok(Plan::everything()),
        Wanted::Missing(_) | Wanted::Features(_) | Wanted::Steps(_) => Ok(Plan::nothing()),
        Wanted::Named(pattern)
            if comparison.operator == Operator::Exactly || pattern.expression().is_some() =>
        {
            let exactly = comparison.operator == Operator::Exactly;
            let glob = if exactly {
                Glob::exact(pattern)
            } else {
                Glob::whole(pattern)
            };
            let signs = ask.signs()?;
            let is = |gloss: &str, folded: &str| match exactly {
                true => glob.matches(gloss),
                false => glob.fits(gloss, folded),
            };
            let found = signs.rows.iter();
            let found = found.filter(|(_, gloss, folded)| is(gloss, folded));
            let found: Vec<i64> = found.map(|(id, _, _)| *id).collect();
            if alone && found.is_empty() {
                nobody_has(ask, comparison, value)?;
            }
            Ok(Plan::Index(Probe::Rows(RowField::Sign, found)))
        }
        Wanted::Named(pattern) => {
            let glob = Glob::whole(pattern);
            let signs = ask.signs()?;
            if alone && !signs.rows.iter().any(|(.., folded)| glob.matches(folded)) {
                nobody_has(ask, comparison, value)?;
            }
            Ok(Plan::Index(whole_gloss(ask, pattern)?))
        }
    });
    let found = Plan::any(plans.collect::<Asked<_>>()?);
    Ok(match comparison.operator {
        Operator::IsNot => found.not(),
        _ => found,
    })
}

/// Reports that no sign has such a gloss, with similar ones.
fn nobody_has(ask: &Ask<'_>, comparison: &Comparison, value: &Value) -> Asked<()> {
    let Wanted::Named(pattern) = &value.wanted else {
        return Ok(());
    };
    let written = Comparison {
        operator: comparison.operator,
        values: vec![value.clone()],
    };
    let kind = FindingKind::CannotMatch {
        why: "no sign has such a gloss".to_owned(),
        names: glosses_like(ask, pattern)?,
    };
    ask.find(format!("gloss{written}"), value.at, kind);
    Ok(())
}

/// Returns the glosses that resemble the text of a pattern.
fn glosses_like(ask: &Ask<'_>, pattern: &Pattern) -> Asked<Vec<String>> {
    let text = match pattern.expression() {
        Some(expression) => expression.source().to_owned(),
        None => pattern.segments().concat(),
    };
    let text: String = text.chars().filter(|c| !"^$.*\\".contains(*c)).collect();
    let signs = ask.signs()?;
    let glosses = signs.rows.iter().map(|(_, gloss, _)| gloss.clone());
    Ok(findings::like(&text, &glosses.collect::<Vec<_>>()))
}

/// Returns glosses that resemble the only text of a test that finds nothing in glosses, or in any text.
pub(crate) fn alternatives(ask: &Ask<'_>, test: &Test) -> Asked<Vec<String>> {
    let pattern = match &test.what {
        What::Words(TextField::Any | TextField::Gloss, patterns) => match &patterns[..] {
            [pattern] => pattern,
            _ => return Ok(Vec::new()),
        },
        What::Whole(TextField::Any, comparison) => match &comparison.values[..] {
            [value] => match &value.wanted {
                Wanted::Named(pattern) => pattern,
                _ => return Ok(Vec::new()),
            },
            _ => return Ok(Vec::new()),
        },
        _ => return Ok(Vec::new()),
    };
    glosses_like(ask, pattern)
}

fn whole_gloss(ask: &Ask<'_>, pattern: &Pattern) -> Asked<Probe> {
    let terms = fitting(ask.now, Text::Gloss, &Glob::whole(pattern))?;
    Ok(Probe::Terms(Text::Gloss, terms))
}

fn other(ask: &Ask<'_>, translation: bool, comparison: &Comparison) -> Asked<Plan> {
    let (name, field) = if translation {
        ("translation", Text::Translation)
    } else {
        ("comment", Text::Comment)
    };
    let has = || Plan::Index(Probe::readings([TokenProperty::Has.term(name)]));
    match (comparison.operator, &comparison.values[..]) {
        (Operator::Is | Operator::Exactly, [value]) if value.wanted == Wanted::Present => {
            return Ok(has());
        }
        (Operator::Is | Operator::Exactly, [value])
            if value.wanted == Wanted::Missing(Missing::Unset) =>
        {
            return Ok(has().not());
        }
        _ => {}
    }
    Ok(Plan::Whole(Box::new(WholeText {
        translation,
        comparison: comparison.clone(),
        narrowed: narrowed(ask, field, comparison)?,
    })))
}

/// Returns a probe that matches at least every token with one of the wanted texts; nothing if they contain no words.
fn narrowed(ask: &Ask<'_>, field: Text, comparison: &Comparison) -> Asked<Option<Probe>> {
    if comparison.operator == Operator::IsNot {
        return Ok(None);
    }
    let mut plans = Vec::new();
    for value in &comparison.values {
        let literal = match &value.wanted {
            Wanted::Named(pattern) => pattern.as_literal().map(|_| pattern),
            _ => None,
        };
        let Some(pattern) = literal else {
            return Ok(None);
        };
        match phrase(ask, field, &Glob::words(pattern))? {
            Some(probe) => plans.push(Plan::Index(probe)),
            None => return Ok(None),
        }
    }
    Ok(Plan::any(plans).indexed().ok())
}

/// Returns the candidates whose texts match.
pub(crate) fn filter(ask: &Ask<'_>, text: &WholeText, candidates: Docs) -> Asked<Docs> {
    let ids = ask.now.rows(RowField::Token)?;
    let mut found = Docs::new();
    for doc in candidates {
        ask.look()?;
        let token = ids.get(doc).unwrap_or_default();
        let (translations, comments) = answers::texts_of_token(ask.connection, token)?;
        let texts = if text.translation {
            translations
        } else {
            comments
        };
        if texts_pass(&text.comparison, texts) {
            found.push(doc);
        }
    }
    Ok(found)
}

/// Returns whether one of the texts matches, or there is no text and the comparison accepts that.
fn texts_pass(comparison: &Comparison, texts: Vec<String>) -> bool {
    if texts.is_empty() {
        return comparison.accepts(&Reading::Unset, |_, _| false);
    }
    texts
        .into_iter()
        .any(|text| text_passes(comparison, &Reading::Value(text)))
}

/// Returns whether a single text matches.
pub(crate) fn text_passes(comparison: &Comparison, reading: &Reading) -> bool {
    comparison.accepts(reading, |text, wanted| match wanted {
        Wanted::Named(pattern) if comparison.operator == Operator::Exactly => {
            Glob::exact(pattern).matches(text)
        }
        Wanted::Named(pattern) => Glob::whole(pattern).fits(text, &fold(text)),
        _ => false,
    })
}

/// Returns the plan for words anywhere in a text, or a text up to slips.
pub(crate) fn words_plan(ask: &Ask<'_>, test: &Test) -> Asked<Plan> {
    let places = places(ask, test)?;
    Ok(Plan::any(places.into_iter().flatten().collect()))
}

/// Returns the plans for the places where a text may occur, most specific first: the whole gloss, words of the gloss,
/// translations, remarks.
pub(crate) fn places(ask: &Ask<'_>, test: &Test) -> Asked<Vec<Option<Plan>>> {
    match &test.what {
        What::Words(field, patterns) => {
            let mut places: [Vec<Plan>; 4] = Default::default();
            for pattern in patterns {
                let globs = Glob::words(pattern);
                if in_gloss(*field) {
                    places[0].push(Plan::Index(whole_gloss(ask, pattern)?));
                }
                for (place, field) in fields_of(*field) {
                    places[place].extend(phrase(ask, field, &globs)?.map(Plan::Index));
                }
            }
            let some = |plans: Vec<Plan>| (!plans.is_empty()).then(|| Plan::any(plans));
            Ok(places.into_iter().map(some).collect())
        }
        What::Fuzzy { field, text, slips } => fuzzy(test, *field, text, *slips),
        _ => Ok(Vec::new()),
    }
}

fn in_gloss(field: TextField) -> bool {
    matches!(field, TextField::Any | TextField::Gloss)
}

/// Returns the word fields in which a text is searched, with their places.
fn fields_of(field: TextField) -> Vec<(usize, Text)> {
    let all = [
        (1, TextField::Gloss, Text::Words),
        (2, TextField::Translation, Text::Translation),
        (3, TextField::Comment, Text::Comment),
    ];
    let wanted = all
        .into_iter()
        .filter(|(_, own, _)| field == TextField::Any || field == *own);
    wanted.map(|(place, _, field)| (place, field)).collect()
}

/// Returns the probe for adjacent words; `None` if there is no word.
fn phrase(ask: &Ask<'_>, field: Text, globs: &[Glob]) -> Asked<Option<Probe>> {
    let literals: Option<Vec<&str>> = globs.iter().map(Glob::literal).collect();
    Ok(match (globs, literals) {
        ([], _) => None,
        ([one], _) => Some(Probe::Terms(field, fitting(ask.now, field, one)?)),
        (_, Some(words)) => {
            let words = words.into_iter().map(str::to_owned).collect();
            Some(Probe::Phrase(field, words))
        }
        (several, None) => {
            let words = several.iter().map(Glob::regex).collect();
            Some(Probe::Patterns(field, words))
        }
    })
}

fn fuzzy(test: &Test, field: TextField, text: &str, slips: u8) -> Asked<Vec<Option<Plan>>> {
    let words = words(text);
    let whole = fold(text);
    if whole.chars().count() > LONGEST_FUZZY {
        return Err(QueryError {
            at: test.at.range(),
            message: "this is too long for a comparison that tolerates slips".to_owned(),
            remedy: format!("write at most {LONGEST_FUZZY} characters").into(),
            suggestion: None,
        }
        .into());
    }
    let near = |field: Text, word: &str| Plan::Index(Probe::Near(field, word.to_owned(), slips));
    let mut places: Vec<Option<Plan>> = vec![None, None, None, None];
    if in_gloss(field) {
        places[0] = Some(near(Text::Gloss, &whole));
    }
    for (place, field) in fields_of(field) {
        let all = words.iter().map(|word| near(field, word)).collect();
        places[place] = (!words.is_empty()).then(|| Plan::all(all));
    }
    Ok(places)
}
