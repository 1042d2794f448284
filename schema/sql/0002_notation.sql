-- Signs as notation, HamNoSys and SiGML, and the files that it came from.

-- A file of notation is of a kind of its own.
CREATE TABLE source_file_2 (
    id           INTEGER PRIMARY KEY,
    uid          BLOB NOT NULL DEFAULT (randomblob(16)),
    recording_id INTEGER REFERENCES recording (id),
    kind         TEXT NOT NULL CHECK (kind IN ('bvh', 'eaf', 'lexicon', 'inventory', 'sigml')),
    name         TEXT NOT NULL,
    hash         TEXT NOT NULL,
    data         BLOB
) STRICT;
INSERT INTO source_file_2 SELECT id, uid, recording_id, kind, name, hash, data FROM source_file;
DROP TABLE source_file;
ALTER TABLE source_file_2 RENAME TO source_file;
CREATE INDEX source_file_recording ON source_file (recording_id);
CREATE INDEX source_file_hash ON source_file (hash);
CREATE INDEX source_file_name ON source_file (name);

CREATE TABLE notation (
    id             INTEGER PRIMARY KEY,
    uid            BLOB NOT NULL DEFAULT (randomblob(16)),
    token_id       INTEGER NOT NULL UNIQUE REFERENCES token (id),
    source_file_id INTEGER REFERENCES source_file (id),
    line           INTEGER CHECK (line > 0),
    system         TEXT NOT NULL CHECK (system IN ('hamnosys', 'sigml')),
    text           TEXT,
    document       TEXT NOT NULL CHECK (json_valid(document))
) STRICT;
CREATE INDEX notation_source_file ON notation (source_file_id) WHERE source_file_id IS NOT NULL;
