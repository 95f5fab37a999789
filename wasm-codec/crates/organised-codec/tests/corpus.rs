//! Replays what fuzzing has found, with an ordinary compiler.

#[path = "../../../fuzz/checks/organised.rs"]
mod checks;

#[path = "../../../fuzz/checks/replay.rs"]
mod replay;

use replay::replay;

#[test]
fn the_corpus_of_organised_packet_does_no_harm() {
    replay("organised_packet", checks::packet);
}

#[test]
fn the_corpus_of_organised_header_does_no_harm() {
    replay("organised_header", checks::stream_header);
}
