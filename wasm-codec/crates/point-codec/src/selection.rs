//! The k smallest of many keys, exactly, in their own order.
//!
//! Keys are the bits of positive floats: as integers they order as the floats do, and their upper bits make a
//! logarithmic histogram. One bucket holds the k-th smallest key; only its keys need be looked at closely.

use bytemuck::{must_cast, must_cast_ref};
use wide::{u8x16, u32x4};

/// The bits of infinity: above every key.
pub(crate) const NEVER: u32 = 0x7f80_0000;

/// Exponent and four bits of mantissa: 16 buckets an octave.
const SHIFT: u32 = 19;
const BUCKETS: usize = 1 << (31 - SHIFT);

/// For each set of lanes, the bytes that bring those lanes to the front.
const TO_FRONT: [[u8; 16]; 16] = {
    let mut table = [[0; 16]; 16];
    let mut set = 0;
    while set < 16 {
        let (mut lane, mut to) = (0, 0);
        while lane < 4 {
            if set >> lane & 1 == 1 {
                let mut byte = 0;
                while byte < 4 {
                    table[set][to * 4 + byte] = (lane * 4 + byte) as u8;
                    byte += 1;
                }
                to += 1;
            }
            lane += 1;
        }
        set += 1;
    }
    table
};

/// Keys with the indices they belong to, in ascending order of the indices.
pub(crate) struct Candidates {
    keys: Vec<u32>,
    indices: Vec<u32>,
    len: usize,
    histogram: Box<[u32; BUCKETS]>,
    scratch: Vec<u32>,
}

impl Candidates {
    pub fn new() -> Self {
        Self {
            keys: Vec::new(),
            indices: Vec::new(),
            len: 0,
            histogram: Box::new([0; BUCKETS]),
            scratch: Vec::new(),
        }
    }

    /// Makes room for `quads` times four candidates.
    pub fn reserve(&mut self, quads: usize) {
        // Four are written at a time, whether or not all of them count.
        let len = quads * 4 + 4;
        if self.keys.len() < len {
            self.keys.resize(len, 0);
            self.indices.resize(len, 0);
        }
    }

    pub fn clear(&mut self) {
        self.len = 0;
    }

    pub fn len(&self) -> usize {
        self.len
    }

    /// Adds those of the four keys that are not above `limit`; `first` is the index of the first.
    #[inline(always)]
    pub fn add(&mut self, keys: u32x4, limit: u32x4, first: u32) {
        let set = mask_of(keys.simd_le(limit));
        let indices = u32x4::splat(first) + u32x4::from([0, 1, 2, 3]);
        put(&mut self.keys, self.len, to_front(keys, set));
        put(&mut self.indices, self.len, to_front(indices, set));
        self.len += set.count_ones() as usize;
    }

    /// The k-th smallest key (k from 1) of those added.
    pub fn threshold(&mut self, k: usize) -> u32 {
        let keys = &self.keys[..self.len];
        self.histogram.fill(0);
        for key in keys {
            // The mask says to the compiler what is so anyway: a key has no sign bit.
            self.histogram[(key >> SHIFT) as usize & (BUCKETS - 1)] += 1;
        }
        let mut below = 0;
        let mut bucket = 0;
        while below + self.histogram[bucket] as usize <= k - 1 {
            below += self.histogram[bucket] as usize;
            bucket += 1;
        }
        self.scratch.clear();
        self.scratch.extend(keys.iter().filter(|key| (*key >> SHIFT) as usize == bucket));
        *self.scratch.select_nth_unstable(k - 1 - below).1
    }

    /// Writes the indices of the `k` ≥ 1 smallest keys to `chosen`, ascending; of equal keys the earlier come first. There
    /// must be as many candidates, and room in `chosen` for all candidates and three more.
    pub fn smallest(&mut self, k: usize, chosen: &mut [u32]) {
        let threshold = self.threshold(k);
        let limit = u32x4::splat(threshold);
        // The last four may be partly left over from before: keys that never count go there.
        put(&mut self.keys, self.len, u32x4::splat(NEVER));
        let mut count = 0;
        let quads = self.len.div_ceil(4);
        let keys = &self.keys.as_chunks::<4>().0[..quads];
        let indices = &self.indices.as_chunks::<4>().0[..quads];
        for (keys, indices) in keys.iter().zip(indices) {
            let set = mask_of(u32x4::from(*keys).simd_le(limit));
            put(chosen, count, to_front(u32x4::from(*indices), set));
            count += set.count_ones() as usize;
        }
        // Several keys may equal the k-th smallest: the last of them go.
        let mut surplus = count - k;
        let mut at = self.len;
        let mut place = count;
        while surplus > 0 {
            at -= 1;
            if self.keys[at] <= threshold {
                place -= 1;
                if self.keys[at] == threshold {
                    chosen.copy_within(place + 1..count, place);
                    surplus -= 1;
                }
            }
        }
    }
}

#[inline(always)]
fn mask_of(lanes: u32x4) -> u32 {
    lanes.to_bitmask() & 15
}

#[inline(always)]
fn to_front(values: u32x4, set: u32) -> u32x4 {
    let bytes: u8x16 = must_cast(values);
    must_cast(bytes.shuffle(u8x16::new(TO_FRONT[set as usize])))
}

#[inline(always)]
fn put(into: &mut [u32], at: usize, values: u32x4) {
    into[at..at + 4].copy_from_slice(must_cast_ref::<u32x4, [u32; 4]>(&values));
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn smallest(keys: &[u32], k: usize) -> Vec<u32> {
        let mut candidates = Candidates::new();
        let quads = keys.len().div_ceil(4);
        candidates.reserve(quads);
        for (i, four) in keys.chunks(4).enumerate() {
            let mut quad = [NEVER; 4];
            quad[..four.len()].copy_from_slice(four);
            candidates.add(u32x4::from(quad), u32x4::splat(NEVER - 1), (i * 4) as u32);
        }
        let mut chosen = vec![0; quads * 4 + 4];
        candidates.smallest(k, &mut chosen);
        chosen.truncate(k);
        chosen
    }

    fn by_sorting(keys: &[u32], k: usize) -> Vec<u32> {
        let mut order: Vec<u32> = (0..keys.len() as u32).collect();
        order.sort_by_key(|i| (keys[*i as usize], *i));
        order.truncate(k);
        order.sort_unstable();
        order
    }

    proptest! {
        #[test]
        fn equals_sorting(keys in prop::collection::vec(0..NEVER, 1..200), k in any::<prop::sample::Index>()) {
            let k = k.index(keys.len()) + 1;
            prop_assert_eq!(smallest(&keys, k), by_sorting(&keys, k));
        }

        #[test]
        fn equals_sorting_with_many_ties(keys in prop::collection::vec(1_000_000_u32..1_000_004, 1..60), k in any::<prop::sample::Index>()) {
            let k = k.index(keys.len()) + 1;
            prop_assert_eq!(smallest(&keys, k), by_sorting(&keys, k));
        }
    }
}
