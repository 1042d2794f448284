//! Agreement on small corpora.
