//! The camera's intrinsics and the faults of its stereo matcher.

use crate::scene::SceneError;

/// Numbers a configuration takes, in this order.
pub const CONFIG_LENGTH: usize = 14;
const MAX_PIXELS: usize = 4096 * 4096;

#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    pub width: usize,
    pub height: usize,
    /// Focal lengths and principal point in pixels; pixel centres are whole numbers.
    pub fx: f64,
    pub fy: f64,
    pub cx: f64,
    pub cy: f64,
    /// Distance between the two imagers, metres; the picture is the left one's.
    pub baseline: f32,
    /// Standard deviation of depth at one metre, metres; it grows with the square of depth.
    pub noise: f32,
    /// The matcher's disparity step in pixels; 0 for none.
    pub disparity_step: f32,
    /// Nearest and farthest depth measured, metres.
    pub near: f32,
    pub far: f32,
    /// Probability of a wrong match thrown out, anywhere.
    pub speckle: f32,
    /// Peak of the colour noise, in levels of 255: 0, 1, 3 or 7.
    pub colour_noise: u32,
    pub seed: u32,
}

impl Config {
    pub fn read(n: &[f64]) -> Result<Self, SceneError> {
        if n.len() != CONFIG_LENGTH {
            return Err(SceneError::Length { expected: CONFIG_LENGTH, actual: n.len() });
        }
        let check = |what: &'static str, value: f64, good: bool| {
            if good { Ok(value) } else { Err(SceneError::Camera { what, value }) }
        };
        let size =
            |what, value: f64| check(what, value, (16.0..=4096.0).contains(&value) && value % 4.0 == 0.0);
        let at_least = |what, value: f64, least: f64| check(what, value, value.is_finite() && value >= least);
        let (width, height) = (size("width", n[0])? as usize, size("height", n[1])? as usize);
        check("number of pixels", n[0] * n[1], width * height <= MAX_PIXELS)?;
        Ok(Self {
            width,
            height,
            fx: at_least("fx", n[2], 1.0)?,
            fy: at_least("fy", n[3], 1.0)?,
            cx: check("cx", n[4], n[4] >= 0.0 && n[4] <= n[0])?,
            cy: check("cy", n[5], n[5] >= 0.0 && n[5] <= n[1])?,
            baseline: at_least("baseline", n[6], 1e-3)? as f32,
            noise: at_least("noise", n[7], 0.0)? as f32,
            disparity_step: at_least("disparity step", n[8], 0.0)? as f32,
            near: at_least("near", n[9], 1e-3)? as f32,
            far: check("far", n[10], n[10].is_finite() && n[10] > n[9])? as f32,
            speckle: check("speckle", n[11], (0.0..=1.0).contains(&n[11]))? as f32,
            colour_noise: check("colour noise", n[12], [0.0, 1.0, 3.0, 7.0].contains(&n[12]))? as u32,
            seed: check("seed", n[13], n[13] >= 0.0 && n[13] <= 4_294_967_295.0 && n[13] % 1.0 == 0.0)?
                as u32,
        })
    }
}
