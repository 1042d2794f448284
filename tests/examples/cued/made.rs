//! Rows of the table about generated movement: sentences from the dictionary, and the cuer on the program's own body.

use std::collections::BTreeMap;
use std::time::Instant;

use chereme_analysis::cue::cue_hand::HandModel;
use chereme_analysis::cue::gauss::GaussianRecogniser;
use chereme_analysis::cue::generate::{GENERATED_FRAME_RATE, GeneratedTake, TrueKey};
use chereme_compose::cue::dikey::{DikeyCostWeights, DikeyDictionary, DikeyEnd, KeyTransition};
use chereme_corpus::{Corpus, CueOptions};

use super::table::{Table, at_targets, clean, takes};

/// The key of a dikey's end.
fn end(key: &TrueKey) -> DikeyEnd {
    DikeyEnd {
        placement: key.placement,
        shape: key.shape,
    }
}

/// The seven distances and both tips in the head's space, as the parameters of a frame.
fn parameters(take: &GeneratedTake) -> Vec<Vec<f64>> {
    let frames = take.true_hand.iter().zip(&take.head);
    frames
        .map(|(points, head)| {
            let mut row = HandModel::shape_distances(points).unwrap_or_default().to_vec();
            for shape in [1, 4] {
                let tip = HandModel::pointing_fingertip(points, shape).unwrap_or_default();
                row.extend(head.undo_rigid_motion(tip).to_array());
            }
            row
        })
        .collect()
}

fn goals(take: &GeneratedTake) -> Vec<(DikeyEnd, usize)> {
    let last = take.true_hand.len() - 1;
    let each = take.keys.iter();
    each.map(|key| {
        (
            end(key),
            ((key.times[1] * GENERATED_FRAME_RATE).round() as usize).min(last),
        )
    })
    .collect()
}

