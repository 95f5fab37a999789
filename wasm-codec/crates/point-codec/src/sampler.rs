//! Chooses which points of a frame to send.

use wide::f32x4;

use crate::Point;
use crate::depth_image::PixelGrid;
use crate::exponential::Generator;
use crate::measure::{DepthMeasure, Measured, OutOfRange, measure};
use crate::selection::{Candidates, NO_LIMIT};
use crate::weight::{Cost, Even, Power, Real, Whole};

/// What the sampling depends on, beside the frame. The defaults are the paper's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SamplingParameters {
    /// How many points to choose (the paper's N_max).
    pub count: usize,
    /// λ: how fast the weight falls with depth; 0 is uniform. 0 to [`SamplingParameters::MAX_LAMBDA`].
    pub lambda: f32,
    /// ε: keeps the weight of the nearest points finite. [`SamplingParameters::MIN_EPSILON`] to 1.
    pub epsilon: f32,
    /// D: points nearer than this have the weight of the nearest, metres. 0 and above.
    pub near_distance: f32,
    /// What depth is.
    pub depth_measure: DepthMeasure,
    /// What becomes of points that int16 millimetres cannot hold.
    pub out_of_range: OutOfRange,
    /// The same frame, parameters and seed give the same choice.
    pub seed: u64,
}

impl SamplingParameters {
    /// The largest λ.
    pub const MAX_LAMBDA: f32 = 64.0;
    /// The smallest ε: keys stay normal numbers.
    pub const MIN_EPSILON: f32 = 1e-12;

    fn check(&self) -> Result<(), InvalidParameter> {
        // The ranges are written so that NaN is outside.
        if !(0.0..=Self::MAX_LAMBDA).contains(&self.lambda) {
            return Err(InvalidParameter::Lambda);
        }
        if !(Self::MIN_EPSILON..=1.0).contains(&self.epsilon) {
            return Err(InvalidParameter::Epsilon);
        }
        if !(0.0..=f32::MAX).contains(&self.near_distance) {
            return Err(InvalidParameter::NearDistance);
        }
        Ok(())
    }
}

impl Default for SamplingParameters {
    fn default() -> Self {
        Self {
            count: 0,
            lambda: 3.0,
            epsilon: 1e-6,
            near_distance: 3.85,
            depth_measure: DepthMeasure::Z,
            out_of_range: OutOfRange::Reject,
            seed: 0,
        }
    }
}

/// A parameter outside its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InvalidParameter {
    /// `lambda`
    Lambda,
    /// `epsilon`
    Epsilon,
    /// `near_distance`
    NearDistance,
}

impl core::fmt::Display for InvalidParameter {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Lambda => "lambda is not between 0 and 64",
            Self::Epsilon => "epsilon is not between 1e-12 and 1",
            Self::NearDistance => "near_distance is negative or not finite",
        })
    }
}

impl core::error::Error for InvalidParameter {}

/// Why points of the frame are not among the chosen; each counts once, under the first reason that holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rejected {
    /// A coordinate is NaN or infinite.
    pub not_finite: usize,
    /// The depth is below [`crate::MIN_DEPTH`]: zero or negative.
    pub non_positive_depth: usize,
    /// A coordinate is beyond ±32.767 m.
    pub out_of_range: usize,
    /// The point could be sent; the draw left it out.
    pub not_drawn: usize,
}

/// What a call of [`Sampler::sample`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SampleReport {
    /// How many points were chosen.
    pub kept: usize,
    /// The other points of the frame: with `kept` they add up to the frame's size.
    pub rejected: Rejected,
    /// The smallest depth of a point that could be sent, metres; 0 where there was none.
    pub min_depth: f32,
    /// The largest such depth (the paper's max z).
    pub max_depth: f32,
}

/// The bits of infinity: no key.
const NOT_FOUND: u32 = 0x7f80_0000;

/// Draws points without replacement with probability proportional to their weight, exactly (Efraimidis and Spirakis
/// 2006): each point gets the key e/v with e exponentially distributed, and the points with the smallest keys are the
/// draw. The buffers are made once.
pub struct Sampler {
    depths: Vec<f32x4>,
    candidates: Candidates,
    chosen: Vec<u32>,
    kept: usize,
}

impl Sampler {
    /// A sampler for frames of up to `capacity` points; larger frames make its buffers grow.
    #[must_use]
    pub fn new(capacity: usize) -> Self {
        let mut sampler =
            Self { depths: Vec::new(), candidates: Candidates::new(), chosen: Vec::new(), kept: 0 };
        sampler.reserve(capacity);
        sampler
    }

    fn reserve(&mut self, points: usize) {
        let quads = points.div_ceil(4);
        if self.depths.len() < quads {
            self.depths.resize(quads, f32x4::ZERO);
            self.candidates.reserve(quads);
            self.chosen.resize(quads * 4 + 4, 0);
        }
    }

    /// The chosen points of the last [`Sampler::sample`]: indices into its frame, ascending.
    #[must_use]
    pub fn chosen(&self) -> &[u32] {
        &self.chosen[..self.kept]
    }

