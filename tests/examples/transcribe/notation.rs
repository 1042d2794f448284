//! Closed loop from notation: animates it, transcribes the movement, and counts the features that agree.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant as Clock;

use chereme_analysis::transcribe::{
    NotationSynthesiser, TokenTranscription, TranscribeOptions, transcribe_clip, transcribe_proven,
};
use chereme_compose::notation::{AnimatorSettings, SignPerformer, animate_signs};
use chereme_compose::{GeneratedMovement, MovementMaterial};
use chereme_motion::{BodyAnatomy, Clip, FrameRate, TimeSpan};
use chereme_sign::hamnosys::{HamnosysSign, ManualPart, NotatedSign, parse_hamnosys};

use crate::Result;
use crate::bodies;
use crate::compare::{Verdict, compare};

/// The output besides the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum More<'a> {
    Nothing,
    /// The table alone, with places read without re-synthesis.
    Plain,
    /// The table alone, from the whole movement exported as BVH and read like any other capture.
    Blind,
    /// As `Blind`, with every disagreement about a feature in the half used for tuning.
    BlindWhy(&'a str),
    /// Every disagreement about a feature, about `all`, or every sign with `show`; only in the half used for tuning.
    Why(&'a str),
    /// As `Plain`, with every disagreement about a feature in the half used for tuning.
    PlainWhy(&'a str),
    /// The confusions and their counts, in the half used for tuning.
    Confusions(&'a str),
    /// The same, for movement exported as BVH.
    BlindConfusions(&'a str),
    /// The same, without re-synthesis.
    PlainConfusions(&'a str),
}

impl More<'_> {
    /// Returns whether the whole movement is exported and read like any other capture.
    fn is_blind(self) -> bool {
        matches!(self, Self::Blind | Self::BlindWhy(_) | Self::BlindConfusions(_))
    }

    /// Returns whether places are read without re-synthesis.
    fn is_plain(self) -> bool {
        matches!(self, Self::Plain | Self::PlainWhy(_) | Self::PlainConfusions(_))
    }
}

/// Counts of agreement and of cases for one feature: in all signs, in those that the body can perform fully, and in each
/// half of the signs.
#[derive(Debug, Clone, Copy, Default)]
struct Counts([(usize, usize); 4]);

impl Counts {
    fn add(&mut self, agrees: bool, which: [bool; 4]) {
        for (count, _) in self.0.iter_mut().zip(which).filter(|(_, is)| *is) {
            count.0 += usize::from(agrees);
            count.1 += 1;
        }
    }

    fn share(&self, n: usize) -> f64 {
        100.0 * self.0[n].0 as f64 / self.0[n].1 as f64
    }
}

/// Prints how often each feature is found again.
pub(crate) fn table(
    (folder, every): (&Path, usize),
    body: &Path,
    (rate, settings): (Option<u32>, AnimatorSettings),
    more: More<'_>,
) -> Result<()> {
    let stage = bodies::stage(body)?;
    let settings = AnimatorSettings {
        rate: match rate {
            Some(rate) => FrameRate::new(rate, 1)?,
            None => stage.clip.clip_frame_rate(),
        },
        ..settings
    };
    let options = match more.is_blind() {
        true => TranscribeOptions::default(),
        false => TranscribeOptions::synthesised_options(),
    };
    let mut counts: BTreeMap<&'static str, Counts> = BTreeMap::new();
    let mut confusions: BTreeMap<(String, String), usize> = BTreeMap::new();
    let (mut parts, mut whole, mut failed, mut slow) = (0, 0, 0, 0.0_f64);
    let mut spent = 0.0;
    let signs = read_signs(folder)?;
    let todo = parts_of(&signs, every, |name| {
        matches!(more, More::Nothing | More::Plain | More::Blind) || is_tuned_on(name)
    });
    let seen = seen(&todo, |(name, entry, part)| {
        let again = again(part, entry, &stage, (&settings, &options), more)?;
        Some(Seen {
            short: again.short,
            seconds: again.seconds,
            verdicts: compare(part, &again),
            shown: (more == More::Why("show")).then(|| show(name, part, &again)),
        })
    });
    for ((name, ..), seen) in todo.iter().zip(seen) {
        let Some(seen) = seen else {
            failed += 1;
            continue;
        };
        let (short, tuned) = (seen.short, is_tuned_on(name));
        parts += 1;
        whole += usize::from(!short);
        spent += seen.seconds;
        slow = slow.max(seen.seconds);
        print!("{}", seen.shown.unwrap_or_default());
        for verdict in seen.verdicts {
            let count = counts.entry(verdict.feature).or_default();
            count.add(verdict.agrees, [true, !short, tuned, !tuned]);
            match more {
                More::Confusions(of) | More::BlindConfusions(of) | More::PlainConfusions(of)
                    if of == verdict.feature =>
                {
                    let mark = if verdict.agrees { "= " } else { "" };
                    // Each distance belongs to one sign.
                    let found = verdict.found.split('\t').next().unwrap_or_default();
                    let pair = (verdict.written, format!("{mark}{found}"));
                    *confusions.entry(pair).or_default() += 1;
                }
                More::Why(of) | More::BlindWhy(of) | More::PlainWhy(of)
                    if !verdict.agrees && [verdict.feature, "all"].contains(&of) =>
                {
                    println!(
                        "{}{}\t{name}: {}   <>   {}",
                        verdict.feature,
                        if short { " (short)" } else { "" },
                        verdict.written,
                        verdict.found
                    );
                }
                _ => {}
            }
        }
    }
    let mut confusions: Vec<_> = confusions.into_iter().collect();
    confusions.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    for ((written, found), count) in confusions {
        println!("{count:5}  {written}  ->  {found}");
    }
    println!("{parts} parts of signs, {whole} of them reached by the body, {failed} not made");
    println!(
        "transcribed in {:.1} ms each, {:.1} ms at most",
        1e3 * spent / parts.max(1) as f64,
        1e3 * slow
    );
    println!("| feature | agree | of | share | where the body reaches it | tuned on | held out |");
    println!("|---|---|---|---|---|---|---|");
    for (feature, counts) in counts {
        let (agree, of) = counts.0[0];
        let shares: Vec<String> = (0..4)
            .filter(|&n| counts.0[n].1 > 0)
            .map(|n| format!("{:.1} %", counts.share(n)))
            .collect();
        println!("| {feature} | {agree} | {of} | {} |", shares.join(" | "));
    }
    Ok(())
}

/// Reads the signs of a folder or of a text file.
pub(crate) fn read_signs(folder: &Path) -> Result<Vec<(String, NotatedSign)>> {
    match folder.is_dir() {
        true => bodies::signs(folder),
        false => lines(folder),
    }
}

/// Returns the parts of one sign in `every`, of those whose name is wanted.
pub(crate) fn parts_of(
    signs: &[(String, NotatedSign)],
    every: usize,
    wanted: impl Fn(&str) -> bool,
) -> Vec<(&str, &NotatedSign, &ManualPart)> {
    let some = signs.iter().step_by(every).filter(|(name, _)| wanted(name));
    let parts = some.flat_map(|(name, entry)| {
        let parts = entry.sign.parts.iter();
        parts.map(move |part| (&**name, entry, part))
    });
    parts.collect()
}

/// Reads the signs of a text file with one sign in HamNoSys characters on each line; the rest of a line is ignored.
fn lines(file: &Path) -> Result<Vec<(String, NotatedSign)>> {
    let text = std::fs::read_to_string(file)?;
    let mut all = Vec::new();
    for line in text.lines() {
        let of_hamnosys = |symbol: &char| ('\u{e000}'..='\u{f0ff}').contains(symbol);
        let symbols: String = line.chars().filter(of_hamnosys).collect();
        let known = all.iter().any(|(name, _)| *name == symbols);
        if let Ok(parsed) = parse_hamnosys(&symbols)
            && !symbols.is_empty()
            && !known
        {
            let sign = NotatedSign {
                sign: parsed.sign,
                ..NotatedSign::default()
            };
            all.push((symbols, sign));
        }
    }
    Ok(all)
}

/// Returns whether a sign belongs to the half for tuning thresholds, by a hash of its name (FNV-1a).
fn is_tuned_on(name: &str) -> bool {
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    (hash >> 32) & 1 == 0
}

/// The record of a part of a sign.
struct Seen {
    short: bool,
    seconds: f64,
    verdicts: Vec<Verdict>,
    shown: Option<String>,
}

/// Calls `does` on each item, on all cores of the machine; the results are in the order of the items.
pub(crate) fn seen<T: Sync, R: Send>(all: &[T], does: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let (next, does) = (&AtomicUsize::new(0), &does);
    let mut seen: Vec<(usize, R)> = std::thread::scope(|scope| {
        let work = move || {
            let own = std::iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
            let own = own.take_while(|n| *n < all.len());
            own.map(|n| (n, does(&all[n]))).collect::<Vec<_>>()
        };
        let work: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let done = work.into_iter().map(|work| work.join().expect("no panic"));
        done.flatten().collect()
    });
    seen.sort_by_key(|(n, _)| *n);
    seen.into_iter().map(|(_, seen)| seen).collect()
}

/// Performs notation for the transcriber.
struct Performed(SignPerformer);

impl NotationSynthesiser for Performed {
    fn synthesise_first_posture(&self, sign: &NotatedSign) -> Option<Clip> {
        self.0.perform_first_posture(sign).ok()
    }

    fn synthesise_notated_sign(&self, sign: &NotatedSign) -> Option<Clip> {
        self.0.perform_sign(sign).ok()
    }
}

/// The result for a part of a sign.
pub(crate) struct Again {
    pub(crate) found: TokenTranscription,
    /// The sign without the movements from and to rest.
    pub(crate) clip: Clip,
    pub(crate) anatomy: Arc<BodyAnatomy>,
    /// Whether the body could not perform the notation completely.
    pub(crate) short: bool,
    /// The frame in which the animator reaches the first posture, if the transcriber had to find it.
    pub(crate) begins: Option<usize>,
    /// The time of the transcription.
    pub(crate) seconds: f64,
}

/// Animates a part of a sign alone.
pub(crate) fn made(
    part: &ManualPart,
    entry: &NotatedSign,
    stage: &MovementMaterial,
    settings: &AnimatorSettings,
) -> Option<GeneratedMovement> {
    let mut alone = entry.clone();
    alone.sign = HamnosysSign {
        parts: vec![ManualPart {
            holdover: false,
            ..part.clone()
        }],
    };
    animate_signs(&[&alone], stage, settings).ok()
}

/// Returns the span of the sign itself, without the movements from and to rest.
pub(crate) fn sign_span(made: &GeneratedMovement) -> Option<TimeSpan> {
    let mut notes = made.notes.iter();
    let gloss = notes.find(|note| note.about == chereme_compose::NoteSubject::Gloss);
    gloss.map(|note| note.span)
}

/// Animates a part of a sign alone and transcribes it.
fn again(
    part: &ManualPart,
    entry: &NotatedSign,
    stage: &MovementMaterial,
    (settings, options): (&AnimatorSettings, &TranscribeOptions),
    more: More<'_>,
) -> Option<Again> {
    let made = made(part, entry, stage, settings)?;
    let span = sign_span(&made)?;
    if more.is_blind() {
        return blind(made, span, options);
    }
    let rate = made.clip.clip_frame_rate();
    let (first, last) = (
        rate.nearest_frame_at(span.span_start_instant()),
        rate.nearest_frame_at(span.span_end_instant()),
    );
    let clip = made.clip.slice_clip_frames(first..last + 1);
    let began = Clock::now();
    let performs = Performed(SignPerformer::new(stage.clone(), settings.clone()).ok()?);
    let found = match more.is_plain() {
        true => transcribe_clip(&clip, &made.anatomy, options).ok()?,
        false => transcribe_proven(&clip, &made.anatomy, options, &performs).ok()?,
    };
    let seconds = began.elapsed().as_secs_f64();
    let short = is_short(&made);
    Some(Again {
        found,
        clip,
        anatomy: made.anatomy,
        short,
        begins: None,
        seconds,
    })
}

/// Exports movement as BVH, imports it without its notation, and transcribes it like a capture.
fn blind(made: GeneratedMovement, span: TimeSpan, options: &TranscribeOptions) -> Option<Again> {
    let short = is_short(&made);
    let begins = made.clip.clip_frame_rate().nearest_frame_at(span.span_start_instant());
    let (clip, anatomy) = bodies::again(&made.clip, bodies::DECIMALS).ok()?;
    let began = Clock::now();
    let found = transcribe_clip(&clip, &anatomy, options).ok()?;
    let seconds = began.elapsed().as_secs_f64();
    Some(Again {
        found,
        clip,
        anatomy,
        short,
        begins: Some(begins),
        seconds,
    })
}

/// Returns whether the animator reports that the body fell short of the notation.
pub(crate) fn is_short(made: &GeneratedMovement) -> bool {
    made.report.warnings.iter().any(|warning| {
        ["less than written", "short of its place", "out of the trunk"]
            .iter()
            .any(|words| warning.contains(words))
    })
}

fn show(name: &str, part: &ManualPart, again: &Again) -> String {
    let mut text = format!("== {name}\n");
    for verdict in compare(part, again) {
        let mark = if verdict.agrees { ' ' } else { '*' };
        text += &format!(
            " {mark} {}: {}  <>  {}\n",
            verdict.feature, verdict.written, verdict.found
        );
    }
    for feature in &again.found.features {
        let next = feature
            .runner_up
            .as_ref()
            .map(|next| format!("{} {:.1}", next.value, next.residual));
        text += &format!(
            "   {:?} @{} {:?} {}: {} {:.2}{} | {}\n",
            feature.action,
            feature.frame,
            feature.hand,
            feature.kind.feature_kind_name(),
            feature.value,
            feature.residual,
            feature.unit.residual_unit_symbol(),
            next.unwrap_or_default()
        );
    }
    text
}
