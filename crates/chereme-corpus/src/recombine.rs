//! New signs from stored ones: evaluates a recipe, and stores the result with its movement, tiers and sources.

mod recombine_again;
mod recombine_draft;
mod recombine_parts;

use std::collections::{BTreeMap, BTreeSet};

use chereme_compose::{
    CueTier, ENGINE_VERSION, GeneratedMovement, GeneratedNote, GenerationReport, NoteSubject, Recipe, RecipeInput,
    ResolvedRecipe, shorten_step_text,
};
use chereme_formats::bvh::bvh_convert;
use chereme_formats::bvh::raw::{BvhHierarchy, Column};
use chereme_motion::anatomy::BodyAnatomy;
use chereme_motion::{BodySide, Clip, FacePosture, SpaceConvention};
use chereme_sign::ErrorRemedy;
use chereme_sign::inventory;
use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{ComponentField, ComponentReading, SignComponent, SignerHandedness, TierRole};
use rusqlite::Connection;
use serde::Serialize;
use serde_json::json;
use sha2::{Digest, Sha256};

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::consent::{ConsentKind, OutputAudience, OutputGate, WithheldOutput};
use crate::curves;
use crate::db::recipes::{self, RecipeRow};
use crate::db::signs;
use crate::db::stored_check::run_and_roll_back;
use crate::db::stored_columns::{AnnotationOrigin, RecordOrigin, ValueState};
use crate::db::stored_motion::to_hex_text;
use crate::db::stored_recordings::{self, MotionTrackRow, RecordingRow};
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult, FailedStep};
use crate::face::PerformanceChoice;
use crate::inventories::{self, StoredInventory};
use crate::movement::{self, BLOCK_FRAMES, MotionTrack};
use crate::sources::{CorpusSources, sources_cue_phases};
use crate::tokens;
use crate::words::effect::OperationEffect;

pub(crate) use recombine_draft::DraftedRecipe;
pub use recombine_parts::MadePart;

/// The number of decimals of generated movement: a millionth of a degree, or of the file's unit.
const GENERATED_DECIMALS: u8 = 6;

/// The result of evaluating a recipe, stored or not.
#[derive(Debug, Clone, Serialize)]
pub struct RecombinationResult {
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
    pub report: GenerationReport,
    /// The report in words.
    #[serde(skip)]
    pub explanation: String,
    /// The movement.
    #[serde(skip)]
    pub clip: Clip,
    /// The face in each frame, if non-manuals give it; otherwise empty.
    #[serde(skip)]
    pub faces: Vec<FacePosture>,
    /// The body parts of the movement's joints.
    #[serde(skip)]
    pub anatomy: std::sync::Arc<BodyAnatomy>,
    /// The signer's handedness.
    #[serde(skip)]
    pub handedness: SignerHandedness,
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
    pub hand: Option<BodySide>,
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
    pub remedy: Option<ErrorRemedy>,
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
    pub fn preview_recipe(&mut self, recipe: &str) -> CorpusResult<RecombinationResult> {
        let (_, made, recipe) = self.evaluate_recipe_text(recipe)?;
        Ok(recombination(&recipe, String::new(), made))
    }

    /// Evaluates a recipe and stores its movement as a sign with this gloss, with its tiers and its sources.
    ///
    /// # Errors
    /// As [`preview_recipe`](Self::preview_recipe); nothing incomplete is stored.
    pub fn recombine_recipe(&mut self, recipe: &str, gloss: &str) -> CorpusResult<RecombinationResult> {
        let gloss = gloss.trim();
        if gloss.is_empty() {
            return Err(
                CorpusError::from_wrong_message("a new sign needs a gloss").with_command_advice("write --as GLOSS")
            );
        }
        let (resolved, made, recipe) = self.evaluate_recipe_text(recipe)?;
        let (recording, token, name) = self.store.run_store_operation(|connection| {
            let stored = store_generated_sign(connection, &recipe, &resolved, &made, gloss)?;
            let (gloss, recipe) = (gloss.to_owned(), recipe.to_string());
            Ok((stored, OperationEffect::Recombine { gloss, recipe }))
        })?;
        let mut done = recombination(&recipe, gloss.to_owned(), made);
        (done.token, done.recording, done.name) = (Some(token), Some(recording), Some(name));
        Ok(done)
    }

