//! What a hand does, act after act: cut at minima of speed, named, repetitions folded.

use std::ops::RangeInclusive;

use chereme_sign::hamnosys::{Digit, Digits, Repeat, WristMotion};
use glam::DVec3;

use super::scene::{Scene, Track, length, scaled};
use super::way::{Fitted, Way, fit};
use crate::strokes::{between_minima, smoothed};

/// The least peak of speed of a way in arm lengths a second, and of a turn in radians a second.
const LEAST: (f64, f64) = (0.2, 0.35);
/// The least length of a way in arm lengths: a third of a small movement.
const SHORT: f64 = 0.035;
/// A hand that turns by this, or whose angles change by that, ends in another posture; in radians.
const TURNED: f64 = 0.3;
const RESHAPED: f64 = 0.07;
/// The least range of a hand or finger that goes to and fro, in radians.
const SWAY: f64 = 0.12;
/// A hand stops where it is slower than this share of its speed before and after.
const STOPS: f64 = 0.2;
/// The height of hands that rest before the belly against the shoulders, and how far they come up from
/// there, in arm lengths.
pub(super) const LAP: f64 = -0.65;
const RISE: f64 = 0.4;
/// A hand that goes to and fro turns about a point at most so far off, in metres.
const LEVER: f64 = 0.1;
/// The least time in which a hand may do something else than go a way, in seconds.
const GAP: f64 = 0.1;
/// Two changes are the same, or each other's opposite, where they differ by less than this share.
const ALIKE: f64 = 0.5;

/// Something a hand does.
#[derive(Debug, Clone)]
pub(super) struct Act {
    /// Its first and last frame, the first time it is done.
    pub(super) frames: RangeInclusive<usize>,
    pub(super) kind: Kind,
    /// What it does besides.
    pub(super) with: Option<Sway>,
    /// It ends with the hand turned otherwise, or in another shape.
    pub(super) turned: bool,
    pub(super) reshaped: bool,
    /// How it is repeated, and how often it is done altogether.
    pub(super) repeat: Option<Repeat>,
    pub(super) times: usize,
    /// Its last frame with all repetitions.
    pub(super) until: usize,
}

/// What it does with the hand.
#[derive(Debug, Clone)]
pub(super) enum Kind {
    /// The hand goes a way.
    Way(Fitted),
    /// Wrist or fingers go to and fro where the hand is.
    Sway(Sway),
    /// The hand takes another posture where it is.
    Change,
}

/// A hand or fingers that go to and fro.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Sway {
    /// About the wrist, so far to either side in radians, so often.
    Wrist {
        motion: WristMotion,
        angle: f64,
        cycles: f64,
        runner_up: Option<(WristMotion, f64)>,
    },
    /// Fingers play.
    Play { digits: Digits },
}

impl Act {
    fn first(&self) -> usize {
        *self.frames.start()
    }

    fn last(&self) -> usize {
        *self.frames.end()
    }

    /// Returns what the hand does in a word.
    pub(super) fn name(&self) -> &'static str {
        match &self.kind {
            Kind::Way(fitted) => fitted.way.kind(),
            Kind::Sway(sway) => sway.name(),
            Kind::Change => "replacement",
        }
    }
}

impl Sway {
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Play { .. } => "fingerplay",
            Self::Wrist { motion, .. } => match motion {
                WristMotion::Nodding => "nodding",
                WristMotion::Swinging => "swinging",
                WristMotion::Twisting => "twisting",
                WristMotion::StirCw => "stirring",
                WristMotion::StirCcw => "stirring back",
            },
        }
    }
}

/// A hand with the points of it whose ways are looked at: those that may be meant, and others that the
/// hand may turn about.
pub(super) struct Mover<'a> {
    pub(super) track: &'a Track,
    points: Vec<Vec<DVec3>>,
    /// How many of them may be meant.
    meant: usize,
}

