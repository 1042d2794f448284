//! Everything that the starter corpus is made of, as files by name.

mod alphabet;
mod arm;
mod bvh;
mod course;
mod eaf;
mod facing;
mod noise;
mod notes;
mod perform;
mod readme;
mod score;
mod signer;
mod signs;
mod takes;
mod track;

pub(crate) use perform::Performance;
pub(crate) use score::Take;

/// Returns every recording and its performance, in the order of their names.
pub(crate) fn performances() -> Vec<(Take, Performance)> {
    let body = track::Body::new(signer::skeleton());
    let perform = |take| {
        let performance = perform::perform(&body, &take);
        (take, performance)
    };
    takes::takes().into_iter().map(perform).collect()
}

/// Returns the files by name that `performances` are written to.
pub(crate) fn files(performances: &[(Take, Performance)]) -> Vec<(String, Vec<u8>)> {
    let said: Vec<Vec<notes::Note>> = performances
        .iter()
        .map(|(take, performance)| notes::notes(take, performance))
        .collect();
    let mut used = eaf::Used::new();
    said.iter().for_each(|notes| eaf::count(notes, &mut used));
    let mut files = Vec::new();
    for ((take, performance), notes) in performances.iter().zip(&said) {
        files.push((format!("{}.bvh", take.stem), bvh::write(&performance.clip)));
        files.push((format!("{}.eaf", take.stem), eaf::write(take, notes, &used)));
    }
    let takes = performances.iter().map(|(take, _)| take);
    files.push(("README.md".to_owned(), readme::readme(takes)));
    files.push(("lexicon.csv".to_owned(), readme::lexicon()));
    files
}
