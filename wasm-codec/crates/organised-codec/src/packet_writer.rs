//! Coded tiles to a frame's packets.

use core::cmp::Reverse;

use crate::content_check::ContentCheck;
use crate::frame::{Frame, Packet, Settings};
use crate::packet::{MAX_PACKET_BYTES, PacketHeader, Span, header_bytes, seal};
use crate::rans::{Held, Mark, PacketTokens, TileTokens, WORDS};
use crate::stream::StreamHeader;
use crate::tables::EncoderTables;
use crate::tile::Grid;

/// Tiles of the packet being filled, up to the last one that is not empty.
#[derive(Clone, Copy, Default)]
pub(crate) struct Filled {
    pub tiles: usize,
    /// Where their tokens end.
    pub mark: Mark,
    pub points: usize,
    /// The largest inverse depth, in steps of the finest level.
    pub nearest: i32,
    /// Over the tiles' content, where the colour has no signs.
    pub check: ContentCheck,
}

/// Collects the tokens of one packet at a time, and the bytes of all packets of a frame.
pub(crate) struct PacketWriter {
    id: u8,
    grid: Grid,
    tokens: PacketTokens,
    words: Box<[u16; WORDS]>,
    bytes: Vec<u8>,
    packets: Vec<Packet>,
}

impl PacketWriter {
    pub fn new(header: &StreamHeader) -> Self {
        let grid = header.grid();
        Self {
            id: header.id,
            grid,
            tokens: PacketTokens::default(),
            words: Box::new([0; WORDS]),
            bytes: Vec::with_capacity(grid.width * grid.height),
            packets: Vec::with_capacity(grid.tiles()),
        }
    }

    /// The packets of the frame so far.
    pub fn packets(&self) -> &[Packet] {
        &self.packets
    }

    /// The bytes of a packet.
    pub fn packet(&self, index: usize) -> &[u8] {
        let Packet { start, length, .. } = self.packets[index];
        &self.bytes[start..start + length]
    }

    /// Bytes of all packets.
    pub fn len(&self) -> usize {
        self.bytes.len()
    }

    /// Forgets the last frame's packets.
    pub fn begin_frame(&mut self) {
        self.bytes.clear();
        self.packets.clear();
    }

    /// Forgets the tokens of the packet before.
    pub fn begin_packet(&mut self) {
        self.tokens.clear();
    }

    /// Adds a tile to the packet.
    #[inline]
    pub fn push(&mut self, tile: &TileTokens) {
        self.tokens.push(tile);
    }

    /// Where the packet's tokens end.
    #[inline]
    pub fn mark(&self) -> Mark {
        self.tokens.mark()
    }

    /// Adds a packet of the tiles from `first` on; false, and nothing added, where it would be too long.
    pub fn write(
        &mut self,
        tables: &EncoderTables,
        first: usize,
        filled: &Filled,
        settings: &Settings,
    ) -> bool {
        self.tokens.rewind(filled.mark);
        let start = self.bytes.len();
        let header = PacketHeader {
            id: self.id,
            geometry_set: settings.geometry_set,
            colour_set: settings.colour_set,
            mode: settings.mode,
            depth_level: settings.depth_level,
            quality: settings.quality,
        };
        let header_bytes = header_bytes(header.mode);
        self.bytes.extend_from_slice(&header.to_bytes()[..header_bytes]);
        let limit = MAX_PACKET_BYTES - header_bytes;
        let span = Span { first, count: filled.tiles };
        let held = if header.mode.has_signs() {
            Held::Signs
        } else {
            Held::Check(filled.check.value(&header, span))
        };
        let span = span.to_raw(self.grid);
        if !self.tokens.write(tables, &span, held, &mut self.words, limit, &mut self.bytes) {
            self.bytes.truncate(start);
            return false;
        }
        seal(&mut self.bytes[start..]);
        let length = self.bytes.len() - start;
        self.packets.push(Packet { start, length, points: filled.points, nearest: filled.nearest });
        true
    }

    /// Puts near packets first: what is sent first is lost last.
    pub fn sort_near_first(&mut self) {
        self.packets.sort_by_key(|packet| (Reverse(packet.nearest), packet.start));
    }

    /// Drops packets, the last first, until no more than `limit` bytes are left; the number of points lost.
    pub fn drop_last(&mut self, limit: usize, frame: &mut Frame) -> usize {
        let mut dropped = 0;
        while frame.bytes > limit {
            let Some(packet) = self.packets.pop() else { break };
            frame.bytes -= packet.length;
            frame.points -= packet.points;
            frame.packets -= 1;
            dropped += packet.points;
        }
        dropped
    }
}
