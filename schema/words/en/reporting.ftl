## Messages: `{ $name }` is a variable part.

message-reporting-report-cannot-written-as = a report cannot be written as .{ $ending }
message-reporting-give-name-ends-in-html-json = give a name that ends in .html or .json, or a folder
message-reporting-report-cannot-written = the report cannot be written: { $error }
message-reporting-no-trial-has-condition = no trial has the condition { $name }
message-reporting-conditions-plan = conditions of the plan: { $list }
message-reporting-trials-have-measure-already = the trials have a measure { $name } already
message-reporting-give-column-table-another-name = give the column of the table another name
message-reporting-table-cannot-written = a table cannot be written: { $error }
