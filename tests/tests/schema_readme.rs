//! What `schema/README.md` says: every table and column is named, and every query works.

use std::fs;

use chereme_corpus::Corpus;
use chereme_tests::repository;
use chereme_tests::study::small_study;
use chereme_tests::workers::small_corpus;
use rusqlite::Connection;

/// How the text before a query begins when the query should find nothing.
const FINDS_NOTHING: &str = "Faults";

fn readme() -> String {
    fs::read_to_string(repository::root().join("schema/README.md")).expect("schema/README.md")
}

/// Returns each `sql` block with the line of text before it.
fn queries(readme: &str) -> Vec<(String, String)> {
    let mut queries = Vec::new();
    let (mut title, mut query) = (String::new(), None::<String>);
    for line in readme.lines() {
        match (&mut query, line) {
            (None, "```sql") => query = Some(String::new()),
            (None, "") => {}
            (None, line) => title = line.to_owned(),
            (Some(sql), "```") => {
                queries.push((title.clone(), std::mem::take(sql)));
                query = None;
            }
            (Some(sql), line) => *sql += &format!("{line}\n"),
        }
    }
    queries
}

fn corpus() -> (tempfile::TempDir, Connection) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path(), "small.chereme").expect("a corpus");
    let mut corpus = Corpus::open_corpus(&path, "maker").expect("opened");
    corpus.recombine_recipe("BOL | reverse", "LOB").expect("made");
    small_study(&mut corpus, folder.path()).expect("a study");
    drop(corpus);
    let connection = Connection::open(path).expect("opened");
    (folder, connection)
}

#[test]
fn every_query_of_the_readme_works() {
    let (_folder, connection) = corpus();
    let queries = queries(&readme());
    assert!(queries.len() >= 20, "{} queries", queries.len());
    for (title, sql) in &queries {
        let mut statement = connection
            .prepare(sql)
            .unwrap_or_else(|error| panic!("{title}\n{error}"));
        assert!(statement.readonly(), "{title} changes the corpus");
        let mut rows = statement.query([]).expect(title);
        let mut count = 0;
        while rows.next().unwrap_or_else(|error| panic!("{title}\n{error}")).is_some() {
            count += 1;
        }
        let none = title.starts_with(FINDS_NOTHING);
        assert_eq!(count == 0, none, "{title} {count} rows");
    }
}

#[test]
fn the_readme_lists_the_roles_of_tiers() {
    let (_folder, connection) = corpus();
    let mut statement = connection
        .prepare("SELECT '- `' || name || '`: ' || note FROM tier_role")
        .expect("a table");
    let rows = statement.query_map([], |row| row.get::<_, String>(0));
    let rows: Vec<String> = rows.expect("rows").flatten().collect();
    let readme = readme();
    let missing: Vec<&String> = rows.iter().filter(|it| !readme.contains(*it)).collect();
    assert!(
        rows.len() >= 5 && missing.is_empty(),
        "add to schema/README.md: {missing:#?}"
    );
}

#[test]
fn an_exported_folder_holds_the_dictionary_and_its_queries_run() {
    let (folder, connection) = corpus();
    drop(connection);
    let corpus = Corpus::open_corpus(&folder.path().join("small.chereme"), "reader").expect("opened");
    let to = folder.path().join("shared");
    let mut hear = chereme_corpus::ignore_progress_step;
    corpus
        .export_corpus(
            &chereme_corpus::ExportWhat::All,
            &to,
            &chereme_corpus::ExportOptions::default(),
            &mut chereme_corpus::ProgressReceiver::new(&mut hear),
        )
        .expect("exported");
    let page = fs::read_to_string(to.join("DICTIONARY.md")).expect("the dictionary");
    assert_eq!(queries(&page), queries(&readme()));
    let file = fs::read_to_string(to.join("queries.sql")).expect("the queries");
    let connection = Connection::open(to.join("corpus.chereme")).expect("opened");
    let all: Vec<&str> = file.split(";\n").filter(|it| it.contains("SELECT")).collect();
    assert_eq!(all.len(), queries(&page).len());
    for sql in all {
        let mut statement = connection.prepare(sql).unwrap_or_else(|error| panic!("{sql}\n{error}"));
        assert!(statement.readonly(), "{sql}");
        let mut rows = statement.query([]).expect(sql);
        while rows.next().unwrap_or_else(|error| panic!("{sql}\n{error}")).is_some() {}
    }
    let sums = fs::read_to_string(to.join("SHA256SUMS")).expect("checksums");
    assert!(sums.contains("DICTIONARY.md") && sums.contains("queries.sql"));
}

