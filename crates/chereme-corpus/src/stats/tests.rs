//! Statistics of small tables, and of one that was counted independently.

use std::ops::ControlFlow;
use std::path::Path;

use super::*;
use crate::{ImportOptions, PairOptions, ignore_progress_step};

fn corpus_of(folder: &Path, file: &Path) -> Corpus {
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A").expect("made");
    let mut hear = ignore_progress_step;
    let files = [file.to_owned()];
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .import_paths(&files, &ImportOptions::default(), progress)
        .expect("imported");
    corpus
}

fn corpus_with(folder: &Path, table: &str) -> Corpus {
    let file = folder.join("t.csv");
    std::fs::write(&file, table).expect("written");
    corpus_of(folder, &file)
}

fn asked(corpus: &mut Corpus, options: &StatsOptions) -> CorpusResult<LexiconStatistics> {
    let mut hear = ignore_progress_step;
    corpus.lexicon_statistics(options, &mut ProgressReceiver::new(&mut hear))
}

fn by(fields: &[&str]) -> StatsOptions {
    StatsOptions {
        fields: fields.iter().map(|it| (*it).to_owned()).collect(),
        ..StatsOptions::default()
    }
}

/// Compares with a figure of four digits behind the point, or as many as `within` says.
fn near(estimate: &StatsEstimate, wanted: f64, within: f64) {
    let value = estimate.value.expect("a value");
    assert!((value - wanted).abs() <= within, "{value} is not {wanted}");
}

const TABLE: &str = "gloss,handedness,handshape,handshape weak,location\n\
    A,1,B,,chin\nB,1,V,,chin\nC,2s,B,B,neutral space\nD,2s,B,V,neutral space\n\
    E,2a,1,B,weak hand\nF,2a,1,V,weak hand\nG,2a,1,,chest\nH,1,B,B,weak hand\nI,both,5,5,chin > chest\n";

#[test]
fn a_weak_hand_that_does_not_apply_has_no_handshape() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = "gloss,handedness,handshape,handshape weak,location\nA,1,B,NA,chin\nB,1,V,N/A,chin\n\
                 C,1,V,S,chin\nD,2s,B,NA,chest\nE,2s,B,B,chest\n";
    let mut corpus = corpus_with(folder.path(), table);
    let mut options = by(&["handedness", "handshape", "handshape weak"]);
    options.battison = true;
    let found = asked(&mut corpus, &options).expect("counted");
    let weak = found.findings.iter().find(|it| it.message.contains("weak hand"));
    assert_eq!(weak.expect("a finding").glosses, ["C"]);
    let symmetry = found.battison.expect("conditions").symmetry;
    assert_eq!((symmetry.entries, symmetry.given), (2, 1));
    assert_eq!(symmetry.incomplete, ["D"]);
}

#[test]
fn fields_of_a_small_table_are_described() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_with(folder.path(), TABLE);
    let fields = ["handedness", "handshape", "Handshape Weak", "location"];
    let found = asked(&mut corpus, &by(&fields)).expect("counted");
    assert_eq!((found.entries, found.compared, found.forms), (9, 9, 9));
    near(&found.entropy, 9_f64.log2(), 1e-12);
    assert_eq!(found.source, FormSource::Columns);
    let weak = &found.fields[2];
    assert_eq!((weak.values, weak.given, weak.empty), (3, 6, 3));
    // Three of nine empty, three B, two V, one 5.
    let bits = 2.0 * 3.0 / 9.0 * 3_f64.log2() + 2.0 / 9.0 * 4.5_f64.log2() + 9_f64.log2() / 9.0;
    near(&weak.entropy, bits, 1e-12);
    let bits = 0.5 + 2_f64 / 6.0 * 3_f64.log2() + 6_f64.log2() / 6.0;
    near(&weak.entropy_given, bits, 1e-12);
    let frequent: Vec<(&str, usize)> = weak.frequent.iter().map(|it| (&*it.value, it.count)).collect();
    assert_eq!(frequent, [("B", 3), ("V", 2), ("5", 1)]);
    assert_eq!(found.fields[3].successive, 1);
    // Without the weak hand C and D, and E and F are the same.
    near(&weak.load, 4.0 / 9.0 / 9_f64.log2(), 1e-12);
    let messages: Vec<&str> = found.findings.iter().map(|it| &*it.message).collect();
    let wanted = [
        "cells with successive values, such as a > b, count as one value each: location 1",
        "handedness: \"both\" (1) is no known type of sign",
        "one-handed entries with a handshape of the weak hand: 1",
        "one-handed entries whose place is the weak hand: 1",
    ];
    assert_eq!(messages, wanted);
    assert_eq!(
        (&found.findings[2].glosses[..], found.findings[2].line),
        (&["H".to_owned()][..], Some(9))
    );
    let unknown = StatsOptions {
        empty: EmptyCellTreatment::Unknown,
        ..by(&fields)
    };
    let found = asked(&mut corpus, &unknown).expect("counted");
    assert_eq!((found.entries, found.compared, found.forms), (9, 6, 6));
    near(&found.entropy, 6_f64.log2(), 1e-12);
    assert_eq!(found.fields[2].empty, 3, "a field is described over all entries");
}

