//! Texts about writing systems, and about letters without a font.

texts! {
    NO_FONT: "No font of this computer has letters for: {scripts}. They are shown by their numbers.", "Aucune police de cet ordinateur n’a de lettres pour : {scripts}. Elles sont montrées par leurs numéros.";
    NO_FONT_HELP: "Install a font for it, such as Noto (on Debian: fonts-noto), and open the window again.", "Installez une police pour cela, comme Noto (sous Debian : fonts-noto), et rouvrez la fenêtre.";
    ARABIC: "Arabic", "arabe";
    ARMENIAN: "Armenian", "arménien";
    BENGALI: "Bengali", "bengali";
    CHINESE: "Chinese", "chinois";
    CYRILLIC: "Cyrillic", "cyrillique";
    DEVANAGARI: "Devanagari", "devanagari";
    ETHIOPIC: "Ethiopic", "éthiopien";
    GEORGIAN: "Georgian", "géorgien";
    GREEK: "Greek", "grec";
    HEBREW: "Hebrew", "hébreu";
    JAPANESE: "Japanese", "japonais";
    KOREAN: "Korean", "coréen";
    TAMIL: "Tamil", "tamoul";
    THAI: "Thai", "thaï";
}
