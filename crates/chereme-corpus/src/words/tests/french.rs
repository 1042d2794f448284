//! Tests that no English word is left in the French of real messages.

use std::path::{Path, PathBuf};

use super::{InterfaceLanguage, localized_message};
use crate::{
    AnnotateOptions, Corpus, CorpusError, ExportOptions, ExportWhat, ImportOptions, ProgressReceiver, RowName,
    ignore_progress_step,
};

/// Common English words that are no French ones.
const ENGLISH: [&str; 54] = [
    "the", "of", "and", "with", "is", "are", "was", "were", "has", "have", "from", "to", "at", "not", "it", "its",
    "by", "be", "this", "that", "which", "there", "must", "first", "next", "other", "more", "only", "each", "rows",
    "row", "line", "lines", "name", "names", "time", "times", "file", "files", "between", "below", "above", "left",
    "out", "read", "written", "kept", "column", "columns", "later", "nothing", "lasts", "write", "known",
];

/// Returns the English words of a French text, apart from words in quotation marks, commands, options, names of files
/// and addresses.
fn english(text: &str) -> Vec<String> {
    let own = |text: &str, mark: char| {
        let parts = text.split(mark).step_by(2);
        parts.collect::<Vec<_>>().join(" ")
    };
    let text = own(&own(&text.replace("\\\"", ""), '`'), '"');
    let is_name = |word: &&str| word.contains(['/', '.', ':', '=', '<', '_', '-']);
    let words = text.split_whitespace().filter(|it| !is_name(it));
    let letters = words.flat_map(|it| it.split(|c: char| !c.is_alphabetic()));
    letters.filter(|it| ENGLISH.contains(it)).map(str::to_owned).collect()
}

/// Collects messages, and those that keep English words.
#[derive(Default)]
struct Heard {
    count: usize,
    faults: Vec<String>,
}

impl Heard {
    fn say(&mut self, text: &str) -> String {
        self.count += 1;
        let said = localized_message(text, InterfaceLanguage::French).unwrap_or_else(|| text.to_owned());
        let left = english(&said);
        if !left.is_empty() {
            self.faults.push(format!("{text}\n  {said}\n  {left:?}"));
        }
        said
    }

    fn error(&mut self, error: &CorpusError) {
        if let CorpusError::Several { errors, .. } = error {
            let said = error.spoken_error_message(InterfaceLanguage::French, &|text| {
                localized_message(text, InterfaceLanguage::French).unwrap_or_else(|| text.to_owned())
            });
            let left = english(&said);
            if !left.is_empty() {
                self.faults.push(format!("{error}\n  {said}\n  {left:?}"));
            }
            errors.iter().for_each(|it| self.error(it));
            return;
        }
        self.say(&error.to_string());
        error.error_place().iter().for_each(|it| drop(self.say(it)));
        if let Some(remedy) = error.error_remedy() {
            self.say(remedy.remedy_text());
        }
    }

    /// Imports files, and hears the report.
    fn import(&mut self, corpus: &mut Corpus, files: &[PathBuf]) {
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        let report = corpus.import_paths(files, &ImportOptions::default(), progress);
        let report = match report {
            Ok(report) => report,
            Err(error) => return self.error(&error),
        };
        for finding in report.files.iter().flat_map(|it| &it.findings) {
            self.say(&finding.message);
            if let Some(remedy) = &finding.remedy {
                self.say(remedy.remedy_text());
            }
        }
    }
}

/// Files with something odd in each.
const ODD: [(&str, &str); 10] = [
    (
        "lexicon.csv",
        "gloss,Handshape,Handshape,Place\nCHAT,B,5,chin\nCHAT,B\n,5,,\n",
    ),
    ("lexicon2.tsv", "gloss\tHandshape\tFrequency\nA\tB (\t1,234\nB\t?\tx\n"),
    (
        "face.csv",
        "Timecode,BlendShapeCount,JawOpen\n00:00:00:00.0,61,0.25\n00:00:09:01.0,0,\n",
    ),
    ("frames.csv", "frame,JawOpen,BrowInnerUp\n0,1,2\n"),
    ("wide.csv", "time_s,a,b\n0,1,2\n1,2\n"),
    (
        "a.srt",
        "1\n00:00:01,000 --> 00:00:03,000\na\n\n2\n00:00:02,000 --> 00:00:04,000\nb\n\nx --> y\n",
    ),
    ("b.vtt", "WEBVTT\n\nNOTE a\n\n00:01.000 --> 00:02.000 align:start\na\n"),
    (
        "c.TextGrid",
        "\"ooTextFile\" \"TextGrid\" 0 2 <exists> 2 \"IntervalTier\" \"G\" 0 2 2 0 1.25 \"A\" 1 2 \"B\" \"IntervalTier\" \"G\" 0 2 1 0 2 \"\"",
    ),
    (
        "e.trc",
        "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n100\t100\t9\t9\tell\nFrame#\tTime\tA\n\t\tX1\tY1\tZ1\n\n1\t0.00\t1\t9\t3\n2\t0.01\t0\t0\t0\n",
    ),
    ("g.docx", "x"),
];

#[test]
fn no_english_word_is_left_in_the_french_of_real_messages() {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    let folder = tempfile::tempdir().expect("a folder");
    let mut heard = Heard::default();
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
    let starter = ["bol.bvh", "bol.eaf"].map(|it| own.join(it));
    heard.import(&mut corpus, &starter);
    for (name, text) in ODD {
        let file = folder.path().join(name);
        std::fs::write(&file, text).expect("written");
        heard.import(&mut corpus, &[file]);
    }
    if let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") {
        let data = Path::new(&data);
        let folders = ["annotation/textgrid", "phonology"].map(|it| data.join(it));
        heard.import(&mut corpus, &folders);
    }
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    // The table of a recording, read as changes of the same recording: nearly every row is refused.
    let mut table = Vec::new();
    let bol = || "recording:bol".parse().expect("an address");
    let what = ExportWhat::Address(bol());
    let notes = corpus.export_stream(&what, "elan.txt", &mut table, progress);
    notes.expect("written").iter().for_each(|it| drop(heard.say(it)));
    let bol_name = RowName::Text("bol".to_owned());
    let refused = corpus.annotate_table(
        &table,
        "a.elan.txt",
        Some(&bol_name),
        &AnnotateOptions::default(),
        progress,
    );
    heard.error(&refused.expect_err("the recording has these annotations"));
    for format in [
        "csv",
        "trc",
        "markers.csv",
        "curves.csv",
        "srt",
        "vrma",
        "TextGrid",
        "sigml",
    ] {
        let options = ExportOptions {
            format: Some(format.to_owned()),
            ..ExportOptions::default()
        };
        let to = folder.path().join(format.replace('.', "-"));
        match corpus.export_corpus(&ExportWhat::All, &to, &options, progress) {
            Ok(report) => {
                let why = report.left_out.iter().map(|it| &it.why);
                why.chain(&report.notes).for_each(|it| drop(heard.say(it)));
            }
            Err(error) => heard.error(&error),
        }
    }
    assert!(heard.count > 40, "{} messages are heard", heard.count);
    let count = heard.faults.len();
    assert!(count == 0, "{count}\n{}", heard.faults.join("\n"));
}
