//! Words of the report of a study.

use chereme_analysis::statistics::{EffectSize, EquivalenceConclusion, PValueMethod, UndefinedStatistic};

use super::{ExclusionReason, HypothesisVerdict, TestName, VerdictReason};
use crate::study::{AnswerListRow, AnswerState};
use crate::words::{InterfaceLanguage, InterfaceText};

crate::words::texts! {
    SUBTITLE: "Report of a perceptual study", "Rapport d’une étude perceptive";
    CONCLUSIONS: "Conclusions", "Conclusions";
    NO_HYPOTHESIS: "The plan states no hypothesis. All pairs of conditions are compared; nothing is concluded from it, because the comparisons were not chosen before the answers.", "Le plan n’énonce aucune hypothèse. Toutes les paires de conditions sont comparées ; rien n’en est conclu, car les comparaisons n’ont pas été choisies avant les réponses.";
    PEOPLE: "Participants", "Participants";
    RECRUITED: "answered", "ont répondu";
    LEFT_OUT: "left out", "écartés";
    ANALYSED: "analysed", "analysés";
    OTHER_PLAN: "{n} of them answered another version of the plan.", "dont {n} avec une autre version du plan.";
    NO_ANSWER: "no answer", "sans réponse";
    COLUMN_ANSWER: "answer", "réponse";
    EVERYBODY: "all", "tous";
    QUESTION: "Question: {name}", "Question : {name}";
    PART: "Part: {name}", "Partie : {name}";
    NO_ANSWERS: "There are no answers.", "Il n’y a pas de réponses.";
    CONDITION: "condition", "condition";
    ITEM: "item", "élément";
    ANSWERS: "answers", "réponses";
    CANNOT_SAY: "cannot say", "ne sait pas";
    MEAN: "mean", "moyenne";
    SD: "s.d.", "éc.-type";
    MEDIAN: "median", "médiane";
    QUARTILES: "quartiles", "quartiles";
    EACH_ITEM: "Each item", "Chaque élément";
    RECOGNISED: "right", "juste";
    INTERVAL_95: "95% interval", "intervalle à 95 %";
    BARS: "Answers, centred on the middle of the scale", "Réponses, centrées sur le milieu de l’échelle";
    BOXES: "Answers and mean answers of people", "Réponses et réponses moyennes des personnes";
    SHARES: "Right answers with Wilson’s 95% intervals", "Réponses justes avec les intervalles de Wilson à 95 %";
    CONFUSION: "Right options (rows) and chosen options (columns)", "Options justes (lignes) et choisies (colonnes)";
    EFFECTS: "Cliff’s delta with its interval", "Delta de Cliff avec son intervalle";
    CORRELATION: "Mean answers over a measure", "Réponses moyennes selon une mesure";
    BARS_NOTE: "Shares in percent, centred on the middle of the scale.", "Parts en pour cent, centrées sur le milieu de l’échelle.";
    BOXES_NOTE: "Box: quartiles; line: median; dotted line: mean; whiskers: 1.5 interquartile ranges; rings: answers beyond. Dots: the mean answer of each person.", "Boîte : quartiles ; trait : médiane ; pointillé : moyenne ; moustaches : 1,5 écart interquartile ; cercles : réponses au-delà. Points : la réponse moyenne de chaque personne.";
    SHARES_NOTE: "Share of right answers with Wilson’s 95% interval, which takes answers as independent. Dotted line: guessing.", "Part de réponses justes avec l’intervalle de Wilson à 95 %, qui suppose les réponses indépendantes. Pointillé : réponse au hasard.";
    CONFUSION_NOTE: "One row for each right option, one column for each chosen option; right answers are framed.", "Une ligne par option juste, une colonne par option choisie ; les réponses justes sont encadrées.";
    ALL_CONDITIONS: "all conditions", "toutes les conditions";
    MODEL: "Cumulative link model: odds of a higher answer than with {reference}.", "Modèle à lien cumulatif : cote d’une réponse plus haute qu’avec {reference}.";
    MODEL_ITEMS: "Items are in the model as fixed effects.", "Les éléments sont dans le modèle comme effets fixes.";
    MODEL_NOTE: "It takes answers of one person as independent.", "Il suppose indépendantes les réponses d’une même personne.";
    NO_MODEL: "Cumulative link model: none, because {why}.", "Modèle à lien cumulatif : aucun, car {why}.";
    ODDS: "odds ratio", "rapport de cotes";
    COMPARISONS: "Comparisons", "Comparaisons";
    ALL_PAIRS: "All pairs of conditions: {question}", "Toutes les paires de conditions : {question}";
    WITH_MEASURE: "Correlation: {question} and {measure}", "Corrélation : {question} et {measure}";
    NOBODY_SAID: "Nobody answered: {questions}.", "Personne n’a répondu : {questions}.";
    GROUP: "group", "groupe";
    PERSONS: "people", "personnes";
    PAIR: "pair", "paire";
    POOLED: "all answers, as if independent", "toutes les réponses, comme indépendantes";
    BY_PERSON: "means of people", "moyennes des personnes";
    TEST: "test", "test";
    P: "p", "p";
    P_HOLM: "p (Holm)", "p (Holm)";
    DELTA: "delta", "delta";
    DIFFERENCE: "mean difference", "différence moyenne";
    SIZE: "size", "taille";
    SAMENESS: "within ±{bound}?", "dans ±{bound} ?";
    OVERALL: "More than two groups: Kruskal-Wallis over all answers {pooled}; Friedman over means of people {people}.", "Plus de deux groupes : Kruskal-Wallis sur toutes les réponses {pooled} ; Friedman sur les moyennes des personnes {people}.";
    EFFECTS_NOTE: "Cliff’s delta, first group minus second, with its {level} interval from {times} resamples of participants. Shaded: differences below ±{bound}.", "Delta de Cliff, premier groupe moins second, avec son intervalle à {level} par {times} rééchantillonnages des participants. Grisé : différences inférieures à ±{bound}.";
    MEASURE: "Spearman’s rho of {measure} and mean answers of {n} stimuli: {rho}, {p}; interval {interval} from resampled participants, with these stimuli alone, while p takes the stimuli as a sample; Kendall’s tau-b {tau}.", "Rho de Spearman entre {measure} et les réponses moyennes de {n} stimuli : {rho}, {p} ; intervalle {interval} par rééchantillonnage des participants, pour ces stimuli seulement, alors que p traite les stimuli comme un échantillon ; tau-b de Kendall {tau}.";
    NONE_BECAUSE: "none: {why}", "aucun : {why}";
    ONE_SIDED: "One-sided tests, as the plan asks: groups rise in this order.", "Tests unilatéraux, comme le plan le demande : les groupes augmentent dans cet ordre.";
    TWO_SIDED: "Two-sided tests.", "Tests bilatéraux.";
    DISAGREE: "The two tests disagree at this level. The test of all answers takes {n} answers as independent, although each person gave several.", "Les deux tests divergent à ce seuil. Le test de toutes les réponses suppose {n} réponses indépendantes, bien que chaque personne en ait donné plusieurs.";
    EXPECTS_DIFFERENCE: "expects a difference", "attend une différence";
    EXPECTS_RISE: "expects a rise", "attend une hausse";
    EXPECTS_SAMENESS: "expects no difference above {bound}", "attend une différence d’au plus {bound}";
    EXPECTS_CORRELATION: "expects a correlation with {measure}", "attend une corrélation avec {measure}";
    ALPHA: "level {alpha}", "seuil {alpha}";
    METHODS: "How to read this", "Comment lire ce rapport";
    METHODS_TESTS: "Two tests stand side by side. One takes all answers as independent (Mann-Whitney, Fisher), as older studies do. The other takes one mean for each person (Wilcoxon, McNemar, Friedman). Conclusions follow the second one, because several answers of one person are not independent.", "Deux tests sont donnés côte à côte. L’un suppose toutes les réponses indépendantes (Mann-Whitney, Fisher), comme dans des études plus anciennes. L’autre prend une moyenne par personne (Wilcoxon, McNemar, Friedman). Les conclusions suivent le second, car plusieurs réponses d’une personne ne sont pas indépendantes.";
    METHODS_SAME: "A test that is not significant does not show sameness. A hypothesis of a difference is refused only if the interval of the effect at 1 − 2α lies within the bounds of the smallest difference of interest; a hypothesis of sameness is supported only then (two one-sided tests). In all other cases the answers do not decide.", "Un test non significatif ne montre pas l’égalité. Une hypothèse de différence n’est rejetée que si l’intervalle de l’effet à 1 − 2α reste dans les bornes de la plus petite différence d’intérêt ; une hypothèse d’égalité n’est soutenue que dans ce cas (deux tests unilatéraux). Sinon, les réponses ne tranchent pas.";
    METHODS_EFFECT: "Cliff’s delta says how much more often an answer of the first group is higher than one of the second, from −1 to 1; for right answers it is the difference of shares. Below 0.147 it is called negligible, below 0.33 small, below 0.474 medium.", "Le delta de Cliff dit combien une réponse du premier groupe dépasse plus souvent une réponse du second, de −1 à 1 ; pour des réponses justes, c’est la différence des parts. Sous 0,147 il est dit négligeable, sous 0,33 petit, sous 0,474 moyen.";
    METHODS_HOLM: "p of several pairs are corrected by Holm’s method within one comparison. “exact” means the exact distribution with ties, “approximate” the normal approximation with a correction for continuity.", "Les p de plusieurs paires sont corrigés par la méthode de Holm dans une même comparaison. « exact » désigne la distribution exacte avec ex æquo, « approché » l’approximation normale avec correction de continuité.";
    MADE: "Made by chereme {version} from plan {sha} with seed {seed}. The same plan and answers give the same report.", "Produit par chereme {version} à partir du plan {sha}, graine {seed}. Le même plan et les mêmes réponses donnent le même rapport.";
    SKIPPED: "passed over", "passée";
    NOT_REACHED: "not reached", "non atteinte";
    NOT_CONSENTED: "no agreement to an analysis", "pas d’accord pour l’analyse";
    UNFINISHED: "not finished", "non terminé";
    CHECKS_WRONG: "more than {n} checks wrong", "plus de {n} contrôles faux";
    ONE_VALUE: "one value for all answers", "une seule valeur pour toutes les réponses";
    FILTERED: "{question} outside the analysed answers", "{question} hors des réponses analysées";
    SUPPORTED: "supported", "soutenue";
    NOT_SUPPORTED: "not supported", "non soutenue";
    UNDECIDED: "cannot be decided", "indécidable";
    SIGNIFICANT: "The test is significant.", "Le test est significatif.";
    NOT_SIGNIFICANT: "The test is not significant, which does not show the absence of a correlation.", "Le test n’est pas significatif, ce qui ne montre pas l’absence de corrélation.";
    VERDICT_LINE: "{name}: {verdict}. {because}", "{name} : {verdict}. {because}";
    PAIR_OF_TEXTS: "{a}: {b}", "{a} : {b}";
    RIGHT_SHARE: "right, %", "juste, %";
    WITHIN_BOUNDS: "The interval lies within the smallest difference of interest.", "L’intervalle reste dans la plus petite différence d’intérêt.";
    BEYOND_BOUNDS: "The interval lies beyond the smallest difference of interest.", "L’intervalle dépasse la plus petite différence d’intérêt.";
    OPPOSITE_DIRECTION: "The interval excludes a rise of interest.", "L’intervalle exclut une hausse d’intérêt.";
    WIDE_INTERVAL: "The interval reaches across the smallest difference of interest: the answers neither show nor exclude a difference that matters.", "L’intervalle chevauche la plus petite différence d’intérêt : les réponses ne montrent ni n’excluent une différence notable.";
    NO_TEST: "There is no test: {why}.", "Il n’y a pas de test : {why}.";
    NEGLIGIBLE: "negligible", "négligeable";
    SMALL: "small", "petit";
    MEDIUM: "medium", "moyen";
    LARGE: "large", "grand";
    EXACT: "exact", "exact";
    APPROXIMATE: "approximate", "approché";
    YES: "yes", "oui";
    NO: "no", "non";
    OPEN: "undecided", "indécis";
    MANN_WHITNEY: "Mann-Whitney", "Mann-Whitney";
    WILCOXON: "Wilcoxon", "Wilcoxon";
    FISHER: "Fisher", "Fisher";
    MCNEMAR: "McNemar", "McNemar";
    U: "U", "U";
    W_PLUS: "W+", "W+";
    B: "first only", "premier seul";
    NOT_A_NUMBER: "a value is not a number", "une valeur n’est pas un nombre";
    EMPTY: "a group is empty", "un groupe est vide";
    TOO_FEW: "there are too few values", "il y a trop peu de valeurs";
    TOO_MANY: "there are too many different values", "il y a trop de valeurs différentes";
    NO_SPREAD: "all values are equal", "toutes les valeurs sont égales";
    NO_DIFFERENCE: "no pair differs", "aucune paire ne diffère";
    SEPARATED: "the groups do not overlap", "les groupes ne se recouvrent pas";
    DEPENDENT: "a column follows from the others", "une colonne découle des autres";
    INFINITE: "the value is infinite", "la valeur est infinie";
    UNEQUAL: "the lists have different lengths", "les listes n’ont pas la même longueur";
    OUT_OF_RANGE: "a level, count or bound is out of range", "un seuil, un compte ou une borne est hors limites";
}

