//! Every source and operator, with its title, its description, and an initial card.

use chereme_corpus::recipe::{
    Cue, Direction, Hands, Node, Notation, PhaseRule, Point, Spell, Spot, Step, Transition,
};

use super::stack::What;
use crate::words::{Text, recombine as words};

/// Returns the title of each kind of source, with an empty one.
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

/// Returns the title and the description of each operator, with an initial one.
pub(super) fn operators() -> Vec<(Text, Text, Step)> {
    let described = |step: Step| {
        let words = step.description();
        (words.title, words.hint, step)
    };
    Step::usual().into_iter().map(described).collect()
}

/// Returns the title of a card.
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
        What::Step(step) => step.description().title,
    }
}
