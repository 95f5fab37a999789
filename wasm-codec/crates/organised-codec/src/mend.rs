//! Filling in what a sensor missed.

use crate::surface_sample::{NOISE, TILE_SAMPLES, half, value};
use crate::tile::{TILE, Tile};

/// Fills in pixels that were not seen beside those of a surface, such as a stereo camera's speckle: no more than a pixel, which is
/// what a disc of a pixel's width covers, too.
#[inline(never)]
pub(crate) fn mend(tile: &Tile, slope: f32, inside: (usize, usize), samples: &mut [u32; TILE_SAMPLES]) {
    let before = *samples;
    let in_image = u16::MAX >> TILE.saturating_sub(inside.0);
    for (y, row) in tile.rows.iter().enumerate().take(inside.1) {
        let mut missing = !row & in_image;
        while missing != 0 {
            let x = missing.trailing_zeros() as usize;
            missing &= missing - 1;
            if let Some(mean) = mean_around(&before, x, y, slope) {
                samples[y * TILE + x] = mean;
            }
        }
    }
}

/// The mean of the neighbours in the tile that lie on one surface with their median, where these are three of eight or as large
/// a share.
fn mean_around(samples: &[u32; TILE_SAMPLES], x: usize, y: usize, slope: f32) -> Option<u32> {
    let (mut seen, mut count, mut near) = ([0; 8], 0, 0);
    for v in y.saturating_sub(1)..=(y + 1).min(TILE - 1) {
        for u in x.saturating_sub(1)..=(x + 1).min(TILE - 1) {
            near += usize::from((u, v) != (x, y));
            let sample = samples[v * TILE + u];
            if sample != 0 {
                seen[count] = sample;
                count += 1;
            }
        }
    }
    if 8 * count < 3 * near {
        return None;
    }
    let seen = &mut seen[..count];
    // Half floats above 0 have the order of their bits.
    seen.sort_unstable_by_key(|sample| sample & 0xffff);
    let median = value(seen[count / 2]);
    let limit = 2.0 * slope + NOISE * median;
    let (mut sum, mut channels, mut on) = (0.0, [0_u32; 3], 0_u32);
    for sample in seen.iter().filter(|sample| (value(**sample) - median).abs() <= limit) {
        sum += value(*sample);
        let colour = sample >> 16;
        for (channel, own) in channels.iter_mut().zip([colour >> 11, colour >> 5 & 63, colour & 31]) {
            *channel += own;
        }
        on += 1;
    }
    if 8 * (on as usize) < 3 * near {
        return None;
    }
    let [r, g, b] = channels.map(|sum| (sum + on / 2) / on);
    Some(half(sum / on as f32) | (r << 11 | g << 5 | b) << 16)
}
