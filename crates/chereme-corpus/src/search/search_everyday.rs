//! Interpretation of everyday words as conditions on values of the corpus.

use chereme_sign::inventory::ComponentInventory;
use chereme_sign::query;

use crate::{Corpus, CorpusResult, StoredInventory};

/// Returns the query for a text that names components before their values; see [`query::query_from_everyday_words`].
#[must_use]
pub fn meant_query_text(text: &str, inventories: &[StoredInventory]) -> Option<String> {
    query::query_from_everyday_words(text, &plain_inventories(inventories))
}

/// Returns the query for a text in which values may also stand without their components; see [`query::guess_everyday_query`].
#[must_use]
pub fn guessed_query_text(text: &str, inventories: &[StoredInventory]) -> Option<String> {
    query::guess_everyday_query(text, &plain_inventories(inventories))
}

fn plain_inventories(inventories: &[StoredInventory]) -> Vec<&ComponentInventory> {
    inventories.iter().map(|stored| &stored.inventory).collect()
}

impl Corpus {
    /// Returns the likely meaning of a query that finds nothing: "handshape U" is `configuration=U`.
    ///
    /// # Errors
    /// Fails if the inventories cannot be read.
    pub fn guess_query_meaning(&self, query: &str) -> CorpusResult<Option<String>> {
        Ok(guessed_query_text(query, &self.inventories_now()?))
    }
}
