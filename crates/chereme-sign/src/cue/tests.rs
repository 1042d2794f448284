//! Tests of keys of cued speech against published charts, and of French pronunciation against texts keyed by hand.

use super::*;

/// Keys of phones in SAMPA as `shape-placement`, with findings as `!`.
fn keys_of(code_name: &str, sampa: &str) -> String {
    let code = find_cue_code(code_name).expect("a code of the program");
    let phones: Vec<SpokenPhone> = sampa.split_whitespace().map(SpokenPhone::new).collect();
    let (keys, findings) = code.phones_to_keys(&phones, PhoneAlphabet::Sampa);
    let mut words: Vec<String> = keys
        .iter()
        .map(|key| format!("{}-{}", key.shape, key.placement))
        .collect();
    words.extend(findings.iter().map(|_| "!".to_owned()));
    words.join(" ")
}

#[test]
fn every_built_in_code_is_read_completely() {
    let ids: Vec<&str> = all_cue_codes().iter().map(|code| code.id.as_str()).collect();
    assert_eq!(ids, ["french", "english-us", "english-gb"]);
    for code in all_cue_codes() {
        assert!(code.find_cue_shape(code.vowel_alone).is_some());
        assert!(code.find_cue_placement(&code.consonant_alone).is_some());
        for table in code.alphabets.values() {
            for sounds in table.values() {
                for sound in sounds.split(' ') {
                    let known = code.shape_of(sound).is_some() || code.path_of(sound).is_some();
                    assert!(known, "{}: {sound:?} has no key", code.id);
                }
            }
        }
    }
}

#[test]
fn consonants_and_vowels_share_keys_as_charts_print_them() {
    let cases = [
        ("french", "", ""),
        ("french", "#", ""),
        ("french", "p", "1-side"),
        ("french", "a", "5-side"),
        ("french", "p a", "1-side"),
        ("french", "b O~", "4-mouth"),
        ("french", "p # a", "1-side 5-side"),
        ("french", "p p a", "1-side 1-side"),
        ("french", "s p R a", "3-side 1-side 3-side"),
        ("french", "p j e", "1-side 8-throat"),
        ("french", "f i j", "5-mouth 8-side"),
        ("french", "l H i", "6-side 4-mouth"),
        ("french", "fp a", "5-side"),
        ("french", "m a X a", "5-side 5-side !"),
        ("french", "tS i", "5-side 6-mouth"),
        // The labels of SPPAS.
        ("french", "l O/ t E/", "6-chin 5-chin"),
        ("french", "v U~/ d a~ m o~", "2-cheek 1-mouth 5-mouth"),
        ("french", "p eu p oe R", "1-cheek 1-side 3-side"),
        ("english-us", "m aI h aU s", "5-side 5-throat 3-side 5-throat 3-side"),
        ("english-us", "j i: s t", "8-mouth 3-side 5-side"),
        ("english-us", "dZ V dZ", "7-side-down 7-side"),
        ("english-us", "k @U v", "2-side-forward 2-side"),
    ];
    for (code, sampa, expected) in cases {
        assert_eq!(keys_of(code, sampa), expected, "{code}: {sampa}");
    }
}

#[test]
fn three_alphabets_give_the_same_keys() {
    let french = find_cue_code("fr").expect("French");
    let say = |text: &str, alphabet| {
        let phones: Vec<SpokenPhone> = text.split_whitespace().map(SpokenPhone::new).collect();
        let (keys, findings) = french.phones_to_keys(&phones, alphabet);
        assert_eq!(findings, [], "{text}");
        let plain: Vec<(u8, String)> = keys.into_iter().map(|it| (it.shape, it.placement)).collect();
        plain
    };
    let sampa = say("k i l a m O~ t R e # tS E k", PhoneAlphabet::Sampa);
    assert_eq!(sampa, say("k i l a m ɔ̃ t ʁ e | tʃ ɛ k", PhoneAlphabet::Ipa));
    assert_eq!(sampa, say("c i l a mʲ ɔ̃ t ʁ e sil tʃ ɛː k", PhoneAlphabet::Mfa));
}

