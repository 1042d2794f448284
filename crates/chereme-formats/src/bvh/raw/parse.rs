//! The HIERARCHY section, read without recursion and with limits.

use std::collections::BTreeSet;
use std::io::Read;

use super::header::{Header, read_header};
use super::oddity::{Oddities, Oddity};
use super::source::{Source, is_blank, shown};
use super::{BvhError, BvhErrorKind, Channel, Hierarchy, Number, RawJoint};

/// The deepest nesting of joints.
const DEPTH_LIMIT: usize = 512;
/// The most joints.
const JOINT_LIMIT: usize = 16_384;
/// The most channels, which bounds the size of a block of frames.
const CHANNEL_LIMIT: usize = 32_768;
/// The most End Sites.
const END_SITE_LIMIT: usize = 65_536;

/// Reads everything before the first row of numbers.
pub(super) fn read_head<R: Read>(
    source: &mut Source<R>,
    oddities: &mut Oddities,
) -> Result<(Hierarchy, Header), BvhError> {
    check_text(source, oddities)?;
    let (hierarchy, open, lines) = (Hierarchy::default(), Vec::new(), Vec::new());
    let mut parser = Parser {
        source,
        oddities,
        hierarchy,
        open,
        lines,
        channels: 0,
        ends: 0,
    };
    parser.begin()?;
    while !parser.open.is_empty() {
        parser.statement()?;
    }
    let has_motion = parser.motion_follows()?;
    parser.note_names();
    let hierarchy = parser.hierarchy;
    let header = if has_motion {
        read_header(source, oddities)?
    } else {
        Header::default()
    };
    Ok((hierarchy, header))
}

/// Refuses bytes that are not text in UTF-8 or a related encoding.
fn check_text<R: Read>(source: &mut Source<R>, oddities: &mut Oddities) -> Result<(), BvhError> {
    while source.held().len() < 512 && source.fill()? {}
    let start = &source.held()[..source.held().len().min(512)];
    if matches!(
        start,
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] | [0, b'A'..=b'z', ..] | [b'A'..=b'z', 0, ..]
    ) {
        return Err(BvhErrorKind::Utf16.at(1));
    }
    if start.contains(&0) {
        return Err(BvhErrorKind::Binary.at(1));
    }
    if start.starts_with(b"\xef\xbb\xbf") {
        source.advance(3);
        oddities.note(Oddity::ByteOrderMark, 1, "");
    }
    Ok(())
}

/// A token of the hierarchy.
enum Token {
    Open,
    Close,
    Word(String),
    End,
}

/// A joint whose brace is open.
struct Open {
    joint: usize,
    line: u64,
    has_offset: bool,
    has_channels: bool,
    has_children: bool,
}

struct Parser<'a, R> {
    source: &'a mut Source<R>,
    oddities: &'a mut Oddities,
    hierarchy: Hierarchy,
    open: Vec<Open>,
    lines: Vec<u64>,
    channels: usize,
    ends: usize,
}