#[test]
fn conditions_on_the_hands_list_their_exceptions() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_with(folder.path(), TABLE);
    let options = StatsOptions {
        battison: true,
        ..by(&["handedness", "handshape", "handshape weak"])
    };
    let found = asked(&mut corpus, &options)
        .expect("counted")
        .battison
        .expect("asked for");
    assert_eq!((found.one_handed, found.other), (3, 1));
    let numbers = |it: &HandCondition| (it.entries, it.given, it.same, it.different, it.different_unmarked);
    assert_eq!(numbers(&found.symmetry), (2, 2, 1, 1, 0));
    assert_eq!(numbers(&found.dominance), (3, 2, 0, 2, 1));
    let exceptions = |it: &HandCondition| -> Vec<String> {
        let exceptions = it.exceptions.iter();
        exceptions
            .map(|it| format!("{} {} {}", it.gloss, it.strong, it.weak))
            .collect()
    };
    assert_eq!(exceptions(&found.symmetry), ["D B V"]);
    assert_eq!(exceptions(&found.dominance), ["F 1 V"]);
    assert_eq!(found.dominance.incomplete, ["G"]);
    near(&found.dominance.kept, 0.5, 1e-12);
    // The same by the codings of the signs, and with another list of unmarked handshapes.
    let coded = StatsOptions {
        battison: true,
        unmarked: vec!["V".to_owned(), "B".to_owned()],
        ..StatsOptions::default()
    };
    let found = asked(&mut corpus, &coded).expect("counted");
    assert_eq!(found.source, FormSource::Citations);
    let found = found.battison.expect("asked for");
    assert_eq!(exceptions(&found.symmetry), ["D B V"]);
    assert_eq!(exceptions(&found.dominance), Vec::<String>::new());
    let error = asked(
        &mut corpus,
        &StatsOptions {
            battison: true,
            ..by(&["location"])
        },
    );
    assert!(error.is_err_and(|it| it.error_remedy().is_some()));
}

#[test]
fn a_field_in_depth_counts_the_pairs_that_the_minimal_pairs_count() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_with(folder.path(), TABLE);
    let fields = ["handshape", "handshape weak", "location"];
    let pairs = corpus
        .minimal_pairs(
            &PairOptions {
                fields: by(&fields).fields,
                ..PairOptions::default()
            },
            &mut crate::ProgressReceiver::silent_progress(),
        )
        .expect("counted");
    for field in fields {
        let options = StatsOptions {
            of: Some(field.to_owned()),
            ..by(&fields)
        };
        let of = asked(&mut corpus, &options).expect("counted").of.expect("asked for");
        let counted = pairs.by_field.iter().find(|it| it.0 == field).map_or(0, |it| it.1);
        let pairs: usize = of.contrasts.iter().map(|it| it.pairs).sum();
        assert_eq!(pairs, counted, "{field}");
    }
    // A column alone brings the columns that code components with it.
    let options = StatsOptions {
        of: Some("Handshape".to_owned()),
        ..StatsOptions::default()
    };
    let found = asked(&mut corpus, &options).expect("counted");
    assert_eq!(found.fields.len(), 4);
    let of = found.of.expect("asked for");
    assert_eq!((&*of.values[0].value, of.values[0].count), ("B", 4));
    let contrast = &of.contrasts[0];
    assert_eq!((&*contrast.a, &*contrast.b, contrast.pairs), ("B", "V", 1));
    let outside = StatsOptions {
        of: Some("location".to_owned()),
        ..by(&["handshape", "handedness"])
    };
    assert!(asked(&mut corpus, &outside).is_err());
}