#[test]
fn a_variant_changes_only_the_keys_that_it_names() {
    let french = find_cue_code("french").expect("French");
    let usual = |code: &CueCode, phone: &str| {
        let (keys, _) = code.phones_to_keys(&[SpokenPhone::new(phone)], PhoneAlphabet::Sampa);
        format!("{}-{}", keys[0].shape, keys[0].placement)
    };
    let other = french
        .with_variants(&["schwa-as-eu", "closed-thumb-alone"])
        .expect("variants of the code");
    assert_eq!(usual(french, "@"), "5-side");
    assert_eq!(usual(&other, "@"), "4-cheek");
    assert_eq!(usual(&other, "9~"), "4-throat");
    let error = french.with_variants(&["nonsense"]).expect_err("no such variant");
    assert!(error.to_string().contains("un-as-in"), "{error}");
    let english = find_cue_code("english-us").expect("American");
    let throat = english.with_variants(&["final-ee-at-throat"]).expect("a variant");
    let phones: Vec<SpokenPhone> = "h { p i:".split(' ').map(SpokenPhone::new).collect();
    let (keys, _) = throat.phones_to_keys(&phones, PhoneAlphabet::Sampa);
    assert_eq!(keys[1].placement, "throat");
}

#[test]
fn keys_have_the_times_of_their_phones() {
    use chereme_motion::RecordingInstant;
    let at = |from, to| {
        Some(TimeSpan::span_between(
            RecordingInstant::from_millis(from),
            RecordingInstant::from_millis(to),
        ))
    };
    let phone = |label: &str, span| SpokenPhone {
        label: label.to_owned(),
        span,
    };
    let phones = [
        phone("p", at(0, 80)),
        phone("a", at(80, 200)),
        phone("t", at(150, 300)),
        phone("i", None),
    ];
    let french = find_cue_code("french").expect("French");
    let (keys, findings) = french.phones_to_keys(&phones, PhoneAlphabet::Sampa);
    assert_eq!(keys[0].span, at(0, 200));
    assert_eq!(keys[0].vowel, at(80, 200));
    assert_eq!(keys[1].span, None, "one phone has no time");
    assert_eq!(
        findings,
        [CueFinding::Overlap {
            position: 3,
            label: "t".to_owned()
        }]
    );
}

fn said(text: &str, options: french::PronunciationOptions) -> String {
    let spoken = french::pronounce_french_text(text, options);
    let phones: Vec<&str> = spoken.spoken_phones().collect();
    phones.join(" ")
}

#[test]
fn french_spelling_is_read_by_rules_lists_and_neighbours() {
    let usual = french::PronunciationOptions::default();
    let cases = [
        ("oiseau", "w a z o"),
        ("parlent", "p a R l"),
        ("prient", "p R i"),
        ("jouent", "Z u"),
        ("priant", "p R i j A~"),
        ("patients", "p a s j A~"),
        ("subsister", "s y b z i s t e"),
        ("quelque grain", "k E l k @ g R E~"),
        ("quelque peu", "k E l k p 2"),
        ("content", "k O~ t A~"),
        ("grenouille", "g R @ n u j"),
        ("aujourd'hui", "o Z u R d H i"),
        ("les amis", "l e z a m i"),
        ("les héros", "l e e R o"),
        ("les haricots", "l e a R i k o"),
        ("les hiboux", "l e i b u"),
        ("les herbes", "l e z E R b"),
        ("bon ami", "b O n a m i"),
        ("bon et grand", "b O~ e g R A~"),
        ("premier étage", "p R @ m j E R e t a Z"),
        ("le premier à venir", "l @ p R @ m j e a v @ n i R"),
        ("ancien ami", "A~ s j E n a m i"),
        ("ils hurlent", "i l y R l"),
        ("ils content leurs voyages", "i l k O~ t l 9 R v w a j a Z"),
        ("elles ne se violent pas", "E l n @ s @ v j O l p a"),
        ("ils sont content", "i l s O~ k O~ t A~"),
        ("le couvent", "l @ k u v A~"),
        ("nous portions", "n u p O R t j O~"),
        ("nous ne partions pas", "n u n @ p a R t j O~ p a"),
        ("les portions", "l e p O R s j O~"),
        ("les hauteurs", "l e o t 9 R"),
        ("les hommes", "l e z O m"),
        ("dix ans", "d i z A~"),
        ("Maître corbeau", "m E t R @ k O R b o"),
        ("quatre amis", "k a t R a m i"),
        ("l’été", "l e t e"),
        ("oui, non", "w i # n O~"),
    ];
    for (text, expected) in cases {
        assert_eq!(said(text, usual), expected, "{text}");
    }
    let plain = french::PronunciationOptions {
        liaison: false,
        schwa: french::SchwaCondition::Dropped,
    };
    assert_eq!(said("les amis", plain), "l e a m i");
    assert_eq!(said("maître corbeau", plain), "m E t R k O R b o");
}

