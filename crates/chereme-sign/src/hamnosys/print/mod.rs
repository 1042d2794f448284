//! Prints the tree as symbols.
//!
//! The tree is printed in one canonical order; a part that remembers another spelling from text
//! ([`Written`]) prints that spelling.

mod motion;
mod place;

use super::direction::{Compass, Direction};
use super::parse;
use super::symbol::{Bracket, Kind, Symbol};
use super::tree::{
    Aim, Bend, BodyAction, Digit, Each, Form, Frame, HandsUsed, Handshape, Manual, Opening,
    Posture, Sign, Size, Symmetry, ThumbExtra, ThumbPosition, Written,
};

/// A sign as text, and the parts that the text does not express.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Printed {
    /// The text, one character per symbol.
    pub text: String,
    /// The parts of the tree that are missing from the text.
    pub losses: Vec<Loss>,
}

/// A part without symbols in HamNoSys.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loss {
    /// The index of the part of the sign, from 0.
    pub part: usize,
    /// A description of the part, and of its replacement in the text.
    pub message: String,
}

/// Writes a sign as HamNoSys.
///
/// The text reads back as an equal tree, or `losses` lists the differences.
#[must_use]
pub fn print(sign: &Sign) -> Printed {
    let mut out = Write::default();
    out.sign(sign);
    let same = |text: &str| parse::parse(text).is_ok_and(|read| read.sign == *sign);
    if out.losses.is_empty() && !same(&out.text) {
        out.lose("HamNoSys groups this differently: the text reads back as another tree");
    }
    Printed {
        text: out.text,
        losses: out.losses,
    }
}

/// Returns the text of a sign, ignoring losses.
#[must_use]
pub fn text_of(sign: &Sign) -> String {
    let mut out = Write::default();
    out.sign(sign);
    out.text
}

#[derive(Default)]
pub(super) struct Write {
    pub(super) text: String,
    losses: Vec<Loss>,
    part: usize,
}

impl Write {
    fn sign(&mut self, sign: &Sign) {
        self.text.reserve(96);
        for (index, part) in sign.parts.iter().enumerate() {
            self.part = index;
            self.manual(part, index > 0);
        }
        if sign.parts.is_empty() {
            self.lose("a sign without any part has no text");
        }
    }

    pub(super) fn manual(&mut self, part: &Manual, separator: bool) {
        if self.written(&part.written) {
            return;
        }
        if separator {
            self.symbol(Kind::Plus);
        }
        match part.hands {
            HandsUsed::Dominant => {}
            HandsUsed::Nondominant => self.symbol(Kind::Nondominant),
            HandsUsed::Both(symmetry) => self.symmetry(symmetry),
        }
        if part.holdover {
            self.lose("that the hands keep what they had has no symbol; it is left out");
        }
        for action in &part.body {
            self.body_action(action);
        }
        self.posture(&part.posture);
        for motion in &part.actions {
            self.motion(motion);
        }
    }

    fn symmetry(&mut self, symmetry: Symmetry) {
        self.symbol(Kind::Symmetry {
            left_right: symmetry.left_right,
        });
        let marks = [
            (symmetry.out_in, Kind::Bend(Bend::Bent)),
            (symmetry.up_down, Kind::Size(Size::Big)),
            (symmetry.out_of_phase, Kind::Alternating),
            (symmetry.real_space, Kind::RealSpace),
        ];
        for (there, mark) in marks {
            if there {
                self.symbol(mark);
            }
        }
    }

    fn body_action(&mut self, action: &BodyAction) {
        self.body_site(&super::tree::Site {
            at: action.part,
            side: action.side,
            approx: false,
        });
        if let Some(motion) = &action.motion {
            self.motion(motion);
        }
    }

