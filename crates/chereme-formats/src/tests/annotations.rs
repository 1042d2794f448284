//! Golden tables of annotation documents: EAF read, changed and written; tables of changes; exported tables.

use chereme_motion::{RecordingInstant, TimeSpan};

use super::{findings, transcript};
use crate::eaf::{self, AnnotationTranscript, eaf_document_from_transcript, eaf_raw, patch_eaf, transcript_from_eaf};
use crate::golden::{compare, put};
use crate::table::annotations::{TableTimeUnit, read_change_table as read_table};
use crate::table::annotations::{is_export, read_elan_table as exported};

const FILES: [(&str, &str); 4] = [
    ("elan 2", include_str!("../../tests/eaf/elan2.eaf")),
    ("elan 6", include_str!("../../tests/eaf/elan6.eaf")),
    ("merge", include_str!("../../../chereme-corpus/src/merge/tests.eaf")),
    ("odd", ODD),
];

/// A document with every optional part, and many faults.
const ODD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="A. B." DATE="2024-01-01T00:00:00Z" FORMAT="3.0" VERSION="3.0">
<LICENSE LICENSE_URL="https://example.org/by">CC BY</LICENSE>
<HEADER MEDIA_FILE="" TIME_UNITS="milliseconds">
<MEDIA_DESCRIPTOR MEDIA_URL="file:///a.mp4" MIME_TYPE="video/mp4" RELATIVE_MEDIA_URL="./a.mp4" TIME_ORIGIN="120"/>
<MEDIA_DESCRIPTOR MEDIA_URL="file:///a.wav" MIME_TYPE="audio/x-wav" EXTRACTED_FROM="file:///a.mp4"/>
<LINKED_FILE_DESCRIPTOR LINK_URL="file:///a.csv" RELATIVE_LINK_URL="./a.csv" MIME_TYPE="text/plain" TIME_ORIGIN="-40"/>
<PROPERTY NAME="lastUsedAnnotationId">20</PROPERTY><PROPERTY NAME="own">x</PROPERTY>
</HEADER>
<TIME_ORDER>
<TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="0"/><TIME_SLOT TIME_SLOT_ID="ts2" TIME_VALUE="1000"/>
<TIME_SLOT TIME_SLOT_ID="ts3"/><TIME_SLOT TIME_SLOT_ID="ts4"/><TIME_SLOT TIME_SLOT_ID="ts5" TIME_VALUE="2500"/>
<TIME_SLOT TIME_SLOT_ID="ts6" TIME_VALUE="2400"/><TIME_SLOT TIME_SLOT_ID="ts7" TIME_VALUE="3100"/>
</TIME_ORDER>
<TIER TIER_ID="Gloss" LINGUISTIC_TYPE_REF="gloss" PARTICIPANT="P1" ANNOTATOR="X" DEFAULT_LOCALE="en" LANG_REF="nld">
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts2" CVE_REF="cve1"><ANNOTATION_VALUE>CHAT</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a2" TIME_SLOT_REF1="ts2" TIME_SLOT_REF2="ts5" EXT_REF="er1"><ANNOTATION_VALUE>CHIEN &amp; CO</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a3" TIME_SLOT_REF1="ts6" TIME_SLOT_REF2="ts7"><ANNOTATION_VALUE>LION</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a4" TIME_SLOT_REF1="ts7" TIME_SLOT_REF2="ts6"><ANNOTATION_VALUE>back</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
</TIER>
<TIER TIER_ID="Parts" LINGUISTIC_TYPE_REF="time" PARENT_REF="Gloss">
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a5" TIME_SLOT_REF1="ts2" TIME_SLOT_REF2="ts3"><ANNOTATION_VALUE>one</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a6" TIME_SLOT_REF1="ts3" TIME_SLOT_REF2="ts4"><ANNOTATION_VALUE>two</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a7" TIME_SLOT_REF1="ts4" TIME_SLOT_REF2="ts5"><ANNOTATION_VALUE/></ALIGNABLE_ANNOTATION></ANNOTATION>
</TIER>
<TIER TIER_ID="Words" LINGUISTIC_TYPE_REF="sub" PARENT_REF="Gloss">
<ANNOTATION><REF_ANNOTATION ANNOTATION_ID="a8" ANNOTATION_REF="a1"><ANNOTATION_VALUE>un</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>
<ANNOTATION><REF_ANNOTATION ANNOTATION_ID="a9" ANNOTATION_REF="a1" PREVIOUS_ANNOTATION="a8"><ANNOTATION_VALUE>deux</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>
<ANNOTATION><REF_ANNOTATION ANNOTATION_ID="a10" ANNOTATION_REF="a99"><ANNOTATION_VALUE>lost</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>
</TIER>
<TIER TIER_ID="Notes" LINGUISTIC_TYPE_REF="one" PARENT_REF="Gloss">
<ANNOTATION><REF_ANNOTATION ANNOTATION_ID="a11" ANNOTATION_REF="a3"><ANNOTATION_VALUE>sure?</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>
</TIER>
<TIER TIER_ID="Free" LINGUISTIC_TYPE_REF="nowhere">
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts7"><ANNOTATION_VALUE>twice</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a12" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts70"><ANNOTATION_VALUE>no slot</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
</TIER>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="gloss" TIME_ALIGNABLE="true" CONTROLLED_VOCABULARY_REF="cv" GRAPHIC_REFERENCES="false"/>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="time" CONSTRAINTS="Time_Subdivision" TIME_ALIGNABLE="true"/>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="sub" CONSTRAINTS="Symbolic_Subdivision" TIME_ALIGNABLE="false"/>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="one" CONSTRAINTS="Symbolic_Association" TIME_ALIGNABLE="false" EXT_REF="er1"/>
<LOCALE LANGUAGE_CODE="en" COUNTRY_CODE="US"/>
<LANGUAGE LANG_ID="nld" LANG_DEF="http://cdb.iso.org/lg/CDB-00138580-001" LANG_LABEL="Dutch (nld)"/>
<CONSTRAINT STEREOTYPE="Time_Subdivision" DESCRIPTION="d"/>
<CONTROLLED_VOCABULARY CV_ID="cv" EXT_REF="er2"><DESCRIPTION LANG_REF="nld">signs</DESCRIPTION>
<CV_ENTRY_ML CVE_ID="cve1" EXT_REF="er1"><CVE_VALUE LANG_REF="nld" DESCRIPTION="cat">CHAT</CVE_VALUE></CV_ENTRY_ML>
<CV_ENTRY_ML CVE_ID="cve2"><CVE_VALUE LANG_REF="nld">CHIEN</CVE_VALUE></CV_ENTRY_ML></CONTROLLED_VOCABULARY>
<LEXICON_REF LEX_REF_ID="lr1" NAME="n" TYPE="t" URL="u" LEXICON_ID="l" LEXICON_NAME="ln" DATCAT_ID="d" DATCAT_NAME="dn"/>
<REF_LINK_SET LINK_SET_ID="rls" LINK_SET_NAME="links" EXT_REF="er1" LANG_REF="nld"><CROSS_REF_LINK REF_LINK_ID="rl1" REF1="a1" REF2="a2" DIRECTIONALITY="bi"><ANY>x</ANY></CROSS_REF_LINK></REF_LINK_SET>
<EXTERNAL_REF EXT_REF_ID="er1" TYPE="iso12620" VALUE="http://x"/><EXTERNAL_REF EXT_REF_ID="er2" TYPE="ecv" VALUE="file:///a.ecv"/>
</ANNOTATION_DOCUMENT>
"#;

