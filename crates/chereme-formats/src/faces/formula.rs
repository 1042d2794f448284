//! Formulas over channels, as the mappings of face systems write them.
//!
//! `0.5*BrowInnerUp - max(A, B)`: numbers, names of channels, `+ - * /`, brackets, and the functions `mean`, `max`,
//! `min`, `clamp(x, low, high)`, `atan2(y, x)` and `first(a, b, …)`, the first argument whose channels exist.

/// A formula.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Formula {
    Number(f64),
    Channel(String),
    Negative(Box<Self>),
    Both(char, Box<[Self; 2]>),
    Call(Function, Vec<Self>),
}

/// A function of a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Function {
    Mean,
    Max,
    Min,
    Clamp,
    Atan2,
    First,
}

impl Function {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "mean" => Self::Mean,
            "max" => Self::Max,
            "min" => Self::Min,
            "clamp" => Self::Clamp,
            "atan2" => Self::Atan2,
            "first" => Self::First,
            _ => return None,
        })
    }

    fn takes(self, count: usize) -> bool {
        match self {
            Self::Clamp => count == 3,
            Self::Atan2 => count == 2,
            Self::Mean | Self::Max | Self::Min | Self::First => count > 0,
        }
    }
}

/// The deepest nesting of brackets.
const DEEPEST: usize = 32;

impl Formula {
    /// Reads a formula. The error names the fault.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let mut reader = Reader { rest: text.trim() };
        let formula = reader.sum(0)?;
        match reader.rest {
            "" => Ok(formula),
            rest => Err(format!("{rest:?} does not belong there")),
        }
    }

    /// Returns the formula's values for all frames; `None` if a channel that it needs is missing.
    pub(super) fn values<'a>(
        &self,
        frames: usize,
        channel: &dyn Fn(&str) -> Option<&'a [f64]>,
    ) -> Option<Vec<f64>> {
        let of = |formula: &Self| formula.values(frames, channel);
        Some(match self {
            Self::Number(number) => vec![*number; frames],
            Self::Channel(name) => channel(name)?.to_vec(),
            Self::Negative(inner) => of(inner)?.into_iter().map(|value| -value).collect(),
            Self::Both(sign, sides) => {
                let (a, b) = (of(&sides[0])?, of(&sides[1])?);
                let pairs = a.into_iter().zip(b);
                let value = |(a, b): (f64, f64)| match sign {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    _ => a / b,
                };
                pairs.map(value).collect()
            }
            Self::Call(Function::First, inner) => inner.iter().find_map(of)?,
            Self::Call(function, inner) => {
                let all: Vec<Vec<f64>> = inner.iter().map(of).collect::<Option<_>>()?;
                let row = |frame: usize| all.iter().map(move |column| column[frame]);
                let value = |frame: usize| match function {
                    Function::Mean | Function::First => row(frame).sum::<f64>() / all.len() as f64,
                    Function::Max => row(frame).fold(f64::NEG_INFINITY, f64::max),
                    Function::Min => row(frame).fold(f64::INFINITY, f64::min),
                    Function::Clamp => all[0][frame].max(all[1][frame]).min(all[2][frame]),
                    Function::Atan2 => all[0][frame].atan2(all[1][frame]),
                };
                let gap = |frame: usize| row(frame).any(f64::is_nan);
                let values = (0..frames).map(|at| if gap(at) { f64::NAN } else { value(at) });
                values.collect()
            }
        })
    }

    /// Returns the names of the channels in the formula.
    pub(super) fn channels(&self) -> Vec<&str> {
        match self {
            Self::Number(_) => Vec::new(),
            Self::Channel(name) => vec![name],
            Self::Negative(inner) => inner.channels(),
            Self::Both(_, sides) => sides.iter().flat_map(Self::channels).collect(),
            Self::Call(_, inner) => inner.iter().flat_map(Self::channels).collect(),
        }
    }
}

struct Reader<'a> {
    rest: &'a str,
}

