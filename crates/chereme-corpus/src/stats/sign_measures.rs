//! Measures of each sign of a lexicon: neighbours, homonyms, families, probability of its values, how often it is used.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

use chereme_analysis::statistics::{RowNeighbours, UndefinedStatistic, count_row_neighbours, sorted_quantile};
use chereme_sign::SignComponent;
use serde::Serialize;

use super::stats_table::write_table_rows;
use crate::Corpus;
use crate::db::stored_attributes::{self, AttributeRow, MEASURE_PREFIX};
use crate::error::{CorpusError, CorpusResult};
use crate::forms::{EmptyCellTreatment, FormField, FormSource, SignForm, named_fields, number_form_cells};
use crate::lexicon::LexiconScope;
use crate::progress::ProgressReceiver;
use crate::words::effect::OperationEffect;

/// The most rows with few values that are compared one by one.
const MAX_SPARSE_FORMS: usize = 20_000;

/// The definition of a neighbour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum NeighbourDefinition {
    /// Another entry that differs in at most so many fields and has at least one value in common; homonyms are
    /// neighbours (ASL-LEX 2.0, Sehyr et al. 2021).
    #[default]
    AslLex,
    /// Another entry that differs in at least one and at most so many fields: with one, the minimal pairs of Signbank.
    Signbank,
    /// Another form at a distance of at most so many fields; entries of one form count once (Phonological CorpusTools).
    CorpusTools,
}

impl NeighbourDefinition {
    /// Returns the name of the definition, as it is stored with measures.
    #[must_use]
    pub fn definition_name(self) -> &'static str {
        match self {
            Self::AslLex => "asl-lex",
            Self::Signbank => "signbank",
            Self::CorpusTools => "corpus-tools",
        }
    }
}

/// The signs to measure, and the definitions of their measures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SignMeasureOptions {
    /// The fields that make a form, as in [`PairOptions`](crate::PairOptions); if empty, all coded fields.
    pub fields: Vec<String>,
    /// The treatment of an empty cell.
    pub empty: EmptyCellTreatment,
    /// The tokens whose signs are measured among each other, as a query.
    pub query: Option<String>,
    /// The lexicons whose signs are measured.
    pub scope: LexiconScope,
    /// The definition of a neighbour.
    pub definition: NeighbourDefinition,
    /// The most fields in which neighbours differ.
    pub within: usize,
}

impl Default for SignMeasureOptions {
    fn default() -> Self {
        Self {
            fields: Vec::new(),
            empty: EmptyCellTreatment::Value,
            query: None,
            scope: LexiconScope::Single,
            definition: NeighbourDefinition::default(),
            within: 1,
        }
    }
}

/// The measures of the signs of a lexicon.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SignMeasures {
    /// The place from which values come.
    pub source: FormSource,
    /// The definition of a neighbour.
    pub definition: NeighbourDefinition,
    /// The most fields in which neighbours differ.
    pub within: usize,
    /// The fields that make a form.
    pub fields: Vec<String>,
    /// The treatment of an empty cell.
    pub empty: EmptyCellTreatment,
    /// The query whose signs were measured among each other.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub query: Option<String>,
    /// The number of entries that were found.
    pub entries: usize,
    /// The mean of the densities.
    pub mean_density: f64,
    /// The median of the densities.
    pub median_density: f64,
    /// How many signs have no neighbour.
    pub without_neighbour: usize,
    /// The measures of each entry that was compared, by gloss.
    pub signs: Vec<MeasuredSign>,
}

/// The measures of one sign.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasuredSign {
    /// Its gloss.
    pub gloss: String,
    /// The token of its entry.
    pub token: i64,
    /// How many neighbours it has.
    pub density: u64,
    /// How many signs differ in exactly one field.
    pub pairs: u64,
    /// The same by field.
    pub pairs_by_field: BTreeMap<String, u64>,
    /// The other signs that are equal in all fields.
    pub homonyms: Vec<String>,
    /// The first gloss of the signs that are equal but for the handshape, if there are any; nothing if no field or every
    /// field codes handshapes.
    pub family: Option<String>,
    /// How many signs the family has, this one included.
    pub family_size: Option<usize>,
    /// The mean share of its values among the values of their fields.
    pub probability: Option<f64>,
    /// The mean share of its pairs of values among the pairs of values of two fields.
    pub pair_probability: Option<f64>,
    /// How many captured tokens the corpus has of it; tokens of the two hands that overlap count once.
    pub tokens: u64,
    /// How many known signers these are of.
    pub signers: u64,
}

