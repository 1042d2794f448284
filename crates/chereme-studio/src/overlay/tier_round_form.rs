//! The form of work on the tiers of many recordings, and the work that it asks for.

use std::collections::BTreeSet;

use chereme_corpus::{
    AnnotatedHands, CopiedAnnotations, NewTier, RowName, TierPropertyChange, TierRole, TierRoundScope, TierRoundWork,
    TierScheme, TierStereotype, TierValueSource,
};
use chereme_sign::query::parse_plain_number;

use crate::words::{InterfaceText, tier_round_words as words};

const SECOND_MICROS: f64 = 1e6;
/// The longest shift that a person can mean, in seconds: a day.
const MAX_SHIFT_SECONDS: f64 = 86_400.0;

/// The choice of recordings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum RoundRecordings {
    #[default]
    All,
    Found,
    Named,
    Ticked,
}

/// The kind of work.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum RoundWorkKind {
    #[default]
    AddUsual,
    AddLike,
    Add,
    Change,
    Copy,
    Remove,
    Shift,
}

impl RoundWorkKind {
    pub(super) const ALL_ROUND_WORK_KINDS: [(Self, InterfaceText); 7] = [
        (Self::AddUsual, words::ADD_USUAL),
        (Self::AddLike, words::ADD_LIKE),
        (Self::Add, words::ADD),
        (Self::Change, words::CHANGE),
        (Self::Copy, words::COPY),
        (Self::Remove, words::REMOVE),
        (Self::Shift, words::SHIFT),
    ];
}

/// A property of tiers that is a text; it is changed only if it is marked so.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct TierTextProperty {
    pub(super) is_changed: bool,
    pub(super) text: String,
}

impl TierTextProperty {
    fn property_change(&self) -> Option<Option<String>> {
        self.is_changed.then(|| non_blank(&self.text))
    }
}

/// The fields of the form; each kind of work has its own.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct TierRoundForm {
    pub(super) recordings: RoundRecordings,
    pub(super) query: String,
    pub(super) pattern: String,
    /// The row ids of the ticked recordings.
    pub(super) ticked: BTreeSet<i64>,
    pub(super) kind: RoundWorkKind,
    /// The recording whose tiers are the example.
    pub(super) like: Option<i64>,
    /// The tiers that are worked on: a name, where `*` stands for any letters; several for a shift.
    pub(super) tier: String,
    /// The name of the new tier or of the copies, or the new name of the tiers.
    pub(super) name: String,
    /// The role as queries spell it; `None` leaves it as it is.
    pub(super) role: Option<String>,
    /// The hand; `None` leaves it as it is.
    pub(super) hand: Option<Option<AnnotatedHands>>,
    pub(super) parent: String,
    pub(super) how: TierStereotype,
    pub(super) participant: TierTextProperty,
    pub(super) annotator: TierTextProperty,
    pub(super) language: TierTextProperty,
    pub(super) copied: CopiedAnnotations,
    pub(super) seconds: String,
}

impl Default for TierRoundForm {
    fn default() -> Self {
        Self {
            recordings: RoundRecordings::default(),
            query: String::new(),
            pattern: String::new(),
            ticked: BTreeSet::new(),
            kind: RoundWorkKind::default(),
            like: None,
            tier: String::new(),
            name: String::new(),
            role: None,
            hand: None,
            parent: String::new(),
            how: TierStereotype::IncludedIn,
            participant: TierTextProperty::default(),
            annotator: TierTextProperty::default(),
            language: TierTextProperty::default(),
            copied: CopiedAnnotations::All,
            seconds: String::new(),
        }
    }
}

impl TierRoundForm {
    /// Returns the chosen recordings; `None` if the choice is not complete.
    pub(super) fn round_scope(&self) -> Option<TierRoundScope> {
        match self.recordings {
            RoundRecordings::All => Some(TierRoundScope::All),
            RoundRecordings::Found => non_blank(&self.query).map(TierRoundScope::Query),
            RoundRecordings::Named => non_blank(&self.pattern).map(TierRoundScope::Pattern),
            RoundRecordings::Ticked => {
                let ids: Vec<i64> = self.ticked.iter().copied().collect();
                (!ids.is_empty()).then_some(TierRoundScope::Recordings(ids))
            }
        }
    }

    /// Returns the work; `None` if a field that it needs is empty or cannot be read.
    pub(super) fn round_work(&self) -> Option<TierRoundWork> {
        Some(match self.kind {
            RoundWorkKind::AddUsual => TierRoundWork::AddScheme(TierScheme::Usual),
            RoundWorkKind::AddLike => TierRoundWork::AddScheme(TierScheme::Like(RowName::Number(self.like?))),
            RoundWorkKind::Add => TierRoundWork::Add(self.new_tier()?),
            RoundWorkKind::Change => TierRoundWork::Change {
                tier: non_blank(&self.tier)?,
                change: self.tier_change()?,
            },
            RoundWorkKind::Copy => TierRoundWork::Copy {
                tier: non_blank(&self.tier)?,
                name: non_blank(&self.name)?,
                copied: self.copied.clone(),
            },
            RoundWorkKind::Remove => TierRoundWork::Remove {
                tier: non_blank(&self.tier)?,
            },
            RoundWorkKind::Shift => TierRoundWork::Shift {
                tiers: self.tier.split(',').filter_map(non_blank).collect(),
                by_us: parse_shift_micros(&self.seconds)?,
            },
        })
    }

