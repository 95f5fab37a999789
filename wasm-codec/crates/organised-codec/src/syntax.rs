//! The order of symbols in a packet and the contexts they are coded with: one walk for coding, decoding and counting.

use crate::contexts::{COEFFICIENT, DC, DEPTH, INDEX, KIND, LAST, LEAD, MASK, PATTERN, POINT};
use crate::rans::{Coder, Family};
use crate::tile::{Block, ColourMode, Kind, LAST_TRANSFORMED, Pattern, Plane, STRIDE, STRIP, TILE, Tile};

/// The largest quantised inverse depth.
pub const MAX_DEPTH: i32 = 65_535;
/// Levels of a mean lie within ±this.
pub const MAX_DC: i32 = 16_383;

/// What a block leaves to its neighbours.
#[derive(Clone, Copy)]
struct BlockEdge {
    dc: i32,
    count: i32,
}

/// `dc` of no block.
const NO_BLOCK: BlockEdge = BlockEdge { dc: i32::MIN, count: 0 };
/// Kind of no tile.
const NO_KIND: usize = 3;

/// A tile's outermost pixels, spread over 16.
type Side = [i32; TILE];

/// What a tile leaves to the one on its right or below.
#[derive(Clone, Copy)]
struct Edge {
    kind: usize,
    /// False where there is nothing to predict from.
    known: bool,
    depth: Side,
    index: Side,
    blocks: [[BlockEdge; 2]; 3],
}

const NO_EDGE: Edge =
    Edge { kind: NO_KIND, known: false, depth: [0; TILE], index: [0; TILE], blocks: [[NO_BLOCK; 2]; 3] };

/// What the tiles of a packet know of those before them.
#[derive(Clone)]
pub struct Neighbours {
    left: [Edge; STRIP],
    top: Edge,
    /// Depth and index of the pixel diagonally above, or −1.
    diagonal: [i32; 2],
    pattern: usize,
    point: [i32; 3],
}

impl Neighbours {
    /// At the beginning of a packet: nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self { left: [NO_EDGE; STRIP], top: NO_EDGE, diagonal: [-1; 2], pattern: 8, point: [0; 3] }
    }
}

impl Default for Neighbours {
    fn default() -> Self {
        Self::new()
    }
}

/// Codes a tile. `row` is its row in the strip, `first_column` true in the image's first column.
#[inline(always)]
pub fn code_tile<C: Coder>(
    coder: &mut C,
    tile: &mut Tile,
    near: &mut Neighbours,
    row: usize,
    first_column: bool,
    mode: ColourMode,
) {
    if row == 0 {
        near.top = NO_EDGE;
        near.diagonal = [-1; 2];
    }
    if first_column {
        near.left[row] = NO_EDGE;
    }
    let context = KIND + 4 * near.left[row].kind + near.top.kind;
    let kind = coder.symbol(Family::Geometry, context, tile.kind as u32);
    tile.kind = match kind {
        0 => Kind::Empty,
        1 => Kind::Full,
        _ => Kind::Mixed,
    };
    let diagonal = near.diagonal;
    let left = near.left[row];
    let top = near.top;
    near.diagonal = if left.known { [left.depth[TILE - 1], left.index[TILE - 1]] } else { [-1; 2] };
    if tile.kind == Kind::Empty {
        tile.rows = [0; TILE];
        let edge = Edge { kind: 0, ..NO_EDGE };
        near.left[row] = edge;
        near.top = edge;
        return;
    }
    let pattern = coder.symbol(Family::Geometry, PATTERN + near.pattern, u32::from(tile.pattern.0));
    tile.pattern = Pattern(pattern as u8 & 7);
    near.pattern = usize::from(tile.pattern.0);
    code_mask(coder, tile);
    let mut right = Edge { kind: tile.kind as usize, known: true, ..left };
    let mut bottom = Edge { kind: right.kind, known: true, ..top };
    let shape = Shape {
        width: tile.pattern.width(),
        height: tile.pattern.height(),
        rows: tile.rows,
        full: tile.kind == Kind::Full,
    };
    let (beside, above) = (left.known.then_some(left.depth), top.known.then_some(top.depth));
    (right.depth, bottom.depth) =
        code_plane::<C, false>(coder, &mut tile.depth, &shape, beside, above, diagonal[0]);
    if mode == ColourMode::Palette {
        let (beside, above) = (left.known.then_some(left.index), top.known.then_some(top.index));
        (right.index, bottom.index) =
            code_plane::<C, true>(coder, &mut tile.index, &shape, beside, above, diagonal[1]);
    }
    near.left[row] = right;
    near.top = bottom;
    match mode {
        ColourMode::None | ColourMode::Palette => {}
        _ if tile.pattern <= LAST_TRANSFORMED => code_blocks(coder, tile, near, row, mode),
        _ => code_points(coder, tile, near, row),
    }
}

