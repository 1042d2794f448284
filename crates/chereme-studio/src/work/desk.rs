//! The threads of an open corpus: one for each lane of work, and one that reads snapshots.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SendError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use chereme_corpus::{Corpus, CorpusError, FileIdentity, ProgressReceiver, ProgressStep};

use super::{CorpusJob, JobAbout, WorkId, WorkLane, WorkProgress, WorkResult};
use crate::model::{CorpusSnapshot, OpenedRecording};

/// Interval between checks for changes by other programs.
const CHANGE_CHECK_INTERVAL: Duration = Duration::from_millis(300);
/// How many operations the history shows.
const MAX_SHOWN_OPERATIONS: usize = 2000;

/// Wakes the window; called from any thread.
pub(crate) type WindowWaker = Arc<dyn Fn() + Send + Sync>;

/// The threads' messages to the window.
#[derive(Debug)]
pub(crate) enum DeskNews {
    /// A new snapshot, and whether this window's own work changed the corpus.
    Read(CorpusSnapshot, bool),
    /// The corpus could not be read.
    Unread(CorpusError),
    /// Whether the corpus file is in its place; sent when that changes.
    Stands(bool),
    /// The path of the saved copy, or the error.
    Copied(Result<PathBuf, CorpusError>),
    /// The progress of a piece of work.
    Far(WorkId, WorkProgress),
    /// The result of a piece of work; that of an edit comes after the snapshot that shows it.
    Ended(WorkId, WorkResult, JobAbout),
}

/// Work that has been started and has not ended.
#[derive(Debug)]
pub(crate) struct RunningWork {
    pub(crate) about: JobAbout,
    pub(crate) far: WorkProgress,
    stop: Arc<AtomicBool>,
}

struct WorkOrder {
    id: WorkId,
    job: CorpusJob,
    stop: Arc<AtomicBool>,
}

enum SnapshotRequest {
    /// Read again after work of this window, and pass on its end once the snapshot shows its result.
    After(Box<DeskNews>),
    /// Include the tiers of this recording in the snapshots.
    Recording(Option<i64>),
    /// Save a copy there.
    Copy(PathBuf),
}

/// An open corpus with its threads; dropping it waits until the user's edits are stored.
pub(crate) struct CorpusDesk {
    pub(crate) path: PathBuf,
    lanes: BTreeMap<WorkLane, Sender<WorkOrder>>,
    reader: Option<Sender<SnapshotRequest>>,
    news: Receiver<DeskNews>,
    pub(crate) running: BTreeMap<WorkId, RunningWork>,
    threads: Vec<JoinHandle<()>>,
}

impl CorpusDesk {
    /// Opens the corpus at `path` on every thread; failures arrive as news.
    pub(crate) fn open_corpus_desk(path: &Path, author: &str, wake: &WindowWaker) -> Self {
        let (sender, news) = channel();
        let station = WorkStation {
            path: path.to_owned(),
            author: author.to_owned(),
            sender,
            wake: wake.clone(),
            place: FileIdentity::from_file_path(path),
            edits: Arc::default(),
        };
        let (reader, wishes) = channel();
        let mut threads = Vec::new();
        let mut lanes = BTreeMap::new();
        for lane in WorkLane::ALL_WORK_LANES {
            let (give, orders) = channel();
            let (station, reader) = (station.clone(), reader.clone());
            // Each lane has a thread and a connection of its own, so that no work waits for another lane's.
            threads.push(std::thread::spawn(move || {
                station.work_on_orders(&orders, lane, &reader)
            }));
            lanes.insert(lane, give);
        }
        threads.push(std::thread::spawn(move || station.read_snapshot_requests(&wishes)));
        Self {
            path: path.to_owned(),
            lanes,
            reader: Some(reader),
            news,
            running: BTreeMap::new(),
            threads,
        }
    }

    /// Starts a job on its lane.
    pub(crate) fn give_desk_job(&mut self, id: WorkId, job: CorpusJob) {
        let about = job.about;
        let stop = Arc::new(AtomicBool::new(false));
        let running = RunningWork {
            about,
            far: WorkProgress::default(),
            stop: stop.clone(),
        };
        let order = WorkOrder { id, job, stop };
        let lane = self.lanes.get(&about.lane);
        // A lane whose thread ended takes no work; it has reported why.
        if lane.is_some_and(|lane| lane.send(order).is_ok()) {
            self.running.insert(id, running);
        }
    }

    /// Stops a piece of work, whether it has begun or not.
    pub(crate) fn stop_desk_work(&self, id: WorkId) {
        if let Some(running) = self.running.get(&id) {
            running.stop.store(true, Ordering::Relaxed);
        }
    }

    /// Makes the snapshots include the tiers of that recording.
    pub(crate) fn watch_recording_tiers(&self, recording: Option<i64>) {
        if let Some(reader) = &self.reader {
            // A reader thread that has ended has reported the reason.
            let _ = reader.send(SnapshotRequest::Recording(recording));
        }
    }

    /// Saves a copy of the corpus, even if its file is missing.
    pub(crate) fn save_copy(&self, to: PathBuf) {
        if let Some(reader) = &self.reader {
            // A reader thread that has ended has reported the reason.
            let _ = reader.send(SnapshotRequest::Copy(to));
        }
    }

