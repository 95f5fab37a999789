//! Frames to packets.

use crate::contexts::{COLOUR_CONTEXTS, GEOMETRY_CONTEXTS, INDEX, INDEX_CONTEXTS, SYMBOLS};
use crate::load::{Left, Loaded, MAX_COORDINATE, Quantiser, Source};
use crate::palette::{Palette, find_palette};
use crate::rans::{self, Counter, Tokens};
use crate::rate::RateState;
use crate::stream::{MAX_PACKET_BYTES, PACKET_HEADER_BYTES, PacketHeader, StreamHeader};
use crate::syntax::{Neighbours, code_tile};
use crate::tables::{COLOUR_SETS, GEOMETRY_SETS, Tables, normalise};
use crate::thinning::{Validity, halvings, pattern, tile_depths};
use crate::tile::{ColourMode, Grid, Kind, LAST_TRANSFORMED, Pattern, Place, TILE, Tile};
use crate::transform::{forward, plane_step, point_step, quantise, to_ycocg};

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

/// Codes frames of one stream.
pub struct Encoder {
    header: StreamHeader,
    grid: Grid,
    tables: Tables,
    quantiser: Quantiser,
    /// Of every tile.
    patterns: Vec<Pattern>,
    loaded: Loaded,
    tile: Tile,
    tokens: Tokens,
    bytes: Vec<u8>,
    packets: Vec<Packet>,
    scratch: Box<[u8; MAX_PACKET_BYTES]>,
    palette: Palette,
    rate: RateState,
    /// Tiles that the finer of two settings is for; empty where there is one only.
    finer_tiles: Vec<bool>,
    geometry_counts: Vec<u32>,
    colour_counts: Vec<u32>,
}

/// How the tiles of a frame are coded: a packet is coded as its first tile should be.
#[derive(Clone, Copy)]
pub(crate) struct Mix {
    pub finer: Settings,
    pub coarser: Settings,
}

/// The packet being filled.
struct Open {
    settings: Settings,
    first: usize,
    /// Tiles up to the last that is not empty, and the tokens for them.
    count: usize,
    mark: (usize, u32),
    points: usize,
    nearest: i32,
    near: Neighbours,
}

impl Encoder {
    /// `None` where a value of the header is outside its range.
    #[must_use]
    pub fn new(header: StreamHeader) -> Option<Self> {
        if !header.is_valid() {
            return None;
        }
        let grid = header.grid();
        let limits = |rays: &mut dyn Iterator<Item = f32>, length: usize| {
            let mut limits: Vec<f32> = rays.map(|ray| MAX_COORDINATE / ray.abs().max(1.0)).collect();
            limits.resize(length, 0.0);
            limits
        };
        let quantiser = Quantiser {
            scale: 0.0,
            column_limits: limits(&mut header.intrinsics.columns(grid.width), grid.columns * TILE),
            row_limits: limits(&mut header.intrinsics.rows(grid.height), grid.rows * TILE),
        };
        Some(Self {
            grid,
            tables: Tables::new(&header.index_frequencies),
            quantiser,
            patterns: vec![Pattern(0); grid.tiles()],
            loaded: Loaded::new(),
            tile: Tile::new(),
            tokens: Tokens::with_capacity(1 << 15),
            bytes: Vec::with_capacity(grid.width * grid.height),
            packets: Vec::with_capacity(grid.tiles()),
            scratch: Box::new([0; MAX_PACKET_BYTES]),
            palette: Palette::new(&header.palette),
            rate: RateState::default(),
            finer_tiles: Vec::new(),
            geometry_counts: vec![0; GEOMETRY_CONTEXTS * SYMBOLS],
            colour_counts: vec![0; COLOUR_CONTEXTS * SYMBOLS],
            header,
        })
    }

    /// The stream's header.
    #[must_use]
    pub fn header(&self) -> &StreamHeader {
        &self.header
    }

    /// The pattern of every tile for the next frames.
    pub fn patterns(&mut self) -> &mut [Pattern] {
        &mut self.patterns
    }

    /// The packets of the last frame.
    #[must_use]
    pub fn packets(&self) -> &[Packet] {
        &self.packets
    }

    /// The bytes of a packet of the last frame.
    #[must_use]
    pub fn packet(&self, index: usize) -> &[u8] {
        let Packet { start, length, .. } = self.packets[index];
        &self.bytes[start..start + length]
    }

