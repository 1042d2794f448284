//! Draws contacts, manner, repetitions, brackets, marks between symbols, and punctuation.

use super::super::symbol::{Bracket, Kind, Mark};
use super::super::tree::{Contact, Repeat};
use super::{Drawing, Point, arc, oval};

/// Draws a mark next to or between movements.
pub(super) fn mark(kind: Kind) -> Drawing {
    match kind {
        Kind::Contact(contact) => touching(contact),
        Kind::Manner(manner) => how(manner),
        Kind::Repeat(repeat) => again(repeat),
        Kind::Alternating => Drawing::new(0.7)
            .arrow([[0.2, 0.86], [0.2, 0.14]])
            .arrow([[0.5, 0.14], [0.5, 0.86]]),
        Kind::Open(bracket) => fence(bracket, false),
        Kind::Close(bracket) => fence(bracket, true),
        Kind::Between => Drawing::new(0.5).line([[0.06, 0.08], [0.44, 0.92]]),
        Kind::Plus => Drawing::new(0.6)
            .line([[0.3, 0.24], [0.3, 0.76]])
            .line([[0.04, 0.5], [0.56, 0.5]]),
        Kind::Symmetry { left_right: true } => Drawing::new(0.6)
            .thin([[0.3, 0.2], [0.3, 0.8]])
            .dot([0.1, 0.5])
            .dot([0.5, 0.5]),
        Kind::Symmetry { left_right: false } => Drawing::new(0.4).dot([0.2, 0.32]).dot([0.2, 0.68]),
        Kind::Nondominant => Drawing::new(0.9)
            .line(mitten(0.02, false))
            .thin(mitten(0.48, true)),
        Kind::RealSpace => Drawing::new(0.8)
            .thin([[0.4, 0.06], [0.4, 0.94]])
            .arrow([[0.1, 0.5], [0.72, 0.5]]),
        Kind::Approx => Drawing::new(0.7).line(
            (0..=20u8)
                .map(|step| {
                    let t = f32::from(step) / 20.0;
                    [
                        0.06 + 0.58 * t,
                        0.5 - 0.12 * (t * std::f32::consts::TAU).sin(),
                    ]
                })
                .collect::<Vec<_>>(),
        ),
        Kind::Relative => Drawing::new(0.8)
            .line([[0.74, 0.86], [0.08, 0.86], [0.6, 0.2]])
            .thin(arc([0.08, 0.86], [0.36, 0.36], -0.145, 0.0)),
        Kind::Version => Drawing::new(0.9)
            .line([[0.34, 0.9], [0.34, 0.1], [0.06, 0.64], [0.46, 0.64]])
            .dot([0.54, 0.86])
            .line(oval([0.74, 0.5], [0.13, 0.4])),
        Kind::Space => Drawing::new(0.3),
        _ => Drawing::default(),
    }
}

/// A mitten in a box 0.4 wide, the thumb at the left or, mirrored, at the right.
fn mitten(at: f32, thumb_left: bool) -> Vec<Point> {
    let outline = [
        [0.12, 0.96],
        [0.12, 0.76],
        [0.0, 0.52],
        [0.12, 0.58],
        [0.12, 0.22],
        [0.24, 0.08],
        [0.36, 0.22],
        [0.36, 0.96],
    ];
    let side = |x: f32| if thumb_left { x } else { 0.38 - x };
    outline.map(|[x, y]| [at + side(x), y]).to_vec()
}

fn touching(contact: Contact) -> Drawing {
    let left = |x: f32| arc([x, 0.5], [0.22, 0.36], -0.2, 0.2);
    let right = |x: f32| arc([x, 0.5], [0.22, 0.36], 0.3, 0.7);
    match contact {
        Contact::Touch => Drawing::new(0.7).line(left(0.13)).line(right(0.57)),
        Contact::Close => Drawing::new(0.8).line(left(0.04)).line(right(0.76)),
        Contact::Interlock => Drawing::new(0.9)
            .line(oval([0.34, 0.5], [0.24, 0.28]))
            .line(oval([0.56, 0.5], [0.24, 0.28])),
        Contact::Cross => Drawing::new(0.8)
            .line([[0.1, 0.16], [0.7, 0.84]])
            .line([[0.7, 0.16], [0.1, 0.84]]),
        Contact::ArmExtended => Drawing::new(1.0)
            .thin([[0.06, 0.08], [0.06, 0.92]])
            .line([[0.06, 0.3], [0.86, 0.3]])
            .dot([0.9, 0.3]),
        Contact::Brushing => Drawing::new(0.9).thin([[0.06, 0.76], [0.84, 0.76]]).arrow([
            [0.08, 0.24],
            [0.3, 0.6],
            [0.54, 0.62],
            [0.82, 0.26],
        ]),
    }
}

