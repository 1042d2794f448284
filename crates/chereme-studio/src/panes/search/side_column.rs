//! The column next to the query: recent queries, help by examples, and advice for empty results.

use std::collections::{BTreeMap, BTreeSet};

use chereme_corpus::words::guide;
use chereme_corpus::{Around, Finding, FindingKind, Proposed, guessed};
use chereme_sign::Component;
use chereme_sign::query::{Expr, Operator, Query, Value, Wanted, What};
use eframe::egui::{Label, Popup, PopupCloseBehavior, RichText, Role, ScrollArea, Ui, WidgetInfo};

use super::builder;
use super::hits::Found;
use super::rows::component_text;
use super::saved::{Kept, only_counted};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::words::{Text, fill, search as words, spoken};
use crate::work::{Ended, Outcome, WorkId, analysis, searching};

/// The examples of the help: a query, and a description of its results.
const EXAMPLES: [(&str, Text); 9] = [
    ("right.configuration=U placement=chin", words::EXAMPLE_BOTH),
    ("gloss:BO*", words::EXAMPLE_GLOSS),
    ("movement=arc or movement=circle", words::EXAMPLE_OR),
    (
        "configuration=[index middle -thumb]",
        words::EXAMPLE_FEATURES,
    ),
    ("placement!=chest", words::EXAMPLE_NOT),
    ("duration<0.8s", words::EXAMPLE_TIME),
    ("movement=unset", words::EXAMPLE_UNSET),
    ("overlaps nonmanual.brows=raised", words::EXAMPLE_BESIDE),
    ("origin=made", words::EXAMPLE_MADE),
];

/// The column next to the query.
#[derive(Debug, Default)]
pub(super) struct Aside {
    kept: Kept,
    /// For an empty result: the numbers of results without each condition.
    without: Option<Without>,
    leaving: BTreeMap<WorkId, usize>,
    /// How many tokens have each requested component, and the component that is being proposed from movement.
    coded: Coded,
    /// A result that is being opened, and its place once it is known.
    pub(super) opening: Option<WorkId>,
    pub(super) opened: Option<Around>,
}

/// Whether the components in a query are coded at all.
#[derive(Debug, Default)]
struct Coded {
    counting: BTreeMap<WorkId, Component>,
    counts: BTreeMap<Component, usize>,
    proposing: Option<WorkId>,
}

impl Coded {
    /// Counts the tokens that have each component of a query.
    fn follow(&mut self, query: &str, out: &mut Outbox) {
        self.counts.clear();
        self.counting.clear();
        for component in components(query) {
            let query = format!("{}=*", component.name());
            let id = out.work(searching::search(query, only_counted()));
            self.counting.insert(id, component);
        }
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        if let Some(component) = self.counting.remove(&id)
            && let Ok(Outcome::Found(answer)) = ended
        {
            self.counts.insert(component, answer.total);
        }
        self.proposing.take_if(|it| *it == id);
    }

    /// Reports which components nobody has coded yet, and offers to infer them from movement.
    fn show(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let moving = seen.snapshot.overview.recordings.iter();
        let moving = moving.filter(|it| it.frames > 0).count();
        for component in uncoded(&self.counts) {
            let name = seen.say(component_text(component));
            ui.label(fill(seen.say(words::NOT_CODED), &[("component", &name)]));
            if let Some(id) = self.proposing.filter(|id| seen.is_running(Some(*id))) {
                ui.horizontal(|ui| {
                    ui.spinner();
                    if let Some(far) = seen.far(id) {
                        let all = far.total.unwrap_or(far.done);
                        let text = seen.say(words::PROPOSING);
                        ui.label(fill(text, &[("n", &far.done), ("all", &all)]));
                    }
                    if ui.button(seen.say(words::STOP)).clicked() {
                        out.send(Command::Stop(id));
                    }
                });
            } else if moving > 0
                && Proposed::COMPONENTS.contains(&component)
                && !seen.snapshot.is_read_only()
            {
                let text = fill(seen.say(words::PROPOSE), &[("n", &moving)]);
                if ui.button(text).clicked() {
                    self.proposing = Some(out.work(analysis::propose_coding(component)));
                }
            }
        }
    }
}

/// Returns the components whose values a query requires, also those of one branch of an `or`.
fn components(query: &str) -> BTreeSet<Component> {
    let mut found = BTreeSet::new();
    if let Ok(query) = Query::parse(query) {
        add_components(&query.root, &mut found);
    }
    found
}

