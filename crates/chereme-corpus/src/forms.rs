//! The forms of signs: their values in some fields, by which `pairs` and `stats` compare them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use chereme_formats::lexicon::{self, LexiconColumn, LexiconColumnMeaning, LexiconEntry, SignLexicon};
use chereme_formats::roles::AnnotatedHands;
use chereme_sign::text::{did_you_mean, fold_text, nearest_candidate};
use chereme_sign::{ComponentField, SignComponent};
use rusqlite::Connection;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::Corpus;
use crate::db::signs::{self, TokenRow};
use crate::db::stored_recordings::{self, SourceFileRow};
use crate::error::{CorpusError, CorpusResult};
use crate::lexicon::{LexiconScope, keep_scope_rows};
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::suggest::{self, CodingReader};

/// The treatment of an empty cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EmptyCellTreatment {
    /// An empty cell is a value like any other: a sign without a weak hand differs from one with it, and two signs
    /// without it are equal there.
    #[default]
    Value,
    /// An empty cell is unknown: a sign with an empty field takes no part.
    Unknown,
}

/// The number of tokens between two reports of progress.
const FORM_REPORT_STEP_TOKENS: usize = 64;

/// A named set of columns of the Signbank.
#[derive(Debug, Clone, Deserialize)]
pub struct FieldSet {
    /// The name.
    pub name: String,
    /// The titles of the columns.
    pub titles: Vec<String>,
}

/// The named sets of columns of the Signbank, which are data: `schema/signbank_fields.json`.
pub static FIELD_SETS: LazyLock<Vec<FieldSet>> = LazyLock::new(|| {
    serde_json::from_str(chereme_data::schema_text("signbank_fields.json"))
        .expect("the sets of columns are well formed")
});

/// The place from which forms come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FormSource {
    /// Columns of imported tables, whose cells are taken as written.
    Columns,
    /// The codings of citation forms.
    Citations,
    /// The codings of the tokens that a query finds.
    Tokens,
}

/// Signs with what they have in some fields.
#[derive(Debug, Clone)]
pub(crate) struct SignForms {
    /// The fields.
    pub(crate) fields: Vec<FormField>,
    /// The signs, each with a cell for each field.
    pub(crate) rows: Vec<SignForm>,
    /// The place from which they come.
    pub(crate) source: FormSource,
}

/// A field by which signs are compared.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct FormField {
    /// Its name: the title of a column, or a field of queries.
    pub(crate) name: String,
    /// The field of queries, such as `dominant.configuration`; nothing for a column that codes no component.
    pub(crate) coding: Option<String>,
    /// The component that it codes, in whatever phase.
    pub(crate) component: Option<SignComponent>,
}

/// A sign with its cells, an empty one for a field without value.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct SignForm {
    /// The gloss.
    pub(crate) gloss: String,
    /// The cells, in the order of the fields.
    pub(crate) cells: Vec<String>,
    /// The line of the table.
    pub(crate) line: Option<u64>,
    /// The row of the token that it describes.
    pub(crate) token: Option<i64>,
}

impl SignForms {
    /// Returns signs with their codings in some fields of queries.
    pub(crate) fn forms_from_codings(
        codings: &[(String, BTreeMap<String, String>)],
        fields: Vec<String>,
        source: FormSource,
    ) -> Self {
        let rows = codings.iter().map(|(gloss, coding)| {
            let cells = fields.iter().map(|field| coding.get(field).cloned());
            SignForm {
                gloss: gloss.clone(),
                cells: cells.map(Option::unwrap_or_default).collect(),
                line: None,
                token: None,
            }
        });
        Self {
            rows: rows.collect(),
            fields: fields
                .into_iter()
                .map(|name| FormField {
                    component: name.parse().ok().map(|field: ComponentField| field.component),
                    coding: Some(name.clone()),
                    name,
                })
                .collect(),
            source,
        }
    }
}

impl SignForm {
    /// Returns whether every field has a value.
    pub(crate) fn is_complete(&self) -> bool {
        self.cells.iter().all(|cell| !cell.is_empty())
    }
}

/// Returns the fields that are meant: those of a set if its name stands alone.
pub(crate) fn named_fields(fields: &[String]) -> Vec<String> {
    let named = match fields {
        [one] => FIELD_SETS.iter().find(|set| set.name == *one),
        _ => None,
    };
    named.map_or_else(|| fields.to_vec(), |set| set.titles.clone())
}

/// The forms that are wanted.
#[derive(Debug, Clone)]
pub(crate) enum FormSelection {
    /// One form of every sign.
    All,
    /// The form of each of these tokens.
    Tokens(Vec<TokenRow>),
    /// One form of each of these signs.
    Signs(BTreeSet<i64>),
}

