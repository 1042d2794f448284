//! The extras of a picture: ghosts of other moments, trails, grid and floor.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_figure::mesh::{Mesh, Vertex, trail};
use chereme_figure::palette::HandColours;
use chereme_figure::{Body, Colour, Framing, Palette, Theme, View, body::group};
use chereme_motion::ends::Ends;
use chereme_motion::{Anatomy, Clip, Face, Finger, Instant, ModelPose, Part, Side, Skeleton};
use glam::Vec3;

use crate::model::reel::Reel;

/// The time between ghosts, which are faint figures of earlier and later postures, in seconds.
const GHOST_STEP: f64 = 0.1;
/// The opacity of each ghost, the nearest first.
const GHOSTS: [f32; 3] = [0.5, 0.36, 0.24];
/// The distance between points of a trail, in microseconds.
const TRAIL_STEP: i64 = 20_000;
/// How many points of trails are kept.
const REMEMBERED: usize = 4000;
/// Colours of past and future ghosts: everybody can distinguish blue and orange.
const PAST: Colour = Colour::hex(0x2E_7F_B8);
const FUTURE: Colour = Colour::hex(0xD9_86_1A);
/// Trails of the right and of the left hand.
const TRAILS: [Colour; 2] = [Colour::hex(0xE0_7B_1F), Colour::hex(0x4C_7F_D6)];

/// A body on the stage, with everything computed once for its movement.
pub(super) struct Subject {
    pub(super) skeleton: Arc<Skeleton>,
    pub(super) anatomy: Anatomy,
    pub(super) framing: Framing,
    pub(super) body: Arc<Body>,
    past: Arc<Body>,
    future: Arc<Body>,
    /// Height of the floor in metres, if the body has feet.
    floor: Option<f32>,
    /// The point between the hips at the beginning of the usable movement.
    middle: Vec3,
    joints: [Vec<usize>; 2],
    points: BTreeMap<i64, Vec<Vec3>>,
}

/// The source of postures.
#[derive(Clone, Copy)]
pub(super) enum Movement<'a> {
    Reel(&'a Reel),
    /// A clip with the face in each frame.
    Clip(&'a Clip, &'a [Face]),
}

impl Movement<'_> {
    /// Returns the posture at that moment, if it is loaded.
    pub(super) fn pose(self, skeleton: &Skeleton, at: Instant) -> Option<ModelPose> {
        let pose = match self {
            Self::Reel(reel) => reel.pose(at)?,
            Self::Clip(clip, _) if clip.frames() == 0 => return None,
            Self::Clip(clip, _) => clip.sample(at),
        };
        Some(ModelPose::of(skeleton, &pose))
    }

    /// Returns the face at that moment, if it is known.
    pub(super) fn face(self, at: Instant) -> Option<Face> {
        match self {
            Self::Reel(reel) => reel.face(at),
            Self::Clip(clip, faces) => Face::at(faces, clip.rate(), at),
        }
    }
}

impl Subject {
    /// Returns the subject of a movement. It takes over the body of another movement with the same skeleton, and its
    /// framing too if the picture must stay `steady`.
    pub(super) fn after(
        before: Option<Self>,
        clip: &Clip,
        anatomy: &Anatomy,
        steady: bool,
    ) -> Option<Self> {
        let same = |it: &Self| {
            it.anatomy == *anatomy
                && (Arc::ptr_eq(&it.skeleton, clip.skeleton()) || it.skeleton == *clip.skeleton())
        };
        match before.filter(same) {
            Some(before) => Some(Self {
                framing: match steady {
                    true => before.framing,
                    false => Framing::of(clip, anatomy)?,
                },
                points: BTreeMap::new(),
                ..before
            }),
            None => Self::new(clip, anatomy),
        }
    }

    fn new(clip: &Clip, anatomy: &Anatomy) -> Option<Self> {
        let framing = Framing::of(clip, anatomy)?;
        let skeleton = clip.skeleton().clone();
        let first = clip.model_pose(Ends::of(clip, anatomy).sound.start);
        let at = |joint: usize| first.position(joint).as_vec3();
        let feet = Side::BOTH.map(|side| anatomy.joint(Part::Foot(side)));
        let floor = feet.iter().flatten().next().map(|_| {
            let heights = (0..skeleton.len()).map(|joint| at(joint).y);
            heights.fold(f32::INFINITY, f32::min) - 0.01
        });
        let tinted = |colour| Arc::new(Body::hands(&skeleton, anatomy, &plain(colour)));
        Some(Self {
            framing,
            body: Arc::new(Body::new(&skeleton, anatomy)),
            past: tinted(PAST),
            future: tinted(FUTURE),
            floor,
            middle: anatomy.joint(Part::Hips).map_or(at(0), at),
            joints: Side::BOTH.map(|side| ends(anatomy, side)),
            points: BTreeMap::new(),
            anatomy: anatomy.clone(),
            skeleton,
        })
    }