impl Corpus {
    /// Returns measures of each sign of the lexicon.
    ///
    /// # Errors
    /// [`CorpusError::Wrong`] if a field does not exist or there are too many combinations of fields to leave out; the errors
    /// of [`search`](Self::search_tokens) for a query; [`CorpusError::Stopped`].
    pub fn measure_signs(
        &mut self,
        options: &SignMeasureOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<SignMeasures> {
        let selection = self.select_forms(options.query.as_deref(), progress)?.select_signs();
        let wanted = named_fields(&options.fields);
        let forms = self.load_sign_forms(&wanted, &selection, &options.scope, progress)?;
        let entries = forms.rows.len();
        let mut rows = forms.rows;
        if options.empty == EmptyCellTreatment::Unknown {
            rows.retain(SignForm::is_complete);
        }
        rows.sort();
        let mut signs = measure_forms(&rows, &forms.fields, options)?;
        let uses = count_sign_uses(self.store.read_connection(), &signs)?;
        for sign in &mut signs {
            (sign.tokens, sign.signers) = uses.get(&sign.token).copied().unwrap_or_default();
        }
        let mut densities: Vec<f64> = signs.iter().map(|sign| sign.density as f64).collect();
        densities.sort_by(f64::total_cmp);
        Ok(SignMeasures {
            source: forms.source,
            definition: options.definition,
            within: options.within,
            fields: forms.fields.into_iter().map(|field| field.name).collect(),
            empty: options.empty,
            query: options.query.clone(),
            entries,
            mean_density: densities.iter().sum::<f64>() / densities.len().max(1) as f64,
            median_density: sorted_quantile(&densities, 0.5).unwrap_or_default(),
            without_neighbour: densities.iter().filter(|density| **density == 0.0).count(),
            signs,
        })
    }

    /// Stores measures as attributes of the entries, in one step; earlier measures of these entries are replaced. Each entry
    /// keeps beside them by which definition, fields and day they were measured. Returns how many entries have them.
    ///
    /// # Errors
    /// Fails if the corpus cannot be written.
    pub fn store_sign_measures(&mut self, measures: &SignMeasures) -> CorpusResult<usize> {
        self.store.run_store_operation(|connection| {
            let day = stored_attributes::current_day(connection)?;
            let origin = format!("{day}, {}", measures.definition_text());
            for sign in &measures.signs {
                let mut rows = measure_rows(sign);
                rows.push(AttributeRow {
                    name: format!("{MEASURE_PREFIX}origin"),
                    text: origin.clone(),
                    number: None,
                });
                stored_attributes::set_token_measures(connection, sign.token, &rows)?;
            }
            let count = measures.signs.len();
            Ok((count, OperationEffect::MeasureSigns { signs: count as u64 }))
        })
    }
}

impl SignMeasures {
    /// Returns how the signs were measured, as it is stored with each.
    fn definition_text(&self) -> String {
        let empty = match self.empty {
            EmptyCellTreatment::Value => "an empty cell is a value",
            EmptyCellTreatment::Unknown => "an empty cell is unknown",
        };
        let among = self.query.as_ref().map(|query| format!(", among {query}"));
        let (definition, fields) = (self.definition.definition_name(), self.fields.join(", "));
        let within = self.within;
        format!(
            "{definition}, at most {within} of {fields}, {empty}{}",
            among.unwrap_or_default()
        )
    }

