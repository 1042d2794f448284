//! Markdown tables with notes on what they show and do not show, and rank correlation.

/// Tables in order.
#[derive(Default)]
pub(crate) struct Tables(String);

impl Tables {
    /// Adds a table with notes on what it shows and cannot show.
    pub(crate) fn add(&mut self, title: &str, head: &[&str], rows: Vec<Vec<String>>, says: [&str; 2]) {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let head: Vec<String> = head.iter().map(|it| (*it).to_owned()).collect();
        let rule = vec!["---".to_owned(); head.len()];
        self.0
            .push_str(&format!("## {title}\n\n{}{}", line(&head), line(&rule)));
        for row in rows {
            self.0.push_str(&line(&row));
        }
        let [shows, not] = says;
        self.0
            .push_str(&format!("\n**Shows:** {shows}\n\n**Does not show:** {not}\n\n"));
    }

    /// Returns the whole text.
    pub(crate) fn text(&self) -> String {
        format!("# Faces, from capture to choice\n\n{}", self.0)
    }
}

/// Cuts the text of the results into the tables of the experiment and the section on speed.
pub(crate) fn sections(text: &str) -> (String, String) {
    let at = text.find("## Speed").unwrap_or(text.len());
    (text[..at].to_owned(), text[at..].to_owned())
}

/// Returns Spearman's rank correlation; equal values share the mean of their ranks.
pub(crate) fn rho(a: &[f64], b: &[f64]) -> f64 {
    let (a, b) = (ranks(a), ranks(b));
    let mean = (a.len() as f64 + 1.0) / 2.0;
    let (mut both, mut own_a, mut own_b) = (0.0, 0.0, 0.0);
    for (a, b) in a.iter().zip(&b) {
        both += (a - mean) * (b - mean);
        own_a += (a - mean).powi(2);
        own_b += (b - mean).powi(2);
    }
    both / (own_a * own_b).sqrt()
}

fn ranks(values: &[f64]) -> Vec<f64> {
    let rank = |value: &f64| {
        let below = values.iter().filter(|other| *other < value).count();
        let same = values.iter().filter(|other| *other == value).count();
        below as f64 + (same as f64 + 1.0) / 2.0
    };
    values.iter().map(rank).collect()
}
