//! Values that documents hold as text.

/// Converts types to and from the text that they print and parse, for serde's `into = "String"` and `try_from = "String"`.
#[macro_export]
macro_rules! keep_as_text {
    ($($kept:ty),+) => {$(
        impl TryFrom<String> for $kept {
            type Error = <$kept as ::std::str::FromStr>::Err;
            fn try_from(text: String) -> Result<Self, Self::Error> {
                text.parse()
            }
        }
        impl From<$kept> for String {
            fn from(kept: $kept) -> Self {
                kept.to_string()
            }
        }
    )+};
}
