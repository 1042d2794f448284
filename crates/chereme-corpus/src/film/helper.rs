//! Decoding of other films through the `ffmpeg` of the computer.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};

use chereme_formats::mp4::{self, PictureColours};

use super::colours::PicturePlanes;
use super::{CorpusError, CorpusResult, FilmFacts, FilmTimes, FrameDecoder};

const FFMPEG_PROGRAM: &str = "ffmpeg";
/// The largest side of a picture that is decoded.
const MAX_DECODED_SIDE_PIXELS: usize = 8192;

/// Returns whether `ffmpeg` is installed.
pub(super) fn is_there() -> bool {
    let mut command = quiet_ffmpeg_command();
    command.arg("-version").stdout(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

fn quiet_ffmpeg_command() -> Command {
    let mut command = Command::new(FFMPEG_PROGRAM);
    command
        .args(["-nostdin", "-v", "error"])
        .stdin(Stdio::null())
        .stderr(Stdio::null());
    command
}

/// Opens a film; its index is given if it is an MP4.
pub(super) fn open_ffmpeg_film(
    path: &Path,
    known: Option<(mp4::Mp4Container, Vec<String>)>,
) -> CorpusResult<(FilmFacts, FilmTimes, FfmpegFilm)> {
    let failed = |reason: String| {
        CorpusError::from_wrong_message(format!("the film cannot be played: {reason}"))
            .with_error_place(path.display().to_string())
            .with_advice("export or copy it again from where it was recorded")
    };
    let (coding, size, turn, colours, times, findings) = match known {
        Some((container, findings)) => (
            container.coding_name().to_owned(),
            [container.width as usize, container.height as usize],
            container.turn,
            container.colours,
            super::container_film_times(&container),
            findings,
        ),
        None => {
            let listed = list_film_frames(path).map_err(failed)?;
            let coding = "coding known to ffmpeg".to_owned();
            let turn = mp4::PictureRotation::None;
            (coding, listed.0, turn, None, listed.1, Vec::new())
        }
    };
    let [width, height] = size;
    if !(1..=MAX_DECODED_SIDE_PIXELS).contains(&width) || !(1..=MAX_DECODED_SIDE_PIXELS).contains(&height) {
        return Err(failed(format!("pictures of {width} by {height} pixels")));
    }
    let mut helper = FfmpegFilm {
        path: path.to_owned(),
        size,
        colours,
        starts: (0..times.film_frame_count())
            .map(|frame| times.film_frame_start(frame))
            .collect(),
        running: None,
    };
    // Only a decoded picture shows that the film can be played at all.
    helper.decode_film_frames(0, &|| false, &mut |_, _| {})?;
    let [shown_width, shown_height] = turn.rotated_picture_size(size);
    let facts = FilmFacts {
        coding,
        width: shown_width,
        height: shown_height,
        frames: times.film_frame_count(),
        rate: times.mean_picture_rate(),
        duration_us: times.film_end(),
        turn,
        decoder: FFMPEG_PROGRAM,
        findings,
    };
    Ok((facts, times, helper))
}

/// Returns the size of a film and the times of its frames, which `ffmpeg` lists without decoding them.
fn list_film_frames(path: &Path) -> std::result::Result<([usize; 2], FilmTimes), String> {
    let mut command = quiet_ffmpeg_command();
    command.arg("-i").arg(path);
    command.args(["-map", "0:v:0", "-c", "copy", "-f", "framecrc", "-"]);
    let output = command.output().map_err(|error| error.to_string())?;
    let text = String::from_utf8_lossy(&output.stdout);
    let value_of = |key: &str| text.lines().find_map(|line| line.strip_prefix(key));
    let parts = |text: &str, between: char| -> Option<(i64, i64)> {
        let (a, b) = text.trim().split_once(between)?;
        Some((a.trim().parse().ok()?, b.trim().parse().ok()?))
    };
    let base = value_of("#tb 0:").and_then(|text| parts(text, '/'));
    let size = value_of("#dimensions 0:").and_then(|text| parts(text, 'x'));
    let (Some((part, whole)), Some((width, height))) = (base, size) else {
        return Err("ffmpeg finds no pictures in it".to_owned());
    };
    let micros = |ticks: i64| {
        let scaled = i128::from(ticks) * i128::from(part) * 1_000_000;
        i64::try_from(scaled / i128::from(whole.max(1))).unwrap_or_default()
    };
    let mut rows: Vec<(i64, i64)> = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .filter_map(|line| {
            let mut cells = line.split(',').skip(2);
            let shown: i64 = cells.next()?.trim().parse().ok()?;
            let lasts: i64 = cells.next()?.trim().parse().ok()?;
            Some((shown, lasts))
        })
        .collect();
    // The list is in the order of decoding, while frames are counted as they are shown.
    rows.sort_unstable();
    let Some((last, lasts)) = rows.last().copied() else {
        return Err("it has no frames".to_owned());
    };
    // Times count from the start of the film, as in its own index.
    let times = FilmTimes {
        starts: rows.iter().map(|row| micros(row.0)).collect(),
        end: micros(last.saturating_add(lasts.max(1))),
        sync: vec![true; rows.len()],
    };
    Ok(([width.unsigned_abs() as usize, height.unsigned_abs() as usize], times))
}

/// A film that `ffmpeg` decodes from any frame on.
pub(super) struct FfmpegFilm {
    path: PathBuf,
    size: [usize; 2],
    colours: Option<PictureColours>,
    starts: Vec<i64>,
    running: Option<RunningFfmpeg>,
}

/// A running `ffmpeg` process.
struct RunningFfmpeg {
    child: Child,
    pictures: ChildStdout,
    next: usize,
}

impl Drop for RunningFfmpeg {
    fn drop(&mut self) {
        // The process would otherwise wait for ever for somebody to read its pictures.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The most frames that are decoded and dropped before `ffmpeg` is started again instead.
const MAX_DROPPED_FRAMES: usize = 48;

impl FfmpegFilm {
    fn begin_ffmpeg_at(&mut self, frame: usize) -> CorpusResult<()> {
        self.running = None;
        let mut command = quiet_ffmpeg_command();
        // The rotation is applied here, as for the other decoder.
        command.arg("-noautorotate");
        if frame > 0 {
            // Seeks half a frame earlier, so that rounding does not skip the frame.
            let (before, start) = (self.starts[frame - 1], self.starts[frame]);
            let from = start - (start - before) / 2 - self.starts[0];
            command.args(["-ss", &format!("{:.6}", from as f64 / 1e6)]);
        }
        command.arg("-i").arg(&self.path);
        command.args(["-an", "-sn", "-map", "0:v:0", "-fps_mode", "passthrough"]);
        command.args(["-f", "rawvideo", "-pix_fmt", "yuv420p", "pipe:1"]);
        let fault = |error| CorpusError::from_file_failure(FFMPEG_PROGRAM, error);
        let mut child = command.stdout(Stdio::piped()).spawn().map_err(fault)?;
        let stdout = child.stdout.take();
        let pictures = stdout.ok_or_else(|| fault(std::io::ErrorKind::BrokenPipe.into()))?;
        self.running = Some(RunningFfmpeg {
            child,
            pictures,
            next: frame,
        });
        Ok(())
    }
}

impl FrameDecoder for FfmpegFilm {
    fn decode_film_frames(
        &mut self,
        frame: usize,
        stop: &dyn Fn() -> bool,
        keep: &mut dyn FnMut(usize, PicturePlanes),
    ) -> CorpusResult<()> {
        let next = self.running.as_ref().map(|running| running.next);
        // Decoding a few frames more is faster than starting the program again.
        if !next.is_some_and(|next| (next..next + MAX_DROPPED_FRAMES).contains(&frame)) {
            self.begin_ffmpeg_at(frame)?;
        }
        let [width, height] = self.size;
        let part = width.div_ceil(2) * height.div_ceil(2);
        while let Some(running) = &mut self.running {
            if stop() {
                return Err(CorpusError::Stopped);
            }
            let mut read = |size: usize| {
                let mut bytes = vec![0; size];
                running.pictures.read_exact(&mut bytes).map(|()| bytes)
            };
            let planes = read(width * height).and_then(|y| Ok((y, read(part)?, read(part)?)));
            let frame_index = running.next;
            running.next += 1;
            let Ok((y, u, v)) = planes else {
                self.running = None;
                return Err(CorpusError::from_wrong_message(format!(
                    "frame {frame} of the film cannot be decoded by ffmpeg"
                ))
                .with_error_place(self.path.display().to_string())
                .with_advice("the file is damaged there; copy it again, or look at another frame"));
            };
            let colours = self.colours;
            let planes = PicturePlanes {
                width,
                height,
                y,
                u,
                v,
                colours,
            };
            keep(frame_index, planes);
            if frame_index == frame {
                return Ok(());
            }
        }
        Ok(())
    }
}
