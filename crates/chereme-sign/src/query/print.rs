//! Canonical text of a query.

use super::lex::{self, WordContext};
use super::tree::{
    Comparison, Example, Expr, Feature, Like, Operator, Query, Related, Test, TextField, TimeTest,
    Value, Wanted, What,
};
use super::{Pattern, Saved, attributes, words};
use std::fmt::{self, Display, Formatter, Write};

impl Display for Query {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.root.fmt(f)
    }
}

impl Display for Expr {
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

impl Display for Saved {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_char('@')?;
        let bare = lex::is_bare(&self.name, WordContext::Term);
        if bare && !self.name.contains(['*', '\\']) {
            f.write_str(&self.name)
        } else {
            write_quoted(f, &Pattern::literal(&self.name[..]))
        }
    }
}

impl Display for Test {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.what {
            What::Component(field, comparison) => write!(f, "{field}{comparison}"),
            What::Property(property, comparison) => write!(f, "{}{comparison}", property.name()),
            What::Whole(field, comparison) => write!(f, "{}{comparison}", field.name()),
            What::Words(TextField::Any, words) if words.len() == 1 => {
                words.iter().try_for_each(|word| write_term(f, word))
            }
            What::Words(field, words) => {
                write!(f, "{}:", field.name())?;
                separated(f, words, ",", |f, word| {
                    write_quotable(f, word, |text| !text.starts_with('['))
                })
            }
            What::Fuzzy { field, text, slips } => {
                write!(f, "{}~", field.name())?;
                write_quotable(f, &Pattern::literal(&text[..]), |text| !text.contains('~'))?;
                if *slips == 1 {
                    Ok(())
                } else {
                    write!(f, "~{slips}")
                }
            }
            What::Tier(name, comparison) => {
                f.write_str("tier(")?;
                match name.expression() {
                    Some(expression) => write_expression(f, expression.source())?,
                    None => write_quoted(f, name)?,
                }
                write!(f, "){comparison}")
            }
            What::Time(field, test) => write!(f, "{}{test}", field.name()),
            What::Curve(curve) => {
                write!(f, "nonmanual.{}{}", curve.name, curve.test)?;
                match curve.lasting {
                    0 => Ok(()),
                    lasting => write!(f, " for {}", Seconds(lasting)),
                }
            }
            What::Attribute(name, test) => {
                attributes::write_name(f, name)?;
                test.fmt(f)
            }
        }
    }
}

impl Display for Comparison {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self.operator {
            Operator::Is => "=",
            Operator::Exactly => "==",
            Operator::IsNot => "!=",
        })?;
        separated(f, &self.values, ",", |f, value| value.fmt(f))
    }
}

impl Display for Value {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.wanted {
            Wanted::Present => f.write_char('*'),
            Wanted::Missing(missing) => f.write_str(missing.name()),
            Wanted::Named(pattern) => write_value(f, pattern),
            Wanted::Features(features) => {
                f.write_char('[')?;
                separated(f, features, " ", |f, feature| feature.fmt(f))?;
                f.write_char(']')
            }
            Wanted::Steps(steps) => separated(f, steps, " > ", |f, step| step.fmt(f)),
        }
    }
}

impl Display for Feature {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let minus = if self.absent { "-" } else { "" };
        write!(f, "{minus}{}", self.name)
    }
}

impl Display for TimeTest {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Below(time) => write!(f, "<{}", Seconds(time)),
            Self::AtMost(time) => write!(f, "<={}", Seconds(time)),
            Self::Above(time) => write!(f, ">{}", Seconds(time)),
            Self::AtLeast(time) => write!(f, ">={}", Seconds(time)),
            Self::Between(least, most) if least == most => write!(f, "={}", Seconds(least)),
            Self::Between(least, most) => write!(f, "={}..{}", Seconds(least), Seconds(most)),
        }
    }
}

impl Display for Related {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.relation, self.other)
    }
}

impl Display for Like {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (kind, name) = match &self.example {
            Example::Token(name) => ("token", name),
            Example::Sign(name) => ("sign", name),
        };
        write!(f, "like {kind}:")?;
        write_value(f, &Pattern::literal(&name[..]))?;
        if !self.on.is_empty() {
            f.write_str(" on ")?;
            separated(f, &self.on, ", ", |f, part| match part.weight {
                1.0 => part.field.fmt(f),
                weight => write!(f, "{}:{weight}", part.field),
            })?;
        }
        match self.above {
            Some(least) => write!(f, " {} {least}", words::ABOVE),
            None => Ok(()),
        }
    }
}

impl Display for Pattern {
    /// Writes the pattern as a value of a query, in quotes if it needs them.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_value(f, self)
    }
}

/// Writes a value, in quotes if it could be read as something else.
pub(super) fn write_value(f: &mut impl Write, pattern: &Pattern) -> fmt::Result {
    write_quotable(f, pattern, |text| {
        words::missing(text).is_none() && !text.contains('>')
    })
}

/// Writes a pattern as a term of its own, in quotes if it could be read as something else.
fn write_term(f: &mut impl Write, pattern: &Pattern) -> fmt::Result {
    match bare(pattern) {
        Some(text)
            if lex::is_bare(&text, WordContext::Term)
                && !text.starts_with('@')
                && !words::is_reserved(&text)
                && words::near_relation(&text).is_none() =>
        {
            f.write_str(&text)
        }
        _ => write_quoted(f, pattern),
    }
}

fn write_quotable(
    f: &mut impl Write,
    pattern: &Pattern,
    plain: impl Fn(&str) -> bool,
) -> fmt::Result {
    if let Some(expression) = pattern.expression() {
        return write_expression(f, expression.source());
    }
    match bare(pattern) {
        Some(text) if lex::is_bare(&text, WordContext::Value) && plain(&text) => f.write_str(&text),
        _ => write_quoted(f, pattern),
    }
}

/// Returns the pattern as a bare word would be written, unless that needs an escape.
fn bare(pattern: &Pattern) -> Option<String> {
    let plain = pattern
        .segments()
        .iter()
        .all(|text| !text.contains(['*', '\\']));
    plain.then(|| pattern.segments().join("*"))
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

pub(super) fn write_quoted(f: &mut impl Write, pattern: &Pattern) -> fmt::Result {
    f.write_char('"')?;
    for (count, segment) in pattern.segments().iter().enumerate() {
        if count > 0 {
            f.write_char('*')?;
        }
        for c in segment.chars() {
            if c == '\\' || c == '*' || lex::is_quote(c) {
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
struct Seconds(i64);

impl Display for Seconds {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (whole, part) = (self.0 / 1_000_000, self.0.unsigned_abs() % 1_000_000);
        match format!("{part:06}").trim_end_matches('0') {
            "" => write!(f, "{whole}s"),
            decimals => write!(f, "{whole}.{decimals}s"),
        }
    }
}