impl<R: Read> Parser<'_, R> {
    /// Reads up to and including the root's brace.
    fn begin(&mut self) -> Result<(), BvhError> {
        let (token, line) = self.token()?;
        match token {
            Token::End => return Err(BvhErrorKind::Empty.at(line)),
            Token::Word(word) if self.is(&word, "HIERARCHY", line) => self.keyword("ROOT")?,
            Token::Word(word) if self.is(&word, "ROOT", line) => {
                self.oddities.note(Oddity::NoHierarchyLine, line, "");
            }
            Token::Word(word) if word.contains(['\u{fffd}', '\0']) => {
                return Err(BvhErrorKind::Binary.at(line));
            }
            other => {
                return Err(BvhErrorKind::NotBvh {
                    found: other.shown(),
                }
                .at(line));
            }
        }
        self.joint()
    }

    /// Reads one statement inside a joint.
    fn statement(&mut self) -> Result<(), BvhError> {
        let (token, line) = self.token()?;
        let expected = "OFFSET, CHANNELS, JOINT, End Site or \"}\"";
        match token {
            Token::Close => self.close(),
            Token::End => return Err(self.unclosed("the end of the file", line)),
            Token::Word(word) if word.eq_ignore_ascii_case("MOTION") => {
                return Err(self.unclosed("MOTION", line));
            }
            Token::Word(word) if self.is(&word, "OFFSET", line) => self.offset(line)?,
            Token::Word(word) if self.is(&word, "CHANNELS", line) => self.channels(line)?,
            Token::Word(word) if self.is(&word, "JOINT", line) => self.joint()?,
            Token::Word(word) if word.eq_ignore_ascii_case("ROOT") => {
                return Err(BvhErrorKind::SecondRoot.at(line));
            }
            Token::Word(word) if is_end(&word) => self.end_site(&word, line)?,
            other => {
                return Err(BvhErrorKind::Unexpected {
                    found: other.shown(),
                    expected,
                }
                .at(line));
            }
        }
        Ok(())
    }

    /// Reads a joint's name and opening brace.
    fn joint(&mut self) -> Result<(), BvhError> {
        if self.open.len() >= DEPTH_LIMIT {
            return Err(BvhErrorKind::TooDeep { limit: DEPTH_LIMIT }.at(self.source.line()));
        }
        if self.hierarchy.joints.len() >= JOINT_LIMIT {
            return Err(BvhErrorKind::TooMany {
                limit: JOINT_LIMIT,
                what: "joints",
            }
            .at(self.source.line()));
        }
        let name_line = self.source.line();
        let name = self.name(name_line)?;
        let line = self.brace()?;
        if line == name_line {
            self.oddities
                .note(Oddity::BraceOnNameLine, line, format!("{name:?}"));
        }
        if name.is_empty() {
            self.oddities.note(Oddity::EmptyName, name_line, "");
        }
        let parent = self.open.last_mut().map(|parent| {
            parent.has_children = true;
            parent.joint
        });
        let joint = self.hierarchy.joints.len();
        self.hierarchy.joints.push(RawJoint {
            name,
            parent,
            ..RawJoint::default()
        });
        self.lines.push(name_line);
        self.open.push(Open {
            joint,
            line,
            has_offset: false,
            has_channels: false,
            has_children: false,
        });
        Ok(())
    }

    /// Returns the rest of the line up to a brace.
    fn name(&mut self, line: u64) -> Result<String, BvhError> {
        let bytes = self
            .source
            .take_until(|b| matches!(b, b'\n' | b'\r' | b'{' | b'}'))?
            .trim_ascii();
        if let Ok(name) = std::str::from_utf8(bytes) {
            return Ok(name.to_owned());
        }
        let name: String = bytes.iter().map(|&b| char::from(b)).collect();
        self.oddities
            .note(Oddity::NameNotUtf8, line, format!("{name:?}"));
        Ok(name)
    }

    /// Reads an opening brace and returns its line.
    fn brace(&mut self) -> Result<u64, BvhError> {
        match self.token()? {
            (Token::Open, line) => Ok(line),
            (other, line) => {
                let found = other.shown();
                Err(BvhErrorKind::Unexpected {
                    found,
                    expected: "the opening \"{\" of a joint",
                }
                .at(line))
            }
        }
    }

    fn offset(&mut self, line: u64) -> Result<(), BvhError> {
        let Some(open) = self.open.last_mut() else {
            return Ok(());
        };
        let joint = open.joint;
        if std::mem::replace(&mut open.has_offset, true) {
            let expected = "one OFFSET per joint, not a second";
            return Err(BvhErrorKind::Unexpected {
                found: "OFFSET".to_owned(),
                expected,
            }
            .at(line));
        }
        self.hierarchy.joints[joint].offset = self.three_numbers(joint, line)?;
        Ok(())
    }

    fn three_numbers(&mut self, joint: usize, line: u64) -> Result<[Number; 3], BvhError> {
        let mut numbers = [Number::ZERO; 3];
        let mut last = line;
        for number in &mut numbers {
            let (token, at) = self.token()?;
            last = at;
            let found = match token {
                Token::Word(word) => word,
                other => other.shown(),
            };
            *number = Number::parse(found.as_bytes()).map_err(|why| {
                let place = format!("OFFSET of joint {:?}", self.hierarchy.joints[joint].name);
                BvhErrorKind::BadNumber {
                    place,
                    found: shown(found.as_bytes()),
                    why,
                }
                .at(at)
            })?;
        }
        if last != line {
            let name = &self.hierarchy.joints[joint].name;
            self.oddities
                .note(Oddity::OffsetOverLines, line, format!("{name:?}"));
        }
        Ok(numbers)
    }

    fn channels(&mut self, line: u64) -> Result<(), BvhError> {
        let Some(open) = self.open.last_mut() else {
            return Ok(());
        };
        let joint = open.joint;
        if std::mem::replace(&mut open.has_channels, true) {
            let expected = "one CHANNELS line per joint, not a second";
            return Err(BvhErrorKind::Unexpected {
                found: "CHANNELS".to_owned(),
                expected,
            }
            .at(line));
        }
        let words = self.channel_words(line)?;
        let (count, names) = match words.split_first() {
            Some((first, names)) if Channel::from_word(first).is_none() => {
                (first.parse::<usize>().ok(), names)
            }
            _ => (None, &words[..]),
        };
        let name = self.hierarchy.joints[joint].name.clone();
        let mut channels = Vec::with_capacity(names.len());
        for word in names {
            let unknown = || BvhErrorKind::UnknownChannel {
                joint: name.clone(),
                found: shown(word.as_bytes()),
            };
            let channel = Channel::from_word(word).ok_or_else(|| unknown().at(line))?;
            if channels.contains(&channel) {
                self.oddities.note(
                    Oddity::RepeatedChannel,
                    line,
                    format!("{name:?} has {channel}"),
                );
            }
            channels.push(channel);
        }
        if count != Some(channels.len()) {
            let said = words.first().map_or("nothing", |word| word.as_str());
            let detail = format!(
                "{name:?} announces {} channels and names {}",
                shown(said.as_bytes()),
                channels.len()
            );
            self.oddities.note(Oddity::ChannelCount, line, detail);
        }
        self.note_channels(&channels, joint, line);
        self.hierarchy.joints[joint].channels = channels;
        Ok(())
    }

    /// Returns the words of a CHANNELS statement: up to a brace, or a keyword.
    fn channel_words(&mut self, line: u64) -> Result<Vec<String>, BvhError> {
        let mut words = Vec::new();
        while let Some(byte) = self.source.skip_blanks()? {
            let is_brace = matches!(byte, b'{' | b'}');
            if is_brace || !self.continues_channels(self.source.line() == line)? {
                break;
            }
            let (Token::Word(word), _) = self.token()? else {
                break;
            };
            words.push(word);
            self.channels += 1;
            if self.channels > CHANNEL_LIMIT + self.hierarchy.joints.len() {
                return Err(BvhErrorKind::TooMany {
                    limit: CHANNEL_LIMIT,
                    what: "channels",
                }
                .at(line));
            }
        }
        Ok(words)
    }

    /// Returns whether the next word belongs to the channels: on their line anything but a keyword, below
    /// it a channel.
    fn continues_channels(&mut self, same_line: bool) -> Result<bool, BvhError> {
        while self.source.held().len() < 16 && self.source.fill()? {}
        let word = self
            .source
            .held()
            .split(|&b| is_blank(b) || matches!(b, b'{' | b'}'))
            .next()
            .unwrap_or_default();
        let word = std::str::from_utf8(&word[..word.len().min(16)]).unwrap_or_default();
        let keywords = [
            "JOINT", "ROOT", "OFFSET", "CHANNELS", "End", "EndSite", "MOTION",
        ];
        let is_keyword = keywords
            .iter()
            .any(|keyword| keyword.eq_ignore_ascii_case(word));
        Ok(if same_line {
            !is_keyword
        } else {
            Channel::from_word(word).is_some()
        })
    }

    fn note_channels(&mut self, channels: &[Channel], joint: usize, line: u64) {
        let name = format!("{:?}", self.hierarchy.joints[joint].name);
        if joint > 0 && channels.iter().any(|channel| channel.is_position()) {
            self.oddities
                .note(Oddity::PositionBelowRoot, line, name.clone());
        }
        if channels
            .iter()
            .any(|channel| !channel.is_position() && !channel.is_rotation())
        {
            self.oddities.note(Oddity::ScaleChannel, line, name);
        }
    }

    fn end_site(&mut self, word: &str, line: u64) -> Result<(), BvhError> {
        let Some(joint) = self.open.last().map(|open| open.joint) else {
            return Ok(());
        };
        let rest = self
            .source
            .take_until(|b| matches!(b, b'\n' | b'\r' | b'{' | b'}'))?
            .trim_ascii();
        let rest = String::from_utf8_lossy(rest).into_owned();
        let spelling = format!("{word} {rest}");
        let name = rest
            .get(..4)
            .filter(|site| site.eq_ignore_ascii_case("site"))
            .map_or(&rest[..], |_| rest[4..].trim());
        if !name.is_empty() {
            self.oddities.note(
                Oddity::EndSiteName,
                line,
                format!("{:?}", shown(name.as_bytes())),
            );
        } else if spelling.trim() != "End Site" {
            self.oddities
                .note(Oddity::KeywordCase, line, format!("{:?}", spelling.trim()));
        }
        self.brace()?;
        let (token, offset_line) = self.token()?;
        match token {
            Token::Word(word) if self.is(&word, "OFFSET", offset_line) => {}
            other => {
                let expected = "the OFFSET of an End Site";
                return Err(BvhErrorKind::Unexpected {
                    found: other.shown(),
                    expected,
                }
                .at(offset_line));
            }
        }
        let offset = self.three_numbers(joint, offset_line)?;
        self.ends += 1;
        if self.ends > END_SITE_LIMIT {
            return Err(BvhErrorKind::TooMany {
                limit: END_SITE_LIMIT,
                what: "End Sites",
            }
            .at(line));
        }
        self.hierarchy.joints[joint].end_sites.push(offset);
        match self.token()? {
            (Token::Close, _) => Ok(()),
            (Token::End, at) => Err(self.unclosed("the end of the file", at)),
            (other, at) => {
                let expected = "the \"}\" of an End Site";
                Err(BvhErrorKind::Unexpected {
                    found: other.shown(),
                    expected,
                }
                .at(at))
            }
        }
    }

    /// Closes the innermost joint and records missing parts.
    fn close(&mut self) {
        let Some(open) = self.open.pop() else { return };
        let joint = &self.hierarchy.joints[open.joint];
        let name = format!("{:?}", joint.name);
        let oddities = [
            (Oddity::NoOffset, !open.has_offset),
            (Oddity::NoChannels, joint.channels.is_empty()),
            (
                Oddity::NoEndSite,
                joint.end_sites.is_empty() && !open.has_children,
            ),
            (
                Oddity::EndSiteBesideChildren,
                !joint.end_sites.is_empty() && open.has_children,
            ),
            (Oddity::SeveralEndSites, joint.end_sites.len() > 1),
        ];
        for (kind, _) in oddities.into_iter().filter(|(_, is_so)| *is_so) {
            self.oddities.note(kind, open.line, name.clone());
        }
    }

    /// Returns whether MOTION follows; anything but MOTION or the end of the file is an error.
    fn motion_follows(&mut self) -> Result<bool, BvhError> {
        let (token, line) = self.token()?;
        match token {
            Token::End => {
                self.oddities.note(Oddity::NoMotion, line, "");
                Ok(false)
            }
            Token::Word(word) if word.eq_ignore_ascii_case("ROOT") => {
                Err(BvhErrorKind::SecondRoot.at(line))
            }
            Token::Word(word) if self.is(&word, "MOTION", line) => Ok(true),
            other => Err(BvhErrorKind::Unexpected {
                found: other.shown(),
                expected: "MOTION",
            }
            .at(line)),
        }
    }

    fn note_names(&mut self) {
        let mut names = BTreeSet::new();
        for (joint, &line) in self.hierarchy.joints.iter().zip(&self.lines) {
            if !joint.name.is_empty() && !names.insert(joint.name.as_str()) {
                self.oddities
                    .note(Oddity::DuplicateName, line, format!("{:?}", joint.name));
            }
        }
    }

    fn unclosed(&self, before: &'static str, line: u64) -> BvhError {
        let innermost = self.open.last();
        let joint = innermost
            .map(|open| self.hierarchy.joints[open.joint].name.clone())
            .unwrap_or_default();
        BvhErrorKind::Unclosed {
            joint,
            opened: innermost.map_or(line, |open| open.line),
            before,
        }
        .at(line)
    }

    fn keyword(&mut self, keyword: &'static str) -> Result<(), BvhError> {
        match self.token()? {
            (Token::Word(word), line) if self.is(&word, keyword, line) => Ok(()),
            (other, line) => Err(BvhErrorKind::Unexpected {
                found: other.shown(),
                expected: keyword,
            }
            .at(line)),
        }
    }

    /// Returns whether the word is the keyword; records a different case of its letters.
    fn is(&mut self, word: &str, keyword: &str, line: u64) -> bool {
        let same = word.eq_ignore_ascii_case(keyword);
        if same && word != keyword {
            self.oddities
                .note(Oddity::KeywordCase, line, format!("{word:?}"));
        }
        same
    }

    /// Takes the next token and returns it with its line.
    fn token(&mut self) -> Result<(Token, u64), BvhError> {
        let Some(byte) = self.source.skip_blanks()? else {
            return Ok((Token::End, self.source.line()));
        };
        let line = self.source.line();
        if matches!(byte, b'{' | b'}') {
            self.source.take();
            return Ok((
                if byte == b'{' {
                    Token::Open
                } else {
                    Token::Close
                },
                line,
            ));
        }
        let word = self
            .source
            .take_until(|b| is_blank(b) || matches!(b, b'{' | b'}'))?;
        Ok((
            Token::Word(String::from_utf8_lossy(word).into_owned()),
            line,
        ))
    }
}

impl Token {
    fn shown(&self) -> String {
        match self {
            Self::Open => "{".to_owned(),
            Self::Close => "}".to_owned(),
            Self::Word(word) => shown(word.as_bytes()),
            Self::End => "the end of the file".to_owned(),
        }
    }
}

fn is_end(word: &str) -> bool {
    word.eq_ignore_ascii_case("End") || word.eq_ignore_ascii_case("EndSite")
}
