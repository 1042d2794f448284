//! The pages of a dictionary as HTML. They work without a script.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::db::stored_attributes::{AttributeRow, MEASURE_PREFIX};
use crate::db::stored_columns::ValueState;
use crate::inventories::StoredInventory;
use crate::map::escape_markup;
use crate::page::{fill_page_parts, quote_page_text};
use crate::words::{InterfaceLanguage, fill_text_braces};
use chereme_sign::InventoryValue;
use chereme_sign::hamnosys;
use chereme_sign::text::fold_text;

use super::entries::{DictionaryEntry, EntryMovement};
use super::publish_facets::find_known_value;
use super::publish_names::in_address;
use super::publish_source::MovementSource;
use super::publish_words::{self, in_all, page_text_all_languages};

const INDEX_PAGE_HTML: &str = include_str!("page/index.html");
const SIGN_PAGE_HTML: &str = include_str!("page/sign.html");
const LIST_PAGE_HTML: &str = include_str!("page/list.html");

/// The code of the script of all pages, in one file.
const SITE_SCRIPT_PARTS: [&str; 8] = [
    include_str!("page/common.js"),
    include_str!("page/offline.js"),
    include_str!("page/bones.js"),
    include_str!("page/draw.js"),
    include_str!("page/player.js"),
    include_str!("page/cards.js"),
    include_str!("page/search.js"),
    include_str!("page/sign.js"),
];
const SITE_STYLE_CSS: &str = include_str!("page/app.css");

/// Returns the script of all pages, with its texts in every language.
pub(super) fn page_script() -> String {
    let texts = publish_words::script_texts();
    format!(
        "\"use strict\";\nconst TEXTS = {texts};\n{}",
        SITE_SCRIPT_PARTS.join("\n")
    )
}

/// Returns the style of all pages.
pub(super) fn page_style() -> String {
    format!("{SITE_STYLE_CSS}{}", publish_words::language_styles())
}

/// The policy of each page: a browser may only show files of the same folder.
const CONTENT_SECURITY_POLICY: &str = "default-src 'none'; script-src 'self' file:; style-src 'self' file:; img-src 'self' file: data:; connect-src 'none'; worker-src 'self'; manifest-src 'self'; form-action 'none'; base-uri 'none'";

/// The size of the still picture of a sign, in pixels.
pub(super) const STILL_PICTURE_SIZE_PX: [usize; 2] = [240, 300];

/// The most signs on one page of the list of all signs.
const MAX_LIST_PAGE_SIGNS: usize = 400;

/// The common content of all pages of a dictionary.
pub(super) struct DictionarySite<'a> {
    pub(super) title: &'a str,
    pub(super) contact: Option<&'a str>,
    /// Whether signs play on the program's own body.
    pub(super) own_body: bool,
    pub(super) inventories: &'a [StoredInventory],
}

