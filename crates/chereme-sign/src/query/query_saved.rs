//! Saved searches inside a query: `@chin configuration=B`.

use super::AttributeTest;
use super::query_tree::{QueryExpression, QueryPlace, TokenQuery};

/// A saved search used by name as part of a query: `@chin`, `@"my chin"`.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct NamedSearch {
    /// Its place in the query.
    pub at: QueryPlace,
    /// Its name, without the `@`.
    pub name: String,
}

impl std::hash::Hash for QueryPlace {
    /// Adds nothing: all places are equal, so their hashes must be, too.
    fn hash<H: std::hash::Hasher>(&self, _: &mut H) {}
}

impl TokenQuery {
    /// Returns the query with each saved search replaced by the query that `search` returns for it.
    ///
    /// All parts of such a query get the place of the saved search's name in this query.
    ///
    /// # Errors
    /// Those of `search`.
    pub fn with_saved<E>(self, search: &mut impl FnMut(&NamedSearch) -> Result<Self, E>) -> Result<Self, E> {
        Ok(Self {
            root: self.root.with_saved(search)?,
        })
    }
}

impl QueryExpression {
    fn with_saved<E>(self, search: &mut impl FnMut(&NamedSearch) -> Result<TokenQuery, E>) -> Result<Self, E> {
        Ok(match self {
            Self::Saved(saved) => {
                let mut root = search(&saved)?.root;
                root.move_to(saved.at);
                root
            }
            Self::And(terms) => {
                let terms = terms.into_iter().map(|term| term.with_saved(search));
                Self::all_of_terms(terms.collect::<Result<Vec<_>, E>>()?)
            }
            Self::Or(terms) => {
                let terms = terms.into_iter().map(|term| term.with_saved(search));
                Self::any_of_terms(terms.collect::<Result<Vec<_>, E>>()?)
            }
            Self::Not(inner) => Self::Not(Box::new(inner.with_saved(search)?)),
            other => other,
        })
    }

    /// Sets the place of every part to `at`.
    fn move_to(&mut self, at: QueryPlace) {
        use super::query_tree::{QueryTest, TestSubject, WantedValue};
        fn move_value_places(what: &mut TestSubject, at: QueryPlace) {
            let (TestSubject::Component(_, comparison)
            | TestSubject::Said(_, comparison, _)
            | TestSubject::Property(_, comparison)
            | TestSubject::Whole(_, comparison)
            | TestSubject::Tier(_, comparison)
            | TestSubject::Attribute(_, AttributeTest::Value(comparison))) = what
            else {
                return;
            };
            for value in &mut comparison.values {
                value.at = at;
                match &mut value.wanted {
                    WantedValue::Features(features) => features.iter_mut().for_each(|feature| feature.at = at),
                    WantedValue::Steps(steps) => steps.iter_mut().for_each(|step| step.at = at),
                    _ => {}
                }
            }
        }
        fn place(test: &mut QueryTest, at: QueryPlace) {
            (test.at, test.subject_at) = (at, at);
            move_value_places(&mut test.what, at);
            if let TestSubject::Said(_, _, sources) = &mut test.what {
                sources.iter_mut().for_each(|source| place(source, at));
            }
        }
        match self {
            Self::And(terms) | Self::Or(terms) => terms.iter_mut().for_each(|term| term.move_to(at)),
            Self::Not(inner) => inner.move_to(at),
            Self::Test(test) => place(test, at),
            Self::Relation(related) => {
                related.at = at;
                place(&mut related.other, at);
            }
            Self::Like(like) => {
                (like.at, like.example_at) = (at, at);
                like.on.iter_mut().for_each(|weighted| weighted.at = at);
            }
            Self::Saved(saved) => saved.at = at,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    #[test]
    fn saved_searches_are_expanded_anywhere() {
        for (text, wanted) in [
            ("@a", "gloss=A or gloss=B"),
            ("not @a", "not (gloss=A or gloss=B)"),
            ("@a hand=both", "(gloss=A or gloss=B) hand=both"),
            ("x or @a y", "x or (gloss=A or gloss=B) y"),
            ("(@\"a b\" or x)", "gloss=A or gloss=B or x"),
        ] {
            let query = TokenQuery::parse_query(text).expect(text);
            let filled = query.with_saved(&mut |_| {
                Ok::<_, Infallible>(TokenQuery::parse_query("gloss=A or gloss=B").expect("a query"))
            });
            let Ok(filled) = filled;
            assert_eq!(filled.to_string(), wanted, "{text}");
            let place = text.find('@').map(|start| start..start + 2);
            if let Some(test) = filled.query_tests().iter().find(|it| it.to_string() == "gloss=A") {
                assert_eq!(Some(test.at.start), place.map(|it| it.start), "{text}");
            }
        }
    }
}
