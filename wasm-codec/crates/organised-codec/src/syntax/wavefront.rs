//! Planes decoded along a front on which each row is two pixels behind the one above it. So everything that a pixel's
//! prediction looks at (left, above, above left, above right) lies behind the front, and the eight pixels on it are
//! handled at once. One step waits for the one before: the planes of two packets are decoded in the time of 1.4.

use wide::i16x8;

use super::plane::{PlaneTask, Side, bins, contexts, predict};
use crate::contexts::FIRST_ROW_BIN;
use crate::lanes::{LANES, ONLY, rotate, select, transpose};
use crate::rans::{Decoder, PlaneDecoder, STATES, Step};
use crate::tile::{Plane, STEPS, TILE};

/// Decodes a plane of each packet, all of the same shape, and returns their lanes' activity: see
/// [`super::TileCoder::plane`].
#[inline(always)]
pub fn decode<const N: usize>(
    decoders: [&mut Decoder<'_>; N],
    planes: [&mut Plane; N],
    tasks: [&PlaneTask; N],
) -> [i16x8; N] {
    let left = tasks.map(|task| task.left.unwrap_or([task.anchor; TILE]));
    if tasks.iter().all(|task| task.left.is_some()) {
        front::<N, true>(decoders, planes, tasks, &left)
    } else {
        front::<N, false>(decoders, planes, tasks, &left)
    }
}

#[inline(never)]
fn front<const N: usize, const LEFT: bool>(
    decoders: [&mut Decoder<'_>; N],
    planes: [&mut Plane; N],
    tasks: [&PlaneTask; N],
    left: &[Side; N],
) -> [i16x8; N] {
    let mut own = decoders.each_ref().map(|decoder| decoder.plane_decoder());
    let activity = walk::<N, LEFT>(&mut own, planes, tasks, left);
    for (decoder, own) in decoders.into_iter().zip(&own) {
        decoder.resume(own);
    }
    activity
}

/// Each lane's pixel as a bit of its row.
static BITS: [i16x8; STEPS] = {
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

/// Of a plane, what a step leaves to the next.
#[derive(Clone, Copy)]
struct Front {
    /// The pixels.
    values: i16x8,
    /// What stood above them, and above to the right.
    top: i16x8,
    right: i16x8,
    /// What was to the left at the rows' beginnings.
    begun: i16x8,
    /// The lanes' rows: which pixels are valid.
    rows: i16x8,
    /// Sizes of the last residuals.
    activity: i16x8,
}

#[inline(always)]
fn walk<const N: usize, const LEFT: bool>(
    decoders: &mut [PlaneDecoder<'_>; N],
    planes: [&mut Plane; N],
    tasks: [&PlaneTask; N],
    left: &[Side; N],
) -> [i16x8; N] {
    let PlaneTask { width, height, base, .. } = *tasks[0];
    // Rows 8 to 15 follow rows 0 to 7.
    let last_row = height - 1;
    let steps = 2 * (last_row % LANES) + 2 * LANES * (last_row / LANES) + width;
    // The steps at which each half of the lanes holds pixels.
    let begins: [usize; LANES / STATES] =
        core::array::from_fn(|half| if STATES * half < height { 2 * STATES * half } else { STEPS });
    let ends: [usize; LANES / STATES] = core::array::from_fn(|half| {
        2 * (last_row % LANES).min(STATES * half + STATES - 1) + 2 * LANES * (last_row / LANES) + width
    });
    let end = i16x8::splat((1_u16 << (width - 1)) as i16);
    let base = i16x8::splat(base as i16);
    let mut fronts: [Front; N] = core::array::from_fn(|n| {
        let first = i16x8::splat(left[n][0]);
        Front {
            values: i16x8::ZERO,
            top: i16x8::ZERO,
            right: first & ONLY[0],
            begun: first & ONLY[LANES - 1],
            rows: i16x8::ZERO,
            activity: tasks[n].activity,
        }
    });
    for (t, bits) in BITS.iter().enumerate().take(steps) {
        let first = t < TILE;
        let looks: [(i16x8, Step); N] = core::array::from_fn(|n| {
            let own = &mut fronts[n];
            let (mut l, mut d) = (own.values, own.top);
            own.top = own.right;
            own.right = rotate(own.values);
            if t % 2 == 0 && t < 2 * TILE {
                // A row begins.
                let y = t / 2;
                let lane = ONLY[y % LANES];
                own.rows = select(lane, i16x8::splat(tasks[n].rows[y] as i16), own.rows);
                if LEFT {
                    let corner = left[n][y.saturating_sub(1)];
                    l = select(lane, i16x8::splat(left[n][y]), l);
                    d = select(lane, i16x8::splat(corner), d);
                } else {
                    l = select(lane, own.top, l);
                    d = select(lane, rotate(own.begun), d);
                    own.begun = l;
                }
            }
            let (mut a, mut r) = (own.top, select(bits.simd_eq(end), own.top, own.right));
            if first {
                // Nothing above the first row: all as the left one.
                a = select(ONLY[0], l, a);
                d = select(ONLY[0], l, d);
                r = select(ONLY[0], l, r);
            }
            let valid = !(own.rows & *bits).simd_eq(i16x8::ZERO);
            let (mut bin, shifted) = bins(l, a, d, r);
            if first {
                bin = select(ONLY[0], i16x8::splat(FIRST_ROW_BIN), bin);
            }
            (predict(l, a, d), Step { valid, contexts: contexts(base, bin, own.activity), shifted })
        });
        let halves = core::array::from_fn(|half| (begins[half]..ends[half]).contains(&t));
        let numbers = PlaneDecoder::step(decoders, &looks.map(|(_, step)| step), halves);
        for n in 0..N {
            let ((predicted, Step { valid, .. }), numbers) = (looks[n], numbers[n]);
            let residual: i16x8 = ((numbers >> 1) & i16x8::MAX) ^ -(numbers & i16x8::ONE);
            let residual = residual & valid;
            let sum: i16x8 = predicted + residual;
            let own = &mut fronts[n];
            own.values = sum.max(i16x8::ONE);
            own.activity = select(valid, residual.abs(), own.activity);
            planes[n].columns[t] = own.values;
        }
    }
    for Plane { lines, columns, .. } in planes {
        for block in 0..STEPS / LANES {
            let eight: [i16x8; LANES] =
                *columns[block * LANES..][..LANES].first_chunk::<LANES>().expect("eight columns");
            for (line, row) in lines.iter_mut().zip(transpose(eight)) {
                line[block * LANES..][..LANES].copy_from_slice(row.as_array());
            }
        }
    }
    fronts.map(|front| front.activity)
}
