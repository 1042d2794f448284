//! The threads of an open corpus: one for each lane of work, and one that reads snapshots.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SendError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use chereme_corpus::{Corpus, Error, FileIdentity, Progress, Step};

use super::{About, Ended, Far, Job, Lane, WorkId};
use crate::model::{Opened, Snapshot};

/// Interval between checks for changes by other programs.
const LOOK: Duration = Duration::from_millis(300);
/// How many operations the history shows.
const OPERATIONS: usize = 2000;

/// Wakes the window; called from any thread.
pub(crate) type Wake = Arc<dyn Fn() + Send + Sync>;

/// The threads' messages to the window.
#[derive(Debug)]
pub(crate) enum News {
    /// A new snapshot, and whether this window's own work changed the corpus.
    Read(Snapshot, bool),
    /// The corpus could not be read.
    Unread(Error),
    /// Whether the corpus file is in its place; sent when that changes.
    Stands(bool),
    /// The path of the saved copy, or the error.
    Copied(Result<PathBuf, Error>),
    /// The progress of a piece of work.
    Far(WorkId, Far),
    /// The result of a piece of work; that of an edit comes after the snapshot that shows it.
    Ended(WorkId, Ended, About),
}

/// Work that has been started and has not ended.
#[derive(Debug)]
pub(crate) struct Running {
    pub(crate) about: About,
    pub(crate) far: Far,
    stop: Arc<AtomicBool>,
}

struct Order {
    id: WorkId,
    job: Job,
    stop: Arc<AtomicBool>,
}

enum SnapshotRequest {
    /// Read again after work of this window, and pass on its end once the snapshot shows its result.
    After(Box<News>),
    /// Include the tiers of this recording in the snapshots.
    Recording(Option<i64>),
    /// Save a copy there.
    Copy(PathBuf),
}

/// An open corpus with its threads; dropping it waits until the user's edits are stored.
pub(crate) struct Desk {
    pub(crate) path: PathBuf,
    lanes: BTreeMap<Lane, Sender<Order>>,
    reader: Option<Sender<SnapshotRequest>>,
    news: Receiver<News>,
    pub(crate) running: BTreeMap<WorkId, Running>,
    threads: Vec<JoinHandle<()>>,
}

