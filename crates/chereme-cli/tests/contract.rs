//! The contract with scripts: exit codes, one JSON document, errors with a place and a remedy, help.
//!
//! A command is tried by a line in a table: its words, its exit code, and the keys of its JSON. In the words `@c`
//! is a corpus of two signs and a small lexicon, `@in` the folder of its files, `@more` a folder with another
//! recording and one file that is not a recording, and `@d` an empty folder.

mod desk;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use chereme_corpus::words::InterfaceLanguage;
use desk::cases::CASES;
use desk::{Desk, text};

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
fn an_import_without_readable_files_leaves_no_corpus() {
    let desk = Desk::new();
    for file in ["@more/broken.sigml", "@in/none.bvh", "@in/notes.txt", "-"] {
        let done = desk.run(&desk.words(&format!("import @d/new.chereme {file}")));
        assert_eq!(done.status.code(), Some(1), "{file}");
        let left = fs::read_dir(desk.folder.path().join("empty")).expect("a folder");
        assert_eq!(left.count(), 0, "{file}");
    }
}

#[test]
fn carets_stand_below_the_wrong_words() {
    let desk = Desk::new();
    let done = desk.run(&desk.words("search @c placement=chinn"));
    let printed = text(&done.stderr);
    let lines: Vec<&str> = printed.lines().collect();
    let at = lines.iter().position(|line| *line == "placement=chinn");
    let carets = at.and_then(|at| lines.get(at + 1));
    assert_eq!(carets, Some(&"          ^^^^^"), "{printed}");
    assert!(lines[0].starts_with("error: the value \"chinn\""), "{printed}");
}

#[test]
fn a_generated_sign_is_replaced_in_place() {
    let desk = Desk::new();
    let corpus = desk.corpus().display().to_string();
    let json = |line: String| -> serde_json::Value {
        let done = desk.run(&format!("{line} --json"));
        assert!(
            done.status.success(),
            "{line}: {} {}",
            text(&done.stdout),
            text(&done.stderr)
        );
        serde_json::from_slice(&done.stdout).expect("JSON")
    };
    let first = json(format!("recombine {corpus} 'BOL | reverse' --as LOB"));
    let second = json(format!(
        "recombine {corpus} 'BOL | reverse | retime 150%' --replace LOB"
    ));
    assert_eq!(second["token"], first["token"]);
    assert_eq!(second["name"], first["name"]);
    assert_ne!(second["duration_us"], first["duration_us"]);
}

#[test]
fn every_command_has_help_with_a_description() {
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
        "forget",
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
fn changes_are_undone_redone_and_logged_with_their_author() {
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
    let said = desk.json(&format!("search {} handshape flat placement menton", corpus.display()));
    assert_eq!(said["total"], 0);
    let note = said["notes"][0].as_str();
    assert_eq!(note, Some("did you mean configuration=flat placement=chin?"));
}

#[test]
fn a_search_is_saved_run_again_and_deleted() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let line = format!("search {path} 'gloss=CHAT or gloss=BOL' --keep 'two signs'");
    let first = desk.json(&line);
    assert_eq!(first["notes"][0], "saved: @two signs stands for this query");
    let again = desk.json(&format!("search {path} '@Two Signs'"));
    assert_eq!(again["hits"], first["hits"]);
    let other = format!("search {path} gloss=CHAT --keep 'Two signs'");
    assert!(!desk.run(&other).status.success(), "another search has the name");
    let listed = desk.json(&format!("list {path} searches"));
    assert_eq!(listed["rows"][0]["query"], "gloss=CHAT or gloss=BOL");
    assert!(desk.run(&format!("{other} --replace")).status.success());
    let listed = desk.json(&format!("list {path} searches"));
    assert_eq!(listed["rows"][0]["query"], "gloss=CHAT");
    let gone = desk.json(&format!("search {path} --forget 'two signs'"));
    assert_eq!(gone["name"], "Two signs");
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
    assert!(done.status.success(), "{}{}", text(&done.stdout), text(&done.stderr));
    assert!(text(&pipe("list @c recordings", b"").stdout).contains("again"));
    let done = pipe(
        "annotate @c from -",
        b"recording,tier,start,end,value\nbowl,Gloss,1.6,1.8,JOUR\n",
    );
    assert!(
        text(&done.stdout).starts_with("1 annotation added"),
        "{}",
        text(&done.stderr)
    );
    let done = pipe("animate @c -", b"hamflathand hamextfingeru hampalml hammoveo\n");
    assert!(done.status.success(), "{}", text(&done.stderr));
    let sigml = fs::read(desk.inbox().join("notated.sigml")).expect("a file");
    let done = pipe("animate @c -", &sigml);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let done = pipe("recombine @c - --as LOB", b"BOL | reverse\n");
    assert!(done.status.success(), "{}", text(&done.stderr));
    let picture = pipe("render @c BOL --to - --height 40 --frames 2", b"");
    assert!(picture.stdout.starts_with(b"\x89PNG"), "{}", text(&picture.stderr));
}

