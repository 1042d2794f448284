//! `repeat`: plays the movement several times, growing or shrinking, faster or slower.

use chereme_motion::Side;
use chereme_sign::Component;
use chereme_sign::words::Text;

use crate::contact::{self, Carry, Keep};
use crate::course::Courses;
use crate::error::Cause;
use crate::ops::join::{self, Seam};
use crate::ops::{Description, amplify, cut, retime, say};
use crate::outcome::About;
use crate::work::{Group, Work};
use std::fmt::{self, Display, Formatter};

use chereme_sign::Handedness;
use serde::{Deserialize, Serialize};

use crate::answers::{Ask, Given, Setting, Slot};
use crate::check;
use crate::error::RecipeError;
use crate::ops::{Done, Field, FieldSetting, Operator, Syntax};
use crate::recipe::{Profile, Transition};
use crate::sources::LearnedProfile;
use crate::text::{Parsed, Parser, option};
use crate::units::{Factor, Seconds};

/// Settings of `repeat 3 scale 0.8 tempo 1.2 gap 0.1s`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Repeat {
    /// The number of times that the movement is played, from 1 on.
    pub times: u32,
    /// The factor on the size of the hands' movement from each repetition to the next.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<Factor>,
    /// The factor on the speed from each repetition to the next.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tempo: Option<Factor>,
    /// The time between two repetitions, the transition included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap: Option<Seconds>,
    /// The transition between two repetitions; the default course is slerp, as in the founding paper.
    #[serde(default, skip_serializing_if = "Transition::is_default")]
    pub via: Transition,
}

/// The most repetitions.
pub const MOST_REPETITIONS: u32 = 1000;
/// The learned courses of the returns to the start.
const VIA: Slot<LearnedProfile> = Slot::new("repeat/via");

impl Syntax for Repeat {
    const NAME: &'static str = "repeat";
    const KEYWORDS: &'static [&'static str] = &["scale", "tempo", "gap"];
    const DESCRIPTION: Description = Description {
        title: Text::new("Repeat", "Répéter"),
        hint: Text::new("again and again", "encore et encore"),
        examples: &[(
            "repeat 3 scale 0.8 tempo 1.2 gap 0.1s",
            Text::new(
                "again, each smaller and faster",
                "de nouveau, toujours plus petit et plus vite",
            ),
        )],
        messages: &[
            Text::new(
                "out of reach: a wrist stays {cm} cm short",
                "hors de portée : il manque {cm} cm à un poignet",
            ),
            Text::new(
                "{times} times, {gap} frames between",
                "{times} fois, {gap} images entre deux",
            ),
            Text::new(
                "the hands do not go back to rest between them",
                "les mains ne reviennent pas au repos entre deux",
            ),
            Text::new(
                "repetition {n} to {next}: {what}",
                "répétition {n} à {next} : {what}",
            ),
            Text::new("repetition {n}: {what}", "répétition {n} : {what}"),
            Text::new(
                "repetition {one} to {next}",
                "de la répétition {one} à {next}",
            ),
            Text::new("how often, such as 2", "combien de fois, comme 2"),
            Text::new("the number of times", "le nombre de fois"),
        ],
    };

    fn parse(parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        let mut repeat = Self {
            times: parser.count("how often, such as 2")?,
            scale: None,
            tempo: None,
            gap: None,
            via: Transition::default(),
        };
        loop {
            if parser.accept("scale") {
                repeat.scale = Some(parser.quantity("a factor, such as 0.8")?);
            } else if parser.accept("tempo") {
                repeat.tempo = Some(parser.quantity("a factor, such as 1.2")?);
            } else if parser.accept("gap") {
                repeat.gap = Some(parser.quantity("a time, such as 0.1s")?);
            } else if let Some(via) = parser.via()? {
                repeat.via = via;
            } else {
                return Ok(repeat);
            }
        }
    }

    fn usual() -> Self {
        Self {
            times: 2,
            scale: None,
            tempo: None,
            gap: None,
            via: Transition::default(),
        }
    }
}

impl Display for Repeat {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "repeat {}", self.times)?;
        option(f, "scale", self.scale)?;
        option(f, "tempo", self.tempo)?;
        option(f, "gap", self.gap)?;
        write!(f, "{}", self.via)
    }
}

impl Operator for Repeat {
    fn check(&self) -> Result<(), RecipeError> {
        let (step, times) = (Self::NAME, f64::from(self.times));
        let most = f64::from(MOST_REPETITIONS);
        check::range(step, "the number of times", times, 1.0, most)?;
        for (what, factor) in [("scale", self.scale), ("tempo", self.tempo)] {
            if let Some(factor) = factor {
                check::range(step, what, factor.0, 0.05, 20.0)?;
            }
        }
        check::time(step, "gap", self.gap, 60.0)?;
        check::via(step, &self.via)
    }

