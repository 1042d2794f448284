## Words about deleted recordings and signs.

texts-deleting-nothing-written = nothing is written; this would be deleted:
texts-deleting-deleted = deleted:
texts-deleting-prevented-by = without --with-dependents or --keep-dependents these prevent it:
texts-deleting-kept = these stay, with their own movement:
