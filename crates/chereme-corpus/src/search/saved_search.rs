//! Searches that are saved in the corpus under a name, so that they travel with it.
//!
//! In every query, `@NAME` stands for the search saved under that name.

use chereme_sign::ErrorRemedy;
use chereme_sign::query::TokenQuery;
use chereme_sign::text::{did_you_mean, edit_distance, fold_text, nearest_candidate};
use rusqlite::Connection;

use super::wrong_query_error;
use crate::Corpus;
use crate::db::saved_searches as rows;
use crate::db::stored_rows::KeptSearch;
use crate::error::{CorpusError, CorpusResult};
use crate::words::effect::OperationEffect;

impl Corpus {
    /// Returns the saved searches, by name.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn kept_searches(&self) -> CorpusResult<Vec<KeptSearch>> {
        list_saved_searches(self.store.read_connection())
    }

    /// Saves searches under their names, as they are written; a search replaces the one that had its name.
    ///
    /// # Errors
    /// Fails if a name is empty, a query cannot be understood, or searches would use each other in a circle; nothing is
    /// saved then.
    pub fn keep_searches(&mut self, searches: &[KeptSearch]) -> CorpusResult<()> {
        self.store.run_store_operation(|connection| {
            let mut names = Vec::with_capacity(searches.len());
            for search in searches {
                let search = KeptSearch {
                    name: require_search_name(&search.name)?,
                    query: search.query.clone(),
                };
                match find_saved_search(connection, &search.name)? {
                    Some((_, old)) if old == search => {}
                    Some((id, _)) => rows::update_saved_search(connection, id, &search)?,
                    None => rows::insert_saved_search(connection, &search)?,
                }
                // The search is written already, so that a circle through itself is found.
                parse_query_with_saved(connection, &format!("@{}", search.name))?;
                names.push(search.name);
            }
            Ok(((), OperationEffect::KeepSearch { names }))
        })
    }

    /// Saves a search under a name that no other search has.
    ///
    /// # Errors
    /// Fails if another search is saved under the name, and as [`keep_searches`](Self::keep_searches) does.
    pub fn keep_new_search(&mut self, search: &KeptSearch) -> CorpusResult<()> {
        match find_saved_search(self.store.read_connection(), &require_search_name(&search.name)?)? {
            Some((_, old)) if old.query != search.query => {
                let text = format!("another search is saved as {:?}", old.name);
                let remedy = ErrorRemedy::command_remedy(
                    "give it another name, or replace that one: `chereme search CORPUS --keep NAME QUERY --replace`",
                );
                Err(CorpusError::from_wrong_message(text)
                    .with_error_place(old.query)
                    .with_advice(remedy))
            }
            _ => self.keep_searches(std::slice::from_ref(search)),
        }
    }

    /// Gives a saved search another name.
    ///
    /// # Errors
    /// Fails if no search has that name, if another one uses it, or if the new name is empty or taken.
    pub fn rename_search(&mut self, from: &str, to: &str) -> CorpusResult<()> {
        self.store.run_store_operation(|connection| {
            let (id, old) = existing_saved_search(connection, from)?;
            let new = KeptSearch {
                name: require_search_name(to)?,
                query: old.query.clone(),
            };
            if find_saved_search(connection, &new.name)?.is_some_and(|(other, _)| other != id) {
                let text = format!("another search is saved as {:?}", new.name);
                let error = CorpusError::from_wrong_message(text).with_error_place(new.name);
                return Err(error.with_advice("give it another name"));
            }
            // A name that differs in case alone is still found by the searches that use it.
            if fold_text(&new.name) != fold_text(&old.name) {
                check_unused(connection, &old)?;
            }
            if new != old {
                rows::update_saved_search(connection, id, &new)?;
            }
            let (from, to) = (old.name, new.name);
            Ok(((), OperationEffect::RenameSearch { from, to }))
        })
    }

    /// Removes a saved search, and returns it.
    ///
    /// # Errors
    /// Fails if no search has that name, or if another one uses it.
    pub fn forget_search(&mut self, name: &str) -> CorpusResult<KeptSearch> {
        self.store.run_store_operation(|connection| {
            let (id, search) = existing_saved_search(connection, name)?;
            check_unused(connection, &search)?;
            rows::delete_saved_search(connection, id)?;
            let name = search.name.clone();
            Ok((search, OperationEffect::ForgetSearch { name }))
        })
    }
}

/// Returns the saved searches, by name.
pub(crate) fn list_saved_searches(connection: &Connection) -> CorpusResult<Vec<KeptSearch>> {
    let all = rows::load_saved_searches(connection)?.into_iter();
    Ok(all.map(|(_, search)| search).collect())
}

