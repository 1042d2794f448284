-- Scalar curves beside a skeleton's movement, such as how much there is of each non-manual.

CREATE TABLE curve (
    id       INTEGER PRIMARY KEY,
    uid      BLOB NOT NULL DEFAULT (randomblob(16)),
    track_id INTEGER NOT NULL REFERENCES track (id),
    position INTEGER NOT NULL CHECK (position >= 0),
    name     TEXT NOT NULL,
    UNIQUE (track_id, position),
    UNIQUE (track_id, name)
) STRICT;

CREATE TABLE curve_block (
    id          INTEGER PRIMARY KEY,
    track_id    INTEGER NOT NULL REFERENCES track (id),
    first_frame INTEGER NOT NULL CHECK (first_frame >= 0),
    frames      INTEGER NOT NULL CHECK (frames > 0),
    hash        BLOB NOT NULL REFERENCES block (hash),
    UNIQUE (track_id, first_frame)
) STRICT;
CREATE INDEX curve_block_hash ON curve_block (hash);
