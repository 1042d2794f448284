//! Rebuilding a generated sign: the movement of another recipe takes the place of its own.

use chereme_sign::TierRole;
use std::collections::BTreeSet;

use chereme_compose::{Input, Made, Recipe, Resolved};
use rusqlite::Connection;

use super::{
    Recombination, recipe_row, recombination, signer_of, source_rows, store_inputs, store_movement,
    store_notes,
};
use crate::Corpus;
use crate::address::{self, Address};
use crate::db::columns::AnnotationOrigin;
use crate::db::edits;
use crate::db::recipes::{self, RecipeRow};
use crate::db::recordings::{self, RecordingRow};
use crate::db::signs;
use crate::db::tiers::{self, AnnotationRow};
use crate::error::{Error, Result};
use crate::inventories;
use crate::tokens;

impl Corpus {
    /// Makes the movement of a recipe and stores it in the place of a sign that was made before.
    ///
    /// The sign keeps its recording, its name, its token and the annotations that people wrote on its tiers; its
    /// movement, its recipe and the annotations that came with the movement are those of the new recipe. People's
    /// annotations that reach beyond the new end are cut there; those that began after it are removed, and a
    /// warning of the report says so. All of it is one operation, and undo brings the former sign back.
    ///
    /// # Errors
    /// As [`preview`](Self::preview); where `sign` was not made by a recipe, and where the recipe takes
    /// movement from the sign itself, however many signs lie between.
    pub fn recombine_again(&mut self, sign: &Address, recipe: &str) -> Result<Recombination> {
        let target = address::stretch(self.store.read(), sign)?.recording;
        let (resolved, made, recipe) = self.make(recipe)?;
        let (token, gloss, beside) = self.store.operation("recombine again", |connection| {
            let done = store_again(connection, &target, &recipe, &resolved, &made)?;
            let summary = format!("{} = {recipe}", done.1);
            Ok((done, summary))
        })?;
        let mut done = recombination(&recipe, gloss, made);
        (done.token, done.recording) = (Some(token), Some(target.id));
        done.name = Some(target.name);
        done.report.warnings.extend(beside);
        Ok(done)
    }
}

/// Returns the token, its gloss, and what else people should know.
fn store_again(
    connection: &Connection,
    target: &RecordingRow,
    recipe: &Recipe,
    resolved: &Resolved,
    made: &Made,
) -> Result<(i64, String, Vec<String>)> {
    let former = recipes::of_recording(connection, target.id)?.ok_or_else(|| {
        Error::wrong(format!("{:?} was not made by a recipe", target.name))
            .at(target.name.clone())
            .advise("store the result as a new sign, with a gloss of its own")
    })?;
    refuse_circle(connection, target, resolved)?;
    if made.clip.frames() == 0 {
        return Err(Error::wrong("the recipe makes no movement at all"));
    }
    let mut beside = Vec::new();
    let users = recipes::made_from_recording(connection, target.id)?;
    if !users.is_empty() {
        let names: Vec<&str> = users.iter().map(|(_, name)| name.as_str()).collect();
        beside.push(format!(
            "made from the former {}, and left as they are: {}",
            target.name,
            names.join(", ")
        ));
    }
    let end = made.clip.span().micros();
    let signer = signer_of(connection, made)?;
    edits::defer_references(connection)?;
    recordings::clear_motion(connection, target.id, (end, signer))?;
    store_movement(connection, target.id, resolved, made)?;
    let inventories = inventories::load(connection)?;
    let cleared = clear_tiers(connection, target, end)?;
    if cleared.shortened > 0 {
        beside.push(format!(
            "annotations beyond the new end were shortened or taken away: {}",
            cleared.shortened
        ));
    }
    store_notes(connection, target.id, made, &inventories)?;
    for tier in cleared.tiers {
        remove_bare(connection, target.id, tier)?;
    }
    tokens::derive(connection, target.id, None, &inventories)?;
    let row = RecipeRow {
        id: former.id,
        ..recipe_row(target.id, recipe, resolved, made)?
    };
    recipes::update(connection, &row)?;
    store_inputs(connection, row.id, resolved)?;
    let tokens = signs::tokens_of_recording(connection, target.id)?;
    let token = tokens.first().ok_or_else(|| {
        Error::wrong(format!("{:?} has no gloss any more", target.name))
            .at(target.name.clone())
            .advise("write its gloss on the tier Gloss first, or store a new sign")
    })?;
    Ok((token.id, token.gloss.clone(), beside))
}

