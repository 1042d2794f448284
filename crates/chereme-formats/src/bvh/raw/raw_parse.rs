//! The HIERARCHY section, read without recursion and with limits.

use std::collections::BTreeSet;
use std::io::Read;

use super::header::{BvhMotionHeader, read_header};
use super::oddity::{BvhOddities, BvhOddity};
use super::raw_source::{ByteSource, is_blank, shown_token_bytes};
use super::{BvhChannel, BvhError, BvhErrorKind, BvhHierarchy, FileNumber, RawJoint};

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
    source: &mut ByteSource<R>,
    oddities: &mut BvhOddities,
) -> Result<(BvhHierarchy, BvhMotionHeader), BvhError> {
    check_text(source, oddities)?;
    let (hierarchy, open, lines) = (BvhHierarchy::default(), Vec::new(), Vec::new());
    let mut parser = HierarchyParser {
        source,
        oddities,
        hierarchy,
        open,
        lines,
        channels: 0,
        ends: 0,
    };
    parser.parse_root_opening()?;
    while !parser.open.is_empty() {
        parser.statement()?;
    }
    let has_motion = parser.motion_follows()?;
    parser.note_names();
    let hierarchy = parser.hierarchy;
    let header = if has_motion {
        read_header(source, oddities)?
    } else {
        BvhMotionHeader::default()
    };
    Ok((hierarchy, header))
}

/// Refuses bytes that are not text in UTF-8 or a related encoding.
fn check_text<R: Read>(source: &mut ByteSource<R>, oddities: &mut BvhOddities) -> Result<(), BvhError> {
    while source.held_bytes().len() < 512 && source.fill_source_window()? {}
    let start = &source.held_bytes()[..source.held_bytes().len().min(512)];
    // A byte order mark of UTF-16, or letters with zeros between them.
    if matches!(
        start,
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] | [0, b'A'..=b'z', ..] | [b'A'..=b'z', 0, ..]
    ) {
        return Err(BvhErrorKind::Utf16.error_at_line(1));
    }
    if start.contains(&0) {
        return Err(BvhErrorKind::Binary.error_at_line(1));
    }
    if start.starts_with(b"\xef\xbb\xbf") {
        source.advance_source_bytes(3);
        oddities.note_oddity(BvhOddity::ByteOrderMark, 1, "");
    }
    Ok(())
}

/// A token of the hierarchy.
enum HierarchyToken {
    Open,
    Close,
    Word(String),
    End,
}

/// A joint whose brace is open.
struct OpenJoint {
    joint: usize,
    line: u64,
    has_offset: bool,
    has_channels: bool,
    has_children: bool,
}

struct HierarchyParser<'a, R> {
    source: &'a mut ByteSource<R>,
    oddities: &'a mut BvhOddities,
    hierarchy: BvhHierarchy,
    open: Vec<OpenJoint>,
    lines: Vec<u64>,
    channels: usize,
    ends: usize,
}

