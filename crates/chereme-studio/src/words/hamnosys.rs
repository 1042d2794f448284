//! Descriptions of the HamNoSys symbols, shown on hover.

use chereme_sign::hamnosys::Class;

use super::{Language, Text, fill};

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
pub(crate) const CLASSES: [(Class, Text); 16] = [
    (Class::Operator, HANDS_AND_LINKS),
    (Class::Handshape, HANDSHAPES),
    (Class::HandshapeMark, THUMB_AND_BENDS),
    (Class::ExtendedFinger, FINGERS_POINT),
    (Class::Palm, PALM_FACES),
    (Class::Location, PLACES),
    (Class::LocationMark, ABOUT_PLACES),
    (Class::HandPart, HAND_PARTS),
    (Class::Digit, DIGITS),
    (Class::FingerPart, FINGER_PARTS),
    (Class::Contact, CONTACTS),
    (Class::Movement, MOVEMENTS),
    (Class::MovementMark, ABOUT_MOVEMENTS),
    (Class::Manner, MANNER),
    (Class::Repetition, REPETITION),
    (Class::Bracket, BRACKETS),
];

/// Directions, by their letters in symbol names.
const DIRECTIONS: [(char, Text); 6] = [
    ('u', text("up", "vers le haut")),
    ('d', text("down", "vers le bas")),
    ('l', text("left", "à gauche")),
    ('r', text("right", "à droite")),
    ('o', text("outwards", "vers l’avant")),
    ('i', text("towards the body", "vers soi")),
];

const fn text(en: &'static str, fr: &'static str) -> Text {
    Text::new(en, fr)
}

/// Returns the meaning of a symbol, given its name without `ham`.
pub(crate) fn meaning(name: &str, language: Language) -> Option<String> {
    if let Some((_, text)) = MEANINGS.iter().find(|(known, _)| *known == name) {
        return Some(text.of(language).to_owned());
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
            let direction = DIRECTIONS.iter().find(|(known, _)| *known == letter)?;
            Some(direction.1.of(language))
        });
        let directions: Option<Vec<&str>> = directions.collect();
        let and = match language {
            Language::French => " et ",
            Language::English | Language::Other(_) => " and ",
        };
        let direction = directions
            .filter(|directions| !directions.is_empty())?
            .join(and);
        Some(fill(text.of(language), &[("way", &direction)]))
    })
}

