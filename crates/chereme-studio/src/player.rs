//! The transport: where the playhead is, and how it moves with the clock.

use chereme_motion::{FrameRate, RecordingInstant, TimeSpan};
use serde::{Deserialize, Serialize};

/// Playback speeds that the actions "slower" and "faster" step through.
pub(crate) const PLAYBACK_SPEEDS: [f64; 11] = [0.1, 0.2, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0];

/// The playhead, and how it moves.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StagePlayer {
    /// The playhead, in microseconds with fractions, so that slow play does not stand still.
    at: f64,
    /// The whole span that can be played.
    pub(crate) whole: TimeSpan,
    /// The part that is played and looped, if any.
    pub(crate) part: Option<TimeSpan>,
    /// Direction and shuttle factor: 1 forwards, -1 backwards, more when shuttling, 0 paused.
    direction: f64,
    /// Playback speed; 1 is the recorded speed.
    pub(crate) speed: f64,
    /// Whether playback begins again at the end.
    pub(crate) looping: bool,
    /// State of step-and-repeat playback, if it is active.
    steps: Option<SteppingState>,
    /// The preview of a newly opened recording or sign, until somebody moves the playhead.
    preview: Option<OpeningPreview>,
}

/// The moment that the stage shows of a newly opened recording or sign in place of its first frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct OpeningPreview {
    pub(crate) span: TimeSpan,
    /// Whether the span plays in a loop; otherwise the stage shows its stroke.
    pub(crate) loops: bool,
}

/// Settings of step-and-repeat playback; times in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct SteppingSettings {
    /// Length of a piece, from 0.2 to 60.
    pub(crate) piece: f64,
    /// Distance from the start of one piece to the next, from 0.1 to 60.
    pub(crate) step: f64,
    /// How often each piece is played, from 1 to 20.
    pub(crate) times: u32,
    /// Pause between pieces, from 0 to 10.
    pub(crate) rest: f64,
}

impl Default for SteppingSettings {
    fn default() -> Self {
        Self {
            piece: 2.0,
            step: 1.0,
            times: 2,
            rest: 0.4,
        }
    }
}

impl SteppingSettings {
    /// Returns the settings with every value clamped to its range.
    pub(crate) fn clamped_stepping_settings(self) -> Self {
        // A settings file may hold anything, even what is not a number.
        let within = |value: f64, least: f64, most: f64| {
            if value.is_finite() {
                value.clamp(least, most)
            } else {
                least
            }
        };
        Self {
            piece: within(self.piece, 0.2, 60.0),
            step: within(self.step, 0.1, 60.0),
            times: self.times.clamp(1, 20),
            rest: within(self.rest, 0.0, 10.0),
        }
    }
}

/// Converts seconds to microseconds.
fn seconds_to_micros(seconds: f64) -> i64 {
    (seconds * 1e6) as i64
}

/// State of step-and-repeat playback: short pieces, one after the other, each several times.
#[derive(Debug, Clone, PartialEq)]
struct SteppingState {
    /// The span that is divided into pieces.
    of: TimeSpan,
    /// Distance from the start of one piece to the next, in microseconds.
    by: i64,
    /// How often the present piece has been played.
    played: u32,
    /// Remaining pause, in seconds.
    rest: f64,
    how: SteppingSettings,
}

impl Default for StagePlayer {
    fn default() -> Self {
        Self {
            at: 0.0,
            whole: TimeSpan::default(),
            part: None,
            direction: 0.0,
            speed: 1.0,
            looping: false,
            steps: None,
            preview: None,
        }
    }
}

impl StagePlayer {
    /// Starts with another recording, at its beginning.
    pub(crate) fn load_player_span(&mut self, whole: TimeSpan) {
        self.at = whole.span_start_instant().instant_micros() as f64;
        self.whole = whole;
        (self.part, self.steps, self.preview) = (None, None, None);
        self.direction = 0.0;
    }