    /// Codes a frame. `None` where it has not the header's number of pixels.
    pub fn encode(&mut self, source: Source<'_>, settings: &Settings) -> Option<Frame> {
        self.finer_tiles.clear();
        self.encode_mixed(source, &Mix { finer: *settings, coarser: *settings })
    }

    /// Which tiles [`Mix::finer`] is for: one flag a tile.
    pub(crate) fn finer_tiles(&mut self) -> &mut Vec<bool> {
        &mut self.finer_tiles
    }

    pub(crate) fn encode_mixed(&mut self, source: Source<'_>, mix: &Mix) -> Option<Frame> {
        if source.len() != self.grid.width * self.grid.height {
            return None;
        }
        self.bytes.clear();
        self.packets.clear();
        let mut frame = Frame::default();
        let mut open: Option<Open> = None;
        for index in 0..self.grid.tiles() {
            let place = self.grid.place(index);
            let wanted =
                if self.finer_tiles.get(index).copied().unwrap_or(true) { mix.finer } else { mix.coarser };
            let mut settings = open.as_ref().map_or(wanted, |packet| packet.settings);
            let before = frame.left;
            self.load(source, place, &settings, &mut frame.left);
            if self.loaded.valid == 0 && open.is_none() {
                continue;
            }
            let mut pattern = self.patterns[index];
            prepare(&self.loaded, &mut self.tile, pattern, &settings, &self.palette);
            loop {
                let packet = open.get_or_insert_with(|| {
                    self.tokens.clear();
                    Open {
                        settings,
                        first: index,
                        count: 0,
                        mark: (0, 0),
                        points: 0,
                        nearest: 0,
                        near: Neighbours::new(),
                    }
                });
                self.tokens.reserve_tile();
                let mut coder = rans::Encoder {
                    tokens: &mut self.tokens,
                    costs: self.tables.costs(),
                    geometry: Tables::geometry_base(settings.geometry_set.into()),
                    colour: Tables::colour_base(settings.colour_set.into()),
                };
                let (row, edge) = (place.row_in_strip, place.column == 0);
                code_tile(&mut coder, &mut self.tile, &mut packet.near, row, edge, settings.mode);
                if self.tokens.cost() <= COST_LIMIT {
                    let valid = self.loaded.valid as usize;
                    if self.tile.kind != Kind::Empty {
                        packet.count = index + 1 - packet.first;
                        packet.mark = self.tokens.mark();
                        packet.points += self.tile.valid();
                        packet.nearest = packet.nearest.max(nearest(&self.tile, settings.depth_level));
                        frame.thinned += valid - self.tile.valid();
                        if pattern != self.patterns[index] {
                            frame.too_dense += valid - self.tile.valid();
                        }
                    } else {
                        frame.thinned += valid;
                    }
                    break;
                }
                if packet.count > 0 {
                    let full = open.take().expect("a packet");
                    self.close(full, &mut frame);
                    if settings != wanted {
                        settings = wanted;
                        frame.left = before;
                        self.load(source, place, &settings, &mut frame.left);
                        prepare(&self.loaded, &mut self.tile, pattern, &settings, &self.palette);
                    }
                    if self.loaded.valid == 0 {
                        break;
                    }
                } else {
                    // A tile that no packet can hold: half of its points, and so on.
                    open = None;
                    pattern = Pattern((pattern.0 + 1).min(Pattern::COUNT - 1));
                    prepare(&self.loaded, &mut self.tile, pattern, &settings, &self.palette);
                }
            }
        }
        if let Some(last) = open.take() {
            self.close(last, &mut frame);
        }
        // Near packets first: what is sent first is lost last.
        self.packets.sort_by_key(|packet| (core::cmp::Reverse(packet.nearest), packet.start));
        frame.packets = self.packets.len();
        frame.bytes = self.bytes.len();
        Some(frame)
    }

    fn load(&mut self, source: Source<'_>, place: Place, settings: &Settings, left: &mut Left) {
        self.quantiser.scale = 1.0 / self.header.depth_step(settings.depth_level);
        self.quantiser.load(source, self.grid, place, &mut self.loaded, left);
    }

