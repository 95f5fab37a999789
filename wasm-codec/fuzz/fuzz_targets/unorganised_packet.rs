//! Any bytes as a packet of the unorganised codec.
#![no_main]

#[allow(dead_code, reason = "shared by targets")]
#[path = "../checks/unorganised.rs"]
mod checks;

libfuzzer_sys::fuzz_target!(|data: &[u8]| checks::packet(data));
