-- The roles of tiers are rows, which the program writes, no longer a list in the schema. The table is built again under
-- another name and takes the place of the old one; the checks of foreign keys are off meanwhile.

CREATE TABLE tier_role (
    name TEXT NOT NULL PRIMARY KEY,
    note TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE tier_9 (
    id           INTEGER PRIMARY KEY,
    uid          BLOB NOT NULL DEFAULT (randomblob(16)),
    recording_id INTEGER NOT NULL REFERENCES recording (id),
    name         TEXT NOT NULL,
    position     INTEGER NOT NULL,
    parent_id    INTEGER REFERENCES tier_9 (id),
    stereotype   TEXT CHECK (stereotype IN ('Time_Subdivision', 'Included_In',
                     'Symbolic_Subdivision', 'Symbolic_Association')),
    role         TEXT NOT NULL REFERENCES tier_role (name),
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
INSERT INTO tier_9
    SELECT id, uid, recording_id, name, position, parent_id, stereotype, role, component, feature, hand,
           participant, annotator, language, inventory_id, source
    FROM tier;
DROP TABLE tier;
ALTER TABLE tier_9 RENAME TO tier;
CREATE INDEX tier_parent ON tier (parent_id) WHERE parent_id IS NOT NULL;
CREATE INDEX tier_inventory ON tier (inventory_id) WHERE inventory_id IS NOT NULL;
CREATE TRIGGER search_tier_update AFTER UPDATE ON tier
    BEGIN UPDATE search_state SET content = content + 1; END;
