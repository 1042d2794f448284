//! The search: a query as text and as rows, its results, and facets.
//!
//! | module | holds |
//! |---|---|
//! | `builder`, `rows` | the query as conditions: the data, and the rows |
//! | `symbols` | the query for a notation |
//! | `suggest`, `field` | the query as text: completions, and the field |
//! | `hits`, `results` | the results: pages and order; grid and table |
//! | `page` | the pane from top to bottom |
//! | `examples` | the signs that a query names as examples |
//! | `tiles` | the first choice of a search: a hand, the body, a movement |
//! | `facets` | the number of results with each value |
//! | `side_column`, `saved` | recent queries, help, advice for empty results; saved searches |

pub(crate) mod builder;
mod examples;
mod facets;
mod field;
mod hits;
mod page;
mod results;
mod rows;
mod saved;
mod side_column;
mod suggest;
mod symbols;
mod tiles;

use std::collections::BTreeMap;
use std::ops::Range;

use chereme_corpus::remedy::Remedy;
use chereme_corpus::{Error, Overview, SearchOptions};
use chereme_sign::query::{Example, Expr, Query};
use eframe::egui::{ScrollArea, Ui};

use super::inspector::Thing;
use super::notated::Notated;
use super::without_movement::{self, Bare};
use super::{Acted, Carried, Pane};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::words::{fill, search as words};
use crate::work::{Ended, Outcome, WorkId, searching};
pub(crate) use builder::with_value;
use field::Field;
pub(crate) use hits::walk as walked;
use hits::{Found, NEIGHBOURS, PAGE, Sort};
use rows::Rows;
pub(crate) use rows::{feature_text, field_text};

/// How long the text must rest before it is searched for, in seconds.
const PAUSE: f64 = 0.35;
/// The least height of the results below the query, in points; with less, the whole pane scrolls.
const LOW: f32 = 170.0;
/// The most hits whose neighbours are requested together.
const MOST_AROUND: usize = 64;

/// The form in which results are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum View {
    #[default]
    Grid,
    Table,
}

/// The pane.
pub(crate) struct Search {
    field: Field,
    rows: Rows,
    /// The symbols picked from the board of HamNoSys.
    symbols: String,
    /// Whether the rows of conditions are shown.
    built: bool,
    view: View,
    sort: Sort,
    /// Whether figures loop without the pointer over them; and whether they show the hand from near.
    playing: bool,
    close: bool,
    /// Whether facets are shown; if `None`, that depends on the width of the pane.
    counted: Option<bool>,
    conditions: facets::Conditions,
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
    found: Option<Found>,
    /// The last requested query, as it was written.
    query: String,
    /// The error that the corpus reports.
    wrong: Option<Wrong>,
    /// Whether the search was stopped before there was an answer.
    stopped: bool,
    aside: side_column::Aside,
    examples: examples::Examples,
    tiles: tiles::Tiles,
    /// The corpus generation that was searched.
    generation: i64,
    /// The index of the hit at the keyboard cursor, of the one to give the focus, and of the one that was opened.
    at: usize,
    reach: Option<usize>,
    opened: Option<usize>,
    /// The scroll offset of the hits, in points.
    scrolled: f32,
    /// The widths of the table's columns.
    shares: results::Shares,
    /// Signs animated from their notation.
    notated: Notated,
    come: bool,
}

/// An error in a query, and the index of its first character.
struct Wrong {
    from: Option<usize>,
    error: String,
    remedy: Option<Remedy>,
    /// Returns the likeliest intended name, and the query with it.
    mended: Option<(String, String)>,
}

