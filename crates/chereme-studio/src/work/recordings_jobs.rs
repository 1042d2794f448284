//! Jobs that describe, show and delete recordings, their signers and their signs.

use chereme_corpus::{
    ConsentChange, CorpusAddress, DeleteOptions, FitOptions, LinkedRecordings, MediaChange, ObjectDetails,
    PersonChange, RecordingChange, RelationChange, RowName, SignChange, SignerChange, TrackChange,
};

use super::{CorpusJob, JobAbout, WorkOutcome};
use crate::model::InspectedThing;
use crate::words::shell;

/// Changes a recording.
pub(crate) fn change_recording(name: RowName, change: RecordingChange) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.change_recording(&name, &change))
}

/// Changes the media files of a recording.
pub(crate) fn change_media(recording: RowName, change: MediaChange) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.change_media(&recording, &change))
}

/// Changes a track of a recording, for example its place on the clock.
pub(crate) fn change_track(recording: RowName, track: String, change: TrackChange) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.change_track(&recording, &track, &change))
}

/// Changes a signer.
pub(crate) fn change_signer(name: RowName, change: SignerChange) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.change_signer(&name, &change))
}

/// Changes a person.
pub(crate) fn change_person(name: RowName, change: PersonChange) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.change_person(&name, &change))
}

/// Makes a person one with another, who stays.
pub(crate) fn unite_people(person: RowName, into: RowName) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.unite_people(&[person], &into))
}

/// Changes what a person or a recording agreed to.
pub(crate) fn change_consent_job(who: CorpusAddress, change: ConsentChange) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.change_consent(&[who], &change))
}

/// Names the annotator whose readings count before those of others, or nobody.
pub(crate) fn prefer_annotator_job(name: Option<String>) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.prefer_annotator(name.as_deref()))
}

/// Changes a sign.
pub(crate) fn change_sign(name: RowName, change: SignChange) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.change_sign(&name, &change))
}

/// Adds a relation of a sign to another one, or takes it away.
pub(crate) fn change_relation_job(sign: i64, relation: String, other: RowName, change: RelationChange) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| {
        corpus.change_relations(&RowName::Number(sign), &relation, &[other], change)
    })
}

/// Looks up the glosses of a recording in a lexicon from now on, or in none.
pub(crate) fn link_lexicon_job(recording: i64, lexicon: Option<String>) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, progress| {
        let recordings = LinkedRecordings::Named(vec![RowName::Number(recording)]);
        corpus.link_lexicon(lexicon.as_deref(), &recordings, progress)
    })
}

/// Makes a lexicon one with another, which stays.
pub(crate) fn unite_lexicons_job(from: String, into: String) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, progress| corpus.unite_lexicons(&[from], &into, progress))
}

/// Makes two values one; the second stands for the first.
pub(crate) fn equate_values_job(value: String, other: String) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.equate_values(&value, &other))
}

/// Takes a value out of those that it is one with.
pub(crate) fn part_value_job(value: String) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.part_equal_value(&value))
}

/// Makes a token the citation form of its sign.
pub(crate) fn set_citation(token: CorpusAddress) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.set_citation(&token))
}

/// Deletes recordings and signs, or reports what would be deleted.
pub(crate) fn delete_recordings_job(what: Vec<CorpusAddress>, options: DeleteOptions) -> CorpusJob {
    CorpusJob::new(JobAbout::EDIT_JOB_ABOUT, move |corpus, progress| {
        let deleted = corpus.delete_objects(&what, options, progress);
        deleted.map(WorkOutcome::Deleted)
    })
}

/// Returns the people to whom the markers of a recording belong.
pub(crate) fn marker_people(recording: RowName) -> CorpusJob {
    let about = JobAbout {
        task: shell::TASK_FIT,
        quiet: false,
        ..JobAbout::ASK_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, _| {
        let people = corpus.marker_people(&recording, None);
        people.map(WorkOutcome::People)
    })
}

/// Fits a body to the markers of a recording, or to those of one person in it.
pub(crate) fn fit_markers(recording: RowName, subject: Option<String>) -> CorpusJob {
    CorpusJob::new_long_job(shell::TASK_FIT, move |corpus, _| {
        let options = FitOptions {
            subject: subject.as_deref(),
            ..FitOptions::default()
        };
        let report = corpus.fit_markers(&recording, &options)?;
        Ok(WorkOutcome::Fitted(Box::new(report)))
    })
}

/// Returns all details of something.
pub(crate) fn look_up_details_job(thing: InspectedThing) -> CorpusJob {
    CorpusJob::new(JobAbout::ASK_JOB_ABOUT, move |corpus, _| {
        let details = match thing {
            InspectedThing::Token(id) => {
                ObjectDetails::Token(Box::new(corpus.token_details(&CorpusAddress::Token(id))?))
            }
            InspectedThing::Sign(id) => ObjectDetails::Sign(corpus.sign_details(&RowName::Number(id))?),
            InspectedThing::Signer(id) => ObjectDetails::Signer(corpus.signer_details(&RowName::Number(id))?),
            InspectedThing::Recording(id) => ObjectDetails::Recording(corpus.recording_details(&RowName::Number(id))?),
            InspectedThing::Value(inventory, value) => ObjectDetails::Value(corpus.value_details(inventory, &value)?),
        };
        Ok(WorkOutcome::Looked(Box::new(details)))
    })
}
