//! What must hold for any bytes that reach the unorganised decoder. The fuzz target and the replay of its corpus share it.

use farpoint_unorganised_codec::{Decoder, Fault, MAX_POINTS_PER_PACKET, seal};

/// A packet gives points or an error; an error leaves no point; nothing is kept between frames.
fn decode(packet: &[u8]) -> Result<usize, Fault> {
    let mut decoder = Decoder::new(2 * MAX_POINTS_PER_PACKET);
    let first = decoder.decode(packet).map(|decoded| decoded.count);
    assert_eq!(decoder.points().len(), first.unwrap_or(0));
    assert!(decoder.points().len() <= MAX_POINTS_PER_PACKET);
    let points = decoder.points().to_vec();
    decoder.clear();
    assert_eq!(decoder.decode(packet).map(|decoded| decoded.count), first);
    assert_eq!(decoder.points(), points);
    for decoded in decoder.packets() {
        assert!(decoded.origin.iter().all(|metres| metres.abs() <= 500.2) && decoded.step > 0.0);
    }
    first
}

/// Any bytes as a packet: as they are, then with the check value put right.
pub fn packet(data: &[u8]) {
    let _ = decode(data);
    let mut forged = data.to_vec();
    if seal(&mut forged) {
        assert_ne!(decode(&forged), Err(Fault::Check));
    }
}