    /// Previews something just opened; the playhead stays.
    pub(crate) fn set_opening_preview(&mut self, preview: OpeningPreview) {
        self.preview = Some(preview);
    }

    /// Returns the preview, if nobody has moved the playhead since it was set.
    pub(crate) fn current_opening_preview(&self) -> Option<OpeningPreview> {
        // While it plays, the stage shows what plays.
        self.preview.filter(|_| !self.is_playing())
    }

    /// Continues with a span that became longer or shorter.
    pub(crate) fn fit_player_span(&mut self, whole: TimeSpan) {
        if whole != self.whole {
            self.whole = whole;
            self.part = self.part.and_then(|part| part.span_intersection(whole));
            // The playhead may stand beyond a span that became shorter.
            self.at = self.clamped(self.at);
        }
    }

    /// Returns the playhead.
    pub(crate) fn player_playhead(&self) -> RecordingInstant {
        RecordingInstant::from_micros(self.at as i64)
    }

    pub(crate) fn is_playing(&self) -> bool {
        self.direction != 0.0
    }

    /// Returns whether it plays on, and not only a part.
    pub(crate) fn plays_on(&self) -> bool {
        self.is_playing() && self.part.is_none()
    }

    /// Returns the direction of playback: negative backwards, 0 paused.
    pub(crate) fn playback_direction(&self) -> f64 {
        self.direction
    }

    /// Moves the playhead, within the recording.
    pub(crate) fn seek_player_instant(&mut self, at: RecordingInstant) {
        self.preview = None;
        self.at = self.clamped(at.instant_micros() as f64);
    }

    /// Plays, or pauses; at the end, plays from the beginning.
    pub(crate) fn toggle_playback(&mut self) {
        self.preview = None;
        if self.is_playing() {
            self.stop_playback();
            return;
        }
        // Playing on ends a part: its end would stop the playback.
        (self.part, self.steps) = (None, None);
        // At the end there is nothing left to play.
        if self.at >= self.last_playable_micros() {
            self.at = self.whole.span_start_instant().instant_micros() as f64;
        }
        self.direction = 1.0;
    }

    /// Plays a part from its start.
    pub(crate) fn play_part(&mut self, part: TimeSpan) {
        self.preview = None;
        if let Some(part) = part.span_intersection(self.whole) {
            self.at = part.span_start_instant().instant_micros() as f64;
            (self.part, self.steps) = (Some(part), None);
            self.direction = 1.0;
        }
    }

    /// Plays overlapping short pieces of `part`, or of everything after the playhead, each several times; stops if that
    /// is running already.
    pub(crate) fn step_and_repeat(&mut self, part: Option<TimeSpan>, how: SteppingSettings) {
        if self.is_playing() && self.steps.is_some() {
            self.stop_playback();
            return;
        }
        let rest = TimeSpan::span_between(self.player_playhead(), self.whole.span_end_instant());
        let Some(of) = part.unwrap_or(rest).span_intersection(self.whole) else {
            return;
        };
        let how = how.clamped_stepping_settings();
        let piece = seconds_to_micros(how.piece).min(of.span_micros());
        let end = of.span_start_instant().shifted_instant(piece);
        self.play_part(TimeSpan::span_between(of.span_start_instant(), end));
        self.steps = Some(SteppingState {
            of,
            // A step longer than the piece would leave gaps; of nothing it would never end.
            by: seconds_to_micros(how.step).min(piece).max(1),
            played: 0,
            rest: 0.0,
            how,
        });
    }

