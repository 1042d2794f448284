//! Canonical text of a query.

use super::query_lex::{self, WordContext};
use super::query_tree::{
    ComparisonOperator, ExampleToken, LikeSearch, QueryExpression, QueryTest, QueryValue, RelatedAnnotation,
    TestSubject, TextField, TimeTest, TokenQuery, ValueComparison, ValueFeature, WantedValue,
};
use super::{NamedSearch, TextPattern, query_attributes, query_words};
use std::fmt::{self, Display, Formatter, Write};

impl Display for TokenQuery {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.root.fmt(f)
    }
}

impl Display for QueryExpression {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::And(terms) => separated(f, terms, " ", |f, term| match term {
                Self::And(_) | Self::Or(_) => write!(f, "({term})"),
                _ => term.fmt(f),
            }),
            Self::Or(terms) => separated(f, terms, " or ", |f, term| match term {
                Self::Or(_) => write!(f, "({term})"),
                _ => term.fmt(f),
            }),
            Self::Not(inner) => match &**inner {
                Self::And(_) | Self::Or(_) => write!(f, "not ({inner})"),
                _ => write!(f, "not {inner}"),
            },
            Self::Test(test) => test.fmt(f),
            Self::Relation(related) => related.fmt(f),
            Self::Like(like) => like.fmt(f),
            Self::Saved(saved) => saved.fmt(f),
        }
    }
}

impl Display for NamedSearch {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_char('@')?;
        let bare = query_lex::is_bare(&self.name, WordContext::Term);
        if bare && !self.name.contains(['*', '\\']) {
            f.write_str(&self.name)
        } else {
            write_quoted(f, &TextPattern::literal_pattern(&self.name[..]))
        }
    }
}

impl Display for QueryTest {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.what {
            TestSubject::Component(field, comparison) => write!(f, "{field}{comparison}"),
            TestSubject::Said(field, comparison, sources) => {
                write!(f, "{field}{comparison}{{")?;
                separated(f, sources, " ", |f, test| test.fmt(f))?;
                f.write_char('}')
            }
            TestSubject::Property(property, comparison) => {
                write!(f, "{}{comparison}", property.property_name())
            }
            TestSubject::Whole(field, comparison) => {
                write!(f, "{}{comparison}", field.text_field_name())
            }
            // Words of any text are written alone, as people write them.
            TestSubject::Words(TextField::Any, words) if words.len() == 1 => {
                words.iter().try_for_each(|word| write_term(f, word))
            }
            TestSubject::Words(field, words) => {
                write!(f, "{}:", field.text_field_name())?;
                separated(f, words, ",", |f, word| {
                    write_quotable(f, word, |text| !text.starts_with('['))
                })
            }
            TestSubject::Fuzzy { field, text, slips } => {
                write!(f, "{}~", field.text_field_name())?;
                write_quotable(f, &TextPattern::literal_pattern(&text[..]), |text| !text.contains('~'))?;
                // One slip is what ~ means without a number.
                if *slips == 1 { Ok(()) } else { write!(f, "~{slips}") }
            }
            TestSubject::Tier(name, comparison) => {
                f.write_str("tier(")?;
                match name.regular_expression() {
                    Some(expression) => write_expression(f, expression.expression_source())?,
                    None => write_quoted(f, name)?,
                }
                write!(f, "){comparison}")
            }
            TestSubject::Time(field, test) => write!(f, "{}{test}", field.time_field_name()),
            TestSubject::Curve(curve) => {
                write!(f, "nonmanual.{}{}", curve.name, curve.test)?;
                match curve.lasting {
                    0 => Ok(()),
                    lasting => write!(f, " for {}", PrintedSeconds(lasting)),
                }
            }
            TestSubject::Notation(pattern) => pattern.fmt(f),
            TestSubject::Attribute(name, test) => {
                query_attributes::write_name(f, name)?;
                test.fmt(f)
            }
        }
    }
}

impl Display for ValueComparison {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self.operator {
            ComparisonOperator::Is => "=",
            ComparisonOperator::Exactly => "==",
            ComparisonOperator::IsNot => "!=",
        })?;
        separated(f, &self.values, ",", |f, value| value.fmt(f))
    }
}

impl Display for QueryValue {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.wanted {
            WantedValue::Present => f.write_char('*'),
            WantedValue::Missing(missing) => f.write_str(missing.missing_reason_name()),
            WantedValue::Named(pattern) => write_value(f, pattern),
            WantedValue::Features(features) => {
                f.write_char('[')?;
                separated(f, features, " ", |f, feature| feature.fmt(f))?;
                f.write_char(']')
            }
            WantedValue::Steps(steps) => separated(f, steps, " > ", |f, step| step.fmt(f)),
        }
    }
}

impl Display for ValueFeature {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let minus = if self.absent { "-" } else { "" };
        write!(f, "{minus}{}", self.name)
    }
}

