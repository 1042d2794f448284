-- Tracks of every kind on one clock: movement of skeletons, markers, curves, media. The kinds of tracks and the
-- groups in which numbers are stored are rows, no longer lists in the schema.

CREATE TABLE track_kind (
    name TEXT NOT NULL PRIMARY KEY,
    note TEXT NOT NULL
) STRICT, WITHOUT ROWID;
INSERT INTO track_kind (name, note) VALUES
    ('skeleton', 'rotations and places of joints'),
    ('markers', 'named points in a room or on a picture'),
    ('curves', 'named scalar channels'),
    ('media', 'a film, sound or picture next to the corpus');

CREATE TABLE channel_group (
    name TEXT NOT NULL PRIMARY KEY,
    note TEXT NOT NULL
) STRICT, WITHOUT ROWID;
INSERT INTO channel_group (name, note) VALUES
    ('right-hand', 'the joints below the right wrist'),
    ('left-hand', 'the joints below the left wrist'),
    ('right-arm', 'from the right collar bone to the wrist'),
    ('left-arm', 'from the left collar bone to the wrist'),
    ('head', 'neck, head and all above'),
    ('rest', 'every other joint'),
    ('curves', 'scalar channels'),
    ('points', 'places of points'),
    ('time', 'the time of each frame in seconds');

CREATE TABLE track_7 (
    id              INTEGER PRIMARY KEY,
    uid             BLOB NOT NULL DEFAULT (randomblob(16)),
    recording_id    INTEGER NOT NULL REFERENCES recording (id),
    kind            TEXT NOT NULL REFERENCES track_kind (name),
    name            TEXT NOT NULL,
    offset_us       INTEGER NOT NULL DEFAULT 0,
    duration_us     INTEGER CHECK (duration_us >= 0),
    skeleton_id     INTEGER REFERENCES skeleton (id),
    frames          INTEGER CHECK (frames >= 0),
    rate_frames     INTEGER CHECK (rate_frames > 0),
    rate_seconds    INTEGER CHECK (rate_seconds > 0),
    frame_time      TEXT,
    metres_per_unit REAL CHECK (metres_per_unit > 0),
    axes            TEXT,
    root_order      TEXT CHECK (root_order IN ('rotation-before-position')),
    root_scale      REAL CHECK (root_scale > 0),
    roles           TEXT CHECK (json_valid(roles)),
    channel_groups  TEXT CHECK (json_valid(channel_groups)),
    layout          TEXT CHECK (json_valid(layout)),
    media_url       TEXT,
    media_type      TEXT,
    UNIQUE (recording_id, name)
) STRICT;
INSERT INTO track_7
    SELECT id, uid, recording_id, kind, name, offset_us,
           CAST(round(frames * 1000000.0 * rate_seconds / rate_frames) AS INTEGER),
           skeleton_id, frames, rate_frames, rate_seconds, frame_time, metres_per_unit, axes,
           root_order, root_scale, roles, channel_groups, NULL, media_url, media_type
    FROM track;

CREATE TABLE track_block_7 (
    id            INTEGER PRIMARY KEY,
    track_id      INTEGER NOT NULL REFERENCES track_7 (id),
    channel_group TEXT NOT NULL REFERENCES channel_group (name),
    first_frame   INTEGER NOT NULL CHECK (first_frame >= 0),
    frames        INTEGER NOT NULL CHECK (frames > 0),
    hash          BLOB NOT NULL REFERENCES block (hash),
    UNIQUE (track_id, channel_group, first_frame)
) STRICT;
INSERT INTO track_block_7
    SELECT id, track_id, channel_group, first_frame, frames, hash FROM track_block;

-- The points of markers and the channels of curves.
CREATE TABLE channel (
    id            INTEGER PRIMARY KEY,
    uid           BLOB NOT NULL DEFAULT (randomblob(16)),
    track_id      INTEGER NOT NULL REFERENCES track_7 (id),
    position      INTEGER NOT NULL CHECK (position >= 0),
    channel_group TEXT NOT NULL REFERENCES channel_group (name),
    part          TEXT NOT NULL DEFAULT '',
    name          TEXT NOT NULL CHECK (name <> ''),
    unit          TEXT NOT NULL DEFAULT '',
    columns       INTEGER NOT NULL DEFAULT 1 CHECK (columns > 0),
    UNIQUE (track_id, position),
    UNIQUE (track_id, part, name)
) STRICT;

-- The program turns these into tracks and channels, in the history too, and drops them.
CREATE TABLE old_curve AS SELECT id, uid, track_id, position, name FROM curve;
CREATE TABLE old_curve_block AS SELECT id, track_id, first_frame, frames, hash FROM curve_block;

DROP TABLE curve_block;
DROP TABLE curve;
DROP TABLE track_block;
DROP TABLE track;
ALTER TABLE track_7 RENAME TO track;
ALTER TABLE track_block_7 RENAME TO track_block;
CREATE INDEX track_skeleton ON track (skeleton_id);
CREATE INDEX track_kind_tracks ON track (kind);
CREATE INDEX track_block_hash ON track_block (hash);
