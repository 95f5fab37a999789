//! Where a frame's bytes go: which tiles are coded finer, or thinned, by what tiles cost in the frame before and how this
//! one goes.
//!
//! It is decided row by row of tiles while the frame is coded. So a frame comes out at its budget though no tile costs what
//! it did a frame ago.

use crate::thinning::{dither, pattern};
use crate::tile::{Grid, Pattern};

/// Bits of a thinned tile by pattern, as a share of the full one's; the last one is not sent at all.
const SHARES: [f32; Pattern::COUNT as usize + 1] = [1.0, 0.61, 0.34, 0.3, 0.15, 0.095, 0.053, 0.036, 0.002];
/// Steps to an octave of depth and of validity.
const RESOLUTION: usize = 16;
/// Octaves of validity that are told apart.
const OCTAVES: usize = 48;
const BINS: usize = OCTAVES * RESOLUTION;
/// The smallest shift: everything at the full pattern, however far.
const LEAST_SHIFT: i32 = -((OCTAVES * RESOLUTION) as i32);
/// The largest: everything left out.
const MOST_SHIFT: i32 = ((Pattern::COUNT as usize + 1) * RESOLUTION) as i32;

/// A row's costs may differ from those expected by so much of the frame before the rest is held to be as dear.
const TRUST: f32 = 0.08;

/// What a frame's bits are spent on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Means {
    /// The nearer tiles finer: what finer and coarser cost as a share of what the plan's costs are counted in. With `split` so
    /// large a share of all tiles, the last ones: the lower rows, which mostly are nearer. What the frame costs grows with
    /// that, tile by tile, which it does not where finer and coarser tiles share packets.
    Mixed { finer: f32, coarser: f32, split: Option<f32> },
    /// Far tiles thinned.
    Thinned { share: f32 },
}

/// The plan of a frame, and what it learns.
#[derive(Default)]
pub(crate) struct Plan {
    /// Of each tile: mean depth, metres, 0 where nothing was seen.
    pub depths: Vec<f32>,
    /// −log2 of each tile's validity's share of the largest.
    pub halvings: Vec<f32>,
    /// What each tile is expected to cost in full, in bits of an imagined setting that all others are compared with.
    costs: Vec<f32>,
    known: bool,
    /// The share of each tile's setting in the frame before.
    shares: Vec<f32>,
    /// Of tiles whose setting is another than in the frame before, now the finer or the coarser one: what they were expected
    /// to cost, and what they did.
    changed: [(f32, f32); 2],
    means: Option<Means>,
    /// Bits for the frame.
    wanted: f32,
    /// Expected costs of the tiles to come, in bins by depth or by validity.
    ahead: Vec<f32>,
    left: f32,
    /// Expected bits of the rows coded, and of the last one.
    expected: f32,
    row_expected: f32,
    total: f32,
    row: usize,
    /// How many times as dear the frame is as expected, by the rows so far.
    pub dearer: f32,
    finer: Vec<bool>,
    /// Tiles that were coded finer, and tiles that were thinned or left out.
    pub finer_tiles: usize,
    pub thinned_tiles: usize,
}

impl Plan {
    /// True where the costs are those of a frame like the next one.
    pub fn is_known(&self) -> bool {
        self.known && self.costs.len() == self.halvings.len()
    }

    /// Every tile costs the same, `bits` together.
    pub fn guess(&mut self, bits: f32) {
        let tiles = self.halvings.len().max(1) as f32;
        self.costs.clear();
        self.costs.resize(self.halvings.len(), bits / tiles);
        self.known = true;
        self.shares.clear();
    }

    /// What the frame is expected to cost with nothing thinned.
    pub fn full(&self) -> f32 {
        self.costs.iter().sum()
    }

    /// Begins a frame of `wanted` bits.
    pub fn begin(&mut self, wanted: f32, means: Means) {
        (self.wanted, self.means) = (wanted, Some(means));
        (self.expected, self.row_expected, self.row) = (0.0, 0.0, 0);
        (self.finer_tiles, self.thinned_tiles) = (0, 0);
        self.changed = [(0.0, 0.0); 2];
        self.shares.resize(self.costs.len(), 0.0);
        self.left = self.full();
        self.ahead.clear();
        self.ahead.resize(BINS, 0.0);
        for tile in 0..self.costs.len() {
            let bin = self.bin(means, tile);
            self.ahead[bin] += self.costs[tile];
        }
        self.total = match means {
            Means::Mixed { .. } => wanted,
            Means::Thinned { share } => self.left * share,
        };
        self.finer.clear();
        self.finer.resize(self.costs.len(), false);
    }

    /// The patterns of a row of tiles, and which of them are finer; `spent` bits have been used so far.
    pub fn begin_row(&mut self, grid: Grid, row: usize, spent: f32, patterns: &mut [Pattern]) {
        let Some(means) = self.means else { return };
        if row < self.row {
            return;
        }
        self.row = row + 1;
        self.expected += self.row_expected;
        // What has been coded tells how dear the rest will be, the more of it there is.
        let prior = TRUST * self.total;
        self.dearer = (spent + prior) / (self.expected + prior).max(1.0);
        let bits = (self.wanted - spent) / self.dearer.max(1e-3);
        let row = row * grid.columns..(row + 1) * grid.columns;
        self.row_expected = 0.0;
        match means {
            Means::Mixed { finer, coarser, split: None } => {
                // Bins below the limit are finer.
                let limit = self.nearer_than((bits - self.left * coarser) / (finer - coarser).max(1e-3));
                for tile in row {
                    let own = self.take(means, tile) < limit;
                    self.finer[tile] = own;
                    self.finer_tiles += usize::from(own);
                    patterns[tile] = Pattern(0);
                }
            }
            Means::Mixed { split: Some(share), .. } => {
                let first = ((1.0 - share) * grid.tiles() as f32).round() as usize;
                for tile in row {
                    self.finer[tile] = tile >= first;
                    self.finer_tiles += usize::from(tile >= first);
                    patterns[tile] = Pattern(0);
                }
            }
            Means::Thinned { share } => {
                let shift = self.shift_for(bits / share);
                for tile in row {
                    self.take(means, tile);
                    let own = if shift == MOST_SHIFT {
                        Pattern::LEFT_OUT
                    } else {
                        pattern(tile, self.halvings[tile], shift as f32 / RESOLUTION as f32)
                    };
                    self.thinned_tiles += usize::from(own.0 > 0);
                    patterns[tile] = own;
                }
            }
        }
    }

