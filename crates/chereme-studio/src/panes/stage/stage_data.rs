//! The cameras and the division of the stage, without widgets.

use crate::settings::stage_settings::{OriginalComparison, WantedInsets};
use chereme_figure::FigureView;
use chereme_figure::camera::FigureCamera;
use chereme_motion::RecordingInstant;
use eframe::egui::{Align2, Pos2, Rect, Vec2};
use glam::{Quat, Vec3};

use crate::action::Action;

/// The views with the actions that choose them.
pub(crate) const VIEW_ACTIONS: [(FigureView, Action); 8] = {
    use chereme_motion::BodySide;
    [
        (FigureView::Addressee, Action::ViewFront),
        (FigureView::Signer, Action::ViewSigner),
        (FigureView::Left, Action::ViewLeft),
        (FigureView::Right, Action::ViewRight),
        (FigureView::Top, Action::ViewTop),
        (FigureView::Hand(BodySide::Right), Action::ViewRightHand),
        (FigureView::Hand(BodySide::Left), Action::ViewLeftHand),
        (FigureView::Face, Action::ViewFace),
    ]
};

/// A preset view with the user's changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StageEye {
    pub(crate) view: FigureView,
    /// Rotation around the vertical axis and upwards, in radians.
    turn: f32,
    lift: f32,
    /// Shift to the right and up, as shares of the picture's height.
    shift: [f32; 2],
    /// Magnification; 1 is the preset.
    zoom: f32,
}

impl Default for StageEye {
    fn default() -> Self {
        Self::from_preset_view(FigureView::Addressee)
    }
}

impl StageEye {
    /// Returns the preset without changes.
    pub(crate) fn from_preset_view(view: FigureView) -> Self {
        Self {
            view,
            turn: 0.0,
            lift: 0.0,
            shift: [0.0; 2],
            zoom: 1.0,
        }
    }

    /// Turns the eye after a drag, given in shares of the picture's height.
    pub(crate) fn orbit_eye(&mut self, [right, down]: [f32; 2]) {
        const QUARTER_TURN_RADIANS: f32 = std::f32::consts::FRAC_PI_2;
        self.turn = (self.turn - right * 3.0).rem_euclid(4.0 * QUARTER_TURN_RADIANS);
        // Short of straight up and down, where left and right would change places.
        self.lift = (self.lift + down * 3.0).clamp(-QUARTER_TURN_RADIANS * 0.98, QUARTER_TURN_RADIANS * 0.98);
    }

    /// Moves the picture after a drag, given in shares of its height.
    pub(crate) fn pan_eye(&mut self, [right, down]: [f32; 2]) {
        // Magnified pictures move by the same share of what is visible.
        self.shift[0] -= right / self.zoom;
        self.shift[1] += down / self.zoom;
    }

    /// Magnifies by a factor; below 1, the picture becomes smaller.
    pub(crate) fn magnify_eye(&mut self, factor: f32) {
        self.zoom = (self.zoom * factor).clamp(0.2, 20.0);
    }

    /// Magnifies around a point of the picture, which keeps its place. The point is given in shares of the picture's
    /// height, to the right of the middle and below it.
    pub(crate) fn nearer_at(&mut self, factor: f32, [right, down]: [f32; 2]) {
        let before = self.zoom;
        self.magnify_eye(factor);
        // The place under the pointer keeps its distance from the middle in points.
        let gone = 1.0 / before - 1.0 / self.zoom;
        self.shift[0] += right * gone;
        self.shift[1] -= down * gone;
    }

    /// Returns the camera; `preset` is the camera of the view.
    pub(crate) fn eye_camera(&self, preset: FigureCamera) -> FigureCamera {
        let sight = preset.eye - preset.target;
        let towards = sight.normalize_or(Vec3::Z);
        let side = preset.up.cross(towards).normalize_or(Vec3::X);
        // Up of the preset need not be perpendicular to the line of sight.
        let up = towards.cross(side);
        let turned = Quat::from_axis_angle(up, self.turn) * Quat::from_axis_angle(side, -self.lift);
        let (side, up) = (turned * side, turned * up);
        let half_height = preset.half_height / self.zoom;
        let moved = (side * self.shift[0] + up * self.shift[1]) * 2.0 * preset.half_height;
        let target = preset.target + moved;
        // A turned eye may stand behind what the preset leaves out.
        let near = if self.is_preset() { preset.near } else { 0.0 };
        FigureCamera {
            eye: target + turned * sight / self.zoom,
            target,
            up,
            half_height,
            near: near / self.zoom,
        }
    }

