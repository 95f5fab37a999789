//! A tile's colours: blocks of coefficients, or single points.

use super::neighbours::{BlockEdge, NO_BLOCK, Neighbours};
use super::number::{code_number, fold, residual_bin, unfold};
use crate::contexts::{COEFFICIENT, DC, LAST, LEAD, POINT};
use crate::rans::{Coder, ESCAPES};
use crate::tile::{Block, ColourMode, MAX_BLOCKS, MAX_DC, Tile};

/// Levels lie within ±this.
const MAX_MAGNITUDE: u32 = 4095;

/// Codes the blocks of all planes.
#[inline(never)]
pub fn code_blocks<C: Coder>(
    coder: &mut C,
    tile: &mut Tile,
    near: &mut Neighbours,
    mode: ColourMode,
    last: bool,
) {
    coder.with_copy(|coder| walk(coder, tile, near, mode, last));
}

#[inline(always)]
fn walk<C: Coder>(coder: &mut C, tile: &mut Tile, near: &mut Neighbours, mode: ColourMode, last: bool) {
    let mut index = 0;
    // Blocks that are coded, and the first of two whose levels have not been.
    let mut coded = 0_u32;
    let mut waiting = None;
    let luma = mode.blocks(tile.pattern, 0);
    for plane in 0..3 {
        let (columns, rows) = mode.blocks(tile.pattern, plane);
        let class = usize::from(plane > 0);
        let mut top = [NO_BLOCK; 2];
        let left_edge = near.left.blocks[plane];
        let mut right = left_edge;
        for y in 0..rows {
            let mut left = left_edge[y];
            for (x, top) in top.iter_mut().enumerate().take(columns) {
                let seen = (columns, rows) != luma || tile.block_is_seen(x, y);
                let edge = if seen {
                    let before = near.last_dc[plane];
                    let edge = code_head(coder, &mut tile.blocks[index], class, left, *top, before);
                    near.last_dc[plane] = Some(edge.dc);
                    coded |= 1 << index;
                    match waiting.take() {
                        None => waiting = Some((index, class)),
                        Some(first) => code_two(coder, &mut tile.blocks, first, (index, class)),
                    }
                    edge
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
        if rows == 1 {
            right[1] = right[0];
        }
        near.left.blocks[plane] = right;
    }
    if let Some((index, class)) = waiting {
        let block = &mut tile.blocks[index];
        let mut run = Run::new(block, class);
        run.lead(coder, block);
        run.finish(coder, block);
    }
    coder.begin_signs(last);
    while coded != 0 {
        let index = coded.trailing_zeros() as usize;
        coded &= coded - 1;
        code_signs(coder, &mut tile.blocks[index % MAX_BLOCKS]);
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

/// A block's mean and the number of its other coefficients.
#[inline(always)]
fn code_head<C: Coder>(
    coder: &mut C,
    block: &mut Block,
    class: usize,
    left: BlockEdge,
    top: BlockEdge,
    before: Option<i32>,
) -> BlockEdge {
    let (predicted, neighbours, counts) = match (left.dc != i32::MIN, top.dc != i32::MIN) {
        (true, true) => ((left.dc + top.dc) >> 1, 2, left.count + top.count),
        (true, false) => (left.dc, 1, 2 * left.count),
        (false, true) => (top.dc, 1, 2 * top.count),
        // Better than nothing: the block coded before.
        (false, false) => (before.unwrap_or(0), usize::from(before.is_some()), -1),
    };
    let residual = fold(block.dc - predicted);
    let residual = code_number(coder, DC + 3 * class + neighbours, residual);
    block.dc = (predicted + unfold(residual)).clamp(-MAX_DC, MAX_DC);

    let bin = match counts {
        ..0 => 5,
        0 => 0,
        1..=4 => 1,
        5..=12 => 2,
        13..=28 => 3,
        29.. => 4,
    };
    block.count = code_count(coder, LAST + 6 * class + bin, block.count as u32) as usize;
    BlockEdge { dc: block.dc, count: block.count as i32 }
}

/// The levels of two blocks in turn, as long as both have some: neither waits for the other's symbols.
#[inline(always)]
fn code_two<C: Coder>(
    coder: &mut C,
    blocks: &mut [Block; MAX_BLOCKS],
    (first, first_class): (usize, usize),
    (second, second_class): (usize, usize),
) {
    let (before, rest) = blocks.split_at_mut(second % MAX_BLOCKS);
    let (one, two) = (&mut before[first], &mut rest[0]);
    let mut runs = [Run::new(one, first_class), Run::new(two, second_class)];
    runs[0].lead(coder, one);
    runs[1].lead(coder, two);
    while runs[0].left > 0 && runs[1].left > 0 {
        runs[0].next(coder, one);
        runs[1].next(coder, two);
    }
    runs[0].finish(coder, one);
    runs[1].finish(coder, two);
}

/// A block's levels from the last to the first: magnitudes alone.
struct Run {
    left: usize,
    class: usize,
    before: u32,
    /// Of the two before.
    sum: u32,
}

impl Run {
    #[inline(always)]
    fn new(block: &Block, class: usize) -> Self {
        Self { left: block.count.min(63), class, before: 0, sum: 0 }
    }

    #[inline(always)]
    fn lead<C: Coder>(&mut self, coder: &mut C, block: &mut Block) {
        if self.left == 0 {
            return;
        }
        self.left -= 1;
        let place = &mut block.levels[self.left];
        let known = u32::from(place.unsigned_abs()).wrapping_sub(1) & 0xfff;
        let band = usize::from(BANDS[self.left]);
        self.before = 1 + code_magnitude(coder, LEAD + 8 * self.class + band, known);
        self.sum = self.before;
        if C::DECODES {
            *place = self.before as i16;
        }
    }

    #[inline(always)]
    fn next<C: Coder>(&mut self, coder: &mut C, block: &mut Block) {
        const BINS: [u8; 8] = [0, 1, 2, 3, 3, 4, 4, 4];
        self.left -= 1;
        let place = &mut block.levels[self.left];
        let bin = usize::from(BINS[self.sum.min(7) as usize]);
        let context = COEFFICIENT + 40 * self.class + 5 * usize::from(BANDS[self.left]) + bin;
        let magnitude = code_magnitude(coder, context, place.unsigned_abs().into());
        self.sum = self.before + magnitude;
        self.before = magnitude;
        if C::DECODES {
            *place = magnitude as i16;
        }
    }

    #[inline(always)]
    fn finish<C: Coder>(&mut self, coder: &mut C, block: &mut Block) {
        while self.left > 0 {
            self.next(coder, block);
        }
    }
}

/// The signs of a block's levels that are not 0, from the last to the first.
#[inline(always)]
fn code_signs<C: Coder>(coder: &mut C, block: &mut Block) {
    let levels = &mut block.levels[..block.count.min(63)];
    let mut negative = 0_u64;
    let mut count = 0;
    for level in levels.iter().rev() {
        negative |= u64::from(*level < 0) << count;
        count += u32::from(*level != 0);
    }
    let mut signs = 0_u64;
    let mut at = 0;
    while at < count {
        let bits = (count - at).min(16);
        signs |= u64::from(coder.signs(bits, (negative >> at) as u32 & ((1 << bits) - 1))) << at;
        at += bits;
    }
    if !C::DECODES {
        return;
    }
    for level in levels.iter_mut().rev() {
        let some = i16::from(*level != 0);
        // All bits where the level is negative.
        let sign = -(signs as i16 & some);
        *level = (*level ^ sign) - sign;
        signs >>= some;
    }
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
    let token = coder.symbol(context, token);
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
    let token = coder.symbol(context, magnitude.min(15));
    if token < 15 {
        return token;
    }
    // As the last escape of a number.
    let [.., first] = ESCAPES;
    let rest = coder.escape(15, magnitude.wrapping_sub(15).wrapping_add(first)) - first;
    (15 + rest).min(MAX_MAGNITUDE)
}

/// Codes each valid pixel's colour by itself.
pub fn code_points<C: Coder>(coder: &mut C, tile: &mut Tile, near: &mut Neighbours) {
    let count = tile.valid().min(tile.points.len());
    let mut before = [0; 3];
    let mut last = near.point;
    for point in &mut tile.points[..count] {
        for plane in 0..3 {
            let context = POINT + 4 * plane + residual_bin(before[plane]);
            let residual = fold(point[plane] - last[plane]);
            let residual = code_number(coder, context, residual);
            before[plane] = residual;
            point[plane] = (last[plane] + unfold(residual)).clamp(-MAX_DC, MAX_DC);
        }
        last = *point;
    }
    near.point = last;
    near.left.blocks = [[NO_BLOCK; 2]; 3];
}