    /// Returns whether neither hand has fingers.
    pub(super) fn is_without_fingers(&self) -> bool {
        !Side::BOTH
            .iter()
            .any(|&side| self.anatomy.has_fingers(side))
    }

    /// Returns the body of hands and arms for the posture before an edit, in the colour of past ghosts.
    pub(super) fn before(&self) -> Arc<Body> {
        self.past.clone()
    }

    /// Returns ghosts before and after `at`, the farthest first, each with its opacity.
    pub(super) fn ghosts(
        &self,
        movement: Movement<'_>,
        at: Instant,
    ) -> Vec<(Arc<Body>, ModelPose, f32)> {
        let mut ghosts = Vec::new();
        for (index, opacity) in GHOSTS.into_iter().enumerate().rev() {
            let away = ((index + 1) as f64 * GHOST_STEP * 1e6) as i64;
            for (body, shift) in [(&self.past, -away), (&self.future, away)] {
                let then = at.shifted(shift);
                if then >= Instant::ZERO
                    && let Some(pose) = movement.pose(&self.skeleton, then)
                {
                    ghosts.push((body.clone(), pose, opacity));
                }
            }
        }
        ghosts
    }

    /// Returns the trails of wrists and fingertips from `reach` seconds before `at` to `reach` seconds after it.
    pub(super) fn trails(
        &mut self,
        movement: Movement<'_>,
        (at, end): (Instant, Instant),
        reach: f64,
        paper: Colour,
    ) -> Mesh {
        let reach = ((reach * 1e6) as i64 / TRAIL_STEP).max(1);
        let now = at.micros() / TRAIL_STEP;
        let last = end.micros() / TRAIL_STEP;
        if self.points.len() > REMEMBERED {
            self.points.clear();
        }
        for step in (now - reach).max(0)..=(now + reach).min(last) {
            if self.points.contains_key(&step) {
                continue;
            }
            let then = Instant::from_micros(step * TRAIL_STEP);
            if let Some(pose) = movement.pose(&self.skeleton, then) {
                let points = self.points_of(&pose);
                self.points.insert(step, points);
            }
        }
        let Some(pose) = movement.pose(&self.skeleton, at) else {
            return Mesh::default();
        };
        let here = self.points_of(&pose);
        let mut mesh = Mesh::default();
        let mut next = 0;
        for (joints, colour) in self.joints.iter().zip(TRAILS) {
            for index in 0..joints.len() {
                let path = |steps: std::ops::RangeInclusive<i64>| -> Vec<Vec3> {
                    let points = self.points.range(steps);
                    points.filter_map(|(_, it)| it.get(next).copied()).collect()
                };
                let (mut past, mut future) = (path(now - reach..=now), path(now + 1..=now + reach));
                past.extend(here.get(next));
                future.splice(0..0, here.get(next).copied());
                let radius = if index == 0 { 0.0045 } else { 0.0022 };
                let ends = [colour.mixed(paper, 0.6), colour];
                mesh.append(&trail(&past, radius, ends, group::FLAT + 1));
                let ends = [colour.mixed(paper, 0.35), colour.mixed(paper, 0.85)];
                mesh.append(&trail(&future, radius * 0.7, ends, group::FLAT + 2));
                next += 1;
            }
        }
        mesh
    }

    fn points_of(&self, pose: &ModelPose) -> Vec<Vec3> {
        let place = |&joint: &usize| {
            let tip = self.anatomy.tip(&self.skeleton, joint);
            pose.point(joint, tip.unwrap_or_default()).as_vec3()
        };
        let wrist = |joint: &usize| pose.position(*joint).as_vec3();
        self.joints
            .iter()
            .flat_map(|joints| {
                let (first, rest) = joints.split_at(joints.len().min(1));
                first.iter().map(wrist).chain(rest.iter().map(place))
            })
            .collect()
    }

