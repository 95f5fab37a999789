//! From a loaded tile to what the syntax codes: its pattern's pixels, and colours as coefficients.

use bytemuck::must_cast;
use wide::{f32x4, f32x8, i16x8, i32x4};

use crate::frame::Settings;
use crate::lanes::narrow;
use crate::load::Loaded;
use crate::palette::Palette;
use crate::plan::LEFT_OUT;
use crate::tile::{ColourMode, Kind, LAST_TRANSFORMED, Pattern, TILE, Tile};
use crate::transform::{Quantisers, forward, plane_step, point_step, to_ycocg, to_ycocg4};

/// Makes of loaded tiles what the syntax codes. It holds what is needed on the way: memory that is not written twice.
pub(crate) struct Preparer {
    /// Colours of the pattern's pixels; pixel x, y at `y * TILE + x`.
    rgba: [u32; TILE * TILE],
    planes: [[f32; TILE * TILE]; 3],
    /// Of the planes, for the settings seen last.
    quantisers: [Quantisers; 3],
}

impl Preparer {
    pub fn new() -> Self {
        Self {
            rgba: [0; TILE * TILE],
            planes: [[0.0; TILE * TILE]; 3],
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
        if pattern == LEFT_OUT || loaded.valid == 0 {
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
            for y in 0..height {
                for x in 0..width {
                    if tile.rows[y] >> x & 1 == 1 {
                        tile.index.row_mut(y)[x] = palette.index(rgba[y * TILE + x]) as i16;
                    }
                }
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
    for y in 0..height {
        let row = rows[y];
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
        let mut colour = rgba[above];
        if row & 1 == 0 {
            colour = rgba[y * TILE + row.trailing_zeros() as usize];
        }
        for x in 0..width {
            if row >> x & 1 == 1 {
                colour = rgba[y * TILE + x];
            } else {
                rgba[y * TILE + x] = colour;
            }
        }
        above = y * TILE;
    }
}

fn transform(
    rgba: &[u32; TILE * TILE],
    tile: &mut Tile,
    mode: ColourMode,
    planes: &mut [[f32; TILE * TILE]; 3],
    quantisers: &[Quantisers; 3],
) {
    let (width, height) = (tile.pattern.width(), tile.pattern.height());
    let halved = mode == ColourMode::Subsampled && tile.pattern.0 < 2;
    let four = |y: usize, x: usize| -> [i32x4; 3] {
        let pixels: [u32; 4] = *rgba[y * TILE + x..][..4].first_chunk().expect("four pixels");
        to_ycocg4(must_cast(pixels))
    };
    let mut put = |plane: usize, y: usize, x: usize, values: f32x4| {
        planes[plane][y * TILE + x..][..4].copy_from_slice(values.as_array());
    };
    if halved {
        // Sums over 2 × 2 pixels, or over 1 × 2 where the tile is 8 wide.
        for y in 0..height / 2 {
            for x in (0..width).step_by(8) {
                let [[upper, upper_right], [lower, lower_right]] =
                    [2 * y, 2 * y + 1].map(|row| [four(row, x), four(row, x + 4)]);
                for (row, [left, right]) in [(2 * y, [upper, upper_right]), (2 * y + 1, [lower, lower_right])]
                {
                    put(0, row, x, f32x4::from_i32x4(left[0]));
                    put(0, row, x + 4, f32x4::from_i32x4(right[0]));
                }
                for plane in 1..3 {
                    let (left, right) =
                        (upper[plane] + lower[plane], upper_right[plane] + lower_right[plane]);
                    if width == TILE {
                        let pairs = narrow(left, right).dot(i16x8::ONE);
                        put(plane, y, x / 2, f32x4::from_i32x4(pairs) * f32x4::splat(0.25));
                    } else {
                        put(plane, y, x, f32x4::from_i32x4(left) * f32x4::splat(0.5));
                        put(plane, y, x + 4, f32x4::from_i32x4(right) * f32x4::splat(0.5));
                    }
                }
            }
        }
    } else {
        for y in 0..height {
            for x in (0..width).step_by(4) {
                for (plane, values) in four(y, x).into_iter().enumerate() {
                    put(plane, y, x, f32x4::from_i32x4(values));
                }
            }
        }
    }
    let mut index = 0;
    for (plane, pixels) in planes.iter().enumerate() {
        let (columns, rows) = mode.blocks(tile.pattern, plane);
        for by in 0..rows {
            for bx in 0..columns {
                let block: [f32x8; 8] = core::array::from_fn(|y| {
                    let row: &[f32; 8] =
                        pixels[(by * 8 + y) * TILE + bx * 8..][..8].first_chunk().expect("eight pixels");
                    f32x8::from(*row)
                });
                quantisers[plane].quantise(&forward(&block), &mut tile.blocks[index]);
                index += 1;
            }
        }
    }
}
