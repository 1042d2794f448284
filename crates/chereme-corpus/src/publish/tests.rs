mod consent;

use super::*;
use crate::consent::tests::corpus;
use crate::{ConsentAudience, ConsentChange, SignChange, ignore_progress_step};

fn granted(audience: ConsentAudience) -> ConsentChange {
    let said = Some(Some(audience));
    ConsentChange {
        movement: said,
        annotation: said,
        derived: said,
        licence: Some("CC BY 4.0".into()),
        ..ConsentChange::default()
    }
}

pub(super) fn consented(corpus: &mut Corpus, who: &str, audience: ConsentAudience) {
    let who = [who.parse().expect("an address")];
    let change = granted(audience);
    corpus.change_consent(&who, &change).expect("changed");
}

pub(super) fn publish(corpus: &mut Corpus, to: &Path, terms: Option<&str>) -> CorpusResult<PublishedDictionary> {
    let options = PublishOptions {
        terms: terms.map(str::to_owned),
        title: Some("Signs & </script> \"@@GLOSS@@\"".into()),
        ..PublishOptions::default()
    };
    corpus.publish_dictionary(to, &options, &mut ProgressReceiver::new(&mut ignore_progress_step))
}

/// Returns the files of a folder with their bytes.
pub(super) fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    fn walk(folder: &Path, prefix: &str, files: &mut BTreeMap<String, Vec<u8>>) {
        for entry in fs::read_dir(folder).expect("a folder").flatten() {
            let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
            match entry.path().is_dir() {
                true => walk(&entry.path(), &format!("{name}/"), files),
                false => drop(files.insert(name, fs::read(entry.path()).expect("read"))),
            }
        }
    }
    let mut all = BTreeMap::new();
    walk(folder, "", &mut all);
    all
}

fn holding(files: &BTreeMap<String, Vec<u8>>, text: &str) -> Vec<String> {
    let text = fold_text(text);
    let found = files.iter().filter(|(name, bytes)| {
        fold_text(name).contains(&text) || fold_text(&String::from_utf8_lossy(bytes)).contains(&text)
    });
    found.map(|(name, _)| name.clone()).collect()
}

/// Returns the text of an address.
fn decoded(address: &str) -> String {
    let mut pieces = address.split('%');
    let mut bytes = pieces.next().unwrap_or_default().as_bytes().to_vec();
    for piece in pieces {
        bytes.push(u8::from_str_radix(&piece[..2], 16).expect("two digits"));
        bytes.extend(&piece.as_bytes()[2..]);
    }
    String::from_utf8(bytes).expect("text")
}

#[test]
fn nothing_is_published_that_nobody_agreed_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    let to = folder.path().join("site");
    let error = publish(&mut corpus, &to, None).expect_err("nothing may be published");
    let remedy = error.error_remedy().map(|it| it.remedy_text().to_owned());
    assert!(remedy.is_some_and(|it| it.contains("chereme consent") || it.contains("--terms")));
    assert!(!to.exists());
    let error = publish(&mut corpus, folder.path(), Some("CC0")).expect_err("the corpus is in it");
    assert!(error.to_string().contains("the corpus itself"), "{error}");
    // Entries of the lexicon show nobody; their terms are enough.
    let done = publish(&mut corpus, &to, Some("CC0")).expect("published");
    assert!(done.signs > 3 && done.moving == 0 && done.signers == 0);
    let left: Vec<(WithheldReason, LeftOutPart)> = done.left_out.iter().map(|it| (it.why, it.part)).collect();
    // LIMACE is an entry, too; ESCARGOT and BOL are left out completely.
    let unknown = WithheldReason::ConsentUnknown;
    assert_eq!(left, [(unknown, LeftOutPart::Sign), (unknown, LeftOutPart::Movement)]);
    assert_eq!(done.left_out[1].first, ["LIMACE"]);
    assert!(holding(&files(&to), "escargot").is_empty());
}

