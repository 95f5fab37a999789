//! The numbers of the contexts: which row of a table set a symbol is coded with.

/// Symbols of every context.
pub const SYMBOLS: usize = 16;

/// Kind of a tile: 4 × the left tile's kind + the upper tile's (3 where it is not in the packet).
pub const KIND: usize = 0;
/// Pattern of a tile: by that of the tile before it, 8 where it is the packet's first.
pub const PATTERN: usize = KIND + 16;
/// Four pixels of a validity mask: 4 × the four above, 2 × the left one, the one above to the right.
pub const MASK: usize = PATTERN + 9;
/// Depth residual: 4 × the bin of the gradient + the bin of the residual before; then by the latter alone, in a row with
/// nothing above.
pub const DEPTH: usize = MASK + 64;
/// Contexts of a geometry table set.
pub const GEOMETRY_CONTEXTS: usize = DEPTH + 44;

/// DC residual: 3 × (0 luma, 1 chroma) + how many neighbours it is predicted from.
pub const DC: usize = 0;
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
pub const INDEX_CONTEXTS: usize = 44;
/// Contexts of a colour table set.
pub const COLOUR_CONTEXTS: usize = INDEX + INDEX_CONTEXTS;
