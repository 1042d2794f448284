//! The contract with scripts: exit codes, one JSON document, errors with a place and a remedy, help.
//!
//! A command is tried by a line in a table: its words, its exit code, and the keys of its JSON. In the
//! words `@c` is a corpus of two signs and a small lexicon, `@in` the folder of files that it
//! was made of, `@more` a folder with another recording and one that is none, and `@d` an empty folder.

mod desk;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use desk::{Desk, text};

/// Words, exit code, and pointers into the JSON document that must lead somewhere.
type Case = (&'static str, i32, &'static [&'static str]);

const ERROR: &[&str] = &["/error/message", "/error/where", "/error/remedy"];
const LOG: &[&str] = &["/total", "/rows"];
const IMPORT: &[&str] = &["/created", "/files", "/dry_run"];
const FILE: &[&str] = &[
    "/created",
    "/files/0/path",
    "/files/0/status",
    "/files/0/findings",
];
const CHANGED: &[&str] = &[
    "/annotations",
    "/added",
    "/changed",
    "/removed",
    "/recordings",
];
const HITS: &[&str] = &[
    "/query",
    "/total",
    "/facets",
    "/hits/0/token",
    "/hits/0/gloss",
    "/hits/0/recording",
    "/hits/0/start_us",
    "/hits/0/end_us",
    "/hits/0/origin",
    "/hits/0/components",
];
const ROWS: &[&str] = &["/total", "/rows/0"];
const WRITTEN: &[&str] = &["/files/0/path"];
const REFUSED: &[&str] = &[
    "/files/0/status",
    "/files/0/findings/0/severity",
    "/files/0/findings/0/line",
    "/files/0/findings/0/message",
    "/files/0/findings/0/remedy",
];

const ANIMATED: &[&str] = &[
    "/recipe",
    "/duration_us",
    "/notes/0/about",
    "/notes/0/feature",
    "/notes/0/hand",
    "/notes/0/value",
    "/notes/0/start_us",
    "/notes/0/end_us",
    "/notes/0/from",
    "/curves",
    "/findings",
    "/report/warnings",
    "/report/steps/0/did",
    "/report/steps/0/residual",
    "/report/steps/0/hands/0/hand",
    "/report/steps/0/hands/0/off_m",
    "/report/steps/0/hands/0/short_m",
    "/report/steps/0/hands/0/turned_deg",
    "/report/steps/0/hands/0/pushed_m",
];
const SPOKEN: &[&str] = &[
    "/report/steps/0/language/from",
    "/report/steps/0/language/values/move.normal/value",
    "/report/steps/0/language/values/move.normal/count",
    "/report/steps/0/language/values/move.normal/of",
];

const CASES: &[Case] = &[
    ("new @d/a.chereme", 0, &["/corpus"]),
    ("new @c", 1, ERROR),
    ("new @d/no/such/folder.chereme", 1, ERROR),
    ("new", 2, ERROR),
    ("import @d/a.chereme @in", 0, IMPORT),
    (
        "import @d/a.chereme @in/bowl.bvh --signer Ben --handedness left",
        0,
        FILE,
    ),
    ("import @c @in", 0, FILE),
    ("import @d/a.chereme @in --dry-run", 0, IMPORT),
    ("import @c @in/none.bvh", 1, ERROR),
    ("import @c @in/notes.txt", 1, ERROR),
    ("import @c @more/broken.bvh", 1, REFUSED),
    ("import @c @in @more/broken.bvh", 1, FILE),
    ("import @c @in --merge --theirs", 2, ERROR),
    ("import @c @in --mine", 0, FILE),
    ("import @d/a.chereme @in/notated.sigml", 0, FILE),
    ("import @c @more/broken.sigml", 1, REFUSED),
    ("import @c @in/bowl.bvh --map @in/none.json", 1, ERROR),
    ("import @c @in/bowl.bvh --roles @in/notes.txt", 1, ERROR),
    ("import @c", 2, ERROR),
    ("import @c @in --unit furlong", 2, ERROR),
    ("import @c @in --axes sideways", 2, ERROR),
    ("import @c @in --handedness third", 2, ERROR),
    (
        "undo @c",
        0,
        &[
            "/operations/0/id",
            "/operations/0/kind",
            "/operations/0/target",
        ],
    ),
    ("undo @c --times 2", 0, &["/operations/0", "/left"]),
    ("redo @c --times 2", 1, ERROR),
    ("undo @c --times 0", 2, ERROR),
    ("undo @d/none.chereme", 1, ERROR),
    ("undo @in/notes.txt", 1, ERROR),
    ("redo @c", 1, ERROR),
    (
        "log @c",
        0,
        &[
            "/total",
            "/rows/0/id",
            "/rows/0/at",
            "/rows/0/author",
            "/rows/0/stands",
        ],
    ),
    ("log @c --limit 0", 0, LOG),
    (
        "log @c 1",
        0,
        &[
            "/operation/id",
            "/total",
            "/tables/annotation",
            "/changes/0/what",
            "/changes/0/kind",
            "/changes/0/name",
            "/changes/0/fields/0/field",
            "/changes/0/fields/0/from",
            "/changes/0/fields/0/to",
        ],
    ),
    ("log @c --changes", 0, &["/rows/0/id", "/details/0/changes"]),
    ("log @c 99", 1, ERROR),
    ("log @c many", 2, ERROR),
    ("completions bash", 0, &["/script"]),
    ("completions tcsh", 2, ERROR),
    ("man", 0, &["/page"]),
    ("man --to @d/man", 0, &["/files/0"]),
    ("log @c --limit many", 2, ERROR),
    ("log @d/none.chereme", 1, ERROR),
    ("log @in", 1, ERROR),
    (
        "info @c",
        0,
        &["/counts/tokens", "/counts/recordings", "/schema_version"],
    ),
    ("info @d/none.chereme", 1, ERROR),
    ("list @c recordings", 0, ROWS),
    ("list @c signs", 0, ROWS),
    (
        "list @c tokens --sort gloss --descending --limit 2",
        0,
        ROWS,
    ),
    ("list @c tiers --where role=component", 0, ROWS),
    ("list @c annotations --where recording=recording:1", 0, ROWS),
    ("list @c inventories", 0, ROWS),
    ("list @c values --offset 3", 0, ROWS),
    ("list @c signers", 0, ROWS),
    ("list @c searches", 0, &["/total", "/rows"]),
    ("list @c operations", 0, ROWS),
    ("list @c signs --where gloss=Z*", 0, &["/total", "/rows"]),
    (
        "list @c signs --where notation=*",
        0,
        &[
            "/rows/0/notation/system",
            "/rows/0/notation/file",
            "/rows/0/notation/document/sign/parts/0",
        ],
    ),
    ("list @c signs --where colour=red", 1, ERROR),
    ("list @c signs --sort colour", 1, ERROR),
    ("list @c elephants", 2, ERROR),
    ("search @c gloss=CHAT", 0, HITS),
    ("search @c 'right.configuration=S placement=chin'", 0, HITS),
    (
        "search @c gloss=NONE",
        0,
        &["/query", "/total", "/hits", "/facets"],
    ),
    (
        "search @c gloss=CHAT --no-facets --limit 1",
        0,
        &["/total", "/hits/0/token"],
    ),
    ("search @c 'configuration=flat placement=chin'", 0, HITS),
    ("search @c 'handform=S'", 1, ERROR),
    ("search @c 'gloss=('", 1, ERROR),
    ("search @c", 2, ERROR),
    ("search @c 'gloss=/^C/' --facets all", 0, HITS),
    ("search @c gloss=CHAT --facets some", 2, ERROR),
    (
        "search @c '' --cross placement signer --table csv",
        0,
        &["/total", "/fields/1", "/columns", "/rows/0/counts"],
    ),
    ("search @c '' --count origin", 0, &["/rows/0/total"]),
    ("search @c '' --count nosuch", 1, ERROR),
    ("search @c '' --table csv", 1, ERROR),
    (
        "search @c 'tier(nosuch)=x'",
        0,
        &[
            "/findings/0/kind",
            "/findings/0/names/0",
            "/findings/0/message",
        ],
    ),
    (
        "list @c values --inventory placements",
        0,
        &["/rows/0/uses"],
    ),
    (
        "pairs @c --empty unknown --list",
        0,
        &[
            "/total",
            "/signs",
            "/homonyms",
            "/by_field",
            "/densest",
            "/sha256",
            "/pairs",
        ],
    ),
    ("pairs @c --fields nosuch", 1, ERROR),
    ("search @c gloss=CHAT --keep cats", 0, HITS),
    ("search @c gloss=CHAT --keep ''", 1, ERROR),
    ("search @c @kept", 1, ERROR),
    ("search @c --forget cats", 1, ERROR),
    ("search @c gloss=CHAT --forget cats", 2, ERROR),
    (
        "annotate @c --in bowl add Gloss JOUR --start 1.6 --end 1.8",
        0,
        CHANGED,
    ),
    ("annotate @c --in bowl set a1 --value TASSE", 0, CHANGED),
    ("annotate @c --in bowl split a1 --at 0.4", 0, CHANGED),
    ("annotate @c --in bowl remove a8", 0, CHANGED),
    ("annotate @c from @more/changes.csv", 0, CHANGED),
    (
        "annotate @c --in bowl add Gloss JOUR --start 0.2 --end 0.4",
        1,
        ERROR,
    ),
    ("annotate @c --in bowl set a99 --value X", 1, ERROR),
    ("annotate @c --in cup set a1 --value X", 1, ERROR),
    ("annotate @c from @more/none.csv", 1, ERROR),
    (
        "annotate @c replace BOL TASSE --tier Gloss --dry-run",
        0,
        &["/dry_run", "/changed", "/values/0/from", "/values/0/to"],
    ),
    (
        "annotate @c replace '^(.)O' '$1A' --regex",
        0,
        &["/values/0/to"],
    ),
    ("annotate @c replace '(' x --regex", 1, ERROR),
    ("annotate @c replace a b --tier nosuch", 1, ERROR),
    ("annotate @c --in bowl shift --by 1ms --dry-run", 0, CHANGED),
    ("annotate @c --in bowl shift --by -9s", 1, ERROR),
    ("annotate @c shift --by 1ms", 1, ERROR),
    ("annotate @c --in bowl shift --by far", 2, ERROR),
    (
        "annotate @c --in bowl add Gloss JOUR --start 0.2 --end 0.4 --mode sideways",
        2,
        ERROR,
    ),
    ("annotate @c", 2, ERROR),
    ("annotate @c change a1", 2, ERROR),
    ("annotate @c --in bowl add-tier X --role nonsense", 2, ERROR),
    (
        "annotate @c --in bowl add-tiers",
        0,
        &["/0/name", "/0/role"],
    ),
    ("annotate @c --in bowl add-tiers --like nobody", 1, ERROR),
    ("annotate @c add-tiers", 1, ERROR),
    (
        "recombine @c 'BOL | reverse' --as LOB",
        0,
        &["/recipe", "/gloss", "/token", "/recording", "/report"],
    ),
    (
        "recombine @c 'BOL | place both by left 5cm' --explain",
        0,
        &["/recipe", "/report/steps"],
    ),
    ("recombine @c 'BOL | reverse' --replace BOL", 1, ERROR),
    ("recombine @c BOL --replace LOB --as LOB", 2, ERROR),
    ("recombine @c 'BOLL | reverse' --as LOB", 1, ERROR),
    ("recombine @c 'BOL | dance' --as LOB", 1, ERROR),
    (
        "recombine @c 'BOL | configure right no-such-value' --as LOB",
        1,
        ERROR,
    ),
    (
        "animate @c MERCI --as MERCI-SIGNED",
        0,
        &["/recipe", "/gloss", "/token", "/recording", "/report"],
    ),
    (
        "animate @c 'hamflathand hamextfingeru hampalml hammoveo' --explain",
        0,
        ANIMATED,
    ),
    (
        "animate @c MERCI MERCI --language default --signer recording:1",
        0,
        ANIMATED,
    ),
    ("animate @c BOL", 1, ERROR),
    ("animate @c MERCI --language @more/language.json", 0, SPOKEN),
    ("animate @c MERCI --language mesured", 1, ERROR),
    ("animate @c MERCI --language @in/notes.txt", 1, ERROR),
    ("animate @c 'hamsmallmod hampalmx' --as X", 1, ERROR),
    (
        "animate @c 'hamflathand hamsmallmod hampalmx' --as ODD",
        0,
        &[
            "/recipe",
            "/report/warnings",
            "/findings/0/symbol",
            "/findings/0/message",
            "/findings/0/remedy",
            "/findings/0/line",
            "/findings/0/file",
        ],
    ),
    ("animate @c NONE --as X", 1, ERROR),
    ("animate @c MERCI --signer signer:nobody", 1, ERROR),
    ("animate @c", 2, ERROR),
    (
        "render @c BOL --to @d/bowl.png --frames 2 --height 80",
        0,
        &["/path", "/bytes"],
    ),
    (
        "render @c inventory:configurations/U --to @d/u.png --height 80",
        0,
        &["/path", "/bytes"],
    ),
    ("render @c BOL --to @d/bowl.jpg", 1, ERROR),
    ("render @c LIMACE --to @d/slug.png", 1, ERROR),
    ("render @c BOL --to @in/notes.txt", 1, ERROR),
    (
        "score @c BOL BOL",
        0,
        &[
            "/distance",
            "/normalized",
            "/components",
            "/max_joint_error_m",
            "/alignment",
        ],
    ),
    ("score @c BOL LIMACE", 1, ERROR),
    ("suggest @c LIMACE", 0, &["/token", "/partners", "/unused"]),
    ("suggest @c NONE", 1, ERROR),
    (
        "transcribe @c BOL",
        0,
        &[
            "/hamnosys",
            "/symbols/0",
            "/sign/parts/0",
            "/stages/0/start_us",
            "/stages/0/hamnosys",
            "/stages/0/symbols/0",
            "/stages/0/action",
            "/features/1/feature",
            "/features/1/hand",
            "/features/1/value",
            "/features/1/hamnosys",
            "/features/1/symbols/0",
            "/features/1/residual",
            "/features/1/unit",
            "/features/1/at_us",
            "/features/1/start_us",
            "/features/1/end_us",
            "/features/1/runner_up/value",
            "/features/1/runner_up/symbols/0",
            "/features/1/runner_up/residual",
            "/start_us",
            "/end_us",
            "/findings",
        ],
    ),
    ("transcribe @c NONE", 1, ERROR),
    ("transcribe @c recording:1 --store", 1, ERROR),
    ("transcribe @c BOL --store", 0, &["/hamnosys"]),
    ("transcribe @c BOL --force", 2, ERROR),
    ("export @c recording:1 --to @d/bowl.bvh", 0, WRITTEN),
    ("export @c recording:1 --to @d/bowl.eaf", 0, WRITTEN),
    ("export @c query:configuration=S --to @d/s.csv", 0, WRITTEN),
    ("export @c all --to @d/all", 0, WRITTEN),
    ("export @c all --to @d/all.sigml", 0, WRITTEN),
    ("export @c sign:MERCI --to @d/merci.hsigml", 0, WRITTEN),
    (
        "export @c query:placement=chin --to @d/chin.hns",
        0,
        WRITTEN,
    ),
    (
        "export @c recording:1 BOL --to @d/takes --format bvh",
        0,
        &["/files/0/path", "/files/1/path"],
    ),
    ("export @c recording:1 BOL --to @d/takes", 1, ERROR),
    ("export @c recording:1 BOL --to @d/takes.bvh", 1, ERROR),
    ("export @c BOL --to @d/bowl.fbx", 1, ERROR),
    ("export @c BOL --to -", 1, ERROR),
    ("import @c -", 1, ERROR),
    ("export @c BOL --to @d/bowl.sigml", 1, ERROR),
    ("export @c all --to @d/all.docx", 1, ERROR),
    ("export @c recording:9 --to @d/nine.bvh", 1, ERROR),
    ("export @c recording:1 --to @in/bowl.bvh", 1, ERROR),
    ("check @c", 0, &["/ok", "/checked", "/faults", "/mended"]),
    ("check @in/notes.txt", 1, ERROR),
    ("dance @c", 2, ERROR),
    ("log @c --no-such-option", 2, ERROR),
];

#[test]
fn each_command_keeps_to_its_exit_code_and_its_json() {
    let desk = Desk::new();
    let mut faults = Vec::new();
    for case in CASES {
        if let Err(fault) = desk.try_json(case) {
            faults.push(format!("{} --json: {fault}", case.0));
        }
        if let Err(fault) = desk.try_text(case) {
            faults.push(format!("{}: {fault}", case.0));
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn an_import_that_takes_nothing_leaves_no_corpus() {
    let desk = Desk::new();
    for file in ["@more/broken.sigml", "@in/none.bvh", "@in/notes.txt", "-"] {
        let done = desk.run(&desk.words(&format!("import @d/new.chereme {file}")));
        assert_eq!(done.status.code(), Some(1), "{file}");
        let left = fs::read_dir(desk.folder.path().join("empty")).expect("a folder");
        assert_eq!(left.count(), 0, "{file}");
    }
}

#[test]
fn carets_stand_below_what_is_wrong() {
    let desk = Desk::new();
    let done = desk.run(&desk.words("search @c placement=chinn"));
    let told = text(&done.stderr);
    let lines: Vec<&str> = told.lines().collect();
    let at = lines.iter().position(|line| *line == "placement=chinn");
    let carets = at.and_then(|at| lines.get(at + 1));
    assert_eq!(carets, Some(&"          ^^^^^"), "{told}");
    assert!(lines[0].starts_with("error: the value \"chinn\""), "{told}");
}

#[test]
fn a_made_sign_is_made_anew_in_its_place() {
    let desk = Desk::new();
    let corpus = desk.corpus().display().to_string();
    let json = |line: String| -> serde_json::Value {
        let done = desk.run(&format!("{line} --json"));
        assert!(done.status.success(), "{line}: {}", text(&done.stderr));
        serde_json::from_slice(&done.stdout).expect("JSON")
    };
    let first = json(format!("recombine {corpus} 'BOL | reverse' --as LOB"));
    let second = json(format!(
        "recombine {corpus} 'BOL | reverse | repeat 2' --replace LOB"
    ));
    assert_eq!(second["token"], first["token"]);
    assert_eq!(second["name"], first["name"]);
    assert_ne!(second["duration_us"], first["duration_us"]);
}

#[test]
fn every_command_has_a_help_that_says_what_it_does() {
    let desk = Desk::new();
    let help = desk.run("--help");
    assert_eq!(help.status.code(), Some(0));
    let commands = commands(&text(&help.stdout));
    for known in [
        "demo",
        "new",
        "import",
        "info",
        "list",
        "annotate",
        "search",
        "recombine",
        "animate",
        "render",
        "export",
        "undo",
        "redo",
        "log",
        "check",
    ] {
        assert!(commands.iter().any(|(name, _)| name == known), "{known}");
    }
    for (name, about) in &commands {
        assert!(!about.is_empty(), "{name} is not described");
        let help = desk.run(&format!("{name} --help"));
        assert_eq!(help.status.code(), Some(0), "{name}");
        let help = text(&help.stdout);
        assert!(help.contains("Usage: chereme"), "{name}: {help}");
        assert!(help.contains("--json"), "{name}: {help}");
    }
    let nothing = desk.run("");
    assert_eq!(nothing.status.code(), Some(2));
    assert!(text(&nothing.stderr).contains("Usage: chereme"));
    let version = desk.run("--version");
    assert_eq!(version.status.code(), Some(0));
    assert!(text(&version.stdout).contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn what_was_done_can_be_undone_and_is_signed() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let author = format!("undo {path} --author Ben");
    assert!(desk.run(&author).status.success());
    let log = desk.json(&format!("log {path}"));
    assert_eq!(log["rows"][0]["author"], "Ben");
    assert_eq!(log["rows"][0]["kind"], "undo");
    assert_eq!(log["rows"][1]["stands"], false);
    assert!(desk.run(&format!("redo {path}")).status.success());
    assert_eq!(desk.json(&format!("log {path}"))["rows"][2]["stands"], true);
}

#[test]
fn everyday_words_that_find_nothing_are_offered_as_a_query() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let said = desk.json(&format!(
        "search {} handshape flat placement menton",
        corpus.display()
    ));
    assert_eq!(said["total"], 0);
    let note = said["notes"][0].as_str();
    assert_eq!(
        note,
        Some("did you mean configuration=flat placement=chin?")
    );
}

#[test]
fn a_search_is_kept_asked_again_and_forgotten() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let line = format!("search {path} 'gloss=CHAT or gloss=BOL' --keep 'two signs'");
    let first = desk.json(&line);
    assert_eq!(first["notes"][0], "kept: @two signs asks this again");
    let again = desk.json(&format!("search {path} '@Two Signs'"));
    assert_eq!(again["hits"], first["hits"]);
    let listed = desk.json(&format!("list {path} searches"));
    assert_eq!(listed["rows"][0]["query"], "gloss=CHAT or gloss=BOL");
    let gone = desk.json(&format!("search {path} --forget 'two signs'"));
    assert_eq!(gone["name"], "two signs");
    assert!(desk.run(&format!("undo {path}")).status.success());
    assert_eq!(desk.json(&format!("list {path} searches"))["total"], 1);
}

#[test]
fn a_dry_run_leaves_nothing_behind() {
    let desk = Desk::new();
    let (corpus, inbox) = (desk.corpus(), desk.inbox());
    let line = format!(
        "import {} {} --dry-run",
        corpus.display(),
        desk.more().join("other.bvh").display()
    );
    assert_eq!(desk.json(&line)["created"]["recordings"], 1);
    let log = desk.json(&format!("log {}", corpus.display()));
    assert_eq!(log["total"], 1, "only that of the maker: {log}");
    let absent = desk.folder.path().join("absent.chereme");
    let line = format!("import {} {} --dry-run", absent.display(), inbox.display());
    let report = desk.json(&line);
    assert_eq!(report["dry_run"], true);
    assert_eq!(report["created"]["recordings"], 1);
    assert!(!absent.exists());
}

#[test]
fn documents_go_through_standard_input_and_output() {
    let desk = Desk::new();
    let corpus = desk.corpus().display().to_string();
    let pipe = |line: &str, input: &[u8]| desk.pipe(&line.replace("@c", &corpus), input);
    let eaf = pipe("export @c recording:1 --to - --format eaf", b"");
    assert!(eaf.status.success(), "{}", text(&eaf.stderr));
    assert!(text(&eaf.stdout).starts_with("<?xml"));
    assert!(!desk.folder.path().join("-").exists());
    let csv = pipe("export @c all --to - --format csv", b"");
    assert!(text(&csv.stdout).starts_with("token,gloss,"));
    let both = pipe("export @c all --to - --format csv --json", b"");
    assert_eq!(both.status.code(), Some(1));
    let done = pipe("import @c - --format eaf --name again", &eaf.stdout);
    assert!(
        done.status.success(),
        "{}{}",
        text(&done.stdout),
        text(&done.stderr)
    );
    assert!(text(&pipe("list @c recordings", b"").stdout).contains("again"));
    let done = pipe(
        "annotate @c from -",
        b"recording,tier,start,end,value\nbowl,Gloss,1.6,1.8,JOUR\n",
    );
    assert!(
        text(&done.stdout).starts_with("1 added"),
        "{}",
        text(&done.stderr)
    );
    let done = pipe(
        "animate @c -",
        b"hamflathand hamextfingeru hampalml hammoveo\n",
    );
    assert!(done.status.success(), "{}", text(&done.stderr));
    let sigml = fs::read(desk.inbox().join("notated.sigml")).expect("a file");
    let done = pipe("animate @c -", &sigml);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let done = pipe("recombine @c - --as LOB", b"BOL | reverse\n");
    assert!(done.status.success(), "{}", text(&done.stderr));
    let picture = pipe("render @c BOL --to - --height 40 --frames 2", b"");
    assert!(
        picture.stdout.starts_with(b"\x89PNG"),
        "{}",
        text(&picture.stderr)
    );
}

#[test]
fn undoing_more_than_there_is_undoes_all_and_says_so() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let done = desk.run(&format!("undo {path} --times 99"));
    assert_eq!(done.status.code(), Some(0));
    let said = text(&done.stdout);
    assert!(
        said.contains("1 operation undone, and nothing is left to undo (99 were asked for)"),
        "{said}"
    );
    assert_eq!(
        desk.run(&format!("undo {path} --times 99")).status.code(),
        Some(1)
    );
    let json = desk.json(&format!("redo {path} --times 3"));
    assert_eq!(
        (json["operations"].as_array().map(Vec::len), &json["left"]),
        (Some(1), &0.into())
    );
}

#[test]
fn a_table_of_many_rows_names_no_thousand_ids() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let mut table = String::from("recording,tier,start,end,value\n");
    for n in 0..300 {
        let at = 1.6 + f64::from(n) * 0.001;
        table.push_str(&format!("bowl,Gloss,{at:.3},{:.3},N{n}\n", at + 0.001));
    }
    let done = desk.pipe(&format!("annotate {path} from -"), table.as_bytes());
    let said = text(&done.stdout);
    assert!(
        said.starts_with("300 added") && said.len() < 200,
        "{said}{}",
        text(&done.stderr)
    );
    assert!(desk.run(&format!("undo {path}")).status.success());
    let count = |line: String| {
        let done = desk.pipe(&line, table.as_bytes());
        let json: serde_json::Value = serde_json::from_slice(&done.stdout).expect("JSON");
        assert_eq!(json["annotations_total"], 300);
        json["annotations"].as_array().map(Vec::len)
    };
    assert_eq!(count(format!("annotate {path} from - --json")), Some(100));
    assert!(desk.run(&format!("undo {path}")).status.success());
    assert_eq!(
        count(format!("annotate {path} from - --json --ids")),
        Some(300)
    );
}

#[test]
fn a_change_says_from_what_to_what_and_pushes_others_where_asked() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let over = desk.run(&format!(
        "annotate {path} --in bowl add Gloss JOUR --start 0.2 --end 0.4"
    ));
    let said = text(&over.stderr);
    assert!(
        said.contains("overlaps \"BOL\"") && said.contains("on the tier \"Gloss\""),
        "{said}"
    );
    assert!(said.contains("free next to it: "), "{said}");
    let done = desk.run(&format!("annotate {path} replace BOL TASSE --tier Gloss"));
    assert!(
        text(&done.stdout).contains("\"BOL\" -> \"TASSE\""),
        "{}",
        text(&done.stdout)
    );
    let log = desk.run(&format!("log {path} --changes --limit 1"));
    let said = text(&log.stdout);
    assert!(
        said.contains("annotation \"BOL\" on Gloss of bowl: "),
        "{said}"
    );
    assert!(said.contains("value from \"BOL\" to \"TASSE\""), "{said}");
}

#[test]
fn the_command_line_speaks_french_where_it_is_asked_to() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    for line in [
        format!("--language fr search {path} @none"),
        format!("undo {path} --times 0 --language=fr"),
    ] {
        let done = desk.run(&line);
        assert!(
            text(&done.stderr).starts_with("erreur : "),
            "{}",
            text(&done.stderr)
        );
    }
    let done = desk.run(&format!("undo {path} --language fr"));
    assert!(
        text(&done.stdout).starts_with("annulé : opération 1, Importé : "),
        "{}",
        text(&done.stdout)
    );
    let none = desk.run(&format!("undo {path} --language fr"));
    assert_eq!(
        text(&none.stderr).lines().next(),
        Some("erreur : il n’y a rien à annuler")
    );
    let json = desk.run(&format!("undo {path} --language fr --json"));
    assert!(
        text(&json.stdout).contains("there is nothing to undo"),
        "JSON stays"
    );
    let help = desk.run("undo --help --language fr");
    assert!(
        text(&help.stdout).contains("Annuler la dernière modification"),
        "{}",
        text(&help.stdout)
    );
}