/// The depth to which saved searches may name one another.
const MOST_INSIDE: usize = 16;
/// How many saved searches a query may use, those that others use counted each time.
const MOST_USES: usize = 1000;

/// The saved searches that a query uses.
#[derive(Default)]
struct SearchesInUse {
    /// Those around the place that is read, outermost first.
    around: Vec<KeptSearch>,
    /// How many there are in all so far.
    count: usize,
}

/// Reads a query, and replaces each `@NAME` by the search that it stands for.
///
/// # Errors
/// Fails if it cannot be understood, also with the saved searches written out, or a saved search does not exist or names
/// itself.
pub(crate) fn parse_query_with_saved(connection: &Connection, query: &str) -> CorpusResult<TokenQuery> {
    let mut used = SearchesInUse::default();
    let parsed = parsed_inside(connection, query, &mut used)?;
    // Written out, searches may be nested more deeply than a query may be, which only its text shows.
    if used.count > 0 {
        let text = parsed.to_string();
        TokenQuery::parse_query(&text).map_err(|error| wrong_query_error(&text, &error))?;
    }
    Ok(parsed)
}

fn parsed_inside(connection: &Connection, query: &str, used: &mut SearchesInUse) -> CorpusResult<TokenQuery> {
    // A name with blanks needs no quotes if it is the whole query.
    if let Some(name) = query.trim().strip_prefix('@')
        && let Some((_, search)) = find_saved_search(connection, name)?
    {
        return expanded(connection, search, used);
    }
    let parsed = TokenQuery::parse_query(query).map_err(|error| wrong_query_error(query, &error))?;
    parsed.with_saved(&mut |saved| {
        let (_, search) = existing_saved_search(connection, &saved.name)?;
        expanded(connection, search, used)
    })
}

/// Returns the query that a saved search stands for.
fn expanded(connection: &Connection, search: KeptSearch, used: &mut SearchesInUse) -> CorpusResult<TokenQuery> {
    let is_circle = used.around.contains(&search);
    let text = search.query.clone();
    used.around.push(search);
    used.count += 1;
    if is_circle || used.around.len() > MOST_INSIDE {
        let search_names = used.around.iter().map(|other| format!("@{}", other.name));
        let names: Vec<String> = search_names.collect();
        let message = format!("saved searches use each other: {}", names.join(" > "));
        return Err(CorpusError::from_wrong_message(message)
            .with_error_place(text)
            .with_advice("keep searches that do not name each other in a circle"));
    }
    if used.count > MOST_USES {
        let message = format!("the query uses more than {MOST_USES} saved searches");
        return Err(CorpusError::from_wrong_message(message)
            .with_error_place(text)
            .with_advice("use fewer of them"));
    }
    let query = parsed_inside(connection, &text, used)?;
    used.around.pop();
    Ok(query)
}

/// Fails if another saved search uses this one.
fn check_unused(connection: &Connection, search: &KeptSearch) -> CorpusResult<()> {
    let folded_name = fold_text(&search.name);
    for other in list_saved_searches(connection)? {
        // A query that is only `@` and a name with blanks is no query for the parser.
        let mut uses = other
            .query
            .trim()
            .strip_prefix('@')
            .is_some_and(|name| fold_text(name.trim()) == folded_name);
        if let Ok(query) = TokenQuery::parse_query(&other.query) {
            let query_copy = query.clone();
            _ = query.with_saved(&mut |saved| {
                uses |= fold_text(&saved.name) == folded_name;
                Ok::<_, std::convert::Infallible>(query_copy.clone())
            });
        }
        if uses {
            let text = format!("the saved search {:?} uses @{}", other.name, search.name);
            let remedy = "change or delete that one first";
            return Err(CorpusError::from_wrong_message(text)
                .with_error_place(other.query)
                .with_advice(remedy));
        }
    }
    Ok(())
}

fn require_search_name(name: &str) -> CorpusResult<String> {
    let name = name.trim();
    if name.is_empty() || name.contains(char::is_control) {
        return Err(
            CorpusError::from_wrong_message("a saved search needs a name of one line").with_advice("give it a name"),
        );
    }
    // People write the name as they use it.
    Ok(name.strip_prefix('@').unwrap_or(name).to_owned())
}

fn find_saved_search(connection: &Connection, name: &str) -> CorpusResult<Option<(i64, KeptSearch)>> {
    let wanted = fold_text(name.trim());
    let mut all = rows::load_saved_searches(connection)?.into_iter();
    Ok(all.find(|(_, search)| fold_text(&search.name) == wanted))
}

