//! Reading a query: terms, joints, relations and examples. The module `compare` reads comparisons.

use super::query_lex::{QueryCursor, QueryWord, WordContext, is_quote};
use super::query_tree::{
    ExampleToken, LikeSearch, QueryExpression, QueryPlace, QueryTest, RelatedAnnotation, TestSubject, TextField,
    TokenQuery, WantedValue, WeightedComponent,
};
use super::query_words::{self, JoiningWord};
use super::{MAX_CHARS, MAX_QUERY_DEPTH, NamedSearch, QueryError, query_attributes, query_compare, query_times};
use crate::relation::TimeRelation;
use crate::text::nearest_candidate;

/// Reads a whole query.
pub(super) fn parse_whole_query(text: &str) -> Result<TokenQuery, QueryError> {
    let chars: Vec<char> = text.chars().take(MAX_CHARS + 1).collect();
    if chars.len() > MAX_CHARS {
        let limit_at = QueryPlace {
            start: MAX_CHARS,
            end: MAX_CHARS + 1,
        };
        let message = format!("the query is longer than {MAX_CHARS} characters");
        return Err(QueryError::new(limit_at, message, "ask in several steps"));
    }
    let mut cursor = QueryCursor::new(&chars);
    cursor.skip_blanks();
    if cursor.peek_char().is_none() {
        return Ok(TokenQuery {
            root: QueryExpression::And(Vec::new()),
        });
    }
    let root = parse_alternatives(&mut cursor, 0)?;
    match cursor.peek_char() {
        None => Ok(TokenQuery { root }),
        Some(_) => Err(QueryError::new(
            cursor.next(1),
            "this parenthesis closes none",
            "leave it out, or open one before it",
        )),
    }
}

/// Reads terms joined by `or`, up to the end or a closing parenthesis.
fn parse_alternatives(cursor: &mut QueryCursor<'_>, depth: usize) -> Result<QueryExpression, QueryError> {
    let mut branches = vec![parse_term_sequence(cursor, depth)?];
    while step_over(cursor, JoiningWord::Or) {
        branches.push(parse_term_sequence(cursor, depth)?);
    }
    Ok(QueryExpression::any_of_terms(branches))
}

/// Reads terms side by side, up to the end, a closing parenthesis or `or`.
fn parse_term_sequence(cursor: &mut QueryCursor<'_>, depth: usize) -> Result<QueryExpression, QueryError> {
    let mut conjuncts = Vec::new();
    loop {
        cursor.skip_blanks();
        let joint = next_joint(cursor);
        let ended = matches!(cursor.peek_char(), None | Some(')')) || joint.is_some_and(|(j, _)| j == JoiningWord::Or);
        if ended && !conjuncts.is_empty() {
            return Ok(QueryExpression::all_of_terms(conjuncts));
        }
        if ended {
            return Err(missing_term(cursor));
        }
        if let Some((JoiningWord::And, at)) = joint {
            if conjuncts.is_empty() {
                return Err(missing_term(cursor));
            }
            cursor.pos = at.end;
            cursor.skip_blanks();
            let another = next_joint(cursor).is_some_and(|(j, _)| j != JoiningWord::Not);
            if another || matches!(cursor.peek_char(), None | Some(')')) {
                return Err(missing_term(cursor));
            }
        }
        conjuncts.push(parse_query_term(cursor, depth)?);
    }
}

fn missing_term(cursor: &QueryCursor<'_>) -> QueryError {
    let (at, message) = match (next_joint(cursor), cursor.peek_char()) {
        (Some((_, at)), _) => (
            at,
            format!("`{}` has nothing to join here", cursor.text_at_place(at).to_lowercase()),
        ),
        (None, None) => (cursor.next(0), "the query ends where a term should stand".to_owned()),
        (None, Some(_)) => (cursor.next(1), "a term should stand before this parenthesis".to_owned()),
    };
    let remedy = match next_joint(cursor) {
        Some((_, at)) => {
            let word = cursor.text_at_place(at);
            format!("write a comparison beside it; to search for the word itself, write \"{word}\"")
        }
        None => "write a comparison such as placement=chin, or a word".to_owned(),
    };
    QueryError::new(at, message, remedy)
}

