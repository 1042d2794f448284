//! Reasons why the window cannot open.

/// A failure of the window itself; failures inside it become notices there.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudioError {
    /// The system could not open a window.
    #[error("no window can be opened: {reason}")]
    Window {
        /// The message of the system.
        reason: String,
        /// What to do about it.
        remedy: String,
    },
}

impl StudioError {
    pub(crate) fn from_window_error(error: eframe::Error) -> Self {
        let reason = without_place(&error.to_string());
        let remedy = if cfg!(target_os = "linux") {
            "a display (X11 or Wayland) with OpenGL is needed; on Debian: apt-get install libgl1 \
             libegl1 libxkbcommon-x11-0 libxcursor1 libxi6 libx11-xcb1. Every other command of \
             chereme works without a window"
        } else {
            "a display with OpenGL is needed. Every other command of chereme works without a window"
        };
        Self::Window {
            reason,
            remedy: remedy.to_owned(),
        }
    }

    /// Returns what to do about the failure.
    #[must_use]
    pub fn studio_error_remedy(&self) -> &str {
        match self {
            Self::Window { remedy, .. } => remedy,
        }
    }
}

/// Returns a reason without the source file and line that winit puts before it.
fn without_place(reason: &str) -> String {
    let after = |place: &str| Some(reason.split_once(place)?.1.split_once(": ")?.1.to_owned());
    after(".rs:").unwrap_or_else(|| reason.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reason_names_no_line_of_source() {
        let winit = "winit EventLoopError: os error at /a/mod.rs:7: no DISPLAY is set.";
        assert_eq!(without_place(winit), "no DISPLAY is set.");
        assert_eq!(without_place("no GL"), "no GL");
    }
}
