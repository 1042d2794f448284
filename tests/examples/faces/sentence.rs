//! Generates sentences whose faces and milestones are known.

use std::fmt::Write as _;

use chereme_corpus::{
    AnnotateOptions, AnnotationAction, Corpus, ExpressionFunction, ExpressionMilestones, NewTier, ProgressReceiver,
    RecordingInstant, RowName, TableMoment, TierRequestName, TierRole, ignore_progress_step,
};
use chereme_formats::eaf::eaf_convert::{AnnotationTiming, AnnotationTranscript, TranscriptAnnotation, TranscriptTier};
use chereme_formats::textgrid::{self, INTERVAL_TIER_KIND, TextGridForm};
use chereme_motion::TimeSpan;
use chereme_sign::milestones::{UTTERANCE_EDGE_MICROS, find_expression_milestones};

/// A small generator of numbers (splitmix64), which gives the same numbers in every run.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    /// Returns the next number from 0 to 1.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a number of about the normal distribution.
    pub(crate) fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.next()).sum::<f64>() - 6.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// The known parameters of a performance, in the part between onset and offset.
#[derive(Debug, Clone, Copy)]
struct Manner {
    /// Brows raised in the first part of the body and in the rest.
    brows: [f64; 2],
    /// Brows drawn together.
    squeeze: f64,
    /// The head turned down, in degrees.
    pitch: f64,
    /// The size of a shake of the head, in degrees.
    shake: f64,
}

/// A sentence with its signs and its face.
pub(crate) struct Sentence {
    pub(crate) name: String,
    pub(crate) function: &'static str,
    pub(crate) milestones: ExpressionMilestones,
    seconds: f64,
    signs: Vec<(String, TimeSpan)>,
    body: TimeSpan,
    manner: Manner,
}

/// The frame rate of the captures.
const RATE: f64 = 30.0;

impl Sentence {
    /// Returns the 18 sentences of the experiment: N1 to N6, W1 to W6, Y2 to Y7.
    pub(crate) fn all() -> Vec<Self> {
        let mut numbers = Numbers(4);
        let mut all = Vec::new();
        for (letter, function, first) in [("N", "negation", 1), ("W", "wh", 1), ("Y", "yn", 2)] {
            for number in first..first + 6 {
                all.push(Self::new(format!("{letter}{number}"), function, &mut numbers));
            }
        }
        all
    }

    /// Returns a sentence of a function with lengths and a manner drawn from `numbers`.
    pub(crate) fn new(name: String, function: &'static str, numbers: &mut Numbers) -> Self {
        let before = usize::from(numbers.next() < 0.7);
        let inside = 2 + (numbers.next() * 3.0) as usize;
        let after = usize::from(function == "negation" && numbers.next() < 0.6);
        let mut at = 200 + (numbers.next() * 300.0) as i64;
        let mut signs = Vec::new();
        for n in 0..before + inside + after {
            let end = at + 300 + (numbers.next() * 400.0) as i64;
            let span = TimeSpan::span_between(RecordingInstant::from_millis(at), RecordingInstant::from_millis(end));
            signs.push((format!("S{}", n + 1), span));
            at = end + 40 + (numbers.next() * 120.0) as i64;
        }
        let spans: Vec<TimeSpan> = signs.iter().map(|(_, span)| *span).collect();
        let range = before..before + inside;
        let found = find_expression_milestones(
            &spans,
            range.clone(),
            &ExpressionFunction::from_function_name(function),
            UTTERANCE_EDGE_MICROS,
        );
        let body = TimeSpan::span_between(
            spans[range.start].span_start_instant(),
            spans[range.end - 1].span_end_instant(),
        );
        let manner = match function {
            "negation" => Manner {
                brows: [numbers.between(-0.4, 0.0), numbers.between(-0.3, 0.0)],
                squeeze: numbers.between(0.2, 0.7),
                pitch: numbers.between(-2.0, 4.0),
                shake: numbers.between(4.0, 16.0),
            },
            "wh" => Manner {
                brows: [numbers.between(-0.6, -0.1), numbers.between(-0.9, -0.3)],
                squeeze: numbers.between(0.4, 1.0),
                pitch: numbers.between(3.0, 14.0),
                shake: 0.0,
            },
            _ => Manner {
                brows: [numbers.between(0.3, 0.9), numbers.between(0.5, 1.0)],
                squeeze: 0.0,
                pitch: numbers.between(4.0, 12.0),
                shake: 0.0,
            },
        };
        Self {
            name,
            function,
            milestones: found.unwrap_or_else(|| ExpressionMilestones::of_times([RecordingInstant::RECORDING_START; 5])),
            seconds: (at + 700) as f64 / 1000.0,
            signs,
            body,
            manner,
        }
    }

