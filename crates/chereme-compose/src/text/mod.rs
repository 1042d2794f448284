//! The text spelling of a recipe.

mod lexer;
#[cfg(test)]
mod tests;
mod text_parse;
mod text_print;

pub(crate) use text_parse::{ParsedText, RecipeParser};
pub(crate) use text_print::{QuotedName, point_text, write_option, write_separated_list};
