//! Heights of elbows while hands sign.

use crate::phases::spread;
use crate::take::Take;

/// Bands of heights of the wrist above its shoulder (m) in which elbows are compared, with the part of the body at each.
const BANDS: [(f64, f64, &str); 5] = [
    (-0.30, -0.20, "belly"),
    (-0.20, -0.10, "chest"),
    (-0.10, 0.0, "shoulder"),
    (0.0, 0.10, "neck, chin"),
    (0.10, 0.40, "face, head"),
];

/// Returns the table of elbows, lowest hands first.
pub(crate) fn table(takes: &[Take]) -> String {
    let mut text = String::from(
        "Height of the elbow above its shoulder in metres, shoulders taken as 36 cm wide, while the wrist is at a height.\n\n\
         | wrist | at | frames | median and quartiles | 9 of 10 below | 19 of 20 below |\n|---|---|--:|--:|--:|--:|\n",
    );
    for (low, high, name) in BANDS {
        let all = takes.iter().flat_map(|take| &take.heights);
        let mut elbows: Vec<f64> = all
            .filter(|[_, wrist]| (low..high).contains(wrist))
            .map(|[elbow, _]| *elbow)
            .collect();
        elbows.sort_by(f64::total_cmp);
        let at = |share: f64| match elbows.len() {
            0 => "–".to_owned(),
            len => format!("{:.2}", elbows[((len - 1) as f64 * share) as usize]),
        };
        text.push_str(&format!(
            "| {low:.2} to {high:.2} | {name} | {} | {} | {} | {} |\n",
            elbows.len(),
            spread(elbows.clone(), 2),
            at(0.9),
            at(0.95)
        ));
    }
    text
}
