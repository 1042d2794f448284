//! The column next to the query: recent queries, help by examples, and advice for empty results.

use std::collections::{BTreeMap, BTreeSet};

use chereme_corpus::words::translate_guide;
use chereme_corpus::{FindingKind, ProposalResult, QueryFinding, TokenNeighbours, guessed_query_text};
use chereme_sign::SignComponent;
use chereme_sign::query::{ComparisonOperator, QueryExpression, QueryValue, TestSubject, TokenQuery, WantedValue};
use eframe::egui::{Label, Popup, PopupCloseBehavior, RichText, Role, ScrollArea, Ui, WidgetInfo};

use super::hits::QueryAnswer;
use super::search_builder;
use super::search_rows::component_text;
use super::search_saved::{SavedSearchList, only_counted};
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::words::{InterfaceText, fill_text_braces, search_words as words, translate_library_message};
use crate::work::{WorkId, WorkOutcome, WorkResult, analysis, searching};

/// The examples of the help: a query, and a description of its results.
const QUERY_HELP_EXAMPLES: [(&str, InterfaceText); 9] = [
    ("right.configuration=U placement=chin", words::EXAMPLE_BOTH),
    ("gloss:BO*", words::EXAMPLE_GLOSS),
    ("movement=arc or movement=circle", words::EXAMPLE_OR),
    ("configuration=[index middle -thumb]", words::EXAMPLE_FEATURES),
    ("placement!=chest", words::EXAMPLE_NOT),
    ("duration<0.8s", words::EXAMPLE_TIME),
    ("movement=unset", words::EXAMPLE_UNSET),
    ("overlaps nonmanual.brows=raised", words::EXAMPLE_BESIDE),
    ("origin=made", words::EXAMPLE_MADE),
];

/// The column next to the query.
#[derive(Debug, Default)]
pub(super) struct SearchSideColumn {
    kept: SavedSearchList,
    /// For an empty result: the numbers of results without each condition.
    without: Option<RelaxedQueryCounts>,
    leaving: BTreeMap<WorkId, usize>,
    /// How many tokens have each requested component, and the component that is being proposed from movement.
    coded: ComponentCoverage,
    /// A result that is being opened, and its place once it is known.
    pub(super) opening: Option<WorkId>,
    pub(super) opened: Option<TokenNeighbours>,
}

/// Whether the components in a query are coded at all.
#[derive(Debug, Default)]
struct ComponentCoverage {
    counting: BTreeMap<WorkId, SignComponent>,
    counts: BTreeMap<SignComponent, usize>,
    proposing: Option<WorkId>,
}

impl ComponentCoverage {
    /// Counts the tokens that have each component of a query.
    fn request_component_counts(&mut self, query: &str, out: &CommandOutbox) {
        self.counts.clear();
        self.counting.clear();
        for component in required_query_components(query) {
            let query = format!("{}=*", component.component_name());
            let id = out.request_work(searching::search_tokens_job(query, only_counted()));
            self.counting.insert(id, component);
        }
    }

    fn receive_component_counts(&mut self, id: WorkId, ended: &WorkResult) {
        if let Some(component) = self.counting.remove(&id)
            && let Ok(WorkOutcome::Found(answer)) = ended
        {
            self.counts.insert(component, answer.total);
        }
        self.proposing.take_if(|work| *work == id);
    }

    /// Reports which components nobody has coded yet, and offers to infer them from movement.
    fn show_uncoded_components(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let glances = seen.snapshot.overview.recordings.iter();
        let moving = glances.filter(|glance| glance.frames > 0).count();
        for component in find_uncoded_components(&self.counts) {
            let name = seen.say_text(component_text(component));
            ui.label(fill_text_braces(
                seen.say_text(words::NOT_CODED),
                &[("component", &name)],
            ));
            if let Some(id) = self.proposing.filter(|id| seen.is_running(Some(*id))) {
                ui.horizontal(|ui| {
                    ui.spinner();
                    if let Some(far) = seen.work_progress(id) {
                        let all = far.total.unwrap_or(far.done);
                        let text = seen.say_text(words::PROPOSING);
                        ui.label(fill_text_braces(text, &[("n", &far.done), ("all", &all)]));
                    }
                    if ui.button(seen.say_text(words::STOP)).clicked() {
                        seen.send_command(WindowCommand::Stop(id));
                    }
                });
            } else if moving > 0
                && ProposalResult::READABLE_COMPONENTS.contains(&component)
                && !seen.snapshot.is_read_only()
            {
                let text = fill_text_braces(seen.say_text(words::PROPOSE), &[("n", &moving)]);
                if ui.button(text).clicked() {
                    self.proposing = Some(seen.request_work(analysis::propose_coding(component)));
                }
            }
        }
    }
}

/// Returns the components whose values a query requires, also those of one branch of an `or`.
fn required_query_components(query: &str) -> BTreeSet<SignComponent> {
    let mut named_components = BTreeSet::new();
    if let Ok(query) = TokenQuery::parse_query(query) {
        add_components(&query.root, &mut named_components);
    }
    named_components
}

