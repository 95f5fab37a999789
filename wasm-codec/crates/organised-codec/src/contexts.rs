//! The numbers of the contexts: which row of a packet's tables a symbol is coded with. Geometry comes first, then colour.

/// Symbols of every context.
pub const SYMBOLS: usize = 16;

/// Kind of a tile: by the left tile's, 3 where it is not in the packet.
pub const KIND: usize = 0;
/// Pattern of a tile: by that of the tile before it, 8 where it is the packet's first.
pub const PATTERN: usize = KIND + 4;
/// Four pixels of a validity mask: 4 × the four above, 2 × the left one, the one above to the right.
pub const MASK: usize = PATTERN + 9;
/// Depth residual: 4 × the bin of the gradient + the bin of the residual before; 10 stands for the bin of the gradient in a
/// tile's first row.
pub const DEPTH: usize = MASK + 64;
/// See [`DEPTH`].
pub const FIRST_ROW_BIN: i16 = 10;
/// From this bin of the gradient on low bits are not modelled: one, and one more with each bin.
pub const SHIFTED_BIN: usize = 7;
/// Contexts of the numbers of a plane.
pub const PLANE_CONTEXTS: usize = 44;
/// The first depth of a tile that no known tile touches, less that of the tile before it.
pub const ANCHOR: usize = DEPTH + PLANE_CONTEXTS;
/// Contexts of a geometry table set.
pub const GEOMETRY_CONTEXTS: usize = ANCHOR + 1;

/// DC residual: 3 × (0 luma, 1 chroma) + how many neighbours it is predicted from.
pub const DC: usize = GEOMETRY_CONTEXTS;
/// Coefficients up to the last that is not 0: 6 × plane class + the bin of the neighbours' count.
pub const LAST: usize = DC + 6;
/// Magnitude − 1 of the last coefficient: 8 × plane class + band.
pub const LEAD: usize = LAST + 12;
/// Magnitude of the others: 40 × plane class + 5 × band + the bin of the two before.
pub const COEFFICIENT: usize = LEAD + 16;
/// Colour of a single point: 4 × plane + the bin of the residual before.
pub const POINT: usize = COEFFICIENT + 80;
/// Residual of a palette index, as [`DEPTH`].
pub const INDEX: usize = POINT + 12;
/// How many.
pub const INDEX_CONTEXTS: usize = PLANE_CONTEXTS;
/// All contexts.
pub const CONTEXTS: usize = INDEX + INDEX_CONTEXTS;
/// Contexts of a colour table set.
pub const COLOUR_CONTEXTS: usize = CONTEXTS - GEOMETRY_CONTEXTS;
/// The context of no symbol: it is always 0 and costs nothing. Lanes without a pixel are decoded with it.
pub const CERTAIN: usize = CONTEXTS;
