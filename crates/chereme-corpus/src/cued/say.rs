//! A sentence put together from the dictionary of captured movements, stored, and read back.

use chereme_analysis::cue::labels;
use chereme_analysis::cue::session::Followed;
use chereme_compose::cue::dikey::{Costs, DikeyEnd, Piece};
use chereme_compose::cue::{KeyTimes, sounds, times};
use chereme_compose::{CuePhases, CueTier, PhaseRule};
use chereme_motion::column::Column;
use chereme_motion::glam::DVec3;
use chereme_motion::markers::Marker;
use chereme_motion::{Capture, Convention, Markers, Rate, Space, Times};
use chereme_sign::TierRole;
use chereme_sign::cue::{self, Utterance, UtteranceError};
use rusqlite::Connection;
use serde::Serialize;

use super::dictionary::{Book, REST, book, named, pair_name};
use super::targets::{Row, insert};
use super::{CuedOptions, key_name, rounded};
use crate::Corpus;
use crate::address::Name;
use crate::cue::{CueOptions, KeysOptions};
use crate::db::columns::{AnnotationOrigin, Origin};
use crate::db::recordings::{self, RecordingRow};
use crate::db::tiers::TierRow;
use crate::error::{Error, Result};
use crate::inventories;
use crate::progress::Progress;
use crate::recombine::{measured_phases, store_phases};
use crate::tokens;
use crate::track::{NewTrack, Track, store};

/// How much the costs of selection count.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CueCosts {
    /// The cost of a duration that differs by 100 ms.
    pub duration: f64,
    /// The cost of a join whose ends differ by the spread within one key.
    pub join: f64,
}

impl Default for CueCosts {
    fn default() -> Self {
        let costs = Costs::default();
        Self {
            duration: costs.duration,
            join: costs.join,
        }
    }
}

/// A sentence that was put together.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FromDictionary {
    /// The text or phones.
    pub text: String,
    /// How many keys it has.
    pub keys: u64,
    /// How long it lasts, in microseconds.
    pub duration_us: i64,
    /// The pieces, in order.
    pub pieces: Vec<SaidPiece>,
    /// How many pieces are the pair that was wanted.
    pub exact: u64,
    /// How many stand in for another pair.
    pub backed_off: u64,
    /// How many are synthetic ramps.
    pub synthetic: u64,
    /// The sum of both costs over all pieces.
    pub cost: f64,
    /// The share of shapes that the recogniser reads back at the targets; nothing if a body cues without a dictionary.
    pub shapes_read: Option<f64>,
    /// The share of placements that the recogniser reads back.
    pub placements_read: Option<f64>,
    /// The keys that were read as others.
    pub misread: Vec<SaidPiece>,
    /// The greatest change of a tip from one frame to the next, in millimetres.
    pub most_step_mm: f64,
    /// Whether the dictionary is empty, so that the program's own movement stands for it.
    pub without_dictionary: bool,
    /// The recording that was stored; nothing if none was.
    pub recording: Option<String>,
    /// Reasons for caution.
    pub findings: Vec<String>,
}

/// A piece of a sentence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SaidPiece {
    /// The pair of keys that was wanted, such as `side-5>mouth-4`.
    pub wanted: String,
    /// The recording and frames that it was cut from; `synthetic` for a ramp.
    pub source: String,
    /// The pair that stands in for it, if it is missing.
    pub instead: Option<String>,
    /// The cost of its duration.
    pub duration_cost: f64,
    /// The cost of its join to the piece before.
    pub join_cost: f64,
    /// When its target is, in microseconds.
    pub at_us: i64,
    /// The key that the recogniser reads at its target.
    pub read: Option<String>,
}

/// The time of the hand at rest at either end, in seconds, and that of its way to rest.
const STILL: f64 = 0.2;
const TO_REST: f64 = 0.4;

