//! Tests of faces from capture files to milestones, scores and choices.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::{BodyPart, RecordingInstant};
use chereme_sign::TierRole;
use chereme_sign::milestones::ExpressionFunction;

use super::{ChooseOptions, MilestoneOptions, RankingCriterion, touched};
use crate::address::{CorpusAddress, RowName};
use crate::annotate::{AnnotateOptions, AnnotationAction, AnnotationName, NewTier, TierRequestName};
use crate::{Corpus, ImportOptions, ProgressReceiver, ignore_progress_step};

/// The signs of a sentence in milliseconds: one before the question, three in it.
const SIGNS: [(&str, i64, i64); 4] = [
    ("HIER", 200, 600),
    ("ANNA", 700, 1100),
    ("AIMER", 1200, 1600),
    ("QUOI", 1700, 2300),
];

/// Writes a capture in the program's own numbers at 60 frames per second: brows that rise to `most` in the question,
/// times stretched by `slow`, a head that nods by the same amount, and a jaw curve that no other capture has.
fn write_face(path: &Path, most: f64, slow: f64, jaw: usize) {
    let mut text =
        String::from("time [s],brow_raise_right,brow_raise_left,brow_squeeze,jaw_open,head_pitch,head_yaw,head_roll\n");
    for frame in 0..(180.0 * slow) as usize {
        let seconds = frame as f64 / 60.0;
        let at = seconds / slow;
        let share = ((at - 0.6) / 0.1).min((2.6 - at) / 0.3).clamp(0.0, 1.0);
        let up = most * share;
        writeln!(text, "{seconds:.6},{up:.6},{up:.6},0,0.{jaw},{:.6},0,0", 0.2 * up).expect("text");
    }
    std::fs::write(path, text).expect("written");
}

struct Case {
    _folder: tempfile::TempDir,
    corpus: Corpus,
}

fn add(corpus: &mut Corpus, recording: &str, tier: &str, role: TierRole, spans: &[(&str, i64, i64)]) {
    let name = RowName::Text(recording.to_owned());
    corpus
        .add_tier(&NewTier::new(name.clone(), tier, role))
        .expect("a tier");
    let time = |millis| Some(TableMoment::Time(RecordingInstant::from_millis(millis)));
    let changes: Vec<_> = spans
        .iter()
        .map(|(value, start, end)| {
            AnnotationAction::Add {
                tier: TierRequestName::Of {
                    recording: name.clone(),
                    tier: tier.to_owned(),
                },
                start: time(*start),
                end: time(*end),
                parent: None,
                order: None,
                value: (*value).to_owned(),
                confidence: None,
            }
            .into()
        })
        .collect();
    let options = AnnotateOptions::default();
    corpus
        .annotate_corpus(
            &changes,
            &options,
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )
        .expect("annotated");
}

/// Returns a corpus of wh-questions, given by name, height of the brows and slowness.
fn case(sentences: &[(&str, f64, f64)]) -> Case {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
    for (jaw, (name, most, slow)) in sentences.iter().enumerate() {
        let path = folder.path().join(format!("{name}.csv"));
        write_face(&path, *most, *slow, jaw);
        let options = ImportOptions::default();
        corpus
            .import_paths(&[path], &options, &mut ProgressReceiver::new(&mut ignore_progress_step))
            .expect("imported");
        let at = |millis: i64| (millis as f64 * slow) as i64;
        let signs = SIGNS.map(|(gloss, start, end)| (gloss, at(start), at(end)));
        add(&mut corpus, name, "gloss", TierRole::Gloss, &signs);
        add(
            &mut corpus,
            name,
            "function",
            TierRole::Free,
            &[("wh-question", at(700), at(2300))],
        );
    }
    Case {
        _folder: folder,
        corpus,
    }
}

fn recording(name: &str) -> CorpusAddress {
    CorpusAddress::Recording(RowName::Text(name.to_owned()))
}

fn choose(case: &Case, target: &str, options: &ChooseOptions) -> super::PerformanceChoice {
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let found = case.corpus.choose_performances(
        &ExpressionFunction::from_function_name("wh"),
        &recording(target),
        options,
        progress,
    );
    found.unwrap_or_else(|error| panic!("{target}: {error}"))
}

fn names(choice: &super::PerformanceChoice) -> Vec<&str> {
    choice.ranking.iter().map(|it| it.recording.as_str()).collect()
}

#[test]
fn a_face_alone_moves_the_programs_own_body() {
    let case = case(&[("W1", 1.0, 1.0)]);
    let moving = case.corpus.movement_at_address(&recording("W1")).expect("movement");
    assert_eq!((moving.clip.clip_frame_count(), moving.faces.len()), (180, 180));
    let frame = |seconds: f64| (seconds * 60.0) as usize;
    assert_eq!(moving.faces[frame(0.3)].brows, [0.0, 0.0]);
    assert!(moving.faces[frame(1.5)].brows[0] > 0.99);
    let head = moving.anatomy.part_joint(BodyPart::Head).expect("a head");
    let turned = |seconds| moving.clip.model_pose(frame(seconds)).model_joint_rotation(head);
    let angle = turned(0.3).angle_between(turned(1.5));
    assert!((angle - 0.2).abs() < 1e-6, "{angle}");
    let overview = case.corpus.load_corpus_overview(0).expect("an overview");
    let shown = overview.recordings[0].shown_frames().expect("what is shown");
    assert_eq!((shown.frames, overview.recordings[0].frames), (180, 0));
    let report = case.corpus.report_captured_face(&recording("W1")).expect("a face");
    assert_eq!((report.system.as_str(), report.frames), ("house", 180));
    assert!(report.numbers.iter().any(|it| it.name == "eye_close_left" && !it.known));
    assert!(case.corpus.report_captured_face(&recording("W2")).is_err());
}

#[test]
fn milestones_become_a_tier_and_corrections_are_kept() {
    let mut case = case(&[("W1", 1.0, 1.0)]);
    let options = MilestoneOptions {
        function: Some(ExpressionFunction::from_function_name("wh")),
        ..MilestoneOptions::default()
    };
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let dry = MilestoneOptions {
        dry_run: true,
        ..options.clone()
    };
    let found = case.corpus.derive_face_milestones(&dry, progress).expect("found");
    assert_eq!((found.written, found.expressions.len()), (0, 1));
    assert_eq!(
        found.expressions[0].milestones.to_string(),
        "0.600s 0.700s 1.700s 2.300s 2.800s"
    );
    assert_eq!(found.expressions[0].signs, ["ANNA", "AIMER", "QUOI"]);
    let written = case.corpus.derive_face_milestones(&options, progress).expect("written");
    assert_eq!((written.written, written.kept), (4, 0));
    let again = case
        .corpus
        .derive_face_milestones(&options, progress)
        .expect("written again");
    assert_eq!((again.written, again.expressions.len()), (4, 1), "its own are replaced");

    let connection = case.corpus.store.read_connection();
    let id = crate::db::stored_recordings::recording_named(connection, "W1")
        .expect("read")
        .expect("there")
        .id;
    let tiers = crate::db::stored_tiers::load_tier_rows(connection, id).expect("read");
    let tier = tiers.iter().find(|tier| tier.name == "milestones wh").expect("a tier");
    let rows = crate::db::stored_tiers::load_tier_annotation_rows(connection, tier.id).expect("read");
    let said: Vec<&str> = rows.iter().map(|row| row.value.as_str()).collect();
    assert_eq!(said, ["M1-M2", "M2-M3", "M3-M4", "M4-M5"]);
    let onset = AnnotationAction::Set {
        annotation: AnnotationName::Number(rows[0].id),
        start: Some(TableMoment::Time(RecordingInstant::from_millis(500))),
        end: None,
        value: None,
    };
    let corrected = case
        .corpus
        .annotate_corpus(&[onset.into()], &AnnotateOptions::default(), progress);
    corrected.expect("corrected");
    let kept = case.corpus.derive_face_milestones(&options, progress).expect("kept");
    assert_eq!((kept.written, kept.kept), (0, 1));
    assert_eq!(
        kept.expressions[0].milestones.to_string(),
        "0.500s 0.700s 1.700s 2.300s 2.800s"
    );
}

