//! Fits a skeleton to the markers of a recording; runs only on command.

use std::sync::Arc;

use chereme_motion::fit::{FitError, Fitted, fit, people};
use chereme_motion::{
    Anatomy, Column, Convention, Curve, Curves, Instant, Side, Skeleton, Span, Times,
};
use chereme_sign::Remedy;
use rusqlite::Connection;
use serde::Serialize;

use super::{NewTrack, SkeletonTrack, Track, TrackKind, TrackRow, read, store};
use crate::Corpus;
use crate::address::{self, Name};
use crate::db::{recordings, tracks};
use crate::error::{Error, Result};
use crate::movement;
use crate::picture::built_in_body;
use crate::words::effect::OperationEffect;

/// The largest median distance between markers and a usable skeleton, in metres; a larger one gives a warning.
const FAR: f64 = 0.02;
/// The least share of frames in which the markers of a usable result are seen; a smaller one gives a warning.
const SEEN: f64 = 0.6;

/// The name of the track from which a recording's signs are read if it has one.
const BODY: &str = "body";
/// The statures of signers in metres, children included; another gives a warning.
const STATURES: [f64; 2] = [0.7, 2.4];

/// Options of a fit.
#[derive(Debug, Clone, Copy, Default)]
pub struct FitOptions<'a> {
    /// The track of markers; the first one if it is not given.
    pub track: Option<&'a str>,
    /// The recording whose skeleton is fitted; without it the program's own body.
    pub to: Option<&'a Name>,
    /// The person whose markers are used, such as `Anna` for `Anna:LSHO`; needed if they are those of several people.
    pub subject: Option<&'a str>,
    /// Whether nothing is stored.
    pub dry_run: bool,
}

/// A skeleton that was fitted to markers.
#[derive(Debug, Clone, Serialize)]
pub struct FitReport {
    /// The track of markers.
    pub markers: String,
    /// The person whose markers were used, if one was named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// The name of the new track with the movement; nothing if nothing was stored.
    pub track: Option<String>,
    /// The size of the fitted skeleton relative to the given one.
    pub scale: f64,
    /// The number of fitted frames.
    pub frames: usize,
    /// The number of frames with too few markers, which repeat the posture before them.
    pub held: usize,
    /// The median of the markers' median distances, in millimetres.
    pub median_mm: f64,
    /// The distance of each marker from its place on the fitted skeleton.
    pub residuals: Vec<FitResidual>,
    /// Labels of markers that belong to no known bone.
    pub unused: Vec<String>,
    /// Warnings about the result.
    pub findings: Vec<String>,
}

/// The distance of a marker from its place on the fitted skeleton.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FitResidual {
    /// The marker's label.
    pub marker: String,
    /// The joint whose bone it is on.
    pub joint: String,
    /// The median distance in millimetres.
    pub median_mm: f64,
    /// The 95th percentile of the distance, in millimetres.
    pub most_mm: f64,
    /// The share of frames in which the marker is seen.
    pub seen: f64,
}

impl Corpus {
    /// Returns the people to whom the markers of a recording belong if they are those of several;
    /// [`fit_markers`](Self::fit_markers) needs the name of one of them then. None if they are those of one person.
    ///
    /// # Errors
    /// Fails if there is no such recording or track of markers.
    pub fn marker_people(&self, recording: &Name, track: Option<&str>) -> Result<Vec<String>> {
        let connection = self.store.read();
        let row = address::recording(connection, recording)?;
        let markers = chosen(connection, &row.name, row.id, track)?;
        // The names are in every piece of the track.
        let begin = Instant::from_micros(markers.offset_us);
        let piece = Span::between(begin, begin);
        let points = read::markers(connection, &markers, Some(piece))?;
        Ok(people(&points))
    }

    /// Fits a skeleton to a recording's markers: that of another recording, or the program's own body.
    ///
    /// The movement becomes a track `body` of the recording (another name if it has one), and the distance of every
    /// marker in every frame a track of curves, `fit residual`, whose names keep the person's; the markers stay. A dry run
    /// stores nothing.
    ///
    /// # Errors
    /// Fails if there is no such recording or track of markers, the points have no place in a room, are those of several
    /// people and none of them is named, too few labels are known, or the skeleton is not a body's.
    pub fn fit_markers(&mut self, recording: &Name, options: &FitOptions<'_>) -> Result<FitReport> {
        let connection = self.store.read();
        let row = address::recording(connection, recording)?;
        let markers = chosen(connection, &row.name, row.id, options.track)?;
        let (skeleton, anatomy) = skeleton(connection, options.to)?;
        let points = read::markers(connection, &markers, None)?;
        let fitted = fit(&points, &skeleton, &anatomy, options.subject).map_err(|error| {
            Error::wrong(error.to_string())
                .at(&row.name)
                .advise(remedy(&error))
        })?;
        let mut report = report(&markers.name, options.subject, &fitted);
        let known = recordings::body_track(connection, row.id)?;
        if known.is_some_and(|known| known.name == BODY) {
            report.findings.push(
                "the recording has a body already, from which signs are read; import the file again as a recording of \
                 its own for another person"
                    .to_owned(),
            );
        }
        if options.dry_run {
            return Ok(report);
        }
        let new = new_tracks(&fitted, markers.offset_us)?;
        let names = self.store.operation(|connection| {
            let mut names = Vec::new();
            for track in &new {
                let id = store::store(connection, row.id, track)?;
                names.push(tracks::track(connection, id)?.name);
            }
            let effect = OperationEffect::FitMarkers {
                recording: row.name.clone(),
                markers: markers.name.clone(),
                subject: options.subject.map(ToString::to_string),
                millimetres: report.median_mm.round() as u64,
            };
            Ok((names, effect))
        })?;
        report.track = names.into_iter().next();
        Ok(report)
    }
}

