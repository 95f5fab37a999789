//! Frames that come as a depth image and a colour image: a pixel's place and depth are its point, so that a quarter of
//! the bytes is read, and only the points that are sent are computed.

use bytemuck::must_cast;
use wide::{f32x4, i32x4};

use crate::Point;
use crate::measure::{MAX_COORDINATE, MIN_DEPTH, Measured, OutOfRange, Totals};

/// A pinhole camera: pixel (u, v) sees along ((u − cx) / fx, (v − cy) / fy, 1).
#[derive(Clone, Debug)]
pub struct PixelGrid {
    columns: Vec<f32>,
    rows: Vec<f32>,
}

impl PixelGrid {
    /// `None` where a number is not finite, a focal length is zero, or there are no pixels or more than 2³¹.
    #[must_use]
    pub fn new(width: usize, height: usize, [fx, fy, cx, cy]: [f64; 4]) -> Option<Self> {
        let pixels = width.checked_mul(height)?;
        let rays = |count: usize, focal: f64, centre: f64| -> Vec<f32> {
            (0..count).map(|i| ((i as f64 - centre) / focal) as f32).collect()
        };
        if pixels == 0 || i32::try_from(pixels).is_err() {
            return None;
        }
        let grid = Self { columns: rays(width, fx, cx), rows: rays(height, fy, cy) };
        grid.columns.iter().chain(&grid.rows).all(|ray| ray.is_finite()).then_some(grid)
    }

    /// How many pixels there are.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.columns.len() * self.rows.len()
    }

    /// The point of a pixel.
    ///
    /// # Panics
    /// If the pixel is not in the image.
    #[must_use]
    pub fn point(&self, pixel: usize, depth: f32, colour: u32) -> Point {
        let width = self.columns.len();
        let (x, y) = (self.columns[pixel % width], self.rows[pixel / width]);
        [x * depth, y * depth, depth, f32::from_bits(colour)]
    }

    /// Computes the points of the pixels `chosen`, in their order.
    ///
    /// # Panics
    /// If a pixel is not in an image.
    pub fn gather(&self, depth: &[f32], colour: &[u32], chosen: &[u32], points: &mut Vec<Point>) {
        points.clear();
        points.extend(chosen.iter().map(|pixel| {
            let pixel = *pixel as usize;
            self.point(pixel, depth[pixel], colour[pixel])
        }));
    }

    /// As `measure` for a frame of points: `depths` gets a vector for each four pixels, NaN where one is not valid.
    ///
    /// # Panics
    /// If the image is not as large as the grid.
    pub(crate) fn measure(&self, depth: &[f32], out_of_range: OutOfRange, depths: &mut [f32x4]) -> Measured {
        assert_eq!(depth.len(), self.pixels());
        assert_eq!(depths.len(), depth.len().div_ceil(4));
        let limit = f32x4::splat(match out_of_range {
            OutOfRange::Reject => MAX_COORDINATE,
            OutOfRange::Keep => f32::MAX,
        });
        let mut totals = Totals::new();
        let width = self.columns.len();
        if width.is_multiple_of(4) {
            let columns: Vec<f32x4> =
                self.columns.as_chunks::<4>().0.iter().map(|x| f32x4::from(*x).abs()).collect();
            let rows =
                depth.as_chunks::<4>().0.chunks_exact(width / 4).zip(depths.chunks_exact_mut(width / 4));
            for ((row, measured), y) in rows.zip(&self.rows) {
                let least = f32x4::splat(y.abs().max(1.0));
                for ((z, x), to) in row.iter().zip(&columns).zip(measured) {
                    *to = totals.add_depth(f32x4::from(*z), x.fast_max(least), limit);
                }
            }
        } else {
            for (i, (chunk, to)) in depth.chunks(4).zip(depths.iter_mut()).enumerate() {
                let (mut z, mut reach) = ([f32::NAN; 4], [1.0; 4]);
                z[..chunk.len()].copy_from_slice(chunk);
                for (lane, reach) in reach[..chunk.len()].iter_mut().enumerate() {
                    let pixel = i * 4 + lane;
                    *reach = self.columns[pixel % width].abs().max(self.rows[pixel / width].abs()).max(1.0);
                }
                *to = totals.add_depth(f32x4::from(z), f32x4::from(reach), limit);
            }
        }
        totals.measured(depth.len())
    }
}

