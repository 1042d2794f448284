//! Suggestions for a sign: partners that differ in one component, and values that no sign has.

use chereme_corpus::{CorpusAddress, RecordOrigin, SignSuggestions};
use eframe::egui::{RichText, Ui};

use crate::command::CommandOutbox;
use crate::context::PaneInput;
use crate::panes::list_row;
use crate::words::{InterfaceText, fill_text_braces, recombine_words as words};
use crate::work::{WorkId, WorkOutcome, WorkResult, recombining};

/// A proposed recipe.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct RecipeProposal {
    pub(super) recipe: String,
    /// The gloss of the partner, if it has no movement yet.
    pub(super) gloss: Option<String>,
    /// The partner and the difference, or the value.
    pub(super) name: String,
    pub(super) about: String,
}

/// The list of proposals.
#[derive(Default)]
pub(super) struct ProposalList {
    of: String,
    asked: Option<WorkId>,
    found: Option<SignSuggestions>,
    wrong: Option<String>,
}

/// Returns the recipes for partners of a sign; partners without movement come first.
pub(super) fn propose_partner_recipes(found: &SignSuggestions, field: impl Fn(&str) -> String) -> Vec<RecipeProposal> {
    let mut all: Vec<(bool, RecipeProposal)> = Vec::new();
    for partner in found.partners.iter().chain(&found.possible) {
        let Some(recipe) = &partner.recipe else {
            continue;
        };
        let still = partner.origin == RecordOrigin::Lexicon;
        let about = format!("{}: {} → {}", field(&partner.field), partner.from, partner.to);
        all.push((
            !still,
            RecipeProposal {
                recipe: recipe.clone(),
                gloss: still.then(|| partner.gloss.clone()),
                name: partner.gloss.clone(),
                about,
            },
        ));
    }
    all.sort_by_key(|(moves, _)| *moves);
    all.into_iter().map(|(_, proposal)| proposal).collect()
}

/// Returns the recipes that give a token a value that no sign has with the rest of the coding.
pub(super) fn propose_unused_values(found: &SignSuggestions, field: &str) -> Vec<RecipeProposal> {
    let values = found.unused.get(field).into_iter().flatten();
    let operator = match field {
        "placement" => "place both at",
        _ => "configure dominant",
    };
    values
        .map(|value| {
            let quoted = if value.contains(char::is_whitespace) {
                format!("\"{value}\"")
            } else {
                value.clone()
            };
            RecipeProposal {
                recipe: format!("token:{} | {operator} {quoted}", found.token),
                gloss: None,
                name: value.clone(),
                about: String::new(),
            }
        })
        .collect()
}

/// Returns the name of a field of a coding.
pub(super) fn field_text(field: &str) -> Option<InterfaceText> {
    match field {
        "dominant.configuration" => Some(words::HANDSHAPE),
        "weak.configuration" => Some(words::HANDSHAPE_WEAK),
        "placement" => Some(words::PLACE_NAME),
        _ => None,
    }
}

impl ProposalList {
    /// Requests suggestions for a sign, if it differs from the last one.
    fn request_sign_suggestions(&mut self, of: &str, out: &CommandOutbox) {
        if self.of == of {
            return;
        }
        of.clone_into(&mut self.of);
        (self.found, self.wrong) = (None, None);
        match of.parse::<CorpusAddress>() {
            Ok(address) => self.asked = Some(out.request_work(recombining::suggest_recipes_job(address))),
            Err(error) => self.wrong = Some(error.to_string()),
        }
    }

    pub(super) fn receive_sign_suggestions(&mut self, id: WorkId, ended: &WorkResult) {
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        match ended {
            Ok(WorkOutcome::Suggested(found)) => self.found = Some(found.clone()),
            Err(error) => {
                let advice_text = error
                    .error_remedy()
                    .and_then(|remedy| remedy.remedy_advice().map(str::to_owned));
                let remedy = advice_text.map_or(String::new(), |text| format!("; {text}"));
                self.wrong = Some(format!("{error}{remedy}"));
            }
            Ok(_) => {}
        }
    }

    /// Shows the proposals for `of`; returns the chosen one.
    pub(super) fn show_recipe_proposals(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        of: &str,
    ) -> Option<RecipeProposal> {
        self.request_sign_suggestions(of, seen.out);
        if let Some(wrong) = &self.wrong {
            ui.label(RichText::new(wrong).weak());
            return None;
        }
        let Some(found) = &self.found else {
            ui.spinner();
            return None;
        };
        let named = |field: &str| match field_text(field) {
            Some(text) => seen.say_text(text).to_owned(),
            None => field.to_owned(),
        };
        let partners = propose_partner_recipes(found, named);
        let mut chosen = None;
        if partners.is_empty() {
            ui.weak(seen.say_text(words::NO_PARTNERS));
        }
        let height = ui.spacing().interact_size.y * 1.7;
        for proposal in &partners {
            if list_row(ui, height, false, &proposal.name, &proposal.about).clicked() {
                chosen = Some(proposal.clone());
            }
        }
        for field in ["dominant.configuration", "placement"] {
            let values = propose_unused_values(found, field);
            if values.is_empty() {
                continue;
            }
            ui.add_space(4.0);
            ui.weak(fill_text_braces(
                seen.say_text(words::UNUSED),
                &[("field", &named(field))],
            ));
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing = eframe::egui::vec2(4.0, 4.0);
                for proposal in values {
                    if ui.small_button(&proposal.name).clicked() {
                        chosen = Some(proposal);
                    }
                }
            });
        }
        chosen
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::MinimalPairPartner;

    #[test]
    fn partners_without_movement_come_first_and_give_their_gloss() {
        let partner = |gloss: &str, origin: RecordOrigin, recipe: Option<&str>| MinimalPairPartner {
            token: 1,
            gloss: gloss.into(),
            origin,
            field: "dominant.configuration".into(),
            from: "beak".into(),
            to: "U".into(),
            equal: 3,
            one_sided: 0,
            recipe: recipe.map(str::to_owned),
        };
        let found = SignSuggestions {
            token: 7,
            gloss: "ESCARGOT".into(),
            coding: Default::default(),
            partners: vec![
                partner("LIVRE", RecordOrigin::Captured, Some("token:7 | configure dominant 5")),
                partner("LIMACE", RecordOrigin::Lexicon, Some("token:7 | configure dominant U")),
                partner("X", RecordOrigin::Lexicon, None),
            ],
            possible: Vec::new(),
            unused: [("placement".to_owned(), vec!["neutral space".to_owned()])].into(),
        };
        let all = propose_partner_recipes(&found, str::to_owned);
        let names: Vec<&str> = all.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["LIMACE", "LIVRE"]);
        assert_eq!(all[0].gloss.as_deref(), Some("LIMACE"));
        assert_eq!(all[1].gloss, None);
        let free = propose_unused_values(&found, "placement");
        assert_eq!(free[0].recipe, "token:7 | place both at \"neutral space\"");
        assert!(propose_unused_values(&found, "dominant.configuration").is_empty());
    }
}