fn remedy(error: &FitError) -> Remedy {
    match error {
        FitError::People(people) | FitError::Subject { known: people, .. }
            if !people.is_empty() =>
        {
            let name = people.first().map_or("", String::as_str);
            Remedy::command(format!("name one of them: --subject {name:?}"))
        }
        _ => {
            "markers are known by labels such as LSHO, RWRA, C7 or R.Elbow; rename them in the file"
                .into()
        }
    }
}

fn chosen(
    connection: &Connection,
    recording: &str,
    id: i64,
    track: Option<&str>,
) -> Result<TrackRow> {
    let all = tracks::tracks(connection, id)?;
    let found = match track {
        Some(name) => Some(super::change::named(&all, recording, name)?),
        None => all.iter().find(|it| it.kind == TrackKind::Markers),
    };
    let found = found.filter(|it| it.kind == TrackKind::Markers);
    found.cloned().ok_or_else(|| {
        Error::wrong(format!("{recording:?} has no track of markers"))
            .at(recording)
            .advise(Remedy::command(
                "import a .c3d or .trc file into it: chereme import CORPUS FILE --into recording:3",
            ))
    })
}

/// Returns a skeleton in metres and model space.
fn skeleton(connection: &Connection, to: Option<&Name>) -> Result<(Arc<Skeleton>, Anatomy)> {
    let Some(name) = to else {
        let (clip, anatomy) = built_in_body()?;
        return Ok((clip.skeleton().clone(), anatomy.as_ref().clone()));
    };
    let row = address::recording(connection, name)?;
    recordings::body_track(connection, row.id)?.ok_or_else(|| {
        Error::wrong(format!("{:?} has no skeleton", row.name))
            .at(&row.name)
            .advise(Remedy::command(
                "name a recording of movement, or leave --to out for the program's own body",
            ))
    })?;
    let track = movement::MotionTrack::of(connection, row.id)?;
    let clip = track.clip(connection, 0..1, &movement::ChannelGroup::ALL)?;
    Ok((clip.skeleton().clone(), track.anatomy(connection)?))
}

fn new_tracks(fitted: &Fitted, offset_us: i64) -> Result<Vec<NewTrack>> {
    let curve = |marker: &chereme_motion::fit::FittedMarker| Curve {
        name: marker.name.clone(),
        unit: "mm".to_owned(),
        values: Column::doubles(marker.distances.iter().map(|it| it * 1000.0).collect()),
    };
    let curves = fitted.markers.iter().map(curve).collect();
    let curves = Curves::new(Times::Even(fitted.clip.rate()), curves)
        .map_err(|error| Error::wrong(error.to_string()))?;
    let body = SkeletonTrack {
        clip: fitted.clip.clone(),
        convention: Convention::MODEL,
        roles: None,
    };
    let track = |name: &str, track| NewTrack {
        offset_us,
        ..NewTrack::new(name, track)
    };
    Ok(vec![
        track(BODY, Track::Skeleton(body)),
        track("fit residual", Track::Curves(curves)),
    ])
}

fn report(markers: &str, subject: Option<&str>, fitted: &Fitted) -> FitReport {
    let mm = |metres: f64| (metres * 10_000.0).round() / 10.0;
    let skeleton = fitted.clip.skeleton();
    let seen = fitted.markers.iter().map(|marker| marker.seen).sum::<f64>()
        / fitted.markers.len().max(1) as f64;
    let mut findings = Vec::new();
    if fitted.median() > FAR || seen < SEEN {
        findings.push(format!(
            "this is no capture of a skeleton: markers are {:.0} mm from it in the median and seen in {:.0} % of the \
             frames; a good fit is below {:.0} mm and above {:.0} %",
            fitted.median() * 1000.0,
            seen * 100.0,
            FAR * 1000.0,
            SEEN * 100.0
        ));
    }
    if let Some(subject) = subject.filter(|_| fitted.others > 0) {
        findings.push(format!(
            "markers that are not of {subject:?} and are left out: {}",
            fitted.others
        ));
    }
    if fitted.held > 0 {
        findings.push(format!(
            "frames with too few markers, in which the posture before is held: {}",
            fitted.held
        ));
    }
    if !(STATURES[0]..=STATURES[1]).contains(&fitted.stature) {
        findings.push(format!(
            "the body of the markers is {:.3} m tall; if that is wrong, import the file again with \
             its unit",
            fitted.stature
        ));
    }
    for side in &fitted.unturned {
        let letter = if *side == Side::Left { 'L' } else { 'R' };
        findings.push(format!(
            "the turn of the {} forearm and palm about the forearm is a guess, as no pair of markers on the sides of \
             thumb and little finger shows it; call them {letter}WRA and {letter}WRB",
            side.name()
        ));
    }
    findings.push(
        "no marker is on the fingers, which stay at rest: handshapes read from this track are not the signer's"
            .to_owned(),
    );
    FitReport {
        markers: markers.to_owned(),
        subject: subject.map(str::to_owned),
        track: None,
        scale: (fitted.scale * 1000.0).round() / 1000.0,
        frames: fitted.clip.frames(),
        held: fitted.held,
        median_mm: mm(fitted.median()),
        residuals: fitted
            .markers
            .iter()
            .map(|marker| FitResidual {
                marker: marker.name.clone(),
                joint: skeleton.joint(marker.joint).name.clone(),
                median_mm: mm(marker.median),
                most_mm: mm(marker.most),
                seen: (marker.seen * 1000.0).round() / 1000.0,
            })
            .collect(),
        unused: fitted.unused.clone(),
        findings,
    }
}
