//! The annotations before and after tokens on their tiers.

use crate::Corpus;
use crate::db::stored_contents as rows;
pub use crate::db::stored_rows::TokenNeighbours;
use crate::db::stored_search::begin_reading;
use crate::error::CorpusResult;

impl Corpus {
    /// Returns the annotations before and after tokens, at most `most` on each side, in the order of `tokens`; for a
    /// missing token only its number.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn annotations_around_tokens(&self, tokens: &[i64], most: usize) -> CorpusResult<Vec<TokenNeighbours>> {
        let reading = begin_reading(self.store.read_connection())?;
        tokens
            .iter()
            .map(|token| rows::load_annotations_around(&reading, *token, most))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        AnnotateOptions, AnnotationAction, AnnotationChange, ImportOptions, ProgressReceiver, SearchOptions,
        TableMoment, TierRequestName, ignore_progress_step, unpack_starter,
    };
    use chereme_motion::RecordingInstant;

    #[test]
    fn neighbouring_tokens_are_listed_in_the_order_of_time() {
        let folder = tempfile::tempdir().expect("a folder");
        let paths = unpack_starter(&folder.path().join("s")).expect("unpacked");
        let one = |path: &std::path::PathBuf| path.file_stem().is_some_and(|stem| stem == "bol");
        let paths: Vec<_> = paths.into_iter().filter(one).collect();
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let mut hear = ignore_progress_step;
        let mut progress = ProgressReceiver::new(&mut hear);
        let options = ImportOptions::default();
        corpus.import_paths(&paths, &options, &mut progress).expect("imported");
        let hits = |corpus: &mut Corpus| {
            let found = corpus.search_tokens("", &SearchOptions::default()).expect("found");
            let hits: Vec<i64> = found.hits.iter().map(|hit| hit.token).collect();
            hits
        };
        let bol = hits(&mut corpus)[0];
        let first = corpus.annotations_around_tokens(&[bol, 999], 2).expect("read");
        assert!(first[0].before.is_empty() && first[0].after.is_empty());
        let nobody = TokenNeighbours {
            token: 999,
            ..TokenNeighbours::default()
        };
        assert_eq!(first[1], nobody);
        let tier = TierRequestName::Number(first[0].tier.expect("a tier"));
        let end = corpus.load_corpus_overview(0).expect("read").recordings[0]
            .row
            .duration_us;
        let add = |number: i64| {
            let at = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
            AnnotationChange::from(AnnotationAction::Add {
                tier: tier.clone(),
                start: at(end - 40_000 + number * 10_000),
                end: at(end - 30_000 + number * 10_000),
                parent: None,
                order: None,
                value: format!("G{number}"),
                confidence: None,
            })
        };
        let changes: Vec<AnnotationChange> = (0..3).map(add).collect();
        let mut progress = ProgressReceiver::new(&mut hear);
        let options = AnnotateOptions::default();
        corpus
            .annotate_corpus(&changes, &options, &mut progress)
            .expect("annotated");
        let around = corpus.annotations_around_tokens(&[bol], 2).expect("read");
        assert_eq!(around[0].after, ["G0", "G1"]);
        let last = hits(&mut corpus).pop().expect("the last");
        let around = corpus.annotations_around_tokens(&[last], 2).expect("read");
        assert_eq!(around[0].before, ["G0", "G1"]);
        assert!(around[0].after.is_empty());
    }
}
