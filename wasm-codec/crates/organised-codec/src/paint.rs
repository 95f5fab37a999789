//! From coefficients, points and indices to colours.

use bytemuck::must_cast;
use wide::i16x8;

use crate::lanes::interleave;
use crate::packet::PacketHeader;
use crate::tile::{ColourMode, LAST_TRANSFORMED, TILE, Tile};
use crate::transform::{inverse, plane_step, point_step, to_rgb};

/// Pure green.
const GREEN: [i16; 3] = [0, 255, 0];

/// The colours of a tile's pixels; pixel x, y of the pattern at `y * TILE + x`.
pub(crate) struct Colours {
    /// 6-6-4 bits, R highest.
    pub bits664: [i16; TILE * TILE],
    /// R lowest; only written where they are wanted.
    pub rgba: [u32; TILE * TILE],
    pub wants_rgba: bool,
    planes: [[i16; TILE * TILE]; 3],
}

impl Colours {
    pub fn new(wants_rgba: bool) -> Self {
        Self { bits664: [0; TILE * TILE], rgba: [0; TILE * TILE], wants_rgba, planes: [[0; TILE * TILE]; 3] }
    }

    /// Eight pixels whose channels are 0 to 255.
    #[inline(always)]
    fn put8(&mut self, at: usize, [r, g, b]: [i16x8; 3]) {
        let bits: i16x8 = ((r & i16x8::splat(0xfc)) << 8) | ((g & i16x8::splat(0xfc)) << 2) | (b >> 4);
        self.bits664[at..][..8].copy_from_slice(bits.as_array());
        if self.wants_rgba {
            let low = r | (g << 8);
            let high = b | i16x8::splat(0xff00_u16 as i16);
            let pixels: [u32; 8] = must_cast(interleave(low, high));
            self.rgba[at..][..8].copy_from_slice(&pixels);
        }
    }

    fn put(&mut self, at: usize, rgb: [i16; 3]) {
        let [r, g, b] = rgb.map(|channel| channel as u16);
        self.bits664[at] = ((r & 0xfc) << 8 | (g & 0xfc) << 2 | b >> 4) as i16;
        self.rgba[at] = u32::from(r) | u32::from(g) << 8 | u32::from(b) << 16 | 0xff00_0000;
    }

    /// Paints a tile; `None` where a colour is not in the palette.
    pub fn paint(&mut self, tile: &Tile, header: &PacketHeader, palette: &[u32]) -> Option<()> {
        let (width, height) = (tile.pattern.width(), tile.pattern.height());
        match header.mode {
            ColourMode::None => {
                for at in (0..TILE * TILE).step_by(8) {
                    self.put8(at, GREEN.map(i16x8::splat));
                }
            }
            ColourMode::Palette => {
                for y in 0..height {
                    for (x, index) in tile.index.row(y)[..width].iter().enumerate() {
                        let colour = palette.get(*index as usize - 1)?;
                        let channel = |shift: u32| (colour >> shift & 255) as i16;
                        self.put(y * TILE + x, [channel(0), channel(8), channel(16)]);
                    }
                }
            }
            _ if tile.pattern <= LAST_TRANSFORMED => self.paint_blocks(tile, header),
            _ => {
                let step = point_step(header.quality.into());
                let mut points = tile.points.iter();
                for y in 0..height {
                    for x in (0..width).filter(|x| tile.rows[y] >> x & 1 == 1) {
                        let point = points.next().unwrap_or(&[0; 3]);
                        let [y4, co, cg] = point.map(|level| {
                            let value = (level * step) >> 2;
                            i16x8::splat(value.clamp(i16::MIN.into(), i16::MAX.into()) as i16)
                        });
                        self.put(y * TILE + x, to_rgb(y4, co, cg).map(|channel| channel.to_array()[0]));
                    }
                }
            }
        }
        Some(())
    }

    #[inline(never)]
    fn paint_blocks(&mut self, tile: &Tile, header: &PacketHeader) {
        let (width, height) = (tile.pattern.width(), tile.pattern.height());
        let subsampled = header.mode == ColourMode::Subsampled;
        let luma = header.mode.blocks(tile.pattern, 0);
        let mut index = 0;
        for (plane, pixels) in self.planes.iter_mut().enumerate() {
            let (columns, rows) = header.mode.blocks(tile.pattern, plane);
            let step = plane_step(header.quality.into(), plane, subsampled);
            for by in 0..rows {
                for bx in 0..columns {
                    if (columns, rows) != luma || tile.block_is_seen(bx, by) {
                        let block = inverse(&tile.blocks[index], step);
                        for (y, row) in block.iter().enumerate() {
                            pixels[(by * 8 + y) * TILE + bx * 8..][..8].copy_from_slice(row.as_array());
                        }
                    }
                    index += 1;
                }
            }
        }
        let eight = |own: &Self, plane: usize, at: usize| -> i16x8 {
            let pixels: &[i16; 8] = own.planes[plane][at..][..8].first_chunk().expect("eight pixels");
            i16x8::from(*pixels)
        };
        if subsampled && tile.pattern.0 < 2 {
            for y in 0..height {
                let row = y / 2 * TILE;
                let (co, cg) = (eight(self, 1, row), eight(self, 2, row));
                if width == TILE {
                    // Each chroma value serves two pixels.
                    let (co, cg) = (interleave(co, co), interleave(cg, cg));
                    for half in 0..2 {
                        let at = y * TILE + 8 * half;
                        self.put8(at, to_rgb(eight(self, 0, at), co[half], cg[half]));
                    }
                } else {
                    self.put8(y * TILE, to_rgb(eight(self, 0, y * TILE), co, cg));
                }
            }
        } else {
            for y in 0..height {
                for at in (y * TILE..y * TILE + width).step_by(8) {
                    self.put8(at, to_rgb(eight(self, 0, at), eight(self, 1, at), eight(self, 2, at)));
                }
            }
        }
    }
}
