//! Reads `nonmanual wh from recording:3 over 0.4s..1.9s by phases`, and parts of movement such as `0.4s..1.9s`.

use super::*;

impl Parser<'_> {
    pub(super) fn nonmanual(&mut self) -> Parsed<Nonmanual> {
        let function = match self.word() {
            Some("from") => None,
            _ => Some(self.name("\"from\" and a sign")?),
        };
        self.expect("from", "\"from\" and a sign")?;
        let from = self.name("a sign")?;
        let over = self.accept("over").then(|| self.over()).transpose()?;
        let by_phases = self.accept("by");
        if by_phases {
            self.expect("phases", "\"phases\"")?;
        }
        Ok(Nonmanual {
            from,
            function,
            over,
            by_phases,
        })
    }

    /// Reads a part of a movement, or the five milestones of an expression.
    fn over(&mut self) -> Parsed<Over> {
        const WANTED: &str = "a part such as 0.4s..1.9s, or five times with commas between";
        let start = self.at;
        let mut times = Vec::new();
        while times.len() < 5 {
            let Ok(time) = self.quantity(WANTED) else {
                break;
            };
            times.push(time);
            if times.len() < 5 && !self.accept_kind(Kind::Comma) {
                break;
            }
        }
        if let Ok(times) = times.try_into() {
            return Ok(Over::At(times));
        }
        self.at = start;
        self.cut().map(Over::Part)
    }

    /// Reads two times with two dots between; one of them may be missing.
    pub(super) fn cut(&mut self) -> Parsed<Cut> {
        const WANTED: &str = "two times with two dots between, such as 0.4s..1.9s";
        let start = self.at;
        let mut text = String::new();
        while let Some(word) = self.word().filter(|word| !["then", "by"].contains(word)) {
            text.push_str(word);
            self.at += 1;
        }
        let Some((from, to)) = text.split_once("..").filter(|_| text != "..") else {
            self.at = start;
            return Err(self.expected(WANTED, &[]));
        };
        let time = |text: &str| match text {
            "" => Ok(None),
            text => text.parse().map(Some),
        };
        let times = time(from).and_then(|from| Ok((from, time(to)?)));
        let (from, to) = times.map_err(|error: UnitError| {
            self.at = start;
            self.fault(Problem::Unit(error))
        })?;
        Ok(Cut { from, to })
    }
}
