## Texts of the notices after actions; the names of actions are in the table of actions.

window-actions-no-recipe = The stage does not show a generated sign. Choose one in the library first.
