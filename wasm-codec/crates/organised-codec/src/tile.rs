//! A tile of 16 × 16 pixels, as the syntax sees it.

use wide::i16x8;

use crate::lanes::{LANES, transpose};
use crate::rans::NO_TOKEN;

/// Pixels along a tile's side.
pub const TILE: usize = 16;
/// Blocks of a tile: 4 for each plane at most.
pub const MAX_BLOCKS: usize = 12;

/// Where the tiles of an image lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Image width, pixels.
    pub width: usize,
    /// Image height, pixels.
    pub height: usize,
    /// Tiles across.
    pub columns: usize,
    /// Tiles down.
    pub rows: usize,
}

impl Grid {
    /// For an image of `width` × `height` pixels.
    #[must_use]
    pub const fn new(width: usize, height: usize) -> Self {
        Self { width, height, columns: width.div_ceil(TILE), rows: height.div_ceil(TILE) }
    }

    /// Tiles of the image.
    #[must_use]
    pub const fn tiles(&self) -> usize {
        self.columns * self.rows
    }

    /// Column and row of a tile: they are numbered row by row.
    #[must_use]
    pub const fn place(&self, tile: usize) -> Place {
        Place { column: tile % self.columns, row: tile / self.columns }
    }
}

/// See [`Grid::place`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Tile column.
    pub column: usize,
    /// Tile row.
    pub row: usize,
}

/// Which pixels of a tile are kept: 0 all, 1 every second (quincunx), 2 a quarter, … 7 two, each half of those before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pattern(pub u8);

impl Pattern {
    /// How many there are.
    pub const COUNT: u8 = 8;
    /// Stands for the pattern of a tile that is left out.
    pub(crate) const LEFT_OUT: Self = Self(Self::COUNT);

    /// Kept pixels in a row of kept pixels.
    #[inline(always)]
    #[must_use]
    pub const fn width(self) -> usize {
        TILE >> ((self.0 + 1) >> 1)
    }

    /// Rows with kept pixels.
    #[inline(always)]
    #[must_use]
    pub const fn height(self) -> usize {
        TILE >> (self.0 >> 1)
    }

    /// Column and row in the tile of the kept pixel `x`, `y`. Odd patterns shift every second row by half a step.
    #[inline(always)]
    #[must_use]
    pub const fn pixel(self, x: usize, y: usize) -> (usize, usize) {
        let shift = self.0 >> 1;
        let x = if self.0 & 1 == 1 { 2 * x + (y & 1) } else { x };
        (x << shift, y << shift)
    }
}

/// Which pixels of a pattern are valid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// None.
    #[default]
    Empty,
    /// All.
    Full,
    /// As the mask says.
    Mixed,
}

/// How colours are coded in a packet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColourMode {
    /// Not at all: every point is pure green.
    None,
    /// Chroma at half the resolution.
    #[default]
    Subsampled,
    /// Chroma as fine as luma.
    Full,
    /// By index into the stream's palette, without loss.
    Palette,
}

impl ColourMode {
    /// True where a tile may end with signs of coefficients.
    #[must_use]
    pub const fn has_signs(self) -> bool {
        matches!(self, Self::Subsampled | Self::Full)
    }

    /// Blocks across and down of a plane (0 luma, 1 and 2 chroma) in a tile of a pattern up to 2.
    #[inline(always)]
    #[must_use]
    pub const fn blocks(self, pattern: Pattern, plane: usize) -> (usize, usize) {
        if plane > 0 && matches!(self, Self::Subsampled) {
            (1, 1)
        } else {
            (pattern.width() / 8, pattern.height() / 8)
        }
    }
}

/// The coarsest pattern whose colours are transformed; the rest code each point's colour by itself.
pub const LAST_TRANSFORMED: Pattern = Pattern(2);

/// The largest quantised inverse depth.
pub const MAX_DEPTH: i32 = 32_767;
/// Levels of a block's mean and of single points' colours lie within ±this.
pub const MAX_DC: i32 = 16_383;

/// A block's quantised coefficients.
#[derive(Clone, Copy)]
pub struct Block {
    /// Level of the mean.
    pub dc: i32,
    /// AC levels up to the last that is not 0.
    pub count: usize,
    /// AC levels in zigzag order: `levels[i]` is the coefficient at zigzag position i + 1. Valid up to `count`.
    pub levels: [i16; 63],
}

