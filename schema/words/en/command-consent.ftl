## Help of commands and options.

help-command-consent-state-what-signers-agreed-who-may = State what signers agreed to: who may see their movement, its annotation, and signs made from it
help-command-consent-consent-belongs-signer-one-recording-where = A consent belongs to a signer, or to one recording; where both say something, the narrower of the two holds. After a merge of copies that disagree, too, the narrower one holds until somebody decides (`chereme conflicts`). Without a statement a consent is unknown, and `chereme publish` leaves out what it covers. Movement shows who signs even without a face: state it only after the person agreed. Without an option the consents are listed.
help-command-consent-signers-recordings-such-as-signer-ada = The signers and recordings, such as signer:Ada or recording:3
help-command-consent-who-may-see-all-three-public = Who may see all three: public, research, nobody, or unknown
help-command-consent-who-may-see-recorded-movement = Who may see the recorded movement
help-command-consent-who-may-see-what-annotators-wrote = Who may see what annotators wrote about it
help-command-consent-who-may-see-signs-made-from = Who may see signs made from it
help-command-consent-day-agreement-such-as-2026-11 = The day of the agreement, such as 2026-11-27
help-command-consent-what-signed-version-form-language = What was signed: the version of a form, its language
help-command-consent-terms-use-those-recordings-have-none = The terms of use of those recordings that have none

## Titles of columns.

title-command-consent-of = of
title-command-consent-name = name
title-command-consent-movement = movement
title-command-consent-annotation = annotation
title-command-consent-derived = derived
title-command-consent-day = day
title-command-consent-form = form
