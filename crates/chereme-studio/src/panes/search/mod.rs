//! The search: a query as text and as rows, its results, and facets.
//!
//! | module | holds |
//! |---|---|
//! | `builder`, `rows` | the query as conditions: the data, and the rows |
//! | `symbols` | the query for a notation |
//! | `suggest`, `field` | the query as text: completions, and the field |
//! | `order` | attributes: the order of hits by one, the counts of one |
//! | `hits`, `results` | the results: pages and order; grid and table |
//! | `page` | the pane from top to bottom |
//! | `examples` | the signs that a query names as examples |
//! | `tiles` | the first choice of a search: a hand, the body, a movement |
//! | `facets` | the number of results with each value |
//! | `side_column`, `saved` | recent queries, help, advice for empty results; saved searches |

mod examples;
mod hits;
mod panes_search_facets;
pub(crate) mod results;
pub(crate) mod search_builder;
mod search_cross;
mod search_field;
mod search_order;
mod search_page;
mod search_rows;
mod search_saved;
mod search_suggest;
mod search_symbols;
mod side_column;
mod tiles;

use std::collections::BTreeMap;
use std::ops::Range;

use chereme_corpus::remedy::ErrorRemedy;
use chereme_corpus::{CorpusError, CorpusOverview, SearchOptions};
use chereme_sign::query::{ExampleToken, QueryExpression, TokenQuery};
use eframe::egui::{ScrollArea, Ui};

use super::notated_pane::AnimatedNotations;
use super::without_movement::{self, MovementAbsence};
use super::{ActionOutcome, PaneInterface};
use crate::action::Action;
use crate::command::{CommandOutbox, DraggedToken, WindowCommand};
use crate::context::PaneInput;
use crate::model::InspectedThing;
use crate::panes::recombine::gloss_means_token;
use crate::words::{fill_text_braces, search_words as words};
use crate::work::{WorkId, WorkOutcome, WorkResult, searching};
pub(crate) use hits::walk_hit_grid;
use hits::{HIT_PAGE_SIZE, HitSort, MAX_HIT_NEIGHBOURS, QueryAnswer};
pub(crate) use panes_search_facets::facet_name;
pub(crate) use search_builder::with_value;
use search_field::QueryField;
use search_rows::ConditionRows;
pub(crate) use search_rows::{feature_text, field_text};

/// How long the text must rest before it is searched for, in seconds.
const SEARCH_PAUSE_SECONDS: f64 = 0.35;
/// The least height of the results below the query, in points; with less, the whole pane scrolls.
const MIN_RESULTS_HEIGHT_POINTS: f32 = 170.0;
/// The most hits whose neighbours are requested together.
const MOST_AROUND: usize = 64;

/// The form in which results are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum ResultsView {
    #[default]
    Grid,
    Table,
}

/// The pane.
pub(crate) struct SearchPane {
    field: QueryField,
    rows: ConditionRows,
    /// The symbols picked from the board of HamNoSys.
    symbols: String,
    /// Whether the rows of conditions are shown.
    built: bool,
    view: ResultsView,
    sort: HitSort,
    /// Whether an order by an attribute begins with the greatest number.
    descending: bool,
    counted_attribute: search_order::CountedAttribute,
    cross_table: search_cross::CrossTable,
    /// Whether figures loop without the pointer over them; and whether they show the hand from near.
    playing: bool,
    close: bool,
    /// Whether facets are shown; if `None`, that depends on the width of the pane.
    counted: Option<bool>,
    conditions: panes_search_facets::FacetConditions,
    /// The height of the query in the last frame, with everything between it and the results.
    head: f32,
    /// Whether the query left too little room for the results in the last frame.
    low: bool,
    /// The time of a change of the text that has not been searched for.
    changed: Option<f64>,
    asked: Option<WorkId>,
    /// The requested pages.
    pages: BTreeMap<WorkId, usize>,
    around: Option<WorkId>,
    found: Option<QueryAnswer>,
    /// The last requested query, as it was written.
    query: String,
    /// The error that the corpus reports.
    wrong: Option<QueryFault>,
    /// Whether the search was stopped before there was an answer.
    stopped: bool,
    aside: side_column::SearchSideColumn,
    examples: examples::KnownExamples,
    tiles: tiles::TilePickers,
    /// The corpus generation that was searched.
    generation: i64,
    /// The index of the hit at the keyboard cursor, of the one to give the focus, and of the one that was opened.
    at: usize,
    reach: Option<usize>,
    opened: Option<usize>,
    /// The scroll offset of the hits, in points.
    scrolled: f32,
    /// The widths of the table's columns.
    shares: results::ColumnShares,
    /// Signs animated from their notation.
    notated: AnimatedNotations,
    come: bool,
}