    /// Returns the strength of the expression at a moment, and the elapsed share of its middle part.
    fn course(&self, seconds: f64) -> (f64, f64) {
        let [m1, m2, m3, m4, m5] = self.milestones.milestone_times().map(RecordingInstant::instant_seconds);
        let smooth = |share: f64| {
            let share = share.clamp(0.0, 1.0);
            share * share * (3.0 - 2.0 * share)
        };
        let step = |on: bool| f64::from(u8::from(on));
        let rise = match m2 > m1 {
            true => (seconds - m1) / (m2 - m1),
            false => step(seconds >= m2),
        };
        let fall = match m5 > m4 {
            true => (m5 - seconds) / (m5 - m4),
            false => step(seconds < m4),
        };
        let part = smooth((seconds - m3) / 0.2 + 0.5);
        (smooth(rise).min(smooth(fall)), part)
    }

    /// Returns the same performance in another tempo: one that lasts about `seconds` from M1 to M5, because the half
    /// seconds at the edges of an utterance do not stretch.
    pub(crate) fn lasting(mut self, seconds: f64) -> Self {
        let factor = seconds / self.milestones.milestone_span().span_seconds();
        let at =
            |time: RecordingInstant| RecordingInstant::from_millis((time.instant_seconds() * factor * 1000.0) as i64);
        let slower =
            |span: &TimeSpan| TimeSpan::span_between(at(span.span_start_instant()), at(span.span_end_instant()));
        for (_, span) in &mut self.signs {
            *span = slower(span);
        }
        self.body = slower(&self.body);
        let spans: Vec<TimeSpan> = self.signs.iter().map(|(_, span)| *span).collect();
        let inside = |span: &TimeSpan| self.body.has_instant(span.span_start_instant());
        let first = spans.iter().position(inside).unwrap_or(0);
        let count = spans.iter().filter(|span| inside(span)).count();
        let function = ExpressionFunction::from_function_name(self.function);
        if let Some(found) = find_expression_milestones(&spans, first..first + count, &function, UTTERANCE_EDGE_MICROS)
        {
            self.milestones = found;
        }
        self.seconds = spans
            .last()
            .map_or(0.0, |span| span.span_end_instant().instant_seconds())
            + 0.7;
        self
    }

    /// Returns the number of frames from M1 to M5.
    pub(crate) fn frames(&self) -> f64 {
        self.milestones.milestone_span().span_seconds() * RATE
    }

    /// Returns the signs and the function as a TextGrid, so that they are imported with the capture file of that name.
    pub(crate) fn text_grid(&self) -> String {
        let mut next = 0;
        let mut tier = |name: &str, of: &[(String, TimeSpan)]| {
            let annotations = of.iter().map(|(value, span)| {
                next += 1;
                TranscriptAnnotation {
                    id: format!("a{next}"),
                    span: *span,
                    timing: AnnotationTiming::Own,
                    parent: None,
                    order: 0,
                    value: value.clone(),
                    entry: None,
                    language: None,
                    external_ref: None,
                    millis: None,
                }
            });
            TranscriptTier {
                name: name.to_owned(),
                kind: INTERVAL_TIER_KIND.to_owned(),
                annotations: annotations.collect(),
                ..TranscriptTier::default()
            }
        };
        let function = [(self.function.to_owned(), self.body)];
        let both = AnnotationTranscript {
            tiers: vec![tier("gloss", &self.signs), tier("function", &function)],
            ..AnnotationTranscript::default()
        };
        let end = RecordingInstant::from_seconds(self.seconds);
        textgrid::write_textgrid(&both, TextGridForm::Short, end).0
    }

