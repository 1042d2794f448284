//! Tests of query errors: their position, their drawing under the query, and the suggested correction.

use super::*;

/// Queries with the place and the message of their error.
const WRONG: &[(&str, &str)] = &[
    (
        "right.confguration=U",
        r#"6..18 there is no field "confguration"; did you mean configuration?"#,
    ),
    (
        "confguration=U",
        r#"0..12 there is no field "confguration"; did you mean configuration?"#,
    ),
    (
        "rihgt.configuration=U",
        r#"0..5 there is no field "rihgt"; did you mean right?"#,
    ),
    (
        "right=U",
        r#"0..5 "right" names no component; did you mean right.configuration?"#,
    ),
    ("right.left.configuration=U", r#"6..10 "left" is one too many"#),
    ("left.nonmanual.brows=x", "0..4 non-manual components belong to no hand"),
    (
        "orientation.palm.x=up",
        "12..18 after a component stands at most one part of it",
    ),
    (
        "orientation.=up",
        "12..12 after a component stands at most one part of it",
    ),
    ("elephant=U", r#"0..8 there is no field "elephant""#),
    (
        "INDEX:1",
        r#"0..5 there is no field "INDEX"; did you mean gloss=INDEX?"#,
    ),
    ("GO~REPEAT", r#"0..2 there is no field "GO""#),
    ("placement=", "10..10 a value should stand here"),
    ("placement= )", "11..11 a value should stand here"),
    ("placement=,x", "10..10 a value should stand here"),
    ("placement=U,", "12..12 a value should stand here"),
    ("placement=(chest or chin)", "10..11 a value should stand here"),
    ("placement=a=b", "11..12 a value ends before this"),
    (r#"placement="""#, "10..12 this value is empty"),
    (r#"placement="chest"#, "10..11 this quote is not closed"),
    (r#"placement="chest"x"#, "17..18 a blank is missing here"),
    ("configuration=[index", "14..15 this bracket is not closed"),
    ("configuration=[]", "14..16 a feature is missing between the brackets"),
    (
        "configuration=[index not]",
        "14..25 a feature is missing between the brackets",
    ),
    ("configuration=[(a)]", "15..16 this is no feature"),
    (
        "[index]",
        "0..1 features need a field before them; did you mean configuration=[?",
    ),
    ("origin=[x]", "7..10 only components have features"),
    ("gloss=[x]", "6..9 only components have features"),
    ("(a b", "0..1 this parenthesis is not closed"),
    ("(a (b c)", "0..1 this parenthesis is not closed"),
    ("(", "0..1 this parenthesis is not closed"),
    ("()", "1..2 a term should stand before this parenthesis"),
    (")", "0..1 a term should stand before this parenthesis"),
    ("a)", "1..2 this parenthesis closes none"),
    ("a or", "4..4 the query ends where a term should stand"),
    ("or a", "0..2 `or` has nothing to join here"),
    ("a or or b", "5..7 `or` has nothing to join here"),
    ("a and", "5..5 the query ends where a term should stand"),
    ("and a", "0..3 `and` has nothing to join here"),
    ("a and or b", "6..8 `or` has nothing to join here"),
    ("not", "3..3 the query ends where a term should stand"),
    ("not or", "4..6 `or` has nothing to join here"),
    ("(not )", "5..6 a term should stand before this parenthesis"),
    ("a, b", "1..2 a comma stands only between the values of one field"),
    ("= x", "0..1 `=` has no field on its left"),
    ("< 0.8s", "0..1 `<` has no field on its left"),
    ("a || b", "2..4 this sign joins nothing here; did you mean or?"),
    ("a && b", "2..4 this sign joins nothing here; did you mean and?"),
    ("!", "0..1 this sign joins nothing here; did you mean not?"),
    ("*", "0..1 there is nothing to search for in this"),
    ("---", "0..3 there is nothing to search for in this"),
    ("placement:chest", "9..10 `:` does not compare values; did you mean =?"),
    ("placement<chest", "9..10 `<` does not compare values; did you mean =?"),
    (
        "placement<>chest",
        "9..11 `<>` does not compare values; did you mean !=?",
    ),
    ("placement~chest", "9..10 `~` does not compare values; did you mean =?"),
    ("gloss<A", "5..6 `<` does not compare texts; did you mean =?"),
    ("gloss~A*", "6..8 wildcards do not go with ~"),
    ("gloss~A~3", "7..9 a text is searched up to one or two slips"),
    (r#"gloss~"A"~x"#, "9..11 a text is searched up to one or two slips"),
    ("gloss~~", "6..7 a text is searched up to one or two slips"),
    ("origin=recorded", r#"7..15 "recorded" is no origin"#),
    ("origin=mad", r#"7..10 "mad" is no origin; did you mean made?"#),
    ("origin=m*", r#"7..9 "m*" is no origin"#),
    ("hand=rigth", r#"5..10 "rigth" is no hand; did you mean right?"#),
    ("duration<0.8", r#"9..12 "0.8" has no unit; did you mean 0.8s?"#),
    (
        "duration<0.8sc",
        r#"12..14 there is no unit of time "sc"; did you mean s?"#,
    ),
    ("duration<12f", r#"11..12 there is no unit of time "f""#),
    ("duration<", "9..9 a time should stand here"),
    ("duration<x", r#"9..10 "x" is no time"#),
    ("duration<0.8s..1s", "9..17 one time should stand here"),
    (
        "duration=1s..0.5s",
        "9..17 this range ends before it starts; did you mean 0.5s..1s?",
    ),
    ("duration=..", "9..11 a time should stand here"),
    ("duration:1s", "8..9 `:` does not compare times; did you mean =?"),
    ("duration!=1s", "8..10 `!=` does not compare times"),
    ("duration=1..2", r#"9..10 "1" has no unit; did you mean 1s?"#),
    ("duration<9999999999s", "9..20 this time is too long"),
    ("duration<-1s", r#"9..12 "-1s" is no time"#),
    (r#"duration="1s""#, "9..9 a time should stand here"),
    ("duration<1.2.3s", r#"9..15 "1.2.3s" is no time"#),
    (
        "gloss=CHAT ovrlaps nonmanual.brows=raised",
        r#"11..18 there is no relation "ovrlaps"; did you mean overlaps?"#,
    ),
    (
        "gloss=CHAT overlap gloss=X",
        r#"11..18 there is no relation "overlap"; did you mean overlaps?"#,
    ),
    ("overlaps", "8..8 `overlaps` needs a comparison on its right"),
    (
        "overlaps CHAT",
        "9..13 `overlaps` needs a comparison on its right; did you mean gloss=CHAT?",
    ),
    ("overlaps (gloss=A)", "9..9 `overlaps` needs a comparison on its right"),
    (
        "overlaps origin=made",
        "9..15 this is no annotation that could stand in a relation of time",
    ),
    (
        "overlaps duration<1s",
        "9..17 this is no annotation that could stand in a relation of time",
    ),
    (
        "overlaps not gloss=A",
        "9..12 `overlaps` needs a comparison on its right",
    ),
    ("within", "0..6 `within` needs a distance"),
    ("within gloss=A", r#"7..14 "gloss=A" is no time"#),
    (
        "within 0.5s gloss=A",
        r#"12..17 "gloss" does not say what the distance is counted from"#,
    ),
    (
        "within 0.5s arund gloss=A",
        r#"12..17 "arund" does not say what the distance is counted from; did you mean around?"#,
    ),
    (
        "within 0.5s of gloss=A",
        r#"12..20 "of-gloss" does not say what the distance is counted from"#,
    ),
    ("within 0.5s around", "18..18 `within` needs a comparison on its right"),
    ("tier()=x", "5..5 the tier's name is missing"),
    (r#"tier("")=x"#, "5..7 the tier's name is missing"),
    (r#"tier("Mouthing""#, "4..5 this parenthesis is not closed"),
    (r#"tier("Mouthing")"#, "16..16 a comparison should follow the tier"),
    ("tier(a b)=x", "4..5 this parenthesis is not closed"),
    ("overlaps tier(x)", "16..16 a comparison should follow the tier"),
    ("like", "4..4 `like` needs an example"),
    ("like on configuration", "5..7 `like` needs an example"),
    ("like token:", "5..11 which token?"),
    ("like tokn:41", r#"5..9 "tokn" is no example; did you mean token?"#),
    ("like recording:3", r#"5..14 "recording" is no example"#),
    ("like A*", "5..7 an example is one token or one sign"),
    (
        "like token:41 in placement",
        r#"14..16 "in" does not follow an example; did you mean on?"#,
    ),
    ("like token:41 on", "16..16 a component should stand here"),
    (
        "like token:41 on placment",
        r#"17..25 there is no field "placment"; did you mean placement?"#,
    ),
    ("like token:41 on gloss", r#"17..22 "gloss" is no component"#),
    ("like token:41 on placement:x", r#"27..28 "x" is no weight"#),
    ("like token:41 on placement:", r#"27..27 "" is no weight"#),
    ("like token:41 on placement,", "27..27 a component should stand here"),
    (
        "like token:41 on right",
        r#"17..22 "right" names no component; did you mean right.configuration?"#,
    ),
    (
        "été confguration=U",
        r#"4..16 there is no field "confguration"; did you mean configuration?"#,
    ),
    (
        "手 confguration=U",
        r#"2..14 there is no field "confguration"; did you mean configuration?"#,
    ),
    ("gloss:||", "6..8 there is nothing to search for in this"),
    ("placement= or a", "11..13 a value should stand here"),
    ("gloss=a, not b", "9..12 a value should stand here"),
    ("not=x", r#"0..3 there is no field "not"; did you mean notation?"#),
    (
        "palm=up",
        r#"0..4 "palm" is a part of orientation; did you mean orientation.palm?"#,
    ),
    (
        "configuration.dominant=B",
        "0..22 the hand stands before configuration, not after it; did you mean dominant.configuration?",
    ),
    ("duration<500", r#"9..12 "500" has no unit; did you mean 500ms?"#),
    ("gloss=/^BO", "6..7 this regular expression is not closed"),
    ("gloss=/(/", "6..9 this is no regular expression: unclosed group"),
    ("gloss=//", "6..8 this is no regular expression: it is empty"),
    ("gloss=/a/i", "9..10 a blank is missing here"),
    ("placement=head >", "16..16 a value should stand here"),
    (
        "placement=head > unset",
        "17..22 nothing begins or goes on where no value is",
    ),
    (
        "placement!=head > chest",
        "11..23 successive values are not compared with `!=`",
    ),
    (
        "overlaps placement=head > chest",
        "19..31 successive values belong to one token, not to an annotation beside it",
    ),
    ("like token:41 above 2", r#"20..21 "2" is no likeness"#),
    ("like token:41 above", r#"19..19 "" is no likeness"#),
    ("@", "0..1 which saved search?"),
];

#[test]
fn errors_point_at_the_position_and_suggest_a_correction() {
    for (text, wrong) in WRONG {
        let error = TokenQuery::parse_query(text).expect_err(text);
        let meant = error.suggestion.iter();
        let meant: String = meant.map(|word| format!("; did you mean {word}?")).collect();
        let found = format!("{}..{} {}{meant}", error.at.start, error.at.end, error.message);
        assert_eq!(found, *wrong, "{text}");
    }
}

#[test]
fn errors_are_drawn_under_the_query() {
    let long = format!("gloss=A right.confguration=U {}", "b ".repeat(60));
    let late = format!("{}confguration=U", "a ".repeat(100));
    for (text, drawn) in [
        (
            "right.confguration=U",
            "right.confguration=U\n      ^^^^^^^^^^^^\nthere is no field \"confguration\"; did you mean configuration?",
        ),
        (
            "placement=",
            "placement=\n          ^\na value should stand here\nwrite a value, * for any, or unset, n/a or unclear",
        ),
        (
            "手 a\tplace=(x",
            "手 a place=(x\n           ^\na value should stand here\none of several values is written with commas: placement=chest,chin",
        ),
        (
            "e\u{301} )",
            "e\u{301} )\n  ^\nthis parenthesis closes none\nleave it out, or open one before it",
        ),
        (
            &long,
            "gloss=A right.confguration=U b b b b b b b b b b b b b b b b b b b b b b b b b b b b b b b b b b b b…\n              ^^^^^^^^^^^^\nthere is no field \"confguration\"; did you mean configuration?",
        ),
        (
            &late,
            "…a a a a a a a a a a a a a a a a a a a a a a a a a confguration=U\n                                                   ^^^^^^^^^^^^\nthere is no field \"confguration\"; did you mean configuration?",
        ),
    ] {
        assert_eq!(
            render_query_error(&TokenQuery::parse_query(text).expect_err(text), text),
            drawn
        );
    }
}

#[test]
fn suggestions_mend_the_query() {
    for (text, mended) in [
        ("right.confguration=U", "right.configuration=U"),
        ("INDEX:1", "gloss=INDEX:1"),
        ("[index -thumb]", "configuration=[index -thumb]"),
        ("duration<0.8", "duration<0.8s"),
        ("duration=1s..0.5s", "duration=0.5s..1s"),
        ("gloss=A ovrlaps gloss=B", "gloss=A overlaps gloss=B"),
        ("overlaps CHAT", "overlaps gloss=CHAT"),
        ("a || b", "a or b"),
        ("like token:41 in placement", "like token:41 on placement"),
        ("placement:chin", "placement=chin"),
        ("palm=up", "orientation.palm=up"),
        ("configuration.dominant=B", "dominant.configuration=B"),
        ("duration<500", "duration<500ms"),
    ] {
        let error = TokenQuery::parse_query(text).expect_err(text);
        let corrected = error.corrected_query(text).expect("a suggestion");
        assert_eq!(corrected, mended);
        assert!(TokenQuery::parse_query(&corrected).is_ok(), "{corrected}");
    }
}

#[test]
fn unknown_values_are_pointed_at() {
    let text = "placement=nutral";
    let query = TokenQuery::parse_query(text).expect("a query");
    let QueryExpression::Test(QueryTest {
        what: TestSubject::Component(_, comparison),
        ..
    }) = &query.root
    else {
        panic!("one comparison");
    };
    let known = ["chest", "chin", "neutral space"];
    let error = unknown_value(comparison.values[0].at, "nutral space", known);
    assert_eq!(
        render_query_error(&error, text),
        "placement=nutral\n          ^^^^^^\nthe value \"nutral space\" is in no inventory; \
         did you mean \"neutral space\"?\nknown values: chest, chin, \"neutral space\""
    );
    let many: Vec<String> = (0..20).map(|n| format!("B{n}")).collect();
    let error = unknown_value(QueryPlace::default(), "qqq", many.iter().map(String::as_str));
    assert_eq!(error.suggestion, None);
    assert_eq!(
        error.remedy.remedy_text(),
        "known values: B0, B1, B2, B3, B4, B5, B6, B7 and 12 more"
    );
    assert_eq!(
        error.to_string(),
        "character 1: the value \"qqq\" is in no inventory (known values: B0, B1, B2, B3, B4, B5, B6, B7 and 12 more)"
    );
}