/// An error in a query, and the index of its first character.
struct QueryFault {
    from: Option<usize>,
    error: String,
    remedy: Option<ErrorRemedy>,
    /// Returns the likeliest intended name, and the query with it.
    mended: Option<(String, String)>,
}

impl Default for SearchPane {
    fn default() -> Self {
        Self {
            built: true,
            symbols: String::new(),
            playing: true,
            counted: None,
            conditions: panes_search_facets::FacetConditions::default(),
            head: 0.0,
            low: false,
            field: QueryField::default(),
            rows: ConditionRows::default(),
            view: ResultsView::default(),
            sort: HitSort::default(),
            descending: true,
            counted_attribute: search_order::CountedAttribute::default(),
            cross_table: search_cross::CrossTable::default(),
            close: false,
            changed: None,
            asked: None,
            pages: BTreeMap::new(),
            around: None,
            found: None,
            query: String::new(),
            wrong: None,
            stopped: false,
            aside: side_column::SearchSideColumn::default(),
            examples: examples::KnownExamples::default(),
            tiles: tiles::TilePickers::default(),
            generation: 0,
            at: 0,
            reach: None,
            opened: None,
            scrolled: 0.0,
            shares: results::ColumnShares::default(),
            notated: AnimatedNotations::default(),
            come: false,
        }
    }
}

impl SearchPane {
    /// Searches with a query from another pane.
    pub(crate) fn search_for_query(&mut self, query: String, out: &CommandOutbox) {
        self.turn_to_query(query, out);
    }

    /// Searches with the present text.
    fn search_present_text(&mut self, out: &CommandOutbox) {
        let asked_work = self.asked.take().into_iter();
        let old = asked_work.chain(std::mem::take(&mut self.pages).into_keys());
        old.for_each(|id| out.send_command(WindowCommand::Stop(id)));
        self.aside.stop_outdated_counts(out);
        self.changed = None;
        (self.wrong, self.stopped) = (None, false);
        self.query = self.field.text.clone();
        self.asked = Some(out.request_work(searching::search_tokens_job(
            self.query.clone(),
            self.page_search_options(0),
        )));
    }

    fn page_search_options(&self, page: usize) -> SearchOptions {
        SearchOptions {
            limit: Some(HIT_PAGE_SIZE),
            offset: page * HIT_PAGE_SIZE,
            facets: page == 0,
            order: self.sort.corpus_order(),
            ..SearchOptions::default()
        }
    }

    /// Sets another query, and searches with it.
    fn turn_to_query(&mut self, query: String, out: &CommandOutbox) {
        self.field.set_query_text(query);
        self.rows = ConditionRows::default();
        self.search_present_text(out);
    }

    fn sort_by(&mut self, sort: HitSort, out: &CommandOutbox) {
        let asks = sort.corpus_order() != self.sort.corpus_order();
        self.sort = sort;
        match &mut self.found {
            Some(found) if !asks => found.sort_found_hits(&self.sort),
            _ => self.search_present_text(out),
        }
    }