/// The meaning of symbols that are not directions.
#[rustfmt::skip]
const MEANINGS: [(&str, Text); 139] = [
    ("space", text("a blank", "une espace")),
    ("exclaim", text("an exclamation mark", "un point d’exclamation")),
    ("comma", text("a comma", "une virgule")),
    ("fullstop", text("a full stop", "un point")),
    ("query", text("a question mark", "un point d’interrogation")),
    ("altbegin", text("alternatives begin", "début d’alternatives")),
    ("metaalt", text("or", "ou")),
    ("altend", text("alternatives end", "fin d’alternatives")),
    ("fist", text("fist", "poing")),
    ("flathand", text("flat hand, fingers together", "main plate, doigts serrés")),
    ("finger2", text("index finger stretched", "index tendu")),
    ("finger23", text("index and middle finger stretched, together", "index et majeur tendus, serrés")),
    ("finger23spread", text("index and middle finger stretched, spread", "index et majeur tendus, écartés")),
    ("finger2345", text("all fingers stretched and spread", "tous les doigts tendus et écartés")),
    ("pinch12", text("thumb and index finger touch", "pouce et index se touchent")),
    ("pinchall", text("thumb and all fingers touch", "pouce et tous les doigts se touchent")),
    ("pinch12open", text("thumb and index finger touch, the others spread", "pouce et index se touchent, les autres écartés")),
    ("cee12", text("thumb and index finger form an open C", "pouce et index forment un C ouvert")),
    ("ceeall", text("thumb and all fingers form a C", "pouce et tous les doigts forment un C")),
    ("ceeopen", text("thumb and index finger form a C, the others spread", "pouce et index forment un C, les autres écartés")),
    ("thumboutmod", text("thumb stretched out", "pouce écarté")),
    ("thumbacrossmod", text("thumb across the hand", "pouce en travers de la main")),
    ("thumbopenmod", text("thumb opposite the fingers", "pouce opposé aux doigts")),
    ("fingerstraightmod", text("fingers bent at the base only; after a symmetry sign: out and in exchanged", "doigts pliés à la base seulement ; après une symétrie : avant et arrière échangés")),
    ("fingerbendmod", text("fingers rounded", "doigts arrondis")),
    ("fingerhookmod", text("fingers hooked", "doigts en crochet")),
    ("doublebent", text("fingers bent at base and middle", "doigts pliés à la base et au milieu")),
    ("doublehooked", text("fingers bent at all joints", "doigts pliés à toutes les articulations")),
    ("head", text("head", "tête")),
    ("headtop", text("top of the head", "sommet de la tête")),
    ("forehead", text("forehead", "front")),
    ("eyebrows", text("eyebrows", "sourcils")),
    ("eyes", text("eyes", "yeux")),
    ("nose", text("nose", "nez")),
    ("nostrils", text("nostrils", "narines")),
    ("ear", text("ear", "oreille")),
    ("earlobe", text("ear lobe", "lobe de l’oreille")),
    ("cheek", text("cheek", "joue")),
    ("lips", text("lips", "lèvres")),
    ("tongue", text("tongue", "langue")),
    ("teeth", text("teeth", "dents")),
    ("chin", text("chin", "menton")),
    ("underchin", text("below the chin", "sous le menton")),
    ("neck", text("neck", "cou")),
    ("shouldertop", text("top of the shoulder", "dessus de l’épaule")),
    ("shoulders", text("at the height of the shoulders", "à hauteur des épaules")),
    ("chest", text("chest", "poitrine")),
    ("stomach", text("stomach", "ventre")),
    ("belowstomach", text("below the stomach", "bas-ventre")),
    ("lrbeside", text("beside: left before a place, right after it", "à côté : gauche avant un lieu, droite après")),
    ("lrat", text("at the side: left before a place, right after it", "sur le côté : gauche avant un lieu, droite après")),
    ("coreftag", text("names a place", "nomme un lieu")),
    ("corefref", text("the named place", "le lieu nommé")),
    ("neutralspace", text("space before the signer", "espace devant la personne")),
    ("upperarm", text("upper arm", "bras")),
    ("elbow", text("elbow", "coude")),
    ("elbowinside", text("inside of the elbow", "pli du coude")),
    ("lowerarm", text("forearm", "avant-bras")),
    ("wristback", text("back of the wrist", "dos du poignet")),
    ("wristpulse", text("inside of the wrist", "intérieur du poignet")),
    ("thumbball", text("ball of the thumb", "base charnue du pouce")),
    ("palm", text("palm", "paume")),
    ("handback", text("back of the hand", "dos de la main")),
    ("thumbside", text("edge of the hand towards the thumb", "bord de la main côté pouce")),
    ("pinkyside", text("edge of the hand towards the little finger", "bord de la main côté auriculaire")),
    ("thumb", text("thumb", "pouce")),
    ("indexfinger", text("index finger", "index")),
    ("middlefinger", text("middle finger", "majeur")),
    ("ringfinger", text("ring finger", "annulaire")),
    ("pinky", text("little finger", "auriculaire")),
    ("fingertip", text("fingertip", "bout du doigt")),
    ("fingernail", text("nail", "ongle")),
    ("fingerpad", text("pad of the finger", "pulpe du doigt")),
    ("fingermidjoint", text("middle joint of the finger", "articulation du milieu")),
    ("fingerbase", text("base of the finger", "base du doigt")),
    ("fingerside", text("side of the finger", "côté du doigt")),
    ("wristtopulse", text("inside of the wrist (no longer used)", "intérieur du poignet (n’est plus utilisé)")),
    ("wristtoback", text("back of the wrist (no longer used)", "dos du poignet (n’est plus utilisé)")),
    ("wristtothumb", text("wrist towards the thumb (no longer used)", "poignet côté pouce (n’est plus utilisé)")),
    ("wristtopinky", text("wrist towards the little finger (no longer used)", "poignet côté auriculaire (n’est plus utilisé)")),
    ("fingerplay", text("fingers wiggle", "les doigts frétillent")),
    ("nodding", text("the wrist nods", "le poignet hoche")),
    ("swinging", text("the hand swings to the sides", "la main se balance de côté")),
    ("twisting", text("the forearm twists", "l’avant-bras pivote")),
    ("stircw", text("the hand stirs clockwise", "la main remue dans le sens des aiguilles")),
    ("stirccw", text("the hand stirs anticlockwise", "la main remue dans le sens contraire")),
    ("replace", text("changes to the handshape or orientation that follows", "devient la configuration ou l’orientation qui suit")),
    ("movecross", text("a cross is drawn: +", "trace une croix : +")),
    ("moveX", text("a cross is drawn: ×", "trace une croix : ×")),
    ("nomotion", text("no movement", "aucun mouvement")),
    ("clockfull", text("one more full turn", "un tour entier de plus")),
    ("arcl", text("curved, to the left", "courbé, vers la gauche")),
    ("arcu", text("curved, upwards", "courbé, vers le haut")),
    ("arcr", text("curved, to the right", "courbé, vers la droite")),
    ("arcd", text("curved, downwards", "courbé, vers le bas")),
    ("wavy", text("in waves", "en vagues")),
    ("zigzag", text("in zigzag", "en zigzag")),
    ("ellipseh", text("an ellipse, lying", "une ellipse couchée")),
    ("ellipseur", text("an ellipse, rising to the right", "une ellipse montant à droite")),
    ("ellipsev", text("an ellipse, standing", "une ellipse debout")),
    ("ellipseul", text("an ellipse, rising to the left", "une ellipse montant à gauche")),
    ("increasing", text("growing", "croissant")),
    ("decreasing", text("shrinking", "décroissant")),
    ("smallmod", text("small", "petit")),
    ("largemod", text("big; after a symmetry sign: up and down exchanged", "grand ; après une symétrie : haut et bas échangés")),
    ("fast", text("fast", "rapide")),
    ("slow", text("slow", "lent")),
    ("tense", text("tense", "tendu")),
    ("rest", text("a pause", "une pause")),
    ("halt", text("a sudden stop", "un arrêt brusque")),
    ("close", text("close to", "près de")),
    ("touch", text("touches", "touche")),
    ("interlock", text("interlocked", "entrelacés")),
    ("cross", text("crossed", "croisés")),
    ("armextended", text("at arm’s length", "à bout de bras")),
    ("behind", text("behind the place", "derrière le lieu")),
    ("brushing", text("brushes on its way", "frôle en passant")),
    ("repeatfromstart", text("again from the beginning", "encore une fois depuis le début")),
    ("repeatfromstartseveral", text("several times from the beginning", "plusieurs fois depuis le début")),
    ("repeatcontinue", text("again, going on from the end", "encore, en continuant")),
    ("repeatcontinueseveral", text("several times, going on from the end", "plusieurs fois, en continuant")),
    ("repeatreverse", text("and back again", "puis en sens inverse")),
    ("alternatingmotion", text("the hands by turns", "les mains en alternance")),
    ("seqbegin", text("one after another: begin; or what is touched", "l’un après l’autre : début ; ou ce qui est touché")),
    ("seqend", text("one after another: end", "l’un après l’autre : fin")),
    ("parbegin", text("at once: begin", "en même temps : début")),
    ("parend", text("at once: end", "en même temps : fin")),
    ("fusionbegin", text("in one go: begin", "d’un seul élan : début")),
    ("fusionend", text("in one go: end", "d’un seul élan : fin")),
    ("between", text("between the two", "entre les deux")),
    ("plus", text("strong hand + weak hand", "main forte + main faible")),
    ("symmpar", text("both hands, in parallel", "les deux mains, en parallèle")),
    ("symmlr", text("both hands, mirrored", "les deux mains, en miroir")),
    ("nondominant", text("the weak hand", "la main faible")),
    ("nonipsi", text("hands stay where they are in space", "les mains gardent leur place dans l’espace")),
    ("etc", text("about so", "à peu près")),
    ("orirelative", text("orientation goes along with the movement", "l’orientation suit le mouvement")),
    ("mime", text("mimed", "mimé")),
    ("version40", text("HamNoSys 4.0", "HamNoSys 4.0")),
];

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::hamnosys::Symbol;

    #[test]
    fn every_symbol_has_a_description_in_both_languages() {
        for symbol in Symbol::all() {
            let name = symbol.name().strip_prefix("ham").expect("as all names");
            for language in [Language::English, Language::French] {
                let text = meaning(name, language).unwrap_or_default();
                assert!(!text.is_empty(), "{name}");
            }
        }
        assert_eq!(
            meaning("moveol", Language::English).as_deref(),
            Some("moves outwards and left")
        );
        assert_eq!(meaning("nothing", Language::French), None);
    }
}
