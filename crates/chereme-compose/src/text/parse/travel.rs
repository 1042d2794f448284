//! The way of `travel`: legs, or points of a curve.

use super::*;

impl Parser<'_> {
    pub(super) fn travel(&mut self) -> Parsed<Travel> {
        let a_hand = !self.is_length(self.at + 1);
        let hand = if a_hand { self.hand() } else { None };
        let curved = self.accept("through");
        let (path, through) = if curved {
            (Vec::new(), self.points()?)
        } else {
            (self.legs(true)?, Vec::new())
        };
        let time = if curved && self.accept("in") {
            Some(self.quantity("a time, such as 0.4s")?)
        } else {
            None
        };
        let via = self.via()?.unwrap_or_default();
        Ok(Travel {
            hand: hand.unwrap_or(Hands::Dominant),
            path,
            through,
            time,
            via,
        })
    }

    /// Reads the points of a curve, with `then` between them.
    fn points(&mut self) -> Parsed<Vec<[Length; 3]>> {
        const WANTED: &str = "a point: left, up and forward, such as 10cm,5cm,0cm";
        let mut points = Vec::new();
        loop {
            let point = self.spot_point()?;
            points.push(point.ok_or_else(|| self.expected(WANTED, &[]))?);
            if self.word() != Some("then") || !self.is_point(self.at + 1) {
                return Ok(points);
            }
            self.at += 1;
        }
    }

    /// Returns whether a length with a comma after it stands there.
    fn is_point(&self, at: usize) -> bool {
        let comma = |at: usize| self.tokens.get(at).is_some_and(|it| it.kind == Kind::Comma);
        self.is_length(at) && (comma(at + 1) || comma(at + 2))
    }
}
