//! Hierarchy first, then the motion in blocks of frames, in bounded memory.

use std::io::Read;

use super::block::{raise_column_scale, settle_column_scale};
use super::digits::{ColumnState, TILE_ROW_COUNT, read_numbers};
use super::oddity::{BvhOddities, BvhOddity};
use super::raw_parse::read_head;
use super::raw_source::{ByteSource, is_blank, shown_token_bytes};
use super::root_order::RootOrder;
use super::{
    BvhError, BvhErrorKind, BvhHierarchy, BvhMotionHeader, ChannelFix, Column, FileNumber, MotionBlock, NotANumber,
};
use crate::ImportFinding;

/// Most bytes per block of numbers that are too long for a mantissa.
const LONG_NUMBERS_LIMIT: usize = 32 << 20;

/// Options of the reader.
#[derive(Clone, Copy, Debug)]
pub struct BvhReadOptions {
    /// The frames per block, at least 1.
    pub block_frames: usize,
}

impl Default for BvhReadOptions {
    fn default() -> Self {
        Self { block_frames: 256 }
    }
}

/// Reads a BVH file: opening it reads the hierarchy, and the motion is then pulled block by block.
///
/// Memory is bounded by the hierarchy and one block, whatever the file's size and whatever its header claims.
pub struct BvhReader<R> {
    source: ByteSource<R>,
    oddities: BvhOddities,
    hierarchy: BvhHierarchy,
    header: BvhMotionHeader,
    root_order: RootOrder,
    options: BvhReadOptions,
    /// The full rows read so far.
    rows: u64,
    ended: bool,
    columns: Vec<ColumnState>,
    tile: Vec<[i64; TILE_ROW_COUNT]>,
    /// The full rows in the tile.
    tile_rows: usize,
    /// The columns already read of the row after those.
    column: usize,
    /// The numbers already read on this line.
    on_line: u64,
    motion_line: u64,
    /// The bytes of numbers too long for a mantissa in this block.
    long_numbers: usize,
    /// The line and width of a row that ended before its last column.
    short: Option<(u64, u64)>,
}

/// The results of reading a whole file.
#[derive(Clone, Debug)]
pub struct BvhReadSummary {
    /// The frames read.
    pub frames: u64,
    /// The oddities, in the order of the lines.
    pub findings: Vec<ImportFinding>,
    /// The actual order of the root's columns, if it differs from CHANNELS.
    pub root_fix: Option<ChannelFix>,
}

impl<R: Read> BvhReader<R> {
    /// Reads the hierarchy and the header of the motion.
    ///
    /// # Errors
    /// [`BvhError`] if the bytes are not a BVH file, or its hierarchy or header has no clear meaning.
    pub fn open_bvh(read: R) -> Result<Self, BvhError> {
        Self::open_with(read, BvhReadOptions::default())
    }

    /// Reads the hierarchy and the header of the motion, with options.
    ///
    /// # Errors
    /// The same as [`BvhReader::open_bvh`]'s.
    pub fn open_with(read: R, options: BvhReadOptions) -> Result<Self, BvhError> {
        let mut source = ByteSource::new(read);
        let mut oddities = BvhOddities::default();
        let (hierarchy, header) = read_head(&mut source, &mut oddities)?;
        let channels = hierarchy.channel_count();
        Ok(Self {
            root_order: RootOrder::new(&hierarchy),
            motion_line: source.byte_source_line(),
            ended: !header.has_motion,
            source,
            oddities,
            hierarchy,
            header,
            options: BvhReadOptions {
                block_frames: options.block_frames.max(1),
            },
            rows: 0,
            columns: vec![ColumnState::default(); channels],
            tile: vec![[0; TILE_ROW_COUNT]; channels],
            tile_rows: 0,
            column: 0,
            on_line: 0,
            long_numbers: 0,
            short: None,
        })
    }

    /// Returns the joints.
    #[must_use]
    pub fn bvh_hierarchy(&self) -> &BvhHierarchy {
        &self.hierarchy
    }

    /// Returns the header of the motion.
    #[must_use]
    pub fn bvh_motion_header(&self) -> &BvhMotionHeader {
        &self.header
    }

    /// Returns the number of bytes read so far, for a progress bar.
    #[must_use]
    pub fn bytes_read(&self) -> u64 {
        self.source.bytes_read()
    }

    /// Reads the next frames into the block, whose buffers are reused; returns false at the end of the
    /// motion.
    ///
    /// # Errors
    /// [`BvhError`] with its line for a number or a row without a clear meaning; the reader cannot be used
    /// afterwards.
    pub fn next_block(&mut self, block: &mut MotionBlock) -> Result<bool, BvhError> {
        self.begin_motion_block(block);
        self.long_numbers = 0;
        while !self.ended && block.frames + self.tile_rows < self.options.block_frames {
            self.read_row_step(block)?;
        }
        self.spread_tile(block);
        for (column, state) in block.columns.iter_mut().zip(&mut self.columns) {
            *state = ColumnState::new(settle_column_scale(column, *state));
        }
        self.root_order.watch_motion_block(block);
        Ok(block.frames > 0)
    }

