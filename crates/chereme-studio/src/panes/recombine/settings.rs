//! The settings of each source and operator as widgets; what they cannot show is a line of its text.

use chereme_corpus::recipe::{
    Amplify, Choice, Configure, Degrees, Direction, Factor, Goal, HandPoint, Hands, Indicate, Leg,
    Length, Mirror, Node, Nonmanual, Notation, Orient, Pace, Place, Point, Recipe, Repeat, Retime,
    Seconds, Solver, Spell, Spot, Step, Transition, Travel, Turn,
};
use chereme_sign::Component;
use eframe::egui::{DragValue, Id, Role, TextEdit, Ui, WidgetInfo};

use super::fields::{self, caption, choose};
use super::path;
use super::stack::What;
use crate::context::Seen;
use crate::words::{Text, recombine as words};

/// Returns what each kind of source is called, with an empty one.
pub(super) fn sources() -> [(Text, Node); 5] {
    let notation = || Notation {
        of: String::new(),
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
        (words::HAMNOSYS, Node::Hamnosys(notation())),
        (words::SIGML, Node::Sigml(notation())),
    ]
}

/// Returns what each operator is called and does, with one that does something to see.
pub(super) fn operators() -> [(Text, Text, Step); 12] {
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
            Step::Nonmanual(Nonmanual {
                from: String::new(),
            }),
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

/// Where settings are shown.
#[derive(Debug, Clone, Copy)]
pub(super) struct At {
    /// The card.
    pub(super) id: Id,
    /// Whether it is the first card.
    pub(super) first: bool,
    /// Whether all of them are shown, not only those that matter most.
    pub(super) whole: bool,
}

/// Shows the settings of a card; returns whether the person changed one.
pub(super) fn show(ui: &mut Ui, seen: &Seen<'_>, at: At, what: &mut What) -> bool {
    match what {
        What::Source { via, node } => {
            let mut changed = source(ui, seen, at, node);
            changed |= !at.first && transition(ui, seen, at, via);
            changed
        }
        What::Step(step) => operator(ui, seen, at, step),
    }
}

/// Shows a transition where one is asked for, or all settings are shown.
fn transition(ui: &mut Ui, seen: &Seen<'_>, at: At, via: &mut Transition) -> bool {
    (at.whole || !via.is_default()) && fields::transition(ui, seen, via)
}

fn source(ui: &mut Ui, seen: &Seen<'_>, at: At, node: &mut Node) -> bool {
    match node {
        Node::Sign(name) => fields::sign(ui, seen, at.id, seen.say(words::SIGN_NAME), name),
        Node::Spell(it) => spell(ui, seen, at, it),
        Node::Point(it) => {
            let mut changed = false;
            ui.horizontal_wrapped(|ui| {
                changed |= fields::hands(ui, seen, &mut it.hand, true);
                caption(ui, seen, words::POINT_AT);
                changed |= fields::spot(ui, seen, at.id, seen.say(words::POINT_AT), &mut it.at);
            });
            ui.horizontal_wrapped(|ui| {
                changed |= fields::time(ui, seen, words::HOLD, &mut it.hold, 0.3);
                changed |= fields::signer(ui, seen, &mut it.on);
            });
            changed
        }
        Node::Hamnosys(it) => {
            let mut changed = line(ui, seen.say(words::HAMNOSYS_SYMBOLS), "", &mut it.of);
            ui.horizontal_wrapped(|ui| changed |= fields::signer(ui, seen, &mut it.on));
            changed
        }
        Node::Sigml(it) => {
            let mut changed =
                fields::sign(ui, seen, at.id, seen.say(words::SIGML_NAME), &mut it.of);
            ui.horizontal_wrapped(|ui| changed |= fields::signer(ui, seen, &mut it.on));
            changed
        }
        Node::Pipe(_) | Node::Then(_) => {
            let text = node.to_string();
            as_text(ui, seen, at.id, &text, |typed| {
                let recipe: Recipe = typed.parse().ok()?;
                *node = recipe.root().clone();
                Some(())
            })
        }
    }
}

fn line(ui: &mut Ui, name: &str, hint: &str, text: &mut String) -> bool {
    let field = TextEdit::singleline(text)
        .hint_text(hint)
        .desired_width((ui.available_width() - 8.0).min(260.0));
    let response = ui.add(field);
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
    response.changed()
}

fn spell(ui: &mut Ui, seen: &Seen<'_>, at: At, it: &mut Spell) -> bool {
    let mut changed = line(
        ui,
        seen.say(words::LETTERS),
        seen.say(words::LETTERS_HINT),
        &mut it.word,
    );
    ui.horizontal_wrapped(|ui| {
        changed |= fields::hands(ui, seen, &mut it.hand, true);
        let alphabets: Vec<String> = seen
            .snapshot
            .overview
            .inventories
            .iter()
            .filter(|it| {
                it.inventory
                    .values
                    .iter()
                    .any(|value| value.letter.is_some())
            })
            .map(|it| it.inventory.id.clone())
            .collect();
        let mut nth = it
            .alphabet
            .as_ref()
            .map(|id| alphabets.iter().position(|it| it == id));
        if nth != Some(None) && !alphabets.is_empty() {
            let all: Vec<(Option<Option<usize>>, &str)> = [(None, seen.say(words::ANY_ALPHABET))]
                .into_iter()
                .chain(
                    alphabets
                        .iter()
                        .enumerate()
                        .map(|(at, id)| (Some(Some(at)), id.as_str())),
                )
                .collect();
            if choose(ui, seen.say(words::ALPHABET), &mut nth, &all) {
                it.alphabet = nth.flatten().map(|nth| alphabets[nth].clone());
                changed = true;
            }
        }
        changed |= fields::time(ui, seen, words::HOLD, &mut it.hold, 0.2);
        changed |= fields::signer(ui, seen, &mut it.on);
    });
    changed | transition(ui, seen, at, &mut it.via)
}

/// Shows a part as its text; `take` takes what was typed where it can be read.
fn as_text(
    ui: &mut Ui,
    seen: &Seen<'_>,
    id: Id,
    text: &str,
    mut take: impl FnMut(&str) -> Option<()>,
) -> bool {
    let mut typed: String = ui
        .data(|data| data.get_temp(id))
        .unwrap_or_else(|| text.to_owned());
    let field = TextEdit::multiline(&mut typed)
        .desired_rows(1)
        .desired_width(f32::INFINITY);
    let response = ui.add(field.id(id));
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, seen.say(words::TEXT)));
    let mut changed = false;
    if response.changed() {
        changed = take(&typed).is_some();
    }
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, typed));
    } else {
        ui.data_mut(|data| data.remove::<String>(id));
    }
    changed
}

