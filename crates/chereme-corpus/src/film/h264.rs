//! Decoding of H.264 by the program itself, with `rusty_h264` behind [`Decode`].

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use chereme_formats::mp4::{Colours, Container, h264};
use rusty_h264::Decoder;

use super::colours::Planes;
use super::{Decode, Error, Result};
use crate::foreign_code::catch_panic;

/// The largest coded picture in bytes.
const LARGEST: u32 = 64 << 20;
/// Marks a decoding position that displays no frame.
const HIDDEN: usize = usize::MAX;

/// A film of H.264 in a file.
pub(super) struct Own {
    file: File,
    path: PathBuf,
    container: Container,
    configuration: h264::Configuration,
    colours: Option<Colours>,
    /// The decoding positions of frames in display order.
    order: Vec<usize>,
    /// The frame that each decoding position displays.
    shows: Vec<usize>,
    decoder: Decoder,
    /// The next decoding position, if the decoder has begun.
    next: Option<usize>,
    /// Pictures displayed before this point depend on others that were not decoded.
    floor: i64,
    coded: Vec<u8>,
    stream: Vec<u8>,
}

impl Own {
    /// Prepares the decoder.
    ///
    /// # Errors
    /// The reason why this decoder cannot read the film.
    pub(super) fn new(
        file: File,
        path: &Path,
        container: Container,
    ) -> std::result::Result<Self, String> {
        let said = h264::configuration(&container.configuration);
        let configuration = said.map_err(|error| error.to_string())?;
        let mut colours = container.colours;
        let sequences = configuration.sets.iter();
        if let Some(set) = sequences.clone().find(|set| h264::is_sequence(set)) {
            let sequence = h264::sequence(set).map_err(|error| error.to_string())?;
            if sequence.profile > 100 {
                return Err("H.264 of a profile with more than 8 bits, or 4:2:2".to_owned());
            }
            // The stream takes precedence over the container.
            let said = sequence.colours.filter(|it| it.matrix != 2);
            let full = sequence.colours.is_some_and(|it| it.full_range);
            colours = said.or(colours).map(|it| Colours {
                full_range: it.full_range || full,
                ..it
            });
            if colours.is_none() && full {
                colours = sequence.colours;
            }
        }
        let order = container.shown_order();
        let mut shows = vec![HIDDEN; container.frames.len()];
        for (frame, at) in order.iter().enumerate() {
            shows[*at] = frame;
        }
        Ok(Self {
            file,
            path: path.to_owned(),
            container,
            configuration,
            colours,
            order,
            shows,
            decoder: Decoder::new(),
            next: None,
            floor: 0,
            coded: Vec::new(),
            stream: Vec::new(),
        })
    }

    /// Decodes the picture at a decoding position; `fresh` means that decoding begins there.
    fn one(&mut self, at: usize, fresh: bool) -> std::result::Result<Option<Planes>, String> {
        let frame = self.container.frames[at];
        if frame.size > LARGEST {
            return Err(format!("a coded picture of {} bytes", frame.size));
        }
        self.coded.clear();
        let from = self.file.seek(SeekFrom::Start(frame.offset));
        from.map_err(|error| error.to_string())?;
        let mut piece = (&mut self.file).take(u64::from(frame.size));
        let read = piece.read_to_end(&mut self.coded);
        if read.map_err(|error| error.to_string())? < frame.size as usize {
            return Err("the file is cut short".to_owned());
        }
        self.stream.clear();
        let sets = fresh || frame.sync;
        h264::annex_b(&self.configuration, &self.coded, sets, &mut self.stream)
            .map_err(|error| error.to_string())?;
        // After a panic the decoder is discarded.
        let decoded = catch_panic(|| self.decoder.decode(&self.stream));
        match decoded {
            Some(Ok(picture)) => Ok(picture.map(|it| Planes {
                width: it.width,
                height: it.height,
                y: it.y,
                u: it.u,
                v: it.v,
                colours: self.colours,
            })),
            Some(Err(error)) => Err(error.to_string()),
            None => {
                self.decoder = Decoder::new();
                Err("the decoder gave up".to_owned())
            }
        }
    }

    /// Returns whether no other picture depends on the one that was read last.
    fn is_spare(&self) -> bool {
        let mut pieces = h264::pieces(&self.stream);
        let slice = pieces.find(|it| matches!(it.first().map(|first| first & 31), Some(1 | 5)));
        slice.is_some_and(|it| it[0] & 0x60 == 0)
    }
}

impl Decode for Own {
    fn decode(
        &mut self,
        frame: usize,
        stop: &dyn Fn() -> bool,
        keep: &mut dyn FnMut(usize, Planes),
    ) -> Result<()> {
        let target = self.order[frame];
        let begin = self.container.sync_before(target);
        let shown = |at: usize| self.container.frames[at].shown;
        let whole = shown(target) >= self.floor;
        let on = self
            .next
            .filter(|next| whole && (begin..=target).contains(next));
        let mut fresh = on.is_none();
        if fresh {
            self.decoder = Decoder::new();
            self.floor = self.container.frames[begin].shown;
        }
        let mut at = on.unwrap_or(begin);
        let path = self.path.display().to_string();
        let broken = |reason: &str| {
            Error::wrong(format!(
                "frame {frame} of the film cannot be decoded: {reason}"
            ))
            .at(path.clone())
            .advise("the file is damaged there; copy it again, or look at another frame")
        };
        loop {
            if stop() {
                self.next = (!fresh).then_some(at);
                return Err(Error::Stopped);
            }
            let decoded = self.one(at, fresh);
            fresh = false;
            let leads = self.container.frames[at].shown < self.floor;
            match decoded {
                _ if leads && at != target => {}
                Ok(Some(planes)) => {
                    if self.shows[at] != HIDDEN {
                        keep(self.shows[at], planes);
                    }
                }
                Ok(None) if at == target => {
                    self.next = Some(at + 1);
                    return Err(broken("it is not whole"));
                }
                Ok(None) => {}
                Err(_) if at != target && self.is_spare() => {}
                Err(reason) => {
                    // The following pictures depend on it until decoding can begin again.
                    self.next = None;
                    return Err(broken(&reason));
                }
            }
            if at == target {
                self.next = Some(at + 1);
                return Ok(());
            }
            at += 1;
        }
    }
}
