-- A sign is an entry of a lexicon: two lexicons have a sign of one gloss each. The table of signs is built again under
-- another name and takes the place of the old one; the checks of foreign keys are off meanwhile. Which lexicons the
-- signs of an older file belong to is worked out by the program.

CREATE TABLE lexicon (
    id       INTEGER PRIMARY KEY,
    uid      BLOB NOT NULL DEFAULT (randomblob(16)),
    name     TEXT NOT NULL UNIQUE,
    language TEXT,
    version  TEXT,
    terms    TEXT,
    citation TEXT,
    notes    TEXT
) STRICT;

CREATE TABLE sign_14 (
    id         INTEGER PRIMARY KEY,
    uid        BLOB NOT NULL DEFAULT (randomblob(16)),
    lexicon_id INTEGER REFERENCES lexicon (id),
    gloss      TEXT NOT NULL,
    notes      TEXT
) STRICT;
INSERT INTO sign_14 (id, uid, gloss, notes) SELECT id, uid, gloss, notes FROM sign;
DROP TABLE sign;
ALTER TABLE sign_14 RENAME TO sign;
CREATE UNIQUE INDEX sign_entry ON sign (gloss, ifnull(lexicon_id, 0));
CREATE INDEX sign_lexicon ON sign (lexicon_id) WHERE lexicon_id IS NOT NULL;
CREATE TRIGGER search_sign_update AFTER UPDATE ON sign
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_lexicon_update AFTER UPDATE ON lexicon
    BEGIN UPDATE search_state SET content = content + 1; END;

CREATE TRIGGER search_source_insert AFTER INSERT ON source_file WHEN NEW.recording_id IS NOT NULL
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_source_delete AFTER DELETE ON source_file WHEN OLD.recording_id IS NOT NULL
    BEGIN UPDATE search_state SET content = content + 1; END;

ALTER TABLE recording ADD COLUMN lexicon_id INTEGER REFERENCES lexicon (id);
CREATE INDEX recording_lexicon ON recording (lexicon_id) WHERE lexicon_id IS NOT NULL;
ALTER TABLE source_file ADD COLUMN lexicon_id INTEGER REFERENCES lexicon (id);
CREATE INDEX source_file_lexicon ON source_file (lexicon_id) WHERE lexicon_id IS NOT NULL;
