//! Plain forms for skeletons that lack joints of a dressed body: rods, and a slab for the trunk.

use chereme_motion::{Side, anatomy::Part};
use glam::Vec3;

use super::builder::Builder;
use super::group;
use super::shape::{Loft, Paint, Point, Rod, Section, place, rotation};

/// A reference for points of a trunk without joints, below the middle of the shoulders.
struct Hang {
    joint: usize,
    at: Vec3,
    turn: glam::Quat,
    from: Vec3,
    up: Vec3,
}

impl Hang {
    /// Returns the point `down` metres below the shoulders.
    fn below(&self, down: f32) -> Point {
        Point {
            joint: self.joint,
            local: self.turn * (self.from - self.up * down - self.at),
        }
    }
}

impl Builder<'_> {
    /// Adds a rod between two joints; radii are those of an adult.
    pub(super) fn limb(&mut self, from: usize, to: usize, radii: [f32; 3], paint: Paint) {
        let bone =
            rotation(self.rest, from).inverse() * (place(self.rest, to) - place(self.rest, from));
        let rod = Rod {
            ends: [Point::at(from), Point::at(to)],
            radii: radii.map(|radius| radius * self.size),
            facing: (from, bone.normalize_or(Vec3::X).any_orthonormal_vector()),
            columns: 20,
        };
        self.out.rod(rod, paint);
    }

    pub(super) fn plain_arm(&mut self, side: Side) {
        let parts = [Part::UpperArm(side), Part::Forearm(side), Part::Hand(side)];
        let paint = Paint::plain(self.palette.sleeves, group::arm(side));
        let [Some(upper), Some(forearm), Some(hand)] = parts.map(|part| self.joint(part)) else {
            return;
        };
        self.limb(upper, forearm, [0.058, 0.050, 0.043], paint);
        self.limb(forearm, hand, [0.043, 0.038, 0.026], paint);
    }

    pub(super) fn leg(&mut self, side: Side) {
        let paint = Paint::plain(self.palette.legs, group::REST);
        let parts = [
            Part::Thigh(side),
            Part::Shin(side),
            Part::Foot(side),
            Part::Toes(side),
        ];
        let radii = [
            [0.050, 0.068, 0.052],
            [0.055, 0.052, 0.038],
            [0.038, 0.035, 0.030],
        ];
        for (pair, radii) in parts.windows(2).zip(radii) {
            if let (Some(from), Some(to)) = (self.joint(pair[0]), self.joint(pair[1])) {
                self.limb(from, to, radii, paint);
            }
        }
    }

    pub(super) fn plain_torso(&mut self) {
        let paint = Paint::plain(self.palette.torso, group::TORSO);
        let upper = Side::BOTH.map(|side| self.joint(Part::UpperArm(side)));
        let [Some(right), Some(left)] = upper else {
            return;
        };
        let size = self.size;
        let hang = self.hang(right, left);
        let top = self.joint(Part::Neck).or(self.joint(Part::Head));
        let neck = top.map_or_else(|| hang.below(-0.09 * size), Point::at);
        let hips = self
            .joint(Part::Hips)
            .filter(|&hips| place(self.rest, hips).distance(hang.from) > 0.25 * size);
        let middle = match (hips, top) {
            (Some(hips), Some(top)) => Point::at(self.spine_middle(hips, top)),
            (Some(hips), None) => {
                let far = place(self.rest, hips).distance(hang.from);
                hang.below(far * 0.5)
            }
            (None, _) => hang.below(0.25 * size),
        };
        let section = |middle: &[(Point, f32)], half: f32, measures: [f32; 4]| {
            let [beyond, front, back, shift] = measures.map(|measure| measure * size);
            let point = |sign: f32| {
                let mut mix: Vec<(Point, f32)> = middle.to_vec();
                mix.push((Point::at(left), sign * half));
                mix.push((Point::at(right), -sign * half));
                mix
            };
            Section {
                spine: vec![point(-1.0), point(0.0), point(1.0)],
                beyond,
                thickness: [front, back],
                shift,
            }
        };
        let thighs = Side::BOTH.map(|side| self.joint(Part::Thigh(side)));
        let seat = match thighs {
            [Some(r), Some(l)] => vec![(Point::at(r), 0.5), (Point::at(l), 0.5)],
            _ => vec![(hips.map_or_else(|| hang.below(0.5 * size), Point::at), 1.0)],
        };
        let between = |share: f32| {
            vec![
                (middle, 1.0 - share),
                (Point::at(left), share / 2.0),
                (Point::at(right), share / 2.0),
            ]
        };
        let sections = vec![
            section(&seat, 0.26, [0.050, 0.080, 0.085, -0.075]),
            section(&seat, 0.32, [0.070, 0.110, 0.115, 0.0]),
            section(&seat, 0.29, [0.070, 0.110, 0.110, 0.09]),
            section(&between(0.0), 0.26, [0.055, 0.105, 0.095, 0.0]),
            section(&between(0.5), 0.33, [0.050, 0.115, 0.105, 0.0]),
            section(&between(0.85), 0.38, [0.030, 0.100, 0.098, 0.0]),
            section(&between(1.0), 0.34, [0.020, 0.068, 0.078, 0.03]),
            section(
                &[(Point::at(left), 0.3), (Point::at(right), 0.3), (neck, 0.4)],
                0.18,
                [0.045, 0.048, 0.06, 0.025],
            ),
        ];
        self.out.loft(
            Loft {
                sections,
                columns: 32,
                roundness: 0.8,
            },
            paint,
        );
        for shoulder in [left, right] {
            let rod = Rod {
                ends: [Point::at(shoulder), neck],
                radii: [0.046 * size, 0.050 * size, 0.040 * size],
                facing: (shoulder, Vec3::Z),
                columns: 20,
            };
            self.out.rod(rod, paint);
        }
    }

    /// Returns the reference for the trunk's points if it lacks joints: the joint that carries both arms.
    fn hang(&self, right: usize, left: usize) -> Hang {
        let above: Vec<usize> = self.skeleton.ancestors(right).collect();
        let shared = self.skeleton.ancestors(left).find(|it| above.contains(it));
        let joint = self.joint(Part::Chest).or(shared).unwrap_or(0);
        let up = self.anatomy.body_frame(self.rest);
        let up = up.map_or(Vec3::Y, |frame| frame.up.as_vec3());
        Hang {
            joint,
            at: place(self.rest, joint),
            turn: rotation(self.rest, joint).inverse(),
            from: (place(self.rest, right) + place(self.rest, left)) * 0.5,
            up,
        }
    }

    /// Returns the joint of the spine nearest the middle between hips and neck at rest.
    fn spine_middle(&self, hips: usize, neck: usize) -> usize {
        let target = (place(self.rest, hips) + place(self.rest, neck)) * 0.5;
        let distance = |joint: usize| place(self.rest, joint).distance_squared(target);
        let chain = self.skeleton.ancestors(neck).skip(1);
        chain
            .take_while(|&joint| joint != hips)
            .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(hips)
    }

    /// Adds every bone of a skeleton that is not a known body.
    pub(super) fn bones(&mut self) {
        let paint = Paint::plain(self.palette.face, group::REST);
        let places: Vec<Vec3> = (0..self.skeleton.len())
            .map(|j| place(self.rest, j))
            .collect();
        let box_ = places
            .iter()
            .fold((places[0], places[0]), |(low, high), &at| {
                (low.min(at), high.max(at))
            });
        let thick = (box_.1 - box_.0).length().max(0.1) * 0.03;
        let rod = |ends: [Point; 2], length: f32| {
            let radius = (length * 0.14).clamp(thick * 0.15, thick);
            Rod {
                ends,
                radii: [radius, radius * 0.85, radius * 0.7],
                facing: (ends[0].joint, Vec3::Z),
                columns: 12,
            }
        };
        for (index, joint) in self.skeleton.joints().iter().enumerate() {
            if let Some(parent) = joint.parent {
                let ends = [Point::at(parent), Point::at(index)];
                self.out.rod(rod(ends, joint.offset.length() as f32), paint);
            }
            if let Some(tip) = joint.tip {
                let local = tip.as_vec3();
                let end = Point {
                    joint: index,
                    local,
                };
                self.out
                    .rod(rod([Point::at(index), end], local.length()), paint);
            }
            if self.skeleton.len() == 1 && joint.tip.is_none() {
                let ends = [Point::at(0), Point::at(0)];
                self.out.rod(rod(ends, 0.1), paint);
            }
        }
    }
}
