//! Orders in which a point lies near the one before it.

use crate::quantise::GridPoint;

/// How the points are put into order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// As they came where that is an order already (sensors give scan order), else whichever of the two others costs less.
    Auto,
    /// As they came.
    AsGiven,
    /// In rings: about the axis along which the cloud is flattest, each point after its neighbour of the same elevation.
    Sweep,
    /// Along a Morton curve.
    Morton,
}

const PAIRS: usize = 2048;

/// True where points that came one after the other are much nearer than any two are.
pub fn is_ordered(points: &[GridPoint]) -> bool {
    if points.len() < 2 {
        return true;
    }
    let bits = |a: &GridPoint, b: &GridPoint| -> u64 {
        let pairs = a.at.iter().zip(b.at);
        pairs.map(|(a, b)| u64::from(32 - (a - b).unsigned_abs().leading_zeros())).sum()
    };
    let stride = (points.len() - 1).div_ceil(PAIRS);
    let (mut following, mut any, mut random) = (0, 0, 1_u64);
    for i in (1..points.len()).step_by(stride) {
        following += bits(&points[i - 1], &points[i]);
        // Knuth's MMIX generator: any two points.
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        any += bits(&points[(random >> 33) as usize % points.len()], &points[i]);
    }
    following * 10 <= any * 6
}

/// Least and greatest coordinates.
pub fn bounds(points: &[GridPoint]) -> [[i32; 3]; 2] {
    let mut least = [i32::MAX; 3];
    let mut greatest = [i32::MIN; 3];
    for point in points {
        for ((least, greatest), at) in least.iter_mut().zip(&mut greatest).zip(point.at) {
            *least = at.min(*least);
            *greatest = at.max(*greatest);
        }
    }
    [least, greatest]
}

/// Sorts and their memory.
#[derive(Default)]
pub struct Sorter {
    keys: Vec<(u64, u32)>,
    other: Vec<(u64, u32)>,
    next: Vec<u32>,
    heads: Vec<u32>,
}

struct Chain {
    slope: f32,
    angle: u64,
    tail: u32,
}

const NONE: u32 = u32::MAX;
/// A chain that has found no point within this part of a turn (in 2⁻¹⁶) has ended.
const REACH: u64 = 320;
/// An elevation over distance that differs by more is another ring's.
const TOLERANCE: f32 = 0.003;
const MAX_CHAINS: usize = 192;

impl Sorter {
    /// Writes indices along a Morton curve.
    pub fn morton(&mut self, points: &[GridPoint], order: &mut Vec<u32>) {
        let [least, greatest] = bounds(points);
        let extent = (0..3).map(|axis| greatest[axis].saturating_sub(least[axis])).max().unwrap_or(0);
        self.keys.clear();
        self.keys.extend(points.iter().enumerate().map(|(i, point)| {
            let spread = |axis: usize| spread_bits((point.at[axis] - least[axis]) as u64);
            (spread(0) | spread(1) << 1 | spread(2) << 2, i as u32)
        }));
        self.sort(3 * (32 - extent.leading_zeros()));
        order.clear();
        order.extend(self.keys.iter().map(|(_, index)| index));
    }

