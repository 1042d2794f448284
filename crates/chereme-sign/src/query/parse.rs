//! Reading a query: terms, joints, relations and examples. The module `compare` reads comparisons.

use super::lex::{Cursor, Word, WordContext, is_quote};
use super::tree::{
    At, Example, Expr, Like, Query, Related, Test, TextField, Wanted, Weighted, What,
};
use super::words::{self, Joint};
use super::{MAX_CHARS, MAX_DEPTH, QueryError, Saved, attributes, compare, times};
use crate::relation::Relation;
use crate::text::nearest;

/// Reads a whole query.
pub(super) fn query(text: &str) -> Result<Query, QueryError> {
    let chars: Vec<char> = text.chars().take(MAX_CHARS + 1).collect();
    if chars.len() > MAX_CHARS {
        let at = At {
            start: MAX_CHARS,
            end: MAX_CHARS + 1,
        };
        let message = format!("the query is longer than {MAX_CHARS} characters");
        return Err(QueryError::new(at, message, "ask in several steps"));
    }
    let mut cursor = Cursor::new(&chars);
    cursor.skip_blanks();
    if cursor.peek().is_none() {
        return Ok(Query {
            root: Expr::And(Vec::new()),
        });
    }
    let root = alternatives(&mut cursor, 0)?;
    match cursor.peek() {
        None => Ok(Query { root }),
        Some(_) => Err(QueryError::new(
            cursor.next(1),
            "this parenthesis closes none",
            "leave it out, or open one before it",
        )),
    }
}

/// Reads terms joined by `or`, up to the end or a closing parenthesis.
fn alternatives(cursor: &mut Cursor<'_>, depth: usize) -> Result<Expr, QueryError> {
    let mut found = vec![terms(cursor, depth)?];
    while step_over(cursor, Joint::Or) {
        found.push(terms(cursor, depth)?);
    }
    Ok(Expr::any(found))
}

/// Reads terms side by side, up to the end, a closing parenthesis or `or`.
fn terms(cursor: &mut Cursor<'_>, depth: usize) -> Result<Expr, QueryError> {
    let mut found = Vec::new();
    loop {
        cursor.skip_blanks();
        let joint = next_joint(cursor);
        let ended =
            matches!(cursor.peek(), None | Some(')')) || joint.is_some_and(|(j, _)| j == Joint::Or);
        if ended && !found.is_empty() {
            return Ok(Expr::all(found));
        }
        if ended {
            return Err(missing_term(cursor));
        }
        if let Some((Joint::And, at)) = joint {
            if found.is_empty() {
                return Err(missing_term(cursor));
            }
            cursor.pos = at.end;
            cursor.skip_blanks();
            let another = next_joint(cursor).is_some_and(|(j, _)| j != Joint::Not);
            if another || matches!(cursor.peek(), None | Some(')')) {
                return Err(missing_term(cursor));
            }
        }
        found.push(term(cursor, depth)?);
    }
}

fn missing_term(cursor: &Cursor<'_>) -> QueryError {
    let (at, message) = match (next_joint(cursor), cursor.peek()) {
        (Some((_, at)), _) => (
            at,
            format!(
                "`{}` has nothing to join here",
                cursor.text(at).to_lowercase()
            ),
        ),
        (None, None) => (
            cursor.next(0),
            "the query ends where a term should stand".to_owned(),
        ),
        (None, Some(_)) => (
            cursor.next(1),
            "a term should stand before this parenthesis".to_owned(),
        ),
    };
    let remedy = match next_joint(cursor) {
        Some((_, at)) => {
            let word = cursor.text(at);
            format!("write a comparison beside it; to search for the word itself, write \"{word}\"")
        }
        None => "write a comparison such as placement=chin, or a word".to_owned(),
    };
    QueryError::new(at, message, remedy)
}

