//! The fonts of this computer, found by the characters that they have.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use fontdb::{Database, FaceInfo, ID, Stretch, Style};
use skrifa::{FontRef, MetadataProvider};

/// The largest font file that is read, in bytes.
const MOST_FILE: usize = 48 << 20;
/// The most bytes of fonts in memory.
const MOST_KEPT: usize = 192 << 20;
/// The most remembered characters with a font.
const MOST_KNOWN: usize = 1 << 16;
/// The most remembered characters without a font.
const MOST_MISSING: usize = 512;

/// A font that was loaded for a text.
#[derive(Debug)]
pub struct FontFile {
    /// Its family, with a number that distinguishes it from other fonts of the family.
    pub name: String,
    /// The bytes of its file.
    pub data: Vec<u8>,
    /// The index of the font in the file.
    pub index: u32,
}

impl AsRef<[u8]> for FontFile {
    fn as_ref(&self) -> &[u8] {
        &self.data
    }
}

impl FontFile {
    /// Returns the tables of the font.
    pub(super) fn font_tables(&self) -> Option<FontRef<'_>> {
        FontRef::from_index(&self.data, self.index).ok()
    }
}

/// The fonts of this computer, once their names have been read.
static SHARED_SYSTEM_FONTS: OnceLock<SystemFonts> = OnceLock::new();

/// The fonts in some folders. Initially only their names are read; a whole font is read when a character
/// needs it.
#[derive(Debug)]
pub struct SystemFonts {
    faces: Database,
    /// The fonts in the order of the search; plain ones come first.
    order: Vec<ID>,
    known: Mutex<FontSearchResults>,
}

/// Results of earlier searches.
#[derive(Debug, Default)]
struct FontSearchResults {
    loaded: Vec<(ID, Arc<FontFile>)>,
    kept: usize,
    of: BTreeMap<char, Option<usize>>,
    missing: BTreeSet<char>,
}

impl SystemFonts {
    /// Returns the fonts of this computer; the first caller waits until their names have been read.
    #[must_use]
    pub fn shared_system_fonts() -> &'static Self {
        SHARED_SYSTEM_FONTS.get_or_init(|| {
            let mut faces = Database::new();
            faces.load_system_fonts();
            Self::new(faces)
        })
    }

    /// Returns the fonts of this computer if their names have been read.
    #[must_use]
    pub fn ready_system_fonts() -> Option<&'static Self> {
        SHARED_SYSTEM_FONTS.get()
    }

    /// Reads the names of the fonts of this computer on a thread of its own, so that later callers do not
    /// wait.
    pub fn prepare_system_fonts() {
        std::thread::spawn(|| {
            let _ = Self::shared_system_fonts();
        });
    }

    fn new(faces: Database) -> Self {
        let mut order: Vec<(FontFaceRank, ID)> = faces.faces().map(|face| (rank_font_face(face), face.id)).collect();
        order.sort_by(|a, b| a.0.cmp(&b.0));
        Self {
            order: order.into_iter().map(|(_, id)| id).collect(),
            faces,
            known: Mutex::default(),
        }
    }

    /// Returns a font that draws a character; prefers one that is already loaded.
    #[must_use]
    pub fn find_letter_font(&self, letter: char) -> Option<Arc<FontFile>> {
        let mut known_fonts = self.lock_search_results();
        // A character without a font is remembered too, so that it is not searched again.
        if let Some(found) = known_fonts.of.get(&letter) {
            let font_index = (*found)?;
            return known_fonts.loaded.get(font_index).map(|(_, font)| font.clone());
        }
        let font_index = known_fonts
            .loaded
            .iter()
            // A loaded font is preferred: texts look even, and fonts take memory.
            .position(|(_, font)| draws(&font.data, font.index, letter))
            .or_else(|| self.load_letter_font(&mut known_fonts, letter));
        // All are forgotten at once; the loaded fonts stay.
        if known_fonts.of.len() >= MOST_KNOWN {
            known_fonts.of.clear();
        }
        known_fonts.of.insert(letter, font_index);
        match font_index {
            Some(at) => known_fonts.loaded.get(at).map(|(_, font)| font.clone()),
            None => {
                // A list that nobody takes must not grow for ever.
                if known_fonts.missing.len() < MOST_MISSING {
                    known_fonts.missing.insert(letter);
                }
                None
            }
        }
    }

    /// Returns the characters requested since the last call that no font has.
    #[must_use]
    pub fn take_missing(&self) -> BTreeSet<char> {
        std::mem::take(&mut self.lock_search_results().missing)
    }

    fn lock_search_results(&self) -> MutexGuard<'_, FontSearchResults> {
        // A thread that panicked leaves the results whole, as each is written at once.
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn load_letter_font(&self, known: &mut FontSearchResults, letter: char) -> Option<usize> {
        for id in &self.order {
            let fits = |data: &[u8], index| {
                // Fonts beyond the limit are passed over, and the character is drawn as a frame.
                let room = MOST_KEPT.saturating_sub(known.kept).min(MOST_FILE);
                (data.len() <= room && draws(data, index, letter)).then(|| (data.to_vec(), index))
            };
            let Some((data, index)) = self.faces.with_face_data(*id, fits).flatten() else {
                continue;
            };
            let first_family = self.faces.face(*id).and_then(|face| face.families.first());
            let family = first_family.map_or("font", |(name, _)| name);
            // The number distinguishes fonts of one family.
            let font_index = known.loaded.len();
            known.kept += data.len();
            let name = format!("{family} ({font_index})");
            let font = Arc::new(FontFile { name, data, index });
            known.loaded.push((*id, font));
            return Some(font_index);
        }
        None
    }
}

/// Returns whether a font has the outline of a character.
fn draws(data: &[u8], index: u32, letter: char) -> bool {
    let Ok(font) = FontRef::from_index(data, index) else {
        return false;
    };
    let glyph = font.charmap().map(letter);
    glyph.is_some_and(|glyph| font.outline_glyphs().get(glyph).is_some())
}

/// The rank of a font: its difference from a plain upright one, then its name, so that the same fonts always have the
/// same order.
type FontFaceRank = (u32, bool, String, u32);

fn rank_font_face(face: &FaceInfo) -> FontFaceRank {
    let family_name = face.families.first().map_or("", |(name, _)| name);
    let name = family_name.to_lowercase();
    let has = |part: &str| u32::from(name.contains(part));
    // A slanted font is worse than any weight, and an emoji font worse than both.
    let slanted = u32::from(face.style != Style::Normal) * 4000;
    let narrow = u32::from(face.stretch != Stretch::Normal) * 2000;
    let heavy = u32::from(face.weight.0.abs_diff(400));
    let odd = has("emoji") * 6000 + has("unifont") * 5000 + has("last resort") * 9000;
    let styled = (has("serif") + has("mono") + has("display") + has("nastaliq")) * 150;
    let far = slanted + narrow + heavy + odd + styled;
    let path = format!("{name}\0{}", face.post_script_name);
    (far, !name.starts_with("noto sans"), path, face.index)
}

#[cfg(test)]
pub(super) mod tests;
