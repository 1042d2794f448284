//! Named points over time: optical markers, and points estimated from film.

use glam::{DVec2, DVec3};

use crate::axes::SpaceConvention;
use crate::column::FrameNumberColumn;
use crate::curves::{TrackError, channel_frame_count, check_names};
use crate::time::{FrameRate, TimeSpan};
use crate::times::FrameTimes;

/// The space of a file's positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MarkerSpace {
    /// Three coordinates in metric space; the convention converts them to metres in model space.
    World(SpaceConvention),
    /// Two coordinates on a picture: pixels to the right and *down* from its upper left corner.
    Image(PointPictureSize),
    /// Two coordinates on a picture, and a depth of roughly the same scale, negative toward the camera. Depths are
    /// relative: they compare points of one frame, and are not metric distances.
    Depth(PointPictureSize),
}

/// The size of the picture on which points lie, in its pixels; 1 by 1 if coordinates are shares of its size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointPictureSize {
    /// Pixels from left to right.
    pub width: f64,
    /// Pixels from top to bottom.
    pub height: f64,
}

impl MarkerSpace {
    /// Returns how many coordinates a position has: two or three.
    #[must_use]
    pub fn space_coordinate_count(&self) -> usize {
        match self {
            Self::World(_) | Self::Depth(_) => 3,
            Self::Image(_) => 2,
        }
    }

    /// Returns the name of the kind of space: `world-3d`, `image-2d` or `image-2.5d`.
    #[must_use]
    pub fn marker_space_name(&self) -> &'static str {
        match self {
            Self::World(_) => "world-3d",
            Self::Image(_) => "image-2d",
            Self::Depth(_) => "image-2.5d",
        }
    }

    /// Returns a position for a picture of the points: in model space, in metres. Points on a picture stand upright on
    /// the floor, two metres high, and face the viewer as the person in the picture does.
    #[must_use]
    pub fn displayed_position(&self, at: DVec3) -> DVec3 {
        let (frame, depth) = match self {
            Self::World(convention) => return convention.file_point_to_model(at),
            Self::Image(frame) => (frame, 0.0),
            Self::Depth(frame) => (frame, at.z),
        };
        // The whole picture is two metres high, whatever its pixels; a height of zero divides nothing.
        let scale = 2.0 / frame.height.max(f64::MIN_POSITIVE);
        // Pixels count downwards and model space upwards; the middle of the picture is at x = 0.
        let from_centre = DVec2::new(at.x - frame.width / 2.0, frame.height - at.y) * scale;
        // Depths grow away from the camera, while model space grows towards the viewer.
        DVec3::new(from_centre.x, from_centre.y, -depth * scale)
    }

    fn check_point_space(&self) -> Result<(), TrackError> {
        let sound = |size: f64| size.is_finite() && size > 0.0;
        let odd = match self {
            Self::World(convention) => Some(convention.metres_per_unit).filter(|unit| !sound(*unit)),
            Self::Image(frame) | Self::Depth(frame) => {
                [frame.width, frame.height].into_iter().find(|size| !sound(*size))
            }
        };
        odd.map_or(Ok(()), |unit| Err(TrackError::Unit(unit.to_string())))
    }
}

/// How positions were obtained.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum CaptureMethod {
    /// Measured by cameras or sensors that see the points themselves.
    #[default]
    Measured,
    /// Estimated from film by a model.
    Estimated,
}

impl CaptureMethod {
    /// Returns `measured` or `estimated`.
    #[must_use]
    pub fn capture_method_name(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Estimated => "estimated",
        }
    }
}

/// The meaning of the quality number of a position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum QualityMeaning {
    /// The distance by which the cameras' rays miss each other, in the unit of the positions; smaller is better.
    Residual,
    /// The confidence of the estimate, from 0 to 1.
    Confidence,
}

impl QualityMeaning {
    /// Returns `residual` or `confidence`.
    #[must_use]
    pub fn quality_meaning_name(self) -> &'static str {
        match self {
            Self::Residual => "residual",
            Self::Confidence => "confidence",
        }
    }
}

/// One named point.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionMarker {
    /// The part of the file that it belongs to, such as the subject's prefix or `LEFT_HAND_LANDMARKS`; may be empty.
    pub group: String,
    /// The name as the file has it; unique within its group.
    pub name: String,
    /// The coordinates in the file's own numbers, two or three as the track's [`MarkerSpace`] has. At a frame with a
    /// gap in any of them the point has no place.
    pub place: Vec<FrameNumberColumn>,
    /// Residual or confidence for each frame, if the file gives it.
    pub quality: Option<FrameNumberColumn>,
}

