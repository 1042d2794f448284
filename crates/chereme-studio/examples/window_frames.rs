//! Measures frames of a real window: `cargo run --release --example window_frames -- [CORPUS|two|grid|wall|change|film] [SECONDS] [FILM]`.
//!
//! The window opens without waiting for the screen and plays its first recording in a loop, scrolls and zooms the
//! timeline while it plays, drags an annotation among its neighbours, and closes. Without a corpus, one is created with
//! a recording of the starter corpus and with 200 tiers of 500 annotations. `two` creates one with a generated sign
//! instead, and only plays it beside its original; `grid` imports the starter corpus, and shows all its signs as at
//! least 24 looping little figures; `wall` shows them in the whole window, more than 40 at once. Prints for each scene
//! the time to compute a frame on the window's thread, the interval between frames, and the time to draw pictures of
//! the stage on their own thread; on Linux also the processor time per frame, of all threads together and of each by
//! name, which other programs on the machine affect less. The last scene is an empty window, which shows the machine's
//! own interval between frames.
//!
//! `film` plays a film of 1080 lines next to the signer of that recording: FILM, or one that is drawn from the
//! recording. It also prints in how many of the window's frames the film showed the picture of that very moment.
//!
//! `change` imports the starter corpus and changes a placement of recipes again and again, each time after the result
//! of the last change was drawn. Prints how long the recipe takes without a window, how long after the change its
//! picture was on the stage, and in which frame: 1 is the frame after the one in which the change was typed.

use std::collections::{BTreeMap, VecDeque};
use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use chereme_corpus::{
    Corpus, CorpusAddress, ImportOptions, MediaChange, PictureOptions, ProgressReceiver, RowName, ignore_progress_step,
    unpack_starter,
};
use chereme_studio::{Studio, StudioFolders, StudioOptions};
use eframe::egui::{
    Context, Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, RawInput, TouchPhase, Ui,
    ViewportBuilder, ViewportCommand, Visuals, vec2,
};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = tempfile::tempdir()?;
    let first = arguments.next();
    let two = first.as_deref() == Some("two");
    let wall = first.as_deref() == Some("wall");
    let grid = first.as_deref() == Some("grid") || wall;
    let change = first.as_deref() == Some("change");
    let film = first.as_deref() == Some("film");
    let seconds = arguments.next().map_or(Ok(10), |text| text.parse())?;
    let corpus = match first {
        Some(_) if two => pair(folder.path())?,
        Some(_) if grid => starter(folder.path())?,
        Some(_) if change => {
            let path = starter(folder.path())?;
            without_window(&path)?;
            path
        }
        Some(_) if film => filmed(folder.path(), arguments.next())?,
        Some(path) => PathBuf::from(path),
        None => made(folder.path())?,
    };
    let mut native = eframe::NativeOptions {
        viewport: ViewportBuilder::default()
            .with_title("Chereme")
            .with_position([0.0, 0.0])
            .with_inner_size([1280.0, 800.0]),
        dithering: false,
        ..eframe::NativeOptions::default()
    };
    native.glow_options.vsync = false;
    let folders = StudioFolders {
        config: Some(folder.path().to_owned()),
        data: None,
    };
    let options = StudioOptions {
        corpus: Some(corpus),
        author: "A".into(),
        folders,
        ..StudioOptions::default()
    };
    let meter = Meter {
        studio: Studio::new(options),
        change: Change::default(),
        scenes: if two {
            VecDeque::from([Scene::Two, Scene::Empty])
        } else if change {
            (0..RECIPES.len()).map(Scene::Change).collect()
        } else if wall {
            VecDeque::from([Scene::Wall, Scene::Empty])
        } else if film {
            VecDeque::from([Scene::Film, Scene::Empty])
        } else if grid {
            VecDeque::from([Scene::Grid, Scene::Empty])
        } else {
            VecDeque::from([Scene::Play, Scene::Scroll, Scene::Drag, Scene::Empty])
        },
        drawn: Vec::new(),
        begun: None,
        lasts: Duration::from_secs(seconds) / 3,
        last: None,
        frame: 0,
        pictured: 0,
        computed: Vec::new(),
        apart: Vec::new(),
        worked: BTreeMap::new(),
    };
    eframe::run_native("window_frames", native, Box::new(|_| Ok(Box::new(meter))))?;
    Ok(())
}

