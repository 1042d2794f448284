//! Prints the tree as symbols.
//!
//! The tree is printed in one canonical order; a part that remembers another spelling from text
//! ([`WrittenSymbols`]) prints that spelling.

mod print_motion;
mod print_place;

use super::direction::{CompassDirection, SpatialDirection};
use super::parse;
use super::symbol::{BracketKind, HamnosysSymbol, SymbolKind};
use super::tree::{
    BodyAction, CeeOpening, DirectionAim, DirectionFrame, EachHand, FingerBend, HamnosysSign, HandDigit, HandSymmetry,
    HandsUsed, Handshape, HandshapeForm, ManualPart, MotionSize, NotatedPosture, ThumbExtra, ThumbPosition,
    WrittenSymbols,
};

/// A sign as text, and the parts that the text does not express.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PrintedSign {
    /// The text, one character per symbol.
    pub text: String,
    /// The parts of the tree that are missing from the text.
    pub losses: Vec<NotationLoss>,
}

/// A part without symbols in HamNoSys.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotationLoss {
    /// The index of the part of the sign, from 0.
    pub part: usize,
    /// A description of the part, and of its replacement in the text.
    pub message: String,
}

/// Writes a sign as HamNoSys.
///
/// The text reads back as an equal tree, or `losses` lists the differences.
#[must_use]
pub fn print_hamnosys(sign: &HamnosysSign) -> PrintedSign {
    let mut out = HamnosysWriter::default();
    out.write_hamnosys_sign(sign);
    let same = |text: &str| parse::parse_hamnosys(text).is_ok_and(|read| read.sign == *sign);
    if out.losses.is_empty() && !same(&out.text) {
        out.report_notation_loss("HamNoSys groups this differently: the text reads back as another tree");
    }
    PrintedSign {
        text: out.text,
        losses: out.losses,
    }
}

/// Returns the text of a sign, ignoring losses.
#[must_use]
pub fn sign_hamnosys_text(sign: &HamnosysSign) -> String {
    let mut out = HamnosysWriter::default();
    out.write_hamnosys_sign(sign);
    out.text
}

#[derive(Default)]
pub(super) struct HamnosysWriter {
    pub(super) text: String,
    losses: Vec<NotationLoss>,
    part: usize,
}

impl HamnosysWriter {
    fn write_hamnosys_sign(&mut self, sign: &HamnosysSign) {
        self.text.reserve(96);
        for (index, part) in sign.parts.iter().enumerate() {
            self.part = index;
            self.write_manual_part(part, index > 0);
        }
        if sign.parts.is_empty() {
            self.report_notation_loss("a sign without any part has no text");
        }
    }

    pub(super) fn write_manual_part(&mut self, part: &ManualPart, separator: bool) {
        if self.write_kept_symbols(&part.written) {
            return;
        }
        if separator {
            self.symbol(SymbolKind::Plus);
        }
        match part.hands {
            HandsUsed::Dominant => {}
            HandsUsed::Nondominant => self.symbol(SymbolKind::Nondominant),
            HandsUsed::Both(symmetry) => self.symmetry(symmetry),
        }
        if part.holdover {
            self.report_notation_loss("that the hands keep what they had has no symbol; it is left out");
        }
        for action in &part.body {
            self.write_body_action(action);
        }
        self.write_hand_posture(&part.posture);
        for motion in &part.actions {
            self.write_motion(motion);
        }
    }

    fn symmetry(&mut self, symmetry: HandSymmetry) {
        self.symbol(SymbolKind::Symmetry {
            left_right: symmetry.left_right,
        });
        let marks = [
            (symmetry.out_in, SymbolKind::Bend(FingerBend::Bent)),
            (symmetry.up_down, SymbolKind::Size(MotionSize::Big)),
            (symmetry.out_of_phase, SymbolKind::Alternating),
            (symmetry.real_space, SymbolKind::RealSpace),
        ];
        for (there, mark) in marks {
            if there {
                self.symbol(mark);
            }
        }
    }

    fn write_body_action(&mut self, action: &BodyAction) {
        self.write_body_site(&super::tree::SidedLocation {
            at: action.part,
            side: action.side,
            approx: false,
        });
        if let Some(motion) = &action.motion {
            self.write_motion(motion);
        }
    }