impl DictionarySite<'_> {
    fn fill_site_page(&self, page: &str, parts: &[(&str, &str)]) -> String {
        let title = escape_markup(self.title);
        let mut footer = page_text_all_languages("local");
        if let Some(contact) = self.contact {
            let contact = escape_markup(contact);
            footer = format!("<p>{} {contact}</p><p>{footer}</p>", page_text_all_languages("contact"));
        }
        let mut all = vec![
            ("POLICY", CONTENT_SECURITY_POLICY),
            ("TITLE", title.as_str()),
            ("FOOTER", footer.as_str()),
        ];
        all.extend_from_slice(parts);
        fill_page_parts(page, &all)
    }

    /// Returns the first page.
    pub(super) fn index(&self) -> String {
        let link = format!("<a href=\"list.html\">{}</a>", page_text_all_languages("all"));
        let noscript = format!("{} {link}", page_text_all_languages("no-script"));
        self.fill_site_page(INDEX_PAGE_HTML, &[("NOSCRIPT", &noscript)])
    }

    /// Returns the pages of all signs in the order of their letters, each with its name: one page, or one for each letter
    /// if there are many signs. The first is `list.html`.
    pub(super) fn sign_list_pages(
        &self,
        entries: &[DictionaryEntry],
        moving: &[Option<String>],
    ) -> Vec<(String, String)> {
        let mut signs_by_letter: BTreeMap<String, Vec<(String, String)>> = BTreeMap::new();
        for (entry, body) in entries.iter().zip(moving) {
            let item = (fold_text(&entry.gloss), list_item_html(entry, body.is_some()));
            signs_by_letter.entry(list_letter(&entry.gloss)).or_default().push(item);
        }
        let letters = signs_by_letter.into_iter().map(|(letter, mut signs)| {
            signs.sort();
            (letter, signs.into_iter().map(|(_, item)| item).collect::<String>())
        });
        let letters: Vec<(String, String)> = letters.collect();
        let is_parted = entries.len() > MAX_LIST_PAGE_SIGNS;
        let page_name = |at: usize| match at {
            0 => "list.html".to_owned(),
            _ => format!("list-{}.html", at + 1),
        };
        let link = |(at, (letter, _)): (usize, &(String, String))| {
            let page = if is_parted { page_name(at) } else { String::new() };
            format!("<a href=\"{page}#l{at}\">{}</a> ", escape_markup(letter))
        };
        let links: String = letters.iter().enumerate().map(link).collect();
        let section = |(at, (letter, signs)): (usize, &(String, String))| {
            let letter = escape_markup(letter);
            format!("<h2 id=\"l{at}\">{letter}</h2><ul class=\"all\">\n{signs}</ul>\n")
        };
        let sections: Vec<String> = letters.iter().enumerate().map(section).collect();
        let count = entries.len();
        let name = if count == 1 { "script-sign" } else { "script-signs" };
        let intro = in_all(|language| fill_text_braces(publish_words::page_text(name, language), &[("n", &count)]));
        let list_page = |signs: &str| {
            self.fill_site_page(
                LIST_PAGE_HTML,
                &[("INTRO", &intro), ("LETTERS", &links), ("SIGNS", signs)],
            )
        };
        match is_parted {
            false => vec![(page_name(0), list_page(&sections.concat()))],
            true => sections
                .iter()
                .enumerate()
                .map(|(at, signs)| (page_name(at), list_page(signs)))
                .collect(),
        }
    }

    /// Returns the page of the sign at a place of `entries`; `moving` has the name of each one's body, if it moves.
    pub(super) fn sign_page_html(&self, at: usize, entries: &[DictionaryEntry], moving: &[Option<String>]) -> String {
        let (entry, body) = (&entries[at], moving[at].as_deref());
        let sentences = match entry.sentences.is_empty() {
            true => String::new(),
            false => format!(
                "<h2>{}</h2><ul>{}</ul>",
                page_text_all_languages("sentences"),
                text_items_html(&entry.sentences)
            ),
        };
        let gloss = quote_page_text(&entry.gloss);
        let (mut stage, mut picture) = (String::new(), String::new());
        if let Some(body) = body {
            let name = quote_page_text(&entry.name);
            stage = format!(" data-motion=\"{name}\" data-body=\"{body}\"");
            let [width, height] = STILL_PICTURE_SIZE_PX;
            picture = format!("<img src=\"still.png\" width=\"{width}\" height=\"{height}\" alt=\"{gloss}\">");
        }
        let notes = entry.notes.as_ref().map_or(String::new(), |text| {
            format!(
                "<h2>{}</h2><p>{}</p>",
                page_text_all_languages("notes"),
                escape_markup(text)
            )
        });
        let escaped_terms: Vec<String> = entry.terms.iter().map(|term| escape_markup(term)).collect();
        let terms = format!("{} {}", page_text_all_languages("terms"), escaped_terms.join("; "));
        self.fill_site_page(
            SIGN_PAGE_HTML,
            &[
                ("GLOSS", &gloss),
                ("WORDS", &text_items_html(&entry.texts)),
                ("SENTENCES", &sentences),
                ("STAGE", &stage),
                ("PICTURE", &picture),
                ("FORM", &self.sign_form_html(entry)),
                ("NOTATION", &sign_notation_html(entry)),
                ("ATTRIBUTES", &sign_attributes_html(entry)),
                ("RELATIONS", &sign_relations_html(entry, entries)),
                ("PAIRS", &self.sign_pairs_html(entry, entries, moving)),
                ("NEIGHBOURS", &sign_neighbours_html(at, entries)),
                ("NOTES", &notes),
                ("SOURCE", &page_text_all_languages("source")),
                ("ORIGIN", &self.movement_origin_html(entry, body.is_some())),
                ("TERMS", &terms),
            ],
        )
    }

    /// Returns the values of a sign in words.
    fn sign_form_html(&self, entry: &DictionaryEntry) -> String {
        let mut rows = String::new();
        for row in &entry.values {
            let Some(id) = row.value.as_deref().filter(|_| row.state == ValueState::Value) else {
                continue;
            };
            let feature = row.feature.as_deref();
            let field =
                |language| publish_words::value_field_words(row.component, feature, row.hand, row.phase, language);
            let value = match find_known_value(self.inventories, row) {
                Some((_, value)) => named_value(value),
                None => escape_markup(id),
            };
            let _ = write!(rows, "<dt>{}</dt><dd>{value}</dd>", in_all(field));
        }
        match rows.is_empty() {
            true => rows,
            false => format!("<h2>{}</h2><dl>{rows}</dl>", page_text_all_languages("form")),
        }
    }

    fn sign_pairs_html(
        &self,
        entry: &DictionaryEntry,
        entries: &[DictionaryEntry],
        moving: &[Option<String>],
    ) -> String {
        let mut rows = String::new();
        for (other, field) in &entry.pairs {
            let body = moving[*other].as_deref();
            let other = &entries[*other];
            let beside = body.map_or(String::new(), |body| {
                let [name, gloss] = [&other.name, &other.gloss].map(|text| quote_page_text(text));
                format!(
                    " <button type=\"button\" class=\"beside\" hidden data-t=\"beside\" data-motion=\"{name}\" data-body=\"{body}\" data-gloss=\"{gloss}\"></button>"
                )
            });
            let value = |of: &DictionaryEntry| {
                let value = of.coding.get(field).map(String::as_str);
                value.filter(|text| !text.is_empty()).unwrap_or("–").to_owned()
            };
            let _ = write!(
                rows,
                "<li><a class=\"own\" href=\"../{}/index.html\">{}</a> <span class=\"differs\">({}: {} → {})</span>{beside}</li>",
                in_address(&other.name),
                escape_markup(&other.gloss),
                in_all(|language| publish_words::coded_field(field, language)),
                escape_markup(&value(entry)),
                escape_markup(&value(other)),
            );
        }
        match rows.is_empty() {
            true => rows,
            false => format!(
                "<h2>{}</h2><ul class=\"pairs\">{rows}</ul>",
                page_text_all_languages("pairs")
            ),
        }
    }

    /// Returns the origin of a sign's movement, the number of its signer, and the body on which it is shown.
    fn movement_origin_html(&self, entry: &DictionaryEntry, shown: bool) -> String {
        let mut text = match (entry.moves, entry.source) {
            (EntryMovement::Withheld, _) => page_text_all_languages("held"),
            (EntryMovement::Never, _) => page_text_all_languages("listed"),
            (EntryMovement::Notated(_), _) if !shown => page_text_all_languages("listed"),
            (EntryMovement::Public, _) if !shown => page_text_all_languages("unshown"),
            (_, MovementSource::Capture) => page_text_all_languages("captured"),
            (_, MovementSource::Captures) => page_text_all_languages("made"),
            (_, MovementSource::Notation) => page_text_all_languages("notated"),
            (_, MovementSource::Program) => page_text_all_languages("generated"),
        };
        if let Some(person) = entry.person.filter(|_| shown) {
            text.push_str(&format!(" ({} {person})", page_text_all_languages("signer")));
            if self.own_body {
                text.push_str(&format!("</p><p>{}", page_text_all_languages("own-body")));
            }
        }
        text
    }
}

