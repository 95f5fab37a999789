//! Any bytes as a packet, first as they are, then with the check value put right.
#![no_main]

use farpoint_organised_codec::{Decoder, Intrinsics, StreamHeader, seal, stream};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let _ = StreamHeader::parse(data);
    let header = StreamHeader {
        id: 9,
        width: 90,
        height: 60,
        intrinsics: Intrinsics { fx: 62.0, fy: 62.0, cx: 44.5, cy: 29.5 },
        depth_unit: stream::DEPTH_UNIT,
        palette: Vec::new(),
        index_frequencies: Vec::new(),
    };
    let mut decoder = Decoder::new(header, true).expect("a stream");
    let _ = decoder.put(data);
    if data.len() >= 17 {
        let mut forged = data.to_vec();
        forged[0] = 9;
        seal(&mut forged);
        decoder.begin();
        let _ = decoder.put(&forged);
    }
    assert!(decoder.points().len() <= 90 * 60);
});
