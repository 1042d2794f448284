//! Descriptions of the HamNoSys symbols, shown on hover.

use chereme_sign::hamnosys::SymbolClass;

use super::{InterfaceLanguage, InterfaceText, fill_text_braces};

texts! {
    EXTFINGER: "the fingers point {way}", "les doigts pointent {way}";
    MOVE: "moves {way}", "va {way}";
    PALM: "the palm faces {way}", "la paume regarde {way}";
    CIRCLE: "a circle, clockwise for who looks {way}", "un cercle, dans le sens des aiguilles pour qui regarde {way}";
    CLOCK: "at the circle’s point {way}", "au point du cercle {way}";
    COPY_SYMBOLS: "Copy as HamNoSys", "Copier en HamNoSys";
    COPY_NAMES: "Copy the names", "Copier les noms";
    STRIP: "HamNoSys: {names}", "HamNoSys : {names}";
    BOARD: "Symbols", "Symboles";
    FIND: "Type to find a symbol", "Taper pour trouver un symbole";
    TAKE_BACK: "Take back", "Retirer";
    NO_SYMBOL: "No symbol fits.", "Aucun symbole ne correspond.";
    HANDSHAPES: "Handshapes", "Configurations";
    THUMB_AND_BENDS: "Thumb and bends", "Pouce et flexions";
    FINGERS_POINT: "Where the fingers point", "Direction des doigts";
    PALM_FACES: "Where the palm faces", "Direction de la paume";
    PLACES: "Places", "Emplacements";
    ABOUT_PLACES: "About places", "Autour des emplacements";
    HAND_PARTS: "Parts of the hand", "Parties de la main";
    DIGITS: "Digits", "Doigts";
    FINGER_PARTS: "Parts of a finger", "Parties du doigt";
    CONTACTS: "Contacts", "Contacts";
    MOVEMENTS: "Movements", "Mouvements";
    ABOUT_MOVEMENTS: "About movements", "Autour des mouvements";
    MANNER: "Manner", "Manière";
    REPETITION: "Repetition", "Répétition";
    HANDS_AND_LINKS: "Hands, and between symbols", "Mains, et entre symboles";
    BRACKETS: "Brackets", "Crochets";
}

/// The classes of symbols in the order in which a sign is written, with their titles.
pub(crate) const SYMBOL_CLASS_TITLES: [(SymbolClass, InterfaceText); 16] = [
    (SymbolClass::Operator, HANDS_AND_LINKS),
    (SymbolClass::Handshape, HANDSHAPES),
    (SymbolClass::HandshapeMark, THUMB_AND_BENDS),
    (SymbolClass::ExtendedFinger, FINGERS_POINT),
    (SymbolClass::Palm, PALM_FACES),
    (SymbolClass::Location, PLACES),
    (SymbolClass::LocationMark, ABOUT_PLACES),
    (SymbolClass::HandPart, HAND_PARTS),
    (SymbolClass::Digit, DIGITS),
    (SymbolClass::FingerPart, FINGER_PARTS),
    (SymbolClass::Contact, CONTACTS),
    (SymbolClass::Movement, MOVEMENTS),
    (SymbolClass::MovementMark, ABOUT_MOVEMENTS),
    (SymbolClass::Manner, MANNER),
    (SymbolClass::Repetition, REPETITION),
    (SymbolClass::Bracket, BRACKETS),
];

/// Directions, by their letters in symbol names.
const DIRECTION_LETTER_TEXTS: [(char, InterfaceText); 6] = [
    ('u', symbol_word_text("up", "vers le haut")),
    ('d', symbol_word_text("down", "vers le bas")),
    ('l', symbol_word_text("left", "à gauche")),
    ('r', symbol_word_text("right", "à droite")),
    ('o', symbol_word_text("outwards", "vers l’avant")),
    ('i', symbol_word_text("towards the body", "vers soi")),
];

const fn symbol_word_text(en: &'static str, fr: &'static str) -> InterfaceText {
    InterfaceText::new(en, fr)
}