/// Shows a step as its text.
fn step_as_text(ui: &mut Ui, seen: &Seen<'_>, id: Id, step: &mut Step) -> bool {
    let text = step.to_string();
    as_text(ui, seen, id, &text, |typed| {
        let recipe: Recipe = format!("x | {typed}").parse().ok()?;
        let Node::Pipe(pipe) = recipe.root() else {
            return None;
        };
        match pipe.steps.as_slice() {
            [one] => {
                *step = one.clone();
                Some(())
            }
            _ => None,
        }
    })
}

fn operator(ui: &mut Ui, seen: &Seen<'_>, at: At, step: &mut Step) -> bool {
    let mut changed = false;
    match step {
        Step::Configure(it) => return configure(ui, seen, at, it),
        Step::Place(it) if matches!(it.to, Goal::Best(_)) => {
            return step_as_text(ui, seen, at.id, step);
        }
        Step::Place(it) => return place(ui, seen, at, it),
        Step::Reverse | Step::Swap => {}
        Step::Mirror(it) => {
            ui.horizontal_wrapped(|ui| {
                caption(ui, seen, words::COPIED);
                changed |= fields::hands(ui, seen, &mut it.from, false);
            });
        }
        Step::Repeat(it) => return repeat(ui, seen, at, it),
        Step::Orient(it) => return orient(ui, seen, it),
        Step::Amplify(it) => {
            ui.horizontal_wrapped(|ui| {
                changed |= fields::hands(ui, seen, &mut it.hand, true);
                changed |= fields::slide(ui, seen.say(words::SIZE), &mut it.by.0, 0.0..=3.0, "×");
            });
        }
        Step::Travel(it) => {
            ui.horizontal_wrapped(|ui| changed |= fields::hands(ui, seen, &mut it.hand, true));
            changed |= path::show(ui, seen, at.id, &mut it.path);
            changed |= transition(ui, seen, at, &mut it.via);
        }
        Step::Retime(it) => return retime(ui, seen, it),
        Step::Nonmanual(it) => {
            return fields::sign(ui, seen, at.id, seen.say(words::FROM_SIGN), &mut it.from);
        }
        Step::Indicate(it) => return indicate(ui, seen, at, it),
    }
    changed
}

