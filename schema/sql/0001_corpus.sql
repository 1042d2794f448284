-- A Chereme corpus. README.md beside the sql folder explains every table to a reader.
-- Times are microseconds from the start of the recording; spans hold their start and not their end.
-- Every uid is 16 random bytes: the name of a row that no other machine can give to another row.

CREATE TABLE meta (
    key   TEXT NOT NULL PRIMARY KEY,
    value TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE signer (
    id         INTEGER PRIMARY KEY,
    uid        BLOB NOT NULL DEFAULT (randomblob(16)),
    name       TEXT NOT NULL UNIQUE,
    handedness TEXT CHECK (handedness IN ('right', 'left')),
    notes      TEXT
) STRICT;

CREATE TABLE skeleton (
    id       INTEGER PRIMARY KEY,
    uid      BLOB NOT NULL DEFAULT (randomblob(16)),
    hash     TEXT NOT NULL UNIQUE,
    joints   INTEGER NOT NULL CHECK (joints > 0),
    document TEXT NOT NULL CHECK (json_valid(document))
) STRICT;

CREATE TABLE recording (
    id          INTEGER PRIMARY KEY,
    uid         BLOB NOT NULL DEFAULT (randomblob(16)),
    name        TEXT NOT NULL UNIQUE,
    signer_id   INTEGER REFERENCES signer (id),
    origin      TEXT NOT NULL CHECK (origin IN ('captured', 'made', 'generated')),
    duration_us INTEGER NOT NULL DEFAULT 0 CHECK (duration_us >= 0),
    licence     TEXT,
    notes       TEXT
) STRICT;
CREATE INDEX recording_signer ON recording (signer_id);

CREATE TABLE track (
    id              INTEGER PRIMARY KEY,
    uid             BLOB NOT NULL DEFAULT (randomblob(16)),
    recording_id    INTEGER NOT NULL REFERENCES recording (id),
    kind            TEXT NOT NULL CHECK (kind IN ('skeleton', 'media')),
    name            TEXT NOT NULL,
    offset_us       INTEGER NOT NULL DEFAULT 0,
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
    media_url       TEXT,
    media_type      TEXT,
    UNIQUE (recording_id, name)
) STRICT;
CREATE INDEX track_skeleton ON track (skeleton_id);

-- The files that rows came from; small ones are kept whole, compressed with zstd.
CREATE TABLE source_file (
    id           INTEGER PRIMARY KEY,
    uid          BLOB NOT NULL DEFAULT (randomblob(16)),
    recording_id INTEGER REFERENCES recording (id),
    kind         TEXT NOT NULL CHECK (kind IN ('bvh', 'eaf', 'lexicon', 'inventory')),
    name         TEXT NOT NULL,
    hash         TEXT NOT NULL,
    data         BLOB
) STRICT;
CREATE INDEX source_file_recording ON source_file (recording_id);
CREATE INDEX source_file_hash ON source_file (hash);

-- Numbers of motion, never changed: a block is named by the SHA-256 of its bytes.
CREATE TABLE block (
    hash BLOB NOT NULL PRIMARY KEY CHECK (length(hash) = 32),
    data BLOB NOT NULL
) STRICT;

CREATE TABLE track_block (
    id            INTEGER PRIMARY KEY,
    track_id      INTEGER NOT NULL REFERENCES track (id),
    channel_group TEXT NOT NULL CHECK (channel_group IN
                      ('right-hand', 'left-hand', 'right-arm', 'left-arm', 'head', 'rest')),
    first_frame   INTEGER NOT NULL CHECK (first_frame >= 0),
    frames        INTEGER NOT NULL CHECK (frames > 0),
    hash          BLOB NOT NULL REFERENCES block (hash),
    UNIQUE (track_id, channel_group, first_frame)
) STRICT;
CREATE INDEX track_block_hash ON track_block (hash);

CREATE TABLE inventory (
    id        INTEGER PRIMARY KEY,
    uid       BLOB NOT NULL DEFAULT (randomblob(16)),
    key       TEXT NOT NULL UNIQUE,
    component TEXT NOT NULL CHECK (component IN
                  ('configuration', 'placement', 'movement', 'orientation', 'nonmanual')),
    feature   TEXT,
    document  TEXT NOT NULL CHECK (json_valid(document))
) STRICT;

CREATE TABLE inventory_value (
    id           INTEGER PRIMARY KEY,
    uid          BLOB NOT NULL DEFAULT (randomblob(16)),
    inventory_id INTEGER NOT NULL REFERENCES inventory (id),
    key          TEXT NOT NULL,
    position     INTEGER NOT NULL,
    document     TEXT NOT NULL CHECK (json_valid(document)),
    UNIQUE (inventory_id, key)
) STRICT;

CREATE TABLE tier (
    id           INTEGER PRIMARY KEY,
    uid          BLOB NOT NULL DEFAULT (randomblob(16)),
    recording_id INTEGER NOT NULL REFERENCES recording (id),
    name         TEXT NOT NULL,
    position     INTEGER NOT NULL,
    parent_id    INTEGER REFERENCES tier (id),
    stereotype   TEXT CHECK (stereotype IN ('Time_Subdivision', 'Included_In',
                     'Symbolic_Subdivision', 'Symbolic_Association')),
    role         TEXT NOT NULL CHECK (role IN
                     ('gloss', 'component', 'translation', 'comment', 'free')),
    component    TEXT CHECK (component IN
                     ('configuration', 'placement', 'movement', 'orientation', 'nonmanual')),
    feature      TEXT,
    hand         TEXT CHECK (hand IN ('right', 'left', 'dominant', 'weak', 'both')),
    participant  TEXT,
    annotator    TEXT,
    language     TEXT,
    inventory_id INTEGER REFERENCES inventory (id),
    source       TEXT CHECK (json_valid(source)),
    UNIQUE (recording_id, name),
    CHECK ((parent_id IS NULL) = (stereotype IS NULL)),
    CHECK ((component IS NOT NULL) = (role = 'component'))
) STRICT;
CREATE INDEX tier_parent ON tier (parent_id) WHERE parent_id IS NOT NULL;
CREATE INDEX tier_inventory ON tier (inventory_id) WHERE inventory_id IS NOT NULL;

CREATE TABLE annotation (
    id            INTEGER PRIMARY KEY,
    uid           BLOB NOT NULL DEFAULT (randomblob(16)),
    tier_id       INTEGER NOT NULL REFERENCES tier (id),
    start_us      INTEGER NOT NULL,
    end_us        INTEGER NOT NULL,
    state         TEXT NOT NULL DEFAULT 'value'
                      CHECK (state IN ('value', 'unset', 'not-applicable', 'unclear')),
    value         TEXT NOT NULL DEFAULT '',
    parent_id     INTEGER REFERENCES annotation (id),
    position      INTEGER NOT NULL DEFAULT 0 CHECK (position >= 0),
    origin        TEXT NOT NULL CHECK (origin IN ('file', 'human', 'detector', 'made')),
    confidence    REAL CHECK (confidence BETWEEN 0 AND 1),
    external_id   TEXT,
    file_start_ms INTEGER,
    file_end_ms   INTEGER,
    source        TEXT CHECK (json_valid(source)),
    CHECK (start_us <= end_us)
) STRICT;
CREATE INDEX annotation_tier ON annotation (tier_id, start_us);
-- The longest of a tier bounds how far before a moment one can start that still goes on there.
CREATE INDEX annotation_length ON annotation (tier_id, end_us - start_us);
CREATE INDEX annotation_external ON annotation (external_id) WHERE external_id IS NOT NULL;
CREATE INDEX annotation_parent ON annotation (parent_id) WHERE parent_id IS NOT NULL;

CREATE TABLE sign (
    id    INTEGER PRIMARY KEY,
    uid   BLOB NOT NULL DEFAULT (randomblob(16)),
    gloss TEXT NOT NULL UNIQUE,
    notes TEXT
) STRICT;

CREATE TABLE sign_text (
    id       INTEGER PRIMARY KEY,
    sign_id  INTEGER NOT NULL REFERENCES sign (id),
    language TEXT NOT NULL,
    text     TEXT NOT NULL,
    UNIQUE (sign_id, language, text)
) STRICT;

CREATE TABLE token (
    id            INTEGER PRIMARY KEY,
    uid           BLOB NOT NULL DEFAULT (randomblob(16)),
    sign_id       INTEGER NOT NULL REFERENCES sign (id),
    recording_id  INTEGER REFERENCES recording (id),
    annotation_id INTEGER UNIQUE REFERENCES annotation (id),
    start_us      INTEGER,
    end_us        INTEGER,
    hand          TEXT CHECK (hand IN ('right', 'left', 'dominant', 'weak', 'both')),
    origin        TEXT NOT NULL CHECK (origin IN ('captured', 'made', 'generated', 'lexicon')),
    citation      INTEGER NOT NULL DEFAULT 0 CHECK (citation IN (0, 1)),
    source        TEXT CHECK (json_valid(source)),
    CHECK ((recording_id IS NULL) = (start_us IS NULL)),
    CHECK ((start_us IS NULL) = (end_us IS NULL)),
    CHECK (start_us <= end_us)
) STRICT;
CREATE INDEX token_sign ON token (sign_id);
CREATE INDEX token_citation ON token (sign_id) WHERE citation = 1;
CREATE INDEX token_recording ON token (recording_id, start_us) WHERE recording_id IS NOT NULL;
CREATE INDEX token_length ON token (recording_id, end_us - start_us)
    WHERE recording_id IS NOT NULL;

CREATE TABLE token_value (
    id            INTEGER PRIMARY KEY,
    token_id      INTEGER NOT NULL REFERENCES token (id),
    hand          TEXT CHECK (hand IN ('right', 'left', 'dominant', 'weak', 'both')),
    component     TEXT NOT NULL CHECK (component IN
                      ('configuration', 'placement', 'movement', 'orientation', 'nonmanual')),
    feature       TEXT,
    phase         TEXT CHECK (phase IN ('initial', 'middle', 'final')),
    position      INTEGER NOT NULL DEFAULT 0,
    state         TEXT NOT NULL CHECK (state IN ('value', 'unset', 'not-applicable', 'unclear')),
    value         TEXT CHECK ((value IS NOT NULL) = (state = 'value')),
    inventory_id  INTEGER REFERENCES inventory (id),
    annotation_id INTEGER REFERENCES annotation (id)
) STRICT;
CREATE INDEX token_value_token ON token_value (token_id);
CREATE INDEX token_value_value ON token_value (component, value);
CREATE INDEX token_value_annotation ON token_value (annotation_id) WHERE annotation_id IS NOT NULL;

CREATE TABLE recipe (
    id           INTEGER PRIMARY KEY,
    uid          BLOB NOT NULL DEFAULT (randomblob(16)),
    recording_id INTEGER NOT NULL UNIQUE REFERENCES recording (id),
    text         TEXT NOT NULL,
    document     TEXT NOT NULL CHECK (json_valid(document)),
    report       TEXT NOT NULL CHECK (json_valid(report)),
    engine       TEXT NOT NULL
) STRICT;

CREATE TABLE recipe_input (
    id           INTEGER PRIMARY KEY,
    recipe_id    INTEGER NOT NULL REFERENCES recipe (id),
    address      TEXT NOT NULL,
    recording_id INTEGER REFERENCES recording (id),
    token_id     INTEGER REFERENCES token (id) ON DELETE SET NULL,
    hash         TEXT NOT NULL
) STRICT;
CREATE INDEX recipe_input_recipe ON recipe_input (recipe_id);
CREATE INDEX recipe_input_recording ON recipe_input (recording_id);

-- History. kind 'undo' takes back what operation `target` did, 'redo' does it again.
CREATE TABLE operation (
    id      INTEGER PRIMARY KEY,
    uid     BLOB NOT NULL DEFAULT (randomblob(16)),
    at      TEXT NOT NULL,
    author  TEXT NOT NULL,
    kind    TEXT NOT NULL CHECK (kind IN ('do', 'undo', 'redo')),
    target  INTEGER REFERENCES operation (id),
    name    TEXT NOT NULL,
    summary TEXT NOT NULL,
    changes INTEGER NOT NULL,
    CHECK ((target IS NULL) = (kind = 'do'))
) STRICT;

CREATE TABLE changeset (
    operation_id INTEGER NOT NULL REFERENCES operation (id),
    part         INTEGER NOT NULL,
    data         BLOB NOT NULL,
    PRIMARY KEY (operation_id, part)
) STRICT, WITHOUT ROWID;

-- The search index: derived, and made anew whenever the two counters differ.
CREATE TABLE search_file (
    path TEXT NOT NULL PRIMARY KEY,
    data BLOB NOT NULL
) STRICT;

CREATE TABLE search_state (
    id      INTEGER PRIMARY KEY CHECK (id = 1),
    content INTEGER NOT NULL,
    indexed INTEGER NOT NULL,
    format  INTEGER NOT NULL
) STRICT;
INSERT INTO search_state (id, content, indexed, format) VALUES (1, 0, 0, 0);

CREATE TRIGGER search_token_insert AFTER INSERT ON token
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_token_update AFTER UPDATE ON token
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_token_delete AFTER DELETE ON token
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_value_insert AFTER INSERT ON token_value
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_value_update AFTER UPDATE ON token_value
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_value_delete AFTER DELETE ON token_value
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_text_insert AFTER INSERT ON sign_text
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_text_update AFTER UPDATE ON sign_text
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_text_delete AFTER DELETE ON sign_text
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_annotation_insert AFTER INSERT ON annotation
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_annotation_update AFTER UPDATE ON annotation
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_annotation_delete AFTER DELETE ON annotation
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_sign_update AFTER UPDATE ON sign
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_tier_update AFTER UPDATE ON tier
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_recording_update AFTER UPDATE ON recording
    BEGIN UPDATE search_state SET content = content + 1; END;
CREATE TRIGGER search_signer_update AFTER UPDATE ON signer
    BEGIN UPDATE search_state SET content = content + 1; END;
