//! How a frame is coded, and what became of it.

use crate::load::Left;
use crate::tile::ColourMode;

/// How a frame is coded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// 0 to 7: the depth error is at most 0.0625 · 2^level mm · z².
    pub depth_level: u8,
    /// Colour at all, and its chroma.
    pub mode: ColourMode,
    /// 0 to 31: step of colour, 0 the finest.
    pub quality: u8,
    /// Table set for geometry.
    pub geometry_set: u8,
    /// Table set for colour.
    pub colour_set: u8,
}

impl Default for Settings {
    fn default() -> Self {
        Self { depth_level: 3, mode: ColourMode::Subsampled, quality: 16, geometry_set: 0, colour_set: 0 }
    }
}

/// A packet of the last frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Packet {
    /// Where it begins in the encoder's bytes.
    pub start: usize,
    /// Its length.
    pub length: usize,
    /// Points in it.
    pub points: usize,
    /// The nearest inverse depth in it, in steps of the finest level.
    pub nearest: i32,
}

/// What the last pass made of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Frame {
    /// Packets.
    pub packets: usize,
    /// Bytes of all packets.
    pub bytes: usize,
    /// Points sent.
    pub points: usize,
    /// Pixels that carried none.
    pub left: Left,
    /// Valid points that the patterns left out.
    pub thinned: usize,
    /// Of these, points of tiles that would not have fitted into a packet.
    pub too_dense: usize,
}

/// How the tiles of a frame are coded: some finer, the others coarser.
#[derive(Clone, Copy)]
pub(crate) struct Mix {
    pub finer: Settings,
    pub coarser: Settings,
}