/// Returns the next joint, without stepping over it; `None` if the word names a field.
pub(super) fn next_joint(cursor: &QueryCursor<'_>) -> Option<(JoiningWord, QueryPlace)> {
    let mut ahead = cursor.clone();
    let word_at = ahead.skip_bare_word(WordContext::Term);
    // Only words of three characters or fewer can be joints.
    let joint = (word_at.end - word_at.start <= 3)
        .then(|| query_words::find_joining_word(&ahead.text_at_place(word_at)))
        .flatten()?;
    ahead.peek_operator().is_none().then_some((joint, word_at))
}

fn step_over(cursor: &mut QueryCursor<'_>, joint: JoiningWord) -> bool {
    match next_joint(cursor) {
        Some((found, at)) if found == joint => {
            cursor.pos = at.end;
            true
        }
        _ => false,
    }
}

/// Reads one term.
fn parse_query_term(cursor: &mut QueryCursor<'_>, depth: usize) -> Result<QueryExpression, QueryError> {
    if depth >= MAX_QUERY_DEPTH {
        let message = format!("more than {MAX_QUERY_DEPTH} parentheses and negations inside each other");
        return Err(QueryError::new(cursor.next(1), message, "take some of them out"));
    }
    if step_over(cursor, JoiningWord::Not) {
        cursor.skip_blanks();
        let joint = next_joint(cursor).is_some_and(|(joint, _)| joint != JoiningWord::Not);
        if joint || matches!(cursor.peek_char(), None | Some(')')) {
            return Err(missing_term(cursor));
        }
        return Ok(QueryExpression::Not(Box::new(parse_query_term(cursor, depth + 1)?)));
    }
    match cursor.peek_char() {
        Some('(') => parse_term_group(cursor, depth),
        Some('[') => Err(QueryError::new(
            cursor.next(1),
            "features need a field before them",
            "a list of features is a value: configuration=[index -thumb]",
        )
        .with_suggestion(Some("configuration=["))),
        Some(',') => Err(QueryError::new(
            cursor.next(1),
            "a comma stands only between the values of one field",
            "terms side by side must all hold; `or` between them means that one is enough",
        )),
        Some(c) if is_quote(c) => quoted_text(cursor),
        _ if cursor.peek_operator().is_some() => Err(query_compare::stray_operator(cursor)),
        _ => worded(cursor),
    }
}

fn parse_term_group(cursor: &mut QueryCursor<'_>, depth: usize) -> Result<QueryExpression, QueryError> {
    let open = cursor.next(1);
    cursor.pos = open.end;
    let inner = parse_alternatives(cursor, depth + 1).map_err(|error| {
        if cursor.peek_char().is_none() && error.at.is_empty() {
            unclosed_group_error(open)
        } else {
            error
        }
    })?;
    if cursor.eat_char(')') {
        Ok(inner)
    } else {
        Err(unclosed_group_error(open))
    }
}

fn unclosed_group_error(at: QueryPlace) -> QueryError {
    QueryError::new(at, "this parenthesis is not closed", "write ) where the group ends")
}

fn quoted_text(cursor: &mut QueryCursor<'_>) -> Result<QueryExpression, QueryError> {
    let word = cursor.read_query_word(WordContext::Term)?;
    cursor.check_word_boundary()?;
    free_text(word)
}

/// Reads a term that begins with a word.
fn worded(cursor: &mut QueryCursor<'_>) -> Result<QueryExpression, QueryError> {
    let start = cursor.clone();
    let word = cursor.read_query_word(WordContext::Term)?;
    let name = cursor.text_at_place(word.at);
    if let Some(saved) = name.strip_prefix('@')
        && !operator_follows(cursor)
    {
        return saved_search(cursor, word.at, saved);
    }
    if name == query_words::TIER_WORD && is_opening_parenthesis(cursor) {
        return Ok(QueryExpression::Test(query_compare::tier_test(cursor, word.at)?));
    }
    if query_attributes::opens_name(&name) && is_opening_parenthesis(cursor) {
        return Ok(QueryExpression::Test(query_attributes::in_parentheses(
            cursor, word.at,
        )?));
    }
    if operator_follows(cursor) {
        *cursor = start;
        return Ok(QueryExpression::Test(query_compare::parse_field_test(cursor)?));
    }
    if let Some(relation) = query_words::plain_relation(&name) {
        return parse_related_test(cursor, word.at, relation);
    }
    if let Some(relation) = query_words::french_relation(&name)
        && comparison_follows(cursor)
    {
        return parse_related_test(cursor, word.at, relation);
    }
    match &name[..] {
        query_words::FRENCH_LIKE if example_follows(cursor) => parse_like_search(cursor, word.at),
        query_words::WITHIN_WORD => {
            let relation = parse_within_relation(cursor, word.at)?;
            parse_related_test(cursor, word.at, relation)
        }
        query_words::LIKE_WORD => parse_like_search(cursor, word.at),
        _ => {
            if cursor.peek_char().is_some_and(is_quote) {
                cursor.check_word_boundary()?;
            }
            if let Some(relation) = query_words::near_relation(&name)
                && comparison_follows(cursor)
            {
                let message = format!("there is no relation {name:?}");
                let remedy = format!("to search for the word, write it in quotes: \"{name}\"");
                return Err(QueryError::new(word.at, message, remedy).with_suggestion(Some(relation)));
            }
            free_text(word)
        }
    }
}

