//! Tests of the query language: canonical text, positions of terms, comparisons, and limits.

mod completion;
mod laws;
mod refusals;

use std::ops::RangeBounds;

use super::*;
use crate::component::ComponentReading;

/// Queries that print as they are written.
const CANONICAL: &[&str] = &[
    "",
    "right.configuration=U placement=chin",
    "gloss:BO* not weak.configuration=S",
    "movement=arc duration<0.8s",
    "configuration=[index middle spread]",
    r#""slow animal""#,
    "slow animal",
    "origin=made",
    "gloss=CHAT overlaps nonmanual.brows=raised",
    "final.placement=chest",
    "like token:41 on configuration",
    "like token:41 on configuration:2, right.placement:0.5 gloss=X",
    r#"placement="neutral space""#,
    "weak.configuration=S",
    "placement==chest",
    "placement!=chest",
    "configuration=B*",
    "placement=*",
    "placement=unset",
    "placement=n/a,unclear",
    r#"placement="unset""#,
    "gloss=CHAT",
    "gloss=INDEX:1",
    "gloss=BOL-2H",
    "gloss=X(1)",
    "gloss:MA*SON",
    r#"gloss:INDEX:1,"a b""#,
    "gloss~ESCARGO",
    "gloss~ESCRGO~2",
    r#"gloss~"A~2"~2"#,
    r#"gloss~"A B""#,
    r#"gloss="a\"b\\c""#,
    "duration=0.5s..1s",
    "end>=2s",
    "signer=Anna",
    r#"tier="Gloss RH""#,
    "inventory=NGT",
    "lexicon=NGT",
    "language=dse",
    "file=ngt.csv",
    "hand=both,left",
    r#"overlaps tier("Mouthing")=ma*"#,
    "not-overlaps gloss=CHAT",
    "within 0.5s around gloss=CHAT",
    "before gloss=A after gloss=B",
    "inside nonmanual.mouth=*",
    "not-inside gloss=A",
    "overlaps-begin gloss=A",
    "overlaps-end gloss=A",
    "a or b c or not d",
    "(a or b) c",
    "not (a b)",
    "not not a",
    "X(1) animal",
    "BEFORE AFTER",
    r#""before""#,
    r#"snail "on""#,
    "text:snail,slug",
    r#"translation="The slow animal""#,
    r#"comment:"to check""#,
    "gloss==Chat",
    "gloss!=unset",
    "gloss=*",
    "middle2.placement=chest",
    "école gloss=ÉCOLE",
    "slo*",
    r#"placement="neutral space > head""#,
    r#"placement="neutral>head""#,
    "placement=head > chest",
    "final.right.placement==* > \"neutral space\" > chin,unset",
    "configuration=[index] > B*",
    "gloss=/^BO.*/",
    r"gloss!=/a\/b (x|y)\./,BOL",
    "tier(/^G/)=/x/",
    r#"gloss="/sil/""#,
    "like token:41 above 0.6",
    "like sign:A on configuration:2, placement above 0.25 hand=both",
    "not @chin",
    "@a or @b gloss=C",
    r#"@"my search" @ab"#,
    r#""@chin""#,
    r#""et" "ou" "dans" "comme""#,
    "NON OU ET",
];