impl FormSelection {
    /// Selects the signs of selected tokens.
    pub(crate) fn select_signs(self) -> Self {
        match self {
            Self::Tokens(tokens) => Self::Signs(tokens.iter().map(|token| token.sign_id).collect()),
            other => other,
        }
    }
}

impl Corpus {
    /// Returns the selected forms by some fields: the rows of the imported tables that have all of them as columns,
    /// otherwise the codings of tokens by fields of queries; without fields by all that are coded. A sign is represented by
    /// its citation form. The signs belong to the lexicons of `scope`.
    ///
    /// # Errors
    /// [`Error::Wrong`] if a field does not exist; [`Error::Stopped`].
    pub(crate) fn load_sign_forms(
        &self,
        fields: &[String],
        selection: &FormSelection,
        scope: &LexiconScope,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<SignForms> {
        match of_tables(self.store.read_connection(), fields, selection, scope)? {
            Some(forms) => Ok(forms),
            None => of_codings(self, fields, selection, scope, progress),
        }
    }

    /// Returns the columns that code components in the first imported table that has all of `titles` as columns, and
    /// these; nothing if no table has them.
    pub(crate) fn columns_with(&self, titles: &[String]) -> CorpusResult<Option<Vec<String>>> {
        let connection = self.store.read_connection();
        for file in stored_recordings::lexicon_files(connection)? {
            let Some(table) = table_of(connection, &file)? else {
                continue;
            };
            let places = titles.iter().map(|title| find_title_column(&table, title));
            let Some(named) = places.collect::<Option<Vec<usize>>>() else {
                continue;
            };
            let columns = table.columns.iter().enumerate();
            let kept = columns.filter(|(at, column)| is_coding(&column.meaning) || named.contains(at));
            return Ok(Some(kept.map(|(_, it)| it.title.clone()).collect()));
        }
        Ok(None)
    }
}

/// Returns an imported table, with the meanings of columns that the user gave it; nothing if it cannot be read.
fn table_of(connection: &Connection, file: &SourceFileRow) -> CorpusResult<Option<SignLexicon>> {
    let bytes = stored_recordings::source_bytes(connection, file.id)?;
    // Without the mapping of the import, the columns could mean something else than they did then.
    let mapping = stored_recordings::source_mapping(connection, file.id)?.unwrap_or_default();
    let read = |bytes: Vec<u8>| lexicon::read_lexicon(&bytes, &mapping).ok();
    Ok(bytes.and_then(read).map(|(table, _)| table))
}

/// Returns the place of a column by its title, case and accents apart, otherwise by the component that the title means:
/// `Handshape strong` is `Strong Hand`, too.
fn find_title_column(table: &SignLexicon, title: &str) -> Option<usize> {
    let wanted = fold_text(title.trim());
    let position = |is: &dyn Fn(&LexiconColumn) -> bool| table.columns.iter().position(is);
    let titled = position(&|column| fold_text(column.title.trim()) == wanted);
    let coding_place = || {
        // A field of queries asks for codings.
        let meaning = Some(lexicon::meaning_of_title(title)).filter(is_coding)?;
        position(&|column| column.meaning == meaning).filter(|_| title.parse::<ComponentField>().is_err())
    };
    titled.or_else(coding_place)
}

fn is_coding(meaning: &LexiconColumnMeaning) -> bool {
    matches!(meaning, LexiconColumnMeaning::Coding { .. })
}

/// Returns whether a row of a table has these cells, by their titles.
pub(crate) fn row_has_cells(table: &SignLexicon, row: &LexiconEntry, cells: &Map<String, Value>) -> bool {
    let titles = table.columns.iter().map(|column| column.title.as_str());
    let filled = titles.zip(&row.cells).filter(|(_, cell)| !cell.trim().is_empty());
    let row_cells: BTreeMap<&str, &str> = filled.map(|(title, cell)| (title, cell.as_str())).collect();
    let mut cells = cells.iter();
    cells.all(|(title, cell)| row_cells.get(title.as_str()).copied() == cell.as_str())
}

/// An entry of a table that the corpus still has.
struct StandingEntry {
    gloss: String,
    sign: i64,
    token: i64,
    cells: Map<String, Value>,
}

/// The entries of one table that the corpus still has, by the line of the table.
type StandingTableEntries = BTreeMap<u64, Vec<StandingEntry>>;

/// Returns the entries that the corpus has of each table, by the table's path, or its name if the path is not known.
fn load_standing_entries(connection: &Connection) -> CorpusResult<BTreeMap<String, StandingTableEntries>> {
    let mut tables: BTreeMap<String, StandingTableEntries> = BTreeMap::new();
    for token in signs::lexicon_entries(connection)? {
        let source = token.source.as_deref().unwrap_or_default();
        let Ok(mut source) = serde_json::from_str::<Value>(source) else {
            continue;
        };
        let place = source["path"].as_str().or(source["file"].as_str());
        let (Some(place), Some(line)) = (place.map(str::to_owned), source["line"].as_u64()) else {
            continue;
        };
        if let Value::Object(cells) = source["cells"].take() {
            let lines = tables.entry(place).or_default();
            let entries = lines.entry(line).or_default();
            entries.push(StandingEntry {
                gloss: token.gloss,
                sign: token.sign_id,
                token: token.id,
                cells,
            });
        }
    }
    Ok(tables)
}

/// Returns what the corpus has now of a row of a table; nothing if the corpus no longer has its sign.
fn standing_entry<'a>(
    standing: &'a StandingTableEntries,
    table: &SignLexicon,
    row: &LexiconEntry,
) -> Option<&'a StandingEntry> {
    let entries = standing.get(&row.line)?;
    let named = entries.iter().find(|entry| entry.gloss == row.gloss);
    // A sign that was renamed in the corpus is known by its cells.
    named.or_else(|| {
        let mut entries = entries.iter();
        entries.find(|entry| row_has_cells(table, row, &entry.cells))
    })
}

