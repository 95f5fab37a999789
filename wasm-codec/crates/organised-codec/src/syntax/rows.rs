//! Planes whose numbers are known: what the front finds pixel after pixel, found row by row.

use wide::i16x8;

use super::plane::{PlaneTask, bins, contexts, fold, predict, predict_one};
use crate::contexts::FIRST_ROW_BIN;
use crate::lanes::{LANES, follow, precede, row_mask};
use crate::rans::{NO_TOKEN, TileTokens, token};
use crate::tile::{Plane, TILE};

/// See [`super::TileCoder::plane`].
#[inline(always)]
pub fn code(coder: &mut TileTokens, plane: &mut Plane, task: &PlaneTask) -> i16x8 {
    fill(plane, task);
    let activity = note(plane, task);
    coder.push_front(plane, task.width, task.height, task.base);
    activity
}

/// What stands to the left of a row's first pixel.
#[inline(always)]
fn beside(plane: &Plane, task: &PlaneTask, y: usize) -> i16 {
    match &task.left {
        Some(left) => left[y % TILE],
        None if y == 0 => task.anchor,
        None => plane.row(y - 1)[0],
    }
}

/// Gives pixels that are not valid what is predicted for them.
#[inline(always)]
fn fill(plane: &mut Plane, task: &PlaneTask) {
    let all = (1_u32 << task.width) - 1;
    for y in 0..task.height {
        let mut missing = !u32::from(task.rows[y]) & all;
        if missing != 0 {
            let left = beside(plane, task, y);
            let (above, above_left) = if y > 0 {
                (*plane.row(y - 1), beside(plane, task, y - 1))
            } else {
                // So that the prediction is the left one.
                ([left; TILE], left)
            };
            let row = plane.row_mut(y);
            while missing != 0 {
                // As long as one follows the other, each is the next one's left.
                let mut x = missing.trailing_zeros() as usize % TILE;
                let (mut l, mut d) = if x > 0 { (row[x - 1], above[x - 1]) } else { (left, above_left) };
                while missing >> x & 1 == 1 {
                    let a = above[x % TILE];
                    l = predict_one(l, a, d);
                    row[x % TILE] = l;
                    d = a;
                    missing &= missing - 1;
                    x += 1;
                }
            }
        }
        if task.width < TILE {
            // To the right of the last pixel stands itself.
            let row = plane.row_mut(y);
            row[task.width] = row[task.width - 1];
        }
    }
}

/// Notes every pixel's token and number.
#[inline(always)]
fn note(plane: &mut Plane, task: &PlaneTask) -> i16x8 {
    let mut activity = task.activity.to_array();
    let base = i16x8::splat(task.base as i16);
    // Of the row above: its pixels, and what stood to the left of each.
    let mut above = [i16x8::ZERO; 2];
    let mut above_left = [i16x8::ZERO; 2];
    for y in 0..task.height {
        let left = i16x8::splat(beside(plane, task, y));
        let row = plane.row(y);
        let own = [0, LANES].map(|x| i16x8::from(*row[x..][..LANES].first_chunk::<LANES>().expect("eight")));
        let to_left = [follow(left, own[0]), follow(own[0], own[1])];
        let valid = task.rows[y];
        if valid == 0 {
            plane.tokens_mut(y).fill(NO_TOKEN);
            (above, above_left) = (own, to_left);
            continue;
        }
        let last = i16x8::splat(above[1].to_array()[LANES - 1]);
        let above_right = [precede(above[0], above[1]), precede(above[1], last)];
        let lane = y % LANES;
        let predicted: [i16x8; 2] = core::array::from_fn(|i| {
            if y == 0 { to_left[i] } else { predict(to_left[i], above[i], above_left[i]) }
        });
        let residuals: [i16x8; 2] = core::array::from_fn(|i| own[i] - predicted[i]);
        let mut sizes = residuals.map(|residual: i16x8| residual.abs());
        if valid != u16::MAX {
            sizes = carried(sizes, valid, activity[lane]);
        }
        let before = [follow(i16x8::splat(activity[lane]), sizes[0]), follow(sizes[0], sizes[1])];
        activity[lane] = sizes[1].to_array()[LANES - 1];
        for half in 0..2 {
            let (bin, shifted) = if y == 0 {
                (i16x8::splat(FIRST_ROW_BIN), [i16x8::ZERO; 3])
            } else {
                bins(to_left[half], above[half], above_left[half], above_right[half])
            };
            let numbers = fold(residuals[half]);
            let missing = !row_mask(valid, half);
            let tokens = token(contexts(base, bin, before[half]), numbers, shifted, lane) | missing;
            plane.tokens_mut(y)[half * LANES..][..LANES].copy_from_slice(tokens.as_array());
            plane.numbers_mut(y)[half * LANES..][..LANES].copy_from_slice(numbers.as_array());
        }
        (above, above_left) = (own, to_left);
    }
    for y in task.height..TILE {
        plane.tokens_mut(y).fill(NO_TOKEN);
    }
    activity.into()
}

/// Sizes where pixels that are not valid have that of the one to their left; left of the first one stands `before`.
#[inline(always)]
fn carried(sizes: [i16x8; 2], valid: u16, before: i16) -> [i16x8; 2] {
    let mut each: [i16; TILE] = bytemuck::must_cast(sizes);
    let mut missing = !valid;
    while missing != 0 {
        let x = missing.trailing_zeros() as usize % TILE;
        missing &= missing - 1;
        each[x] = if x > 0 { each[x - 1] } else { before };
    }
    bytemuck::must_cast(each)
}
