//! The interpretation of files as lines, rows and marks, without widgets.

use std::collections::BTreeMap;

use chereme_corpus::{FileReport, FileStatus, ImportReport, Mapping};
use chereme_motion::Axes;
use chereme_motion::anatomy::Roles;
use serde_json::Value;

use super::people;
use crate::panes::inspector;
use crate::words::{Language, Text, fill, import as words};

/// Returns the text about the status of a file.
pub(crate) fn status_text(status: FileStatus) -> Text {
    match status {
        FileStatus::Imported => words::IMPORTED,
        FileStatus::Updated => words::UPDATED,
        FileStatus::Unchanged => words::UNCHANGED,
        FileStatus::Skipped => words::SKIPPED,
        FileStatus::Refused => words::REFUSED,
    }
}

/// Returns the interpretation of a file's movement for people: unit, axes, rate, joints; empty for other files.
pub(crate) fn movement(file: &FileReport, language: Language) -> Vec<(Text, String)> {
    let said = |key: &str| file.understood.get(key).map(chereme_corpus::cell_text);
    let unit = said("unit").map(|unit| {
        let name = people::unit(&unit, language).map_or(unit, str::to_owned);
        let metres = file.understood.get("metres_per_unit");
        match metres.and_then(Value::as_f64) {
            Some(length) => format!("{name} ({})", inspector::data::metres(length)),
            None => name,
        }
    });
    let sure = file.understood.get("confidence").and_then(Value::as_f64);
    let axes = said("axes").map(|text| match text.parse() {
        Ok(axes) => people::axes(axes, language),
        Err(_) => text,
    });
    let unit = unit.zip(sure).map(|(unit, sure)| {
        let sure = format!("{:.0}", sure * 100.0);
        format!(
            "{unit} · {}",
            fill(words::SURE.of(language), &[("n", &sure)])
        )
    });
    [
        (words::UNIT, unit),
        (words::AXES, axes),
        (words::RATE, said("frame_rate")),
        (words::JOINTS, said("joints")),
    ]
    .into_iter()
    .filter_map(|(text, value)| Some((text, value?)))
    .collect()
}

/// Returns the reasons for the inferred unit and axes.
pub(crate) fn reasons(file: &FileReport) -> Vec<String> {
    let all = file.understood.get("reasons").and_then(Value::as_array);
    all.into_iter()
        .flatten()
        .filter_map(|it| it.as_str().map(str::to_owned))
        .collect()
}

/// Returns the parts of the body that were found, each with its joint; `None` for a file without a body.
pub(crate) fn parts(file: &FileReport) -> Option<BTreeMap<String, String>> {
    let all = file.understood.get("roles")?.as_array()?;
    let pair = |it: &Value| {
        Some((
            it.get("part")?.as_str()?.to_owned(),
            it.get("joint")?.as_str()?.to_owned(),
        ))
    };
    Some(all.iter().filter_map(pair).collect())
}

/// A tier or column, and its inferred role.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Guess {
    pub(crate) name: String,
    /// The role in the spelling of mappings, such as `right.configuration`; empty if unknown.
    pub(crate) role: String,
    pub(crate) sure: f64,
    pub(crate) why: String,
}

/// Returns the inferred roles of a file's tiers or columns.
pub(crate) fn guesses(file: &FileReport, key: &str) -> Vec<Guess> {
    let all = file.understood.get(key).and_then(Value::as_array);
    let text = |value: Option<&Value>| value.and_then(Value::as_str).unwrap_or_default().to_owned();
    let guess = |it: &Value| {
        let name = text(
            it.get("tier")
                .or_else(|| it.get("column"))
                .or_else(|| it.get("name")),
        );
        let role = role(it.get("role")?);
        let hand = text(it.get("hand"));
        let role = if hand.is_empty() || role.is_empty() {
            role
        } else {
            format!("{hand}.{role}")
        };
        Some(Guess {
            name,
            role,
            sure: it.get("confidence").and_then(Value::as_f64).unwrap_or(1.0),
            why: text(it.get("why")),
        })
    };
    all.into_iter()
        .flatten()
        .filter_map(guess)
        .filter(|it| !it.name.is_empty())
        .collect()
}

