//! The parts of `chereme annotate` that change tiers, recordings, signers and signs.

use anyhow::Result;
use chereme_corpus::words::InterfaceLanguage;
use chereme_corpus::{
    AnnotatedHands, CopiedAnnotations, Corpus, CorpusAddress, CorpusError, NewTier, RecordOrigin, RecordingChange,
    RowName, SignChange, SignerChange, TierPropertyChange, TierRequestName, TierRoundOptions, TierRoundScope,
    TierRoundWork, TierScheme, TierStereotype, TierTopic, TierValueSource,
};
use chereme_motion::BodySide;
use clap::{Subcommand, ValueEnum};

use super::annotate;
use crate::args::BODY_SIDE_CHOICES;
use crate::output::{CommandOutput, with_progress_bar};
use crate::words::tier_roles_help;

#[derive(Debug, Subcommand)]
pub(super) enum TierCommand {
    /// Add a tier to the recording named by --in, or to several
    AddTier {
        /// Its name
        name: String,
        #[arg(long, default_value = "free", help = tier_roles_help(InterfaceLanguage::English))]
        role: TierTopic,
        /// The hand of the annotations, if the role does not name it
        #[arg(long, value_enum)]
        hand: Option<HandWord>,
        /// The parent tier
        #[arg(long, requires = "stereotype")]
        parent: Option<String>,
        /// Its relation to the parent: Time_Subdivision, Included_In, Symbolic_Subdivision or Symbolic_Association
        #[arg(long, requires = "parent", value_parser = parse_tier_stereotype)]
        stereotype: Option<TierStereotype>,
        /// The inventory of its values; without it the usual one of its component
        #[arg(long)]
        inventory: Option<String>,
        #[command(flatten)]
        people: TierPeople,
        #[command(flatten)]
        round: TierRoundArgs,
    },
    /// Add the usual tiers to the recording named by --in, or those of another recording
    ///
    /// The usual tiers: gloss and translation; below the gloss handshape, placement, movement with its direction, palm
    /// and finger direction of either hand, mouth, brows and head; and a comment. If a tier of that name exists, it
    /// stays as it is.
    AddTiers {
        /// The recording whose tiers are copied, without their annotations
        #[arg(long, value_name = "RECORDING")]
        like: Option<String>,
        #[command(flatten)]
        round: TierRoundArgs,
    },
    /// Change a tier: its name, subject, hand, inventory, people or language
    Tier {
        /// The tier
        tier: String,
        /// Its new name
        #[arg(long)]
        name: Option<String>,
        /// The subject of its annotations; the word before the dot, as in right.placement, is their hand
        #[arg(long)]
        role: Option<TierTopic>,
        /// The hand of the annotations, if the role does not name it
        #[arg(long, value_enum)]
        hand: Option<HandWord>,
        /// The inventory of its values
        #[arg(long)]
        inventory: Option<String>,
        #[command(flatten)]
        people: TierPeople,
        #[command(flatten)]
        round: TierRoundArgs,
    },
    /// Copy a tier under another name
    CopyTier {
        /// The tier
        tier: String,
        /// The name of the copy
        name: String,
        /// Leave out the values of its annotations
        #[arg(long, conflicts_with_all = ["bare", "holding"])]
        blank: bool,
        /// Leave out its annotations
        #[arg(long, conflicts_with = "holding")]
        bare: bool,
        /// Take only annotations whose value contains this text, ignoring case and accents
        #[arg(long, value_name = "TEXT")]
        holding: Option<String>,
        #[command(flatten)]
        round: TierRoundArgs,
    },
    /// Remove a tier, the tiers below it, and all their annotations
    RemoveTier {
        /// The tier
        tier: String,
        #[command(flatten)]
        round: TierRoundArgs,
    },
    /// Change the recording named by --in: its name, signer or remarks
    Recording {
        /// Its new name
        #[arg(long)]
        name: Option<String>,
        /// The signer who moves
        #[arg(long)]
        signer: Option<String>,
        /// The origin: captured, made or generated
        #[arg(long)]
        origin: Option<String>,
        /// The terms under which it may be used
        #[arg(long)]
        licence: Option<String>,
        /// Remarks
        #[arg(long)]
        notes: Option<String>,
    },
    /// Change a signer: name, handedness or remarks
    Signer {
        /// The signer
        signer: String,
        /// The new name
        #[arg(long)]
        name: Option<String>,
        /// The dominant hand
        #[arg(long, value_parser = BODY_SIDE_CHOICES)]
        handedness: Option<BodySide>,
    },
    /// Change a sign: its gloss, remarks and translations
    Sign {
        /// The gloss
        sign: String,
        /// The new gloss
        #[arg(long)]
        gloss: Option<String>,
        /// Remarks
        #[arg(long)]
        notes: Option<String>,
        /// Add a translation, such as fr=escargot
        #[arg(long, value_name = "LANGUAGE=TEXT", value_parser = parse_language_text)]
        add: Vec<(String, String)>,
        /// Remove a translation
        #[arg(long, value_name = "LANGUAGE=TEXT", value_parser = parse_language_text)]
        drop: Vec<(String, String)>,
    },
    /// Name the annotator whose values count where several have annotated the same; without a name nobody
    Prefer {
        /// The annotator, as tiers name it
        annotator: Option<String>,
    },
    /// Make a token the citation form of its sign
    Cite {
        /// The token, such as token:41
        token: String,
    },
}

