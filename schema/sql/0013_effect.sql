-- What an operation did, as a value that can be described in every language; the summary is its English description.

ALTER TABLE operation ADD COLUMN effect TEXT CHECK (effect IS NULL OR json_valid(effect));