/// Returns the next joint, without stepping over it; `None` if the word names a field.
pub(super) fn next_joint(cursor: &Cursor<'_>) -> Option<(Joint, At)> {
    let mut ahead = cursor.clone();
    let at = ahead.bare(WordContext::Term);
    // Only words of three characters or fewer can be joints.
    let joint = (at.end - at.start <= 3)
        .then(|| words::joint(&ahead.text(at)))
        .flatten()?;
    ahead.operator().is_none().then_some((joint, at))
}

fn step_over(cursor: &mut Cursor<'_>, joint: Joint) -> bool {
    match next_joint(cursor) {
        Some((found, at)) if found == joint => {
            cursor.pos = at.end;
            true
        }
        _ => false,
    }
}

/// Reads one term.
fn term(cursor: &mut Cursor<'_>, depth: usize) -> Result<Expr, QueryError> {
    if depth >= MAX_DEPTH {
        let message = format!("more than {MAX_DEPTH} parentheses and negations inside each other");
        return Err(QueryError::new(
            cursor.next(1),
            message,
            "take some of them out",
        ));
    }
    if step_over(cursor, Joint::Not) {
        cursor.skip_blanks();
        let joint = next_joint(cursor).is_some_and(|(joint, _)| joint != Joint::Not);
        if joint || matches!(cursor.peek(), None | Some(')')) {
            return Err(missing_term(cursor));
        }
        return Ok(Expr::Not(Box::new(term(cursor, depth + 1)?)));
    }
    match cursor.peek() {
        Some('(') => group(cursor, depth),
        Some('[') => Err(QueryError::new(
            cursor.next(1),
            "features need a field before them",
            "a list of features is a value: configuration=[index -thumb]",
        )
        .suggest(Some("configuration=["))),
        Some(',') => Err(QueryError::new(
            cursor.next(1),
            "a comma stands only between the values of one field",
            "terms side by side must all hold; `or` between them means that one is enough",
        )),
        Some(c) if is_quote(c) => quoted_text(cursor),
        _ if cursor.operator().is_some() => Err(compare::stray_operator(cursor)),
        _ => worded(cursor),
    }
}

fn group(cursor: &mut Cursor<'_>, depth: usize) -> Result<Expr, QueryError> {
    let open = cursor.next(1);
    cursor.pos = open.end;
    let inner = alternatives(cursor, depth + 1).map_err(|error| {
        if cursor.peek().is_none() && error.at.is_empty() {
            unclosed(open)
        } else {
            error
        }
    })?;
    if cursor.eat(')') {
        Ok(inner)
    } else {
        Err(unclosed(open))
    }
}

fn unclosed(at: At) -> QueryError {
    QueryError::new(
        at,
        "this parenthesis is not closed",
        "write ) where the group ends",
    )
}

fn quoted_text(cursor: &mut Cursor<'_>) -> Result<Expr, QueryError> {
    let word = cursor.word(WordContext::Term)?;
    cursor.boundary()?;
    free_text(word)
}

/// Reads a term that begins with a word.
fn worded(cursor: &mut Cursor<'_>) -> Result<Expr, QueryError> {
    let start = cursor.clone();
    let word = cursor.word(WordContext::Term)?;
    let name = cursor.text(word.at);
    if let Some(saved) = name.strip_prefix('@')
        && !operator_follows(cursor)
    {
        return saved_search(cursor, word.at, saved);
    }
    if name == words::TIER && opens(cursor) {
        return Ok(Expr::Test(compare::tier_test(cursor, word.at)?));
    }
    if attributes::opens_name(&name) && opens(cursor) {
        return Ok(Expr::Test(attributes::in_parentheses(cursor, word.at)?));
    }
    if operator_follows(cursor) {
        *cursor = start;
        return Ok(Expr::Test(compare::test(cursor)?));
    }
    if let Some(relation) = words::plain_relation(&name) {
        return related(cursor, word.at, relation);
    }
    if let Some(relation) = words::french_relation(&name)
        && comparison_follows(cursor)
    {
        return related(cursor, word.at, relation);
    }
    match &name[..] {
        words::FRENCH_LIKE if example_follows(cursor) => like(cursor, word.at),
        words::WITHIN => {
            let relation = within(cursor, word.at)?;
            related(cursor, word.at, relation)
        }
        words::LIKE => like(cursor, word.at),
        _ => {
            if cursor.peek().is_some_and(is_quote) {
                cursor.boundary()?;
            }
            if let Some(relation) = words::near_relation(&name)
                && comparison_follows(cursor)
            {
                let message = format!("there is no relation {name:?}");
                let remedy = format!("to search for the word, write it in quotes: \"{name}\"");
                return Err(QueryError::new(word.at, message, remedy).suggest(Some(relation)));
            }
            free_text(word)
        }
    }
}

