-- What is said of a token and does not count: a person rejected the proposal, it says the same as the value that counts, or
-- another annotator's value counts in its place. Without a standing it is proposed if a detector wrote its annotation,
-- else disputed.

ALTER TABLE token_value ADD COLUMN standing TEXT CHECK (standing IN ('rejected', 'agreed', 'replaced'));
