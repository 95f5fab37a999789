//! `cargo run -p xtask -- bindgen INPUT.wasm OUT_DIR NAME`: writes `NAME.js`, `NAME.d.ts`, `NAME_bg.wasm` and
//! `NAME_bg.wasm.d.ts` into `OUT_DIR`, for a page or a worker (`--target web`). It stands in for the wasm-bindgen
//! command, which would have to be installed apart and takes minutes to compile.

use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [task, input, out_dir, name] = arguments.as_slice() else {
        return usage();
    };
    if task != "bindgen" {
        return usage();
    }
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

fn usage() -> ExitCode {
    eprintln!("usage: xtask bindgen INPUT.wasm OUT_DIR NAME");
    ExitCode::from(2)
}
