//! A map of the signs: every sign has a position in a plane, and similar signs lie near each other.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt::Write as _;
use std::path::Path;

use chereme_analysis::map::{Features, lay_out, neighbours};
use chereme_sign::Remedy;
use chereme_sign::{Component, Field};
use serde::Serialize;

use crate::Corpus;
use crate::db::columns::Origin;
use crate::db::signs::{self, TokenRow};
use crate::error::{Error, Result};
use crate::inventories::{self, StoredInventory};
use crate::picture::write_svg;
use crate::progress::{Progress, Step, Unit};
use crate::suggest::single_values;

/// The signs of a map and the components that place them.
#[derive(Debug, Clone, Default)]
pub struct MapOptions {
    /// The components that are compared, with equal weight; all four of the hands if empty.
    pub components: Vec<Component>,
    /// The tokens to place, as a query; the citation forms of all signs if `None`.
    pub query: Option<String>,
}

/// A map of signs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SignMap {
    /// The components that placed the signs.
    pub components: Vec<Component>,
    /// The signs, in the order of their tokens.
    pub signs: Vec<MapPoint>,
    /// The number of tokens that are not coded for any of the components.
    pub left_out: usize,
}

/// A sign on a map.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MapPoint {
    /// The row of the token.
    pub token: i64,
    /// Its gloss.
    pub gloss: String,
    /// Its origin.
    pub origin: Origin,
    /// The distance from the left edge, 0 to 1.
    pub x: f32,
    /// The distance from the top edge, 0 to 1.
    pub y: f32,
    /// The most similar tokens, nearest first.
    pub near: Vec<i64>,
}

/// The number of neighbours that determine the position of a sign, and of those that a point lists.
const NEIGHBOURS: usize = 15;
const NAMED: usize = 5;
/// The most tokens on one map.
const MOST: usize = 20_000;
/// The weights of a value itself, of all its features together, and of each value that contains it.
const WEIGHTS: (f32, f32, f32) = (1.0, 0.8, 0.6);
/// The side of the drawn map in pixels, and the margin for words.
const SIDE: (f32, f32) = (1600.0, 60.0);

impl Corpus {
    /// Arranges signs in a plane by their coding. Two signs are similar if they share values, features of handshapes,
    /// or wider placements; all components have equal weight. The same corpus gives the same map.
    ///
    /// # Errors
    /// [`Error::Wrong`] if the query cannot be read, if fewer than two tokens are coded for the components, or if there are more
    /// than 20,000; [`Error::Stopped`] if `progress` stops.
    pub fn map(&mut self, options: &MapOptions, progress: &mut Progress<'_>) -> Result<SignMap> {
        let tokens = self.tokens_of_map(options, progress)?;
        let components = match &options.components[..] {
            [] => vec![
                Component::Configuration,
                Component::Placement,
                Component::Movement,
                Component::Orientation,
            ],
            some => some.to_vec(),
        };
        let inventories = inventories::load(self.store.read())?;
        let mut numbers: HashMap<String, u32> = HashMap::new();
        let (mut placed, mut things) = (Vec::new(), Vec::new());
        let all = tokens.len();
        for token in tokens {
            let coding = self.coding_of(&token)?;
            let features = features(&coding, &components, &inventories, &mut numbers);
            if !features.is_empty() {
                things.push(features);
                placed.push(token);
            }
        }
        if placed.len() < 2 {
            let names: Vec<String> = components.iter().map(ToString::to_string).collect();
            let text = format!(
                "{} of {all} tokens are coded for {}; a map needs two",
                placed.len(),
                names.join(", ")
            );
            return Err(Error::wrong(text).advise(
                Remedy::command("import annotations or a lexicon with these components, or choose others; `chereme list CORPUS tokens` shows the codings"),
            ));
        }
        let total = Some(2 * placed.len() as u64);
        let mut report = |done: u64| {
            let unit = Unit::Items;
            progress.report(Step {
                task: "map",
                done,
                total,
                unit,
            })
        };
        let near = neighbours(&things, NEIGHBOURS, |done| report(done as u64).is_ok());
        let near = near.ok_or(Error::Stopped)?;
        let half = placed.len() as f32;
        let places = lay_out(&near, |share| report((half * (1.0 + share)) as u64).is_ok());
        let places = places.ok_or(Error::Stopped)?;
        let ids: Vec<i64> = placed.iter().map(|token| token.id).collect();
        let signs = placed.into_iter().zip(places).zip(&near);
        let signs = signs.map(|((token, [x, y]), near)| MapPoint {
            token: token.id,
            gloss: token.gloss,
            origin: token.origin,
            x,
            y,
            near: near
                .iter()
                .take(NAMED)
                .map(|&(other, _)| ids[other])
                .collect(),
        });
        let signs: Vec<MapPoint> = signs.collect();
        Ok(SignMap {
            components,
            left_out: all - signs.len(),
            signs,
        })
    }

