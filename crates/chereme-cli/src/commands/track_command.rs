//! `chereme track`: lists, moves, aligns, renames and removes the tracks of a recording.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{AlignmentSignal, CorpusError, MediaChange, RowName, TrackChange, TrackRow};
use serde_json::json;

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// List the tracks of a recording, or move, align, rename or remove one of them
///
/// A recording has any number of tracks on one clock: movement of skeletons, markers, curves, media. Without an option
/// the tracks are listed. `chereme import CORPUS FILE --into recording:3 --offset 0.48s` imports a file's tracks into
/// an existing recording.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme track mine.chereme recording:3
  chereme track mine.chereme recording:3 pose --offset 0.48s
  chereme track mine.chereme recording:3 \"media 1\" --file films/take.mp4
  chereme track mine.chereme recording:3 pose --align-to body
  chereme track mine.chereme recording:3 pose --align-to markers --channels LEFT_WRIST --with LWRA,LWRB --store")]
pub(crate) struct TrackArgs {
    /// The corpus
    corpus: PathBuf,
    /// The recording, such as recording:3 or recording:"NGT Thanks"
    #[arg(value_parser = parse_recording_address)]
    recording: RowName,
    /// The track's name
    name: Option<String>,
    /// The new start of the track on the recording's clock, such as 0.48s or -12ms
    #[arg(long, value_name = "TIME", value_parser = parse_time_micros, allow_hyphen_values = true, requires = "name",
          conflicts_with_all = ["remove", "align_to"])]
    offset: Option<i64>,
    /// The new path of a film or another media file that was moved
    #[arg(long, value_name = "FILE", requires = "name", conflicts_with_all = ["remove", "align_to"])]
    file: Option<String>,
    /// The new name of the track
    #[arg(long, value_name = "NAME", requires = "name", conflicts_with_all = ["remove", "align_to"])]
    rename: Option<String>,
    /// Remove the track with all its data
    #[arg(long, requires = "name")]
    remove: bool,
    /// Align the track with this one: find the offset with the most similar speeds, of the wrists if no channel is
    /// named
    #[arg(long, value_name = "TRACK", requires = "name", conflicts_with = "remove")]
    align_to: Option<String>,
    /// The joints, points or curves of the track whose speeds are compared
    #[arg(long, value_delimiter = ',', value_name = "NAMES", requires = "align_to")]
    channels: Vec<String>,
    /// The joints, points or curves of the other track
    #[arg(long, value_delimiter = ',', value_name = "NAMES", requires = "align_to")]
    with: Vec<String>,
    /// The largest shift from the present offset
    #[arg(long, value_name = "TIME", value_parser = parse_time_micros, default_value = "30s", requires = "align_to")]
    within: i64,
    /// Move the track to the offset that was found
    #[arg(long, requires = "align_to")]
    store: bool,
}

/// Parses the address of a recording, such as `recording:3`, or its bare name.
pub(super) fn parse_recording_address(text: &str) -> Result<RowName, String> {
    RowName::parse_recording_name(text).map_err(|error| {
        let remedy = error.error_remedy().map(|remedy| remedy.to_string());
        remedy.unwrap_or_else(|| error.to_string())
    })
}

/// Parses a time such as `0.48s`, `480ms` or `-0.48`, in seconds if it has no unit; returns microseconds.
pub(super) fn parse_time_micros(text: &str) -> Result<i64, String> {
    let text = text.trim();
    let (number, factor) = match (text.strip_suffix("ms"), text.strip_suffix('s')) {
        (Some(number), _) => (number, 1e3),
        (None, Some(number)) => (number, 1e6),
        (None, None) => (text, 1e6),
    };
    match number.trim().parse::<f64>() {
        Ok(time) if (time * factor).abs() < 1e15 => Ok((time * factor).round() as i64),
        _ => Err("write a time in seconds such as 0.48s, or 480ms".to_owned()),
    }
}