    /// Continues with the same piece again, or with the next; stops after the last.
    fn next_piece(&mut self) {
        let (Some(steps), Some(part)) = (&mut self.steps, self.part) else {
            return;
        };
        (steps.played, steps.rest) = (steps.played + 1, steps.how.rest);
        if steps.played >= steps.how.times {
            steps.played = 0;
            let end = part
                .span_end_instant()
                .shifted_instant(steps.by)
                .min(steps.of.span_end_instant());
            let next = if part.span_end_instant() < steps.of.span_end_instant() {
                // The last piece ends with the span and keeps its length, so that it overlaps more.
                Some(TimeSpan::span_between(end.shifted_instant(-part.span_micros()), end))
            } else {
                let start = steps.of.span_start_instant();
                self.looping
                    .then(|| TimeSpan::span_between(start, start.shifted_instant(part.span_micros())))
            };
            if next.is_none() {
                self.stop_playback();
                // The playhead stays within the recording, whose end is excluded.
                self.at = self.clamped(part.span_end_instant().instant_micros() as f64);
                return;
            }
            self.part = next;
        }
        let start = self
            .part
            .map_or(self.whole.span_start_instant(), |part| part.span_start_instant());
        self.at = start.instant_micros() as f64;
    }

    pub(crate) fn stop_playback(&mut self) {
        self.direction = 0.0;
        self.steps = None;
    }

    /// Shuttles: repeated presses in the same direction double the speed, up to 8.
    pub(crate) fn shuttle_playback(&mut self, sign: f64) {
        self.preview = None;
        (self.part, self.steps) = (None, None);
        // A press in the other direction turns round at single speed.
        self.direction = if self.direction * sign > 0.0 {
            (self.direction * 2.0).clamp(-8.0, 8.0)
        } else {
            sign
        };
    }

    /// Changes to the next slower or faster of [`PLAYBACK_SPEEDS`].
    pub(crate) fn step_speed(&mut self, faster: bool) {
        let mut near = PLAYBACK_SPEEDS.iter().copied();
        // Speeds are not exact in floating point after they were stored.
        let next = if faster {
            near.find(|speed| *speed > self.speed + 1e-9)
        } else {
            near.rev().find(|speed| *speed < self.speed - 1e-9)
        };
        self.speed = next.unwrap_or(self.speed);
    }

    /// Stops, and moves the playhead by `frames` frames to the start of a frame.
    pub(crate) fn step_player_frames(&mut self, frames: i64, rate: FrameRate) {
        self.stop_playback();
        let now = rate.nearest_frame_at(self.player_playhead()) as i64;
        let next = usize::try_from((now + frames).max(0)).unwrap_or_default();
        self.seek_player_instant(rate.frame_start_instant(next));
    }

    /// Advances the playhead by `seconds` of the clock.
    pub(crate) fn advance_playhead(&mut self, seconds: f64) {
        if !self.is_playing() || self.whole.is_empty() {
            return;
        }
        // The pause runs on the clock, whatever the speed.
        if let Some(steps) = self.steps.as_mut().filter(|steps| steps.rest > 0.0) {
            steps.rest -= seconds;
            return;
        }
        let span = self.part.unwrap_or(self.whole);
        let (start, end) = (
            span.span_start_instant().instant_micros() as f64,
            span.span_end_instant().instant_micros() as f64,
        );
        self.at += seconds * 1e6 * self.direction * self.speed;
        let over = if self.direction > 0.0 {
            self.at >= end
        } else {
            self.at < start
        };
        if !over {
            return;
        }
        if self.steps.is_some() {
            return self.next_piece();
        }
        if self.looping {
            // The time beyond the end goes on from the other end, so that a loop keeps its rhythm.
            self.at = start + (self.at - start).rem_euclid((end - start).max(1.0));
        } else {
            // Played out: the next press starts again.
            self.at = self.clamped(if self.direction > 0.0 { end } else { start });
            self.stop_playback();
        }
    }

    fn last_playable_micros(&self) -> f64 {
        (self.whole.span_end_instant().instant_micros() - 1).max(self.whole.span_start_instant().instant_micros())
            as f64
    }