    /// Writes the measures as a table of commas, one line for each sign, with a column for the pairs of each field.
    ///
    /// # Errors
    /// Fails if a file of this name exists and `force` is false, or it cannot be written.
    pub fn write_sign_measures(&self, to: &Path, force: bool) -> CorpusResult<()> {
        let mut titles: Vec<String> = ["gloss", "density", "pairs"].map(str::to_owned).to_vec();
        titles.extend(self.fields.iter().map(|field| format!("pairs {field}")));
        let more_titles = [
            "homonyms",
            "homonym_glosses",
            "family",
            "family_size",
            "probability",
            "pair_probability",
            "tokens",
            "signers",
        ];
        titles.extend(more_titles.map(str::to_owned));
        let mut rows = vec![titles];
        let number = |value: Option<f64>| value.map(|share| share.to_string()).unwrap_or_default();
        for sign in &self.signs {
            let mut cells = vec![sign.gloss.clone(), sign.density.to_string(), sign.pairs.to_string()];
            cells.extend(self.fields.iter().map(|field| sign.pairs_by_field[field].to_string()));
            cells.extend([
                sign.homonyms.len().to_string(),
                sign.homonyms.join("; "),
                sign.family.clone().unwrap_or_default(),
                sign.family_size.map(|size| size.to_string()).unwrap_or_default(),
                number(sign.probability),
                number(sign.pair_probability),
                sign.tokens.to_string(),
                sign.signers.to_string(),
            ]);
            rows.push(cells);
        }
        write_table_rows(rows, to, force)
    }
}

/// Returns the measures of a sign that are stored, by name.
fn measure_rows(sign: &MeasuredSign) -> Vec<AttributeRow> {
    let numbers = [
        ("density", Some(sign.density as f64)),
        ("pairs", Some(sign.pairs as f64)),
        ("homonyms", Some(sign.homonyms.len() as f64)),
        ("family-size", sign.family_size.map(|size| size as f64)),
        ("probability", sign.probability),
        ("pair-probability", sign.pair_probability),
        ("tokens", Some(sign.tokens as f64)),
        ("signers", Some(sign.signers as f64)),
    ];
    let mut rows: Vec<AttributeRow> = numbers
        .into_iter()
        .filter_map(|(name, number)| {
            Some(AttributeRow {
                name: format!("{MEASURE_PREFIX}{name}"),
                text: number?.to_string(),
                number,
            })
        })
        .collect();
    rows.extend(sign.family.iter().map(|family| AttributeRow {
        name: format!("{MEASURE_PREFIX}family"),
        text: family.clone(),
        number: None,
    }));
    rows
}

/// Returns the measures of forms, without their uses; forms are sorted by gloss.
fn measure_forms(
    rows: &[SignForm],
    fields: &[FormField],
    options: &SignMeasureOptions,
) -> CorpusResult<Vec<MeasuredSign>> {
    let (cells, _) = number_form_cells(rows);
    let neighbours =
        count_row_neighbours(&cells, options.within.max(1)).map_err(|_| too_many_subsets(options.within))?;
    let densities = match options.definition {
        NeighbourDefinition::AslLex => {
            let unlike = count_pairs_without_common_value(&cells, options.within)?;
            let all = neighbours.iter().map(|row| sum_distances(row, 0..=options.within));
            all.zip(unlike).map(|(all, unlike)| all - unlike).collect()
        }
        NeighbourDefinition::Signbank => {
            let counts = neighbours.iter();
            counts.map(|row| sum_distances(row, 1..=options.within)).collect()
        }
        NeighbourDefinition::CorpusTools => count_neighbouring_forms(&cells, options.within)?,
    };
    let equal_rows = group_rows(cells.iter().cloned());
    let handshape_fields: Vec<bool> = fields
        .iter()
        .map(|field| field.component == Some(SignComponent::Configuration))
        .collect();
    let has_families = handshape_fields.contains(&true) && handshape_fields.contains(&false);
    let family_key = |row: &Vec<u32>| -> Vec<u32> {
        let cells = row.iter().zip(&handshape_fields);
        cells
            .filter(|(_, handshape)| !**handshape)
            .map(|(cell, _)| *cell)
            .collect()
    };
    let families = match has_families {
        true => group_rows(cells.iter().map(family_key)),
        false => HashMap::new(),
    };
    let shares = ValueShares::count_values(&cells);
    let mut signs = Vec::with_capacity(rows.len());
    for (place, (form, row)) in rows.iter().zip(&cells).enumerate() {
        let around = &neighbours[place];
        let others = equal_rows[row].iter().filter(|other| **other != place);
        let family = families.get(&family_key(row));
        let relatives = family.filter(|members| members.len() > 1);
        signs.push(MeasuredSign {
            gloss: form.gloss.clone(),
            token: form.token.unwrap_or_default(),
            density: densities[place],
            pairs: sum_distances(around, 1..=1),
            pairs_by_field: (fields.iter().zip(&around.by_field))
                .map(|(field, count)| (field.name.clone(), *count))
                .collect(),
            homonyms: others.map(|other| rows[*other].gloss.clone()).collect(),
            family: relatives.map(|members| rows[members[0]].gloss.clone()),
            family_size: family.map(Vec::len),
            probability: shares.mean_value_share(row),
            pair_probability: shares.mean_pair_share(row),
            tokens: 0,
            signers: 0,
        });
    }
    Ok(signs)
}

fn too_many_subsets(within: usize) -> CorpusError {
    let text = format!("there are too many ways to leave out {within} fields of so many signs");
    CorpusError::from_wrong_message(text)
        .with_advice("compare fewer fields, or neighbours that differ in fewer of them")
}

fn sum_distances(row: &RowNeighbours, distances: std::ops::RangeInclusive<usize>) -> u64 {
    let in_range = row
        .by_distance
        .iter()
        .enumerate()
        .filter(|(distance, _)| distances.contains(distance));
    in_range.map(|(_, count)| count).sum()
}

fn group_rows(keys: impl Iterator<Item = Vec<u32>>) -> HashMap<Vec<u32>, Vec<usize>> {
    let mut groups: HashMap<Vec<u32>, Vec<usize>> = HashMap::new();
    for (place, key) in keys.enumerate() {
        groups.entry(key).or_default().push(place);
    }
    groups
}

/// Returns for each row how many other rows differ in at most `within` fields but have no value in common with it: they are
/// equal only where both are empty, so that both have at most `within` values.
fn count_pairs_without_common_value(cells: &[Vec<u32>], within: usize) -> CorpusResult<Vec<u64>> {
    let mut sparse_forms: BTreeMap<&Vec<u32>, u64> = BTreeMap::new();
    for row in cells.iter().filter(|row| value_count(row) <= within) {
        *sparse_forms.entry(row).or_default() += 1;
    }
    if sparse_forms.len() > MAX_SPARSE_FORMS {
        return Err(too_many_subsets(within));
    }
    let unlike = |one: &Vec<u32>, other: &Vec<u32>| {
        let pairs = || one.iter().zip(other);
        pairs().all(|(a, b)| a != b || *a == 0) && pairs().filter(|(a, b)| a != b).count() <= within
    };
    let counts: BTreeMap<&Vec<u32>, u64> = sparse_forms
        .keys()
        .map(|form| {
            let others = sparse_forms.iter().filter(|(other, _)| unlike(form, other));
            // A row without any value is found among the rows that it is compared with.
            let own = u64::from(value_count(form) == 0);
            (*form, others.map(|(_, count)| count).sum::<u64>() - own)
        })
        .collect();
    Ok(cells.iter().map(|row| counts.get(row).copied().unwrap_or(0)).collect())
}

fn value_count(row: &[u32]) -> usize {
    row.iter().filter(|cell| **cell != 0).count()
}

/// Returns for each row how many other forms differ in at most `within` fields.
fn count_neighbouring_forms(cells: &[Vec<u32>], within: usize) -> CorpusResult<Vec<u64>> {
    let forms: Vec<Vec<u32>> = cells.iter().cloned().collect::<BTreeSet<_>>().into_iter().collect();
    let counts = count_row_neighbours(&forms, within).map_err(|_: UndefinedStatistic| too_many_subsets(within))?;
    let by_form: HashMap<&Vec<u32>, u64> = forms
        .iter()
        .zip(&counts)
        .map(|(form, row)| (form, sum_distances(row, 1..=within)))
        .collect();
    Ok(cells.iter().map(|row| by_form[row]).collect())
}

/// How often each value and each pair of values occurs, of the rows that have a value there.
struct ValueShares {
    fields: usize,
    values: HashMap<[u32; 2], u64>,
    given: Vec<u64>,
    value_pairs: HashMap<[u32; 4], u64>,
    given_pairs: HashMap<[u32; 2], u64>,
}

impl ValueShares {
    fn count_values(cells: &[Vec<u32>]) -> Self {
        let fields = cells.first().map_or(0, Vec::len);
        let mut shares = Self {
            fields,
            values: HashMap::new(),
            given: vec![0; fields],
            value_pairs: HashMap::new(),
            given_pairs: HashMap::new(),
        };
        for row in cells {
            for (field, value) in filled_cells(row) {
                *shares.values.entry([field, value]).or_default() += 1;
                shares.given[field as usize] += 1;
            }
            for [(field, value), (other_field, other_value)] in filled_pairs(row) {
                let pair = [field, value, other_field, other_value];
                *shares.value_pairs.entry(pair).or_default() += 1;
                *shares.given_pairs.entry([field, other_field]).or_default() += 1;
            }
        }
        shares
    }