    /// Returns the messages since the last call.
    pub(crate) fn take_desk_news(&mut self) -> Vec<DeskNews> {
        let mut all = Vec::new();
        while let Ok(news) = self.news.try_recv() {
            match &news {
                DeskNews::Far(id, far) => {
                    if let Some(running) = self.running.get_mut(id) {
                        running.far = far.clone();
                    }
                }
                DeskNews::Ended(id, ..) => {
                    self.running.remove(id);
                }
                _ => {}
            }
            all.push(news);
        }
        all
    }
}

impl Drop for CorpusDesk {
    fn drop(&mut self) {
        let stoppable = |running: &&RunningWork| running.about.may_stop;
        // Edits are awaited, since the user takes them for stored; everything else is stopped.
        for running in self.running.values().filter(stoppable) {
            running.stop.store(true, Ordering::Relaxed);
        }
        // Threads end when nothing can be sent to them any more.
        self.lanes.clear();
        self.reader = None;
        for thread in self.threads.drain(..) {
            // A thread that panicked has nothing left to store.
            let _ = thread.join();
        }
    }
}

/// The shared data of the threads.
#[derive(Clone)]
struct WorkStation {
    path: PathBuf,
    author: String,
    sender: Sender<DeskNews>,
    wake: WindowWaker,
    /// The identity of the corpus file when it was opened.
    place: FileIdentity,
    /// How often work of this window began or ended to change the corpus; odd while such work runs.
    edits: Arc<AtomicU64>,
}

impl WorkStation {
    fn send_station_news(&self, news: DeskNews) {
        // The window does not listen any more when it is closing.
        let _ = self.sender.send(news);
        (self.wake)();
    }

    fn work_on_orders(&self, orders: &Receiver<WorkOrder>, lane: WorkLane, reader: &Sender<SnapshotRequest>) {
        let mut corpus = None;
        while let Ok(order) = orders.recv() {
            let WorkOrder { id, job, stop } = order;
            let about = job.about;
            let edits = lane == WorkLane::Edit;
            // Only one lane edits, so begins and ends alternate.
            if edits {
                self.edits.fetch_add(1, Ordering::SeqCst);
            }
            let outcome = self.carry_out_order(&mut corpus, id, job, &stop);
            let ended = DeskNews::Ended(id, outcome, about);
            // Only edits change the corpus: other results need no new snapshot.
            if !edits {
                self.send_station_news(ended);
                continue;
            }
            self.edits.fetch_add(1, Ordering::SeqCst);
            // Without a reader nobody shows the result later, so it is passed on at once.
            if let Err(SendError(SnapshotRequest::After(ended))) = reader.send(SnapshotRequest::After(Box::new(ended)))
            {
                self.send_station_news(*ended);
            }
        }
    }

    fn carry_out_order(
        &self,
        corpus: &mut Option<Corpus>,
        id: WorkId,
        job: CorpusJob,
        stop: &AtomicBool,
    ) -> WorkResult {
        // Work may have been stopped while it waited for its turn.
        if stop.load(Ordering::Relaxed) {
            return Err(CorpusError::Stopped);
        }
        // An edit of a file that was moved away would be lost with it.
        if (job.about.lane == WorkLane::Edit || corpus.is_none()) && !self.place.is_same_file_present() {
            return Err(CorpusError::from_file_failure(
                &self.path,
                std::io::ErrorKind::NotFound.into(),
            ));
        }
        let corpus = match corpus {
            Some(corpus) => corpus,
            // The connection is opened by the first work of the lane and kept.
            None => corpus.insert(Corpus::open_corpus(&self.path, &self.author)?),
        };
        let mut last = std::time::Instant::now();
        let mut hear = |step: ProgressStep<'_>| {
            // Twenty steps a second are enough to watch, and more would flood the window.
            if last.elapsed() > Duration::from_millis(50) {
                last = std::time::Instant::now();
                self.send_station_news(DeskNews::Far(id, WorkProgress::progress_from_step(&step)));
            }
            if stop.load(Ordering::Relaxed) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        job.carry_out_job(corpus, &mut ProgressReceiver::new(&mut hear))
    }

