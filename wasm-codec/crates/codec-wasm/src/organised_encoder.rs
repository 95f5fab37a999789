//! Bindings of the organised encoder. As in `lib.rs`, frames and packets lie in the module's memory and calls pass numbers.

use farpoint_organised_codec::packet::MAX_PACKET_BYTES;
use farpoint_organised_codec::stream::DEPTH_UNIT;
use farpoint_organised_codec::{
    Budget, BudgetColour, ColourMode, Encoder, Frame, Intrinsics, Misfit, Settings, StreamHeader, Validity,
    check_grid, estimate_intrinsics, with_palette,
};
use wasm_bindgen::prelude::*;

use crate::organised_frame::OrganisedFrame;

/// How many numbers [`OrganisedEncoder::report_ptr`] points to.
const REPORT_LENGTH: usize = 20;

/// A frame, its coder and the packet slots it is coded into.
#[wasm_bindgen]
pub struct OrganisedEncoder {
    frame: OrganisedFrame,
    encoder: Option<Encoder>,
    /// Of the last frame.
    settings: Settings,
    stride: usize,
    data_offset: usize,
    slots: Vec<u8>,
    /// Bytes and points of each packet.
    lengths: Vec<u32>,
    report: Box<[f64; REPORT_LENGTH]>,
}

#[wasm_bindgen]
impl OrganisedEncoder {
    /// For frames of `width` × `height` pixels; a packet begins `data_offset` bytes into each `stride` bytes. `undefined`
    /// where a packet does not fit into a slot or an image has no pixels.
    pub fn create(
        width: usize,
        height: usize,
        stride: usize,
        data_offset: usize,
    ) -> Option<OrganisedEncoder> {
        let fits = data_offset.checked_add(MAX_PACKET_BYTES).is_some_and(|end| end <= stride);
        if !fits || width == 0 || height == 0 || width > 4080 || height > 4080 {
            return None;
        }
        Some(Self {
            frame: OrganisedFrame::new(width, height),
            encoder: None,
            settings: Settings::default(),
            stride,
            data_offset,
            slots: Vec::new(),
            lengths: Vec::new(),
            report: Box::default(),
        })
    }

    /// 4 floats a point.
    pub fn frame_ptr(&self) -> *const f32 {
        self.frame.points().as_ptr().cast()
    }

    /// A float a pixel.
    pub fn depth_ptr(&mut self) -> *const f32 {
        self.frame.images().0.as_ptr()
    }

    /// 4 bytes a pixel.
    pub fn colour_ptr(&mut self) -> *const u32 {
        self.frame.images().1.as_ptr()
    }

    /// The slots of the last frame.
    pub fn slots_ptr(&self) -> *const u8 {
        self.slots.as_ptr()
    }

    /// Bytes and points of each packet of the last frame, two numbers a packet.
    pub fn lengths_ptr(&self) -> *const u32 {
        self.lengths.as_ptr()
    }

    /// After `encode` and `encode_within`: packets, bytes, points; not finite, depth not positive, out of range, thinned,
    /// too dense, dropped; depth level, quality, mode, passes. After `estimate` and `check`, from 16 on: fx, fy, cx, cy;
    /// or pixels off the grid.
    pub fn report_ptr(&self) -> *const f64 {
        self.report.as_ptr()
    }

    fn misfit(&mut self, misfit: Misfit) -> u32 {
        match misfit {
            Misfit::Shape => 1,
            Misfit::TooFew => 2,
            Misfit::Focal => 3,
            Misfit::OffGrid { pixels } => {
                self.report[16] = f64::from(pixels);
                4
            }
        }
    }

    /// Finds the camera by the frame: 0, or 1 shape, 2 too few points, 3 no camera's focal length, 4 off the grid.
    pub fn estimate(&mut self) -> u32 {
        match estimate_intrinsics(self.frame.points(), self.frame.width, self.frame.height) {
            Ok(Intrinsics { fx, fy, cx, cy }) => {
                self.report[16..].copy_from_slice(&[fx, fy, cx, cy].map(f64::from));
                0
            }
            Err(misfit) => self.misfit(misfit),
        }
    }

    /// Whether the frame lies on the camera's grid; as `estimate`.
    pub fn check(&mut self, fx: f32, fy: f32, cx: f32, cy: f32) -> u32 {
        let OrganisedFrame { width, height, .. } = self.frame;
        let result = check_grid(self.frame.points(), width, height, &Intrinsics { fx, fy, cx, cy });
        result.map_or_else(|misfit| self.misfit(misfit), |()| 0)
    }

