//! The points of one person over the frames of a film.

use std::collections::BTreeMap;

use chereme_motion::column::{Column, Number};
use chereme_motion::glam::DVec2;
use chereme_motion::markers::Frame;
use chereme_motion::{Capture, Convention, Marker, Markers, Quality, Space, Times};
use serde_json::Value;

use super::Error;
use super::names;
use crate::finding::Finding;
use crate::tally::Findings;

/// The message for places that are shares of the picture.
const SHARES: &str =
    "places are shares of the picture's width and height: angles between them need its proportions";
/// The most coordinates of one person's points.
const PLACES: usize = 30_000_000;

/// The space of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PointSpace {
    /// Pixels of the picture.
    Pixels,
    /// Shares of the picture's width and height.
    Share,
    /// Metres from the hips.
    World,
}

/// One point in one frame.
#[derive(Debug, Clone)]
pub(super) struct Point {
    group: String,
    name: String,
    /// The coordinates; `None` if the point is not seen.
    at: Option<Vec<Number>>,
    sure: Option<Number>,
}

impl Point {
    pub(super) fn is_seen(&self) -> bool {
        self.at.is_some()
    }
}

fn number(value: &Value) -> Option<Number> {
    Number::parse(value.as_number()?.to_string().as_bytes()).ok()
}

/// Adds the points of one of OpenPose's lists, which repeats x, y and confidence; 0, 0, 0 is a gap.
pub(super) fn triples(group: &str, values: &[Value], points: &mut Vec<Point>) {
    let count = values.len() / 3;
    for (at, triple) in values.chunks_exact(3).enumerate() {
        let sure = number(&triple[2]);
        let seen = sure.as_ref().is_some_and(|sure| sure.to_f64() > 0.0);
        let place: Option<Vec<Number>> = triple[..2].iter().map(number).collect();
        points.push(Point {
            group: group.to_owned(),
            name: names::openpose(group, count, at),
            at: place.filter(|_| seen),
            sure,
        });
    }
}

/// Adds landmarks: objects with x, y, z and an optional visibility; a list of such lists belongs to several hands or
/// people.
pub(super) fn landmarks(group: &str, value: &Value, points: &mut Vec<Point>) {
    let Value::Array(all) = value else { return };
    // A landmark may be a list of its coordinates too: x, y, z and perhaps its visibility.
    let is_numbers = |it: &Value| {
        it.as_array()
            .is_some_and(|it| (2..=5).contains(&it.len()) && it.iter().all(Value::is_number))
    };
    if all.iter().any(Value::is_array) && !all.iter().all(is_numbers) {
        for (at, list) in (1..).zip(all.iter().take(8)) {
            let group = if at == 1 {
                group.to_owned()
            } else {
                format!("{group} {at}")
            };
            if list
                .as_array()
                .is_some_and(|it| !it.iter().any(Value::is_array))
            {
                landmarks(&group, list, points);
            }
        }
        return;
    }
    for (at, mark) in all.iter().enumerate() {
        let column = |key: &str| match key {
            "x" => mark.get(0),
            "y" => mark.get(1),
            "z" => mark.get(2),
            "visibility" => mark.get(3),
            _ => None,
        };
        let field = |key: &str| mark.get(key).or_else(|| column(key)).and_then(number);
        let place: Option<Vec<Number>> = ["x", "y"].into_iter().map(field).collect();
        let place = place.map(|mut place| {
            place.push(field("z").unwrap_or(Number::ZERO));
            place
        });
        points.push(Point {
            group: group.to_owned(),
            name: names::mediapipe(group, all.len(), at),
            at: place,
            sure: field("visibility").or_else(|| field("score")),
        });
    }
}

/// Returns the mean position of the points that are seen.
pub(super) fn middle(points: &[Point]) -> DVec2 {
    let seen: Vec<DVec2> = points
        .iter()
        .filter_map(|point| match point.at.as_deref() {
            Some([x, y, ..]) => Some(DVec2::new(x.to_f64(), y.to_f64())),
            _ => None,
        })
        .collect();
    seen.iter().sum::<DVec2>() / seen.len().max(1) as f64
}

/// Returns the greater side of the box around the points that are seen.
fn extent(points: &[Point]) -> f64 {
    let seen = points.iter().filter_map(|point| match point.at.as_deref() {
        Some([x, y, ..]) => Some(DVec2::new(x.to_f64(), y.to_f64())),
        _ => None,
    });
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for at in seen {
        (low, high) = (low.min(at), high.max(at));
    }
    let size = (high - low).max_element();
    if size.is_finite() { size } else { 0.0 }
}

/// The growing columns of one point: three coordinates and the confidence.
type Columns = [Vec<Option<Number>>; 4];

/// The points of one person.
#[derive(Debug)]
pub(super) struct Cloud {
    kind: PointSpace,
    names: Vec<(String, String)>,
    known: BTreeMap<(String, String), usize>,
    columns: Vec<Columns>,
    rows: usize,
    last: Option<DVec2>,
    /// The greatest extent of the points in a frame.
    extent: f64,
    /// The person's number in the file.
    number: Option<u64>,
    least: f64,
    largest: [f64; 2],
}

/// The distance from a person's last place, as a share of the person's extent, that no person moves at once.
const LEAP: f64 = 1.5;

impl Cloud {
    pub(super) fn new(kind: PointSpace) -> Self {
        Self {
            kind,
            names: Vec::new(),
            known: BTreeMap::new(),
            columns: Vec::new(),
            rows: 0,
            last: None,
            extent: 0.0,
            number: None,
            least: 0.0,
            largest: [1.0; 2],
        }
    }

