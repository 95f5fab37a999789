//! From coefficients, points and indices to colours.

use bytemuck::must_cast;
use wide::i16x8;

use crate::lanes::interleave;
use crate::packet::PacketHeader;
use crate::tile::{ColourMode, LAST_TRANSFORMED, TILE, Tile};
use crate::transform::{inverse, plane_step, point_step};
use crate::ycocg::to_rgb;

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

/// A colour as points have it and as images have it.
#[derive(Clone, Copy)]
pub(crate) struct Colour {
    bits664: i16,
    rgba: u32,
}

impl Colour {
    pub fn new([r, g, b]: [u8; 3]) -> Self {
        let bits664 = u16::from(r & 0xfc) << 8 | u16::from(g & 0xfc) << 2 | u16::from(b >> 4);
        Self { bits664: bits664 as i16, rgba: u32::from_le_bytes([r, g, b, 255]) }
    }
}

/// A stream's colours by index, from 1.
pub(crate) struct Palette {
    /// The first colour beyond.
    end: i16,
    bits664: [i16; PALETTE_SLOTS],
    rgba: [u32; PALETTE_SLOTS],
}

/// Places for indices: a power of two, so that a place is within with no more than a mask.
const PALETTE_SLOTS: usize = 512;

impl Palette {
    /// Of 256 colours at most.
    pub fn new(colours: &[[u8; 3]]) -> Self {
        let (mut bits664, mut rgba) = ([0; PALETTE_SLOTS], [0; PALETTE_SLOTS]);
        for (index, colour) in colours.iter().enumerate() {
            let colour = Colour::new(*colour);
            (bits664[index + 1], rgba[index + 1]) = (colour.bits664, colour.rgba);
        }
        Self { end: colours.len() as i16 + 1, bits664, rgba }
    }

    /// True where all eight indices are within.
    #[inline(always)]
    fn has(&self, indices: i16x8) -> bool {
        let within = indices.simd_gt(i16x8::ZERO) & i16x8::splat(self.end).simd_gt(indices);
        within.to_bitmask() == 0xff
    }
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

    #[inline(always)]
    fn put(&mut self, at: usize, Colour { bits664, rgba }: Colour) {
        self.bits664[at] = bits664;
        if self.wants_rgba {
            self.rgba[at] = rgba;
        }
    }

    /// Paints a tile; `None` where a colour is not in the palette.
    pub fn paint(&mut self, tile: &Tile, header: &PacketHeader, palette: &Palette) -> Option<()> {
        let (width, height) = (tile.pattern.width(), tile.pattern.height());
        match header.mode {
            ColourMode::None => {
                for at in (0..TILE * TILE).step_by(8) {
                    self.put8(at, GREEN.map(i16x8::splat));
                }
            }
            ColourMode::Palette => {
                for y in 0..height {
                    self.paint_row(tile.index.row(y), y, width, palette)?;
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
                        let rgb = to_rgb(y4, co, cg).map(|channel| channel.to_array()[0] as u8);
                        self.put(y * TILE + x, Colour::new(rgb));
                    }
                }
            }
        }
        Some(())
    }

    /// Pixels beyond the width get any colour.
    #[inline(always)]
    fn paint_row(&mut self, indices: &[i16; TILE], y: usize, width: usize, palette: &Palette) -> Option<()> {
        let within = |at: usize| palette.has(i16x8::from(*indices[at..][..8].first_chunk().expect("eight")));
        let all = match width {
            TILE => within(0) && within(8),
            _ => indices[..width].iter().all(|index| (1..palette.end).contains(index)),
        };
        if !all {
            return None;
        }
        let at = indices.map(|index| index as usize % PALETTE_SLOTS);
        let row = y * TILE..(y + 1) * TILE;
        for (own, index) in self.bits664[row.clone()].iter_mut().zip(at) {
            *own = palette.bits664[index];
        }
        if self.wants_rgba {
            for (own, index) in self.rgba[row].iter_mut().zip(at) {
                *own = palette.rgba[index];
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
