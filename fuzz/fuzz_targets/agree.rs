//! Bytes as the seed of a random kernel, which must be the same however it is computed.
//! `cargo +nightly fuzz run agree`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use straightline_tests::random::check::{check, picture};
use straightline_tests::random::generate::{Profile, generate};
use straightline_tests::random::print;

fuzz_target!(|bytes: [u8; 8]| {
    let seed = u64::from_le_bytes(bytes);
    let program = generate(seed, Profile::Exact);
    if let Err(failure) = check(&program, &picture(seed)) {
        panic!("{}\nseed {seed}: {failure}", print(&program));
    }
});
