//! Packets to points.

use core::ops::Range;

use crate::emit::{Images, Outputs};
use crate::open_packet::{OpenPacket, Room, Scene};
use crate::packet::{PacketError, PacketHeader};
use crate::stream::StreamHeader;
use crate::surface::Surface;
use crate::tables::DecoderTables;
use crate::tile::{ColourMode, TILE};

/// What a packet brought.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Put {
    /// Where its points begin among the decoder's.
    pub start: usize,
    /// How many. Of a surface: how many of its pixels came, the others being filled in.
    pub points: usize,
    /// The first of the tiles that it says it has.
    pub first_tile: usize,
    /// How many tiles.
    pub tiles: usize,
    /// True where every point is pure green (a latency test).
    pub latency_test: bool,
}

/// Decodes the packets of one stream, frame by frame.
pub struct Decoder {
    scene: Scene,
    tables: DecoderTables,
    rooms: [Room; 2],
    /// int16 x, y, z in millimetres and 6-6-4 colour: 8 bytes a point.
    points: Vec<u64>,
    count: usize,
    /// Of the second of two packets, until it is known how many the first has.
    second_points: Vec<u64>,
    /// A bit for each tile that has come.
    come: Vec<u64>,
    outputs: Outputs,
    wants_surface: bool,
    has_images: bool,
}

impl Decoder {
    /// With `images`, depth and colour images are written too. `None` where a value of the header is outside its range.
    #[must_use]
    pub fn new(header: StreamHeader, images: bool) -> Option<Self> {
        if !header.is_valid() {
            return None;
        }
        let tables = DecoderTables::new(&header.index_frequencies);
        let scene = Scene::new(header);
        let pixels = scene.grid.width * scene.grid.height;
        Some(Self {
            tables,
            rooms: [Room::new(images), Room::new(images)],
            // And room for a row of a tile, of which not all need count.
            points: vec![0; pixels + TILE],
            count: 0,
            second_points: vec![0; pixels + TILE],
            come: vec![0; scene.grid.tiles().div_ceil(64)],
            outputs: Outputs {
                images: images.then(|| Images { depth: vec![0.0; pixels], colour: vec![0; pixels] }),
                surface: None,
            },
            wants_surface: false,
            has_images: images,
            scene,
        })
    }

    /// The stream's header.
    #[must_use]
    pub fn header(&self) -> &StreamHeader {
        &self.scene.header
    }

    /// Begins a frame: no points, empty images.
    pub fn begin(&mut self) {
        self.count = 0;
        self.come.fill(0);
        if self.wants_surface != self.outputs.surface.is_some() {
            let Scene { grid, header, .. } = &self.scene;
            self.outputs.surface = self.wants_surface.then(|| Surface::new(*grid, header.intrinsics.fx));
            let wants_rgba = self.wants_surface || self.has_images;
            self.rooms.iter_mut().for_each(|room| room.want_rgba(wants_rgba));
        }
        if let Some(images) = &mut self.outputs.images {
            images.depth.fill(0.0);
            images.colour.fill(0);
        }
    }

    /// Whether frames that begin from now on are surfaces instead of points and images.
    pub fn want_surface(&mut self, wanted: bool) {
        self.wants_surface = wanted;
    }

    /// The samples of a frame that is a surface, [`crate::TILE_SAMPLES`] for each tile: the inverse depth as a half float, 1/m, 0
    /// where nothing was seen, in the lower 16 bits, and the colour in 5-6-5 bits, R highest, in the upper. Only those of
    /// tiles that have come in the frame mean anything. Empty where the frame is none.
    #[must_use]
    pub fn samples(&self) -> &[u32] {
        self.outputs.surface.as_ref().map_or(&[], |surface| &surface.samples)
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
        self.outputs.images.as_ref().map_or(&[], |images| &images.depth)
    }

    /// Colours, R lowest.
    #[must_use]
    pub fn colour(&self) -> &[u32] {
        self.outputs.images.as_ref().map_or(&[], |images| &images.colour)
    }

    /// Decodes a packet and adds its points.
    ///
    /// # Errors
    /// See [`PacketError`]; nothing of the packet is kept then, save in the images, where a corrupt packet may have left pixels.
    pub fn put(&mut self, packet: &[u8]) -> Result<Put, PacketError> {
        let header = self.header_of(packet)?;
        let Self { scene, tables, rooms: [room, _], points, count, come, outputs, .. } = self;
        tables.choose(header.sets());
        let mut open = OpenPacket::new(header, packet, room, tables, scene, come, &mut points[*count..])?;
        let tiles = open.tiles();
        outputs.clear(&tiles);
        while open.has_tile() {
            open.decode_tile(outputs);
        }
        let points = open.finish()?;
        Ok(self.keep(&header, tiles, points))
    }

    /// As [`Decoder::put`] of one and then the other, in less time: where neither waits for the other's tables or tiles they are
    /// decoded side by side.
    ///
    /// # Errors
    /// Each packet's own.
    pub fn put_two(&mut self, packets: [&[u8]; 2]) -> [Result<Put, PacketError>; 2] {
        self.put_side_by_side(packets).unwrap_or_else(|| packets.map(|packet| self.put(packet)))
    }

    /// `None`, and nothing done, where that is not possible.
    fn put_side_by_side(&mut self, packets: [&[u8]; 2]) -> Option<[Result<Put, PacketError>; 2]> {
        let [Ok(first), Ok(second)] = packets.map(|packet| self.header_of(packet)) else { return None };
        if (first.sets(), first.mode) != (second.sets(), second.mode) {
            return None;
        }
        let Self {
            scene,
            tables,
            rooms: [room, other_room],
            points,
            count,
            second_points,
            come,
            outputs,
            ..
        } = self;
        tables.choose(first.sets());
        let points = &mut points[*count..];
        let mut one = OpenPacket::new(first, packets[0], room, tables, scene, come, points).ok()?;
        let mut other =
            OpenPacket::new(second, packets[1], other_room, tables, scene, come, second_points).ok()?;
        let (tiles, other_tiles) = (one.tiles(), other.tiles());
        if tiles.start < other_tiles.end && other_tiles.start < tiles.end {
            return None;
        }
        outputs.clear(&tiles);
        outputs.clear(&other_tiles);
        while one.has_tile() && other.has_tile() {
            OpenPacket::decode_tiles([&mut one, &mut other], outputs);
        }
        for rest in [&mut one, &mut other] {
            while rest.has_tile() {
                rest.decode_tile(outputs);
            }
        }
        let (points, other_points) = (one.finish(), other.finish());
        let put = points.map(|points| self.keep(&first, tiles, points));
        let other_put = other_points.map(|points| {
            if self.outputs.surface.is_none() {
                let own = &self.second_points[..points];
                self.points[self.count..][..points].copy_from_slice(own);
            }
            self.keep(&second, other_tiles, points)
        });
        Some([put, other_put])
    }

    fn header_of(&self, packet: &[u8]) -> Result<PacketHeader, PacketError> {
        let header = PacketHeader::parse(packet)?;
        if header.id == self.header().id { Ok(header) } else { Err(PacketError::UnknownStream) }
    }

    /// Keeps what a packet has written.
    fn keep(&mut self, header: &PacketHeader, tiles: Range<usize>, points: usize) -> Put {
        let (first_tile, tile_count) = (tiles.start, tiles.len());
        for tile in tiles {
            self.come[tile / 64] |= 1 << (tile % 64);
        }
        let start = self.count;
        self.count += points;
        Put { start, points, first_tile, tiles: tile_count, latency_test: header.mode == ColourMode::None }
    }
}
