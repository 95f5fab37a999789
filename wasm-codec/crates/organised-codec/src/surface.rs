//! From a tile to a surface: a sample for each of its pixels, whatever pattern it came in.

use core::ops::Range;

use crate::paint::Colours;
use crate::tile::{Grid, Pattern, Place, TILE, Tile};

/// Samples of a tile.
pub const TILE_SAMPLES: usize = TILE * TILE;
/// Planes that pass the camera's centre nearer than this are torn where they are seen from the side, metres.
const NEAREST_PLANE: f32 = 0.2;
/// Noise of inverse depth between neighbouring pixels, as a share of it.
const NOISE: f32 = 0.02;

/// The tiles of a frame, [`TILE_SAMPLES`] each, row by row. A sample is the inverse depth as a half float, 1/m, 0 where
/// nothing was seen, in the lower 16 bits, and the colour in 5-6-5 bits, R highest, in the upper.
pub(crate) struct Surface {
    pub samples: Vec<u32>,
    /// The largest difference of inverse depth of neighbouring pixels on one surface, beside the noise, 1/m.
    slope: f32,
}

/// A pixel being filled in.
#[derive(Clone, Copy, Default)]
struct Sample {
    /// Inverse depth, 1/m; 0 for none.
    inverse: f32,
    /// R, G, B, 0 to 255.
    colour: [f32; 3],
}

impl Surface {
    /// For a camera with this focal length, pixels.
    pub fn new(grid: Grid, focal: f32) -> Self {
        Self { samples: vec![0; grid.tiles() * TILE_SAMPLES], slope: 1.0 / (focal * NEAREST_PLANE) }
    }

    /// Empties tiles.
    pub fn clear(&mut self, tiles: Range<usize>) {
        self.samples[tiles.start * TILE_SAMPLES..tiles.end * TILE_SAMPLES].fill(0);
    }

    /// Writes a tile. `step` is that of inverse depth, 1/m. Returns the number of pixels that came.
    #[inline(never)]
    pub fn write(&mut self, tile: &Tile, colours: &Colours, grid: Grid, place: Place, step: f32) -> usize {
        let start = (place.row * grid.columns + place.column) * TILE_SAMPLES;
        let Some(samples) = self.samples[start..].first_chunk_mut() else { return 0 };
        let inside = (grid.width - place.column * TILE, grid.height - place.row * TILE);
        if tile.pattern == Pattern(0) {
            write_whole(tile, colours, step, samples);
            if tile.rows.iter().any(|row| *row != u16::MAX) {
                mend(tile, self.slope, inside, samples);
            }
        } else {
            write_thinned(tile, colours, step, self.slope, inside, samples);
        }
        tile.rows[..tile.pattern.height()].iter().map(|row| row.count_ones() as usize).sum()
    }
}

/// A positive number as a half float, rounded to the nearest; those below 2⁻¹⁴ mean nothing.
#[inline(always)]
fn half(value: f32) -> u32 {
    const BIAS: u32 = (127 - 15) << 23;
    (value.to_bits().wrapping_sub(BIAS).wrapping_add(1 << 12) >> 13) & 0x7fff
}

/// From R, G, B, A, R lowest.
#[inline(always)]
const fn bits565(rgba: u32) -> u32 {
    (rgba & 0xf8) << 8 | (rgba >> 5 & 0x7e0) | (rgba >> 19 & 0x1f)
}

/// A tile of which every pixel may have come.
#[inline(never)]
fn write_whole(tile: &Tile, colours: &Colours, step: f32, samples: &mut [u32; TILE_SAMPLES]) {
    for (y, line) in samples.as_chunks_mut::<TILE>().0.iter_mut().enumerate() {
        let depths = tile.depth.row(y);
        let row: &[u32; TILE] = colours.rgba[y * TILE..][..TILE].first_chunk().expect("a row");
        let valid = tile.rows[y];
        for x in 0..TILE {
            let seen = 0_u32.wrapping_sub(u32::from(valid >> x & 1));
            line[x] = (half(f32::from(depths[x]) * step) | bits565(row[x]) << 16) & seen;
        }
    }
}