/// The person and the language of a tier; an empty text removes the old one.
#[derive(Debug, clap::Args)]
pub(super) struct TierPeople {
    /// The signer who is annotated, whom `signer=` finds; "" removes the name
    #[arg(long, value_name = "NAME")]
    participant: Option<String>,
    /// The annotator; "" removes the name
    #[arg(long, value_name = "NAME")]
    annotator: Option<String>,
    /// The language of its values, such as de; "" removes it
    #[arg(long)]
    language: Option<String>,
}

/// The recordings of work on tiers, if there are several.
#[derive(Debug, clap::Args)]
pub(super) struct TierRoundArgs {
    /// In all recordings that a query means: by signer=, file=, recording= and signer.NAME=, or else with a token that it finds
    #[arg(long = "where", value_name = "QUERY", conflicts_with = "all")]
    query: Option<String>,
    /// In all recordings of the corpus
    #[arg(long)]
    all: bool,
    /// Report what would change, and write nothing
    #[arg(long)]
    pub(super) dry_run: bool,
    /// Leave out recordings that refuse the change; without it nothing is done if one of them refuses
    #[arg(long)]
    skip: bool,
}

impl TierRoundArgs {
    /// Returns the recordings if there may be several; `None` for work in the recording named by `--in`.
    pub(super) fn named_scope(&self, recording: Option<&RowName>) -> Result<Option<TierRoundScope>> {
        Ok(match (&self.query, recording) {
            (Some(_), Some(_)) => return Err(recordings_named_twice().into()),
            (None, Some(_)) if self.all => return Err(recordings_named_twice().into()),
            (Some(query), None) => Some(TierRoundScope::Query(query.clone())),
            (None, None) => self.all.then_some(TierRoundScope::All),
            (None, Some(RowName::Text(text))) if text.contains('*') || text.starts_with("signer:") => {
                Some(TierRoundScope::Pattern(text.clone()))
            }
            (None, Some(_)) => None,
        })
    }

    /// Returns the recordings of work that may be tried or leave out recordings.
    fn round_scope(&self, recording: Option<&RowName>) -> Result<Option<TierRoundScope>> {
        let named = self.named_scope(recording)?;
        if named.is_some() || !(self.dry_run || self.skip) {
            return Ok(named);
        }
        let recording = recording.cloned().ok_or_else(annotate::which_recording)?;
        Ok(Some(TierRoundScope::Pattern(match recording {
            RowName::Text(text) => text,
            number => CorpusAddress::Recording(number).to_string(),
        })))
    }
}

fn recordings_named_twice() -> CorpusError {
    CorpusError::from_wrong_message("the recordings are named twice").with_advice("give one of --in, --where and --all")
}