fn code_mask<C: Coder>(coder: &mut C, tile: &mut Tile) {
    let (width, height) = (tile.pattern.width(), tile.pattern.height());
    let all = ((1u32 << width) - 1) as u16;
    if tile.kind == Kind::Full {
        tile.rows = [0; TILE];
        tile.rows[..height].fill(all);
        return;
    }
    if C::DECODES {
        tile.rows = [0; TILE];
    }
    let mut above = u32::from(all);
    for row in &mut tile.rows[..height] {
        let mut coded = 0;
        let mut left = above & 1;
        for at in (0..width).step_by(4) {
            let upper = above >> at & 15;
            // The last group sees its own last pixel in place of the one beyond.
            let beyond = above >> (at + 4).min(width - 1) & 1;
            let context = MASK + (4 * upper + 2 * left + beyond) as usize;
            let group = coder.symbol(Family::Geometry, context, u32::from(*row) >> at & 15);
            coded |= group << at;
            left = group >> 3;
        }
        coded &= u32::from(all);
        *row = coded as u16;
        above = coded;
    }
}

/// Median of the left pixel, the upper one, and the plane through them and the diagonal one (LOCO-I).
#[inline(always)]
fn median(left: i32, top: i32, diagonal: i32) -> i32 {
    let (low, high) = (left.min(top), left.max(top));
    (left + top - diagonal).max(low).min(high)
}

/// Bins of the gradient, and how many low bits of a residual are not modelled in each.
const GRADIENT_SHIFT: [u32; 10] = [0, 0, 0, 0, 0, 0, 0, 1, 2, 3];

#[inline(always)]
fn gradient_bin(gradient: i32) -> usize {
    const BINS: [u8; 64] = {
        let mut bins = [0; 64];
        let mut i = 0;
        while i < 64 {
            bins[i] = match i {
                0 => 0,
                1 => 1,
                2 => 2,
                3..=4 => 3,
                5..=7 => 4,
                8..=12 => 5,
                13..=22 => 6,
                23..=45 => 7,
                _ => 8,
            };
            i += 1;
        }
        bins
    };
    if gradient < 64 { usize::from(BINS[gradient as usize]) } else { 8 + usize::from(gradient > 130) }
}

#[inline(always)]
fn residual_bin(zigzag: u32) -> usize {
    usize::from(zigzag > 0) + usize::from(zigzag > 2) + usize::from(zigzag > 8)
}

#[inline(always)]
fn zigzag(value: i32) -> u32 {
    (value << 1 ^ value >> 31) as u32
}

#[inline(always)]
fn unzigzag(value: u32) -> i32 {
    (value >> 1) as i32 ^ -((value & 1) as i32)
}

/// A number up to 2¹⁷: 13 direct symbols, then three with 3, 6 or 17 further bits (9 for palette
/// indices); `shift` low bits are not modelled.
#[inline(always)]
fn code_number<C: Coder>(coder: &mut C, family: Family, context: usize, shift: u32, value: u32) -> u32 {
    let high = value >> shift;
    let token = if high < 13 {
        high
    } else if high < 21 {
        13
    } else if high < 85 {
        14
    } else {
        15
    };
    let token = coder.symbol(family, context, token);
    let high = if token < 13 {
        token
    } else {
        code_large(coder, token, high, context >= INDEX && family == Family::Colour)
    };
    high << shift | coder.raw(shift, value & ((1 << shift) - 1))
}