fn role(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Object(map) => {
            let inner = map.values().find(|it| it.is_object()).unwrap_or(value);
            let part = |key: &str| inner.get(key).and_then(Value::as_str);
            match (part("component"), part("feature")) {
                (Some(component), Some(feature)) => format!("{component}.{feature}"),
                (Some(component), None) => component.to_owned(),
                _ => map.keys().next().cloned().unwrap_or_default(),
            }
        }
        _ => String::new(),
    }
}

/// The roles that the user can give to tiers.
pub(crate) const ROLES: [&str; 25] = [
    "gloss",
    "right.gloss",
    "left.gloss",
    "translation",
    "comment",
    "free",
    "right.configuration",
    "left.configuration",
    "both.configuration",
    "right.placement",
    "left.placement",
    "both.placement",
    "right.movement",
    "left.movement",
    "both.movement",
    "right.orientation.palm",
    "left.orientation.palm",
    "right.orientation.fingers",
    "left.orientation.fingers",
    "nonmanual.brows",
    "nonmanual.eyes",
    "nonmanual.gaze",
    "nonmanual.mouth",
    "nonmanual.head",
    "nonmanual.body",
];

/// Returns the mapping of the user's choices.
pub(crate) fn mapping(chosen: &BTreeMap<String, String>) -> Mapping {
    let document = serde_json::json!({ "tiers": chosen });
    Mapping::from_json(&document.to_string()).unwrap_or_default()
}

/// Returns the user's roles of joints; `None` if the user chose none.
pub(crate) fn roles(chosen: &BTreeMap<String, String>) -> Option<Roles> {
    let trimmed = |(part, joint): (&String, &String)| (part.clone(), joint.trim().to_owned());
    let all: BTreeMap<String, String> = chosen.iter().map(trimmed).collect();
    let document = serde_json::to_string(&all)
        .ok()
        .filter(|_| !all.is_empty())?;
    document.parse().ok()
}

/// Returns each part of the body with its joint, ordered by name; the joint is empty if it was not found. There are no
/// rows for a file without a body.
pub(crate) fn joint_rows(file: &FileReport) -> Vec<(String, String)> {
    let Some(mut all) = parts(file) else {
        return Vec::new();
    };
    let missing = file.understood.get("missing").and_then(Value::as_array);
    for part in missing.into_iter().flatten().filter_map(Value::as_str) {
        all.entry(part.to_owned()).or_default();
    }
    all.into_iter().collect()
}

/// Returns the names of a file's joints.
pub(crate) fn joint_names(file: &FileReport) -> Vec<&str> {
    let all = file.understood.get("joint_names").and_then(Value::as_array);
    all.into_iter()
        .flatten()
        .filter_map(Value::as_str)
        .collect()
}

/// Returns every possible choice of axes; those with Y or Z up come first.
pub(crate) fn all_axes() -> impl Iterator<Item = Axes> {
    let up = ["+Y", "+Z", "+X", "-Y", "-Z", "-X"];
    let left = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"];
    up.into_iter().flat_map(move |up| {
        let both = left.into_iter().map(move |left| format!("{up},{left}"));
        both.filter_map(|text| text.parse().ok())
    })
}

/// Returns the names of the axes that point up and to the signer's left.
pub(crate) fn axes_parts(axes: Axes) -> [String; 2] {
    let text = axes.to_string();
    let (up, left) = text.split_once(',').unwrap_or((&text, ""));
    [up.to_owned(), left.to_owned()]
}

/// Returns the number of errors, warnings and notes of a file.
pub(crate) fn counts(file: &FileReport) -> [usize; 3] {
    ["error", "warning", "note"].map(|kind| {
        let of = |it: &&chereme_corpus::ReportFinding| it.severity == kind;
        file.findings.iter().filter(of).count()
    })
}

/// Returns the files, those that need attention first: refused, understood, already imported, ignored.
pub(crate) fn in_order(report: &ImportReport) -> Vec<&FileReport> {
    let mut all: Vec<&FileReport> = report.files.iter().collect();
    all.sort_by_key(|file| match file.status {
        FileStatus::Refused => 0,
        FileStatus::Imported | FileStatus::Updated => 1,
        FileStatus::Unchanged => 2,
        FileStatus::Skipped => 3,
    });
    all
}

