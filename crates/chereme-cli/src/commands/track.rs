//! `chereme track`: lists, moves, aligns, renames and removes the tracks of a recording.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Error, MediaChange, Name, Signal, TrackChange, TrackRow};
use serde_json::json;

use crate::args::Cli;
use crate::output::Output;

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
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The recording, such as recording:3 or recording:"NGT Thanks"
    #[arg(value_parser = recording)]
    recording: Name,
    /// The track's name
    name: Option<String>,
    /// The new start of the track on the recording's clock, such as 0.48s or -12ms
    #[arg(long, value_name = "TIME", value_parser = micros, allow_hyphen_values = true, requires = "name",
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
    #[arg(
        long,
        value_name = "TRACK",
        requires = "name",
        conflicts_with = "remove"
    )]
    align_to: Option<String>,
    /// The joints, points or curves of the track whose speeds are compared
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "NAMES",
        requires = "align_to"
    )]
    channels: Vec<String>,
    /// The joints, points or curves of the other track
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "NAMES",
        requires = "align_to"
    )]
    with: Vec<String>,
    /// The largest shift from the present offset
    #[arg(long, value_name = "TIME", value_parser = micros, default_value = "30s", requires = "align_to")]
    within: i64,
    /// Move the track to the offset that was found
    #[arg(long, requires = "align_to")]
    store: bool,
}

/// Parses the address of a recording, such as `recording:3`, or its bare name.
pub(super) fn recording(text: &str) -> Result<Name, String> {
    Name::of_recording(text).map_err(|error| {
        let remedy = error.remedy().map(|remedy| remedy.to_string());
        remedy.unwrap_or_else(|| error.to_string())
    })
}

/// Parses a time such as `0.48s`, `480ms` or `-0.48`, in seconds if it has no unit; returns microseconds.
pub(super) fn micros(text: &str) -> Result<i64, String> {
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

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let Some(name) = &args.name else {
        let tracks = corpus.tracks(&args.recording)?;
        return shown(&tracks, output);
    };
    if let Some(other) = &args.align_to {
        let (own, other) = (
            Signal {
                track: name.clone(),
                channels: args.channels.clone(),
            },
            Signal {
                track: other.clone(),
                channels: args.with.clone(),
            },
        );
        let found = corpus.align_track(&args.recording, &own, &other, args.within)?;
        output.filled_line(
            "{track} starts at {time} s (now {now} s): correlation {r} with {other}, elsewhere at \
             most {most}, confidence {sure}",
            &[
                &found.track,
                &format_args!("{:.3}", found.offset_us as f64 / 1e6),
                &format_args!("{:.3}", found.offset_now_us as f64 / 1e6),
                &format_args!("{:.2}", found.correlation),
                &found.to,
                &format_args!("{:.2}", found.runner_up),
                &format_args!("{:.2}", found.confidence),
            ],
        )?;
        if found.confidence < 0.5 {
            output.line(
                "this is uncertain: look at both tracks before you use it, or name other channels",
            )?;
        }
        if args.store {
            corpus.change_track(&args.recording, name, &TrackChange::Offset(found.offset_us))?;
        }
        return output.document(found);
    }
    if let Some(file) = &args.file {
        let tracks = corpus.tracks(&args.recording)?;
        let track = tracks.iter().find(|track| track.name == *name);
        let track = track.ok_or_else(|| no_track(name))?;
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
            let mut all = corpus.tracks(&args.recording)?;
            all.retain(|track| track.name == *name);
            if all.is_empty() {
                return Err(no_track(name).into());
            }
            all
        }
    };
    shown(&after, output)
}

fn no_track(name: &str) -> Error {
    Error::wrong(format!("there is no track {name:?}"))
        .at(name)
        .advise("`chereme track CORPUS RECORDING` lists its tracks")
}

fn shown(tracks: &[TrackRow], output: &mut Output) -> Result<()> {
    let seconds = |micros: Option<i64>| {
        micros.map_or_else(String::new, |micros| format!("{:.3}", micros as f64 / 1e6))
    };
    let columns = ["name", "kind", "rate", "offset_s", "duration_s", "channels"];
    let rows: Vec<Vec<String>> = tracks
        .iter()
        .map(|track| {
            vec![
                track.name.clone(),
                track.kind.name().to_owned(),
                track.rate.map_or_else(String::new, |rate| rate.to_string()),
                seconds(Some(track.offset_us)),
                seconds(track.duration_us),
                track.channels.to_string(),
            ]
        })
        .collect();
    output.table(&columns, &rows)?;
    let rows: Vec<_> = tracks
        .iter()
        .map(|track| {
            json!({
                "id": track.id,
                "kind": track.kind,
                "name": track.name,
                "rate": track.rate.map(chereme_motion::Rate::per_second),
                "offset_us": track.offset_us,
                "duration_us": track.duration_us,
                "frames": track.frames,
                "channels": track.channels,
            })
        })
        .collect();
    output.document(json!({ "total": rows.len(), "rows": rows }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recordings_are_named_by_address_or_by_name_alone() {
        let named = |name: &str| Ok(Name::Text(name.to_owned()));
        let refused = Err("write recording:3, or the name of a recording".to_owned());
        for (text, want) in [
            ("recording:3", Ok(Name::Number(3))),
            ("recording:\"two\"", named("two")),
            ("two", named("two")),
            ("token:41", refused),
        ] {
            assert_eq!(recording(text), want, "{text}");
        }
    }

    #[test]
    fn times_are_read_with_and_without_a_unit() {
        assert_eq!(micros("0.48s"), Ok(480_000));
        assert_eq!(micros("-12ms"), Ok(-12_000));
        assert_eq!(micros("3"), Ok(3_000_000));
        assert!(micros("soon").is_err() && micros("1e99").is_err());
        assert!(recording("recording:3").is_ok() && recording("token:3").is_err());
    }
}
