//! Tests of tables of points: markers from tables, and other tables that stay what they are.

use chereme_formats::points;
use chereme_formats::tracks::CapturedTrackContent;
use chereme_motion::FrameRate;

use super::*;
use crate::track::TrackKind;

const WRIST: &str = "time,LWRA_x,LWRA_y,LWRA_z\n0.00,1.50,900,3\n0.01,1.60,,3\n0.02,1.70,901,3.000\n";
const NEXUS: &str = "Trajectories\n100\n,,Anna:LWRA,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n1,0,1.50,900,3\n2,0,1.60,,\n";

/// Returns the kinds of tracks that a file becomes, or its status.
fn kinds(corpus: &mut Corpus, file: &Path) -> String {
    let before = recordings_of(corpus).len();
    let report = import(corpus, file, "{}");
    let Some(id) = recordings_of(corpus).get(before).copied() else {
        return format!("{:?}", report.status);
    };
    let rows = crate::db::stored_tracks::load_track_rows(corpus.store.read_connection(), id).expect("tracks");
    let kinds: Vec<&str> = rows.iter().map(|row| row.kind.track_kind_name()).collect();
    match kinds.is_empty() {
        true => format!("{:?}", report.status),
        false => kinds.join(" "),
    }
}

#[test]
fn tables_of_points_become_markers_and_others_stay_what_they_are() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let face = "Timecode,BlendShapeCount,JawOpen\n00:00:00:00.0,61,0.25\n00:00:00:01.0,61,0.5\n";
    let tabs = NEXUS.replace(',', "\t");
    for (name, text, expected) in [
        ("wrist.csv", WRIST, "markers"),
        ("nexus.csv", NEXUS, "markers"),
        ("tabs.txt", tabs.as_str(), "markers"),
        ("force.csv", "time,Fx,Fy,Fz\n0,1,2,3\n0.01,1,2,3\n", "curves"),
        ("face.csv", face, "curves"),
        (
            "shapes.csv",
            "time,jawOpen,eye_x,eye_y\n0,0.1,2,3\n0.01,0.1,2,3\n",
            "curves",
        ),
        ("words.csv", "gloss,x,y\nBOL,1,2\nCHAT,3,4\n", "Imported"),
        (
            "spans.txt",
            "Tier\tBegin\tEnd\tValue\twrist_x\twrist_y\nGloss\t0.5\t1.5\tBOL\t1\t2\n",
            "Imported",
        ),
        (
            "pairs.csv",
            "gloss,dominant handshape,weak handshape\nBOOK,B,B\nSTICK,X,Y\nTABLE,5,5\n",
            "Imported",
        ),
        ("tiers.csv", "tier,begin,end,value\nGloss,0.5,1.5,BOL\n", "Imported"),
    ] {
        assert_eq!(kinds(&mut corpus, &desk.file(name, text)), expected, "{name}");
    }
    assert_whole(&mut corpus);
}

#[test]
fn a_unit_and_axes_that_are_said_are_not_asked_for() {
    let desk = Desk::new();
    let file = desk.file("wrist.csv", WRIST);
    let asks = |options: &ImportOptions, name: &str| {
        let mut corpus = desk.corpus(name);
        let mut hear = ignore_progress_step;
        let files = [file.clone()];
        let report = corpus.import_paths(&files, options, &mut ProgressReceiver::new(&mut hear));
        let findings = report.expect("imported").files.remove(0).findings;
        let asked = findings.into_iter().filter_map(|it| it.remedy);
        asked
            .filter(|it| it.remedy_text().contains("--unit") || it.remedy_text().contains("--axes"))
            .count()
    };
    assert_eq!(asks(&ImportOptions::default(), "a.chereme"), 2);
    let said = ImportOptions {
        metres_per_unit: Some(0.001),
        axes: "+Z,+X".parse().ok(),
        ..ImportOptions::default()
    };
    assert!(said.axes.is_some());
    assert_eq!(asks(&said, "b.chereme"), 0);
}

#[test]
fn shared_tables_of_other_things_are_no_points() {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let data = Path::new(&data);
    for (file, expected) in [
        ("face/alexdjulin-LiveLinkFace/alex_rom_4.csv", "curves"),
        ("face/cosanlab-py-feat/OpenFace_Test.csv", "curves"),
        ("face/think-biq-LLV/dao_decoded.csv", "curves"),
        ("phonology/ngt_lexicon.tsv", "Imported"),
        ("annotation/eaf/neocl-speach/test.eaf.tsv", "Refused"),
        ("notation/hamnosys/lingpy-pysign/test-signs.tsv", "Imported"),
        (
            "notation/hamnosys/hearai-parse-hamnosys/hamnosys_example.txt",
            "Imported",
        ),
    ] {
        assert_eq!(kinds(&mut corpus, &data.join(file)), expected, "{file}");
    }
}

#[test]
fn exported_tables_give_the_same_numbers_back() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    for (name, text) in [("wrist.csv", WRIST), ("nexus.csv", NEXUS)] {
        import(&mut corpus, &desk.file(name, text), "{}");
        let (read, _) = points::read_point_table(text.as_bytes(), None).expect("read");
        let CapturedTrackContent::Markers(expected) = &read.tracks[0].content else {
            panic!("markers");
        };
        let stem = name.trim_end_matches(".csv");
        let address = format!("recording:{stem}").parse().expect("an address");
        let out = desk.folder.path().join(format!("{stem}.markers.csv"));
        let mut hear = ignore_progress_step;
        corpus
            .export_corpus(
                &ExportWhat::Address(address),
                &out,
                &ExportOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("exported");
        let (again, findings) = points::read_point_table(&fs::read(&out).expect("bytes"), None).expect("read");
        let CapturedTrackContent::Markers(again) = &again.tracks[0].content else {
            panic!("markers");
        };
        assert_eq!(again.marker_points(), expected.marker_points(), "{findings:?}");
        assert_eq!(again.marker_times(), expected.marker_times());
    }
}

#[test]
fn a_table_without_a_rate_takes_the_one_that_is_asked_for_and_its_unit_and_axes() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let text = "LWRA_x,LWRA_y,LWRA_z,LWRA_score\n1.50,900,3,0.9\n1.60,901,3,0.8\n";
    let options = ImportOptions {
        rate: FrameRate::new(50, 1).ok(),
        metres_per_unit: Some(0.01),
        axes: Some("+Z,-X".parse().expect("axes")),
        ..ImportOptions::default()
    };
    let mut hear = ignore_progress_step;
    let take = desk.file("take.csv", text);
    let report = corpus.import_paths(&[take], &options, &mut ProgressReceiver::new(&mut hear));
    let report = report.expect("imported").files.remove(0);
    let id = recordings_of(&corpus)[0];
    let rows = crate::db::stored_tracks::load_track_rows(corpus.store.read_connection(), id).expect("tracks");
    let form = crate::db::stored_tracks::load_track_form(corpus.store.read_connection(), rows[0].id).expect("a form");
    assert_eq!(rows[0].kind, TrackKind::Markers);
    assert_eq!(rows[0].rate, FrameRate::new(50, 1).ok());
    assert_eq!(form.metres_per_unit, Some(0.01));
    assert_eq!(form.axes.as_deref(), Some("+Z,-X"));
    let is_rate = |it: &&ReportFinding| it.message.contains("frames a second are taken");
    assert_eq!(report.findings.iter().find(is_rate), None);
}
