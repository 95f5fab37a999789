//! What a stereo matcher makes of the scene: noisy, quantised depth with holes.
//!
//! Disparity is inverse depth times focal length times baseline, so an error of constant size in disparity
//! is a depth error that grows with the square of depth: sigma_z = noise · z². Holes come where the right
//! imager does not see the point, at depth edges, where texture or contrast is missing, out of range, and
//! as random speckle. All randomness is an integer hash of (seed, frame, pixel).

use crate::config::Config;
use crate::raster::Raster;
use crate::shade::Shader;
use crate::simd::{F32x4, I32x4, hash, hash_one, ramp, store_interleaved};

/// Quiet NaN with no payload, so that invalid points are the same bits everywhere.
const NAN: i32 = 0x7fc0_0000;
/// Odd multipliers that spread pixel and block numbers over 32 bits before they are hashed.
const PIXEL_SPREAD: i32 = 0x2c1b_3c6d;
const BLOCK_SPREAD: i32 = 0x1656_67b1;

/// The camera's three pictures, row by row.
pub struct Frame {
    /// x, y, z in metres in the optical frame and the colour's bits; x, y, z are NaN where invalid. Empty until asked for,
    /// and only written where asked for: the images say the same in a third of the bytes.
    pub points: Vec<u32>,
    /// R, G, B, 255.
    pub colour: Vec<u32>,
    /// Bits of the depth in metres; 0 where invalid.
    pub depth: Vec<u32>,
}

impl Frame {
    pub fn new(config: &Config) -> Self {
        let pixels = config.width * config.height;
        Self {
            points: Vec::new(),
            // Four spare words for the shader's last vector.
            colour: vec![0; pixels + 4],
            depth: vec![0; pixels],
        }
    }
}

/// Measures the drawn scene as the camera would; `frame_number` selects the noise. Each row is shaded just before it is
/// measured: it is still in the processor's cache then.
#[inline(never)]
pub fn measure<const POINTS: bool>(
    config: &Config,
    raster: &Raster,
    shader: &Shader,
    frame_number: u32,
    frame: &mut Frame,
    occluded: &mut [u32],
) {
    let splat = F32x4::splat;
    let width = raster.width;
    let last_row = raster.height - 1;
    let focal_baseline = config.fx as f32 * config.baseline;
    let salt = hash_one(config.seed ^ hash_one(frame_number ^ 0x9e37_79b9)) as i32;
    let one = splat(1.0);
    // A sum of four bytes has mean 510 and variance 4·(256² − 1)/12: scaled to standard deviation 1.
    let noise_scale = splat(config.noise / 147.8);
    let (quantum, quanta) = if config.disparity_step > 0.0 {
        (config.disparity_step / focal_baseline, focal_baseline / config.disparity_step)
    } else {
        (0.0, 0.0)
    };
    let (nearest, farthest) = (splat(1.0 / config.near), splat(1.0 / config.far));
    let speckle = I32x4::splat((config.speckle * 16_777_216.0) as i32);
    let edge_failure = I32x4::splat(140);
    let colour_more = I32x4::splat(config.colour_noise as i32 * 0x0001_0101);
    let colour_less = I32x4::splat(config.colour_noise.div_ceil(2) as i32 * 0x0001_0101);
    let rays = Rays::new(config);

    for row in 0..raster.height {
        let start = row * width;
        let depths = &raster.inverse_depth[start..start + width];
        let above = &raster.inverse_depth[row.saturating_sub(2) * width..][..width];
        let below = &raster.inverse_depth[(row + 2).min(last_row) * width..][..width];
        hidden_from_right(depths, focal_baseline, occluded);
        shader.shade(row, &mut frame.colour);
        let ray_y = rays.y(row);
        let mut spread_pixel =
            (I32x4::splat(start as i32) + I32x4::new(0, 1, 2, 3)) * I32x4::splat(PIXEL_SPREAD);
        let row_of_blocks = hash_one((row >> 1) as u32 ^ !salt as u32) as i32;
        let mut spread_block = I32x4::splat(row_of_blocks) + I32x4::new(0, 0, BLOCK_SPREAD, BLOCK_SPREAD);

        let mut x = 0;
        while x < width {
            let pixel = start + x;
            let inverse = F32x4::load(&depths[x..]);
            let random = hash(spread_pixel ^ I32x4::splat(salt));
            spread_pixel = spread_pixel + I32x4::splat(4i32.wrapping_mul(PIXEL_SPREAD));

            let halves =
                (random & I32x4::splat(0x00ff_00ff)) + (random.shr::<8>() & I32x4::splat(0x00ff_00ff));
            let sum = (halves & I32x4::splat(0xffff)) + halves.shr::<16>();
            let noise = (sum - I32x4::splat(510)).to_f32() * noise_scale;
            let mut measured = inverse + noise;
            if quantum > 0.0 {
                measured = (measured * splat(quanta)).nearest() * splat(quantum);
            }

            // Second differences vanish on planes at any slant and are large at depth edges only.
            let twice = inverse + inverse;
            let left = F32x4::load(&depths[x.saturating_sub(2)..]);
            let right = F32x4::load(&depths[(x + 2).min(width - 4)..]);
            let bend_x = (left + right - twice).abs();
            let bend_y = (F32x4::load(&above[x..]) + F32x4::load(&below[x..]) - twice).abs();
            let bend = if x == 0 || x + 4 >= width { bend_y } else { bend_x.max(bend_y) };
            let edge = bend.gt(splat(0.012) + inverse * splat(0.06));

            let random = (random ^ random.shr::<15>()) * I32x4::splat(0x2c1b_3c6d);
            let colour = I32x4::load(&frame.colour[pixel..]);
            let failure = colour.shr::<24>();
            let failure = edge_failure.select(failure, edge & failure.lt(edge_failure));
            // Speckle falls on blocks of 2 × 2: wrong matches are rarely alone.
            let blotch = (spread_block ^ spread_block.shr::<16>()) * I32x4::splat(0x7feb_352d);
            let blotch = blotch ^ blotch.shr::<15>();
            spread_block = spread_block + I32x4::splat(2i32.wrapping_mul(BLOCK_SPREAD));

            let invalid = random.shr::<24>().lt(failure)
                | blotch.shr::<8>().lt(speckle)
                | measured.lt(farthest)
                | measured.gt(nearest)
                | I32x4::load(&occluded[x..]);

            let dither = (random & colour_more, colour_less);
            let rgba = colour.dither_bytes(dither.0, dither.1) | I32x4::splat(0xff00_0000_u32 as i32);
            rgba.store(&mut frame.colour[pixel..pixel + 4]);

            let depth = one / measured;
            if POINTS {
                let nan = I32x4::splat(NAN);
                let [px, py, pz] = rays.points(x, ray_y, depth).map(|c| nan.select(c.bits(), invalid));
                store_interleaved(px, py, pz, rgba, &mut frame.points[4 * pixel..4 * pixel + 16]);
            }
            I32x4::splat(0).select(depth.bits(), invalid).store(&mut frame.depth[pixel..pixel + 4]);
            x += 4;
        }
    }
}