fn written(document: &eaf_raw::EafDocument<'_>) -> String {
    let mut out = Vec::new();
    eaf_raw::write_eaf_document(document, &mut out).expect("a vector takes everything");
    String::from_utf8(out).expect("UTF-8")
}

/// Writes down the lines of a text that another lacks.
fn changed(out: &mut String, sign: char, text: &str, other: &str) {
    let known: Vec<&str> = other.lines().collect();
    for line in text.lines().filter(|line| !known.contains(line)) {
        put(out, format!("{sign} {line}"));
    }
}

#[test]
fn golden_annotation_documents_read_and_written() {
    let mut out = String::new();
    for (name, text) in FILES {
        put(&mut out, format!("## {name}"));
        let (it, found) = eaf::read_eaf(text.as_bytes()).expect("EAF");
        transcript(&mut out, &it);
        findings(&mut out, &found);
        let (document, found) = eaf_raw::read_eaf_document(text.as_bytes()).expect("EAF");
        findings(&mut out, &found);
        put(&mut out, "### written again");
        put(&mut out, written(&document));
        let (meant, _) = transcript_from_eaf(&document);
        put(&mut out, "### from its meaning");
        put(&mut out, written(&eaf_document_from_transcript(&meant, &document)));
        put(&mut out, "### from its meaning alone");
        put(
            &mut out,
            written(&eaf_document_from_transcript(&meant, &eaf_raw::EafDocument::default())),
        );
        put(
            &mut out,
            format!("check {:?}", eaf_raw::check_eaf_references(&document)),
        );
    }
    compare("eaf", &out);
}

