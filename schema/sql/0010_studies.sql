-- Perceptual studies: the plan of each, its participants, and their answers, one a row.

CREATE TABLE study (
    id          INTEGER PRIMARY KEY,
    uid         BLOB NOT NULL DEFAULT (randomblob(16)),
    name        TEXT NOT NULL UNIQUE,
    plan        TEXT NOT NULL CHECK (json_valid(plan)),
    plan_sha256 TEXT NOT NULL
) STRICT;

CREATE TABLE study_participant (
    id          INTEGER PRIMARY KEY,
    uid         BLOB NOT NULL DEFAULT (randomblob(16)),
    study_id    INTEGER NOT NULL REFERENCES study (id),
    code        TEXT NOT NULL,
    started_day TEXT NOT NULL,
    language    TEXT NOT NULL,
    seed        INTEGER NOT NULL,
    finished    INTEGER NOT NULL CHECK (finished IN (0, 1)),
    profile     TEXT NOT NULL CHECK (json_valid(profile)),
    consent     TEXT NOT NULL CHECK (json_valid(consent)),
    device      TEXT NOT NULL CHECK (json_valid(device)),
    UNIQUE (study_id, code)
) STRICT;

CREATE TABLE study_answer (
    id             INTEGER PRIMARY KEY,
    uid            BLOB NOT NULL DEFAULT (randomblob(16)),
    participant_id INTEGER NOT NULL REFERENCES study_participant (id),
    n              INTEGER NOT NULL,
    block          INTEGER NOT NULL,
    part           TEXT NOT NULL,
    item           TEXT NOT NULL,
    condition      TEXT NOT NULL,
    role           TEXT NOT NULL CHECK (role IN ('training', 'main', 'check')),
    question       TEXT NOT NULL,
    low            INTEGER,
    high           INTEGER,
    value          INTEGER,
    choice         TEXT,
    right          INTEGER CHECK (right IN (0, 1)),
    plays          INTEGER NOT NULL,
    ms             INTEGER NOT NULL,
    hidden         INTEGER NOT NULL,
    slow           INTEGER NOT NULL,
    UNIQUE (participant_id, n, question)
) STRICT;