#[test]
fn every_table_and_column_is_described() {
    let (_folder, connection) = corpus();
    let readme = readme();
    let mut statement = connection
        .prepare(
            "SELECT t.name, c.name FROM pragma_table_list t, pragma_table_info(t.name) c
             WHERE t.schema = 'main' AND t.type = 'table' AND t.name NOT LIKE 'sqlite_%'
             ORDER BY t.name, c.cid",
        )
        .expect("the schema");
    let columns: Vec<(String, String)> = statement
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?)))
        .and_then(Iterator::collect)
        .expect("the schema");
    let mut missing = Vec::new();
    for (table, column) in &columns {
        let heading = |line: &str| line.starts_with("### ") && line.contains(&format!("`{table}`"));
        let section: Vec<&str> = readme
            .lines()
            .skip_while(|line| !heading(line))
            .skip(1)
            .take_while(|line| !line.starts_with('#'))
            .filter_map(|line| line.strip_prefix("| ")?.split('|').next())
            .collect();
        if !section.iter().any(|cell| cell.contains(&format!("`{column}`"))) {
            missing.push(format!("{table}.{column}"));
        }
    }
    assert!(missing.is_empty(), "schema/README.md says nothing of {missing:?}");
}

#[test]
fn every_value_that_a_column_may_hold_is_described() {
    let (_folder, connection) = corpus();
    let readme = readme();
    let mut statement = connection
        .prepare("SELECT sql FROM sqlite_schema WHERE type = 'table' AND sql LIKE '%CHECK%'")
        .expect("the schema");
    let tables: Vec<String> = statement
        .query_map([], |row| row.get(0))
        .and_then(Iterator::collect)
        .expect("the schema");
    let words = tables.iter().flat_map(|sql| sql.split('\'').skip(1).step_by(2));
    let missing: Vec<&str> = words
        .filter(|word| !word.is_empty() && !readme.contains(&format!("`{word}`")))
        .collect();
    assert!(missing.is_empty(), "schema/README.md does not name {missing:?}");
}

#[test]
fn the_minimal_pairs_of_the_readme_hold_handshapes_of_two_values() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("pairs.chereme");
    let table = folder.path().join("t.csv");
    fs::write(&table, "gloss,handshape,location\nA,V + O,chin\nB,V,chin\nC,V,chest\n").expect("written");
    let mut corpus = Corpus::create_corpus(&path, "maker").expect("made");
    let mut hear = chereme_corpus::ignore_progress_step;
    let progress = &mut chereme_corpus::ProgressReceiver::new(&mut hear);
    let options = chereme_corpus::ImportOptions::default();
    corpus.import_paths(&[table], &options, progress).expect("imported");
    drop(corpus);
    let connection = Connection::open(path).expect("opened");
    let queries = queries(&readme());
    let pairs = queries.iter().find(|(_, sql)| sql.contains("AS shared"));
    let (_, sql) = pairs.expect("the query of minimal pairs");
    let mut statement = connection.prepare(sql).expect("a query");
    let rows = statement
        .query_map([], |row| {
            Ok(format!("{} {}", row.get::<_, String>(0)?, row.get::<_, String>(2)?))
        })
        .expect("asked");
    let found: Vec<String> = rows.map(|row| row.expect("a row")).collect();
    assert_eq!(found, ["A B"]);
}