#[test]
fn an_end_outside_of_the_recording_is_kept_in_the_value() {
    let mut case = case(&[("W1", 1.0, 1.0)]);
    add(
        &mut case.corpus,
        "W1",
        "construction",
        TierRole::Free,
        &[("topic", 150, 650)],
    );
    let options = MilestoneOptions {
        function: Some(ExpressionFunction::from_function_name("topic")),
        ..MilestoneOptions::default()
    };
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    for _ in 0..2 {
        let found = case.corpus.derive_face_milestones(&options, progress).expect("written");
        assert_eq!(
            found.expressions[0].milestones.to_string(),
            "-0.300s 0.200s - 0.600s 0.700s"
        );
        assert!(found.expressions[0].findings[0].contains("0.300 s before"), "{found:?}");
    }
    let choice = ChooseOptions::default();
    let other = case.corpus.choose_performances(
        &ExpressionFunction::from_function_name("topic"),
        &recording("W1"),
        &choice,
        progress,
    );
    assert!(
        other
            .expect_err("it is alone")
            .to_string()
            .contains("no other recording")
    );
}

#[test]
fn performances_are_ranked_by_score_and_a_recording_is_never_its_own_candidate() {
    let case = case(&[("W1", 1.0, 1.0), ("W2", 0.2, 1.0), ("W3", 0.9, 1.3), ("W4", 0.6, 0.9)]);
    let near = choose(&case, "W1", &ChooseOptions::default());
    assert_eq!(names(&near), ["W3", "W4", "W2"]);
    assert_eq!((near.rank, near.compared), (RankingCriterion::Nearest, 3));
    assert!(near.ranking.windows(2).all(|pair| pair[0].score < pair[1].score));
    let explained = &near.ranking[2].parts;
    assert!(explained.channels[0].name.starts_with("brow_raise"), "{explained:?}");
    assert!(
        explained
            .phases
            .iter()
            .all(|phase| phase.channels.len() == near.channels.len())
    );
    assert_eq!(near.channels.len(), 6);
    let far = ChooseOptions {
        rank: RankingCriterion::Farthest,
        limit: 1,
        ..ChooseOptions::default()
    };
    assert_eq!(names(&choose(&case, "W1", &far)), ["W2"]);
    let usual = ChooseOptions {
        rank: RankingCriterion::Medoid,
        ..ChooseOptions::default()
    };
    let usual = choose(&case, "W1", &usual);
    assert_eq!((names(&usual)[0], usual.references), ("W4", 3), "the one in the middle");
    let one = ChooseOptions {
        channels: vec!["head".into()],
        ..ChooseOptions::default()
    };
    assert_eq!(choose(&case, "W1", &one).channels.len(), 3);
    let odd = ChooseOptions {
        channels: vec!["ears".into()],
        ..ChooseOptions::default()
    };
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    assert!(
        case.corpus
            .choose_performances(
                &ExpressionFunction::from_function_name("wh"),
                &recording("W1"),
                &odd,
                progress
            )
            .is_err()
    );
}

#[test]
fn after_a_change_only_the_recordings_that_it_touched_are_read_again() {
    let mut case = case(&[("W1", 1.0, 1.0), ("W2", 0.5, 1.2), ("W3", 0.8, 0.9)]);
    let options = ChooseOptions::default();
    let first = choose(&case, "W1", &options);
    let id = |name: &str| {
        let all = first.ranking.iter();
        let mut own = all.filter(|it| it.recording == name);
        own.next().expect("ranked").recording_id
    };
    let (second, third) = (id("W2"), id("W3"));
    let since = |case: &Case, operation: i64| {
        touched::recordings_since(case.corpus.store.read_connection(), operation).expect("read")
    };
    let newest = |case: &Case| {
        let newest = crate::db::stored_history::find_newest_operation(case.corpus.store.read_connection());
        newest.expect("read").expect("an operation")
    };

    let before = newest(&case);
    assert_eq!(since(&case, before), Some(BTreeSet::new()));
    let question = [("wh-question", 2400, 3000)];
    add(&mut case.corpus, "W2", "construction", TierRole::Free, &question);
    assert_eq!(since(&case, before), Some(BTreeSet::from([second])));
    let kept = choose(&case, "W1", &options);
    assert_eq!(kept.compared, first.compared + 1, "the new one is there");
    case.corpus.faces.take();
    assert_eq!(kept, choose(&case, "W1", &options), "as read from scratch");

    case.corpus.undo_operation().expect("undone");
    assert_eq!(choose(&case, "W1", &options), first);
    let before = newest(&case);
    let choice = choose(&case, "W1", &options);
    let best = choice.ranking[0].token.clone();
    let made = case.corpus.animate_choice(&choice, &best, "ASKED");
    let made = made.expect("animated").recording.expect("a recording");
    assert_eq!(since(&case, before), Some(BTreeSet::from([made])));

    case.corpus.undo_operation().expect("undone");
    let before = newest(&case);
    let gone = [recording("W3")];
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let options = crate::DeleteOptions::default();
    let deleted = case.corpus.delete_objects(&gone, options, progress);
    deleted.expect("deleted");
    let touched = since(&case, before).expect("few changes");
    assert!(touched.contains(&third), "{touched:?}");
    let kept = choose(&case, "W1", &ChooseOptions::default());
    case.corpus.faces.take();
    assert_eq!(kept, choose(&case, "W1", &ChooseOptions::default()));
    assert_eq!(since(&case, 1_000_000), None, "no such operation");
}