    /// Returns floor and grid for a view.
    pub(super) fn ground(&self, view: View, theme: Theme, with_grid: bool) -> Mesh {
        let (paper, rule) = (theme.background(), theme.rule());
        let axes = self.framing.axes();
        let [left, up, forward] = [axes.x_axis, axes.y_axis, axes.z_axis];
        let mut mesh = Mesh::default();
        if let Some(floor) = self.floor {
            let under = Vec3::new(self.middle.x, floor, self.middle.z);
            let shade = match theme {
                Theme::Light => Colour::hex(0xC9_CE_D6),
                Theme::Dark => Colour::hex(0x0C_0E_12),
            };
            if with_grid {
                let pen = Pen::new([left, forward], under - up * 0.002, 0.004);
                pen.grid(&mut mesh, [-8..=8, -8..=8], 0.25, |index| {
                    let share = if index % 4 == 0 { 0.1 } else { 0.55 };
                    rule.mixed(paper, share)
                });
            }
            disc(
                &mut mesh,
                under,
                [left * 0.42, forward * 0.34],
                [shade, paper],
            );
        }
        if !with_grid {
            return mesh;
        }
        let rows = if self.floor.is_some() {
            -4..=10
        } else {
            -8..=8
        };
        let (across, along, behind, rows) = match view {
            View::Top => return mesh,
            View::Left => (forward, up, left * -0.6, rows),
            View::Right => (forward, up, left * 0.6, rows),
            _ => (left, up, forward * -0.35, rows),
        };
        let origin = self.middle + behind;
        Pen::new([across, along], origin, 0.0025).grid(&mut mesh, [-7..=7, rows], 0.1, |index| {
            match index % 5 {
                0 => rule.mixed(theme.text(), 0.22),
                _ => rule,
            }
        });
        mesh
    }
}

/// Returns the joints whose trails are drawn: the wrist, then the ends of thumb and fingers.
fn ends(anatomy: &Anatomy, side: Side) -> Vec<usize> {
    let last = |parts: Vec<Part>| parts.into_iter().rev().find_map(|it| anatomy.joint(it));
    let thumb = last((0..3).map(|n| Part::Thumb(side, n)).collect());
    let fingers =
        Finger::ALL.map(|finger| last((1..4).map(|n| Part::Finger(side, finger, n)).collect()));
    let wrist = anatomy.joint(Part::Hand(side));
    std::iter::once(wrist)
        .chain(std::iter::once(thumb).filter(|_| wrist.is_some()))
        .chain(fingers.into_iter().filter(|_| wrist.is_some()))
        .flatten()
        .collect()
}

/// Returns a palette of one colour, somewhat lighter at the hands.
fn plain(colour: Colour) -> Palette {
    let white = Colour::hex(0xFF_FF_FF);
    let hand = HandColours {
        palm: colour.mixed(white, 0.45),
        back: colour.mixed(white, 0.3),
        nail: colour.mixed(white, 0.6),
    };
    Palette {
        right: hand,
        left: hand,
        face: colour.mixed(white, 0.3),
        crown: colour,
        marks: colour.scaled(0.6),
        eyes: colour.mixed(white, 0.6),
        mouth: colour.scaled(0.8),
        torso: colour,
        sleeves: colour.mixed(white, 0.12),
        legs: colour,
        ..Palette::default()
    }
}

/// Draws lines in a plane.
struct Pen {
    axes: [Vec3; 2],
    origin: Vec3,
    width: f32,
}

impl Pen {
    fn new(axes: [Vec3; 2], origin: Vec3, width: f32) -> Self {
        Self {
            axes,
            origin,
            width,
        }
    }

    /// Adds lines `step` metres apart, in short pieces, so that lines which extend behind the eye are not lost as a
    /// whole.
    fn grid(
        &self,
        mesh: &mut Mesh,
        [columns, rows]: [std::ops::RangeInclusive<i32>; 2],
        step: f32,
        colour: impl Fn(i32) -> Colour,
    ) {
        let at = |x: i32, y: i32| {
            self.origin + (self.axes[0] * x as f32 + self.axes[1] * y as f32) * step
        };
        for x in columns.clone() {
            for y in *rows.start()..*rows.end() {
                self.line(mesh, [at(x, y), at(x, y + 1)], self.axes[0], colour(x));
            }
        }
        for y in rows {
            for x in *columns.start()..*columns.end() {
                self.line(mesh, [at(x, y), at(x + 1, y)], self.axes[1], colour(y));
            }
        }
    }