impl<'a> Mover<'a> {
    /// Takes the parts that are at something where the sign begins or ends, and the palm; and what the hand
    /// may turn about: the wrist and other parts.
    pub(super) fn new(
        track: &'a Track,
        touching: &[(DVec3, usize)],
        pivots: &[(DVec3, usize)],
    ) -> Self {
        let carried = |&(at, frame): &(DVec3, usize)| track.carried(at, frame);
        let mut points: Vec<Vec<DVec3>> = touching.iter().map(carried).collect();
        points.push(track.palm.clone());
        let meant = points.len();
        points.push(track.wrist.clone());
        points.extend(pivots.iter().map(carried));
        Self {
            track,
            points,
            meant,
        }
    }

    /// Returns the plainest way of a point that may be meant.
    fn fit(&self, first: usize, last: usize) -> Fitted {
        let score = |fitted: &Fitted| (fitted.residual + EXACT) * plain(&fitted.way);
        let fits = self.points[..self.meant]
            .iter()
            .map(|way| fit(&way[first..=last]));
        fits.min_by(|a, b| score(a).total_cmp(&score(b)))
            .unwrap_or_else(|| fit(&self.track.palm[first..=last]))
    }

    /// Returns the length of the shortest way of a point.
    fn shortest(&self, first: usize, last: usize) -> f64 {
        let lengths = self.points.iter().map(|way| length(&way[first..=last]));
        lengths.fold(f64::MAX, f64::min)
    }
}

/// A way is taken to be off by so much more, in metres, before what it takes to say it counts.
const EXACT: f64 = 0.002;

/// How much a residual counts more for a way that takes more to say.
fn plain(way: &Way) -> f64 {
    match way {
        Way::Straight { .. } => 1.0,
        Way::Arc { .. } => 1.4,
        Way::Circle { .. } => 1.2,
        Way::Wave { .. } => 1.8,
    }
}

/// The frames in which a hand signs, ways from and to rest cut off.
pub(super) fn signing(scene: &Scene<'_>, track: &Track) -> RangeInclusive<usize> {
    let last = track.palm.len() - 1;
    let (ways, _) = ways(scene, &Mover::new(track, &[], &[]), 0, last);
    let mut first = 0;
    let mut end = last;
    // Hands that lie in the lap or are folded before the belly rest, if they come up far from there.
    let lies = |low: usize, high: usize| {
        let (low, high) = (track.palm[low].y, track.palm[high].y);
        low < LAP * scene.arm && high - low > RISE * scene.arm
    };
    let rests = |low: usize, high: usize| track.rests[low] || lies(low, high);
    if let Some(way) = ways.first().filter(|way| rests(*way.start(), *way.end())) {
        first = *way.end();
    }
    if let Some(way) = ways.last().filter(|way| rests(*way.end(), *way.start()))
        && *way.start() >= first
    {
        end = *way.start();
    }
    first..=end.max(first)
}

/// Returns what a hand does in a stretch of frames, in order of time.
pub(super) fn acts(
    scene: &Scene<'_>,
    mover: &Mover<'_>,
    frames: &RangeInclusive<usize>,
) -> Vec<Act> {
    let (first, last) = (*frames.start(), *frames.end());
    if last <= first {
        return Vec::new();
    }
    let track = mover.track;
    let plays = play(scene, track, first, last);
    let mut found = Vec::new();
    let mut from = first;
    let (mut ways, speeds) = ways(scene, mover, first, last);
    if sways(mover, first, last) {
        ways.clear();
    }
    for way in joined(scene, mover, &ways, |n| speeds[n - first]) {
        let (start, end) = (*way.start(), *way.end());
        found.extend(on_the_spot(scene, track, from, start, plays.as_ref()));
        found.push(going(scene, mover, start, end, plays.as_ref()));
        from = end;
    }
    found.extend(on_the_spot(scene, track, from, last, plays.as_ref()));
    folded(scene, track, found)
}

