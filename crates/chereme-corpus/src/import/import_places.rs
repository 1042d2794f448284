//! Identifies a file among those of the corpus: an imported file, a new version of one, or another of the same name.
//!
//! A file is identified by its path. Files in one folder whose names differ only in the ending (and in capital letters)
//! belong to one take. A file elsewhere is another file, unless an earlier import read the same bytes, or its content
//! shows that it was moved.

use std::collections::BTreeMap;
use std::path::Path;

use rusqlite::Connection;

use super::ImportJob;
use super::readers;
use crate::db::stored_recordings::{self, SourceFileRow};
use crate::error::CorpusResult;
use crate::report_finding::ReportFinding;

/// A recording that has a file of a certain name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct NamedRecording {
    pub(super) id: i64,
    /// The number of equal folder names, from the files upwards.
    pub(super) shared_folders: usize,
}

/// The files that were imported into the corpus; those of the running import are added as they are read.
#[derive(Default)]
pub(super) struct ImportedFilePlaces {
    rows: Vec<SourceFileRow>,
    /// The last row written by an earlier import.
    earlier: i64,
    by_stem: BTreeMap<String, Vec<usize>>,
    by_hash: BTreeMap<String, Vec<usize>>,
}

impl ImportedFilePlaces {
    pub(super) fn load_file_places(connection: &Connection) -> CorpusResult<Self> {
        let mut places = Self::default();
        for row in stored_recordings::all_source_files(connection)? {
            places.add_file_place(row);
        }
        places.earlier = places.rows.last().map_or(0, |row| row.id);
        Ok(places)
    }

    pub(super) fn add_file_place(&mut self, row: SourceFileRow) {
        let index = self.rows.len();
        self.by_stem.entry(stem(&row.name)).or_default().push(index);
        self.by_hash.entry(row.hash.clone()).or_default().push(index);
        self.rows.push(row);
    }

    /// Returns the number of known files, for [`forget_later_files`](Self::forget_later_files).
    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Forgets all files but the first ones, after a refused file.
    pub(super) fn forget_later_files(&mut self, first: usize) {
        for row in self.rows.drain(first..) {
            for (list, key) in [(&mut self.by_stem, stem(&row.name)), (&mut self.by_hash, row.hash)] {
                list.entry(key).or_default().retain(|&at| at < first);
            }
        }
    }

    /// Returns the files of this name, ignoring ending and case, newest first.
    pub(super) fn files_of_same_name(&self, name: &str) -> impl Iterator<Item = &SourceFileRow> {
        let indices = self.by_stem.get(&stem(name)).into_iter().flatten();
        indices.rev().map(|&at| &self.rows[at])
    }

    /// Returns the files with these bytes, newest first.
    pub(super) fn files_with_hash(&self, hash: &str) -> impl Iterator<Item = &SourceFileRow> {
        let indices = self.by_hash.get(hash).into_iter().flatten();
        indices.rev().map(|&at| &self.rows[at])
    }

    /// Returns the newest file of a kind at this path.
    pub(super) fn find_file_at(&self, place: &str, kind: &str) -> Option<&SourceFileRow> {
        self.files_of_same_name(file_name_of_place(place))
            .find(|row| row.kind == kind && row.path.as_deref() == Some(place))
    }

    /// Reports whether an earlier import read a file; two files of one import are never the same.
    pub(super) fn is_earlier(&self, row: &SourceFileRow) -> bool {
        row.id <= self.earlier
    }

    /// Returns the recording of files in the same folder whose names differ only in the ending.
    pub(super) fn recording_beside_file(&self, place: &str) -> Option<i64> {
        let own_stem = Path::new(place).file_stem();
        let near = || {
            self.files_of_same_name(file_name_of_place(place)).filter_map(|row| {
                let path = row
                    .path
                    .as_deref()
                    .filter(|path| folder_of_place(path) == folder_of_place(place))?;
                Some((Path::new(path).file_stem() == own_stem, row.recording_id?))
            })
        };
        if let Some((_, exact)) = near().find(|(exact, _)| *exact) {
            return Some(exact);
        }
        // On systems that distinguish `take` from `TAKE`, the names of two takes may differ only in case.
        let first = near().next()?.1;
        near().all(|(_, id)| id == first).then_some(first)
    }

