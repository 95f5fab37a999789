//! Frames to packets.

use crate::content_check::ContentCheck;
use crate::frame::{Frame, Mix, Packet, Settings};
use crate::load::{Left, Loaded, MAX_COORDINATE, Quantiser, Source};
use crate::packet::{MAX_PACKET_BYTES, PacketHeader, Span, header_bytes, seal};
use crate::palette::Palette;
use crate::plan::{LEFT_OUT, Plan};
use crate::prepare::Preparer;
use crate::rans::{Held, Mark, PacketTokens, TileTokens, WORDS};
use crate::rate::RateState;
use crate::sampling::{Histogram, Learnt, SAMPLE_STEP, SAMPLE_TILES, is_sampled};
use crate::stream::StreamHeader;
use crate::syntax::{Neighbours, code_tile};
use crate::tables::EncoderTables;
use crate::tile::{ColourMode, Grid, Kind, Pattern, TILE, Tile};

/// Codes frames of one stream.
pub struct Encoder {
    pub(crate) header: StreamHeader,
    pub(crate) grid: Grid,
    pub(crate) tables: EncoderTables,
    pub(crate) quantiser: Quantiser,
    /// Of every tile.
    pub(crate) patterns: Vec<Pattern>,
    /// The tiles of a row, by column.
    pub(crate) row: Vec<Loaded>,
    pub(crate) preparer: Box<Preparer>,
    pub(crate) tile: Tile,
    pub(crate) tokens: TileTokens,
    packet_tokens: PacketTokens,
    words: Box<[u16; WORDS]>,
    bytes: Vec<u8>,
    packets: Vec<Packet>,
    pub(crate) palette: Palette,
    pub(crate) rate: RateState,
    pub(crate) histogram: Histogram,
    pub(crate) learnt: Option<Learnt>,
}

/// The packet being filled.
struct Open {
    settings: Settings,
    finer: bool,
    near: Neighbours,
    first: usize,
    full: Filled,
    /// Before the last tile that is not empty, and the frame then.
    before: (Filled, Frame),
    /// Of all tiles, in 1/256 bit.
    cost: u32,
}

