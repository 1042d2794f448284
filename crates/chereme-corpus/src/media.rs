//! Media files of recordings, such as the film of a take: their paths, and new links.
//!
//! A corpus stores the path of a file and never the file itself.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::stored_recordings::{self, MediaTrackRow};
use crate::error::{CorpusError, CorpusResult};
use crate::paths::legible_path_text;
use crate::words::effect::OperationEffect;

/// A change of a recording's media.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MediaChange {
    /// Adds the file at a path or address.
    Add(String),
    /// Sets another path for the track of that row.
    Move(i64, String),
    /// Removes the track of that row.
    Remove(i64),
}

/// A media file and its path.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MediaPlace {
    /// The track.
    pub track: MediaTrackRow,
    /// Its path, or the first path that was tried; `None` for an address on the network.
    pub path: Option<PathBuf>,
    /// Whether the file exists.
    pub is_there: bool,
}

impl Corpus {
    /// Changes the media files of a recording, and returns its media tracks.
    ///
    /// # Errors
    /// Fails if the recording does not exist, a track is not one of its media tracks, or a path is blank.
    pub fn change_media(&mut self, recording: &RowName, change: &MediaChange) -> CorpusResult<Vec<MediaTrackRow>> {
        self.store.run_store_operation(|connection| {
            let row = address::find_recording_by_name(connection, recording)?;
            let before = stored_recordings::media_tracks(connection, row.id)?;
            let own_track = |id: i64| {
                let track = before.iter().find(|it| it.id == id);
                track.ok_or_else(|| {
                    CorpusError::from_wrong_message(format!("track {id} is no media file of {:?}", row.name))
                        .with_advice("look at the recording's media again")
                })
            };
            match change {
                MediaChange::Add(url) => {
                    let free = (1..).find(|n| {
                        let name = linked(*n);
                        before.iter().all(|track| track.name != name)
                    });
                    let new = MediaTrackRow {
                        id: 0,
                        recording_id: row.id,
                        name: linked(free.unwrap_or_default()),
                        offset_us: 0,
                        media_type: media_type(url).map(str::to_owned),
                        url: require_media_url(url)?,
                        imported: Vec::new(),
                    };
                    stored_recordings::insert_media_track(connection, &new)?;
                }
                MediaChange::Move(id, url) => {
                    own_track(*id)?;
                    stored_recordings::move_media_track(connection, *id, &require_media_url(url)?)?;
                }
                MediaChange::Remove(id) => {
                    own_track(*id)?;
                    stored_recordings::remove_media_track(connection, *id)?;
                }
            }
            let after = stored_recordings::media_tracks(connection, row.id)?;
            let recording = row.name.clone();
            Ok((after, OperationEffect::ChangeMedia { recording }))
        })
    }

    /// Returns the media files of a recording, and whether they were found: at their path, at the place of import, or
    /// by name in the corpus's folder and below.
    ///
    /// # Errors
    /// Fails if the recording does not exist, or the database fails.
    pub fn recording_media(&self, recording: &RowName) -> CorpusResult<Vec<MediaPlace>> {
        let connection = self.store.read_connection();
        let row = address::find_recording_by_name(connection, recording)?;
        let tracks = stored_recordings::media_tracks(connection, row.id)?.into_iter();
        Ok(tracks.map(|track| find_media(track, self.corpus_file_path())).collect())
    }
}

impl MediaTrackRow {
    /// Returns whether it is a film, by its media type or its name.
    #[must_use]
    pub fn is_film(&self) -> bool {
        let stated_type = self.media_type.as_deref().filter(|text| text.contains('/'));
        // A stated type without a stroke is no media type, so the name decides.
        let kind = stated_type.or_else(|| media_type(&self.url));
        kind.is_some_and(|kind| kind.starts_with("video"))
    }
}

/// Looks for the file of a media track of the corpus at `corpus`: at its path, at the place from which it was imported,
/// then by its name in the corpus's folder and below. A file of the same name with the ending of MP4 is accepted too,
/// since users convert films that no player here can decode.
#[must_use]
pub fn find_media(track: MediaTrackRow, corpus: &Path) -> MediaPlace {
    let folder = corpus.parent().unwrap_or(Path::new(""));
    let candidates = candidate_media_paths(&track.url, folder);
    let nearby_path = candidates.iter().find(|path| path.is_file()).cloned();
    let there = nearby_path.or_else(|| {
        // An import has seen the file at this place, which annotation files rarely contain.
        let imported_paths = track.imported.iter();
        let imported = imported_paths.filter(|path| is_same_film(&track, &file_name(path)));
        imported.map(|path| folder.join(path)).find(|path| path.is_file())
    });
    let there = there.or_else(|| {
        let name = candidates.last()?.file_name()?.to_string_lossy().into_owned();
        let is_same_name = |entry: &Path| entry.file_name().is_some_and(|text| legible_path_text(text) == name);
        let stem = Path::new(&name).file_stem()?.to_owned();
        let converted = |entry: &Path| {
            let kind = entry.extension().unwrap_or_default().to_string_lossy();
            let film = matches!(kind.to_lowercase().as_str(), "mp4" | "m4v" | "mov");
            film && track.is_film() && entry.file_stem() == Some(&stem)
        };
        let near = files_near(folder);
        let exact_match = near.iter().find(|path| is_same_name(path));
        exact_match
            .or_else(|| near.iter().find(|path| converted(path)))
            .cloned()
    });
    MediaPlace {
        track,
        is_there: there.is_some(),
        path: there.or_else(|| candidates.into_iter().next()),
    }
}

