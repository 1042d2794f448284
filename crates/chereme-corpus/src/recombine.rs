//! New signs from stored ones: evaluates a recipe, and stores the result with its movement, tiers and sources.

mod again;
mod draft;
mod parts;
mod phases;

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_compose::{
    About, CueTier, ENGINE, Generated, Input, Note, Recipe, Report, Resolved, brief,
};
use chereme_formats::bvh::convert;
use chereme_formats::bvh::raw::{Column, Hierarchy};
use chereme_motion::anatomy::Anatomy;
use chereme_motion::{Clip, Convention, Face, Side};
use chereme_sign::Remedy;
use chereme_sign::inventory;
use chereme_sign::tier::Hands;
use chereme_sign::{Component, Field, Handedness, Reading, TierRole};
use rusqlite::Connection;
use serde::Serialize;
use serde_json::json;
use sha2::{Digest, Sha256};

use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::curves;
use crate::db::columns::{AnnotationOrigin, Origin, ValueState};
use crate::db::motion::hex;
use crate::db::recipes::{self, RecipeRow};
use crate::db::recordings::{self, MotionTrackRow, RecordingRow};
use crate::db::signs;
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::{Error, FailedStep, Result};
use crate::inventories::{self, StoredInventory};
use crate::movement::{self, BLOCK_FRAMES, MotionTrack};
use crate::sources::CorpusSources;
use crate::tokens;
use crate::words::effect::OperationEffect;

pub(crate) use draft::Drafted;
pub use parts::MadePart;
pub(crate) use phases::{measured as measured_phases, store as store_phases};

/// The number of decimals of generated movement: a millionth of a degree, or of the file's unit.
const DECIMALS: u8 = 6;

/// The result of evaluating a recipe, stored or not.
#[derive(Debug, Clone, Serialize)]
pub struct Recombination {
    /// The recipe as the corpus spells it.
    pub recipe: String,
    /// The gloss of the new sign.
    pub gloss: String,
    /// The token's row; `None` if nothing was stored.
    pub token: Option<i64>,
    /// The recording's row; `None` if nothing was stored.
    pub recording: Option<i64>,
    /// The name of the recording.
    pub name: Option<String>,
    /// How long it lasts, in microseconds.
    pub duration_us: i64,
    /// Its description by time: the signs it was built from, component values, strokes, holds and transitions. In a
    /// stored sign these are its annotations.
    pub notes: Vec<TimedNote>,
    /// The names of its scalar curves, such as those of non-manuals.
    pub curves: Vec<String>,
    /// Findings about the notation from which it was generated.
    pub findings: Vec<NotationFinding>,
    /// The report of the evaluation.
    pub report: Report,
    /// The report in words.
    #[serde(skip)]
    pub explanation: String,
    /// The movement.
    #[serde(skip)]
    pub clip: Clip,
    /// The face in each frame, if non-manuals give it; otherwise empty.
    #[serde(skip)]
    pub faces: Vec<Face>,
    /// The body parts of the movement's joints.
    #[serde(skip)]
    pub anatomy: std::sync::Arc<Anatomy>,
    /// The signer's handedness.
    #[serde(skip)]
    pub handedness: Handedness,
    /// The pieces from which it was composed, in order, with their times in it.
    #[serde(skip)]
    pub parts: Vec<MadePart>,
}

/// A note about a stretch of generated movement.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TimedNote {
    /// `sign`, `transition`, or a component such as `movement`.
    pub about: &'static str,
    /// The part of the component: `phase` of movement distinguishes strokes and holds.
    pub feature: Option<String>,
    /// The hand; nothing for signs and non-manuals.
    pub hand: Option<Side>,
    /// The gloss, or the component's value; `None` if it is unknown.
    pub value: Option<String>,
    /// Its start, in microseconds from the first frame.
    pub start_us: i64,
    /// The first microsecond after it.
    pub end_us: i64,
    /// The source of the movement; for notation with the action, such as `arc o`.
    pub from: String,
}

/// A finding about notation that was animated in spite of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct NotationFinding {
    /// The file, if the finding is about one.
    pub file: Option<String>,
    /// The line of the file, from 1.
    pub line: Option<u64>,
    /// The number of the symbol in HamNoSys text, from 1.
    pub symbol: Option<usize>,
    /// The oddity.
    pub message: String,
    /// The remedy, if there is one.
    pub remedy: Option<Remedy>,
}

