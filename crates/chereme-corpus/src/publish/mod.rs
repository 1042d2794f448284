//! A dictionary of signs as a folder of web pages, which works without a server.
//!
//! Only what everybody may see is published: recordings whose signers agreed, under stated terms (see the module
//! `consent`). The names of signers, recordings and files never reach the folder.

mod bodies;
mod codes;
mod entries;
mod folder;
mod offline;
mod pages;
mod publish_facets;
mod publish_motion;
mod publish_names;
mod publish_source;
mod publish_words;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use chereme_figure::{RasterImage, write_palette_png};
use chereme_sign::ErrorRemedy;
use chereme_sign::hamnosys::drawing::hamnosys_to_svg;
use chereme_sign::text::fold_text;
use serde::Serialize;
use serde_json::{Value, json};

use crate::Corpus;
use crate::consent::{self, PublishPermissions, WithheldReason};
use crate::db::seals;
use crate::error::{CorpusError, CorpusResult};
use crate::inventories;
use crate::lexicon::LexiconScope;
use crate::progress::ProgressReceiver;

use bodies::DictionaryBodies;
use entries::{DictionaryEntries, DictionaryEntry, EntryMovement};
use folder::PublicationFolder;
use pages::{DictionarySite, page_script, page_style};
use publish_facets::{CHOOSABLE_COMPONENTS, ComponentFacet};

/// The words for the body that plays the signs, in `consent.json`.
const SIGNER_BODY_WORDS: &str = "that of each signer";
const PROGRAM_BODY_WORDS: &str = "the program's own; rhythm and movement are still the signer's";
/// The height of a notation's symbols on a page, in pixels.
const NOTATION_HEIGHT_PX: f32 = 48.0;
/// The most signs of a dictionary.
const MAX_DICTIONARY_SIGNS: usize = 50_000;
/// How many signs that were left out are named for each reason.
const MAX_NAMED_LEFT_OUT: usize = 5;

/// Options of a dictionary.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PublishOptions {
    /// The signs, as a query for their tokens; all signs if `None`.
    pub query: Option<String>,
    /// The lexicons whose signs are published.
    pub scope: LexiconScope,
    /// The title of the pages.
    pub title: Option<String>,
    /// The terms of use of what has none of its own and shows nobody: entries of tables, and signs generated from
    /// notation.
    pub terms: Option<String>,
    /// The address to which people write, also to withdraw a sign.
    pub contact: Option<String>,
    /// Whether the remarks on signs are published.
    pub notes: bool,
    /// Whether signs play on the program's own body instead of the signer's.
    pub own_body: bool,
    /// Whether signs that have a notation and no movement stay without movement.
    pub without_animation: bool,
}

impl PublishOptions {
    fn dictionary_title(&self) -> &str {
        self.title.as_deref().unwrap_or("Signs · Signes")
    }
}

/// A dictionary that was published.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PublishedDictionary {
    /// The page to open.
    pub page: PathBuf,
    /// The number of signs.
    pub signs: usize,
    /// The number of signs that move.
    pub moving: usize,
    /// The number of signers.
    pub signers: usize,
    /// The number of files.
    pub files: usize,
    /// The size of all files in bytes.
    pub bytes: u64,
    /// The number of signs under each terms of use.
    pub terms: BTreeMap<String, usize>,
    /// The number of handshapes without a picture, because their values have no posture.
    pub undrawn: usize,
    /// The number of handshapes without a posture that have the picture of the usual handshape of that name.
    pub namesakes: usize,
    /// The number of signs whose movement may be shown, but moves no arms.
    pub armless: usize,
    /// The signs whose movement is cut after 3,600 frames.
    pub cut: Vec<String>,
    /// Whether the signs play on the program's own body.
    pub own_body: bool,
    /// The signs with a touch that is lost on the program's own body: a hand stays apart from what the signer touched.
    pub apart: Vec<String>,
    /// Whether minimal pairs are left out, because there are too many of them.
    pub without_pairs: bool,
    /// The number of signs whose movement was generated from their notation for this dictionary.
    pub animated: usize,
    /// The signs whose notation could not be animated.
    pub unanimated: Vec<String>,
    /// The signs that were left out, by reason.
    pub left_out: Vec<LeftOutSigns>,
}

