-- What a lexicon table says of a sign beyond its components: frequency, iconicity, word class.

CREATE TABLE attribute (
    id       INTEGER PRIMARY KEY,
    uid      BLOB NOT NULL DEFAULT (randomblob(16)),
    token_id INTEGER NOT NULL REFERENCES token (id),
    name     TEXT NOT NULL,
    text     TEXT NOT NULL,
    number   REAL,
    UNIQUE (token_id, name)
) STRICT;
CREATE INDEX attribute_name ON attribute (name, number);