    fn resolve(&self, ask: &mut Ask<'_>, _setting: &Setting) -> Result<(), Cause> {
        ask.course(&VIA, &self.via)
    }

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        let course = given.course(&VIA, &self.via, Profile::Slerp)?;
        Ok(repeat(work, self, &course, given.text)?.into())
    }

    fn contacts(&self, _handedness: Handedness) -> Option<(Carry, Keep)> {
        None
    }

    fn is_nothing(&self) -> bool {
        self.times == 1
    }

    fn fields(&mut self) -> Vec<FieldSetting<'_>> {
        let setting = |en, fr, field| FieldSetting::new(Text::new(en, fr), field);
        let times = Field::Count(&mut self.times, 1..=20);
        let scale = Field::OptionalFactor(&mut self.scale, 0.8);
        let tempo = Field::OptionalFactor(&mut self.tempo, 1.2);
        vec![
            setting("How often", "Combien de fois", times),
            setting("size", "taille", scale),
            setting("tempo", "tempo", tempo),
            setting("gap", "pause", Field::Time(&mut self.gap, 0.1)),
            FieldSetting::via(&mut self.via),
        ]
    }
}

/// The usual time of the return to the start, in seconds.
const GAP: f64 = 0.12;

/// Plays the movement `times` times.
pub(crate) fn repeat(
    work: &mut Work,
    settings: &Repeat,
    courses: &Courses,
    operator: &str,
) -> Result<join::Done, Cause> {
    let seconds = settings
        .gap
        .or(settings.via.time)
        .map_or(GAP, |time| time.0);
    let gap = (seconds / work.rate.frame_time()).round() as usize;
    let times = settings.times as usize;
    join::check_length(work, times.saturating_mul(work.frames + gap))?;
    let mut once = work.clone();
    let (scale, tempo) = (
        settings.scale.map_or(1.0, |s| s.0),
        settings.tempo.map_or(1.0, |t| t.0),
    );
    let arms: Vec<Side> = Side::BOTH
        .into_iter()
        .filter(|&s| work.anatomy.arm(s).is_some())
        .collect();
    let mut residual: f64 = 0.0;
    let mut done = join::Done::default();
    let (mut tail, mut rested) = (work.frames - cut::signed(work)?.end, false);
    for n in 1..times {
        let mut next = once.clone();
        if scale != 1.0 {
            let mut touched = contact::touches(&next);
            residual = residual.max(amplify::scale(&mut next, &arms, scale)?.residual);
            let keep = Keep::All(&Side::BOTH);
            let what = |text: &String| format!("repetition {}: {text}", n + 1);
            let kept = contact::mend(&mut next, &mut touched, keep, operator);
            done.did.extend(kept.iter().map(what));
            let lost = contact::lost(&touched, &next, Carry::Same);
            done.contacts.extend(lost.iter().map(what));
            let step = format!("{operator}, repetition {}", n + 1);
            done.warnings.extend(contact::long_repairs(&touched, &step));
        }
        if tempo != 1.0 {
            retime::stretch(&mut next, 1.0 / tempo)?;
        }
        if scale != 1.0 || tempo != 1.0 {
            once = next.clone();
        }
        let own = cut::signed(&next)?;
        rested |= tail > 0 || own.start > 0;
        let signed = work.frames - tail;
        cut::keep_quietly(work, 0..signed);
        tail = next.frames - own.end;
        let all = next.frames;
        cut::keep_quietly(&mut next, own.start..all);
        let seam = Seam::plain(work, gap);
        let what = format!("repetition {} to {}", n, n + 1);
        done.joins
            .extend(join::join(work, next, &seam, courses, &what)?);
    }
    if times > 1 {
        work.changed(Group::ALL, operator);
        repeated(work, times, operator);
    }
    let times = format!("{times} times, {gap} frames between");
    done.did.insert(0, times);
    if rested {
        done.did
            .push("the hands do not go back to rest between them".to_owned());
    }
    if residual > 1e-3 {
        done.did.push(format!(
            "out of reach: a wrist stays {:.1} cm short",
            residual * 100.0
        ));
    }
    Ok(done)
}

/// Notes the number of repetitions for each active hand, in place of its earlier value.
fn repeated(work: &mut Work, times: usize, operator: &str) {
    let is_said = |about: &About| matches!(about, About::Component(Component::Movement, Some(it)) if it == "repetition");
    let more = work.notes.iter().any(|note| {
        let value = note.value.value();
        is_said(&note.about) && value.is_some_and(|value| value != "once")
    });
    let value = if times == 2 && !more {
        "twice"
    } else {
        "several"
    };
    work.notes.retain(|note| !is_said(&note.about));
    let dominant = work.handedness.dominant();
    let moves = |side: Side| {
        let manual = |about: &About| matches!(about, About::Component(..));
        let notes = work.notes.iter();
        notes
            .into_iter()
            .any(|note| note.hand == Some(side) && manual(&note.about))
    };
    let sides: Vec<Side> = Side::BOTH
        .into_iter()
        .filter(|&side| side == dominant || moves(side))
        .collect();
    for side in sides {
        let what = (Component::Movement, Some("repetition"));
        say::record(work, side, what, value, 0..work.frames, operator);
    }
}