/// Reads the rest of a saved search's name; `name` is its start, at `at` after the `@`.
fn saved_search(cursor: &mut QueryCursor<'_>, at: QueryPlace, name: &str) -> Result<QueryExpression, QueryError> {
    let (mut name, mut at) = (name.to_owned(), at);
    if name.is_empty() && cursor.peek_char().is_some_and(is_quote) {
        let word = cursor.read_query_word(WordContext::Value)?;
        name = word.pattern.pattern_segments().join("*");
        at = at.extend_place_to(word.at);
    }
    if name.trim().is_empty() {
        let remedy = "write @ and the name of a saved search, with blanks: @\"my search\"";
        return Err(QueryError::new(at, "which saved search?", remedy));
    }
    cursor.check_word_boundary()?;
    Ok(QueryExpression::Saved(NamedSearch { at, name }))
}

/// Returns whether the address of a token or sign is next, after blanks.
fn example_follows(cursor: &QueryCursor<'_>) -> bool {
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    let word_at = ahead.skip_bare_word(WordContext::Value);
    let word = ahead.text_at_place(word_at);
    word.starts_with("token:") || word.starts_with("sign:")
}

/// Returns whether an opening parenthesis is next, after blanks.
fn is_opening_parenthesis(cursor: &QueryCursor<'_>) -> bool {
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    ahead.peek_char() == Some('(')
}

fn operator_follows(cursor: &QueryCursor<'_>) -> bool {
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    ahead.peek_operator().is_some()
}

fn comparison_follows(cursor: &QueryCursor<'_>) -> bool {
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    let word_at = ahead.skip_bare_word(WordContext::Term);
    operator_follows(&ahead) || ahead.text_at_place(word_at) == query_words::TIER_WORD && is_opening_parenthesis(&ahead)
}

fn free_text(word: QueryWord) -> Result<QueryExpression, QueryError> {
    let word_at = word.at;
    query_compare::check_term(&word.pattern, word_at)?;
    let what = TestSubject::Words(TextField::Any, vec![word.pattern]);
    Ok(QueryExpression::Test(QueryTest {
        at: word_at,
        subject_at: word_at,
        what,
    }))
}

/// Reads the distance and the kind of relation after `within`.
fn parse_within_relation(cursor: &mut QueryCursor<'_>, at: QueryPlace) -> Result<TimeRelation, QueryError> {
    const WITHIN_REMEDY: &str = "write within 0.5s around, within 0.5s of-begin or within 0.5s of-end";
    cursor.skip_blanks();
    if matches!(cursor.peek_char(), None | Some(')')) {
        return Err(QueryError::new(at, "`within` needs a distance", WITHIN_REMEDY));
    }
    let distance = query_times::parse_unit_time(cursor)?;
    cursor.skip_blanks();
    let mut kind_at = cursor.skip_bare_word(WordContext::Term);
    let mut kind = cursor.text_at_place(kind_at);
    if kind == "of" {
        cursor.skip_blanks();
        kind_at = kind_at.extend_place_to(cursor.skip_bare_word(WordContext::Term));
        kind = cursor
            .text_at_place(kind_at)
            .split_whitespace()
            .collect::<Vec<_>>()
            .join("-");
    }
    match &kind[..] {
        "around" => Ok(TimeRelation::Around(distance)),
        "of-begin" | "of-start" => Ok(TimeRelation::OfBegin(distance)),
        "of-end" => Ok(TimeRelation::OfEnd(distance)),
        _ => {
            let message = format!("{kind:?} does not say what the distance is counted from");
            Err(QueryError::new(kind_at, message, WITHIN_REMEDY)
                .with_suggestion(nearest_candidate(&kind, query_words::WITHIN_KINDS)))
        }
    }
}

