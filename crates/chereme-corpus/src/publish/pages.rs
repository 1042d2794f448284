//! The pages of a dictionary as HTML. They work without a script.

use std::fmt::Write as _;

use crate::db::columns::ValueState;
use crate::inventories::StoredInventory;
use crate::map::escaped;
use crate::page::{filled, quoted};
use crate::words::{Language, fill};
use chereme_sign::InventoryValue;

use super::entries::{Entry, Moves};
use super::facets::known;
use super::names::in_address;
use super::source::MovementSource;
use super::words::{self, in_all, spoken};

const INDEX: &str = include_str!("page/index.html");
const SIGN: &str = include_str!("page/sign.html");
const LIST: &str = include_str!("page/list.html");

/// The code of the script of all pages, in one file.
const SCRIPT: [&str; 5] = [
    include_str!("page/common.js"),
    include_str!("page/offline.js"),
    include_str!("page/search.js"),
    include_str!("page/player.js"),
    include_str!("page/sign.js"),
];
const STYLE: &str = include_str!("page/app.css");

/// Returns the script of all pages, with its texts in every language.
pub(super) fn page_script() -> String {
    let texts = words::script_texts();
    format!(
        "\"use strict\";\nconst TEXTS = {texts};\n{}",
        SCRIPT.join("\n")
    )
}

/// Returns the style of all pages.
pub(super) fn page_style() -> String {
    format!("{STYLE}{}", words::language_styles())
}

/// The policy of each page: a browser may only show files of the same folder.
const POLICY: &str = "default-src 'none'; script-src 'self' file:; style-src 'self' file:; img-src 'self' file: data:; connect-src 'none'; worker-src 'self'; manifest-src 'self'; form-action 'none'; base-uri 'none'";

/// The size of the still picture of a sign, in pixels.
pub(super) const STILL: [usize; 2] = [320, 400];

/// The common content of all pages of a dictionary.
pub(super) struct Site<'a> {
    pub(super) title: &'a str,
    pub(super) contact: Option<&'a str>,
    /// Whether signs play on the program's own body.
    pub(super) own_body: bool,
    pub(super) inventories: &'a [StoredInventory],
}

