//! The complete starter corpus, as files by name.

mod bvh;
mod eaf;
mod noise;
mod notes;
mod perform;
mod readme;
mod signer;
mod signs;
mod takes;

use chereme_compose::GeneratedMovement;

pub(crate) use notes::glosses;
pub(crate) use takes::Take;

/// Returns every recording and its performance, ordered by name.
pub(crate) fn performances() -> Vec<(Take, GeneratedMovement)> {
    let stage = perform::stage();
    let perform = |take| {
        let made = perform::perform(&stage, &take);
        (take, made)
    };
    takes::takes().into_iter().map(perform).collect()
}

/// Returns the files, by name, to which `performances` are written.
pub(crate) fn files(performances: &[(Take, GeneratedMovement)]) -> Vec<(String, Vec<u8>)> {
    let said: Vec<Vec<notes::Note>> = performances
        .iter()
        .map(|(take, made)| notes::notes(take, made))
        .collect();
    let mut used = eaf::Used::new();
    said.iter().for_each(|notes| eaf::count(notes, &mut used));
    let mut files = Vec::new();
    for ((take, made), notes) in performances.iter().zip(&said) {
        let signs = glosses(made);
        files.push((format!("{}.bvh", take.stem), bvh::write(&made.clip)));
        files.push((format!("{}.eaf", take.stem), eaf::write(take, &signs, notes, &used)));
    }
    let takes = performances.iter().map(|(take, _)| take).zip(&said);
    files.push(("README.md".to_owned(), readme::readme(takes)));
    files.push(("lexicon.csv".to_owned(), readme::lexicon()));
    files
}
