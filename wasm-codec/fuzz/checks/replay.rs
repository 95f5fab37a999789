//! Replays what fuzzing has found, with an ordinary compiler.

use std::path::Path;

/// Every file of a target's corpus.
pub fn replay(target: &str, check: fn(&[u8])) {
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
