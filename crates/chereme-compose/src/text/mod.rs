//! The words of a recipe's text: names, quantities and the settings that sources and operators share.

mod lexer;
mod text_parse;
mod text_print;

pub(crate) use lexer::RecipeTokenKind;
pub(crate) use text_parse::{ParsedText, RecipeParser};
pub(crate) use text_print::{QuotedName, point_text, quote_recipe_text, write_option, write_separated_list};
