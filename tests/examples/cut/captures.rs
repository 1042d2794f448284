//! Takes of the starter corpus with their tokens, and captures whose cuts are printed.

use std::path::Path;
use std::sync::Arc;

use chereme_analysis::cut::{CutOptions, cut_take};
use chereme_corpus::{Corpus, ImportOptions, ListFilter, ListKind, ProgressReceiver, ignore_progress_step};
use chereme_motion::ends::ClipEnds;
use chereme_motion::{RecordingInstant, TimeSpan};

use crate::{Result, TrueTake, bodies};

/// Returns the takes of the starter corpus that have tokens.
pub(crate) fn starter_takes() -> Result<Vec<TrueTake>> {
    let folder = tempfile::tempdir()?;
    for (path, bytes) in chereme_corpus::starter_files() {
        std::fs::write(folder.path().join(path), bytes)?;
    }
    let mut corpus = Corpus::create_corpus(&folder.path().join("starter.chereme"), "cut")?;
    let mut hear = ignore_progress_step;
    let paths = [folder.path().to_owned()];
    corpus.import_paths(&paths, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))?;
    let mut takes: Vec<TrueTake> = Vec::new();
    for row in corpus.list_rows(ListKind::Tokens, &ListFilter::default())?.rows {
        let (Some(name), Some(start), Some(end)) = (
            row["recording"].as_str(),
            row["start_us"].as_i64(),
            row["end_us"].as_i64(),
        ) else {
            continue;
        };
        let sign = TimeSpan::span_between(RecordingInstant::from_micros(start), RecordingInstant::from_micros(end));
        if let Some(take) = takes.iter_mut().find(|take| take.name == name) {
            take.signs.push(sign);
            continue;
        }
        let path = folder.path().join(format!("{name}.bvh"));
        if path.exists() {
            let movement = bodies::movement(&path)?;
            takes.push(TrueTake {
                name: name.to_owned(),
                clip: movement.clip,
                anatomy: Arc::unwrap_or_clone(movement.anatomy),
                signs: vec![sign],
            });
        }
    }
    Ok(takes)
}

/// Prints the signs and phases that are cut out of captures.
pub(crate) fn print_cuts(files: &[&str]) -> Result<()> {
    for file in files {
        let movement = bodies::movement(Path::new(file))?;
        let sound = ClipEnds::examine_clip_ends(&movement.clip, &movement.anatomy).sound;
        let clip = movement.clip.slice_clip_frames(sound.clone());
        println!("{file}: frames {sound:?}, {:.2} s", clip.clip_span().span_seconds());
        match cut_take(&clip, &movement.anatomy, CutOptions::default()) {
            Err(reason) => println!("  {reason}"),
            Ok(cut) => {
                for sign in cut.signs {
                    let hands = if sign.is_two_handed {
                        "both"
                    } else {
                        sign.dominant.body_side_name()
                    };
                    println!(
                        "  {} {:?} {hands} {:.2}",
                        seconds(sign.span),
                        sign.rule,
                        sign.confidence
                    );
                }
                for (side, phases) in ["right", "left"].into_iter().zip(cut.phases) {
                    for phase in phases {
                        println!("    {side} {} {}", seconds(phase.span), phase.kind.phase_name());
                    }
                }
            }
        }
    }
    Ok(())
}

fn seconds(span: TimeSpan) -> String {
    let (start, end) = (span.span_start_instant(), span.span_end_instant());
    format!("{:.2} to {:.2}", start.instant_seconds(), end.instant_seconds())
}
