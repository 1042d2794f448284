//! The search.

texts! {
    TITLE: "Search", "Recherche";
    QUERY: "Query", "Requête";
    HINT: "right.configuration=U placement=chin", "right.configuration=U placement=chin";
    RUN: "Search", "Rechercher";
    FOUND: "{n} found", "{n} trouvés";
    NOTHING: "Nothing answers this query.", "Rien ne répond à cette requête.";
    LEXICON: "lexicon entry", "entrée de lexique";
    PICK: "Pick a value of {field}", "Choisir une valeur de {field}";
    FACETS: "Values", "Valeurs";
}
