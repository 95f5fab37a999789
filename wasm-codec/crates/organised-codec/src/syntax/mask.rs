//! Which pixels of a tile are valid.

use crate::contexts::MASK;
use crate::rans::Coder;
use crate::tile::{Kind, TILE, Tile};

/// Codes the mask of a mixed tile; a full one has none.
#[inline(never)]
pub fn code_mask<C: Coder>(coder: &mut C, tile: &mut Tile) {
    let (width, height) = (tile.pattern.width(), tile.pattern.height());
    let all = ((1u32 << width) - 1) as u16;
    if tile.kind == Kind::Full {
        tile.rows = [0; TILE];
        tile.rows[..height].fill(all);
        return;
    }
    coder.with_copy(|coder| walk(coder, &mut tile.rows, width, height));
}

/// Groups of a row one after another, each row two groups behind the one above: so what a group looks at has been coded
/// by then, and two groups at a time do not depend on each other.
#[inline(always)]
fn walk<C: Coder>(coder: &mut C, rows: &mut [u16; TILE], width: usize, height: usize) {
    let groups = width.div_ceil(4);
    let all = (1u32 << width) - 1;
    let own = *rows;
    // Of two rows: what has been coded of them.
    let mut code = |rows: &mut [u16; TILE], y: usize, group: usize| {
        let at = 4 * group;
        let above = if y == 0 { all } else { u32::from(rows[y - 1]) };
        let left = if group == 0 { above & 1 } else { u32::from(rows[y]) >> (at - 1) & 1 };
        // The last group sees its own last pixel in place of the one beyond.
        let beyond = above >> (at + 4).min(width - 1) & 1;
        let context = MASK + (4 * (above >> at & 15) + 2 * left + beyond) as usize;
        let coded = coder.symbol(context, u32::from(own[y]) >> at & 15) << at & all;
        rows[y] |= coded as u16;
    };
    *rows = [0; TILE];
    for t in 0..2 * height + groups.saturating_sub(2) {
        let (y, group) = (t / 2, t % 2);
        if y < height && group < groups {
            code(rows, y % TILE, group);
        }
        if y > 0 && y <= height && group + 2 < groups {
            code(rows, (y - 1) % TILE, group + 2);
        }
    }
}