    fn mean_value_share(&self, row: &[u32]) -> Option<f64> {
        let shares = filled_cells(row).map(|(field, value)| {
            let given = self.given[field as usize];
            self.values[&[field, value]] as f64 / given as f64
        });
        mean_of(shares)
    }

    fn mean_pair_share(&self, row: &[u32]) -> Option<f64> {
        if self.fields < 2 {
            return None;
        }
        let shares = filled_pairs(row).map(|[(field, value), (other_field, other_value)]| {
            let pair = [field, value, other_field, other_value];
            self.value_pairs[&pair] as f64 / self.given_pairs[&[field, other_field]] as f64
        });
        mean_of(shares)
    }
}

fn mean_of(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0_u32);
    for value in values {
        sum += value;
        count += 1;
    }
    (count > 0).then(|| sum / f64::from(count))
}

/// Returns the cells with a value, each with the number of its field.
fn filled_cells(row: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    let numbered = (0_u32..).zip(row.iter().copied());
    numbered.filter(|(_, value)| *value != 0)
}

fn filled_pairs(row: &[u32]) -> impl Iterator<Item = [(u32, u32); 2]> {
    filled_cells(row).flat_map(move |first| {
        let later = filled_cells(row).filter(move |(field, _)| *field > first.0);
        later.map(move |second| [first, second])
    })
}