/// Does the same work on the tiers of several recordings, and lists what it did in each.
pub(super) fn run_tier_round(
    corpus: &mut Corpus,
    scope: &TierRoundScope,
    work: &TierRoundWork,
    round: &TierRoundArgs,
    output: &mut CommandOutput,
) -> Result<()> {
    let options = TierRoundOptions {
        dry_run: round.dry_run,
        skip: round.skip,
    };
    let report = with_progress_bar(|progress| corpus.work_on_tiers(scope, work, options, progress))?;
    if report.dry_run {
        output.write_output_line("nothing is written; it would be:")?;
    }
    if report.only_with_tokens {
        output.write_output_line("the query is about tokens: recordings without one are left out")?;
    }
    for row in &report.recordings {
        let name = format!("recording:{} {:?}", row.recording, row.name);
        match &row.refused {
            Some(why) => {
                let why = output.translate_message(why);
                output.filled_line("{recording} refuses: {why}", &[&name, &why])?;
            }
            None => {
                let count = output.format_counted_noun(row.annotations, "annotations");
                output.filled_line("{recording}: {tiers} ({n})", &[&name, &row.tiers.join(", "), &count])?;
            }
        }
    }
    output.line_as_is(&report.round_sentence(output.output_language()))?;
    output.set_json_document(report)
}

/// Returns the text; `None` if it is empty or blank.
fn non_blank_text(text: &Option<String>) -> Option<String> {
    let text = text.as_deref().map(str::trim);
    text.filter(|text| !text.is_empty()).map(str::to_owned)
}