#[test]
fn equal_scores_are_ordered_by_name_and_strict_lengths_are_refused_by_name() {
    let case = case(&[
        ("W1", 1.0, 1.0),
        ("Z", 0.5, 1.0),
        ("B", 0.5, 1.0),
        ("M", 0.5, 1.0),
        ("SLOW", 0.5, 2.0),
    ]);
    let found = choose(&case, "W1", &ChooseOptions::default());
    // The ratio of lengths favours compressed performances, so SLOW may come first.
    let mut order = names(&found);
    order.retain(|name| *name != "SLOW");
    assert_eq!(order, ["B", "M", "Z"]);
    let strict = ChooseOptions {
        no_path: chereme_analysis::phases::NoPath::Refuse,
        ..ChooseOptions::default()
    };
    let strict = choose(&case, "W1", &strict);
    assert_eq!((strict.compared, strict.skipped.len()), (3, 1));
    assert!(strict.skipped[0].1.starts_with("onset"), "{:?}", strict.skipped);
}

#[test]
fn a_face_scores_zero_with_itself_and_scores_agree_with_the_ranking() {
    let case = case(&[("W1", 1.0, 1.0), ("W2", 0.2, 1.0), ("W3", 0.9, 1.3)]);
    let options = ChooseOptions::default();
    let of = |a: &str, b: &str| {
        let both = [&recording(a), &recording(b)];
        case.corpus.score_faces(both, None, &options).expect("scored")
    };
    assert_eq!(of("W1", "W1").stretched, 0.0);
    let ranked = choose(&case, "W1", &options);
    for it in &ranked.ranking {
        assert!((of("W1", &it.recording).stretched - it.score).abs() < 1e-9);
    }
}

#[test]
fn the_sentence_moves_with_the_chosen_face_and_its_milestones_land_within_a_frame() {
    let mut case = case(&[("W1", 0.1, 1.0), ("W2", 1.0, 1.6)]);
    let choice = choose(&case, "W1", &ChooseOptions::default());
    let token = choice.ranking[0].token.clone();
    let made = case
        .corpus
        .animate_choice(&choice, &token, "QUOI-VISAGE")
        .expect("animated");
    assert_eq!(made.faces.len(), made.clip.clip_frame_count());
    let brows = |seconds: f64| {
        made.faces[made
            .clip
            .clip_frame_rate()
            .nearest_frame_at(RecordingInstant::from_seconds(seconds))]
        .brows[0]
    };
    assert!(
        brows(0.7) > 0.9 && brows(1.5) > 0.9 && brows(2.2) > 0.9,
        "{}",
        brows(0.7)
    );
    assert!(brows(0.5) < 0.11, "outside it is its own: {}", brows(0.5));
    let stored = case
        .corpus
        .movement_at_address(&CorpusAddress::Gloss("QUOI-VISAGE".into()))
        .expect("stored");
    assert!((stored.faces[90].brows[0] - made.faces[90].brows[0]).abs() < 1e-5);
    case.corpus.undo_operation().expect("undone");
}

#[test]
fn a_sentence_without_a_face_gets_the_most_usual_one() {
    let mut case = case(&[("W1", 1.0, 1.0), ("W2", 0.2, 1.0), ("W3", 0.5, 1.0)]);
    let path = case._folder.path().join("plain.csv");
    std::fs::write(&path, "time [s],force\n0,1\n3,1\n").expect("written");
    let options = ImportOptions::default();
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    case.corpus.import_paths(&[path], &options, progress).expect("imported");
    add(&mut case.corpus, "plain", "gloss", TierRole::Gloss, &SIGNS);
    let found = choose(&case, "plain", &ChooseOptions::default());
    assert_eq!((found.rank, names(&found)[0]), (RankingCriterion::Medoid, "W3"));
    assert_eq!(found.milestones.to_string(), "-0.300s 0.200s 1.700s 2.300s 2.800s");
}