/// Refuses a recipe that takes movement from the sign whose place it takes.
fn refuse_circle(
    connection: &Connection,
    target: &RecordingRow,
    resolved: &Resolved,
) -> Result<()> {
    let mut next = Vec::new();
    for input in resolved.inputs().0.values() {
        if let Input::Material(material) = input {
            next.extend(source_rows(connection, &material.address)?.0);
        }
    }
    let mut seen = BTreeSet::new();
    while let Some(recording) = next.pop() {
        if recording == target.id {
            return Err(Error::wrong(format!(
                "the recipe takes movement from {:?} itself, whose place it would take",
                target.name
            ))
            .at(target.name.clone())
            .advise("begin with what that sign was made from, or store a new sign"));
        }
        if seen.insert(recording)
            && let Some(recipe) = recipes::of_recording(connection, recording)?
        {
            next.extend(recipes::input_recordings(connection, recipe.id)?);
        }
    }
    Ok(())
}

/// The result of removing the annotations of the former movement.
#[derive(Default)]
struct Cleared {
    /// The tiers that lost some that came with the movement.
    tiers: BTreeSet<i64>,
    /// How many that people wrote end earlier, or are gone.
    shortened: usize,
}

/// Takes the annotations away that came with the former movement, and ends the others where the new
/// one ends.
fn clear_tiers(connection: &Connection, target: &RecordingRow, end: i64) -> Result<Cleared> {
    let mut cleared = Cleared::default();
    for tier in tiers::tiers(connection, target.id)? {
        for row in tiers::annotations(connection, tier.id)? {
            let came = row.origin == AnnotationOrigin::Made && tier.role != TierRole::Gloss;
            if came && tiers::children(connection, row.id)?.is_empty() {
                remove(connection, &row)?;
                cleared.tiers.insert(tier.id);
                continue;
            }
            let whole = row.origin == AnnotationOrigin::Made && row.end_us == target.duration_us;
            if !whole && row.end_us > end {
                cleared.shortened += 1;
            }
            if row.start_us >= end && row.end_us > end {
                remove(connection, &row)?;
            } else if whole || row.end_us > end {
                let row = AnnotationRow { end_us: end, ..row };
                tiers::update_annotation(connection, &row)?;
            }
        }
    }
    Ok(cleared)
}

/// Removes an annotation with all that hangs below it.
fn remove(connection: &Connection, row: &AnnotationRow) -> Result<()> {
    for child in tiers::children(connection, row.id)? {
        remove(connection, &child)?;
    }
    tiers::delete_annotation(connection, row.id)
}