fn how(manner: Mark) -> Drawing {
    match manner {
        Mark::Fast => Drawing::new(0.7)
            .line([[0.06, 0.24], [0.32, 0.5], [0.06, 0.76]])
            .line([[0.36, 0.24], [0.62, 0.5], [0.36, 0.76]]),
        Mark::Slow => Drawing::new(0.8)
            .dot([0.12, 0.5])
            .dot([0.4, 0.5])
            .dot([0.68, 0.5]),
        Mark::Tense => {
            Drawing::new(0.5).line([[0.36, 0.04], [0.1, 0.52], [0.4, 0.48], [0.14, 0.96]])
        }
        Mark::Rest => Drawing::new(0.5)
            .line([[0.14, 0.2], [0.14, 0.8]])
            .line([[0.36, 0.2], [0.36, 0.8]]),
        Mark::Halt => Drawing::new(0.8)
            .arrow([[0.06, 0.5], [0.58, 0.5]])
            .line([[0.7, 0.16], [0.7, 0.84]]),
    }
}

fn again(repeat: Repeat) -> Drawing {
    // The colon and bar that repeat music, and arrows end to end for continuation.
    let from_start = |bars: &[f32], width: f32| {
        let colon = Drawing::new(width).dot([0.1, 0.36]).dot([0.1, 0.64]);
        bars.iter()
            .fold(colon, |drawing, x| drawing.line([[*x, 0.14], [*x, 0.86]]))
    };
    let onwards = |count: u8| {
        (0..count).fold(
            Drawing::new(0.3 * f32::from(count) + 0.1),
            |drawing, number| {
                let x = 0.04 + 0.3 * f32::from(number);
                drawing.arrow([[x, 0.5], [x + 0.26, 0.5]])
            },
        )
    };
    match repeat {
        Repeat::FromStart => from_start(&[0.3], 0.4),
        Repeat::FromStartSeveral | Repeat::ManyRandom => from_start(&[0.3, 0.46, 0.62], 0.7),
        Repeat::Continue => onwards(2),
        Repeat::ContinueSeveral => onwards(3),
        Repeat::Reverse | Repeat::ToFro | Repeat::Swap => {
            let back = [[0.84, 0.5], [0.06, 0.5]];
            Drawing::new(0.9)
                .arrow([[0.06, 0.5], [0.84, 0.5]])
                .head(&back, super::HEAD)
        }
    }
}

fn fence(bracket: Bracket, close: bool) -> Drawing {
    let points: Vec<Point> = match bracket {
        Bracket::Seq => arc([0.42, 0.5], [0.34, 0.62], 0.35, 0.65),
        Bracket::Par => vec![[0.34, 0.04], [0.1, 0.04], [0.1, 0.96], [0.34, 0.96]],
        Bracket::Fusion => vec![[0.36, 0.04], [0.08, 0.5], [0.36, 0.96]],
    };
    let side = |x: f32| if close { 0.44 - x } else { x };
    Drawing::new(0.44).line(
        points
            .into_iter()
            .map(|[x, y]| [side(x), y.clamp(0.0, 1.0)])
            .collect::<Vec<_>>(),
    )
}

/// Draws a mark of text.
pub(super) fn punctuation(mark: char) -> Drawing {
    let hook = [
        [0.2, 0.3],
        [0.24, 0.12],
        [0.4, 0.06],
        [0.54, 0.18],
        [0.5, 0.34],
        [0.36, 0.5],
        [0.36, 0.66],
    ];
    let brace = |close: bool| {
        let side = |x: f32| if close { 0.44 - x } else { x };
        let points = [
            [0.38, 0.04],
            [0.22, 0.1],
            [0.22, 0.4],
            [0.06, 0.5],
            [0.22, 0.6],
            [0.22, 0.9],
            [0.38, 0.96],
        ];
        Drawing::new(0.44).line(points.map(|[x, y]| [side(x), y]))
    };
    match mark {
        '!' => Drawing::new(0.3)
            .line([[0.15, 0.06], [0.15, 0.66]])
            .dot([0.15, 0.88]),
        '?' => Drawing::new(0.7).line(hook).dot([0.36, 0.88]),
        ',' => Drawing::new(0.3).line([[0.18, 0.8], [0.08, 0.98]]),
        '{' => brace(false),
        '}' => brace(true),
        '|' => Drawing::new(0.3).line([[0.15, 0.04], [0.15, 0.96]]),
        _ => Drawing::new(0.3).dot([0.15, 0.88]),
    }
}