#[test]
fn numbers_are_read_as_their_words() {
    let usual = french::PronunciationOptions::default();
    for (digits, words) in [
        ("0", "zéro"),
        ("1", "un"),
        ("16", "seize"),
        ("17 ans", "dix-sept ans"),
        ("19", "dix-neuf"),
        ("21", "vingt et un"),
        ("22 ans", "vingt-deux ans"),
        ("70", "soixante-dix"),
        ("71", "soixante et onze"),
        ("80 ans", "quatre-vingts ans"),
        ("81", "quatre-vingt-un"),
        ("92 élèves", "quatre-vingt-douze élèves"),
        ("99", "quatre-vingt-dix-neuf"),
        ("100 amis", "cent amis"),
        ("101", "cent un"),
        ("200 ans", "deux cents ans"),
        ("250", "deux cent cinquante"),
        ("1000", "mille"),
        ("1 999", "mille neuf cent quatre-vingt-dix-neuf"),
        ("200000", "deux cent mille"),
        ("80 000", "quatre-vingt mille"),
        ("3 000 001", "trois millions un"),
        ("2000000000", "deux milliards"),
        ("3,5", "trois virgule cinq"),
        ("3,05", "trois virgule zéro cinq"),
        ("1er, 2e", "premier, deuxième"),
        ("21e", "vingt et unième"),
        ("8h30", "huit heures trente"),
        ("1 h", "une heure"),
        ("9 heures", "neuf heures"),
        ("5 %", "cinq pour cent"),
        ("les 12", "les douze"),
        ("007", "zéro zéro sept"),
        (
            "01 23 45 67 89",
            "zéro un vingt-trois quarante-cinq soixante-sept quatre-vingt-neuf",
        ),
        ("14/07/1789", "quatorze juillet mille sept cent quatre-vingt-neuf"),
        ("le 1/5/24", "le premier mai vingt-quatre"),
        ("3/4 et 1/2", "trois quarts et un demi"),
        ("2/3, 5/8", "deux tiers, cinq huitièmes"),
        ("Louis XIV", "Louis quatorze"),
        ("le XVIe siècle", "le seizième siècle"),
        ("François Ier, tome III", "François premier, tome trois"),
        ("Le Xe", "le dixième"),
    ] {
        assert_eq!(said(digits, usual), said(words, usual), "{digits}");
    }
    for (text, expected) in [
        ("six chats", "s i S a"),
        ("six amis", "s i z a m i"),
        ("j'en ai six.", "Z A~ n e s i s #"),
        ("dix-sept", "d i s E t"),
        ("dix-huit", "d i z H i t"),
        ("vingt-deux", "v E~ t d 2"),
        ("quatre-vingt-deux", "k a t R @ v E~ d 2"),
        ("vingt et un", "v E~ t e 9~"),
        ("cent un", "s A~ 9~"),
        ("cent ans", "s A~ t A~"),
        ("neuf ans", "n 9 v A~"),
    ] {
        assert_eq!(said(text, usual), expected, "{text}");
    }
    let long = "9".repeat(40);
    let spoken = french::pronounce_french_text(&long, usual);
    assert_eq!(spoken.findings, [CueFinding::NotAWord { text: long }]);
}

