//! The text spelling of a recipe.

mod lexer;
mod parse;
mod print;
#[cfg(test)]
mod tests;