#[test]
fn an_association_leaves_entries_without_one_of_the_values_out_and_can_be_stopped() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_with(folder.path(), TABLE);
    let options = StatsOptions {
        between: Some(["handshape weak".to_owned(), "handedness".to_owned()]),
        samples: 200,
        ..by(&["handshape", "location"])
    };
    let found = asked(&mut corpus, &options).expect("counted");
    assert_eq!(found.fields.len(), 2, "the form has the fields that --fields names");
    let it = found.between.expect("asked for");
    assert_eq!((it.n, it.left_out, it.df), (6, 3, 6));
    let cells: usize = it.cells.iter().map(|cell| cell.count).sum();
    let expected: f64 = it.cells.iter().map(|cell| cell.expected).sum();
    assert!(cells == 6 && expected < 6.0);
    assert!(it.p.value.is_some_and(|p| p > 0.0 && p <= 1.0));
    assert_eq!(it.chance.map(|it| (it.samples, it.seed)), Some((200, 1)));
    let without = StatsOptions {
        samples: 0,
        ..options.clone()
    };
    let it = asked(&mut corpus, &without)
        .expect("counted")
        .between
        .expect("asked for");
    assert_eq!((it.p.value, it.p.why), (None, Some("nothing was drawn")));
    let one_value = StatsOptions {
        query: Some("gloss=A or gloss=B".to_owned()),
        between: Some(["handedness".to_owned(), "handshape".to_owned()]),
        ..StatsOptions::default()
    };
    let it = asked(&mut corpus, &one_value)
        .expect("counted")
        .between
        .expect("asked for");
    assert_eq!((it.n, it.p.why), (2, Some("all entries have the same value")));
    let mut stop = |_: crate::ProgressStep<'_>| ControlFlow::Break(());
    let stopped = corpus.lexicon_statistics(&options, &mut ProgressReceiver::new(&mut stop));
    assert!(matches!(stopped, Err(CorpusError::Stopped)));
}

#[test]
fn a_corpus_without_entries_has_reasons_instead_of_numbers() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_with(folder.path(), "gloss,handshape,location\nA,V,chin\nB,V,chin\n");
    let found = asked(&mut corpus, &by(&["handshape", "location"])).expect("counted");
    assert_eq!(found.entropy.value, Some(0.0));
    assert_eq!(found.fields[0].load.why, Some("all entries have the same form"));
    let nothing = StatsOptions {
        query: Some("gloss=Z".to_owned()),
        ..by(&["handshape", "location"])
    };
    let found = asked(&mut corpus, &nothing).expect("counted");
    assert_eq!(found.entries, 0);
    assert_eq!(found.entropy.why, Some("no entry has a value in all of the fields"));
    assert_eq!(found.fields[0].entropy.why, Some("no entry has a value"));
    let mut empty = Corpus::create_corpus(&folder.path().join("e.chereme"), "A").expect("made");
    let found = asked(&mut empty, &StatsOptions::default()).expect("counted");
    assert!(found.fields.is_empty() && found.entropy.value.is_none());
    assert!(asked(&mut empty, &by(&["nosuch"])).is_err());
    let many = StatsOptions {
        samples: 1_000_000,
        ..StatsOptions::default()
    };
    assert!(asked(&mut empty, &many).is_err());
}

#[test]
fn each_kind_of_statistics_is_written_as_a_table() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_with(folder.path(), TABLE);
    let fields = ["handedness", "handshape", "handshape weak", "location"];
    let of = Some("handedness".to_owned());
    let between = Some(["handedness", "handshape"].map(str::to_owned));
    let cases = [
        (by(&fields), 5, "handshape weak,3,6,3,0,1."),
        (StatsOptions { of, ..by(&fields) }, 5, "1,3,0.333333,0."),
        (
            StatsOptions {
                between,
                samples: 0,
                ..by(&fields)
            },
            5,
            "2a,0,3,0,0,3\n",
        ),
        (
            StatsOptions {
                battison: true,
                ..by(&fields)
            },
            3,
            "dominance,F,1,V,7\n",
        ),
    ];
    for (at, (options, lines, wanted)) in cases.into_iter().enumerate() {
        let found = asked(&mut corpus, &options).expect("counted");
        let path = folder.path().join(format!("{at}.csv"));
        found.write_table(&path, false).expect("written");
        assert!(found.write_table(&path, false).is_err(), "it is there already");
        let text = std::fs::read_to_string(&path).expect("read");
        assert!(text.contains(wanted) && text.lines().count() == lines, "{text}");
    }
}