/// Tells whether all that the hand does is to go to and fro about the wrist, or a point near it.
fn sways(mover: &Mover<'_>, first: usize, last: usize) -> bool {
    let Some(Sway::Wrist { angle, cycles, .. }) = wrist(mover.track, first, last) else {
        return false;
    };
    let extent = |way: &Vec<DVec3>| {
        let far = way[first..=last].iter().map(|at| at.distance(way[first]));
        far.fold(0.0, f64::max)
    };
    let least = mover.points.iter().map(extent).fold(f64::MAX, f64::min);
    cycles >= 1.4 && least < LEVER * angle
}

/// Returns the stretches in which the hand goes somewhere, between minima of its speed, and the speeds.
fn ways(
    scene: &Scene<'_>,
    mover: &Mover<'_>,
    first: usize,
    last: usize,
) -> (Vec<RangeInclusive<usize>>, Vec<f64>) {
    let speed = |points: &[DVec3], n: usize| {
        let (a, b) = (n.saturating_sub(1).max(first), (n + 1).min(last));
        points[a].distance(points[b]) / scene.seconds((b - a).max(1))
    };
    let slowest = |n: usize| {
        let speeds = mover.points.iter().map(|points| speed(points, n));
        speeds.fold(f64::MAX, f64::min)
    };
    let speeds: Vec<f64> = (first..=last).map(slowest).collect();
    let mut found = cut(scene, &speeds, LEAST.0 * scene.arm, first);
    found.retain(|way| mover.shortest(*way.start(), *way.end()) > SHORT * scene.arm);
    (found, speeds)
}

/// Cuts at minima of speed; speeds before and after are taken for zero.
fn cut(scene: &Scene<'_>, speeds: &[f64], least: f64, first: usize) -> Vec<RangeInclusive<usize>> {
    const PAD: usize = 2;
    let mut padded = vec![0.0; PAD];
    padded.extend(smoothed(speeds, scene.clip));
    padded.extend([0.0; PAD]);
    let most = speeds.len() - 1;
    between_minima(&padded, least)
        .into_iter()
        .map(|range| {
            let at = |n: usize| first + n.saturating_sub(PAD).min(most);
            at(range.start)..=at(range.end - 1)
        })
        .filter(|range| range.end() > range.start())
        .collect()
}

/// Joins stretches that together are a circle or a wave, and between which the hand does not stop.
fn joined(
    scene: &Scene<'_>,
    mover: &Mover<'_>,
    ways: &[RangeInclusive<usize>],
    speed: impl Fn(usize) -> f64,
) -> Vec<RangeInclusive<usize>> {
    let near = scene.frames(GAP);
    let fastest = |way: &RangeInclusive<usize>| way.clone().map(&speed).fold(0.0, f64::max);
    let mut left = ways;
    let mut found = Vec::new();
    while let Some((first, rest)) = left.split_first() {
        let follow = rest
            .iter()
            .zip(left)
            .take_while(|(next, before)| {
                let goes_on = speed(*before.end()).min(speed(*next.start()));
                next.start() <= &(before.end() + near)
                    && goes_on > STOPS * fastest(before).min(fastest(next))
            })
            .count();
        let whole = (1..=follow).rev().find(|&more| {
            let way = mover.fit(*first.start(), *left[more].end());
            match way.way {
                Way::Circle { turns, long, .. } => {
                    let each = turns / (more + 1) as f64;
                    each < 0.83 && way.residual < 0.15 * long.length()
                }
                Way::Wave { .. } => more >= 2,
                _ => false,
            }
        });
        let joined = whole.unwrap_or(0);
        found.push(*first.start()..=*left[joined].end());
        left = &left[joined + 1..];
    }
    found
}