    /// Returns an empty cloud of the person with this number.
    pub(super) fn of_person(number: u64) -> Self {
        Self {
            number: Some(number),
            ..Self::new(PointSpace::Pixels)
        }
    }

    pub(super) fn number(&self) -> Option<u64> {
        self.number
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// Returns whether points are too far from the last ones for the same person.
    pub(super) fn leaps(&self, points: &[Point]) -> bool {
        let most = self.extent.max(extent(points)) * LEAP;
        self.last.is_some() && most > 0.0 && self.far(middle(points)) > most
    }

    pub(super) fn kind(&self) -> PointSpace {
        self.kind
    }

    /// Returns the distance of a position from the person's last one.
    pub(super) fn far(&self, at: DVec2) -> f64 {
        self.last.map_or(f64::MAX, |last| last.distance(at))
    }

    /// Adds the points of a frame; if two frames have the same number, the first counts.
    pub(super) fn push(&mut self, row: usize, points: Vec<Point>) -> Result<(), Error> {
        self.last = Some(middle(&points));
        self.extent = self.extent.max(extent(&points));
        self.reach(row)?;
        if self.rows > row {
            return Ok(());
        }
        for point in points {
            let key = (point.group, point.name);
            let at = match self.known.get(&key) {
                Some(at) => *at,
                None => {
                    self.known.insert(key.clone(), self.names.len());
                    self.names.push(key);
                    self.columns.push([(); 4].map(|()| vec![None; self.rows]));
                    self.fits(self.rows + 1)?;
                    self.names.len() - 1
                }
            };
            let [x, y, ..] = point.at.as_deref().unwrap_or_default() else {
                self.columns[at][3].push(point.sure);
                continue;
            };
            for (most, value) in self.largest.iter_mut().zip([x, y]) {
                *most = most.max(value.to_f64());
                self.least = self.least.min(value.to_f64());
            }
            // A name that occurs twice in a frame counts once.
            if self.columns[at][0].len() == row {
                let places = point.at.unwrap_or_default();
                for (column, value) in self.columns[at].iter_mut().zip(places) {
                    column.push(Some(value));
                }
                self.columns[at][3].resize(row, None);
                self.columns[at][3].push(point.sure);
            }
        }
        self.reach(row + 1)
    }

    fn fits(&self, rows: usize) -> Result<(), Error> {
        match self.names.len().saturating_mul(rows) > PLACES {
            true => Err(Error::Large(PLACES)),
            false => Ok(()),
        }
    }

    /// Adds gaps until there are `rows` frames.
    pub(super) fn reach(&mut self, rows: usize) -> Result<(), Error> {
        if rows <= self.rows {
            return Ok(());
        }
        self.fits(rows)?;
        for column in self.columns.iter_mut().flatten() {
            column.resize(rows, None);
        }
        self.rows = rows;
        Ok(())
    }

    /// Returns the track; `None` if there is no point.
    pub(super) fn markers(
        self,
        times: Times,
        size: Option<[f64; 2]>,
        findings: &mut Findings,
    ) -> Result<Option<Markers>, Error> {
        if self.names.is_empty() || self.rows == 0 {
            return Ok(None);
        }
        let space = self.space(size, findings)?;
        let wide = space.coordinates();
        let has_quality = |columns: &Columns| columns[3].iter().any(Option::is_some);
        let points = self.names.into_iter().zip(self.columns);
        let points = points.map(|((group, name), columns)| {
            let quality = has_quality(&columns);
            let [x, y, z, sure] = columns;
            let place = [x, y, z].into_iter().take(wide);
            Marker {
                group,
                name,
                place: place.map(Column::decimals).collect(),
                quality: quality.then(|| Column::decimals(sure)),
            }
        });
        let limbs = |points: &[Marker]| names::limbs(points);
        let points: Vec<Marker> = points.collect();
        let limbs = limbs(&points);
        let markers = Markers::new(times, space, points)
            .and_then(|markers| markers.joined(limbs))
            .map_err(|error| Error::Track(error.to_string()))?;
        Ok(Some(
            markers
                .captured(Capture::Estimated)
                .rated(Quality::Confidence),
        ))
    }

    fn space(&self, size: Option<[f64; 2]>, findings: &mut Findings) -> Result<Space, Error> {
        let frame = |[width, height]: [f64; 2]| Frame { width, height };
        Ok(match self.kind {
            PointSpace::World => Space::World(Convention {
                metres_per_unit: 1.0,
                axes: "-Y,+X"
                    .parse()
                    .map_err(|_| Error::Track("axes".to_owned()))?,
            }),
            // No point of a picture is within its first pixel only.
            PointSpace::Pixels if self.largest == [1.0; 2] => {
                let text = match self.least < 0.0 {
                    true => {
                        "places are from -1 to 1 in the picture's width and height: angles between them need its proportions"
                    }
                    false => SHARES,
                };
                findings.add("shares of the picture", || Finding::note(None, text));
                Space::Image(frame([1.0, 1.0]))
            }
            PointSpace::Pixels => Space::Image(frame(size.unwrap_or_else(|| {
                let found = self.largest.map(f64::ceil);
                findings.add("pictures of unknown size", || {
                    Finding::note(
                        None,
                        format!(
                            "the size of the pictures is not stated; points reach {} by {} pixels",
                            found[0], found[1]
                        ),
                    )
                });
                found
            }))),
            PointSpace::Share => {
                findings.add("shares of the picture", || Finding::note(None, SHARES));
                Space::Depth(frame([1.0, 1.0]))
            }
        })
    }
}