impl Display for TimeTest {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Below(time) => write!(f, "<{}", PrintedSeconds(time)),
            Self::AtMost(time) => write!(f, "<={}", PrintedSeconds(time)),
            Self::Above(time) => write!(f, ">{}", PrintedSeconds(time)),
            Self::AtLeast(time) => write!(f, ">={}", PrintedSeconds(time)),
            Self::Between(least, most) if least == most => write!(f, "={}", PrintedSeconds(least)),
            Self::Between(least, most) => {
                write!(f, "={}..{}", PrintedSeconds(least), PrintedSeconds(most))
            }
        }
    }
}

impl Display for RelatedAnnotation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.relation, self.other)
    }
}

impl Display for LikeSearch {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (kind, name) = match &self.example {
            ExampleToken::Token(name) => ("token", name),
            ExampleToken::Sign(name) => ("sign", name),
        };
        write!(f, "like {kind}:")?;
        write_value(f, &TextPattern::literal_pattern(&name[..]))?;
        if !self.on.is_empty() {
            f.write_str(" on ")?;
            separated(f, &self.on, ", ", |f, part| match part.weight {
                1.0 => part.field.fmt(f),
                weight => write!(f, "{}:{weight}", part.field),
            })?;
        }
        match self.above {
            Some(least) => write!(f, " {} {least}", query_words::ABOVE_WORD),
            None => Ok(()),
        }
    }
}

impl Display for TextPattern {
    /// Writes the pattern as a value of a query, in quotes if it needs them.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_value(f, self)
    }
}

/// Writes a value, in quotes if it could be read as something else.
pub(super) fn write_value(f: &mut impl Write, pattern: &TextPattern) -> fmt::Result {
    write_quotable(f, pattern, |text| {
        query_words::missing_reason_of(text).is_none() && !text.contains('>')
    })
}

/// Writes a pattern as a term of its own, in quotes if it could be read as something else.
fn write_term(f: &mut impl Write, pattern: &TextPattern) -> fmt::Result {
    match bare_pattern_text(pattern) {
        Some(text)
            if query_lex::is_bare(&text, WordContext::Term)
                && !text.starts_with('@')
                && !query_words::is_reserved(&text)
                && query_words::near_relation(&text).is_none() =>
        {
            f.write_str(&text)
        }
        _ => write_quoted(f, pattern),
    }
}

fn write_quotable(f: &mut impl Write, pattern: &TextPattern, plain: impl Fn(&str) -> bool) -> fmt::Result {
    if let Some(expression) = pattern.regular_expression() {
        return write_expression(f, expression.expression_source());
    }
    match bare_pattern_text(pattern) {
        Some(text) if query_lex::is_bare(&text, WordContext::Value) && plain(&text) => f.write_str(&text),
        _ => write_quoted(f, pattern),
    }
}

/// Returns the pattern as a bare word would be written, unless that needs an escape.
fn bare_pattern_text(pattern: &TextPattern) -> Option<String> {
    let plain = pattern
        .pattern_segments()
        .iter()
        .all(|text| !text.contains(['*', '\\']));
    plain.then(|| pattern.pattern_segments().join("*"))
}

fn write_expression(f: &mut impl Write, source: &str) -> fmt::Result {
    f.write_char('/')?;
    let mut escaped = false;
    for c in source.chars() {
        if c == '/' && !escaped {
            f.write_char('\\')?;
        }
        escaped = c == '\\' && !escaped;
        f.write_char(c)?;
    }
    f.write_char('/')
}

pub(super) fn write_quoted(f: &mut impl Write, pattern: &TextPattern) -> fmt::Result {
    f.write_char('"')?;
    for (count, segment) in pattern.pattern_segments().iter().enumerate() {
        if count > 0 {
            f.write_char('*')?;
        }
        for c in segment.chars() {
            if c == '\\' || c == '*' || query_lex::is_quote(c) {
                f.write_char('\\')?;
            }
            f.write_char(c)?;
        }
    }
    f.write_char('"')
}

fn separated<T>(
    f: &mut Formatter<'_>,
    items: &[T],
    between: &str,
    write: impl Fn(&mut Formatter<'_>, &T) -> fmt::Result,
) -> fmt::Result {
    for (count, item) in items.iter().enumerate() {
        if count > 0 {
            f.write_str(between)?;
        }
        write(f, item)?;
    }
    Ok(())
}

/// A time in microseconds, printed in seconds with no more decimals than needed.
struct PrintedSeconds(i64);

impl Display for PrintedSeconds {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (whole, part) = (self.0 / 1_000_000, self.0.unsigned_abs() % 1_000_000);
        match format!("{part:06}").trim_end_matches('0') {
            "" => write!(f, "{whole}s"),
            decimals => write!(f, "{whole}.{decimals}s"),
        }
    }
}
