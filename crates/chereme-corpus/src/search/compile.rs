//! Compiles the tree of a query to a plan.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::sync::Arc;

use chereme_sign::ErrorRemedy;
use chereme_sign::SignComponent;
use chereme_sign::query::{
    ComparisonOperator, MissingReason, QueryError, QueryExpression, QueryPlace, QueryTest, QueryValue, TestSubject,
    TextPattern, TimeField, TimeTest, ValueComparison, WantedValue, WholeTokenProperty,
};
use chereme_sign::text::{fold_text, nearest_candidate};
use rusqlite::Connection;

use super::docs::DocumentList;
use super::index::SearchIndex;
use super::probe::{DocumentIndex, IndexProbe, IndexTextField, RowField};
use super::search_attributes;
use super::search_component::ComponentTest;
use super::search_curves;
use super::search_finding::{FindingKind, QueryFinding};
use super::search_known::{KnownReadings, KnownSigns};
use super::search_plan::QueryPlan;
use super::search_sources;
use super::search_texts::TextGlob;
use super::search_vocabulary::QueryVocabulary;
use super::text_match;
use super::time_relations::NeighbourRelation;
use crate::db::stored_search::search_answers::{self, DETECTOR_NAME, NamedRowKind};
use crate::db::stored_search::search_terms::TokenProperty;
use crate::error::{CorpusError, CorpusResult};
use crate::notation;

/// The corpus and index against which a query is evaluated.
pub(crate) struct QueryContext<'a> {
    pub(crate) connection: &'a Connection,
    pub(crate) index: &'a SearchIndex,
    /// The index at the time of the query.
    pub(crate) now: &'a dyn DocumentIndex,
    pub(crate) vocabulary: Arc<QueryVocabulary>,
    /// Whether comparisons read opinions beside the values that count.
    pub(crate) opinions: Cell<bool>,
    /// Whether a comparison asks who says its value, so that hits show the opinions.
    pub(crate) asks_sources: Cell<bool>,
    pub(crate) notes: RefCell<BTreeSet<String>>,
    pub(crate) findings: RefCell<Vec<QueryFinding>>,
    /// The number of rows examined so far.
    pub(crate) looked_at: Cell<u64>,
    /// Receives the number of examined rows, and decides whether to go on.
    pub(crate) hear: &'a RefCell<dyn FnMut(u64) -> CorpusResult<()> + 'a>,
}

/// The reason why a query has no answer.
pub(crate) enum QueryFailure {
    /// The query names something that does not exist.
    Query(QueryError),
    /// Rows or index cannot be read.
    Other(CorpusError),
}

/// The result of a step of evaluation.
pub(crate) type QueryResult<T> = std::result::Result<T, QueryFailure>;

impl From<QueryError> for QueryFailure {
    fn from(error: QueryError) -> Self {
        Self::Query(error)
    }
}

impl From<CorpusError> for QueryFailure {
    fn from(error: CorpusError) -> Self {
        Self::Other(error)
    }
}

impl QueryContext<'_> {
    /// Returns the readings of a component that the index holds.
    pub(crate) fn known_component_readings(&self, component: SignComponent) -> CorpusResult<Arc<KnownReadings>> {
        let mut memory = self.index.query_memory();
        memory.cached_readings(self.now, component, self.opinions.get())
    }

    /// Returns the documents that the index has for a probe.
    pub(crate) fn run_index_probe(&self, probe: &IndexProbe) -> CorpusResult<DocumentList> {
        self.go_on()?;
        self.now.find_matching_documents(probe)
    }

    /// Fails if the caller no longer wants an answer.
    pub(crate) fn go_on(&self) -> CorpusResult<()> {
        (self.hear.borrow_mut())(self.looked_at.get())
    }

    /// Counts an examined row, and checks from time to time whether to go on.
    pub(crate) fn count_examined_row(&self) -> CorpusResult<()> {
        const STOP_CHECK_ROWS: u64 = 64;
        let rows = self.looked_at.get() + 1;
        self.looked_at.set(rows);
        if rows.is_multiple_of(STOP_CHECK_ROWS) {
            self.go_on()?;
        }
        Ok(())
    }

    /// Returns the signs of the corpus.
    pub(crate) fn known_signs(&self) -> CorpusResult<Arc<KnownSigns>> {
        self.index.query_memory().cached_signs(self.connection)
    }

    /// Adds a note for the user.
    pub(crate) fn add_query_note(&self, text: String) {
        self.notes.borrow_mut().insert(text);
    }

    /// Adds a finding about a condition, once.
    pub(crate) fn add_query_finding(&self, condition: String, at: QueryPlace, kind: FindingKind) {
        let finding = QueryFinding::new(condition, at, kind);
        let mut findings = self.findings.borrow_mut();
        if !findings.contains(&finding) {
            findings.push(finding);
        }
    }
}