    /// Requests the missing data of the visible hits.
    fn request_visible_hits(&mut self, range: Range<usize>, out: &CommandOutbox) {
        let Some(found) = &self.found else { return };
        if self.asked.is_none()
            && self.pages.is_empty()
            && let Some(page) = found.first_missing_page(range.clone())
        {
            let job = searching::search_tokens_job(self.query.clone(), self.page_search_options(page));
            self.pages.insert(out.request_work(job), page);
        }
        if self.around.is_none() && self.view == ResultsView::Table {
            let all = if found.is_whole() { 0..found.total } else { range };
            let mut lonely = found.tokens_without_neighbours(all);
            lonely.truncate(MOST_AROUND.max(HIT_PAGE_SIZE));
            if !lonely.is_empty() {
                self.around = Some(out.request_work(searching::load_neighbours_job(lonely, MAX_HIT_NEIGHBOURS)));
            }
        }
    }

    /// Moves the keyboard cursor to a hit.
    fn move_cursor_to_hit(&mut self, at: usize) {
        self.at = at;
        self.reach = Some(at);
    }

    /// Opens a hit at its place; one that has only a notation is animated and shown on the stage.
    fn open_hit_at(&mut self, at: usize, seen: &PaneInput<'_>) {
        let Some(found) = &self.found else { return };
        let Some(hit) = found.hit_at(at) else { return };
        self.opened = Some(at);
        self.at = at;
        let recorded = hits::hit_recording_span(hit)
            .and_then(|(name, span)| Some((seen.snapshot.recording_named(name)?.row.id, span)));
        match recorded {
            Some((recording, span)) => {
                seen.send_command(WindowCommand::Made(None));
                seen.send_command(WindowCommand::Place(recording, span));
                seen.send_command(WindowCommand::Look);
                match found.hit_neighbours(hit.token).cloned() {
                    Some(around) => select_token_annotation(&around, seen.out),
                    None => {
                        let job = searching::load_neighbours_job(vec![hit.token], MAX_HIT_NEIGHBOURS);
                        self.aside.opening = Some(seen.request_work(job));
                    }
                }
            }
            None => {
                seen.send_command(WindowCommand::Made(None));
                if seen.snapshot.is_notated(&hit.gloss) {
                    seen.send_command(WindowCommand::Note(InspectedThing::Token(hit.token)));
                    self.notated.open_notated_sign(hit.token, &hit.gloss, seen.out);
                } else {
                    seen.send_command(WindowCommand::Inspect(InspectedThing::Token(hit.token)));
                }
            }
        }
    }

    /// Shows the opened notated sign on the stage once it is animated, even if another pane covers this one.
    pub(crate) fn show_animated_hit(&mut self, out: &CommandOutbox) {
        self.notated.show_opened_notation(out);
    }

    /// Returns the hit at the keyboard cursor, for use in another pane.
    pub(crate) fn cursor_hit_token(&self) -> Option<DraggedToken> {
        self.found.as_ref()?.hit_at(self.at).map(results::hit_drag_payload)
    }

    /// Lists the possible actions for the opened hit if it has no movement.
    pub(super) fn show_movement_hint(&self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let opened_hit = self.found.as_ref().zip(self.opened);
        let Some(hit) = opened_hit.and_then(|(found, at)| found.hit_at(at)) else {
            return;
        };
        if hits::hit_recording_span(hit).is_some() {
            return;
        }
        let bare = if seen.snapshot.is_notated(&hit.gloss) {
            self.notated.movement_absence(hit.token)
        } else {
            Some(MovementAbsence::Coded)
        };
        if let Some(bare) = bare {
            without_movement::show_movement_absence(ui, seen, hit.token, &hit.gloss, &bare);
        }
    }

