//! The intended name in a message about an unknown name: `…"ESC"; did you mean "ESCARGOT"?`.

/// An unknown name, and the likeliest intended one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Meant {
    /// The name as it was written, if the message repeats it.
    pub(crate) wrong: Option<String>,
    pub(crate) right: String,
}

/// Returns the suggestion in a message.
pub(crate) fn meant(message: &str) -> Option<Meant> {
    const ASKED: &str = "did you mean ";
    let (before, after) = message.rsplit_once(ASKED)?;
    let right = match after.strip_prefix('"') {
        Some(quoted) => quoted_end(quoted).map(|(name, _)| name)?,
        None => {
            let end = after.find('?').filter(|end| *end > 0)?;
            after[..end].to_owned()
        }
    };
    let mut wrong = None;
    let mut rest = before;
    while let Some((_, quoted)) = rest.split_once('"') {
        let Some((name, after)) = quoted_end(quoted) else {
            break;
        };
        (wrong, rest) = (Some(name), after);
    }
    Some(Meant { wrong, right })
}

/// Returns a quoted name up to its closing quote, and the rest of the text.
fn quoted_end(text: &str) -> Option<(String, &str)> {
    let mut name = String::new();
    let mut letters = text.char_indices();
    while let Some((at, letter)) = letters.next() {
        match letter {
            '"' => return Some((name, &text[at + 1..])),
            '\\' => name.push(letters.next()?.1),
            letter => name.push(letter),
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_tell_what_was_meant() {
        for (message, wrong, right) in [
            (
                "no sign is called \"ESC\"; did you mean \"ESCARGOT\"?",
                Some("ESC"),
                "ESCARGOT",
            ),
            (
                "there is no field \"confguration\"; did you mean configuration?",
                Some("confguration"),
                "configuration",
            ),
            ("did you mean U?", None, "U"),
            (
                "\"a\\\"b\" is not it; did you mean \"a\\\"c\"? (x)",
                Some("a\"b"),
                "a\"c",
            ),
        ] {
            let found = meant(message).expect(message);
            assert_eq!(
                (found.wrong.as_deref(), found.right.as_str()),
                (wrong, right)
            );
        }
        for message in [
            "",
            "did you mean ",
            "did you mean \"",
            "there is none",
            "did you mean ?",
        ] {
            assert_eq!(meant(message), None, "{message}");
        }
    }
}
