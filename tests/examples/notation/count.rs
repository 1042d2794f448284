//! Counts faults over the signs of a folder, and writes the table between two marks of a file.

use std::collections::BTreeMap;
use std::path::Path;

use chereme_compose::notation::AnimatorSettings;
use chereme_motion::FrameRate;

use crate::faults::{FAULTS, see, stroke_share};
use crate::{Result, bodies};

/// The marks between which the table stands.
const MARKS: [&str; 2] = ["<!-- faults -->", "<!-- /faults -->"];

/// The counts of one fault: signs that have it, and signs in which it could occur.
#[derive(Debug, Default, Clone)]
struct Count {
    found: usize,
    of: usize,
    names: Vec<String>,
}

/// A file for the table of faults.
pub(crate) struct Table<'a> {
    /// The file whose table between the marks is replaced.
    pub(crate) file: &'a Path,
    /// The output of this program for an earlier animator; without it the file's column of earlier counts stays.
    pub(crate) before: Option<&'a Path>,
}

/// Counts every fault over the signs of a folder on a body. `every` thins the signs out.
pub(crate) fn faults(folder: &Path, body: &str, every: usize, into: Option<Table<'_>>) -> Result<()> {
    let stage = bodies::stage(Path::new(body))?;
    let settings = AnimatorSettings {
        rate: FrameRate::new(60, 1)?,
        ..AnimatorSettings::default()
    };
    let mut counts = vec![Count::default(); FAULTS.len()];
    let mut times: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    let mut signs = 0;
    for (name, notated, findings) in bodies::signs_with_findings(folder)?.iter().step_by(every) {
        signs += 1;
        let seen = see(notated, *findings, &stage, &settings)?;
        for (count, (_, judge)) in counts.iter_mut().zip(FAULTS) {
            let Some(found) = judge(&seen) else { continue };
            count.of += 1;
            if found {
                count.found += 1;
                count.names.push(name.clone());
            }
        }
        if seen.moves() {
            let own = seen.dominant();
            let mut add = |what, value| times.entry(what).or_default().push(value);
            let strokes = seen.strokes().into_iter();
            add(
                "peak of the stroke, m/s",
                strokes.map(|span| seen.peak(own, span)).fold(0.0, f64::max),
            );
            if let Some(span) = seen.approach() {
                add("peak of the approach, m/s", seen.peak(own, span));
                add("duration of the approach, s", (span.1 - span.0) as f64 / seen.rate);
            }
            if let Some(share) = stroke_share(&seen) {
                add("share of the strokes", share);
            }
        }
    }
    println!("{signs} signs on {body}");
    for ((what, _), count) in FAULTS.iter().zip(&counts) {
        let some: Vec<&str> = count
            .names
            .iter()
            .step_by(1 + count.names.len() / 8)
            .map(String::as_str)
            .collect();
        println!("{what}: {} of {}: {}", count.found, count.of, some.join(", "));
    }
    let times: Vec<String> = times.into_iter().map(spread).collect();
    let times = times.join("; ");
    println!("{times}");
    if let Some(into) = into {
        let text = std::fs::read_to_string(into.file)?;
        let said = format!("{signs} signs. Of those whose stroke moves the wrist: {times}.");
        let before = into.before.map(std::fs::read_to_string).transpose()?;
        let text = written(&text, &said, &counts, before.as_deref())?;
        std::fs::write(into.file, text)?;
    }
    Ok(())
}

/// Returns the median and the quartiles of some numbers in words.
fn spread((what, mut all): (&str, Vec<f64>)) -> String {
    all.sort_by(f64::total_cmp);
    let at = |share: f64| all[((all.len() - 1) as f64 * share) as usize];
    let [low, middle, high] = [0.25, 0.5, 0.75].map(at);
    format!("{what}: {middle:.2} ({low:.2} to {high:.2})")
}

/// Returns the text with today's counts in the table between the marks, and `said` above it. Counts of an earlier
/// animator come from `before`, the output of this program then, or else from the table in the text.
fn written(text: &str, said: &str, counts: &[Count], before: Option<&str>) -> Result<String> {
    let [open, close] = MARKS;
    let (head, rest) = text.split_once(open).ok_or("the file has no mark <!-- faults -->")?;
    let (old, tail) = rest.split_once(close).ok_or("the file has no mark <!-- /faults -->")?;
    let known: BTreeMap<&str, &str> = match before {
        Some(printed) => printed
            .lines()
            .filter_map(|line| {
                let (what, rest) = line.rsplit_once(": ")?.0.rsplit_once(": ")?;
                Some((what, rest.split_once(" of ")?.0))
            })
            .collect(),
        None => old
            .lines()
            .filter_map(|line| {
                let mut cells = line.trim_matches('|').split('|').map(str::trim);
                Some((cells.next()?, cells.next()?))
            })
            .collect(),
    };
    let earlier = match before {
        Some(_) => "before",
        None => "before, of 325",
    };
    let mut table = format!("\n| fault | {earlier} | today | signs in which it can occur |\n|---|--:|--:|--:|\n");
    for ((what, _), count) in FAULTS.iter().zip(counts) {
        let now = count.found.to_string();
        let before = known.get(what).copied().unwrap_or("–");
        table.push_str(&format!("| {what} | {before} | {now} | {} |\n", count.of));
    }
    Ok(format!("{head}{open}\n{said}\n{table}\n{close}{tail}"))
}