#[derive(Clone, Copy, PartialEq)]
enum ChoiceKind {
    Value,
    From,
    Keep,
    Best,
}

fn choice(ui: &mut Ui, seen: &Seen<'_>, id: Id, value: &mut Choice) -> bool {
    let mut kind = match value {
        Choice::Value(_) => ChoiceKind::Value,
        Choice::From(_) => ChoiceKind::From,
        Choice::Keep => ChoiceKind::Keep,
        Choice::Best(_) => ChoiceKind::Best,
    };
    let all = [
        (ChoiceKind::Value, seen.say(words::CHOICE_VALUE)),
        (ChoiceKind::From, seen.say(words::FROM_SIGN)),
        (ChoiceKind::Best, seen.say(words::CHOICE_BEST)),
        (ChoiceKind::Keep, seen.say(words::CHOICE_KEEP)),
    ];
    let mut changed = choose(ui, seen.say(words::WHERE_FROM), &mut kind, &all);
    if changed {
        *value = match kind {
            ChoiceKind::Value => Choice::Value(String::new()),
            ChoiceKind::From => Choice::From(String::new()),
            ChoiceKind::Best => Choice::Best("configuration=U signer=same".into()),
            ChoiceKind::Keep => Choice::Keep,
        };
    }
    match value {
        Choice::Value(text) => {
            changed |= fields::of_inventory(ui, seen, id, Component::Configuration, text);
        }
        Choice::From(text) => {
            changed |= fields::sign(ui, seen, id, seen.say(words::FROM_SIGN), text);
        }
        Choice::Best(text) => changed |= line(ui, seen.say(words::CHOICE_BEST), "", text),
        Choice::Keep => {}
    }
    changed
}

fn configure(ui: &mut Ui, seen: &Seen<'_>, at: At, it: &mut Configure) -> bool {
    let mut changed = false;
    let mut gone = None;
    let several = it.values.len() > 1;
    for (nth, value) in it.values.iter_mut().enumerate() {
        ui.push_id(nth, |ui| {
            ui.horizontal_wrapped(|ui| {
                if nth == 0 {
                    changed |= fields::hands(ui, seen, &mut it.hand, true);
                }
                if several {
                    ui.weak(format!("{}.", nth + 1));
                }
                changed |= choice(ui, seen, at.id.with(nth), value);
                if several
                    && ui
                        .small_button("×")
                        .on_hover_text(seen.say(words::REMOVE))
                        .clicked()
                {
                    gone = Some(nth);
                }
            });
        });
    }
    if let Some(nth) = gone {
        it.values.remove(nth);
        changed = true;
    }
    if !at.whole {
        return changed | transition(ui, seen, at, &mut it.via);
    }
    ui.horizontal_wrapped(|ui| {
        let more = ui.small_button(seen.say(words::ANOTHER_SHAPE));
        if more
            .on_hover_text(seen.say(words::ANOTHER_SHAPE_TIP))
            .clicked()
        {
            it.values.push(Choice::Keep);
            changed = true;
        }
    });
    changed | transition(ui, seen, at, &mut it.via)
}

#[derive(Clone, Copy, PartialEq)]
enum GoalKind {
    By,
    At,
    Point,
    Near,
}

