//! Reading a query character by character.

use super::tree::At;
use super::{Expression, Pattern, QueryError, words};

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
pub(super) struct Cursor<'a> {
    chars: &'a [char],
    pub(super) pos: usize,
}

/// A word or a quoted text.
#[derive(Debug, Clone)]
pub(super) struct Word {
    pub(super) at: At,
    pub(super) pattern: Pattern,
    pub(super) quoted: bool,
}

/// The operators, longest first.
const OPERATORS: [&str; 15] = [
    "==", "!=", "<=", ">=", "=<", "=>", "<>", "=", "<", ">", "~", ":", "≠", "≤", "≥",
];

impl<'a> Cursor<'a> {
    pub(super) fn new(chars: &'a [char]) -> Self {
        Self { chars, pos: 0 }
    }

    pub(super) fn peek(&self) -> Option<char> {
        self.chars.get(self.pos).copied()
    }

    pub(super) fn skip_blanks(&mut self) {
        while self.peek().is_some_and(char::is_whitespace) {
            self.pos += 1;
        }
    }

    /// Steps over `c` if it is next; returns whether it was.
    pub(super) fn eat(&mut self, c: char) -> bool {
        let found = self.peek() == Some(c);
        self.pos += usize::from(found);
        found
    }

    pub(super) fn at(&self, start: usize) -> At {
        At {
            start,
            end: self.pos,
        }
    }

    /// Returns the place of the next `count` characters.
    pub(super) fn next(&self, count: usize) -> At {
        At {
            start: self.pos,
            end: (self.pos + count).min(self.chars.len()),
        }
    }

    pub(super) fn text(&self, at: At) -> String {
        self.chars[at.start..at.end].iter().collect()
    }

    /// Returns the next operator without stepping over it.
    pub(super) fn operator(&self) -> Option<&'static str> {
        operator_at(self.chars, self.pos)
    }

    /// Steps over a bare word and returns its place; it may be empty.
    pub(super) fn bare(&mut self, place: WordContext) -> At {
        let start = self.pos;
        self.pos = bare_end(self.chars, start, place);
        self.at(start)
    }

    /// Steps over characters up to a blank, a quote or a closing parenthesis.
    pub(super) fn chunk(&mut self) -> At {
        let start = self.pos;
        while self
            .peek()
            .is_some_and(|c| !c.is_whitespace() && c != ')' && !is_quote(c))
        {
            self.pos += 1;
        }
        self.at(start)
    }

    /// Reads a bare or quoted word with its wildcards.
    ///
    /// # Errors
    /// Fails if a quote is not closed, or is closed in the middle of a word.
    pub(super) fn word(&mut self, place: WordContext) -> Result<Word, QueryError> {
        if self.peek().is_some_and(is_quote) {
            return self.quoted();
        }
        if self.peek() == Some('/') && place != WordContext::Term {
            return self.expression();
        }
        let at = self.bare(place);
        let pattern = Pattern::from_glob(&self.text(at));
        Ok(Word {
            at,
            pattern,
            quoted: false,
        })
    }

    /// Reads a regular expression between slashes, in which `\/` stands for a slash.
    fn expression(&mut self) -> Result<Word, QueryError> {
        const QUOTE: &str = "a value that begins with / and is no regular expression is quoted";
        let start = self.pos;
        let mut source = String::new();
        self.pos += 1;
        loop {
            let Some(c) = self.peek() else {
                let at = At {
                    start,
                    end: start + 1,
                };
                let message = "this regular expression is not closed";
                let remedy = format!("write / at its end; {QUOTE}");
                return Err(QueryError::new(at, message, remedy));
            };
            self.pos += 1;
            match c {
                '/' => break,
                '\\' if self.peek() == Some('/') => {
                    source.push('/');
                    self.pos += 1;
                }
                '\\' => {
                    source.push(c);
                    source.extend(self.peek());
                    self.pos += usize::from(self.peek().is_some());
                }
                _ => source.push(c),
            }
        }
        let at = self.at(start);
        let refused = |reason: String| {
            let message = format!("this is no regular expression: {reason}");
            QueryError::new(at, message, QUOTE)
        };
        if source.trim().is_empty() {
            return Err(refused("it is empty".to_owned()));
        }
        let expression = Expression::new(&source).map_err(refused)?;
        Ok(Word {
            at,
            pattern: Pattern::of_expression(expression),
            quoted: false,
        })
    }

    /// Reads a quoted text, in which `\"`, `\\` and `\*` stand for the character itself.
    fn quoted(&mut self) -> Result<Word, QueryError> {
        let start = self.pos;
        let french = self.peek() == Some('«');
        self.pos += 1;
        let mut marks = Vec::new();
        loop {
            let Some(c) = self.peek() else {
                let at = At {
                    start,
                    end: start + 1,
                };
                return Err(QueryError::new(
                    at,
                    "this quote is not closed",
                    "write \" at the end of the text",
                ));
            };
            self.pos += 1;
            match c {
                '\\' if self
                    .peek()
                    .is_some_and(|c| c == '\\' || c == '*' || is_quote(c)) =>
                {
                    marks.push(self.peek());
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
        Ok(Word {
            at: self.at(start),
            pattern: Pattern::from_marks(marks),
            quoted: true,
        })
    }

    /// Checks that a quoted text or a bracket is not followed by more of a word.
    ///
    /// # Errors
    /// Fails if more of a word follows.
    pub(super) fn boundary(&self) -> Result<(), QueryError> {
        match self.peek() {
            None | Some(')' | ',') => Ok(()),
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
    let opens = chars.first().is_some_and(|c| {
        place == WordContext::Term && *c == '(' || *c == '[' || starts_expression(*c)
    });
    !chars.is_empty() && !opens && bare_end(&chars, 0, place) == chars.len()
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
    OPERATORS.iter().find(starts).copied()
}

fn bare_end(chars: &[char], start: usize, place: WordContext) -> usize {
    let mut pos = start;
    while let Some(&c) = chars.get(pos) {
        if c == '(' {
            let word: String = chars[start..pos.min(start + 20)].iter().collect();
            if place == WordContext::Term && words::opens_group(&word) {
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
        WordContext::Step => c == '=' || c == '>',
    };
    c.is_whitespace() || is_quote(c) || operator
}