#[test]
fn undoing_more_operations_than_exist_undoes_all_and_reports_it() {
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
    assert_eq!(desk.run(&format!("undo {path} --times 99")).status.code(), Some(1));
    let json = desk.json(&format!("redo {path} --times 3"));
    assert_eq!(
        (json["operations"].as_array().map(Vec::len), &json["left"]),
        (Some(1), &0.into())
    );
}

#[test]
fn adding_many_rows_prints_a_short_summary() {
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
        said.starts_with("300 annotations added") && said.len() < 200,
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
    assert_eq!(count(format!("annotate {path} from - --json --ids")), Some(300));
}

#[test]
fn copied_annotations_are_pasted_once() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let copied = "tier\tstart\tend\tvalue\nGloss\t0.000\t0.010\tUN\nGloss\t0.020\t0.030\tDEUX\n";
    let line = format!("annotate {path} --in bowl paste - --at 1.6 --json");
    let done = desk.pipe(&line, copied.as_bytes());
    let json: serde_json::Value = serde_json::from_slice(&done.stdout).expect("JSON");
    assert_eq!(json["added"], 2, "{}", text(&done.stderr));
    let again = desk.pipe(&line, copied.as_bytes());
    let json: serde_json::Value = serde_json::from_slice(&again.stdout).expect("JSON");
    let message = json["error"]["message"].as_str().unwrap_or_default();
    assert!(
        message.contains("there is an annotation already at 1.600s"),
        "{message}"
    );
    let french = desk.pipe(
        &format!("--language fr annotate {path} --in bowl paste - --at 1.6"),
        copied.as_bytes(),
    );
    let said = text(&french.stderr);
    assert!(said.contains("il y a déjà une annotation à 1.600s"), "{said}");
}

#[test]
fn a_change_prints_the_old_and_new_value_and_pushes_neighbours_on_request() {
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
    assert!(said.contains("annotation \"BOL\" on Gloss of bowl: "), "{said}");
    assert!(said.contains("value from \"BOL\" to \"TASSE\""), "{said}");
}

#[test]
fn the_command_line_speaks_french_if_requested() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    for line in [
        format!("--language fr search {path} @none"),
        format!("undo {path} --times 0 --language=fr"),
    ] {
        let done = desk.run(&line);
        assert!(text(&done.stderr).starts_with("erreur : "), "{}", text(&done.stderr));
    }
    for (language, last) in [("en", ": import "), ("fr", " : Importé : ")] {
        let info = desk.run(&format!("info {path} --language {language}"));
        let said = text(&info.stdout);
        let line = said.lines().find(|it| it.contains("maker"));
        assert!(line.is_some_and(|it| it.contains(last)), "{said}");
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
    assert!(text(&json.stdout).contains("there is nothing to undo"), "JSON stays");
    let help = desk.run("undo --help --language fr");
    assert!(
        text(&help.stdout).contains("Annuler la dernière modification"),
        "{}",
        text(&help.stdout)
    );
}

/// Names that hold the words of sentences, and the marks of other lines: they stand in French lines as they are.
#[test]
fn names_stand_in_french_lines_as_they_are() {
    let desk = Desk::new();
    for ending in ["bvh", "eaf"] {
        let to = desk.more().join(format!("talk in Paris to Lyon.{ending}"));
        fs::copy(desk.inbox().join(format!("bowl.{ending}")), to).expect("copied");
    }
    let path = desk.corpus().display().to_string();
    let said = |line: &str| {
        let done = desk.run(&line.replace("@c", &path));
        assert!(done.status.success(), "{line}: {}", text(&done.stderr));
        text(&done.stdout)
    };
    said("import @c 'more/talk in Paris to Lyon.bvh' 'more/talk in Paris to Lyon.eaf'");
    let done = said("annotate @c --in 'talk in Paris to Lyon' add Gloss 'A in B' --start 1.6 --end 1.8 --language fr");
    assert!(
        done.starts_with("1 annotation ajoutée dans talk in Paris to Lyon"),
        "{done}"
    );
    let done = said("recombine @c 'BOL | swap' --as 'note: X' --language fr");
    assert!(done.contains("note: X enregistré"), "{done}");
    let done = said("undo @c --language fr");
    assert!(done.starts_with("annulé : opération 4, note: X composé : "), "{done}");
    let log = said("log @c --language fr --width 0");
    for part in [
        "annulation de 4 : note: X composé : BOL | swap",
        "1 annotation ajoutée dans talk in Paris to Lyon",
        "Importé : 2 fichiers, de talk in Paris to Lyon.bvh à talk in Paris to Lyon.eaf",
    ] {
        assert!(log.contains(part), "{part}\n{log}");
    }
    let log: serde_json::Value = serde_json::from_str(&said("log @c --language fr --json")).expect("JSON");
    let row = &log["rows"][3];
    assert_eq!(
        (row["name"].as_str(), row["summary"].as_str()),
        (
            Some("import"),
            Some("2 files from talk in Paris to Lyon.bvh to talk in Paris to Lyon.eaf")
        )
    );
    assert_eq!(row["effect"]["last"], "talk in Paris to Lyon.eaf");
}

