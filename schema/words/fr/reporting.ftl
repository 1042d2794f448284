## Messages: `{ $name }` is a variable part.

message-reporting-report-cannot-written-as = un rapport ne peut pas être écrit en .{ $ending }
message-reporting-give-name-ends-in-html-json = donnez un nom qui se termine par .html ou .json, ou un dossier
message-reporting-report-cannot-written = le rapport ne peut pas être écrit : { $error }
message-reporting-no-trial-has-condition = aucun essai n’a la condition { $name }
message-reporting-conditions-plan = conditions du plan : { $list }
message-reporting-trials-have-measure-already = les essais ont déjà une mesure { $name }
message-reporting-give-column-table-another-name = donnez un autre nom à la colonne du tableau
message-reporting-table-cannot-written = un tableau ne peut pas être écrit : { $error }
