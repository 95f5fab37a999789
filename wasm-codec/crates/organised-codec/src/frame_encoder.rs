//! A frame's tiles to packets, in one pass.

use crate::frame::{Frame, Mix, Settings};
use crate::histogram::{Histogram, SAMPLE_STEP, SAMPLE_TILES, is_sampled};
use crate::load::Source;
use crate::packet_cost::{cost_limit, overhead, overhead_bits};
use crate::packet_writer::{Filled, PacketWriter};
use crate::plan::Plan;
use crate::stream::StreamHeader;
use crate::syntax::Neighbours;
use crate::tables::EncoderTables;
use crate::tile::{Kind, Pattern, Place};
use crate::tile_encoder::TileEncoder;

/// Codes the frames of one stream with given settings.
pub(crate) struct FrameEncoder {
    pub tables: EncoderTables,
    pub tiles: TileEncoder,
    pub writer: PacketWriter,
    /// Of every tile, for the next frames.
    pub patterns: Vec<Pattern>,
    /// Symbols of a sample of the last frame's tiles.
    pub histogram: Histogram,
}

impl FrameEncoder {
    pub fn new(header: &StreamHeader) -> Self {
        Self {
            tables: EncoderTables::new(&header.index_frequencies),
            tiles: TileEncoder::new(header),
            writer: PacketWriter::new(header),
            patterns: vec![Pattern(0); header.grid().tiles()],
            histogram: Histogram::default(),
        }
    }

    /// Codes a frame with as many pixels as the grid. A plan chooses every tile's pattern, and which tiles get the finer
    /// settings; without a plan all of them do. A packet's settings are those of its first tile.
    pub fn encode(&mut self, source: Source<'_>, mix: &Mix, plan: Option<&mut Plan>) -> Frame {
        self.writer.begin_frame();
        self.tables.choose((mix.coarser.geometry_set, mix.coarser.colour_set));
        self.histogram.clear();
        let pass = Pass {
            encoder: self,
            source,
            mix,
            plan,
            frame: Frame::default(),
            draft: None,
            loaded: None,
            begun_rows: 0,
        };
        let mut frame = pass.run();
        self.writer.sort_near_first();
        frame.packets = self.writer.packets().len();
        frame.bytes = self.writer.len();
        frame
    }
}

/// The packet being filled.
struct Draft {
    settings: Settings,
    finer: bool,
    near: Neighbours,
    /// Its first tile.
    first: usize,
    full: Filled,
    /// Before its last tile that is not empty, and the frame then.
    before: (Filled, Frame),
    /// Of all its tiles, in 1/256 bit.
    cost: u32,
}

/// One pass over a frame. Its steps return the tile to continue with: usually the next one, an earlier one where a packet
/// could not hold its last tile after all.
struct Pass<'a> {
    encoder: &'a mut FrameEncoder,
    source: Source<'a>,
    mix: &'a Mix,
    plan: Option<&'a mut Plan>,
    frame: Frame,
    draft: Option<Draft>,
    /// The row of tiles that is loaded, and its depth level.
    loaded: Option<(usize, u8)>,
    /// How many rows of tiles the pass has reached.
    begun_rows: usize,
}