impl Reader<'_> {
    fn accept(&mut self, sign: char) -> bool {
        let rest = self.rest.strip_prefix(sign).map(str::trim_start);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn sum(&mut self, depth: usize) -> Result<Formula, String> {
        let mut sum = self.product(depth)?;
        loop {
            let sign = match (self.accept('+'), self.accept('-')) {
                (true, _) => '+',
                (_, true) => '-',
                _ => return Ok(sum),
            };
            sum = Formula::Both(sign, Box::new([sum, self.product(depth)?]));
        }
    }

    fn product(&mut self, depth: usize) -> Result<Formula, String> {
        let mut product = self.factor(depth)?;
        loop {
            let sign = match (self.accept('*'), self.accept('/')) {
                (true, _) => '*',
                (_, true) => '/',
                _ => return Ok(product),
            };
            product = Formula::Both(sign, Box::new([product, self.factor(depth)?]));
        }
    }

    fn factor(&mut self, depth: usize) -> Result<Formula, String> {
        if depth > DEEPEST {
            return Err(format!("brackets are nested deeper than {DEEPEST}"));
        }
        if self.accept('-') {
            return Ok(Formula::Negative(Box::new(self.factor(depth + 1)?)));
        }
        if self.accept('(') {
            let inner = self.sum(depth + 1)?;
            return match self.accept(')') {
                true => Ok(inner),
                false => Err("a bracket is not closed".to_owned()),
            };
        }
        let end = self
            .rest
            .find(|letter: char| !letter.is_ascii_alphanumeric() && !"_.".contains(letter))
            .unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest.trim_start();
        if word.starts_with(|first: char| first.is_ascii_digit()) {
            let number: Result<f64, _> = word.parse();
            return number
                .map(Formula::Number)
                .map_err(|_| format!("{word:?} is no number"));
        }
        if word.is_empty() {
            return Err(format!(
                "a number or a channel is missing before {:?}",
                self.rest
            ));
        }
        if !self.accept('(') {
            return Ok(Formula::Channel(word.to_owned()));
        }
        let function = Function::of(word).ok_or_else(|| format!("{word:?} is no function"))?;
        let mut inner = vec![self.sum(depth + 1)?];
        while self.accept(',') {
            inner.push(self.sum(depth + 1)?);
        }
        if !self.accept(')') {
            return Err(format!("the bracket of {word} is not closed"));
        }
        match function.takes(inner.len()) {
            true => Ok(Formula::Call(function, inner)),
            false => Err(format!("{word} does not take {} parts", inner.len())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Formula;

    #[test]
    fn formulas_compute_their_documented_values() {
        let (a, b) = ([0.5, 1.0, f64::NAN], [0.25, -1.0, 1.0]);
        let channel = |name: &str| match name {
            "A" => Some(&a[..]),
            "B" => Some(&b[..]),
            _ => None,
        };
        let cases = [
            ("A", Some([0.5, 1.0])),
            ("2*A - B", Some([0.75, 3.0])),
            ("2*(A - B)/4", Some([0.125, 1.0])),
            ("A - B - B", Some([0.0, 3.0])),
            ("-A", Some([-0.5, -1.0])),
            ("max(A, B)", Some([0.5, 1.0])),
            ("min(A, B, 0)", Some([0.0, -1.0])),
            ("mean(A, B)", Some([0.375, 0.0])),
            ("clamp(4*B, -1, 0.5)", Some([0.5, -1.0])),
            ("first(C, B)", Some([0.25, -1.0])),
            ("atan2(0, A)", Some([0.0, 0.0])),
            ("A + C", None),
        ];
        for (text, want) in cases {
            let formula = Formula::read(text).unwrap_or_else(|error| panic!("{text}: {error}"));
            let values = formula.values(3, &channel);
            assert_eq!(values.as_ref().map(|it| [it[0], it[1]]), want, "{text}");
        }
        let gap = Formula::read("max(A, B)")
            .expect("read")
            .values(3, &channel);
        assert!(gap.expect("values")[2].is_nan(), "a gap stays one");
    }

    #[test]
    fn an_invalid_formula_is_refused() {
        let deep = "(".repeat(100_000);
        for bad in [
            "",
            "A +",
            "(A",
            "A B",
            "2x",
            "sin(A)",
            "clamp(A, 1)",
            "mean()",
            &deep,
            "1..2",
        ] {
            assert!(Formula::read(bad).is_err(), "{}", &bad[..bad.len().min(20)]);
        }
    }
}