#[test]
fn capitals_are_spelled_and_short_forms_said_in_full() {
    let usual = french::PronunciationOptions::default();
    for (text, expected) in [
        ("la SNCF", "l a E s E n s e E f"),
        ("S.N.C.F.", "E s E n s e E f"),
        ("EDF et GDF", "2 d e E f e Z e d e E f"),
        ("l'ONU", "l O n y"),
        ("LE CHAT", "l @ S a"),
    ] {
        assert_eq!(said(text, usual), expected, "{text}");
    }
    for (short, long) in [
        ("M. Dupont", "monsieur Dupont"),
        ("Mme et Mlle Dupont", "madame et mademoiselle Dupont"),
        ("le Dr Dupont", "le docteur Dupont"),
        ("10 km", "dix kilomètres"),
        ("etc.", "et cétéra."),
    ] {
        assert_eq!(said(short, usual), said(long, usual), "{short}");
    }
}

#[test]
fn capitals_are_spelled_if_they_are_no_word_and_letters_alone_have_their_names() {
    let usual = french::PronunciationOptions::default();
    for (text, expected) in [
        ("la TVA", "l a t e v e a"),
        ("un CDI", "9~ s e d e i"),
        ("l'ENA", "l e n a"),
        ("l'INSEE", "l E~ s e"),
        ("le CROUS", "l @ k R u s"),
        ("la FNAC", "l a f n a k"),
        ("l'UNESCO", "l y n E s k o"),
        ("l'IA", "l i a"),
        ("une BD", "y n b e d e"),
        ("Bd Voltaire", "b u l @ v a R v O l t E R"),
        ("des ONGs", "d e z o E n Z e"),
        ("un SMS", "9~ n E s E m E s"),
        ("le CNRS", "l @ s e E n E R E s"),
        ("la LfPC", "l a E l E f p e s e"),
        ("un dvd", "9~ d e v e d e"),
        ("TU dois", "t y d w a"),
        ("c'est TRÈS bien", "s E t R E b j E~"),
        ("LE CHAT DORT", "l @ S a d O R"),
        ("le plan b", "l @ p l A~ b e"),
        ("4x4", "k a t R i k s k a t R"),
        ("l ami", "l a m i"),
        ("a-t-il", "a t i l"),
        ("y a-t-il", "i a t i l"),
    ] {
        assert_eq!(said(text, usual), expected, "{text}");
    }
}

#[test]
fn signs_are_said_or_reported_and_never_lost() {
    let usual = french::PronunciationOptions::default();
    for (short, long) in [
        ("10 €", "dix euros"),
        ("3,50 €", "trois virgule cinquante euros"),
        ("3,5%", "trois virgule cinq pour cent"),
        ("20 °C", "vingt degrés"),
        ("-5", "moins cinq"),
        ("n° 5", "numéro cinq"),
        ("5 & 6", "cinq et six"),
        ("50 km/h", "cinquante kilomètres heure"),
        ("5 m, 10 min", "cinq mètres, dix minutes"),
        ("1 min", "une minutes"),
        ("3 l'aiment", "trois l'aiment"),
        ("et/ou", "et ou"),
        ("« oui »", "oui"),
    ] {
        let spoken = french::pronounce_french_text(short, usual);
        assert_eq!(said(short, usual), said(long, usual), "{short}");
        assert_eq!(spoken.findings, [], "{short}");
    }
    for (text, sign) in [
        ("deux + deux", "+"),
        ("étudiant·e·s", "·e·s"),
        ("*** fin", "***"),
        ("a ♥ b", "♥"),
    ] {
        let spoken = french::pronounce_french_text(text, usual);
        let text = sign.to_owned();
        assert_eq!(spoken.findings, [CueFinding::NotAWord { text }]);
    }
}