    fn new_tier(&self) -> Option<NewTier> {
        let role = self
            .role
            .as_deref()
            .map_or(Some(TierRole::Free), |role| role.parse().ok())?;
        // The work puts the tier into each recording.
        let mut tier = NewTier::new(RowName::Number(0), non_blank(&self.name)?, role);
        tier.hand = self.hand.flatten();
        tier.parent = non_blank(&self.parent).map(|parent| (parent, self.how));
        tier.participant = non_blank(&self.participant.text);
        tier.annotator = non_blank(&self.annotator.text);
        tier.language = non_blank(&self.language.text);
        Some(tier)
    }

    /// Returns the changed properties; `None` if nothing changes.
    fn tier_change(&self) -> Option<TierPropertyChange> {
        let role = self.role.as_deref().map(str::parse).transpose().ok()?;
        let change = TierPropertyChange {
            name: non_blank(&self.name),
            // Values of another role are those of another inventory.
            values: role.as_ref().map(|_: &TierRole| TierValueSource::default()),
            role,
            hand: self.hand,
            participant: self.participant.property_change(),
            annotator: self.annotator.property_change(),
            language: self.language.property_change(),
            ..TierPropertyChange::default()
        };
        (change != TierPropertyChange::default()).then_some(change)
    }
}

/// Reads a time in seconds that is not zero, as microseconds.
fn parse_shift_micros(text: &str) -> Option<i64> {
    let seconds = parse_plain_number(text.trim()).filter(|seconds| seconds.abs() <= MAX_SHIFT_SECONDS)?;
    let micros = (seconds * SECOND_MICROS).round() as i64;
    (micros != 0).then_some(micros)
}

fn non_blank(text: &str) -> Option<String> {
    let text = text.trim();
    (!text.is_empty()).then(|| text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form(kind: RoundWorkKind) -> TierRoundForm {
        TierRoundForm {
            kind,
            ..TierRoundForm::default()
        }
    }

    #[test]
    fn recordings_must_be_chosen_and_work_must_be_complete() {
        let mut chosen = form(RoundWorkKind::AddUsual);
        assert_eq!(chosen.round_scope(), Some(TierRoundScope::All));
        for recordings in [RoundRecordings::Found, RoundRecordings::Named, RoundRecordings::Ticked] {
            chosen.recordings = recordings;
            assert_eq!(chosen.round_scope(), None, "{recordings:?}");
        }
        chosen.ticked.insert(3);
        assert_eq!(chosen.round_scope(), Some(TierRoundScope::Recordings(vec![3])));
        let incomplete = [
            RoundWorkKind::AddLike,
            RoundWorkKind::Add,
            RoundWorkKind::Change,
            RoundWorkKind::Copy,
            RoundWorkKind::Remove,
            RoundWorkKind::Shift,
        ];
        for kind in incomplete {
            assert!(form(kind).round_work().is_none(), "{kind:?}");
        }
        assert!(form(RoundWorkKind::AddUsual).round_work().is_some());
    }

    #[test]
    fn only_marked_and_filled_properties_of_tiers_are_changed() {
        let mut asked = form(RoundWorkKind::Change);
        asked.tier = " Gloss* ".to_owned();
        assert!(asked.round_work().is_none(), "nothing is to be changed");
        asked.annotator.is_changed = true;
        asked.participant.text = "not marked".to_owned();
        let Some(TierRoundWork::Change { tier, change }) = asked.round_work() else {
            panic!("a change");
        };
        assert_eq!(tier, "Gloss*");
        let wanted = TierPropertyChange {
            annotator: Some(None),
            ..TierPropertyChange::default()
        };
        assert_eq!(change, wanted);
    }

    #[test]
    fn a_shift_takes_seconds_with_either_mark_and_names_parted_by_commas() {
        for (text, wanted) in [
            ("0.04", Some(40_000)),
            ("-1,5", Some(-1_500_000)),
            (" 2 ", Some(2_000_000)),
            ("0", None),
            ("1e300", None),
            ("soon", None),
        ] {
            assert_eq!(parse_shift_micros(text), wanted, "{text}");
        }
        let mut asked = form(RoundWorkKind::Shift);
        (asked.tier, asked.seconds) = ("Gloss, Mouth,".to_owned(), "1".to_owned());
        let Some(TierRoundWork::Shift { tiers, by_us }) = asked.round_work() else {
            panic!("a shift");
        };
        assert_eq!(
            (tiers.as_slice(), by_us),
            (&["Gloss".to_owned(), "Mouth".to_owned()][..], 1_000_000)
        );
    }
}