impl Desk {
    /// Opens the corpus at `path` on every thread; failures arrive as news.
    pub(crate) fn open(path: &Path, author: &str, wake: &Wake) -> Self {
        let (sender, news) = channel();
        let station = Station {
            path: path.to_owned(),
            author: author.to_owned(),
            sender,
            wake: wake.clone(),
            place: FileIdentity::of(path),
            edits: Arc::default(),
        };
        let (reader, wishes) = channel();
        let mut threads = Vec::new();
        let mut lanes = BTreeMap::new();
        for lane in Lane::ALL {
            let (give, orders) = channel();
            let (station, reader) = (station.clone(), reader.clone());
            threads.push(std::thread::spawn(move || {
                station.work(&orders, lane, &reader)
            }));
            lanes.insert(lane, give);
        }
        threads.push(std::thread::spawn(move || station.read(&wishes)));
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
    pub(crate) fn give(&mut self, id: WorkId, job: Job) {
        let about = job.about;
        let stop = Arc::new(AtomicBool::new(false));
        let running = Running {
            about,
            far: Far::default(),
            stop: stop.clone(),
        };
        let order = Order { id, job, stop };
        let lane = self.lanes.get(&about.lane);
        if lane.is_some_and(|lane| lane.send(order).is_ok()) {
            self.running.insert(id, running);
        }
    }

    /// Stops a piece of work, whether it has begun or not.
    pub(crate) fn stop(&self, id: WorkId) {
        if let Some(running) = self.running.get(&id) {
            running.stop.store(true, Ordering::Relaxed);
        }
    }

    /// Makes the snapshots include the tiers of that recording.
    pub(crate) fn watch(&self, recording: Option<i64>) {
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
    pub(crate) fn news(&mut self) -> Vec<News> {
        let mut all = Vec::new();
        while let Ok(news) = self.news.try_recv() {
            match &news {
                News::Far(id, far) => {
                    if let Some(running) = self.running.get_mut(id) {
                        running.far = far.clone();
                    }
                }
                News::Ended(id, ..) => {
                    self.running.remove(id);
                }
                _ => {}
            }
            all.push(news);
        }
        all
    }
}

impl Drop for Desk {
    fn drop(&mut self) {
        let stoppable = |running: &&Running| running.about.may_stop;
        for running in self.running.values().filter(stoppable) {
            running.stop.store(true, Ordering::Relaxed);
        }
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
struct Station {
    path: PathBuf,
    author: String,
    sender: Sender<News>,
    wake: Wake,
    /// The identity of the corpus file when it was opened.
    place: FileIdentity,
    /// How often work of this window began or ended to change the corpus; odd while such work runs.
    edits: Arc<AtomicU64>,
}

impl Station {
    fn say(&self, news: News) {
        // The window does not listen any more when it is closing.
        let _ = self.sender.send(news);
        (self.wake)();
    }

    fn work(&self, orders: &Receiver<Order>, lane: Lane, reader: &Sender<SnapshotRequest>) {
        let mut corpus = None;
        while let Ok(order) = orders.recv() {
            let Order { id, job, stop } = order;
            let about = job.about;
            let edits = lane == Lane::Edit;
            // Only one lane edits, so begins and ends alternate.
            if edits {
                self.edits.fetch_add(1, Ordering::SeqCst);
            }
            let ended = self.carry_out(&mut corpus, id, job, &stop);
            let ended = News::Ended(id, ended, about);
            if !edits {
                self.say(ended);
                continue;
            }
            self.edits.fetch_add(1, Ordering::SeqCst);
            if let Err(SendError(SnapshotRequest::After(ended))) =
                reader.send(SnapshotRequest::After(Box::new(ended)))
            {
                self.say(*ended);
            }
        }
    }

    fn carry_out(
        &self,
        corpus: &mut Option<Corpus>,
        id: WorkId,
        job: Job,
        stop: &AtomicBool,
    ) -> Ended {
        if stop.load(Ordering::Relaxed) {
            return Err(Error::Stopped);
        }
        if (job.about.lane == Lane::Edit || corpus.is_none()) && !self.place.stands() {
            return Err(Error::file(&self.path, std::io::ErrorKind::NotFound.into()));
        }
        let corpus = match corpus {
            Some(corpus) => corpus,
            None => corpus.insert(Corpus::open(&self.path, &self.author)?),
        };
        let mut last = std::time::Instant::now();
        let mut hear = |step: Step<'_>| {
            if last.elapsed() > Duration::from_millis(50) {
                last = std::time::Instant::now();
                self.say(News::Far(id, Far::of(&step)));
            }
            if stop.load(Ordering::Relaxed) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        job.carry_out(corpus, &mut Progress::new(&mut hear))
    }

    fn read(&self, wishes: &Receiver<SnapshotRequest>) {
        let corpus = match Corpus::open(&self.path, &self.author) {
            Ok(corpus) => corpus,
            Err(error) => return self.say(News::Unread(error)),
        };
        let mut reading = Reading {
            corpus,
            recording: None,
            seen: None,
            snapshot: Snapshot::default(),
        };
        let (mut stood, mut before) = (true, 0);
        let mut ended = Vec::new();
        loop {
            let stands = self.place.stands();
            if std::mem::replace(&mut stood, stands) != stands {
                self.say(News::Stands(stands));
            }
            let begun = self.edits.load(Ordering::SeqCst);
            match reading.again() {
                Ok(true) => {
                    let own = is_own(before, self.edits.load(Ordering::SeqCst));
                    self.say(News::Read(reading.snapshot.clone(), own));
                }
                Ok(false) => {}
                Err(error) => self.say(News::Unread(error)),
            }
            ended.drain(..).for_each(|news| self.say(news));
            // Work that is running has not ended: count it again at the next reading.
            before = begun & !1;
            let mut next = wishes.recv_timeout(LOOK);
            while let Ok(wish) = next {
                match wish {
                    SnapshotRequest::After(news) => ended.push(*news),
                    SnapshotRequest::Recording(recording) => reading.recording = recording,
                    SnapshotRequest::Copy(to) => {
                        let saved = reading.corpus.save_copy(&to).map(|()| to);
                        self.say(News::Copied(saved));
                    }
                }
                next = wishes.try_recv().map_err(|error| match error {
                    std::sync::mpsc::TryRecvError::Empty => RecvTimeoutError::Timeout,
                    std::sync::mpsc::TryRecvError::Disconnected => RecvTimeoutError::Disconnected,
                });
            }
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
struct Reading {
    corpus: Corpus,
    /// The recording whose tiers the snapshots include.
    recording: Option<i64>,
    /// The generation and recording of the last snapshot.
    seen: Option<(i64, Option<i64>)>,
    snapshot: Snapshot,
}

impl Reading {
    /// Reads what changed since the last snapshot; returns whether anything did.
    fn again(&mut self) -> Result<bool, Error> {
        let now = (self.corpus.generation()?, self.recording);
        if self.seen == Some(now) {
            return Ok(false);
        }
        if self.seen.is_none_or(|(generation, _)| generation != now.0) {
            self.snapshot.overview = Arc::new(self.corpus.overview(OPERATIONS)?);
        }
        let there = |id: &i64| {
            let recordings = &self.snapshot.overview.recordings;
            recordings.iter().any(|recording| recording.row.id == *id)
        };
        self.snapshot.open = match self.recording.filter(there) {
            Some(recording) => Some(Arc::new(Opened::new(self.corpus.contents(recording)?))),
            None => None,
        };
        self.seen = Some(now);
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Outcome;
    use super::*;

    /// Reports progress; returns the error if the job has been stopped.
    fn step(progress: &mut Progress<'_>) -> Result<(), Error> {
        progress.report(Step {
            task: "",
            done: 0,
            total: None,
            unit: chereme_corpus::Unit::Items,
        })
    }

    #[test]
    fn closing_stops_queries_and_lets_edits_finish() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.chereme");
        drop(Corpus::create(&path, "A").expect("created"));
        let wake: Wake = Arc::new(|| {});
        let mut desk = Desk::open(&path, "A", &wake);
        let (asking, asked) = channel();
        let (stop, stopped) = channel();
        let (edit, edited) = channel();
        let query = Job::new(About::ASK, move |_, progress| {
            // The desk has closed already if nobody listens.
            let _ = asking.send(());
            let ended = (0..u32::MAX).find_map(|_| step(progress).err());
            let _ = stop.send(());
            Err(ended.unwrap_or(Error::wrong("never stopped")))
        });
        let change = Job::new(About::EDIT, move |_, progress| {
            // The query ends when the desk closes, so the rest of the edit happens afterwards.
            let _ = stopped.recv();
            let ended = step(progress);
            let _ = edit.send(ended.is_ok());
            ended.map(|()| Outcome::Changed)
        });
        desk.give(WorkId(1), change);
        desk.give(WorkId(2), query);
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
