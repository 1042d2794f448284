//! The editable details of a tier.

use chereme_corpus::{
    AnnotatedHands, StoredInventory, TierPropertyChange, TierRequestName, TierRow, TierStereotype, TierValueSource,
};
use eframe::egui::{Id, Ui};

use super::inspector_data;
use super::inspector_edit::{
    name_and_value, new_change, show_editable_line, show_inspector_choice, show_inspector_grid,
};
use crate::context::PaneInput;
use crate::words::{fill_text_braces, inspector as words};
use crate::work::editing;

pub(super) fn show_tier_details(ui: &mut Ui, seen: &PaneInput<'_>, tier: &chereme_corpus::TierContents) {
    let row = &tier.row;
    let change = |change: TierPropertyChange| {
        seen.request_work(editing::change_tier_job(TierRequestName::Number(row.id), change));
    };
    show_inspector_grid(ui, "tier", |ui| {
        let key = Id::unique(("tier name", row.id));
        if let Some(name) = show_editable_line(ui, seen, key, words::NAME, &row.name) {
            change(new_change(|asked: &mut TierPropertyChange| asked.name = Some(name)));
        }
        name_and_value(ui, seen, words::ROLE, &row.role.role_name());
        if let Some(hand) = show_inspector_choice(ui, seen, words::HAND, &row.hand, &hand_choices(seen)) {
            change(new_change(|asked: &mut TierPropertyChange| asked.hand = Some(hand)));
        }
        if let Some(inventory) = show_inspector_choice(
            ui,
            seen,
            words::INVENTORY,
            &row.inventory_id,
            &inventories_for_tier(seen, row),
        ) {
            let of = |id: i64| seen.snapshot.overview.inventories.iter().find(|stored| stored.id == id);
            let tier_values = match inventory.and_then(of) {
                Some(it) => TierValueSource::Inventory(it.inventory.id.clone()),
                None => TierValueSource::Free,
            };
            change(new_change(|asked: &mut TierPropertyChange| {
                asked.values = Some(tier_values)
            }));
        }
        let above = seen.snapshot.open.as_ref().and_then(|open| {
            let tiers = &open.contents.tiers;
            tiers.iter().find(|other_tier| Some(other_tier.row.id) == row.parent_id)
        });
        if let Some(above) = above {
            let how = row.stereotype.map_or("", TierStereotype::elan_name).replace('_', " ");
            name_and_value(ui, seen, words::PARENT, &format!("{} ({how})", above.row.name));
        }
        for (text, value) in [
            (words::PARTICIPANT, &row.participant),
            (words::ANNOTATOR, &row.annotator),
        ] {
            if let Some(value) = value {
                name_and_value(ui, seen, text, value);
            }
        }
        let (n, values) = inspector_data::tier_counts(tier);
        let counts: [(&str, &dyn std::fmt::Display); 2] = [("n", &n), ("values", &values)];
        name_and_value(
            ui,
            seen,
            words::COUNT,
            &fill_text_braces(seen.say_text(words::FILLED), &counts),
        );
    });
    if let Some(annotator) = &row.annotator {
        super::about::show_preference(ui, seen, annotator);
    }
}

fn hand_choices(seen: &PaneInput<'_>) -> Vec<(Option<AnnotatedHands>, String)> {
    [
        (None, words::NOBODY),
        (Some("right"), words::RIGHT),
        (Some("left"), words::LEFT),
        (Some("both"), words::BOTH),
        (Some("dominant"), words::DOMINANT),
        (Some("weak"), words::WEAK),
    ]
    .map(|(name, text)| {
        (
            name.and_then(AnnotatedHands::from_hand_name),
            seen.say_text(text).to_owned(),
        )
    })
    .into()
}

/// Returns the inventories that a tier could take its values from.
fn inventories_for_tier(seen: &PaneInput<'_>, row: &TierRow) -> Vec<(Option<i64>, String)> {
    let fits = |stored: &&StoredInventory| {
        let field = (stored.inventory.component, stored.inventory.feature.as_deref());
        row.role.role_component() == Some(field) || row.inventory_id == Some(stored.id)
    };
    let all = &seen.snapshot.overview.inventories;
    let named = all
        .iter()
        .filter(fits)
        .map(|stored| (Some(stored.id), stored.inventory.id.clone()));
    [(None, "—".to_owned())].into_iter().chain(named).collect()
}
