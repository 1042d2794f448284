//! A corpus opened for work: SQLite, search index, history, every use case.