impl std::fmt::Display for NotationFinding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (&self.file, self.line, self.symbol) {
            (Some(file), Some(line), _) => write!(f, "{file}, line {line}: ")?,
            (Some(file), None, _) => write!(f, "{file}: ")?,
            (None, _, Some(symbol)) => write!(f, "symbol {symbol}: ")?,
            _ => {}
        }
        f.write_str(&self.message)?;
        match &self.remedy {
            Some(remedy) => write!(f, "; {remedy}"),
            None => Ok(()),
        }
    }
}

impl Corpus {
    /// Evaluates a recipe without storing anything.
    ///
    /// # Errors
    /// Fails if the recipe is invalid or cannot be evaluated; the error names the step, the reason and the remedy.
    pub fn preview(&mut self, recipe: &str) -> Result<Recombination> {
        let (_, made, recipe) = self.make(recipe)?;
        Ok(recombination(&recipe, String::new(), made))
    }

    /// Evaluates a recipe and stores its movement as a sign with this gloss, with its tiers and its sources.
    ///
    /// # Errors
    /// As [`preview`](Self::preview); nothing incomplete is stored.
    pub fn recombine(&mut self, recipe: &str, gloss: &str) -> Result<Recombination> {
        let gloss = gloss.trim();
        if gloss.is_empty() {
            return Err(Error::wrong("a new sign needs a gloss")
                .advise(Remedy::command("write --as GLOSS")));
        }
        let (resolved, made, recipe) = self.make(recipe)?;
        let (recording, token, name) = self.store.operation(|connection| {
            let stored = store(connection, &recipe, &resolved, &made, gloss)?;
            let (gloss, recipe) = (gloss.to_owned(), recipe.to_string());
            Ok((stored, OperationEffect::Recombine { gloss, recipe }))
        })?;
        let mut done = recombination(&recipe, gloss.to_owned(), made);
        (done.token, done.recording, done.name) = (Some(token), Some(recording), Some(name));
        Ok(done)
    }

    /// Returns the inventories, which are read again only if the corpus has changed: previews follow each other fast.
    pub(crate) fn inventories_now(&self) -> Result<Arc<Vec<StoredInventory>>> {
        let now = self.generation()?;
        let mut kept = self.inventories.borrow_mut();
        if let Some((generation, inventories)) = &*kept
            && *generation == now
        {
            return Ok(inventories.clone());
        }
        let inventories = Arc::new(inventories::load(self.store.read())?);
        *kept = Some((now, inventories.clone()));
        Ok(inventories)
    }

    pub(crate) fn make(&mut self, recipe: &str) -> Result<(Resolved, Generated, Recipe)> {
        let recipe = read(recipe)?;
        let inventories = self.inventories_now()?;
        let sources = CorpusSources::open(&mut self.store, &inventories, &self.learned)?;
        let resolved = chereme_compose::resolve(&recipe, &sources).map_err(cannot)?;
        let made = chereme_compose::evaluate(&resolved).map_err(cannot)?;
        Ok((resolved, made, recipe))
    }
}

/// Reads a recipe as text, or as JSON if it begins with a brace.
fn read(text: &str) -> Result<Recipe> {
    if text.trim_start().starts_with('{') {
        return serde_json::from_str(text).map_err(|error| {
            Error::wrong(format!("the recipe cannot be read: {error}"))
                .at(brief(text))
                .advise("a recipe in JSON is, for example, {\"version\": 1, \"make\": {\"sign\": \"BOL\"}}")
        });
    }
    text.parse().map_err(|error: chereme_compose::RecipeError| {
        let pointed = match &error {
            chereme_compose::RecipeError::Text(text) if !text.text.is_empty() => {
                format!("\n{}", text.pointed())
            }
            _ => String::new(),
        };
        Error::wrong(format!("the recipe cannot be read: {error}{pointed}"))
            .at(brief(text))
            .advise(
                "a recipe is a sign and the changes to it, such as: ESCARGOT | configure right U",
            )
    })
}

/// Returns the failure of a step of a recipe.
fn cannot(error: chereme_compose::MakeError) -> Error {
    let known = || Remedy::command("`chereme list CORPUS signs` and `… values` list what there is");
    Error::Step(Box::new(FailedStep {
        remedy: error.cause.remedy().unwrap_or_else(known),
        meant: error.cause.meant(),
        cause: error.cause.to_string(),
        step: brief(&error.step),
        path: error.path,
    }))
}

