# The language's own name for itself, for the choice of languages.
language-name = English