    /// Returns the summary of the frames read so far.
    #[must_use]
    pub fn finish_bvh_reading(mut self) -> BvhReadSummary {
        let root_fix = self.root_order.root_channel_fix();
        self.note_ending(root_fix);
        BvhReadSummary {
            frames: self.rows,
            findings: self.oddities.oddity_findings(),
            root_fix,
        }
    }

    fn begin_motion_block(&self, block: &mut MotionBlock) {
        block.first_frame = self.rows;
        block.frames = 0;
        block.columns.resize_with(self.columns.len(), Column::default);
        for (column, state) in block.columns.iter_mut().zip(&self.columns) {
            column.scale = state.column_decimal_scale();
            column.mantissas.clear();
            column.exceptions.clear();
        }
    }

    /// Reads numbers up to the end of a row, or one number, or the end.
    fn read_row_step(&mut self, block: &mut MotionBlock) -> Result<(), BvhError> {
        if self.next_is_number(block)? {
            // After a row that ended early any number is an error, which the slow way reports.
            if self.short.is_none() {
                let tokens = self.source.whole_tokens();
                let slots = &mut self.tile[self.column..];
                let states = &mut self.columns[self.column..];
                let (done, length) = read_numbers(tokens, self.tile_rows, slots, states);
                self.source.advance_source_bytes(length);
                self.column += done;
                self.on_line += done as u64;
                if done > 0 {
                    return self.end_row(block);
                }
            }
            self.slow_number(block)?;
        }
        Ok(())
    }

    /// Skips blanks and closes lines; returns whether a token follows.
    fn next_is_number(&mut self, block: &mut MotionBlock) -> Result<bool, BvhError> {
        loop {
            match self.source.peek_source_byte()? {
                None => {
                    self.end_motion(block)?;
                    return Ok(false);
                }
                Some(b'\n' | b'\r') => self.end_line(),
                Some(byte) if is_blank(byte) => {}
                Some(_) => return Ok(true),
            }
            self.source.take_source_byte();
        }
    }

    fn end_line(&mut self) {
        if self.column != 0 && self.short.is_none() {
            self.short = Some((self.source.byte_source_line(), self.on_line));
        } else if self.on_line > self.columns.len() as u64 {
            self.oddities
                .note_oddity(BvhOddity::SeveralFramesOnLine, self.source.byte_source_line(), "");
        }
        self.on_line = 0;
    }

    /// Reads one token of any form.
    fn slow_number(&mut self, block: &mut MotionBlock) -> Result<(), BvhError> {
        let line = self.source.byte_source_line();
        let token = self.source.take_until(is_blank)?.to_vec();
        let number = match FileNumber::parse_file_number(&token) {
            Err(why) => return self.no_number(&token, why, line),
            Ok(number) => number,
        };
        if let Some((line, found)) = self.short {
            return Err(self.width_error(line, found));
        }
        if self.columns.is_empty() {
            return Err(self.width_error(line, 1));
        }
        if matches!(number, FileNumber::Text(_)) {
            // Long numbers are kept as text, which hostile files could use to fill memory.
            self.long_numbers += token.len();
        }
        if self.long_numbers > LONG_NUMBERS_LIMIT {
            let what = "bytes of numbers with more than eighteen digits in one block of frames";
            return Err(BvhErrorKind::TooMany {
                limit: LONG_NUMBERS_LIMIT,
                what,
            }
            .error_at_line(line));
        }
        self.put_row_number(number, block);
        self.column += 1;
        self.on_line += 1;
        self.end_row(block)
    }

    fn no_number(&mut self, token: &[u8], why: NotANumber, line: u64) -> Result<(), BvhError> {
        let all_frames = self.header.declared_frames.is_some_and(|all| self.rows >= all);
        let between_rows = self.column == 0 && self.on_line == 0 && self.short.is_none();
        // Text after the last row that was announced does no harm.
        if why == NotANumber::Garbage && all_frames && between_rows {
            self.oddities.note_oddity(
                BvhOddity::TextAfterMotion,
                line,
                format!("{:?}", shown_token_bytes(token)),
            );
            self.ended = true;
            return Ok(());
        }
        if let Some((line, found)) = self.short {
            return Err(self.width_error(line, found));
        }
        // A number that the end of the file cuts off becomes valid with another digit.
        if self.source.peek_source_byte()?.is_none() && FileNumber::parse_file_number(&[token, b"0"].concat()).is_ok() {
            self.column_cut(line);
            return Ok(());
        }
        let channel_place = self.hierarchy.channel_at(self.column);
        let (joint, channel) = channel_place.map_or((String::new(), "no channel"), |(joint, c)| {
            (joint.name.clone(), c.channel_word())
        });
        Err(BvhErrorKind::BadValue {
            column: self.column + 1,
            joint,
            channel,
            found: shown_token_bytes(token),
            why,
        }
        .error_at_line(line))
    }