impl Default for Search {
    fn default() -> Self {
        Self {
            built: true,
            symbols: String::new(),
            playing: true,
            counted: None,
            conditions: facets::Conditions::default(),
            head: 0.0,
            low: false,
            field: Field::default(),
            rows: Rows::default(),
            view: View::default(),
            sort: Sort::default(),
            close: false,
            changed: None,
            asked: None,
            pages: BTreeMap::new(),
            around: None,
            found: None,
            query: String::new(),
            wrong: None,
            stopped: false,
            aside: side_column::Aside::default(),
            examples: examples::Examples::default(),
            tiles: tiles::Tiles::default(),
            generation: 0,
            at: 0,
            reach: None,
            opened: None,
            scrolled: 0.0,
            shares: results::Shares::default(),
            notated: Notated::default(),
            come: false,
        }
    }
}

impl Search {
    /// Searches with a query from another pane.
    pub(crate) fn find(&mut self, query: String, out: &mut Outbox) {
        self.turn_to(query, out);
    }

    /// Searches with the present text.
    fn ask(&mut self, out: &mut Outbox) {
        let old = self.asked.take().into_iter();
        let old = old.chain(std::mem::take(&mut self.pages).into_keys());
        old.for_each(|id| out.send(Command::Stop(id)));
        self.aside.stop(out);
        self.changed = None;
        (self.wrong, self.stopped) = (None, false);
        self.query = self.field.text.clone();
        self.asked = Some(out.work(searching::search(self.query.clone(), self.options(0))));
    }

    fn options(&self, page: usize) -> SearchOptions {
        SearchOptions {
            limit: Some(PAGE),
            offset: page * PAGE,
            facets: page == 0,
            order: self.sort.order(),
            ..SearchOptions::default()
        }
    }

    /// Sets another query, and searches with it.
    fn turn_to(&mut self, query: String, out: &mut Outbox) {
        self.field.set(query);
        self.rows = Rows::default();
        self.ask(out);
    }

    fn sort_by(&mut self, sort: Sort, out: &mut Outbox) {
        let asks = sort.order() != self.sort.order();
        self.sort = sort;
        match &mut self.found {
            Some(found) if !asks => found.sort(sort),
            _ => self.ask(out),
        }
    }

    /// Requests the missing data of the visible hits.
    fn sight(&mut self, range: Range<usize>, out: &mut Outbox) {
        let Some(found) = &self.found else { return };
        if self.asked.is_none()
            && self.pages.is_empty()
            && let Some(page) = found.missing(range.clone())
        {
            let job = searching::search(self.query.clone(), self.options(page));
            self.pages.insert(out.work(job), page);
        }
        if self.around.is_none() && self.view == View::Table {
            let all = if found.is_whole() {
                0..found.total
            } else {
                range
            };
            let mut lonely = found.lonely(all);
            lonely.truncate(MOST_AROUND.max(PAGE));
            if !lonely.is_empty() {
                self.around = Some(out.work(searching::around(lonely, NEIGHBOURS)));
            }
        }
    }

    /// Moves the keyboard cursor to a hit.
    fn reach(&mut self, at: usize) {
        self.at = at;
        self.reach = Some(at);
    }

    /// Opens a hit at its place; one that has only a notation is animated and shown on the stage.
    fn open(&mut self, at: usize, seen: &PaneInput<'_>, out: &mut Outbox) {
        let Some(found) = &self.found else { return };
        let Some(hit) = found.hit(at) else { return };
        self.opened = Some(at);
        self.at = at;
        let recorded = hits::place(hit)
            .and_then(|(name, span)| Some((seen.snapshot.recording_named(name)?.row.id, span)));
        match recorded {
            Some((recording, span)) => {
                out.send(Command::Made(None));
                out.send(Command::Place(recording, span));
                out.send(Command::Look);
                match found.around(hit.token).cloned() {
                    Some(around) => select(&around, out),
                    None => {
                        let job = searching::around(vec![hit.token], NEIGHBOURS);
                        self.aside.opening = Some(out.work(job));
                    }
                }
            }
            None => {
                out.send(Command::Made(None));
                if seen.snapshot.is_notated(&hit.gloss) {
                    out.send(Command::Note(Thing::Token(hit.token)));
                    self.notated.open(hit.token, &hit.gloss, out);
                } else {
                    out.send(Command::Inspect(Thing::Token(hit.token)));
                }
            }
        }
    }