    /// Searches for signs similar to the selected token, or to the token at the selected time.
    fn like_selected(&mut self, seen: &PaneInput<'_>) -> bool {
        let Some(contents) = seen
            .shown
            .recording
            .and_then(|recording| seen.snapshot.recording_contents(recording))
        else {
            return false;
        };
        let by_annotation = seen.shown.selected_annotation().and_then(|annotation| {
            let mut tokens = contents.tokens.iter();
            tokens.find(|token| token.annotation_id == Some(annotation))
        });
        let annotated = seen.shown.selected_annotation().and_then(|id| {
            let selection = seen.snapshot.find_open_annotation(id)?;
            Some(selection.tier.annotations.annotation_span_at(selection.at))
        });
        let span = annotated.or(seen.shown.span);
        let by_time = || {
            let span = span?;
            let shared = |token: &&chereme_corpus::TokenRow| {
                let (start, end) = token.start_us.zip(token.end_us).unwrap_or_default();
                end.min(span.span_end_instant().instant_micros())
                    - start.max(span.span_start_instant().instant_micros())
            };
            let tokens = contents.tokens.iter().filter(|token| shared(token) > 0);
            tokens.max_by_key(shared)
        };
        let Some(token) = by_annotation.or_else(by_time) else {
            return false;
        };
        self.turn_to_query(like_query(&seen.snapshot.overview, token.id, &token.gloss), seen.out);
        self.built = true;
        true
    }

    /// Searches again if the corpus changed.
    fn repeat_changed_search(&mut self, seen: &PaneInput<'_>) {
        let now = seen.snapshot.overview.generation;
        if self.generation == now {
            return;
        }
        self.generation = now;
        self.aside.forget_counts();
        self.notated.forget_animation_failures(now);
        // An undo may take away the attribute that gave the order.
        let attributes = &seen.snapshot.overview.attributes;
        if (self.sort.sort_attribute()).is_some_and(|name| !attributes.iter().any(|known| known == name)) {
            self.sort = HitSort::default();
        }
        let asked = self.found.is_some() || self.wrong.is_some();
        if asked && self.changed.is_none() {
            self.search_present_text(seen.out);
        }
    }
}

/// Returns the query for signs similar to a token, named by its gloss if that means this token.
pub(crate) fn like_query(overview: &CorpusOverview, token: i64, gloss: &str) -> String {
    if gloss_means_token(overview, token, gloss) {
        let text = format!("like {}", search_suggest::quote_query_value(gloss));
        let means = |query: TokenQuery| match &query.root {
            QueryExpression::Like(like) => like.example == ExampleToken::Sign(gloss.to_owned()),
            _ => false,
        };
        if text.parse().is_ok_and(means) {
            return text;
        }
    }
    format!("like token:{token}")
}

/// Selects the annotation of a token, and its tier.
fn select_token_annotation(around: &chereme_corpus::TokenNeighbours, out: &CommandOutbox) {
    if let Some((annotation, tier)) = around.annotation.zip(around.tier) {
        out.send_command(WindowCommand::Tier(Some(tier)));
        out.send_command(WindowCommand::Annotations([annotation].into()));
    }
}