    fn close(&mut self, packet: Open, frame: &mut Frame) {
        if packet.count == 0 {
            return;
        }
        let settings = &packet.settings;
        self.tokens.rewind(packet.mark);
        // The limit leaves room for what the estimate may be wrong by.
        let at = self.tokens.write(&self.tables, &mut self.scratch[..]).expect("a packet within its limit");
        let start = self.bytes.len();
        let header = PacketHeader {
            id: self.header.id,
            geometry_set: settings.geometry_set,
            colour_set: settings.colour_set,
            mode: settings.mode,
            depth_level: settings.depth_level,
            quality: settings.quality,
            first: packet.first as u16,
            count: packet.count as u16,
        };
        self.bytes.extend_from_slice(&[0; PACKET_HEADER_BYTES]);
        self.bytes.extend_from_slice(&self.scratch[at..]);
        header.write(&mut self.bytes[start..]);
        let length = self.bytes.len() - start;
        self.packets.push(Packet { start, length, points: packet.points, nearest: packet.nearest });
        frame.points += packet.points;
    }

    /// Counts the symbols of one run of `per_packet` tiles in `step`, each as a packet would code it, and returns how many
    /// times as many tiles there are.
    pub fn count(
        &mut self,
        source: Source<'_>,
        settings: &Settings,
        per_packet: usize,
        step: usize,
        counter: &mut Counter<'_>,
    ) -> f32 {
        self.quantiser.scale = 1.0 / self.header.depth_step(settings.depth_level);
        let mut near = Neighbours::new();
        let mut left = Left::default();
        let tiles = self.grid.tiles();
        let mut seen = 0;
        for index in 0..tiles {
            // Every column of the image has its turn.
            let run = index / per_packet;
            if step > 1 && !(run + run / step).is_multiple_of(step) {
                continue;
            }
            if index % per_packet == 0 {
                near = Neighbours::new();
            }
            seen += 1;
            let place = self.grid.place(index);
            self.quantiser.load(source, self.grid, place, &mut self.loaded, &mut left);
            prepare(&self.loaded, &mut self.tile, self.patterns[index], settings, &self.palette);
            code_tile(
                counter,
                &mut self.tile,
                &mut near,
                place.row_in_strip,
                place.column == 0,
                settings.mode,
            );
        }
        if seen == 0 { 0.0 } else { tiles as f32 / seen as f32 }
    }
}

/// What the symbols of a packet may cost, in 1/256 bit: 32 bits and more fit into the states, and the estimate is off by a
/// fraction of a bit in a hundred.
const COST_LIMIT: u32 = ((MAX_PACKET_BYTES - PACKET_HEADER_BYTES - 8) * 8) as u32 * 256;

fn nearest(tile: &Tile, depth_level: u8) -> i32 {
    let (width, height) = (tile.pattern.width(), tile.pattern.height());
    // Pixels that are not valid hold predictions from valid ones.
    let rows = (0..height).flat_map(|y| &tile.depth[Tile::at(0, y)..Tile::at(width, y)]);
    rows.copied().max().unwrap_or(0) << depth_level
}

/// Makes of a loaded tile what the syntax codes.
fn prepare(loaded: &Loaded, tile: &mut Tile, pattern: Pattern, settings: &Settings, palette: &Palette) {
    tile.pattern = pattern;
    let (width, height) = (pattern.width(), pattern.height());
    let mut rgba = [0_u32; TILE * TILE];
    tile.rows = [0; TILE];
    let mut valid = 0;
    if pattern.0 == 0 {
        tile.rows = loaded.rows;
        valid = loaded.valid as usize;
        rgba = loaded.rgba;
        for y in 0..TILE {
            let row = &loaded.depth[y * TILE..(y + 1) * TILE];
            tile.depth[Tile::at(0, y)..Tile::at(TILE, y)].copy_from_slice(row);
        }
    } else if loaded.valid > 0 {
        for y in 0..height {
            for x in 0..width {
                let (u, v) = pattern.pixel(x, y);
                tile.depth[Tile::at(x, y)] = loaded.depth[v * TILE + u];
                rgba[y * TILE + x] = loaded.rgba[v * TILE + u];
                tile.rows[y] |= (loaded.rows[v] >> u & 1) << x;
            }
        }
        valid = tile.valid();
    }
    tile.kind = match valid {
        0 => Kind::Empty,
        _ if valid == width * height => Kind::Full,
        _ => Kind::Mixed,
    };
    if tile.kind == Kind::Empty || settings.mode == ColourMode::None {
        return;
    }
    if settings.mode == ColourMode::Palette {
        for y in 0..height {
            for x in 0..width {
                if tile.rows[y] >> x & 1 == 1 {
                    tile.index[Tile::at(x, y)] = palette.index(rgba[y * TILE + x]);
                }
            }
        }
    } else if pattern <= LAST_TRANSFORMED {
        if tile.kind == Kind::Mixed {
            fill(&mut rgba, &tile.rows, width, height);
        }
        transform_blocks(&rgba, tile, settings);
    } else {
        let step = point_step(settings.quality.into());
        let mut at = 0;
        for y in 0..height {
            for x in 0..width {
                if tile.rows[y] >> x & 1 == 1 {
                    // Times 4 in, steps in 1/16.
                    tile.points[at] = to_ycocg(rgba[y * TILE + x]).map(|c| {
                        let c = 4 * c;
                        (c + (step / 2) * c.signum()) / step
                    });
                    at += 1;
                }
            }
        }
    }
}