/// Returns for each entry how many captured tokens its sign has, and of how many signers.
///
/// Tokens of one sign by one signer that overlap in time are the two hands of one token.
fn count_sign_uses(
    connection: &rusqlite::Connection,
    signs: &[MeasuredSign],
) -> CorpusResult<HashMap<i64, (u64, u64)>> {
    let uses = stored_attributes::load_sign_uses(connection)?;
    let mut counts: HashMap<i64, (u64, u64)> = HashMap::new();
    for of_sign in uses.chunk_by(|a, b| a.sign == b.sign) {
        let mut signers = BTreeSet::new();
        let mut tokens = 0;
        for of_signer in of_sign.chunk_by(|a, b| (a.recording, a.signer) == (b.recording, b.signer)) {
            signers.extend(of_signer[0].signer);
            let mut end_us = i64::MIN;
            for token in of_signer {
                tokens += u64::from(token.start_us >= end_us);
                end_us = end_us.max(token.end_us);
            }
        }
        counts.insert(of_sign[0].sign, (tokens, signers.len() as u64));
    }
    let entries: Vec<i64> = signs.iter().map(|sign| sign.token).collect();
    let of_entries = stored_attributes::signs_of_tokens(connection, &entries)?;
    Ok(of_entries
        .into_iter()
        .filter_map(|(token, sign)| Some((token, *counts.get(&sign)?)))
        .collect())
}
