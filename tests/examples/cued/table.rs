//! The truth that models recover from generated sessions, as one table.

use std::collections::BTreeMap;
use std::time::Instant;

use chereme_analysis::cue::face::FaceModel;
use chereme_analysis::cue::gauss::{Confusion, Recogniser};
use chereme_analysis::cue::generate::{self, RATE, Settings, Take, TrueKey};
use chereme_analysis::cue::hand::{HandModel, Restored};
use chereme_analysis::cue::labels::{HAND, THROAT, finger};
use chereme_analysis::cue::targets::{Quartiles, Sought, TargetOptions, arrival, targets};
use chereme_compose::cue::dikey::{Costs, Dictionary, Dikey, DikeyEnd};
use chereme_corpus::{Corpus, CueOptions};
use chereme_motion::glam::DVec3;

struct Table {
    passed: usize,
    rows: usize,
}

impl Table {
    fn row(&mut self, what: &str, found: &str, wanted: &str, passes: bool) {
        self.rows += 1;
        self.passed += usize::from(passes);
        let word = if passes { "yes" } else { "**no**" };
        println!("| {what} | {found} | {wanted} | {word} |");
    }
}

pub(crate) fn print() {
    println!("| on generated sessions | found | wanted | reached |\n|---|---|---|---|");
    let mut table = Table { passed: 0, rows: 0 };
    hand(&mut table);
    face(&mut table);
    let tables = recognisers(&mut table);
    phases(&mut table);
    dictionary(&mut table);
    cuer(&mut table);
    println!(
        "\n{} of {} rows reach what is wanted.\n",
        table.passed, table.rows
    );
    for (name, confusion) in tables {
        println!("{name}, produced in rows and recognised in columns:\n\n```\n{confusion}\n```\n");
    }
}

fn takes(settings: &Settings, numbers: std::ops::Range<u64>) -> Vec<Take> {
    numbers
        .map(|n| generate::sentence(settings, n, 14))
        .collect()
}

fn clean() -> Settings {
    Settings {
        hidden: 0.0,
        ..Settings::default()
    }
}

#[derive(Default)]
struct Errors {
    seen: Vec<f64>,
    axis: Vec<f64>,
    hidden: Vec<f64>,
    covered: usize,
}

fn mean(all: &[f64]) -> f64 {
    all.iter().sum::<f64>() / all.len().max(1) as f64
}

fn errors(model: &HandModel, takes: &[Take]) -> Errors {
    let mut found = Errors::default();
    for take in takes {
        let mut before: Option<Restored> = None;
        for (frame, truth) in take.hand.iter().zip(&take.true_hand) {
            let Some(restored) = model.restore(frame, before.as_ref()) else {
                continue;
            };
            for marker in 0..HAND {
                match frame[marker] {
                    Some(at) => {
                        let apart = restored.points[marker] - at;
                        found.seen.push(apart.length());
                        found.axis.extend(apart.abs().to_array());
                    }
                    None => {
                        let off = restored.points[marker].distance(truth[marker]);
                        found.hidden.push(off);
                        found.covered += usize::from(off <= 2.795 * restored.sd[marker]);
                    }
                }
            }
            before = Some(restored);
        }
    }
    found.hidden.sort_by(f64::total_cmp);
    found
}