impl<R: Read> HierarchyParser<'_, R> {
    /// Reads up to and including the root's brace.
    fn parse_root_opening(&mut self) -> Result<(), BvhError> {
        let (token, line) = self.take_hierarchy_token()?;
        match token {
            HierarchyToken::End => return Err(BvhErrorKind::Empty.error_at_line(line)),
            HierarchyToken::Word(word) if self.is_bvh_keyword(&word, "HIERARCHY", line) => self.keyword("ROOT")?,
            HierarchyToken::Word(word) if self.is_bvh_keyword(&word, "ROOT", line) => {
                self.oddities.note_oddity(BvhOddity::NoHierarchyLine, line, "");
            }
            HierarchyToken::Word(word) if word.contains(['\u{fffd}', '\0']) => {
                return Err(BvhErrorKind::Binary.error_at_line(line));
            }
            other => {
                return Err(BvhErrorKind::NotBvh {
                    found: other.shown_hierarchy_token(),
                }
                .error_at_line(line));
            }
        }
        self.parse_hierarchy_joint()
    }

    /// Reads one statement inside a joint.
    fn statement(&mut self) -> Result<(), BvhError> {
        let (token, line) = self.take_hierarchy_token()?;
        let expected = "OFFSET, CHANNELS, JOINT, End Site or \"}\"";
        match token {
            HierarchyToken::Close => self.close_open_joint(),
            HierarchyToken::End => {
                return Err(self.unclosed_joint_error("the end of the file", line));
            }
            HierarchyToken::Word(word) if word.eq_ignore_ascii_case("MOTION") => {
                return Err(self.unclosed_joint_error("MOTION", line));
            }
            HierarchyToken::Word(word) if self.is_bvh_keyword(&word, "OFFSET", line) => {
                self.parse_joint_offset(line)?
            }
            HierarchyToken::Word(word) if self.is_bvh_keyword(&word, "CHANNELS", line) => {
                self.parse_joint_channels(line)?
            }
            HierarchyToken::Word(word) if self.is_bvh_keyword(&word, "JOINT", line) => self.parse_hierarchy_joint()?,
            HierarchyToken::Word(word) if word.eq_ignore_ascii_case("ROOT") => {
                return Err(BvhErrorKind::SecondRoot.error_at_line(line));
            }
            HierarchyToken::Word(word) if is_end(&word) => self.end_site(&word, line)?,
            other => {
                return Err(BvhErrorKind::Unexpected {
                    found: other.shown_hierarchy_token(),
                    expected,
                }
                .error_at_line(line));
            }
        }
        Ok(())
    }

    /// Reads a joint's name and opening brace.
    fn parse_hierarchy_joint(&mut self) -> Result<(), BvhError> {
        if self.open.len() >= DEPTH_LIMIT {
            return Err(BvhErrorKind::TooDeep { limit: DEPTH_LIMIT }.error_at_line(self.source.byte_source_line()));
        }
        if self.hierarchy.joints.len() >= JOINT_LIMIT {
            return Err(BvhErrorKind::TooMany {
                limit: JOINT_LIMIT,
                what: "joints",
            }
            .error_at_line(self.source.byte_source_line()));
        }
        let name_line = self.source.byte_source_line();
        let name = self.parse_joint_name(name_line)?;
        let line = self.brace()?;
        if line == name_line {
            self.oddities
                .note_oddity(BvhOddity::BraceOnNameLine, line, format!("{name:?}"));
        }
        if name.is_empty() {
            self.oddities.note_oddity(BvhOddity::EmptyName, name_line, "");
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
        self.open.push(OpenJoint {
            joint,
            line,
            has_offset: false,
            has_channels: false,
            has_children: false,
        });
        Ok(())
    }

    /// Returns the rest of the line up to a brace.
    fn parse_joint_name(&mut self, line: u64) -> Result<String, BvhError> {
        let bytes = self
            .source
            .take_until(|b| matches!(b, b'\n' | b'\r' | b'{' | b'}'))?
            .trim_ascii();
        if let Ok(name) = std::str::from_utf8(bytes) {
            return Ok(name.to_owned());
        }
        // Latin-1 has a letter for every byte.
        let name: String = bytes.iter().map(|&b| char::from(b)).collect();
        self.oddities
            .note_oddity(BvhOddity::NameNotUtf8, line, format!("{name:?}"));
        Ok(name)
    }

    /// Reads an opening brace and returns its line.
    fn brace(&mut self) -> Result<u64, BvhError> {
        match self.take_hierarchy_token()? {
            (HierarchyToken::Open, line) => Ok(line),
            (other, line) => {
                let token_text = other.shown_hierarchy_token();
                Err(BvhErrorKind::Unexpected {
                    found: token_text,
                    expected: "the opening \"{\" of a joint",
                }
                .error_at_line(line))
            }
        }
    }

    fn parse_joint_offset(&mut self, line: u64) -> Result<(), BvhError> {
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
            .error_at_line(line));
        }
        self.hierarchy.joints[joint].offset = self.three_numbers(joint, line)?;
        Ok(())
    }

    fn three_numbers(&mut self, joint: usize, line: u64) -> Result<[FileNumber; 3], BvhError> {
        let mut numbers = [FileNumber::ZERO_NUMBER; 3];
        let mut last = line;
        for number in &mut numbers {
            let (token, at) = self.take_hierarchy_token()?;
            last = at;
            let token_text = match token {
                HierarchyToken::Word(word) => word,
                other => other.shown_hierarchy_token(),
            };
            *number = FileNumber::parse_file_number(token_text.as_bytes()).map_err(|why| {
                let place = format!("OFFSET of joint {:?}", self.hierarchy.joints[joint].name);
                BvhErrorKind::BadNumber {
                    place,
                    found: shown_token_bytes(token_text.as_bytes()),
                    why,
                }
                .error_at_line(at)
            })?;
        }
        if last != line {
            let name = &self.hierarchy.joints[joint].name;
            self.oddities
                .note_oddity(BvhOddity::OffsetOverLines, line, format!("{name:?}"));
        }
        Ok(numbers)
    }

    fn parse_joint_channels(&mut self, line: u64) -> Result<(), BvhError> {
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
            .error_at_line(line));
        }
        let words = self.channel_words(line)?;
        // The count may be missing or wrong; the names decide.
        let (count, names) = match words.split_first() {
            Some((first, names)) if BvhChannel::from_word(first).is_none() => (first.parse::<usize>().ok(), names),
            _ => (None, &words[..]),
        };
        let name = self.hierarchy.joints[joint].name.clone();
        let mut channels = Vec::with_capacity(names.len());
        for word in names {
            let unknown = || BvhErrorKind::UnknownChannel {
                joint: name.clone(),
                found: shown_token_bytes(word.as_bytes()),
            };
            let channel = BvhChannel::from_word(word).ok_or_else(|| unknown().error_at_line(line))?;
            if channels.contains(&channel) {
                self.oddities
                    .note_oddity(BvhOddity::RepeatedChannel, line, format!("{name:?} has {channel}"));
            }
            channels.push(channel);
        }
        if count != Some(channels.len()) {
            let first_word = words.first().map_or("nothing", |word| word.as_str());
            let detail = format!(
                "{name:?} announces {} channels and names {}",
                shown_token_bytes(first_word.as_bytes()),
                channels.len()
            );
            self.oddities.note_oddity(BvhOddity::ChannelCount, line, detail);
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
            if is_brace || !self.continues_channels(self.source.byte_source_line() == line)? {
                break;
            }
            let (HierarchyToken::Word(word), _) = self.take_hierarchy_token()? else {
                break;
            };
            words.push(word);
            self.channels += 1;
            // The count before each joint's channels is a word, too.
            if self.channels > CHANNEL_LIMIT + self.hierarchy.joints.len() {
                return Err(BvhErrorKind::TooMany {
                    limit: CHANNEL_LIMIT,
                    what: "channels",
                }
                .error_at_line(line));
            }
        }
        Ok(words)
    }

    /// Returns whether the next word belongs to the channels: on their line anything but a keyword, below
    /// it a channel.
    fn continues_channels(&mut self, same_line: bool) -> Result<bool, BvhError> {
        // No keyword and no channel is longer than 16 bytes.
        while self.source.held_bytes().len() < 16 && self.source.fill_source_window()? {}
        let word_bytes = self
            .source
            .held_bytes()
            .split(|&b| is_blank(b) || matches!(b, b'{' | b'}'))
            .next()
            .unwrap_or_default();
        let word = std::str::from_utf8(&word_bytes[..word_bytes.len().min(16)]).unwrap_or_default();
        let keywords = ["JOINT", "ROOT", "OFFSET", "CHANNELS", "End", "EndSite", "MOTION"];
        let is_keyword = keywords.iter().any(|keyword| keyword.eq_ignore_ascii_case(word));
        Ok(if same_line {
            !is_keyword
        } else {
            BvhChannel::from_word(word).is_some()
        })
    }

    fn note_channels(&mut self, channels: &[BvhChannel], joint: usize, line: u64) {
        let name = format!("{:?}", self.hierarchy.joints[joint].name);
        if joint > 0 && channels.iter().any(|channel| channel.is_position()) {
            self.oddities
                .note_oddity(BvhOddity::PositionBelowRoot, line, name.clone());
        }
        if channels
            .iter()
            .any(|channel| !channel.is_position() && !channel.is_rotation())
        {
            self.oddities.note_oddity(BvhOddity::ScaleChannel, line, name);
        }
    }

    fn end_site(&mut self, word: &str, line: u64) -> Result<(), BvhError> {
        let Some(joint) = self.open.last().map(|open| open.joint) else {
            return Ok(());
        };
        let rest_bytes = self
            .source
            .take_until(|b| matches!(b, b'\n' | b'\r' | b'{' | b'}'))?
            .trim_ascii();
        let rest = String::from_utf8_lossy(rest_bytes).into_owned();
        let spelling = format!("{word} {rest}");
        // After `EndSite` in one word all of the rest is a name.
        let name = rest
            .get(..4)
            .filter(|site| site.eq_ignore_ascii_case("site"))
            .map_or(&rest[..], |_| rest[4..].trim());
        if !name.is_empty() {
            self.oddities.note_oddity(
                BvhOddity::EndSiteName,
                line,
                format!("{:?}", shown_token_bytes(name.as_bytes())),
            );
        } else if spelling.trim() != "End Site" {
            self.oddities
                .note_oddity(BvhOddity::KeywordCase, line, format!("{:?}", spelling.trim()));
        }
        self.brace()?;
        let (token, offset_line) = self.take_hierarchy_token()?;
        match token {
            HierarchyToken::Word(word) if self.is_bvh_keyword(&word, "OFFSET", offset_line) => {}
            other => {
                let expected = "the OFFSET of an End Site";
                return Err(BvhErrorKind::Unexpected {
                    found: other.shown_hierarchy_token(),
                    expected,
                }
                .error_at_line(offset_line));
            }
        }
        let offset = self.three_numbers(joint, offset_line)?;
        self.ends += 1;
        if self.ends > END_SITE_LIMIT {
            return Err(BvhErrorKind::TooMany {
                limit: END_SITE_LIMIT,
                what: "End Sites",
            }
            .error_at_line(line));
        }
        self.hierarchy.joints[joint].end_sites.push(offset);
        match self.take_hierarchy_token()? {
            (HierarchyToken::Close, _) => Ok(()),
            (HierarchyToken::End, at) => Err(self.unclosed_joint_error("the end of the file", at)),
            (other, at) => {
                let expected = "the \"}\" of an End Site";
                Err(BvhErrorKind::Unexpected {
                    found: other.shown_hierarchy_token(),
                    expected,
                }
                .error_at_line(at))
            }
        }
    }

    /// Closes the innermost joint and records missing parts.
    fn close_open_joint(&mut self) {
        let Some(open) = self.open.pop() else { return };
        let joint = &self.hierarchy.joints[open.joint];
        let name = format!("{:?}", joint.name);
        let oddities = [
            (BvhOddity::NoOffset, !open.has_offset),
            (BvhOddity::NoChannels, joint.channels.is_empty()),
            (BvhOddity::NoEndSite, joint.end_sites.is_empty() && !open.has_children),
            (
                BvhOddity::EndSiteBesideChildren,
                !joint.end_sites.is_empty() && open.has_children,
            ),
            (BvhOddity::SeveralEndSites, joint.end_sites.len() > 1),
        ];
        for (kind, _) in oddities.into_iter().filter(|(_, is_so)| *is_so) {
            self.oddities.note_oddity(kind, open.line, name.clone());
        }
    }

    /// Returns whether MOTION follows; anything but MOTION or the end of the file is an error.
    fn motion_follows(&mut self) -> Result<bool, BvhError> {
        let (token, line) = self.take_hierarchy_token()?;
        match token {
            HierarchyToken::End => {
                self.oddities.note_oddity(BvhOddity::NoMotion, line, "");
                Ok(false)
            }
            HierarchyToken::Word(word) if word.eq_ignore_ascii_case("ROOT") => {
                Err(BvhErrorKind::SecondRoot.error_at_line(line))
            }
            HierarchyToken::Word(word) if self.is_bvh_keyword(&word, "MOTION", line) => Ok(true),
            other => Err(BvhErrorKind::Unexpected {
                found: other.shown_hierarchy_token(),
                expected: "MOTION",
            }
            .error_at_line(line)),
        }
    }

    fn note_names(&mut self) {
        let mut names = BTreeSet::new();
        for (joint, &line) in self.hierarchy.joints.iter().zip(&self.lines) {
            if !joint.name.is_empty() && !names.insert(joint.name.as_str()) {
                self.oddities
                    .note_oddity(BvhOddity::DuplicateName, line, format!("{:?}", joint.name));
            }
        }
    }

    fn unclosed_joint_error(&self, before: &'static str, line: u64) -> BvhError {
        let innermost = self.open.last();
        let joint = innermost
            .map(|open| self.hierarchy.joints[open.joint].name.clone())
            .unwrap_or_default();
        BvhErrorKind::Unclosed {
            joint,
            opened: innermost.map_or(line, |open| open.line),
            before,
        }
        .error_at_line(line)
    }

    fn keyword(&mut self, keyword: &'static str) -> Result<(), BvhError> {
        match self.take_hierarchy_token()? {
            (HierarchyToken::Word(word), line) if self.is_bvh_keyword(&word, keyword, line) => Ok(()),
            (other, line) => Err(BvhErrorKind::Unexpected {
                found: other.shown_hierarchy_token(),
                expected: keyword,
            }
            .error_at_line(line)),
        }
    }

    /// Returns whether the word is the keyword; records a different case of its letters.
    fn is_bvh_keyword(&mut self, word: &str, keyword: &str, line: u64) -> bool {
        let same = word.eq_ignore_ascii_case(keyword);
        if same && word != keyword {
            self.oddities
                .note_oddity(BvhOddity::KeywordCase, line, format!("{word:?}"));
        }
        same
    }

    /// Takes the next token and returns it with its line.
    fn take_hierarchy_token(&mut self) -> Result<(HierarchyToken, u64), BvhError> {
        let Some(byte) = self.source.skip_blanks()? else {
            return Ok((HierarchyToken::End, self.source.byte_source_line()));
        };
        let line = self.source.byte_source_line();
        if matches!(byte, b'{' | b'}') {
            self.source.take_source_byte();
            return Ok((
                if byte == b'{' {
                    HierarchyToken::Open
                } else {
                    HierarchyToken::Close
                },
                line,
            ));
        }
        let word = self.source.take_until(|b| is_blank(b) || matches!(b, b'{' | b'}'))?;
        Ok((HierarchyToken::Word(String::from_utf8_lossy(word).into_owned()), line))
    }
}

impl HierarchyToken {
    fn shown_hierarchy_token(&self) -> String {
        match self {
            Self::Open => "{".to_owned(),
            Self::Close => "}".to_owned(),
            Self::Word(word) => shown_token_bytes(word.as_bytes()),
            Self::End => "the end of the file".to_owned(),
        }
    }
}

fn is_end(word: &str) -> bool {
    word.eq_ignore_ascii_case("End") || word.eq_ignore_ascii_case("EndSite")
}
