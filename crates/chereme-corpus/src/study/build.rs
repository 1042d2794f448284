//! The questionnaire of a study: a folder with one page and its films, which works without a network.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use chereme_figure::{
    AnimationOptions, ClipAnimation, FigureError, FigureView, PictureSequence, RasterImage, SigningReach,
};
use serde::Serialize;
use serde_json::json;
use sha2::{Digest, Sha256};

use super::study_plan::{QuestionKind, StudyPlan, text_in};
use super::{StudyWithAnswers, study_order};
use crate::Corpus;
use crate::atomic_write::write_atomically;
use crate::consent::{ConsentKind, OutputAudience, OutputGate, nothing_passes_error};
use crate::db::seals;
use crate::db::stored_motion::to_hex_text;
use crate::error::{CorpusError, CorpusResult};
use crate::film::{WrittenFilmShape, write_film};
use crate::page::{encode_base64, fill_page_parts};
use crate::progress::{ProgressReceiver, ProgressUnit};

/// The page with places for its parts, its script and its style.
const QUESTIONNAIRE_PAGE_HTML: &str = include_str!("page/index.html");
const QUESTIONNAIRE_SCRIPT: &str = include_str!("page/page.js");
const QUESTIONNAIRE_TEXTS: &str = include_str!("page/texts.js");
const QUESTIONNAIRE_STYLE_CSS: &str = include_str!("page/page.css");

/// The folder of films and pictures beside the page.
const QUESTIONNAIRE_MEDIA_FOLDER: &str = "media";
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
    /// Who will see the films; nothing is built if somebody did not agree to that.
    pub audience: OutputAudience,
}

impl Default for QuestionnaireOptions {
    fn default() -> Self {
        Self {
            height: 540,
            rate: 25,
            force: false,
            audience: OutputAudience::Public,
        }
    }
}