    /// Returns whether the eye has not been turned away from the preset.
    pub(crate) fn is_preset(&self) -> bool {
        self.turn == 0.0 && self.lift == 0.0
    }
}

/// The contents of a pane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StagePartContent {
    /// The signer of the played movement.
    Signer,
    /// The signer of the original.
    Original,
    /// Both, one over the other.
    Both,
}

/// A part of the stage: its rectangle, the index of its eye, and its contents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StagePart {
    pub(crate) rect: Rect,
    pub(crate) eye: usize,
    pub(crate) who: StagePartContent,
}

/// Width of the line between panes, in points.
const STAGE_PART_GAP_POINTS: f32 = 2.0;

/// Returns the parts of the stage for that number of eyes, with the original according to `compare`.
pub(crate) fn divide_stage_parts(whole: Rect, eyes: usize, compare: Option<OriginalComparison>) -> Vec<StagePart> {
    let wide = whole.width() >= whole.height();
    let panes = match eyes {
        1 => vec![whole],
        2 => halve_stage_rect(whole, wide),
        _ => halve_stage_rect(whole, false)
            .into_iter()
            .flat_map(|half| halve_stage_rect(half, true))
            .collect(),
    };
    let mut parts = Vec::new();
    for (eye, rect) in panes.into_iter().enumerate() {
        let mut part = |rect, who| parts.push(StagePart { rect, eye, who });
        match compare {
            Some(OriginalComparison::Beside) => {
                // Two pictures of a standing signer fit beside each other in all but narrow parts.
                let sides = halve_stage_rect(rect, rect.width() >= rect.height() * 0.8);
                part(sides[0], StagePartContent::Original);
                part(sides[1], StagePartContent::Signer);
            }
            Some(OriginalComparison::Over) => part(rect, StagePartContent::Both),
            Some(OriginalComparison::Alone) | None => part(rect, StagePartContent::Signer),
        }
    }
    parts
}

fn halve_stage_rect(whole: Rect, beside: bool) -> Vec<Rect> {
    let middle = whole.center();
    let (mut first, mut second) = (whole, whole);
    if beside {
        first.max.x = middle.x - STAGE_PART_GAP_POINTS / 2.0;
        second.min.x = middle.x + STAGE_PART_GAP_POINTS / 2.0;
    } else {
        first.max.y = middle.y - STAGE_PART_GAP_POINTS / 2.0;
        second.min.y = middle.y + STAGE_PART_GAP_POINTS / 2.0;
    }
    vec![first, second]
}

/// Returns the initial views of a stage with `count` panes.
pub(crate) fn usual_views(count: usize) -> &'static [FigureView] {
    use chereme_motion::BodySide;
    match count {
        1 => &[FigureView::Addressee],
        2 => &[FigureView::Addressee, FigureView::Right],
        _ => &[
            FigureView::Addressee,
            FigureView::Right,
            FigureView::Hand(BodySide::Right),
            FigureView::Hand(BodySide::Left),
        ],
    }
}

/// Extras that are drawn with the signer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StageExtras {
    /// The reach of trails to either side of the moment, in seconds, if they are shown.
    pub(crate) trails: Option<f64>,
    pub(crate) ghosts: bool,
    pub(crate) grid: bool,
    /// Whether markers are shown beside the signer.
    pub(crate) points: bool,
}

/// A close-up in a corner of a part of the stage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StageInset {
    pub(crate) rect: Rect,
    pub(crate) view: FigureView,
    pub(crate) who: StagePartContent,
}

/// A part of the stage narrower or lower than this, in points, has no room for close-ups.
const INSET_MIN_PART_POINTS: [f32; 2] = [300.0, 220.0];
/// The side of a close-up as a share of the shorter side of its part, and its least and greatest side in points.
const INSET_SIZE_LIMITS: (f32, f32, f32) = (0.36, 72.0, 190.0);
/// The largest share of the width that a close-up takes, so that two of them leave the signer's arms in sight.
const MAX_INSET_WIDTH_SHARE: f32 = 0.25;
/// The distance between a close-up and the edges.
const INSET_MARGIN_POINTS: f32 = 8.0;

