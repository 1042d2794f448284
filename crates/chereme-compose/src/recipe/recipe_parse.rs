//! Parses a recipe's text into the tree.

use std::str::FromStr;

use super::{JoinedPiece, OperatorPipe, Recipe, RecipeChain, RecipeNode, Step};
use crate::error::RecipeError;
use crate::text::{ParsedText, RecipeParser, RecipeTokenKind};

impl FromStr for Recipe {
    type Err = RecipeError;

    fn from_str(text: &str) -> Result<Self, RecipeError> {
        let mut parser = RecipeParser::for_recipe_text(text)?;
        let root = parse_sequence(&mut parser)?;
        if !parser.is_at_text_end() {
            return Err(parser
                .expected_text_error("\"|\", \"then\" or the end", &["then"])
                .into());
        }
        Self::new(root)
    }
}

fn parse_sequence(parser: &mut RecipeParser<'_>) -> ParsedText<RecipeNode> {
    parser.enter_parentheses()?;
    let first = parse_pipe(parser)?;
    let mut next = Vec::new();
    while parser.accept_word("then") {
        let via = parser.parse_transition()?.unwrap_or_default();
        let node = parse_pipe(parser)?;
        next.push(JoinedPiece { via, node });
    }
    parser.leave_parentheses();
    Ok(if next.is_empty() {
        first
    } else {
        RecipeNode::Then(RecipeChain {
            first: Box::new(first),
            next,
        })
    })
}

fn parse_pipe(parser: &mut RecipeParser<'_>) -> ParsedText<RecipeNode> {
    let of = parse_source(parser)?;
    let mut steps = Vec::new();
    while parser.accept_kind(RecipeTokenKind::Pipe) {
        steps.push(parse_operator_step(parser)?);
    }
    Ok(if steps.is_empty() {
        of
    } else {
        RecipeNode::Pipe(OperatorPipe {
            of: Box::new(of),
            steps,
        })
    })
}

fn parse_source(parser: &mut RecipeParser<'_>) -> ParsedText<RecipeNode> {
    if parser.accept_kind(RecipeTokenKind::Open) {
        let inside = parse_sequence(parser)?;
        if !parser.accept_kind(RecipeTokenKind::Close) {
            return Err(parser.expected_text_error("\")\"", &[]));
        }
        return Ok(inside);
    }
    if parser.accept_word("spell") {
        return parser.parse_spell_settings().map(RecipeNode::Spell);
    }
    if parser.accept_word("point") {
        return parser.parse_point_settings().map(RecipeNode::Point);
    }
    if parser.accept_word("cue") {
        return parser.parse_cue_settings().map(RecipeNode::Cue);
    }
    if parser.accept_word("hamnosys") {
        let notation = parser.parse_notation_settings("the symbols of a sign, in quotes");
        return notation.map(RecipeNode::Hamnosys);
    }
    if parser.accept_word("sigml") {
        let notation = parser.parse_notation_settings("a SiGML file or a notated sign");
        return notation.map(RecipeNode::Sigml);
    }
    if parser
        .current_word()
        .is_some_and(|word| Step::operator_first_words().contains(&word))
    {
        return Err(parser.expected_text_error("a sign, \"spell\", \"point\" or \"(\"", &[]));
    }
    parser
        .parse_recipe_name("a sign, \"spell\", \"point\" or \"(\"")
        .map(RecipeNode::Sign)
}

fn parse_operator_step(parser: &mut RecipeParser<'_>) -> ParsedText<Step> {
    if let Some(word) = parser.current_word().map(str::to_owned) {
        let word_position = parser.parser_position();
        parser.accept_word(&word);
        if let Some(step) = Step::parse(parser, &word) {
            return step;
        }
        parser.back_to(word_position);
    }
    Err(parser.expected_text_error("an operator", &Step::operator_first_words()))
}
