//! Tests of reading HamNoSys: printed forms, other spellings, ambiguous symbols, refusals, and losses.

use super::*;
use crate::hamnosys::print_hamnosys;
use crate::hamnosys::tree::*;
use crate::hamnosys::{CompassDirection, SpatialDirection, from_names, to_names};

/// The text of symbols given by their names without `ham`.
fn text(names: &str) -> String {
    from_names(names.split_whitespace()).expect("known names")
}

fn read(names: &str) -> HamnosysTranscription {
    let text = text(names);
    let read = parse_hamnosys(&text).unwrap_or_else(|error| panic!("{names}: {error}"));
    assert_eq!(read.transcription_text(), text, "{names}");
    read
}

fn first(names: &str) -> ManualPart {
    read(names).sign.parts.swap_remove(0)
}

/// Returns whether some part remembers its spelling.
fn remembers(sign: &HamnosysSign) -> bool {
    format!("{sign:?}").contains("WrittenSymbols(Some(")
}

#[test]
fn canonical_text_reads_and_prints_without_loss() {
    for names in [
        // symmetry
        "symmpar flathand extfingero palmd moveo",
        "symmlr fingerstraightmod largemod alternatingmotion nonipsi fist extfingeru palml circlel",
        "nondominant fist extfingerl palmu shoulders moveu",
        // handshapes
        "finger2 thumboutmod fingerstraightmod extfingero palmd",
        "flathand thumboutmod between finger2345 fingerbendmod etc extfingero palmd",
        "ceeall thumbacrossmod fingerbendmod extfingero palml",
        "flathand fingerstraightmod between fingerbendmod extfingero palml",
        "finger2345 fingerbendmod thumb pinky extfingero palml",
        "finger2 pinky extfingero palml",
        "finger23spread ringfinger pinky extfingero palml",
        "pinch12 middlefinger ringfinger extfingero palml",
        "cee12open middlefinger largemod extfingero palml",
        "flathand thumb fingerbendmod ringfinger doublebent extfingero palml",
        "finger23 indexfinger fingernail middlefinger extfingero palml",
        "finger23 middlefinger cross indexfinger extfingero palml",
        "fist between indexfinger middlefinger extfingero palml",
        "flathand thumbacrossmod between extfingero palml",
        "pinch12 fingerpad extfingero palml",
        // orientation
        "fist extfingeru between extfingeruo palmd between palmdl",
        "fist extfingeruo extfingerol palmd etc",
        "fist extfingerdi extfingerir between extfingeri orirelative palmd orirelative",
        // places
        "fist extfingeru palmd neutralspace armextended",
        "fist extfingeru palmd neutralspace moveu",
        "fist extfingeru palmd lrat chest between shoulders lrbeside behind close",
        "fist extfingeru palmd lips doublehooked seqbegin touch fingernail indexfinger palm seqend",
        "fist extfingeru palmd eyes doublebent etc touch",
        "fist extfingeru palmd lowerarm handback touch",
        "fist extfingeru palmd wristpulse touch",
        "fist extfingeru palmd fingertip thumb indexfinger between fingerbase middlefinger touch",
        "fist extfingeru palmd palm seqbegin interlock fingerside seqend",
        "fist extfingeru palmd chest coreftag coreftag moveu corefref corefref",
        "symmlr fist extfingeru palmd touch moveu",
        "symmlr fist extfingeru palmd close chest touch",
        "symmlr fist extfingeru palmd parbegin fingertip indexfinger lrat plus palm parend cross chest",
        "symmpar fist extfingeru palmd parbegin head plus lrat chest touch parend",
        "symmpar fist extfingeru palmd parbegin head plus parend moved",
        // splits
        "parbegin fist extfingeru palmd plus flathand extfingerr palmu parend palm touch moved",
        "symmlr flathand parbegin extfingeru palml plus extfingerr palmu parend shoulders moveo",
        "symmlr parbegin flathand plus parend extfingeru palml moveo",
        "symmlr fist extfingeru palmd parbegin moveo fast plus nomotion parend repeatfromstart",
        "symmlr fist extfingeru palmd parbegin plus moveo parend",
        "symmlr fist extfingeru palmd replace parbegin extfingeru plus extfingerl parend",
        // movements
        "fist extfingeru palmd moveo between moveol smallmod arcu largemod wavy smallmod increasing smallmod ellipseh fast",
        "fist extfingeru palmd moveo smallmod between largemod arcd arcl",
        "fist extfingeru palmd circlel between circleul largemod ellipsev smallmod clocku clockd clockfull clockfull zigzag decreasing largemod",
        "fist extfingeru palmd circleo increasing smallmod",
        "fist extfingeru palmd moveuo moveol between moveur circledi circleir",
        "fist extfingeru palmd nodding smallmod swinging twisting stircw stirccw largemod",
        "fist extfingeru palmd fingerplay indexfinger middlefinger slow",
        "fist extfingeru palmd movecross movex nomotion",
        "fist extfingeru palmd seqbegin moveu moved seqend fusionbegin mover movel fusionend",
        "fist extfingeru palmd parbegin moveu fingerplay replace flathand thumboutmod extfingero palmd parend",
        "fist extfingeru palmd parbegin parbegin moveu moveo parend plus seqbegin mover parend",
        "fist extfingeru palmd moveo fast slow tense rest halt alternatingmotion alternatingmotion",
        "fist extfingeru palmd moveo chest touch halt repeatfromstart alternatingmotion",
        "fist extfingeru palmd moveo seqbegin brushing palm touch seqend repeatreverse",
        "fist extfingeru palmd moveo seqbegin brushing chest seqbegin touch pinkyside seqend seqend",
        "fist extfingeru palmd moveo repeatfromstartseveral repeatcontinue decreasing smallmod etc",
        "fist extfingeru palmd moveo seqbegin repeatcontinueseveral mover smallmod increasing seqend",
        "fist extfingeru palmd replace flathand fast repeatfromstart",
        "fist extfingeru palmd replace palmu chest touch",
        // bodies and compounds
        "head nodding repeatfromstart fist extfingeru palmd moveo",
        "fist extfingeru palmd parbegin lrat shoulders moveu moveo parend",
        "fist extfingeru palmd moveo plus symmlr flathand extfingero palmu moved",
    ] {
        let names = names.replace("plus seqbegin mover parend", "plus seqbegin mover seqend parend");
        let read = read(&names);
        assert_eq!(read.findings, [], "{names}");
        assert!(!remembers(&read.sign), "{names}\n{:#?}", read.sign);
        assert_eq!(print_hamnosys(&read.sign).losses, [], "{names}");
    }
}

