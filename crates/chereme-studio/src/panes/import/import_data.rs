//! The interpretation of files as lines, rows and marks, without widgets.

use std::collections::BTreeMap;

use chereme_corpus::{FileReport, FileStatus, ImportReport, TierGuess, TierMapping, TierRole};
use chereme_motion::SignerAxes;
use chereme_motion::anatomy::AssignedJointRoles;

use super::import_people;
use crate::panes::inspector;
use crate::words::{InterfaceLanguage, InterfaceText, fill_text_braces, import_words as words};

/// Returns the text about the status of a file.
pub(crate) fn status_text(status: FileStatus) -> InterfaceText {
    match status {
        FileStatus::Imported => words::IMPORTED,
        FileStatus::Updated => words::UPDATED,
        FileStatus::Unchanged => words::UNCHANGED,
        FileStatus::Skipped => words::SKIPPED,
        FileStatus::Refused => words::REFUSED,
    }
}

/// Returns the interpretation of a file's movement for people: unit, axes, rate, joints; empty for other files.
pub(crate) fn movement_interpretation(file: &FileReport, language: InterfaceLanguage) -> Vec<(InterfaceText, String)> {
    let Some(read) = &file.understood.movement else {
        return Vec::new();
    };
    let name = import_people::length_unit_name(read.unit, language).unwrap_or(read.unit);
    let metres = inspector::inspector_data::metres_text(read.metres_per_unit);
    let mut unit = format!("{name} ({metres})");
    if let Some(guess) = &read.guess {
        let percentage = format!("{:.0}", guess.confidence * 100.0);
        let sure = fill_text_braces(words::SURE.text_in_language(language), &[("n", &percentage)]);
        unit = format!("{unit} · {sure}");
    }
    let axes = match read.axes.parse() {
        Ok(axes) => import_people::axes_sentence(axes, language),
        Err(_) => read.axes.clone(),
    };
    vec![
        (words::UNIT, unit),
        (words::AXES, axes),
        (words::RATE, read.frame_rate.clone()),
        (words::JOINTS, read.joints.to_string()),
    ]
}

/// Returns the reasons for the inferred unit and axes.
pub(crate) fn unit_and_axes_reasons(file: &FileReport) -> Vec<String> {
    let movement = file.understood.movement.as_ref();
    let guess = movement.and_then(|read| read.guess.as_ref());
    guess.map_or_else(Vec::new, |guess| guess.reasons.clone())
}

/// Returns the parts of the body that were found, each with its joint; `None` for a file without a body.
pub(crate) fn found_body_parts(file: &FileReport) -> Option<BTreeMap<String, String>> {
    let body = file.understood.body.as_ref()?;
    let roles = body.roles.iter();
    Some(roles.map(|guess| (guess.part.clone(), guess.joint.clone())).collect())
}

/// A tier or column, and its inferred role.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TierRoleGuess {
    pub(crate) name: String,
    /// The role in the spelling of mappings, such as `right.configuration`; empty if unknown.
    pub(crate) role: String,
    pub(crate) sure: f64,
    pub(crate) why: String,
}

/// Returns the inferred roles of a file's tiers or columns.
pub(crate) fn guessed_tier_roles(file: &FileReport) -> Vec<TierRoleGuess> {
    let guesses = file.understood.guessed_tiers().iter();
    let guess = |tier_guess: &TierGuess| TierRoleGuess {
        name: tier_guess.tier.clone(),
        role: tier_guess
            .guessed_tier_topic()
            .map_or(String::new(), |topic| topic.to_string()),
        sure: tier_guess.confidence,
        why: tier_guess.why.clone(),
    };
    guesses.map(guess).collect()
}

/// Returns what the columns of a table are taken for.
pub(crate) fn guessed_column_meanings(file: &FileReport) -> Vec<String> {
    let columns = file.understood.columns.iter().flatten();
    columns
        .map(|column| format!("{} = {}", column.title, column.meaning))
        .collect()
}