#[test]
fn a_withdrawn_sign_leaves_no_trace_and_names_never_get_in() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    consented(&mut corpus, "signer:Ada", ConsentAudience::Public);
    let change = SignChange {
        notes: Some(Some("Ada was tired that day".into())),
        ..SignChange::default()
    };
    corpus
        .change_sign(&crate::RowName::Text("BOL".into()), &change)
        .expect("changed");
    let to = folder.path().join("site");
    let done = publish(&mut corpus, &to, Some("CC0")).expect("published");
    assert_eq!((done.moving, done.signers), (3, 1), "{done:?}");
    assert!(done.left_out.is_empty());
    let first = files(&to);
    publish(&mut corpus, &folder.path().join("again"), Some("CC0")).expect("published");
    assert_eq!(first, files(&folder.path().join("again")), "the same bytes");
    for name in ["Ada", "tired", "a.chereme", ".bvh", ".eaf", "lexicon.csv"] {
        // Words of the program's own texts and of glosses hold these letters, too.
        let found = holding(&first, name);
        let data = found
            .iter()
            .filter(|it| !it.starts_with("data/") && !it.ends_with(".png"));
        let own: Vec<&String> = data
            .filter(|it| !["app.js", "app.css", "offline.txt"].contains(&it.as_str()))
            .collect();
        assert!(own.is_empty(), "{name}: {own:?}");
    }
    fs::write(to.join("own.txt"), "mine").expect("written");
    consented(&mut corpus, "recording:bol", ConsentAudience::Nobody);
    let done = publish(&mut corpus, &to, Some("CC0")).expect("published");
    assert_eq!(done.left_out[0].first, ["BOL"]);
    let mut second = files(&to);
    assert!(second.remove("own.txt").is_some());
    assert!(holding(&second, "sign/BOL").is_empty() && !holding(&first, "sign/BOL").is_empty());
    let index = String::from_utf8(second["data/signs.js"].clone()).expect("text");
    assert!(!index.contains("\"BOL\"") && index.contains("\"ESCARGOT\""));
    assert!(second.len() < first.len());
}

#[test]
fn words_and_values_of_a_lexicon_without_terms_stay_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("secret.csv");
    let header = "gloss,translation_en,symmetry,attribute.colour,hamnosys";
    fs::write(
        &table,
        format!("{header}\nLIMACE,qzwordzq,alternating,qzcolourzq,hamfist hamextfingeru hampalml\n"),
    )
    .expect("written");
    let mut corpus = corpus(folder.path());
    let progress = &mut ignore_progress_step;
    let options = crate::ImportOptions {
        // That of the captured LIMACE.
        lexicon: Some("lexicon".to_owned()),
        ..crate::ImportOptions::default()
    };
    corpus
        .import_paths(&[table], &options, &mut ProgressReceiver::new(progress))
        .expect("imported");
    consented(&mut corpus, "signer:Ada", ConsentAudience::Public);
    let to = folder.path().join("site");
    let limace = |to: &Path| {
        let all = files(to);
        let kept = |name: &str| name.starts_with("sign/LIMACE") || name == "data/signs.js";
        let pages = all.iter().filter(|(name, _)| kept(name));
        pages
            .map(|(_, bytes)| String::from_utf8_lossy(bytes).into_owned())
            .collect::<String>()
    };
    let words = ["qzwordzq", "qzcolourzq", "hamfist", "alternating"];
    let done = publish(&mut corpus, &to, None).expect("published");
    let withheld = done
        .left_out
        .iter()
        .find(|left| left.part == LeftOutPart::Lexicon)
        .expect("withheld");
    assert_eq!(
        (withheld.first.as_slice(), withheld.why),
        (["LIMACE".to_owned()].as_slice(), WithheldReason::NoTerms)
    );
    for word in words {
        assert!(!limace(&to).contains(word), "{word}");
    }
    let done = publish(&mut corpus, &to, Some("CC0")).expect("published");
    assert!(done.left_out.is_empty());
    let pages = limace(&to);
    assert!(words[..2].iter().all(|word| pages.contains(word)), "{pages}");
    // The page names the terms of the capture and of the lexicon.
    assert!(pages.contains("CC0") && pages.contains("CC BY 4.0"));
}

