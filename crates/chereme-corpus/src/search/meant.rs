//! The meaning of everyday words, in the values of the corpus.

use chereme_sign::inventory::Inventory;
use chereme_sign::query;

use crate::{Corpus, Result, StoredInventory};

/// Returns the query that is meant by words that name components before their values; see
/// [`query::meant`].
#[must_use]
pub fn meant(text: &str, inventories: &[StoredInventory]) -> Option<String> {
    query::meant(text, &plain(inventories))
}

/// Returns the same where values stand without what they are values of, too; see [`query::guessed`].
#[must_use]
pub fn guessed(text: &str, inventories: &[StoredInventory]) -> Option<String> {
    query::guessed(text, &plain(inventories))
}

fn plain(inventories: &[StoredInventory]) -> Vec<&Inventory> {
    inventories.iter().map(|it| &it.inventory).collect()
}

impl Corpus {
    /// Returns what a query that finds nothing may mean: "handshape U" is `configuration=U`.
    ///
    /// # Errors
    /// Where the inventories cannot be read.
    pub fn guess(&self, query: &str) -> Result<Option<String>> {
        Ok(guessed(query, &self.inventories_now()?))
    }
}
