//! Converts utterances to tiers.

use super::UTTERANCES;
use super::raw::{Document, Field, Item, Text, Utterance};
use crate::eaf::convert::{Tier, Transcript};
use crate::finding::Finding;
use crate::markup::{Error, Names, Timed, annotation, id, lanes, medium, millis, split};
use crate::tally::Findings;
use chereme_motion::Instant;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Returns the meaning of a document.
///
/// # Errors
/// [`Error::Films`] if its utterances lie in different films.
pub(super) fn from_raw(document: &Document<'_>) -> Result<(Transcript, Vec<Finding>), Error> {
    let films = films(document);
    if films > 1 {
        return Err(Error::Films { films });
    }
    let mut findings = Findings::default();
    let rows = Rows::new(document).collect(&mut findings);
    let transcript = Transcript {
        author: document.author.trim().to_owned(),
        media: document
            .media
            .iter()
            .filter(|(_, path)| !path.trim().is_empty())
            .map(|(_, path)| medium(&place(path.trim())))
            .collect(),
        tiers: tiers(document, rows, &mut findings),
        ..Transcript::default()
    };
    Ok((transcript, findings.finish()))
}

/// Returns a path with slashes; paths of the classic Macintosh have colons between folders.
fn place(path: &str) -> String {
    let is_classic = !path.contains(['/', '\\']);
    if is_classic {
        path.replace(':', "/")
    } else {
        path.to_owned()
    }
}

/// Returns the number of groups of films that no utterance joins.
fn films(document: &Document<'_>) -> usize {
    let mut groups: Vec<BTreeSet<&str>> = Vec::new();
    let mut of: HashMap<&str, usize> = HashMap::new();
    for utterance in &document.utterances {
        let ids: BTreeSet<&str> = utterance.media.iter().map(|it| it.trim()).collect();
        let joined: BTreeSet<usize> = ids.iter().filter_map(|id| of.get(id).copied()).collect();
        let mut whole = ids;
        for group in joined {
            whole.extend(std::mem::take(&mut groups[group]));
        }
        if !whole.is_empty() {
            of.extend(whole.iter().map(|id| (*id, groups.len())));
            groups.push(whole);
        }
    }
    groups.iter().filter(|group| !group.is_empty()).count()
}

/// A tier of the file: the participant and the field.
type Key<'d> = (&'d str, &'d str);

/// An annotation of a tier.
struct Row<'d> {
    time: Timed,
    value: &'d str,
}

struct Rows<'d> {
    document: &'d Document<'d>,
    fields: HashMap<&'d str, (&'d Field<'d>, HashMap<&'d str, &'d str>)>,
    /// The tiers in the order in which they occur.
    keys: Vec<Key<'d>>,
    rows: BTreeMap<Key<'d>, Vec<Row<'d>>>,
}

impl<'d> Rows<'d> {
    fn new(document: &'d Document<'d>) -> Self {
        let values = |field: &'d Field<'d>| {
            let all = field.values.iter();
            all.map(|(id, name)| (id.trim(), name.trim())).collect()
        };
        let fields = document.fields.iter();
        Self {
            document,
            fields: fields
                .map(|field| (field.id.trim(), (field, values(field))))
                .collect(),
            keys: Vec::new(),
            rows: BTreeMap::new(),
        }
    }

    fn collect(mut self, findings: &mut Findings) -> Vec<(Key<'d>, Vec<Row<'d>>)> {
        let document = self.document;
        for utterance in &document.utterances {
            let time = |text: &Text<'_>| millis(text);
            let (Some(start), Some(end)) = (time(&utterance.start), time(&utterance.end)) else {
                self.lost(utterance, utterance.at, findings);
                continue;
            };
            let line = || document.line(utterance.at);
            let whole = Timed::between(instant(start), instant(end), (UTTERANCES, line), findings);
            self.add(
                ("", ""),
                Row {
                    time: whole,
                    value: &utterance.id,
                },
            );
            for track in &utterance.tracks {
                for item in &track.items {
                    let (Some(from), Some(to)) = (time(&item.start), time(&item.end)) else {
                        self.lost(utterance, item.at, findings);
                        continue;
                    };
                    let line = || document.line(item.at);
                    let [from, to] = [from, to].map(|it| instant(start.saturating_add(it)));
                    let name = self
                        .fields
                        .get(track.field.trim())
                        .map_or("", |it| &it.0.name);
                    let time = Timed::between(from, to, (name, line), findings);
                    let value = self.value(&track.field, item, findings);
                    self.add(
                        (track.participant.trim(), track.field.trim()),
                        Row { time, value },
                    );
                }
            }
        }
        let mut rows = self.rows;
        let keys = self.keys.into_iter();
        keys.filter_map(|key| Some((key, rows.remove(&key)?)))
            .collect()
    }

