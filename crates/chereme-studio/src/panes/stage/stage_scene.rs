//! The extras of a picture: ghosts of other moments, trails, grid and floor.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_figure::mesh::{MeshVertex, TriangleMesh, trail_mesh};
use chereme_figure::palette::HandColours;
use chereme_figure::{ClipFraming, FigurePalette, FigureView, PaperTheme, RgbColour, SignerBody, body::group};
use chereme_motion::ends::ClipEnds;
use chereme_motion::{
    BodyAnatomy, BodyPart, BodySide, Clip, FacePosture, HandFinger, ModelPose, RecordingInstant, Skeleton,
};
use glam::Vec3;

use crate::model::reel::MovementReel;

/// The time between ghosts, which are faint figures of earlier and later postures, in seconds.
const GHOST_STEP: f64 = 0.1;
/// The opacity of each ghost, the nearest first.
const GHOST_OPACITIES: [f32; 3] = [0.5, 0.36, 0.24];
/// The distance between points of a trail, in microseconds.
const TRAIL_STEP: i64 = 20_000;
/// How many points of trails are kept.
const MAX_TRAIL_POINTS: usize = 4000;
/// Colours of past and future ghosts: everybody can distinguish blue and orange.
const PAST_GHOST_COLOUR: RgbColour = RgbColour::from_hex_colour(0x2E_7F_B8);
const FUTURE_GHOST_COLOUR: RgbColour = RgbColour::from_hex_colour(0xD9_86_1A);
/// Trails of the right and of the left hand.
const TRAIL_COLOURS: [RgbColour; 2] = [
    RgbColour::from_hex_colour(0xE0_7B_1F),
    RgbColour::from_hex_colour(0x4C_7F_D6),
];

/// A body on the stage, with everything computed once for its movement.
pub(super) struct StageSubject {
    pub(super) skeleton: Arc<Skeleton>,
    pub(super) anatomy: BodyAnatomy,
    pub(super) framing: ClipFraming,
    pub(super) body: Arc<SignerBody>,
    past: Arc<SignerBody>,
    future: Arc<SignerBody>,
    /// Height of the floor in metres, if the body has feet.
    floor: Option<f32>,
    /// The point between the hips at the beginning of the usable movement.
    middle: Vec3,
    joints: [Vec<usize>; 2],
    points: BTreeMap<i64, Vec<Vec3>>,
}

/// The source of postures.
#[derive(Clone, Copy)]
pub(super) enum PostureSource<'a> {
    Reel(&'a MovementReel),
    /// A clip with the face in each frame.
    Clip(&'a Clip, &'a [FacePosture]),
}

impl PostureSource<'_> {
    /// Returns the posture at that moment, if it is loaded.
    pub(super) fn source_pose_at(self, skeleton: &Skeleton, at: RecordingInstant) -> Option<ModelPose> {
        let pose = match self {
            Self::Reel(reel) => reel.reel_pose_at(at)?,
            Self::Clip(clip, _) if clip.clip_frame_count() == 0 => return None,
            Self::Clip(clip, _) => clip.sample_pose(at),
        };
        Some(ModelPose::from_local_pose(skeleton, &pose))
    }

    /// Returns the face at that moment, if it is known.
    pub(super) fn source_face_at(self, at: RecordingInstant) -> Option<FacePosture> {
        match self {
            Self::Reel(reel) => reel.reel_face_at(at),
            Self::Clip(clip, faces) => FacePosture::face_at_moment(faces, clip.clip_frame_rate(), at),
        }
    }
}

impl StageSubject {
    /// Returns the subject of a movement. It takes over the body of another movement with the same skeleton, and its
    /// framing too if the picture must stay `steady`.
    pub(super) fn succeed_stage_subject(
        before: Option<Self>,
        clip: &Clip,
        anatomy: &BodyAnatomy,
        steady: bool,
    ) -> Option<Self> {
        // Only the joints decide about a body, so that recipes change it without a new one.
        let same = |subject: &Self| {
            subject.anatomy == *anatomy
                && (Arc::ptr_eq(&subject.skeleton, clip.clip_skeleton()) || subject.skeleton == *clip.clip_skeleton())
        };
        match before.filter(same) {
            Some(before) => Some(Self {
                framing: match steady {
                    true => before.framing,
                    false => ClipFraming::framing_from_clip(clip, anatomy)?,
                },
                points: BTreeMap::new(),
                ..before
            }),
            None => Self::new(clip, anatomy),
        }
    }