    /// Begins a stream and returns its header: empty where a value is outside its range. With `palette`, the frame's colours
    /// become the palette; empty where they are too many.
    #[allow(
        clippy::too_many_arguments,
        reason = "numbers cross this border without an allocation, objects do not"
    )]
    pub fn begin(
        &mut self,
        id: u8,
        fx: f32,
        fy: f32,
        cx: f32,
        cy: f32,
        palette: bool,
        images: bool,
    ) -> Vec<u8> {
        let mut header = StreamHeader {
            id,
            width: self.frame.width as u16,
            height: self.frame.height as u16,
            intrinsics: Intrinsics { fx, fy, cx, cy },
            depth_unit: DEPTH_UNIT,
            palette: Vec::new(),
            index_frequencies: Vec::new(),
        };
        if palette {
            match with_palette(header, self.frame.source(images)) {
                Some(found) => header = found,
                None => return Vec::new(),
            }
        }
        let bytes = header.to_bytes();
        match Encoder::new(header) {
            Some(encoder) => {
                self.encoder = Some(encoder);
                bytes
            }
            None => Vec::new(),
        }
    }

    /// Codes the frame with fixed settings. `mode`: 0 no colour, 1 chroma subsampled, 2 full chroma, 3 palette. `density`: of
    /// the nearest points' pixels, 1 or more to keep all of those; 0 for no thinning. False before `begin`.
    #[allow(
        clippy::too_many_arguments,
        reason = "numbers cross this border without an allocation, objects do not"
    )]
    pub fn encode(
        &mut self,
        images: bool,
        depth_level: u8,
        mode: u8,
        quality: u8,
        density: f32,
        lambda: f32,
        epsilon: f32,
        near_distance: f32,
    ) -> bool {
        let Some(mut encoder) = self.encoder.take() else { return false };
        let mode = match mode {
            0 => ColourMode::None,
            1 => ColourMode::Subsampled,
            2 => ColourMode::Full,
            _ => ColourMode::Palette,
        };
        let mut settings = Settings {
            depth_level: depth_level.min(7),
            mode,
            quality: quality.min(31),
            geometry_set: 0,
            colour_set: 0,
        };
        let source = self.frame.source(images);
        if density > 0.0 {
            encoder.thin_to(source, &Validity { lambda, epsilon, near_distance }, density);
        } else {
            encoder.patterns().fill_with(Default::default);
        }
        encoder.choose_tables(source, &mut settings);
        let frame = encoder.encode(source, &settings).unwrap_or_default();
        self.finish(encoder, &frame, &settings, 0, 1);
        true
    }

    /// Codes the frame in at most so many bytes. `colour`: 0 as suits the depth, 1 coarse, 2 palette. False before `begin`.
    #[allow(
        clippy::too_many_arguments,
        reason = "numbers cross this border without an allocation, objects do not"
    )]
    pub fn encode_within(
        &mut self,
        images: bool,
        bytes: usize,
        latency_test: bool,
        colour: u8,
        lambda: f32,
        epsilon: f32,
        near_distance: f32,
    ) -> bool {
        let Some(mut encoder) = self.encoder.take() else { return false };
        let validity = Validity { lambda, epsilon, near_distance };
        let colour = match colour {
            0 => BudgetColour::Suited,
            1 => BudgetColour::Coarse,
            _ => BudgetColour::Palette,
        };
        let budget = Budget { bytes, validity, latency_test, colour };
        let spent = encoder.encode_within(self.frame.source(images), &budget);
        match spent {
            Some(spent) => self.finish(encoder, &spent.frame, &spent.settings, spent.dropped, spent.passes),
            None => self.encoder = Some(encoder),
        }
        spent.is_some()
    }

    fn finish(
        &mut self,
        encoder: Encoder,
        frame: &Frame,
        settings: &Settings,
        dropped: usize,
        passes: usize,
    ) {
        let packets = encoder.packets();
        if self.slots.len() < packets.len() * self.stride {
            self.slots.resize(packets.len() * self.stride, 0);
        }
        self.lengths.clear();
        for (index, (packet, slot)) in
            packets.iter().zip(self.slots.chunks_exact_mut(self.stride)).enumerate()
        {
            slot[self.data_offset..][..packet.length].copy_from_slice(encoder.packet(index));
            self.lengths.extend([packet.length as u32, packet.points as u32]);
        }
        let numbers = [
            frame.packets,
            frame.bytes,
            frame.points,
            frame.left.not_finite as usize,
            frame.left.non_positive_depth as usize,
            frame.left.out_of_range as usize,
            frame.thinned,
            frame.too_dense,
            dropped,
            settings.depth_level.into(),
            settings.quality.into(),
            settings.mode as usize,
            passes,
        ];
        for (place, number) in self.report.iter_mut().zip(numbers) {
            *place = number as f64;
        }
        self.settings = *settings;
        self.encoder = Some(encoder);
    }

    /// What the last frame would take in one packet of any length, bits, coded as most of it was; 0 before `begin`.
    pub fn bits_in_one_packet(&mut self, images: bool) -> f64 {
        let Some(mut encoder) = self.encoder.take() else { return 0.0 };
        let bits = encoder.bits_in_one_packet(self.frame.source(images), &self.settings);
        self.encoder = Some(encoder);
        bits
    }
}
