## The history: what each operation did. `history-` and the name of the operation; its variable parts are its fields.
## The names of people's things (files, tiers, glosses, recordings) stand in the sentence as they are.

history-import = Imported: { $count ->
    [0] nothing new
    [1] { $first }
   *[other] { $count } files from { $first } to { $last }
}
history-recombine = { $gloss } made: { $recipe }
history-recombine-again = { $gloss } made again: { $recipe }
history-annotate = { $changes } in { $recordings ->
    [1] { $recording }
   *[other] { $recordings } recordings
}
history-propose = Proposed from movement: { $changes } in { $recordings ->
    [1] { $recording }
   *[other] { $recordings } recordings
}
history-accept = Proposed values accepted: { $count }, in { $recordings ->
    [1] { $recording }
   *[other] { $recordings } recordings
}
history-reject = Proposed values rejected: { $count }, in { $recordings ->
    [1] { $recording }
   *[other] { $recordings } recordings
}
history-adjudicate = Adjudicated on the tier { $tier }
history-prefer-annotator = Preferred annotator: { $annotator }
history-add-tier = Tier { $tier } added to { $recording }
history-change-tier = Tier { $tier } of { $recording } changed
history-remove-tier = Tiers removed from { $recording }: { $tiers }, with { $annotations ->
    [one] { $annotations } annotation
   *[other] { $annotations } annotations
}
history-add-tiers = { $count ->
    [one] { $count } tier added to { $recording }
   *[other] { $count } tiers added to { $recording }
}
history-copy-tier = Tier { $tier } of { $recording } copied as { $copy }, with { $annotations ->
    [one] { $annotations } annotation
   *[other] { $annotations } annotations
}
history-work-on-tiers = { $tiers ->
    [one] { $tiers } tier
   *[other] { $tiers } tiers
} { $deed ->
    [added] added
    [copied] copied
    [removed] removed
    [shifted] moved in time
   *[changed] changed
} in { $recordings ->
    [one] { $recordings } recording
   *[other] { $recordings } recordings
}
history-order-tiers = Tiers put in order: { $recording }
history-add-value = Value { $value } added to { $inventory }
history-merge-values = Value { $value } merged into { $into } in { $inventory }
history-equate-values = The values { $value } and { $other } are one
history-part-value = { $value } is one with no other value any more
history-change-recording = Recording changed: { $recording }
history-change-signer = Signer changed: { $signer }
history-change-sign = Sign changed: { $sign }
history-rename-sign = Sign { $former } renamed to { $sign }, in { $annotations ->
    [one] { $annotations } annotation
   *[other] { $annotations } annotations
}
history-set-citation = Citation form: token:{ $token } for { $gloss }
history-change-person = Person changed: { $person }
history-unite-people = { $names } made one person with { $person }
history-unite-lexicons = Lexicons made one: { $names } in { $lexicon }
history-relate-signs = Relations of signs ({ $relation }): { $count }
history-remove-person = Person removed: { $person }
history-import-people = { $people ->
    [one] one person
   *[other] { $people } people
} read from { $file }
history-change-lexicon = Lexicon changed: { $lexicon }
history-remove-lexicon = Lexicon removed: { $lexicon }
history-measure-signs = Measures of { $signs ->
    [one] { $signs } sign
   *[other] { $signs } signs
} stored
history-link-lexicon = Glosses of { $recordings ->
    [one] { $recordings } recording
   *[other] { $recordings } recordings
} looked up in the lexicon { $lexicon }
history-unlink-lexicon = Glosses of { $recordings ->
    [one] { $recordings } recording
   *[other] { $recordings } recordings
} looked up in no lexicon
history-transcribe = Transcribed: token:{ $token } { $gloss }
history-add-tracks = Tracks added to { $recording }: { $tracks }
history-change-track = Track { $track } of { $recording } { $change ->
    [moved] starts at { $seconds } s
    [renamed] is now { $to }
   *[removed] removed
}
history-change-media = Media changed: { $recording }
history-fit-markers = A skeleton fitted to the markers { $markers } of { $recording }, { $millimetres } mm
# One person of several whose markers are in one track.
history-fit-markers-of-person = A skeleton fitted to the markers { $markers } of { $subject } in { $recording }, { $millimetres } mm
history-restore-markers = { $places ->
    [one] { $places } place of a lost marker computed
   *[other] { $places } places of lost markers computed
} in { $recordings ->
    [one] { $recordings } recording
   *[other] { $recordings } recordings
}
history-fit-face = Face { $track } of { $recording } fitted to { $signer }
history-cue-from-dictionary = { $gloss } cued from the dictionary, with { $movements ->
    [one] { $movements } movement
   *[other] { $movements } movements
}
history-find-targets = Targets of { $keys ->
    [one] { $keys } cue
   *[other] { $keys } cues
} found in { $recordings ->
    [one] { $recordings } recording
   *[other] { $recordings } recordings
}
history-keep-search = Search saved: { $names }
history-rename-search = Search { $from } renamed to { $to }
history-forget-search = Saved search removed: { $name }
history-delete = Deleted: { $names }
history-delete-undone = Restored: { $names }
history-plan-study = Study planned: { $study }
history-import-answers = Answers imported: { $study }, { $participants ->
    [one] { $participants } participant
   *[other] { $participants } participants
}
history-forget-participant = Participant of a study deleted: { $study }
history-delete-study = Study deleted: { $study }
history-change-consent = Consent changed: { $names }
history-merge = Merged { $from }: { $added } added, { $changed } changed, { $removed } removed, { $conflicts ->
    [one] { $conflicts } conflict
   *[other] { $conflicts } conflicts
}
# The decision is for the state of this corpus, for that of the other one, or for both of them.
history-decide = Conflicts decided: { $conflicts }: { $decision ->
    [mine] mine
    [theirs] theirs
   *[both] both
}
history-mend = Tokens derived again
# Operations of an earlier program, of which only its English sentence is known.
history-summary-only = { $name }: { $summary }
history-summary-only-import = Imported: { $summary }
history-summary-only-recombine = Made: { $summary }
history-summary-only-recombine-again = Made again: { $summary }
history-summary-only-annotate = Annotations: { $summary }
history-summary-only-propose = Proposed from movement: { $summary }
history-summary-only-accept = Proposed values accepted: { $summary }
history-summary-only-add-tier = Tier added: { $summary }
history-summary-only-change-tier = Tier changed: { $summary }
history-summary-only-remove-tier = Tier removed: { $summary }
history-summary-only-add-tiers = Tiers added: { $summary }
history-summary-only-copy-tier = Tier copied: { $summary }
history-summary-only-add-value = Value added: { $summary }
history-summary-only-merge-values = Values merged: { $summary }
history-summary-only-equate-values = Values made one: { $summary }
history-summary-only-part-value = Value parted from others: { $summary }
history-summary-only-rename-search = Search renamed: { $summary }
history-summary-only-change-sign = Sign changed: { $summary }
history-summary-only-set-citation = Citation form: { $summary }
history-summary-only-change-person = Person changed: { $summary }
history-summary-only-unite-people = People made one: { $summary }
history-summary-only-unite-lexicons = Lexicons made one: { $summary }
history-summary-only-relate-signs = Relations of signs: { $summary }
history-summary-only-remove-person = Person removed: { $summary }
history-summary-only-import-people = People read from a table: { $summary }
history-summary-only-change-lexicon = Lexicon changed: { $summary }
history-summary-only-remove-lexicon = Lexicon removed: { $summary }
history-summary-only-measure-signs = Measures stored: { $summary }
history-summary-only-link-lexicon = Glosses looked up in a lexicon: { $summary }
history-summary-only-unlink-lexicon = Glosses looked up in no lexicon: { $summary }
history-summary-only-transcribe = Transcribed: { $summary }
history-summary-only-add-tracks = Tracks added: { $summary }
history-summary-only-change-track = Track changed: { $summary }
history-summary-only-import-answers = Answers imported: { $summary }
history-summary-only-merge = Merged: { $summary }
history-summary-only-decide = Decided: { $summary }
history-undone = Undone: { $what }