/// Returns how many rows of each kind an import creates, the most interesting kinds first.
pub(crate) fn created(report: &ImportReport) -> Vec<(Text, u64)> {
    [
        ("recordings", words::RECORDINGS),
        ("tiers", words::TIERS),
        ("annotations", words::ANNOTATIONS),
        ("tokens", words::TOKENS),
        ("signs", words::SIGNS),
        ("inventories", words::INVENTORIES),
        ("notations", words::NOTATIONS),
    ]
    .into_iter()
    .filter_map(|(key, text)| Some((text, *report.created.get(key)?)))
    .filter(|(_, count)| *count > 0)
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::ReportFinding;
    use serde_json::json;

    fn file(understood: Value) -> FileReport {
        let known = [
            "unit",
            "metres_per_unit",
            "confidence",
            "roles",
            "tiers",
            "axes",
            "missing",
            "joint_names",
        ];
        FileReport {
            path: "a.bvh".into(),
            status: FileStatus::Imported,
            recording: None,
            understood: known
                .into_iter()
                .filter_map(|key| Some((key, understood.get(key)?.clone())))
                .collect(),
            findings: vec![ReportFinding {
                severity: "warning",
                line: Some(3),
                message: "odd".into(),
                remedy: Some("mend it".into()),
            }],
            edits: Vec::new(),
        }
    }

    #[test]
    fn a_motion_file_says_its_unit_and_the_parts_of_the_body() {
        let file = file(json!({
            "unit": "cm", "metres_per_unit": 0.01, "confidence": 0.9,
            "roles": [{ "part": "right hand", "joint": "RHand", "by": "name" }],
        }));
        assert_eq!(
            movement(&file, Language::English),
            [(words::UNIT, "centimetres (0.01 m) · 90 % sure".to_owned())]
        );
        assert_eq!(parts(&file).expect("a body")["right hand"], "RHand");
        assert_eq!(counts(&file), [0, 1, 0]);
    }

    #[test]
    fn joints_are_shown_with_the_missing_ones_and_said_otherwise() {
        let file = file(json!({
            "roles": [{ "part": "right hand", "joint": "RHand", "by": "name" }],
            "missing": ["jaw"], "joint_names": ["Hips", "RHand", "Chin"],
        }));
        let row = |part: &str, joint: &str| (part.to_owned(), joint.to_owned());
        assert_eq!(
            joint_rows(&file),
            [row("jaw", ""), row("right hand", "RHand")]
        );
        assert_eq!(joint_names(&file), ["Hips", "RHand", "Chin"]);
        assert_eq!(roles(&BTreeMap::new()), None);
        let said = [row("jaw", " Chin "), row("right hand", "")].into();
        let said = roles(&said).expect("roles").0;
        let said: Vec<(String, String)> = said
            .into_iter()
            .map(|(part, joint)| (part.to_string(), joint))
            .collect();
        assert!(said.contains(&row("jaw", "Chin")) && said.contains(&row("right hand", "")));
    }

    #[test]
    fn axes_can_be_said_in_every_way() {
        let all: Vec<String> = all_axes().map(|axes| axes.to_string()).collect();
        assert_eq!((all.len(), all[0].as_str()), (24, "+Y,+X"));
        let axes = "+Z,-X".parse().expect("axes");
        assert_eq!(axes_parts(axes), ["+Z", "-X"]);
    }

    #[test]
    fn tiers_say_what_they_are_taken_for_and_every_role_can_be_chosen() {
        let file = file(json!({ "tiers": [
            { "tier": "Config MD", "role": { "component": { "component": "configuration", "feature": null } },
              "hand": "right", "confidence": 0.9, "why": "its name" },
            { "tier": "Gloss", "role": "gloss", "hand": null, "confidence": 0.9, "why": "" },
            { "tier": "X", "role": null, "hand": null, "confidence": 0.0, "why": "" },
        ] }));
        let roles: Vec<String> = guesses(&file, "tiers")
            .into_iter()
            .map(|it| it.role)
            .collect();
        assert_eq!(roles, ["right.configuration", "gloss", ""]);
        assert!(parts(&file).is_none());
        for role in ROLES {
            let chosen = [("A".to_owned(), role.to_owned())].into();
            assert!(mapping(&chosen).tier("A").is_some(), "{role}");
        }
    }
}