    pub(super) fn write_hand_posture(&mut self, posture: &NotatedPosture) {
        let mut one = PrintedHandHalf::default();
        let mut two = PrintedHandHalf::default();
        let mut open = false;
        match &posture.shape {
            EachHand::Unset => {}
            EachHand::Shared(shape) => self.write_handshape(shape),
            EachHand::Split(a, b) => {
                open = true;
                (one.shape, two.shape) = (a.as_ref(), b.as_ref());
            }
        }
        match &posture.extended {
            EachHand::Unset => {}
            EachHand::Shared(aim) => {
                self.write_split_halves(&mut one, &mut two, &mut open);
                self.write_extended_direction(aim);
            }
            EachHand::Split(a, b) => {
                open = true;
                (one.extended, two.extended) = (a.as_ref(), b.as_ref());
            }
        }
        match &posture.palm {
            EachHand::Unset => {}
            EachHand::Shared(aim) => {
                self.write_split_halves(&mut one, &mut two, &mut open);
                self.write_palm_direction(aim);
            }
            EachHand::Split(a, b) => {
                open = true;
                (one.palm, two.palm) = (a.as_ref(), b.as_ref());
            }
        }
        self.write_split_halves(&mut one, &mut two, &mut open);
        if let Some(place) = &posture.place {
            self.write_hand_place(place);
        }
    }

