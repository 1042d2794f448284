-- What is said of a token and does not count says why: a detector proposes it, a person rejected the proposal, annotators
-- dispute it, it says the same as the value that counts, or another annotator's value counts in its place. Rows of an
-- older program have no standing: they are proposed if a detector wrote their annotation, else disputed.

ALTER TABLE token_value ADD COLUMN standing TEXT
    CHECK (standing IN ('proposed', 'rejected', 'disputed', 'agreed', 'replaced'));
