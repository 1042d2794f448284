//! A dictionary of signs as a folder of web pages, which works without a server.
//!
//! Only what everybody may see is published: recordings whose signers agreed, under stated terms (see the module
//! `consent`). The names of signers, recordings and files never reach the folder.

mod bodies;
mod codes;
mod entries;
mod facets;
mod folder;
mod motion;
mod names;
mod offline;
mod pages;
mod source;
mod words;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use chereme_figure::{Image, write_png};
use chereme_sign::Remedy;
use chereme_sign::text::fold;
use serde::Serialize;
use serde_json::{Value, json};

use crate::Corpus;
use crate::consent::{self, Permissions, Withheld};
use crate::db::seals;
use crate::error::{Error, Result};
use crate::inventories;
use crate::progress::{Progress, Step, Unit};

use bodies::Bodies;
use entries::{Entries, Entry, Moves};
use facets::{CHOSEN, Facet};
use folder::Folder;
use pages::{Site, page_script, page_style};

/// The words for the body that plays the signs, in `consent.json`.
const SIGNERS: &str = "that of each signer";
const OWN: &str = "the program's own; rhythm and movement are still the signer's";
/// The most signs of a dictionary.
const MOST: usize = 50_000;
/// How many signs that were left out are named for each reason.
const NAMED: usize = 5;

/// Options of a dictionary.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PublishOptions {
    /// The signs, as a query for their tokens; all signs if `None`.
    pub query: Option<String>,
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
}

impl PublishOptions {
    fn title(&self) -> &str {
        self.title.as_deref().unwrap_or("Signs · Signes")
    }
}

/// A dictionary that was published.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Published {
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
    /// The signs that were left out, by reason.
    pub left_out: Vec<LeftOut>,
}

/// Signs that were left out of a dictionary, or whose movement was.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeftOut {
    /// The reason.
    pub why: Withheld,
    /// Whether only the movement was left out.
    pub movement: bool,
    /// The number of signs.
    pub signs: usize,
    /// The glosses of the first ones.
    pub first: Vec<String>,
    /// The remedy.
    #[serde(serialize_with = "as_text")]
    pub remedy: Remedy,
}

/// The result of writing pages, data and pictures.
#[derive(Default)]
struct Written {
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
}

fn as_text<S: serde::Serializer>(remedy: &Remedy, out: S) -> std::result::Result<S::Ok, S::Error> {
    out.serialize_str(remedy.text())
}