    /// Shows the opened notated sign on the stage once it is animated, even if another pane covers this one.
    pub(crate) fn show_made(&mut self, out: &mut Outbox) {
        self.notated.show(out);
    }

    /// Returns the hit at the keyboard cursor, for use in another pane.
    pub(crate) fn carried(&self) -> Option<Carried> {
        self.found.as_ref()?.hit(self.at).map(results::carried)
    }

    /// Lists the possible actions for the opened hit if it has no movement.
    pub(super) fn hint(&self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let found = self.found.as_ref().zip(self.opened);
        let Some(hit) = found.and_then(|(found, at)| found.hit(at)) else {
            return;
        };
        if hits::place(hit).is_some() {
            return;
        }
        let bare = if seen.snapshot.is_notated(&hit.gloss) {
            self.notated.bare(hit.token)
        } else {
            Some(Bare::Coded)
        };
        if let Some(bare) = bare {
            without_movement::show(ui, seen, out, (hit.token, &hit.gloss), &bare);
        }
    }

    /// Searches for signs similar to the selected token, or to the token at the selected time.
    fn like_selected(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) -> bool {
        let Some(contents) = seen
            .shown
            .recording
            .and_then(|recording| seen.snapshot.contents(recording))
        else {
            return false;
        };
        let by_annotation = seen.shown.annotation().and_then(|annotation| {
            let mut tokens = contents.tokens.iter();
            tokens.find(|token| token.annotation_id == Some(annotation))
        });
        let annotated = seen.shown.annotation().and_then(|id| {
            let found = seen.snapshot.annotation(id)?;
            Some(found.tier.annotations.span(found.at))
        });
        let span = annotated.or(seen.shown.span);
        let by_time = || {
            let span = span?;
            let shared = |token: &&chereme_corpus::TokenRow| {
                let (start, end) = token.start_us.zip(token.end_us).unwrap_or_default();
                end.min(span.end().micros()) - start.max(span.start().micros())
            };
            let tokens = contents.tokens.iter().filter(|token| shared(token) > 0);
            tokens.max_by_key(shared)
        };
        let Some(token) = by_annotation.or_else(by_time) else {
            return false;
        };
        self.turn_to(
            like_query(&seen.snapshot.overview, token.id, &token.gloss),
            out,
        );
        self.built = true;
        true
    }

    /// Searches again if the corpus changed.
    fn follow(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) {
        let now = seen.snapshot.overview.generation;
        if self.generation == now {
            return;
        }
        self.generation = now;
        self.aside.forget_counts();
        self.notated.follow(now);
        let asked = self.found.is_some() || self.wrong.is_some();
        if asked && self.changed.is_none() {
            self.ask(out);
        }
    }
}

/// Returns the query for signs similar to a token, named by its gloss if that means this token.
pub(crate) fn like_query(overview: &Overview, token: i64, gloss: &str) -> String {
    let mut named = overview.signs.iter().filter(|it| it.gloss == gloss);
    if named.next().is_some_and(|it| it.citation == Some(token)) {
        let text = format!("like {}", suggest::quoted(gloss));
        let means = |query: Query| match &query.root {
            Expr::Like(like) => like.example == Example::Sign(gloss.to_owned()),
            _ => false,
        };
        if text.parse().is_ok_and(means) {
            return text;
        }
    }
    format!("like token:{token}")
}

/// Selects the annotation of a token, and its tier.
fn select(around: &chereme_corpus::Around, out: &mut Outbox) {
    if let Some((annotation, tier)) = around.annotation.zip(around.tier) {
        out.send(Command::Tier(Some(tier)));
        out.send(Command::Annotations([annotation].into()));
    }
}