/// Returns the plan for an expression. A search by example selects every token and only affects the order.
///
/// # Errors
/// Fails if the expression names a value, feature, signer or the like that does not exist, or ranks by what it
/// excludes.
pub(crate) fn plan_expression(ask: &QueryContext<'_>, expr: &QueryExpression) -> QueryResult<QueryPlan> {
    match expr {
        QueryExpression::And(terms) => {
            let ranked = |term: &&QueryExpression| !matches!(term, QueryExpression::Like(_));
            // The relation is then to a stretch of the curve, so the other may also lie in the token itself.
            let of_curve = terms.iter().any(is_of_curve);
            let plans = terms.iter().filter(ranked).map(|term| match term {
                QueryExpression::Relation(related) if of_curve => {
                    let related_plan = NeighbourRelation::new(ask, Some(related.relation), &related.other)?;
                    Ok(QueryPlan::Beside(Box::new(related_plan.or_itself())))
                }
                term => plan_expression(ask, term),
            });
            Ok(QueryPlan::conjoin_plans(plans.collect::<QueryResult<_>>()?))
        }
        QueryExpression::Or(terms) => {
            let plans = terms.iter().map(|term| plan_inner_operand(ask, term));
            Ok(QueryPlan::disjoin_plans(plans.collect::<QueryResult<_>>()?))
        }
        QueryExpression::Not(negated) => Ok(plan_inner_operand(ask, negated)?.negate_plan()),
        QueryExpression::Test(test) => self::plan_comparison(ask, test),
        QueryExpression::Relation(related) => {
            let related_plan = NeighbourRelation::new(ask, Some(related.relation), &related.other)?;
            Ok(QueryPlan::Beside(Box::new(related_plan)))
        }
        QueryExpression::Like(_) => Ok(QueryPlan::select_all_plan()),
        QueryExpression::Saved(saved) => Err(QueryError {
            at: saved.at.char_range(),
            message: format!("no search is saved as {:?}", saved.name),
            remedy: ErrorRemedy::command_remedy("`chereme list CORPUS searches` lists those that are"),
            suggestion: None,
        }
        .into()),
    }
}

fn is_of_curve(term: &QueryExpression) -> bool {
    matches!(term, QueryExpression::Test(test) if matches!(test.what, TestSubject::Curve(..)))
}

/// Returns the plan for an operand of a connective, in which a search by example is not allowed.
fn plan_inner_operand(ask: &QueryContext<'_>, expr: &QueryExpression) -> QueryResult<QueryPlan> {
    let example = match expr {
        QueryExpression::Like(like) => Some(like),
        QueryExpression::And(terms) => terms.iter().find_map(|term| match term {
            QueryExpression::Like(like) => Some(like),
            _ => None,
        }),
        _ => None,
    };
    match example {
        None => plan_expression(ask, expr),
        Some(like) => Err(QueryError {
            at: like.at.char_range(),
            message: "`like` orders the whole answer, or removes less similar tokens from all of it".to_owned(),
            remedy: "write it beside the other terms, not after `not` or `or`".into(),
            suggestion: None,
        }
        .into()),
    }
}

fn phase_of_no_token(at: std::ops::Range<usize>) -> QueryError {
    QueryError {
        at,
        message: "phases of movement are not values of a token: they divide the time of signing".to_owned(),
        remedy: "write a relation to them: overlaps movement.phase=stroke".into(),
        suggestion: None,
    }
}