    fn new(clip: &Clip, anatomy: &BodyAnatomy) -> Option<Self> {
        let framing = ClipFraming::framing_from_clip(clip, anatomy)?;
        let skeleton = clip.clip_skeleton().clone();
        let first = clip.model_pose(ClipEnds::examine_clip_ends(clip, anatomy).sound.start);
        let joint_position = |joint: usize| first.model_joint_position(joint).as_vec3();
        let feet = BodySide::BOTH_SIDES.map(|side| anatomy.part_joint(BodyPart::Foot(side)));
        let floor = feet.iter().flatten().next().map(|_| {
            // A centimetre below the lowest joint, where soles are.
            let heights = (0..skeleton.len()).map(|joint| joint_position(joint).y);
            heights.fold(f32::INFINITY, f32::min) - 0.01
        });
        let tinted = |colour| {
            Arc::new(SignerBody::with_both_hands(
                &skeleton,
                anatomy,
                &single_colour_palette(colour),
            ))
        };
        Some(Self {
            framing,
            body: Arc::new(SignerBody::new(&skeleton, anatomy)),
            past: tinted(PAST_GHOST_COLOUR),
            future: tinted(FUTURE_GHOST_COLOUR),
            floor,
            middle: anatomy
                .part_joint(BodyPart::Hips)
                .map_or(joint_position(0), joint_position),
            joints: BodySide::BOTH_SIDES.map(|side| trail_joints(anatomy, side)),
            points: BTreeMap::new(),
            anatomy: anatomy.clone(),
            skeleton,
        })
    }

    /// Returns whether neither hand has fingers.
    pub(super) fn is_without_fingers(&self) -> bool {
        !BodySide::BOTH_SIDES.iter().any(|&side| self.anatomy.has_fingers(side))
    }

    /// Returns the body of hands and arms for the posture before an edit, in the colour of past ghosts.
    pub(super) fn body_before_edit(&self) -> Arc<SignerBody> {
        self.past.clone()
    }

    /// Returns ghosts before and after `at`, the farthest first, each with its opacity.
    pub(super) fn ghost_bodies_around(
        &self,
        movement: PostureSource<'_>,
        at: RecordingInstant,
    ) -> Vec<(Arc<SignerBody>, ModelPose, f32)> {
        let mut ghosts = Vec::new();
        for (index, opacity) in GHOST_OPACITIES.into_iter().enumerate().rev() {
            let away = ((index + 1) as f64 * GHOST_STEP * 1e6) as i64;
            for (body, shift) in [(&self.past, -away), (&self.future, away)] {
                let then = at.shifted_instant(shift);
                if then >= RecordingInstant::RECORDING_START
                    && let Some(pose) = movement.source_pose_at(&self.skeleton, then)
                {
                    ghosts.push((body.clone(), pose, opacity));
                }
            }
        }
        ghosts
    }

