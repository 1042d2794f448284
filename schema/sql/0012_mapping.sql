-- The meanings that a user's mapping gave to columns of an imported table.

ALTER TABLE source_file ADD COLUMN mapping TEXT CHECK (json_valid(mapping));
