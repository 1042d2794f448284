//! The query language, which describes tokens.
//!
//! A query is parsed into a tree ([`TokenQuery`]). Every part of it holds its place in the text, so that an error can point
//! at an unknown value ([`unknown_value`]). Printing a query gives its canonical text. [`complete_query`] lists the texts
//! that may follow at a cursor.
//!
//! ```
//! use chereme_sign::query::TokenQuery;
//!
//! let query: TokenQuery = r#"right.handshape=U  placement="chin""#.parse()?;
//! assert_eq!(query.to_string(), "right.configuration=U placement=chin");
//!
//! let error = "right.confguration=U".parse::<TokenQuery>().unwrap_err();
//! assert_eq!(error.at, 6..18);
//! assert_eq!(error.suggestion.as_deref(), Some("configuration"));
//! # Ok::<(), chereme_sign::query::QueryError>(())
//! ```
//!
//! # Grammar
//!
//! | rule | is |
//! |---|---|
//! | query | nothing (every token), or *alternatives* |
//! | alternatives | *terms* { `or` *terms* } |
//! | terms | *term* { \[`and`\] *term* } |
//! | term | `not` *term*, `(` *alternatives* `)`, *comparison*, *relation comparison*, *example*, *saved*, *text* |
//! | comparison | *component* (`=` `!=` `==`) *values* \[`{` *comparison* { *comparison* } `}`\]; *property* (`=` `:` `!=` `==`) *values*; *textfield* (`=` `!=` `==`) *values*; *textfield* `:` *text* { `,` *text* }; *textfield* `~` *text* \[`~1` `~2`\]; *timefield* (`<` `<=` `>` `>=` `=`) *time*; *timefield* `=` \[*time*\]`..`\[*time*\]; `tier(`*text*`)` (`=` `!=` `==`) *values*; *attribute* (`=` `!=` `==`) *values*; *attribute* (`<` `<=` `>` `>=`) *number*; *attribute* `=` \[*number*\]`..`\[*number*\]; *curve* (`<` `<=` `>` `>=`) *number* \[`for` *time*\]; *curve* `=` \[*number*\]`..`\[*number*\] \[`for` *time*\] |
//! | curve | `nonmanual.`*name*, before a number |
//! | attribute | `attribute.`*name*, `signer.`*name*, `related.`*name*, `attribute(`*text*`)`; the *name* alone before a number |
//! | component | \[*phase*`.`\] \[*hand*`.`\] (`configuration` `placement` `movement` `orientation` `nonmanual`) \[`.`*part*\] |
//! | phase, hand | `initial` `middle` `final`; `right` `left` `dominant` `weak` |
//! | property | `origin` `signer` `recording` `sign` `token` `tier` `inventory` `hand` `proposed` `disputed` `by` |
//! | textfield | `gloss` `translation` `comment` `text` |
//! | timefield | `duration` `start` `end` |
//! | values | *value* { `,` *value* } |
//! | value | *text*, `/`*regular expression*`/`, `*`, `unset`, `n/a`, `unclear`, `[` { \[`-`\] *feature* } `]`; of a component also *step* `>` *step* { `>` *step* } |
//! | step | *text*, `*`, `[` { \[`-`\] *feature* } `]` |
//! | relation | `overlaps` `not-overlaps` `inside` `not-inside` `overlaps-begin` `overlaps-end` `before` `after` `equals` `meets` `met-by` `starts` `started-by` `finishes` `finished-by` `covers`, `within` *time* (`around` `of-begin` `of-end`) |
//! | example | `like` (`token:`*text*, `sign:`*text*, *text*) \[`on` *component*\[`:`*weight*\] { `,` *component*\[`:`*weight*\] }\] \[`above` *number*\] |
//! | saved | `@`*text* |
//! | time | *number* (`s` `ms` `min`) |
//! | text | a bare word or `"…"`, with `*` for any characters |
//!
//! Notes: a bare word ends at a blank, a comma, a quote or a closing parenthesis; a balanced group such as `X(1)`
//! belongs to it. After an operator only `=` ends it as well, so that `INDEX:1` stays whole. Curly quotes are
//! quotes. Joints are understood in any case; relations and `like` only in lower case, because glosses are written
//! in capitals. A relation is a term about the token itself: `gloss=CHAT overlaps nonmanual.brows=raised` is two
//! terms, and both must hold. A regular expression may match anywhere in the text; `gloss~/^BO/` is `gloss=/^BO/`.
//! In lower case `et`, `ou` and `non` are joints, too, and French words stand for relations if a comparison
//! follows: `chevauche`, `avant`, `après`, `dans`, `couvre`.

mod error;
mod narrow;
mod numerals;
mod query_attributes;
mod query_compare;
mod query_complete;
mod query_cue;
mod query_curves;
mod query_everyday;
mod query_expression;
mod query_lex;
mod query_notation;
mod query_parse;
mod query_pattern;
mod query_print;
mod query_saved;
mod query_times;
mod query_tree;
mod query_values;
mod query_words;
#[cfg(test)]
mod tests;