/// Returns the notation of a sign: its picture, whose text has the names of its symbols.
fn sign_notation_html(entry: &DictionaryEntry) -> String {
    let Some(text) = entry
        .notation
        .as_ref()
        .filter(|text| hamnosys::drawing::draw_hamnosys_text(text).is_some())
    else {
        return String::new();
    };
    let names = hamnosys::to_names(text).unwrap_or_default().join(" ");
    let (title, names) = (page_text_all_languages("notation"), quote_page_text(&names));
    format!("<h2>{title}</h2><p><img class=\"notation\" src=\"notation.svg\" alt=\"{names}\"></p>")
}

/// Returns the attributes of a sign, each with its text.
fn sign_attributes_html(entry: &DictionaryEntry) -> String {
    let row = |attribute: &AttributeRow| {
        let name = attribute.name.strip_prefix(MEASURE_PREFIX).unwrap_or(&attribute.name);
        format!(
            "<dt>{}</dt><dd>{}</dd>",
            escape_markup(name),
            escape_markup(&attribute.text)
        )
    };
    let rows: String = entry.attributes.iter().map(row).collect();
    match rows.is_empty() {
        true => rows,
        false => format!("<h2>{}</h2><dl>{rows}</dl>", page_text_all_languages("attributes")),
    }
}

