//! Any bytes as a packet of the organised codec.
#![no_main]

#[allow(dead_code, reason = "shared by targets")]
#[path = "../checks/organised.rs"]
mod checks;

libfuzzer_sys::fuzz_target!(|data: &[u8]| checks::packet(data));