fn hand(table: &mut Table) {
    let free = generate::transitions(&Settings::default(), 2);
    let start = Instant::now();
    let model = HandModel::learn(&free.hand, 12).expect("a model");
    let took = start.elapsed().as_secs_f64();
    let frames = free.hand.len();
    table.row(
        "training of the hand's model, one core",
        &format!("{took:.2} s for {frames} frames"),
        "< 5 s for 10,000",
        took < 5.0,
    );
    let train = errors(&model, &takes(&Settings::default(), 0..4));
    let test = errors(&model, &takes(&Settings::default(), 100..108));
    let (seen, axis) = (mean(&test.seen), mean(&test.axis));
    table.row(
        "hand, visible markers, unseen sentences",
        &format!(
            "{seen:.2} mm, {axis:.2} mm an axis, {:.2} times the first",
            seen / mean(&train.seen)
        ),
        "≤ 2.5 mm, ≤ 1.25 an axis, ≤ 1.1 times",
        seen <= 2.5 && axis <= 1.25 && seen <= 1.1 * mean(&train.seen),
    );
    let far = test.hidden[test.hidden.len() * 95 / 100];
    table.row(
        "hand, hidden markers against truth",
        &format!(
            "{:.2} mm, 95 % within {far:.1} (n = {})",
            mean(&test.hidden),
            test.hidden.len()
        ),
        "≤ 3.5 mm, 95 % within 10",
        mean(&test.hidden) <= 3.5 && far <= 10.0,
    );
    let covered = 100.0 * test.covered as f64 / test.hidden.len() as f64;
    table.row(
        "errors within what is predicted for 95 of 100",
        &format!("{covered:.1} %"),
        "90–100 %",
        covered >= 90.0,
    );
    let wide = HandModel::learn(&free.hand, 20).expect("a model");
    let wide = mean(&errors(&wide, &takes(&Settings::default(), 100..104)).seen);
    table.row(
        "hand, 20 components, visible",
        &format!("{wide:.2} mm"),
        "≤ 2.0 mm",
        wide <= 2.0,
    );
    let take = generate::sentence(&clean(), 300, 8);
    let mut grown = Vec::new();
    for share in [0.2, 0.4, 0.6] {
        let mut hidden = take.clone();
        let mut random = generate::Random::new(9);
        for at in hidden.hand.iter_mut().flatten() {
            if random.share() < share {
                *at = None;
            }
        }
        grown.push(mean(&errors(&model, &[hidden]).hidden));
    }
    table.row(
        "20, 40, 60 % hidden",
        &format!("{:.2}, {:.2}, {:.2} mm", grown[0], grown[1], grown[2]),
        "grows",
        grown[0] <= grown[1] && grown[1] <= grown[2],
    );
    let mut gone = take.hand[120].clone();
    gone[finger(2)..finger(2) + 8].fill(None);
    let sd = model
        .restore(&gone, None)
        .map_or(0.0, |it| it.sd[finger(2) + 7] * 3f64.sqrt());
    table.row(
        "a finger wholly hidden: predicted sd of its tip",
        &format!("{sd:.1} mm"),
        "> 8 mm",
        sd > 8.0,
    );
    let mut scrambled = take.hand[120].clone();
    scrambled[20] = Some(DVec3::NAN);
    let mut hidden = take.hand[120].clone();
    hidden[20] = None;
    let same = model.restore(&scrambled, None).map(|it| it.points)
        == model.restore(&hidden, None).map(|it| it.points);
    table.row(
        "hidden values are not looked at",
        if same { "bit by bit" } else { "differ" },
        "bit by bit",
        same,
    );
}

fn face(table: &mut Table) {
    let settings = Settings::default();
    let mut frames = Vec::new();
    for take in takes(&settings, 0..12) {
        frames.extend(take.face.into_iter().step_by(5));
    }
    let whole: Vec<_> = takes(&clean(), 0..12)
        .into_iter()
        .flat_map(|it| it.face.into_iter().step_by(5))
        .collect();
    let start = Instant::now();
    let model = FaceModel::learn(&whole).expect("a face");
    let took = start.elapsed().as_secs_f64();
    table.row(
        "training of the face's model, one core",
        &format!("{took:.2} s for {} frames", whole.len()),
        "< 5 s for 10,000",
        took * 10_000.0 / (whole.len() as f64) < 5.0,
    );
    let error = |frames: &[chereme_analysis::cue::face::Frame]| {
        let mut all = Vec::new();
        for frame in frames {
            if let Some((motion, own)) = model.invert(frame) {
                let said = model.place(&motion, &own);
                all.extend(
                    frame
                        .iter()
                        .zip(said)
                        .filter_map(|(at, said)| at.map(|at| at.distance(said))),
                );
            }
        }
        mean(&all)
    };
    let test: Vec<_> = takes(&settings, 200..206)
        .into_iter()
        .flat_map(|it| it.face.into_iter().step_by(5))
        .collect();
    let (first, second) = (error(&frames), error(&test));
    table.row(
        "face, visible markers, unseen sentences",
        &format!("{second:.2} mm, {:.2} times the first", second / first),
        "≤ 1 mm, ≤ 1.1 times",
        second <= 1.0 && second <= 1.1 * first,
    );
    let off = generate::throat_weights().into_iter().enumerate();
    let off = off
        .map(|(n, truth)| (model.weights[THROAT.start + n] - truth).abs())
        .fold(0.0, f64::max);
    table.row(
        "weights of the throat, the worst",
        &format!("{off:.3}"),
        "± 0.05",
        off <= 0.05,
    );
}

