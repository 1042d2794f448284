//! Decoding of H.264 by the program itself, with `rusty_h264` behind [`FrameDecoder`].

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use chereme_formats::mp4::{Mp4Container, PictureColours, mp4_h264};
use rusty_h264::Decoder;

use super::colours::PicturePlanes;
use super::{CorpusError, CorpusResult, FrameDecoder};
use crate::foreign_code::catch_panic;

/// The largest coded picture in bytes.
const MAX_CODED_PICTURE_BYTES: u32 = 64 << 20;
/// Marks a decoding position that displays no frame.
const HIDDEN_FRAME_MARK: usize = usize::MAX;

/// A film of H.264 in a file.
pub(super) struct H264Film {
    file: File,
    path: PathBuf,
    container: Mp4Container,
    configuration: mp4_h264::AvcConfiguration,
    colours: Option<PictureColours>,
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

impl H264Film {
    /// Prepares the decoder.
    ///
    /// # Errors
    /// The reason why this decoder cannot read the film.
    pub(super) fn new(file: File, path: &Path, container: Mp4Container) -> std::result::Result<Self, String> {
        let parsed = mp4_h264::read_avc_configuration(&container.configuration);
        let configuration = parsed.map_err(|error| error.to_string())?;
        let mut colours = container.colours;
        let sequences = configuration.sets.iter();
        if let Some(set) = sequences.clone().find(|set| mp4_h264::is_sequence(set)) {
            let sequence = mp4_h264::read_sequence_parameters(set).map_err(|error| error.to_string())?;
            // The decoder knows no profile above High, which this number stands for.
            if sequence.profile > 100 {
                return Err("H.264 of a profile with more than 8 bits, or 4:2:2".to_owned());
            }
            // The stream takes precedence over the container.
            let stated_colours = sequence.colours.filter(|stated| stated.matrix != 2);
            let full = sequence.colours.is_some_and(|stated| stated.full_range);
            colours = stated_colours.or(colours).map(|stated| PictureColours {
                full_range: stated.full_range || full,
                ..stated
            });
            if colours.is_none() && full {
                colours = sequence.colours;
            }
        }
        let order = container.shown_order();
        let mut shows = vec![HIDDEN_FRAME_MARK; container.frames.len()];
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
    fn decode_one_picture(&mut self, at: usize, fresh: bool) -> std::result::Result<Option<PicturePlanes>, String> {
        let frame = self.container.frames[at];
        // A damaged index may state any size.
        if frame.size > MAX_CODED_PICTURE_BYTES {
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
        // Where decoding can begin, the decoder needs the parameter sets before the picture.
        let sets = fresh || frame.sync;
        mp4_h264::annex_b(&self.configuration, &self.coded, sets, &mut self.stream)
            .map_err(|error| error.to_string())?;
        // After a panic the decoder is discarded.
        let decoded = catch_panic(|| self.decoder.decode(&self.stream));
        match decoded {
            Some(Ok(picture)) => Ok(picture.map(|decoded| PicturePlanes {
                width: decoded.width,
                height: decoded.height,
                y: decoded.y,
                u: decoded.u,
                v: decoded.v,
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
        let mut pieces = mp4_h264::split_stream_pieces(&self.stream);
        let slice = pieces.find(|piece| matches!(piece.first().map(|first| first & 31), Some(1 | 5)));
        slice.is_some_and(|piece| piece[0] & 0x60 == 0)
    }
}

impl FrameDecoder for H264Film {
    fn decode_film_frames(
        &mut self,
        frame: usize,
        stop: &dyn Fn() -> bool,
        keep: &mut dyn FnMut(usize, PicturePlanes),
    ) -> CorpusResult<()> {
        let target = self.order[frame];
        let begin = self.container.sync_before(target);
        let shown = |at: usize| self.container.frames[at].shown;
        // A picture before the floor needs others that were skipped, so decoding begins earlier for it.
        let is_above_floor = shown(target) >= self.floor;
        let on = self
            .next
            .filter(|next| is_above_floor && (begin..=target).contains(next));
        let mut fresh = on.is_none();
        if fresh {
            self.decoder = Decoder::new();
            self.floor = self.container.frames[begin].shown;
        }
        let mut picture_index = on.unwrap_or(begin);
        let path = self.path.display().to_string();
        let broken = |reason: &str| {
            CorpusError::from_wrong_message(format!("frame {frame} of the film cannot be decoded: {reason}"))
                .with_error_place(path.clone())
                .with_advice("the file is damaged there; copy it again, or look at another frame")
        };
        loop {
            if stop() {
                self.next = (!fresh).then_some(picture_index);
                return Err(CorpusError::Stopped);
            }
            let decoded = self.decode_one_picture(picture_index, fresh);
            fresh = false;
            let leads = self.container.frames[picture_index].shown < self.floor;
            match decoded {
                _ if leads && picture_index != target => {}
                Ok(Some(planes)) => {
                    if self.shows[picture_index] != HIDDEN_FRAME_MARK {
                        keep(self.shows[picture_index], planes);
                    }
                }
                Ok(None) if picture_index == target => {
                    self.next = Some(picture_index + 1);
                    return Err(broken("it is not whole"));
                }
                Ok(None) => {}
                // Nothing depends on this picture, and it is not the one that is wanted.
                Err(_) if picture_index != target && self.is_spare() => {}
                Err(reason) => {
                    // The following pictures depend on it until decoding can begin again.
                    self.next = None;
                    return Err(broken(&reason));
                }
            }
            if picture_index == target {
                self.next = Some(picture_index + 1);
                return Ok(());
            }
            picture_index += 1;
        }
    }
}