/// Returns a corpus with a recording of the starter corpus and many tiers and annotations.
fn made(folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let files = unpack_starter(&folder.join("files"))?;
    let phrase = files
        .iter()
        .find(|path| path.ends_with("phrase.bvh"))
        .ok_or("no phrase")?;
    let path = folder.join("many.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A")?;
    let beside = folder.join("phrase.bvh");
    std::fs::copy(phrase, &beside)?;
    let annotations = folder.join("phrase.eaf");
    std::fs::write(&annotations, many(200, 500, 6000)?)?;
    let mut hear = ignore_progress_step;
    let options = ImportOptions::default();
    corpus.import_paths(&[beside, annotations], &options, &mut ProgressReceiver::new(&mut hear))?;
    Ok(path)
}

/// Returns the same corpus with a film next to the signer.
fn filmed(folder: &Path, film: Option<String>) -> Result<PathBuf, Box<dyn Error>> {
    let path = made(folder)?;
    let mut corpus = Corpus::open_corpus(&path, "A")?;
    let recording = RowName::Number(1);
    let film = match film {
        Some(film) => std::fs::canonicalize(film)?,
        None => {
            let film = folder.join("film.mp4");
            let options = PictureOptions {
                height: Some(1080),
                ..PictureOptions::default()
            };
            let mut hear = ignore_progress_step;
            let what = CorpusAddress::Recording(recording.clone());
            corpus.draw_movement_file(&what, &film, &options, &mut ProgressReceiver::new(&mut hear))?;
            film
        }
    };
    let link = MediaChange::Add(film.display().to_string());
    corpus.change_media(&recording, &link)?;
    Ok(path)
}