#[test]
fn other_spellings_read_as_the_same_sign_and_are_remembered() {
    for (odd, plain) in [
        (
            "symmlr largemod fingerstraightmod fist extfingeru palmd",
            "symmlr fingerstraightmod largemod fist extfingeru palmd",
        ),
        (
            "finger2 fingerstraightmod thumboutmod extfingeru palmd",
            "finger2 thumboutmod fingerstraightmod extfingeru palmd",
        ),
        ("fist palmd extfingeru chest moveu", "fist extfingeru palmd chest moveu"),
        (
            "symmlr parbegin fist plus flathand parend parbegin extfingeru plus extfingerl parend palmd",
            "symmlr parbegin fist extfingeru plus flathand extfingerl parend palmd",
        ),
        (
            "fist extfingerol extfingeruo palmd",
            "fist extfingeruo extfingerol palmd",
        ),
        (
            "fist extfingeru extfingerl palmd palmdl",
            "fist extfingeru between extfingerl palmd between palmdl",
        ),
        (
            "fist extfingeru palmd indexfinger fingertip touch",
            "fist extfingeru palmd fingertip indexfinger touch",
        ),
        (
            "fist extfingeru palmd wristtopulse touch",
            "fist extfingeru palmd wristpulse touch",
        ),
        (
            "fist extfingeru palmd wristtoback touch",
            "fist extfingeru palmd wristback handback touch",
        ),
        (
            "symmlr fist extfingeru palmd seqbegin close fingerpad seqend circleu",
            "symmlr fist extfingeru palmd parbegin fingerpad plus fingerpad parend close circleu",
        ),
        (
            "symmlr fist extfingeru palmd parbegin chest plus shoulders parend close moveu",
            "symmlr fist extfingeru palmd parbegin chest close plus shoulders close parend moveu",
        ),
        (
            "fist extfingeru palmd moveo halt fast",
            "fist extfingeru palmd moveo fast halt",
        ),
        (
            "fist extfingeru palmd moveo fast smallmod arcu",
            "fist extfingeru palmd moveo smallmod arcu fast",
        ),
        (
            "fist extfingeru palmd nondominant moveo",
            "fist extfingeru palmd parbegin plus moveo parend",
        ),
        (
            "symmlr fist extfingeru palmd parbegin movei moveo plus moved parend",
            "symmlr fist extfingeru palmd parbegin parbegin movei moveo parend plus moved parend",
        ),
        (
            "fist extfingeru palmd moveo seqbegin brushing palm seqend",
            "fist extfingeru palmd moveo seqbegin brushing palm touch seqend",
        ),
        ("fist space extfingeru palmd space version40", "fist extfingeru palmd"),
        (
            "fist extfingeru palmd chest repeatfromstart",
            "fist extfingeru palmd chest nomotion repeatfromstart",
        ),
    ] {
        let (odd_sign, plain_sign) = (read(odd).sign, read(plain).sign);
        assert_eq!(odd_sign, plain_sign, "{odd}");
        assert!(remembers(&odd_sign), "{odd}");
        assert!(!remembers(&plain_sign), "{plain}");
    }
}

