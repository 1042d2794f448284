//! Points of the recording on the stage: optical markers, and points estimated from film, loaded piece by piece.

use std::collections::BTreeMap;

use chereme_corpus::{PointsPiece, TrackKind};
use chereme_figure::camera::Camera;
use chereme_figure::mesh::Mesh;
use chereme_figure::{PointCloud, Theme, View};
use chereme_motion::{Instant, Markers, Span};

use crate::context::{Outbox, PaneInput};
use crate::work::{Ended, Outcome, WorkId, movement};

/// Length of a piece, in microseconds.
const PIECE: i64 = 20_000_000;
/// How many pieces are kept.
const KEPT: usize = 3;

/// A track of points in a piece.
struct Cloud {
    cloud: PointCloud<Markers>,
    piece: PointsPiece,
}

/// The loaded points of a recording.
#[derive(Default)]
pub(super) struct Points {
    /// The recording's row id, and its tracks of points as row ids with offsets.
    source: Option<(i64, Vec<(i64, i64)>)>,
    pieces: BTreeMap<i64, Vec<Cloud>>,
    asked: Option<(WorkId, i64)>,
    dark: bool,
    /// The cameras of each view, computed from the first piece.
    cameras: Vec<(View, Camera)>,
}

impl Points {
    /// Switches to the displayed recording, and requests the piece at the playhead; returns whether the picture
    /// changes.
    pub(super) fn follow(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) -> bool {
        let source = source(seen);
        let changed = source != self.source || seen.dark != self.dark;
        if changed {
            *self = Self {
                source,
                dark: seen.dark,
                ..Self::default()
            };
        }
        let Some((recording, _)) = self.source else {
            return changed;
        };
        let player = seen.shown.on_stage();
        let here = player.playhead().micros().div_euclid(PIECE);
        let next = here + if player.direction() < 0.0 { -1 } else { 1 };
        if self.asked.is_none() {
            let last = player.whole.end().micros().div_euclid(PIECE);
            let wanted = [here, next]
                .into_iter()
                .find(|piece| (0..=last).contains(piece) && !self.pieces.contains_key(piece));
            if let Some(piece) = wanted {
                let start = Instant::from_micros(piece * PIECE);
                let span = Span::between(start, start.shifted(PIECE));
                self.asked = Some((out.work(movement::points(recording, span)), piece));
            }
        }
        changed
    }

    /// Handles the result of work; returns whether it was the requested piece.
    pub(super) fn hear(&mut self, id: WorkId, ended: &Ended) -> bool {
        let Some((_, piece)) = self.asked.take_if(|(work, _)| *work == id) else {
            return false;
        };
        let found: &[PointsPiece] = match ended {
            Ok(Outcome::Points(found)) => found,
            _ => &[],
        };
        let theme = theme(self.dark);
        let clouds = found.iter().filter_map(|piece| {
            Some(Cloud {
                cloud: PointCloud::of(piece.markers.clone(), theme)?,
                piece: piece.clone(),
            })
        });
        self.pieces.insert(piece, clouds.collect());
        while self.pieces.len() > KEPT {
            let far = self
                .pieces
                .keys()
                .copied()
                .max_by_key(|it| it.abs_diff(piece));
            self.pieces.remove(&far.unwrap_or(piece));
        }
        true
    }

    /// Returns whether the recording has points.
    pub(super) fn are_there(&self) -> bool {
        self.source.is_some()
    }

    /// Returns whether any points have depth, so that they can be drawn beside a body.
    pub(super) fn are_in_room(&self) -> bool {
        let mut all = self.pieces.values().flatten();
        all.any(|it| !it.cloud.is_flat())
    }

    /// Returns the points at a moment; `None` while they are being loaded. Beside a body, leaves out points without
    /// depth.
    pub(super) fn mesh(&self, at: Instant, with_body: bool) -> Option<Mesh> {
        let clouds = self.pieces.get(&at.micros().div_euclid(PIECE))?;
        let mut mesh = Mesh::default();
        for it in clouds.iter().filter(|it| !with_body || !it.cloud.is_flat()) {
            if let Some(frame) = it.piece.frame_at(at) {
                mesh.append(&it.cloud.mesh(frame));
            }
        }
        Some(mesh)
    }

    /// Returns the camera of a view, which stays the same while the recording plays.
    pub(super) fn camera(&mut self, view: View, aspect: f32) -> Option<Camera> {
        let first = self.pieces.values().flatten().next()?;
        let own = first.cloud.camera(view, aspect);
        let known = self.cameras.iter().find(|(of, camera)| {
            *of == view && (camera.half_height / own.half_height - 1.0).abs() < 0.5
        });
        if let Some((_, camera)) = known {
            return Some(*camera);
        }
        self.cameras.retain(|(of, _)| *of != view);
        self.cameras.push((view, own));
        Some(own)
    }

    /// Returns a note about the points: that they are estimated, or have no depth.
    pub(super) fn note(&self) -> Option<&'static str> {
        let mut all = self.pieces.values().flatten();
        all.find_map(|it| it.cloud.note())
    }
}

fn theme(dark: bool) -> Theme {
    if dark { Theme::Dark } else { Theme::Light }
}

/// Returns the displayed recording and its tracks of points, if it has any.
fn source(seen: &PaneInput<'_>) -> Option<(i64, Vec<(i64, i64)>)> {
    if seen.shown.made.is_some() {
        return None;
    }
    let recording = seen.shown.recording?;
    let contents = seen.snapshot.contents(recording)?;
    let points = contents
        .tracks
        .iter()
        .filter(|it| it.kind == TrackKind::Markers);
    let tracks: Vec<(i64, i64)> = points.map(|it| (it.id, it.offset_us)).collect();
    (!tracks.is_empty()).then_some((recording, tracks))
}