/// The part of a sign that was left out of a dictionary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum LeftOutPart {
    /// The whole sign.
    Sign,
    /// Its movement.
    Movement,
    /// The words and values of its lexicon.
    Lexicon,
}

/// Signs that were left out of a dictionary, or are in it without a part.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeftOutSigns {
    /// The reason.
    pub why: WithheldReason,
    /// The part of them that was left out.
    pub part: LeftOutPart,
    /// The number of signs.
    pub signs: usize,
    /// The glosses of the first ones.
    pub first: Vec<String>,
    /// The remedy.
    #[serde(serialize_with = "as_text")]
    pub remedy: ErrorRemedy,
}

/// The result of writing pages, data and pictures.
#[derive(Default)]
struct WrittenSite {
    /// The number of signs that move.
    moving: usize,
    /// The number of handshapes without a picture.
    undrawn: usize,
    /// The number of handshapes with the picture of the usual one of that name.
    namesakes: usize,
    /// The number of signs whose movement moves no arms.
    armless: usize,
    /// The signs whose movement is cut.
    cut: Vec<String>,
    /// The signs with a touch that is lost on another body.
    apart: Vec<String>,
    /// The number of signs whose notation was animated.
    animated: usize,
    /// The signs whose notation could not be animated.
    unanimated: Vec<String>,
}

fn as_text<S: serde::Serializer>(remedy: &ErrorRemedy, out: S) -> std::result::Result<S::Ok, S::Error> {
    out.serialize_str(remedy.remedy_text())
}