type Examples = Vec<(u8, Vec<f64>)>;

fn at_targets(takes: &[Take]) -> (Examples, Examples) {
    let (mut shapes, mut places) = (Vec::new(), Vec::new());
    for take in takes {
        for key in &take.keys {
            let frame = ((key.times[1] * RATE).round() as usize).min(take.true_hand.len() - 1);
            let points = &take.true_hand[frame];
            if let (Some(seven), Some(tip)) = (
                HandModel::distances(points),
                HandModel::tip(points, key.shape),
            ) {
                shapes.push((key.shape, seven.to_vec()));
                places.push((
                    key.placement,
                    take.head[frame].undo(tip).to_array().to_vec(),
                ));
            }
        }
    }
    (shapes, places)
}

fn recognisers(table: &mut Table) -> Vec<(&'static str, Confusion)> {
    let rates = |scatter: f64| {
        let settings = Settings { scatter, ..clean() };
        let (shapes, places) = at_targets(&takes(&settings, 0..68));
        let (new_shapes, new_places) = at_targets(&takes(&settings, 100..180));
        let shape = Confusion::of(
            &Recogniser::learn(&shapes, 0.25).expect("shapes"),
            &new_shapes,
        );
        let place = Confusion::of(
            &Recogniser::learn(&places, 0.25).expect("places"),
            &new_places,
        );
        (shape, place)
    };
    let ((shape, place), (still, _)) = (rates(8.0), rates(4.0));
    let percent = |confusion: &Confusion| 100.0 * confusion.rate();
    table.row(
        "shapes, angles scattered by 8°",
        &format!("{:.1} %", percent(&shape)),
        "≥ 96 %",
        shape.rate() >= 0.96,
    );
    table.row(
        "shapes, angles scattered by 4°",
        &format!("{:.1} %", percent(&still)),
        "≥ 99.5 %",
        still.rate() >= 0.995,
    );
    table.row(
        "placements, one cuer",
        &format!("{:.1} %", percent(&place)),
        "≥ 98 %",
        place.rate() >= 0.98,
    );
    vec![("Shapes at 8°", shape), ("Placements", place)]
}

/// The speed of the pointing tip in the head's space, in mm/s.
fn speed(take: &Take) -> Vec<f64> {
    let shape_at = |frame: usize| {
        let time = frame as f64 / RATE;
        let n = take.keys.partition_point(|key| key.times[0] <= time);
        n.checked_sub(1).map_or(0, |n| take.keys[n].shape)
    };
    let tip = |frame: usize, shape: u8| {
        let points = &take.true_hand[frame];
        take.head[frame].undo(HandModel::tip(points, shape).unwrap_or_default())
    };
    let last = take.true_hand.len() - 1;
    (0..=last)
        .map(|frame| {
            let (a, b) = (frame.saturating_sub(1), (frame + 1).min(last));
            // One finger in both frames: the step from one finger to another is no speed.
            let shape = shape_at(frame);
            tip(b, shape).distance(tip(a, shape)) * RATE / (b - a).max(1) as f64
        })
        .collect()
}