impl PaneInterface for SearchPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        self.repeat_changed_search(seen);
        if let Some(around) = self.aside.opened.take() {
            select_token_annotation(&around, seen.out);
        }
        if seen.snapshot.overview.signs.is_empty() {
            ui.label(seen.say_text(words::EMPTY));
            if ui.button(seen.say_text(crate::words::library::IMPORT)).clicked() {
                seen.send_command(WindowCommand::Do(Action::Import));
            }
            return;
        }
        let room = ui.available_height();
        let left = room - self.head - 1.0;
        self.low = left < MIN_RESULTS_HEIGHT_POINTS;
        // The whole pane is always in a scroll area, as otherwise the text field would become another widget.
        let area = ScrollArea::vertical().id_salt("page").auto_shrink(false);
        let high = if self.low {
            room.max(MIN_RESULTS_HEIGHT_POINTS)
        } else {
            left
        };
        area.show(ui, |ui| self.draw_search_page(ui, seen, high));
    }

    fn carry_out_pane_action(&mut self, action: Action, seen: &PaneInput<'_>) -> ActionOutcome {
        match action {
            Action::SearchLike => {
                if !self.like_selected(seen) {
                    return ActionOutcome::Cannot(words::NOTHING_SELECTED);
                }
                seen.send_command(WindowCommand::Do(Action::Search));
                ActionOutcome::Yes
            }
            Action::SearchView => {
                self.view = match self.view {
                    ResultsView::Grid => ResultsView::Table,
                    ResultsView::Table => ResultsView::Grid,
                };
                seen.send_command(WindowCommand::Do(Action::Search));
                ActionOutcome::Yes
            }
            _ => ActionOutcome::No,
        }
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        self.aside.receive_relaxed_counts(id, ended);
        self.examples.receive_example_result(id, ended);
        self.notated.receive_animation_result(id, ended);
        if self.around == Some(id) {
            self.around = None;
            if let (Ok(WorkOutcome::Around(around)), Some(found)) = (ended, &mut self.found) {
                found.put_around(around);
                found.sort_found_hits(&self.sort);
            }
        }
        if let Some(found) = &mut self.found {
            self.counted_attribute.receive_attribute_counts(id, ended, found);
        }
        self.cross_table.receive_cross_counts(id, ended);
        if let Some(page) = self.pages.remove(&id)
            && let (Ok(WorkOutcome::Found(answer)), Some(found)) = (ended, &mut self.found)
        {
            found.put_hit_page(page, &answer.hits);
        }
        if self.asked == Some(id) {
            self.asked = None;
            self.receive_search_answer(ended);
        }
    }

    fn come(&mut self) {
        self.come = true;
    }
}

impl SearchPane {
    fn receive_search_answer(&mut self, ended: &WorkResult) {
        if matches!(ended, Err(error) if !matches!(error, CorpusError::Stopped)) {
            // The old answer does not belong to the new query.
            self.found = None;
            (self.at, self.opened, self.scrolled) = (0, None, 0.0);
        }
        match ended {
            Ok(WorkOutcome::Found(answer)) => {
                let same = self.found.as_ref().is_some_and(|earlier| earlier.query == answer.query);
                self.found = Some(QueryAnswer::new(answer));
                self.counted_attribute.forget_attribute_counts();
                self.cross_table.forget_cross_counts();
                self.aside.forget_nothing();
                if !same {
                    (self.at, self.opened, self.scrolled) = (0, None, 0.0);
                }
            }
            Err(CorpusError::Query(wrong)) => {
                self.wrong = Some(QueryFault {
                    from: Some(wrong.at),
                    error: wrong.message.clone(),
                    remedy: wrong.remedy.clone(),
                    mended: wrong.mended.clone(),
                });
            }
            Err(error @ CorpusError::Wrong { .. }) => {
                self.wrong = Some(QueryFault {
                    from: None,
                    error: error.to_string(),
                    remedy: error.error_remedy(),
                    mended: None,
                });
            }
            Err(CorpusError::Stopped) => self.stopped = true,
            Err(error) => {
                self.wrong = Some(QueryFault {
                    from: None,
                    error: fill_text_braces("{error}", &[("error", error)]),
                    remedy: None,
                    mended: None,
                });
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::SignGlance;

    #[test]
    fn examples_are_named_by_their_gloss_if_it_is_unambiguous() {
        let sign = |gloss: &str, token| SignGlance {
            gloss: gloss.to_owned(),
            citation: Some(token),
            ..SignGlance::default()
        };
        let overview = CorpusOverview {
            signs: vec![sign("AIMER", 15), sign("BON APPETIT", 16), sign("token:3", 17)],
            ..CorpusOverview::default()
        };
        for (token, gloss, wanted) in [
            (15, "AIMER", "like AIMER"),
            (16, "BON APPETIT", "like \"BON APPETIT\""),
            (18, "AIMER", "like token:18"),
            (17, "token:3", "like token:17"),
        ] {
            let query = like_query(&overview, token, gloss);
            assert!(query == wanted || query == format!("like \"{gloss}\""), "{query}");
            assert!(query.parse::<TokenQuery>().is_ok());
        }
    }
}
