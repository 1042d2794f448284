//! Suggestions of new signs: partners that differ in one component, and values that no sign has.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::Remedy;
use chereme_sign::tier::Hands;
use chereme_sign::{Component, Field, HandRef, Handedness, Phase};
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, Address};
use crate::db::columns::{Origin, ValueState};
use crate::db::recordings;
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::error::{Error, Result};
use crate::export::compound;
use crate::inventories;

/// Suggestions from a sign.
#[derive(Debug, Clone, Serialize)]
pub struct Suggestions {
    /// The row of the token.
    pub token: i64,
    /// Its gloss.
    pub gloss: String,
    /// Its coding, by field.
    pub coding: BTreeMap<String, String>,
    /// Minimal pairs: signs coded for the same fields, and alike in all but one of them.
    pub partners: Vec<Partner>,
    /// Signs that agree in all but one of the fields that both are coded for, if one of the two is coded for further
    /// fields: whether they differ in these is unknown.
    pub possible: Vec<Partner>,
    /// Values that no sign of the corpus combines with the rest of this coding, by field.
    pub unused: BTreeMap<String, Vec<String>>,
}

/// A sign that differs from another in one component.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Partner {
    /// The row of its token.
    pub token: i64,
    /// Its gloss.
    pub gloss: String,
    /// Its origin.
    pub origin: Origin,
    /// The field in which they differ.
    pub field: String,
    /// The value of the first sign.
    pub from: String,
    /// The value of this sign.
    pub to: String,
    /// How many fields are equal.
    pub equal: usize,
    /// The number of fields that only one of the two is coded for.
    pub one_sided: usize,
    /// A recipe that would give its coding, if there is one that changes that field.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recipe: Option<String>,
}

/// The fewest equal fields that make a comparison meaningful.
const LEAST_EQUAL: usize = 2;

/// The values of a token by field, hands by their part in signing: `beak > 5` for successive values, `down + in` for
/// simultaneous ones.
type Coding = BTreeMap<String, String>;

impl Corpus {
    /// Returns suggestions for new signs from a token: signs of the corpus whose codings differ in one component, with
    /// a recipe if there is one, and values that no sign combines with the rest.
    ///
    /// Only citation forms are compared. A field that only one of the two is coded for matches nothing: such a sign is
    /// a possible partner.
    ///
    /// # Errors
    /// Fails if nothing has that address, or if the token has no coding.
    pub fn suggest(&self, address: &Address) -> Result<Suggestions> {
        let connection = self.store.read();
        let token = address::token(connection, address)?;
        let own = coding(
            &signs::values(connection, token.id)?,
            self.handedness(&token)?,
        );
        if own.len() < LEAST_EQUAL {
            return Err(Error::wrong(format!(
                "{} is coded for too few components to compare it with other signs: {}, and {LEAST_EQUAL} are needed",
                token.gloss,
                own.len()
            ))
            .at(address.to_string())
            .advise(Remedy::command("code its handshape, placement and movement, or have them proposed with `chereme propose`")));
        }
        let (mut partners, mut possible) = (Vec::new(), Vec::new());
        let mut used: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for other in signs::citations(connection)? {
            if other.sign_id == token.sign_id {
                continue;
            }
            let theirs = coding(
                &signs::values(connection, other.id)?,
                self.handedness(&other)?,
            );
            let (equal, different) = compare(&own, &theirs);
            if equal < LEAST_EQUAL || different.len() != 1 {
                continue;
            }
            let field = different[0].clone();
            let (from, to) = (own[&field].clone(), theirs[&field].clone());
            used.entry(field.clone()).or_default().insert(to.clone());
            let one_sided = own.len() + theirs.len() - 2 * (equal + 1);
            let list = match one_sided {
                0 => &mut partners,
                _ => &mut possible,
            };
            list.push(Partner {
                one_sided,
                token: other.id,
                recipe: recipe(&token, &field, &to),
                gloss: other.gloss,
                origin: other.origin,
                field,
                from,
                to,
                equal,
            });
        }
        partners.sort_by(|a, b| (b.equal, &a.field, &a.gloss).cmp(&(a.equal, &b.field, &b.gloss)));
        let rank = |it: &Partner| (it.one_sided, usize::MAX - it.equal);
        possible.sort_by(|a, b| (rank(a), &a.field, &a.gloss).cmp(&(rank(b), &b.field, &b.gloss)));
        let unused = self.unused(&own, &used)?;
        Ok(Suggestions {
            token: token.id,
            gloss: token.gloss,
            coding: own,
            partners,
            possible,
            unused,
        })
    }

    /// Returns the values of a token by field.
    pub(crate) fn coding_of(&self, token: &TokenRow) -> Result<BTreeMap<String, String>> {
        let values = signs::values(self.store.read(), token.id)?;
        Ok(coding(&values, self.handedness(token)?))
    }

    fn handedness(&self, token: &TokenRow) -> Result<Handedness> {
        let connection = self.store.read();
        let Some(recording) = token.recording_id else {
            return Ok(Handedness::Right);
        };
        let signer = recordings::recording(connection, recording)?.signer_id;
        let signer = signer
            .map(|id| recordings::signer(connection, id))
            .transpose()?
            .flatten();
        let left = signer.and_then(|it| it.handedness).as_deref() == Some("left");
        Ok(if left {
            Handedness::Left
        } else {
            Handedness::Right
        })
    }