    /// Returns the trails of wrists and fingertips from `reach` seconds before `at` to `reach` seconds after it.
    pub(super) fn build_trail_mesh(
        &mut self,
        movement: PostureSource<'_>,
        at: RecordingInstant,
        end: RecordingInstant,
        reach: f64,
        paper: RgbColour,
    ) -> TriangleMesh {
        let reach = ((reach * 1e6) as i64 / TRAIL_STEP).max(1);
        let now = at.instant_micros() / TRAIL_STEP;
        let last = end.instant_micros() / TRAIL_STEP;
        // Points are cheap to compute again, and hours of use must not collect them for ever.
        if self.points.len() > MAX_TRAIL_POINTS {
            self.points.clear();
        }
        for step in (now - reach).max(0)..=(now + reach).min(last) {
            if self.points.contains_key(&step) {
                continue;
            }
            let then = RecordingInstant::from_micros(step * TRAIL_STEP);
            if let Some(pose) = movement.source_pose_at(&self.skeleton, then) {
                let points = self.points_of(&pose);
                self.points.insert(step, points);
            }
        }
        let Some(pose) = movement.source_pose_at(&self.skeleton, at) else {
            return TriangleMesh::default();
        };
        let here = self.points_of(&pose);
        let mut mesh = TriangleMesh::default();
        let mut next = 0;
        for (joints, colour) in self.joints.iter().zip(TRAIL_COLOURS) {
            for index in 0..joints.len() {
                let path = |steps: std::ops::RangeInclusive<i64>| -> Vec<Vec3> {
                    let points = self.points.range(steps);
                    points.filter_map(|(_, it)| it.get(next).copied()).collect()
                };
                let (mut past, mut future) = (path(now - reach..=now), path(now + 1..=now + reach));
                // Both trails meet in the present posture, which lies between two steps.
                past.extend(here.get(next));
                future.splice(0..0, here.get(next).copied());
                let radius = if index == 0 { 0.0045 } else { 0.0022 };
                let ends = [colour.mix_colour(paper, 0.6), colour];
                mesh.append_mesh(&trail_mesh(&past, radius, ends, group::FIRST_FLAT_GROUP + 1));
                let ends = [colour.mix_colour(paper, 0.35), colour.mix_colour(paper, 0.85)];
                mesh.append_mesh(&trail_mesh(&future, radius * 0.7, ends, group::FIRST_FLAT_GROUP + 2));
                next += 1;
            }
        }
        mesh
    }

    fn points_of(&self, pose: &ModelPose) -> Vec<Vec3> {
        let place = |&joint: &usize| {
            let tip = self.anatomy.joint_tip(&self.skeleton, joint);
            pose.joint_point_to_model(joint, tip.unwrap_or_default()).as_vec3()
        };
        let wrist = |joint: &usize| pose.model_joint_position(*joint).as_vec3();
        self.joints
            .iter()
            .flat_map(|joints| {
                let (first, rest) = joints.split_at(joints.len().min(1));
                first.iter().map(wrist).chain(rest.iter().map(place))
            })
            .collect()
    }

    /// Returns floor and grid for a view.
    pub(super) fn build_ground_mesh(&self, view: FigureView, theme: PaperTheme, with_grid: bool) -> TriangleMesh {
        let (paper, rule) = (theme.theme_paper_colour(), theme.rule_colour());
        let axes = self.framing.framing_signer_axes();
        let [left, up, forward] = [axes.x_axis, axes.y_axis, axes.z_axis];
        let mut mesh = TriangleMesh::default();
        if let Some(floor) = self.floor {
            let under = Vec3::new(self.middle.x, floor, self.middle.z);
            let shade = match theme {
                PaperTheme::Light => RgbColour::from_hex_colour(0xC9_CE_D6),
                PaperTheme::Dark => RgbColour::from_hex_colour(0x0C_0E_12),
            };
            if with_grid {
                // The grid lies a little below the shadow, which it would cut otherwise.
                let pen = PlaneLinePen::new([left, forward], under - up * 0.002, 0.004);
                pen.add_plane_grid(&mut mesh, [-8..=8, -8..=8], 0.25, |index| {
                    let share = if index % 4 == 0 { 0.1 } else { 0.55 };
                    rule.mix_colour(paper, share)
                });
            }
            disc(&mut mesh, under, [left * 0.42, forward * 0.34], [shade, paper]);
        }
        if !with_grid {
            return mesh;
        }
        // Without a floor the grid goes below the body as well.
        let rows = if self.floor.is_some() { -4..=10 } else { -8..=8 };
        let (across, along, behind, rows) = match view {
            // From above the floor's grid is enough.
            FigureView::Top => return mesh,
            // The grid stands behind the body as seen from the side of the view.
            FigureView::Left => (forward, up, left * -0.6, rows),
            FigureView::Right => (forward, up, left * 0.6, rows),
            _ => (left, up, forward * -0.35, rows),
        };
        let origin = self.middle + behind;
        PlaneLinePen::new([across, along], origin, 0.0025).add_plane_grid(&mut mesh, [-7..=7, rows], 0.1, |index| {
            match index % 5 {
                0 => rule.mix_colour(theme.theme_text_colour(), 0.22),
                _ => rule,
            }
        });
        mesh
    }
}

