//! `cargo run -p xtask -- bindgen INPUT.wasm OUT_DIR NAME`: writes `NAME.js`, `NAME.d.ts`, `NAME_bg.wasm` and
//! `NAME_bg.wasm.d.ts` into `OUT_DIR`, for a page or a worker (`--target web`). It stands in for the wasm-bindgen
//! command, which would have to be installed apart and takes minutes to compile.
//!
//! `cargo run --release -p xtask -- train-tables OUT.bin`: writes the tables of the organised codec.

mod scenes;
mod train;

use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

/// Of the synthetic frames: the tables depend on nothing else.
const TRAINING_SEED: u64 = 20_261_121;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments[..] {
        ["bindgen", input, out_dir, name] => bindgen(input, out_dir, name),
        ["train-tables", output] => match std::fs::write(output, train::train(TRAINING_SEED)) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("xtask: {output}: {error}");
                ExitCode::FAILURE
            }
        },
        _ => {
            eprintln!("usage: xtask bindgen INPUT.wasm OUT_DIR NAME | train-tables OUT.bin");
            ExitCode::from(2)
        }
    }
}

fn bindgen(input: &str, out_dir: &str, name: &str) -> ExitCode {
    let result = Bindgen::new()
        .input_path(input)
        .web(true)
        .and_then(|bindgen| bindgen.typescript(true).out_name(name).generate(out_dir));
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {input}: {error:#}");
            ExitCode::FAILURE
        }
    }
}