impl Corpus {
    /// Publishes a dictionary of signs as a folder of web pages: search by word, handshape, place and movement, and a
    /// page for each sign with its movement. It opens from a disk and from any web server, and asks no other computer
    /// for anything. The same corpus gives the same bytes. An older publication in the folder is replaced, by one without
    /// signs if none of them may be published any more; files of others stay.
    ///
    /// # Errors
    /// [`CorpusError::Wrong`] if nothing may be published, the query cannot be read, there are more than 50,000 signs, or the
    /// corpus itself lies in the folder; [`CorpusError::File`] if the folder cannot be written; [`CorpusError::Stopped`]. The folder
    /// is as before then. If only the old pages could not be removed, the new ones are in place.
    pub fn publish_dictionary(
        &mut self,
        to: &Path,
        options: &PublishOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<PublishedDictionary> {
        // Links could hide that both are the same place.
        let [own, there] = [self.corpus_file_path(), to].map(fs::canonicalize);
        if own
            .ok()
            .zip(there.ok())
            .is_some_and(|(own, there)| own.starts_with(there))
        {
            return Err(CorpusError::from_wrong_message("the corpus itself lies in this folder")
                .with_error_place(to.display().to_string())
                .with_advice("name a folder that holds only what everybody may see"));
        }
        // Damaged rows, which may have lost what restricts them, must not reach the public.
        seals::verify_material(self.store.read_connection())?;
        let given_terms = options.terms.as_deref().map(str::trim);
        let terms = given_terms.filter(|text| !text.is_empty());
        let permissions = PublishPermissions::read_publish_permissions(self.store.read_connection(), terms)?;
        let query = options.query.as_deref().filter(|text| !text.trim().is_empty());
        let collected = entries::collect_dictionary_entries(self, query, options, &permissions, progress)?;
        let left_out = left_out(&collected);
        // If every sign of an older publication was withdrawn, its pages may not stay. Without terms nothing was.
        let refused = left_out.iter().any(|omission| omission.why != WithheldReason::NoTerms);
        let withdrawn = refused && folder::is_published(to);
        if collected.all.is_empty() && !withdrawn {
            return Err(empty_dictionary_error(&left_out));
        }
        if collected.all.len() > MAX_DICTIONARY_SIGNS {
            let text = format!("a dictionary has at most {MAX_DICTIONARY_SIGNS} signs");
            return Err(CorpusError::from_wrong_message(text).with_advice("choose fewer with a query"));
        }
        let mut folder = PublicationFolder::begin_publication(to)?;
        let written = self.write_dictionary(&mut folder, &collected, options, progress)?;
        let moving = written.moving;
        let mut terms: BTreeMap<String, usize> = BTreeMap::new();
        for entry in &collected.all {
            for it in &entry.terms {
                *terms.entry(it.clone()).or_default() += 1;
            }
        }
        folder.write_published_file("LICENCES.txt", licences(&terms).as_bytes())?;
        let counts = json!({
            "signs": collected.all.len(), "with_movement": moving, "signers": collected.people, "terms": terms,
            "body": if options.own_body { PROGRAM_BODY_WORDS } else { SIGNER_BODY_WORDS },
        });
        folder.write_published_file("consent.json", format!("{counts:#}\n").as_bytes())?;
        offline::write_offline_files(&mut folder, options.dictionary_title())?;
        let (files, bytes) = folder.finish_publication()?;
        Ok(PublishedDictionary {
            page: to.join("index.html"),
            signs: collected.all.len(),
            moving,
            signers: collected.people,
            files,
            bytes,
            terms,
            undrawn: written.undrawn,
            namesakes: written.namesakes,
            armless: written.armless,
            cut: written.cut,
            own_body: options.own_body,
            apart: written.apart,
            without_pairs: collected.without_pairs,
            animated: written.animated,
            unanimated: written.unanimated,
            left_out,
        })
    }

    /// Writes pages, data and pictures.
    fn write_dictionary(
        &mut self,
        folder: &mut PublicationFolder,
        found: &DictionaryEntries,
        options: &PublishOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<WrittenSite> {
        let inventories = inventories::load_all_inventories(self.store.read_connection())?;
        let site = DictionarySite {
            title: options.dictionary_title(),
            contact: options.contact.as_deref(),
            own_body: options.own_body,
            inventories: &inventories,
        };
        let mut bodies = DictionaryBodies::new(options.own_body)?;
        let mut moving: Vec<Option<String>> = Vec::with_capacity(found.all.len());
        let mut written = WrittenSite::default();
        for (at, entry) in found.all.iter().enumerate() {
            progress.report_items("writing signs", at, found.all.len())?;
            let shown = match entry.moves {
                EntryMovement::Public => {
                    let shown = bodies.write_stored_sign(self, folder, entry)?;
                    written.armless += usize::from(shown.is_none());
                    shown
                }
                EntryMovement::Notated(token) if !options.without_animation => {
                    let shown = bodies.write_notated_sign(self, folder, entry, token);
                    match shown {
                        Err(CorpusError::Stopped) => return Err(CorpusError::Stopped),
                        Ok(Some(_)) => written.animated += 1,
                        // One notation that cannot be performed is no reason to publish none.
                        Ok(None) | Err(_) => written.unanimated.push(entry.gloss.clone()),
                    }
                    shown.ok().flatten()
                }
                _ => None,
            };
            let body = shown.map(|shown| {
                let named = |flag: bool| flag.then(|| entry.gloss.clone());
                written.cut.extend(named(shown.is_cut));
                written.apart.extend(named(shown.is_apart));
                shown.body
            });
            moving.push(body);
        }
        // A page names the bodies of its minimal pairs, so that all movement is written before.
        for (at, entry) in found.all.iter().enumerate() {
            let notation = entry.notation.as_deref();
            if let Some(picture) = notation.and_then(|text| hamnosys_to_svg(text, NOTATION_HEIGHT_PX)) {
                folder.write_published_file(&format!("sign/{}/notation.svg", entry.name), picture.as_bytes())?;
            }
            let page = site.sign_page_html(at, &found.all, &moving);
            folder.write_published_file(&format!("sign/{}/index.html", entry.name), page.as_bytes())?;
        }
        let equal = self.list_equal_values()?;
        let chosen =
            CHOOSABLE_COMPONENTS.map(|(_, it)| publish_facets::component_facet(it, &found.all, &inventories, &equal));
        let data = write_choices(folder, found, &chosen, &moving, &inventories)?;
        folder.write_published_file("data/signs.js", format!("CH.data({data});\n").as_bytes())?;
        folder.write_published_file("app.js", page_script().as_bytes())?;
        folder.write_published_file("app.css", page_style().as_bytes())?;
        for (name, page) in site.sign_list_pages(&found.all, &moving) {
            folder.write_published_file(&name, page.as_bytes())?;
        }
        folder.write_published_file("index.html", site.index().as_bytes())?;
        let shapes = data["facets"]["h"].as_array();
        let count =
            |fits: &dyn Fn(&Value) -> bool| shapes.map_or(0, |list| list.iter().filter(|shape| fits(shape)).count());
        written.undrawn = count(&|shape| shape.get("pic").is_none());
        written.namesakes = count(&|shape| shape.get("as").is_some());
        written.moving = moving.iter().flatten().count();
        Ok(written)
    }
}

/// Writes the pictures of the choices, and returns the data of the first page.
fn write_choices(
    folder: &mut PublicationFolder,
    found: &DictionaryEntries,
    chosen: &[ComponentFacet<'_>; 3],
    moving: &[Option<String>],
    inventories: &[inventories::StoredInventory],
) -> CorpusResult<Value> {
    let (drawn, spots) = publish_facets::draw_place_panels(&chosen[1])?;
    let mut panels = Vec::new();
    for panel in &drawn {
        folder.write_published_file(&format!("places/{}.png", panel.name), &png(&panel.image)?)?;
        panels.push(json!({
            "name": panel.name, "w": panel.image.image_width(), "h": panel.image.image_height(),
        }));
    }
    let mut values = serde_json::Map::new();
    for ((letter, _), facet) in CHOOSABLE_COMPONENTS.iter().zip(chosen) {
        let mut list = Vec::new();
        for (at, value) in facet.values.iter().enumerate() {
            let mut it = publish_facets::facet_value_document(value);
            if *letter == "h" {
                let known_value = value.known.map(|(_, known)| known);
                let angles = known_value.and_then(|pair| publish_facets::handshape_posture(pair, inventories));
                let like = match angles {
                    Some(_) => None,
                    None => publish_facets::find_handshape_likeness(&value.id, inventories),
                };
                let shape = like.as_ref().map(|likeness| likeness.value).or(known_value);
                let group = shape.map_or("other", publish_facets::handshape_group);
                let has_none = angles.is_none() && like.is_none() && group == "other";
                it["group"] = json!(if has_none { "word" } else { group });
                let drawn = match &like {
                    Some(like) if like.is_namesake => {
                        it["as"] = json!(like.value.id);
                        Some(like.angles)
                    }
                    Some(like) => {
                        it["like"] = json!(like.value.id);
                        None
                    }
                    None => angles,
                };
                if let (Some(angles), Some(name)) = (drawn, &value.picture) {
                    it["pic"] = json!(name);
                    let file = format!("hands/{name}.png");
                    // Values of two inventories may have the same id, and then share a picture.
                    if !folder.has_published_file(&file) {
                        folder.write_published_file(
                            &file,
                            &png(&publish_facets::draw_handshape(
                                &angles,
                                publish_facets::HAND_PICTURE_SIZE_PX,
                            )?)?,
                        )?;
                    }
                }
            }
            if *letter == "p"
                && let Some((panel, [x, y])) = spots[at]
            {
                it["panel"] = json!(panel);
                it["x"] = json!(x);
                it["y"] = json!(y);
            }
            list.push(it);
        }
        values.insert((*letter).to_owned(), json!(list));
    }
    let signs: Vec<Value> = found
        .all
        .iter()
        .enumerate()
        .map(|(at, entry)| index_sign_json(entry, chosen, at, moving[at].as_deref()))
        .collect();
    Ok(json!({ "facets": values, "panels": panels, "signs": signs }))
}

/// Returns a sign as the first page reads it; `body` is the name of its body's file, if it moves.
fn index_sign_json(entry: &DictionaryEntry, chosen: &[ComponentFacet<'_>; 3], at: usize, body: Option<&str>) -> Value {
    let mut it = json!({ "g": entry.gloss });
    // The page assumes that both are the same, which keeps the list small.
    if entry.name != entry.gloss {
        it["d"] = json!(entry.name);
    }
    let texts = std::iter::once(&entry.gloss).chain(entry.texts.iter().map(|(_, text)| text));
    // The script then need not fold every word of the dictionary at each visit.
    let folded: Vec<String> = texts.map(|text| fold_text(text)).collect();
    it["f"] = json!(folded.join("\n"));
    if !entry.texts.is_empty() {
        it["w"] = json!(entry.texts);
    }
    for ((letter, _), facet) in CHOOSABLE_COMPONENTS.iter().zip(chosen) {
        if !facet.of[at].is_empty() {
            it[*letter] = json!(facet.of[at]);
        }
    }
    if !entry.coding.is_empty() {
        let weak = entry.coding.keys().any(|field| field.starts_with("weak."));
        it["n"] = json!(1 + usize::from(weak));
    }
    if let Some(body) = body {
        it["v"] = json!(body);
    }
    it
}

fn png(image: &RasterImage) -> CorpusResult<Vec<u8>> {
    let mut bytes = Vec::new();
    write_palette_png(image, &mut bytes).map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    Ok(bytes)
}

fn licences(terms: &BTreeMap<String, usize>) -> String {
    let mut text = String::from(
        "Terms of use of the signs in this folder; the page of each sign has its own.\n\
         Conditions d’utilisation des signes de ce dossier ; la page de chaque signe a les siennes.\n\n",
    );
    for (it, signs) in terms {
        let (english, french) = match signs {
            1 => ("sign", "signe"),
            _ => ("signs", "signes"),
        };
        text.push_str(&format!("{it}: {signs} {english} · {signs} {french}\n"));
    }
    text
}

fn left_out(found: &DictionaryEntries) -> Vec<LeftOutSigns> {
    let mut reasons: BTreeMap<(LeftOutPart, WithheldReason), Vec<&String>> = BTreeMap::new();
    let lists = [
        (LeftOutPart::Sign, &found.withheld),
        (LeftOutPart::Movement, &found.still),
        (LeftOutPart::Lexicon, &found.unlicensed),
    ];
    for (part, list) in lists {
        for (gloss, why) in list {
            reasons.entry((part, *why)).or_default().push(gloss);
        }
    }
    let row = |((part, why), glosses): ((LeftOutPart, WithheldReason), Vec<&String>)| LeftOutSigns {
        why,
        part,
        signs: glosses.len(),
        first: glosses
            .iter()
            .take(MAX_NAMED_LEFT_OUT)
            .map(|gloss| (*gloss).clone())
            .collect(),
        remedy: consent::withheld_remedy(why),
    };
    reasons.into_iter().map(row).collect()
}

/// Returns the error for a dictionary without signs.
fn empty_dictionary_error(left_out: &[LeftOutSigns]) -> CorpusError {
    // Mending the most frequent reason brings most signs back.
    match left_out.iter().max_by_key(|omission| omission.signs) {
        Some(most) => {
            let all: usize = left_out.iter().map(|omission| omission.signs).sum();
            let text = format!("none of {all} signs may be published");
            CorpusError::from_wrong_message(text).with_advice(most.remedy.clone())
        }
        None => CorpusError::from_wrong_message("no sign is to be published")
            .with_advice("import recordings or a lexicon, or choose other signs"),
    }
}

#[cfg(test)]
mod tests;