/// Returns the meaning of a symbol, given its name without `ham`.
pub(crate) fn symbol_meaning(name: &str, language: InterfaceLanguage) -> Option<String> {
    if let Some((_, text)) = SYMBOL_MEANING_TEXTS.iter().find(|(known, _)| *known == name) {
        return Some(text.text_in_language(language).to_owned());
    }
    let families = [
        ("extfinger", EXTFINGER),
        ("move", MOVE),
        ("palm", PALM),
        ("circle", CIRCLE),
        ("clock", CLOCK),
    ];
    families.iter().find_map(|(start, text)| {
        let letters = name.strip_prefix(start)?.chars();
        let directions = letters.map(|letter| {
            let direction = DIRECTION_LETTER_TEXTS.iter().find(|(known, _)| *known == letter)?;
            Some(direction.1.text_in_language(language))
        });
        let directions: Option<Vec<&str>> = directions.collect();
        let and = match language {
            InterfaceLanguage::French => " et ",
            InterfaceLanguage::English | InterfaceLanguage::Other(_) => " and ",
        };
        let direction = directions.filter(|directions| !directions.is_empty())?.join(and);
        Some(fill_text_braces(
            text.text_in_language(language),
            &[("way", &direction)],
        ))
    })
}

/// The meaning of symbols that are not directions.
#[rustfmt::skip]
const SYMBOL_MEANING_TEXTS: [(&str, InterfaceText); 139] = [
    ("space", symbol_word_text("a blank", "une espace")),
    ("exclaim", symbol_word_text("an exclamation mark", "un point d’exclamation")),
    ("comma", symbol_word_text("a comma", "une virgule")),
    ("fullstop", symbol_word_text("a full stop", "un point")),
    ("query", symbol_word_text("a question mark", "un point d’interrogation")),
    ("altbegin", symbol_word_text("alternatives begin", "début d’alternatives")),
    ("metaalt", symbol_word_text("or", "ou")),
    ("altend", symbol_word_text("alternatives end", "fin d’alternatives")),
    ("fist", symbol_word_text("fist", "poing")),
    ("flathand", symbol_word_text("flat hand, fingers together", "main plate, doigts serrés")),
    ("finger2", symbol_word_text("index finger stretched", "index tendu")),
    ("finger23", symbol_word_text("index and middle finger stretched, together", "index et majeur tendus, serrés")),
    ("finger23spread", symbol_word_text("index and middle finger stretched, spread", "index et majeur tendus, écartés")),
    ("finger2345", symbol_word_text("all fingers stretched and spread", "tous les doigts tendus et écartés")),
    ("pinch12", symbol_word_text("thumb and index finger touch", "pouce et index se touchent")),
    ("pinchall", symbol_word_text("thumb and all fingers touch", "pouce et tous les doigts se touchent")),
    ("pinch12open", symbol_word_text("thumb and index finger touch, the others spread", "pouce et index se touchent, les autres écartés")),
    ("cee12", symbol_word_text("thumb and index finger form an open C", "pouce et index forment un C ouvert")),
    ("ceeall", symbol_word_text("thumb and all fingers form a C", "pouce et tous les doigts forment un C")),
    ("ceeopen", symbol_word_text("thumb and index finger form a C, the others spread", "pouce et index forment un C, les autres écartés")),
    ("thumboutmod", symbol_word_text("thumb stretched out", "pouce écarté")),
    ("thumbacrossmod", symbol_word_text("thumb across the hand", "pouce en travers de la main")),
    ("thumbopenmod", symbol_word_text("thumb opposite the fingers", "pouce opposé aux doigts")),
    ("fingerstraightmod", symbol_word_text("fingers bent at the base only; after a symmetry sign: out and in exchanged", "doigts pliés à la base seulement ; après une symétrie : avant et arrière échangés")),
    ("fingerbendmod", symbol_word_text("fingers rounded", "doigts arrondis")),
    ("fingerhookmod", symbol_word_text("fingers hooked", "doigts en crochet")),
    ("doublebent", symbol_word_text("fingers bent at base and middle", "doigts pliés à la base et au milieu")),
    ("doublehooked", symbol_word_text("fingers bent at all joints", "doigts pliés à toutes les articulations")),
    ("head", symbol_word_text("head", "tête")),
    ("headtop", symbol_word_text("top of the head", "sommet de la tête")),
    ("forehead", symbol_word_text("forehead", "front")),
    ("eyebrows", symbol_word_text("eyebrows", "sourcils")),
    ("eyes", symbol_word_text("eyes", "yeux")),
    ("nose", symbol_word_text("nose", "nez")),
    ("nostrils", symbol_word_text("nostrils", "narines")),
    ("ear", symbol_word_text("ear", "oreille")),
    ("earlobe", symbol_word_text("ear lobe", "lobe de l’oreille")),
    ("cheek", symbol_word_text("cheek", "joue")),
    ("lips", symbol_word_text("lips", "lèvres")),
    ("tongue", symbol_word_text("tongue", "langue")),
    ("teeth", symbol_word_text("teeth", "dents")),
    ("chin", symbol_word_text("chin", "menton")),
    ("underchin", symbol_word_text("below the chin", "sous le menton")),
    ("neck", symbol_word_text("neck", "cou")),
    ("shouldertop", symbol_word_text("top of the shoulder", "dessus de l’épaule")),
    ("shoulders", symbol_word_text("at the height of the shoulders", "à hauteur des épaules")),
    ("chest", symbol_word_text("chest", "poitrine")),
    ("stomach", symbol_word_text("stomach", "ventre")),
    ("belowstomach", symbol_word_text("below the stomach", "bas-ventre")),
    ("lrbeside", symbol_word_text("beside: left before a place, right after it", "à côté : gauche avant un lieu, droite après")),
    ("lrat", symbol_word_text("at the side: left before a place, right after it", "sur le côté : gauche avant un lieu, droite après")),
    ("coreftag", symbol_word_text("names a place", "nomme un lieu")),
    ("corefref", symbol_word_text("the named place", "le lieu nommé")),
    ("neutralspace", symbol_word_text("space before the signer", "espace devant la personne")),
    ("upperarm", symbol_word_text("upper arm", "bras")),
    ("elbow", symbol_word_text("elbow", "coude")),
    ("elbowinside", symbol_word_text("inside of the elbow", "pli du coude")),
    ("lowerarm", symbol_word_text("forearm", "avant-bras")),
    ("wristback", symbol_word_text("back of the wrist", "dos du poignet")),
    ("wristpulse", symbol_word_text("inside of the wrist", "intérieur du poignet")),
    ("thumbball", symbol_word_text("ball of the thumb", "base charnue du pouce")),
    ("palm", symbol_word_text("palm", "paume")),
    ("handback", symbol_word_text("back of the hand", "dos de la main")),
    ("thumbside", symbol_word_text("edge of the hand towards the thumb", "bord de la main côté pouce")),
    ("pinkyside", symbol_word_text("edge of the hand towards the little finger", "bord de la main côté auriculaire")),
    ("thumb", symbol_word_text("thumb", "pouce")),
    ("indexfinger", symbol_word_text("index finger", "index")),
    ("middlefinger", symbol_word_text("middle finger", "majeur")),
    ("ringfinger", symbol_word_text("ring finger", "annulaire")),
    ("pinky", symbol_word_text("little finger", "auriculaire")),
    ("fingertip", symbol_word_text("fingertip", "bout du doigt")),
    ("fingernail", symbol_word_text("nail", "ongle")),
    ("fingerpad", symbol_word_text("pad of the finger", "pulpe du doigt")),
    ("fingermidjoint", symbol_word_text("middle joint of the finger", "articulation du milieu")),
    ("fingerbase", symbol_word_text("base of the finger", "base du doigt")),
    ("fingerside", symbol_word_text("side of the finger", "côté du doigt")),
    ("wristtopulse", symbol_word_text("inside of the wrist (no longer used)", "intérieur du poignet (n’est plus utilisé)")),
    ("wristtoback", symbol_word_text("back of the wrist (no longer used)", "dos du poignet (n’est plus utilisé)")),
    ("wristtothumb", symbol_word_text("wrist towards the thumb (no longer used)", "poignet côté pouce (n’est plus utilisé)")),
    ("wristtopinky", symbol_word_text("wrist towards the little finger (no longer used)", "poignet côté auriculaire (n’est plus utilisé)")),
    ("fingerplay", symbol_word_text("fingers wiggle", "les doigts frétillent")),
    ("nodding", symbol_word_text("the wrist nods", "le poignet hoche")),
    ("swinging", symbol_word_text("the hand swings to the sides", "la main se balance de côté")),
    ("twisting", symbol_word_text("the forearm twists", "l’avant-bras pivote")),
    ("stircw", symbol_word_text("the hand stirs clockwise", "la main remue dans le sens des aiguilles")),
    ("stirccw", symbol_word_text("the hand stirs anticlockwise", "la main remue dans le sens contraire")),
    ("replace", symbol_word_text("changes to the handshape or orientation that follows", "devient la configuration ou l’orientation qui suit")),
    ("movecross", symbol_word_text("a cross is drawn: +", "trace une croix : +")),
    ("moveX", symbol_word_text("a cross is drawn: ×", "trace une croix : ×")),
    ("nomotion", symbol_word_text("no movement", "aucun mouvement")),
    ("clockfull", symbol_word_text("one more full turn", "un tour entier de plus")),
    ("arcl", symbol_word_text("curved, to the left", "courbé, vers la gauche")),
    ("arcu", symbol_word_text("curved, upwards", "courbé, vers le haut")),
    ("arcr", symbol_word_text("curved, to the right", "courbé, vers la droite")),
    ("arcd", symbol_word_text("curved, downwards", "courbé, vers le bas")),
    ("wavy", symbol_word_text("in waves", "en vagues")),
    ("zigzag", symbol_word_text("in zigzag", "en zigzag")),
    ("ellipseh", symbol_word_text("an ellipse, lying", "une ellipse couchée")),
    ("ellipseur", symbol_word_text("an ellipse, rising to the right", "une ellipse montant à droite")),
    ("ellipsev", symbol_word_text("an ellipse, standing", "une ellipse debout")),
    ("ellipseul", symbol_word_text("an ellipse, rising to the left", "une ellipse montant à gauche")),
    ("increasing", symbol_word_text("growing", "croissant")),
    ("decreasing", symbol_word_text("shrinking", "décroissant")),
    ("smallmod", symbol_word_text("small", "petit")),
    ("largemod", symbol_word_text("big; after a symmetry sign: up and down exchanged", "grand ; après une symétrie : haut et bas échangés")),
    ("fast", symbol_word_text("fast", "rapide")),
    ("slow", symbol_word_text("slow", "lent")),
    ("tense", symbol_word_text("tense", "tendu")),
    ("rest", symbol_word_text("a pause", "une pause")),
    ("halt", symbol_word_text("a sudden stop", "un arrêt brusque")),
    ("close", symbol_word_text("close to", "près de")),
    ("touch", symbol_word_text("touches", "touche")),
    ("interlock", symbol_word_text("interlocked", "entrelacés")),
    ("cross", symbol_word_text("crossed", "croisés")),
    ("armextended", symbol_word_text("at arm’s length", "à bout de bras")),
    ("behind", symbol_word_text("behind the place", "derrière le lieu")),
    ("brushing", symbol_word_text("brushes on its way", "frôle en passant")),
    ("repeatfromstart", symbol_word_text("again from the beginning", "encore une fois depuis le début")),
    ("repeatfromstartseveral", symbol_word_text("several times from the beginning", "plusieurs fois depuis le début")),
    ("repeatcontinue", symbol_word_text("again, going on from the end", "encore, en continuant")),
    ("repeatcontinueseveral", symbol_word_text("several times, going on from the end", "plusieurs fois, en continuant")),
    ("repeatreverse", symbol_word_text("and back again", "puis en sens inverse")),
    ("alternatingmotion", symbol_word_text("the hands by turns", "les mains en alternance")),
    ("seqbegin", symbol_word_text("one after another: begin; or what is touched", "l’un après l’autre : début ; ou ce qui est touché")),
    ("seqend", symbol_word_text("one after another: end", "l’un après l’autre : fin")),
    ("parbegin", symbol_word_text("at once: begin", "en même temps : début")),
    ("parend", symbol_word_text("at once: end", "en même temps : fin")),
    ("fusionbegin", symbol_word_text("in one go: begin", "d’un seul élan : début")),
    ("fusionend", symbol_word_text("in one go: end", "d’un seul élan : fin")),
    ("between", symbol_word_text("between the two", "entre les deux")),
    ("plus", symbol_word_text("strong hand + weak hand", "main forte + main faible")),
    ("symmpar", symbol_word_text("both hands, in parallel", "les deux mains, en parallèle")),
    ("symmlr", symbol_word_text("both hands, mirrored", "les deux mains, en miroir")),
    ("nondominant", symbol_word_text("the weak hand", "la main faible")),
    ("nonipsi", symbol_word_text("hands stay where they are in space", "les mains gardent leur place dans l’espace")),
    ("etc", symbol_word_text("about so", "à peu près")),
    ("orirelative", symbol_word_text("orientation goes along with the movement", "l’orientation suit le mouvement")),
    ("mime", symbol_word_text("mimed", "mimé")),
    ("version40", symbol_word_text("HamNoSys 4.0", "HamNoSys 4.0")),
];

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::hamnosys::HamnosysSymbol;

    #[test]
    fn every_symbol_has_a_description_in_both_languages() {
        for symbol in HamnosysSymbol::all_symbols() {
            let name = symbol.symbol_name().strip_prefix("ham").expect("as all names");
            for language in [InterfaceLanguage::English, InterfaceLanguage::French] {
                let text = symbol_meaning(name, language).unwrap_or_default();
                assert!(!text.is_empty(), "{name}");
            }
        }
        assert_eq!(
            symbol_meaning("moveol", InterfaceLanguage::English).as_deref(),
            Some("moves outwards and left")
        );
        assert_eq!(symbol_meaning("nothing", InterfaceLanguage::French), None);
    }
}
