use super::*;

fn fonts_of_folder(folder: &std::path::Path) -> SystemFonts {
    let mut faces = Database::new();
    faces.load_fonts_dir(folder);
    SystemFonts::new(faces)
}

/// A folder with one font, which has Greek and Cyrillic letters, and no Arabic ones.
pub(in crate::letters) fn noto() -> (tempfile::TempDir, SystemFonts) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("NotoSans.ttf");
    std::fs::write(file, notosans::REGULAR_TTF).expect("a font");
    std::fs::write(folder.path().join("broken.ttf"), b"\0\x01\0\0 no font").expect("a file");
    let fonts = fonts_of_folder(folder.path());
    (folder, fonts)
}

#[test]
fn fonts_are_read_on_demand_and_missing_characters_reported_once() {
    let (_folder, fonts) = noto();
    assert!(fonts.lock_search_results().loaded.is_empty());
    let cyrillic = fonts.find_letter_font('Ж').expect("a font");
    assert!(cyrillic.name.starts_with("Noto Sans"), "{}", cyrillic.name);
    let greek = fonts.find_letter_font('Ω').expect("a font");
    assert!(Arc::ptr_eq(&cyrillic, &greek));
    assert_eq!(fonts.lock_search_results().loaded.len(), 1);
    assert!(fonts.find_letter_font('ع').is_none());
    assert!(fonts.find_letter_font('ع').is_none());
    assert_eq!(Vec::from_iter(fonts.take_missing()), ['ع']);
    assert!(fonts.find_letter_font('ع').is_none());
    assert!(fonts.take_missing().is_empty());
}

#[test]
fn a_computer_without_fonts_has_none() {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(fonts_of_folder(folder.path()).find_letter_font('a').is_none());
}
