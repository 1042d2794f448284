//! The files of the search index, held in memory so that they can be written together with the rows.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, RwLock, RwLockReadGuard, RwLockWriteGuard};

use tantivy::Directory;
use tantivy::directory::error::{DeleteError, LockError, OpenReadError, OpenWriteError};
use tantivy::directory::{
    AntiCallToken, DirectoryLock, FileHandle, FileSlice, Lock, OwnedBytes, TerminatingWrite, WatchCallback,
    WatchHandle, WritePtr,
};

/// An in-memory folder of files that records its changes since it was last saved.
#[derive(Clone, Default)]
pub(super) struct MemoryFolder(Arc<RwLock<MemoryFiles>>);

#[derive(Default)]
struct MemoryFiles {
    data: BTreeMap<PathBuf, OwnedBytes>,
    written: BTreeSet<PathBuf>,
    deleted: BTreeSet<PathBuf>,
}

/// The changes of a [`MemoryFolder`]: files to write, and names to delete.
pub(super) struct FolderChanges {
    pub(super) written: Vec<(String, OwnedBytes)>,
    pub(super) deleted: Vec<String>,
}

impl MemoryFolder {
    /// Adds a file that has already been saved.
    pub(super) fn add_saved_file(&mut self, name: String, data: OwnedBytes) {
        self.write_memory_files().data.insert(PathBuf::from(name), data);
    }

    /// Returns a file whose content can never change, if it is in memory; files that describe others are rewritten
    /// under the same name and are not returned.
    pub(super) fn unchanging_file(&self, name: &str) -> Option<OwnedBytes> {
        if name.ends_with(".json") {
            return None;
        }
        self.read_memory_files().data.get(Path::new(name)).cloned()
    }

    /// Returns what has changed since the last call.
    pub(super) fn take_changes(&self) -> FolderChanges {
        let mut files = self.write_memory_files();
        let written = std::mem::take(&mut files.written);
        let deleted = std::mem::take(&mut files.deleted);
        let name = |path: &PathBuf| path.to_string_lossy().into_owned();
        FolderChanges {
            written: written
                .iter()
                .filter_map(|path| files.data.get(path).map(|bytes| (name(path), bytes.clone())))
                .collect(),
            // A file that was deleted and written again is saved by the other list.
            deleted: deleted
                .iter()
                .filter(|path| !files.data.contains_key(*path))
                .map(name)
                .collect(),
        }
    }

    fn read_memory_files(&self) -> RwLockReadGuard<'_, MemoryFiles> {
        // The files are whole even if a thread panicked while it held the lock.
        self.0.read().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    fn write_memory_files(&self) -> RwLockWriteGuard<'_, MemoryFiles> {
        self.0.write().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    fn put_memory_file(&self, path: &Path, bytes: Vec<u8>) {
        let mut files = self.write_memory_files();
        files.data.insert(path.to_owned(), OwnedBytes::new(bytes));
        files.written.insert(path.to_owned());
        files.deleted.remove(path);
    }
}

impl std::fmt::Debug for MemoryFolder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("MemoryFolder")
    }
}

impl Directory for MemoryFolder {
    fn get_file_handle(&self, path: &Path) -> Result<Arc<dyn FileHandle>, OpenReadError> {
        let stored_bytes = self.read_memory_files().data.get(path).cloned();
        let bytes = stored_bytes.ok_or_else(|| OpenReadError::FileDoesNotExist(path.to_owned()))?;
        Ok(Arc::new(FileSlice::new(Arc::new(bytes))))
    }

    fn delete(&self, path: &Path) -> Result<(), DeleteError> {
        let mut files = self.write_memory_files();
        files.written.remove(path);
        files.deleted.insert(path.to_owned());
        match files.data.remove(path) {
            Some(_) => Ok(()),
            None => Err(DeleteError::FileDoesNotExist(path.to_owned())),
        }
    }

    fn exists(&self, path: &Path) -> Result<bool, OpenReadError> {
        Ok(self.read_memory_files().data.contains_key(path))
    }

    fn open_write(&self, path: &Path) -> Result<WritePtr, OpenWriteError> {
        if self.read_memory_files().data.contains_key(path) {
            return Err(OpenWriteError::FileAlreadyExists(path.to_owned()));
        }
        let file = NewFile {
            folder: self.clone(),
            path: path.to_owned(),
            bytes: Vec::new(),
        };
        Ok(io::BufWriter::new(Box::new(file)))
    }

    fn atomic_read(&self, path: &Path) -> Result<Vec<u8>, OpenReadError> {
        let files = self.read_memory_files();
        let bytes = files.data.get(path);
        bytes
            .map(|bytes| bytes.to_vec())
            .ok_or_else(|| OpenReadError::FileDoesNotExist(path.to_owned()))
    }

    fn atomic_write(&self, path: &Path, data: &[u8]) -> io::Result<()> {
        self.put_memory_file(path, data.to_vec());
        Ok(())
    }

    fn sync_directory(&self) -> io::Result<()> {
        Ok(())
    }

    /// The database's own write lock keeps other writers out; none is needed here.
    fn acquire_lock(&self, _: &Lock) -> Result<DirectoryLock, LockError> {
        Ok(DirectoryLock::from(Box::new(())))
    }

    fn watch(&self, _: WatchCallback) -> tantivy::Result<WatchHandle> {
        Ok(WatchHandle::empty())
    }
}

struct NewFile {
    folder: MemoryFolder,
    path: PathBuf,
    bytes: Vec<u8>,
}

impl Write for NewFile {
    fn write(&mut self, data: &[u8]) -> io::Result<usize> {
        self.bytes.extend_from_slice(data);
        Ok(data.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl TerminatingWrite for NewFile {
    fn terminate_ref(&mut self, _: AntiCallToken) -> io::Result<()> {
        self.folder.put_memory_file(&self.path, std::mem::take(&mut self.bytes));
        Ok(())
    }
}
