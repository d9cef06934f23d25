//! libFuzzer on one of the targets, named by the environment variable `ARMILL_FUZZ_TARGET`. See
//! `cargo xtask fuzz`.
#![no_main]

#[path = "../../controllers/mod.rs"]
mod controllers;
#[path = "../target.rs"]
mod target;
#[path = "../words.rs"]
mod words;

use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use std::sync::LazyLock;
use target::{TARGETS, Target};
use words::Words;

static TARGET: LazyLock<&Target> = LazyLock::new(|| {
    let name = std::env::var("ARMILL_FUZZ_TARGET").expect("ARMILL_FUZZ_TARGET names the target");
    TARGETS.iter().find(|target| target.name == name).expect("a target of that name")
});
static WORDS: LazyLock<Words> = LazyLock::new(|| Words::of(&TARGET.corpus()));

fuzz_target!(|data: &[u8]| {
    if let Ok(text) = std::str::from_utf8(data) {
        (TARGET.check)(text);
    }
});

// Half the time mutate bytes as libFuzzer does, which feeds its own guidance; half the time whole
// words, which keep their meaning.
fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let mut random = fastrand::Rng::with_seed(u64::from(seed));
    match std::str::from_utf8(&data[..size]) {
        Ok(text) if random.bool() => {
            let text = WORDS.mutated(text, &mut random);
            let length = text.floor_char_boundary(max_size);
            data[..length].copy_from_slice(&text.as_bytes()[..length]);
            length
        }
        _ => fuzzer_mutate(data, size, max_size),
    }
});
