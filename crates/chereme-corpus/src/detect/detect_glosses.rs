//! Takes whose file names are glosses: each gets one token, over the sign that is found in its movement.

use chereme_analysis::detect::{DetectedSubject, SignDetector};
use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;
use chereme_sign::{ErrorRemedy, TierRole};
use rusqlite::Connection;

use super::{DetectionOutcome, propose_for_recording};
use crate::address::{self, RowName};
use crate::annotate::{AnnotateOptions, AnnotationAction, NewTier, TierRequestName, write_tiers};
use crate::db::{signs, stored_recordings, stored_tiers};
use crate::error::CorpusResult;
use crate::import::{FileStatus, ImportCompletion, ImportReport};
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::report_finding::ReportFinding;

/// A cost of a sign at which every activity is one sign.
const ONE_SIGN_COST: f64 = 1e9;

/// The tier of the glosses.
const GLOSS_TIER: &str = "gloss";

/// Gives each imported take that moves and has no token one over its sign; its gloss is the name of the take.
pub const GLOSSES_FROM_NAMES: ImportCompletion = ImportCompletion(add_glosses_from_names);

/// Adds a token to each imported recording that moves and has none; its gloss is the recording's name.
fn add_glosses_from_names(
    connection: &Connection,
    report: &mut ImportReport,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let total = report.files.len() as u64;
    for (done, file) in report.files.iter_mut().enumerate() {
        let (FileStatus::Imported, Some(name)) = (file.status, &file.recording) else {
            continue;
        };
        progress.report_amount(ProgressUnit::Items, name, done as u64, Some(total))?;
        let row = address::find_recording_by_name(connection, &RowName::Text(name.clone()))?;
        let moves = stored_recordings::body_track(connection, row.id)?.is_some();
        // Tokens that came with a file say more than its name.
        if !moves || !signs::tokens_of_recording(connection, row.id)?.is_empty() {
            continue;
        }
        let one_sign = SignDetector {
            sign_cost: Some(ONE_SIGN_COST),
        };
        let mut sign_times: Vec<[i64; 2]> = Vec::new();
        let mut reason = None;
        match propose_for_recording(connection, &one_sign, &row)? {
            DetectionOutcome::Found(proposals) => {
                let found_signs = proposals
                    .iter()
                    .filter(|proposal| proposal.subject == DetectedSubject::Sign);
                sign_times.extend(found_signs.map(|sign| [sign.start_us, sign.end_us]));
            }
            DetectionOutcome::Nothing(why) => reason = Some(why),
            DetectionOutcome::Unobserved => {}
        }
        // Several activities between rests are one sign and false starts; the longest is most likely the
        // sign.
        let longest = sign_times.iter().max_by_key(|[start, end]| end - start);
        if let (None, Some(why)) = (longest, reason) {
            let text = format!("no sign was found, so the gloss covers the whole take: {why}");
            file.findings.push(ReportFinding::finding_note(text));
        } else if sign_times.len() > 1 {
            let text = format!(
                "{} signs were found between rests; the gloss covers the longest one",
                sign_times.len()
            );
            let remedy = ErrorRemedy::command_remedy("`chereme detect CORPUS signs in RECORDING` shows all of them");
            file.findings.push(ReportFinding::finding_warning(text, remedy));
        }
        let [start, end] = longest.copied().unwrap_or([0, row.duration_us]);
        let recording = RowName::Number(row.id);
        let mut known_tiers = stored_tiers::load_tier_rows(connection, row.id)?.into_iter();
        let known_tier = known_tiers.find(|tier| tier.name == GLOSS_TIER);
        let new_tier = known_tier
            .is_none()
            .then(|| NewTier::new(recording.clone(), GLOSS_TIER, TierRole::Gloss));
        let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
        let add = AnnotationAction::Add {
            tier: TierRequestName::Of {
                recording,
                tier: GLOSS_TIER.to_owned(),
            },
            start: time(start),
            end: time(end),
            parent: None,
            order: None,
            value: row.name.clone(),
            confidence: None,
        };
        for (what, count) in [("tiers", new_tier.iter().len()), ("annotations", 1), ("tokens", 1)] {
            *report.created.entry(what).or_default() += count as u64;
        }
        write_tiers(
            connection,
            new_tier.as_slice(),
            &[add.into()],
            &AnnotateOptions::default(),
            progress,
        )?;
    }
    Ok(())
}