    /// Animates a sentence with the face of a performance: the recipe `SENTENCE | nonmanual … by phases`, stored as `gloss`.
    ///
    /// # Errors
    /// Those of [`recombine`](Self::recombine_recipe).
    pub fn animate_choice(
        &mut self,
        choice: &PerformanceChoice,
        token: &str,
        gloss: &str,
    ) -> CorpusResult<RecombinationResult> {
        let recipe = self.recipe_of_choice(choice, token)?;
        self.recombine_recipe(&recipe, gloss)
    }

    /// Returns why the movement of a recipe is withheld from an audience: it is stored, judged and taken back. A recipe
    /// that cannot be evaluated is refused where it is shown.
    pub(crate) fn withheld_recipe(
        &mut self,
        recipe: &str,
        audience: OutputAudience,
    ) -> CorpusResult<Option<WithheldOutput>> {
        let Ok((resolved, made, written)) = self.evaluate_recipe_text(recipe) else {
            return Ok(None);
        };
        let connection = self.store.read_connection();
        // Consent is judged from stored rows, so that the sign has to be one for a moment.
        run_and_roll_back(connection, || {
            let (recording, ..) = store_generated_sign(connection, &written, &resolved, &made, recipe)?;
            let gate = OutputGate::open_output_gate(connection, audience)?;
            Ok(gate.withheld_output(recording, &[ConsentKind::Movement]))
        })
    }

    /// Returns the source recordings of a recipe; none if it cannot be evaluated.
    pub(crate) fn recipe_sources(&mut self, recipe: &str) -> CorpusResult<BTreeSet<i64>> {
        let mut sources = BTreeSet::new();
        if let Ok((resolved, ..)) = self.evaluate_recipe_text(recipe) {
            // Tokens that give a posture or a place count too, though nothing of their movement is used.
            let given = resolved.resolved_inputs().0.values();
            let given = given.flat_map(RecipeInput::input_giver_addresses);
            for address in moving_inputs(&resolved)
                .map(|(address, _)| address.as_str())
                .chain(given)
            {
                sources.extend(source_rows(self.store.read_connection(), address)?.0);
            }
        }
        Ok(sources)
    }

    pub(crate) fn evaluate_recipe_text(
        &mut self,
        recipe: &str,
    ) -> CorpusResult<(ResolvedRecipe, GeneratedMovement, Recipe)> {
        let recipe = read_recipe_text(recipe)?;
        let inventories = self.inventories_now()?;
        let sources = CorpusSources::open_corpus_sources(&mut self.store, &inventories, &self.learned)?;
        let resolved = chereme_compose::resolve_recipe(&recipe, &sources).map_err(cannot)?;
        let made = chereme_compose::evaluate_recipe(&resolved).map_err(cannot)?;
        Ok((resolved, made, recipe))
    }
}

/// Reads a recipe as text, or as JSON if it begins with a brace.
fn read_recipe_text(text: &str) -> CorpusResult<Recipe> {
    if text.trim_start().starts_with('{') {
        return serde_json::from_str(text).map_err(|error| {
            CorpusError::from_wrong_message(format!("the recipe cannot be read: {error}"))
                .with_error_place(shorten_step_text(text))
                .with_advice("a recipe in JSON is, for example, {\"version\": 1, \"make\": {\"sign\": \"BOL\"}}")
        });
    }
    text.parse().map_err(|error: chereme_compose::RecipeError| {
        let pointed = match &error {
            chereme_compose::RecipeError::Text(text) if !text.text.is_empty() => {
                format!("\n{}", text.mark_fault_character())
            }
            _ => String::new(),
        };
        CorpusError::from_wrong_message(format!("the recipe cannot be read: {error}{pointed}"))
            .with_error_place(shorten_step_text(text))
            .with_advice("a recipe is a sign and the changes to it, such as: ESCARGOT | configure right U")
    })
}