fn going(
    scene: &Scene<'_>,
    mover: &Mover<'_>,
    first: usize,
    last: usize,
    plays: Option<&Sway>,
) -> Act {
    let track = mover.track;
    let often = |sway: &Sway| matches!(sway, Sway::Wrist { cycles, .. } if *cycles >= 1.4);
    let wrist = wrist(track, first, last).filter(often);
    // A hand that sways as it goes is carried by its wrist.
    let fitted = match &wrist {
        Some(_) => fit(&track.wrist[first..=last]),
        None => mover.fit(first, last),
    };
    let with = plays.cloned().or(wrist);
    Act {
        frames: first..=last,
        turned: !matches!(with, Some(Sway::Wrist { .. }))
            && track.turn(first, last).length() > TURNED,
        reshaped: plays.is_none() && track.reshaped(first, last) > RESHAPED,
        kind: Kind::Way(fitted),
        with,
        repeat: None,
        times: 1,
        until: last.min(scene.clip.frames() - 1),
    }
}

/// Returns what a hand does that goes nowhere.
fn on_the_spot(
    scene: &Scene<'_>,
    track: &Track,
    first: usize,
    last: usize,
    plays: Option<&Sway>,
) -> Vec<Act> {
    if last < first + scene.frames(GAP) {
        return Vec::new();
    }
    let act = |frames: RangeInclusive<usize>, kind: Kind| {
        let (first, last) = (*frames.start(), *frames.end());
        let change = matches!(kind, Kind::Change);
        Act {
            turned: change && track.turn(first, last).length() > TURNED,
            reshaped: change && track.reshaped(first, last) > RESHAPED,
            until: last,
            frames,
            kind,
            with: None,
            repeat: None,
            times: 1,
        }
    };
    if let Some(plays) = plays {
        return vec![act(first..=last, Kind::Sway(plays.clone()))];
    }
    let speeds: Vec<f64> = (first..=last)
        .map(|n| {
            let (a, b) = (n.saturating_sub(1).max(first), (n + 1).min(last));
            let turn = track.turn(a, b).length();
            turn.hypot(track.reshaped(a, b)) / scene.seconds((b - a).max(1))
        })
        .collect();
    let often = |sway: &Sway| matches!(sway, Sway::Wrist { cycles, .. } if *cycles >= 1.0);
    if let Some(sway) = wrist(track, first, last).filter(often) {
        return vec![act(first..=last, Kind::Sway(sway))];
    }
    let changes = cut(scene, &speeds, LEAST.1, first);
    changes
        .into_iter()
        .map(|frames| act(frames, Kind::Change))
        .filter(|act| act.turned || act.reshaped)
        .collect()
}

/// Returns how the hand sways about the wrist, from the middle of its range.
fn wrist(track: &Track, first: usize, last: usize) -> Option<Sway> {
    let start = track.turned[first].inverse();
    let turns: Vec<DVec3> = (first..=last)
        .map(|n| scaled(start * track.turned[n]))
        .collect();
    let parts: [Vec<f64>; 3] = std::array::from_fn(|axis| turns.iter().map(|t| t[axis]).collect());
    let swings = parts.each_ref().map(|part| Swing::of(part));
    let most = (0..3).max_by(|&a, &b| swings[a].range.total_cmp(&swings[b].range))?;
    let swing = swings[most];
    let whole = swing.net < 0.45 * swing.range;
    if swing.range < SWAY || swing.turning < 2 || !whole {
        return None;
    }
    let motions = [
        WristMotion::Twisting,
        WristMotion::Swinging,
        WristMotion::Nodding,
    ];
    let (y, z) = (&swings[1], &swings[2]);
    let round: f64 = (1..turns.len())
        .map(|n| turns[n - 1].y * turns[n].z - turns[n - 1].z * turns[n].y)
        .sum::<f64>()
        / 2.0;
    let narrow = y.range.min(z.range) / y.range.max(z.range).max(1e-9);
    let full = std::f64::consts::PI * y.range * z.range / 4.0;
    if most != 0 && narrow > 0.45 && round.abs() > 0.5 * full {
        // As the signer sees it, from nodding over to swinging.
        let motion = if round > 0.0 {
            WristMotion::StirCw
        } else {
            WristMotion::StirCcw
        };
        return Some(Sway::Wrist {
            motion,
            angle: (y.range + z.range) / 4.0,
            cycles: (round.abs() / full).max(1.0),
            runner_up: Some((motions[most], swing.range / 2.0)),
        });
    }
    if !(0.2..=0.8).contains(&swing.start) {
        return None;
    }
    let next = (0..3)
        .filter(|&axis| axis != most)
        .max_by(|&a, &b| swings[a].range.total_cmp(&swings[b].range));
    Some(Sway::Wrist {
        motion: motions[most],
        angle: swing.range / 2.0,
        cycles: swing.turning as f64 / 2.0,
        runner_up: next.map(|axis| (motions[axis], swings[axis].range / 2.0)),
    })
}

