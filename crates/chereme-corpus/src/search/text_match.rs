//! Comparisons of texts: glosses, translations and remarks.

use chereme_sign::ComponentReading;
use chereme_sign::query::{
    ComparisonOperator, MissingReason, QueryError, QueryTest, QueryValue, TestSubject, TextField, TextPattern,
    ValueComparison, WantedValue,
};
use chereme_sign::text::fold_text;

use super::compile::{QueryContext, QueryResult};
use super::docs::DocumentList;
use super::probe::{IndexProbe, IndexTextField, RowField};
use super::search_finding::{FindingKind, quote_finding_name};
use super::search_findings;
use super::search_known::terms_matching_glob;
use super::search_plan::{QueryPlan, WholeText};
use super::search_texts::{TextGlob, split_folded_words};
use crate::db::stored_search::search_answers::{self, NamedRowKind};
use crate::db::stored_search::search_terms::TokenProperty;

/// The longest word that is compared up to slips: the automaton grows with its length.
const LONGEST_FUZZY: usize = 64;

/// Returns the plan for a comparison of whole texts; if a token has several, one match suffices.
pub(crate) fn plan_text_comparison(
    ask: &QueryContext<'_>,
    field: TextField,
    comparison: &ValueComparison,
) -> QueryResult<QueryPlan> {
    match field {
        TextField::Gloss => plan_gloss_comparison(ask, comparison, true),
        TextField::Translation | TextField::Comment => {
            plan_translation_or_comment(ask, field == TextField::Translation, comparison)
        }
        TextField::Any => Ok(QueryPlan::disjoin_plans(vec![
            plan_gloss_comparison(ask, comparison, false)?,
            plan_translation_or_comment(ask, true, comparison)?,
            plan_translation_or_comment(ask, false, comparison)?,
        ])),
    }
}

/// Returns the plan for a comparison of glosses; with `alone` it reports a gloss that no sign has.
fn plan_gloss_comparison(ask: &QueryContext<'_>, comparison: &ValueComparison, alone: bool) -> QueryResult<QueryPlan> {
    let values = comparison.values.iter();
    let plans = values.map(|value| match &value.wanted {
        WantedValue::Present => Ok(QueryPlan::select_all_plan()),
        WantedValue::Missing(_) | WantedValue::Features(_) | WantedValue::Steps(_) => Ok(QueryPlan::select_none_plan()),
        WantedValue::Named(pattern)
            if comparison.operator == ComparisonOperator::Exactly || pattern.regular_expression().is_some() =>
        {
            let exactly = comparison.operator == ComparisonOperator::Exactly;
            let glob = if exactly {
                TextGlob::from_exact_pattern(pattern)
            } else {
                TextGlob::from_whole_pattern(pattern)
            };
            let signs = ask.known_signs()?;
            let is = |gloss: &str, folded: &str| match exactly {
                true => glob.matches_whole_text(gloss),
                false => glob.fits_either_text(gloss, folded),
            };
            let sign_rows = signs.rows.iter();
            let matching_rows = sign_rows.filter(|(_, gloss, folded)| is(gloss, folded));
            let ids: Vec<i64> = matching_rows.map(|(id, _, _)| *id).collect();
            if alone && ids.is_empty() {
                nobody_has(ask, comparison, value)?;
            }
            Ok(QueryPlan::Index(IndexProbe::Rows(RowField::Sign, ids)))
        }
        WantedValue::Named(pattern) => {
            let glob = TextGlob::from_whole_pattern(pattern);
            let signs = ask.known_signs()?;
            if alone && !signs.rows.iter().any(|(.., folded)| glob.matches_whole_text(folded)) {
                nobody_has(ask, comparison, value)?;
            }
            Ok(QueryPlan::Index(whole_gloss(ask, pattern)?))
        }
    });
    let any_plan = QueryPlan::disjoin_plans(plans.collect::<QueryResult<_>>()?);
    Ok(match comparison.operator {
        ComparisonOperator::IsNot => any_plan.negate_plan(),
        _ => any_plan,
    })
}

/// Reports that no sign has such a gloss, with similar ones.
fn nobody_has(ask: &QueryContext<'_>, comparison: &ValueComparison, value: &QueryValue) -> QueryResult<()> {
    let WantedValue::Named(pattern) = &value.wanted else {
        return Ok(());
    };
    let written = ValueComparison {
        operator: comparison.operator,
        values: vec![value.clone()],
    };
    let kind = FindingKind::CannotMatch {
        why: "no sign has such a gloss".to_owned(),
        names: glosses_like(ask, pattern)?,
    };
    ask.add_query_finding(format!("gloss{written}"), value.at, kind);
    Ok(())
}