/// Returns the words for the reason why a statistic has no value.
#[must_use]
pub fn undefined_reason_words(why: UndefinedStatistic) -> InterfaceText {
    match why {
        UndefinedStatistic::NotANumber => NOT_A_NUMBER,
        UndefinedStatistic::Empty => EMPTY,
        UndefinedStatistic::TooFew => TOO_FEW,
        UndefinedStatistic::TooMany => TOO_MANY,
        UndefinedStatistic::NoSpread => NO_SPREAD,
        UndefinedStatistic::NoDifference => NO_DIFFERENCE,
        UndefinedStatistic::Separated => SEPARATED,
        UndefinedStatistic::Dependent => DEPENDENT,
        UndefinedStatistic::Infinite => INFINITE,
        UndefinedStatistic::Unequal => UNEQUAL,
        UndefinedStatistic::OutOfRange => OUT_OF_RANGE,
    }
}

/// Returns the words for a verdict.
#[must_use]
pub fn verdict_words(verdict: HypothesisVerdict) -> InterfaceText {
    match verdict {
        HypothesisVerdict::Supported => SUPPORTED,
        HypothesisVerdict::NotSupported => NOT_SUPPORTED,
        HypothesisVerdict::Undecided => UNDECIDED,
    }
}

/// Returns the words for the reason of a verdict, with a blank `{why}` if there is no test.
#[must_use]
pub fn verdict_reason_words(because: VerdictReason) -> InterfaceText {
    match because {
        VerdictReason::Significant => SIGNIFICANT,
        VerdictReason::WithinBounds => WITHIN_BOUNDS,
        VerdictReason::BeyondBounds => BEYOND_BOUNDS,
        VerdictReason::OppositeDirection => OPPOSITE_DIRECTION,
        VerdictReason::WideInterval => WIDE_INTERVAL,
        VerdictReason::NotSignificant => NOT_SIGNIFICANT,
        VerdictReason::NoTest(_) => NO_TEST,
    }
}

