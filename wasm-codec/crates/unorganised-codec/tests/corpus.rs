//! Replays what fuzzing has found, with an ordinary compiler.

#[path = "../../../fuzz/checks/unorganised.rs"]
mod checks;

#[path = "../../../fuzz/checks/replay.rs"]
mod replay;

use replay::replay;

#[test]
fn the_corpus_of_unorganised_packet_does_no_harm() {
    replay("unorganised_packet", checks::packet);
}