/// Returns the joints whose trails are drawn: the wrist, then the ends of thumb and fingers.
fn trail_joints(anatomy: &BodyAnatomy, side: BodySide) -> Vec<usize> {
    let last = |parts: Vec<BodyPart>| parts.into_iter().rev().find_map(|part| anatomy.part_joint(part));
    let thumb = last((0..3).map(|n| BodyPart::Thumb(side, n)).collect());
    let fingers =
        HandFinger::ALL_FINGERS.map(|finger| last((1..4).map(|n| BodyPart::Finger(side, finger, n)).collect()));
    let wrist = anatomy.part_joint(BodyPart::Hand(side));
    std::iter::once(wrist)
        .chain(std::iter::once(thumb).filter(|_| wrist.is_some()))
        .chain(fingers.into_iter().filter(|_| wrist.is_some()))
        .flatten()
        .collect()
}

/// Returns a palette of one colour, somewhat lighter at the hands.
fn single_colour_palette(colour: RgbColour) -> FigurePalette {
    let white = RgbColour::from_hex_colour(0xFF_FF_FF);
    let hand = HandColours {
        palm: colour.mix_colour(white, 0.45),
        back: colour.mix_colour(white, 0.3),
        nail: colour.mix_colour(white, 0.6),
    };
    FigurePalette {
        right: hand,
        left: hand,
        face: colour.mix_colour(white, 0.3),
        crown: colour,
        marks: colour.scale_colour(0.6),
        eyes: colour.mix_colour(white, 0.6),
        mouth: colour.scale_colour(0.8),
        torso: colour,
        sleeves: colour.mix_colour(white, 0.12),
        legs: colour,
        ..FigurePalette::default()
    }
}

/// Draws lines in a plane.
struct PlaneLinePen {
    axes: [Vec3; 2],
    origin: Vec3,
    width: f32,
}

impl PlaneLinePen {
    fn new(axes: [Vec3; 2], origin: Vec3, width: f32) -> Self {
        Self { axes, origin, width }
    }

    /// Adds lines `step` metres apart, in short pieces, so that lines which extend behind the eye are not lost as a
    /// whole.
    fn add_plane_grid(
        &self,
        mesh: &mut TriangleMesh,
        [columns, rows]: [std::ops::RangeInclusive<i32>; 2],
        step: f32,
        colour: impl Fn(i32) -> RgbColour,
    ) {
        let grid_point = |x: i32, y: i32| self.origin + (self.axes[0] * x as f32 + self.axes[1] * y as f32) * step;
        for x in columns.clone() {
            for y in *rows.start()..*rows.end() {
                self.add_plane_line(mesh, [grid_point(x, y), grid_point(x, y + 1)], self.axes[0], colour(x));
            }
        }
        for y in rows {
            for x in *columns.start()..*columns.end() {
                self.add_plane_line(mesh, [grid_point(x, y), grid_point(x + 1, y)], self.axes[1], colour(y));
            }
        }
    }

    fn add_plane_line(&self, mesh: &mut TriangleMesh, [from, to]: [Vec3; 2], aside: Vec3, colour: RgbColour) {
        let half = aside * self.width / 2.0;
        let corners = [from - half, from + half, to + half, to - half];
        quad(mesh, corners, colour);
    }
}

/// Adds a flat quadrilateral that is visible from both sides.
fn quad(mesh: &mut TriangleMesh, corners: [Vec3; 4], colour: RgbColour) {
    let base = mesh.vertices.len() as u32;
    mesh.vertices.extend(corners.map(|at| coloured_vertex(at, colour)));
    // Both sides, since the eye may be below the floor.
    for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 2, 1], [0, 3, 2]] {
        mesh.triangles.push([base + a, base + b, base + c]);
    }
}