#[test]
fn an_unknown_action_is_answered_with_those_there_are() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let done = desk.run(&format!("annotate {} change a1", corpus.display()));
    let said = text(&done.stderr);
    assert!(said.contains("The actions are: add, set, split"), "{said}");
    let done = desk.run(&format!(
        "annotate {} --in bowl add-tier X --role nonsense",
        corpus.display()
    ));
    assert!(
        text(&done.stderr).contains("is no role; write gloss"),
        "{}",
        text(&done.stderr)
    );
    let done = desk.run(&format!("suggest {} bowl", corpus.display()));
    let said = text(&done.stderr);
    assert!(said.contains("recording:\"bowl\""), "{said}");
}

#[test]
fn tables_are_as_wide_as_asked_for() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let widest = |width: &str| {
        let done = desk.run(&format!("list {path} tokens {width}"));
        text(&done.stdout)
            .lines()
            .map(|line| line.chars().count())
            .max()
    };
    assert!(widest("--width 100") <= Some(100), "shortened");
    assert!(
        widest("") > Some(110),
        "whole, as it goes to another program"
    );
    assert_eq!(widest("--width 0"), widest(""));
}

/// Returns the commands that the help lists, with what it says of them.
fn commands(help: &str) -> Vec<(String, String)> {
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    lines
        .take_while(|line| !line.trim().is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.trim().split_once(' '))
        .filter(|(name, _)| *name != "help")
        .map(|(name, about)| (name.to_owned(), about.trim().to_owned()))
        .collect()
}

#[test]
fn a_reader_that_leaves_early_is_no_fault() {
    let desk = Desk::new();
    let mut child = Command::new(env!("CARGO_BIN_EXE_chereme"))
        .args([Path::new("log"), &desk.corpus()])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    drop(child.stdout.take());
    let done = child.wait_with_output().expect("it ends");
    assert_eq!(text(&done.stderr), "");
    assert_eq!(done.status.code(), Some(0));
}
