//! Any bytes as a kernel: an error or a kernel, never a panic. `cargo +nightly fuzz run front`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use straightline_codegen::{Kernel, Settings};
use straightline_tests::random::forms::is_internal;

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    let outcome = Kernel::from_text("fuzz.rs", &text, "k").compile(&Settings::default());
    // The generator catches a panic itself and reports it as a bug of its own.
    if let Err(errors) = outcome {
        assert!(!is_internal(&errors), "{errors}");
    }
});
