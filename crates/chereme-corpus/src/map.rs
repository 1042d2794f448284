//! A map of the signs: every sign has a position in a plane, and similar signs lie near each other.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt::Write as _;
use std::path::Path;

use chereme_analysis::map::{WeightedFeatures, find_feature_neighbours, lay_out_map};
use chereme_sign::{ComponentField, SignComponent};
use serde::Serialize;

use crate::Corpus;
use crate::atomic_write::write_svg;
use crate::db::signs::{self, TokenRow};
use crate::db::stored_columns::RecordOrigin;
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::{self, StoredInventory};
use crate::lexicon::{LexiconScope, keep_scope_rows};
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::suggest::{CodingReader, single_values};

/// The signs of a map and the components that place them.
#[derive(Debug, Clone, Default)]
pub struct MapOptions {
    /// The components that are compared, with equal weight; all four of the hands if empty.
    pub components: Vec<SignComponent>,
    /// The tokens to place, as a query; the citation forms of all signs if `None`.
    pub query: Option<String>,
    /// The lexicons whose signs are placed.
    pub scope: LexiconScope,
}

/// A map of signs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SignMap {
    /// The components that placed the signs.
    pub components: Vec<SignComponent>,
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
    pub origin: RecordOrigin,
    /// The distance from the left edge, 0 to 1.
    pub x: f32,
    /// The distance from the top edge, 0 to 1.
    pub y: f32,
    /// The most similar tokens, nearest first.
    pub near: Vec<i64>,
}

/// The number of neighbours that determine the position of a sign, and of those that a point lists.
const MAP_NEIGHBOUR_COUNT: usize = 15;
const MAX_NAMED_POINTS: usize = 5;
/// The most tokens on one map.
const MAX_MAP_TOKENS: usize = 20_000;
/// The weights of a value itself, of all its features together, and of each value that contains it.
const CODING_FEATURE_WEIGHTS: (f32, f32, f32) = (1.0, 0.8, 0.6);
/// The side of the drawn map in pixels, and the margin for words.
const MAP_SIDE_PX: (f32, f32) = (1600.0, 60.0);

