//! Tests of the import of films: linked to their recordings, or as recordings of their own.

use super::*;
use crate::film::tests::film as write_film;
use crate::{CorpusAddress, RowName};

/// Writes a film of one second under a name; creates its folder.
pub(super) fn film(desk: &Desk, name: &str) -> PathBuf {
    let path = desk.folder.path().join(name);
    fs::create_dir_all(path.parent().expect("a folder")).expect("made");
    let own = tempfile::tempdir().expect("a folder");
    let written = write_film(own.path(), [64, 48], 25);
    fs::copy(written, &path).expect("copied");
    path
}

/// Returns an annotation file that names a film on another computer.
pub(super) fn naming(film: &str) -> String {
    let media = format!(
        "<HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"><MEDIA_DESCRIPTOR \
         MEDIA_URL=\"file:///D:/gone/{film}\" MIME_TYPE=\"video/mp4\"/></HEADER>"
    );
    eaf(&[("Gloss", 0, 400, "MAISON")]).replace("<HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/>", &media)
}

fn take(corpus: &mut Corpus, paths: &[PathBuf], options: &ImportOptions) -> ImportReport {
    let mut hear = ignore_progress_step;
    corpus
        .import_paths(paths, options, &mut ProgressReceiver::new(&mut hear))
        .expect("imported")
}

fn export(corpus: &Corpus, recording: &str) -> String {
    let mut out = Vec::new();
    let what = ExportWhat::Address(CorpusAddress::Recording(RowName::Text(recording.to_owned())));
    let mut hear = ignore_progress_step;
    corpus
        .export_stream(&what, "eaf", &mut out, &mut ProgressReceiver::new(&mut hear))
        .expect("exported");
    String::from_utf8(out).expect("UTF-8")
}

fn names(corpus: &Corpus) -> Vec<(String, i64)> {
    let rows = stored_recordings::load_recording_rows(corpus.store.read_connection()).expect("rows");
    let mut all: Vec<_> = rows.into_iter().map(|it| (it.name, it.duration_us)).collect();
    all.sort();
    all
}

#[test]
fn a_folder_of_films_and_annotations_becomes_recordings_with_their_films() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    film(&desk, "in/take.mp4");
    film(&desk, "in/deep/bare.mp4");
    let text = naming("take.mp4");
    fs::write(desk.folder.path().join("in/take.eaf"), &text).expect("written");
    let folder = [desk.folder.path().join("in")];
    let report = take(&mut corpus, &folder, &ImportOptions::default());
    assert!(!report.has_refusals(), "{report:?}");
    let want = [("bare".to_owned(), 1_000_000), ("take".to_owned(), 1_000_000)];
    assert_eq!(names(&corpus), want);
    for name in ["take", "bare"] {
        let media = corpus.recording_media(&RowName::Text(name.to_owned())).expect("media");
        assert_eq!(media.len(), 1, "{media:?}");
        assert!(media[0].is_there && media[0].track.is_film(), "{media:?}");
    }
    for id in recordings_of(&corpus) {
        let tracks = crate::db::stored_tracks::load_track_rows(corpus.store.read_connection(), id).expect("tracks");
        assert_eq!(tracks[0].duration_us, Some(1_000_000), "{tracks:?}");
    }
    assert_eq!(export(&corpus, "take"), text);
    assert!(export(&corpus, "bare").contains("in/deep/bare.mp4"));
    let again = take(&mut corpus, &folder, &ImportOptions::default());
    let changed = again.files.iter().any(|it| it.status != FileStatus::Unchanged);
    assert!(!changed, "{again:?}");
}

#[test]
fn a_film_imported_before_its_annotation_file_is_linked_to_it() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let path = film(&desk, "take.mp4");
    let options = ImportOptions::default();
    take(&mut corpus, &[path], &options);
    let take_name = RowName::Text("take".to_owned());
    let moved = crate::TrackChange::Offset(250_000);
    corpus.change_track(&take_name, "film 1", &moved).expect("moved");
    let text = naming("take.mp4");
    let file = desk.file("take.eaf", &text);
    take(&mut corpus, &[file], &options);
    assert_eq!(names(&corpus).len(), 1);
    let media = corpus.recording_media(&take_name).expect("media");
    assert_eq!(media.len(), 1, "{media:?}");
    assert!(media[0].is_there && media[0].track.offset_us == 250_000);
}