/// Returns the plan for one comparison.
pub(crate) fn plan_comparison(ask: &QueryContext<'_>, test: &QueryTest) -> QueryResult<QueryPlan> {
    match &test.what {
        TestSubject::Component(field, comparison) => {
            let range = test.subject_at.char_range();
            if field.component == SignComponent::Movement && field.feature.as_deref() == Some("phase") {
                return Err(phase_of_no_token(range).into());
            }
            ComponentTest::new(ask, field, comparison, range)?.plan_component_test(ask)
        }
        TestSubject::Said(field, comparison, sources) => {
            let range = test.subject_at.char_range();
            search_sources::plan_said_value(ask, field, comparison, sources, range)
        }
        TestSubject::Property(property, comparison) => self::plan_property(ask, *property, comparison),
        TestSubject::Whole(field, comparison) => text_match::plan_text_comparison(ask, *field, comparison),
        TestSubject::Words(..) | TestSubject::Fuzzy { .. } => text_match::words_plan(ask, test),
        TestSubject::Tier(..) => Ok(QueryPlan::Beside(Box::new(NeighbourRelation::new(ask, None, test)?))),
        TestSubject::Time(field, times) => Ok(QueryPlan::Index(self::probe_time_range(*field, *times))),
        TestSubject::Attribute(name, wanted) => search_attributes::plan_attribute_test(ask, test, name, wanted),
        TestSubject::Curve(wanted) => search_curves::plan_curve_test(ask, test, wanted),
        TestSubject::Notation(wanted) => {
            let tokens = notation::tokens_with_notation(ask.connection, |text| wanted.accepts_notation(text))?;
            Ok(QueryPlan::Index(IndexProbe::Rows(RowField::Token, tokens)))
        }
    }
}

fn probe_time_range(field: TimeField, test: TimeTest) -> IndexProbe {
    let (least, most) = test.time_bounds();
    IndexProbe::Between(field, least, most)
}

fn plan_property(
    ask: &QueryContext<'_>,
    property: WholeTokenProperty,
    comparison: &ValueComparison,
) -> QueryResult<QueryPlan> {
    let values = comparison.values.iter();
    let plans = values.map(|value| match &value.wanted {
        WantedValue::Present => plan_has_property(ask, property),
        WantedValue::Missing(MissingReason::Unset) => Ok(plan_has_property(ask, property)?.negate_plan()),
        WantedValue::Missing(_) | WantedValue::Features(_) | WantedValue::Steps(_) => Ok(QueryPlan::select_none_plan()),
        WantedValue::Named(pattern) => {
            plan_named_property(ask, property, &RequestedName::new(comparison.operator, pattern, value))
        }
    });
    let any_plan = QueryPlan::disjoin_plans(plans.collect::<QueryResult<_>>()?);
    if comparison.operator != ComparisonOperator::IsNot {
        return Ok(any_plan);
    }
    let names = |value: &QueryValue| matches!(value.wanted, WantedValue::Named(_));
    // A named value is unlike only what has a value: tokens without one have no other signer.
    if comparison.values.iter().any(names) {
        Ok(QueryPlan::conjoin_plans(vec![
            plan_has_property(ask, property)?,
            any_plan.negate_plan(),
        ]))
    } else {
        Ok(any_plan.negate_plan())
    }
}

/// A requested name.
pub(super) struct RequestedName<'a> {
    glob: TextGlob,
    exactly: bool,
    text: String,
    literal: bool,
    value: &'a QueryValue,
}

impl<'a> RequestedName<'a> {
    fn new(operator: ComparisonOperator, pattern: &TextPattern, value: &'a QueryValue) -> Self {
        let exactly = operator == ComparisonOperator::Exactly;
        Self {
            glob: match exactly {
                true => TextGlob::from_exact_pattern(pattern),
                false => TextGlob::from_whole_pattern(pattern),
            },
            exactly,
            text: pattern.as_literal().map_or_else(|| pattern.to_string(), str::to_owned),
            literal: pattern.as_literal().is_some(),
            value,
        }
    }

