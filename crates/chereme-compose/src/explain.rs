//! Explains a generated sign to people: its steps, the source of each channel, joins, residuals.

use std::fmt::{self, Display, Formatter};

use crate::outcome::GenerationReport;

/// Returns the text of a step or recipe in one line for people: its two ends if it is long, such as the text of a fable.
#[must_use]
pub fn shorten_step_text(step: &str) -> String {
    const MAX_BRIEF_CHARS: usize = 160;
    const BRIEF_END_CHARS: usize = 40;
    let line = |letter: char| if letter == '\n' { ' ' } else { letter };
    let letters = step.chars().count();
    if letters <= MAX_BRIEF_CHARS {
        return step.chars().map(line).collect();
    }
    let first: String = step.chars().take(MAX_BRIEF_CHARS - BRIEF_END_CHARS).map(line).collect();
    let last: String = step.chars().skip(letters - BRIEF_END_CHARS).map(line).collect();
    format!("{first} … {last}")
}

impl Display for GenerationReport {
    /// Writes the report as indented lines; a step without a residual has no target to miss.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let scaled = self.steps.iter().any(|step| step.residual.is_some());
        let scale = " (residual: the largest distance of a wrist from its goal)";
        writeln!(f, "steps{}", if scaled { scale } else { "" })?;
        for step in &self.steps {
            write!(f, "  {}", shorten_step_text(&step.step))?;
            if let Some(residual) = step.residual {
                write!(f, "   (residual {:.2} mm)", residual * 1000.0)?;
            }
            writeln!(f)?;
            step.did.iter().try_for_each(|did| writeln!(f, "    {did}"))?;
        }
        writeln!(f, "channels")?;
        for channel in &self.channels {
            writeln!(f, "  {:14} {}", channel.channel, channel.from.join(" | "))?;
        }
        if !self.joins.is_empty() {
            writeln!(f, "joins")?;
        }
        for join in &self.joins {
            writeln!(
                f,
                "  {:5} {}–{}: position {:.1} mm, change of velocity {:.2} m/s, of acceleration {:.0} m/s²   ({})",
                join.hand.body_side_name(),
                join.span.span_start_instant(),
                join.span.span_end_instant(),
                join.position * 1000.0,
                join.velocity,
                join.acceleration,
                join.what
            )?;
        }
        if !self.contacts.is_empty() {
            writeln!(f, "contacts undone")?;
        }
        self.contacts
            .iter()
            .try_for_each(|contact| writeln!(f, "  {contact}"))?;
        if !self.warnings.is_empty() {
            writeln!(f, "warnings")?;
        }
        self.warnings.iter().try_for_each(|warning| writeln!(f, "  {warning}"))
    }
}

#[cfg(test)]
mod tests {
    use super::shorten_step_text;

    #[test]
    fn a_long_step_is_shortened_and_its_lines_are_joined() {
        let short = "cue \"le chat dort\" dominant";
        assert_eq!(shorten_step_text(short), short);
        assert_eq!(shorten_step_text("cue \"le chat\ndort\""), "cue \"le chat dort\"");
        let long = shorten_step_text(&format!("cue \"{}\" dominant", "été\n".repeat(1000)));
        assert_eq!(long.chars().count(), 163);
        assert!(
            long.starts_with("cue \"été été") && long.ends_with("\" dominant"),
            "{long}"
        );
    }
}