/// Reads the rest of a saved search's name; `name` is its start, at `at` after the `@`.
fn saved_search(cursor: &mut Cursor<'_>, at: At, name: &str) -> Result<Expr, QueryError> {
    let (mut name, mut at) = (name.to_owned(), at);
    if name.is_empty() && cursor.peek().is_some_and(is_quote) {
        let word = cursor.word(WordContext::Value)?;
        name = word.pattern.segments().join("*");
        at = at.to(word.at);
    }
    if name.trim().is_empty() {
        let remedy = "write @ and the name of a saved search, with blanks: @\"my search\"";
        return Err(QueryError::new(at, "which saved search?", remedy));
    }
    cursor.boundary()?;
    Ok(Expr::Saved(Saved { at, name }))
}

/// Returns whether the address of a token or sign is next, after blanks.
fn example_follows(cursor: &Cursor<'_>) -> bool {
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    let at = ahead.bare(WordContext::Value);
    let word = ahead.text(at);
    word.starts_with("token:") || word.starts_with("sign:")
}

/// Returns whether an opening parenthesis is next, after blanks.
fn opens(cursor: &Cursor<'_>) -> bool {
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    ahead.peek() == Some('(')
}

fn operator_follows(cursor: &Cursor<'_>) -> bool {
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    ahead.operator().is_some()
}

fn comparison_follows(cursor: &Cursor<'_>) -> bool {
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    let at = ahead.bare(WordContext::Term);
    operator_follows(&ahead) || ahead.text(at) == words::TIER && opens(&ahead)
}

fn free_text(word: Word) -> Result<Expr, QueryError> {
    let at = word.at;
    compare::check_term(&word.pattern, at)?;
    let what = What::Words(TextField::Any, vec![word.pattern]);
    Ok(Expr::Test(Test {
        at,
        subject_at: at,
        what,
    }))
}

/// Reads the distance and the kind of relation after `within`.
fn within(cursor: &mut Cursor<'_>, at: At) -> Result<Relation, QueryError> {
    const REMEDY: &str = "write within 0.5s around, within 0.5s of-begin or within 0.5s of-end";
    cursor.skip_blanks();
    if matches!(cursor.peek(), None | Some(')')) {
        return Err(QueryError::new(at, "`within` needs a distance", REMEDY));
    }
    let distance = times::time(cursor)?;
    cursor.skip_blanks();
    let mut kind_at = cursor.bare(WordContext::Term);
    let mut kind = cursor.text(kind_at);
    if kind == "of" {
        cursor.skip_blanks();
        kind_at = kind_at.to(cursor.bare(WordContext::Term));
        kind = cursor
            .text(kind_at)
            .split_whitespace()
            .collect::<Vec<_>>()
            .join("-");
    }
    match &kind[..] {
        "around" => Ok(Relation::Around(distance)),
        "of-begin" | "of-start" => Ok(Relation::OfBegin(distance)),
        "of-end" => Ok(Relation::OfEnd(distance)),
        _ => {
            let message = format!("{kind:?} does not say what the distance is counted from");
            Err(QueryError::new(kind_at, message, REMEDY)
                .suggest(nearest(&kind, words::WITHIN_KINDS)))
        }
    }
}