/// The scene as it is: no noise, no holes but where there is nothing at all.
#[inline(never)]
pub fn ground_truth<const POINTS: bool>(
    config: &Config,
    raster: &Raster,
    shader: &Shader,
    frame: &mut Frame,
) {
    let rays = Rays::new(config);
    let one = F32x4::splat(1.0);
    for row in 0..raster.height {
        let ray_y = rays.y(row);
        shader.shade(row, &mut frame.colour);
        for x in (0..raster.width).step_by(4) {
            let pixel = row * raster.width + x;
            let inverse = F32x4::load(&raster.inverse_depth[pixel..]);
            let nothing = inverse.lt(F32x4::splat(1e-6));
            let depth = one / inverse.max(F32x4::splat(1e-6));
            let rgba = I32x4::load(&frame.colour[pixel..]) | I32x4::splat(0xff00_0000_u32 as i32);
            rgba.store(&mut frame.colour[pixel..pixel + 4]);
            if POINTS {
                let nan = I32x4::splat(NAN);
                let [px, py, pz] = rays.points(x, ray_y, depth).map(|c| nan.select(c.bits(), nothing));
                store_interleaved(px, py, pz, rgba, &mut frame.points[4 * pixel..4 * pixel + 16]);
            }
            I32x4::splat(0).select(depth.bits(), nothing).store(&mut frame.depth[pixel..pixel + 4]);
        }
    }
}

/// Marks the pixels of a row that the right imager does not see.
///
/// A pixel at column x lands at x − disparity in the right picture. Walking from the right, a pixel is hidden
/// when one to its right lands at or left of it: that one is nearer and covers it.
#[inline(never)]
fn hidden_from_right(inverse_depth: &[f32], focal_baseline: f32, occluded: &mut [u32]) {
    let width = inverse_depth.len();
    let scale = F32x4::splat(focal_baseline);
    let zero = F32x4::splat(0.0);
    let tolerance = F32x4::splat(0.4);
    let mut leftmost = F32x4::splat(f32::MAX);
    for x in (0..width).step_by(4).rev() {
        let landing = ramp(x as f32) - scale * F32x4::load(&inverse_depth[x..]);
        // Minimum over everything to the right, lane by lane.
        let to_right = landing.shift_in(leftmost);
        let to_right = to_right.min(to_right.shift_in(leftmost));
        let to_right = to_right.min(to_right.shift_in_two(leftmost));
        let hidden = (landing - tolerance).gt(to_right) | landing.lt(zero);
        hidden.store(&mut occluded[x..x + 4]);
        leftmost = F32x4::splat(to_right.min(landing).first());
    }
}

struct Rays {
    inverse_fx: f32,
    cx: f32,
    inverse_fy: f32,
    cy: f32,
}

impl Rays {
    fn new(config: &Config) -> Self {
        Self {
            inverse_fx: (1.0 / config.fx) as f32,
            cx: config.cx as f32,
            inverse_fy: (1.0 / config.fy) as f32,
            cy: config.cy as f32,
        }
    }

    fn y(&self, row: usize) -> F32x4 {
        F32x4::splat((row as f32 - self.cy) * self.inverse_fy)
    }

    #[inline(always)]
    fn points(&self, x: usize, ray_y: F32x4, depth: F32x4) -> [F32x4; 3] {
        let ray_x = (ramp(x as f32) - F32x4::splat(self.cx)) * F32x4::splat(self.inverse_fx);
        [ray_x * depth, ray_y * depth, depth]
    }
}
