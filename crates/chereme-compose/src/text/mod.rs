//! The text spelling of a recipe.

mod lexer;
mod parse;
mod print;
#[cfg(test)]
mod tests;

pub(crate) use parse::{Parsed, Parser};
pub(crate) use print::{Name, list, option, point_text};