/// Returns the hand that a role or an option names; `None` if neither does.
fn hand_of(topic: Option<&TierTopic>, word: Option<HandWord>) -> Result<Option<Option<AnnotatedHands>>> {
    let asked = word.map(HandWord::to_tier_hands);
    // Both may name the hand if they name the same.
    match (topic.and_then(|topic| topic.hand), asked) {
        (Some(own), Some(asked)) if Some(own) != asked => {
            let other = asked.map_or("none", AnnotatedHands::annotated_hands_name);
            let wrong = format!("--role names the {own} hand, and --hand says {other}");
            Err(CorpusError::from_wrong_message(wrong)
                .with_advice("name the hand once")
                .into())
        }
        (Some(own), _) => Ok(Some(Some(own))),
        (None, asked) => Ok(asked),
    }
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum HandWord {
    Right,
    Left,
    Dominant,
    Weak,
    Both,
    /// No hand
    None,
}

impl HandWord {
    fn to_tier_hands(self) -> Option<AnnotatedHands> {
        use chereme_sign::HandRef;
        Some(match self {
            Self::Right => AnnotatedHands::One(HandRef::Right),
            Self::Left => AnnotatedHands::One(HandRef::Left),
            Self::Dominant => AnnotatedHands::One(HandRef::Dominant),
            Self::Weak => AnnotatedHands::One(HandRef::Weak),
            Self::Both => AnnotatedHands::Both,
            Self::None => return None,
        })
    }
}

fn parse_tier_stereotype(text: &str) -> Result<TierStereotype, String> {
    let names: Vec<&str> = TierStereotype::ALL_TIER_STEREOTYPES
        .iter()
        .map(|kind| kind.elan_name())
        .collect();
    TierStereotype::from_elan_name(text).ok_or_else(|| format!("write one of {}", names.join(", ")))
}

fn parse_language_text(text: &str) -> Result<(String, String), String> {
    let (language, text) = text.split_once('=').ok_or("write LANGUAGE=TEXT, such as fr=escargot")?;
    Ok((language.to_owned(), text.to_owned()))
}

impl TierCommand {
    /// Returns the work on tiers that several recordings may have done at once, with the choice of recordings; `None`
    /// for changes of something else.
    fn work_on_tiers(&self) -> Result<Option<(TierRoundWork, &TierRoundArgs)>> {
        Ok(Some(match self {
            Self::AddTier {
                name,
                role,
                hand,
                parent,
                stereotype,
                inventory,
                people,
                round,
            } => {
                // Each recording puts its own number in this place.
                let mut tier = NewTier::new(RowName::Number(0), name.clone(), role.role.clone());
                // An empty option is the same as none for a new tier.
                tier.hand = hand_of(Some(role), *hand)?.flatten();
                tier.participant = non_blank_text(&people.participant);
                tier.annotator = non_blank_text(&people.annotator);
                tier.language = non_blank_text(&people.language);
                tier.parent = parent.clone().zip(*stereotype);
                if let Some(inventory) = inventory {
                    tier.values = TierValueSource::Inventory(inventory.clone());
                }
                (TierRoundWork::Add(tier), round)
            }
            Self::AddTiers { like, round } => {
                let other = like.as_deref().map(annotate::parse_annotated_recording).transpose()?;
                let scheme = other.map_or(TierScheme::Usual, TierScheme::Like);
                (TierRoundWork::AddScheme(scheme), round)
            }
            Self::Tier {
                tier,
                name,
                role,
                hand,
                inventory,
                people,
                round,
            } => {
                let change = TierPropertyChange {
                    name: name.clone(),
                    role: role.as_ref().map(|topic| topic.role.clone()),
                    hand: hand_of(role.as_ref(), *hand)?,
                    values: inventory.clone().map(TierValueSource::Inventory),
                    // An empty text is passed on here: it removes the old one.
                    participant: people.participant.clone().map(Some),
                    annotator: people.annotator.clone().map(Some),
                    language: people.language.clone().map(Some),
                    ..TierPropertyChange::default()
                };
                let tier = tier.clone();
                (TierRoundWork::Change { tier, change }, round)
            }
            Self::CopyTier {
                tier,
                name,
                blank,
                bare,
                holding,
                round,
            } => {
                let copied = match (blank, bare, holding) {
                    (_, _, Some(text)) => CopiedAnnotations::Holding(text.clone()),
                    (true, ..) => CopiedAnnotations::Times,
                    (_, true, _) => CopiedAnnotations::Nothing,
                    _ => CopiedAnnotations::All,
                };
                let (tier, name) = (tier.clone(), name.clone());
                (TierRoundWork::Copy { tier, name, copied }, round)
            }
            Self::RemoveTier { tier, round } => {
                let tier = tier.clone();
                (TierRoundWork::Remove { tier }, round)
            }
            _ => return Ok(None),
        }))
    }
}

pub(super) fn run(
    corpus: &mut Corpus,
    action: &TierCommand,
    recording: Option<&RowName>,
    output: &mut CommandOutput,
) -> Result<()> {
    match action.work_on_tiers()? {
        Some((work, round)) => match round.round_scope(recording)? {
            Some(scope) => run_tier_round(corpus, &scope, &work, round, output),
            None => work_in_recording(corpus, work, recording, output),
        },
        None => change_described_row(corpus, action, recording, output),
    }
}

/// Does work on the tiers of one recording.
fn work_in_recording(
    corpus: &mut Corpus,
    work: TierRoundWork,
    recording: Option<&RowName>,
    output: &mut CommandOutput,
) -> Result<()> {
    let needed = || recording.cloned().ok_or_else(annotate::which_recording);
    match work {
        TierRoundWork::Add(tier) => {
            let recording = needed()?;
            let row = corpus.add_tier(&NewTier { recording, ..tier })?;
            output.filled_line("added tier:{id}, {name}", &[&row.id, &format_args!("{:?}", row.name)])?;
            output.set_json_document(row)
        }
        TierRoundWork::AddScheme(scheme) => {
            let rows = corpus.add_tiers(&needed()?, &scheme)?;
            for row in &rows {
                output.filled_line("added tier:{id}, {name}", &[&row.id, &format_args!("{:?}", row.name)])?;
            }
            output.set_json_document(rows)
        }
        TierRoundWork::Change { tier, change } => {
            let row = corpus.change_tier_properties(&TierRequestName::parse_tier_name(&tier, recording)?, &change)?;
            output.filled_line("changed tier:{id}, {name}", &[&row.id, &format_args!("{:?}", row.name)])?;
            output.set_json_document(row)
        }
        TierRoundWork::Copy { tier, name, copied } => {
            let row = corpus.copy_tier(&TierRequestName::parse_tier_name(&tier, recording)?, &name, &copied)?;
            output.filled_line("added tier:{id}, {name}", &[&row.id, &format_args!("{:?}", row.name)])?;
            output.set_json_document(row)
        }
        TierRoundWork::Remove { tier } => {
            let removed = corpus.remove_tier(&TierRequestName::parse_tier_name(&tier, recording)?)?;
            let count = output.format_counted_noun(removed.annotations, "annotations");
            output.filled_line("removed {names} with {n}", &[&removed.tiers.join(", "), &count])?;
            output.set_json_document(removed)
        }
        // A command of its own moves tiers in time.
        TierRoundWork::Shift { .. } => Ok(()),
    }
}

/// Changes what describes tiers and recordings: recordings, signers, signs, the preferred annotator, citation forms.
fn change_described_row(
    corpus: &mut Corpus,
    action: &TierCommand,
    recording: Option<&RowName>,
    output: &mut CommandOutput,
) -> Result<()> {
    match action {
        TierCommand::Recording {
            name,
            signer,
            origin,
            licence,
            notes,
        } => {
            let recording = recording.cloned().ok_or_else(annotate::which_recording)?;
            let change = RecordingChange {
                name: name.clone(),
                signer: signer.clone().map(Some),
                origin: origin
                    .as_deref()
                    .map(RecordOrigin::parse_recording_origin)
                    .transpose()?,
                licence: licence.clone().map(Some),
                notes: notes.clone().map(Some),
            };
            let row = corpus.change_recording(&recording, &change)?;
            output.filled_line(
                "changed recording:{id}, {name}",
                &[&row.id, &format_args!("{:?}", row.name)],
            )?;
            output.set_json_document(row)
        }
        TierCommand::Signer {
            signer,
            name,
            handedness,
        } => {
            let change = SignerChange {
                name: name.clone(),
                handedness: handedness.map(Some),
                notes: None,
            };
            let named = match signer.parse()? {
                CorpusAddress::Signer(name) => name,
                _ => annotate::parse_annotated_recording(signer)?,
            };
            let row = corpus.change_signer(&named, &change)?;
            output.filled_line(
                "changed signer:{id}, {name}",
                &[&row.id, &format_args!("{:?}", row.name)],
            )?;
            output.set_json_document(row)
        }
        TierCommand::Sign {
            sign,
            gloss,
            notes,
            add,
            drop,
        } => {
            let change = SignChange {
                gloss: gloss.clone(),
                notes: notes.clone().map(Some),
                add_texts: add.clone(),
                remove_texts: drop.clone(),
            };
            let named = match sign.parse()? {
                CorpusAddress::Sign(name) => name,
                _ => RowName::Text(sign.clone()),
            };
            let gloss = corpus.change_sign(&named, &change)?;
            output.filled_line("changed {gloss}", &[&gloss])?;
            output.set_json_document(serde_json::json!({ "gloss": gloss }))
        }
        TierCommand::Prefer { annotator } => {
            corpus.prefer_annotator(annotator.as_deref())?;
            match annotator {
                Some(name) => output.filled_line("{name} counts before other annotators", &[name])?,
                None => output.filled_line("no annotator counts before others", &[])?,
            }
            output.set_json_document(serde_json::json!({ "annotator": annotator }))
        }
        TierCommand::Cite { token } => {
            let row = corpus.set_citation(&token.parse()?)?;
            output.filled_line("token:{id} is the citation form of {gloss}", &[&row.id, &row.gloss])?;
            output.set_json_document(row)
        }
        // These are work on tiers.
        TierCommand::AddTier { .. }
        | TierCommand::AddTiers { .. }
        | TierCommand::Tier { .. }
        | TierCommand::CopyTier { .. }
        | TierCommand::RemoveTier { .. } => Ok(()),
    }
}