/// Returns the corpus of the shared lexicon, and the folder in which it lies.
fn shared() -> Option<(tempfile::TempDir, Corpus)> {
    let Ok(shared) = std::env::var("CHEREME_SHARED_DATA") else {
        eprintln!("CHEREME_SHARED_DATA is not set: the lexicon was not counted");
        return None;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let file = Path::new(&shared).join("phonology/ngt_lexicon.tsv");
    let corpus = corpus_of(folder.path(), &file);
    Some((folder, corpus))
}

#[test]
fn entropies_and_loads_of_the_shared_lexicon_equal_an_independent_count() {
    let Some((_folder, mut corpus)) = shared() else {
        return;
    };
    let found = asked(&mut corpus, &by(&["S13"])).expect("counted");
    assert_eq!((found.entries, found.forms), (2145, 1873));
    near(&found.entropy, 10.784_224, 5e-7);
    // Entropy with the empty cell and without it, values, empty cells, load.
    for (field, entropy, given, values, empty, load) in [
        ("Handshape strong", 4.4707, 4.4707, 70, 0, 0.057_505),
        ("Movement direction", 3.2811, 3.3854, 39, 613, 0.021_884),
        ("Location", 2.8974, 2.8974, 70, 0, 0.013_786),
        ("Handshape weak", 2.7705, 3.8453, 47, 1155, 0.001_053),
        ("Relative orientation movement", 2.6219, 2.5437, 17, 704, 0.013_579),
        ("Movement shape", 2.2957, 3.5052, 40, 1327, 0.017_546),
        ("Contact type", 1.8017, 2.2350, 9, 1334, 0.002_611),
        ("Handedness", 1.4087, 1.4087, 5, 0, 0.000_444),
        ("Handshape change", 0.9257, 2.7126, 23, 1860, 0.002_806),
        ("Repeated Movement", 0.8638, 0.0, 1, 1531, 0.009_335),
        ("Relation between articulators", 0.4135, 4.2604, 30, 2059, 0.000_720),
        ("Alternating Movement", 0.3224, 0.0, 1, 2019, 0.001_399),
        ("Relative orientation location", 0.0058, 0.0, 1, 2144, 0.0),
    ] {
        let own = found.fields.iter().find(|it| it.field == field);
        let own = own.expect("the field");
        near(&own.entropy, entropy, 1e-4);
        near(&own.entropy_given, given, 1e-4);
        near(&own.load, load, 1e-6);
        assert_eq!((own.values, own.empty), (values, empty), "{field}");
    }
    for it in &found.fields {
        if let (Some(value), Some(ends)) = (it.load.value, it.load.interval) {
            assert!(ends.low <= value && value <= ends.high);
        }
    }
    let found = asked(&mut corpus, &by(&["F5"])).expect("counted");
    near(&found.entropy, 9.593_403, 5e-7);
    for (at, load) in [0.006_078, 0.187_176, 0.006_256, 0.113_668, 0.190_964]
        .into_iter()
        .enumerate()
    {
        near(&found.fields[at].load, load, 1e-6);
    }
    let options = StatsOptions {
        of: Some("Movement manner".to_owned()),
        ..StatsOptions::default()
    };
    let manner = asked(&mut corpus, &options).expect("counted").of.expect("asked for");
    near(&manner.statistics.entropy, 0.3654, 1e-4);
    near(&manner.statistics.entropy_given, 0.9709, 1e-4);
}

#[test]
fn contrasts_of_the_shared_lexicon_equal_an_independent_count() {
    let Some((_folder, mut corpus)) = shared() else {
        return;
    };
    let options = StatsOptions {
        of: Some("Handshape strong".to_owned()),
        ..by(&["S13"])
    };
    let of = asked(&mut corpus, &options).expect("counted").of.expect("asked for");
    let pairs: usize = of.contrasts.iter().map(|it| it.pairs).sum();
    assert_eq!(pairs, 2368);
    for (at, (a, b, pairs, load)) in [
        ("1", "B", 51, 0.002_680),
        ("1", "V", 50, 0.001_939),
        ("1", "A", 39, 0.001_935),
        ("B", "S", 28, 0.001_675),
        ("1", "money", 31, 0.001_544),
    ]
    .into_iter()
    .enumerate()
    {
        let own = &of.contrasts[at];
        assert_eq!((&*own.a, &*own.b), (a, b));
        assert!((own.load - load).abs() < 1e-6, "{own:?}");
        assert_eq!(own.pairs, pairs);
    }
    let pairs_of = |a: &str, b: &str| {
        let found = of.contrasts.iter().find(|it| (&*it.a, &*it.b) == (a, b));
        found.map_or(0, |it| it.pairs)
    };
    let others = [("1", "S"), ("1", "5"), ("B", "S"), ("1", "L")].map(|(a, b)| pairs_of(a, b));
    assert_eq!(others, [38, 32, 28, 28]);
}

#[test]
fn associations_of_the_shared_lexicon_equal_an_independent_count() {
    let Some((_folder, mut corpus)) = shared() else {
        return;
    };
    for (one, other, n, bits, chi_square, df, v) in [
        ("Handshape strong", "Location", 2145, 0.4751, 5523.64, 4761, 0.1932),
        ("Handedness", "Location", 2145, 0.4831, 1837.25, 276, 0.4627),
        (
            "Handshape strong",
            "Handshape weak",
            990,
            3.1409,
            30171.73,
            2024,
            0.8323,
        ),
        (
            "Handshape strong",
            "Movement direction",
            1532,
            0.4147,
            1720.56,
            2014,
            0.1719,
        ),
        ("Location", "Contact type", 811, 0.5780, 2481.84, 472, 0.6185),
    ] {
        let options = StatsOptions {
            between: Some([one.to_owned(), other.to_owned()]),
            samples: 20,
            ..StatsOptions::default()
        };
        let it = asked(&mut corpus, &options)
            .expect("counted")
            .between
            .expect("asked for");
        assert_eq!((it.n, it.df), (n, df), "{one} {other}");
        near(&it.bits, bits, 1e-4);
        near(&it.chi_square, chi_square, 0.01);
        near(&it.cramers_v, v, 1e-4);
        let again = asked(&mut corpus, &options).expect("counted").between;
        assert_eq!(again.as_ref(), Some(&it), "the same seed gives the same numbers");
        if (one, other) == ("Handshape strong", "Location") {
            let places = ["neutral space", "weak hand", "chest", "chin", "head"];
            for (shape, counts) in [
                ("B", [182, 61, 20, 9, 15]),
                ("1", [138, 23, 9, 12, 11]),
                ("5", [124, 7, 15, 3, 8]),
                ("S", [110, 24, 12, 7, 3]),
                ("T", [56, 10, 3, 5, 5]),
            ] {
                let own = places.map(|place| {
                    let mut cells = it.cells.iter();
                    let cell = cells.find(|it| (&*it.row, &*it.column) == (shape, place));
                    cell.map_or(0, |it| it.count)
                });
                assert_eq!(own, counts, "{shape}");
            }
        }
    }
}

#[test]
fn conditions_and_oddities_of_the_shared_lexicon_equal_an_independent_count() {
    let Some((_folder, mut corpus)) = shared() else {
        return;
    };
    let options = StatsOptions {
        battison: true,
        ..by(&["S13"])
    };
    let found = asked(&mut corpus, &options).expect("counted");
    let it = found.battison.expect("asked for");
    assert_eq!((it.one_handed, it.other), (1158, 3));
    let numbers = |it: &HandCondition| (it.entries, it.given, it.same, it.different);
    assert_eq!(numbers(&it.symmetry), (699, 699, 678, 21));
    assert_eq!(numbers(&it.dominance), (285, 283, 141, 142));
    assert_eq!(it.dominance.different_unmarked, 131);
    near(&it.dominance.unmarked_share, 0.8799, 1e-4);
    assert_eq!((it.symmetry.exceptions.len(), it.dominance.exceptions.len()), (21, 11));
    for gloss in [
        "AANTREKKEN",
        "SUKKEL-A",
        "AUSTRALIE",
        "EZEL-A",
        "AANPAKKEN",
        "WERKELOOS",
    ] {
        assert!(it.symmetry.exceptions.iter().any(|it| it.gloss == gloss), "{gloss}");
    }
    for (weak, count) in [
        ("beak-open", 3),
        ("B-curved", 3),
        ("counting hand", 1),
        ("S, closing", 1),
        ("V", 1),
        ("3", 1),
        ("4", 1),
    ] {
        let own = it.dominance.exceptions.iter().filter(|it| it.weak == weak);
        assert_eq!(own.count(), count, "{weak}");
    }
    let oddity = |start: &str| {
        let found = found.findings.iter().find(|it| it.message.starts_with(start));
        found.map_or(0, |it| it.glosses.len())
    };
    assert_eq!(oddity("one-handed entries with a handshape of the weak hand"), 5);
    assert_eq!(oddity("one-handed entries whose place is the weak hand"), 4);
    assert_eq!(oddity("Handedness: \"2S\" (2) and \"2s\" (699) differ only in case"), 2);
    assert_eq!(oddity("Handedness: \"2\" (1) is no known type"), 1);
    assert_eq!(oddity("alternating entries that are not symmetrical: 7"), 7);
    let successive = "cells with successive values, such as a > b, count as one value each: \
                      Contact type 40, Movement direction 27, Handshape change 25, Location 16, \
                      Relative orientation movement 7, Movement shape 6, Handshape weak 3";
    assert!(
        found.findings.iter().any(|it| it.message == successive),
        "{:?}",
        found.findings
    );
}

fn measured(corpus: &mut Corpus, options: &SignMeasureOptions) -> SignMeasures {
    corpus
        .measure_signs(options, &mut ProgressReceiver::silent_progress())
        .expect("measured")
}

fn measures_by(fields: &[&str], definition: NeighbourDefinition, within: usize) -> SignMeasureOptions {
    SignMeasureOptions {
        fields: fields.iter().map(|field| (*field).to_owned()).collect(),
        definition,
        within,
        ..SignMeasureOptions::default()
    }
}

#[test]
fn each_sign_has_the_neighbours_of_the_definition() {
    // A and B are homonyms, C differs in one field, D in two; E and F have nothing in common but empty cells.
    let table = "gloss,handshape,location,movement direction\n\
        A,B,chin,up\nB,B,chin,up\nC,S,chin,up\nD,S,chest,up\nE,,temple,\nF,,neck,\n";
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_with(folder.path(), table);
    let fields = ["handshape", "location", "movement direction"];
    for (definition, within, densities) in [
        (NeighbourDefinition::AslLex, 1, [2, 2, 3, 1, 0, 0]),
        (NeighbourDefinition::AslLex, 2, [3, 3, 3, 3, 0, 0]),
        (NeighbourDefinition::Signbank, 1, [1, 1, 3, 1, 1, 1]),
        (NeighbourDefinition::CorpusTools, 1, [1, 1, 2, 1, 1, 1]),
    ] {
        let measures = measured(&mut corpus, &measures_by(&fields, definition, within));
        let counted: Vec<u64> = measures.signs.iter().map(|sign| sign.density).collect();
        assert_eq!(counted, densities, "{definition:?} {within}");
    }
    let measures = measured(&mut corpus, &measures_by(&fields, NeighbourDefinition::AslLex, 1));
    let [first, _, third, ..] = &measures.signs[..] else {
        panic!("six signs");
    };
    assert_eq!(first.homonyms, ["B"]);
    assert_eq!((third.family.as_deref(), third.family_size), (Some("A"), Some(3)));
    assert_eq!(third.pairs_by_field["handshape"], 2);
    assert_eq!(third.pairs_by_field["location"], 1);
    // S is the handshape of two of four signs, chin the place of three of six, up the direction of all four.
    assert_eq!(third.probability, Some((0.5 + 0.5 + 1.0) / 3.0));
    // S with chin stands in one of four, S with up in two of four, chin with up in three of four.
    assert_eq!(third.pair_probability, Some((0.25 + 0.5 + 0.75) / 3.0));
}

#[test]
fn stored_measures_are_attributes_that_outlive_the_table() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = "gloss,handshape,location,Frequency\nA,B,chin,7\nB,S,chin,9\nC,S,chest,8\n";
    let mut corpus = corpus_with(folder.path(), table);
    let options = measures_by(&["handshape", "location"], NeighbourDefinition::AslLex, 1);
    let measures = measured(&mut corpus, &options);
    assert_eq!(corpus.store_sign_measures(&measures).expect("stored"), 3);
    let glosses = |corpus: &mut Corpus, query: &str, order: crate::HitOrder| -> Vec<String> {
        let options = crate::SearchOptions {
            order,
            ..crate::SearchOptions::default()
        };
        let answer = corpus.search_tokens(query, &options).expect("found");
        answer.hits.into_iter().map(|hit| hit.gloss).collect()
    };
    let rank = crate::HitOrder::Rank;
    assert_eq!(glosses(&mut corpus, "density>1", rank.clone()), ["B"]);
    assert_eq!(
        glosses(&mut corpus, "attribute.measure.density=1", rank.clone()),
        ["A", "C"]
    );
    let by_frequency = crate::HitOrder::AttributeDescending("frequency".into());
    assert_eq!(glosses(&mut corpus, "", by_frequency), ["B", "C", "A"]);
    let by_density = crate::HitOrder::Attribute("density".into());
    assert_eq!(glosses(&mut corpus, "", by_density), ["A", "C", "B"]);
    let progress = &mut ProgressReceiver::silent_progress();
    let tally = corpus
        .tally_values("", &["density".to_owned()], progress)
        .expect("counted");
    let counts: Vec<String> = tally
        .rows
        .iter()
        .map(|row| format!("{} {}", row.value, row.total))
        .collect();
    assert_eq!(counts, ["1 2", "2 1"]);
    let hit = corpus
        .search_tokens(
            "gloss=B",
            &crate::SearchOptions {
                order: crate::HitOrder::order_from_word("-density"),
                ..crate::SearchOptions::default()
            },
        )
        .expect("found");
    assert_eq!(hit.hits[0].order_values, ["2"]);
    let typo = crate::SearchOptions {
        order: crate::HitOrder::order_from_word("durration"),
        ..crate::SearchOptions::default()
    };
    let error = corpus.search_tokens("", &typo).expect_err("no such order");
    assert!(error.to_string().contains("did you mean \"duration\"?"), "{error}");
    // Signs that a query finds are measured among each other.
    let among = SignMeasureOptions {
        query: Some("frequency>7".to_owned()),
        ..options
    };
    let measures = measured(&mut corpus, &among);
    let counted: Vec<(&str, u64)> = measures
        .signs
        .iter()
        .map(|sign| (sign.gloss.as_str(), sign.density))
        .collect();
    assert_eq!(counted, [("B", 1), ("C", 1)]);
    // The table comes again with another frequency; measures are not its to remove.
    let file = folder.path().join("t.csv");
    std::fs::write(&file, table.replace(",9", ",99")).expect("written");
    let files = [file];
    corpus
        .import_paths(&files, &ImportOptions::default(), progress)
        .expect("imported");
    assert_eq!(glosses(&mut corpus, "density>1 frequency>90", rank), ["B"]);
}

#[test]
fn densities_of_a_lexicon_are_those_of_an_independent_count() {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_of(folder.path(), &Path::new(&data).join("phonology/ngt_lexicon.tsv"));
    // The mean, median, greatest and number of signs without a neighbour.
    for (set, mean, median, greatest, without) in [
        ("S13", 4.193, 1.0, 61, 733),
        ("F7", 17.526, 7.0, 135, 261),
        ("C3", 154.79, 119.0, 507, 8),
    ] {
        let measures = measured(&mut corpus, &measures_by(&[set], NeighbourDefinition::AslLex, 1));
        let most = measures.signs.iter().map(|sign| sign.density).max();
        assert!(
            (measures.mean_density - mean).abs() < 0.005,
            "{set} {}",
            measures.mean_density
        );
        assert_eq!(
            (measures.median_density, most, measures.without_neighbour),
            (median, Some(greatest), without)
        );
    }
}
