# Der Name, den die Sprache sich selbst gibt, für die Wahl der Sprache.
language-name = Deutsch
