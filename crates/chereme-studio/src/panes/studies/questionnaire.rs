//! The questionnaire of a study, built into a folder.

use std::path::PathBuf;

use chereme_corpus::study::{Questionnaire, QuestionnaireOptions, StudyOverview};
use eframe::egui::{Button, DragValue, Ui};

use super::{Studies, data, path_field, progress};
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::panes::import::Paths;
use crate::words::{fill, studies as words};
use crate::work::{WorkId, studying};

/// The folder and the settings, and the result.
#[derive(Default)]
pub(super) struct Form {
    pub(super) to: String,
    paths: Paths,
    /// Height and rate of films, and whether a questionnaire is replaced; the usual ones if `None`.
    options: Option<QuestionnaireOptions>,
    pub(super) building: Option<WorkId>,
    pub(super) built: Option<Questionnaire>,
}

/// Shows the form, the progress of building, and the result.
pub(super) fn show(
    pane: &mut Studies,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    it: &StudyOverview,
    out: &mut Outbox,
) {
    let form = &mut pane.forms.questionnaire;
    if form.options.is_none() && form.to.is_empty() {
        let folder = format!("{}-questionnaire", data::file_stem(&it.plan.name));
        form.to = seen.beside(&folder).display().to_string();
    }
    let options = form
        .options
        .get_or_insert_with(QuestionnaireOptions::default);
    path_field(
        ui,
        seen,
        (words::FOLDER, ""),
        (&mut form.paths, &mut form.to),
        Choose::Questionnaire,
        out,
    );
    ui.horizontal_wrapped(|ui| {
        let label = ui.weak(seen.say(words::HEIGHT));
        ui.add(DragValue::new(&mut options.height).range(64..=1080))
            .labelled_by(label.id);
        let label = ui.weak(seen.say(words::RATE));
        ui.add(DragValue::new(&mut options.rate).range(1..=120))
            .labelled_by(label.id);
        ui.checkbox(&mut options.force, seen.say(words::REPLACE));
    });
    let options = *options;
    if !progress(ui, seen, form.building, words::TASK_BUILD, out) {
        let ready = !form.to.trim().is_empty();
        let build = ui.add_enabled(ready, Button::new(seen.say(words::BUILD)));
        let build = build.on_disabled_hover_text(seen.say(words::NEEDS_FOLDER));
        if build.clicked() {
            let to = PathBuf::from(form.to.trim());
            let job = studying::build(it.plan.name.clone(), to, options);
            (form.building, form.built) = (Some(out.work(job)), None);
            pane.clear();
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
    ui.label(fill(seen.say(words::BUILT), &values));
    for [one, other] in &built.alike {
        let values: [(&str, &dyn std::fmt::Display); 2] = [("one", one), ("other", other)];
        ui.colored_label(
            seen.colours().warning,
            fill(seen.say(words::ALIKE), &values),
        );
    }
    for path in &built.missing {
        let text = fill(seen.say(words::MISSING), &[("path", &path.display())]);
        ui.colored_label(seen.colours().warning, text);
    }
    let open = ui.button(seen.say(words::OPEN_PAGE));
    if open.on_hover_text(seen.say(words::ADDRESS_TIP)).clicked() {
        pane.opening = Some(out.work(studying::open(built.page.clone())));
    }
}