/// Returns the rows of the imported tables that have all the columns, if there are such tables: those of the newest
/// version of each table whose signs the corpus still has.
fn of_tables(
    connection: &Connection,
    fields: &[String],
    selection: &FormSelection,
    scope: &LexiconScope,
) -> CorpusResult<Option<SignForms>> {
    // Without fields, codings are meant, which do not need a table.
    if fields.is_empty() {
        return Ok(None);
    }
    let mut rows = Vec::new();
    let mut known_titles: BTreeSet<String> = BTreeSet::new();
    // The fewest fields that a table lacks, with the first of them.
    let mut lacking: Option<(usize, &String)> = None;
    let mut columns: Option<Vec<FormField>> = None;
    let tables = load_standing_entries(connection)?;
    let selected_tokens: BTreeSet<i64> = match selection {
        FormSelection::Tokens(tokens) => tokens.iter().map(|token| token.id).collect(),
        _ => BTreeSet::new(),
    };
    let is_selected = |entry: &StandingEntry| match selection {
        FormSelection::All => true,
        FormSelection::Tokens(_) => selected_tokens.contains(&entry.token),
        FormSelection::Signs(signs) => signs.contains(&entry.sign),
    };
    for file in stored_recordings::lexicon_files(connection)? {
        let Some(table) = table_of(connection, &file)? else {
            continue;
        };
        known_titles.extend(table.columns.iter().map(|column| column.title.clone()));
        let places: Vec<Option<usize>> = fields.iter().map(|field| find_title_column(&table, field)).collect();
        let mut lacks = fields.iter().zip(&places).filter(|(_, at)| at.is_none());
        if let Some((first, _)) = lacks.next() {
            let count = lacks.count();
            // The table that lacks the fewest fields is most likely the one that was meant.
            if lacking.is_none_or(|(least, _)| count < least) {
                lacking = Some((count, first));
            }
            continue;
        }
        let places: Vec<usize> = places.into_iter().flatten().collect();
        let named = fields.iter().zip(&places).map(|(name, at)| FormField {
            name: name.clone(),
            coding: coding_of_column(&table.columns[*at]),
            component: match table.columns[*at].meaning {
                LexiconColumnMeaning::Coding { component, .. } => Some(component),
                _ => None,
            },
        });
        // All tables have these columns, so the meaning in the first one holds.
        columns.get_or_insert_with(|| named.collect());
        let place = file.path.as_ref().unwrap_or(&file.name);
        // A table whose signs were all deleted adds no rows.
        let Some(entries) = tables.get(place) else {
            continue;
        };
        rows.extend(table.entries.iter().filter_map(|entry| {
            let standing = standing_entry(entries, &table, entry)?;
            is_selected(standing).then(|| {
                let form = SignForm {
                    gloss: standing.gloss.clone(),
                    cells: (places.iter()).map(|at| entry.cells[*at].trim().to_owned()).collect(),
                    line: Some(entry.line),
                    token: Some(standing.token),
                };
                (standing.sign, form)
            })
        }));
    }
    if let Some(fields) = columns {
        let source = FormSource::Columns;
        let rows = keep_scope_rows(connection, scope, rows, |(sign, _)| *sign)?;
        let rows = rows.into_iter().map(|(_, form)| form).collect();
        return Ok(Some(SignForms { fields, rows, source }));
    }
    // A field of queries can be answered from codings, a title only from a table.
    let title = |field: &&String| field.parse::<ComponentField>().is_err();
    match fields.iter().find(title) {
        None => Ok(None),
        Some(title) => {
            let field = lacking.map_or(title, |(_, first)| first);
            let others = known_titles.iter().filter(|title| *title != field);
            let near = did_you_mean(nearest_candidate(field, others.map(String::as_str)));
            let titles: Vec<&str> = known_titles.iter().map(String::as_str).collect();
            let text = format!("no imported table has a column {field:?} with the others{near}");
            Err(CorpusError::from_wrong_message(text)
                .with_error_place(field)
                .with_advice(format!(
                    "name fields of queries such as dominant.configuration, or columns of one table: {}",
                    titles.join(", ")
                )))
        }
    }
}

