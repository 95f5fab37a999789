//! From a tile to points and pixels.

use core::ops::Range;

use bytemuck::must_cast;
use wide::{f32x4, i16x8, i32x4};

use crate::lanes::{interleave, round_low};
use crate::paint::Colours;
use crate::surface::Surface;
use crate::tile::{Grid, Place, TILE, Tile};

/// What is written beside the points or instead of them.
#[derive(Default)]
pub(crate) struct Outputs {
    pub images: Option<Images>,
    /// In place of points.
    pub surface: Option<Surface>,
}

impl Outputs {
    /// Empties a surface's tiles.
    pub fn clear(&mut self, tiles: &Range<usize>) {
        if let Some(surface) = &mut self.surface {
            surface.clear(tiles.clone());
        }
    }
}

/// Depth and colour images beside the points.
pub(crate) struct Images {
    /// Metres, 0 where there is no point.
    pub depth: Vec<f32>,
    /// R lowest.
    pub colour: Vec<u32>,
}

/// Where a tile lies and how it is seen.
pub(crate) struct View<'a> {
    pub grid: Grid,
    /// x at 1 m of each column, padded to whole tiles.
    pub columns: &'a [f32],
    /// y at 1 m of each row.
    pub rows: &'a [f32],
    pub place: Place,
    /// 1 / step of inverse depth.
    pub scale: f32,
}

/// Millimetres in the lower 16 bits, rounded to the nearest, of two to the even; never beyond ±32767.
#[inline(always)]
fn millimetres(metres: f32x4) -> i32x4 {
    const LIMIT: f32x4 = f32x4::splat(32_767.0);
    let limited = (metres * f32x4::splat(1000.0)).fast_min(LIMIT).fast_max(-LIMIT);
    round_low(limited)
}

/// False where a pixel outside the image is said to be valid.
pub(crate) fn lies_within(tile: &Tile, grid: Grid, place: Place) -> bool {
    let (x0, y0) = (place.column * TILE, place.row * TILE);
    (0..tile.pattern.height()).filter(|y| tile.rows[*y] != 0).all(|y| {
        let (x, v) = tile.pattern.pixel(15 - tile.rows[y].leading_zeros() as usize, y);
        x0 + x < grid.width && y0 + v < grid.height
    })
}

/// Writes a tile's points from `count` on; `None` where a pixel outside the image is said to be valid, or there is no
/// room for a whole row.
#[inline(never)]
pub(crate) fn emit(
    tile: &Tile,
    colours: &Colours,
    view: &View<'_>,
    points: &mut [u64],
    mut count: usize,
    mut images: Option<&mut Images>,
) -> Option<usize> {
    let View { grid, columns, rows, place, scale } = *view;
    let (width, height) = (tile.pattern.width(), tile.pattern.height());
    let shift = tile.pattern.0 >> 1;
    let odd = usize::from(tile.pattern.0 & 1);
    let (x0, y0) = (place.column * TILE, place.row * TILE);
    let tile_columns: &[f32; TILE] = columns[x0..][..TILE].first_chunk()?;
    if !lies_within(tile, grid, place) {
        return None;
    }
    for y in 0..height {
        let valid = tile.rows[y];
        if valid == 0 {
            continue;
        }
        let v = y0 + (y << shift);
        let first = (odd & y) << shift;
        let step = 1 << (usize::from(shift) + odd);
        let mut rays = *tile_columns;
        if step > 1 {
            for (x, ray) in rays.iter_mut().enumerate().take(width) {
                *ray = tile_columns[(first + x * step) % TILE];
            }
        }
        let depths = tile.depth.row(y);
        let row_colours: &[i16; TILE] = colours.bits664[y * TILE..][..TILE].first_chunk()?;
        // Room for a whole row, however many of its points count.
        let target: &mut [u64; TILE] = points.get_mut(count..)?.first_chunk_mut()?;
        let mut at = 0;
        for x in (0..width).step_by(8) {
            let depth: &[i16; 8] = depths[x..][..8].first_chunk()?;
            let colour: &[i16; 8] = row_colours[x..][..8].first_chunk()?;
            let depth = interleave((*depth).into(), i16x8::ZERO);
            let colour = interleave(i16x8::ZERO, (*colour).into());
            for half in 0..2 {
                let x = x + 4 * half;
                let ray_x = f32x4::from(*rays[x..][..4].first_chunk::<4>()?);
                let z = f32x4::splat(scale) / f32x4::from_i32x4(must_cast(depth[half]));
                let low = i32x4::splat(0xffff);
                let xy = (millimetres(z * ray_x) & low) | (millimetres(z * f32x4::splat(rows[v])) << 16);
                let zc = (millimetres(z) & low) | must_cast::<i16x8, i32x4>(colour[half]);
                let (xy, zc): (f32x4, f32x4) = (must_cast(xy), must_cast(zc));
                let four: [f32x4; 2] = [xy.unpack_lo(zc), xy.unpack_hi(zc)];
                let four: [u64; 4] = must_cast(four);
                let there = valid >> x & 15;
                if there == 15 {
                    target[at..][..4].copy_from_slice(&four);
                    at += 4;
                } else {
                    for (i, point) in four.into_iter().enumerate() {
                        target[at % TILE] = point;
                        at += usize::from(there >> i & 1);
                    }
                }
                if let Some(images) = images.as_deref_mut() {
                    for i in (0..4).filter(|i| there >> i & 1 == 1) {
                        let pixel = v * grid.width + x0 + first + (x + i) * step;
                        images.depth[pixel] = z.as_array()[i];
                        images.colour[pixel] = colours.rgba[y * TILE + x + i];
                    }
                }
            }
        }
        count += at;
    }
    Some(count)
}