/// Returns the words for a reason to leave a participant out, with the blanks `{n}` and `{question}`.
#[must_use]
pub fn exclusion_reason_text(reason: &ExclusionReason) -> InterfaceText {
    use crate::study::study_plan::ExclusionRule;
    match reason {
        ExclusionReason::NoConsent => NOT_CONSENTED,
        ExclusionReason::Rule(ExclusionRule::Unfinished) => UNFINISHED,
        ExclusionReason::Rule(ExclusionRule::ChecksWrong(_)) => CHECKS_WRONG,
        ExclusionReason::Rule(ExclusionRule::OneValue) => ONE_VALUE,
        ExclusionReason::Filter { .. } => FILTERED,
    }
}

/// Returns an answer, or the reason why it is missing.
#[must_use]
pub fn answer_text(row: &AnswerListRow, language: InterfaceLanguage) -> String {
    match row.state {
        AnswerState::Answered => row.answer.clone(),
        AnswerState::CannotSay => CANNOT_SAY.text_in_language(language).to_owned(),
        AnswerState::Skipped => SKIPPED.text_in_language(language).to_owned(),
        AnswerState::NotReached => NOT_REACHED.text_in_language(language).to_owned(),
    }
}

/// Returns the words for the size of an effect.
#[must_use]
pub fn effect_size_words(size: EffectSize) -> InterfaceText {
    match size {
        EffectSize::Negligible => NEGLIGIBLE,
        EffectSize::Small => SMALL,
        EffectSize::Medium => MEDIUM,
        EffectSize::Large => LARGE,
    }
}

