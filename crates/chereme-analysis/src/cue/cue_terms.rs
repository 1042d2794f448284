//! The terms of the regression for the hand's markers: a constant, cosines and sines of angles and of their sums, and
//! products of a sine and a cosine.

use super::cue_hand::MARKER_HAND_ANGLES;

/// Returns the index of the first angle of a finger: its bend at the knuckle, followed by its spread and the bends of
/// its two other joints.
fn of_finger(finger: usize) -> usize {
    3 + 4 * finger
}

/// The terms of a hand.
#[derive(Debug, Clone)]
pub(super) struct HandTerms {
    /// Sums of angles: a single angle, or several of one finger.
    sums: Vec<Vec<usize>>,
    /// Products: the index of the angle whose sine, and the index in `sums` of the sum whose cosine, are multiplied.
    products: Vec<(usize, usize)>,
}

impl HandTerms {
    /// Returns the terms for the angles of a hand. A finger with the spread s and the bends a, b and c has the angles a, s,
    /// b, c, b+c, a+b and a+b+c, and the products sin s · cos b and sin s · cos(b+c). The thumb has its angles only.
    pub(super) fn of_a_hand() -> Self {
        // The first three angles are those of the wrist, which rotates the hand as a whole.
        let mut sums: Vec<Vec<usize>> = (3..MARKER_HAND_ANGLES).map(|n| vec![n]).collect();
        let mut products = Vec::new();
        for finger in 0..4 {
            let first = of_finger(finger);
            let (middle, last) = (first + 2, first + 3);
            // A single angle n is the sum n - 3.
            products.push((first + 1, middle - 3));
            products.push((first + 1, sums.len()));
            sums.push(vec![middle, last]);
            sums.push(vec![first, middle]);
            sums.push(vec![first, middle, last]);
        }
        Self { sums, products }
    }

    /// Returns the number of terms.
    pub(super) fn len(&self) -> usize {
        1 + 2 * self.sums.len() + self.products.len()
    }

    /// Returns the values of the terms.
    pub(super) fn hand_term_values(&self, angles: &[f64]) -> Vec<f64> {
        let sums: Vec<f64> = self.sum_term_angles(angles);
        let mut row = Vec::with_capacity(self.len());
        row.push(1.0);
        row.extend(sums.iter().map(|angle| angle.cos()));
        row.extend(sums.iter().map(|angle| angle.sin()));
        let both = |(angle, sum): &(usize, usize)| angles[*angle].sin() * sums[*sum].cos();
        row.extend(self.products.iter().map(both));
        row
    }

    /// Returns the derivatives of the terms if the angles change at the given `rates`.
    pub(super) fn hand_term_slopes(&self, angles: &[f64], rates: &[f64]) -> Vec<f64> {
        let (sums, rate_sums) = (self.sum_term_angles(angles), self.sum_term_angles(rates));
        let mut row = Vec::with_capacity(self.len());
        row.push(0.0);
        row.extend(sums.iter().zip(&rate_sums).map(|(angle, rate)| -angle.sin() * rate));
        row.extend(sums.iter().zip(&rate_sums).map(|(angle, rate)| angle.cos() * rate));
        let both = |(angle, sum): &(usize, usize)| {
            angles[*angle].cos() * rates[*angle] * sums[*sum].cos()
                - angles[*angle].sin() * sums[*sum].sin() * rate_sums[*sum]
        };
        row.extend(self.products.iter().map(both));
        row
    }

    fn sum_term_angles(&self, angles: &[f64]) -> Vec<f64> {
        let add = |sum: &Vec<usize>| sum.iter().map(|n| angles[*n]).sum();
        self.sums.iter().map(add).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_equal_finite_differences() {
        let terms = HandTerms::of_a_hand();
        let angles: Vec<f64> = (0..MARKER_HAND_ANGLES).map(|n| (n as f64 * 0.7).sin()).collect();
        let rates: Vec<f64> = (0..MARKER_HAND_ANGLES).map(|n| (n as f64 * 1.3).cos()).collect();
        let step = 1e-6;
        let later: Vec<f64> = angles.iter().zip(&rates).map(|(x, rate)| x + step * rate).collect();
        let (now, then) = (terms.hand_term_values(&angles), terms.hand_term_values(&later));
        assert_eq!(now.len(), terms.len());
        for ((slope, now), then) in terms.hand_term_slopes(&angles, &rates).iter().zip(now).zip(then) {
            assert!((slope - (then - now) / step).abs() < 1e-5);
        }
    }
}
