//! Code of other people that may panic on damaged data: the search engine, the decoder of films.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    static IS_FOREIGN: Cell<bool> = const { Cell::new(false) };
}

/// Returns the result of work in code of other people; `None` if it panics.
pub(crate) fn catch_panic<T>(work: impl FnOnce() -> T) -> Option<T> {
    // The work may call foreign code again, whose end must not end this call.
    let before = IS_FOREIGN.replace(true);
    let done = catch_unwind(AssertUnwindSafe(work));
    IS_FOREIGN.set(before);
    done.ok()
}

/// Keeps the panics that the library catches and handles from being printed; the whole program calls it once.
pub fn hide_handled_panics() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !IS_FOREIGN.get() {
            usual(panic);
        }
    }));
}