/// Returns the starter corpus, for a window with room for all figures.
fn starter(folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    std::fs::write(folder.join("studio.json"), r#"{ "scale": 0.7 }"#)?;
    let files = folder.join("files");
    unpack_starter(&files)?;
    let path = folder.join("starter.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A")?;
    let mut hear = ignore_progress_step;
    let options = ImportOptions::default();
    corpus.import_paths(&[files], &options, &mut ProgressReceiver::new(&mut hear))?;
    Ok(path)
}

/// Recipes whose last number changes: the text before that number and the text after it.
const RECIPES: [&str; 3] = [
    "ESCARGOT | place both by left 10cm",
    "ESCARGOT | configure right U | orient left palm up | place both by left 10cm",
    "(ESCARGOT then CHAT then BOL) | configure right U | place both by left 10cm",
];

/// Returns the recipe after a number of changes, as the corpus writes it.
fn changed(recipe: &str, times: u64) -> String {
    recipe.replace("10cm", &format!("1{}cm", times % 10))
}

/// How often a recipe is changed.
const CHANGES: u64 = 60;

/// Prints the time that each changed recipe takes with nothing else running.
#[expect(clippy::print_stdout, reason = "it tells what it measured")]
fn without_window(path: &Path) -> Result<(), Box<dyn Error>> {
    let mut corpus = Corpus::open_corpus(path, "A")?;
    for recipe in RECIPES {
        let mut times = [Vec::new(), Vec::new()];
        let mut frames = 0;
        let mut hear = ignore_progress_step;
        for nth in 0..CHANGES {
            let text = changed(recipe, nth);
            let begun = Instant::now();
            frames = corpus.preview_recipe(&text)?.clip.clip_frame_count();
            times[0].push(begun.elapsed());
            let begun = Instant::now();
            corpus.draft_recipe(&text, false, &mut ProgressReceiver::new(&mut hear))?;
            times[1].push(begun.elapsed());
        }
        println!("{recipe}: {frames} frames");
        println!("  from scratch: {}", summary(&mut times[0][1..]));
        println!("  of a draft: {}", summary(&mut times[1][1..]));
    }
    Ok(())
}

/// Returns the number, the median, the 95th percentile and the maximum of some times, as text.
fn summary<T: Ord + Copy + std::fmt::Debug>(times: &mut [T]) -> String {
    times.sort_unstable();
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    let (median, slow, worst) = (at(0.5), at(0.95), at(1.0));
    format!(
        "{} times, median {median:?}, p95 {slow:?}, worst {worst:?}",
        times.len()
    )
}

/// Returns a corpus with ESCARGOT, and LIMACE made from it.
fn pair(folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let mut files = unpack_starter(&folder.join("files"))?;
    files.retain(|path| path.file_stem().is_some_and(|stem| stem == "escargot"));
    let path = folder.join("two.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A")?;
    let mut hear = ignore_progress_step;
    let options = ImportOptions::default();
    corpus.import_paths(&files, &options, &mut ProgressReceiver::new(&mut hear))?;
    corpus.recombine_recipe("ESCARGOT | configure right U", "LIMACE")?;
    Ok(path)
}

/// Returns an ELAN file of `tiers` tiers with `each` annotations within `millis` milliseconds.
fn many(tiers: usize, each: usize, millis: usize) -> Result<String, std::fmt::Error> {
    let mut text = String::from(
        "<ANNOTATION_DOCUMENT AUTHOR=\"\" DATE=\"2020-01-01T00:00:00Z\" FORMAT=\"3.0\" VERSION=\"3.0\">\
         <HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/><TIME_ORDER>",
    );
    for at in 0..=each {
        write!(
            text,
            "<TIME_SLOT TIME_SLOT_ID=\"ts{at}\" TIME_VALUE=\"{}\"/>",
            at * millis / each
        )?;
    }
    text += "</TIME_ORDER>";
    for tier in 0..tiers {
        write!(text, "<TIER LINGUISTIC_TYPE_REF=\"free\" TIER_ID=\"tier {tier}\">")?;
        for at in 0..each {
            write!(
                text,
                "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a{tier}_{at}\" \
                 TIME_SLOT_REF1=\"ts{at}\" TIME_SLOT_REF2=\"ts{}\"><ANNOTATION_VALUE>V{at}</ANNOTATION_VALUE>\
                 </ALIGNABLE_ANNOTATION></ANNOTATION>",
                at + 1
            )?;
        }
        text += "</TIER>";
    }
    text += "<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"free\" TIME_ALIGNABLE=\"true\"/></ANNOTATION_DOCUMENT>";
    Ok(text)
}

/// The work during the measured frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scene {
    /// Playing in a loop.
    Play,
    /// Playing in a loop next to a film.
    Film,
    /// Playing a generated sign beside its original.
    Two,
    /// Scrolling through the tiers, and zooming in and out.
    Scroll,
    /// Dragging an annotation to and fro.
    Drag,
    /// Showing results as looping little figures.
    Grid,
    /// The same with the whole window.
    Wall,
    /// Changing a recipe.
    Change(usize),
    /// No work: the time of a window's frames without the studio.
    Empty,
}

/// The progress of changing a recipe.
#[derive(Default)]
struct Change {
    times: u64,
    /// The time when the last change was typed, and the number of frames since.
    typed: Option<(Instant, u64)>,
    took: Vec<Duration>,
    frames: Vec<u64>,
}

/// A point of the timeline in the window.
const TIMELINE: Pos2 = Pos2::new(760.0, 690.0);

impl Scene {
    /// Returns how many frames only prepare the scene; figures are drawn by then.
    fn sets(self) -> u64 {
        match self {
            Self::Grid => 900,
            Self::Wall => 3000,
            // By then the film is open.
            Self::Film => 200,
            Self::Change(_) => 60,
            _ => 20,
        }
    }