fn add_components(expr: &QueryExpression, found: &mut BTreeSet<SignComponent>) {
    match expr {
        QueryExpression::And(terms) | QueryExpression::Or(terms) => {
            terms.iter().for_each(|term| add_components(term, found));
        }
        QueryExpression::Test(test) => {
            if let TestSubject::Component(field, comparison) = &test.what {
                let missing = |value: &QueryValue| matches!(value.wanted, WantedValue::Missing(_));
                let required =
                    comparison.operator != ComparisonOperator::IsNot && !comparison.values.iter().any(missing);
                found.extend(required.then_some(field.component));
            }
        }
        QueryExpression::Relation(_)
        | QueryExpression::Not(_)
        | QueryExpression::Like(_)
        | QueryExpression::Saved(_) => {}
    }
}

/// Returns the components without any coding.
fn find_uncoded_components(counts: &BTreeMap<SignComponent, usize>) -> Vec<SignComponent> {
    let none = counts.iter().filter(|(_, count)| **count == 0);
    none.map(|(component, _)| *component).collect()
}

/// For a query without results: the results without each of its conditions.
#[derive(Debug, Clone, PartialEq)]
struct RelaxedQueryCounts {
    query: String,
    /// Another query that was probably meant.
    meant: Option<String>,
    /// Each condition, the query without it, and the number of results of that query.
    parts: Vec<(String, String, Option<usize>)>,
}

/// Returns each condition of a query, with the query without that condition.
pub(super) fn queries_without_condition(query: &str) -> Vec<(String, String)> {
    let Ok(query) = TokenQuery::parse_query(query) else {
        return Vec::new();
    };
    let rows = search_builder::rows_from_query(&query);
    (0..rows.len())
        .map(|at| {
            let mut rest = rows.clone();
            let gone = rest.remove(at);
            (
                search_builder::query_text_from_rows(&[gone]),
                search_builder::query_text_from_rows(&rest),
            )
        })
        .collect()
}

impl SearchSideColumn {
    pub(super) fn forget_counts(&mut self) {
        self.kept.forget_counts();
        self.without = None;
    }

    pub(super) fn forget_nothing(&mut self) {
        self.without = None;
    }

    /// Stops the counts for an outdated query.
    pub(super) fn stop_outdated_counts(&mut self, out: &CommandOutbox) {
        let left = std::mem::take(&mut self.leaving).into_keys();
        left.for_each(|id| out.send_command(WindowCommand::Stop(id)));
    }

    pub(super) fn receive_relaxed_counts(&mut self, id: WorkId, ended: &WorkResult) {
        let total = match ended {
            Ok(WorkOutcome::Found(answer)) => Some(answer.total),
            _ => None,
        };
        self.kept.receive_saved_search_result(id, ended);
        self.coded.receive_component_counts(id, ended);
        if let Some(at) = self.leaving.remove(&id)
            && let Some(without) = &mut self.without
            && let Some(part) = without.parts.get_mut(at)
        {
            part.2 = total;
        }
        if self.opening == Some(id) {
            self.opening = None;
            if let Ok(WorkOutcome::Around(around)) = ended {
                self.opened = around.first().cloned();
            }
        }
    }

    /// Adds a query to the recent ones.
    pub(super) fn remember_recent_query(&mut self, query: &str, seen: &PaneInput<'_>) {
        let mut searches = seen.settings.searches.clone();
        if TokenQuery::parse_query(query).is_ok() && searches.record_recent_query(query) {
            seen.send_command(WindowCommand::Searches(searches));
        }
    }

    /// Draws the menus; returns the chosen query.
    pub(super) fn draw_query_menus(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, query: &str) -> Option<String> {
        let mut chosen = self.kept.show_saved_search_menu(ui, seen, query);
        let recent = ui.button(seen.say_text(words::RECENT));
        Popup::menu(&recent).show(|ui| {
            ui.set_min_width(260.0);
            if seen.settings.searches.recent.is_empty() {
                ui.weak(seen.say_text(words::NO_RECENT));
            }
            for query in &seen.settings.searches.recent {
                if ui.button(query).clicked() {
                    chosen = Some(query.clone());
                }
            }
        });
        let help = ui.button("?").on_hover_text(seen.say_text(words::HELP));
        help.widget_info(|| WidgetInfo::labeled(Role::Button, true, seen.say_text(words::HELP)));
        Popup::from_toggle_button_response(&help)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .show(|ui| {
                ui.set_min_width(420.0);
                let by_example = draw_example_queries(ui, seen);
                ui.collapsing(seen.say_text(words::WHOLE_HELP), |ui| {
                    ScrollArea::vertical().max_height(280.0).show(ui, |ui| {
                        let guide_text = translate_guide(chereme_corpus::QUERY_HELP, seen.language);
                        let text = RichText::new(guide_text).monospace().small();
                        ui.add(Label::new(text).extend());
                    });
                });
                chosen = chosen.take().or(by_example);
            });
        chosen
    }