    /// Returns the raised brow at a moment.
    pub(crate) fn brow(&self, seconds: f64) -> f64 {
        let (much, part) = self.course(seconds);
        let [first, rest] = self.manner.brows;
        much * (first + (rest - first) * part)
    }

    /// Returns the difference of two performances' manners, in the units that count as 1 in scores.
    pub(crate) fn difference(&self, other: &Self) -> f64 {
        let (a, b) = (self.manner, other.manner);
        let brows: f64 = (0..2).map(|n| ((a.brows[n] - b.brows[n]) / 0.25).powi(2)).sum();
        let squeeze = ((a.squeeze - b.squeeze) / 0.25).powi(2);
        let shake = ((a.shake - b.shake) / 10.0).powi(2) / 2.0;
        let head = ((a.pitch - b.pitch) / 10.0).powi(2) + shake;
        (brows + squeeze + head).sqrt()
    }

    /// Returns the performance as a file of MPEG-4 parameters, counted from 1 as in the standard.
    pub(crate) fn fap(&self) -> String {
        let frames = (self.seconds * RATE) as usize;
        let used = [31, 32, 33, 34, 35, 36, 37, 38, 48, 49, 50];
        let mask = (1..=68).map(|n| if used.contains(&n) { "1" } else { "0" });
        let mask = mask.collect::<Vec<&str>>().join(" ");
        let mut text = format!("2.1 {} {RATE} {frames}\n", self.name);
        for frame in 0..frames {
            let seconds = frame as f64 / RATE;
            let (much, _) = self.course(seconds);
            let brow = (300.0 * self.brow(seconds)).round();
            let squeeze = (300.0 * much * self.manner.squeeze).round();
            let degree = 100_000.0_f64.to_radians();
            let pitch = (degree * much * self.manner.pitch).round();
            let from = seconds - self.body.span_start_instant().instant_seconds();
            let swing = (from * 2.2 * std::f64::consts::TAU).sin();
            let yaw = (degree * much * self.manner.shake * swing).round();
            let brows = [brow; 6].map(|it| it.to_string()).join(" ");
            let _ = writeln!(text, "{mask}\n{frame} {brows} {squeeze} {squeeze} {pitch} {yaw} 0");
        }
        text
    }

    /// Writes the signs and the function of the sentence onto tiers.
    pub(crate) fn annotate(&self, corpus: &mut Corpus) -> chereme_corpus::CorpusResult<()> {
        add(corpus, &self.name, "gloss", TierRole::Gloss, self.signs.clone())?;
        let function = vec![(self.function.to_owned(), self.body)];
        add(corpus, &self.name, "function", TierRole::Free, function)
    }
}

fn add(
    corpus: &mut Corpus,
    recording: &str,
    tier: &str,
    role: TierRole,
    spans: Vec<(String, TimeSpan)>,
) -> chereme_corpus::CorpusResult<()> {
    let name = RowName::Text(recording.to_owned());
    corpus.add_tier(&NewTier::new(name.clone(), tier, role))?;
    let change = |(value, span): (String, TimeSpan)| {
        AnnotationAction::Add {
            tier: TierRequestName::Of {
                recording: name.clone(),
                tier: tier.to_owned(),
            },
            start: Some(TableMoment::Time(span.span_start_instant())),
            end: Some(TableMoment::Time(span.span_end_instant())),
            parent: None,
            order: None,
            value,
            confidence: None,
        }
        .into()
    };
    let changes: Vec<_> = spans.into_iter().map(change).collect();
    let mut hear = ignore_progress_step;
    corpus.annotate_corpus(
        &changes,
        &AnnotateOptions::default(),
        &mut ProgressReceiver::new(&mut hear),
    )?;
    Ok(())
}
