//! From a tile to a surface: a sample for each of its pixels, whatever pattern it came in.

use core::ops::Range;

use crate::fill::write_thinned;
use crate::mend::mend;
use crate::paint::Colours;
use crate::surface_sample::{TILE_SAMPLES, bits565, half};
use crate::tile::{Grid, Pattern, Place, TILE, Tile};

/// Planes that pass the camera's centre nearer than this are torn where they are seen from the side, metres.
const NEAREST_PLANE: f32 = 0.2;
/// The tiles of a frame, [`TILE_SAMPLES`] each, row by row. A sample is the inverse depth as a half float, 1/m, 0 where
/// nothing was seen, in the lower 16 bits, and the colour in 5-6-5 bits, R highest, in the upper.
pub(crate) struct Surface {
    pub samples: Vec<u32>,
    /// The largest difference of inverse depth of neighbouring pixels on one surface, beside the noise, 1/m.
    slope: f32,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface_sample::value;

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