#[test]
fn words_that_are_not_french_are_reported() {
    let spoken = french::pronounce_french_text("½ чат", french::PronunciationOptions::default());
    let reported: Vec<String> = spoken.findings.iter().map(ToString::to_string).collect();
    assert_eq!(reported[0], "\"½\" was left out; write it in words");
    assert!(reported[1].contains("'ч'"), "{reported:?}");
}

#[test]
fn words_of_two_readings_are_reported_once_and_chosen_by_braces_or_dictionary() {
    let code = find_cue_code("french").expect("a code");
    let read = |text: &str, dictionary: &str| {
        let listed = PronunciationDictionary::read_dictionary(dictionary, code).ok();
        let reading = UtteranceReading {
            dictionary: listed.map(std::sync::Arc::new),
            ..UtteranceReading::default()
        };
        let read = CuedUtterance::read_cued_utterance(text, &reading).expect("read");
        let labels: Vec<String> = read.phones.into_iter().map(|phone| phone.label).collect();
        (labels.join(" "), read.findings)
    };
    let (phones, findings) = read("mes fils, mes fils", "");
    assert_eq!(phones, "m e f i s # m e f i s");
    let [CueFinding::TwoReadings { choice, .. }] = &findings[..] else {
        panic!("{findings:?}");
    };
    assert_eq!(choice, "fils{f i l}");
    for (text, dictionary, expected) in [
        ("mes fils{f i l}", "", "m e f i l"),
        ("mes fils{fil} et {S@val}", "", "m e f i l e S @ v a l"),
        ("les {a~.fa~}", "", "l e A~ f A~"),
        ("les clefs", "clefs\tk l E\nzzz\tk l e", "l e k l E"),
        ("les amis", "amis;a~mi\n", "l e z A~ m i"),
        ("L'Été", "été [été] e t e\nété(2) a\n", "l e t e"),
        (
            "fils",
            "1_ortho\t2_phon\t9_freqfilms2\nfils\tfil\t3,5\nfils\tfis\t88,1",
            "f i s",
        ),
        ("chanter", "ortho\tphon\nchanter\tS@te", "S A~ t e"),
        ("fils", "fils\t0.99\t0.1\t1.0\t1.0\tf i l", "f i l"),
    ] {
        assert_eq!(read(text, dictionary).0, expected, "{text}");
    }
    for wrong in ["", "fils", "fils\tx q", "{}"] {
        assert!(
            PronunciationDictionary::read_dictionary(wrong, code).is_err(),
            "{wrong}"
        );
    }
    let american = UtteranceReading {
        code: "english-us".to_owned(),
        dictionary: PronunciationDictionary::read_dictionary(
            ";;; CMU\nHELLO  HH AH0 L OW1",
            find_cue_code("en").expect("a code"),
        )
        .ok()
        .map(std::sync::Arc::new),
        ..UtteranceReading::default()
    };
    let read = CuedUtterance::read_cued_utterance("Hello, world!", &american).expect("read");
    assert_eq!(read.words[0].0, "hello");
    assert_eq!(
        read.findings,
        [CueFinding::NotInDictionary {
            word: "world".to_owned()
        }]
    );
}

#[test]
fn words_with_times_link_and_share_their_time() {
    let timed = |text: &str, from: i64, to: i64| TimedText {
        text: text.to_owned(),
        span: TimeSpan::span_between(
            chereme_motion::RecordingInstant::from_millis(from),
            chereme_motion::RecordingInstant::from_millis(to),
        ),
    };
    let texts = [
        timed("les", 100, 400),
        timed("enfants", 400, 1000),
        timed("#", 1000, 1500),
        timed("c'est\nla_vie.", 1500, 2500),
    ];
    let read = CuedUtterance::read_timed_texts(&texts, &UtteranceReading::default()).expect("read");
    let labels: Vec<&str> = read.phones.iter().map(|phone| phone.label.as_str()).collect();
    assert_eq!(labels.join(" "), "# l e z A~ f A~ # s E l a v i");
    let ends: Vec<i64> = read
        .phones
        .iter()
        .filter_map(|phone| Some(phone.span?.span_end_instant().instant_millis()))
        .collect();
    assert_eq!(
        (ends[3], ends[6], ends[7], ends[13]),
        (400, 1000, 1500, 2500),
        "{ends:?}"
    );
    assert!(ends.is_sorted());
    let words: Vec<&str> = read.words.iter().map(|word| word.0.as_str()).collect();
    assert_eq!(words, ["les", "enfants", "c'", "est", "la", "vie"]);
    assert_eq!(
        read.keys[0].span.map(|span| span.span_start_instant().instant_millis()),
        Some(100)
    );
}