    /// Returns the input events of a person in one frame of the scene.
    fn events(self, frame: u64) -> Vec<Event> {
        let key = |key, modifiers| Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers,
        };
        let button = |pressed| Event::PointerButton {
            pos: TIMELINE,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::ALT,
        };
        match (self, frame) {
            (Self::Two, 0) => vec![key(Key::PageDown, Modifiers::COMMAND)],
            (Self::Play | Self::Film, 0) | (Self::Two, 1) => vec![key(Key::L, Modifiers::COMMAND)],
            (Self::Play | Self::Film, 1) | (Self::Two, 2) => {
                vec![key(Key::Space, Modifiers::COMMAND)]
            }
            (Self::Grid | Self::Wall, 0) => vec![key(Key::F2, Modifiers::COMMAND)],
            (Self::Grid | Self::Wall, 4) => vec![key(Key::F, Modifiers::COMMAND)],
            (Self::Grid | Self::Wall, 10) => vec![key(Key::Enter, Modifiers::NONE)],
            (Self::Wall, 14) => vec![key(Key::F11, Modifiers::NONE)],
            (Self::Change(_), 0) => vec![key(Key::F3, Modifiers::COMMAND), key(Key::R, Modifiers::COMMAND)],
            (Self::Change(_), 4) => vec![key(Key::A, Modifiers::COMMAND)],
            (Self::Change(nth), 5) => vec![Event::Text(RECIPES[nth].into())],
            (Self::Change(_), 6) => vec![key(Key::ArrowLeft, Modifiers::NONE); 2],
            (Self::Change(_), 40) => vec![key(Key::Space, Modifiers::COMMAND)],
            (Self::Play | Self::Film | Self::Two | Self::Grid | Self::Wall | Self::Change(_) | Self::Empty, _) => {
                Vec::new()
            }
            (Self::Scroll, frame) => {
                let zooms = frame % 240 >= 180;
                let up = frame % 120 >= 60;
                let turn = if up { 40.0 } else { -40.0 };
                let modifiers = if zooms { Modifiers::COMMAND } else { Modifiers::NONE };
                let wheel = Event::MouseWheel {
                    unit: MouseWheelUnit::Point,
                    delta: vec2(0.0, turn),
                    phase: TouchPhase::Move,
                    source: MouseWheelSource::Unknown,
                    modifiers,
                };
                vec![Event::PointerMoved(TIMELINE), wheel]
            }
            (Self::Drag, 0) => vec![key(Key::Space, Modifiers::COMMAND), key(Key::F7, Modifiers::NONE)],
            (Self::Drag, 1..9) => vec![key(Key::Equals, Modifiers::COMMAND)],
            (Self::Drag, 9) => vec![
                Event::ModifiersChanged(Modifiers::ALT),
                Event::PointerMoved(TIMELINE),
                button(true),
            ],
            (Self::Drag, frame) => {
                let by = (frame as f32 * 0.05).sin() * 150.0;
                vec![Event::PointerMoved(TIMELINE + vec2(by, 0.0))]
            }
        }
    }
}

struct Meter {
    studio: Studio,
    scenes: VecDeque<Scene>,
    /// The time when the measurement of the scene began.
    begun: Option<Instant>,
    lasts: Duration,
    last: Option<Instant>,
    frame: u64,
    /// The number of frames in which the film showed the picture of that very moment.
    pictured: u64,
    computed: Vec<Duration>,
    apart: Vec<Duration>,
    drawn: Vec<Duration>,
    /// The processor time of the threads when the measurement of the scene began.
    worked: BTreeMap<String, u64>,
    change: Change,
}

/// Returns the processor time of the program so far, and of its threads by their names without numbers, in
/// hundredths of a second; empty if the system does not report it. Threads that ended count only for the program.
fn worked() -> BTreeMap<String, u64> {
    const PROGRAM: &str = "/proc/self/stat";
    let mut all = BTreeMap::new();
    let threads = std::fs::read_dir("/proc/self/task").into_iter().flatten();
    let threads = threads.flatten().map(|it| it.path().join("stat"));
    for path in threads.chain([PROGRAM.into()]) {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let Some((start, rest)) = text.rsplit_once(')') else {
            continue;
        };
        let name = match start.split_once('(') {
            Some((_, name)) if !path.ends_with(PROGRAM) => name.trim_end_matches(|it: char| it.is_ascii_digit()),
            _ => ALL,
        };
        let parts = rest.split_whitespace().skip(11).take(2);
        *all.entry(name.to_owned()).or_default() += parts.flat_map(str::parse::<u64>).sum::<u64>();
    }
    all
}

/// The name of the sum over all threads.
const ALL: &str = "all";