impl Corpus {
    /// Puts a sentence together from the movements of captured takes, and reads it back; with a gloss it is stored as a
    /// recording of markers with tiers for phones, keys, movements and the provenance of every piece.
    ///
    /// Without captured takes the program's own movement stands for the dictionary, see [`cue`](Self::cue), and the report
    /// says so.
    ///
    /// # Errors
    /// If nothing in the text can be cued, the takes are too few, or `progress` stops the work.
    pub fn cue_from_dictionary(
        &mut self,
        text: &str,
        (how, options): (&CueOptions, &CuedOptions),
        (costs, recordings): (CueCosts, &[Name]),
        gloss: Option<&str>,
        progress: &mut Progress<'_>,
    ) -> Result<FromDictionary> {
        let fault = |error: UtteranceError| Error::wrong(error.to_string()).advise(error.remedy());
        let reading = KeysOptions {
            code: options.code.clone(),
            variants: options.variants.clone(),
            pace: Some(how.reading.pace.unwrap_or(1.6)),
            ..how.reading.clone()
        };
        let legal = |cost: f64| cost.is_finite() && (0.0..=1000.0).contains(&cost);
        if !legal(costs.duration) || !legal(costs.join) {
            return Err(
                Error::wrong("a cost is no number from 0 to 1000").advise("1 is usual for both")
            );
        }
        let read = Utterance::read(text, &reading).map_err(fault)?;
        if read.keys.is_empty() {
            return Err(Error::wrong(format!("there is nothing to cue in {text:?}"))
                .advise("write words, or phones with --phones"));
        }
        let found = book(self.store.read(), recordings, options, progress);
        let book = match found {
            Ok(book) if book.dictionary.kinds() > 0 => book,
            Err(Error::Stopped) => return Err(Error::Stopped),
            Err(error) if !recordings.is_empty() => return Err(error),
            other => {
                let why = other.err().map_or_else(
                    || "no movement could be cut".to_owned(),
                    |it| it.to_string(),
                );
                return self.without_dictionary(text, how, gloss, why);
            }
        };
        let measured = match how.phase {
            PhaseRule::Measured => measured_phases(self.store.read())?.ok_or_else(|| {
                Error::wrong("too few captured keys of each kind have measured phases")
                    .advise("store them first: chereme cued CORPUS targets --store")
            })?,
            _ => CuePhases::default(),
        };
        let made = Said::of(&book, &read, (how.phase, &measured), costs)?;
        let mut report = made.report(text, &book, &read);
        if let Some(gloss) = gloss {
            let name = self.store.operation("cue from dictionary", |connection| {
                let name = stored(connection, gloss, text, &made, (&book, &read))?;
                Ok((
                    name,
                    format!("{gloss} from {} movements", report.pieces.len()),
                ))
            })?;
            report.recording = Some(name);
        }
        Ok(report)
    }

    fn without_dictionary(
        &mut self,
        text: &str,
        how: &CueOptions,
        gloss: Option<&str>,
        why: String,
    ) -> Result<FromDictionary> {
        let done = self.cue(text, how, gloss)?;
        let keys = done
            .notes
            .iter()
            .filter(|note| note.feature.as_deref() == Some(CueTier::Keys.name()));
        Ok(FromDictionary {
            text: text.to_owned(),
            keys: keys.count() as u64,
            duration_us: done.duration_us,
            pieces: Vec::new(),
            exact: 0,
            backed_off: 0,
            synthetic: 0,
            cost: 0.0,
            shapes_read: None,
            placements_read: None,
            misread: Vec::new(),
            most_step_mm: 0.0,
            without_dictionary: true,
            recording: done.name,
            findings: [format!(
                "the program's own movement stands for a dictionary: {why}"
            )]
            .into_iter()
            .chain(done.report.warnings)
            .collect(),
        })
    }
}

/// A sentence as movement of markers.
struct Said {
    wanted: Vec<(DikeyEnd, f64)>,
    times: Vec<KeyTimes>,
    pieces: Vec<Piece>,
    /// The hand's markers in the room, and those of the head.
    hand: Vec<Vec<DVec3>>,
    rigid: Vec<Vec<DVec3>>,
    followed: Followed,
    /// By how much the sounds are later than in the utterance, in seconds.
    lead: f64,
}

