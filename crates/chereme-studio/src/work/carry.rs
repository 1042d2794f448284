//! Each piece of work as a call of the corpus.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_corpus::{
    Address, ChannelGroup, Corpus, CuedOptions, Details, ExportWhat, MadePart, MapOptions,
    MilestoneOptions, Moving, Name, Performance, Progress, Result, SearchOptions, Step, Unit,
    draw_clip,
};
use chereme_motion::Span;
use eframe::egui::{Color32, ColorImage};

use super::{Outcome, Shared, Work};
use crate::panes::inspector::Thing;

/// The room for the picture of a film in a list, in pixels.
const STILL: [usize; 2] = [288, 288];

/// Carries out a piece of work.
pub(super) fn carry(
    corpus: &mut Corpus,
    work: Work,
    progress: &mut Progress<'_>,
) -> Result<Outcome> {
    Ok(match work {
        Work::Annotate(changes, options) => {
            Outcome::Annotated(corpus.annotate(&changes, &options, progress)?)
        }
        Work::AddTier(tier) => corpus.add_tier(&tier).map(|_| Outcome::Changed)?,
        Work::AddTiers(recording, scheme) => corpus
            .add_tiers(&recording, &scheme)
            .map(|_| Outcome::Changed)?,
        Work::ChangeTier(tier, change) => corpus
            .change_tier(&tier, &change)
            .map(|_| Outcome::Changed)?,
        Work::CopyTier(tier, name, copied) => corpus
            .copy_tier(&tier, &name, &copied)
            .map(|_| Outcome::Changed)?,
        Work::OrderTiers(recording, order) => corpus
            .order_tiers(&recording, &order)
            .map(|()| Outcome::Changed)?,
        Work::RemoveTier(tier) => corpus.remove_tier(&tier).map(|_| Outcome::Changed)?,
        Work::Recombine { recipe, gloss } => {
            Outcome::Recombined(Box::new(corpus.recombine(&recipe, &gloss)?))
        }
        Work::RecombineAgain { recipe, recording } => {
            let sign = Address::Recording(Name::Number(recording));
            Outcome::Recombined(Box::new(corpus.recombine_again(&sign, &recipe)?))
        }
        Work::Import(paths, options) => {
            Outcome::Imported(corpus.import(&paths, &options, progress)?)
        }
        Work::Merge(other) => Outcome::Merged(corpus.merge(&other, None, progress)?),
        Work::Walk { back, steps } => walk(corpus, back, steps, progress)?,
        Work::ChangeRecording(name, change) => corpus
            .change_recording(&name, &change)
            .map(|_| Outcome::Changed)?,
        Work::ChangeMedia(name, change) => corpus
            .change_media(&name, &change)
            .map(|_| Outcome::Changed)?,
        Work::ChangeTrack(name, track, change) => corpus
            .change_track(&name, &track, &change)
            .map(|_| Outcome::Changed)?,
        Work::ChangeSigner(name, change) => corpus
            .change_signer(&name, &change)
            .map(|_| Outcome::Changed)?,
        Work::ChangeSign(name, change) => corpus
            .change_sign(&name, &change)
            .map(|_| Outcome::Changed)?,
        Work::SetCitation(token) => corpus.set_citation(&token).map(|_| Outcome::Changed)?,
        Work::KeepSearches(all) => corpus.keep_searches(&all).map(|()| Outcome::Changed)?,
        Work::RenameSearch(from, to) => corpus
            .rename_search(&from, &to)
            .map(|()| Outcome::Changed)?,
        Work::ForgetSearch(name) => corpus.forget_search(&name).map(|_| Outcome::Changed)?,
        Work::Delete(what, options) => Outcome::Deleted(corpus.delete(&what, options, progress)?),
        Work::Check { mend } => Outcome::Checked(corpus.check(mend, progress)?),
        Work::ProposeIn(options) => Outcome::Proposed(corpus.propose(&options, progress)?),
        Work::Accept(annotations) => {
            Outcome::Annotated(corpus.accept_proposals(&annotations, progress)?)
        }
        Work::Propose(component) => Outcome::Proposed(corpus.propose_coding(component, progress)?),
        Work::Look(thing) => Outcome::Looked(look(corpus, thing)?),
        Work::Decide(number, decision) => corpus
            .decide(&[number], decision)
            .map(|_| Outcome::Changed)?,
        Work::Undo => Outcome::Undone(corpus.undo()?),
        Work::Redo => Outcome::Redone(corpus.redo()?),
        Work::Search(query, options) => {
            Outcome::Found(corpus.search_until(&query, &options, progress)?)
        }
        Work::Around(tokens, most) => Outcome::Around(corpus.around(&tokens, most)?),
        Work::Map(components) => {
            let options = MapOptions {
                components,
                query: None,
            };
            Outcome::Mapped(Arc::new(corpus.map(&options, progress)?))
        }
        Work::CueSlips(recording, code) => {
            let options = CuedOptions {
                code,
                ..CuedOptions::default()
            };
            let name = Name::Number(recording);
            Outcome::CueSlips(Box::new(corpus.cue_slips(&name, None, false, &options)?))
        }
        Work::Expressions => {
            let options = MilestoneOptions {
                dry_run: true,
                ..MilestoneOptions::default()
            };
            Outcome::Expressions(Arc::new(corpus.milestones(&options, progress)?))
        }
        Work::Milestones(function) => {
            let options = MilestoneOptions {
                function: Some(function),
                ..MilestoneOptions::default()
            };
            corpus
                .milestones(&options, progress)
                .map(|_| Outcome::Changed)?
        }
        Work::ChooseFace {
            function,
            target,
            options,
        } => Outcome::Chosen(Arc::new(
            corpus.choose(&function, &target, &options, progress)?,
        )),
        Work::Onsets(function) => {
            Outcome::Onsets(Arc::new(corpus.onsets(function.as_ref(), progress)?))
        }
        Work::ProposeNonmanuals(address) => corpus
            .propose_nonmanuals(&address, true, progress)
            .map(|_| Outcome::Changed)?,
        Work::Preview(recipe) => Outcome::Previewed(Arc::new(corpus.preview(&recipe)?)),
        Work::Draft { recipe, again } => {
            Outcome::Previewed(Arc::new(corpus.draft(&recipe, again, progress)?))
        }
        Work::Suggest(address) => Outcome::Suggested(corpus.suggest(&address)?),
        Work::Paths(typed) => {
            let paths = chereme_corpus::paths_like(&typed);
            Outcome::Paths(typed, paths)
        }
        Work::ExportFound(query, to, options) => {
            let all = SearchOptions {
                limit: None,
                facets: false,
                ..SearchOptions::default()
            };
            let found = corpus.search_until(&query, &all, progress)?;
            let tokens = found.hits.iter().map(|hit| hit.token).collect();
            let what = ExportWhat::Tokens(tokens);
            Outcome::Exported(corpus.export(&what, &to, &options, progress)?)
        }
        Work::Export(what, to, options) => {
            Outcome::Exported(corpus.export(&what, &to, &options, progress)?)
        }
        Work::Share(what, to, options) => Outcome::Shared(match what {
            Shared::Stored(address) => corpus.draw(&address, &to, &options, progress)?,
            Shared::Made(made) => {
                let performance = Performance {
                    clip: &made.clip,
                    anatomy: &made.anatomy,
                    faces: &made.faces,
                };
                draw_clip(performance, &made.name, &to, &options, progress)?
            }
        }),
        Work::Originals(parts) => originals(corpus, parts),
        Work::OriginalsOf(recording) => {
            let parts = corpus.made_parts(recording)?;
            originals(corpus, parts)
        }
        Work::Points(recording, span) => Outcome::Points(corpus.points_in(recording, span)?),
        Work::Stretch(recording, span) => {
            let address = Address::Recording(Name::Number(recording));
            let moving = corpus.movement_in(&address, Some(span), &ChannelGroup::ALL);
            match moving.ok().filter(|it| it.clip.frames() > 0) {
                Some(moving) => Outcome::Stretch(Some(Arc::new(moving))),
                None => film_still(corpus, recording, span)?,
            }
        }
        Work::Movement {
            recording,
            piece,
            span,
        } => {
            let address = Address::Recording(Name::Number(recording));
            let moving = corpus.movement_in(&address, Some(span), &ChannelGroup::ALL)?;
            Outcome::Moved {
                recording,
                piece,
                moving: Arc::new(moving),
            }
        }
        Work::Measure {
            recording,
            piece,
            span,
        } => Outcome::Measured {
            recording,
            piece,
            curves: Box::new(corpus.curves(recording, span)?),
        },
    })
}

