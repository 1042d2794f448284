//! Every source and operator, with its title, its description, and an initial card.

use chereme_corpus::recipe::{
    BodyDirection, CueSettings, HandChoice, NotationSettings, PhaseRule, PointSettings, PostureTransition, RecipeNode,
    SigningSpot, SpellSettings, Step,
};

use super::stack::CardContent;
use crate::words::{InterfaceText, recombine_words as words};

/// Returns the title of each kind of source, with an empty one.
pub(super) fn list_recipe_sources() -> [(InterfaceText, RecipeNode); 6] {
    let notation = || NotationSettings {
        of: String::new(),
        language: None,
        on: None,
    };
    [
        (words::SIGN, RecipeNode::Sign(String::new())),
        (
            words::SPELL,
            RecipeNode::Spell(SpellSettings {
                word: String::new(),
                hand: HandChoice::Dominant,
                alphabet: None,
                hold: None,
                via: PostureTransition::default(),
                on: None,
            }),
        ),
        (
            words::POINT,
            RecipeNode::Point(PointSettings {
                hand: HandChoice::Dominant,
                at: SigningSpot::Towards(vec![BodyDirection::Left]),
                with: None,
                hold: None,
                via: PostureTransition::default(),
                on: None,
            }),
        ),
        (
            words::CUE,
            RecipeNode::Cue(CueSettings {
                text: String::new(),
                phones: None,
                code: None,
                variants: Vec::new(),
                hand: HandChoice::Dominant,
                phase: PhaseRule::default(),
                pace: None,
                on: None,
            }),
        ),
        (words::HAMNOSYS, RecipeNode::Hamnosys(notation())),
        (words::SIGML, RecipeNode::Sigml(notation())),
    ]
}

/// Returns the title and the description of each operator, with an initial one.
pub(super) fn list_recipe_operators() -> Vec<(InterfaceText, InterfaceText, Step)> {
    let described = |step: Step| {
        let words = step.description();
        (words.title, words.hint, step)
    };
    Step::usual().into_iter().map(described).collect()
}

/// Returns the title of a card.
pub(super) fn card_content_title(what: &CardContent) -> InterfaceText {
    match what {
        CardContent::Source { node, .. } => match node {
            RecipeNode::Sign(_) => words::SIGN,
            RecipeNode::Spell(_) => words::SPELL,
            RecipeNode::Point(_) => words::POINT,
            RecipeNode::Cue(_) => words::CUE,
            RecipeNode::Hamnosys(_) => words::HAMNOSYS,
            RecipeNode::Sigml(_) => words::SIGML,
            RecipeNode::Pipe(_) | RecipeNode::Then(_) => words::TEXT,
        },
        CardContent::Step(step) => step.description().title,
    }
}