/// Returns the close-ups in a part of the stage with that view: the hands below, each on the side where it appears in
/// the view; the face above.
pub(crate) fn place_part_insets(part: &StagePart, view: FigureView, wanted: WantedInsets) -> Vec<StageInset> {
    use chereme_motion::BodySide;
    let [wide, high] = INSET_MIN_PART_POINTS;
    let close = matches!(view, FigureView::Hand(_) | FigureView::Palm(_) | FigureView::Face);
    if close || part.rect.width() < wide || part.rect.height() < high {
        return Vec::new();
    }
    let (share, least, most) = INSET_SIZE_LIMITS;
    let side = (part.rect.size().min_elem() * share)
        .min(part.rect.width() * MAX_INSET_WIDTH_SHARE)
        .clamp(least, most)
        .round();
    let room = part.rect.shrink(INSET_MARGIN_POINTS);
    let size = Vec2::splat(side);
    let corner = |at: Pos2, align: Align2| align.anchor_size(at, size);
    let mut found_insets = Vec::new();
    let mut add = |rect, view| {
        found_insets.push(StageInset {
            rect,
            view,
            who: part.who,
        });
    };
    if wanted.hands {
        // From behind and from above, the right hand is on the right of the picture.
        let behind = matches!(view, FigureView::Signer | FigureView::Top);
        for hand in BodySide::BOTH_SIDES {
            let left = (hand == BodySide::Right) != behind;
            let rect = if left {
                corner(room.left_bottom(), Align2::LEFT_BOTTOM)
            } else {
                corner(room.right_bottom(), Align2::RIGHT_BOTTOM)
            };
            let view = if wanted.palms {
                FigureView::Palm(hand)
            } else {
                FigureView::Hand(hand)
            };
            add(rect, view);
        }
    }
    if wanted.face {
        add(corner(room.right_top(), Align2::RIGHT_TOP), FigureView::Face);
    }
    found_insets
}

/// The inputs of the stage's pictures.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StageLook {
    pub(crate) at: RecordingInstant,
    pub(crate) insets: Vec<(FigureView, StagePartContent, [usize; 2])>,
    pub(crate) eyes: Vec<StageEye>,
    pub(crate) parts: Vec<(usize, StagePartContent, [usize; 2])>,
    pub(crate) shows: StageExtras,
    pub(crate) dark: bool,
    pub(crate) samples: usize,
}

