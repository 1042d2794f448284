-- What signers agreed to, for all their recordings, and for single recordings.

ALTER TABLE signer ADD COLUMN consent TEXT CHECK (json_valid(consent));
ALTER TABLE recording ADD COLUMN consent TEXT CHECK (json_valid(consent));