/// Returns whether fingers play over the whole of a stretch, and which.
fn play(scene: &Scene<'_>, track: &Track, first: usize, last: usize) -> Option<Sway> {
    let column = |digit: usize| -> Vec<f64> {
        let at = |n: usize| match digit {
            0 => track.angles[n].thumb.radial,
            _ => track.angles[n].fingers[digit - 1].flexion[0],
        };
        (first..=last).map(at).collect()
    };
    let columns: [Vec<f64>; 5] = std::array::from_fn(column);
    let swings = columns.each_ref().map(|column| Swing::of(column));
    let playing: Vec<usize> = (0..5)
        .filter(|&digit| swings[digit].turning >= 3 && swings[digit].range > SWAY)
        .collect();
    if playing.len() < 2 {
        return None;
    }
    let apart = playing
        .windows(2)
        .any(|pair| correlation(&columns[pair[0]], &columns[pair[1]]).abs() < 0.75);
    let often = playing
        .iter()
        .any(|&digit| swings[digit].turning as f64 / scene.seconds(last - first) > 4.0);
    let digits = playing.iter().map(|&digit| Digit::ALL[digit]).collect();
    (apart && often).then_some(Sway::Play {
        digits: Digits(digits),
    })
}

/// A number that goes to and fro.
#[derive(Debug, Clone, Copy)]
struct Swing {
    range: f64,
    /// How often it turns back.
    turning: usize,
    /// Where in its range it starts, 0 to 1.
    start: f64,
    /// From its start to its end.
    net: f64,
}

impl Swing {
    fn of(values: &[f64]) -> Self {
        let (low, high) = values
            .iter()
            .fold((f64::MAX, f64::MIN), |(l, h), &v| (l.min(v), h.max(v)));
        let range = high - low;
        let (mut turning, mut up, mut edge) = (0, None, values[0]);
        for &value in values {
            let back = match up {
                None => {
                    if (value - edge).abs() > 0.3 * range {
                        up = Some(value > edge);
                        edge = value;
                    }
                    continue;
                }
                Some(true) => edge - value,
                Some(false) => value - edge,
            };
            if back < 0.0 {
                edge = value;
            } else if back > 0.3 * range {
                turning += 1;
                up = up.map(|up| !up);
                edge = value;
            }
        }
        let last = values[values.len() - 1];
        Self {
            range,
            turning: if range > 1e-9 { turning } else { 0 },
            start: (values[0] - low) / range.max(1e-9),
            net: (last - values[0]).abs(),
        }
    }
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (ma, mb) = (mean(a), mean(b));
    let [ab, aa, bb] = a.iter().zip(b).fold([0.0; 3], |[ab, aa, bb], (x, y)| {
        let (x, y) = (x - ma, y - mb);
        [ab + x * y, aa + x * x, bb + y * y]
    });
    ab / (aa * bb).sqrt().max(1e-12)
}

