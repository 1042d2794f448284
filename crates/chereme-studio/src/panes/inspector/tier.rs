//! The editable details of a tier.

use chereme_corpus::{Hands, Stereotype, StoredInventory, TierChange, TierName, TierRow, Values};
use eframe::egui::{Id, Ui};

use super::data;
use super::edit::{choice, grid, line, name_and_value};
use crate::context::{Outbox, PaneInput};
use crate::words::{fill, inspector as words};
use crate::work::editing;

pub(super) fn show(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    tier: &chereme_corpus::TierContents,
    out: &mut Outbox,
) {
    let row = &tier.row;
    let change = |out: &mut Outbox, change: TierChange| {
        out.work(editing::change_tier(TierName::Number(row.id), change));
    };
    grid(ui, "tier", |ui| {
        let key = Id::unique(("tier name", row.id));
        if let Some(name) = line(ui, seen, key, words::NAME, &row.name) {
            let name = Some(name);
            change(
                out,
                TierChange {
                    name,
                    ..TierChange::default()
                },
            );
        }
        name_and_value(ui, seen, words::ROLE, &row.role.name());
        if let Some(hand) = choice(ui, seen, words::HAND, &row.hand, &hands(seen)) {
            let hand = Some(hand);
            change(
                out,
                TierChange {
                    hand,
                    ..TierChange::default()
                },
            );
        }
        if let Some(inventory) = choice(
            ui,
            seen,
            words::INVENTORY,
            &row.inventory_id,
            &inventories(seen, row),
        ) {
            let of = |id: i64| {
                seen.snapshot
                    .overview
                    .inventories
                    .iter()
                    .find(|it| it.id == id)
            };
            let values = match inventory.and_then(of) {
                Some(it) => Values::Inventory(it.inventory.id.clone()),
                None => Values::Free,
            };
            let values = Some(values);
            change(
                out,
                TierChange {
                    values,
                    ..TierChange::default()
                },
            );
        }
        let above = seen.snapshot.open.as_ref().and_then(|open| {
            let tiers = &open.contents.tiers;
            tiers.iter().find(|it| Some(it.row.id) == row.parent_id)
        });
        if let Some(above) = above {
            let how = row
                .stereotype
                .map_or("", Stereotype::elan_name)
                .replace('_', " ");
            name_and_value(
                ui,
                seen,
                words::PARENT,
                &format!("{} ({how})", above.row.name),
            );
        }
        for (text, value) in [
            (words::PARTICIPANT, &row.participant),
            (words::ANNOTATOR, &row.annotator),
        ] {
            if let Some(value) = value {
                name_and_value(ui, seen, text, value);
            }
        }
        let (n, values) = data::tier_counts(tier);
        let counts: [(&str, &dyn std::fmt::Display); 2] = [("n", &n), ("values", &values)];
        name_and_value(
            ui,
            seen,
            words::COUNT,
            &fill(seen.say(words::FILLED), &counts),
        );
    });
}

fn hands(seen: &PaneInput<'_>) -> Vec<(Option<Hands>, String)> {
    [
        (None, words::NOBODY),
        (Some("right"), words::RIGHT),
        (Some("left"), words::LEFT),
        (Some("both"), words::BOTH),
        (Some("dominant"), words::DOMINANT),
        (Some("weak"), words::WEAK),
    ]
    .map(|(name, text)| (name.and_then(Hands::of), seen.say(text).to_owned()))
    .into()
}

/// Returns the inventories that a tier could take its values from.
fn inventories(seen: &PaneInput<'_>, row: &TierRow) -> Vec<(Option<i64>, String)> {
    let fits = |it: &&StoredInventory| {
        let own = (it.inventory.component, it.inventory.feature.as_deref());
        row.role.component() == Some(own) || row.inventory_id == Some(it.id)
    };
    let all = &seen.snapshot.overview.inventories;
    let named = all
        .iter()
        .filter(fits)
        .map(|it| (Some(it.id), it.inventory.id.clone()));
    [(None, "—".to_owned())].into_iter().chain(named).collect()
}