    fn add(&mut self, key: Key<'d>, row: Row<'d>) {
        let rows = self.rows.entry(key).or_insert_with(|| {
            self.keys.push(key);
            Vec::new()
        });
        rows.push(row);
    }

    fn lost(&self, utterance: &Utterance<'_>, at: usize, findings: &mut Findings) {
        findings.add("annotations without times", || {
            Finding::warning(
                self.document.line(at),
                format!("an annotation of the utterance {:?} has no times in milliseconds; it was left out", utterance.id),
            )
        });
    }

    /// Returns the text of an annotation, else the name of its value.
    fn value(&self, field: &'d Text<'d>, item: &'d Item<'d>, findings: &mut Findings) -> &'d str {
        let text = item.text.trim();
        let Some(id) = item
            .value
            .as_deref()
            .map(str::trim)
            .filter(|_| text.is_empty())
        else {
            return text;
        };
        let known = self.fields.get(field.trim());
        match known.and_then(|(_, values)| values.get(id)) {
            Some(name) => name,
            None => {
                findings.add("values that the coding scheme lacks", || {
                    Finding::warning(
                        self.document.line(item.at),
                        format!("the coding scheme has no value {id:?} of the field {field:?}; the number is kept"),
                    )
                });
                id
            }
        }
    }
}

fn instant(micros: i64) -> Instant {
    Instant::from_micros(micros)
}

fn tiers(
    document: &Document<'_>,
    rows: Vec<(Key<'_>, Vec<Row<'_>>)>,
    findings: &mut Findings,
) -> Vec<Tier> {
    let people: BTreeSet<&str> = rows.iter().map(|((person, _), _)| *person).collect();
    let several = people.iter().filter(|it| !it.is_empty()).count() > 1;
    let (mut names, mut ids) = (Names::default(), Names::default());
    let mut all = Vec::new();
    for ((person, field), rows) in rows {
        let named = |list: &[(Text<'_>, Text<'_>)], wanted: &str| {
            let found = list.iter().find(|(id, _)| id.trim() == wanted);
            found
                .map(|(_, name)| name.trim().to_owned())
                .filter(|it| !it.is_empty())
        };
        let participant = named(&document.participants, person)
            .or_else(|| (!person.is_empty()).then(|| person.to_owned()));
        let field = match field {
            "" if person.is_empty() => UTTERANCES.to_owned(),
            id => {
                let found = document.fields.iter().find(|it| it.id.trim() == id);
                let name = found.map(|it| it.name.trim()).filter(|it| !it.is_empty());
                name.map_or_else(|| format!("field {id}"), str::to_owned)
            }
        };
        let wanted = match &participant {
            Some(person) if several => format!("{person} {field}"),
            _ => field.clone(),
        };
        let mut times: Vec<Timed> = rows.iter().map(|row| row.time).collect();
        let (of, crowded) = lanes(&mut times);
        split((&wanted, &of, crowded), || 1, findings);
        let first = all.len();
        all.extend((0..=of.iter().max().copied().unwrap_or(0)).map(|_| Tier {
            name: names.unique(&wanted),
            kind: field.clone(),
            participant: participant.clone(),
            ..Tier::default()
        }));
        for ((row, lane), time) in rows.into_iter().zip(of).zip(times) {
            let tier = &mut all[first + lane];
            let id = ids.id(&id(&tier.name, time.span.start()));
            tier.annotations.push(annotation(id, time.span, row.value));
        }
    }
    all
}