/// Returns the field of queries that a column codes.
fn coding_of_column(column: &LexiconColumn) -> Option<String> {
    let LexiconColumnMeaning::Coding {
        hand,
        component,
        feature,
        phase: None,
    } = &column.meaning
    else {
        return None;
    };
    let field = ComponentField {
        hand: hand.and_then(AnnotatedHands::single_hand),
        component: *component,
        feature: feature.clone(),
        phase: None,
    };
    Some(suggest::coding_name(&field))
}

/// Returns the codings of the citation forms, or of these tokens, by query field.
fn of_codings(
    corpus: &Corpus,
    fields: &[String],
    selection: &FormSelection,
    scope: &LexiconScope,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<SignForms> {
    let connection = corpus.store.read_connection();
    let (mut tokens, source) = match selection {
        FormSelection::Tokens(tokens) => (tokens.clone(), FormSource::Tokens),
        _ => (signs::load_coded_citation_tokens(connection)?, FormSource::Citations),
    };
    if let FormSelection::Signs(signs) = selection {
        tokens.retain(|token| signs.contains(&token.sign_id));
    }
    let tokens = keep_scope_rows(connection, scope, tokens, |token| token.sign_id)?;
    let all = tokens.len() as u64;
    let reader = CodingReader::in_standing_words(corpus)?;
    let mut codings = Vec::new();
    let mut coded_tokens = Vec::new();
    for (done, token) in tokens.into_iter().enumerate() {
        if done % FORM_REPORT_STEP_TOKENS == 0 {
            progress.report_amount(ProgressUnit::Items, "codings", done as u64, Some(all))?;
        }
        let coding = match source {
            FormSource::Tokens => reader.coding_of(&token)?,
            _ => reader.citation_coding(&token)?,
        };
        // A sign without any coding has no form to compare.
        if !coding.is_empty() {
            codings.push((token.gloss, coding));
            coded_tokens.push(token.id);
        }
    }
    let coded: BTreeSet<&String> = codings.iter().flat_map(|(_, it)| it.keys()).collect();
    let wanted = |field: &String| -> CorpusResult<String> {
        let written = match field.parse::<ComponentField>() {
            Ok(field) => suggest::coding_name(&field),
            Err(error) => {
                return Err(CorpusError::from_wrong_message(error.to_string()).with_error_place(field));
            }
        };
        // A field that nobody coded would make all signs equal.
        if coded.contains(&written) {
            return Ok(written);
        }
        let names: Vec<&str> = coded.iter().map(|name| name.as_str()).collect();
        let text = match source {
            FormSource::Tokens => format!("no token found is coded for {field}"),
            _ => format!("no citation form is coded for {field}"),
        };
        Err(CorpusError::from_wrong_message(text)
            .with_error_place(field)
            .with_advice(format!("coded are: {}", names.join(", "))))
    };
    let keys: Vec<String> = match fields {
        [] => coded.iter().map(|name| (*name).clone()).collect(),
        some => some.iter().map(wanted).collect::<CorpusResult<_>>()?,
    };
    let mut forms = SignForms::forms_from_codings(&codings, keys, source);
    for (form, token) in forms.rows.iter_mut().zip(coded_tokens) {
        form.token = Some(token);
    }
    Ok(forms)
}

/// Returns the cells as numbers that are equal if the texts are equal, and the text of each number; the empty cell is 0.
pub(crate) fn number_form_cells(rows: &[SignForm]) -> (Vec<Vec<u32>>, Vec<&str>) {
    let mut number_by_text: BTreeMap<&str, u32> = BTreeMap::from([("", 0)]);
    let mut texts = vec![""];
    let mut number = |text| {
        let next = u32::try_from(texts.len()).unwrap_or(u32::MAX);
        *number_by_text.entry(text).or_insert_with(|| {
            texts.push(text);
            next
        })
    };
    let numbers = rows
        .iter()
        .map(|row| row.cells.iter().map(|cell| number(cell)).collect())
        .collect();
    (numbers, texts)
}
