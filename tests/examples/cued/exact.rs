//! Rows of the table whose figures are exact: keys, spelling, alphabets, rigid fits and hostile input.

use chereme_analysis::cue::generate::RandomNumbers;
use chereme_analysis::cue::rigid::RigidMotion;
use chereme_corpus::{KeysOptions, cue_keys};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::cue::PhoneAlphabet;

use super::table::Table;

/// Adds these rows to the table.
pub(crate) fn rows(table: &mut Table) {
    rows_of_keys(table);
    rows_of_fits(table);
}

/// Expected keys of phones: code, text, SAMPA, IPA, keys.
const VECTORS: &str = include_str!("../../../crates/chereme-sign/src/cue/vectors.tsv");
/// Words and their phones.
const SPELLING: &str = include_str!("../../../crates/chereme-sign/src/cue/spelling.tsv");

fn lines_of(table: &'static str) -> impl Iterator<Item = Vec<&'static str>> {
    let lines = table.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| line.split('\t').collect())
}

fn keys(text: &str, code: &str, phones: Option<PhoneAlphabet>) -> Vec<String> {
    let options = KeysOptions {
        code: code.to_owned(),
        phones,
        ..KeysOptions::default()
    };
    let found = cue_keys(text, &options).map(|found| found.keys).unwrap_or_default();
    found
        .iter()
        .map(|key| format!("{}-{}", key.shape, key.placement))
        .collect()
}

fn rows_of_keys(table: &mut Table) {
    let (mut right, mut all) = (0, 0);
    let (mut edits, mut sentences) = (0, 0);
    let mut alphabets = true;
    for row in lines_of(VECTORS) {
        let [code, text, sampa, ipa, expected] = row[..] else {
            continue;
        };
        let expected: Vec<&str> = expected.split_whitespace().collect();
        all += 1;
        right += usize::from(keys(sampa, code, Some(PhoneAlphabet::Sampa)) == expected);
        if code == "french" {
            let ipa_keys = keys(ipa, code, Some(PhoneAlphabet::Ipa));
            alphabets &= ipa_keys == expected && keys(ipa, code, Some(PhoneAlphabet::Mfa)) == expected;
        }
        if code == "french" && text.ends_with(['.', '?']) {
            edits += distance(&keys(text, code, None), &expected);
            sentences += expected.len();
        }
    }
    table.row(
        "keys of the vectors",
        &format!("{right} of {all} exact"),
        "exact",
        right == all,
    );
    table.row(
        "keys of phones in SAMPA, IPA and the aligner's alphabet",
        if alphabets { "identical" } else { "differ" },
        "identical",
        alphabets,
    );
    let checks: Vec<Vec<&str>> = lines_of(SPELLING).collect();
    let spelled = |row: &&Vec<&str>| {
        let spoken = chereme_sign::cue::french::pronounce_french_text(
            row[0],
            chereme_sign::cue::french::PronunciationOptions::default(),
        );
        spoken.spoken_phones().collect::<Vec<_>>().join(" ") == row[1]
    };
    let right = checks.iter().filter(spelled).count();
    let share = 100.0 * edits as f64 / f64::from(u32::try_from(sentences).unwrap_or(1)).max(1.0);
    table.row(
        "French text to keys",
        &format!(
            "{right} of {} words as the rules say; {share:.1} % of {sentences} keys of sentences differ",
            checks.len()
        ),
        "words exact, ≤ 1.5 %",
        right == checks.len() && share <= 1.5,
    );
}

fn distance(a: &[String], b: &[&str]) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, left) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, right) in b.iter().enumerate() {
            let change = diagonal + usize::from(left != right);
            diagonal = row[j + 1];
            row[j + 1] = change.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

fn rows_of_fits(table: &mut Table) {
    let mut random = RandomNumbers::new(5);
    let mut point = |sd: f64| DVec3::new(random.random_normal(), random.random_normal(), random.random_normal()) * sd;
    let mut worst = [0.0f64; 3];
    let mut sums = [0.0f64; 2];
    const TIMES: usize = 200;
    for noise in [0.0, 0.3] {
        for _ in 0..TIMES {
            let motion = RigidMotion {
                rotation: DQuat::from_scaled_axis(point(1.2)),
                translation: point(300.0),
            };
            let from: Vec<DVec3> = (0..9).map(|_| point(60.0)).collect();
            let to: Vec<Option<DVec3>> = from
                .iter()
                .map(|at| Some(motion.apply_rigid_motion(*at) + point(noise)))
                .collect();
            let Ok(found) = RigidMotion::fit_rigid_motion(&from, &to) else {
                continue;
            };
            let middle = from.iter().sum::<DVec3>() / 9.0;
            let off = found
                .apply_rigid_motion(middle)
                .distance(motion.apply_rigid_motion(middle));
            let turn = found.rotation.angle_between(motion.rotation).to_degrees();
            if noise == 0.0 {
                worst[0] = worst[0].max(off);
            } else {
                sums[0] += off / TIMES as f64;
                sums[1] += turn / TIMES as f64;
            }
        }
    }
    let line: Vec<DVec3> = (0..5).map(|n| DVec3::X * f64::from(n)).collect();
    let seen: Vec<Option<DVec3>> = line.iter().copied().map(Some).collect();
    let refused = RigidMotion::fit_rigid_motion(&line, &seen).is_err()
        && RigidMotion::fit_rigid_motion(&line[..2], &seen[..2]).is_err();
    table.row(
        "rigid fit of nine markers, exact and with 0.3 mm of noise",
        &format!(
            "{:.0e} mm; mean {:.2} mm and {:.2}°; a line and two markers are {}",
            worst[0],
            sums[0],
            sums[1],
            if refused { "refused" } else { "accepted" }
        ),
        "1e-9 mm; 0.3 mm and 0.3°; refused",
        worst[0] < 1e-9 && sums[0] <= 0.3 && sums[1] <= 0.3 && refused,
    );
}
