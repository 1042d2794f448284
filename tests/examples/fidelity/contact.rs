//! x
pub fn tables(_: &[crate::capture::Capture]) -> crate::Result<String> {
    Ok(String::new())
}
