//! A stereo depth camera in a world of flat faces, drawn in software.
//!
//! One frame: `raster` finds the nearest face of every pixel, `shade` colours what is seen, `stereo` turns
//! true depth into what a matcher would measure. Everything is deterministic to the bit.

mod camera;
mod config;
mod pose;
mod raster;
mod scene;
mod shade;
mod simd;
mod stereo;
mod texture;

use camera::Camera;

use wasm_bindgen::prelude::*;

/// The camera as JavaScript sees it. Buffers stay where they are for its lifetime; the pointers are offsets
/// into the module's memory.
#[wasm_bindgen]
pub struct DepthCamera(Camera);

#[wasm_bindgen]
impl DepthCamera {
    /// See `Scene::read` and `Config::read` for what the numbers mean.
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &[f32], config: &[f64]) -> Result<DepthCamera, JsError> {
        Camera::new(scene, config).map(Self).map_err(|error| JsError::new(&error.to_string()))
    }

    /// 12 × (1 + bodies) doubles, to be written before `render`: rotation matrices row by row, translations.
    #[wasm_bindgen(js_name = posesPointer)]
    pub fn poses_pointer(&mut self) -> *mut f64 {
        self.0.poses.as_mut_ptr()
    }

    /// Their number: 12 × (1 + bodies).
    #[wasm_bindgen(js_name = posesLength)]
    pub fn poses_length(&self) -> usize {
        self.0.poses.len()
    }

    /// Four words a pixel: x, y, z as floats and the colour's bytes. To be read after each `render` with points: they are
    /// made at the first.
    #[wasm_bindgen(js_name = pointsPointer)]
    pub fn points_pointer(&self) -> *const u32 {
        self.0.frame.points.as_ptr()
    }

    /// Four bytes a pixel: R, G, B, 255.
    #[wasm_bindgen(js_name = colourPointer)]
    pub fn colour_pointer(&self) -> *const u32 {
        self.0.frame.colour.as_ptr()
    }

    /// A float a pixel: metres, 0 where invalid.
    #[wasm_bindgen(js_name = depthPointer)]
    pub fn depth_pointer(&self) -> *const u32 {
        self.0.frame.depth.as_ptr()
    }

    /// Draws one frame; the same number gives the same noise. Without faults it is the ground truth.
    pub fn render(&mut self, frame_number: u32, without_faults: bool, with_points: bool) {
        self.0.render(frame_number, without_faults, with_points);
    }
}
