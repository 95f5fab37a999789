//! A tile's pixels as symbols and raw bits.

use core::ops::Range;

use crate::frame::Settings;
use crate::load::{Left, Loaded, MAX_COORDINATE, Quantiser, Source};
use crate::palette::Palette;
use crate::prepare::Preparer;
use crate::rans::TileTokens;
use crate::stream::{DEPTH_LEVELS, StreamHeader};
use crate::syntax::{Neighbours, code_tile};
use crate::tile::{ColourMode, Grid, Pattern, Place, TILE, Tile};

/// Turns the tiles of a stream's frames into tokens, one tile at a time.
pub(crate) struct TileEncoder {
    grid: Grid,
    /// 1 / step of inverse depth, by depth level.
    scales: [f32; DEPTH_LEVELS as usize],
    quantiser: Quantiser,
    palette: Palette,
    /// The tiles of a row, by column.
    row: Vec<Loaded>,
    preparer: Box<Preparer>,
    tile: Tile,
    tokens: TileTokens,
}

impl TileEncoder {
    pub fn new(header: &StreamHeader) -> Self {
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
        Self {
            grid,
            scales: core::array::from_fn(|level| 1.0 / header.depth_step(level as u8)),
            quantiser,
            palette: Palette::new(&header.palette),
            row: vec![Loaded::new(); grid.columns],
            preparer: Box::new(Preparer::new()),
            tile: Tile::new(),
            tokens: TileTokens::new(),
        }
    }

    pub const fn grid(&self) -> Grid {
        self.grid
    }

    /// Quantises tiles of a row of tiles; returns the pixels that carry no point.
    #[inline]
    pub fn load(&mut self, source: Source<'_>, row: usize, columns: Range<usize>, depth_level: u8) -> Left {
        self.quantiser.scale = self.scales[usize::from(depth_level.min(DEPTH_LEVELS - 1))];
        self.quantiser.load(source, self.grid, row, columns, &mut self.row)
    }

    /// A loaded tile.
    #[inline]
    pub fn loaded(&self, column: usize) -> &Loaded {
        &self.row[column]
    }

    /// Makes a loaded tile the current one: the pixels that a pattern keeps, and their colours as the settings say.
    #[inline]
    pub fn prepare(&mut self, column: usize, pattern: Pattern, settings: &Settings) {
        self.preparer.prepare(&self.row[column], &mut self.tile, pattern, settings, &self.palette);
    }

    /// Codes the current tile as the next one of a packet.
    #[inline]
    pub fn code(&mut self, near: &mut Neighbours, place: Place, mode: ColourMode) {
        self.tokens.clear();
        code_tile(&mut self.tokens, &mut self.tile, near, place, mode);
    }

    /// The current tile.
    #[inline]
    pub fn tile(&self) -> &Tile {
        &self.tile
    }

    /// What [`TileEncoder::code`] made of the current tile.
    #[inline]
    pub fn tokens(&self) -> &TileTokens {
        &self.tokens
    }
}