/// Reads the right side of a relation whose name is at `at`.
fn parse_related_test(
    cursor: &mut QueryCursor<'_>,
    at: QueryPlace,
    relation: TimeRelation,
) -> Result<QueryExpression, QueryError> {
    const RELATED_REMEDY: &str =
        r#"write a component, a gloss or a tier, such as nonmanual.brows=raised, gloss=CHAT or tier("Mouthing")=*"#;
    cursor.skip_blanks();
    let start = cursor.pos;
    if !comparison_follows(cursor) {
        let name = cursor.text_at_place(at);
        let message = format!("`{name}` needs a comparison on its right");
        let remedy = format!("{RELATED_REMEDY}; to search for the word, write it in quotes: \"{name}\"");
        let word_at = cursor.skip_bare_word(WordContext::Term);
        let word = cursor.text_at_place(word_at);
        // A bare word after a relation most often is the gloss of the other sign.
        let searched = !word.is_empty() && !query_words::is_reserved(&word);
        let gloss = searched.then(|| format!("gloss={word}"));
        return Err(QueryError::new(word_at, message, remedy).with_suggestion(gloss));
    }
    let word = cursor.skip_bare_word(WordContext::Term);
    let other = if cursor.text_at_place(word) == query_words::TIER_WORD && is_opening_parenthesis(cursor) {
        query_compare::tier_test(cursor, word)?
    } else {
        cursor.pos = start;
        query_compare::parse_field_test(cursor)?
    };
    if let TestSubject::Component(_, comparison) = &other.what {
        let steps = |wanted: &WantedValue| matches!(wanted, WantedValue::Steps(_));
        if let Some(value) = comparison.values.iter().find(|value| steps(&value.wanted)) {
            let message = "successive values belong to one token, not to an annotation beside it";
            let remedy = "ask them of the token itself: placement=head > chest";
            return Err(QueryError::new(value.at, message, remedy));
        }
    }
    if matches!(
        other.what,
        TestSubject::Said(..)
            | TestSubject::Property(..)
            | TestSubject::Time(..)
            | TestSubject::Attribute(..)
            | TestSubject::Curve(..)
            | TestSubject::Notation(..)
    ) {
        return Err(QueryError::new(
            other.subject_at,
            "this is no annotation that could stand in a relation of time",
            RELATED_REMEDY,
        ));
    }
    Ok(QueryExpression::Relation(RelatedAnnotation {
        at: at.extend_place_to(other.at),
        relation,
        other,
    }))
}

/// Reads the example and the components after `like`, which is at `at`.
fn parse_like_search(cursor: &mut QueryCursor<'_>, at: QueryPlace) -> Result<QueryExpression, QueryError> {
    const LIKE_REMEDY: &str =
        "write like token:41 or like CHAT, and then, if not all components count, on configuration, placement";
    cursor.skip_blanks();
    let word = cursor.read_query_word(WordContext::Value)?;
    if word.at.start == word.at.end || cursor.text_at_place(word.at) == query_words::ON_WORD {
        let remedy = format!("{LIKE_REMEDY}; to search for the word, write it in quotes: \"like\"");
        return Err(QueryError::new(word.at, "`like` needs an example", remedy));
    }
    let (example, example_at) = parse_like_example(cursor, word, LIKE_REMEDY)?;
    cursor.check_word_boundary()?;
    let mut like = LikeSearch {
        at: at.extend_place_to(example_at),
        example_at,
        example,
        on: Vec::new(),
        above: None,
    };
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    let joint_at = ahead.skip_bare_word(WordContext::Term);
    let joint = ahead.text_at_place(joint_at);
    let on = [query_words::ON_WORD, query_words::FRENCH_ON].contains(&&joint[..]);
    // Before an operator the word is a field, and no part of the example.
    if on && !operator_follows(&ahead) {
        *cursor = ahead;
        like.on = weighted_fields(cursor)?;
        like.at.end = cursor.pos;
    } else if query_words::INSTEAD_OF_ON.contains(&&joint[..]) && !operator_follows(&ahead) {
        let message = format!("{joint:?} does not follow an example");
        let remedy = format!("{LIKE_REMEDY}; to search for the word, write it in quotes: \"{joint}\"");
        return Err(QueryError::new(joint_at, message, remedy).with_suggestion(Some(query_words::ON_WORD)));
    }
    if let Some(least) = threshold(cursor)? {
        like.above = Some(least);
        like.at.end = cursor.pos;
    }
    Ok(QueryExpression::Like(like))
}