#[test]
fn an_unknown_action_or_role_is_answered_with_the_known_ones() {
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
fn codings_are_proposed_for_tokens_without_one_and_reports_count_them() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let done = desk.json(&format!("propose {path} configuration"));
    for key in ["tokens", "annotations", "unread", "recordings"] {
        assert!(done.get(key).is_some(), "{key} of {done}");
    }
    let refused = desk.run(&format!("propose {path} nonmanual"));
    assert_eq!(refused.status.code(), Some(1));
    let said = text(&refused.stderr);
    assert!(said.contains("what can be proposed: configuration"), "{said}");
}

#[test]
fn every_detector_is_named_in_the_help_and_in_the_error_for_an_unknown_one() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let done = desk.json(&format!("propose {path} --detector signs"));
    for key in ["annotations", "recordings", "unobserved", "found", "without"] {
        assert!(done.get(key).is_some(), "{key} of {done}");
    }
    assert_eq!(done["detector"], "signs");
    let undone = desk.run(&format!("undo {path}"));
    assert_eq!(undone.status.code(), Some(0));
    let refused = desk.run(&format!("propose {path} --detector waves"));
    assert_eq!(refused.status.code(), Some(2));
    let english = text(&desk.run("propose --help").stdout);
    let french = text(&desk.run("--language fr propose --help").stdout);
    let said = text(&refused.stderr);
    for detector in chereme_corpus::ALL_DETECTORS {
        let finds = detector.detector_description().finds;
        let flat = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(detector.detector_name()), "{said}");
        assert!(
            flat(&english).contains(&flat(finds.text_in_language(InterfaceLanguage::English))),
            "{english}"
        );
        assert!(
            flat(&french).contains(&flat(finds.text_in_language(InterfaceLanguage::French))),
            "{french}"
        );
    }
}

#[test]
fn tables_have_the_requested_width() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let widest = |width: &str| {
        let done = desk.run(&format!("list {path} tokens {width}"));
        text(&done.stdout).lines().map(|line| line.chars().count()).max()
    };
    assert!(widest("--width 100") <= Some(100), "shortened");
    assert!(widest("") > Some(110), "whole, as it goes to another program");
    assert_eq!(widest("--width 0"), widest(""));
}