    fn line(&self, mesh: &mut Mesh, [from, to]: [Vec3; 2], aside: Vec3, colour: Colour) {
        let half = aside * self.width / 2.0;
        let corners = [from - half, from + half, to + half, to - half];
        quad(mesh, corners, colour);
    }
}

/// Adds a flat quadrilateral that is visible from both sides.
fn quad(mesh: &mut Mesh, corners: [Vec3; 4], colour: Colour) {
    let base = mesh.vertices.len() as u32;
    mesh.vertices.extend(corners.map(|at| mark(at, colour)));
    for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 2, 1], [0, 3, 2]] {
        mesh.triangles.push([base + a, base + b, base + c]);
    }
}

/// Adds a disc that fades from its centre to its edge: a shadow on the floor.
fn disc(mesh: &mut Mesh, middle: Vec3, [x, y]: [Vec3; 2], [inner, outer]: [Colour; 2]) {
    const AROUND: u32 = 32;
    let base = mesh.vertices.len() as u32;
    mesh.vertices.push(mark(middle, inner));
    for index in 0..AROUND {
        let angle = std::f32::consts::TAU * index as f32 / AROUND as f32;
        let at = middle + x * angle.cos() + y * angle.sin();
        mesh.vertices.push(mark(at, outer));
        let (a, b) = (base + 1 + index, base + 1 + (index + 1) % AROUND);
        mesh.triangles.extend([[base, a, b], [base, b, a]]);
    }
}

fn mark(position: Vec3, colour: Colour) -> Vertex {
    Vertex {
        position,
        normal: Vec3::Y,
        colour,
        group: group::FLAT,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::{Joint, Rate, glam::DVec3};

    fn subject() -> (Subject, Clip) {
        let mut joints = vec![Joint::new("Hips", None, DVec3::new(0.0, 1.0, 0.0))];
        let mut add = |name: &str, parent: &str, at: [f64; 3]| {
            let parent = joints.iter().position(|it| it.name == parent);
            joints.push(Joint::new(name, parent, DVec3::from(at)));
        };
        add("Spine", "Hips", [0.0, 0.3, 0.0]);
        add("Neck", "Spine", [0.0, 0.2, 0.0]);
        add("Head", "Neck", [0.0, 0.1, 0.0]);
        for (side, x) in [("Right", -1.0), ("Left", 1.0)] {
            add(&format!("{side}Arm"), "Spine", [0.17 * x, 0.15, 0.0]);
            add(
                &format!("{side}ForeArm"),
                &format!("{side}Arm"),
                [0.28 * x, 0.0, 0.0],
            );
            add(
                &format!("{side}Hand"),
                &format!("{side}ForeArm"),
                [0.25 * x, 0.0, 0.0],
            );
        }
        let skeleton = Skeleton::new(joints).expect("a skeleton");
        let anatomy = Anatomy::detect(&skeleton);
        let clip = Clip::still(skeleton.into(), Rate::new(50, 1).expect("a rate"), 100);
        (Subject::new(&clip, &anatomy).expect("a subject"), clip)
    }

    #[test]
    fn ghosts_show_past_and_future_within_the_movement() {
        let (subject, clip) = subject();
        let count = |at| {
            subject
                .ghosts(Movement::Clip(&clip, &[]), Instant::from_micros(at))
                .len()
        };
        assert_eq!((count(0), count(150_000), count(1_000_000)), (3, 4, 6));
    }

    #[test]
    fn trails_have_the_requested_length_within_the_movement() {
        let (mut subject, clip) = subject();
        let end = clip.span().end();
        let mut trails = |at: i64, reach: f64| {
            let at = Instant::from_micros(at);
            let paper = Theme::Light.background();
            subject.trails(Movement::Clip(&clip, &[]), (at, end), reach, paper)
        };
        let (short, long) = (trails(1_000_000, 0.2), trails(1_000_000, 0.4));
        assert!(short.vertices.len() < long.vertices.len());
        assert!(trails(0, 0.4).vertices.len() < long.vertices.len());
        assert!(long.vertices.iter().all(|it| it.group > group::FLAT));
    }

    #[test]
    fn a_body_without_feet_has_no_floor() {
        let (subject, _) = subject();
        assert!(subject.is_without_fingers());
        let ground = |grid| subject.ground(View::Addressee, Theme::Light, grid);
        assert!(ground(false).triangles.is_empty());
        assert!(!ground(true).triangles.is_empty());
    }
}