    pub(super) fn posture(&mut self, posture: &Posture) {
        let mut one = Half::default();
        let mut two = Half::default();
        let mut open = false;
        match &posture.shape {
            Each::Unset => {}
            Each::Shared(shape) => self.handshape(shape),
            Each::Split(a, b) => {
                open = true;
                (one.shape, two.shape) = (a.as_ref(), b.as_ref());
            }
        }
        match &posture.extended {
            Each::Unset => {}
            Each::Shared(aim) => {
                self.halves(&mut one, &mut two, &mut open);
                self.extended(aim);
            }
            Each::Split(a, b) => {
                open = true;
                (one.extended, two.extended) = (a.as_ref(), b.as_ref());
            }
        }
        match &posture.palm {
            Each::Unset => {}
            Each::Shared(aim) => {
                self.halves(&mut one, &mut two, &mut open);
                self.palm(aim);
            }
            Each::Split(a, b) => {
                open = true;
                (one.palm, two.palm) = (a.as_ref(), b.as_ref());
            }
        }
        self.halves(&mut one, &mut two, &mut open);
        if let Some(place) = &posture.place {
            self.place(place);
        }
    }

    /// Writes the parts collected for each hand, in one bracket.
    fn halves<'a>(&mut self, one: &mut Half<'a>, two: &mut Half<'a>, open: &mut bool) {
        if !std::mem::take(open) {
            return;
        }
        self.symbol(Kind::Open(Bracket::Par));
        self.half(&std::mem::take(one));
        self.symbol(Kind::Plus);
        self.half(&std::mem::take(two));
        self.symbol(Kind::Close(Bracket::Par));
    }

    fn half(&mut self, half: &Half<'_>) {
        if let Some(shape) = half.shape {
            self.handshape(shape);
        }
        if let Some(aim) = half.extended {
            self.extended(aim);
        }
        if let Some(aim) = half.palm {
            self.palm(aim);
        }
    }

    fn extended(&mut self, aim: &Aim<Direction>) {
        self.direction(aim.first);
        if let Some(second) = aim.second {
            self.symbol(Kind::Between);
            self.direction(second);
        }
        self.aim_marks(aim);
    }

    fn direction(&mut self, direction: Direction) {
        match direction.corner_parts() {
            None => self.symbol(Kind::Extended(direction)),
            Some((one, two)) => {
                self.symbol(Kind::Extended(one));
                self.symbol(Kind::Extended(two));
            }
        }
    }

    fn palm(&mut self, aim: &Aim<Compass>) {
        self.symbol(Kind::Palm(aim.first));
        if let Some(second) = aim.second {
            self.symbol(Kind::Between);
            self.symbol(Kind::Palm(second));
        }
        self.aim_marks(aim);
    }

    fn aim_marks<D>(&mut self, aim: &Aim<D>) {
        if aim.approx {
            self.symbol(Kind::Approx);
        }
        match aim.frame {
            Frame::Plain => {}
            Frame::Relative => self.symbol(Kind::Relative),
            Frame::Absolute => {
                self.lose("that a direction is absolute has no symbol; it is left out");
            }
        }
    }

    pub(super) fn handshape(&mut self, shape: &Handshape) {
        if self.written(&shape.written) {
            return;
        }
        self.form(&shape.form);
        if let Some(second) = &shape.between {
            self.symbol(Kind::Between);
            self.form(second);
        }
        if shape.approx {
            self.symbol(Kind::Approx);
        }
        if shape.splay.is_some() {
            self.lose("how far fingers are spread has no symbol; it is left to the class");
        }
        self.fingers(shape);
        for (digit, bend) in Digit::ALL.into_iter().zip(shape.bends) {
            if let Some(bend) = bend {
                self.symbol(Kind::Digit(digit));
                self.bend(bend);
            }
        }
        for contact in &shape.contacts {
            self.symbol(Kind::Digit(contact.first));
            match contact.part {
                Some(part) => self.symbol(Kind::Part(part)),
                None => self.symbol(Kind::Contact(super::tree::Contact::Cross)),
            }
            self.symbol(Kind::Digit(contact.second));
        }
        match shape.thumb {
            None => {}
            Some(ThumbExtra::Between(one, two)) => {
                self.symbol(Kind::Between);
                self.symbol(Kind::Digit(one));
                self.symbol(Kind::Digit(two));
            }
            Some(ThumbExtra::Enclosed) => self.symbol(Kind::Between),
            Some(ThumbExtra::Contact(part)) => self.symbol(Kind::Part(part)),
        }
    }

    fn fingers(&mut self, shape: &Handshape) {
        let mut written = [false; 5];
        let listed = shape.exempt.0.iter().chain(&shape.special.0);
        for digit in listed.chain(&shape.opposed) {
            if std::mem::replace(&mut written[*digit as usize], true) {
                continue;
            }
            self.symbol(Kind::Digit(*digit));
            if shape.opposed == Some(*digit) {
                self.symbol(Kind::Size(Size::Big));
            }
        }
    }

    fn form(&mut self, form: &Form) {
        self.symbol(Kind::Base(form.class));
        if let Some(thumb) = form.thumb {
            self.symbol(Kind::Thumb(thumb));
        }
        match form.opening {
            None => {}
            Some(Opening::Tight) => self.symbol(Kind::Thumb(ThumbPosition::Across)),
            Some(Opening::Slack) => self.symbol(Kind::Thumb(ThumbPosition::Opposed)),
        }
        if let Some(bend) = form.bend {
            self.bend(bend);
        }
    }

    /// Writes a bend, or two bends with this one half-way between; if neither is possible, the nearest bend.
    fn bend(&mut self, bend: Bend) {
        if !matches!(bend, Bend::HalfBent | Bend::Joints(_)) {
            return self.symbol(Kind::Bend(bend));
        }
        let joints = bend.joints();
        let middle = |one: Bend, two: Bend| {
            let (a, b) = (one.joints(), two.joints());
            (0..3).all(|joint| ((a[joint] + b[joint]) / 2.0).floor() == joints[joint])
        };
        let pairs = BENDS
            .iter()
            .enumerate()
            .flat_map(|(index, one)| BENDS[index..].iter().map(move |two| (*one, *two)));
        if let Bend::Joints(_) = bend
            && let Some((one, two)) = pairs.into_iter().find(|(one, two)| middle(*one, *two))
        {
            self.symbol(Kind::Bend(one));
            self.symbol(Kind::Between);
            return self.symbol(Kind::Bend(two));
        }
        let gap = |other: &Bend| {
            let own = other.joints();
            (0..3)
                .map(|joint| (own[joint] - joints[joint]).powi(2))
                .sum::<f64>()
        };
        let nearest = BENDS.into_iter().min_by(|a, b| gap(a).total_cmp(&gap(b)));
        self.lose("the bend has no symbol; the nearest one stands for it");
        self.symbol(Kind::Bend(nearest.unwrap_or(Bend::Bent)));
    }

    fn written(&mut self, written: &Written) -> bool {
        if let Some(text) = &written.0 {
            self.text.push_str(text);
        }
        written.0.is_some()
    }

    fn symbol(&mut self, kind: Kind) {
        match Symbol::of(kind) {
            Some(symbol) => self.text.push(symbol.char()),
            None => self.lose("a value has no symbol of its own; it is left out"),
        }
    }

    pub(super) fn lose(&mut self, message: &str) {
        let loss = Loss {
            part: self.part,
            message: message.to_owned(),
        };
        if !self.losses.contains(&loss) {
            self.losses.push(loss);
        }
    }
}

/// The bends that have a symbol.
const BENDS: [Bend; 5] = [
    Bend::Bent,
    Bend::Round,
    Bend::Hooked,
    Bend::DoubleBent,
    Bend::DoubleHooked,
];

/// The configuration of one hand.
#[derive(Default)]
struct Half<'a> {
    shape: Option<&'a Handshape>,
    extended: Option<&'a Aim<Direction>>,
    palm: Option<&'a Aim<Compass>>,
}
