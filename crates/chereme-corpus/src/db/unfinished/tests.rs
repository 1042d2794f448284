use super::*;

#[test]
fn only_own_names_that_nobody_holds_are_removed() {
    let folder = tempfile::tempdir().expect("a folder");
    let to = folder.path().join("c.chereme");
    let id = Uuid::now_v7().simple();
    let unfinished = UnfinishedFile::create_unfinished_file(&to).expect("made");
    let held_name = unfinished
        .unfinished_path()
        .file_name()
        .expect("a name")
        .to_string_lossy()
        .into_owned();
    let other = Uuid::from_u128(0x1234_5678_1234_4678_8234_5678_1234_5678).simple();
    let left = [
        format!(".c.chereme.{id}"),
        format!(".c.chereme.{id}-wal"),
        format!(".c.chereme.{}-shm", Uuid::now_v7().simple()),
    ];
    let kept = [
        "c.chereme".to_owned(),
        held_name,
        format!(".d.chereme.{id}"),
        format!(".c.chereme.{other}"),
        format!("c.chereme.{id}"),
        ".c.chereme.old".to_owned(),
    ];
    let make = |name: &String, age: u64| {
        let path = folder.path().join(name);
        let mut options = File::options();
        let open_options = options.create(true).truncate(false).write(true);
        let file = open_options.open(path).expect("made");
        let made = file.metadata().and_then(|own| own.modified());
        let then = made.expect("a time") - Duration::from_secs(age);
        file.set_modified(then).expect("set");
    };
    left.iter().chain(&kept).for_each(|name| make(name, 60));
    let young = format!(".c.chereme.{}", Uuid::now_v7().simple());
    make(&young, 0);
    let shelf = folder.path().join(format!(".c.chereme.{}", Uuid::now_v7().simple()));
    fs::create_dir(&shelf).expect("made");
    fs::write(shelf.join("a"), "a").expect("written");
    File::open(&shelf)
        .and_then(|held| held.set_modified(std::time::SystemTime::UNIX_EPOCH))
        .expect("set");
    remove_leftovers(&to);
    let entries = fs::read_dir(folder.path()).expect("a folder").flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    let mut wanted: Vec<String> = kept.into_iter().chain([young]).collect();
    names.sort();
    wanted.sort();
    assert_eq!(names, wanted);
}
