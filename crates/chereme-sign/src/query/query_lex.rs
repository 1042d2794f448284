//! Reading a query character by character.

use super::query_tree::QueryPlace;
use super::{QueryError, RegularExpression, TextPattern, query_words};

/// The context of a bare word, which decides the characters that it may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum WordContext {
    /// At the start of a term: an operator ends the word.
    Term,
    /// On the right of an operator: only `=` ends it, besides blanks, commas and quotes.
    Value,
    /// The same for a value in a sequence: `>` ends it, too.
    Step,
}

/// A place in the characters of a query, moving forward.
#[derive(Debug, Clone)]
pub(super) struct QueryCursor<'a> {
    chars: &'a [char],
    pub(super) pos: usize,
}

/// A word or a quoted text.
#[derive(Debug, Clone)]
pub(super) struct QueryWord {
    pub(super) at: QueryPlace,
    pub(super) pattern: TextPattern,
    pub(super) quoted: bool,
}

/// The operators, longest first.
const QUERY_OPERATORS: [&str; 15] = [
    "==", "!=", "<=", ">=", "=<", "=>", "<>", "=", "<", ">", "~", ":", "≠", "≤", "≥",
];

impl<'a> QueryCursor<'a> {
    pub(super) fn new(chars: &'a [char]) -> Self {
        Self { chars, pos: 0 }
    }

    pub(super) fn peek_char(&self) -> Option<char> {
        self.chars.get(self.pos).copied()
    }

    pub(super) fn skip_blanks(&mut self) {
        while self.peek_char().is_some_and(char::is_whitespace) {
            self.pos += 1;
        }
    }

    /// Steps over `c` if it is next; returns whether it was.
    pub(super) fn eat_char(&mut self, c: char) -> bool {
        let is_next = self.peek_char() == Some(c);
        self.pos += usize::from(is_next);
        is_next
    }

    pub(super) fn place_since(&self, start: usize) -> QueryPlace {
        QueryPlace { start, end: self.pos }
    }

    /// Returns the place of the next `count` characters.
    pub(super) fn next(&self, count: usize) -> QueryPlace {
        QueryPlace {
            start: self.pos,
            end: (self.pos + count).min(self.chars.len()),
        }
    }

    pub(super) fn text_at_place(&self, at: QueryPlace) -> String {
        self.chars[at.start..at.end].iter().collect()
    }

    /// Returns the next operator without stepping over it.
    pub(super) fn peek_operator(&self) -> Option<&'static str> {
        operator_at(self.chars, self.pos)
    }

    /// Steps over a bare word and returns its place; it may be empty.
    pub(super) fn skip_bare_word(&mut self, place: WordContext) -> QueryPlace {
        let start = self.pos;
        self.pos = bare_end(self.chars, start, place);
        self.place_since(start)
    }

    /// Steps over a text in braces and returns a cursor over its inside; `None` if they are not closed.
    pub(super) fn read_braces(&mut self) -> Option<Self> {
        let mut end = self.clone();
        loop {
            match end.peek_char()? {
                '}' => break,
                c if is_quote(c) => drop(end.read_quoted_word().ok()?),
                _ => end.pos += 1,
            }
        }
        let inside = Self {
            chars: &self.chars[..end.pos],
            pos: self.pos + 1,
        };
        self.pos = end.pos + 1;
        Some(inside)
    }

    /// Steps over characters up to a blank, a quote or a closing parenthesis.
    pub(super) fn skip_text_chunk(&mut self) -> QueryPlace {
        let start = self.pos;
        while self
            .peek_char()
            .is_some_and(|c| !c.is_whitespace() && c != ')' && !is_quote(c))
        {
            self.pos += 1;
        }
        self.place_since(start)
    }

    /// Reads a bare or quoted word with its wildcards.
    ///
    /// # Errors
    /// Fails if a quote is not closed, or is closed in the middle of a word.
    pub(super) fn read_query_word(&mut self, place: WordContext) -> Result<QueryWord, QueryError> {
        if self.peek_char().is_some_and(is_quote) {
            return self.read_quoted_word();
        }
        if self.peek_char() == Some('/') && place != WordContext::Term {
            return self.read_regular_expression();
        }
        let word_at = self.skip_bare_word(place);
        let pattern = TextPattern::from_glob(&self.text_at_place(word_at));
        Ok(QueryWord {
            at: word_at,
            pattern,
            quoted: false,
        })
    }

    /// Reads a regular expression between slashes, in which `\/` stands for a slash.
    fn read_regular_expression(&mut self) -> Result<QueryWord, QueryError> {
        const UNCLOSED_SLASH_REMEDY: &str = "a value that begins with / and is no regular expression is quoted";
        let start = self.pos;
        let mut source = String::new();
        self.pos += 1;
        loop {
            let Some(c) = self.peek_char() else {
                let opening_at = QueryPlace { start, end: start + 1 };
                let message = "this regular expression is not closed";
                let remedy = format!("write / at its end; {UNCLOSED_SLASH_REMEDY}");
                return Err(QueryError::new(opening_at, message, remedy));
            };
            self.pos += 1;
            match c {
                '/' => break,
                '\\' if self.peek_char() == Some('/') => {
                    source.push('/');
                    self.pos += 1;
                }
                '\\' => {
                    source.push(c);
                    source.extend(self.peek_char());
                    self.pos += usize::from(self.peek_char().is_some());
                }
                _ => source.push(c),
            }
        }
        let expression_at = self.place_since(start);
        let refused = |reason: String| {
            let message = format!("this is no regular expression: {reason}");
            QueryError::new(expression_at, message, UNCLOSED_SLASH_REMEDY)
        };
        if source.trim().is_empty() {
            return Err(refused("it is empty".to_owned()));
        }
        let expression = RegularExpression::new(&source).map_err(refused)?;
        Ok(QueryWord {
            at: expression_at,
            pattern: TextPattern::of_expression(expression),
            quoted: false,
        })
    }

    /// Reads a quoted text, in which `\"`, `\\` and `\*` stand for the character itself.
    fn read_quoted_word(&mut self) -> Result<QueryWord, QueryError> {
        let start = self.pos;
        let french = self.peek_char() == Some('«');
        self.pos += 1;
        let mut marks = Vec::new();
        loop {
            let Some(c) = self.peek_char() else {
                let opening_at = QueryPlace { start, end: start + 1 };
                return Err(QueryError::new(
                    opening_at,
                    "this quote is not closed",
                    "write \" at the end of the text",
                ));
            };
            self.pos += 1;
            match c {
                '\\' if self.peek_char().is_some_and(|c| c == '\\' || c == '*' || is_quote(c)) => {
                    marks.push(self.peek_char());
                    self.pos += 1;
                }
                _ if closes(c, french) => break,
                '*' => marks.push(None),
                _ => marks.push(Some(c)),
            }
        }
        let blank = |mark: &Option<char>| mark.is_some_and(char::is_whitespace);
        if french {
            while marks.last().is_some_and(blank) {
                marks.pop();
            }
            marks.drain(..marks.iter().take_while(|mark| blank(mark)).count());
        }
        Ok(QueryWord {
            at: self.place_since(start),
            pattern: TextPattern::from_marks(marks),
            quoted: true,
        })
    }

    /// Checks that a quoted text or a bracket is not followed by more of a word.
    ///
    /// # Errors
    /// Fails if more of a word follows.
    pub(super) fn check_word_boundary(&self) -> Result<(), QueryError> {
        match self.peek_char() {
            None | Some(')' | ',' | '{') => Ok(()),
            Some(c) if c.is_whitespace() => Ok(()),
            Some('>') => Err(QueryError::new(
                self.next(1),
                "a value ends before this",
                "successive values are those of a component: placement=head > chest",
            )),
            Some('=') => Err(QueryError::new(
                self.next(1),
                "a value ends before this",
                "a value with = in it is written in quotes",
            )),
            Some(_) => Err(QueryError::new(
                self.next(1),
                "a blank is missing here",
                r#"a quote inside a quoted text is written \""#,
            )),
        }
    }
}

