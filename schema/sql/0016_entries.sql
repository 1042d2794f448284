-- Several entries of a lexicon may have one gloss, as homonyms of a dictionary do: from the second on each has a number.
-- Two inventories may name one value: a value that is the same as another names it as INVENTORY/VALUE.

ALTER TABLE sign ADD COLUMN homonym INTEGER CHECK (homonym > 1);
ALTER TABLE sign ADD COLUMN label TEXT GENERATED ALWAYS AS (gloss || ifnull('#' || homonym, '')) VIRTUAL;
DROP INDEX sign_entry;
CREATE UNIQUE INDEX sign_entry ON sign (gloss, ifnull(lexicon_id, 0), ifnull(homonym, 1));
ALTER TABLE inventory_value ADD COLUMN same_as TEXT;