fn recombination(recipe: &Recipe, gloss: String, made: Generated) -> Recombination {
    Recombination {
        recipe: recipe.to_string(),
        gloss,
        token: None,
        recording: None,
        name: None,
        duration_us: made.clip.span().micros(),
        notes: made.notes.iter().map(timed).collect(),
        faces: chereme_compose::faces(&made.curves),
        curves: made.curves.into_iter().map(|curve| curve.name).collect(),
        findings: Vec::new(),
        explanation: made.report.to_string(),
        report: made.report,
        clip: made.clip,
        anatomy: made.anatomy,
        handedness: made.handedness,
        parts: parts::of(&made.notes),
    }
}

fn timed(note: &Note) -> TimedNote {
    let (about, feature) = match &note.about {
        About::Gloss => ("sign", None),
        About::Transition => ("transition", None),
        About::Cue(tier) => ("cue", Some(tier.name().to_owned())),
        About::Component(component, feature) => (component.name(), feature.clone()),
    };
    TimedNote {
        about,
        feature,
        hand: note.hand,
        value: note.value.value().map(str::to_owned),
        start_us: note.span.start().micros(),
        end_us: note.span.end().micros(),
        from: note.origin.clone(),
    }
}

fn store(
    connection: &Connection,
    recipe: &Recipe,
    resolved: &Resolved,
    made: &Generated,
    gloss: &str,
) -> Result<(i64, i64, String)> {
    if made.clip.frames() == 0 {
        return Err(Error::wrong("the recipe generates no movement"));
    }
    let signer_id = signer_of(connection, made)?;
    let name = recordings::free_name(connection, gloss)?;
    let recording = recordings::insert_recording(
        connection,
        &RecordingRow {
            id: 0,
            name: name.clone(),
            signer_id,
            signer: None,
            origin: Origin::Made,
            duration_us: made.clip.span().micros(),
            licence: None,
            notes: None,
        },
    )?;
    store_movement(connection, recording, resolved, made)?;
    let inventories = inventories::load(connection)?;
    store_tiers(connection, recording, made, gloss, &inventories)?;
    tokens::derive(connection, recording, None, &inventories)?;
    phases::store(connection, recording)?;
    store_recipe(connection, recording, recipe, resolved, made)?;
    let token = signs::tokens_of_recording(connection, recording)?;
    let token = token
        .first()
        .ok_or_else(|| Error::wrong("the new sign got no token"))?
        .id;
    Ok((recording, token, name))
}

/// Returns the signer whose body moves, if known.
fn signer_of(connection: &Connection, made: &Generated) -> Result<Option<i64>> {
    Ok(match made.signer.as_deref().map(str::parse) {
        Some(Ok(Address::Signer(name))) => Some(address::signer(connection, &name)?.id),
        _ => None,
    })
}

/// Returns the hierarchy and unit of the source whose skeleton moves, so that the new sign can be written in the same
/// form.
fn source_of(
    connection: &Connection,
    resolved: &Resolved,
    made: &Generated,
) -> Result<Option<(Hierarchy, Convention)>> {
    for (address, _) in moving_inputs(resolved) {
        let Ok(stretch) = address::stretch(connection, &address.parse()?) else {
            continue;
        };
        // A recording that has only a face is performed by the program's own body.
        if recordings::body_track(connection, stretch.recording.id)?.is_none() {
            continue;
        }
        let track = MotionTrack::of(connection, stretch.recording.id)?;
        let skeleton = convert::skeleton(&track.hierarchy).ok();
        let same =
            skeleton.is_some_and(|it| track.convention.skeleton(&it) == **made.clip.skeleton());
        if same {
            return Ok(Some((track.hierarchy, track.convention)));
        }
    }
    Ok(None)
}

