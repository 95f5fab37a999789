//! Filling in what the encoder has thinned.

use crate::paint::Colours;
use crate::surface_sample::{NOISE, TILE_SAMPLES, bits565, half};
use crate::tile::{Pattern, TILE, Tile};

/// A pixel being filled in.
#[derive(Clone, Copy, Default)]
struct Sample {
    /// Inverse depth, 1/m; 0 for none.
    inverse: f32,
    /// R, G, B, 0 to 255.
    colour: [f32; 3],
}

/// A tile whose other pixels are filled in: on a surface with what lies between its neighbours, at an edge with the nearest.
#[inline(never)]
pub(crate) fn write_thinned(
    tile: &Tile,
    colours: &Colours,
    step: f32,
    slope: f32,
    inside: (usize, usize),
    samples: &mut [u32; TILE_SAMPLES],
) {
    let Pattern(pattern) = tile.pattern;
    let (width, height) = (tile.pattern.width(), tile.pattern.height());
    let odd = usize::from(pattern & 1);
    let shift = pattern >> 1;
    let mut rows = [[Sample::default(); TILE]; TILE];
    for (y, row) in rows.iter_mut().enumerate().take(height) {
        let mut kept = [Sample::default(); TILE];
        let depths = tile.depth.row(y);
        for x in (0..width).filter(|x| tile.rows[y] >> x & 1 == 1) {
            let [r, g, b, _] = colours.rgba[y * TILE + x].to_le_bytes();
            kept[x] = Sample { inverse: f32::from(depths[x]) * step, colour: [r.into(), g.into(), b.into()] };
        }
        fill(&kept[..width], (odd & y) << shift, 1 << (usize::from(shift) + odd), slope, row);
    }
    for x in 0..TILE.min(inside.0) {
        let column = rows.map(|row| row[x]);
        let mut filled = [Sample::default(); TILE];
        fill(&column[..height], 0, 1 << shift, slope, &mut filled);
        for (y, Sample { inverse, colour: [r, g, b] }) in filled.into_iter().enumerate().take(inside.1) {
            let rgba = u32::from_le_bytes([r as u8, g as u8, b as u8, 255]);
            samples[y * TILE + x] = if inverse > 0.0 { half(inverse) | bits565(rgba) << 16 } else { 0 };
        }
    }
}

/// True where two samples some pixels apart may lie on one surface.
fn joined(a: Sample, b: Sample, pixels: f32, slope: f32) -> bool {
    a.inverse > 0.0
        && b.inverse > 0.0
        && (a.inverse - b.inverse).abs() <= slope * pixels + NOISE * a.inverse.max(b.inverse)
}

/// Fills a line in whose pixels `first`, `first + step`, … are kept.
fn fill(kept: &[Sample], first: usize, step: usize, slope: f32, line: &mut [Sample; TILE]) {
    if step == 1 {
        line[..kept.len()].copy_from_slice(kept);
        return;
    }
    let pixels = step as f32;
    let last = kept.len() - 1;
    for (x, own) in line.iter_mut().enumerate() {
        let left = (x.saturating_sub(first) / step).min(last);
        let beyond = x < first || left == last;
        // Beyond the last one, the line goes on as it was before.
        let (a, b, from) = if !beyond {
            (kept[left], kept[left + 1], first + left * step)
        } else if last == 0 {
            *own = kept[0];
            continue;
        } else if left == last {
            (kept[last], kept[last - 1], first + last * step)
        } else {
            (kept[0], kept[1], first)
        };
        let away = (x.abs_diff(from)) as f32 / pixels;
        let is_joined = joined(a, b, pixels, slope);
        *own = match (is_joined, beyond) {
            (true, false) => Sample {
                inverse: a.inverse + (b.inverse - a.inverse) * away,
                colour: core::array::from_fn(|c| a.colour[c] + (b.colour[c] - a.colour[c]) * away),
            },
            (true, true) => Sample { inverse: (a.inverse - (b.inverse - a.inverse) * away).max(0.0), ..a },
            (false, true) => a,
            // In the middle, what was seen.
            (false, false) if away < 0.5 || (away == 0.5 && b.inverse == 0.0) => a,
            (false, false) => b,
        };
    }
}
