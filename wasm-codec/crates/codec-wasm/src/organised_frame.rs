//! The memory that a caller writes an organised frame into: as points, or as depth and colour images.

use farpoint_organised_codec::{Point, Source};
use wide::f32x4;

/// A frame of a fixed number of pixels.
pub struct OrganisedFrame {
    pub width: usize,
    pub height: usize,
    points: Vec<f32x4>,
    depth: Vec<f32>,
    colour: Vec<u32>,
}

impl OrganisedFrame {
    /// Without images: a caller that writes points needs none.
    pub fn new(width: usize, height: usize) -> Self {
        let points = vec![f32x4::ZERO; width * height];
        Self { width, height, points, depth: Vec::new(), colour: Vec::new() }
    }

    /// x, y, z and colour of each pixel.
    pub fn points(&self) -> &[Point] {
        bytemuck::must_cast_slice(&self.points)
    }

    /// Depth and colour. Both are made at the first call for either: memory that grows ends every view of it, and so would end
    /// the other image's.
    pub fn images(&mut self) -> (&[f32], &[u32]) {
        self.depth.resize(self.points.len(), 0.0);
        self.colour.resize(self.points.len(), 0);
        (&self.depth, &self.colour)
    }

    /// What the encoder reads: the images where they are asked for and have been made, else the points.
    pub fn source(&self, images: bool) -> Source<'_> {
        if images && !self.depth.is_empty() {
            Source::Images { depth: &self.depth, colour: &self.colour }
        } else {
            Source::Points(self.points())
        }
    }
}