/// Fills in pixels that were not seen beside those of a surface, such as a stereo camera's speckle: no more than a pixel, which is
/// what a disc of a pixel's width covers, too.
#[inline(never)]
fn mend(tile: &Tile, slope: f32, inside: (usize, usize), samples: &mut [u32; TILE_SAMPLES]) {
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

/// The inverse depth of a sample that is there.
#[inline(always)]
fn value(sample: u32) -> f32 {
    f32::from_bits(((sample & 0x7fff) << 13) + ((127 - 15) << 23))
}

/// A tile whose other pixels are filled in: on a surface with what lies between its neighbours, at an edge with the nearest.
#[inline(never)]
fn write_thinned(
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

#[cfg(test)]
mod tests {
    use super::*;

    const FOCAL: f32 = 400.0;

    /// A tile of a pattern whose inverse depths are steps of 0.001/m at its pixels in the image.
    fn tile(pattern: u8, depth: impl Fn(usize, usize) -> i16) -> Tile {
        let mut tile = Tile::new();
        tile.pattern = Pattern(pattern);
        for y in 0..tile.pattern.height() {
            for x in 0..tile.pattern.width() {
                let (u, v) = tile.pattern.pixel(x, y);
                let depth = depth(u, v);
                tile.depth.row_mut(y)[x] = depth.max(1);
                tile.rows[y] |= u16::from(depth > 0) << x;
            }
        }
        tile
    }

    fn written(tile: &Tile, inside: (usize, usize)) -> (usize, Vec<u32>) {
        let grid = Grid::new(inside.0, inside.1);
        let mut surface = Surface::new(grid, FOCAL);
        let mut colours = Colours::new(true);
        colours.rgba.fill(u32::from_le_bytes([255, 128, 8, 255]));
        let points = surface.write(tile, &colours, grid, grid.place(0), 0.001);
        (points, surface.samples)
    }

    #[test]
    fn halves_are_near_and_keep_their_order() {
        let mut last = 0;
        for i in 1..30_000 {
            let inverse = i as f32 * 0.000_5;
            let own = half(inverse);
            assert!((value(own) / inverse - 1.0).abs() <= 1.0 / 2048.0, "{inverse}");
            assert!(own >= last);
            last = own;
        }
    }

    #[test]
    fn a_plane_stays_a_plane_in_every_pattern() {
        for pattern in 0..7 {
            let plane = |u: usize, v: usize| (1000 + 3 * u + 2 * v) as i16;
            let (points, samples) = written(&tile(pattern, plane), (TILE, TILE));
            assert_eq!(points, TILE_SAMPLES >> pattern);
            for (i, sample) in samples.iter().enumerate() {
                let own = value(sample & 0xffff) * 1000.0;
                let (u, v) = (i % TILE, i / TILE);
                // Quincunx rows have their own ends: what goes on beyond them is a plane, too.
                assert!((own - f32::from(plane(u, v))).abs() < 0.6, "pattern {pattern}, {u}, {v}: {own}");
                assert_eq!(sample >> 16, 0xfc01);
            }
        }
    }

    #[test]
    fn at_an_edge_each_side_keeps_its_depth() {
        let edge = |u: usize, _: usize| if u < 8 { 2000 } else { 500 };
        for pattern in 0..5 {
            let (_, samples) = written(&tile(pattern, edge), (TILE, TILE));
            for sample in samples {
                let own = (value(sample & 0xffff) * 1000.0).round();
                assert!(
                    (own - 2000.0).abs() <= 1.0 || (own - 500.0).abs() <= 1.0,
                    "pattern {pattern}: {own}"
                );
            }
        }
    }

    #[test]
    fn a_speck_is_filled_in_on_its_surface() {
        for (u, v) in [(0, 0), (15, 7), (6, 9), (15, 15)] {
            let plane = |x: usize, y: usize| if (x, y) == (u, v) { 0 } else { (1000 + 3 * x + 2 * y) as i16 };
            let (points, samples) = written(&tile(0, plane), (TILE, TILE));
            assert_eq!(points, TILE_SAMPLES - 1);
            let filled = value(samples[v * TILE + u]) * 1000.0;
            assert!((filled - (1000 + 3 * u + 2 * v) as f32).abs() <= 3.0, "{u}, {v}: {filled}");
            assert_eq!(samples[v * TILE + u] >> 16, 0xfc01);
        }
        let edge = |x: usize, y: usize| match (x, y) {
            (7, 5) => 0,
            (..7, _) => 2000,
            _ => 500,
        };
        let (_, samples) = written(&tile(0, edge), (TILE, TILE));
        assert!((value(samples[5 * TILE + 7]) * 1000.0 - 500.0).abs() < 1.0);
    }

    #[test]
    fn what_was_not_seen_and_what_lies_beyond_the_image_stays_empty() {
        let hole = |u: usize, v: usize| if u < 4 && v < 4 { 0 } else { 1000 };
        let (points, samples) = written(&tile(0, hole), (TILE, TILE));
        assert_eq!(points, TILE_SAMPLES - 16);
        // It shrinks by a pixel on each side that was seen.
        assert_eq!(samples.iter().filter(|sample| **sample == 0).count(), 9);
        let (_, samples) = written(&tile(0, |u, v| if u < 10 && v < 7 { 1000 } else { 0 }), (10, 7));
        assert_eq!(samples.iter().filter(|sample| **sample != 0).count(), 70);
        let (_, samples) = written(&tile(2, |u, v| if u < 10 && v < 7 { 1000 } else { 0 }), (10, 7));
        assert!(
            samples.iter().enumerate().all(|(i, sample)| *sample == 0 || (i % TILE < 10 && i / TILE < 7))
        );
        assert_eq!(samples.iter().filter(|sample| **sample != 0).count(), 70);
    }
}