/// A questionnaire that was built.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct BuiltQuestionnaire {
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
    /// Fails if there is no such study, a clip can no longer be made or shows somebody who did not agree to it, or the page exists and `force` is not set; the
    /// folder is as before then.
    pub fn build_study(
        &mut self,
        name: &str,
        to: &Path,
        options: QuestionnaireOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<BuiltQuestionnaire> {
        let study = self.study_with_answers(name)?;
        let page = to.join("index.html");
        if page.exists() && !options.force {
            return Err(CorpusError::from_existing_file(page));
        }
        seals::verify_material(self.store.read_connection())?;
        self.refuse_withheld_clips(&study.plan, options.audience)?;
        let media = to.join(QUESTIONNAIRE_MEDIA_FOLDER);
        let new = !to.exists();
        fs::create_dir_all(&media).map_err(|error| CorpusError::from_file_failure(&media, error))?;
        let mut made = Vec::new();
        let done = self.questionnaire(&study, &page, options, &mut made, progress);
        if done.is_err() {
            // Whatever cannot be removed does no harm: the page is written last.
            made.iter().for_each(|film| drop(fs::remove_file(film)));
            // A folder that was there before belongs to the user.
            if new {
                drop(fs::remove_dir(&media));
                drop(fs::remove_dir(to));
            }
        }
        done
    }

    /// Fails if a clip of a plan shows somebody who did not agree that the audience sees it. A plan without one of its
    /// clips would be another plan, so that nothing is left out.
    fn refuse_withheld_clips(&mut self, plan: &StudyPlan, audience: OutputAudience) -> CorpusResult<()> {
        // Several trials may show the same clip.
        let clips: BTreeSet<&str> = plan.trials.iter().map(|trial| trial.clip.as_str()).collect();
        let gate = OutputGate::open_output_gate(self.store.read_connection(), audience)?;
        let mut errors = Vec::new();
        for text in clips {
            let withheld = match self.study_clip_recording(text) {
                Some(recording) => gate.withheld_output(recording, &[ConsentKind::Movement]),
                None => self.withheld_recipe(text, audience)?,
            };
            errors.extend(withheld.map(|one| nothing_passes_error(&[one], audience)));
        }
        match errors.len() {
            0 => Ok(()),
            1 => Err(errors.remove(0)),
            _ => Err(CorpusError::from_error_list(errors)),
        }
    }

    fn questionnaire(
        &mut self,
        study: &StudyWithAnswers,
        page: &Path,
        options: QuestionnaireOptions,
        made: &mut Vec<PathBuf>,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<BuiltQuestionnaire> {
        let plan = &study.plan;
        let media = page.with_file_name(QUESTIONNAIRE_MEDIA_FOLDER);
        let mut reach: Option<SigningReach> = None;
        // All films share one framing, so the reach of all clips is needed before the first is drawn.
        self.study_clips(plan, progress, |_, it| {
            let clip_reach = SigningReach::reach_from_clip(&it.clip, &it.anatomy);
            reach = match (reach, clip_reach) {
                (Some(all), Some(own)) => Some(all.join_signing_reach(own)),
                (all, own) => all.or(own),
            };
            Ok(())
        })?;
        let mut films: BTreeMap<usize, String> = BTreeMap::new();
        let mut bytes = 0;
        let clips: BTreeSet<&str> = plan.trials.iter().map(|trial| trial.clip.as_str()).collect();
        let total = clips.len() as u64;
        let mut drawn = 0;
        // The second pass reports films drawn instead of clips read.
        let mut unheard = crate::progress::ignore_progress_step;
        let quiet = &mut ProgressReceiver::new(&mut unheard);
        self.study_clips(plan, quiet, |trials, it| {
            let settings = AnimationOptions {
                views: vec![FigureView::Addressee],
                height: options.height,
                rate: Some(options.rate.clamp(1, 120)),
                faces: it.faces,
                framing: reach.and_then(|reach| reach.framing_for_clip(&it.clip, &it.anatomy)),
                bar: false,
                ..AnimationOptions::default()
            };
            let animation = ClipAnimation::new(&it.clip, &it.anatomy, settings).map_err(study_figure_error)?;
            let mut hear = |_, _| progress.report_amount(ProgressUnit::Items, "drawing films", drawn, Some(total));
            let film = encode_study_film(animation, options.rate.clamp(1, 120), &mut hear)?;
            drawn += 1;
            // The name says nothing about the condition, and equal films become one file.
            let name = format!("{}.mp4", &to_hex_text(&Sha256::digest(&film))[..16]);
            let path = media.join(&name);
            // A film of an earlier build must not be removed if this build fails.
            if !path.exists() {
                made.push(path.clone());
            }
            bytes += write_atomically(&path, true, |out| write_page_bytes(out, &film, &path))?;
            for &trial in trials {
                films.insert(trial, name.clone());
            }
            Ok(())
        })?;
        let rows = study_order::trial_order_rows(plan);
        let text = html(study, &films, &rows);
        // The page comes last, so that it never names a film that is missing.
        bytes += write_atomically(page, options.force, |out| write_page_bytes(out, text.as_bytes(), page))?;
        let names: BTreeSet<&String> = films.values().collect();
        if options.force {
            remove_old(&media, &names);
        }
        Ok(BuiltQuestionnaire {
            page: page.to_owned(),
            plan_sha256: study.plan_sha256.clone(),
            films: names.len(),
            bytes,
            orders: rows.len(),
            missing: missing_plan_pictures(plan, &media),
            alike: identical_film_pairs(plan, &films),
        })
    }
}

fn write_page_bytes(out: &mut impl std::io::Write, bytes: &[u8], path: &Path) -> CorpusResult<()> {
    out.write_all(bytes)
        .map_err(|error| CorpusError::from_file_failure(path, error))
}

/// Pictures whose first and last one stand still for a while.
struct HeldPictures<'a> {
    moving: ClipAnimation<'a>,
    still: usize,
}

