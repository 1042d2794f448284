//! Minimal pairs: signs that differ in exactly one field of a set.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::Corpus;
use crate::error::{CorpusError, CorpusResult};
use crate::forms::{EmptyCellTreatment, FormField, FormSource, SignForm, SignForms, named_fields, number_form_cells};
use crate::lexicon::LexiconScope;
use crate::progress::ProgressReceiver;

/// The fields that are compared, and the treatment of empty cells.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PairOptions {
    /// The fields: titles of the columns of an imported lexicon table, whose cells are compared as written; or fields
    /// of queries such as `dominant.configuration`, by which the citation forms of the corpus are compared. One word
    /// such as `S13` may stand for a [set](crate::FIELD_SETS). If empty, all coded fields.
    pub fields: Vec<String>,
    /// The treatment of an empty cell.
    pub empty: EmptyCellTreatment,
    /// The tokens whose signs are compared, as a query; without it the citation forms.
    pub query: Option<String>,
    /// The lexicons whose signs are compared.
    pub scope: LexiconScope,
}

/// The minimal pairs of a corpus.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MinimalPairs {
    /// How many pairs there are.
    pub total: usize,
    /// How many signs are in at least one of them.
    pub signs: usize,
    /// How many pairs of signs are equal in all fields.
    pub homonyms: usize,
    /// How many groups of equal signs there are.
    pub homonym_groups: usize,
    /// How many signs are in such a group.
    pub homonym_signs: usize,
    /// How many signs take part.
    pub entries: usize,
    /// The number of different forms among them.
    pub forms: usize,
    /// The number of pairs whose two values are both given; in the others one cell is empty.
    pub certain: usize,
    /// The number of pairs by differing field, most first.
    #[serde(serialize_with = "serialize_pair_counts")]
    pub by_field: Vec<(String, usize)>,
    /// The signs in the largest number of pairs, at most ten; equal numbers are ordered by gloss.
    pub densest: Vec<DenseSign>,
    /// The SHA-256 of the list: lines `A`, tab, `B`, tab, field, sorted, each ended by a line feed.
    pub sha256: String,
    /// The fields that were compared.
    pub fields: Vec<String>,
    /// The pairs themselves, in the order of the list.
    #[serde(skip)]
    pub list: Vec<MinimalPair>,
}

/// A sign with the number of pairs that it is in.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DenseSign {
    /// Its gloss.
    pub gloss: String,
    /// How many pairs it is in.
    pub pairs: usize,
}

/// Two signs that differ in one field.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct MinimalPair {
    /// The gloss that is the lesser of the two.
    pub a: String,
    /// The other gloss.
    pub b: String,
    /// The field in which they differ.
    pub field: String,
}

fn serialize_pair_counts<S: serde::Serializer>(
    counts: &[(String, usize)],
    out: S,
) -> std::result::Result<S::Ok, S::Error> {
    out.collect_map(counts.iter().map(|(field, count)| (field, count)))
}

/// The largest number of listed pairs.
const MAX_LISTED_PAIRS: usize = 5_000_000;
/// The number of densest signs that are listed.
const DENSEST_SIGN_COUNT: usize = 10;