impl Said {
    fn of(
        book: &Book,
        read: &Utterance,
        (rule, measured): (PhaseRule, &CuePhases),
        costs: CueCosts,
    ) -> Result<Self> {
        let sounds = sounds(&read.keys).ok_or_else(|| Error::wrong("the keys have no times"))?;
        let mut times = times(&sounds, rule, measured);
        let first = times.first().map_or(0.0, |it| it.m1.min(it.d1));
        let lead = (STILL - first).max(STILL);
        for own in &mut times {
            for time in [&mut own.m1, &mut own.m2, &mut own.d1, &mut own.d2] {
                *time += lead;
            }
        }
        let mut wanted = vec![(REST, times.first().map_or(0.0, |it| it.m1))];
        for (key, own) in read.keys.iter().zip(&times) {
            let placement = u8::try_from(cue::placement_number(&key.placement)).unwrap_or_default();
            wanted.push((
                DikeyEnd {
                    placement,
                    shape: key.shape,
                },
                own.m2,
            ));
        }
        let last = wanted.last().map_or(0.0, |it| it.1);
        wanted.push((
            REST,
            last.max(sounds.last().map_or(0.0, |it| it.a3 + lead)) + TO_REST,
        ));
        let costs = Costs {
            duration: costs.duration,
            join: costs.join,
        };
        let pieces = book.dictionary.select(&wanted, &costs);
        let rows = book.dictionary.render(&pieces, &wanted);
        let before = (wanted[0].1 * book.rate).round() as usize;
        let after = (STILL * book.rate).round() as usize;
        let first = rows.first().cloned().unwrap_or_default();
        let end = rows.last().cloned().unwrap_or_default();
        let still = |row: &Vec<f64>, count: usize| std::iter::repeat_n(row.clone(), count);
        let rows = still(&first, before).chain(rows).chain(still(&end, after));
        let (mut hand, mut rigid, mut heads) = (Vec::new(), Vec::new(), Vec::new());
        for row in rows {
            let (points, head) = book.places(&row);
            hand.push(points.iter().map(|at| head.apply(*at)).collect::<Vec<_>>());
            rigid.push(book.rigid.iter().map(|at| head.apply(*at)).collect());
            heads.push(head);
        }
        let followed = Followed::of_truth(&hand, &heads, book.rate);
        Ok(Self {
            wanted,
            times,
            pieces,
            hand,
            rigid,
            followed,
            lead,
        })
    }

    fn report(&self, text: &str, book: &Book, read: &Utterance) -> FromDictionary {
        let last = self.hand.len().saturating_sub(1);
        let mut right = [0u64; 2];
        let keys = read.keys.len();
        let mut misread = Vec::new();
        let mut pieces = Vec::new();
        for (n, piece) in self.pieces.iter().enumerate() {
            let (key, time) = self.wanted[n + 1];
            let frame = ((time * book.rate).round() as usize).min(last);
            let mut own = SaidPiece {
                wanted: pair_name(piece.wanted),
                source: piece.source.clone(),
                instead: piece.instead.map(pair_name),
                duration_cost: rounded(piece.duration_cost, 4),
                join_cost: rounded(piece.join_cost, 4),
                at_us: (time * 1e6).round() as i64,
                read: None,
            };
            if n < keys {
                let seen = self.followed.seven.get(frame).copied().flatten();
                let shape = seen.map_or(0, |seven| book.known.shapes.best(&seven));
                let tip = self.followed.tip(key.shape, frame);
                let place = tip.map_or(0, |tip| book.known.placements.best(&tip.to_array()));
                right[0] += u64::from(shape == key.shape);
                right[1] += u64::from(place == key.placement);
                own.read = Some(key_name(place, shape));
                if shape != key.shape || place != key.placement {
                    misread.push(own.clone());
                }
            }
            pieces.push(own);
        }
        let share = |right: u64| Some(rounded(right as f64 / keys.max(1) as f64, 4));
        let synthetic = self.pieces.iter().filter(|it| it.dikey.is_none()).count() as u64;
        let backed_off = self.pieces.iter().filter(|it| it.instead.is_some()).count() as u64;
        let steps = self.hand.windows(2).flat_map(|pair| {
            let tips = (0..4).map(|finger| labels::finger(finger) + 7);
            tips.map(|tip| pair[0][tip].distance(pair[1][tip]))
                .collect::<Vec<f64>>()
        });
        FromDictionary {
            text: text.to_owned(),
            keys: keys as u64,
            duration_us: (self.hand.len() as f64 / book.rate * 1e6).round() as i64,
            exact: self.pieces.len() as u64 - synthetic - backed_off,
            backed_off,
            synthetic,
            cost: rounded(
                self.pieces
                    .iter()
                    .map(|it| it.duration_cost + it.join_cost)
                    .sum(),
                4,
            ),
            shapes_read: share(right[0]),
            placements_read: share(right[1]),
            misread,
            most_step_mm: rounded(steps.fold(0.0, f64::max), 2),
            without_dictionary: false,
            recording: None,
            findings: read.findings.iter().map(ToString::to_string).collect(),
            pieces,
        }
    }
}