/// Returns the failure of a step of a recipe.
fn cannot(error: chereme_compose::MakeError) -> CorpusError {
    let list_remedy = || ErrorRemedy::command_remedy("`chereme list CORPUS signs` and `… values` list what there is");
    CorpusError::Step(Box::new(FailedStep {
        remedy: error.cause.step_remedy().unwrap_or_else(list_remedy),
        meant: error.cause.step_meant_name(),
        cause: error.cause.to_string(),
        step: shorten_step_text(&error.step),
        path: error.path,
    }))
}

fn recombination(recipe: &Recipe, gloss: String, made: GeneratedMovement) -> RecombinationResult {
    RecombinationResult {
        recipe: recipe.to_string(),
        gloss,
        token: None,
        recording: None,
        name: None,
        duration_us: made.clip.clip_span().span_micros(),
        notes: made.notes.iter().map(timed_note).collect(),
        faces: chereme_compose::faces_from_curves(&made.curves),
        curves: made.curves.into_iter().map(|curve| curve.name).collect(),
        findings: Vec::new(),
        explanation: made.report.to_string(),
        report: made.report,
        clip: made.clip,
        anatomy: made.anatomy,
        handedness: made.handedness,
        parts: recombine_parts::made_parts_from_notes(&made.notes),
    }
}

fn timed_note(note: &GeneratedNote) -> TimedNote {
    let (about, feature) = match &note.about {
        NoteSubject::Gloss => ("sign", None),
        NoteSubject::Transition => ("transition", None),
        NoteSubject::Cue(tier) => ("cue", Some(tier.cue_tier_name().to_owned())),
        NoteSubject::Component(component, feature) => (component.component_name(), feature.clone()),
    };
    TimedNote {
        about,
        feature,
        hand: note.hand,
        value: note.value.reading_value().map(str::to_owned),
        start_us: note.span.span_start_instant().instant_micros(),
        end_us: note.span.span_end_instant().instant_micros(),
        from: note.origin.clone(),
    }
}

fn store_generated_sign(
    connection: &Connection,
    recipe: &Recipe,
    resolved: &ResolvedRecipe,
    made: &GeneratedMovement,
    gloss: &str,
) -> CorpusResult<(i64, i64, String)> {
    if made.clip.clip_frame_count() == 0 {
        return Err(CorpusError::from_wrong_message("the recipe generates no movement"));
    }
    let signer_id = signer_of(connection, made)?;
    let name = stored_recordings::free_recording_name(connection, gloss)?;
    let recording = stored_recordings::insert_recording(
        connection,
        &RecordingRow {
            id: 0,
            name: name.clone(),
            signer_id,
            signer: None,
            origin: RecordOrigin::Made,
            duration_us: made.clip.clip_span().span_micros(),
            licence: None,
            notes: None,
        },
    )?;
    store_movement(connection, recording, resolved, made)?;
    let inventories = inventories::load_all_inventories(connection)?;
    store_tiers(connection, recording, made, gloss, &inventories)?;
    // The token follows from the gloss, so that it comes after the tiers and before the phases of its keys.
    tokens::update_recording_tokens(connection, recording, None, &inventories)?;
    sources_cue_phases::store_cue_phases(connection, recording)?;
    store_recipe(connection, recording, recipe, resolved, made)?;
    let recording_tokens = signs::tokens_of_recording(connection, recording)?;
    let token = recording_tokens
        .first()
        .ok_or_else(|| CorpusError::from_wrong_message("the new sign got no token"))?
        .id;
    Ok((recording, token, name))
}

/// Returns the signer whose body moves, if known.
fn signer_of(connection: &Connection, made: &GeneratedMovement) -> CorpusResult<Option<i64>> {
    Ok(match made.signer.as_deref().map(str::parse) {
        Some(Ok(CorpusAddress::Signer(name))) => Some(address::find_signer_by_name(connection, &name)?.id),
        _ => None,
    })
}