/// Reads the right side of a relation whose name is at `at`.
fn related(cursor: &mut Cursor<'_>, at: At, relation: Relation) -> Result<Expr, QueryError> {
    const REMEDY: &str = r#"write a component, a gloss or a tier, such as nonmanual.brows=raised, gloss=CHAT or tier("Mouthing")=*"#;
    cursor.skip_blanks();
    let start = cursor.pos;
    if !comparison_follows(cursor) {
        let name = cursor.text(at);
        let message = format!("`{name}` needs a comparison on its right");
        let remedy = format!("{REMEDY}; to search for the word, write it in quotes: \"{name}\"");
        let found = cursor.bare(WordContext::Term);
        let word = cursor.text(found);
        let searched = !word.is_empty() && !words::is_reserved(&word);
        let gloss = searched.then(|| format!("gloss={word}"));
        return Err(QueryError::new(found, message, remedy).suggest(gloss));
    }
    let word = cursor.bare(WordContext::Term);
    let other = if cursor.text(word) == words::TIER && opens(cursor) {
        compare::tier_test(cursor, word)?
    } else {
        cursor.pos = start;
        compare::test(cursor)?
    };
    if let What::Component(_, comparison) = &other.what {
        let steps = |wanted: &Wanted| matches!(wanted, Wanted::Steps(_));
        if let Some(value) = comparison.values.iter().find(|it| steps(&it.wanted)) {
            let message = "successive values belong to one token, not to an annotation beside it";
            let remedy = "ask them of the token itself: placement=head > chest";
            return Err(QueryError::new(value.at, message, remedy));
        }
    }
    if matches!(
        other.what,
        What::Property(..) | What::Time(..) | What::Attribute(..) | What::Curve(..)
    ) {
        return Err(QueryError::new(
            other.subject_at,
            "this is no annotation that could stand in a relation of time",
            REMEDY,
        ));
    }
    Ok(Expr::Relation(Related {
        at: at.to(other.at),
        relation,
        other,
    }))
}

/// Reads the example and the components after `like`, which is at `at`.
fn like(cursor: &mut Cursor<'_>, at: At) -> Result<Expr, QueryError> {
    const REMEDY: &str = "write like token:41 or like CHAT, and then, if not all components count, on configuration, placement";
    cursor.skip_blanks();
    let word = cursor.word(WordContext::Value)?;
    if word.at.start == word.at.end || cursor.text(word.at) == words::ON {
        let remedy = format!("{REMEDY}; to search for the word, write it in quotes: \"like\"");
        return Err(QueryError::new(word.at, "`like` needs an example", remedy));
    }
    let (example, example_at) = example(cursor, word, REMEDY)?;
    cursor.boundary()?;
    let mut like = Like {
        at: at.to(example_at),
        example_at,
        example,
        on: Vec::new(),
        above: None,
    };
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    let joint_at = ahead.bare(WordContext::Term);
    let joint = ahead.text(joint_at);
    let on = [words::ON, words::FRENCH_ON].contains(&&joint[..]);
    if on && !operator_follows(&ahead) {
        *cursor = ahead;
        like.on = weighted_fields(cursor)?;
        like.at.end = cursor.pos;
    } else if words::INSTEAD_OF_ON.contains(&&joint[..]) && !operator_follows(&ahead) {
        let message = format!("{joint:?} does not follow an example");
        let remedy = format!("{REMEDY}; to search for the word, write it in quotes: \"{joint}\"");
        return Err(QueryError::new(joint_at, message, remedy).suggest(Some(words::ON)));
    }
    if let Some(least) = threshold(cursor)? {
        like.above = Some(least);
        like.at.end = cursor.pos;
    }
    Ok(Expr::Like(like))
}

