//! Recipes to movement: recombination and synthesis.