    /// Returns the recording of the newest motion file in the same folder.
    pub(super) fn movement_beside(&self, place: &str) -> Option<i64> {
        let is = |row: &&SourceFileRow| {
            let near = row
                .path
                .as_deref()
                .is_some_and(|path| folder_of_place(path) == folder_of_place(place));
            near && readers::is_movement(&row.kind)
        };
        self.rows.iter().rev().find(is)?.recording_id
    }

    /// Returns the recordings of files in the same folder, in the order of their files.
    pub(super) fn in_folder(&self, place: &str) -> Vec<i64> {
        let near = |row: &&SourceFileRow| {
            let path = row.path.as_deref();
            path.is_some_and(|path| folder_of_place(path) == folder_of_place(place))
        };
        let mut recording_ids: Vec<i64> = Vec::new();
        for id in self.rows.iter().filter(near).filter_map(|row| row.recording_id) {
            if !recording_ids.contains(&id) {
                recording_ids.push(id);
            }
        }
        recording_ids
    }

    /// Returns the recordings of files in neighbouring folders: this one, the one above, and those below either of
    /// them.
    pub(super) fn recordings_near_file(&self, place: &str) -> Vec<i64> {
        let above = |path: &str| {
            folder_of_place(path)
                .rsplit_once('/')
                .map_or("", |(above, _)| above)
                .to_owned()
        };
        let (own, upper) = (folder_of_place(place), above(place));
        let near = |row: &&SourceFileRow| {
            row.path.as_deref().is_some_and(|path| {
                let folder = folder_of_place(path);
                folder == own || folder == upper || above(path) == own || above(path) == upper
            })
        };
        let mut recording_ids: Vec<i64> = self
            .rows
            .iter()
            .filter(near)
            .filter_map(|row| row.recording_id)
            .collect();
        recording_ids.sort_unstable();
        recording_ids.dedup();
        recording_ids
    }

    /// Returns the recordings of files of this name elsewhere; those with the most folder names in common come first.
    pub(super) fn recordings_named(&self, place: &str) -> Vec<NamedRecording> {
        let mut ranked_recordings: Vec<NamedRecording> = Vec::new();
        for row in self.files_of_same_name(file_name_of_place(place)) {
            let Some(id) = row.recording_id else { continue };
            let shared_folders = row.path.as_deref().map_or(0, |path| count_shared_folders(path, place));
            match ranked_recordings.iter_mut().find(|ranked| ranked.id == id) {
                Some(ranked) => ranked.shared_folders = ranked.shared_folders.max(shared_folders),
                None => ranked_recordings.push(NamedRecording { id, shared_folders }),
            }
        }
        ranked_recordings.sort_by_key(|ranked| (std::cmp::Reverse(ranked.shared_folders), ranked.id));
        ranked_recordings
    }

    /// Returns the path of the newest file of a recording other than the one at `place`.
    pub(super) fn newest_file_path(&self, id: i64, place: &str) -> Option<&str> {
        let own_rows = self.rows.iter().rev().filter(|row| row.recording_id == Some(id));
        own_rows
            .filter_map(|row| row.path.as_deref())
            .find(|path| *path != place)
    }

    /// Returns whether a recording has a file of a kind.
    pub(super) fn has_file_of_kind(&self, id: i64, kind: &str) -> bool {
        self.rows
            .iter()
            .any(|row| row.recording_id == Some(id) && row.kind == kind)
    }
}

impl ImportJob<'_> {
    /// Returns the recordings of this name, by their own name or that of a file elsewhere, the nearest first.
    pub(super) fn recordings_of_same_name(&self) -> CorpusResult<Vec<NamedRecording>> {
        let mut candidates = self.places.recordings_named(&self.place);
        let named = stored_recordings::recording_named(self.connection, &self.stem)?.map(|row| row.id);
        let unlisted = named.filter(|id| candidates.iter().all(|candidate| candidate.id != *id));
        candidates.extend(unlisted.map(|id| NamedRecording { id, shared_folders: 0 }));
        Ok(candidates)
    }

    /// Returns the name for a new recording: that of the file, or if another recording has that, a name of its own with
    /// a note about it.
    pub(super) fn own_name(&self) -> CorpusResult<(String, Option<ReportFinding>)> {
        let Some(other) = stored_recordings::recording_named(self.connection, &self.stem)? else {
            return Ok((self.stem.clone(), None));
        };
        let elsewhere = self.places.newest_file_path(other.id, &self.place);
        let apart = elsewhere.and_then(|path| distinguishing_folder(&self.place, path));
        let base_name = match apart {
            Some(folder) => format!("{} ({folder})", self.stem),
            None => self.stem.clone(),
        };
        let name = stored_recordings::free_recording_name(self.connection, &base_name)?;
        let from = elsewhere.map_or(String::new(), |path| format!(", which came from {path},"));
        let note = ReportFinding::finding_note(format!(
            "the recording {:?}{from} has this file's name already: this one is called {name:?}",
            other.name
        ));
        Ok((name, Some(note)))
    }
}