/// Reads `above 0.6` or `above 60%`, if it is next.
fn threshold(cursor: &mut Cursor<'_>) -> Result<Option<f64>, QueryError> {
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    let word = ahead.bare(WordContext::Term);
    if ahead.text(word) != words::ABOVE || operator_follows(&ahead) {
        return Ok(None);
    }
    ahead.skip_blanks();
    let at = ahead.bare(WordContext::Value);
    let text = ahead.text(at);
    let least = match text.strip_suffix('%') {
        Some(hundredths) => hundredths.parse::<f64>().map(|it| it / 100.0),
        None => text.parse::<f64>(),
    };
    *cursor = ahead;
    match least {
        Ok(least) if (0.0..1.0).contains(&least) => Ok(Some(least)),
        _ => {
            let remedy = "likeness goes from 0 to 1: write above 0.6, or above 60%";
            let message = format!("{text:?} is no likeness");
            Err(QueryError::new(at, message, remedy))
        }
    }
}

/// Reads the address that a word after `like` is or begins with.
fn example(cursor: &mut Cursor<'_>, word: Word, remedy: &str) -> Result<(Example, At), QueryError> {
    let written = word.pattern.as_literal().map(str::to_owned);
    let Some(text) = written.filter(|text| !text.trim().is_empty()) else {
        return Err(QueryError::new(
            word.at,
            "an example is one token or one sign",
            remedy,
        ));
    };
    let (kind, name) = text
        .split_once(':')
        .filter(|_| !word.quoted)
        .unwrap_or(("", &text));
    if !matches!(kind, "token" | "sign") {
        let meant =
            nearest(kind, ["token", "sign"]).filter(|_| kind.chars().any(char::is_lowercase));
        if meant.is_some() || kind == "recording" || kind == "signer" {
            let kind_at = At {
                start: word.at.start,
                end: word.at.start + kind.chars().count(),
            };
            let message = format!("{kind:?} is no example");
            return Err(QueryError::new(kind_at, message, remedy).suggest(meant));
        }
        return Ok((Example::Sign(text), word.at));
    }
    let (mut name, mut at) = (name.to_owned(), word.at);
    if name.is_empty() && cursor.peek().is_some_and(is_quote) {
        let rest = cursor.word(WordContext::Value)?;
        at = at.to(rest.at);
        name = rest.pattern.as_literal().unwrap_or_default().to_owned();
    }
    if name.trim().is_empty() {
        return Err(QueryError::new(at, format!("which {kind}?"), remedy));
    }
    Ok((
        if kind == "token" {
            Example::Token(name)
        } else {
            Example::Sign(name)
        },
        at,
    ))
}

/// Reads the components after `on`, with their weights.
fn weighted_fields(cursor: &mut Cursor<'_>) -> Result<Vec<Weighted>, QueryError> {
    let mut fields = Vec::new();
    loop {
        cursor.skip_blanks();
        let at = cursor.bare(WordContext::Term);
        if at.start == at.end {
            return Err(QueryError::new(
                cursor.next(0),
                "a component should stand here",
                "write for example on configuration:2, placement",
            ));
        }
        let field = compare::component(cursor, at)?;
        let weight = if cursor.eat(':') {
            weight(cursor)?
        } else {
            1.0
        };
        fields.push(Weighted {
            at: cursor.at(at.start),
            field,
            weight,
        });
        let mut ahead = cursor.clone();
        ahead.skip_blanks();
        if !ahead.eat(',') {
            return Ok(fields);
        }
        *cursor = ahead;
    }
}

fn weight(cursor: &mut Cursor<'_>) -> Result<f64, QueryError> {
    let at = cursor.bare(WordContext::Value);
    let text = cursor.text(at);
    match text.parse::<f64>() {
        Ok(weight) if weight > 0.0 && weight <= 1000.0 => Ok(weight),
        _ => Err(QueryError::new(
            at,
            format!("{text:?} is no weight"),
            "a weight is a number above 0 and at most 1000, such as configuration:2",
        )),
    }
}