/// Adds a disc that fades from its centre to its edge: a shadow on the floor.
fn disc(mesh: &mut TriangleMesh, middle: Vec3, [x, y]: [Vec3; 2], [inner, outer]: [RgbColour; 2]) {
    const DISC_SEGMENT_COUNT: u32 = 32;
    let base = mesh.vertices.len() as u32;
    mesh.vertices.push(coloured_vertex(middle, inner));
    for index in 0..DISC_SEGMENT_COUNT {
        let angle = std::f32::consts::TAU * index as f32 / DISC_SEGMENT_COUNT as f32;
        let rim_point = middle + x * angle.cos() + y * angle.sin();
        mesh.vertices.push(coloured_vertex(rim_point, outer));
        let (a, b) = (base + 1 + index, base + 1 + (index + 1) % DISC_SEGMENT_COUNT);
        mesh.triangles.extend([[base, a, b], [base, b, a]]);
    }
}

fn coloured_vertex(position: Vec3, colour: RgbColour) -> MeshVertex {
    MeshVertex {
        position,
        normal: Vec3::Y,
        colour,
        group: group::FIRST_FLAT_GROUP,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::{FrameRate, SkeletonJoint, glam::DVec3};

    fn subject() -> (StageSubject, Clip) {
        let mut joints = vec![SkeletonJoint::new("Hips", None, DVec3::new(0.0, 1.0, 0.0))];
        let mut add = |name: &str, parent: &str, at: [f64; 3]| {
            let parent = joints.iter().position(|it| it.name == parent);
            joints.push(SkeletonJoint::new(name, parent, DVec3::from(at)));
        };
        add("Spine", "Hips", [0.0, 0.3, 0.0]);
        add("Neck", "Spine", [0.0, 0.2, 0.0]);
        add("Head", "Neck", [0.0, 0.1, 0.0]);
        for (side, x) in [("Right", -1.0), ("Left", 1.0)] {
            add(&format!("{side}Arm"), "Spine", [0.17 * x, 0.15, 0.0]);
            add(&format!("{side}ForeArm"), &format!("{side}Arm"), [0.28 * x, 0.0, 0.0]);
            add(&format!("{side}Hand"), &format!("{side}ForeArm"), [0.25 * x, 0.0, 0.0]);
        }
        let skeleton = Skeleton::new(joints).expect("a skeleton");
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        let clip = Clip::from_rest_pose(skeleton.into(), FrameRate::new(50, 1).expect("a rate"), 100);
        (StageSubject::new(&clip, &anatomy).expect("a subject"), clip)
    }

    #[test]
    fn ghosts_show_past_and_future_within_the_movement() {
        let (subject, clip) = subject();
        let count = |at| {
            subject
                .ghost_bodies_around(PostureSource::Clip(&clip, &[]), RecordingInstant::from_micros(at))
                .len()
        };
        assert_eq!((count(0), count(150_000), count(1_000_000)), (3, 4, 6));
    }

    #[test]
    fn trails_have_the_requested_length_within_the_movement() {
        let (mut subject, clip) = subject();
        let end = clip.clip_span().span_end_instant();
        let mut trails = |at: i64, reach: f64| {
            let at = RecordingInstant::from_micros(at);
            let paper = PaperTheme::Light.theme_paper_colour();
            subject.build_trail_mesh(PostureSource::Clip(&clip, &[]), at, end, reach, paper)
        };
        let (short, long) = (trails(1_000_000, 0.2), trails(1_000_000, 0.4));
        assert!(short.vertices.len() < long.vertices.len());
        assert!(trails(0, 0.4).vertices.len() < long.vertices.len());
        assert!(long.vertices.iter().all(|it| it.group > group::FIRST_FLAT_GROUP));
    }

    #[test]
    fn a_body_without_feet_has_no_floor() {
        let (subject, _) = subject();
        assert!(subject.is_without_fingers());
        let ground = |grid| subject.build_ground_mesh(FigureView::Addressee, PaperTheme::Light, grid);
        assert!(ground(false).triangles.is_empty());
        assert!(!ground(true).triangles.is_empty());
    }
}