impl Site<'_> {
    fn page(&self, page: &str, parts: &[(&str, &str)]) -> String {
        let title = escaped(self.title);
        let mut footer = spoken("local");
        if let Some(contact) = self.contact {
            let contact = escaped(contact);
            footer = format!("<p>{} {contact}</p><p>{footer}</p>", spoken("contact"));
        }
        let mut all = vec![
            ("POLICY", POLICY),
            ("TITLE", title.as_str()),
            ("FOOTER", footer.as_str()),
        ];
        all.extend_from_slice(parts);
        filled(page, &all)
    }

    /// Returns the first page.
    pub(super) fn index(&self) -> String {
        let link = format!("<a href=\"list.html\">{}</a>", spoken("all"));
        let noscript = format!("{} {link}", spoken("no-script"));
        self.page(INDEX, &[("NOSCRIPT", &noscript)])
    }

    /// Returns the list of all signs.
    pub(super) fn list(&self, entries: &[Entry]) -> String {
        let mut signs = String::new();
        for entry in entries {
            let texts: Vec<String> = entry.texts.iter().map(|(_, text)| escaped(text)).collect();
            let _ = writeln!(
                signs,
                "<li><a href=\"sign/{}/index.html\">{}</a> {}</li>",
                in_address(&entry.name),
                escaped(&entry.gloss),
                texts.join(", ")
            );
        }
        let count = entries.len();
        let name = if count == 1 {
            "script-sign"
        } else {
            "script-signs"
        };
        let intro = in_all(|language| fill(words::page_text(name, language), &[("n", &count)]));
        self.page(LIST, &[("INTRO", &intro), ("SIGNS", &signs)])
    }

    /// Returns the page of a sign; `body` is the name of its body's file, if it moves.
    pub(super) fn sign(&self, entry: &Entry, entries: &[Entry], body: Option<&str>) -> String {
        let mut texts = String::new();
        for (language, text) in &entry.texts {
            let (language, text) = (quoted(language), escaped(text));
            let _ = write!(texts, "<li lang=\"{language}\">{text}</li>");
        }
        let gloss = quoted(&entry.gloss);
        let (mut stage, mut picture) = (String::new(), String::new());
        if let Some(body) = body {
            let name = quoted(&entry.name);
            stage = format!(" data-motion=\"{name}\" data-body=\"{body}\"");
            let [width, height] = STILL;
            picture = format!(
                "<img src=\"still.png\" width=\"{width}\" height=\"{height}\" alt=\"{gloss}\">"
            );
        }
        let notes = entry.notes.as_ref().map_or(String::new(), |text| {
            format!("<h2>{}</h2><p>{}</p>", spoken("notes"), escaped(text))
        });
        let terms: Vec<String> = entry.terms.iter().map(|it| escaped(it)).collect();
        let terms = format!("{} {}", spoken("terms"), terms.join("; "));
        self.page(
            SIGN,
            &[
                ("GLOSS", &gloss),
                ("WORDS", &texts),
                ("STAGE", &stage),
                ("PICTURE", &picture),
                ("FORM", &self.form(entry)),
                ("PAIRS", &self.pairs(entry, entries)),
                ("NOTES", &notes),
                ("SOURCE", &spoken("source")),
                ("ORIGIN", &self.origin(entry, body.is_some())),
                ("TERMS", &terms),
            ],
        )
    }

    /// Returns the values of a sign in words.
    fn form(&self, entry: &Entry) -> String {
        let mut rows = String::new();
        for row in &entry.values {
            let Some(id) = row
                .value
                .as_deref()
                .filter(|_| row.state == ValueState::Value)
            else {
                continue;
            };
            let feature = row.feature.as_deref();
            let field =
                |language| words::field(row.component, feature, row.hand, row.phase, language);
            let value = match known(self.inventories, row) {
                Some((_, value)) => named_value(value),
                None => escaped(id),
            };
            let _ = write!(rows, "<dt>{}</dt><dd>{value}</dd>", in_all(field));
        }
        match rows.is_empty() {
            true => rows,
            false => format!("<h2>{}</h2><dl>{rows}</dl>", spoken("form")),
        }
    }

    fn pairs(&self, entry: &Entry, entries: &[Entry]) -> String {
        let mut rows = String::new();
        for (other, field) in &entry.pairs {
            let other = &entries[*other];
            let value = |of: &Entry| {
                let value = of.coding.get(field).map(String::as_str);
                value.filter(|it| !it.is_empty()).unwrap_or("–").to_owned()
            };
            let _ = write!(
                rows,
                "<li><a class=\"pair\" href=\"../{}/index.html\">{}</a> ({}: {} → {})</li>",
                in_address(&other.name),
                escaped(&other.gloss),
                in_all(|language| words::coded_field(field, language)),
                escaped(&value(entry)),
                escaped(&value(other)),
            );
        }
        match rows.is_empty() {
            true => rows,
            false => format!(
                "<h2>{}</h2><ul class=\"pairs\">{rows}</ul>",
                spoken("pairs")
            ),
        }
    }

    /// Returns the origin of a sign's movement, the number of its signer, and the body on which it is shown.
    fn origin(&self, entry: &Entry, shown: bool) -> String {
        let mut text = match (entry.moves, entry.source) {
            (Moves::Withheld, _) => spoken("held"),
            (Moves::Never, _) => spoken("listed"),
            (Moves::Public, _) if !shown => spoken("unshown"),
            (_, MovementSource::Capture) => spoken("captured"),
            (_, MovementSource::Captures) => spoken("made"),
            (_, MovementSource::Notation) => spoken("notated"),
            (_, MovementSource::Program) => spoken("generated"),
        };
        if let Some(person) = entry.person.filter(|_| shown) {
            text.push_str(&format!(" ({} {person})", spoken("signer")));
            if self.own_body {
                text.push_str(&format!("</p><p>{}", spoken("own-body")));
            }
        }
        text
    }
}

/// Returns a value's id with its name, unless they are alike.
fn named_value(value: &InventoryValue) -> String {
    let name = |language: Language| value.name(language.code()).to_owned();
    let names = in_all(name);
    match names.replace(' ', "-") == escaped(&value.id) {
        true => escaped(&value.id),
        false => format!("{names} <small>{}</small>", escaped(&value.id)),
    }
}