#[test]
fn pages_name_what_the_movement_of_a_sign_comes_from() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    consented(&mut corpus, "signer:Ada", ConsentAudience::Public);
    let notation = ["hamflathand hamextfingeru hampalml hamchin hammoveo"];
    let made = corpus.animate_notation(&notation, &crate::NotationStaging::default(), Some("NOTED"));
    made.expect("animated");
    for (recipe, gloss) in [
        ("NOTED | reverse", "DETON"),
        ("NOTED then ESCARGOT", "SLOW"),
        ("NOTED | nonmanual from ESCARGOT", "NODDED"),
        ("spell OR", "OR"),
        ("LIMACE | reverse", "ECAMIL"),
    ] {
        corpus.recombine_recipe(recipe, gloss).expect(recipe);
    }
    let to = folder.path().join("site");
    publish(&mut corpus, &to, Some("CC0")).expect("published");
    let all = files(&to);
    for (gloss, source) in [
        ("ESCARGOT", "recorded from a person"),
        ("LIMACE", "generated from recorded movement"),
        ("ECAMIL", "generated from recorded movement"),
        ("NOTED", "generated from notation"),
        ("DETON", "generated from notation"),
        ("SLOW", "generated from recorded movement"),
        ("NODDED", "generated from recorded movement"),
        ("OR", "generated by a program"),
    ] {
        let page = &all[&format!("sign/{gloss}/index.html")];
        let page = String::from_utf8_lossy(page);
        assert!(page.contains(source), "{gloss}: {page}");
    }
}

#[test]
fn pages_work_without_a_script_and_ask_no_other_computer() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    consented(&mut corpus, "signer:Ada", ConsentAudience::Public);
    let to = folder.path().join("site");
    publish(&mut corpus, &to, Some("CC0")).expect("published");
    let all = files(&to);
    let text = |name: &str| String::from_utf8(all[name].clone()).expect("text");
    let page = text("sign/LIMACE/index.html");
    for part in [
        "<h1>LIMACE</h1>",
        "src=\"still.png\"",
        "lang=\"fr\">limace</li>",
        "CC BY 4.0",
        "Movement generated from recorded movement",
        "../ESCARGOT/index.html",
        "Signs &amp; &lt;/script&gt; \"@@GLOSS@@\"",
    ] {
        assert!(page.contains(part), "{part}\n{page}");
    }
    assert!(text("list.html").contains("sign/ESCARGOT/index.html"));
    assert!(text("LICENCES.txt").contains("\nCC BY 4.0: 3 signs · 3 signes\n"));
    for (name, bytes) in &all {
        let text = String::from_utf8_lossy(bytes);
        if name.ends_with(".html") {
            assert!(text.contains("Content-Security-Policy") && text.contains("connect-src 'none'"));
        }
        if !name.ends_with(".png") {
            let own = text.replace("http://www.w3.org/2000/svg", "");
            assert!(!own.contains("http:") && !own.contains("https:"), "{name}");
        }
        // Every link and file of a page is there.
        if name.ends_with(".html") {
            for piece in text.split("\"").skip(1).step_by(2) {
                let wanted = piece.split('#').next().unwrap_or_default();
                if wanted.ends_with(".html") || wanted.ends_with(".png") || wanted.ends_with(".js") {
                    let path = to.join(name).with_file_name("").join(decoded(wanted));
                    assert!(path.exists(), "{name}: {wanted}");
                }
            }
        }
    }
}

