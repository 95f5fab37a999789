//! The point codec's bindings for JavaScript: objects whose buffers lie in the module's memory and are read and written
//! there through views, so that a call passes numbers only. The checked interface is the TypeScript package around it.

mod obstacle_grid;
mod organised_decoder;
mod organised_encoder;
mod organised_frame;
mod unorganised;

use farpoint_point_codec::points64::{InvalidCount, POINTS_PER_PACKET, SlotLayout, pack, unpack};
use farpoint_point_codec::{
    DepthMeasure, InvalidParameter, OutOfRange, PixelGrid, Point, SampleReport, Sampler, SamplingParameters,
    near_first,
};
use wasm_bindgen::prelude::*;
use wide::f32x4;

/// How many numbers [`Encoder::report_ptr`] points to.
const REPORT_LENGTH: usize = 10;

/// What the last `sample` looked at.
#[derive(Clone, Copy)]
enum Sampled {
    Nothing,
    Frame { points: usize, depth_measure: DepthMeasure },
    Images,
}

/// A frame of points or a camera's images, the sampler and the packet slots it is packed into.
#[wasm_bindgen]
pub struct Encoder {
    capacity: usize,
    // Vectors and not points: aligned to 16 bytes. Made when first asked for, as the images are.
    frame: Vec<f32x4>,
    grid: Option<PixelGrid>,
    depth: Vec<f32>,
    colour: Vec<u32>,
    /// The chosen points of images, and their own numbers.
    gathered: Vec<Point>,
    numbers: Vec<u32>,
    sampler: Sampler,
    ordered: Vec<u32>,
    sampled: Sampled,
    layout: SlotLayout,
    slots: Vec<u8>,
    report: Box<[f64; REPORT_LENGTH]>,
}

#[wasm_bindgen]
impl Encoder {
    /// Room for frames of `capacity` points; a block begins `data_offset` bytes into each `stride` bytes. `undefined` where
    /// a full block does not fit into a slot.
    pub fn create(capacity: usize, stride: usize, data_offset: usize) -> Option<Encoder> {
        let layout = SlotLayout::new(stride, data_offset)?;
        Some(Self {
            capacity,
            frame: Vec::new(),
            grid: None,
            depth: Vec::new(),
            colour: Vec::new(),
            gathered: Vec::new(),
            numbers: Vec::new(),
            sampler: Sampler::new(capacity),
            ordered: Vec::with_capacity(capacity),
            sampled: Sampled::Nothing,
            layout,
            slots: vec![0; capacity.div_ceil(POINTS_PER_PACKET) * stride],
            report: Box::default(),
        })
    }

    /// 4 floats a point.
    pub fn frame_ptr(&mut self) -> *const f32 {
        self.frame.resize(self.capacity, f32x4::ZERO);
        self.frame.as_ptr().cast()
    }

    /// Makes the images, for this camera; false where there is none with such numbers or more pixels than the capacity.
    pub fn set_camera(&mut self, width: usize, height: usize, fx: f64, fy: f64, cx: f64, cy: f64) -> bool {
        let grid = PixelGrid::new(width, height, [fx, fy, cx, cy]);
        let pixels = grid.as_ref().map_or(0, PixelGrid::pixels);
        if pixels == 0 || pixels > self.capacity {
            return false;
        }
        self.grid = grid;
        self.depth.resize(pixels, 0.0);
        self.colour.resize(pixels, 0);
        true
    }

    /// A float a pixel.
    pub fn depth_ptr(&self) -> *const f32 {
        self.depth.as_ptr()
    }

    /// 4 bytes a pixel.
    pub fn colour_ptr(&self) -> *const u32 {
        self.colour.as_ptr()
    }

    /// The slots, one after another.
    pub fn slots_ptr(&self) -> *const u8 {
        self.slots.as_ptr()
    }

    /// The indices that the last `sample` chose.
    pub fn chosen_ptr(&self) -> *const u32 {
        self.sampler.chosen().as_ptr()
    }

    /// After `sample`: kept; rejected as not finite, for non-positive depth, out of range, not drawn; min depth, max depth.
    /// After `pack`, from 7 on: packets, points, saturated.
    pub fn report_ptr(&self) -> *const f64 {
        self.report.as_ptr()
    }

