//! `cargo run --release -p farpoint-unorganised-codec --example train_tables`: writes the static tables
//! (`src/tables_data.rs` and `vectors/tables.json`) from synthetic scenes. The same seed gives the same tables.

mod scene;

use std::fmt::Write as _;
use std::path::Path;

use farpoint_unorganised_codec::{
    Attribute, Encoder, Order, Point, SYMBOLS, Settings, TABLE_COUNT, normalise,
};
use scene::{Random, Scene};

/// What every symbol is counted in advance, so that a rare one stays affordable.
const PRIOR: u64 = 1;

fn main() -> std::io::Result<()> {
    let mut random = Random(20_260_101);
    let mut encoder = Encoder::new();
    let mut counts = vec![[PRIOR; SYMBOLS]; TABLE_COUNT];
    for round in 0..24 {
        let street = Scene::new(&mut random, 60.0);
        let levels = random.pick(&[100.0, 255.0]);
        let sweep = street.sweep(&mut random, levels);
        let room = Scene::new(&mut random, 6.0);
        let picture = room.picture(&mut random, [0.0; 3], 0.0);
        let merged = room.merged(&mut random);
        let step_mm = random.pick(&[3, 5, 10, 10, 20, 40]);
        let mut count = |frame: &[Point], attribute, order, step_mode| {
            let settings = Settings { step_mm, attribute, order, ..Settings::default() };
            encoder
                .count_symbols(frame, &settings, step_mode, &mut counts)
                .expect("the settings are in range");
        };
        count(&sweep, Attribute::Intensity8, Order::AsGiven, false);
        count(&sweep, Attribute::Intensity8, Order::Sweep, false);
        count(&sweep, Attribute::None, Order::Morton, true);
        count(&picture, Attribute::Colour, Order::AsGiven, false);
        count(&merged, Attribute::Colour, Order::Morton, true);
        count(&merged, Attribute::None, Order::AsGiven, true);
        eprintln!("round {round}: {} and {} points", sweep.len(), merged.len());
    }
    write(&counts.iter().map(normalise).collect::<Vec<_>>())
}

fn write(tables: &[[u16; SYMBOLS]]) -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut source = String::from(
        "//! Written by `cargo run --release -p farpoint-unorganised-codec --example train_tables`; not to be edited.\n\n\
         use crate::contexts::{SYMBOLS, TABLE_COUNT};\n\n\
         /// Probability of each symbol in 1/4096, table by table.\n#[rustfmt::skip]\n\
         pub static FREQUENCIES: [[u16; SYMBOLS]; TABLE_COUNT] = [\n",
    );
    let mut json = String::from("[\n");
    for (i, table) in tables.iter().enumerate() {
        let row = table.iter().map(u16::to_string).collect::<Vec<_>>().join(",");
        writeln!(source, "    [{row}],").expect("a string takes it");
        let comma = if i + 1 < tables.len() { "," } else { "" };
        writeln!(json, "[{row}]{comma}").expect("a string takes it");
    }
    source.push_str("];\n");
    json.push_str("]\n");
    std::fs::write(folder.join("src/tables_data.rs"), source)?;
    std::fs::write(folder.join("vectors/tables.json"), json)
}