    fn unused(
        &self,
        own: &Coding,
        used: &BTreeMap<String, BTreeSet<String>>,
    ) -> Result<BTreeMap<String, Vec<String>>> {
        let all = inventories::load(self.store.read())?;
        let mut unused = BTreeMap::new();
        for (name, component) in [
            ("dominant.configuration", Component::Configuration),
            ("placement", Component::Placement),
        ] {
            let Some(value) = own.get(name) else { continue };
            let inventory = all.iter().map(|it| &it.inventory).find(|it| {
                it.component == component && it.feature.is_none() && it.find(value).is_some()
            });
            let Some(inventory) = inventory else { continue };
            let taken = used.get(name);
            let free = inventory
                .values
                .iter()
                .map(|value| &value.id)
                .filter(|id| *id != value && !taken.is_some_and(|taken| taken.contains(*id)));
            unused.insert(name.to_owned(), free.cloned().collect());
        }
        Ok(unused)
    }
}

/// Returns the name of a field in the coding of a token.
pub(crate) fn coding_name(field: &Field) -> String {
    let part = field.feature.as_ref();
    let part = part.map_or(String::new(), |part| format!(".{part}"));
    let hand = match field.hand {
        Some(HandRef::Weak | HandRef::Left) => "weak.",
        _ if field.component == Component::Configuration => "dominant.",
        _ => "",
    };
    format!("{hand}{}{part}", field.component)
}

fn coding(rows: &[TokenValueRow], handedness: Handedness) -> Coding {
    let mut values: BTreeMap<String, BTreeMap<Option<Phase>, Vec<&str>>> = BTreeMap::new();
    // An initial value that no final one follows is the only one.
    let ends_never = |row: &TokenValueRow| {
        let field = (row.hand, row.component, &row.feature, Some(Phase::Final));
        rows.iter().any(|it| {
            it.state == ValueState::NotApplicable
                && (it.hand, it.component, &it.feature, it.phase) == field
        })
    };
    for row in rows {
        let Some(value) = row
            .value
            .as_deref()
            .filter(|_| row.state == ValueState::Value)
        else {
            continue;
        };
        if row.component == Component::NonManual || row.feature.as_deref() == Some("phase") {
            continue;
        }
        let hand = row.hand.and_then(Hands::one);
        let weak = hand.is_some_and(|hand| hand.resolve(handedness) != handedness.dominant());
        let both = row.hand == Some(Hands::Both);
        let is_only = row.phase == Some(Phase::Initial) && ends_never(row);
        let phase = row.phase.filter(|_| !is_only);
        let feature = row
            .feature
            .as_ref()
            .map_or(String::new(), |it| format!(".{it}"));
        let manner = if row.component == Component::Configuration {
            "dominant."
        } else {
            ""
        };
        let mut add = |prefix: &str| {
            let field = format!("{prefix}{}{feature}", row.component);
            let phases = values.entry(field).or_default();
            phases.entry(phase).or_default().push(value);
        };
        if weak {
            add("weak.");
        } else {
            add(manner);
        }
        if both {
            add("weak.");
        }
    }
    let written = |(field, mut phases): (String, BTreeMap<Option<Phase>, Vec<&str>>)| {
        phases.values_mut().for_each(|texts| texts.sort_unstable());
        // A value of the whole sign may stand beside successive ones.
        let whole = phases.remove(&None).map(|texts| texts.join(" + "));
        let successive = (!phases.is_empty()).then(|| compound(&phases));
        let texts: Vec<String> = whole.into_iter().chain(successive).collect();
        (field, texts.join(" + "))
    };
    values.into_iter().map(written).collect()
}

/// Returns the single values of a field of a coding.
pub(crate) fn single_values(text: &str) -> impl Iterator<Item = &str> {
    let parts = text.split('>').flat_map(|part| part.split(" + "));
    parts.map(str::trim).filter(|part| !part.is_empty())
}

/// Returns the number of equal fields, and the fields that differ, among those that both have.
fn compare(a: &Coding, b: &Coding) -> (usize, Vec<String>) {
    let both = a
        .iter()
        .filter_map(|(field, value)| Some((field, value, b.get(field)?)));
    let (mut equal, mut different) = (0, Vec::new());
    for (field, mine, theirs) in both {
        if mine == theirs {
            equal += 1;
        } else {
            different.push(field.clone());
        }
    }
    (equal, different)
}

/// Returns a recipe that changes one field of a token with movement.
fn recipe(token: &TokenRow, field: &str, to: &str) -> Option<String> {
    token.recording_id?;
    if single_values(to).ne([to]) {
        return None;
    }
    let source = format!("token:{}", token.id);
    let value = if to.contains(' ') {
        format!("\"{to}\"")
    } else {
        to.to_owned()
    };
    match field {
        "dominant.configuration" => Some(format!("{source} | configure dominant {value}")),
        "weak.configuration" => Some(format!("{source} | configure weak {value}")),
        "placement" => Some(format!("{source} | place both at {value}")),
        _ => None,
    }
}