#[test]
fn words_and_sentences_of_tiers_stand_on_the_pages() {
    let folder = tempfile::tempdir().expect("a folder");
    let sentence = "<TIER LINGUISTIC_TYPE_REF=\"gloss\" PARTICIPANT=\"Anna\" TIER_ID=\"Translation EN\"><ANNOTATION>\
        <ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a30\" TIME_SLOT_REF1=\"ts1\" TIME_SLOT_REF2=\"ts6\">\
        <ANNOTATION_VALUE>A star in a bowl.</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>";
    let text = include_str!("../export/tests.eaf");
    let (tiers, types) = text.split_once("    <LINGUISTIC_TYPE ").expect("types");
    let file = folder.path().join("take.eaf");
    fs::write(&file, format!("{tiers}{sentence}<LINGUISTIC_TYPE {types}")).expect("written");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("created");
    let progress = &mut ignore_progress_step;
    let options = crate::ImportOptions::default();
    corpus
        .import_paths(&[file], &options, &mut ProgressReceiver::new(progress))
        .expect("imported");
    consented(&mut corpus, "signer:Anna", ConsentAudience::Public);
    let to = folder.path().join("site");
    publish(&mut corpus, &to, Some("CC0")).expect("published");
    let all = files(&to);
    let page = |gloss: &str| {
        let name = format!("sign/{gloss}/index.html");
        String::from_utf8(all[&name].clone()).expect("text")
    };
    let star = page("ÉTOILE");
    let (words, form) = star.split_once("</ul>").expect("words");
    assert!(words.contains("<li lang=\"fr\">une étoile</li>"), "{words}");
    assert!(!words.contains("A star in a bowl."), "a sentence is no word: {words}");
    assert!(form.contains(">A star in a bowl.</li>"), "{form}");
    let bowl = page("BOL");
    assert!(
        bowl.contains(">A star in a bowl.</li>") && !bowl.contains("une étoile"),
        "{bowl}"
    );
}

#[test]
fn a_notated_sign_moves_by_its_notation_and_its_page_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("signs.tsv");
    let notation = "hamflathand hamextfingeru hampalml hamchin hamtouch";
    fs::write(&table, format!("Gloss\tHamNoSys\nTHANKS\t{notation}\nPLAIN\t\n")).expect("written");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("created");
    let progress = &mut ignore_progress_step;
    let options = crate::ImportOptions::default();
    corpus
        .import_paths(&[table], &options, &mut ProgressReceiver::new(progress))
        .expect("imported");
    let to = folder.path().join("site");
    let done = publish(&mut corpus, &to, Some("CC0")).expect("published");
    assert_eq!((done.signs, done.moving, done.animated), (2, 1, 1));
    assert!(done.unanimated.is_empty());
    let all = files(&to);
    let page = |all: &BTreeMap<String, Vec<u8>>, gloss: &str| {
        String::from_utf8(all[&format!("sign/{gloss}/index.html")].clone()).expect("text")
    };
    assert!(page(&all, "THANKS").contains("Movement generated from notation"));
    assert!(all.contains_key("data/motion/THANKS.js") && page(&all, "PLAIN").contains("Without movement"));
    let recordings = crate::db::stored_recordings::load_recording_rows(corpus.store.read_connection());
    assert!(recordings.expect("read").is_empty(), "nothing is stored");
    let still = PublishOptions {
        terms: Some("CC0".into()),
        without_animation: true,
        ..PublishOptions::default()
    };
    let done = corpus.publish_dictionary(&to, &still, &mut ProgressReceiver::new(&mut ignore_progress_step));
    assert_eq!(done.expect("published").moving, 0);
    assert!(page(&files(&to), "THANKS").contains("Without movement"));
}

#[test]
fn a_long_list_of_signs_has_a_page_for_each_letter() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("signs.tsv");
    let rows: String = (0..402)
        .map(|at| format!("{}{at}\tB\n", ["É", "a", "Z", "(e) "][at % 4]))
        .collect();
    fs::write(&table, format!("Gloss\tHandshape strong\n{rows}")).expect("written");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("created");
    let progress = &mut ignore_progress_step;
    let options = crate::ImportOptions::default();
    corpus
        .import_paths(&[table], &options, &mut ProgressReceiver::new(progress))
        .expect("imported");
    let to = folder.path().join("site");
    publish(&mut corpus, &to, Some("CC0")).expect("published");
    let all = files(&to);
    let lists = ["list.html", "list-2.html", "list-3.html"].map(|name| String::from_utf8_lossy(&all[name]));
    assert_eq!(
        lists.each_ref().map(|page| page.matches("<li>").count()),
        [101, 201, 100]
    );
    for page in &lists {
        assert!(
            page.contains("<a href=\"list.html#l0\">A</a> <a href=\"list-2.html#l1\">E</a>"),
            "{page}"
        );
    }
}