/// Returns the glosses that resemble the text of a pattern.
fn glosses_like(ask: &QueryContext<'_>, pattern: &TextPattern) -> QueryResult<Vec<String>> {
    let pattern_text = match pattern.regular_expression() {
        Some(expression) => expression.expression_source().to_owned(),
        None => pattern.pattern_segments().concat(),
    };
    // Letters of expressions and wildcards would keep every gloss from being near.
    let text: String = pattern_text.chars().filter(|c| !"^$.*\\".contains(*c)).collect();
    let signs = ask.known_signs()?;
    let glosses = signs.rows.iter().map(|(_, gloss, _)| gloss.clone());
    let mut names = search_findings::similar_names(&text, &glosses.collect::<Vec<_>>());
    // BANK#2 and ASL/BANK name one of the signs whose gloss is BANK.
    let labels = search_answers::list_row_names(ask.connection, NamedRowKind::LexiconEntry)?;
    let is_label = |label: &String| fold_text(label) == fold_text(&text) && !names.contains(label);
    if let Some((_, label)) = labels.iter().find(|(_, label)| is_label(label)) {
        names.insert(0, format!("sign={}", quote_finding_name(label)));
    }
    Ok(names)
}

/// Returns glosses that resemble the only text of a test that finds nothing in glosses, or in any text.
pub(crate) fn alternative_glosses(ask: &QueryContext<'_>, test: &QueryTest) -> QueryResult<Vec<String>> {
    let pattern = match &test.what {
        TestSubject::Words(TextField::Any | TextField::Gloss, patterns) => match &patterns[..] {
            [pattern] => pattern,
            _ => return Ok(Vec::new()),
        },
        TestSubject::Whole(TextField::Any, comparison) => match &comparison.values[..] {
            [value] => match &value.wanted {
                WantedValue::Named(pattern) => pattern,
                _ => return Ok(Vec::new()),
            },
            _ => return Ok(Vec::new()),
        },
        _ => return Ok(Vec::new()),
    };
    glosses_like(ask, pattern)
}

fn whole_gloss(ask: &QueryContext<'_>, pattern: &TextPattern) -> QueryResult<IndexProbe> {
    let terms = terms_matching_glob(ask.now, IndexTextField::Gloss, &TextGlob::from_whole_pattern(pattern))?;
    Ok(IndexProbe::Terms(IndexTextField::Gloss, terms))
}

fn plan_translation_or_comment(
    ask: &QueryContext<'_>,
    translation: bool,
    comparison: &ValueComparison,
) -> QueryResult<QueryPlan> {
    let (name, field) = if translation {
        ("translation", IndexTextField::Translation)
    } else {
        ("comment", IndexTextField::Comment)
    };
    let has = || {
        QueryPlan::Index(IndexProbe::from_reading_terms([
            TokenProperty::Has.property_value_term(name)
        ]))
    };
    match (comparison.operator, &comparison.values[..]) {
        (ComparisonOperator::Is | ComparisonOperator::Exactly, [value]) if value.wanted == WantedValue::Present => {
            return Ok(has());
        }
        (ComparisonOperator::Is | ComparisonOperator::Exactly, [value])
            if value.wanted == WantedValue::Missing(MissingReason::Unset) =>
        {
            return Ok(has().negate_plan());
        }
        _ => {}
    }
    Ok(QueryPlan::Whole(Box::new(WholeText {
        translation,
        comparison: comparison.clone(),
        narrowed: narrowed(ask, field, comparison)?,
    })))
}

/// Returns a probe that matches at least every token with one of the wanted texts; nothing if they contain no words.
fn narrowed(
    ask: &QueryContext<'_>,
    field: IndexTextField,
    comparison: &ValueComparison,
) -> QueryResult<Option<IndexProbe>> {
    // Whatever words a text lacks, it may still be another text: nothing narrows the search.
    if comparison.operator == ComparisonOperator::IsNot {
        return Ok(None);
    }
    let mut plans = Vec::new();
    for value in &comparison.values {
        let literal = match &value.wanted {
            WantedValue::Named(pattern) => pattern.as_literal().map(|_| pattern),
            _ => None,
        };
        let Some(pattern) = literal else {
            return Ok(None);
        };
        match phrase(ask, field, &TextGlob::word_globs(pattern))? {
            Some(probe) => plans.push(QueryPlan::Index(probe)),
            None => return Ok(None),
        }
    }
    Ok(QueryPlan::disjoin_plans(plans).indexed_probe().ok())
}

/// Returns the candidates whose texts match.
pub(crate) fn filter_whole_texts(
    ask: &QueryContext<'_>,
    text: &WholeText,
    candidates: DocumentList,
) -> QueryResult<DocumentList> {
    let ids = ask.now.open_row_column(RowField::Token)?;
    let mut passing = DocumentList::new();
    for doc in candidates {
        ask.count_examined_row()?;
        let token = ids.document_number(doc).unwrap_or_default();
        let (translations, comments) = search_answers::texts_of_token(ask.connection, token)?;
        let texts = if text.translation { translations } else { comments };
        if texts_pass(&text.comparison, texts) {
            passing.push(doc);
        }
    }
    Ok(passing)
}

