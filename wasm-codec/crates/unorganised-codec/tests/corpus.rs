//! Replays what fuzzing has found, with an ordinary compiler.

#[path = "../../../fuzz/checks/unorganised.rs"]
mod checks;

use std::path::Path;

fn replay(target: &str, check: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target);
    let files: Vec<_> = std::fs::read_dir(folder).expect("a corpus").collect();
    assert!(files.len() >= 4, "{} files", files.len());
    for file in files {
        let path = file.expect("a file").path();
        let data = std::fs::read(&path).expect("a file");
        println!("{}", path.display());
        check(&data);
    }
}

#[test]
fn the_corpus_of_unorganised_packet_does_no_harm() {
    replay("unorganised_packet", checks::packet);
}
