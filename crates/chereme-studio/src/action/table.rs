//! Every action, in the order of the menus.
//!
//! A row: the variant, the name in the settings file, the words in English and French; menu, where its keys count, who
//! carries it out, whether it changes the corpus (`edits`: annotations at once) and whether a held key repeats it, and the keys of ELAN 6.9, of Praat
//! and of video editors. Several keys are parted by blanks; `none` is none; `=` is the same as ELAN's. `Runs` holds a use
//! case on the selection, as a closure that returns its job.

use super::{ActionRow, Context, Menu, Owner};
use crate::panes::PaneKind::{
    Agreement, Cue, Faces, Film, History, Import, Inspector, Library, Map, Recombine, Search,
    Stage, Studies, Timeline,
};
use crate::words::{Text, shell};
use crate::work::{Job, Outcome};

actions! {
    OpenStarter "file.starter" "Open the starter corpus" | "Ouvrir le corpus de départ"
        File, Everywhere, Window, "none" "none" "none";
    Open "file.open" "Open a corpus…" | "Ouvrir un corpus…"
        File, Everywhere, Window, "Ctrl+O" "=" "=";
    New "file.new" "New empty corpus…" | "Nouveau corpus vide…"
        File, Everywhere, Window, "none" "none" "none";
    Import "file.import" "Import…" | "Importer…"
        File, Corpus, Shows(Import), changes, "Ctrl+Shift+I" "=" "Ctrl+I";
    ImportFiles "file.import-files" "Choose files to import…" | "Choisir des fichiers à importer…"
        File, Corpus, Window, changes, "none" "none" "none";
    ImportFolder "file.import-folder" "Choose a folder to import…" | "Choisir un dossier à importer…"
        File, Corpus, Window, changes, "none" "none" "none";
    MergeCorpus "file.merge" "Merge another corpus…" | "Fusionner avec un autre corpus…"
        File, Corpus, WithCorpus, changes, "none" "none" "none";
    Export "file.export" "Export…" | "Exporter…"
        File, Corpus, Window, "Ctrl+Shift+E" "=" "=";
    Close "file.close" "Close the corpus" | "Fermer le corpus"
        File, Corpus, Window, "Ctrl+W" "=" "=";
    Check "file.check" "Check the corpus" | "Vérifier le corpus"
        File, Corpus, Runs(|seen| {
            let mend = !seen.snapshot.is_read_only();
            Ok(Job::long(shell::TASK_CHECK, move |corpus, progress| {
                let report = corpus.check(false, progress)?;
                let mended = match mend && !report.ok {
                    true => corpus.check(true, progress)?,
                    false => report,
                };
                Ok(Outcome::Checked(mended))
            }))
        }), "none" "none" "none";
    Settings "file.settings" "Settings" | "Réglages"
        File, Everywhere, Window, "Ctrl+Comma" "=" "=";
    Quit "file.quit" "Quit" | "Quitter"
        File, Everywhere, Window, "Ctrl+Q" "=" "=";
    Undo "edit.undo" "Undo" | "Annuler"
        Edit, Corpus, WithCorpus, changes repeats, "Ctrl+Z" "=" "=";
    Redo "edit.redo" "Redo" | "Rétablir"
        Edit, Corpus, WithCorpus, changes repeats, "Ctrl+Y Ctrl+Shift+Z" "=" "=";
    Search "edit.search" "Search" | "Rechercher"
        Edit, Corpus, Shows(Search), "Ctrl+F" "=" "=";
    SearchLike "edit.search-like" "Search for signs like this" | "Rechercher des signes comme celui-ci"
        Edit, Corpus, In(Search), "Ctrl+Shift+F" "=" "=";
    SearchView "edit.search-view" "Hits as figures or as a table" | "Résultats en figures ou en tableau"
        Edit, Corpus, In(Search), "Ctrl+Shift+G" "=" "=";
    FitMarkers "library.fit" "Fit a body to the markers…" | "Ajuster un corps aux marqueurs…"
        Edit, Corpus, In(Library), changes, "none" "none" "none";
    DeleteListed "library.delete" "Delete from the corpus" | "Supprimer du fonds"
        Edit, Pane(Library), In(Library), changes, "Delete" "=" "=";
    ClearSelection "edit.clear-selection" "Clear the selection" | "Effacer la sélection"
        Edit, Corpus, WithCorpus, "Shift+Alt+C" "=" "Ctrl+D";
    Copy "edit.copy" "Copy the annotations" | "Copier les annotations"
        Edit, Corpus, In(Timeline), "Ctrl+C" "=" "=";
    CopyWithBelow "edit.copy-with-below" "Copy the annotations with their dependents" | "Copier les annotations avec celles qui en dépendent"
        Edit, Corpus, In(Timeline), "Ctrl+Alt+C" "=" "=";
    Cut "edit.cut" "Cut the annotations" | "Couper les annotations"
        Edit, Corpus, In(Timeline), edits, "Ctrl+X" "=" "=";
    Paste "edit.paste" "Paste at the times copied" | "Coller aux temps copiés"
        Edit, Corpus, WithCorpus, edits, "Ctrl+V" "=" "Ctrl+Shift+V";
    PasteHere "edit.paste-here" "Paste at the playhead" | "Coller au curseur"
        Edit, Corpus, WithCorpus, edits, "Ctrl+Shift+V" "=" "Ctrl+V";
    CopyTime "edit.copy-time" "Copy the time of the playhead" | "Copier le temps du curseur"
        Edit, Corpus, In(Timeline), "Ctrl+Alt+G" "=" "=";
    NewAnnotation "annotation.new" "New annotation on the selection" | "Nouvelle annotation sur la sélection"
        Annotation, Corpus, In(Timeline), changes, "Ctrl+Alt+N" "=" "Ctrl+Alt+N N";
    NewBefore "annotation.new-before" "New annotation before this one" | "Nouvelle annotation avant celle-ci"
        Annotation, Corpus, In(Timeline), changes, "Ctrl+Shift+N" "=" "=";
    NewAfter "annotation.new-after" "New annotation after this one" | "Nouvelle annotation après celle-ci"
        Annotation, Corpus, In(Timeline), changes, "Shift+Alt+N" "=" "=";
    NewBelow "annotation.new-below" "Annotations on the tiers below" | "Annotations sur les acteurs dépendants"
        Annotation, Corpus, In(Timeline), edits, "Ctrl+Shift+Alt+D" "=" "=";
    Duplicate "annotation.duplicate" "Duplicate the annotation" | "Dupliquer l’annotation"
        Annotation, Corpus, In(Timeline), edits, "Ctrl+D" "=" "Alt+D";
    BeginEndAnnotation "annotation.begin-end" "Begin or end an annotation at the playhead" | "Commencer ou finir une annotation au curseur"
        Annotation, Corpus, In(Timeline), edits, "Shift+Enter" "=" "=";
    SplitAnnotation "annotation.split" "Split the annotation at the playhead" | "Scinder l’annotation au curseur"
        Annotation, Corpus, In(Timeline), edits, "Ctrl+Alt+S" "=" "Ctrl+B S";
    MergeAnnotation "annotation.merge" "Merge with the next annotation" | "Fusionner avec l’annotation suivante"
        Annotation, Corpus, In(Timeline), edits, "Ctrl+Shift+A" "=" "=";
    MergePrevious "annotation.merge-previous" "Merge with the previous annotation" | "Fusionner avec l’annotation précédente"
        Annotation, Corpus, In(Timeline), edits, "Ctrl+Shift+B" "=" "=";
    DeleteAnnotation "annotation.delete" "Delete the annotation" | "Supprimer l’annotation"
        Annotation, Corpus, In(Timeline), edits, "Ctrl+Alt+D Delete" "Alt+Backspace Delete" "Delete";
    UseInRecipe "recombine.use" "Use in the recipe" | "Utiliser dans la recette"
        Edit, Corpus, WithCorpus, "Ctrl+Alt+R" "=" "=";
    OpenRecipe "recombine.open-recipe" "Open its recipe again" | "Rouvrir sa recette"
        Edit, Corpus, WithCorpus, "none" "none" "none";
    RecombineSelected "recombine.selected" "Recombine what is selected" | "Recombiner la sélection"
        Edit, Corpus, In(Recombine), "Ctrl+Shift+R" "=" "=";
    StoreSign "recombine.store" "Store the result: its gloss" | "Enregistrer le signe produit : sa glose"
        Edit, Corpus, WithCorpus, changes, "Ctrl+S" "=" "=";
    CardUp "recombine.card-up" "Card up" | "Monter la carte"
        Edit, Pane(Recombine), In(Recombine), repeats, "Alt+Up" "=" "=";
    CardDown "recombine.card-down" "Card down" | "Descendre la carte"
        Edit, Pane(Recombine), In(Recombine), repeats, "Alt+Down" "=" "=";
    CardDuplicate "recombine.card-duplicate" "Duplicate the card" | "Dupliquer la carte"
        Edit, Pane(Recombine), In(Recombine), "Ctrl+Shift+D" "=" "=";
    CardSwitch "recombine.card-switch" "Switch the card on or off" | "Carte en ou hors service"
        Edit, Pane(Recombine), In(Recombine), "Alt+Enter" "=" "=";
    CardRemove "recombine.card-remove" "Remove the card" | "Retirer la carte"
        Edit, Pane(Recombine), In(Recombine), "Alt+Delete" "=" "=";
    CopyToTier "annotation.copy-to-tier" "Copy to another tier…" | "Copier vers un autre acteur…"
        Annotation, Corpus, In(Timeline), changes, "Ctrl+Shift+D" "=" "=";
    MoveToTier "annotation.move-to-tier" "Move to another tier…" | "Déplacer vers un autre acteur…"
        Annotation, Corpus, In(Timeline), changes, "Ctrl+Shift+M" "=" "=";
    NextAnnotation "annotation.next" "Next annotation" | "Annotation suivante"
        Annotation, Corpus, In(Timeline), repeats, "Alt+Right" "=" "Alt+Right Tab";
    PreviousAnnotation "annotation.previous" "Previous annotation" | "Annotation précédente"
        Annotation, Corpus, In(Timeline), repeats, "Alt+Left" "=" "Alt+Left Shift+Tab";
    FirstAnnotation "annotation.first" "First annotation" | "Première annotation"
        Annotation, Corpus, In(Timeline), "Alt+Home" "=" "=";
    LastAnnotation "annotation.last" "Last annotation" | "Dernière annotation"
        Annotation, Corpus, In(Timeline), "Alt+End" "=" "=";
    NextDisagreement "agreement.next" "Next disagreement of two annotators" | "Désaccord suivant de deux annotateurs"
        Annotation, Corpus, In(Agreement), repeats, "Alt+PageDown" "=" "=";
    PreviousDisagreement "agreement.previous" "Previous disagreement of two annotators" | "Désaccord précédent de deux annotateurs"
        Annotation, Corpus, In(Agreement), repeats, "Alt+PageUp" "=" "=";
    AnnotationBelow "annotation.below" "Annotation on the tier below" | "Annotation sur l’acteur du dessous"
        Annotation, Corpus, In(Timeline), repeats, "Alt+Down" "=" "=";
    AnnotationAbove "annotation.above" "Annotation on the tier above" | "Annotation sur l’acteur du dessus"
        Annotation, Corpus, In(Timeline), repeats, "Alt+Up" "=" "=";
    AlsoNext "annotation.also-next" "Select the next annotation too" | "Sélectionner aussi l’annotation suivante"
        Annotation, Corpus, In(Timeline), repeats, "Ctrl+Alt+Right" "=" "=";
    AlsoPrevious "annotation.also-previous" "Select the previous annotation too" | "Sélectionner aussi l’annotation précédente"
        Annotation, Corpus, In(Timeline), repeats, "Ctrl+Alt+Left" "=" "=";
    SelectOnTier "annotation.select-on-tier" "Select all on the tier" | "Tout sélectionner sur l’acteur"
        Annotation, Corpus, In(Timeline), "Ctrl+A" "Ctrl+Alt+A" "=";
    EnterValue "value.enter" "Accept the proposal, or type the value" | "Accepter la proposition, ou saisir la valeur"
        Value, Corpus, In(Timeline), edits, "Enter" "=" "=";
    EditValue "value.edit" "Type the value" | "Saisir la valeur"
        Value, Corpus, In(Timeline), changes, "F2 Ctrl+Alt+M" "=" "=";
    Propose "value.propose" "Propose values from movement" | "Proposer des valeurs d’après le mouvement"
        Value, Corpus, In(Timeline), changes, "Ctrl+Alt+P" "=" "=";
    Detect "value.detect" "Propose with a detector…" | "Proposer avec un détecteur…"
        Value, Corpus, In(Timeline), changes, "Ctrl+Shift+Alt+P" "=" "=";
    AcceptProposal "value.accept" "Accept the proposal" | "Accepter la proposition"
        Value, Corpus, In(Timeline), edits, "Alt+Enter" "=" "=";
    NextProposal "value.next-proposal" "Next doubtful proposal" | "Proposition douteuse suivante"
        Value, Corpus, In(Timeline), changes repeats, "Alt+N" "=" "=";
    PictureValue "value.picture" "Choose the value by picture" | "Choisir la valeur en image"
        Value, Corpus, In(Timeline), changes, "F3" "=" "=";
    ClearValue "value.clear" "Clear the value" | "Effacer la valeur"
        Value, Corpus, In(Timeline), edits, "Ctrl+Delete" "=" "=";
    Value1 "value.1" "Value 1 of the tier" | "Valeur 1 de l’acteur"
        Value, Corpus, In(Timeline), edits, "1" "=" "=";
    Value2 "value.2" "Value 2 of the tier" | "Valeur 2 de l’acteur"
        Value, Corpus, In(Timeline), edits, "2" "=" "=";
    Value3 "value.3" "Value 3 of the tier" | "Valeur 3 de l’acteur"
        Value, Corpus, In(Timeline), edits, "3" "=" "=";
    Value4 "value.4" "Value 4 of the tier" | "Valeur 4 de l’acteur"
        Value, Corpus, In(Timeline), edits, "4" "=" "=";
    Value5 "value.5" "Value 5 of the tier" | "Valeur 5 de l’acteur"
        Value, Corpus, In(Timeline), edits, "5" "=" "=";
    Value6 "value.6" "Value 6 of the tier" | "Valeur 6 de l’acteur"
        Value, Corpus, In(Timeline), edits, "6" "=" "=";
    Value7 "value.7" "Value 7 of the tier" | "Valeur 7 de l’acteur"
        Value, Corpus, In(Timeline), edits, "7" "=" "=";
    Value8 "value.8" "Value 8 of the tier" | "Valeur 8 de l’acteur"
        Value, Corpus, In(Timeline), edits, "8" "=" "=";
    Value9 "value.9" "Value 9 of the tier" | "Valeur 9 de l’acteur"
        Value, Corpus, In(Timeline), edits, "9" "=" "=";
    StartHere "timing.start-here" "Start of the annotation to the playhead" | "Début de l’annotation au curseur"
        Timing, Corpus, In(Timeline), edits, "Alt+OpenBracket" "=" "=";
    EndHere "timing.end-here" "End of the annotation to the playhead" | "Fin de l’annotation au curseur"
        Timing, Corpus, In(Timeline), edits, "Alt+CloseBracket" "=" "=";
    StartToNeighbour "timing.start-to-neighbour" "Start to the end of the annotation before" | "Début à la fin de l’annotation précédente"
        Timing, Corpus, In(Timeline), edits, "Shift+Alt+J" "=" "=";
    EndToNeighbour "timing.end-to-neighbour" "End to the start of the annotation after" | "Fin au début de l’annotation suivante"
        Timing, Corpus, In(Timeline), edits, "Shift+Alt+U" "=" "=";
    ToSelection "timing.to-selection" "Time of the annotation to the selection" | "Temps de l’annotation à la sélection"
        Timing, Corpus, In(Timeline), edits, "Ctrl+Enter" "=" "=";
    StartEarlier "timing.start-earlier" "Start one frame earlier" | "Début une image plus tôt"
        Timing, Corpus, In(Timeline), edits repeats, "Ctrl+J" "=" "=";
    StartLater "timing.start-later" "Start one frame later" | "Début une image plus tard"
        Timing, Corpus, In(Timeline), edits repeats, "Ctrl+U" "=" "=";
    EndEarlier "timing.end-earlier" "End one frame earlier" | "Fin une image plus tôt"
        Timing, Corpus, In(Timeline), edits repeats, "Ctrl+Shift+J" "=" "=";
    EndLater "timing.end-later" "End one frame later" | "Fin une image plus tard"
        Timing, Corpus, In(Timeline), edits repeats, "Ctrl+Shift+U" "=" "=";
    ShiftEarlier "timing.shift-earlier" "Shift one frame earlier" | "Décaler d’une image en arrière"
        Timing, Corpus, In(Timeline), edits repeats, "Ctrl+Alt+J" "=" "=";
    ShiftLater "timing.shift-later" "Shift one frame later" | "Décaler d’une image en avant"
        Timing, Corpus, In(Timeline), edits repeats, "Ctrl+Alt+U" "=" "=";
    SelectFromHere "timing.select-from-here" "Select from the playhead" | "Sélectionner à partir du curseur"
        Timing, Corpus, In(Timeline), "Ctrl+OpenBracket" "=" "I";
    SelectToHere "timing.select-to-here" "Select up to the playhead" | "Sélectionner jusqu’au curseur"
        Timing, Corpus, In(Timeline), "Ctrl+CloseBracket" "=" "O";
    ExtendFrameBack "timing.extend-frame-back" "Extend the selection one frame back" | "Étendre la sélection d’une image en arrière"
        Timing, Corpus, In(Timeline), repeats, "Ctrl+Shift+Left" "=" "=";
    ExtendFrameForward "timing.extend-frame-forward" "Extend the selection one frame forward" | "Étendre la sélection d’une image en avant"
        Timing, Corpus, In(Timeline), repeats, "Ctrl+Shift+Right" "=" "=";
    ExtendSecondBack "timing.extend-second-back" "Extend the selection one second back" | "Étendre la sélection d’une seconde en arrière"
        Timing, Corpus, In(Timeline), repeats, "Ctrl+Shift+PageUp" "=" "=";
    ExtendSecondForward "timing.extend-second-forward" "Extend the selection one second forward" | "Étendre la sélection d’une seconde en avant"
        Timing, Corpus, In(Timeline), repeats, "Ctrl+Shift+PageDown" "=" "=";
    ModeNormal "timing.mode-normal" "Normal mode: neighbours stay" | "Mode normal : les voisins restent"
        Timing, Corpus, In(Timeline), "F6" "=" "=";
    ModeBulldozer "timing.mode-bulldozer" "Bulldozer mode: neighbours are pushed" | "Mode bulldozer : les voisins sont poussés"
        Timing, Corpus, In(Timeline), "F7" "=" "=";
    ModeShift "timing.mode-shift" "Shift mode: all later annotations move along" | "Mode décalage : toutes les annotations suivantes se décalent"
        Timing, Corpus, In(Timeline), "F8" "=" "=";
    SnapFrames "timing.snap-frames" "Snap to frames" | "Caler sur les images"
        Timing, Corpus, In(Timeline), "Shift+F6" "=" "=";
    SnapBoundaries "timing.snap-boundaries" "Snap to boundaries" | "Caler sur les limites"
        Timing, Corpus, In(Timeline), "Shift+F7" "=" "=";
    SnapMinima "timing.snap-minima" "Snap to minima of wrist speed" | "Caler sur les minima de vitesse du poignet"
        Timing, Corpus, In(Timeline), "Shift+F8" "=" "=";
    NextTier "tier.next" "Next tier" | "Acteur suivant"
        Tier, Corpus, In(Timeline), repeats, "Ctrl+Down" "=" "=";
    PreviousTier "tier.previous" "Previous tier" | "Acteur précédent"
        Tier, Corpus, In(Timeline), repeats, "Ctrl+Up" "=" "=";
    AddTier "tier.add" "Add a tier…" | "Ajouter un acteur…"
        Tier, Corpus, In(Timeline), changes, "Ctrl+T" "=" "=";
    UsualTiers "tier.usual" "Add the usual tiers" | "Ajouter les acteurs habituels"
        Tier, Corpus, In(Timeline), changes, "none" "none" "none";
    ChangeTier "tier.change" "Change the tier…" | "Modifier l’acteur…"
        Tier, Corpus, In(Timeline), changes, "Ctrl+Shift+T" "=" "=";
    CopyTier "tier.copy" "Copy the tier…" | "Copier l’acteur…"
        Tier, Corpus, In(Timeline), changes, "Ctrl+Shift+Alt+T" "=" "=";
    RemoveTier "tier.remove" "Remove the tier…" | "Supprimer l’acteur…"
        Tier, Corpus, In(Timeline), changes, "Ctrl+Alt+T" "=" "=";
    TierUp "tier.up" "Move the tier up" | "Monter l’acteur"
        Tier, Corpus, In(Timeline), edits repeats, "Ctrl+Shift+Up" "=" "=";
    TierDown "tier.down" "Move the tier down" | "Descendre l’acteur"
        Tier, Corpus, In(Timeline), edits repeats, "Ctrl+Shift+Down" "=" "=";
    TiersByName "tier.by-name" "Sort the tiers by name" | "Trier les acteurs par nom"
        Tier, Corpus, In(Timeline), edits, "Shift+Alt+O" "=" "=";
    TiersByKind "tier.by-kind" "Sort the tiers by subject" | "Trier les acteurs par objet"
        Tier, Corpus, In(Timeline), edits, "Shift+Alt+K" "=" "=";
    FoldTier "tier.fold" "Fold or unfold the tiers below" | "Replier ou déplier les acteurs du dessous"
        Tier, Corpus, In(Timeline), "Ctrl+Alt+F" "=" "=";
    HideTier "tier.hide" "Hide the tier" | "Masquer l’acteur"
        Tier, Corpus, In(Timeline), "Ctrl+Alt+H" "=" "=";
    HideEmptyTiers "tier.hide-empty" "Hide the tiers without annotations" | "Masquer les acteurs sans annotations"
        Tier, Corpus, In(Timeline), "Ctrl+Alt+E" "=" "=";
    ShowTiers "tier.show-all" "Show every tier" | "Afficher tous les acteurs"
        Tier, Corpus, In(Timeline), "Ctrl+Shift+H" "=" "=";
    Play "play.toggle" "Play or pause" | "Lecture ou pause"
        Play, Corpus, Player, "Ctrl+Space Space" "Tab Space" "Space";
    PlaySelection "play.selection" "Play the selection" | "Lire la sélection"
        Play, Corpus, Player, "Shift+Space" "=" "Shift+Space";
    PlayAround "play.around" "Play around the selection" | "Lire autour de la sélection"
        Play, Corpus, Player, "Ctrl+Shift+Space" "=" "=";
    StepAndRepeat "play.step-and-repeat" "Step and repeat" | "Avancer en répétant"
        Play, Corpus, Player, "Ctrl+Alt+Space" "=" "=";
    GoToTime "play.go-to-time" "Go to a time…" | "Aller à un temps…"
        Play, Corpus, In(Timeline), "Ctrl+G" "=" "=";
    OtherEnd "play.other-end" "To the other end of the selection" | "À l’autre bout de la sélection"
        Play, Corpus, Player, "Ctrl+Slash" "=" "=";
    ToCentre "play.to-centre" "To the centre of the selection" | "Au centre de la sélection"
        Play, Corpus, Player, "Ctrl+Alt+Slash" "=" "=";
    Loop "play.loop" "Loop" | "Lire en boucle"
        Play, Corpus, Player, "Ctrl+L" "=" "Ctrl+L";
    ShuttleBack "play.shuttle-back" "Shuttle backwards" | "Navette arrière"
        Play, Corpus, Player, "none" "none" "J";
    ShuttleStop "play.shuttle-stop" "Stop" | "Arrêt"
        Play, Corpus, Player, "none" "none" "K";
    ShuttleForward "play.shuttle-forward" "Shuttle forwards" | "Navette avant"
        Play, Corpus, Player, "none" "none" "L";
    FrameBack "play.frame-back" "One frame back" | "Une image en arrière"
        Play, Corpus, Player, repeats, "Ctrl+Left" "=" "Left Comma";
    FrameForward "play.frame-forward" "One frame forward" | "Une image en avant"
        Play, Corpus, Player, repeats, "Ctrl+Right" "=" "Right Period";
    FilmBack "play.film-back" "One film frame back" | "Reculer d’une image du film"
        Play, Corpus, In(Film), repeats, "Alt+Comma" "=" "=";
    FilmForward "play.film-forward" "One film frame forward" | "Avancer d’une image du film"
        Play, Corpus, In(Film), repeats, "Alt+Period" "=" "=";
    SecondBack "play.second-back" "One second back" | "Une seconde en arrière"
        Play, Corpus, Player, repeats, "Shift+Left" "=" "=";
    SecondForward "play.second-forward" "One second forward" | "Une seconde en avant"
        Play, Corpus, Player, repeats, "Shift+Right" "=" "=";
    ToStart "play.to-start" "To the start" | "Au début"
        Play, Corpus, Player, "Ctrl+B Home" "Home" "Home";
    ToEnd "play.to-end" "To the end" | "À la fin"
        Play, Corpus, Player, "Ctrl+E End" "End" "End";
    Slower "play.slower" "Slower" | "Plus lentement"
        Play, Corpus, Player, repeats, "Ctrl+5" "=" "OpenBracket";
    Faster "play.faster" "Faster" | "Plus vite"
        Play, Corpus, Player, repeats, "Ctrl+6" "=" "CloseBracket";
    NormalSpeed "play.normal-speed" "Normal speed" | "Vitesse normale"
        Play, Corpus, Player, "Ctrl+Alt+0" "=" "=";
    NextRecording "play.next-recording" "Next recording" | "Enregistrement suivant"
        Play, Corpus, WithCorpus, repeats, "Ctrl+PageDown" "=" "=";
    PreviousRecording "play.previous-recording" "Previous recording" | "Enregistrement précédent"
        Play, Corpus, WithCorpus, repeats, "Ctrl+PageUp" "=" "=";
    ViewFront "view.front" "From the front" | "De face"
        Stage, Corpus, In(Stage), "Alt+1" "=" "=";
    ViewSigner "view.signer" "As the signer sees it" | "Vu par la personne qui signe"
        Stage, Corpus, In(Stage), "Alt+2" "=" "=";
    ViewLeft "view.left" "From the left" | "De gauche"
        Stage, Corpus, In(Stage), "Alt+3" "=" "=";
    ViewRight "view.right" "From the right" | "De droite"
        Stage, Corpus, In(Stage), "Alt+4" "=" "=";
    ViewTop "view.top" "From above" | "D’en haut"
        Stage, Corpus, In(Stage), "Alt+5" "=" "=";
    ViewRightHand "view.right-hand" "Right hand close up" | "Main droite de près"
        Stage, Corpus, In(Stage), "Alt+6" "=" "=";
    ViewLeftHand "view.left-hand" "Left hand close up" | "Main gauche de près"
        Stage, Corpus, In(Stage), "Alt+7" "=" "=";
    ViewFace "view.face" "Face close up" | "Visage de près"
        Stage, Corpus, In(Stage), "Alt+V" "=" "=";
    StageSplit "stage.split" "One, two or four views" | "Une, deux ou quatre vues"
        Stage, Corpus, In(Stage), "Alt+8" "=" "=";
    StageNextPane "stage.next-view" "Next view of the stage" | "Vue suivante de la scène"
        Stage, Corpus, In(Stage), "Alt+9" "=" "=";
    StageTrails "stage.trails" "Trails of the hands" | "Traces des mains"
        Stage, Corpus, In(Stage), "Alt+T" "=" "Alt+T";
    StageGhosts "stage.ghosts" "Ghosts of other moments" | "Fantômes d’autres instants"
        Stage, Corpus, In(Stage), "Alt+G" "=" "=";
    StagePlaces "stage.places" "Places on the body" | "Lieux du corps"
        Stage, Corpus, In(Stage), "Alt+P" "=" "=";
    StageHands "stage.hands" "Hands in the corners" | "Mains dans les coins"
        Stage, Corpus, In(Stage), "Alt+H" "=" "=";
    StagePalms "stage.palms" "Palms turned to the viewer" | "Paumes tournées vers l’œil"
        Stage, Corpus, In(Stage), "Alt+Y" "=" "=";
    StageFace "stage.face" "Face in the corner" | "Visage dans le coin"
        Stage, Corpus, In(Stage), "Alt+W" "=" "=";
    StageGrid "stage.grid" "Grid of the signing space" | "Grille de l’espace de signation"
        Stage, Corpus, In(Stage), "Alt+R" "=" "=";
    StageCompare "stage.compare" "Original: beside, over, away" | "Original : à côté, dessus, masqué"
        Stage, Corpus, In(Stage), "Alt+O" "=" "=";
    StageRecording "stage.recording" "Back from the generated sign to the recording" | "Revenir du signe composé à l’enregistrement"
        Stage, Corpus, In(Stage), "Alt+0" "=" "=";
    OrbitLeft "stage.orbit-left" "Turn the signer to the left" | "Tourner vers la gauche"
        Stage, Corpus, In(Stage), repeats, "Shift+Alt+Left" "=" "=";
    OrbitRight "stage.orbit-right" "Turn the signer to the right" | "Tourner vers la droite"
        Stage, Corpus, In(Stage), repeats, "Shift+Alt+Right" "=" "=";
    OrbitUp "stage.orbit-up" "See from higher" | "Voir de plus haut"
        Stage, Corpus, In(Stage), repeats, "Shift+Alt+Up" "=" "=";
    OrbitDown "stage.orbit-down" "See from lower" | "Voir de plus bas"
        Stage, Corpus, In(Stage), repeats, "Shift+Alt+Down" "=" "=";
    PanLeft "stage.pan-left" "Move the view to the left" | "Déplacer la vue à gauche"
        Stage, Corpus, In(Stage), repeats, "Ctrl+Shift+Alt+Left" "=" "=";
    PanRight "stage.pan-right" "Move the view to the right" | "Déplacer la vue à droite"
        Stage, Corpus, In(Stage), repeats, "Ctrl+Shift+Alt+Right" "=" "=";
    PanUp "stage.pan-up" "Move the view up" | "Déplacer la vue vers le haut"
        Stage, Corpus, In(Stage), repeats, "Ctrl+Shift+Alt+Up" "=" "=";
    PanDown "stage.pan-down" "Move the view down" | "Déplacer la vue vers le bas"
        Stage, Corpus, In(Stage), repeats, "Ctrl+Shift+Alt+Down" "=" "=";
    Nearer "stage.nearer" "Nearer" | "Plus près"
        Stage, Corpus, In(Stage), repeats, "Alt+Equals Alt+Plus" "=" "=";
    Farther "stage.farther" "Farther" | "Plus loin"
        Stage, Corpus, In(Stage), repeats, "Alt+Minus" "=" "=";
    ShareFilm "share.film" "Share as a film (MP4)" | "Partager en film (MP4)"
        Stage, Corpus, WithCorpus, "none" "none" "none";
    ShareGif "share.gif" "Share as an animation (GIF)" | "Partager en animation (GIF)"
        Stage, Corpus, WithCorpus, "none" "none" "none";
    SharePicture "share.picture" "Share as a picture (PNG)" | "Partager en image (PNG)"
        Stage, Corpus, WithCorpus, "none" "none" "none";
    ShareGlb "share.glb" "Share as a body that moves (GLB)" | "Partager en corps animé (GLB)"
        Stage, Corpus, WithCorpus, "none" "none" "none";
    StageReset "stage.reset" "The original view" | "Vue d’origine"
        Stage, Corpus, In(Stage), "Shift+Alt+0" "=" "=";
    ZoomIn "view.zoom-in" "Zoom in in time" | "Agrandir le temps"
        View, Corpus, In(Timeline), repeats, "Ctrl+Equals Ctrl+Plus" "Ctrl+I" "=";
    ZoomOut "view.zoom-out" "Zoom out in time" | "Réduire le temps"
        View, Corpus, In(Timeline), repeats, "Ctrl+Minus" "=" "=";
    ZoomAll "view.zoom-all" "The whole recording" | "Tout l’enregistrement"
        View, Corpus, In(Timeline), "Ctrl+0" "Ctrl+A" "=";
    PageBack "view.page-back" "One page of the timeline back" | "Une page de la ligne de temps en arrière"
        View, Corpus, In(Timeline), repeats, "PageUp" "=" "=";
    PageForward "view.page-forward" "One page of the timeline forward" | "Une page de la ligne de temps en avant"
        View, Corpus, In(Timeline), repeats, "PageDown" "=" "=";
    Overview "view.overview" "Overview of the whole recording" | "Vue d’ensemble de l’enregistrement"
        View, Corpus, In(Timeline), "Ctrl+F9" "=" "=";
    LaneSpeed "view.lane-speed" "Lane of wrist speed" | "Piste de vitesse du poignet"
        View, Corpus, In(Timeline), "Ctrl+F5" "=" "=";
    LaneAperture "view.lane-aperture" "Lane of hand aperture" | "Piste d’ouverture de la main"
        View, Corpus, In(Timeline), "Ctrl+F6" "=" "=";
    LanePalm "view.lane-palm" "Lane of palm direction" | "Piste d’orientation de la paume"
        View, Corpus, In(Timeline), "Ctrl+F7" "=" "=";
    LaneDistance "view.lane-distance" "Lane of hand distance" | "Piste de distance des mains"
        View, Corpus, In(Timeline), "Ctrl+F8" "=" "=";
    LaneFace "view.lane-face" "Lanes of the face and the trunk, if they are stored" | "Pistes du visage et du tronc, s’il y en a"
        View, Corpus, In(Timeline), "Ctrl+F10" "=" "=";
    Larger "view.larger" "Larger interface" | "Interface plus grande"
        View, Everywhere, Window, repeats, "Ctrl+Alt+Equals Ctrl+Alt+Plus" "=" "=";
    Smaller "view.smaller" "Smaller interface" | "Interface plus petite"
        View, Everywhere, Window, repeats, "Ctrl+Alt+Minus" "=" "=";
    Theme "view.theme" "Light or dark" | "Clair ou sombre"
        View, Everywhere, Window, "none" "none" "none";
    ShowLibrary "pane.library" "Show the library" | "Afficher le fonds"
        Panes, Corpus, Shows(Library), "Shift+F1" "=" "=";
    ShowStage "pane.stage" "Show the stage" | "Afficher la scène"
        Panes, Corpus, Shows(Stage), "Shift+F2" "=" "=";
    ShowTimeline "pane.timeline" "Show the timeline" | "Afficher la ligne de temps"
        Panes, Corpus, Shows(Timeline), "Shift+F3" "=" "=";
    ShowRecombine "pane.recombine" "Recombine" | "Recombiner"
        Panes, Corpus, Shows(Recombine), "Ctrl+R" "=" "=";
    ShowInspector "pane.inspector" "Show the inspector" | "Afficher l’inspecteur"
        Panes, Corpus, Shows(Inspector), "Shift+F4" "=" "=";
    ShowFilm "pane.film" "Show the film" | "Afficher le film"
        Panes, Corpus, Shows(Film), "Shift+F5" "=" "=";
    ShowMap "pane.map" "Show the map of signs" | "Afficher la carte des signes"
        Panes, Corpus, Shows(Map), "Ctrl+Alt+K" "=" "=";
    ShowCue "pane.cue" "Cued speech" | "Langue parlée complétée"
        Panes, Corpus, Shows(Cue), "Ctrl+Alt+L" "=" "=";
    ShowFaces "pane.faces" "Show the faces" | "Afficher les visages"
        Panes, Corpus, Shows(Faces), "Ctrl+Alt+V" "=" "=";
    ShowAgreement "pane.agreement" "Agreement of two annotators" | "Accord de deux annotateurs"
        Panes, Corpus, Shows(Agreement), "Ctrl+Alt+B" "=" "=";
    ShowStudies "pane.studies" "Studies: what people see" | "Études : ce que les gens voient"
        Panes, Corpus, Shows(Studies), "Ctrl+Alt+O" "=" "=";
    ShowHistory "pane.history" "Show the history" | "Afficher l’historique"
        Panes, Corpus, Shows(History), "Ctrl+H" "=" "=";
    OnlyPane "pane.only" "Only this pane, or all again" | "Seulement ce panneau, ou tous à nouveau"
        Panes, Corpus, Window, "F11" "=" "=";
    OnlyAnnotating "pane.only-annotating" "Only stage and timeline, or all again" | "Seulement scène et ligne de temps, ou tous à nouveau"
        Panes, Corpus, Window, "Shift+F11" "=" "=";
    LayoutAnnotate "pane.reset" "Panes for annotating (the usual layout)" | "Panneaux pour annoter (la disposition habituelle)"
        Panes, Corpus, Window, "Ctrl+F1" "=" "=";
    LayoutSearch "layout.search" "Panes for searching" | "Panneaux pour rechercher"
        Panes, Corpus, Window, "Ctrl+F2" "=" "=";
    LayoutRecombine "layout.recombine" "Panes for recombining" | "Panneaux pour recombiner"
        Panes, Corpus, Window, "Ctrl+F3" "=" "=";
    Palette "help.palette" "Command palette" | "Palette de commandes"
        Help, Everywhere, Window, "Ctrl+Shift+P" "=" "=";
    Keys "help.keys" "Keys" | "Touches"
        Help, Everywhere, Window, "F1" "=" "=";
    FirstSteps "help.first-steps" "First steps" | "Premiers pas"
        Help, Everywhere, Window, "F12" "=" "=";
}