fn store_movement(
    connection: &Connection,
    recording: i64,
    resolved: &Resolved,
    made: &Generated,
) -> Result<()> {
    let (hierarchy, convention) = match source_of(connection, resolved, made)? {
        Some(source) => source,
        None => (
            convert::hierarchy(made.clip.skeleton(), DECIMALS),
            Convention::MODEL,
        ),
    };
    let clip = convention.clip_back(&made.clip);
    let hierarchy = convert::widened(&hierarchy, &clip);
    let fault = |error: convert::BackError| Error::wrong(error.to_string());
    let columns = convert::columns(&clip, &hierarchy, DECIMALS).map_err(fault)?;
    let groups = movement::channel_groups(made.clip.skeleton(), &made.anatomy);
    let named: BTreeMap<&str, &Vec<usize>> = groups
        .iter()
        .map(|(group, joints)| (group.name(), joints))
        .collect();
    let roles: BTreeMap<String, String> = made
        .anatomy
        .found()
        .map(|(part, joint, _)| (part.to_string(), clip.skeleton().joint(joint).name.clone()))
        .collect();
    let document = serde_json::to_string(&hierarchy).map_err(|e| Error::wrong(e.to_string()))?;
    let hash = hex(&Sha256::digest(document.as_bytes()));
    let joints = hierarchy.joints.len();
    let rate = clip.rate();
    let track = recordings::insert_motion_track(
        connection,
        &MotionTrackRow {
            id: 0,
            recording_id: recording,
            name: "body".to_owned(),
            offset_us: 0,
            skeleton_id: recordings::skeleton_stored(connection, &hash, joints, &document)?,
            frames: clip.frames() as i64,
            rate_frames: rate.frames(),
            rate_seconds: rate.per_seconds(),
            frame_time: Some(format!("{:.9}", rate.frame_time())),
            metres_per_unit: convention.metres_per_unit,
            axes: convention.axes.to_string(),
            root_order: None,
            root_scale: None,
            roles: Some(json!(roles).to_string()),
            channel_groups: json!(named).to_string(),
        },
    )?;
    let numbers: Vec<_> = groups
        .iter()
        .map(|(group, joints)| (*group, movement::columns_of(&hierarchy, joints)))
        .collect();
    for first in (0..clip.frames()).step_by(BLOCK_FRAMES) {
        let rows = first..clip.frames().min(first + BLOCK_FRAMES);
        let part: Vec<Column> = columns
            .iter()
            .map(|column| Column {
                scale: column.scale,
                mantissas: column.mantissas[rows.clone()].to_vec(),
                exceptions: Vec::new(),
            })
            .collect();
        movement::store_block(connection, track, &numbers, first, rows.len(), &part)?;
    }
    curves::store(connection, recording, &made.curves, (rate, clip.frames()))?;
    Ok(())
}

fn store_tiers(
    connection: &Connection,
    recording: i64,
    made: &Generated,
    gloss: &str,
    inventories: &[StoredInventory],
) -> Result<()> {
    let whole = made.clip.span();
    let root = TierRow {
        role: TierRole::Gloss,
        ..new_tier(recording, "Gloss", 0)
    };
    let root = tiers::insert_tier(connection, &root)?;
    let row = AnnotationRow {
        tier_id: root,
        start_us: whole.start().micros(),
        end_us: whole.end().micros(),
        state: ValueState::Value,
        value: gloss.to_owned(),
        origin: AnnotationOrigin::Made,
        ..AnnotationRow::default()
    };
    tiers::insert_annotation(connection, &row)?;
    store_notes(connection, recording, made, inventories)
}

/// Writes the notes of generated movement onto tiers below the existing ones; an existing tier of the same name is
/// used, and its annotations remain.
fn store_notes(
    connection: &Connection,
    recording: i64,
    made: &Generated,
    inventories: &[StoredInventory],
) -> Result<()> {
    let whole = made.clip.span();
    let mut by_tier: BTreeMap<String, Vec<&Note>> = BTreeMap::new();
    for note in &made.notes {
        by_tier.entry(tier_name(note)).or_default().push(note);
    }
    let standing = tiers::tiers(connection, recording)?;
    let next = 1 + standing.iter().map(|it| it.position).max().unwrap_or(-1);
    for (position, (name, notes)) in by_tier.into_iter().enumerate() {
        let (tier, said) = match standing.iter().find(|it| it.name == name) {
            Some(tier) => (tier.id, tiers::annotations(connection, tier.id)?),
            None => {
                let place = next + position as i64;
                let tier = note_tier(recording, &name, place, notes[0], inventories);
                (tiers::insert_tier(connection, &tier)?, Vec::new())
            }
        };
        let taken =
            |start: i64, end: i64| said.iter().any(|it| it.start_us < end && it.end_us > start);
        let mut free_from = whole.start();
        for note in notes {
            let (start, end) = (
                note.span.start().max(free_from),
                note.span.end().min(whole.end()),
            );
            if start >= end || taken(start.micros(), end.micros()) {
                continue;
            }
            free_from = end;
            let row = AnnotationRow {
                tier_id: tier,
                start_us: start.micros(),
                end_us: end.micros(),
                state: ValueState::of(&note.value),
                value: note.value.value().unwrap_or_default().to_owned(),
                origin: AnnotationOrigin::Made,
                source: Some(json!({ "from": note.origin }).to_string()),
                ..AnnotationRow::default()
            };
            tiers::insert_annotation(connection, &row)?;
        }
    }
    Ok(())
}

fn new_tier(recording_id: i64, name: &str, position: i64) -> TierRow {
    TierRow {
        recording_id,
        name: name.to_owned(),
        position,
        ..TierRow::default()
    }
}

