//! The pages of a dictionary as HTML. They work without a script.

use std::fmt::Write as _;

use crate::db::stored_columns::ValueState;
use crate::inventories::StoredInventory;
use crate::map::escape_markup;
use crate::page::{fill_page_parts, quote_page_text};
use crate::words::{InterfaceLanguage, fill_text_braces};
use chereme_sign::InventoryValue;

use super::entries::{DictionaryEntry, EntryMovement};
use super::publish_facets::find_known_value;
use super::publish_names::in_address;
use super::publish_source::MovementSource;
use super::publish_words::{self, in_all, page_text_all_languages};

const INDEX_PAGE_HTML: &str = include_str!("page/index.html");
const SIGN_PAGE_HTML: &str = include_str!("page/sign.html");
const LIST_PAGE_HTML: &str = include_str!("page/list.html");

/// The code of the script of all pages, in one file.
const SITE_SCRIPT_PARTS: [&str; 5] = [
    include_str!("page/common.js"),
    include_str!("page/offline.js"),
    include_str!("page/search.js"),
    include_str!("page/player.js"),
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
pub(super) const STILL_PICTURE_SIZE_PX: [usize; 2] = [320, 400];

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

    /// Returns the list of all signs.
    pub(super) fn sign_list_page(&self, entries: &[DictionaryEntry]) -> String {
        let mut signs = String::new();
        for entry in entries {
            let texts: Vec<String> = entry.texts.iter().map(|(_, text)| escape_markup(text)).collect();
            let _ = writeln!(
                signs,
                "<li><a href=\"sign/{}/index.html\">{}</a> {}</li>",
                in_address(&entry.name),
                escape_markup(&entry.gloss),
                texts.join(", ")
            );
        }
        let count = entries.len();
        let name = if count == 1 { "script-sign" } else { "script-signs" };
        let intro = in_all(|language| fill_text_braces(publish_words::page_text(name, language), &[("n", &count)]));
        self.fill_site_page(LIST_PAGE_HTML, &[("INTRO", &intro), ("SIGNS", &signs)])
    }

    /// Returns the page of a sign; `body` is the name of its body's file, if it moves.
    pub(super) fn sign_page_html(
        &self,
        entry: &DictionaryEntry,
        entries: &[DictionaryEntry],
        body: Option<&str>,
    ) -> String {
        let mut texts = String::new();
        for (language, text) in &entry.texts {
            let (language, text) = (quote_page_text(language), escape_markup(text));
            let _ = write!(texts, "<li lang=\"{language}\">{text}</li>");
        }
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
                ("WORDS", &texts),
                ("STAGE", &stage),
                ("PICTURE", &picture),
                ("FORM", &self.sign_form_html(entry)),
                ("PAIRS", &self.sign_pairs_html(entry, entries)),
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

    fn sign_pairs_html(&self, entry: &DictionaryEntry, entries: &[DictionaryEntry]) -> String {
        let mut rows = String::new();
        for (other, field) in &entry.pairs {
            let other = &entries[*other];
            let value = |of: &DictionaryEntry| {
                let value = of.coding.get(field).map(String::as_str);
                value.filter(|text| !text.is_empty()).unwrap_or("–").to_owned()
            };
            let _ = write!(
                rows,
                "<li><a class=\"pair\" href=\"../{}/index.html\">{}</a> ({}: {} → {})</li>",
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

/// Returns a value's id with its name, unless they are alike.
fn named_value(value: &InventoryValue) -> String {
    let name = |language: InterfaceLanguage| value.value_name_in(language.language_code()).to_owned();
    let names = in_all(name);
    match names.replace(' ', "-") == escape_markup(&value.id) {
        true => escape_markup(&value.id),
        false => format!("{names} <small>{}</small>", escape_markup(&value.id)),
    }
}