    /// Chooses `parameters.count` points, or all that can be sent if those are fewer.
    ///
    /// # Errors
    /// A parameter is outside its range; nothing is chosen then.
    ///
    /// # Panics
    /// If the frame has more than 2³¹ points.
    pub fn sample(
        &mut self,
        frame: &[Point],
        parameters: &SamplingParameters,
    ) -> Result<SampleReport, InvalidParameter> {
        assert!(i32::try_from(frame.len()).is_ok(), "a frame of {} points", frame.len());
        self.kept = 0;
        parameters.check()?;
        self.reserve(frame.len());
        let quads = frame.len().div_ceil(4);
        let measured =
            measure(frame, parameters.depth_measure, parameters.out_of_range, &mut self.depths[..quads]);
        Ok(self.choose(quads, parameters, &measured))
    }

    /// As [`Sampler::sample`], of a depth image (along z, metres; not valid: NaN, infinite, zero or negative): the very
    /// same choice as of the image's points. The depth measure is z.
    ///
    /// # Errors
    /// A parameter is outside its range; nothing is chosen then.
    ///
    /// # Panics
    /// If the image is not as large as the grid.
    pub fn sample_depth(
        &mut self,
        depth: &[f32],
        grid: &PixelGrid,
        parameters: &SamplingParameters,
    ) -> Result<SampleReport, InvalidParameter> {
        self.kept = 0;
        parameters.check()?;
        self.reserve(depth.len());
        let quads = depth.len().div_ceil(4);
        let measured = grid.measure(depth, parameters.out_of_range, &mut self.depths[..quads]);
        Ok(self.choose(quads, parameters, &measured))
    }

    fn choose(&mut self, quads: usize, parameters: &SamplingParameters, measured: &Measured) -> SampleReport {
        self.kept = parameters.count.min(measured.valid);
        if self.kept == measured.valid {
            self.take_all_valid(quads);
        } else if self.kept > 0 {
            self.draw(quads, parameters, measured);
        }
        SampleReport {
            kept: self.kept,
            rejected: Rejected {
                not_finite: measured.not_finite,
                non_positive_depth: measured.non_positive_depth,
                out_of_range: measured.out_of_range,
                not_drawn: measured.valid - self.kept,
            },
            min_depth: measured.min_depth,
            max_depth: measured.max_depth,
        }
    }

    fn take_all_valid(&mut self, quads: usize) {
        let mut count = 0;
        for (quad, depths) in self.depths[..quads].iter().enumerate() {
            for (lane, depth) in depths.to_array().into_iter().enumerate() {
                self.chosen[count] = (quad * 4 + lane) as u32;
                count += usize::from(depth > 0.0);
            }
        }
    }

    fn draw(&mut self, quads: usize, parameters: &SamplingParameters, measured: &Measured) {
        let lambda = parameters.lambda;
        if lambda == 0.0 {
            self.draw_by(Even, quads, parameters, measured);
        } else if lambda.fract() == 0.0 {
            self.draw_by(Whole(lambda as u32), quads, parameters, measured);
        } else {
            self.draw_by(Real(lambda), quads, parameters, measured);
        }
    }

    fn draw_by<P: Power>(
        &mut self,
        power: P,
        quads: usize,
        parameters: &SamplingParameters,
        measured: &Measured,
    ) {
        let SamplingParameters { epsilon, near_distance, seed, .. } = *parameters;
        let cost = Cost::new(power, epsilon, near_distance, measured.min_depth, measured.max_depth);
        let limit = self.likely_limit(&cost, quads, seed, measured.valid);
        self.collect(&cost, quads, seed, limit);
        let mut threshold = NOT_FOUND;
        if self.candidates.len() >= self.kept {
            threshold = self.candidates.threshold(self.kept);
        }
        // A key just below the limit may be missing, by how the products round.
        if f32::from_bits(threshold) >= limit * (1.0 - 4e-6) {
            // The guess was too low, which hardly ever happens: the same draw again, with all points.
            self.collect(&cost, quads, seed, NO_LIMIT);
            threshold = self.candidates.threshold(self.kept);
        }
        self.candidates.smallest(self.kept, threshold, &mut self.chosen);
    }

    /// A key that most likely is a little above the largest key that will be chosen, guessed from other draws for one in
    /// `STRIDE` of the points. Only how long the selection takes depends on it, never its outcome.
    fn likely_limit<P: Power>(&mut self, cost: &Cost<P>, quads: usize, seed: u64, valid: usize) -> f32 {
        const STRIDE: usize = 31;
        let mut generator = Generator::new(!seed);
        let depths = self.depths[..quads].iter().step_by(STRIDE);
        self.candidates.collect(NO_LIMIT, depths.map(|depth| (generator.uniform(), cost.of(*depth), 0)));
        let seen = self.candidates.len();
        let expected = (self.kept as f64 / valid as f64) * seen as f64;
        // Four standard deviations above the expected rank.
        let rank = (expected + 4.0 * expected.sqrt() + 4.0) as usize;
        if rank < seen { f32::from_bits(self.candidates.threshold(rank)) } else { NO_LIMIT }
    }

    fn collect<P: Power>(&mut self, cost: &Cost<P>, quads: usize, seed: u64, limit: f32) {
        let mut generator = Generator::new(seed);
        let mut first = 0;
        let points = self.depths[..quads].iter().map(|depth| {
            let quad = (generator.uniform(), cost.of(*depth), first);
            first += 4;
            quad
        });
        self.candidates.collect(limit, points);
    }
}
