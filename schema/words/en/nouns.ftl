## Nouns with a number: `noun-` and the English plural.

noun-annotations = { $count ->
    [one] annotation
   *[other] annotations
}
noun-answers = { $count ->
    [one] answer
   *[other] answers
}
noun-attributes = { $count ->
    [one] attribute
   *[other] attributes
}
noun-blocks = { $count ->
    [one] block
   *[other] blocks
}
noun-changes = { $count ->
    [one] change
   *[other] changes
}
noun-columns = { $count ->
    [one] column
   *[other] columns
}
noun-conflicts = { $count ->
    [one] conflict
   *[other] conflicts
}
noun-curves = { $count ->
    [one] curve
   *[other] curves
}
noun-edits = { $count ->
    [one] edit
   *[other] edits
}
noun-files = { $count ->
    [one] file
   *[other] files
}
noun-frames = { $count ->
    [one] frame
   *[other] frames
}
noun-index-documents = { $count ->
    [one] index document
   *[other] index documents
}
noun-inventories = { $count ->
    [one] inventory
   *[other] inventories
}
noun-joints = { $count ->
    [one] joint
   *[other] joints
}
noun-media = { $count ->
    [one] media file
   *[other] media
}
noun-notations = { $count ->
    [one] notation
   *[other] notations
}
noun-operations = { $count ->
    [one] operation
   *[other] operations
}
noun-participants = { $count ->
    [one] participant
   *[other] participants
}
noun-pairs-of-frames = { $count ->
    [one] pair of frames
   *[other] pairs of frames
}
noun-pairs-of-tiers = { $count ->
    [one] pair of tiers
   *[other] pairs of tiers
}
noun-points = { $count ->
    [one] point
   *[other] points
}
noun-questions = { $count ->
    [one] question
   *[other] questions
}
noun-recipes = { $count ->
    [one] recipe
   *[other] recipes
}
noun-recordings = { $count ->
    [one] recording
   *[other] recordings
}
noun-rows = { $count ->
    [one] row
   *[other] rows
}
noun-samples = { $count ->
    [one] sample
   *[other] samples
}
noun-searches = { $count ->
    [one] search
   *[other] searches
}
noun-signers = { $count ->
    [one] signer
   *[other] signers
}
noun-corpora = { $count ->
    [one] corpus
   *[other] corpora
}
noun-lexicons = { $count ->
    [one] lexicon
   *[other] lexicons
}
noun-signs = { $count ->
    [one] sign
   *[other] signs
}
noun-skeletons = { $count ->
    [one] skeleton
   *[other] skeletons
}
noun-studies = { $count ->
    [one] study
   *[other] studies
}
noun-symbols = { $count ->
    [one] symbol
   *[other] symbols
}
noun-tables = { $count ->
    [one] table
   *[other] tables
}
noun-tiers = { $count ->
    [one] tier
   *[other] tiers
}
noun-times = { $count ->
    [one] time
   *[other] times
}
noun-tokens = { $count ->
    [one] token
   *[other] tokens
}
noun-units = { $count ->
    [one] unit
   *[other] units
}
noun-values = { $count ->
    [one] value
   *[other] values
}
noun-tracks = { $count ->
    [one] track
   *[other] tracks
}