/// Returns the folder that distinguishes `new` from `old`: the nearest one that differs.
fn distinguishing_folder<'p>(new: &'p str, old: &str) -> Option<&'p str> {
    let mut old = folder_of_place(old).rsplit('/');
    let differs = folder_of_place(new).rsplit('/').find(|own| old.next() != Some(own));
    differs.filter(|folder| !folder.is_empty() && *folder != "..")
}

/// Returns the number of equal folder names, from the files upwards.
fn count_shared_folders(a: &str, b: &str) -> usize {
    let pairs = folder_of_place(a).rsplit('/').zip(folder_of_place(b).rsplit('/'));
    pairs.take_while(|(a, b)| a == b && !a.is_empty()).count()
}

fn folder_of_place(place: &str) -> &str {
    place.rsplit_once('/').map_or("", |(folder, _)| folder)
}

fn file_name_of_place(place: &str) -> &str {
    place.rsplit_once('/').map_or(place, |(_, name)| name)
}

fn stem(name: &str) -> String {
    let stem = Path::new(name).file_stem().unwrap_or_default();
    stem.to_string_lossy().to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(all: &[(&str, i64)]) -> ImportedFilePlaces {
        let mut places = ImportedFilePlaces::default();
        for (id, (path, recording)) in all.iter().enumerate() {
            places.add_file_place(SourceFileRow {
                id: id as i64,
                recording_id: Some(*recording),
                kind: "bvh".to_owned(),
                name: file_name_of_place(path).to_owned(),
                path: Some((*path).to_owned()),
                hash: String::new(),
            });
        }
        places
    }

    #[test]
    fn files_of_a_take_are_grouped_regardless_of_letter_case() {
        let known = places(&[("A/Take2.BVH", 1), ("B/take2.bvh", 2), ("B/TAKE2.bvh", 3)]);
        for (place, found) in [
            ("A/TAKE2.EAF", Some(1)),
            ("B/TAKE2.eaf", Some(3)),
            ("B/take2.EAF", Some(2)),
            ("B/Take2.eaf", None),
            ("C/take2.eaf", None),
            ("A/take.eaf", None),
        ] {
            assert_eq!(known.recording_beside_file(place), found, "{place}");
        }
        let named = known.recordings_named("eaf/B/take2.eaf");
        let ids: Vec<i64> = named.iter().map(|candidate| candidate.id).collect();
        assert_eq!(ids, [2, 3, 1]);
    }

    #[test]
    fn files_are_distinguished_by_the_nearest_differing_folder() {
        for (new, old, differs) in [
            ("B/x.eaf", "A/x.eaf", Some("B")),
            ("B/rec/x.eaf", "A/rec/x.eaf", Some("B")),
            ("A/x.eaf", "x.eaf", Some("A")),
            ("x.eaf", "A/x.eaf", None),
            ("A/x.eaf", "A/x.eaf", None),
            ("../x.eaf", "x.eaf", None),
        ] {
            assert_eq!(distinguishing_folder(new, old), differs, "{new} {old}");
        }
    }

    #[test]
    fn a_refused_file_is_forgotten() {
        let mut known = places(&[("A/x.bvh", 1)]);
        known.add_file_place(SourceFileRow {
            id: 9,
            recording_id: Some(2),
            kind: "bvh".to_owned(),
            name: "x.bvh".to_owned(),
            path: Some("B/x.bvh".to_owned()),
            hash: "h".to_owned(),
        });
        known.forget_later_files(1);
        assert_eq!(known.recording_beside_file("B/x.eaf"), None);
        assert_eq!((known.files_with_hash("h").count(), known.len()), (0, 1));
    }
}