/// Gives pixels that are not valid the colour of the valid one to their left, or above.
fn fill(rgba: &mut [u32; TILE * TILE], rows: &[u16; TILE], width: usize, height: usize) {
    let first = rows[..height].iter().position(|row| *row != 0).unwrap_or(0);
    let mut above = first * TILE + (rows[first].trailing_zeros() as usize).min(TILE - 1);
    for y in 0..height {
        let row = rows[y];
        if row == 0 {
            if y > 0 {
                rgba.copy_within((y - 1) * TILE..y * TILE, y * TILE);
            } else {
                let colour = rgba[above];
                rgba[..TILE].fill(colour);
            }
            continue;
        }
        if row >> (width - 1) == 1 && row.count_ones() as usize == width {
            above = y * TILE;
            continue;
        }
        let mut colour = rgba[above];
        if row & 1 == 0 {
            colour = rgba[y * TILE + row.trailing_zeros() as usize];
        }
        for x in 0..width {
            if row >> x & 1 == 1 {
                colour = rgba[y * TILE + x];
            } else {
                rgba[y * TILE + x] = colour;
            }
        }
        above = y * TILE;
    }
}

fn transform_blocks(rgba: &[u32; TILE * TILE], tile: &mut Tile, settings: &Settings) {
    use wide::{f32x8, i32x8};
    let subsampled = settings.mode == ColourMode::Subsampled;
    let width = tile.pattern.width();
    let mut planes = [[0_i32; TILE * TILE]; 3];
    {
        let [luma, orange, green] = &mut planes;
        for ((pixel, y), (co, cg)) in rgba.iter().zip(luma).zip(orange.iter_mut().zip(green)) {
            [*y, *co, *cg] = to_ycocg(*pixel);
        }
    }
    if subsampled && tile.pattern.0 < 2 {
        for plane in &mut planes[1..] {
            halve(plane, width == TILE);
        }
    }
    let mut index = 0;
    for (plane, pixels) in planes.iter().enumerate() {
        let (columns, rows) = settings.mode.blocks(tile.pattern, plane);
        let step = plane_step(settings.quality.into(), plane, subsampled);
        for by in 0..rows {
            for bx in 0..columns {
                let block: [f32x8; 8] = core::array::from_fn(|y| {
                    let at = (by * 8 + y) * TILE + bx * 8;
                    let row: [i32; 8] = *pixels[at..at + 8].first_chunk().expect("eight pixels");
                    f32x8::from_i32x8(i32x8::from(row))
                });
                quantise(&forward(&block), step, &mut tile.blocks[index]);
                index += 1;
            }
        }
    }
}

/// Means of 2 × 2 pixels, or of 1 × 2 where the tile is 8 wide, into the upper left 8 × 8.
fn halve(plane: &mut [i32; TILE * TILE], wide: bool) {
    for y in 0..8 {
        for x in 0..8 {
            let upper = 2 * y * TILE;
            let lower = upper + TILE;
            plane[y * TILE + x] = if wide {
                (plane[upper + 2 * x]
                    + plane[upper + 2 * x + 1]
                    + plane[lower + 2 * x]
                    + plane[lower + 2 * x + 1]
                    + 2)
                    >> 2
            } else {
                (plane[upper + x] + plane[lower + x] + 1) >> 1
            };
        }
    }
}

impl Encoder {
    pub(crate) fn rate(&mut self) -> &mut RateState {
        &mut self.rate
    }

    /// Thins by validity alone: the nearest tiles keep `density` of their points, farther ones less.
    pub fn thin_to(&mut self, source: Source<'_>, validity: &Validity, density: f32) {
        if source.len() != self.grid.width * self.grid.height {
            return;
        }
        let mut depths = Vec::new();
        tile_depths(source, self.grid, &mut depths);
        halvings(validity, &mut depths);
        let shift = -density.clamp(1e-3, 1e6).log2();
        for (tile, (own, halvings)) in self.patterns.iter_mut().zip(&depths).enumerate() {
            *own = pattern(tile, *halvings, shift);
        }
    }

