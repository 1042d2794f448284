-- Relations between signs: variants, homonyms, parts of compounds, signs that differ in the handshape alone. Each is stored
-- once; read from the other end it has the inverse name.

CREATE TABLE relation_kind (
    name    TEXT PRIMARY KEY,
    inverse TEXT NOT NULL,
    note    TEXT NOT NULL
) STRICT;
INSERT INTO relation_kind (name, inverse, note) VALUES
    ('antonym', 'antonym', 'of the opposite meaning'),
    ('compound-of', 'part-of', 'a compound with the other sign as one of its parts'),
    ('derived-from', 'source-of', 'made from the other sign'),
    ('homonym', 'homonym', 'of the same form, with another meaning'),
    ('hyponym-of', 'hypernym-of', 'a kind of what the other sign means'),
    ('paradigm', 'paradigm', 'of the same form but for the handshape, as numerals and initialised signs'),
    ('see-also', 'see-also', 'of interest with the other sign'),
    ('synonym', 'synonym', 'of the same meaning, with another form'),
    ('variant', 'variant', 'another form of the same sign');

CREATE TABLE sign_relation (
    id         INTEGER PRIMARY KEY,
    uid        BLOB NOT NULL DEFAULT (randomblob(16)),
    sign_id    INTEGER NOT NULL REFERENCES sign (id),
    kind       TEXT NOT NULL REFERENCES relation_kind (name),
    related_id INTEGER NOT NULL REFERENCES sign (id),
    position   INTEGER NOT NULL DEFAULT 1 CHECK (position > 0),
    source     TEXT,
    CHECK (sign_id <> related_id),
    UNIQUE (sign_id, kind, related_id, position)
) STRICT;
CREATE INDEX sign_relation_related ON sign_relation (related_id);
