-- The meanings that a user's mapping gave to columns of an imported table, and checksums by which damage is found that the
-- database itself cannot see.

ALTER TABLE source_file ADD COLUMN mapping TEXT CHECK (json_valid(mapping));

CREATE TABLE row_seal (
    tbl TEXT NOT NULL,
    bucket INTEGER NOT NULL,
    seal INTEGER NOT NULL,
    PRIMARY KEY (tbl, bucket)
) STRICT, WITHOUT ROWID;

-- The index is built again with checksums.
ALTER TABLE search_file ADD COLUMN checksum INTEGER NOT NULL DEFAULT 0;
DELETE FROM search_file;
UPDATE search_state SET format = 0;