/// The same where it is known, and only where it is `coded`.
#[inline(always)]
fn code_number_if<C: Coder>(
    coder: &mut C,
    family: Family,
    context: usize,
    shift: u32,
    value: u32,
    coded: bool,
) {
    let high = value >> shift;
    let token = high.min(13) + u32::from(high >= 21) + u32::from(high >= 85);
    coder.symbol_if(family, context, token, coded);
    if coded && (shift > 0 || high >= 13) {
        if high >= 13 {
            code_large(coder, token, high, context >= INDEX && family == Family::Colour);
        }
        coder.raw(shift, value & ((1 << shift) - 1));
    }
}

#[cold]
#[inline(never)]
fn code_large<C: Coder>(coder: &mut C, token: u32, high: u32, index: bool) -> u32 {
    match token {
        13 => 13 + coder.raw(3, high.wrapping_sub(13) & 7),
        14 => 21 + coder.raw(6, high.wrapping_sub(21) & 63),
        _ => {
            let rest = high.wrapping_sub(85) & 0x1ffff;
            let low = coder.raw(9, rest & 511);
            if index {
                return 85 + low;
            }
            85 + (coder.raw(8, rest >> 9) << 9 | low)
        }
    }
}

/// What a plane's coding needs to know of its tile.
struct Shape {
    width: usize,
    height: usize,
    rows: [u16; TILE],
    full: bool,
}

/// Codes a tile's depth, or its palette indices, and returns its right and lower sides.
fn code_plane<C: Coder, const INDICES: bool>(
    coder: &mut C,
    plane: &mut Plane,
    shape: &Shape,
    left: Option<Side>,
    top: Option<Side>,
    diagonal: i32,
) -> (Side, Side) {
    let (width, height) = (shape.width, shape.height);
    if let Some(left) = left {
        for y in 0..height {
            plane[(y + 1) * STRIDE] = left[y * TILE / height];
        }
    }
    if let Some(top) = top {
        for x in 0..width {
            plane[x + 1] = top[x * TILE / width];
        }
        plane[width + 1] = plane[width];
        plane[0] = if left.is_some() && diagonal > 0 { diagonal } else { plane[1] };
    } else {
        let start = left.map_or_else(|| code_anchor(coder, plane, shape), |left| left[0]);
        plane[..STRIDE].fill(start);
    }
    // Most tiles keep all their pixels: for those the compiler knows the width.
    let code = match (shape.full, width) {
        (true, TILE) => code_rows::<C, INDICES, true, TILE>,
        (true, _) => code_rows::<C, INDICES, true, 0>,
        (false, _) => code_rows::<C, INDICES, false, 0>,
    };
    code(coder, plane, shape, left.is_some(), top.is_some());
    let right = core::array::from_fn(|i| plane[Tile::at(width - 1, i * height / TILE)]);
    let bottom = core::array::from_fn(|i| plane[Tile::at(i * width / TILE, height - 1)]);
    (right, bottom)
}

/// The first valid pixel's value where there is no neighbour to predict it from.
fn code_anchor<C: Coder>(coder: &mut C, plane: &Plane, shape: &Shape) -> i32 {
    let mut value = 1;
    if !C::DECODES
        && let Some(y) = shape.rows.iter().position(|row| *row != 0)
    {
        value = plane[Tile::at(shape.rows[y].trailing_zeros() as usize, y)] as u32;
    }
    let low = coder.raw(8, value & 255);
    ((coder.raw(8, value >> 8) << 8 | low) as i32).max(1)
}