    fn read_snapshot_requests(&self, wishes: &Receiver<SnapshotRequest>) {
        let corpus = match Corpus::open_corpus(&self.path, &self.author) {
            Ok(corpus) => corpus,
            Err(error) => return self.send_station_news(DeskNews::Unread(error)),
        };
        let mut reading = SnapshotReading {
            corpus,
            recording: None,
            seen: None,
            snapshot: CorpusSnapshot::default(),
        };
        let (mut stood, mut before) = (true, 0);
        let mut ended = Vec::new();
        loop {
            let stands = self.place.is_same_file_present();
            if std::mem::replace(&mut stood, stands) != stands {
                self.send_station_news(DeskNews::Stands(stands));
            }
            // Counted before the reading: an edit that begins meanwhile belongs to the next one.
            let begun = self.edits.load(Ordering::SeqCst);
            match reading.read_snapshot_again() {
                Ok(true) => {
                    let is_own_edit = is_own(before, self.edits.load(Ordering::SeqCst));
                    self.send_station_news(DeskNews::Read(reading.snapshot.clone(), is_own_edit));
                }
                Ok(false) => {}
                Err(error) => self.send_station_news(DeskNews::Unread(error)),
            }
            // Results come after the snapshot that shows them.
            ended.drain(..).for_each(|news| self.send_station_news(news));
            // Work that is running has not ended: count it again at the next reading.
            before = begun & !1;
            let mut next = wishes.recv_timeout(CHANGE_CHECK_INTERVAL);
            // All requests that wait are taken at once, so that one reading serves them.
            while let Ok(wish) = next {
                match wish {
                    SnapshotRequest::After(news) => ended.push(*news),
                    SnapshotRequest::Recording(recording) => reading.recording = recording,
                    SnapshotRequest::Copy(to) => {
                        let saved = reading.corpus.save_copy(&to).map(|()| to);
                        self.send_station_news(DeskNews::Copied(saved));
                    }
                }
                next = wishes.try_recv().map_err(|error| match error {
                    std::sync::mpsc::TryRecvError::Empty => RecvTimeoutError::Timeout,
                    std::sync::mpsc::TryRecvError::Disconnected => RecvTimeoutError::Disconnected,
                });
            }
            // The window has closed.
            if matches!(next, Err(RecvTimeoutError::Disconnected)) {
                return;
            }
        }
    }
}

/// Returns whether a change between two readings may be this window's own work: some work began, ended or ran
/// meanwhile. `before` and `now` count begins and ends.
fn is_own(before: u64, now: u64) -> bool {
    now != before || now % 2 == 1
}

/// The data of the reading thread.
struct SnapshotReading {
    corpus: Corpus,
    /// The recording whose tiers the snapshots include.
    recording: Option<i64>,
    /// The generation and recording of the last snapshot.
    seen: Option<(i64, Option<i64>)>,
    snapshot: CorpusSnapshot,
}

impl SnapshotReading {
    /// Reads what changed since the last snapshot; returns whether anything did.
    fn read_snapshot_again(&mut self) -> Result<bool, CorpusError> {
        let now = (self.corpus.corpus_generation()?, self.recording);
        if self.seen == Some(now) {
            return Ok(false);
        }
        // Another recording in the same corpus needs no new overview.
        if self.seen.is_none_or(|(generation, _)| generation != now.0) {
            self.snapshot.overview = Arc::new(self.corpus.load_corpus_overview(MAX_SHOWN_OPERATIONS)?);
        }
        // A deleted recording may still be watched.
        let there = |id: &i64| {
            let recordings = &self.snapshot.overview.recordings;
            recordings.iter().any(|recording| recording.row.id == *id)
        };
        self.snapshot.open = match self.recording.filter(there) {
            Some(recording) => Some(Arc::new(OpenedRecording::new(
                self.corpus.load_recording_contents(recording)?,
            ))),
            None => None,
        };
        self.seen = Some(now);
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::super::WorkOutcome;
    use super::*;

    /// Reports progress; returns the error if the job has been stopped.
    fn step(progress: &mut ProgressReceiver<'_>) -> Result<(), CorpusError> {
        progress.report_step(ProgressStep {
            task: "",
            done: 0,
            total: None,
            unit: chereme_corpus::ProgressUnit::Items,
        })
    }

    #[test]
    fn closing_stops_queries_and_lets_edits_finish() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.chereme");
        drop(Corpus::create_corpus(&path, "A").expect("created"));
        let wake: WindowWaker = Arc::new(|| {});
        let mut desk = CorpusDesk::open_corpus_desk(&path, "A", &wake);
        let (asking, asked) = channel();
        let (stop, stopped) = channel();
        let (edit, edited) = channel();
        let query = CorpusJob::new(JobAbout::ASK_JOB_ABOUT, move |_, progress| {
            // The desk has closed already if nobody listens.
            let _ = asking.send(());
            let ended = (0..u32::MAX).find_map(|_| step(progress).err());
            let _ = stop.send(());
            Err(ended.unwrap_or(CorpusError::from_wrong_message("never stopped")))
        });
        let change = CorpusJob::new(JobAbout::EDIT_JOB_ABOUT, move |_, progress| {
            // The query ends when the desk closes, so the rest of the edit happens afterwards.
            let _ = stopped.recv();
            let ended = step(progress);
            let _ = edit.send(ended.is_ok());
            ended.map(|()| WorkOutcome::Changed)
        });
        desk.give_desk_job(WorkId(1), change);
        desk.give_desk_job(WorkId(2), query);
        asked.recv().expect("the query runs");
        drop(desk);
        assert_eq!(edited.recv(), Ok(true));
    }

    #[test]
    fn changes_read_during_or_after_own_work_count_as_own() {
        for (before, now, own) in [
            (0, 0, false),
            (0, 1, true),
            (1, 1, true),
            (1, 2, true),
            (0, 2, true),
            (2, 2, false),
        ] {
            assert_eq!(is_own(before, now), own, "{before} {now}");
        }
    }
}
