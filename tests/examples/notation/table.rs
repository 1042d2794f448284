//! Checks every sign on every body: the conditions that hold, the largest errors, the computing time.

use std::path::Path;
use std::time::Instant;

use chereme_compose::notation::{AnimatorSettings, animate_signs};
use chereme_motion::FrameRate;

use crate::checks::{Worst, worst};
use crate::{Result, bodies};

/// A fault: its name, the size above which it counts, and the function that returns its size.
type Judged = (&'static str, f64, fn(&Worst) -> f64);

impl Worst {
    /// Returns the worse value of both for each fault.
    fn and(self, other: Self) -> Self {
        Self {
            nan: self.nan + other.nan,
            bone: self.bone.max(other.bone),
            wrist: self.wrist.max(other.wrist),
            turn: self.turn.max(other.turn),
            hand_depth: self.hand_depth.max(other.hand_depth),
            elbow_depth: self.elbow_depth.max(other.elbow_depth),
            deepest: 0.0,
            speed: self.speed.max(other.speed),
            elbow_speed: self.elbow_speed.max(other.elbow_speed),
            turning: self.turning.max(other.turning),
            above: self.above.max(other.above),
        }
    }
}

/// Prints a line for each sign, with tabs between.
pub(crate) fn list(folder: &Path, path: &str) -> Result<()> {
    let stage = bodies::stage(Path::new(path))?;
    let settings = AnimatorSettings {
        rate: FrameRate::new(120, 1)?,
        ..AnimatorSettings::default()
    };
    println!("sign\thand depth\telbow depth\tdeepest\twrist\tforearm\tspeed\tturning\tabove\tsaid");
    for (name, notated) in &bodies::signs(folder)? {
        let made = animate_signs(&[notated], &stage, &settings)?;
        let own = worst(&made);
        println!(
            "{name}\t{:.4}\t{:.4}\t{:.2}\t{:.3}\t{:.3}\t{:.2}\t{:.1}\t{:.3}\t{}",
            own.hand_depth,
            own.elbow_depth,
            own.deepest,
            own.wrist,
            own.turn,
            own.speed,
            own.turning,
            own.above,
            made.report.warnings.join("; ")
        );
    }
    Ok(())
}

/// Returns the angle in degrees between the hands' reported and written directions.
pub(crate) fn turned_by(warnings: &[String]) -> f64 {
    let degrees = warnings.iter().filter_map(|warning| {
        let (_, rest) = warning.split_once("turned up to ")?;
        rest.split_once('°')?.0.parse().ok()
    });
    degrees.fold(0.0, f64::max)
}

/// Prints the conditions for all signs on each body.
pub(crate) fn print(folder: &Path, paths: &[&str]) -> Result<()> {
    let signs = bodies::signs(folder)?;
    for path in paths {
        let stage = bodies::stage(Path::new(path))?;
        let settings = AnimatorSettings {
            rate: FrameRate::new(120, 1)?,
            ..AnimatorSettings::default()
        };
        let mut all = Worst::default();
        let (mut frames, mut failed, mut short, mut off) = (0, 0, 0, 0);
        let (mut turned, mut reported, mut pushed, mut other) = (0, 0, 0, 0);
        let mut spent = std::time::Duration::ZERO;
        let mut list: Vec<(String, Worst)> = Vec::new();
        for (name, notated) in &signs {
            let start = Instant::now();
            let made = match animate_signs(&[notated], &stage, &settings) {
                Ok(made) => made,
                Err(error) => {
                    println!("{name}: {error}");
                    failed += 1;
                    continue;
                }
            };
            spent += start.elapsed();
            frames += made.clip.clip_frame_count();
            let warned = |word: &str| usize::from(made.report.warnings.iter().any(|w| w.contains(word)));
            short += warned("short of its contact");
            off += warned("off its path");
            let most = turned_by(&made.report.warnings);
            turned += usize::from(most > 22.5);
            reported += usize::from(most > 0.0);
            pushed += warned("out of the trunk");
            other += warned("the part in front of the named one");
            let own = worst(&made);
            list.push((name.clone(), own));
            all = all.and(own);
        }
        println!("{path}: {} joints", stage.clip.clip_skeleton().len());
        println!(
            "  {} signs, {failed} failed, {frames} frames, {:.0} frames a second",
            signs.len(),
            frames as f64 / spent.as_secs_f64()
        );
        println!(
            "  short of what they touch {short}, touch with the part in front {other}, off their way {off}, turned by more than 22.5° {turned}, by more than 10° {reported}, moved out of the trunk {pushed}"
        );
        println!("  worst: {all:?}");
        let by: [Judged; 7] = [
            ("hand in the trunk", 0.01, |worst| worst.hand_depth),
            ("elbow in the trunk", 0.01, |worst| worst.elbow_depth),
            ("elbow above its shoulder", 0.03, |worst| worst.above),
            ("speed", 6.0, |worst| worst.speed),
            ("turning", 45.0, |worst| worst.turning),
            ("wrist", 1.02, |worst| worst.wrist),
            ("forearm", 1.02, |worst| worst.turn),
        ];
        for (what, limit, of) in by {
            list.sort_by(|a, b| of(&b.1).total_cmp(&of(&a.1)));
            let over = list.iter().filter(|(_, worst)| of(worst) > limit).count();
            let first = list
                .iter()
                .take(6)
                .map(|(name, worst)| format!("{name} {:.2}", of(worst)));
            println!(
                "  {what} over {limit}: {over}: {}",
                first.collect::<Vec<_>>().join(", ")
            );
        }
    }
    Ok(())
}