/// Returns whether `text` can be written without quotes at this place.
pub(super) fn is_bare(text: &str, place: WordContext) -> bool {
    let chars: Vec<char> = text.chars().collect();
    let starts_expression = |c: char| place != WordContext::Term && c == '/';
    let opens = chars
        .first()
        .is_some_and(|c| place == WordContext::Term && *c == '(' || *c == '[' || starts_expression(*c));
    // Braces hold conditions on who says so.
    !chars.is_empty() && !opens && !text.contains(['{', '}']) && bare_end(&chars, 0, place) == chars.len()
}

pub(super) fn is_quote(c: char) -> bool {
    matches!(c, '"' | '“' | '”' | '„' | '‟' | '«' | '»')
}

fn closes(c: char, french: bool) -> bool {
    if french {
        c == '»'
    } else {
        matches!(c, '"' | '“' | '”' | '„' | '‟')
    }
}

fn operator_at(chars: &[char], pos: usize) -> Option<&'static str> {
    let rest = chars.get(pos..)?;
    let starts = |operator: &&&str| {
        let mut rest = rest.iter();
        operator.chars().all(|c| rest.next() == Some(&c))
    };
    QUERY_OPERATORS.iter().find(starts).copied()
}

fn bare_end(chars: &[char], start: usize, place: WordContext) -> usize {
    let mut pos = start;
    while let Some(&c) = chars.get(pos) {
        if c == '(' {
            let word: String = chars[start..pos.min(start + 20)].iter().collect();
            if place == WordContext::Term && query_words::opens_group(&word) {
                break;
            }
            match group_end(chars, pos, place) {
                Some(end) => pos = end,
                None => break,
            }
        } else if ends_word(chars, pos, place) || c == ')' || c == ',' {
            break;
        } else {
            pos += 1;
        }
    }
    pos
}

/// Returns the end of a balanced group such as `(1)` that belongs to a word.
fn group_end(chars: &[char], start: usize, place: WordContext) -> Option<usize> {
    let mut depth = 0_usize;
    for (pos, c) in chars.iter().enumerate().skip(start) {
        match c {
            '(' => depth += 1,
            ')' if depth == 1 => return Some(pos + 1),
            ')' => depth -= 1,
            _ if ends_word(chars, pos, place) => return None,
            _ => {}
        }
    }
    None
}

fn ends_word(chars: &[char], pos: usize, place: WordContext) -> bool {
    let c = chars[pos];
    let operator = match place {
        WordContext::Term => operator_at(chars, pos).is_some(),
        WordContext::Value => c == '=',
        WordContext::Step => matches!(c, '=' | '>' | '{'),
    };
    c.is_whitespace() || is_quote(c) || operator
}