    /// Writes the parts collected for each hand, in one bracket.
    fn write_split_halves<'a>(
        &mut self,
        one: &mut PrintedHandHalf<'a>,
        two: &mut PrintedHandHalf<'a>,
        open: &mut bool,
    ) {
        if !std::mem::take(open) {
            return;
        }
        self.symbol(SymbolKind::Open(BracketKind::Par));
        self.write_split_half(&std::mem::take(one));
        self.symbol(SymbolKind::Plus);
        self.write_split_half(&std::mem::take(two));
        self.symbol(SymbolKind::Close(BracketKind::Par));
    }

    fn write_split_half(&mut self, half: &PrintedHandHalf<'_>) {
        if let Some(shape) = half.shape {
            self.write_handshape(shape);
        }
        if let Some(aim) = half.extended {
            self.write_extended_direction(aim);
        }
        if let Some(aim) = half.palm {
            self.write_palm_direction(aim);
        }
    }

    fn write_extended_direction(&mut self, aim: &DirectionAim<SpatialDirection>) {
        self.write_direction(aim.first);
        if let Some(second) = aim.second {
            self.symbol(SymbolKind::Between);
            self.write_direction(second);
        }
        self.aim_marks(aim);
    }

    fn write_direction(&mut self, direction: SpatialDirection) {
        match direction.corner_parts() {
            None => self.symbol(SymbolKind::Extended(direction)),
            Some((one, two)) => {
                self.symbol(SymbolKind::Extended(one));
                self.symbol(SymbolKind::Extended(two));
            }
        }
    }

    fn write_palm_direction(&mut self, aim: &DirectionAim<CompassDirection>) {
        self.symbol(SymbolKind::Palm(aim.first));
        if let Some(second) = aim.second {
            self.symbol(SymbolKind::Between);
            self.symbol(SymbolKind::Palm(second));
        }
        self.aim_marks(aim);
    }

    fn aim_marks<D>(&mut self, aim: &DirectionAim<D>) {
        if aim.approx {
            self.symbol(SymbolKind::Approx);
        }
        match aim.frame {
            DirectionFrame::Plain => {}
            DirectionFrame::Relative => self.symbol(SymbolKind::Relative),
            DirectionFrame::Absolute => {
                self.report_notation_loss("that a direction is absolute has no symbol; it is left out");
            }
        }
    }

    pub(super) fn write_handshape(&mut self, shape: &Handshape) {
        if self.write_kept_symbols(&shape.written) {
            return;
        }
        self.write_hand_form(&shape.form);
        if let Some(second) = &shape.between {
            self.symbol(SymbolKind::Between);
            self.write_hand_form(second);
        }
        if shape.approx {
            self.symbol(SymbolKind::Approx);
        }
        if shape.splay.is_some() {
            self.report_notation_loss("how far fingers are spread has no symbol; it is left to the class");
        }
        self.write_handshape_fingers(shape);
        for (digit, bend) in HandDigit::ALL_HAND_DIGITS.into_iter().zip(shape.bends) {
            if let Some(bend) = bend {
                self.symbol(SymbolKind::Digit(digit));
                self.write_finger_bend(bend);
            }
        }
        for contact in &shape.contacts {
            self.symbol(SymbolKind::Digit(contact.first));
            match contact.part {
                Some(part) => self.symbol(SymbolKind::Part(part)),
                None => self.symbol(SymbolKind::Contact(super::tree::PlaceContact::Cross)),
            }
            self.symbol(SymbolKind::Digit(contact.second));
        }
        match shape.thumb {
            None => {}
            Some(ThumbExtra::Between(one, two)) => {
                self.symbol(SymbolKind::Between);
                self.symbol(SymbolKind::Digit(one));
                self.symbol(SymbolKind::Digit(two));
            }
            Some(ThumbExtra::Enclosed) => self.symbol(SymbolKind::Between),
            Some(ThumbExtra::Contact(part)) => self.symbol(SymbolKind::Part(part)),
        }
    }

    fn write_handshape_fingers(&mut self, shape: &Handshape) {
        let mut written = [false; 5];
        let listed = shape.exempt.0.iter().chain(&shape.special.0);
        for digit in listed.chain(&shape.opposed) {
            if std::mem::replace(&mut written[*digit as usize], true) {
                continue;
            }
            self.symbol(SymbolKind::Digit(*digit));
            if shape.opposed == Some(*digit) {
                self.symbol(SymbolKind::Size(MotionSize::Big));
            }
        }
    }

    fn write_hand_form(&mut self, form: &HandshapeForm) {
        self.symbol(SymbolKind::Base(form.class));
        if let Some(thumb) = form.thumb {
            self.symbol(SymbolKind::Thumb(thumb));
        }
        match form.opening {
            None => {}
            Some(CeeOpening::Tight) => self.symbol(SymbolKind::Thumb(ThumbPosition::Across)),
            Some(CeeOpening::Slack) => self.symbol(SymbolKind::Thumb(ThumbPosition::Opposed)),
        }
        if let Some(bend) = form.bend {
            self.write_finger_bend(bend);
        }
    }

    /// Writes a bend, or two bends with this one half-way between; if neither is possible, the nearest bend.
    fn write_finger_bend(&mut self, bend: FingerBend) {
        if !matches!(bend, FingerBend::HalfBent | FingerBend::Joints(_)) {
            return self.symbol(SymbolKind::Bend(bend));
        }
        let joints = bend.joint_bends();
        let middle = |one: FingerBend, two: FingerBend| {
            let (a, b) = (one.joint_bends(), two.joint_bends());
            (0..3).all(|joint| ((a[joint] + b[joint]) / 2.0).floor() == joints[joint])
        };
        let pairs = SYMBOL_BENDS
            .iter()
            .enumerate()
            .flat_map(|(index, one)| SYMBOL_BENDS[index..].iter().map(move |two| (*one, *two)));
        if let FingerBend::Joints(_) = bend
            && let Some((one, two)) = pairs.into_iter().find(|(one, two)| middle(*one, *two))
        {
            self.symbol(SymbolKind::Bend(one));
            self.symbol(SymbolKind::Between);
            return self.symbol(SymbolKind::Bend(two));
        }
        let gap = |other: &FingerBend| {
            let other_joints = other.joint_bends();
            (0..3)
                .map(|joint| (other_joints[joint] - joints[joint]).powi(2))
                .sum::<f64>()
        };
        let nearest = SYMBOL_BENDS.into_iter().min_by(|a, b| gap(a).total_cmp(&gap(b)));
        self.report_notation_loss("the bend has no symbol; the nearest one stands for it");
        self.symbol(SymbolKind::Bend(nearest.unwrap_or(FingerBend::Bent)));
    }

    fn write_kept_symbols(&mut self, written: &WrittenSymbols) -> bool {
        if let Some(text) = &written.0 {
            self.text.push_str(text);
        }
        written.0.is_some()
    }

    fn symbol(&mut self, kind: SymbolKind) {
        match HamnosysSymbol::from_symbol_kind(kind) {
            Some(symbol) => self.text.push(symbol.symbol_char()),
            None => self.report_notation_loss("a value has no symbol of its own; it is left out"),
        }
    }

    pub(super) fn report_notation_loss(&mut self, message: &str) {
        let loss = NotationLoss {
            part: self.part,
            message: message.to_owned(),
        };
        if !self.losses.contains(&loss) {
            self.losses.push(loss);
        }
    }
}

/// The bends that have a symbol.
const SYMBOL_BENDS: [FingerBend; 5] = [
    FingerBend::Bent,
    FingerBend::Round,
    FingerBend::Hooked,
    FingerBend::DoubleBent,
    FingerBend::DoubleHooked,
];

/// The configuration of one hand.
#[derive(Default)]
struct PrintedHandHalf<'a> {
    shape: Option<&'a Handshape>,
    extended: Option<&'a DirectionAim<SpatialDirection>>,
    palm: Option<&'a DirectionAim<CompassDirection>>,
}