fn found_phases(
    settings: &Settings,
    sentences: std::ops::Range<u64>,
) -> Vec<(usize, f64, f64, f64)> {
    let (_, places) = at_targets(&takes(settings, 500..520));
    let recogniser = Recogniser::learn(&places, 0.25).expect("places");
    let mut all = Vec::new();
    for take in takes(settings, sentences) {
        let tips: Vec<Vec<f64>> = (0..take.true_hand.len())
            .map(|frame| {
                let middle = HandModel::tip(&take.true_hand[frame], 4).unwrap_or_default();
                take.head[frame].undo(middle).to_array().to_vec()
            })
            .collect();
        let index: Vec<Vec<f64>> = (0..take.true_hand.len())
            .map(|frame| {
                let tip = HandModel::tip(&take.true_hand[frame], 1).unwrap_or_default();
                take.head[frame].undo(tip).to_array().to_vec()
            })
            .collect();
        let keys: Vec<Sought> = take
            .keys
            .iter()
            .map(|key| {
                let of = if matches!(key.shape, 1 | 6) {
                    &index
                } else {
                    &tips
                };
                Sought {
                    a1: key.sound[0],
                    log: of
                        .iter()
                        .map(|row| recogniser.log_of(row, key.placement))
                        .collect(),
                }
            })
            .collect();
        let speed = speed(&take);
        let options = TargetOptions::default();
        let Some(frames) = targets(&keys, &speed, 1.0 / RATE, &options) else {
            continue;
        };
        for (n, key) in take.keys.iter().enumerate() {
            let before = n.checked_sub(1).map_or(0, |n| frames[n]);
            let same = n
                .checked_sub(1)
                .is_some_and(|n| take.keys[n].placement == key.placement);
            if same {
                continue;
            }
            let found = arrival(&speed, before, frames[n], 1.0 / RATE, options.still);
            all.push((key.kind, key.sound[0], key.times[1], found));
        }
    }
    all
}

fn phases(table: &mut Table) {
    let settings = clean();
    let found = found_phases(&settings, 0..40);
    let mut off: Vec<f64> = found
        .iter()
        .map(|(_, _, truth, found)| (found - truth).abs() * 1000.0)
        .collect();
    off.sort_by(f64::total_cmp);
    let (half, most) = (off[off.len() / 2], off[off.len() * 9 / 10]);
    table.row(
        "targets of the hand found",
        &format!(
            "half within {half:.1} ms, 90 % within {most:.1} (n = {})",
            off.len()
        ),
        "8.3 and 16.7 ms",
        half <= 8.4 && most <= 16.7,
    );
    let quartiles = |truth: bool, kind: usize| {
        let own = found.iter().filter(|it| it.0 == kind);
        let phases: Vec<f64> = own
            .map(|it| 1000.0 * (if truth { it.2 } else { it.3 } - it.1))
            .collect();
        Quartiles::of(&phases)
    };
    for (kind, name) in [(0, "pairs"), (2, "consonants alone")] {
        let (Some(truth), Some(own)) = (quartiles(true, kind), quartiles(false, kind)) else {
            continue;
        };
        let (wide, narrow) = (own.high - own.low, truth.high - truth.low);
        table.row(
            &format!("phase of {name} (n = {})", own.n),
            &format!(
                "median {:.1} for {:.1} ms, quartiles {wide:.0} for {narrow:.0} apart",
                own.median, truth.median
            ),
            "median ± 5 ms, quartiles ± 15 %",
            (own.median - truth.median).abs() <= 5.0 && (wide / narrow - 1.0).abs() <= 0.15,
        );
    }
    let planted = [[0.5, 0.0, 0.0], [0.3, 0.21, 0.1], [0.33, -0.6, -0.3]];
    let median = |phase: [f64; 3], seeds: std::ops::Range<u64>| {
        let settings = Settings { phase, ..clean() };
        let found = found_phases(&settings, seeds);
        [0, 2].map(|kind| {
            let own: Vec<f64> = found
                .iter()
                .filter(|it| it.0 == kind)
                .map(|it| it.3 - it.1)
                .collect();
            Quartiles::of(&own).map_or(0.0, |it| it.median)
        })
    };
    let known = planted.map(|phase| median(phase, 0..15));
    let right = (0..3)
        .filter(|n| {
            let own = median(planted[*n], 40..55);
            let apart = |at: &[f64; 2]| (at[0] - own[0]).powi(2) + (at[1] - own[1]).powi(2);
            let best = known
                .iter()
                .enumerate()
                .min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
            best.is_some_and(|(m, _)| m == *n)
        })
        .count();
    table.row(
        "three planted rules of phases distinguished",
        &format!("{right} of 3"),
        "3 of 3",
        right == 3,
    );
}

/// The key of a dikey's end.
fn end(key: &TrueKey) -> DikeyEnd {
    DikeyEnd {
        placement: key.placement,
        shape: key.shape,
    }
}

