//! Searching, from rows to answers.

mod lexicon;
mod opinions;
mod store;
mod table;

use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{ComponentField, ComponentReading, TierRole};

use super::{SearchAnswer, SearchOptions};
use crate::Corpus;
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::stored_columns::{AnnotationOrigin, RecordOrigin, ValueState};
use crate::db::stored_recordings::signer_named;
use crate::db::stored_tiers::{AnnotationRow, TierRow, insert_annotation, insert_tier};
use crate::error::CorpusResult;

/// A corpus in a temporary folder that is deleted with it.
struct Sample {
    corpus: Corpus,
    folder: tempfile::TempDir,
}

impl Sample {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("a corpus");
        Self { corpus, folder }
    }

    fn path(&self) -> std::path::PathBuf {
        self.folder.path().join("c.chereme")
    }

    fn work<T>(&mut self, work: impl FnOnce(&rusqlite::Connection) -> CorpusResult<T>) -> T {
        let work = |connection: &rusqlite::Connection| Ok((work(connection)?, "work".to_owned()));
        self.corpus.store.named_operation("test", work).expect("works")
    }

    fn recording(&mut self, name: &str, signer: &str, handedness: &str) -> i64 {
        self.work(|connection| {
            let signer = signer_named(connection, signer, None)?;
            connection.execute("UPDATE signer SET handedness = ?2 WHERE id = ?1", (signer, handedness))?;
            connection.execute(
                "INSERT INTO recording (name, signer_id, origin, duration_us)
                 VALUES (?1, ?2, 'captured', 60000000)",
                (name, signer),
            )?;
            Ok(connection.last_insert_rowid())
        })
    }

    /// Adds a token; times are milliseconds, values `field=value`.
    fn token(&mut self, gloss: &str, place: Option<(i64, i64, i64)>, values: &[&str]) -> i64 {
        let row = TokenRow {
            recording_id: place.map(|place| place.0),
            start_us: place.map(|place| place.1 * 1000),
            end_us: place.map(|place| place.2 * 1000),
            origin: if place.is_some() {
                RecordOrigin::Captured
            } else {
                RecordOrigin::Lexicon
            },
            ..TokenRow::default()
        };
        self.token_of(gloss, &row, values)
    }

    fn token_of(&mut self, gloss: &str, row: &TokenRow, values: &[&str]) -> i64 {
        self.work(|connection| {
            let sign_id = signs::sign_of_annotation(connection, None, gloss)?;
            let row = TokenRow { sign_id, ..row.clone() };
            let token = signs::insert_token(connection, &row)?;
            let values: Vec<TokenValueRow> = values.iter().map(|value| value_row(value)).collect();
            signs::set_values(connection, token, &values)?;
            Ok(token)
        })
    }

    /// Adds a tier with annotations in milliseconds.
    fn tier(&mut self, tier: &TierRow, annotations: &[(i64, i64, &str)]) {
        self.work(|connection| {
            let tier_id = insert_tier(connection, tier)?;
            for (start, end, value) in annotations {
                let row = AnnotationRow {
                    tier_id,
                    start_us: start * 1000,
                    end_us: end * 1000,
                    state: ValueState::state_of_reading(&ComponentReading::from(*value)),
                    value: (*value).to_owned(),
                    origin: AnnotationOrigin::Human,
                    ..AnnotationRow::default()
                };
                insert_annotation(connection, &row)?;
            }
            Ok(())
        });
    }

    fn search(&mut self, query: &str) -> SearchAnswer {
        let found = self.corpus.search_tokens(query, &SearchOptions::default());
        found.unwrap_or_else(|error| panic!("{query}: {error}"))
    }

    fn glosses(&mut self, query: &str) -> String {
        let hits = self.search(query).hits;
        let glosses: Vec<String> = hits.into_iter().map(|hit| hit.gloss).collect();
        glosses.join(" ")
    }
}

fn tier(recording: i64, name: &str, role: &str) -> TierRow {
    TierRow {
        recording_id: recording,
        name: name.to_owned(),
        role: TierRole::of_parts(role, None, None),
        ..TierRow::default()
    }
}

