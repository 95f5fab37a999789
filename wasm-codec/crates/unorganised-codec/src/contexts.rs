//! The numbers of the contexts: each has a table of its own.

/// Symbols of a table.
pub const SYMBOLS: usize = 42;

/// Contexts of the first coordinate.
pub const FIRST: usize = 14;
/// Contexts of each other coordinate: its own usual error × the error before it.
pub const OTHER: usize = 10;
/// Classes of the error before.
pub const ERRORS: usize = 4;
/// Contexts of coordinates. There are two such sets: one for steps, one for the other predictors.
pub const GEOMETRY: usize = FIRST + 2 * OTHER * ERRORS;
/// Contexts of an intensity.
pub const INTENSITY: usize = 10;
/// Contexts of green.
pub const GREEN: usize = 8;
/// Contexts of red and of blue, for each class of green's error.
pub const RED_BLUE: usize = 8;
/// Classes of green's error.
pub const GREEN_ERRORS: usize = 3;

/// The first context of an intensity.
pub const INTENSITY_BASE: usize = 2 * GEOMETRY;
/// The first context of green.
pub const GREEN_BASE: usize = INTENSITY_BASE + INTENSITY;
/// The first context of red and blue.
pub const RED_BLUE_BASE: usize = GREEN_BASE + GREEN;
/// Tables of the format.
pub const TABLE_COUNT: usize = RED_BLUE_BASE + RED_BLUE * GREEN_ERRORS;