fn stored(
    connection: &Connection,
    gloss: &str,
    text: &str,
    made: &Said,
    (book, read): (&Book, &Utterance),
) -> Result<String> {
    let gloss = gloss.trim();
    if gloss.is_empty() {
        return Err(Error::wrong("a new sign needs a gloss").advise("write --as GLOSS"));
    }
    let name = recordings::free_name(connection, gloss)?;
    let end = (made.hand.len() as f64 / book.rate * 1e6).round() as i64;
    let recording = recordings::insert_recording(
        connection,
        &RecordingRow {
            id: 0,
            name: name.clone(),
            signer_id: None,
            signer: None,
            origin: Origin::Made,
            duration_us: end,
            licence: None,
            notes: Some("put together from captured movements between keys; the tier Dikeys names the source of each".to_owned()),
        },
    )?;
    store::store(
        connection,
        recording,
        &NewTrack::new("markers", Track::Markers(markers(made, book)?)),
    )?;
    let micros = |seconds: f64| (seconds * 1e6).round() as i64;
    let lead = micros(made.lead);
    let row = |from: i64, to: i64, value: String| -> Row { (from, to, value, 0.0) };
    let phones: Vec<Row> = read
        .phones
        .iter()
        .filter_map(|phone| {
            let (span, symbols) = (phone.span?, read.code.symbols(&phone.label, read.alphabet)?);
            let sounds = symbols.iter().any(|symbol| !read.code.is_pause(symbol));
            sounds.then(|| {
                row(
                    span.start().micros() + lead,
                    span.end().micros() + lead,
                    symbols.join(" "),
                )
            })
        })
        .collect();
    let keys: Vec<Row> = read
        .keys
        .iter()
        .filter_map(|key| {
            let span = key.span?;
            let value = cue::gloss(&key.placement, key.shape);
            Some(row(
                span.start().micros() + lead,
                span.end().micros() + lead,
                value,
            ))
        })
        .collect();
    let mut before = REST;
    let (mut hand, mut fingers) = (Vec::new(), Vec::new());
    for ((key, _), times) in made.wanted.iter().skip(1).zip(&made.times) {
        hand.push(row(
            micros(times.m1),
            micros(times.m2),
            format!("{}>{}", named(before), named(*key)),
        ));
        fingers.push(row(
            micros(times.d1),
            micros(times.d2),
            format!("{}>{}", before.shape, key.shape),
        ));
        before = *key;
    }
    let dikeys: Vec<Row> = made
        .pieces
        .iter()
        .enumerate()
        .map(|(n, piece)| {
            let stands = piece
                .instead
                .map_or_else(String::new, |it| format!(" by {}", pair_name(it)));
            let value = format!("{}{stands} from {}", pair_name(piece.wanted), piece.source);
            row(
                micros(made.wanted[n].1),
                micros(made.wanted[n + 1].1),
                value,
            )
        })
        .collect();
    let whole = vec![row(0, end, text.to_owned())];
    let all = [
        (
            "Gloss",
            TierRole::Gloss,
            vec![row(0, end, gloss.to_owned())],
        ),
        ("Text", TierRole::Translation, whole),
        (CueTier::Phones.name(), TierRole::Free, phones),
        (CueTier::Keys.name(), TierRole::Gloss, keys),
        (CueTier::Hand.name(), TierRole::Free, hand),
        (CueTier::Fingers.name(), TierRole::Free, fingers),
        ("Dikeys", TierRole::Free, dikeys),
    ];
    for (position, (name, role, rows)) in (0..).zip(all) {
        let tier = TierRow {
            recording_id: recording,
            name: name.to_owned(),
            position,
            role,
            ..TierRow::default()
        };
        insert(connection, &tier, AnnotationOrigin::Made, &rows)?;
    }
    let inventories = inventories::load(connection)?;
    tokens::derive(connection, recording, None, &inventories)?;
    store_phases(connection, recording)?;
    Ok(name)
}

/// Returns the sentence's markers: the hand, and the head's rigid ones.
fn markers(made: &Said, book: &Book) -> Result<Markers> {
    let fault = |error: String| Error::wrong(error);
    let point = |name: String, at: &dyn Fn(usize) -> DVec3| {
        let column = |axis: usize| {
            let numbers = (0..made.hand.len()).map(|frame| rounded(at(frame)[axis], 3));
            Column::doubles(numbers.collect())
        };
        Marker::new(name, (0..3).map(column).collect())
    };
    let mut points = Vec::new();
    for (n, name) in labels::hand().into_iter().enumerate() {
        points.push(point(name, &|frame| made.hand[frame][n]));
    }
    for (n, name) in labels::face()
        .into_iter()
        .take(book.rigid.len())
        .enumerate()
    {
        points.push(point(name, &|frame| made.rigid[frame][n]));
    }
    let thousandths = (book.rate * 1000.0).round() as u32;
    let rate = Rate::new(thousandths, 1000).map_err(|error| fault(error.to_string()))?;
    let space = Space::World(Convention {
        metres_per_unit: 0.001,
        ..Convention::MODEL
    });
    let markers =
        Markers::new(Times::Even(rate), space, points).map_err(|error| fault(error.to_string()))?;
    Ok(markers.captured(Capture::Estimated))
}