    fn clamped(&self, at: f64) -> f64 {
        at.max(self.whole.span_start_instant().instant_micros() as f64)
            .min(self.last_playable_micros())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(start: i64, end: i64) -> TimeSpan {
        TimeSpan::from_span_micros(start, end)
    }

    fn player() -> StagePlayer {
        let mut player = StagePlayer::default();
        player.load_player_span(span(0, 2_000_000));
        player
    }

    #[test]
    fn a_player_stops_at_the_end_and_starts_again_on_request() {
        let mut player = player();
        player.toggle_playback();
        player.advance_playhead(0.5);
        assert_eq!(player.player_playhead().instant_micros(), 500_000);
        player.speed = 0.1;
        player.advance_playhead(0.5);
        assert_eq!(player.player_playhead().instant_micros(), 550_000);
        player.speed = 4.0;
        player.advance_playhead(9.0);
        assert!(!player.is_playing());
        assert_eq!(player.player_playhead().instant_micros(), 1_999_999);
        player.toggle_playback();
        assert_eq!(player.player_playhead().instant_micros(), 0);
    }

    #[test]
    fn a_preview_lasts_until_the_playhead_is_moved() {
        let preview = OpeningPreview {
            span: span(0, 900_000),
            loops: true,
        };
        let moves: [fn(&mut StagePlayer); 4] = [
            StagePlayer::toggle_playback,
            |player| player.seek_player_instant(RecordingInstant::RECORDING_START),
            |player| player.play_part(span(0, 9)),
            |player| player.shuttle_playback(1.0),
        ];
        for moves in moves {
            let mut player = player();
            player.set_opening_preview(preview);
            assert_eq!(player.current_opening_preview(), Some(preview));
            assert_eq!(player.player_playhead(), RecordingInstant::RECORDING_START);
            moves(&mut player);
            player.stop_playback();
            assert_eq!(player.current_opening_preview(), None);
        }
    }

    #[test]
    fn a_selected_part_is_looped() {
        let mut player = player();
        player.looping = true;
        player.play_part(span(500_000, 1_000_000));
        player.advance_playhead(0.6);
        assert_eq!(player.player_playhead().instant_micros(), 600_000);
        player.shuttle_playback(-1.0);
        assert!(player.playback_direction() < 0.0 && player.part.is_none());
    }

    #[test]
    fn short_pieces_are_repeated_and_stepped_through() {
        let mut player = StagePlayer::default();
        player.load_player_span(span(0, 10_000_000));
        player.step_and_repeat(Some(span(1_000_000, 4_500_000)), SteppingSettings::default());
        let mut starts = Vec::new();
        while player.is_playing() {
            starts.push(player.part.map(|it| it.span_start_instant().instant_micros() / 100_000));
            player.advance_playhead(2.1);
            player.advance_playhead(0.5);
        }
        let want = [10, 10, 20, 20, 25, 25].map(Some);
        assert_eq!(starts, want);
        assert_eq!(player.player_playhead().instant_micros(), 4_500_000);
        player.step_and_repeat(None, SteppingSettings::default());
        player.step_and_repeat(None, SteppingSettings::default());
        assert!(!player.is_playing());
    }

    #[test]
    fn steps_land_on_frames() {
        let mut player = player();
        let rate = FrameRate::new(30, 1).expect("a rate");
        player.seek_player_instant(RecordingInstant::from_micros(500_001));
        player.step_player_frames(1, rate);
        assert_eq!(player.player_playhead(), rate.frame_start_instant(16));
        player.step_player_frames(-40, rate);
        assert_eq!(player.player_playhead().instant_micros(), 0);
        player.step_player_frames(1000, rate);
        assert_eq!(player.player_playhead().instant_micros(), 1_999_999);
    }

    #[test]
    fn playback_and_shuttle_speeds_are_limited() {
        let mut player = player();
        for _ in 0..20 {
            player.step_speed(true);
            player.shuttle_playback(1.0);
        }
        assert_eq!((player.speed, player.playback_direction()), (4.0, 8.0));
        for _ in 0..20 {
            player.step_speed(false);
        }
        assert_eq!(player.speed, 0.1);
    }
}
