//! The texts of a questionnaire, and what a question has beside its answers: a second viewing, labels, pictures.

use chereme_corpus::study::plan::{Consent, Plan, Question, QuestionKind, Texts, Viewing};
use chereme_corpus::words::Language;
use eframe::egui::{CollapsingHeader, Ui};

use super::draft::line;
use super::drafted::Draft;
use super::hypotheses::{text_of, tidy};
use crate::context::PaneInput;
use crate::words::{fill, studies as words};

/// Shows the details of each question, and the text that participants read first.
pub(super) fn show(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut Draft, plan: &Plan) {
    let header = CollapsingHeader::new(seen.say(words::WORDING)).id_salt("wording");
    header.show(ui, |ui| {
        for planned in &plan.questions {
            let name = planned.name.as_str();
            CollapsingHeader::new(name)
                .id_salt(("question", name))
                .show(ui, |ui| {
                    let mut question = planned.clone();
                    details(ui, seen, &mut question);
                    if question != *planned
                        && let Some(own) = draft.details(plan, name)
                    {
                        *own = question;
                    }
                });
        }
        let header = CollapsingHeader::new(seen.say(words::CONSENT)).id_salt("consent");
        header.show(ui, |ui| {
            let mut consent = plan.consent.clone();
            let Consent {
                purpose,
                contact,
                kept,
            } = &mut consent;
            for (texts, name) in [
                (purpose, words::PURPOSE),
                (contact, words::CONTACT),
                (kept, words::KEPT),
            ] {
                both(ui, seen, seen.say(name), texts);
            }
            if consent != plan.consent {
                draft.before.get_or_insert_with(|| plan.clone()).consent = consent;
            }
        });
        ui.weak(seen.say(words::BY_FILE));
    });
}

/// Shows a text in both languages.
fn both(ui: &mut Ui, seen: &PaneInput<'_>, name: &str, texts: &mut Texts) {
    let before = texts.clone();
    let mut edited = texts.clone();
    for (language, of) in [
        (Language::English, words::IN_ENGLISH),
        (Language::French, words::IN_FRENCH),
    ] {
        let title = fill(seen.say(of), &[("what", &name)]);
        line(ui, &title, "", text_of(&mut edited, language.code()));
    }
    tidy(&mut edited);
    if edited != before {
        *texts = edited;
    }
}

fn details(ui: &mut Ui, seen: &PaneInput<'_>, question: &mut Question) {
    let name = question.name.clone();
    both(ui, seen, &name, &mut question.text);
    let mut second = question.after == Viewing::Second;
    if ui
        .checkbox(&mut second, seen.say(words::SECOND_VIEWING))
        .changed()
    {
        question.after = match second {
            true => Viewing::Second,
            false => Viewing::First,
        };
    }
    ui.checkbox(&mut question.cannot_say, seen.say(words::MAY_NOT_SAY));
    match &mut question.kind {
        QuestionKind::Scale { low, high, labels } => {
            for at in *low..=*high {
                let mut texts = labels.get(&at).cloned().unwrap_or_default();
                let before = texts.clone();
                let values: [(&str, &dyn std::fmt::Display); 2] =
                    [("name", &name), ("answers", &at)];
                let title = fill(seen.say(words::ASKED), &values);
                both(ui, seen, &title, &mut texts);
                if texts != before {
                    labels.insert(at, texts);
                    labels.retain(|_, it| !it.is_empty());
                }
            }
        }
        QuestionKind::Choice { options } => {
            for option in options {
                let values: [(&str, &dyn std::fmt::Display); 2] =
                    [("name", &name), ("answers", &option.name)];
                let title = fill(seen.say(words::ASKED), &values);
                both(ui, seen, &title, &mut option.text);
                let mut picture = option.picture.clone().unwrap_or_default();
                let title = fill(seen.say(words::PICTURE), &[("what", &title)]);
                let hint = seen.say(words::PICTURE_HINT);
                if line(ui, &title, hint, &mut picture).changed() {
                    option.picture = Some(picture).filter(|it| !it.is_empty());
                }
            }
        }
    }
}
