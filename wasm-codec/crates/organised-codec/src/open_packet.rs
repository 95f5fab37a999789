//! A packet being decoded, tile by tile.

use core::ops::Range;

use crate::content_check::ContentCheck;
use crate::emit::{Outputs, View, emit, lies_within};
use crate::packet::{PacketError, PacketHeader, Span, header_bytes};
use crate::paint::{Colours, Palette};
use crate::rans::{self, Coder};
use crate::stream::StreamHeader;
use crate::syntax::{Neighbours, code_head, code_planes, code_tail, decode_planes};
use crate::tables::{COLOUR_SETS, DecoderTables, GEOMETRY_SETS};
use crate::tile::{Grid, TILE, Tile};

/// What all packets of a stream have in common.
pub(crate) struct Scene {
    pub header: StreamHeader,
    pub grid: Grid,
    palette: Palette,
    /// x at 1 m of each column, padded to whole tiles.
    columns: Vec<f32>,
    /// y at 1 m of each row.
    rows: Vec<f32>,
}

impl Scene {
    pub fn new(header: StreamHeader) -> Self {
        let grid = header.grid();
        let mut columns: Vec<f32> = header.intrinsics.columns(grid.width).collect();
        columns.resize(grid.columns * TILE, 0.0);
        let rows = header.intrinsics.rows(grid.height).collect();
        Self { grid, palette: Palette::new(&header.palette), columns, rows, header }
    }
}

/// Room that decoding a packet takes.
pub(crate) struct Room {
    body: rans::Body,
    tile: Tile,
    colours: Box<Colours>,
}

impl Room {
    /// With `images`, for colours of images too.
    pub fn new(images: bool) -> Self {
        Self { body: rans::Body::default(), tile: Tile::new(), colours: Box::new(Colours::new(images)) }
    }

    /// Whether colours of images are made from now on.
    pub fn want_rgba(&mut self, wanted: bool) {
        self.colours.wants_rgba = wanted;
    }
}

/// See the module. Where it has a tile, that one's head has been read.
pub(crate) struct OpenPacket<'a> {
    header: PacketHeader,
    scene: &'a Scene,
    coder: rans::Decoder<'a>,
    tile: &'a mut Tile,
    colours: &'a mut Colours,
    near: Neighbours,
    check: Option<ContentCheck>,
    span: Span,
    /// The tile that is being decoded; none where a fault was found or all have been.
    current: Option<usize>,
    next: usize,
    corrupt: bool,
    points: &'a mut [u64],
    count: usize,
    scale: f32,
}

impl<'a> OpenPacket<'a> {
    /// Goes to the first tile. `come` has a bit for each tile that has come before; `points` is where to write them.
    ///
    /// # Errors
    /// `Tiles`, `Duplicate`.
    pub fn new(
        header: PacketHeader,
        packet: &[u8],
        room: &'a mut Room,
        tables: &'a DecoderTables,
        scene: &'a Scene,
        come: &[u64],
        points: &'a mut [u64],
    ) -> Result<Self, PacketError> {
        const { assert!(GEOMETRY_SETS == 8 && COLOUR_SETS == 4) };
        room.body.load(&packet[header_bytes(header.mode)..]);
        let mut coder = rans::Decoder::new(&room.body, tables);
        let span = Span::from_raw(scene.grid, |bits| coder.raw(bits, 0));
        if span.tiles().end > scene.grid.tiles() {
            return Err(PacketError::Tiles);
        }
        if span.tiles().any(|tile| come[tile / 64] >> (tile % 64) & 1 == 1) {
            return Err(PacketError::Duplicate);
        }
        let mut packet = Self {
            scale: 1.0 / scene.header.depth_step(header.depth_level),
            check: (!header.mode.has_signs()).then(ContentCheck::default),
            header,
            scene,
            coder,
            tile: &mut room.tile,
            colours: &mut room.colours,
            near: Neighbours::new(),
            span,
            current: None,
            next: span.first,
            corrupt: false,
            points,
            count: 0,
        };
        packet.advance();
        Ok(packet)
    }

    /// The tiles that the packet says it has.
    pub fn tiles(&self) -> Range<usize> {
        self.span.tiles()
    }

    /// True where there is a tile to decode.
    pub fn has_tile(&self) -> bool {
        self.current.is_some()
    }

    /// Decodes the tile and goes to the next.
    pub fn decode_tile(&mut self, outputs: &mut Outputs) {
        code_planes(&mut self.coder, self.tile, &mut self.near, self.header.mode);
        self.finish_tile(outputs);
    }

    /// Decodes a tile of each of two packets of the same mode, side by side.
    pub fn decode_tiles([one, other]: [&mut Self; 2], outputs: &mut Outputs) {
        decode_planes(
            [&mut one.coder, &mut other.coder],
            [one.tile, other.tile],
            [&mut one.near, &mut other.near],
            one.header.mode,
        );
        one.finish_tile(outputs);
        other.finish_tile(outputs);
    }

    /// How many points there were; of a surface, how many of its pixels came.
    ///
    /// # Errors
    /// `Corrupt`, `Check`.
    pub fn finish(mut self) -> Result<usize, PacketError> {
        let held = self.check.as_ref().map(|_| self.coder.take_held());
        if self.corrupt || !self.coder.finished() {
            return Err(PacketError::Corrupt);
        }
        if held != self.check.map(|check| check.value(&self.header, self.span)) {
            return Err(PacketError::Check);
        }
        Ok(self.count)
    }

    /// To the next tile that is not empty.
    #[inline(never)]
    fn advance(&mut self) {
        self.current = None;
        while self.next < self.tiles().end && !self.corrupt {
            let index = self.next;
            self.next += 1;
            let place = self.scene.grid.place(index);
            let filled = code_head(&mut self.coder, self.tile, &mut self.near, place);
            self.corrupt = self.coder.overrun();
            if filled && !self.corrupt {
                self.current = Some(index);
                return;
            }
        }
    }

    fn finish_tile(&mut self, outputs: &mut Outputs) {
        if self.write_tile(outputs).is_none() {
            self.corrupt = true;
        }
        self.advance();
    }

    /// What follows a tile's planes, and its points. `None` where it says what no encoder says.
    #[inline(never)]
    fn write_tile(&mut self, outputs: &mut Outputs) -> Option<()> {
        let index = self.current?;
        let last = self.next == self.tiles().end;
        code_tail(&mut self.coder, self.tile, &mut self.near, self.header.mode, last);
        if self.coder.overrun() {
            return None;
        }
        if let Some(check) = &mut self.check {
            check.add_tile(index, self.tile, self.header.mode);
        }
        let Scene { grid, palette, columns, rows, .. } = self.scene;
        self.colours.paint(self.tile, &self.header, palette)?;
        let place = grid.place(index);
        if let Some(surface) = &mut outputs.surface {
            if !lies_within(self.tile, *grid, place) {
                return None;
            }
            self.count += surface.write(self.tile, self.colours, *grid, place, self.scale.recip());
            return Some(());
        }
        let view = View { grid: *grid, columns, rows, place, scale: self.scale };
        self.count = emit(self.tile, self.colours, &view, self.points, self.count, outputs.images.as_mut())?;
        Some(())
    }
}
