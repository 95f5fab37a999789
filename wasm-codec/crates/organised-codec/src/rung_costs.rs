//! What the rungs of the ladder cost for frames of one kind, learnt from frame to frame.

use crate::budget::Budget;
use crate::ladder::{MOST_RUNGS, first_rung, first_shares, rungs, settings_of};
use crate::load::Source;
use crate::plan::{Means, Plan};
use crate::sampling::SamplingEncoder;
use crate::thinning::{halvings, tile_depths};
use crate::tile::Pattern;

/// Two rungs side by side on the ladder, or twice the same one, and how a frame's tiles are spread over them.
#[derive(Clone, Copy)]
pub(crate) struct Rungs {
    pub finer: usize,
    pub coarser: usize,
    pub means: Means,
}

/// What frames of one kind cost.
#[derive(Default)]
pub(crate) struct RungCosts {
    /// At every rung, as shares of the plan's costs.
    shares: [f32; MOST_RUNGS],
    /// Rungs whose share was found with a frame, not guessed.
    found: [bool; MOST_RUNGS],
    /// How many rungs there are.
    rungs: usize,
    /// The coarser rung of the last frame.
    rung: usize,
    pub plan: Plan,
}

impl RungCosts {
    /// Begins a frame: finds its tiles' depths. For the first frame of a kind, a sample tells the cost at one rung.
    pub fn begin(&mut self, encoder: &mut SamplingEncoder, source: Source<'_>, budget: &Budget) {
        tile_depths(source, encoder.frames.tiles.grid(), &mut self.plan.depths);
        self.plan.halvings.clone_from(&self.plan.depths);
        halvings(&budget.validity, &mut self.plan.halvings);
        if self.plan.is_known() {
            return;
        }
        encoder.frames.patterns.fill(Pattern(0));
        let first = first_rung(budget);
        let bytes = encoder.estimate(source, &mut settings_of(first, budget));
        self.shares = first_shares(budget);
        self.found = core::array::from_fn(|rung| rung == first);
        (self.rungs, self.rung) = (rungs(budget), first);
        self.plan.guess(bytes * 8.0 / self.shares[first]);
    }

    /// The rungs between which `wanted` bits lie, and how to spread the tiles over them. A sample of the frame replaces the
    /// cost of a rung that has only been guessed.
    pub fn find_rungs(
        &mut self,
        encoder: &mut SamplingEncoder,
        source: Source<'_>,
        budget: &Budget,
        wanted: f32,
    ) -> Rungs {
        let mut known = None;
        loop {
            let rungs = self.rungs(wanted);
            let Some(rung) = [rungs.coarser, rungs.finer].into_iter().find(|rung| !self.found[*rung]) else {
                self.rung = rungs.coarser;
                return rungs;
            };
            encoder.frames.patterns.fill(Pattern(0));
            let mut bytes = |rung: usize| encoder.estimate(source, &mut settings_of(rung, budget)).max(1.0);
            let known = *known.get_or_insert_with(|| bytes(self.rung));
            let times = bytes(rung) / known;
            self.find(rung, times);
        }
    }

    /// The rungs at a place on the ladder: whole numbers are rungs, what is between them a split into both.
    pub fn rungs_at(&self, place: f32) -> Rungs {
        let rung = (place as usize).min(self.rungs - 2);
        self.mixed(rung, rung + 1, Some(1.0 + rung as f32 - place))
    }

    /// Corrects the rungs' costs relative to each other, by the tiles that moved from one to the other.
    pub fn learn(&mut self, rungs: &Rungs) {
        let [to_finer, to_coarser] = self.plan.learn_shares();
        self.shares[rungs.finer] *= to_finer;
        self.shares[rungs.coarser] *= to_coarser;
    }

    /// As [`RungCosts::find_rungs`], by what is known.
    fn rungs(&self, wanted: f32) -> Rungs {
        let full = self.plan.full();
        // The first that is not too dear for the whole frame.
        match (0..self.rungs).find(|rung| full * self.shares[*rung] <= wanted) {
            Some(rung) => self.mixed(rung.saturating_sub(1), rung, None),
            None => {
                let last = self.rungs - 1;
                Rungs { finer: last, coarser: last, means: Means::Thinned { share: self.shares[last] } }
            }
        }
    }

    fn mixed(&self, finer: usize, coarser: usize, split: Option<f32>) -> Rungs {
        let means = Means::Mixed { finer: self.shares[finer], coarser: self.shares[coarser], split };
        Rungs { finer, coarser, means }
    }

    /// Notes that a rung costs `times` what the last frame's coarser one does. Rungs beyond it whose cost has only been guessed
    /// are scaled by the same factor.
    fn find(&mut self, rung: usize, times: f32) {
        let share = self.shares[self.rung] * times;
        let ratio = share / self.shares[rung];
        let beyond = if rung < self.rung { 0..=rung } else { rung..=self.rungs - 1 };
        for other in beyond {
            if !self.found[other] {
                self.shares[other] *= ratio;
            }
        }
        (self.shares[rung], self.found[rung]) = (share, true);
    }
}
