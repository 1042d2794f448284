//! Draws a character that no font has as a frame with its number, so that two such names remain distinguishable.

/// The height of a frame, in dots.
pub const CODE_HEIGHT: usize = 15;

/// Three dots in five rows, the leftmost the highest bit, for `0` to `F`.
#[rustfmt::skip]
const HEX_DIGIT_GLYPHS: [[u8; 5]; 16] = [
    [7, 5, 5, 5, 7], [2, 6, 2, 2, 7], [7, 1, 7, 4, 7], [7, 1, 3, 1, 7],
    [5, 5, 7, 1, 1], [7, 4, 7, 1, 7], [7, 4, 7, 5, 7], [7, 1, 1, 2, 2],
    [7, 5, 7, 5, 7], [7, 5, 7, 1, 7], [2, 5, 7, 5, 5], [6, 5, 6, 5, 6],
    [3, 4, 4, 4, 3], [6, 5, 5, 5, 6], [7, 4, 6, 4, 7], [7, 4, 6, 4, 4],
];

/// Returns the width of a character's frame in dots, with the gap after it.
#[must_use]
pub fn code_width(letter: char) -> usize {
    code_digits_per_row(letter) * 4 + 4
}

/// Calls `dot` with column and row of every dot of a character's frame.
pub fn draw_code(letter: char, mut dot: impl FnMut(usize, usize)) {
    let columns = code_digits_per_row(letter);
    // Two columns of frame and one of space stand around the digits, of four columns each.
    let (right, bottom) = (columns * 4 + 2, CODE_HEIGHT - 1);
    for x in 0..=right {
        dot(x, 0);
        dot(x, bottom);
    }
    for y in 1..bottom {
        dot(0, y);
        dot(right, y);
    }
    for place in 0..columns * 2 {
        let shift = 4 * (columns * 2 - 1 - place);
        let digit = HEX_DIGIT_GLYPHS[(letter as usize >> shift) & 0xF];
        let corner = [2 + place % columns * 4, 2 + place / columns * 6];
        for (row, bits) in digit.into_iter().enumerate() {
            for column in (0..3).filter(|column| bits & (4 >> column) != 0) {
                dot(corner[0] + column, corner[1] + row);
            }
        }
    }
}

/// Returns the number of digits in each of the two rows.
fn code_digits_per_row(letter: char) -> usize {
    if letter as u32 > 0xFFFF { 3 } else { 2 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_without_a_font_look_different_and_stay_in_their_frame() {
        let picture = |letter| {
            let mut dots = Vec::new();
            draw_code(letter, |x, y| dots.push((x, y)));
            dots
        };
        for letter in ['ع', '漢', '\u{1F600}', '\u{10FFFF}'] {
            let inside = |&(x, y): &(usize, usize)| x < code_width(letter) - 1 && y < CODE_HEIGHT;
            assert!(picture(letter).iter().all(inside), "{letter}");
        }
        assert_ne!(picture('ع'), picture('غ'));
        assert_ne!(picture('漢'), picture('字'));
    }
}