/// Returns the roles that the user can give to tiers: those without a component, and those of a hand or a component.
pub(crate) fn offered_roles() -> impl Iterator<Item = &'static str> {
    TierRole::PLAIN_TIER_ROLES
        .iter()
        .map(TierRole::role_kind_name)
        .chain(CODED_TIER_ROLES)
}

/// The roles of a hand or a component that the user can give to tiers.
const CODED_TIER_ROLES: [&str; 21] = [
    "right.gloss",
    "left.gloss",
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
pub(crate) fn mapping_from_choices(chosen: &BTreeMap<String, String>) -> TierMapping {
    let document = serde_json::json!({ "tiers": chosen });
    TierMapping::from_json(&document.to_string()).unwrap_or_default()
}

/// Returns the user's roles of joints; `None` if the user chose none.
pub(crate) fn chosen_joint_roles(chosen: &BTreeMap<String, String>) -> Option<AssignedJointRoles> {
    let trimmed = |(part, joint): (&String, &String)| (part.clone(), joint.trim().to_owned());
    let all: BTreeMap<String, String> = chosen.iter().map(trimmed).collect();
    let document = serde_json::to_string(&all).ok().filter(|_| !all.is_empty())?;
    document.parse().ok()
}

/// Returns each part of the body with its joint, ordered by name; the joint is empty if it was not found. There are no
/// rows for a file without a body.
pub(crate) fn joint_rows(file: &FileReport) -> Vec<(String, String)> {
    let Some(mut all) = found_body_parts(file) else {
        return Vec::new();
    };
    let body = file.understood.body.iter();
    for part in body.flat_map(|body| &body.missing) {
        all.entry(part.clone()).or_default();
    }
    all.into_iter().collect()
}

/// Returns the names of a file's joints.
pub(crate) fn joint_names(file: &FileReport) -> Vec<&str> {
    let body = file.understood.body.iter();
    body.flat_map(|body| &body.joint_names).map(String::as_str).collect()
}

/// Returns every possible choice of axes; those with Y or Z up come first.
pub(crate) fn all_axes() -> impl Iterator<Item = SignerAxes> {
    let up = ["+Y", "+Z", "+X", "-Y", "-Z", "-X"];
    let left = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"];
    up.into_iter().flat_map(move |up| {
        let both = left.into_iter().map(move |left| format!("{up},{left}"));
        both.filter_map(|text| text.parse().ok())
    })
}

/// Returns the names of the axes that point up and to the signer's left.
pub(crate) fn axes_parts(axes: SignerAxes) -> [String; 2] {
    let text = axes.to_string();
    let (up, left) = text.split_once(',').unwrap_or((&text, ""));
    [up.to_owned(), left.to_owned()]
}

/// Returns the number of errors, warnings and notes of a file.
pub(crate) fn finding_counts(file: &FileReport) -> [usize; 3] {
    ["error", "warning", "note"].map(|kind| {
        let of = |finding: &&chereme_corpus::ReportFinding| finding.severity == kind;
        file.findings.iter().filter(of).count()
    })
}

/// Returns the files, those that need attention first: refused, understood, already imported, ignored.
pub(crate) fn files_by_attention(report: &ImportReport) -> Vec<&FileReport> {
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
pub(crate) fn created_row_counts(report: &ImportReport) -> Vec<(InterfaceText, u64)> {
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
    use chereme_corpus::{
        AnnotatedHands, BodyRead, ConventionRead, FileInterpretation, JointRole, MovementRead, ReportFinding,
        SharedPart, TierRole, TiersRead,
    };
    use chereme_motion::PartEvidence;
    use chereme_sign::{HandRef, SignComponent};

    fn file(understood: FileInterpretation) -> FileReport {
        FileReport {
            path: "a.bvh".into(),
            status: FileStatus::Imported,
            recording: None,
            joined: None,
            understood: Box::new(understood),
            findings: vec![ReportFinding {
                severity: "warning",
                line: Some(3),
                message: "odd".into(),
                remedy: Some("mend it".into()),
            }],
            edits: Vec::new(),
        }
    }

    fn body(missing: &[&str], names: &[&str]) -> Option<SharedPart<BodyRead>> {
        let owned = |names: &[&str]| names.iter().map(|&it| it.to_owned()).collect();
        let body = BodyRead {
            roles: vec![JointRole {
                part: "right hand".to_owned(),
                joint: "RHand".to_owned(),
                by: PartEvidence::Name,
            }],
            joint_names: owned(names),
            missing: owned(missing),
            markers: Vec::new(),
        };
        Some(body.into())
    }

    #[test]
    fn a_motion_file_shows_its_unit_and_body_parts() {
        let file = file(FileInterpretation {
            movement: Some(MovementRead {
                joints: 3,
                channels: None,
                frame_rate: "30 fps".to_owned(),
                unit: "cm",
                metres_per_unit: 0.01,
                axes: "+Y,+X".to_owned(),
                guess: Some(ConventionRead {
                    confidence: 0.9,
                    reasons: Vec::new(),
                }),
            }),
            body: body(&[], &["RHand"]),
            ..FileInterpretation::default()
        });
        let lines = movement_interpretation(&file, InterfaceLanguage::English);
        assert_eq!(lines[0], (words::UNIT, "centimetres (0.01 m) · 90 % sure".to_owned()));
        assert_eq!(found_body_parts(&file).expect("a body")["right hand"], "RHand");
        assert_eq!(finding_counts(&file), [0, 1, 0]);
    }

    #[test]
    fn joint_rows_include_missing_joints_and_corrections() {
        let file = file(FileInterpretation {
            body: body(&["jaw"], &["Hips", "RHand", "Chin"]),
            ..FileInterpretation::default()
        });
        let row = |part: &str, joint: &str| (part.to_owned(), joint.to_owned());
        assert_eq!(joint_rows(&file), [row("jaw", ""), row("right hand", "RHand")]);
        assert_eq!(joint_names(&file), ["Hips", "RHand", "Chin"]);
        assert_eq!(chosen_joint_roles(&BTreeMap::new()), None);
        let said = [row("jaw", " Chin "), row("right hand", "")].into();
        let said = chosen_joint_roles(&said).expect("roles").0;
        let said: Vec<(String, String)> = said
            .into_iter()
            .map(|(part, joint)| (part.to_string(), joint))
            .collect();
        assert!(said.contains(&row("jaw", "Chin")) && said.contains(&row("right hand", "")));
    }

    #[test]
    fn every_choice_of_axes_is_offered() {
        let all: Vec<String> = all_axes().map(|axes| axes.to_string()).collect();
        assert_eq!((all.len(), all[0].as_str()), (24, "+Y,+X"));
        let axes = "+Z,-X".parse().expect("axes");
        assert_eq!(axes_parts(axes), ["+Z", "-X"]);
    }

    #[test]
    fn tiers_show_their_inferred_role_and_every_role_is_offered() {
        let guess = |tier: &str, role: Option<TierRole>, hand: Option<AnnotatedHands>| TierGuess {
            tier: tier.to_owned(),
            role,
            hand,
            confidence: 0.9,
            why: String::new(),
        };
        let configuration = TierRole::Component {
            component: SignComponent::Configuration,
            feature: None,
        };
        let right = Some(AnnotatedHands::One(HandRef::Right));
        let file = file(FileInterpretation {
            tiers: Some(SharedPart::from(TiersRead::Guessed(vec![
                guess("Config MD", Some(configuration), right),
                guess("Gloss", Some(TierRole::Gloss), None),
                guess("X", None, None),
            ]))),
            ..FileInterpretation::default()
        });
        let roles: Vec<String> = guessed_tier_roles(&file).into_iter().map(|it| it.role).collect();
        assert_eq!(roles, ["right.configuration", "gloss", ""]);
        assert!(found_body_parts(&file).is_none());
        for role in offered_roles() {
            let chosen = [("A".to_owned(), role.to_owned())].into();
            assert!(
                mapping_from_choices(&chosen).tier_mapping_entry("A").is_some(),
                "{role}"
            );
        }
    }
}