impl Corpus {
    /// Publishes a dictionary of signs as a folder of web pages: search by word, handshape, place and movement, and a
    /// page for each sign with its movement. It opens from a disk and from any web server, and asks no other computer
    /// for anything. The same corpus gives the same bytes. An older publication in the folder is replaced, by one without
    /// signs if none of them may be published any more; files of others stay.
    ///
    /// # Errors
    /// [`Error::Wrong`] if nothing may be published, the query cannot be read, there are more than 50,000 signs, or the
    /// corpus itself lies in the folder; [`Error::File`] if the folder cannot be written; [`Error::Stopped`]. The folder
    /// is as before then. If only the old pages could not be removed, the new ones are in place.
    pub fn publish(
        &mut self,
        to: &Path,
        options: &PublishOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Published> {
        let [own, there] = [self.path(), to].map(fs::canonicalize);
        if own
            .ok()
            .zip(there.ok())
            .is_some_and(|(own, there)| own.starts_with(there))
        {
            return Err(Error::wrong("the corpus itself lies in this folder")
                .at(to.display().to_string())
                .advise("name a folder that holds only what everybody may see"));
        }
        seals::verify_material(self.store.read())?;
        let terms = options.terms.as_deref().map(str::trim);
        let terms = terms.filter(|it| !it.is_empty());
        let permissions = Permissions::of(self.store.read(), terms)?;
        let query = options.query.as_deref().filter(|it| !it.trim().is_empty());
        let found = entries::collect(self, query, &permissions, options.notes, progress)?;
        let left_out = left_out(&found);
        // If every sign of an older publication was withdrawn, its pages may not stay. Without terms nothing was.
        let refused = left_out.iter().any(|it| it.why != Withheld::NoTerms);
        let withdrawn = refused && folder::is_published(to);
        if found.all.is_empty() && !withdrawn {
            return Err(nothing(&left_out));
        }
        if found.all.len() > MOST {
            let text = format!("a dictionary has at most {MOST} signs");
            return Err(Error::wrong(text).advise("choose fewer with a query"));
        }
        let mut folder = Folder::begin(to)?;
        let written = self.write_dictionary(&mut folder, &found, options, progress)?;
        let moving = written.moving;
        let mut terms: BTreeMap<String, usize> = BTreeMap::new();
        for entry in &found.all {
            for it in &entry.terms {
                *terms.entry(it.clone()).or_default() += 1;
            }
        }
        folder.write("LICENCES.txt", licences(&terms).as_bytes())?;
        let counts = json!({
            "signs": found.all.len(), "with_movement": moving, "signers": found.people, "terms": terms,
            "body": if options.own_body { OWN } else { SIGNERS },
        });
        folder.write("consent.json", format!("{counts:#}\n").as_bytes())?;
        offline::write(&mut folder, options.title())?;
        let (files, bytes) = folder.finish()?;
        Ok(Published {
            page: to.join("index.html"),
            signs: found.all.len(),
            moving,
            signers: found.people,
            files,
            bytes,
            terms,
            undrawn: written.undrawn,
            namesakes: written.namesakes,
            armless: written.armless,
            cut: written.cut,
            own_body: options.own_body,
            apart: written.apart,
            without_pairs: found.without_pairs,
            left_out,
        })
    }

    /// Writes pages, data and pictures.
    fn write_dictionary(
        &self,
        folder: &mut Folder,
        found: &Entries,
        options: &PublishOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Written> {
        let inventories = inventories::load(self.store.read())?;
        let site = Site {
            title: options.title(),
            contact: options.contact.as_deref(),
            own_body: options.own_body,
            inventories: &inventories,
        };
        let mut bodies = Bodies::new(options.own_body)?;
        let mut moving = vec![false; found.all.len()];
        let mut written = Written::default();
        for (at, entry) in found.all.iter().enumerate() {
            progress.report(Step {
                task: "writing signs",
                done: at as u64,
                total: Some(found.all.len() as u64),
                unit: Unit::Items,
            })?;
            let mut body = None;
            if entry.moves == Moves::Public {
                match bodies.write(self, folder, entry)? {
                    Some(done) => {
                        body = Some(done.body);
                        let named = |it: bool| it.then(|| entry.gloss.clone());
                        written.cut.extend(named(done.is_cut));
                        written.apart.extend(named(done.is_apart));
                    }
                    None => written.armless += 1,
                }
            }
            moving[at] = body.is_some();
            let page = site.sign(entry, &found.all, body.as_deref());
            folder.write(&format!("sign/{}/index.html", entry.name), page.as_bytes())?;
        }
        let chosen = CHOSEN.map(|(_, it)| facets::facet(it, &found.all, &inventories));
        let data = write_choices(folder, found, &chosen, &moving, &inventories)?;
        folder.write("data/signs.js", format!("CH.data({data});\n").as_bytes())?;
        folder.write("app.js", page_script().as_bytes())?;
        folder.write("app.css", page_style().as_bytes())?;
        folder.write("list.html", site.list(&found.all).as_bytes())?;
        folder.write("index.html", site.index().as_bytes())?;
        let shapes = data["facets"]["h"].as_array();
        let count = |fits: &dyn Fn(&Value) -> bool| {
            shapes.map_or(0, |it| it.iter().filter(|it| fits(it)).count())
        };
        written.undrawn = count(&|it| it.get("pic").is_none());
        written.namesakes = count(&|it| it.get("as").is_some());
        written.moving = moving.iter().filter(|it| **it).count();
        Ok(written)
    }
}

/// Writes the pictures of the choices, and returns the data of the first page.
fn write_choices(
    folder: &mut Folder,
    found: &Entries,
    chosen: &[Facet<'_>; 3],
    moving: &[bool],
    inventories: &[inventories::StoredInventory],
) -> Result<Value> {
    let (drawn, spots) = facets::panels(&chosen[1])?;
    let mut panels = Vec::new();
    for panel in &drawn {
        folder.write(&format!("places/{}.png", panel.name), &png(&panel.image)?)?;
        panels.push(json!({
            "name": panel.name, "w": panel.image.width(), "h": panel.image.height(),
        }));
    }
    let mut values = serde_json::Map::new();
    for ((letter, _), facet) in CHOSEN.iter().zip(chosen) {
        let mut list = Vec::new();
        for (at, value) in facet.values.iter().enumerate() {
            let mut it = facets::document(value);
            if *letter == "h" {
                let known = value.known.map(|(_, known)| known);
                let angles = known.and_then(|it| facets::posture(it, inventories));
                let like = match angles {
                    Some(_) => None,
                    None => facets::likeness(&value.id, inventories),
                };
                let shape = like.as_ref().map(|it| it.value).or(known);
                let group = shape.map_or("other", facets::group);
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
                    if !folder.has(&file) {
                        folder.write(&file, &png(&facets::hand(&angles, facets::HAND)?)?)?;
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
        .map(|(at, entry)| sign(entry, chosen, at, moving[at]))
        .collect();
    Ok(json!({ "facets": values, "panels": panels, "signs": signs }))
}

/// Returns a sign as the first page reads it.
fn sign(entry: &Entry, chosen: &[Facet<'_>; 3], at: usize, moves: bool) -> Value {
    let mut it = json!({ "g": entry.gloss });
    if entry.name != entry.gloss {
        it["d"] = json!(entry.name);
    }
    let texts = std::iter::once(&entry.gloss).chain(entry.texts.iter().map(|(_, text)| text));
    let folded: Vec<String> = texts.map(|it| fold(it)).collect();
    it["f"] = json!(folded.join("\n"));
    if !entry.texts.is_empty() {
        it["w"] = json!(entry.texts);
    }
    for ((letter, _), facet) in CHOSEN.iter().zip(chosen) {
        if !facet.of[at].is_empty() {
            it[*letter] = json!(facet.of[at]);
        }
    }
    if !entry.coding.is_empty() {
        let weak = entry.coding.keys().any(|it| it.starts_with("weak."));
        it["n"] = json!(1 + usize::from(weak));
    }
    if moves {
        it["v"] = json!(1);
    }
    it
}

fn png(image: &Image) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    write_png(image, &mut bytes).map_err(|error| Error::wrong(error.to_string()))?;
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

fn left_out(found: &Entries) -> Vec<LeftOut> {
    let mut reasons: BTreeMap<(bool, Withheld), Vec<&String>> = BTreeMap::new();
    for (list, movement) in [(&found.withheld, false), (&found.still, true)] {
        for (gloss, why) in list {
            reasons.entry((movement, *why)).or_default().push(gloss);
        }
    }
    let row = |((movement, why), glosses): ((bool, Withheld), Vec<&String>)| LeftOut {
        why,
        movement,
        signs: glosses.len(),
        first: glosses.iter().take(NAMED).map(|it| (*it).clone()).collect(),
        remedy: consent::remedy(why),
    };
    reasons.into_iter().map(row).collect()
}

/// Returns the error for a dictionary without signs.
fn nothing(left_out: &[LeftOut]) -> Error {
    match left_out.iter().max_by_key(|it| it.signs) {
        Some(most) => {
            let all: usize = left_out.iter().map(|it| it.signs).sum();
            let text = format!("none of {all} signs may be published");
            Error::wrong(text).advise(most.remedy.clone())
        }
        None => Error::wrong("no sign is to be published")
            .advise("import recordings or a lexicon, or choose other signs"),
    }
}

#[cfg(test)]
mod tests;