    fn tokens_of_map(
        &mut self,
        options: &MapOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Vec<TokenRow>> {
        let tokens = match &options.query {
            None => signs::citations(self.store.read())?,
            Some(query) => self.tokens_found(query, progress)?,
        };
        if tokens.len() > MOST {
            let text = format!(
                "{} tokens are too many for a map of at most {MOST}",
                tokens.len()
            );
            return Err(Error::wrong(text).advise("narrow the query"));
        }
        Ok(tokens)
    }
}

impl SignMap {
    /// Writes the map as an SVG: a point for each sign, with its gloss if there is room.
    ///
    /// # Errors
    /// Fails if the name does not end in `.svg`, the file cannot be written, or it exists and `force` is false.
    pub fn draw(&self, to: &Path, force: bool) -> Result<u64> {
        write_svg(to, force, &self.svg())
    }

    fn svg(&self) -> String {
        let (side, margin) = SIDE;
        let whole = side + 2.0 * margin;
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {whole} {whole}\" font-family=\"sans-serif\" font-size=\"11\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fbfbfd\"/>\n"
        );
        let mut taken: BTreeSet<(i32, i32)> = BTreeSet::new();
        for point in &self.signs {
            let [x, y] = [point.x, point.y].map(|it| margin + side * it);
            let colour = match point.origin {
                Origin::Captured => "#2b6cb0",
                Origin::Lexicon => "#718096",
                Origin::Made | Origin::Generated => "#b7791f",
            };
            let gloss = escaped(&point.gloss);
            // Formatting into a string never fails.
            let _ = writeln!(
                text,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.5\" fill=\"{colour}\"><title>{gloss}</title></circle>"
            );
            let cells = (point.gloss.chars().count() as f32 * 7.0 / 12.0).ceil() as i32;
            let (column, row) = ((x / 12.0) as i32, (y / 12.0) as i32);
            let room: Vec<(i32, i32)> = (0..=cells).map(|at| (column + at, row)).collect();
            if room.iter().all(|cell| !taken.contains(cell)) {
                taken.extend(room);
                let _ = writeln!(
                    text,
                    "<text x=\"{:.1}\" y=\"{:.1}\">{gloss}</text>",
                    x + 4.0,
                    y + 4.0
                );
            }
        }
        text.push_str("</svg>\n");
        text
    }
}

/// Returns a text as it stands in SVG and HTML, without control letters.
pub(crate) fn escaped(text: &str) -> String {
    text.chars()
        .filter(|c| !c.is_control())
        .map(|c| match c {
            '&' => "&amp;".to_owned(),
            '<' => "&lt;".to_owned(),
            '>' => "&gt;".to_owned(),
            c => c.to_string(),
        })
        .collect()
}

/// Returns the features of a coding: its values, their features and the values that contain them. The features of each
/// component together have length 1.
fn features(
    coding: &BTreeMap<String, String>,
    components: &[Component],
    inventories: &[StoredInventory],
    numbers: &mut HashMap<String, u32>,
) -> Features {
    let mut all: BTreeMap<u32, f32> = BTreeMap::new();
    for component in components {
        let mut own: BTreeMap<String, f32> = BTreeMap::new();
        for (name, values) in coding {
            let Ok(field) = name.parse::<Field>() else {
                continue;
            };
            if field.component != *component {
                continue;
            }
            let part = |it: &&StoredInventory| {
                let feature = field.feature.as_ref().map(ToString::to_string);
                it.inventory.component == field.component && it.inventory.feature == feature
            };
            for value in single_values(values).collect::<BTreeSet<_>>() {
                add(&mut own, format!("{name}={value}"), WEIGHTS.0);
                let known = inventories
                    .iter()
                    .filter(part)
                    .find_map(|it| Some((&it.inventory, it.inventory.find(value)?)));
                let Some((inventory, value)) = known else {
                    continue;
                };
                let share = WEIGHTS.1 / (value.features.len().max(1) as f32).sqrt();
                for feature in &value.features {
                    add(&mut own, format!("{name}:{feature}"), share);
                }
                for wider in inventory.chain(&value.id).skip(1) {
                    add(&mut own, format!("{name}={}", wider.id), WEIGHTS.2);
                }
            }
        }
        let length = own
            .values()
            .map(|weight| weight * weight)
            .sum::<f32>()
            .sqrt();
        for (name, weight) in own {
            let next = numbers.len() as u32;
            let number = *numbers.entry(name).or_insert(next);
            *all.entry(number).or_default() += weight / length;
        }
    }
    all.into_iter().collect()
}

fn add(own: &mut BTreeMap<String, f32>, name: String, weight: f32) {
    let held = own.entry(name).or_default();
    *held = held.max(weight);
}

#[cfg(test)]
mod tests;