impl eframe::App for Meter {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let now = Instant::now();
        if self.scenes.front() != Some(&Scene::Empty) {
            self.studio.ui(ui);
        }
        ui.ctx().request_repaint();
        // The first frames of a scene only prepare it.
        if self.scenes.front().is_none_or(|scene| self.frame < scene.sets()) {
            return;
        }
        if let Some(Scene::Change(nth)) = self.scenes.front().copied() {
            self.follow(RECIPES[nth]);
        }
        let begun = *self.begun.get_or_insert_with(|| {
            self.worked = worked();
            now
        });
        if let Some(last) = self.last.replace(now) {
            self.apart.push(now - last);
            self.computed.push(now.elapsed());
            self.pictured += u64::from(self.studio.is_filmed());
            let took = self.studio.drawing_time();
            if self.drawn.last() != Some(&took) {
                self.drawn.push(took);
            }
        }
        let over = match self.scenes.front() {
            Some(Scene::Change(_)) => self.change.times >= CHANGES,
            _ => now - begun > self.lasts,
        };
        if over && !self.apart.is_empty() {
            self.report();
            (self.begun, self.last, self.frame) = (None, None, 0);
            self.scenes.pop_front();
            if self.scenes.is_empty() {
                ui.ctx().send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    fn clear_color(&self, visuals: &Visuals) -> [f32; 4] {
        eframe::App::clear_color(&self.studio, visuals)
    }

    fn raw_input_hook(&mut self, _ctx: &Context, input: &mut RawInput) {
        if self.studio.shown_corpus_path().is_none() || (self.frame == 0 && !self.studio.is_idle()) {
            return;
        }
        if let Some(scene) = self.scenes.front() {
            input.events.extend(scene.events(self.frame));
            self.frame += 1;
            let waits = self.change.typed.is_some() || self.frame < scene.sets();
            if matches!(scene, Scene::Change(_)) && !waits {
                self.change.times += 1;
                self.change.typed = Some((Instant::now(), 0));
                let back = Event::Key {
                    key: Key::Backspace,
                    physical_key: None,
                    pressed: true,
                    repeat: false,
                    modifiers: Modifiers::NONE,
                };
                let digit = (self.change.times % 10).to_string();
                input.events.extend([back, Event::Text(digit)]);
            }
        }
    }
}

impl Meter {
    /// Notes when the picture of the last change is on the stage.
    fn follow(&mut self, recipe: &str) {
        let Some((begun, frames)) = &mut self.change.typed else {
            return;
        };
        let wanted = changed(recipe, self.change.times);
        if self.studio.is_drawn() && self.studio.staged_movement_name() == Some(&wanted) {
            self.change.took.push(begun.elapsed());
            self.change.frames.push(*frames);
            self.change.typed = None;
        } else {
            *frames += 1;
        }
    }

    #[expect(clippy::print_stdout, reason = "it tells what it measured")]
    fn report(&mut self) {
        let scene = self.scenes.front();
        let frames = self.apart.len() as f64;
        let each = worked().into_iter().map(|(name, now)| {
            let before = self.worked.get(&name).copied().unwrap_or_default();
            (name, now.saturating_sub(before) as f64 * 10.0 / frames)
        });
        let each = each.filter(|(_, millis)| *millis >= 0.1);
        let each: Vec<String> = each.map(|it| format!("{} {:.1} ms", it.0, it.1)).collect();
        if !each.is_empty() {
            println!("{scene:?} processor time a frame: {}", each.join(", "));
        }
        if scene == Some(&Scene::Film) {
            let share = 100.0 * self.pictured as f64 / frames;
            println!("{scene:?} in step: {share:.1} % of {frames} frames");
        }
        self.pictured = 0;
        let all = [
            ("computed", &mut self.computed),
            ("apart", &mut self.apart),
            ("drawn", &mut self.drawn),
            ("change to picture", &mut self.change.took),
        ];
        for (name, times) in all {
            if !times.is_empty() {
                println!("{scene:?} {name}: {}", summary(times));
                times.clear();
            }
        }
        if !self.change.frames.is_empty() {
            let frames = summary(&mut self.change.frames);
            println!("{scene:?} seen in frame: {frames}");
        }
        self.change = Change::default();
    }
}
