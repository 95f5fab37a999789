//! From bytes to the numbers of planes: all four states side by side.

use bytemuck::must_cast;
use wide::{i16x8, i32x4};

use super::body::RawReader;
use super::{LOW, PROBABILITY_BITS, STATES, TOTAL, WORDS, code_escape};
use crate::contexts::CERTAIN;
use crate::lanes::{LANES, expand, interleave, narrow, select};
use crate::tables::{SHARE_MASK, SHARE_START, SHARE_SYMBOL, SLOTS, Share};

/// A step of a wavefront: eight numbers, one a lane, that do not depend on one another.
#[derive(Clone, Copy)]
pub struct Step {
    /// Of the lanes that hold a pixel, all bits; else none.
    pub valid: i16x8,
    /// What each is coded with.
    pub contexts: i16x8,
    /// All bits where 1, 2 and 3 low bits of the number are not modelled (where 3 are, in all of them).
    pub shifted: [i16x8; 3],
}

/// Decodes planes from where a [`super::Decoder`] stands. As that, it is small, and loops work on a copy.
#[derive(Clone, Copy)]
pub struct PlaneDecoder<'a> {
    states: i32x4,
    words: &'a [u16; WORDS + 4],
    at: usize,
    raw: RawReader<'a>,
    slots: &'a [Share; SLOTS],
}

impl<'a> PlaneDecoder<'a> {
    #[inline(always)]
    pub(super) fn new(
        states: [u32; STATES],
        words: &'a [u16; WORDS + 4],
        at: usize,
        raw: RawReader<'a>,
        slots: &'a [Share; SLOTS],
    ) -> Self {
        Self { states: must_cast(states), words, at, raw, slots }
    }

    /// The states, and where the next word and the next raw bit stand.
    #[inline(always)]
    pub(super) fn place(&self) -> ([u32; STATES], usize, RawReader<'a>) {
        (must_cast(self.states), self.at, self.raw)
    }

    /// A step of each of some packets, numbers of 16 bits, lane k by state k mod 4. `halves`: which halves of the lanes hold a
    /// pixel. The packets take turns: none waits for its own symbols as long as there are others'.
    #[inline(always)]
    pub fn step<const N: usize>(
        decoders: &mut [Self; N],
        steps: &[Step; N],
        halves: [bool; LANES / STATES],
    ) -> [i16x8; N] {
        let contexts = steps.each_ref().map(|step| {
            let contexts = select(step.valid, step.contexts, i16x8::splat(CERTAIN as i16));
            interleave(contexts, i16x8::ZERO)
        });
        let mut shares = [[i32x4::ZERO; 2]; N];
        for half in 0..LANES / STATES {
            if halves[half] {
                for n in 0..N {
                    shares[n][half] = decoders[n].take(must_cast(contexts[n][half]));
                }
            }
        }
        core::array::from_fn(|n| {
            let [low, high] = shares[n].map(|shares| shares >> SHARE_SYMBOL);
            decoders[n].extend(&steps[n], narrow(low, high))
        })
    }

    /// A symbol off each state.
    #[inline(always)]
    fn take(&mut self, contexts: i32x4) -> i32x4 {
        let x = self.states;
        let slots = x & i32x4::splat(i32::from(TOTAL - 1));
        let places: [u32; STATES] = must_cast((contexts << PROBABILITY_BITS) | slots);
        let shares: i32x4 = must_cast(places.map(|place| self.slots[place as usize % SLOTS]));
        let mask = i32x4::splat(SHARE_MASK as i32);
        let x: i32x4 = (shares & mask) * (x >> PROBABILITY_BITS) + (slots - ((shares >> SHARE_START) & mask));
        let short = i32x4::splat(LOW as i32).simd_gt(x);
        let lanes = short.to_bitmask() as u8;
        let words: &[u16; 4] = self.words[self.at % WORDS..][..4].first_chunk().expect("four words");
        self.states = (short & ((x << 16) | expand(*words, lanes))) | (!short & x);
        self.at += lanes.count_ones() as usize;
        shares
    }

    /// Numbers of symbols that may not say all.
    #[inline(always)]
    fn extend(&mut self, step: &Step, symbols: i16x8) -> i16x8 {
        let [one, two, three] = step.shifted;
        let more = ((one | symbols.simd_gt(i16x8::splat(12))) & step.valid).to_bitmask();
        if more == 0 {
            return symbols;
        }
        let (numbers, raw) = extend(self.raw, more, symbols, -(one + two + three));
        self.raw = raw;
        numbers
    }
}

/// Numbers of the lanes whose symbol says not all, and the reader behind their raw bits.
#[inline(never)]
fn extend<'a>(
    mut raw: RawReader<'a>,
    mut lanes: u32,
    symbols: i16x8,
    shifts: i16x8,
) -> (i16x8, RawReader<'a>) {
    let mut numbers = symbols.to_array();
    let shifts = shifts.to_array();
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize % LANES;
        lanes &= lanes - 1;
        let (symbol, shift) = (numbers[lane] as u32, shifts[lane] as u32);
        let high = if symbol > 12 { code_escape(|bits, _| raw.take(bits), symbol, 0) } else { symbol };
        numbers[lane] = (high << shift | raw.take(shift)) as i16;
    }
    (numbers.into(), raw)
}