#[test]
fn the_smallest_part_keeps_its_original_spelling() {
    let part = first("finger2 fingerstraightmod thumboutmod extfingeru palmd moveo");
    let EachHand::Shared(shape) = &part.posture.shape else {
        panic!("a shape for both hands");
    };
    let written = text("finger2 fingerstraightmod thumboutmod");
    assert_eq!(shape.written.0.as_deref(), Some(written.as_str()));
    assert_eq!(part.written.0, None);

    let mut changed = part.clone();
    if let EachHand::Shared(shape) = &mut changed.posture.shape {
        shape.form.bend = Some(FingerBend::Round);
        shape.written = WrittenSymbols::default();
    }
    let sign = HamnosysSign { parts: vec![changed] };
    let printed = text("finger2 thumboutmod fingerbendmod extfingeru palmd moveo");
    assert_eq!(print_hamnosys(&sign).text, printed);
}

/// One meaning of an overloaded symbol: the text, and a test of its first part.
type Meaning = (&'static str, fn(&ManualPart) -> bool);

fn shape(part: &ManualPart) -> &Handshape {
    part.posture.shape.dominant_value().expect("a handshape")
}

fn both(part: &ManualPart) -> HandSymmetry {
    match part.hands {
        HandsUsed::Both(symmetry) => symmetry,
        _ => panic!("two hands"),
    }
}

fn directed(part: &ManualPart) -> &DirectedPath {
    match &part.actions[0].kind {
        MotionKind::Directed(directed) => directed,
        other => panic!("{other:?}"),
    }
}

fn body(part: &ManualPart) -> &BodyPlace {
    match &part.posture.place {
        Some(HandPlace::Body(place)) => place,
        other => panic!("{other:?}"),
    }
}

fn hand(part: &ManualPart) -> &HandSite {
    match &part.posture.place {
        Some(HandPlace::Hand(site)) => site,
        other => panic!("{other:?}"),
    }
}

#[test]
fn overloaded_symbols_are_read_by_their_position() {
    let meanings: &[Meaning] = &[
        ("symmlr fingerstraightmod fist", |p| {
            both(p).out_in && shape(p).form.bend.is_none()
        }),
        ("symmlr fist fingerstraightmod", |p| {
            !both(p).out_in && shape(p).form.bend == Some(FingerBend::Bent)
        }),
        ("symmlr largemod fist", |p| both(p).up_down),
        ("fist moveo largemod", |p| {
            directed(p).size.first == Some(MotionSize::Big)
        }),
        ("fist moveo arcu largemod", |p| {
            let curve = directed(p).curve.expect("a curve");
            directed(p).size.first.is_none() && curve.size == Some(MotionSize::Big)
        }),
        ("symmlr alternatingmotion fist moveo", |p| {
            both(p).out_of_phase && !p.actions[0].manner.alternating
        }),
        ("symmlr fist moveo alternatingmotion", |p| {
            !both(p).out_of_phase && p.actions[0].manner.alternating
        }),
        ("fist extfingeru palmd seqbegin moveo moveu seqend", |p| {
            matches!(p.actions[0].kind, MotionKind::Sequence { fused: false, .. })
        }),
        ("fist chest seqbegin touch fingertip seqend", |p| {
            body(p).contact == Some(PlaceContact::Touch)
                && body(p).by.as_ref().and_then(|by| by.at) == Some(HandLocation::Tip)
        }),
        ("fist moveo seqbegin brushing chest touch seqend", |p| {
            let MotionKind::Target { posture, .. } = &p.actions[0].kind else {
                return false;
            };
            matches!(&posture.place, Some(HandPlace::Body(place)) if place.contact == Some(PlaceContact::Brushing))
        }),
        ("fist moveo seqbegin repeatfromstart mover seqend", |p| {
            matches!(&p.actions[0].kind, MotionKind::Repeated { repetition, .. }
                if repetition.shift == Some(SpatialDirection::RIGHT_DIRECTION))
        }),
        ("fist between flathand", |p| {
            shape(p).between.map(|form| form.class) == Some(HandClass::Flat)
        }),
        ("fist between extfingeru", |p| {
            shape(p).thumb == Some(ThumbExtra::Enclosed)
        }),
        ("fist fingerstraightmod between fingerbendmod", |p| {
            shape(p).form.bend == Some(FingerBend::Joints([3.0, 1.0, 1.0]))
        }),
        ("fist extfingeru between extfingerl", |p| {
            let aim = p.posture.extended.dominant_value().expect("an aim");
            aim.first == SpatialDirection::UP_DIRECTION && aim.second == Some(SpatialDirection::LEFT_DIRECTION)
        }),
        ("fist moveuo moveol", |p| directed(p).direction.to_string() == "uol"),
        ("fist moveol moveuo", |p| p.actions.len() == 2),
        ("fist moveuo smallmod moveol", |p| p.actions.len() == 2),
        ("fist extfingeruo extfingerol", |p| {
            let aim = p.posture.extended.dominant_value().expect("an aim");
            aim.first.to_string() == "uol" && aim.second.is_none()
        }),
        ("fist palmd between palmdl", |p| {
            let aim = p.posture.palm.dominant_value().expect("an aim");
            aim.second == Some(CompassDirection::Dl)
        }),
        ("fist chest between shoulders", |p| body(p).second.is_some()),
        ("fist moveo between moveol", |p| directed(p).second.is_some()),
        ("finger23 indexfinger cross middlefinger", |p| {
            shape(p).contacts.len() == 1
        }),
        ("fist extfingeru palmd wristback cross", |p| {
            hand(p).contact == Some(PlaceContact::Cross)
        }),
        ("fist moveo plus flathand", |p| p.actions.len() == 1),
        ("fist parbegin moveo plus moveu parend", |p| {
            matches!(p.actions[0].kind, MotionKind::Split(Some(_), Some(_)))
        }),
        ("parbegin fist plus flathand parend moveo", |p| {
            p.posture.shape.other_value().is_some()
        }),
        ("fist parbegin moveo moveu parend", |p| {
            matches!(p.actions[0].kind, MotionKind::Parallel(_))
        }),
        ("fist lrat chest", |p| {
            body(p).site.and_then(|site| site.side) == Some(LocationSide::LeftAt)
        }),
        ("fist chest lrat", |p| {
            body(p).site.and_then(|site| site.side) == Some(LocationSide::RightAt)
        }),
        ("fist lrbeside ear", |p| {
            body(p).site.and_then(|site| site.side) == Some(LocationSide::LeftBeside)
        }),
        ("fist lips doublehooked", |p| {
            body(p).site.map(|site| site.at) == Some(BodyLocation::LowerLip)
        }),
        ("finger2 doublehooked", |p| {
            shape(p).form.bend == Some(FingerBend::DoubleHooked)
        }),
        ("fist extfingeru palmd palm touch", |p| {
            hand(p).at == Some(HandLocation::Palm)
        }),
        ("fist extfingeru palmd fingernail palm touch", |p| {
            hand(p).at == Some(HandLocation::Nail) && hand(p).side == Some(LocationSide::Palmar)
        }),
        ("flathand fingerbendmod pinky", |p| {
            shape(p).exempt.contains_digit(HandDigit::Little)
        }),
        ("flathand pinky fingerbendmod", |p| {
            shape(p).bends[4] == Some(FingerBend::Round)
        }),
        ("finger2 pinky extfingeru", |p| {
            shape(p).special.contains_digit(HandDigit::Little)
        }),
        ("fist extfingeru pinky touch", |p| {
            hand(p).digits.contains_digit(HandDigit::Little)
        }),
        (
            "fist fingerplay pinky",
            |p| matches!(&p.actions[0].kind, MotionKind::FingerPlay(digits) if digits.contains_digit(HandDigit::Little)),
        ),
        ("cee12 thumbacrossmod", |p| {
            shape(p).form.opening == Some(CeeOpening::Tight) && shape(p).form.thumb.is_none()
        }),
        ("fist thumbacrossmod", |p| {
            shape(p).form.thumb == Some(ThumbPosition::Across)
        }),
        ("cee12 middlefinger largemod", |p| {
            shape(p).opposed == Some(HandDigit::Middle)
        }),
        ("fist shoulders moveu", |p| {
            body(p).site.map(|site| site.at) == Some(BodyLocation::Shoulders)
        }),
        ("shoulders moveu fist moveo", |p| {
            p.body.len() == 1 && p.posture.place.is_none()
        }),
        ("fist moveo chest", |p| {
            matches!(p.actions[0].kind, MotionKind::Target { .. })
        }),
        ("fist extfingeru etc moveo repeatfromstart etc", |p| {
            p.posture.extended.dominant_value().is_some_and(|aim| aim.approx)
                && matches!(&p.actions[0].kind, MotionKind::Repeated { repetition, .. } if repetition.approx)
        }),
    ];
    for (names, holds) in meanings {
        assert!(holds(&first(names)), "{names}: {:#?}", first(names));
    }
}

#[test]
fn refusals_name_the_symbol_and_what_was_expected() {
    for (names, index, part) in [
        ("fist extfingeru palmd fingerhookmod", 3, "expected a movement"),
        ("fist smallmod extfingeru", 1, "hamsmallmod, but expected a movement"),
        ("fist moveo chest smallmod", 3, "hamsmallmod"),
        ("fist moveo plus", 3, "another sign after hamplus"),
        ("plus fist moveo", 0, "hamplus, but expected a handshape"),
        (
            "fist parbegin moveo",
            1,
            "hamparbegin, is not closed; expected hamparend at symbol 4",
        ),
        ("fist parbegin moveo seqend", 1, "expected hamparend at symbol 4"),
        ("fist moveo parend", 2, "hamparend"),
        ("fist parbegin parend", 2, "a movement in the bracket"),
        ("fist replace", 2, "after hamreplace"),
        ("fist replace fast", 2, "hamfast, but expected a handshape, a direction"),
        ("fist seqbegin moveo plus moveu seqend", 3, "only hamparbegin"),
        ("fist parbegin moveo plus moveu plus mover parend", 5, "two hands only"),
        ("fist chest between moveo", 3, "the second of two places"),
        ("fist chest seqbegin touch moveo seqend", 4, "the part of the hand"),
        ("fist chest fingerbendmod", 2, "expected a contact or a movement"),
        ("fist moveo seqbegin brushing seqend", 4, "the place that is brushed"),
        ("between fist", 0, "hambetween"),
        ("arcu fist", 0, "hamarcu"),
        ("altbegin fist", 0, "hamaltend"),
        ("fist altend", 1, "alternatives"),
    ] {
        let text = text(names);
        let error = match parse_hamnosys(&text) {
            Err(error) => error,
            Ok(read) => panic!("{names}: {:#?}", read.sign),
        };
        let message = error.to_string();
        assert!(message.contains(part), "{names}: {message}");
        assert_eq!(error.index(), Some(index), "{names}: {message}");
        let lenient = parse_lenient(&text);
        assert_eq!(lenient.transcription_text(), text, "{names}");
        assert!(lenient.is_partial(), "{names}");
    }
    let unknown = parse_hamnosys("hamfist hamflathat").expect_err("no symbol");
    assert!(unknown.to_string().contains("symbol 2 is \"hamflathat\""), "{unknown}");
    assert_eq!(parse_hamnosys(""), Err(HamnosysError::Empty));
    assert!(matches!(
        parse_hamnosys("\u{e000}\u{f8ff}"),
        Err(HamnosysError::Unknown { index: 1, .. })
    ));
}

#[test]
fn symbols_outside_the_tree_are_findings_and_kept_in_the_text() {
    for (names, index, part) in [
        ("fist extfingeru palmd query", 3, "kept in the text"),
        (
            "altbegin fist metaalt flathand altend extfingeru palmd",
            2,
            "first of the alternatives",
        ),
        ("mime fist moveo", 0, "kept in the text"),
        ("fist extfingeru palmd lrat chest lrat", 5, "a second side"),
        ("fist extfingeru palmd moveo fast fast", 5, "twice"),
        ("fist extfingeru palmd moveo etc", 4, "roughly"),
        (
            "fist extfingeru palmd replace flathand increasing",
            5,
            "one after the other",
        ),
        ("fist extfingeru palmd moveo arcu arcd", 5, "no place for this mark"),
        ("fist extfingeru palmd moveo extfingerl", 4, "without hamreplace"),
        ("fist extfingeru palmd moveo flathand extfingerl", 4, "without hamplus"),
    ] {
        let read = read(names);
        let found = read
            .findings
            .iter()
            .any(|f| f.index == index && f.message.contains(part));
        assert!(found, "{names}: {:#?}", read.findings);
    }
}

#[test]
fn odd_text_still_yields_its_readable_part() {
    let text = format!(
        "{}?!x{}",
        text("finger2 smallmod extfingeru palmd"),
        text("moveo plus parbegin mover")
    );
    let read = parse_lenient(&text);
    assert_eq!(read.transcription_text(), text);
    assert!(read.is_partial());
    let part = &read.sign.parts[0];
    assert_eq!(shape(part).form.class, HandClass::Finger2);
    assert!(read.findings.len() >= 3, "{:#?}", read.findings);
}

#[test]
fn names_and_characters_are_the_same_stream() {
    let symbols: Vec<HamnosysSymbol> = HamnosysSymbol::all_symbols().collect();
    assert_eq!(symbols.len(), 209);
    for symbol in symbols {
        assert_eq!(HamnosysSymbol::from_char(symbol.symbol_char()), Some(symbol));
        assert_eq!(HamnosysSymbol::from_symbol_name(symbol.symbol_name()), Some(symbol));
        assert_eq!(
            HamnosysSymbol::from_symbol_name(&symbol.symbol_name()[3..].to_uppercase()),
            Some(symbol)
        );
    }
    for (alias, name) in [
        ("hampinchopen", "hampinch12open"),
        ("hamcee12open", "hamceeopen"),
        ("hamfingerhookedmod", "hamfingerhookmod"),
        ("clockplus", "hamclockfull"),
        ("hammovex", "hammoveX"),
        ("hamnbs", "hamspace"),
    ] {
        assert_eq!(
            HamnosysSymbol::from_symbol_name(alias).map(HamnosysSymbol::symbol_name),
            Some(name)
        );
    }
    let names = "hamsymmlr, hamflathand hamextfingero\nhampalmd moveo";
    let read = parse_hamnosys(names).expect("names");
    assert_eq!(read.transcription_text(), names);
    let text = text("symmlr flathand extfingero palmd moveo");
    assert_eq!(print_hamnosys(&read.sign).text, text);
    assert_eq!(to_names(&text).map(|names| names.len()), Ok(5));
    let mixed = format!("hamfist{}", &text[3..]);
    assert_eq!(parse_hamnosys(&mixed).map(|read| read.transcription_text()), Ok(mixed));
    let second = "\u{e000}\u{e020}\u{e03c}\u{e0ee}";
    assert_eq!(
        parse_hamnosys(second).map(|read| read.transcription_text()),
        Ok(second.to_owned())
    );
}

#[test]
fn nesting_is_bounded() {
    for (begin, end) in [("parbegin ", "parend "), ("seqbegin ", "seqend "), ("fusionbegin ", "")] {
        let names = format!("fist {}moveo {}", begin.repeat(900), end.repeat(900));
        let error = parse_hamnosys(&text(&names)).expect_err("too deep");
        assert!(matches!(error, HamnosysError::TooDeep { .. }), "{error}");
        assert_eq!(parse_lenient(&text(&names)).transcription_text(), text(&names));
    }
    let names = format!("fist moveo {}", "chest touch repeatfromstart ".repeat(200));
    assert!(matches!(
        parse_hamnosys(&text(&names)),
        Err(HamnosysError::TooDeep { .. })
    ));
    let long = text("moveo").repeat(5000);
    assert!(matches!(
        parse_hamnosys(&long),
        Err(HamnosysError::TooLong { count: 5000, .. })
    ));
}

#[test]
fn losses_in_printing_are_reported() {
    let mut part = first("fist extfingeru palmd moveo");
    part.actions[0].manner.speed = Some(0.5);
    let EachHand::Shared(shape) = &mut part.posture.shape else {
        panic!("a shape for both hands");
    };
    shape.form.bend = Some(FingerBend::Joints([4.0, 1.0, 0.0]));
    let printed = print_hamnosys(&HamnosysSign { parts: vec![part] });
    assert_eq!(printed.text, text("fist fingerstraightmod extfingeru palmd moveo"));
    assert_eq!(printed.losses.len(), 2, "{:#?}", printed.losses);
}