/// Returns whether one of the texts matches, or there is no text and the comparison accepts that.
fn texts_pass(comparison: &ValueComparison, texts: Vec<String>) -> bool {
    if texts.is_empty() {
        return comparison.comparison_accepts_reading(&ComponentReading::Unset, |_, _| false);
    }
    texts
        .into_iter()
        .any(|text| text_passes(comparison, &ComponentReading::Value(text)))
}

/// Returns whether a single text matches.
pub(crate) fn text_passes(comparison: &ValueComparison, reading: &ComponentReading) -> bool {
    comparison.comparison_accepts_reading(reading, |text, wanted| match wanted {
        WantedValue::Named(pattern) if comparison.operator == ComparisonOperator::Exactly => {
            TextGlob::from_exact_pattern(pattern).matches_whole_text(text)
        }
        WantedValue::Named(pattern) => TextGlob::from_whole_pattern(pattern).fits_either_text(text, &fold_text(text)),
        _ => false,
    })
}

/// Returns the plan for words anywhere in a text, or a text up to slips.
pub(crate) fn words_plan(ask: &QueryContext<'_>, test: &QueryTest) -> QueryResult<QueryPlan> {
    let places = plan_text_places(ask, test)?;
    Ok(QueryPlan::disjoin_plans(places.into_iter().flatten().collect()))
}

/// Returns the plans for the places where a text may occur, most specific first: the whole gloss, words of the gloss,
/// translations, remarks.
pub(crate) fn plan_text_places(ask: &QueryContext<'_>, test: &QueryTest) -> QueryResult<Vec<Option<QueryPlan>>> {
    match &test.what {
        TestSubject::Words(field, patterns) => {
            let mut places: [Vec<QueryPlan>; 4] = Default::default();
            for pattern in patterns {
                let globs = TextGlob::word_globs(pattern);
                if in_gloss(*field) {
                    places[0].push(QueryPlan::Index(whole_gloss(ask, pattern)?));
                }
                for (place, field) in fields_of(*field) {
                    places[place].extend(phrase(ask, field, &globs)?.map(QueryPlan::Index));
                }
            }
            let some = |plans: Vec<QueryPlan>| (!plans.is_empty()).then(|| QueryPlan::disjoin_plans(plans));
            Ok(places.into_iter().map(some).collect())
        }
        TestSubject::Fuzzy { field, text, slips } => plan_fuzzy_text(test, *field, text, *slips),
        _ => Ok(Vec::new()),
    }
}

fn in_gloss(field: TextField) -> bool {
    matches!(field, TextField::Any | TextField::Gloss)
}

/// Returns the word fields in which a text is searched, with their places.
fn fields_of(field: TextField) -> Vec<(usize, IndexTextField)> {
    let all = [
        (1, TextField::Gloss, IndexTextField::Words),
        (2, TextField::Translation, IndexTextField::Translation),
        (3, TextField::Comment, IndexTextField::Comment),
    ];
    let wanted = all
        .into_iter()
        .filter(|(_, own, _)| field == TextField::Any || field == *own);
    wanted.map(|(place, _, field)| (place, field)).collect()
}

/// Returns the probe for adjacent words; `None` if there is no word.
fn phrase(ask: &QueryContext<'_>, field: IndexTextField, globs: &[TextGlob]) -> QueryResult<Option<IndexProbe>> {
    let literals: Option<Vec<&str>> = globs.iter().map(TextGlob::literal_text).collect();
    Ok(match (globs, literals) {
        ([], _) => None,
        ([one], _) => Some(IndexProbe::Terms(field, terms_matching_glob(ask.now, field, one)?)),
        (_, Some(words)) => {
            let words = words.into_iter().map(str::to_owned).collect();
            Some(IndexProbe::Phrase(field, words))
        }
        (several, None) => {
            let words = several.iter().map(TextGlob::glob_regex).collect();
            Some(IndexProbe::Patterns(field, words))
        }
    })
}

fn plan_fuzzy_text(test: &QueryTest, field: TextField, text: &str, slips: u8) -> QueryResult<Vec<Option<QueryPlan>>> {
    let words = split_folded_words(text);
    let folded = fold_text(text);
    if folded.chars().count() > LONGEST_FUZZY {
        return Err(QueryError {
            at: test.at.char_range(),
            message: "this is too long for a comparison that tolerates slips".to_owned(),
            remedy: format!("write at most {LONGEST_FUZZY} characters").into(),
            suggestion: None,
        }
        .into());
    }
    let near = |field: IndexTextField, word: &str| QueryPlan::Index(IndexProbe::Near(field, word.to_owned(), slips));
    let mut places: Vec<Option<QueryPlan>> = vec![None, None, None, None];
    if in_gloss(field) {
        places[0] = Some(near(IndexTextField::Gloss, &folded));
    }
    for (place, field) in fields_of(field) {
        // Each word may be elsewhere in the text, as slips may also exchange words.
        let all = words.iter().map(|word| near(field, word)).collect();
        places[place] = (!words.is_empty()).then(|| QueryPlan::conjoin_plans(all));
    }
    Ok(places)
}
