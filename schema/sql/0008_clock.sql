-- The time of day at which a track's own time 0 is, in microseconds after midnight, where its file has timecodes.

ALTER TABLE track ADD COLUMN clock_us INTEGER;