/// The seven distances and both tips in the head's space, as the parameters of a frame.
fn parameters(take: &Take) -> Vec<Vec<f64>> {
    let frames = take.true_hand.iter().zip(&take.head);
    frames
        .map(|(points, head)| {
            let mut row = HandModel::distances(points).unwrap_or_default().to_vec();
            for shape in [1, 4] {
                let tip = HandModel::tip(points, shape).unwrap_or_default();
                row.extend(head.undo(tip).to_array());
            }
            row
        })
        .collect()
}

fn goals(take: &Take) -> Vec<(DikeyEnd, usize)> {
    let last = take.true_hand.len() - 1;
    let each = take.keys.iter();
    each.map(|key| (end(key), ((key.times[1] * RATE).round() as usize).min(last)))
        .collect()
}

fn dictionary(table: &mut Table) {
    let settings = clean();
    let first = takes(&settings, 0..238);
    let mut dikeys: Vec<Dikey> = Vec::new();
    for (n, take) in first.iter().enumerate() {
        dikeys.extend(Dictionary::cut(
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
    let book = Dictionary::new(dikeys, RATE, &[1.0; 13], places);
    let costs = Costs::default();
    let own = &first[5];
    let wanted: Vec<(DikeyEnd, f64)> = goals(own)
        .into_iter()
        .map(|(key, frame)| (key, frame as f64 / RATE))
        .collect();
    let pieces = book.select(&wanted, &costs);
    let made = book.render(&pieces, &wanted);
    let truth = parameters(own);
    let from = (wanted[0].1 * RATE).round() as usize;
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
    let (shapes, spots) = at_targets(&first);
    let by_shape = Recogniser::learn(&shapes, 0.25).expect("shapes");
    let by_place = Recogniser::learn(&spots, 0.25).expect("places");
    let (mut right, mut all, mut instead, mut ramps, mut wrong) = ([0, 0], 0, 0, 0, Vec::new());
    for (n, take) in takes(&settings, 1000..1114).iter().enumerate() {
        let wanted: Vec<(DikeyEnd, f64)> = goals(take)
            .into_iter()
            .map(|(key, frame)| (key, frame as f64 / RATE))
            .collect();
        let pieces = book.select(&wanted, &costs);
        instead += pieces
            .iter()
            .filter(|piece| piece.instead.is_some())
            .count();
        ramps += pieces.iter().filter(|piece| piece.dikey.is_none()).count();
        let made = book.render(&pieces, &wanted);
        for (k, (key, time)) in wanted.iter().enumerate() {
            let frame = (((time - wanted[0].1) * RATE).round() as usize).min(made.len() - 1);
            let row = &made[frame];
            let shape = by_shape.best(&row[..7]);
            let tip = if matches!(key.shape, 1 | 6) {
                &row[7..10]
            } else {
                &row[10..13]
            };
            let place = by_place.best(tip);
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
    let rate =
        right.map(|right| 100.0 * f64::from(u32::try_from(right).unwrap_or(0)) / f64::from(all));
    table.row(
        "114 unseen sentences synthesised and recognised again",
        &format!("shapes {:.1} %, placements {:.1} % of {all}; {instead} dikeys stood in for others, {ramps} ramps", rate[0], rate[1]),
        "≥ 95 % each",
        rate[0] >= 95.0 && rate[1] >= 95.0,
    );
    eprintln!("read otherwise, the first: {}", wrong.join("; "));
}

fn cuer(table: &mut Table) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create(&folder.path().join("c.chereme"), "A").expect("a corpus");
    let text = "maître corbeau sur un arbre perché tenait en son bec un fromage, maître renard par l'odeur alléché";
    let mut options = CueOptions::default();
    options.reading.pace = Some(1.6);
    let done = corpus.cue(text, &options, None).expect("cued");
    let start = Instant::now();
    let done = corpus.cue(text, &options, None).unwrap_or(done);
    let took = start.elapsed().as_secs_f64();
    let seconds = done.duration_us as f64 / 1e6;
    table.row(
        "speech to movement on the program's own body",
        &format!("{took:.2} s for {seconds:.1} s"),
        "< 1 s for 10 s",
        took * 10.0 / seconds < 1.0,
    );
    let lips = done
        .report
        .warnings
        .iter()
        .filter(|it| it.contains("lips"))
        .count();
    table.row(
        "lips stay free by 6 mm",
        if lips == 0 { "yes" } else { "no" },
        "always",
        lips == 0,
    );
}