fn millis(from: i64, to: i64) -> TimeSpan {
    TimeSpan::span_between(RecordingInstant::from_millis(from), RecordingInstant::from_millis(to))
}

/// A change to a document.
type Change = fn(&mut AnnotationTranscript);

#[test]
fn golden_annotation_documents_changed_in_place() {
    let mut out = String::new();
    let changes: [(&str, Change); 9] = [
        ("a value", |it| it.tiers[0].annotations[0].value = "ÂNE <b>".into()),
        ("a time", |it| it.tiers[0].annotations[0].span = millis(20, 640)),
        ("one less", |it| {
            let last = it.tiers.len() - 1;
            it.tiers[last].annotations.pop();
        }),
        ("one more", |it| {
            let mut more = it.tiers[0].annotations[0].clone();
            (more.id, more.span, more.value) = ("a77".into(), millis(9000, 9500), "NEW".into());
            more.millis = None;
            it.tiers[0].annotations.push(more);
        }),
        ("a tier renamed", |it| it.tiers[0].name = "Other".into()),
        ("a tier more", |it| {
            let mut more = it.tiers[0].clone();
            (more.name, more.annotations) = ("More".into(), Vec::new());
            it.tiers.push(more);
        }),
        ("a participant", |it| it.tiers[0].participant = Some("Q".into())),
        ("a property", |it| it.properties.push(("k".into(), "v".into()))),
        ("media", |it| {
            if let Some(media) = it.media.first_mut() {
                media.url = "file:///b.mp4".into();
            }
        }),
    ];
    for (name, text) in FILES {
        for (what, change) in &changes {
            put(&mut out, format!("## {name}: {what}"));
            let (mut after, _) = eaf::read_eaf(text.as_bytes()).expect("EAF");
            change(&mut after);
            match patch_eaf(text.as_bytes(), &after) {
                Ok(Some(new)) => {
                    let new = String::from_utf8(new).expect("UTF-8");
                    changed(&mut out, '-', text, &new);
                    changed(&mut out, '+', &new, text);
                }
                other => put(&mut out, format!("{:?}", other.map(|it| it.is_some()))),
            }
        }
    }
    compare("eaf_patched", &out);
}

#[test]
fn golden_vocabularies_and_settings() {
    let mut out = String::new();
    let ecv = r#"<?xml version="1.0"?><CV_RESOURCE AUTHOR="" DATE="2024-01-01T00:00:00Z" VERSION="0.2">
<LANGUAGE LANG_ID="nld" LANG_DEF="x" LANG_LABEL="Dutch"/>
<CONTROLLED_VOCABULARY CV_ID="signs"><DESCRIPTION LANG_REF="nld">d</DESCRIPTION>
<CV_ENTRY_ML CVE_ID="c1" EXT_REF="e"><CVE_VALUE LANG_REF="nld" DESCRIPTION="cat">CHAT</CVE_VALUE></CV_ENTRY_ML>
<CV_ENTRY_ML CVE_ID="c2"><CVE_VALUE LANG_REF="nld">CHIEN</CVE_VALUE></CV_ENTRY_ML></CONTROLLED_VOCABULARY>
<EXTERNAL_REF EXT_REF_ID="e" TYPE="cve_id" VALUE="v"/></CV_RESOURCE>"#;
    let (all, found) = eaf::read_vocabularies(ecv.as_bytes()).expect("a vocabulary");
    all.iter().for_each(|it| put(&mut out, format!("{it:?}")));
    findings(&mut out, &found);
    let settings = r#"<?xml version="1.0"?><preferences version="1.1">
<prefList key="MultiTierViewer.TierOrder"><String>Gloss</String><String>Words</String></prefList>
<prefList key="MultiTierViewer.HiddenTiers"><String>Notes</String></prefList>
<prefGroup key="TierColors"><pref key="Gloss"><Object class="java.awt.Color">255,0,128</Object></pref>
<pref key="Words"><Object class="java.awt.Color">1,2,3</Object></pref><pref key="Bad"><Object class="java.awt.Color">1,2</Object></pref></prefGroup>
<pref key="other"><Int>3</Int></pref></preferences>"#;
    let read = eaf::eaf_settings::read_display_settings(settings.as_bytes());
    put(&mut out, format!("{read:?}"));
    for text in [
        "",
        "<a/>",
        "<ANNOTATION_DOCUMENT/>",
        "<?xml version=\"1.0\"?><ANNOTATION_DOCUMENT>",
    ] {
        put(
            &mut out,
            format!(
                "{text}: {:?}",
                eaf::read_eaf(text.as_bytes()).map_err(|it| it.to_string())
            ),
        );
    }
    compare("eaf_beside", &out);
}