impl PictureSequence for HeldPictures<'_> {
    fn picture_count(&self) -> usize {
        self.moving.animation_frame_count() + 2 * self.still
    }

    fn picture_size(&self) -> [usize; 2] {
        self.moving.animation_size()
    }

    fn centiseconds(&self) -> u16 {
        PictureSequence::centiseconds(&self.moving)
    }

    fn draw_sequence_picture(&mut self, frame: usize) -> RasterImage {
        let last = self.moving.animation_frame_count() - 1;
        self.moving
            .draw_animation_frame(frame.saturating_sub(self.still).min(last))
    }
}

/// Returns a film of an animation.
fn encode_study_film(
    moving: ClipAnimation<'_>,
    rate: u32,
    hear: &mut dyn FnMut(usize, usize) -> CorpusResult<()>,
) -> CorpusResult<Vec<u8>> {
    let still = (STILL_MS * rate / 1000) as usize;
    let mut film = Vec::new();
    write_film(
        &mut HeldPictures { moving, still },
        WrittenFilmShape { rate },
        &mut film,
        hear,
    )?;
    Ok(film)
}

fn study_figure_error(error: FigureError) -> CorpusError {
    CorpusError::from_wrong_message(error.to_string())
}

/// Removes films of an earlier build: files with names that only a build gives.
fn remove_old(media: &Path, films: &BTreeSet<&String>) {
    let Ok(entries) = fs::read_dir(media) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let hash = name.strip_suffix(".mp4").filter(|stem| stem.len() == 16);
        let built = hash.is_some_and(|stem| stem.bytes().all(|byte| b"0123456789abcdef".contains(&byte)));
        if built && !films.contains(&name) {
            // A film that stays is never shown.
            drop(fs::remove_file(entry.path()));
        }
    }
}

/// Returns the pictures that a plan names and that are not in the folder.
fn missing_plan_pictures(plan: &StudyPlan, media: &Path) -> Vec<PathBuf> {
    let asked = plan.questions.iter().filter_map(|question| match &question.kind {
        QuestionKind::Choice { options } => Some(options),
        QuestionKind::Scale { .. } => None,
    });
    let about = plan.profile.iter().map(|question| &question.options);
    let pictures: BTreeSet<PathBuf> = asked
        .chain(about)
        .flatten()
        .filter_map(|option| option.picture.as_ref())
        .map(|picture| media.join(picture))
        .collect();
    pictures.into_iter().filter(|path| !path.exists()).collect()
}

/// Returns the pairs of clips that gave the same film.
fn identical_film_pairs(plan: &StudyPlan, films: &BTreeMap<usize, String>) -> Vec<[String; 2]> {
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
fn html(study: &StudyWithAnswers, films: &BTreeMap<usize, String>, rows: &[Vec<study_order::ShownTrial>]) -> String {
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
        .map(|row| row.iter().map(|shown| (shown.trial, shown.block)).collect())
        .collect();
    let page_data = json!({
        "study": plan.name, "plan_sha256": study.plan_sha256, "title": plan.title,
        "consent": plan.consent, "questions": plan.questions, "profile": plan.profile,
        "parts": plan.plan_parts(), "trials": trials, "rows": rows,
    });
    // Within a script element only `<` could end it.
    let data = page_data.to_string().replace('<', "\\u003c");
    let script = format!("{QUESTIONNAIRE_TEXTS}\n{QUESTIONNAIRE_SCRIPT}");
    // The policy of the page allows this one script only.
    let hash = encode_base64(&Sha256::digest(&script));
    let plain_title = text_in(&plan.title, "en").unwrap_or(&plan.name);
    let title = plain_title.replace('&', "&amp;").replace('<', "&lt;");
    let parts = [
        ("TITLE", title.as_str()),
        ("HASH", &hash),
        ("STYLE", QUESTIONNAIRE_STYLE_CSS),
        ("DATA", &data),
        ("SCRIPT", &script),
    ];
    fill_page_parts(QUESTIONNAIRE_PAGE_HTML, &parts)
}

#[cfg(test)]
pub(super) mod tests;
