//! The 8 × 8 cosine transform of colour blocks and its quantisation, in whole numbers throughout: the same bits everywhere.

mod forward;
mod inverse;

pub use forward::{PIXEL_SCALE, Quantisers, forward};
pub use inverse::inverse;

/// Qualities: the higher the coarser.
pub const QUALITIES: usize = 32;

/// Quantiser steps in 1/16 of a level of 255 (of the orthonormal transform): 32 · 2^(i/5).
pub const STEPS: [i32; QUALITIES] = [
    32, 37, 42, 49, 56, 64, 74, 84, 97, 111, 128, 147, 169, 194, 223, 256, 294, 338, 388, 446, 512, 588, 676,
    776, 891, 1024, 1176, 1351, 1552, 1783, 2048, 2353,
];

/// Step of a plane's coefficients, in 1/16: chroma has its own.
#[must_use]
pub const fn plane_step(quality: usize, plane: usize, subsampled: bool) -> i32 {
    let step = STEPS[quality];
    match (plane, subsampled) {
        (0, _) => step,
        (1, true) => step * 13 / 16,
        (_, true) => step * 11 / 16,
        (1, false) => step * 20 / 16,
        (_, false) => step,
    }
}

/// Step of single points' colours, in 1/16.
#[must_use]
pub const fn point_step(quality: usize) -> i32 {
    let step = STEPS[quality] * 3 / 4;
    if step < 16 { 16 } else { step }
}

/// Zigzag position of each coefficient; row = horizontal frequency, column = vertical frequency.
pub const ZIGZAG: [u8; 64] = {
    let mut zigzag = [0; 64];
    let mut at = 0;
    let mut sum = 0;
    while sum < 15 {
        let mut i = 0;
        while i <= sum {
            // Odd diagonals run downwards (the vertical frequency grows), even ones upwards, as in JPEG.
            let (horizontal, vertical) = if sum % 2 == 1 { (sum - i, i) } else { (i, sum - i) };
            if horizontal < 8 && vertical < 8 {
                zigzag[horizontal * 8 + vertical] = at;
                at += 1;
            }
            i += 1;
        }
        sum += 1;
    }
    zigzag
};

/// Where each zigzag position lies.
pub const UNZIGZAG: [u8; 64] = {
    let mut places = [0; 64];
    let mut i = 0;
    while i < 64 {
        places[ZIGZAG[i] as usize] = i as u8;
        i += 1;
    }
    places
};

#[cfg(test)]
mod tests {
    use wide::i16x8;

    use super::*;
    use crate::tile::Block;

    #[test]
    fn the_zigzag_is_jpegs() {
        // Horizontal frequency first: 0, (1,0), (0,1), (0,2), (1,1), (2,0).
        assert_eq!(UNZIGZAG[..6], [0, 8, 1, 2, 9, 16]);
        assert_eq!(UNZIGZAG[63], 63);
    }

    #[test]
    fn a_block_comes_back_within_its_step() {
        let mut seed = 1_u32;
        for quality in [0, 5, 12, 20] {
            let rows: [i16x8; 8] = core::array::from_fn(|_| {
                i16x8::from(core::array::from_fn::<i16, 8, _>(|_| {
                    seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    ((seed >> 24) as i16 * 4 - 512) * PIXEL_SCALE
                }))
            });
            let mut block = Block { dc: 0, count: 0, levels: [0; 63] };
            let step = STEPS[quality];
            Quantisers::new(step).quantise(&forward(&rows), &mut block);
            let back = inverse(&block, step);
            let mut squares = 0.0;
            for (row, back) in rows.iter().zip(back) {
                for (pixel, back) in row.to_array().iter().zip(back.to_array()) {
                    squares += (f32::from(*pixel) / 16.0 - f32::from(back) / 4.0).powi(2);
                }
            }
            let error = (squares / 64.0).sqrt();
            assert!(error < 0.5 * step as f32 / 16.0 + 0.35, "quality {quality}: {error}");
        }
    }
}