/// Returns the commands that the help lists, with their descriptions.
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
fn a_study_is_planned_again_from_its_json_built_answered_and_forgotten() {
    let desk = Desk::new();
    let corpus = desk.corpus().display().to_string();
    let folder = desk.folder.path();
    let json = |line: String| -> serde_json::Value {
        let done = desk.run(&format!("{line} --json"));
        assert!(
            done.status.success(),
            "{line}: {} {}",
            text(&done.stdout),
            text(&done.stderr)
        );
        serde_json::from_slice(&done.stdout).expect("JSON")
    };
    json(format!(
        "study new {corpus} s --items BOL --condition 'captured={{}}' --ask realism --ask 'gloss=items CHAT'"
    ));
    let mut plan = json(format!("study show {corpus} s"));
    plan["title"]["en"] = "Bowls".into();
    fs::write(folder.join("plan.json"), plan.to_string()).expect("written");
    let planned = json(format!("study new {corpus} s --plan plan.json"));
    assert_eq!(planned["replaced"], true);
    let refused = desk.run(&format!("study build {corpus} s --to q"));
    assert!(
        text(&refused.stderr).contains("withheld from public"),
        "{}",
        text(&refused.stderr)
    );
    json(format!("consent {corpus} signer:1 --all public --licence CC0"));
    let built = json(format!("study build {corpus} s --to q --height 64 --rate 5"));
    assert_eq!(built["films"], 1);
    let page = fs::read_to_string(folder.join("q/index.html")).expect("the page");
    assert!(page.contains("<title>Bowls</title>"));
    let again = desk.run(&format!("study build {corpus} s --to q"));
    assert!(text(&again.stderr).contains("--force"), "{}", text(&again.stderr));
    let answers = format!(
        "participant,plan_sha256,n,item,condition,question,value\n\
         heron,{0},1,BOL,captured,realism,5\nheron,{0},2,BOL,captured,realism,9\n",
        planned["plan_sha256"].as_str().expect("a hash")
    );
    fs::write(folder.join("a.csv"), answers).expect("written");
    let report = json(format!("study import {corpus} s a.csv"));
    assert_eq!((&report["added"], &report["answers"]), (&1.into(), &1.into()));
    assert_eq!(report["files"][0]["findings"][0]["line"], 3);
    let french = desk.run(&format!("--language fr study import {corpus} s a.csv"));
    assert!(
        text(&french.stdout).contains("hors de l’échelle de 1 à 5"),
        "{}",
        text(&french.stdout)
    );
    fs::write(
        folder.join("b.csv"),
        "participant,plan_sha256,item,condition,question\nx,0,BOL,captured,realism\n",
    )
    .expect("written");
    let refused = desk.run(&format!("study import {corpus} s b.csv --json"));
    assert_eq!(refused.status.code(), Some(1));
    json(format!("study answers {corpus} s --to all.csv"));
    let report = json(format!("study report {corpus} s"));
    assert_eq!(report["people"]["analysed"], 1);
    let counts = &report["questions"][0]["conditions"][0]["counts"];
    assert_eq!(*counts, serde_json::json!([0, 0, 0, 0, 1]));
    let written = desk.run(&format!("study report {corpus} s --to report"));
    assert!(written.status.success(), "{}", text(&written.stderr));
    let page = fs::read_to_string(folder.join("report/report.html")).expect("the page");
    assert!(page.contains("<h1>Bowls</h1>"));
    let again = desk.run(&format!("study report {corpus} s --to report"));
    assert!(text(&again.stderr).contains("--force"));
    json(format!("study forget {corpus} s heron"));
    assert_eq!(json(format!("list {corpus} studies"))["rows"][0]["participants"], 0);
    json(format!("undo {corpus}"));
    assert_eq!(json(format!("list {corpus} studies"))["rows"][0]["answers"], 1);
}

#[test]
fn a_closed_output_pipe_is_no_error() {
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

#[test]
fn a_language_is_a_folder_and_may_be_the_users_own() {
    let desk = Desk::new();
    let words = desk.folder.path().join("words");
    fs::create_dir_all(words.join("tlh")).expect("made");
    let file = words.join("tlh/own.ftl");
    let write = |text: &str| fs::write(&file, text).expect("written");
    let run = |line: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_chereme"));
        command
            .args(line.split(' '))
            .env("LC_ALL", "C")
            .env("CHEREME_WORDS", &words);
        command.output().expect("the program runs")
    };
    write("language-name = tlhIngan Hol\nhelp-commands-corpus = De’wI’\nmenu-edit-undo = Undo { $n }\n");
    let listed = text(&run("words").stdout);
    assert!(
        listed.contains("tlhIngan Hol") && listed.contains("Deutsch"),
        "{listed}"
    );
    // The phrase with another variable part cannot be used, and what is missing is English.
    let missing = text(&run("words --missing tlh").stdout);
    assert!(
        missing.contains("tlh/own.ftl:3: the variable parts of menu-edit-undo"),
        "{missing}"
    );
    let undo = missing.lines().find(|line| line.starts_with("menu-edit-undo "));
    assert!(undo.is_some_and(|line| line.contains(" Undo ")), "{missing}");
    let help = text(&run("--language tlh undo --help").stdout);
    assert!(help.contains("De’wI’") && help.contains("Usage: "), "{help}");
    let unknown = run("--language xx words");
    let refused = text(&unknown.stderr);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(refused.contains("en, fr, de, tlh"), "{refused}");
    write("language-name = tlhIngan Hol\nmenu-edit-undo\n");
    let damaged = run("words");
    let refused = text(&damaged.stderr);
    assert_eq!(damaged.status.code(), Some(1));
    assert!(refused.contains("tlh/own.ftl:2"), "{refused}");
}

#[test]
fn the_language_of_a_tier_is_not_that_of_the_program() {
    let desk = Desk::new();
    let path = desk.corpus();
    let path = path.display();
    for code in ["de", "fr"] {
        let line = format!("annotate {path} --in bowl add-tier T-{code} --language {code}");
        let done = desk.run(&line);
        assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
        let tiers = text(&desk.run(&format!("list {path} tiers --json")).stdout);
        assert!(tiers.contains(&format!("\"language\":\"{code}\"")), "{tiers}");
    }
}