    /// Of the frame's first `points` points, or with `images` of the images. 0, or what was wrong: 1 lambda, 2 epsilon,
    /// 3 near distance, 4 more points than the capacity, 5 no camera was set.
    #[allow(
        clippy::too_many_arguments,
        reason = "numbers cross this border without an allocation, objects do not"
    )]
    pub fn sample(
        &mut self,
        images: bool,
        points: usize,
        count: usize,
        lambda: f32,
        epsilon: f32,
        near_distance: f32,
        range: bool,
        keep_out_of_range: bool,
        seed: u64,
    ) -> u32 {
        self.sampled = Sampled::Nothing;
        let depth_measure = if range { DepthMeasure::Range } else { DepthMeasure::Z };
        let parameters = SamplingParameters {
            count,
            lambda,
            epsilon,
            near_distance,
            depth_measure,
            out_of_range: if keep_out_of_range { OutOfRange::Keep } else { OutOfRange::Reject },
            seed,
        };
        let outcome = if images {
            let Some(grid) = &self.grid else { return 5 };
            self.sampler.sample_depth(&self.depth, grid, &parameters)
        } else {
            if points > self.capacity {
                return 4;
            }
            self.frame.resize(self.capacity, f32x4::ZERO);
            self.sampler.sample(bytemuck::must_cast_slice(&self.frame[..points]), &parameters)
        };
        match outcome {
            Ok(SampleReport { kept, rejected, min_depth, max_depth }) => {
                self.sampled =
                    if images { Sampled::Images } else { Sampled::Frame { points, depth_measure } };
                self.report[..7].copy_from_slice(&[
                    kept as f64,
                    rejected.not_finite as f64,
                    rejected.non_positive_depth as f64,
                    rejected.out_of_range as f64,
                    rejected.not_drawn as f64,
                    f64::from(min_depth),
                    f64::from(max_depth),
                ]);
                0
            }
            Err(InvalidParameter::Lambda) => 1,
            Err(InvalidParameter::Epsilon) => 2,
            Err(InvalidParameter::NearDistance) => 3,
        }
    }

    /// Packs what the last `sample` chose, nearest bands of depth first where asked; nothing where it failed or there was
    /// none.
    pub fn pack(&mut self, near_points_first: bool, latency_test: bool) {
        let (frame, mut chosen, depth_measure): (&[Point], &[u32], _) = match (self.sampled, &self.grid) {
            (Sampled::Frame { points, depth_measure }, _) => {
                (bytemuck::must_cast_slice(&self.frame[..points]), self.sampler.chosen(), depth_measure)
            }
            (Sampled::Images, Some(grid)) => {
                let chosen = self.sampler.chosen();
                grid.gather(&self.depth, &self.colour, chosen, &mut self.gathered);
                self.numbers.clear();
                self.numbers.extend(0..chosen.len() as u32);
                (&self.gathered, &self.numbers, DepthMeasure::Z)
            }
            _ => (&[], &[], DepthMeasure::Z),
        };
        if near_points_first {
            near_first(frame, chosen, depth_measure, &mut self.ordered);
            chosen = &self.ordered;
        }
        let packed = pack(frame, chosen, self.layout, latency_test, &mut self.slots);
        self.report[7..].copy_from_slice(&[
            packed.packets as f64,
            packed.points as f64,
            packed.saturated as f64,
        ]);
    }
}

/// Packet slots and the points they unpack into.
#[wasm_bindgen]
pub struct Decoder {
    layout: SlotLayout,
    slots: Vec<u8>,
    counts: Vec<u16>,
    points: Vec<u64>,
}

#[wasm_bindgen]
impl Decoder {
    /// Room for `packets` packets, laid out as an encoder's. `undefined` where a full block does not fit into a slot.
    pub fn create(packets: usize, stride: usize, data_offset: usize) -> Option<Decoder> {
        let layout = SlotLayout::new(stride, data_offset)?;
        Some(Self {
            layout,
            slots: vec![0; packets * stride],
            counts: vec![0; packets],
            points: vec![0; packets * POINTS_PER_PACKET],
        })
    }

    /// The slots, one after another.
    pub fn slots_ptr(&self) -> *const u8 {
        self.slots.as_ptr()
    }

    /// The number of points of each slot.
    pub fn counts_ptr(&self) -> *const u16 {
        self.counts.as_ptr()
    }

    /// The unpacked points, 8 bytes each.
    pub fn points_ptr(&self) -> *const u64 {
        self.points.as_ptr()
    }

    /// Unpacks the first `packets` slots: the number of points, or −1 − the slot whose count is too large, or −1 − the
    /// capacity where `packets` is over it.
    pub fn unpack(&mut self, packets: usize) -> i32 {
        let Some(counts) = self.counts.get(..packets) else {
            return -1 - self.counts.len() as i32;
        };
        match unpack(&self.slots, self.layout, counts, &mut self.points) {
            Ok(points) => points as i32,
            Err(InvalidCount { slot }) => -1 - slot as i32,
        }
    }
}
