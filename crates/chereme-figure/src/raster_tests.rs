//! Compares the rasteriser with closed forms.

use glam::{Quat, Vec3};

use super::*;
use crate::body::body_shape::ellipsoid_mesh;
use crate::palette::RgbColour;

const RED: RgbColour = RgbColour::from_hex_colour(0xFF_00_00);
const BLUE: RgbColour = RgbColour::from_hex_colour(0x00_00_FF);

fn ball(centre: Vec3, radius: f32, colour: RgbColour, group: u8) -> TriangleMesh {
    let paint = |point| (point, colour);
    ellipsoid_mesh(centre, Vec3::splat(radius), Quat::IDENTITY, [96, 64], paint, group)
}

fn camera(distance: f32) -> FigureCamera {
    FigureCamera {
        eye: Vec3::Z * distance,
        target: Vec3::ZERO,
        up: Vec3::Y,
        half_height: 1.0,
        near: 0.0,
    }
}

/// A style with lines only between parts: at this scale a ball's own slope is steeper than a finger's step.
const PLAIN: fn() -> FigureStyle = || FigureStyle {
    step: 1.0,
    ..FigureStyle::default()
};

fn covered(raster: &FigureRaster) -> usize {
    raster.buffers.paint.iter().filter(|&&paint| paint != 0).count()
}

#[test]
fn a_ball_covers_the_disc_of_its_projection() {
    // Seen from distance d, the outline of a ball of radius r has the radius d·r/√(d²-r²) in the
    // plane through its middle.
    let mut raster = FigureRaster::default();
    for (distance, radius) in [(3.0f32, 0.5f32), (5.0, 0.8), (50.0, 0.3)] {
        let mesh = ball(Vec3::ZERO, radius, RED, 1);
        let _ = raster.draw_mesh_picture(&mesh, &camera(distance), [300, 300], &FigureStyle::default());
        let outline = distance * radius / (distance * distance - radius * radius).sqrt();
        let disc = std::f32::consts::PI * (outline * 300.0).powi(2);
        let share = covered(&raster) as f32 / disc;
        assert!((0.99..1.002).contains(&share), "{share} at {distance}");
    }
}

#[test]
fn the_nearer_ball_hides_the_farther_whatever_the_order() {
    let near = ball(Vec3::Z * 0.5, 0.3, RED, 1);
    let far = ball(Vec3::Z * -0.5, 0.6, BLUE, 2);
    let mut raster = FigureRaster::default();
    let images = [[&near, &far], [&far, &near]].map(|[first, second]| {
        let mut mesh = first.clone();
        mesh.append_mesh(second);
        raster.draw_mesh_picture(&mesh, &camera(5.0), [100, 100], &PLAIN())
    });
    assert_eq!(images[0], images[1]);
    let [r, _, b] = images[0].image_pixel_at(50, 50).0;
    assert!(r > 150 && b == 0);
    let [r, _, b] = images[0].image_pixel_at(28, 50).0;
    assert!(b > 60 && r == 0);
}

#[test]
fn neighbouring_triangles_leave_no_gap_and_no_sample_twice() {
    // A fan of thin triangles about a point off the grid: inside its hull every sample is covered.
    let corner = |position| crate::mesh::MeshVertex {
        position,
        normal: Vec3::Z,
        colour: RED,
        group: 1,
    };
    let mut mesh = TriangleMesh::default();
    mesh.vertices.push(corner(Vec3::new(0.0137, -0.0291, 0.0)));
    for i in 0..101 {
        let angle = i as f32 * std::f32::consts::TAU / 101.0;
        mesh.vertices
            .push(corner(Vec3::new(angle.cos(), angle.sin(), 0.0) * 0.9));
    }
    mesh.triangles = (0..101).map(|i| [0, i + 1, (i + 1) % 101 + 1]).collect();
    let mut raster = FigureRaster::default();
    let _ = raster.draw_mesh_picture(&mesh, &camera(7.0), [64, 64], &FigureStyle::default());
    for y in 0..128usize {
        for x in 0..128usize {
            let [dx, dy] = [x, y].map(|v| (v as f32 + 0.5) / 64.0 - 1.0);
            if dx.hypot(dy) < 0.88 {
                let index = raster.buffers.index(x, y);
                assert_eq!(raster.buffers.paint[index] >> 24, 1, "a gap at {x}, {y}");
            }
        }
    }
}

/// Returns a square that faces the eye; `half` is half of its width.
fn plate(half: f32, z: f32, group: u8) -> TriangleMesh {
    let corner = |x: f32, y: f32| MeshVertex {
        position: Vec3::new(x * half, y * half, z),
        normal: Vec3::Z,
        colour: RED,
        group,
    };
    TriangleMesh {
        vertices: vec![
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

#[test]
fn outlines_separate_parts_at_a_depth_step_but_not_within_one_part() {
    let darkest = |group, step: f32| {
        let mut mesh = plate(0.6, 0.0, 1);
        mesh.append_mesh(&plate(0.3, step, group));
        let image = FigureRaster::default().draw_mesh_picture(&mesh, &camera(9.0), [200, 200], &PLAIN());
        (60..140).map(|x| image.image_pixel_at(x, 100).0[0]).min().unwrap_or(0)
    };
    let plain = darkest(1, 0.0);
    assert!(darkest(1, 0.005) + 10 > plain, "within one part");
    assert!(darkest(2, 0.001) + 10 > plain, "where skin goes on");
    assert!(darkest(2, 0.005) + 40 < plain, "between parts");
}

#[test]
fn triangles_behind_the_camera_or_far_outside_are_left_out() {
    let mut raster = FigureRaster::default();
    for at in [
        Vec3::Z * 9.0,
        Vec3::new(0.0, 0.0, 5.0),
        Vec3::new(0.0, 1e3, 5.0 - 1e-7),
        Vec3::X * 1e9,
        Vec3::splat(f32::NAN),
    ] {
        let mesh = ball(at, 0.5, RED, 1);
        let image = raster.draw_mesh_picture(&mesh, &camera(5.0), [50, 50], &FigureStyle::default());
        let paper = PaperTheme::Light.theme_paper_colour();
        if at.z > 6.0 || !at.is_finite() || at.x > 1e6 {
            assert!(image.image_pixels().iter().all(|&pixel| pixel == paper), "{at}");
        }
    }
}

#[test]
fn nothing_is_drawn_nearer_than_the_camera_s_limit() {
    let mesh = ball(Vec3::Z * 0.5, 0.3, RED, 1);
    let count = |near| {
        let camera = FigureCamera { near, ..camera(5.0) };
        let mut raster = FigureRaster::default();
        let _ = raster.draw_mesh_picture(&mesh, &camera, [50, 50], &PLAIN());
        covered(&raster)
    };
    assert!(count(0.0) > 0);
    assert_eq!(count(4.0), count(0.0));
    assert_eq!(count(5.0), 0);
}