    /// Records that the file ends inside a number, such as `-` or `1e`.
    fn column_cut(&mut self, line: u64) {
        if self.column == 0 {
            let detail = format!("0 numbers of {}", self.columns.len());
            self.oddities.note_oddity(BvhOddity::Truncated, line, detail);
        }
    }

    /// Puts a number into the current row; raises its column's scale if needed and possible.
    fn put_row_number(&mut self, number: FileNumber, block: &mut MotionBlock) {
        let (index, row) = (self.column, self.tile_rows);
        let frame = (block.frames + row) as u32;
        let (column, state) = (&mut block.columns[index], &mut self.columns[index]);
        let (above, below) = self.tile[index].split_at_mut(row);
        let slot = &mut below[0];
        *slot = 0;
        if let FileNumber::Decimal(decimal) = number {
            if let Some(fitted) = state.fit_column_mantissa(decimal.mantissa, decimal.scale) {
                *slot = fitted;
                return;
            }
            if decimal.scale > state.column_decimal_scale() && raise_column_scale(column, decimal.scale, above) {
                state.set_scale(decimal.scale);
                *slot = decimal.mantissa;
                return;
            }
        }
        column.exceptions.push((frame, number));
    }

    /// Closes the row if it is full.
    fn end_row(&mut self, block: &mut MotionBlock) -> Result<(), BvhError> {
        if self.column == self.columns.len() {
            self.column = 0;
            self.tile_rows += 1;
            self.rows += 1;
            // A single frame needs no time between frames.
            if self.rows == 2 {
                self.header.check_timed()?;
            }
            if self.tile_rows == TILE_ROW_COUNT {
                self.spread_tile(block);
            }
        }
        Ok(())
    }

    /// Moves the rows of the tile to the columns; called between rows only.
    fn spread_tile(&mut self, block: &mut MotionBlock) {
        let rows = self.tile_rows;
        for (rows_of_column, column) in self.tile.iter().zip(&mut block.columns) {
            column.mantissas.extend_from_slice(&rows_of_column[..rows]);
        }
        block.frames += rows;
        self.tile_rows = 0;
    }

    /// Closes the motion: an incomplete row is dropped if it ends the file.
    fn end_motion(&mut self, block: &mut MotionBlock) -> Result<(), BvhError> {
        self.end_line();
        self.ended = true;
        let Some((line, found)) = self.short else {
            return Ok(());
        };
        let expected = self.columns.len();
        // Where rows share lines, the width of a line says nothing about its last row.
        let many_per_line = line == self.motion_line || self.oddities.has_oddity(BvhOddity::SeveralFramesOnLine);
        if found > expected as u64 && !many_per_line {
            return Err(self.width_error(line, found));
        }
        let detail = format!("{} numbers of {expected}", self.column);
        self.oddities.note_oddity(BvhOddity::Truncated, line, detail);
        let frame = (block.frames + self.tile_rows) as u32;
        for (column, state) in block.columns.iter_mut().zip(&mut self.columns).take(self.column) {
            column.exceptions.retain(|(at, _)| *at != frame);
            state.fewer = 0;
        }
        self.column = 0;
        Ok(())
    }

    fn width_error(&self, line: u64, found: u64) -> BvhError {
        BvhErrorKind::RowWidth {
            found,
            expected: self.columns.len(),
        }
        .error_at_line(line)
    }

    fn note_ending(&mut self, root_fix: Option<ChannelFix>) {
        for (kind, line) in [
            (BvhOddity::CrLf, self.source.cr_lf),
            (BvhOddity::CrOnly, self.source.cr),
        ] {
            line.into_iter()
                .for_each(|line| self.oddities.note_oddity(kind, line, ""));
        }
        if root_fix.is_some() {
            let detail = "columns 4 to 6 stay at the root's OFFSET";
            self.oddities
                .note_oddity(BvhOddity::SwappedRoot, self.motion_line, detail);
        }
        if !self.ended || !self.header.has_motion {
            return;
        }
        match self.header.declared_frames {
            Some(declared) if declared != self.rows => {
                let detail = format!("{declared} frames, but there are {}", self.rows);
                self.oddities
                    .note_oddity(BvhOddity::FrameCountDiffers, self.motion_line, detail);
            }
            _ if self.rows == 0 => self.oddities.note_oddity(BvhOddity::NoFrames, self.motion_line, ""),
            _ => {}
        }
    }
}
