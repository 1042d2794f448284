//! Points of the recording on the stage: optical markers, and points estimated from film, loaded piece by piece.

use std::collections::BTreeMap;

use chereme_corpus::{PointsPiece, TrackKind};
use chereme_figure::camera::FigureCamera;
use chereme_figure::mesh::TriangleMesh;
use chereme_figure::{FigureView, PaperTheme, PointCloud};
use chereme_motion::{MarkerTrack, RecordingInstant, TimeSpan};

use crate::context::PaneInput;
use crate::work::{WorkId, WorkOutcome, WorkResult, movement_jobs};

/// Length of a piece, in microseconds.
const POINT_PIECE_LENGTH_MICROS: i64 = 20_000_000;
/// How many pieces are kept.
const MAX_KEPT_POINT_PIECES: usize = 3;

/// A track of points in a piece.
struct PointTrackPiece {
    cloud: PointCloud<MarkerTrack>,
    piece: PointsPiece,
}

/// The loaded points of a recording.
#[derive(Default)]
pub(super) struct RecordingPoints {
    /// The recording's row id, and its tracks of points as row ids with offsets.
    source: Option<(i64, Vec<(i64, i64)>)>,
    pieces: BTreeMap<i64, Vec<PointTrackPiece>>,
    asked: Option<(WorkId, i64)>,
    dark: bool,
    /// The cameras of each view, computed from the first piece.
    cameras: Vec<(FigureView, FigureCamera)>,
}

impl RecordingPoints {
    /// Switches to the displayed recording, and requests the piece at the playhead; returns whether the picture
    /// changes.
    pub(super) fn request_recording_points(&mut self, seen: &PaneInput<'_>) -> bool {
        let source = recording_point_tracks(seen);
        // Theme and recording both change the clouds, so that everything is loaded again.
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
        let here = player
            .player_playhead()
            .instant_micros()
            .div_euclid(POINT_PIECE_LENGTH_MICROS);
        // The piece after the playhead, in the direction of play, is loaded ahead.
        let next = here + if player.playback_direction() < 0.0 { -1 } else { 1 };
        if self.asked.is_none() {
            let last = player
                .whole
                .span_end_instant()
                .instant_micros()
                .div_euclid(POINT_PIECE_LENGTH_MICROS);
            let wanted = [here, next]
                .into_iter()
                .find(|piece| (0..=last).contains(piece) && !self.pieces.contains_key(piece));
            if let Some(piece) = wanted {
                let start = RecordingInstant::from_micros(piece * POINT_PIECE_LENGTH_MICROS);
                let span = TimeSpan::span_between(start, start.shifted_instant(POINT_PIECE_LENGTH_MICROS));
                self.asked = Some((
                    seen.request_work(movement_jobs::load_points_job(recording, span)),
                    piece,
                ));
            }
        }
        changed
    }

    /// Handles the result of work; returns whether it was the requested piece.
    pub(super) fn receive_recording_points(&mut self, id: WorkId, ended: &WorkResult) -> bool {
        let Some((_, piece)) = self.asked.take_if(|(work, _)| *work == id) else {
            return false;
        };
        // A failed piece is stored empty, or it would be asked for in every frame.
        let pieces: &[PointsPiece] = match ended {
            Ok(WorkOutcome::Points(found)) => found,
            _ => &[],
        };
        let theme = point_cloud_theme(self.dark);
        let clouds = pieces.iter().filter_map(|piece| {
            Some(PointTrackPiece {
                cloud: PointCloud::cloud_from_markers(piece.markers.clone(), theme)?,
                piece: piece.clone(),
            })
        });
        self.pieces.insert(piece, clouds.collect());
        while self.pieces.len() > MAX_KEPT_POINT_PIECES {
            // The piece farthest from the newest one is needed last.
            let far = self.pieces.keys().copied().max_by_key(|other| other.abs_diff(piece));
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
        all.any(|entry| !entry.cloud.is_flat())
    }

    /// Returns the points at a moment; `None` while they are being loaded. Beside a body, leaves out points without
    /// depth.
    pub(super) fn point_mesh_at(&self, at: RecordingInstant, with_body: bool) -> Option<TriangleMesh> {
        let clouds = self
            .pieces
            .get(&at.instant_micros().div_euclid(POINT_PIECE_LENGTH_MICROS))?;
        let mut mesh = TriangleMesh::default();
        // Points on a picture have no place in the room of the body.
        for it in clouds.iter().filter(|entry| !with_body || !entry.cloud.is_flat()) {
            if let Some(frame) = it.piece.piece_frame_at(at) {
                mesh.append_mesh(&it.cloud.cloud_frame_mesh(frame));
            }
        }
        Some(mesh)
    }

    /// Returns the camera of a view, which stays the same while the recording plays.
    pub(super) fn point_view_camera(&mut self, view: FigureView, aspect: f32) -> Option<FigureCamera> {
        let first = self.pieces.values().flatten().next()?;
        let fitted_camera = first.cloud.cloud_camera(view, aspect);
        let kept_camera = self
            .cameras
            .iter()
            // Pieces differ in extent: the camera stays unless they differ by half.
            .find(|(of, camera)| *of == view && (camera.half_height / fitted_camera.half_height - 1.0).abs() < 0.5);
        if let Some((_, camera)) = kept_camera {
            return Some(*camera);
        }
        self.cameras.retain(|(of, _)| *of != view);
        self.cameras.push((view, fitted_camera));
        Some(fitted_camera)
    }

    /// Returns a note about the points: that they are estimated, or have no depth.
    pub(super) fn point_quality_note(&self) -> Option<&'static str> {
        let mut all = self.pieces.values().flatten();
        all.find_map(|entry| entry.cloud.cloud_measurement_note())
    }
}

fn point_cloud_theme(dark: bool) -> PaperTheme {
    if dark { PaperTheme::Dark } else { PaperTheme::Light }
}

/// Returns the displayed recording and its tracks of points, if it has any.
fn recording_point_tracks(seen: &PaneInput<'_>) -> Option<(i64, Vec<(i64, i64)>)> {
    if seen.shown.made.is_some() {
        return None;
    }
    let recording = seen.shown.recording?;
    let contents = seen.snapshot.recording_contents(recording)?;
    let points = contents.tracks.iter().filter(|track| track.kind == TrackKind::Markers);
    let tracks: Vec<(i64, i64)> = points.map(|track| (track.id, track.offset_us)).collect();
    (!tracks.is_empty()).then_some((recording, tracks))
}