#[test]
fn curves_are_searched_while_a_token_lasts() {
    let mut case = case(&[("W1", 1.0, 1.0), ("W2", 0.2, 1.0)]);
    let mut found = |query: &str| -> Vec<String> {
        let answer = case.corpus.search_tokens(query, &crate::SearchOptions::default());
        let answer = answer.unwrap_or_else(|error| panic!("{query}: {error}"));
        let mut names: Vec<String> = answer
            .hits
            .iter()
            .map(|hit| format!("{} {}", hit.recording.clone().unwrap_or_default(), hit.gloss))
            .collect();
        names.sort();
        names
    };
    assert_eq!(found("nonmanual.brows>0.5"), ["W1 AIMER", "W1 ANNA", "W1 QUOI"]);
    assert_eq!(found("nonmanual.brows>0.5 for 0.3s gloss=QUOI"), ["W1 QUOI"]);
    assert_eq!(
        found("nonmanual.brows>0.5 for 0.3s overlaps gloss=QUOI"),
        ["W1 QUOI"],
        "the stretch of the curve overlaps the sign"
    );
    assert_eq!(found("gloss=QUOI overlaps gloss=QUOI"), [""; 0]);
    assert_eq!(found("nonmanual.brows>0.5 for 3s"), [""; 0]);
    assert_eq!(found("nonmanual.brows=0.1..0.3 gloss=QUOI"), ["W2 QUOI"]);
    assert_eq!(found("nonmanual.head_pitch>8 gloss=ANNA"), ["W1 ANNA"]);
    assert_eq!(found("not nonmanual.brows>0.05 recording=W1"), ["W1 HIER"]);
    let error = case
        .corpus
        .search_tokens("nonmanual.ears>1", &crate::SearchOptions::default());
    assert!(error.expect_err("no such curve").to_string().contains("no curve"));
}

#[test]
fn proposals_are_written_as_tiers_in_one_operation_and_replace_earlier_ones() {
    // The brows are low for most of the take, so they are raised relative to their median at both of its ends.
    let mut case = case(&[("W1", -1.0, 1.0)]);
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let mut propose = |store: bool| {
        let found = case.corpus.propose_nonmanuals(&recording("W1"), store, progress);
        found.expect("found")
    };
    let found = propose(false);
    let brows: Vec<&str> = found.proposals.iter().map(|it| &*it.value).collect();
    assert_eq!(brows, ["raised", "raised"], "{found:?}");
    assert!(found.proposals[0].start_us < 100_000 && found.proposals[0].end_us < 800_000);
    assert_eq!(found.written, 0);
    assert_eq!([propose(true).written, propose(true).written], [2, 2]);
    let log = case.corpus.operation_log(2).expect("a log");
    assert_eq!([&*log[0].name, &*log[1].name], ["propose"; 2], "{log:?}");
}

#[test]
fn onsets_are_measured_against_the_signs() {
    let case = case(&[("W1", 1.0, 1.0), ("W2", 0.8, 1.2), ("W3", 0.9, 0.9)]);
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let found = case
        .corpus
        .measure_nonmanual_onsets(Some(&ExpressionFunction::from_function_name("wh")), progress)
        .expect("measured");
    let row = found
        .rows
        .iter()
        .find(|row| row.channel == "brow_raise_right")
        .expect("brows");
    assert_eq!((row.n, found.without_face), (3, 0));
    // The brows are half raised at 0.65 s instead of 0.7 s, and half lowered at 2.45 s instead of 2.3 s.
    assert!((row.onset_s.median + 0.05).abs() < 0.02, "{row:?}");
    let offset = row.offset_s.expect("an end");
    assert!((offset.median - 0.15).abs() < 0.02, "{row:?}");
    assert_eq!((row.ends, found.with_gaps, found.too_long), (3, 0, 0));
    assert!(found.rows.iter().any(|row| row.channel == "head_pitch"));
    assert!(
        case.corpus
            .measure_nonmanual_onsets(Some(&ExpressionFunction::from_function_name("topic")), progress)
            .is_err()
    );
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("onsets.svg");
    case.corpus.draw_onsets(&found, &path, false).expect("drawn");
    let text = std::fs::read_to_string(&path).expect("read");
    assert!(text.starts_with("<svg") && text.contains("wh: brow_raise_right (n = 3)"));
    assert!(
        case.corpus.draw_onsets(&found, &path, false).is_err(),
        "it is there already"
    );
    let path = folder.path().join("onsets.png");
    let error = case.corpus.draw_onsets(&found, &path, false);
    let error = error.expect_err("another kind of picture");
    assert!(error.to_string().contains(".svg"), "{error}");
    assert!(!path.exists(), "nothing is written");
}

