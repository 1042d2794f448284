-- Searches that people keep under a name.

CREATE TABLE kept_search (
    id    INTEGER PRIMARY KEY,
    uid   BLOB NOT NULL DEFAULT (randomblob(16)),
    name  TEXT NOT NULL UNIQUE,
    query TEXT NOT NULL
) STRICT;
