//! Interpretation of everyday words as conditions on values of the corpus.

use chereme_sign::inventory::Inventory;
use chereme_sign::query;

use crate::{Corpus, Result, StoredInventory};

/// Returns the query for a text that names components before their values; see [`query::meant`].
#[must_use]
pub fn meant(text: &str, inventories: &[StoredInventory]) -> Option<String> {
    query::meant(text, &plain(inventories))
}

/// Returns the query for a text in which values may also stand without their components; see [`query::guessed`].
#[must_use]
pub fn guessed(text: &str, inventories: &[StoredInventory]) -> Option<String> {
    query::guessed(text, &plain(inventories))
}

fn plain(inventories: &[StoredInventory]) -> Vec<&Inventory> {
    inventories.iter().map(|it| &it.inventory).collect()
}

impl Corpus {
    /// Returns the likely meaning of a query that finds nothing: "handshape U" is `configuration=U`.
    ///
    /// # Errors
    /// Fails if the inventories cannot be read.
    pub fn guess(&self, query: &str) -> Result<Option<String>> {
        Ok(guessed(query, &self.inventories_now()?))
    }
}
