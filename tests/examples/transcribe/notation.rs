//! Notation to movement to notation.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant as Clock;

use chereme_analysis::transcribe::{Options, Transcription, transcribe};
use chereme_compose::notation::{Settings, animate};
use chereme_motion::Span;
use chereme_sign::hamnosys::{Manual, Sign};

use crate::Result;
use crate::bodies;
use crate::compare::compare;

/// Prints how often each feature is found again; with `why` also where it is not.
pub(crate) fn table(folder: &Path, body: &Path, why: Option<&str>) -> Result<()> {
    let stage = bodies::stage(body)?;
    let (settings, options) = (Settings::default(), Options::default());
    let mut counts: BTreeMap<&'static str, (usize, usize)> = BTreeMap::new();
    let mut reached = counts.clone();
    let (mut parts, mut whole, mut failed, mut slow) = (0, 0, 0, 0.0_f64);
    let mut spent = 0.0;
    for (name, entry) in bodies::signs(folder)? {
        for part in &entry.sign.parts {
            let Some((found, short, seconds)) = again(part, &entry, &stage, &settings, &options)
            else {
                failed += 1;
                continue;
            };
            parts += 1;
            whole += usize::from(!short);
            spent += seconds;
            slow = slow.max(seconds);
            if why == Some("show") {
                show(&name, part, &found);
            }
            let found = found.sign.parts.into_iter().next().unwrap_or_default();
            for verdict in compare(part, &found) {
                let count = counts.entry(verdict.feature).or_default();
                count.0 += usize::from(verdict.agrees);
                count.1 += 1;
                let asked = why.is_some_and(|why| why == verdict.feature || why == "all");
                if asked && !verdict.agrees {
                    println!(
                        "{}{}\t{name}: {}   <>   {}",
                        verdict.feature,
                        if short { " (short)" } else { "" },
                        verdict.written,
                        verdict.found
                    );
                }
                if !short {
                    let count = reached.entry(verdict.feature).or_default();
                    count.0 += usize::from(verdict.agrees);
                    count.1 += 1;
                }
            }
        }
    }
    println!("{parts} parts of signs, {whole} of them reached by the body, {failed} not made");
    println!(
        "transcribed in {:.1} ms each, {:.1} ms at most",
        1e3 * spent / parts.max(1) as f64,
        1e3 * slow
    );
    println!("| feature | agree | of | share | where the body reaches it |\n|---|---|---|---|---|");
    for (feature, (agree, of)) in counts {
        let share = |(agree, of): (usize, usize)| 100.0 * agree as f64 / of as f64;
        let own = share(reached.get(feature).copied().unwrap_or((0, 1)));
        println!(
            "| {feature} | {agree} | {of} | {:.1} % | {own:.1} % |",
            share((agree, of))
        );
    }
    Ok(())
}

/// Animates a part of a sign alone and transcribes it; returns what was found, whether the body
/// fell short of what is written, and the seconds it took.
fn again(
    part: &Manual,
    entry: &chereme_sign::hamnosys::Notated,
    stage: &chereme_compose::Material,
    settings: &Settings,
    options: &Options,
) -> Option<(Transcription, bool, f64)> {
    let mut alone = entry.clone();
    alone.sign = Sign {
        parts: vec![Manual {
            holdover: false,
            ..part.clone()
        }],
    };
    let made = animate(&[&alone], stage, settings).ok()?;
    let span: Span = made
        .notes
        .iter()
        .find(|note| note.about == chereme_compose::About::Gloss)?
        .span;
    let rate = made.clip.rate();
    let (first, last) = (rate.frame_at(span.start()), rate.frame_at(span.end()));
    let clip = made.clip.slice(first..last + 1);
    let began = Clock::now();
    let found = transcribe(&clip, &made.anatomy, options).ok()?;
    let seconds = began.elapsed().as_secs_f64();
    let short = made.report.warnings.iter().any(|warning| {
        [
            "less than written",
            "short of its place",
            "out of the trunk",
        ]
        .iter()
        .any(|words| warning.contains(words))
    });
    Some((found, short, seconds))
}

fn show(name: &str, part: &Manual, found: &Transcription) {
    println!("== {name}");
    let own = found.sign.parts.first().cloned().unwrap_or_default();
    for verdict in compare(part, &own) {
        let mark = if verdict.agrees { ' ' } else { '*' };
        println!(
            " {mark} {}: {}  <>  {}",
            verdict.feature, verdict.written, verdict.found
        );
    }
    for feature in &found.features {
        let next = feature
            .runner_up
            .as_ref()
            .map(|next| format!("{} {:.1}", next.value, next.residual));
        println!(
            "   {:?} @{} {:?} {}: {} {:.2}{} | {}",
            feature.action,
            feature.frame,
            feature.hand,
            feature.kind.name(),
            feature.value,
            feature.residual,
            feature.unit.sign(),
            next.unwrap_or_default()
        );
    }
}