#[test]
fn expressions_that_are_too_long_or_not_measured_are_skipped_by_name_and_ends_are_counted() {
    let mut case = case(&[("W1", 1.0, 1.0), ("W2", 0.8, 1.2)]);
    let folder = case._folder.path().to_owned();
    let text = std::fs::read_to_string(folder.join("W1.csv")).expect("read");
    let kept = |line: &&str| !line.starts_with("1.2") && !line.starts_with("1.3") && !line.starts_with("1.4");
    let gap: Vec<&str> = text.lines().filter(kept).collect();
    std::fs::write(folder.join("GAP.csv"), gap.join("\n")).expect("written");
    // Brows that never come back.
    let held = text.lines().take_while(|line| !line.starts_with("2.3"));
    let held: Vec<&str> = held.collect();
    std::fs::write(folder.join("HELD.csv"), held.join("\n")).expect("written");
    let mut long =
        String::from("time [s],brow_raise_right,brow_raise_left,brow_squeeze,head_pitch,head_yaw,head_roll\n");
    for row in 0..1_600 {
        let up = if (20..1_520).contains(&row) { 0.9 } else { 0.0 };
        writeln!(long, "{:.1},{up},{up},0,{up},0,0", f64::from(row) / 10.0).expect("text");
    }
    std::fs::write(folder.join("LONG.csv"), long).expect("written");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    for name in ["GAP", "HELD", "LONG"] {
        let path = folder.join(format!("{name}.csv"));
        let options = ImportOptions::default();
        case.corpus.import_paths(&[path], &options, progress).expect("imported");
        let signs: &[(&str, i64, i64)] = match name {
            "LONG" => &[("QUOI", 2_000, 152_000)],
            "HELD" => &SIGNS[..3],
            _ => &SIGNS,
        };
        add(&mut case.corpus, name, "Gloss", TierRole::Gloss, signs);
        let until = if name == "LONG" { 152_000 } else { 1_600 };
        let wh = [("wh-question", 700, until)];
        add(&mut case.corpus, name, "function", TierRole::Free, &wh);
    }
    let found = choose(&case, "W1", &ChooseOptions::default());
    assert_eq!(found.compared, 2, "{found:?}");
    let mut skipped: Vec<&str> = found.skipped.iter().map(|(_, why)| &**why).collect();
    skipped.sort_unstable();
    assert!(
        matches!(&skipped[..], [gap, long] if gap.contains("nothing was measured in 0.") && long.contains("lasts 15")),
        "{skipped:?}"
    );
    let found = case.corpus.measure_nonmanual_onsets(None, progress).expect("measured");
    assert_eq!((found.expressions, found.with_gaps, found.too_long), (5, 1, 0));
    let mut rows = found.rows.iter();
    let row = rows.rfind(|row| row.channel == "brow_raise_right");
    let row = row.expect("brows");
    assert_eq!((row.n, row.ends), (4, 3), "{row:?}");
    assert!(row.offset_s.is_some_and(|it| it.median.abs() < 1.0), "{row:?}");
}

#[test]
fn a_face_whose_times_lie_years_apart_is_refused_and_fills_no_memory() {
    let mut case = case(&[]);
    let path = case._folder.path().join("far.csv");
    let text = "time [s],brow_raise_right,jaw_open\n0,0,0\n1,1,0\n900000000,0,1\n";
    std::fs::write(&path, text).expect("written");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let options = ImportOptions::default();
    let report = case.corpus.import_paths(&[path], &options, progress).expect("read");
    assert_eq!(report.files[0].recording.as_deref(), Some("far"));
    let error = case
        .corpus
        .movement_at_address(&recording("far"))
        .expect_err("too long");
    assert!(error.to_string().contains("too long"), "{error}");
    let found = case.corpus.propose_nonmanuals(&recording("far"), false, progress);
    assert!(found.expect("looked at").proposals.len() < 10);
}