impl Corpus {
    /// Arranges signs in a plane by their coding. Two signs are similar if they share values, features of handshapes,
    /// or wider placements; all components have equal weight. The same corpus gives the same map.
    ///
    /// # Errors
    /// [`CorpusError::Wrong`] if the query cannot be read, if fewer than two tokens are coded for the components, or if there are more
    /// than 20,000; [`CorpusError::Stopped`] if `progress` stops.
    pub fn arrange_sign_map(
        &mut self,
        options: &MapOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<SignMap> {
        let tokens = self.tokens_of_map(options, progress)?;
        let components = match &options.components[..] {
            [] => vec![
                SignComponent::Configuration,
                SignComponent::Placement,
                SignComponent::Movement,
                SignComponent::Orientation,
            ],
            some => some.to_vec(),
        };
        let inventories = inventories::load_all_inventories(self.store.read_connection())?;
        let mut numbers: HashMap<String, u32> = HashMap::new();
        let (mut placed, mut things) = (Vec::new(), Vec::new());
        let all = tokens.len();
        let reader = CodingReader::in_standing_words(self)?;
        for token in tokens {
            let coding = reader.coding_of(&token)?;
            let features = coding_features(&coding, &components, &inventories, &mut numbers);
            // A sign that is coded for none of them has no place on the map.
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
            return Err(CorpusError::from_wrong_message(text).with_command_advice("import annotations or a lexicon with these components, or choose others; `chereme list CORPUS tokens` shows the codings"));
        }
        let total = Some(2 * placed.len() as u64);
        let mut report = |done: u64| {
            let unit = ProgressUnit::Items;
            progress.report_amount(unit, "map", done, total)
        };
        // The search for neighbours is the first half of the work, and the layout the second.
        let near_signs = find_feature_neighbours(&things, MAP_NEIGHBOUR_COUNT, |done| report(done as u64).is_ok());
        let near = near_signs.ok_or(CorpusError::Stopped)?;
        let half = placed.len() as f32;
        let layout = lay_out_map(&near, |share| report((half * (1.0 + share)) as u64).is_ok());
        let places = layout.ok_or(CorpusError::Stopped)?;
        let ids: Vec<i64> = placed.iter().map(|token| token.id).collect();
        let placed_signs = placed.into_iter().zip(places).zip(&near);
        let signs = placed_signs.map(|((token, [x, y]), near)| MapPoint {
            token: token.id,
            gloss: token.gloss,
            origin: token.origin,
            x,
            y,
            near: near
                .iter()
                .take(MAX_NAMED_POINTS)
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
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<TokenRow>> {
        let tokens = match &options.query {
            None => signs::load_citation_tokens(self.store.read_connection())?,
            Some(query) => self.tokens_found(query, progress)?,
        };
        let connection = self.store.read_connection();
        let tokens = keep_scope_rows(connection, &options.scope, tokens, |token| token.sign_id)?;
        if tokens.len() > MAX_MAP_TOKENS {
            let text = format!(
                "{} tokens are too many for a map of at most {MAX_MAP_TOKENS}",
                tokens.len()
            );
            return Err(CorpusError::from_wrong_message(text).with_advice("narrow the query"));
        }
        Ok(tokens)
    }
}

impl SignMap {
    /// Writes the map as an SVG: a point for each sign, with its gloss if there is room.
    ///
    /// # Errors
    /// Fails if the name does not end in `.svg`, the file cannot be written, or it exists and `force` is false.
    pub fn draw_sign_map(&self, to: &Path, force: bool) -> CorpusResult<u64> {
        write_svg(to, force, &self.sign_map_svg())
    }

    fn sign_map_svg(&self) -> String {
        let (side, margin) = MAP_SIDE_PX;
        let full_side = side + 2.0 * margin;
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {full_side} {full_side}\" font-family=\"sans-serif\" font-size=\"11\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fbfbfd\"/>\n"
        );
        // Glosses that overlap could not be read, so only the first one at a place is written.
        let mut taken: BTreeSet<(i32, i32)> = BTreeSet::new();
        for point in &self.signs {
            let [x, y] = [point.x, point.y].map(|coordinate| margin + side * coordinate);
            let colour = match point.origin {
                RecordOrigin::Captured => "#2b6cb0",
                RecordOrigin::Lexicon => "#718096",
                RecordOrigin::Made | RecordOrigin::Generated => "#b7791f",
            };
            let gloss = escape_markup(&point.gloss);
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
                let _ = writeln!(text, "<text x=\"{:.1}\" y=\"{:.1}\">{gloss}</text>", x + 4.0, y + 4.0);
            }
        }
        text.push_str("</svg>\n");
        text
    }
}

/// Returns a text as it stands in SVG and HTML, without control letters.
pub(crate) fn escape_markup(text: &str) -> String {
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
fn coding_features(
    coding: &BTreeMap<String, String>,
    components: &[SignComponent],
    inventories: &[StoredInventory],
    numbers: &mut HashMap<String, u32>,
) -> WeightedFeatures {
    let mut all: BTreeMap<u32, f32> = BTreeMap::new();
    for component in components {
        let mut weights: BTreeMap<String, f32> = BTreeMap::new();
        for (name, values) in coding {
            let Ok(field) = name.parse::<ComponentField>() else {
                continue;
            };
            if field.component != *component {
                continue;
            }
            let part = |stored: &&StoredInventory| {
                let feature = field.feature.as_ref().map(ToString::to_string);
                stored.inventory.component == field.component && stored.inventory.feature == feature
            };
            // A value that occurs twice says no more than once.
            for value in single_values(values).collect::<BTreeSet<_>>() {
                add_feature_weight(&mut weights, format!("{name}={value}"), CODING_FEATURE_WEIGHTS.0);
                let known_value = inventories
                    .iter()
                    .filter(part)
                    .find_map(|stored| Some((&stored.inventory, stored.inventory.find_inventory_value(value)?)));
                let Some((inventory, value)) = known_value else {
                    continue;
                };
                // A value with many features must not weigh more than one with few.
                let share = CODING_FEATURE_WEIGHTS.1 / (value.features.len().max(1) as f32).sqrt();
                for feature in &value.features {
                    add_feature_weight(&mut weights, format!("{name}:{feature}"), share);
                }
                for wider in inventory.broader_value_chain(&value.id).skip(1) {
                    add_feature_weight(&mut weights, format!("{name}={}", wider.id), CODING_FEATURE_WEIGHTS.2);
                }
            }
        }
        // Components with many values would otherwise outweigh the others.
        let length = weights.values().map(|weight| weight * weight).sum::<f32>().sqrt();
        for (name, weight) in weights {
            let next = numbers.len() as u32;
            let number = *numbers.entry(name).or_insert(next);
            *all.entry(number).or_default() += weight / length;
        }
    }
    all.into_iter().collect()
}

fn add_feature_weight(own: &mut BTreeMap<String, f32>, name: String, weight: f32) {
    let strongest = own.entry(name).or_default();
    // A wider value of two values counts once, by its strongest weight.
    *strongest = strongest.max(weight);
}

#[cfg(test)]
mod tests;