#[test]
fn golden_tables_of_changes_and_exports() {
    let mut out = String::new();
    let tables = [
        "\u{feff}Recording;Tier;Start;End;Value;Action;ID;Parent\r\nR1;Gloss RH;0.5;1.2s;CHAT;;;\r\n\
         R1;Gloss RH;1500ms;0:02.25;\"a;\"\"b\"\"\";ADD;;\r\nR1;config;f12;f144;B;add;;\r\n\r\n;;;;neu;set;a7;\r\n\
         R1;Gloss RH;1:02:03.5;;;remove;;\r\nR1;sub;;;x;;;a3\r\n",
        "tier,start,end,value,action\n,1,2,a,\nt,,2,a,\nt,1,,a,\nt,2,1,a,\nt,f2,f2,a,\nt,\"1,5\",2,a,\nt,1:75,2,a,\n\
         t,-1,2,a,\nt,1,2,a,fly\nt,1e9,2e9,a,\nt,1.5h,2,a,\n",
        "tier\tbegin\tfinish\ttext\nGloss\t500\t1000\tBOL\n",
        "tier,value\nGloss,BOL\n",
        "",
    ];
    for (n, text) in tables.iter().enumerate() {
        for unit in [
            None,
            Some(TableTimeUnit::Seconds),
            Some(TableTimeUnit::Milliseconds),
            Some(TableTimeUnit::Frames),
        ] {
            put(
                &mut out,
                format!("## table {n} in {:?}", unit.map(TableTimeUnit::time_unit_name)),
            );
            match read_table(text.as_bytes(), unit) {
                Ok((table, found)) => {
                    table.rows.iter().for_each(|it| put(&mut out, format!("{it:?}")));
                    table.faults.iter().for_each(|it| put(&mut out, format!("{it}")));
                    findings(&mut out, &found);
                }
                Err(error) => put(&mut out, format!("refused: {error}")),
            }
        }
    }
    let exports = [
        "\"Gloss\"\t\"P1\"\t\"0.5\"\t\"1.0\"\t\"0.5\"\t\"BOL\"\n\"Mouth\"\t\"P1\"\t\"0.5\"\t\"0.75\"\t\"0.25\"\t\"\"\n",
        "#film.mp4\nTier\tBegin Time - msec\tEnd Time - msec\tAnnotation\nGloss\t500\t1000\tBOL\nGloss\t900\t1400\tCHAT\n",
        "Begin Time - msec\tEnd Time - msec\tGloss\tMouth\n500\t1000\tBOL\tpa\n2000\t2100\t\tx\n",
        "Gloss\t\t0.5\t1.0\tA\nGloss\t\t0.8\t1.2\tB\nGloss\t\t0.8\t1.3\tC\nGloss\t\t3\t2\tD\n",
        "Begin Time - hh:mm:ss.ms\tEnd Time - hh:mm:ss.ms\tGloss\n00:00:01.5\t00:01:02.25\tX\n",
        "a\tb\n",
    ];
    for (n, text) in exports.iter().enumerate() {
        put(&mut out, format!("## export {n}: {}", is_export(text.as_bytes())));
        match exported(text.as_bytes()) {
            Ok((it, found)) => {
                transcript(&mut out, &it);
                findings(&mut out, &found);
            }
            Err(error) => put(&mut out, format!("refused: {error}")),
        }
    }
    compare("tables", &out);
}