impl Corpus {
    /// Returns the minimal pairs of the corpus: signs that differ in exactly one of the fields.
    ///
    /// # Errors
    /// [`CorpusError::Wrong`] if a field does not exist, or there are more pairs than can be listed.
    pub fn minimal_pairs(
        &mut self,
        options: &PairOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<MinimalPairs> {
        find_minimal_pairs(self.load_pair_forms(options, progress)?, options.empty)
    }

    /// Returns the forms that are compared.
    pub(crate) fn load_pair_forms(
        &mut self,
        options: &PairOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<SignForms> {
        let selection = self.select_forms(options.query.as_deref(), progress)?;
        let fields = named_fields(&options.fields);
        self.load_sign_forms(&fields, &selection, &options.scope, progress)
    }
}

/// Returns the minimal pairs of codings, by all fields that one of them has; `None` if there are too many to list.
pub(crate) fn of_codings(codings: &[(String, BTreeMap<String, String>)]) -> Option<MinimalPairs> {
    let field_names: BTreeSet<&String> = codings.iter().flat_map(|(_, it)| it.keys()).collect();
    let fields = field_names.into_iter().cloned().collect();
    // Signs without a coding would all be equal.
    let coded_signs = codings.iter().filter(|(_, it)| !it.is_empty());
    let coded: Vec<(String, BTreeMap<String, String>)> = coded_signs.cloned().collect();
    // The only failure is that there are too many.
    let forms = SignForms::forms_from_codings(&coded, fields, FormSource::Citations);
    find_minimal_pairs(forms, EmptyCellTreatment::Value).ok()
}

/// Two forms that are equal, or differ in the handshape of the dominant hand alone.
pub(crate) struct FormsAlike {
    /// The tokens with these forms.
    pub(crate) tokens: [i64; 2],
    pub(crate) differs_in_handshape: bool,
}

/// How many fields two forms must have in common before their form decides that they are related.
const DECIDING_FIELD_COUNT: usize = 3;

/// Returns the pairs of forms that are equal, or differ in the handshape of the dominant hand alone.
///
/// # Errors
/// Fails if there are too many to list.
pub(crate) fn find_forms_alike(table: &SignForms) -> CorpusResult<Vec<FormsAlike>> {
    let (cells, _) = number_form_cells(&table.rows);
    let is_handshape = |field: &FormField| field.coding.as_deref() == Some("dominant.configuration");
    let handshape = table.fields.iter().position(is_handshape);
    let mut alike = Vec::new();
    for without in [None, handshape].into_iter().take(1 + usize::from(handshape.is_some())) {
        for group in group_equal_rows(&cells, without).values() {
            // Signs of which little is coded would all be related. The empty cell has the number 0.
            let coded = cells[group[0]].iter();
            let common = coded.filter(|cell| **cell != 0).count();
            for (at, one) in group.iter().enumerate().filter(|_| common >= DECIDING_FIELD_COUNT) {
                for other in &group[at + 1..] {
                    let shapes = without.map(|field| [cells[*one][field], cells[*other][field]]);
                    let differs = shapes.is_some_and(|[own, its]| own != its && own != 0 && its != 0);
                    let tokens = [table.rows[*one].token, table.rows[*other].token];
                    if let [Some(one), Some(other)] = tokens
                        && differs == without.is_some()
                    {
                        alike.push(FormsAlike {
                            tokens: [one, other],
                            differs_in_handshape: differs,
                        });
                    }
                }
                if alike.len() > MAX_LISTED_PAIRS {
                    return Err(too_many_pairs_error());
                }
            }
        }
    }
    Ok(alike)
}

fn too_many_pairs_error() -> CorpusError {
    let text = format!("there are more than {MAX_LISTED_PAIRS} pairs");
    CorpusError::from_wrong_message(text).with_advice("compare more fields")
}

fn find_minimal_pairs(mut table: SignForms, empty: EmptyCellTreatment) -> CorpusResult<MinimalPairs> {
    if empty == EmptyCellTreatment::Unknown {
        table.rows.retain(SignForm::is_complete);
    }
    // Sorted rows give every pair in the same order.
    table.rows.sort();
    let (cells, _) = number_form_cells(&table.rows);
    let forms = group_equal_rows(&cells, None);
    let several = || forms.values().filter(|group| group.len() > 1);
    let mut found_pairs: Vec<(usize, usize, usize)> = Vec::new();
    let mut by_field = Vec::new();
    let mut certain = 0;
    for (field, own) in table.fields.iter().enumerate() {
        let before = found_pairs.len();
        for group in group_equal_rows(&cells, Some(field)).values() {
            for (at, one) in group.iter().enumerate() {
                // Each pair is met once.
                for other in &group[at + 1..] {
                    let (a, b) = (cells[*one][field], cells[*other][field]);
                    if a == b {
                        continue;
                    }
                    // The empty cell has the number 0.
                    certain += usize::from(a != 0 && b != 0);
                    found_pairs.push((*one, *other, field));
                }
                // The limit is tested while pairs are found, since their number can grow with the square of
                // the signs.
                if found_pairs.len() > MAX_LISTED_PAIRS {
                    return Err(too_many_pairs_error());
                }
            }
        }
        by_field.push((own.name.clone(), found_pairs.len() - before));
    }
    by_field.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let mut degrees = vec![0; table.rows.len()];
    for (one, other, _) in &found_pairs {
        degrees[*one] += 1;
        degrees[*other] += 1;
    }
    let list = list_minimal_pairs(&table, &found_pairs);
    Ok(MinimalPairs {
        total: found_pairs.len(),
        signs: degrees.iter().filter(|degree| **degree > 0).count(),
        homonyms: several().map(|group| group.len() * (group.len() - 1) / 2).sum(),
        homonym_groups: several().count(),
        homonym_signs: several().map(Vec::len).sum(),
        entries: table.rows.len(),
        forms: forms.len(),
        certain,
        by_field,
        densest: densest(&table, &degrees),
        sha256: minimal_pairs_sha256(&list),
        fields: table.fields.into_iter().map(|field| field.name).collect(),
        list,
    })
}

/// Returns groups of rows that are equal in all fields, or in all fields but `without`; rows are in order.
fn group_equal_rows(cells: &[Vec<u32>], without: Option<usize>) -> BTreeMap<Vec<u32>, Vec<usize>> {
    let mut groups: BTreeMap<Vec<u32>, Vec<usize>> = BTreeMap::new();
    for (at, row) in cells.iter().enumerate() {
        let mut key = row.clone();
        if let Some(field) = without {
            key.remove(field);
        }
        groups.entry(key).or_default().push(at);
    }
    groups
}

/// Returns the pairs in the order of their lines; rows are sorted by gloss.
fn list_minimal_pairs(table: &SignForms, found: &[(usize, usize, usize)]) -> Vec<MinimalPair> {
    let pair = |(one, other, field): &(usize, usize, usize)| MinimalPair {
        a: table.rows[*one].gloss.clone(),
        b: table.rows[*other].gloss.clone(),
        field: table.fields[*field].name.clone(),
    };
    let mut list: Vec<MinimalPair> = found.iter().map(pair).collect();
    list.sort_by_cached_key(minimal_pair_line);
    list
}

fn minimal_pair_line(pair: &MinimalPair) -> String {
    format!("{}\t{}\t{}\n", pair.a, pair.b, pair.field)
}

fn minimal_pairs_sha256(list: &[MinimalPair]) -> String {
    let mut hash = Sha256::new();
    for pair in list {
        hash.update(minimal_pair_line(pair).as_bytes());
    }
    let mut text = String::new();
    for byte in hash.finalize() {
        let _ = write!(text, "{byte:02x}");
    }
    text
}

fn densest(table: &SignForms, degrees: &[usize]) -> Vec<DenseSign> {
    let mut all: Vec<(usize, &String)> = degrees
        .iter()
        .zip(&table.rows)
        .map(|(degree, form)| (*degree, &form.gloss))
        .filter(|(degree, _)| *degree > 0)
        .collect();
    all.sort_by(|a, b| b.0.cmp(&a.0).then_with(|| a.1.cmp(b.1)));
    let named = all.into_iter().take(DENSEST_SIGN_COUNT);
    named
        .map(|(pairs, gloss)| DenseSign {
            gloss: gloss.clone(),
            pairs,
        })
        .collect()
}

#[cfg(test)]
mod tests;