impl Pass<'_> {
    fn run(mut self) -> Frame {
        let tiles = self.encoder.patterns.len();
        let mut next = 0;
        loop {
            while next < tiles {
                next = self.code(next);
            }
            match self.close() {
                Some(again) => next = again,
                None => return self.frame,
            }
        }
    }

    /// Codes a tile into the open packet, or into a new one.
    fn code(&mut self, tile: usize) -> usize {
        let place = self.encoder.tiles.grid().place(tile);
        if let Some(again) = self.follow_plan(tile, place.row) {
            return again;
        }
        let finer = self.is_finer(tile);
        let settings = if finer { self.mix.finer } else { self.mix.coarser };
        self.load(place, settings.depth_level);
        if self.draft.is_none() && self.encoder.tiles.loaded(place.column).valid == 0 {
            // No packet begins with an empty tile.
            if let Some(plan) = &mut self.plan {
                plan.note(tile, Pattern(0), finer, 0.0);
            }
            return tile + 1;
        }
        self.add(tile, place, finer, &settings)
    }

    /// Lets the plan decide about a row when it begins, and closes the open packet where the plan wants the tile coded with
    /// the other settings. Returns the tile to go back to if that packet could not hold its last one.
    fn follow_plan(&mut self, tile: usize, row: usize) -> Option<usize> {
        let plan = self.plan.as_deref_mut()?;
        let begins = row >= self.begun_rows;
        if begins {
            let in_draft = self
                .draft
                .as_ref()
                .map_or(0.0, |draft| overhead_bits(draft.settings.mode) + draft.cost as f32 / 256.0);
            let spent = self.encoder.writer.len() as f32 * 8.0 + in_draft;
            plan.begin_row(self.encoder.tiles.grid(), row, spent, &mut self.encoder.patterns);
        }
        // A packet with much room left continues into a row that the plan would code otherwise. In a split frame, finer and
        // coarser tiles never share a packet.
        let ends = self.draft.as_ref().is_some_and(|draft| {
            let is_half_full = || draft.cost > cost_limit(draft.settings.mode) / 2;
            draft.finer != plan.is_finer(tile) && (plan.is_split() || (begins && is_half_full()))
        });
        if ends { self.close() } else { None }
    }

    /// Whether a tile gets the finer settings: those of the open packet, else as the plan says.
    fn is_finer(&self, tile: usize) -> bool {
        match &self.draft {
            Some(draft) => draft.finer,
            None => self.plan.as_ref().is_none_or(|plan| plan.is_finer(tile)),
        }
    }

    /// Loads a tile's row, unless it is loaded already. A row is loaded again, from this tile on, for another depth level and
    /// when the pass goes back to a tile that did not fit.
    fn load(&mut self, place: Place, depth_level: u8) {
        if self.loaded == Some((place.row, depth_level)) {
            return;
        }
        let begins = place.row >= self.begun_rows;
        let columns = if begins { 0 } else { place.column }..self.encoder.tiles.grid().columns;
        let left = self.encoder.tiles.load(self.source, place.row, columns, depth_level);
        if begins {
            self.frame.left.add(&left);
            self.begun_rows = place.row + 1;
        }
        self.loaded = Some((place.row, depth_level));
    }

    /// Adds a loaded tile to the open packet, or opens one. A packet that cannot hold the tile as well is closed; a tile too
    /// large for any packet is thinned until it fits.
    fn add(&mut self, tile: usize, place: Place, finer: bool, settings: &Settings) -> usize {
        let before = self.frame;
        let mut pattern = self.encoder.patterns[tile];
        loop {
            self.encoder.tiles.prepare(place.column, pattern, settings);
            self.begin_packet(tile, finer, settings);
            let Some(draft) = &mut self.draft else { return tile };
            self.encoder.tiles.code(&mut draft.near, place, settings.mode);
            let cost = draft.cost + self.encoder.tiles.tokens().cost(&self.encoder.tables);
            if cost <= cost_limit(settings.mode) {
                self.keep(tile, place, pattern, cost, before);
                return tile + 1;
            }
            if draft.full.tiles > 0 {
                // The tile begins the next packet, perhaps in other settings.
                return self.close().unwrap_or(tile);
            }
            self.draft = None;
            pattern = Pattern((pattern.0 + 1).min(Pattern::LEFT_OUT.0));
        }
    }

    /// Opens a packet, unless one is open.
    fn begin_packet(&mut self, first: usize, finer: bool, settings: &Settings) {
        if self.draft.is_some() {
            return;
        }
        self.encoder.writer.begin_packet();
        self.draft = Some(Draft {
            settings: *settings,
            finer,
            near: Neighbours::new(),
            first,
            full: Filled::default(),
            before: (Filled::default(), self.frame),
            cost: 0,
        });
    }

    /// Keeps the tile that was just coded. `cost` is the packet's with the tile, `before` the frame without it.
    fn keep(&mut self, tile: usize, place: Place, pattern: Pattern, cost: u32, before: Frame) {
        let FrameEncoder { tiles, writer, patterns, histogram, .. } = &mut *self.encoder;
        let Some(draft) = &mut self.draft else { return };
        let mode = draft.settings.mode;
        if let Some(plan) = &mut self.plan {
            let bits = (cost - draft.cost) as f32 / 256.0;
            plan.note(tile, pattern, draft.finer, bits * (1.0 + overhead(mode)));
        }
        draft.cost = cost;
        writer.push(tiles.tokens());
        if is_sampled(tile, SAMPLE_TILES, SAMPLE_STEP) {
            histogram.add(tiles.tokens());
        }
        let (loaded, content) = (tiles.loaded(place.column), tiles.tile());
        let points = content.valid();
        let thinned = loaded.valid as usize - points;
        self.frame.thinned += thinned;
        if content.kind == Kind::Empty {
            return;
        }
        if pattern != patterns[tile] {
            self.frame.too_dense += thinned;
        }
        let mut check = draft.full.check;
        if !mode.has_signs() {
            check.add_tile(tile, content, mode);
        }
        draft.before = (draft.full, before);
        draft.full = Filled {
            tiles: tile + 1 - draft.first,
            mark: writer.mark(),
            points: draft.full.points + points,
            nearest: draft.full.nearest.max(i32::from(loaded.nearest) << draft.settings.depth_level),
            check,
        };
    }

    /// Writes the open packet, if there is one. The estimate of its length is next to never too low; where it is, the packet's
    /// last tile is left out, and its number is returned: the pass continues there.
    fn close(&mut self) -> Option<usize> {
        let draft = self.draft.take().filter(|draft| draft.full.tiles > 0)?;
        if self.write(&draft, &draft.full) {
            return None;
        }
        let (less, then) = &draft.before;
        if less.tiles == 0 {
            self.lose(&draft.full);
            return None;
        }
        self.frame = Frame { points: self.frame.points, left: self.frame.left, ..*then };
        if !self.write(&draft, less) {
            self.lose(less);
        }
        Some(draft.first + draft.full.tiles - 1)
    }

    /// Writes a packet's first tiles; false where it would be too long.
    fn write(&mut self, draft: &Draft, filled: &Filled) -> bool {
        let FrameEncoder { tables, writer, .. } = &mut *self.encoder;
        let fits = writer.write(tables, draft.first, filled, &draft.settings);
        if fits {
            self.frame.points += filled.points;
        }
        fits
    }

    /// Counts the points of a packet that cannot be written as too dense.
    fn lose(&mut self, filled: &Filled) {
        self.frame.thinned += filled.points;
        self.frame.too_dense += filled.points;
    }
}