/// Removes a tier that nothing is said on any more and nothing hangs below.
fn remove_bare(connection: &Connection, recording: i64, tier: i64) -> Result<()> {
    let all = tiers::tiers(connection, recording)?;
    let above = all.iter().any(|it| it.parent_id == Some(tier));
    if !above && tiers::annotations(connection, tier)?.is_empty() {
        tiers::delete_tier(connection, tier)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use chereme_motion::Instant;

    use super::*;
    use crate::{
        AnnotateOptions, AnnotationAction, AnnotationChange, ChannelGroup, ImportOptions, Moment,
        Name, NewTier, Progress, TierName, TierRole, unheard, unpack_starter,
    };

    /// Returns a corpus in a folder of its own, with ESCARGOT and LIMACE made of it.
    fn corpus() -> (tempfile::TempDir, Corpus) {
        let folder = tempfile::tempdir().expect("a folder");
        let files = unpack_starter(&folder.path().join("files")).expect("unpacked");
        let snail = |path: &PathBuf| path.file_stem().is_some_and(|stem| stem == "escargot");
        let files: Vec<PathBuf> = files.into_iter().filter(snail).collect();
        let mut corpus = Corpus::create(&folder.path().join("a.chereme"), "A").expect("made");
        let (mut hear, options) = (unheard, ImportOptions::default());
        let mut progress = Progress::new(&mut hear);
        corpus
            .import(&files, &options, &mut progress)
            .expect("imported");
        corpus
            .recombine("ESCARGOT | configure right U", "LIMACE")
            .expect("made");
        (folder, corpus)
    }

    fn limace() -> Address {
        Address::Gloss("LIMACE".into())
    }

    /// All that is stored of the sign, for people.
    fn state(corpus: &Corpus) -> String {
        let connection = corpus.store.read();
        let target = address::stretch(connection, &limace())
            .expect("there")
            .recording;
        let recipe = recipes::of_recording(connection, target.id).expect("read");
        let inputs = recipe.as_ref().map(|it| recipes::inputs(connection, it.id));
        let tiers = tiers::tiers(connection, target.id).expect("read");
        let said: Vec<_> = tiers
            .iter()
            .map(|tier| tiers::annotations(connection, tier.id).expect("read"))
            .collect();
        let tokens = signs::tokens_of_recording(connection, target.id).expect("read");
        let values: Vec<_> = tokens
            .iter()
            .map(|token| signs::values(connection, token.id).expect("read"))
            .collect();
        format!("{target:?}\n{recipe:?}\n{inputs:?}\n{tiers:?}\n{said:?}\n{tokens:?}\n{values:?}")
    }

    fn clip(corpus: &Corpus) -> chereme_motion::Clip {
        let moving = corpus.movement_in(&limace(), None, &ChannelGroup::ALL);
        moving.expect("moves").clip
    }

    #[test]
    fn a_sign_is_made_anew_in_its_place_and_undo_brings_the_former_back() {
        let (_folder, mut corpus) = corpus();
        let (before, old) = (state(&corpus), clip(&corpus));
        let first = address::token(corpus.store.read(), &limace()).expect("a token");
        let recipe = "ESCARGOT | configure right U | repeat 2";
        let done = corpus.recombine_again(&limace(), recipe).expect("made");
        assert_eq!(done.token, Some(first.id), "the token stays");
        assert_eq!(
            (done.gloss.as_str(), done.recording),
            ("LIMACE", first.recording_id)
        );
        assert_eq!(done.name.as_deref(), Some("LIMACE"));
        let new = clip(&corpus);
        assert_eq!(new.frames(), done.clip.frames());
        assert!(new.frames() > old.frames());
        let token = address::token(corpus.store.read(), &limace()).expect("a token");
        assert_eq!(token.annotation_id, first.annotation_id);
        assert_eq!(token.end_us, Some(done.duration_us));
        let glance = corpus.overview(1).expect("read");
        let glance = glance.recordings.iter().find(|it| it.row.name == "LIMACE");
        assert_eq!(glance.and_then(|it| it.recipe.as_deref()), Some(recipe));
        let mut hear = unheard;
        let checked = corpus.check(false, &mut Progress::new(&mut hear));
        assert_eq!(checked.expect("checked").faults, []);
        corpus.undo().expect("undone");
        assert_eq!(state(&corpus), before);
        assert_eq!(clip(&corpus), old);
        corpus.redo().expect("done again");
        assert_eq!(clip(&corpus), new);
    }

    #[test]
    fn what_people_wrote_stays_as_far_as_the_new_sign_goes() {
        let (_folder, mut corpus) = corpus();
        corpus
            .recombine_again(&limace(), "ESCARGOT | repeat 2")
            .expect("made");
        let recording = Name::Text("LIMACE".into());
        let remarks = NewTier::new(recording.clone(), "Remarks", TierRole::Comment);
        corpus.add_tier(&remarks).expect("added");
        let end = corpus.movement(&limace()).expect("moves").clip.span().end();
        let add = |start: Instant, end: Instant, value: &str| AnnotationChange {
            place: None,
            label: None,
            action: AnnotationAction::Add {
                tier: TierName::read("Remarks", Some(&recording)).expect("a tier"),
                start: Some(Moment::Time(start)),
                end: Some(Moment::Time(end)),
                parent: None,
                order: None,
                value: value.into(),
                confidence: None,
            },
        };
        let third = |n: i64| Instant::from_micros(end.micros() * n / 9);
        let changes = [
            add(third(1), third(2), "stays"),
            add(third(3), third(7), "ends earlier"),
            add(third(8), end, "goes"),
        ];
        let mut hear = unheard;
        corpus
            .annotate(
                &changes,
                &AnnotateOptions::default(),
                &mut Progress::new(&mut hear),
            )
            .expect("written");
        let done = corpus.recombine_again(&limace(), "ESCARGOT").expect("made");
        let told = done.report.warnings.last().expect("a warning");
        assert!(told.ends_with("taken away: 2"), "{told}");
        let connection = corpus.store.read();
        let all = tiers::tiers(connection, done.recording.expect("stored")).expect("read");
        let remarks = all.iter().find(|it| it.name == "Remarks").expect("a tier");
        let said = tiers::annotations(connection, remarks.id).expect("read");
        let said: Vec<_> = said
            .iter()
            .map(|it| (it.value.as_str(), it.end_us))
            .collect();
        let ends = [third(2).micros(), done.duration_us];
        assert_eq!(said, [("stays", ends[0]), ("ends earlier", ends[1])]);
    }

    #[test]
    fn what_a_sign_was_made_from_is_told_with_its_time() {
        let (_folder, mut corpus) = corpus();
        let recipe = "ESCARGOT then spell LSF then LIMACE | repeat 2";
        let made = corpus.recombine(recipe, "MANY").expect("made");
        let glosses: Vec<&str> = made.parts.iter().map(|it| it.gloss.as_str()).collect();
        assert_eq!(glosses, ["ESCARGOT", "LSF", "LIMACE", "LIMACE"]);
        let there: Vec<bool> = made
            .parts
            .iter()
            .map(|it| it.original().is_some())
            .collect();
        assert_eq!(there, [true, false, true, true]);
        let apart = |pair: &[crate::MadePart]| pair[0].span.end() <= pair[1].span.start();
        assert!(made.parts.windows(2).all(apart), "{:?}", made.parts);
        let stored = corpus.made_parts(made.recording.expect("stored"));
        assert_eq!(stored.expect("read"), made.parts);
    }

    #[test]
    fn a_sign_does_not_take_its_own_place_nor_that_of_a_captured_one() {
        let (_folder, mut corpus) = corpus();
        corpus
            .recombine("LIMACE | reverse", "ECAMIL")
            .expect("made");
        let before = corpus.log(100).expect("read").len();
        for (sign, recipe, wanted) in [
            ("LIMACE", "LIMACE | repeat 2", "itself"),
            ("LIMACE", "ECAMIL | repeat 2", "itself"),
            ("ESCARGOT", "LIMACE | repeat 2", "was not made"),
        ] {
            let sign = Address::Gloss(sign.into());
            let error = corpus.recombine_again(&sign, recipe).expect_err(recipe);
            assert!(error.to_string().contains(wanted), "{error}");
        }
        assert_eq!(corpus.log(100).expect("read").len(), before);
        let done = corpus.recombine_again(&limace(), "ESCARGOT | repeat 2");
        let warnings = done.expect("made").report.warnings;
        assert!(
            warnings.iter().any(|it| it.contains("ECAMIL")),
            "{warnings:?}"
        );
    }
}