impl MotionMarker {
    /// Returns a point without a group and without quality.
    #[must_use]
    pub fn new(name: impl Into<String>, place: Vec<FrameNumberColumn>) -> Self {
        Self {
            group: String::new(),
            name: name.into(),
            place,
            quality: None,
        }
    }

    /// Returns the position at `frame` in the file's unit and axes; `None` in a gap. The third coordinate is 0 if there
    /// are two.
    #[must_use]
    pub fn marker_position(&self, frame: usize) -> Option<DVec3> {
        let mut marker_place = DVec3::ZERO;
        for (axis, column) in self.place.iter().enumerate().take(3) {
            // A gap in one coordinate makes the whole place unknown.
            marker_place[axis] = column.column_value_at(frame)?;
        }
        Some(marker_place)
    }
}

/// Points with the same times and space: one track of markers.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerTrack {
    times: FrameTimes,
    frames: usize,
    space: MarkerSpace,
    capture: CaptureMethod,
    quality: Option<QualityMeaning>,
    points: Vec<MotionMarker>,
    limbs: Vec<[usize; 2]>,
}

impl MarkerTrack {
    /// Returns the track of `points`, measured and without quality and limbs.
    ///
    /// # Errors
    /// [`TrackError`] if there is no point, names are missing or equal, lengths differ, a point has more or fewer
    /// coordinates than the space, or the space's unit or size is not a positive number.
    pub fn new(times: FrameTimes, space: MarkerSpace, points: Vec<MotionMarker>) -> Result<Self, TrackError> {
        space.check_point_space()?;
        let names = points.iter();
        check_names(names.map(|point| (point.group.as_str(), point.name.as_str())))?;
        let expected = space.space_coordinate_count();
        if let Some(odd) = points.iter().find(|point| point.place.len() != expected) {
            return Err(TrackError::Coordinates {
                name: odd.name.clone(),
                found: odd.place.len(),
                expected,
            });
        }
        let channels = points.iter().flat_map(|point| {
            // The quality column has to be as long as the coordinates too.
            let columns = point.place.iter().chain(&point.quality);
            columns.map(|column| (point.name.as_str(), column))
        });
        let frames = channel_frame_count(&times, channels)?;
        Ok(Self {
            times,
            frames,
            space,
            capture: CaptureMethod::Measured,
            quality: None,
            points,
            limbs: Vec::new(),
        })
    }

    /// Returns the track with a note of how its positions were obtained.
    #[must_use]
    pub fn with_capture_method(self, capture: CaptureMethod) -> Self {
        Self { capture, ..self }
    }

    /// Returns the track with its frames at another rate.
    #[must_use]
    pub fn at_rate(self, rate: FrameRate) -> Self {
        Self {
            times: FrameTimes::Even(rate),
            ..self
        }
    }

    /// Returns the track with another unit and other axes for its numbers, if its points are in a room.
    #[must_use]
    pub fn in_room(self, convention: SpaceConvention) -> Self {
        match self.space {
            MarkerSpace::World(_) => Self {
                space: MarkerSpace::World(convention),
                ..self
            },
            MarkerSpace::Image(_) | MarkerSpace::Depth(_) => self,
        }
    }

    /// Returns the track with a note of the meaning of its `quality` columns.
    #[must_use]
    pub fn with_quality_meaning(self, quality: QualityMeaning) -> Self {
        Self {
            quality: Some(quality),
            ..self
        }
    }

    /// Returns the track with limbs: pairs of indices of points that are drawn as lines.
    ///
    /// # Errors
    /// [`TrackError::Limb`] if a limb joins a point that does not exist, or a point to itself.
    pub fn with_marker_limbs(self, limbs: Vec<[usize; 2]>) -> Result<Self, TrackError> {
        let points = self.points.len();
        let odd = limbs
            .iter()
            .find(|[from, to]| from == to || *from >= points || *to >= points);
        match odd {
            Some(&[from, to]) => Err(TrackError::Limb { from, to, points }),
            None => Ok(Self { limbs, ..self }),
        }
    }

    /// Returns the times of the frames.
    #[must_use]
    pub fn marker_times(&self) -> &FrameTimes {
        &self.times
    }

    /// Returns how many frames there are.
    #[must_use]
    pub fn marker_frame_count(&self) -> usize {
        self.frames
    }

    /// Returns the span of the track, counted from its own start.
    #[must_use]
    pub fn marker_track_span(&self) -> TimeSpan {
        self.times.frame_times_span(self.frames)
    }

    /// Returns the space of the positions.
    #[must_use]
    pub fn marker_space(&self) -> &MarkerSpace {
        &self.space
    }

    /// Returns how the positions were obtained.
    #[must_use]
    pub fn marker_capture(&self) -> CaptureMethod {
        self.capture
    }