fn place(ui: &mut Ui, seen: &Seen<'_>, at: At, it: &mut Place) -> bool {
    let mut kind = match it.to {
        Goal::By(_) => GoalKind::By,
        Goal::At(_) | Goal::Best(_) => GoalKind::At,
        Goal::AtPoint(_) => GoalKind::Point,
        Goal::Near { .. } => GoalKind::Near,
    };
    let all = [
        (GoalKind::By, seen.say(words::GOAL_BY)),
        (GoalKind::At, seen.say(words::SPOT_VALUE)),
        (GoalKind::Point, seen.say(words::SPOT_POINT)),
        (GoalKind::Near, seen.say(words::GOAL_NEAR)),
    ];
    let mut changed = false;
    ui.horizontal_wrapped(|ui| {
        changed |= fields::hands(ui, seen, &mut it.hand, true);
        if choose(ui, seen.say(words::WHERE_TO), &mut kind, &all) {
            it.to = match kind {
                GoalKind::By => Goal::By(path::legs_of([0.0, 0.1, 0.0])),
                GoalKind::At => Goal::At(String::new()),
                GoalKind::Point => Goal::AtPoint([0.0, 1.2, 0.4].map(Length::Metres)),
                GoalKind::Near => Goal::Near {
                    of: String::new(),
                    by: Vec::new(),
                },
            };
            changed = true;
        }
    });
    match &mut it.to {
        Goal::By(legs) => changed |= path::offset(ui, seen, legs),
        Goal::At(text) => {
            changed |= fields::of_inventory(ui, seen, at.id, Component::Placement, text);
        }
        Goal::AtPoint(point) => changed |= fields::point(ui, seen, point),
        Goal::Near { of, by } => {
            changed |= fields::sign(ui, seen, at.id, seen.say(words::FROM_SIGN), of);
            changed |= path::offset(ui, seen, by);
        }
        Goal::Best(_) => {}
    }
    if matches!(it.to, Goal::By(_)) || !(at.whole || it.with.is_some()) {
        return changed;
    }
    ui.horizontal_wrapped(|ui| {
        caption(ui, seen, words::WITH);
        let points = [
            (None, words::PALM),
            (Some(HandPoint::Wrist), words::WRIST),
            (Some(HandPoint::Thumb), words::THUMB),
            (Some(HandPoint::Index), words::INDEX),
            (Some(HandPoint::Middle), words::MIDDLE),
            (Some(HandPoint::Ring), words::RING),
            (Some(HandPoint::Little), words::LITTLE),
        ];
        let points = points.map(|(point, text)| (point, seen.say(text)));
        let mut with = it.with.filter(|it| *it != HandPoint::Palm);
        if choose(ui, seen.say(words::WITH), &mut with, &points) {
            it.with = with;
            changed = true;
        }
    });
    changed
}

fn repeat(ui: &mut Ui, seen: &Seen<'_>, at: At, it: &mut Repeat) -> bool {
    let mut changed = false;
    ui.horizontal_wrapped(|ui| {
        let mut times = f64::from(it.times);
        let drag = DragValue::new(&mut times)
            .range(1.0..=20.0)
            .speed(0.05)
            .max_decimals(0)
            .suffix("×");
        let response = ui.add(drag);
        response.widget_info(|| WidgetInfo::slider(true, times, seen.say(words::TIMES)));
        if response.changed() {
            it.times = times.round().clamp(1.0, 1000.0) as u32;
            changed = true;
        }
        changed |= fields::factor(ui, seen, words::SMALLER, &mut it.scale, 0.8);
        changed |= fields::factor(ui, seen, words::FASTER, &mut it.tempo, 1.2);
        changed |= fields::time(ui, seen, words::GAP, &mut it.gap, 0.1);
    });
    changed | transition(ui, seen, at, &mut it.via)
}