impl Pane for Search {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.follow(seen, out);
        if let Some(around) = self.aside.opened.take() {
            select(&around, out);
        }
        if seen.snapshot.overview.signs.is_empty() {
            ui.label(seen.say(words::EMPTY));
            if ui.button(seen.say(crate::words::library::IMPORT)).clicked() {
                out.send(Command::Do(Action::Import));
            }
            return;
        }
        let room = ui.available_height();
        let left = room - self.head - 1.0;
        self.low = left < LOW;
        // The whole pane is always in a scroll area, as otherwise the text field would become another widget.
        let area = ScrollArea::vertical().id_salt("page").auto_shrink(false);
        let high = if self.low { room.max(LOW) } else { left };
        area.show(ui, |ui| self.page(ui, seen, out, high));
    }

    fn act(&mut self, action: Action, seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        match action {
            Action::SearchLike => {
                if !self.like_selected(seen, out) {
                    return Acted::Cannot(words::NOTHING_SELECTED);
                }
                out.send(Command::Do(Action::Search));
                Acted::Yes
            }
            Action::SearchView => {
                self.view = match self.view {
                    View::Grid => View::Table,
                    View::Table => View::Grid,
                };
                out.send(Command::Do(Action::Search));
                Acted::Yes
            }
            _ => Acted::No,
        }
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        self.aside.hear(id, ended);
        self.examples.hear(id, ended);
        self.notated.hear(id, ended);
        if self.around == Some(id) {
            self.around = None;
            if let (Ok(Outcome::Around(around)), Some(found)) = (ended, &mut self.found) {
                found.put_around(around);
                found.sort(self.sort);
            }
        }
        if let Some(page) = self.pages.remove(&id)
            && let (Ok(Outcome::Found(answer)), Some(found)) = (ended, &mut self.found)
        {
            found.put(page, &answer.hits);
        }
        if self.asked == Some(id) {
            self.asked = None;
            self.answered(ended);
        }
    }

    fn come(&mut self) {
        self.come = true;
    }
}

impl Search {
    fn answered(&mut self, ended: &Ended) {
        if matches!(ended, Err(error) if !matches!(error, Error::Stopped)) {
            // The old answer does not belong to the new query.
            self.found = None;
            (self.at, self.opened, self.scrolled) = (0, None, 0.0);
        }
        match ended {
            Ok(Outcome::Found(answer)) => {
                let same = self
                    .found
                    .as_ref()
                    .is_some_and(|it| it.query == answer.query);
                self.found = Some(Found::new(answer));
                self.aside.forget_nothing();
                if !same {
                    (self.at, self.opened, self.scrolled) = (0, None, 0.0);
                }
            }
            Err(Error::Query(wrong)) => {
                self.wrong = Some(Wrong {
                    from: Some(wrong.at),
                    error: wrong.message.clone(),
                    remedy: wrong.remedy.clone(),
                    mended: wrong.mended.clone(),
                });
            }
            Err(error @ Error::Wrong { .. }) => {
                self.wrong = Some(Wrong {
                    from: None,
                    error: error.to_string(),
                    remedy: error.remedy(),
                    mended: None,
                });
            }
            Err(Error::Stopped) => self.stopped = true,
            Err(error) => {
                self.wrong = Some(Wrong {
                    from: None,
                    error: fill("{error}", &[("error", error)]),
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
        let overview = Overview {
            signs: vec![
                sign("AIMER", 15),
                sign("BON APPETIT", 16),
                sign("token:3", 17),
            ],
            ..Overview::default()
        };
        for (token, gloss, wanted) in [
            (15, "AIMER", "like AIMER"),
            (16, "BON APPETIT", "like \"BON APPETIT\""),
            (18, "AIMER", "like token:18"),
            (17, "token:3", "like token:17"),
        ] {
            let query = like_query(&overview, token, gloss);
            assert!(
                query == wanted || query == format!("like \"{gloss}\""),
                "{query}"
            );
            assert!(query.parse::<Query>().is_ok());
        }
    }
}
