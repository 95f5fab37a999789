//! Any bytes as a stream header of the organised codec.
#![no_main]

#[allow(dead_code, reason = "shared by targets")]
#[path = "../checks/organised.rs"]
mod checks;

libfuzzer_sys::fuzz_target!(|data: &[u8]| checks::stream_header(data));
