//! Every source and operator with what it is called, what it does, and one to begin with.

use chereme_corpus::recipe::{
    Amplify, Choice, Configure, Cue, Cut, Direction, Factor, Goal, Hands, Indicate, Leg, Length,
    Mirror, Node, Nonmanual, Notation, Orient, Pace, PhaseRule, Place, Point, Repeat, Retime,
    Seconds, Solver, Spell, Spot, Step, Transition, Travel,
};

use super::stack::What;
use crate::words::{Text, recombine as words};

/// Returns what each kind of source is called, with an empty one.
pub(super) fn sources() -> [(Text, Node); 6] {
    let notation = || Notation {
        of: String::new(),
        language: None,
        on: None,
    };
    [
        (words::SIGN, Node::Sign(String::new())),
        (
            words::SPELL,
            Node::Spell(Spell {
                word: String::new(),
                hand: Hands::Dominant,
                alphabet: None,
                hold: None,
                via: Transition::default(),
                on: None,
            }),
        ),
        (
            words::POINT,
            Node::Point(Point {
                hand: Hands::Dominant,
                at: Spot::Towards(vec![Direction::Left]),
                with: None,
                hold: None,
                via: Transition::default(),
                on: None,
            }),
        ),
        (
            words::CUE,
            Node::Cue(Cue {
                text: String::new(),
                phones: None,
                code: None,
                variants: Vec::new(),
                hand: Hands::Dominant,
                phase: PhaseRule::default(),
                pace: None,
                on: None,
            }),
        ),
        (words::HAMNOSYS, Node::Hamnosys(notation())),
        (words::SIGML, Node::Sigml(notation())),
    ]
}

/// Returns what each operator is called and does, with one that does something to see.
pub(super) fn operators() -> [(Text, Text, Step); 14] {
    let leg = |towards, cm: f64| Leg {
        towards: vec![towards],
        distance: Length::Metres(cm / 100.0),
        time: None,
    };
    [
        (
            words::CONFIGURE,
            words::CONFIGURE_HINT,
            Step::Configure(Configure {
                hand: Hands::Dominant,
                values: vec![Choice::Value(String::new())],
                via: Transition::default(),
            }),
        ),
        (
            words::PLACE,
            words::PLACE_DOES,
            Step::Place(Place {
                hand: Hands::Both,
                to: Goal::By(vec![leg(Direction::Up, 10.0)]),
                with: None,
                solver: Solver::Analytic,
            }),
        ),
        (
            words::ORIENT,
            words::ORIENT_HINT,
            Step::Orient(Orient {
                hand: Hands::Dominant,
                palm: vec![Direction::Up],
                fingers: Vec::new(),
                by: Vec::new(),
            }),
        ),
        (
            words::TRAVEL,
            words::TRAVEL_HINT,
            Step::Travel(Travel {
                hand: Hands::Dominant,
                path: vec![leg(Direction::Right, 20.0)],
                through: Vec::new(),
                time: None,
                via: Transition::default(),
            }),
        ),
        (
            words::AMPLIFY,
            words::AMPLIFY_HINT,
            Step::Amplify(Amplify {
                hand: Hands::Both,
                by: Factor(1.5),
            }),
        ),
        (
            words::REPEAT,
            words::REPEAT_HINT,
            Step::Repeat(Repeat {
                times: 2,
                scale: None,
                tempo: None,
                gap: None,
                via: Transition::default(),
            }),
        ),
        (words::REVERSE, words::REVERSE_HINT, Step::Reverse),
        (words::SWAP, words::SWAP_HINT, Step::Swap),
        (
            words::MIRROR,
            words::MIRROR_HINT,
            Step::Mirror(Mirror {
                from: Hands::Dominant,
            }),
        ),
        (
            words::RETIME,
            words::RETIME_HINT,
            Step::Retime(Retime {
                paces: vec![Pace::Times(Factor(1.5))],
            }),
        ),
        (
            words::SPAN,
            words::SPAN_HINT,
            Step::Span(Cut {
                from: Some(Seconds(0.2)),
                to: None,
            }),
        ),
        (words::TRIM, words::TRIM_HINT, Step::Trim),
        (
            words::INDICATE,
            words::INDICATE_HINT,
            Step::Indicate(Indicate {
                hand: Hands::Both,
                from: None,
                to: Some(Spot::Towards(vec![Direction::Left])),
            }),
        ),
        (
            words::NONMANUAL,
            words::NONMANUAL_HINT,
            Step::Nonmanual(Nonmanual::of("")),
        ),
    ]
}

/// Returns what a card is called.
pub(super) fn title(what: &What) -> Text {
    match what {
        What::Source { node, .. } => match node {
            Node::Sign(_) => words::SIGN,
            Node::Spell(_) => words::SPELL,
            Node::Point(_) => words::POINT,
            Node::Cue(_) => words::CUE,
            Node::Hamnosys(_) => words::HAMNOSYS,
            Node::Sigml(_) => words::SIGML,
            Node::Pipe(_) | Node::Then(_) => words::TEXT,
        },
        What::Step(step) => operators()
            .into_iter()
            .find(|(.., usual)| usual.name() == step.name())
            .map_or(words::TEXT, |(text, ..)| text),
    }
}