    /// Returns the names among the values of a comparison.
    pub(super) fn of_comparison(comparison: &'a ValueComparison) -> Vec<Self> {
        let named = |value: &'a QueryValue| match &value.wanted {
            WantedValue::Named(pattern) => Some(Self::new(comparison.operator, pattern, value)),
            _ => None,
        };
        comparison.values.iter().filter_map(named).collect()
    }

    pub(super) fn is_requested_name(&self, name: &str) -> bool {
        if self.exactly {
            self.glob.matches_whole_text(name)
        } else {
            self.glob.fits_either_text(name, &fold_text(name))
        }
    }

    fn unknown_name_failure(&self, kind: &str, known: impl IntoIterator<Item = String>) -> QueryFailure {
        const MAX_SUGGESTED_NAMES: usize = 8;
        let known_names: Vec<String> = known.into_iter().collect();
        let shown = known_names
            .iter()
            .take(MAX_SUGGESTED_NAMES)
            .cloned()
            .collect::<Vec<_>>();
        let more = match known_names.len() {
            0 => format!("the corpus has no {kind}"),
            1..=MAX_SUGGESTED_NAMES => format!("there are: {}", shown.join(", ")),
            count => format!(
                "there are: {} and {} more",
                shown.join(", "),
                count - MAX_SUGGESTED_NAMES
            ),
        };
        let near = nearest_candidate(&self.text, known_names.iter().map(String::as_str));
        QueryFailure::Query(QueryError {
            at: self.value.at.char_range(),
            message: format!("no {kind} is called {:?}", self.text),
            remedy: more.into(),
            suggestion: near.map(quote_query_name),
        })
    }
}

fn quote_query_name(name: &str) -> String {
    let bare = |c: char| c.is_alphanumeric() || "-_.:".contains(c);
    if name.chars().all(bare) {
        name.to_owned()
    } else {
        format!("{name:?}")
    }
}

fn mark_of(property: WholeTokenProperty) -> Option<TokenProperty> {
    match property {
        WholeTokenProperty::Origin => Some(TokenProperty::Origin),
        WholeTokenProperty::Hand => Some(TokenProperty::Hand),
        WholeTokenProperty::Tier => Some(TokenProperty::Tier),
        WholeTokenProperty::Inventory => Some(TokenProperty::Inventory),
        WholeTokenProperty::Lexicon => Some(TokenProperty::Lexicon),
        WholeTokenProperty::Language => Some(TokenProperty::Language),
        WholeTokenProperty::File => Some(TokenProperty::File),
        WholeTokenProperty::Proposed => Some(TokenProperty::Proposed),
        WholeTokenProperty::Disputed => Some(TokenProperty::Disputed),
        _ => None,
    }
}

/// Returns the plan for the tokens that have some value of a property.
fn plan_has_property(ask: &QueryContext<'_>, property: WholeTokenProperty) -> QueryResult<QueryPlan> {
    if let Some(mark) = mark_of(property) {
        let terms = ask
            .now
            .field_terms(IndexTextField::Reading, &mark.property_term_prefix(), &|_| true)?;
        return Ok(QueryPlan::Index(IndexProbe::from_reading_terms(terms)));
    }
    let field = match property {
        WholeTokenProperty::By => return plan_annotators(ask, &|_| true),
        WholeTokenProperty::Signer => RowField::Signer,
        WholeTokenProperty::Recording => RowField::Recording,
        _ => return Ok(QueryPlan::select_all_plan()),
    };
    Ok(QueryPlan::Index(IndexProbe::Has(field)))
}

fn plan_named_property(
    ask: &QueryContext<'_>,
    property: WholeTokenProperty,
    wish: &RequestedName<'_>,
) -> QueryResult<QueryPlan> {
    if let (WholeTokenProperty::Proposed | WholeTokenProperty::Disputed, "no") = (property, wish.text.as_str()) {
        return Ok(plan_has_property(ask, property)?.negate_plan());
    }
    if let Some(mark) = mark_of(property) {
        return plan_marked_property(ask, property, mark, wish);
    }
    if property == WholeTokenProperty::By {
        check_annotator(ask, wish)?;
        return plan_annotators(ask, &|name| wish.is_requested_name(name));
    }
    let (field, kind, rows) = match property {
        WholeTokenProperty::Token => return plan_token_number(wish),
        WholeTokenProperty::Signer => (RowField::Signer, "signer", NamedRowKind::Signer),
        WholeTokenProperty::Recording => (RowField::Recording, "recording", NamedRowKind::Recording),
        _ => (RowField::Sign, "sign", NamedRowKind::Sign),
    };
    // A number may be that of a row, or a name of digits, as recordings often have.
    if wish.literal
        && let Ok(number) = wish.text.parse::<i64>()
        && search_answers::find_row_name(ask.connection, rows, number)?.is_some()
    {
        return Ok(QueryPlan::Index(IndexProbe::Rows(field, vec![number])));
    }
    let names = search_answers::list_row_names(ask.connection, rows)?;
    let matching_names = names.iter().filter(|(_, name)| wish.is_requested_name(name));
    let mut ids: Vec<i64> = matching_names.map(|(id, _)| *id).collect();
    // A gloss of several lexicons is distinguished as `NGT/BOOK`; a gloss may hold a slash itself.
    if ids.is_empty() && property == WholeTokenProperty::Sign {
        let entries = search_answers::list_row_names(ask.connection, NamedRowKind::LexiconEntry)?;
        let matching_entries = entries.iter().filter(|(_, name)| wish.is_requested_name(name));
        ids.extend(matching_entries.map(|(id, _)| *id));
    }
    if ids.is_empty() && wish.literal {
        return Err(wish.unknown_name_failure(kind, names.into_iter().map(|(_, name)| name)));
    }
    Ok(QueryPlan::Index(IndexProbe::Rows(field, ids)))
}

