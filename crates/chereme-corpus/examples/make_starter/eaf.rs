//! Writes the notes of a take as EAF: tiers with ELAN's stereotypes, vocabularies in English and French.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::eaf::eaf_convert::{
    AnnotationAddress, AnnotationTiming, ControlledVocabulary, TranscriptAnnotation, TranscriptTier, VocabularyEntry,
    VocabularyEntryValue,
};
use chereme_formats::eaf::{AnnotationTranscript, eaf_document_from_transcript, eaf_raw};
use chereme_motion::{BodySide, TimeSpan};
use chereme_sign::TierStereotype;
use chereme_sign::inventory::builtin_by_id;

use super::notes::{Note, PHASE, TIERS};
use super::signer;
use super::takes::Take;

/// The date of the first version, which is fixed so that files do not change from day to day.
const DATE: &str = "2025-11-21T00:00:00Z";
/// The licence of the generated files.
pub(crate) const LICENCE: &str = "CC0-1.0";
const PHASES: [(&str, &str, &str); 4] = [
    (
        "preparation",
        "the hand comes to where the sign starts",
        "la main rejoint le début du signe",
    ),
    ("stroke", "the hand makes the sign", "la main fait le signe"),
    (
        "hold",
        "the hand stays at the end of the sign",
        "la main reste à la fin du signe",
    ),
    ("retraction", "the hand goes back to rest", "la main retourne au repos"),
];

/// The values that any take uses, by inventory.
pub(crate) type Used = BTreeMap<&'static str, BTreeSet<String>>;

/// Adds the values of `notes` to those in use.
pub(crate) fn count(notes: &[Note], used: &mut Used) {
    for note in notes {
        if let Some(inventory) = TIERS[note.tier].inventory {
            used.entry(inventory).or_default().insert(note.value.clone());
        }
    }
}

/// Returns the bytes of the file for `take`.
pub(crate) fn write(take: &Take, signs: &[TimeSpan], notes: &[Note], used: &Used) -> Vec<u8> {
    let mut builder = Builder::default();
    if let Some([french, english]) = take.phrase {
        builder.phrase(signs, french, english);
    }
    let gloss = builder.glosses(take, signs);
    for side in [Some(BodySide::Right), Some(BodySide::Left), None] {
        for (at, kind) in TIERS.iter().enumerate() {
            if kind.name.contains('@') == side.is_some() && at != PHASE {
                let said = notes.iter().filter(|note| note.tier == at && note.side == side);
                builder.notes(at, side, said, Some(gloss));
            }
        }
    }
    for side in BodySide::BOTH_SIDES {
        let said = notes
            .iter()
            .filter(|note| note.tier == PHASE && note.side == Some(side));
        builder.notes(PHASE, Some(side), said, None);
    }
    let transcript = AnnotationTranscript {
        author: "make_starter".to_owned(),
        date: DATE.to_owned(),
        properties: properties(take),
        tiers: builder.tiers,
        vocabularies: vocabularies(used),
        ..AnnotationTranscript::default()
    };
    let mut bytes = Vec::new();
    eaf_raw::write_eaf_document(&eaf_document_from_transcript(&transcript, &template()), &mut bytes)
        .expect("memory takes every byte");
    bytes
}

fn properties(take: &Take) -> Vec<(String, String)> {
    let all = [
        ("chereme.origin", "generated"),
        ("chereme.licence", LICENCE),
        ("chereme.signer", signer::NAME),
        ("chereme.handedness", "right"),
        ("chereme.about", take.about),
    ];
    all.map(|(name, value)| (name.to_owned(), value.to_owned())).to_vec()
}

fn template() -> eaf_raw::EafDocument<'static> {
    let language = |id: &'static str, label: &'static str| eaf_raw::EafLanguage {
        id: id.into(),
        label: Some(label.into()),
        ..eaf_raw::EafLanguage::default()
    };
    eaf_raw::EafDocument {
        licenses: vec![eaf_raw::EafLicense {
            url: "https://creativecommons.org/publicdomain/zero/1.0/".into(),
            text: "Made by a program, dedicated to the public domain (CC0 1.0).".into(),
            ..eaf_raw::EafLicense::default()
        }],
        languages: vec![language("eng", "English (eng)"), language("fra", "French (fra)")],
        ..eaf_raw::EafDocument::default()
    }
}

#[derive(Default)]
struct Builder {
    tiers: Vec<TranscriptTier>,
    count: u32,
}

impl Builder {
    fn tier(&mut self, name: String, kind: &str, parent: Option<(usize, TierStereotype)>) -> usize {
        self.tiers.push(TranscriptTier {
            name,
            kind: kind.to_owned(),
            parent: parent.map(|(parent, _)| parent),
            stereotype: parent.map(|(_, stereotype)| stereotype),
            participant: Some(signer::NAME.to_owned()),
            ..TranscriptTier::default()
        });
        self.tiers.len() - 1
    }