    /// Writes indices ring by ring.
    pub fn sweep(&mut self, points: &[GridPoint], order: &mut Vec<u32>) {
        let [least, greatest] = bounds(points);
        let flat = (0..3).min_by_key(|axis| greatest[*axis].saturating_sub(least[*axis])).unwrap_or(2);
        let (u, v) = ((flat + 1) % 3, (flat + 2) % 3);
        self.keys.clear();
        self.keys.extend(
            points
                .iter()
                .enumerate()
                .map(|(i, point)| (angle(point.at[u] as f32, point.at[v] as f32), i as u32)),
        );
        self.sort(16);
        self.next.clear();
        self.next.resize(points.len(), NONE);
        self.heads.clear();
        let mut chains: Vec<Chain> = Vec::with_capacity(MAX_CHAINS);
        let mut cleared = 0;
        for (angle, index) in &self.keys {
            let at = points[*index as usize].at.map(|coordinate| coordinate as f32);
            let slope = at[flat] / at[u].hypot(at[v]).max(1.0);
            if *angle >= cleared + REACH / 4 || chains.len() == MAX_CHAINS {
                cleared = *angle;
                chains.retain(|chain| angle - chain.angle <= REACH);
                if chains.len() == MAX_CHAINS {
                    chains.remove(0);
                }
            }
            let mut best = (TOLERANCE, NONE as usize);
            for (i, chain) in chains.iter().enumerate() {
                let difference = (chain.slope - slope).abs();
                if difference < best.0 {
                    best = (difference, i);
                }
            }
            if let Some(chain) = chains.get_mut(best.1) {
                self.next[chain.tail as usize] = *index;
                *chain = Chain { slope, angle: *angle, tail: *index };
            } else {
                self.heads.push(*index);
                chains.push(Chain { slope, angle: *angle, tail: *index });
            }
        }
        order.clear();
        for head in &self.heads {
            let mut index = *head;
            while index != NONE {
                order.push(index);
                index = self.next[index as usize];
            }
        }
    }

    /// Sorts the keys by their lowest `bits` bits: radix, 11 bits a pass.
    fn sort(&mut self, bits: u32) {
        self.other.resize(self.keys.len(), (0, 0));
        for shift in (0..bits).step_by(11) {
            let digit = |key: u64| (key >> shift & 0x7ff) as usize;
            let mut ends = [0_u32; 2048];
            for (key, _) in &self.keys {
                ends[digit(*key)] += 1;
            }
            let mut sum = 0;
            for end in &mut ends {
                sum += *end;
                *end = sum - *end;
            }
            for entry in &self.keys {
                let place = &mut ends[digit(entry.0)];
                self.other[*place as usize] = *entry;
                *place += 1;
            }
            std::mem::swap(&mut self.keys, &mut self.other);
        }
    }
}

/// Bit i of 21 bits to bit 3·i.
const fn spread_bits(value: u64) -> u64 {
    let mut spread = value & 0x1f_ffff;
    spread = (spread | spread << 32) & 0x001f_0000_0000_ffff;
    spread = (spread | spread << 16) & 0x001f_0000_ff00_00ff;
    spread = (spread | spread << 8) & 0x100f_00f0_0f00_f00f;
    spread = (spread | spread << 4) & 0x10c3_0c30_c30c_30c3;
    (spread | spread << 2) & 0x1249_2492_4924_9249
}

/// 0…65535 around the circle, growing with the angle though not evenly; no trigonometry.
fn angle(u: f32, v: f32) -> u64 {
    let part = v / (u.abs() + v.abs()).max(1.0);
    let turn = if u >= 0.0 { part } else { 2.0 - part };
    ((turn + 1.0) * 16_383.75) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud() -> Vec<GridPoint> {
        let mut random = 7_u64;
        let mut next = || {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (random >> 40) as i32 % 600 - 300
        };
        (0..5000).map(|_| GridPoint { at: [next(), next(), next() / 100], attribute: 0 }).collect()
    }

    #[test]
    fn every_order_names_every_point_once() {
        let points = cloud();
        let (mut sorter, mut order) = (Sorter::default(), Vec::new());
        for sort in [Sorter::morton, Sorter::sweep] {
            sort(&mut sorter, &points, &mut order);
            let mut seen = order.clone();
            seen.sort_unstable();
            assert!(seen.iter().copied().eq(0..points.len() as u32));
        }
    }

    #[test]
    fn a_morton_order_is_an_order_and_random_points_are_not() {
        let points = cloud();
        let (mut sorter, mut order) = (Sorter::default(), Vec::new());
        assert!(!is_ordered(&points));
        sorter.morton(&points, &mut order);
        let sorted: Vec<GridPoint> = order.iter().map(|index| points[*index as usize]).collect();
        assert!(is_ordered(&sorted));
    }
}