## Changes of annotations; several of them stand in a list.

history-annotations-added = { $count ->
    [one] { $count } annotation added
   *[other] { $count } annotations added
}
history-annotations-changed = { $count ->
    [one] { $count } annotation changed
   *[other] { $count } annotations changed
}
history-annotations-removed = { $count ->
    [one] { $count } annotation removed
   *[other] { $count } annotations removed
}
# The undo of a removal.
history-annotations-removed-undone = { $count ->
    [one] { $count } annotation restored
   *[other] { $count } annotations restored
}
history-annotations-moved = { $count ->
    [one] { $count } annotation moved
   *[other] { $count } annotations moved
}
history-annotations-merged = { $count ->
    [one] { $count } annotation merged
   *[other] { $count } annotations merged
}
history-annotations-split = { $count ->
    [one] { $count } annotation split
   *[other] { $count } annotations split
}
history-annotations-revalued = { $count ->
    [one] { $count } annotation says something else
   *[other] { $count } annotations say something else
}
history-annotations-valued = { $count } { $of ->
    [handshape] { $count ->
        [one] handshape
       *[other] handshapes
    }
    [placement] { $count ->
        [one] placement
       *[other] placements
    }
    [movement] { $count ->
        [one] movement
       *[other] movements
    }
    [orientation] { $count ->
        [one] orientation
       *[other] orientations
    }
    [gloss] { $count ->
        [one] gloss
       *[other] glosses
    }
   *[annotation] { $count ->
        [one] annotation
       *[other] annotations
    }
} changed to { $value }

## Changes of rows, in the details of an operation: what they are of, their name, and their place.

history-row-added = added { $what } { $name }{ $place }{ $span }
history-row-removed = removed { $what } { $name }{ $place }{ $span }
history-row-changed = { $what } { $name }{ $place }: { $fields }
history-row-place = { " on " }{ $name }
history-row-place-of = { " on " }{ $name } of { $whole }
history-row-span = { ", " }{ $start } to { $end }
history-row-fields = { $one }; { $other }
history-row-field = { $field } from { $from } to { $to }
history-row-order = its order or form
history-row-nothing = nothing