#[test]
fn a_film_far_from_the_corpus_is_found_where_it_was_imported_from() {
    let (desk, far) = (Desk::new(), Desk::new());
    let mut corpus = desk.corpus("c.chereme");
    let options = ImportOptions::default();
    let text = naming("take.mp4");
    let file = desk.file("other name.eaf", &text);
    take(&mut corpus, &[file], &options);
    let name = RowName::Text("other name".to_owned());
    assert!(!corpus.recording_media(&name).expect("media")[0].is_there);
    let path = film(&far, "films/take.mp4");
    let report = take(&mut corpus, std::slice::from_ref(&path), &options);
    assert_eq!(report.files[0].recording.as_deref(), Some("other name"));
    let media = corpus.recording_media(&name).expect("media");
    assert_eq!(media.len(), 1);
    assert!(media[0].is_there, "{media:?}");
    assert_eq!(export(&corpus, "other name"), text);
    // It was moved, and is imported from its new path.
    let new = film(&far, "elsewhere/take.mp4");
    fs::remove_file(&path).expect("removed");
    assert!(!corpus.recording_media(&name).expect("media")[0].is_there);
    take(&mut corpus, &[new], &options);
    assert!(corpus.recording_media(&name).expect("media")[0].is_there);
    assert_eq!(names(&corpus).len(), 1);
}

#[test]
fn a_film_is_added_to_a_recording_at_a_time_or_to_the_movement_of_its_name() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let movement = desk.file("take.bvh", MOVEMENT);
    let front = film(&desk, "take.mp4");
    let side = film(&desk, "side.mp4");
    // A film other than the frontal one.
    let mut bytes = fs::read(&side).expect("bytes");
    bytes.extend(*b"\x00\x00\x00\x08free");
    fs::write(&side, bytes).expect("written");
    take(&mut corpus, &[movement, front], &ImportOptions::default());
    let options = ImportOptions {
        into: Some(RowName::Text("take".to_owned())),
        offset_us: 480_000,
        ..ImportOptions::default()
    };
    take(&mut corpus, &[side], &options);
    let media = corpus
        .recording_media(&RowName::Text("take".to_owned()))
        .expect("media");
    let found: Vec<(&str, i64)> = media
        .iter()
        .map(|it| (it.track.name.as_str(), it.track.offset_us))
        .collect();
    assert_eq!(found, [("film 1", 0), ("film 2", 480_000)]);
    assert_eq!(names(&corpus), [("take".to_owned(), 1_480_000)]);
    corpus.undo_operation().expect("undone");
    corpus.undo_operation().expect("undone");
    assert!(names(&corpus).is_empty());
}

#[test]
fn files_that_are_no_film_or_damaged_are_refused() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let text = desk.file("text.mp4", "no film at all");
    let whole = fs::read(film(&desk, "whole.mp4")).expect("bytes");
    let cut = desk.folder.path().join("cut.mp4");
    fs::write(&cut, &whole[..60]).expect("written");
    let report = take(&mut corpus, &[text, cut], &ImportOptions::default());
    for file in &report.files {
        assert_eq!(file.status, FileStatus::Refused, "{file:?}");
        assert!(file.findings[0].remedy.is_some(), "{file:?}");
    }
    assert!(names(&corpus).is_empty());
}

#[test]
fn a_recording_with_a_film_alone_has_a_picture_of_any_moment() {
    let desk = Desk::new();
    let path = film(&desk, "films/take.mp4");
    let mut corpus = desk.corpus("c.chereme");
    take(&mut corpus, std::slice::from_ref(&path), &ImportOptions::default());
    let name = RowName::Number(1);
    let still = |corpus: &Corpus, seconds: f64| {
        let at = chereme_motion::RecordingInstant::from_seconds(seconds);
        corpus.film_still(&name, at, [32, 32]).expect("read")
    };
    for seconds in [-5.0, 0.0, 0.5, 900.0] {
        let picture = still(&corpus, seconds).expect("a picture");
        assert_eq!((picture.width, picture.height), (32, 24), "{seconds}");
        assert_eq!(picture.rgba.len(), 32 * 24 * 4);
    }
    fs::remove_file(&path).expect("removed");
    assert_eq!(still(&corpus, 0.5), None);
}