fn add_components(expr: &Expr, found: &mut BTreeSet<Component>) {
    match expr {
        Expr::And(terms) | Expr::Or(terms) => {
            terms.iter().for_each(|term| add_components(term, found));
        }
        Expr::Test(test) => {
            if let What::Component(field, comparison) = &test.what {
                let missing = |value: &Value| matches!(value.wanted, Wanted::Missing(_));
                let required = comparison.operator != Operator::IsNot
                    && !comparison.values.iter().any(missing);
                found.extend(required.then_some(field.component));
            }
        }
        Expr::Relation(_) | Expr::Not(_) | Expr::Like(_) | Expr::Saved(_) => {}
    }
}

/// Returns the components without any coding.
fn uncoded(counts: &BTreeMap<Component, usize>) -> Vec<Component> {
    let none = counts.iter().filter(|(_, count)| **count == 0);
    none.map(|(component, _)| *component).collect()
}

/// For a query without results: the results without each of its conditions.
#[derive(Debug, Clone, PartialEq)]
struct Without {
    query: String,
    /// Another query that was probably meant.
    meant: Option<String>,
    /// Each condition, the query without it, and the number of results of that query.
    parts: Vec<(String, String, Option<usize>)>,
}

/// Returns each condition of a query, with the query without that condition.
pub(super) fn parts(query: &str) -> Vec<(String, String)> {
    let Ok(query) = Query::parse(query) else {
        return Vec::new();
    };
    let rows = builder::rows(&query);
    (0..rows.len())
        .map(|at| {
            let mut rest = rows.clone();
            let gone = rest.remove(at);
            (builder::text(&[gone]), builder::text(&rest))
        })
        .collect()
}

impl Aside {
    pub(super) fn forget_counts(&mut self) {
        self.kept.forget_counts();
        self.without = None;
    }

    pub(super) fn forget_nothing(&mut self) {
        self.without = None;
    }

    /// Stops the counts for an outdated query.
    pub(super) fn stop(&mut self, out: &mut Outbox) {
        let left = std::mem::take(&mut self.leaving).into_keys();
        left.for_each(|id| out.send(Command::Stop(id)));
    }

    pub(super) fn hear(&mut self, id: WorkId, ended: &Ended) {
        let total = match ended {
            Ok(Outcome::Found(answer)) => Some(answer.total),
            _ => None,
        };
        self.kept.hear(id, ended);
        self.coded.hear(id, ended);
        if let Some(at) = self.leaving.remove(&id)
            && let Some(without) = &mut self.without
            && let Some(part) = without.parts.get_mut(at)
        {
            part.2 = total;
        }
        if self.opening == Some(id) {
            self.opening = None;
            if let Ok(Outcome::Around(around)) = ended {
                self.opened = around.first().cloned();
            }
        }
    }

    /// Adds a query to the recent ones.
    pub(super) fn remember(&mut self, query: &str, seen: &PaneInput<'_>, out: &mut Outbox) {
        let mut searches = seen.settings.searches.clone();
        if Query::parse(query).is_ok() && searches.asked(query) {
            out.send(Command::Searches(searches));
        }
    }

    /// Draws the menus; returns the chosen query.
    pub(super) fn menus(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
        query: &str,
    ) -> Option<String> {
        let mut chosen = self.kept.menu(ui, seen, out, query);
        let recent = ui.button(seen.say(words::RECENT));
        Popup::menu(&recent).show(|ui| {
            ui.set_min_width(260.0);
            if seen.settings.searches.recent.is_empty() {
                ui.weak(seen.say(words::NO_RECENT));
            }
            for query in &seen.settings.searches.recent {
                if ui.button(query).clicked() {
                    chosen = Some(query.clone());
                }
            }
        });
        let help = ui.button("?").on_hover_text(seen.say(words::HELP));
        help.widget_info(|| WidgetInfo::labeled(Role::Button, true, seen.say(words::HELP)));
        Popup::from_toggle_button_response(&help)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .show(|ui| {
                ui.set_min_width(420.0);
                let by_example = examples(ui, seen);
                ui.collapsing(seen.say(words::WHOLE_HELP), |ui| {
                    ScrollArea::vertical().max_height(280.0).show(ui, |ui| {
                        let text = guide(chereme_corpus::QUERY_HELP, seen.language);
                        let text = RichText::new(text).monospace().small();
                        ui.add(Label::new(text).extend());
                    });
                });
                chosen = chosen.take().or(by_example);
            });
        chosen
    }

