//! Depth, and palette indices: a plane of numbers, each predicted from its neighbours.
//!
//! Pixels are coded along a front on which each row is two pixels behind the one above it. So everything that a pixel's
//! prediction looks at (left, above, above left, above right) lies behind the front, and the eight pixels on it are
//! handled at once.

use wide::i16x8;

use crate::lanes::{LANES, ONLY, rotate, select, transpose};
use crate::rans::{Coder, Step};
use crate::tile::{Plane, STEPS, TILE};

/// A tile's outermost pixels, spread over 16.
pub type Side = [i16; TILE];

/// What a plane's coding needs to know of its tile.
pub struct Shape {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Which of them are valid.
    pub rows: [u16; TILE],
}

/// Codes a plane and returns its right side. `left` is that of the left tile where it is known, else `anchor` stands for what
/// lies around. `activity` holds, lane by lane, the size of the residual of the last valid pixel; it goes on from tile to
/// tile. `base` is the first of the plane's contexts.
#[inline(always)]
pub fn code_plane<C: Coder>(
    coder: &mut C,
    plane: &mut Plane,
    shape: &Shape,
    left: Option<&Side>,
    anchor: i16,
    activity: &mut i16x8,
    base: usize,
) -> Side {
    let (width, height) = (shape.width, shape.height);
    coder.first_turn();
    *activity = match left {
        Some(side) => {
            let side = core::array::from_fn(|y| side[y * TILE / height % TILE]);
            front::<C, true>(coder, plane, shape, &side, *activity, base)
        }
        None => front::<C, false>(coder, plane, shape, &[anchor; TILE], *activity, base),
    };
    core::array::from_fn(|i| plane.row(i * height / TILE)[width - 1])
}

/// Returns the lanes' activity.
#[inline(never)]
fn front<C: Coder, const LEFT: bool>(
    coder: &mut C,
    plane: &mut Plane,
    shape: &Shape,
    left: &Side,
    activity: i16x8,
    base: usize,
) -> i16x8 {
    coder.with_copy(|coder| walk::<C, LEFT>(coder, plane, shape, left, activity, base))
}

#[inline(always)]
fn walk<C: Coder, const LEFT: bool>(
    coder: &mut C,
    plane: &mut Plane,
    shape: &Shape,
    left: &Side,
    mut activity: i16x8,
    base: usize,
) -> i16x8 {
    let (width, height) = (shape.width, shape.height);
    // Rows 8 to 15 follow rows 0 to 7.
    let last_row = height - 1;
    let steps = 2 * (last_row % LANES) + 2 * LANES * (last_row / LANES) + width;
    // After this step the first four lanes are done.
    let low_end = 2 * (last_row % LANES).min(3) + 2 * LANES * (last_row / LANES) + width;
    let Plane { lines, columns } = plane;
    if !C::DECODES {
        for block in 0..STEPS / LANES {
            let rows = lines.each_ref().map(|line| {
                let eight: &[i16; LANES] = line[block * LANES..][..LANES].first_chunk().expect("eight");
                i16x8::from(*eight)
            });
            columns[block * LANES..][..LANES].copy_from_slice(&transpose(rows));
        }
    }
    let end = i16x8::splat((1_u16 << (width - 1)) as i16);
    let base = i16x8::splat(base as i16);
    // Of the step before: values, what stood above right, and what stood above.
    let mut values = i16x8::ZERO;
    let mut right = i16x8::splat(left[0]) & ONLY[0];
    let mut top = i16x8::ZERO;
    // What was to the left at the rows' beginnings.
    let mut begun = i16x8::splat(left[0]) & ONLY[LANES - 1];
    // Each lane's pixel as a bit of its row, and the row.
    let mut bits = i16x8::ZERO;
    let mut rows = i16x8::ZERO;
    for (t, column) in columns.iter_mut().enumerate().take(steps) {
        let (mut l, mut d) = (values, top);
        top = right;
        right = rotate(values);
        bits <<= 1;
        if t % 2 == 0 && t < 2 * TILE {
            // A row begins.
            let y = t / 2;
            let own = ONLY[y % LANES];
            bits |= own & i16x8::ONE;
            rows = select(own, i16x8::splat(shape.rows[y] as i16), rows);
            if LEFT {
                let corner = left[y.saturating_sub(1)];
                l = select(own, i16x8::splat(left[y]), l);
                d = select(own, i16x8::splat(corner), d);
            } else {
                l = select(own, top, l);
                d = select(own, rotate(begun), d);
                begun = l;
            }
        }
        let (mut a, mut r) = (top, select(bits.simd_eq(end), top, right));
        let first = t < TILE;
        if first {
            // Nothing above the first row: all as the left one.
            a = select(ONLY[0], l, a);
            d = select(ONLY[0], l, d);
            r = select(ONLY[0], l, r);
        }
        let valid = !(rows & bits).simd_eq(i16x8::ZERO);
        // Median of the left pixel, the upper one, and the plane through them and the diagonal one (LOCO-I).
        let predicted = l.saturating_add(a - d).max(l.min(a)).min(l.max(a));
        let gradient = (l - d).abs().saturating_add((a - d).abs()).saturating_add((r - a).abs());
        let over = |limit: i16| gradient.simd_gt(i16x8::splat(limit));
        let shifted = [over(22), over(45), over(130)];
        let mut bin = over(0) + over(1) + over(2) + over(4) + over(7) + over(12);
        bin = bin + shifted[0] + shifted[1] + shifted[2];
        if first {
            bin = select(ONLY[0], i16x8::splat(-10), bin);
        }
        let active = |limit: i16| activity.simd_gt(i16x8::splat(limit));
        let contexts = base - (bin << 2) - active(0) - active(1) - active(4);
        let difference = *column - predicted;
        let step = Step {
            valid,
            contexts,
            shifted,
            numbers: (difference << 1) ^ (difference >> 15),
            halves: [t < low_end, t >= LANES && height > LANES / 2],
        };
        let numbers = coder.step(&step);
        let residual =
            if C::DECODES { ((numbers >> 1) & i16x8::MAX) ^ -(numbers & i16x8::ONE) } else { difference };
        let residual = residual & valid;
        values = (predicted + residual).max(i16x8::ONE);
        activity = select(valid, residual.abs(), activity);
        *column = values;
    }
    for block in 0..STEPS / LANES {
        let eight: [i16x8; LANES] =
            *columns[block * LANES..][..LANES].first_chunk::<LANES>().expect("eight columns");
        for (line, row) in lines.iter_mut().zip(transpose(eight)) {
            line[block * LANES..][..LANES].copy_from_slice(row.as_array());
        }
    }
    activity
}
