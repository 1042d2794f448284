//! Faces can be read: at 200 pixels each non-manual and each mouth differs visibly from its neighbours in the list.

use chereme_corpus::built_in_body;
use chereme_figure::image::RasterImage;
use chereme_figure::mesh::TriangleMesh;
use chereme_figure::raster::{FigureRaster, FigureStyle};
use chereme_figure::{ClipFraming, FigureView, SignerBody};
use chereme_motion::FacePosture;
use chereme_sign::hamnosys::hamnosys_face::FacialExpression;

/// How high a picture is; the face takes four fifths of it.
const SIZE: usize = 200;
/// So many pixels differ at least: the brows of a question move by 0.03 of a face, 6 pixels, over a tenth of its width.
const READABLE: usize = 96;
/// A pixel differs if one of its colours does by this.
const COLOUR: u8 = 24;
/// The moments of an expression that are looked at, as shares of its time.
const MOMENTS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

struct Painter {
    draw: Box<dyn FnMut(&FacePosture) -> RasterImage>,
}

impl Painter {
    fn new() -> Self {
        let (clip, anatomy) = built_in_body().expect("it is part of the program");
        let framing = ClipFraming::framing_from_clip(&clip, &anatomy).expect("a frame");
        let body = SignerBody::new(clip.clip_skeleton(), &anatomy);
        let pose = clip.model_pose(0);
        let camera = framing.framing_camera(FigureView::Face, 1.0, &pose, &anatomy);
        let (style, mut raster, mut mesh) = (FigureStyle::default(), FigureRaster::default(), TriangleMesh::default());
        let draw = move |face: &FacePosture| {
            body.shape_body_mesh(&pose, &mut mesh);
            body.apply_face_expression(&pose, face, &mut mesh);
            raster.draw_mesh_picture(&mesh, &camera, [SIZE, SIZE], &style)
        };
        Self { draw: Box::new(draw) }
    }

    fn course(&mut self, expression: &FacialExpression) -> Vec<RasterImage> {
        let at = |share: &f64| (self.draw)(&expression.expression_face_at(*share));
        MOMENTS.iter().map(at).collect()
    }
}

/// Returns how many pixels differ between two expressions, at the moment at which most do.
fn difference(a: &[RasterImage], b: &[RasterImage]) -> usize {
    let differs = |(a, b): (&RasterImage, &RasterImage)| {
        let pairs = a.image_pixels().iter().zip(b.image_pixels());
        pairs
            .filter(|(a, b)| {
                let colours = a.0.iter().zip(b.0);
                colours.into_iter().any(|(a, b)| a.abs_diff(b) > COLOUR)
            })
            .count()
    };
    a.iter().zip(b).map(differs).max().unwrap_or_default()
}

/// Returns the pairs of neighbours that look alike.
fn alike(names: &[String], drawn: &[Vec<RasterImage>]) -> Vec<String> {
    let pairs = names.windows(2).zip(drawn.windows(2));
    pairs
        .filter_map(|(names, drawn)| {
            let pixels = difference(&drawn[0], &drawn[1]);
            let [a, b] = names else { return None };
            (pixels < READABLE).then(|| format!("{a} and {b}: {pixels}"))
        })
        .collect()
}

#[test]
fn each_non_manual_differs_from_its_neighbours_and_from_rest() {
    let mut painter = Painter::new();
    let rest = vec![(painter.draw)(&FacePosture::default()); MOMENTS.len()];
    let mut faults = Vec::new();
    for part in ["brows", "lids", "gaze", "nose", "mouth"] {
        let own = |(code, _): &(&str, &str)| code.split_once('.').is_some_and(|it| it.0 == part);
        let codes: Vec<String> = FacialExpression::listed_expression_codes()
            .filter(own)
            .map(|it| it.0.to_owned())
            .collect();
        let drawn: Vec<Vec<RasterImage>> = codes
            .iter()
            .map(|code| {
                let (part, short) = code.split_once('.').expect("a part");
                painter.course(&FacialExpression::from_nonmanual_code(part, short).expect("it is listed"))
            })
            .collect();
        faults.extend(alike(&codes, &drawn));
        // A gaze at the addressee equals the resting gaze, so it is left out.
        for (code, drawn) in codes.iter().zip(&drawn).filter(|(code, _)| *code != "gaze.AD") {
            let pixels = difference(drawn, &rest);
            if pixels < READABLE {
                faults.push(format!("{code} and rest: {pixels}"));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

/// The sounds that lips distinguish, each next to one that it is not to be taken for.
#[test]
fn each_visually_distinct_mouth_differs_from_its_neighbours() {
    const MOUTHS: [&str; 17] = [
        "a", "@", "e", "i", "E", "O", "o", "u", "p", "f", "S", "s", "T", "l", "t", "w", "r",
    ];
    let mut painter = Painter::new();
    let names: Vec<String> = MOUTHS.iter().map(|it| (*it).to_owned()).collect();
    let drawn: Vec<Vec<RasterImage>> = MOUTHS
        .iter()
        .map(|sound| painter.course(&FacialExpression::from_nonmanual_code("mouthing", sound).expect("a sound")))
        .collect();
    let faults = alike(&names, &drawn);
    assert!(faults.is_empty(), "{faults:#?}");
}