    /// Reports that nothing was found, and which condition excludes everything; returns the query chosen instead.
    pub(super) fn nothing(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
        query: &str,
    ) -> Option<String> {
        ui.strong(seen.say(words::NOTHING));
        if self.without.as_ref().is_none_or(|it| it.query != query) {
            self.leaving.clear();
            self.coded.follow(query, out);
            let parts = parts(query);
            for (at, (_, rest)) in parts.iter().enumerate() {
                let id = out.work(searching::search(rest.clone(), only_counted()));
                self.leaving.insert(id, at);
            }
            self.without = Some(Without {
                query: query.to_owned(),
                meant: guessed(query, &seen.snapshot.overview.inventories),
                parts: parts
                    .into_iter()
                    .map(|(part, rest)| (part, rest, None))
                    .collect(),
            });
        }
        self.coded.show(ui, seen, out);
        let without = self.without.as_ref()?;
        let mut chosen = None;
        if let Some(meant) = &without.meant {
            let text = fill(seen.say(words::MEANT), &[("query", meant)]);
            if ui.button(text).clicked() {
                chosen = Some(meant.clone());
            }
        }
        if without.parts.is_empty() {
            return chosen;
        }
        if without.parts.iter().all(|(_, _, total)| *total == Some(0)) {
            ui.weak(seen.say(words::WITHOUT_NONE));
            return chosen;
        }
        ui.label(seen.say(words::WITHOUT));
        let helps = without.parts.iter().filter(|it| it.2 != Some(0));
        for (part, rest, total) in helps {
            let total = total.map_or("…".to_owned(), |it| it.to_string());
            let text = fill(
                seen.say(words::WITHOUT_ONE),
                &[("part", part), ("n", &total)],
            );
            if ui.link(text).clicked() {
                chosen = Some(rest.clone());
            }
        }
        chosen
    }
}

/// Shows the findings of an answer: conditions that match more than they name, or nothing. Returns the query with
/// another name, if the user chose one.
pub(super) fn findings(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    found: &Found,
    query: &str,
) -> Option<String> {
    /// The most alternative names.
    const NAMES: usize = 6;
    let mut chosen = None;
    let reported = |it: &&Finding| !matches!(it.kind, FindingKind::NotCoded { .. });
    for finding in found.findings.iter().filter(reported) {
        let text = spoken(&finding.message(), seen.language);
        ui.add(Label::new(RichText::new(text).small().weak()).wrap());
        let names = finding.names().iter().take(NAMES);
        let offers: Vec<(&String, String)> = names
            .filter_map(|name| Some((name, finding.instead(query, name)?)))
            .collect();
        if offers.is_empty() {
            continue;
        }
        ui.horizontal_wrapped(|ui| {
            for (name, query) in offers {
                let text = fill(seen.say(words::MEND), &[("text", name)]);
                if ui.small_button(text).clicked() {
                    chosen = Some(query);
                }
            }
        });
    }
    chosen
}

/// Draws example queries; returns the chosen one.
pub(super) fn examples(ui: &mut Ui, seen: &PaneInput<'_>) -> Option<String> {
    let mut chosen = None;
    ui.label(RichText::new(seen.say(words::EXAMPLES)).strong());
    for (query, about) in EXAMPLES {
        ui.horizontal_wrapped(|ui| {
            if ui.link(RichText::new(query).monospace()).clicked() {
                chosen = Some(query.to_owned());
            }
            ui.label(RichText::new(seen.say(about)).small().weak());
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
            parts("configuration=U placement=chin not gloss=A"),
            [
                pair("configuration=U", "placement=chin not gloss=A"),
                pair("placement=chin", "configuration=U not gloss=A"),
                pair("not gloss=A", "configuration=U placement=chin"),
            ]
        );
        assert!(parts("").is_empty());
        assert!(parts("a=(").is_empty());
    }

    #[test]
    fn components_with_a_required_value_are_listed_as_possibly_uncoded() {
        let of = |query: &str| Vec::from_iter(components(query));
        assert_eq!(
            of("right.configuration=U gloss=A"),
            [Component::Configuration]
        );
        assert_eq!(
            of("placement=chin configuration==U,V"),
            [Component::Configuration, Component::Placement]
        );
        assert_eq!(
            of("placement=chin or (movement=arc gloss=A)"),
            [Component::Placement, Component::Movement]
        );
        assert!(of("configuration!=U").is_empty());
        assert!(of("movement=unset").is_empty());
        let counts = [(Component::Configuration, 0), (Component::Placement, 7)];
        assert_eq!(uncoded(&counts.into()), [Component::Configuration]);
    }

    #[test]
    fn every_example_is_a_query() {
        for (query, _) in EXAMPLES {
            assert!(query.parse::<Query>().is_ok(), "{query}");
        }
    }
}
