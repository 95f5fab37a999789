//! The points with the k smallest keys, exactly, in their own order.
//!
//! A point's key is an Exp(1) variate times its cost. A variate −ln(1 − t) is never below its t, so t times the cost tells
//! most points that their key is too large, without a logarithm; the others are *candidates*. Keys are positive floats,
//! whose bits order as integers, and the upper bits make a logarithmic histogram: one bucket holds the k-th smallest key,
//! and only its keys need be looked at closely.

use bytemuck::{Pod, must_cast, must_cast_ref};
use wide::{f32x4, u8x16, u32x4};

use crate::exponential::{UNIFORM_SCALE, exponential};

/// A limit that every point is below.
pub(crate) const NO_LIMIT: f32 = f32::MAX;

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

/// Candidates in ascending order of their indices.
pub(crate) struct Candidates {
    uniforms: Vec<f32>,
    costs: Vec<f32>,
    indices: Vec<u32>,
    keys: Vec<u32>,
    len: usize,
    histogram: Box<[u32; BUCKETS]>,
    scratch: Vec<u32>,
}

impl Candidates {
    pub fn new() -> Self {
        Self {
            uniforms: Vec::new(),
            costs: Vec::new(),
            indices: Vec::new(),
            keys: Vec::new(),
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
            self.uniforms.resize(len, 0.0);
            self.costs.resize(len, 0.0);
            self.indices.resize(len, 0);
            self.keys.resize(len, 0);
        }
    }

    pub fn len(&self) -> usize {
        self.len
    }

    /// Starts anew with those points whose key may be at most `limit`: all whose key is, and some more.
    ///
    /// `quads` gives four points at a time: uniform numbers, costs (NaN for a point that cannot be chosen) and the first
    /// point's index.
    #[inline(always)]
    pub fn collect(&mut self, limit: f32, quads: impl Iterator<Item = (f32x4, f32x4, u32)>) {
        let limit = f32x4::splat(limit * UNIFORM_SCALE);
        let mut len = 0;
        for (uniforms, costs, first) in quads {
            let set = (uniforms * costs).simd_le(limit).to_bitmask();
            put(&mut self.uniforms, len, to_front(uniforms, set));
            put(&mut self.costs, len, to_front(costs, set));
            put(&mut self.indices, len, to_front(u32x4::splat(first) + u32x4::from([0, 1, 2, 3]), set));
            len += set.count_ones() as usize;
        }
        self.len = len;
        let whole = len.next_multiple_of(4);
        let uniforms = self.uniforms[..whole].as_chunks::<4>().0;
        let costs = self.costs[..whole].as_chunks::<4>().0;
        let keys = self.keys[..whole].as_chunks_mut::<4>().0;
        for ((uniforms, costs), keys) in uniforms.iter().zip(costs).zip(keys) {
            let key = exponential(f32x4::from(*uniforms)) * f32x4::from(*costs);
            *keys = must_cast(key);
        }
        // What the last four are more than `len` never counts.
        self.keys[len..whole].fill(u32::MAX);
    }

    /// The k-th smallest key (k from 1) of the candidates, as its bits.
    pub fn threshold(&mut self, k: usize) -> u32 {
        let keys = &self.keys[..self.len];
        self.histogram.fill(0);
        for key in keys {
            // The mask says to the compiler what is so anyway: a key has no sign bit.
            self.histogram[(key >> SHIFT) as usize & (BUCKETS - 1)] += 1;
        }
        let mut below = 0;
        let mut bucket = 0;
        while below + (self.histogram[bucket] as usize) < k {
            below += self.histogram[bucket] as usize;
            bucket += 1;
        }
        self.scratch.clear();
        self.scratch.extend(keys.iter().filter(|key| (*key >> SHIFT) as usize == bucket));
        *self.scratch.select_nth_unstable(k - 1 - below).1
    }