/// Undoes or redoes operations one after the other; if it is stopped, the finished ones stay.
fn walk(
    corpus: &mut Corpus,
    back: bool,
    steps: usize,
    progress: &mut Progress<'_>,
) -> Result<Outcome> {
    for done in 0..steps {
        progress.report(Step {
            task: "",
            done: done as u64,
            total: Some(steps as u64),
            unit: Unit::Items,
        })?;
        if back {
            corpus.undo()?;
        } else {
            corpus.redo()?;
        }
    }
    Ok(Outcome::Walked { back, steps })
}

/// How many different originals are loaded at most.
const ORIGINALS: usize = 24;

/// Loads the original of each piece; equal originals are loaded once, and a missing one is not an error.
fn originals(corpus: &Corpus, parts: Vec<MadePart>) -> Outcome {
    let mut known: BTreeMap<String, Option<Arc<Moving>>> = BTreeMap::new();
    let loaded = parts.into_iter().map(|part| {
        if !known.contains_key(&part.from) && known.len() < ORIGINALS {
            let moving = part.original().and_then(|it| corpus.movement(&it).ok());
            let moving = moving.filter(|it| it.clip.frames() > 0).map(Arc::new);
            known.insert(part.from.clone(), moving);
        }
        let moving = known.get(&part.from).cloned().flatten();
        (part, moving)
    });
    Outcome::Originals(loaded.collect())
}

fn look(corpus: &Corpus, thing: Thing) -> Result<Details> {
    Ok(match thing {
        Thing::Token(id) => Details::Token(Box::new(corpus.token_details(&Address::Token(id))?)),
        Thing::Sign(id) => Details::Sign(corpus.sign_details(&Name::Number(id))?),
        Thing::Signer(id) => Details::Signer(corpus.signer_details(&Name::Number(id))?),
        Thing::Recording(id) => Details::Recording(corpus.recording_details(&Name::Number(id))?),
        Thing::Value(inventory, value) => {
            let uses = corpus.value_uses(inventory, &value)?;
            Details::Value(inventory, value, uses)
        }
    })
}

/// Takes the picture of a recording's film in the middle of a span.
fn film_still(corpus: &Corpus, recording: i64, span: Span) -> Result<Outcome> {
    let middle = span.start().shifted(span.micros() / 2);
    let still = corpus.film_still(&Name::Number(recording), middle, STILL)?;
    Ok(match still {
        Some(picture) => {
            let pixels = picture.rgba.chunks_exact(4);
            let pixels = pixels.map(|it| Color32::from_rgb(it[0], it[1], it[2]));
            let size = [picture.width, picture.height];
            Outcome::Still(Arc::new(ColorImage::new(size, pixels.collect())))
        }
        None => Outcome::Stretch(None),
    })
}