fn tier_name(note: &Note) -> String {
    let hand = match note.hand {
        Some(Side::Right) => " RH",
        Some(Side::Left) => " LH",
        None => "",
    };
    match &note.about {
        About::Gloss => SOURCE.to_owned(),
        About::Transition => format!("Transition{hand}"),
        About::Cue(tier) => tier.name().to_owned(),
        About::Component(component, feature) => {
            let name = feature.as_deref().unwrap_or(component.name());
            let mut letters = name.chars();
            let first = letters.next().map(char::to_uppercase);
            format!(
                "{}{}{hand}",
                first.into_iter().flatten().collect::<String>(),
                letters.as_str()
            )
        }
    }
}

fn note_tier(
    recording: i64,
    name: &str,
    position: i64,
    note: &Note,
    inventories: &[StoredInventory],
) -> TierRow {
    let mut tier = new_tier(recording, name, position);
    let About::Component(component, feature) = &note.about else {
        let is_key = note.about == About::Cue(CueTier::Keys);
        tier.role = match is_key {
            true => TierRole::Gloss,
            false => TierRole::Free,
        };
        return tier;
    };
    let mut field = Field::new(*component);
    field.feature.clone_from(feature);
    let manual = *component != Component::NonManual;
    let builtin = inventory::builtin_for(&field).map(|it| it.id.as_str());
    let known = matches!(&note.value, Reading::Value(_));
    tier.role = TierRole::Component {
        component: *component,
        feature: feature.clone(),
    };
    let hand = note.hand.filter(|_| manual);
    tier.hand = hand.map(|side| Hands::One(side.into()));
    tier.inventory_id = inventories
        .iter()
        .find(|it| known && Some(it.inventory.id.as_str()) == builtin)
        .map(|it| it.id);
    tier
}

fn store_recipe(
    connection: &Connection,
    recording: i64,
    recipe: &Recipe,
    resolved: &Resolved,
    made: &Generated,
) -> Result<()> {
    let row = recipe_row(recording, recipe, resolved, made)?;
    let id = recipes::insert(connection, &row)?;
    store_inputs(connection, id, resolved)
}

fn recipe_row(
    recording: i64,
    recipe: &Recipe,
    resolved: &Resolved,
    made: &Generated,
) -> Result<RecipeRow> {
    let fault = |error: serde_json::Error| Error::wrong(error.to_string());
    let document = json!({
        "recipe": serde_json::to_value(recipe).map_err(fault)?,
        "inputs": serde_json::to_value(resolved.inputs()).map_err(fault)?,
    });
    Ok(RecipeRow {
        id: 0,
        recording_id: recording,
        text: recipe.to_string(),
        document: document.to_string(),
        report: serde_json::to_string(&made.report).map_err(fault)?,
        engine: engine(),
    })
}

/// The tier that names the source of each stretch of a generated sign.
pub(crate) const SOURCE: &str = "Source";

/// Returns the version of the program and of its movement generators.
pub(crate) fn engine() -> String {
    format!("{}+{ENGINE}", env!("CARGO_PKG_VERSION"))
}

fn store_inputs(connection: &Connection, recipe: i64, resolved: &Resolved) -> Result<()> {
    let moving = moving_inputs(resolved).map(|(address, hash)| (address.as_str(), hash.as_str()));
    let given = resolved.inputs().0.values().flat_map(Input::givers);
    for (address, hash) in moving.chain(given.map(|address| (address, ""))) {
        let (source, token) = source_rows(connection, address)?;
        recipes::insert_input(connection, recipe, address, source, token, hash)?;
    }
    Ok(())
}

/// Returns the addresses and hashes of all movement that a recipe uses: its sources, and the bodies that perform
/// notations.
fn moving_inputs(resolved: &Resolved) -> impl Iterator<Item = (&String, &String)> {
    let inputs = resolved.inputs().0.values();
    let materials = inputs.filter_map(|input| match input {
        Input::Material(material) => Some(material),
        _ => None,
    });
    materials.flat_map(|it| {
        let body = it.body.as_ref().map(|body| (&body.address, &body.hash));
        std::iter::once((&it.address, &it.hash)).chain(body)
    })
}

/// Returns the recording and the token at an input's address.
pub(crate) fn source_rows(
    connection: &Connection,
    address: &str,
) -> Result<(Option<i64>, Option<i64>)> {
    Ok(match address.parse()? {
        Address::Token(token) => (signs::token(connection, token)?.recording_id, Some(token)),
        Address::Recording(Name::Number(recording)) => (Some(recording), None),
        _ => (None, None),
    })
}
