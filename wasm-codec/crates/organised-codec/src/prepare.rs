//! From a loaded tile to what the syntax codes: its pattern's pixels, and colours as coefficients.

use wide::i16x8;

use crate::frame::Settings;
use crate::lanes::deinterleave;
use crate::load::Loaded;
use crate::palette::Palette;
use crate::tile::{ColourMode, Kind, LAST_TRANSFORMED, Pattern, TILE, Tile};
use crate::transform::{PIXEL_SCALE, Quantisers, forward, plane_step, point_step};
use crate::ycocg::{to_ycocg, to_ycocg8};

/// Makes of loaded tiles what the syntax codes. It holds what is needed on the way: memory that is not written twice.
pub(crate) struct Preparer {
    /// Colours of the pattern's pixels; pixel x, y at `y * TILE + x`.
    rgba: [u32; TILE * TILE],
    planes: [[i16; TILE * TILE]; 3],
    /// Of the planes, for the settings seen last.
    quantisers: [Quantisers; 3],
}

impl Preparer {
    pub fn new() -> Self {
        Self {
            rgba: [0; TILE * TILE],
            planes: [[0; TILE * TILE]; 3],
            quantisers: core::array::from_fn(|_| Quantisers::new(1)),
        }
    }

    pub fn prepare(
        &mut self,
        loaded: &Loaded,
        tile: &mut Tile,
        pattern: Pattern,
        settings: &Settings,
        palette: &Palette,
    ) {
        tile.pattern = pattern;
        let (width, height) = (pattern.width(), pattern.height());
        tile.rows = [0; TILE];
        if pattern == Pattern::LEFT_OUT || loaded.valid == 0 {
            tile.kind = Kind::Empty;
            return;
        }
        let whole = pattern.0 == 0;
        if whole {
            tile.rows = loaded.rows;
            for y in 0..TILE {
                tile.depth.row_mut(y).copy_from_slice(&loaded.depth[y * TILE..(y + 1) * TILE]);
            }
        } else {
            for y in 0..height {
                for x in 0..width {
                    let (u, v) = pattern.pixel(x, y);
                    tile.depth.row_mut(y)[x] = loaded.depth[v * TILE + u];
                    self.rgba[y * TILE + x] = loaded.rgba[v * TILE + u];
                    tile.rows[y] |= (loaded.rows[v] >> u & 1) << x;
                }
            }
        }
        tile.kind = match tile.valid() {
            0 => Kind::Empty,
            valid if valid == width * height => Kind::Full,
            _ => Kind::Mixed,
        };
        if tile.kind == Kind::Empty || settings.mode == ColourMode::None {
            return;
        }
        if settings.mode == ColourMode::Palette {
            let rgba = if whole { &loaded.rgba } else { &self.rgba };
            for (colours, y) in rgba.as_chunks::<TILE>().0.iter().zip(0..height) {
                palette.places(colours, tile.rows[y], tile.index.row_mut(y));
            }
        } else if pattern <= LAST_TRANSFORMED {
            self.set(settings);
            let rgba = if whole && tile.kind == Kind::Full {
                &loaded.rgba
            } else {
                if whole {
                    self.rgba.copy_from_slice(&loaded.rgba);
                }
                if tile.kind == Kind::Mixed {
                    fill(&mut self.rgba, &tile.rows, width, height);
                }
                &self.rgba
            };
            transform(rgba, tile, settings.mode, &mut self.planes, &self.quantisers);
        } else {
            let step = point_step(settings.quality.into());
            let mut at = 0;
            for y in 0..height {
                for x in 0..width {
                    if tile.rows[y] >> x & 1 == 1 {
                        // Times 4 in, steps in 1/16.
                        tile.points[at] = to_ycocg(self.rgba[y * TILE + x]).map(|c| {
                            let c = 4 * c;
                            (c + (step / 2) * c.signum()) / step
                        });
                        at += 1;
                    }
                }
            }
        }
    }

    /// Quantisers for these settings.
    fn set(&mut self, settings: &Settings) {
        let subsampled = settings.mode == ColourMode::Subsampled;
        for (plane, quantisers) in self.quantisers.iter_mut().enumerate() {
            let step = plane_step(settings.quality.into(), plane, subsampled);
            if quantisers.step() != step {
                *quantisers = Quantisers::new(step);
            }
        }
    }
}

