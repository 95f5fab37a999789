//! The indices of the k smallest of many keys, exactly, in their own order.
//!
//! Keys are the bits of positive floats: as integers they order as the floats do, and their upper bits make a
//! logarithmic histogram. One bucket holds the k-th smallest key; only its keys need be looked at closely.

use wide::u32x4;

/// Exponent and four bits of mantissa: 16 buckets an octave.
const SHIFT: u32 = 19;
const BUCKETS: usize = 1 << (31 - SHIFT);
/// The bits of infinity: the key of what must not be chosen.
pub(crate) const NEVER: u32 = 0x7f80_0000;

/// A histogram of keys, filled while they are made.
pub(crate) struct Histogram {
    counts: Box<[u32; BUCKETS]>,
}

impl Histogram {
    pub fn new() -> Self {
        Self { counts: Box::new([0; BUCKETS]) }
    }

    pub fn clear(&mut self) {
        self.counts.fill(0);
    }

    #[inline(always)]
    pub fn add(&mut self, keys: u32x4) {
        for key in (keys >> SHIFT).to_array() {
            // The mask says to the compiler what is so anyway: a key has no sign bit.
            self.counts[key as usize & (BUCKETS - 1)] += 1;
        }
    }

    /// The bucket of the k-th smallest key (k from 1), and how many keys lie in lower ones.
    fn bucket_of(&self, k: usize) -> (u32, usize) {
        let mut below = 0;
        for (bucket, count) in self.counts.iter().enumerate() {
            let count = *count as usize;
            if below + count >= k {
                return (bucket as u32, below);
            }
            below += count;
        }
        unreachable!("fewer than {k} keys were counted")
    }
}

/// Writes the indices of the `k` smallest keys to `chosen`, ascending; of equal keys the earlier come first. `histogram`
/// has counted all of `keys`, of which at least `k` ≥ 1 are below [`NEVER`].
///
/// `chosen` has room for one index a key; `candidates` is scratch.
pub(crate) fn smallest(keys: &[u32x4], k: usize, histogram: &Histogram, candidates: &mut Vec<u32>, chosen: &mut [u32]) {
    let (bucket, below) = histogram.bucket_of(k);
    let rank = k - below;
    // The bucket's keys have all their bits from SHIFT up in common.
    let lower = u32x4::splat(bucket << SHIFT);
    candidates.clear();
    for keys in keys {
        // Wraps to a large number for keys in lower buckets.
        let offset = *keys - lower;
        let inside = offset.simd_lt(u32x4::splat(1 << SHIFT));
        if inside.any() {
            candidates.extend(keys.to_array().into_iter().filter(|key| key >> SHIFT == bucket));
        }
    }
    let threshold = *candidates.select_nth_unstable(rank - 1).1;
    let limit = u32x4::splat(threshold);
    let mut count = 0;
    for (quad, keys) in keys.iter().enumerate() {
        let mask = keys.simd_le(limit).to_bitmask();
        if mask == 0 {
            continue;
        }
        for lane in 0..4 {
            chosen[count] = (quad * 4) as u32 + lane;
            count += (mask >> lane & 1) as usize;
        }
    }
    drop_surplus_ties(keys, threshold, chosen, count, k);
}

/// Several keys may equal the k-th smallest: takes the last of them out until `k` are left.
fn drop_surplus_ties(keys: &[u32x4], threshold: u32, chosen: &mut [u32], count: usize, k: usize) {
    let mut surplus = count - k;
    let mut at = count;
    while surplus > 0 {
        at -= 1;
        let index = chosen[at] as usize;
        if keys[index / 4].to_array()[index % 4] == threshold {
            chosen.copy_within(at + 1..count, at);
            surplus -= 1;
        }
    }
}
