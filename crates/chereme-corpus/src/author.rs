//! The name of the person at work, for the history.

/// Variables of the environment that name the person, the first that counts first.
const AUTHOR_ENVIRONMENT_VARIABLES: [&str; 4] = ["CHEREME_AUTHOR", "USER", "USERNAME", "LOGNAME"];

/// Returns the author for the history: the given name, otherwise that of the environment, which `variable` reads.
#[must_use]
pub fn determine_author(given: Option<&str>, variable: impl Fn(&str) -> Option<String>) -> String {
    let environment_name = || {
        let mut names = AUTHOR_ENVIRONMENT_VARIABLES.iter().filter_map(|name| variable(name));
        // A variable may be set to nothing.
        names.find(|name| !name.trim().is_empty())
    };
    given
        .map(str::to_owned)
        .or_else(environment_name)
        .unwrap_or_else(|| "unknown".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_option_counts_before_the_environment_and_the_project_before_the_machine() {
        let of = |name: &str| match name {
            "CHEREME_AUTHOR" => Some(" ".to_owned()),
            "USER" | "LOGNAME" => Some(name.to_lowercase()),
            _ => None,
        };
        assert_eq!(determine_author(Some("Camille"), of), "Camille");
        assert_eq!(determine_author(None, of), "user");
        assert_eq!(determine_author(None, |_| None), "unknown");
    }
}