    /// Returns the meaning of the quality columns; `None` if the file does not specify it.
    #[must_use]
    pub fn marker_quality(&self) -> Option<QualityMeaning> {
        self.quality
    }

    /// Returns the points in the order of the file.
    #[must_use]
    pub fn marker_points(&self) -> &[MotionMarker] {
        &self.points
    }

    /// Returns the pairs of points that lines join.
    #[must_use]
    pub fn marker_limbs(&self) -> &[[usize; 2]] {
        &self.limbs
    }

    /// Returns the positions of the points for a picture at `frame`, see [`MarkerSpace::displayed_position`]; `None` in gaps.
    #[must_use]
    pub fn displayed_markers(&self, frame: usize) -> Vec<Option<DVec3>> {
        let shown = |point: &MotionMarker| point.marker_position(frame).map(|at| self.space.displayed_position(at));
        self.points.iter().map(shown).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times() -> FrameTimes {
        FrameTimes::Even(FrameRate::new(50, 1).expect("a rate"))
    }

    fn point(name: &str, frames: usize) -> MotionMarker {
        MotionMarker::new(name, vec![FrameNumberColumn::from_single_floats(vec![1.0; frames]); 3])
    }

    #[test]
    fn a_point_with_a_gap_in_one_coordinate_has_no_place() {
        let mut wrist = point("LWRA", 3);
        wrist.place[1] = FrameNumberColumn::from_single_floats(vec![1000.0, f32::NAN, 900.0]);
        let convention = SpaceConvention {
            metres_per_unit: 0.001,
            axes: "+Y,+X".parse().expect("axes"),
        };
        let markers = MarkerTrack::new(times(), MarkerSpace::World(convention), vec![wrist, point("LELB", 3)])
            .and_then(|markers| markers.with_marker_limbs(vec![[0, 1]]))
            .expect("a track");
        let places = |frame: usize| markers.displayed_markers(frame)[0].map(|at| at.y);
        assert_eq!([places(0), places(1), places(2)], [Some(1.0), None, Some(0.9)]);
        assert_eq!(markers.marker_track_span().span_micros(), 60_000);
        let slower = markers.at_rate(FrameRate::new(25, 1).expect("a rate"));
        assert_eq!(slower.marker_track_span().span_micros(), 120_000);
    }

    #[test]
    fn points_of_a_picture_are_placed_upright_on_the_floor() {
        let space = MarkerSpace::Depth(PointPictureSize {
            width: 640.0,
            height: 480.0,
        });
        assert_eq!(space.displayed_position(DVec3::new(320.0, 480.0, 0.0)), DVec3::ZERO);
        assert_eq!(
            space.displayed_position(DVec3::new(320.0, 0.0, -240.0)),
            DVec3::new(0.0, 2.0, 1.0)
        );
        assert!(space.displayed_position(DVec3::new(640.0, 0.0, 0.0)).x > 1.0);
    }

    #[test]
    fn points_that_cannot_form_a_track_are_refused() {
        let room = MarkerSpace::World(SpaceConvention::MODEL_CONVENTION);
        let hand = |group: &str| MotionMarker {
            group: group.into(),
            ..point("WRIST", 2)
        };
        assert!(MarkerTrack::new(times(), room, vec![hand("LEFT"), hand("RIGHT")]).is_ok());
        assert_eq!(
            MarkerTrack::new(times(), room, vec![hand("LEFT"), hand("LEFT")]),
            Err(TrackError::Twice("WRIST".into()))
        );
        let flat = MarkerSpace::Image(PointPictureSize {
            width: 1.0,
            height: 1.0,
        });
        let fault = TrackError::Coordinates {
            name: "A".into(),
            found: 3,
            expected: 2,
        };
        assert_eq!(MarkerTrack::new(times(), flat, vec![point("A", 1)]), Err(fault));
        let one = MarkerTrack::new(times(), room, vec![point("A", 1)]).expect("a track");
        let fault = TrackError::Limb {
            from: 0,
            to: 0,
            points: 1,
        };
        assert_eq!(one.with_marker_limbs(vec![[0, 0]]), Err(fault));
        let mut longer = point("B", 2);
        longer.quality = Some(FrameNumberColumn::from_single_floats(vec![0.0; 3]));
        assert!(matches!(
            MarkerTrack::new(times(), room, vec![longer]),
            Err(TrackError::Length { .. })
        ));
        let none = MarkerSpace::World(SpaceConvention {
            metres_per_unit: 0.0,
            ..SpaceConvention::MODEL_CONVENTION
        });
        assert!(matches!(
            MarkerTrack::new(times(), none, vec![point("A", 1)]),
            Err(TrackError::Unit(_))
        ));
    }
}
