//! The questionnaire of a study, built into a folder.

use std::path::PathBuf;

use chereme_corpus::study::{BuiltQuestionnaire, QuestionnaireOptions, StudyOverview};
use eframe::egui::{Button, DragValue, Ui};

use super::{PathField, StudiesPane, progress, studies_data};
use crate::command::ChooserPurpose;
use crate::context::PaneInput;
use crate::panes::import::PathCompletions;
use crate::words::{fill_text_braces, studies_words as words};
use crate::work::{WorkId, studying};

/// The folder and the settings, and the result.
#[derive(Default)]
pub(super) struct QuestionnaireForm {
    pub(super) to: String,
    paths: PathCompletions,
    /// Height and rate of films, and whether a questionnaire is replaced; the usual ones if `None`.
    options: Option<QuestionnaireOptions>,
    pub(super) building: Option<WorkId>,
    pub(super) built: Option<BuiltQuestionnaire>,
}

/// Shows the form, the progress of building, and the result.
pub(super) fn show_questionnaire_form(pane: &mut StudiesPane, ui: &mut Ui, seen: &PaneInput<'_>, it: &StudyOverview) {
    let form = &mut pane.forms.questionnaire;
    if form.options.is_none() && form.to.is_empty() {
        let folder = format!("{}-questionnaire", studies_data::file_stem(&it.plan.name));
        form.to = seen.path_beside_corpus(&folder).display().to_string();
    }
    let options = form.options.get_or_insert_with(QuestionnaireOptions::default);
    let field = PathField {
        name: words::FOLDER,
        hint: "",
        chooser: ChooserPurpose::Questionnaire,
    };
    field.show_path_line(ui, seen, &mut form.paths, &mut form.to);
    ui.horizontal_wrapped(|ui| {
        let label = ui.weak(seen.say_text(words::HEIGHT));
        ui.add(DragValue::new(&mut options.height).range(64..=1080))
            .labelled_by(label.id);
        let label = ui.weak(seen.say_text(words::RATE));
        ui.add(DragValue::new(&mut options.rate).range(1..=120))
            .labelled_by(label.id);
        ui.checkbox(&mut options.force, seen.say_text(words::REPLACE));
    });
    let options = *options;
    if !progress(ui, seen, form.building, words::TASK_BUILD) {
        let ready = !form.to.trim().is_empty();
        let build_button = ui.add_enabled(ready, Button::new(seen.say_text(words::BUILD)));
        let build = build_button.on_disabled_hover_text(seen.say_text(words::NEEDS_FOLDER));
        if build.clicked() {
            let to = PathBuf::from(form.to.trim());
            let job = studying::build_questionnaire_job(it.plan.name.clone(), to, options);
            (form.building, form.built) = (Some(seen.request_work(job)), None);
            pane.clear_study_results();
        }
    }
    let Some(built) = &pane.forms.questionnaire.built else {
        return;
    };
    let kb = built.bytes.div_ceil(1000);
    let values: [(&str, &dyn std::fmt::Display); 4] = [
        ("films", &built.films),
        ("orders", &built.orders),
        ("kb", &kb),
        ("page", &built.page.display()),
    ];
    ui.label(fill_text_braces(seen.say_text(words::BUILT), &values));
    for [one, other] in &built.alike {
        let values: [(&str, &dyn std::fmt::Display); 2] = [("one", one), ("other", other)];
        ui.colored_label(
            seen.pane_colours().warning,
            fill_text_braces(seen.say_text(words::ALIKE), &values),
        );
    }
    for path in &built.missing {
        let text = fill_text_braces(seen.say_text(words::MISSING), &[("path", &path.display())]);
        ui.colored_label(seen.pane_colours().warning, text);
    }
    let open = ui.button(seen.say_text(words::OPEN_PAGE));
    if open.on_hover_text(seen.say_text(words::ADDRESS_TIP)).clicked() {
        pane.opening = Some(seen.request_work(studying::open_page_job(built.page.clone())));
    }
}
