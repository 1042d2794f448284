//! Each piece of work as a call of the corpus.

use std::sync::Arc;

use chereme_corpus::{Address, ChannelGroup, Corpus, Name, Progress, Result};

use super::{Outcome, Work};

/// Does it.
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
        Work::ChangeTier(tier, change) => corpus
            .change_tier(&tier, &change)
            .map(|_| Outcome::Changed)?,
        Work::RemoveTier(tier) => corpus.remove_tier(&tier).map(|_| Outcome::Changed)?,
        Work::Recombine { recipe, gloss } => {
            Outcome::Recombined(Box::new(corpus.recombine(&recipe, &gloss)?))
        }
        Work::Import(paths, options) => {
            Outcome::Imported(corpus.import(&paths, &options, progress)?)
        }
        Work::Undo => Outcome::Undone(corpus.undo()?),
        Work::Redo => Outcome::Redone(corpus.redo()?),
        Work::Search(query, options) => Outcome::Found(corpus.search(&query, &options)?),
        Work::Preview(recipe) => Outcome::Previewed(Arc::new(corpus.preview(&recipe)?)),
        Work::Suggest(address) => Outcome::Suggested(corpus.suggest(&address)?),
        Work::Export(what, to, options) => {
            Outcome::Exported(corpus.export(&what, &to, &options, progress)?)
        }
        Work::Original(address) => {
            let moving = address.parse().and_then(|it| corpus.movement(&it));
            let moving = moving.ok().filter(|it| it.clip.frames() > 0);
            Outcome::Stretch(moving.map(Arc::new))
        }
        Work::Stretch(recording, span) => {
            let address = Address::Recording(Name::Number(recording));
            let moving = corpus.movement_in(&address, Some(span), &ChannelGroup::ALL);
            let moving = moving.ok().filter(|it| it.clip.frames() > 0);
            Outcome::Stretch(moving.map(Arc::new))
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
    })
}
