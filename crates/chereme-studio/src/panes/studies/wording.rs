//! The texts of a questionnaire, and what a question has beside its answers: a second viewing, labels, pictures.

use chereme_corpus::study::study_plan::{
    ConsentText, LocalizedTexts, QuestionKind, QuestionViewing, StudyPlan, StudyQuestion,
};
use chereme_corpus::words::InterfaceLanguage;
use eframe::egui::{CollapsingHeader, Ui};

use super::drafted::StudyDraft;
use super::hypotheses::{language_text_mut, remove_empty_texts};
use super::studies_draft::show_draft_text_line;
use crate::context::PaneInput;
use crate::words::{fill_text_braces, studies_words as words};

/// Shows the details of each question, and the text that participants read first.
pub(super) fn show_question_wording(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut StudyDraft, plan: &StudyPlan) {
    let header = CollapsingHeader::new(seen.say_text(words::WORDING)).id_salt("wording");
    header.show(ui, |ui| {
        for planned in &plan.questions {
            let name = planned.name.as_str();
            CollapsingHeader::new(name).id_salt(("question", name)).show(ui, |ui| {
                let mut question = planned.clone();
                show_question_details(ui, seen, &mut question);
                if question != *planned
                    && let Some(own) = draft.question_details_mut(plan, name)
                {
                    *own = question;
                }
            });
        }
        let header = CollapsingHeader::new(seen.say_text(words::CONSENT)).id_salt("consent");
        header.show(ui, |ui| {
            let mut consent = plan.consent.clone();
            let ConsentText { purpose, contact, kept } = &mut consent;
            for (texts, name) in [
                (purpose, words::PURPOSE),
                (contact, words::CONTACT),
                (kept, words::KEPT),
            ] {
                show_bilingual_text(ui, seen, seen.say_text(name), texts);
            }
            if consent != plan.consent {
                draft.before.get_or_insert_with(|| plan.clone()).consent = consent;
            }
        });
        ui.weak(seen.say_text(words::BY_FILE));
    });
}

/// Shows a text in both languages.
fn show_bilingual_text(ui: &mut Ui, seen: &PaneInput<'_>, name: &str, texts: &mut LocalizedTexts) {
    let before = texts.clone();
    let mut edited = texts.clone();
    for (language, of) in [
        (InterfaceLanguage::English, words::IN_ENGLISH),
        (InterfaceLanguage::French, words::IN_FRENCH),
    ] {
        let title = fill_text_braces(seen.say_text(of), &[("what", &name)]);
        show_draft_text_line(ui, &title, "", language_text_mut(&mut edited, language.language_code()));
    }
    remove_empty_texts(&mut edited);
    if edited != before {
        *texts = edited;
    }
}

fn show_question_details(ui: &mut Ui, seen: &PaneInput<'_>, question: &mut StudyQuestion) {
    let name = question.name.clone();
    show_bilingual_text(ui, seen, &name, &mut question.text);
    let mut second = question.after == QuestionViewing::Second;
    if ui.checkbox(&mut second, seen.say_text(words::SECOND_VIEWING)).changed() {
        question.after = match second {
            true => QuestionViewing::Second,
            false => QuestionViewing::First,
        };
    }
    ui.checkbox(&mut question.cannot_say, seen.say_text(words::MAY_NOT_SAY));
    match &mut question.kind {
        QuestionKind::Scale { low, high, labels } => {
            for at in *low..=*high {
                let mut texts = labels.get(&at).cloned().unwrap_or_default();
                let before = texts.clone();
                let values: [(&str, &dyn std::fmt::Display); 2] = [("name", &name), ("answers", &at)];
                let title = fill_text_braces(seen.say_text(words::ASKED), &values);
                show_bilingual_text(ui, seen, &title, &mut texts);
                if texts != before {
                    labels.insert(at, texts);
                    labels.retain(|_, it| !it.is_empty());
                }
            }
        }
        QuestionKind::Choice { options } => {
            for option in options {
                let values: [(&str, &dyn std::fmt::Display); 2] = [("name", &name), ("answers", &option.name)];
                let title = fill_text_braces(seen.say_text(words::ASKED), &values);
                show_bilingual_text(ui, seen, &title, &mut option.text);
                let mut picture = option.picture.clone().unwrap_or_default();
                let title = fill_text_braces(seen.say_text(words::PICTURE), &[("what", &title)]);
                let hint = seen.say_text(words::PICTURE_HINT);
                if show_draft_text_line(ui, &title, hint, &mut picture).changed() {
                    option.picture = Some(picture).filter(|picture| !picture.is_empty());
                }
            }
        }
    }
}
