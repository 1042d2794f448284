//! Texts of the notices after actions; the names of actions are in the table of actions.

texts! {
    NO_RECIPE: "The stage does not show a generated sign. Choose one in the library first.", "Ce qui est montré n’a pas été composé par une recette. Choisissez d’abord un signe composé dans le fonds.";
}