pub use error::{QueryError, unknown_value};
pub use narrow::{add_query_condition, facet_condition, has_query_condition, remove_query_condition};
pub use numerals::NumberSpelling;
pub use query_attributes::{AttributeTest, attribute_field_text, parse_plain_number};
pub use query_complete::{CursorCompletion, ExpectedText, complete_query};
pub use query_everyday::{guess_everyday_query, query_from_everyday_words};
pub use query_expression::RegularExpression;
pub use query_notation::NotationPattern;
pub use query_pattern::TextPattern;
pub use query_saved::NamedSearch;
pub use query_tree::{
    CONFIDENCE_NAME, ComparisonOperator, CurveTest, ExampleToken, LikeSearch, MissingReason, QueryExpression,
    QueryPlace, QueryTest, QueryValue, RelatedAnnotation, TestSubject, TextField, TimeField, TimeTest, TokenQuery,
    ValueComparison, ValueFeature, WantedValue, WeightedComponent, WholeTokenProperty,
};

use std::str::FromStr;

/// The most characters of a query.
pub const MAX_CHARS: usize = 10_000;

/// The deepest nesting of parentheses and negations.
pub const MAX_QUERY_DEPTH: usize = 64;

/// A guide to writing queries, in plain text of at most 80 columns.
pub const QUERY_HELP: &str = r#"A query is a list of conditions; a token must meet all of them:

  right.configuration=U placement=chin    U on the right hand, near the chin
  gloss:BO* not weak.configuration=S      a gloss in BO..., weak hand without S
  movement=arc or movement=circle         one or the other; parentheses group

Components, on either hand unless one is named
  configuration  placement  movement  orientation  nonmanual
  right. left. dominant. weak.            before it: the hand
  initial. middle. final.                 before it: first, between, last value;
                                          a single value is both first and last
  .palm .brows ...                        after it: one part of it
  synonyms: handshape, location, emplacement, mouvement

Values
  placement=chest,chin                    one of these, or a narrower value
  placement==head                         exactly this, nothing narrower
  placement=head > chest                  begins at the head, then the chest
  placement=head > *                      begins at the head, then elsewhere
  placement!=chest                        coded, with another value
  placement="neutral space"               with blanks: in quotes
  configuration=B*                        * for any characters of value or name;
                                          case counts only after a double sign
  configuration=[index middle -thumb]     features, and one that is absent
  placement=*                             has a main value; parts do not count
  movement.direction=*                    this part of it has a value
  placement=unset   =n/a   =unclear       its main value is missing: three kinds
  movement=none                           coded as none, which is a value

Texts: gloss, translation, comment, text (all three)
  slow animal "slow animal"               words anywhere; a phrase
  gloss=CHAT   gloss=INDEX:1              the whole text
  gloss:BO*    gloss:MA*SON               words in it
  gloss~ESCARGO   gloss~ESCRGO~2          up to one slip, or two
  gloss=/^BO.*[0-9]$/                     a regular expression, in any text

Times: duration, start, end, in s, ms or min
  duration<0.8s   duration=0.5s..1s   start>=2min

Attributes of the sign, from a lexicon table
  frequency>0.4   attribute.class=Noun   attribute("Sign Frequency")=2..5
  signer.region=north   signer.age>40     what the corpus says of the signer
  related.variant=BOOK   related.part-of=*   relations to other signs

Curves of face and head during the token (1 is the usual reach, or degrees)
  nonmanual.brows>0.5 for 0.3s   nonmanual.jaw_open>0.4   nonmanual.head_yaw<-10

Notation in HamNoSys, symbols as names or characters
  notation~"hamfinger2 … hamcirclei"      these in this order; … is a gap
  notation~"[handshape] hamthumb*"        a class; names that begin so
  notation="hamfist …"   notation=*       the whole notation; any notation

Keys of cued speech, placement before shape
  cue=24 meets cue=31   cue=mouth-4   cue.shape=5 cue.placement=throat
  cue.phase>100                           milliseconds from the sound to the hand

The token as a whole
  origin=captured,made,lexicon,generated
  hand=right,left,dominant,weak,both      of its annotation, else of its values
  signer=  recording=  sign=  token=  tier=  inventory=
  lexicon=NGT   file=ngt.csv              whose sign it is; where it came from
  language=dse                            its sign language, by ISO 639-3

Who says so: proposals and disputed values are read only where asked for
  proposed:yes                            a detector proposes something
  disputed:yes                            annotators say different things
  by=anna   by=detector   confidence>0.8  who, and how sure
  configuration=U{by=anna}                who says this very value
  placement=*{proposed:yes}               any of these four in the braces

Relation to another annotation of the recording
  gloss=CHAT overlaps nonmanual.brows=raised
  before gloss=CHIEN   not overlaps tier("Mouthing")=ma*
  overlaps  not-overlaps  inside  not-inside  overlaps-begin  overlaps-end
  before  after  within 0.5s around  within 0.5s of-begin  within 0.5s of-end
  equals  meets  met-by  starts  started-by  finishes  finished-by  covers

By example
  like token:41   like CHAT on configuration:2, placement
  like token:41 on configuration above 0.6    only more similar tokens

Saved searches, anywhere in a query
  @chin not @short   @"my search" or gloss=CHAT

French works, too: et, ou, non, chevauche, avant, après, dans, couvre.
Everyday words that find nothing, such as handshape U placement chin,
lead to a suggested query.
"#;

impl TokenQuery {
    /// Reads a query as people write it; nothing but blanks asks for every token.
    ///
    /// # Errors
    /// [`QueryError`] with the place of the first thing that cannot be understood.
    pub fn parse_query(text: &str) -> Result<Self, QueryError> {
        query_parse::parse_whole_query(text)
    }
}

impl FromStr for TokenQuery {
    type Err = QueryError;
    fn from_str(text: &str) -> Result<Self, QueryError> {
        Self::parse_query(text)
    }
}