#[test]
fn uncertain_mid_vowels_are_marked() {
    let spoken = french::pronounce_french_text("maison", french::PronunciationOptions::default());
    assert_eq!(spoken.words[0].doubtful, [1]);
}

/// Rows of a table of expected values, cell by cell.
fn rows(table: &str) -> impl Iterator<Item = Vec<&str>> {
    let lines = table.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| line.split('\t').collect())
}

#[test]
fn every_published_key_is_reproduced_from_sampa_and_ipa() {
    let mut wrong = Vec::new();
    for row in rows(include_str!("vectors.tsv")) {
        let [name, _, sampa, ipa, expected] = row[..] else {
            panic!("a row of five cells: {row:?}");
        };
        let plain = |keys: Vec<HandCueKey>| {
            let words = keys.iter().map(|key| format!("{}-{}", key.shape, key.placement));
            words.collect::<Vec<String>>().join(" ")
        };
        let code = find_cue_code(name).expect("a code");
        for (text, alphabet) in [(sampa, PhoneAlphabet::Sampa), (ipa, PhoneAlphabet::Ipa)] {
            if alphabet == PhoneAlphabet::Ipa && name != "french" {
                continue;
            }
            let phones: Vec<SpokenPhone> = text.split_whitespace().map(SpokenPhone::new).collect();
            let found = plain(code.phones_to_keys(&phones, alphabet).0);
            if found != expected {
                wrong.push(format!("{text}: {found}, not {expected}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn words_are_converted_to_phones_by_the_rules() {
    let mut wrong = Vec::new();
    for row in rows(include_str!("spelling.tsv")) {
        let found = said(row[0], french::PronunciationOptions::default());
        if found != row[1] {
            wrong.push(format!("{}: {found}, not {}", row[0], row[1]));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn keys_of_sentences_agree_closely_with_keys_written_by_hand() {
    let french = find_cue_code("french").expect("French");
    let (mut errors, mut all, mut lines) = (0, 0, Vec::new());
    for row in rows(include_str!("vectors.tsv")) {
        if row[0] != "french" || !row[1].ends_with(['.', '?']) {
            continue;
        }
        let spoken = french::pronounce_french_text(row[1], french::PronunciationOptions::default());
        let phones: Vec<SpokenPhone> = spoken.spoken_phones().map(SpokenPhone::new).collect();
        let (keys, _) = french.phones_to_keys(&phones, PhoneAlphabet::Sampa);
        let found: Vec<String> = keys
            .iter()
            .map(|key| format!("{}-{}", key.shape, key.placement))
            .collect();
        let expected: Vec<&str> = row[4].split(' ').collect();
        let off = edits(&found, &expected);
        errors += off;
        all += expected.len();
        if off > 0 {
            lines.push(format!(
                "{off}: {} -> {:?}",
                row[1],
                spoken.spoken_phones().collect::<Vec<_>>().join(" ")
            ));
        }
    }
    assert_eq!(all, 191, "the keys of twelve sentences");
    assert!(errors <= 2, "{errors} of {all} keys\n{}", lines.join("\n"));
}

/// Returns the number of insertions, deletions and substitutions that lead from one list to the other.
fn edits(a: &[String], b: &[&str]) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, left) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, right) in b.iter().enumerate() {
            let above = row[j + 1];
            let change = diagonal + usize::from(left != right);
            row[j + 1] = change.min(above + 1).min(row[j] + 1);
            diagonal = above;
        }
    }
    row[b.len()]
}

#[test]
fn british_keys_warn_of_unchecked_vowels_and_agree_with_aligners() {
    let british = find_cue_code("en-GB").expect("British");
    let keys = |labels: &str, alphabet: PhoneAlphabet| {
        let phones: Vec<SpokenPhone> = labels.split(' ').map(SpokenPhone::new).collect();
        let (keys, findings) = british.phones_to_keys(&phones, alphabet);
        let cautions = findings
            .iter()
            .filter(|it| matches!(it, CueFinding::Unchecked { .. }))
            .count();
        assert_eq!((findings.len(), cautions), (1, 1), "{labels}: {findings:?}");
        let keys = keys.iter().map(|key| format!("{}-{}", key.shape, key.placement));
        keys.collect::<Vec<String>>().join(" ")
    };
    assert_eq!(keys("h Q t", PhoneAlphabet::Sampa), "3-side-forward 5-side");
    assert_eq!(keys("h ɒ t", PhoneAlphabet::Ipa), "3-side-forward 5-side");
    assert_eq!(keys("b eə", PhoneAlphabet::Ipa), "4-chin 5-side-down");
    assert_eq!(keys("HH AW1 S", PhoneAlphabet::Mfa), keys("h aʊ s", PhoneAlphabet::Ipa));
    assert!(british.phones_to_keys(&[], PhoneAlphabet::Ipa).1.is_empty());
}

#[test]
fn keys_of_fables_agree_closely_with_keys_written_by_hand() {
    let french = find_cue_code("french").expect("French");
    let cigale = include_str!("../../../../tests/examples/cued/fable.txt").lines();
    let corbeau = include_str!("../../../../tests/examples/cued/corbeau.txt").lines();
    let by_hand = include_str!("../../../../tests/examples/cued/fable-phones.txt").lines();
    let second = include_str!("../../../../tests/examples/cued/corbeau-phones.txt").lines();
    let (mut errors, mut all, mut lines) = (0, 0, Vec::new());
    for (line, phones) in cigale.chain(corbeau).zip(by_hand.chain(second)) {
        let named = |phones: &[SpokenPhone]| -> Vec<String> {
            let keys = french.phones_to_keys(phones, PhoneAlphabet::Sampa).0;
            let words = keys.iter().map(|key| format!("{}-{}", key.shape, key.placement));
            words.collect()
        };
        let expected: Vec<SpokenPhone> = phones.split(' ').map(SpokenPhone::new).collect();
        let expected = named(&expected);
        let spoken = french::pronounce_french_text(line, french::PronunciationOptions::default());
        let found: Vec<SpokenPhone> = spoken.spoken_phones().map(SpokenPhone::new).collect();
        let expected: Vec<&str> = expected.iter().map(String::as_str).collect();
        let off = edits(&named(&found), &expected);
        errors += off;
        all += expected.len();
        if off > 0 {
            let said: Vec<&str> = spoken.spoken_phones().collect();
            lines.push(format!("{off}: {line}\n   {}\n   {phones}", said.join(" ")));
        }
    }
    assert!(
        all > 400 && errors * 100 <= 2 * all,
        "{errors} of {all} keys\n{}",
        lines.join("\n")
    );
}

#[test]
fn verbs_link_to_their_pronouns_and_nouns_do_not() {
    let usual = french::PronunciationOptions::default();
    for (text, expected) in [
        ("dit-elle", "d i t E l"),
        ("a-t-il", "a t i l"),
        ("prend-on", "p R A~ t O~"),
        ("allez-y", "a l e z i"),
        ("tenait en", "t @ n E t A~"),
        ("le lait est", "l @ l E E"),
        ("pas un", "p a z 9~"),
        ("jusqu'à", "Z y s k a"),
        ("faisiez-vous au", "f @ z j e v u o"),
        ("allez-vous-en", "a l e v u z A~"),
        ("mais un peu", "m E z 9~ p 2"),
        ("il tint à", "i l t E~ t a"),
    ] {
        assert_eq!(said(text, usual), expected, "{text}");
    }
}