    fn add(
        &mut self,
        tier: usize,
        span: TimeSpan,
        value: &str,
        parent: Option<AnnotationAddress>,
    ) -> AnnotationAddress {
        self.count += 1;
        let symbolic = self.tiers[tier].stereotype == Some(TierStereotype::SymbolicAssociation);
        let entry = self.tiers[tier].vocabulary.as_ref().map(|_| value.to_owned());
        self.tiers[tier].annotations.push(TranscriptAnnotation {
            id: format!("a{}", self.count),
            span,
            timing: if symbolic {
                AnnotationTiming::Parent
            } else {
                AnnotationTiming::Own
            },
            parent,
            order: 0,
            value: value.to_owned(),
            entry,
            language: None,
            external_ref: None,
            millis: None,
        });
        AnnotationAddress {
            tier,
            index: self.tiers[tier].annotations.len() - 1,
        }
    }

    fn phrase(&mut self, signs: &[TimeSpan], french: &str, english: &str) {
        let (Some(first), Some(last)) = (signs.first(), signs.last()) else {
            return;
        };
        let whole = TimeSpan::span_between(first.span_start_instant(), last.span_end_instant());
        let tier = self.tier("Phrase FR".to_owned(), "phrase", None);
        self.tiers[tier].language = Some("fra".to_owned());
        let place = self.add(tier, whole, french, None);
        let below = Some((tier, TierStereotype::SymbolicAssociation));
        let tier = self.tier("Phrase EN".to_owned(), "phrase translation", below);
        self.tiers[tier].language = Some("eng".to_owned());
        self.add(tier, whole, english, Some(place));
    }

    fn glosses(&mut self, take: &Take, signs: &[TimeSpan]) -> usize {
        let gloss = self.tier("Gloss".to_owned(), "gloss", None);
        let below = Some((gloss, TierStereotype::SymbolicAssociation));
        let tiers = [("FR", "fra"), ("EN", "eng")].map(|(name, language)| {
            let tier = self.tier(format!("Translation {name}"), "translation", below);
            self.tiers[tier].language = Some(language.to_owned());
            tier
        });
        for (sign, span) in take.signs.iter().zip(signs) {
            let place = self.add(gloss, *span, &sign.gloss, None);
            for (tier, means) in tiers.into_iter().zip(sign.means) {
                self.add(tier, *span, means, Some(place));
            }
        }
        gloss
    }

    fn notes<'n>(
        &mut self,
        at: usize,
        side: Option<BodySide>,
        notes: impl Iterator<Item = &'n Note>,
        gloss: Option<usize>,
    ) {
        let kind = &TIERS[at];
        let hand = match side {
            Some(BodySide::Left) => "LH",
            _ => "RH",
        };
        let parent = gloss.map(|gloss| (gloss, TierStereotype::IncludedIn));
        let tier = self.tier(kind.name.replace('@', hand), &kind.kind(), parent);
        self.tiers[tier].vocabulary = Some(kind.inventory.unwrap_or("phases").to_owned());
        for note in notes {
            let parent = gloss.map(|tier| AnnotationAddress { tier, index: note.sign });
            self.add(tier, note.span, &note.value, parent);
        }
    }
}

fn vocabularies(used: &Used) -> Vec<ControlledVocabulary> {
    let mut all: Vec<ControlledVocabulary> = TIERS
        .iter()
        .filter_map(|kind| {
            let id = kind.inventory?;
            let inventory = builtin_by_id(id)?;
            let values = inventory
                .values
                .iter()
                .filter(|value| used.get(id).is_some_and(|used| used.contains(value.id.as_str())));
            Some(ControlledVocabulary {
                id: id.to_owned(),
                descriptions: vec![
                    ("eng".to_owned(), inventory.names.get("en").cloned().unwrap_or_default()),
                    ("fra".to_owned(), inventory.names.get("fr").cloned().unwrap_or_default()),
                ],
                entries: values
                    .map(|value| entry(&value.id, value.value_name_in("en"), value.value_name_in("fr")))
                    .collect(),
                external: None,
            })
        })
        .collect();
    all.push(ControlledVocabulary {
        id: "phases".to_owned(),
        descriptions: vec![
            ("eng".to_owned(), "phases of movement".to_owned()),
            ("fra".to_owned(), "phases du mouvement".to_owned()),
        ],
        entries: PHASES
            .iter()
            .map(|(id, english, french)| entry(id, english, french))
            .collect(),
        external: None,
    });
    all
}

/// Returns a vocabulary entry; its value is the same in both languages, and each language has its own description.
fn entry(id: &str, english: &str, french: &str) -> VocabularyEntry {
    let value = |language: &str, description: &str| VocabularyEntryValue {
        language: language.to_owned(),
        value: id.to_owned(),
        description: Some(description.to_owned()),
    };
    VocabularyEntry {
        id: id.to_owned(),
        values: vec![value("eng", english), value("fra", french)],
        external_ref: None,
    }
}
