//! A small grid of the floor around a robot, made from one sensor's whole cloud.
//!
//! Each point is moved to the grid's frame (REP-103: x forward, y left, z up from the floor) and counted in its cell by
//! its height: on the floor, in the band that the robot would hit, below the floor, or above the robot. The counts
//! become the cell's [`Class`]. Works in buffers made once, and accepts any numbers: points that are not finite, at the
//! sensor itself or outside the grid are left out.
#![forbid(unsafe_code)]

mod bins;
mod class;
mod lens;
mod obstacle_grid;
mod pose;
mod settings;

pub use class::Class;
pub use lens::Lens;
pub use obstacle_grid::{HEIGHT_STEP, ObstacleGrid, Seen};
pub use pose::SensorPose;
pub use settings::Settings;

/// x, y, z in metres in the sensor's optical frame, and a word that is not read.
pub type Point = [f32; 4];
