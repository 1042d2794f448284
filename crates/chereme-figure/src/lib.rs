//! Movement to a body to look at: its geometry, and pictures drawn without a window.
