//! Planes decoded along a front on which each row is two pixels behind the one above it. So everything that a pixel's
//! prediction looks at (left, above, above left, above right) lies behind the front, and the eight pixels on it are
//! handled at once.

use wide::i16x8;

use super::plane::{Around, Shape, Side, bins, contexts, predict};
use crate::contexts::FIRST_ROW_BIN;
use crate::lanes::{LANES, ONLY, rotate, select, transpose};
use crate::rans::{Coder, Decoder, Step};
use crate::tile::{Plane, STEPS, TILE};

/// See [`super::TileCoder::plane`].
#[inline(always)]
pub fn decode(
    decoder: &mut Decoder<'_>,
    plane: &mut Plane,
    shape: &Shape,
    around: &Around,
    base: usize,
) -> i16x8 {
    match &around.left {
        Some(left) => front::<true>(decoder, plane, shape, left, around.activity, base),
        None => front::<false>(decoder, plane, shape, &[around.anchor; TILE], around.activity, base),
    }
}

/// Returns the lanes' activity.
#[inline(never)]
fn front<const LEFT: bool>(
    decoder: &mut Decoder<'_>,
    plane: &mut Plane,
    shape: &Shape,
    left: &Side,
    activity: i16x8,
    base: usize,
) -> i16x8 {
    decoder.with_copy(|decoder| walk::<LEFT>(decoder, plane, shape, left, activity, base))
}

/// Each lane's pixel as a bit of its row.
const BITS: [i16x8; STEPS] = {
    let mut bits = [i16x8::ZERO; STEPS];
    let mut t = 0;
    while t < STEPS {
        let mut step = [0; LANES];
        let mut lane = 0;
        while lane < LANES && 2 * lane <= t {
            let x = t - 2 * lane;
            // Two rows one after the other.
            step[lane] = if x < 2 * TILE { (1_u16 << (x % TILE)) as i16 } else { 0 };
            lane += 1;
        }
        bits[t] = i16x8::new(step);
        t += 1;
    }
    bits
};

#[inline(always)]
fn walk<const LEFT: bool>(
    decoder: &mut Decoder<'_>,
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
    // The steps at which each pair of lanes holds pixels.
    let begins: [usize; LANES / 2] =
        core::array::from_fn(|pair| if 2 * pair < height { 4 * pair } else { STEPS });
    let ends: [usize; LANES / 2] = core::array::from_fn(|pair| {
        2 * (last_row % LANES).min(2 * pair + 1) + 2 * LANES * (last_row / LANES) + width
    });
    let Plane { lines, columns, .. } = plane;
    let end = i16x8::splat((1_u16 << (width - 1)) as i16);
    let base = i16x8::splat(base as i16);
    // Of the step before: values, what stood above right, and what stood above.
    let mut values = i16x8::ZERO;
    let mut right = i16x8::splat(left[0]) & ONLY[0];
    let mut top = i16x8::ZERO;
    // What was to the left at the rows' beginnings.
    let mut begun = i16x8::splat(left[0]) & ONLY[LANES - 1];
    let mut rows = i16x8::ZERO;
    for (t, (column, bits)) in columns.iter_mut().zip(BITS).enumerate().take(steps) {
        let (mut l, mut d) = (values, top);
        top = right;
        right = rotate(values);
        if t % 2 == 0 && t < 2 * TILE {
            // A row begins.
            let y = t / 2;
            let own = ONLY[y % LANES];
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
        let predicted = predict(l, a, d);
        let (mut bin, shifted) = bins(l, a, d, r);
        if first {
            bin = select(ONLY[0], i16x8::splat(FIRST_ROW_BIN), bin);
        }
        let contexts = contexts(base, bin, activity);
        let pairs = core::array::from_fn(|pair| (begins[pair]..ends[pair]).contains(&t));
        let numbers = decoder.step(&Step { valid, contexts, shifted, pairs });
        let residual: i16x8 = ((numbers >> 1) & i16x8::MAX) ^ -(numbers & i16x8::ONE);
        let residual = residual & valid;
        let sum: i16x8 = predicted + residual;
        values = sum.max(i16x8::ONE);
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