/// What an act changes, each part by what is usual: a way, a turn, the fingers.
fn change(scene: &Scene<'_>, track: &Track, act: &Act) -> Vec<f64> {
    let (first, last) = (act.first(), act.last());
    let chord = match &act.kind {
        Kind::Way(fitted) => fitted.way.chord() / (scene.language.move_normal * scene.arm),
        _ => DVec3::ZERO,
    };
    // Forth and back are opposite only in one and the same frame: that of the body.
    let turn = scaled(track.turned[last] * track.turned[first].inverse()) / 0.8;
    let mut all = chord.to_array().to_vec();
    if act.turned {
        all.extend(turn.to_array());
    } else {
        all.extend([0.0; 3]);
    }
    let (a, b) = (
        track.angles[first].to_array(),
        track.angles[last].to_array(),
    );
    let share = if act.reshaped { 0.25 } else { 0.0 };
    all.extend(a.iter().zip(b).map(|(a, b)| share * (b - a)));
    all
}

fn apart(a: &[f64], b: &[f64], sign: f64) -> f64 {
    let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let off: Vec<f64> = a.iter().zip(b).map(|(x, y)| x - sign * y).collect();
    norm(&off) / norm(a).max(norm(b)).max(1e-9)
}

/// Folds repetitions: circles on end, there and back again, and on and on.
fn folded(scene: &Scene<'_>, track: &Track, acts: Vec<Act>) -> Vec<Act> {
    let changes: Vec<Vec<f64>> = acts.iter().map(|act| change(scene, track, act)).collect();
    let mut found: Vec<Act> = Vec::new();
    let mut n = 0;
    while n < acts.len() {
        let run = |sign: f64| {
            let mut end = n + 1;
            while end < acts.len()
                && !is_round(&acts[end - 1])
                && apart(&changes[end - 1], &changes[end], sign) < ALIKE
            {
                end += 1;
            }
            end - n
        };
        let mut act = acts[n].clone();
        let rounds = rounds(&acts[n..]);
        let (to_and_fro, on) = (run(-1.0), run(1.0));
        if is_round(&act) {
            let turns: f64 = acts[n..n + rounds].iter().filter_map(turns).sum();
            act.times = (turns.round() as usize).max(1);
            act.repeat = repeat(act.times, Repeat::FromStart, Repeat::FromStartSeveral);
            act.until = acts[n + rounds - 1].until;
            n += rounds;
        } else if to_and_fro >= 3 {
            act.times = to_and_fro.div_ceil(2);
            act.repeat = repeat(act.times, Repeat::FromStart, Repeat::FromStartSeveral);
            act.until = acts[n + to_and_fro - 1].until;
            n += to_and_fro;
        } else if on >= 2 {
            act.times = on;
            act.repeat = repeat(on, Repeat::Continue, Repeat::ContinueSeveral);
            act.until = acts[n + on - 1].until;
            n += on;
        } else {
            n += 1;
        }
        found.push(act);
    }
    found
}

fn repeat(times: usize, once: Repeat, several: Repeat) -> Option<Repeat> {
    match times {
        0 | 1 => None,
        2 => Some(once),
        _ => Some(several),
    }
}

fn turns(act: &Act) -> Option<f64> {
    match &act.kind {
        Kind::Way(fitted) => match fitted.way {
            Way::Circle { turns, .. } => Some(turns),
            _ => None,
        },
        _ => None,
    }
}

fn is_round(act: &Act) -> bool {
    turns(act).is_some()
}

/// Returns how many circles about one axis follow each other.
fn rounds(acts: &[Act]) -> usize {
    let axis = |act: &Act| match &act.kind {
        Kind::Way(fitted) => match fitted.way {
            Way::Circle { axis, .. } => Some(axis),
            _ => None,
        },
        _ => None,
    };
    let Some(first) = acts.first().and_then(axis) else {
        return 0;
    };
    acts.iter()
        .take_while(|act| axis(act).is_some_and(|axis| axis.dot(first) > 0.7))
        .count()
}