/// Queries with their canonical text.
const REWRITTEN: &[(&str, &str)] = &[
    ("   ", ""),
    (
        "configuration=[index, -thumb,not spread +middle]",
        "configuration=[index -thumb -spread middle]",
    ),
    ("origin=Made, captured", "origin=made,captured"),
    ("right.final.location=chest", "final.right.placement=chest"),
    ("like CHAT", "like sign:CHAT"),
    ("like INDEX:1", "like sign:INDEX:1"),
    (r#"like sign:"A B" on handshape"#, r#"like sign:"A B" on configuration"#),
    ("like CHAT duration<1s", "like sign:CHAT duration<1s"),
    ("placement=“neutral space”", r#"placement="neutral space""#),
    ("placement=« neutral space »", r#"placement="neutral space""#),
    ("placement≠chest,chin", "placement!=chest,chin"),
    ("configuration=U, V , W", "configuration=U,V,W"),
    ("placement=N/A", "placement=n/a"),
    ("gloss~ESCRGO~1", "gloss~ESCRGO"),
    (r#"gloss=A\*B"#, r#"gloss="A\*B""#),
    ("duration=0.5..1s", "duration=0.5s..1s"),
    ("duration=500ms..", "duration>=0.5s"),
    ("duration=..1min", "duration<=60s"),
    ("duration=500ms", "duration=0.5s"),
    ("duration<0,8s", "duration<0.8s"),
    ("duration < 0.8 s", "duration<0.8s"),
    ("start>1.5min", "start>90s"),
    ("duration≤1.0000005s", "duration<=1.000001s"),
    ("durée<1s", "duration<1s"),
    ("recording:3", "recording=3"),
    ("token:41", "token=41"),
    ("sign:LIMACE", "sign=LIMACE"),
    ("hand=strong", "hand=dominant"),
    ("tier(Mouthing)=ma*", r#"tier("Mouthing")=ma*"#),
    (r#"tier ("Gaze *") = *"#, r#"tier("Gaze *")=*"#),
    ("within 500ms of begin gloss:CHAT", "within 0.5s of-begin gloss:CHAT"),
    ("within 0 s of-end gloss:CHAT", "within 0s of-end gloss:CHAT"),
    ("not overlaps tier(X)=*", r#"not overlaps tier("X")=*"#),
    ("((a b)) (c d)", "a b c d"),
    ("(a or b) or c", "a or b or c"),
    ("a AND b Or NOT c", "a b or not c"),
    ("not(a)or(b)", "not a or b"),
    (
        "handshape=U emplacement=menton mouvement=arc nonmanuel.brows=x droite.configuration=S gauche.mouvement=y",
        "configuration=U placement=menton movement=arc nonmanual.brows=x right.configuration=S left.movement=y",
    ),
    ("Orientation.Palm=up", "orientation.palm=up"),
    ("nondominant.configuration=S", "weak.configuration=S"),
    ("overlap", r#""overlap""#),
    ("placement=head>chest", "placement=head > chest"),
    ("placement = head >\n chest,chin", "placement=head > chest,chin"),
    ("gloss~/^BO/", "gloss=/^BO/"),
    ("gloss:/^BO/", "gloss=/^BO/"),
    ("texte=/a b/", "text=/a b/"),
    ("like token:41 above 60%", "like token:41 above 0.6"),
    ("comme token:41 sur configuration", "like token:41 on configuration"),
    ("comme un chat", r#""comme" un chat"#),
    (
        "placement=menton ou non placement=joue et gloss=A",
        "placement=menton or not placement=joue gloss=A",
    ),
    (
        "gloss=A chevauche nonmanuel.brows=x avant gloss=B",
        "gloss=A overlaps nonmanual.brows=x before gloss=B",
    ),
    ("avant la maison", r#""avant" la maison"#),
];

/// Returns the error as lines of text: its message, its drawing, and the remedy.
fn render_query_error(error: &QueryError, query: &str) -> String {
    match error.remedy.remedy_text() {
        "" => error.draw_query_error(query),
        remedy => format!("{}\n{remedy}", error.draw_query_error(query)),
    }
}

#[test]
fn queries_print_canonically() {
    let same = CANONICAL.iter().map(|query| (*query, *query));
    for (text, printed) in same.chain(REWRITTEN.iter().copied()) {
        let query =
            TokenQuery::parse_query(text).unwrap_or_else(|error| panic!("{}", render_query_error(&error, text)));
        assert_eq!(query.to_string(), printed, "{text}");
        assert_eq!(TokenQuery::parse_query(printed), Ok(query), "{text}");
    }
}

#[test]
fn every_part_of_a_query_has_its_text_position() {
    let text = r#"é not (right.configuration=U,[index -thumb]) overlaps tier("Gaze")=left like token:4 on placement:2"#;
    let cut = |at: QueryPlace| text.chars().skip(at.start).take(at.end - at.start).collect::<String>();
    let QueryExpression::And(terms) = TokenQuery::parse_query(text).expect("a query").root else {
        panic!("terms")
    };
    let places: Vec<String> = terms.iter().map(|term| cut(term.expression_place())).collect();
    assert_eq!(
        places,
        [
            "é",
            "right.configuration=U,[index -thumb]",
            r#"overlaps tier("Gaze")=left"#,
            "like token:4 on placement:2",
        ]
    );
    let QueryExpression::Not(inner) = &terms[1] else {
        panic!("a negation")
    };
    let QueryExpression::Test(QueryTest {
        subject_at,
        what: TestSubject::Component(_, comparison),
        ..
    }) = &**inner
    else {
        panic!("a component");
    };
    assert_eq!(cut(*subject_at), "right.configuration");
    assert_eq!(cut(comparison.values[1].at), "[index -thumb]");
    let WantedValue::Features(features) = &comparison.values[1].wanted else {
        panic!("features")
    };
    assert_eq!(cut(features[1].at), "-thumb");
    let QueryExpression::Like(like) = &terms[3] else {
        panic!("an example")
    };
    assert_eq!(
        (cut(like.example_at), cut(like.on[0].at)),
        ("token:4".into(), "placement:2".into())
    );
}

#[test]
fn comparisons_accept_or_reject_each_kind_of_reading() {
    let readings = [
        ComponentReading::from("U"),
        ComponentReading::from("S"),
        ComponentReading::Unset,
        ComponentReading::NotApplicable,
        ComponentReading::Unclear,
    ];
    // One mark per reading, in their order.
    for (text, passes) in [
        ("configuration=U", "+----"),
        ("configuration=U,S", "++---"),
        ("configuration==U", "+----"),
        ("configuration!=U", "-+---"),
        ("configuration=*", "++---"),
        ("configuration!=*", "--+++"),
        ("configuration=unset", "--+--"),
        ("configuration!=unset", "++-++"),
        ("configuration=n/a,unclear", "---++"),
        ("configuration=U,unset", "+-+--"),
        ("configuration!=U,unset", "-+---"),
        ("configuration=u*", "+----"),
        ("configuration=[x]", "-----"),
        ("configuration!=[x]", "++---"),
    ] {
        let query = TokenQuery::parse_query(text).expect(text);
        let [test] = &query.query_tests()[..] else {
            panic!("one comparison")
        };
        let TestSubject::Component(_, comparison) = &test.what else {
            panic!("a component")
        };
        let fits = |value: &str, wanted: &WantedValue| match wanted {
            WantedValue::Named(pattern) => pattern.matches_text(value),
            _ => false,
        };
        let mark = |reading| {
            if comparison.comparison_accepts_reading(reading, fits) {
                '+'
            } else {
                '-'
            }
        };
        let found: String = readings.iter().map(mark).collect();
        assert_eq!(found, passes, "{text}");
    }
    for (text, passes) in [
        ("duration<1s", "+--"),
        ("duration<=1s", "++-"),
        ("start>1s", "--+"),
        ("start>=1s", "-++"),
        ("end=1s", "-+-"),
        ("end=0s..1s", "++-"),
    ] {
        let query = TokenQuery::parse_query(text).expect(text);
        let TestSubject::Time(_, test) = &query.query_tests()[0].what else {
            panic!("a time")
        };
        let times = [999_999, 1_000_000, 1_000_001];
        let found: String = times
            .iter()
            .map(|t| if test.time_bounds().contains(t) { '+' } else { '-' })
            .collect();
        assert_eq!(found, passes, "{text}");
    }
}

#[test]
fn every_comparison_of_a_query_is_listed() {
    let text = "a not (gloss=A or overlaps gloss=B) like CHAT on placement duration<1s";
    let query = TokenQuery::parse_query(text).expect(text);
    let found: Vec<String> = query.query_tests().iter().map(|test| test.to_string()).collect();
    assert_eq!(found, ["a", "gloss=A", "gloss=B", "duration<1s"]);
}

#[test]
fn long_and_deep_queries_are_refused() {
    assert!(TokenQuery::parse_query(&"a ".repeat(MAX_CHARS / 2)).is_ok());
    for (text, message) in [
        ("a".repeat(MAX_CHARS + 1), "the query is longer than 10000 characters"),
        (
            "(".repeat(MAX_CHARS),
            "more than 64 parentheses and negations inside each other",
        ),
        (
            "not ".repeat(2000),
            "more than 64 parentheses and negations inside each other",
        ),
        (
            "x( ".repeat(3000),
            "more than 64 parentheses and negations inside each other",
        ),
    ] {
        assert_eq!(TokenQuery::parse_query(&text).expect_err("too much").message, message);
    }
    let deep = format!(
        "{}a{}",
        "(".repeat(MAX_QUERY_DEPTH - 1),
        ")".repeat(MAX_QUERY_DEPTH - 1)
    );
    assert!(TokenQuery::parse_query(&deep).is_ok());
}

#[test]
fn every_query_in_the_help_parses() {
    let examples = QUERY_HELP
        .lines()
        .filter(|line| line.starts_with("  ") && line.contains(['=', ':', '~', '<']));
    let mut count = 0;
    for line in examples {
        assert!(line.len() <= 80, "{line}");
        for example in line
            .trim()
            .split("   ")
            .filter(|part| part.contains(['=', ':', '~', '<']))
        {
            let example = example.trim();
            let whole = if example.starts_with('=') {
                format!("placement{example}")
            } else {
                example.to_owned()
            };
            if example.contains("captured,") || example.starts_with("signer=") || example.contains(": ") {
                continue;
            }
            if let Err(error) = TokenQuery::parse_query(&whole) {
                panic!("{}", render_query_error(&error, &whole));
            }
            count += 1;
        }
    }
    assert!(count > 20, "{count}");
}

#[test]
fn braces_say_who_says_a_value() {
    for (text, canonical) in [
        ("configuration=U{by=anna}", "configuration=U{by=anna}"),
        (
            "right.handshape = U,V{ by:anna confidence > 0.8 } gloss=A",
            "right.configuration=U,V{by=anna attribute.confidence>0.8} gloss=A",
        ),
        (
            "not placement!=\"a {b}\"{proposed=oui by!=\"x } y\"}",
            "not placement!=\"a {b}\"{proposed=yes by!=\"x } y\"}",
        ),
        (
            "(configuration=[index -thumb]{disputed:yes} or x)",
            "configuration=[index -thumb]{disputed=yes} or x",
        ),
        ("gloss=a{b}", "gloss=\"a{b}\""),
    ] {
        let query: TokenQuery = text.parse().unwrap_or_else(|error| panic!("{text}: {error:?}"));
        assert_eq!(query.to_string(), canonical, "{text}");
        assert_eq!(canonical.parse::<TokenQuery>(), Ok(query), "{canonical}");
    }
    for (text, message, at) in [
        ("configuration=U{by=anna", "this brace is not closed", 15..16),
        ("configuration=U{}", "this does not say who says so", 16..16),
        ("configuration=U{anna}", "this does not say who says so", 16..20),
        ("configuration=U{gloss=A}", "this does not say who says so", 16..21),
        ("configuration=unset{by=anna}", "nobody says this of one value", 14..19),
        (
            "placement=head > chest{by=anna}",
            "nobody says this of one value",
            10..22,
        ),
        ("overlaps configuration=U{by=anna}", "this is no annotation", 9..22),
        ("configuration=U{by=anna}x", "a blank is missing here", 24..25),
    ] {
        let error = text.parse::<TokenQuery>().expect_err(text);
        assert!(error.message.contains(message), "{text}: {error:?}");
        assert_eq!(error.at, at, "{text}");
    }
}
