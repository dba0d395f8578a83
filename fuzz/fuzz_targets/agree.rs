//! Bytes as the seed of a random kernel, which must be the same in every form. `agree` compares it with rustc as well.
//! `cargo +nightly fuzz run agree`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use straightline_codegen::Kernel;
use straightline_tests::random::forms::FORMS;
use straightline_tests::random::make::{Features, make};
use straightline_tests::random::oracle::{Tally, World, compare, interpret};

fuzz_target!(|bytes: [u8; 8]| {
    let seed = u64::from_le_bytes(bytes);
    let (text, world) = (make(seed, Features::all()), World::new(seed));
    let kernel = Kernel::from_text("random.rs", &text.file(), "k");
    // Some kernels are refused.
    let Ok(first) = interpret(&kernel, FORMS[0], &world) else {
        return;
    };
    if let Err(difference) = compare(&text, &world, &first, &mut Tally::default()) {
        panic!("{text}\nworld {seed}: {difference}");
    }
});