    /// Writes the indices of the `k` candidates with the smallest keys to `chosen`, ascending; of equal keys the earlier
    /// come first. `threshold` is that of `k`, and `chosen` has room for all candidates and four more.
    pub fn smallest(&self, k: usize, threshold: u32, chosen: &mut [u32]) {
        let limit = u32x4::splat(threshold);
        let mut count = 0;
        let whole = self.len.next_multiple_of(4);
        let keys = self.keys[..whole].as_chunks::<4>().0;
        let indices = self.indices[..whole].as_chunks::<4>().0;
        for (keys, indices) in keys.iter().zip(indices) {
            let set = u32x4::from(*keys).simd_le(limit).to_bitmask();
            put(chosen, count, to_front(u32x4::from(*indices), set));
            count += set.count_ones() as usize;
        }
        // Several keys may equal the k-th smallest: the last of them go.
        let mut surplus = count - k;
        let mut place = count;
        for key in self.keys[..self.len].iter().rev() {
            if surplus == 0 {
                break;
            }
            if *key <= threshold {
                place -= 1;
            }
            if *key == threshold {
                chosen.copy_within(place + 1..count, place);
                surplus -= 1;
            }
        }
    }
}

#[inline(always)]
fn to_front<V: Pod>(values: V, set: u32) -> V {
    let bytes: u8x16 = must_cast(values);
    must_cast(bytes.shuffle(u8x16::new(TO_FRONT[set as usize & 15])))
}

#[inline(always)]
fn put<V: Pod, T: Pod>(into: &mut [T], at: usize, values: V) {
    into[at..at + 4].copy_from_slice(must_cast_ref::<V, [T; 4]>(&values));
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Costs of 1, so that the keys order as the uniform numbers do.
    fn smallest(uniforms: &[u32], k: usize, limit: f32) -> Option<Vec<u32>> {
        let mut candidates = Candidates::new();
        let quads = uniforms.len().div_ceil(4);
        candidates.reserve(quads);
        let points = uniforms.chunks(4).enumerate().map(|(i, four)| {
            let mut values = [0.0; 4];
            let mut costs = [f32::NAN; 4];
            for (lane, uniform) in four.iter().enumerate() {
                values[lane] = *uniform as f32;
                costs[lane] = 1.0;
            }
            (f32x4::from(values), f32x4::from(costs), (i * 4) as u32)
        });
        candidates.collect(limit, points);
        if candidates.len() < k {
            return None;
        }
        let mut chosen = vec![0; quads * 4 + 4];
        let threshold = candidates.threshold(k);
        candidates.smallest(k, threshold, &mut chosen);
        chosen.truncate(k);
        Some(chosen)
    }

    fn by_sorting(uniforms: &[u32], k: usize) -> Vec<u32> {
        let mut order: Vec<u32> = (0..uniforms.len() as u32).collect();
        order.sort_by_key(|i| (uniforms[*i as usize], *i));
        order.truncate(k);
        order.sort_unstable();
        order
    }

    proptest! {
        #[test]
        fn equals_sorting(
            uniforms in prop::collection::hash_set(1_u32..32_000, 1..200),
            k in any::<prop::sample::Index>(),
        ) {
            // Steps of 2^16 are far enough apart for the logarithm to keep them in order.
            let uniforms: Vec<u32> = uniforms.into_iter().map(|u| u << 16).collect();
            let k = k.index(uniforms.len()) + 1;
            prop_assert_eq!(smallest(&uniforms, k, NO_LIMIT), Some(by_sorting(&uniforms, k)));
        }

        #[test]
        fn equals_sorting_with_many_ties(
            uniforms in prop::collection::vec(1_u32..5, 1..60),
            k in any::<prop::sample::Index>(),
        ) {
            let uniforms: Vec<u32> = uniforms.into_iter().map(|u| u << 28).collect();
            let k = k.index(uniforms.len()) + 1;
            prop_assert_eq!(smallest(&uniforms, k, NO_LIMIT), Some(by_sorting(&uniforms, k)));
        }
    }

    #[test]
    fn a_limit_leaves_out_only_what_is_above_it() {
        let uniforms: Vec<u32> = (1..1000).map(|i| i << 21).collect();
        // The key of uniform u is −ln(1 − u / 2³¹): 0.5 is passed after 0.39 of the range.
        assert_eq!(smallest(&uniforms, 300, 0.5), Some((0..300).collect()));
        assert_eq!(smallest(&uniforms, 900, 0.5), None);
    }
}