fn plan_marked_property(
    ask: &QueryContext<'_>,
    property: WholeTokenProperty,
    mark: TokenProperty,
    wish: &RequestedName<'_>,
) -> QueryResult<QueryPlan> {
    let prefix = mark.property_term_prefix();
    let terms = ask.now.field_terms(IndexTextField::Reading, &prefix, &|_| true)?;
    let name = |term: &String| term[prefix.len()..].to_owned();
    let matching_terms: Vec<&String> = terms
        .iter()
        .filter(|term| wish.is_requested_name(&name(term)))
        .collect();
    // A fixed value that no token has, such as an origin, is right and finds nothing.
    if matching_terms.is_empty() && wish.literal && property.fixed_values().is_none() {
        let mut known_terms: BTreeSet<String> = terms.iter().map(name).collect();
        // An inventory exists before a token uses it.
        if property == WholeTokenProperty::Inventory {
            known_terms.extend(ask.vocabulary.inventory_ids().map(str::to_owned));
        }
        if !known_terms.iter().any(|name| wish.is_requested_name(name)) {
            return Err(wish.unknown_name_failure(property.property_name(), known_terms));
        }
    }
    Ok(QueryPlan::Index(IndexProbe::from_reading_terms(matching_terms)))
}

/// Fails if a name is that of no annotator.
pub(super) fn check_annotator(ask: &QueryContext<'_>, wish: &RequestedName<'_>) -> QueryResult<()> {
    let mut all_names = search_answers::annotator_names(ask.connection)?;
    all_names.extend(
        search_answers::annotator_aliases(ask.connection)?
            .into_values()
            .flatten(),
    );
    all_names.push(DETECTOR_NAME.to_owned());
    match !wish.literal || all_names.iter().any(|name| wish.is_requested_name(name)) {
        true => Ok(()),
        false => Err(wish.unknown_name_failure("annotator", all_names)),
    }
}

/// Returns the plan for the tokens with values by annotators or detectors.
fn plan_annotators(ask: &QueryContext<'_>, is_meant: &dyn Fn(&str) -> bool) -> QueryResult<QueryPlan> {
    let aliases = search_answers::annotator_aliases(ask.connection)?;
    let is_any_meant =
        |name: &str| is_meant(name) || aliases.get(name).into_iter().flatten().any(|name| is_meant(name));
    let tokens = search_answers::tokens_by_annotator(ask.connection, &is_any_meant)?;
    let mut plans = vec![QueryPlan::Index(IndexProbe::Rows(RowField::Token, tokens))];
    if is_meant(DETECTOR_NAME) {
        plans.push(plan_has_property(ask, WholeTokenProperty::Proposed)?);
    }
    Ok(QueryPlan::disjoin_plans(plans))
}

fn plan_token_number(wish: &RequestedName<'_>) -> QueryResult<QueryPlan> {
    match wish.text.parse::<i64>() {
        Ok(number) if number >= 0 => Ok(QueryPlan::Index(IndexProbe::Rows(RowField::Token, vec![number]))),
        _ => Err(QueryError {
            at: wish.value.at.char_range(),
            message: format!("{:?} is no number of a token", wish.text),
            remedy: "write token=41; a sign is found by gloss=CHAT".into(),
            suggestion: None,
        }
        .into()),
    }
}