/// Reads `above 0.6` or `above 60%`, if it is next.
fn threshold(cursor: &mut QueryCursor<'_>) -> Result<Option<f64>, QueryError> {
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    let word = ahead.skip_bare_word(WordContext::Term);
    if ahead.text_at_place(word) != query_words::ABOVE_WORD || operator_follows(&ahead) {
        return Ok(None);
    }
    ahead.skip_blanks();
    let number_at = ahead.skip_bare_word(WordContext::Value);
    let text = ahead.text_at_place(number_at);
    let least = match text.strip_suffix('%') {
        Some(hundredths) => hundredths.parse::<f64>().map(|number| number / 100.0),
        None => text.parse::<f64>(),
    };
    *cursor = ahead;
    match least {
        Ok(least) if (0.0..1.0).contains(&least) => Ok(Some(least)),
        _ => {
            let remedy = "likeness goes from 0 to 1: write above 0.6, or above 60%";
            let message = format!("{text:?} is no likeness");
            Err(QueryError::new(number_at, message, remedy))
        }
    }
}

/// Reads the address that a word after `like` is or begins with.
fn parse_like_example(
    cursor: &mut QueryCursor<'_>,
    word: QueryWord,
    remedy: &str,
) -> Result<(ExampleToken, QueryPlace), QueryError> {
    let written = word.pattern.as_literal().map(str::to_owned);
    let Some(text) = written.filter(|text| !text.trim().is_empty()) else {
        return Err(QueryError::new(word.at, "an example is one token or one sign", remedy));
    };
    let (kind, name) = text.split_once(':').filter(|_| !word.quoted).unwrap_or(("", &text));
    if !matches!(kind, "token" | "sign") {
        // Glosses in capitals may hold a colon; only words in small letters look like a kind of address.
        let nearest_kind = nearest_candidate(kind, ["token", "sign"]).filter(|_| kind.chars().any(char::is_lowercase));
        if nearest_kind.is_some() || kind == "recording" || kind == "signer" {
            let kind_at = QueryPlace {
                start: word.at.start,
                end: word.at.start + kind.chars().count(),
            };
            let message = format!("{kind:?} is no example");
            return Err(QueryError::new(kind_at, message, remedy).with_suggestion(nearest_kind));
        }
        return Ok((ExampleToken::Sign(text), word.at));
    }
    let (mut name, mut at) = (name.to_owned(), word.at);
    if name.is_empty() && cursor.peek_char().is_some_and(is_quote) {
        let rest = cursor.read_query_word(WordContext::Value)?;
        at = at.extend_place_to(rest.at);
        name = rest.pattern.as_literal().unwrap_or_default().to_owned();
    }
    if name.trim().is_empty() {
        return Err(QueryError::new(at, format!("which {kind}?"), remedy));
    }
    Ok((
        if kind == "token" {
            ExampleToken::Token(name)
        } else {
            ExampleToken::Sign(name)
        },
        at,
    ))
}

/// Reads the components after `on`, with their weights.
fn weighted_fields(cursor: &mut QueryCursor<'_>) -> Result<Vec<WeightedComponent>, QueryError> {
    let mut fields = Vec::new();
    loop {
        cursor.skip_blanks();
        let field_at = cursor.skip_bare_word(WordContext::Term);
        if field_at.start == field_at.end {
            return Err(QueryError::new(
                cursor.next(0),
                "a component should stand here",
                "write for example on configuration:2, placement",
            ));
        }
        let field = query_compare::parse_component_field(cursor, field_at)?;
        let weight = if cursor.eat_char(':') {
            parse_component_weight(cursor)?
        } else {
            1.0
        };
        fields.push(WeightedComponent {
            at: cursor.place_since(field_at.start),
            field,
            weight,
        });
        let mut ahead = cursor.clone();
        ahead.skip_blanks();
        if !ahead.eat_char(',') {
            return Ok(fields);
        }
        *cursor = ahead;
    }
}

fn parse_component_weight(cursor: &mut QueryCursor<'_>) -> Result<f64, QueryError> {
    let number_at = cursor.skip_bare_word(WordContext::Value);
    let text = cursor.text_at_place(number_at);
    match text.parse::<f64>() {
        Ok(weight) if weight > 0.0 && weight <= 1000.0 => Ok(weight),
        _ => Err(QueryError::new(
            number_at,
            format!("{text:?} is no weight"),
            "a weight is a number above 0 and at most 1000, such as configuration:2",
        )),
    }
}
