//! Packets to points.

use core::ops::Range;

use crate::content_check::ContentCheck;
use crate::emit::{Images, View, emit};
use crate::packet::{PacketError, PacketHeader, Span, header_bytes};
use crate::paint::{Colours, Palette};
use crate::rans::{self, Coder};
use crate::stream::StreamHeader;
use crate::syntax::{Neighbours, code_tile};
use crate::tables::{COLOUR_SETS, DecoderTables, GEOMETRY_SETS};
use crate::tile::{ColourMode, Grid, Kind, TILE, Tile};

/// What a packet brought.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Put {
    /// Where its points begin among the decoder's.
    pub start: usize,
    /// How many.
    pub points: usize,
    /// True where every point is pure green (a latency test).
    pub latency_test: bool,
}

/// Decodes the packets of one stream, frame by frame.
pub struct Decoder {
    header: StreamHeader,
    grid: Grid,
    tables: DecoderTables,
    body: rans::Body,
    /// x at 1 m of each column, padded to whole tiles.
    columns: Vec<f32>,
    /// y at 1 m of each row.
    rows: Vec<f32>,
    /// int16 x, y, z in millimetres and 6-6-4 colour: 8 bytes a point.
    points: Vec<u64>,
    palette: Palette,
    count: usize,
    /// A bit for each tile that has come.
    come: Vec<u64>,
    images: Option<Images>,
    tile: Tile,
    colours: Box<Colours>,
}

impl Decoder {
    /// With `images`, depth and colour images are written too. `None` where a value of the header is outside its range.
    #[must_use]
    pub fn new(header: StreamHeader, images: bool) -> Option<Self> {
        if !header.is_valid() {
            return None;
        }
        let grid = header.grid();
        let pixels = grid.width * grid.height;
        let mut columns: Vec<f32> = header.intrinsics.columns(grid.width).collect();
        columns.resize(grid.columns * TILE, 0.0);
        let palette = Palette::new(&header.palette);
        let tables = DecoderTables::new(&header.index_frequencies);
        let rows = header.intrinsics.rows(grid.height).collect();
        Some(Self {
            header,
            palette,
            grid,
            tables,
            body: rans::Body::default(),
            columns,
            rows,
            // And room for a row of a tile, of which not all need count.
            points: vec![0; pixels + TILE],
            count: 0,
            come: vec![0; grid.tiles().div_ceil(64)],
            images: images.then(|| Images { depth: vec![0.0; pixels], colour: vec![0; pixels] }),
            tile: Tile::new(),
            colours: Box::new(Colours::new(images)),
        })
    }

    /// The stream's header.
    #[must_use]
    pub fn header(&self) -> &StreamHeader {
        &self.header
    }

    /// Begins a frame: no points, empty images.
    pub fn begin(&mut self) {
        self.count = 0;
        self.come.fill(0);
        if let Some(images) = &mut self.images {
            images.depth.fill(0.0);
            images.colour.fill(0);
        }
    }

    /// The points of the frame so far, in the order of the packets.
    #[must_use]
    pub fn points(&self) -> &[u64] {
        &self.points[..self.count]
    }

    /// The whole buffer behind [`Decoder::points`], for a view.
    #[must_use]
    pub fn point_buffer(&self) -> &[u64] {
        &self.points
    }

    /// Depth in metres, 0 where there is none; empty where the decoder makes no images.
    #[must_use]
    pub fn depth(&self) -> &[f32] {
        self.images.as_ref().map_or(&[], |images| &images.depth)
    }

    /// Colours, R lowest.
    #[must_use]
    pub fn colour(&self) -> &[u32] {
        self.images.as_ref().map_or(&[], |images| &images.colour)
    }

    /// Decodes a packet and adds its points.
    ///
    /// # Errors
    /// See [`PacketError`]; nothing of the packet is kept then, save in the images, where a corrupt packet may have left pixels.
    pub fn put(&mut self, packet: &[u8]) -> Result<Put, PacketError> {
        let header = PacketHeader::parse(packet)?;
        if header.id != self.header.id {
            return Err(PacketError::UnknownStream);
        }
        self.body.load(&packet[header_bytes(header.mode)..]);
        let (tiles, count) = self.decode(&header)?;
        for tile in tiles {
            self.come[tile / 64] |= 1 << (tile % 64);
        }
        let start = core::mem::replace(&mut self.count, count);
        let latency_test = header.mode == ColourMode::None;
        Ok(Put { start, points: count - start, latency_test })
    }

    /// The packet's tiles, and the number of points with theirs.
    fn decode(&mut self, header: &PacketHeader) -> Result<(Range<usize>, usize), PacketError> {
        const { assert!(GEOMETRY_SETS == 8 && COLOUR_SETS == 4) };
        self.tables.choose((header.geometry_set, header.colour_set));
        let mut coder = rans::Decoder::new(&self.body, &self.tables);
        let span = Span::from_raw(self.grid, |bits| coder.raw(bits, 0));
        let (first, end) = (span.first, span.first + span.count);
        if end > self.grid.tiles() {
            return Err(PacketError::Tiles);
        }
        if (first..end).any(|tile| self.come[tile / 64] >> (tile % 64) & 1 == 1) {
            return Err(PacketError::Duplicate);
        }
        let mut check = (!header.mode.has_signs()).then(ContentCheck::default);
        let mut near = Neighbours::new();
        let scale = 1.0 / self.header.depth_step(header.depth_level);
        let mut count = self.count;
        for index in first..end {
            let place = self.grid.place(index);
            let last = index + 1 == end;
            code_tile(&mut coder, &mut self.tile, &mut near, place, header.mode, last);
            if coder.overrun() {
                return Err(PacketError::Corrupt);
            }
            if self.tile.kind == Kind::Empty {
                continue;
            }
            if let Some(check) = &mut check {
                check.add_tile(index, &self.tile, header.mode);
            }
            self.colours.paint(&self.tile, header, &self.palette).ok_or(PacketError::Corrupt)?;
            let view = View { grid: self.grid, columns: &self.columns, rows: &self.rows, place, scale };
            count = emit(&self.tile, &self.colours, &view, &mut self.points, count, self.images.as_mut())
                .ok_or(PacketError::Corrupt)?;
        }
        let held = check.as_ref().map(|_| coder.take_held());
        if !coder.finished() {
            return Err(PacketError::Corrupt);
        }
        if held != check.map(|check| check.value(header, span)) {
            return Err(PacketError::Check);
        }
        Ok((first..end, count))
    }
}