impl Totals {
    /// `reach`: the largest coordinate of a point at depth 1.
    #[inline(always)]
    fn add_depth(&mut self, depth: f32x4, reach: f32x4, limit: f32x4) -> f32x4 {
        let as_mask = must_cast::<f32x4, i32x4>;
        let finite = as_mask(depth.abs().simd_lt(f32x4::splat(f32::INFINITY)));
        let positive = finite & as_mask(depth.simd_ge(f32x4::splat(MIN_DEPTH)));
        let valid = positive & as_mask((reach * depth).simd_le(limit));
        self.count(depth, finite, positive, valid)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DepthMeasure, Rejected, Sampler, SamplingParameters};
    use proptest::prelude::*;

    const CAMERA: [f64; 4] = [3.0, 4.0, 2.2, 1.5];

    fn frame_of(grid: &PixelGrid, depth: &[f32]) -> Vec<Point> {
        depth.iter().enumerate().map(|(i, z)| grid.point(i, *z, i as u32)).collect()
    }

    fn any_depth() -> impl Strategy<Value = f32> {
        prop_oneof![
            8 => 0.1f32..12.0,
            1 => 10.0f32..60.0,
            1 => prop_oneof![Just(0.0f32), Just(-1.0), Just(f32::NAN), Just(f32::INFINITY), Just(1e-9)],
        ]
    }

    proptest! {
        #[test]
        fn an_image_is_sampled_as_its_points_are(
            (width, depth) in (1usize..9, 1usize..6).prop_flat_map(|(width, height)| {
                (Just(width), prop::collection::vec(any_depth(), width * height))
            }),
            count in 0usize..60,
            seed in any::<u64>(),
            keep in any::<bool>(),
        ) {
            let grid = PixelGrid::new(width, depth.len() / width, CAMERA).unwrap();
            let out_of_range = if keep { OutOfRange::Keep } else { OutOfRange::Reject };
            let parameters = SamplingParameters { count, seed, out_of_range, ..SamplingParameters::default() };
            let points = frame_of(&grid, &depth);
            let (mut by_points, mut by_image) = (Sampler::new(0), Sampler::new(0));
            let expected = by_points.sample(&points, &parameters).unwrap();
            prop_assert_eq!(by_image.sample_depth(&depth, &grid, &parameters).unwrap(), expected);
            prop_assert_eq!(by_image.chosen(), by_points.chosen());

            let colour: Vec<u32> = (0..depth.len() as u32).collect();
            let mut gathered = Vec::new();
            grid.gather(&depth, &colour, by_image.chosen(), &mut gathered);
            for (point, chosen) in gathered.iter().zip(by_image.chosen()) {
                prop_assert_eq!(point.map(f32::to_bits), points[*chosen as usize].map(f32::to_bits));
            }
        }
    }

    #[test]
    fn a_whole_row_of_vectors_gives_what_single_pixels_do() {
        let depth: Vec<f32> = (0..480).map(|i| if i % 7 == 0 { 0.0 } else { 0.5 + i as f32 * 0.2 }).collect();
        let grid = PixelGrid::new(48, 10, [20.0, 20.0, 23.5, 4.5]).unwrap();
        let parameters = SamplingParameters { count: 100, ..SamplingParameters::default() };
        let mut sampler = Sampler::new(480);
        let report = sampler.sample_depth(&depth, &grid, &parameters).unwrap();
        let chosen = sampler.chosen().to_vec();
        assert_eq!(report, sampler.sample(&frame_of(&grid, &depth), &parameters).unwrap());
        assert_eq!(chosen, sampler.chosen());
        let Rejected { non_positive_depth, out_of_range, .. } = report.rejected;
        assert!(non_positive_depth == 69 && out_of_range > 50);
    }

    #[test]
    fn an_image_knows_no_range() {
        // Depth is along z whatever the parameters say: an image has no other.
        let grid = PixelGrid::new(2, 1, [1.0, 1.0, 0.0, 0.0]).unwrap();
        let parameters = SamplingParameters {
            count: 2,
            depth_measure: DepthMeasure::Range,
            ..SamplingParameters::default()
        };
        let report = Sampler::new(2).sample_depth(&[2.0, 2.0], &grid, &parameters).unwrap();
        assert_eq!((report.min_depth, report.max_depth), (2.0, 2.0));
    }

    #[test]
    fn refuses_what_is_no_camera() {
        assert!(PixelGrid::new(0, 4, CAMERA).is_none());
        assert!(PixelGrid::new(4, 4, [0.0, 1.0, 0.0, 0.0]).is_none());
        assert!(PixelGrid::new(4, 4, [1.0, 1.0, f64::NAN, 0.0]).is_none());
        assert!(PixelGrid::new(usize::MAX, 2, CAMERA).is_none());
    }
}
