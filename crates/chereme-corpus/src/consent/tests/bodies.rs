//! The body that moves in a generated sign counts, whatever the form of its recipe.

use std::fs;

use super::*;

const NOTATED: &str = r#"<sigml><hamgestural_sign gloss="MERCI"><sign_manual>
  <handconfig handshape="flat"/><handconfig extfidir="u"/><handconfig palmor="u"/>
  <location_bodyarm location="chin" contact="touch"/>
  <directedmotion direction="o"/>
</sign_manual></hamgestural_sign></sigml>"#;

/// Recipes of every form, and whether they use the body that the corpus chooses, that of BOL, or something else of BOL.
const FORMS: [(&str, bool); 21] = [
    ("MERCI", true),
    ("MERCI | place both by up 1cm", true),
    ("MERCI | trim | repeat 2", true),
    ("MERCI then MERCI", true),
    ("MERCI then BOL", true),
    ("BOL then MERCI", true),
    ("BOL | nonmanual from MERCI", true),
    ("ESCARGOT | face brows=raised", false),
    ("FIRST", true),
    ("FIRST | mirror", true),
    ("sigml MERCI", true),
    ("sigml MERCI on recording:escargot", false),
    ("hamnosys \"hamflathand hamextfingeru hampalmd\"", true),
    ("spell LSF", true),
    ("spell LSF on recording:escargot", false),
    ("point right at left up", true),
    ("point right at left up on recording:escargot | reverse", false),
    ("cue \"le chat\"", true),
    ("ESCARGOT | configure right from BOL", true),
    ("ESCARGOT | place right near BOL", true),
    ("BOL", true),
];

/// Returns a corpus with a notated sign next to BOL and ESCARGOT, and a sign for each form of recipe; the body that it
/// chooses is that of BOL.
fn made(folder: &std::path::Path) -> Corpus {
    let mut corpus = corpus(folder);
    let file = folder.join("merci.sigml");
    fs::write(&file, NOTATED).expect("written");
    corpus
        .import_paths(
            &[file],
            &ImportOptions::default(),
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )
        .expect("imported");
    corpus.recombine_recipe("MERCI", "FIRST").expect("generated");
    for (n, (recipe, _)) in FORMS.iter().enumerate() {
        let made = corpus.recombine_recipe(recipe, &format!("FORM{n}"));
        made.unwrap_or_else(|error| panic!("{recipe}: {error}"));
    }
    corpus
}

fn agree(corpus: &mut Corpus, refused: &str) {
    let yes = ConsentChange {
        licence: Some("CC0".into()),
        ..all(ConsentAudience::Public)
    };
    let change = |corpus: &mut Corpus, of: &str, change: &ConsentChange| {
        let changed = corpus.change_consent(&[address(of)], change);
        drop(changed.expect("changed"));
    };
    change(corpus, "signer:Ada", &yes);
    for one in ["recording:bol", "recording:escargot"] {
        change(corpus, one, &yes);
    }
    change(corpus, refused, &all(ConsentAudience::Nobody));
}

/// Returns the recipes whose movement may be published.
fn public(corpus: &Corpus) -> Vec<&'static str> {
    let connection = corpus.store.read_connection();
    let known = PublishPermissions::read_publish_permissions(connection, Some("CC0")).expect("read");
    let may = |n: &usize| {
        let name = format!("FORM{n}");
        let found = stored_recordings::recording_named(connection, &name).expect("read");
        let id = found.expect("a recording").id;
        known.recording_publish_terms(id, ConsentKind::Movement).is_ok()
    };
    (0..FORMS.len()).filter(may).map(|n| FORMS[n].0).collect()
}

#[test]
fn a_refused_body_is_refused_in_every_form_of_recipe() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = made(folder.path());
    agree(&mut corpus, "recording:bol");
    let others = FORMS.iter().filter(|(_, own)| !own).map(|(form, _)| *form);
    assert_eq!(public(&corpus), others.collect::<Vec<_>>());
    let to = folder.path().join("site");
    let done = corpus
        .publish_dictionary(
            &to,
            &crate::PublishOptions {
                terms: Some("CC0".into()),
                ..crate::PublishOptions::default()
            },
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )
        .expect("published");
    let moving = fs::read_dir(to.join("data/motion")).expect("a folder");
    let mut moving: Vec<String> = moving
        .map(|it| it.expect("read").file_name().to_string_lossy().into_owned())
        .collect();
    moving.sort();
    let others = (0..FORMS.len()).filter(|n| !FORMS[*n].1);
    let mut wanted: Vec<String> = others.map(|n| format!("FORM{n}.js")).collect();
    // MERCI moves by its notation, on the body of nobody.
    wanted.extend(["ESCARGOT.js", "LIMACE.js", "MERCI.js"].map(str::to_owned));
    wanted.sort();
    assert_eq!(moving, wanted, "{:?}", done.left_out);
}

#[test]
fn a_body_that_a_stored_recipe_does_not_name_is_found_by_its_skeleton() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = made(folder.path());
    let forgotten = corpus.store.named_operation("forget", |connection| {
        // As earlier versions stored them.
        connection.execute(
            "DELETE FROM recipe_input WHERE hash = '' OR address LIKE 'recording:%' AND recipe_id IN (
                 SELECT recipe_id FROM recipe_input WHERE recording_id IS NULL)",
            [],
        )?;
        let changed = connection.execute(
            "UPDATE recipe SET document = (
                 SELECT json_set(recipe.document, '$.inputs', json_group_object(
                     it.key, json(json_remove(it.value, '$.material.body'))))
                 FROM json_each(recipe.document, '$.inputs') it)
             WHERE document LIKE '%\"body\"%'",
            [],
        )?;
        Ok((changed, String::new()))
    });
    assert!(forgotten.expect("forgotten") >= 8);
    for refused in ["recording:bol", "recording:escargot"] {
        agree(&mut corpus, refused);
        let notated: Vec<&str> = public(&corpus)
            .into_iter()
            .filter(|recipe| recipe.starts_with("MERCI") || recipe.starts_with("FIRST"))
            .collect();
        // Both recordings have one skeleton, so that either may have provided the body.
        let none: [&str; 0] = [];
        assert_eq!(notated, none, "{refused}");
    }
    agree(&mut corpus, "recording:bol");
    let lent = public(&corpus)
        .into_iter()
        .find(|it| it.contains("configure") || it.contains("near"));
    assert_eq!(lent, None, "a handshape and a place are counted, too");
    agree(&mut corpus, "recording:LIMACE");
    assert_eq!(public(&corpus).len(), FORMS.len());
}

#[test]
fn a_notation_on_the_own_body_needs_nobodys_consent() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("created");
    let file = folder.path().join("merci.sigml");
    fs::write(&file, NOTATED).expect("written");
    corpus
        .import_paths(
            &[file],
            &ImportOptions::default(),
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )
        .expect("imported");
    for recipe in ["MERCI", "sigml MERCI"] {
        let made = corpus.recombine_recipe(recipe, "ONE").expect("generated");
        let connection = corpus.store.read_connection();
        let known = PublishPermissions::read_publish_permissions(connection, Some("CC0")).expect("read");
        let verdict = known.recording_publish_terms(made.recording.expect("stored"), ConsentKind::Movement);
        assert!(verdict.is_ok(), "{recipe}: {verdict:?}");
    }
}