/// Returns the name of a test.
#[must_use]
pub fn test_name_text(test: TestName) -> InterfaceText {
    match test {
        TestName::MannWhitney => MANN_WHITNEY,
        TestName::Wilcoxon => WILCOXON,
        TestName::Fisher => FISHER,
        TestName::Mcnemar => MCNEMAR,
    }
}

/// Returns the name of the statistic of a test.
#[must_use]
pub fn test_statistic_name(test: TestName) -> InterfaceText {
    match test {
        TestName::MannWhitney => U,
        TestName::Wilcoxon => W_PLUS,
        TestName::Fisher => ODDS,
        TestName::Mcnemar => B,
    }
}

/// Returns the words for the computation of a p.
#[must_use]
pub fn p_method_words(method: PValueMethod) -> InterfaceText {
    match method {
        PValueMethod::Exact => EXACT,
        PValueMethod::Continuity | PValueMethod::Normal => APPROXIMATE,
    }
}

/// Returns the words for whether a difference is smaller than the smallest of interest.
#[must_use]
pub fn sameness_words(result: EquivalenceConclusion) -> InterfaceText {
    match result {
        EquivalenceConclusion::Equivalent => YES,
        EquivalenceConclusion::Relevant => NO,
        EquivalenceConclusion::Undecided => OPEN,
    }
}