fn orient(ui: &mut Ui, seen: &Seen<'_>, it: &mut Orient) -> bool {
    let mut changed = false;
    ui.horizontal_wrapped(|ui| changed |= fields::hands(ui, seen, &mut it.hand, true));
    for (text, value) in [
        (words::PALM, &mut it.palm),
        (words::FINGERS, &mut it.fingers),
    ] {
        caption(ui, seen, text);
        changed |= ui
            .push_id(text.en, |ui| {
                fields::directions(ui, seen, seen.say(text), value)
            })
            .inner;
    }
    let mut gone = None;
    for (at, turn) in it.by.iter_mut().enumerate() {
        ui.push_id(at, |ui| {
            ui.horizontal_wrapped(|ui| {
                let Degrees(angle) = &mut turn.angle;
                changed |= fields::slide(ui, seen.say(words::TURN), angle, -180.0..=180.0, "°");
                caption(ui, seen, words::ABOUT);
                let all = Direction::ALL.map(|it| (it, seen.say(fields::direction_text(it))));
                changed |= choose(ui, seen.say(words::ABOUT), &mut turn.about, &all);
                if ui
                    .small_button("×")
                    .on_hover_text(seen.say(words::REMOVE))
                    .clicked()
                {
                    gone = Some(at);
                }
            });
        });
    }
    if let Some(at) = gone {
        it.by.remove(at);
        changed = true;
    }
    if ui.small_button(seen.say(words::ADD_TURN)).clicked() {
        let (angle, about) = (Degrees(30.0), Direction::Up);
        it.by.push(Turn { angle, about });
        changed = true;
    }
    changed
}

fn retime(ui: &mut Ui, seen: &Seen<'_>, it: &mut Retime) -> bool {
    let mut changed = false;
    let mut gone = None;
    let several = it.paces.len() > 1;
    let kinds = [
        (false, seen.say(words::PACE_TIMES)),
        (true, seen.say(words::PACE_TO)),
    ];
    for (at, pace) in it.paces.iter_mut().enumerate() {
        ui.push_id(at, |ui| {
            ui.horizontal_wrapped(|ui| {
                if several {
                    ui.weak(format!("{}.", at + 1));
                }
                let mut to = matches!(pace, Pace::To(_));
                if choose(ui, seen.say(words::PACE), &mut to, &kinds) {
                    *pace = if to {
                        Pace::To(Seconds(1.0))
                    } else {
                        Pace::Times(Factor(1.5))
                    };
                    changed = true;
                }
                let name = seen.say(words::PACE);
                changed |= match pace {
                    Pace::Times(Factor(by)) => fields::slide(ui, name, by, 0.25..=4.0, "×"),
                    Pace::To(Seconds(to)) => fields::slide(ui, name, to, 0.1..=5.0, " s"),
                };
                if several
                    && ui
                        .small_button("×")
                        .on_hover_text(seen.say(words::REMOVE))
                        .clicked()
                {
                    gone = Some(at);
                }
            });
        });
    }
    if let Some(at) = gone {
        it.paces.remove(at);
        changed = true;
    }
    let more = ui.small_button(seen.say(words::ANOTHER_PHASE));
    if more
        .on_hover_text(seen.say(words::ANOTHER_PHASE_TIP))
        .clicked()
    {
        it.paces.push(Pace::Times(Factor(1.0)));
        changed = true;
    }
    changed
}

fn indicate(ui: &mut Ui, seen: &Seen<'_>, at: At, it: &mut Indicate) -> bool {
    let mut changed = false;
    ui.horizontal_wrapped(|ui| changed |= fields::hands(ui, seen, &mut it.hand, true));
    for (text, value) in [
        (words::SPOT_FROM, &mut it.from),
        (words::SPOT_TO, &mut it.to),
    ] {
        ui.push_id(text.en, |ui| {
            ui.horizontal_wrapped(|ui| {
                let mut said = value.is_some();
                if ui.checkbox(&mut said, seen.say(text)).changed() {
                    *value = said.then_some(Spot::Me);
                    changed = true;
                }
                if let Some(spot) = value {
                    changed |= fields::spot(ui, seen, at.id.with(text.en), seen.say(text), spot);
                }
            });
        });
    }
    changed
}