fn existing_saved_search(connection: &Connection, name: &str) -> CorpusResult<(i64, KeptSearch)> {
    let trimmed = name.trim();
    let name = trimmed.strip_prefix('@').unwrap_or(trimmed);
    if let Some(found) = find_saved_search(connection, name)? {
        return Ok(found);
    }
    let all = list_saved_searches(connection)?;
    let suggestion = did_you_mean(kept_like(name, &all).map(|search| search.name.as_str()));
    let names: Vec<String> = all.iter().map(|search| format!("@{}", search.name)).collect();
    let remedy = match names.len() {
        0 => ErrorRemedy::command_remedy(
            "there is no saved search yet: `chereme search CORPUS --keep NAME QUERY` saves one",
        ),
        count if count <= MAX_LISTED_SEARCHES => format!("there are: {}", names.join(", ")).into(),
        count => ErrorRemedy::command_remedy(format!("`chereme list CORPUS searches` lists all {count}")),
    };
    Err(
        CorpusError::from_wrong_message(format!("no search is saved as {name:?}{suggestion}"))
            .with_error_place(format!("@{name}"))
            .with_advice(remedy),
    )
}

/// The number of saved searches that are listed if the wanted one does not exist.
const MAX_LISTED_SEARCHES: usize = 8;

/// Returns the saved search that the user most likely meant by `name`: one whose name differs by a slip or two,
/// contains `name`, or shares half of its letters.
#[must_use]
pub fn kept_like<'a>(name: &str, searches: &'a [KeptSearch]) -> Option<&'a KeptSearch> {
    let name = name.trim().trim_start_matches('@');
    let wanted = fold_text(name);
    let near = nearest_candidate(name, searches.iter().map(|search| search.name.as_str()));
    if let Some(near) = near {
        return searches.iter().find(|search| search.name == near);
    }
    let length = wanted.chars().count();
    // One letter is near to every short name.
    if length < 2 {
        return None;
    }
    let holds = |search: &&KeptSearch| {
        let other = fold_text(&search.name);
        other.contains(&wanted) || (other.chars().count() > 1 && wanted.contains(&other))
    };
    let far = |search: &KeptSearch| edit_distance(&wanted, &fold_text(&search.name), length / 2);
    let containing = searches.iter().find(holds);
    containing.or_else(|| {
        let all = searches.iter().filter_map(|search| Some((far(search)?, search)));
        all.min_by_key(|(far, _)| *far).map(|(_, it)| it)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SearchOptions;

    fn kept(name: &str, query: &str) -> KeptSearch {
        KeptSearch {
            name: name.into(),
            query: query.into(),
        }
    }

    #[test]
    fn searches_are_saved_renamed_deleted_and_undone() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let keep = |corpus: &mut Corpus, one| corpus.keep_searches(&[one]);
        keep(&mut corpus, kept(" Menton ", "placement=chin")).expect("kept");
        keep(&mut corpus, kept("brefs", "duration<0.8s")).expect("kept");
        keep(&mut corpus, kept("MENTON", "placement=head")).expect("in its place");
        let now = |corpus: &Corpus| corpus.kept_searches().expect("read");
        let (menton, brefs) = (kept("MENTON", "placement=head"), kept("brefs", "duration<0.8s"));
        assert_eq!(now(&corpus), [menton.clone(), brefs.clone()]);
        assert_eq!(corpus.load_corpus_overview(1).expect("read").searches, now(&corpus));
        assert!(corpus.rename_search("brefs", "menton").is_err());
        corpus.rename_search("brefs", "courts").expect("renamed");
        assert_eq!(corpus.forget_search("@menton").expect("forgotten"), menton);
        assert_eq!(now(&corpus), [kept("courts", "duration<0.8s")]);
        corpus.undo_operation().expect("undone");
        corpus.undo_operation().expect("undone");
        assert_eq!(now(&corpus), [menton, brefs]);
        let log = corpus.operation_log(5).expect("read");
        assert_eq!(
            (log[2].name.as_str(), log[2].summary.as_str()),
            ("forget search", "MENTON")
        );
    }

    #[test]
    fn the_intended_search_is_suggested_for_a_misspelled_name() {
        let all = [kept("mine", ""), kept("à la tête", ""), kept("courts", "")];
        for (name, want) in [
            ("@mein", Some("mine")),
            ("tete", Some("à la tête")),
            ("courts gestes", Some("courts")),
            ("coutrs", Some("courts")),
            ("zzzz", None),
            ("m", None),
        ] {
            let found = kept_like(name, &all).map(|it| it.name.as_str());
            assert_eq!(found, want, "{name}");
        }
    }

    #[test]
    fn a_saved_search_is_run_by_its_name() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let short = kept("petits gestes", "duration<0.8s");
        corpus.keep_searches(&[short]).expect("kept");
        let options = SearchOptions::default();
        let answer = corpus.search_tokens(" @Petits Gestes", &options).expect("found");
        assert_eq!((answer.query.as_str(), answer.total), ("duration<0.8s", 0));
        corpus.keep_searches(&[kept("same", "@petits gestes")]).expect("kept");
        assert_eq!(
            corpus.kept_searches().expect("read")[1].query,
            "@petits gestes",
            "as it was written"
        );
        let answer = corpus.search_tokens("@same", &options).expect("found");
        assert_eq!(answer.query, "duration<0.8s");
        let error = corpus.search_tokens("@petit gestes", &options).expect_err("none");
        assert!(error.to_string().contains("did you mean \"petits gestes\""), "{error}");
        for (name, query) in [("", "gloss=A"), (" ", ""), ("a", "gloss=("), ("b", "@none")] {
            assert!(corpus.keep_searches(&[kept(name, query)]).is_err(), "{name} {query}");
        }
    }

    #[test]
    fn saved_searches_are_usable_anywhere_in_a_query() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let all = [
            kept("chin", "placement=chin or placement=cheek"),
            kept("my chin", "placement=chin"),
        ];
        corpus.keep_searches(&all).expect("kept");
        for (asked, meant) in [
            ("@chin", "placement=chin or placement=cheek"),
            ("not @CHIN", "not (placement=chin or placement=cheek)"),
            ("@chin gloss=A", "(placement=chin or placement=cheek) gloss=A"),
            (
                "@chin or @\"my chin\" gloss=A",
                "placement=chin or placement=cheek or placement=chin gloss=A",
            ),
            ("@my chin", "placement=chin"),
            ("\"@chin\"", "\"@chin\""),
        ] {
            let answer = corpus.search_tokens(asked, &SearchOptions::default());
            assert_eq!(answer.expect(asked).query, meant, "{asked}");
        }
        let error = corpus.search_tokens("not @chim", &SearchOptions::default());
        let error = error.expect_err("not there");
        assert!(error.to_string().contains("did you mean"), "{error}");
        assert!(corpus.keep_searches(&[kept("x", "@x")]).is_err());
    }

    #[test]
    fn a_saved_search_follows_those_that_it_uses() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let meant = |corpus: &mut Corpus, query: &str| {
            let answer = corpus.search_tokens(query, &SearchOptions::default());
            answer.expect(query).query
        };
        let chin = kept("chin", "placement=chin");
        let both = kept("both", "@chin gloss=A");
        let all = [chin.clone(), both, kept("my both", "@both")];
        corpus.keep_searches(&all).expect("kept");
        assert_eq!(meant(&mut corpus, "@both"), "placement=chin gloss=A");
        let wider = kept("chin", "placement=chin or placement=cheek");
        let taken = corpus.keep_new_search(&wider).expect_err("taken");
        assert!(taken.to_string().contains("another search is saved"), "{taken}");
        corpus.keep_new_search(&chin).expect("the same query again");
        corpus.keep_searches(&[wider]).expect("replaced");
        for query in ["@both", "@my both"] {
            let wanted = "(placement=chin or placement=cheek) gloss=A";
            assert_eq!(meant(&mut corpus, query), wanted, "{query}");
        }
        for name in ["chin", "both"] {
            let used = corpus.forget_search(name).expect_err(name);
            assert!(used.to_string().contains("uses @"), "{used}");
            assert!(corpus.rename_search(name, "other").is_err(), "{name}");
        }
        corpus.rename_search("chin", "Chin").expect("the same name");
        let circle = corpus.keep_searches(&[kept("chin", "not @\"my both\"")]);
        let circle = circle.expect_err("a circle").to_string();
        assert!(circle.contains("@chin > @my both > @both > @chin"), "{circle}");
        assert_eq!(
            corpus.kept_searches().expect("read")[0].query,
            "placement=chin or placement=cheek",
            "nothing was saved"
        );
        // Each uses the one before ten times: 10, 110 and 1,110 in all.
        corpus.keep_searches(&[kept("s", "gloss=A")]).expect("kept");
        let mut last = "@s".to_owned();
        for refused in [false, false, true] {
            let query = [last.as_str(); 10].join(" or ");
            last.push('x');
            let done = corpus.keep_searches(&[kept(&last, &query)]);
            let message = done.err().map(|error| error.to_string()).unwrap_or_default();
            assert_eq!(message.contains("more than 1000 saved searches"), refused, "{message}");
            assert_eq!(message.is_empty(), !refused, "{message}");
        }
    }
}
