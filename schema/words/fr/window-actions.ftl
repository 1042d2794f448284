## Texts of the notices after actions; the names of actions are in the table of actions.

window-actions-no-recipe = Ce qui est montré n’a pas été composé par une recette. Choisissez d’abord un signe composé dans le fonds.
