-- Every person whom the corpus knows is a row of the table of signers: who signs, who takes part, who annotates. Other
-- names under which files know a person, and what the corpus says of people, with an audience of its own.

CREATE TABLE person_alias (
    id        INTEGER PRIMARY KEY,
    uid       BLOB NOT NULL DEFAULT (randomblob(16)),
    signer_id INTEGER NOT NULL REFERENCES signer (id),
    name      TEXT NOT NULL UNIQUE
) STRICT;
CREATE INDEX person_alias_signer ON person_alias (signer_id);

CREATE TABLE person_attribute (
    id        INTEGER PRIMARY KEY,
    uid       BLOB NOT NULL DEFAULT (randomblob(16)),
    signer_id INTEGER NOT NULL REFERENCES signer (id),
    name      TEXT NOT NULL,
    text      TEXT NOT NULL,
    number    REAL,
    audience  TEXT NOT NULL DEFAULT 'nobody' CHECK (audience IN ('public', 'research', 'nobody')),
    UNIQUE (signer_id, name)
) STRICT;
CREATE INDEX person_attribute_name ON person_attribute (name);

CREATE INDEX tier_participant ON tier (participant) WHERE participant IS NOT NULL;
CREATE INDEX tier_annotator ON tier (annotator) WHERE annotator IS NOT NULL;

INSERT OR IGNORE INTO signer (name)
    SELECT participant FROM tier WHERE trim(coalesce(participant, '')) <> '' GROUP BY participant ORDER BY participant;
INSERT OR IGNORE INTO signer (name)
    SELECT annotator FROM tier WHERE trim(coalesce(annotator, '')) <> '' AND annotator <> 'adjudication'
    GROUP BY annotator ORDER BY annotator;