pub(crate) fn dictionary(table: &mut Table) {
    let settings = clean();
    let first = takes(&settings, 0..238);
    let mut dikeys: Vec<KeyTransition> = Vec::new();
    for (n, take) in first.iter().enumerate() {
        dikeys.extend(DikeyDictionary::cut_dikeys(
            &parameters(take),
            &goals(take),
            &format!("sentence {n}"),
        ));
    }
    let places: BTreeMap<u8, [f64; 3]> = {
        let (_, places) = at_targets(&first[..20]);
        let mut sums: BTreeMap<u8, ([f64; 3], f64)> = BTreeMap::new();
        for (place, row) in places {
            let own = sums.entry(place).or_insert(([0.0; 3], 0.0));
            own.0.iter_mut().zip(row).for_each(|(sum, x)| *sum += x);
            own.1 += 1.0;
        }
        sums.into_iter()
            .map(|(place, (sum, count))| (place, sum.map(|x| x / count)))
            .collect()
    };
    let book = DikeyDictionary::new(dikeys, GENERATED_FRAME_RATE, &[1.0; 13], places);
    let costs = DikeyCostWeights::default();
    let own = &first[5];
    let wanted: Vec<(DikeyEnd, f64)> = goals(own)
        .into_iter()
        .map(|(key, frame)| (key, frame as f64 / GENERATED_FRAME_RATE))
        .collect();
    let pieces = book.select_dikeys(&wanted, &costs);
    let made = book.render_dikeys(&pieces, &wanted);
    let truth = parameters(own);
    let from = (wanted[0].1 * GENERATED_FRAME_RATE).round() as usize;
    let off = made
        .iter()
        .zip(&truth[from..])
        .flat_map(|(a, b)| a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    let off = off.fold(0.0, f64::max);
    let backed = pieces
        .iter()
        .filter(|piece| piece.instead.is_some() || piece.dikey.is_none())
        .count();
    table.row(
        "a sentence of the dictionary synthesised from it",
        &format!("{off:.3} mm, {backed} back-offs"),
        "≤ 1 mm, 0 back-offs",
        off <= 1.0 && backed == 0,
    );
    // Joins: a position is continuous by construction; speeds at joins against those of the corpus.
    let speed_of = |rows: &[Vec<f64>]| -> Vec<f64> {
        let pairs = rows.windows(2);
        pairs
            .map(|pair| (10..13).map(|k| (pair[1][k] - pair[0][k]).powi(2)).sum::<f64>().sqrt() * GENERATED_FRAME_RATE)
            .collect()
    };
    let mut usual: Vec<f64> = Vec::new();
    for take in &first[..40] {
        let speeds = speed_of(&parameters(take));
        usual.extend(speeds.windows(2).map(|pair| (pair[1] - pair[0]).abs()));
    }
    usual.sort_by(f64::total_cmp);
    let limit = usual[usual.len() * 99 / 100];
    let mut most: f64 = 0.0;
    let mut over = 0;
    let mut joins = 0;
    for take in takes(&settings, 1000..1030) {
        let wanted: Vec<(DikeyEnd, f64)> = goals(&take)
            .into_iter()
            .map(|(key, frame)| (key, frame as f64 / GENERATED_FRAME_RATE))
            .collect();
        let pieces = book.select_dikeys(&wanted, &costs);
        let speeds = speed_of(&book.render_dikeys(&pieces, &wanted));
        for (_, time) in &wanted[1..wanted.len() - 1] {
            let at = ((time - wanted[0].1) * GENERATED_FRAME_RATE).round() as usize;
            if at > 0 && at < speeds.len() {
                let jump = (speeds[at] - speeds[at - 1]).abs();
                joins += 1;
                over += usize::from(jump > 1.5 * limit);
                most = most.max(jump);
            }
        }
    }
    table.row(
        "jump of speed at joins",
        &format!(
            "{over} of {joins} above 1.5 times the corpus' 99th percentile; at most {:.1} times",
            most / limit
        ),
        "≤ 1.5 times",
        over == 0,
    );
    let (shapes, spots) = at_targets(&first);
    let by_shape = GaussianRecogniser::learn_gaussian_classes(&shapes, 0.25).expect("shapes");
    let by_place = GaussianRecogniser::learn_gaussian_classes(&spots, 0.25).expect("places");
    let (mut right, mut all, mut instead, mut ramps, mut wrong) = ([0, 0], 0, 0, 0, Vec::new());
    for (n, take) in takes(&settings, 1000..1114).iter().enumerate() {
        let wanted: Vec<(DikeyEnd, f64)> = goals(take)
            .into_iter()
            .map(|(key, frame)| (key, frame as f64 / GENERATED_FRAME_RATE))
            .collect();
        let pieces = book.select_dikeys(&wanted, &costs);
        instead += pieces.iter().filter(|piece| piece.instead.is_some()).count();
        ramps += pieces.iter().filter(|piece| piece.dikey.is_none()).count();
        let made = book.render_dikeys(&pieces, &wanted);
        for (k, (key, time)) in wanted.iter().enumerate() {
            let frame = (((time - wanted[0].1) * GENERATED_FRAME_RATE).round() as usize).min(made.len() - 1);
            let row = &made[frame];
            let shape = by_shape.most_probable_class(&row[..7]);
            let tip = if matches!(key.shape, 1 | 6) {
                &row[7..10]
            } else {
                &row[10..13]
            };
            let place = by_place.most_probable_class(tip);
            all += 1;
            right[0] += usize::from(shape == key.shape);
            right[1] += usize::from(place == key.placement);
            if (shape != key.shape || place != key.placement) && wrong.len() < 12 {
                let dikey = k.checked_sub(1).map_or("start".to_owned(), |k| {
                    format!("{}-{}", pieces[k].wanted.0, pieces[k].wanted.1)
                });
                wrong.push(format!("sentence {n} [{dikey}] read as {place}{shape}"));
            }
        }
    }
    let rate = right.map(|right| 100.0 * f64::from(u32::try_from(right).unwrap_or(0)) / f64::from(all));
    table.row(
        "114 unseen sentences synthesised and recognised again",
        &format!(
            "shapes {:.1} %, placements {:.1} % of {all}; {instead} dikeys stood in for others, {ramps} ramps",
            rate[0], rate[1]
        ),
        "≥ 95 % each",
        rate[0] >= 95.0 && rate[1] >= 95.0,
    );
    eprintln!("read otherwise, the first: {}", wrong.join("; "));
}

pub(crate) fn cuer(table: &mut Table) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("a corpus");
    let text = "maître corbeau sur un arbre perché tenait en son bec un fromage, maître renard par l'odeur alléché";
    let mut options = CueOptions::default();
    options.reading.pace = Some(1.6);
    let done = corpus.generate_cued_speech(text, &options, None).expect("cued");
    let start = Instant::now();
    let done = corpus.generate_cued_speech(text, &options, None).unwrap_or(done);
    let took = start.elapsed().as_secs_f64();
    let seconds = done.duration_us as f64 / 1e6;
    table.row(
        "speech to movement on the program's own body",
        &format!("{took:.2} s for {seconds:.1} s"),
        "< 1 s for 10 s",
        took * 10.0 / seconds < 1.0,
    );
    let lips = done.report.warnings.iter().filter(|it| it.contains("lips")).count();
    table.row(
        "lips stay free by 6 mm",
        if lips == 0 { "yes" } else { "no" },
        "always",
        lips == 0,
    );
}
