-- Files are named by where they lie, and may be of any kind that a reader knows.

ALTER TABLE source_file ADD COLUMN path TEXT;
ALTER TABLE source_file ADD COLUMN kind_2 TEXT NOT NULL DEFAULT '';
UPDATE source_file SET kind_2 = kind;
ALTER TABLE source_file DROP COLUMN kind;
ALTER TABLE source_file RENAME COLUMN kind_2 TO kind;
CREATE INDEX source_file_path ON source_file (path) WHERE path IS NOT NULL;