/// Gives pixels that are not valid the colour of the valid one to their left, or above.
fn fill(rgba: &mut [u32; TILE * TILE], rows: &[u16; TILE], width: usize, height: usize) {
    let first = rows[..height].iter().position(|row| *row != 0).unwrap_or(0);
    let mut above = first * TILE + (rows[first].trailing_zeros() as usize).min(TILE - 1);
    for (y, &row) in rows.iter().enumerate().take(height) {
        if row == 0 {
            if y > 0 {
                rgba.copy_within((y - 1) * TILE..y * TILE, y * TILE);
            } else {
                let colour = rgba[above];
                rgba[..TILE].fill(colour);
            }
            continue;
        }
        if row >> (width - 1) == 1 && row.count_ones() as usize == width {
            above = y * TILE;
            continue;
        }
        let start = y * TILE;
        let mut missing = !row & ((1_u32 << width) - 1) as u16;
        if row & 1 == 0 {
            let first = row.trailing_zeros() as usize % TILE;
            let colour = rgba[start + first];
            rgba[start..start + first].fill(colour);
            missing &= u16::MAX << first;
        }
        while missing != 0 {
            let x = missing.trailing_zeros() as usize % TILE;
            missing &= missing - 1;
            rgba[start + x] = rgba[start + x - 1];
        }
        above = y * TILE;
    }
}

fn transform(
    rgba: &[u32; TILE * TILE],
    tile: &mut Tile,
    mode: ColourMode,
    planes: &mut [[i16; TILE * TILE]; 3],
    quantisers: &[Quantisers; 3],
) {
    let (width, height) = (tile.pattern.width(), tile.pattern.height());
    let halved = mode == ColourMode::Subsampled && tile.pattern.0 < 2;
    let eight = |y: usize, x: usize| -> [i16x8; 3] {
        to_ycocg8(*rgba[y * TILE + x..][..8].first_chunk().expect("eight pixels"))
    };
    let mut put = |plane: usize, y: usize, x: usize, values: i16x8| {
        planes[plane][y * TILE + x..][..8].copy_from_slice(values.as_array());
    };
    let scale = i16x8::splat(PIXEL_SCALE);
    if halved {
        // Sums over 2 × 2 pixels, or over 1 × 2 where the tile is 8 wide.
        for y in 0..height / 2 {
            let mut chroma = [[i16x8::ZERO; 2]; 2];
            for half in 0..width / 8 {
                let [upper, lower] = [2 * y, 2 * y + 1].map(|row| eight(row, 8 * half));
                put(0, 2 * y, 8 * half, upper[0] * scale);
                put(0, 2 * y + 1, 8 * half, lower[0] * scale);
                for (plane, sums) in chroma.iter_mut().enumerate() {
                    sums[half] = upper[plane + 1] + lower[plane + 1];
                }
            }
            for (plane, [left, right]) in chroma.into_iter().enumerate() {
                let sums = if width == TILE {
                    let [even, odd] = deinterleave(left, right);
                    even + odd
                } else {
                    left + left
                };
                put(plane + 1, y, 0, sums);
            }
        }
    } else {
        for y in 0..height {
            for x in (0..width).step_by(8) {
                for (plane, values) in eight(y, x).into_iter().enumerate() {
                    put(plane, y, x, values * scale);
                }
            }
        }
    }
    let mut index = 0;
    let luma = mode.blocks(tile.pattern, 0);
    for (plane, pixels) in planes.iter().enumerate() {
        let (columns, rows) = mode.blocks(tile.pattern, plane);
        for by in 0..rows {
            for bx in 0..columns {
                if (columns, rows) == luma && !tile.block_is_seen(bx, by) {
                    index += 1;
                    continue;
                }
                let block: [i16x8; 8] = core::array::from_fn(|y| {
                    let row: &[i16; 8] =
                        pixels[(by * 8 + y) * TILE + bx * 8..][..8].first_chunk().expect("eight pixels");
                    i16x8::from(*row)
                });
                quantisers[plane].quantise(&forward(&block), &mut tile.blocks[index]);
                index += 1;
            }
        }
    }
}