pub(super) fn run(cli: &CommandLine, args: &TrackArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let Some(name) = &args.name else {
        let tracks = corpus.recording_tracks(&args.recording)?;
        return print_track_rows(&tracks, output);
    };
    if let Some(other) = &args.align_to {
        let (own, other) = (
            AlignmentSignal {
                track: name.clone(),
                channels: args.channels.clone(),
            },
            AlignmentSignal {
                track: other.clone(),
                channels: args.with.clone(),
            },
        );
        let alignment = corpus.align_track(&args.recording, &own, &other, args.within)?;
        output.filled_line(
            "{track} starts at {time} s (now {now} s): correlation {r} with {other}, elsewhere at \
             most {most}, confidence {sure}",
            &[
                &alignment.track,
                &format_args!("{:.3}", alignment.offset_us as f64 / 1e6),
                &format_args!("{:.3}", alignment.offset_now_us as f64 / 1e6),
                &format_args!("{:.2}", alignment.correlation),
                &alignment.to,
                &format_args!("{:.2}", alignment.runner_up),
                &format_args!("{:.2}", alignment.confidence),
            ],
        )?;
        // Below a half another offset fits almost as well.
        if alignment.confidence < 0.5 {
            output.write_output_line(
                "this is uncertain: look at both tracks before you use it, or name other channels",
            )?;
        }
        if args.store {
            corpus.change_track(&args.recording, name, &TrackChange::Offset(alignment.offset_us))?;
        }
        return output.set_json_document(alignment);
    }
    if let Some(file) = &args.file {
        let tracks = corpus.recording_tracks(&args.recording)?;
        let named_track = tracks.iter().find(|track| track.name == *name);
        let track = named_track.ok_or_else(|| no_track(name))?;
        let change = MediaChange::Move(track.id, file.clone());
        corpus.change_media(&args.recording, &change)?;
    }
    let changes = [
        args.offset.map(TrackChange::Offset),
        args.rename.clone().map(TrackChange::Name),
        args.remove.then_some(TrackChange::Remove),
    ];
    let mut after = None;
    for change in changes.into_iter().flatten() {
        after = Some(corpus.change_track(&args.recording, name, &change)?);
    }
    let after = match after {
        Some(after) => after,
        None => {
            // Nothing was changed, so that the track is shown as it is.
            let mut all = corpus.recording_tracks(&args.recording)?;
            all.retain(|track| track.name == *name);
            if all.is_empty() {
                return Err(no_track(name).into());
            }
            all
        }
    };
    print_track_rows(&after, output)
}

fn no_track(name: &str) -> CorpusError {
    CorpusError::from_wrong_message(format!("there is no track {name:?}"))
        .with_error_place(name)
        .with_advice("`chereme track CORPUS RECORDING` lists its tracks")
}

fn print_track_rows(tracks: &[TrackRow], output: &mut CommandOutput) -> Result<()> {
    let seconds = |micros: Option<i64>| micros.map_or_else(String::new, |micros| format!("{:.3}", micros as f64 / 1e6));
    output.write_item_table(
        tracks,
        &[
            ("name", &|track| track.name.clone()),
            ("kind", &|track| track.kind.track_kind_name().to_owned()),
            ("rate", &|track| {
                track.rate.map_or_else(String::new, |rate| rate.to_string())
            }),
            ("offset_s", &|track| seconds(Some(track.offset_us))),
            ("duration_s", &|track| seconds(track.duration_us)),
            ("channels", &|track| track.channels.to_string()),
        ],
    )?;
    let rows: Vec<_> = tracks
        .iter()
        .map(|track| {
            json!({
                "id": track.id,
                "kind": track.kind,
                "name": track.name,
                "rate": track.rate.map(chereme_motion::FrameRate::per_second),
                "offset_us": track.offset_us,
                "duration_us": track.duration_us,
                "frames": track.frames,
                "channels": track.channels,
            })
        })
        .collect();
    output.set_json_document(json!({ "total": rows.len(), "rows": rows }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recordings_are_named_by_address_or_by_name_alone() {
        let named = |name: &str| Ok(RowName::Text(name.to_owned()));
        let refused = Err("write recording:3, or the name of a recording".to_owned());
        for (text, want) in [
            ("recording:3", Ok(RowName::Number(3))),
            ("recording:\"two\"", named("two")),
            ("two", named("two")),
            ("token:41", refused),
        ] {
            assert_eq!(parse_recording_address(text), want, "{text}");
        }
    }

    #[test]
    fn times_are_read_with_and_without_a_unit() {
        assert_eq!(parse_time_micros("0.48s"), Ok(480_000));
        assert_eq!(parse_time_micros("-12ms"), Ok(-12_000));
        assert_eq!(parse_time_micros("3"), Ok(3_000_000));
        assert!(parse_time_micros("soon").is_err() && parse_time_micros("1e99").is_err());
        assert!(parse_recording_address("recording:3").is_ok() && parse_recording_address("token:3").is_err());
    }
}