#[test]
fn words_of_others_are_text_and_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("signs.tsv");
    let glosses = [
        "<script>alert(1)</script>",
        "' onload='x' \u{202e}",
        "..",
        "CON",
        "__proto__",
        "@@TERMS@@",
        &"L".repeat(3000),
    ];
    let rows = glosses.map(|it| format!("{it}\t</script><img src=x>\t1\tB\n"));
    let head = "NL gloss\tEN gloss\tHandedness\tHandshape strong\n";
    fs::write(&table, format!("{head}{}", rows.concat())).expect("written");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("created");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let options = crate::ImportOptions::default();
    corpus.import_paths(&[table], &options, progress).expect("imported");
    let to = folder.path().join("site");
    let done = publish(&mut corpus, &to, Some("<b>\"T\"")).expect("published");
    assert_eq!(done.signs, glosses.len());
    let all = files(&to);
    let pages = all.iter().filter(|(name, _)| name.ends_with(".html"));
    for (name, bytes) in pages {
        let text = String::from_utf8_lossy(bytes);
        let scripts = text.matches("<script").count();
        assert_eq!(scripts, text.matches("<script defer src=").count(), "{name}");
        assert!(!text.contains("<img src=x") && !text.contains("<b>"), "{name}");
        assert_eq!(text.matches("</script>").count(), scripts, "{name}");
    }
    let signs = all.keys().filter(|it| it.starts_with("sign/"));
    assert_eq!(signs.count(), glosses.len());
    assert!(all.keys().all(|it| it.len() < 120 && !it.contains("..")));
}

/// Returns a page as a browser has it after its scripts ran; nothing if there is no browser.
fn in_browser(address: &str) -> Option<String> {
    let out = tempfile::NamedTempFile::new().expect("a file");
    let mut browser = std::process::Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"])
        .args(["--virtual-time-budget=4000", address])
        .stdout(out.reopen().expect("opened"))
        .stderr(std::process::Stdio::null())
        .spawn()
        .ok()?;
    for _ in 0..600 {
        if browser.try_wait().expect("a child").is_some() {
            return fs::read_to_string(out.path()).ok();
        }
        std::thread::sleep(std::time::Duration::from_millis(200));
    }
    // A browser that hangs says nothing about the page.
    drop(browser.kill());
    drop(browser.wait());
    None
}

#[test]
fn a_browser_searches_and_plays_from_the_disk() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    consented(&mut corpus, "signer:Ada", ConsentAudience::Public);
    let to = folder.path().join("site");
    publish(&mut corpus, &to, Some("CC0")).expect("published");
    let address = |page: &str| format!("file://{}/{page}", to.display());
    let Some(page) = in_browser(&address("index.html#lang=fr&h=U")) else {
        println!("skipped: there is no chromium");
        return;
    };
    let (exact, near) = page.split_once("id=\"near\"").expect("both lists");
    let exact = exact.split_once("id=\"exact\"").expect("a list").1;
    assert!(exact.contains("<b>LIMACE</b>") && !exact.contains("<b>ESCARGOT</b>"));
    assert!(!near.contains("<b>LIMACE</b>"));
    assert!(page.contains("Configuration") && page.contains("data-lang=\"fr\""));
    let page = in_browser(&address("index.html#lang=en&moving=seen")).expect("a page");
    assert!(page.contains("data-drawn=\""), "cards move: {page}");
    let page = in_browser(&address("index.html#lang=en&q=SLUG&h=Y")).expect("a page");
    let near = page.split_once("id=\"near\"").expect("a list").1;
    assert!(page.contains("No sign is exactly so."));
    assert!(
        !near.contains("<b>ESCARGOT</b>"),
        "a text that does not fit is no near miss"
    );
    let page = in_browser(&address("sign/LIMACE/index.html#lang=en")).expect("a page");
    let plays = page.contains("aria-label=\"movement of LIMACE\"") && page.contains("Camera: front");
    assert!(plays, "{page}");
    assert!(page.contains(">Side by side</button>"), "{page}");
}