    /// Reports that nothing was found, and which condition excludes everything; returns the query chosen instead.
    pub(super) fn report_empty_results(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, query: &str) -> Option<String> {
        ui.strong(seen.say_text(words::NOTHING));
        if self.without.as_ref().is_none_or(|without| without.query != query) {
            self.leaving.clear();
            self.coded.request_component_counts(query, seen.out);
            let parts = queries_without_condition(query);
            for (at, (_, rest)) in parts.iter().enumerate() {
                let id = seen.request_work(searching::search_tokens_job(rest.clone(), only_counted()));
                self.leaving.insert(id, at);
            }
            self.without = Some(RelaxedQueryCounts {
                query: query.to_owned(),
                meant: guessed_query_text(query, &seen.snapshot.overview.inventories),
                parts: parts.into_iter().map(|(part, rest)| (part, rest, None)).collect(),
            });
        }
        self.coded.show_uncoded_components(ui, seen);
        let without = self.without.as_ref()?;
        let mut chosen = None;
        if let Some(meant) = &without.meant {
            let text = fill_text_braces(seen.say_text(words::MEANT), &[("query", meant)]);
            if ui.button(text).clicked() {
                chosen = Some(meant.clone());
            }
        }
        if without.parts.is_empty() {
            return chosen;
        }
        if without.parts.iter().all(|(_, _, total)| *total == Some(0)) {
            ui.weak(seen.say_text(words::WITHOUT_NONE));
            return chosen;
        }
        ui.label(seen.say_text(words::WITHOUT));
        let helps = without.parts.iter().filter(|entry| entry.2 != Some(0));
        for (part, rest, total) in helps {
            let total = total.map_or("…".to_owned(), |count| count.to_string());
            let text = fill_text_braces(seen.say_text(words::WITHOUT_ONE), &[("part", part), ("n", &total)]);
            if ui.link(text).clicked() {
                chosen = Some(rest.clone());
            }
        }
        chosen
    }
}

/// Shows the findings of an answer: conditions that match more than they name, or nothing. Returns the query with
/// another name, if the user chose one.
pub(super) fn show_answer_findings(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    found: &QueryAnswer,
    query: &str,
) -> Option<String> {
    /// The most alternative names.
    const MAX_ALTERNATIVE_NAMES: usize = 6;
    let mut chosen = None;
    let reported = |finding: &&QueryFinding| !matches!(finding.kind, FindingKind::NotCoded { .. });
    for finding in found.findings.iter().filter(reported) {
        let text = translate_library_message(&finding.finding_message(), seen.language);
        ui.add(Label::new(RichText::new(text).small().weak()).wrap());
        let names = finding.alternative_names().iter().take(MAX_ALTERNATIVE_NAMES);
        let offers: Vec<(&String, String)> = names
            .filter_map(|name| Some((name, finding.replace_query_condition(query, name)?)))
            .collect();
        if offers.is_empty() {
            continue;
        }
        ui.horizontal_wrapped(|ui| {
            for (name, query) in offers {
                let text = fill_text_braces(seen.say_text(words::MEND), &[("text", name)]);
                if ui.small_button(text).clicked() {
                    chosen = Some(query);
                }
            }
        });
    }
    chosen
}

/// Draws example queries; returns the chosen one.
pub(super) fn draw_example_queries(ui: &mut Ui, seen: &PaneInput<'_>) -> Option<String> {
    let mut chosen = None;
    ui.label(RichText::new(seen.say_text(words::EXAMPLES)).strong());
    for (query, about) in QUERY_HELP_EXAMPLES {
        ui.horizontal_wrapped(|ui| {
            if ui.link(RichText::new(query).monospace()).clicked() {
                chosen = Some(query.to_owned());
            }
            ui.label(RichText::new(seen.say_text(about)).small().weak());
        });
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_condition_is_left_out_in_turn() {
        let pair = |part: &str, rest: &str| (part.to_owned(), rest.to_owned());
        assert_eq!(
            queries_without_condition("configuration=U placement=chin not gloss=A"),
            [
                pair("configuration=U", "placement=chin not gloss=A"),
                pair("placement=chin", "configuration=U not gloss=A"),
                pair("not gloss=A", "configuration=U placement=chin"),
            ]
        );
        assert!(queries_without_condition("").is_empty());
        assert!(queries_without_condition("a=(").is_empty());
    }

    #[test]
    fn components_with_a_required_value_are_listed_as_possibly_uncoded() {
        let of = |query: &str| Vec::from_iter(required_query_components(query));
        assert_eq!(of("right.configuration=U gloss=A"), [SignComponent::Configuration]);
        assert_eq!(
            of("placement=chin configuration==U,V"),
            [SignComponent::Configuration, SignComponent::Placement]
        );
        assert_eq!(
            of("placement=chin or (movement=arc gloss=A)"),
            [SignComponent::Placement, SignComponent::Movement]
        );
        assert!(of("configuration!=U").is_empty());
        assert!(of("movement=unset").is_empty());
        let counts = [(SignComponent::Configuration, 0), (SignComponent::Placement, 7)];
        assert_eq!(find_uncoded_components(&counts.into()), [SignComponent::Configuration]);
    }

    #[test]
    fn every_example_is_a_query() {
        for (query, _) in QUERY_HELP_EXAMPLES {
            assert!(query.parse::<TokenQuery>().is_ok(), "{query}");
        }
    }
}
