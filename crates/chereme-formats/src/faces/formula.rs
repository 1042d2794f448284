//! Formulas over channels, as the mappings of face systems write them.
//!
//! `0.5*BrowInnerUp - max(A, B)`: numbers, names of channels, `+ - * /`, brackets, and the functions `mean`, `max`,
//! `min`, `clamp(x, low, high)`, `atan2(y, x)` and `first(a, b, …)`, the first argument whose channels exist.

/// A formula.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum FaceFormula {
    Number(f64),
    Channel(String),
    Negative(Box<Self>),
    Both(char, Box<[Self; 2]>),
    Call(FormulaFunction, Vec<Self>),
}

/// A function of a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FormulaFunction {
    Mean,
    Max,
    Min,
    Clamp,
    Atan2,
    First,
}

impl FormulaFunction {
    fn find_formula_function(name: &str) -> Option<Self> {
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

    fn may_take_arguments(self, count: usize) -> bool {
        match self {
            Self::Clamp => count == 3,
            Self::Atan2 => count == 2,
            Self::Mean | Self::Max | Self::Min | Self::First => count > 0,
        }
    }
}

/// The deepest nesting of brackets.
const MAX_FORMULA_DEPTH: usize = 32;

impl FaceFormula {
    /// Reads a formula. The error names the fault.
    pub(super) fn parse_face_formula(text: &str) -> Result<Self, String> {
        let mut reader = FormulaReader { rest: text.trim() };
        let formula = reader.parse_formula_sum(0)?;
        match reader.rest {
            "" => Ok(formula),
            rest => Err(format!("{rest:?} does not belong there")),
        }
    }

    /// Returns the formula's values for all frames; `None` if a channel that it needs is missing.
    pub(super) fn evaluate_formula<'a>(
        &self,
        frames: usize,
        channel: &dyn Fn(&str) -> Option<&'a [f64]>,
    ) -> Option<Vec<f64>> {
        let of = |formula: &Self| formula.evaluate_formula(frames, channel);
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
            // Trackers of several versions give a number by different channels; the first that is there counts.
            Self::Call(FormulaFunction::First, inner) => inner.iter().find_map(of)?,
            Self::Call(function, inner) => {
                let all: Vec<Vec<f64>> = inner.iter().map(of).collect::<Option<_>>()?;
                let row = |frame: usize| all.iter().map(move |column| column[frame]);
                let value = |frame: usize| match function {
                    FormulaFunction::Mean | FormulaFunction::First => row(frame).sum::<f64>() / all.len() as f64,
                    FormulaFunction::Max => row(frame).fold(f64::NEG_INFINITY, f64::max),
                    FormulaFunction::Min => row(frame).fold(f64::INFINITY, f64::min),
                    FormulaFunction::Clamp => all[0][frame].max(all[1][frame]).min(all[2][frame]),
                    FormulaFunction::Atan2 => all[0][frame].atan2(all[1][frame]),
                };
                // The largest and the least of numbers pass over gaps, which would then look like values.
                let gap = |frame: usize| row(frame).any(f64::is_nan);
                let values = (0..frames).map(|at| if gap(at) { f64::NAN } else { value(at) });
                values.collect()
            }
        })
    }

    /// Returns the names of the channels in the formula.
    pub(super) fn formula_channel_names(&self) -> Vec<&str> {
        match self {
            Self::Number(_) => Vec::new(),
            Self::Channel(name) => vec![name],
            Self::Negative(inner) => inner.formula_channel_names(),
            Self::Both(_, sides) => sides.iter().flat_map(Self::formula_channel_names).collect(),
            Self::Call(_, inner) => inner.iter().flat_map(Self::formula_channel_names).collect(),
        }
    }
}

struct FormulaReader<'a> {
    rest: &'a str,
}

impl FormulaReader<'_> {
    fn accept_formula_sign(&mut self, sign: char) -> bool {
        let rest = self.rest.strip_prefix(sign).map(str::trim_start);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn parse_formula_sum(&mut self, depth: usize) -> Result<FaceFormula, String> {
        let mut sum = self.product(depth)?;
        loop {
            let sign = match (self.accept_formula_sign('+'), self.accept_formula_sign('-')) {
                (true, _) => '+',
                (_, true) => '-',
                _ => return Ok(sum),
            };
            sum = FaceFormula::Both(sign, Box::new([sum, self.product(depth)?]));
        }
    }

    fn product(&mut self, depth: usize) -> Result<FaceFormula, String> {
        let mut product = self.parse_formula_factor(depth)?;
        loop {
            let sign = match (self.accept_formula_sign('*'), self.accept_formula_sign('/')) {
                (true, _) => '*',
                (_, true) => '/',
                _ => return Ok(product),
            };
            product = FaceFormula::Both(sign, Box::new([product, self.parse_formula_factor(depth)?]));
        }
    }

    fn parse_formula_factor(&mut self, depth: usize) -> Result<FaceFormula, String> {
        if depth > MAX_FORMULA_DEPTH {
            return Err(format!("brackets are nested deeper than {MAX_FORMULA_DEPTH}"));
        }
        if self.accept_formula_sign('-') {
            return Ok(FaceFormula::Negative(Box::new(self.parse_formula_factor(depth + 1)?)));
        }
        if self.accept_formula_sign('(') {
            let inner = self.parse_formula_sum(depth + 1)?;
            return match self.accept_formula_sign(')') {
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
                .map(FaceFormula::Number)
                .map_err(|_| format!("{word:?} is no number"));
        }
        if word.is_empty() {
            return Err(format!("a number or a channel is missing before {:?}", self.rest));
        }
        if !self.accept_formula_sign('(') {
            return Ok(FaceFormula::Channel(word.to_owned()));
        }
        let function =
            FormulaFunction::find_formula_function(word).ok_or_else(|| format!("{word:?} is no function"))?;
        let mut inner = vec![self.parse_formula_sum(depth + 1)?];
        while self.accept_formula_sign(',') {
            inner.push(self.parse_formula_sum(depth + 1)?);
        }
        if !self.accept_formula_sign(')') {
            return Err(format!("the bracket of {word} is not closed"));
        }
        match function.may_take_arguments(inner.len()) {
            true => Ok(FaceFormula::Call(function, inner)),
            false => Err(format!("{word} does not take {} parts", inner.len())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::FaceFormula;

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
            let formula = FaceFormula::parse_face_formula(text).unwrap_or_else(|error| panic!("{text}: {error}"));
            let values = formula.evaluate_formula(3, &channel);
            assert_eq!(values.as_ref().map(|it| [it[0], it[1]]), want, "{text}");
        }
        let gap = FaceFormula::parse_face_formula("max(A, B)")
            .expect("read")
            .evaluate_formula(3, &channel);
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
            assert!(
                FaceFormula::parse_face_formula(bad).is_err(),
                "{}",
                &bad[..bad.len().min(20)]
            );
        }
    }
}