fn code_rows<C: Coder, const INDICES: bool, const FULL: bool, const WIDTH: usize>(
    coder: &mut C,
    plane: &mut Plane,
    shape: &Shape,
    left_known: bool,
    top_known: bool,
) {
    let (family, base) = if INDICES { (Family::Colour, INDEX) } else { (Family::Geometry, DEPTH) };
    let width = if WIDTH > 0 { WIDTH } else { shape.width.min(TILE) };
    let mut before = 0;
    for y in 0..shape.height {
        let valid = shape.rows[y];
        let (upper, lower) = plane.split_at_mut((y + 1) * STRIDE);
        let upper: &[i32; STRIDE] = upper[y * STRIDE..].first_chunk().expect("a row above");
        let current: &mut [i32; STRIDE] = lower.first_chunk_mut().expect("a row");
        if !left_known {
            current[0] = upper[1];
        }
        let mut left = current[0];
        let mut diagonal = upper[0];
        let first = y == 0 && !top_known;
        for x in 0..width {
            let top = upper[x + 1];
            let predicted = if first { left } else { median(left, top, diagonal) };
            let coded = FULL || valid >> x & 1 == 1;
            let (context, shift) = if first {
                (base + 40 + residual_bin(before), 0)
            } else {
                let gradient = (left - diagonal).abs() + (top - diagonal).abs() + (upper[x + 2] - top).abs();
                let bin = gradient_bin(gradient);
                (base + 4 * bin + residual_bin(before), GRADIENT_SHIFT[bin])
            };
            let value = if C::DECODES {
                if coded {
                    before = code_number(coder, family, context, shift, 0);
                    (predicted + unzigzag(before)).clamp(1, MAX_DEPTH)
                } else {
                    predicted
                }
            } else {
                let residual = zigzag(current[x + 1] - predicted);
                code_number_if(coder, family, context, shift, residual, coded);
                before = if coded { residual } else { before };
                if coded { current[x + 1] } else { predicted }
            };
            current[x + 1] = value;
            diagonal = top;
            left = value;
        }
        // What the next row sees to the right of its last pixel.
        current[width + 1] = left;
    }
}

fn code_blocks<C: Coder>(
    coder: &mut C,
    tile: &mut Tile,
    near: &mut Neighbours,
    row: usize,
    mode: ColourMode,
) {
    let mut index = 0;
    let luma = mode.blocks(tile.pattern, 0);
    for plane in 0..3 {
        let (columns, rows) = mode.blocks(tile.pattern, plane);
        let class = usize::from(plane > 0);
        let mut top = near.top.blocks[plane];
        let left_edge = near.left[row].blocks[plane];
        let mut right = left_edge;
        for y in 0..rows {
            let mut left = left_edge[y];
            for (x, top) in top.iter_mut().enumerate().take(columns) {
                let seen = (columns, rows) != luma || tile.block_is_seen(x, y);
                let edge = if seen {
                    code_block(coder, &mut tile.blocks[index], class, left, *top)
                } else if left.dc != i32::MIN {
                    left
                } else {
                    *top
                };
                left = edge;
                *top = edge;
                index += 1;
            }
            right[y] = left;
        }
        if columns == 1 {
            top[1] = top[0];
        }
        if rows == 1 {
            right[1] = right[0];
        }
        near.top.blocks[plane] = top;
        near.left[row].blocks[plane] = right;
    }
}

/// Bands of the zigzag position of an AC coefficient.
const BANDS: [u8; 63] = {
    let mut bands = [7; 63];
    let mut i = 0;
    while i < 63 {
        bands[i] = match i {
            0..=1 => 0,
            2..=4 => 1,
            5..=8 => 2,
            9..=13 => 3,
            14..=19 => 4,
            20..=26 => 5,
            27..=40 => 6,
            _ => 7,
        };
        i += 1;
    }
    bands
};