/// Returns the number of samples per side of a pixel: 1 if something moves and the picture is large, else 2.
pub(crate) fn pixel_sample_count(moving: bool, size: [usize; 2]) -> usize {
    // Below that size two samples are fast enough for every frame.
    if moving && size[0] * size[1] > 300_000 { 1 } else { 2 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRESET: FigureCamera = FigureCamera {
        eye: Vec3::new(0.0, 1.0, 7.0),
        target: Vec3::new(0.0, 1.0, 0.0),
        up: Vec3::Y,
        half_height: 1.0,
        near: 3.0,
    };

    #[test]
    fn an_unchanged_camera_equals_the_preset() {
        let camera = StageEye::default().eye_camera(PRESET);
        assert!(camera.eye.distance(PRESET.eye) < 1e-5 && camera.up.distance(PRESET.up) < 1e-5);
        assert_eq!((camera.half_height, camera.near), (1.0, 3.0));
    }

    #[test]
    fn dragged_points_follow_the_pointer() {
        let point = Vec3::new(0.1, 1.2, 0.0);
        let before = PRESET.camera_projection(400, 400).project_point(point);
        let mut eye = StageEye::default();
        eye.pan_eye([0.1, 0.05]);
        let after = eye.eye_camera(PRESET).camera_projection(400, 400).project_point(point);
        assert!((after.x - before.x - 40.0).abs() < 0.5, "{}", after.x - before.x);
        assert!((after.y - before.y - 20.0).abs() < 0.5);
        let mut eye = StageEye::default();
        eye.orbit_eye([0.05, 0.0]);
        let near = Vec3::new(0.0, 1.0, 0.3);
        let turned = eye.eye_camera(PRESET).camera_projection(400, 400).project_point(near);
        assert!(turned.x > 200.0, "the near side goes with the pointer");
        eye.orbit_eye([0.0, 0.1]);
        let camera = eye.eye_camera(PRESET);
        assert!(camera.eye.y > PRESET.eye.y, "dragged down, seen from above");
        assert!((camera.eye.distance(camera.target) - 7.0).abs() < 1e-4);
    }

    #[test]
    fn views_fill_the_stage_and_each_has_its_own_camera() {
        let whole = Rect::from_min_size(eframe::egui::pos2(10.0, 20.0), eframe::egui::vec2(802.0, 502.0));
        for (eyes, compare, count) in [
            (1, None, 1),
            (1, Some(OriginalComparison::Beside), 2),
            (1, Some(OriginalComparison::Over), 1),
            (2, None, 2),
            (4, Some(OriginalComparison::Alone), 4),
            (4, Some(OriginalComparison::Beside), 8),
        ] {
            let parts = divide_stage_parts(whole, eyes, compare);
            assert_eq!(parts.len(), count);
            let area: f32 = parts.iter().map(|it| it.rect.area()).sum();
            assert!(area <= whole.area() && area > whole.area() * 0.97);
            assert_eq!(parts.last().map(|it| it.eye), Some(eyes - 1));
            assert_eq!(usual_views(eyes).len(), eyes);
        }
        assert_eq!(
            divide_stage_parts(whole, 1, Some(OriginalComparison::Beside))[0].who,
            StagePartContent::Original
        );
    }

    #[test]
    fn close_ups_are_in_the_corners_and_never_overlap() {
        use chereme_motion::BodySide;
        let part = |wide: f32, high: f32| StagePart {
            rect: Rect::from_min_size(Pos2::new(10.0, 20.0), Vec2::new(wide, high)),
            eye: 0,
            who: StagePartContent::Signer,
        };
        let all = WantedInsets {
            hands: true,
            palms: false,
            face: true,
        };
        for (wide, high) in [(300.0, 220.0), (660.0, 400.0), (330.0, 700.0)] {
            let part = part(wide, high);
            let insets = place_part_insets(&part, FigureView::Addressee, all);
            assert_eq!(insets.len(), 3);
            for (at, inset) in insets.iter().enumerate() {
                assert!(part.rect.contains_rect(inset.rect));
                assert!(inset.rect.width() <= wide * 0.26, "the arms stay in sight");
                let mut others = insets[at + 1..].iter();
                assert!(others.all(|other| !other.rect.intersects(inset.rect)));
            }
        }
        let part = part(660.0, 400.0);
        let right = |view| {
            let insets = place_part_insets(&part, view, WantedInsets::default());
            let hand = insets.iter().find(|it| it.view == FigureView::Hand(BodySide::Right));
            hand.map(|it| it.rect.center().x < part.rect.center().x)
        };
        assert_eq!(right(FigureView::Addressee), Some(true));
        assert_eq!(right(FigureView::Signer), Some(false), "from behind it is on the right");
        assert!(
            place_part_insets(&part, FigureView::Face, all).is_empty(),
            "it is near enough"
        );
        assert!(place_part_insets(&self::part_of(200.0), FigureView::Addressee, all).is_empty());
    }

    fn part_of(side: f32) -> StagePart {
        StagePart {
            rect: Rect::from_min_size(Pos2::ZERO, Vec2::splat(side)),
            eye: 0,
            who: StagePartContent::Signer,
        }
    }

    #[test]
    fn zooming_in_shows_less_within_limits() {
        let mut eye = StageEye::default();
        eye.magnify_eye(2.0);
        assert_eq!(eye.eye_camera(PRESET).half_height, 0.5);
        eye.magnify_eye(1e9);
        assert_eq!(eye.eye_camera(PRESET).half_height, 0.05);
    }

    #[test]
    fn the_wheel_zooms_towards_the_pointer() {
        let at = [0.3, -0.2];
        // The point under the pointer, to the right of the target and above it.
        let under = |eye: &StageEye| {
            let camera = eye.eye_camera(PRESET);
            let height = 2.0 * camera.half_height;
            let place = [at[0] * height, -at[1] * height];
            [camera.target.x + place[0], camera.target.y + place[1]]
        };
        let mut eye = StageEye::default();
        let before = under(&eye);
        for factor in [1.5, 1.5, 0.4, 3.0] {
            eye.nearer_at(factor, at);
            let now = under(&eye);
            // Sums of a few numbers below ten.
            assert!(
                before.iter().zip(now).all(|(a, b)| (a - b).abs() < 1e-5),
                "{before:?} {now:?}"
            );
        }
    }
}