    /// Sets the table sets that code a sample of the frame in the fewest bits.
    pub fn choose_tables(&mut self, source: Source<'_>, settings: &mut Settings) {
        self.estimate(source, settings);
    }

    /// What a frame would cost with the best table sets, bytes, by a sample of it; the sets are put into `settings`.
    pub(crate) fn estimate(&mut self, source: Source<'_>, settings: &mut Settings) -> f32 {
        let mut geometry = core::mem::take(&mut self.geometry_counts);
        let mut colour = core::mem::take(&mut self.colour_counts);
        geometry.fill(0);
        colour.fill(0);
        let mut counter = Counter { geometry: &mut geometry, colour: &mut colour, raw_bits: 0 };
        let share = self.count(source, settings, SAMPLE_TILES, SAMPLE_STEP, &mut counter);
        let raw_bits = counter.raw_bits;
        let cost = |counts: &[u32], base: usize| -> u64 {
            let costs = &self.tables.costs()[base..base + counts.len()];
            counts.iter().zip(costs).map(|(count, cost)| u64::from(*count) * u64::from(*cost)).sum()
        };
        let best = |sets: usize, counts: &[u32], base: &dyn Fn(usize) -> usize| {
            (0..sets).map(|set| (cost(counts, base(set)), set)).min().unwrap_or((0, 0))
        };
        let (geometry_cost, geometry_set) = best(GEOMETRY_SETS, &geometry, &Tables::geometry_base);
        let (colour_cost, colour_set) = best(COLOUR_SETS, &colour, &Tables::colour_base);
        settings.geometry_set = geometry_set as u8;
        settings.colour_set = colour_set as u8;
        self.geometry_counts = geometry;
        self.colour_counts = colour;
        let bytes = ((geometry_cost + colour_cost) as f32 / 256.0 + raw_bits as f32) / 8.0;
        // Headers and what the states waste.
        bytes * share * (1.0 + 14.0 / MAX_PACKET_BYTES as f32)
    }

    /// Drops packets, the farthest first, until no more than `limit` bytes are left; the number of points lost.
    pub(crate) fn drop_far(&mut self, limit: usize, frame: &mut Frame) -> usize {
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

/// Tiles in a row of which one run in so many is counted.
const SAMPLE_TILES: usize = 12;
const SAMPLE_STEP: usize = 8;

/// A header with the palette of a frame of few colours, and with frequencies that suit it. `None` where there are more than
/// 256, or none.
#[must_use]
pub fn with_palette(header: StreamHeader, source: Source<'_>) -> Option<StreamHeader> {
    let palette = find_palette(source).filter(|palette| !palette.is_empty())?;
    // Some cameras' brightest pixels come out black: there the darkest colour is best put after the brightest.
    let mut wrapped = palette.clone();
    wrapped.rotate_left(1);
    let plain = trained(&header, palette, source)?;
    let wrapped = trained(&header, wrapped, source)?;
    Some(if plain.1 <= wrapped.1 { plain.0 } else { wrapped.0 })
}

/// With frequencies for a palette, and what the frame then costs.
fn trained(header: &StreamHeader, palette: Vec<[u8; 3]>, source: Source<'_>) -> Option<(StreamHeader, f32)> {
    let mut header =
        StreamHeader { palette, index_frequencies: vec![[256; SYMBOLS]; INDEX_CONTEXTS], ..header.clone() };
    let mut encoder = Encoder::new(header.clone())?;
    if source.len() != encoder.grid.width * encoder.grid.height {
        return None;
    }
    let mut geometry = vec![0; GEOMETRY_CONTEXTS * SYMBOLS];
    let mut colour = vec![0; COLOUR_CONTEXTS * SYMBOLS];
    let mut counter = Counter { geometry: &mut geometry, colour: &mut colour, raw_bits: 0 };
    let mut settings = Settings { mode: ColourMode::Palette, ..Settings::default() };
    encoder.count(source, &settings, SAMPLE_TILES, 1, &mut counter);
    let (contexts, _) = colour[INDEX * SYMBOLS..].as_chunks::<SYMBOLS>();
    for (own, counts) in header.index_frequencies.iter_mut().zip(contexts) {
        // What did not occur may yet, in the next frames.
        *own = normalise(&counts.map(|count| f64::from(count) + 0.5));
    }
    let cost = Encoder::new(header.clone())?.estimate(source, &mut settings);
    Some((header, cost))
}