/// Numbers above 0 for the pixels of a tile, laid out for the wavefront: row y lies in line y mod 8, each line begins two
/// places farther to the right than the one before, and rows 8 to 15 follow rows 0 to 7. What a wavefront handles at once
/// stands in one column.
#[derive(Clone)]
pub struct Plane {
    /// Columns 0 to 45 of each line are used.
    pub lines: [[i16; LINE]; LANES],
    /// Room for the columns of the lines: what they hold means nothing from call to call.
    pub columns: [i16x8; STEPS],
    /// Where the numbers are known: their tokens, laid out as they are, and what is coded. Where no row ever lies, there are
    /// no tokens; the rest is room, too.
    pub tokens: [[i16; LINE]; LANES],
    /// See `tokens`.
    pub numbers: [[i16; LINE]; LANES],
}

/// Steps of a front over 16 × 16 pixels, and room for two more.
pub const STEPS: usize = 48;

/// Places of a line of a [`Plane`].
pub const LINE: usize = 64;

impl Plane {
    const fn new() -> Self {
        Self {
            lines: [[1; LINE]; LANES],
            columns: [i16x8::ZERO; STEPS],
            tokens: [[NO_TOKEN; LINE]; LANES],
            numbers: [[0; LINE]; LANES],
        }
    }

    /// A row of 16 pixels; those beyond the pattern's width mean nothing.
    #[inline(always)]
    #[must_use]
    pub fn row(&self, y: usize) -> &[i16; TILE] {
        let (lane, start) = place(y);
        self.lines[lane][start..start + TILE].first_chunk().expect("16 pixels")
    }

    /// As [`Plane::row`].
    #[inline(always)]
    pub fn row_mut(&mut self, y: usize) -> &mut [i16; TILE] {
        row_mut(&mut self.lines, y)
    }

    /// As [`Plane::row`], of the tokens.
    #[inline(always)]
    pub fn tokens_mut(&mut self, y: usize) -> &mut [i16; TILE] {
        row_mut(&mut self.tokens, y)
    }

    /// As [`Plane::row`], of what is coded.
    #[inline(always)]
    pub fn numbers_mut(&mut self, y: usize) -> &mut [i16; TILE] {
        row_mut(&mut self.numbers, y)
    }
}

/// Line and place in it where a row begins.
#[inline(always)]
const fn place(y: usize) -> (usize, usize) {
    (y % LANES, 2 * (y % LANES) + 2 * LANES * (y / LANES % 2))
}

#[inline(always)]
fn row_mut(lines: &mut [[i16; LINE]; LANES], y: usize) -> &mut [i16; TILE] {
    let (lane, start) = place(y);
    lines[lane][start..start + TILE].first_chunk_mut().expect("16 pixels")
}

/// Eight columns of a plane's lines.
#[inline(always)]
pub fn columns_of(lines: &[[i16; LINE]; LANES], block: usize) -> [i16x8; LANES] {
    transpose(lines.each_ref().map(|line| {
        let eight: &[i16; LANES] = line[block * LANES..][..LANES].first_chunk().expect("eight");
        i16x8::from(*eight)
    }))
}

/// A tile's content: coordinates are those of the pattern, not of the image.
pub struct Tile {
    /// Which pixels are kept.
    pub pattern: Pattern,
    /// Which of them are valid.
    pub kind: Kind,
    /// Valid pixels of each row, the leftmost in bit 0.
    pub rows: [u16; TILE],
    /// Quantised inverse depth.
    pub depth: Plane,
    /// Place in the palette, from 1.
    pub index: Plane,
    /// Coefficients, planes one after another, each in raster order.
    pub blocks: [Block; MAX_BLOCKS],
    /// Quantised colours of the valid pixels where they are not transformed.
    pub points: [[i32; 3]; 32],
}

impl Tile {
    /// An empty one.
    #[must_use]
    pub fn new() -> Self {
        Self {
            pattern: Pattern(0),
            kind: Kind::Empty,
            rows: [0; TILE],
            depth: Plane::new(),
            index: Plane::new(),
            blocks: [Block { dc: 0, count: 0, levels: [0; 63] }; MAX_BLOCKS],
            points: [[0; 3]; 32],
        }
    }

    /// Number of valid pixels.
    #[must_use]
    pub fn valid(&self) -> usize {
        self.rows[..self.pattern.height()].iter().map(|row| row.count_ones() as usize).sum()
    }

    /// True where a luma-sized block holds a valid pixel.
    #[inline(always)]
    #[must_use]
    pub fn block_is_seen(&self, column: usize, row: usize) -> bool {
        let bits = self.rows[row * 8..row * 8 + 8].iter().fold(0, |all, row| all | row);
        bits >> (column * 8) & 0xff != 0
    }
}

impl Default for Tile {
    fn default() -> Self {
        Self::new()
    }
}