/// Returns the relations of a sign to others of the dictionary, with links.
fn sign_relations_html(entry: &DictionaryEntry, entries: &[DictionaryEntry]) -> String {
    let mut rows = String::new();
    for (name, other) in &entry.relations {
        let (words, other) = (page_text_all_languages(&format!("relation-{name}")), &entries[*other]);
        let (place, gloss) = (in_address(&other.name), escape_markup(&other.gloss));
        let _ = write!(
            rows,
            "<li>{words} <a class=\"own\" href=\"../{place}/index.html\">{gloss}</a></li>"
        );
    }
    match rows.is_empty() {
        true => rows,
        false => format!("<h2>{}</h2><ul>{rows}</ul>", page_text_all_languages("relations")),
    }
}

/// Returns texts as items of a list, each marked with its language.
fn text_items_html(texts: &[(String, String)]) -> String {
    let item = |(language, text): &(String, String)| {
        let (language, text) = (quote_page_text(language), escape_markup(text));
        format!("<li lang=\"{language}\">{text}</li>")
    };
    texts.iter().map(item).collect()
}

/// Returns the links to the signs before and after one.
fn sign_neighbours_html(at: usize, entries: &[DictionaryEntry]) -> String {
    let neighbour = |place: Option<usize>, relation: &str, [before, after]: [&str; 2]| {
        let other = place.and_then(|place| entries.get(place));
        other.map_or(String::new(), |other| {
            let (name, gloss) = (in_address(&other.name), escape_markup(&other.gloss));
            let says = page_text_all_languages(&format!("{relation}-sign"));
            format!(
                "<a class=\"own\" rel=\"{relation}\" href=\"../{name}/index.html\">{before}<span class=\"says\">{says}: </span>{gloss}{after}</a> "
            )
        })
    };
    neighbour(at.checked_sub(1), "prev", ["← ", ""]) + &neighbour(Some(at + 1), "next", ["", " →"])
}

/// Returns a sign of the list of all signs.
fn list_item_html(entry: &DictionaryEntry, moves: bool) -> String {
    let address = in_address(&entry.name);
    let picture = match moves {
        true => format!("<img src=\"sign/{address}/still.png\" width=\"64\" height=\"80\" alt=\"\" loading=\"lazy\">"),
        false => String::new(),
    };
    let texts: Vec<String> = entry.texts.iter().map(|(_, text)| escape_markup(text)).collect();
    format!(
        "<li><a href=\"sign/{address}/index.html\">{picture}{}</a> {}</li>\n",
        escape_markup(&entry.gloss),
        texts.join(", ")
    )
}

/// Returns the letter under which a gloss stands in the list: the first one in its plain form, `#` for anything else.
fn list_letter(gloss: &str) -> String {
    let first = fold_text(gloss).chars().find(|letter| letter.is_alphanumeric());
    first
        .filter(|letter| letter.is_alphabetic())
        .map_or("#".to_owned(), |letter| letter.to_uppercase().collect())
}

/// Returns a value's id with its name, unless they are alike.
fn named_value(value: &InventoryValue) -> String {
    let name = |language: InterfaceLanguage| value.value_name_in(language.language_code()).to_owned();
    let names = in_all(name);
    match names.replace(' ', "-") == escape_markup(&value.id) {
        true => escape_markup(&value.id),
        false => format!("{names} <small>{}</small>", escape_markup(&value.id)),
    }
}
