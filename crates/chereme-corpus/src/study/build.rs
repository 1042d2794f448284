//! The questionnaire of a study: a folder with one page and its films, which works without a network.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use chereme_figure::{Animation, AnimationOptions, FigureError, Image, Pictures, Reach, View};
use serde::Serialize;
use serde_json::json;
use sha2::{Digest, Sha256};

use super::plan::{Plan, QuestionKind, text_in};
use super::{Study, order};
use crate::Corpus;
use crate::db::motion::hex;
use crate::db::seals;
use crate::error::{Error, Result};
use crate::film::{Shape, write_film};
use crate::page::{base64, filled};
use crate::picture::write;
use crate::progress::{Progress, Step, Unit};

/// The page with places for its parts, its script and its style.
const PAGE: &str = include_str!("page/index.html");
const SCRIPT: &str = include_str!("page/page.js");
const TEXTS: &str = include_str!("page/texts.js");
const STYLE: &str = include_str!("page/page.css");

/// The folder of films and pictures beside the page.
const MEDIA: &str = "media";
/// For how long the first and the last picture of a film stand still, in milliseconds.
const STILL_MS: u32 = 500;

/// Options of a questionnaire.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct QuestionnaireOptions {
    /// The height of films in pixels.
    pub height: usize,
    /// Pictures per second.
    pub rate: u32,
    /// Whether an existing questionnaire is replaced; other files in its folder stay.
    pub force: bool,
}

impl Default for QuestionnaireOptions {
    fn default() -> Self {
        Self {
            height: 540,
            rate: 25,
            force: false,
        }
    }
}

/// A questionnaire that was built.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Questionnaire {
    /// The page to open.
    pub page: PathBuf,
    /// The SHA-256 of the plan, which the answers will name.
    pub plan_sha256: String,
    /// The number of films.
    pub films: usize,
    /// The size of all files in bytes.
    pub bytes: u64,
    /// The number of orders in which participants see the trials.
    pub orders: usize,
    /// Pictures that the plan names and that are not in the folder yet.
    pub missing: Vec<PathBuf>,
    /// Clips that move exactly alike though they are written differently, so that nobody can see a difference.
    pub alike: Vec<[String; 2]>,
}

impl Corpus {
    /// Builds the questionnaire of a study in a folder: `index.html`, which holds plan and script, and the films in
    /// `media`. The same corpus and plan give the same bytes. All films have one camera, size and background.
    ///
    /// # Errors
    /// Fails if there is no such study, a clip can no longer be made, or the page exists and `force` is not set; the
    /// folder is as before then.
    pub fn build_study(
        &mut self,
        name: &str,
        to: &Path,
        options: QuestionnaireOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Questionnaire> {
        let study = self.study(name)?;
        let page = to.join("index.html");
        if page.exists() && !options.force {
            return Err(Error::file(page, std::io::ErrorKind::AlreadyExists.into()));
        }
        seals::verify_material(self.store.read())?;
        let media = to.join(MEDIA);
        let new = !to.exists();
        fs::create_dir_all(&media).map_err(|error| Error::file(&media, error))?;
        let mut made = Vec::new();
        let done = self.questionnaire(&study, &page, options, &mut made, progress);
        if done.is_err() {
            // Whatever cannot be removed does no harm: the page is written last.
            made.iter().for_each(|film| drop(fs::remove_file(film)));
            if new {
                drop(fs::remove_dir(&media));
                drop(fs::remove_dir(to));
            }
        }
        done
    }

    fn questionnaire(
        &mut self,
        study: &Study,
        page: &Path,
        options: QuestionnaireOptions,
        made: &mut Vec<PathBuf>,
        progress: &mut Progress<'_>,
    ) -> Result<Questionnaire> {
        let plan = &study.plan;
        let media = page.with_file_name(MEDIA);
        let mut reach: Option<Reach> = None;
        self.study_clips(plan, progress, |_, it| {
            let own = Reach::of(&it.clip, &it.anatomy);
            reach = match (reach, own) {
                (Some(all), Some(own)) => Some(all.joined(own)),
                (all, own) => all.or(own),
            };
            Ok(())
        })?;
        let mut films: BTreeMap<usize, String> = BTreeMap::new();
        let mut bytes = 0;
        let clips: BTreeSet<&str> = plan.trials.iter().map(|it| it.clip.as_str()).collect();
        let total = clips.len() as u64;
        let mut drawn = 0;
        let mut unheard = crate::progress::unheard;
        let quiet = &mut Progress::new(&mut unheard);
        self.study_clips(plan, quiet, |trials, it| {
            let settings = AnimationOptions {
                views: vec![View::Addressee],
                height: options.height,
                rate: Some(options.rate.clamp(1, 120)),
                faces: it.faces,
                framing: reach.and_then(|reach| reach.framing(&it.clip, &it.anatomy)),
                bar: false,
                ..AnimationOptions::default()
            };
            let animation = Animation::new(&it.clip, &it.anatomy, settings).map_err(figure)?;
            let mut hear = |_, _| {
                progress.report(Step {
                    task: "drawing films",
                    done: drawn,
                    total: Some(total),
                    unit: Unit::Items,
                })
            };
            let film = film(animation, options.rate.clamp(1, 120), &mut hear)?;
            drawn += 1;
            let name = format!("{}.mp4", &hex(&Sha256::digest(&film))[..16]);
            let path = media.join(&name);
            if !path.exists() {
                made.push(path.clone());
            }
            bytes += write(&path, true, |out| put(out, &film, &path))?;
            for &trial in trials {
                films.insert(trial, name.clone());
            }
            Ok(())
        })?;
        let rows = order::rows(plan);
        let text = html(study, &films, &rows);
        bytes += write(page, options.force, |out| put(out, text.as_bytes(), page))?;
        let names: BTreeSet<&String> = films.values().collect();
        if options.force {
            remove_old(&media, &names);
        }
        Ok(Questionnaire {
            page: page.to_owned(),
            plan_sha256: study.plan_sha256.clone(),
            films: names.len(),
            bytes,
            orders: rows.len(),
            missing: missing(plan, &media),
            alike: alike(plan, &films),
        })
    }
}

fn put(out: &mut impl std::io::Write, bytes: &[u8], path: &Path) -> Result<()> {
    out.write_all(bytes)
        .map_err(|error| Error::file(path, error))
}

/// Pictures whose first and last one stand still for a while.
struct Held<'a> {
    moving: Animation<'a>,
    still: usize,
}