/// The largest number of folder entries that are searched for a missing file, and the depth of folders.
const MOST_ENTRIES: usize = 5000;
const MAX_MEDIA_FOLDER_DEPTH: usize = 3;

/// Returns files in a folder and the folders below, nearest first.
fn files_near(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    let mut seen = 0;
    for _ in 0..MAX_MEDIA_FOLDER_DEPTH {
        let mut deeper = Vec::new();
        for folder in folders {
            let dir_entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
            let mut entries: Vec<PathBuf> = dir_entries
                // A corpus may lie in a home folder with very many files, which must not be searched whole.
                .take(MOST_ENTRIES - seen)
                .map(|entry| entry.path())
                .collect();
            // The system lists files in any order, and the same file should be found each time.
            entries.sort();
            seen += entries.len();
            // Nearer files come first, so that a copy deep in the folders does not win.
            let (inner, outer): (Vec<PathBuf>, Vec<PathBuf>) = entries.into_iter().partition(|path| path.is_dir());
            deeper.extend(inner);
            files.extend(outer);
        }
        folders = deeper;
    }
    files
}

/// Returns the track name of a file that a person linked; it differs from those of files that transcripts name.
fn linked(number: u32) -> String {
    format!("linked {number}")
}

fn require_media_url(url: &str) -> CorpusResult<String> {
    match url.trim() {
        "" => Err(CorpusError::from_wrong_message("a media file needs a place").with_advice("give its path")),
        url => Ok(url.to_owned()),
    }
}

/// Returns the possible paths for a URL or path, most likely first.
pub(crate) fn candidate_media_paths(url: &str, folder: &Path) -> Vec<PathBuf> {
    let local = match url.split_once("://") {
        Some((scheme, rest)) if scheme.eq_ignore_ascii_case("file") => {
            // The host between the slashes is this computer.
            decode_url_path(&rest[rest.find('/').unwrap_or(0)..])
        }
        Some(_) => return Vec::new(),
        None => match url.strip_prefix("file:") {
            Some(rest) => decode_url_path(rest.strip_prefix('/').unwrap_or(rest)),
            None => url.to_owned(),
        },
    };
    let path = Path::new(&local);
    let mut all = vec![folder.join(path)];
    // Paths of other systems end in a file name too.
    let name = local.rsplit(['/', '\\']).next().unwrap_or_default();
    if !name.is_empty() {
        all.push(folder.join(name));
    }
    all
}

/// Returns a URL's path with escapes such as `%20` decoded.
fn decode_url_path(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut out = Vec::with_capacity(bytes.len());
    let mut index = 0;
    while let Some(byte) = bytes.get(index) {
        let hex = bytes.get(index + 1..index + 3).filter(|_| *byte == b'%');
        let value = hex
            .and_then(|digits| std::str::from_utf8(digits).ok())
            .and_then(|digits| u8::from_str_radix(digits, 16).ok());
        // A percent sign that begins no escape is part of the name.
        out.push(value.unwrap_or(*byte));
        index += if value.is_some() { 3 } else { 1 };
    }
    String::from_utf8_lossy(&out).into_owned()
}

/// Returns whether a path or URL has the ending of a film.
#[must_use]
pub fn is_film(url: &str) -> bool {
    media_type(url).is_some_and(|kind| kind.starts_with("video"))
}

/// Returns the file name at the end of a path or URL of any system.
pub(crate) fn file_name(url: &str) -> String {
    decode_url_path(url.rsplit(['/', '\\']).next().unwrap_or(url))
}

/// Returns whether a file of that name may hold the film of a track; a converted film differs only in its ending.
pub(crate) fn is_same_film(track: &MediaTrackRow, name: &str) -> bool {
    let film_name = file_name(&track.url);
    let stem = |name: &str| {
        let stem = Path::new(name).file_stem();
        stem.map(|text| text.to_ascii_lowercase())
    };
    film_name.eq_ignore_ascii_case(name) || (track.is_film() && stem(&film_name) == stem(name))
}