fn code_block<C: Coder>(
    coder: &mut C,
    block: &mut Block,
    class: usize,
    left: BlockEdge,
    top: BlockEdge,
) -> BlockEdge {
    let (predicted, neighbours, counts) = match (left.dc != i32::MIN, top.dc != i32::MIN) {
        (true, true) => ((left.dc + top.dc) >> 1, 2, left.count + top.count),
        (true, false) => (left.dc, 1, 2 * left.count),
        (false, true) => (top.dc, 1, 2 * top.count),
        (false, false) => (0, 0, -1),
    };
    let residual = zigzag(block.dc - predicted);
    let residual = code_number(coder, Family::Colour, DC + 3 * class + neighbours, 0, residual);
    block.dc = (predicted + unzigzag(residual)).clamp(-MAX_DC, MAX_DC);

    let bin = match counts {
        ..0 => 5,
        0 => 0,
        1..=4 => 1,
        5..=12 => 2,
        13..=28 => 3,
        29.. => 4,
    };
    block.count = code_count(coder, LAST + 6 * class + bin, block.count as u32) as usize;
    let mut sum = 0;
    let mut before = 0;
    for i in (0..block.count).rev() {
        let band = usize::from(BANDS[i]);
        let level = i32::from(block.levels[i]);
        let mut magnitude = level.unsigned_abs();
        if i + 1 == block.count {
            magnitude = 1 + code_magnitude(coder, LEAD + 8 * class + band, magnitude.wrapping_sub(1) & 0xfff);
        } else {
            let bin = match sum {
                0..=2 => sum,
                3..=4 => 3,
                _ => 4,
            };
            magnitude = code_magnitude(coder, COEFFICIENT + 40 * class + 5 * band + bin as usize, magnitude);
        }
        let mut negative = 0;
        if magnitude > 0 {
            negative = coder.raw(1, u32::from(level < 0));
        }
        block.levels[i] = if negative == 1 { -(magnitude as i32) } else { magnitude as i32 } as i16;
        sum = before + magnitude;
        before = magnitude;
    }
    BlockEdge { dc: block.dc, count: block.count as i32 }
}

/// 0 to 63 in 16 symbols: 8 direct, then pairs of 1, 2, 3 and 4 further bits.
#[inline(always)]
fn code_count<C: Coder>(coder: &mut C, context: usize, count: u32) -> u32 {
    let token = if count < 8 {
        count
    } else {
        // 8-9, 10-11, 12-15, 16-19, 20-27, 28-35, 36-51, 52-63.
        let octave = 31 - (count - 4).leading_zeros();
        8 + 2 * (octave - 2) + ((count - 4) >> (octave - 1) & 1)
    };
    let token = coder.symbol(Family::Colour, context, token);
    if token < 8 {
        return token;
    }
    let bits = (token - 6) / 2;
    let start = ((2 + (token & 1)) << bits) + 4;
    let rest = coder.raw(bits, count.wrapping_sub(start) & ((1 << bits) - 1));
    (start + rest).min(63)
}

#[inline(always)]
fn code_magnitude<C: Coder>(coder: &mut C, context: usize, magnitude: u32) -> u32 {
    let token = coder.symbol(Family::Colour, context, magnitude.min(15));
    if token < 15 { token } else { code_large_magnitude(coder, magnitude) }
}

#[cold]
#[inline(never)]
fn code_large_magnitude<C: Coder>(coder: &mut C, magnitude: u32) -> u32 {
    let rest = magnitude.wrapping_sub(15) & 0xfff;
    let bits = coder.raw(4, 32 - rest.leading_zeros()).min(12);
    15 + coder.raw(bits, rest)
}

fn code_points<C: Coder>(coder: &mut C, tile: &mut Tile, near: &mut Neighbours, row: usize) {
    let count = tile.valid().min(tile.points.len());
    let mut before = [0; 3];
    let mut last = near.point;
    for point in &mut tile.points[..count] {
        for plane in 0..3 {
            let context = POINT + 4 * plane + residual_bin(before[plane]);
            let residual = zigzag(point[plane] - last[plane]);
            let residual = code_number(coder, Family::Colour, context, 0, residual);
            before[plane] = residual;
            point[plane] = (last[plane] + unzigzag(residual)).clamp(-MAX_DC, MAX_DC);
        }
        last = *point;
    }
    near.point = last;
    near.top.blocks = [[NO_BLOCK; 2]; 3];
    near.left[row].blocks = [[NO_BLOCK; 2]; 3];
}