/// What is in a packet, up to the last tile that is not empty.
#[derive(Clone, Copy, Default)]
struct Filled {
    tiles: usize,
    mark: Mark,
    points: usize,
    nearest: i32,
    /// Where its colour has no signs.
    check: ContentCheck,
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
            tables: EncoderTables::new(&header.index_frequencies),
            quantiser,
            patterns: vec![Pattern(0); grid.tiles()],
            row: vec![Loaded::new(); grid.columns],
            preparer: Box::new(Preparer::new()),
            tile: Tile::new(),
            tokens: TileTokens::new(),
            packet_tokens: PacketTokens::default(),
            words: Box::new([0; WORDS]),
            bytes: Vec::with_capacity(grid.width * grid.height),
            packets: Vec::with_capacity(grid.tiles()),
            palette: Palette::new(&header.palette),
            rate: RateState::default(),
            histogram: Histogram::default(),
            learnt: None,
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
        self.encode_mixed(source, &Mix { finer: *settings, coarser: *settings }, None)
    }

    /// With a plan, the patterns and which tiles are finer are its. A packet is coded as its first tile should be.
    pub(crate) fn encode_mixed(
        &mut self,
        source: Source<'_>,
        mix: &Mix,
        mut plan: Option<&mut Plan>,
    ) -> Option<Frame> {
        if source.len() != self.grid.width * self.grid.height {
            return None;
        }
        self.bytes.clear();
        self.packets.clear();
        self.tables.choose((mix.coarser.geometry_set, mix.coarser.colour_set));
        self.histogram.clear();
        let mut frame = Frame::default();
        let mut open: Option<Open> = None;
        let mut next = 0;
        let mut row = None;
        let mut counted = 0;
        let mut lost = Left::default();
        loop {
            if next == self.grid.tiles() {
                let Some(last) = open.take() else { break };
                next = self.close(last, &mut frame).unwrap_or(next);
                continue;
            }
            let before = frame;
            let place = self.grid.place(next);
            if let Some(plan) = &mut plan {
                let begins = place.row >= counted;
                if begins {
                    let in_packet = open.as_ref().map_or(0.0, |packet: &Open| {
                        overhead_bits(packet.settings.mode) + packet.cost as f32 / 256.0
                    });
                    let spent = self.bytes.len() as f32 * 8.0 + in_packet;
                    plan.begin_row(self.grid, place.row, spent, &mut self.patterns);
                }
                // A row that should be coded otherwise begins a packet, unless there is much room in the present one; where the
                // frame is split, so does any tile.
                let ends = |packet: &mut Open| {
                    plan.is_split() || (begins && packet.cost > cost_limit(packet.settings.mode) / 2)
                };
                let turned = |packet: &mut Open| packet.finer != plan.is_finer(next) && ends(packet);
                if let Some(full) = open.take_if(turned)
                    && let Some(again) = self.close(full, &mut frame)
                {
                    next = again;
                    continue;
                }
            }
            let finer = open
                .as_ref()
                .map_or_else(|| plan.as_ref().is_none_or(|plan| plan.is_finer(next)), |packet| packet.finer);
            let settings = if finer { mix.finer } else { mix.coarser };
            // A row may come again, in part with another depth level, or where a tile did not fit after all.
            if row != Some((place.row, settings.depth_level)) {
                self.quantiser.scale = 1.0 / self.header.depth_step(settings.depth_level);
                let columns = if place.row < counted { place.column } else { 0 }..self.grid.columns;
                let left = self.quantiser.load(source, self.grid, place.row, columns, &mut self.row);
                if place.row >= counted {
                    lost.add(&left);
                    counted = place.row + 1;
                }
                row = Some((place.row, settings.depth_level));
            }
            let loaded = &self.row[place.column];
            if loaded.valid == 0 && open.is_none() {
                if let Some(plan) = &mut plan {
                    plan.note(next, Pattern(0), finer, 0.0);
                }
                next += 1;
                continue;
            }
            let mut pattern = self.patterns[next];
            let valid = loaded.valid as usize;
            let nearest = i32::from(loaded.nearest) << settings.depth_level;
            self.preparer.prepare(loaded, &mut self.tile, pattern, &settings, &self.palette);
            next = loop {
                let packet = open.get_or_insert_with(|| {
                    self.packet_tokens.clear();
                    Open {
                        settings,
                        finer,
                        near: Neighbours::new(),
                        first: next,
                        full: Filled::default(),
                        before: (Filled::default(), before),
                        cost: 0,
                    }
                });
                self.tokens.clear();
                code_tile(&mut self.tokens, &mut self.tile, &mut packet.near, place, settings.mode);
                let cost = packet.cost + self.tokens.cost(&self.tables);
                if cost <= cost_limit(settings.mode) {
                    if let Some(plan) = &mut plan {
                        let bits = (cost - packet.cost) as f32 / 256.0;
                        plan.note(next, pattern, finer, bits * (1.0 + overhead(settings.mode)));
                    }
                    packet.cost = cost;
                    self.packet_tokens.push(&self.tokens);
                    if is_sampled(next, SAMPLE_TILES, SAMPLE_STEP) {
                        self.histogram.add(&self.tokens);
                    }
                    let there = self.tile.valid();
                    frame.thinned += valid - there;
                    if self.tile.kind != Kind::Empty {
                        if pattern != self.patterns[next] {
                            frame.too_dense += valid - there;
                        }
                        packet.before = (packet.full, before);
                        let mut check = packet.full.check;
                        if !settings.mode.has_signs() {
                            check.add_tile(next, &self.tile, settings.mode);
                        }
                        packet.full = Filled {
                            check,
                            tiles: next + 1 - packet.first,
                            mark: self.packet_tokens.mark(),
                            points: packet.full.points + there,
                            nearest: packet.full.nearest.max(nearest),
                        };
                    }
                    break next + 1;
                }
                if packet.full.tiles > 0 {
                    let full = open.take().expect("a packet");
                    // The tile begins the next packet, perhaps in other settings.
                    break self.close(full, &mut frame).unwrap_or(next);
                } else {
                    // A tile that no packet can hold: half of its points, and so on.
                    open = None;
                    pattern = Pattern((pattern.0 + 1).min(LEFT_OUT.0));
                    let loaded = &self.row[place.column];
                    self.preparer.prepare(loaded, &mut self.tile, pattern, &settings, &self.palette);
                }
            };
        }
        self.learn(&mix.coarser);
        // Near packets first: what is sent first is lost last.
        self.packets.sort_by_key(|packet| (core::cmp::Reverse(packet.nearest), packet.start));
        frame.left = lost;
        frame.packets = self.packets.len();
        frame.bytes = self.bytes.len();
        Some(frame)
    }

    /// Writes a packet. Where the estimate of its length was too low, which next to never happens, its last tile is left
    /// out, and the number of that tile is returned: to go on from there.
    fn close(&mut self, packet: Open, frame: &mut Frame) -> Option<usize> {
        if packet.full.tiles == 0 {
            return None;
        }
        if self.write(packet.first, &packet.full, &packet.settings) {
            frame.points += packet.full.points;
            return None;
        }
        let (less, then) = packet.before;
        if less.tiles == 0 {
            frame.thinned += packet.full.points;
            frame.too_dense += packet.full.points;
            return None;
        }
        *frame = Frame { points: frame.points, ..then };
        if self.write(packet.first, &less, &packet.settings) {
            frame.points += less.points;
        } else {
            frame.thinned += less.points;
            frame.too_dense += less.points;
        }
        Some(packet.first + packet.full.tiles - 1)
    }

    /// Adds a packet; false where it would be too long.
    fn write(&mut self, first: usize, filled: &Filled, settings: &Settings) -> bool {
        self.packet_tokens.rewind(filled.mark);
        let start = self.bytes.len();
        let header = PacketHeader {
            id: self.header.id,
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
        if !self.packet_tokens.write(&self.tables, &span, held, &mut self.words, limit, &mut self.bytes) {
            self.bytes.truncate(start);
            return false;
        }
        seal(&mut self.bytes[start..]);
        let length = self.bytes.len() - start;
        self.packets.push(Packet { start, length, points: filled.points, nearest: filled.nearest });
        true
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

/// What a packet's header, span (18 bits, mostly) and states cost, less what the states hold.
pub(crate) const fn overhead_bits(mode: ColourMode) -> f32 {
    (8 * header_bytes(mode) + 18) as f32 + STATES_BITS as f32
}

/// As a share of the rest of a full packet.
pub(crate) const fn overhead(mode: ColourMode) -> f32 {
    overhead_bits(mode) / (MAX_PACKET_BYTES as f32 * 8.0 - overhead_bits(mode))
}

/// What the states cost more than they hold.
const STATES_BITS: u32 = 76;

/// What the symbols and raw bits of a packet may cost, in 1/256 bit: all but its header, its span (35 bits), the states, and
/// the rest of a byte.
const fn cost_limit(mode: ColourMode) -> u32 {
    (8 * (MAX_PACKET_BYTES - header_bytes(mode)) as u32 - 35 - STATES_BITS - 8) * 256
}
