//! Messages with an id, filled with values: the files `history.ftl` and `nouns.ftl` of a language.
//!
//! A message may choose among variants by a value, as Fluent does: by the value itself, or by `one` for a number that takes
//! the singular in this language.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use chereme_sign::words::folders::{is_sentence, language_files};
use fluent_syntax::ast::{Entry, Expression, InlineExpression, Pattern, PatternElement, Variant, VariantKey};
use fluent_syntax::parser;

use super::InterfaceLanguage;
use super::count::is_singular;

/// The messages of a language by their ids.
type MessagePatterns = BTreeMap<&'static str, Pattern<&'static str>>;

/// Returns the message with this id in `language`, its variable parts filled by `value`, which gets their names; in
/// English if the files of the language lack it, and nothing if there is no such message.
pub(super) fn filled_sentence(id: &str, language: InterfaceLanguage, value: &dyn Fn(&str) -> String) -> Option<String> {
    let language_pattern = |language: InterfaceLanguage| Some((language, load_message_patterns(language).get(id)?));
    let (language, pattern) = language_pattern(language).or_else(|| language_pattern(InterfaceLanguage::English))?;
    Some(filled_pattern(pattern, language, value))
}

/// Returns the messages of the files; a damaged entry is left out, and a test finds it.
pub(super) fn load_message_patterns(language: InterfaceLanguage) -> &'static MessagePatterns {
    static SENTENCES_BY_CODE: OnceLock<BTreeMap<&str, MessagePatterns>> = OnceLock::new();
    static NO_SENTENCES: MessagePatterns = MessagePatterns::new();
    let all = SENTENCES_BY_CODE.get_or_init(|| {
        let codes = language_files().keys().map(String::as_str);
        codes.map(|code| (code, read_sentences(code))).collect()
    });
    all.get(language.language_code()).unwrap_or(&NO_SENTENCES)
}

fn read_sentences(code: &str) -> MessagePatterns {
    let files = language_files().get(code);
    let texts = files.into_iter().flat_map(|files| files.sentence_texts());
    let entries = texts.flat_map(|text| {
        let (Ok(resource) | Err((resource, _))) = parser::parse(text);
        resource.body
    });
    let messages = entries.filter_map(|entry| match entry {
        Entry::Message(message) => Some((message.id.name, message.value?)),
        _ => None,
    });
    messages.filter(|(id, _)| is_sentence(id)).collect()
}

fn filled_pattern(pattern: &Pattern<&str>, language: InterfaceLanguage, value: &dyn Fn(&str) -> String) -> String {
    let part = |element: &PatternElement<&str>| match element {
        PatternElement::TextElement { value } => (*value).to_owned(),
        PatternElement::Placeable { expression } => match expression {
            Expression::Inline(InlineExpression::VariableReference { id }) => value(id.name),
            Expression::Inline(InlineExpression::StringLiteral { value }) => (*value).to_owned(),
            Expression::Select {
                selector: InlineExpression::VariableReference { id },
                variants,
            } => chosen_variant(variants, &value(id.name), language)
                .map_or_else(String::new, |variant| filled_pattern(&variant.value, language, value)),
            // Nothing else stands in the files; a test fills them all.
            _ => "{}".to_owned(),
        },
    };
    pattern.elements.iter().map(part).collect()
}

fn chosen_variant<'v>(
    variants: &'v [Variant<&'v str>],
    value: &str,
    language: InterfaceLanguage,
) -> Option<&'v Variant<&'v str>> {
    let singular = value.parse().is_ok_and(|count| is_singular(count, language));
    let with_key = |wanted: &str| {
        variants.iter().find(|variant| match variant.key {
            VariantKey::Identifier { name: key } | VariantKey::NumberLiteral { value: key } => key == wanted,
        })
    };
    with_key(value)
        .or_else(|| with_key("one").filter(|_| singular))
        .or_else(|| variants.iter().find(|variant| variant.default))
}
