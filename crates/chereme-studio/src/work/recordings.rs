//! Jobs that describe, show and delete recordings, their signers and their signs.

use chereme_corpus::{
    Address, DeleteOptions, Details, FitOptions, MediaChange, Name, RecordingChange, SignChange,
    SignerChange, TrackChange,
};

use super::{About, Job, Outcome};
use crate::panes::inspector::Thing;
use crate::words::shell;

/// Changes a recording.
pub(crate) fn change_recording(name: Name, change: RecordingChange) -> Job {
    Job::change(move |corpus, _| corpus.change_recording(&name, &change))
}

/// Changes the media files of a recording.
pub(crate) fn change_media(recording: Name, change: MediaChange) -> Job {
    Job::change(move |corpus, _| corpus.change_media(&recording, &change))
}

/// Changes a track of a recording, for example its place on the clock.
pub(crate) fn change_track(recording: Name, track: String, change: TrackChange) -> Job {
    Job::change(move |corpus, _| corpus.change_track(&recording, &track, &change))
}

/// Changes a signer.
pub(crate) fn change_signer(name: Name, change: SignerChange) -> Job {
    Job::change(move |corpus, _| corpus.change_signer(&name, &change))
}

/// Changes a sign.
pub(crate) fn change_sign(name: Name, change: SignChange) -> Job {
    Job::change(move |corpus, _| corpus.change_sign(&name, &change))
}

/// Makes a token the citation form of its sign.
pub(crate) fn set_citation(token: Address) -> Job {
    Job::change(move |corpus, _| corpus.set_citation(&token))
}

/// Deletes recordings and signs, or reports what would be deleted.
pub(crate) fn delete(what: Vec<Address>, options: DeleteOptions) -> Job {
    Job::new(About::EDIT, move |corpus, progress| {
        let deleted = corpus.delete(&what, options, progress);
        deleted.map(Outcome::Deleted)
    })
}

/// Returns the people to whom the markers of a recording belong.
pub(crate) fn marker_people(recording: Name) -> Job {
    let about = About {
        task: shell::TASK_FIT,
        quiet: false,
        ..About::ASK
    };
    Job::new(about, move |corpus, _| {
        let people = corpus.marker_people(&recording, None);
        people.map(Outcome::People)
    })
}

/// Fits a body to the markers of a recording, or to those of one person in it.
pub(crate) fn fit_markers(recording: Name, subject: Option<String>) -> Job {
    Job::long(shell::TASK_FIT, move |corpus, _| {
        let options = FitOptions {
            subject: subject.as_deref(),
            ..FitOptions::default()
        };
        let report = corpus.fit_markers(&recording, &options)?;
        Ok(Outcome::Fitted(Box::new(report)))
    })
}

/// Returns all details of something.
pub(crate) fn look(thing: Thing) -> Job {
    Job::new(About::ASK, move |corpus, _| {
        let details = match thing {
            Thing::Token(id) => {
                Details::Token(Box::new(corpus.token_details(&Address::Token(id))?))
            }
            Thing::Sign(id) => Details::Sign(corpus.sign_details(&Name::Number(id))?),
            Thing::Signer(id) => Details::Signer(corpus.signer_details(&Name::Number(id))?),
            Thing::Recording(id) => {
                Details::Recording(corpus.recording_details(&Name::Number(id))?)
            }
            Thing::Value(inventory, value) => {
                let uses = corpus.value_uses(inventory, &value)?;
                Details::Value(inventory, value, uses)
            }
        };
        Ok(Outcome::Looked(details))
    })
}