/// Returns the hierarchy and unit of the source whose skeleton moves, so that the new sign can be written in the same
/// form.
fn source_of(
    connection: &Connection,
    resolved: &ResolvedRecipe,
    made: &GeneratedMovement,
) -> CorpusResult<Option<(BvhHierarchy, SpaceConvention)>> {
    for (address, _) in moving_inputs(resolved) {
        let Ok(stretch) = address::find_addressed_stretch(connection, &address.parse()?) else {
            continue;
        };
        // A recording that has only a face is performed by the program's own body.
        if stored_recordings::body_track(connection, stretch.recording.id)?.is_none() {
            continue;
        }
        let track = MotionTrack::open_motion_track(connection, stretch.recording.id)?;
        let skeleton = bvh_convert::skeleton_from_hierarchy(&track.hierarchy).ok();
        let same = skeleton
            .is_some_and(|stored| track.convention.file_skeleton_to_model(&stored) == **made.clip.clip_skeleton());
        if same {
            return Ok(Some((track.hierarchy, track.convention)));
        }
    }
    Ok(None)
}

fn store_movement(
    connection: &Connection,
    recording: i64,
    resolved: &ResolvedRecipe,
    made: &GeneratedMovement,
) -> CorpusResult<()> {
    let (hierarchy, convention) = match source_of(connection, resolved, made)? {
        Some(source) => source,
        None => (
            bvh_convert::hierarchy_from_skeleton(made.clip.clip_skeleton(), GENERATED_DECIMALS),
            SpaceConvention::MODEL_CONVENTION,
        ),
    };
    // The movement goes back into the unit and axes of its source, whose skeleton it shares then.
    let clip = convention.clip_back(&made.clip);
    // A recipe may move joints that the source keeps in place, which need channels of their own.
    let hierarchy = bvh_convert::widen_hierarchy(&hierarchy, &clip);
    let fault = |error: bvh_convert::BackError| CorpusError::from_wrong_message(error.to_string());
    let columns = bvh_convert::columns_from_clip(&clip, &hierarchy, GENERATED_DECIMALS).map_err(fault)?;
    let groups = movement::channel_groups(made.clip.clip_skeleton(), &made.anatomy);
    let named: BTreeMap<&str, &Vec<usize>> = groups
        .iter()
        .map(|(group, joints)| (group.channel_group_name(), joints))
        .collect();
    // Parts were found on the source; names alone might find others on this hierarchy.
    let roles: BTreeMap<String, String> = made
        .anatomy
        .found_parts()
        .map(|(part, joint, _)| (part.to_string(), clip.clip_skeleton().joint_at(joint).name.clone()))
        .collect();
    let document = serde_json::to_string(&hierarchy).map_err(|e| CorpusError::from_wrong_message(e.to_string()))?;
    let hash = to_hex_text(&Sha256::digest(document.as_bytes()));
    let joints = hierarchy.joints.len();
    let rate = clip.clip_frame_rate();
    let track = stored_recordings::insert_motion_track(
        connection,
        &MotionTrackRow {
            id: 0,
            recording_id: recording,
            name: "body".to_owned(),
            offset_us: 0,
            skeleton_id: stored_recordings::skeleton_stored(connection, &hash, joints, &document)?,
            frames: clip.clip_frame_count() as i64,
            rate_frames: rate.rate_numerator(),
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
    for first in (0..clip.clip_frame_count()).step_by(BLOCK_FRAMES) {
        let rows = first..clip.clip_frame_count().min(first + BLOCK_FRAMES);
        let part: Vec<Column> = columns
            .iter()
            .map(|column| Column {
                scale: column.scale,
                mantissas: column.mantissas[rows.clone()].to_vec(),
                exceptions: Vec::new(),
            })
            .collect();
        movement::store_block_groups(connection, track, &numbers, first, rows.len(), &part)?;
    }
    curves::store_generated_curves(connection, recording, &made.curves, rate, clip.clip_frame_count())?;
    Ok(())
}

fn store_tiers(
    connection: &Connection,
    recording: i64,
    made: &GeneratedMovement,
    gloss: &str,
    inventories: &[StoredInventory],
) -> CorpusResult<()> {
    let full_span = made.clip.clip_span();
    let root_row = TierRow {
        role: TierRole::Gloss,
        ..new_tier(recording, "Gloss", 0)
    };
    let root = stored_tiers::insert_tier(connection, &root_row)?;
    let row = AnnotationRow {
        tier_id: root,
        start_us: full_span.span_start_instant().instant_micros(),
        end_us: full_span.span_end_instant().instant_micros(),
        state: ValueState::Value,
        value: gloss.to_owned(),
        origin: AnnotationOrigin::Made,
        ..AnnotationRow::default()
    };
    stored_tiers::insert_annotation(connection, &row)?;
    store_notes(connection, recording, made, inventories)
}

/// Writes the notes of generated movement onto tiers below the existing ones; an existing tier of the same name is
/// used, and its annotations remain.
fn store_notes(
    connection: &Connection,
    recording: i64,
    made: &GeneratedMovement,
    inventories: &[StoredInventory],
) -> CorpusResult<()> {
    let full_span = made.clip.clip_span();
    let mut by_tier: BTreeMap<String, Vec<&GeneratedNote>> = BTreeMap::new();
    for note in &made.notes {
        by_tier.entry(tier_name(note)).or_default().push(note);
    }
    let standing = stored_tiers::load_tier_rows(connection, recording)?;
    let next = 1 + standing.iter().map(|tier_row| tier_row.position).max().unwrap_or(-1);
    for (position, (name, notes)) in by_tier.into_iter().enumerate() {
        let (tier, said) = match standing.iter().find(|tier_row| tier_row.name == name) {
            Some(tier) => (tier.id, stored_tiers::load_tier_annotation_rows(connection, tier.id)?),
            None => {
                let place = next + position as i64;
                let tier = note_tier(recording, &name, place, notes[0], inventories);
                (stored_tiers::insert_tier(connection, &tier)?, Vec::new())
            }
        };
        // Annotations of people on such a tier stay, and generated ones make way for them.
        let taken = |start: i64, end: i64| {
            said.iter()
                .any(|annotation| annotation.start_us < end && annotation.end_us > start)
        };
        let mut free_from = full_span.span_start_instant();
        for note in notes {
            // Annotations of one tier may not overlap, and notes of successive pieces may.
            let (start, end) = (
                note.span.span_start_instant().max(free_from),
                note.span.span_end_instant().min(full_span.span_end_instant()),
            );
            if start >= end || taken(start.instant_micros(), end.instant_micros()) {
                continue;
            }
            free_from = end;
            let row = AnnotationRow {
                tier_id: tier,
                start_us: start.instant_micros(),
                end_us: end.instant_micros(),
                state: ValueState::state_of_reading(&note.value),
                value: note.value.reading_value().unwrap_or_default().to_owned(),
                origin: AnnotationOrigin::Made,
                source: Some(json!({ "from": note.origin }).to_string()),
                ..AnnotationRow::default()
            };
            stored_tiers::insert_annotation(connection, &row)?;
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

fn tier_name(note: &GeneratedNote) -> String {
    let hand = match note.hand {
        Some(BodySide::Right) => " RH",
        Some(BodySide::Left) => " LH",
        None => "",
    };
    match &note.about {
        NoteSubject::Gloss => SOURCE_TIER_NAME.to_owned(),
        NoteSubject::Transition => format!("Transition{hand}"),
        NoteSubject::Cue(tier) => tier.cue_tier_name().to_owned(),
        NoteSubject::Component(component, feature) => {
            let name = feature.as_deref().unwrap_or(component.component_name());
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
    note: &GeneratedNote,
    inventories: &[StoredInventory],
) -> TierRow {
    let mut tier = new_tier(recording, name, position);
    let NoteSubject::Component(component, feature) = &note.about else {
        // Keys of cued speech are the glosses from which its tokens follow.
        let is_key = note.about == NoteSubject::Cue(CueTier::Keys);
        tier.role = match is_key {
            true => TierRole::Gloss,
            false => TierRole::Free,
        };
        return tier;
    };
    let mut field = ComponentField::new(*component);
    field.feature.clone_from(feature);
    let manual = *component != SignComponent::NonManual;
    let builtin = inventory::builtin_for(&field).map(|inventory| inventory.id.as_str());
    let is_value = matches!(&note.value, ComponentReading::Value(_));
    tier.role = TierRole::Component {
        component: *component,
        feature: feature.clone(),
    };
    let hand = note.hand.filter(|_| manual);
    tier.hand = hand.map(|side| AnnotatedHands::One(side.into()));
    // A value that is unknown or does not apply belongs to no inventory.
    tier.inventory_id = inventories
        .iter()
        .find(|stored| is_value && Some(stored.inventory.id.as_str()) == builtin)
        .map(|stored| stored.id);
    tier
}

fn store_recipe(
    connection: &Connection,
    recording: i64,
    recipe: &Recipe,
    resolved: &ResolvedRecipe,
    made: &GeneratedMovement,
) -> CorpusResult<()> {
    let row = recipe_row(recording, recipe, resolved, made)?;
    let id = recipes::insert_recipe_row(connection, &row)?;
    store_inputs(connection, id, resolved)
}

fn recipe_row(
    recording: i64,
    recipe: &Recipe,
    resolved: &ResolvedRecipe,
    made: &GeneratedMovement,
) -> CorpusResult<RecipeRow> {
    let fault = |error: serde_json::Error| CorpusError::from_wrong_message(error.to_string());
    let document = json!({
        "recipe": serde_json::to_value(recipe).map_err(fault)?,
        "inputs": serde_json::to_value(resolved.resolved_inputs()).map_err(fault)?,
    });
    Ok(RecipeRow {
        id: 0,
        recording_id: recording,
        text: recipe.to_string(),
        document: document.to_string(),
        report: serde_json::to_string(&made.report).map_err(fault)?,
        engine: engine_version(),
    })
}

/// The tier that names the source of each stretch of a generated sign.
pub(crate) const SOURCE_TIER_NAME: &str = "Source";

/// Returns the version of the program and of its movement generators.
pub(crate) fn engine_version() -> String {
    format!("{}+{ENGINE_VERSION}", env!("CARGO_PKG_VERSION"))
}

fn store_inputs(connection: &Connection, recipe: i64, resolved: &ResolvedRecipe) -> CorpusResult<()> {
    let moving = moving_inputs(resolved).map(|(address, hash)| (address.as_str(), hash.as_str()));
    let given = resolved
        .resolved_inputs()
        .0
        .values()
        .flat_map(RecipeInput::input_giver_addresses);
    for (address, hash) in moving.chain(given.map(|address| (address, ""))) {
        let (source, token) = source_rows(connection, address)?;
        recipes::insert_input(connection, recipe, address, source, token, hash)?;
    }
    Ok(())
}

/// Returns the addresses and hashes of all movement that a recipe uses: its sources, and the bodies that perform
/// notations.
fn moving_inputs(resolved: &ResolvedRecipe) -> impl Iterator<Item = (&String, &String)> {
    let inputs = resolved.resolved_inputs().0.values();
    let materials = inputs.filter_map(|input| match input {
        RecipeInput::Material(material) => Some(material),
        _ => None,
    });
    materials.flat_map(|material| {
        let body = material.body.as_ref().map(|body| (&body.address, &body.hash));
        std::iter::once((&material.address, &material.hash)).chain(body)
    })
}

/// Returns the recording and the token at an input's address.
pub(crate) fn source_rows(connection: &Connection, address: &str) -> CorpusResult<(Option<i64>, Option<i64>)> {
    Ok(match address.parse()? {
        CorpusAddress::Token(token) => (signs::load_token_row(connection, token)?.recording_id, Some(token)),
        CorpusAddress::Recording(RowName::Number(recording)) => (Some(recording), None),
        _ => (None, None),
    })
}
