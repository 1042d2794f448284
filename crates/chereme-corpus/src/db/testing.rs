//! Operations of tests.

use rusqlite::Connection;

use super::{CorpusStore, DerivedData};
use crate::error::CorpusResult;
use crate::words::effect::OperationEffect;

impl<D: DerivedData> CorpusStore<D> {
    /// Runs the work of a test as an operation with this name; the work returns its summary.
    pub(crate) fn named_operation<T>(
        &mut self,
        name: &str,
        work: impl FnOnce(&Connection) -> CorpusResult<(T, String)>,
    ) -> CorpusResult<T> {
        self.run_store_operation(|connection| {
            let (value, summary) = work(connection)?;
            let name = name.to_owned();
            Ok((value, OperationEffect::SummaryOnly { name, summary }))
        })
    }
}
