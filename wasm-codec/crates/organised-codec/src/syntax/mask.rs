//! Which pixels of a tile are valid.

use bytemuck::must_cast;
use wide::i16x8;

use crate::contexts::{MASK, SYMBOLS};
use crate::lanes::{LANES, follow};
use crate::rans::Coder;
use crate::tile::TILE;

/// Pixels of a group.
const GROUP: usize = 4;

/// Groups of a row one after another, each row two groups behind the one above: so what a group looks at has been coded
/// by then, and two groups at a time do not depend on each other.
#[inline(always)]
pub fn walk<C: Coder>(coder: &mut C, rows: &mut [u16; TILE], width: usize, height: usize) {
    let groups = width.div_ceil(GROUP);
    let own = *rows;
    *rows = [0; TILE];
    for t in 0..2 * height + groups.saturating_sub(2) {
        let (y, group) = (t / 2, t % 2);
        if y < height && group < groups {
            code_group(coder, &own, rows, width, y % TILE, group);
        }
        if y > 0 && y <= height && group + 2 < groups {
            code_group(coder, &own, rows, width, (y - 1) % TILE, group + 2);
        }
    }
}

/// Codes a group of a row; `rows` is what has been coded.
#[inline(always)]
fn code_group<C: Coder>(
    coder: &mut C,
    own: &[u16; TILE],
    rows: &mut [u16; TILE],
    width: usize,
    y: usize,
    group: usize,
) {
    let all = (1_u32 << width) - 1;
    let at = GROUP * group;
    let above = if y == 0 { all } else { u32::from(rows[y - 1]) };
    let left = if group == 0 { above & 1 } else { u32::from(rows[y]) >> (at - 1) & 1 };
    // The last group sees its own last pixel in place of the one beyond.
    let beyond = above >> (at + GROUP).min(width - 1) & 1;
    let context = MASK + (4 * (above >> at & 15) + 2 * left + beyond) as usize;
    let coded = coder.symbol(context, u32::from(own[y]) >> at & 15) << at & all;
    rows[y] |= coded as u16;
}

/// For each group of 16 rows of 16 pixels the tokens of all rows: the contexts and symbols of [`walk`].
#[inline(always)]
pub fn tokens(rows: &[u16; TILE]) -> [[i16x8; 2]; TILE / GROUP] {
    let own: [i16x8; 2] = must_cast(*rows);
    let above = [follow(i16x8::splat(-1), own[0]), follow(own[0], own[1])];
    core::array::from_fn(|group| {
        let at = (GROUP * group) as u32;
        core::array::from_fn(|half| {
            let (own, above) = (own[half], above[half]);
            let bit = |of: i16x8, at: u32| (of >> at) & i16x8::ONE;
            let four = |of: i16x8| (of >> at) & i16x8::splat(15);
            let left = if group == 0 { bit(above, 0) } else { bit(own, at - 1) };
            let beyond = bit(above, (at + GROUP as u32).min(TILE as u32 - 1));
            let context = (four(above) << 2) + (left << 1) + beyond;
            four(own) + (context << SYMBOLS.ilog2()) + i16x8::splat((MASK * SYMBOLS) as i16)
        })
    })
}

const _: () = assert!(TILE == 2 * LANES);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rans::TileTokens;

    #[test]
    fn all_tokens_at_once_are_those_of_the_walk() {
        let mut seed = 1_u32;
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 16) as u16
        };
        for before in 0..4 {
            for _ in 0..50 {
                let rows: [u16; TILE] = core::array::from_fn(|_| random() | random());
                let [mut walked, mut pushed] = [TileTokens::new(), TileTokens::new()];
                for tokens in [&mut walked, &mut pushed] {
                    tokens.clear();
                    tokens.first_turn();
                    for _ in 0..before {
                        tokens.symbol(0, 0);
                    }
                }
                let mut coded = rows;
                walk(&mut walked, &mut coded, TILE, TILE);
                assert_eq!(coded, rows);
                pushed.push_mask(tokens(&rows));
                assert_eq!(walked.tokens(), pushed.tokens());
            }
        }
    }
}