impl Pictures for Held<'_> {
    fn frames(&self) -> usize {
        self.moving.frames() + 2 * self.still
    }

    fn size(&self) -> [usize; 2] {
        self.moving.size()
    }

    fn centiseconds(&self) -> u16 {
        Pictures::centiseconds(&self.moving)
    }

    fn draw(&mut self, frame: usize) -> Image {
        let last = self.moving.frames() - 1;
        self.moving.draw(frame.saturating_sub(self.still).min(last))
    }
}

/// Returns a film of an animation.
fn film(
    moving: Animation<'_>,
    rate: u32,
    hear: &mut dyn FnMut(usize, usize) -> Result<()>,
) -> Result<Vec<u8>> {
    let still = (STILL_MS * rate / 1000) as usize;
    let mut film = Vec::new();
    write_film(&mut Held { moving, still }, Shape { rate }, &mut film, hear)?;
    Ok(film)
}

fn figure(error: FigureError) -> Error {
    Error::wrong(error.to_string())
}

/// Removes films of an earlier build: files with names that only a build gives.
fn remove_old(media: &Path, films: &BTreeSet<&String>) {
    let Ok(entries) = fs::read_dir(media) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let hash = name.strip_suffix(".mp4").filter(|it| it.len() == 16);
        let built = hash.is_some_and(|it| it.bytes().all(|it| b"0123456789abcdef".contains(&it)));
        if built && !films.contains(&name) {
            // A film that stays is never shown.
            drop(fs::remove_file(entry.path()));
        }
    }
}

/// Returns the pictures that a plan names and that are not in the folder.
fn missing(plan: &Plan, media: &Path) -> Vec<PathBuf> {
    let asked = plan.questions.iter().filter_map(|it| match &it.kind {
        QuestionKind::Choice { options } => Some(options),
        QuestionKind::Scale { .. } => None,
    });
    let about = plan.profile.iter().map(|it| &it.options);
    let pictures: BTreeSet<PathBuf> = asked
        .chain(about)
        .flatten()
        .filter_map(|it| it.picture.as_ref())
        .map(|it| media.join(it))
        .collect();
    pictures.into_iter().filter(|it| !it.exists()).collect()
}

/// Returns the pairs of clips that gave the same film.
fn alike(plan: &Plan, films: &BTreeMap<usize, String>) -> Vec<[String; 2]> {
    let mut first: BTreeMap<&str, &str> = BTreeMap::new();
    let mut pairs = BTreeSet::new();
    for (at, trial) in plan.trials.iter().enumerate() {
        if let Some(film) = films.get(&at) {
            let clip = *first.entry(film).or_insert(&trial.clip);
            if clip != trial.clip {
                pairs.insert([clip.to_owned(), trial.clip.clone()]);
            }
        }
    }
    pairs.into_iter().collect()
}

/// Returns the page. It holds no right answers, hypotheses or recipes, because they would lead participants.
fn html(study: &Study, films: &BTreeMap<usize, String>, rows: &[Vec<order::Shown>]) -> String {
    let plan = &study.plan;
    let trials: Vec<serde_json::Value> = plan
        .trials
        .iter()
        .enumerate()
        .map(|(at, it)| {
            json!({"item": it.item, "condition": it.condition, "part": it.part,
                   "role": it.role, "film": films.get(&at)})
        })
        .collect();
    let rows: Vec<Vec<(usize, u32)>> = rows
        .iter()
        .map(|row| row.iter().map(|it| (it.trial, it.block)).collect())
        .collect();
    let data = json!({
        "study": plan.name, "plan_sha256": study.plan_sha256, "title": plan.title,
        "consent": plan.consent, "questions": plan.questions, "profile": plan.profile,
        "parts": plan.parts(), "trials": trials, "rows": rows,
    });
    // Within a script element only `<` could end it.
    let data = data.to_string().replace('<', "\\u003c");
    let script = format!("{TEXTS}\n{SCRIPT}");
    let hash = base64(&Sha256::digest(&script));
    let title = text_in(&plan.title, "en").unwrap_or(&plan.name);
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    let parts = [
        ("TITLE", title.as_str()),
        ("HASH", &hash),
        ("STYLE", STYLE),
        ("DATA", &data),
        ("SCRIPT", &script),
    ];
    filled(PAGE, &parts)
}

#[cfg(test)]
pub(super) mod tests;
