//! Runs the examples that show how the crates are used.

#![allow(clippy::print_stdout, reason = "examples print their answers")]

macro_rules! examples {
    ($($name:ident $path:literal;)*) => {
        $(
            #[path = $path]
            mod $name;

            #[test]
            fn $name() {
                $name::main().expect("the example runs");
            }
        )*
    };
}

examples! {
    open_and_search "../../crates/chereme-corpus/examples/open_and_search.rs";
    recombine_and_export "../../crates/chereme-corpus/examples/recombine_and_export.rs";
    transcribe_clip "../../crates/chereme-corpus/examples/transcribe_clip.rs";
    draw_sheet "../../crates/chereme-corpus/examples/draw_sheet.rs";
    read_bvh "../../crates/chereme-formats/examples/read_bvh.rs";
    write_eaf "../../crates/chereme-formats/examples/write_eaf.rs";
}
