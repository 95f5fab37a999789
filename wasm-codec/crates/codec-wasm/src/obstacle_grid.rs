use farpoint_obstacle_grid::{Lens, ObstacleGrid as Grid, SensorPose, Settings};
use wasm_bindgen::prelude::*;
use wide::f32x4;

/// How many numbers describe the sensor's pose: the rotation row by row, then the position.
const POSE_LENGTH: usize = 12;
const REPORT_LENGTH: usize = 3;

/// A cloud, or a camera's depth image, and what it says about the floor around the robot.
#[wasm_bindgen]
pub struct ObstacleGrid {
    grid: Grid,
    capacity: usize,
    // Vectors and not points: aligned to 16 bytes. Made when first asked for, as the image is.
    points: Vec<f32x4>,
    depth: Vec<f32>,
    lens: Option<Lens>,
    pose: Box<[f32; POSE_LENGTH]>,
    report: Box<[u32; REPORT_LENGTH]>,
}

#[wasm_bindgen]
impl ObstacleGrid {
    /// Room for clouds of `capacity` points. `undefined` where the settings are not valid.
    #[allow(
        clippy::too_many_arguments,
        reason = "numbers cross this border without an allocation, objects do not"
    )]
    pub fn create(
        capacity: usize,
        side: usize,
        cell: f32,
        clearance: f32,
        height: f32,
        drop: f32,
        slope: f32,
        low_ray: f32,
        near_points: f32,
        least_points: f32,
        confirm: bool,
    ) -> Option<ObstacleGrid> {
        let settings = Settings {
            side,
            cell,
            clearance,
            height,
            drop,
            slope,
            low_ray,
            near_points,
            least_points,
            confirm,
        };
        Some(Self {
            grid: Grid::new(settings)?,
            capacity,
            points: Vec::new(),
            depth: Vec::new(),
            lens: None,
            pose: Box::default(),
            report: Box::default(),
        })
    }

    /// Makes the image, for this camera; false where there is none with such numbers or more pixels than the capacity.
    pub fn set_camera(&mut self, width: usize, height: usize, fx: f64, fy: f64, cx: f64, cy: f64) -> bool {
        let lens = Lens::new(width, height, [fx, fy, cx, cy]);
        let pixels = lens.as_ref().map_or(0, Lens::pixels);
        if pixels == 0 || pixels > self.capacity {
            return false;
        }
        self.lens = lens;
        self.depth.resize(pixels, 0.0);
        true
    }

    /// A float a pixel.
    pub fn depth_ptr(&self) -> *const f32 {
        self.depth.as_ptr()
    }

    /// 4 floats a point.
    pub fn points_ptr(&mut self) -> *const f32 {
        self.points.resize(self.capacity, f32x4::ZERO);
        self.points.as_ptr().cast()
    }

    /// The sensor's pose in the grid's frame: the rotation row by row, then the position.
    pub fn pose_ptr(&self) -> *const f32 {
        self.pose.as_ptr()
    }

    /// The class of each cell.
    pub fn classes_ptr(&self) -> *const u8 {
        self.grid.classes().as_ptr()
    }

    /// The height of each cell, as [`Grid::heights`] says.
    pub fn heights_ptr(&self) -> *const u8 {
        self.grid.heights().as_ptr()
    }

    /// Free and occupied cells, and those without a floor.
    pub fn report_ptr(&self) -> *const u32 {
        self.report.as_ptr()
    }

    /// Judges the first `points` points, or with `image` the image. 0, or what was wrong: 1 the pose, 2 more points than
    /// the capacity, 3 no camera was set.
    pub fn look(&mut self, image: bool, points: usize, shift_x: i32, shift_y: i32) -> u32 {
        let (turn, place) = self.pose.split_at(9);
        let (Ok(rotation), Ok(position)) = (turn.try_into(), place.try_into()) else { return 1 };
        let Some(pose) = SensorPose::new(rotation, position) else { return 1 };
        let shift = [shift_x, shift_y];
        let seen = if image {
            let Some(lens) = &self.lens else { return 3 };
            self.grid.look_at_image(&self.depth, lens, &pose, shift)
        } else {
            if points > self.capacity {
                return 2;
            }
            self.points.resize(self.capacity, f32x4::ZERO);
            self.grid.look_at_points(bytemuck::must_cast_slice(&self.points[..points]), &pose, shift)
        };
        *self.report = [seen.free, seen.occupied, seen.drop_offs];
        0
    }
}