    /// True where a packet that begins with this tile is to be coded finer.
    pub fn is_finer(&self, tile: usize) -> bool {
        self.finer.get(tile).copied().unwrap_or(false)
    }

    /// True where finer and coarser tiles share no packet.
    pub fn is_split(&self) -> bool {
        matches!(self.means, Some(Means::Mixed { split: Some(_), .. }))
    }

    /// Notes what a tile cost, bits.
    #[inline]
    pub fn note(&mut self, tile: usize, pattern: Pattern, finer: bool, bits: f32) {
        let share = match self.means {
            Some(Means::Mixed { finer: share, .. }) if finer => share,
            Some(Means::Mixed { coarser: share, .. } | Means::Thinned { share }) => share,
            None => return,
        };
        self.row_expected += self.costs[tile] * share * SHARES[usize::from(pattern.0)];
        if pattern == Pattern::LEFT_OUT {
            return;
        }
        if pattern.0 == 0 && self.shares[tile] != 0.0 && self.shares[tile] != share {
            let (expected, real) = &mut self.changed[usize::from(!finer)];
            *expected += self.costs[tile] * share;
            *real += bits;
        }
        self.shares[tile] = if pattern.0 == 0 { share } else { 0.0 };
        self.costs[tile] = bits / (share * SHARES[usize::from(pattern.0)]);
    }

    /// By how much finer and coarser settings are dearer beside the others than was thought, by the tiles that changed theirs;
    /// what is known of tiles is put right.
    pub fn learn_shares(&mut self) -> [f32; 2] {
        let Some(Means::Mixed { finer, coarser, .. }) = self.means else { return [1.0; 2] };
        let ratios = self.changed.map(|(expected, real)| match expected / self.wanted {
            // Too little to tell; enough to believe in part; enough.
            ..TRUST => 1.0,
            ..0.4 => (real / expected).sqrt().clamp(0.8, 1.25),
            _ => (real / expected).clamp(0.2, 5.0),
        });
        if finer == coarser || ratios == [1.0; 2] {
            return [1.0; 2];
        }
        for (share, cost) in self.shares.iter_mut().zip(&mut self.costs) {
            for (own, ratio) in [finer, coarser].into_iter().zip(ratios) {
                if *share == own {
                    *cost /= ratio;
                    *share *= ratio;
                    break;
                }
            }
        }
        ratios
    }

    /// The share of the tiles that were coded finer; `None` where some were thinned instead.
    pub fn finer_share(&self) -> Option<f32> {
        let thinned = matches!(self.means, Some(Means::Thinned { .. }));
        (!thinned).then(|| self.finer_tiles as f32 / self.costs.len().max(1) as f32)
    }

    /// Removes a tile from those to come; its bin.
    fn take(&mut self, means: Means, tile: usize) -> usize {
        let bin = self.bin(means, tile);
        self.ahead[bin] -= self.costs[tile];
        self.left -= self.costs[tile];
        bin
    }

    /// The nearest of the tiles to come cost no more than `costs` together: the bin after theirs.
    fn nearer_than(&self, mut costs: f32) -> usize {
        for (bin, mass) in self.ahead.iter().enumerate() {
            costs -= mass;
            // A bin that fits by more than half still goes.
            if costs < -0.5 * mass || (costs < 0.0 && *mass <= 0.0) {
                return bin;
            }
        }
        BINS
    }

    /// The least shift with which the tiles to come cost no more than `costs`.
    fn shift_for(&self, costs: f32) -> i32 {
        if costs <= 0.0 {
            return MOST_SHIFT;
        }
        let of = |shift: i32| -> f32 {
            let thinned = |(bin, mass): (usize, &f32)| {
                let wanted = (bin as i32 + shift).max(0) as usize / RESOLUTION;
                mass * SHARES[wanted.min(SHARES.len() - 1)]
            };
            self.ahead.iter().enumerate().map(thinned).sum()
        };
        let (mut low, mut high) = (LEAST_SHIFT, MOST_SHIFT);
        if of(low) <= costs {
            return low;
        }
        while high - low > 1 {
            let middle = (low + high) / 2;
            if of(middle) > costs {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    /// By depth or by validity, with the dither: where many tiles are alike, they still differ.
    fn bin(&self, means: Means, tile: usize) -> usize {
        let octaves = match means {
            // From an eighth of a metre on.
            Means::Mixed { .. } => self.depths[tile].max(0.125).log2() + 3.0 + 0.5 * dither(tile),
            Means::Thinned { .. } => self.halvings[tile] + dither(tile),
        };
        ((octaves * RESOLUTION as f32).max(0.0) as usize).min(BINS - 1)
    }
}