/// A tier of a component, named as a field.
fn component_tier(recording: i64, field: &str) -> TierRow {
    let parsed: ComponentField = field.parse().expect("a field");
    TierRow {
        role: TierRole::Component {
            component: parsed.component,
            feature: parsed.feature.clone(),
        },
        hand: parsed.hand.map(AnnotatedHands::One),
        ..tier(recording, field, "free")
    }
}

/// Reads `initial.right.placement=chin`; `both.` is a hand here too.
fn value_row(text: &str) -> TokenValueRow {
    let (field, value) = text.split_once('=').expect("field=value");
    let both = field.contains("both.");
    let field: ComponentField = field.replace("both.", "").parse().expect("a field");
    let reading = match value {
        "n/a" => ComponentReading::NotApplicable,
        "unclear" => ComponentReading::Unclear,
        "unset" => ComponentReading::Unset,
        value => ComponentReading::Value(value.to_owned()),
    };
    let row = TokenValueRow::from_field_reading(&field, &reading);
    TokenValueRow {
        hand: if both { Some(AnnotatedHands::Both) } else { row.hand },
        ..row
    }
}

#[test]
fn counts_without_a_value_are_those_of_the_conditions_and_a_value_so_spelled_is_quoted() {
    use crate::search::TallyRow;
    use crate::{ProgressReceiver, ignore_progress_step};

    let mut sample = Sample::new();
    for (gloss, coding) in [
        ("ONE", &["dominant.configuration=B", "placement=n/a"][..]),
        ("TWO", &["placement=unset", "placement=unclear"]),
        ("THREE", &["placement=unclear"]),
        ("FOUR", &["dominant.configuration=B"]),
    ] {
        sample.token(gloss, None, coding);
    }
    let word = TokenValueRow::from_field_reading(
        &"placement".parse().expect("a field"),
        &ComponentReading::Value("unset".to_owned()),
    );
    let five = sample.token("FIVE", None, &[]);
    sample.work(|connection| signs::set_values(connection, five, &[word]));
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let fields = ["placement".to_owned()];
    let tally = sample.corpus.tally_values("", &fields, progress).expect("counted");
    let row = |row: &TallyRow| format!("{} {}", row.value, row.total);
    let rows: Vec<String> = tally.rows.iter().map(row).collect();
    assert_eq!(rows, ["\"unset\" 1", "n/a 1", "unclear 2", "unset 2"]);
    for row in &tally.rows {
        let found = sample.search(&format!("placement={}", row.value));
        assert_eq!(found.total, row.total, "{}", row.value);
    }
}

#[test]
fn a_search_stops_on_request() {
    use crate::{CorpusError, ProgressReceiver, ProgressStep, ignore_progress_step};
    use std::ops::ControlFlow;

    let mut sample = Sample::new();
    sample.work(|connection| {
        for n in 0..200 {
            let row = TokenRow {
                sign_id: signs::sign_of_annotation(connection, None, &format!("S{n}"))?,
                origin: RecordOrigin::Lexicon,
                ..TokenRow::default()
            };
            let token = signs::insert_token(connection, &row)?;
            signs::set_values(connection, token, &[value_row("configuration=U")])?;
        }
        Ok(())
    });
    let options = SearchOptions::default();
    for query in ["", "configuration=U", "like S1", "translation=x or gloss=S*"] {
        let mut steps = 0;
        let mut count = |_: ProgressStep<'_>| {
            steps += 1;
            ControlFlow::Continue(())
        };
        let whole = sample
            .corpus
            .search_until(query, &options, &mut ProgressReceiver::new(&mut count));
        assert!(whole.is_ok() && steps > 2, "{query}: {steps}");
        for last in 0..steps {
            let mut left = last;
            let mut stop = |_: ProgressStep<'_>| {
                left -= 1;
                if left < 0 {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            };
            let done = sample
                .corpus
                .search_until(query, &options, &mut ProgressReceiver::new(&mut stop));
            assert!(matches!(done, Err(CorpusError::Stopped)), "{query} at {last}");
        }
        let mut hear = ignore_progress_step;
        let again = sample
            .corpus
            .search_until(query, &options, &mut ProgressReceiver::new(&mut hear));
        assert_eq!(again.ok(), whole.ok(), "{query}");
    }
}