/// Returns the media type for the extension of a file's name.
pub(crate) fn media_type(url: &str) -> Option<&'static str> {
    let end = url.rsplit('.').next()?.to_ascii_lowercase();
    Some(match end.as_str() {
        "mp4" | "m4v" => "video/mp4",
        "mov" => "video/quicktime",
        "mpg" | "mpeg" => "video/mpeg",
        "webm" => "video/webm",
        "avi" => "video/x-msvideo",
        "mkv" => "video/x-matroska",
        "wav" => "audio/x-wav",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::address::CorpusAddress;

    #[test]
    fn places_are_read_as_elan_writes_them() {
        let folder = Path::new("/corpus");
        let first = |url: &str| candidate_media_paths(url, folder).first().cloned();
        for (url, path) in [
            ("./film.mp4", "/corpus/./film.mp4"),
            ("file:///films/a%20b/film.mp4", "/films/a b/film.mp4"),
            ("file://machine/film.mp4", "/film.mp4"),
            ("file:/./film.wav", "/corpus/./film.wav"),
            ("/films/1.mp4", "/films/1.mp4"),
            ("100%.mp4", "/corpus/100%.mp4"),
        ] {
            assert_eq!(first(url), Some(PathBuf::from(path)), "{url}");
        }
        assert_eq!(first("https://example.org/film.mp4"), None);
        let last = candidate_media_paths("file:///D:/Data\\film.mpg", folder).pop();
        assert_eq!(last, Some(PathBuf::from("/corpus/film.mpg")));
    }

    #[test]
    fn a_missing_film_is_found_by_its_name_in_folders_near_the_corpus() {
        let folder = tempfile::tempdir().expect("a folder");
        let corpus = folder.path().join("c.chereme");
        let deep = folder.path().join("films/2019");
        std::fs::create_dir_all(&deep).expect("made");
        let row = |url: &str| MediaTrackRow {
            id: 1,
            recording_id: 1,
            name: "film".to_owned(),
            offset_us: 0,
            media_type: None,
            url: url.to_owned(),
            imported: Vec::new(),
        };
        let looked = |url: &str| find_media(row(url), &corpus);
        assert!(!looked("file:///D:/gone/take.mpg").is_there);
        let converted = deep.join("take.mp4");
        std::fs::write(&converted, "").expect("written");
        let found = looked("file:///D:/gone/take.mpg");
        assert!(found.is_there);
        assert_eq!(found.path, Some(converted));
        let own = folder.path().join("films/take.mpg");
        std::fs::write(&own, "").expect("written");
        assert_eq!(looked("file:///D:/gone/take.mpg").path, Some(own));
        assert!(!looked("take.wav").is_there, "sound is no film");
        assert!(row("a.MP4").is_film() && !row("a.wav").is_film());
    }

    #[test]
    fn a_film_is_relinked_and_found_and_undo_restores_the_old_link() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
        let eaf = folder.path().join("take.eaf");
        let text = r#"<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="" DATE="2020-01-01T00:00:00+00:00" FORMAT="3.0" VERSION="3.0">
<HEADER MEDIA_FILE="" TIME_UNITS="milliseconds"><MEDIA_DESCRIPTOR MEDIA_URL="file:///gone/film.mp4" MIME_TYPE="video/mp4"/></HEADER>
<TIME_ORDER/><TIER LINGUISTIC_TYPE_REF="t" TIER_ID="Gloss"/><LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="t" TIME_ALIGNABLE="true"/>
</ANNOTATION_DOCUMENT>"#;
        std::fs::write(&eaf, text).expect("written");
        let options = crate::ImportOptions::default();
        let mut heard = crate::ignore_progress_step;
        let mut progress = crate::ProgressReceiver::new(&mut heard);
        corpus.import_paths(&[eaf], &options, &mut progress).expect("imported");
        let take = RowName::Text("take".to_owned());
        let found = corpus.recording_media(&take).expect("read");
        assert_eq!(found[0].path, Some(PathBuf::from("/gone/film.mp4")));
        assert!(!found[0].is_there);
        std::fs::write(folder.path().join("film.mp4"), "").expect("written");
        assert!(corpus.recording_media(&take).expect("read")[0].is_there);
        let id = found[0].track.id;
        let moved = MediaChange::Move(id, "other.mp4".to_owned());
        let after = corpus.change_media(&take, &moved).expect("moved");
        assert_eq!(after[0].url, "other.mp4");
        let mut exported = |corpus: &Corpus, to: &str| {
            let path = folder.path().join(to);
            let what = crate::ExportWhat::Address(CorpusAddress::Recording(take.clone()));
            let options = crate::ExportOptions {
                force: true,
                ..Default::default()
            };
            corpus
                .export_corpus(&what, &path, &options, &mut progress)
                .expect("exported");
            std::fs::read_to_string(path).expect("an EAF file")
        };
        let text = exported(&corpus, "1.eaf");
        assert!(text.contains("other.mp4") && !text.contains("gone"), "{text}");
        corpus.undo_operation().expect("undone");
        assert_eq!(
            corpus.recording_media(&take).expect("read")[0].track.url,
            "file:///gone/film.mp4"
        );
        let added = corpus.change_media(&take, &MediaChange::Add("b.mov".to_owned()));
        assert_eq!(added.expect("added").len(), 2);
        let left = corpus.change_media(&take, &MediaChange::Remove(id));
        let left = left.expect("removed");
        assert_eq!(left[0].name, "linked 1");
        corpus
            .change_media(&take, &MediaChange::Remove(left[0].id))
            .expect("removed");
        let text = exported(&corpus, "2.eaf");
        assert!(!text.contains("MEDIA_DESCRIPTOR"), "what is unlinked is not written");
        assert!(corpus.change_media(&take, &MediaChange::Remove(id)).is_err());
    }
}
